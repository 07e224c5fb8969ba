"""Points of the curves of a motion: straight lines between them are right to a stated error.

The steps of the integrator follow what is hard to solve: a hundred lie in the first microsecond of
a stiff film, and a few span the rest of the gap. Between two of them the motion is advanced again
by parts of the step. Each part ends with a stage of the same method, on the slow motion of a
stiff film, so that gap, speed and forces belong together as those of the steps do.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from itertools import pairwise
from typing import TYPE_CHECKING, Any

import numpy as np

from ..errors import ConvergenceError
from ..numerics.lines import SHARE, needed
from .bridge_end import errors_of_curves, followed
from .motion.advance import advance
from .motion.state import MotionState, PullLaw
from .plan import Plan

if TYPE_CHECKING:
    from numpy.typing import NDArray

    Floats = NDArray[np.float64]

__all__ = ["Row", "refined"]

Row = Callable[[MotionState], Sequence[float]]
"""What the curves show of a state, the gap first."""

_CURVED = 0.05  # of the error, by second differences of the steps: below, a step needs no points
_JUMP = 1e-6  # of a step, in which a jump is drawn; where a limit sets in, rounding takes 1e-8
_STILL = 1e-14  # of the gap, some fifty times its rounding
_CREEP = 1e-3  # of a step: shorter parts in which the gap stays still find no more than rounding


def refined(
    plan: Plan, states: Sequence[MotionState], pull: PullLaw, row: Row
) -> tuple[list[MotionState], Floats]:
    """States along a motion, and the time [s] and the row of each.

    A straight line between two of them departs from the motion by `Accuracy.curve_rtol` of the
    gap at most, and of the range of each other curve; over a logarithmic gap, too. A jump is two
    points, a millionth of a step apart or the next time that a float can tell.

    Parameters
    ----------
    plan : Plan
        Of a scene with an imposed force.
    states : sequence of MotionState
        Ends of the internal steps.
    pull : callable
        Pull [N] at a time [s].
    row : callable
        What the curves show of a state, the gap first.
    """

    def shown(state: MotionState) -> Floats:
        return np.array([*row(state), *followed(plan, state.gap, state.volume_fraction)])

    rows = np.array([shown(state) for state in states])
    rtol = plan.accuracy.curve_rtol
    errors = errors_of_curves(rows, rtol)
    filled = _Filled(plan, pull, shown, errors, rtol)
    filled.add(states[0], rows[0], is_event=True)
    needed = _curved(np.array([s.time for s in states]), rows, errors, rtol)
    for index, (before, after) in enumerate(pairwise(states)):
        filled.step(before, after, rows[index + 1], is_curved=bool(needed[index]))
    return filled.result()


def _curved(time: Floats, rows: Floats, errors: Floats, rtol: float) -> NDArray[np.bool_]:
    """Steps that a straight line may not follow, by the second differences around them."""
    n = len(time)
    needed = np.ones(max(n - 1, 0), dtype=bool)
    if n < 4:
        return needed
    length = np.diff(time)
    with np.errstate(divide="ignore", invalid="ignore"):
        slope = np.diff(rows, axis=0) / length[:, None]
        bend = np.abs(np.diff(slope, axis=0)) / (length[1:] + length[:-1])[:, None]
    most = np.zeros((n - 1, rows.shape[1]))
    most[:-1], most[1:] = bend, np.maximum(most[1:], bend)
    scale = np.tile(errors, (n - 1, 1))
    scale[:, 0] = rtol * rows[:-1, 0]
    needed[:] = ~(most * (length**2)[:, None] < _CURVED * scale).all(axis=1)
    return needed


def _marks(state: MotionState) -> tuple[Any, ...]:
    """What changes by an event alone."""
    return (
        state.broken,
        state.in_contact,
        state.detached,
        state.cavity.phase,
    )


class _Filled:
    """Points of a motion so far."""

    def __init__(
        self,
        plan: Plan,
        pull: PullLaw,
        row: Callable[[MotionState], Floats],
        errors: Floats,
        rtol: float,
    ) -> None:
        self._plan, self._pull, self._row = plan, pull, row
        self._errors, self._rtol = errors, rtol
        self._states: list[MotionState] = []
        self._rows: list[Floats] = []
        self._events: list[bool] = []

    def add(self, state: MotionState, row: Floats, *, is_event: bool = False) -> None:
        """Add a point; events are never left out."""
        self._states.append(state)
        self._rows.append(row)
        self._events.append(is_event)

    def step(
        self, before: MotionState, after: MotionState, row: Floats, *, is_curved: bool
    ) -> None:
        """Add the end of a step, and what straight lines need within it."""
        is_event = _marks(before) != _marks(after)
        end, length = after, after.time - before.time
        if length > 0.0 and (is_event or is_curved):
            try:
                if is_event:
                    end, row_of_end = self._before_event(before, after, row)
                else:
                    row_of_end = row
                self._march(before, self._rows[-1], end, row_of_end)
            except ConvergenceError:  # a part of a step has no solution: the line of the step stays
                pass
            if end is not after:
                self.add(end, row_of_end, is_event=True)
        elif is_event:
            self._events[-1] = True
        self.add(after, row, is_event=is_event)

    def _before_event(
        self, before: MotionState, after: MotionState, row: Floats
    ) -> tuple[MotionState, Floats]:
        """Last point before an event at the end of a step."""
        end = self._advanced(before, (after.time - before.time) * (1.0 - _JUMP))
        if _marks(end) != _marks(before):
            return after, row
        return end, self._row(end)

    def _advanced(self, state: MotionState, dt: float) -> MotionState:
        return advance(self._plan, state, self._pull, dt)

    def _march(self, here: MotionState, row: Floats, end: MotionState, row_of_end: Floats) -> None:
        """Add points from one state to another, two at a time, as far apart as lines allow."""
        dt = end.time - here.time
        shortest, creeping = _JUMP * dt, _CREEP * dt
        while here.time < end.time:
            left = end.time - here.time
            dt = max(dt, shortest)
            is_last = dt >= left * (1.0 - _JUMP)
            dt = left if is_last else dt
            middle = self._advanced(here, 0.5 * dt)
            last = end if is_last else self._advanced(middle, here.time + dt - middle.time)
            if not here.time < middle.time < last.time:
                return
            half = self._row(middle)
            row_of_last = row_of_end if is_last else self._row(last)
            part = (middle.time - here.time) / (last.time - here.time)
            miss = np.abs(half - row - part * (row_of_last - row))
            allowed = SHARE * self._errors
            allowed[0] = SHARE * self._rtol * half[0]
            error = float((miss / allowed).max())
            # A gap that rounding holds where it is shows no state between: shorter parts of a step
            # would creep towards a jump (at the edge of a full film) and never reach it.
            moves = dt > creeping or abs(row_of_last[0] - row[0]) > _STILL * half[0]
            if error > 1.0 and dt > shortest and moves:
                dt *= min(max(math.sqrt(0.7 / error), 0.1), 0.7)
                continue
            self.add(middle, half)
            if is_last:
                return
            self.add(last, row_of_last)
            here, row = last, row_of_last
            dt *= min(max(math.sqrt(0.7 / max(error, 1e-3)), 0.5), 4.0)

    def result(self) -> tuple[list[MotionState], Floats]:
        """Points of rising time that lines need."""
        time = np.array([state.time for state in self._states])
        rows, events = np.array(self._rows), np.array(self._events)
        # Of states at one time, the first is before and the last after what changed at once.
        starts = np.concatenate([[True], time[1:] > time[:-1]])
        ends = np.concatenate([starts[1:], [True]])
        starts &= ends | (time > 0.0)
        events |= starts != ends
        shown = time.copy()
        shown[starts & ~ends] = np.nextafter(time[starts & ~ends], -math.inf)
        chosen = np.flatnonzero(starts | ends)
        chosen = chosen[np.concatenate([[True], np.diff(shown[chosen]) > 0.0])]
        table = np.column_stack([shown, rows])[chosen]
        allowed = np.tile((1.0 - SHARE) * self._errors, (len(chosen), 1))
        allowed[:, 0] = (1.0 - SHARE) * self._rtol * table[:, 1]
        kept = needed(table, allowed, np.flatnonzero(events[chosen]))
        return [self._states[i] for i in chosen[kept].tolist()], table[kept, :-2]
