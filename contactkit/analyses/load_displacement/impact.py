r"""A body that meets an end stop: the stop in series with the bodies behind it, and one blow.

.. math:: D = d + F(d)/K, \qquad
          \tfrac12 m v^2 = \int_0^{d_m} F\,dd + \frac{F(d_m)^2}{2K}, \qquad
          e^2 = \frac{\text{what comes back}}{\tfrac12 m v^2}

D is the approach of points behind the bodies, d that of the rough faces, K the stiffness of the
bodies. Plain floats: this also runs inside an FMU.
"""

from __future__ import annotations

import math
from itertools import pairwise
from typing import NamedTuple

from ...errors import DescriptionError, InfeasibleError
from ...numerics.roots import bracketed_root, newton_root
from .curve import LoadDisplacementCurve, StopPoint, area_below

__all__ = ["StopImpact", "impact", "in_series"]

_CLOSE = 1e-13


class StopImpact(NamedTuple):
    """A blow: largest approach of the faces [m], force [N], work lost [J], restitution [-]."""

    approach: float
    force: float
    lost: float
    restitution: float


def in_series(
    curve: LoadDisplacementCurve,
    approach: float,
    largest: float,
    stiffness: float,
    *,
    beyond: bool = False,
    near: float = 0.0,
) -> tuple[StopPoint, float]:
    """Point of a stop with a spring behind it, and the approach of the faces [m].

    Parameters
    ----------
    curve : LoadDisplacementCurve
        The faces.
    approach : float
        Approach of faces and spring together, from first touch [m].
    largest : float
        Largest approach the faces have had [m].
    stiffness : float
        Stiffness of the spring behind them [N/m]; 0: rigid.
    beyond : bool
        See `LoadDisplacementCurve.at`.
    near : float
        Approach of the faces not long ago, to begin with [m]; 0: unknown.

    Returns
    -------
    StopPoint
        Its stiffness is that of both together.
    float
        Approach of the faces.

    Raises
    ------
    InfeasibleError, DescriptionError
        See `LoadDisplacementCurve.at`; a stiffness that is negative or not finite.

    Examples
    --------
    >>> from contactkit.analyses.load_displacement.curve import LoadDisplacementCurve
    >>> faces = LoadDisplacementCurve(
    ...     approach=(1e-7, 2e-7), force=(1.0, 3.0), contact_area=(1e-12, 2e-12),
    ...     plastic_area=(0.0, 0.0), elastic_limit=2e-7, nominal_area=1e-8)
    >>> point, approach = in_series(faces, 2e-7, 0.0, 1e7)
    >>> round(point.force, 3), round((approach + point.force / 1e7) * 1e9, 9)
    (1.0, 200.0)
    """
    if not (math.isfinite(stiffness) and stiffness >= 0.0):
        expected = "be zero or positive, and finite"
        raise DescriptionError("in_series(stiffness)", stiffness, expected, unit="N/m")
    if stiffness == 0.0 or not approach > 0.0:
        return curve.at(approach, largest, beyond=beyond), approach
    faces = _shared(curve, approach, largest, stiffness, near if near > 0.0 else curve.most)
    point = curve.at(faces, largest, beyond=beyond)
    both = point.stiffness * stiffness / (point.stiffness + stiffness)
    return point._replace(stiffness=both), faces


def _shared(
    curve: LoadDisplacementCurve, approach: float, largest: float, stiffness: float, near: float
) -> float:
    """Approach of the faces: what they and the spring share rises with it, so Newton, bracketed."""

    def excess(faces: float) -> tuple[float, float]:
        force, slope = curve.force_at(faces, largest)
        return faces + force / stiffness - approach, 1.0 + slope / stiffness

    return newton_root(excess, 0.0, approach, near if near < approach else 0.5 * approach, _CLOSE)


def impact(
    curve: LoadDisplacementCurve,
    mass: float,
    speed: float,
    *,
    largest: float = 0.0,
    stiffness: float = 0.0,
) -> StopImpact:
    """One blow of a free mass on a stop, by its energy.

    Parameters
    ----------
    curve : LoadDisplacementCurve
        The faces.
    mass, speed : float
        What arrives [kg], and how fast [m/s].
    largest : float
        Largest approach the faces have had before [m].
    stiffness : float
        Stiffness of the bodies behind the faces [N/m]; 0: rigid.

    Raises
    ------
    InfeasibleError
        If the tables end before the mass is at rest.
    DescriptionError
        If a number is impossible.

    Notes
    -----
    Lost is what plasticity takes; waves that run away in the bodies, the liquid and friction are
    left out, so the restitution is an upper bound. What presses the mass on the way, such as a
    magnet, is left out too.

    Examples
    --------
    An elastic stop gives back everything:

    >>> from contactkit.analyses.load_displacement.curve import LoadDisplacementCurve
    >>> faces = LoadDisplacementCurve(
    ...     approach=(1e-7, 2e-7), force=(1.0, 2.0**1.5), contact_area=(1e-12,) * 2,
    ...     plastic_area=(0.0, 0.0), elastic_limit=2e-7, nominal_area=1e-8)
    >>> blow = impact(faces, 1e-3, 0.01)
    >>> f"{blow.force:.4f} N", blow.restitution
    ('1.1433 N', 1.0)
    """
    for name, value in (("mass", mass), ("speed", speed)):
        if not (math.isfinite(value) and value > 0.0):
            raise DescriptionError(f"impact({name})", value, "be positive and finite")
    energy, begun = 0.5 * mass * speed * speed, min(max(largest, 0.0), curve.most)
    spent = curve.lost(begun)  # what earlier blows have taken, this one need not bring

    def left(approach: float) -> float:
        force = curve.at(approach).force
        bent = 0.5 * force * force / stiffness if stiffness else 0.0
        return curve.work(approach) - spent + bent - energy

    if left(curve.most) < 0.0:
        raise InfeasibleError(
            f"{energy:.4g} J bring the faces beyond {curve.most:.4g} m and {curve.force[-1]:.4g} "
            "N, where the tables end; make them with larger loads"
        )
    if left(begun) >= 0.0:
        approach, force = _within(curve, energy, begun, stiffness)
        return StopImpact(approach, force, 0.0, 1.0)
    approach = bracketed_root(left, begun, curve.most, 1e-13)
    lost = curve.lost(approach) - spent
    force = curve.at(approach).force
    return StopImpact(approach, force, lost, math.sqrt(max(1.0 - lost / energy, 0.0)))


def _within(
    curve: LoadDisplacementCurve, energy: float, largest: float, stiffness: float
) -> tuple[float, float]:
    """Where a blow ends that stays on the way of an earlier one, by integrating that way."""
    begin = curve.residual(largest)
    length = largest - begin

    def left(way: float) -> float:
        force = curve.at(begin + way * length, largest).force
        edges = [way * 2.0**-i for i in range(40, -1, -1)]
        share = sum(
            area_below(lambda w: curve.force_at(begin + w * length, largest), a, b)
            for a, b in pairwise(edges)
        )
        bent = 0.5 * force * force / stiffness if stiffness else 0.0
        return share * length + bent - energy

    way = 1.0 if left(1.0) <= 0.0 else bracketed_root(left, 1e-9, 1.0, 1e-10)
    approach = begin + way * length
    return approach, curve.at(approach, largest).force
