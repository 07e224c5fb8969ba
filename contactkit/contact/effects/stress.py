"""Stress below the surface of the lower body, on planes, with its maxima."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from functools import partial
from itertools import pairwise
from typing import TYPE_CHECKING, Any, ClassVar, Literal, NamedTuple

import numpy as np
from attrs import Attribute, field, frozen

from ...elasticity.stress import measures as stress_measures
from ...elasticity.stress.maxima import Maximum, maxima
from ...elasticity.stress.planes import Plane, planes
from ...elasticity.stress.tractions import Tractions
from ...units import si
from ...validators import choice, non_negative, positive, refuse
from .base import Contact, Observer, Scalar
from .elasticity import layers_of
from .friction import FrictionTraction

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    from ...scene.scenes import ContactScene
    from ...scene.window import Grid

    Map = NDArray[np.float64]

__all__ = ["StressPart", "SubsurfaceStress", "scan"]


def _tuple(value: Any) -> tuple[float, ...] | None:
    return tuple(value) if value is not None else None


def _depths(owner: object, attribute: Attribute[Any], value: Any) -> None:
    if value is None:
        return
    for depth in value:
        non_negative(owner, attribute, depth)
    if not value or any(b <= a for a, b in pairwise(value)):
        raise refuse(owner, attribute, value, "be depths that grow")


def _at_least_one(owner: object, attribute: Attribute[Any], value: Any) -> None:
    positive(owner, attribute, value)
    if value < 1.0:
        raise refuse(owner, attribute, value, "be at least 1: repetitions cannot overlap")


class StressPart(NamedTuple):
    """Stress in the lower body: its maxima, a section, and all planes if they were kept.

    `depth` [m], `side` ("+" below a depth, "-" above) and `layer` (0: the topmost) name the
    planes, n of them; at an interface there are two. `maxima` holds value and place of the
    largest "von_mises", "sqrt_j2", "tension" (largest principal stress), "tresca" (largest shear
    stress) and "sigma_xz". `section` (6, n, nx) is the stress [Pa] under the row of pixels `row`
    with the largest pressure; `largest_von_mises` (n) [Pa] that of each plane. `planes` (6, n,
    ny, nx) is there with ``keep="planes"`` only.
    """

    depth: Map
    side: tuple[str, ...]
    layer: NDArray[np.int_]
    maxima: Mapping[str, Maximum]
    row: int
    section: Map
    largest_von_mises: Map
    planes: Map | None


_MEASURES = ("von_mises", "tension", "tresca", "sigma_xz", "sqrt_j2")
_OF_A_MAXIMUM = (("", "value", "Pa"), ("_depth", "z", "m"), ("_layer", "layer", "-"))


def _read(measure: str, field: str, part: StressPart) -> float:
    number: float = getattr(part.maxima[measure], field)
    return number


@frozen(kw_only=True)
class SubsurfaceStress(Observer[StressPart]):
    """Stress in the lower body, on planes at given depths and on both faces of each interface.

    In-plane stresses jump at interfaces, so a maximum may sit on either face. Where friction
    acts its traction is included. Maxima are those of the pixels of the planes: choose depths
    closer than the size of a contact spot.

    Parameters
    ----------
    depths : tuple of float, optional
        Depths of the planes [m], growing. None: the surface and 24 depths down to a
        quarter of the window, closer together towards the surface.
    keep : {"section", "planes"}
        Whether to keep one section and the maxima, or all planes: six arrays for each depth.
    window : float
        Isolated contacts: distance of the repetitions that the transforms leave over the size of
        the window [-]; stiff layers need a hundred contact radii for four digits.
    """

    name: ClassVar[str] = "subsurface-stress"
    summary: ClassVar[str] = "stress below the surface of the lower body"
    records: ClassVar[tuple[type, ...]] = (StressPart, Maximum)
    scalars: ClassVar[tuple[Scalar, ...]] = tuple(
        Scalar(f"max_{measure}{suffix}", unit, partial(_read, measure, field))
        for measure in _MEASURES
        for suffix, field, unit in _OF_A_MAXIMUM
    )

    depths: tuple[float, ...] | None = field(
        default=None,
        converter=_tuple,
        validator=_depths,
        metadata=si("m"),
    )
    keep: Literal["section", "planes"] = field(
        default="section", validator=choice("section", "planes")
    )
    window: float = field(default=128.0, validator=_at_least_one, metadata=si("-"))

    @property
    def sources(self) -> tuple[str, ...]:
        """See `Effect.sources`."""
        return (
            "stress of the layered half-space, Eq. (2.20), by a sweep down the layers",
            "von Mises, principal and shear stress: Appendix A, in three dimensions",
        )

    def lacks(self, scene: ContactScene) -> tuple[str, ...]:
        """See `ContactEffect.lacks`."""
        if scene.interface.lower.solid is None:
            return ("interface.lower.solid: the stress of a rigid body is not defined",)
        return ()

    def planes_of(self, scene: ContactScene, grid: Grid) -> tuple[tuple[float, str], ...]:
        """Depth [m] and side of each plane: those requested, and both faces of interfaces."""
        stack = scene.interface.lower.stack
        assert stack is not None
        wanted = self.depths
        if wanted is None:
            from ...elasticity.depths import default_depths

            (ny, nx), (dy, dx) = grid.shape, grid.pixel_size
            deepest = 0.25 * min(ny * dy, nx * dx)
            return tuple(zip(*default_depths(stack.thicknesses, deepest), strict=True))
        faces = [z for z in stack.depths if z <= wanted[-1] * (1.0 + 1e-12)]
        planes = {(z, side) for z in faces for side in "-+"}
        planes |= {(z, "+") for z in wanted if not any(math.isclose(z, f) for f in faces)}
        return tuple(sorted(planes, key=lambda plane: (plane[0], plane[1] == "+")))

    def observe(self, contact: Contact) -> StressPart:
        """See `Observer.observe`."""
        friction = contact.scene.effect(FrictionTraction)
        traction = friction.components() if friction is not None else (0.0, 0.0)
        planes = self.planes_of(contact.scene, contact.grid)
        return scan(contact, planes, traction, self.keep == "planes", self.window)


def scan(
    contact: Contact,
    where: Sequence[tuple[float, str]],
    friction: tuple[float, float],
    keep_planes: bool,
    window: float,
) -> StressPart:
    """Stress of a contact on planes.

    Parameters
    ----------
    contact : Contact
        Solved.
    where : sequence of (float, str)
        Depth [m] and side of each plane, in order.
    friction : (float, float)
        Traction along x and y per unit of pressure [-]; what is 0 is not transformed.
    keep_planes : bool
        Whether to keep the planes themselves.
    window : float
        Padding of an isolated contact [-].
    """
    stack = contact.scene.interface.lower.stack
    assert stack is not None
    pressure, (ny, nx) = contact.pressure, contact.grid.shape
    row = int(np.unravel_index(int(np.argmax(pressure)), pressure.shape)[0])
    tractions = [part * pressure if part != 0.0 else None for part in friction]
    n = len(where)
    section, largest = np.empty((6, n, nx)), []
    kept = np.empty((6, n, ny, nx)) if keep_planes else None
    layers = np.empty(n, dtype=int)
    found = planes(
        Tractions(contact.grid.pixel_size, pressure, *tractions),
        layers_of(stack),
        [depth for depth, _ in where],
        [side for _, side in where],
        mean="periodic" if contact.grid.periodic else "free",
        padding=window,
        workers=contact.threads,
    )

    def passing() -> Iterator[Plane]:
        for i, plane in enumerate(found):
            section[:, i] = plane.stress[:, row]
            layers[i] = plane.layer
            if kept is not None:
                kept[:, i] = plane.stress
            yield plane

    def von_mises(stress: Map) -> Map:
        values = stress_measures.von_mises(stress)
        largest.append(float(values.max()))
        return values

    measures = {
        "von_mises": von_mises,
        "tension": stress_measures.max_principal_stress,
        "tresca": stress_measures.tresca,
        "sigma_xz": lambda stress: np.abs(stress[4]),
    }
    best = maxima(passing(), measures, contact.grid.pixel_size, refine=True)
    mises = best["von_mises"]
    best["sqrt_j2"] = mises._replace(value=mises.value / 3.0**0.5)
    depths = np.array([depth for depth, _ in where])
    sides = tuple(side for _, side in where)
    return StressPart(depths, sides, layers, best, row, section, np.array(largest), kept)
