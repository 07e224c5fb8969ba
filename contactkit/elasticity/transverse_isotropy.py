"""Transversely isotropic solids whose axis is the normal: their constants, and a half-space.

Wood across its rings, rolled sheet, fibre composites, columnar coatings and basal planes of
crystals are isotropic in the plane of the surface. Under pressure alone such a half-space has the
compliance of an isotropic one of another plane strain modulus; under tractions and below the
surface it has not. Layers are in `transverse_layers`.
"""

from __future__ import annotations

import math
from typing import NamedTuple

from ..errors import DescriptionError

__all__ = [
    "PlaneConstants",
    "Stiffness",
    "Roots",
    "indentation_modulus",
    "isotropic_constants",
    "plane_constants",
    "plane_strain_modulus",
    "roots_of",
    "stiffness_of",
]

# Of 1: a round-off of the ratios at which a solid is taken to be incompressible.
_ROUND_OFF = 8.0 * math.ulp(1.0)


class Stiffness(NamedTuple):
    """Stiffnesses [Pa] that a wave in a plane through the axis 3 meets, in Voigt's notation."""

    c11: float
    c13: float
    c33: float
    c44: float


class PlaneConstants(NamedTuple):
    """Constants of a wave in a plane through the axis that stay finite in incompressible solids.

    ``sigma_LL = in_plane epsilon_LL + ratio sigma_zz``,
    ``epsilon_zz = axial sigma_zz - ratio epsilon_LL`` and ``2 epsilon_Lz = shear sigma_Lz``.

    Attributes
    ----------
    in_plane : float
        ``c11 - c13^2/c33 = E/(1 - nu^2)`` of the plane [Pa].
    ratio : float
        c13/c33 [-].
    axial, shear : float
        1/c33, zero if incompressible, and 1/c44 [1/Pa].
    """

    in_plane: float
    ratio: float
    axial: float
    shear: float


def plane_constants(
    in_plane_modulus: float,
    axial_modulus: float,
    in_plane_ratio: float,
    axial_ratio: float,
    shear_modulus: float,
) -> PlaneConstants:
    """Constants of waves from engineering constants; incompressible solids included.

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
    Incompressible and isotropic: 4 G in the plane, no compliance along the axis.

    >>> plane_constants(3.0, 3.0, 0.5, 0.5, 1.0)
    PlaneConstants(in_plane=4.0, ratio=1.0, axial=0.0, shear=1.0)
    """
    moduli = in_plane_modulus, axial_modulus, shear_modulus
    given = (*moduli, in_plane_ratio, axial_ratio)
    if not (all(map(math.isfinite, given)) and min(moduli) > 0.0):
        raise DescriptionError(
            "plane_constants(moduli)",
            moduli,
            "be positive and finite, with finite ratios",
            unit="Pa",
        )
    room = 1.0 - in_plane_ratio
    ratio = axial_ratio * (in_plane_modulus / axial_modulus) / room if room else math.inf
    left = 1.0 - 2.0 * axial_ratio * ratio  # of the axial compliance, where the plane is held
    if not (-1.0 < in_plane_ratio < 1.0 and left >= -_ROUND_OFF):
        raise DescriptionError(
            "plane_constants(in_plane_ratio, axial_ratio)",
            (in_plane_ratio, axial_ratio),
            "lie within -1 and 1 in the plane, and have 2 axial_ratio^2 in_plane_modulus/"
            "axial_modulus at most 1 - in_plane_ratio",
            unit="-",
        )
    return PlaneConstants(
        in_plane_modulus / (room * (1.0 + in_plane_ratio)),
        ratio,
        max(left, 0.0) / axial_modulus,
        1.0 / shear_modulus,
    )


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
    in_plane_modulus, axial_modulus, in_plane_ratio, axial_ratio, shear_modulus
        See `plane_constants`.

    Raises
    ------
    DescriptionError
        If a deformation would release energy, so that no such solid is stable.

    Examples
    --------
    >>> [round(one, 12) for one in stiffness_of(1.0, 1.0, 0.25, 0.25, 0.4)]
    [1.2, 0.4, 1.2, 0.4]
    """
    found = plane_constants(
        in_plane_modulus, axial_modulus, in_plane_ratio, axial_ratio, shear_modulus
    )
    if not found.axial > 0.0:
        raise DescriptionError(
            "stiffness_of(in_plane_ratio, axial_ratio)",
            (in_plane_ratio, axial_ratio),
            "belong to a compressible solid: the stiffness of others is infinite",
            unit="-",
            hint="plane_constants, which layers take, stay finite",
        )
    c33 = 1.0 / found.axial
    c13 = found.ratio * c33
    return Stiffness(found.in_plane + found.ratio * c13, c13, c33, shear_modulus)


def isotropic_constants(young_modulus: float, poisson_ratio: float) -> PlaneConstants:
    """Constants of waves in an isotropic solid, incompressible or not.

    Apart from `plane_constants`, as 1 - 2 nu loses its digits there.

    Examples
    --------
    >>> isotropic_constants(3.0, 0.5)
    PlaneConstants(in_plane=4.0, ratio=1.0, axial=0.0, shear=1.0)
    """
    modulus, nu = young_modulus, poisson_ratio
    return PlaneConstants(
        modulus / (1.0 - nu * nu),
        nu / (1.0 - nu),
        (1.0 + nu) * (1.0 - 2.0 * nu) / ((1.0 - nu) * modulus),
        2.0 * (1.0 + nu) / modulus,
    )


class Roots(NamedTuple):
    """Roots s1 and s2 of the characteristic equation: waves decay as ``exp(-s alpha z)``.

    Both are real, or conjugate; equal in isotropic solids. Real, whichever they are:

    Attributes
    ----------
    product : float
        ``s1 s2 = sqrt(c11/c33)``.
    excess : float
        ``s1 s2 - c13/c33``, not negative.
    sum : float
        s1 + s2, positive.
    difference2 : float
        ``(s1 - s2)^2``, negative of conjugate roots.
    """

    product: float
    excess: float
    sum: float
    difference2: float

    @property
    def slowest(self) -> float:
        """Real part of the root of the wave that decays slowest."""
        if self.difference2 <= 0.0:
            return 0.5 * self.sum
        return 2.0 * self.product / (self.sum + math.sqrt(self.difference2))


def roots_of(solid: PlaneConstants) -> Roots:
    r"""Roots of the characteristic equation, as sums and products that do not cancel.

    .. math:: (s_1 \pm s_2)^2 = \frac{\bar E}{c_{44}} - 2 r \pm 2 s_1 s_2, \qquad
        s_1 s_2 = \sqrt{r^2 + \bar E/c_{33}}, \quad r = c_{13}/c_{33}, \quad
        \bar E = c_{11} - c_{13}^2/c_{33}

    Source: Elliott, Proc. Camb. Phil. Soc. 44, 1948, 522, whose quadratic of s^2 is written in
    the sum and the difference of its roots.

    Examples
    --------
    >>> roots_of(plane_constants(3.0, 3.0, 0.5, 0.5, 1.0))
    Roots(product=1.0, excess=0.0, sum=2.0, difference2=0.0)
    """
    along = solid.in_plane * solid.axial
    product = math.sqrt(along + solid.ratio**2)
    # Of r > 0 the difference cancels in solids that are nearly incompressible.
    excess = along / (product + solid.ratio) if solid.ratio > 0.0 else product - solid.ratio
    sum2 = solid.in_plane * solid.shear + 2.0 * excess
    return Roots(product, excess, math.sqrt(sum2), sum2 - 4.0 * product)


def plane_strain_modulus(solid: PlaneConstants) -> float:
    """Plane strain modulus of the isotropic half-space of the same normal compliance [Pa].

    See `indentation_modulus`, which takes stiffnesses.

    Examples
    --------
    >>> plane_strain_modulus(plane_constants(3.0, 3.0, 0.5, 0.5, 1.0))
    4.0
    """
    roots = roots_of(solid)
    return 2.0 * solid.in_plane / (roots.product * roots.sum)


def indentation_modulus(stiffness: Stiffness) -> float:
    r"""Plane strain modulus M [Pa] of the isotropic half-space of the same normal compliance.

    .. math:: C(\alpha) = \frac{2}{M \alpha}, \qquad M = 2 \sqrt{\frac{c_{11} c_{33} - c_{13}^2}
        {c_{11}} \left(\frac{1}{c_{44}} + \frac{2}{\sqrt{c_{11} c_{33}} + c_{13}}\right)^{-1}}

    Exact for pressures on the plane normal to the axis (Elliott, Proc. Camb. Phil. Soc. 44, 1948,
    522; in this form Delafargue and Ulm, Int. J. Solids Struct. 41, 2004, 7351). A frictionless
    contact of half-spaces is that of ``Material(young_modulus=M*(1 - nu**2), poisson_ratio=nu)``
    with any nu. Not so its stresses and friction, nor layers (`transverse_layers`), which depend
    on all constants.

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
    return plane_strain_modulus(PlaneConstants(rest / c33, c13 / c33, 1.0 / c33, 1.0 / c44))
