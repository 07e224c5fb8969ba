r"""Capillary condensation on many spheres near a flat: bridges of one pressure.

Lengths in m, force and pressure over the surface tension [m] and [1/m]; conventions as in
`exact.bridge`. The maximum gap of a bridge of given pressure, over the height of a thin meniscus
:math:`h_m = (\cos\theta_1 + \cos\theta_2)/|P|`, depends on the pressure over the curvature of the
sphere only: a table of it excludes the spheres that are too far away, because the limit costs far
more to compute than a bridge.
"""

from __future__ import annotations

import math
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from ..errors import InfeasibleError
from .exact.at_pressure import branch_at_pressure
from .exact.bridge import ExactBridge, bridge_at_pressure

__all__ = ["condensed_bridges", "max_gap_on_sphere"]

Array = NDArray[np.float64]

# Of the maximum gap, by which the table is not trusted: spheres nearer to it are solved. It has to
# exceed the error of the table (with 0 two of 2209 bridges were missed); those just beyond the
# limit are dear, as each is looked for in vain: 0.02 took twice the time.
_MARGIN = 0.005
# Between the entries of the table, in decades of pressure over curvature: an error of 0.15 %,
# against 0.05 % with half and 0.9 % with double the step. An entry takes a tenth of a second.
_DECADES = 0.25


def max_gap_on_sphere(
    pressure: float, angle_lower: float, angle_upper: float, curvature: float
) -> float:
    """Maximum gap [m] of a bridge of given pressure between a sphere and a flat.

    Parameters
    ----------
    pressure : float
        Pressure over the surface tension [1/m], negative.
    angle_lower, angle_upper : float
        Contact angles on flat and sphere [rad].
    curvature : float
        Curvature of the sphere [1/m], positive.

    Raises
    ------
    InfeasibleError
        If no bridge of that pressure is stable even in contact: the liquid immerses the sphere.

    Notes
    -----
    It is 0.56 times the height of a thin meniscus for a radius of 10 Kelvin radii, 0.78 times for
    100, 0.95 times for 10^4; the linear law of Eq. (3.7) overestimates it.

    Examples
    --------
    >>> round(max_gap_on_sphere(-1e3, 0.0, 0.0, 1.0) * 1e3, 4)
    1.7977
    """
    branch = branch_at_pressure(pressure / curvature, angle_lower, angle_upper, 0.0, 1.0)
    return float(branch.gap[-1]) / curvature


def condensed_bridges(
    gap: Array, pressure: float, angle_lower: float, angle_upper: float, curvature: Array
) -> ExactBridge:
    """Bridges of one pressure on many spheres near a flat; nan where the gap is too large.

    Parameters
    ----------
    gap, curvature : ndarray (n,)
        Gap [m] and curvature [1/m] of each sphere.
    pressure : float
        Pressure over the surface tension [1/m], negative.
    angle_lower, angle_upper : float
        Contact angles on flat and spheres [rad]; the sum of their cosines is positive.

    Raises
    ------
    InfeasibleError
        If the liquid immerses a sphere, whose radius is about that of the meniscus.

    Examples
    --------
    >>> found = condensed_bridges(np.array([0.0, 1e-3, 2e-3]), -1e3, 0.0, 0.0, np.ones(3))
    >>> [round(float(f), 4) for f in found.force]
    [12.4095, 6.0617, nan]
    """
    height = -(math.cos(angle_lower) + math.cos(angle_upper)) / pressure
    near = np.flatnonzero(gap < height)
    if near.size and gap[near].max() > 0.5 * height:
        reach = height * _relative_max_gap(-pressure / curvature[near], angle_lower, angle_upper)
        near = near[gap[near] < reach * (1.0 + _MARGIN)]
    columns = [np.full(gap.shape, -1 if name == "kind" else np.nan) for name in ExactBridge._fields]
    if not near.size:
        return ExactBridge(*columns)
    given = (pressure, angle_lower, angle_upper, 0.0, curvature[near])
    try:
        state = bridge_at_pressure(gap[near], *given, beyond="nan")
    except InfeasibleError as error:
        raise _immersed_error(pressure, curvature[near]) from error
    missing = ~np.isfinite(state.force)
    sharpest = curvature[near][missing].max(initial=0.0)
    if sharpest > 0.0:
        max_gap_on_sphere(pressure, angle_lower, angle_upper, float(sharpest))  # or immersed
    for column, value in zip(columns, state, strict=True):
        column[near] = value
    return ExactBridge(*columns)


def _immersed_error(pressure: float, curvature: Array) -> InfeasibleError:
    return InfeasibleError(
        f"a summit of radius {1.0 / curvature.max():.3g} m is immersed in liquid of Kelvin radius "
        f"{-1.0 / pressure:.3g} m: no bridge at it is stable; lower the humidity, or give a film "
        "thickness"
    )


def _relative_max_gap(ratio: Array, angle_lower: float, angle_upper: float) -> Array:
    """Maximum gap over the height of a thin meniscus, for pressures over curvature."""
    # At fixed decades, not between the extremes: entries are cached over calls and angles.
    log = np.log10(ratio)
    low, high = math.floor(log.min() / _DECADES), math.ceil(log.max() / _DECADES)
    nodes = np.arange(low, high + 1) * _DECADES
    known = [_relative_max_gap_at(float(node), angle_lower, angle_upper) for node in nodes]
    return np.asarray(np.interp(log, nodes, known))


@lru_cache(maxsize=256)
def _relative_max_gap_at(log: float, angle_lower: float, angle_upper: float) -> float:
    ratio = 10.0**log
    try:
        reach = max_gap_on_sphere(-ratio, angle_lower, angle_upper, 1.0)
    except InfeasibleError:
        return 1.0  # the bridge itself is solved
    return float(reach * ratio / (math.cos(angle_lower) + math.cos(angle_upper)))
