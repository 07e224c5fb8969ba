"""Gauss-Legendre and Gauss-Lobatto quadrature on the unit interval, without numpy.

It serves kernels that must also run in a bare interpreter; numpy users may wrap the tuples in
arrays. Nodes ascend and weights sum to one.
"""

from __future__ import annotations

import math
from functools import lru_cache

__all__ = ["LOBATTO_5", "gauss_legendre"]

_INNER = 0.5 * math.sqrt(3.0 / 7.0)
LOBATTO_5 = (
    (0.0, 0.5 - _INNER, 0.5, 0.5 + _INNER, 1.0),
    (1.0 / 20.0, 49.0 / 180.0, 16.0 / 45.0, 49.0 / 180.0, 1.0 / 20.0),
)
"""Nodes and weights of Lobatto's rule of five points, exact to the seventh power."""


def _legendre(degree: int, x: float) -> tuple[float, float]:
    """Legendre polynomial and its slope at -1 < x < 1, by the three-term recurrence."""
    below, here = 1.0, x
    for k in range(2, degree + 1):
        below, here = here, ((2 * k - 1) * x * here - (k - 1) * below) / k
    return here, degree * (below - x * here) / (1.0 - x * x)


@lru_cache(maxsize=32)
def gauss_legendre(count: int) -> tuple[tuple[float, ...], tuple[float, ...]]:
    r"""Nodes and weights that integrate polynomials of degree ``2 count - 1`` exactly.

    .. math:: \int_0^1 f(t)\,dt \approx \sum_i w_i f(t_i)

    Parameters
    ----------
    count : int
        Number of nodes, at least 1.

    Returns
    -------
    nodes, weights : tuple of float, length `count`
        Ascending nodes inside (0, 1) and their weights [-].

    Notes
    -----
    The roots of the Legendre polynomial are polished by Newton's method; nodes and weights are
    right to about 1e-15 up to a hundred nodes, far beyond what smooth profiles need. A wave
    ``exp(i w t)`` is integrated to 1e-15 once `count` exceeds about ``w / 2 + 8``.

    References
    ----------
    .. [1] Abramowitz and Stegun, Handbook of Mathematical Functions, 25.4.29-25.4.30.

    Examples
    --------
    >>> nodes, weights = gauss_legendre(5)
    >>> round(sum(w * t**9 for t, w in zip(nodes, weights)), 15)
    0.1
    """
    nodes, weights = [], []
    for i in range(count):
        # A guess to 0.12/count^2, far less than the distance of two roots: Newton needs no bracket.
        x = -math.cos(math.pi * (i + 0.75) / (count + 0.5))
        for _ in range(100):
            value, slope = (x, 1.0) if count == 1 else _legendre(count, x)
            x -= value / slope
            if abs(value / slope) <= 2e-16:
                break
        slope = 1.0 if count == 1 else _legendre(count, x)[1]
        nodes.append(0.5 + 0.5 * x)
        weights.append(1.0 / ((1.0 - x * x) * slope * slope))
    return tuple(nodes), tuple(weights)
