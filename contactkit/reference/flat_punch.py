r"""Rigid flat cylindrical punch on a half-space, frictionless.

Pressure positive in compression, displacement into the solid; E* is the contact modulus
E / (1 - nu^2). The contact does not grow with the load, and the pressure has no bound at the rim.

References
----------
.. [1] K. L. Johnson, Contact Mechanics (1985), Eqs. 3.34-3.38.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

__all__ = ["approach", "pressure", "surface_displacement"]


def approach(load: float, radius: float, modulus: float) -> float:
    r"""Approach [m] of a punch under a load, :math:`\delta = P / (2 a E^*)`.

    Parameters
    ----------
    load : float
        Normal force P [N].
    radius : float
        Radius a of the punch [m].
    modulus : float
        Contact modulus E* [Pa].

    Examples
    --------
    >>> approach(load=2.0, radius=1e-3, modulus=1e9)
    1e-06
    """
    return load / (2.0 * radius * modulus)


def pressure(r: ArrayLike, load: float, radius: float) -> NDArray[np.float64]:
    r"""Pressure [Pa] at a distance r from the axis, infinite at the rim and zero beyond.

    .. math:: p = \frac{P}{2 \pi a^2} \left( 1 - r^2/a^2 \right)^{-1/2}

    Examples
    --------
    >>> pressure([0.0, 0.6, 2.0], 2 * np.pi, 1.0)
    array([1.  , 1.25, 0.  ])
    """
    s = np.abs(np.asarray(r, dtype=float)) / radius
    room = (1.0 - s) * (1.0 + s)
    with np.errstate(divide="ignore"):
        inside = 1.0 / np.sqrt(np.maximum(room, 0.0))
    return load / (2.0 * np.pi * radius**2) * np.where(room >= 0.0, inside, 0.0)


def surface_displacement(
    r: ArrayLike, load: float, radius: float, modulus: float
) -> NDArray[np.float64]:
    r"""Displacement [m] of the surface; under the punch it is the approach.

    .. math:: u = \frac{2 \delta}{\pi} \arcsin \frac{a}{r}

    Examples
    --------
    >>> surface_displacement([0.5, 2.0], load=2.0, radius=1.0, modulus=1.0).round(6)
    array([1.      , 0.333333])
    """
    s = np.maximum(np.abs(np.asarray(r, dtype=float)) / radius, 1.0)
    angle = np.arctan2(1.0, np.sqrt((s - 1.0) * (s + 1.0)))
    return np.asarray(approach(load, radius, modulus) * 2.0 / np.pi * angle)
