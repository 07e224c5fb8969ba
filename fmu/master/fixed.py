"""Fixed communication steps: what most masters do, and where it is refused."""

from __future__ import annotations

import math

from ...errors import ConvergenceError, InfeasibleError
from .adaptive import Goal
from .impulse_step import Body, Point, given, single
from .sides import FilmSide, Pull, Reaction
from .steps import FixedSteps

__all__ = ["FixedWalk"]

_STABLE = {"gauss-seidel": 2.0, "jacobi": 1.0}  # times m/c


class FixedWalk:
    """Points at fixed steps; `step` adds one. Attributes as those of `adaptive.Walk`."""

    def __init__(
        self,
        film: FilmSide,
        pull: Pull,
        body: Body,
        first: Point,
        goal: Goal,
        steps: FixedSteps,
    ) -> None:
        self.film, self.pull, self.body, self.goal = film, pull, body, goal
        self.points, self.pulls = [first], [math.nan]
        self.release_time, self.n_rejected = -1.0, 0
        self._scheme, self._refuses = steps.scheme, steps.refuse_unstable
        self._late = first.film.force
        self._count = max(1, math.ceil(goal.stop_time / steps.step - 1e-9))
        self._check_step()

    @property
    def is_done(self) -> bool:
        """Whether the gap or the time asked for is reached."""
        return self.release_time >= 0.0 or len(self.points) > self._count

    @property
    def _length(self) -> float:
        return self.goal.stop_time / self._count

    def _check_step(self) -> None:
        """Refuse a step with which the force of the film would feed on itself."""
        damping = self.points[-1].film.damping
        factor = _STABLE.get(self._scheme, math.inf)
        if not self._refuses or self._length * damping <= factor * self.body.mass:
            return
        stable = factor * self.body.mass / damping
        raise InfeasibleError(
            f"the communication step of {self._length:.3g} s exceeds {stable:.3g} s = "
            f"{factor:g} m/c at a gap of {self.points[-1].gap:.3g} m, the longest with which the "
            f"force of this film can be exchanged ({self._scheme}); take {0.1 * stable:.2g} s, or "
            f"AdaptiveSteps, or the FMU stiction-mass, which has the mass inside and needs no "
            f"short step"
        )

    def step(self) -> None:
        """Take one step."""
        self._check_step()
        point, length = self.points[-1], self._length
        pulling = self.pull.over(point.time, length, point.gap, point.speed)
        impulse = given(pulling, point.time, point.time + length)
        start = self.film.save()
        if self._scheme in _STABLE:
            gap, speed, there = self._explicit(point, impulse)
        elif self._scheme == "implicit-force":
            gap, speed, there = self._implicit_force(point, impulse)
        else:
            gap, speed, there = self._by_impulse(point, impulse)
        if gap < self.body.floor:
            self.film.restore(start)
            gap, speed = self.body.floor, 0.0
            there = self.film.move(point.time, length, gap, speed)
            self._late = there.force
        self.film.free(start)
        time = len(self.points) * length
        if len(self.points) == 1:
            self.pulls[0] = pulling(point.time)
        self.pulls.append(pulling(time))
        done = point.given + abs(impulse)
        self.points.append(Point(time, gap, speed, self.body.mass * speed, done, there))
        goal = self.goal.release_gap
        if point.gap < goal <= gap:
            self.release_time = point.time + length * (goal - point.gap) / (gap - point.gap)

    def _explicit(self, point: Point, impulse: float) -> tuple[float, float, Reaction]:
        """The mass goes ahead with a force of the film that is one or two steps old."""
        body, length = self.body, self._length
        is_late = self._scheme == "jacobi"
        held = self._late if is_late else point.film.force
        held += body.stiffness * (point.gap - body.rest)
        gained = (impulse - length * held) / body.mass
        gap, speed = point.gap + length * (point.speed + 0.5 * gained), point.speed + gained
        if not 0.0 < gap < math.inf:
            raise ConvergenceError(
                f"{self._scheme} with a step of {length:.3g} s blew up: the gap became {gap:.3g} m "
                f"at {point.time + length:.3g} s; m/c is {body.mass / point.film.damping:.3g} s; "
                f"take steps well below it, or AdaptiveSteps"
            )
        seen = (point.gap, point.speed) if is_late else (gap, speed)
        there = self.film.move(point.time, length, *seen)
        self._late = there.force
        return gap, speed, there

    def _by_impulse(self, point: Point, impulse: float) -> tuple[float, float, Reaction]:
        found = single(self.film, self.body, point, impulse, self._length, 1e-6)
        if found is None:
            raise self._lost(point)
        there = self.film.move(point.time, self._length, found.gap, found.speed)
        return found.gap, found.speed, there

    def _implicit_force(self, point: Point, impulse: float) -> tuple[float, float, Reaction]:
        """Implicit in the force at the end of the step: secants from the gap the speed leads to."""
        body, length = self.body, self._length
        mark = self.film.save()
        gap = max(point.gap + length * point.speed, 0.5 * point.gap)
        before = miss = math.nan
        try:
            for _ in range(40):
                speed = (gap - point.gap) / length
                self.film.restore(mark)
                there = self.film.move(point.time, length, gap, speed)
                held = there.force + body.stiffness * (gap - body.rest)
                last, miss = miss, body.mass * (speed - point.speed) + length * held - impulse
                slope = body.mass / length + there.damping
                if math.isfinite(last) and miss != last:
                    slope = (miss - last) / (gap - before)
                change = -miss / slope
                if abs(change) <= 1e-9 * abs(gap - point.gap) + 1e-15 * gap:
                    return gap, speed, there
                before, gap = gap, max(gap + change, 0.1 * gap)
        finally:
            self.film.free(mark)
        raise self._lost(point)

    def _lost(self, point: Point) -> ConvergenceError:
        return ConvergenceError(
            f"{self._scheme} found no end of the step of {self._length:.3g} s from "
            f"{point.time:.3g} s, gap {point.gap:.3g} m; take a shorter step, or AdaptiveSteps"
        )
