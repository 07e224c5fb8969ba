r"""Exact bridges between flats as a one-parameter family, dimensionless.

Conventions and symbols are those of `exact.delaunay`. Between flats a bridge is explicit in the
chart coordinate up to its size; lengths are over the cube root of its volume or, for a bridge
*pinned* at a rim, over its larger contact radius. The module does without numpy.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from functools import lru_cache, partial
from typing import NamedTuple

from ...numerics.quadrature import gauss_legendre
from ...numerics.roots import bracketed_root
from ..arc.shape import rounded_angle
from ..exact.delaunay import COMPLEX, NUMBERS, Body, Ends, body, ends, integrand, is_round, reach

__all__ = ["Member", "family", "last_member"]

_STEP = 1e-30  # of the complex step, as in `exact.chart`


class Member(NamedTuple):
    """A bridge of the family; the force is over surface tension and length."""

    chart: float
    gap: float
    force: float
    volume: float


def family(angle_lower: float, angle_upper: float, pinned: bool) -> Callable[[float], Member]:
    """Bridges between flats for two contact angles [rad], as a function of the chart coordinate."""
    return partial(_member, *_bodies(angle_lower, angle_upper), pinned)


def last_member(angle_lower: float, angle_upper: float, pinned: bool) -> Member:
    """Bridge of maximum gap of the family: at a fold, a pitchfork, or detachment.

    Examples
    --------
    >>> round(last_member(math.pi / 3, math.pi / 3, False).gap, 12)
    1.420452476322
    """
    one = family(angle_lower, angle_upper, pinned)
    return one(_last_chart(angle_lower, angle_upper, pinned))


def _bodies(angle_lower: float, angle_upper: float) -> tuple[Body, Body, bool]:
    """Body of the limiting end, body of the second end, and whether they are equal."""
    angle_lower, angle_upper = rounded_angle(angle_lower), rounded_angle(angle_upper)
    lower, upper = body(NUMBERS, angle_lower, 0.0), body(NUMBERS, angle_upper, 0.0)
    if abs(lower.cosine) < abs(upper.cosine):
        lower, upper = upper, lower
    return lower, upper, angle_lower == angle_upper


def _integrals(found: Ends) -> tuple[float, float, float, float]:
    """Height and volume over pi between the ends, and their derivatives by the shape."""
    shape = found.shape
    from_bulge = bool(is_round(shape))
    low = -reach(NUMBERS, shape, found.limiting, from_bulge=from_bulge)
    span = reach(NUMBERS, shape, found.second, from_bulge=from_bulge) - low
    # As in `exact.chart`. The nearest branch point is a right angle away for every shape: accurate
    # to round-off.
    wanted = 6.0 + 20.0 / math.asinh(math.pi / max(abs(span), 1e-3))
    total = [0.0, 0.0, 0.0, 0.0]
    for node, weight in zip(*gauss_legendre(8 * math.ceil(wanted / 8.0)), strict=True):
        values = integrand(NUMBERS, shape, low + span * node, from_bulge=from_bulge)
        for i, value in enumerate(values):
            total[i] += weight * value
    height, content, height_slope, content_slope = (span * value for value in total)
    return height, content, height_slope, content_slope


def _member(limiting: Body, second: Body, symmetric: bool, pinned: bool, chart: float) -> Member:
    found = ends(NUMBERS, 1.0, chart, limiting, second, symmetric)
    height, content, _, _ = _integrals(found)
    volume = math.pi * content
    if not (height > 0.0 and volume > 0.0):
        return Member(chart, 0.0, 0.0, 0.0)
    length = max(found.limiting.radius, found.second.radius) if pinned else volume ** (1.0 / 3.0)
    return Member(chart, height / length, math.pi * found.force / length, volume / length**3)


def _slope(limiting: Body, second: Body, symmetric: bool, pinned: bool, chart: float) -> float:
    """Derivative of the logarithm of gap over length by the chart coordinate.

    At zero gap, or for a closed bridge, only its sign is defined.
    """
    found = ends(NUMBERS, 1.0, chart, limiting, second, symmetric)
    step = ends(COMPLEX, 1.0 + 0j, complex(chart, _STEP), limiting, second, symmetric)
    height, content, height_shape, content_shape = _integrals(found)
    if not (height > 0.0 and content > 0.0):
        return -1.0 if chart > 0.0 else 1.0
    sides = ((found.limiting, step.limiting), (found.second, step.second))
    shape = step.shape.imag / _STEP
    gap = height_shape * shape + sum(a.sine * b.arc.imag / _STEP for a, b in sides)
    if pinned:
        wide, moved = max(sides, key=lambda side: side[0].radius)
        return float(gap / height - moved.radius.imag / _STEP / wide.radius)
    volume = content_shape * shape
    volume += sum(a.radius**2 * a.sine * b.arc.imag / _STEP for a, b in sides)
    return float(gap / height - volume / content / 3.0)


@lru_cache(maxsize=64)
def _last_chart(angle_lower: float, angle_upper: float, pinned: bool) -> float:
    """Chart coordinate of the bridge of maximum gap: a fold, a pitchfork, or detachment."""
    limiting, second, symmetric = _bodies(angle_lower, angle_upper)
    slope = partial(_slope, limiting, second, symmetric, pinned)
    repelled = limiting.cosine < 0.0 and limiting.sine < (1e-3 if symmetric else 1e-12)
    if repelled and slope(1e-3) < 0.0:
        return 1e-6  # remaining contact radius; its square is at round-off
    if symmetric and slope(1e-9) < 0.0:
        return 0.0
    # A bracket first, then false position: the slope is flat on the side of thin films, where
    # Newton's method would leave the range. For angles that add up to pi a film of zero gap is at
    # zero, not at infinity.
    step = 0.01 * max(min(limiting.sine, 1.0), 1e-6)
    if slope(step) < 0.0:
        high, low = step, -step
        while slope(low) < 0.0:
            high, low = low, 1.3 * low
    else:
        low, high = step, 2.0 * step
        while slope(high) > 0.0:
            low, high = high, 2.0 * high
    return bracketed_root(slope, low, high)
