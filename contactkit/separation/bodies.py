"""What the film models can use of two bodies: rigid ones, each a flat or a sphere, and a liquid."""

from __future__ import annotations

from typing import TYPE_CHECKING

from ..errors import PlanError
from ..scene.surfaces import Flat, Sphere

if TYPE_CHECKING:
    from ..scene.scenes import SeparationScene, SlidingScene

__all__ = ["check_bodies"]


def check_bodies(scene: SeparationScene | SlidingScene) -> None:
    """Refuse an interface of which a film would leave something out.

    Raises
    ------
    PlanError
        Naming each field that nothing can use, or that is missing.
    """
    interface, kind = scene.interface, type(scene).__name__
    problems: list[str] = []
    for name in ("lower", "upper"):
        body = getattr(interface, name)
        if not isinstance(body.surface, Flat | Sphere):
            problems.append(
                f"interface.{name}.surface is a {type(body.surface).__name__}, and the film knows "
                "a Flat or a Sphere only; press rough bodies in a ContactScene"
            )
        if body.solid is not None:
            problems.append(
                f"interface.{name}.solid is given, and its effects know rigid bodies; leave "
                "it out (AdhesiveContact has a reduced_modulus of its own)"
            )
    if interface.meniscus is None:
        problems.append("interface.meniscus is missing: the liquid, its amount and contact angles")
    if problems:
        raise PlanError(f"a {kind} cannot use its interface: {'; '.join(problems)}")
