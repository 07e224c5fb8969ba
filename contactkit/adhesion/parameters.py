r"""Parameters of an adhesive sphere contact: Maugis' units, Tabor and transition parameters.

`jkr`, `dmt` and `maugis_dugdale` use these units, in which the transition parameter is the only
parameter of a sphere. A compressive load is positive; an approach is positive where the
undeformed bodies would overlap, so that a gap is its negative. Arguments are floats or arrays and
are not checked.

=========  ==============================================  =======
symbol     quantity                                        unit
=========  ==============================================  =======
R          relative radius of the bodies                   m
w          work of adhesion                                J/m2
E*         contact modulus, 1/E* = sum (1 - nu^2)/E        Pa
K          4 E*/3                                          Pa
sigma_0    cohesive stress                                 Pa
z_0        equilibrium separation of the surfaces          m
=========  ==============================================  =======

References
----------
.. [1] D. Tabor, J. Colloid Interface Sci. 58 (1977) 2.
.. [2] D. Maugis, J. Colloid Interface Sci. 150 (1992) 243.
.. [3] K. L. Johnson and J. A. Greenwood, J. Colloid Interface Sci. 192 (1997) 326.
"""

from __future__ import annotations

import math
from typing import Any, NamedTuple

__all__ = [
    "TRANSITION_OVER_TABOR",
    "AdhesionScales",
    "cohesive_stress",
    "scales",
    "tabor_parameter",
    "transition_parameter",
]

TRANSITION_OVER_TABOR = 32.0 / (9.0 * math.sqrt(3.0)) * (9.0 / (16.0 * math.pi)) ** (1.0 / 3.0)
"""Maugis' parameter over Tabor's, 1.157, for the stress of `cohesive_stress`."""


class AdhesionScales(NamedTuple):
    """Units of load [N], of the contact radius [m] and of the approach [m]."""

    load: Any
    radius: Any
    approach: Any


def scales(radius: Any, work: Any, modulus: Any) -> AdhesionScales:
    r"""Units in which JKR, DMT and Maugis-Dugdale are written.

    .. math:: \pi w R, \qquad \left( \frac{\pi w R^2}{K} \right)^{1/3}, \qquad
              \left( \frac{\pi^2 w^2 R}{K^2} \right)^{1/3}

    Parameters
    ----------
    radius, work, modulus : float or ndarray, shape (...)
        R [m], w [J/m2] and E* [Pa].
    """
    ratio = math.pi * work * 0.75 / modulus
    return AdhesionScales(
        math.pi * work * radius,
        (ratio * radius * radius) ** (1.0 / 3.0),
        (ratio * ratio * radius) ** (1.0 / 3.0),
    )


def cohesive_stress(work: Any, equilibrium_distance: Any) -> Any:
    r"""Maximum attraction [Pa] of half-spaces with Lennard-Jones interaction.

    .. math:: \sigma_0 = \frac{16}{9 \sqrt 3} \frac{w}{z_0}

    Examples
    --------
    >>> round(cohesive_stress(0.05, 0.165e-9) / 1e6)
    311
    """
    return 16.0 / (9.0 * math.sqrt(3.0)) * work / equilibrium_distance


def tabor_parameter(radius: Any, work: Any, modulus: Any, equilibrium_distance: Any) -> Any:
    r"""Tabor parameter [-]: height of the neck over the range of the attraction.

    .. math:: \mu = \left( \frac{R w^2}{E^{*2} z_0^3} \right)^{1/3}

    JKR holds above about 5, DMT below about 0.1.

    Examples
    --------
    >>> round(tabor_parameter(10e-6, 0.05, 50e9, 0.165e-9), 3)
    1.306
    """
    return (radius * (work / modulus) ** 2) ** (1.0 / 3.0) / equilibrium_distance


def transition_parameter(radius: Any, work: Any, modulus: Any, stress: Any) -> Any:
    r"""Maugis' transition parameter [-]; 1.157 times Tabor's for the stress `cohesive_stress`.

    .. math:: \lambda = 2 \sigma_0 \left( \frac{R}{\pi w K^2} \right)^{1/3}

    Examples
    --------
    >>> stress = cohesive_stress(0.05, 0.165e-9)
    >>> found = transition_parameter(10e-6, 0.05, 50e9, stress)
    >>> round(found / tabor_parameter(10e-6, 0.05, 50e9, 0.165e-9), 4)
    1.157
    """
    return 2.0 * stress * (radius * (0.75 / modulus) ** 2 / (math.pi * work)) ** (1.0 / 3.0)
