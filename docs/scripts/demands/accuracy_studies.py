"""Error over cost of each solver, and of each shipped scene by the presets of `Accuracy`."""

from __future__ import annotations

import json
import math
import tempfile
import time
from collections.abc import Callable, Iterable, Mapping
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
from attrs import evolve

import contactkit as ck
from contactkit.app.scenes import open_scene
from contactkit.benchmarks import table
from contactkit.benchmarks.separation import monolithic_release, separation_sweep
from contactkit.capillary.arc.bridge import arc_bridge
from contactkit.capillary.exact.bridge import bridge
from contactkit.contact.effects.base import Compliance, PressureBound
from contactkit.models.injector.report.cosimulation import build_fmus
from contactkit.models.injector.report.cost import injector_settings
from contactkit.models.micromirror.report.cost import mirror_sweep
from contactkit.reference import elliptic_bridge
from contactkit.separation.motion_curves import pull_law
from contactkit.work_precision import WorkPrecision, sweep

from .cost import counts, cpu_seconds, run
from .effect_scenes import DISC, MENISCUS, TENSION, VISCOUS, contact, disc
from .hard_films import RELEASE, release_scene

__all__ = ["PRESETS", "SCENES", "STUDIES", "Study", "presets_of"]

PRESETS = {
    "draft": ck.Accuracy.draft,
    "standard": ck.Accuracy.standard,
    "reference": ck.Accuracy.reference,
}
_MOST_SECONDS = 20.0  # of a run, after which a method is not asked for more
_TOLERANCES = {
    "active-set": (1e-2, 1e-4, 1e-6, 1e-8, 1e-10),
    "conjugate-gradient": (1e-2, 1e-4, 1e-6, 1e-8),
    "quasi-newton": (1e-2, 1e-3, 1e-4),
}
Point = dict[str, Any]


class Study(NamedTuple):
    """Errors over settings: what of, against what, which solvers, and the function that measures.

    `solvers` are names of public functions, methods of `Accuracy` or shipped scenes.
    """

    title: str
    judge: str
    solvers: tuple[str, ...]
    points: Callable[[], list[Point]]


def _quiet(done: float) -> None:
    """Take no notice of progress."""


def _swept(found: WorkPrecision) -> list[Point]:
    """Points of a sweep as data."""
    return [
        {
            "method": p.method,
            "setting": p.label,
            "error": p.error if math.isfinite(p.error) else None,
            "seconds": p.seconds if math.isfinite(p.seconds) else None,
            "counts": dict(p.counts),
            "is_model": p.is_model,
        }
        for p in found.points
    ]


def _point(method: str, setting: str, error: float, seconds: float | None, **more: int) -> Point:
    return {
        "method": method,
        "setting": setting,
        "error": error,
        "seconds": seconds,
        "counts": more,
        "is_model": False,
    }


# Solvers --------------------------------------------------------------------------------------


def methods() -> list[Point]:
    """Error of the pressure map of a rough contact by the three methods."""
    scene = contact(ck.HalfSpace())
    exact = run(scene, ck.Accuracy(grid=256, rtol=1e-11)).pressure
    points, size = [], float(np.linalg.norm(exact))
    for method, tolerances in _TOLERANCES.items():
        for rtol in tolerances:
            accuracy = ck.Accuracy(grid=256, rtol=rtol, method=method)  # type: ignore[arg-type]
            begun = time.process_time()
            found = run(scene, accuracy)
            seconds = time.process_time() - begun
            if seconds < 1.0:
                seconds = cpu_seconds(lambda a=accuracy: run(scene, a))
            error = float(np.linalg.norm(found.pressure - exact)) / size
            points.append(_point(method, f"rtol {rtol:.0e}", error, seconds, **counts(found)))
            if seconds > _MOST_SECONDS:
                break
    return points


def film() -> list[Point]:
    """Error of the release time of the film of the README."""
    scene = disc(MENISCUS, VISCOUS, TENSION)
    return _swept(separation_sweep(scene, _quiet, clock=time.process_time))


def releases() -> list[Point]:
    """Error of the release time of four reference cases by the presets."""
    points = []
    for name, entry in RELEASE.items():
        scene = release_scene(entry["case"])
        for label, accuracy in PRESETS.items():
            found = run(scene, accuracy)
            error = abs(found.state.release_time / entry["values"]["t_rel"] - 1.0)
            seconds = cpu_seconds(lambda s=scene, a=accuracy: run(s, a))
            points.append(_point(f"case {name}", label, error, seconds, **counts(found)))
    return points


def bridges() -> list[Point]:
    """Largest error of the force up to 95 % of the limit, exact and as an arc."""
    points = []
    for case in open_scene("bridges").scene.bridges:  # type: ignore[attr-defined]
        shape = case.contact_angle_lower, case.contact_angle_upper, case.curvature
        gaps = np.linspace(0.02, 0.95, 9) * elliptic_bridge.longest(*shape).gap
        exact = np.array([one.force for one in elliptic_bridge.at_gaps(gaps.tolist(), *shape)])
        for method, law in {"exact": bridge, "arc": arc_bridge}.items():

            def forces(law: Any = law, gaps: Any = gaps, shape: Any = shape) -> Any:
                return np.asarray(law(gaps, 1.0, *shape[:2], 0.0, shape[2]).force)

            error = float(np.max(np.abs(forces() / exact - 1.0)))
            seconds = cpu_seconds(forces) / gaps.size
            one = _point(method, case.label, error, seconds)
            points.append(one | {"is_model": method == "arc"})
    return points


def _injector() -> list[Point]:
    """Error of the first release; every setting is run once."""
    scene = open_scene("fuel-injector").scene  # type: ignore[attr-defined]
    film = scene.separation(scene.temperature)
    exact = monolithic_release(film, scene.valve, scene.first_pulse_end, 1e-11).value
    with tempfile.TemporaryDirectory() as folder:
        settings = injector_settings(scene, film, build_fmus(scene, Path(folder)))
        found = sweep(
            settings,
            exact,
            quantity="release time",
            floor=1e-10,
            repeats=0,
            clock=time.process_time,
        )
    return _swept(found)


def _mirror() -> list[Point]:
    scene = open_scene("micromirror").scene  # type: ignore[attr-defined]
    return _swept(mirror_sweep(scene, _quiet, clock=time.process_time))


def _of_table(name: str) -> Study:
    """A study of the table of contactkit, whose cost is convolutions."""
    study = table.STUDIES[name]

    def points() -> list[Point]:
        return [_point(p.method, p.label, p.error, None, **p.counts) for p in study.points()]

    return Study(study.title, study.judge, study.solvers, points)


STUDIES: Mapping[str, Study] = {
    "contact-methods": Study(
        "Rough contact, pressure map, three methods",
        "the active-set method at 1e-11; steel under a rough flat, 256 x 256 pixels",
        ("solve", "active-set", "conjugate-gradient", "quasi-newton"),
        methods,
    ),
    "film": Study(
        f"Release time of a film: {DISC}, tension limit of 10 bar",
        "a monolithic solution by scipy at 1e-11",
        ("simulate",),
        film,
    ),
    "releases": Study(
        "Release times of reference cases, by preset",
        "two other codes that agree to 1e-9 (tests/data/release.json)",
        ("simulate", "advance"),
        releases,
    ),
    "bridges": Study(
        "Force of liquid bridges, the exact solution and the arc (seconds for one gap)",
        "Legendre's integrals",
        ("bridges",),
        bridges,
    ),
    "fuel-injector": Study(
        "First release of the fuel injector, by solver, coupling and communication step",
        "a monolithic solution by scipy at 1e-11; each setting is run once",
        ("fuel-injector", "advance"),
        _injector,
    ),
    "micromirror": Study(
        "Time at which the tips of the micromirror are free",
        "a monolithic solution by scipy at 1e-10",
        ("micromirror",),
        _mirror,
    ),
    **{name: _of_table(name) for name in table.STUDIES},
}


# Scenes ---------------------------------------------------------------------------------------


def _shipped(name: str) -> Callable[[ck.Accuracy], Any]:
    """Run of a shipped contact, compliance and hardness, on its own grid."""
    opened: Any = open_scene(name)
    kept = tuple(e for e in opened.scene.effects if isinstance(e, Compliance | PressureBound))
    scene = evolve(opened.scene, effects=kept)

    def solved(accuracy: ck.Accuracy) -> Any:
        return run(scene, evolve(accuracy, grid=opened.accuracy.grid))

    return solved


def _contact(name: str) -> dict[str, Any]:
    solved = _shipped(name)
    exact = solved(ck.Accuracy(rtol=1e-11)).pressure
    found: dict[str, Any] = {"quantity": "pressure map, on the grid of the scene"}
    for label, accuracy in PRESETS.items():
        one = solved(accuracy)
        error = float(np.linalg.norm(one.pressure - exact) / np.linalg.norm(exact))
        seconds = cpu_seconds(lambda a=accuracy: solved(a), repeats=2)
        found[label] = {"error": error, "seconds": seconds, "counts": counts(one)}
    grid = ck.discretisation_error(solved(ck.Accuracy.standard)).errors
    return found | {"grid": {name: grid[name] for name in ("max_pressure", "contact_area")}}


def _film() -> dict[str, Any]:
    scene = disc(MENISCUS, VISCOUS, TENSION)
    end = 1.001 * run(scene, ck.Accuracy()).state.release_time
    exact = monolithic_release(scene, pull_law(ck.plan(scene)), end, 1e-11).value
    found: dict[str, Any] = {"quantity": "release time"}
    for label, accuracy in PRESETS.items():
        one = run(scene, accuracy)
        seconds = cpu_seconds(lambda a=accuracy: run(scene, a))
        error = abs(one.state.release_time / exact - 1.0)
        found[label] = {"error": error, "seconds": seconds, "counts": counts(one)}
    return found


SCENES: Mapping[str, Callable[[], dict[str, Any]]] = {
    "head-disk": lambda: _contact("head-disk"),
    "contact-stop": lambda: _contact("contact-stop"),
    "tip-landing": lambda: _contact("tip-landing"),
    "film of the README": _film,
}
"""Scenes that take a preset; the others of those shipped are devices and have their studies."""


def presets_of(names: Iterable[str] = SCENES) -> dict[str, dict[str, Any]]:
    """Error, CPU seconds and counts of scenes with each preset."""
    return {name: SCENES[name]() for name in names}


def peers() -> dict[str, Any]:
    """Committed seconds and errors of other programs."""
    path = Path(__file__).parents[2] / "demands" / "peers.json"
    found: dict[str, Any] = json.loads(path.read_text(encoding="utf-8"))
    return found
