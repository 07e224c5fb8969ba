r"""Laws of attraction of two surfaces over their gap: tension and energy per area.

.. math:: \varphi(g) = -\int_g^\infty \tau(g') \, dg', \qquad \varphi(0) = -w

The tension tau never rises with the gap, so that the energy is concave. Arguments are floats or
arrays and are not checked.

=========  ==========================================================  =======
symbol     quantity                                                    unit
=========  ==========================================================  =======
g          gap of the surfaces, 0 in contact                           m
w          work of adhesion                                            J/m2
r          range of the attraction                                     m
sigma_0    w/r, the tension at contact (Dugdale, exponential)          Pa
b          half-width of the sloping end of a Dugdale law, at most r   m
z_0        equilibrium distance of a Lennard-Jones law                 m
=========  ==========================================================  =======

References
----------
.. [1] D. S. Dugdale, J. Mech. Phys. Solids 8 (1960) 100.
.. [2] D. Maugis, J. Colloid Interface Sci. 150 (1992) 243.
.. [3] J. N. Israelachvili, Intermolecular and Surface Forces (1992), chapters 10 and 11.
"""

from __future__ import annotations

from typing import Any

import numpy as np

__all__ = [
    "LENNARD_JONES_PEAK",
    "LENNARD_JONES_SLOPE",
    "dugdale_energy",
    "dugdale_tension",
    "exponential_energy",
    "exponential_tension",
    "lennard_jones_energy",
    "lennard_jones_tension",
]

_PEAK_AT = 3.0 ** (1.0 / 6.0)  # z/z_0 of the largest tension: root of d(tension)/dz
LENNARD_JONES_PEAK = 16.0 / (9.0 * 3.0**0.5)
"""Largest tension of a Lennard-Jones law over w/z_0, 1.026."""
LENNARD_JONES_SLOPE = 8.0 * 7.5 ** (-2.0 / 3.0) * (1.0 - 3.0 / 7.5)
"""Steepest fall of the tension of a Lennard-Jones law over w/z_0^2, 1.253, at z = 1.40 z_0."""


def exponential_tension(gap: Any, work: float, reach: float) -> Any:
    r"""Tension [Pa] :math:`(w/r) \, e^{-g/r}`; at 6 r it is still 0.25 % of that at contact.

    Parameters
    ----------
    gap : float or ndarray, shape (...)
        Gap g [m], at least 0.
    work, reach : float
        Work of adhesion w [J/m2] and range r [m].

    Examples
    --------
    >>> float(exponential_tension(0.0, 0.05, 1e-9)) / 1e6
    50.0
    """
    return work / reach * np.exp(-gap / reach)


def exponential_energy(gap: Any, work: float, reach: float) -> Any:
    r"""Energy [J/m2] :math:`-w \, e^{-g/r}` of `exponential_tension`.

    Examples
    --------
    >>> float(exponential_energy(0.0, 0.05, 1e-9))
    -0.05
    """
    return -work * np.exp(-gap / reach)


def dugdale_tension(gap: Any, work: float, reach: float, half_width: float) -> Any:
    r"""Tension [Pa] of Dugdale with a trapezoidal end.

    It is :math:`\sigma_0 = w/r` up to the gap r - b and falls linearly to 0 at r + b. Work and
    tension at contact are those of Dugdale's law for any b; pull-off of a sphere changes by less
    than 0.5 %.

    Parameters
    ----------
    gap : float or ndarray, shape (...)
        Gap g [m], at least 0.
    work, reach, half_width : float
        w [J/m2], r [m], and b [m] above 0 and at most r.

    Examples
    --------
    >>> dugdale_tension(np.array([0.0, 1e-9, 2e-9]), 0.05, 1e-9, 0.5e-9) / 1e6
    array([50., 25.,  0.])
    """
    return work / reach * np.clip(0.5 + 0.5 * (reach - gap) / half_width, 0.0, 1.0)


def dugdale_energy(gap: Any, work: float, reach: float, half_width: float) -> Any:
    """Energy [J/m2] of `dugdale_tension`.

    Examples
    --------
    >>> dugdale_energy(np.array([0.0, 0.5e-9, 1.6e-9]), 0.05, 1e-9, 0.5e-9)
    array([-0.05 , -0.025, -0.   ])
    """
    left = np.maximum(reach + half_width - gap, 0.0)
    area = np.where(left < 2.0 * half_width, left * left / (4.0 * half_width), reach - gap)
    return -work / reach * area


def _shifted(gap: Any, distance: float) -> Any:
    """Distance of the centres over z_0 at a gap, where the tension falls."""
    flat = (1.0 - _beyond(_PEAK_AT)) / LENNARD_JONES_PEAK  # width of the plateau over z_0
    return np.maximum(gap / distance - flat, 0.0) + _PEAK_AT


def _beyond(ratio: Any) -> Any:
    """Work of a Lennard-Jones law beyond a distance z, over w."""
    square = ratio**-2
    return 4.0 / 3.0 * square - square**4 / 3.0


def lennard_jones_tension(gap: Any, work: float, distance: float) -> Any:
    r"""Tension [Pa] of half-spaces with Lennard-Jones interaction, above a hard wall.

    .. math:: \tau = \frac{8 w}{3 z_0}
              \left[ \left(\frac{z_0}{z}\right)^3 - \left(\frac{z_0}{z}\right)^9 \right]

    from its peak at :math:`z = 3^{1/6} z_0` on. Between :math:`z_0` and the peak the tension of
    the law itself rises with the distance; here it keeps the value of the peak down to contact,
    and the rising part of 0.20 z_0 becomes a plateau of 0.15 z_0, so that the work stays w and the
    energy concave. Its repulsion is left out: the wall takes its place.

    Parameters
    ----------
    gap : float or ndarray, shape (...)
        Gap g [m], at least 0.
    work, distance : float
        Work of adhesion w [J/m2] and equilibrium distance z_0 [m].

    Examples
    --------
    >>> round(float(lennard_jones_tension(0.0, 0.05, 0.165e-9)) / 1e6)
    311
    """
    square = _shifted(gap, distance) ** -2
    root = np.sqrt(square)
    return 8.0 * work / (3.0 * distance) * root * square * (1.0 - square**3)


def lennard_jones_energy(gap: Any, work: float, distance: float) -> Any:
    """Energy [J/m2] of `lennard_jones_tension`.

    Examples
    --------
    >>> round(float(lennard_jones_energy(0.0, 0.05, 0.165e-9)), 15)
    -0.05
    """
    ratio = _shifted(gap, distance)
    flat = (1.0 - _beyond(_PEAK_AT)) / LENNARD_JONES_PEAK
    rest = np.maximum(flat - gap / distance, 0.0)
    return -work * (_beyond(ratio) + LENNARD_JONES_PEAK * rest)
