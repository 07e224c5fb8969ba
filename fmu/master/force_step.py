"""One step of the master where a limit of the liquid may act: forces, implicit, of fifth order.

A limit makes the impulse depend on the way, and leaves little of the damping: there is no
potential to exchange, nor a need for it. So the film is asked for its force at a gap and a speed,
which changes nothing in it, and the step is that of `kernels.stiff_step`, which stands any
damping. The gap is asked for no further than the next kink or rupture; the walk cuts the step
there.
"""

from __future__ import annotations

import math

from ...separation.integrator.radau import WEIGHTS, Stage, Step, slopes, step
from .impulse_step import Body, Doubled, Point, given
from .sides import FilmSide, Force, Pull, Pulling

__all__ = ["forced"]

_NEAR = 1e-6  # share of gap and speed within which a force is taken for a plane
_EDGE = 1e-9  # share of a gap at which forces have a kink, to stay away from it


class _Net:
    """Net force on the mass during a step, with the film asked as rarely as will do."""

    def __init__(self, film: FilmSide, body: Body, point: Point, pulling: Pulling) -> None:
        self._film, self._body, self._pulling = film, body, pulling
        above, below = point.film.above, point.film.below
        self._most = above * (1.0 - _EDGE) if above > 0.0 else math.inf
        self._least = below * (1.0 + _EDGE)
        if not self._least <= point.gap <= self._most:
            self._least, self._most = 0.0, math.inf
        first = self.feel(point.gap, point.speed)
        self._last = point.gap, point.speed, first
        calm = self.feel(point.gap, 0.0)  # without a limit: none acts at rest
        size = abs(pulling(point.time)) + abs(first.static)
        size += body.stiffness * abs(point.gap - body.rest) + 1e-300
        self.damping = calm.damping
        self.scale = size / calm.damping if calm.damping > 0.0 else point.gap * 1e6
        self.power = 0.0
        if calm.damping > 0.0:
            near = 0.99 * point.gap if point.gap > 0.0 else point.gap
            self.power = math.log(self.feel(near, 0.0).damping / calm.damping) / -math.log(0.99)

    def feel(self, gap: float, speed: float) -> Force:
        """Ask the film, inside its piece."""
        return self._film.feel(min(max(gap, self._least), self._most), speed)

    def __call__(self, time: float, gap: float, speed: float) -> float:
        """Net force [N] at a time [s], a gap [m] and a speed [m/s]."""
        at, was, last = self._last
        near = _NEAR * (abs(was) + 1e-3 * self.scale)
        if abs(gap - at) <= _NEAR * at and abs(speed - was) <= near:
            force = last.force + last.stiffness * (gap - at) + last.damping * (speed - was)
        else:
            last = self.feel(gap, speed)
            self._last, force = (gap, speed, last), last.force
        body = self._body
        return self._pulling(time) - body.stiffness * (gap - body.rest) - force

    def step(self, begin: Stage, length: float, rtol: float) -> Step | None:
        """One step of the mass."""
        s = self.power - 1.0 if self.damping * length > self._body.mass else -1.0
        s = s if s > 0.0 else -1.0
        at_start = slopes(self, *begin, self.scale)
        return step(self, self._body.mass, begin, length, s, rtol, at_start, self.scale)


def forced(
    film: FilmSide, pull: Pull, body: Body, point: Point, length: float, rtol: float
) -> Doubled | None:
    """Try a step by the forces of the film, and leave both sides as they were.

    Returns nothing if the step has no solution that can be found.
    """
    mark = pull.save()
    try:
        pulling = pull.over(point.time, length, point.gap, point.speed)
        net = _Net(film, body, point, pulling)
        begin = Stage(point.time, point.gap, point.speed)
        taken = net.step(begin, length, rtol)
        if taken is None:
            return None
        there = net.feel(point.gap, point.speed)
        kinds, impulse = {film.limit()}, 0.0
        for weight, (_, gap, speed) in zip(WEIGHTS, taken.stages, strict=True):
            there = net.feel(gap, speed)
            impulse += length * weight * (there.force - there.static)
            kinds.add(film.limit())
        gap_error, speed_error = taken.gap_error, taken.speed_error
        if len(kinds) > 1:  # the slope of the force jumps inside: no estimate sees that
            errors = _against_halves(net, begin, length, rtol, taken)
            if errors is None:
                return None
            gap_error, speed_error = max(gap_error, errors[0]), max(speed_error, errors[1])
        one, two, end = taken.stages
        seen = length * sum(
            w * pulling(t) for w, (t, *_) in zip(WEIGHTS, taken.stages, strict=True)
        )
        pull.restore(mark)
        missed = abs(seen - _given_in_halves(pull, point, length, end))
        way = tuple((s.time - point.time, s.gap, s.speed) for s in (one, two))
        total = body.mass * end.speed + impulse
        return Doubled(
            end.gap, end.speed, total, there.damping, way, gap_error, missed, speed_error
        )
    finally:
        pull.restore(mark)
        pull.forget(mark)


def _given_in_halves(pull: Pull, point: Point, length: float, end: Stage) -> float:
    """Impulse of the pull over a step [N.s], with what pulls told of the motion half way."""
    half = 0.5 * length
    gap = 0.5 * (point.gap + end.gap) + 0.125 * length * (point.speed - end.speed)
    speed = 1.5 * (end.gap - point.gap) / length - 0.25 * (point.speed + end.speed)
    middle = point.time + half
    first = given(pull.over(point.time, half, point.gap, point.speed), point.time, middle)
    return first + given(pull.over(middle, half, gap, speed), middle, point.time + length)


def _against_halves(
    net: _Net, begin: Stage, length: float, rtol: float, taken: Step
) -> tuple[float, float] | None:
    """How far a step is from the same in two halves: logarithm of the gap, and speed [m/s]."""
    first = net.step(begin, 0.5 * length, rtol)
    second = first and net.step(first.stages[2], 0.5 * length, rtol)
    if second is None:
        return None
    end, again = taken.stages[2], second.stages[2]
    return abs(math.log(again.gap / end.gap)), abs(again.speed - end.speed)
