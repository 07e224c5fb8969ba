"""A scene in words: what it lists, a line for each part, with units that read well."""

from __future__ import annotations

from typing import Any

from attrs import NOTHING, Attribute, fields, has

from ..export.lines import Line
from ..units import celsius, quantity_text

__all__ = ["described", "value_text"]

_NAMED = ("Material", "Liquid")  # parts that have names of their own
_PLAIN = ("Interface", "Body", "Layer", "Meniscus", "Window")  # whose field says what they are


def described(part: Any, name: str = "") -> Line:
    """Return a part of a scene in words, without what is left at its default.

    Examples
    --------
    >>> from contactkit import Flat
    >>> described(Flat(radius=3.175e-3), "lower").indented()
    ['lower  Flat: radius 3.175 mm']
    """
    kind = type(part).__name__
    if kind in _NAMED:
        return Line(name or kind, part.name or kind)
    said, parts = list[str](), list[Line]()
    for one in fields(type(part)):
        value = getattr(part, one.name)
        if one.name.startswith("_") or not one.init or value is None or _is_default(one, value):
            continue
        _add(one, value, said, parts)
    text = ", ".join(said)
    if not name:
        return Line(kind, text, tuple(parts))
    is_stated = kind in _PLAIN or kind.lower().endswith(name.lower())  # the coil is a Coil
    if not is_stated and name != getattr(part, "name", None):
        text = f"{kind}: {text}" if text else kind
    return Line(name, text, tuple(parts))


def _add(one: Attribute[Any], value: Any, said: list[str], parts: list[Line]) -> None:
    """Add a field to the line of a part, or to its own parts."""
    name = one.name.replace("_", " ")
    if has(type(value)):
        parts.append(described(value, name))
    elif isinstance(value, tuple) and value and has(type(value[0])):
        parts.append(
            Line(name, "", tuple(described(v, _name_of(v, i)) for i, v in enumerate(value)))
        )
    else:
        said.append(f"{name} {value_text(value, one.metadata.get('unit', '-'))}")


def _name_of(part: Any, index: int) -> str:
    """Name of one of several parts: that of an effect, or its number."""
    return str(getattr(part, "name", "") or index)


def value_text(value: Any, unit: str) -> str:
    """Value of a field in the unit that suits it; objects by their names.

    Examples
    --------
    >>> value_text(0.02, "kg"), value_text(None, "Pa"), value_text((300.0, 353.15), "K")
    ('20 g', 'none', '26.85 degC, 80 degC')
    """
    if value is None:
        return "none"
    if isinstance(value, bool | str):
        return str(value)
    if isinstance(value, int | float) and unit == "K":
        return f"{value - celsius(0.0):.4g} degC"
    if isinstance(value, int | float):
        return quantity_text(float(value), unit)
    if shape := getattr(value, "shape", ()):
        return " x ".join(map(str, shape)) + " values"
    if isinstance(value, tuple | list):
        return ", ".join(value_text(v, unit) for v in value)
    return str(getattr(value, "label", None) or getattr(value, "name", None) or value)


def _is_default(one: Attribute[Any], value: Any) -> bool:
    make = getattr(one.default, "factory", None)
    default = make() if make else one.default
    return default is not NOTHING and type(default) is type(value) and bool(default == value)
