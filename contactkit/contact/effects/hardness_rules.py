"""Rules for the hardness of a body, one class each, that a `HardnessLimit` may take."""

from __future__ import annotations

import abc
import math
from collections.abc import Callable
from typing import TYPE_CHECKING, Any, ClassVar, Literal

from attrs import Attribute, field, frozen

from ...errors import DescriptionError
from ...kinds import HARDNESS_RULES
from ...units import si
from ...validators import Described, choice, non_negative, positive
from .base import FixedHardness, HardnessLaw, VaryingHardness

if TYPE_CHECKING:
    from ...scene.materials import Stack
    from ...scene.scenes import ContactScene
    from ...scene.window import Grid
    from .base import Map

__all__ = [
    "ConstantHardness",
    "ContinuousHardness",
    "HardnessMap",
    "HardnessRule",
    "LayeredRule",
    "LiteralHardness",
    "MaterialHardness",
    "as_rule",
]


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


@frozen(kw_only=True)
class HardnessRule(Described, abc.ABC):
    """A rule for the hardness of both bodies. Its kind is its name in files."""

    family: ClassVar[str] = "hardness rule"
    kind: ClassVar[str]
    source: ClassVar[str]

    def lacks(self, scene: ContactScene) -> tuple[str, ...]:
        """Name what the rule needs and a scene does not give, with units."""
        return ()

    @abc.abstractmethod
    def prepare(self, scene: ContactScene, grid: Grid) -> HardnessLaw:
        """Precompute what does not depend on the pressure."""


def as_rule(value: Any) -> Any:
    """Take the name of a rule for the rule with its fields at their defaults.

    Raises
    ------
    DescriptionError
        If there is none of this name, or it has a field that must be given.
    """
    if not isinstance(value, str):
        return value
    kind = HARDNESS_RULES.find(value, "HardnessLimit.rule")
    if kind is ConstantHardness:
        raise DescriptionError(
            "HardnessLimit.rule",
            value,
            "come with its hardness",
            unit="Pa",
            hint="write rule=ConstantHardness(hardness=...), in a file rule = { kind = "
            '"constant", hardness = ... }',
        )
    return kind()


def _hardness(owner: object, attribute: Attribute[Any], value: Any) -> None:
    if not isinstance(value, HardnessMap):
        positive(owner, attribute, value)


@frozen(kw_only=True)
class ConstantHardness(HardnessRule):
    """A hardness given with the scene.

    Parameters
    ----------
    hardness : float or HardnessMap
        Hardness [Pa], one for all pixels or one for each.
    """

    kind: ClassVar[str] = "constant"
    source: ClassVar[str] = "hardness given with the scene"

    hardness: float | HardnessMap = field(validator=_hardness, metadata=si("Pa"))

    def prepare(self, scene: ContactScene, grid: Grid) -> FixedHardness:
        """See `HardnessRule.prepare`."""
        if not isinstance(self.hardness, HardnessMap):
            return FixedHardness(float(self.hardness))
        if self.hardness.values.shape != grid.shape:
            raise DescriptionError(
                "HardnessMap.values",
                f"an array of shape {self.hardness.values.shape}",
                f"have the {grid.shape} pixels of the surface",
            )
        return FixedHardness(self.hardness.values)


def _values(scene: ContactScene) -> list[list[float]]:
    """Hardness of the materials of each body [Pa], the topmost first."""
    return [[m.hardness or math.inf for m in stack.materials] for stack in scene.interface.stacks]


def _unknown(scene: ContactScene, n_materials: int | None) -> tuple[str, ...]:
    """Hardnesses that the topmost materials of a scene do not give."""
    return tuple(
        f"hardness [Pa] of {material.name!r}"
        for stack in scene.interface.stacks
        for material in stack.materials[:n_materials]
        if material.hardness is None
    )


@frozen(kw_only=True)
class MaterialHardness(HardnessRule):
    """The hardness of the topmost material, whatever lies below."""

    kind: ClassVar[str] = "material"
    source: ClassVar[str] = "hardness of the topmost material"

    def lacks(self, scene: ContactScene) -> tuple[str, ...]:
        """See `HardnessRule.lacks`."""
        return _unknown(scene, 1)

    def prepare(self, scene: ContactScene, grid: Grid) -> FixedHardness:
        """See `HardnessRule.prepare`."""
        return FixedHardness(float(min(v[0] for v in _values(scene))))


@frozen(kw_only=True)
class LayeredRule(HardnessRule):
    """A hardness that depends on the depth of indentation over the depth of the interfaces.

    Parameters
    ----------
    displacement : {"largest", "local"}
        Which displacement of the surface is taken for the depth of indentation: the largest under
        contact, one hardness for all; or that of each pixel. In a periodic window displacements
        count from the mean of the surface; else from far away.
    """

    has_jumps: ClassVar[bool] = False

    displacement: Literal["largest", "local"] = field(
        default="largest", validator=choice("largest", "local")
    )

    @abc.abstractmethod
    def of_body(self, stack: Stack) -> Callable[[Map], Map]:
        """Hardness of one body for the displacement [m] of its surface."""

    def lacks(self, scene: ContactScene) -> tuple[str, ...]:
        """See `HardnessRule.lacks`."""
        missing = _unknown(scene, None)
        if any(stack.base for stack in scene.interface.stacks):
            missing += (
                f"a substrate without end with rule={self.kind!r}, which knows no rigid base (or "
                "rule='material', or ConstantHardness with the measured hardness)",
            )
        if any(stack.layers and not stack.is_isotropic for stack in scene.interface.stacks):
            missing += (
                f"isotropic layers with rule={self.kind!r}, which compares Young's moduli (or "
                "rule='material', or ConstantHardness with the measured hardness)",
            )
        return missing

    def prepare(self, scene: ContactScene, grid: Grid) -> HardnessLaw:
        """See `HardnessRule.prepare`."""
        values = _values(scene)
        if all(len(set(v)) == 1 for v in values):
            return FixedHardness(float(min(v[0] for v in values)))
        lowest, highest = min(min(v) for v in values), min(max(v) for v in values)
        rules = [self.of_body(stack) for stack in scene.interface.stacks]

        def at(displacements: tuple[Map, ...]) -> Map | float:
            import numpy as np

            found = [rule(u) for rule, u in zip(rules, displacements, strict=True)]
            softer: Map = np.minimum.reduce(found)
            return softer if softer.ndim else float(softer)

        return VaryingHardness(lowest, highest, at, self.displacement == "local", self.has_jumps)


def _layers(stack: Stack) -> tuple[Any, Any, Any]:
    values = tuple(m.hardness or math.inf for m in stack.materials)
    return stack.young_moduli, values, stack.thicknesses


@frozen(kw_only=True)
class ContinuousHardness(LayeredRule):
    """Eq. (2.41) summed over all interfaces, without jumps, for any number of layers.

    Parameters
    ----------
    shift : float
        Depth of indentation, as a fraction of the depth of an interface, up to which that
        interface is not felt [-]; 0 gives Eq. (2.41) itself.
    displacement : {"largest", "local"}
        Which displacement of the surface is taken for the depth of indentation: the largest under
        contact, one hardness for all; or that of each pixel. In a periodic window displacements
        count from the mean of the surface; else from far away.
    """

    kind: ClassVar[str] = "continuous"
    source: ClassVar[str] = "Eq. (2.41) of Cai 2008 summed over all interfaces"

    shift: float = field(default=0.3, validator=non_negative, metadata=si("-"))

    def of_body(self, stack: Stack) -> Callable[[Map], Map]:
        """See `LayeredRule.of_body`."""
        from ...elasticity.hardness_rules import effective_hardness

        layers = _layers(stack)
        return lambda u: effective_hardness(u, *layers, shift=self.shift)


@frozen(kw_only=True)
class LiteralHardness(LayeredRule):
    """Eq. (2.41) by the criteria of the source, which jump; two layers at most.

    Parameters
    ----------
    displacement : {"largest", "local"}
        Which displacement of the surface is taken for the depth of indentation: the largest under
        contact, one hardness for all; or that of each pixel. In a periodic window displacements
        count from the mean of the surface; else from far away.
    """

    has_jumps: ClassVar[bool] = True
    kind: ClassVar[str] = "literal"
    source: ClassVar[str] = (
        "Eq. (2.41) of Cai 2008 and its three criteria; Bhushan and Venkatesan 2005"
    )

    def lacks(self, scene: ContactScene) -> tuple[str, ...]:
        """See `HardnessRule.lacks`."""
        missing = super().lacks(scene)
        if any(len(stack.layers) > 2 for stack in scene.interface.stacks):
            missing += ("at most two layers with rule='literal' (or rule='continuous')",)
        return missing

    def of_body(self, stack: Stack) -> Callable[[Map], Map]:
        """See `LayeredRule.of_body`."""
        from ...elasticity.hardness_rules import effective_hardness_literal

        layers = _layers(stack)
        return lambda u: effective_hardness_literal(u, *layers)
