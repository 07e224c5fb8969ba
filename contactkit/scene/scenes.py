"""What is there, and which physics it calls for. What is not listed is not run."""

from __future__ import annotations

from typing import TYPE_CHECKING, TypeVar

from attrs import field, frozen

from ..units import celsius, si
from ..validators import as_tuple, part, positive
from .interface import Interface, Opening, Sliding

if TYPE_CHECKING:
    from ..separation.effects.base import SeparationEffect

__all__ = ["SeparationScene", "SlidingScene"]

_E = TypeVar("_E", bound="SeparationEffect")


@frozen(kw_only=True)
class SeparationScene:
    """Two wetted bodies that are pulled apart along their common normal.

    Parameters
    ----------
    interface : Interface
        The bodies and the liquid between them.
    opening : Opening
        What is imposed: speed, force or time.
    effects : tuple of effects
        The physics to simulate, and nothing else.
    temperature : float
        Temperature of the liquid [K].
    name : str
        A title for tables and figures.
    """

    interface: Interface = field(validator=part(Interface))
    opening: Opening = field(validator=part(Opening))
    effects: tuple[SeparationEffect, ...] = field(converter=as_tuple)
    temperature: float = field(default=celsius(20.0), validator=positive, metadata=si("K"))
    name: str = ""

    def effect(self, kind: type[_E]) -> _E | None:
        """Return the effect of a kind; None if the scene does not call for it."""
        return next((effect for effect in self.effects if isinstance(effect, kind)), None)

    @property
    def initial_gap(self) -> float:
        """Gap at the start [m]."""
        return self.opening.initial_gap


@frozen(kw_only=True)
class SlidingScene:
    """Two wetted bodies, one of which slides past the other at a held gap.

    Parameters
    ----------
    interface : Interface
        The bodies and the liquid between them.
    sliding : Sliding
        What is imposed: the gap, and a speed or a time.
    effects : tuple of effects
        The physics to simulate, and nothing else.
    temperature : float
        Temperature of the liquid [K].
    name : str
        A title for tables and figures.
    """

    interface: Interface = field(validator=part(Interface))
    sliding: Sliding = field(validator=part(Sliding))
    effects: tuple[SeparationEffect, ...] = field(converter=as_tuple)
    temperature: float = field(default=celsius(20.0), validator=positive, metadata=si("K"))
    name: str = ""

    def effect(self, kind: type[_E]) -> _E | None:
        """Return the effect of a kind; None if the scene does not call for it."""
        return next((effect for effect in self.effects if isinstance(effect, kind)), None)

    @property
    def initial_gap(self) -> float:
        """Gap at the start [m], which is held."""
        return self.sliding.gap
