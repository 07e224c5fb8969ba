"""Checks of the two bodies: rigid unless an effect uses solids, flats or spheres, wide enough."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

from ..errors import PlanError
from .effects.base import SeparationEffect, effects_of

if TYPE_CHECKING:
    from ..scene.scenes import SeparationScene, SlidingScene
    from .effects.prepared import PreparedScene

__all__ = ["check_bodies", "check_rim"]


def check_bodies(scene: SeparationScene | SlidingScene) -> None:
    """Refuse an interface of which a film would leave something out.

    Raises
    ------
    PlanError
        Naming each field that nothing can use, or that is missing.
    """
    interface, kind = scene.interface, type(scene).__name__
    takes_solids = any(
        isinstance(effect, SeparationEffect) and effect.takes_solids for effect in scene.effects
    )
    problems: list[str] = []
    for name in ("lower", "upper"):
        body = getattr(interface, name)
        if not body.surface.bounds_film:
            problems.append(
                f"interface.{name}.surface is a {type(body.surface).__name__}, and the film knows "
                "a Flat or a Sphere only; press rough bodies in a ContactScene"
            )
        if body.solid is not None and not takes_solids:
            problems.append(
                f"interface.{name}.solid is given, and its effects take the bodies for rigid; "
                f"state that with solid=None, attrs.evolve(interface.{name}, solid=None)"
            )
    if interface.meniscus is None:
        problems.append("interface.meniscus is missing: the liquid, its amount and contact angles")
    if problems:
        raise PlanError(f"a {kind} cannot use its interface: {'; '.join(problems)}")


def check_rim(prepared: PreparedScene[SeparationScene]) -> None:
    """Refuse a bounded flat under a sphere that is too small for an effect which knows no rim.

    Each of the menisci has its part of the area of the flat.

    Raises
    ------
    PlanError
        Naming the radius of the flat, the effects and the radius they take.
    """
    scene, rim = prepared.scene, prepared.film.rim
    interface, gap = scene.interface, prepared.scene.loading.smallest_gap
    if interface.is_flat or math.isinf(rim):
        return
    radii = {type(e).__name__: e.rimless_radius(prepared, gap) for e in effects_of(scene)}
    beyond = {name: radius for name, radius in radii.items() if radius > rim}
    if not beyond:
        return
    side = "upper" if interface.curvatures[0] else "lower"
    taken = " and ".join(f"{name} takes a circle of radius {r:.4g} m" for name, r in beyond.items())
    count = scene.meniscus.count
    shared = f", {rim:g} m for each of {count} menisci" if count > 1 else ""
    least = max(beyond.values()) * math.sqrt(count)
    raise PlanError(
        f"interface.{side}.surface.radius is {interface.rim_radius:g} m{shared}, but under a "
        f"sphere {taken}; give a Flat of radius {least:.4g} m at least, "
        f"or without one, or less liquid"
    )
