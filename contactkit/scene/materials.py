"""Materials, and stacks of layers bonded to a substrate or on a rigid base."""

from __future__ import annotations

import abc
import math
from typing import TYPE_CHECKING, Any, ClassVar, Literal

from attrs import Attribute, evolve, field, frozen

from ..errors import PlanError
from ..units import si
from ..validators import Described, as_tuple, optional, part, positive, refuse

if TYPE_CHECKING:
    from ..elasticity.prony import PronySeries
    from ..elasticity.transverse_isotropy import PlaneConstants

__all__ = ["Layer", "Material", "RigidBase", "Solid", "Stack", "needs_isotropy", "needs_time"]


def _poisson(owner: object, attribute: Attribute[Any], value: Any) -> None:
    number = isinstance(value, int | float) and not isinstance(value, bool)
    if not (number and -1.0 < value <= 0.5):
        raise refuse(owner, attribute, value, "lie above -1 and not above 0.5")


def needs_time(material: Material) -> str:
    """State that the modulus of a viscoelastic material depends on time, and the cure."""
    return (
        f"{material.name} is viscoelastic, and here one modulus is needed: in a contact list "
        "Viscoelasticity(times=...) among the effects of its scene, elsewhere give the elastic "
        "material of slow loading, solid.equilibrium, or of fast, solid.instantaneous"
    )


def needs_isotropy(material: Material) -> str:
    """State that a material has an axis where isotropic ones are needed, and the cure."""
    return (
        f"{material.name} is transversely isotropic, and here isotropic materials are needed: give "
        "a Material in its place; under pressure alone its half-space is that of "
        f"Material(young_modulus={material.plane_strain_modulus:.6g}, poisson_ratio=0.0)"
    )


@frozen(kw_only=True)
class Solid(Described, abc.ABC):
    """The solid of a body. Its kind is its name in files, under ``kind``.

    Effects know a solid as layers on a substrate, `stack`: the half-space of a `Material`, the
    layers of a `Stack`, the layers by which a solid of one's own is represented, such as those of
    a graded coating.
    """

    family: ClassVar[str] = "solid"
    kind: ClassVar[str]

    @property
    @abc.abstractmethod
    def stack(self) -> Stack:
        """The solid as layers on a substrate or a rigid base."""


@frozen(kw_only=True)
class Material(Solid):
    """An isotropic elastic material; with a hardness, elastic-perfectly plastic in contact.

    Parameters
    ----------
    name : str
        What it is, for tables and figures.
    young_modulus : float
        Young's modulus [Pa].
    poisson_ratio : float
        Poisson's ratio [-], above -1 and at most 0.5 (incompressible).
    hardness : float, optional
        Indentation hardness [Pa]; only `HardnessLimit` asks for it.
    source : str
        Where the numbers come from, and their spread.

    Examples
    --------
    >>> steel = Material(name="steel", young_modulus=210e9, poisson_ratio=0.3)
    >>> round(steel.plane_strain_modulus / 1e9, 2)
    230.77
    """

    kind: ClassVar[str] = "material"
    is_isotropic: ClassVar[bool] = True

    name: str = "material"
    young_modulus: float = field(validator=positive, metadata=si("Pa"))
    poisson_ratio: float = field(validator=_poisson, metadata=si("-"))
    hardness: float | None = field(default=None, validator=optional(positive), metadata=si("Pa"))
    source: str = ""

    @property
    def plane_strain_modulus(self) -> float:
        """Plane strain modulus E/(1 - nu^2) [Pa]: the contact modulus against a rigid body."""
        return self.young_modulus / (1.0 - self.poisson_ratio**2)

    @property
    def stack(self) -> Stack:
        """See `Solid.stack`."""
        return Stack(substrate=self)

    @property
    def young_moduli(self) -> tuple[float, ...]:
        """Young's moduli of its directions [Pa]."""
        return (self.young_modulus,)

    @property
    def plane_constants(self) -> PlaneConstants:
        """Constants of waves in a plane through the normal, in which solids with an axis differ."""
        from ..elasticity.transverse_isotropy import isotropic_constants

        return isotropic_constants(self.young_modulus, self.poisson_ratio)

    @property
    def elastic_label(self) -> str:
        """Its constants for figures; of moduli that relax the first and the last."""
        moduli = dict.fromkeys(self.at_rate(rate).young_modulus for rate in (math.inf, 0.0))
        modulus = " to ".join(f"{one / 1e9:.4g}" for one in moduli)
        return f"E {modulus} GPa, nu {self.poisson_ratio:g}"

    @property
    def relaxation(self) -> PronySeries | None:
        """Relaxation modulus; None of an elastic material, which does not relax."""
        return None

    def at_rate(self, rate: float) -> Material:
        """Elastic material of the modulus at a rate [1/s]: itself, whatever the rate."""
        return self


@frozen(kw_only=True)
class Layer(Described):
    """A layer bonded to what lies below it.

    Parameters
    ----------
    material : Material
        What it is made of.
    thickness : float
        How thick it is [m].
    """

    material: Material = field(validator=part(Material))
    thickness: float = field(validator=positive, metadata=si("m"))


def _all_layers(owner: object, attribute: Attribute[Any], value: tuple[Any, ...]) -> None:
    for layer in value:
        if not isinstance(layer, Layer):
            raise refuse(owner, attribute, layer, "hold Layer objects only")


def _carrier(owner: Any, attribute: Attribute[Any], value: Any) -> None:
    part(Material, RigidBase)(owner, attribute, value)
    if isinstance(value, RigidBase) and not owner.layers:
        raise refuse(
            owner,
            attribute,
            value,
            "be a Material where there are no layers",
            "give the solid on the rigid base as layers=(Layer(material=..., thickness=...),)",
        )


@frozen(kw_only=True)
class RigidBase(Described):
    """A rigid, flat base below a solid of finite thickness.

    The displacement of the surface counts from it.

    Parameters
    ----------
    bonded : bool
        Whether the solid is bonded to the base; otherwise it rests on it and slides along it
        without friction, never lifting off.

    Examples
    --------
    >>> rubber = Material(name="rubber", young_modulus=2e6, poisson_ratio=0.49)
    >>> sheet = Stack(
    ...     layers=(Layer(material=rubber, thickness=1e-3),), substrate=RigidBase(bonded=True)
    ... )
    >>> sheet.label, sheet.base
    ('rubber 0.001 m / rigid base, bonded', 'bonded')
    """

    bonded: bool = field(validator=part(bool))

    @property
    def label(self) -> str:
        """Name for tables and figures."""
        return f"rigid base, {'bonded' if self.bonded else 'frictionless'}"


@frozen(kw_only=True)
class Stack(Solid):
    """Layers on a substrate without end, or on a rigid base.

    Parameters
    ----------
    layers : tuple of Layer
        From the surface down; none for a homogeneous solid.
    substrate : Material or RigidBase
        What carries them: a material that fills the half-space below, or a rigid base, on which
        there must be a layer.
    name : str
        What it is, for tables and figures.

    Examples
    --------
    >>> steel = Material(name="steel", young_modulus=210e9, poisson_ratio=0.3, hardness=7e9)
    >>> dlc = Material(name="DLC", young_modulus=280e9, poisson_ratio=0.25, hardness=24e9)
    >>> coated = Stack(layers=(Layer(material=dlc, thickness=2e-6),), substrate=steel)
    >>> [m.name for m in coated.materials], coated.depths
    (['DLC', 'steel'], (2e-06,))
    >>> coated.label
    'DLC 2e-06 m / steel'
    """

    kind: ClassVar[str] = "stack"

    layers: tuple[Layer, ...] = field(default=(), converter=as_tuple, validator=_all_layers)
    substrate: Material | RigidBase = field(validator=_carrier)
    name: str = ""

    @property
    def stack(self) -> Stack:
        """See `Solid.stack`."""
        return self

    @property
    def label(self) -> str:
        """Its name; without one its materials and thicknesses."""
        layers = (f"{layer.material.name} {layer.thickness:g} m" for layer in self.layers)
        below = self.substrate
        last = below.name if isinstance(below, Material) else below.label
        return self.name or " / ".join((*layers, last))

    @property
    def base(self) -> Literal["bonded", "frictionless"] | None:
        """Contact with a rigid base; None on a substrate without end."""
        if isinstance(self.substrate, Material):
            return None
        return "bonded" if self.substrate.bonded else "frictionless"

    @property
    def materials(self) -> tuple[Material, ...]:
        """Materials from the surface down, the substrate last unless it is a rigid base."""
        layers = tuple(layer.material for layer in self.layers)
        return (*layers, self.substrate) if isinstance(self.substrate, Material) else layers

    @property
    def young_moduli(self) -> tuple[float, ...]:
        """Young's moduli [Pa], surface first.

        Raises
        ------
        PlanError
            If one of them depends on time or on the direction.
        """
        for material in self.materials:
            if not material.is_isotropic:
                raise PlanError(needs_isotropy(material))
            if material.relaxation is not None:
                raise PlanError(needs_time(material))
        return tuple(m.young_modulus for m in self.materials)

    @property
    def is_isotropic(self) -> bool:
        """Whether all materials are."""
        return all(material.is_isotropic for material in self.materials)

    @property
    def relaxes(self) -> bool:
        """Whether the modulus of any material depends on time."""
        return any(material.relaxation is not None for material in self.materials)

    def at_rate(self, rate: float) -> Stack:
        """Elastic stack of the moduli at a rate [1/s]; see `Material.at_rate`."""
        below = self.substrate
        return evolve(
            self,
            layers=tuple(evolve(one, material=one.material.at_rate(rate)) for one in self.layers),
            substrate=below.at_rate(rate) if isinstance(below, Material) else below,
        )

    @property
    def poisson_ratios(self) -> tuple[float, ...]:
        """Poisson's ratios [-], surface first."""
        return tuple(m.poisson_ratio for m in self.materials)

    @property
    def thicknesses(self) -> tuple[float, ...]:
        """Thicknesses of the layers [m], surface first."""
        return tuple(layer.thickness for layer in self.layers)

    @property
    def depths(self) -> tuple[float, ...]:
        """Depths of the lower faces of the layers [m]."""
        found, depth = [], 0.0
        for thickness in self.thicknesses:
            depth += thickness
            found.append(depth)
        return tuple(found)
