"""Newton iteration for bridges between two bodies in chart coordinates.

Symbols are those of `delaunay`. The unknowns are the logarithm of the neck radius and the chart
coordinate zeta, in which the curve of bridges of one volume (or pressure) is smooth through
catenoid, cylinder, sphere, inflection at a contact line and fold. Lengths are in the unit of the
caller.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from ..arc import sphere as arc_sphere
from .chart import ChartPoint, Pair, pair, point, solids

__all__ = ["BridgeProblem", "Solution", "from_arc", "from_neck", "problem", "reorder_ends", "solve"]

Array = NDArray[np.float64]
Flags = NDArray[np.bool_]

# Of 3000 random bridges, started from the arc, 2103 are found within 6 iterations, 2212 within 10,
# 2236 within 25 and 2242 within 100. The rest, mostly beyond their limit, are looked up on the
# branch.
_ITERATIONS = 25
# Newton step in logarithms. The error after it is of the order of its square, as far as the
# curvature of the problem allows: 1e-6 leaves 1e-10, 1e-4 leaves 1e-8 and sends 2 of 24 to the
# branch.
_SETTLED = 1e-8


class BridgeProblem(NamedTuple):
    """Gap and what is given, volume or pressure, of bridges between two bodies."""

    gap: Array
    given: Array
    at_pressure: bool
    bodies: Pair

    def at(self, index: NDArray[np.intp] | Flags) -> BridgeProblem:
        """Select points."""
        return BridgeProblem(
            self.gap[index], self.given[index], self.at_pressure, self.bodies.at(index)
        )


class Solution(NamedTuple):
    """Bodies, that of the limiting end first; whether it is the upper one; point; convergence."""

    bodies: Pair
    flipped: Flags
    log_neck: Array
    chart: Array
    settled: Flags
    found: ChartPoint

    @property
    def determinant(self) -> Array:
        """Jacobian determinant: positive on the branch stable at fixed volume, zero at its fold."""
        f = self.found
        result: Array = f.gap_by_neck * f.volume_by_chart - f.gap_by_chart * f.volume_by_neck
        return result

    @property
    def unknowns(self) -> Array:
        """Rows: logarithm of the neck radius, shape, arc lengths at the lower and upper body."""
        ends = self.found.ends
        first, last = ends.limiting.arc, ends.second.arc
        arcs = np.where(self.flipped, last, first), np.where(self.flipped, first, last)
        return np.stack((self.log_neck, ends.shape, *arcs))

    @property
    def good(self) -> Flags:
        """Whether the iteration converged to a bridge that is stable at fixed volume."""
        beyond = self.bodies.symmetric & (self.chart <= 0.0)
        result: Flags = (
            self.settled
            & (self.determinant > 0.0)
            & ~beyond
            & (self.found.volume > 0.0)
            & (self.found.ends.sine_second <= 1.0)
            & (self.found.ends.limiting.radius > 0.0)
            & (self.found.ends.second.radius > 0.0)
        )
        return result


def problem(
    gap: Array,
    given: Array,
    angles: tuple[Array, Array],
    curvatures: tuple[Array, Array],
    *,
    at_pressure: bool = False,
) -> BridgeProblem:
    """Bridges of given volumes, or pressures, between bodies of given shape.

    Contact angles [rad] and curvatures are those of the lower and the upper body.
    """
    lower, upper = solids(angles[0], curvatures[0]), solids(angles[1], curvatures[1])
    symmetric = (angles[0] == angles[1]) & (curvatures[0] == curvatures[1])
    return BridgeProblem(gap, given, at_pressure, pair(lower, upper, symmetric))


class Ends(NamedTuple):
    """Bodies, that of the limiting end first; whether it is the upper one; zeta there."""

    bodies: Pair
    flipped: Flags
    chart: Array


def reorder_ends(
    bodies: Pair,
    flipped: Flags,
    log_neck: Array,
    shape: Array,
    chart: Array,
    *,
    always: bool = False,
) -> Ends:
    """Make the end of larger phase the limiting one, where neither is beyond a right angle.

    With `always` the ends are exchanged wherever possible.
    """
    a = np.exp(log_neck)
    rests = [
        (body.cosine - body.curvature * a) / shape for body in (bodies.limiting, bodies.second)
    ]
    ks = [body.curvature * a for body in (bodies.limiting, bodies.second)]
    ahead = rests[1] - ks[1] > rests[0] - ks[0]
    flip = (
        (rests[1] > 0.0) & (always | ahead | (rests[0] <= 0.0)) & (chart > 0.0) & ~bodies.symmetric
    )
    if flip.any():
        wide = (1.0 + ks[1]) / np.where(flip, rests[1], 1.0)
        chart = np.where(flip, np.arccosh(np.maximum(wide, 1.0)), chart)
        bodies = bodies.swapped(flip)
    return Ends(bodies, flipped ^ flip, chart)


def _residual(given: BridgeProblem, at: ChartPoint, a: Array) -> tuple[Array, Array, Array]:
    """Second residual and its derivatives: volume or pressure."""
    if given.at_pressure:
        target = a * given.given
        return at.ends.pressure - target, -at.shape_by_neck - target, -at.shape_by_chart
    ratio = at.volume / given.given
    # In logarithms: the volume of a thin film is close to a power of both unknowns, over many
    # decades.
    full = ratio > 0.0
    logarithm = np.log(np.where(full, ratio, 1.0))
    scale = np.where(full, at.volume, given.given)
    return (
        np.where(full, logarithm, ratio - 1.0),
        at.volume_by_neck / scale,
        at.volume_by_chart / scale,
    )


def solve(
    given: BridgeProblem,
    log_neck: Array,
    chart: Array,
    flipped: Flags,
    max_iterations: int = _ITERATIONS,
) -> Solution:
    """Newton iteration on all points at once; converged points are dropped."""
    bodies = given.bodies
    log_neck, chart, flipped = log_neck.copy(), chart.copy(), flipped.copy()
    settled = np.zeros(log_neck.shape, dtype=np.bool_)
    active = np.arange(log_neck.size)
    for _ in range(max_iterations):
        part = given.at(active)._replace(bodies=bodies.at(active))
        at = point(part.bodies, log_neck[active], chart[active])
        second, second_by_neck, second_by_chart = _residual(part, at, np.exp(log_neck[active]))
        first = at.gap - part.gap
        determinant = at.gap_by_neck * second_by_chart - at.gap_by_chart * second_by_neck
        step1 = (at.gap_by_chart * second - first * second_by_chart) / determinant
        step2 = (first * second_by_neck - at.gap_by_neck * second) / determinant
        # The logarithm of the neck radius moves by 0.5 at most (40 % of the radius), zeta by 1:
        # about half of the distance over which the linearisation says anything.
        longest = np.maximum(abs(step1) / 0.5, abs(step2))
        scale = 1.0 / np.maximum(longest, 1.0)
        log_neck[active] += scale * step1
        chart[active] += scale * step2
        done = longest <= _SETTLED
        settled[active[done]] = True
        active = active[~done & np.isfinite(longest) & (abs(chart[active]) < 60.0)]
        if not active.size:
            break
        bodies, flipped, chart = _reordered(bodies, flipped, log_neck, chart)
    return Solution(bodies, flipped, log_neck, chart, settled, point(bodies, log_neck, chart))


def _reordered(bodies: Pair, flipped: Flags, log_neck: Array, chart: Array) -> Ends:
    k = bodies.limiting.curvature * np.exp(log_neck)
    shape = (bodies.limiting.cosine - k) * np.cosh(chart) / (1.0 + k)
    return reorder_ends(bodies, flipped, log_neck, shape, chart)


def from_neck(given: BridgeProblem, log_neck: Array, shape: Array) -> Solution:
    """Newton iteration from a neck radius (logarithm) and a shape e, both phases acute."""
    bodies = given.bodies
    k = bodies.limiting.curvature * np.exp(log_neck)
    wide = shape * (1.0 + k) / (bodies.limiting.cosine - k)
    chart = np.arccosh(np.maximum(np.where(np.isfinite(wide), wide, 1.0), 1.0))
    flipped = np.zeros(log_neck.shape, dtype=np.bool_)
    bodies, flipped, chart = reorder_ends(bodies, flipped, log_neck, shape, np.maximum(chart, 1e-6))
    return solve(given._replace(bodies=bodies), log_neck, np.maximum(chart, 0.05), flipped)


def neck_from_force(
    force: Array, pressure: Array, hollow: NDArray[np.bool_]
) -> tuple[Array, Array]:
    """Neck radius (logarithm) and shape e from force and pressure over the surface tension."""
    f = force / (2.0 * np.pi)
    root = np.sqrt(np.maximum(1.0 - 2.0 * f * pressure, 1e-6))
    shape = np.where(hollow, root, -root)
    # a = 2f/(1 + e) = (1 - e)/P: whichever does not divide one small difference by another
    by_force = abs(1.0 + shape) > abs(1.0 - shape)
    top = np.where(by_force, 2.0 * f, 1.0 - shape)
    log_neck = top / np.where(by_force, 1.0 + shape, pressure)
    return np.log(log_neck), shape


def from_arc(
    given: BridgeProblem, angles: tuple[Array, Array], curvatures: tuple[Array, Array]
) -> Solution:
    """Newton iteration from the circular approximation; one body is curved, the volume is one."""
    arc = arc_sphere.solve(given.gap, 1.0, *angles, *curvatures)
    return from_neck(
        given, *neck_from_force(arc.force, arc.pressure, arc.inverse_arc_radius >= 0.0)
    )
