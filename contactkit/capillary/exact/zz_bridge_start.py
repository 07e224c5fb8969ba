"""First guesses of bridges, from the arc model or from the curve of one volume.

Symbols are those of `delaunay`; the volume is one.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from ..arc import sphere as arc_sphere
from .newton import Problem, Solution, rebind, solve

__all__ = ["from_arc", "from_waist"]

Array = NDArray[np.float64]


def from_waist(given: Problem, waist: Array, shape: Array) -> Solution:
    """Newton from a waist (its logarithm) and a shape e, both ends before a right angle."""
    bodies = given.bodies
    k = bodies.binder.curvature * np.exp(waist)
    wide = shape * (1.0 + k) / (bodies.binder.cosine - k)
    chart = np.arccosh(np.maximum(np.where(np.isfinite(wide), wide, 1.0), 1.0))
    flipped = np.zeros(waist.shape, dtype=np.bool_)
    bodies, flipped, chart = rebind(bodies, flipped, waist, shape, np.maximum(chart, 1e-6))
    return solve(given._replace(bodies=bodies), waist, np.maximum(chart, 0.05), flipped)


def waist_of(force: Array, pressure: Array, hollow: NDArray[np.bool_]) -> tuple[Array, Array]:
    """Waist (its logarithm) and shape e from force and pressure over the surface tension."""
    f = force / (2.0 * np.pi)
    root = np.sqrt(np.maximum(1.0 - 2.0 * f * pressure, 1e-6))
    shape = np.where(hollow, root, -root)
    by_force = abs(1.0 + shape) > abs(1.0 - shape)
    top = np.where(by_force, 2.0 * f, 1.0 - shape)
    waist = top / np.where(by_force, 1.0 + shape, pressure)
    return np.log(waist), shape


def from_arc(
    given: Problem, angles: tuple[Array, Array], curvatures: tuple[Array, Array]
) -> Solution:
    """Newton from the arc model; one body at least is curved, and the volume is one."""
    arc = arc_sphere.solve(given.gap, 1.0, *angles, *curvatures)
    return from_waist(given, *waist_of(arc.force, arc.pressure, arc.inverse_arc_radius >= 0.0))
