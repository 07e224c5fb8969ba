"""FMUs of films whose viscosity follows pressure and shear: their variables, and their motion."""

from __future__ import annotations

import math

import numpy as np
import pytest
from attrs import evolve
from native_scenes import HAS_CC
from refusals import refuses
from rheology_scenes import (
    BARUS,
    CARREAU,
    CUT_OFF,
    EYRING,
    GAP,
    POWER_LAW,
    ROELANDS,
    SCENES,
    VISCOSITY,
    scene,
)
from scipy.integrate import solve_ivp

pytest.importorskip("pythonfmu")
fmpy = pytest.importorskip("fmpy")

import contactkit as ck  # noqa: E402
from contactkit.accuracy import Accuracy  # noqa: E402
from contactkit.fmu.framework.toolchain import local  # noqa: E402
from contactkit.fmu.native.build import build_native  # noqa: E402
from contactkit.fmu.native.film import can_cavitate, free_liquid, moving, prepared_film  # noqa: E402
from contactkit.fmu.native.ports import check_free, native_ports  # noqa: E402
from contactkit.fmu.native.tables import tabulate  # noqa: E402
from contactkit.fmu.slaves.rheology import PressureLaw, ShearLaw, check_rheology  # noqa: E402
from contactkit.fmu.slaves.stiction_mass import (  # noqa: E402
    PORTS,
    StictionMass,
    mass_values,
    scene_of,
)
from contactkit.separation.effects.prepared import prepare_scene  # noqa: E402
from contactkit.separation.motion.advance import advance  # noqa: E402
from contactkit.separation.motion.state import Pull, outputs, start  # noqa: E402
from contactkit.separation.plan import plan  # noqa: E402

RTOL = Accuracy(time_rtol=1e-8)
ONE = {"platforms": [local()], "compiler": "cc"}
compiled = pytest.mark.skipif(not HAS_CC, reason="there is no C compiler")


def names(made, model="stiction-mass"):
    return {port.name: port for port in native_ports(prepare_scene(moving(made, None)), 0.0, model)}


def test_the_viscosity_is_a_parameter_where_the_rheology_scales():
    for free in ({"shear": CARREAU}, {"shear": EYRING}, {"pressure": BARUS}):
        assert free_liquid(prepare_scene(scene(**free))).viscosity == VISCOSITY
        assert "eta" in names(scene(**free))
    for fixed in ({"pressure": ROELANDS}, {"pressure": BARUS, "shear": CARREAU}):
        assert "eta" not in names(scene(**fixed))
    cut_off = scene(ck.ViscousForce(), CUT_OFF, shear=CARREAU)
    assert "eta" not in names(cut_off)
    ports = tuple(names(cut_off).values())
    refuses(lambda: check_free(ports, "stiction-mass", {"eta": 0.2}), "eta", "be left out")
    refuses(lambda: check_free(ports, "stiction-mass", {"T": 300.0}), "T", "rheology")


@pytest.mark.parametrize("model", ["stiction-mass", "stiction-force"])
def test_a_limit_is_in_the_tables(model):
    ports = names(scene(ck.ViscousForce(), CUT_OFF, pressure=BARUS), model)
    assert not {"dp_inception", "dp_hold", "r_cav", "V_void"} & set(ports)
    held = [ports[name] for name in ("dp_cav", "tau_lim") if name in ports]
    assert all((port.start, port.maximum) == (0.0, 0.0) for port in held)
    assert len(held) == (2 if model == "stiction-force" else 0)


def test_a_film_that_slips_has_no_limits_of_one_that_sticks():
    assert not can_cavitate(scene(slip_length_lower=1e-7))
    ports = names(scene(slip_length_lower=1e-7), "stiction-force")
    assert (ports["tau_lim"].maximum, ports["dp_cav"].maximum) == (0.0, None)
    assert "dp_inception" not in ports


def test_a_newtonian_choice_is_left_as_it_is():
    newtonian = scene(ck.ViscousForce(rheology="newtonian"), pressure=BARUS)
    (film,) = prepared_film(moving(newtonian, None)).tables.films
    assert film.rheology is None
    assert "dp_inception" in names(newtonian)


@pytest.mark.slow
@pytest.mark.parametrize("body", [None, ck.Sphere(radius=1e-2)], ids=["flats", "sphere"])
def test_a_native_fmu_tabulates_slip(body):
    slips = {"slip_length_lower": 1e-7, "slip_length_upper": 1e-7}
    given, gap, x = moving(scene(upper=body, **slips), None), 3e-6, 6.0 * 1e-7 / 3e-6
    found, plain = (tabulated(one, gap) for one in (given, moving(scene(upper=body), None)))
    factor = 1.0 / (1.0 + x)
    if body is not None:  # of an immersed sphere; the rim changes less than 1 %
        factor = 2.0 / x * ((1.0 + 1.0 / x) * math.log1p(x) - 1.0)
    assert found / plain == pytest.approx(factor, rel=1e-9 if body is None else 1e-2)


def tabulated(given, gap):
    """Force per speed and viscosity [m] that the first table of a scene is made of, at a gap."""
    forces = []

    def make(force, edges, **more):
        forces.append(force)
        return tabulate(force, edges, **more)

    prepared_film(given, make=make)
    return forces[0](gap)


def test_a_cut_off_pressure_under_a_sphere_that_slips_is_refused():
    slips = scene(ck.ViscousForce(), CUT_OFF, upper=ck.Sphere(radius=1e-2), slip_length_lower=1e-7)
    refuses(
        lambda: prepared_film(moving(slips, None)),
        "a native FMU cuts off the pressure under a sphere",
        error=ck.PlanError,
    )


# Motion ---------------------------------------------------------------------------------------

PULLS = {"carreau, drop": 30.0, "eyring": 30.0, "power law": 30.0, "eyring, sphere": 1.0}
PULLS |= {"barus": -20.0, "roelands": -20.0}


def reference(film, gap, mass, pull, times):
    """Gaps, speeds and work of a film whose force is asked for directly, without tables."""

    def rates(time, state):
        h, v, _ = state
        force = film.force(h, v)
        return [v, (pull - force) / mass, force * v]

    found = solve_ivp(
        rates, (0.0, times[-1]), [gap, 0.0, 0.0], "Radau", times, rtol=1e-8, atol=1e-14
    )
    return found.y


def check(found, gap, force, rtol):
    assert found["h"] == pytest.approx(gap, rel=rtol)
    assert found["F_v"] == pytest.approx(force, rel=rtol)


@compiled
@pytest.mark.slow
@pytest.mark.parametrize("name", ["eyring", "eyring, sphere", "barus"])
def test_a_mass_moves_as_that_of_the_scene(name, shelf, open_fmu):
    """Opening to its release and beyond, and closing: gap, force, work and impulse."""
    pull, n = PULLS[name], 4
    given = SCENES[name]
    gap, mass = given.loading.initial_gap, given.loading.mass
    made = plan(evolve(given, loading=evolve(given.loading, force=pull)), RTOL)
    law, state = Pull(pull), start(made)
    end = 4e-4 if "sphere" in name else 1.2e-3
    host = open_fmu(shelf(build_native, given, **ONE)).start(F_ext=pull, rtol=1e-8)
    rtol = 3e-5 if name == "barus" else 1e-5  # of the tables that the scene reads, see table.py
    for _ in range(n):
        state = advance(made, state, law, end / n)
        assert host.step(end / n) == 0, host.errors
        found = host.outputs()
        check(found, state.gap, outputs(made, state, pull).viscous, rtol)
        assert found["J"] == pytest.approx(state.impulses["viscous_impulse"], rel=rtol)
        # What the pull does is in the film and the mass.
        work = found["W"] + 0.5 * mass * found["v"] ** 2
        assert work == pytest.approx(pull * (found["h"] - gap), rel=2.0 * rtol)


@compiled
@pytest.mark.exhaustive
@pytest.mark.parametrize("name", PULLS)
def test_a_mass_moves_as_by_the_law_of_its_liquid(name, shelf, open_fmu):
    """Against a solver that knows neither the tables nor the steps."""
    given, pull, n = SCENES[name], PULLS[name], 5
    gap, mass = given.loading.initial_gap, given.loading.mass
    film = plan(given).prepared.rheology.film.film
    end = 4e-4 if "sphere" in name else 1.2e-3
    times = [end * (i + 1) / n for i in range(n)]
    host = open_fmu(shelf(build_native, given, **ONE)).start(F_ext=pull, rtol=1e-9)
    rtol = 3e-5 if name == "power law" else 1e-5
    for h, v, work in reference(film, gap, mass, pull, times).T:
        assert host.step(end / n) == 0, host.errors
        check(host.outputs(), h, film.force(h, v), rtol)
        assert host.get("v") == pytest.approx(v, rel=rtol)
        assert host.get("W") == pytest.approx(work, rel=rtol)


@compiled
@pytest.mark.slow
def test_one_long_step_is_many_short_ones_and_goes_back(shelf, open_fmu):
    """With the state saved and restored on the way; and at less than twice the Newtonian steps."""
    host = open_fmu(shelf(build_native, SCENES["carreau, drop"], **ONE))
    host.start(F_ext=30.0, max_steps=450)  # 290 are taken, 370 of a Newtonian film
    assert host.step(2e-3) == 0
    long = host.outputs()
    host.reset().start(F_ext=30.0)
    for i in range(40):
        if i == 20:
            saved = host.slave.serializeFMUstate(host.slave.getFMUState())
            time = host.time
        assert host.step(5e-5) == 0
    short = host.outputs()
    for name in ("t_release", "h", "v", "J", "W"):
        assert short[name] == pytest.approx(long[name], rel=3e-7)
    host.slave.setFMUState(host.slave.deSerializeFMUstate(saved))
    host.time = time
    for _ in range(20):
        assert host.step(5e-5) == 0
    assert host.outputs() == short


@compiled
@pytest.mark.slow
def test_a_film_alone_gives_forces_impulses_and_slopes(shelf, open_fmu):
    host = open_fmu(shelf(build_native, SCENES["eyring"], model="stiction-force", **ONE))
    film = prepared_film(moving(SCENES["eyring"], None)).prepared.rheology.film.film
    host.start(h=GAP)
    end, length = 1.5 * GAP, 1e-4
    speed = (end - GAP) / length
    host.set(h=end, v=speed)
    assert host.step(length) == 0
    found = host.outputs()
    assert found["F_v"] == pytest.approx(film.force(end, speed), rel=1e-5)
    nodes, weights = np.polynomial.legendre.leggauss(12)
    gaps = GAP + 0.5 * (nodes + 1.0) * (end - GAP)
    impulse = (
        0.5 * length * sum(w * film.force(h, speed) for h, w in zip(gaps, weights, strict=True))
    )
    assert found["J"] == pytest.approx(impulse, rel=1e-5)
    references = {name: host.variables[name].valueReference for name in ("F_v", "h", "v")}
    for name, size, slope in (("h", end, found["k"]), ("v", speed, found["c"])):
        host.set(h=end, v=speed)
        exact = host.slave.getDirectionalDerivative([references["F_v"]], [references[name]], [1.0])
        assert exact[0] == pytest.approx(slope, rel=1e-12)
        ends = []
        for sign in (-1.0, 1.0):
            host.set(h=end, v=speed)
            host.set(**{name: size * (1.0 + sign * 1e-5)})
            ends.append(host.get("F_v"))
        assert (ends[1] - ends[0]) / (2e-5 * size) == pytest.approx(slope, rel=1e-6)


@compiled
@pytest.mark.slow
def test_a_closing_beyond_the_pole_says_why(shelf, open_fmu):
    given = SCENES["barus"]
    host = open_fmu(shelf(build_native, given, model="stiction-force", **ONE)).start(h=GAP)
    host.set(h=0.9 * GAP, v=-1.0)
    assert host.step(0.1 * GAP) == 2
    assert "closes nearly as fast as it can" in host.errors[-1]
    host.set(h=0.9 * GAP, v=-1e-6)
    assert host.step(0.1 * GAP / 1e-6) == 0
    mass = open_fmu(shelf(build_native, given, **ONE)).start(F_ext=-1e3)
    assert mass.step(1.0) == 2
    assert "closes nearly as fast as it can" in mass.errors[-1]
    assert "RoelandsViscosity" in mass.errors[-1]


@pytest.mark.slow
def test_the_python_fmu_moves_it_too():
    given = evolve(
        SCENES["power law"], loading=evolve(SCENES["power law"].loading, final_gap=2.2e-6)
    )
    own = mass_values(given)
    assert (own["shear_law"], own["n_shear"], own["rate_c"]) == ("POWER_LAW", 0.5, 1e5)
    values = {p.name: p.read(own.get(p.name, p.start)) for p in PORTS if p.causality == "parameter"}
    slave = StictionMass(instance_name="one")
    slave.setup_experiment(0.0)
    slave.values |= values | {"F_ext": 30.0}
    slave.enter_initialization_mode()
    slave.exit_initialization_mode()
    assert slave.do_step(0.0, 1e-4)
    made = plan(given, RTOL)
    state = advance(made, start(made), Pull(30.0), 1e-4)
    check(slave.values, state.gap, outputs(made, state, 30.0).viscous, 2e-5)
    assert state.gap > 1.01 * GAP


LAWS = {
    "none": {},
    "slip": {"slip_length_lower": 1e-7, "slip_length_upper": 2e-7},
    "carreau": {"shear": evolve(CARREAU, second_plateau=0.1, sharpness=1.5)},
    "power law": {"shear": POWER_LAW},
    "eyring, barus": {"shear": EYRING, "pressure": BARUS},
    "roelands": {"pressure": ROELANDS},
}


@pytest.mark.parametrize("name", LAWS)
def test_parameters_of_the_python_fmu_hold_each_law(name):
    given = scene(ck.ViscousForce(), **LAWS[name])
    own = mass_values(given)
    values = {p.name: p.read(own.get(p.name, p.start)) for p in PORTS if p.causality == "parameter"}
    again = scene_of(values)
    one, other = given.meniscus, again.meniscus
    laws = ("pressure_viscosity", "shear_viscosity")
    assert [getattr(one.liquid, n) for n in laws] == [getattr(other.liquid, n) for n in laws]
    assert one.slip_length_upper == other.slip_length_upper
    assert mass_values(again) == own


def test_constants_of_no_law_are_refused():
    starts = {port.name: port.start for port in PORTS if port.causality == "parameter"}
    for values, name in (
        ({"alpha": 2e-8}, "pressure_law"),
        ({"tau_E": 1e6, "shear_law": ShearLaw.CARREAU}, "shear_law"),
        ({"n_shear": 0.5}, "shear_law"),
    ):
        refuses(lambda given=values: check_rheology(starts | given), next(iter(values)), name)
    for values, message in (
        ({"shear_law": ShearLaw.POWER_LAW, "n_shear": 0.5}, "rate_c"),
        ({"pressure_law": PressureLaw.BARUS}, "alpha"),
    ):
        refuses(
            lambda given=values: check_rheology(starts | given),
            message,
            "positive",
            error=ck.PlanError,
        )


def test_a_law_of_ones_own_is_refused_by_name():
    class Own(type(EYRING)):
        pass

    given = scene(ck.ViscousForce(), shear=Own(stress=1e5))
    refuses(lambda: mass_values(given), "shear_viscosity = Own", "--native", error=ck.PlanError)
