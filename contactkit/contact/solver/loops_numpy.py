"""Passes of the active-set method over maps and over the pixels that may move, on numpy.

`active_set_numba` has the same functions compiled. Maps are flat; `at` are flat indices.

Sign convention: pressure and reduced gap ``g = u - h`` positive into the solid.

======  =============================================================
symbol  meaning
======  =============================================================
p, cap  pressure and its bound, ``(n,)`` and ``(n,)`` or ``(1,)``
g       reduced gap, ``(n,)``
r, z    residual and preconditioned residual on the moving pixels
d, q    search direction and its displacement, on the same
======  =============================================================
"""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from ...numerics.fft import scale_spectrum

__all__ = [
    "accumulate",
    "add_block_values",
    "advance",
    "block_sums",
    "factor_rows",
    "grade",
    "less_block_values",
    "neighbour_masks",
    "pick",
    "put",
    "reduce_gap",
    "rescale",
    "scale_spectrum",
    "select",
    "settle",
    "stencil",
    "survey",
    "turn",
]

Array = NDArray[Any]
Index = NDArray[np.intp]


def reduce_gap(u: Array, h: Array) -> None:
    """Turn a displacement into the reduced gap, in place."""
    u -= h


def survey(p: Array, g: Array, cap: Array) -> tuple[float, float, int]:
    """Sums of p and p g over the pixels between the bounds, and the number of these."""
    free = np.flatnonzero((p > 0.0) & (p < cap))
    weight = p[free]
    return float(weight.sum()), float(weight @ g[free]), free.size


def grade(p: Array, g: Array, cap: Array, level: float) -> tuple[float, float, float]:
    """Largest violation of a contact condition, bound of the energy error, deepest penetration."""
    touching = np.flatnonzero(p > 0.0)
    inside, weight = g[touching] - level, p[touching]
    bound = np.broadcast_to(cap, p.shape)[touching]
    room = np.where(np.isfinite(bound), bound - weight, weight)
    energy = float(weight @ np.maximum(inside, 0.0)) - float(room @ np.minimum(inside, 0.0))
    inside[(weight >= bound) & (inside < 0.0)] = 0.0
    worst, deepest = float(np.abs(inside).max(initial=0.0)), -float(inside.min(initial=0.0))
    below = np.flatnonzero(g < level)
    below = below[p[below] <= 0.0]
    bound = np.broadcast_to(cap, p.shape)[below]
    depth = np.where(bound > 0.0, level - g[below], 0.0)
    finite = np.isfinite(bound)
    energy += float(bound[finite] @ depth[finite])
    most = float(depth.max(initial=0.0))
    return max(worst, most), energy, max(deepest, most)


def select(p: Array, g: Array, cap: Array, level: float) -> tuple[Index, int]:
    """Pixels that may move, and how many of them leave a bound.

    Those between the bounds, bare ones that would be penetrated and saturated ones that would gape.
    """
    free = (p > 0.0) & (p < cap)
    inside = int(np.count_nonzero(free))
    bare = g < level
    bare &= p <= 0.0
    free |= bare & (cap > 0.0) if np.any(cap <= 0.0) else bare
    if np.isfinite(cap).any():
        free |= (p >= cap) & (g > level) & (p > 0.0)
    at = np.flatnonzero(free)
    return at, at.size - inside


def pick(full: Array, at: Index, out: Array) -> None:
    """Read the moving pixels of a map."""
    out[...] = full[at]


def put(full: Array, at: Index, values: Array) -> None:
    """Write the moving pixels of a map."""
    full[at] = values


def block_sums(block: Index, values: Array, count: int) -> NDArray[np.float64]:
    """Sum over the moving pixels of each block."""
    return np.asarray(np.bincount(block, values, count), dtype=np.float64)


def less_block_values(values: Array, block: Index, of_block: Array, out: Array) -> None:
    """Take a value of its block off every moving pixel."""
    np.subtract(values, of_block.astype(values.dtype)[block], out=out)


def add_block_values(values: Array, block: Index, of_block: Array) -> None:
    """Add a value of its block to every moving pixel, in place."""
    values += of_block.astype(values.dtype)[block]


def stencil(padded: Array, at: Index, stride: int, weights: tuple[float, ...], z: Array) -> None:
    """Three by three stencil at the moving pixels of a map with a margin of one pixel."""
    centre, y, x, diagonal = weights
    z[...] = centre * padded[at]
    for weight, first, second in (
        (y, stride, -stride),
        (x, 1, -1),
        (diagonal, stride + 1, -stride - 1),
        (diagonal, stride - 1, 1 - stride),
    ):
        z += weight * (padded[at + first] + padded[at + second])


def turn(
    d: Array, z: Array, r: Array, q: Array, length: float, before: float, load_fixed: bool
) -> float:
    """Next search direction in place, from the last step and its ``r z``; the new ``r z``."""
    if load_fixed:
        z -= z.mean(dtype=np.float64)
    rz = float(np.dot(r, z))
    beta = max(-length * float(np.dot(z, q)) / before, 0.0) if before > 0.0 else 0.0
    d *= beta
    d += z
    return rz


def advance(x: Array, r: Array, d: Array, q: Array, load_fixed: bool) -> tuple[float, float]:
    """Step to the minimum along d; give back its length and the new squared residual."""
    if load_fixed:
        q -= q.mean(dtype=np.float64)
    curvature = float(np.dot(d, q))
    if not curvature > 0.0:
        return 0.0, 0.0
    length = float(np.dot(r, d)) / curvature
    x += length * d
    r -= length * q
    return length, float(np.dot(r, r))


def accumulate(change: Array, displacement: Array, length: float) -> None:
    """Add a step to the change of the displacement, in place; overwrites `displacement`."""
    displacement *= length
    change += displacement


def settle(p: Array, at: Index, x: Array, cap: Array) -> int:
    """Add a correction to the moving pixels and clip to the bounds; number of clipped pixels."""
    value = p[at] + x
    bound = np.broadcast_to(cap, p.shape)[at]
    clipped = int(np.count_nonzero((value <= 0.0) | (value >= bound)))
    p[at] = np.clip(value, 0.0, bound)
    return clipped


def rescale(p: Array, at: Index, cap: Array, load: float) -> None:
    """Scale the moving pixels so that all pressures sum to the load."""
    moving = p[at]
    share = float(moving.sum())
    rest = load - (float(p.sum()) - share)
    if share > 0.0 and rest > 0.0:
        p[at] = np.minimum(moving * (rest / share), np.broadcast_to(cap, p.shape)[at])


PART = 2**14  # rows at a time, to bound what the neighbours of all pixels would hold


def _neighbours(
    part: slice,
    order: Array,
    rank: Array,
    row: Array,
    column: Array,
    level: Array,
    strides: Array,
    offsets: Array,
    allowed: Array,
    shape: tuple[int, int],
    periodic: bool,
) -> tuple[Array, NDArray[np.bool_]]:
    """Order of the pixels around some, and which of them come before."""
    at = level[part]
    y = row[part, None] + strides[at, :1] * offsets[:, 0]
    x = column[part, None] + strides[at, 1:] * offsets[:, 1]
    valid = allowed[at]
    if not periodic:
        valid = valid & (y >= 0) & (y < shape[0]) & (x >= 0) & (x < shape[1])
    there = order[np.mod(y, shape[0]) * shape[1] + np.mod(x, shape[1])]
    return there, valid & (there > 0) & (there < rank[part, None])


def neighbour_masks(*around: Any) -> NDArray[np.int32]:
    """One bit for every neighbour of each pixel that is there and comes before it."""
    rank, offsets = around[1], around[6]
    masks = np.zeros(rank.size, np.int32)
    weights = (1 << np.arange(len(offsets))).astype(np.int32)
    for start in range(0, rank.size, PART):
        part = slice(start, start + PART)
        masks[part] = _neighbours(part, *around)[1] @ weights
    return masks


def factor_rows(*everything: Any) -> None:
    """Columns and values of the sparse factor: neighbours by their bits, then the pixel itself."""
    around, (_, ids, rows, first, columns, values) = everything[:-6], everything[-6:]
    rank = around[1]
    for start in range(0, rank.size, PART):
        part = slice(start, min(start + PART, rank.size))
        there, before = _neighbours(part, *around)
        there = (np.hstack([there, rank[part, None]]) - 1) % rank.size
        before = np.hstack([before, np.ones((len(before), 1), bool)])
        here = slice(first[part.start], first[part.stop])
        columns[here] = there[before]
        values[here] = rows[ids[part]][before]
