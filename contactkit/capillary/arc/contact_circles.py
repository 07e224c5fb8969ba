"""Contact circles of a circular meridian between curved bodies, by Newton iteration.

Symbols and conventions are those of `sphere`, the entry point to this module.

Two equations determine the circles: the chord lies at the mean of the tangent angles at its ends,
and the volume is given. The volume is that of a frustum and of a circular segment of revolution,
less the caps of the bodies; all expressions are closed and regular, also for straight arcs, flat
bodies and contact angles of 0, 90 and 180 deg. The unknowns are the distances along the bodies,
which are regular at the equator and for vanishing curvature.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

__all__ = [
    "Circle",
    "ArcProblem",
    "Segment",
    "acceptable",
    "circle",
    "equations",
    "follow",
    "iterate",
    "outline",
    "segment",
]

Array = NDArray[np.float64]
Flags = NDArray[np.bool_]

# Half angle below which the moment is a series. At 0.25 both forms are off by 1e-14; the closed one
# cancels to its cube (1e-13 at 0.05, 8e-11 at 0.003), the nine terms leave 1e-13 at 0.5, 4e-8 at 1.
_SERIES = 0.25
# Coefficients of half^(2k) / (2k) of the moment, k = 1 to 9: from Bernoulli numbers, exact.
_MOMENT = (
    1 / 60,
    1 / 252,
    1 / 1350,
    1 / 8316,
    691 / 38697750,
    1 / 400950,
    3617 / 10854718875,
    43867 / 1019066548500,
    174611 / 32238515058750,
)


class Segment(NamedTuple):
    """Area over chord squared, moment over chord cubed; their derivatives by the half angle."""

    area: Array
    moment: Array
    d_area: Array
    d_moment: Array


def segment(half: Array) -> Segment:
    """Circular segment of an arc that turns by twice `half` [rad], between -pi and pi.

    Examples
    --------
    >>> right = segment(np.array([np.pi / 2]))  # half a disc on its diameter
    >>> round(float(right.area[0] * 8.0 / np.pi), 14), round(float(right.moment[0] * 12.0), 14)
    (1.0, 1.0)
    """
    squared = half**2
    tail = np.zeros_like(half)
    for k in range(12, 0, -1):  # (z - sin z) / z^3 at z = 2 half
        tail = (1.0 - 4.0 * squared * tail) / (2.0 * k * (2.0 * k + 1.0))
    near, slope = np.zeros_like(half), np.zeros_like(half)
    for k in range(len(_MOMENT), 0, -1):
        near = squared * (near + _MOMENT[k - 1])
        slope = squared * slope + 2.0 * k * _MOMENT[k - 1]
    straight, small = half == 0.0, abs(half) < _SERIES
    sine = np.where(straight, 1.0, np.sin(half))
    cosine = np.where(straight, 0.0, np.cos(half))
    cotangent = cosine / sine
    ratio = np.where(straight, 1.0, half / sine)
    far = 0.25 * (ratio - cosine) / sine
    area = np.where(squared < 1.0, half * ratio**2 * tail, far)
    moment = np.where(small, near, 1.0 / 12.0 - 0.5 * area * cotangent)
    d_area = np.where(straight, 1.0 / 6.0, 0.5 - 2.0 * area * cotangent)
    d_far = 0.5 * area + cotangent * (1.5 * area * cotangent - 0.25)
    return Segment(area, moment, d_area, np.where(small, half * slope, d_far))


_RIGHT = np.pi / 2.0
# Maximum iterations from a cold start, and along a path. Of 1500 random pairs the same arcs are
# found from 8 cold iterations on; with 8 more points go on to continuation, at 1.6 times the work,
# with 60 it is the hopeless ones that cost. With 6 along a path continuation lost an arc; 24 gain
# nothing.
_COLD, _WARM = 30, 12
# A steeper paraboloid has a second, far-away family of arcs. What is rejected is looked for again
# by continuation: of 400 random pairs pi/8 to pi/2 found the same arcs.
_STEEP = np.pi / 4.0
# Relative Newton step. The error after it is of the order of its square: 1e-8 leaves 1e-14, 1e-6
# leaves 5e-11 in the force, and saves a twelfth of the iterations.
_SETTLED = 1e-9


class Circle(NamedTuple):
    """Contact circle on a body, with derivatives by the distance along the body."""

    radius: Array
    sag: Array
    slope: Array
    cap: Array
    d_radius: Array
    d_sag: Array
    d_slope: Array


class ArcProblem(NamedTuple):
    """Gap, volume, contact angles and curvatures of the points; arrays of one length."""

    gap: Array
    volume: Array
    angle_lower: Array
    angle_upper: Array
    curvature_lower: Array
    curvature_upper: Array

    def at(self, index: NDArray[np.intp] | Flags) -> ArcProblem:
        """Select points."""
        return ArcProblem(*(value[index] for value in self))


class Outline(NamedTuple):
    """Neck, bulge, force plane (radius, sine of the tangent angle), height and 1/r1 of arcs."""

    neck: Array
    bulge: Array
    plane_radius: Array
    plane_sine: Array
    height: Array
    inverse_arc_radius: Array


class Equations(NamedTuple):
    """Residuals, their derivatives by the distances, and the turn of the chord from vertical."""

    tilt: Array
    excess: Array
    tilt_lower: Array
    tilt_upper: Array
    excess_lower: Array
    excess_upper: Array
    height: Array
    turn: Array
    turn_lower: Array
    turn_upper: Array


def circle(distance: Array, curvature: Array, profile: str) -> Circle:
    """Contact circle at a distance from the pole; on a parabola the distance is the radius."""
    steep = curvature * distance
    if profile == "parabola":
        sag = 0.5 * steep * distance
        cap = _RIGHT * distance**2 * sag
        d_slope = curvature / (1.0 + steep**2)
        return Circle(distance, sag, np.arctan(steep), cap, np.ones_like(steep), steep, d_slope)
    sine, cosine = np.sin(steep), np.cos(steep)
    radius = np.divide(sine, curvature, out=distance.copy(), where=curvature > 0.0)
    sag = radius * np.tan(0.5 * steep)
    cap = np.pi / 6.0 * sag * (3.0 * radius**2 + sag**2)
    return Circle(radius, sag, steep, cap, cosine, sine, curvature)


def _distance(radius: Array, curvature: Array, profile: str) -> Array:
    """Distance along a body of the circle of given radius, limited to below the equator."""
    if profile == "parabola":
        return radius
    sine = np.clip(curvature * radius, -0.95, 0.95)
    return np.divide(np.arcsin(sine), curvature, out=radius.copy(), where=curvature > 0.0)


def _start(problem: ArcProblem, profile: str) -> tuple[Array, Array]:
    """Initial guess: contact circles between cones tangent to the bodies at the rim of a film.

    The rim is that of a film with a cylindrical edge; the volume of an arc between cones is a
    quadratic in the mean contact radius, whose larger root is the branch with an open neck.
    """
    gap, volume, angle_lower, angle_upper, lower, upper = problem
    bias = angle_upper - angle_lower
    spread = np.sqrt(gap**2 + (lower + upper) * volume / np.pi)
    one = two = np.sqrt(2.0 * volume / (np.pi * (gap + spread)))
    for _ in range(2):
        below = circle(_distance(one, lower, profile), lower, profile)
        above = circle(_distance(two, upper, profile), upper, profile)
        height = gap + below.sag + above.sag
        # at the rim of the film the chord may point down: go half way to that
        turn = np.clip(bias + above.slope - below.slope, 0.5 * (bias - np.pi), 0.5 * (bias + np.pi))
        lean = -np.tan(0.5 * turn) * height
        half = 0.5 * (angle_lower + below.slope + angle_upper + above.slope) - _RIGHT
        area, moment, _, _ = segment(half)
        chord2 = height**2 + lean**2
        bend = area * chord2 / height
        square = (volume + below.cap + above.cap) / (np.pi * height)
        square = square - lean**2 / 12.0 - 2.0 * moment * chord2
        mean = np.sqrt(np.maximum(bend**2 + square, 0.0)) - bend
        one = np.maximum(mean - 0.5 * lean, 0.05 * mean)
        two = np.maximum(mean + 0.5 * lean, 0.05 * mean)
    return _distance(one, lower, profile), _distance(two, upper, profile)


def equations(problem: ArcProblem, one: Array, two: Array, profile: str) -> Equations:
    """Residuals at two contact circles: tilt of the chord and excess volume."""
    gap, volume, angle_lower, angle_upper, lower, upper = problem
    b, t = circle(one, lower, profile), circle(two, upper, profile)
    height, lean = gap + b.sag + t.sag, t.radius - b.radius
    chord2, mean = height**2 + lean**2, 0.5 * (b.radius + t.radius)
    # derivatives are added last: they may be tiny against the angles, and the height huge
    turn = (angle_upper - angle_lower) + (t.slope - b.slope)
    sine, cosine = np.cos(0.5 * turn), -np.sin(0.5 * turn)  # of the angle of the chord
    half = 0.5 * ((angle_lower - _RIGHT) + (angle_upper - _RIGHT) + (b.slope + t.slope))
    area, moment, d_area, d_moment = segment(half)
    disc = mean**2 + lean**2 / 12.0  # mean square radius of the frustum
    ring = area * mean + moment * height  # first moment of the segment over chord squared
    d_ring_half = 0.5 * (d_area * mean + d_moment * height)
    d_tilt_half = 0.5 * (lean * cosine + height * sine)

    def slopes(end: Circle, sign: float) -> tuple[Array, Array]:
        d_tilt = sign * (end.d_radius * sine + end.d_slope * d_tilt_half) - end.d_sag * cosine
        d_chord2 = 2.0 * (sign * lean * end.d_radius + height * end.d_sag)
        d_disc = end.d_radius * (mean + sign * lean / 6.0)
        d_ring = end.d_slope * d_ring_half + 0.5 * area * end.d_radius + moment * end.d_sag
        d_volume = end.d_sag * disc + height * d_disc + 2.0 * (d_chord2 * ring + chord2 * d_ring)
        return d_tilt, np.pi * (d_volume - end.radius**2 * end.d_sag)

    (t1, v1), (t2, v2) = slopes(b, -1.0), slopes(t, 1.0)
    excess = np.pi * (height * disc + 2.0 * chord2 * ring) - b.cap - t.cap - volume
    tilt = lean * sine - height * cosine
    return Equations(tilt, excess, t1, t2, v1, v2, height, turn, -b.d_slope, t.d_slope)


class Roots(NamedTuple):
    """The distances of the lower and the upper contact circle, and whether they converged."""

    lower: Array
    upper: Array
    settled: Flags


class Followed(NamedTuple):
    """End of a continuation: both distances, and whether the neck was open, or had closed."""

    lower: Array
    upper: Array
    reached: Flags
    closed: Flags


def iterate(problem: ArcProblem, profile: str, start: tuple[Array, Array] | None = None) -> Roots:
    """Newton iteration on all points at once; converged points are frozen and dropped."""
    settled = np.zeros(problem.gap.shape, dtype=np.bool_)
    with np.errstate(all="ignore"):  # diverging points overflow and count as not converged
        one, two = _start(problem, profile) if start is None else (start[0].copy(), start[1].copy())
        active = np.arange(problem.gap.size)
        for _ in range(_COLD if start is None else _WARM):
            e = equations(problem.at(active), one[active], two[active], profile)
            determinant = e.tilt_lower * e.excess_upper - e.tilt_upper * e.excess_lower
            step1 = (e.tilt_upper * e.excess - e.tilt * e.excess_upper) / determinant
            step2 = (e.tilt * e.excess_lower - e.tilt_lower * e.excess) / determinant
            wide = np.maximum(abs(one[active]), abs(two[active]))
            size = np.maximum(wide, e.height)
            longest = np.maximum(abs(step1), abs(step2))
            d_turn = e.turn_lower * step1 + e.turn_upper * step2
            room = np.where(d_turn > 0.0, np.pi - e.turn, np.pi + e.turn)
            # The residuals have poles where the chord is horizontal, and a second family of roots
            # beyond: a distance is halved at most, and 0.8 of the turn that is left is used.
            bound = np.where(room > 0.0, 0.8 * room / abs(d_turn), 1.0)
            scale = np.fmin(1.0, np.fmin(0.5 * size / longest, bound))
            one[active] += scale * step1
            two[active] += scale * step2
            done = longest <= np.maximum(_SETTLED * wide, 4e-15 * e.height)
            settled[active[done]] = True
            active = active[~done & np.isfinite(longest)]
            if not active.size:
                break
    return Roots(one, two, settled)


def outline(problem: ArcProblem, below: Circle, above: Circle) -> Outline:
    """Neck, bulge and force plane of the arcs between two contact circles."""
    lower = (_RIGHT - problem.angle_lower) - below.slope
    upper = (_RIGHT - problem.angle_upper) - above.slope
    height = problem.gap + below.sag + above.sag
    inverse = 2.0 * np.sin(0.5 * (lower + upper)) * np.cos(0.5 * (lower - upper))
    extreme = (lower * upper >= 0.0) & (lower != -upper)
    offset = 2.0 * np.sin(0.5 * lower) ** 2 / np.where(extreme, inverse, 1.0)
    first = below.radius <= above.radius
    least, most = np.minimum(below.radius, above.radius), np.maximum(below.radius, above.radius)
    plane = np.where(extreme, below.radius - height * offset, least)
    sine = np.where(extreme, 1.0, np.where(first, np.cos(lower), np.cos(upper)))
    return Outline(
        np.minimum(least, plane), np.maximum(most, plane), plane, sine, height, inverse / height
    )


def acceptable(problem: ArcProblem, one: Array, two: Array, profile: str) -> Flags:
    """Whether roots are on the open-neck branch: neck open, width increasing with volume."""
    below = circle(one, problem.curvature_lower, profile)
    above = circle(two, problem.curvature_upper, profile)
    e = equations(problem, one, two, profile)
    steepest = np.maximum(abs(below.slope), abs(above.slope))
    return (
        (outline(problem, below, above).neck > 0.0)
        & (abs(e.turn) < np.pi)
        & (steepest < (_STEEP if profile == "parabola" else np.pi))
        & (e.tilt_lower * e.excess_upper < e.tilt_upper * e.excess_lower)
    )


def _stage(problem: ArcProblem, stage: Array) -> ArcProblem:
    """Point of a continuation path from a small volume between touching bodies to the problem.

    First the volume grows (parameter 0 to 1), then the gap (1 to 2), so that the neck stays open.
    """
    bend = problem.curvature_lower + problem.curvature_upper
    film = np.minimum(problem.gap, 0.1 * np.sqrt(bend * problem.volume))
    volume = problem.volume * 1e-6 ** np.maximum(1.0 - stage, 0.0)
    rise = np.clip(stage - 1.0, 0.0, 1.0)
    gap = film ** (1.0 - rise) * problem.gap**rise
    return problem._replace(gap=np.where(stage > 1.0, gap, 0.0), volume=volume)


def follow(problem: ArcProblem, profile: str) -> Followed:
    """Follow the open-neck branch by continuation, for points where the cold start failed.

    Failed steps are halved. One body at least must be curved.
    """
    stage, step = np.zeros_like(problem.gap), np.full_like(problem.gap, 0.1)
    one, two, good = iterate(_stage(problem, stage), profile)
    closed = np.zeros_like(good)
    live = np.flatnonzero(good)
    while live.size:
        target = np.minimum(stage[live] + step[live], np.where(stage[live] < 1.0, 1.0, 2.0))
        part = _stage(problem.at(live), target)
        new1, new2, good = iterate(part, profile, (one[live], two[live]))
        with np.errstate(all="ignore"):
            below = circle(new1, part.curvature_lower, profile)
            above = circle(new2, part.curvature_upper, profile)
            size = one[live] + two[live] + part.gap
            good &= abs(new1 - one[live]) + abs(new2 - two[live]) < size
            shut = good & ~(outline(part, below, above).neck > 0.0)
        moved = live[good]
        one[moved], two[moved], stage[moved] = new1[good], new2[good], target[good]
        closed[live[shut]] = True
        step[live] = np.where(good, step[live], 0.5 * step[live])
        live = live[~shut & (target < 2.0) & (step[live] > 1e-4) | (~good & (step[live] > 1e-4))]
    return Followed(one, two, (stage == 2.0) & ~closed, closed)
