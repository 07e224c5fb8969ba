"""Film that cavitates: inception, forces at the stages of a step, and the memory of its cavity."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any, Protocol

from attrs import frozen

from . import events
from .disc_film import DiscFilm
from .stages import (
    CavityForce,
    CavityStages,
    ShownCavity,
    force_at,
    shown_cavity,
    solved_stages,
    spot_at,
)
from .state import Cavity

__all__ = ["Cavitation", "CavityLaw", "Place", "SolvedStages"]

Place = tuple[float, float]
"""Gap [m] and opening speed [m/s]."""


class SolvedStages(Protocol):
    """Cavity at the stages of a step."""

    @property
    def forces(self) -> tuple[CavityForce, CavityForce, CavityForce]:
        """Force of the films, with its slopes, at each stage."""

    @property
    def error(self) -> float:
        """Error of the void at the end of the step, over the volume of the film [-]."""


class Cavitation(Protocol):
    """Film that cavitates, of whatever face."""

    @property
    def strength(self) -> float:
        """Tension at which the full film cavitates [Pa], as a drop below ambient pressure."""

    def tension(self, gap: float, speed: float, void: float = 0.0) -> float:
        """Highest tension in the full film [Pa] at a gap [m] and a speed [m/s]."""

    def time_rtol(self, rtol: float) -> float:
        """Tolerance of a step of time with a cavity: that of the plan, or what the grid allows."""

    def inception(self, gap: float, speed: float) -> Cavity:
        """Cavity that opens at once at a gap [m] and a speed [m/s]."""

    def held_force(self, cavity: Cavity, begin: Place) -> Callable[[float, float], CavityForce]:
        """Force over gap [m] and speed [m/s] near a place, with the void that is there."""

    def stages(
        self, cavity: Cavity, begin: Place, dt: float, places: Sequence[Place]
    ) -> SolvedStages | None:
        """Cavity at the stages of a step of `dt` [s]; None if it is not found."""

    def after_step(
        self, cavity: Cavity, solved: Any, begin_gap: float, gaps: Sequence[float]
    ) -> Cavity:
        """Cavity at the end of a step, from the gap [m] at its start and those at its stages."""

    def beyond_event(
        self, cavity: Cavity, solved: Any, begin: Place, places: Sequence[Place]
    ) -> tuple[float, float]:
        """Distance beyond the next event at the start and at the end of a step [-]."""

    def after_event(self, cavity: Cavity, gap: float, speed: float) -> Cavity:
        """Cavity after the event at the end of a step, at a gap [m] and a speed [m/s]."""

    def after_jump(self, cavity: Cavity, gap: float, speed: float) -> Cavity:
        """Cavity at a gap [m] after the speed has jumped to another one [m/s]."""

    def shown(self, cavity: Cavity, gap: float, speed: float) -> ShownCavity:
        """Force of the films, radius of the cavity and void at a gap [m] and a speed [m/s]."""


@frozen
class CavityLaw(DiscFilm):
    """Films between discs: round cavities, of which the edge is known in closed form."""

    def time_rtol(self, rtol: float) -> float:
        """See `Cavitation.time_rtol`: the edge has no grid."""
        return rtol

    def inception(self, gap: float, speed: float) -> Cavity:
        """See `Cavitation.inception`."""
        return events.inception(self, gap, speed)

    def held_force(self, cavity: Cavity, begin: Place) -> Callable[[float, float], CavityForce]:
        """See `Cavitation.held_force`: with an edge and a rim that stay."""
        spot = spot_at(self, cavity, *begin, cavity.void)
        return lambda gap, speed: force_at(self, spot, gap, speed)

    def stages(
        self, cavity: Cavity, begin: Place, dt: float, places: Sequence[Place]
    ) -> CavityStages | None:
        """See `Cavitation.stages`."""
        return solved_stages(self, cavity, begin, dt, places)

    def after_step(
        self, cavity: Cavity, solved: CavityStages, begin_gap: float, gaps: Sequence[float]
    ) -> Cavity:
        """See `Cavitation.after_step`."""
        return events.after_step(cavity, solved, begin_gap, gaps)

    def beyond_event(
        self,
        cavity: Cavity,
        solved: CavityStages | None,
        begin: Place,
        places: Sequence[Place],
    ) -> tuple[float, float]:
        """See `Cavitation.beyond_event`."""
        return events.beyond_event(self, cavity, solved, begin, places)

    def after_event(self, cavity: Cavity, gap: float, speed: float) -> Cavity:
        """See `Cavitation.after_event`."""
        return events.after_event(self, cavity, gap, speed)

    def after_jump(self, cavity: Cavity, gap: float, speed: float) -> Cavity:
        """See `Cavitation.after_jump`."""
        return events.after_jump(self, cavity, gap, speed)

    def shown(self, cavity: Cavity, gap: float, speed: float) -> ShownCavity:
        """See `Cavitation.shown`."""
        return shown_cavity(self, cavity, gap, speed)
