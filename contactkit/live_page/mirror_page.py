"""Data of the page of a micromirror: its tips and their water, its mirror.

The tips are the model ``tip-contact`` of the native FMUs; mirror and electrodes are in
``kernel/mirror.c``. What moves are the assumptions of `models.micromirror.assumptions`. The water
that condenses under a landed tip, and the law of its separation, are tabulated over a grid.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any

import numpy as np
from attrs import evolve, frozen

from ..accuracy import Accuracy
from ..capillary.kelvin import kelvin_radius
from ..errors import PlanError
from ..files.scenes import unstructure
from ..fmu.framework.ports import NATIVE_STEPS, STEP_LIMIT, Port, Value
from ..fmu.native.data import contents_of
from ..fmu.native.film import PreparedFilm, prepared_film
from ..fmu.native.records import FilmTables
from ..fmu.native.tables import Tabulate, tabulate
from ..fmu.native.tip import tip_ports
from ..fmu.slaves.tip_contact import TipContact, tip_values
from ..models.micromirror.assumptions import NAMES, RANGES
from ..models.micromirror.scene import MicromirrorScene
from ..models.micromirror.tip_film import adhesion, condensate_validity, tip_law, tip_scene
from ..separation.effects.adhesion import VanDerWaalsForce
from ..separation.effects.base import FilmStatus
from ..studies.paths import axes, changed, value_at
from .assembly import file_name
from .family import Family, Nodes, tabulated
from .film_page import (
    Progress,
    family_data,
    fmu_command,
    force_parts,
    held,
    packed_numbers,
    slider_data,
    words,
)
from .sliders import Slider, with_unit

__all__ = ["PARAMETERS", "mirror_data"]

PARAMETERS = (
    *("hinge.inertia", "hinge.stiffness", "hinge.damping"),
    *("electrode.width", "electrode.inner", "electrode.outer", "electrode.gap"),
    *("tips.arm", "tips.landing_tilt"),
    *("waveform.bias_voltage", "waveform.address_voltage"),
    *("waveform.reset_voltage", "waveform.reset_time"),
)
"""Fields of a `Mirror` in the order of their numbers in ``kernel/mirror.c``."""

_HUMIDITY, _HAMAKER = "study.humidity", "effects.van-der-waals-force.hamaker_constant"
_ATTRACTION = _HAMAKER.replace(".", "_")  # name of its slider
_OF_TIP = {"loading.stiffness": "k", "loading.mass": "m", "mirror.tips.damping": "c"}
_RADIUS = "interface.upper.surface.radius"
# What the tables over a grid hold. Steeper angles than 80 degrees keep the tip dry.
_GRID = (_HUMIDITY, _RADIUS, "contact_angle", "initial_gap")
_STEEPEST = math.radians(80.0)
_WET = (0.1, 0.95)
_WIDE = 3.0  # ratio of the ends of a range from which on a slider moves along the logarithm
_RTOL = 1e-7  # of the motion of a tip, as `tip_law` has it
_TIP, _MIRROR, _MORE = "", "Voltages and electrodes", "Hinge and damping"


@frozen
class _Tip:
    """Tables of the tip of a mirror, and the numbers of its model."""

    scene: MicromirrorScene
    film: PreparedFilm
    ports: tuple[Port, ...]

    def numbers(self, scene: MicromirrorScene, tables: FilmTables) -> list[float]:
        """Numbers of the model of the tips of a side of a mirror."""
        values: dict[str, Value] = TipContact.start_values()
        values |= tip_values(tip_scene(scene.tip, scene.study.humidity))
        tips = scene.mirror.tips
        values |= {"N": tips.per_side, "c": tips.damping, "rtol": _RTOL, STEP_LIMIT: NATIVE_STEPS}
        start = {port.name: values[port.name] for port in self.ports}
        return contents_of("tip-contact", self.ports, start, tables).numbers()

    def reference(self, name: str) -> int:
        """Value reference of a variable; 0 if there is none."""
        names = [port.name for port in self.ports]
        return names.index(name) + 1 if name in names else 0


def mirror_data(
    scene: MicromirrorScene, accuracy: Accuracy | None, progress: Progress | None
) -> dict[str, Any]:
    """Return what the scripts of a page read.

    Raises
    ------
    PlanError
        If the sites deform, or the tips are dry at the humidity of the runs.
    """
    accuracy = accuracy or Accuracy.standard
    if scene.mirror.tips.faces is not None:
        raise PlanError(
            "mirror.tips.faces: a live page has rigid landing sites; leave the faces out, or run "
            "the mirror by contactkit run"
        )
    humidity = scene.study.humidity
    _more(scene)  # refuses a dry tip
    tip = _tip(scene)
    family = _family(tip, accuracy, progress)
    grid = family.sliders if isinstance(family, Family) else ()
    attraction = _hamaker(tip, family, accuracy)
    moved = [*((one, _TIP) for one in grid), *_assumed(scene)]
    if attraction is None:
        moved = [one for one in moved if one[0].name != _ATTRACTION]
    tables: dict[str, Any] = {"device": "micromirror", **unstructure(scene)}
    numbers = tip.numbers(scene, tip.film.tables)
    waveform, study = scene.mirror.waveform, scene.study
    made = tip_law(scene.tip, humidity)
    return {
        "view": "mirror",
        "title": scene.name,
        "name": file_name(scene.name),
        "sliders": [_data(tip, one, group, tables) for one, group in sorted(moved, key=_rank)],
        "held": [*held(None, family), *_HELD],
        "numbers": packed_numbers([*numbers, *_more(scene)]),
        "count": len(numbers),
        "family": family_data(family) if isinstance(family, Family) else None,
        "hamaker": attraction,
        "mirror": [float(value_at(scene.mirror, Accuracy(), path)) for path in PARAMETERS],
        "properties": [],
        "rules": [_kelvin(scene)],
        "missing": {},
        "points": 0,
        "liquid": None,
        "parts": force_parts(tip.film.effects),
        "references": {name: tip.reference(name) for name in ("gamma", "eta", "h0", "N")},
        "run": {
            "wait": study.patience,
            "step": study.communication_step,
            "largest": study.largest_reset,
            "free": scene.loading.final_gap,
            "sign": -1.0 if waveform.bias_voltage < 0.0 else 1.0,
        },
        **words(made),
        "broken": int(FilmStatus.BROKEN),
        "fmu": fmu_command(scene.name),
        "scene": tables,
    }


_HELD = (
    "Mirror and tips are coupled in the communication steps of the device, and give its release "
    "to the step. The temperature stays: build the page again by --set temperature=...",
)


def _film(
    scene: MicromirrorScene, make: Tabulate, accuracy: Accuracy | None = None
) -> PreparedFilm:
    tip = tip_scene(scene.tip, scene.study.humidity)
    return prepared_film(tip, make=make) if accuracy is None else prepared_film(tip, accuracy, make)


def _tip(scene: MicromirrorScene) -> _Tip:
    film = _film(scene, tabulate)
    return _Tip(scene, film, tip_ports(film))


def _more(scene: MicromirrorScene) -> list[float]:
    """Logarithm of the Kelvin radius.

    Raises
    ------
    PlanError
        If nothing condenses.
    """
    humidity, liquid = scene.study.humidity, scene.tip.meniscus.liquid
    if not tip_scene(scene.tip, humidity).meniscus.volume:
        raise PlanError(
            f"study.humidity = {humidity:g}: nothing condenses under a tip, and a live page moves "
            "what does; give more humidity, or a smaller contact angle"
        )
    tension, molar = (
        liquid.at(scene.temperature).surface_tension,
        liquid.molar_volume(scene.temperature),
    )
    return [math.log(float(kelvin_radius(tension, molar, scene.temperature, humidity)))]


def _kelvin(scene: MicromirrorScene) -> dict[str, Any]:
    (one,) = condensate_validity([adhesion(scene.tip, scene.study.humidity)])
    return {"name": one.name, "low": one.low, "high": None, "detail": one.detail}


def _family(tip: _Tip, accuracy: Accuracy, progress: Progress | None) -> Family | str:
    scene = tip.scene
    return tabulated(_nodes(tip, scene, accuracy), _grid(scene), scene.loading.final_gap, progress)


def _nodes(tip: _Tip, scene: MicromirrorScene, accuracy: Accuracy) -> Nodes:
    return Nodes(
        scene,
        tip.film.tables,
        lambda other, make: _film(other, make, accuracy).tables,
        tip.numbers,
        _more,
    )


def _hamaker(tip: _Tip, family: Family | str, accuracy: Accuracy) -> dict[str, Any] | None:
    """Runs of numbers that are proportional to the Hamaker constant: [first, count]."""
    effect = tip.scene.tip.effect(VanDerWaalsForce)
    if effect is None:
        return None
    double = changed(tip.scene, None, {_HAMAKER: 2.0 * effect.hamaker_constant}).scene
    plain = np.array(tip.numbers(tip.scene, tip.film.tables))
    other = np.array(tip.numbers(double, _film(double, tabulate).tables))
    if len(plain) != len(other):
        return None
    found = {"name": _ATTRACTION, "scene": _runs(0.5 * other == plain, plain), "family": []}
    if isinstance(family, Family):
        grid = _nodes(tip, double, accuracy).numbers(double)
        if len(grid) != len(family.base):
            return None
        found["family"] = _runs(0.5 * grid == family.base, family.base)
    return found


def _runs(doubled: Any, of: Any) -> list[list[int]]:
    places = np.flatnonzero(doubled & (of != 0.0))
    breaks = np.flatnonzero(np.diff(places) > 1)
    firsts = [0, *(breaks + 1).tolist()]
    lasts = [*breaks.tolist(), len(places) - 1]
    return [
        [int(places[a]), int(places[b] - places[a] + 1)] for a, b in zip(firsts, lasts, strict=True)
    ]


# Sliders --------------------------------------------------------------------------------------


def _rank(one: tuple[Slider, str]) -> int:
    return (_TIP, _MIRROR, _MORE).index(one[1])


def _of_range(scene: MicromirrorScene, paths: str, **more: Any) -> Slider:
    given = RANGES[paths]
    (axis,) = axes(scene, Accuracy(), {paths: [given.low, given.high]})
    value = float(value_at(scene, Accuracy(), axis.paths[0]))
    low, high = sorted((float(axis.values[0][0]), float(axis.values[-1][0])))
    low, high = min(low, value), max(high, value)
    slider = Slider(
        name=axis.paths[0].removeprefix("mirror.").replace(".", "_"),
        paths=axis.paths,
        label=NAMES[paths],
        value=value,
        low=low,
        high=high,
        by="device",
        scale="log" if low > 0.0 and high > _WIDE * low else "linear",
    )
    return with_unit(evolve(slider, **more), axis.units[0])


def _grid(scene: MicromirrorScene) -> tuple[Slider, ...]:
    """Sliders that tables over a grid hold."""
    humidity = scene.study.humidity
    found = [
        with_unit(
            Slider(
                name="humidity",
                paths=(_HUMIDITY,),
                label="relative humidity",
                value=humidity,
                low=min(_WET[0], humidity),
                high=max(_WET[1], humidity),
                by="family",
                scale="kelvin",
            ),
            "-",
        )
    ]
    for paths in RANGES:
        if paths == _RADIUS:
            found.append(_of_range(scene, paths, by="family", name="radius", scale="log"))
        elif "contact_angle" in paths:
            steep = _of_range(scene, paths, by="family", name="angle", scale="angle")
            found.append(evolve(steep, low=0.0, high=max(steep.value, _STEEPEST)))
        elif "initial_gap" in paths:
            found.append(_of_range(scene, paths, by="family", name="gap", scale="log"))
    return tuple(found)


def _assumed(scene: MicromirrorScene) -> list[tuple[Slider, str]]:
    """What is assumed of tips, mirror and electrodes, and the reset pulse."""
    found = []
    for paths in RANGES:
        if paths == _HAMAKER:
            if scene.tip.effect(VanDerWaalsForce) is not None:
                found.append((_of_range(scene, paths), _TIP))
        elif paths in _OF_TIP or paths.startswith("mirror."):
            first = paths == "loading.stiffness"
            electric = "electrode" in paths or "voltage" in paths or "reset" in paths
            group = _TIP if first else _MIRROR if electric else _MORE
            found.append((_of_range(scene, paths), group))
    reset = abs(scene.mirror.waveform.reset_voltage)
    slider = Slider(
        name="reset",
        paths=(),
        label="reset pulse; 0: none",
        value=reset,
        low=0.0,
        high=max(scene.study.largest_reset, reset),
        by="device",
        scale="linear",
        unit="V",
    )
    return [*found, (slider, _TIP)]


def _data(tip: _Tip, slider: Slider, group: str, tables: dict[str, Any]) -> dict[str, Any]:
    targets = _targets(tip, slider.paths) if slider.by == "device" else []
    return {**slider_data(slider, tables), "group": group, "targets": targets}


def _targets(tip: _Tip, paths: Sequence[str]) -> list[list[Any]]:
    """Model and number of what a slider sets, and nothing that is added."""
    found = list[list[Any]]()
    for path in paths:
        if path in _OF_TIP:
            found.append(["tip", tip.reference(_OF_TIP[path]), 0.0])
        elif path.startswith("mirror."):
            found.append(["mirror", PARAMETERS.index(path.removeprefix("mirror.")), 0.0])
    return found
