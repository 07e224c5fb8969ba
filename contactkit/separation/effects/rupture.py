"""Where the film breaks."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, ClassVar, Literal

from attrs import field, frozen

from ...capillary.arc import flat as arc_flat
from ...errors import DescriptionError
from ...units import si
from ...validators import choice, optional, positive
from .base import FilmEnd
from .film_shape import film_shape
from .meniscus_flat import exact_end

if TYPE_CHECKING:
    from ...accuracy import Accuracy
    from ...scene.scenes import SeparationScene

__all__ = ["Rupture"]


@frozen(kw_only=True)
class Rupture(FilmEnd):
    """The film breaks at a gap, and with it end both the meniscus and the viscous force.

    Parameters
    ----------
    gap : float, optional
        Break distance [m], for example measured. None: by `criterion`.
    criterion : {"limit", "zero-neck"}
        ``"limit"``: where the exact bridge of this volume (or pressure) loses stability.
        ``"zero-neck"``: where the neck of the arc vanishes, as published; 1.4 to 15 times too
        far, for reproduction.

    Notes
    -----
    The limit is that of a bridge in equilibrium whose contact lines are free to move. A film that
    is drawn out fast, or pinned, breaks later. `MeniscusForce` ends there of itself; listed beside
    a viscous force alone, this effect ends that too.
    """

    name: ClassVar[str] = "rupture"
    summary: ClassVar[str] = "the film breaks at a gap"
    takes_pressure: ClassVar[bool] = True

    gap: float | None = field(default=None, validator=optional(positive), metadata=si("m"))
    criterion: Literal["limit", "zero-neck"] = field(
        default="limit", validator=choice("limit", "zero-neck")
    )

    @property
    def sources(self) -> tuple[str, ...]:
        """See `Effect.sources`."""
        if self.gap is not None:
            return ("break distance given with the scene",)
        if self.criterion == "limit":
            return (
                "stability of the axisymmetric bridge: fold, tilt or detachment; Vogel 1987, "
                "Lowry and Steen 1995",
            )
        return ("zero neck of the arc, section 3.2.1.4 of Cai and Bhushan 2007a: an upper bound",)

    def lacks(self, scene: SeparationScene) -> tuple[str, ...]:
        """See `SeparationEffect.lacks`."""
        meniscus = scene.meniscus
        if self.gap is not None or meniscus.volume is not None:
            return ()
        if scene.liquid_pressure is not None and self.criterion == "limit":
            return ()
        return ("interface.meniscus.volume [m3] (or Rupture.gap [m])",)

    def prepare(self, scene: SeparationScene, accuracy: Accuracy) -> float:
        """See `FilmEnd.prepare`."""
        if self.gap is not None:
            if self.gap <= scene.loading.initial_gap:
                raise DescriptionError(
                    "Rupture.gap",
                    self.gap,
                    f"exceed initial_gap = {scene.loading.initial_gap:g} m",
                    unit="m",
                )
            return self.gap
        return _limit(scene) if self.criterion == "limit" else _zero_neck(scene)


def _limit(scene: SeparationScene) -> float:
    """Gap [m] at which the exact bridge ends."""
    if scene.interface.is_flat:
        return exact_end(scene)
    from . import meniscus_sphere

    return meniscus_sphere.exact_end(scene)


def _zero_neck(scene: SeparationScene) -> float:
    """Gap [m] at which the neck of the arc closes."""
    meniscus, film = scene.meniscus, film_shape(scene)
    angles = (meniscus.contact_angle_lower, meniscus.contact_angle_upper)
    if math.isinf(film.sphere_radius):
        return float(arc_flat.zero_neck_gap(arc_flat.shape(*angles), film.volume))
    from ...capillary.arc import sphere as arc_sphere

    return float(arc_sphere.zero_neck_gap(film.volume, *angles, *scene.interface.curvatures))
