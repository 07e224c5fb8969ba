"""The meniscus force: what the curved surface of the liquid makes it pull, or push."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, ClassVar, Literal

from attrs import field, frozen

from ..checks import choice
from ..kernels import arc_flat, published
from ..kernels.roots import bracketed_root
from ..surfaces import Sphere
from .base import ForceLaw, SeparationForce
from .film_shape import film_shape, needs_extent

if TYPE_CHECKING:
    from ..accuracy import Accuracy
    from ..scene import SeparationScene

__all__ = ["MeniscusForce"]


@frozen(kw_only=True)
class MeniscusForce(SeparationForce):
    """Pull of the Laplace pressure and of the surface tension at the rim of the meniscus.

    Parameters
    ----------
    profile : {"arc", "as-published"}
        ``"arc"``: the meniscus is an arc of a circle that keeps its volume; one force, taken
        through its neck or belly, on both bodies; any contact angles. ``"as-published"``: Eq.
        (3.11) between flats and Eq. (3.12) on a sphere as printed, known to be wrong (their
        errata are listed by `plan.cite()`), for reproduction only.
    pulled : {"lower", "upper"}
        Body whose contact angle enters the line tension of Eq. (3.11); as-published only.

    Notes
    -----
    Against the exact bridge the arc is within 0.7 % up to a tenth of the stability limit, 4 % to
    a third, 7 % to nine tenths (equal angles below 90 degrees); mixed angles are worse where the
    gap is not small against the radius, -12 % at a radius of two gaps for 60/120 degrees. The
    arc has no fold: it ends where its neck vanishes, 1.4 to 15 times beyond the exact limit.
    """

    name: ClassVar[str] = "meniscus-force"
    summary: ClassVar[str] = "capillary force of the meniscus"

    profile: Literal["arc", "as-published"] = field(
        default="arc", validator=choice("arc", "as-published")
    )
    pulled: Literal["lower", "upper"] = field(default="lower", validator=choice("lower", "upper"))

    @property
    def sources(self) -> tuple[str, ...]:
        """See `Effect.sources`."""
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
        if self.profile == "arc":
            return self.sources
        flats, sphere = self.sources
        return (flats,) if scene.interface.is_flat else (sphere,)

    def lacks(self, scene: SeparationScene) -> tuple[str, ...]:
        """See `SeparationEffect.lacks`."""
        meniscus = scene.interface.meniscus
        missing: tuple[str, ...] = ()
        if meniscus.liquid.at(scene.temperature).surface_tension is None:
            missing += ("liquid.surface_tension [N/m]",)
        if not scene.interface.is_flat and meniscus.volume is None:
            missing += ("interface.meniscus.volume [m3]: a bath around a sphere has no meniscus",)
        if self.profile == "as-published" and isinstance(scene.interface.lower, Sphere):
            missing += ("the sphere as the upper body: Eq. (3.12) is printed for that",)
        return missing + needs_extent(scene)

    def prepare(self, scene: SeparationScene, accuracy: Accuracy) -> ForceLaw:
        """See `SeparationForce.prepare`."""
        if not scene.interface.is_flat:
            from .meniscus_sphere import sphere_law

            return sphere_law(scene, accuracy, as_published=self.profile == "as-published")
        return self._published(scene) if self.profile == "as-published" else _arc_law(scene)

    def _published(self, scene: SeparationScene) -> ForceLaw:
        meniscus, film = scene.interface.meniscus, film_shape(scene)
        tension = _surface_tension(scene)
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


def _surface_tension(scene: SeparationScene) -> float:
    tension = scene.interface.meniscus.liquid.at(scene.temperature).surface_tension
    assert tension is not None  # plan() has asked lacks() first
    return tension


def _arc_law(scene: SeparationScene) -> ForceLaw:
    """Arc between flats: free at constant volume, or pinned at the rim of the faces."""
    meniscus, film = scene.interface.meniscus, film_shape(scene)
    n, volume, rim, tension = film.menisci, film.volume, film.rim, _surface_tension(scene)
    arc = arc_flat.shape(meniscus.contact_angle_lower, meniscus.contact_angle_upper)
    free, pinned = math.isfinite(volume), math.isfinite(rim)
    pinned_end = arc_flat.zero_neck_gap_at_rim(arc, rim) if pinned else math.inf
    free_end = float(arc_flat.zero_neck_gap(arc, volume)) if free else math.inf
    full_gap = _full_gap(arc, volume, rim, min(free_end, pinned_end)) if free and pinned else 0.0
    if not free:
        full_gap = math.inf
    end = pinned_end if full_gap >= pinned_end else free_end
    last = end * (1.0 - 1e-12)  # a trial step may look beyond the end: the force stays as there

    def force(gap: float, speed: float) -> float:
        gap = min(gap, last)
        radius = (
            arc_flat.rim_contact_radius(arc, gap, rim)
            if gap < full_gap
            else arc_flat.contact_radius(arc, gap, volume)
        )
        return n * tension * float(arc_flat.force(arc, gap, radius))

    kinks = (full_gap,) if 0.0 < full_gap < end else ()
    return ForceLaw(force, kinks, end=end)


def _full_gap(arc: arc_flat.ArcShape, volume: float, rim: float, end: float) -> float:
    """Gap [m] below which an arc of this volume reaches the rim of the faces; inf for always."""

    def excess(gap: float) -> float:
        at_rim = arc_flat.rim_contact_radius(arc, gap, rim)
        return float(arc_flat.volume(arc, gap, at_rim)) / volume - 1.0

    last = end * (1.0 - 1e-9)
    low = high = min(volume / (math.pi * rim * rim), last)
    while excess(low) > 0.0:
        low *= 0.5
    while excess(high) < 0.0:
        if high >= last:
            return math.inf
        high = min(2.0 * high, last)
    return bracketed_root(excess, low, high)
