"""Plausible ranges of what is assumed about the micromirror, with reasons.

Ranges for `contactkit.sensitivity`, by the paths of the scene; change them to what is known of a
mirror at hand. What section 3.4 of the source gives (size, tilt, rate, tips) has no range.
"""

from __future__ import annotations

from collections.abc import Mapping
from types import MappingProxyType

from ...studies.sensitivity import Range

__all__ = ["NAMES", "RANGES"]

_ANGLES = "interface.meniscus.contact_angle_lower, interface.meniscus.contact_angle_upper"
_GAPS = "loading.initial_gap, loading.rest_gap"

RANGES: Mapping[str, Range] = MappingProxyType(
    {
        "interface.upper.surface.radius": Range(
            "50 nm", "300 nm", "a sharp edge of a film 0.1 um thick, to a worn one"
        ),
        _ANGLES: Range(
            ("10 deg", "10 deg"),
            ("110 deg", "110 deg"),
            "clean oxide, to the fluorinated monolayer of the source",
        ),
        _GAPS: Range(
            ("0.2 nm", "0.2 nm"), ("1 nm", "1 nm"), "touching oxides, to grains of the film"
        ),
        "effects.van-der-waals-force.hamaker_constant": Range(
            "0.4e-19 J", "1.5e-19 J", "oxides in water, to oxides in air"
        ),
        "temperature": Range("5 degC", "60 degC", "a cold start, to a projector at work"),
        "loading.stiffness": Range("0.5 N/m", "2 N/m", "a cantilever 0.2 to 0.3 um thick"),
        "loading.mass": Range("2e-16 kg", "8e-16 kg", "half, to double of that cantilever"),
        "mirror.hinge.stiffness": Range("1e-13 N.m/rad", "4e-13 N.m/rad", "hinges of 35 to 70 kHz"),
        "mirror.hinge.inertia": Range(
            "1.5e-24 kg.m2", "3e-24 kg.m2", "the plate, to plate and yoke"
        ),
        "mirror.hinge.damping": Range(
            "0.3e-19 N.m.s/rad", "3e-19 N.m.s/rad", "a quality of 20 to 2: gas and its pressure"
        ),
        "mirror.tips.damping": Range("0.5e-10 N.s/m", "10e-10 N.s/m", "a quality of 400 to 20"),
        "mirror.tips.arm": Range("5.6 um", "6.4 um", "where on the yoke the tips are"),
        "mirror.electrode.width": Range("6 um", "10 um", "half, to most of the mirror"),
        "mirror.electrode.inner": Range("0.5 um", "2 um", "room for the hinge"),
        "mirror.electrode.outer": Range("5 um", "5.8 um", "room for the tips"),
        "mirror.electrode.gap": Range("1.35 um", "1.8 um", "height of the spacer"),
        "mirror.waveform.bias_voltage": Range("-26 V", "-18 V", "drivers of that time"),
        "mirror.waveform.address_voltage": Range("3.3 V", "7.5 V", "logic levels"),
        "mirror.waveform.reset_time": Range("0.2 us", "0.6 us", "to be tuned on the device"),
    }
)
"""Range of each assumption by its path in the scene."""

NAMES: Mapping[str, str] = MappingProxyType(
    {
        "interface.upper.surface.radius": "radius of a tip",
        _ANGLES: "contact angle of water",
        _GAPS: "gap of a landed tip",
        "effects.van-der-waals-force.hamaker_constant": "Hamaker constant",
        "temperature": "temperature",
        "loading.stiffness": "stiffness of a tip",
        "loading.mass": "mass of a tip",
        "mirror.hinge.stiffness": "stiffness of the hinge",
        "mirror.hinge.inertia": "inertia of the mirror",
        "mirror.hinge.damping": "damping of the mirror",
        "mirror.tips.damping": "damping of a tip",
        "mirror.tips.arm": "arm of the tips",
        "mirror.electrode.width": "width of an electrode",
        "mirror.electrode.inner": "inner edge of an electrode",
        "mirror.electrode.outer": "outer edge of an electrode",
        "mirror.electrode.gap": "height over the electrodes",
        "mirror.waveform.bias_voltage": "bias",
        "mirror.waveform.address_voltage": "address voltage",
        "mirror.waveform.reset_time": "length of the pulse",
    }
)
"""What the figures call each assumption."""
