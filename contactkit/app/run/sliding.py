"""Running a sliding scene from the command line: its report, files and figure."""

from __future__ import annotations

import warnings
from collections.abc import Callable, Mapping
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Any

from ...accuracy import Accuracy
from ...errors import ValidityWarning
from ...scene.scenes import SlidingScene
from ...separation.sliding.plan import plan_sliding
from ..report import Report
from .study import Studies, draw_studies, run_studies, study_lines, study_text, write_studies

if TYPE_CHECKING:
    from ...separation.sliding.result import SlidingResult

__all__ = ["draw_sliding", "run_sliding"]

Progress = Callable[[float], None]


def run_sliding(
    scene: SlidingScene,
    accuracy: Accuracy,
    vary: Mapping[str, list[Any]],
    out: Path | None,
    progress: Progress,
) -> Report:
    """Simulate a sliding and the study of its file; write curves and figures to a folder."""
    from ...separation.simulate import simulate

    study_lines(scene, accuracy, vary)  # refused before the run
    fraction = 0.5 if vary else 1.0
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", ValidityWarning)  # the report prints every number
        result = simulate(plan_sliding(scene, accuracy))
    studies = run_studies(
        scene, accuracy, vary, lambda done: progress(fraction + (1.0 - fraction) * done)
    )
    scalars: dict[str, tuple[Any, str]] = {"status": (result.status, "-"), **result.scalars()}
    text = "\n".join([_text(result), *study_text(studies)])
    if out is None:
        return Report(scalars, text)
    write = partial(_write, result, studies, out)
    return Report(scalars, text, write, partial(draw_sliding, result, studies, out))


def _text(result: SlidingResult) -> str:
    scalars = result.scalars()
    width = max(len(name) for name in scalars)
    numbers = [f"  {n:{width}s}  {v:.6g} {u}" for n, (v, u) in scalars.items()]
    validity = [f"  {number}" for number in result.validity]
    errata = [f"  {line}" for one in result.errata for line in str(one).splitlines()]
    if errata:
        errata = ["errata of what is taken as printed:", *errata]
    cost = f"{result.work.n_evaluations} points, {result.work.seconds:.3f} s wall time"
    said = [str(result.plan), result.message, *numbers, "validity:", *validity, *errata, cost]
    return "\n".join(said)


def _write(result: SlidingResult, studies: Studies, out: Path) -> tuple[Path, ...]:
    from ...files.results import save_csv, save_result

    headings = {name: column.heading for name, column in result.plan.columns.items()}
    return (
        save_result(result, out / "result"),
        save_csv(out / "result", result.columns, headings),
        *write_studies(studies, out),
    )


def draw_sliding(result: SlidingResult, studies: Studies, out: Path) -> tuple[Path, ...]:
    """Draw the figures of a result, and of studies, to a folder."""
    from ...plot import separation as separation_plot
    from ...plot import style as plot

    made, ax = plot.figure()
    separation_plot.slide(result, ax)
    plot.title(ax, result.plan.scene.name)
    drawn = (draw_studies(studies, result.plan.scene.name, out),) if studies else ()
    return (plot.save(made, out / "forces"), *drawn)
