r"""The force of the exact bridge between flats as a law of the gap, without numpy, made once.

Conventions and symbols are those of `delaunay`. Between flats a bridge is, but for its size, one
of a family of one parameter, in which everything is explicit; a law is a spline through some
hundreds of members of the family. Two laws serve two kinds of film:

* *free*: of constant volume; lengths are over its cube root;
* *pinned*: held by the rim of the smaller face, which its larger contact circle has reached;
  lengths are over that radius, and the volume follows.

The splines are in :math:`u = \sqrt{\ln(h_{end}/h)}`, in which a force that ends in a fold, with
an infinite slope, is smooth as well. A film so thin that the arc of a circle has no error above
1e-9 left is taken for that arc.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from functools import lru_cache
from typing import NamedTuple

from . import arc_flat
from .arc_shape import refuse_spreading, wetting
from .flat_family import Member, family, last_member
from .spline import cubic_spline

__all__ = ["FlatLaw", "flat_end", "flat_law"]

_THIN = 1e-8  # gap over radius below which a film is taken for its arc
_LEAST, _MOST = 64, 2048  # members of the family along a law
_FAR = 500.0  # chart coordinate of a film thinner than any
_RIGHT_CLOSE = 1e-12  # cosine of two angles that make a cylinder


class FlatLaw(NamedTuple):
    """Force and volume of bridges between flats at a gap up to `end`, lengths over the law's.

    The force is over surface tension and length, the volume over the cube of length.
    """

    end: float
    force: Callable[[float], float]
    volume: Callable[[float], float]


@lru_cache(maxsize=64)
def flat_law(
    angle_lower: float, angle_upper: float, *, pinned: bool = False, rtol: float = 1e-9
) -> FlatLaw:
    """Law of the exact bridge between flats, for two contact angles [rad].

    Parameters
    ----------
    angle_lower, angle_upper : float
        Contact angles [rad], 0 to pi.
    pinned : bool
        Whether the larger contact circle keeps its radius, rather than the bridge its volume.
    rtol : float
        Error allowed to the splines [-], relative to what the curvatures of the rim, taken one by
        one, would pull.

    Raises
    ------
    InfeasibleError
        If one body is wetted fully and the other not at all: such a liquid spreads.

    Examples
    --------
    >>> law = flat_law(math.pi / 3, math.pi / 3)
    >>> round(law.end, 4), round(law.force(0.02), 3)
    (1.4205, 2511.989)
    """
    refuse_spreading(angle_lower, angle_upper)
    if max(abs(math.cos(angle_lower)), abs(math.cos(angle_upper))) < _RIGHT_CLOSE:
        return _cylinder(pinned)
    one = family(angle_lower, angle_upper, pinned)
    last = last_member(angle_lower, angle_upper, pinned)
    measure = _Measure(last.gap, abs(wetting(angle_lower, angle_upper)), pinned)
    members = _enough(one, last, measure, rtol)
    force, content = _curves(members, measure)
    arc, floor = arc_flat.shape(angle_lower, angle_upper), members[-1].gap

    def law_force(gap: float) -> float:
        if gap < floor:
            return float(arc_flat.force(arc, gap, _arc_radius(arc, gap, pinned)))
        return force(measure.depth(gap))[0] * measure.scale(gap)

    def law_volume(gap: float) -> float:
        if not pinned:
            return 1.0
        if gap < floor:
            return float(arc_flat.volume(arc, gap, _arc_radius(arc, gap, pinned)))
        return content(measure.depth(gap))[0] * math.pi * gap

    return FlatLaw(last.gap, law_force, law_volume)


@lru_cache(maxsize=64)
def flat_end(
    angle_lower: float, angle_upper: float, *, pinned: bool = False
) -> tuple[float, float]:
    """Largest gap of a law and the volume there, without the law; arguments as in `flat_law`.

    Examples
    --------
    >>> round(flat_end(math.pi / 2, math.pi / 2)[0] ** 3 / math.pi, 12)
    1.0
    """
    refuse_spreading(angle_lower, angle_upper)
    if max(abs(math.cos(angle_lower)), abs(math.cos(angle_upper))) < _RIGHT_CLOSE:
        law = _cylinder(pinned)
        return law.end, law.volume(law.end)
    last = last_member(angle_lower, angle_upper, pinned)
    return last.gap, last.volume


class _Measure(NamedTuple):
    """What the splines run along and what they are of."""

    end: float
    cosines: float
    pinned: bool

    def depth(self, gap: float) -> float:
        """Place of a gap along the splines, zero at the end."""
        return math.sqrt(max(math.log(self.end / gap), 0.0))

    def scale(self, gap: float) -> float:
        """Force that the splines are relative to: that of both curvatures, one by one."""
        radius = 1.0 if self.pinned else math.sqrt(1.0 / (math.pi * gap))
        return math.pi * radius * (radius * self.cosines / gap + 1.0)

    @property
    def thinnest(self) -> float:
        """Gap below which a film is an arc."""
        return _THIN if self.pinned else (_THIN**2 / math.pi) ** (1.0 / 3.0)


def _enough(
    one: Callable[[float], Member], last: Member, measure: _Measure, rtol: float
) -> list[Member]:
    """Members through which splines are as good as asked for."""
    count, whole = _LEAST, measure.depth(measure.thinnest)
    members = _spread(one, last, measure, whole / count)
    while True:
        curve, _ = _curves(members, measure)
        count *= 2
        finer = _spread(one, last, measure, whole / count)
        error = max(
            abs(curve(measure.depth(m.gap))[0] - m.force / measure.scale(m.gap)) for m in finer
        )
        members = finer
        if error <= 8.0 * rtol or count >= _MOST:  # the finer ones err sixteen times less
            return members


def _arc_radius(arc: arc_flat.ArcShape, gap: float, pinned: bool) -> float:
    if pinned:
        return arc_flat.rim_contact_radius(arc, gap, 1.0)
    return arc_flat.contact_radius(arc, gap, 1.0)


def _cylinder(pinned: bool) -> FlatLaw:
    """Law for two right angles, whose bridges are cylinders: F = pi gamma r, up to h = pi r."""
    if pinned:
        return FlatLaw(math.pi, lambda gap: math.pi, lambda gap: math.pi * gap)
    return FlatLaw(math.pi ** (1.0 / 3.0), lambda gap: math.sqrt(math.pi / gap), lambda gap: 1.0)


def _spread(
    one: Callable[[float], Member],
    last: Member,
    measure: _Measure,
    distance: float,
) -> list[Member]:
    """Members from the longest to a thin one, at most a distance of depth apart."""
    far, step = last, 1.0
    while far.gap > measure.thinnest and far.chart < _FAR:
        far = one(last.chart + step)
        step *= 2.0
    found, waiting = [last], [far]
    while waiting:
        here, there = found[-1], waiting[-1]
        middle = 0.5 * (here.chart + there.chart)
        between = here.chart < middle < there.chart
        near = there.gap > 0.0 and measure.depth(there.gap) <= measure.depth(here.gap) + distance
        if between and not near:
            waiting.append(one(middle))
            continue
        found.append(waiting.pop())
        if found[-1].gap <= measure.thinnest:
            break
    return found


def _curves(
    members: list[Member], measure: _Measure
) -> tuple[Callable[[float], tuple[float, float]], Callable[[float], tuple[float, float]]]:
    """Splines of the scaled force, and of the volume over that of a disc, in the depth."""
    places, good = [0.0], [members[0]]
    for member in members[1:]:
        if member.gap > 0.0 and (place := measure.depth(member.gap)) > places[-1]:
            places.append(place)
            good.append(member)
    return (
        cubic_spline(places, [m.force / measure.scale(m.gap) for m in good]),
        cubic_spline(places, [m.volume / (math.pi * m.gap) for m in good]),
    )
