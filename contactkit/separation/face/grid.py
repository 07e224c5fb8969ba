"""Film between two faces on a grid: planform, holes, and the gap beside the shortest distance."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from ...errors import DescriptionError
from ...lubrication.reynolds.face import Face, Hole, Pocket, rasterise
from ...scene.faces import FaceHole, Recess, SealedHole
from ...scene.planforms import Planform
from ...scene.surfaces import Surface, one_grid, whole_heights
from ...scene.window import Grid
from .shape import FaceShape

if TYPE_CHECKING:
    from numpy.typing import NDArray

    Map = NDArray[np.floating[Any]]

__all__ = ["FaceGrid", "depths", "gridded", "hole_cells", "nearest", "relief_heights"]

# Points across the planform, as many as the finest film has cells: for its nearest place, of which
# 1/512 of tilt and crown is missed, and for the heights of a relief that is no map.
_FINE = 512
_CURE = "a face is resolved by 512 points; roughness that is finer has flow factors: FineRoughness"


class FaceGrid(NamedTuple):
    """A film on a grid."""

    face: Face
    relief: Map
    """Gap beside the shortest distance of the faces [m], (ny, nx)."""
    is_even: bool
    """Whether the gap is the same everywhere."""


def gridded(shape: FaceShape, cells: int) -> FaceGrid:
    """Lay a grid over a film.

    Parameters
    ----------
    shape : FaceShape
        Planform, holes, recesses, tilt and crown.
    cells : int
        Cells along the longer side.

    Raises
    ------
    DescriptionError
        If a hole or a recess is not resolved, or lies outside the film.
    """
    holes = [hole_cells(hole) for hole in shape.holes]
    face = rasterise(shape.outline, cells, holes=holes)
    if shape.is_even:
        return FaceGrid(face, np.zeros(face.shape), True)
    smooth = _smooth(shape.tilt, shape.curvature, face.x, face.y)
    smooth = smooth - nearest(shape.outline, shape.tilt, shape.curvature)
    # Outside the film, where liquid comes from, it may not be nearer than within.
    relief = np.maximum(smooth, 0.0) + depths(shape.recesses, face)
    for one in shape.reliefs:
        relief = relief - relief_heights(one, shape.outline, face)
    return FaceGrid(face, relief, False)


def hole_cells(hole: FaceHole) -> Hole | Pocket:
    """A hole of a face for its grid."""
    if isinstance(hole, SealedHole):
        return Pocket(shape=hole.shape, volume=hole.volume)
    return Hole(shape=hole.shape)


def nearest(outline: Planform, tilt: tuple[float, float], curvature: float) -> float:
    """Smallest gap within a planform and on its rim by a tilt and a curvature [m]."""
    left, right, low, high = outline.bounds
    x, y = np.meshgrid(np.linspace(left, right, _FINE), np.linspace(low, high, _FINE))
    inside = outline.level(x, y) >= -1e-9 * max(right - left, high - low)
    return float(_smooth(tilt, curvature, x, y)[inside].min())


def _smooth(tilt: tuple[float, float], curvature: float, x: Map, y: Map) -> Map:
    found: Map = tilt[0] * x + tilt[1] * y
    return found + 0.5 * curvature * (x * x + y * y)


def relief_heights(relief: Surface, outline: Planform, face: Face) -> Map:
    """Heights of a relief at the cells [m], by straight lines between its pixels."""
    from scipy.ndimage import map_coordinates

    grid = _relief_grid(relief, outline)
    heights = whole_heights(relief, grid, _CURE)
    (dy, dx), (ny, nx) = grid.pixel_size, grid.shape
    places = np.broadcast_arrays(face.y / dy + 0.5 * (ny - 1), face.x / dx + 0.5 * (nx - 1))
    return np.asarray(map_coordinates(heights, places, order=1, mode="nearest"))


def _relief_grid(relief: Surface, outline: Planform) -> Grid:
    """Grid of a height map; of a recipe one over the face, the same for all grids of the film."""
    own = one_grid(relief, "Flat.relief", is_periodic=False)
    if own is not None:
        return own
    left, right, low, high = outline.bounds
    width, height = 2.0 * max(abs(left), abs(right)), 2.0 * max(abs(low), abs(high))
    size = max(width, height) / _FINE
    ny, nx = math.ceil(height / size), math.ceil(width / size)
    return Grid((ny, nx), (height / ny, width / nx), False)


def depths(recesses: Sequence[Recess], face: Face) -> Map:
    """Depth of the recesses [m]; where they overlap, the deepest counts."""
    depth = np.zeros(face.shape)
    for recess in recesses:
        covered = np.broadcast_to(recess.shape.level(face.x, face.y) > 0.0, face.shape)
        if not (covered & face.inside).any():
            raise DescriptionError(
                "Recess.shape",
                recess.shape,
                f"cover a cell of {max(face.pixel_size):.3g} m of the film",
                hint="move it, leave it out, or ask for a smaller Accuracy.film_rtol",
            )
        depth = np.where(covered, np.maximum(depth, recess.depth), depth)
    return depth
