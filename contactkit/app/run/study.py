"""Running the study of a scene file: tables, files with all columns, and a figure."""

from __future__ import annotations

import math
import warnings
from collections.abc import Callable, Mapping, Sequence
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np
from attrs import evolve

from ...accuracy import Accuracy
from ...contact.effects.base import effects_of
from ...contact.effects.film import FilmMeniscus
from ...contact.effects.stress import SubsurfaceStress
from ...errors import PlanError, ValidityWarning
from ...scene.scenes import ContactScene, SeparationScene, SlidingScene
from ...studies.bands import BAND, RUNS, is_seed
from ..report import Report

if TYPE_CHECKING:
    from ...studies.study import Study

__all__ = [
    "StudyOptions",
    "Variant",
    "draw_studies",
    "run_studies",
    "run_study",
    "study_lines",
    "study_text",
    "study_variants",
    "write_studies",
]

AnyScene = ContactScene | SeparationScene | SlidingScene
Progress = Callable[[float], None]

_ROUND_OFF = 1e-6  # of a quantity that does not depend on what varies
_MOST_PANELS = 9
_UNSEEN = ("seconds", RUNS, "residual", "energy")  # not drawn
_OF_CONTACTS = (
    "max_pressure",
    "contact_fraction",
    "plastic_fraction",
    "max_displacement",
    "relative_meniscus_force",
)


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


class Variant(NamedTuple):
    """A scene whose study is run, and what it is."""

    label: str
    scene: AnyScene


class Ran(NamedTuple):
    """The study of a variant, and the numbers of effects that its table shows."""

    label: str
    made: Study[Any]
    names: tuple[str, ...]


Studies = tuple[Ran, ...]


def study_variants(scene: AnyScene) -> tuple[Variant, ...]:
    """Scenes of the studies: as it is and, where a contact lists a film, with its pull added."""
    if not isinstance(scene, ContactScene):
        return (Variant("", scene),)
    light = evolve(
        scene, effects=tuple(e for e in scene.effects if not isinstance(e, SubsurfaceStress))
    )
    film = light.effect(FilmMeniscus)
    if film is None:
        return (Variant("dry", light),)
    other = evolve(film, self_consistent=not film.self_consistent)
    changed = evolve(light, effects=tuple(other if e is film else e for e in light.effects))
    reported, pulling = (changed, light) if film.self_consistent else (light, changed)
    return (Variant("wet, film reported only", reported), Variant("wet, film pulls too", pulling))


def run_study(
    scene: AnyScene,
    accuracy: Accuracy,
    vary: Mapping[str, list[Any]],
    out: Path | None,
    progress: Progress,
    options: StudyOptions,
) -> Report:
    """Run the study of a scene file, and write its columns and figure to a folder."""
    if not vary:
        raise PlanError(
            "the scene file has no study: add a table such as [study] "
            '"loading.speed" = ["1 um/s", "10 um/s"]'
        )
    if options.trials:
        return _estimated(scene, accuracy, vary, options)
    if options.stream is not None:
        return _streamed(scene, accuracy, vary, progress, options.stream, options.workers)
    made = run_studies(scene, accuracy, vary, progress, options)
    text = "\n".join([*study_text(made), *_definitions(made, options)]).lstrip("\n")
    if out is None:
        return Report(_columns(made), text)
    write = partial(write_studies, made, out)
    return Report(_columns(made), text, write, partial(_drawn, made, scene.name, out))


def _estimated(
    scene: AnyScene, accuracy: Accuracy, vary: Mapping[str, list[Any]], options: StudyOptions
) -> Report:
    """Estimate time, memory and disk of a study from a few of its points."""
    from ...studies.estimate import plan_study

    lines, numbers = list[str](), dict[str, tuple[Any, str]]()
    for label, variant in study_variants(scene):
        found = plan_study(variant, vary, accuracy, trials=options.trials, workers=options.workers)
        lines += [*([f"{label}:"] if label else []), str(found)]
        key = f"{label}: " if label else ""
        numbers[f"{key}n_points"] = (found.n_points, "-")
        numbers[f"{key}cpu_time"] = (found.total_seconds, "s")
        numbers[f"{key}memory"] = (found.memory, "bytes")
        numbers[f"{key}disk"] = (found.disk, "bytes")
    return Report(numbers, "\n".join(lines))


def _streamed(
    scene: AnyScene,
    accuracy: Accuracy,
    vary: Mapping[str, list[Any]],
    progress: Progress,
    path: Path,
    workers: int,
) -> Report:
    """Write the points of a study to a file as they are solved."""
    from ...studies.stream import stream_study

    variants, lines, numbers = study_variants(scene), list[str](), dict[str, tuple[Any, str]]()
    files: list[Path] = []
    for i, (label, variant) in enumerate(variants):
        name = path if len(variants) == 1 else path.with_stem(f"{path.stem}-{_slug(label)}")

        def part(fraction: float, before: int = i) -> None:
            progress((before + fraction) / len(variants))

        made = stream_study(variant, vary, name, accuracy, workers=workers, progress=part)
        failed = sum(1 for _ in made.failed())
        lines.append(f"{made.path}: {made.n_done} points, {failed} of them without a solution")
        key = f"{label}: " if len(variants) > 1 else ""
        numbers[f"{key}n_points"] = (made.n_done, "-")
        numbers[f"{key}n_failed"] = (failed, "-")
        files.append(made.path)
    return Report(numbers, "\n".join(lines), partial(tuple, files))


def run_studies(
    scene: AnyScene,
    accuracy: Accuracy,
    vary: Mapping[str, list[Any]],
    progress: Progress,
    options: StudyOptions = _PLAIN,
) -> Studies:
    """Run the study of each variant of a scene; what is refused is refused before any solve."""
    from ...studies.study import check_study, study

    variants = study_variants(scene) if vary else ()
    for variant in variants:
        check_study(variant.scene, vary, accuracy)
    done: list[Ran] = []
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", ValidityWarning)  # the report prints every number
        for label, variant_scene in variants:

            def part(fraction: float, before: int = len(done)) -> None:
                progress((before + fraction) / len(variants))

            made: Study[Any] = study(
                variant_scene,
                vary,
                accuracy,
                progress=part,
                workers=options.workers,
                store=options.store,
            )
            scaled = made.dimensionless() if options.dimensionless else made
            done.append(Ran(label, scaled, _of_effects(variant_scene)))
    return tuple(done)


def study_lines(scene: AnyScene, accuracy: Accuracy, vary: Mapping[str, list[Any]]) -> list[str]:
    """Check the study of a file, and say what it varies; nothing without one."""
    from ...studies.study import check_study

    if not vary:
        return []
    for variant in study_variants(scene):
        varied = check_study(variant.scene, vary, accuracy)
    n = [f"  {', '.join(axis.paths)}: {len(axis.values)} values" for axis in varied]
    return ["study, the last path fastest:", *n]


def study_text(studies: Studies) -> list[str]:
    """Tables of studies; medians where a seed varies."""
    lines = []
    for ran in studies:
        head = ", ".join(filter(None, [_what(ran.made), ran.label, _runs(ran.made)]))
        lines += ["", f"{head}:", _shown(ran.made).table(*_telling(ran))]
    return lines


def _definitions(studies: Studies, options: StudyOptions) -> list[str]:
    """Definitions of the scales that the columns are in units of."""
    if not options.dimensionless:
        return []
    scales = {one.name: one.definition for ran in studies for one in ran.made.scales.values()}
    return ["", "in units of", *(f"  {name}: {text}" for name, text in scales.items())]


def _runs(made: Study[Any]) -> str:
    n = math.prod(n for n, paths in zip(made.shape, made.paths, strict=True) if is_seed(paths))
    return f"medians of {n} seeds" if _has_seeds(made) else ""


def _has_seeds(made: Study[Any]) -> bool:
    return any(map(is_seed, made.paths))


def _shown(made: Study[Any]) -> Study[Any]:
    """The study, banded where a seed varies."""
    return made.bands() if _has_seeds(made) else made


def _is_contact(made: Study[Any]) -> bool:
    return "contact_area" in made.units


def _telling(ran: Ran) -> list[str]:
    """Numbers of contacts that tables show; of others those that vary are found."""
    known = (*_OF_CONTACTS, *ran.names) if _is_contact(ran.made) else ()
    return [n for n in known if n in ran.made.units]


def _of_effects(scene: AnyScene) -> tuple[str, ...]:
    """Numbers of the effects of a contact, of those without any in `_OF_CONTACTS`."""
    if not isinstance(scene, ContactScene):
        return ()
    return tuple(
        one.name
        for effect in effects_of(scene)
        for one in effect.scalars
        if not any(each.name in _OF_CONTACTS for each in effect.scalars)
    )


def _parameter(made: Study[Any]) -> str:
    """Path that the points are drawn over: the load of a contact, else what varies last."""
    paths = [axis[0] for axis in made.paths if not is_seed(axis)] or [RUNS]
    loads = [p for p in paths if p.startswith("loading")] if _is_contact(made) else []
    return (loads or paths)[-1]


def _is_load_curve(made: Study[Any]) -> bool:
    return _is_contact(made) and _parameter(made).startswith("loading")


def _what(made: Study[Any]) -> str:
    return "load curve" if _is_load_curve(made) else "study"


def _slug(label: str) -> str:
    return "-".join(label.replace(",", "").split())


def write_studies(studies: Studies, out: Path) -> tuple[Path, ...]:
    """Write all columns as CSV and npz, and those of the bands where a seed varies."""
    files = []
    for label, made, _ in studies:
        name = _slug(_what(made))
        name = name if len(studies) == 1 else f"{name}-{_slug(label)}"
        files += [made.save_csv(out / name), made.save_npz(out / name)]
        if _has_seeds(made):
            banded = made.bands()
            files += [
                banded.save_csv(out / f"{name}-bands"),
                banded.save_npz(out / f"{name}-bands"),
            ]
    return tuple(files)


def _columns(studies: Studies) -> dict[str, tuple[Any, str]]:
    """Columns as lists, None for what is no number, for JSON."""
    found: dict[str, tuple[Any, str]] = {}
    for label, made, _ in studies:
        shown = _shown(made)
        for name, unit in shown.units.items():
            values = shown.column(name).tolist()
            numbers = [v if isinstance(v, float) and math.isfinite(v) else None for v in values]
            is_text = shown.column(name).dtype == object
            key = name if len(studies) == 1 else f"{label}: {name}"
            found[key] = (list(map(str, values)) if is_text else numbers, unit)
    return found


def _drawn(studies: Studies, title: str, out: Path) -> list[Path]:
    return [draw_studies(studies, title, out)]


def draw_studies(studies: Studies, title: str, out: Path) -> Path:
    """Draw the numbers that vary over a parameter, a line for each combination of the others."""
    from ...plot import axis_units
    from ...plot import study as study_plot
    from ...plot import style as plot

    first = _shown(studies[0].made)
    path = _parameter(first)
    curves = [
        (", ".join(filter(None, [ran.label, line.label])), line.columns)
        for ran in studies
        for line in _shown(ran.made).lines(path)
    ]
    panels = _panels(first, curves, studies[0].names)
    columns = min(3, len(panels))
    rows = -(-len(panels) // columns)
    figure, axes = plot.figure(rows, columns, size=(4.0 * columns, 3.4 * rows), squeeze=False)
    flat = list(axes.flat)
    if _is_plain_load_curve(first):
        from ...plot import contact as contact_plot

        contact_plot.load_curve(curves, flat, panels)
    else:
        factor, unit = axis_units.readable(first.unit(path), _numbers(curves, path))
        label = _short(path) + ("" if unit == "-" else f" [{unit}]")
        study_plot.study_curves(curves, flat, panels, (path, label, factor))
    for ax in flat[len(panels) :]:
        ax.set_visible(False)
    head = ", ".join(filter(None, [_what(first), _runs(studies[0].made)]))
    plot.title(flat[0], f"{title}: {head}".removeprefix(": "))
    if len(panels) > 1:
        plot.letters(flat[: len(panels)])
    if len(curves) > 1:
        plot.shared_legend(figure, flat[0])
    return plot.save(figure, out / _slug(_what(first)))


def _is_plain_load_curve(made: Study[Any]) -> bool:
    """A load curve in SI units, which is drawn over the mean pressure or the approach."""
    return _is_load_curve(made) and made.unit("load") == "N"


def _panels(
    made: Study[Any], curves: Sequence[tuple[str, Mapping[str, Any]]], of_effects: Sequence[str]
) -> list[Any]:
    """Panels of the figure: of contacts their usual numbers, else all that change."""
    from ...plot import axis_units
    from ...plot import contact as contact_plot

    varied = [path for axis in made.paths for path in axis]
    ends = tuple(end for end in BAND if end)
    names = [
        n
        for n in made.units
        if n not in varied and n not in _UNSEEN and not n.startswith("n_") and not n.endswith(ends)
    ]
    if _is_contact(made):
        more = [n for n in of_effects if n in names and not n.endswith("_residual")]
        if made.unit("load") == "N":
            labels = [(n, f"{_spoken(n)} [{made.unit(n)}]", 1.0) for n in more]
            found = contact_plot.panels_of(curves, labels)
            if _is_load_curve(made):
                return found
            return [panel for panel in found if _changes(curves, panel[0])] or found
        names = [n for n in dict.fromkeys((*_OF_CONTACTS, *more)) if n in names]
    changing = _different(curves, [n for n in names if _changes(curves, n)]) or names
    panels = []
    for name in changing[:_MOST_PANELS]:
        factor, unit = axis_units.readable(made.unit(name), _numbers(curves, name))
        panels.append((name, _spoken(name) + ("" if unit == "-" else f" [{unit}]"), factor))
    return panels


def _different(curves: Sequence[tuple[str, Mapping[str, Any]]], names: Sequence[str]) -> list[str]:
    """Columns without those that repeat another one, such as a total of one force."""
    found: dict[bytes, str] = {}
    for name in names:
        found.setdefault(np.array(_numbers(curves, name)).tobytes(), name)
    return list(found.values())


def _numbers(curves: Sequence[tuple[str, Mapping[str, Any]]], name: str) -> list[float]:
    """Finite numbers of a column of all lines."""
    found = [v for _, c in curves for v in np.asarray(c.get(name, ())).tolist()]
    return [v for v in found if isinstance(v, float) and math.isfinite(v)]


def _changes(curves: Sequence[tuple[str, Mapping[str, Any]]], name: str) -> bool:
    """Whether a column differs between the points of a curve by more than round-off."""
    columns = (np.asarray(c[name], dtype=float) for _, c in curves if name in c)
    known = [one[np.isfinite(one)] for one in columns]
    return any(np.ptp(one) > _ROUND_OFF * np.abs(one).max() for one in known if one.size)


def _spoken(name: str) -> str:
    return name.replace("_", " ")


def _short(path: str) -> str:
    """Last names of a path, as a label."""
    return _spoken(" ".join(path.split(".")[-2:]))
