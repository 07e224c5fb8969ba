"""Viscoelastic contacts: Lee and Radok, Ting, punches, layers, elastic limits, loss, adhesion."""

from __future__ import annotations

import math
import pickle

import numpy as np
import pytest

import contactkit as ck
from contactkit.contact.creep_response import CreepResponse
from contactkit.elasticity.layered import normal_symbol
from contactkit.elasticity.prony import (
    creep_compliance,
    creep_of,
    relaxation_modulus,
    storage_and_loss,
)
from contactkit.errors import DescriptionError, NotSimulatedError, PlanError
from contactkit.reference.viscoelastic import Triangle, creep_radius, triangular_approach
from contactkit.scene.window import Grid

pytestmark = pytest.mark.filterwarnings("ignore::contactkit.errors.ValidityWarning")

RADIUS, FORCE, NU = 1e-3, 1e-4, 0.4
RUBBER = ck.ViscoelasticMaterial(
    name="rubber", young_modulus=4e6, fractions=0.75, times=2.0, poisson_ratio=NU
)
GLASSY = ck.ViscoelasticMaterial(
    name="polymer",
    young_modulus=5e8,
    fractions=(0.9, 0.09),
    times=(0.1, 3.0),
    poisson_ratio=0.35,
)
SOFT = ck.Material(name="foam", young_modulus=2e6, poisson_ratio=0.3)
CREEP = creep_of(RUBBER.relaxation)


def sphere(loading, *effects, solid=RUBBER, width=1.2e-4, edges=False):
    layered = bool(solid.stack.layers)
    compliance = ck.LayeredHalfSpace() if layered else ck.HalfSpace()
    return ck.ContactScene(
        interface=ck.Interface(
            lower=ck.Body(solid=solid), upper=ck.Body(surface=ck.Paraboloid(radius=RADIUS))
        ),
        window=ck.Window(width=width, periodic=edges),
        loading=loading,
        effects=(compliance, *effects),
    )


def solved(scene, grid=32):
    result = ck.solve(ck.plan(scene, ck.Accuracy(grid=grid)))
    assert result.status in ("converged", "no contact")
    return result


def radii(part):
    return np.sqrt(part.contact_area / math.pi)


def test_a_held_load_creeps_as_lee_and_radok():
    times = (0.5, 2.0, 8.0, 40.0)
    part = solved(
        sphere(ck.Pressing(force=FORCE), ck.Viscoelasticity(times=times, steps=2)), 64
    ).of(ck.Viscoelasticity)
    exact = creep_radius(FORCE, RADIUS, NU, creep_compliance(CREEP, part.time[1:]))
    np.testing.assert_allclose(part.approach[1:], exact**2 / RADIUS, rtol=1e-3)
    np.testing.assert_allclose(radii(part)[1:], exact, rtol=0.02)  # a count of pixels
    assert exact[-1] > 1.5 * exact[0]
    # From the states of the solids alone on one side, from load and approach on the other.
    assert part.work_error < 2e-3
    assert part.dissipated_energy[-1] > 0.5 * part.elastic_energy[-1]


def ramp(part):
    path = Triangle(1e-6 / 2.0, 2.0)
    exact = [
        triangular_approach(
            t, path, RADIUS, NU, lambda lag: relaxation_modulus(RUBBER.relaxation, lag)
        )
        for t in part.time[1:]
    ]
    return np.array(exact).T


def pressed_and_retracted(steps, grid):
    """To 1 um within 2 s, and half of it back."""
    history = ck.Viscoelasticity(times=(2.0, 2.5, 3.0), approaches=(1e-6, 0.75e-6), steps=steps)
    scene = sphere(ck.Approach(approach=0.5e-6), history, width=8.2e-5)
    return solved(scene, grid).of(ck.Viscoelasticity)


def test_a_shrinking_contact_is_that_of_ting():
    part = pressed_and_retracted(8, 48)
    load, radius = ramp(part)
    assert np.abs(part.load[1:] - load).max() < 2e-3 * load.max()
    np.testing.assert_allclose(radii(part)[[8, 16, 24]], radius[[7, 15, 23]], rtol=0.02)
    # An elastic contact of the same approach would be larger by half.
    assert radius[-1] < 0.75 * math.sqrt(0.5) * radius[7]


@pytest.mark.slow
def test_the_error_falls_with_the_square_of_the_steps():
    errors = []
    for steps in (4, 8):
        part = pressed_and_retracted(steps, 96)
        load, _ = ramp(part)
        at = [steps, 2 * steps]
        errors.append(np.abs(part.load[at] - load[[i - 1 for i in at]]).max() / load.max())
    assert errors[0] < 4e-3
    assert 3.0 < errors[0] / errors[1] < 5.0


def punch(load, *effects, solid=RUBBER, edges=False):
    """A flat square punch far from its edges: the contact never changes."""
    heights = np.full((16, 16), -1e-3)
    heights[4:12, 4:12] = 0.0
    return ck.ContactScene(
        interface=ck.Interface(
            lower=ck.Body(solid=solid),
            upper=ck.Body(surface=ck.Heights(heights=heights, pixel_size=1e-5)),
        ),
        window=ck.Window(periodic=edges),
        loading=load,
        effects=(ck.LayeredHalfSpace() if solid.stack.layers else ck.HalfSpace(), *effects),
    )


def solved_punch(*given, **more):
    return ck.solve(ck.plan(punch(*given, **more)))


def test_a_punch_creeps_with_the_compliance():
    history = ck.Viscoelasticity(times=(0.0, 0.1, 3.0, 3.0, 20.0), forces=(FORCE,) * 4, steps=3)
    part = solved_punch(ck.Pressing(force=FORCE), history).of(ck.Viscoelasticity)
    ratio = creep_compliance(CREEP, part.time[1:]) / CREEP.instantaneous
    np.testing.assert_allclose(part.approach[1:] / part.approach[1], ratio, rtol=1e-9)
    elastic = solved_punch(ck.Pressing(force=FORCE), solid=RUBBER.instantaneous)
    assert part.approach[1] == pytest.approx(elastic.approach, rel=1e-9)


def test_times_may_be_as_short_or_long_as_floats():
    history = ck.Viscoelasticity(times=(0.0, 1e-300, 1e30), forces=(FORCE, FORCE), steps=1)
    part = solved_punch(ck.Pressing(force=FORCE), history).of(ck.Viscoelasticity)
    stiff = RUBBER.instantaneous.young_modulus, RUBBER.equilibrium.young_modulus
    assert part.approach[2] == pytest.approx(part.approach[1], rel=1e-9)
    assert part.approach[3] / part.approach[1] == pytest.approx(stiff[0] / stiff[1], rel=1e-9)
    assert np.isfinite(part.dissipated_energy).all()


def test_a_cycle_loses_what_the_loss_compliance_says():
    """pi F^2 J'' over the stiffness of a punch, once the creep under the mean load is over.

    It decays as exp(-t/8 s): cycles of 6 s still lost 3.4 % more in the fourth.
    """
    n, period = 32, 24.0
    time = np.arange(1, 4 * n + 1) * (period / n)
    loads = FORCE * (1.0 + np.sin(2.0 * math.pi * time / period))
    history = ck.Viscoelasticity(times=time, forces=loads[:-1], steps=1)
    part = solved_punch(ck.Pressing(force=loads[-1]), history).of(ck.Viscoelasticity)
    storage, loss = storage_and_loss(RUBBER.relaxation, 2.0 * math.pi / period)
    lossy = float(loss / (storage**2 + loss**2))
    elastic = solved_punch(ck.Pressing(force=FORCE), solid=RUBBER.equilibrium)
    unit = elastic.approach / FORCE * RUBBER.equilibrium.young_modulus  # approach per load and J
    chords = np.sinc(1.0 / n) ** 2  # of their amplitude the loads between the given ones leave
    expected = math.pi * (FORCE * chords) ** 2 * lossy * unit
    last = part.dissipated_energy[-1] - part.dissipated_energy[-1 - n]
    assert last == pytest.approx(expected, rel=2e-4)
    assert part.work_error < 0.01


COATED = {
    "viscoelastic film": ck.Stack(
        layers=(ck.Layer(material=GLASSY, thickness=1e-5),), substrate=SOFT
    ),
    "film on it": ck.Stack(layers=(ck.Layer(material=SOFT, thickness=1e-5),), substrate=GLASSY),
    "two, on a base": ck.Stack(
        layers=(
            ck.Layer(material=RUBBER, thickness=1e-5),
            ck.Layer(material=GLASSY, thickness=2e-5),
        ),
        substrate=ck.RigidBase(bonded=True),
    ),
}


EDGES = [True, *(pytest.param(one, marks=pytest.mark.slow) for one in (False, "x"))]


@pytest.mark.parametrize("edges", EDGES)
@pytest.mark.parametrize("solid", COATED.values(), ids=COATED)
def test_layers_have_both_elastic_limits(solid, edges):
    """Within a nanosecond of the relaxation times, and after 1e9 of them."""
    load = ck.Pressing(force=FORCE)
    for times, rate in (((1e-12,), math.inf), ((1e-12, 1e12), 0.0)):
        # Held, so that no step follows a contact that creeps.
        one = solved_punch(load, ck.Viscoelasticity(times=times, steps=1), solid=solid, edges=edges)
        other = solved_punch(load, solid=solid.at_rate(rate), edges=edges)
        np.testing.assert_allclose(one.pressure, other.pressure, atol=1e-6 * other.pressure.max())
        np.testing.assert_allclose(
            one.displacement, other.displacement, atol=1e-6 * np.ptp(other.displacement)
        )
        assert one.rigid_approach == pytest.approx(other.rigid_approach, rel=1e-6)
        assert one.of(ck.Viscoelasticity).elastic_energy[-1] == pytest.approx(
            0.5 * float((other.pressure * other.displacement).sum()) * 1e-10, rel=1e-6
        )


def gaver_stehfest(transform, time, n=12):
    """Inverse of a Laplace transform at a time, from its values at real rates."""
    total, f = 0.0, math.factorial
    for i in range(1, n + 1):
        weight = sum(
            k ** (n // 2) * f(2 * k) / (f(n // 2 - k) * f(k) * f(k - 1) * f(i - k) * f(2 * k - i))
            for k in range((i + 1) // 2, min(i, n // 2) + 1)
        )
        total = total + (-1) ** (i + n // 2) * weight / i * transform(i * math.log(2.0) / time)
    return total


@pytest.mark.parametrize("solid", COATED.values(), ids=COATED)
def test_layers_creep_as_their_laplace_transform(solid):
    """The inverse of Gaver and Stehfest, whose own error is 2e-4 in double precision."""
    grid = Grid((16, 16), (1e-5, 1e-5), True)
    scene = punch(ck.Pressing(force=FORCE), solid=solid, edges=True)
    response = CreepResponse(scene, grid)
    made = response.on(grid.shape, grid.pixel_size)

    def at(rate):
        stack = solid.at_rate(rate)
        given = stack.young_moduli, stack.poisson_ratios, stack.thicknesses, stack.base
        return normal_symbol(grid.shape, grid.pixel_size, *given)

    for time in (0.01, 0.3, 5.0):
        gone = np.tensordot(np.exp(-time / response.times), made.terms, 1)
        expected = gaver_stehfest(at, time)
        np.testing.assert_allclose(
            (made.equilibrium - gone)[expected > 0.0], expected[expected > 0.0], rtol=5e-4
        )


def test_both_bodies_relax_and_one_alone():
    """Two half-spaces of one rubber are one of half its modulus."""
    history = ck.Viscoelasticity(times=(1.0, 4.0), steps=2)
    made = sphere(ck.Pressing(force=FORCE), history)
    both = ck.ContactScene(
        interface=ck.Interface(
            lower=made.interface.lower,
            upper=ck.Body(surface=ck.Paraboloid(radius=RADIUS), solid=RUBBER),
        ),
        window=made.window,
        loading=made.loading,
        effects=made.effects,
    )
    half = ck.ViscoelasticMaterial(young_modulus=2e6, fractions=0.75, times=2.0, poisson_ratio=NU)
    one = solved(both)
    other = solved(sphere(ck.Pressing(force=FORCE), history, solid=half))
    np.testing.assert_allclose(one.pressure, other.pressure, atol=1e-6 * one.max_pressure)
    assert one.approach == pytest.approx(other.approach, rel=1e-7)


# Adhesion -------------------------------------------------------------------------------------

STICKY = ck.ViscoelasticMaterial(
    name="gel", young_modulus=1e7, fractions=0.9, times=1.0, poisson_ratio=0.5
)
# A given width, so that the law is that of the elastic contacts beside it.
ADHESION = ck.Adhesion(law=ck.DugdaleAttraction(work_of_adhesion=0.05, range=2e-7, end_width=1e-7))
HIGH, LOW = 2e-7, -1.0e-6
PULL = np.linspace(HIGH, LOW, 25)


def adhesive(solid, *effects, approach=LOW):
    return ck.ContactScene(
        interface=ck.Interface(
            lower=ck.Body(solid=solid), upper=ck.Body(surface=ck.Paraboloid(radius=1e-5))
        ),
        window=ck.Window(width=1.6e-5, periodic=False),
        loading=ck.Approach(approach=approach),
        effects=(ck.HalfSpace(), ADHESION, *effects),
    )


def pulled(press, rest, pull):
    """Loads of a pull within a time [s], after a press and a rest."""
    times = (press, press + rest, *(press + rest + pull * np.arange(1, 25) / 24))
    history = ck.Viscoelasticity(times=times, approaches=(HIGH, *PULL[:-1]), steps=1)
    return solved(adhesive(STICKY, history)).of(ck.Viscoelasticity)


def elastic_pull(solid):
    loads, before = [], None
    for approach in PULL:
        plan = ck.plan(adhesive(solid, approach=approach), ck.Accuracy(grid=32))
        before = ck.solve(plan, start=before)
        loads.append(before.load)
    return np.array(loads)


@pytest.mark.slow
def test_slow_and_fast_adhesion_are_elastic():
    for solid, seconds in ((STICKY.equilibrium, 1e9), (STICKY.instantaneous, 1e-9)):
        loads = elastic_pull(solid)
        part = pulled(seconds, seconds, seconds)
        np.testing.assert_allclose(part.load[2:], loads, atol=1e-4 * -loads.min())


@pytest.mark.slow
def test_pull_off_grows_with_the_speed():
    """A contact that has relaxed holds the more the faster it is pulled, to a plateau."""
    parts = [pulled(1e4, 100.0, seconds) for seconds in (1e4, 100.0, 10.0, 1e-2, 1e-4)]
    force = np.array([-part.load.min() for part in parts]) / (1.5 * math.pi * 0.05 * 1e-5)
    assert force[0] == pytest.approx(1.07, abs=0.08)
    assert (np.diff(force)[:3] > 0.0).all()
    assert force[2] > 2.0 * force[0]
    assert force[-1] == pytest.approx(force[-2], rel=0.02)
    lost = [part.dissipated_energy[-1] - part.dissipated_energy[2] for part in parts]
    assert max(lost) == max(lost[1:4])  # neither slow nor fast: elastic limits lose nothing


# Descriptions, refusals, files ----------------------------------------------------------------


def test_maps_are_kept_at_the_times_asked_for():
    history = ck.Viscoelasticity(times=(0.0, 1.0, 5.0), steps=2, maps_at=(0.0, 5.0))
    result = solved(sphere(ck.Pressing(force=FORCE), history))
    part = result.of(ck.Viscoelasticity)
    assert part.pressures.shape == (2, 32, 32)
    np.testing.assert_array_equal(part.pressures[1], result.pressure)
    assert part.pressures[0].max() == part.max_pressure[1] > 1.3 * part.max_pressure[-1]
    assert "history_pressure" in result.contents().quantities
    np.testing.assert_allclose(
        result.gap,
        np.maximum(result.displacement - result.heights - result.rigid_approach, 0.0),
        atol=1e-12,
    )


def test_a_result_is_saved_and_pickled(tmp_path):
    history = ck.Viscoelasticity(times=(1.0, 2.0), forces=(FORCE,), steps=1)
    result = solved(sphere(ck.Pressing(force=0.0), history))
    saved = ck.load_result(result.save(tmp_path / "a.npz"))
    for other in (saved, pickle.loads(pickle.dumps(result))):
        mine, theirs = result.of(ck.Viscoelasticity), other.of(ck.Viscoelasticity)
        for one, two in zip(mine, theirs, strict=True):
            np.testing.assert_array_equal(one, two)
    assert result.status == "no contact"
    assert result.approach > 0.0  # not yet recovered


def test_a_modulus_that_depends_on_time_is_never_taken_as_elastic():
    load = ck.Pressing(force=FORCE)
    with pytest.raises(PlanError, match=r"rubber is viscoelastic.*Viscoelasticity\(times"):
        ck.plan(sphere(load))
    with pytest.raises(PlanError, match="Viscoelasticity needs a ViscoelasticMaterial"):
        ck.plan(sphere(load, ck.Viscoelasticity(times=1.0), solid=SOFT))
    with pytest.raises(PlanError, match="viscoelastic"):
        _ = RUBBER.plane_strain_modulus
    with pytest.raises(PlanError, match="viscoelastic"):
        _ = COATED["film on it"].young_moduli
    for effect in (ck.SubsurfaceStress(), ck.FrictionTraction(coefficient=0.1)):
        with pytest.raises(PlanError, match=f"{type(effect).__name__} needs elastic bodies"):
            ck.plan(sphere(load, ck.Viscoelasticity(times=1.0), effect))
    with pytest.raises(PlanError, match="viscoelastic"):
        ck.plan(
            sphere(load, ck.HardnessLimit(rule=ck.ConstantHardness(hardness=1e9)), solid=GLASSY)
        )
    with pytest.raises(NotSimulatedError, match="no gradient of a contact with Viscoelasticity"):
        _ = solved(sphere(load, ck.Viscoelasticity(times=1.0))).gradient(
            "participation_area", to="heights"
        )


def planned(force, given):
    history = ck.Viscoelasticity(**given)
    return ck.plan(sphere(ck.Pressing(force=force), history), ck.Accuracy(grid=32))


@pytest.mark.errors
@pytest.mark.parametrize(
    ("given", "loading", "said"),
    [
        ({"times": ()}, None, "at least one"),
        ({"times": (2.0, 1.0)}, None, "in order"),
        ({"times": (-1.0, 1.0)}, None, "-1"),
        ({"times": (1.0, math.inf)}, None, "inf"),
        ({"times": 1.0, "steps": 0}, None, "steps"),
        ({"times": 1.0, "maps_at": 2.0}, None, "be some of times"),
        ({"times": 1.0, "forces": math.nan}, None, "forces"),
        ({"times": (1.0, 2.0), "forces": (1.0, 2.0)}, FORCE, "a load at each of the 2 times"),
        ({"times": (1.0, 2.0), "forces": 1.0, "pressures": 1.0}, FORCE, "at most one"),
        ({"times": (1.0, 2.0), "approaches": 1e-6}, FORCE, "with approaches"),
        ({"times": (1.0, 2.0), "forces": -1.0}, FORCE, "zero or positive"),
    ],
)
def test_what_is_not_a_history_is_refused(given, loading, said):
    with pytest.raises((DescriptionError, PlanError), match=said):
        planned(loading or FORCE, given)


@pytest.mark.errors
@pytest.mark.parametrize(
    ("given", "said"),
    [
        ({"fractions": (0.5, 0.5), "times": (1.0, 2.0)}, "add up to less than 1"),
        ({"fractions": 0.5, "times": (1.0, 2.0)}, "as many as the 1 fractions"),
        ({"fractions": (0.2, 0.2), "times": (2.0, 1.0)}, "ascending"),
        ({"fractions": (0.2, 0.2), "times": (1.0, 1.0)}, "ascending"),
        ({"fractions": 0.0, "times": 1.0}, "fractions"),
        ({"fractions": 0.5, "times": 0.0}, "times"),
    ],
)
def test_what_is_not_a_relaxation_is_refused(given, said):
    with pytest.raises(DescriptionError, match=said):
        ck.ViscoelasticMaterial(young_modulus=1e6, poisson_ratio=0.5, **given)


def test_press_takes_the_elastic_limits():
    x = (np.arange(16) + 0.5 - 8) * 8e-6
    heights = -(x[:, None] ** 2 + x**2) / (2.0 * RADIUS)
    fast, slow = (
        ck.press(heights, 8e-6, solid, 6e3, periodic=False)
        for solid in (RUBBER.instantaneous, RUBBER.equilibrium)
    )
    assert slow.approach > 2.0 * fast.approach
    with pytest.raises(PlanError, match="rubber is viscoelastic"):
        ck.press(heights, 8e-6, RUBBER, 6e3)
