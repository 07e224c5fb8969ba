"""Load-displacement curve of a rough contact: force over approach, as tables without numpy.

The first loading follows one curve. Unloading from a plastic contact follows another one: that of
the elastic contact of the plastically deformed surface, which loses contact at a residual approach
above zero. It depends on the maximum approach alone; reloading follows it up to there and then
continues along the loading curve.

All curves rise. Left out: time (creep, rate dependence) and friction.
"""

from __future__ import annotations

import math
from bisect import bisect_right
from collections.abc import Callable, Mapping, Sequence
from enum import IntEnum
from functools import partial
from itertools import pairwise
from typing import Any, ClassVar, NamedTuple

from attrs import evolve, field, fields, frozen

from ...errors import DescriptionError, InfeasibleError
from ...numerics.monotone_cubic import Curve as Spline
from ...numerics.monotone_cubic import monotone_curve, power_curve
from ...numerics.quadrature import gauss_legendre
from ...numerics.roots import bracketed_root
from ...scene.curve import Curve
from ...units import si

__all__ = [
    "HERTZ",
    "Branch",
    "CurvePoint",
    "LoadDisplacementCurve",
    "NormalizedUnloading",
    "Unloading",
    "UnloadingCurve",
    "area_above",
    "area_below",
    "as_floats",
    "normalized",
    "reversible",
    "unloading_from",
]

HERTZ = 1.5  # minimum exponent at touch: a summit that is round below the grid
# Errors are those of the dissipated work of the stop of the injector, at nine largest approaches.
#
# Gauss points on a piece of a table: 1e-13; 6 leave 1e-10, 4 leave 2e-6.
_POINTS = 8
# The same for the area that is cut off, which is a thousandth of the work: 1e-6; 2 leave 2e-4, 6
# nothing, for twice the points.
_COARSE = 3
# Fraction of an unloading curve below which the part cut off is negligible, as the loading curve
# crosses it far above: 1e-5 to 0.05 give the same.
_LEAST = 1e-3


class Branch(IntEnum):
    """Branch of the load-displacement curve."""

    FREE = 1
    LOADING = 2
    UNLOADING = 3
    BEYOND = 4


class CurvePoint(NamedTuple):
    """Force [N], its slope over the approach [N/m], and areas [m2], on a branch."""

    force: float
    stiffness: float
    contact_area: float
    plastic_area: float
    branch: Branch


class ForceAt(NamedTuple):
    """Force [N] and its slope over the approach [N/m]."""

    force: float
    stiffness: float


class Unloading(NamedTuple):
    """A computed unloading curve, from its maximum to its residual approach.

    `fractions` are those of the distance from the residual to the maximum approach; `forces` and
    `areas` are over those at the maximum approach. `plastic_volume` [m3] is that of the overlap
    for which plastic flow has made room.
    """

    max_approach: float
    residual_approach: float
    fractions: tuple[float, ...]
    forces: tuple[float, ...]
    areas: tuple[float, ...]
    plastic_volume: float


class NormalizedUnloading(NamedTuple):
    """An unloading curve over its values at the maximum approach, as functions of the fraction.

    `mean` is the mean of the normalised force, `nodes` the fractions of its table.
    """

    max_approach: float
    force: Spline
    area: Spline
    mean: float
    nodes: tuple[float, ...]


class UnloadingCurve(NamedTuple):
    """The unloading curve from any maximum approach: a weighted mean of normalised ones.

    `length` is the distance from the `residual` to the maximum approach [m], `max_force` the force
    there [N]; `parts` are pairs of a weight and a normalised curve.
    """

    max_approach: float = -1.0
    residual: float = 0.0
    length: float = 0.0
    max_force: float = 0.0
    parts: tuple[tuple[float, NormalizedUnloading], ...] = ()


def as_floats(values: Sequence[float]) -> tuple[float, ...]:
    """Convert numbers of any kind to a tuple of Python's own."""
    return tuple(float(value) for value in values)


def unloading_from(data: Mapping[str, Any]) -> Unloading:
    """Make an unloading curve from the data of `LoadDisplacementCurve.to_data`."""
    made = Unloading(**data)
    return made._replace(
        fractions=as_floats(made.fractions),
        forces=as_floats(made.forces),
        areas=as_floats(made.areas),
    )


def normalized(one: Unloading) -> NormalizedUnloading:
    """Interpolate a computed unloading curve."""
    force = power_curve(one.fractions, one.forces, HERTZ)
    area = power_curve(one.fractions, one.areas, 1.0)
    first = one.fractions[0]
    power = force(first)[1] * first / one.forces[0]
    mean = one.forces[0] * first / (power + 1.0)
    mean += sum(area_below(force, a, b) for a, b in pairwise(one.fractions))
    return NormalizedUnloading(one.max_approach, force, area, mean, one.fractions)


def reversible(
    loading: Spline, area: Spline, limit: float, work: float, nodes: Sequence[float]
) -> NormalizedUnloading:
    """Unloading curve from the elastic limit: the loading curve itself, of given work up to it."""
    force_there, area_there = loading(limit)[0], area(limit)[0]

    def unloading(fraction: float) -> tuple[float, float]:
        value, slope = loading(fraction * limit)
        return value / force_there, slope * limit / force_there

    def touching(fraction: float) -> tuple[float, float]:
        value, slope = area(fraction * limit)
        return value / area_there, slope * limit / area_there

    fractions = tuple(x / limit for x in nodes if x < limit)
    return NormalizedUnloading(limit, unloading, touching, work / (force_there * limit), fractions)


def area_below(curve: Spline, a: float, b: float) -> float:
    """Integral of a curve between two positive points, in the logarithm."""
    if b <= a:
        return 0.0
    width, total = math.log(b / a), 0.0
    for node, weight in zip(*gauss_legendre(_POINTS), strict=True):
        x = a * math.exp(width * node)
        total += weight * curve(x)[0] * x
    return width * total


def area_above(loading: Spline, back: UnloadingCurve, nodes: Sequence[float]) -> float:
    """Area of an unloading curve that lies above the loading curve, whose nodes are given.

    Both are smooth between the nodes; a piece is skipped if it is not above at either end and does
    not rise from one to fall to the other. The area is a thousandth of the work, so a few points
    on a piece are enough.
    """
    ends = {back.residual + back.length * n for _, one in back.parts for n in (_LEAST, *one.nodes)}
    ends |= {x for x in nodes if x > min(ends)}
    xs = [*sorted(x for x in ends if x < back.max_approach), back.max_approach]

    def over(x: float) -> tuple[float, float]:
        fraction = (x - back.residual) / back.length
        mixed = [(weight, one.force(fraction)) for weight, one in back.parts]
        value, slope = loading(x)
        force = back.max_force * sum([weight * at[0] for weight, at in mixed])
        rise = back.max_force / back.length * sum([weight * at[1] for weight, at in mixed])
        return force - value, rise - slope

    at = [over(x) for x in xs]
    at[-1] = 0.0, at[-1][1]  # there both meet
    return sum(
        _positive_area(over, *ends)
        for ends, (low, high) in zip(pairwise(xs), pairwise(at), strict=True)
        if max(low[0], high[0]) > 0.0 or low[1] > 0.0 > high[1]
    )


def _positive_area(over: Spline, a: float, b: float) -> float:
    """Integral of the positive part of a smooth function of known slope."""
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
class LoadDisplacementCurve(Curve):
    """Force, stiffness and areas of a contact over its approach, with the memory of plasticity.

    Tables are monotone cubics, for force and area in logarithms. They start as a power law of an
    exponent of at least 1.5 (Hertz), so force and stiffness are zero at touch.

    Attributes
    ----------
    approach, force, contact_area, plastic_area : tuple of float
        First loading: approach from first touch [m], force [N], areas [m2].
    unloading : tuple of Unloading
        Unloading curves from some maximum approaches; none for an elastic contact.
    elastic_limit : float
        Approach up to which the contact is reversible [m].
    nominal_area : float
        Area that force and areas belong to [m2].
    datum : str
        Datum of the approach.
    error : float
        Relative error of the force between the points [-], estimated from the tables of every
        other point and therefore conservative.
    """

    axis: ClassVar[str] = "approach"

    approach: tuple[float, ...] = field(converter=as_floats, metadata=si("m"))
    force: tuple[float, ...] = field(converter=as_floats, metadata=si("N"))
    contact_area: tuple[float, ...] = field(converter=as_floats, metadata=si("m2"))
    plastic_area: tuple[float, ...] = field(converter=as_floats, metadata=si("m2"))
    unloading: tuple[Unloading, ...] = ()
    elastic_limit: float = field(metadata=si("m"))
    nominal_area: float = field(metadata=si("m2"))
    datum: str = ""
    error: float = field(default=0.0, metadata=si("-"))
    _loading: Spline = field(init=False, repr=False, eq=False)
    _area: Spline = field(init=False, repr=False, eq=False)
    _plastic: Spline = field(init=False, repr=False, eq=False)
    _residual: Spline = field(init=False, repr=False, eq=False)
    _works: tuple[float, ...] = field(init=False, repr=False, eq=False)
    _normalized: tuple[NormalizedUnloading, ...] = field(init=False, repr=False, eq=False)
    _ends: tuple[float, ...] = field(init=False, repr=False, eq=False)
    _last: UnloadingCurve = field(init=False, repr=False, eq=False)
    _dissipated: tuple[float, float] = field(init=False, repr=False, eq=False)

    def __attrs_post_init__(self) -> None:
        n = len(self.approach)
        rows = (self.force, self.contact_area, self.plastic_area)
        if n < 2 or any(len(row) != n for row in rows):
            expected = "be two or more, each with a force and two areas"
            raise DescriptionError("LoadDisplacementCurve.approach", n, expected)
        ends = [u.max_approach for u in self.unloading]
        if ends and not self.elastic_limit < ends[0] <= ends[-1] <= self.approach[-1]:
            expected = f"lie above {self.elastic_limit:g} m and not above {self.approach[-1]:g} m"
            raise DescriptionError("LoadDisplacementCurve.unloading", ends, expected, unit="m")
        self._keep(_loading=power_curve(self.approach, self.force, HERTZ))
        self._keep(_area=power_curve(self.approach, self.contact_area, 1.0))
        self._keep(_plastic=monotone_curve((0.0, *self.approach), (0.0, *self.plastic_area)))
        self._keep(_works=self._node_works())
        residuals = [u.residual_approach for u in self.unloading]
        self._keep(
            _residual=monotone_curve((self.elastic_limit, *ends), (0.0, *residuals))
            if ends
            else lambda max_approach: (0.0, 0.0)
        )
        self._keep(_normalized=self._normalized_unloading())
        self._keep(_ends=tuple(one.max_approach for one in self._normalized))
        self._keep(_last=UnloadingCurve(), _dissipated=(-1.0, 0.0))

    def __reduce__(self) -> tuple[Any, ...]:
        """Pickle the tables, of which the same curve is made again: its splines are functions."""
        given = {a.name: getattr(self, a.name) for a in fields(type(self)) if a.init}
        return partial(type(self), **given), ()

    def _keep(self, **made: Any) -> None:
        for name, value in made.items():
            object.__setattr__(self, name, value)

    def _node_works(self) -> tuple[float, ...]:
        slope = self._loading(self.approach[0])[1]
        power = slope * self.approach[0] / self.force[0]
        works = [self.force[0] * self.approach[0] / (power + 1.0)]
        for i in range(len(self.approach) - 1):
            works.append(works[-1] + area_below(self._loading, *self.approach[i : i + 2]))
        return tuple(works)

    def _normalized_unloading(self) -> tuple[NormalizedUnloading, ...]:
        found, limit = list[NormalizedUnloading](), self.elastic_limit
        if self.unloading and limit > 0.0:
            found.append(
                reversible(self._loading, self._area, limit, self.work(limit), self.approach)
            )
        found += [normalized(one) for one in self.unloading]
        return tuple(found)

    @property
    def title(self) -> str:
        """See `Curve.title`."""
        return f"first loading, approach from {self.datum}"

    @property
    def parts(self) -> Mapping[str, Any]:
        """See `Curve.parts`."""
        return {"unloading": self.unloading}

    # the contact ------------------------------------------------------------------------------

    @property
    def max_approach(self) -> float:
        """Maximum approach of the tables [m]."""
        return self.approach[-1]

    def at(self, approach: float, max_approach: float = 0.0, *, beyond: bool = False) -> CurvePoint:
        """Force, stiffness and areas at an approach.

        Parameters
        ----------
        approach : float
            Approach from first touch [m]; negative while the bodies are apart.
        max_approach : float
            Maximum approach the contact has had [m].
        beyond : bool
            Whether to continue beyond the tables along the tangent, on the branch BEYOND,
            reversibly and with the areas of their end; otherwise that is refused.

        Raises
        ------
        InfeasibleError
            If the approach lies beyond the tables, unless `beyond`.
        DescriptionError
            If a number is nan.

        Notes
        -----
        `plastic_area` is the area that has yielded so far; it does not change on unloading.
        """
        if math.isnan(approach) or math.isnan(max_approach):
            raise DescriptionError(
                "LoadDisplacementCurve.at", (approach, max_approach), "be numbers", unit="m"
            )
        max_approach = min(max(max_approach, 0.0), self.max_approach)
        if approach > self.max_approach * (1.0 + _SAME) and not beyond:
            raise InfeasibleError(
                f"an approach of {approach:.6g} m lies beyond the tables of this contact, which "
                f"end at {self.max_approach:.6g} m and {self.force[-1]:.6g} N; make them with "
                "larger loads"
            )
        plastic = self._plastic(min(max(approach, max_approach), self.max_approach))[0]
        force, stiffness = self.force_at(approach, max_approach)
        if force <= 0.0:
            return CurvePoint(0.0, 0.0, 0.0, plastic, Branch.FREE)
        if approach < max_approach and max_approach > self.elastic_limit:
            back = self._unloading_curve(max_approach)
            fraction = (approach - back.residual) / back.length
            area = sum(weight * one.area(fraction)[0] for weight, one in back.parts)
            area *= self._area(max_approach)[0]
            return CurvePoint(force, stiffness, area, plastic, Branch.UNLOADING)
        area = self._area(min(approach, self.max_approach))[0]
        on = Branch.BEYOND if approach > self.max_approach * (1.0 + _SAME) else Branch.LOADING
        return CurvePoint(force, stiffness, area, plastic, on)

    def force_at(self, approach: float, max_approach: float) -> ForceAt:
        """Force and slope as in `at`, unchecked, along the tangent beyond the end."""
        loading = ForceAt(*self._loading(approach))
        if approach >= min(max_approach, self.max_approach) or max_approach <= self.elastic_limit:
            return loading
        back = self._unloading_curve(min(max_approach, self.max_approach))
        fraction, force, slope = (approach - back.residual) / back.length, 0.0, 0.0
        if fraction <= 0.0:
            return ForceAt(0.0, 0.0)
        for weight, one in back.parts:
            value, rate = one.force(fraction)
            force, slope = force + weight * value, slope + weight * rate
        if force * back.max_force > loading.force:  # by interpolation only: no cycle gains energy
            return loading
        return ForceAt(force * back.max_force, slope * back.max_force / back.length)

    def _unloading_curve(self, max_approach: float) -> UnloadingCurve:
        """Unloading curve from a maximum approach, interpolated between the computed ones."""
        if max_approach == self._last.max_approach:  # changes seldom, and is evaluated often
            return self._last
        known, i = self._normalized, bisect_right(self._ends, max_approach)
        parts: tuple[tuple[float, NormalizedUnloading], ...]
        if i in (0, len(known)):
            parts = ((1.0, known[max(i - 1, 0)]),)
        else:
            low, high = known[i - 1], known[i]
            t = math.log(max_approach / low.max_approach)
            t /= math.log(high.max_approach / low.max_approach)
            parts = ((1.0 - t, low), (t, high))
        residual = self._residual(max_approach)[0]
        made = UnloadingCurve(
            max_approach, residual, max_approach - residual, self._loading(max_approach)[0], parts
        )
        self._keep(_last=made)
        return made

    def residual(self, max_approach: float) -> float:
        """Residual approach [m], at which contact is lost on unloading from a maximum approach."""
        return (
            self._residual(min(max_approach, self.max_approach))[0]
            if max_approach > self.elastic_limit
            else 0.0
        )

    # energy -----------------------------------------------------------------------------------

    def work(self, approach: float) -> float:
        """Work of the first loading up to an approach within the tables [J]."""
        if approach <= self.approach[0]:
            value, slope = self._loading(approach)
            return value * approach / (slope * approach / value + 1.0) if value > 0.0 else 0.0
        i = bisect_right(self.approach, min(approach, self.max_approach)) - 1
        start = self.approach[i]
        rest = area_below(self._loading, start, min(approach, self.max_approach))
        force, slope = self.force[-1], self._loading(self.max_approach)[1]
        over = max(approach - self.max_approach, 0.0)
        return self._works[i] + rest + over * (force + 0.5 * slope * over)

    def elastic_work(self, max_approach: float) -> float:
        """Elastic work recovered on unloading from a maximum approach [J]."""
        within = min(max_approach, self.max_approach)
        over, max_approach = self.work(max_approach) - self.work(within), within
        if max_approach <= self.elastic_limit:
            return self.work(max_approach) + over
        back = self._unloading_curve(max_approach)
        mean = sum(weight * one.mean for weight, one in back.parts)
        cut = area_above(self._loading, back, self.approach)  # left out by `force_at` too
        return mean * back.max_force * back.length - cut + over

    def dissipated_work(self, max_approach: float) -> float:
        """Work dissipated by loading to a new maximum approach and unloading [J].

        It is the area of the hysteresis loop of `at`, to 1e-6 of the work; between the computed
        unloading curves that loop is off by up to a hundredth of the work.
        """
        if max_approach <= self.elastic_limit:
            return 0.0
        if max_approach != self._dissipated[0]:
            dissipated = max(self.work(max_approach) - self.elastic_work(max_approach), 0.0)
            self._keep(_dissipated=(max_approach, dissipated))
        return self._dissipated[1]

    # other forms ------------------------------------------------------------------------------

    def scaled(self, factor: float) -> LoadDisplacementCurve:
        """Return the curve of a number of equal contacts in parallel."""
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
        """Make a curve from the data of `to_data`.

        Raises
        ------
        DescriptionError
            If something is missing, unknown or out of order.
        """
        try:
            rest = dict(data)
            out = tuple(unloading_from(one) for one in rest.pop("unloading", ()))
            return cls(unloading=out, **rest)
        except (AttributeError, TypeError, ValueError) as error:
            if isinstance(error, DescriptionError):
                raise
            raise DescriptionError(
                "LoadDisplacementCurve", str(error), "have the tables of a curve"
            ) from error
