"""The force of a rough contact over its approach, as tables that need no numpy.

A contact that is pressed for the first time follows one curve. Once it is plastic it does not
come back on it: on the way out it is the elastic contact of the surface that was left behind,
which lets go at a residual approach above zero. That branch depends on the largest approach
alone; pressed again, the contact follows it up to there, and then goes on along the first curve.

All curves rise. What they pass by: time (creep, rate), and friction.
"""

from __future__ import annotations

import math
from bisect import bisect_right
from collections.abc import Callable, Mapping, Sequence
from enum import IntEnum
from itertools import pairwise
from typing import Any, NamedTuple

from attrs import evolve, field, frozen

from ...errors import DescriptionError, InfeasibleError
from ...numerics.monotone_cubic import Curve, monotone_curve, power_curve
from ...numerics.quadrature import gauss_legendre
from ...numerics.roots import bracketed_root
from ...units import si

__all__ = [
    "HERTZ",
    "StopBranch",
    "LoadDisplacementCurve",
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
    """Make a way out of what `LoadDisplacementCurve.to_data` gave."""
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


_SAME = 1e-12  # approaches closer than this, relatively, are one


@frozen(kw_only=True)
class LoadDisplacementCurve:
    """Force, stiffness and areas of a contact over its approach, with the memory of plasticity.

    Tables are monotone cubics, for force and area in logarithms. They start as a power law of an
    exponent of at least 1.5 (Hertz), so force and stiffness are zero at touch.

    Attributes
    ----------
    approach, force, contact_area, plastic_area : tuple of float
        The first loading: approach from first touch [m], force [N], areas [m2].
    unloading : tuple of Unloading
        Ways out from some largest approaches; none for an elastic contact.
    elastic_limit : float
        Approach up to which all is reversible [m].
    nominal_area : float
        Area that force and areas belong to [m2].
    datum : str
        What the approach is measured against.
    error : float
        How far the force is off between the points, relative [-]: estimated from the tables that
        every other point makes, so it is on the safe side.
    """

    approach: tuple[float, ...] = field(converter=as_floats, metadata=si("m"))
    force: tuple[float, ...] = field(converter=as_floats, metadata=si("N"))
    contact_area: tuple[float, ...] = field(converter=as_floats, metadata=si("m2"))
    plastic_area: tuple[float, ...] = field(converter=as_floats, metadata=si("m2"))
    unloading: tuple[Unloading, ...] = ()
    elastic_limit: float = field(metadata=si("m"))
    nominal_area: float = field(metadata=si("m2"))
    datum: str = ""
    error: float = field(default=0.0, metadata=si("-"))
    _first: Curve = field(init=False, repr=False, eq=False)
    _area: Curve = field(init=False, repr=False, eq=False)
    _plastic: Curve = field(init=False, repr=False, eq=False)
    _residual: Curve = field(init=False, repr=False, eq=False)
    _works: tuple[float, ...] = field(init=False, repr=False, eq=False)
    _ways: tuple[Way, ...] = field(init=False, repr=False, eq=False)
    _ends: tuple[float, ...] = field(init=False, repr=False, eq=False)
    _last: WayBack = field(init=False, repr=False, eq=False)
    _lost: tuple[float, float] = field(init=False, repr=False, eq=False)

    def __attrs_post_init__(self) -> None:
        n = len(self.approach)
        rows = (self.force, self.contact_area, self.plastic_area)
        if n < 2 or any(len(row) != n for row in rows):
            expected = "be two or more, each with a force and two areas"
            raise DescriptionError("LoadDisplacementCurve.approach", n, expected)
        ends = [u.largest_approach for u in self.unloading]
        if ends and not self.elastic_limit < ends[0] <= ends[-1] <= self.approach[-1]:
            expected = f"lie above {self.elastic_limit:g} m and not above {self.approach[-1]:g} m"
            raise DescriptionError("LoadDisplacementCurve.unloading", ends, expected, unit="m")
        self._keep(_first=power_curve(self.approach, self.force, HERTZ))
        self._keep(_area=power_curve(self.approach, self.contact_area, 1.0))
        self._keep(_plastic=monotone_curve((0.0, *self.approach), (0.0, *self.plastic_area)))
        self._keep(_works=self._node_works())
        residuals = [u.residual_approach for u in self.unloading]
        self._keep(
            _residual=monotone_curve((self.elastic_limit, *ends), (0.0, *residuals))
            if ends
            else lambda largest: (0.0, 0.0)
        )
        self._keep(_ways=self._ready_ways())
        self._keep(_ends=tuple(one.largest for one in self._ways), _last=WayBack())
        self._keep(_lost=(-1.0, 0.0))

    def _keep(self, **made: Any) -> None:
        for name, value in made.items():
            object.__setattr__(self, name, value)

    def _node_works(self) -> tuple[float, ...]:
        slope = self._first(self.approach[0])[1]
        power = slope * self.approach[0] / self.force[0]
        works = [self.force[0] * self.approach[0] / (power + 1.0)]
        for i in range(len(self.approach) - 1):
            works.append(works[-1] + area_below(self._first, *self.approach[i : i + 2]))
        return tuple(works)

    def _ready_ways(self) -> tuple[Way, ...]:
        ways, limit = list[Way](), self.elastic_limit
        if self.unloading and limit > 0.0:
            nodes, work = self.approach, self.work(limit)
            ways.append(reversible_way(self._first, self._area, limit, work, nodes))
        ways += [way_of(one) for one in self.unloading]
        return tuple(ways)

    # the contact ------------------------------------------------------------------------------

    @property
    def most(self) -> float:
        """Largest approach of the tables [m]."""
        return self.approach[-1]

    def at(self, approach: float, largest: float = 0.0, *, beyond: bool = False) -> StopPoint:
        """Force, stiffness and areas at an approach.

        Parameters
        ----------
        approach : float
            Approach from first touch [m]; negative while the bodies are apart.
        largest : float
            Largest approach the contact has had [m].
        beyond : bool
            Beyond the tables go on along the tangent, on the branch BEYOND, reversibly and with
            the areas of their end; otherwise refuse.

        Raises
        ------
        InfeasibleError
            If the approach lies beyond the tables, unless `beyond`.
        DescriptionError
            If a number is nan.

        Notes
        -----
        `plastic_area` is what has yielded so far: it stays on the way out.
        """
        if math.isnan(approach) or math.isnan(largest):
            raise DescriptionError(
                "LoadDisplacementCurve.at", (approach, largest), "be numbers", unit="m"
            )
        largest = min(max(largest, 0.0), self.most)
        if approach > self.most * (1.0 + _SAME) and not beyond:
            raise InfeasibleError(
                f"an approach of {approach:.6g} m lies beyond the tables of this contact, which "
                f"end at {self.most:.6g} m and {self.force[-1]:.6g} N; make them with larger loads"
            )
        plastic = self._plastic(min(max(approach, largest), self.most))[0]
        force, stiffness = self.force_at(approach, largest)
        if force <= 0.0:
            return StopPoint(0.0, 0.0, 0.0, plastic, StopBranch.FREE)
        if approach < largest and largest > self.elastic_limit:
            way = self._way_back(largest)
            share = (approach - way.residual) / way.length
            area = sum(weight * one.area(share)[0] for weight, one in way.mixed)
            area *= self._area(largest)[0]
            return StopPoint(force, stiffness, area, plastic, StopBranch.UNLOADING)
        area = self._area(min(approach, self.most))[0]
        on = StopBranch.BEYOND if approach > self.most * (1.0 + _SAME) else StopBranch.LOADING
        return StopPoint(force, stiffness, area, plastic, on)

    def force_at(self, approach: float, largest: float) -> tuple[float, float]:
        """Force [N] and its slope [N/m] as in `at`, unchecked, along the tangent beyond the end."""
        first = self._first(approach)
        if approach >= min(largest, self.most) or largest <= self.elastic_limit:
            return first
        way = self._way_back(min(largest, self.most))
        share, force, slope = (approach - way.residual) / way.length, 0.0, 0.0
        if share <= 0.0:
            return 0.0, 0.0
        for weight, one in way.mixed:
            value, rate = one.force(share)
            force, slope = force + weight * value, slope + weight * rate
        if force * way.whole > first[0]:  # mixed a little too high: no way gives more than it took
            return first
        return force * way.whole, slope * way.whole / way.length

    def _way_back(self, largest: float) -> WayBack:
        """The way out from a largest approach: those that were solved on both sides, mixed."""
        if largest == self._last.largest:  # it changes seldom, and is asked for often
            return self._last
        ways, i = self._ways, bisect_right(self._ends, largest)
        mixed: tuple[tuple[float, Way], ...]
        if i in (0, len(ways)):
            mixed = ((1.0, ways[max(i - 1, 0)]),)
        else:
            low, high = ways[i - 1], ways[i]
            t = math.log(largest / low.largest) / math.log(high.largest / low.largest)
            mixed = ((1.0 - t, low), (t, high))
        residual = self._residual(largest)[0]
        made = WayBack(largest, residual, largest - residual, self._first(largest)[0], mixed)
        self._keep(_last=made)
        return made

    def residual(self, largest: float) -> float:
        """Approach at which the contact lets go after a largest approach [m]."""
        return self._residual(min(largest, self.most))[0] if largest > self.elastic_limit else 0.0

    # energy -----------------------------------------------------------------------------------

    def work(self, approach: float) -> float:
        """Work of the first loading up to an approach within the tables [J]."""
        if approach <= self.approach[0]:
            value, slope = self._first(approach)
            return value * approach / (slope * approach / value + 1.0) if value > 0.0 else 0.0
        i = bisect_right(self.approach, min(approach, self.most)) - 1
        start = self.approach[i]
        rest = area_below(self._first, start, min(approach, self.most))
        force, slope = self.force[-1], self._first(self.most)[1]
        over = max(approach - self.most, 0.0)
        return self._works[i] + rest + over * (force + 0.5 * slope * over)

    def recoverable(self, largest: float) -> float:
        """Work that comes back on the way out from a largest approach [J]."""
        within = min(largest, self.most)
        over, largest = self.work(largest) - self.work(within), within
        if largest <= self.elastic_limit:
            return self.work(largest) + over
        way = self._way_back(largest)
        mean = sum(weight * one.mean for weight, one in way.mixed)
        cut = area_above(self._first, way, self.approach)  # `force_at` does not go there either
        return mean * way.whole * way.length - cut + over

    def lost(self, largest: float) -> float:
        """Work that a cycle up to a new largest approach leaves in the bodies [J].

        It is the area of the loop of `at`, to 1e-6 of the work; between the ways that were solved
        that loop is off by up to a hundredth of the work.
        """
        if largest <= self.elastic_limit:
            return 0.0
        if largest != self._lost[0]:
            lost = max(self.work(largest) - self.recoverable(largest), 0.0)
            self._keep(_lost=(largest, lost))
        return self._lost[1]

    # other forms ------------------------------------------------------------------------------

    def scaled(self, factor: float) -> LoadDisplacementCurve:
        """Return the curve of so many equal contacts side by side."""
        if not (math.isfinite(factor) and factor > 0.0):
            raise DescriptionError(
                "LoadDisplacementCurve.scaled(factor)", factor, "be positive and finite"
            )
        more: dict[str, Any] = {
            name: tuple(factor * value for value in getattr(self, name))
            for name in ("force", "contact_area", "plastic_area")
        }
        out = tuple(u._replace(plastic_volume=factor * u.plastic_volume) for u in self.unloading)
        return evolve(self, unloading=out, nominal_area=factor * self.nominal_area, **more)

    def to_data(self) -> dict[str, Any]:
        """Return the tables as lists and numbers, for JSON."""
        return {
            "approach": list(self.approach),
            "force": list(self.force),
            "contact_area": list(self.contact_area),
            "plastic_area": list(self.plastic_area),
            "unloading": [
                {name: list(v) if isinstance(v, tuple) else v for name, v in u._asdict().items()}
                for u in self.unloading
            ],
            "elastic_limit": self.elastic_limit,
            "nominal_area": self.nominal_area,
            "datum": self.datum,
            "error": self.error,
        }

    @classmethod
    def from_data(cls, data: Mapping[str, Any]) -> LoadDisplacementCurve:
        """Make a curve of what `to_data` gave.

        Raises
        ------
        DescriptionError
            If something is missing, too much or out of order.
        """
        try:
            rest = dict(data)
            out = tuple(unloading_of(one) for one in rest.pop("unloading", ()))
            return cls(unloading=out, **rest)
        except (AttributeError, TypeError, ValueError) as error:
            if isinstance(error, DescriptionError):
                raise
            raise DescriptionError(
                "LoadDisplacementCurve", str(error), "have the tables of a curve"
            ) from error
