"""What the tables of an end stop are made of: points, branches, and ways out of a contact."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from enum import IntEnum
from itertools import pairwise
from typing import Any, NamedTuple

from ...numerics.monotone_cubic import Curve, power_curve
from ...numerics.quadrature import gauss_legendre
from ...numerics.roots import bracketed_root

__all__ = [
    "HERTZ",
    "StopBranch",
    "StopPoint",
    "Unloading",
    "Way",
    "WayBack",
    "area_above",
    "area_below",
    "as_floats",
    "reversible_way",
    "unloading_of",
    "way_of",
]

HERTZ = 1.5  # least exponent at touch: a summit that is round below the grid
_POINTS = 8  # of Gauss on a piece of a table
_COARSE = 3  # the same for what is cut off
_LEAST = 1e-3  # share of a way below which nothing of account is cut off


class StopBranch(IntEnum):
    """Which curve a contact is on."""

    FREE = 1
    LOADING = 2
    UNLOADING = 3
    BEYOND = 4


class StopPoint(NamedTuple):
    """Force [N], its slope over the approach [N/m], and areas [m2], on a branch."""

    force: float
    stiffness: float
    contact_area: float
    plastic_area: float
    branch: StopBranch


class Unloading(NamedTuple):
    """The way out from a largest approach, and what is left.

    `ways` are shares of the way from the residual to the largest approach; `forces` and `areas`
    are over those at the largest approach. `plastic_volume` [m3] is that of the overlap which
    plastic flow has made room for.
    """

    largest_approach: float
    residual_approach: float
    ways: tuple[float, ...]
    forces: tuple[float, ...]
    areas: tuple[float, ...]
    plastic_volume: float


class Way(NamedTuple):
    """A way out made ready: shares of force and area over it, the mean of the force, and nodes."""

    largest: float
    force: Curve
    area: Curve
    mean: float
    nodes: tuple[float, ...]


class WayBack(NamedTuple):
    """The way out from any largest approach: its length, the force at its end, and its parts."""

    largest: float = -1.0
    residual: float = 0.0
    length: float = 0.0
    whole: float = 0.0
    mixed: tuple[tuple[float, Way], ...] = ()


def as_floats(values: Sequence[float]) -> tuple[float, ...]:
    """Convert numbers of any kind to a tuple of Python's own."""
    return tuple(float(value) for value in values)


def unloading_of(data: Mapping[str, Any]) -> Unloading:
    """Make a way out of what `StopCurve.to_data` gave."""
    made = Unloading(**data)
    return made._replace(
        ways=as_floats(made.ways), forces=as_floats(made.forces), areas=as_floats(made.areas)
    )


def way_of(one: Unloading) -> Way:
    """Make a way out ready."""
    force = power_curve(one.ways, one.forces, HERTZ)
    area = power_curve(one.ways, one.areas, 1.0)
    power = force(one.ways[0])[1] * one.ways[0] / one.forces[0]
    mean = one.forces[0] * one.ways[0] / (power + 1.0)
    mean += sum(area_below(force, a, b) for a, b in pairwise(one.ways))
    return Way(one.largest_approach, force, area, mean, one.ways)


def reversible_way(
    first: Curve, area: Curve, limit: float, work: float, nodes: Sequence[float]
) -> Way:
    """Way out from the elastic limit: the first curve itself, given with its work up to there."""
    forces, areas = first(limit)[0], area(limit)[0]

    def back(way: float) -> tuple[float, float]:
        value, slope = first(way * limit)
        return value / forces, slope * limit / forces

    def touched(way: float) -> tuple[float, float]:
        value, slope = area(way * limit)
        return value / areas, slope * limit / areas

    shares = tuple(x / limit for x in nodes if x < limit)
    return Way(limit, back, touched, work / (forces * limit), shares)


def area_below(curve: Curve, a: float, b: float) -> float:
    """Integral of a curve between two positive points, in the logarithm."""
    if b <= a:
        return 0.0
    width, total = math.log(b / a), 0.0
    for node, weight in zip(*gauss_legendre(_POINTS), strict=True):
        x = a * math.exp(width * node)
        total += weight * curve(x)[0] * x
    return width * total


def area_above(first: Curve, back: WayBack, nodes: Sequence[float]) -> float:
    """Area of a way out that lies above the first curve, whose nodes are given.

    Both are smooth between the nodes; a piece is passed by if it is not above at either end and
    does not rise from one to fall to the other. The whole is a thousandth of the work, so a few
    points on a piece will do.
    """
    ends = {back.residual + back.length * n for _, way in back.mixed for n in (_LEAST, *way.nodes)}
    ends |= {x for x in nodes if x > min(ends)}
    xs = [*sorted(x for x in ends if x < back.largest), back.largest]

    def over(x: float) -> tuple[float, float]:
        share = (x - back.residual) / back.length
        mixed = [(weight, one.force(share)) for weight, one in back.mixed]
        value, slope = first(x)
        force = back.whole * sum([weight * at[0] for weight, at in mixed])
        rise = back.whole / back.length * sum([weight * at[1] for weight, at in mixed])
        return force - value, rise - slope

    at = [over(x) for x in xs]
    at[-1] = 0.0, at[-1][1]  # there both meet
    return sum(
        _positive_area(over, *ends)
        for ends, (low, high) in zip(pairwise(xs), pairwise(at), strict=True)
        if max(low[0], high[0]) > 0.0 or low[1] > 0.0 > high[1]
    )


def _positive_area(over: Curve, a: float, b: float) -> float:
    """Integral of the positive part of a smooth function, of which the slope is known too."""
    points, weights = gauss_legendre(_COARSE)

    def area(low: float, high: float) -> float:
        values = [over(low + (high - low) * point)[0] for point in points]
        return (high - low) * sum([w * v for w, v in zip(weights, values, strict=True)])

    tops = _crossings(lambda x: over(x)[1], [a, b])
    roots = _crossings(lambda x: over(x)[0], [a, *tops, b])
    return sum(max(area(*part), 0.0) for part in pairwise([a, *roots, b]))


def _crossings(function: Callable[[float], float], xs: Sequence[float]) -> list[float]:
    """Roots of a function between points where its sign changes."""
    signs = zip(pairwise(xs), pairwise([function(x) for x in xs]), strict=True)
    return [bracketed_root(function, *x, 1e-6) for x, (low, high) in signs if low * high < 0.0]
