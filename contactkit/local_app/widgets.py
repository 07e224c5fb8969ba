"""Widgets of a scene object: what each field takes, read off its class.

Label, unit, range, choices and help come from the field itself: its metadata, its type, the message
of its validator, the docstring of its class. Nothing here knows a page or a browser.
"""

from __future__ import annotations

import inspect
import math
import re
import types
from collections.abc import Iterable, Mapping
from typing import Any, Literal, Union, get_args, get_origin

import attrs
from attrs import frozen

from ..errors import DescriptionError
from ..files.structure import resolved
from ..kinds import KINDS
from ..registry import family_of
from ..units import parse_quantity, readable_unit

__all__ = ["Widget", "exact_text", "is_complete", "value_of_text", "widgets_of"]

Take = Literal["quantity", "number", "whole", "choice", "flag", "text"]

_NOT_GIVEN = ""
_NUMBER = re.compile(r"[-+]?(\d+\.?\d*|\.\d+)([eE][-+]?\d{1,3})?")
_HUGE = 1e50  # within what any quantity may be, beyond any range of one
_FLAGS = {"yes": True, "no": False}


@frozen(kw_only=True)
class Widget:
    """A field as a page asks for it.

    Attributes
    ----------
    path : str
        Place in the tables of a scene file, such as ``loading.force``.
    label : str
        Name for people.
    takes : {"quantity", "number", "whole", "choice", "flag", "text"}
        A quantity is a text with a unit, ``"40 N"``; a choice is one of `options`.
    value : str
        Text at the start; empty where the field is not given.
    unit : str
        SI unit, ``-`` for a pure number; empty for what is no number.
    options : tuple of str
        Choices; the empty one leaves the field out.
    expected : str
        Range, in the words of the field's own validator; empty where that states none.
    default : str
        Text of the default; empty without one.
    is_required : bool
        Whether the field has no default.
    help : str
        What the docstring of the class says about the field.
    """

    path: str
    label: str
    takes: Take
    value: str = ""
    unit: str = ""
    options: tuple[str, ...] = ()
    expected: str = ""
    default: str = ""
    is_required: bool = False
    help: str = ""


def widgets_of(
    kind: type, path: str = "", value: object | None = None, skip: Iterable[str] = ()
) -> tuple[Widget, ...]:
    """Widgets of the fields of a class.

    Parameters
    ----------
    kind : type
        A class of scene objects.
    path : str
        Place of the object in the tables of a scene file.
    value : object, optional
        Object that the texts are taken from; not given: the defaults.
    skip : iterable of str
        Fields that are left out.

    Returns
    -------
    tuple of Widget
        In the order of the class. Arrays, and objects that are no choice of a kind, have none.

    Examples
    --------
    >>> from contactkit.scene.loading import ImposedSpeed
    >>> speed = widgets_of(ImposedSpeed, "loading")[2]
    >>> speed.path, speed.takes, speed.unit, speed.expected
    ('loading.speed', 'quantity', 'm/s', 'be positive and finite')
    """
    resolved(kind)
    described, found = _parameters(kind), list[Widget]()
    for one in attrs.fields(kind):
        if one.init and one.name[0] != "_" and one.name not in skip:
            found += _of_field(kind, one, f"{path}." if path else "", value, described)
    return tuple(found)


def is_complete(kind: type) -> bool:
    """Whether every field without a default has a widget, so that a form can make the object."""
    shown = {widget.path.partition(".")[0] for widget in widgets_of(kind)}
    return all(
        one.name in shown for one in attrs.fields(kind) if one.init and one.default is attrs.NOTHING
    )


def _of_field(
    kind: type,
    one: attrs.Attribute[Any],
    before: str,
    owner: object | None,
    described: Mapping[str, str],
) -> list[Widget]:
    place, unit = f"{before}{one.name}", one.metadata.get("unit", "")
    default = None if one.default is attrs.NOTHING else one.default
    if isinstance(default, attrs.Factory):  # type: ignore[arg-type]
        default = None
    value = default if owner is None else getattr(owner, one.name, None)
    takes, options = _takes(one, unit)
    if takes is None:
        return []
    widget = Widget(
        path=place,
        label=one.name.replace("_", " "),
        takes=takes,
        value=_text(value, unit),
        unit=unit if takes in ("quantity", "number", "whole") else "",
        options=options,
        expected="" if takes in ("choice", "flag", "text") else _expected(kind, one),
        default=_text(default, unit),
        is_required=one.default is attrs.NOTHING,
        help=described.get(one.name, ""),
    )
    family = _family(one)
    return [widget] if family is None else _of_family(widget, family, value)


def _of_family(widget: Widget, family: type, value: object) -> list[Widget]:
    """Choice of a kind, and the fields that all kinds of the family have."""
    known = KINDS.of(family)
    assert known is not None
    is_object = attrs.has(type(value))
    chosen = known.name_of(type(value)) if is_object else widget.value
    shown = chosen or widget.options[0]
    if shown not in widget.options:
        return []  # a law of one's own, or one that these widgets cannot hold
    found = [attrs.evolve(widget, value=shown, is_required=False)]
    if known.name_of(family) or not _shared(family):
        return found
    kind = known.find(shown)
    own = {one.name for one in attrs.fields(kind)} - _shared(family)
    return [*found, *widgets_of(kind, widget.path, value if is_object else None, own)]


def _takes(one: attrs.Attribute[Any], unit: str) -> tuple[Take | None, tuple[str, ...]]:
    """What a field takes, and its choices; None for what no widget holds."""
    members = _members(one.type)
    words = tuple(w for m in members if get_origin(m) is Literal for w in get_args(m))
    empty = ("",) if type(None) in members else ()
    family = _family(one)
    if one.metadata.get("in_file") or any(get_origin(m) in (dict, list) for m in members):
        return None, ()
    if family is not None:
        if empty:
            return None, ()  # a whole object that may be left out is for scene files
        known = KINDS.of(family)
        assert known is not None
        kinds = tuple(n for n, kind in known.by_name.items() if _is_plain(kind, family))
        return ("choice", (*(str(w) for w in words), *kinds)) if kinds or words else (None, ())
    if bool in members and (empty or words):
        return "choice", (*empty, *_FLAGS, *(str(w) for w in words if not isinstance(w, bool)))
    if members == (bool,):
        return "flag", ()
    if unit and words and all(isinstance(w, int) for w in words):
        return "choice", (*empty, *(str(w) for w in words))
    if float in members:
        return ("number" if unit == "-" else "quantity"), ()
    if int in members:
        return "whole", ()
    if words:
        return "choice", (*empty, *(str(w) for w in words))
    return ("text", ()) if str in members else (None, ())


def _members(annotated: Any) -> tuple[Any, ...]:
    """Members of a union, or the type itself."""
    is_union = get_origin(annotated) in (Union, types.UnionType)
    return get_args(annotated) if is_union else (annotated,)


def _family(one: attrs.Attribute[Any]) -> type | None:
    """Base class of a family of kinds, or the one kind, that a field holds beside words."""
    for member in _members(one.type):
        if isinstance(member, type) and family_of(member) and KINDS.of(member) is not None:
            return member if not one.metadata.get("unit") else None
    return None


def _shared(family: type) -> set[str]:
    """Fields that all kinds of a family have, by its base class."""
    return {one.name for one in attrs.fields(family)} if attrs.has(family) else set()


def _is_plain(kind: type, family: type) -> bool:
    """Whether a kind needs no fields but those that all of its family have."""
    needed = {a.name for a in attrs.fields(kind) if a.init and a.default is attrs.NOTHING}
    return needed <= _shared(family)


def _expected(kind: type, one: attrs.Attribute[Any]) -> str:
    """Range of a field: what its validator says of a huge number, or of one that is none."""
    words = [w for m in _members(one.type) if get_origin(m) is Literal for w in get_args(m)]

    def with_words(expected: str) -> str:
        """The range, and words that it does not name itself."""
        more = [f"or {word!r}" for word in words if repr(word) not in expected]
        return ", ".join([*filter(None, [expected]), *more]).removeprefix("or ")

    for probe in (_HUGE, math.nan):
        try:
            if one.validator is not None:
                one.validator(object.__new__(kind), one, probe)
        except DescriptionError as error:
            return with_words(error.expected)
        except (AttributeError, TypeError, ValueError):  # it looks at other fields first
            continue
    return with_words("")


def _parameters(kind: type) -> dict[str, str]:
    """First sentence of each parameter in the docstrings of a class and its bases."""
    found: dict[str, str] = {}
    for base in reversed(kind.__mro__):
        text = inspect.cleandoc(vars(base).get("__doc__") or "")
        _, _, section = text.partition("\nParameters\n----------\n")
        section = re.split(r"\n\n?[A-Z][a-z]+\n-{3,}\n", section)[0]
        for match in re.finditer(r"^(\w[\w, ]*) : .*\n((?:    .*\n?|\n)+)", section, re.M):
            said = " ".join(match[2].split())
            found |= dict.fromkeys(match[1].split(", "), said.replace("`", ""))
    return found


# Texts ----------------------------------------------------------------------------------------


def exact_text(value: float, unit: str) -> str:
    """Shortest text of a quantity that is read back as the same number.

    Examples
    --------
    >>> exact_text(2.5e-5, "m"), exact_text(293.15, "K"), exact_text(0.1 + 0.2, "-")
    ('25 um', '20 degC', '0.30000000000000004')
    """
    if not math.isfinite(value) or unit in ("", "-"):
        return repr(value)
    factor, name = readable_unit(value, unit)
    shift, name = (273.15, "degC") if unit == "K" else (0.0, name)
    for digits in (4, 6, 9, 12, 15, 17):
        text = f"{value / factor - shift:.{digits}g} {name}"
        if parse_quantity(text, unit) == value:
            return text
    return f"{value!r} {unit}"


def _text(value: Any, unit: str) -> str:
    if value is None or attrs.has(type(value)):
        return _NOT_GIVEN
    if isinstance(value, bool):
        return "yes" if value else "no"
    if isinstance(value, float) or (isinstance(value, int) and unit not in ("", "-")):
        return exact_text(float(value), unit)
    if isinstance(value, tuple):
        return ", ".join(_text(item, unit) for item in value)
    return str(value)


def value_of_text(widget: Widget, text: str | bool) -> Any:
    """Value of a scene file for the text of a widget; None where that is empty.

    Two quantities with a comma between them are a pair, as of a length along y and along x.

    Examples
    --------
    >>> pixel = Widget(path="pixel_size", label="", takes="quantity", unit="m")
    >>> value_of_text(pixel, "2 nm, 4 nm"), value_of_text(pixel, " ")
    (['2 nm', '4 nm'], None)
    """
    if isinstance(text, bool):
        return text
    given = text.strip()
    if not given:
        return None
    if widget.takes in ("choice", "flag") and given in _FLAGS:
        return _FLAGS[given]
    if widget.takes == "whole" or (widget.takes == "choice" and given.isdecimal()):
        return int(given) if re.fullmatch(r"[-+]?\d{1,18}", given) else given
    if widget.takes == "number" and _NUMBER.fullmatch(given):
        return float(given)
    if widget.takes == "quantity" and re.search(r"[\d\w]\s*,\s+\S", given):
        return [part.strip() for part in re.split(r",\s+", given)]
    return given
