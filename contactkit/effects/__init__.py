"""The physics a separation scene may call for; those of a contact are in `contact`."""

from __future__ import annotations

from .base import Effect, SeparationEffect
from .meniscus import MeniscusForce
from .rupture import Rupture
from .viscous import ShearLimit, TensionLimit, ViscousForce

__all__ = [
    "SEPARATION_EFFECTS", "Effect", "MeniscusForce", "Rupture", "SeparationEffect",
    "ShearLimit", "TensionLimit", "ViscousForce",
]  # fmt: skip

SEPARATION_EFFECTS: tuple[type[SeparationEffect], ...] = (
    MeniscusForce,
    ViscousForce,
    TensionLimit,
    ShearLimit,
    Rupture,
)
