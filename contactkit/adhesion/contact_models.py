"""Adhesive contact of a sphere by JKR, DMT or Maugis-Dugdale: one class per model.

In the units of `parameters`. A gap is the negative of the approach; a pull is the negative of the
load. On the displacement-controlled branch the contact exists up to `last_gap`.
"""

from __future__ import annotations

import abc
import math

from ..errors import DescriptionError
from . import dmt, jkr, maugis_dugdale
from .maugis_dugdale import Cohesion

__all__ = ["ContactModel", "DmtContact", "JkrContact", "MaugisDugdaleContact", "contact_model"]


class ContactModel(abc.ABC):
    """A contact: its pull-off, and its states over the gap and over the load.

    `pull_off_force` is the largest pull, that of pull-off under load control; `last_gap` and
    `last_force` are those of pull-off under displacement control. Bodies out of contact attract
    across gaps up to `reach`; beyond `touch_gap` they are out of contact.
    """

    pull_off_force: float
    last_gap: float
    last_force: float
    reach: float = 0.0
    touch_gap: float = math.inf

    @abc.abstractmethod
    def pull(self, gap: float) -> float:
        """Pull at a gap of at most `last_gap`."""

    @abc.abstractmethod
    def cohesive_radius(self, gap: float) -> float:
        """Radius within which the bodies attract each other at a gap."""

    @abc.abstractmethod
    def at_load(self, load: float) -> Cohesion:
        """Stable state under a load of at least minus `pull_off_force`."""


class JkrContact(ContactModel):
    """Attraction inside the contact only."""

    pull_off_force = jkr.PULL_OFF_FORCE
    last_gap, last_force = jkr.LAST_GAP, jkr.LAST_FORCE

    def pull(self, gap: float) -> float:
        """See `ContactModel.pull`."""
        return -jkr.load(jkr.radius_at_gap(gap))

    def cohesive_radius(self, gap: float) -> float:
        """See `ContactModel.cohesive_radius`: that of the contact."""
        return jkr.radius_at_gap(gap)

    def at_load(self, load: float) -> Cohesion:
        """See `ContactModel.at_load`."""
        a = jkr.radius_at_load(load)
        return Cohesion(a, a, load, jkr.approach(a))


class DmtContact(ContactModel):
    """Attraction of constant stress outside a contact of Hertzian shape, up to a gap."""

    pull_off_force = dmt.PULL_OFF_FORCE
    last_force = 0.0

    def __init__(self, transition: float) -> None:
        self._transition = transition
        self.reach = self.last_gap = float(dmt.reach(transition))

    def pull(self, gap: float) -> float:
        """See `ContactModel.pull`."""
        return max(float(dmt.force_before_touch(gap, self._transition)), 0.0)

    def cohesive_radius(self, gap: float) -> float:
        """See `ContactModel.cohesive_radius`: where the undeformed gap is the reach."""
        return math.sqrt(2.0 * max(self.reach - gap, 0.0))

    def at_load(self, load: float) -> Cohesion:
        """See `ContactModel.at_load`."""
        a = float(dmt.radius_at_load(max(load, -self.pull_off_force)))
        return Cohesion(a, a, load, a * a)


class MaugisDugdaleContact(ContactModel):
    """Attraction of constant stress in a ring around the contact."""

    def __init__(self, transition: float) -> None:
        self._transition, self._limits = transition, maugis_dugdale.limits(transition)
        release = self._limits.release
        self.pull_off_force = -self._limits.pull_off.load
        self.last_gap, self.last_force = -release.approach, -release.load
        self.reach = float(dmt.reach(transition))
        self.touch_gap = -self._limits.touch.approach

    def pull(self, gap: float) -> float:
        """See `ContactModel.pull`."""
        return -maugis_dugdale.at_gap(gap, self._transition, self._limits).load

    def cohesive_radius(self, gap: float) -> float:
        """See `ContactModel.cohesive_radius`."""
        return maugis_dugdale.at_gap(gap, self._transition, self._limits).cohesive_radius

    def at_load(self, load: float) -> Cohesion:
        """See `ContactModel.at_load`."""
        return maugis_dugdale.at_load(load, self._transition, self._limits)


def contact_model(name: str, transition: float | None) -> ContactModel:
    """Model of a name and of a transition parameter [-], which JKR does not have.

    Raises
    ------
    DescriptionError
        If another model has no stress of attraction, and so no transition parameter.

    Examples
    --------
    >>> contact_model("jkr", None).pull_off_force, contact_model("dmt", 0.05).pull_off_force
    (1.5, 2.0)
    """
    if name == "jkr":
        return JkrContact()
    if transition is None:
        raise DescriptionError("AdhesiveContact.strength", None, "be given", unit="Pa")
    return DmtContact(transition) if name == "dmt" else MaugisDugdaleContact(transition)
