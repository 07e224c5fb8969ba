"""As published or consistent: which choices take printed equations that are known to be wrong.

A result is of one mode. Each effect whose equation the source prints wrong has a choice that
takes it as printed; whatever else there is takes its place in the consistent mode, or stands in
both. Numbers are those of the source's equations.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from ...scene.loading import ImposedTime

if TYPE_CHECKING:
    from ...scene.scenes import SeparationScene
    from .base import SeparationEffect

__all__ = ["AS_PUBLISHED", "mixed", "mode", "printed_equations"]

AS_PUBLISHED = "as-published"
CONSISTENT = "consistent"

# The field of an effect, by its name, that says which equations it takes.
_CHOICES = {
    "meniscus-force": "profile",
    "viscous-force": "closure",
    "rupture": "criterion",
}


def mode(effect: SeparationEffect, scene: SeparationScene) -> str:
    """``as-published``, ``consistent``, or empty where an effect is the same in both.

    A film that keeps its volume is what Eq. (3.18) and (3.22) print; only the mean force of a
    given time, Eq. (3.19), is another one in print. The zero neck of the source is the end of
    the arc, and alone a bound; it does not go with the exact bridge, nor the exact limit with
    printed forces.
    """
    choice = _choice(effect)
    if choice == AS_PUBLISHED:
        return AS_PUBLISHED
    if effect.name == "meniscus-force":
        return CONSISTENT
    if effect.name == "viscous-force":
        mean = choice == "volume-conserving" and isinstance(scene.loading, ImposedTime)
        return CONSISTENT if mean and scene.interface.is_flat else ""
    if effect.name == "rupture" and getattr(effect, "gap", None) is None:
        by_neck = AS_PUBLISHED if "exact" in _profiles(scene) else ""
        return by_neck if choice == "zero-neck" else CONSISTENT
    return ""


def _profiles(scene: SeparationScene) -> list[str]:
    return [_choice(effect) for effect in scene.effects if effect.name == "meniscus-force"]


def _choice(effect: SeparationEffect) -> str:
    name = _CHOICES.get(effect.name)
    return getattr(effect, name, "") if name is not None else ""


def mixed(scene: SeparationScene) -> str:
    """Say which effects of a scene mix the two modes; empty if none do."""
    modes = {effect: mode(effect, scene) for effect in scene.effects}
    printed = [effect for effect, found in modes.items() if found == AS_PUBLISHED]
    right = [effect for effect, found in modes.items() if found == CONSISTENT]
    if not (printed and right):
        return ""
    return (
        f"{_and(printed)} would be mixed with {_and(right)}: a result takes the equations as "
        f"printed or the consistent ones, never both; choose one mode for all effects"
    )


def _and(effects: list[SeparationEffect]) -> str:
    shown = (f"{type(e).__name__}({_CHOICES[e.name]}={_choice(e)!r})" for e in effects)
    return " and ".join(shown)


def printed_equations(scene: SeparationScene) -> tuple[tuple[SeparationEffect, str], ...]:
    """Effects of a scene that take a printed equation with an erratum, and its number."""
    is_flat, several = scene.interface.is_flat, scene.meniscus.count > 1
    numbers = {
        "meniscus-force": ("3.33" if several else "3.11") if is_flat else "3.12",
        "viscous-force": ("3.34" if several else "3.19") if is_flat else "3.26",
    }
    found = [(e, numbers[e.name]) for e in scene.effects if _choice(e) == AS_PUBLISHED]
    by_neck = [e for e in scene.effects if e.name == "rupture" and _choice(e) == "zero-neck"]
    found += [(e, "zero neck") for e in by_neck if getattr(e, "gap", None) is None]
    return tuple(found)
