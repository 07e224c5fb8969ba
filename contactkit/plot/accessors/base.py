"""Figures of an object: which class has which, and the base classes that list those to be drawn."""

from __future__ import annotations

from functools import singledispatch
from importlib import import_module
from inspect import isfunction
from typing import Any, Generic, TypeVar

from ...scene.tabular import Tabular
from ..curves import curve_names, curves
from ..style import Axes

__all__ = ["CurveFigures", "Figures", "figures_of", "of_absent_effects", "registered_figures"]

_ROOMS = ("analyses", "contact", "separation", "studies")  # each with a module of figures here

T = TypeVar("T")
C = TypeVar("C", bound=Tabular)


@singledispatch
def registered_figures(owner: Any) -> Figures[Any]:
    """Return the figures of an object: a registry by its class (`functools.singledispatch`).

    A result of one's own joins with ``registered_figures.register(OwnResult, OwnFigures)``.
    """
    raise TypeError(
        f"no figures are known for a {type(owner).__name__}: register a class of figures with "
        "contactkit.plot.accessors.base.registered_figures.register"
    )


def figures_of(owner: Any) -> Figures[Any]:
    """Return the figures of an object; what `scene.figures.Drawn.plot` calls.

    The figures of a room register when one of its objects is drawn first, so that a film draws
    without contacts being imported.
    """
    for kind in type(owner).__mro__:
        names = kind.__module__.split(".")
        if names[0] == "contactkit" and len(names) > 1 and names[1] in _ROOMS:
            import_module(f"contactkit.plot.accessors.{names[1]}")
    return registered_figures(owner)


class Figures(Generic[T]):
    """Figures of one object as methods; those in a plane take ``ax=`` and return the axes.

    `available` lists those that this object can draw, as ``dir`` and ``print`` do. One of an
    effect that the scene does not list raises `NotSimulatedError`.
    """

    def __init__(self, owner: T) -> None:
        self._owner = owner

    @property
    def available(self) -> tuple[str, ...]:
        """Names of the figures that can be drawn."""
        hidden = self._hidden()
        offered = (pair for kind in reversed(type(self).__mro__) for pair in vars(kind).items())
        figures = dict.fromkeys(n for n, one in offered if n[0] != "_" and isfunction(one))
        return tuple(name for name in figures if name not in hidden)

    def _hidden(self) -> frozenset[str]:
        """Names of methods that this object has nothing for."""
        return frozenset()

    def __dir__(self) -> list[str]:
        offered = [name for name in object.__dir__(self) if name[0] != "_"]
        return [name for name in offered if name not in self._hidden()]

    def __repr__(self) -> str:
        return f"figures: {', '.join(self.available)}"


class CurveFigures(Figures[C]):
    """Figures of curves by their names."""

    def curves(self, *names: str, over: str = "", ax: Axes | None = None) -> Axes:
        """Draw curves of one unit over another one.

        Parameters
        ----------
        *names : str
            What to draw, one or more of `curve_names`.
        over : str
            Curve to draw them over; the axis of the curves if not given.
        ax : Axes, optional
            Where to draw; a new figure if not given.

        Raises
        ------
        DescriptionError
            If there is no such curve, or curves differ in their unit.
        """
        return curves(self._owner.contents(), names, over, ax)

    @property
    def curve_names(self) -> tuple[str, ...]:
        """Names of the curves that `curves` draws."""
        return curve_names(self._owner.contents())


def of_absent_effects(plan: Any) -> frozenset[str]:
    """Names of the figures of effects that a scene may list and does not."""
    owned = {name for kind in plan.known_effects for name in kind.figures}
    return frozenset(owned - {name for effect in plan.scene.effects for name in effect.figures})
