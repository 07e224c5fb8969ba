"""Impulses of a film whose force, end or volume depends on the speed, over a change of its gap.

The gap moves at its mean speed, which leaves out O(H^3) of the impulse of a step of length H. Along
the way it is divided into panels of ln h: the volume by Runge and Kutta's method of fourth order,
the forces by Simpson's rule, 1e-6 of the impulse of a gap that doubles.
"""

from __future__ import annotations

import math

from ...numerics.roots import first_true
from ...separation.plan import Film, Plan
from .film_travel import Travel

__all__ = ["is_moving", "moving_travel"]

_WIDEST = 0.05  # of a panel, in ln h
_MOST = 200  # panels of a way
_NEAR = 1e-9  # of a panel, to the gap at which the film breaks


def is_moving(plan: Plan) -> bool:
    """Whether force, end or volume of the film of a plan depends on the speed."""
    return bool(plan.film.moving_ends) or plan.volume_rate is not None or bool(plan.film.checks)


def moving_travel(plan: Plan, part: float, begin: float, end: float, length: float) -> Travel:
    """Impulses of a film over a step from one gap [m] to another in some time [s].

    Parameters
    ----------
    plan : Plan
        Whose film it is.
    part : float
        Volume of the film over that of the scene at the begin [-].
    begin, end : float
        Gap [m], positive. The film gives nothing beyond the gap at which it breaks.
    length : float
        Length of the step [s], positive.

    Raises
    ------
    InfeasibleError
        If the step ends where a law is not known.
    """
    speed = (end - begin) / length
    n = min(max(math.ceil(abs(math.log(end / begin)) / _WIDEST), 1), _MOST)
    viscous = static = 0.0
    gap, elapsed = begin, 0.0
    for i in range(n):
        after = end if i == n - 1 else begin * (end / begin) ** ((i + 1) / n)
        dt = (after - gap) / speed if speed else length
        middle = 0.5 * (gap + after)
        half = _left(plan, part, gap, speed, 0.5 * dt)
        whole = _left(plan, half, middle, speed, 0.5 * dt)
        reached = _whole_part(plan, (part, whole), (gap, after), speed)
        if reached < 1.0:
            after, dt = gap + reached * (after - gap), reached * dt
            middle = 0.5 * (gap + after)
            half = part + 0.5 * reached * (whole - part)
            whole = part + reached * (whole - part)
        points = ((part, gap, 1.0), (half, middle, 4.0), (whole, after, 1.0))
        films = [(plan.film_with(x), h, w * dt / 6.0) for x, h, w in points]
        static += sum(w * film.static_force(h) for film, h, w in films)
        viscous += sum(w * film.viscous_force(h, speed)[0] for film, h, w in films)
        gap, part, elapsed = after, whole, elapsed + dt
        if reached < 1.0:
            return Travel(viscous, static, elapsed / length, part=part)
    film = plan.film_with(part)
    _check(plan, film, part, end, speed)
    return Travel(viscous, static, 1.0, film.static_force(end), part=part)


def _check(plan: Plan, film: Film, part: float, gap: float, speed: float) -> None:
    film.check(gap, speed)
    if plan.volume_rate is not None:
        plan.volume_rate.check(gap, speed, part)


def _left(plan: Plan, part: float, gap: float, speed: float, dt: float) -> float:
    """Part of the volume that is left after a time [s] at a speed [m/s]."""
    rate = plan.volume_rate
    if rate is None or not speed:
        return part
    middle, after = gap + 0.5 * speed * dt, gap + speed * dt
    a = rate(gap, speed, part)
    b = rate(middle, speed, part + 0.5 * dt * a)
    c = rate(middle, speed, part + 0.5 * dt * b)
    d = rate(after, speed, part + dt * c)
    return part + dt * (a + 2.0 * b + 2.0 * c + d) / 6.0


def _whole_part(
    plan: Plan, parts: tuple[float, float], gaps: tuple[float, float], speed: float
) -> float:
    """Fraction of a panel up to which the film is whole; 1 if it is at its end."""

    def breaks(at: float) -> bool:
        gap = gaps[0] + at * (gaps[1] - gaps[0])
        part = parts[0] + at * (parts[1] - parts[0])
        return gap > plan.film_with(part).end_at(gap, speed)

    return first_true(breaks, 0.0, 1.0, atol=_NEAR) if breaks(1.0) else 1.0
