"""Base class of all plans: the effects that are on and off, and their sources."""

from __future__ import annotations

import abc
from typing import Any, ClassVar, Protocol

from ..accuracy import Accuracy
from ..errors import NotSimulatedError
from .effect import Effect, EffectRegistry, as_written, choices

__all__ = ["ScenePlan"]


class _Scene(Protocol):
    @property
    def effects(self) -> tuple[Effect, ...]: ...


class ScenePlan(abc.ABC):
    """A checked scene made ready to run.

    ``print(plan)`` says what will be simulated and what will not; `cite` gives the sources.
    """

    __slots__ = ()

    known_effects: ClassVar[EffectRegistry[Any]]
    """The effects that a scene of this kind may list."""

    @property
    @abc.abstractmethod
    def scene(self) -> _Scene:
        """Scene that is simulated."""

    @property
    @abc.abstractmethod
    def accuracy(self) -> Accuracy:
        """Numerical accuracy of the solution."""

    @property
    @abc.abstractmethod
    def title(self) -> str:
        """The scene and what is imposed, in a line."""

    def has(self, kind: type[Effect]) -> bool:
        """Whether the scene lists an effect."""
        return any(type(effect) is kind for effect in self.scene.effects)

    def listed(self, kind: type[Any]) -> Any:
        """Return the effect of a kind; refuse one that the scene does not list.

        Raises
        ------
        NotSimulatedError
            If the scene does not list it; the message says what to add.
        """
        for effect in self.scene.effects:
            if type(effect) is kind:
                return effect
        raise NotSimulatedError(
            f"the scene does not call for {kind.name}: add {as_written(kind)} to its effects"
        )

    def cite(self) -> str:
        """Sources of the equations of this run, one to a line."""
        effects, scene = self.scene.effects, self.scene
        return "\n".join(f"{e.name}: {source}" for e in effects for source in e.cites(scene))

    def __str__(self) -> str:
        effects = self.scene.effects
        off = [kind for kind in self.known_effects if not self.has(kind)]
        width = max([len(effect.name) for effect in effects] + [len(kind.name) for kind in off])
        return "\n".join(
            [
                self.title,
                *(f"  on   {effect.name:{width}s} {choices(effect)}" for effect in effects),
                *(f"  off  {kind.name:{width}s} {kind.summary}" for kind in off),
            ]
        )
