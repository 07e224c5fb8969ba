"""Arguments and results of printed equations, by name and with their units."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from numbers import Real
from types import MappingProxyType
from typing import Any, NamedTuple

from ..errors import DescriptionError

__all__ = [
    "ARGUMENTS",
    "Argument",
    "PublishedFormula",
    "PublishedValue",
    "checked_arguments",
    "numbered",
]


class Argument(NamedTuple):
    """An argument of printed equations: its unit, valid range and meaning."""

    unit: str
    expected: str
    meaning: str
    is_right: Callable[[float], bool]
    default: Any = None


def _finite(value: float) -> bool:
    return math.isfinite(value)


def _positive(value: float) -> bool:
    return 0.0 < value < math.inf


def _non_negative(value: float) -> bool:
    return 0.0 <= value < math.inf


def _above(value: float) -> bool:
    return value > 0.0


def _angle(value: float) -> bool:
    return 0.0 <= value <= math.pi


def _steep(value: float) -> bool:
    return 0.0 < value < 0.5 * math.pi


def _fraction(value: float) -> bool:
    return 0.0 < value <= 1.0


def _count(value: float) -> bool:
    return 1.0 <= value < math.inf and value == int(value)


def _positive_argument(unit: str, meaning: str) -> Argument:
    return Argument(unit, "be positive and finite", meaning, _positive)


def _gap(meaning: str) -> Argument:
    return Argument("m", "be zero or positive, and finite", meaning, _non_negative)


def _contact_angle(meaning: str) -> Argument:
    return Argument("rad", "lie between 0 and pi", meaning, _angle)


def _stress(component: str) -> Argument:
    return Argument("Pa", "be a finite number", f"stress sigma_{component}", _finite)


ARGUMENTS: Mapping[str, Argument] = MappingProxyType(
    {
        "radius": _positive_argument("m", "radius of the meniscus on the pulled body"),
        "gap": _gap("shortest distance of the bodies"),
        "surface_tension": _positive_argument("N/m", "surface tension of the liquid"),
        "angle_lower": _contact_angle("contact angle on the lower body"),
        "angle_upper": _contact_angle("contact angle on the upper body"),
        "angle": _contact_angle("contact angle on the body"),
        "pulled": Argument("", "be 'lower' or 'upper'", "pulled body", _finite, "lower"),
        "number": Argument("-", "be a whole number of at least 1", "menisci, asperities", _count),
        "kelvin_radius": _positive_argument("m", "Kelvin radius of the meniscus"),
        "molar_volume": _positive_argument("m3/mol", "molar volume of the liquid"),
        "temperature": _positive_argument("K", "temperature"),
        "relative_humidity": Argument("-", "be above 0 and at most 1", "p/p0", _fraction),
        "sphere_radius": _positive_argument("m", "radius R of the sphere"),
        "immersion": _positive_argument("m", "depth d0 = s - D to which the film wets it"),
        "filling_angle": Argument("rad", "lie between 0 and pi/2", "filling angle", _steep),
        "volume": _positive_argument("m3", "volume of the liquid"),
        "curvature_lower": Argument("1/m", "be zero or positive", "1/R", _non_negative, 0.0),
        "curvature_upper": Argument("1/m", "be zero or positive", "1/R", _non_negative, 0.0),
        "height": _positive_argument("m", "local height of the film"),
        "film_height": _positive_argument("m", "height H of the film at its rim, at the start"),
        "gap_start": _gap("gap at the start"),
        "gap_end": Argument("m", "be positive", "gap at rupture, may be inf", _above),
        "separation_time": _positive_argument("s", "time t_s of the separation"),
        "viscosity": _positive_argument("Pa.s", "dynamic viscosity of the liquid"),
        "speed": Argument("m/s", "be a finite number", "opening or sliding speed", _finite),
        "position": _gap("distance from the axis"),
        "travel": _gap("distance slid, between the two centres"),
        "force": Argument("N", "be a finite number", "force of one meniscus", _finite),
        "displacement": _gap("largest displacement u_max of the surface, from its mean"),
        "datum": Argument(
            "m",
            "be zero or positive, and finite",
            "mean displacement that the source adds to it, of 'zero wavenumber'",
            _non_negative,
            0.0,
        ),
        "thickness": _positive_argument("m", "thickness of the layer, of the top one of two"),
        "thickness_below": _positive_argument("m", "thickness of the second layer"),
        "young_modulus": _positive_argument("Pa", "Young's modulus of the layer"),
        "young_modulus_below": _positive_argument("Pa", "Young's modulus of what lies below it"),
        "young_modulus_substrate": _positive_argument("Pa", "Young's modulus of the substrate"),
        "hardness": _positive_argument("Pa", "hardness of the layer"),
        "hardness_below": _positive_argument("Pa", "hardness of what lies below it"),
        "hardness_substrate": _positive_argument("Pa", "hardness of the substrate"),
        "mean_pressure": _positive_argument("Pa", "mean pressure over the window"),
        "window": _positive_argument("m", "width of the square window"),
        "reduced_modulus": _positive_argument("Pa", "E/(1 - nu^2) of the substrate"),
        "rms": _positive_argument("m", "standard deviation of the heights"),
        "correlation_length_x": _positive_argument("m", "length beta* to 10 %, along x"),
        "correlation_length_y": _positive_argument("m", "length beta* to 10 %, along y"),
        "offset_x": _gap("distance of the two points along x"),
        "offset_y": _gap("distance of the two points along y"),
        "period": Argument(
            "m", "be positive", "width of a window that repeats, may be inf", _above, math.inf
        ),
        "meniscus_area": _positive_argument("m2", "area under menisci, without the contact"),
        "meniscus_height": _positive_argument("m", "height at which the menisci end"),
        "stress_xx": _stress("xx"),
        "stress_yy": _stress("yy"),
        "stress_zz": _stress("zz"),
        "stress_xy": _stress("xy"),
        "stress_xz": _stress("xz"),
        "stress_yz": _stress("yz"),
    }
)
"""Arguments of the printed equations, by name."""

# Arguments that must exceed another one of the same equation.
_ORDERED = (
    ("gap_end", "gap_start"),
    ("film_height", "gap_start"),
    ("film_height", "gap"),
    ("film_height", "height"),
    ("period", "correlation_length_x"),
    ("period", "correlation_length_y"),
)


class PublishedValue(NamedTuple):
    """Value of a printed equation, its erratum and the corrected value.

    Attributes
    ----------
    number : str
        Number of the equation.
    name : str
        Quantity.
    value : float
        As printed, in `unit`; forces that resist or attract are positive.
    unit : str
        Unit of both values.
    corrected : float or None
        Value of the consistent model for the same arguments; None where there is none, for the
        reason in `corrected_by`.
    erratum : str
        Error of the equation; empty if it is correct.
    corrected_by : str
        Model of `corrected`, or why there is none.
    """

    number: str
    name: str
    value: float
    unit: str
    corrected: float | None
    erratum: str
    corrected_by: str

    @property
    def relative_error(self) -> float | None:
        """Relative error of the printed value [-]; None where a value is missing."""
        if self.corrected is None or self.corrected == 0.0:
            return None
        return (self.value - self.corrected) / abs(self.corrected)

    def times(self, number: float) -> PublishedValue:
        """Return the same of a number of equal menisci."""
        corrected = None if self.corrected is None else number * self.corrected
        return self._replace(value=number * self.value, corrected=corrected)

    def __str__(self) -> str:
        unit = "" if self.unit == "-" else f" {self.unit}"
        lines = [f"{numbered(self.number)} {self.name}: {self.value:.6g}{unit} as printed"]
        if self.corrected is None:
            lines.append(f"  no corrected value: {self.corrected_by}")
        else:
            lines.append(f"  corrected: {self.corrected:.6g}{unit}, {self.corrected_by}")
        return "\n".join([*lines, *([f"  erratum: {self.erratum}"] if self.erratum else [])])


class PublishedFormula(NamedTuple):
    """A printed equation: formula, arguments, and correction.

    `right` computes the corrected value from the same arguments, or is None where the printed
    equation is correct; `by` names the correction. With `any_film` that holds for a film under a
    sphere however wide; with `may_be_infinite` an infinite value is an answer.
    """

    number: str
    name: str
    equation: str
    arguments: tuple[str, ...]
    unit: str
    printed: Callable[..., Any]
    right: Callable[..., Any] | None = None
    by: str = "as printed, which is correct"
    errata: tuple[str, ...] = ()
    any_film: bool = False
    may_be_infinite: bool = False

    @property
    def signature(self) -> str:
        """Names of the arguments with their units."""
        units = (ARGUMENTS[name].unit for name in self.arguments)
        pairs = zip(self.arguments, units, strict=True)
        return ", ".join(f"{name} [{unit}]" if unit else name for name, unit in pairs)

    def __str__(self) -> str:
        return f"{numbered(self.number)} {self.name} [{self.unit}]: {self.equation}"


def numbered(number: str) -> str:
    """Equation as it is called in messages."""
    return number if " " in number else f"Eq. ({number})"


def checked_arguments(formula: PublishedFormula, given: Mapping[str, Any]) -> dict[str, Any]:
    """Arguments of an equation in its order, validated."""
    owner = f"published {numbered(formula.number)}"
    unknown = [name for name in given if name not in formula.arguments]
    if unknown:
        raise DescriptionError(
            f"{owner}, argument", unknown[0], f"be one of {', '.join(formula.arguments)}"
        )
    found = {}
    for name in formula.arguments:
        argument = ARGUMENTS[name]
        if name not in given and argument.default is None:
            raise DescriptionError(
                f"{owner}, {name}",
                "nothing",
                argument.expected,
                unit=_bracket(argument),
                hint=f"{name} is the {argument.meaning}; needed: {formula.signature}",
            )
        found[name] = _one(f"{owner}, {name}", argument, given.get(name, argument.default))
    for larger, smaller in _ORDERED:
        if larger in found and smaller in found and not found[larger] > found[smaller]:
            raise DescriptionError(
                f"{owner}, {larger}",
                found[larger],
                f"exceed {smaller} = {found[smaller]:g}",
                unit=_bracket(ARGUMENTS[larger]),
            )
    return found


def _bracket(argument: Argument) -> str:
    return "" if argument.unit == "-" else argument.unit


def _one(field: str, argument: Argument, value: Any) -> Any:
    if argument.default == "lower":
        if value not in ("lower", "upper"):
            raise DescriptionError(field, value, argument.expected)
        return value
    is_number = isinstance(value, Real) and not isinstance(value, bool)
    if not (is_number and argument.is_right(float(value))):
        hint = "" if is_number or not hasattr(value, "__len__") else "give one number at a time"
        if argument.unit == "rad" and is_number and math.pi < value <= 180.0:
            hint = "was it meant in degrees?"
        raise DescriptionError(field, value, argument.expected, unit=_bracket(argument), hint=hint)
    return float(value)
