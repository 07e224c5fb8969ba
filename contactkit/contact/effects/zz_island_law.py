"""Bridges on the islands of one contact: from maps to a list of spheres, and to their forces."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np

from ...capillary import island_bridges as kernel
from ...capillary.film_islands import islands, meniscus_area
from ...capillary.kelvin import meniscus_height
from .island_bridges import IslandBridges, IslandPart

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from .base import Contact

    Floats = NDArray[np.float64]
    Mask = NDArray[np.bool_]

__all__ = ["bridges_of"]


def bridges_of(
    effect: IslandBridges, contact: Contact, pressure: float | None = None
) -> IslandPart:
    """Find the islands, put a bridge on each, and add up their forces."""
    meniscus = contact.scene.interface.meniscus
    assert meniscus is not None  # plan() has asked lacks() first
    pressure = pressure if pressure is not None else meniscus.pressure
    tension = meniscus.liquid.at(contact.scene.temperature).surface_tension
    assert tension is not None
    angles = (meniscus.contact_angle_lower, meniscus.contact_angle_upper)
    height = _height(effect, pressure, tension, angles)
    wet = _wet(effect, contact, height, pressure)
    names, n = islands(wet, contact.grid.periodic, effect.connectivity)
    touching, grid = contact.pressure > 0.0, contact.grid
    heights = contact.displacement - contact.gap  # undeformed, but for a constant
    found = kernel.measure_islands(names, n, contact.gap, touching, heights, grid.pixel_area)
    curvature = kernel.curvature_of_area(found, height)
    if effect.curvature == "summit":
        own = kernel.summit_curvature(heights, found.summit, grid.pixel_size, grid.periodic)
        # A pixel that is no summit, such as the edge of a ridge, has none of its own.
        curvature = np.where((own > 0.0) & np.isfinite(curvature), own, curvature)
    volume = found.area * (effect.film_thickness or 0.0)
    state = _bridges(found.gap, volume, curvature, angles, None if pressure is None else
                     pressure / tension)  # fmt: skip
    return _part(effect, contact, pressure, tension, wet & ~touching, found, curvature, state)


def _height(
    effect: IslandBridges, pressure: float | None, tension: float, angles: tuple[float, float]
) -> float:
    """Gap up to which an island reaches [m]."""
    if effect.meniscus_height is not None:
        return effect.meniscus_height
    if pressure is None:
        assert effect.film_thickness is not None
        return effect.film_thickness
    return float(meniscus_height(pressure, tension, math.cos(angles[0]) + math.cos(angles[1])))


def _wet(effect: IslandBridges, contact: Contact, height: float, pressure: float | None) -> Mask:
    """Pixels of islands that hold liquid, contact included."""
    cut = np.asarray(contact.gap < height)
    if pressure is not None:
        return cut
    assert effect.film_thickness is not None
    no_contact = np.zeros_like(cut)
    return meniscus_area(
        contact.gap, effect.film_thickness, height, no_contact, contact.grid.periodic,
        effect.connectivity,
    ).meniscus  # fmt: skip


class _Bridges:
    """Columns of the bridges that exist, and where they do."""

    def __init__(self, n: int) -> None:
        self.exists = np.zeros(n, dtype=bool)
        self.force, self.radius, self.volume = np.zeros(n), np.zeros(n), np.zeros(n)


def _bridges(
    gap: Floats, volume: Floats, curvature: Floats, angles: tuple[float, float],
    pressure: float | None,
) -> _Bridges:  # fmt: skip
    """Solve the bridges of all islands at once; over the surface tension."""
    found = _Bridges(len(gap))
    room = np.flatnonzero(np.isfinite(curvature))
    if not len(room):
        return found
    if pressure is None:
        from ...capillary.exact.bridge import bridge

        state = bridge(gap[room], volume[room], *angles, 0.0, curvature[room], beyond="nan")
    else:
        from ...capillary.condensed import condensed_bridges

        state = condensed_bridges(gap[room], pressure, *angles, curvature[room])
    stands = np.isfinite(state.force)
    there = room[stands]
    found.exists[there] = True
    found.force[there] = state.force[stands]
    found.radius[there] = np.maximum(state.radius_lower, state.radius_upper)[stands]
    found.volume[there] = state.volume[stands] if pressure is not None else volume[there]
    return found


def _part(
    effect: IslandBridges, contact: Contact, pressure: float | None, tension: float,
    is_meniscus: Mask, found: kernel.Islands, curvature: Floats, state: _Bridges,
) -> IslandPart:  # fmt: skip
    grid, exists = contact.grid, state.exists
    (ny, nx), (dy, dx) = grid.shape, grid.pixel_size
    point: Floats = np.multiply(found.summit[exists] + 0.5, [dy, dx], dtype=np.float64)
    period = (ny * dy, nx * dx) if grid.periodic else None
    overlap = kernel.overlapping(point, state.radius[exists], period)
    force = tension * float(state.force.sum())
    load = float(contact.pressure.sum()) * grid.pixel_area
    liquid = "film gathered on it" if pressure is None else f"{pressure:.4g} Pa"
    return IslandPart(
        law=f"exact bridge on each island, {effect.curvature} curvature, {liquid}",
        force=force,
        relative_force=force / load if load > 0.0 else math.inf,
        area=float(is_meniscus.sum()) * grid.pixel_area,
        n_menisci=int(exists.sum()),
        n_dry=int((~exists).sum()),
        cover=float(np.pi * np.square(state.radius).sum()) / grid.area,
        n_overlapping=int(overlap.sum()),
        largest_share=float(found.area.max(initial=0.0)) / grid.area,
        point=point,
        gap=found.gap[exists],
        radius=1.0 / curvature[exists],
        contact_radius=state.radius[exists],
        volume=state.volume[exists],
        forces=tension * state.force[exists],
        is_meniscus=is_meniscus,
    )
