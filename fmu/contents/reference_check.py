"""Check of an FMU against the reference results inside it (FMI-LS-REF)."""

from __future__ import annotations

import math
import posixpath
from collections.abc import Iterator, Mapping
from itertools import pairwise
from pathlib import Path
from typing import TYPE_CHECKING, NamedTuple
from xml.etree.ElementTree import Element
from zipfile import ZipFile, is_zipfile

from ...errors import ContactkitError, DescriptionError
from ...extras import require
from ...reading.archives import checked_archive, member
from ...reading.xml_elements import read_xml
from ..framework.model_file import no_fmu
from .references import FOLDER, TOLERANCE_NOTE, ReferenceRun

if TYPE_CHECKING:
    from collections.abc import Sequence

__all__ = ["Deviation", "check_references", "deviations", "read_references"]

_DEFAULT = 1e-3  # tolerance of references that name none, as of other tools
_MANIFEST = f"{FOLDER}fmi-ls-manifest.xml"
_EXPERIMENTS = "application/x-ma-hs-experiments"
_SAME = 1e-6  # fraction of a step by which a time of the references may be off


class Deviation(NamedTuple):
    """Largest difference of an output from its reference, over the largest value of that."""

    experiment: str
    variable: str
    error: float
    """Relative [-]; infinite where the run ended early."""
    tolerance: float

    @property
    def is_fine(self) -> bool:
        """Whether the difference is within the tolerance."""
        return self.error <= self.tolerance


def read_references(fmu: Path) -> list[ReferenceRun]:
    """Read the experiments of an FMU that can be run with it.

    Raises
    ------
    DescriptionError
        If the file is no archive, has no reference results, or those are damaged, of a form that is
        not known, or need a file of parameters.
    """
    where = str(fmu)
    if not fmu.is_file():
        raise DescriptionError("FMU", where, "be a file that is there")
    if not is_zipfile(fmu):
        raise DescriptionError("FMU", where, "be an FMU, which is a zip archive", hint=no_fmu(fmu))
    with fmu.open("rb") as file, checked_archive(file, where) as packed:
        if _MANIFEST not in packed.namelist():
            raise DescriptionError(
                "FMU",
                where,
                f"have reference results, {_MANIFEST}",
                hint="build it with --reference",
            )
        found = [run for place in _places(packed, where) for run in _runs(packed, place, where)]
    if not found:
        raise DescriptionError("FMU", where, "have an experiment with reference results")
    return found


def check_references(fmu: Path) -> list[Deviation]:
    """Run an FMU as its experiments say, by fmpy, and compare.

    Loading an FMU runs its code.

    Raises
    ------
    DescriptionError
        See `read_references`.
    MissingExtraError
        If fmpy is not installed.
    ContactkitError
        If the FMU cannot be run here.
    """
    require("fmpy", "running an FMU")
    return [one for run in read_references(fmu) for one in deviations(run, _run(fmu, run))]


def deviations(run: ReferenceRun, found: Mapping[str, Sequence[float]]) -> list[Deviation]:
    """Differences of results from references, at the times of these.

    Parameters
    ----------
    run : ReferenceRun
        Whose references are meant.
    found : mapping of str to sequence of float
        Columns of the results, ``time`` [s] among them, by name.

    Examples
    --------
    >>> rows = {"time": [0.0, 1.0], "y": [0.0, 4.0]}
    >>> run = ReferenceRun(
    ...     name="a", description="", stop_time=1.0, step=1.0, stimuli={}, references=rows,
    ...     tolerance=1e-6,
    ... )
    >>> deviations(run, {"time": [0.0, 1.0], "y": [0.0, 5.0]})[0].error
    0.25
    """
    times = {round(time / run.step / _SAME): k for k, time in enumerate(found["time"])}
    rows = [_row(times, time / run.step / _SAME) for time in run.references["time"]]
    names = [name for name in run.references if name != "time"]
    return [
        Deviation(run.name, name, _error(found[name], run.references[name], rows), run.tolerance)
        for name in names
    ]


def _row(times: Mapping[int, int], time: float) -> int | None:
    """Row of a time, whose unit is the smallest difference of two; None if there is none."""
    near = round(time)
    return next((times[k] for k in (near, near - 1, near + 1) if k in times), None)


def _error(found: Sequence[float], known: Sequence[float], rows: Sequence[int | None]) -> float:
    if None in rows:
        return math.inf
    size = max(map(abs, known), default=0.0)
    off = [
        abs(found[row] - value) for row, value in zip(rows, known, strict=True) if row is not None
    ]
    if not all(map(math.isfinite, off)):
        return math.inf
    return max(off, default=0.0) / size if size else max(off, default=0.0)


def _run(fmu: Path, run: ReferenceRun) -> Mapping[str, Sequence[float]]:
    import numpy as np
    from fmpy import simulate_fmu

    names = [name for name in run.references if name != "time"]
    stimuli = None
    if run.stimuli:
        kinds = [(name, np.float64) for name in run.stimuli]
        stimuli = np.array(list(zip(*run.stimuli.values(), strict=True)), dtype=kinds)
    try:
        result = simulate_fmu(
            str(fmu),
            input=stimuli,
            output=names,
            start_time=0.0,
            stop_time=run.stop_time,
            output_interval=run.step,
            fmi_type="CoSimulation",
        )
    except Exception as error:  # fmpy raises no narrower one
        raise ContactkitError(
            f"{fmu} cannot be run here: {error}; build it on this computer"
        ) from error
    return {name: result[name].tolist() for name in ("time", *names)}


# Reading ------------------------------------------------------------------------------------


def _places(packed: ZipFile, where: str) -> Iterator[str]:
    """Paths of the files of experiments that the manifest lists."""
    root = read_xml(member(packed, _MANIFEST, "TEXT_BYTES", where), f"{where}, {_MANIFEST}")
    for node in root.iterfind("Related"):
        if node.get("type") == _EXPERIMENTS and node.get("role", "").startswith("experiment"):
            yield _path(FOLDER, node.get("source", ""), where)


def _path(folder: str, source: str, where: str) -> str:
    """Path in the archive of what a file in a folder refers to."""
    path = posixpath.normpath(posixpath.join(folder, source))
    if not source or ":" in source or path.startswith(("..", "/")):
        raise DescriptionError(f"{where}, source", source[:80], "be a path inside the FMU")
    return path


def _runs(packed: ZipFile, place: str, where: str) -> Iterator[ReferenceRun]:
    """Experiments of a file that have references."""
    folder = posixpath.dirname(place)
    root = read_xml(member(packed, place, "TEXT_BYTES", where), f"{where}, {place}")
    for node in root.iterfind("Experiment"):
        known = node.find("References")
        if known is None:
            continue
        if node.find("Parameters") is not None:
            raise DescriptionError(
                f"{where}, experiment", node.get("name", ""), "need no file of parameters"
            )
        stimuli = node.find("Stimuli")
        yield ReferenceRun(
            name=node.get("name", ""),
            description=node.get("description", ""),
            **_times(node, where),
            stimuli={} if stimuli is None else _table(packed, folder, stimuli, where),
            references=_table(packed, folder, known, where),
            tolerance=_tolerance(node, where),
        )


def _times(node: Element, where: str) -> dict[str, float]:
    """End and step of an experiment that begins at 0; earlier drafts have them in the element."""
    times = node.find("TransientSimulation")
    times = node if times is None else times
    begin = _number(times.get("startTime", "0"), "startTime", where)
    end = _number(times.get("stopTime", ""), "stopTime", where)
    step = _number(times.get("stepSize", ""), "stepSize", where)
    if begin != 0.0 or not 0.0 < step <= end:
        given = (begin, end, step)
        raise DescriptionError(
            f"{where}, start, stop and step", given, "be 0 and 0 < step <= stop", unit="s"
        )
    return {"stop_time": end, "step": step}


def _tolerance(node: Element, where: str) -> float:
    for note in node.iterfind("Annotations/Annotation"):
        if note.get("type") == TOLERANCE_NOTE:
            return _number(note.text or "", "tolerance", where)
    return _DEFAULT


def _table(packed: ZipFile, folder: str, node: Element, where: str) -> dict[str, list[float]]:
    """Columns of a CSV file, with one of times that rise."""
    if node.get("type", "text/csv") != "text/csv":
        raise DescriptionError(f"{where}, type", node.get("type", "")[:80], "be text/csv")
    path = _path(folder, node.get("source", ""), where)
    content = member(packed, path, "TEXT_BYTES", where)
    name = f"{where}, {path}"
    try:
        lines = [line for line in content.decode().splitlines() if line.strip()]
    except UnicodeDecodeError:
        raise DescriptionError("file", name, "be a text in UTF-8") from None
    if not lines:
        raise DescriptionError("file", name, "have a row of names")
    names = [word.strip().strip('"') for word in lines[0].split(",")]
    rows = [[_number(word, "cell", name) for word in line.split(",")] for line in lines[1:]]
    if names[0] != "time" or len(set(names)) != len(names) or not rows:
        raise DescriptionError("file", name, "have columns of different names, time the first")
    if any(len(row) != len(names) for row in rows):
        raise DescriptionError("file", name, f"have {len(names)} numbers in each row")
    columns = dict(zip(names, map(list, zip(*rows, strict=True)), strict=True))
    times = columns["time"]
    if any(not a < b for a, b in pairwise(times)):
        raise DescriptionError("file", name, "have times that rise")
    return columns


def _number(text: str, what: str, where: str) -> float:
    try:
        found = float(text)
    except ValueError:
        found = math.nan
    if not math.isfinite(found):
        raise DescriptionError(f"{where}, {what}", text[:80], "be a finite number")
    return found
