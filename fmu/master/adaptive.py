"""Adaptive communication steps of a coupled run, cut at events, up to a gap or a time."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import NamedTuple

from ...errors import ConvergenceError
from ...numerics.events import EventStep, first_crossing, step_to_event
from ...numerics.roots import first_true
from ...numerics.step_size import StepSize
from .force_step import forced
from .impulse_step import Body, Doubled, Point, doubled, given
from .sides import FilmSide, Pull, Pulling, Reaction

__all__ = ["Goal", "Walk"]

# Gaps closer than this, relatively, are one. A step that ends at an event is put on its gap; FMUs
# state the next one with their own round-off, which must not make an event of zero length.
_SAME = 1e-9
# In a row. A step that shrinks by 0.9 each time is then 500 times shorter, by 0.1 long at
# round-off.
_MOST_REJECTED = 60
# Error of a step that does not find the gap of an event: the next is 0.4 times as long.
_NOT_LOCATED = 16.0
_REST = 0.02  # fraction of the final time of a step at rest: fifty points of a pull that only rises


class Goal(NamedTuple):
    """Time and gap at which a run ends, and times at which a step has to end."""

    stop_time: float
    release_gap: float  # inf: none
    jumps: Sequence[float] = ()  # times at which the pull is not smooth [s]


class Walk:
    """Points on the way so far; `step` adds one.

    Attributes
    ----------
    points : list of Point
        With the start.
    pulls : list of float
        Pull [N] at the end of each step.
    release_time : float
        When the gap first came to that of the goal [s]; -1 before.
    n_rejected : int
        Steps that were taken again, shorter.
    """

    def __init__(
        self,
        film: FilmSide,
        pull: Pull,
        body: Body,
        first: Point,
        goal: Goal,
        tolerance: float,
    ) -> None:
        self.film, self.pull, self.body, self.goal = film, pull, body, goal
        self.points, self.pulls = [first], [math.nan]
        self.release_time = -1.0
        self.n_rejected = 0
        self._length = 1e-3 * (goal.stop_time - first.time)
        self._held = first.gap <= body.floor and first.speed <= 0.0
        self._tolerance = tolerance
        self._film_tolerance = 0.5 * tolerance
        self._control = StepSize(order=3, grow=5.0, unsolved=0.5)
        if film.has_limits:  # without extrapolation errors add up from step to step
            self._film_tolerance *= 0.5
            self._control = self._control._replace(order=4)

    @property
    def is_done(self) -> bool:
        """Whether the gap or the time asked for is reached."""
        return self.release_time >= 0.0 or self.points[-1].time >= self.goal.stop_time

    def step(self) -> None:
        """Take one step, as long as its error allows, and no further than the next event."""
        point, goal = self.points[-1], self.goal
        end = min([t for t in goal.jumps if t > point.time] + [goal.stop_time])
        if self._held:
            self._rest(point, end)
            return
        length = min(self._length, end - point.time)
        rejected = 0
        while True:
            found, mark, ended = self._try(length), None, None
            error = self._judge(found, length) if found is not None else math.inf
            if found is not None and error <= 1.0:
                mark = self._mark(point, found.gap)
                ended = self._ended(found, length, mark)
                if ended is not None:
                    break
                error = _NOT_LOCATED
            rejected += 1
            length = self._control.shorter(length, error)
            if rejected > _MOST_REJECTED or length < 1e-15 * max(point.time, 1e-12):
                raise ConvergenceError(
                    f"no step can be taken from {point.time:g} s, gap {point.gap:g} m, that meets "
                    f"the tolerance of {self._tolerance:g}; loosen it, or use the FMU stiction-mass"
                )
        self.n_rejected += rejected
        is_cut = not rejected and length < self._length
        self._length = self._control.following(length, error, self._length if is_cut else 0.0)
        found, length = ended
        self._accept(found, length, end, mark)

    def _rest(self, point: Point, end: float) -> None:
        """Hold at the stop until the pull exceeds the holding force."""
        length = min(end - point.time, _REST * self.goal.stop_time)
        holding = self.body.stiffness * (point.gap - self.body.rest) + point.film.static
        start = self.pull.save()
        pulling = self.pull.over(point.time, length, point.gap, 0.0)
        self._held = pulling(point.time) <= holding
        if self._held:

            def exceeds(span: float) -> bool:
                self.pull.restore(start)
                pulling = self.pull.over(point.time, span, point.gap, 0.0)
                return pulling(point.time + span) > holding

            if pulling(point.time + length) > holding:
                self._held = False
                length = first_true(exceeds, 0.0, length, atol=1e-12 * length)
                self.pull.restore(start)
                pulling = self.pull.over(point.time, length, point.gap, 0.0)
            there = self.film.move(point.time, length, point.gap, 0.0)
            time = point.time + length
            self._add(Point(time, point.gap, 0.0, 0.0, point.given, there), pulling, end)
        else:
            self.pull.restore(start)
        self.pull.free(start)

    def _add(self, point: Point, pulling: Pulling, end: float) -> None:
        if abs(point.time - end) <= 1e-13 * end:
            point = point._replace(time=end)
        if len(self.points) == 1:
            self.pulls[0] = pulling(self.points[0].time)
        self.pulls.append(pulling(point.time))
        self.points.append(point)

    def _try(self, length: float) -> Doubled | None:
        attempt = forced if self.film.has_limits else doubled
        return attempt(
            self.film, self.pull, self.body, self.points[-1], length, self._film_tolerance
        )

    def _judge(self, found: Doubled, length: float) -> float:
        """Error over tolerance: of the gap, and of the momentum against all that was given.

        An error of speed counts as far as the film leaves it: it dies out within m/c. So a
        transient of that length, 1e-12 s at 10 nm, is stepped over.
        """
        point, mass = self.points[-1], self.body.mass
        size = point.given + abs(found.total - point.momentum) + abs(point.film.static) * length
        size += mass * abs(found.speed)
        if size == 0.0:  # nothing pulls, holds or moves
            return found.gap_error / self._film_tolerance
        lasting = mass * found.speed_error / (1.0 + found.damping * length / mass)
        wrong = max(found.gap_error, found.total_error / size, lasting / size)
        return wrong / self._film_tolerance

    def _mark(self, point: Point, gap: float) -> float | None:
        """First gap on the way at which something happens."""
        events = [point.film.above, point.film.below, self.body.floor]
        if gap > point.gap:
            events.append(self.goal.release_gap)
        return first_crossing(events, point.gap, gap, _SAME)

    def _ended(
        self, found: Doubled, length: float, mark: float | None
    ) -> EventStep[Doubled] | None:
        """Step that ends at a gap, if there is one on the way; nothing if it is not found.

        A step that is too rough may jump over the gap; a shorter one does not.
        """
        if mark is None:
            return EventStep(found, length)
        point = self.points[-1]
        travel = math.log(found.gap / point.gap)
        # A stiff film may hardly have moved, and its impulse is in what it did.
        enough = 1e-3 * self._tolerance * min(1.0, abs(travel))

        def beyond(step: Doubled) -> float:
            return math.copysign(1.0, travel) * math.log(step.gap / mark)

        begin = -abs(math.log(point.gap / mark))
        located = step_to_event(self._try, beyond, begin, found, length, enough)
        return located if abs(beyond(located.taken)) <= 1e3 * enough else None

    def _accept(self, found: Doubled, length: float, end: float, mark: float | None) -> None:
        point = self.points[-1]
        pulling = self.pull.over(point.time, length, point.gap, point.speed)
        time = point.time + length
        gap, speed, there = self._settle(found, length, mark)
        impulse = abs(given(pulling, point.time, time)) + abs(there.static) * length
        left = found.total - (there.impulse - point.film.impulse)
        if self.film.has_limits:
            left = self.body.mass * speed
        if mark == self.body.floor and gap < point.gap:
            speed, left, self._held = 0.0, 0.0, True
        self._add(Point(time, gap, speed, left, point.given + impulse, there), pulling, end)
        if point.gap < gap and gap >= self.goal.release_gap * (1.0 - _SAME):
            self.release_time = self.points[-1].time

    def _settle(
        self, found: Doubled, length: float, mark: float | None
    ) -> tuple[float, float, Reaction]:
        """Move the film to the end of a step; gap and speed share the residual.

        Extrapolated one by one they miss the momentum of both, which is the better known: where
        the film rules that moves the gap, else the speed.
        """
        point, mass = self.points[-1], self.body.mass
        gap, speed = found.gap if mark is None else mark, found.speed
        if self.film.has_limits:
            since = 0.0
            for until, *motion in found.between:
                self.film.move(point.time + since, until - since, *motion)
                since = until
            return gap, speed, self.film.move(point.time + since, length - since, gap, speed)
        start = self.film.save()
        there = self.film.move(point.time, length, gap, speed)
        for _ in range(4):
            miss = mass * speed + there.impulse - point.film.impulse - found.total
            change = -miss / (there.damping + mass / length)
            if mark is not None or abs(change) <= max(1e-2 * found.gap_error, 1e-15) * gap:
                break
            gap, speed = gap + change, speed + change / length
            self.film.restore(start)
            there = self.film.move(point.time, length, gap, speed)
        self.film.free(start)
        return gap, speed, there
