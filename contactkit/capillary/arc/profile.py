r"""Meridian curve (profile) of a liquid bridge in the circular approximation.

Conventions: body 1 lies below, body 2 above; contact angles run through the liquid; lengths in
metres.

.. math::
    r(t) = x_1 + Y\,\frac{\cos(p_1 + t\delta)}{\sin(p_1 + \delta)}\frac{\sin t\delta}{\sin\delta},
    \quad
    z(t) = Y\,\frac{\sin(p_1 + t\delta)}{\sin(p_1 + \delta)}\frac{\sin t\delta}{\sin\delta},
    \quad 2\delta = p_2 - p_1

with the tangent angles :math:`p_1 = \pi - \theta_1 - \beta_1` and :math:`p_2 = \theta_2 + \beta_2`
at the contact circles, whose bodies have the slopes :math:`\beta_i`.
"""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from ...errors import DescriptionError
from . import sphere as arc_sphere
from .bridge import arc_bridge

__all__ = ["arc_profile"]

Array = NDArray[np.float64]


def arc_profile(
    gap: float,
    volume: float,
    angle_lower: float,
    angle_upper: float,
    curvature_lower: float = 0.0,
    curvature_upper: float = 0.0,
    count: int = 101,
) -> tuple[Array, Array]:
    """Points on the meridian of one circular bridge, from the lower to the upper contact circle.

    Parameters
    ----------
    gap : float
        Shortest distance of the bodies [m]; zero only if one of them is curved.
    volume : float
        Volume of the liquid [m^3].
    angle_lower, angle_upper : float
        Contact angles [rad].
    curvature_lower, curvature_upper : float
        Curvature 1/R of the bodies [1/m], zero for a flat.
    count : int
        Number of points, two at least, at equal angles along the arc.

    Returns
    -------
    radius, height : ndarray, shape (count,)
        Distance from the axis [m] and height above the lower contact circle [m].

    Raises
    ------
    InfeasibleError
        If there is no arc, as of `arc_bridge`.
    DescriptionError
        If `count` is below two, or an argument is invalid.

    Notes
    -----
    The form of the chord is regular for straight arcs, and encloses the volume to round-off. It is
    the circle of Eq. (3.38) with the end conditions of Eq. (3.39), for any contact angles.

    References
    ----------
    .. [1] Cai and Bhushan (2007a); Eqs. (3.37)-(3.41) of the dissertation.

    Examples
    --------
    >>> r, z = arc_profile(2e-9, 6e-23, math.pi / 3, math.pi / 3, count=3)
    >>> [round(1e9 * float(x), 3) for x in (r[0] - r[1], z[1], z[2])]
    [0.268, 1.0, 2.0]
    """
    if count < 2:
        raise DescriptionError("arc_profile.count", count, "be two at least")
    bodies = (curvature_lower, curvature_upper)
    found = arc_bridge(gap, volume, angle_lower, angle_upper, *bodies)  # checks all arguments
    height, slopes = gap, (0.0, 0.0)
    if any(bodies):
        state = arc_sphere.solve(gap, volume, angle_lower, angle_upper, *bodies)
        height, slopes = float(state.height), (float(state.slope_lower), float(state.slope_upper))
    first, last = math.pi - angle_lower - slopes[0], angle_upper + slopes[1]
    half = 0.5 * (last - first)
    t = np.linspace(0.0, 1.0, count)
    along = np.sin(t * half) / math.sin(half) if half else t
    reach = height / math.sin(first + half) * along
    x = float(found.radius_lower) + reach * np.cos(first + t * half)
    return x, reach * np.sin(first + t * half)
