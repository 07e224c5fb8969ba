"""Elastic compliance of the bodies: homogeneous half-spaces, or stacks of layers."""

from __future__ import annotations

from functools import partial
from typing import TYPE_CHECKING, ClassVar

from attrs import frozen

from ...scene.validity import ValidityNumber
from .base import Compliance

if TYPE_CHECKING:
    from ...elasticity.layer_stack import Layers
    from ...scene.materials import Stack
    from ...scene.scenes import ContactScene
    from ...scene.window import Grid
    from .base import Contact, Map, SymbolMaker

__all__ = ["HalfSpace", "LayeredHalfSpace", "contact_modulus", "layers_of"]

_FREE = "Love 1929, square patch on a half-space"
_SUM = "compliances of two bodies add: Johnson 1985, section 5.1"


@frozen(kw_only=True)
class HalfSpace(Compliance):
    """Homogeneous elastic half-spaces, one or two.

    In a periodic window the transformed compliance is ``2 (1 - nu^2)/(E alpha)``; of an isolated
    contact it is that of uniform pressure on each pixel (Love). Slopes are taken small: the
    error is of the order of the squared slope.
    """

    takes_holes: ClassVar[bool] = True
    name: ClassVar[str] = "half-space"
    summary: ClassVar[str] = "homogeneous elastic half-spaces"

    @property
    def sources(self) -> tuple[str, ...]:
        """See `Effect.sources`."""
        return ("Boussinesq's half-space, Eq. (2.34) without layers", _FREE, _SUM)

    def cites(self, scene: ContactScene) -> tuple[str, ...]:
        """See `ContactEffect.cites`."""
        return _cited(self, scene)

    def lacks(self, scene: ContactScene) -> tuple[str, ...]:
        """See `ContactEffect.lacks`."""
        layered = any(stack.layers for stack in scene.interface.stacks)
        return ("bodies without layers (or LayeredHalfSpace() in its place)",) if layered else ()

    def prepare(self, scene: ContactScene, grid: Grid) -> tuple[SymbolMaker, ...]:
        """See `Compliance.prepare`."""
        return tuple(_maker(stack, grid.periodic) for stack in scene.interface.stacks)


@frozen(kw_only=True)
class LayeredHalfSpace(Compliance):
    """Any number of bonded elastic layers on half-spaces, for one body or both.

    The compliance is exact for each wavenumber, whatever the contrast of the layers.
    """

    takes_holes: ClassVar[bool] = True
    name: ClassVar[str] = "layered-half-space"
    summary: ClassVar[str] = "bonded elastic layers on half-spaces"

    @property
    def sources(self) -> tuple[str, ...]:
        """See `Effect.sources`."""
        return (
            "bonded layers, Eqs. (2.15) to (2.34), as a projective recursion from the substrate up",
            _FREE,
            _SUM,
        )

    def cites(self, scene: ContactScene) -> tuple[str, ...]:
        """See `ContactEffect.cites`."""
        return _cited(self, scene)

    def prepare(self, scene: ContactScene, grid: Grid) -> tuple[SymbolMaker, ...]:
        """See `Compliance.prepare`."""
        return tuple(_maker(stack, grid.periodic) for stack in scene.interface.stacks)

    def validity(self, contact: Contact, part: None) -> tuple[ValidityNumber, ...]:
        """See `ContactEffect.validity`."""
        layers = [layer for s in contact.scene.interface.stacks for layer in s.layers]
        thinnest = min(layers, key=lambda layer: layer.thickness, default=None)
        if thinnest is None:
            return ()
        return (
            ValidityNumber(
                name="layer thickness over pixel",
                value=thinnest.thickness / max(contact.grid.pixel_size),
                low=1.0,
                detail=f"the pressure under a pixel cannot follow {thinnest.material.name} of "
                f"{thinnest.thickness:g} m: it acts on long waves only; use a finer Accuracy.grid, "
                "or a smaller window",
            ),
        )


def contact_modulus(scene: ContactScene) -> float:
    """Contact modulus E* [Pa] of the topmost materials of both bodies."""
    tops = [stack.materials[0] for stack in scene.interface.stacks]
    return 1.0 / sum(1.0 / material.plane_strain_modulus for material in tops)


def _cited(effect: Compliance, scene: ContactScene) -> tuple[str, ...]:
    first, free, two = effect.sources
    found = [first]
    if scene.window.periodic is False:
        found.append(free)
    if len(scene.interface.stacks) > 1:
        found.append(two)
    return tuple(found)


def layers_of(stack: Stack) -> Layers:
    """Elastic constants and thicknesses of a stack."""
    from ...elasticity.layer_stack import Layers

    return Layers(stack.young_moduli, stack.poisson_ratios, stack.thicknesses)


def _maker(stack: Stack, periodic: bool) -> SymbolMaker:
    return partial(_periodic if periodic else _isolated, layers=layers_of(stack))


def _periodic(shape: tuple[int, int], pixel_size: tuple[float, float], layers: Layers) -> Map:
    from ...elasticity.layered import normal_symbol

    return normal_symbol(shape, pixel_size, *layers)


def _isolated(shape: tuple[int, int], pixel_size: tuple[float, float], layers: Layers) -> Map:
    from ...elasticity.influence import symbol

    return symbol(shape, pixel_size, *layers)
