"""The master with fixed steps: what is refused, what that would have given, and what works."""

from __future__ import annotations

import math

import pytest
from master_cases import release

from contactkit.errors import ConvergenceError, DescriptionError, InfeasibleError
from contactkit.fmu.master.couple import AdaptiveSteps, FixedSteps, Fmu, Mass, couple
from contactkit.fmu.python import build as building

pytestmark = pytest.mark.slow


@pytest.fixture(scope="module")
def film(shelf):
    return shelf(building.build, "stiction-force")


@pytest.mark.parametrize(("scheme", "factor"), [("jacobi", 1.0), ("gauss-seidel", 2.0)])
def test_forces_are_not_exchanged_beyond_the_stable_step(film, release_cases, scheme, factor):
    case = release_cases["B"]["case"]
    stable = factor * case["m"] / (1.5 * math.pi * case["eta"] * case["R"] ** 4 / case["h0"] ** 3)
    with pytest.raises(InfeasibleError) as caught:
        release(film, case, 0.02, FixedSteps(step=1e-5, scheme=scheme))
    assert f"exceeds {stable:.3g} s" in str(caught.value)
    assert f"take {0.1 * stable:.2g} s" in str(caught.value)
    assert "stiction-mass" in str(caught.value)


def test_a_step_that_becomes_too_long_on_the_way_is_refused_there(film):
    """Pushed together the film stiffens: c grows as 1/h^3."""
    start = {"h0": 40e-6, "eta": 0.01, "gamma": 0.0}
    with pytest.raises(InfeasibleError, match=r"at a gap of [12]\.\d+e-05 m"):
        couple(
            Fmu(film, start),
            Mass(mass=0.02),
            lambda t: -40.0,
            1e-3,
            steps=FixedSteps(step=5e-5, scheme="gauss-seidel"),
        )


@pytest.mark.parametrize("scheme", ["jacobi", "gauss-seidel"])
def test_what_is_refused_would_have_been_wrong(film, release_cases, scheme):
    """Smooth, without an error, and released after a hundredth of the time; the film objects."""
    case, values = release_cases["B"]["case"], release_cases["B"]["values"]
    steps = FixedSteps(step=1e-5, scheme=scheme, refuse_unstable=False)
    found = release(film, case, 0.02, steps)
    assert 0.0 < found.release_time < 0.01 * values["t_rel"]
    assert "exceeds 5.22e-08 s = m_ref/c" in found.log[0]


@pytest.mark.parametrize(
    ("scheme", "step", "error"),
    [
        ("jacobi", 1e-6, -1.1e-3),
        ("gauss-seidel", 1e-6, -3.6e-4),
        ("implicit-force", 1e-6, -2.5e-3),
        ("jacobi", 1e-5, -1.1e-2),
        ("gauss-seidel", 1e-5, -4.0e-3),
        ("implicit-force", 1e-5, -2.5e-2),
    ],
)
def test_stable_fixed_steps_have_the_errors_known_from_elsewhere(
    film, release_cases, scheme, step, error
):
    """Of case A, measured by another code on other film laws."""
    case, values = release_cases["A"]["case"], release_cases["A"]["values"]
    found = release(film, case, 1.05 * values["t_rel"], FixedSteps(step=step, scheme=scheme))
    assert found.release_time / values["t_rel"] - 1.0 == pytest.approx(error, rel=0.1)


def test_impulses_at_a_fixed_step_converge_with_its_square(film, release_cases):
    case, values = release_cases["A"]["case"], release_cases["A"]["values"]
    errors = [
        abs(release(film, case, 4e-4, FixedSteps(step=step)).release_time / values["t_rel"] - 1.0)
        for step in (2e-5, 5e-6)
    ]
    assert errors[0] < 1e-3
    assert errors[1] < errors[0] / 10.0


@pytest.mark.parametrize("step", [1e-4, 2e-2])
def test_impulses_do_not_fail_at_a_fixed_step(film, release_cases, step):
    case, values = release_cases["D"]["case"], release_cases["D"]["values"]
    if step == 1e-4:
        case, values = release_cases["B"]["case"], release_cases["B"]["values"]
    found = release(film, case, 1.1 * values["t_rel"], FixedSteps(step=step))
    assert found.release_time == pytest.approx(values["t_rel"], rel=2e-2)


def test_a_blow_up_is_an_error(film, release_cases):
    steps = FixedSteps(step=1e-4, scheme="jacobi", refuse_unstable=False)
    with pytest.raises(ConvergenceError, match="blew up: the gap became -"):
        release(film, release_cases["B"]["case"], 0.02, steps)


# Arguments -----------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("changes", "field"),
    [
        ({"release_gap": 1e-6}, "release_gap"),
        ({"release_gap": math.nan}, "release_gap"),
        ({"jumps": [math.nan]}, "jumps"),
        ({"pull": math.inf}, "pull"),
        ({"pull": None}, "pull"),
    ],
)
def test_an_argument_that_is_not_possible_is_named(film, changes, field):
    arguments = {"pull": lambda t: 40.0, "stop_time": 1e-3} | changes
    with pytest.raises(DescriptionError) as caught:
        couple(film, Mass(mass=0.02), **arguments)
    assert field in str(caught.value)


@pytest.mark.parametrize(
    ("start", "message"),
    [
        ({"h9": 1.0}, "h9"),
        ({"N": 2.5}, "N must be a whole number"),
        ({"N": 2**32 + 2}, "N must be a whole number"),
        ({"meniscus_law": 7}, "be one of NONE, EXACT"),
        ({"h0": "20 s"}, "h0 must be in a unit that converts to m"),
        ({"h0": -1.0}, "h0 must be positive"),
        ({"eta": math.nan}, "eta must be a number"),
        ({"h": 1e-5}, "it follows from h0"),
        ({"v": 0.0}, "it follows from Mass.speed"),
        ({"m_ref": 7.0}, "it follows from Mass.mass"),
        ({"exchange": 1}, "it follows from the coupling scheme"),
    ],
)
def test_a_start_value_that_is_not_possible_is_named(film, start, message):
    with pytest.raises(DescriptionError) as caught:
        couple(Fmu(film, start), Mass(mass=0.02), 40.0, 1e-3)
    assert message in str(caught.value)


@pytest.mark.parametrize(
    ("kind", "given", "message"),
    [
        (AdaptiveSteps, {"tolerance": 0.5}, "tolerance"),
        (AdaptiveSteps, {"tolerance": math.nan}, "tolerance"),
        (AdaptiveSteps, {"tolerance": "a"}, "tolerance"),
        (AdaptiveSteps, {"tolerance": 1e-10}, "tighter ones are not met"),
        (AdaptiveSteps, {"max_steps": 0}, "max_steps"),
        (FixedSteps, {"step": -1.0}, "step"),
        (FixedSteps, {"step": 1e-6, "scheme": "strong"}, "scheme"),
    ],
)
def test_steps_that_are_not_possible_are_named(kind, given, message):
    with pytest.raises(DescriptionError, match=message):
        kind(**given)


@pytest.mark.parametrize("stop", [0.0, -1.0, math.inf, math.nan])
def test_a_stop_time_must_be_a_time(film, stop):
    with pytest.raises(DescriptionError, match="stop_time"):
        couple(film, Mass(mass=0.02), lambda t: 40.0, stop)


def test_a_body_starts_above_its_asperities(film):
    with pytest.raises(DescriptionError, match="rest_gap"):
        couple(film, Mass(mass=0.02, rest_gap=6e-6), lambda t: 40.0, 1e-3)
    with pytest.raises(DescriptionError, match="mass"):
        Mass(mass=0.0)


def test_a_pull_that_is_not_finite_is_named_with_its_time(film):
    with pytest.raises(DescriptionError, match=r"pull at t = 0\.001\d* s must be a finite .* nan"):
        couple(film, Mass(mass=0.02), lambda t: 40.0 if t < 1e-3 else math.nan, 0.1)


def test_a_number_is_a_steady_pull_and_a_text_a_start_value(film):
    steady = couple(Fmu(film, {"h0": "20 um"}), Mass(mass=0.02), 40, 0.1, release_gap=1e-4)
    given = couple(Fmu(film, {"h0": 20e-6}), Mass(mass=0.02), lambda t: 40.0, 0.1, release_gap=1e-4)
    assert steady["h"][0] == 20e-6
    assert steady.release_time == given.release_time > 0.0


@pytest.mark.parametrize("more", [{}, {"dp_cav": 1e5}])
def test_nothing_moves_where_nothing_pulls(film, more):
    found = couple(Fmu(film, {"gamma": 0.0} | more), Mass(mass=0.02), 0.0, 0.1, release_gap=1e-4)
    assert math.isnan(found.release_time)
    assert found.time[-1] == 0.1
    assert set(found["h"]) == {5e-6}
    assert set(found["J"]) == {0.0}
