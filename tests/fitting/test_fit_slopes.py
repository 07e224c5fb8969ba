"""Derivatives of fits: exact where a run gives them, the same as differences, for fewer runs."""

from __future__ import annotations

from functools import partial

import attrs
import numpy as np
import pytest
from refusals import refuses
from spheres import GAP, SOUGHT, VISCOSITY, closed, measured, sphere, stokes

import contactkit as ck
from contactkit.fitting.model import Model
from contactkit.fitting.outcomes import solver_of
from contactkit.fitting.parameters import scene_parameters
from contactkit.fitting.runs import Solver
from contactkit.fitting.search import Problem

pytestmark = pytest.mark.filterwarnings("ignore::contactkit.ValidityWarning")

FINE = ck.Accuracy(curve_rtol=1e-4)
LOWER = "interface.lower.solid.young_modulus"


def wave(**loading):
    """A wave on a half-space, pressed."""
    solid = ck.Material(young_modulus=1e9, poisson_ratio=0.3)
    return ck.ContactScene(
        interface=ck.Interface(
            lower=ck.Body(solid=solid),
            upper=ck.Body(surface=ck.Wave(amplitude=1e-8, wavelength=1e-6)),
        ),
        window=ck.Window(width=1e-6),
        loading=ck.Approach(approach=8e-9, **loading),
        effects=(ck.HalfSpace(),),
    )


def pulled(*effects, **loading):
    """Two discs with a drop between them, pulled apart by a force."""
    oil = ck.Liquid(name="oil", viscosity=0.1, surface_tension=0.03)
    face, film = ck.Flat(radius=1e-3), ck.Meniscus(liquid=oil, volume=1e-11)
    given = {"force": 1.0, "mass": 1e-3, "initial_gap": 5e-6, "final_gap": 2e-5} | loading
    return ck.SeparationScene(
        interface=ck.Interface(lower=face, upper=face, meniscus=film),
        loading=ck.ImposedForce(**given),
        effects=effects or (ck.ViscousForce(),),
    )


def problem_of(scene, data, parameters, accuracy, *bounds):
    sought = scene_parameters(scene, accuracy, parameters)
    solver = Solver(scene, accuracy, solver_of(scene, accuracy, None), True)
    model = Model(solver, sought, (tuple(data), bounds), {})
    return Problem(model, [1.0] * len(data))


def by_differences(problem, place, step=1e-3):
    """Of fourth order."""
    columns = []
    for i in range(place.size):
        rows = []
        for k in (-2, -1, 1, 2):
            moved = place.copy()
            moved[i] += k * step
            rows.append(problem.strict_residuals(moved))
        columns.append((rows[0] - 8.0 * rows[1] + 8.0 * rows[2] - rows[3]) / (12.0 * step))
    return np.column_stack(columns)


def agree(problem, rel):
    """Slopes in the middle of the ranges against differences; all of them are exact."""
    place = np.array([one.scaled(one.start) for one in problem.model.parameters])
    found = problem.slopes(place)
    n = problem.model.runs.n
    assert all(problem.exact)
    wanted = by_differences(problem, place)
    size = np.abs(wanted).max(axis=0)
    assert np.all(size > 0.0)
    assert np.all(np.abs(found - wanted).max(axis=0) <= rel * size)
    return n


def test_a_force_over_the_gap_through_a_spring_has_slopes_of_its_laws():
    """To fields, shift, stiffness, scale and zero at once."""
    softness = stokes(0.1, GAP) / 50.0
    data = measured(
        at=GAP + softness, values=stokes(0.1, GAP), noise="1 %", shift=("-1 um", "1.2 um"),
        stiffness=(20.0, 80.0), scale=(0.5, 2.0), zero=ck.Prior("10 uN", "5 uN"),
    )  # fmt: skip
    data = attrs.evolve(data, quantity="viscous_force")
    ranges = {VISCOSITY: (0.05, 0.2), "interface.upper.surface.radius": (5e-4, 2e-3)}
    problem = problem_of(sphere(), [data], ranges, ck.Accuracy(curve_rtol=1e-6))
    assert agree(problem, 1e-3) == 1


def test_numbers_of_a_contact_have_slopes_of_one_adjoint_solve():
    """A run for each reading and one for the bound, whatever is sought; shift is an approach."""
    data = ck.MeasuredCurve(
        over="loading.approach", at=[4e-9, 6e-9, 9e-9], quantity="load", values=[1e-6, 2e-6, 4e-6],
        noise="1 %", shift=("-2 nm", "2.5 nm"), scale=(0.5, 2.0),
    )  # fmt: skip
    bound = ck.MeasuredBound(quantity="max_pressure", most="1 MPa", noise="0.1 MPa")
    ranges = {LOWER: (5e8, 3e9), "interface.upper.surface.amplitude": (8e-9, 1.3e-8)}
    accuracy = ck.Accuracy(grid=32, rtol=1e-11)
    assert agree(problem_of(wave(), [data], ranges, accuracy, bound), 2e-5) == 4


def test_evaluations_of_a_fit_are_few_and_said_to_be_exact():
    """A third of those by differences, and the same result."""
    data = attrs.evolve(
        measured(values=1.02 * stokes(0.2, GAP + 1e-7) + 3e-6, noise="1 uN"),
        quantity="viscous_force", shift=("-1 um", "1 um"), zero=("-20 uN", "20 uN"),
    )  # fmt: skip
    found = ck.fit(sphere(), data, SOUGHT, intervals="linear")
    assert found.slopes == "exact for viscosity, shift, zero"
    assert "slopes: exact for" in str(found)
    plain = partial(ck.fit, solve=lambda scene: ck.simulate(ck.plan(scene, FINE)))
    free = plain(sphere(), data, SOUGHT, intervals="linear")
    assert found.work.n_runs <= 0.5 * free.work.n_runs
    assert found.work.n_evaluations <= 20
    assert free.slopes == "exact for shift, zero, by differences for viscosity"
    for one, other in zip(found.parameters, free.parameters, strict=True):
        half = 0.5 * (one.high - one.low)
        assert one.value == pytest.approx(other.value, abs=0.05 * half)
        assert one.low == pytest.approx(other.low, abs=0.1 * half)


def test_differences_are_taken_where_slopes_are_not_known_or_cost_more():
    """A motion with one parameter; a load whose pixels the window changes."""
    times = ck.MeasuredCurve(
        over="loading.force",
        at=[1.0, 2.0],
        quantity="release_time",
        values=[1e-3, 6e-4],
        noise="5 %",
    )
    found = ck.fit(pulled(), times, SOUGHT, intervals="linear")
    assert found.slopes == "by differences for viscosity"
    area = ck.MeasuredCurve(
        over="loading.approach", at=[4e-9, 8e-9], quantity="contact_area", values=[3e-13, 4e-13],
        noise="5 %", scale=(0.1, 10.0),
    )  # fmt: skip
    accuracy = ck.Accuracy(grid=16)
    found = ck.fit(wave(), area, {"interface.upper.surface.amplitude": (8e-9, 2e-8)}, accuracy)
    assert found.slopes == "exact for scale, by differences for amplitude"


@pytest.mark.slow
def test_six_parameters_of_a_motion_follow_from_its_sensitivities():
    times = ck.MeasuredCurve(
        over="loading.force",
        at=[1.0, 2.0],
        quantity="release_time",
        values=[1e-3, 6e-4],
        noise="5 %",
    )
    fields = {
        VISCOSITY: (0.05, 0.2), "loading.initial_gap": (4e-6, 6e-6), "loading.mass": (5e-4, 2e-3),
        "loading.final_gap": (1.5e-5, 3e-5), "interface.meniscus.volume": (5e-12, 2e-11),
        "loading.initial_speed": (1e-4, 2e-3),
    }  # fmt: skip
    problem = problem_of(pulled(initial_speed=1e-3), [times], fields, ck.Accuracy(time_rtol=1e-8))
    assert agree(problem, 1e-4) <= 3  # one of them at the start, which the ranges round


@pytest.mark.slow
def test_workers_change_no_bit():
    data = ck.MeasuredCurve(
        over="loading.approach", at=[4e-9, 6e-9, 9e-9], quantity="load",
        values=[1.0e-6, 2.1e-6, 4.2e-6], noise="5 %", zero=("-1 uN", "1 uN"),
    )  # fmt: skip
    given = (wave(), data, {LOWER: (2e8, 9e9)}, ck.Accuracy(grid=32))
    one, two = ck.fit(*given), ck.fit(*given, workers=2)
    assert one.parameters == two.parameters
    assert one.chi2 == two.chi2
    assert np.array_equal(one.correlation, two.correlation)
    assert one.slopes == two.slopes == "exact for young_modulus, zero"


def test_workers_that_cannot_help_are_refused():
    refuses(lambda: ck.fit(sphere(), measured(), SOUGHT, workers=0), "workers", "at least 1")
    lost = lambda scene: closed(scene)  # noqa: E731
    refuses(
        lambda: ck.fit(sphere(), measured(), SOUGHT, solve=lost, workers=2),
        "workers",
        "of a module",
    )
