"""A bracketed root of a function of one float, for kernels that run where scipy does not."""

from __future__ import annotations

import math
from collections.abc import Callable

__all__ = ["bracketed_root"]


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
