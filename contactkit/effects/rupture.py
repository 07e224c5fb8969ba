"""Where the film breaks."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, ClassVar, Literal

from attrs import field, frozen

from ..checks import choice, optional, positive
from ..errors import DescriptionError
from ..kernels import arc_flat
from ..units import si
from .base import FilmEnd
from .film_shape import film_shape

if TYPE_CHECKING:
    from ..accuracy import Accuracy
    from ..scene import SeparationScene

__all__ = ["Rupture"]


@frozen(kw_only=True)
class Rupture(FilmEnd):
    """The film breaks at a gap, and with it end both the meniscus and the viscous force.

    Parameters
    ----------
    gap : float, optional
        Break distance [m], for example measured. None: by `criterion`.
    criterion : {"zero-neck"}
        Where the neck of the arc vanishes, as published. This is an upper bound: the exact
        bridge loses stability at a gap 1.4 to 15 times smaller.
    """

    name: ClassVar[str] = "rupture"
    summary: ClassVar[str] = "the film breaks at a gap"

    gap: float | None = field(default=None, validator=optional(positive), metadata=si("m"))
    criterion: Literal["zero-neck"] = field(default="zero-neck", validator=choice("zero-neck"))

    @property
    def sources(self) -> tuple[str, ...]:
        """See `Effect.sources`."""
        if self.gap is not None:
            return ("break distance given with the scene",)
        return ("zero neck of the arc, section 3.2.1.4 of Cai and Bhushan 2007a: an upper bound",)

    def lacks(self, scene: SeparationScene) -> tuple[str, ...]:
        """See `SeparationEffect.lacks`."""
        if self.gap is None and scene.interface.meniscus.volume is None:
            return ("interface.meniscus.volume [m3] (or Rupture.gap [m])",)
        return ()

    def prepare(self, scene: SeparationScene, accuracy: Accuracy) -> float:
        """See `FilmEnd.prepare`."""
        if self.gap is not None:
            if self.gap <= scene.opening.initial_gap:
                raise DescriptionError(
                    "Rupture.gap",
                    self.gap,
                    f"exceed initial_gap = {scene.opening.initial_gap:g} m",
                    unit="m",
                )
            return self.gap
        meniscus, film = scene.interface.meniscus, film_shape(scene)
        angles = (meniscus.contact_angle_lower, meniscus.contact_angle_upper)
        if math.isinf(film.sphere_radius):
            return float(arc_flat.zero_neck_gap(arc_flat.shape(*angles), film.volume))
        from ..kernels import arc_sphere

        interface = scene.interface
        return float(
            arc_sphere.zero_neck_gap(
                film.volume, *angles, interface.lower.curvature, interface.upper.curvature
            )
        )
