"""Accuracy of separations: release times of films, FMUs over steps, laws of menisci."""

from __future__ import annotations

import math
import tempfile
from collections.abc import Callable, Mapping
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np
from attrs import evolve

from ..capillary.exact import pressure_branch, stability
from ..capillary.exact.bridge import bridge, bridge_at_pressure
from ..capillary.flats import family, force_law
from ..files.scenes import load_liquid
from ..fmu.framework.instance import Instance
from ..fmu.python.build import build
from ..fmu.slaves.stiction_mass import MeniscusLaw
from ..planning import plan
from ..scene.interface import Interface
from ..scene.loading import ImposedForce, ImposedSpeed
from ..scene.meniscus import Meniscus
from ..scene.scenes import SeparationScene
from ..scene.surfaces import Flat, Sphere
from ..separation.effects.meniscus import MeniscusForce
from ..separation.effects.viscous import TensionLimit, ViscousForce
from ..work_precision import Point
from .releases import release_cases, release_scene
from .separation import separation_sweep
from .timing import PRESETS, counts, cpu_seconds, run, timed

__all__ = ["film", "film_scene", "fmu_releases", "laws", "releases"]


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
    return list(separation_sweep(film_scene(), lambda done: None).points)


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


def fmu_releases() -> list[Point]:
    """Release time of the reference cases by ``stiction-mass``, over the steps of its host."""
    points = []
    with tempfile.TemporaryDirectory(prefix="contactkit-") as folder:
        fmu = build("stiction-mass", Path(folder) / "stiction-mass.fmu")
        _hosted(fmu, release_cases()["A"]["case"], 1e-3, 1)  # loads what is loaded once
        for name, entry in release_cases().items():
            exact = entry["values"]["t_rel"]
            for n in (1, 10, 100, 1000, 10_000):
                found, seconds = timed(partial(_hosted, fmu, entry["case"], 1.2 * exact, n), 0.0)
                error = math.nan if found < 0.0 else abs(found / exact - 1.0)
                label = f"{n} step" + "s" * (n > 1)
                points.append(Point(f"case {name}", label, error, seconds, {}))
    return points


def _hosted(fmu: Path, case: Mapping[str, Any], stop: float, n: int) -> float:
    """Release time [s] that the FMU finds in n steps; -1 if none. A straight pull in each."""

    def pull(at: float) -> float:
        return float(case["F0"] * (-math.expm1(-at / case["tau"]) if case["tau"] else 1.0))

    same = ("h0", "R", "eta", "gamma", "V", "m", "k_s", "h_rel", "dp_cav", "tau_lim")
    law = {"meniscus_law": MeniscusLaw.PUBLISHED, "theta1": case["theta"], "theta2": case["theta"]}
    with Instance(fmu) as one:
        one.start({name: case[name] for name in same} | law, stop)
        inputs, length = one.references("F_ext", "dF_ext"), stop / n
        for i in range(n):
            begin, end = pull(i * length), pull((i + 1) * length)
            one.set(inputs, [begin, (end - begin) / length])
            one.step(i * length, length)
        return float(one.get(one.references("t_release"))[0])


def laws() -> list[Point]:
    """Force of the meniscus in a motion: set-up of its law, one evaluation, error at 200 gaps.

    The law is made as in a fresh process, then called one gap at a time.
    """
    points = []
    for name, scene in _menisci().items():
        at_pressure = scene.meniscus.has_pressure
        end = plan(scene).film.laws[MeniscusForce].end
        gaps = np.geomspace(5e-10, 0.999 * min(end, 1e-7), 200)
        right = _bridges(scene, gaps)
        for profile in ("exact",) if at_pressure else ("exact", "arc"):
            one = evolve(scene, effects=(MeniscusForce(profile=profile),))
            made, first = timed(partial(_made, one), 0.5)
            law = made.film.laws[MeniscusForce]
            found, seconds = timed(partial(_called, law.force, gaps.tolist()), 0.1)
            error = float(np.max(np.abs(np.array(found) / right - 1.0)))
            is_model = profile != "exact"
            both = {"set-up": first, "one evaluation": seconds / len(gaps)}
            points += [
                Point(profile, f"{name}: {what}", error, cost, {}, is_model=is_model)
                for what, cost in both.items()
            ]
    return points


def _called(force: Callable[[float, float], float], gaps: list[float]) -> list[float]:
    return [force(gap, 0.0) for gap in gaps]


def _made(scene: SeparationScene) -> Any:
    """Plan of a scene without what earlier bridges left in caches."""
    for module in (force_law, family, stability, pressure_branch):
        for made in vars(module).values():
            if hasattr(made, "cache_clear"):
                made.cache_clear()
    return plan(scene)


def _menisci() -> dict[str, SeparationScene]:
    """A film and two bridges on a sphere, with water at 60 degrees."""
    water, angle = load_liquid("water"), math.radians(60.0)
    free = Meniscus(
        liquid=water, volume=2e-21, contact_angle_lower=angle, contact_angle_upper=angle
    )
    tip = Sphere(radius=1e-7)
    moist = evolve(free, volume=None, relative_humidity=0.5)
    bodies = {
        "flats": Interface(meniscus=free),
        "sphere": Interface(upper=tip, meniscus=evolve(free, volume=1e-24)),
        "sphere, humidity of 50 %": Interface(upper=tip, meniscus=moist),
    }
    loading = ImposedSpeed(initial_gap=5e-10, final_gap=1e-7, speed=1e-6)
    return {
        name: SeparationScene(interface=one, loading=loading, effects=(MeniscusForce(),))
        for name, one in bodies.items()
    }


def _bridges(scene: SeparationScene, gaps: Any) -> Any:
    """Exact forces [N] at gaps [m], each bridge solved by itself."""
    interface, meniscus = scene.interface, scene.meniscus
    tension = meniscus.liquid.at(scene.temperature).surface_tension
    assert tension is not None
    pressure = meniscus.pressure_at(scene.temperature)
    angles = meniscus.contact_angle_lower, meniscus.contact_angle_upper
    shape = (*angles, *interface.curvatures)
    if pressure is not None:
        return tension * bridge_at_pressure(gaps, pressure / tension, *shape).force
    assert meniscus.volume is not None
    return tension * bridge(gaps, meniscus.volume, *shape).force
