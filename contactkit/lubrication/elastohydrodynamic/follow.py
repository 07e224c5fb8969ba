"""Wet gap in time: adaptive steps, and the rupture of a film that is stronger than a cavity.

The liquid ruptures at a tension that may exceed that of a cavity. Until then no cavity opens; the
instant is located, and from there on the pressure of the cavity is the floor, until the last void
is filled again.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any, NamedTuple

import numpy as np
from attrs import frozen
from numpy.typing import NDArray

from ...numerics.roots import bracketed_root
from ...numerics.step_size import StepSize
from .step import METHODS, StepFailedError, Stepped, step
from .wet_gap import Fields, Sets, WetGap

__all__ = ["Control", "State", "Track", "begun", "follow"]

Array = NDArray[np.float64]

_SHORTEST = 1e-10  # step over the whole span, below which there is none
# Step after a rupture over that before it: pressures jump, so that no estimate holds there.
_AFTER_JUMP = 1e-3
_EXTRAPOLATED = 2.5  # growth of a step up to which the last one is extrapolated
_RUPTURE = 1e-6  # where in a step the film ruptures, of its length


@frozen
class Control:
    """Tolerance and steps of a motion.

    Parameters
    ----------
    tolerance : float
        Error of a step, of the force over its largest so far and of the gap over itself.
    stages : int
        2 or 3; with 3 smooth motions take a third of the steps, with cavities or contacts about as
        many, of one and a half times the cost.
    strength : float
        Tension at which the whole film ruptures; below that of a cavity it is the floor itself.
    first : float
        Length of the first step over the span, and of those that need not meet the tolerance:
        whatever begins at once, a speed or a force, makes the pressures of rigid bodies jump, and
        no estimate holds there.
    force : float
        Force to which errors are related, until a larger one acts.
    """

    tolerance: float = 1e-4
    stages: int = 3
    strength: float = 0.0
    first: float = 1e-5
    force: float = 0.0


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
    for time in times[1:]:
        run.go_to(time)
        if run.is_over:
            break
    return Track(run.kept, run.ruptures, run.n_steps, run.n_rejected, run.n_iterations)


def begun(gap: WetGap, fields: Fields, time: float = 0.0) -> State:
    """State of fields without cavities at a time."""
    none = np.zeros(len(gap.shape), dtype=bool)
    return State(time, fields, Sets(none, fields.solid > 0.0))


class _Run:
    """Progress of a motion."""

    def __init__(self, gap: WetGap, start: State, times: Sequence[float], control: Control) -> None:
        self.gap, self.control = gap, control
        self.state = start
        self.every_step, self.until = False, math.inf
        self.kept = [self.state]
        self.ruptures: list[float] = []
        self.size = StepSize(order=METHODS[control.stages].order, safety=0.85, grow=5.0)
        self.span = times[-1] - times[0]
        self.length = control.first * self.span
        self.jumped = True
        self.last: tuple[float, Stepped] | None = None
        self.highest = max(abs(self._force(start.fields)), control.force)
        self.n_steps = self.n_rejected = self.n_iterations = 0

    @property
    def waits(self) -> bool:
        """Whether the film is whole, and stronger than a cavity."""
        return -self.control.strength < self.gap.floor and not self.state.ruptured

    def _force(self, fields: Fields) -> float:
        return self.gap.thrust(fields.pressure + fields.solid, fields.rim)

    @property
    def is_over(self) -> bool:
        """Whether the gap has reached its end."""
        return self.state.fields.rigid_gap >= self.until

    def go_to(self, time: float) -> None:
        """Step until a time or the end; keep its state."""
        near = 0.1 * _SHORTEST * self.span  # sums of steps meet it but for round-off
        while time - self.state.time > near and not self.is_over:
            left = time - self.state.time
            cut = self.length >= left * (1.0 - 1e-9)
            # Two steps rather than one and a tiny rest.
            length = left if cut else min(self.length, max(0.5 * left, 0.1 * self.length))
            accepted = self._try(length, cut_from=self.length if cut else 0.0)
            if accepted and self.every_step and not (cut or self.is_over):
                self.kept.append(self.state)
        if not self.is_over:
            self.state = self.state._replace(time=time)
        self.kept.append(self.state)

    def _try(self, length: float, cut_from: float) -> bool:
        """Try a step; whether it was accepted. Sets the length of the next."""
        if length < _SHORTEST * self.span:
            raise StepFailedError(f"no step can be solved at t = {self.state.time:g}")
        try:
            done = self._step(length)
        except StepFailedError:
            self.n_rejected += 1
            self.last, self.length = None, self.size.shorter(length, math.inf)
            return False
        is_tiny = length <= self.control.first * self.span
        error = 0.0 if self.jumped or is_tiny else self._error(done)
        if error > 1.0:
            self.n_rejected += 1
            self.length = self.size.shorter(length, error)
            return False
        if self.waits and self._lowest(done) < -self.control.strength:
            return self._rupture(length)
        self._accept(done, length)
        planned = cut_from if error < 1.0 else 0.0
        self.length = self.size.following(length, error, planned)
        self.jumped = False
        return True

    def _step(self, length: float) -> Stepped:
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

    def _error(self, done: Stepped) -> float:
        """Error of a step over its tolerance."""
        end, error = done.stages[-1], done.error
        force = abs(self._force(error._replace(rim=end.rim)))
        scale = max(self.highest, abs(self._force(end)), 1e-300)
        h = self.gap.gap(end)
        pressed = self.gap.compliance @ (error.pressure + error.solid)
        moved = np.abs(error.rigid_gap + end.rim * pressed) / np.abs(h)
        # The pressure of a film between rigid bodies is as exact as their gap, which is imposed.
        found = max(force / scale, float(moved.max()), abs(error.rim) / end.rim)
        return found / self.control.tolerance if math.isfinite(found) else math.inf

    @staticmethod
    def _lowest(done: Stepped) -> float:
        return float(done.stages[-1].pressure.min())

    def _rupture(self, length: float) -> bool:
        """Step up to the instant at which the tension reaches the strength."""

        def excess(share: float) -> float:
            lowest = float(self.state.fields.pressure.min())
            if share > 0.0:
                lowest = self._lowest(self._step(share * length))
            return -self.control.strength - lowest

        share = bracketed_root(excess, 0.0, 1.0, _RUPTURE)
        if share > _RUPTURE:
            self._accept(self._step(share * length), share * length)
        self.ruptures.append(self.state.time)
        self.state = self.state._replace(ruptured=True)
        self.kept.append(self.state)
        self.last, self.length, self.jumped = None, _AFTER_JUMP * length, True
        return True

    def _accept(self, done: Stepped, length: float) -> None:
        before, end = self.state, done.stages[-1]
        method = METHODS[self.control.stages]
        powers = np.array([self.gap.dissipation(one) for one in done.stages])
        pulls = np.array([-self._force(one) * one.speed for one in done.stages])
        self.state = State(
            before.time + length,
            end,
            done.sets,
            before.ruptured and bool(done.sets.void.any()),
            before.work + length * float(method.weights @ pulls),
            before.dissipated + length * float(method.weights @ powers),
        )
        same = all(np.array_equal(a, b) for a, b in zip(before.sets, done.sets, strict=True))
        self.last = (length, done) if same and not self.jumped else None
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
