"""Data of the page of a film: sliders, numbers of the kernel, tables, words."""

from __future__ import annotations

import math
import warnings
from collections.abc import Callable, Sequence
from typing import Any

import numpy as np
from attrs import asdict

from ..accuracy import Accuracy
from ..errors import PlanError
from ..files.scenes import scene_text, unstructure
from ..liquids.temperature_table import LiquidTable, liquid_table
from ..scene.loading import ImposedForce
from ..scene.scenes import SeparationScene
from ..separation.effects.base import FilmLimit, FilmStatus, SeparationForce
from ..separation.plan import Plan, plan
from ..separation.simulate import simulate
from ..separation.validity import path_of
from .assembly import file_name, packed, readable
from .family import Family, family_of
from .scene import KernelScene, check_scene, kernel_scene
from .sliders import Slider, family_sliders, sliders_of
from .validity import POINTS, Rules, checked, logs_of, rules_of

__all__ = [
    "Progress",
    "family_data",
    "film_data",
    "fmu_command",
    "force_parts",
    "given_family",
    "held",
    "kernel_data",
    "packed_numbers",
    "place_in",
    "slider_data",
    "words",
]

Progress = Callable[[float], None]

_FREE = {"viscosity": "eta", "surface_tension": "gamma"}
_INWARD = 0.2  # of the smallest first gap: as far as a mass may be drawn in


def film_data(
    scene: SeparationScene, accuracy: Accuracy | None, progress: Progress | None
) -> dict[str, Any]:
    """Return what the scripts of a page read.

    Raises
    ------
    PlanError
        If a page cannot carry the scene, with the reason and the cure.
    """
    scene, accuracy = check_scene(scene), accuracy or Accuracy.standard
    made = plan(scene, accuracy)
    if made.film.cavity is not None and not isinstance(scene.loading, ImposedForce):
        raise PlanError(
            "effects.tension-limit: with an imposed speed a live page has no cavity that is "
            'remembered; write cavity = "truncated", or impose a force'
        )
    kernel = kernel_scene(scene, accuracy)
    table = liquid_table(scene.meniscus.liquid)
    sliders = sliders_of(kernel, table)
    rules, span = _rules(made, sliders)
    family = given_family(kernel, family_sliders(kernel, table), accuracy, rules, span, progress)
    scene_text(scene, "the scene of the page")  # refuses what a file could not hold whole
    tables: dict[str, Any] = unstructure(scene)
    moved = (*sliders, *(family.sliders if isinstance(family, Family) else ()))
    return {
        "view": "film",
        "title": scene.name or "Opening of a liquid film",
        "name": file_name(scene.name),
        "imposed": scene.loading.imposed,
        **_loading(scene),
        "sliders": [slider_data(one, tables) for one in moved],
        "held": [*held(table, family), *_start_stays(kernel)],
        **kernel_data(kernel, accuracy, rules, span, family, table),
        "parts": force_parts(kernel.film.effects),
        "limits": " and ".join(
            effect.name for effect in scene.effects if isinstance(effect, FilmLimit)
        ),
        **words(made),
        "fmu": fmu_command(scene.name) if isinstance(scene.loading, ImposedForce) else "",
        "scene": tables,
    }


def kernel_data(
    kernel: KernelScene,
    accuracy: Accuracy,
    rules: Rules,
    span: tuple[float, float],
    family: Family | str,
    table: LiquidTable | None,
) -> dict[str, Any]:
    """Return what ``template/moved.js`` reads: numbers of the kernel and of validity, tables."""
    numbers = kernel.numbers()
    logs = logs_of(kernel.scene, accuracy, rules, span)
    return {
        "numbers": packed_numbers([*numbers, *logs]),
        "count": len(numbers),
        "family": family_data(family) if isinstance(family, Family) else None,
        "liquid": asdict(table) if table is not None else None,
        "properties": _properties(kernel),
        **_validity(rules),
    }


def _rules(made: Plan, sliders: tuple[Slider, ...]) -> tuple[Rules, tuple[float, float]]:
    """Numbers of validity that a page can evaluate, and the gaps their tables are over [m]."""
    scene, accuracy = made.scene, made.accuracy
    gaps = [scene.loading.initial_gap, scene.loading.final_gap]
    for slider in sliders:
        if slider.name in ("initial_gap", "final_gap"):
            gaps += [slider.low, slider.high]
    span = _INWARD * min(gaps), max(gaps)
    rules = rules_of(scene, accuracy, scene.loading.initial_gap)
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # the page says what is out of range
        result = simulate(made, throw=False)
    path = path_of(made, result.columns)
    logs = logs_of(scene, accuracy, rules, span)
    return checked(rules, logs, path, result.validity), span


def given_family(
    kernel: KernelScene,
    sliders: tuple[Slider, ...],
    accuracy: Accuracy,
    rules: Rules,
    span: tuple[float, float],
    progress: Progress | None,
) -> Family | str:
    """Tables over a grid; why there are none."""
    if not sliders:
        return ""
    return family_of(kernel, sliders, accuracy, rules, span, progress)


def _loading(scene: SeparationScene) -> dict[str, Any]:
    loading = scene.loading
    gaps = [loading.initial_gap, loading.final_gap]
    if not isinstance(loading, ImposedForce):
        return {"pull": {"force": 0.0, "rise": 0.0, "limit": 0.0}, "gaps": gaps}
    pull = {"force": loading.force, "rise": loading.rise_time, "limit": loading.time_limit}
    return {"pull": pull, "gaps": gaps}


def slider_data(slider: Slider, tables: dict[str, Any]) -> dict[str, Any]:
    """Return a slider as the page reads it, with the places of its fields in tables of a scene."""
    found = asdict(slider, filter=lambda attribute, _: attribute.name != "paths")
    places = [place_in(tables, path) for path in slider.paths]
    return {**found, "unit": readable(slider.unit), "places": places}


def place_in(tables: dict[str, Any], path: str) -> list[str | int]:
    """Keys of a path in the tables of a scene file."""
    first, *rest = path.split(".")
    if first == "effects":
        kinds = [effect["effect"] for effect in tables["effects"]]
        return ["effects", kinds.index(rest[0]), *rest[1:]]
    if "surface" in rest:  # of a body without a solid, which is written as its surface
        body = tables[first][rest[0]]
        if "surface" not in body:
            rest.remove("surface")
    return [first, *rest]


def held(table: LiquidTable | None, family: Family | str) -> list[str]:
    """Sentences on quantities that move, with their error, and on those that do not."""
    found = list[str]()
    if isinstance(family, Family):
        names = ", ".join(slider.label for slider in family.sliders)
        found.append(
            f"Moved through tables over a grid: {names}. Between the nodes the forces are within "
            f"{family.error:.1g} of themselves; at the start the page computes with the tables of "
            "the scene itself."
        )
    elif family:
        found.append(f"Geometry and contact angles stay as they are: {family}.")
    if table is not None:
        found.append(f"Properties over the temperature: within {table.error:.1g}.")
    return found


def _start_stays(kernel: KernelScene) -> list[str]:
    h0 = kernel.ports[kernel.reference("h0") - 1]
    stays = h0.minimum == h0.maximum
    return ["The gap at the start stays: the radius of this film belongs to it."] if stays else []


def family_data(family: Family) -> dict[str, Any]:
    """Return tables over a grid as ``template/tables.js`` reads them."""
    return {
        "sliders": [slider.name for slider in family.sliders],
        "nodes": [nodes.tolist() for nodes in family.nodes],
        "columns": family.columns.tolist(),
        "logs": [int(one) for one in family.logs],
        "base": packed(family.base.astype("<f8").tobytes()),
        "changes": packed(family.changes.astype("<f4").tobytes()),
        "count": family.count,
        "error": family.error,
    }


def _properties(kernel: KernelScene) -> list[dict[str, Any]]:
    """Properties of the liquid that are variables of the kernel, with their values at the start."""
    return [
        {"name": name, "reference": kernel.reference(port), "value": kernel.start[port]}
        for name, port in _FREE.items()
        if kernel.start.get(port)
    ]


def _validity(rules: Rules) -> dict[str, Any]:
    def bounded(value: float) -> float | None:
        return value if math.isfinite(value) else None

    return {
        "rules": [
            {**asdict(rule), "low": bounded(rule.low), "high": bounded(rule.high)}
            for rule in rules.rules
        ],
        "missing": dict(rules.missing),
        "points": 2 * POINTS,
    }


def force_parts(laws: Sequence[type[SeparationForce]]) -> list[dict[str, Any]]:
    """Each force of the film and the solids, with the laws of the kernel that it is the sum of."""
    return [
        {
            "label": effect.column.label,
            "name": effect.column.name,
            "laws": [i for i, law in enumerate(laws) if law is effect],
        }
        for effect in dict.fromkeys(laws)
    ]


def fmu_command(title: str) -> str:
    """Command that makes the FMU of a scene that was saved."""
    name = file_name(title)
    return f"contactkit fmu build {name}.toml --native --out {name}.fmu"


def words(made: Plan) -> dict[str, Any]:
    """Return names of forces, and which effects are on and off."""
    scene = made.scene
    off = [kind for kind in made.known_effects if not made.has(kind)]
    return {
        "cavitates": made.film.cavity is not None,
        "broken": int(FilmStatus.BROKEN),
        "on": [f"{effect.name}: {effect.summary}" for effect in scene.effects],
        "off": [f"{kind.name}: {kind.summary}" for kind in off],
    }


def packed_numbers(numbers: Sequence[float]) -> str:
    """Numbers as text, compressed."""
    return packed(np.array(numbers, dtype="<f8").tobytes())
