"""Accuracy of separations: release times of films.

Seconds are CPU time of the process.
"""

from __future__ import annotations

import time
from functools import partial
from typing import Any

from ..accuracy import Accuracy
from ..files.scenes import load_liquid
from ..scene.interface import Interface
from ..scene.loading import ImposedForce
from ..scene.meniscus import Meniscus
from ..scene.scenes import SeparationScene
from ..scene.surfaces import Flat
from ..separation.effects.meniscus import MeniscusForce
from ..separation.effects.viscous import TensionLimit, ViscousForce
from ..work_precision import Point
from .releases import release_cases, release_scene
from .separation import separation_sweep
from .timing import counts, cpu_seconds, run

__all__ = ["PRESETS", "film", "film_scene", "releases"]

PRESETS = {
    "draft": Accuracy.draft,
    "standard": Accuracy.standard,
    "reference": Accuracy.reference,
}
"""Settings of `Accuracy` by name."""


def film_scene(*effects: Any) -> SeparationScene:
    """The film of the README: a mass pulled off engine oil on a disc by a constant force."""
    face = Flat(radius=3.175e-3)
    film = Meniscus(liquid=load_liquid("engine-oil-15w-40"), volume=0.16e-9)
    return SeparationScene(
        interface=Interface(lower=face, upper=face, meniscus=film),
        loading=ImposedForce(initial_gap=5e-6, final_gap=25e-6, force=40.0, mass=0.02),
        effects=effects or (MeniscusForce(), ViscousForce(), TensionLimit(strength=1e6)),
    )


def film() -> list[Point]:
    """Error of the release time over the tolerance, by solver and by profile of the meniscus."""
    swept = separation_sweep(film_scene(), lambda done: None, clock=time.process_time)
    return list(swept.points)


def releases() -> list[Point]:
    """Error of the release time of the reference cases by the presets."""
    points = []
    for name, entry in release_cases().items():
        scene = release_scene(name)
        for label, accuracy in PRESETS.items():
            found = run(scene, accuracy)
            error = abs(found.state.release_time / entry["values"]["t_rel"] - 1.0)
            seconds = cpu_seconds(partial(run, scene, accuracy))
            points.append(Point(f"case {name}", label, error, seconds, counts(found)))
    return points
