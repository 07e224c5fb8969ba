"""Works to cite for a scene, a result file or an output folder."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import Any

from ..citing.citations import Citations, citations_of
from ..citing.cite import cite
from ..citing.stated import data_sources
from ..errors import DescriptionError
from ..files.curves import read_curve
from ..files.results import load_result
from ..fitting.fit_file import read_fit
from .output import read_record
from .scenes import OpenedScene, open_scene
from .settings import with_settings

__all__ = ["cited"]

_RESULT = ".npz"


def cited(what: str, settings: Sequence[str] = ()) -> Citations:
    """Return the works to cite for a scene file or a scene by name, a result, or a folder of one.

    Raises
    ------
    DescriptionError
        If it is none, or values are set over those of a result.
    """
    path = Path(what)
    if path.is_dir() or path.suffix == _RESULT:
        if settings:
            hint = "set values of a scene file"
            raise DescriptionError("--set", list(settings), "be left out for a result", hint=hint)
        return _of_folder(path) if path.is_dir() else cite(_saved(path))
    opened = with_settings(open_scene(what), settings)
    if isinstance(opened, OpenedScene):
        from ..planning import plan

        return cite(plan(opened.scene, opened.accuracy))  # type: ignore[call-overload]
    return citations_of([*_sources(opened.plan_text()), *data_sources(opened.scene)])


def _sources(plan_text: str) -> list[str]:
    """Sources at the end of the plan of a scene or a device, as it is printed."""
    return [line.strip() for line in plan_text.partition("\nsources:\n")[2].splitlines()]


def _saved(path: Path) -> Any:
    """A result, a curve, a study or a fit, by whichever reader takes the file."""
    problem: DescriptionError | None = None
    for read in (load_result, read_curve, read_fit):
        try:
            return read(path)
        except DescriptionError as error:
            problem = problem or error
    raise DescriptionError(
        "result",
        str(path),
        "be a saved result, curve, study or fit",
        hint="" if problem is None else str(problem),
    )


def _of_folder(folder: Path) -> Citations:
    """Works of all that a folder of run, study or cost holds."""
    saved = folder / "result.npz"
    if saved.is_file():
        return cite(load_result(saved))
    record = read_record(folder)
    texts = [] if record is None else [s for p in record.printed.values() for s in _sources(p.plan)]
    if not texts:
        raise DescriptionError(
            "result", str(folder), "be a folder that contactkit run or study wrote to"
        )
    return citations_of(texts)
