"""Native FMUs of films between bodies that deform: a spring in series, the film on rings."""

from __future__ import annotations

import math
from itertools import pairwise

import attrs
import numpy as np
import pytest
from native_scenes import HAS_CC

pytest.importorskip("pythonfmu")
fmpy = pytest.importorskip("fmpy")
if not HAS_CC:
    pytest.skip("there is no C compiler", allow_module_level=True)

import contactkit as ck  # noqa: E402
from contactkit.fmu.framework.toolchain import local  # noqa: E402
from contactkit.fmu.native.build import build_native  # noqa: E402
from contactkit.fmu.native.deforming import deforming_film, exactness_of  # noqa: E402
from contactkit.fmu.python.build import validate  # noqa: E402
from contactkit.lubrication.elastohydrodynamic import motion  # noqa: E402
from contactkit.separation.deforming.maxwell import (  # noqa: E402
    series_error,
    series_pull,
    series_stiffness,
)
from contactkit.separation.deforming.plan import plan_deforming  # noqa: E402

OK, DISCARD = 0, 2
ONE = {"platforms": [local()], "compiler": "cc"}
OIL = ck.Liquid(name="oil", viscosity=0.1, surface_tension=0.03)
R, GAP, SPEED = 5e-3, 1e-6, 1e-5
WIDTH = math.sqrt(R * GAP)
RIM = 8.0 * WIDTH
COARSE = 12.0 / 32.0**2  # error of 32 rings


def modulus_of(beta):
    return 0.1 * SPEED * R**1.5 / (beta * GAP**2.5)


def scene(beta, final=3e-6, *, force=None, mass=None, upper=None, effects=(), **solid):
    """A pull of a sphere off a soft flat, at a speed or by a force."""
    half = ck.Material(young_modulus=0.75 * modulus_of(beta), poisson_ratio=0.5)
    if force is None:
        loading = ck.ImposedSpeed(speed=SPEED, initial_gap=GAP, final_gap=final)
    else:
        loading = ck.ImposedForce(
            force=force, mass=mass, initial_gap=GAP, final_gap=final, time_limit=1.0
        )
    return ck.SeparationScene(
        interface=ck.Interface(
            lower=ck.Body(surface=ck.Flat(radius=RIM), solid=solid.get("solid", half)),
            upper=upper or ck.Sphere(radius=R),
            meniscus=ck.Meniscus(liquid=OIL),
        ),
        loading=loading,
        effects=(ck.ElasticBodies(), ck.ViscousForce(), *effects),
    )


def damping(gap):
    """Of the rigid sphere with this rim."""
    rim = gap + RIM**2 / (2.0 * R)
    return 6.0 * math.pi * 0.1 * R**2 * (1.0 / gap - 1.0 / rim - (rim - gap) / rim**2)


SOFT = ck.Material(young_modulus=0.75 * modulus_of(0.5), poisson_ratio=0.45)


@pytest.fixture
def force(shelf, open_fmu):
    """An instance of the film alone."""

    def of(made, **more):
        film = {"film_rtol": more.pop("film_rtol")} if "film_rtol" in more else {}
        path = shelf(build_native, made, model="stiction-force", **film, **ONE)
        return open_fmu(path).start(**more)

    return of


def pulled(host, times):
    """Forces along a pull at constant speed."""
    found = []
    for begin, end in pairwise(times):
        host.set(h=GAP + SPEED * end, v=SPEED)
        assert host.step(end - begin) == OK, host.errors
        found.append(host.get("F"))
    return np.array(found)


def engine(made, rings, times):
    """Columns of the engine on one mesh, at the times."""
    film = plan_deforming(made).film
    units = motion._units(film, SPEED)
    phase = motion.Phase(
        lambda gap, start: motion.Imposed(lambda t: gap + SPEED * (t - start)), times[1:].tolist()
    )
    run = motion._run(film, units, [phase], rings, 1e-6)
    return motion._table(run, times[1:] / units.time, units)


@pytest.mark.slow
@pytest.mark.parametrize("beta", [1e-3, 1e-2])
def test_a_spring_in_series_is_that_of_the_law(beta, force):
    host, times = force(scene(beta)), np.linspace(0.0, 0.2, 21)
    modulus = modulus_of(beta)
    law = series_pull(
        damping, lambda h: series_stiffness(R, math.sqrt(R * h), modulus), GAP, SPEED, times
    )
    assert pulled(host, times) == pytest.approx(law[1:], rel=2e-5)


@pytest.mark.slow
@pytest.mark.parametrize(
    ("made", "final"),
    [
        (scene(0.1, 4e-6), 0.3),
        (scene(9.99, 12e-6), 1.1),
        (scene(1e-3, 3e-6), 0.2),
        (scene(0.05, upper=ck.Flat(radius=0.5 * RIM)), 0.2),
        (
            scene(
                0.5,
                solid=ck.Stack(
                    layers=(ck.Layer(material=SOFT, thickness=WIDTH),),
                    substrate=ck.RigidBase(bonded=True),
                ),
            ),
            0.2,
        ),
    ],
    ids=["0.1", "10", "1e-3", "flat", "layer"],
)
def test_rings_are_the_engine_on_the_same_mesh(made, final, force):
    host = force(made, film_rtol=COARSE, rtol=1e-6)
    times = np.linspace(0.0, final, 41)
    rings = exactness_of(made, COARSE).rings
    table = engine(made, rings, times)
    found = pulled(host, times)
    assert found == pytest.approx(table["pull"], abs=2e-6 * table["pull"].max())
    assert host.get("h_axis") == pytest.approx(table["centre_gap"][-1], rel=1e-5)
    assert host.get("W") == pytest.approx(table["dissipated_energy"][-1], rel=1e-5)


def cavitating(beta, strength, cavity, final=4e-6, **more):
    """A pull whose film ruptures at a tension and leaves cavities of another."""
    limit = ck.TensionLimit(strength=strength, cavity_pressure=101_325.0 - cavity)
    return scene(beta, final, effects=(limit,), **more)


@pytest.mark.slow
@pytest.mark.parametrize(
    ("beta", "strength", "cavity"), [(0.1, 4e3, 1e3), (1.0, 1e3, 1e3), (1.0, 3e3, 800.0)]
)
def test_cavities_are_those_of_the_engine_on_the_same_mesh(beta, strength, cavity, force):
    """Also where the tensile strength exceeds the tension of a cavity."""
    made = cavitating(beta, strength, cavity)
    host, times = force(made, film_rtol=COARSE, rtol=1e-6), np.linspace(0.0, 0.3, 41)
    table = engine(made, exactness_of(made, COARSE).rings, times)
    found = pulled(host, times)
    assert table["void_volume"].max() > 5e-15
    # Without cavities the force is another.
    assert table["largest_tension"].max() < 1.001 * strength
    assert found == pytest.approx(table["pull"], abs=2e-6 * table["pull"].max())
    assert host.get("h_axis") == pytest.approx(table["centre_gap"][-1], rel=1e-6)
    assert host.get("W") == pytest.approx(table["dissipated_energy"][-1], rel=1e-6)


@pytest.mark.slow
def test_a_state_with_cavities_is_saved_and_restored(force):
    """In the cavity, and before the film ruptures, bits are repeated; so is the rupture."""
    host = force(cavitating(1.0, 3e3, 800.0), film_rtol=12.0 / 24.0**2)
    slave, times = host.slave, np.linspace(0.0, 0.3, 31)
    kept, forces = [], []
    for begin, end in pairwise(times):
        kept.append(slave.serializeFMUstate(slave.getFMUState()))
        host.set(h=GAP + SPEED * end, v=SPEED)
        assert host.step(end - begin) == OK
        forces.append(host.get("F"))
    drop = int(np.argmin(np.diff(forces)))
    assert forces[drop + 1] < 0.97 * forces[drop]  # it has ruptured
    for k in (drop - 2, drop + 1, drop + 3):
        slave.setFMUState(slave.deSerializeFMUstate(kept[k]))
        for j in range(k, min(k + 4, len(forces))):
            host.set(h=GAP + SPEED * times[j + 1], v=SPEED)
            assert host.step(times[j + 1] - times[j], times[j]) == OK
            assert host.get("F") == forces[j]


@pytest.mark.slow
def test_a_mass_that_ruptures_a_film(shelf, open_fmu):
    """Released sooner than from a film without cavities, when the scene is."""
    pull = damping(GAP) * SPEED
    made = cavitating(0.5, 1e3, 1e3, force=pull, mass=1e-2)
    host = open_fmu(shelf(build_native, made, **ONE)).start(F_ext=pull)
    found = ck.simulate(ck.plan(made))
    while not host.get("n_release"):
        assert host.step(1e-3) == OK, host.errors
    assert host.get("t_release") == pytest.approx(found.numbers["release_time"], rel=1e-2)
    whole = ck.simulate(ck.plan(scene(0.5, 4e-6, force=pull, mass=1e-2)))
    assert host.get("t_release") < 0.9 * whole.numbers["release_time"]


@pytest.mark.slow
def test_both_are_as_exact_as_they_say(force):
    """Against the engine, extrapolated from three meshes."""
    for beta, rtol in ((0.01, {}), (0.01, {"film_rtol": 3.4e-3}), (1.0, {})):
        made = scene(beta, 4e-6)
        found = ck.simulate(ck.plan(made))
        stated = exactness_of(made, **rtol)
        assert stated.film == ("series" if beta == 0.01 and not rtol else "rings")
        forces = pulled(force(made, **rtol), np.array(found["time"]))
        largest = found["pull"].max()
        assert forces.max() == pytest.approx(largest, rel=1.2 * stated.error)
        if stated.film == "rings":
            assert forces == pytest.approx(found["pull"][1:], abs=1.1 * stated.error * largest)


@pytest.mark.slow
def test_a_mass_is_released_when_the_scene_is(shelf, open_fmu):
    pull = damping(GAP) * SPEED
    made = scene(0.5, 4e-6, force=pull, mass=1e-2)
    path = shelf(build_native, made, **ONE)
    assert validate(path) == []
    assert exactness_of(made, mass=1e-2).film == "rings"
    found = ck.simulate(ck.plan(made))
    host = open_fmu(path).start(F_ext=pull)
    while not host.get("n_release"):
        assert host.step(2e-3) == OK, host.errors
    assert host.get("t_release") == pytest.approx(found.numbers["release_time"], rel=3e-3)
    assert "released at t = " in host.log[-1].message
    # One long step is as good as many.
    again = open_fmu(path).start(F_ext=pull)
    assert again.step(host.time) == OK
    assert again.get("h") == pytest.approx(host.get("h"), rel=1e-4)
    assert again.get("t_release") == pytest.approx(host.get("t_release"), rel=1e-4)


@pytest.mark.slow
def test_a_mass_on_the_spring_moves_as_on_rings(shelf, open_fmu):
    """And one so light that it would ring on the spring gets none."""
    pull = damping(GAP) * SPEED
    light, heavy = (scene(1e-2, 4e-6, force=pull, mass=mass) for mass in (1e-4, 4.0))
    assert exactness_of(light, mass=1e-4).film == "rings"
    assert exactness_of(heavy, mass=4.0).film == "series"
    spring, rings = (
        open_fmu(shelf(build_native, heavy, **film, **ONE)) for film in ({}, {"film_rtol": 2.5e-3})
    )
    found = []
    for host in (spring, rings):
        host.start(F_ext=pull)
        found.append([(host.step(5e-3), host.get("h"), host.get("F"))[1:] for _ in range(20)])
    one, other = np.transpose(found[0]), np.transpose(found[1])
    assert one[0] == pytest.approx(other[0], rel=3e-3)
    assert one[1] == pytest.approx(other[1], abs=1.5e-2 * pull)
    spring.reset()
    with pytest.raises(fmpy.fmi1.FMICallException):
        spring.start(m=1e-4)
    assert "m must be 0.6" in spring.errors[0]
    assert "rings on the spring" in spring.errors[0]


@pytest.mark.slow
@pytest.mark.parametrize("beta", [1e-3, 0.5])
def test_derivatives_and_states(beta, force):
    """dF/dh and dF/dv over a step are its differences; a step is repeated to the bit."""
    more = {"rtol": 1e-9} if beta < 0.02 else {"rtol": 1e-7, "film_rtol": 12.0 / 24.0**2}
    host = force(scene(beta, 4e-6), **more)
    slave, reference = host.slave, {n: [v.valueReference] for n, v in host.variables.items()}
    for begin, length in ((0.0, 0.01), (0.01, 0.02)):
        state, end = slave.getFMUState(), GAP + SPEED * (begin + length)

        def step(h, v, state=state, begin=begin, length=length):
            slave.setFMUState(state)
            host.set(h=h, v=v)
            assert host.step(length, begin) == OK
            return host.get("F")

        for name, unit, bump in (("v", [0.0, SPEED], "c"), ("h", [GAP, 0.0], "k")):
            move = 1e-3 * np.array(unit)
            high, low = (step(*(np.array([end, SPEED]) + s * move)) for s in (1.0, -1.0))
            first = step(end, SPEED)
            exact = slave.getDirectionalDerivative(reference["F"], reference[name], [1.0])[0]
            assert exact == host.get(bump)
            assert exact == pytest.approx((high - low) / (2e-3 * max(unit)), rel=2e-3)
            assert step(end, SPEED) == first
        kept = slave.serializeFMUstate(slave.getFMUState())
        host.set(h=end + 1e-7, v=SPEED)
        host.step(0.01)
        later = host.get("F")
        slave.setFMUState(slave.deSerializeFMUstate(kept))
        host.set(h=end + 1e-7, v=SPEED)
        assert host.step(0.01, begin + length) == OK
        assert host.get("F") == later
        slave.setFMUState(slave.deSerializeFMUstate(kept))


@pytest.mark.slow
def test_a_mass_outside_is_coupled_by_newton_with_the_derivatives(shelf, open_fmu, force):
    """In steps of 10 m/c, where an exchange of forces diverges, as with the mass inside."""
    mass, pull, length = 1e-2, damping(GAP) * SPEED, 2e-3
    made, rings = scene(0.5, 4e-6, force=pull, mass=mass), {"film_rtol": 12.0 / 24.0**2}
    inside = open_fmu(shelf(build_native, made, **rings, **ONE)).start(F_ext=pull)
    host = force(made, **rings)
    gap, speed, most = GAP, 0.0, 0
    for k in range(20):
        state, end = host.slave.getFMUState(), speed
        for count in range(1, 13):
            host.slave.setFMUState(state)
            host.set(h=gap + 0.5 * length * (speed + end), v=end)
            assert host.step(length, k * length) == OK
            missing = mass * (end - speed) / length - pull + host.get("F_mean")
            change = missing / (mass / length + host.get("c") + 0.5 * length * host.get("k"))
            end -= change
            most = max(most, count)
            if abs(change) < 1e-6 * SPEED:
                break
        gap, speed = gap + 0.5 * length * (speed + end), end
        assert inside.step(length) == OK
        # What is left is the parabola across the jump of the speed in the first step.
        assert gap == pytest.approx(inside.get("h"), rel=2e-2)
    assert most < 10


@pytest.mark.slow
def test_beyond_its_range_a_step_is_discarded(force):
    """Pressed too hard for the spring, nothing has changed, and a gentler step goes on."""
    host = force(scene(0.015))
    host.set(h=GAP + 0.01 * SPEED, v=SPEED)
    assert host.step(0.01) == OK
    before = host.outputs()
    host.set(h=GAP - 2e-7, v=-3e-5)
    assert host.step(0.01) == DISCARD
    assert "more than beta_max = 0.02" in host.errors[-1]
    assert "film on rings" in host.errors[-1]
    assert host.outputs() == before
    host.set(h=GAP + 0.02 * SPEED, v=SPEED)
    assert host.step(0.01) == OK


@pytest.mark.slow
def test_a_release_is_an_event_of_fmi_3(shelf):
    pull = damping(GAP) * SPEED
    made = scene(0.5, 2e-6, force=pull, mass=1e-2)
    path = shelf(build_native, made, fmi=3, start={"rtol": 1e-4}, film_rtol=12.0 / 24.0**2, **ONE)
    assert validate(path) == []
    series = np.array([(0.0, pull), (1.0, pull)], dtype=[("time", float), ("F_ext", float)])
    found = fmpy.simulate_fmu(
        str(path), stop_time=0.08, output_interval=2e-3, input=series, output=["h", "t_release"]
    )
    released = found["t_release"][-1]
    assert 0.0 < released < 0.08
    assert np.interp(released, found["time"], found["h"]) == pytest.approx(2e-6, rel=0.05)


@pytest.mark.errors
def test_what_no_fmu_holds_is_refused_by_name(tmp_path):
    out = tmp_path / "film.fmu"
    refused = {
        "no FMU holds SolidContact beside": scene(0.1, effects=(ck.SolidContact(cutoff=1e-7),)),
        r"no FMU holds beta = 20: .* ck\.simulate": scene(20.0),
    }
    for message, made in refused.items():
        with pytest.raises(ck.PlanError, match=message):
            build_native(made, out, model="stiction-force", **ONE)
    rough = ck.GaussianRoughness(rms=1e-7, correlation_length=1e-6, cutoff=1e-6, seed=1)
    with pytest.raises(
        ck.PlanError, match=r"a GaussianRoughness, interface\.upper\.surface: .*10 000 cells"
    ):
        build_native(scene(0.1, upper=rough), out, model="stiction-force", **ONE)
    with pytest.raises(ck.DescriptionError, match=r"film_rtol must be 0\.0007.* at least"):
        exactness_of(scene(0.1), 1e-4)
    with pytest.raises(ck.DescriptionError, match="m must be given"):
        build_native(scene(0.1), out, **ONE)


def test_the_film_that_is_taken_and_its_error():
    stiff, soft = exactness_of(scene(0.01)), exactness_of(scene(0.1))
    assert (stiff.film, stiff.rings, stiff.error) == ("series", 0, series_error(0.01))
    assert "spring of " in stiff.text
    assert soft.film == "rings"
    assert soft.rings == 60
    assert "film on 60 rings for beta = 0.1: the force is right to 0.0033 of" in soft.text
    assert exactness_of(scene(0.01), 5e-3).film == "rings"
    # A spring has no cavities.
    ruptured = exactness_of(cavitating(0.01, 1e3, 1e3))
    assert ruptured.film == "rings"
    assert "beta = 0.01, with cavities: the force is right to 0.0048 of" in ruptured.text
    assert (
        "where it ruptures: the force is right to 0.035"
        in exactness_of(cavitating(1.0, 3e3, 800.0)).text
    )
    # The pull is an input, and may be 0 in the scene: any may come.
    still = scene(0.01, force=0.0, mass=1e-3)
    assert exactness_of(still).beta is None
    assert exactness_of(still).film == "rings"
    # A press may deform the bodies more than the pull.
    press = ck.PressAndPull(press=1e-6, rest=0.1, speed=SPEED, initial_gap=GAP, final_gap=3e-6)
    pressed = attrs.evolve(scene(0.01), loading=press)
    assert exactness_of(pressed).film == "series"
    assert deforming_film(pressed).bodies.series is not None
    harder = attrs.evolve(press, press=1e-3)
    assert exactness_of(attrs.evolve(pressed, loading=harder)).film == "rings"
    layer = ck.Layer(material=SOFT, thickness=WIDTH)
    coated = scene(1e-3, solid=ck.Stack(layers=(layer,), substrate=ck.RigidBase(bonded=True)))
    assert exactness_of(coated).film == "rings"  # the spring of a layer is not known
