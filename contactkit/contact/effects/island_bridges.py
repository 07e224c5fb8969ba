"""Exact bridges on the islands of a rough contact: each wetted summit has one of its own."""

from __future__ import annotations

import math
import warnings
from typing import TYPE_CHECKING, Any, ClassVar, Literal, NamedTuple

from attrs import Attribute, field, frozen

from ...errors import ValidityWarning
from ...units import si
from ...validators import choice, optional, positive, refuse
from .base import Contact, Observer

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    from ...scene.contact_scene import ContactScene

    Floats = NDArray[np.float64]

__all__ = ["IslandBridges", "IslandPart", "scalars_of"]


class IslandPart(NamedTuple):
    """Meniscus force [N] of bridges on islands, and what it is made of; arrays by island, (n,).

    `law` names what was used. `area` is that of the islands without contact [m2], `n_dry` the
    number of islands that no bridge of this liquid spans, which are in no array. `cover` is the
    sum of the contact circles over the window [-], `n_overlapping` the number of bridges whose
    circles overlap with a neighbour's: their forces are no longer each other's strangers.
    `largest_share` is the largest island over the window [-]; from a tenth on it is no summit any
    more. `point` (n, 2) are the summits (y, x), `gap` their gaps, `radius` those of the spheres
    that stand for them, `contact_radius` the larger contact radius of each bridge [m]; `volume`
    [m3], `forces` [N].
    """

    law: str
    force: float
    relative_force: float
    area: float
    n_menisci: int
    n_dry: int
    cover: float
    n_overlapping: int
    largest_share: float
    point: Floats
    gap: Floats
    radius: Floats
    contact_radius: Floats
    volume: Floats
    forces: Floats
    is_meniscus: NDArray[np.bool_]


_WIDEST = 0.25  # of the window, an island of menisci that have joined


def _connectivity(owner: object, attribute: Attribute[int], value: int) -> None:
    if value not in (4, 8):
        raise refuse(owner, attribute, value, "be 4 or 8 neighbours")


@frozen(kw_only=True)
class IslandBridges(Observer):
    """A bridge on each island of the deformed gap that holds liquid, and the sum of their forces.

    The liquid comes from a film of given thickness, or condenses to the pressure of the meniscus
    (`Meniscus.from_humidity`). It does not act back on the contact.

    Parameters
    ----------
    film_thickness : float, optional
        Thickness of a film on the surface [m]; an island that dips into it gathers the film of
        its area. None: the meniscus has a pressure, and every island is wet.
    meniscus_height : float, optional
        Gap up to which an island reaches [m]. None: the thickness of the film, or the height of
        a thin meniscus of the pressure, ``gamma (cos + cos)/|p|``.
    curvature : {"island", "summit"}
        Radius of the sphere that stands for an island: the one whose cut at the meniscus height
        has the open area of the island; or that of the highest point of the undeformed heights,
        which depends on the pixel.
    connectivity : int
        Whether pixels join an island across edges (4) or across corners too (8).

    Notes
    -----
    A wide island that is no summit, and a bridge around a flattened contact, are taken for round
    ones under a sphere all the same. With ``"island"`` and thin bridges the sum is that of Eq.
    (2.43) on the same islands; it differs by the pull of the rims, the curvature around the axis
    and the volume.
    """

    name: ClassVar[str] = "island-bridges"
    summary: ClassVar[str] = "an exact bridge on each wet island of a rough contact"

    film_thickness: float | None = field(
        default=None, validator=optional(positive), metadata=si("m")
    )
    meniscus_height: float | None = field(
        default=None, validator=optional(positive), metadata=si("m")
    )
    curvature: Literal["island", "summit"] = field(
        default="island", validator=choice("island", "summit")
    )
    connectivity: Literal[4, 8] = field(default=8, validator=_connectivity, metadata=si("-"))

    @property
    def sources(self) -> tuple[str, ...]:
        """See `Effect.sources`."""
        return (
            "islands of a film on a rough contact, section 2.2 (Tian and Bhushan 1996)",
            "exact bridge on a sphere (Young-Laplace) on each, Orr, Scriven and Rivas 1975",
        )

    def lacks(self, scene: ContactScene) -> tuple[str, ...]:
        """See `ContactEffect.lacks`."""
        meniscus = scene.interface.meniscus
        if meniscus is None:
            return ("interface.meniscus (the liquid and its contact angles)",)
        lacking = []
        if meniscus.liquid.at(scene.temperature).surface_tension is None:
            lacking.append("interface.meniscus.liquid.surface_tension [N/m]")
        if meniscus.volume is not None:
            lacking.append("interface.meniscus.volume [m3] left out: the islands set the volumes")
        if (meniscus.pressure is None) == (self.film_thickness is None):
            lacking.append("either film_thickness [m] or interface.meniscus.pressure [Pa]")
        angles = meniscus.contact_angle_lower + meniscus.contact_angle_upper
        if meniscus.pressure is not None and angles >= math.pi:
            lacking.append(
                "contact angles that add up to less than 180 deg: nothing condenses between others"
            )
        return tuple(lacking)

    def observe(self, contact: Contact) -> IslandPart:
        """See `Observer.observe`."""
        from .zz_island_law import bridges_of

        part = bridges_of(self, contact)
        if contact.grid.periodic and part.largest_share > _WIDEST:
            warnings.warn(
                f"the largest island covers {100.0 * part.largest_share:.0f} % of the window: the "
                "menisci have joined, and one bridge under a sphere is no model of it; use "
                "FilmMeniscus, or a thinner film",
                ValidityWarning,
                stacklevel=2,
            )
        return part

    def at_pressure(self, contact: Contact, pressure: float) -> IslandPart:
        """Return the same for a pressure [Pa], in place of that of the scene or of a film."""
        from .zz_island_law import bridges_of

        return bridges_of(self, contact, pressure)


def scalars_of(part: Any) -> dict[str, tuple[float, str]]:
    """Numbers for tables, each with its unit."""
    return {
        "island_force": (part.force, "N"),
        "relative_island_force": (part.relative_force, "-"),
        "island_area": (part.area, "m2"),
        "n_island_bridges": (part.n_menisci, "-"),
        "n_dry_islands": (part.n_dry, "-"),
        "island_cover": (part.cover, "-"),
        "n_overlapping": (part.n_overlapping, "-"),
    }
