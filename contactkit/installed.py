"""Kinds of other packages, declared as entry points: found at once, imported when needed."""

from __future__ import annotations

import warnings
from collections.abc import Iterator
from functools import cache
from typing import Any, NamedTuple

from .errors import InstalledKindWarning

__all__ = ["InstalledKind", "forget_installed", "installed_kinds", "refuse_installed"]


class InstalledKind(NamedTuple):
    """Class of an entry point, or the problem with it.

    `name` and `target` are those of the entry point, ``name-in-files = "package.module:Class"``;
    `package` is the one that declares it. `problem` is empty if `kind` could be imported.
    """

    name: str
    target: str
    package: str
    kind: Any
    problem: str


def installed_kinds(group: str, name: str | None = None) -> Iterator[InstalledKind]:
    """Yield what the entry points of a group lead to, all or those of a name, imported once."""
    for entry in _entries(group):
        if name is None or entry.name == name:
            yield _imported(entry)


def refuse_installed(found: InstalledKind, what: str, problem: str) -> str:
    """Warn once that a class of another package cannot be used; return the message."""
    message = (
        f"the {what} {found.name!r} of the package {found.package!r} ({found.target}) cannot be "
        f"used: {problem}; update or uninstall {found.package!r}"
    )
    if message not in _refused:
        _refused.add(message)
        warnings.warn(message, InstalledKindWarning, stacklevel=2)
    return message


def forget_installed() -> None:
    """Look for entry points again, as after a package was installed while Python runs."""
    _entries.cache_clear()
    _imported.cache_clear()
    _refused.clear()


_refused: set[str] = set()


@cache
def _entries(group: str) -> tuple[Any, ...]:
    from importlib.metadata import entry_points  # takes longer than a small import should

    return tuple(entry_points(group=group))


@cache
def _imported(entry: Any) -> InstalledKind:
    package = entry.dist.name if entry.dist is not None else entry.module
    kind, problem = None, ""
    try:
        kind = entry.load()
    except Exception as error:  # noqa: BLE001 - whatever the import of another package raises
        problem = f"{type(error).__name__}: {error}"
    return InstalledKind(entry.name, entry.value, package, kind, problem)
