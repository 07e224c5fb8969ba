"""A piece of physics that a scene may call for: the base class of all effects."""

from __future__ import annotations

import abc
from collections.abc import Sequence
from typing import ClassVar

from attrs import frozen

from ..errors import PlanError

__all__ = ["Effect", "check_listed", "choices"]


@frozen(kw_only=True)
class Effect(abc.ABC):
    """A piece of physics a scene may call for. Subclasses are final and hold choices only."""

    name: ClassVar[str]
    summary: ClassVar[str]

    @property
    @abc.abstractmethod
    def sources(self) -> tuple[str, ...]:
        """Where the equations of this choice come from."""


def choices(effect: Effect) -> str:
    """Say what an effect does and which choices it was given."""
    fields = ((a.name, getattr(effect, a.name)) for a in type(effect).__attrs_attrs__)
    chosen = ", ".join(f"{name}={value!r}" for name, value in fields if value is not None)
    return f"{effect.summary}" + (f" ({chosen})" if chosen else "")


def check_listed(
    effects: Sequence[object], role: type, scene: str, known: str
) -> list[type[object]]:
    """Refuse what is no effect of a kind of scene, or is listed twice; return the kinds."""
    for effect in effects:
        if not isinstance(effect, role):
            raise PlanError(f"{effect!r} is not an effect of a {scene} scene; known: {known}")
    kinds = [type(effect) for effect in effects]
    if twice := sorted({k.__name__ for k in kinds if kinds.count(k) > 1}):
        raise PlanError(f"listed more than once: {', '.join(twice)}")
    return kinds
