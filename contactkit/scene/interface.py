"""Two bodies, the liquid between them, and what pulls them apart.

Conventions, stated once: the two bodies are `lower` and `upper`; the gap is positive when open
and is the shortest distance between them; contact angles are measured through the liquid; a
force is positive when it resists separation.
"""

from __future__ import annotations

import math
from typing import Literal

from attrs import Attribute, field, frozen

from ..errors import DescriptionError
from ..units import si
from ..validators import finite, non_negative, optional, part, positive, refuse
from .imposed import Sliding, Vibration
from .meniscus import Meniscus
from .shapes import Flat, Sphere, Surface

__all__ = ["Interface", "Meniscus", "Opening", "Sliding", "Vibration"]


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
    vibration : Vibration, optional
        Shaking of the gap on top of an imposed speed.
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
    vibration: Vibration | None = field(default=None, validator=optional(part(Vibration)))

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

        if self.vibration is not None:
            self._check_vibration(self.vibration)

    def _check_vibration(self, vibration: Vibration) -> None:
        if self.speed is None:
            raise DescriptionError(
                "Opening.vibration",
                vibration,
                "stand beside a speed [m/s]",
                hint=f"with {self.imposed} imposed the path of the gap is not given",
            )
        room = self.initial_gap - self.rest_gap
        if vibration.amplitude >= room:
            rest = f" less rest_gap = {self.rest_gap:g} m" if self.rest_gap else ""
            raise DescriptionError(
                "Vibration.amplitude",
                vibration.amplitude,
                f"be below initial_gap = {self.initial_gap:g} m{rest}",
                unit="m",
                hint="the bodies would touch; shake less, or start from a larger gap",
            )

    @property
    def smallest_gap(self) -> float:
        """Smallest gap [m] of an imposed motion: the initial gap less the amplitude."""
        return self.initial_gap - (self.vibration.amplitude if self.vibration else 0.0)

    @property
    def largest_gap(self) -> float:
        """Largest gap [m] of an imposed motion: the final gap and the amplitude."""
        return self.final_gap + (self.vibration.amplitude if self.vibration else 0.0)

    @property
    def imposed(self) -> Literal["speed", "force", "time"]:
        """What is imposed."""
        if self.speed is not None:
            return "speed"
        return "force" if self.force is not None else "time"
