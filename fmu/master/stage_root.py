r"""The gap at which a stage of the master ends: Newton in ln h, with the film's own law.

A film gives its impulse J and its damping c = dJ/dh at every gap it is asked for. Between two such
gaps c is close to a power of h, and for flats that is what it is; then

.. math:: J(h) - J_g = \frac{c_g g}{n - 1} \left[1 - (g/h)^{n - 1}\right]

and the equation of the stage is solved with it instead of its tangent. One call of the film then
does for a stage, where Newton's method takes three or four. How well the power has foretold the
last impulse says whether the next one has to be asked for.
"""

from __future__ import annotations

import math
from typing import NamedTuple, Protocol

__all__ = ["Known", "Stage", "root"]

# Factor by which a first guess may change the gap: the power of the film is only known from the
# last step, and a film that is asked at a third of the gap may be 27 times as stiff.
_REACH = 3.0
# Between which a film may stiffen as h^-n: 3 of flats, 1 of spheres, 5 of films that narrow.
# Outside, what was measured is noise of two gaps that are close.
_POWERS = (0.0, 9.0)


class Known(NamedTuple):
    """Answer of a film at a gap [m].

    Viscous impulse since the start of the step [N.s], damping [N.s/m], and the force that holds
    beside it [N].
    """

    gap: float
    taken: float
    damping: float
    held: float
    power: float = 3.0  # with which the damping falls


class Enough(NamedTuple):
    """Errors of ln h [-] and of the momentum [N.s] at which a root is found."""

    log_gap: float
    momentum: float


class Stage(Protocol):
    """The equation of one stage; see `master_step`."""

    @property
    def part(self) -> float:
        """Weight of the stage [s]."""

    @property
    def span(self) -> float:
        """Time from the start of the step to the stage [s]."""

    @property
    def mass(self) -> float:
        """Moving mass [kg]."""

    @property
    def may_fly(self) -> bool:
        """Whether the gap may multiply within the step."""

    def at(self, gap: float) -> Known:
        """Ask the film for what holds at a gap."""

    def missing(self, gap: float, taken: float, held: float) -> float:
        """Momentum that is missing at a gap [N.s]."""


class _Law(NamedTuple):
    """A film around a gap: a power of the gap, and a straight line for what holds beside it."""

    here: Known
    power: float
    slope: float  # of the force that holds [N/m]

    def at(self, gap: float) -> Known:
        gap_here, taken, damping, held, _ = self.here
        move = math.log(gap / gap_here)
        x = (self.power - 1.0) * move
        damped = -math.expm1(-x) / x if x else 1.0
        return Known(
            gap,
            taken + damping * gap_here * move * damped,
            damping * math.exp(-self.power * move),
            held + self.slope * (gap - gap_here),
            self.power,
        )


def root(stage: Stage, start: Known, guess: float, enough: Enough) -> Known | None:
    """Solve a stage; nothing if no root is found.

    Parameters
    ----------
    stage : Stage
        Its equation.
    start : Known
        The film at the start of the step.
    guess : float
        Gap to begin with [m], if the film has no damping.
    enough : Enough
        Errors that are small enough.
    """
    before, gap = start, min(max(guess, start.gap / _REACH), start.gap * _REACH)
    if start.damping > 0.0:
        reach = start.gap / _REACH, start.gap * _REACH
        gap = _solved(stage, _Law(start, start.power, 0.0), reach)
        flies = gap > 0.999 * reach[1]
        if flies and not stage.may_fly and start.damping * stage.part > stage.mass:
            return None  # it would fly off: there is no root to look for
    low, high, last = 0.0, math.inf, math.inf
    for _ in range(80):
        here = stage.at(gap)
        miss = stage.missing(*here[:2], here.held)
        low, high = (gap, high) if miss < 0.0 else (low, gap)
        law, doubt = _law(before, here)
        following = _solved(stage, law, (gap / math.e, gap * math.e))
        move = abs(math.log(following / gap))
        unsure = doubt * move * move
        bent = 2.0 * stage.part * abs(law.slope) * gap * move * (move + abs(_way(before, here)))
        if unsure <= enough.log_gap and unsure * here.damping * gap + bent <= enough.momentum:
            return law.at(following)
        if (abs(miss) <= enough.momentum and move <= enough.log_gap) or high <= low * (1.0 + 4e-16):
            return here
        slow, last, before = abs(miss) > 0.5 * last, abs(miss), here
        if low > 0.0 and math.isfinite(high) and (slow or not low < following < high):
            following = math.sqrt(low * high)
        gap = following
    return None


def _way(before: Known, here: Known) -> float:
    return math.log(here.gap / before.gap)


def _law(before: Known, here: Known) -> tuple[_Law, float]:
    """Law through two gaps, and the error of ln h for each square of the way it is carried on."""
    way = _way(before, here)
    if way == 0.0:
        return _Law(here, before.power, 0.0), 10.0
    slope = (here.held - before.held) / (here.gap - before.gap)
    if not (before.damping > 0.0 and here.damping > 0.0):
        return _Law(here, 0.0, slope), 0.0 if before.damping == here.damping else math.inf
    power = -math.log(here.damping / before.damping) / way
    law = _Law(here, min(max(power, _POWERS[0]), _POWERS[1]), slope)
    expected = law.at(before.gap).taken
    size = here.damping * here.gap
    return law, abs(expected - before.taken) / (size * way * way)


def _solved(stage: Stage, law: _Law, within: tuple[float, float]) -> float:
    """Gap at which a stage ends by the law; the nearer end of a range if it lies beyond."""
    low, high = within
    gap = law.here.gap
    for _ in range(60):
        here = law.at(gap)
        miss = stage.missing(gap, here.taken, here.held)
        low, high = (gap, high) if miss < 0.0 else (low, gap)
        steep = stage.mass / stage.part + here.damping + stage.part * law.slope
        change = -miss / (steep * gap) if steep > 0.0 else math.nan
        following = gap * math.exp(min(max(change, -1.0), 1.0)) if change == change else math.nan
        if not low <= following <= high:
            following = math.sqrt(low * high)
        gap, moved = following, abs(following - gap)
        if moved <= 1e-9 * gap:  # what the next round would change is the square of that
            break
    return gap
