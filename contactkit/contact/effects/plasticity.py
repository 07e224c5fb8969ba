"""Hardness: the upper bound of the pressure of an elastic-perfectly plastic contact."""

from __future__ import annotations

import math
from collections.abc import Callable
from operator import attrgetter
from typing import TYPE_CHECKING, Any, ClassVar, Literal, NamedTuple

from attrs import Attribute, field, frozen

from ...errors import DescriptionError
from ...units import si
from ...validators import choice, non_negative, positive
from ...validity import ValidityNumber
from .base import (
    Array,
    BoundedContact,
    Contact,
    FixedHardness,
    HardnessLaw,
    PressureBound,
    Scalar,
    VaryingHardness,
)
from .elasticity import contact_modulus

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    from ...scene.materials import Stack
    from ...scene.scenes import ContactScene
    from ...scene.window import Grid
    from .base import Map

_MOST_PLASTIC = 0.5
_SOFTEST, _HARDEST = 1e-5, 1.0  # hardness over E*: single crystals; five times that of glasses
AT_HARDNESS = 1.0 - 1e-6
"""Pressure over hardness from which on a pixel is plastic [-]: one that is loaded again to where it
was left is back at the hardness to the tolerance of the solver."""

__all__ = ["AT_HARDNESS", "HardnessLimit", "HardnessMap", "PlasticPart"]


def _as_map(value: Any) -> Map:
    import numpy as np

    if np.ma.is_masked(value):
        raise DescriptionError(
            "HardnessMap.values",
            "a masked array",
            "have a hardness for every pixel",
            unit="Pa",
            hint="a pixel that carries no load has the hardness 0, or is masked in the heights",
        )
    made = np.array(value, dtype=float, order="C")
    made.flags.writeable = False
    return made


@frozen(eq=False)
class HardnessMap:
    """A hardness for each pixel, as an array.

    Parameters
    ----------
    values : array_like (ny, nx)
        Hardness [Pa], zero or positive.
    """

    values: Map = field(
        converter=_as_map,
        repr=False,
        metadata=si("Pa")
        | {
            "in_file": "a scene file holds a uniform hardness; a map is kept in Python and in "
            "result files"
        },
    )

    @values.validator
    def _check_values(self, attribute: Attribute[Any], value: Map) -> None:
        import numpy as np

        if value.ndim != 2 or not (np.isfinite(value) & (value >= 0.0)).all():
            raise DescriptionError(
                "HardnessMap.values",
                f"an array of shape {value.shape}",
                "have two dimensions and be finite, zero or positive everywhere",
                unit="Pa",
            )


def _hardness(owner: object, attribute: Attribute[Any], value: Any) -> None:
    if value is not None and not isinstance(value, HardnessMap):
        positive(owner, attribute, value)


class PlasticPart(NamedTuple):
    """Plastic pixels (ny, nx), their area [m2], and the hardness [Pa].

    `overlap` is the depth (ny, nx) [m] by which the elastic surfaces would overlap there, for
    which plastic flow has to make room.
    """

    is_plastic: NDArray[np.bool_]
    area: float
    hardness: Map | float
    overlap: Map


def _one_hardness(part: PlasticPart) -> float | None:
    return part.hardness if isinstance(part.hardness, float) else None


def _hardness_map(part: PlasticPart) -> Map | None:
    return None if isinstance(part.hardness, float) else part.hardness


@frozen(kw_only=True)
class HardnessLimit(PressureBound[PlasticPart]):
    """Elastic-perfectly plastic contact: no pressure exceeds the hardness.

    A pixel whose pressure reaches the hardness is plastic; its gap is closed by plastic flow,
    whose own geometry is left out. The hardness is that of the softer of the two bodies.

    Parameters
    ----------
    rule : {"continuous", "literal", "material", "constant"}
        Hardness of a layered body. ``continuous``: Eq. (2.41) summed over all interfaces, without
        jumps, any number of layers. ``literal``: Eq. (2.41) by the criteria of the source, which
        jump, and for two layers at most. ``material``: that of the topmost material, whatever
        lies below. ``constant``: `hardness`.
    hardness : float or HardnessMap, optional
        Hardness [Pa] for the rule ``constant``, one for all pixels or one for each.
    shift : float
        Depth of indentation, as a fraction of the depth of an interface, up to which that
        interface is not felt, for the rule ``continuous`` [-]; 0 gives Eq. (2.41) itself.
    displacement : {"largest", "local"}
        Which displacement of the surface the layered rules take for the depth of indentation: the
        largest under contact, one hardness for all; or that of each pixel. In a periodic window
        displacements count from the mean of the surface; else from far away.
    """

    takes_holes: ClassVar[bool] = True
    name: ClassVar[str] = "hardness-limit"
    summary: ClassVar[str] = "perfectly plastic where the pressure reaches the hardness"
    records: ClassVar[tuple[type, ...]] = (PlasticPart,)
    arrays: ClassVar[tuple[Array, ...]] = (
        Array("plastic", "-", attrgetter("is_plastic")),
        Array("overlap", "m", attrgetter("overlap")),
        Array("local_hardness", "Pa", _hardness_map),
    )
    scalars: ClassVar[tuple[Scalar, ...]] = (
        Scalar("plastic_area", "m2", attrgetter("area")),
        Scalar("plastic_fraction", "-", lambda part: float(part.is_plastic.mean())),
        Scalar("max_overlap", "m", lambda part: float(part.overlap.max())),
        Scalar("hardness", "Pa", _one_hardness),
    )

    rule: Literal["continuous", "literal", "material", "constant"] = field(
        default="continuous", validator=choice("continuous", "literal", "material", "constant")
    )
    hardness: float | HardnessMap | None = field(
        default=None, validator=_hardness, metadata=si("Pa")
    )
    shift: float = field(default=0.3, validator=non_negative, metadata=si("-"))
    displacement: Literal["largest", "local"] = field(
        default="largest", validator=choice("largest", "local")
    )

    @property
    def sources(self) -> tuple[str, ...]:
        """See `Effect.sources`."""
        bound = "pressure bounded by the hardness, section 2.1.3.2"
        rules = {
            "continuous": "Eq. (2.41) summed over all interfaces, docs/physics/hardness.md",
            "literal": "Eq. (2.41) and the three criteria after it (Bhushan and Venkatesan 2005)",
            "material": "hardness of the topmost material",
            "constant": "hardness given with the scene",
        }
        return (bound, rules[self.rule])

    def lacks(self, scene: ContactScene) -> tuple[str, ...]:
        """See `ContactEffect.lacks`."""
        if self.rule == "constant":
            return () if self.hardness is not None else ("HardnessLimit.hardness [Pa]",)
        if self.hardness is not None:
            return (
                f"HardnessLimit.hardness left out with rule={self.rule!r} (or rule='constant')",
            )
        missing = [
            f"hardness [Pa] of {material.name!r}"
            for stack in scene.interface.stacks
            for material in (stack.materials[:1] if self.rule == "material" else stack.materials)
            if material.hardness is None
        ]
        if self.rule in ("continuous", "literal") and any(s.base for s in scene.interface.stacks):
            missing.append(
                f"a substrate without end with rule={self.rule!r}, which knows no rigid base (or "
                "rule='material', or rule='constant' with the measured hardness)"
            )
        if self.rule == "literal" and any(len(s.layers) > 2 for s in scene.interface.stacks):
            missing.append("at most two layers with rule='literal' (or rule='continuous')")
        return tuple(dict.fromkeys(missing))

    def prepare(self, scene: ContactScene, grid: Grid) -> HardnessLaw:
        """See `PressureBound.prepare`."""
        if self.hardness is not None:  # with the rule "constant", see `lacks`
            return _constant(self.hardness, grid)
        stacks = scene.interface.stacks
        values = [[m.hardness or math.inf for m in stack.materials] for stack in stacks]
        if self.rule == "material" or all(len(set(v)) == 1 for v in values):
            return FixedHardness(float(min(v[0] for v in values)))
        lowest, highest = min(min(v) for v in values), min(max(v) for v in values)
        rules = [self._of_body(stack) for stack in stacks]

        def at(displacements: tuple[Map, ...]) -> Map | float:
            import numpy as np

            found = [rule(u) for rule, u in zip(rules, displacements, strict=True)]
            softer: Map = np.minimum.reduce(found)
            return softer if softer.ndim else float(softer)

        is_local, has_jumps = self.displacement == "local", self.rule == "literal"
        return VaryingHardness(lowest, highest, at, is_local, has_jumps)

    def _of_body(self, stack: Stack) -> Callable[[Map], Map]:
        """Hardness of one body for the displacement [m] of its surface."""
        from ...elasticity import hardness_rules as kernel

        values = tuple(m.hardness or math.inf for m in stack.materials)
        layered = (stack.young_moduli, values, stack.thicknesses)
        if self.rule == "literal":
            return lambda u: kernel.effective_hardness_literal(u, *layered)
        return lambda u: kernel.effective_hardness(u, *layered, shift=self.shift)

    def observe_bounded(self, contact: Contact, bounded: BoundedContact) -> PlasticPart:
        """See `PressureBound.observe_bounded`: pixels at the hardness."""
        import numpy as np

        at_bound = contact.pressure >= np.asarray(bounded.hardness) * AT_HARDNESS
        is_plastic = at_bound & (contact.pressure > 0.0)
        area = float(is_plastic.sum()) * contact.grid.pixel_area
        overlap = np.where(is_plastic, bounded.overlap, 0.0)
        return PlasticPart(is_plastic, area, bounded.hardness, overlap)

    def validity(self, contact: Contact, part: PlasticPart) -> tuple[ValidityNumber, ...]:
        """See `ContactEffect.validity`."""
        touching = int((contact.pressure > 0.0).sum())
        return (
            ValidityNumber(
                name="fraction of the contact at the hardness",
                value=int(part.is_plastic.sum()) / touching if touching else None,
                high=_MOST_PLASTIC,
                detail="the volume that plastic flow displaces is left out, and elasticity carries "
                "the rest of the load; lower the load, or take the area as load over hardness"
                if touching
                else "there is no contact",
            ),
            _relative_hardness(contact, part.hardness),
        )


def _relative_hardness(contact: Contact, hardness: Map | float) -> ValidityNumber:
    """Hardness over E*, the smallest or, where that is too large, the largest."""
    import numpy as np

    modulus, given = contact_modulus(contact.scene), np.asarray(hardness)
    high = float(given.max()) / modulus
    low = float(given[given > 0.0].min(initial=math.inf)) / modulus  # 0 where nothing is carried
    return ValidityNumber(
        name="hardness over E*",
        value=high if high > _HARDEST else low,
        low=_SOFTEST,
        high=_HARDEST,
        detail=f"E* = {modulus:.3g} Pa; metals have 1e-3 to 0.03, glasses and ceramics up to 0.15; "
        "check the unit of the hardness: 7 GPa are 7e9 Pa",
        source="Johnson 1985, section 6.1; Tabor 1951",
    )


def _constant(hardness: float | HardnessMap, grid: Grid) -> FixedHardness:
    if not isinstance(hardness, HardnessMap):
        return FixedHardness(float(hardness))
    if hardness.values.shape != grid.shape:
        raise DescriptionError(
            "HardnessMap.values",
            f"an array of shape {hardness.values.shape}",
            f"have the {grid.shape} pixels of the surface",
        )
    return FixedHardness(hardness.values)
