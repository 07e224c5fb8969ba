"""Plausible ranges of what is assumed about the fuel injector, with reasons.

Ranges for `contactkit.sensitivity`, by the paths of the scene; change them to what is known of a
valve at hand. What section 3.4 of the source gives (width, travel, load, time, speed) has no range
here: the coil varies within what leaves a load of the order of 40 N.
"""

from __future__ import annotations

from collections.abc import Mapping
from types import MappingProxyType

from attrs import evolve

from ...separation.effects.base import SeparationEffect
from ...separation.effects.viscous import TensionLimit
from ...studies.sensitivity import Range
from .scene import InjectorScene

__all__ = ["NAMES", "RANGES", "RANGES_SUSTAINED", "sustaining"]

_GAPS = "loading.initial_gap, loading.rest_gap, loading.final_gap, valve.stop.gap"
_TENSIONS = "effects.tension-limit.strength, effects.tension-limit.cavity_pressure"
_AROUND = "effects.tension-limit.ambient_pressure, effects.tension-limit.strength"
_FACES = "interface.lower.surface.radius, interface.upper.surface.radius"

RANGES: Mapping[str, Range] = MappingProxyType(
    {
        "effects.tension-limit.cavity_pressure": Range(
            "-8.98675 bar",
            "0.9 bar",
            "oil that goes on to sustain 10 bar, to a cavity of air that came out of the oil",
        ),
        "effects.tension-limit.strength": Range(
            "1.02 bar", "30 bar", "aerated oil, to clean degassed oil for milliseconds"
        ),
        _AROUND: Range(
            ("1.01325 bar", "10 bar"),
            ("20 bar", "28.98675 bar"),
            "a drain to the crankcase, to oil under pressure; it cavitates at -9 bar absolute",
        ),
        "temperature": Range("-20 degC", "80 degC", "cold start, to warm engine"),
        _GAPS: Range(
            ("2 um", "2 um", "20 um", "22 um"),
            ("10 um", "10 um", "28 um", "30 um"),
            "lapped faces, to worn ones with raised edges; the travel stays",
        ),
        _FACES: Range(
            ("2.25 mm", "2.25 mm"),
            ("3.175 mm", "3.175 mm"),
            "a recess over half of the face, to a plane face",
        ),
        "loading.mass": Range("10 g", "40 g", "a short hollow spool, to one with a long armature"),
        "valve.spring.preload": Range("10 N", "25 N", "springs that close in 0.2 to 0.5 ms"),
        "valve.spring.stiffness": Range("5 N/mm", "50 N/mm", "usual coil springs of that size"),
        "valve.coil.resistance": Range("0.7 ohm", "1.5 ohm", "coil, cable and driver, cold to hot"),
        "valve.coil.turns": Range(35, 45, "leaves a load of the order of 40 N"),
        "valve.coil.pole_area": Range("45 mm2", "55 mm2", "leaves a load of the order of 40 N"),
        "valve.coil.air_gap": Range("95 um", "120 um", "tolerance of a shim"),
        "valve.coil.iron_gap": Range("10 um", "40 um", "permeability of 6000 to 1500"),
        "valve.coil.saturation": Range("1.5 T", "2.1 T", "soft ferrite steel, to cobalt iron"),
        "valve.stop.stiffness": Range("30 N/um", "300 N/um", "a flexible seat, to a solid one"),
        "valve.stop.damping": Range("1 s/m", "10 s/m", "dry metal, to a wet stop"),
        "valve.profile.boost_voltage": Range("9 V", "14.5 V", "a cold battery, to one on charge"),
        "valve.profile.off_voltage": Range("-60 V", "0 V", "a fast driver, to a plain diode"),
    }
)
"""Range of each assumption by its path in the scene."""

RANGES_SUSTAINED: Mapping[str, Range] = MappingProxyType(
    {
        _TENSIONS: Range(
            ("5 bar", "-3.98675 bar"),
            ("13 bar", "-11.98675 bar"),
            "the same tension before and after it has cavitated",
        )
    }
    | {path: one for path, one in RANGES.items() if "tension-limit" not in path}
)
"""Ranges for an oil that goes on to sustain its strength, see `sustaining`."""

NAMES: Mapping[str, str] = MappingProxyType(
    {
        "effects.tension-limit.cavity_pressure": "pressure in the cavity",
        "effects.tension-limit.strength": "tensile strength of the oil",
        _AROUND: "pressure around the face",
        _TENSIONS: "tension it sustains",
        "temperature": "temperature of the oil",
        _GAPS: "gap when closed",
        _FACES: "radius of the face",
        "loading.mass": "mass of the spool",
        "valve.spring.preload": "preload of the spring",
        "valve.spring.stiffness": "stiffness of the spring",
        "valve.coil.resistance": "resistance of the coil",
        "valve.coil.turns": "turns of the coil",
        "valve.coil.pole_area": "area of a pole",
        "valve.coil.air_gap": "air gap of the magnet",
        "valve.coil.iron_gap": "gap that stands for the iron",
        "valve.coil.saturation": "saturation of the iron",
        "valve.stop.stiffness": "stiffness of the stop",
        "valve.stop.damping": "damping of the stop",
        "valve.profile.boost_voltage": "boost voltage",
        "valve.profile.off_voltage": "voltage when switched off",
    }
)
"""What the figures call each assumption."""


def sustaining(scene: InjectorScene) -> InjectorScene:
    """Return the injector with an oil that sustains its strength in the cavity, too."""

    def held(effect: SeparationEffect) -> SeparationEffect:
        if not isinstance(effect, TensionLimit):
            return effect
        return evolve(effect, cavity_pressure=effect.ambient_pressure - effect.tension)

    return evolve(scene, effects=tuple(map(held, scene.effects)))
