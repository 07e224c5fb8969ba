"""Result files: npz with a JSON header, and CSV. Never half a file."""

from __future__ import annotations

import json
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import attrs
import numpy as np

from .accuracy import Accuracy
from .errors import DescriptionError
from .io import structure, unstructure, write_whole
from .motion_state import MotionState
from .plan import plan
from .results import SeparationResult, Work
from .scene import SeparationScene
from .validity import check

__all__ = ["load_result", "save_csv", "save_npz", "save_result"]


def save_npz(path: str | Path, columns: Mapping[str, Any], header: Mapping[str, Any]) -> Path:
    """Write columns to an npz file, with a header as JSON; no pickle."""
    path = Path(path).with_suffix(".npz")
    with write_whole(path) as temporary:
        np.savez_compressed(temporary, header=np.array(json.dumps(header)), **columns)
    return path


def save_result(result: SeparationResult, path: str | Path) -> Path:
    """Write a result to an npz file: its curves, and a JSON header that says what they are."""
    from . import __version__

    header = {
        "contactkit": __version__,
        "scene": unstructure(result.plan.scene),
        "accuracy": attrs.asdict(result.plan.accuracy),
        "status": result.status,
        "message": result.message,
        "impulses": dict(result.impulses),
        "state": list(result.state) if result.state is not None else None,
        "work": result.work._asdict(),
    }
    return save_npz(path, result.columns, header)


def load_result(path: str | Path) -> SeparationResult:
    """Read a result written by `save_result`."""
    try:
        with np.load(Path(path), allow_pickle=False) as file:
            header = json.loads(str(file["header"]))
            columns = {name: file[name] for name in file.files if name != "header"}
    except (OSError, ValueError, KeyError) as error:
        raise DescriptionError(
            "file", str(path), "be a result of contactkit", hint=str(error)
        ) from None
    scene = structure(header["scene"], SeparationScene, Path(path).name)
    made = plan(scene, Accuracy(**header["accuracy"]))
    for column in columns.values():
        column.flags.writeable = False
    state = header["state"]
    speeds = columns.get("speed", np.zeros_like(columns["gap"]))
    path_taken = [
        (float(h), float(v)) for h, v in zip(columns["gap"], speeds, strict=True) if h > 0.0
    ]
    return SeparationResult(
        made,
        header["status"],
        header["message"],
        columns,
        header["impulses"],
        MotionState(*state) if state is not None else None,
        check(made, path_taken),
        Work(**header["work"]),
    )


def save_csv(path: str | Path, columns: Mapping[str, Any], headings: Mapping[str, str]) -> Path:
    """Write columns as a CSV file with a heading of name and unit for each."""
    path = Path(path).with_suffix(".csv")
    header = ",".join(headings[name] for name in columns)
    table = np.column_stack([np.asarray(column, dtype=float) for column in columns.values()])
    with write_whole(path) as temporary:
        np.savetxt(temporary, table, delimiter=",", header=header, comments="", fmt="%.10g")
    return path
