r"""A cubic spline through points, without numpy: for laws that run where numpy is missing.

Not-a-knot at both ends, so that a cubic is met exactly; the error falls as the fourth power of
the spacing everywhere.
"""

from __future__ import annotations

from bisect import bisect_right
from collections.abc import Callable, Sequence
from itertools import pairwise

from ..errors import DescriptionError

__all__ = ["cubic_spline"]

_Piece = tuple[float, float, float, float, float]
"""Start of a piece of a curve, and the coefficients of its cubic."""


def cubic_spline(
    nodes: Sequence[float], values: Sequence[float]
) -> Callable[[float], tuple[float, float]]:
    """Curve through `values` at ascending `nodes`; it continues as a cubic beyond the ends.

    Parameters
    ----------
    nodes, values : sequence of float, length n >= 4
        Where the curve is known.

    Returns
    -------
    callable
        Value and slope of the curve at a point.

    Raises
    ------
    DescriptionError
        If there are fewer than four points, or the nodes do not ascend.

    Examples
    --------
    >>> curve = cubic_spline([0.0, 1.0, 1.5, 3.0, 4.0], [0.0, 1.0, 3.375, 27.0, 64.0])
    >>> [round(x, 12) for x in curve(2.0)]
    [8.0, 12.0]
    """
    if len(nodes) < 4 or len(nodes) != len(values):
        raise DescriptionError("cubic_spline.nodes", len(nodes), "be four or more, one per value")
    if any(not a < b for a, b in pairwise(nodes)):
        raise DescriptionError("cubic_spline.nodes", "out of order", "ascend")
    slopes = _slopes(nodes, values)
    inner = tuple(nodes[1:-1])
    pieces = [
        _piece(nodes[i], nodes[i + 1], values[i], values[i + 1], slopes[i], slopes[i + 1])
        for i in range(len(nodes) - 1)
    ]

    def curve(x: float) -> tuple[float, float]:
        x0, a, b, c, d = pieces[bisect_right(inner, x)]
        t = x - x0
        return a + t * (b + t * (c + t * d)), b + t * (2.0 * c + 3.0 * t * d)

    return curve


def _piece(x0: float, x1: float, y0: float, y1: float, m0: float, m1: float) -> _Piece:
    """Start and coefficients of the cubic with given values and slopes at two points."""
    h = x1 - x0
    rise = (y1 - y0) / h
    return x0, y0, m0, (3.0 * rise - 2.0 * m0 - m1) / h, (m0 + m1 - 2.0 * rise) / (h * h)


def _slopes(x: Sequence[float], y: Sequence[float]) -> list[float]:
    """Slopes at the nodes that make the second derivative continuous, and the third at both ends.

    The two end conditions couple three unknowns each; one elimination makes them couple two.
    """
    # Not-a-knot, as the slopes at the ends are not known: natural ends (zero curvature) would leave
    # an error of second order there. The slopes are the unknowns, as curves give value and slope.
    n = len(x)
    h = [x[i + 1] - x[i] for i in range(n - 1)]
    rise = [(y[i + 1] - y[i]) / h[i] for i in range(n - 1)]
    diagonal, above, right = [0.0] * n, [0.0] * n, [0.0] * n
    diagonal[0], above[0] = h[1], h[0] + h[1]
    right[0] = ((h[0] + 2.0 * above[0]) * h[1] * rise[0] + h[0] ** 2 * rise[1]) / above[0]
    below = [0.0] * n
    for i in range(1, n - 1):
        below[i], diagonal[i], above[i] = h[i], 2.0 * (h[i - 1] + h[i]), h[i - 1]
        right[i] = 3.0 * (h[i] * rise[i - 1] + h[i - 1] * rise[i])
    below[-1], diagonal[-1] = h[-1] + h[-2], h[-2]
    right[-1] = ((h[-1] + 2.0 * below[-1]) * h[-2] * rise[-1] + h[-1] ** 2 * rise[-2]) / below[-1]
    for i in range(1, n):
        factor = below[i] / diagonal[i - 1]
        diagonal[i] -= factor * above[i - 1]
        right[i] -= factor * right[i - 1]
    slopes = [0.0] * n
    slopes[-1] = right[-1] / diagonal[-1]
    for i in range(n - 2, -1, -1):
        slopes[i] = (right[i] - above[i] * slopes[i + 1]) / diagonal[i]
    return slopes
