"""Exact bridges of one pressure at the asperities of a rough surface: one, and their average."""

from __future__ import annotations

import math
from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray
from scipy.interpolate import CubicSpline

from ..errors import ConvergenceError
from .asperities import normal_tail
from .condensed import reach_at_pressure
from .exact.at_pressure import bridge_at_pressure

__all__ = ["force_curve", "gaussian_average"]

Floats = NDArray[np.float64]

_MOST_NODES = 2049
_SPAN = 80.0  # of the square of a normal variable: exp(-40) is left out


def force_curve(
    pressure: float, angles: tuple[float, float], curvature: float, rtol: float
) -> tuple[Callable[[Floats], Floats], float]:
    """Force over surface tension [m] of one bridge of a pressure [1/m], and how far it reaches [m].

    The curve is in the root of the way that is left to the end, where the slope of the force is
    infinite; its nodes are doubled until it agrees with the bridge at the midpoints.

    Raises
    ------
    ConvergenceError
        If the force is not smooth enough for a curve.
    """
    reach = reach_at_pressure(pressure, *angles, curvature)

    def force(left: Floats) -> Floats:
        gap = np.maximum(reach * (1.0 - left * left), 0.0)
        return np.asarray(bridge_at_pressure(gap, pressure, *angles, 0.0, curvature).force)

    nodes, error = 17, math.inf
    while error > rtol and 2 * nodes - 1 <= _MOST_NODES:
        left = np.linspace(1e-3, 1.0, 2 * nodes - 1)
        value = force(left)
        coarse = CubicSpline(left[::2], value[::2])
        error = float(np.max(np.abs(coarse(left[1::2]) - value[1::2])) / np.max(np.abs(value)))
        nodes = 2 * nodes - 1
    if error > max(rtol, 1e-6):
        raise ConvergenceError(f"the meniscus force at an asperity is rough: {error:.1e} off")
    fine = CubicSpline(left, value)
    return lambda gap: np.asarray(fine(np.sqrt(np.maximum(1.0 - gap / reach, 0.0)))), reach


def gaussian_average(
    force: Callable[[Floats], Floats], reach: float, separation: float, spread: float
) -> float:
    r"""Mean of a force over summits of normal heights, those in contact having that of no gap.

    .. math:: \int_0^{D_{max}} F(D)\, \phi\Bigl(\frac{d - D}{\sigma}\Bigr) \frac{dD}{\sigma}
              + F(0)\, Q(d/\sigma)
    """
    a, b = (separation - reach) / spread, separation / spread
    low, high = max(a, -math.sqrt(_SPAN)), min(b, math.sqrt(max(a, 0.0) ** 2 + _SPAN))
    touching = float(force(np.zeros(()))) * normal_tail(b)
    if high <= low:
        return touching
    nodes, weights = _NODES
    # The root of what is left to the reach, in which the force is smooth.
    first, last = math.sqrt((low - a) * spread / reach), math.sqrt((high - a) * spread / reach)
    left = first + (last - first) * nodes
    t = a + left * left * reach / spread
    density = np.exp(-0.5 * t * t) / math.sqrt(2.0 * math.pi)
    gap = separation - spread * t
    step = 2.0 * left * (reach / spread) * (last - first)
    return touching + float((weights * step * density * force(gap)).sum())


def _unit_nodes(n: int) -> tuple[Floats, Floats]:
    x, w = np.polynomial.legendre.leggauss(n)
    return 0.5 * (x + 1.0), 0.5 * w


_NODES = _unit_nodes(64)
