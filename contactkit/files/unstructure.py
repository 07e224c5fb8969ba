"""Scene objects to tables of plain values."""

from __future__ import annotations

import hashlib
from collections.abc import Mapping
from typing import TYPE_CHECKING, Any, NamedTuple

import attrs

from ..errors import DescriptionError
from ..kinds import KINDS
from ..scene.interface import Body

__all__ = ["unstructure", "with_arrays"]

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    Arrays = dict[str, NDArray[np.float64]]

_ARRAY = "scene-array-"  # prefix of the keys of arrays, which no other array of a result has


def unstructure(value: Any, arrays: Arrays | None = None, *, for_key: bool = False) -> Any:
    """Convert attrs objects to tables of plain values; defaults are left out.

    Parameters
    ----------
    value : object
        A scene, or a part of one.
    arrays : dict, optional
        Where arrays go, under a key that is made from their content and stands for them in the
        tables. None: arrays are refused.
    for_key : bool
        Whether the tables are to tell scenes apart, not to be read: a class of one's own is named.

    Raises
    ------
    DescriptionError
        If there is something that the tables could not hold whole: an array and no place for it, a
        surface, law or effect of one's own, a function; says what to use instead.
    """
    return _Tables(arrays, for_key).of(value, type(value).__name__)


class _Tables(NamedTuple):
    """Conversion of objects to tables; `place` is the path of an object, for messages."""

    arrays: Arrays | None
    for_key: bool

    def of(self, value: Any, place: str) -> Any:
        if isinstance(value, Body) and type(value) is Body and value.solid is None:
            return self.of(value.surface, place)  # a rigid body is written as its surface
        if attrs.has(type(value)):
            return self._table(value, place)
        if isinstance(value, tuple | list):
            return [self.of(item, f"{place}[{i}]") for i, item in enumerate(value)]
        if isinstance(value, Mapping):
            return {str(key): self.of(item, f"{place}.{key}") for key, item in value.items()}
        plain = value.item() if hasattr(value, "dtype") and not value.ndim else value
        if not isinstance(plain, bool | int | float | str):
            hint = "keep the scene in Python, where pickle may hold it"
            raise DescriptionError(place, value, "be a number, a text, or true or false", hint=hint)
        return plain

    def _table(self, value: Any, place: str) -> dict[str, Any] | str:
        kind = type(value)
        if "__attrs_attrs__" not in vars(kind):
            hint = f"decorate {kind.__name__} with @attrs.frozen(kw_only=True)"
            raise DescriptionError(place, value, "have fields, to be written as a table", hint=hint)
        table = self._tagged(value, place)
        for a in attrs.fields(kind):
            item = getattr(value, a.name)
            if getattr(item, "ndim", 0):
                table[a.alias] = _put_away(item, kind, a, self.arrays)
            elif a.init and item is not None and item != a.default:
                table[a.alias] = self.of(item, f"{place}.{a.alias}")
        registry = KINDS.of(kind)
        is_plain = registry is not None and registry.plain and len(table) == 1
        return table[registry.tag] if registry is not None and is_plain else table

    def _tagged(self, value: Any, place: str) -> dict[str, Any]:
        """Key and name of the kind of an object, if it is one of several."""
        kind, registry = type(value), KINDS.of(type(value))
        if registry is not None and (name := registry.name_of(kind)):
            return {} if name in registry.implied else {registry.tag: name}
        if self.for_key:
            return {"class": f"{kind.__module__}.{kind.__qualname__}"}
        if registry is None:
            base = _replaced(kind)
            if base and "." in place:  # a scene itself is of the kind that it is registered for
                expected = f"be a {base} itself, as files name no class in its place"
                hint = "keep the scene in Python, where pickle may hold it"
                raise DescriptionError(place, value, expected, hint=hint)
            return {}
        raise DescriptionError(
            place,
            value,
            f"be of a {registry.what} that files can name",
            hint=f"register it first: ck.register({kind.__name__})",
        )


def _replaced(kind: type) -> str:
    """Class of contactkit that one from outside the package derives from; empty if it is of it."""
    ours = __package__.partition(".")[0]
    bases = [base for base in kind.__mro__ if "__attrs_attrs__" in vars(base)]
    first = next((base for base in bases if base.__module__.partition(".")[0] == ours), None)
    return first.__name__ if first is not None and first is not kind else ""


def _put_away(item: Any, kind: type, attribute: attrs.Attribute[Any], arrays: Arrays | None) -> str:
    if arrays is None:
        raise DescriptionError(
            f"{kind.__name__}.{attribute.name}",
            f"an array of shape {item.shape}",
            "not be an array, to be written as text",
            hint=attribute.metadata.get("in_file", "it is kept in Python and in result files"),
        )
    shape = "x".join(map(str, item.shape))
    key = f"{_ARRAY}{shape}-{hashlib.sha256(item.tobytes()).hexdigest()}"
    arrays[key] = item
    return key


def with_arrays(tables: Any, arrays: Mapping[str, Any]) -> Any:
    """Put arrays back into tables, in place of their keys."""
    if isinstance(tables, Mapping):
        return {name: with_arrays(item, arrays) for name, item in tables.items()}
    if isinstance(tables, list):
        return [with_arrays(item, arrays) for item in tables]
    stands_for_one = isinstance(tables, str) and tables.startswith(_ARRAY)
    return arrays.get(tables, tables) if stands_for_one else tables
