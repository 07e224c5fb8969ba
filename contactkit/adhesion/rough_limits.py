r"""Limits of adhesion on rough surfaces: full contact, and the start of stickiness.

Both are estimates to print beside a solved contact, not bounds of it. Arguments are floats or
arrays and are not checked.

=========  ==========================================================  =======
symbol     quantity                                                    unit
=========  ==========================================================  =======
h_q        Fourier coefficient of the heights, mean square per mode    m
C(q)       surface compliance, 2/(E* q) of a half-space                m/Pa
h'         rms slope of the heights                                    -
h''        rms Laplacian of the heights                                1/m
w, r       work of adhesion and range                                  J/m2, m
E*         contact modulus                                             Pa
=========  ==========================================================  =======

References
----------
.. [1] B. N. J. Persson and E. Tosatti, J. Chem. Phys. 115 (2001) 5597.
.. [2] L. Pastewka and M. O. Robbins, Proc. Natl. Acad. Sci. 111 (2014) 3298.
"""

from __future__ import annotations

import math
from typing import Any

import numpy as np
from numpy.typing import NDArray

__all__ = ["STICKY_BELOW", "full_contact_energy", "stickiness_number"]

Floats = NDArray[np.float64]
STICKY_BELOW = math.pi * (3.0 / 16.0) ** (2.0 / 3.0)
"""Value of `stickiness_number` below which a surface is sticky, 1.03."""


def full_contact_energy(heights: Floats, symbol: Floats) -> float:
    r"""Elastic energy per area [J/m2] that full contact costs (Persson and Tosatti).

    .. math:: U = \tfrac12 \sum_q \frac{|h_q|^2}{C(q)}
              = \tfrac{E^*}{4} \int \frac{d^2 q}{(2 \pi)^2} \, q \, C_{2D}(q)
              \quad \text{(half-space)}

    Surfaces stick in full contact only if U < w. It assumes that the bodies follow every wave:
    adiabatic, JKR-like; the longest waves decide if the Hurst exponent is above 1/2. Of small
    partial contacts it says nothing.

    Parameters
    ----------
    heights : ndarray (ny, nx)
        Heights of both bodies together [m], periodic.
    symbol : ndarray (ny, nx // 2 + 1)
        Compliance C(q) of both bodies together on the half spectrum [m/Pa], as
        ``elasticity.layered.normal_symbol`` makes it of half-spaces and of layers.

    Examples
    --------
    A wave of amplitude 1 nm and length 1 um: :math:`U = \pi E^* a^2/(4 \lambda)`.

    >>> from contactkit.elasticity.layered import normal_symbol
    >>> x = np.arange(16) / 16.0
    >>> wave = 1e-9 * np.cos(2.0 * np.pi * x) * np.ones((16, 1))
    >>> symbol = normal_symbol((16, 16), (6.25e-8, 6.25e-8), [1e9], [0.0], [])
    >>> round(full_contact_energy(wave, symbol) / (np.pi * 1e9 * 1e-18 / 4e-6), 12)
    1.0
    """
    ny, nx = heights.shape
    spectrum = np.abs(np.fft.rfft2(heights) / (ny * nx)) ** 2
    twice = np.full(spectrum.shape[1], 2.0)  # waves of the other half
    twice[0] = 1.0
    if nx % 2 == 0:
        twice[-1] = 1.0
    stiff = np.divide(1.0, symbol, out=np.zeros_like(symbol), where=symbol > 0.0)
    return 0.5 * float((spectrum * twice * stiff).sum())


def stickiness_number(
    slope: Any, laplacian: Any, work: Any, reach: Any, modulus: Any, repulsive: float = 2.0
) -> Any:
    r"""Number of Pastewka and Robbins [-]; below `STICKY_BELOW` attraction outweighs repulsion.

    .. math:: \frac{h' r}{\kappa_{rep} \, l_a} \left( \frac{h' d}{4 r} \right)^{2/3},
              \qquad l_a = w/E^*, \quad d = 4 h'/h''

    The repulsive area per load is :math:`\kappa_{rep}/(h' E^*)`, the attractive one follows from
    a rim of tension w/r beside every contact, as wide as the gap of a Hertzian line stays below r.

    Parameters
    ----------
    slope, laplacian : float or ndarray, shape (...)
        Rms slope h' [-] and rms Laplacian h'' [1/m], twice the rms curvature of
        ``roughness.statistics.rms_curvature``.
    work, reach, modulus : float or ndarray, shape (...)
        w [J/m2], r [m] and E* [Pa].
    repulsive : float
        Factor kappa_rep of the area without adhesion [-], 1.9 to 2.2 for areas of a few tens of
        percent.

    Notes
    -----
    For contact areas below some 10 %, a rim narrower than d, a short range (r < h' d) and edges
    that are DMT-like. "Sticky" is the sign of dA/dP at small loads. The prefactors are good to a
    factor of 1.5 to 2: a map of 0.20 stuck strongly, one of 1.49 had a pull of 0.02 w/r left
    (measured, exponential law).

    Examples
    --------
    >>> rough = stickiness_number(0.1, 2e7, 0.05, 0.5e-9, 1e9)
    >>> bool(rough < STICKY_BELOW), round(rough, 2)
    (True, 0.5)
    """
    reach_of_adhesion = work / modulus
    diameter = 4.0 * slope / laplacian
    rim = (slope * diameter / (4.0 * reach)) ** (2.0 / 3.0)
    return slope * reach / (repulsive * reach_of_adhesion) * rim
