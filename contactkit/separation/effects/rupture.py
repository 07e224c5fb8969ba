"""Rupture of the film: at a given gap, or where the bridge loses stability."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any, ClassVar, Literal

from attrs import Attribute, field, frozen

from ...capillary.arc import flat as arc_flat
from ...errors import DescriptionError
from ...units import si
from ...validators import positive, refuse
from .base import FilmEnd
from .meniscus import MeniscusForce
from .meniscus_flat import exact_end

if TYPE_CHECKING:
    from ...as_published.arguments import PublishedValue
    from ...scene.scenes import SeparationScene
    from .base import PlanView
    from .prepared import PreparedScene

__all__ = ["Rupture"]

_JUST_BELOW = 1.0 - 1e-6  # of the gap at which a bridge ends


def _gap(owner: object, attribute: Attribute[Any], value: Any) -> None:
    if value in ("limit", "zero-neck"):
        return
    try:
        positive(owner, attribute, value)
    except DescriptionError as error:
        expected = f"{error.expected}, 'limit' or 'zero-neck'"
        raise refuse(owner, attribute, value, expected, error.hint) from None


@frozen(kw_only=True)
class Rupture(FilmEnd):
    """The film breaks at a gap, and with it end both the meniscus and the viscous force.

    Parameters
    ----------
    gap : float, "limit" or "zero-neck"
        Break distance [m], for example measured. ``"limit"``: where the exact bridge of this
        volume (or pressure) loses stability. ``"zero-neck"``: where the neck of the arc vanishes,
        as published; 1.4 to 15 times too far, for reproduction.

    Notes
    -----
    The limit is that of a bridge in equilibrium whose contact lines are free to move. A film that
    is drawn out fast, or pinned, breaks later. `MeniscusForce` ends there of itself; listed beside
    a viscous force alone, this effect ends that too.
    """

    name: ClassVar[str] = "rupture"
    summary: ClassVar[str] = "the film breaks at a gap"
    takes_pressure: ClassVar[bool] = True
    published_choice: ClassVar[str] = "gap"

    gap: float | Literal["limit", "zero-neck"] = field(
        default="limit", validator=_gap, metadata=si("m")
    )

    @property
    def sources(self) -> tuple[str, ...]:
        """See `Effect.sources`."""
        if self.gap == "limit":
            return (
                "stability of the axisymmetric bridge: fold, tilt or detachment; Vogel 1987, "
                "Lowry and Steen 1995",
            )
        if self.gap == "zero-neck":
            return (
                "zero neck of the arc, section 3.2.1.4 of Cai and Bhushan 2007a: an upper bound",
            )
        return ("break distance given with the scene, own choice",)

    def liquid_needs(self, scene: SeparationScene) -> tuple[str, ...]:
        """See `Effect.liquid_needs`."""
        at_pressure = isinstance(self.gap, str) and scene.meniscus.has_pressure
        return ("surface_tension",) if at_pressure else ()

    def lacks(self, scene: SeparationScene) -> tuple[str, ...]:
        """See `Effect.lacks`."""
        meniscus = scene.meniscus
        if not isinstance(self.gap, str) or meniscus.volume is not None:
            return ()
        if scene.meniscus.has_pressure and self.gap == "limit":
            return ()
        return ("interface.meniscus.volume [m3] (or Rupture.gap [m])",)

    def prepare(self, prepared: PreparedScene[SeparationScene]) -> float:
        """See `FilmEnd.prepare`."""
        if isinstance(self.gap, str):
            return _limit(prepared) if self.gap == "limit" else _zero_neck(prepared)
        start = prepared.scene.loading.initial_gap
        if self.gap <= start:
            expected = f"exceed initial_gap = {start:g} m"
            raise DescriptionError("Rupture.gap", self.gap, expected, unit="m")
        return self.gap

    def rimless_radius(self, prepared: PreparedScene[SeparationScene], gap: float) -> float:
        """See `SeparationEffect.rimless_radius`: the contact circle where the bridge ends."""
        if not isinstance(self.gap, str):
            return 0.0
        from .meniscus_sphere import contact_radius

        profile = "exact" if self.gap == "limit" else "arc"
        return contact_radius(prepared, profile, self.prepare(prepared) * _JUST_BELOW)

    def takes_printed(self) -> bool:
        """See `SeparationEffect.takes_printed`: the zero neck of the source is the arc's end."""
        return self.gap == "zero-neck"

    def equations(self, scene: SeparationScene) -> str:
        """See `SeparationEffect.equations`.

        The zero neck is the end of the arc, and alone a bound; it does not go with the exact
        bridge, nor the exact limit with printed forces.
        """
        if not isinstance(self.gap, str):
            return ""
        if not self.takes_printed():
            return "consistent"
        meniscus = scene.effect(MeniscusForce)
        return "as-published" if meniscus is not None and meniscus.form == "exact" else ""

    def errata(self, plan: PlanView) -> tuple[PublishedValue, ...]:
        """See `SeparationEffect.errata`."""
        if not self.takes_printed():
            return ()
        from ...as_published.lookup import published

        prepared = plan.prepared
        angles, curvatures = prepared.angles, prepared.curvatures
        made = published(
            "zero neck",
            volume=prepared.film.volume,
            angle_lower=angles.lower,
            angle_upper=angles.upper,
            curvature_lower=curvatures.lower,
            curvature_upper=curvatures.upper,
        )
        return (made._replace(name=f"{self.name}, {made.name}"),)


def _limit(prepared: PreparedScene[SeparationScene]) -> float:
    """Gap [m] at which the exact bridge ends."""
    if prepared.scene.interface.is_flat:
        return exact_end(prepared)
    from . import meniscus_sphere

    return meniscus_sphere.exact_end(prepared)


def _zero_neck(prepared: PreparedScene[SeparationScene]) -> float:
    """Gap [m] at which the neck of the arc closes."""
    film, angles = prepared.film, prepared.angles
    if math.isinf(film.sphere_radius):
        return float(arc_flat.zero_neck_gap(arc_flat.shape(*angles), film.volume))
    from ...capillary.arc import sphere as arc_sphere

    return float(arc_sphere.zero_neck_gap(film.volume, *angles, *prepared.curvatures))
