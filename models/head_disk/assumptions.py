"""Plausible ranges of what is assumed about head and disk, with reasons.

Ranges for `contactkit.sensitivity`, by the paths of the scene; change them to what is known of a
drive at hand.
"""

from __future__ import annotations

from collections.abc import Mapping
from types import MappingProxyType

from attrs import evolve

from ...scene.scenes import ContactScene
from ...studies.sensitivity import Range

__all__ = ["NAMES", "RANGES", "without_stresses"]

_CUTOFFS = "interface.lower.surface.cutoff, interface.upper.surface.cutoff"
_ANGLES = "interface.meniscus.contact_angle_lower, interface.meniscus.contact_angle_upper"
_FILM = "effects.film-meniscus.film_thickness, effects.film-meniscus.meniscus_height"

RANGES: Mapping[str, Range] = MappingProxyType(
    {
        "loading.pressure": Range("20 MPa", "200 MPa", "a parked slider, to a hard landing"),
        _CUTOFFS: Range(
            ("60 nm", "60 nm"), ("0.2 um", "0.2 um"), "what the grid resolves, to a coarse scan"
        ),
        "interface.lower.surface.rms": Range("3 nm", "10 nm", "smooth, to textured disks"),
        "interface.lower.surface.correlation_length": Range(
            "2 um", "6 um", "the scatter of measured disks"
        ),
        "interface.upper.surface.rms": Range("0.5 nm", "3 nm", "a polished slider, to a worn one"),
        "interface.lower.surface.seed": Range(1, 5, "another place on the disk"),
        "interface.lower.solid.layers.0.thickness": Range(
            "2 nm", "10 nm", "overcoats of two decades"
        ),
        "interface.lower.solid.layers.0.material.hardness": Range(
            "10 GPa", "25 GPa", "carbon with much hydrogen, to hard carbon"
        ),
        "interface.lower.solid.layers.1.thickness": Range("15 nm", "50 nm", "magnetic layers"),
        "interface.lower.solid.layers.1.material.hardness": Range(
            "6 GPa", "12 GPa", "cobalt alloys"
        ),
        _FILM: Range(("0.5 nm", "0.5 nm"), ("2 nm", "2 nm"), "dry, to humid air with lubricant"),
        _ANGLES: Range(("10 deg", "10 deg"), ("80 deg", "80 deg"), "bare carbon, to lubricated"),
    }
)
"""Range of each assumption by its path in the scene."""

NAMES: Mapping[str, str] = MappingProxyType(
    {
        "loading.pressure": "mean pressure",
        _CUTOFFS: "shortest wavelength",
        "interface.lower.surface.rms": "rms roughness of the disk",
        "interface.lower.surface.correlation_length": "correlation length of the disk",
        "interface.upper.surface.rms": "rms roughness of the slider",
        "interface.lower.surface.seed": "place on the disk (seed)",
        "interface.lower.solid.layers.0.thickness": "thickness of the carbon",
        "interface.lower.solid.layers.0.material.hardness": "hardness of the carbon",
        "interface.lower.solid.layers.1.thickness": "thickness of the magnetic layer",
        "interface.lower.solid.layers.1.material.hardness": "hardness of the magnetic layer",
        _FILM: "thickness of the water film",
        _ANGLES: "contact angle of water",
    }
)
"""What the figures call each assumption."""


def without_stresses(scene: ContactScene) -> ContactScene:
    """Return the scene without stresses below the surface, which no swept number needs."""
    kept = (effect for effect in scene.effects if effect.name != "subsurface-stress")
    return evolve(scene, effects=tuple(kept))
