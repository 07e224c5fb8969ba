"""Effects that a separation scene may list; those of a contact are in `contact`."""

from __future__ import annotations

from ...scene.effect import Effect, EffectRegistry
from .adhesion import AdhesiveContact, VanDerWaalsForce
from .asperities import AsperityMenisci
from .base import SeparationEffect
from .meniscus import MeniscusForce
from .rupture import Rupture
from .viscous import ShearLimit, TensionLimit, ViscousForce

__all__ = [
    "SEPARATION_EFFECTS",
    "AdhesiveContact",
    "AsperityMenisci",
    "Effect",
    "MeniscusForce",
    "Rupture",
    "SeparationEffect",
    "ShearLimit",
    "TensionLimit",
    "VanDerWaalsForce",
    "ViscousForce",
]

SEPARATION_EFFECTS: EffectRegistry[SeparationEffect] = EffectRegistry(
    MeniscusForce,
    ViscousForce,
    TensionLimit,
    ShearLimit,
    Rupture,
    VanDerWaalsForce,
    AdhesiveContact,
    AsperityMenisci,
    acts_in="separation",
)
