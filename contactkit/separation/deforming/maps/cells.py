"""Cells of a film on a map: its outline, and the heights of both bodies on them.

The axis lies in the middle pixel of a map and in the origin of planforms. Where no face has a rim,
the edges of a measured map are that of the film.
"""

from __future__ import annotations

import math
from functools import reduce
from typing import TYPE_CHECKING, Any

import numpy as np
from attrs import field, frozen

from ....accuracy import Accuracy
from ....errors import PlanError
from ....lubrication.reynolds.face import Face, block_means, face_from_level
from ....scene.interface import own_grid
from ....scene.planforms import Planform
from ....scene.surfaces import realise, union_of
from ....scene.window import Grid
from ...face.grid import depths, hole_cells, nearest, relief_heights

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from ....scene.scenes import SeparationScene

    Map = NDArray[np.float64]

__all__ = ["Cells", "cells_of", "restored_cells"]

_FINE = 8.0  # cells per shortest wave that is stated
_FEWEST, _MOST = 64, 512  # cells across that a plan chooses by itself
_ERROR = 1e-3  # `Accuracy.film_rtol` at which a smooth face has 128 cells across
_SMOOTH = 128  # cells across such a face
_OVER = 1e-9  # of a length: round-off


@frozen(eq=False)
class Cells:
    """Cells of a film between two bodies.

    Parameters
    ----------
    x, y : ndarray, shape (nx,), (ny,)
        Centres [m].
    shape : ndarray, shape (ny, nx)
        Gap of the undeformed bodies less their rigid gap [m].
    outline : Planform or None
        Where the film is; None: on all cells.
    holes : tuple
        Holes of the faces, open to ambient pressure.
    shortest : float
        Shortest wave that the surfaces state [m]; inf: none does.
    """

    x: Map = field(repr=False)
    y: Map = field(repr=False)
    shape: Map = field(repr=False)
    outline: Planform | None
    holes: tuple[Any, ...] = ()
    shortest: float = math.inf
    face: Face = field(init=False, repr=False)

    @face.default
    def _face(self) -> Face:
        """Cells of film, with one row of reservoir around them."""
        x, y = _padded(self.x), _padded(self.y)
        dy, dx = self.pixel_size
        # Without an outline cells at the edge reach halfway to those around them.
        along_x = np.minimum(x - x[0], x[-1] - x)[None, :] - 0.5 * dx
        along_y = np.minimum(y - y[0], y[-1] - y)[:, None] - 0.5 * dy
        level = np.minimum(along_x, along_y)
        if self.outline is not None:
            around = level < 0.0
            level = np.array(np.broadcast_to(self.outline.level(x[None], y[:, None]), level.shape))
            level[around] = np.minimum(level[around], -_OVER * min(dx, dy))
        origin = float(y[0]), float(x[0])
        return face_from_level(level, self.pixel_size, origin=origin, holes=self.holes)

    @property
    def pixel_size(self) -> tuple[float, float]:
        """Sides (dy, dx) of a cell [m]."""
        return float(self.y[1] - self.y[0]), float(self.x[1] - self.x[0])

    @property
    def padded(self) -> Map:
        """`shape` with the row around the film, shape (ny + 2, nx + 2)."""
        return np.pad(self.shape, 1, mode="edge")

    @property
    def inside(self) -> NDArray[np.bool_]:
        """Cells of film, shape (ny, nx)."""
        return self.face.inside[1:-1, 1:-1]

    def coarser(self) -> Cells:
        """Cells twice as large, with the mean heights of four; a last odd row is left out."""
        ny, nx = (n // 2 * 2 for n in self.shape.shape)
        x, y = (one[:n].reshape(-1, 2).mean(axis=1) for one, n in ((self.x, nx), (self.y, ny)))
        shape = np.asarray(block_means(self.shape[:ny, :nx]), dtype=np.float64)
        return Cells(x, y, shape, self.outline, self.holes, self.shortest)


def _padded(centres: Map) -> Map:
    step = centres[1] - centres[0]
    return np.concatenate([[centres[0] - step], centres, [centres[-1] + step]])


def cells_of(scene: SeparationScene, accuracy: Accuracy) -> Cells:
    """Cells of the film of a scene.

    Raises
    ------
    PlanError
        If the film has no rim, or its rim lies beyond a measured map; if a map has holes in it.
    DescriptionError
        If two surfaces bring different grids, or `Accuracy.grid` is another.
    """
    outline = _outline(scene)
    own = own_grid(scene.interface, accuracy)
    if own is None:
        grid = _laid_over(scene, outline, accuracy)
    else:
        grid = Grid(*own, False)
        if outline is not None:
            _check_within(outline, grid)
        else:
            _check_edges(scene)
    y, x = (one.ravel() for one in grid.from_centre())
    holes = _holes(scene)
    surfaces = [body.surface for body in scene.interface.bodies]
    heights = sum(realise(surface, grid) for surface in surfaces)
    flat = Cells(x, y, np.zeros(grid.shape), outline, holes)
    _check_holes(union_of(surface.void_pixels for surface in surfaces), flat)
    shape = _of_faces(scene, flat) - heights
    return Cells(x, y, np.asarray(shape), outline, holes, _shortest(scene, grid))


def restored_cells(scene: SeparationScene, x: Map, y: Map, shape: Map) -> Cells:
    """Cells of a film whose heights are known, of the outline that the scene has."""
    pixel = float(y[1] - y[0]), float(x[1] - x[0])
    ny, nx = shape.shape
    grid = Grid((ny, nx), pixel, False)
    return Cells(x, y, shape, _outline(scene), _holes(scene), _shortest(scene, grid))


def _outline(scene: SeparationScene) -> Planform | None:
    """Where both faces are; None if neither has a rim."""
    outlines = [face.outline for face in scene.interface.faces if face.outline is not None]
    unlike = [one for i, one in enumerate(outlines) if one not in outlines[:i]]
    return reduce(lambda a, b: a & b, unlike) if unlike else None


def _holes(scene: SeparationScene) -> tuple[Any, ...]:
    return tuple(hole_cells(hole) for face in scene.interface.faces for hole in face.holes)


def _laid_over(scene: SeparationScene, outline: Planform | None, accuracy: Accuracy) -> Grid:
    """A grid over the outline of the film, about the axis."""
    if outline is None:
        raise PlanError(
            "the film on a map has no rim: give a Flat(radius=...) or Flat(planform=...) to one of "
            "the bodies, or a measured map, whose edges are its rim"
        )
    left, right, low, high = outline.bounds
    width, height = 2.0 * max(abs(left), abs(right)), 2.0 * max(abs(low), abs(high))
    if accuracy.grid is not None:
        ny, nx = accuracy.shape
        return Grid((ny, nx), (height / ny, width / nx), False)
    longest = max(width, height)
    pixel = longest / _cells_across(scene, longest, accuracy)
    ny, nx = (2 * max(math.ceil(0.5 * side / pixel), 2) for side in (height, width))
    return Grid((ny, nx), (height / ny, width / nx), False)


def _cells_across(scene: SeparationScene, longest: float, accuracy: Accuracy) -> int:
    """Cells across the longer side: enough for waves and for pixels of reliefs, up to a limit."""
    wanted = _SMOOTH * math.sqrt(_ERROR / accuracy.film_rtol)
    probe = Grid((_MOST, _MOST), (longest / _MOST, longest / _MOST), False)
    waves = _shortest(scene, probe)
    if math.isfinite(waves):
        wanted = max(wanted, _FINE * longest / waves)
    for flat in scene.interface.faces:
        if flat.relief is not None:
            finest = [min(size) for _, size in flat.relief.own_grids]
            finest += [one.length / _FINE for one in flat.relief.shortest_waves(probe)]
            wanted = max(wanted, *(longest / size for size in finest))
    return min(max(2 * math.ceil(0.5 * wanted), _FEWEST), _MOST)


def _shortest(scene: SeparationScene, grid: Grid) -> float:
    """Shortest wave that the surfaces state [m]; inf if none does."""
    surfaces = [body.surface for body in scene.interface.bodies]
    waves = [wave.length for one in surfaces for wave in one.shortest_waves(grid)]
    return min(waves, default=math.inf)


def _check_within(outline: Planform, grid: Grid) -> None:
    """Refuse an outline that is larger than a measured map."""
    left, right, low, high = outline.bounds
    y, x = grid.from_centre()
    dy, dx = grid.pixel_size
    edges = float(x.min()) - 0.5 * dx, float(x.max()) + 0.5 * dx
    ends = float(y.min()) - 0.5 * dy, float(y.max()) + 0.5 * dy
    near = _OVER * max(right - left, high - low) + 0.5 * max(dx, dy)
    if left < edges[0] - near or right > edges[1] + near:
        beyond = f"from x = {left:g} to {right:g} m, and the map from {edges[0]:g} to {edges[1]:g}"
    elif low < ends[0] - near or high > ends[1] + near:
        beyond = f"from y = {low:g} to {high:g} m, and the map from {ends[0]:g} to {ends[1]:g}"
    else:
        return
    raise PlanError(
        f"the film is wider than the height map: it reaches {beyond} m; give a smaller face or a "
        "larger map"
    )


def _check_edges(scene: SeparationScene) -> None:
    """Refuse maps that repeat beyond their edges as the rim of a film."""
    for name in ("lower", "upper"):
        if getattr(scene.interface, name).surface.periodic_maps:
            raise PlanError(
                f"interface.{name}.surface repeats beyond its edges (is_periodic=True): a film "
                "without end has no rim through which liquid could flow, and its mean gap could "
                "not change; give a Flat(radius=...) or a planform to the other body, or "
                "is_periodic=False"
            )


def _check_holes(void: NDArray[np.bool_] | None, cells: Cells) -> None:
    if void is None:
        return
    inside = void & cells.inside
    if inside.any():
        row, column = np.argwhere(inside)[0]
        raise PlanError(
            f"{int(inside.sum())} pixels of a height map within the film were not measured, the "
            f"first in row {row}, column {column}: fill them, or give a smaller face"
        )


def _of_faces(scene: SeparationScene, flat: Cells) -> Map:
    """Gap by tilt, crown, recesses and reliefs of flat bodies [m].

    As for rigid faces, the gap is the shortest distance of the smooth bodies within the film.
    """
    faces = scene.interface.faces
    x, y = flat.x[None, :], flat.y[:, None]
    tilt = (sum(face.tilt[0] for face in faces), sum(face.tilt[1] for face in faces))
    crowns = sum(1.0 / face.crown_radius for face in faces if face.crown_radius is not None)
    bodies = sum(body.surface.body_curvature for body in scene.interface.bodies)
    found = tilt[0] * x + tilt[1] * y + 0.5 * crowns * (x * x + y * y)
    if flat.outline is not None:
        found = found - _nearest(flat.outline, tilt, crowns + bodies)
    recesses = [recess for face in faces for recess in face.recesses]
    inner = flat.face
    found = found + depths(recesses, inner)[1:-1, 1:-1]
    for face in faces:
        if face.relief is not None and flat.outline is not None:
            found = found - relief_heights(face.relief, flat.outline, inner)[1:-1, 1:-1]
    return np.asarray(found)


def _nearest(outline: Planform, tilt: tuple[float, float], curvature: float) -> float:
    """Smallest gap by a tilt and a curvature within an outline [m], exact at an apex within."""
    if curvature > 0.0:
        x, y = (-slope / curvature for slope in tilt)
        if float(outline.level(x, y)) >= 0.0:
            return -0.5 * (tilt[0] ** 2 + tilt[1] ** 2) / curvature
    return nearest(outline, tilt, curvature)
