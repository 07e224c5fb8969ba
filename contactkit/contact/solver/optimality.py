"""Optimality (KKT) conditions of the contact problem: residual and duality gap of any pressure.

Sign convention: pressure, heights and displacement positive into the solid; the reduced gap is
``g = u - h`` and the gap itself is ``g - approach``.

========  ============================================================
symbol    meaning
========  ============================================================
p         pressure of a pixel, ``0 <= p <= bound``
g         displacement minus height: the gap but for the rigid approach
approach  rigid-body approach, ``g = approach`` on free pixels
========  ============================================================
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

__all__ = ["ROUNDED", "Optimality", "free_approach", "height_scale", "optimality", "scale_of"]

Floats = NDArray[np.float64]
ROUNDED = 4.0 * float(np.finfo(np.float64).eps)  # rms over largest height: nothing but round-off
FINEST = 1e-6  # of the displacement: smaller lengths are lost in its round-off at a rtol of 1e-8


class Optimality(NamedTuple):
    """Optimality of a pressure map.

    approach : rigid-body approach of the zero plane of the heights [m]
    residual : largest violation of a contact condition over the map [m]
    energy_gap : bound of the energy above the minimum, per pixel area [J/m^2]
    """

    approach: float
    residual: float
    energy_gap: float


def height_scale(heights: Floats, displacement: Floats, flat: float = 0.0) -> float:
    """Length that relative residuals refer to [m].

    The rms of the heights about their mean, or the largest displacement if that is smaller (a ball
    on a wide map); never below 1e-4 of the rms or 1e-6 of the displacement, where round-off would
    decide. For flat heights, whose rms is round-off itself, the largest displacement, but at least
    `flat`.

    Parameters
    ----------
    heights, displacement : ndarray (ny, nx)
        [m]
    flat : float
        Displacement of a single pixel under the mean pressure [m].

    Examples
    --------
    >>> height_scale(np.array([[1.0, -1.0]]), np.array([[0.1, -5.0]]))
    1.0
    """
    rms = float(np.std(heights))
    largest = float(max(displacement.max(), -displacement.min()))
    is_flat = rms <= ROUNDED * float(np.abs(heights).max(initial=0.0))
    return scale_of(0.0 if is_flat else rms, largest, flat)


def scale_of(rms: float, largest: float, flat: float) -> float:
    """`height_scale` of an rms height, zero if flat, and the largest displacement [m].

    Examples
    --------
    >>> scale_of(1.0, 5.0, 0.0), scale_of(0.0, 5.0, 0.0)
    (1.0, 5.0)
    """
    if rms <= 0.0:
        return max(largest, flat)
    return max(min(rms, largest), 1e-4 * rms, FINEST * max(largest, flat))


def free_approach(pressure: Floats, reduced_gap: Floats, bound: float | Floats) -> float:
    """Rigid-body approach that suits a pressure map best [m].

    The pressure-weighted mean of `reduced_gap` over the free pixels, between both bounds. If there
    is none, any value between the largest over the pixels at the upper bound and the smallest over
    those out of contact will do, and the middle is taken.

    Parameters
    ----------
    pressure : ndarray
        [Pa]
    reduced_gap : ndarray
        Displacement minus height [m].
    bound : float or ndarray
        Upper bound of the pressure [Pa], ``inf`` for none.

    Examples
    --------
    >>> free_approach(np.array([0.0, 1.0, 3.0]), np.array([9.0, 1.0, 2.0]), np.inf)
    1.75
    """
    free = (pressure > 0.0) & (pressure < bound)
    weight = pressure[free]
    if weight.size:
        return float(weight @ reduced_gap[free] / weight.sum())
    at_bound = reduced_gap[(pressure > 0.0) & (pressure >= bound)]
    can_bear = np.broadcast_to(np.asarray(bound) > 0, pressure.shape)
    apart = reduced_gap[(pressure <= 0.0) & can_bear]
    if at_bound.size and apart.size:
        return 0.5 * float(at_bound.max() + apart.min())
    if at_bound.size:
        return float(at_bound.max())
    return float(apart.min()) if apart.size else 0.0


def optimality(
    pressure: Floats,
    displacement: Floats,
    heights: Floats,
    bound: float | Floats = np.inf,
    rigid_approach: float | None = None,
) -> Optimality:
    r"""Violation of the contact conditions and a bound of the energy error.

    .. math:: g = \ell \;(0<p<c), \qquad g \ge \ell \;(p=0), \qquad g \le \ell \;(p=c)

    Parameters
    ----------
    pressure, displacement, heights : ndarray (ny, nx)
        [Pa], [m], [m]; `displacement` must belong to `pressure`.
    bound : float or ndarray (ny, nx)
        Upper bound of the pressure [Pa].
    rigid_approach : float, optional
        Rigid-body approach, if it is prescribed [m]; that of `free_approach` otherwise.

    Returns
    -------
    Optimality
        The residual is zero at the solution and only there.

    Notes
    -----
    With the load prescribed the energy bound is the duality gap of the linearised problem
    (Frank-Wolfe gap), valid for any feasible pressure. With the approach prescribed and no bound it
    is the complementarity ``sum p |g - approach|``, a bound only once no pixel penetrates.

    Examples
    --------
    >>> optimality(np.array([[0.0, 2.0]]), np.array([[0.0, 1.0]]), np.array([[-3.0, 1.0]]))
    Optimality(approach=0.0, residual=0.0, energy_gap=0.0)
    """
    g = displacement - heights
    upper = np.asarray(bound, dtype=np.float64)
    approach = free_approach(pressure, g, upper) if rigid_approach is None else rigid_approach
    if rigid_approach is None and not np.any(np.isfinite(upper)):
        energy_gap = float(np.sum(pressure * (g - g.min())))
    else:
        missing = np.where(np.isfinite(upper), upper - pressure, pressure)
        energy_gap = float(np.sum(pressure * np.maximum(g - approach, 0.0)))
        energy_gap += float(np.sum(missing * np.maximum(approach - g, 0.0)))
    g -= approach
    violation = np.abs(g)
    violation[(pressure <= 0.0) & (g > 0.0)] = 0.0
    violation[(pressure >= upper) & (g < 0.0)] = 0.0
    return Optimality(approach, float(violation.max(initial=0.0)), max(energy_gap, 0.0))
