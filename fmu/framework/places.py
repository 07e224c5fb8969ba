"""Parameters of an FMU as fields of the scene behind it: one table for both directions.

A `Place` says where in the scene a parameter stands. `read` gives the start values of a scene,
`write` puts the values of a host into a scene; both follow the same table. `differences` finds what
of a scene does not survive both, so that it can be refused.
"""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Collection, Iterator, Mapping
from enum import IntEnum
from functools import reduce
from typing import TYPE_CHECKING, Any, NamedTuple, TypeVar, cast

from attrs import evolve, field, fields, frozen, has

if TYPE_CHECKING:
    from ...liquids.liquid import LiquidState

__all__ = ["Difference", "Place", "differences", "in_parameters", "read", "write"]

_T = TypeVar("_T")
_LIQUID = "interface.meniscus.liquid."


def _as_tuple(paths: str | tuple[str, ...]) -> tuple[str, ...]:
    return (paths,) if isinstance(paths, str) else paths


@frozen
class Place:
    """Field of a scene, or of another object made of attrs classes, that a parameter stands for.

    Parameters
    ----------
    paths : str or tuple of str
        Dotted names of fields. Of several, each gets the value; the smallest one there is read.
    effect : type, optional
        Effect of the scene that has the field, instead of the scene itself.
    nothing : optional
        Value that stands for None, or for an effect that is not there.
    words : mapping, optional
        Value in the scene by member of an enumeration; of others the parameter has `nothing`.
    """

    paths: tuple[str, ...] = field(converter=_as_tuple)
    effect: type | None = None
    nothing: Any = None
    words: Mapping[IntEnum, Any] = field(factory=dict)

    @property
    def fields(self) -> frozenset[str]:
        """Last names of the paths."""
        return frozenset(path.rpartition(".")[2] for path in self.paths)

    def read(self, scene: Any, liquid: LiquidState | None = None) -> Any:
        """Value of the parameter for a scene; that of an enumeration is the name of its member.

        Properties of a liquid are those it has at the temperature of the scene.
        """
        owner = scene if self.effect is None else scene.effect(self.effect)
        if liquid is not None and self.paths[0].startswith(_LIQUID):
            found = [liquid.given(name) for name in self.fields]
        else:
            paths = self.paths if owner is not None else ()
            found = [reduce(getattr, path.split("."), owner) for path in paths]
        value = min((one for one in found if one is not None), default=self.nothing)
        # A choice with other fields is read as the same choice: the caller names the difference.
        alike = [m for m, one in self.words.items() if one == value]
        alike += [m for m, one in self.words.items() if has(type(one)) and type(one) is type(value)]
        if alike:
            return alike[0].name
        if self.words:  # another choice, which the check of the value refuses by its name
            return getattr(value, "kind", value)
        return self.nothing if isinstance(value, str) else value

    def value_in_scene(self, value: Any) -> Any:
        """Value of the field for one of the parameter."""
        if self.nothing is not None and value == self.nothing:
            return None
        return self.words.get(value, value)


def read(
    places: Mapping[str, Place], scene: Any, liquid: LiquidState | None = None
) -> dict[str, Any]:
    """Values of the parameters for a scene, whose liquid is that of a state if one is given."""
    return {name: place.read(scene, liquid) for name, place in places.items()}


def write(places: Mapping[str, Place], scene: _T, values: Mapping[str, Any]) -> _T:
    """Scene with the values of the parameters in their places, all at once.

    Effects that come in addition follow those of the scene in the order of the table.
    """
    tree: dict[str, Any] = {}
    for name, place in places.items():
        if place.effect is None:
            for path in place.paths:
                *owners, last = path.split(".")
                owner = reduce(lambda at, part: at.setdefault(part, {}), owners, tree)
                owner[last] = place.value_in_scene(values[name])
    made = _evolved(scene, tree)
    added = []
    for name, place in places.items():
        value = place.value_in_scene(values[name])
        if place.effect is not None and value is not None:
            added.append(place.effect(**{place.paths[0]: value}))
    return cast(_T, evolve(made, effects=(*made.effects, *added)) if added else made)


def _evolved(owner: Any, tree: Mapping[str, Any]) -> Any:
    changes = {
        name: _evolved(getattr(owner, name), value) if isinstance(value, dict) else value
        for name, value in tree.items()
    }
    return evolve(owner, **changes)


def in_parameters(places: Mapping[str, Place], text: str) -> str:
    """Text in which the fields of a scene are called by the parameters that stand for them.

    Examples
    --------
    >>> in_parameters({"h_min": Place("loading.rest_gap")}, "give ImposedForce.rest_gap [m]")
    'give h_min [m]'
    """
    fields_of = Counter(field for place in places.values() for field in place.fields)
    for name, place in places.items():
        for path in place.paths:
            *_, owner, field = f".{path}".split(".")
            of = r"\w+" if fields_of[field] == 1 else f"(?i:{owner})"
            text = re.sub(rf"\b(\w+\.)*{of}\.{field}\b", name, text)
    return text


class Difference(NamedTuple):
    """Field of a scene that its parameters do not hold, with both values."""

    path: str
    given: Any
    held: Any

    def __str__(self) -> str:
        """Return the field with the value that the parameters hold, and the one given."""
        if self.held is None and has(type(self.given)):
            return f"no {self.path}"
        if self.given is None and has(type(self.held)):
            return f"always {self.path}"
        return f"{self.path} = {_short(self.held)}, not {_short(self.given)}"


def differences(given: Any, held: Any, free: Collection[str] = ()) -> list[Difference]:
    """Fields in which a scene differs from the one that its parameters describe.

    Parameters
    ----------
    given, held : scene
        What was given, and what `write` makes of its parameters.
    free : collection of str
        Dotted names of fields that may differ with all of theirs, as they are no part of what is
        represented.
    """
    below = tuple(f"{path}." for path in free)
    found = _differences(given, held, "")
    return [one for one in found if one.path not in free and not one.path.startswith(below)]


def _differences(given: Any, held: Any, path: str) -> Iterator[Difference]:
    if given == held:
        return
    if path == "effects":
        one, other = ({type(e).__name__: e for e in effects} for effects in (given, held))
        for name in sorted({*one, *other}):
            yield from _differences(one.get(name), other.get(name), name)
    elif type(given) is type(held) and has(type(given)):
        for part in fields(type(given)):
            name = f"{path}.{part.name}" if path else part.name
            yield from _differences(getattr(given, part.name), getattr(held, part.name), name)
    else:
        yield Difference(path, given, held)


def _short(value: Any) -> str:
    return f"{type(value).__name__}(...)" if has(type(value)) else repr(value)
