r"""Force of the weight of a bridge on its bodies, to first order in the Bond number.

At a gap h the energy of a bridge of volume V changes by :math:`\rho g V z_c` in first order, with
the height z_c of the centroid of the bridge *without* weight: its shape is in equilibrium, so that
what gravity changes of it counts in second order. The pull on the upper body grows by

.. math:: \Delta F = \rho g V \frac{d z_c}{dh}

and that on the lower one by as much less the weight. Equal bodies share the weight equally.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from ..exact.bridge import ExactBridge, bridge
from ..exact.profile import profile

__all__ = ["centroid_height", "upper_share"]

Array = NDArray[np.float64]

_POINTS = 201  # of a meridian: the centroid of a bridge is right to 1e-9 of its height
_DEGREE = 40  # of the polynomial through centroids, whose slope then is right to 1e-4
# Gap over that at which the bridge breaks, beyond which the fraction is held: unless the bodies are
# equal the first order is infinite at the fold, which the weight itself displaces.
_LAST = 0.97


class _Cap(NamedTuple):
    """Sagitta [m], volume [m3] and moment about the apex [m4] of the cap in a contact circle."""

    sag: float
    volume: float
    moment: float


def _cap(radius: float, curvature: float) -> _Cap:
    bend = curvature * radius
    sag = radius * bend / (1.0 + math.sqrt(max(1.0 - bend * bend, 0.0)))
    # pi (2 R z - z^2) dz, with 2 R s = r^2 + s^2, so that a flat needs no case of its own.
    double = radius * radius + sag * sag
    volume = math.pi * sag * (0.5 * double - sag * sag / 3.0)
    moment = math.pi * sag * sag * (double / 3.0 - sag * sag / 4.0)
    return _Cap(sag, volume, moment)


def centroid_height(
    gap: float, one: ExactBridge, curvature_lower: float = 0.0, curvature_upper: float = 0.0
) -> float:
    """Height of the centroid of a bridge above the apex of the lower body [m].

    Parameters
    ----------
    gap : float
        Shortest distance of the bodies [m].
    one : ExactBridge
        One solved bridge at that gap.
    curvature_lower, curvature_upper : float
        Curvatures 1/R of the bodies [1/m].

    Examples
    --------
    >>> from contactkit.capillary.exact.bridge import bridge
    >>> round(centroid_height(0.3, bridge(0.3, 1.0, 1.0, 1.0)), 9)
    0.15
    """
    from scipy.interpolate import CubicSpline

    below = _cap(float(one.radius_lower), curvature_lower)
    above = _cap(float(one.radius_upper), curvature_upper)
    radius, height = profile(one, _POINTS)
    height = height - below.sag
    along = np.arange(_POINTS, dtype=np.float64)
    rises = CubicSpline(along, height)(along, 1)
    first = CubicSpline(along, math.pi * radius**2 * height * rises).integrate(0, _POINTS - 1)
    caps = -below.moment + gap * above.volume + above.moment
    return float((first - caps) / float(one.volume))


def upper_share(
    volume: float,
    angles: tuple[float, float],
    curvatures: tuple[float, float],
    end: float,
) -> tuple[Array, Array]:
    r"""Fraction :math:`dz_c/dh` of the weight that the upper body carries, at gaps up to the end.

    Parameters
    ----------
    volume : float
        Volume of the bridge [m3].
    angles, curvatures : pair of float
        Contact angles [rad] and curvatures 1/R [1/m] of the lower and the upper body.
    end : float
        Gap at which the bridge loses stability [m].

    Returns
    -------
    gaps, shares : ndarray
        Gaps [m], rising from 0 (1e-3 of the end between flats), and the fraction [-] there.

    Notes
    -----
    First order in :math:`\rho g L^2/\gamma`; the second was measured against bridges with gravity
    (`tests/capillary/test_wetting.py`). Beyond 0.97 of `end` the fraction is that at 0.97.

    Examples
    --------
    >>> import math
    >>> gaps, shares = upper_share(1e-9, (0.5, 0.5), (0.0, 0.0), 1e-3)
    >>> shares.tolist()
    [0.5, 0.5]
    """
    from numpy.polynomial import Chebyshev

    is_flat = curvatures == (0.0, 0.0)
    first = 1e-3 * end if is_flat else 0.0
    if angles[0] == angles[1] and curvatures[0] == curvatures[1]:
        return np.array([first, end]), np.array([0.5, 0.5])
    # Heights grow from that of the rim of a thin film, and end like a root at the fold.
    thin = 0.1 * math.sqrt(volume * sum(curvatures) / math.pi) if not is_flat else first

    def gap_at(x: Array) -> Array:
        return np.clip((end + thin) * np.exp(-x * x) - thin, 0.0, end)

    near, far = (math.sqrt(math.log((end + thin) / (gap + thin))) for gap in (_LAST * end, first))

    def centroid(x: Array) -> Array:
        gaps = gap_at(x)
        all_of_them = bridge(gaps, volume, *angles, *curvatures)
        each = (ExactBridge(*(value[i] for value in all_of_them)) for i in range(gaps.size))
        return np.array(
            [centroid_height(gap, one, *curvatures) for gap, one in zip(gaps, each, strict=True)]
        )

    series = Chebyshev.interpolate(centroid, _DEGREE, [near, far])
    x = np.linspace(far, near, 4 * _DEGREE)
    by_gap = -2.0 * x * (gap_at(x) + thin)
    return gap_at(x), series.deriv()(x) / by_gap
