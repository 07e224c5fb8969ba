"""Running a scene of any kind: its plan and result in words, files of numbers, figures."""

from __future__ import annotations

import warnings
from collections.abc import Callable, Iterator, Mapping
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Any, cast

from ..accuracy import Accuracy
from ..errors import ValidityWarning
from ..export.report import Report
from ..planning import plan, run
from ..scene.result import Result
from ..scene.scenes import Scene
from .study import draw_study, made_study, study_lines, study_text, write_study

if TYPE_CHECKING:
    from ..studies.table import Study

__all__ = ["cost_text", "draw_result", "run_scene"]

Progress = Callable[[float], None]


def run_scene(
    scene: Scene,
    accuracy: Accuracy,
    parameters: Mapping[str, list[Any]],
    out: Path | None,
    progress: Progress,
) -> Report:
    """Run a scene and the study of its file; write curves, maps and figures to a folder."""
    study_lines(scene, accuracy, parameters)  # refused before the run
    made = plan(scene, accuracy)  # type: ignore[call-overload]
    fraction = 0.5 if parameters else 1.0
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", ValidityWarning)  # the report prints every number
        result = run(made, lambda done: progress(fraction * done))
    progress(fraction)
    study = None
    if parameters:
        study = made_study(scene, accuracy, parameters, lambda done: progress(0.5 + 0.5 * done))
    scalars: dict[str, tuple[Any, str]] = {"status": (result.status, "-"), **result.scalars()}
    text = "\n".join([*_lines(result), *(["", *study_text(study)] if study else [])])
    if out is None:
        return Report(scalars, text)
    return Report(
        scalars, text, partial(_write, result, study, out), partial(_draw, result, study, out)
    )


def _lines(result: Result) -> Iterator[str]:
    """Plan and result in words: numbers, validity, errata, remarks, cost."""
    yield str(result.plan)
    yield str(result)
    yield "validity:"
    yield from (f"  {number}" for number in result.validity)
    if result.errata:
        yield "errata of what is taken as printed:"
        yield from (f"  {line}" for one in result.errata for line in str(one).splitlines())
    yield from result.notes
    yield cost_text(result)


def cost_text(result: Result) -> str:
    """Counts and seconds of a run in a line."""
    work = result.work._asdict()
    counts = [f"{n} {_spoken(name)}" for name, n in work.items() if name.startswith("n_")]
    return ", ".join([*counts, f"{work['seconds']:.3f} s wall time"])


def _spoken(name: str) -> str:
    return name.removeprefix("n_").replace("_", " ")


def _write(result: Result, study: Study[Any] | None, out: Path) -> tuple[Path, ...]:
    """Write the result, curves as a table too, and the columns of the study."""
    from ..files.results import AnyResult, save_csv, save_result

    is_known = isinstance(result, AnyResult)  # one of a kind of one's own has no file to go to
    files = [save_result(result, out / "result")] if is_known else []
    curves = {name: values for name, values in result.columns.items() if values.ndim == 1}
    if curves:
        headings = {name: f"{name} [{result.unit(name)}]" for name in curves}
        files.append(save_csv(out / "result", curves, headings))
    return (*files, *(write_study(study, out) if study is not None else ()))


def _draw(result: Result, study: Study[Any] | None, out: Path) -> list[Path]:
    files = draw_result(result, out)
    if study is not None:
        return [*files, draw_study(study, result.plan.scene.name, out)]
    return files


def draw_result(result: Result, out: Path) -> list[Path]:
    """Draw every figure that a result and its plan offer, each to a file of its name."""
    from ..plot import style
    from ..plot.accessors.base import pictures

    title, files = result.plan.scene.name, list[Path]()
    drawn = pictures(result.plan) | pictures(result)
    for name, draw in drawn.items():
        ax = draw()
        if title and not ax.get_title(loc="left"):
            style.title(ax, title)
        files.append(style.save(cast(Any, ax.figure), out / name.replace("_", "-")))
    return files
