"""Transversely isotropic materials, whose axis is the normal of the surface."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any, ClassVar

from attrs import Attribute, field, frozen

from ...errors import DescriptionError
from ...units import si
from ...validators import finite, positive, refuse
from ..materials import Material

if TYPE_CHECKING:
    from ...elasticity.transverse_isotropy import PlaneConstants

__all__ = ["TransverselyIsotropicMaterial"]


def _within_one(owner: object, attribute: Attribute[Any], value: Any) -> None:
    finite(owner, attribute, value)
    if not -1.0 < value < 1.0:
        raise refuse(owner, attribute, value, "lie above -1 and below 1")


@frozen(kw_only=True)
class TransverselyIsotropicMaterial(Material):
    r"""An elastic material that is isotropic in the plane of the surface alone.

    Its axis is the normal: basal planes of graphite and zinc, columnar coatings, rolled sheet,
    films of polymer chains that lie flat, muscle and wood across their fibres. A body or a layer of
    it answers to pressure; what depends on tractions or lies below the surface refuses it.

    Parameters
    ----------
    name : str
        What it is, for tables and figures.
    young_modulus : float
        Young's modulus in the plane E_1 [Pa].
    axial_modulus : float
        Young's modulus along the axis E_3 [Pa].
    poisson_ratio : float
        Poisson's ratio in the plane nu_12 [-], between -1 and 1.
    axial_ratio : float
        Contraction in the plane over the extension under a stress along the axis, nu_31 [-]. The
        other one is ``nu_13 = nu_31 E_1/E_3``.
    shear_modulus : float
        Of planes through the axis G_13 [Pa].
    hardness : float, optional
        Indentation hardness [Pa]; see `Material`.
    source : str
        Where the numbers come from, and their spread.

    Raises
    ------
    DescriptionError
        Beside fields out of range if ``2 nu_31^2 E_1/E_3 > 1 - nu_12``: a deformation would
        release energy. Equality is an incompressible solid.

    Examples
    --------
    Zinc, from its stiffness, indented along its axis:

    >>> zinc = TransverselyIsotropicMaterial.from_stiffness(
    ...     161e9, 34.2e9, 50.1e9, 61e9, 38.3e9, name="zinc")
    >>> [round(one / 1e9, 1) for one in (zinc.young_modulus, zinc.axial_modulus)]
    [119.4, 35.3]
    >>> round(zinc.plane_strain_modulus / 1e9, 1)
    67.8
    """

    kind: ClassVar[str] = "transversely-isotropic"
    is_isotropic: ClassVar[bool] = False

    axial_modulus: float = field(validator=positive, metadata=si("Pa"))
    poisson_ratio: float = field(validator=_within_one, metadata=si("-"))
    axial_ratio: float = field(validator=finite, metadata=si("-"))
    shear_modulus: float = field(validator=positive, metadata=si("Pa"))

    def __attrs_post_init__(self) -> None:
        try:
            _ = self.plane_constants
        except DescriptionError:
            most = math.sqrt(0.5 * (1.0 - self.poisson_ratio) * self.axial_modulus)
            raise DescriptionError(
                "TransverselyIsotropicMaterial.axial_ratio",
                self.axial_ratio,
                f"be at most {most / math.sqrt(self.young_modulus):.6g} in size with the other "
                "constants given: a deformation would release energy",
                hint="axial_ratio is nu_31, the contraction in the plane under a stress along the "
                "axis; nu_13 is young_modulus/axial_modulus times as large",
            ) from None

    @property
    def young_moduli(self) -> tuple[float, ...]:
        """Young's moduli in the plane and along the axis [Pa]."""
        return self.young_modulus, self.axial_modulus

    @property
    def plane_constants(self) -> PlaneConstants:
        """See `Material.plane_constants`."""
        from ...elasticity.transverse_isotropy import plane_constants

        return plane_constants(
            self.young_modulus,
            self.axial_modulus,
            self.poisson_ratio,
            self.axial_ratio,
            self.shear_modulus,
        )

    @property
    def plane_strain_modulus(self) -> float:
        """Modulus of indentation along the axis [Pa]: the contact modulus against a rigid body."""
        from ...elasticity.transverse_isotropy import plane_strain_modulus

        return plane_strain_modulus(self.plane_constants)

    @property
    def elastic_label(self) -> str:
        """See `Material.elastic_label`."""
        return f"E {self.young_modulus / 1e9:.4g} GPa, axial {self.axial_modulus / 1e9:.4g} GPa"

    @classmethod
    def from_stiffness(
        cls, c11: float, c12: float, c13: float, c33: float, c44: float, **given: Any
    ) -> TransverselyIsotropicMaterial:
        """Material of the stiffnesses that tables of crystals give, axis 3 along the normal.

        Parameters
        ----------
        c11, c12, c13, c33, c44 : float
            Stiffnesses in Voigt's notation [Pa]; ``c66 = (c11 - c12)/2``.
        **given
            Other fields, such as `name` and `source`.

        Raises
        ------
        DescriptionError
            If a deformation would release energy.

        Examples
        --------
        >>> isotropic = TransverselyIsotropicMaterial.from_stiffness(1.2e9, 4e8, 4e8, 1.2e9, 4e8)
        >>> round(isotropic.young_modulus), round(isotropic.axial_ratio, 12)
        (1000000000, 0.25)
        """
        sum_, minor = c11 + c12, c11 * c33 - c13 * c13
        whole = sum_ * c33 - 2.0 * c13 * c13
        if not (min(c11 - c12, sum_, c33, c44, minor, whole) > 0.0 and math.isfinite(whole)):
            raise DescriptionError(
                "TransverselyIsotropicMaterial.from_stiffness(c11, c12, c13, c33, c44)",
                (c11, c12, c13, c33, c44),
                "have c33, c44 and c11 - |c12| positive, and 2 c13^2 below (c11 + c12) c33",
                unit="Pa",
                hint="otherwise a deformation releases energy",
            )
        return cls(
            young_modulus=(c11 - c12) * whole / minor,
            axial_modulus=whole / sum_,
            poisson_ratio=(c12 * c33 - c13 * c13) / minor,
            axial_ratio=c13 / sum_,
            shear_modulus=c44,
            **given,
        )
