"""Base class of all plans: the effects that are on and off, and their sources."""

from __future__ import annotations

import abc
from os import PathLike
from typing import Any, ClassVar, Protocol

from ..accuracy import Accuracy
from ..errors import NotSimulatedError, PlanError
from ..registry import Registries, Registry
from .effect import Effect, as_written, choices
from .scenes import Scene

__all__ = ["ScenePlan", "check_accuracy", "check_plan", "check_scene"]


class _Scene(Protocol):
    @property
    def name(self) -> str: ...

    @property
    def effects(self) -> tuple[Effect, ...]: ...

    @property
    def run_by(self) -> str: ...


class ScenePlan(abc.ABC):
    """A checked and prepared scene.

    ``print(plan)`` says what will be simulated and what will not; `cite` gives the sources.
    """

    __slots__ = ()

    known_effects: ClassVar[Registry[Any] | Registries[Any]]
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

    @property
    def notes(self) -> tuple[str, ...]:
        """Events of the run that the plan foresees, in sentences; ``print(plan)`` shows them."""
        return ()

    @property
    def methods(self) -> tuple[str, ...]:
        """Sources of the numerical methods of this run."""
        return ()

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
        _check_kind(kind)
        raise NotSimulatedError(
            f"the scene does not call for {kind.name}: add {as_written(kind)} to its effects"
        )

    def cite(self) -> str:
        """Sources of the equations and methods of this run, one to a line.

        `contactkit.cite` gives the works that they name.
        """
        effects, scene = self.scene.effects, self.scene
        lines = [f"{e.name}: {source}" for e in effects for source in e.cites(scene)]
        return "\n".join([*lines, *(f"solver: {source}" for source in self.methods)])

    def __str__(self) -> str:
        effects = self.scene.effects
        off = [kind for kind in self.known_effects if not self.has(kind)]
        width = max([len(effect.name) for effect in effects] + [len(kind.name) for kind in off])
        return "\n".join(
            [
                self.title,
                *(f"  on   {effect.name:{width}s} {choices(effect)}" for effect in effects),
                *(f"  off  {kind.name:{width}s} {kind.summary}" for kind in off),
                *(f"  {note}" for note in self.notes),
            ]
        )

    def _repr_html_(self) -> str:
        """The plan in a notebook."""
        from ..export.html import effects_table

        on = [(effect.name, choices(effect) or effect.summary) for effect in self.scene.effects]
        off = [kind.name for kind in self.known_effects if not self.has(kind)]
        return effects_table(self.title, on, off, self.notes)


def check_plan(given: object, kinds: type[ScenePlan] | tuple[type[ScenePlan], ...]) -> None:
    """Refuse to run a scene that is not planned, or a plan of another kind of scene.

    Raises
    ------
    PlanError
        With the call that runs it.
    """
    if isinstance(given, kinds):
        return
    if isinstance(given, Scene):
        cure = f"plan the scene first: ck.{given.run_by}(ck.plan(scene))"
    elif isinstance(given, ScenePlan):
        cure = f"its plan is run by ck.{given.scene.run_by}(plan)"
    else:
        cure = "give the plan of a scene, ck.plan(scene)"
    known = kinds if isinstance(kinds, tuple) else (kinds,)
    raise PlanError(f"{_names(known)} can be run here, got {_name(given)}; {cure}")


def check_scene(given: object, kinds: type[Scene] | tuple[type[Scene], ...]) -> None:
    """Refuse what is no scene of some kinds.

    Raises
    ------
    PlanError
        With the cure.
    """
    if isinstance(given, kinds):
        return
    cure = ""
    if isinstance(given, ScenePlan):
        cure = "; it is a plan already, whose scene is plan.scene"
    elif isinstance(given, str | PathLike):
        cure = "; a scene file is read by ck.load_scene(path)"
    known = kinds if isinstance(kinds, tuple) else (kinds,)
    raise PlanError(f"{_names(known)} is needed here, got {_name(given)}{cure}")


def check_accuracy(given: object, scene: Scene) -> None:
    """Refuse what is no `Accuracy`, such as a tolerance or a name, and settings that nothing reads.

    Raises
    ------
    PlanError
        With the cure.
    """
    if not (given is None or isinstance(given, Accuracy)):
        known = isinstance(given, str) and hasattr(Accuracy, given)
        cure = f"ck.Accuracy.{given}" if known else "ck.Accuracy(rtol=...)"
        raise PlanError(f"an Accuracy is needed beside the scene, got {given!r}; write {cure}")
    if not (isinstance(given, Accuracy) and given.given):
        return
    if name := given.unread(scene.reads):
        what = f"{type(scene).__name__} with {type(scene.loading).__name__}"
        raise _unread(given, name, f"a {what} and these effects")
    if "max_iterations" in given.given and given.method == "active-set":
        raise _unread(given, "max_iterations", "the method active-set")


def _unread(given: Accuracy, name: str, reader: str) -> PlanError:
    value = getattr(given, name)
    return PlanError(f"Accuracy.{name} = {value!r} is not read by {reader}: leave it out")


def _check_kind(given: object) -> None:
    """Refuse an effect, or its name, where its class is needed."""
    if not (isinstance(given, type) and issubclass(given, Effect)):
        name = type(given).__name__ if isinstance(given, Effect) else "MeniscusForce"
        raise PlanError(f"the class of an effect is needed, such as ck.{name}, got {given!r}")


def _names(kinds: tuple[type, ...]) -> str:
    return "a " + " or a ".join(kind.__name__ for kind in kinds)


def _name(given: object) -> str:
    return "None" if given is None else f"a {type(given).__name__}"
