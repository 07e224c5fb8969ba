"""Newton iteration for bridges between curved bodies, and the curve of one volume up to its fold.

Symbols are those of `delaunay`. The unknowns are the logarithm of the waist and the chart
coordinate zeta, in which the curve of bridges of one volume (or of one pressure) is smooth
through catenoid, cylinder, sphere, inflection at a contact line and fold. Lengths are in the
unit of the caller.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from ..arc import sphere as arc_sphere
from .chart import Pair, Point, pair, point, solids

__all__ = ["Problem", "Solution", "from_arc", "from_waist", "problem", "rebind", "solve"]

Array = NDArray[np.float64]
Flags = NDArray[np.bool_]

_ITERATIONS = 25
_SETTLED = 1e-8  # a Newton step this small leaves its square, once it is taken


class Problem(NamedTuple):
    """What is given; arrays of one length. One of volume and pressure, the other is None."""

    gap: Array
    volume: Array | None
    pressure: Array | None
    bodies: Pair

    def at(self, index: NDArray[np.intp] | Flags) -> Problem:
        """Take some of the points."""
        return Problem(
            self.gap[index],
            None if self.volume is None else self.volume[index],
            None if self.pressure is None else self.pressure[index],
            self.bodies.at(index),
        )


class Solution(NamedTuple):
    """Bodies with the binding one first, whether that is the upper one, place, and a verdict."""

    bodies: Pair
    flipped: Flags
    waist: Array
    chart: Array
    settled: Flags
    found: Point

    @property
    def determinant(self) -> Array:
        """Positive on the branch that is stable at fixed volume, zero at its fold."""
        f = self.found
        result: Array = f.gap_waist * f.volume_chart - f.gap_chart * f.volume_waist
        return result

    @property
    def unknowns(self) -> Array:
        """Logarithm of the waist, shape, and arc lengths at the lower and upper body, as rows."""
        ends = self.found.ends
        first, last = ends.binder.arc, ends.other.arc
        arcs = np.where(self.flipped, last, first), np.where(self.flipped, first, last)
        return np.stack((self.waist, ends.shape, *arcs))

    @property
    def good(self) -> Flags:
        """Whether a bridge was found that is stable at fixed volume."""
        beyond = self.bodies.twin & (self.chart <= 0.0)
        result: Flags = (
            self.settled
            & (self.determinant > 0.0)
            & ~beyond
            & (self.found.volume > 0.0)
            & (self.found.ends.sine_other <= 1.0)
            & (self.found.ends.binder.radius > 0.0)
            & (self.found.ends.other.radius > 0.0)
        )
        return result


def problem(
    gap: Array,
    volume: Array | None,
    pressure: Array | None,
    angles: tuple[Array, Array],
    curvatures: tuple[Array, Array],
) -> Problem:
    """Problem for bodies given by contact angles [rad] and curvatures, lower and upper."""
    lower, upper = solids(angles[0], curvatures[0]), solids(angles[1], curvatures[1])
    twin = (angles[0] == angles[1]) & (curvatures[0] == curvatures[1])
    return Problem(gap, volume, pressure, pair(lower, upper, twin))


def rebind(
    bodies: Pair, flipped: Flags, waist: Array, shape: Array, chart: Array, *, must: bool = False
) -> tuple[Pair, Flags, Array]:
    """Make the end of the larger phase the binding one, where neither is beyond a right angle.

    With `must` the ends change parts wherever they can.
    """
    a = np.exp(waist)
    rests = [(body.cosine - body.curvature * a) / shape for body in (bodies.binder, bodies.other)]
    ks = [body.curvature * a for body in (bodies.binder, bodies.other)]
    ahead = rests[1] - ks[1] > rests[0] - ks[0]
    flip = (rests[1] > 0.0) & (must | ahead | (rests[0] <= 0.0)) & (chart > 0.0) & ~bodies.twin
    if flip.any():
        wide = (1.0 + ks[1]) / np.where(flip, rests[1], 1.0)
        chart = np.where(flip, np.arccosh(np.maximum(wide, 1.0)), chart)
        bodies = bodies.swapped(flip)
    return bodies, flipped ^ flip, chart


def _residual(given: Problem, at: Point, a: Array) -> tuple[Array, Array, Array]:
    """Second residual and its slopes: volume or pressure."""
    if given.volume is not None:
        ratio = at.volume / given.volume
        full = ratio > 0.0
        logarithm = np.log(np.where(full, ratio, 1.0))
        scale = np.where(full, at.volume, given.volume)
        return (
            np.where(full, logarithm, ratio - 1.0),
            at.volume_waist / scale,
            at.volume_chart / scale,
        )
    assert given.pressure is not None
    target = a * given.pressure
    return at.ends.pressure - target, -at.shape_waist - target, -at.shape_chart


def solve(
    given: Problem, waist: Array, chart: Array, flipped: Flags, most: int = _ITERATIONS
) -> Solution:
    """Newton on all points at once, from the waist (its logarithm) and zeta given.

    Points that have settled are taken once more with all others and then dropped.
    """
    bodies = given.bodies
    waist, chart, flipped = waist.copy(), chart.copy(), flipped.copy()
    settled = np.zeros(waist.shape, dtype=np.bool_)
    active = np.arange(waist.size)
    for _ in range(most):
        part = given.at(active)._replace(bodies=bodies.at(active))
        at = point(part.bodies, waist[active], chart[active])
        second, second_waist, second_chart = _residual(part, at, np.exp(waist[active]))
        first = at.gap - part.gap
        determinant = at.gap_waist * second_chart - at.gap_chart * second_waist
        step1 = (at.gap_chart * second - first * second_chart) / determinant
        step2 = (first * second_waist - at.gap_waist * second) / determinant
        longest = np.maximum(abs(step1) / 0.5, abs(step2))
        scale = 1.0 / np.maximum(longest, 1.0)
        waist[active] += scale * step1
        chart[active] += scale * step2
        done = longest <= _SETTLED
        settled[active[done]] = True
        active = active[~done & np.isfinite(longest) & (abs(chart[active]) < 60.0)]
        if not active.size:
            break
        bodies, flipped, chart = _rebound(bodies, flipped, waist, chart)
    return Solution(bodies, flipped, waist, chart, settled, point(bodies, waist, chart))


def _rebound(bodies: Pair, flipped: Flags, waist: Array, chart: Array) -> tuple[Pair, Flags, Array]:
    k = bodies.binder.curvature * np.exp(waist)
    shape = (bodies.binder.cosine - k) * np.cosh(chart) / (1.0 + k)
    return rebind(bodies, flipped, waist, shape, chart)


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
