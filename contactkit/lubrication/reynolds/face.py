"""A face on a grid: which cells hold film, and what bounds them: reservoirs, pockets and walls.

Cells are rectangles with their centres in the film or outside it. Outside the film a cell belongs
to a reservoir with a pressure, to a sealed pocket with one unknown pressure, or to a solid that
lets nothing pass. The edges of the grid are walls without flow, which symmetry calls for, or wrap
round. Maps are ``[y, x]``.
"""

from __future__ import annotations

from collections.abc import Sequence
from functools import cached_property
from typing import TYPE_CHECKING, Any, NamedTuple, Protocol

import numpy as np
from attrs import Attribute, evolve, field, frozen

from ...errors import DescriptionError
from ...units import si
from ...validators import Described, finite, non_negative, refuse

if TYPE_CHECKING:
    from numpy.typing import ArrayLike, NDArray

    Array = NDArray[np.floating[Any]]

__all__ = [
    "Circle",
    "Face",
    "Hole",
    "HoleCells",
    "Outline",
    "Pocket",
    "block_means",
    "distance_of_image",
    "face_from_image",
    "face_from_level",
    "face_from_mask",
    "rasterise",
]

FILM, RESERVOIR, SOLID = 0, -1, -2
"""Owners of a cell; those of pockets are 1, 2, ..."""
# Parts of a cell along an edge. Areas of elliptic holes of 10 to 40 cells across are then off by up
# to 3e-4; by 3e-3 with 4, 1e-4 with 16, which has four times the points.
_FINER = 8


class Outline(Protocol):
    """A region of the plane, such as a `contactkit.scene.planforms.Planform`."""

    @property
    def bounds(self) -> tuple[float, float, float, float]:
        """Smallest x, largest x, smallest y and largest y [m]."""

    @property
    def circle(self) -> tuple[float, float, float] | None:
        """Centre (x, y) and radius [m] of a disc; None of all others."""

    def level(self, x: Any, y: Any) -> Array:
        """Signed distance [m] of points to the edge, positive inside."""

    def without_round_holes(self) -> tuple[Outline, Sequence[Outline]]:
        """The region without the round holes in it, and these."""


def _outline(owner: object, attribute: Attribute[Any], value: Any) -> None:
    if not all(hasattr(value, name) for name in ("bounds", "circle", "level")):
        raise refuse(owner, attribute, value, "be a planform, such as ck.Disc(radius=...)")


@frozen(kw_only=True)
class Hole(Described):
    """A hole in a face, held at a pressure: a vent, a feed, the recess of a hydrostatic pad.

    `GridFilmState.holes` has the flow out of each and the force of its pressure on the face, which
    `GridFilmState.pad_force` counts and `GridFilmState.force`, that of the film, does not.

    Parameters
    ----------
    shape : Outline
        Its outline; a disc may be smaller than a cell, other shapes must cover one.
    pressure : float
        Pressure in the hole [Pa], from the same zero as that of the rim.
    """

    shape: Outline = field(validator=_outline)
    pressure: float = field(default=0.0, validator=finite, metadata=si("Pa"))


@frozen(kw_only=True)
class Pocket(Described):
    """A sealed hole full of liquid: one pressure, which follows from what flows in.

    Parameters
    ----------
    shape : Outline
        Its outline; a disc may be smaller than a cell, other shapes must cover one.
    volume : float
        Volume of liquid in it beyond that of the gap [m3].
    compressibility : float
        Compressibility of that liquid [1/Pa]; mineral oils have about 5e-10/Pa.

    Notes
    -----
    Its pressure acts on its area, which counts to the force.
    """

    shape: Outline = field(validator=_outline)
    volume: float = field(default=0.0, validator=non_negative, metadata=si("m3"))
    compressibility: float = field(default=0.0, validator=non_negative, metadata=si("1/Pa"))


@frozen(kw_only=True)
class Circle:
    """Centre (x, y) and radius [m] of a round hole, for the radial flow around it."""

    x: float
    y: float
    radius: float


class HoleCells(NamedTuple):
    """A `Hole` on a grid."""

    area: float
    """Area within the grid [m2]; of a circle that lies in it the exact one."""
    pressure: float
    """Pressure [Pa]."""
    cells: NDArray[np.int64]
    """Its cells (flat indices)."""


@frozen(kw_only=True, eq=False, slots=False)
class Face:
    """A planform on a grid; made by `rasterise`, or from a level set, mask or image.

    Parameters
    ----------
    level : ndarray, shape (ny, nx)
        Signed distance of the centres to the nearest edge of the film, positive inside [m].
    owner : ndarray of int, shape (ny, nx)
        0 film, -1 reservoir, -2 solid, and 1, 2, ... the pockets.
    pressure : ndarray, shape (ny, nx)
        Pressure of the reservoirs [Pa]; not read elsewhere.
    pixel_size : tuple of float
        Height and width of a cell [m].
    origin : tuple of float
        Place (y, x) of the centre of the first cell [m].
    periodic : tuple of bool
        Whether the grid wraps round along y and along x.
    pockets : tuple of (volume [m3], compressibility [1/Pa])
        What the pockets hold beyond the gap.
    circles : tuple of Circle
        Round holes.
    circle : ndarray of int, shape (ny, nx)
        Number of the round hole of a cell, -1 without one.
    notes : tuple of str
        What the grid does not resolve, and how it is treated.
    holes : tuple of HoleCells
        Holes at a pressure, in the order they were given in.
    """

    level: Array = field(repr=False)
    owner: NDArray[np.int64] = field(repr=False)
    pressure: Array = field(repr=False)
    pixel_size: tuple[float, float]
    origin: tuple[float, float] = (0.0, 0.0)
    periodic: tuple[bool, bool] = (False, False)
    pockets: tuple[tuple[float, float], ...] = ()
    circles: tuple[Circle, ...] = ()
    circle: NDArray[np.int64] = field(repr=False)
    notes: tuple[str, ...] = ()
    holes: tuple[HoleCells, ...] = field(default=(), repr=False)

    @property
    def shape(self) -> tuple[int, int]:
        """Number of cells along y and along x."""
        ny, nx = self.level.shape
        return ny, nx

    @property
    def cell_area(self) -> float:
        """Area of a cell [m2]."""
        return self.pixel_size[0] * self.pixel_size[1]

    @cached_property
    def x(self) -> Array:
        """Centres of the cells along x, shape (1, nx) [m]."""
        return (self.origin[1] + self.pixel_size[1] * np.arange(self.shape[1]))[None, :]

    @cached_property
    def y(self) -> Array:
        """Centres of the cells along y, shape (ny, 1) [m]."""
        return (self.origin[0] + self.pixel_size[0] * np.arange(self.shape[0]))[:, None]

    @cached_property
    def inside(self) -> NDArray[np.bool_]:
        """Cells of the film."""
        return np.asarray(self.owner == FILM)

    @cached_property
    def loaded(self) -> NDArray[np.bool_]:
        """Cells whose pressure acts on the face: film and pockets."""
        return self.owner >= FILM

    @cached_property
    def coarse(self) -> Face:
        """The same face with cells twice as large, for guesses only."""
        return _coarser(self)


def rasterise(
    shape: Outline,
    cells: int = 256,
    *,
    holes: Sequence[Hole | Pocket] = (),
    pressure: float = 0.0,
    window: tuple[float, float, float, float] | None = None,
    periodic: tuple[bool, bool] = (False, False),
) -> Face:
    """Lay a grid over a planform.

    Parameters
    ----------
    shape : Outline
        Planform of the film.
    cells : int
        Cells along the longer side of the grid, with those outside the rim.
    holes : sequence of Hole or Pocket
        Holes with a pressure of their own, and sealed ones.
    pressure : float
        Pressure of the reservoir around the rim [Pa].
    window : tuple of float, optional
        x from, x to, y from, y to [m]: the part of the planform to solve. What it cuts off is
        replaced by a wall without flow, as symmetry has it: a quarter of a disc of radius R is
        ``(0, R, 0, R)``. By default all of the planform.
    periodic : tuple of bool
        Whether the window repeats along y and along x.

    Raises
    ------
    DescriptionError
        If there are too few cells, a window outside the planform, or a hole that no cell resolves.

    Notes
    -----
    Around a `Disc` among the holes the flow into it is taken as radial, so that it is met within
    a per cent even if it is smaller than a cell: its cell is then the hole, and `Face.notes` has
    a line about it.

    Examples
    --------
    >>> from contactkit.scene.planforms import Disc
    >>> rasterise(Disc(radius=1e-3), 64).shape
    (64, 64)
    >>> vented = rasterise(Disc(radius=1e-3), 64, holes=[Hole(shape=Disc(radius=1e-6))])
    >>> print(*vented.notes)
    round hole of radius 1e-06 m at (0, 0) m: smaller than a cell of 3.22581e-05 m, as a point
    """
    body, round_holes = shape.without_round_holes()
    extra = tuple(Hole(shape=hole, pressure=pressure) for hole in round_holes)
    if not isinstance(cells, int) or isinstance(cells, bool) or cells < 4:
        raise DescriptionError("rasterise.cells", cells, "be a whole number of at least 4")
    (x, dx), (y, dy) = _axes(body.bounds, window, cells, periodic)
    level = body.level(x[None, :], y[:, None])
    face = face_from_level(
        np.broadcast_to(level, (y.size, x.size)),
        (dy, dx),
        origin=(float(y[0]), float(x[0])),
        holes=(*extra, *holes),
        pressure=pressure,
        periodic=periodic,
    )
    # Those of the planform itself are no part of the face.
    return evolve(face, holes=face.holes[len(extra) :])


def face_from_level(
    level: ArrayLike,
    pixel_size: float | tuple[float, float],
    *,
    origin: tuple[float, float] = (0.0, 0.0),
    holes: Sequence[Hole | Pocket] = (),
    pressure: ArrayLike = 0.0,
    periodic: tuple[bool, bool] = (False, False),
    solid: ArrayLike = False,
) -> Face:
    """Make a face of a level set.

    Parameters
    ----------
    level : array_like, shape (ny, nx)
        Signed distance to the rim, positive in the film [m]. Its zero line is the rim: second
        order needs a distance, or a level that is linear across the rim.
    pixel_size : float or tuple of float
        Size of a cell, or its height and width [m].
    origin : tuple of float
        Place (y, x) of the centre of the first cell [m].
    holes : sequence of Hole or Pocket
        See `rasterise`.
    pressure : array_like, shape () or (ny, nx)
        Pressure of the reservoir, which may differ from place to place [Pa].
    periodic : tuple of bool
        Whether the grid wraps round along y and along x.
    solid : array_like of bool, shape () or (ny, nx)
        Cells in which the faces touch, or seals: nothing flows.

    Raises
    ------
    DescriptionError
        If a map has the wrong shape or is not finite, no cell holds film, or a hole is lost.

    Examples
    --------
    >>> import numpy as np
    >>> strip = face_from_level(np.minimum(np.arange(8) - 0.5, 6.5 - np.arange(8))[None, :], 1e-3)
    >>> int(strip.inside.sum())
    6
    """
    level = _map("level", level, None, "m")
    if isinstance(pixel_size, int | float):
        pixel_size = (float(pixel_size), float(pixel_size))
    if len(pixel_size) != 2 or not all(0.0 < d < np.inf for d in pixel_size):
        raise DescriptionError("face.pixel_size", pixel_size, "be positive and finite", unit="m")
    touching = np.broadcast_to(np.asarray(solid, bool), level.shape)
    owner = np.where(touching, SOLID, np.where(level > 0.0, FILM, RESERVOIR))
    face = Face(
        level=level,
        owner=owner,
        pressure=np.array(_map("pressure", pressure, level.shape, "Pa")),
        pixel_size=(float(pixel_size[0]), float(pixel_size[1])),
        origin=origin,
        periodic=(bool(periodic[0]), bool(periodic[1])),
        circle=np.full(level.shape, -1),
    )
    for hole in holes:
        face = _with_hole(face, hole)
    if not face.inside.any():
        cure = "give more cells, or a level that is positive in the film"
        raise DescriptionError("face.level", float(level.max()), "be positive in a cell", hint=cure)
    return face


def face_from_mask(mask: ArrayLike, pixel_size: float | tuple[float, float], **more: Any) -> Face:
    """Make a face of a mask: film where it is true; see `face_from_level` for the other arguments.

    Notes
    -----
    A curved rim is a staircase, which leaves an error of first order: 0.2 % for a disc of 256
    cells. An image with grey edges (`face_from_image`) or a level set does better.

    Examples
    --------
    >>> import numpy as np
    >>> face_from_mask(np.pad(np.ones((4, 6), bool), 1), 1e-4).shape
    (6, 8)
    """
    return face_from_level(np.where(np.asarray(mask, bool), 0.5, -0.5), pixel_size, **more)


def face_from_image(image: ArrayLike, pixel_size: float | tuple[float, float], **more: Any) -> Face:
    """Make a face of a grey image: the fraction of each cell that the film covers, 0 to 1.

    Parameters
    ----------
    image : array_like, shape (ny, nx)
        Fraction of a cell that is film [-]: an anti-aliased drawing over its white.
    pixel_size : float or tuple of float
        Size of a cell, or its height and width [m].
    **more
        Other arguments of `face_from_level`.

    Raises
    ------
    DescriptionError
        If a fraction is outside 0 to 1; see also `face_from_level`.

    Notes
    -----
    In each grey cell the rim is the straight line across the gradient that cuts off the fraction,
    and near it the level is the distance to this line; so the result is nearly that of a level
    set. A black and white image is taken as a mask.

    Examples
    --------
    >>> face_from_image([[0.0, 0.5, 1.0, 0.75, 0.0]], 1e-3).level.round(5)
    array([[-0.001  ,  0.     ,  0.001  ,  0.00025, -0.00075]])
    """
    coverage = _map("image", image, None, "-")
    if coverage.min() < 0.0 or coverage.max() > 1.0:
        bad = float(coverage.max() if coverage.max() > 1.0 else coverage.min())
        cure = "divide an image of 8 bits by 255"
        raise DescriptionError("face.image", bad, "lie between 0 and 1", hint=cure)
    size = (pixel_size, pixel_size) if isinstance(pixel_size, int | float) else pixel_size
    return face_from_level(distance_of_image(coverage, size), size, **more)


def _map(name: str, values: ArrayLike, shape: tuple[int, int] | None, unit: str) -> Array:
    """A finite map of the given shape, or of any."""
    given = np.asarray(values, dtype=float)
    if shape is not None and given.shape not in ((), shape):
        expected = f"be one number or have the shape {shape} of the grid"
        raise DescriptionError(f"face.{name}", given.shape, expected)
    if shape is None and (given.ndim != 2 or given.size == 0):
        raise DescriptionError(f"face.{name}", given.shape, "be a map of two dimensions")
    if not np.isfinite(given).all():
        bad = float(given[~np.isfinite(given)].flat[0])
        raise DescriptionError(f"face.{name}", bad, "be finite in every cell", unit=unit)
    return given if shape is None else np.broadcast_to(given, shape)


def _axes(
    bounds: tuple[float, float, float, float],
    window: tuple[float, float, float, float] | None,
    cells: int,
    periodic: tuple[bool, bool],
) -> tuple[tuple[Array, float], tuple[Array, float]]:
    """Centres and size of the cells along x and y; one more cell beyond each edge with a rim."""
    spans, guards = [], []
    for axis, wraps in ((0, periodic[1]), (1, periodic[0])):
        low, high = bounds[2 * axis], bounds[2 * axis + 1]
        first, last = (low, high) if window is None else window[2 * axis : 2 * axis + 2]
        near = 1e-9 * (high - low)
        open_low, open_high = first <= low + near, last >= high - near
        first, last = max(first, low), min(last, high)
        if not first < last:
            raise DescriptionError(
                "rasterise.window", window, f"overlap the planform, of bounds {bounds}", unit="m"
            )
        spans.append((first, last))
        guards.append((0, 0) if wraps else (int(open_low), int(open_high)))
    lengths = [last - first for first, last in spans]
    longer = int(lengths[1] > lengths[0])
    size = lengths[longer] / (cells - sum(guards[longer]))
    axes = []
    for (first, _), length, (before, after) in zip(spans, lengths, guards, strict=True):
        count = max(1, round(length / size))
        step = length / count
        axes.append((first + step * (np.arange(-before, count + after) + 0.5), step))
    return axes[0], axes[1]


def _with_hole(face: Face, hole: Hole | Pocket) -> Face:
    """The face with one more hole."""
    level = np.broadcast_to(hole.shape.level(face.x, face.y), face.shape)
    covered = (level > 0.0) & (face.owner == FILM)
    if ((level > 0.0) & ((face.owner > FILM) | (face.circle >= 0))).any():
        cure = "holes that meet are one: give the union of their shapes"
        raise DescriptionError("hole.shape", hole.shape, "not overlap another hole", hint=cure)
    circles, circle, notes = face.circles, face.circle, face.notes
    if hole.shape.circle is not None:
        x, y, radius = hole.shape.circle
        if not covered.any():
            covered, note = _point(face, x, y, radius)
            notes = (*notes, note)
            row, column = np.argwhere(covered)[0]
            # Flow into the middle of its cell: from a corner, sides would differ by much.
            x, y = float(face.x[0, column]), float(face.y[row, 0])
        circle = np.where(covered, len(circles), circle)
        circles = (*circles, Circle(x=x, y=y, radius=radius))
    elif not covered.any():
        size = max(face.pixel_size)
        cure = f"give smaller cells than {size:.3g} m, or a Disc, which may be smaller than a cell"
        raise DescriptionError("hole.shape", hole.shape, "cover a cell of the film", hint=cure)
    owner, pockets, pressure, holes = face.owner, face.pockets, face.pressure, face.holes
    if isinstance(hole, Pocket):
        pockets = (*pockets, (hole.volume, hole.compressibility))
        owner = np.where(covered, len(pockets), owner)
    else:
        owner = np.where(covered, RESERVOIR, owner)
        pressure = np.where(covered, hole.pressure, pressure)
        area = _area_of_hole(face, hole.shape, level)
        holes = (*holes, HoleCells(area, hole.pressure, np.flatnonzero(covered)))
    return evolve(
        face,
        level=np.where(covered, -np.maximum(level, 0.0), np.minimum(face.level, -level)),
        owner=owner,
        pockets=pockets,
        pressure=pressure,
        circles=circles,
        circle=circle,
        notes=notes,
        holes=holes,
    )


def _area_of_hole(face: Face, shape: Outline, level: Array) -> float:
    """Area of a hole [m2] in the film and within the grid."""
    low_x, high_x, low_y, high_y = shape.bounds
    (dy, dx), (ny, nx) = face.pixel_size, face.shape
    left, bottom = face.origin[1] - 0.5 * dx, face.origin[0] - 0.5 * dy
    near = 1e-9 * (high_x - low_x)
    within = (low_x >= left - near) and (high_x <= left + nx * dx + near)
    within &= (low_y >= bottom - near) and (high_y <= bottom + ny * dy + near)
    if shape.circle is not None and within and (face.level > 0.0)[level > 0.0].all():
        return float(np.pi * shape.circle[2] ** 2)
    if shape.circle is not None and not (level > 0.0).any():
        window = (left, left + nx * dx, bottom, bottom + ny * dy)
        return _fraction_in_window(shape.circle, window) * float(np.pi * shape.circle[2] ** 2)
    # Cells of an eighth, those at its edge by their distance to it.
    columns = np.flatnonzero((face.x[0] > low_x - dx) & (face.x[0] < high_x + dx))
    rows = np.flatnonzero((face.y[:, 0] > low_y - dy) & (face.y[:, 0] < high_y + dy))
    around = np.where(face.owner == SOLID, -np.inf, face.level)[np.ix_(rows, columns)]
    around = around.repeat(_FINER, axis=0).repeat(_FINER, axis=1)
    x = left + (_FINER * columns[0] + np.arange(around.shape[1]) + 0.5) * dx / _FINER
    y = bottom + (_FINER * rows[0] + np.arange(around.shape[0]) + 0.5) * dy / _FINER
    inside = np.minimum(shape.level(x[None, :], y[:, None]), around)
    part = np.clip(0.5 + inside * _FINER / np.sqrt(dx * dy), 0.0, 1.0)
    return float(part.sum()) * face.cell_area / _FINER**2


def _fraction_in_window(
    disc: tuple[float, float, float], window: tuple[float, float, float, float]
) -> float:
    """Fraction of a small disc within a window; centres on its edges count a half or a quarter."""
    x, y, radius = disc
    whole = 1.0
    for place, low, high in ((x, window[0], window[1]), (y, window[2], window[3])):
        if min(place - low, high - place) < 1e-9 * radius:
            whole *= 0.5
    return whole


def _point(face: Face, x: float, y: float, radius: float) -> tuple[NDArray[np.bool_], str]:
    """The cell that stands for a hole smaller than it."""
    (dy, dx), (ny, nx) = face.pixel_size, face.shape
    column, row = round((x - face.origin[1]) / dx), round((y - face.origin[0]) / dy)
    place = f"round hole of radius {radius:g} m at ({x:g}, {y:g}) m"
    if not (0 <= column < nx and 0 <= row < ny and face.owner[row, column] == FILM):
        raise DescriptionError(
            "hole.shape", place, "lie in the film", hint="move it, or leave it out"
        )
    covered = np.zeros(face.shape, bool)
    covered[row, column] = True
    return covered, f"{place}: smaller than a cell of {max(dx, dy):g} m, as a point"


def distance_of_image(coverage: Array, size: tuple[float, float]) -> Array:
    """Signed distance to the rim of a grey image [m], of pixels of a height and a width [m]."""
    from scipy.ndimage import distance_transform_edt, sobel

    height, width = size
    film = coverage > 0.5
    half = 0.5 * min(size)
    plain = np.where(
        film,
        distance_transform_edt(film, size) - half if not film.all() else np.inf,
        half - distance_transform_edt(~film, size) if film.any() else -np.inf,
    )
    grey = (coverage > 0.0) & (coverage < 1.0)
    if not grey.any():
        return np.clip(plain, -1e3 * half, 1e3 * half)
    slope_y = sobel(coverage, 0, mode="nearest") / height
    slope_x = sobel(coverage, 1, mode="nearest") / width
    steep = np.hypot(slope_x, slope_y)
    lone = steep == 0.0
    normal_y = np.where(lone, 0.0, slope_y / np.where(lone, 1.0, steep))
    normal_x = np.where(lone, 1.0, slope_x / np.where(lone, 1.0, steep))
    offset = _line_offset(coverage, np.abs(normal_x) * width, np.abs(normal_y) * height)
    far, (row, column) = distance_transform_edt(~grey, size, return_indices=True)
    rows, columns = np.indices(coverage.shape)
    from_line = (
        offset[row, column]
        + normal_x[row, column] * (columns - column) * width
        + normal_y[row, column] * (rows - row) * height
    )
    # Only next to the line, and where it agrees with the image about the side.
    near = (far <= 2.5 * max(size)) & ((from_line > 0.0) == film)
    return np.where(near, from_line, np.clip(plain, -1e3 * half, 1e3 * half))


def _line_offset(coverage: Array, across: Array, along: Array) -> Array:
    """Distance of a centre to the line that cuts a fraction off its cell, positive inside."""
    large, small = np.maximum(across, along), np.minimum(across, along)
    less = np.minimum(coverage, 1.0 - coverage)
    corner = less * 2.0 * large < small
    reach = np.where(corner, np.sqrt(2.0 * large * small * less), less * large + 0.5 * small)
    return np.asarray(np.sign(coverage - 0.5) * (0.5 * (large + small) - reach))


def _coarser(face: Face) -> Face:
    """Cells of 2 x 2: film where the mean level is positive, else what its cells belong to."""
    solid = np.where(face.owner == SOLID, 1.0, 0.0)
    outside = block_means(np.where(face.owner == RESERVOIR, 1.0, 0.0))
    # A reservoir along the edge of the grid may be one cell wide, and must not get lost.
    edge = np.zeros(face.shape)
    edge[[0, -1], :] = edge[:, [0, -1]] = 1.0
    at_edge = block_means(edge * (face.owner == RESERVOIR)) > 0.0
    level = block_means(face.level)
    level = np.where(at_edge, np.minimum(level, 0.0), level)
    pressure = block_means(np.where(face.owner == RESERVOIR, face.pressure, 0.0))
    owner = np.where(level > 0.0, FILM, RESERVOIR)
    for number in range(1, len(face.pockets) + 1):
        held = block_means(np.where(face.owner == number, 1.0, 0.0)) > 0.0
        owner = np.where(held & (level <= 0.0), number, owner)
    owner = np.where(block_means(solid) > 0.5, SOLID, owner)
    dy, dx = (d * 2.0 if n > 1 else d for d, n in zip(face.pixel_size, face.shape, strict=True))
    return Face(
        level=level,
        owner=owner,
        pressure=pressure / np.maximum(outside, 1e-300),
        pixel_size=(dy, dx),
        periodic=face.periodic,
        pockets=face.pockets,
        circle=np.full(level.shape, -1),
    )


def block_means(values: Array) -> Array:
    """Means of 2 x 2 cells; a last odd row or column is repeated, a single one stays.

    Examples
    --------
    >>> block_means(np.array([[1.0, 3.0, 4.0]]))
    array([[2., 4.]])
    """
    for axis in (0, 1):
        if values.shape[axis] > 1:
            moved = np.moveaxis(values, axis, 0)
            if len(moved) % 2:
                moved = np.concatenate([moved, moved[-1:]])
            values = np.moveaxis(0.5 * (moved[::2] + moved[1::2]), 0, axis)
    return values
