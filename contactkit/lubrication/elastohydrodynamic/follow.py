"""Wet gap in time: adaptive steps by an embedded estimate of their error."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any, NamedTuple

import numpy as np
from attrs import frozen
from numpy.typing import NDArray

from ...numerics.step_size import StepSize
from .progress import Progress
from .step import METHODS, StepFailedError, Stepped, step
from .wet_gap import Fields, Sets, WetGap

__all__ = ["Control", "State", "Track", "begun", "follow"]

Array = NDArray[np.float64]

_EXTRAPOLATED = 2.5  # growth of a step up to which the last one is extrapolated


@frozen
class Control:
    """Tolerance and steps of a motion.

    Parameters
    ----------
    tolerance : float
        Error of a step, of the force over the largest so far or that imposed, and of the gap
        over itself.
    stages : int
        2 or 3; with 3 smooth motions take a third of the steps, with cavities or contacts about as
        many, of one and a half times the cost.
    strength : float
        Tension at which the whole film ruptures; below that of a cavity it is the floor itself.
    first : float
        Length of the first step over the span, and of those that need not meet the tolerance:
        whatever begins at once, a speed or a force, makes the pressures of rigid bodies jump, and
        no estimate holds there.
    """

    tolerance: float = 1e-4
    stages: int = 3
    strength: float = 0.0
    first: float = 1e-5


class State(NamedTuple):
    """State at an instant; `work` is that of the pull, `dissipated` that of the film."""

    time: float
    fields: Fields
    sets: Sets
    ruptured: bool = False
    work: float = 0.0
    dissipated: float = 0.0


class Track(NamedTuple):
    """States at the times asked for, and what they cost.

    `rupture_times` are those at which a whole film ruptured.
    """

    states: list[State]
    rupture_times: list[float]
    n_steps: int
    n_rejected: int
    n_iterations: int


def follow(
    gap: WetGap,
    start: State,
    times: Sequence[float],
    control: Control | None = None,
    *,
    every_step: bool = False,
    until: float = math.inf,
) -> Track:
    """Follow the motion from the first time to the last.

    Parameters
    ----------
    gap : WetGap
        With the floor of its cavities.
    start : State
        At the first of the times; `begun` makes one of fields.
    times : sequence of float
        Ascending; a step ends at each.
    control : Control, optional
        Default: `Control()`.
    every_step : bool
        Whether states are kept after each step, and not at the times alone.
    until : float
        Rigid gap at which the motion ends before the last time; its state is the last one kept.

    Raises
    ------
    StepFailedError
        If no step, however short, can be solved.
    """
    run = _Run(gap, start, times, control or Control())
    run.every_step, run.until = every_step, until
    run.go_through(times[1:])
    return Track(run.kept, run.ruptures, run.n_steps, run.n_rejected, run.n_iterations)


def begun(gap: WetGap, fields: Fields, time: float = 0.0) -> State:
    """State of fields without cavities at a time."""
    none = np.zeros(len(gap.shape), dtype=bool)
    return State(time, fields, Sets(none, fields.solid > 0.0))


class _Run(Progress[State, Stepped]):
    """Progress of a motion on rings."""

    located = 1e-6
    after_rupture = 1e-3  # no estimate holds where pressures jump

    def __init__(self, gap: WetGap, start: State, times: Sequence[float], control: Control) -> None:
        super().__init__(start, times, control, gap.floor)
        self.gap = gap
        self.size = StepSize(order=METHODS[control.stages].order, safety=0.85, grow=5.0)
        self.jumped = True
        self.last: tuple[float, Stepped] | None = None
        self.highest = abs(self._force(start.fields))
        self.n_steps = self.n_rejected = self.n_iterations = 0

    def _force(self, fields: Fields) -> float:
        return self.gap.thrust(fields.pressure + fields.solid, fields.rim)

    def _try(self, length: float, cut_from: float) -> bool:
        """See `Progress._try`."""
        try:
            done = self._solve(length)
        except StepFailedError:
            self.n_rejected += 1
            self.last, self.length = None, self.size.shorter(length, math.inf)
            return False
        is_tiny = length <= self.control.first * self.span
        error = 0.0 if self.jumped or is_tiny else self._error(done, length)
        if error > 1.0:
            self.n_rejected += 1
            self.length = self.size.shorter(length, error)
            return False
        if self._ruptures(done):
            self._rupture(length)
            self.last, self.jumped = None, True
            return True
        self._accept(done, length)
        planned = cut_from if error < 1.0 else 0.0
        self.length = self.size.following(length, error, planned)
        self.jumped = False
        return True

    def _solve(self, length: float) -> Stepped:
        gap = self.gap.with_floor(-math.inf) if self.waits else self.gap
        state = self.state
        done = step(gap, state.fields, state.sets, state.time, length, self._guess(length))
        self.n_iterations += done.n_iterations
        return done

    def _guess(self, length: float) -> list[Fields]:
        """Fields of the last step, extrapolated to the stages of the next."""
        method = METHODS[self.control.stages]
        same = [self.state.fields] * self.control.stages
        if self.last is None or length > _EXTRAPOLATED * self.last[0]:
            return same
        before, done = self.last
        known = method.nodes * before - before
        return [_extrapolated(done.stages, known, at) for at in method.nodes * length]

    def _error(self, done: Stepped, length: float) -> float:
        """Error of a step over its tolerance."""
        end, error = done.stages[-1], done.error
        force = abs(self._force(error._replace(rim=end.rim)))
        imposed = self.gap.imposed(end, self.state.time + length)
        scale = max(self.highest, abs(self._force(end)), imposed, 1e-300)
        h = self.gap.gap(end)
        pressed = self.gap.compliance @ (error.pressure + error.solid)
        moved = np.abs(error.rigid_gap + end.rim * pressed) / np.abs(h)
        # The pressure of a film between rigid bodies is as exact as their gap, which is imposed.
        found = max(force / scale, float(moved.max()), abs(error.rim) / end.rim)
        return found / self.control.tolerance if math.isfinite(found) else math.inf

    def _lowest(self, solved: Stepped) -> float:
        return float(solved.stages[-1].pressure.min())

    def _accept(self, solved: Stepped, length: float) -> None:
        before, end = self.state, solved.stages[-1]
        method = METHODS[self.control.stages]
        powers = np.array([self.gap.dissipation(one) for one in solved.stages])
        pulls = np.array([-self._force(one) * one.speed for one in solved.stages])
        self.state = State(
            before.time + length,
            end,
            solved.sets,
            before.ruptured and bool(solved.sets.void.any()),
            before.work + length * float(method.weights @ pulls),
            before.dissipated + length * float(method.weights @ powers),
        )
        same = all(np.array_equal(a, b) for a, b in zip(before.sets, solved.sets, strict=True))
        self.last = (length, solved) if same and not self.jumped else None
        self.highest = max(self.highest, abs(self._force(end)))
        self.n_steps += 1


def _extrapolated(stages: tuple[Fields, ...], known: Array, at: float) -> Fields:
    """Polynomial through the stages of a step, at a time from its end."""
    weights = [
        math.prod((at - other) / (one - other) for j, other in enumerate(known) if j != k)
        for k, one in enumerate(known)
    ]

    def at_end(values: Sequence[Any]) -> Any:
        return sum(weight * value for weight, value in zip(weights, values, strict=True))

    return Fields(*(at_end(parts) for parts in zip(*stages, strict=True)))
