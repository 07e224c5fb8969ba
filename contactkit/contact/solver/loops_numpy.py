"""Loops over pixels of the active-set method in numpy; `loops_numba` has the same ones compiled.

Maps are flat; `at` are flat indices of the free pixels, whose pressure lies between its bounds or
leaves one of them.

Sign convention: pressure and reduced gap ``g = u - h`` positive into the solid.

========  ===========================================================
symbol    meaning
========  ===========================================================
p, upper  pressure and its bound, ``(n,)`` and ``(n,)`` or ``(1,)``
g         reduced gap, ``(n,)``
r, z      residual and preconditioned residual on the free pixels
d, q      search direction and its displacement, on the same
========  ===========================================================
"""

from __future__ import annotations

from contextlib import AbstractContextManager, nullcontext
from typing import Any, NamedTuple

import numpy as np
import scipy.sparse
from numpy.typing import NDArray

from ...numerics.fft import scale_spectrum

__all__ = [
    "Cells",
    "FreeSet",
    "FreeSums",
    "Lattices",
    "LineStep",
    "Violation",
    "add_change",
    "add_scaled",
    "add_block_values",
    "step_along",
    "block_sums",
    "dot",
    "cell_neighbours",
    "cell_rows",
    "apply_factor",
    "lattice_neighbours",
    "on_threads",
    "pattern_rows",
    "sparse_factor",
    "violation",
    "subtract_block_values",
    "gather",
    "scatter",
    "reduce_gap",
    "scale_to_load",
    "scale_spectrum",
    "free_set",
    "add_and_clip",
    "apply_stencil",
    "free_sums",
    "next_direction",
]

Array = NDArray[Any]
Index = NDArray[np.intp]
LIFT = 1.0 + 1e-7  # of the diagonal of small matrices, which may be singular to round-off


class FreeSums(NamedTuple):
    """Sums of p and of p g over the pixels between the bounds, their number, and the sum of all."""

    pressure: float
    weighted_gap: float
    n_pixels: int
    total: float


class Violation(NamedTuple):
    """Largest violation of a contact condition, bound of the energy error, deepest penetration."""

    worst: float
    energy: float
    deepest: float


class FreeSet(NamedTuple):
    """Flat indices of the free pixels, and how many of these leave a bound."""

    at: Index
    added: int


class LineStep(NamedTuple):
    """Length of a step along a search direction, and the squared residual after it."""

    length: float
    squared_residual: float


def on_threads(count: int) -> AbstractContextManager[None]:
    """Have the loops take a number of threads, within a ``with``: these take one."""
    return nullcontext()


def dot(a: Array, b: Array) -> float:
    """Scalar product; not of BLAS, whose threads wait longer for each other than this takes."""
    return float((a * b).sum())


def reduce_gap(u: Array, h: Array) -> float:
    """Turn a displacement into the reduced gap, in place; the largest displacement."""
    largest = float(max(u.max(), -u.min()))
    u -= h
    return largest


def add_change(g: Array, change: Array) -> None:
    """Add a change of the displacement in single precision to the reduced gap, in place."""
    g += change


def free_sums(p: Array, g: Array, upper: Array) -> FreeSums:
    """Sums of p and p g over the pixels between the bounds, their number, and the sum of all p."""
    free = np.flatnonzero((p > 0.0) & (p < upper))
    weight = p[free]
    carried = float(weight.sum())
    total = carried if np.isinf(upper).all() else float(p.sum())
    return FreeSums(carried, dot(weight, g[free]), free.size, total)


def violation(p: Array, g: Array, upper: Array, approach: float) -> Violation:
    """Violation of the contact conditions by a pressure and its gap."""
    touching = np.flatnonzero(p > 0.0)
    inside, weight = g[touching] - approach, p[touching]
    bound = np.broadcast_to(upper, p.shape)[touching]
    room = np.where(np.isfinite(bound), bound - weight, weight)
    energy = dot(weight, np.maximum(inside, 0.0)) - dot(room, np.minimum(inside, 0.0))
    inside[(weight >= bound) & (inside < 0.0)] = 0.0
    worst, deepest = float(np.abs(inside).max(initial=0.0)), -float(inside.min(initial=0.0))
    below = np.flatnonzero(g < approach)
    below = below[p[below] <= 0.0]
    bound = np.broadcast_to(upper, p.shape)[below]
    depth = np.where(bound > 0.0, approach - g[below], 0.0)
    finite = np.isfinite(bound)
    energy += dot(bound[finite], depth[finite])
    most = float(depth.max(initial=0.0))
    return Violation(max(worst, most), energy, max(deepest, most))


def free_set(p: Array, g: Array, upper: Array, approach: float) -> FreeSet:
    """Free pixels, and how many of them leave a bound.

    Those between the bounds, those out of contact that would be penetrated and those at the upper
    bound that would gape.
    """
    free = (p > 0.0) & (p < upper)
    inside = int(np.count_nonzero(free))
    closing = g < approach
    closing &= p <= 0.0
    free |= closing & (upper > 0.0) if np.any(upper <= 0.0) else closing
    if np.isfinite(upper).any():
        free |= (p >= upper) & (g > approach) & (p > 0.0)
    at = np.flatnonzero(free)
    return FreeSet(at, at.size - inside)


def gather(full: Array, at: Index, out: Array) -> None:
    """Read the free pixels of a map."""
    out[...] = full[at]


def scatter(full: Array, at: Index, values: Array) -> None:
    """Write the free pixels of a map."""
    full[at] = values


def block_sums(block: Index, values: Array, count: int) -> NDArray[np.float64]:
    """Sum over the free pixels of each block."""
    return np.asarray(np.bincount(block, values, count), dtype=np.float64)


def subtract_block_values(values: Array, block: Index, of_block: Array, out: Array) -> None:
    """Subtract a value of its block from every free pixel."""
    np.subtract(values, of_block.astype(values.dtype)[block], out=out)


def add_block_values(values: Array, block: Index, of_block: Array) -> None:
    """Add a value of its block to every free pixel, in place."""
    values += of_block.astype(values.dtype)[block]


def apply_stencil(
    padded: Array, at: Index, stride: int, weights: tuple[float, ...], z: Array
) -> None:
    """Three by three stencil at the free pixels of a map with a margin of one pixel."""
    centre, y, x, diagonal = weights
    z[...] = centre * padded[at]
    for weight, first, second in (
        (y, stride, -stride),
        (x, 1, -1),
        (diagonal, stride + 1, -stride - 1),
        (diagonal, stride - 1, 1 - stride),
    ):
        z += weight * (padded[at + first] + padded[at + second])


def next_direction(
    d: Array, z: Array, r: Array, q: Array, length: float, before: float, load_fixed: bool
) -> float:
    """Next conjugate direction in place, from the last step and its ``r z``; the new ``r z``."""
    if load_fixed:
        z -= z.mean(dtype=np.float64)
    rz = dot(r, z)
    beta = max(-length * dot(z, q) / before, 0.0) if before > 0.0 else 0.0
    d *= beta
    d += z
    return rz


def step_along(x: Array, r: Array, d: Array, q: Array, load_fixed: bool) -> LineStep:
    """Step to the minimum along d."""
    if load_fixed:
        q -= q.mean(dtype=np.float64)
    curvature = dot(d, q)
    if not curvature > 0.0:
        return LineStep(0.0, 0.0)
    length = dot(r, d) / curvature
    x += length * d
    r -= length * q
    return LineStep(length, dot(r, r))


def add_scaled(change: Array, displacement: Array, length: float) -> None:
    """Add a step to the change of the displacement, in place; overwrites `displacement`."""
    displacement *= length
    change += displacement


def add_and_clip(p: Array, at: Index, x: Array, upper: Array) -> int:
    """Add a correction to the free pixels within the bounds; number of pixels that reach one."""
    value = p[at] + x
    bound = np.broadcast_to(upper, p.shape)[at]
    stopped = int(np.count_nonzero((value <= 0.0) | (value >= bound)))
    p[at] = np.clip(value, 0.0, bound)
    return stopped


def scale_to_load(p: Array, at: Index, upper: Array, load: float) -> None:
    """Scale the free pixels so that all pressures sum to the load."""
    free = p[at]
    carried = float(free.sum())
    p[at] = 0.0  # summed apart, for between rigid bodies they may dwarf the load
    rest = load - float(p.sum())
    factor = rest / carried if carried > 0.0 and rest > 0.0 else 1.0
    p[at] = np.minimum(free * factor, np.broadcast_to(upper, p.shape)[at])


PART = 2**14  # rows at a time, to bound the memory of the neighbours


class Lattices(NamedTuple):
    """Nested lattices of a map, every pixel first, and the neighbours that pixels have on them.

    position : (ny nx) zeros, to work in
    of_row, of_column : coarsest lattice that has each row and each column
    strides : (n, 2) of the lattices; offsets : (k, 2) of the neighbours, in strides
    allowed : (n, k) whether an offset is another pixel; shape, periodic : of the map
    """

    position: Array
    of_row: Array
    of_column: Array
    strides: Array
    offsets: Array
    allowed: Array
    shape: tuple[int, int]
    periodic: bool


def lattice_neighbours(
    at: Index, lattices: Lattices
) -> tuple[NDArray[np.int32], NDArray[np.int32]]:
    """Neighbours ``(m, k + 1)`` that come before each free pixel, and the key of their pattern.

    Pixels are in the order of the lattices, the coarsest first. Neighbours are numbers of free
    pixels; the pixel itself is the last, and stands for those that are not there. The key has a bit
    for each neighbour that is, and the lattice above them.
    """
    (ny, nx), count = lattices.shape, len(lattices.offsets)
    position, bits = lattices.position, int(at.size).bit_length()
    row, column = np.divmod(at, nx)
    lattice = np.minimum(lattices.of_row[row], lattices.of_column[column]).astype(np.int32)
    own = np.arange(at.size, dtype=np.int32)
    rank = ((len(lattices.strides) - 1 - lattice) << bits) + own + 1
    position[at] = rank
    neighbours = np.empty((at.size, count + 1), np.int32)
    neighbours[:, -1] = own
    keys = lattice << count
    weights = (1 << np.arange(count)).astype(np.int32)
    for start in range(0, at.size, PART):
        part = slice(start, start + PART)
        here = lattice[part]
        y = row[part, None] + lattices.strides[here, :1] * lattices.offsets[:, 0]
        x = column[part, None] + lattices.strides[here, 1:] * lattices.offsets[:, 1]
        valid = lattices.allowed[here]
        if lattices.periodic:
            y, x = np.mod(y, ny), np.mod(x, nx)
        else:
            valid &= (y >= 0) & (y < ny) & (x >= 0) & (x < nx)
            y, x = np.clip(y, 0, ny - 1), np.clip(x, 0, nx - 1)
        there = position[y * nx + x]
        valid &= (there > 0) & (there < rank[part, None])
        number = (there & ((1 << bits) - 1)) - 1
        neighbours[part, :-1] = np.where(valid, number, own[part, None])
        keys[part] |= valid @ weights
    position[at] = 0
    return neighbours, keys


def pattern_rows(matrices: Array, keys: Array) -> NDArray[np.float32]:
    """Rows of the factor for patterns of neighbours, zero for those that are not there.

    Parameters
    ----------
    matrices : ndarray (n, k + 1, k + 1)
        Influence between a pixel and its neighbours on each lattice, the pixel last.
    keys : ndarray (t,)
        A bit for each neighbour that is there, and the lattice above them.

    Examples
    --------
    A pixel alone, and one with a neighbour:

    >>> pattern_rows(np.array([[[2.0, 1.0], [1.0, 2.0]]]), np.array([0, 1])).round(3)
    array([[ 0.   ,  0.707],
           [-0.408,  0.816]], dtype=float32)
    """
    size = matrices.shape[1]
    rows = np.zeros((keys.size, size), np.float32)
    alone, diagonal = float(matrices[0, -1, -1]), np.arange(size)
    unit = np.zeros((size, 1))
    unit[-1] = 1.0
    for start in range(0, keys.size, PART // 4):
        part = keys[start : start + PART // 4]
        inside = np.ones((part.size, size), bool)
        inside[:, :-1] = (part[:, None] >> diagonal[:-1]) & 1
        G = np.where(inside[:, :, None] & inside[:, None, :], matrices[part >> (size - 1)], 0.0)
        G[:, diagonal, diagonal] = np.where(inside, alone * LIFT, 1.0)
        found = np.linalg.solve(G, unit[None])[..., 0]
        bad = ~(found[:, -1] > 0.0)  # round-off of a nearly singular matrix: the pixel alone
        found[bad] = np.where(diagonal == size - 1, 1.0 / alone, 0.0)
        rows[start : start + PART // 4] = found / np.sqrt(found[:, -1:])
    return rows


def sparse_factor(neighbours: Array, rows: Array, table: Array) -> Any:
    """Sparse factor for `apply_factor`: each pixel has the row of the table of that number."""
    m, width = neighbours.shape
    first = np.arange(0, m * width + 1, width, dtype=np.int32)
    factor = scipy.sparse.csr_array((table[rows].ravel(), neighbours.ravel(), first), (m, m))
    return factor, factor.T


def apply_factor(factor: Any, r: Array) -> Array:
    """Factor times its transpose, times a residual."""
    rows, columns = factor
    return np.asarray(columns @ (rows @ r))


class Cells(NamedTuple):
    """Nested cells of pixels, those of a single pixel first.

    table : flat index of the free pixel that represents each cell, -1 where none is free; the
        levels one after the other, each row by row
    first : (n + 1,) of each level in the table; counts : (n, 2) cells; sizes : (n, 2) in pixels
    level : (m,) of the free pixels, the highest on which each represents a cell
    """

    table: Array
    first: Array
    counts: Array
    sizes: Array
    level: Array


def _window(middle: Array, reach: int, count: int, periodic: bool) -> tuple[Array, Array]:
    """Cells around some along one axis, each at most once, and which of them there are."""
    if periodic and 2 * reach + 1 >= count:
        some = np.broadcast_to(np.arange(count), (middle.size, count))
        return some, np.ones(some.shape, bool)
    some = middle[:, None] + np.arange(-reach, reach + 1)
    if periodic:
        return some % count, np.ones(some.shape, bool)
    return np.clip(some, 0, count - 1), (some >= 0) & (some < count)


def _representatives(
    at: Index, cells: Cells, n: int, reach: int, shape: tuple[int, int], repeats: tuple[bool, bool]
) -> Array:
    """Pixels that represent the cells of a level around some pixels; -1 where there is none."""
    row, column = np.divmod(at, shape[1])
    (ny, nx), (sy, sx) = cells.counts[n], cells.sizes[n]
    y, in_y = _window(row // sy, reach, int(ny), repeats[0])
    x, in_x = _window(column // sx, reach, int(nx), repeats[1])
    found = cells.table[cells.first[n] + y[:, :, None] * nx + x[:, None, :]]
    found = np.where(in_y[:, :, None] & in_x[:, None, :], found, -1)
    return np.asarray(found.reshape(at.size, -1))


def cell_neighbours(
    at: Index, cells: Cells, reach: int, shape: tuple[int, int], repeats: tuple[bool, bool]
) -> NDArray[np.int32]:
    """Flat indices of the predecessors of each free pixel, then itself, then -1.

    `repeats` states along which of y and x the map repeats.
    """
    own_level = np.full(shape[0] * shape[1], -1, np.int8)
    own_level[at] = cells.level
    width = 2 * (2 * reach + 1) ** 2
    neighbours = np.full((at.size, width), -1, np.int32)
    for n in np.unique(cells.level):
        some = np.flatnonzero(cells.level == n)
        for part in np.array_split(some, 1 + some.size // PART):
            here = at[part]
            same = _representatives(here, cells, n, reach, shape, repeats)
            before = (same >= 0) & (same < here[:, None]) & (own_level[same] == n)
            found = [np.where(before, same, -1)]
            if n + 1 < len(cells.counts):
                found.append(_representatives(here, cells, n + 1, reach, shape, repeats))
            found.append(here[:, None])
            all_of = np.hstack(found)
            there = all_of >= 0
            last = np.argsort(~there, axis=1, kind="stable")
            packed = np.take_along_axis(all_of, last, axis=1)[:, :width]
            neighbours[part, : packed.shape[1]] = packed
    return neighbours


def cell_rows(
    neighbours: Array, K: Array, shape: tuple[int, int], periodic: bool, round_off: float
) -> NDArray[np.float64]:
    """Rows of the factor: last columns of the inverse Cholesky factors between the neighbours.

    A matrix that is not positive definite to round-off leaves the pixel alone.
    """
    values = np.zeros(neighbours.shape)
    count = np.count_nonzero(neighbours >= 0, axis=1)
    for k in np.unique(count):
        some = np.flatnonzero(count == k)
        for part in np.array_split(some, 1 + some.size * int(k) ** 2 // (1 << 20)):
            values[part, :k] = _last_columns(neighbours[part, :k], K, shape, periodic, round_off)
    return values


def _last_columns(
    at: Array, K: Array, shape: tuple[int, int], periodic: bool, round_off: float
) -> Array:
    row, column = np.divmod(at, shape[1])
    dy = np.abs(row[:, :, None] - row[:, None, :])
    dx = np.abs(column[:, :, None] - column[:, None, :])
    if periodic:
        dy, dx = np.minimum(dy, shape[0] - dy), np.minimum(dx, shape[1] - dx)
    G = K[dy, dx]
    k, own = at.shape[1], float(K[0, 0])
    G[:, np.arange(k), np.arange(k)] = own * (1.0 + round_off)
    unit = np.zeros((k, 1))
    unit[-1] = 1.0
    w = np.linalg.solve(G, unit[None])[..., 0]
    # The last pivot of the factor is 1 / w: it must not be lost in round-off.
    bad = ~((w[:, -1] > 0.0) & (w[:, -1] * own < 1e12))
    w[bad] = 0.0
    w[bad, -1] = 1.0 / own
    return np.asarray(w / np.sqrt(w[:, -1:]))
