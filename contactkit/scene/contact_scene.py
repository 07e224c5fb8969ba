"""A contact, and which physics it calls for. What is not listed is not run."""

from __future__ import annotations

from typing import TYPE_CHECKING, TypeVar

from attrs import field, frozen

from ..units import celsius, si
from ..validators import as_tuple, part, positive
from .bodies import ContactInterface, Pressing, Window

if TYPE_CHECKING:
    from ..contact.effects.base import ContactEffect

__all__ = ["ContactScene"]

_E = TypeVar("_E", bound="ContactEffect")


@frozen(kw_only=True)
class ContactScene:
    """Two bodies pressed together, and slid if the effects say so.

    Parameters
    ----------
    interface : ContactInterface
        The bodies, and the liquid between them if any.
    window : Window
        The part of the interface that is looked at.
    pressing : Pressing
        What is imposed: pressure, force or approach.
    effects : tuple of effects
        The physics to simulate, and nothing else.
    temperature : float
        Temperature of the liquid [K].
    name : str
        A title for tables and figures.
    """

    interface: ContactInterface = field(validator=part(ContactInterface))
    window: Window = field(factory=Window, validator=part(Window))
    pressing: Pressing = field(validator=part(Pressing))
    effects: tuple[ContactEffect, ...] = field(converter=as_tuple)
    temperature: float = field(default=celsius(20.0), validator=positive, metadata=si("K"))
    name: str = ""

    def effect(self, kind: type[_E]) -> _E | None:
        """Return the effect of a kind; None if the scene does not call for it."""
        return next((effect for effect in self.effects if isinstance(effect, kind)), None)
