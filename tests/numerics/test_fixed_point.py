"""Fixed points of expensive maps, and balances in a bracket."""

import math

import numpy as np
import pytest

from contactkit.numerics.fixed_point import Anderson, Evaluation, Momentum, Plain, settle
from contactkit.numerics.roots import Bracket, Probe, balance

ALL = slice(None)


def linear(matrix, right, *, noise=0.0, seen=None):
    """The map x -> M x + b, evaluated with an error of the size that is allowed."""
    rng = np.random.default_rng(3)

    def evaluate(blocks, allowed):
        if seen is not None:
            seen.append(allowed)
        (x,) = blocks
        image = matrix @ x + right
        if noise:
            image = image + noise * min(allowed, 1.0) * rng.uniform(-1.0, 1.0, x.size)
        change = float(np.abs(image - x).max())
        return Evaluation((image,), (change,), (1.0,), is_exact=not noise or allowed == 0.0)

    return evaluate


def contraction(n, radius, seed=0):
    """A matrix of given spectral radius that is not symmetric."""
    made = np.random.default_rng(seed).normal(size=(n, n))
    return made * radius / np.abs(np.linalg.eigvals(made)).max()


@pytest.mark.parametrize("radius", [0.0, 0.3, 0.9, 0.98])
@pytest.mark.parametrize("accelerator", [Plain, Anderson])
def test_the_last_blocks_solve_the_linear_system(accelerator, radius):
    matrix, right = contraction(8, radius), np.arange(8.0)
    exact = np.linalg.solve(np.eye(8) - matrix, right)
    found = settle(
        linear(matrix, right),
        (np.zeros(8),),
        ((ALL, accelerator()),),
        1e-9,
        max_iterations=5000,
    )
    assert found.is_settled
    np.testing.assert_allclose(found.values[0], exact, atol=2e-8 * np.abs(exact).max())


def test_anderson_saves_most_evaluations_of_a_slow_map():
    matrix, right = contraction(8, 0.95), np.arange(8.0)
    counts = [
        settle(linear(matrix, right), (np.zeros(8),), ((ALL, one()),), 1e-9, max_iterations=5000)
        for one in (Plain, Anderson)
    ]
    plain, anderson = (one.n_evaluations for one in counts)
    assert anderson < 0.4 * plain


def test_the_stated_error_counts_what_slow_steps_leave():
    """The last change of a map that contracts by 0.99 is a hundredth of its error."""
    matrix = np.diag([0.99, 0.5])
    found = settle(
        linear(matrix, np.ones(2)), (np.zeros(2),), ((ALL, Plain()),), 1e-6, max_iterations=5000
    )
    assert found.values[0] == pytest.approx([100.0, 2.0], abs=2e-6)


def test_evaluations_are_loose_at_first_and_exact_at_the_end():
    seen = []
    matrix, right = contraction(6, 0.5), np.ones(6)
    exact = np.linalg.solve(np.eye(6) - matrix, right)
    found = settle(
        linear(matrix, right, noise=0.3, seen=seen), (np.zeros(6),), ((ALL, Anderson()),), 1e-8
    )
    assert found.is_settled
    assert math.isinf(seen[0])
    assert seen[-1] == 0.0
    assert 0.0 < seen[1] < 1.0
    np.testing.assert_allclose(found.values[0], exact, atol=1e-7)


def test_a_map_that_enlarges_its_errors_is_evaluated_better_and_better():
    seen = []
    found = settle(
        linear(np.diag([0.2]), np.ones(1), noise=30.0, seen=seen),
        (np.zeros(1),),
        ((ALL, Plain()),),
        1e-6,
        max_iterations=200,
    )
    assert found.is_settled
    ratios = [one for one in seen if 0.0 < one < math.inf]
    assert ratios[-1] < 1e-3 * ratios[0]


def test_blocks_of_other_units_settle_together():
    """Two unknowns that act on each other, one of order 1e9 and one of order 1e-9."""

    def evaluate(blocks, allowed):
        pressure, length = blocks
        images = (1e9 + 0.5e18 * length, 1e-9 - 0.5e-18 * pressure)
        scales = (1e9, 1e-9)
        changes = tuple(
            float(np.abs(image - block).max()) / scale
            for image, block, scale in zip(images, blocks, scales, strict=True)
        )
        return Evaluation(images, changes, scales)

    found = settle(evaluate, (np.zeros(2), np.zeros(2)), ((ALL, Anderson()),), 1e-10)
    # P = 1 + L/2 and L = 1 - P/2 in units of 1e9 and 1e-9.
    np.testing.assert_allclose(found.values[0], 1.2e9, rtol=1e-9)
    np.testing.assert_allclose(found.values[1], 0.4e-9, rtol=1e-9)
    assert found.n_evaluations < 8


def test_momentum_stays_on_the_side_of_the_fixed_point_that_it_comes_from():
    """x <- x^2/4 + 3/4 has fixed points 1 and 3: all starts below 3 lead to 1."""

    def evaluate(blocks, allowed):
        image = 0.25 * blocks[0] ** 2 + 0.75
        return Evaluation((image,), (float(np.abs(image - blocks[0]).max()),), (1.0,))

    for start in (0.0, 2.9):
        seen = []

        def watched(blocks, allowed, seen=seen):
            seen.append(float(blocks[0][0]))
            return evaluate(blocks, allowed)

        found = settle(watched, (np.full(1, start),), ((ALL, Momentum()),), 1e-9)
        plain = settle(evaluate, (np.full(1, start),), ((ALL, Plain()),), 1e-9)
        assert found.values[0][0] == pytest.approx(1.0, abs=1e-8)
        assert found.n_evaluations < plain.n_evaluations
        assert max(seen) < 3.0


def test_accelerated_blocks_are_moved_to_where_the_map_is_defined():
    """The root of x = cos(x)^2 by a map that refuses negative values."""

    def evaluate(blocks, allowed):
        x = blocks[0]
        assert (x >= 0.0).all()
        image = np.cos(3.0 * x) ** 2
        return Evaluation((image,), (float(np.abs(image - x).max()),), (1.0,))

    found = settle(
        evaluate,
        (np.full(1, 0.1),),
        ((ALL, Anderson()),),
        1e-12,
        admit=lambda blocks, images: (np.maximum(blocks[0], 0.0),),
        max_iterations=200,
    )
    x = found.values[0][0]
    assert math.cos(3.0 * x) ** 2 == pytest.approx(x, abs=1e-11)


def test_blocks_that_fall_to_nothing_settle_though_their_scale_does_too():
    """As displacements do when the contact under them opens."""
    tiny = float(np.finfo(float).tiny)

    def evaluate(blocks, allowed):
        change = float(np.abs(blocks[0]).max()) / 1e-30
        scale = 1e-30 if change > 0.0 else tiny
        return Evaluation((np.zeros(3),), (change,), (scale,), is_exact=allowed == 0.0)

    with np.errstate(all="raise"):
        found = settle(evaluate, (np.full(3, 1e-10),), ((ALL, Anderson()),), 1e-6)
    assert found.is_settled
    assert not found.values[0].any()


def test_what_does_not_settle_or_fails_is_reported():
    away = linear(np.diag([-3.0]), np.ones(1))
    found = settle(away, (np.zeros(1),), ((ALL, Plain()),), 1e-9, max_iterations=7)
    assert (found.is_settled, found.n_evaluations) == (False, 7)

    def fails(blocks, allowed):
        return Evaluation(blocks, (0.0,), (1.0,), is_failed=True)

    found = settle(fails, (np.zeros(1),), ((ALL, Plain()),), 1e-9)
    assert (found.is_settled, found.n_evaluations) == (False, 1)


def test_a_map_without_unknowns_is_evaluated_once():
    found = settle(lambda blocks, allowed: Evaluation((), (), ()), (), (), 1e-9)
    assert (found.is_settled, found.n_evaluations) == (True, 1)


# Balances -----------------------------------------------------------------------------------


def searched(function, low, high, guess, rtol=1e-9, **given):
    """Balance of an excess, and the points tried."""
    tried = []

    def probe(x, excess):
        tried.append(x)
        return Probe(x, function(x), x)

    bracket = Bracket(low, high)
    bracket.take(probe(low, 0.0))
    is_settled = balance(probe, bracket, guess, rtol, **given)
    return is_settled, bracket, tried


def test_a_fixed_point_step_that_stays_inside_is_taken():
    is_settled, bracket, tried = searched(
        lambda x: 1.0 + 0.1 * x - x, 1.0, 2.0, lambda now: now.low + now.below.excess
    )
    assert is_settled
    assert bracket.best.at == pytest.approx(1.0 / 0.9, rel=2e-9)
    assert len(tried) < 12


@pytest.mark.parametrize("bad", [math.nan, -1.0, 5.0])
def test_a_guess_outside_halves_the_bracket(bad):
    is_settled, bracket, tried = searched(
        lambda x: 2.0 - x * x, 1.0, 2.0, lambda now: bad, max_iterations=80
    )
    assert is_settled
    assert bracket.best.at == pytest.approx(math.sqrt(2.0), rel=2e-9)
    assert tried[1:3] == [1.5, 1.25]


def test_a_step_of_the_excess_is_held_between_its_sides():
    is_settled, bracket, _ = searched(
        lambda x: 1.0 if x < 1.3 else -1.0, 1.0, 2.0, lambda now: math.nan
    )
    assert is_settled
    assert bracket.low < 1.3 <= bracket.high
    assert bracket.high - bracket.low < 2e-9


def test_where_nothing_can_be_computed_the_balance_lies_below():
    def probe(x, excess):
        return None if x > 1.7 else Probe(x, 1.6 - x, x)

    bracket = Bracket(1.0, 4.0)
    bracket.take(probe(1.0, 0.0))
    assert balance(probe, bracket, lambda now: math.nan, 1e-9)
    assert bracket.best.at == pytest.approx(1.6, rel=1e-8)


def test_an_end_that_has_not_been_tried_may_be():
    bracket = Bracket(1.0, 2.0)
    bracket.take(Probe(2.0, -0.5, None))
    assert bracket.holds(1.0)
    assert not bracket.holds(2.0)
    bracket.take(Probe(1.0, 0.5, None))
    assert not bracket.holds(1.0)


def test_a_final_probe_ends_the_search():
    bracket = Bracket(1.0, 2.0)
    bracket.take(Probe(1.0, 0.5, None))
    assert not balance(lambda x, excess: Probe(x, 0.0, None, True), bracket, lambda now: 1.5, 1e-9)
    assert bracket.last[0].at == 1.5
