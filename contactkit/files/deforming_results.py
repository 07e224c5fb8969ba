"""Results of deforming bodies in files: curves, sections, and a header."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

import attrs

from ..accuracy import Accuracy
from ..frozen import FrozenDict
from ..scene.scenes import SeparationScene
from ..separation.curve_result import Work
from ..separation.deforming.plan import COLUMNS, plan_deforming
from ..separation.deforming.result import SECTIONS, DeformingResult
from ..validity import ValidityNumber
from .scenes import structure, unstructure

if TYPE_CHECKING:
    from numpy.typing import NDArray

    Arrays = dict[str, NDArray[Any]]

__all__ = ["pack_deforming", "unpack_deforming"]

_PREFIX = "section_"  # of the names of the sections among the arrays of a file


def pack_deforming(result: DeformingResult) -> tuple[dict[str, Any], Arrays]:
    """Header and arrays of a result."""
    header = {
        "kind": "deforming",
        "scene": unstructure(result.plan.scene),
        "accuracy": result.plan.accuracy.saved(),
        "status": result.status,
        "message": result.message,
        "numbers": dict(result.numbers),
        "validity": [attrs.asdict(number) for number in result.validity],
        "work": result.work._asdict(),
    }
    sections = {f"{_PREFIX}{name}": values for name, values in result.sections.items()}
    return header, {**result.columns, **sections}


def unpack_deforming(header: Mapping[str, Any], arrays: Arrays, name: str) -> DeformingResult:
    """Result of a header and arrays, checked against the plan of its scene."""
    scene = structure(header["scene"], SeparationScene, name)
    made = plan_deforming(scene, Accuracy.of_file(header["accuracy"]))
    columns = {key: values for key, values in arrays.items() if key in COLUMNS}
    sections = {key: arrays[f"{_PREFIX}{key}"] for key in SECTIONS}
    points = columns["time"].shape
    if len(arrays) != len(COLUMNS) + len(SECTIONS) or len(columns) != len(COLUMNS):
        raise ValueError(f"its arrays are no curves and sections: {sorted(arrays)}")
    shapes = {values.shape for values in sections.values()}
    if len(points) != 1 or {values.shape for values in columns.values()} != {points}:
        raise ValueError("its curves differ in their lengths")
    if len(shapes) != 1 or len(*shapes) != 2 or next(iter(shapes))[0] != points[0]:
        raise ValueError("its sections have not one row for each point of the curves")
    if any(values.dtype.kind != "f" for values in arrays.values()):
        raise ValueError("its arrays hold no real numbers")
    return DeformingResult(
        made,
        header["status"],
        header["message"],
        FrozenDict(columns),
        FrozenDict(sections),
        FrozenDict({key: float(value) for key, value in header["numbers"].items()}),
        tuple(ValidityNumber(**one) for one in header["validity"]),
        Work(**header["work"]),
    )
