r"""Force of the exact bridge between flats as a tabulated function of the gap, without numpy.

Conventions and symbols are those of `exact.delaunay`. Between flats a bridge is, up to its size, a
member of a one-parameter family (`family`); the law is a spline through some hundreds of members.
There are two laws:

* *free*: constant volume; lengths are over its cube root;
* *pinned*: the larger contact circle is pinned at the rim of the smaller face; lengths are over
  that radius, and the volume follows.

The splines are in :math:`u = \sqrt{\ln(h_{end}/h)}`, in which the force is smooth also at a fold,
where its slope is infinite. Films thin enough for the circular approximation to be accurate to 1e-8
use it, with a correction proportional to thickness over radius.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from functools import lru_cache
from typing import NamedTuple

from ...numerics.cubic_spline import cubic_spline
from ..arc import flat as arc_flat
from ..arc.shape import refuse_spreading, wetting
from .family import Member, family, last_member
from .sampling import members_along

__all__ = ["FlatLaw", "flat_end", "flat_law"]

# Gap over radius below which the circular approximation is used, whose error is of that order and
# is corrected to its square. 1e-6 to 1e-9 agree to 1e-10, and take 4 % fewer to 1 % more members.
_THIN = 1e-8
# Cosine of two angles that make a cylinder: right angles in radians are off by 6e-17, in degrees by
# as much; other angles have a fold near pi, which the table of a cylinder has not.
_RIGHT_CLOSE = 1e-12


class FlatLaw(NamedTuple):
    """Force and volume of bridges between flats at a gap up to `end`, over the reference length.

    The force is over surface tension and length, the volume over the cube of the length.
    """

    end: float
    force: Callable[[float], float]
    volume: Callable[[float], float]


class FlatEnd(NamedTuple):
    """Maximum gap of a law, over the reference length, and the volume there, over its cube."""

    gap: float
    volume: float


@lru_cache(maxsize=64)
def flat_law(
    angle_lower: float, angle_upper: float, *, pinned: bool = False, rtol: float = 1e-9
) -> FlatLaw:
    """Force law of the exact bridge between flats for two contact angles.

    Parameters
    ----------
    angle_lower, angle_upper : float
        Contact angles [rad], 0 to pi.
    pinned : bool
        Whether the radius of the larger contact circle is constant, instead of the volume.
    rtol : float
        Tolerance of the splines [-], relative to the sum of the force contributions of the two
        principal curvatures.

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
    members = members_along(one, last, measure.depth, measure.columns, measure.thinnest, rtol)
    places, forces, contents = _points(members, measure)
    force, content = cubic_spline(places, forces), cubic_spline(places, contents)
    arc, thin = arc_flat.shape(angle_lower, angle_upper), members[-1]
    floor, power = thin.gap, 1.0 if pinned else 1.5

    def arc_force(gap: float) -> float:
        return float(arc_flat.force(arc, gap, _arc_radius(arc, gap, pinned)))

    def arc_volume(gap: float) -> float:
        return float(arc_flat.volume(arc, gap, _arc_radius(arc, gap, pinned)))

    @lru_cache(maxsize=1)
    def lacks() -> tuple[float, float]:
        """Error of the circular approximation at the floor: scaled force, volume."""
        force = (thin.force - arc_force(floor)) / measure.scale(floor)
        return force, thin.volume / arc_volume(floor) - 1.0

    def law_force(gap: float) -> float:
        if gap < floor:
            return arc_force(gap) + lacks()[0] * measure.scale(gap) * math.pow(gap / floor, power)
        return force(measure.depth(gap))[0] * measure.scale(gap)

    def law_volume(gap: float) -> float:
        if not pinned:
            return 1.0
        if gap < floor:
            return arc_volume(gap) * (1.0 + lacks()[1] * gap / floor)
        return content(measure.depth(gap))[0] * math.pi * gap

    return FlatLaw(last.gap, law_force, law_volume)


@lru_cache(maxsize=64)
def flat_end(angle_lower: float, angle_upper: float, *, pinned: bool = False) -> FlatEnd:
    """Maximum gap of a law and the volume there; arguments as in `flat_law`.

    Examples
    --------
    >>> round(flat_end(math.pi / 2, math.pi / 2).gap ** 3 / math.pi, 12)
    1.0
    """
    refuse_spreading(angle_lower, angle_upper)
    if max(abs(math.cos(angle_lower)), abs(math.cos(angle_upper))) < _RIGHT_CLOSE:
        law = _cylinder(pinned)
        return FlatEnd(law.end, law.volume(law.end))
    last = last_member(angle_lower, angle_upper, pinned)
    return FlatEnd(last.gap, last.volume)


class _Measure(NamedTuple):
    """Independent and dependent variables of the splines."""

    end: float
    cosines: float
    pinned: bool

    # Force over `scale` is of order one from a film to the end, however large the force of the
    # film: a tolerance of its spline is one of the force, relative to its two contributions.

    def depth(self, gap: float) -> float:
        """Spline coordinate of a gap, zero at the end."""
        return math.sqrt(max(math.log(self.end / gap), 0.0))

    def scale(self, gap: float) -> float:
        """Reference force of the splines: sum of the contributions of both curvatures."""
        radius = 1.0 if self.pinned else math.sqrt(1.0 / (math.pi * gap))
        return math.pi * radius * (radius * self.cosines / gap + 1.0)

    def columns(self, member: Member) -> tuple[float, ...]:
        """Values of the splines: scaled force and, if pinned, volume over that of a disc."""
        force = member.force / self.scale(member.gap)
        return (force, member.volume / (math.pi * member.gap)) if self.pinned else (force,)

    @property
    def thinnest(self) -> float:
        """Gap below which the circular approximation is used."""
        return _THIN if self.pinned else (_THIN**2 / math.pi) ** (1.0 / 3.0)


def _arc_radius(arc: arc_flat.ArcShape, gap: float, pinned: bool) -> float:
    if pinned:
        return arc_flat.rim_contact_radius(arc, gap, 1.0)
    return arc_flat.contact_radius(arc, gap, 1.0)


def _cylinder(pinned: bool) -> FlatLaw:
    """Law for two right angles, whose bridges are cylinders: F = pi gamma r, up to h = pi r."""
    if pinned:
        return FlatLaw(math.pi, lambda gap: math.pi, lambda gap: math.pi * gap)
    end = math.pi ** (1.0 / 3.0)
    return FlatLaw(end, lambda gap: math.sqrt(math.pi / gap), lambda gap: 1.0)


def _points(
    members: list[Member], measure: _Measure
) -> tuple[list[float], list[float], list[float]]:
    """Spline coordinates, scaled forces, and volumes over that of a disc."""
    places, good = [0.0], [members[0]]
    for member in members[1:]:
        if member.gap > 0.0 and (place := measure.depth(member.gap)) > places[-1]:
            places.append(place)
            good.append(member)
    return (
        places,
        [m.force / measure.scale(m.gap) for m in good],
        [m.volume / (math.pi * m.gap) for m in good],
    )
