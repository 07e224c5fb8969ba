"""Chains of contact solves: what they cost in single solves, and that they agree with them.

Costs are counts of operator applications on the full grid. A bound is the goal and a margin, so
that no test hangs on the last bits of a solve.
"""

from __future__ import annotations

import attrs
import numpy as np
import pytest
from selection import quick

import contactkit as ck
from contactkit.app.scenes import open_scene
from contactkit.contact.solver.optimality import optimality
from contactkit.contact.solver.warm_start import initial_pressure

pytestmark = [
    pytest.mark.hard,
    pytest.mark.filterwarnings("ignore::contactkit.errors.ValidityWarning"),
]

MARGIN = 1.15
PIXEL = 2.5e-6 / 128  # [m]
LOAD = 1e8  # [Pa]: the patches of contact are too many pixels for a direct solve


def planned(*effects, pressure=LOAD, grid=128, rtol=1e-8, scene=None):
    """A piece of the head-disk interface, layered bodies, with these effects only."""
    opened = scene or open_scene("head-disk").scene
    made = attrs.evolve(
        opened,
        window=ck.Window(width=grid * PIXEL),
        loading=ck.Pressing(pressure=pressure),
        effects=(ck.LayeredHalfSpace(), *effects),
    )
    return ck.plan(made, ck.Accuracy(grid=grid, rtol=rtol))


def applications(result):
    return result.work.n_operator_applications


@pytest.fixture(scope="module")
def dry():
    return ck.solve(planned())


def pulling(thickness=1e-9):
    return ck.FilmMeniscus(film_thickness=thickness, self_consistent=True)


@pytest.mark.parametrize("thickness", [1e-9, 3e-9])
def test_a_film_that_pulls_costs_at_most_four_dry_solves(dry, thickness):
    wet = ck.solve(planned(pulling(thickness)))
    part = wet.of(ck.FilmMeniscus)
    assert applications(wet) <= 4.0 * MARGIN * applications(dry)
    assert wet.residual <= 1e-8
    # The balance is that of the film on a contact solved alone, without a start.
    alone = ck.solve(planned(ck.FilmMeniscus(film_thickness=thickness), pressure=wet.mean_pressure))
    np.testing.assert_allclose(alone.pressure, wet.pressure, atol=1e-6 * wet.max_pressure)
    imposed = LOAD * wet.plan.grid.area
    pixel = part.area and part.force / part.area * wet.plan.grid.pixel_area
    balance = imposed + alone.of(ck.FilmMeniscus).force
    assert wet.load == pytest.approx(balance, abs=1e-6 * wet.load + 1.01 * pixel)


def test_further_equilibria_are_looked_for_on_a_coarser_companion():
    """The search reaches to the film over the whole window, but takes no full-grid solve."""
    light = planned(pulling(), pressure=2e6, grid=192)
    full = ck.solve(attrs.evolve(light, accuracy=attrs.evolve(light.accuracy, rtol=1e-6)))
    assert full.work.n_coarse_iterations > 0
    assert full.work.n_solves <= 8


@pytest.mark.parametrize(("coefficient", "goal"), [(0.1, 2.0), (0.3, 2.2), (1.0, 3.0)])
def test_friction_coupling_costs_about_two_solves(dry, coefficient, goal):
    coupled = ck.solve(planned(ck.FrictionTraction(coefficient=coefficient), ck.FrictionCoupling()))
    assert applications(coupled) <= goal * MARGIN * applications(dry)
    assert coupled.residual <= 1e-8
    # The contact conditions hold with the displacement of the pressure itself.
    plan, p = coupled.plan, coupled.pressure
    caused = plan.coupling(p)
    elastic = plan.prepared.solver.displacement(p)
    found = optimality(p, elastic, plan.heights - caused)
    assert found.residual <= 1e-5 * float(np.ptp(elastic))
    # What the coupling changes is measured against the contact without it.
    change = float(np.abs(p - dry.pressure).max()) / dry.max_pressure
    assert coupled.of(ck.FrictionCoupling).pressure_change == pytest.approx(change, rel=1e-3)


def test_friction_that_causes_nothing_is_solved_to_the_tolerance():
    rubber = ck.Material(young_modulus=1e9, poisson_ratio=0.5)
    scene = open_scene("head-disk").scene
    lower = attrs.evolve(scene.interface.lower, solid=rubber)
    upper = attrs.evolve(scene.interface.upper, solid=None)
    scene = attrs.evolve(scene, interface=attrs.evolve(scene.interface, lower=lower, upper=upper))
    effects = ck.FrictionTraction(coefficient=0.5), ck.FrictionCoupling()
    found = ck.solve(planned(*effects, pressure=1e6, grid=64, scene=scene))
    assert found.residual <= 1e-8
    assert found.of(ck.FrictionCoupling).pressure_change < 1e-4


# Load curves ----------------------------------------------------------------------------------


def curve_and_cold(plan, pressures, rtol):
    """A curve of contacts, and the applications of the same ones solved alone."""
    curve = ck.load_curve(plan, pressures=pressures, rtol=rtol, keep_maps=True)
    exact = attrs.evolve(plan, accuracy=attrs.evolve(plan.accuracy, rtol=rtol))
    alone = [ck.solve(exact.with_loading(ck.Pressing(pressure=p))) for p in pressures]
    return curve, alone


@pytest.mark.parametrize(("rtol", "goal"), quick([(1e-5, 12.0), (1e-8, 15.0)], 0))
def test_a_load_curve_costs_less_than_its_points(rtol, goal):
    """Twenty loads over a factor of five, given in any order."""
    pressures = np.random.default_rng(1).permutation(np.geomspace(0.2, 1.0, 20) * LOAD)
    curve, alone = curve_and_cold(planned(), pressures, rtol)
    largest = max(applications(one) for one in alone)
    assert curve.applications.sum() <= goal * MARGIN * largest
    assert curve.applications.sum() <= 0.8 * sum(applications(one) for one in alone)
    assert curve.mean_pressure == pytest.approx(pressures)
    assert np.all(curve.columns["residual"] <= rtol)
    assert np.all(curve.seconds > 0.0)
    for one, single in zip(curve.results, alone, strict=True):
        np.testing.assert_allclose(
            one.pressure, single.pressure, atol=100.0 * rtol * single.max_pressure
        )


def test_the_columns_are_those_of_the_results():
    curve = ck.load_curve(planned(grid=48), pressures=[1e7, 1e8, 3e7], keep_maps=True)
    results = curve.results
    for name in ("load", "mean_pressure", "approach", "contact_area", "max_pressure"):
        assert getattr(curve, name) == pytest.approx([getattr(one, name) for one in results])
        assert name in curve.units
    assert curve.applications.tolist() == [applications(one) for one in results]
    assert np.all(np.diff(curve.contact_area[[0, 2, 1]]) > 0.0)
    with pytest.raises(ck.NotSimulatedError, match="keep_maps=True"):
        _ = ck.load_curve(planned(grid=32), loads=[1e-4]).results


def test_hard_loads_of_a_curve_are_those_of_single_solves():
    """None, tiny, jumps by a million, and nearly full contact."""
    full = 3e11
    pressures = [0.0, 1e2, full, 1e8, 1e8, 1e2, 1.01e8]
    curve, alone = curve_and_cold(planned(grid=48), pressures, 1e-8)
    for one, single in zip(curve.results, alone, strict=True):
        assert one.status == single.status
        np.testing.assert_allclose(
            one.pressure, single.pressure, atol=1e-6 * max(single.max_pressure, 1e-300)
        )
    assert curve.columns["contact_fraction"][[0, 2]] == pytest.approx([0.0, 1.0])


def test_a_curve_up_to_the_hardness_costs_no_more_than_its_points():
    """Where much is plastic the nested grids start better, and are what is used."""
    hardness = 2e10
    plan = planned(ck.HardnessLimit(rule=ck.ConstantHardness(hardness=hardness)))
    pressures = hardness * np.array([0.05, 0.1, 0.2, 0.4, 0.6, 0.8, 0.9, 0.999, 0.999999])
    curve, alone = curve_and_cold(plan, pressures, 1e-8)
    assert curve.applications.sum() <= MARGIN * sum(applications(one) for one in alone)
    for one, single in zip(curve.results, alone, strict=True):
        np.testing.assert_allclose(one.pressure, single.pressure, atol=1e-6 * hardness)
    with pytest.raises(ck.InfeasibleError, match="hardness"):
        ck.load_curve(plan, pressures=[1e7, 1.01 * hardness])


def test_a_curve_over_approaches_agrees_with_that_over_its_loads():
    plan = planned(grid=64)
    approaches = ck.load_curve(plan, pressures=np.geomspace(0.3, 1.0, 8) * LOAD).approach
    curve = ck.load_curve(plan, approaches=approaches)
    assert curve.mean_pressure == pytest.approx(np.geomspace(0.3, 1.0, 8) * LOAD, rel=1e-6)


def test_effects_keep_their_numbers_along_a_curve():
    effects = ck.FrictionTraction(coefficient=0.3), ck.FrictionCoupling(), pulling()
    plan = planned(*effects, grid=48)
    pressures = [1e7, 3e7, 2e7]
    curve = ck.load_curve(plan, pressures=pressures)
    for i, pressure in enumerate(pressures):
        alone = ck.solve(plan.with_loading(ck.Pressing(pressure=pressure))).scalars()
        for name in ("friction_force", "meniscus_force", "coupling_pressure_change"):
            assert curve.columns[name][i] == pytest.approx(alone[name][0], rel=1e-4)


def test_a_curve_warns_once_of_each_number(recwarn):
    ck.load_curve(planned(grid=32), pressures=[1e7, 2e7, 4e7])
    names = [str(one.message).split(" = ")[0] for one in recwarn]
    assert names
    assert len(names) == len(set(names))


@pytest.mark.parametrize(
    ("given", "message"),
    [
        ({}, "none"),
        ({"loads": [1.0], "approaches": [1e-9]}, r"one of loads \[N\], pressures \[Pa\]"),
        ({"loads": []}, r"loads\) must be a sequence.*got \[\]"),
        ({"pressures": [1e7, -1.0]}, "pressure"),
        ({"pressures": [1e7, float("nan")]}, r"pressures\) must be a sequence of finite numbers"),
        ({"pressures": "all"}, r"pressures\) must be a number and a unit"),
        ({"pressures": ["10 N"]}, r"pressures\) must be in a unit that converts to Pa"),
        ({"approaches": [[1e-9]]}, r"approaches\) must be a sequence"),
        ({"pressures": [1e7], "rtol": 2.0}, "rtol"),
    ],
)
def test_impossible_series_are_refused(given, message):
    with pytest.raises(ck.DescriptionError, match=message):
        ck.load_curve(planned(grid=16), **given)


# Initial guesses ------------------------------------------------------------------------------


def test_an_extrapolation_uses_no_more_solutions_than_it_can_trust():
    """Two that are almost one say nothing about a load far from both."""
    near = 1.0, np.ones((2, 2))
    almost = 1.0 + 1e-9, 1.1 * np.ones((2, 2))
    lighter = 0.9, 0.9 * np.ones((2, 2))
    np.testing.assert_array_equal(
        initial_pressure([near, almost], 1.1, True, (2, 2)).pressure, near[1]
    )
    found = initial_pressure([near, lighter], 1.1, True, (2, 2)).pressure
    assert found == pytest.approx(np.full((2, 2), 1.0 + 0.1 * np.log(1.1) / -np.log(0.9)))


@pytest.mark.parametrize("ratio", [1e-6, 0.3, 3.0, 1e6])
def test_a_load_far_away_starts_from_the_nested_grids(ratio):
    known = [(1.0, np.ones((2, 2))), (0.9, np.ones((2, 2)))]
    assert initial_pressure(known, ratio, True, (2, 2)) is None


def test_pixels_at_the_bound_stay_there_in_an_extrapolation():
    """In round-off below it they would count as free."""
    plan = planned(ck.HardnessLimit(rule=ck.ConstantHardness(hardness=2e10)), pressure=3e9)
    results = [ck.solve(plan.with_loading(ck.Pressing(pressure=p))) for p in (3.6e9, 3.4e9, 3.2e9)]
    cold = applications(ck.solve(plan))
    assert applications(ck.solve(plan, start=results[::-1])) <= MARGIN * cold


# Curves against single solves -----------------------------------------------------------------

STEEL = ck.Material(name="steel", young_modulus=210e9, poisson_ratio=0.3)
HARD = ck.HardnessLimit(rule=ck.ConstantHardness(hardness=6e9))


def film(stiffness):
    material = ck.Material(young_modulus=stiffness * 210e9, poisson_ratio=0.3)
    return ck.Stack(layers=(ck.Layer(material=material, thickness=4e-9),), substrate=STEEL)


CURVES = {  # what deforms, whether it repeats, effects
    "periodic": (STEEL, True, ()),
    "isolated": (STEEL, False, ()),
    "hardness": (STEEL, True, (HARD,)),
    "soft film": (film(3.0), True, ()),
    "stiff film": (film(100.0), False, ()),
}


def cost_of_a_curve(name, step, n, rtol):
    """Applications of a curve of loads, over those of single solves."""
    solid, periodic, effects = CURVES[name]
    rough = ck.SelfAffineRoughness(rms=2e-9, hurst=0.8, rolloff=2.5e-7, cutoff=6.4e-8, seed=3)
    scene = ck.ContactScene(
        interface=ck.Interface(lower=ck.Body(solid=solid), upper=ck.Body(surface=rough)),
        window=ck.Window(width=1e-6, periodic=periodic),
        loading=ck.Pressing(pressure=4e8),
        effects=(ck.HalfSpace() if solid is STEEL else ck.LayeredHalfSpace(), *effects),
    )
    plan = ck.plan(scene, ck.Accuracy(grid=128, rtol=rtol))
    loads = 4e8 * step ** -np.arange(float(n))
    single = sum(
        applications(ck.solve(plan.with_loading(ck.Pressing(pressure=float(p))))) for p in loads
    )
    return ck.load_curve(plan, pressures=loads).applications.sum() / single


@pytest.mark.slow
@pytest.mark.parametrize("name", quick(list(CURVES), 0))
@pytest.mark.parametrize("step", [1.2, 1.5, 4.0])
def test_a_curve_of_far_loads_costs_no_more_than_single_solves(name, step):
    assert cost_of_a_curve(name, step, 7, 1e-8) <= 1.02


@pytest.mark.slow
@pytest.mark.parametrize("name", quick(["periodic", "isolated", "hardness", "soft film"], 0))
@pytest.mark.parametrize(("rtol", "most"), [(1e-3, 0.6), (1e-5, 0.66), (1e-8, 0.75)])
def test_a_curve_of_close_loads_costs_about_half_of_single_solves(name, rtol, most):
    """To 1e-8 a digit takes its two applications, however good the initial guess is."""
    assert cost_of_a_curve(name, 1.02, 10, rtol) <= most
