r"""Geometry of a circular meridian between two flats at unit gap, from the contact angles.

Conventions: body 1 lies below, body 2 above; contact angles run through the liquid; lengths are
over the gap, and offsets count from the lower contact circle. The module does without numpy.

============================  ================================================================
:math:`\varphi`               tangent angle of the meridian, from :math:`\pi-\theta_1` below to
                              :math:`\theta_2` above
:math:`\xi, \eta`             offset from the lower contact circle and height, over the gap
============================  ================================================================
"""

from __future__ import annotations

import math
from functools import lru_cache
from typing import NamedTuple

from ...errors import InfeasibleError
from ...numerics.quadrature import gauss_legendre

__all__ = ["SPREADING", "ArcShape", "refuse_spreading", "shape", "wetting", "rounded_angle"]

_RIGHT = math.pi / 2.0
# Gauss-Legendre nodes over at most three half periods of the integrand. 12 reach round-off (5e-15),
# 10 leave 5e-11, 8 leave 2e-7; more cost nothing, as shapes are cached.
_NODES = 20
# Angles closer than this to the 0/180 pair have lost half their digits: the offsets grow as its
# inverse.
SPREADING = 1e-8


class ArcShape(NamedTuple):
    """Geometry of an arc between flats, for unit gap; offsets count from `x_1`.

    Attributes
    ----------
    mean_offset : float
        Mean offset over the height, the moment a = integral of xi d(eta).
    square_offset : float
        Mean square offset, the moment b = integral of xi^2 d(eta).
    variance : float
        The variance b - a^2, computed without cancellation.
    inverse_radius : float
        Gap over arc radius, cos(theta_1) + cos(theta_2): positive if hollow.
    upper_offset : float
        Offset of the upper contact circle.
    plane_offset, plane_sine : float
        Offset and sine of the tangent angle where the force is taken.
    min_offset, max_offset : float
        Minimum and maximum offset of the profile: neck and bulge.
    min_volume : float
        Volume over pi times gap cubed at which the neck closes.
    """

    mean_offset: float
    square_offset: float
    variance: float
    inverse_radius: float
    upper_offset: float
    plane_offset: float
    plane_sine: float
    min_offset: float
    max_offset: float
    min_volume: float


def wetting(angle_lower: float, angle_upper: float) -> float:
    """Sum of the cosines of two contact angles [-], exactly zero for two right angles.

    Examples
    --------
    >>> import math
    >>> wetting(math.pi / 2, math.pi / 2), round(wetting(0.0, math.pi / 3), 15)
    (0.0, 1.5)
    """
    lower, upper = _RIGHT - angle_lower, _RIGHT - angle_upper
    return 2.0 * math.sin(0.5 * (lower + upper)) * math.cos(0.5 * (lower - upper))


def rounded_angle(angle: float) -> float:
    """Contact angle [rad], rounded to 0, pi/2 or pi where it is within 1e-6 of them.

    A stability limit changes by the square of that, 1e-11; otherwise the round-off of a nearly
    closed contact circle would decide where the bridge ends.
    """
    return math.pi if math.pi - angle < 1e-6 else angle


def refuse_spreading(angle_lower: float, angle_upper: float) -> None:
    """Raise InfeasibleError for contact angles of 0 and pi, between which no bridge exists."""
    if math.cos(0.5 * (angle_lower - angle_upper)) < SPREADING:
        raise InfeasibleError(
            "no bridge between contact angles of 0 and 180 deg: the liquid spreads as a film "
            "over the body it wets"
        )


def _offsets(lower: float, upper: float) -> list[tuple[float, float]]:
    """Offsets of an arc of unit gap at the quadrature nodes, with weights times d(eta)/dt.

    The chord form is regular for straight arcs, so that no angle is a special case.
    """
    half = -0.5 * (lower + upper)  # half of the turn of the tangent angle
    chord = math.cos(0.5 * (lower - upper))
    stretch = half / math.sin(half) if half else 1.0
    points = []
    for node, weight in zip(*gauss_legendre(_NODES), strict=True):
        along = math.sin(node * half) / math.sin(half) if half else node
        offset = -math.sin(lower + node * half) * along / chord
        points.append((offset, weight * stretch * math.cos(lower + 2.0 * node * half) / chord))
    return points


def _force_plane(lower: float, upper: float, inverse: float, offset: float) -> tuple[float, float]:
    """Offset and sine of the tangent at the neck or bulge, else at the smaller contact circle."""
    if lower * upper >= 0.0 and lower != -upper:
        return -2.0 * math.sin(0.5 * lower) ** 2 / inverse, 1.0
    return (0.0, math.cos(lower)) if lower <= upper else (offset, math.cos(upper))


@lru_cache(maxsize=1024)
def shape(angle_lower: float, angle_upper: float) -> ArcShape:
    r"""Geometry of an arc between flats that depends on the contact angles only.

    With the tangent angle linear in the parameter :math:`0 \le t \le 1`,

    .. math::
        \xi = \frac{\cos(p + t\delta)}{\sin(p + \delta)} \frac{\sin t\delta}{\sin\delta}, \quad
        \eta = \frac{\sin(p + t\delta)}{\sin(p + \delta)} \frac{\sin t\delta}{\sin\delta}, \quad
        p = \pi - \theta_1, \; 2\delta = \theta_1 + \theta_2 - \pi .

    Parameters
    ----------
    angle_lower, angle_upper : float
        Contact angles [rad], from 0 to pi; 0, pi/2 and pi are exact.

    Returns
    -------
    ArcShape
        Moments, arc radius, force plane and extreme offsets, all for unit gap [-].

    Raises
    ------
    InfeasibleError
        If one flat is wetted fully and the other not at all (angles 0 and pi).

    Notes
    -----
    This is the circle of Eq. (3.38) with the end conditions of Eq. (3.39), in a form without an
    infinite radius at :math:`\theta_1 + \theta_2 = \pi` and without separate cases for hollow and
    bulging profiles (Eq. 3.41). Moments are accurate to round-off (1e-15).

    References
    ----------
    .. [1] Cai and Bhushan (2007a); Eqs. (3.38)-(3.41) of the dissertation.

    Examples
    --------
    >>> import math
    >>> round(shape(math.pi / 3, math.pi / 3).inverse_radius, 12)
    1.0
    >>> shape(math.pi / 2, math.pi / 2).min_volume
    0.0
    """
    lower, upper = _RIGHT - angle_lower, _RIGHT - angle_upper
    refuse_spreading(angle_lower, angle_upper)
    inverse = wetting(angle_lower, angle_upper)
    points = _offsets(lower, upper)
    mean = sum(weight * x for x, weight in points)
    end = math.tan(0.5 * (upper - lower))
    plane, sine = _force_plane(lower, upper, inverse, end)
    least, greatest = min(0.0, end, plane), max(0.0, end, plane)
    return ArcShape(
        mean_offset=mean,
        square_offset=sum(weight * x * x for x, weight in points),
        variance=sum(weight * (x - mean) ** 2 for x, weight in points),
        inverse_radius=inverse,
        upper_offset=end,
        plane_offset=plane,
        plane_sine=sine,
        min_offset=least,
        max_offset=greatest,
        min_volume=sum(weight * (x - least) ** 2 for x, weight in points),
    )
