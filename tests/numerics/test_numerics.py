"""The numerical tools that run without numpy: roots, step-size control, events, quadrature."""

from __future__ import annotations

import math

import pytest

from contactkit.numerics.events import first_crossing, step_to_event
from contactkit.numerics.roots import bracketed_root, first_true
from contactkit.numerics.step_size import StepSize

# Roots --------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("function", "low", "high", "root"),
    [
        (lambda x: x**3 - 2.0, 0.0, 2.0, 2.0 ** (1.0 / 3.0)),
        (lambda x: math.exp(50.0 * x) - 2.0, -1.0, 1.0, math.log(2.0) / 50.0),
        (lambda x: math.atan(1e6 * (x - 0.3)), -1.0, 1.0, 0.3),
        (lambda x: (x - 0.1) ** 9, -1.0, 1.0, 0.1),
        (lambda x: x - 1e-200, 0.0, 1.0, 1e-200),
    ],
)
def test_a_bracketed_root_is_found_however_bent_the_function(function, low, high, root):
    calls = []

    def counted(x):
        calls.append(x)
        return function(x)

    # The ninth power is below the smallest float within 1e-36 of its root.
    assert bracketed_root(counted, low, high) == pytest.approx(root, rel=1e-14, abs=0.0)
    assert all(low <= x <= high for x in calls)


def test_a_root_at_an_end_of_its_bracket_is_taken():
    assert bracketed_root(lambda x: x, 0.0, 1.0) == 0.0
    assert bracketed_root(lambda x: x - 1.0, 0.0, 1.0) == 1.0


@pytest.mark.parametrize("limit", [0.3, 1e-200, 1.0])
def test_the_first_true_point_is_found_from_either_side(limit):
    found = first_true(lambda x: x >= limit, 0.0, 1.0)
    assert found >= limit
    assert found == pytest.approx(limit, rel=1e-14, abs=0.0)
    found = first_true(lambda x: x <= limit, 2.0, 0.0)
    assert found <= limit
    assert found == pytest.approx(limit, rel=1e-14, abs=0.0)


# Step-size control --------------------------------------------------------------------------


@pytest.mark.parametrize("order", [2.0, 3.0, 4.0, 5.0])
def test_the_next_length_meets_the_tolerance_but_for_its_safety(order):
    control = StepSize(order=order, safety=0.9, shrink=0.1, grow=5.0, unsolved=0.5)
    for error in (1.01, 3.0, 20.0):
        assert (control.shorter(1.0, error) / 0.9) ** order * error == pytest.approx(1.0)
    assert control.shorter(2.0, 1e30) == pytest.approx(0.2)
    assert control.shorter(2.0, math.inf) == 1.0
    assert (control.following(1.0, 0.5) / 0.9) ** order * 0.5 == pytest.approx(1.0)
    assert control.following(2.0, 0.0) == control.following(2.0, 1e-300) == 10.0


def test_a_step_cut_short_does_not_shorten_the_next():
    control = StepSize(order=4.0)
    assert control.following(1e-9, 1e-3, planned=1.0) == 1.0
    assert control.following(1.0, 1e-3, planned=1e-9) > 1.0


# Events -------------------------------------------------------------------------------------


def test_the_first_event_on_the_way_is_met_in_either_direction():
    places = (3.0, 1.0, 2.0, math.inf)
    assert first_crossing(places, 0.5, 2.5, 1e-9) == 1.0
    assert first_crossing(places, 2.5, 0.5, 1e-9) == 2.0
    assert first_crossing(places, 1.0, 2.0, 1e-9) == 2.0  # behind, and at the very end
    assert first_crossing(places, 1.0 + 1e-12, 1.5, 1e-9) is None
    assert first_crossing(places, 3.5, 4.0, 1e-9) is None


@pytest.mark.parametrize("power", [1.0, 2.0, 7.0, 0.2])
def test_a_step_ends_at_the_event(power):
    calls = []

    def attempt(length):
        calls.append(length)
        return length**power

    taken, length = step_to_event(attempt, lambda x: x / 0.3 - 1.0, -1.0, 1.0, 1.0, 1e-13)
    assert taken == attempt(length) == pytest.approx(0.3, rel=1e-12)
    assert len(calls) < 40


def test_secants_that_stall_do_not_lose_the_event():
    """A flat approach from beyond, a steep one from before: secants crawl down the flat side."""
    calls = []

    def miss(x):
        calls.append(x)
        return (x - 0.3) ** 7 if x > 0.3 else -((0.3 - x) ** 0.2)

    taken, _ = step_to_event(lambda x: x, miss, miss(0.0), 1.0, 1.0, 1e-30)
    assert taken == pytest.approx(0.3, abs=1e-4)
    assert len(calls) < 60


def test_an_event_is_met_although_long_steps_cannot_be_solved():
    taken, _ = step_to_event(
        lambda x: x * x if x < 0.6 else None, lambda x: x / 0.3 - 1.0, -1.0, 1.0, 1.0, 1e-13
    )
    assert taken == pytest.approx(0.3, rel=1e-12)
