"""Printed and consistent equations: a result has equations as published, or corrected ones.

Each effect whose equation the source prints wrong has a choice that takes it as printed, and says
by `SeparationEffect.equations` which of the two a scene takes.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from .base import effects_of

if TYPE_CHECKING:
    from ...scene.scenes import SeparationScene
    from .base import SeparationEffect

__all__ = ["mixed"]


def mixed(scene: SeparationScene) -> str:
    """Say which effects of a scene mix the two; empty if none do."""
    modes = {effect: effect.equations(scene) for effect in effects_of(scene)}
    printed = [effect for effect, found in modes.items() if found == "as-published"]
    right = [effect for effect, found in modes.items() if found == "consistent"]
    if not (printed and right):
        return ""
    return (
        f"{_and(printed)} would be mixed with {_and(right)}: a result takes the equations as "
        f"printed or the consistent ones, never both; choose one mode for all effects"
    )


def _and(effects: list[SeparationEffect]) -> str:
    return " and ".join(map(_shown, effects))


def _shown(effect: SeparationEffect) -> str:
    choice = effect.published_choice
    return f"{type(effect).__name__}({choice}={getattr(effect, choice)!r})" if choice else ""
