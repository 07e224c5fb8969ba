"""Contact results as arrays and a header of plain values, and back."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

import numpy as np

from ..accuracy import Accuracy
from ..contact.effects.base import Attraction, SolvedContact
from ..contact.plan import ContactPlan
from ..contact.result import ContactResult
from ..contact.validity import check_contact
from ..contact.work import ContactWork
from ..frozen import FrozenDict
from ..kinds import CONTACT_EFFECTS
from ..scene.scenes import ContactScene
from ..scene.window import Grid
from .structure import structure, unstructure, with_arrays

if TYPE_CHECKING:
    from numpy.typing import NDArray

    Arrays = dict[str, NDArray[Any]]

__all__ = ["pack_contact", "unpack_contact"]

_MAPS = ("pressure", "gap", "displacement", "heights")


def pack_contact(result: ContactResult) -> tuple[dict[str, Any], Arrays]:
    """Split a result into a header of plain values and its arrays by name.

    The header has the scene (arrays in it by a key), the grid, the accuracy, the status, the
    numbers with their units and what each effect did.
    """
    arrays: Arrays = {name: getattr(result, name) for name in _MAPS}
    parts = {kind.name: _encode(p, kind.name, arrays) for kind, p in result.parts.items()}
    made = result.plan
    header = {
        "kind": "contact",
        "scene": unstructure(made.scene, arrays),
        "grid": [list(made.grid.shape), list(made.grid.pixel_size), *made.grid[2:]],
        "accuracy": made.accuracy.saved(),
        "status": result.status,
        "message": result.message,
        "rigid_approach": result.rigid_approach,
        "residual": result.residual,
        "energy": result.energy,
        "scalars": {n: [_encode(v, n, arrays), unit] for n, (v, unit) in result.scalars().items()},
        "work": result.work._asdict() | {"stages": dict(result.work.stages)},
        "parts": parts,
    }
    return header, arrays


def unpack_contact(header: Mapping[str, Any], arrays: Arrays, name: str) -> ContactResult:
    """Reassemble a result from the header and arrays of `pack_contact`.

    The plan is not made anew: a file that the scene names may have moved since.
    """
    scene = structure(with_arrays(header["scene"], arrays), ContactScene, name)
    (ny, nx), (dy, dx), *edges = header["grid"]
    grid, work = Grid((ny, nx), (dy, dx), *edges), header["work"]
    accuracy = Accuracy.of_file(header["accuracy"])
    maps = {name: arrays[name] for name in _MAPS}
    for key, one in maps.items():
        if one.shape != grid.shape or one.dtype != np.float64:
            raise ValueError(f"{key} is {one.shape} of {one.dtype}, not {grid.shape} of float64")
    parts = {CONTACT_EFFECTS.find(n): _decode(p, arrays) for n, p in header["parts"].items()}
    contact = SolvedContact(scene, grid, maps["pressure"], maps["displacement"], maps["gap"])
    attraction = scene.effect(Attraction)
    if attraction is not None and type(attraction) in parts:
        contact = contact._replace(attracted=attraction.attracted_of(parts[type(attraction)]))
    return ContactResult(
        plan=ContactPlan(scene, accuracy, grid),
        status=header["status"],
        message=header["message"],
        **maps,
        rigid_approach=header["rigid_approach"],
        residual=header["residual"],
        energy=header["energy"],
        work=ContactWork(**work | {"stages": FrozenDict(work["stages"])}),
        parts=FrozenDict(parts),
        validity=check_contact(contact, maps["heights"], parts),
    )


def _encode(value: Any, name: str, arrays: Arrays) -> Any:
    """Convert a value to JSON types; arrays are put into `arrays`, under their path."""
    if isinstance(value, np.ndarray) and value.ndim:
        arrays[name] = value
        return {"array": name}
    if isinstance(value, np.generic | np.ndarray):
        value = value.item()
    if hasattr(value, "_fields"):
        fields = {f: _encode(getattr(value, f), f"{name}.{f}", arrays) for f in value._fields}
        return {"record": type(value).__name__, "fields": fields}
    if isinstance(value, Mapping):
        return {"mapping": {k: _encode(v, f"{name}.{k}", arrays) for k, v in value.items()}}
    if isinstance(value, tuple | list):
        return {"tuple": [_encode(v, f"{name}.{i}", arrays) for i, v in enumerate(value)]}
    if isinstance(value, float) and not math.isfinite(value):
        return {"float": str(value)}
    if value is None or isinstance(value, bool | int | float | str):
        return value
    raise TypeError(f"{name}: a {type(value).__name__} has no place in a result file")


def _decode(value: Any, arrays: Arrays) -> Any:
    if not isinstance(value, Mapping):
        return value
    if "array" in value:
        return arrays[value["array"]]
    if "record" in value:
        fields = {n: _decode(v, arrays) for n, v in value["fields"].items()}
        return _record(value["record"])(**fields)
    if "mapping" in value:
        return FrozenDict({k: _decode(v, arrays) for k, v in value["mapping"].items()})
    if "tuple" in value:
        return tuple(_decode(v, arrays) for v in value["tuple"])
    return float(value["float"])


def _record(name: str) -> Any:
    """Find the kind of a record by its name among those that the effects declare."""
    records = {one.__name__: one for kind in CONTACT_EFFECTS for one in kind.records}
    return records[name]
