"""Lazy imports: names of a package (PEP 562), functions of rooms above, and ``module:name``."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from importlib import import_module
from sys import modules
from typing import Any

__all__ = ["ABOVE", "above", "lazy_names", "named"]

ABOVE = {
    "figures_of": "plot.accessors.base",
    "save_curve": "files.curves",
    "save_result": "files.results",
}
"""Functions of rooms above that a result offers as a property or a method, with their modules.

`result.plot` and `result.save` are for users; a room that computes knows neither figures nor files.
"""


def above(name: str) -> Any:
    """Return a function of a room above, one of `ABOVE`; its module is imported at the first call.

    Examples
    --------
    >>> above("save_result").__name__
    'save_result'
    """
    return getattr(import_module(f"{__package__}.{ABOVE[name]}"), name)


def named(path: str) -> Any:
    """Return what ``module:name`` names; the module is imported at the first call.

    Examples
    --------
    >>> named("contactkit.accuracy:Accuracy").__name__
    'Accuracy'
    """
    module, _, name = path.partition(":")
    return getattr(import_module(module), name)


def lazy_names(package: str, homes: Mapping[str, str]) -> Callable[[str], Any]:
    """Make the ``__getattr__`` of a package.

    Parameters
    ----------
    package : str
        Its ``__name__``.
    homes : mapping
        Module of each name, relative to the package.

    Examples
    --------
    >>> later = lazy_names("contactkit", {"Accuracy": "accuracy"})
    >>> later("Accuracy").__name__
    'Accuracy'
    """

    def attribute(name: str) -> Any:
        if name in homes:
            found = getattr(import_module(f"{package}.{homes[name]}"), name)
            # Kept: the tests ask 200 000 times, 1 s in each of their processes.
            setattr(modules[package], name, found)
            return found
        from difflib import get_close_matches  # for this alone

        close = [] if name.startswith("_") else get_close_matches(name, homes, n=1)
        cure = f"; did you mean {close[0]!r}?" if close else ""
        raise AttributeError(f"module {package!r} has no attribute {name!r}{cure}")

    return attribute
