"""Registry of all effects, `EFFECTS`, from which files take their names."""

from __future__ import annotations

from .contact.effects.registry import CONTACT_EFFECTS
from .scene.effect import Effect, EffectRegistry
from .separation.effects.registry import SEPARATION_EFFECTS
from .separation.sliding.effects import SLIDING_EFFECTS

__all__ = ["EFFECTS"]

EFFECTS: EffectRegistry[Effect] = EffectRegistry(
    SEPARATION_EFFECTS, SLIDING_EFFECTS, CONTACT_EFFECTS
)
