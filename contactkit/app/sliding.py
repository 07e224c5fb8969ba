"""Running a sliding scene from the command line: its report, files and figure."""

from __future__ import annotations

import warnings
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any

from attrs import frozen

from ..errors import PlanError, ValidityWarning
from ..scene.scenes import SlidingScene
from ..separation.sliding.plan import plan_sliding
from .report import Report

if TYPE_CHECKING:
    from ..separation.sliding.result import SlidingResult

__all__ = ["PlainSliding"]

Progress = Callable[[float], None]


@frozen
class PlainSliding:
    """A sliding scene as the command line runs it."""

    scene: SlidingScene

    @property
    def name(self) -> str:
        """Title of the scene."""
        return self.scene.name or "sliding"

    def plan_text(self) -> str:
        """See `Runnable.plan_text`."""
        made = plan_sliding(self.scene)
        return f"{made}\nsources:\n" + "\n".join(f"  {line}" for line in made.cite().splitlines())

    def run(self, out: Path | None, progress: Progress) -> Report:
        """See `Runnable.run`."""
        from ..separation.simulate import simulate

        with warnings.catch_warnings():
            warnings.simplefilter("ignore", ValidityWarning)  # the report prints every number
            result = simulate(plan_sliding(self.scene), progress=progress)
        scalars: dict[str, tuple[Any, str]] = {"status": (result.status, "-"), **result.scalars()}
        files = _write(result, out) if out is not None else ()
        return Report(scalars, _text(result), files)

    def cost(self, out: Path | None, progress: Progress, error: float) -> Report:
        """See `Runnable.cost`."""
        raise PlanError("cost has nothing to weigh: a sliding is closed form or one quadrature")

    def fmu_start(self) -> tuple[str, Mapping[str, Any]]:
        """See `Runnable.fmu_start`."""
        raise PlanError("no FMU holds a sliding scene; an FMU needs a scene with an opening")


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
    from ..files.results import save_csv, save_result
    from ..plot import separation as plot
    from ..separation.columns import COLUMNS

    headings = {c.name: f"{c.name} [{c.unit}]" for c in COLUMNS}
    made, ax = plot.figure()
    plot.slide(result, ax)
    plot.title(ax, result.plan.scene.name)
    return (
        save_result(result, out / "result"),
        save_csv(out / "result", result.columns, headings),
        plot.save(made, out / "forces"),
    )
