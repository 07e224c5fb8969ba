"""Unknowns of a face and the sides of its cells through which liquid passes: geometry alone.

Each cell of film has an unknown; a pocket has one, and so has a deep recess, whose pressure is
uniform to (h/h1)^3. Sides lie between two cells of film, or between film and a reservoir or
pocket, where the rim cuts the line between the centres.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from .face import FILM, RESERVOIR

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from .face import Face

    Array = NDArray[np.floating[Any]]
    Indices = NDArray[np.int64]

__all__ = ["Mesh", "Rim", "Sides", "make_mesh", "recesses"]

NEAREST_RIM = 0.05
"""Least distance of the rim from a centre, over the distance of the centres; the linear system
stays well conditioned, and the error it makes is of second order (Gibou et al. 2002)."""
DEEP = 30.0
"""Step of the gap from which a recess has one pressure; the error is its power -3, 4e-5."""


class Sides(NamedTuple):
    """Sides between two cells of film."""

    low: Indices
    """Cell (flat index) at the lower coordinate."""
    high: Indices
    """Cell at the higher coordinate."""
    axis: Indices
    """0 across y, 1 across x."""
    geometry: Array
    """Width of the side over the distance of the centres [-]."""


class Rim(NamedTuple):
    """Sides between film and a reservoir or pocket."""

    cell: Indices
    """Cell of film."""
    beyond: Indices
    """Cell outside."""
    axis: Indices
    """0 across y, 1 across x."""
    sign: Array
    """1 where outside is at the higher coordinate, else -1."""
    geometry: Array
    """Conductance of the side over h^3/(12 eta) [-]."""
    distance: Array
    """From the centre to the rim [m]."""
    excess: Array
    """Fraction of the cell's source that lies between where the flux is taken, midway between
    centre and rim, and the side of the cell [-]; without it the error is four times larger."""


class Pattern(NamedTuple):
    """Places of the entries of a sparse matrix (CSR) whose values change from step to step."""

    slot: Indices
    columns: Indices
    starts: Indices


class Mesh(NamedTuple):
    """Unknowns, sides, and the pattern of the matrix of conductances."""

    number: Indices
    """Unknown of each cell (flat), -1 without one."""
    size: int
    """Number of unknowns."""
    area: Array
    """Area of each unknown [m2]."""
    loaded: Indices
    """Cells (flat) that have an unknown."""
    sides: Sides
    rim: Rim
    pattern: Pattern
    rim_number: Indices
    """Unknown of the pocket beyond each side of the rim, -1 for a reservoir."""
    region: Indices
    """Region of connected liquid that each unknown belongs to."""
    is_enclosed: NDArray[np.bool_]
    """Regions connected to no reservoir."""


def make_mesh(face: Face, tied: NDArray[np.int64] | None = None) -> Mesh:
    """Number the unknowns of a face and list its sides.

    Parameters
    ----------
    face : Face
        The face.
    tied : ndarray of int, shape (ny, nx), optional
        Number of the recess that a cell belongs to, 0 for none (`recesses`).

    Examples
    --------
    >>> import numpy as np
    >>> from contactkit.lubrication.reynolds.face import face_from_mask
    >>> mesh = make_mesh(face_from_mask(np.pad(np.ones((2, 3), bool), 1), 1.0))
    >>> mesh.size, len(mesh.sides.low), len(mesh.rim.cell)
    (6, 7, 10)
    """
    number, size = _numbers(face, tied)
    loaded = np.flatnonzero(number >= 0)
    area = np.bincount(number[loaded], minlength=size) * face.cell_area
    sides, rim = _sides(face, number)
    rim_number = number[rim.beyond]
    i, j = number[sides.low], number[sides.high]
    k, held = number[rim.cell], rim_number >= 0
    # Cells of one unknown, or that wrap round to each other, may have several sides in common.
    wraps = any(on and count < 3 for on, count in zip(face.periodic, face.shape, strict=True))
    pattern = _pattern((i, j), k, (k[held], rim_number[held]), size)
    if tied is not None or face.pockets or wraps:
        pattern = _merged(pattern, size)
    region, is_enclosed = _regions(size, pattern, k[~held])
    return Mesh(number, size, area, loaded, sides, rim, pattern, rim_number, region, is_enclosed)


def recesses(face: Face, gap: Array) -> NDArray[np.int64] | None:
    """Recesses of a gap: regions of film bounded all around by a step to a far smaller gap.

    Parameters
    ----------
    face : Face
        The face.
    gap : ndarray, shape (ny, nx)
        Gap [m].

    Returns
    -------
    ndarray of int, shape (ny, nx), or None
        Number of the recess of each cell, from 1; 0 elsewhere. None if there is no such step, or
        a recess reaches the rim.
    """
    flat, film = gap.ravel(), (face.owner == FILM).ravel()
    pairs = [neighbours(face, axis) for axis in (0, 1)]
    a, b = (np.concatenate(x) for x in zip(*pairs, strict=True))
    both = film[a] & film[b]
    a, b = a[both], b[both]
    step = np.maximum(flat[a], flat[b]) > DEEP * np.minimum(flat[a], flat[b])
    if not step.any():
        return None
    from scipy.sparse import coo_array
    from scipy.sparse.csgraph import connected_components

    level = ~step
    ones = np.ones(int(level.sum()), dtype=np.int8)
    joined = coo_array((ones, (a[level], b[level])), shape=(flat.size, flat.size))
    _, region = connected_components(joined, directed=False)
    deeper = np.where(flat[a] > flat[b], a, b)[step]
    shallower = np.where(flat[a] > flat[b], b, a)[step]
    deep = np.zeros(region.max() + 1, bool)
    deep[region[deeper]] = True
    deep[region[shallower]] = False  # not a terrace between two steps
    tied = np.where(film & deep[region], region + 1, 0)
    return tied.reshape(gap.shape) if tied.any() else None


def neighbours(face: Face, axis: int) -> tuple[Indices, Indices]:
    """Pairs of neighbouring cells (flat) along an axis: the lower and the higher."""
    index = np.arange(face.level.size).reshape(face.shape)
    after = np.roll(index, -1, axis)
    if not face.periodic[axis]:
        cut = (slice(None, -1), slice(None)) if axis == 0 else (slice(None), slice(None, -1))
        index, after = index[cut], after[cut]
    return index.ravel(), after.ravel()


def _numbers(face: Face, tied: NDArray[np.int64] | None) -> tuple[Indices, int]:
    """Unknown of each cell: cells of film in order, then recesses, then pockets."""
    owner = face.owner.ravel()
    group = np.zeros(owner.size, dtype=np.int64)
    if tied is not None:
        group = np.where(owner == FILM, tied.ravel(), 0)
    group = np.where(owner > FILM, group.max() + owner, group)
    number = np.full(owner.size, -1, dtype=np.int64)
    single = (owner == FILM) & (group == 0)
    size = int(single.sum())
    number[single] = np.arange(size)
    for label in np.unique(group[group > 0]):
        number[group == label] = size
        size += 1
    return number, size


def _sides(face: Face, number: Indices) -> tuple[Sides, Rim]:
    owner, level = face.owner.ravel(), face.level.ravel()
    normal = _normal_squared(face)
    inner: list[tuple[Array, ...]] = []
    outer: list[tuple[Array, ...]] = []
    for axis in (0, 1):
        step, width = face.pixel_size[axis], face.pixel_size[1 - axis]
        low, high = neighbours(face, axis)
        both = (owner[low] == FILM) & (owner[high] == FILM) & (number[low] != number[high])
        count = int(both.sum())
        inner.append((low[both], high[both], np.full(count, axis), np.full(count, width / step)))
        for here, there, sign in ((low, high, 1.0), (high, low, -1.0)):
            at_rim = (owner[here] == FILM) & (owner[there] >= RESERVOIR) & (owner[there] != FILM)
            c, o = here[at_rim], there[at_rim]
            fraction = np.clip(level[c] / (level[c] - level[o]), NEAREST_RIM, 1.0)
            geometry = width / (step * fraction)
            excess = 0.5 * (1.0 - fraction) * normal[axis].ravel()[c]
            round_hole = _around_circles(face, o, axis, sign, geometry)
            excess[round_hole] = 0.0
            axes, signs = np.full(c.size, axis), np.full(c.size, sign)
            outer.append((c, o, axes, signs, geometry, fraction * step, excess))
    sides = Sides(*(np.concatenate(x) for x in zip(*inner, strict=True)))
    rim = Rim(*(np.concatenate(x) for x in zip(*outer, strict=True)))
    return sides, rim


def _normal_squared(face: Face) -> tuple[Array, Array]:
    """Squared components of the normal of the rim along y and x, of unit length."""
    slopes = [
        np.gradient(face.level, size, axis=axis) if count > 1 else np.zeros(face.shape)
        for axis, (size, count) in enumerate(zip(face.pixel_size, face.shape, strict=True))
    ]
    steep = np.maximum(slopes[0] ** 2 + slopes[1] ** 2, 1e-300)
    return slopes[0] ** 2 / steep, slopes[1] ** 2 / steep


def _around_circles(
    face: Face, beyond: Indices, axis: int, sign: float, geometry: Array
) -> NDArray[np.bool_]:
    """Conductance of radial flow at sides of round holes, in place; which sides these are.

    Radial flow through a side is the angle that it spans from the centre of the hole, over
    ln(d/a): all sides of a hole together span one turn, whatever their number.
    """
    which = face.circle.ravel()[beyond]
    step, width = face.pixel_size[axis], face.pixel_size[1 - axis]
    for number, circle in enumerate(face.circles):
        chosen = which == number
        row, column = np.divmod(beyond[chosen], face.shape[1])
        y, x = face.y[row, 0] - circle.y, face.x[0, column] - circle.x
        # From the hole's cell towards the film: against the sign.
        normal, along = (y, x) if axis == 0 else (x, y)
        at_side, at_film = normal - 0.5 * sign * step, normal - sign * step
        first, last = along - 0.5 * width, along + 0.5 * width
        angle = np.abs(np.arctan2(last, -sign * at_side) - np.arctan2(first, -sign * at_side))
        far = np.maximum(np.hypot(at_film, along), circle.radius + NEAREST_RIM * step)
        geometry[chosen] = angle / np.log(far / circle.radius)
    return np.asarray(which >= 0)


def _regions(size: int, pattern: Pattern, at_reservoir: Indices) -> tuple[Indices, Any]:
    """Connected parts of the liquid, and which of them no reservoir reaches."""
    from scipy.sparse import csr_array
    from scipy.sparse.csgraph import connected_components

    entries = np.ones(len(pattern.columns), dtype=np.int8)
    graph = csr_array((entries, pattern.columns, pattern.starts), shape=(size, size))
    count, region = connected_components(graph, directed=False)
    is_enclosed = np.ones(count, bool)
    is_enclosed[region[at_reservoir]] = False
    return region.astype(np.int64), is_enclosed


def _pattern(
    sides: tuple[Indices, Indices],
    at_rim: Indices,
    to_pocket: tuple[Indices, Indices],
    size: int,
) -> Pattern:
    """CSR pattern, with a slot for each value in the order of `discretise`."""
    i, j = sides
    k, pocket = to_pocket
    own = np.arange(size)
    rows = np.concatenate([i, j, k, pocket, own])
    columns = np.concatenate([j, i, pocket, k, own])
    # Sorted by row: by hand, so that no entries are summed.
    order = np.argsort(rows, kind="stable")
    place = np.empty(rows.size, dtype=np.int64)
    place[order] = np.arange(rows.size)
    forth, back, out, back_in, diagonal = np.split(
        place, np.cumsum([i.size, i.size, k.size, k.size])
    )
    slot = np.concatenate(
        [diagonal[i], diagonal[j], forth, back, diagonal[at_rim], diagonal[pocket], out, back_in]
    )
    starts = np.concatenate([[0], np.cumsum(np.bincount(rows, minlength=size))])
    return Pattern(slot, columns[order].astype(np.int32), starts.astype(np.int32))


def _merged(pattern: Pattern, size: int) -> Pattern:
    """The same pattern with entries of the same place as one."""
    rows = np.repeat(np.arange(size), np.diff(pattern.starts))
    place, first = np.unique(rows * size + pattern.columns, return_inverse=True)
    row, column = np.divmod(place, size)
    starts = np.concatenate([[0], np.cumsum(np.bincount(row, minlength=size))])
    slot = first[pattern.slot]
    return Pattern(slot, column.astype(np.int32), starts.astype(np.int32))
