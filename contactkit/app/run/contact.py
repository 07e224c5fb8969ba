"""Running a contact scene from the command line: its numbers, files and figures."""

from __future__ import annotations

import warnings
from collections.abc import Callable, Mapping
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple

from attrs import evolve

from ...accuracy import Accuracy
from ...contact.effects.film import FilmMeniscus
from ...contact.effects.stress import SubsurfaceStress
from ...errors import ValidityWarning
from ...planning import plan
from ...scene.scenes import ContactScene
from ..report import Report

if TYPE_CHECKING:
    from ...contact.plan import ContactPlan
    from ...contact.result import ContactResult
    from ...studies.study import Study

__all__ = ["Variant", "run_contact", "study_variants"]

Progress = Callable[[float], None]

_REPORTED = (
    "max_pressure",
    "contact_fraction",
    "plastic_fraction",
    "max_displacement",
    "relative_meniscus_force",
)


def run_contact(
    scene: ContactScene,
    accuracy: Accuracy,
    vary: Mapping[str, list[Any]],
    out: Path | None,
    progress: Progress,
) -> Report:
    """Solve a contact and the studies of its file, and write maps and figures to a folder."""
    from ...contact.solve import solve_unwarned
    from ...studies.study import check_study

    variants = study_variants(scene) if vary else ()
    for variant in variants:
        check_study(variant.scene, vary, accuracy)  # before the solve
    result = solve_unwarned(plan(scene, accuracy))
    fraction = 0.5 if vary else 1.0
    progress(fraction)
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", ValidityWarning)  # the report prints every number
        studies = _studies(
            variants, accuracy, vary, lambda done: progress(fraction + (1.0 - fraction) * done)
        )
    scalars: dict[str, tuple[Any, str]] = dict(result.scalars())
    text = _text(result, studies)
    if out is None:
        return Report(scalars, text)
    files = _write(result, studies, out)
    return Report(scalars, text, files, partial(_figures, result, studies, out))


class Variant(NamedTuple):
    """A scene whose load curve is run, and what it is."""

    label: str
    scene: ContactScene


def study_variants(scene: ContactScene) -> tuple[Variant, ...]:
    """Scenes of the load curves: as it is and, where a film is listed, with its pull added."""
    light = _without(scene, SubsurfaceStress)
    film = light.effect(FilmMeniscus)
    if film is None:
        return (Variant("dry", light),)
    other = evolve(film, self_consistent=not film.self_consistent)
    changed = evolve(light, effects=tuple(other if e is film else e for e in light.effects))
    reported, pulling = (changed, light) if film.self_consistent else (light, changed)
    return (Variant("wet, film reported only", reported), Variant("wet, film pulls too", pulling))


def _studies(
    variants: tuple[Variant, ...],
    accuracy: Accuracy,
    vary: Mapping[str, list[Any]],
    progress: Progress,
) -> tuple[tuple[str, Study[ContactResult]], ...]:
    """The sweep of the file, of each variant."""
    from ...studies.study import study

    done: list[tuple[str, Study[ContactResult]]] = []
    for label, variant in variants:

        def part(fraction: float, before: int = len(done)) -> None:
            progress((before + fraction) / len(variants))

        done.append((label, study(variant, vary, accuracy, progress=part)))
    return tuple(done)


def _without(scene: ContactScene, kind: type) -> ContactScene:
    return evolve(scene, effects=tuple(e for e in scene.effects if not isinstance(e, kind)))


def _text(result: ContactResult, studies: tuple[tuple[str, Study[ContactResult]], ...]) -> str:
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
        f"{work.seconds:.2f} s"
    )
    for label, made in studies:
        names = [n for n in _REPORTED if n in made.units]
        lines += ["", f"load curve, {label}:", made.table(*names)]
    return "\n".join(lines)


def _write(
    result: ContactResult, studies: tuple[tuple[str, Study[ContactResult]], ...], out: Path
) -> tuple[Path, ...]:
    from ...files.results import save_result

    files = [save_result(result, out / "result")]
    for label, made in studies:
        name = "load-curve" if len(studies) == 1 else f"load-curve-{_slug(label)}"
        files.append(made.save_csv(out / name))
    return tuple(files)


def _slug(label: str) -> str:
    return "-".join(label.replace(",", "").split())


def _figures(
    result: ContactResult, studies: tuple[tuple[str, Study[ContactResult]], ...], out: Path
) -> list[Path]:
    from ...plot import contact as contact_plot
    from ...plot import separation as plot

    title = result.plan.scene.name
    made, axes = plot.figure(1, 2, size=(11.0, 5.2))
    contact_plot.pressure(result, axes[0])
    contact_plot.contact_spots(result, axes[1])
    factor, unit = contact_plot.pressure_unit(result.mean_pressure)
    mean = f"mean pressure {result.mean_pressure / factor:.3g} {unit}"
    plot.title(axes[0], f"{title}, {mean}" if title else mean)
    files = [plot.save(made, out / "contact")]
    if result.plan.has(SubsurfaceStress):
        made, ax = plot.figure(size=(8.0, 5.5))
        contact_plot.von_mises_section(result, ax)
        plot.title(ax, f"{title}: under the maximum pressure".removeprefix(": "))
        files.append(plot.save(made, out / "stress"))
    files.append(_stacks(result.plan, out))
    if studies:
        files.append(_load_curves(studies, title, out))
    return files


def _stacks(made_plan: ContactPlan, out: Path) -> Path:
    from ...plot import contact as contact_plot
    from ...plot import separation as plot

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


def _load_curves(
    studies: tuple[tuple[str, Study[ContactResult]], ...], title: str, out: Path
) -> Path:
    from ...plot import contact as contact_plot
    from ...plot import separation as plot

    curves = [
        (", ".join(filter(None, [label, line.label])), line.columns)
        for label, made in studies
        for line in made.lines("loading")
    ]
    panels = contact_plot.panels_of(curves)
    columns = min(3, len(panels))
    rows = -(-len(panels) // columns)
    made, axes = plot.figure(rows, columns, size=(4.0 * columns, 3.4 * rows), squeeze=False)
    flat = list(axes.flat)
    contact_plot.load_curve(curves, flat)
    for ax in flat[len(panels) :]:
        ax.set_visible(False)
    plot.title(flat[0], f"{title}: load curve".removeprefix(": "))
    if len(curves) > 1:
        plot.shared_legend(made, flat[0])
    return plot.save(made, out / "load-curve")
