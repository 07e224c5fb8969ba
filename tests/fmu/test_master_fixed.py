"""The master with fixed steps: what is refused, what that would have given, and what works."""

from __future__ import annotations

import math

import pytest
from master_cases import release

from contactkit.errors import ConvergenceError, DescriptionError, InfeasibleError
from contactkit.fmu import build as building
from contactkit.fmu.master import Mass, couple


@pytest.fixture(scope="module")
def film(tmp_path_factory):
    return building.build("stiction-force", tmp_path_factory.mktemp("fmu") / "film.fmu")


@pytest.mark.parametrize(("scheme", "factor"), [("jacobi", 1.0), ("gauss-seidel", 2.0)])
def test_forces_are_not_exchanged_beyond_the_stable_step(film, release_cases, scheme, factor):
    case = release_cases["B"]["case"]
    stable = factor * case["m"] / (1.5 * math.pi * case["eta"] * case["R"] ** 4 / case["h0"] ** 3)
    with pytest.raises(InfeasibleError) as caught:
        release(film, case, 1e-3, 0.02, scheme=scheme, step=1e-5)
    assert f"exceeds {stable:.3g} s" in str(caught.value)
    assert f"take {0.1 * stable:.2g} s" in str(caught.value)
    assert "stiction-mass" in str(caught.value)


def test_a_step_that_becomes_too_long_on_the_way_is_refused_there(film):
    """Pushed together the film stiffens: c grows as 1/h^3."""
    start = {"h0": 40e-6, "eta": 0.01, "gamma": 0.0}
    with pytest.raises(InfeasibleError, match=r"at a gap of [12]\.\d+e-05 m"):
        couple(film, Mass(mass=0.02), lambda t: -40.0, 1e-3, film_start=start,
               scheme="gauss-seidel", step=5e-5)  # fmt: skip


@pytest.mark.parametrize("scheme", ["jacobi", "gauss-seidel"])
def test_what_is_refused_would_have_been_wrong(film, release_cases, scheme):
    """Smooth, without an error, and released after a hundredth of the time; the film objects."""
    case, values = release_cases["B"]["case"], release_cases["B"]["values"]
    found = release(film, case, 1e-3, 0.02, scheme=scheme, step=1e-5, refuse=False)
    assert 0.0 < found.release_time < 0.01 * values["t_rel"]
    assert "exceeds 5.22e-08 s = m_ref/c" in found.log[0]


@pytest.mark.parametrize(
    ("scheme", "step", "error"),
    [("jacobi", 1e-6, -1.1e-3), ("gauss-seidel", 1e-6, -3.6e-4), ("end-point", 1e-6, -2.5e-3),
     ("jacobi", 1e-5, -1.1e-2), ("gauss-seidel", 1e-5, -4.0e-3), ("end-point", 1e-5, -2.5e-2)],
)  # fmt: skip
def test_stable_fixed_steps_have_the_errors_known_from_elsewhere(
    film, release_cases, scheme, step, error
):
    """Of case A, measured by another code on other film laws."""
    case, values = release_cases["A"]["case"], release_cases["A"]["values"]
    found = release(film, case, 1e-3, 1.05 * values["t_rel"], scheme=scheme, step=step)
    assert found.release_time / values["t_rel"] - 1.0 == pytest.approx(error, rel=0.1)


def test_impulses_at_a_fixed_step_converge_with_its_square(film, release_cases):
    case, values = release_cases["A"]["case"], release_cases["A"]["values"]
    errors = [
        abs(release(film, case, 1e-3, 4e-4, step=step).release_time / values["t_rel"] - 1.0)
        for step in (2e-5, 5e-6)
    ]
    assert errors[0] < 1e-3
    assert errors[1] < errors[0] / 10.0


@pytest.mark.parametrize("step", [1e-4, 2e-2])
def test_impulses_do_not_fail_at_a_fixed_step(film, release_cases, step):
    case, values = release_cases["D"]["case"], release_cases["D"]["values"]
    if step == 1e-4:
        case, values = release_cases["B"]["case"], release_cases["B"]["values"]
    found = release(film, case, 1e-3, 1.1 * values["t_rel"], step=step)
    assert found.release_time == pytest.approx(values["t_rel"], rel=2e-2)


def test_a_blow_up_is_an_error(film, release_cases):
    with pytest.raises(ConvergenceError, match="blew up: the gap became -"):
        release(film, release_cases["B"]["case"], 1e-3, 0.02, scheme="jacobi", step=1e-4,
                refuse=False)  # fmt: skip


# Arguments -----------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("changes", "field"),
    [({"tolerance": 0.5}, "tolerance"), ({"tolerance": math.nan}, "tolerance"),
     ({"scheme": "strong"}, "scheme"), ({"scheme": "jacobi"}, "step"), ({"step": -1.0}, "step"),
     ({"release_gap": 1e-6}, "release_gap"), ({"release_gap": math.nan}, "release_gap"),
     ({"film_start": {"h9": 1.0}}, "h9")],
)  # fmt: skip
def test_an_argument_that_is_not_possible_is_named(film, changes, field):
    arguments = {"stop_time": 1e-3} | changes
    with pytest.raises(DescriptionError) as caught:
        couple(film, Mass(mass=0.02), lambda t: 40.0, arguments.pop("stop_time"), **arguments)
    assert field in str(caught.value)


@pytest.mark.parametrize("stop", [0.0, -1.0, math.inf, math.nan])
def test_a_stop_time_must_be_a_time(film, stop):
    with pytest.raises(DescriptionError, match="stop_time"):
        couple(film, Mass(mass=0.02), lambda t: 40.0, stop)


def test_a_body_starts_above_its_asperities(film):
    with pytest.raises(DescriptionError, match="rest_gap"):
        couple(film, Mass(mass=0.02, rest_gap=6e-6), lambda t: 40.0, 1e-3)
    with pytest.raises(DescriptionError, match="mass"):
        Mass(mass=0.0)
