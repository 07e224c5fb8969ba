"""Figures of an object: which class has which, and the base classes that list those to be drawn."""

from __future__ import annotations

from collections.abc import Callable
from functools import partial, singledispatch
from importlib import import_module
from inspect import isfunction, signature
from typing import Any, Generic, TypeVar

from ...errors import nearest
from ...scene.curve import Curve
from ...scene.figures import Drawn
from ...scene.tabular import Tabular
from ..curves import curve_names, curves
from ..style import Axes

__all__ = [
    "AnyCurveFigures",
    "CurveFigures",
    "Figures",
    "figures_of",
    "of_absent_effects",
    "pictures",
    "registered_figures",
]

# Each has a module of figures here.
_ROOMS = ("analyses", "contact", "fitting", "scene", "separation", "studies")

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


def pictures(owner: Any) -> dict[str, Callable[[], Axes]]:
    """Figures that runs and pages draw of a result or a plan, by name; none of what has none."""
    return figures_of(owner).pictures() if isinstance(owner, Drawn) else {}


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
        hidden = self._hidden() | {"pictures"}
        offered = (pair for kind in reversed(type(self).__mro__) for pair in vars(kind).items())
        figures = dict.fromkeys(n for n, one in offered if n[0] != "_" and isfunction(one))
        return tuple(name for name in figures if name not in hidden)

    def _hidden(self) -> frozenset[str]:
        """Names of methods that this object has nothing for."""
        return frozenset()

    def pictures(self) -> dict[str, Callable[[], Axes]]:
        """Figures in a plane that need no argument, by name: what runs and pages draw."""
        found = {name: getattr(self, name) for name in self.available}
        return {name: draw for name, draw in found.items() if _needs_nothing(draw)}

    def __dir__(self) -> list[str]:
        offered = [name for name in object.__dir__(self) if name[0] != "_"]
        return [name for name in offered if name not in self._hidden()]

    def __repr__(self) -> str:
        return f"figures: {', '.join(self.available)}"


def _needs_nothing(draw: Callable[..., Any]) -> bool:
    """Whether a figure goes on axes, and has a default for everything else."""
    known = signature(draw).parameters
    return "ax" in known and all(one.default is not one.empty for one in known.values())


@registered_figures.register(Tabular)
class CurveFigures(Figures[C]):
    """Figures of curves by their names; those of a result that has no others."""

    def pictures(self) -> dict[str, Callable[[], Axes]]:
        """See `Figures.pictures`; without any, all curves of a unit in a figure."""
        if found := super().pictures():
            return found
        quantities = self._owner.contents().quantities
        units: dict[str, list[str]] = {}
        for name in self.curve_names:
            if name not in quantities[name].axes:
                units.setdefault(quantities[name].unit, []).append(name)
        return {names[0]: partial(self.curves, *names) for names in units.values()}

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


@registered_figures.register(Curve)
class AnyCurveFigures(CurveFigures[Curve]):
    """Figures of any curve: those that its class names, `Curve.shown`, and its columns."""

    def __getattr__(self, name: str) -> Callable[..., Axes]:
        """Return the function that draws a figure of `Curve.shown`."""
        if name[0] == "_" or name not in self._owner.shown:
            known = ", ".join(self.available)
            raise AttributeError(f"no figure {name!r}; {nearest(name, self.available)}; {known}")
        columns, over = self._owner.shown[name]
        draw: Callable[..., Axes] = partial(self.curves, *columns, over=over)
        return draw

    @property
    def available(self) -> tuple[str, ...]:
        """Names of the figures that can be drawn."""
        return tuple(dict.fromkeys((*super().available, *self._owner.shown)))

    def __dir__(self) -> list[str]:
        return [*super().__dir__(), *self._owner.shown]

    def pictures(self) -> dict[str, Callable[[], Axes]]:
        """See `Figures.pictures`."""
        return {name: getattr(self, name) for name in self._owner.shown} or super().pictures()


def of_absent_effects(plan: Any) -> frozenset[str]:
    """Names of the figures of effects that a scene may list and does not."""
    owned = {name for kind in plan.known_effects for name in kind.figures}
    return frozenset(owned - {name for effect in plan.scene.effects for name in effect.figures})
