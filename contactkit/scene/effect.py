"""Base class of all effects, the physics that a scene may list."""

from __future__ import annotations

import abc
from collections.abc import Sequence
from typing import TYPE_CHECKING, Any, ClassVar

from attrs import NOTHING, fields, frozen

from ..errors import PlanError
from ..validators import Described

if TYPE_CHECKING:
    from ..registry import Registries, Registry

__all__ = ["Effect", "as_written", "check_listed", "choices"]


@frozen(kw_only=True)
class Effect(Described, abc.ABC):
    """A piece of physics a scene may list. Subclasses are final and hold choices only."""

    family: ClassVar[str] = ""
    """Effects of a kind of scene, as its role declares: ``"contact effect"`` and so on."""
    name: ClassVar[str]
    summary: ClassVar[str]
    solves_motion: ClassVar[bool] = False
    """Whether it is solved together with the motion, which then does not read `Loading.reads`."""
    figures: ClassVar[tuple[str, ...]] = ()
    """Figures of a result that this effect makes possible: methods of ``result.plot``."""

    @property
    @abc.abstractmethod
    def sources(self) -> tuple[str, ...]:
        """Sources of the equations of this choice."""

    def cites(self, scene: Any) -> tuple[str, ...]:
        """Sources of what this choice computes for a scene; all of them, unless it depends."""
        return self.sources

    def liquid_needs(self, scene: Any) -> tuple[str, ...]:
        """Properties of the liquid that the effect uses in a scene."""
        return ()

    def reads(self, scene: Any) -> tuple[str, ...]:
        """Name the settings of `Accuracy` that it reads in a scene, beside those of the loading."""
        return ()

    def lacks(self, scene: Any) -> tuple[str, ...]:
        """Name what this effect needs and `scene` does not give, with units."""
        return ()


def choices(effect: Effect) -> str:
    """Say what an effect does and which choices it was given."""
    given = ((a.name, getattr(effect, a.name)) for a in fields(type(effect)))
    chosen = ", ".join(f"{name}={_written(value)}" for name, value in given if value is not None)
    return f"{effect.summary}" + (f" ({chosen})" if chosen else "")


def _written(value: object) -> str:
    """A choice as text; the steps of a path by their labels."""
    if isinstance(value, tuple) and value and all(hasattr(one, "label") for one in value):
        return f"({'; '.join(one.label for one in value)})"
    return repr(value)


def as_written(kind: type[Effect]) -> str:
    """Return how an effect is written in a scene: with dots where something must be given."""
    must = any(one.default is NOTHING for one in fields(kind))
    return f"{kind.__name__}({'...' if must else ''})"


def check_listed(
    effects: Sequence[object], role: type, scene: str, known: Registry[Any] | Registries[Any]
) -> list[type[object]]:
    """Refuse what is no effect of a kind of scene, or is listed twice; return the kinds."""
    for effect in effects:
        if not isinstance(effect, role):
            if isinstance(effect, type) and issubclass(effect, Effect) and issubclass(effect, role):
                cure = f"it is a class: write {as_written(effect)}"
            else:
                cure = f"known: {known.names}"
            raise PlanError(f"{effect!r} is not an effect of a {scene} scene; {cure}")
    kinds = [type(effect) for effect in effects]
    if twice := sorted({k.__name__ for k in kinds if kinds.count(k) > 1}):
        raise PlanError(f"listed more than once: {', '.join(twice)}")
    return kinds
