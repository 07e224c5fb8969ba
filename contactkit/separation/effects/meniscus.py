"""The meniscus force: what the curved surface of the liquid makes it pull, or push."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, ClassVar, Literal

from attrs import field, frozen

from ...as_published.printed import common as published
from ...scene.surfaces import Sphere
from ...validators import choice
from .base import ForceLaw, SeparationForce
from .film_shape import film_shape, needs_extent
from .meniscus_flat import arc_law, exact_law, surface_tension

if TYPE_CHECKING:
    from ...accuracy import Accuracy
    from ...scene.scenes import SeparationScene

__all__ = ["MeniscusForce"]


@frozen(kw_only=True)
class MeniscusForce(SeparationForce):
    """Pull of the Laplace pressure and of the surface tension at the rim of the meniscus.

    Parameters
    ----------
    profile : {"exact", "arc", "as-published"}
        ``"exact"``: the axisymmetric solution of the Young-Laplace equation at the volume (or the
        pressure) of the meniscus, up to the gap at which it loses stability; any contact angles.
        ``"arc"``: an arc of a circle that keeps its volume, a fast model; one force, taken through
        its neck or belly, on both bodies. ``"as-published"``: Eq. (3.11) between flats and Eq.
        (3.12) on a sphere as printed, known to be wrong (their errata are listed by
        `plan.cite()`), for reproduction only.
    pulled : {"lower", "upper"}
        Body whose contact angle enters the line tension of Eq. (3.11); as-published only.

    Notes
    -----
    The exact bridge stands in a curve: its error is a tenth of ``Accuracy.time_rtol`` of what the
    curvatures of the rim would pull. Gravity, a contact angle that depends on the direction of
    motion, and shapes that are not round are left out.

    Against it the arc is within 0.7 % up to a tenth of the stability limit, 4 % to a third, 7 %
    to nine tenths (equal angles below 90 degrees); mixed angles are worse where the gap is not
    small against the radius, -12 % at a radius of two gaps for 60/120 degrees. The arc has no
    fold: it ends where its neck vanishes, 1.4 to 15 times beyond the exact limit.
    """

    name: ClassVar[str] = "meniscus-force"
    summary: ClassVar[str] = "capillary force of the meniscus"
    column: ClassVar[str] = "meniscus_force"
    takes_pressure: ClassVar[bool] = True

    profile: Literal["exact", "arc", "as-published"] = field(
        default="exact", validator=choice("exact", "arc", "as-published")
    )
    pulled: Literal["lower", "upper"] = field(default="lower", validator=choice("lower", "upper"))

    @property
    def sources(self) -> tuple[str, ...]:
        """See `Effect.sources`."""
        if self.profile == "exact":
            return (
                "Young-Laplace equation, Eq. (3.1), by Delaunay's surfaces; Orr, Scriven and "
                "Rivas 1975",
            )
        if self.profile == "arc":
            return (
                "arc of Eqs. (3.38)-(3.41) of Cai and Bhushan 2008a, force through its neck plane",
            )
        return tuple(
            f"Eq. ({number}) of Cai and Bhushan 2007a, as printed; {published.ERRATA[number]}"
            for number in ("3.11", "3.12")
        )

    def cites(self, scene: SeparationScene) -> tuple[str, ...]:
        """See `SeparationEffect.cites`."""
        if self.profile != "as-published":
            return self.sources
        flats, sphere = self.sources
        return (flats,) if scene.interface.is_flat else (sphere,)

    def lacks(self, scene: SeparationScene) -> tuple[str, ...]:
        """See `SeparationEffect.lacks`."""
        meniscus = scene.meniscus
        missing: tuple[str, ...] = ()
        if meniscus.liquid.at(scene.temperature).surface_tension is None:
            missing += ("liquid.surface_tension [N/m]",)
        if scene.liquid_pressure is not None:
            return missing + self._lacks_at_pressure(scene)
        if not scene.interface.is_flat and meniscus.volume is None:
            missing += ("interface.meniscus.volume [m3]: a bath around a sphere has no meniscus",)
        if self.profile == "as-published" and isinstance(scene.interface.lower.surface, Sphere):
            missing += ("the sphere as the upper body: Eq. (3.12) is printed for that",)
        return missing + needs_extent(scene)

    def _lacks_at_pressure(self, scene: SeparationScene) -> tuple[str, ...]:
        missing: tuple[str, ...] = ()
        if self.profile != "exact":
            missing += ('profile="exact" at a fixed pressure (or interface.meniscus.volume [m3])',)
        if scene.interface.is_flat:
            missing += (
                "interface.meniscus.volume [m3] between flats: at a fixed pressure the liquid "
                "there fills the gap or dries up",
            )
        return missing

    def prepare(self, scene: SeparationScene, accuracy: Accuracy) -> ForceLaw:
        """See `SeparationForce.prepare`."""
        if not scene.interface.is_flat:
            from .meniscus_sphere import sphere_law

            return sphere_law(scene, accuracy, self.profile)
        if self.profile == "as-published":
            return self._published(scene)
        return exact_law(scene, accuracy) if self.profile == "exact" else arc_law(scene)

    def _published(self, scene: SeparationScene) -> ForceLaw:
        meniscus, film = scene.meniscus, film_shape(scene)
        tension = surface_tension(scene)
        n, radius = film.menisci, film.radius
        lower, upper, pulled = (
            meniscus.contact_angle_lower,
            meniscus.contact_angle_upper,
            self.pulled,
        )

        def force(gap: float, speed: float) -> float:
            one = published.meniscus_flat_3_11(radius(gap), gap, tension, lower, upper, pulled)
            return n * float(one)

        kinks = (film.full_gap,) if 0.0 < film.full_gap < math.inf else ()
        return ForceLaw(force, kinks)
