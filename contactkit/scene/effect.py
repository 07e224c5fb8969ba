"""Base class of all effects, the physics that a scene may list, and their registry."""

from __future__ import annotations

import abc
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from typing import Any, ClassVar, Generic, TypeVar

from attrs import NOTHING, fields, frozen

from ..errors import PlanError
from ..validators import Described

__all__ = ["Effect", "EffectRegistry", "as_written", "check_listed", "choices"]


@frozen(kw_only=True)
class Effect(Described, abc.ABC):
    """A piece of physics a scene may list. Subclasses are final and hold choices only."""

    name: ClassVar[str]
    summary: ClassVar[str]
    figures: ClassVar[tuple[str, ...]] = ()
    """Figures of a result that this effect makes possible: methods of ``result.plot``."""

    @property
    @abc.abstractmethod
    def sources(self) -> tuple[str, ...]:
        """Sources of the equations of this choice."""

    def cites(self, scene: Any) -> tuple[str, ...]:
        """Sources of what this choice computes for a scene; all of them, unless it depends."""
        return self.sources

    def lacks(self, scene: Any) -> tuple[str, ...]:
        """Name what this effect needs and `scene` does not give, with units."""
        return ()


E_co = TypeVar("E_co", bound=Effect, covariant=True)


class EffectRegistry(Sequence[type[E_co]], Generic[E_co]):
    """The effects that a kind of scene may list, in the order of tables and printed plans.

    Scene files, printed plans, tables of the documentation and messages follow from it. An entry
    may be another registry.

    Examples
    --------
    >>> registry = EffectRegistry[Effect]()
    >>> class Sway(Effect):
    ...     name = "sway"
    ...     summary = "an effect of one's own"
    ...     sources = ("nobody",)
    >>> with registry.including(Sway):
    ...     Sway in registry, registry.names
    (True, 'Sway')
    >>> len(registry)
    0
    """

    def __init__(self, *entries: type[E_co] | EffectRegistry[E_co]) -> None:
        self._entries: list[Any] = list(entries)

    def _kinds(self) -> Iterator[type[E_co]]:
        for entry in self._entries:
            if isinstance(entry, EffectRegistry):
                yield from entry
            else:
                yield entry

    def __getitem__(self, index: Any) -> Any:
        return tuple(self._kinds())[index]

    def __len__(self) -> int:
        return sum(1 for _ in self._kinds())

    @property
    def names(self) -> str:
        """Names of the classes, for messages."""
        return ", ".join(kind.__name__ for kind in self)

    @property
    def by_name(self) -> dict[str, type[E_co]]:
        """Effects by their names in files."""
        return {kind.name: kind for kind in self}

    def register(self, kind: type[Effect]) -> None:
        """Add an effect of a package of your own, so that files can name it."""
        self._entries.append(kind)

    @contextmanager
    def including(self, *kinds: type[Effect]) -> Iterator[None]:
        """Have effects in the registry for the length of a ``with`` block."""
        before = list(self._entries)
        self._entries += kinds
        try:
            yield
        finally:
            self._entries[:] = before


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
    effects: Sequence[object], role: type, scene: str, known: str
) -> list[type[object]]:
    """Refuse what is no effect of a kind of scene, or is listed twice; return the kinds."""
    for effect in effects:
        if not isinstance(effect, role):
            cure = f"known: {known}"
            if isinstance(effect, type) and issubclass(effect, Effect) and issubclass(effect, role):
                cure = f"it is a class: write {as_written(effect)}"
            raise PlanError(f"{effect!r} is not an effect of a {scene} scene; {cure}")
    kinds = [type(effect) for effect in effects]
    if twice := sorted({k.__name__ for k in kinds if kinds.count(k) > 1}):
        raise PlanError(f"listed more than once: {', '.join(twice)}")
    return kinds
