"""Studies of many points, written to a file as they are solved: `stream_study`."""

from __future__ import annotations

import itertools
import math
import warnings
from collections.abc import Callable, Iterator
from contextlib import suppress
from pathlib import Path
from typing import Any

from attrs import evolve

from ..accuracy import Accuracy
from ..contact.chain import downwards
from ..errors import ContactkitError, ValidityWarning
from ..scene.scenes import ContactScene, SeparationScene, SlidingScene
from .paths import Axis, Parameters, Scene, axes, changed, combinations, values_at
from .run import Done, Piece, Task
from .study import (
    RETRIES,
    check_effects,
    check_kind,
    check_whole,
    slots,
    sources_of,
    spread,
    varies_effects,
)
from .study_file import StudyFile, StudyWriter

__all__ = ["check_axes", "stream_study"]

# Points of a piece at most. They are in memory together; smaller pieces cost a dispatch each, and
# cut chains of points that are solved from the one before.
_PIECE = 256


def stream_study(
    scene: ContactScene | SeparationScene | SlidingScene,
    parameters: Parameters,
    path: str | Path,
    accuracy: Accuracy | None = None,
    *,
    workers: int = 1,
    client: Any = None,
    progress: Callable[[float], None] | None = None,
    retries: int = RETRIES,
) -> StudyFile:
    """Solve a scene for every combination of parameter values, and write each to a file.

    The points are those of `study`, by the same rules; they are made, sent and written piece by
    piece, so that the memory needed does not grow with their number. The file is a SQLite database
    with a row for each point; a study that was interrupted continues where it stopped.

    Parameters
    ----------
    scene, parameters, accuracy, workers, client, progress
        As in `study`.
    path : str or Path
        The file; its suffix becomes ``.sqlite``. An existing file must be of the same study.
    retries : int
        How often a point is solved again whose worker died, or which ended for lack of memory or
        disk; a defect is not. Points that failed are rows with their message. They stay when the
        study continues, until ``StudyFile(path).forget_failed()`` removes them.

    Returns
    -------
    StudyFile
        Columns, read from the file when they are asked for.

    Raises
    ------
    DescriptionError
        If a path does not exist or a value is invalid, before any solve; if the file is of another
        study.
    PlanError
        If the effects do not fit the scene; before any solve.

    Warns
    -----
    ValidityWarning
        Once, with the number of points outside the range of a model.

    Notes
    -----
    Complete results, with maps or curves, are not kept: `study` does that. Each value is checked
    beforehand with the first values of the other parameters; a combination that is invalid is a
    row with the status ``refused``.

    Examples
    --------
    >>> import tempfile, warnings
    >>> import contactkit as ck
    >>> oil = ck.Liquid(name="oil", viscosity=0.1, surface_tension=0.03)
    >>> face = ck.Flat(radius=1e-3)
    >>> film = ck.Meniscus(liquid=oil, volume=1e-11)
    >>> scene = ck.SeparationScene(
    ...     interface=ck.Interface(lower=face, upper=face, meniscus=film),
    ...     loading=ck.ImposedTime(time=1e-3, initial_gap=4e-6, final_gap=1e-5),
    ...     effects=(ck.ViscousForce(),),
    ... )
    >>> parameters = {"loading.initial_gap": ["4 um", "5 um"], "loading.time": ["1 ms", "2 ms"]}
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     with warnings.catch_warnings(action="ignore"):
    ...         done = ck.stream_study(scene, parameters, f"{folder}/oil.sqlite")
    ...     done, done.column("viscous_impulse").round(6).tolist()
    (StudyFile('oil.sqlite', 4 of 4 points), [0.004543, 0.004543, 0.00179, 0.00179])
    """
    check_whole("workers", workers, 1)
    check_whole("retries", retries, 0)
    accuracy = accuracy if accuracy is not None else Accuracy.standard
    varied, sources = check_axes(scene, parameters, accuracy)
    n_points = math.prod(len(axis.values) for axis in varied)
    n_slots = slots(client, workers)
    with StudyWriter(path, scene, accuracy, varied, sources) as writer:

        def report() -> None:
            if progress is not None:
                progress(min(writer.n_done, n_points) / n_points)

        size = _size(len(varied[-1].values), n_points, n_slots)
        base = Piece(scene, accuracy, (), None, False, retries)
        pieces = _pieces(base, varied, size, writer.is_done)

        def take(done: Done) -> None:
            writer.write([done])
            report()

        spread(pieces, workers, client, take)
        if not writer.n_solved and n_points:
            message = writer.first_message()
            raise ContactkitError(f"every point of the study failed: {message}")
        report()
        if (outside := writer.outside())[0]:
            n, names = outside
            text = f"{n} of {n_points} points are outside the range of a model: {names}"
            warnings.warn(text, ValidityWarning, stacklevel=2)
    return StudyFile(writer.path)


def check_axes(
    scene: Scene, parameters: Parameters, accuracy: Accuracy
) -> tuple[tuple[Axis, ...], tuple[str, ...]]:
    """Parse the parameters and check each value, with the first values of the others.

    Returns
    -------
    tuple of Axis, tuple of str
        The parameters, and the sources of the equations of all points.

    Raises
    ------
    DescriptionError, PlanError
        As `study` does.
    """
    check_kind(scene)
    varied = axes(scene, accuracy, parameters)
    first = values_at(varied, 0)
    for axis in varied:
        for row in axis.values:
            changed(scene, accuracy, first | dict(zip(axis.paths, row, strict=True)))
    check_effects(*changed(scene, accuracy, first))
    chosen = combinations([axis for axis in varied if varies_effects([axis])])
    points = (changed(scene, accuracy, first | values) for values in chosen)
    return varied, sources_of(points, {})


def _size(length: int, n_points: int, n_slots: int) -> int:
    """Points of a piece: whole chains of a length where they are short, enough for all slots."""
    most = max(1, min(_PIECE, math.ceil(n_points / (8 * n_slots))))
    return most if length > most else most // length * length


def _pieces(
    base: Piece, varied: tuple[Axis, ...], size: int, is_done: Callable[[int], bool]
) -> Iterator[Piece]:
    """Pieces of the points that are not done, made when they are asked for."""
    n_points, length = math.prod(len(axis.values) for axis in varied), len(varied[-1].values)
    for start in range(0, n_points, size):
        places = range(start, min(start + size, n_points))
        tasks = [Task(i, values_at(varied, i), "") for i in places if not is_done(i)]
        if isinstance(base.scene, ContactScene):
            chains = itertools.groupby(tasks, lambda task: task.place // length)
            tasks = [task for _, chain in chains for task in _ordered(base, list(chain))]
        if tasks:
            yield evolve(base, tasks=tuple(tasks))


def _ordered(base: Piece, chain: list[Task]) -> list[Task]:
    """Loads of a contact downwards; as they are where one is refused, which its row will state."""
    with suppress(ContactkitError):
        scenes = [changed(base.scene, base.accuracy, task.values).scene for task in chain]
        loads = [one.loading.quantity.value for one in scenes if isinstance(one, ContactScene)]
        return [chain[i] for i in downwards(loads, scenes[0])]
    return chain
