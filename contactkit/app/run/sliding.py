"""Running a sliding scene from the command line: its report, files and figure."""

from __future__ import annotations

import warnings
from collections.abc import Callable
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Any

from ...errors import ValidityWarning
from ...scene.scenes import SlidingScene
from ...separation.sliding.plan import plan_sliding
from ..report import Report

if TYPE_CHECKING:
    from ...separation.sliding.result import SlidingResult

__all__ = ["run_sliding"]

Progress = Callable[[float], None]


def run_sliding(scene: SlidingScene, out: Path | None, progress: Progress) -> Report:
    """Simulate a sliding, and write its curves and figure to a folder if one is given."""
    from ...separation.simulate import simulate

    with warnings.catch_warnings():
        warnings.simplefilter("ignore", ValidityWarning)  # the report prints every number
        result = simulate(plan_sliding(scene), progress=progress)
    scalars: dict[str, tuple[Any, str]] = {"status": (result.status, "-"), **result.scalars()}
    if out is None:
        return Report(scalars, _text(result))
    return Report(scalars, _text(result), _write(result, out), partial(_draw, result, out))


def _text(result: SlidingResult) -> str:
    scalars = result.scalars()
    width = max(len(name) for name in scalars)
    numbers = [f"  {n:{width}s}  {v:.6g} {u}" for n, (v, u) in scalars.items()]
    validity = [f"  {number}" for number in result.validity]
    errata = [f"  {line}" for one in result.errata for line in str(one).splitlines()]
    if errata:
        errata = ["errata of what is taken as printed:", *errata]
    cost = f"{result.work.n_evaluations} points, {result.work.seconds:.3f} s"
    said = [str(result.plan), result.message, *numbers, "validity:", *validity, *errata, cost]
    return "\n".join(said)


def _write(result: SlidingResult, out: Path) -> tuple[Path, ...]:
    from ...files.results import save_csv, save_result

    headings = {name: column.heading for name, column in result.plan.columns.items()}
    return (
        save_result(result, out / "result"),
        save_csv(out / "result", result.columns, headings),
    )


def _draw(result: SlidingResult, out: Path) -> tuple[Path, ...]:
    from ...plot import separation as plot

    made, ax = plot.figure()
    plot.slide(result, ax)
    plot.title(ax, result.plan.scene.name)
    return (plot.save(made, out / "forces"),)
