"""Weight of the liquid in a bridge between bodies that lie one above the other."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import TYPE_CHECKING, ClassVar, Literal

from attrs import field, frozen

from ...errors import InfeasibleError
from ...lubrication import dimensionless as numbers
from ...scene.column import Column
from ...validators import choice
from ...validity import ValidityNumber
from ..effects.base import ForceLaw, SeparationForce
from ..effects.meniscus import MeniscusForce
from ..effects.meniscus_sphere import exact_end
from .line import rim_needs

if TYPE_CHECKING:
    from collections.abc import Callable

    from ...scene.scenes import SeparationScene
    from ..effects.base import PlanView
    from ..effects.prepared import PreparedScene

__all__ = ["LiquidWeight"]

_HEAVY = 0.1  # Bond number: 0.6 % of the force at 0.9 of the limit of stability
_HEAVIEST = 1.0  # Bond number: there the weight rules the shape, and a first order says nothing


@frozen(kw_only=True)
class LiquidWeight(SeparationForce):
    r"""Weight of the liquid: what gravity adds to the pull of a bridge on a body.

    .. math:: \Delta F_{upper} = \rho g V \frac{d z_c}{dh}, \qquad
              \Delta F_{lower} = \Delta F_{upper} - \rho g V

    with the height z_c of the centroid of the exact bridge. Equal bodies share the weight equally,
    so that the upper one is pulled by half of it more and the lower one by half of it less.

    Parameters
    ----------
    body : {"upper", "lower"}
        Body on which the forces of the scene act, or are measured. The lower body of the interface
        lies below; a balance that reads zero with the liquid on the lower body shows the upper
        force.

    Notes
    -----
    First order in the Bond number rho g V^(2/3)/gamma, against solved bridges with gravity: up to
    0.6 of the limit of stability it misses 1e-4 of the force at a Bond number of 0.1 and 2e-3 at
    0.4; at 0.9 of it 6e-3 and 0.15. That the bridge breaks earlier under its weight is left out.
    Refused above 1.
    """

    name: ClassVar[str] = "liquid-weight"
    summary: ClassVar[str] = "weight of the liquid in the bridge"
    column: ClassVar[Column] = Column("weight_force", "N", "weight of the liquid", "#577590", "--")
    supersedes: ClassVar[tuple[str, ...]] = ("Bond number", "weight of the meniscus over its force")
    sources = (
        "virtual work of the centroid of the exact bridge, first order in the Bond number: half on "
        "each of two equal bodies, own derivation",
    )

    body: Literal["upper", "lower"] = field(default="upper", validator=choice("upper", "lower"))

    def liquid_needs(self, scene: SeparationScene) -> tuple[str, ...]:
        """See `Effect.liquid_needs`."""
        return ("density", "surface_tension")

    def proportional_to(self, scene: SeparationScene) -> str:
        """See `SeparationForce.proportional_to`."""
        return "density"

    def lacks(self, scene: SeparationScene) -> tuple[str, ...]:
        """See `Effect.lacks`."""
        meniscus = scene.effect(MeniscusForce)
        missing = rim_needs(scene)
        if meniscus is None or meniscus.form != "exact":
            missing += ("MeniscusForce() beside it, the force without weight",)
        return missing

    def prepare(self, prepared: PreparedScene[SeparationScene]) -> ForceLaw:
        """See `SeparationForce.prepare`."""
        film, bond = prepared.film, _bond(prepared)
        if bond > _HEAVIEST:
            raise InfeasibleError(
                f"LiquidWeight: the Bond number rho g V^(2/3)/gamma of a meniscus is {bond:.3g}, "
                f"and the weight is known up to {_HEAVIEST:g}, to first order; give less volume, "
                "or divide it with interface.meniscus.count"
            )
        weight = film.menisci * prepared.liquid.density * numbers.GRAVITY * film.volume
        share, end = _share(prepared)
        less = 1.0 if self.body == "lower" else 0.0
        return ForceLaw(
            lambda gap, speed: weight * (share(gap) - less), end=end, known_to=end, rate="none"
        )

    def validity(
        self, plan: PlanView, path: Sequence[tuple[float, float]]
    ) -> tuple[ValidityNumber, ...]:
        """See `SeparationEffect.validity`."""
        return (
            ValidityNumber(
                name="Bond number of the bridge",
                value=_bond(plan.prepared),
                high=_HEAVY,
                detail="the weight is taken to first order, without what it changes of rupture",
                source="rho g V^(2/3)/gamma; measured against bridges with gravity",
            ),
        )


def _bond(prepared: PreparedScene[SeparationScene]) -> float:
    size, liquid = math.cbrt(prepared.film.volume), prepared.liquid
    return float(numbers.bond_number(liquid.density, size, size, liquid.surface_tension))


def _share(prepared: PreparedScene[SeparationScene]) -> tuple[Callable[[float], float], float]:
    """Fraction of the weight on the upper body over the gap [m], and where the bridge ends [m]."""
    from ...capillary.wetting.weight import upper_share

    volume, angles, curvatures = prepared.film.volume, prepared.angles, prepared.curvatures
    end = exact_end(prepared)
    gaps, shares = upper_share(volume, angles, curvatures, end)
    if len(gaps) == 2:
        return (lambda gap: 0.5), end
    from ...numerics.cubic_spline import cubic_spline

    fine, last = cubic_spline(gaps.tolist(), shares.tolist()), float(gaps[-1])
    first = float(gaps[0])
    return (lambda gap: fine(min(max(gap, first), last))[0]), end
