r"""Hertz contact of a sphere and a half-space, frictionless.

Pressure positive in compression, stress positive in tension, z into the solid. The modulus is that
of the contact, 1/E* = (1 - nu_1^2)/E_1 + (1 - nu_2^2)/E_2, and the sphere a paraboloid
r^2 / 2R, which requires a contact radius much smaller than R.

References
----------
.. [1] K. L. Johnson, Contact Mechanics (1985), Eqs. 3.39-3.45 and 4.22-4.24.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

__all__ = ["Contact", "axis_stress", "gap", "pressure", "sphere", "surface_displacement"]


class Contact(NamedTuple):
    """Hertz contact of a sphere on a half-space.

    Attributes
    ----------
    contact_radius : float
        Radius of the contact [m].
    peak_pressure : float
        Pressure in its centre [Pa]; the mean is two thirds of it.
    approach : float
        Approach from first contact [m].
    """

    contact_radius: float
    peak_pressure: float
    approach: float


def sphere(load: float, radius: float, modulus: float) -> Contact:
    r"""Contact of a sphere under a load.

    .. math:: a^3 = \frac{3 P R}{4 E^*}, \qquad p_0 = \frac{3 P}{2 \pi a^2},
              \qquad \delta = \frac{a^2}{R}

    Parameters
    ----------
    load : float
        Normal force P [N].
    radius : float
        Radius R of the sphere [m].
    modulus : float
        Contact modulus E* [Pa].

    Returns
    -------
    Contact

    Notes
    -----
    The paraboloid causes a relative error of order (a/R)^2 in the contact radius.

    Examples
    --------
    >>> contact = sphere(load=1.0, radius=0.01, modulus=1e9)
    >>> round(contact.contact_radius * 1e6, 3), round(contact.approach * 1e6, 4)
    (195.743, 3.8315)
    """
    a = (0.75 * load * radius / modulus) ** (1.0 / 3.0)
    return Contact(a, 1.5 * load / (math.pi * a * a), a * a / radius)


def pressure(r: ArrayLike, contact_radius: float, peak_pressure: float) -> NDArray[np.float64]:
    r"""Pressure [Pa] at a distance r from the centre, :math:`p_0 \sqrt{1 - r^2/a^2}`, else zero.

    Examples
    --------
    >>> pressure([0.0, 0.6, 2.0], 1.0, 1.0)
    array([1. , 0.8, 0. ])
    """
    s = np.asarray(r, dtype=float) / contact_radius
    return peak_pressure * np.sqrt(np.maximum(0.0, (1.0 - s) * (1.0 + s)))


def surface_displacement(
    r: ArrayLike, contact_radius: float, peak_pressure: float, modulus: float
) -> NDArray[np.float64]:
    r"""Displacement [m] of the surface into the solid at a distance r from the centre.

    .. math:: u = \frac{\pi p_0}{4 E^* a} (2 a^2 - r^2) \; (r \le a), \qquad
              u = \frac{p_0}{2 E^* a} \left[ (2 a^2 - r^2) \arcsin\frac{a}{r}
              + a \sqrt{r^2 - a^2} \right] \; (r > a)

    Examples
    --------
    Within the contact it follows the sphere, here of radius 2 / pi.

    >>> u = surface_displacement([0.0, 1.0], 1.0, 1.0, 1.0)
    >>> round(float((u[0] - u[1]) * 4 / np.pi), 12)
    1.0
    """
    a = contact_radius
    s = np.abs(np.asarray(r, dtype=float)) / a
    outside = np.maximum(s, 1.0)
    beyond = np.sqrt((outside - 1.0) * (outside + 1.0))
    angle = np.arctan2(1.0, beyond)  # arcsin(a/r), also close to the edge
    outer = (2.0 - outside**2) * angle + beyond
    scale = 0.5 * peak_pressure * a / modulus
    return np.asarray(scale * np.where(s <= 1.0, 0.5 * np.pi * (2.0 - s * s), outer))


def gap(r: ArrayLike, contact_radius: float, radius: float) -> NDArray[np.float64]:
    r"""Gap [m] between sphere and half-space at a distance r from the centre; zero in contact.

    .. math:: g = \frac{a^2}{\pi R} \left[ \sqrt{s^2 - 1}
              + (s^2 - 2) \arccos\frac{1}{s} \right], \qquad s = r / a > 1

    Examples
    --------
    Far away it is that of the sphere less the approach.

    >>> round(float(gap(1000.0, 1.0, 1.0)), 2), 1000.0**2 / 2 - 1.0
    (499999.0, 499999.0)
    """
    s = np.maximum(np.abs(np.asarray(r, dtype=float)) / contact_radius, 1.0)
    beyond = np.sqrt((s - 1.0) * (s + 1.0))
    scale = contact_radius**2 / (np.pi * radius)
    return np.asarray(scale * (beyond + (s * s - 2.0) * np.arctan(beyond)))


def axis_stress(
    z: ArrayLike, contact_radius: float, peak_pressure: float, poisson_ratio: float
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    r"""Radial (and hoop) and axial stress [Pa] at a depth z under the centre.

    .. math:: \frac{\sigma_r}{p_0} = -(1 + \nu) \left( 1 - \zeta \arctan\frac{1}{\zeta} \right)
              + \frac{1}{2 (1 + \zeta^2)}, \qquad
              \frac{\sigma_z}{p_0} = -\frac{1}{1 + \zeta^2}, \qquad \zeta = z / a

    Examples
    --------
    >>> radial, axial = axis_stress(0.48, 1.0, 1.0, 0.3)
    >>> round(float(radial - axial) / 2, 4)  # the largest shear stress under a Hertz contact
    0.31
    """
    zeta = np.asarray(z, dtype=float) / contact_radius
    axial = -1.0 / (1.0 + zeta**2)
    radial = -(1.0 + poisson_ratio) * (1.0 - zeta * np.arctan2(1.0, zeta)) - 0.5 * axial
    return peak_pressure * radial, peak_pressure * axial
