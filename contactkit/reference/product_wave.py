r"""Rigid bidirectional wave on a half-space: limits of Johnson, Greenwood and Higginson.

The surface is D (1 - cos(2 pi x / l) cos(2 pi y / l)), with two crests in each l by l cell; E* is
the contact modulus. No closed form is known between the limits of light load, where each crest is
a Hertz contact, and of almost full contact, where each gap is a pressurised crack.

References
----------
.. [1] K. L. Johnson, J. A. Greenwood and J. G. Higginson, Int. J. Mech. Sci. 27 (1985) 383-396.
"""

from __future__ import annotations

import math

__all__ = ["area_near_full_contact", "area_under_light_load", "full_contact_pressure"]


def full_contact_pressure(amplitude: float, wavelength: float, modulus: float) -> float:
    r"""Mean pressure [Pa] of full contact, :math:`p^* = \sqrt{2} \pi E^* D / l`.

    Parameters
    ----------
    amplitude : float
        D [m]: half of the height from valley to crest.
    wavelength : float
        Period l along x and along y [m].
    modulus : float
        E* [Pa].

    Examples
    --------
    >>> round(full_contact_pressure(1.0, 1.0, 1.0), 6)
    4.442883
    """
    return math.sqrt(2.0) * math.pi * modulus * amplitude / wavelength


def area_under_light_load(ratio: float) -> float:
    r"""Fraction of the area in contact at a small `ratio` q of mean pressure to p*.

    .. math:: \frac{A}{A_0} = \pi \left( \frac{3 q}{8 \pi} \right)^{2/3}

    Notes
    -----
    Each crest is a Hertz contact of radius of curvature l^2 / (4 pi^2 D) under the load of half a
    cell; neglected terms are of relative order q^(2/3).

    Examples
    --------
    >>> round(area_under_light_load(1e-3), 6)
    0.007616
    """
    return float(math.pi * (3.0 * ratio / (8.0 * math.pi)) ** (2.0 / 3.0))


def area_near_full_contact(ratio: float) -> float:
    r"""Fraction of the area in contact at a `ratio` q of mean pressure to p* close to one.

    .. math:: \frac{A}{A_0} = 1 - \frac{3}{2 \pi} (1 - q)

    Examples
    --------
    >>> round(area_near_full_contact(0.9), 6)
    0.952254
    """
    return 1.0 - 1.5 / math.pi * max(0.0, 1.0 - ratio)
