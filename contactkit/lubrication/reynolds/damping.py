r"""Damping of films without a cavity: the force is viscosity times speed times c(h).

.. math:: F = \eta \, \dot h \, c(h), \qquad p_a - \min p = \eta \, \dot h \, d(h), \qquad
          \int F \, dt = \eta \int c \, dh

The pressure is linear in the speed whatever the shape of the gap, so one coefficient c [m], that is
N.s/m per Pa.s, and one onset d [1/m] at each gap say all: closed forms for flats, recesses and
domes, a table for the rest. Floats in and out, without numpy: an integrator calls them at every
step.
"""

from __future__ import annotations

import abc
import math
from bisect import bisect_right
from functools import cached_property
from itertools import pairwise

from attrs import Attribute, field, frozen

from ...errors import DescriptionError
from ...numerics.quadrature import gauss_legendre
from ...units import si
from ...validators import finite, positive, refuse
from ...validity import ValidityNumber

__all__ = [
    "ATMOSPHERE",
    "DampingLaw",
    "DomeDamping",
    "PowerDamping",
    "TabulatedDamping",
    "disc_damping",
    "dome_damping",
    "ellipse_damping",
    "film_tension",
    "inertia",
    "recess_damping",
    "rectangle_damping",
    "ring_damping",
    "slenderness_of",
    "triangle_damping",
]

ATMOSPHERE = 101_325.0
"""Standard atmosphere [Pa]: tension at which a liquid at ambient pressure is in vacuum."""

ZETA_5 = 1.0369277551433699
"""Riemann's zeta function of 5."""


def film_tension(tension: float, strength: float) -> ValidityNumber:
    """Tension of a film [Pa] over the tensile strength of its liquid; inf: it never cavitates."""
    bears = strength if strength < math.inf else ATMOSPHERE
    value = max(tension, 0.0) / (bears or 1.0)  # of a liquid that bears none, in Pa
    return ValidityNumber(
        name="tension over the strength of the liquid",
        value=1.0 if abs(value - 1.0) < 1e-9 else value,
        high=1.0,
        detail=f"the liquid is at {tension / 1e5:.3g} bar below ambient, and would have cavitated "
        f"at {bears / 1e5:.3g} bar; give the film a TensionLimit (a drop and a strength), or move "
        f"more slowly",
        source="strength as given; else a vacuum at ambient pressure",
    )


def slenderness_of(radius: float, height: float) -> ValidityNumber:
    """Whether a film is much wider [m] than high [m]."""
    return ValidityNumber(
        name="slenderness of the film",
        value=radius / height,
        low=5.0,
        detail="lubrication wants a film much wider than high; at a flooded rim 16 h/(3 pi r) of "
        "the force is left out",
        source="Reynolds 1886; Hasimoto 1958",
    )


def inertia(density: float | None, reynolds: float | None) -> ValidityNumber:
    """Whether the inertia of the liquid is small."""
    return ValidityNumber(
        name="Reynolds number",
        value=reynolds,
        high=1.0,
        detail="the density [kg/m3] is not given"
        if density is None
        else "inertia of the film is left out; move more slowly, or take a smaller gap",
        source="rho u h^2/(eta L), rho h' h/eta for a disc",
    )


@frozen(kw_only=True, slots=False)
class DampingLaw(abc.ABC):
    """Damping of a full film over its gap.

    Parameters
    ----------
    area : float
        Area of the film [m2].
    source : str
        Where it comes from.
    """

    area: float = field(validator=positive, metadata=si("m2"))
    source: str = ""

    @abc.abstractmethod
    def coefficient(self, gap: float) -> float:
        """Damping over viscosity, c [m], that is N.s/m per Pa.s, at a gap [m]."""

    @abc.abstractmethod
    def exponent(self, gap: float) -> float:
        """Exponent n of c ~ h^-n at a gap [m]."""

    @abc.abstractmethod
    def onset(self, gap: float) -> float:
        """Largest pressure deficit over viscosity and speed, d [1/m], at a gap [m]."""

    @abc.abstractmethod
    def impulse(self, start: float, end: float) -> float:
        """Integral of c over the gap [m2], from one gap to another [m]; `end` may be inf."""

    def force(self, gap: float, speed: float, viscosity: float) -> float:
        """Force [N] that resists separation at a gap [m], a speed [m/s] and a viscosity [Pa.s]."""
        return viscosity * speed * self.coefficient(gap)

    def validity(
        self,
        gap: float,
        speed: float,
        viscosity: float,
        *,
        strength: float = ATMOSPHERE,
        density: float | None = None,
    ) -> tuple[ValidityNumber, ...]:
        """Whether a full film is in its range at a gap [m], a speed [m/s] and a viscosity [Pa.s].

        Parameters
        ----------
        gap, speed, viscosity : float
            Where the law is used.
        strength : float
            Tension below ambient at which the liquid cavitates [Pa].
        density : float, optional
            Density of the liquid [kg/m3], for its inertia.

        Examples
        --------
        >>> for number in disc_damping(3.175e-3).validity(5e-6, 0.2, 0.1):
        ...     print(str(number).split(" (")[0])
        tension over the strength of the liquid = 4.78e+04
        slenderness of the film = 635
        Reynolds number: not evaluated, the density [kg/m3] is not given
        """
        radius = math.sqrt(self.area / math.pi)
        tension = viscosity * max(speed, 0.0) * self.onset(gap)
        number = None if density is None else density * abs(speed) * gap / viscosity
        return (
            film_tension(tension, strength),
            slenderness_of(radius, gap),
            inertia(density, number),
        )

    def onset_speed(self, gap: float, tension: float, viscosity: float) -> float:
        """Speed [m/s] at which the pressure somewhere is a tension [Pa] below ambient."""
        return tension / (viscosity * self.onset(gap))


@frozen(kw_only=True, slots=False)
class PowerDamping(DampingLaw):
    r"""Damping of flats, with or without a recess: a sum of inverse cubes.

    .. math:: c = \sum_i \frac{J_i}{(h + \delta_i)^3}, \qquad
              d = \sum_i \frac{D_i}{(h + \delta_i)^3}

    Parameters
    ----------
    terms : tuple of (J_i [m4], D_i [m2], depth delta_i [m])
        Shape factors. For a flat J is three times the torsional constant of the planform, and D
        twelve times the maximum of half its stress function.

    Examples
    --------
    >>> law = disc_damping(3.175e-3)
    >>> round(law.force(1e-5, 1e-3, 0.1), 6)
    47.886826
    """

    terms: tuple[tuple[float, float, float], ...] = field(metadata=si("m"))

    @property
    def shape_factor(self) -> float:
        """Sum of the J [m4]: c h^3 of a gap far wider than the recesses are deep."""
        return sum(j for j, _, _ in self.terms)

    def coefficient(self, gap: float) -> float:
        """See `DampingLaw.coefficient`."""
        _check(gap)
        return sum(j / (gap + depth) ** 3 for j, _, depth in self.terms)

    def exponent(self, gap: float) -> float:
        """See `DampingLaw.exponent`."""
        slope = sum(3.0 * j / (gap + depth) ** 4 for j, _, depth in self.terms)
        return gap * slope / self.coefficient(gap)

    def onset(self, gap: float) -> float:
        """See `DampingLaw.onset`."""
        _check(gap)
        return sum(d / (gap + depth) ** 3 for _, d, depth in self.terms)

    def impulse(self, start: float, end: float) -> float:
        """See `DampingLaw.impulse`."""
        _check(min(start, end))
        return sum(j * _cubes(start + depth, end + depth) for j, _, depth in self.terms)


def _curved(owner: object, attribute: Attribute[float], value: float) -> None:
    finite(owner, attribute, value)
    if value == 0.0:
        raise refuse(owner, attribute, value, "not be zero", "a flat face: disc_damping")


@frozen(kw_only=True, slots=False)
class DomeDamping(DampingLaw):
    r"""Damping of a disc under a dome or a hollow face, h + r^2/(2 R_c), with h in the middle.

    .. math:: c = \frac{6 \pi R_c^2 U^2}{h (h + U)^2}, \qquad
              d = 3 R_c \left(\frac1{h^2} - \frac1{(h + U)^2}\right), \qquad U = \frac{R^2}{2 R_c}

    Parameters
    ----------
    curvature_radius : float
        Radius of curvature R_c [m]; negative for a hollow face.
    rise : float
        Height U of the dome over its rim [m]; of a hollow face its depth, negative. Its rim is
        closed at a gap of -U in the middle, below which there is no law.
    """

    curvature_radius: float = field(validator=_curved, metadata=si("m"))
    rise: float = field(validator=_curved, metadata=si("m"))

    def __attrs_post_init__(self) -> None:
        if self.rise * self.curvature_radius < 0.0:
            expected = "have the sign of curvature_radius"
            raise DescriptionError("DomeDamping.rise", self.rise, expected, unit="m")

    def _check(self, gap: float) -> None:
        _check(gap)
        if not gap + self.rise > 0.0:
            raise DescriptionError(
                "gap",
                gap,
                f"exceed {-self.rise:g}, the depth of the hollow face",
                unit="m",
                hint="it is that in the middle: at this one the rim is closed, and the liquid is a "
                "sealed pocket",
            )

    def coefficient(self, gap: float) -> float:
        """See `DampingLaw.coefficient`."""
        self._check(gap)
        sphere, rise = self.curvature_radius, self.rise
        return 6.0 * math.pi * sphere**2 * (rise / (gap + rise)) ** 2 / gap

    def exponent(self, gap: float) -> float:
        """See `DampingLaw.exponent`."""
        self._check(gap)
        return 1.0 + 2.0 * gap / (gap + self.rise)

    def onset(self, gap: float) -> float:
        """See `DampingLaw.onset`."""
        self._check(gap)
        rim = gap + self.rise
        return 3.0 * self.curvature_radius * self.rise * (gap + rim) / (gap * rim) ** 2

    def impulse(self, start: float, end: float) -> float:
        """See `DampingLaw.impulse`."""
        from ..squeeze_film import sphere_impulse_flooded

        self._check(min(start, end))
        if end < start:
            return -self.impulse(end, start)
        if self.rise < 0.0:
            return self._hollow_impulse(start, end)
        end = min(end, 1e30 * start)
        rim_radius = math.sqrt(2.0 * self.curvature_radius * self.rise)
        return float(sphere_impulse_flooded(self.curvature_radius, rim_radius, start, end, 1.0))

    def _hollow_impulse(self, start: float, end: float) -> float:
        """Integral over the logarithm of the gap at the rim, in which c is smooth."""
        end = min(end, 1e9 * start)  # what is beyond is a rounding error
        low, high = math.log(start + self.rise), math.log(end + self.rise)
        panels = max(1, math.ceil(high - low))
        width = (high - low) / panels
        return sum(
            width * w * rim * self.coefficient(rim - self.rise)
            for panel in range(panels)
            for t, w in zip(*gauss_legendre(16), strict=True)
            for rim in (math.exp(low + (panel + t) * width),)
        )


@frozen(kw_only=True, slots=False)
class TabulatedDamping(DampingLaw):
    r"""Damping of any film, through solved points: cubics of ln c over ln h with exact slopes.

    Below the first point it is the power law, above the last the inverse cube of h plus a length,
    that meet it without a kink: beyond all roughness every film is a flat.

    Parameters
    ----------
    gaps : tuple of float
        Ascending gaps [m], two or more.
    coefficients : tuple of float
        Damping over viscosity [m].
    exponents : tuple of float
        Exponents n of c ~ h^-n at the points, over the gap plus `offset` [-].
    onsets : tuple of float
        Largest pressure deficit over viscosity and speed [1/m].
    offset : float
        What is added to a gap before its logarithm is taken [m]: the smallest of a height map.

    Raises
    ------
    DescriptionError
        If the points are fewer than two, not positive, or do not fall.

    Examples
    --------
    >>> law = TabulatedDamping(
    ...     area=1.0, gaps=(1.0, 2.0), coefficients=(8.0, 1.0), exponents=(3.0, 3.0),
    ...     onsets=(8.0, 1.0))
    >>> [round(law.coefficient(h), 9) for h in (0.5, 1.5, 4.0)], round(law.impulse(1.0, 2.0), 9)
    ([64.0, 2.37037037, 0.125], 3.0)
    """

    gaps: tuple[float, ...] = field(metadata=si("m"))
    coefficients: tuple[float, ...] = field(metadata=si("m"))
    exponents: tuple[float, ...] = field(metadata=si("-"))
    onsets: tuple[float, ...] = field(metadata=si("1/m"))
    offset: float = field(default=0.0, metadata=si("m"))

    @gaps.validator
    def _check_gaps(self, attribute: Attribute[tuple[float, ...]], value: object) -> None:
        h = self.gaps
        if len(h) < 2 or not all(a < b for a, b in pairwise(h)):
            raise refuse(self, attribute, value, "be two or more ascending gaps")

    @coefficients.validator
    def _check_coefficients(self, attribute: Attribute[tuple[float, ...]], value: object) -> None:
        c = self.coefficients
        falls = all(a > b > 0.0 for a, b in pairwise(c))
        if len(c) != len(self.gaps) or not falls:
            raise refuse(self, attribute, value, "be positive and fall, one for each gap")

    @exponents.validator
    def _check_exponents(self, attribute: Attribute[tuple[float, ...]], value: object) -> None:
        if len(self.exponents) != len(self.gaps) or not all(n > 0.0 for n in self.exponents):
            raise refuse(self, attribute, value, "be positive, one for each gap")

    @onsets.validator
    def _check_onsets(self, attribute: Attribute[tuple[float, ...]], value: object) -> None:
        if len(self.onsets) != len(self.gaps) or not all(d > 0.0 for d in self.onsets):
            raise refuse(self, attribute, value, "be positive, one for each gap")

    @offset.validator
    def _check_offset(self, attribute: Attribute[float], value: float) -> None:
        if not self.gaps[0] + value > 0.0:
            raise refuse(self, attribute, value, "leave the first gap positive")

    @cached_property
    def _logs(self) -> tuple[list[float], list[float], list[float]]:
        """Logarithms of gap and c, and slopes, cut so that c nowhere rises."""
        x = [math.log(h + self.offset) for h in self.gaps]
        y = [math.log(c) for c in self.coefficients]
        falls = [(y[i] - y[i + 1]) / (x[i + 1] - x[i]) for i in range(len(x) - 1)]
        least = [falls[0], *map(min, falls, falls[1:]), falls[-1]]
        slopes = [-min(n, 3.0 * fall) for n, fall in zip(self.exponents, least, strict=True)]
        return x, y, slopes

    @cached_property
    def _beyond(self) -> float:
        """Length that is added to the gap beyond the last point."""
        x, _, slopes = self._logs
        return math.exp(x[-1]) * (3.0 / -slopes[-1] - 1.0)

    def _log(self, x: float) -> tuple[float, float]:
        """Logarithm of c and its slope within the points."""
        nodes, y, slopes = self._logs
        i = min(max(bisect_right(nodes, x) - 1, 0), len(nodes) - 2)
        width = nodes[i + 1] - nodes[i]
        t, fall = (x - nodes[i]) / width, (y[i + 1] - y[i]) / width
        bend = 3.0 * fall - 2.0 * slopes[i] - slopes[i + 1]
        twist = slopes[i] + slopes[i + 1] - 2.0 * fall
        value = y[i] + width * t * (slopes[i] + t * (bend + t * twist))
        return value, slopes[i] + t * (2.0 * bend + 3.0 * t * twist)

    def _clear(self, gap: float) -> float:
        clear = gap + self.offset
        _check(clear)
        return clear

    def coefficient(self, gap: float) -> float:
        """See `DampingLaw.coefficient`."""
        clear, (x, y, slopes) = self._clear(gap), self._logs
        place = math.log(clear)
        if place <= x[0]:
            return math.exp(y[0] + slopes[0] * (place - x[0]))
        if place >= x[-1]:
            more, last = self._beyond, math.exp(x[-1])
            return self.coefficients[-1] * ((last + more) / (clear + more)) ** 3
        return math.exp(self._log(place)[0])

    def exponent(self, gap: float) -> float:
        """See `DampingLaw.exponent`."""
        clear, (x, _, slopes) = self._clear(gap), self._logs
        place = math.log(clear)
        if place <= x[0]:
            slope = slopes[0]
        elif place >= x[-1]:
            slope = -3.0 * clear / (clear + self._beyond)
        else:
            slope = self._log(place)[1]
        return -slope * gap / clear

    def onset(self, gap: float) -> float:
        """See `DampingLaw.onset`; its ratio to c by straight lines of logarithms."""
        clear, x = self._clear(gap), self._logs[0]
        place = math.log(clear)
        if place <= x[0]:
            return self.onsets[0] * self.coefficient(gap) / self.coefficients[0]
        if place >= x[-1]:
            return self.onsets[-1] * self.coefficient(gap) / self.coefficients[-1]
        i = bisect_right(x, place) - 1
        t = (place - x[i]) / (x[i + 1] - x[i])
        ratios = [self.onsets[k] / self.coefficients[k] for k in (i, i + 1)]
        low, high = (math.log(ratio) for ratio in ratios)
        return self.coefficient(gap) * math.exp(low + t * (high - low))

    def impulse(self, start: float, end: float) -> float:
        """See `DampingLaw.impulse`."""
        if end < start:
            return -self.impulse(end, start)
        first, last = self._clear(start), end + self.offset
        x, _, slopes = self._logs
        low, high = math.exp(x[0]), math.exp(x[-1])
        total = 0.0
        if first < low:
            n, top = -slopes[0], min(last, low)
            ratio = math.log(top / first)
            scale = self.coefficient(start) * first
            total += scale * (math.expm1((1.0 - n) * ratio) / (1.0 - n) if n != 1.0 else ratio)
        if last > high:
            more, bottom = self._beyond, max(first, high)
            j = self.coefficients[-1] * (high + more) ** 3
            total += j * _cubes(bottom + more, last + more)
        inside = (max(math.log(first), x[0]), min(math.log(last), x[-1]))
        for a, b in pairwise(x):
            a, b = max(a, inside[0]), min(b, inside[1])
            if a < b:
                total += sum(
                    (b - a) * w * math.exp(self._log(place)[0] + place)
                    for t, w in zip(*gauss_legendre(16), strict=True)
                    for place in (a + t * (b - a),)
                )
        return total


def _check(gap: float) -> None:
    if not gap > 0.0:
        cure = "faces that touch have no film between them"
        raise DescriptionError("gap", gap, "be positive", unit="m", hint=cure)


def _cubes(start: float, end: float) -> float:
    """Integral of h^-3, without cancellation; `end` may be inf."""
    if math.isinf(end):
        return 0.5 / start**2
    return 0.5 * (end - start) / start * (1.0 / start + 1.0 / end) / end


def _flat(name: str, area: float, shape_factor: float, deficit: float) -> PowerDamping:
    return PowerDamping(area=area, terms=((shape_factor, deficit, 0.0),), source=name)


def _sizes(function: str, **given: float) -> None:
    for name, value in given.items():
        if not 0.0 < value < math.inf:
            expected = "be positive and finite"
            raise DescriptionError(f"{function}.{name}", value, expected, unit="m")


def disc_damping(radius: float) -> PowerDamping:
    r"""Damping of a flat disc: J = (3 pi/2) R^4, D = 3 R^2.

    Examples
    --------
    >>> round(disc_damping(1.0).shape_factor, 6)
    4.712389
    """
    _sizes("disc_damping", radius=radius)
    area = math.pi * radius**2
    return _flat("disc, Stefan 1874", area, 1.5 * area * radius**2, 3.0 * radius**2)


def ring_damping(radius: float, hole_radius: float, *, is_sealed: bool = False) -> PowerDamping:
    r"""Damping of a flat ring whose hole is vented, or a sealed pocket of liquid.

    Parameters
    ----------
    radius, hole_radius : float
        Radii R and a [m].
    is_sealed : bool
        Whether the hole is closed; its pressure then counts.

    Notes
    -----
    :math:`\tfrac{3\pi}{2} [R^4 - a^4 - (R^2 - a^2)^2/\ln(R/a)]` vented,
    :math:`\tfrac{3\pi}{2} (R^4 - a^4)` sealed.

    Examples
    --------
    >>> round(ring_damping(1.0, 0.01).shape_factor, 6)
    3.689311
    """
    _sizes("ring_damping", radius=radius, hole_radius=hole_radius)
    if hole_radius >= radius:
        expected = "be smaller than the radius"
        raise DescriptionError("ring_damping.hole_radius", hole_radius, expected, unit="m")
    outer, inner, log = radius**2, hole_radius**2, math.log(radius / hole_radius)
    if is_sealed:
        factor = 1.5 * math.pi * (outer - inner) * (outer + inner)
        return _flat("sealed ring", math.pi * outer, factor, 3.0 * (outer - inner))
    factor = 1.5 * math.pi * (outer - inner) * (outer + inner - (outer - inner) / log)
    crest = 0.5 * (outer - inner) / log  # of the square of the radius
    deficit = 3.0 * (outer - crest - (outer - inner) * 0.5 * math.log(outer / crest) / log)
    return _flat("vented ring", math.pi * (outer - inner), factor, deficit)


def rectangle_damping(length: float, width: float) -> PowerDamping:
    r"""Damping of a flat rectangle, by the Fourier series of its torsion.

    Notes
    -----
    :math:`J = a b^3 [1 - \frac{192 b}{\pi^5 a} \sum \tanh(n \pi a/2b)/n^5]` over odd n, a >= b.

    Examples
    --------
    >>> round(rectangle_damping(1.0, 1.0).shape_factor, 6)
    0.421731
    """
    _sizes("rectangle_damping", length=length, width=width)
    a, b = max(length, width), min(length, width)
    odd = [n for n in range(1, 100, 2) if n * a / b < 200.0]  # exp overflows beyond
    turns = [0.5 * n * math.pi * a / b for n in odd]
    # tanh is 1 but for the first terms: the sum of the rest is known.
    less = sum(2.0 / (math.expm1(2.0 * t) + 2.0) / n**5 for n, t in zip(odd, turns, strict=True))
    series = 31.0 / 32.0 * ZETA_5 - less
    factor = a * b**3 * (1.0 - 192.0 * b / (math.pi**5 * a) * series)
    waves = sum((-1) ** (n // 2) / (n**3 * math.cosh(t)) for n, t in zip(odd, turns, strict=True))
    deficit = 1.5 * b * b * (1.0 - 32.0 / math.pi**3 * waves)
    return _flat("rectangle, torsion of Saint-Venant", a * b, factor, deficit)


def ellipse_damping(semi_axes: tuple[float, float]) -> PowerDamping:
    r"""Damping of a flat ellipse: J = 3 pi a^3 b^3/(a^2 + b^2), D = 6 a^2 b^2/(a^2 + b^2).

    Examples
    --------
    >>> round(ellipse_damping((1.0, 1.0)).shape_factor, 6)
    4.712389
    """
    a, b = semi_axes
    _sizes("ellipse_damping", first=a, second=b)
    ratio = a * a * b * b / (a * a + b * b)
    return _flat("ellipse", math.pi * a * b, 3.0 * math.pi * a * b * ratio, 6.0 * ratio)


def triangle_damping(side: float) -> PowerDamping:
    r"""Damping of a flat equilateral triangle: J = (12 sqrt 3/320) s^4, D = s^2/3.

    Examples
    --------
    >>> round(triangle_damping(1.0).shape_factor, 6)
    0.064952
    """
    _sizes("triangle_damping", side=side)
    root = math.sqrt(3.0)
    return _flat(
        "equilateral triangle", 0.25 * root * side**2, 12.0 * root / 320.0 * side**4, side**2 / 3.0
    )


def recess_damping(radius: float, recess_radius: float, depth: float) -> PowerDamping:
    r"""Damping of a disc with a concentric recess.

    Parameters
    ----------
    radius, recess_radius : float
        Radii R and a [m].
    depth : float
        Depth of the recess below the face [m]; 0 for none.

    Examples
    --------
    >>> law = recess_damping(3.175e-3, 1.5e-3, 3e-5)
    >>> round(law.force(1e-5, 1e-3, 0.1), 6)
    45.538455
    """
    _sizes("recess_damping", radius=radius, recess_radius=recess_radius)
    if recess_radius >= radius:
        expected = "be smaller than the radius"
        raise DescriptionError("recess_damping.recess_radius", recess_radius, expected, unit="m")
    if not 0.0 <= depth < math.inf:
        raise DescriptionError("recess_damping.depth", depth, "be zero or positive", unit="m")
    outer, inner = radius**2, recess_radius**2
    land = (1.5 * math.pi * (outer - inner) * (outer + inner), 3.0 * (outer - inner), 0.0)
    floor = (1.5 * math.pi * inner**2, 3.0 * inner, depth)
    return PowerDamping(area=math.pi * outer, terms=(land, floor), source="disc with a recess")


def dome_damping(radius: float, curvature_radius: float) -> DomeDamping:
    """Damping of a disc of film under a dome, or a hollow face, over the gap in the middle.

    Parameters
    ----------
    radius : float
        Radius of the disc [m].
    curvature_radius : float
        Radius of curvature [m], negative for a hollow face. That is `radius`^2/(2 R_c) deep, and
        has a law for larger gaps only.

    Examples
    --------
    >>> round(dome_damping(3.175e-3, 1.0).force(1e-5, 1e-3, 0.1), 6)
    21.169097
    >>> hollow = dome_damping(3.175e-3, -1.0)  # by 5.04 um
    >>> round(hollow.force(1e-5 - hollow.rise, 1e-3, 0.1), 6)  # 10 um at the rim
    31.838983
    """
    _sizes("dome_damping", radius=radius, curvature_radius=abs(curvature_radius))
    return DomeDamping(
        area=math.pi * radius**2,
        curvature_radius=curvature_radius,
        rise=radius**2 / (2.0 * curvature_radius),
        source="paraboloid, Matthewson 1988",
    )
