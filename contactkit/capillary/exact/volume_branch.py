"""The curve of bridges of one volume, from thin to the limit of stability.

Symbols are those of `delaunay`; the volume is one. Along the curve zeta falls and the gap grows,
up to the fold, or to where a bridge between equal bodies tilts, or to where it detaches from a
body that repels the liquid.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from ...errors import ConvergenceError
from ...numerics.roots import bracketed_root
from .chart import Pair, Point, point
from .delaunay import Body
from .newton import rebind

__all__ = [
    "Branch",
    "DETACHMENT",
    "FOLD",
    "PITCHFORK",
    "along",
    "drop_left",
    "flat_branch",
    "march",
]


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


Array = NDArray[np.float64]

FOLD, PITCHFORK, DETACHMENT = 0, 1, 2
_INSIDE = 9  # nodes between which a fold is interpolated
# closer and closer to zero, where the limit of nearly equal bodies has a cusp
_FINE = 0.5 ** np.arange(1.0, 27.0)
_STRAIGHT = np.concatenate((-(0.5 ** np.arange(44.0, 0.0, -1.0)), [-0.75, -1.0, -1.25]))
_CHUNKS = (
    np.concatenate((np.arange(45.0, 12.0, -1.5), np.arange(12.0, 0.6, -0.5), _FINE, [0.0])),
    np.concatenate((-_FINE[::-1], [-0.75, -1.0, -1.25])),
    np.arange(-1.5, -5.0, -0.25),
    np.arange(-5.0, -20.0, -0.25),
    np.arange(-20.0, -40.0, -0.25),
)


class Branch(NamedTuple):
    """Places along the curve, gap growing, the last one at the limit; waists as logarithms."""

    bodies: Pair
    flipped: bool
    chart: Array
    waist: Array
    gap: Array
    slope: Array
    kind: int

    @property
    def last(self) -> tuple[float, float, float, float]:
        """Waist, shape and the two contact radii at the limit."""
        a = math.exp(self.waist[-1])
        ends = point(self.bodies, self.waist[-1:], self.chart[-1:]).ends
        first, last = a * float(ends.binder.radius[0]), a * float(ends.other.radius[0])
        if self.kind == DETACHMENT:  # a contact circle that is a point leaves the formulas open
            first, last = 0.0, drop_left(self.bodies.other)[2]
        return (a, float(ends.shape[0]), *((last, first) if self.flipped else (first, last)))

    @property
    def first(self) -> Array:
        """Logarithm of the waist, shape and arc lengths at the first place."""
        ends = point(self.bodies, self.waist[:1], self.chart[:1]).ends
        return np.concatenate((self.waist[:1], ends.shape, ends.binder.arc, ends.other.arc))

    def place(self, gap: Array) -> tuple[Array, Array]:
        """Zeta and logarithm of the waist near which the bridge of each gap lies."""
        i = np.clip(np.searchsorted(self.gap, gap), 1, self.gap.size - 1) - 1
        z0, z1, g0, g1 = self.chart[i], self.chart[i + 1], self.gap[i], self.gap[i + 1]
        width = z1 - z0
        m0, m1 = self.slope[i] * width, self.slope[i + 1] * width
        low, high = np.zeros(gap.shape), np.ones(gap.shape)
        for _ in range(40):  # the cubic between two places, halved: it is monotone or nearly so
            t = 0.5 * (low + high)
            rest = 1.0 - t
            value = rest * rest * ((1.0 + 2.0 * t) * g0 + t * m0) + t * t * (
                (3.0 - 2.0 * t) * g1 - rest * m1
            )
            low, high = np.where(value < gap, t, low), np.where(value < gap, high, t)
        t = 0.5 * (low + high)
        thin = np.log(np.where(gap < self.gap[0], self.gap[0] / np.maximum(gap, 1e-300), 1.0))
        chart = z0 + t * width + 1.5 * thin
        return chart, self.waist[i] * (1.0 - t) + self.waist[i + 1] * t + 0.5 * thin


def along(
    bodies: Pair, chart: Array, waist: Array, pressure: float | None = None
) -> tuple[Array, Array, Array]:
    """Waist, gap and slope of the gap by zeta at unit volume, or at a pressure; nan for none."""
    pairs = bodies.at(np.zeros(chart.size, dtype=np.intp))
    flat = bool(bodies.binder.curvature[0] == bodies.other.curvature[0] == 0.0)
    if flat and pressure is None:
        found = _along_flats(point(pairs, np.zeros_like(chart), chart))
        return _gone(bodies, chart, *found)
    waist, step = waist.copy(), np.full(chart.shape, np.inf)
    for _ in range(20):
        at = point(pairs, waist, chart)
        excess, by_waist, by_chart = _excess(at, waist, pressure)
        step = excess / by_waist
        waist = waist - np.clip(step, -0.7, 0.7)
        if not (abs(step) > 1e-7).any():
            break
    at = point(pairs, waist, chart)
    _, by_waist, by_chart = _excess(at, waist, pressure)
    good = (abs(step) < 1e-6) & (at.volume > 0.0)
    good &= (at.ends.sine_other <= 1.0) & (at.ends.binder.radius > 0.0)
    slope = np.where(good, at.gap_chart - at.gap_waist * by_chart / by_waist, np.nan)
    gap = np.where(good, at.gap, np.nan)
    return (waist, gap, slope) if pressure is not None else _gone(bodies, chart, waist, gap, slope)


def _along_flats(at: Point) -> tuple[Array, Array, Array]:
    """Waist, gap and slope at unit volume, from bridges of a waist of one between flats."""
    good = (at.volume > 0.0) & (at.ends.sine_other <= 1.0)
    waist = -np.log(np.where(good, at.volume, 1.0)) / 3.0
    gap = np.where(good, at.gap, np.nan) * np.exp(waist)
    slope = at.gap_chart * np.exp(waist) - gap * at.volume_chart / (3.0 * at.volume)
    return waist, gap, slope


def _gone(
    bodies: Pair, chart: Array, waist: Array, gap: Array, slope: Array
) -> tuple[Array, Array, Array]:
    """The same, with the drop that is left where a body that repels lets go."""
    if bodies.binder.cosine[0] == -1.0:
        gone = chart == 0.0
        left, height, _ = drop_left(bodies.other)
        waist[gone], gap[gone], slope[gone] = math.log(left), height, 0.0
    return waist, gap, slope


def _excess(at: Point, waist: Array, pressure: float | None) -> tuple[Array, Array, Array]:
    """What is to vanish at given zeta, and its slopes by the logarithm of the waist and zeta."""
    if pressure is not None:
        target = pressure * np.exp(waist)
        return at.ends.pressure - target, -at.shape_waist - target, -at.shape_chart
    full = at.volume > 0.0
    logarithm = np.where(full, np.log(np.where(full, at.volume, 1.0)), -1.0)
    scale = np.where(full, at.volume, 1.0)
    return logarithm, np.where(full, at.volume_waist / scale, 3.0), at.volume_chart / scale


def _last(bodies: Pair) -> int | None:
    """What ends the curve at zeta = 0, if anything does."""
    if bodies.binder.rise[0] == 0.0 or bodies.binder.cosine[0] == -1.0:
        return DETACHMENT
    return PITCHFORK if bodies.twin[0] else None


def _closed(
    bodies: Pair, flipped: bool, places: Array, kind: int, pressure: float | None = None
) -> Branch:
    """Branch through places in order, whose fold, past the last but one, is found."""
    if kind == FOLD:
        inside = places[:, -2:]
        for _ in range(2):
            nodes = np.linspace(inside[0, 0], inside[0, 1], _INSIDE)
            guess = np.interp(-nodes, -inside[0], inside[1])
            inside = _places(bodies, nodes, guess, pressure)
            end = max(1, int(np.argmax(~(inside[3] <= 0.0))))
            inside = inside[:, end - 1 : end + 1]
        middle, width = inside[0, 0], inside[0, 0] - inside[0, 1]
        for reach in (2.0, 0.01):  # a fit to the slope, about the bracket and about its root
            nodes = middle + reach * width * np.linspace(1.0, -1.0, 7)
            near = _places(bodies, nodes, np.full(7, inside[1, 0]), pressure)
            middle = _root(near[0], near[3], middle)
        top = _places(bodies, np.array([middle]), near[1, 3:4], pressure)
        if not _is_top(top, places):  # no polynomial: a sharp turn, as next to a detachment
            middle = _halved(bodies, inside, pressure)
            top = _places(bodies, np.array([middle]), inside[1, :1], pressure)
        if not top[2, 0] >= places[2, -2] * (1.0 - 1e-10):
            raise ConvergenceError("the fold of the bridge was not found", places)
        top[3] = 0.0
        places = np.hstack((places[:, :-1], top))
    return Branch(bodies, flipped, places[0], places[1], places[2], places[3], kind)


def _is_top(top: Array, places: Array) -> bool:
    """Whether a place is the fold: no slope is left, and the gap is as large as before it."""
    level = abs(top[3, 0]) <= 1e-6 * max(1.0, abs(places[3, -1]))
    return bool(level and top[2, 0] >= places[2, -2])


def _halved(bodies: Pair, inside: Array, pressure: float | None) -> float:
    """Place between two at which the slope changes sign, or beyond which there is no bridge."""

    def slope(chart: float) -> float:
        found = float(_places(bodies, np.array([chart]), inside[1, :1], pressure)[3, 0])
        return found if math.isfinite(found) else 1.0

    low, high = float(inside[0, 0]), float(inside[0, 1])
    if not slope(low) < 0.0 < slope(high):
        return low
    return bracketed_root(slope, low, high)


def _root(x: Array, y: Array, near: float) -> float:
    """Root nearest to a place of the polynomial through values, or the place if it has none."""
    good = np.isfinite(y)
    half = 0.5 * (x[0] - x[-1])
    if good.sum() < 3 or not half > 0.0:
        return near
    t = (x[good] - near) / half
    powers = np.vander(t, int(good.sum()))
    roots = np.roots(np.linalg.lstsq(powers, y[good] / abs(y[good]).max(), rcond=None)[0])
    real = roots[abs(roots.imag) < 1e-6].real
    return float(near + half * real[np.argmin(abs(real))]) if real.size else near


def march(
    bodies: Pair, flipped: bool, waist: float, chart: float, pressure: float | None = None
) -> Branch:
    """Follow the curve of unit volume, or of a pressure, from a stable place to its limit."""
    columns = _places(bodies, np.array([chart]), np.array([waist]), pressure)
    step = 0.4
    for _ in range(80):
        here, last = columns[:, -1], _last(bodies) if columns[0, -1] > 0.0 else None
        nodes = here[0] - max(step, 0.1 * here[0]) * np.arange(1.0, 7.0)
        if here[0] > 0.0 >= nodes[-1]:  # the end that binds is sure only once zero is passed
            nodes = np.append(nodes[nodes > 1e-3], 0.0)
        rate = 0.3
        if columns.shape[1] > 1:
            rate = (here[1] - columns[1, -2]) / (here[0] - columns[0, -2])
        new = _places(bodies, nodes, here[1] + rate * (nodes - here[0]), pressure)
        bad, turned = np.flatnonzero(~np.isfinite(new[2])), np.flatnonzero(new[3] > 0.0)
        first_bad = int(bad[0]) if bad.size else nodes.size
        if turned.size and turned[0] < first_bad:
            columns = np.hstack((columns, new[:, : turned[0] + 1]))
            return _closed(bodies, flipped, columns, FOLD, pressure)
        columns = np.hstack((columns, new[:, :first_bad]))
        if columns[0, -1] == 0.0 and last is not None:
            return _closed(bodies, flipped, columns, last)
        step *= 0.3 if first_bad == 0 else 1.0
        must = bool(first_bad == 0 and nodes[0] == 0.0)
        bodies, now, there = _rebound(bodies, flipped, columns[:, -1], must=must)
        if now != flipped:
            flipped = now
            columns = _places(bodies, there, columns[1, -1:], pressure)
    raise ConvergenceError("no limit of the bridge was found", columns)


def _places(bodies: Pair, chart: Array, waist: Array, pressure: float | None) -> Array:
    """Rows chart, waist, gap and slope."""
    return np.stack((chart, *along(bodies, chart, waist, pressure)))


def _rebound(bodies: Pair, flipped: bool, place: Array, *, must: bool) -> tuple[Pair, bool, Array]:
    chart, waist = place[:1], place[1:2]
    k = bodies.binder.curvature * np.exp(waist)
    shape = (bodies.binder.cosine - k) * np.cosh(chart) / (1.0 + k)
    bodies, now, there = rebind(bodies, np.array([flipped]), waist, shape, chart, must=must)
    return bodies, bool(now[0]), there


def flat_branch(bodies: Pair, flipped: bool) -> Branch:
    """Whole curve of unit volume between flats, whose waist follows from the volume."""
    last = _last(bodies)
    straight = abs(bodies.binder.cosine[0] + bodies.other.cosine[0]) < 1e-14
    # a thin film between such plates is straight, and zeta vanishes with its gap
    chunks = (_STRAIGHT, *_CHUNKS[2:]) if straight else _CHUNKS
    columns = np.empty((4, 0))
    for nodes in chunks[:1] if last is not None else chunks:
        if last == DETACHMENT:  # the gap ends like zeta^2 log zeta, with nothing finer
            nodes = nodes[(nodes == 0.0) | (nodes > 1e-4)]
        waist, gap, slope = along(bodies, nodes, np.zeros(nodes.size))
        turned = np.flatnonzero(~(slope <= 0.0))
        end = int(turned[0]) + 1 if turned.size else nodes.size
        columns = np.hstack((columns, np.stack((nodes, waist, gap, slope))[:, :end]))
        if turned.size:
            return _closed(bodies, flipped, columns, FOLD)
    if last is None:
        raise ConvergenceError("no limit of the bridge was found between flats")
    return _closed(bodies, flipped, columns, last)
