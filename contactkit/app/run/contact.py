"""Running a contact scene from the command line: its numbers, files and figures."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Any

from ...accuracy import Accuracy
from ...contact.effects.partial_slip import PartialSlip
from ...contact.effects.plastic_history import PlasticHistory
from ...contact.effects.stress import SubsurfaceStress
from ...planning import plan
from ...scene.scenes import ContactScene
from ...units import quantity_text
from ..report import Report
from .study import Studies, draw_studies, run_studies, study_lines, study_text, write_studies

if TYPE_CHECKING:
    from ...contact.plan import ContactPlan
    from ...contact.result import ContactResult

__all__ = ["draw_contact", "run_contact"]

Progress = Callable[[float], None]


def run_contact(
    scene: ContactScene,
    accuracy: Accuracy,
    vary: Mapping[str, list[Any]],
    out: Path | None,
    progress: Progress,
) -> Report:
    """Solve a contact and the studies of its file, and write maps and figures to a folder."""
    from ...contact.solve import solve_unwarned

    study_lines(scene, accuracy, vary)  # refused before the solve
    result = solve_unwarned(plan(scene, accuracy))
    fraction = 0.5 if vary else 1.0
    progress(fraction)
    studies = run_studies(
        scene, accuracy, vary, lambda done: progress(fraction + (1.0 - fraction) * done)
    )
    scalars: dict[str, tuple[Any, str]] = dict(result.scalars())
    text = _text(result, studies)
    if out is None:
        return Report(scalars, text)
    write = partial(_write, result, studies, out)
    return Report(scalars, text, write, partial(draw_contact, result, studies, out))


def _text(result: ContactResult, studies: Studies) -> str:
    """Say the numbers, each with its unit, and the tables of the sweeps."""
    lines = [str(result.plan), "", result.message]
    for name, (value, unit) in result.scalars().items():
        shown = f"{value:.6g}" + ("" if unit == "-" else f" {unit}")
        lines.append(f"  {name.replace('_', ' '):34s} {shown}")
    lines.append(f"  approach and displacement from {result.approach_datum}")
    lines += ["validity:", *(f"  {number}" for number in result.validity)]
    work = result.work
    lines.append(
        f"  {work.n_solves} solves, {work.n_operator_applications} operator applications, "
        f"{work.seconds:.2f} s wall time"
    )
    return "\n".join([*lines, *study_text(studies)])


def _write(result: ContactResult, studies: Studies, out: Path) -> tuple[Path, ...]:
    from ...files.results import save_result

    return (save_result(result, out / "result"), *write_studies(studies, out))


def draw_contact(result: ContactResult, studies: Studies, out: Path) -> list[Path]:
    """Draw the figures of a result, and of studies, to a folder."""
    from ...plot import contact as contact_plot
    from ...plot import style as plot

    title = result.plan.scene.name
    made, axes = plot.figure(1, 2, size=(11.0, 5.2))
    contact_plot.pressure(result, axes[0])
    contact_plot.contact_spots(result, axes[1])
    mean = f"mean pressure {quantity_text(result.mean_pressure, 'Pa')}"
    plot.title(axes[0], f"{title}, {mean}" if title else mean)
    plot.letters(axes)
    files = [plot.save(made, out / "contact")]
    if result.plan.has(SubsurfaceStress):
        files.append(_stress(result, title, out))
    if PartialSlip in result.parts:
        files.append(_slip(result, title, out))
    if PlasticHistory in result.parts:
        files.append(_history(result, title, out))
    files.append(_stacks(result.plan, out))
    if studies:
        files.append(draw_studies(studies, title, out))
    return files


def _stress(result: ContactResult, title: str, out: Path) -> Path:
    from ...plot import stress
    from ...plot import style as plot

    made, axes = plot.figure(2, 1, size=(8.0, 7.4))
    depth = stress.depth_shown(result)
    stress.below(result, ax=axes[0])
    stress.below(result, ax=axes[1], depth=0.2 * depth)
    whole = f"{title}: stress below the maximum pressure".removeprefix(": ")
    plot.letters(axes, (whole, "its upper fifth"))
    return plot.save(made, out / "stress")


def _slip(result: ContactResult, title: str, out: Path) -> Path:
    from ...plot import slip
    from ...plot import style as plot

    made, axes = plot.figure(1, 3, size=(15.0, 4.8))
    slip.slip_zones(result, axes[0])
    slip.traction_profile(result, axes[1])
    slip.hysteresis(result, axes[2])
    plot.title(axes[0], f"{title}: tangential load path".removeprefix(": "))
    plot.letters(axes)
    return plot.save(made, out / "slip")


def _history(result: ContactResult, title: str, out: Path) -> Path:
    from ...plot import plastic_history
    from ...plot import style as plot

    made, axes = plot.figure(1, 2, size=(10.5, 4.6))
    plastic_history.force_approach(result, axes[0])
    plastic_history.residual_depth(result, axes[1])
    plot.title(axes[0], f"{title}: loading history".removeprefix(": "))
    plot.letters(axes)
    return plot.save(made, out / "loading-history")


def _stacks(made_plan: ContactPlan, out: Path) -> Path:
    from ...plot import contact as contact_plot
    from ...plot import style as plot

    interface = made_plan.scene.interface
    bodies = [("upper body", interface.upper.stack), ("lower body", interface.lower.stack)]
    shown = [(label, stack) for label, stack in bodies if stack is not None]
    heights = [len(stack.materials) for _, stack in shown]
    made, axes = plot.figure(
        len(shown),
        1,
        size=(6.0, 0.9 * sum(heights) + 0.6 * len(shown)),
        squeeze=False,
        height_ratios=heights,
    )
    for ax, (label, stack) in zip(axes[:, 0], shown, strict=True):
        contact_plot.stack_section(stack, ax, f"{label} (not to scale)")
    return plot.save(made, out / "stack")
