"""Registry of all effects, `EFFECTS`, from which files take their names; `register_effect`."""

from __future__ import annotations

from typing import TypeVar

from .contact.effects.registry import CONTACT_EFFECTS
from .scene.effect import Effect, EffectRegistry
from .separation.effects.registry import SEPARATION_EFFECTS
from .separation.sliding.effects import SLIDING_EFFECTS

__all__ = ["EFFECTS", "register_effect"]

K = TypeVar("K", bound=type[Effect])

EFFECTS: EffectRegistry[Effect] = EffectRegistry(
    SEPARATION_EFFECTS, SLIDING_EFFECTS, CONTACT_EFFECTS
)


def register_effect(kind: K) -> K:
    """Register an effect of your own, so that scene files, results and plans know its name.

    It is then saved and loaded like those of contactkit, listed in printed plans and varied by
    studies. In a session it lasts until Python ends; a package declares it as an entry point
    instead, and everyone who installs the package has it, on the command line too::

        [project.entry-points."contactkit.effects"]
        electrostatic-force = "plates.effects:ElectrostaticForce"

    Parameters
    ----------
    kind : type
        Class of the effect, with a role as its base class; its ``name`` must be new. May be used
        as a decorator, above that of attrs.

    Returns
    -------
    type
        The same class.

    Raises
    ------
    DescriptionError
        If it is no effect, is not complete, or another effect has its name.

    Examples
    --------
    >>> from attrs import frozen
    >>> import contactkit as ck
    >>> from contactkit.contact.effects.base import Observer
    >>> @frozen(kw_only=True)
    ... class LeastGap(Observer[float]):
    ...     name = "least-gap"
    ...     summary = "least distance of the surfaces"
    ...     sources = ("a minimum over the window",)
    ...
    ...     def observe(self, contact):
    ...         return float(contact.gap.min())
    >>> with ck.EFFECTS.including():  # for the length of this example
    ...     made = ck.register_effect(LeastGap)
    ...     ck.EFFECTS.find("least-gap") is made
    True
    """
    EFFECTS.register(kind)
    return kind
