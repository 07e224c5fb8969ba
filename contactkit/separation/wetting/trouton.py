"""Extensional stress of a column of liquid that is drawn out."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import TYPE_CHECKING, ClassVar

from attrs import field, frozen

from ...scene.column import Column
from ...units import si
from ...validators import positive
from ...validity import ValidityNumber
from ..effects.base import ForceLaw, SeparationForce
from .line import rim_needs

if TYPE_CHECKING:
    from ...scene.scenes import SeparationScene
    from ..effects.base import PlanView
    from ..effects.film_shape import FilmShape
    from ..effects.prepared import PreparedScene

__all__ = ["TroutonForce"]


@frozen(kw_only=True)
class TroutonForce(SeparationForce):
    r"""Extensional stress of a column of liquid, which Reynolds' equation leaves out.

    .. math:: F = \mathrm{Tr}\, \eta\, \frac{A^2}{V} \dot h, \qquad A = \pi r^2

    the mean column of a film of the volume V and the rim r: between flats 3 pi eta r^2 h'/h.

    Parameters
    ----------
    trouton_ratio : float
        Extensional over shear viscosity [-]; 3 for a Newtonian liquid (Trouton 1906).

    Notes
    -----
    Exact for a long column (r << h). Listed beside `ViscousForce`, whose force is exact for a thin
    film (r >> h), their sum is right in both limits: between discs 3 pi eta r^2 h'/h (1 +
    r^2/(2 h^2)), which fits the start of filaments drawn out between discs. Beside a thin film it
    is 2 (h/r)^2 of the viscous force, of the size of what that leaves out at its rim. Inertia and
    the thinning of a neck (Rayleigh and Plateau) are left out.
    """

    name: ClassVar[str] = "trouton-force"
    summary: ClassVar[str] = "extensional stress of the column of liquid (Trouton)"
    column: ClassVar[Column] = Column("trouton_force", "N", "extensional force", "#bc6c25", "-.")
    sources = (
        "Trouton 1906; sum with the force of a thin film: Spiegelberg, Ables and McKinley 1996",
    )

    trouton_ratio: float = field(default=3.0, validator=positive, metadata=si("-"))

    def liquid_needs(self, scene: SeparationScene) -> tuple[str, ...]:
        """See `Effect.liquid_needs`."""
        return ("viscosity",)

    def proportional_to(self, scene: SeparationScene) -> str:
        """See `SeparationForce.proportional_to`."""
        return "viscosity"

    def lacks(self, scene: SeparationScene) -> tuple[str, ...]:
        """See `Effect.lacks`."""
        return rim_needs(scene)

    def prepare(self, prepared: PreparedScene[SeparationScene]) -> ForceLaw:
        """See `SeparationForce.prepare`."""
        film = prepared.film
        factor = film.menisci * self.trouton_ratio * prepared.liquid.viscosity / film.volume

        def force(gap: float, speed: float) -> float:
            area = math.pi * film.radius(gap) ** 2
            return factor * area * area * speed

        return ForceLaw(force, rate="proportional")

    def validity(
        self, plan: PlanView, path: Sequence[tuple[float, float]]
    ) -> tuple[ValidityNumber, ...]:
        """See `SeparationEffect.validity`: a sum of two limits is a fit where neither is near."""
        film = plan.prepared.film
        slender = [_slenderness(film, gap) for gap, _ in path]
        between = max((min(x, 1.0 / x) for x in slender if x > 0.0), default=0.0)
        return (
            ValidityNumber(
                name="column between thin film and thread",
                value=between,
                high=0.5,
                detail="the sum of viscous and extensional force is exact for a thin film (r >> h) "
                "and for a thread (r << h), and a fit between",
                source="r/h or h/r, the smaller; Spiegelberg, Ables and McKinley 1996",
            ),
        )


def _slenderness(film: FilmShape, gap: float) -> float:
    """Radius of the mean column over its height [-]: r/(V/A)."""
    r = film.radius(gap)
    return math.pi * r**3 / film.volume
