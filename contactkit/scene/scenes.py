"""Scenes: an interface, its loading, and the effects to simulate; no others are run."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING, Any, TypeVar

from attrs import Attribute, field, frozen

from ..errors import PlanError
from ..kinds import CONTACT_LOADINGS, SEPARATION_LOADINGS
from ..units import celsius, si
from ..validators import Described, as_tuple, part, positive, refuse
from .effect import Effect
from .interface import Interface
from .loading import (
    ContactLoading,
    ImposedForce,
    Loading,
    SeparationLoading,
    Sliding,
)
from .meniscus import Meniscus
from .window import Window

__all__ = ["ContactScene", "InWords", "Scene", "SeparationScene", "SlidingScene"]

if TYPE_CHECKING:
    from ..registry import Registry

_E = TypeVar("_E", bound=Effect)


def _loading(base: type[Loading], known: Registry[Any]) -> Callable[[Any, Any, Any], None]:
    """Refuse what is no loading of a kind of scene."""

    def check_loading(owner: object, attribute: Attribute[Any], value: Any) -> None:
        if not isinstance(value, base):
            names = " or ".join(kind.__name__ for kind in known)
            raise refuse(owner, attribute, value, f"be a {names}")

    return check_loading


class InWords:
    """Text of a scene, as `print` and notebooks show it."""

    __slots__ = ()

    def __str__(self) -> str:
        """The scene in words, a line for each part; what is at its default is left out."""
        from .description import described  # for this alone

        return "\n".join(described(self).indented())

    def _repr_html_(self) -> str:
        """The same in a notebook."""
        from ..export.html import nested_list
        from .description import described

        return nested_list(described(self))


@frozen(kw_only=True)
class Scene(InWords, Described):
    """Two bodies, their loading, and the effects to simulate: the base class of all scenes."""

    name: str = ""
    temperature: float = field(default=celsius(20.0), validator=positive, metadata=si("K"))
    interface: Interface = field(validator=part(Interface))
    loading: Loading = field(validator=part(Loading))
    effects: tuple[Effect, ...] = field(converter=as_tuple)

    @property
    def run_by(self) -> str:
        """Name of the function that runs the plan of such a scene."""
        return "simulate"

    @property
    def reads(self) -> frozenset[str]:
        """Names of the settings of `Accuracy` that its solution reads."""
        effects = [effect for effect in self.effects if isinstance(effect, Effect)]
        leading = [effect for effect in effects if effect.solves_motion]
        of_loading = () if leading else self.loading.reads
        return frozenset(of_loading).union(*(e.reads(self) for e in leading or effects))

    def effect(self, kind: type[_E]) -> _E | None:
        """Return the effect of a kind; None if the scene does not call for it."""
        return next((effect for effect in self.effects if isinstance(effect, kind)), None)

    def demand(self, kind: type[_E]) -> _E:
        """Return the effect of a kind; a scene that does not call for it is refused.

        Raises
        ------
        PlanError
            If no effect is of the kind.
        """
        found = self.effect(kind)
        if found is None:
            raise PlanError(
                f"a {type(self).__name__} with these effects needs {kind.__name__} beside them: "
                "add it to effects"
            )
        return found

    @property
    def meniscus(self) -> Meniscus:
        """The meniscus of the interface; a scene without one is refused."""
        if self.interface.meniscus is None:
            raise PlanError(
                f"a {type(self).__name__} with these effects needs interface.meniscus: the liquid, "
                "its amount and its contact angles"
            )
        return self.interface.meniscus

    @property
    def liquid_pressure(self) -> float | None:
        """Pressure of the liquid [Pa], given or of its relative humidity; None for a volume."""
        return self.meniscus.pressure_at(self.temperature)


@frozen(kw_only=True)
class ContactScene(Scene):
    """Two bodies pressed together, and slid if the effects say so.

    Parameters
    ----------
    interface : Interface
        The bodies, and the liquid between them if any.
    window : Window
        The part of the interface that is looked at.
    loading : Pressing or Approach
        What is imposed: a pressure or a force, or the approach.
    effects : tuple of effects
        The physics to simulate, and nothing else.
    temperature : float
        Temperature of the liquid [K].
    name : str
        A title for tables and figures.
    """

    window: Window = field(factory=Window, validator=part(Window))
    loading: ContactLoading = field(validator=_loading(ContactLoading, CONTACT_LOADINGS))
    effects: tuple[Effect, ...] = field(converter=as_tuple)

    @property
    def run_by(self) -> str:
        """See `Scene.run_by`."""
        return "solve"


@frozen(kw_only=True)
class SeparationScene(Scene):
    """Two wetted bodies that are pulled apart along their common normal.

    Parameters
    ----------
    interface : Interface
        The bodies and the liquid between them.
    loading : ImposedSpeed, ImposedForce or ImposedTime
        What is imposed, and from which gap to which.
    effects : tuple of effects
        The physics to simulate, and nothing else.
    temperature : float
        Temperature of the liquid [K].
    name : str
        A title for tables and figures.
    """

    loading: SeparationLoading = field(validator=_loading(SeparationLoading, SEPARATION_LOADINGS))
    effects: tuple[Effect, ...] = field(converter=as_tuple)

    @property
    def initial_gap(self) -> float:
        """Gap at the start [m]."""
        return self.loading.initial_gap

    @property
    def imposed_force(self) -> ImposedForce:
        """The imposed force and the mass it moves; another loading is refused."""
        if not isinstance(self.loading, ImposedForce):
            raise PlanError(
                f"a motion needs loading = ImposedForce(...), got {type(self.loading).__name__}"
            )
        return self.loading


@frozen(kw_only=True)
class SlidingScene(Scene):
    """Two wetted bodies, one of which slides past the other at a held gap.

    Parameters
    ----------
    interface : Interface
        The bodies and the liquid between them.
    loading : Sliding
        What is imposed: the gap, and a speed or a time.
    effects : tuple of effects
        The physics to simulate, and nothing else.
    temperature : float
        Temperature of the liquid [K].
    name : str
        A title for tables and figures.
    """

    loading: Sliding = field(validator=part(Sliding))
    effects: tuple[Effect, ...] = field(converter=as_tuple)

    @property
    def initial_gap(self) -> float:
        """Gap at the start [m], which is held."""
        return self.loading.gap
