r"""Impact on a rough contact, and the contact in series with the compliance of its bodies.

.. math:: D = d + F(d)/K, \qquad
          \tfrac12 m v^2 = \int_0^{d_m} F\,dd + \frac{F(d_m)^2}{2K}, \qquad
          e^2 = \frac{\text{elastic work}}{\tfrac12 m v^2}

D is the approach of points behind the bodies, d that of the rough faces, K the stiffness of the
bodies. In floats, without numpy: this also runs inside an FMU.
"""

from __future__ import annotations

import math
from itertools import pairwise
from typing import NamedTuple

from ...errors import DescriptionError, InfeasibleError
from ...numerics.roots import bracketed_root, newton_root
from .curve import CurvePoint, LoadDisplacementCurve, area_below

__all__ = ["Impact", "SeriesPoint", "impact", "in_series"]

_CLOSE = 1e-13  # of the approach: curves through solved points have no more digits


class Impact(NamedTuple):
    """Maximum approach of the faces [m], force [N], dissipated work [J], restitution [-]."""

    approach: float
    force: float
    dissipated_work: float
    restitution: float


class SeriesPoint(NamedTuple):
    """Point of a contact with a spring in series, and the approach of its faces [m].

    The stiffness of the point is that of both together.
    """

    point: CurvePoint
    faces: float


def in_series(
    curve: LoadDisplacementCurve,
    approach: float,
    max_approach: float,
    stiffness: float,
    *,
    beyond: bool = False,
    near: float = 0.0,
) -> SeriesPoint:
    """Point of a contact with a spring in series.

    Parameters
    ----------
    curve : LoadDisplacementCurve
        The faces.
    approach : float
        Approach of faces and spring together, from first touch [m].
    max_approach : float
        Maximum approach the faces have had [m].
    stiffness : float
        Stiffness of the spring behind them [N/m]; 0: rigid.
    beyond : bool
        See `LoadDisplacementCurve.at`.
    near : float
        Initial guess of the approach of the faces [m]; 0: unknown.

    Returns
    -------
    SeriesPoint
        Force, stiffness and areas, and the approach of the faces.

    Raises
    ------
    InfeasibleError, DescriptionError
        As `LoadDisplacementCurve.at`; for a stiffness that is negative or not finite.

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
        return SeriesPoint(curve.at(approach, max_approach, beyond=beyond), approach)
    faces = _faces(
        curve, approach, max_approach, stiffness, near if near > 0.0 else curve.max_approach
    )
    point = curve.at(faces, max_approach, beyond=beyond)
    both = point.stiffness * stiffness / (point.stiffness + stiffness)
    return SeriesPoint(point._replace(stiffness=both), faces)


def _faces(
    curve: LoadDisplacementCurve,
    approach: float,
    max_approach: float,
    stiffness: float,
    near: float,
) -> float:
    """Approach of the faces by bracketed Newton iterations: the sum of both rises with it."""

    def excess(faces: float) -> tuple[float, float]:
        at = curve.force_at(faces, max_approach)
        return faces + at.force / stiffness - approach, 1.0 + at.stiffness / stiffness

    return newton_root(excess, 0.0, approach, near if near < approach else 0.5 * approach, _CLOSE)


def impact(
    curve: LoadDisplacementCurve,
    mass: float,
    speed: float,
    *,
    max_approach: float = 0.0,
    stiffness: float = 0.0,
) -> Impact:
    """Impact of a free mass on a contact, by its energy.

    Parameters
    ----------
    curve : LoadDisplacementCurve
        The faces.
    mass, speed : float
        Mass [kg] and its speed before the impact [m/s].
    max_approach : float
        Maximum approach the faces have had before [m].
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
    Only plastic work is dissipated; elastic waves in the bodies, the liquid and friction are left
    out, so the restitution is an upper bound. Forces on the mass during the impact, such as that
    of a magnet, are left out too.

    Examples
    --------
    An elastic contact dissipates nothing:

    >>> from contactkit.analyses.load_displacement.curve import LoadDisplacementCurve
    >>> faces = LoadDisplacementCurve(
    ...     approach=(1e-7, 2e-7), force=(1.0, 2.0**1.5), contact_area=(1e-12,) * 2,
    ...     plastic_area=(0.0, 0.0), elastic_limit=2e-7, nominal_area=1e-8)
    >>> first = impact(faces, 1e-3, 0.01)
    >>> f"{first.force:.4f} N", first.restitution
    ('1.1433 N', 1.0)
    """
    for name, value in (("mass", mass), ("speed", speed)):
        if not (math.isfinite(value) and value > 0.0):
            raise DescriptionError(f"impact({name})", value, "be positive and finite")
    energy, begun = 0.5 * mass * speed * speed, min(max(max_approach, 0.0), curve.max_approach)
    before = curve.dissipated_work(begun)  # by earlier impacts

    def excess(approach: float) -> float:
        force = curve.at(approach).force
        bending = 0.5 * force * force / stiffness if stiffness else 0.0
        return curve.work(approach) - before + bending - energy

    if excess(curve.max_approach) < 0.0:
        raise InfeasibleError(
            f"{energy:.4g} J press the faces beyond {curve.max_approach:.4g} m and "
            f"{curve.force[-1]:.4g} N, where the tables end; make them with larger loads"
        )
    if excess(begun) >= 0.0:
        approach, force = _within(curve, energy, begun, stiffness)
        return Impact(approach, force, 0.0, 1.0)
    approach = bracketed_root(excess, begun, curve.max_approach, 1e-13)
    dissipated = curve.dissipated_work(approach) - before
    force = curve.at(approach).force
    restitution = math.sqrt(max(1.0 - dissipated / energy, 0.0))
    return Impact(approach, force, dissipated, restitution)


def _within(
    curve: LoadDisplacementCurve, energy: float, max_approach: float, stiffness: float
) -> tuple[float, float]:
    """Maximum approach and force of an impact on the unloading curve of an earlier one."""
    begin = curve.residual(max_approach)
    length = max_approach - begin

    def excess(fraction: float) -> float:
        force = curve.at(begin + fraction * length, max_approach).force
        edges = [fraction * 2.0**-i for i in range(40, -1, -1)]
        area = sum(
            area_below(lambda x: curve.force_at(begin + x * length, max_approach), a, b)
            for a, b in pairwise(edges)
        )
        bending = 0.5 * force * force / stiffness if stiffness else 0.0
        return area * length + bending - energy

    fraction = 1.0 if excess(1.0) <= 0.0 else bracketed_root(excess, 1e-9, 1.0, 1e-10)
    approach = begin + fraction * length
    return approach, curve.at(approach, max_approach).force
