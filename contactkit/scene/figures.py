"""Figures of a result as methods, ``result.plot``: one property for everything that has figures."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, Protocol

from .._lazy import above

__all__ = ["Drawn", "Figures"]


class Figures(Protocol):
    """Figures of one object as methods: those in a plane take ``ax=`` and return the axes."""

    @property
    def available(self) -> tuple[str, ...]:
        """Names of the figures that can be drawn."""

    def __getattr__(self, name: str) -> Callable[..., Any]:
        """Return a figure by its name."""


class Drawn:
    """Base class of all that has figures; `plot/` registers them by class (`figures_of` there)."""

    __slots__ = ()

    @property
    def plot(self) -> Figures:
        """Figures as methods: ``result.plot.available``, ``result.plot.forces(ax=ax)``.

        Raises
        ------
        MissingExtraError
            If matplotlib is not installed: ``pip install contactkit[plot]``.
        """
        figures: Figures = above("figures_of")(self)
        return figures
