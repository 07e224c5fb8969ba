"""Planes of stress below a contact: which ones a page shows, and the measures on them."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from ...analyses.subsurface import LABELS, MEASURES, planes_below
from ...contact.effects.stress import StressPart, SubsurfaceStress
from .images import Region, reduced, top_of
from .numbers import shown_quantity

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from ...contact.result import ContactResult

    Map = NDArray[np.float64]

__all__ = ["SHOWN", "Place", "StressMap", "places_of", "stress_maps"]

SHOWN = {name: LABELS[name] for name in ("von_mises", "tension", "sigma_xz")}
"""Measures that a page shows, by name, with their labels."""

_MOST = 12  # planes: as many as a slider of a phone sets one by one


class Place(NamedTuple):
    """Depth [m] and side of a plane, and how it is called."""

    depth: float
    side: str
    label: str


class StressMap(NamedTuple):
    """A measure on a plane, on fewer cells, and its largest value with its place (x, y) [m]."""

    values: Map
    top: tuple[float, float, float]


def places_of(result: ContactResult) -> list[Place]:
    """Planes of the stress of a result: all, or those of its maxima and others spread evenly."""
    part = result.of(SubsurfaceStress)
    n = len(part.depth)
    if n <= _MOST:
        kept = list(range(n))
    else:
        best = {_plane_of(part, name) for name in SHOWN}
        spread = np.rint(np.linspace(0, n - 1, _MOST - len(best))).astype(int)
        kept = sorted(best.union(spread.tolist()))
    materials = result.plan.scene.interface.lower.elastic_stack.materials
    names = [materials[layer].name for layer in part.layer[kept]]
    return [
        Place(float(part.depth[i]), part.side[i], _called(float(part.depth[i]), name))
        for i, name in zip(kept, names, strict=True)
    ]


def _called(depth: float, material: str) -> str:
    where = shown_quantity(depth, "m") + " deep" if depth > 0.0 else "at the surface"
    return f"{where}, {material}" if material else where


def _plane_of(part: StressPart, name: str) -> int:
    """Plane of the maximum of a measure."""
    best = part.maxima[name]
    far = np.abs(part.depth - best.z) + np.where(np.array(part.side) == best.side, 0.0, np.inf)
    return int(np.argmin(far))


def stress_maps(
    result: ContactResult, places: Sequence[Place], views: Sequence[tuple[Region, int]]
) -> Iterator[list[dict[str, StressMap]]]:
    """Measures on the planes of a page, one plane after the other, for regions and pixels a cell.

    A plane has as many maps of each measure as there are views.
    """
    effect = result.plan.listed(SubsurfaceStress)
    pixel = result.plan.grid.pixel_size
    for stress in planes_below(result, [place[:2] for place in places], effect):
        values = {name: np.asarray(MEASURES[name](stress)) for name in SHOWN}
        yield [
            {
                name: StressMap(
                    reduced(region.of(one), factor, "largest").astype(np.float32),
                    top_of(one, region, pixel),
                )
                for name, one in values.items()
            }
            for region, factor in views
        ]
