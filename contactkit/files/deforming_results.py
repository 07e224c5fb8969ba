"""Results of deforming bodies in files: curves, sections, maps, and a header."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

import attrs
import numpy as np

from ..accuracy import Accuracy
from ..frozen import FrozenDict
from ..lubrication.elastohydrodynamic.motion import SmoothGap
from ..scene.scenes import SeparationScene
from ..separation.curve_result import Work
from ..separation.deforming.plan import COLUMNS, DeformingPlan, plan_deforming
from ..separation.deforming.result import MAPS, SECTIONS, DeformingResult
from ..validity import ValidityNumber
from .structure import structure, unstructure, with_arrays

if TYPE_CHECKING:
    from numpy.typing import NDArray

    Arrays = dict[str, NDArray[Any]]

__all__ = ["pack_deforming", "unpack_deforming"]

# Of the names among the arrays of a file: sections, maps, and cells of the film of a plan.
_SECTION, _MAP, _CELLS = "section_", "map_", "cells_"
_OF_CELLS = ("x", "y", "shape")


def pack_deforming(result: DeformingResult) -> tuple[dict[str, Any], Arrays]:
    """Header and arrays of a result."""
    arrays: Arrays = dict(result.columns)
    arrays |= {f"{_SECTION}{name}": values for name, values in result.sections.items()}
    arrays |= {f"{_MAP}{name}": values for name, values in result.fields.items()}
    film = result.plan.film
    if not isinstance(film, SmoothGap):
        cells = film.cells
        arrays |= {f"{_CELLS}{name}": getattr(cells, name) for name in _OF_CELLS}
    header = {
        "kind": "deforming",
        "scene": unstructure(result.plan.scene, arrays),
        "accuracy": result.plan.accuracy.saved(),
        "status": result.status,
        "message": result.message,
        "numbers": dict(result.numbers),
        "validity": [attrs.asdict(number) for number in result.validity],
        "work": result.work._asdict(),
    }
    return header, arrays


def unpack_deforming(header: Mapping[str, Any], arrays: Arrays, name: str) -> DeformingResult:
    """Result of a header and arrays, checked against the plan of its scene.

    Heights are those of the file: one that the scene names may have moved since.
    """
    scene = structure(with_arrays(header["scene"], arrays), SeparationScene, name)
    accuracy = Accuracy.of_file(header["accuracy"])
    groups = {prefix: _group(arrays, prefix) for prefix in (_SECTION, _MAP, _CELLS)}
    sections, maps, cells = groups.values()
    columns = {key: values for key, values in arrays.items() if key in COLUMNS}
    if set(sections) != set(SECTIONS) or set(columns) != set(COLUMNS):
        raise ValueError(f"its arrays are no curves and sections: {sorted(arrays)}")
    points = columns["time"].shape
    if len(points) != 1 or {values.shape for values in columns.values()} != {points}:
        raise ValueError("its curves differ in their lengths")
    shapes = {values.shape for values in sections.values()}
    if len(shapes) != 1 or len(*shapes) != 2 or next(iter(shapes))[0] != points[0]:
        raise ValueError("its sections have not one row for each point of the curves")
    own = [*columns.values(), *sections.values(), *maps.values(), *cells.values()]
    if any(values.dtype.kind != "f" for values in own):
        raise ValueError("its arrays hold no real numbers")
    if maps or cells:
        made = _plan_on_map(scene, accuracy, maps, cells)
    else:
        made = plan_deforming(scene, accuracy)
        if not isinstance(made.film, SmoothGap):
            raise ValueError("its film is on a map, and its maps are missing")
    return DeformingResult(
        made,
        header["status"],
        header["message"],
        FrozenDict(columns),
        FrozenDict(sections),
        FrozenDict(maps),
        FrozenDict({key: float(value) for key, value in header["numbers"].items()}),
        tuple(ValidityNumber(**one) for one in header["validity"]),
        Work(**header["work"]),
    )


def _group(arrays: Arrays, prefix: str) -> Arrays:
    """Arrays whose names begin with a prefix, without it."""
    return {
        key.removeprefix(prefix): values
        for key, values in arrays.items()
        if key.startswith(prefix) and key not in COLUMNS
    }


def _plan_on_map(
    scene: SeparationScene, accuracy: Accuracy, maps: Arrays, cells: Arrays
) -> DeformingPlan:
    """Plan with the cells of a file, whose maps must be those of its film."""
    if set(cells) != set(_OF_CELLS) or set(maps) != {"time", *MAPS}:
        raise ValueError(f"its maps are incomplete: {sorted(maps)}, {sorted(cells)}")
    x, y, shape = (cells[name] for name in _OF_CELLS)
    if x.ndim != 1 or y.ndim != 1 or min(x.size, y.size) < 2 or shape.shape != (y.size, x.size):
        raise ValueError(f"its cells are {shape.shape}, at {y.shape} and {x.shape} places")
    if not all(np.isfinite(values).all() for values in cells.values()):
        raise ValueError("its cells are not finite")
    made = plan_deforming(scene, accuracy, heights=(x, y, shape))
    film = made.film
    if isinstance(film, SmoothGap):
        raise ValueError("its scene is solved on rings, and has no maps")  # noqa: TRY004 of a file
    wanted = (len(maps["time"]), *film.places[2].shape)
    if any(maps[name].shape != wanted for name in MAPS):
        raise ValueError(f"its maps are no {wanted}")
    return made
