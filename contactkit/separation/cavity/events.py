"""Events of a cavity: its inception, the turns of its edge, and the film that is full again."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from typing import Protocol, TypeVar

from ...lubrication.disc_cavity import receding_edge
from ...lubrication.rupture_history import (
    cut,
    edge_of,
    grown,
    liquid_within,
    outermost,
    piece_along,
    piece_at,
    void_within,
)
from ...numerics.events import EventStep, step_to_event
from .disc_film import DiscFilm
from .stages import CavityStages
from .state import FULL, Cavity, Phase

__all__ = [
    "after_event",
    "after_jump",
    "after_step",
    "beyond_event",
    "inception",
    "first_event",
    "is_inception",
]

S = TypeVar("S")


class Tense(Protocol):
    """Film that cavitates where its tension reaches its strength."""

    @property
    def strength(self) -> float:
        """Tension at which the full film cavitates [Pa], as a drop below ambient pressure."""

    def tension(self, gap: float, speed: float, void: float = 0.0) -> float:
        """Highest tension in the full film [Pa] at a gap [m] and a speed [m/s]."""


_REFORMED = 1e-9  # void over the film at which it counts as full
_NOTHING = 1e-8  # the same of a cavity that never was deeper than `_SHALLOW`
_SAME = 1e-12  # squares of the edge that are closer, relatively, are one
_SHALLOW = 1e-6  # depth of the void at the edge, over the gap, where round-off moves the edge
_RECEDES = 1e-6  # flow over the edge, over that into the film, which is more than round-off


def is_inception(law: Tense, cavity: Cavity, gap: float, speed: float) -> bool:
    """Whether a full film cavitates at a gap [m] and a speed [m/s]."""
    return cavity.phase is Phase.FULL and law.tension(gap, speed) >= law.strength


def inception(law: DiscFilm, gap: float, speed: float) -> Cavity:
    """Cavity that opens at once where the liquid cavitates: from its strength to its cavity."""
    rim, _ = law.rim(gap, 0.0)
    fraction = receding_edge(law.tension(gap, speed) / law.drop)
    return Cavity(Phase.RECEDING, 0.0, fraction, (piece_at(fraction * rim, gap),))


def beyond_event(
    law: DiscFilm,
    cavity: Cavity,
    solved: CavityStages | None,
    begin: tuple[float, float],
    places: Sequence[tuple[float, float]],
) -> tuple[float, float]:
    """Distance beyond the next event of a cavity, at the start of a step and at its end [-].

    Below zero before it. `begin` and `places` are the gap [m] and the speed [m/s] at the start and
    at the stages.
    """
    if solved is None:
        highest = max(law.tension(*place) for place in places)
        return law.tension(*begin) / law.strength - 1.0, highest / law.strength - 1.0
    if cavity.phase is Phase.RECEDING:
        before, after = _edge_rates(cavity, solved)
        size = abs(before) + abs(after) or 1.0
        return -before / size, -after / size
    last, gap = solved.spots[2], places[2][0]
    left = _nothing(law, cavity, gap)
    if last.growth < 0.0 and solved.voids[2] <= left:
        size = cavity.void + abs(solved.voids[2]) + left
        return min((left - cavity.void) / size, 0.0), (left - solved.voids[2]) / size
    if gap - edge_of(cavity.history, gap, solved.voids[2]).rupture_gap <= _SHALLOW * gap:
        return -1.0, -1.0
    return -1.0, -last.returns / (abs(last.growth) + abs(last.returns) + 1e-300) - _RECEDES


def first_event(
    attempt: Callable[[float], S | None],
    beyond: Callable[[S], tuple[float, float]],
    taken: S,
    length: float,
    enough: float,
) -> EventStep[S] | None:
    """Step that ends at the first event of a cavity; None if there is none in it.

    Of length 0 if the event is where the step starts.

    Parameters
    ----------
    attempt : callable
        A step of a length [s]; None where there is none.
    beyond : callable
        `beyond_event` of a step.
    taken, length : step, float
        The step, and its length [s].
    enough : float
        Distance from the event that may be left [-].
    """
    behind, ahead = beyond(taken)
    if ahead <= 0.0:
        return None
    if behind >= 0.0:
        return EventStep(taken, 0.0)
    return step_to_event(attempt, lambda one: beyond(one)[1], behind, taken, length, enough)


def _nothing(law: DiscFilm, cavity: Cavity, gap: float) -> float:
    """Void [m3] up to which a film counts as full."""
    rim, _ = law.rim(gap, cavity.void)
    film = math.pi * rim * gap
    # In a cavity that never was deep round-off decides where the edge is.
    return (_NOTHING if cavity.largest < _SHALLOW * film else _REFORMED) * film


def _edge_rates(cavity: Cavity, solved: CavityStages) -> tuple[float, float]:
    """Change of the square of the edge at the start and at the end of a step [m2 per step]."""
    piece = piece_along(0.0, _squares(cavity, solved), (0.0, 0.0, 0.0, 0.0))
    return piece[1], piece[1] + 2.0 * piece[2] + 3.0 * piece[3]


def _squares(cavity: Cavity, solved: CavityStages) -> tuple[float, ...]:
    """Square of the edge [m2] where the memory ends, and at the stages."""
    return (outermost(cavity.history), *(spot.edge_square for spot in solved.spots))


def after_step(
    cavity: Cavity, solved: CavityStages, begin_gap: float, gaps: Sequence[float]
) -> Cavity:
    """Cavity at the end of a step, from the gap [m] at its start and those at its stages."""
    void, spot = solved.voids[2], solved.spots[2]
    history = cavity.history
    if cavity.phase is Phase.RECEDING:
        squares = _squares(cavity, solved)
        history = grown(history, piece_along(liquid_within(history), squares, (begin_gap, *gaps)))
    largest = max(cavity.largest, void)
    return cavity._replace(void=void, fraction=spot.fraction, history=history, largest=largest)


def after_event(law: DiscFilm, cavity: Cavity, gap: float, speed: float) -> Cavity:
    """Cavity after the event at the end of a step, at a gap [m] and a speed [m/s]."""
    if cavity.phase is Phase.FULL:
        return inception(law, gap, speed)
    if cavity.phase is Phase.RECEDING:
        void = void_within(cavity.history, gap)
        return cavity._replace(phase=Phase.RETURNING, void=void)
    if cavity.void <= 2.0 * _nothing(law, cavity, gap):
        return FULL
    history = cut(cavity.history, gap, cavity.void)
    return cavity._replace(phase=Phase.RECEDING, history=history)


def after_jump(law: DiscFilm, cavity: Cavity, gap: float, speed: float) -> Cavity:
    """Cavity at a gap [m] after the speed has jumped to another one [m/s].

    The full film cavitates, or the edge jumps to where the liquid then recedes from it, at one gap;
    if that is within the edge, liquid returns from where it is.
    """
    if cavity.phase is Phase.FULL:
        return inception(law, gap, speed) if is_inception(law, cavity, gap, speed) else cavity
    recedes = cavity.phase is Phase.RECEDING
    rim, _ = law.rim(gap, cavity.void)
    fraction = receding_edge(law.tension(gap, speed, cavity.void) / law.drop)
    here = (
        outermost(cavity.history) if recedes else edge_of(cavity.history, gap, cavity.void).square
    )
    if fraction * rim > here * (1.0 + _SAME):
        history = cavity.history if recedes else cut(cavity.history, gap, cavity.void)
        jump = (here, fraction * rim - here, 0.0, 0.0, gap, 0.0, 0.0, 0.0, liquid_within(history))
        return Cavity(Phase.RECEDING, cavity.void, fraction, grown(history, jump), cavity.largest)
    if recedes and fraction * rim < here * (1.0 - _SAME):
        return after_event(law, cavity, gap, speed)
    return cavity
