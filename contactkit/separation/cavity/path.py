"""Cavity of a film whose motion is imposed: steps of time with an error control, cut at events."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from typing import NamedTuple

from ...errors import ConvergenceError
from ...numerics.events import EventStep
from ...numerics.radau_tableau import NODES, WEIGHTS
from ...numerics.step_size import StepSize
from .events import first_event, is_inception
from .law import Cavitation, SolvedStages
from .state import Cavity, Phase

__all__ = ["PathPoint", "along_path"]

Place = Callable[[float], tuple[float, float]]
"""Gap [m] and opening speed [m/s] at a time [s]."""

_CONTROL = StepSize(order=3)
_FIRST = 1e-3  # of the way, the first step
# Over the volume of the film: less than the error of a step. Impulses of discs that swing at 0.1 to
# 1 tolerance of 1e-8 are 3e-4 off with 1e-10, 4e-10 and 1e-8 alike; with 1e-6 half of one is lost.
_EVENT = 1e-10
# A swing that cavitates and reforms takes 100 to 200 steps at 1e-8: these are hundreds of swings.
MOST_STEPS = 100_000


class PathPoint(NamedTuple):
    """Time [s] on the way, the cavity there, and the impulse of the step that led there [N.s].

    The impulse is None of a film that was full, which has one that does not depend on the way.
    """

    time: float
    cavity: Cavity
    impulse: float | None
    step: float  # length that the next one may have [s]


class _Try(NamedTuple):
    """A step of a path: its voids, or None for a film that is full; begin, and stages."""

    solved: SolvedStages | None
    begin: tuple[float, float]
    places: list[tuple[float, float]]

    @property
    def end(self) -> tuple[float, float]:
        return self.places[2]


def along_path(
    law: Cavitation,
    cavity: Cavity,
    place: Place,
    begin: float,
    end: float,
    rtol: float,
    step: float = 0.0,
    most_steps: int = MOST_STEPS,
) -> Iterator[PathPoint]:
    """Steps of a cavity along an imposed path, which is smooth from one time [s] to another.

    The speed may jump at the begin.

    Parameters
    ----------
    law, cavity
        Film, and its cavity at the begin.
    place : callable
        Gap [m] and opening speed [m/s] at a time [s].
    begin, end : float
        Time [s].
    rtol : float
        Error of the void in a step, over the volume of the film, that is accepted.
    step : float
        Length of the first step to try [s]; 0: a thousandth of the way.
    most_steps : int
        What the way may take.

    Raises
    ------
    ConvergenceError
        If no step meets the tolerance, or there are more of them than that.
    """
    time, planned = begin, step or _FIRST * (end - begin)
    cavity = law.after_jump(cavity, *place(begin))
    rtol = law.time_rtol(rtol)
    for _ in range(most_steps):
        here = place(time)
        if is_inception(law, cavity, *here):
            cavity = law.after_event(cavity, *here)
            yield PathPoint(time, cavity, 0.0, planned)
        if end - time <= 1e-14 * abs(end):
            return
        length = min(planned, end - time)
        is_short = length < planned
        taken, length, error = _accepted(law, cavity, place, time, length, rtol)
        planned = _CONTROL.following(length, error, planned if is_short else 0.0)
        cut = _cut(law, cavity, place, time, taken, length)
        if cut is not None:
            (taken, length), whole = cut, length
            planned = max(length, 1e-3 * whole)
        if length > 0.0:
            cavity, impulse = _after(law, cavity, taken, length)
            time = end if length >= (end - time) * (1.0 - 1e-14) else time + length
        else:
            impulse = 0.0
        if cut is not None:
            cavity = law.after_event(cavity, *(taken.end if length > 0.0 else taken.begin))
        yield PathPoint(time, cavity, impulse, planned)
    raise ConvergenceError(
        f"{most_steps} steps of the cavity led from {begin:g} s to {time:g} s, not to {end:g} s; "
        "loosen Accuracy.time_rtol",
        None,
    )


def _after(
    law: Cavitation, cavity: Cavity, taken: _Try, length: float
) -> tuple[Cavity, float | None]:
    """Cavity after a step, and its impulse [N.s]; None of a full film."""
    if taken.solved is None:
        return cavity, None
    forces = zip(WEIGHTS, taken.solved.forces, strict=True)
    impulse = length * sum(weight * held.force for weight, held in forces)
    gaps = [gap for gap, _ in taken.places]
    return law.after_step(cavity, taken.solved, taken.begin[0], gaps), impulse


def _attempt(law: Cavitation, cavity: Cavity, place: Place, time: float, dt: float) -> _Try | None:
    begin, places = place(time), [place(time + node * dt) for node in NODES]
    if cavity.phase is Phase.FULL:
        return _Try(None, begin, places)
    solved = law.stages(cavity, begin, dt, places)
    return None if solved is None else _Try(solved, begin, places)


def _accepted(
    law: Cavitation, cavity: Cavity, place: Place, time: float, length: float, rtol: float
) -> tuple[_Try, float, float]:
    """Longest step that meets the tolerance, its length [s] and its error over the tolerance."""
    for _ in range(80):
        taken, error = _attempt(law, cavity, place, time, length), math.inf
        if taken is not None:
            error = taken.solved.error / rtol if taken.solved is not None else 0.0
            if error <= 1.0:
                return taken, length, error
        length = _CONTROL.shorter(length, error)
    raise ConvergenceError(
        f"no step of the cavity can be taken from {time:g} s; loosen Accuracy.time_rtol", None
    )


def _cut(
    law: Cavitation, cavity: Cavity, place: Place, time: float, taken: _Try, length: float
) -> EventStep[_Try] | None:
    """Step that ends at the first event, and its length; None if there is none."""

    def both(one: _Try) -> tuple[float, float]:
        return law.beyond_event(cavity, one.solved, one.begin, one.places)

    return first_event(
        lambda dt: _attempt(law, cavity, place, time, dt), both, taken, length, _EVENT
    )
