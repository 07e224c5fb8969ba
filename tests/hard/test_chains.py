"""Chains of contact solves: what they cost in single solves, and that they agree with them.

Costs are counts of operator applications on the full grid. A bound is the goal and a margin, so
that no test hangs on the last bits of a solve.
"""

from __future__ import annotations

import attrs
import numpy as np
import pytest

import contactkit as ck
from contactkit.app.scenes import open_scene
from contactkit.contact.solver.optimality import optimality
from contactkit.contact.solver.warm_start import initial_pressure

pytestmark = pytest.mark.filterwarnings("ignore::contactkit.errors.ValidityWarning")

MARGIN = 1.15
LOAD = 1e8  # [Pa]: the patches of contact are too many pixels for a direct solve


def planned(*effects, pressure=LOAD, grid=128, rtol=1e-8, scene=None):
    """A piece of the head-disk interface, layered bodies, with these effects only."""
    opened = scene or open_scene("head-disk").scene
    made = attrs.evolve(
        opened,
        window=ck.Window(width=2.5e-6),
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


# Initial guesses ------------------------------------------------------------------------------


def test_an_extrapolation_uses_no_more_solutions_than_it_can_trust():
    """Two that are almost one say nothing about a load far from both."""
    near = 1.0, np.ones((2, 2))
    almost = 1.0 + 1e-9, 1.1 * np.ones((2, 2))
    lighter = 0.9, 0.9 * np.ones((2, 2))
    np.testing.assert_array_equal(initial_pressure([near, almost], 1.1, (2, 2)), near[1])
    found = initial_pressure([near, lighter], 1.1, (2, 2))
    assert found == pytest.approx(np.full((2, 2), 1.0 + 0.1 * np.log(1.1) / -np.log(0.9)))


@pytest.mark.parametrize("ratio", [1e-6, 0.3, 3.0, 1e6])
def test_a_load_far_away_starts_from_the_nested_grids(ratio):
    known = [(1.0, np.ones((2, 2))), (0.9, np.ones((2, 2)))]
    assert initial_pressure(known, ratio, (2, 2)) is None
