"""Effects of other packages, declared as entry points: found at once, imported when needed."""

from __future__ import annotations

import warnings
from collections.abc import Iterator
from functools import cache
from typing import Any, NamedTuple

from ..errors import InstalledEffectWarning

__all__ = ["GROUP", "InstalledEffect", "forget_installed", "installed_effects", "refuse_installed"]

GROUP = "contactkit.effects"
"""Group of the entry points: ``name-in-files = "package.module:Class"``."""


class InstalledEffect(NamedTuple):
    """Effect of an entry point, or the problem with it.

    `name` and `target` are those of the entry point, `package` is the one that declares it;
    `problem` is empty if `kind` could be imported.
    """

    name: str
    target: str
    package: str
    kind: Any
    problem: str


def installed_effects(name: str | None = None) -> Iterator[InstalledEffect]:
    """Yield what entry points lead to, all of them or those of a name; each is imported once."""
    for entry in _entries():
        if name is None or entry.name == name:
            yield _imported(entry)


def refuse_installed(found: InstalledEffect, problem: str) -> str:
    """Warn once that an effect of another package cannot be used; return the message."""
    message = (
        f"the effect {found.name!r} of the package {found.package!r} ({found.target}) cannot be "
        f"used: {problem}; update or uninstall {found.package!r}"
    )
    if message not in _refused:
        _refused.add(message)
        warnings.warn(message, InstalledEffectWarning, stacklevel=2)
    return message


def forget_installed() -> None:
    """Look for entry points again, as after a package was installed while Python runs."""
    _entries.cache_clear()
    _imported.cache_clear()
    _refused.clear()


_refused: set[str] = set()


@cache
def _entries() -> tuple[Any, ...]:
    from importlib.metadata import entry_points  # takes longer than a small import should

    return tuple(entry_points(group=GROUP))


@cache
def _imported(entry: Any) -> InstalledEffect:
    package = entry.dist.name if entry.dist is not None else entry.module
    kind, problem = None, ""
    try:
        kind = entry.load()
    except Exception as error:  # noqa: BLE001 - whatever the import of another package raises
        problem = f"{type(error).__name__}: {error}"
    return InstalledEffect(entry.name, entry.value, package, kind, problem)
