"""One step of the master where a limit of the liquid may act: forces, implicit, of fifth order.

A limit makes the impulse depend on the way, and leaves little of the damping: there is no
potential to exchange, nor a need for it. So the film is asked for its force at a gap and a speed,
which changes nothing in it, and the step is that of `separation.integrator.radau`, which stands any
damping. The gap is asked for no further than the next kink or rupture; the walk cuts the step
there.
"""

from __future__ import annotations

import math

from ...numerics.radau_tableau import WEIGHTS
from ...separation.integrator.radau import Forces, MotionPoint, StepProblem, against_halves, step
from .impulse_step import Body, Doubled, Passing, Point, given
from .sides import FilmSide, Force, Pull, Pulling

__all__ = ["forced"]

# Ratio of gaps between which the exponent of the damping is measured: nearer to one, the digits
# that an FMU gives cancel (1e-15/0.01 is left); farther, a kink may lie between.
_NEARER = 0.99
# Fraction of a gap at which forces have a kink, to stay away from it: on the kink itself an FMU may
# answer for either side. As `_SAME` in `adaptive`.
_EDGE = 1e-9


class _Film:
    """The film inside the piece where its forces are smooth, as the implicit step asks for it."""

    def __init__(self, film: FilmSide, point: Point) -> None:
        self._film = film
        above, below = point.film.above, point.film.below
        self._most = above * (1.0 - _EDGE) if above > 0.0 else math.inf
        self._least = below * (1.0 + _EDGE)
        if not self._least <= point.gap <= self._most:
            self._least, self._most = 0.0, math.inf

    def feel(self, gap: float, speed: float) -> Force:
        """Ask the film, inside its piece."""
        return self._film.feel(min(max(gap, self._least), self._most), speed)

    def forces(self, gap: float, speed: float) -> Forces:
        """Forces and their slopes; that of the static force is counted with the viscous one."""
        found = self.feel(gap, speed)
        viscous = found.force - found.static
        return Forces(found.static, 0.0, viscous, found.stiffness, found.damping, self._film)

    def problem(self, body: Body, point: Point, pulling: Pulling, rtol: float) -> StepProblem:
        """Pose a step of the mass."""
        first = self.forces(point.gap, point.speed)
        damping = self.feel(point.gap, 0.0).damping  # no limit acts at rest
        size = abs(pulling(point.time)) + abs(first.static)
        size += body.stiffness * abs(point.gap - body.rest) + 1e-300
        exponent = 0.0
        if damping > 0.0:
            nearer = self.feel(_NEARER * point.gap, 0.0).damping
            exponent = max(math.log(nearer / damping) / -math.log(_NEARER), 0.0)
        return StepProblem(
            mass=body.mass,
            pull=pulling,
            stiffness=body.stiffness,
            slack_gap=body.rest,
            forces=self.forces,
            has_limits=True,
            exponent=exponent,
            begin=MotionPoint(point.time, point.gap, point.speed),
            first=first,
            rtol=rtol,
            size=size,
            delivered=0.0,
            scale=size / damping if damping > 0.0 else point.gap * 1e6,
        )


def forced(
    film: FilmSide, pull: Pull, body: Body, point: Point, length: float, rtol: float
) -> Doubled | None:
    """Try a step by the forces of the film, and leave both sides as they were.

    Returns nothing if the step has no solution that can be found.
    """
    mark = pull.save()
    try:
        pulling = pull.over(point.time, length, point.gap, point.speed)
        smooth = _Film(film, point)
        problem = smooth.problem(body, point, pulling, rtol)
        taken = step(problem, length)
        if taken is None:
            return None
        there = smooth.feel(point.gap, point.speed)
        kinds, impulse = {film.limit()}, 0.0
        for weight, (_, gap, speed) in zip(WEIGHTS, taken.stages, strict=True):
            there = smooth.feel(gap, speed)
            impulse += length * weight * (there.force - there.static)
            kinds.add(film.limit())
        gap_error, speed_error = taken.gap_error, taken.speed_error
        if len(kinds) > 1:  # the slope of the force jumps inside: no estimate sees that
            halves = against_halves(problem, taken, length)
            if halves is None:
                return None
            gap_error = max(gap_error, halves.gap_error)
            speed_error = max(speed_error, halves.speed_error)
        one, two, end = taken.stages
        seen = length * sum(
            w * pulling(t) for w, (t, *_) in zip(WEIGHTS, taken.stages, strict=True)
        )
        pull.restore(mark)
        missed = abs(seen - _given_in_halves(pull, point, length, end))
        between = tuple(Passing(s.time - point.time, s.gap, s.speed) for s in (one, two))
        total = body.mass * end.speed + impulse
        return Doubled(
            end.gap, end.speed, total, there.damping, between, gap_error, missed, speed_error
        )
    finally:
        pull.restore(mark)
        pull.free(mark)


def _given_in_halves(pull: Pull, point: Point, length: float, end: MotionPoint) -> float:
    """Impulse of the pull over a step [N.s], the source of which gets the motion half way."""
    half = 0.5 * length
    gap = 0.5 * (point.gap + end.gap) + 0.125 * length * (point.speed - end.speed)
    speed = 1.5 * (end.gap - point.gap) / length - 0.25 * (point.speed + end.speed)
    middle = point.time + half
    first = given(pull.over(point.time, half, point.gap, point.speed), point.time, middle)
    return first + given(pull.over(middle, half, gap, speed), middle, point.time + length)
