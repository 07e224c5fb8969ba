"""Error, CPU seconds and counts of each shipped scene by the presets of `Accuracy`."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from typing import Any

import numpy as np
from attrs import evolve

import contactkit as ck
from contactkit.app.scenes import open_scene
from contactkit.benchmarks.separation import monolithic_release
from contactkit.benchmarks.separation_studies import PRESETS, film_scene
from contactkit.benchmarks.timing import counts, cpu_seconds, run
from contactkit.contact.effects.base import Compliance, PressureBound
from contactkit.separation.motion_curves import pull_law

__all__ = ["SCENES", "presets_of"]


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
    scene = film_scene()
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
