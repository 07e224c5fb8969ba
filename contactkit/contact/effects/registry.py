"""The physics a contact scene may call for: `CONTACT_EFFECTS` is the whole registry."""

from __future__ import annotations

from typing import Any

from ...scene.effect import EffectRegistry
from .adhesion import Adhesion
from .base import ContactEffect
from .elasticity import HalfSpace, LayeredHalfSpace
from .film import FilmMeniscus
from .friction import FrictionCoupling, FrictionTraction
from .island_bridges import IslandBridges
from .partial_slip import PartialSlip
from .plastic_history import PlasticHistory
from .plasticity import HardnessLimit
from .stress import SubsurfaceStress

__all__ = ["CONTACT_EFFECTS"]

CONTACT_EFFECTS: EffectRegistry[ContactEffect[Any]] = EffectRegistry(
    HalfSpace,
    LayeredHalfSpace,
    HardnessLimit,
    Adhesion,
    PlasticHistory,
    FrictionTraction,
    FrictionCoupling,
    PartialSlip,
    SubsurfaceStress,
    FilmMeniscus,
    IslandBridges,
    acts_in="contact",
)
