"""Hardness: the upper bound of the pressure of an elastic-perfectly plastic contact."""

from __future__ import annotations

import math
from operator import attrgetter
from typing import TYPE_CHECKING, ClassVar, NamedTuple

from attrs import field, frozen

from ...validators import part
from ...validity import ValidityNumber
from .base import (
    Array,
    BoundedContact,
    HardnessLaw,
    PressureBound,
    Scalar,
    SolvedContact,
)
from .elasticity import contact_modulus
from .hardness_rules import ContinuousHardness, HardnessRule, as_rule

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    from ...scene.scenes import ContactScene
    from ...scene.window import Grid
    from .base import Map

# Where more than half of the contact is at the hardness, the load is shared out by the hardness
# rather than by the elastic solid, which is all that gives way here.
MOST_PLASTIC = 0.5
"""Fraction of the contact at the hardness from which on the answer is in doubt [-]."""
_SOFTEST, _HARDEST = 1e-5, 1.0  # hardness over E*: single crystals; five times that of glasses
AT_HARDNESS = 1.0 - 1e-6
"""Pressure over hardness from which on a pixel is plastic [-]: one that is loaded again to where it
was left is back at the hardness to the tolerance of the solver."""

__all__ = ["AT_HARDNESS", "HardnessLimit", "PlasticPart"]


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
    rule : HardnessRule or str
        Hardness of a body. ``"continuous"``, that is `ContinuousHardness`; `LiteralHardness`,
        `MaterialHardness`, `ConstantHardness`, or a rule of one's own. A name stands for a rule
        whose fields are at their defaults.

    Examples
    --------
    >>> HardnessLimit(rule="material").rule
    MaterialHardness()
    """

    takes_holes: ClassVar[bool] = True
    takes_anisotropy: ClassVar[bool] = True
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

    rule: HardnessRule = field(
        factory=ContinuousHardness, converter=as_rule, validator=part(HardnessRule)
    )

    @property
    def sources(self) -> tuple[str, ...]:
        """See `Effect.sources`."""
        return ("pressure bounded by the hardness, section 2.1.3.2 of Cai 2008", self.rule.source)

    def lacks(self, scene: ContactScene) -> tuple[str, ...]:
        """See `ContactEffect.lacks`."""
        return tuple(dict.fromkeys(self.rule.lacks(scene)))

    def prepare(self, scene: ContactScene, grid: Grid) -> HardnessLaw:
        """See `PressureBound.prepare`."""
        return self.rule.prepare(scene, grid)

    def observe_bounded(self, contact: SolvedContact, bounded: BoundedContact) -> PlasticPart:
        """See `PressureBound.observe_bounded`: pixels at the hardness."""
        import numpy as np

        at_bound = contact.pressure >= np.asarray(bounded.hardness) * AT_HARDNESS
        is_plastic = at_bound & (contact.pressure > 0.0)
        area = float(is_plastic.sum()) * contact.grid.pixel_area
        overlap = np.where(is_plastic, bounded.overlap, 0.0)
        return PlasticPart(is_plastic, area, bounded.hardness, overlap)

    def validity(self, contact: SolvedContact, part: PlasticPart) -> tuple[ValidityNumber, ...]:
        """See `ContactEffect.validity`."""
        touching = int((contact.pressure > 0.0).sum())
        return (
            ValidityNumber(
                name="fraction of the contact at the hardness",
                value=int(part.is_plastic.sum()) / touching if touching else None,
                high=MOST_PLASTIC,
                detail="the volume that plastic flow displaces is left out, and elasticity carries "
                "the rest of the load; lower the load, or take the area as load over hardness"
                if touching
                else "there is no contact",
            ),
            _relative_hardness(contact, part.hardness),
        )


def _relative_hardness(contact: SolvedContact, hardness: Map | float) -> ValidityNumber:
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
