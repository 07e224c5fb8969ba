r"""Non-retarded van der Waals attraction of two bodies (Hamaker's pairwise summation).

Positive forces attract; energies are zero at infinity, hence negative. Arguments are floats or
arrays and are not checked.

=========  ============================================  =======
symbol     quantity                                      unit
=========  ============================================  =======
D          shortest distance of the surfaces             m
A          Hamaker constant of the bodies across the     J
           medium between them
kappa      curvature of a body, 1/R; 0 for a flat        1/m
=========  ============================================  =======

Validity: retardation reduces the force by a tenth at a few nanometres and by half at some ten
(by Gregory's fit :math:`1/(1 + 5.32 D/\lambda)` of the energy between flats, with a wavelength
near 100 nm: 0.79 at 5 nm, 0.65 at 10 nm); below a cut-off near 0.165 nm the continuum ends.

References
----------
.. [1] H. C. Hamaker, Physica 4 (1937) 1058.
.. [2] J. N. Israelachvili, Intermolecular and Surface Forces (1992), chapter 11.
.. [3] J. Gregory, J. Colloid Interface Sci. 83 (1981) 138.
"""

from __future__ import annotations

import math
from typing import Any

__all__ = [
    "energy_between_flats",
    "energy_between_spheres",
    "hamaker_of_work",
    "hamaker_sphere_force",
    "pressure_between_flats",
    "sphere_force",
    "work_of_hamaker",
]


def pressure_between_flats(gap: Any, hamaker: Any) -> Any:
    r"""Attraction of two half-spaces per unit area [Pa].

    .. math:: p = \frac{A}{6 \pi D^3}

    Parameters
    ----------
    gap : float or ndarray, shape (...)
        Distance D [m].
    hamaker : float or ndarray, shape (...)
        Hamaker constant A [J].

    Examples
    --------
    >>> round(pressure_between_flats(1e-9, 6e-20))
    3183099
    """
    return hamaker / (6.0 * math.pi * gap**3)


def energy_between_flats(gap: Any, hamaker: Any) -> Any:
    r"""Energy of two half-spaces per unit area [J/m2], :math:`-A / 12 \pi D^2`."""
    return -hamaker / (12.0 * math.pi * gap**2)


def work_of_hamaker(hamaker: Any, cutoff: Any) -> Any:
    r"""Work of adhesion [J/m2] from a Hamaker constant [J] and a cut-off [m].

    .. math:: w = \frac{A}{12 \pi D_0^2}

    Examples
    --------
    >>> round(work_of_hamaker(6.5e-20, 0.165e-9), 4)  # silica across vacuum
    0.0633
    """
    return -energy_between_flats(cutoff, hamaker)


def hamaker_of_work(work: Any, cutoff: Any) -> Any:
    r"""Hamaker constant [J] from a work of adhesion [J/m2], :math:`12 \pi D_0^2 w`."""
    return 12.0 * math.pi * cutoff**2 * work


def sphere_force(gap: Any, hamaker: Any, curvature: Any, rim: Any = math.inf) -> Any:
    r"""Attraction [N] of two close bodies of relative curvature 1/R.

    .. math:: F = \frac{A R}{6 D^2} \left[ 1 - \left( \frac{D}{D + s} \right)^2 \right],
              \qquad s = \frac{a^2}{2 R}

    within the radius a of a `rim` [m]; the bracket is 1 without one. Derjaguin approximation:
    the pressure between flats, over the gap :math:`D + r^2/2R`. Too large by the fraction D/R for
    a sphere on a flat, by more for two spheres: `hamaker_sphere_force` takes the full shape.

    Examples
    --------
    >>> round(sphere_force(1e-9, 6e-20, 1.0 / 100e-9) * 1e9, 12)
    1.0
    """
    beyond = gap / (gap + 0.5 * curvature * rim**2)
    return hamaker / (6.0 * curvature * gap**2) * (1.0 - beyond**2)


def hamaker_sphere_force(gap: Any, hamaker: Any, curvature_lower: Any, curvature_upper: Any) -> Any:
    r"""Attraction [N] of two full spheres, of which one may be a half-space, at any distance.

    .. math:: F = \frac{32 A}{3} \, \frac{z}{D^2 \, (D \kappa_1 \kappa_2 + 2 \kappa)^2
              (D \kappa_1 + 2)^2 (D \kappa_2 + 2)^2}, \qquad
              \kappa = \kappa_1 + \kappa_2, \quad z = D \kappa_1 \kappa_2 + \kappa

    The analytic derivative of Hamaker's energy: its logarithm and fractions, which cancel to third
    order at large distance, combine into one product.

    Parameters
    ----------
    gap : float or ndarray, shape (...)
        Shortest distance D [m].
    hamaker : float or ndarray, shape (...)
        Hamaker constant A [J].
    curvature_lower, curvature_upper : float or ndarray, shape (...)
        1/R of the bodies [1/m]; 0 for a half-space, not for both.

    Examples
    --------
    Far away it falls as D^-7 between spheres: as that of two molecules.

    >>> one, two = (hamaker_sphere_force(d, 1e-19, 1e7, 1e7) for d in (1e-2, 2e-2))
    >>> round(one / two, 2)
    127.99
    """
    both, sum_ = curvature_lower * curvature_upper, curvature_lower + curvature_upper
    shape = (
        (gap * both + 2.0 * sum_) * (gap * curvature_lower + 2.0) * (gap * curvature_upper + 2.0)
    )
    return 32.0 * hamaker / 3.0 * (gap * both + sum_) / (gap * shape) ** 2


def energy_between_spheres(gap: float, hamaker: float, lower: float, upper: float) -> float:
    r"""Energy [J] of two spheres of radii `lower` and `upper` [m], after Hamaker.

    .. math:: U = -\frac{A}{6} \left[ \frac{2 R_1 R_2}{s} + \frac{2 R_1 R_2}{t}
              + \ln \frac{s}{t} \right], \qquad
              s = D (D + 2 R_1 + 2 R_2), \quad t = (D + 2 R_1)(D + 2 R_2)

    At large distance (D > 100 R) the three terms cancel and digits are lost.
    """
    s = gap * (gap + 2.0 * (lower + upper))
    t = (gap + 2.0 * lower) * (gap + 2.0 * upper)
    product = 2.0 * lower * upper
    return -hamaker / 6.0 * (product / s + product / t + math.log1p(-2.0 * product / t))
