"""The physics a scene may call for. `EFFECTS` is the whole registry."""

from __future__ import annotations

from .base import Effect, SeparationEffect
from .meniscus import MeniscusForce
from .rupture import Rupture
from .viscous import ShearLimit, TensionLimit, ViscousForce

__all__ = [
    "EFFECTS", "Effect", "MeniscusForce", "Rupture", "SeparationEffect", "ShearLimit",
    "TensionLimit", "ViscousForce",
]  # fmt: skip

EFFECTS: tuple[type[SeparationEffect], ...] = (
    MeniscusForce,
    ViscousForce,
    TensionLimit,
    ShearLimit,
    Rupture,
)
