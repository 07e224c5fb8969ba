"""Prepared law of a force: its value over gap and speed, its slopes, and its range."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from itertools import pairwise
from typing import Literal, NamedTuple

from attrs import evolve, field, frozen

from ...numerics.quadrature import gauss_legendre
from ...validators import choice

__all__ = ["ForceLaw", "LawAt", "Rate", "law_impulse", "measured_rate", "settled"]

_INF = math.inf

Rate = Literal["any", "none", "proportional"]
"""How a force depends on the speed."""

# Relative step of a difference. Truncation and rounding balance at the root of 2e-16: a slope is
# right to some 1e-7, and Newton's method loses no iteration by that.
_STEP = 1e-7
# Least step of the speed [m/s], for a force at rest: slower than any motion that is looked at, and
# wide enough that 1 N that does not depend on the speed leaves a slope right to 1e-4 N.s/m.
_LEAST = 1e-12
_NEARER = 0.99  # ratio of gaps between which an exponent is measured
_STEEPEST = 8.0  # exponent that is taken for a damping at most, as in the tables of native FMUs
_PANEL = 0.25  # in ln h: six nodes integrate powers up to h^-8 to round-off
_TOUCH = 1e-12  # of the upper gap; an impulse from a touch begins there
_SPEEDS = (1e-6, 1e-3, 1.0)  # [m/s], of either sign
_SAME = 1e-9  # of a force, up to which it counts as linear in the speed
_ROUNDING = 1e-13  # of what it is at rest


class LawAt(NamedTuple):
    """A force at a gap and a speed, split into what it is at rest and what the speed adds.

    `static` [N] is F(h, 0), `viscous` [N] is F(h, v) - F(h, 0); with their slopes [N/m], [N.s/m].
    """

    static: float
    static_by_gap: float
    viscous: float
    viscous_by_gap: float
    viscous_by_speed: float


@frozen(eq=False)
class ForceLaw:
    """Prepared force law: F(h, v), its slopes dF/dh and dF/dv, and its range.

    Parameters
    ----------
    force : callable
        Force [N] at a gap [m] and a speed [m/s]; positive resists opening.
    kinks : tuple of float
        Gaps [m] at which its slope jumps.
    end : float
        Gap [m] beyond which it does not exist; inf: none.
    release, recontact : float
        A contact of solids pulls off where the gap exceeds `release` [m], and is there again once
        that has closed to `recontact` [m]; the law goes on smoothly beyond.
    known_to : float
        Gap [m] beyond which it is constant.
    poles : tuple of float
        Gaps [m] at which it is infinite and changes its sign: it has no impulse over them.
    slopes : callable, optional
        dF/dh [N/m] and dF/dv [N.s/m] at a gap and a speed. None: by differences of 1e-7 of gap and
        speed (1e-12 m/s at rest), right to about 1e-7 of F/h and of F/v.
    rate : {"any", "none", "proportional"}
        ``"none"``, the force does not depend on the speed, and ``"proportional"``, it is v times
        that at 1 m/s, save evaluations; the plan refuses a law that does otherwise.
    exponent : callable, optional
        n at a gap, of a damping that falls as gap^-n; None: measured. It only sets in which
        coordinate a step is solved.
    end_at : callable, optional
        Gap [m] beyond which it does not exist at a gap and a speed, `end` at most, where that
        depends on the motion.
    check : callable, optional
        Raises an InfeasibleError at a gap and a speed at which the law is not known. It is called
        where a motion gets to; the law itself is also asked where a step only tries.
    impulse : callable, optional
        Time integral [N.s] between two gaps, which no path in time changes, of a law that is
        proportional to speed; None: by quadrature.

    Notes
    -----
    The value of a law is exact; slopes steer the iteration within a step and the error control.

    Examples
    --------
    >>> drag = ForceLaw(lambda gap, speed: 3.0 + 50.0 * speed * abs(speed))
    >>> at = drag.at(1e-6, 0.1)
    >>> at.static, round(at.viscous, 9), round(at.viscous_by_speed, 4)
    (3.0, 0.5, 10.0)
    """

    force: Callable[[float, float], float]
    kinks: tuple[float, ...] = ()
    end: float = _INF
    release: float = _INF
    recontact: float = 0.0
    known_to: float = _INF
    poles: tuple[float, ...] = ()
    slopes: Callable[[float, float], tuple[float, float]] | None = field(default=None, kw_only=True)
    rate: Rate = field(default="any", validator=choice("any", "none", "proportional"), kw_only=True)
    exponent: Callable[[float], float] | None = field(default=None, kw_only=True)
    end_at: Callable[[float, float], float] | None = field(default=None, kw_only=True)
    check: Callable[[float, float], None] | None = field(default=None, kw_only=True)
    impulse: Callable[[float, float], float] | None = field(default=None, kw_only=True)

    def static_slope(self, gap: float) -> tuple[float, float]:
        """Force at rest [N], and its slope over the gap [N/m]."""
        value = self.force(gap, 0.0)
        if self.slopes is not None:
            return value, self.slopes(gap, 0.0)[0]
        near = gap * (1.0 + _STEP)
        return value, (self.force(near, 0.0) - value) / (near - gap)

    def damping_slope(self, gap: float) -> tuple[float, float]:
        """Force per speed of a law proportional to it [N.s/m], and its slope [N.s/m2]."""
        value = self.force(gap, 1.0)
        if self.slopes is not None:
            return value, self.slopes(gap, 1.0)[0]
        near = gap * (1.0 + _STEP)
        return value, (self.force(near, 1.0) - value) / (near - gap)

    def at(self, gap: float, speed: float) -> LawAt:
        """Force at a gap [m] and a speed [m/s] with its slopes."""
        if self.rate == "none":
            return LawAt(*self.static_slope(gap), 0.0, 0.0, 0.0)
        if self.rate == "proportional":
            damping, by_gap = self.damping_slope(gap)
            return LawAt(0.0, 0.0, damping * speed, by_gap * speed, damping)
        static, static_by_gap = self.static_slope(gap)
        value = self.force(gap, speed) if speed else static
        if self.slopes is not None:
            by_gap, by_speed = self.slopes(gap, speed)
        else:
            near, by_gap = gap * (1.0 + _STEP), static_by_gap
            if speed:
                by_gap = (self.force(near, speed) - value) / (near - gap)
            faster = speed + math.copysign(max(_STEP * abs(speed), _LEAST), speed)
            by_speed = (self.force(gap, faster) - value) / (faster - speed)
        return LawAt(static, static_by_gap, value - static, by_gap - static_by_gap, by_speed)

    def viscous_force(self, gap: float, speed: float) -> float:
        """Viscous part of the force [N]: F(h, v) - F(h, 0)."""
        if self.rate == "none" or not speed:
            return 0.0
        value = self.force(gap, speed)
        return value if self.rate == "proportional" else value - self.force(gap, 0.0)

    def damping(self, gap: float, speed: float) -> float:
        """Damping [N.s/m]: the viscous part over a speed [m/s] that is not 0."""
        if self.rate == "proportional":
            return self.force(gap, 1.0)
        return self.viscous_force(gap, speed) / speed

    def exponent_at(self, gap: float, speed: float) -> float:
        """Exponent n of the damping at a gap and a speed that is not 0, which falls as gap^-n."""
        if self.exponent is not None:
            return self.exponent(gap)
        here, nearer = self.damping(gap, speed), self.damping(_NEARER * gap, speed)
        if not (here > 0.0 and 0.0 < nearer / here < _INF):
            return 0.0
        return min(max(math.log(nearer / here) / -math.log(_NEARER), 0.0), _STEEPEST)


def law_impulse(law: ForceLaw, start: float, end: float) -> float:
    """Impulse [N.s] between two gaps [m] of a law that is proportional to the speed.

    In closed form, or by Gauss's rule in panels of ln h between the kinks.

    Examples
    --------
    >>> drag = ForceLaw(lambda gap, speed: 1e-9 * speed / gap**2, rate="proportional")
    >>> round(law_impulse(drag, 1e-6, 1e-3), 12)
    0.000999
    """
    if law.impulse is not None:
        return law.impulse(start, end)
    if end < start:
        return -law_impulse(law, end, start)
    low = max(start, _TOUCH * end)
    total = (low - start) * law.force(low, 1.0) if low > start else 0.0
    marks = [low, *sorted(kink for kink in law.kinks if low < kink < end), end]
    nodes = tuple(zip(*gauss_legendre(6), strict=True))
    for a, b in pairwise(marks):
        n = math.ceil(math.log(b / a) / _PANEL)
        ratio = (b / a) ** (1.0 / max(n, 1))
        for k in range(n):
            begin = a * ratio**k
            width = begin * (ratio - 1.0)
            total += width * sum(w * law.force(begin + x * width, 1.0) for x, w in nodes)
    return total


def measured_rate(law: ForceLaw, gaps: Sequence[float]) -> Literal[Rate, "linear"]:
    """Dependence of a force on the speed, from its values at some gaps [m] and six speeds.

    ``"linear"`` is F(h, 0) + c(h) v, to 1e-9 of what the speed adds.

    Examples
    --------
    >>> measured_rate(ForceLaw(lambda gap, speed: 9.81), [1e-6])
    'none'
    >>> measured_rate(ForceLaw(lambda gap, speed: 9.81 + 2.0 * speed), [1e-6])
    'linear'
    >>> measured_rate(ForceLaw(lambda gap, speed: speed * abs(speed)), [1e-6])
    'any'
    """
    found: set[str] = set()
    for gap in gaps:
        rest, unit = law.force(gap, 0.0), law.force(gap, 1.0) - law.force(gap, 0.0)
        for speed in (sign * size for size in _SPEEDS for sign in (1.0, -1.0)):
            added = law.force(gap, speed) - rest
            if abs(added - unit * speed) > _SAME * abs(added) + _ROUNDING * abs(rest):
                return "any"
        found.add("none" if unit == 0.0 else "proportional" if rest == 0.0 else "linear")
    if found <= {"none"}:
        return "none"
    return "linear" if "linear" in found or any(law.force(g, 0.0) for g in gaps) else "proportional"


def settled(law: ForceLaw, gaps: Sequence[float]) -> ForceLaw:
    """Law that says how it depends on the speed, where values at some gaps [m] tell."""
    if law.rate != "any":
        return law
    rate = measured_rate(law, gaps)
    return law if rate == "linear" else evolve(law, rate=rate)
