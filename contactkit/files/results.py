"""Result files: npz with a JSON header, and CSV, written completely or not at all."""

from __future__ import annotations

import io
import json
from collections.abc import Callable, Mapping
from numbers import Real
from pathlib import Path
from typing import IO, TYPE_CHECKING, Any, TypeVar, overload

import attrs
import numpy as np

from ..accuracy import Accuracy
from ..contact.result import ContactResult
from ..errors import ContactkitError, DescriptionError
from ..reading.archives import UNREADABLE
from ..reading.arrays import read_arrays
from ..reading.texts import from_json
from ..scene.result import Result
from ..scene.scenes import SeparationScene, SlidingScene
from ..separation.curve_result import Work
from ..separation.deforming.result import DeformingResult
from ..separation.motion.state import MotionState, restored_state
from ..separation.plan import Plan, plan
from ..separation.results import SeparationResult, extremes_of, pulls_of_cycles
from ..separation.sliding.plan import plan_sliding
from ..separation.sliding.result import SlidingResult
from ..separation.sliding.run import check_sliding
from ..separation.validity import check
from ..validity import ValidityNumber
from .contact_results import pack_contact, unpack_contact
from .csv_rows import csv_line
from .deforming_results import pack_deforming, unpack_deforming
from .scenes import structure, unstructure, write_whole
from .structure import renamed

if TYPE_CHECKING:
    from numpy.typing import NDArray

    Arrays = dict[str, NDArray[Any]]

AnyResult = SeparationResult | DeformingResult | SlidingResult | ContactResult
R = TypeVar("R", bound=Result)
T = TypeVar("T")

__all__ = [
    "AnyResult",
    "from_bytes",
    "load_result",
    "read_npz",
    "read_state",
    "save_csv",
    "save_npz",
    "save_result",
    "to_bytes",
]


def save_npz(path: str | Path, columns: Mapping[str, Any], header: Mapping[str, Any]) -> Path:
    """Write columns to an npz file, with a header as JSON; no pickle."""
    path = Path(path).with_suffix(".npz")
    with write_whole(path) as temporary:
        np.savez_compressed(temporary, header=np.array(json.dumps(header)), **columns)
    return path


def read_npz(path: str | Path, what: str, unpacked: Callable[[Any, Arrays, str], T]) -> T:
    """Read what `save_npz` has written: `unpacked` takes header, columns and name of the file.

    Raises
    ------
    DescriptionError
        If the file is no `what`: it is cut short, exceeds a limit of `contactkit.reading`, or
        `unpacked` refuses it by an error of Python.
    """
    try:
        # Opened here, as numpy does not close a file that it cannot read.
        with Path(path).open("rb") as file:
            return unpacked(*_parts(file, Path(path).name), Path(path).name)
    except UNREADABLE as error:
        hint = error if isinstance(error, ContactkitError) else f"{type(error).__name__}: {error}"
        raise DescriptionError(
            "file", str(path), f"be a {what} of contactkit", hint=str(hint)[:500]
        ) from None


def _parts(source: IO[bytes], name: str) -> tuple[Any, Arrays]:
    """Header and columns of a file."""
    columns = read_arrays(source, name)
    return from_json(str(columns.pop("header")), f"{name}, header"), columns


def save_result(result: Result, path: str | Path) -> Path:
    """Write a result to an npz file without pickle, whole or not at all.

    Parameters
    ----------
    result : SeparationResult, DeformingResult, SlidingResult or ContactResult
        The result: its curves or maps as arrays, the arrays that its scene and its effects
        hold, and as ``header`` a JSON text with the scene, the accuracy, the status and the
        numbers.
    path : str or Path
        The file; its suffix becomes ``.npz``.

    Returns
    -------
    Path
        The file that was written; `load_result` reads it.
    """
    header, columns = _pack(result)
    return save_npz(path, columns, header)


@overload
def load_result(path: str | Path) -> AnyResult: ...


@overload
def load_result(path: str | Path, kind: type[R]) -> R: ...


def load_result(path: str | Path, kind: type[Result] = Result) -> Result:
    """Read a result written by `save_result`.

    A `ContactResult` answers ``of`` and ``scalars`` as the one that was saved did. What it was
    made from, such as the file of a measured surface, need not be there.

    Parameters
    ----------
    path : str or Path
        The file.
    kind : type, optional
        Kind of result that is wanted, such as ``ContactResult``; others are refused, and a type
        checker knows what is returned.

    Raises
    ------
    DescriptionError
        If the file is none of ours, is cut short, exceeds a limit of `contactkit.reading`, or
        holds another kind.
    """
    result = _load(path)
    if not isinstance(result, kind):
        raise DescriptionError(
            "file", str(path), f"hold a {kind.__name__}", hint=f"it is a {type(result).__name__}"
        )
    return result


def _load(path: str | Path) -> AnyResult:
    try:
        # Opened here, as numpy does not close a file that it cannot read.
        with Path(path).open("rb") as file:
            return _read(file, Path(path).name)
    except UNREADABLE as error:
        raise _no_result(str(path), error) from None


def to_bytes(result: Result) -> bytes:
    """Return a result as `save_result` would write it, to send or to store."""
    header, columns = _pack(result)
    buffer = io.BytesIO()
    np.savez_compressed(buffer, header=np.array(json.dumps(header)), **columns)
    return buffer.getvalue()


def from_bytes(data: bytes) -> AnyResult:
    """Read a result from the bytes of `to_bytes`."""
    try:
        return _read(io.BytesIO(data), "result")
    except UNREADABLE as error:
        raise _no_result("result", error) from None


def _pack(result: Result) -> tuple[dict[str, Any], Mapping[str, Any]]:
    from .._version import __version__

    if isinstance(result, ContactResult):
        header, columns = pack_contact(result)
    elif isinstance(result, SlidingResult):
        header, columns = _pack_sliding(result), dict(result.columns)
    elif isinstance(result, DeformingResult):
        header, columns = pack_deforming(result)
    elif isinstance(result, SeparationResult):
        header, columns = _pack_separation(result), dict(result.columns)
    else:
        raise TypeError(f"a {type(result).__name__} has no place in a result file")
    return {"contactkit": __version__} | header, columns


def _no_result(where: str, error: Exception) -> ContactkitError:
    if isinstance(error, ContactkitError):
        return error  # a result whose content this version refuses
    return DescriptionError(
        "file", where, "be a result of contactkit", hint=f"{type(error).__name__}: {error}"[:500]
    )


def _read(source: IO[bytes], name: str) -> AnyResult:
    try:
        header, columns = _parts(source, name)
    except DescriptionError as error:
        raise DescriptionError("file", name, "be a result of contactkit", hint=str(error)) from None
    result = _unpacked(header, columns, name)
    numbers: Mapping[str, tuple[Any, str]] = result.scalars()
    for key, (value, _) in numbers.items():
        if not isinstance(value, Real):
            raise TypeError(f"{key} is a {type(value).__name__} and no number")
    if not (isinstance(header["status"], str) and isinstance(header["message"], str)):
        raise TypeError("status and message are no texts")
    work = header["work"]
    if not all(isinstance(value, Real) for name, value in work.items() if name != "stages"):
        raise TypeError(f"its work is no count: {work}")
    return result


def _unpacked(header: dict[str, Any], columns: Arrays, name: str) -> AnyResult:
    """Result of the kind that its header names."""
    if header.get("kind") == "contact":
        return unpack_contact(header, columns, name)
    if header.get("kind") == "deforming":
        return unpack_deforming(header, columns, name)
    if header.get("kind") == "curve":
        raise ValueError("it is a curve, which read_curve reads")
    if header.get("kind") == "sliding":
        return _unpack_sliding(header, columns, name)
    return _unpack_separation(header, columns, name)


def _check_columns(columns: Arrays, known: Mapping[str, Any]) -> None:
    """Refuse columns that are no curves of the plan, of one length."""
    lengths = {column.shape for column in columns.values()}
    kinds = {column.dtype.kind for column in columns.values()}
    unknown = sorted(columns.keys() - known.keys())
    if unknown or len(lengths) != 1 or len(*lengths) != 1 or not kinds <= set("biuf"):
        raise ValueError(f"its columns are no curves: {unknown or sorted(lengths)}")


def _pack_separation(result: SeparationResult) -> dict[str, Any]:
    return {
        "kind": "separation",
        "scene": unstructure(result.plan.scene),
        "accuracy": result.plan.accuracy.saved(),
        "status": result.status,
        "message": result.message,
        "impulses": dict(result.impulses),
        "state": result.state._asdict() if result.has_motion else None,
        "work": result.work._asdict(),
        "extremes": dict(result.extremes),
        "validity": [number.value for number in result.validity],
        "errata": [one._asdict() for one in result.errata],
    }


def read_state(state: Mapping[str, Any]) -> MotionState:
    """Return the state at the end of a motion, as a result file has it."""
    for key in sorted(state.keys() - set(MotionState._fields)):
        hint = renamed(key) or "solve its scene again"
        raise DescriptionError(f"state.{key}", state[key], "be left out: it is no field", hint=hint)
    return restored_state(state)


def _unpack_separation(header: dict[str, Any], columns: Arrays, name: str) -> SeparationResult:
    scene = structure(header["scene"], SeparationScene, name)
    made = plan(scene, Accuracy.of_file(header["accuracy"]))
    state = header["state"]
    _check_columns(columns, made.columns)
    extremes = header.get("extremes")
    if extremes is None:  # a file of before version 0.2
        extremes = extremes_of(made, columns)
        if state is not None:
            extremes = {n: v for n, v in extremes.items() if n == "peak_repulsion"}
        if "pull_impulse" in header["impulses"]:
            time, pull = float(columns["time"][-1]), columns["pull"]
            extremes |= pulls_of_cycles(header["impulses"], time, pull)
    return SeparationResult(
        made,
        header["status"],
        header["message"],
        columns,
        header["impulses"],
        read_state(state) if state is not None else None,
        _checked(made, columns, header.get("validity")),
        Work(**header["work"]),
        extremes,
    )


def _checked(
    made: Plan, columns: Arrays, values: list[float | None] | None
) -> tuple[ValidityNumber, ...]:
    """Return ranges of validity with the values of the run; those of its curves in an old file."""
    found = check(made, columns)
    if values is None:
        return found
    if not all(value is None or isinstance(value, Real) for value in values):
        raise TypeError(f"its ranges of validity are no numbers: {values}")
    pairs = zip(found, values, strict=True)
    return tuple(attrs.evolve(number, value=value) for number, value in pairs)


def _pack_sliding(result: SlidingResult) -> dict[str, Any]:
    return {
        "kind": "sliding",
        "scene": unstructure(result.plan.scene),
        "accuracy": result.plan.accuracy.saved(),
        "status": result.status,
        "message": result.message,
        "totals": dict(result.totals),
        "work": result.work._asdict(),
        "errata": [one._asdict() for one in result.errata],
    }


def _unpack_sliding(header: dict[str, Any], columns: Arrays, name: str) -> SlidingResult:
    scene = structure(header["scene"], SlidingScene, name)
    made = plan_sliding(scene, Accuracy.of_file(header["accuracy"]))
    _check_columns(columns, made.columns)
    outcome = (header["status"], header["message"])
    work = Work(**header["work"])
    return SlidingResult(made, *outcome, columns, header["totals"], check_sliding(made), work)


def save_csv(path: str | Path, columns: Mapping[str, Any], headings: Mapping[str, str]) -> Path:
    """Write columns as a CSV file with a heading of name and unit for each."""
    path = Path(path).with_suffix(".csv")
    header = csv_line(headings[name] for name in columns)
    table = np.column_stack([np.asarray(column, dtype=float) for column in columns.values()])
    with write_whole(path) as temporary:
        np.savetxt(temporary, table, delimiter=",", header=header, comments="", fmt="%.10g")
    return path
