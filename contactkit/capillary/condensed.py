r"""Many bridges of one pressure on spheres near a flat: which of them stand, and what they pull.

Lengths in m, force and pressure over the surface tension [m] and [1/m]; conventions as in
`bridge_exact`. How far a bridge of a pressure reaches depends, over the height of a thin meniscus
:math:`h_m = (\cos\theta_1 + \cos\theta_2)/|P|`, on the pressure over the curvature of the sphere
only: a table of that sorts out the spheres that are too far away, as to find that out for each
costs far more than to solve it.
"""

from __future__ import annotations

import math
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from ..errors import InfeasibleError
from .exact.at_pressure import branch_at_pressure
from .exact.bridge import ExactBridge, bridge_at_pressure

__all__ = ["condensed_bridges", "reach_at_pressure"]

Array = NDArray[np.float64]

_MARGIN = 0.005  # of the reach: nearer to it the bridge itself decides
_DECADES = 0.25  # between the entries of the table, which errs by 0.2 % at most


def reach_at_pressure(
    pressure: float, angle_lower: float, angle_upper: float, curvature: float
) -> float:
    """Largest gap [m] between a sphere and a flat that a bridge of a pressure spans.

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
        If no bridge of that pressure holds even in contact: the liquid drowns the sphere.

    Notes
    -----
    Of the height of a thin meniscus it is 0.56 for a radius of 10 Kelvin radii, 0.78 for 100, 0.95
    for 10^4: the linear law of Eq. (3.7) reaches too far.

    Examples
    --------
    >>> round(reach_at_pressure(-1e3, 0.0, 0.0, 1.0) * 1e3, 4)
    1.7977
    """
    branch = branch_at_pressure(pressure / curvature, angle_lower, angle_upper, 0.0, 1.0)
    return float(branch.gap[-1]) / curvature


def condensed_bridges(
    gap: Array, pressure: float, angle_lower: float, angle_upper: float, curvature: Array
) -> ExactBridge:
    """Bridges of one pressure on many spheres near a flat; nan where the gap is too wide.

    Parameters
    ----------
    gap, curvature : ndarray (n,)
        Gap [m] and curvature [1/m] of each sphere.
    pressure : float
        Pressure over the surface tension [1/m], negative.
    angle_lower, angle_upper : float
        Contact angles on flat and spheres [rad], their cosines of a positive sum.

    Raises
    ------
    InfeasibleError
        If the liquid drowns a sphere: it is about as sharp as the meniscus is.

    Examples
    --------
    >>> found = condensed_bridges(np.array([0.0, 1e-3, 2e-3]), -1e3, 0.0, 0.0, np.ones(3))
    >>> [round(float(f), 4) for f in found.force]
    [12.4095, 6.0617, nan]
    """
    height = -(math.cos(angle_lower) + math.cos(angle_upper)) / pressure
    near = np.flatnonzero(gap < height)
    if near.size and gap[near].max() > 0.5 * height:
        reach = height * _share(-pressure / curvature[near], angle_lower, angle_upper)
        near = near[gap[near] < reach * (1.0 + _MARGIN)]
    columns = [np.full(gap.shape, -1 if name == "kind" else np.nan) for name in ExactBridge._fields]
    if not near.size:
        return ExactBridge(*columns)
    given = (pressure, angle_lower, angle_upper, 0.0, curvature[near])
    try:
        state = bridge_at_pressure(gap[near], *given, beyond="nan")
    except InfeasibleError as error:
        raise _drowned(pressure, curvature[near]) from error
    missing = ~np.isfinite(state.force)
    sharpest = curvature[near][missing].max(initial=0.0)
    if sharpest > 0.0:
        reach_at_pressure(pressure, angle_lower, angle_upper, float(sharpest))  # or drowned
    for column, value in zip(columns, state, strict=True):
        column[near] = value
    return ExactBridge(*columns)


def _drowned(pressure: float, curvature: Array) -> InfeasibleError:
    return InfeasibleError(
        f"a summit of a radius of {1.0 / curvature.max():.3g} m drowns in liquid of a Kelvin "
        f"radius of {-1.0 / pressure:.3g} m, of which no ring around it is stable; lower the "
        "humidity, or give a film thickness"
    )


def _share(ratio: Array, angle_lower: float, angle_upper: float) -> Array:
    """Reach over the height of a thin meniscus, for pressures over curvature."""
    log = np.log10(ratio)
    low, high = math.floor(log.min() / _DECADES), math.ceil(log.max() / _DECADES)
    nodes = np.arange(low, high + 1) * _DECADES
    known = [_share_at(float(node), angle_lower, angle_upper) for node in nodes]
    return np.asarray(np.interp(log, nodes, known))


@lru_cache(maxsize=256)
def _share_at(log: float, angle_lower: float, angle_upper: float) -> float:
    ratio = 10.0**log
    try:
        reach = reach_at_pressure(-ratio, angle_lower, angle_upper, 1.0)
    except InfeasibleError:
        return 1.0  # the bridge itself decides
    return float(reach * ratio / (math.cos(angle_lower) + math.cos(angle_upper)))
