r"""Westergaard: rigid unidirectional wave on a half-space, frictionless.

The wave is D (1 - cos(2 pi x / l)), which touches first at x = 0; pressures are positive in
compression and gaps where the surfaces are apart. E* is the contact modulus. Contacts are strips
of half-width b, one in each period, until at the mean pressure p* they merge.

References
----------
.. [1] H. M. Westergaard, J. Appl. Mech. 6 (1939) A49-A53.
.. [2] K. L. Johnson, Contact Mechanics (1985), Sec. 13.2.
"""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import ArrayLike, NDArray

__all__ = ["full_contact_pressure", "half_width", "mean_gap", "pressure"]


def full_contact_pressure(amplitude: float, wavelength: float, modulus: float) -> float:
    r"""Mean pressure [Pa] of full contact, :math:`p^* = \pi E^* D / l`.

    Parameters
    ----------
    amplitude : float
        D: half of the height from valley to crest [m].
    wavelength : float
        l [m].
    modulus : float
        E* [Pa].

    Examples
    --------
    >>> round(full_contact_pressure(1e-9, 1e-6, 1e11) / 1e6, 3)
    314.159
    """
    return math.pi * modulus * amplitude / wavelength


def half_width(ratio: float, wavelength: float) -> float:
    r"""Half-width [m] of the contact at a mean pressure of `ratio` times p*.

    .. math:: b = \frac{l}{\pi} \arcsin \sqrt{\bar p / p^*}

    Examples
    --------
    >>> round(half_width(0.5, 1.0), 12)
    0.25
    """
    return wavelength / math.pi * math.asin(math.sqrt(min(ratio, 1.0)))


def pressure(
    x: ArrayLike, mean_pressure: float, full_pressure: float, wavelength: float
) -> NDArray[np.float64]:
    r"""Pressure [Pa] on the wave.

    .. math:: p = \frac{2 \bar p \cos \psi}{\sin^2 \psi_b} \sqrt{\sin^2 \psi_b - \sin^2 \psi},
              \qquad \psi = \pi x / l, \quad \sin^2 \psi_b = \bar p / p^*

    and from full contact on :math:`\bar p + p^* \cos 2 \psi`.

    Parameters
    ----------
    x : array_like
        Distance from a crest [m].
    mean_pressure, full_pressure : float
        Mean pressure and its value p* at full contact [Pa].
    wavelength : float
        l [m].

    Examples
    --------
    >>> pressure([0.0, 0.25, 0.5], 0.5, 1.0, 1.0).round(6)
    array([1.414214, 0.      , 0.      ])
    """
    psi = np.pi * np.asarray(x, dtype=float) / wavelength
    ratio = mean_pressure / full_pressure
    if ratio >= 1.0:
        return mean_pressure + full_pressure * np.cos(2.0 * psi)
    room = np.maximum(ratio - np.sin(psi) ** 2, 0.0)
    return 2.0 * full_pressure * np.abs(np.cos(psi)) * np.sqrt(room)


def mean_gap(ratio: float, amplitude: float) -> float:
    r"""Mean gap [m] at a mean pressure of `ratio` times p*.

    .. math:: \bar g = D (1 - q + q \ln q), \qquad q = \bar p / p^*

    Notes
    -----
    Its slope is zero at q = 1, full contact.

    Examples
    --------
    >>> [round(mean_gap(q, 1.0), 6) for q in (0.0, 0.5, 1.0)]
    [1.0, 0.153426, 0.0]
    """
    if ratio <= 0.0:
        return amplitude
    q = min(ratio, 1.0)
    return amplitude * (1.0 - q + q * math.log(q))
