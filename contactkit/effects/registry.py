"""Every effect there is: `EFFECTS` is the whole registry, and names in files come from it."""

from __future__ import annotations

from . import SEPARATION_EFFECTS
from .base import Effect
from .contact import CONTACT_EFFECTS
from .sliding import SLIDING_EFFECTS

__all__ = ["EFFECTS"]

EFFECTS: tuple[type[Effect], ...] = (
    *SEPARATION_EFFECTS,
    *SLIDING_EFFECTS,
    *CONTACT_EFFECTS,
)
