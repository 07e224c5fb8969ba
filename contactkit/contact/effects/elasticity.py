"""Elastic compliance of the bodies: half-spaces, and stacks of layers on them or a rigid base."""

from __future__ import annotations

import math
from functools import partial
from typing import TYPE_CHECKING, ClassVar

from attrs import frozen

from ...errors import DescriptionError
from ...validity import ValidityNumber
from .base import Compliance

if TYPE_CHECKING:
    from ...elasticity.layer_stack import Layers
    from ...elasticity.transverse_layers import TransverseLayers
    from ...scene.interface import Interface
    from ...scene.materials import Stack
    from ...scene.scenes import ContactScene
    from ...scene.window import Axis, Grid
    from .base import Map, SolvedContact, SymbolMaker

__all__ = [
    "HalfSpace",
    "LayeredHalfSpace",
    "bodies_of",
    "contact_modulus",
    "layers_of",
    "symbol_maker",
]

_ROUND_OFF = 1e-9  # of the eigenvalues of a compliance
_DEEPEST = 0.1  # displacement over thickness
_THICKEST = 1e4  # layer over window: coatings are thinner, a sheet of 1 mm may have one of 1 um
_FREE = "Love 1929, square patch on a half-space"
_BASE = "layers on a rigid base: Sneddon 1951; Johnson 1985, section 5.8"
_AXIS = "transversely isotropic half-space under pressure: Elliott 1948"
_AXIS_LAYERS = (
    "transversely isotropic layers: the waves of Elliott 1948 in a linear recursion of the minors "
    "of the compliance, own formulation"
)
_SUM = "compliances of two bodies add: Johnson 1985, section 5.1"


@frozen(kw_only=True)
class HalfSpace(Compliance):
    """Homogeneous elastic half-spaces, one or two.

    In a periodic window the transformed compliance is ``2 (1 - nu^2)/(E alpha)``; of an isolated
    contact it is that of uniform pressure on each pixel (Love). Slopes are taken small: the
    error is of the order of the squared slope.
    """

    takes_holes: ClassVar[bool] = True
    takes_relaxation: ClassVar[bool] = True
    takes_anisotropy: ClassVar[bool] = True
    name: ClassVar[str] = "half-space"
    summary: ClassVar[str] = "homogeneous elastic half-spaces"

    @property
    def sources(self) -> tuple[str, ...]:
        """See `Effect.sources`."""
        return (
            "Boussinesq's half-space, Eq. (2.34) of Cai 2008 without layers",
            _FREE,
            _SUM,
            _AXIS,
        )

    def cites(self, scene: ContactScene) -> tuple[str, ...]:
        """See `ContactEffect.cites`."""
        return _cited(self, scene)

    def lacks(self, scene: ContactScene) -> tuple[str, ...]:
        """See `ContactEffect.lacks`."""
        layered = any(stack.layers for stack in scene.interface.stacks)
        return ("bodies without layers (or LayeredHalfSpace() in its place)",) if layered else ()

    def prepare(self, scene: ContactScene, grid: Grid) -> tuple[SymbolMaker, ...]:
        """See `Compliance.prepare`."""
        return tuple(symbol_maker(stack, grid) for stack in scene.interface.stacks)


@frozen(kw_only=True)
class LayeredHalfSpace(Compliance):
    """Any number of bonded elastic layers on half-spaces or rigid bases, for one body or both.

    The compliance is exact for each wavenumber, whatever the contrast of the layers. On a
    `RigidBase` displacements count from the base; in a periodic window a mean pressure compresses
    the layers in uniaxial strain, by ``sum h (1 + nu)(1 - 2 nu)/((1 - nu) E)`` of it: not
    at all if they are incompressible (nu = 1/2).
    """

    takes_holes: ClassVar[bool] = True
    takes_relaxation: ClassVar[bool] = True
    takes_anisotropy: ClassVar[bool] = True
    name: ClassVar[str] = "layered-half-space"
    summary: ClassVar[str] = "bonded elastic layers on half-spaces or rigid bases"

    @property
    def sources(self) -> tuple[str, ...]:
        """See `Effect.sources`."""
        return (
            "bonded layers, Eqs. (2.15) to (2.34) of Cai 2008, as a projective recursion from the "
            "substrate up",
            _FREE,
            _SUM,
            _BASE,
            _AXIS_LAYERS,
        )

    def cites(self, scene: ContactScene) -> tuple[str, ...]:
        """See `ContactEffect.cites`."""
        return _cited(self, scene)

    def prepare(self, scene: ContactScene, grid: Grid) -> tuple[SymbolMaker, ...]:
        """See `Compliance.prepare`."""
        return tuple(symbol_maker(stack, grid) for stack in scene.interface.stacks)

    def validity(self, contact: SolvedContact, part: None) -> tuple[ValidityNumber, ...]:
        """See `ContactEffect.validity`."""
        stacks = contact.scene.interface.stacks
        layers = [layer for stack in stacks for layer in stack.layers]
        thinnest = min(layers, key=lambda layer: layer.thickness, default=None)
        if thinnest is None:
            return ()
        thickest = max(layers, key=lambda layer: layer.thickness)
        side = max(n * d for n, d in zip(contact.grid.shape, contact.grid.pixel_size, strict=True))
        depths = [stack.depths[-1] for stack in stacks if stack.base]
        return (
            *([_indentation(contact, min(depths))] if depths else ()),
            ValidityNumber(
                name="layer thickness over pixel",
                value=thinnest.thickness / max(contact.grid.pixel_size),
                low=1.0,
                detail=f"the pressure under a pixel cannot follow {thinnest.material.name} of "
                f"{thinnest.thickness:g} m: it acts on long waves only; use a finer Accuracy.grid, "
                "or a smaller window",
            ),
            ValidityNumber(
                name="layer thickness over the window",
                value=thickest.thickness / side,
                high=_THICKEST,
                detail=f"{thickest.material.name} of {thickest.thickness:g} m is a half-space for "
                f"a window of {side:.3g} m; check its unit: 1 nm is 1e-9 m",
            ),
        )


def contact_modulus(scene: ContactScene) -> float:
    """Contact modulus E* [Pa] of the topmost materials of both bodies; instantaneous if it relaxes.

    For ranges of validity and dimensionless numbers, not for the contact itself.
    """
    tops = [stack.materials[0].at_rate(math.inf) for stack in scene.interface.stacks]
    return 1.0 / sum(1.0 / material.plane_strain_modulus for material in tops)


def _indentation(contact: SolvedContact, thickness: float) -> ValidityNumber:
    """Displacement over the thickness of what a rigid base carries, the thinner of two bodies."""
    return ValidityNumber(
        name="displacement over the thickness on the base",
        value=float(contact.displacement.max()) / thickness,
        high=_DEEPEST,
        detail=f"linear elasticity takes strains to be small, also across {thickness:g} m; lower "
        "the load, or take a thicker solid",
        source="mean strain of the solid on its rigid base",
    )


def _cited(effect: Compliance, scene: ContactScene) -> tuple[str, ...]:
    first, free, two, *base, axis = effect.sources
    stacks = scene.interface.stacks
    found = [first] if any(stack.is_isotropic for stack in stacks) else []
    if scene.window.periodic in (False, "x", "y"):
        found.append(free)
    if len(stacks) > 1:
        found.append(two)
    if any(stack.base for stack in stacks):
        found.extend(base)
    if not all(stack.is_isotropic for stack in stacks):
        found.append(axis)
    return tuple(found)


def layers_of(stack: Stack) -> Layers:
    """Elastic constants and thicknesses of a stack."""
    from ...elasticity.layer_stack import Layers

    return Layers(stack.young_moduli, stack.poisson_ratios, stack.thicknesses, stack.base)


def bodies_of(interface: Interface) -> tuple[Layers | None, Layers | None]:
    """Elastic constants and thicknesses of the lower and the upper body; None for a rigid one."""
    lower, upper = interface.lower.stack, interface.upper.stack
    return (
        None if lower is None else layers_of(lower),
        None if upper is None else layers_of(upper),
    )


def symbol_maker(stack: Stack, grid: Grid) -> SymbolMaker:
    """Return what makes the symbol of a solid on any grid of a window."""
    if not stack.is_isotropic:
        return partial(_of_transverse, layers=_transverse_layers(stack), grid=grid)
    layers = layers_of(stack)
    if grid.along:
        return partial(_along_one_axis, layers=layers, along=grid.along, finest=grid.shape)
    if grid.periodic:
        return partial(_periodic, layers=layers)
    return partial(_isolated, layers=layers, finest=grid.shape)


def _transverse_layers(stack: Stack) -> TransverseLayers:
    from ...elasticity.transverse_layers import TransverseLayers

    solids = tuple(material.plane_constants for material in stack.materials)
    return TransverseLayers(solids, stack.thicknesses, stack.base)


def _of_transverse(
    shape: tuple[int, int], pixel_size: tuple[float, float], layers: TransverseLayers, grid: Grid
) -> Map:
    from ...elasticity import transverse_symbols

    if grid.periodic:
        return transverse_symbols.periodic_symbol(shape, pixel_size, layers)
    if grid.along:
        made = transverse_symbols.one_axis_symbol(shape, pixel_size, layers, grid.along)
    else:
        made = transverse_symbols.isolated_symbol(shape, pixel_size, layers)
    if shape == grid.shape:
        _yields(made, layers, max(pixel_size))
    return made


def _periodic(shape: tuple[int, int], pixel_size: tuple[float, float], layers: Layers) -> Map:
    from ...elasticity.layered import normal_symbol

    return normal_symbol(shape, pixel_size, *layers)


def _along_one_axis(
    shape: tuple[int, int],
    pixel_size: tuple[float, float],
    layers: Layers,
    along: Axis,
    finest: tuple[int, int],
) -> Map:
    from ...elasticity.one_axis import symbol

    made = symbol(shape, pixel_size, layers, along)
    if shape == finest:
        _yields(made, layers, max(pixel_size))
    return made


def _isolated(
    shape: tuple[int, int], pixel_size: tuple[float, float], layers: Layers, finest: tuple[int, int]
) -> Map:
    from ...elasticity.influence import symbol

    made = symbol(shape, pixel_size, *layers)
    if shape == finest:
        _yields(made, layers, max(pixel_size))
    return made


def _yields(symbol: Map, layers: Layers | TransverseLayers, pixel: float) -> None:
    """Refuse layers on a base that give way upwards: incompressible and far below a pixel."""
    if layers.base and symbol.min() < -_ROUND_OFF * symbol.max():
        raise DescriptionError(
            "Layer.thickness",
            float(sum(layers.thickness)),  # type: ignore[arg-type]
            f"be at least a tenth of the pixel of {pixel:.3g} m where the layers on a "
            "bonded base are incompressible: under a uniform pixel nothing moves but its edges",
            unit="m",
            hint="a finer Accuracy.grid, a poisson_ratio below 0.5, or Window(periodic=True)",
        )
