"""Roots in a bracket, without scipy: for code that runs in FMUs and in kernels of plain floats."""

from __future__ import annotations

import math
from collections.abc import Callable

__all__ = ["bracketed_root", "first_true", "newton_root"]


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
