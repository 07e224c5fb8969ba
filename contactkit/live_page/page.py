"""Live pages: a scene as one HTML file that computes in the browser."""

from __future__ import annotations

import base64
import gzip
import json
import math
import re
import warnings
from collections.abc import Callable
from html import escape
from os import PathLike
from pathlib import Path
from typing import Any

import numpy as np
from attrs import asdict

from .._version import __version__
from ..accuracy import Accuracy
from ..errors import PlanError
from ..extras import require
from ..files.scenes import scene_text, unstructure, write_whole
from ..liquids.temperature_table import LiquidTable, liquid_table
from ..scene.loading import ImposedForce
from ..scene.scenes import SeparationScene
from ..separation.effects.base import FilmStatus
from ..separation.effects.viscous import ViscousForce
from ..separation.plan import Plan, plan
from ..separation.simulate import simulate
from ..separation.validity import path_of
from .family import Family, family_of
from .module import kernel_module
from .scene import KernelScene, check_scene, kernel_scene
from .sliders import Slider, family_sliders, sliders_of
from .validity import POINTS, Rules, checked, logs_of, rules_of

__all__ = ["live_page", "page_data", "write_page"]

Progress = Callable[[float], None]

_SCRIPTS = ("page.css", "tables.js", "kernel.js", "chart.js", "page.js")
_FREE = {"viscosity": "eta", "surface_tension": "gamma"}
_INWARD = 0.2  # of the smallest first gap: as far as a mass may be drawn in


def write_page(
    scene: SeparationScene,
    out: str | PathLike[str],
    *,
    accuracy: Accuracy | None = None,
    progress: Progress | None = None,
) -> Path:
    """Write a scene as one HTML file that computes in the browser.

    The page runs the C kernel of the native FMUs as WebAssembly: no network, no server, no script
    from elsewhere. What the kernel has as a variable is computed as a run of the scene is;
    geometry, contact angles and humidity move through tables over a grid, whose error the page
    states.

    Parameters
    ----------
    scene : SeparationScene
        With an imposed force and a mass, or an imposed speed.
    out : path
        The file to write, ``*.html``; whole or not at all.
    accuracy : Accuracy, optional
        Tolerance of the motion, and of the film on a face; `Accuracy.standard` if not given.
    progress : callable, optional
        Called with the fraction that is done.

    Returns
    -------
    Path
        The file.

    Raises
    ------
    PlanError
        If a page cannot carry the scene, with the reason and the cure.
    MissingExtraError
        If ziglang is not installed (``pip install contactkit[native]``).
    """
    text = live_page(scene, accuracy, progress)
    with write_whole(Path(out)) as temporary:
        temporary.write_text(text, encoding="utf-8")
    return Path(out)


def live_page(
    scene: SeparationScene, accuracy: Accuracy | None = None, progress: Progress | None = None
) -> str:
    """Return the text of the page of a scene; see `write_page`."""
    checked_scene = check_scene(scene)  # a scene that no page carries needs no compiler
    require("ziglang", "a live page, whose kernel is compiled to WebAssembly,")
    data = page_data(checked_scene, accuracy, progress)
    folder = Path(__file__).with_name("template")
    made_by = f"contactkit {__version__}"
    parts = {
        "title": escape(data["title"]),
        "generator": escape(made_by),
        "foot": escape(f"{made_by}; the kernel runs in this page, and nothing is sent anywhere"),
        # No text of a scene ends the script that holds it.
        "data": json.dumps(data, allow_nan=False, ensure_ascii=False).replace("<", "\\u003c"),
        "kernel": packed(kernel_module()),
        **{name: (folder / name).read_text("utf-8") for name in _SCRIPTS},
    }
    page = (folder / "page.html").read_text("utf-8")
    return re.sub(r"\{\{([\w.]+)\}\}", lambda match: parts[match[1]], page)


def packed(content: bytes) -> str:
    """Bytes as text, compressed; the same every time."""
    return base64.b64encode(gzip.compress(content, 9, mtime=0)).decode("ascii")


def page_data(
    scene: SeparationScene, accuracy: Accuracy | None = None, progress: Progress | None = None
) -> dict[str, Any]:
    """Return what the scripts of a page read: sliders, numbers of the kernel, tables, words."""
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
    family = _family(kernel, family_sliders(kernel, table), rules, span, accuracy, progress)
    moved = family.sliders if isinstance(family, Family) else ()
    logs = logs_of(scene, accuracy, rules, span)
    numbers = kernel.numbers()
    scene_text(scene, "the scene of the page")  # refuses what a file could not hold whole
    tables: dict[str, Any] = unstructure(scene)
    return {
        "title": scene.name or "Opening of a liquid film",
        "name": _file_name(scene.name),
        "imposed": scene.loading.imposed,
        **_loading(scene),
        "sliders": [_slider(one, tables) for one in (*sliders, *moved)],
        "held": _held(kernel, table, family),
        "numbers": packed(np.array([*numbers, *logs], dtype="<f8").tobytes()),
        "count": len(numbers),
        "family": _family_data(family) if isinstance(family, Family) else None,
        "liquid": asdict(table) if table is not None else None,
        "properties": _properties(kernel),
        **_validity(rules),
        **_words(made),
        "scene": tables,
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


def _family(
    kernel: KernelScene,
    sliders: tuple[Slider, ...],
    rules: Rules,
    span: tuple[float, float],
    accuracy: Accuracy,
    progress: Progress | None,
) -> Family | str:
    """Tables over a grid; why there are none."""
    if not sliders:
        return ""
    return family_of(kernel, sliders, accuracy, rules, span, progress)


def _file_name(title: str) -> str:
    return re.sub(r"[^a-z0-9]+", "-", title.lower()).strip("-") or "film"


def _loading(scene: SeparationScene) -> dict[str, Any]:
    loading = scene.loading
    gaps = [loading.initial_gap, loading.final_gap]
    if not isinstance(loading, ImposedForce):
        return {"pull": {"force": 0.0, "rise": 0.0, "limit": 0.0}, "gaps": gaps}
    pull = {"force": loading.force, "rise": loading.rise_time, "limit": loading.time_limit}
    return {"pull": pull, "gaps": gaps}


def _slider(slider: Slider, tables: dict[str, Any]) -> dict[str, Any]:
    found = asdict(slider, filter=lambda attribute, _: attribute.name != "paths")
    places = [_place_in(tables, path) for path in slider.paths]
    return {**found, "unit": readable(slider.unit), "places": places}


def _place_in(tables: dict[str, Any], path: str) -> list[str | int]:
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


def readable(unit: str) -> str:
    """A unit as it is printed: um is \u00b5m, m3 is m\u00b3."""
    text = (
        re.sub(r"\bu(?=[a-zA-Z])", "\u00b5", unit).replace("deg", "\u00b0").replace(".", "\u00b7")
    )
    return "" if text == "-" else text.replace("2", "\u00b2").replace("3", "\u00b3")


def _held(kernel: KernelScene, table: LiquidTable | None, family: Family | str) -> list[str]:
    """What moves with which error, and what does not move, in sentences."""
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
    h0 = kernel.ports[kernel.reference("h0") - 1]
    if h0.minimum == h0.maximum:
        found.append("The gap at the start stays: the radius of this film belongs to it.")
    return found


def _family_data(family: Family) -> dict[str, Any]:
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


def _words(made: Plan) -> dict[str, Any]:
    scene, forces = made.scene, made.forces
    names = [force.label for force in forces if force.name != ViscousForce.column.name]
    off = [kind for kind in made.known_effects if not made.has(kind)]
    return {
        "parts": {
            "static": " and ".join(names),
            "viscous": ViscousForce.column.label if made.has(ViscousForce) else "",
        },
        "cavitates": made.film.cavity is not None,
        "broken": int(FilmStatus.BROKEN),
        "on": [f"{effect.name}: {effect.summary}" for effect in scene.effects],
        "off": [f"{kind.name}: {kind.summary}" for kind in off],
        "fmu": f"contactkit fmu build {_file_name(scene.name)}.toml --native --out "
        f"{_file_name(scene.name)}.fmu",
    }
