"""Exact bridges of given pressure at asperities: force curve, and average over the heights."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray
from scipy.interpolate import CubicSpline

from ..errors import ConvergenceError
from ..numerics.quadrature import gauss_legendre
from .asperities import normal_tail
from .condensed import max_gap_on_sphere
from .exact.at_pressure import bridge_at_pressure

__all__ = ["force_curve", "gaussian_average"]

Floats = NDArray[np.float64]

# Nodes of the curve of a force: 65 are enough for 1e-6 and 129 for 1e-8 in common cases. A curve
# that asks for more has a kink, and is refused.
_MAX_NODES = 2049
# Of the square of a normal variable: exp(-40) is neglected. 40 leave 1e-12 of an average, 20 leave
# 2e-4; wider, nodes go where nothing is.
_SPAN = 80.0


class ForceCurve(NamedTuple):
    """Force over surface tension [m] of a bridge over the gap [m], up to its maximum gap [m]."""

    force: Callable[[Floats], Floats]
    reach: float


def force_curve(
    pressure: float, angles: tuple[float, float], curvature: float, rtol: float
) -> ForceCurve:
    """Force of a bridge of given pressure, over the surface tension [1/m], as a curve.

    The curve is in the square root of the distance to the maximum gap, where the slope of the force
    is infinite; nodes are doubled until the curve agrees with the bridge at the midpoints.

    Raises
    ------
    ConvergenceError
        If the force is not smooth enough for a curve.
    """
    reach = max_gap_on_sphere(pressure, *angles, curvature)

    def force(left: Floats) -> Floats:
        gap = np.maximum(reach * (1.0 - left * left), 0.0)
        return np.asarray(bridge_at_pressure(gap, pressure, *angles, 0.0, curvature).force)

    nodes, error = 17, math.inf
    while error > rtol and 2 * nodes - 1 <= _MAX_NODES:
        left = np.linspace(1e-3, 1.0, 2 * nodes - 1)
        value = force(left)
        coarse = CubicSpline(left[::2], value[::2])
        error = float(np.max(np.abs(coarse(left[1::2]) - value[1::2])) / np.max(np.abs(value)))
        nodes = 2 * nodes - 1
    if error > max(rtol, 1e-6):
        raise ConvergenceError(
            f"the meniscus force at an asperity is rough: {error:.1e} off; take the thin film, "
            f"AsperityMenisci(profile='thin-film'), or asperities of a smaller radius"
        )
    fine = CubicSpline(left, value)

    def curve(gap: Floats) -> Floats:
        return np.asarray(fine(np.sqrt(np.maximum(1.0 - gap / reach, 0.0))))

    return ForceCurve(curve, reach)


def gaussian_average(
    force: Callable[[Floats], Floats], reach: float, separation: float, spread: float
) -> float:
    r"""Mean of a force over summits of normal heights; in contact it is that at zero gap.

    .. math:: \int_0^{D_{max}} F(D)\, \phi\Bigl(\frac{d - D}{\sigma}\Bigr) \frac{dD}{\sigma}
              + F(0)\, Q(d/\sigma)
    """
    a, b = (separation - reach) / spread, separation / spread
    low, high = max(a, -math.sqrt(_SPAN)), min(b, math.sqrt(max(a, 0.0) ** 2 + _SPAN))
    touching = float(force(np.zeros(()))) * normal_tail(b)
    if high <= low:
        return touching
    nodes, weights = map(np.array, gauss_legendre(64))
    # In the square root of the distance to the maximum gap the force is smooth.
    first, last = math.sqrt((low - a) * spread / reach), math.sqrt((high - a) * spread / reach)
    left = first + (last - first) * nodes
    t = a + left * left * reach / spread
    density = np.exp(-0.5 * t * t) / math.sqrt(2.0 * math.pi)
    gap = separation - spread * t
    step = 2.0 * left * (reach / spread) * (last - first)
    return touching + float((weights * step * density * force(gap)).sum())
