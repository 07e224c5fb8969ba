"""Two bodies, the liquid between them, and what pulls them apart.

Conventions, stated once: the two bodies are `lower` and `upper`; the gap is positive when open
and is the shortest distance between them; contact angles are measured through the liquid; a
force is positive when it resists separation.
"""

from __future__ import annotations

import math
from typing import Literal

from attrs import Attribute, field, frozen

from .checks import (
    angle,
    count,
    finite,
    fraction,
    non_negative,
    optional,
    part,
    positive,
    refuse,
)
from .errors import DescriptionError
from .liquids import Liquid
from .surfaces import Flat, Sphere, Surface
from .units import si

__all__ = ["Interface", "Meniscus", "Opening"]


@frozen(kw_only=True)
class Meniscus:
    """The liquid that joins the two bodies: how much, and how it wets them.

    Parameters
    ----------
    liquid : Liquid
        What it is.
    volume : float, optional
        Amount of liquid in all menisci together [m3]. None: the gap stands in a bath and stays
        full to the rim however far it opens (flooded).
    contact_angle_lower, contact_angle_upper : float
        Contact angles on the two bodies [rad], 0 (wets) to pi (repels).
    count : int
        Number of equal menisci the liquid is divided into.
    rewetting : float
        Share of `volume` that is there again, at least, each time the bodies come back together
        [-]. 0: what is lost by rupture stays lost.
    """

    liquid: Liquid = field(validator=part(Liquid))
    volume: float | None = field(default=None, validator=optional(positive), metadata=si("m3"))
    contact_angle_lower: float = field(default=0.0, validator=angle, metadata=si("rad"))
    contact_angle_upper: float = field(default=0.0, validator=angle, metadata=si("rad"))
    count: int = field(default=1, validator=count, metadata=si("-"))
    rewetting: float = field(default=1.0, validator=fraction, metadata=si("-"))


@frozen(kw_only=True)
class Interface:
    """Two bodies and the meniscus between them.

    Parameters
    ----------
    lower, upper : Flat or Sphere
        The bodies; the film spreads at most to the smaller face.
    meniscus : Meniscus
        The liquid between them.
    """

    lower: Surface = field(factory=Flat, validator=part(Flat, Sphere))
    upper: Surface = field(factory=Flat, validator=part(Flat, Sphere))
    meniscus: Meniscus = field(validator=part(Meniscus))

    @property
    def curvature(self) -> float:
        """Relative curvature 1/R of the two bodies at their apexes [1/m]; 0 for two flats."""
        return self.lower.curvature + self.upper.curvature

    @property
    def is_flat(self) -> bool:
        """Whether both bodies are flat."""
        return isinstance(self.lower, Flat) and isinstance(self.upper, Flat)

    @property
    def rim_radius(self) -> float:
        """Radius of the smaller face [m], beyond which the film cannot spread; inf if none."""
        radii = [b.radius for b in (self.lower, self.upper) if isinstance(b, Flat)]
        return min((r for r in radii if r is not None), default=math.inf)

    @property
    def sphere_radius(self) -> float:
        """Relative radius R of the two bodies at their apexes [m]; inf for two flats."""
        return (
            1.0 / self.curvature
            if isinstance(self.lower, Sphere) or isinstance(self.upper, Sphere)
            else math.inf
        )


_IMPOSED = ("speed", "force", "time")


def _beyond_start(opening: Opening, attribute: Attribute[float], value: float) -> None:
    positive(opening, attribute, value)
    if value <= opening.initial_gap:
        raise refuse(opening, attribute, value, f"exceed initial_gap = {opening.initial_gap:g} m")


@frozen(kw_only=True)
class Opening:
    """How the gap is opened. Exactly one of `speed`, `force` and `time` is imposed.

    Parameters
    ----------
    initial_gap, final_gap : float
        Gap at the start and gap at which the bodies count as separated [m].
    speed : float, optional
        Imposed opening speed [m/s]; the force follows.
    time : float, optional
        Imposed duration of the opening [s]; the mean force follows.
    force : float, optional
        Imposed pull [N]; the motion follows.
    mass : float, optional
        Moving mass [kg], for an imposed force. None: inertia is left out.
    stiffness : float
        Stiffness of a spring that pulls back towards `initial_gap` [N/m].
    rise_time : float
        The pull grows as ``force*(1 - exp(-t/rise_time))`` [s]; 0: at once.
    initial_speed : float
        Speed of the mass at the start [m/s].
    rest_gap : float
        Gap at which asperities carry the bodies and closing stops [m]; 0: none.
    time_limit : float
        Longest time to wait for separation [s].
    """

    initial_gap: float = field(validator=non_negative, metadata=si("m"))
    final_gap: float = field(validator=_beyond_start, metadata=si("m"))
    speed: float | None = field(default=None, validator=optional(positive), metadata=si("m/s"))
    time: float | None = field(default=None, validator=optional(positive), metadata=si("s"))
    force: float | None = field(default=None, validator=optional(finite), metadata=si("N"))
    mass: float | None = field(default=None, validator=optional(positive), metadata=si("kg"))
    stiffness: float = field(default=0.0, validator=non_negative, metadata=si("N/m"))
    rise_time: float = field(default=0.0, validator=non_negative, metadata=si("s"))
    initial_speed: float = field(default=0.0, validator=finite, metadata=si("m/s"))
    rest_gap: float = field(default=0.0, validator=non_negative, metadata=si("m"))
    time_limit: float = field(default=3600.0, validator=positive, metadata=si("s"))

    def __attrs_post_init__(self) -> None:
        given = [name for name in _IMPOSED if getattr(self, name) is not None]
        if len(given) != 1:
            raise DescriptionError(
                "Opening",
                given or "none",
                "be given exactly one of speed [m/s], force [N] or time [s]",
            )
        if self.rest_gap > self.initial_gap:
            raise DescriptionError(
                "Opening.rest_gap",
                self.rest_gap,
                f"not exceed initial_gap = {self.initial_gap:g} m",
                unit="m",
            )

    @property
    def imposed(self) -> Literal["speed", "force", "time"]:
        """What is imposed."""
        if self.speed is not None:
            return "speed"
        return "force" if self.force is not None else "time"
