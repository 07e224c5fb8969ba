"""Branch of bridges of one volume, from a thin film to the stability limit.

Symbols are those of `delaunay`; the volume is one. Along the branch zeta decreases and the gap
increases, up to the fold, the pitchfork of a bridge between equal bodies, or detachment from a body
that repels the liquid.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from ...errors import ConvergenceError
from ...numerics.roots import bracketed_root
from .chart import ChartPoint, Pair, point
from .delaunay import Body
from .newton import reorder_ends

__all__ = [
    "Branch",
    "DETACHMENT",
    "FOLD",
    "PITCHFORK",
    "along",
    "sessile_drop",
    "flat_branch",
    "march",
]


class SessileDrop(NamedTuple):
    """A sessile drop of unit volume on one body."""

    radius: float
    height: float
    contact_radius: float


def sessile_drop(body: Body) -> SessileDrop:
    """Sessile drop of unit volume on one body."""
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
    return SessileDrop(radius, radius * height, radius * contact)


Array = NDArray[np.float64]

FOLD, PITCHFORK, DETACHMENT = 0, 1, 2  # indices of `stability.LIMITS`
# Nodes in the bracket of a fold, twice: 3 to 17 find 24 limits alike to 1e-14, at the same cost
# within 2 %, as the evaluations are vectorised.
_INSIDE = 9
# denser towards zero, where the limit of nearly equal bodies has a cusp
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
    """Points along the branch with increasing gap, the last one at the limit."""

    bodies: Pair
    flipped: bool
    chart: Array
    log_neck: Array
    gap: Array
    slope: Array
    kind: int

    @property
    def last(self) -> tuple[float, float, float, float]:
        """Neck radius, shape and the two contact radii at the limit."""
        a = math.exp(self.log_neck[-1])
        ends = point(self.bodies, self.log_neck[-1:], self.chart[-1:]).ends
        first, last = a * float(ends.limiting.radius[0]), a * float(ends.second.radius[0])
        if self.kind == DETACHMENT:  # the formulas fail for a contact radius of zero
            first, last = 0.0, sessile_drop(self.bodies.second).contact_radius
        return (a, float(ends.shape[0]), *((last, first) if self.flipped else (first, last)))

    @property
    def first(self) -> Array:
        """Logarithm of the neck radius, shape and arc lengths at the first point."""
        ends = point(self.bodies, self.log_neck[:1], self.chart[:1]).ends
        return np.concatenate((self.log_neck[:1], ends.shape, ends.limiting.arc, ends.second.arc))

    def place(self, gap: Array) -> tuple[Array, Array]:
        """Initial guess of zeta and of the logarithm of the neck radius for given gaps."""
        i = np.clip(np.searchsorted(self.gap, gap), 1, self.gap.size - 1) - 1
        z0, z1, g0, g1 = self.chart[i], self.chart[i + 1], self.gap[i], self.gap[i + 1]
        width = z1 - z0
        m0, m1 = self.slope[i] * width, self.slope[i + 1] * width
        low, high = np.zeros(gap.shape), np.ones(gap.shape)
        for _ in range(40):  # bisection on the cubic between two points, which is (nearly) monotone
            t = 0.5 * (low + high)
            rest = 1.0 - t
            value = rest * rest * ((1.0 + 2.0 * t) * g0 + t * m0) + t * t * (
                (3.0 - 2.0 * t) * g1 - rest * m1
            )
            low, high = np.where(value < gap, t, low), np.where(value < gap, high, t)
        t = 0.5 * (low + high)
        thin = np.log(np.where(gap < self.gap[0], self.gap[0] / np.maximum(gap, 1e-300), 1.0))
        chart = z0 + t * width + 1.5 * thin
        return chart, self.log_neck[i] * (1.0 - t) + self.log_neck[i + 1] * t + 0.5 * thin


def along(
    bodies: Pair, chart: Array, log_neck: Array, pressure: float | None = None
) -> tuple[Array, Array, Array]:
    """Logarithm of the neck radius, gap, and its derivative by zeta; nan where there is no bridge.

    At unit volume, or at a given pressure.
    """
    pairs = bodies.at(np.zeros(chart.size, dtype=np.intp))
    flat = bool(bodies.limiting.curvature[0] == bodies.second.curvature[0] == 0.0)
    if flat and pressure is None:
        found = _along_flats(point(pairs, np.zeros_like(chart), chart))
        return _gone(bodies, chart, *found)
    # zeta parameterises the branch through its fold, where the gap cannot: at each zeta one
    # equation in ln a is left, whose steps of at most 0.7 halve or double the neck.
    log_neck, step = log_neck.copy(), np.full(chart.shape, np.inf)
    for _ in range(20):
        at = point(pairs, log_neck, chart)
        excess, by_neck, by_chart = _excess(at, log_neck, pressure)
        step = excess / by_neck
        log_neck = log_neck - np.clip(step, -0.7, 0.7)
        if not (abs(step) > 1e-7).any():
            break
    at = point(pairs, log_neck, chart)
    _, by_neck, by_chart = _excess(at, log_neck, pressure)
    good = (abs(step) < 1e-6) & (at.volume > 0.0)
    good &= (at.ends.sine_second <= 1.0) & (at.ends.limiting.radius > 0.0)
    slope = np.where(good, at.gap_by_chart - at.gap_by_neck * by_chart / by_neck, np.nan)
    gap = np.where(good, at.gap, np.nan)
    return (
        (log_neck, gap, slope)
        if pressure is not None
        else _gone(bodies, chart, log_neck, gap, slope)
    )


def _along_flats(at: ChartPoint) -> tuple[Array, Array, Array]:
    """Like `along`, for unit volume, from bridges between flats of unit neck radius."""
    good = (at.volume > 0.0) & (at.ends.sine_second <= 1.0)
    log_neck = -np.log(np.where(good, at.volume, 1.0)) / 3.0
    gap = np.where(good, at.gap, np.nan) * np.exp(log_neck)
    slope = at.gap_by_chart * np.exp(log_neck) - gap * at.volume_by_chart / (3.0 * at.volume)
    return log_neck, gap, slope


def _gone(
    bodies: Pair, chart: Array, log_neck: Array, gap: Array, slope: Array
) -> tuple[Array, Array, Array]:
    """Like `along`, with the sessile drop at the detachment from a repelling body."""
    if bodies.limiting.cosine[0] == -1.0:
        gone = chart == 0.0
        left, height, _ = sessile_drop(bodies.second)
        log_neck[gone], gap[gone], slope[gone] = math.log(left), height, 0.0
    return log_neck, gap, slope


def _excess(at: ChartPoint, log_neck: Array, pressure: float | None) -> tuple[Array, Array, Array]:
    """Residual at given zeta, and its derivatives by the logarithm of the neck radius and zeta."""
    if pressure is not None:
        target = pressure * np.exp(log_neck)
        return at.ends.pressure - target, -at.shape_by_neck - target, -at.shape_by_chart
    full = at.volume > 0.0
    logarithm = np.where(full, np.log(np.where(full, at.volume, 1.0)), -1.0)
    scale = np.where(full, at.volume, 1.0)
    return logarithm, np.where(full, at.volume_by_neck / scale, 3.0), at.volume_by_chart / scale


def _last(bodies: Pair) -> int | None:
    """Kind of limit at zeta = 0, if there is one."""
    if bodies.limiting.one_plus_cosine[0] == 0.0 or bodies.limiting.cosine[0] == -1.0:
        return DETACHMENT
    return PITCHFORK if bodies.symmetric[0] else None


def _closed(
    bodies: Pair, flipped: bool, places: Array, kind: int, pressure: float | None = None
) -> Branch:
    """Branch through points in order; a fold is located after the last point but one."""
    if kind == FOLD:
        # The limit is the root of the slope, not the maximum of the gap: that is flat, and would be
        # known to half of the digits only. Two refinements of the bracket by _INSIDE come before
        # fits to it.
        inside = places[:, -2:]
        for _ in range(2):
            nodes = np.linspace(inside[0, 0], inside[0, 1], _INSIDE)
            guess = np.interp(-nodes, -inside[0], inside[1])
            inside = _places(bodies, nodes, guess, pressure)
            end = max(1, int(np.argmax(~(inside[3] <= 0.0))))
            inside = inside[:, end - 1 : end + 1]
        middle, width = inside[0, 0], inside[0, 0] - inside[0, 1]
        for reach in (
            2.0,
            0.01,
        ):  # fits to the slope, around the bracket and its root
            nodes = middle + reach * width * np.linspace(1.0, -1.0, 7)
            near = _places(bodies, nodes, np.full(7, inside[1, 0]), pressure)
            middle = _root(near[0], near[3], middle)
        top = _places(bodies, np.array([middle]), near[1, 3:4], pressure)
        if not _is_top(top, places):  # not a polynomial: a sharp turn, as near a detachment
            middle = _halved(bodies, inside, pressure)
            top = _places(bodies, np.array([middle]), inside[1, :1], pressure)
        if not top[2, 0] >= places[2, -2] * (1.0 - 1e-10):
            raise ConvergenceError(
                "the fold of the bridge was not found; change volume or angles a little", places
            )
        top[3] = 0.0
        places = np.hstack((places[:, :-1], top))
    return Branch(bodies, flipped, places[0], places[1], places[2], places[3], kind)


def _is_top(top: Array, places: Array) -> bool:
    """Whether a point is the fold: zero slope, and a gap at least as large as before."""
    level = abs(top[3, 0]) <= 1e-6 * max(1.0, abs(places[3, -1]))
    return bool(level and top[2, 0] >= places[2, -2])


def _halved(bodies: Pair, inside: Array, pressure: float | None) -> float:
    """Point of a bracket at which the slope changes sign, or beyond which there is no bridge."""

    def slope(chart: float) -> float:
        found = float(_places(bodies, np.array([chart]), inside[1, :1], pressure)[3, 0])
        return found if math.isfinite(found) else 1.0

    low, high = float(inside[0, 0]), float(inside[0, 1])
    if not slope(low) < 0.0 < slope(high):
        return low
    return bracketed_root(slope, low, high)


def _root(x: Array, y: Array, near: float) -> float:
    """Root of the interpolating polynomial nearest to a point, or the point if there is none."""
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
    bodies: Pair, flipped: bool, log_neck: float, chart: float, pressure: float | None = None
) -> Branch:
    """Follow the branch of unit volume, or of given pressure, from a stable point to its limit."""
    # zeta is marched, not the gap, which has its fold there. Six points are solved at once, as
    # numpy's calls cost more than the points; what lies beyond the limit is thrown away.
    columns = _places(bodies, np.array([chart]), np.array([log_neck]), pressure)
    step = 0.4
    for _ in range(80):
        here, last = columns[:, -1], _last(bodies) if columns[0, -1] > 0.0 else None
        nodes = here[0] - max(step, 0.1 * here[0]) * np.arange(1.0, 7.0)
        if here[0] > 0.0 >= nodes[-1]:  # which end is the limiting one is known only beyond zero
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
        always = bool(first_bad == 0 and nodes[0] == 0.0)
        bodies, now, there = _reordered(bodies, flipped, columns[:, -1], always=always)
        if now != flipped:
            flipped = now
            columns = _places(bodies, there, columns[1, -1:], pressure)
    raise ConvergenceError(
        "no limit of the bridge was found; change volume or angles a little", columns
    )


def _places(bodies: Pair, chart: Array, log_neck: Array, pressure: float | None) -> Array:
    """Rows: zeta, logarithm of the neck radius, gap and slope."""
    return np.stack((chart, *along(bodies, chart, log_neck, pressure)))


def _reordered(
    bodies: Pair, flipped: bool, place: Array, *, always: bool
) -> tuple[Pair, bool, Array]:
    chart, log_neck = place[:1], place[1:2]
    k = bodies.limiting.curvature * np.exp(log_neck)
    shape = (bodies.limiting.cosine - k) * np.cosh(chart) / (1.0 + k)
    bodies, now, there = reorder_ends(
        bodies, np.array([flipped]), log_neck, shape, chart, always=always
    )
    return bodies, bool(now[0]), there


def flat_branch(bodies: Pair, flipped: bool) -> Branch:
    """Complete branch of unit volume between flats, where the volume determines the neck radius."""
    # Between flats all is explicit in zeta: no initial guess, no iteration, fixed nodes.
    last = _last(bodies)
    straight = abs(bodies.limiting.cosine[0] + bodies.second.cosine[0]) < 1e-14
    # the meridian of a thin film between such plates is straight, and zeta vanishes with the gap
    chunks = (_STRAIGHT, *_CHUNKS[2:]) if straight else _CHUNKS
    columns = np.empty((4, 0))
    for nodes in chunks[:1] if last is not None else chunks:
        if last == DETACHMENT:  # the gap ends like zeta^2 log zeta, without finer structure
            nodes = nodes[(nodes == 0.0) | (nodes > 1e-4)]
        log_neck, gap, slope = along(bodies, nodes, np.zeros(nodes.size))
        turned = np.flatnonzero(~(slope <= 0.0))
        end = int(turned[0]) + 1 if turned.size else nodes.size
        columns = np.hstack((columns, np.stack((nodes, log_neck, gap, slope))[:, :end]))
        if turned.size:
            return _closed(bodies, flipped, columns, FOLD)
    if last is None:
        raise ConvergenceError(
            "no limit of the bridge was found between flats; change the angles a little"
        )
    return _closed(bodies, flipped, columns, last)
