"""Impulses of a film over a change of its gap, and the time of its rupture.

The viscous impulse of a film without limits does not depend on the way, so it is exact between
any two gaps, however long the step. For the static force, and where a limit of the liquid acts,
the way matters: the gap is taken to move at its mean speed, which leaves out O(H^3) of the impulse
of a step of length H. Along that way the integrals are by panels in ln h between the kinks of the
forces, narrower towards the gap at which the film breaks, where the slope of a bridge has no bound:
1e-7 of the static impulse over a gap ratio of 1e3, 1e-5 of the viscous one under limits. A film
with a cavity is followed along the same path in steps of time, with what it remembers.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from itertools import pairwise
from typing import NamedTuple

from ...numerics.quadrature import LOBATTO_5, gauss_legendre
from ...numerics.roots import first_true
from ...separation.cavity.events import is_inception
from ...separation.cavity.law import CavityLaw
from ...separation.cavity.path import along_path
from ...separation.cavity.state import FULL, Cavity, Phase
from ...separation.effects.base import LimitKind
from ...separation.plan import Film

__all__ = ["Travel", "travel"]

_SHORT = 0.02  # step over gap up to which Simpson's rule leaves out 1e-7 of the static impulse
_WIDEST = 0.5  # of a panel, in ln h
_MOST = 200  # panels of a way, but for kinks and ruptures: of a gap ratio of 1e40
_PANELS = 4  # at least, to look for limits on the way
_NEAR = 1e-4  # panel over gap at the end of the film
_NEAR_ONSET = 1e-4  # of a panel, to the onset of a limit: the force is smooth to first order there
_MOST_STEPS = 5000  # of a cavity: some seconds where values are hostile, and a pull takes some 250
_VOID = 1e-9  # error of the void in a step of time, over the volume of the film
_GAUSS = tuple(zip(*gauss_legendre(3), strict=True))
# The ends of Lobatto's rule are those of the panels next to it, and known there.
_LOBATTO = tuple(zip(*LOBATTO_5, strict=True))[1:-1]
_EDGE = LOBATTO_5[1][0]


class Travel(NamedTuple):
    """Viscous and other impulse [N.s], and the fraction of the step after which the film is broken.

    `broken` is 1 if it is not; `last` is the static force at the end [N], and `cavity` that there;
    `changed` is the fraction of the step after which the film cavitated last, or was full again.
    """

    viscous: float
    static: float
    broken: float
    last: float = 0.0
    cavity: Cavity = FULL
    changed: float = 0.0
    part: float = 1.0
    """Volume of the film over that of the scene at the end."""


def travel(
    film: Film,
    begin: float,
    end: float,
    length: float,
    first: float | None = None,
    cavity: Cavity = FULL,
) -> Travel:
    """Impulses of a film over a step from one gap to another.

    Parameters
    ----------
    film : Film
        The film at the begin of the step.
    begin, end : float
        Gap [m], positive. The film gives nothing beyond the gap at which it breaks.
    length : float
        Length of the step [s], positive.
    first : float, optional
        What does not depend on speed at the begin [N], if it is known already.
    cavity : Cavity
        Of the film at the begin.
    """
    fraction = 1.0
    if end > film.end:
        fraction = (film.end - begin) / (end - begin)
        end, length = film.end, length * fraction
    first = film.static_force(begin) if first is None else first
    last = first if end == begin else film.static_force(end)
    static = length * _static_mean(film, begin, end, first, last)
    if not isinstance(film.cavity, CavityLaw):  # others are refused when an FMU is built
        return Travel(_viscous(film, begin, end, length), static, fraction, last)
    viscous, cavity, changed = _with_memory(film.cavity, film, cavity, begin, end, length)
    # Of what the cavity does not bound, such as a column of the liquid.
    viscous += film.viscous_impulse(begin, end) - film.newtonian_impulse(begin, end)
    return Travel(viscous, static, fraction, last, cavity, fraction * changed / length)


def _with_memory(
    law: CavityLaw, film: Film, cavity: Cavity, begin: float, end: float, length: float
) -> tuple[float, Cavity, float]:
    """Viscous impulse of a film that remembers its cavity [N.s], the cavity, and its last change.

    That is the time [s] since the begin at which the film cavitated, or was full again.
    """
    speed, total, gap, changed = (end - begin) / length, 0.0, begin, 0.0

    def place(time: float) -> tuple[float, float]:
        return begin + speed * time, speed

    is_whole = cavity.phase is Phase.FULL and not is_inception(law, cavity, begin, speed)
    path = along_path(law, cavity, place, 0.0, length, _VOID, most_steps=_MOST_STEPS)
    for point in path:
        after, cavity = place(point.time)[0], point.cavity
        total += film.newtonian_impulse(gap, after) if point.impulse is None else point.impulse
        if is_whole is not (cavity.phase is Phase.FULL):
            is_whole, changed = not is_whole, point.time
        gap = after
    return total, cavity, changed


def _static_mean(film: Film, begin: float, end: float, first: float, last: float) -> float:
    """Mean over the gap of what does not depend on speed [N], from its values at both ends."""
    if end == begin:
        return first
    stops = [begin, *_stops(film, begin, end, _WIDEST)]
    if len(stops) == 2 and abs(end - begin) <= _SHORT * begin:
        return (first + 4.0 * film.static_force(0.5 * (begin + end)) + last) / 6.0
    total, before = 0.0, first
    for start, stop in pairwise(stops):
        after = last if stop == end else film.static_force(stop)
        width = math.log1p((stop - start) / start)
        gaps = [(start * math.exp(x * width), w) for x, w in _LOBATTO]
        inside = sum(w * gap * film.static_force(gap) for gap, w in gaps)
        total += width * (inside + _EDGE * (start * before + stop * after))
        before = after
    return total / (end - begin)


def _stops(film: Film, begin: float, end: float, widest: float) -> Iterator[float]:
    """Ends of the panels on the way from one gap to another, the last of which is its end."""
    rising = end > begin
    widest = max(widest, abs(math.log(end) - math.log(begin)) / _MOST)
    factor = math.exp(widest if rising else -widest)
    kinks = film.kinks if rising else film.kinks[::-1]
    gap = begin
    while gap != end:
        # Half the distance to the rupture at most, on opening and on closing.
        room = max((0.5 if rising else 1.0) * (film.end - gap), _NEAR * film.end)
        if rising:
            near = min(gap * factor, gap + room, end)
            near = next((kink for kink in kinks if gap < kink < near), near)
        else:
            near = max(gap * factor, gap - room, end)
            near = next((kink for kink in kinks if gap > kink > near), near)
        gap = near if near != gap else end  # among the smallest numbers there is no way between
        yield gap


def _viscous(film: Film, begin: float, end: float, length: float) -> float:
    if not film.limits:
        return film.viscous_impulse(begin, end)
    speed, total = (end - begin) / length, 0.0
    for start, stop, is_limited in _pieces(film, begin, end, speed):
        if is_limited:
            width = math.log1p((stop - start) / start)
            gaps = [(start * math.exp(x * width), w) for x, w in _GAUSS]
            mean = sum(w * gap * film.viscous_force(gap, speed)[0] for gap, w in gaps)
            total += width / speed * mean
        else:
            total += film.viscous_impulse(start, stop)
    return total


def _pieces(
    film: Film, begin: float, end: float, speed: float
) -> Iterator[tuple[float, float, bool]]:
    """Parts of the path with one limit that acts, or none, and whether one does."""

    def acts(gap: float) -> LimitKind:
        return film.viscous_force(gap, speed)[1]

    if speed == 0.0:
        return
    # Rounding must neither add a panel nor keep the way from ending.
    widest = min(0.5 * _WIDEST, abs(math.log(end) - math.log(begin)) / _PANELS + 1e-9)
    gaps = [begin, *_stops(film, begin, end, widest)]
    for (start, before), (stop, after) in pairwise([(gap, acts(gap)) for gap in gaps]):
        if before is after:
            yield start, stop, before is not LimitKind.NONE
            continue
        near = _NEAR_ONSET * abs(stop - start)

        def changed(gap: float, was: LimitKind = before) -> bool:
            return acts(gap) is not was

        onset = first_true(changed, start, stop, atol=near)
        yield start, onset, before is not LimitKind.NONE
        yield onset, stop, after is not LimitKind.NONE
