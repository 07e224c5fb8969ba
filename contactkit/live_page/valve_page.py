"""Data of the page of an injector: its film, its valve, and what is assumed of both.

Film and valve are the models ``stiction-mass`` and ``valve-drive`` of the native FMUs, coupled in
the page by ``kernel/valve.c``. What moves are the assumptions of `models.injector.assumptions`,
over the ranges that are plausible there.
"""

from __future__ import annotations

import math
import warnings
from collections.abc import Iterator
from typing import Any, NamedTuple

from attrs import frozen

from ..accuracy import Accuracy
from ..files.scenes import unstructure
from ..fmu.framework.ports import Value
from ..fmu.native.data import contents_of
from ..fmu.native.faces import faces_of
from ..fmu.native.models import native_model
from ..fmu.slaves.valve_drive import PLACES, ValveDrive, drive_values
from ..liquids.temperature_table import LiquidTable, liquid_table
from ..models.injector.assumptions import NAMES, RANGES
from ..models.injector.monolithic import simulate
from ..models.injector.scene import InjectorScene, end_stop_faces
from ..separation.effects.viscous import TensionLimit
from ..separation.plan import Plan, plan
from ..studies.paths import axes, value_at
from ..units import bar
from .assembly import file_name
from .family import Family
from .film_page import (
    Progress,
    fmu_command,
    given_family,
    held,
    kernel_data,
    packed_numbers,
    slider_data,
    words,
)
from .scene import KernelScene, kernel_scene
from .sliders import Slider, family_sliders, sliders_of, with_unit
from .validity import Rules, checked, logs_of, rules_of

__all__ = ["drive_numbers", "valve_data"]

_WIDE = 3.0  # ratio of the ends of a range from which on a slider moves along the logarithm
_LONGEST_STEP = 5e-6  # [s] between film and valve: what the page states of its error
_INWARD = 0.2  # of the gap when closed: down to which numbers of validity are tabulated
_PRESSURES = (1.0 * bar, 30.0 * bar)  # absolute, over which the page shows the delay
_CAVITIES = (-15.0 * bar, 0.9 * bar)
_FIRST = {
    *("loading.mass", "valve.spring.preload", "valve.coil.resistance"),
    *("valve.profile.boost_voltage", "valve.coil.air_gap"),
}
_OIL_GROUP, _VALVE, _MORE = "", "Valve", "More about the valve"


class Target(NamedTuple):
    """Variable of a model that a slider sets: value reference, and what is added to its value."""

    model: str  # "film" or "drive"
    reference: int
    offset: float


@frozen(kw_only=True)
class _Moved:
    """A slider, what it sets, and what is added to its value in each of its fields."""

    slider: Slider
    group: str
    targets: tuple[Target, ...] = ()
    offsets: tuple[float, ...] = ()
    is_whole: bool = False


def valve_data(
    scene: InjectorScene, accuracy: Accuracy | None, progress: Progress | None
) -> dict[str, Any]:
    """Return what the scripts of a page read.

    Raises
    ------
    ContactkitError
        If the film of the injector cannot be planned, or has no native form.
    """
    accuracy = accuracy or Accuracy.standard
    film = scene.separation(scene.temperature)
    made, kernel = plan(film, accuracy), kernel_scene(film, accuracy)
    table = liquid_table(film.meniscus.liquid)
    span = _INWARD * film.loading.initial_gap, 2.0 * scene.valve.stop.gap
    rules = _rules(scene, made, span)
    faces = family_sliders(kernel, table)
    family = given_family(kernel, faces, accuracy, rules, span, progress)
    tables: dict[str, Any] = {"device": "fuel-injector", **unstructure(scene)}
    moved = [*_tensions(scene), *_of_film(kernel, table), *_assumed(scene, kernel)]
    if isinstance(family, Family):
        moved += [_Moved(slider=one, group=_OIL_GROUP) for one in family.sliders]
    moved.sort(key=lambda one: (_OIL_GROUP, _VALVE, _MORE).index(one.group))
    return {
        "view": "valve",
        "title": scene.name,
        "name": file_name(scene.name),
        "sliders": [_data(one, tables) for one in moved],
        "held": [*held(table, family), _HELD],
        **kernel_data(kernel, accuracy, rules, span, family, table),
        "drive": packed_numbers(drive_numbers(scene)),
        "step": min(scene.study.communication_step, _LONGEST_STEP),
        **_cycle(scene, kernel, table),
        **words(made),
        "fmu": fmu_command(scene.name),
        "scene": tables,
    }


_HELD = (
    "Film and valve are coupled in steps of 5 \u00b5s at most, as their two FMUs are: it opens "
    "within 1e-4, and closes within 2 \u00b5s, of what one set of equations gives. "
    "Time begins with the pulse."
)


def _cycle(scene: InjectorScene, kernel: KernelScene, table: LiquidTable | None) -> dict[str, Any]:
    """Times, gaps and pressures of the curves, and what stands for a film that is none."""
    profile, loading = scene.valve.profile, scene.loading
    low, high = min(scene.study.temperatures), max(scene.study.temperatures)
    names = ("dp_inception", "dp_hold", "eta", "dp_cav")
    return {
        "times": {"pulse": profile.on_time, "cycle": profile.period},
        "gaps": {
            "rest": loading.rest_gap,
            "release": loading.final_gap,
            "stop": scene.valve.stop.gap,
        },
        "pressures": _PRESSURES if _is_remembered(scene) else (),
        "temperatures": (low, high) if table is not None else (),
        "references": {name: kernel.reference(name) for name in names},
        "limit": [effect.name for effect in scene.effects].index(TensionLimit.name)
        if _is_remembered(scene)
        else -1,
    }


def drive_numbers(scene: InjectorScene) -> list[float]:
    """Numbers of the model of the drive, which is energised at once."""
    values: dict[str, Value] = ValveDrive.start_values() | drive_values(scene.valve)
    ValveDrive.check_start(values)
    curve = end_stop_faces(scene.valve)
    faces = None if curve is None else faces_of(curve)
    ports = native_model("valve-drive").ports
    return contents_of("valve-drive", ports, values | {"t_delay": 0.0}, faces=faces).numbers()


def _rules(scene: InjectorScene, made: Plan, span: tuple[float, float]) -> Rules:
    """Numbers of validity, checked along the first opening by the monolithic model."""
    film, accuracy = made.scene, made.accuracy
    rules = rules_of(film, accuracy, film.loading.initial_gap)
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # the page says what is out of range
        motion = simulate(made, scene.valve, scene.first_pulse_end, rtol=1e-6)
        path = [*zip(motion["gap"].tolist(), motion["speed"].tolist(), strict=True)]
        found = made.validity(path)
    return checked(rules, logs_of(film, accuracy, rules, span), path, found)


# Sliders --------------------------------------------------------------------------------------


def _is_remembered(scene: InjectorScene) -> bool:
    """Whether the film has a cavity, of a pressure of its own."""
    limit = scene.tension_limit
    return limit is not None and limit.cavity == "mass-conserving" and math.isfinite(limit.tension)


def _tensions(scene: InjectorScene) -> Iterator[_Moved]:
    """Absolute pressures around the face and in the cavity, and the tension of inception."""
    limit = scene.tension_limit
    if limit is None or not _is_remembered(scene):
        return
    around, inside = limit.ambient_pressure, limit.pressure_in_cavity
    bears = limit.tension - around
    rows = (
        ("ambient", "pressure of the oil around the face", around, *_PRESSURES, "log"),
        (
            "tension",
            "tension at which the oil cavitates, absolute",
            bears,
            0.0,
            30.0 * bar,
            "linear",
        ),
        ("cavity", "pressure in the cavity", inside, *_CAVITIES, "linear"),
    )
    for name, label, value, low, high, scale in rows:
        slider = Slider(
            name=name,
            paths=(),
            label=label,
            value=value,
            low=min(low, value),
            high=max(high, value),
            by="device",
            scale="log" if scale == "log" else "linear",
            unit="bar",
            factor=bar,
        )
        yield _Moved(slider=slider, group=_OIL_GROUP)


def _of_film(kernel: KernelScene, table: LiquidTable | None) -> Iterator[_Moved]:
    """Liquid, and limits other than a cavity that is remembered."""
    limit = kernel.scene.effect(TensionLimit)
    remembered = limit is not None and limit.cavity == "mass-conserving"
    for one in sliders_of(kernel, table):
        loading = any(path.startswith("loading.") for path in one.paths)
        if not loading and not (remembered and one.name == "strength"):
            yield _Moved(slider=one, group=_OIL_GROUP)


def _assumed(scene: InjectorScene, kernel: KernelScene) -> Iterator[_Moved]:
    """What is assumed of gaps, mass and valve."""
    for paths in RANGES:
        if "valve." not in paths and not paths.startswith("loading."):
            continue
        if value_at(scene, Accuracy(), paths.split(", ")[0]) is not None:  # iron may not saturate
            yield _of_range(scene, kernel, paths)


def _of_range(scene: InjectorScene, kernel: KernelScene, paths: str) -> _Moved:
    given = RANGES[paths]
    (axis,) = axes(scene, Accuracy(), {paths: [given.low, given.high]})
    values = [float(value_at(scene, Accuracy(), path)) for path in axis.paths]
    value, low, high = values[0], float(axis.values[0][0]), float(axis.values[-1][0])
    low, high = min(low, value), max(high, value)
    slider = Slider(
        name=axis.paths[0].replace("valve.", "").replace("loading.", "").replace(".", "_"),
        paths=axis.paths,
        label=NAMES[paths],
        value=value,
        low=low,
        high=high,
        by="device",
        scale="log" if low > 0.0 and high > _WIDE * low else "linear",
    )
    offsets = tuple(one - value for one in values)
    targets = tuple(
        _target(kernel, path, offset) for path, offset in zip(axis.paths, offsets, strict=True)
    )
    group = _VALVE if paths in _FIRST else _MORE
    if paths.startswith("loading.initial_gap"):
        group = _OIL_GROUP
    return _Moved(
        slider=with_unit(slider, axis.units[0]),
        group=group,
        targets=targets,
        offsets=offsets,
        is_whole=isinstance(value_at(scene, Accuracy(), axis.paths[0]), int),
    )


_OF_LOADING = {"initial_gap": "h0", "rest_gap": "h_min", "final_gap": "h_rel", "mass": "m"}


def _target(kernel: KernelScene, path: str, offset: float) -> Target:
    """Variable of a field of the loading or the valve."""
    room, _, rest = path.partition(".")
    if room == "loading":
        return Target("film", kernel.reference(_OF_LOADING[rest]), offset)
    names = [port.name for port in native_model("valve-drive").ports]
    name = next(name for name, place in PLACES.items() if place.paths == (rest,))
    return Target("drive", names.index(name) + 1, offset)


def _data(moved: _Moved, tables: dict[str, Any]) -> dict[str, Any]:
    found = slider_data(moved.slider, tables)
    return {
        **found,
        "group": moved.group,
        "targets": [list(one) for one in moved.targets],
        "offsets": list(moved.offsets),
        "whole": moved.is_whole,
    }
