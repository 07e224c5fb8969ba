"""Transversely isotropic half-space whose axis is the normal: its compliance under pressure.

Wood across its rings, rolled sheet, fibre composites and basal planes of crystals are isotropic in
the plane of the surface. Under pressure alone such a half-space has the compliance of an isotropic
one of another plane strain modulus; under layers, tractions and below the surface it has not.
"""

from __future__ import annotations

import math
from typing import NamedTuple

from ..errors import DescriptionError

__all__ = ["Stiffness", "indentation_modulus", "stiffness_of"]


class Stiffness(NamedTuple):
    """Stiffnesses [Pa] that a wave in a plane through the axis 3 meets, in Voigt's notation."""

    c11: float
    c13: float
    c33: float
    c44: float


def stiffness_of(
    in_plane_modulus: float,
    axial_modulus: float,
    in_plane_ratio: float,
    axial_ratio: float,
    shear_modulus: float,
) -> Stiffness:
    """Stiffness from engineering constants.

    Parameters
    ----------
    in_plane_modulus, axial_modulus : float
        Young's moduli in the plane and along the axis [Pa].
    in_plane_ratio : float
        Poisson's ratio in the plane [-].
    axial_ratio : float
        Contraction in the plane under a stress along the axis [-].
    shear_modulus : float
        Of planes through the axis [Pa].

    Raises
    ------
    DescriptionError
        If a deformation would release energy, so that no such solid is stable.

    Examples
    --------
    >>> [round(one, 12) for one in stiffness_of(1.0, 1.0, 0.25, 0.25, 0.4)]
    [1.2, 0.4, 1.2, 0.4]
    """
    moduli = in_plane_modulus, axial_modulus, shear_modulus
    given = (*moduli, in_plane_ratio, axial_ratio)
    if not (all(map(math.isfinite, given)) and min(moduli) > 0.0):
        raise DescriptionError(
            "stiffness_of(moduli)", moduli, "be positive and finite, with finite ratios", unit="Pa"
        )
    normal, axial = 1.0 / in_plane_modulus, 1.0 / axial_modulus
    across, along = -in_plane_ratio * normal, -axial_ratio * axial
    # The three stretches couple only through the sum over the plane.
    sum_, difference = normal + across, normal - across
    determinant = sum_ * axial - 2.0 * along**2
    if not min(difference, sum_, determinant) > 0.0:
        raise DescriptionError(
            "stiffness_of(in_plane_ratio, axial_ratio)",
            (in_plane_ratio, axial_ratio),
            "lie within -1 and 1 in the plane, and have 2 axial_ratio^2 in_plane_modulus/"
            "axial_modulus below 1 - in_plane_ratio",
            unit="-",
        )
    c33 = sum_ / determinant
    c13 = -along / determinant
    c11 = 0.5 * (axial / determinant + 1.0 / difference)
    return Stiffness(c11, c13, c33, shear_modulus)


def indentation_modulus(stiffness: Stiffness) -> float:
    r"""Plane strain modulus M [Pa] of the isotropic half-space of the same normal compliance.

    .. math:: C(\alpha) = \frac{2}{M \alpha}, \qquad M = 2 \sqrt{\frac{c_{11} c_{33} - c_{13}^2}
        {c_{11}} \left(\frac{1}{c_{44}} + \frac{2}{\sqrt{c_{11} c_{33}} + c_{13}}\right)^{-1}}

    Exact for pressures on the plane normal to the axis (Elliott, Proc. Camb. Phil. Soc. 44, 1948,
    522; in this form Delafargue and Ulm, Int. J. Solids Struct. 41, 2004, 7351). A frictionless
    contact of half-spaces is that of ``Material(young_modulus=M*(1 - nu**2), poisson_ratio=nu)``
    with any nu. Not so its stresses, friction and layers, which depend on all constants.

    Parameters
    ----------
    stiffness : Stiffness
        As of `stiffness_of`.

    Raises
    ------
    DescriptionError
        If the stiffness is not positive definite.

    Examples
    --------
    An isotropic solid, E/(1 - nu^2):

    >>> round(indentation_modulus(stiffness_of(1.0, 1.0, 0.25, 0.25, 0.4)), 12)
    1.066666666667
    """
    c11, c13, c33, c44 = stiffness
    rest = c11 * c33 - c13 * c13
    if not (min(c11, c33, c44, rest) > 0.0 and all(map(math.isfinite, (*stiffness, rest)))):
        raise DescriptionError(
            "indentation_modulus.stiffness",
            tuple(stiffness),
            "have c11, c33 and c44 positive, and c13^2 below c11 c33",
            unit="Pa",
        )
    slack = 1.0 / c44 + 2.0 / (math.sqrt(c11 * c33) + c13)
    return 2.0 * math.sqrt(rest / (c11 * slack))
