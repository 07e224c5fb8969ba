"""Validators and converters of attrs fields, with one form of error message."""

from __future__ import annotations

import math
import numbers
import os
import re
from collections.abc import Callable, Iterable
from typing import TYPE_CHECKING, Any

from attrs import Attribute, fields

from .errors import DescriptionError, nearest
from .units import parse_quantity

__all__ = [
    "LARGEST",
    "LARGEST_FRICTION",
    "Described",
    "angle",
    "as_pair",
    "as_path",
    "as_tuple",
    "as_number",
    "as_whole",
    "check_text",
    "choice",
    "count",
    "file_name",
    "finite",
    "fraction",
    "friction_coefficient",
    "non_negative",
    "optional",
    "part",
    "positive",
    "positive_or_pair",
    "refuse",
]

if TYPE_CHECKING:
    Validator = Callable[[Any, Attribute[Any], Any], None]


def refuse(
    owner: object, attribute: Attribute[Any], value: object, expected: str, hint: str = ""
) -> DescriptionError:
    """Return the error that names owner, field, unit and value."""
    unit = attribute.metadata.get("unit", "")
    name = f"{type(owner).__name__}.{attribute.name}"
    return DescriptionError(name, value, expected, unit="" if unit == "-" else unit, hint=hint)


def _read(value: Any, unit: str, name: str) -> Any:
    """A quantity in SI units from a text that begins as a number; tuples and lists by item."""
    if isinstance(value, tuple | list):
        return type(value)(_read(item, unit, name) for item in value)
    if not (isinstance(value, str) and re.match(r"\s*[-+.\d]", value)):
        return value  # a number, or a word that the field's own check takes or refuses
    is_whole = unit == "-" and re.fullmatch(r"\s*[-+]?\d{1,18}\s*", value)
    return int(value) if is_whole else parse_quantity(value, unit, name)


def _reader(converter: Callable[[Any], Any] | None, unit: str, name: str) -> Callable[[Any], Any]:
    """Converter that reads texts, then does what the field's own converter does."""
    if converter is None:
        return lambda value: _read(value, unit, name)
    return lambda value: converter(_read(value, unit, name))


_OPTIONAL_TEXT = ("str | None", str | None)
_TEXT = ("str", str, *_OPTIONAL_TEXT)  # types of a field that takes a text and no number


def check_text(owner: str, attribute: Attribute[Any], value: Any) -> None:
    """Refuse what is no text where a field takes no other."""
    is_left_out = value is None and attribute.type in _OPTIONAL_TEXT
    if attribute.type not in _TEXT or is_left_out:
        return
    if attribute.converter is None and "unit" not in attribute.metadata:
        cure = "put it in quotes" if isinstance(value, int | float) else ""
        raise DescriptionError(f"{owner}.{attribute.name}", value, "be a text", hint=cure)


class Described:
    """Base class of scene objects: quantities may be texts, unknown arguments are refused.

    A field with a unit takes a number in that unit or a text such as ``"5 um"``, also where a
    user's own class has the field. An argument that a class does not have is refused with its cure.
    """

    __slots__ = ()

    if not TYPE_CHECKING:  # which reads the arguments off the fields

        def __init_subclass__(cls, **given: Any) -> None:
            """Let each field with a unit read texts, before attrs makes ``__init__`` of it."""
            super().__init_subclass__(**given)
            for name, made in vars(cls).items():
                unit = getattr(made, "metadata", {}).get("unit")
                if unit is not None and hasattr(made, "converter"):
                    made.converter = _reader(made.converter, unit, f"{cls.__name__}.{name}")

        def __new__(cls, *args: Any, **given: Any) -> Any:
            """Check the names of the arguments; ``__init__`` takes them."""
            known = {a.alias: a for a in fields(cls) if a.init}
            if args and all(a.kw_only for a in known.values()):
                first = next(iter(known), "field")
                raise TypeError(f"{cls.__name__}() takes its fields by name: {first}=...")
            for key, value in given.items():
                if key in known and not isinstance(value, str):
                    check_text(cls.__name__, known[key], value)
                if key not in known:
                    cure = nearest(key, [k for k, a in known.items() if a.name[0] != "_"])
                    raise TypeError(
                        f"{cls.__name__}() got an unexpected keyword argument {key!r}; {cure}"
                    )
            return super().__new__(cls)


def _is_number(value: object) -> bool:
    return isinstance(value, int | float) and not isinstance(value, bool) and math.isfinite(value)


LARGEST = 1e60  # its fourth power, times what multiplies it, still fits into a double


def _within(owner: object, attribute: Attribute[Any], value: float) -> None:
    """Refuse a number whose powers would overflow."""
    if abs(value) > LARGEST:
        cure = "no quantity in SI units is as large; check its unit"
        raise refuse(owner, attribute, value, f"be at most {LARGEST:g} in size", cure)


def finite(owner: object, attribute: Attribute[Any], value: Any) -> None:
    """Refuse anything but a finite number, of a size that has a meaning."""
    if not _is_number(value):
        raise refuse(owner, attribute, value, "be a finite number")
    _within(owner, attribute, value)


def positive(owner: object, attribute: Attribute[Any], value: Any) -> None:
    """Refuse anything but a positive, finite number, of a size that has a meaning."""
    if not (_is_number(value) and value > 0.0):
        raise refuse(owner, attribute, value, "be positive and finite")
    _within(owner, attribute, value)


def non_negative(owner: object, attribute: Attribute[Any], value: Any) -> None:
    """Refuse negative numbers, infinity and nan, and sizes without a meaning."""
    if not (_is_number(value) and value >= 0.0):
        raise refuse(owner, attribute, value, "be zero or positive, and finite")
    _within(owner, attribute, value)


def fraction(owner: object, attribute: Attribute[Any], value: Any) -> None:
    """Refuse anything outside 0 to 1."""
    if not (_is_number(value) and 0.0 <= value <= 1.0):
        raise refuse(owner, attribute, value, "lie between 0 and 1")


LARGEST_FRICTION = 1e3  # clean metals in vacuum seize at some ten; this holds any contact


def friction_coefficient(owner: object, attribute: Attribute[Any], value: Any) -> None:
    """Refuse anything outside 0 to 1000: rubber has above 1."""
    if not (_is_number(value) and 0.0 <= value <= LARGEST_FRICTION):
        is_large = _is_number(value) and value > 0.0
        hint = f"{LARGEST_FRICTION:g} holds wherever there is pressure" if is_large else ""
        raise refuse(owner, attribute, value, f"lie between 0 and {LARGEST_FRICTION:g}", hint)


def angle(owner: object, attribute: Attribute[Any], value: Any) -> None:
    """Refuse an angle outside 0 to pi; the hint suggests degrees for a value that may be some."""
    if not (_is_number(value) and 0.0 <= value <= math.pi):
        hint = ""
        if _is_number(value) and math.pi < value <= 180.0:
            hint = (
                f"was it meant in degrees? then write {value!r}*deg, or '{value:g} deg' in a file"
            )
        if _is_number(value) and math.pi < value <= 2.0 * math.pi:
            hint = f"in radians it is {math.degrees(value):g} deg, beyond 180 deg; {hint}"
        raise refuse(owner, attribute, value, "lie between 0 and pi", hint)


def count(owner: object, attribute: Attribute[Any], value: Any) -> None:
    """Refuse anything but a whole number of at least one."""
    if isinstance(value, bool) or not isinstance(value, int) or value < 1:
        raise refuse(owner, attribute, value, "be a whole number of at least 1")


def positive_or_pair(owner: object, attribute: Attribute[Any], value: Any) -> None:
    """Require a positive, finite number, or a pair of them along y and x."""
    for item in value if isinstance(value, tuple) else (value,):
        positive(owner, attribute, item)
    if isinstance(value, tuple) and len(value) != 2:
        raise refuse(owner, attribute, value, "be one length or a pair (along y, along x)")


def file_name(owner: object, attribute: Attribute[Any], value: Any) -> None:
    """Require the name of a file, as `as_path` makes it."""
    if not isinstance(value, str):
        raise refuse(owner, attribute, value, "be the name of a file")


def optional(check: Validator) -> Validator:
    """Allow None (not given) besides what `check` allows."""

    def check_if_given(owner: object, attribute: Attribute[Any], value: Any) -> None:
        if value is not None:
            check(owner, attribute, value)

    return check_if_given


def choice(*options: str) -> Validator:
    """Refuse anything but one of the given words."""

    def check_choice(owner: object, attribute: Attribute[Any], value: Any) -> None:
        if value not in options:
            raise refuse(owner, attribute, value, f"be one of {', '.join(map(repr, options))}")

    return check_choice


_LOADERS = {"Liquid": "load_liquid", "Material": "load_material"}


def part(*kinds: type) -> Validator:
    """Refuse anything but an instance of the given classes."""

    def check_part(owner: object, attribute: Attribute[Any], value: Any) -> None:
        if not isinstance(value, kinds):
            names = [kind.__name__ for kind in kinds]
            loaders = [f"ck.{_LOADERS[name]}({value!r})" for name in names if name in _LOADERS]
            cure = (
                f"one of the library is {loaders[0]}" if isinstance(value, str) and loaders else ""
            )
            raise refuse(owner, attribute, value, f"be a {' or '.join(names)}", cure)

    return check_part


def as_tuple(value: Any) -> tuple[Any, ...]:
    """Convert a collection, or a single object, to a tuple."""
    return tuple(value) if isinstance(value, Iterable) else (value,)


def as_whole(value: Any) -> Any:
    """Convert a whole number of another library, such as of an array, to an int."""
    is_whole = isinstance(value, numbers.Integral) and not isinstance(value, bool)
    return int(value) if is_whole else value


def as_number(value: Any) -> Any:
    """Convert a number of another library, such as of an array, to an int or a float."""
    made = as_whole(value)
    is_foreign = isinstance(made, numbers.Real) and not isinstance(made, int | float)
    return float(made) if is_foreign else made


def as_path(value: Any) -> Any:
    """Convert a path to text; leave other values to `file_name`."""
    return os.fsdecode(value) if isinstance(value, os.PathLike) else value


def as_pair(value: Any) -> Any:
    """Convert a list (from a file) to a tuple; leave a single number unchanged."""
    return tuple(value) if isinstance(value, list) else value
