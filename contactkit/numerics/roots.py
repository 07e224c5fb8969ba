"""Roots in a bracket, without scipy: for code that runs in FMUs and in kernels of plain floats."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Generic, NamedTuple, TypeVar

__all__ = ["Bracket", "Probe", "balance", "bracketed_root", "first_true", "newton_root"]

Value = TypeVar("Value")


def bracketed_root(
    function: Callable[[float], float], low: float, high: float, rtol: float = 4e-16
) -> float:
    """Root of `function` between `low` and `high`, where it has opposite signs (or is zero).

    Illinois false position, halved whenever it does not at least halve the bracket in three
    evaluations: never more than three times the work of bisection, and never outside the bracket.

    Examples
    --------
    >>> round(bracketed_root(lambda x: x * x - 2.0, 0.0, 2.0), 12)
    1.414213562373
    """
    f_low, f_high = function(low), function(high)
    if f_low == 0.0:
        return low
    if f_high == 0.0:
        return high
    # Plain false position keeps one end for ever on a convex function; halving its value (Illinois)
    # makes the order 1.44. On steep or flat functions it still creeps: hence the bisection.
    width, since = abs(high - low), 0
    while abs(high - low) > rtol * max(abs(low), abs(high)):
        since += 1
        x = high - f_high * (high - low) / (f_high - f_low)
        if since > 2 or not min(low, high) < x < max(low, high):
            x = 0.5 * (low + high)
            if x in (low, high):
                break
        f = function(x)
        if f == 0.0:
            return x
        if math.copysign(1.0, f) == math.copysign(1.0, f_high):
            f_low *= 0.5
        else:
            low, f_low = high, f_high
        high, f_high = x, f
        if abs(high - low) <= 0.5 * width:
            width, since = abs(high - low), 0
    return high


def first_true(
    condition: Callable[[float], bool],
    low: float,
    high: float,
    *,
    rtol: float = 1e-15,
    atol: float = 0.0,
) -> float:
    """Least point at which a condition holds that does at `high` and not at `low`, by bisection.

    It holds at the point returned, and no longer at one that is less by `atol`, or by `rtol` of
    it. `high` may be less than `low`: then it is the largest such point.

    Examples
    --------
    >>> round(first_true(lambda x: x * x >= 2.0, 0.0, 2.0), 12)
    1.414213562373
    """
    while abs(high - low) > max(rtol * max(abs(low), abs(high)), atol):
        middle = 0.5 * (low + high)
        if middle in (low, high):
            break
        if condition(middle):
            high = middle
        else:
            low = middle
    return high


def newton_root(
    function: Callable[[float], tuple[float, float]],
    low: float,
    high: float,
    start: float,
    rtol: float = 4e-16,
) -> float:
    """Root of a function that rises through zero between `low` and `high`: Newton, bracketed.

    `function` gives the value and the slope; a step that would leave the bracket halves it.

    Examples
    --------
    >>> round(newton_root(lambda x: (x * x - 2.0, 2.0 * x), 0.0, 2.0, 1.0), 12)
    1.414213562373
    """
    # The bracket closes with every value, from one side mostly: it serves to halve steps that fail,
    # not to tell convergence, which is by the size of a step.
    x = start
    for _ in range(100):
        value, slope = function(x)
        low, high = (low, x) if value > 0.0 else (x, high)
        guess = x - value / slope if slope > 0.0 else math.nan
        if not low <= guess <= high:
            guess = 0.5 * (low + high)
        x, moved = guess, abs(guess - x)
        if moved <= rtol * abs(x):
            break
    return x


class Probe(NamedTuple, Generic[Value]):
    """Excess at a point, in the unit of the point, and whatever was computed for it.

    `is_final` ends the search: what was computed is no use.
    """

    at: float
    excess: float
    value: Value
    is_final: bool = False


class Bracket(Generic[Value]):
    """Interval around a balance: the excess is positive at its lower end, negative at the upper.

    Parameters
    ----------
    low, high : float
        Ends, which need not have been tried.

    Attributes
    ----------
    below, above : Probe or None
        Probes at the ends, where they have been tried.
    before : Probe or None
        The one that was at the lower end before `below`.
    last : tuple of Probe
        The last two, the newest first.
    """

    def __init__(self, low: float, high: float) -> None:
        self.low, self.high = low, high
        self.below: Probe[Value] | None = None
        self.above: Probe[Value] | None = None
        self.before: Probe[Value] | None = None
        self.last: tuple[Probe[Value], ...] = ()

    def take(self, probe: Probe[Value]) -> None:
        """Shorten the interval to the side of the balance."""
        self.last = (probe, *self.last[:1])
        if probe.excess >= 0.0:
            self.before = self.below
            self.low, self.below = probe.at, probe
        else:
            self.high, self.above = probe.at, probe

    @property
    def best(self) -> Probe[Value]:
        """Probe nearest to balance of those at the ends."""
        tried = [one for one in (self.below, self.above) if one is not None]
        return min(tried, key=lambda one: abs(one.excess))

    def holds(self, x: float) -> bool:
        """Whether a point lies inside, or at an end that has not been tried."""
        is_low = x == self.low and self.below is None
        return self.low < x < self.high or is_low or (x == self.high and self.above is None)

    def is_settled(self, rtol: float) -> bool:
        """Whether a probe balances, or the balance lies between two points that are about one."""
        balances = abs(self.best.excess) <= rtol * self.best.at
        return balances or self.high - self.low <= rtol * self.high


def balance(
    evaluate: Callable[[float, float], Probe[Value] | None],
    bracket: Bracket[Value],
    guess: Callable[[Bracket[Value]], float],
    rtol: float,
    *,
    max_iterations: int = 60,
) -> bool:
    """Shorten a bracket to a balance, by guesses that know more of the function than its sign.

    For functions so expensive that each evaluation counts: a guess may be a step of a fixed point,
    a secant, or the zero of a model of the function. One outside the bracket halves it.

    Parameters
    ----------
    evaluate : callable
        ``evaluate(x, excess)`` gives the probe at x; `excess` is the smallest so far, to choose a
        tolerance by. None where there is none, beyond the balance.
    bracket : Bracket
        With one probe at least; holds the balance in the end.
    guess : callable
        Next point, from the bracket.
    rtol : float
        Tolerance of the excess, or of the width of the bracket, over the point.
    max_iterations : int
        Maximum number of evaluations.

    Returns
    -------
    bool
        Whether it settled.

    Examples
    --------
    The load on a contact that pulls itself together by a force of a tenth of it:

    >>> bracket = Bracket(1.0, 2.0)
    >>> bracket.take(Probe(1.0, 0.1, None))
    >>> def probe(x, excess):
    ...     return Probe(x, 1.0 + 0.1 * x - x, None)
    >>> balance(probe, bracket, lambda now: now.low + now.below.excess, 1e-9)
    True
    >>> round(bracket.best.at, 8)
    1.11111111
    """
    for _ in range(max_iterations):
        if bracket.is_settled(rtol):
            return True
        x = guess(bracket)
        if not bracket.holds(x):
            x = 0.5 * (bracket.low + bracket.high)
        probe = evaluate(x, abs(bracket.best.excess))
        if probe is None:
            bracket.high = x
        else:
            bracket.take(probe)
            if probe.is_final:
                return False
    return bracket.is_settled(rtol)
