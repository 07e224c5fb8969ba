"""Names of a package that are imported when they are first asked for (PEP 562)."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from importlib import import_module
from typing import Any

__all__ = ["lazy_names"]


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
            return getattr(import_module(f"{package}.{homes[name]}"), name)
        from difflib import get_close_matches  # for this alone

        close = [] if name.startswith("_") else get_close_matches(name, homes, n=1)
        cure = f"; did you mean {close[0]!r}?" if close else ""
        raise AttributeError(f"module {package!r} has no attribute {name!r}{cure}")

    return attribute
