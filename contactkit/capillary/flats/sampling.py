r"""Adaptive sampling of the family of bridges between flats for a spline.

A force may end smoothly, in a fold, or where a contact circle shrinks to a point: there it vanishes
like :math:`\delta / \ln\delta` with the remaining distance :math:`\delta`, which uniform steps do
not resolve. Members are added where the spline misses the member half way between two knots, in
value or in slope.
"""

from __future__ import annotations

from collections.abc import Callable

from ...numerics.cubic_spline import cubic_spline
from .family import Member

__all__ = ["members_along"]

# Initial number of members. 16 to 128 end with 6300 to 7500 members in twelve laws and the same
# errors; fewer might pass over a bend between two of them, more are members that nothing asked for.
_COARSE = 64
# Chart coordinate of a film thinner than any other, to end the search for a thin one: no law came
# near it, as 100 to 1000 take the same members.
_FAR = 500.0
# Tolerance of a slope over that of a value. Twelve laws have 6600 members at 30, 13 100 at 3, 3800
# at 1000, where values are off by twice as much: slopes are what Newton's method of a motion reads.
_SLOPES = 30.0
# Round-off of the logarithm of the gap: a steep force inherits it, and no member reduces it. It
# only matters for tolerances below 1e-11; at 1e-9, 0 to 2e-15 take the same members.
_ROUNDING = 5e-16
# Members; what is still missed is noise. 400 to 900 are the rule, 1100 at a detachment.
_MAX_MEMBERS = 20_000

Place = Callable[[float], float]
Columns = Callable[[Member], tuple[float, ...]]


def members_along(
    one: Callable[[float], Member],
    last: Member,
    depth: Place,
    columns: Columns,
    thinnest: float,
    rtol: float,
) -> list[Member]:
    """Members from the maximum gap down to one no thicker than `thinnest`, for splines in depth.

    Parameters
    ----------
    one : callable
        Member as a function of the chart coordinate.
    last : Member
        Member of maximum gap.
    depth : callable
        Spline coordinate of a gap, zero at the maximum.
    columns : callable
        Values to interpolate, of order one.
    thinnest : float
        Gap, over the reference length of the family.
    rtol : float
        Tolerance of the splines [-].
    """
    found = _spread(one, last, depth, thinnest, depth(thinnest) / _COARSE)
    wanted = [True] * (len(found) - 1)
    while any(wanted) and len(found) < _MAX_MEMBERS:
        found, missed = _halved(one, found, wanted, depth, columns, rtol)
        # An error may vanish at a midpoint by chance, but not in two adjacent intervals.
        wanted = [any(missed[max(i - 1, 0) : i + 2]) for i in range(len(missed))]
    return found


def _spread(
    one: Callable[[float], Member], last: Member, depth: Place, thinnest: float, distance: float
) -> list[Member]:
    """Members from the maximum gap to a thin one, at most a given depth apart."""
    far, step = last, 1.0
    while far.gap > thinnest and far.chart < _FAR:
        far = one(last.chart + step)
        step *= 2.0
    found, waiting = [last], [far]
    while waiting:
        here, there = found[-1], waiting[-1]
        middle = 0.5 * (here.chart + there.chart)
        between = here.chart < middle < there.chart
        near = there.gap > 0.0 and depth(there.gap) <= depth(here.gap) + distance
        if between and not near:
            waiting.append(one(middle))
            continue
        there = waiting.pop()
        if there.gap > 0.0 and depth(there.gap) > depth(here.gap):
            found.append(there)
        if there.gap <= thinnest:
            break
    return found


def _halved(
    one: Callable[[float], Member],
    found: list[Member],
    wanted: list[bool],
    depth: Place,
    columns: Columns,
    rtol: float,
) -> tuple[list[Member], list[bool]]:
    """Members with midpoints added where wanted, and the intervals where the spline misses them."""
    places = [depth(member.gap) for member in found]
    values = zip(*(columns(member) for member in found), strict=True)
    curves = [cubic_spline(places, column) for column in values]
    result, missed = [found[0]], []
    for i in range(len(wanted)):
        low, high = places[i : i + 2]
        if wanted[i]:
            middle = one(0.5 * (found[i].chart + found[i + 1].chart))
            place = depth(middle.gap) if middle.gap > 0.0 else low
            if low < place < high:
                width = high - low
                exact = columns(middle)
                miss = _misses(*curves[0](place), exact[0], place, width, rtol) or any(
                    abs(curve(place)[0] - y) > 8.0 * rtol * max(abs(y), 1.0)
                    for curve, y in zip(curves[1:], exact[1:], strict=True)
                )
                result.append(middle)
                missed.append(miss)
                missed.append(miss)
                result.append(found[i + 1])
                continue
        result.append(found[i + 1])
        missed.append(False)
    return result, missed


def _misses(
    value: float, slope: float, exact: float, place: float, width: float, rtol: float
) -> bool:
    """Whether a spline misses the midpoint of an interval, in value or in slope."""
    # Halving reduces the error of values by 16, that of slopes by 8.
    fine = rtol * min(8.0, _SLOPES * width * (abs(slope) + place * abs(value)))
    noise = _ROUNDING * (abs(slope) / place + 1.0)
    return abs(value - exact) > max(fine, noise)
