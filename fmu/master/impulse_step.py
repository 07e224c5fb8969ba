r"""One step of the master: the mass on one side, the impulse of the film on the other.

The viscous impulse is a potential, :math:`\Phi'(h) = c(h)`, and what acts beside it is non-stiff.
So the step is taken of the gap and of the momentum of mass and film together,

.. math:: \dot h = v, \qquad \frac{d}{dt}\left[m v + J(h)\right] = F_{ext} - F_m(h) - k (h - h_0)

by the implicit method of two stages, L-stable and of second order, of Alexander. A stage is one
equation for one gap,

.. math:: m \frac{h - h^*}{\gamma H} + J(h) - J_n + \gamma H [F_m(h) + k (h - h_0)] = I

which is monotone while :math:`\gamma H F_m/h < c + m/(\gamma H)`: there is one root, and where the
film rules the gap follows from the impulse alone, whatever the length of the step. The force at
the end of the step in place of J would have a fold and lose that root.

Source of the method: R. Alexander, SIAM J. Numer. Anal. 14 (1977), 1006-1021, Theorem 5.
"""

from __future__ import annotations

import math
from typing import NamedTuple

from ...numerics.quadrature import gauss_legendre
from .sides import FilmSide, Pull, Pulling, Reaction
from .stage_root import Enough, Known, root

__all__ = ["Body", "Doubled", "Point", "doubled", "given", "single"]

_GAMMA = 1.0 - math.sqrt(0.5)  # of the L-stable SDIRK method of two stages and second order
# Error of the root of a stage over the tolerance: a third of the difference of whole and halves is
# the error estimate, in which errors of roots must not show. Smaller, and films are called more
# often.
_SOLVED = 1e-4


class Body(NamedTuple):
    """The mass [kg], a spring [N/m] that is slack at the gap `rest` [m], and the least gap [m]."""

    mass: float
    stiffness: float
    rest: float
    floor: float


class Point(NamedTuple):
    """Point of a coupled run; `momentum` is that of the mass [N.s], `given` all that was."""

    time: float
    gap: float
    speed: float
    momentum: float
    given: float
    film: Reaction


class _Stage(NamedTuple):
    """End of a base step; `total` is the momentum of mass and film [N.s]."""

    gap: float
    speed: float
    total: float
    damping: float


class Passing(NamedTuple):
    """Time since the start of a step [s], with gap [m] and speed [m/s]."""

    since: float
    gap: float
    speed: float


class Doubled(NamedTuple):
    """A step, and the same in two halves, put together."""

    gap: float
    speed: float
    total: float
    damping: float
    between: tuple[Passing, ...]
    gap_error: float
    total_error: float
    speed_error: float


def given(pull: Pulling, start: float, end: float) -> float:
    """Impulse [N.s] of a pull between two times [s], by Gauss' rule of five points.

    Examples
    --------
    >>> round(given(lambda time: 3.0 * time * time, 0.0, 2.0), 12)
    8.0
    """
    span = end - start
    pairs = zip(*gauss_legendre(5), strict=True)
    return span * sum(weight * pull(start + node * span) for node, weight in pairs)


def doubled(
    film: FilmSide, pull: Pull, body: Body, point: Point, length: float, rtol: float
) -> Doubled | None:
    """Try a step as a whole and as two halves, and leave both sides as they were.

    Returns nothing if a stage has no root that can be found.
    """
    marks = film.save(), pull.save()
    half = 0.5 * length
    try:
        whole = _base(film, pull, body, point, length, rtol, marks[0])
        if whole is None:
            return None
        _restore(film, pull, marks)
        first = _base(film, pull, body, point, half, rtol, marks[0])
        if first is None:
            return None
        film.restore(marks[0])
        there = film.move(point.time, half, first.gap, first.speed)
        left = first.total - (there.impulse - point.film.impulse)
        middle = Point(point.time + half, first.gap, first.speed, left, point.given, there)
        mark = film.save()
        second = _base(film, pull, body, middle, half, rtol, mark)
        film.free(mark)
        if second is None:
            return None
        delivered = second.total + there.impulse - point.film.impulse
        return _together(whole, second._replace(total=delivered))
    finally:
        _restore(film, pull, marks)
        film.free(marks[0])
        pull.free(marks[1])


def _restore(film: FilmSide, pull: Pull, marks: tuple[object, object]) -> None:
    film.restore(marks[0])
    pull.restore(marks[1])


def _together(whole: _Stage, halves: _Stage) -> Doubled:
    """Extrapolate: the error of the halves is a third of the difference."""
    # In ln h, in which a film is smooth over decades; a sum of gaps might end below zero.
    gap = math.log(halves.gap / whole.gap) / 3.0
    total, speed = (halves.total - whole.total) / 3.0, (halves.speed - whole.speed) / 3.0
    return Doubled(
        halves.gap * math.exp(gap),
        halves.speed + speed,
        halves.total + total,
        min(whole.damping, halves.damping),
        (),
        abs(gap),
        abs(total),
        abs(speed),
    )


class _Problem(NamedTuple):
    """Equation of one stage that ends `span` [s] after a point."""

    film: FilmSide
    mark: object
    body: Body
    point: Point
    span: float
    part: float  # weight of the stage itself [s]
    base: float  # gap from which the speed of the stage counts [m]
    known: float  # momentum that is delivered in any case [N.s]
    may_fly: bool  # whether the gap may multiply within the step

    @property
    def mass(self) -> float:
        """See `master_root.Stage`."""
        return self.body.mass

    def at(self, gap: float) -> Known:
        """Ask the film for what holds at a gap."""
        body, speed = self.body, (gap - self.base) / self.part
        self.film.restore(self.mark)
        there = self.film.move(self.point.time, self.span, gap, speed)
        held = there.static + body.stiffness * (gap - body.rest)
        return Known(gap, there.impulse - self.point.film.impulse, there.damping, held)

    def missing(self, gap: float, taken: float, held: float) -> float:
        """Momentum that is missing at a gap [N.s]."""
        speed = (gap - self.base) / self.part
        return self.body.mass * speed + taken + self.part * held - self.known


def single(
    film: FilmSide, body: Body, point: Point, impulse: float, length: float, rtol: float
) -> _Stage | None:
    """Try one step under a steady pull of an impulse [N.s], and leave the film as it was."""
    mark = film.save()
    try:
        steady = impulse / length
        return _stages(
            film, body, point, length, rtol, (mark, steady * _GAMMA * length, impulse), may_fly=True
        )
    finally:
        film.restore(mark)
        film.free(mark)


def _base(
    film: FilmSide, pull: Pull, body: Body, point: Point, length: float, rtol: float, mark: object
) -> _Stage | None:
    """Two stages from a point; what pulls goes on to the end of the step."""
    pulling = pull.over(point.time, length, point.gap, point.speed)
    impulse = given(pulling, point.time, point.time + length)
    early = given(pulling, point.time, point.time + _GAMMA * length)
    return _stages(film, body, point, length, rtol, (mark, early, impulse))


def _stages(
    film: FilmSide,
    body: Body,
    point: Point,
    length: float,
    rtol: float,
    pulled: tuple[object, float, float],
    *,
    may_fly: bool = False,
) -> _Stage | None:
    """Two stages; `pulled` is the film's state, and the impulse of the pull to each [N.s]."""
    mark, early, impulse = pulled
    part = _GAMMA * length
    # As good as the step has to be, but never better than the sums can be.
    size = abs(impulse) + abs(point.film.static) * length
    momentum = _SOLVED * rtol * size + 1e-15 * abs(point.film.impulse)
    enough = Enough(_SOLVED * rtol, momentum)
    known = point.momentum + early
    problem = _Problem(film, mark, body, point, part, part, point.gap, known, may_fly)
    held = point.film.static + body.stiffness * (point.gap - body.rest)
    here = Known(point.gap, 0.0, point.film.damping, held, film.power)
    first = root(problem, here, point.gap + part * point.speed, enough)
    if first is None:
        return None
    speed = (first.gap - point.gap) / part
    problem = problem._replace(
        span=length,
        base=point.gap + (length - part) * speed,
        known=point.momentum + impulse - (length - part) * first.held,
    )
    last = root(problem, here, first.gap + (length - part) * speed, enough)
    if last is None:
        return None
    film.power = last.power
    speed, total = (last.gap - problem.base) / part, problem.known - part * last.held
    return _Stage(last.gap, speed, total, last.damping)
