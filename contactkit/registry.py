"""Registries: the classes of a family by their names in files, imported when they are needed."""

from __future__ import annotations

import inspect
import re
from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager
from typing import Any, Generic, Literal, TypeVar

from ._lazy import named
from .errors import DescriptionError, nearest
from .installed import installed_kinds, refuse_installed

__all__ = ["Registries", "Registry", "family_of"]

K = TypeVar("K", bound=type)
T_co = TypeVar("T_co", covariant=True)


def family_of(kind: Any) -> str:
    """Family of a class, which its base class declares as ``family``; empty for none."""
    found = getattr(kind, "family", "") if isinstance(kind, type) else ""
    return found if isinstance(found, str) else ""


class _Listing(Sequence[type[T_co]], Generic[T_co]):
    """Classes in the order of tables and printed plans, of one registry or of several."""

    def _registries(self) -> tuple[Registry[T_co], ...]:
        raise NotImplementedError

    def __iter__(self) -> Iterator[type[T_co]]:
        for registry in self._registries():
            yield from registry.listed()

    def __getitem__(self, index: Any) -> Any:
        return tuple(self)[index]

    def __len__(self) -> int:
        return sum(1 for _ in self)

    def __contains__(self, kind: object) -> bool:
        return any(registry.name_of(kind) for registry in self._registries())

    @property
    def names(self) -> str:
        """Names of the classes, for messages."""
        return ", ".join(kind.__name__ for kind in self)

    @property
    def by_name(self) -> dict[str, type[T_co]]:
        """Classes by their names in files."""
        return {one.name_of(kind): kind for one in self._registries() for kind in one.listed()}

    def get(self, name: str) -> type[T_co] | None:
        """Return the class of a name; None if there is none. No other class is imported."""
        found = (registry.get(name) for registry in self._registries())
        return next((kind for kind in found if kind is not None), None)

    def of(self, kind: object) -> Registry[T_co] | None:
        """Return the registry of the family of a class; None for a class of no family."""
        family = family_of(kind)
        return next((one for one in self._registries() if family and one.family == family), None)

    def find(self, name: object, field: str = "") -> type[T_co]:
        """Return the class of a name in files; of other packages only that one is imported.

        Raises
        ------
        DescriptionError
            If there is none, or the package that declares it cannot be imported.
        """
        registries = self._registries()
        if isinstance(name, str) and (kind := self.get(name)) is not None:
            return kind
        hint = ""
        for group, what in dict.fromkeys((one.group, one.what) for one in registries if one.group):
            broken = [found for found in installed_kinds(group, str(name)) if found.problem]
            hint = hint or (refuse_installed(broken[0], what, broken[0].problem) if broken else "")
        raise DescriptionError(
            field or registries[0].tag,
            name,
            "name a known kind",
            hint=hint or nearest(name, sorted(self.by_name)),
        )

    def register(self, kind: K) -> K:
        """Add a class of your own, so that plans, files, results and studies know it by name.

        Defined again, as by a cell of a notebook that is run twice, it replaces the former.

        Parameters
        ----------
        kind : type
            An attrs class of one of these families, whose name is new. May be used as a
            decorator, above that of attrs.

        Returns
        -------
        type
            The same class.

        Raises
        ------
        DescriptionError
            If it is of no such family, is not complete, or its name is taken.
        """
        registries = self._registries()
        home = self.of(kind)
        if home is None:
            bases = dict.fromkeys(one.role for one in registries)
            problem = f"give a class whose base class is {' or '.join(bases)}"
        else:
            problem = _problem(kind, home.attribute)
        if home is None or problem:
            raise DescriptionError("register(kind)", kind, "be a kind of its family", hint=problem)
        name: str = getattr(kind, home.attribute)
        for other in (one.get(name) for one in registries if one.group == home.group):
            if other is not None and _origin(other) != _origin(kind):
                raise DescriptionError(
                    f"{kind.__name__}.{home.attribute}",
                    name,
                    f"be a name that no other {home.what} has",
                    hint=f"{other.__module__}.{other.__qualname__} has it",
                )
        home.own[name] = kind
        return kind

    @contextmanager
    def including(self, *kinds: type) -> Iterator[None]:
        """Have classes in the registry for the length of a ``with`` block.

        Those that are registered inside leave it too.
        """
        before = [(one, dict(one.own)) for one in self._registries()]
        try:
            for kind in kinds:
                self.register(kind)
            yield
        finally:
            for registry, own in before:
                registry.own.clear()
                registry.own.update(own)


class Registry(_Listing[T_co]):
    """Classes of one family by their names in files, each imported when it is needed.

    Those of other packages come last: what `register` was given, and what entry points declare.

    Parameters
    ----------
    family : str
        The ``family`` that the base class declares.
    homes : mapping
        Module and class by the name in files, ``"scene.surfaces:Flat"``; the module is relative to
        contactkit.
    tag : str
        Key of a table in a file that holds the name.
    what : str
        A class of it in a word or two, for messages; families of one `group` share it.
    group : str
        Group of the entry points of other packages; names are unique within it. Empty: none.
    role : str
        What the base class is, for messages.
    attribute : str
        Attribute of a class that is its name in files.
    naming : {"tagged", "plain"} or tuple of str
        How files name a kind: by the tag in its table; ``"plain"``: also by its name alone where
        its fields are at their defaults; a tuple: those kinds by their keys alone.

    Examples
    --------
    >>> laws = Registry(
    ...     "temperature law",
    ...     {"linear-density": "liquids.temperature_laws:LinearDensity"},
    ...     tag="law",
    ... )
    >>> laws.find("linear-density").__name__, len(laws)
    ('LinearDensity', 1)
    """

    def __init__(
        self,
        family: str,
        homes: Mapping[str, str],
        *,
        tag: str,
        what: str = "",
        group: str = "",
        role: str = "",
        attribute: str = "kind",
        naming: Literal["tagged", "plain"] | tuple[str, ...] = "tagged",
    ) -> None:
        self.family, self.homes, self.tag, self.group = family, homes, tag, group
        self.what = what or family
        self.role, self.attribute, self.plain = role, attribute, naming == "plain"
        self.implied = naming if isinstance(naming, tuple) else ()
        self.own: dict[str, type[T_co]] = {}
        """Classes that `register` was given, by their names."""

    def _registries(self) -> tuple[Registry[T_co], ...]:
        return (self,)

    def listed(self) -> Iterator[type[T_co]]:
        """Every class: those of contactkit, registered ones, those of installed packages."""
        known = [*map(self._ours, self.homes), *self.own.values()]
        yield from known
        yield from self._installed(known)

    def get(self, name: str) -> type[T_co] | None:
        """Return the class of a name; None if there is none. No other class is imported."""
        if name in self.homes:
            return self._ours(name)
        if name in self.own:
            return self.own[name]
        return next(self._installed((), name), None)

    def name_of(self, kind: object) -> str:
        """Name of a class in files; empty if it is not registered."""
        if family_of(kind) != self.family:
            return ""
        name = getattr(kind, self.attribute, "")
        return name if isinstance(name, str) and self.get(name) is kind else ""

    def _ours(self, name: str) -> type[T_co]:
        found: type[T_co] = named(f"{__package__}.{self.homes[name]}")
        return found

    def _installed(
        self, known: Sequence[type[T_co]], name: str | None = None
    ) -> Iterator[type[T_co]]:
        """Classes of other packages of this family; a warning for each that cannot be used."""
        kinds = list(known)
        for found in installed_kinds(self.group, name) if self.group else ():
            kind = found.kind
            problem = found.problem or _problem(kind, self.attribute)
            if not family_of(kind):
                problem = problem or f"give a class whose base class is {self.role}"
            elif family_of(kind) != self.family:
                continue
            own = getattr(kind, self.attribute, "")
            if not problem and own != found.name:
                problem = f"its name is {own!r}, and that of its entry point must be the same"
            if not problem and (
                own in self.homes or any(self._named(k) == own and k is not kind for k in kinds)
            ):
                problem = f"there is another {self.what} of this name"
            if problem:
                refuse_installed(found, self.what, problem)
            elif kind not in kinds:
                kinds.append(kind)
                yield kind

    def _named(self, kind: type) -> object:
        return getattr(kind, self.attribute, "")


class Registries(_Listing[T_co]):
    """Several registries as one, such as all effects.

    Parameters
    ----------
    *registries : Registry or Registries
        In the order of tables.
    """

    def __init__(self, *registries: _Listing[T_co]) -> None:
        self._parts = tuple(part for one in registries for part in one._registries())

    def _registries(self) -> tuple[Registry[T_co], ...]:
        return self._parts


def _origin(kind: type) -> tuple[str, str]:
    return kind.__module__, kind.__qualname__


def _problem(kind: Any, attribute: str) -> str:
    """State what is missing from a class that is to be registered; empty if nothing is."""
    if not (isinstance(kind, type) and family_of(kind)):
        return ""
    if "__attrs_attrs__" not in vars(kind):
        return f"decorate {kind.__name__} with @attrs.frozen(kw_only=True)"
    if inspect.isabstract(kind):
        return f"{kind.__name__} needs {', '.join(sorted(vars(kind)['__abstractmethods__']))}"
    declared = {
        name
        for one in kind.__mro__
        for name, annotation in vars(one).get("__annotations__", {}).items()
        if str(annotation).startswith("ClassVar")
    }
    if missing := sorted(name for name in declared if not hasattr(kind, name)):
        return f"{kind.__name__} needs {', '.join(missing)}"
    name = getattr(kind, attribute)
    if not (isinstance(name, str) and re.fullmatch(r"[a-z0-9]+(-[a-z0-9]+)*", name)):
        return f"the {attribute} of {kind.__name__} must be of small letters and hyphens: 'my-own'"
    return ""
