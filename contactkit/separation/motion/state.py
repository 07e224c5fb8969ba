"""State of a motion, as floats that can be saved, and the forces that act in it."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any, NamedTuple

from attrs import field, frozen

from ...units import si
from ..cavity.events import is_inception
from ..cavity.state import FULL, Cavity, Phase, restored_cavity
from ..effects.base import FilmStatus, LimitKind
from ..plan import Film, Plan

__all__ = [
    "PullLaw",
    "MotionState",
    "Outputs",
    "Pull",
    "acting_film",
    "outputs",
    "restored_state",
    "start",
]

PullLaw = Callable[[float], float]
"""Pull [N] at a time [s]; a `Pull`, or any function that is smooth within a step."""


@frozen
class Pull:
    """A pull that changes linearly in time: force [N] at a time [s] and its rate [N/s]."""

    force: float = field(metadata=si("N"))
    rate: float = field(default=0.0, metadata=si("N/s"))
    time: float = field(default=0.0, metadata=si("s"))

    def __call__(self, time: float, /) -> float:
        """Pull [N] at a time [s]."""
        return self.force + self.rate * (time - self.time)


class MotionState(NamedTuple):
    """Everything the motion remembers; SI units, times -1 before the event."""

    time: float
    gap: float
    speed: float
    volume_fraction: float = 1.0  # volume of the film over that of the scene
    broken: bool = False  # the film has ruptured
    in_contact: bool = False  # at rest on the asperities
    armed: bool = True  # closed since the last release, so that the next one counts
    detached: bool = False  # the solids have pulled off each other
    cavity: Cavity = FULL  # of the film, where the scene has one that is remembered
    impulses: Mapping[str, float] = {}  # of each force of the scene [N.s], never changed in place
    dissipated_work: float = 0.0
    applied_impulse: float = 0.0  # sum of all |force| dt, the scale of the momentum error
    break_time: float = -1.0
    release_time: float = -1.0
    release_speed: float = 0.0
    inception_time: float = -1.0  # the film cavitated last
    reformation_time: float = -1.0  # a cavitated film was full again last
    n_breaks: int = 0
    n_releases: int = 0
    n_inceptions: int = 0
    n_reformations: int = 0
    peak_force: float = 0.0
    peak_time: float = -1.0
    step: float = 0.0  # length of the next internal step
    n_steps: int = 0
    n_rejected: int = 0
    n_evaluations: int = 0


class Outputs(NamedTuple):
    """Forces [N] at a state, positive where they resist opening.

    `static` is their sum at rest: the meniscus, and the solids; `viscous` what the speed adds.
    `named` has each by the name of its column, and `newtonian` those of a flowing liquid without
    its limits.
    """

    film: float
    static: float
    viscous: float
    status: FilmStatus
    limit: LimitKind
    cavity_radius: float = 0.0  # of each film [m]
    void: float = 0.0  # volume without liquid within the films [m3]
    named: Mapping[str, float] = {}  # never changed in place
    newtonian: Mapping[str, float] = {}  # nor is this


_NOTHING = Outputs(0.0, 0.0, 0.0, FilmStatus.BROKEN, LimitKind.NONE)


def restored_state(saved: Mapping[str, Any]) -> MotionState:
    """State of the numbers and lists that one is saved as."""
    state = MotionState(**saved)
    return state._replace(cavity=restored_cavity(state.cavity))


def start(plan: Plan) -> MotionState:
    """State of a scene at time 0."""
    loading = plan.scene.imposed_force
    in_contact = loading.rest_gap >= loading.initial_gap and loading.initial_speed <= 0.0
    gap, speed = loading.initial_gap, 0.0 if in_contact else loading.initial_speed
    begun = MotionState(0.0, gap, speed, in_contact=in_contact, impulses=plan.film.impulses())
    law = plan.film.cavity
    if law is None or not is_inception(law, FULL, gap, speed):
        return begun
    return begun._replace(cavity=law.inception(gap, speed), inception_time=0.0, n_inceptions=1)


def acting_film(plan: Plan, state: MotionState) -> Film | None:
    """Film and solids that act in a state; None if nothing does."""
    fraction, broken, detached = state.volume_fraction, state.broken, state.detached
    return plan.remaining_film(fraction, broken=broken, detached=detached)


def outputs(plan: Plan, state: MotionState, pull: float) -> Outputs:
    """Forces at a state under a pull [N], and what they mean."""
    loading, film = plan.scene.imposed_force, acting_film(plan, state)
    if film is None:
        return _NOTHING
    gap, speed = state.gap, state.speed
    held, radius, void = None, 0.0, 0.0
    if film.cavity is not None and state.cavity.phase is not Phase.FULL:
        held, radius, void = film.cavity.shown(state.cavity, gap, speed)
    named, static, viscous, newtonian, limit = film.at(gap, speed, held)
    net = pull - loading.stiffness * (gap - loading.initial_gap) - static
    if speed <= 0.0 < pull and net <= 0.0:
        status = FilmStatus.STUCK
    elif state.in_contact:
        status = FilmStatus.CONTACT
    elif state.broken:
        status = FilmStatus.BROKEN
    else:
        status = FilmStatus.FULL if gap <= film.full_gap else FilmStatus.BRIDGE
    return Outputs(static + viscous, static, viscous, status, limit, radius, void, named, newtonian)
