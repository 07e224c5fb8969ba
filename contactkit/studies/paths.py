"""Dotted paths into a scene: reading and applying the parameters of a study."""

from __future__ import annotations

import difflib
import itertools
import math
from collections.abc import Iterable, Iterator, Mapping, Sequence
from typing import Any, NamedTuple

import attrs

from ..accuracy import Accuracy
from ..errors import DescriptionError
from ..files.structure import field_value, renamed, resolved
from ..reading.limits import check_limit
from ..scene.effect import Effect
from ..scene.scenes import ContactScene, SeparationScene, SlidingScene

__all__ = [
    "Axis",
    "Changed",
    "Scene",
    "Parameters",
    "axes",
    "changed",
    "check_apart",
    "combinations",
    "joined",
    "paths_of",
    "read_value",
    "takes_text",
    "value_at",
]

Scene = SeparationScene | SlidingScene | ContactScene
Tree = dict[str, Any]
"""Changes by the segments of their paths; a leaf is a value in `_Leaf`."""


class _Leaf(NamedTuple):
    value: Any


class Axis(NamedTuple):
    """Parameters that vary together: their paths, rows of values in SI units, and the units."""

    paths: tuple[str, ...]
    values: tuple[tuple[Any, ...], ...]
    units: tuple[str, ...]


Parameters = (
    Mapping[str, Iterable[Any]]
    | Mapping[tuple[str, ...], Iterable[Any]]
    | Mapping[str | tuple[str, ...], Iterable[Any]]
)
"""Values by path; rows of values where a key is several paths, a tuple or separated by commas."""


class _Owner(NamedTuple):
    """Class and field that a path refers to; no class for an item of a tuple."""

    kind: type | None
    field: str


def axes(scene: object, accuracy: Accuracy, parameters: Parameters) -> tuple[Axis, ...]:
    """Parse the parameters of a study.

    Parameters
    ----------
    scene : ContactScene, SeparationScene or SlidingScene, or that of a device
        The scene that the paths refer to.
    accuracy : Accuracy
        The settings that paths beginning with ``accuracy.`` refer to.
    parameters : mapping of str or tuple of str to sequence
        Values by dotted path, such as ``interface.lower.solid.layers.0.thickness`` (an index for an
        item of a tuple) or ``effects.friction-traction.coefficient`` (an effect by its name). With
        the name of an effect alone, false leaves the effect out and true keeps it.
        Quantities may be texts with a unit. Several paths, a tuple or one text with commas, vary
        together: each of their values is a row with one for each path.

    Raises
    ------
    DescriptionError
        If a path does not exist, is given twice, lies inside another, or has no values.

    Examples
    --------
    >>> import contactkit as ck
    >>> steel = ck.Material(young_modulus=210e9, poisson_ratio=0.3)
    >>> coated = ck.Stack(substrate=steel, layers=(ck.Layer(material=steel, thickness=1e-6),))
    >>> scene = ck.ContactScene(
    ...     interface=ck.Interface(lower=ck.Body(solid=coated)),
    ...     loading=ck.Pressing(pressure=1e6), effects=(ck.LayeredHalfSpace(),),
    ... )
    >>> thickness = "interface.lower.solid.layers.0.thickness"
    >>> axes(scene, ck.Accuracy(), {thickness: ["5 nm", 1e-8]})[0].values
    ((5e-09,), (1e-08,))
    """
    if not isinstance(parameters, Mapping) or not parameters:
        raise DescriptionError("parameters", parameters, "name at least one field and its values")
    found = tuple(
        _axis(scene, accuracy, joined(key, "parameters"), v) for key, v in parameters.items()
    )
    check_limit("POINTS", math.prod(len(axis.values) for axis in found), "the study", "parameters")
    check_apart([path for axis in found for path in axis.paths], "parameters")
    return found


def joined(key: object, origin: str) -> str:
    """Key of what varies as text: paths that vary together may also be given as a tuple.

    Raises
    ------
    DescriptionError
        Of the field `origin`, if the key is neither.
    """
    paths = key if isinstance(key, tuple) and key else (key,)
    for path in paths:
        if not isinstance(path, str):
            raise DescriptionError(origin, key, "be named by a path, or by a tuple of paths")
    return ", ".join(paths)


def check_apart(paths: Sequence[str], origin: str) -> None:
    """Refuse a path that is given twice, or lies inside another.

    Raises
    ------
    DescriptionError
        Of the field `origin`.
    """
    for path in paths:
        if paths.count(path) > 1:
            raise DescriptionError(origin, path, "be given once")
        for other in paths:
            if other.startswith(f"{path}."):
                raise DescriptionError(origin, other, f"not lie inside {path!r}")


def read_value(scene: Any, accuracy: Accuracy | None, path: str, value: Any, origin: str) -> Any:
    """Read a value for a path as a scene file does: a quantity with its unit, a name, a table.

    Parameters
    ----------
    scene : object
        The scene, or the description of a device, that the path refers to.
    accuracy : Accuracy or None
        The settings that paths beginning with ``accuracy.`` refer to, if there are any.
    path : str
        A dotted path, see `axes`.
    value : object
        The value to read.
    origin : str
        What gives the path, for messages.

    Raises
    ------
    DescriptionError
        If the path does not exist, or the value cannot be read.
    """
    return _value(_owner(scene, accuracy, path, origin), value)


def takes_text(scene: Any, accuracy: Accuracy | None, path: str, origin: str) -> bool:
    """Whether the field of a path takes a text and nothing else, such as a name.

    Raises
    ------
    DescriptionError
        If the path does not exist.
    """
    owner = _owner(scene, accuracy, path, origin)
    if owner.kind is None:
        return False
    resolved(owner.kind)
    return getattr(attrs.fields(owner.kind), owner.field).type is str


def paths_of(owner: Any) -> Iterator[str]:
    """Paths of all fields of a scene, of its accuracy or of a part of them."""
    for name, value in _choices(owner).items():
        below = list(paths_of(value))
        yield from (f"{name}.{path}" for path in below)
        if not isinstance(owner, tuple):
            yield name


def combinations(varied: Sequence[Axis]) -> list[dict[str, Any]]:
    """Values by path of every point, the last axis fastest."""
    paths = [path for axis in varied for path in axis.paths]
    product = itertools.product(*(axis.values for axis in varied))
    return [dict(zip(paths, itertools.chain(*rows), strict=True)) for rows in product]


def values_at(varied: tuple[Axis, ...], place: int) -> dict[str, Any]:
    """Values by path of one point, by its place in the order of `combinations`."""
    rows = []
    for axis in reversed(varied):
        place, i = divmod(place, len(axis.values))
        rows.append((axis.paths, axis.values[i]))
    return {p: v for paths, row in reversed(rows) for p, v in zip(paths, row, strict=True)}


class Changed(NamedTuple):
    """Scene and accuracy of a point of a study."""

    scene: Any
    accuracy: Any


def changed(scene: Any, accuracy: Any, values: Mapping[str, Any]) -> Changed:
    """Apply values by path to a scene or a device, and to its accuracy.

    Each object is rebuilt once, so that coupled fields change together.

    Raises
    ------
    DescriptionError
        If an object refuses its values.
    """
    trees: dict[bool, Tree] = {True: {}, False: {}}
    for path, value in values.items():
        head, _, rest = path.partition(".")
        is_accuracy = head == "accuracy"
        segments = (rest if is_accuracy else path).split(".")
        at = trees[is_accuracy]
        for segment in segments[:-1]:
            at = at.setdefault(segment, {})
        at[segments[-1]] = _Leaf(value)
    return Changed(_rebuilt(scene, trees[False]), _rebuilt(accuracy, trees[True]))


def _rebuilt(owner: Any, tree: Tree | _Leaf) -> Any:
    if isinstance(tree, _Leaf):
        return tree.value
    if not tree:
        return owner
    if isinstance(owner, tuple):
        items = list(owner)
        for segment, below in tree.items():
            i = _places(owner)[segment]
            made = _rebuilt(items[i], below)
            items[i] = items[i] if made is True else made
        return tuple(item for item in items if item is not False)  # an effect that is left out
    changes = {name: _rebuilt(getattr(owner, name), below) for name, below in tree.items()}
    made = attrs.evolve(owner, **changes)
    # A value that is the usual one is given all the same.
    return made.with_given(changes) if isinstance(made, Accuracy) else made


def _axis(scene: object, accuracy: Accuracy, key: str, values: Iterable[Any]) -> Axis:
    paths = tuple(path.strip() for path in key.split(","))
    owners = [_owner(scene, accuracy, path, "parameters") for path in paths]
    if isinstance(values, str | bytes | Mapping) or not isinstance(values, Iterable):
        raise DescriptionError(f"parameters[{key!r}]", values, "be a sequence of values")
    given = list(values)
    if not given:
        raise DescriptionError(f"parameters[{key!r}]", given, "have at least one value")
    rows = [(value,) for value in given] if len(paths) == 1 else _rows(key, given, len(paths))
    columns = [[_value(owner, row[i]) for row in rows] for i, owner in enumerate(owners)]
    return Axis(paths, tuple(zip(*columns, strict=True)), tuple(map(_unit, owners)))


def _rows(key: str, given: list[Any], n: int) -> list[tuple[Any, ...]]:
    """Rows of values of paths that vary together."""
    for row in given:
        if not isinstance(row, list | tuple) or len(row) != n:
            raise DescriptionError(
                f"parameters[{key!r}]", row, f"be a row of {n} values, one for each path"
            )
    return [tuple(row) for row in given]


def _value(owner: _Owner, value: Any) -> Any:
    plain = value.item() if getattr(value, "ndim", None) == 0 else value
    return plain if owner.kind is None else field_value(owner.kind, owner.field, plain)


def _unit(owner: _Owner) -> str:
    if owner.kind is None:
        return "-"
    unit: str = getattr(attrs.fields(owner.kind), owner.field).metadata.get("unit", "-")
    return unit


def value_at(scene: object, accuracy: Accuracy, path: str) -> Any:
    """Value that a path leads to.

    Raises
    ------
    DescriptionError
        If the path does not exist.

    Examples
    --------
    >>> import contactkit as ck
    >>> value_at(ck.Meniscus(liquid=ck.load_liquid("water")), ck.Accuracy(), "liquid.name")
    'water'
    """
    return _walk(scene, accuracy, path, "parameters")[1]


def _owner(scene: object, accuracy: Accuracy | None, path: str, origin: str) -> _Owner:
    return _walk(scene, accuracy, path, origin)[0]


def _walk(scene: object, accuracy: Accuracy | None, path: str, origin: str) -> tuple[_Owner, Any]:
    """What a path refers to, and the value there."""
    settings = {} if accuracy is None else {"accuracy": accuracy}
    at: Any = settings | {name: getattr(scene, name) for name in _fields(scene)}
    kind, name, walked = None, "", ""
    for segment in path.split("."):
        choices = at if isinstance(at, dict) else _choices(at)
        if segment not in choices:
            raise _lost(_Step(path, segment, walked, at), list(choices), origin)
        kind = type(scene) if isinstance(at, dict) else None if isinstance(at, tuple) else type(at)
        name, at = segment, choices[segment]
        walked = f"{walked}.{segment}" if walked else segment
    if walked == "accuracy":
        raise DescriptionError(origin, path, "lead to a field of it, such as 'accuracy.rtol'")
    return _Owner(kind, name), at


class _Step(NamedTuple):
    """A segment of a path, what was walked before it, and where that leads."""

    path: str
    segment: str
    walked: str
    at: Any


def _lost(step: _Step, choices: list[str], origin: str) -> DescriptionError:
    path, segment, walked, at = step
    if not choices:
        return DescriptionError(origin, path, f"end at {walked!r}", hint=f"that is {at!r}")
    close = difflib.get_close_matches(segment, choices, n=1, cutoff=0.5)
    old = renamed(segment)
    guess = f"did you mean {'.'.join(filter(None, [walked, *close]))!r}? " if close else ""
    what = "has the items" if isinstance(at, tuple) else f"is a {type(at).__name__}, with"
    where = f"{walked!r} {what}" if walked else "there are"
    return DescriptionError(
        origin,
        path,
        "lead to a field of the scene, or of accuracy",
        hint=f"{f'{old}; ' if old else guess}{where} {', '.join(choices)}",
    )


def _fields(owner: Any) -> list[str]:
    return [a.name for a in attrs.fields(type(owner)) if a.init and a.name[0] != "_"]


def _choices(owner: Any) -> dict[str, Any]:
    """Possible next segments of a path; none in a plain value."""
    if isinstance(owner, tuple):
        return {segment: owner[i] for segment, i in _places(owner).items()}
    if attrs.has(type(owner)):
        return {name: getattr(owner, name) for name in _fields(owner)}
    return {}


def _places(items: tuple[Any, ...]) -> dict[str, int]:
    """Index of each item of a tuple by its segments: its number and, for an effect, its name."""
    if items and all(isinstance(item, Effect) for item in items):
        return {item.name: i for i, item in enumerate(items)}
    if all(attrs.has(type(item)) for item in items):
        return {str(i): i for i in range(len(items))}
    return {}
