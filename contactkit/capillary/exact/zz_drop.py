"""The drop that a broken bridge leaves on one body: lengths in the unit of its volume."""

from __future__ import annotations

import math

from ...numerics.roots import bracketed_root
from .delaunay import Body

__all__ = ["drop_left"]


def drop_left(body: Body) -> tuple[float, float, float]:
    """Radius, height and contact radius of a drop of unit volume left on one body."""
    angle = math.atan2(float(body.sine[0]), float(body.cosine[0]))
    curvature = float(body.curvature[0])

    def shape(radius: float) -> tuple[float, float, float]:
        k = curvature * radius
        slope = math.atan2(k * math.sin(angle), 1.0 - k * math.cos(angle))
        top = 2.0 * math.sin(0.5 * (angle + slope)) ** 2
        contact = math.sin(angle + slope)
        sag = contact * math.tan(0.5 * slope)
        cap = math.pi / 6.0 * sag * (3.0 * contact**2 + sag**2)
        return top - sag, math.pi / 3.0 * top * top * (3.0 - top) - cap, contact

    def excess(log_radius: float) -> float:
        return 3.0 * log_radius + math.log(shape(math.exp(log_radius))[1])

    low = high = 0.0
    while excess(low) > 0.0:
        low -= 1.0
    while excess(high) < 0.0:
        high += 1.0
    radius = math.exp(bracketed_root(excess, low, high))
    height, _, contact = shape(radius)
    return radius, radius * height, radius * contact
