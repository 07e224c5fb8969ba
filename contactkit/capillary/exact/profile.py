r"""Meridian curve (profile) of a solved liquid bridge.

Conventions: lengths in metres; the arc length s counts from the neck upwards.

.. math:: r(s) = \sqrt{a^2 + e s^2 \operatorname{sinc}^2(ps/2a)}, \quad p = 1 - e
"""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from ...errors import DescriptionError
from ...numerics.quadrature import gauss_legendre
from .chart import ARRAYS
from .delaunay import integrand, is_round
from .result import ExactBridge

__all__ = ["profile"]

Array = NDArray[np.float64]

# Between two points of a curve: 3 leave 1e-15 with a hundred points; 6 leave 6e-15 with three
# points, the fewest that make a curve.
_NODES = 8


def profile(state: ExactBridge, count: int = 101) -> tuple[Array, Array]:
    """Points on the meridian of one bridge, from the lower to the upper contact circle.

    Parameters
    ----------
    state : ExactBridge
        One bridge, with numbers or arrays of one element.
    count : int
        Number of points, two at least; they are denser where the neck is narrow.

    Returns
    -------
    radius, height : ndarray, shape (count,)
        Distance from the axis [m] and height above the lower contact circle [m].

    Raises
    ------
    DescriptionError
        If `state` holds more than one bridge or none, or `count` is below two.

    Notes
    -----
    The radius is a closed form, the height an integral accurate to round-off for a hundred points.

    References
    ----------
    .. [1] Delaunay (1841), J. Math. Pures Appl. 6.

    Examples
    --------
    >>> from contactkit.capillary.exact.bridge import bridge
    >>> r, z = profile(bridge(0.5, 1.0, 1.0, 1.2), 41)
    >>> round(float(z[-1]), 12)
    0.5
    """
    if count < 2:
        raise DescriptionError("profile.count", count, "be two at least")
    if np.size(state.neck_radius) != 1 or not np.isfinite(state.neck_radius).all():
        raise DescriptionError(
            "profile.state", np.shape(state.neck_radius), "hold one bridge that exists"
        )
    a, e, below, above = (
        float(np.ravel(value)[0])
        for value in (state.neck_radius, state.shape, state.arc_lower, state.arc_upper)
    )
    p, from_bulge = 1.0 - e, bool(is_round(e))

    def stretched(arc: float) -> float:
        return math.asinh(math.tan(0.5 * p * arc) if from_bulge else arc * math.sqrt(e))

    v = np.linspace(-stretched(below / a), stretched(above / a), count)
    nodes, weights = (np.array(values) for values in gauss_legendre(_NODES))
    step = (v[-1] - v[0]) / (count - 1)
    inside = v[:-1, None] + step * nodes
    one_plus_cosine = integrand(ARRAYS, np.float64(e), inside, from_bulge=from_bulge)[0] @ weights
    s = 2.0 / p * np.arctan(np.sinh(v)) if from_bulge else np.sinh(v) / math.sqrt(e)
    s[0], s[-1] = -below / a, above / a
    chord = s * np.sinc(0.5 * p * s / np.pi)
    height = np.concatenate(([0.0], np.cumsum(one_plus_cosine) * step))
    return a * np.sqrt(1.0 + e * chord * chord), a * height
