r"""Curves through measured or solved points that keep the order of their values, without numpy.

Each piece is the cubic with given values and slopes at its ends. It rises throughout if both
slopes lie between 0 and three times the rise of the piece (Fritsch and Carlson); so slopes are
taken from the parabola through three points, good to second order, and cut to that range. A
curve that runs over decades is laid through the logarithms: a power law is then met exactly.
Plain floats: for laws that run where numpy is missing.
"""

from __future__ import annotations

import math
from bisect import bisect_right
from collections.abc import Callable, Sequence
from itertools import pairwise

from ..errors import DescriptionError

__all__ = ["monotone_curve", "monotone_slopes", "power_curve"]

Curve = Callable[[float], tuple[float, float]]


def monotone_slopes(nodes: Sequence[float], values: Sequence[float]) -> list[float]:
    """Slopes at the nodes with which cubics keep the order of the values.

    Parameters
    ----------
    nodes, values : sequence of float, length n >= 2
        Ascending nodes, and values that nowhere fall.

    Raises
    ------
    DescriptionError
        If there are fewer than two points, nodes do not ascend or values fall.

    Examples
    --------
    >>> monotone_slopes([0.0, 1.0, 2.0, 3.0], [0.0, 0.0, 1.0, 4.0])
    [0.0, 0.0, 2.0, 4.0]
    """
    if len(nodes) < 2 or len(nodes) != len(values):
        raise DescriptionError("monotone_slopes.nodes", len(nodes), "be two or more, one per value")
    if any(not a < b for a, b in pairwise(nodes)):
        raise DescriptionError("monotone_slopes.nodes", "out of order", "ascend")
    if any(not a <= b for a, b in pairwise(values)):
        raise DescriptionError("monotone_slopes.values", "falling", "nowhere fall")
    widths = [b - a for a, b in pairwise(nodes)]
    rises = [(b - a) / h for (a, b), h in zip(pairwise(values), widths, strict=True)]
    if len(rises) == 1:
        return [rises[0], rises[0]]
    inner = [
        (widths[i] * rises[i - 1] + widths[i - 1] * rises[i]) / (widths[i - 1] + widths[i])
        for i in range(1, len(rises))
    ]
    # The same parabola at both ends: its slope there differs from the rise as much as at the next.
    slopes = [2.0 * rises[0] - inner[0], *inner, 2.0 * rises[-1] - inner[-1]]
    least = [rises[0], *(min(pair) for pair in pairwise(rises)), rises[-1]]
    return [min(max(slope, 0.0), 3.0 * rise) for slope, rise in zip(slopes, least, strict=True)]


def monotone_curve(
    nodes: Sequence[float], values: Sequence[float], start: float | None = None
) -> Curve:
    """Curve through points that nowhere fall; constant beyond both ends.

    Parameters
    ----------
    nodes, values : sequence of float, length n >= 2
        Ascending nodes, and values that nowhere fall.
    start : float, optional
        Least slope at the first node, for what is known of it; cut as the others are.

    Returns
    -------
    callable
        Value and slope at a point.

    Raises
    ------
    DescriptionError
        See `monotone_slopes`.

    Examples
    --------
    >>> curve = monotone_curve([0.0, 1.0, 2.0], [0.0, 1.0, 4.0])
    >>> curve(1.5), curve(9.0)
    ((2.25, 3.0), (4.0, 0.0))
    """
    slopes = monotone_slopes(nodes, values)
    if start is not None:
        slopes[0] = min(
            max(slopes[0], start), 3.0 * (values[1] - values[0]) / (nodes[1] - nodes[0])
        )
    pieces = []
    for i, (a, b) in enumerate(pairwise(nodes)):
        h, low, high = b - a, slopes[i], slopes[i + 1]
        rise = (values[i + 1] - values[i]) / h
        bend, twist = (3.0 * rise - 2.0 * low - high) / h, (low + high - 2.0 * rise) / (h * h)
        pieces.append((a, values[i], low, bend, twist))
    inner, first, last = tuple(nodes[1:-1]), nodes[0], nodes[-1]
    lowest, highest = values[0], values[-1]

    def curve(x: float) -> tuple[float, float]:
        if x < first:
            return lowest, 0.0
        if x > last:
            return highest, 0.0
        x0, y0, slope, bend, twist = pieces[bisect_right(inner, x)]
        t = x - x0
        value = y0 + t * (slope + t * (bend + t * twist))
        return min(max(value, lowest), highest), max(
            slope + t * (2.0 * bend + 3.0 * t * twist), 0.0
        )

    return curve


def power_curve(nodes: Sequence[float], values: Sequence[float], exponent: float = 0.0) -> Curve:
    r"""Curve through positive points that nowhere fall, laid through their logarithms.

    Below the first node it is the power law :math:`y_1 (x/x_1)^p` that meets the next piece
    without a kink, down to 0 at 0; beyond the last node it is its tangent.

    Parameters
    ----------
    nodes, values : sequence of float, length n >= 2
        Positive ascending nodes, and positive values that nowhere fall.
    exponent : float
        Least exponent p of the start [-].

    Returns
    -------
    callable
        Value and slope at a point; both zero up to 0.

    Raises
    ------
    DescriptionError
        If a node or a value is not positive; see also `monotone_slopes`.

    Examples
    --------
    >>> curve = power_curve([1.0, 2.0, 5.0], [1.0, 4.0, 25.0])
    >>> [round(y, 12) for x in (0.1, 3.0) for y in curve(x)], curve(-1.0)
    ([0.01, 0.2, 9.0, 6.0], (0.0, 0.0))
    """
    if min(*nodes, *values) <= 0.0:
        raise DescriptionError("power_curve", min(*nodes, *values), "have positive points")
    logs = [math.log(x) for x in nodes]
    inside = monotone_curve(logs, [math.log(y) for y in values], exponent)
    first, last = nodes[0], nodes[-1]
    lowest, power = values[0], inside(logs[0])[1]
    highest, tangent = values[-1], inside(logs[-1])[1] * values[-1] / nodes[-1]

    def curve(x: float) -> tuple[float, float]:
        if x <= 0.0:
            return 0.0, 0.0
        if x <= first:
            value = lowest * (x / first) ** power
            return value, power * value / x
        if x >= last:
            return highest + tangent * (x - last), tangent
        log, slope = inside(math.log(x))
        value = math.exp(log)
        return value, slope * value / x

    return curve
