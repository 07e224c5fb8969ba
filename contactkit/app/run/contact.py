"""Running a contact scene from the command line: its numbers, files and figures."""

from __future__ import annotations

import warnings
from collections.abc import Callable, Mapping
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np
from attrs import evolve

from ...accuracy import Accuracy
from ...contact.effects.film import FilmMeniscus
from ...contact.effects.partial_slip import PartialSlip
from ...contact.effects.plastic_history import PlasticHistory
from ...contact.effects.stress import SubsurfaceStress
from ...errors import ValidityWarning
from ...planning import plan
from ...scene.scenes import ContactScene
from ...units import quantity_text
from ..report import Report

if TYPE_CHECKING:
    from ...contact.plan import ContactPlan
    from ...contact.result import ContactResult
    from ...studies.study import Study

__all__ = ["Variant", "run_contact", "study_variants"]

Progress = Callable[[float], None]

_ROUND_OFF = 1e-6  # of a quantity that does not depend on what varies
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
        names = [n for n in (*_REPORTED, *_of_effects(result.plan.scene)) if n in made.units]
        lines += ["", f"{_what(made)}, {label}:", made.table(*names)]
    return "\n".join(lines)


def _of_effects(scene: ContactScene) -> dict[str, str]:
    """Units of the numbers of the listed effects, by name, of those without any in `_REPORTED`."""
    return {
        one.name: one.unit
        for effect in scene.effects
        for one in effect.scalars
        if not any(each.name in _REPORTED for each in effect.scalars)
    }


def _parameter(made: Study[ContactResult]) -> str | None:
    """Path that the points are drawn over; None where the load varies."""
    paths = [path for axis in made.paths for path in axis]
    return None if any(path.startswith("loading") for path in paths) else made.paths[-1][0]


def _what(made: Study[ContactResult]) -> str:
    return "load curve" if _parameter(made) is None else "study"


def _write(
    result: ContactResult, studies: tuple[tuple[str, Study[ContactResult]], ...], out: Path
) -> tuple[Path, ...]:
    from ...files.results import save_result

    files = [save_result(result, out / "result")]
    for label, made in studies:
        name = _slug(_what(made))
        name = name if len(studies) == 1 else f"{name}-{_slug(label)}"
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
    mean = f"mean pressure {quantity_text(result.mean_pressure, 'Pa')}"
    plot.title(axes[0], f"{title}, {mean}" if title else mean)
    files = [plot.save(made, out / "contact")]
    if result.plan.has(SubsurfaceStress):
        made, ax = plot.figure(size=(8.0, 5.5))
        contact_plot.von_mises_section(result, ax)
        plot.title(ax, f"{title}: under the maximum pressure".removeprefix(": "))
        files.append(plot.save(made, out / "stress"))
    if PartialSlip in result.parts:
        files.append(_slip(result, title, out))
    if PlasticHistory in result.parts:
        files.append(_history(result, title, out))
    files.append(_stacks(result.plan, out))
    if studies:
        files.append(_load_curves(studies, _of_effects(result.plan.scene), title, out))
    return files


def _slip(result: ContactResult, title: str, out: Path) -> Path:
    from ...plot import separation as plot
    from ...plot import slip

    made, axes = plot.figure(1, 3, size=(15.0, 4.8))
    slip.slip_zones(result, axes[0])
    slip.traction_profile(result, axes[1])
    slip.hysteresis(result, axes[2])
    plot.title(axes[0], f"{title}: tangential load path".removeprefix(": "))
    return plot.save(made, out / "slip")


def _history(result: ContactResult, title: str, out: Path) -> Path:
    from ...plot import plastic_history
    from ...plot import separation as plot

    made, axes = plot.figure(1, 2, size=(10.5, 4.6))
    plastic_history.force_approach(result, axes[0])
    plastic_history.residual_depth(result, axes[1])
    plot.title(axes[0], f"{title}: loading history".removeprefix(": "))
    return plot.save(made, out / "loading-history")


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
    studies: tuple[tuple[str, Study[ContactResult]], ...],
    units: Mapping[str, str],
    title: str,
    out: Path,
) -> Path:
    from ...plot import contact as contact_plot
    from ...plot import separation as plot

    curves = [
        (", ".join(filter(None, [label, line.label])), line.columns)
        for label, made in studies
        for line in made.lines("loading")
    ]
    first, names = studies[0][1], [n for n in units if not n.endswith("_residual")]
    path, label = _parameter(first), ""
    more = [(n, f"{n.replace('_', ' ')} [{units[n]}]", 1.0) for n in names]
    panels = contact_plot.panels_of(curves, more)
    if path is not None:
        changing = [panel for panel in panels if _changes(curves, panel[0])]
        panels, label = changing or panels, f"{_short(path)} [{first.unit(path)}]"
    columns = min(3, len(panels))
    rows = -(-len(panels) // columns)
    made, axes = plot.figure(rows, columns, size=(4.0 * columns, 3.4 * rows), squeeze=False)
    flat = list(axes.flat)
    contact_plot.load_curve(curves, flat, panels, over=(path, label) if path else None)
    for ax in flat[len(panels) :]:
        ax.set_visible(False)
    plot.title(flat[0], f"{title}: {_what(first)}".removeprefix(": "))
    if len(curves) > 1:
        plot.shared_legend(made, flat[0])
    return plot.save(made, out / _slug(_what(first)))


def _changes(curves: list[tuple[str, Mapping[str, Any]]], name: str) -> bool:
    """Whether a column differs between the points of a curve by more than round-off."""
    columns = (np.asarray(c[name], dtype=float) for _, c in curves if name in c)
    known = [one[np.isfinite(one)] for one in columns]
    return any(np.ptp(one) > _ROUND_OFF * np.abs(one).max() for one in known if one.size)


def _short(path: str) -> str:
    """Last names of a path, as a label."""
    return " ".join(path.split(".")[-2:]).replace("_", " ")
