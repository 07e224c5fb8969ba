"""What a film gives while it is drawn from one gap to another: impulses, and when it breaks.

The viscous impulse of a film without limits does not depend on the way, so it is exact between
any two gaps, however long the step. Where a limit of the liquid acts, the way matters: the gap is
taken to move at its mean speed, which leaves out O(H^3) of the impulse of a step of length H.
"""

from __future__ import annotations

from collections.abc import Iterator
from itertools import pairwise
from typing import NamedTuple

from ..effects import ViscousForce
from ..plan import Film

__all__ = ["Travel", "travel"]

_PANELS = 4
_GAUSS = ((0.1127016653792583, 5 / 18), (0.5, 8 / 18), (0.8872983346207417, 5 / 18))


class Travel(NamedTuple):
    """Viscous and other impulse [N.s], and the share of the step after which the film is broken.

    `broken` is 1 if it is not; `last` is the static force at the end [N].
    """

    viscous: float
    static: float
    broken: float
    last: float = 0.0


def travel(
    film: Film, begin: float, end: float, length: float, first: float | None = None
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
    """
    share = 1.0
    if end > film.end:
        share = (film.end - begin) / (end - begin)
        end, length = film.end, length * share
    first = film.static_force(begin) if first is None else first
    middle = film.static_force(0.5 * (begin + end))
    last = film.static_force(end)
    static = length * (first + 4.0 * middle + last) / 6.0
    return Travel(_viscous(film, begin, end, length), static, share, last)


def _viscous(film: Film, begin: float, end: float, length: float) -> float:
    law = film.laws.get(ViscousForce)
    if law is None:
        return 0.0
    assert law.impulse is not None  # a viscous force always has one
    if not film.limits:
        return law.impulse(begin, end)
    speed, total = (end - begin) / length, 0.0
    for start, stop, is_limited in _pieces(film, begin, end, speed):
        if is_limited:
            time = (stop - start) / speed
            forces = (film.viscous_force(start + x * (stop - start), speed)[0] for x, _ in _GAUSS)
            total += time * sum(w * f for (_, w), f in zip(_GAUSS, forces, strict=True))
        else:
            total += law.impulse(start, stop)
    return total


def _pieces(
    film: Film, begin: float, end: float, speed: float
) -> Iterator[tuple[float, float, bool]]:
    """Parts of the way, evenly in ln h, and whether a limit acts in each."""

    def acts(gap: float) -> bool:
        return film.viscous_force(gap, speed)[1] is not None

    if speed == 0.0:
        return
    factor = (end / begin) ** (1.0 / _PANELS)
    gaps = [begin * factor**i for i in range(_PANELS)] + [end]
    for (start, before), (stop, after) in pairwise([(gap, acts(gap)) for gap in gaps]):
        if before is after:
            yield start, stop, before
            continue
        low, high = start, stop
        for _ in range(14):  # the force is smooth to first order there: little is left out
            middle = 0.5 * (low + high)
            if acts(middle) is before:
                low = middle
            else:
                high = middle
        yield start, high, before
        yield high, stop, after
