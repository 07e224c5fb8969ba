"""Running a separation scene from the command line: its numbers, files and figures."""

from __future__ import annotations

import warnings
from collections.abc import Callable, Mapping
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Any

from ...accuracy import Accuracy
from ...errors import ValidityWarning
from ...scene.scenes import SeparationScene
from ...separation.plan import Plan, plan
from ..report import Report
from .study import Studies, draw_studies, run_studies, study_lines, study_text, write_studies

if TYPE_CHECKING:
    from ...separation.results import SeparationResult

__all__ = ["draw_separation", "run_separation"]


def run_separation(
    scene: SeparationScene,
    accuracy: Accuracy,
    vary: Mapping[str, list[Any]],
    out: Path | None,
    progress: Callable[[float], None],
) -> Report:
    """Simulate a separation and the study of its file; write curves and figures to a folder."""
    from ...separation.simulate import simulate

    study_lines(scene, accuracy, vary)  # refused before the run
    made = plan(scene, accuracy)
    fraction = 0.5 if vary else 1.0
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", ValidityWarning)  # the report prints every number
        result = simulate(made, progress=lambda done: progress(fraction * done))
    studies = run_studies(
        scene, accuracy, vary, lambda done: progress(fraction + (1.0 - fraction) * done)
    )
    scalars: dict[str, tuple[Any, str]] = {"status": (result.status, "-"), **result.scalars()}
    text = "\n".join([_text(made, result), *study_text(studies)])
    if out is None:
        return Report(scalars, text)
    write = partial(_write, result, studies, out)
    return Report(scalars, text, write, partial(draw_separation, result, studies, out))


def _text(made: Plan, result: SeparationResult) -> str:
    width = max(len(name) for name in result.scalars())
    numbers = [f"  {n:{width}s}  {v:.6g} {u}" for n, (v, u) in result.scalars().items()]
    validity = [f"  {number}" for number in result.validity]
    errata = [f"  {line}" for one in result.errata for line in str(one).splitlines()]
    if errata:
        errata = ["errata of what is taken as printed, at the start:", *errata]
    work = result.work
    counts = f"{work.n_steps} steps, {work.n_evaluations} force evaluations"
    cost = f"{counts}, {work.seconds:.3f} s wall time"
    curves = f"curves: {result.lines}"
    lines = [str(made), result.message, *numbers, "validity:", *validity, *errata, curves, cost]
    return "\n".join(lines)


def _write(result: SeparationResult, studies: Studies, out: Path) -> tuple[Path, ...]:
    from ...files.results import save_csv, save_result

    headings = {name: column.heading for name, column in result.plan.columns.items()}
    return (
        save_result(result, out / "result"),
        save_csv(out / "result", result.columns, headings),
        *write_studies(studies, out),
    )


def draw_separation(result: SeparationResult, studies: Studies, out: Path) -> tuple[Path, ...]:
    """Draw the figures of a result, and of studies, to a folder."""
    from ...plot import separation as separation_plot
    from ...plot import style as plot

    files = []
    if any(force.name in result.columns for force in result.plan.forces):
        made, ax = plot.figure()
        separation_plot.forces(result, ax)
        plot.title(ax, result.plan.scene.name)
        files.append(plot.save(made, out / "forces"))
    if "mean_pull" in result.columns:
        made, ax = plot.figure()
        separation_plot.cycles(result, ax)
        plot.title(ax, result.plan.scene.name)
        files.append(plot.save(made, out / "cycles"))
    if result.state is not None:
        made, ax = plot.figure()
        separation_plot.motion(result, ax)
        plot.title(ax, result.plan.scene.name)
        files.append(plot.save(made, out / "motion"))
    if studies:
        files.append(draw_studies(studies, result.plan.scene.name, out))
    return tuple(files)
