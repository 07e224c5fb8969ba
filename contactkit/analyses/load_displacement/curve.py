r"""The force of a rough contact over its approach, as tables that need no numpy.

A contact that is pressed for the first time follows one curve. Once it is plastic it does not
come back on it: on the way out it is the elastic contact of the surface that was left behind,
which lets go at a residual approach above zero. That branch depends on the largest approach
alone; pressed again, the contact follows it up to there, and then goes on along the first curve.

All curves rise. What they pass by: time (creep, rate), and friction.
"""

from __future__ import annotations

import math
from bisect import bisect_right
from collections.abc import Mapping
from typing import Any

from attrs import evolve, field, frozen

from ...errors import DescriptionError, InfeasibleError
from ...numerics.monotone_cubic import Curve, monotone_curve, power_curve
from ...units import si
from .zz_stop_ways import (
    HERTZ,
    StopBranch,
    StopPoint,
    Unloading,
    Way,
    WayBack,
    area_above,
    area_below,
    as_floats,
    reversible_way,
    unloading_of,
    way_of,
)

__all__ = ["StopBranch", "StopCurve", "StopPoint", "Unloading"]

_SAME = 1e-12  # approaches closer than this, relatively, are one


@frozen(kw_only=True)
class StopCurve:
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
            raise DescriptionError("StopCurve.approach", n, expected)
        ends = [u.largest_approach for u in self.unloading]
        if ends and not self.elastic_limit < ends[0] <= ends[-1] <= self.approach[-1]:
            expected = f"lie above {self.elastic_limit:g} m and not above {self.approach[-1]:g} m"
            raise DescriptionError("StopCurve.unloading", ends, expected, unit="m")
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
            raise DescriptionError("StopCurve.at", (approach, largest), "be numbers", unit="m")
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

    def scaled(self, factor: float) -> StopCurve:
        """Return the curve of so many equal contacts side by side."""
        if not (math.isfinite(factor) and factor > 0.0):
            raise DescriptionError("StopCurve.scaled(factor)", factor, "be positive and finite")
        more: dict[str, Any] = {
            name: tuple(factor * value for value in getattr(self, name))
            for name in ("force", "contact_area", "plastic_area")
        }
        out = tuple(u._replace(plastic_volume=factor * u.plastic_volume) for u in self.unloading)
        return evolve(self, unloading=out, nominal_area=factor * self.nominal_area, **more)

    def to_data(self) -> dict[str, Any]:
        """Return the tables as lists and numbers, for JSON."""
        return {
            "approach": list(self.approach), "force": list(self.force),
            "contact_area": list(self.contact_area), "plastic_area": list(self.plastic_area),
            "unloading": [
                {name: list(v) if isinstance(v, tuple) else v for name, v in u._asdict().items()}
                for u in self.unloading
            ],
            "elastic_limit": self.elastic_limit, "nominal_area": self.nominal_area,
            "datum": self.datum, "error": self.error,
        }  # fmt: skip

    @classmethod
    def from_data(cls, data: Mapping[str, Any]) -> StopCurve:
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
            raise DescriptionError("StopCurve", str(error), "have the tables of a curve") from error
