"""Base class of all effects, the physics that a scene may list, and their registry."""

from __future__ import annotations

import abc
import inspect
import re
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from typing import Any, ClassVar, Generic, TypeVar

from attrs import NOTHING, fields, frozen

from ..errors import DescriptionError, PlanError, nearest
from ..validators import Described
from .installed_effects import installed_effects, refuse_installed

__all__ = ["Effect", "EffectRegistry", "as_written", "check_listed", "choices"]


@frozen(kw_only=True)
class Effect(Described, abc.ABC):
    """A piece of physics a scene may list. Subclasses are final and hold choices only."""

    acts_in: ClassVar[str] = ""
    """Kind of scene that may list it: ``"separation"``, ``"sliding"`` or ``"contact"``."""
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

    def liquid_needs(self, scene: Any) -> tuple[str, ...]:
        """Properties of the liquid that the effect uses in a scene."""
        return ()

    def lacks(self, scene: Any) -> tuple[str, ...]:
        """Name what this effect needs and `scene` does not give, with units."""
        return ()


E_co = TypeVar("E_co", bound=Effect, covariant=True)


class EffectRegistry(Sequence[type[E_co]], Generic[E_co]):
    """The effects that a kind of scene may list, in the order of tables and printed plans.

    Scene files, printed plans, tables of the documentation and messages follow from it. An entry
    may be another registry. Effects of other packages come last: those given to `register`, and
    those declared as entry points of the group ``contactkit.effects``, which are imported when
    they are named or listed.

    Parameters
    ----------
    *entries : type or EffectRegistry
        Effects of contactkit.
    acts_in : str
        `Effect.acts_in` of what may be registered; empty for a registry of registries.

    Examples
    --------
    >>> registry = EffectRegistry[Effect](acts_in="separation")
    >>> @frozen(kw_only=True)
    ... class Sway(Effect):
    ...     acts_in = "separation"
    ...     name = "sway"
    ...     summary = "an effect of one's own"
    ...     sources = ("nobody",)
    >>> with registry.including(Sway):
    ...     Sway in registry, registry.names
    (True, 'Sway')
    >>> len(registry)
    0
    """

    def __init__(self, *entries: type[E_co] | EffectRegistry[E_co], acts_in: str = "") -> None:
        self._entries: list[Any] = list(entries)
        self.acts_in = acts_in

    def __iter__(self) -> Iterator[type[E_co]]:
        own: list[type[E_co]] = []
        for entry in self._entries:
            if isinstance(entry, EffectRegistry):
                yield from entry
            else:
                own.append(entry)
                yield entry
        if self.acts_in:
            yield from self._installed(own)

    def _installed(self, known: list[type[E_co]], name: str | None = None) -> Iterator[type[E_co]]:
        """Effects of other packages that act in these scenes; a warning for each that cannot."""
        kinds: list[Any] = list(known)
        for found in installed_effects(name):
            kind = found.kind
            problem = found.problem or _problem(kind)
            if not problem and kind.acts_in != self.acts_in:
                continue
            if not problem and kind.name != found.name:
                problem = f"its name is {kind.name!r}, and that of its entry point must be the same"
            if not problem and any(one.name == kind.name and one is not kind for one in kinds):
                problem = "there is another effect of this name"
            if problem:
                refuse_installed(found, problem)
            elif kind not in kinds:
                kinds.append(kind)
                yield kind

    def __getitem__(self, index: Any) -> Any:
        return tuple(self)[index]

    def __len__(self) -> int:
        return sum(1 for _ in self)

    @property
    def names(self) -> str:
        """Names of the classes, for messages."""
        return ", ".join(kind.__name__ for kind in self)

    @property
    def by_name(self) -> dict[str, type[E_co]]:
        """Effects by their names in files."""
        return {kind.name: kind for kind in self}

    def find(self, name: object, field: str = "effect") -> type[E_co]:
        """Return the effect of a name in files; of other packages only that one is imported.

        Raises
        ------
        DescriptionError
            If there is none, or the package that declares it cannot be imported.
        """
        if isinstance(name, str):
            for registry in self._registries():
                for kind in registry._named(name):
                    return kind
        broken = [found for found in installed_effects(str(name)) if found.problem]
        hint = refuse_installed(broken[0], broken[0].problem) if broken else ""
        raise DescriptionError(
            field, name, "name a known kind", hint=hint or nearest(name, sorted(self.by_name))
        )

    def _named(self, name: str) -> Iterator[type[E_co]]:
        """Effects of a name of this registry itself, ours first."""
        own = [one for one in self._entries if not isinstance(one, EffectRegistry)]
        yield from (one for one in own if one.name == name)
        if self.acts_in:
            yield from self._installed(own, name)

    def _registries(self) -> Iterator[EffectRegistry[E_co]]:
        yield self
        for entry in self._entries:
            if isinstance(entry, EffectRegistry):
                yield from entry._registries()

    def register(self, kind: type[Effect]) -> None:
        """Add an effect of your own, so that files can name it.

        Defined again, as by a cell of a notebook that is run twice, a class replaces the former.

        Raises
        ------
        DescriptionError
            If it is no effect of these scenes, is not complete, or its name is taken.
        """
        problem = _problem(kind)
        wanted = getattr(kind, "acts_in", "")
        homes = [one for one in self._registries() if one.acts_in and one.acts_in == wanted]
        if not problem and not homes:
            problem = f"it acts in a {wanted} scene, not in a {self.acts_in} scene"
        if problem:
            raise DescriptionError("register(effect)", kind, "be an effect", hint=problem)
        for other in (one for registry in self._registries() for one in registry._named(kind.name)):
            if _origin(other) != _origin(kind):
                raise DescriptionError(
                    f"{kind.__name__}.name",
                    kind.name,
                    "be a name that no other effect has",
                    hint=f"{other.__module__}.{other.__qualname__} has it",
                )
        entries = homes[0]._entries
        entries[:] = [one for one in entries if getattr(one, "name", None) != kind.name]
        entries.append(kind)

    @contextmanager
    def including(self, *kinds: type[Effect]) -> Iterator[None]:
        """Have effects in the registry for the length of a ``with`` block.

        Those that are registered inside leave it too.
        """
        before = [(one, list(one._entries)) for one in self._registries()]
        try:
            for kind in kinds:
                self.register(kind)
            yield
        finally:
            for registry, entries in before:
                registry._entries[:] = entries


def _origin(kind: type[Effect]) -> tuple[str, str]:
    return kind.__module__, kind.__qualname__


def _problem(kind: Any) -> str:
    """State what is missing from a class that is to be an effect; empty if nothing is."""
    if not (isinstance(kind, type) and issubclass(kind, Effect)):
        return "give a class whose base class is a role such as SeparationForce or Observer"
    if "__attrs_attrs__" not in vars(kind):
        return f"decorate {kind.__name__} with @attrs.frozen(kw_only=True)"
    if not kind.acts_in:
        return f"{kind.__name__} needs a role as base class, such as SeparationForce or Observer"
    if inspect.isabstract(kind):
        return f"{kind.__name__} needs {', '.join(sorted(kind.__abstractmethods__))}"
    declared = {
        name
        for one in kind.__mro__
        for name, annotation in vars(one).get("__annotations__", {}).items()
        if str(annotation).startswith("ClassVar")
    }
    if missing := sorted(name for name in declared if not hasattr(kind, name)):
        return f"{kind.__name__} needs {', '.join(missing)}"
    if not (isinstance(kind.name, str) and re.fullmatch(r"[a-z0-9]+(-[a-z0-9]+)*", kind.name)):
        return f"the name of {kind.__name__} must be of small letters and hyphens: 'my-force'"
    return ""


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
    effects: Sequence[object], role: type, scene: str, known: EffectRegistry[Any]
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
