"""How far a pressure map is from solving the contact problem, whoever computed it.

Sign convention: pressure, heights and displacement positive into the solid; the reduced gap is
``g = u - h`` and the gap itself is ``g - level``.

======  ============================================================
symbol  meaning
======  ============================================================
p       pressure of a pixel, ``0 <= p <= cap``
g       displacement minus height, before the rigid approach is taken
level   rigid approach: ``g = level`` where the pressure is in between
======  ============================================================
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

__all__ = ["Optimality", "free_level", "height_scale", "optimality"]

Floats = NDArray[np.float64]


class Optimality(NamedTuple):
    """What `optimality` finds.

    level : rigid approach [m]
    residual : largest violation of a contact condition over the map [m]
    gap_energy : bound of the energy above the minimum, per pixel area [J/m^2]
    """

    level: float
    residual: float
    gap_energy: float


def height_scale(heights: Floats, displacement: Floats, flat: float = 0.0) -> float:
    """Length that relative residuals refer to [m].

    The rms of the heights about their mean, or the largest displacement if that is smaller (a ball
    on a wide map); never below 1e-4 of the rms, where rounding would be asked about. For flat
    heights the largest displacement, but at least `flat`.

    Parameters
    ----------
    heights, displacement : ndarray (ny, nx)
        [m]
    flat : float
        Least length for flat heights [m]: what the mean pressure does to a single pixel.

    Examples
    --------
    >>> height_scale(np.array([[1.0, -1.0]]), np.array([[0.1, -5.0]]))
    1.0
    """
    rms = float(np.std(heights))
    most = float(max(displacement.max(), -displacement.min()))
    is_flat = rms <= 1e-9 * float(np.abs(heights).max(initial=0.0))
    return max(most, flat) if is_flat else max(min(rms, most), 1e-4 * rms)


def free_level(pressure: Floats, reduced_gap: Floats, cap: float | Floats) -> float:
    """Rigid approach that suits a pressure map best [m].

    The pressure-weighted mean of `reduced_gap` over the pixels between both bounds. If there is
    none, any value between the largest over the saturated and the smallest over the bare pixels
    will do, and the middle is taken.

    Parameters
    ----------
    pressure : ndarray
        [Pa]
    reduced_gap : ndarray
        Displacement minus height [m].
    cap : float or ndarray
        Upper bound of the pressure [Pa], ``inf`` for none.

    Examples
    --------
    >>> free_level(np.array([0.0, 1.0, 3.0]), np.array([9.0, 1.0, 2.0]), np.inf)
    1.75
    """
    free = (pressure > 0.0) & (pressure < cap)
    weight = pressure[free]
    if weight.size:
        return float(weight @ reduced_gap[free] / weight.sum())
    saturated = (pressure > 0.0) & (pressure >= cap)
    inside = reduced_gap[saturated]
    outside = reduced_gap[(pressure <= 0.0) & np.broadcast_to(np.asarray(cap) > 0, pressure.shape)]
    if inside.size and outside.size:
        return 0.5 * float(inside.max() + outside.min())
    if inside.size:
        return float(inside.max())
    return float(outside.min()) if outside.size else 0.0


def optimality(
    pressure: Floats,
    displacement: Floats,
    heights: Floats,
    cap: float | Floats = np.inf,
    level: float | None = None,
) -> Optimality:
    r"""Violation of the contact conditions and a bound of the energy error.

    .. math:: g = \ell \;(0<p<c), \qquad g \ge \ell \;(p=0), \qquad g \le \ell \;(p=c)

    Parameters
    ----------
    pressure, displacement, heights : ndarray (ny, nx)
        [Pa], [m], [m]; `displacement` must belong to `pressure`.
    cap : float or ndarray (ny, nx)
        Upper bound of the pressure [Pa].
    level : float, optional
        Rigid approach, if it is prescribed [m]; that of `free_level` otherwise.

    Returns
    -------
    Optimality
        The residual is zero at the solution and only there.

    Notes
    -----
    With the load prescribed the energy bound is the duality gap of the linearised problem
    (Frank-Wolfe gap), valid for any feasible pressure. With the level prescribed and no cap it is
    the complementarity ``sum p |g - level|``, a bound only once no pixel penetrates.

    Examples
    --------
    >>> optimality(np.array([[0.0, 2.0]]), np.array([[0.0, 1.0]]), np.array([[-3.0, 1.0]]))
    Optimality(level=0.0, residual=0.0, gap_energy=0.0)
    """
    g = displacement - heights
    bound = np.asarray(cap, dtype=np.float64)
    at = free_level(pressure, g, bound) if level is None else level
    if level is None and not np.any(np.isfinite(bound)):
        gap_energy = float(np.sum(pressure * (g - g.min())))
    else:
        missing = np.where(np.isfinite(bound), bound - pressure, pressure)
        gap_energy = float(np.sum(pressure * np.maximum(g - at, 0.0)))
        gap_energy += float(np.sum(missing * np.maximum(at - g, 0.0)))
    g -= at
    violation = np.abs(g)
    bare, saturated = pressure <= 0.0, pressure >= bound
    violation[bare & (g > 0.0)] = 0.0
    violation[saturated & (g < 0.0)] = 0.0
    return Optimality(at, float(violation.max(initial=0.0)), max(gap_energy, 0.0))
