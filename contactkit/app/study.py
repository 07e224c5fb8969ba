"""Running the study of a scene file: a table, files with all columns, and a figure."""

from __future__ import annotations

import math
import warnings
from collections.abc import Callable, Mapping
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple

from ..accuracy import Accuracy
from ..errors import PlanError, ValidityWarning
from ..export.report import Report
from ..scene.scenes import Scene
from ..studies.bands import is_seed

if TYPE_CHECKING:
    from ..studies.table import Study

__all__ = [
    "StudyOptions",
    "draw_study",
    "made_study",
    "run_study",
    "study_lines",
    "study_text",
    "write_study",
]

Parameters = Mapping[str, list[Any]]
Progress = Callable[[float], None]


class StudyOptions(NamedTuple):
    """Options of a study.

    `workers` are processes, `store` is a folder of finished points, `dimensionless` asks for units
    of the reference scales, `stream` is a file that points are written to as they are solved, and
    `trials` a number of points to estimate the study from, which is not run then.
    """

    workers: int = 1
    store: Path | None = None
    dimensionless: bool = False
    stream: Path | None = None
    trials: int = 0


_PLAIN = StudyOptions()


def run_study(
    scene: Scene,
    accuracy: Accuracy,
    parameters: Parameters,
    out: Path | None,
    progress: Progress,
    options: StudyOptions,
) -> Report:
    """Run the study of a scene file, and write its columns and figure to a folder."""
    if not parameters:
        raise PlanError(
            "the scene file has no study: add a table such as [study] "
            '"loading.speed" = ["1 um/s", "10 um/s"]'
        )
    if options.trials:
        return _estimated(scene, accuracy, parameters, options)
    if options.stream is not None:
        return _streamed(scene, accuracy, parameters, progress, options.stream, options.workers)
    made = made_study(scene, accuracy, parameters, progress, options)
    text = "\n".join([*study_text(made), *(_definitions(made) if options.dimensionless else [])])
    if out is None:
        return Report(_columns(made), text)
    return Report(
        _columns(made), text, partial(write_study, made, out), partial(_drawn, made, scene, out)
    )


def _drawn(made: Study[Any], scene: Scene, out: Path) -> list[Path]:
    return [draw_study(made, scene.name, out)]


def _estimated(
    scene: Scene, accuracy: Accuracy, parameters: Parameters, options: StudyOptions
) -> Report:
    """Estimate time, memory and disk of a study from a few of its points."""
    from ..studies.estimate import plan_study

    kind: Any = scene
    found = plan_study(kind, parameters, accuracy, trials=options.trials, workers=options.workers)
    numbers: dict[str, tuple[Any, str]] = {
        "n_points": (found.n_points, "-"),
        "cpu_time": (found.total_seconds, "s"),
        "memory": (found.memory, "bytes"),
        "disk": (found.disk, "bytes"),
    }
    return Report(numbers, str(found))


def _streamed(
    scene: Scene,
    accuracy: Accuracy,
    parameters: Parameters,
    progress: Progress,
    path: Path,
    workers: int,
) -> Report:
    """Write the points of a study to a file as they are solved."""
    from ..studies.stream import stream_study

    kind: Any = scene
    made = stream_study(kind, parameters, path, accuracy, workers=workers, progress=progress)
    failed = sum(1 for _ in made.failed())
    text = f"{made.path}: {made.n_done} points, {failed} of them without a solution"
    numbers: dict[str, tuple[Any, str]] = {
        "n_points": (made.n_done, "-"),
        "n_failed": (failed, "-"),
    }
    return Report(numbers, text, partial(tuple, [made.path]))


def made_study(
    scene: Scene,
    accuracy: Accuracy,
    parameters: Parameters,
    progress: Progress,
    options: StudyOptions = _PLAIN,
) -> Study[Any]:
    """Run a study; what is refused is refused before any solve."""
    from ..studies.study import study

    kind: Any = scene
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", ValidityWarning)  # the report prints every number
        made: Study[Any] = study(
            kind,
            parameters,
            accuracy,
            progress=progress,
            workers=options.workers,
            store=options.store,
        )
    return made.dimensionless() if options.dimensionless else made


def study_lines(scene: Scene, accuracy: Accuracy, parameters: Parameters) -> list[str]:
    """Check the study of a file, and say what it varies; nothing without one."""
    from ..studies.study import check_study

    if not parameters:
        return []
    kind: Any = scene
    varied = check_study(kind, parameters, accuracy)
    n = [f"  {', '.join(axis.paths)}: {len(axis.values)} values" for axis in varied]
    return ["study, the last path fastest:", *n]


def study_text(made: Study[Any]) -> list[str]:
    """Table of a study: the numbers that change; medians where a seed varies."""
    shown = _shown(made)
    return [f"study{_runs(made)}:", shown.table(*shown.telling())]


def _definitions(made: Study[Any]) -> list[str]:
    """Definitions of the scales that the columns are in units of."""
    scales = {one.name: one.definition for one in made.scales.values()}
    return ["", "in units of", *(f"  {name}: {text}" for name, text in scales.items())]


def _runs(made: Study[Any]) -> str:
    n = math.prod(n for n, paths in zip(made.shape, made.paths, strict=True) if is_seed(paths))
    return f", medians of {n} seeds" if _has_seeds(made) else ""


def _has_seeds(made: Study[Any]) -> bool:
    return any(map(is_seed, made.paths))


def _shown(made: Study[Any]) -> Study[Any]:
    """The study, banded where a seed varies."""
    return made.bands() if _has_seeds(made) else made


def write_study(made: Study[Any], out: Path) -> tuple[Path, ...]:
    """Write all columns as CSV and npz, and those of the bands where a seed varies."""
    known = {"study": made} | ({"study-bands": made.bands()} if _has_seeds(made) else {})
    return tuple(
        file
        for name, one in known.items()
        for file in (one.save_csv(out / name), one.save(out / name))
    )


def _columns(made: Study[Any]) -> dict[str, tuple[Any, str]]:
    """Columns as lists, None for what is no number, for JSON."""
    found: dict[str, tuple[Any, str]] = {}
    shown = _shown(made)
    for name, unit in shown.units.items():
        column = shown.column(name)
        values = column.tolist()
        numbers = [v if isinstance(v, float) and math.isfinite(v) else None for v in values]
        found[name] = (list(map(str, values)) if column.dtype == object else numbers, unit)
    return found


def draw_study(made: Study[Any], title: str, out: Path) -> Path:
    """Draw the numbers that change over a parameter, a line for each combination of the others."""
    from ..plot import style
    from ..plot.study import overview

    head = f"{title}: study{_runs(made)}".removeprefix(": ")
    return style.save(overview(_shown(made), head), out / "study")
