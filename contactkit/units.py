"""Units of measurement: parsing, conversion to SI, and the metadata of each field.

Inside contactkit all values are in SI units and radians. The unit of a field is written once, in
its metadata, and read by messages, files, plots, results and FMUs. A unit is a product of
symbols, ``N.s/m``, ``mm2/s`` or ``kg/m^3``; a quantity is a number, a space and a unit.
"""

from __future__ import annotations

import math
import re
from collections.abc import Mapping
from decimal import Decimal
from functools import lru_cache
from types import MappingProxyType
from typing import NamedTuple

from .errors import DescriptionError

__all__ = [
    "GPa",
    "MPa",
    "Unit",
    "Scale",
    "bar",
    "celsius",
    "cSt",
    "deg",
    "kPa",
    "mN",
    "mPa",
    "mm",
    "ms",
    "nm",
    "parse_difference",
    "parse_quantity",
    "parse_scale",
    "parse_unit",
    "pm",
    "quantity_pattern",
    "quantity_text",
    "readable_unit",
    "si",
    "um",
    "us",
]

# SI prefixes, exact
pm, nm, um, mm = 1e-12, 1e-9, 1e-6, 1e-3
us, ms = 1e-6, 1e-3
mN = 1e-3
mPa, kPa, MPa, GPa, bar = 1e-3, 1e3, 1e6, 1e9, 1e5
cSt = 1e-6
deg = math.pi / 180.0

_ZERO_CELSIUS = 273.15  # [K], exact by definition
_CELSIUS = ("degC", "°C", "℃", "C")

_PREFIXES = {
    "": 1.0,
    "p": 1e-12,
    "n": 1e-9,
    "u": 1e-6,
    "µ": 1e-6,  # the micro sign
    "μ": 1e-6,  # the Greek letter
    "m": 1e-3,
    "c": 1e-2,
    "k": 1e3,
    "M": 1e6,
    "G": 1e9,
}

# symbol: factor to SI, exponents of the SI base units (the names FMI uses), takes prefixes
_SYMBOLS: dict[str, tuple[float, dict[str, int], bool]] = {
    "m": (1.0, {"m": 1}, True),
    "g": (1e-3, {"kg": 1}, True),
    "s": (1.0, {"s": 1}, True),
    "A": (1.0, {"A": 1}, True),
    "K": (1.0, {"K": 1}, True),
    "mol": (1.0, {"mol": 1}, True),
    "rad": (1.0, {"rad": 1}, True),
    "deg": (deg, {"rad": 1}, False),
    "°": (deg, {"rad": 1}, False),
    "N": (1.0, {"kg": 1, "m": 1, "s": -2}, True),
    "J": (1.0, {"kg": 1, "m": 2, "s": -2}, True),
    "W": (1.0, {"kg": 1, "m": 2, "s": -3}, True),
    "Pa": (1.0, {"kg": 1, "m": -1, "s": -2}, True),
    "bar": (1e5, {"kg": 1, "m": -1, "s": -2}, True),
    "psi": (4.4482216152605 / 0.0254**2, {"kg": 1, "m": -1, "s": -2}, False),
    "V": (1.0, {"kg": 1, "m": 2, "s": -3, "A": -1}, True),
    "ohm": (1.0, {"kg": 1, "m": 2, "s": -3, "A": -2}, True),
    "H": (1.0, {"kg": 1, "m": 2, "s": -2, "A": -2}, True),
    "Wb": (1.0, {"kg": 1, "m": 2, "s": -2, "A": -1}, True),
    "T": (1.0, {"kg": 1, "s": -2, "A": -1}, True),
    "Hz": (1.0, {"s": -1}, True),
    "L": (1e-3, {"m": 3}, True),
    "l": (1e-3, {"m": 3}, True),
    # Products as they are often written, without the dot.
    "Nm": (1.0, {"kg": 1, "m": 2, "s": -2}, True),
    "Ns": (1.0, {"kg": 1, "m": 1, "s": -1}, True),
    "Pas": (1.0, {"kg": 1, "m": -1, "s": -1}, True),
    "P": (0.1, {"kg": 1, "m": -1, "s": -1}, True),
    "Å": (1e-10, {"m": 1}, False),
    "St": (1e-4, {"m": 2, "s": -1}, True),
    "min": (60.0, {"s": 1}, False),
    "h": (3600.0, {"s": 1}, False),
    "1": (1.0, {}, False),
    "%": (1e-2, {}, False),
}


# Powers as word processors write them, such as mm² and m³.
_RAISED = str.maketrans("⁰¹²³⁴⁵⁶⁷⁸⁹⁻", "0123456789-")
_RAISED_OF = str.maketrans("0123456789-", "⁰¹²³⁴⁵⁶⁷⁸⁹⁻")


class Unit(NamedTuple):
    """A unit: its factor to SI and the exponents of its SI base units."""

    factor: float
    dimension: Mapping[str, int]


def si(unit: str) -> dict[str, str]:
    """Metadata for an attrs field whose values are in `unit`, an SI unit or ``-``."""
    return {"unit": unit}


_READABLE = {1e9: "G", 1e6: "M", 1e3: "k", 1.0: "", 1e-3: "m", 1e-6: "u", 1e-9: "n", 1e-12: "p"}
_LARGE = ("Pa", "N", "J", "W", "Hz")  # units that people use with k, M and G too


def readable_unit(size: float, unit: str) -> tuple[float, str]:
    """Factor and name of the unit in which a quantity of some size in an SI unit reads best.

    The prefix belongs to the first symbol of the unit, with its exponent; masses are in grams,
    angles in degrees, pure numbers as they are.

    Examples
    --------
    >>> readable_unit(2.5e-8, "m"), readable_unit(4e-12, "m2"), readable_unit(0.05, "kg")
    ((1e-09, 'nm'), (1e-12, 'um2'), (0.001, 'g'))
    >>> readable_unit(0.0, "Pa"), readable_unit(0.03, "N/m"), readable_unit(5e9, "Pa")
    ((1.0, 'Pa'), (0.001, 'mN/m'), (1000000000.0, 'GPa'))
    >>> readable_unit(5e8, "1/m"), readable_unit(3e12, "1/m2"), readable_unit(0.2, "1/m")
    ((1000000.0, '1/um'), (1000000000000.0, '1/um2'), (1.0, '1/m'))
    """
    if unit == "rad":
        return deg, "deg"
    if inverse := re.fullmatch(r"1/m([23]?)", unit):  # per prefixed length, as of a wave or a spot
        return _per_length(size, inverse[1])
    match = re.fullmatch(r"(kg|[A-Za-z]+)([23]?)(.*)", unit)
    if match is None or match[1] == "K" or not (size and math.isfinite(size)):
        return 1.0, unit
    symbol, power = match[1], int(match[2] or 1)
    kilo = 1e-3 if symbol == "kg" else 1.0
    symbol = "g" if symbol == "kg" else symbol
    for prefix, letter in _READABLE.items():
        factor = prefix**power * kilo
        is_used = prefix <= 1.0 or symbol in _LARGE or (symbol, prefix) == ("g", 1e3)
        if is_used and abs(size) >= 0.9999999 * factor * 0.1 ** (power - 1):
            return factor, f"{letter}{symbol}{match[2]}{match[3]}"
    if abs(size) < 1e-3 * factor:  # a power of ten of the plain unit reads better
        return 1.0, unit
    return factor, f"{letter}{symbol}{match[2]}{match[3]}"


def _per_length(size: float, power: str) -> tuple[float, str]:
    """Factor and name of the smallest unit of length that a number per length reads best with."""
    found = 1.0, f"1/m{power}"
    for prefix in (1e-3, 1e-6, 1e-9, 1e-12):
        factor = round(1.0 / prefix) ** int(power or 1)
        if math.isfinite(size) and abs(size) >= 0.9999999 * factor:
            found = float(factor), f"1/{_READABLE[prefix]}m{power}"
    return found


def quantity_text(value: float, unit: str) -> str:
    """A quantity given in an SI unit, in the unit that suits it, for messages and tables.

    Examples
    --------
    >>> quantity_text(5.64e-8, "m"), quantity_text(0.25, "m"), quantity_text(1e-19, "J")
    ('56.4 nm', '250 mm', '1e-19 J')
    """
    factor, name = readable_unit(value, unit)
    number = f"{value / factor:.4g}"
    return number if name in ("-", "") else f"{number} {name}"


def celsius(temperature: float) -> float:
    """Temperature [K] of a temperature in degrees Celsius.

    Examples
    --------
    >>> celsius(20.0)
    293.15
    """
    return temperature + _ZERO_CELSIUS


def _symbol(text: str) -> tuple[float, dict[str, int]] | None:
    if text in _SYMBOLS:
        return _SYMBOLS[text][:2]
    head, tail = text[:1], text[1:]
    if head in _PREFIXES and tail in _SYMBOLS and _SYMBOLS[tail][2]:
        factor, dimension, _ = _SYMBOLS[tail]
        return _PREFIXES[head] * factor, dimension
    return None


# Units that are not taken, as those that are.
_ELSEWHERE = {
    "micron": "1 um",
    "in": "25.4 mm",
    "inch": "25.4 mm",
    "mil": "25.4 um",
    "dyn": "10 uN",
    "kgf": "9.80665 N",
    "lbf": "4.44822 N",
    "daN": "10 N",
    "hPa": "1 mbar",
    "atm": "101325 Pa",
    "Torr": "133.322 Pa",
    "mmHg": "133.322 Pa",
    "ksi": "6.89476 MPa",
    "erg": "100 nJ",
    "eV": "1.602177e-19 J",
    "sec": "1 s",
}


def _spelt(text: str) -> str:
    """Symbols that differ in their capitals only, or the same in a known unit; else examples."""
    if text in _ELSEWHERE:
        return f"1 {text} is {_ELSEWHERE[text]}"
    if "(" in text:
        return "write it without brackets, such as W/m/K"
    known = (
        p + s for s, (_, _, takes) in _SYMBOLS.items() for p in (_PREFIXES if takes else ("",))
    )
    close = [repr(one) for one in known if one.casefold() == text.casefold()]
    if close:
        return f"did you mean {' or '.join(close)}?"
    return "for example 'um', 'mN/m', 'mPa.s', 'mm2/s', 'kg/m3', 'deg', 'degC'"


# A file may hold any text: with these limits neither a factor overflows (units of this table are
# within 1e-24 to 1e24 a power) nor does the search for the meaning of a text take long. Units in
# use have powers up to 4 and some 20 letters.
_LARGEST_POWER = 12
_LONGEST = 200


@lru_cache(maxsize=256)
def parse_unit(text: str) -> Unit:
    """Read a unit such as ``mN/m``, ``Pa.s``, ``kg/m3`` or ``-`` (no unit).

    Raises
    ------
    DescriptionError
        If a symbol is unknown.

    Examples
    --------
    >>> parse_unit("mm2/s").factor
    1e-06
    >>> dict(parse_unit("N.s/m").dimension)
    {'kg': 1, 's': -1}
    """
    if text in ("-", ""):
        return Unit(1.0, MappingProxyType({}))
    if len(text) > _LONGEST:
        raise DescriptionError("unit", text, f"have at most {_LONGEST} letters")
    factor, dimension = 1.0, dict[str, int]()
    # A blank is a product too: without it "m s-1" would be one per millisecond.
    first, *rest = re.split(r"(\s*[./*·⋅]\s*|\s+)", text.strip().translate(_RAISED))
    for sign, part in [("", first), *zip(rest[::2], rest[1::2], strict=True)]:
        match = re.fullmatch(r"(1|[^\d^-]+)(?:\^?(-?\d{1,9}))?", part)
        found = _symbol(match[1]) if match else None
        if match is None or found is None:
            raise DescriptionError(
                "unit",
                text,
                f"be made of known symbols ({part!r} is not one)",
                hint=_spelt(match[1] if match else part),
            )
        power = int(match[2] or 1) * (-1 if "/" in sign else 1)
        if abs(power) > _LARGEST_POWER:
            raise DescriptionError(
                "unit", text, f"have powers of at most {_LARGEST_POWER} ({part!r} is higher)"
            )
        factor *= found[0] ** power
        for base, exponent in found[1].items():
            dimension[base] = dimension.get(base, 0) + power * exponent
    return Unit(factor, MappingProxyType({b: e for b, e in dimension.items() if e}))


class Scale(NamedTuple):
    """A scale of readings: its factor and its zero in SI units, and its dimension."""

    factor: float
    zero: float
    dimension: Mapping[str, int]


def parse_scale(text: str) -> Scale:
    """Read the unit of a column of readings: as `parse_unit`, or degrees Celsius.

    Examples
    --------
    >>> parse_scale("degC")[:2], parse_scale("mN")[:2]
    ((1.0, 273.15), (0.001, 0.0))
    """
    if text in _CELSIUS:
        return Scale(1.0, _ZERO_CELSIUS, parse_unit("K").dimension)
    unit = parse_unit(text)
    return Scale(unit.factor, 0.0, unit.dimension)


def parse_difference(value: object, unit: str, field: str = "value") -> float:
    """As `parse_quantity`, of a difference: one of temperatures is in K, whatever the scale.

    Raises
    ------
    DescriptionError
        As `parse_quantity`, and for degrees Celsius.
    """
    if unit == "K" and isinstance(value, str) and value.strip().endswith(_CELSIUS):
        cure = "it is a difference of temperatures, such as '0.5 K'"
        raise DescriptionError(field, value, "be in K", unit=unit, hint=cure)
    return parse_quantity(value, unit, field)


def _scaled(number: str, factor: float) -> float:
    """Multiply by a factor, without rounding twice where it is a power of ten: 20 um is 2e-05."""
    power, size = round(math.log10(factor)), abs(float(number))
    if math.isclose(factor, 10.0**power, rel_tol=1e-14) and 0.0 < size < math.inf:
        return float(Decimal(number).scaleb(power))
    return float(number) * factor


def _cure(text: str) -> str:
    """Cure of a number that is written in another way than here; empty if none is known."""
    if comma := re.match(r"[-+]?\d+,\d+", text):
        return f"a decimal comma? write {comma[0].replace(',', '.')}{text[comma.end() :]}"
    if pair := re.fullmatch(r"(\d+)\s*[xX*\u00d7]\s*(\d+)", text):
        return f"two numbers? write [{pair[1]}, {pair[2]}]"
    return ""


def parse_quantity(value: object, unit: str, field: str = "value") -> float:
    """Convert a number, or a text such as ``"2.5 nm"``, to SI units.

    Parameters
    ----------
    value : float or str
        A number is taken to be in `unit`; a text carries its own unit.
    unit : str
        SI unit of the field.
    field : str
        Name of the field, for messages.

    Raises
    ------
    DescriptionError
        If the text is not a number and a unit, or the unit is of another dimension.

    Examples
    --------
    >>> parse_quantity("72.75 mN/m", "N/m")
    0.07275
    >>> parse_quantity("-20 degC", "K")
    253.14999999999998
    """
    if isinstance(value, int | float) and not isinstance(value, bool):
        return float(value)
    text = value.strip() if isinstance(value, str) and len(value) <= _LONGEST else ""
    match = re.fullmatch(r"([-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?|[-+]?inf)\s*(.*)", text)
    example = (
        f"2.5 {unit}"
        if unit not in ("-", "rad", "K")
        else {"rad": "60 deg", "K": "20 degC"}.get(unit, "2.5")
    )
    if match is None or _cure(text):
        cure = _cure(text) or f"for example {example!r}"
        raise DescriptionError(field, value, "be a number and a unit", unit=unit, hint=cure)
    number, symbol = float(match[1]), match[2]
    if symbol in _CELSIUS and unit == "K":
        return celsius(number)
    if not symbol:
        if parse_unit(unit).dimension:
            raise DescriptionError(
                field, value, "carry a unit", unit=unit, hint=f"for example {example!r}"
            )
        return number
    wanted = parse_unit(unit)
    try:
        found = parse_unit(symbol)
    except DescriptionError as error:
        raise DescriptionError(field, value, error.expected, unit=unit, hint=error.hint) from None
    if found.dimension != wanted.dimension:
        raise DescriptionError(
            field, value, f"be in a unit that converts to {unit}", hint=f"for example {example!r}"
        )
    return _scaled(match[1], found.factor / wanted.factor)


_NUMBER = r"[-+]?(?:(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?|inf)"
_FACTOR = r"(?:1|[^\d\s./*·⋅^⁰¹²³⁴⁵⁶⁷⁸⁹⁻-]+)(?:\^?-?\d+|⁻?[⁰¹²³⁴⁵⁶⁷⁸⁹]+)?"
_PRODUCT = rf"{_FACTOR}(?:(?:\s*[./*·⋅]\s*|\s+){_FACTOR})+"


def quantity_pattern(unit: str) -> str:
    r"""Regular expression of the texts that `parse_quantity` takes, for schemas of files.

    Of ECMA 262, as JSON Schema asks for. The symbol of a unit that is a single one must be known
    and of the dimension, such as ``"5 bar"`` for a pressure; a product (``"N/mm2"``) is left to
    `parse_quantity`.

    Parameters
    ----------
    unit : str
        SI unit of the field.

    Examples
    --------
    >>> texts = ["5 bar", "5 N/mm2", "5 mm", "5", "fast"]
    >>> [re.search(quantity_pattern("Pa"), text) is not None for text in texts]
    [True, True, False, False, False]
    """
    wanted = dict(parse_unit(unit).dimension)
    known: dict[tuple[bool, str], list[str]] = {}
    for symbol, (_, dimension, takes) in _SYMBOLS.items():
        if power := _power(dimension, wanted):
            raised = str(power).translate(_RAISED_OF)
            exponent = "" if power == 1 else rf"(?:\^?{power}|{raised})"
            known.setdefault((takes, exponent), []).append(re.escape(symbol))
    prefix = f"[{''.join(_PREFIXES)}]?"
    single = [
        f"{prefix if takes else ''}(?:{'|'.join(symbols)}){exponent}"
        for (takes, exponent), symbols in known.items()
    ]
    single += _CELSIUS if unit == "K" else ()
    units = "|".join((*single, _PRODUCT))
    # No part of a number begins a unit: "1e-3 um" is not 1 times e-3 um.
    return rf"^\s*{_NUMBER}(?![\d.,]|[eE][-+]?\d)\s*(?:{units}){'' if wanted else '?'}\s*$"


def _power(dimension: Mapping[str, int], wanted: Mapping[str, int]) -> int:
    """Power of a dimension that is another one; 0 if there is none, or the dimension is none."""
    if not dimension or not wanted:
        return 1 if not dimension and not wanted else 0
    base = next(iter(dimension))
    power, rest = divmod(wanted.get(base, 0), dimension[base])
    same = {name: power * exponent for name, exponent in dimension.items()} == wanted
    return power if same and not rest else 0
