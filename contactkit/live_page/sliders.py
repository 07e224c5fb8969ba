"""Sliders of a live page: fields of the scene, with labels, units and ranges."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from typing import Any, Literal, NamedTuple

from attrs import evolve, frozen

from ..liquids.temperature_table import LiquidTable
from ..scene.loading import ImposedForce
from ..scene.scenes import SeparationScene
from ..scene.surfaces import Flat, Sphere
from ..separation.effects.base import SeparationEffect
from ..separation.effects.rupture import Rupture
from ..separation.effects.viscous import ShearLimit, TensionLimit
from ..units import readable_unit
from .scene import KernelScene

__all__ = ["Slider", "family_sliders", "sliders_of", "with_unit"]

By = Literal["pull", "rise", "speed", "kernel", "liquid", "temperature", "family", "device"]
Scale = Literal["log", "linear", "angle", "kelvin"]
"""How a quantity is spread: by its logarithm, evenly, or as ln(-ln x), a humidity by that of its
Kelvin radius; angles evenly, and what they move is no power of them."""


@frozen(kw_only=True)
class Slider:
    """A quantity of the scene that the page moves.

    `paths` are the fields that take its value. `by` is the way to the kernel: as the pull, its rise
    time or an imposed speed, as a variable (`port`, `reference`), as a property of the liquid,
    through the temperature, through the tables over a grid, or as the view of a device does. Shown
    is (value - shift)/factor, in `unit`.
    """

    name: str
    paths: tuple[str, ...]
    label: str
    value: float
    low: float
    high: float
    by: By
    scale: Scale = "log"
    port: str = ""
    reference: int = 0
    unit: str = ""
    factor: float = 1.0
    shift: float = 0.0

    def place(self, value: float) -> float:
        """Place of a value on the scale; as ``template/tables.js``."""
        if self.scale == "kelvin":
            return math.log(-math.log(value))
        return math.log(value) if self.scale == "log" else value

    def value_at(self, place: float) -> float:
        """Value at a place, within the range."""
        if self.scale == "kelvin":
            value = math.exp(-math.exp(place))
        else:
            value = math.exp(place) if self.scale == "log" else place
        return min(max(value, self.low), self.high)


class _Field(NamedTuple):
    """Field of the loading or of an effect: label, factor of its range, way to the kernel."""

    label: str
    span: float
    by: By = "kernel"
    port: str = ""


# Factors up and down: pulls and masses by ten, as results go with their roots; gaps by less, as
# beyond that another film would have been described.
_LOADING = {
    "force": _Field("pull", 10.0, "pull"),
    "speed": _Field("opening speed", 100.0, "speed"),
    "mass": _Field("moving mass", 10.0, port="m"),
    "initial_gap": _Field("gap at the start", 3.0, port="h0"),
    "final_gap": _Field("gap at release", 4.0, port="h_rel"),
    "rest_gap": _Field("gap at which asperities touch", 3.0, port="h_min"),
    "stiffness": _Field("stiffness of the spring", 10.0, port="k_s"),
    "initial_speed": _Field("speed at the start", 10.0, port="v0"),
    "rise_time": _Field("rise time of the pull", 10.0, "rise"),
}
_EFFECTS: Mapping[tuple[type[SeparationEffect], str], _Field] = {
    (TensionLimit, "strength"): _Field("tensile strength of the liquid", 10.0),
    (ShearLimit, "strength"): _Field("limiting shear strength", 10.0, port="tau_lim"),
    (Rupture, "gap"): _Field("gap at which the film breaks", 3.0, port="h_break"),
}
_LIQUID = {"viscosity": ("viscosity", "eta"), "surface_tension": ("surface tension", "gamma")}
_STEEPEST_ANGLE = math.radians(80.0)  # nearer to a right angle the menisci change their kind


def sliders_of(kernel: KernelScene, table: LiquidTable | None) -> tuple[Slider, ...]:
    """Everything but what tables over a grid hold."""
    scene = kernel.scene
    found = [*_of_loading(kernel), *_of_liquid(kernel, table), *_of_effects(kernel)]
    paths = {path for slider in found for path in slider.paths}
    if "loading.final_gap" in paths and not isinstance(scene.loading, ImposedForce):
        found = [evolve(s, label="largest gap") if s.name == "final_gap" else s for s in found]
    return tuple(with_unit(slider, _UNITS.get(slider.name, "")) for slider in found)


_UNITS = {
    **{"force": "N", "speed": "m/s", "mass": "kg", "initial_gap": "m", "final_gap": "m"},
    **{"rest_gap": "m", "stiffness": "N/m", "initial_speed": "m/s", "rise_time": "s"},
    **{"viscosity": "Pa.s", "surface_tension": "N/m", "strength": "Pa", "shear_strength": "Pa"},
    **{"gap": "m", "volume": "m3", "radius": "m", "angle": "rad", "angle_lower": "rad"},
    **{"angle_upper": "rad", "humidity": "-", "sphere_radius": "m", "temperature": "K"},
}


def _of_loading(kernel: KernelScene) -> Iterator[Slider]:
    loading = kernel.scene.loading
    for name, field in _LOADING.items():
        value = getattr(loading, name, None)
        if not value:  # None, and zero: there is none of it
            continue
        low, high = sorted((value / field.span, value * field.span))
        if name == "initial_gap":
            port = kernel.ports[kernel.reference("h0") - 1]
            if port.minimum == port.maximum:
                continue  # the tables belong to this gap
            high = min(high, loading.initial_gap + 0.9 * (loading.final_gap - loading.initial_gap))
        elif name == "final_gap":
            low = max(low, 1.05 * loading.initial_gap)
        elif name == "rest_gap":
            high = loading.initial_gap
        yield Slider(
            name=name,
            paths=(f"loading.{name}",),
            label=field.label,
            value=value,
            low=low,
            high=high,
            by=field.by,
            scale="log" if value > 0.0 else "linear",
            port=field.port,
            reference=kernel.reference(field.port),
        )


def _of_liquid(kernel: KernelScene, table: LiquidTable | None) -> Iterator[Slider]:
    scene = kernel.scene
    free = [name for name, (_, port) in _LIQUID.items() if kernel.start.get(port)]
    needed = {need for effect in scene.effects for need in effect.liquid_needs(scene)}
    if table is not None and needed <= set(free):
        yield _temperature(scene, table, "temperature")
        return
    for name in free if table is None else ():
        label, port = _LIQUID[name]
        value = float(kernel.start[port])
        yield Slider(
            name=name,
            paths=(f"interface.meniscus.liquid.{name}",),
            label=label,
            value=value,
            low=value / 10.0 if name == "viscosity" else value / 2.0,
            high=value * 10.0 if name == "viscosity" else value * 2.0,
            by="liquid",
            port=port,
            reference=kernel.reference(port),
        )


def _temperature(scene: SeparationScene, table: LiquidTable, by: By) -> Slider:
    return Slider(
        name="temperature",
        paths=("temperature",),
        label="temperature",
        value=scene.temperature,
        low=table.low,
        high=table.high,
        by=by,
        scale="linear",
    )


def _of_effects(kernel: KernelScene) -> Iterator[Slider]:
    for (kind, name), field in _EFFECTS.items():
        effect = kernel.scene.effect(kind)
        value = getattr(effect, name, None)
        if effect is None or not isinstance(value, float):
            continue
        low, port = value / field.span, field.port
        if kind is TensionLimit:
            port = "dp_inception" if kernel.start.get("dp_inception") else "dp_cav"
            low = max(low, float(kernel.start.get("dp_hold", 0.0)))
            if kernel.start.get(port) != value:
                continue  # the tension of a cavity pressure, which is no strength
        if kind is Rupture:
            low = max(low, 1.05 * kernel.scene.loading.initial_gap)
        yield Slider(
            name="shear_strength" if kind is ShearLimit else name,
            paths=(f"effects.{effect.name}.{name}",),
            label=field.label,
            value=value,
            low=low,
            high=value * field.span,
            by="kernel",
            port=port,
            reference=kernel.reference(port),
        )


def family_sliders(kernel: KernelScene, table: LiquidTable | None) -> tuple[Slider, ...]:
    """Geometry, contact angles, humidity, and the temperature where it moves more than a factor."""
    scene, found = kernel.scene, list[Slider]()
    meniscus = "interface.meniscus."
    if scene.meniscus.volume:
        found.append(
            _scaled(
                "volume", (meniscus + "volume",), "volume of the liquid", scene.meniscus.volume, 4.0
            )
        )
    humidity = scene.meniscus.relative_humidity
    if humidity:
        low, high = min(0.1, humidity), max(0.95, humidity)
        found.append(
            Slider(
                name="humidity",
                paths=(meniscus + "relative_humidity",),
                label="relative humidity",
                value=humidity,
                low=low,
                high=high,
                by="family",
                scale="kelvin",
            )
        )
    found += _of_surfaces(scene)
    found += _of_angles(scene)
    needed = {need for effect in scene.effects for need in effect.liquid_needs(scene)}
    free = {name for name, (_, port) in _LIQUID.items() if kernel.start.get(port)}
    if table is not None and not needed <= free:
        found.append(_temperature(scene, table, "family"))
    return tuple(with_unit(slider, _UNITS[slider.name]) for slider in found)


def _scaled(name: str, paths: tuple[str, ...], label: str, value: float, span: float) -> Slider:
    return Slider(
        name=name,
        paths=paths,
        label=label,
        value=value,
        low=value / span,
        high=value * span,
        by="family",
    )


def _of_surfaces(scene: SeparationScene) -> Iterator[Slider]:
    interface = scene.interface
    faces = {
        f"interface.{side}.surface.radius": body.surface
        for side, body in (("lower", interface.lower), ("upper", interface.upper))
    }
    for path, surface in faces.items():
        if isinstance(surface, Sphere):
            yield _scaled("sphere_radius", (path,), "radius of the sphere", surface.radius, 2.0)
    flats = {path: s for path, s in faces.items() if isinstance(s, Flat)}
    radii = {s.radius for s in flats.values() if s.radius}
    if interface.is_flat and interface.has_discs and len(radii) == 1:
        paths = tuple(path for path, s in flats.items() if s.radius)
        yield _scaled("radius", paths, "radius of the faces", radii.pop(), 2.0)


def _of_angles(scene: SeparationScene) -> Iterator[Slider]:
    needs = {need for effect in scene.effects for need in effect.liquid_needs(scene)}
    if "surface_tension" not in needs:
        return
    lower, upper = scene.meniscus.contact_angle_lower, scene.meniscus.contact_angle_upper
    paths = tuple(f"interface.meniscus.contact_angle_{side}" for side in ("lower", "upper"))
    made: Any = {"by": "family", "scale": "angle", "low": 0.0}
    if lower == upper <= _STEEPEST_ANGLE:
        yield Slider(
            name="angle",
            paths=paths,
            label="contact angle",
            value=lower,
            high=_STEEPEST_ANGLE,
            **made,
        )
        return
    for side, path, value in zip(("lower", "upper"), paths, (lower, upper), strict=True):
        if value <= _STEEPEST_ANGLE:
            yield Slider(
                name=f"angle_{side}",
                paths=(path,),
                label=f"contact angle, {side} body",
                value=value,
                high=_STEEPEST_ANGLE,
                **made,
            )


def with_unit(slider: Slider, si: str) -> Slider:
    """Slider with the unit in which it reads best."""
    if si == "K":
        return evolve(slider, unit="°C", shift=273.15)
    if slider.name == "humidity":
        return evolve(slider, unit="%", factor=0.01)
    factor, unit = readable_unit(slider.value or slider.high, si)
    return evolve(slider, unit=unit, factor=factor)
