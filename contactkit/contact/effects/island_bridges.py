"""Meniscus force of a rough contact: an exact bridge on each wet island of the gap."""

from __future__ import annotations

import math
from operator import attrgetter
from typing import TYPE_CHECKING, ClassVar, Literal, NamedTuple

import numpy as np
from attrs import Attribute, field, frozen

from ...capillary import island_bridges as kernel
from ...capillary.film_islands import islands, meniscus_area
from ...capillary.kelvin import meniscus_height, radius_number
from ...units import si
from ...validators import choice, optional, positive, refuse
from ...validity import ValidityNumber
from .base import Array, Observer, Scalar, SolvedContact

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from ...scene.scenes import ContactScene

    Floats = NDArray[np.float64]
    Mask = NDArray[np.bool_]

_BRIDGES = ("bridge",)

__all__ = ["IslandBridges", "IslandPart", "bridges_of"]


class _Wetting(NamedTuple):
    """How islands hold liquid.

    Surface tension [N/m], contact angles [rad], thickness of the film [m] (0 where liquid
    condenses), pressure of the liquid [Pa] (None for a film), and the gap up to which an island
    reaches [m].
    """

    tension: float
    angles: tuple[float, float]
    film_thickness: float
    pressure: float | None
    height: float


class IslandPart(NamedTuple):
    """Meniscus force [N] of bridges on islands, and its contributions; arrays by island, (n,).

    `law` names the models used. `area` is that of the islands without contact [m2], `n_dry` the
    number of islands that no bridge of this liquid spans, which are in no array. `coverage` is the
    sum of the contact circles over the window [-], `n_overlapping` the number of bridges whose
    circles overlap with a neighbour's, so that their forces are no longer independent.
    `largest_fraction` is the largest island over the window [-]; from a tenth on it is no summit
    any more. `point` (n, 2) are the summits (y, x), `gap` their gaps, `radius` those of the spheres
    that stand for them, `contact_radius` the larger contact radius of each bridge [m]; `volume`
    [m3], `forces` [N].
    """

    law: str
    force: float
    relative_force: float
    area: float
    n_menisci: int
    n_dry: int
    coverage: float
    n_overlapping: int
    largest_fraction: float
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
class IslandBridges(Observer[IslandPart]):
    """A bridge on each island of the deformed gap that holds liquid, and the sum of their forces.

    The liquid comes from a film of given thickness, or condenses to the pressure of the meniscus
    (`Meniscus.relative_humidity`). It does not act back on the contact.

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
    A wide island that is no summit, and a bridge around a flattened contact, are approximated by
    round ones under a sphere. With ``"island"`` and thin bridges the sum is that of Eq.
    (2.43) on the same islands; it differs by the pull of the rims, the curvature around the axis
    and the volume.
    """

    takes_anisotropy: ClassVar[bool] = True
    name: ClassVar[str] = "island-bridges"
    summary: ClassVar[str] = "an exact bridge on each wet island of a rough contact"
    takes_tension: ClassVar[bool] = False
    records: ClassVar[tuple[type, ...]] = (IslandPart,)
    arrays: ClassVar[tuple[Array, ...]] = (
        Array("meniscus", "-", attrgetter("is_meniscus")),
        Array("bridge_y", "m", lambda part: part.point[:, 0], _BRIDGES),
        Array("bridge_x", "m", lambda part: part.point[:, 1], _BRIDGES),
        Array("bridge_gap", "m", attrgetter("gap"), _BRIDGES),
        Array("bridge_radius", "m", attrgetter("radius"), _BRIDGES),
        Array("bridge_contact_radius", "m", attrgetter("contact_radius"), _BRIDGES),
        Array("bridge_volume", "m3", attrgetter("volume"), _BRIDGES),
        Array("bridge_force", "N", attrgetter("forces"), _BRIDGES),
    )
    scalars: ClassVar[tuple[Scalar, ...]] = (
        Scalar("island_force", "N", attrgetter("force")),
        Scalar("relative_island_force", "-", attrgetter("relative_force")),
        Scalar("island_area", "m2", attrgetter("area")),
        Scalar("n_island_bridges", "-", attrgetter("n_menisci")),
        Scalar("n_dry_islands", "-", attrgetter("n_dry")),
        Scalar("island_coverage", "-", attrgetter("coverage")),
        Scalar("n_overlapping", "-", attrgetter("n_overlapping")),
    )

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

    def liquid_needs(self, scene: ContactScene) -> tuple[str, ...]:
        """See `Effect.liquid_needs`."""
        return ("surface_tension",)

    @property
    def sources(self) -> tuple[str, ...]:
        """See `Effect.sources`."""
        return (
            "islands of a film on a rough contact, section 2.2 of Cai 2008; Tian and Bhushan 1996",
            "exact bridge on a sphere (Young-Laplace) on each, Orr, Scriven and Rivas 1975",
        )

    def lacks(self, scene: ContactScene) -> tuple[str, ...]:
        """See `ContactEffect.lacks`."""
        meniscus = scene.interface.meniscus
        if meniscus is None:
            return ("interface.meniscus (the liquid and its contact angles)",)
        lacking = []
        if meniscus.volume is not None:
            lacking.append("interface.meniscus.volume [m3] left out: the islands set the volumes")
        if meniscus.has_pressure is not (self.film_thickness is None):
            lacking.append("either film_thickness [m] or interface.meniscus.pressure [Pa]")
        angles = meniscus.contact_angle_lower + meniscus.contact_angle_upper
        if meniscus.has_pressure and angles >= math.pi:
            lacking.append(
                "contact angles that add up to less than 180 deg: nothing condenses between others"
            )
        return tuple(lacking)

    def observe(self, contact: SolvedContact) -> IslandPart:
        """See `Observer.observe`."""
        return bridges_of(self, contact)

    def validity(self, contact: SolvedContact, part: IslandPart) -> tuple[ValidityNumber, ...]:
        """See `ContactEffect.validity`."""
        meniscus = contact.scene.meniscus
        condensed: tuple[ValidityNumber, ...] = ()
        if meniscus.relative_humidity is not None:
            liquid = meniscus.liquid.at(contact.scene.temperature)
            pressure = meniscus.pressure_of(liquid) or -math.inf
            condensed = (radius_number(-liquid.surface_tension / pressure),)
        if not contact.grid.periodic:
            return condensed
        return (
            *condensed,
            ValidityNumber(
                name="largest island over the window",
                value=part.largest_fraction,
                high=_WIDEST,
                detail="the menisci have joined, and one bridge under a sphere is no model of it; "
                "use FilmMeniscus, or a thinner film",
            ),
        )

    def at_pressure(self, contact: SolvedContact, pressure: float) -> IslandPart:
        """Return the same for a pressure [Pa], in place of that of the scene or of a film."""
        return bridges_of(self, contact, pressure)


def bridges_of(
    effect: IslandBridges, contact: SolvedContact, pressure: float | None = None
) -> IslandPart:
    """Find the islands, put a bridge on each, and add up their forces."""
    wetting = _wetting(effect, contact, pressure)
    wet = _wet(contact, wetting, effect.connectivity)
    names, n = islands(wet, contact.grid.edges, effect.connectivity)
    touching, grid = contact.pressure > 0.0, contact.grid
    heights = contact.displacement - contact.gap  # undeformed, but for a constant
    found = kernel.measure_islands(names, n, contact.gap, touching, heights, grid.pixel_area)
    curvature = kernel.curvature_of_area(found, wetting.height)
    if effect.curvature == "summit":
        own = kernel.summit_curvature(heights, found.summit, grid.pixel_size, grid.repeats)
        # A pixel that is no summit, such as the edge of a ridge, has none of its own.
        curvature = np.where((own > 0.0) & np.isfinite(curvature), own, curvature)
    state = _bridges(found.gap, found.area * wetting.film_thickness, curvature, wetting)
    return _part(effect, contact, wetting, wet & ~touching, found, curvature, state)


def _wetting(effect: IslandBridges, contact: SolvedContact, pressure: float | None) -> _Wetting:
    meniscus, tension = contact.scene.meniscus, contact.liquid.surface_tension
    angles = (meniscus.contact_angle_lower, meniscus.contact_angle_upper)
    if pressure is None:
        pressure = meniscus.pressure_of(contact.liquid)
    thickness = effect.film_thickness or 0.0
    if effect.meniscus_height is not None:
        height = effect.meniscus_height
    elif pressure is None:
        height = thickness
    else:
        cosines = math.cos(angles[0]) + math.cos(angles[1])
        height = float(meniscus_height(pressure, tension, cosines))
    return _Wetting(tension, angles, thickness, pressure, height)


def _wet(contact: SolvedContact, wetting: _Wetting, connectivity: Literal[4, 8]) -> Mask:
    """Pixels of islands that hold liquid, contact included."""
    cut = np.asarray(contact.gap < wetting.height)
    if wetting.pressure is not None:
        return cut
    no_contact = np.zeros_like(cut)
    return meniscus_area(
        contact.gap,
        wetting.film_thickness,
        wetting.height,
        no_contact,
        contact.grid.edges,
        connectivity,
    ).meniscus


class _Bridges:
    """Columns of the bridges that exist, and where they do."""

    def __init__(self, n: int) -> None:
        self.exists = np.zeros(n, dtype=bool)
        self.force, self.radius, self.volume = np.zeros(n), np.zeros(n), np.zeros(n)


def _bridges(gap: Floats, volume: Floats, curvature: Floats, wetting: _Wetting) -> _Bridges:
    """Solve the bridges of all islands at once; over the surface tension."""
    found, angles = _Bridges(len(gap)), wetting.angles
    room = np.flatnonzero(np.isfinite(curvature))
    if not len(room):
        return found
    if wetting.pressure is None:
        from ...capillary.exact.bridge import bridge

        state = bridge(gap[room], volume[room], *angles, 0.0, curvature[room], beyond="nan")
    else:
        from ...capillary.condensed import condensed_bridges

        over = wetting.pressure / wetting.tension
        state = condensed_bridges(gap[room], over, *angles, curvature[room])
    stands = np.isfinite(state.force)
    there = room[stands]
    found.exists[there] = True
    found.force[there] = state.force[stands]
    found.radius[there] = np.maximum(state.radius_lower, state.radius_upper)[stands]
    found.volume[there] = volume[there] if wetting.pressure is None else state.volume[stands]
    return found


def _part(
    effect: IslandBridges,
    contact: SolvedContact,
    wetting: _Wetting,
    is_meniscus: Mask,
    found: kernel.Islands,
    curvature: Floats,
    state: _Bridges,
) -> IslandPart:
    grid, exists, tension = contact.grid, state.exists, wetting.tension
    point: Floats = np.multiply(found.summit[exists] + 0.5, grid.pixel_size, dtype=np.float64)
    size = np.multiply(grid.shape, grid.pixel_size)
    height, width = np.where(grid.repeats, size, math.inf).tolist()
    overlap = kernel.overlapping(point, state.radius[exists], (height, width))
    force = tension * float(state.force.sum())
    load = float(contact.pressure.sum()) * grid.pixel_area
    pressure = wetting.pressure
    liquid = "film gathered on it" if pressure is None else f"{pressure:.4g} Pa"
    return IslandPart(
        law=f"exact bridge on each island, {effect.curvature} curvature, {liquid}",
        force=force,
        relative_force=force / load if load > 0.0 else math.inf,
        area=float(is_meniscus.sum()) * grid.pixel_area,
        n_menisci=int(exists.sum()),
        n_dry=int((~exists).sum()),
        coverage=float(np.pi * np.square(state.radius).sum()) / grid.area,
        n_overlapping=int(overlap.sum()),
        largest_fraction=float(found.area.max(initial=0.0)) / grid.area,
        point=point,
        gap=found.gap[exists],
        radius=1.0 / curvature[exists],
        contact_radius=state.radius[exists],
        volume=state.volume[exists],
        forces=tension * state.force[exists],
        is_meniscus=is_meniscus,
    )
