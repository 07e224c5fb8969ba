"""Loops over pixels of the active-set method compiled by numba: the functions of `loops_numpy`.

Import this module only once numba is wanted; `compiled` gives serial or threaded functions, kept on
disk after their first use. Infinite bounds forbid the assumption that all numbers are finite, so
that only the order of sums is left to the compiler.

Sign convention and symbols: see `loops_numpy`.
"""

from __future__ import annotations

import functools
from collections.abc import Iterator
from contextlib import contextmanager
from types import SimpleNamespace
from typing import Any

import numba
import numpy as np
from numba import prange

from .loops_numpy import (
    LIFT,
    Cells,
    FreeSet,
    FreeSums,
    Lattices,
    LineStep,
    Violation,
    on_threads,
)

__all__ = ["compiled"]

Array = Any
PARTS = 64  # of a map, which threads take one by one
FAST = {"reassoc", "contract", "arcp", "nsz", "nnan"}


def scale_spectrum(spectrum: Array, symbol: Array) -> None:
    """Multiply a spectrum by a real symbol, or the half of a mirrored one, in place.

    Serial: the threads of a transform have each their part of the spectrum.
    """
    for i in range(spectrum.shape[0]):
        row = i if i < symbol.shape[0] else spectrum.shape[0] - i
        for j in range(spectrum.shape[1]):
            spectrum[i, j] *= symbol[row, j]


def reduce_gap(u: Array, h: Array) -> float:
    """Turn a displacement into the reduced gap, in place; the largest displacement."""
    largest = 0.0
    for k in prange(u.size):
        largest = max(largest, abs(u[k]))
        u[k] -= h[k]
    return largest


def add_change(g: Array, change: Array) -> None:
    """Add a change of the displacement in single precision to the reduced gap, in place."""
    for k in prange(g.size):
        g[k] += change[k]


def free_sums(p: Array, g: Array, upper: Array) -> FreeSums:
    """Sums of p and p g over the pixels between the bounds, their number, and the sum of all p."""
    many = 0 if upper.size == 1 else 1
    weight, weighted, free, total = 0.0, 0.0, 0, 0.0
    for k in prange(p.size):
        total += p[k]
        if 0.0 < p[k] < upper[k * many]:
            weight += p[k]
            weighted += p[k] * g[k]
            free += 1
    return FreeSums(weight, weighted, free, total)


def violation(p: Array, g: Array, upper: Array, approach: float) -> Violation:
    """Violation of the contact conditions by a pressure and its gap."""
    many = 0 if upper.size == 1 else 1
    worst, energy, deepest = 0.0, 0.0, 0.0
    for k in prange(p.size):
        off, bound = g[k] - approach, upper[k * many]
        if p[k] > 0.0:
            if off > 0.0:
                energy += p[k] * off
                worst = max(worst, off)
            else:
                energy -= (bound - p[k] if bound < np.inf else p[k]) * off
                if p[k] < bound:
                    worst = max(worst, -off)
                    deepest = max(deepest, -off)
        elif off < 0.0 and bound > 0.0:
            if bound < np.inf:
                energy -= bound * off
            worst = max(worst, -off)
            deepest = max(deepest, -off)
    return Violation(worst, energy, deepest)


def free_set(p: Array, g: Array, upper: Array, approach: float) -> FreeSet:
    """Free pixels, and how many of them leave a bound."""
    many = 0 if upper.size == 1 else 1
    parts = min(p.size, PARTS)
    at = np.empty(p.size, np.int32)
    counts, added = np.zeros(parts, np.int64), 0
    for part in prange(parts):  # each to the memory of its pixels, then one after the other
        first = count = part * p.size // parts
        for k in range(first, (part + 1) * p.size // parts):
            if p[k] <= 0.0 and g[k] >= approach:  # nearly all of them
                continue
            bound = upper[k * many]
            if p[k] <= 0.0:
                if bound > 0.0:
                    at[count] = k
                    count += 1
                    added += 1
            elif p[k] < bound:
                at[count] = k
                count += 1
            elif g[k] > approach:
                at[count] = k
                count += 1
                added += 1
        counts[part] = count - first
    ends = np.cumsum(counts)
    packed = np.empty(ends[-1], np.intp)
    for part in prange(parts):
        first, start = part * p.size // parts, ends[part] - counts[part]
        for k in range(counts[part]):
            packed[start + k] = at[first + k]
    return FreeSet(packed, added)


def gather(full: Array, at: Array, out: Array) -> None:
    """Read the free pixels of a map."""
    for a in prange(at.size):
        out[a] = full[at[a]]


def scatter(full: Array, at: Array, values: Array) -> None:
    """Write the free pixels of a map."""
    for a in prange(at.size):
        full[at[a]] = values[a]


def block_sums(block: Array, values: Array, count: int) -> Array:
    """Sum over the free pixels of each block."""
    sums = np.zeros(count)
    for a in range(block.size):
        sums[block[a]] += values[a]
    return sums


def subtract_block_values(values: Array, block: Array, of_block: Array, out: Array) -> None:
    """Subtract a value of its block from every free pixel."""
    for a in prange(values.size):
        out[a] = values[a] - of_block[block[a]]


def add_block_values(values: Array, block: Array, of_block: Array) -> None:
    """Add a value of its block to every free pixel, in place."""
    for a in prange(values.size):
        values[a] += of_block[block[a]]


def apply_stencil(f: Array, at: Array, stride: int, weights: tuple[float, ...], z: Array) -> None:
    """Three by three stencil at the free pixels of a map with a margin of one pixel."""
    centre = np.float32(weights[0])
    y, x, diagonal = np.float32(weights[1]), np.float32(weights[2]), np.float32(weights[3])
    for a in prange(at.size):
        k = at[a]
        up, down = k - stride, k + stride
        sides = f[up - 1] + f[up + 1] + f[down - 1] + f[down + 1]
        z[a] = centre * f[k] + y * (f[up] + f[down]) + x * (f[k - 1] + f[k + 1]) + diagonal * sides


def next_direction(
    d: Array, z: Array, r: Array, q: Array, length: float, before: float, load_fixed: bool
) -> float:
    """Next conjugate direction in place, from the last step and its ``r z``; the new ``r z``."""
    mean = 0.0
    if load_fixed:
        for a in prange(z.size):
            mean += z[a]
        mean /= z.size
    rz, zq = 0.0, 0.0
    for a in prange(z.size):
        value = np.float32(z[a] - mean)
        z[a] = value
        rz += r[a] * value
        zq += q[a] * value
    beta = max(-length * zq / before, 0.0) if before > 0.0 else 0.0
    for a in prange(z.size):
        d[a] = z[a] + beta * d[a]
    return rz


def step_along(x: Array, r: Array, d: Array, q: Array, load_fixed: bool) -> LineStep:
    """Step to the minimum along d."""
    mean = 0.0
    if load_fixed:
        for a in prange(q.size):
            mean += q[a]
        mean /= q.size
    dq, rd = 0.0, 0.0
    for a in prange(q.size):
        value = np.float32(q[a] - mean)
        q[a] = value
        dq += d[a] * value
        rd += d[a] * r[a]
    if not dq > 0.0:
        return LineStep(0.0, 0.0)
    length, rr = rd / dq, 0.0
    for a in prange(q.size):
        x[a] += length * d[a]
        r[a] -= length * q[a]
        rr += r[a] * r[a]
    return LineStep(length, rr)


def add_scaled(change: Array, displacement: Array, length: float) -> None:
    """Add a step to the change of the displacement, in place."""
    for k in prange(change.size):
        change[k] += length * displacement[k]


def add_and_clip(p: Array, at: Array, x: Array, upper: Array) -> int:
    """Add a correction to the free pixels within the bounds; number of pixels that reach one."""
    many = 0 if upper.size == 1 else 1
    stopped = 0
    for a in prange(at.size):
        value, bound = p[at[a]] + x[a], upper[at[a] * many]
        if value <= 0.0:
            value = 0.0
            stopped += 1
        elif value >= bound:
            value = bound
            stopped += 1
        p[at[a]] = value
    return stopped


def scale_to_load(p: Array, at: Array, upper: Array, load: float) -> None:
    """Scale the free pixels so that all pressures sum to the load."""
    many = 0 if upper.size == 1 else 1
    free = np.empty(at.size)
    held, carried = 0.0, 0.0
    for a in prange(at.size):
        free[a] = p[at[a]]
        carried += free[a]
        p[at[a]] = 0.0  # summed apart, for between rigid bodies they may dwarf the load
    for k in prange(p.size):
        held += p[k]
    rest = load - held
    factor = rest / carried if carried > 0.0 and rest > 0.0 else 1.0
    for a in prange(at.size):
        p[at[a]] = min(free[a] * factor, upper[at[a] * many])


@numba.njit(inline="always")
def _around(i: int, size: int) -> int:
    """Index in a row that repeats."""
    if i < 0:
        return i + size
    return i - size if i >= size else i


def lattice_neighbours(at: Array, lattices: Lattices) -> tuple[Array, Array]:
    """Neighbours that come before each free pixel, and the key of their pattern."""
    position, of_row, of_column = lattices.position, lattices.of_row, lattices.of_column
    strides, offsets, allowed = lattices.strides, lattices.offsets, lattices.allowed
    (ny, nx), periodic = lattices.shape, lattices.periodic
    size, count, bits = at.size, offsets.shape[0], 0
    while size >> bits:
        bits += 1
    rank, keys = np.empty(size, np.int32), np.empty(size, np.int32)
    for a in prange(size):
        n = min(of_row[at[a] // nx], of_column[at[a] % nx])
        rank[a] = ((strides.shape[0] - 1 - n) << bits) + a + 1
        position[at[a]] = rank[a]
    neighbours = np.empty((size, count + 1), np.int32)
    for a in prange(size):
        row, column = at[a] // nx, at[a] % nx
        n, key = np.int64(min(of_row[row], of_column[column])), 0
        for k in range(count):
            neighbours[a, k] = a
            y, x = row + strides[n, 0] * offsets[k, 0], column + strides[n, 1] * offsets[k, 1]
            if periodic:  # never farther than once around, and a division costs more than this
                y, x = _around(y, ny), _around(x, nx)
            elif y < 0 or y >= ny or x < 0 or x >= nx:
                continue
            there = position[y * nx + x]
            if 0 < there < rank[a] and allowed[n, k]:
                neighbours[a, k] = (there & ((1 << bits) - 1)) - 1
                key |= 1 << k
        neighbours[a, count] = a
        keys[a] = key | n << count
    for a in prange(size):
        position[at[a]] = 0
    return neighbours, keys


@numba.njit(cache=True)
def _last_column(G: Array, w: Array, k: int, least: float) -> bool:
    """Last column of the inverse of the Cholesky factor of k rows, transposed, into w.

    False if a pivot of the factor, which takes the place of the lower half of G, is below `least`.
    """
    for i in range(k):
        for j in range(i):
            v = G[i, j]
            for s in range(j):
                v -= G[i, s] * G[j, s]
            G[i, j] = v * w[j]
        v = G[i, i]
        for s in range(i):
            v -= G[i, s] ** 2
        if not v > least:
            return False
        w[i] = 1.0 / np.sqrt(v)
    for t in range(k - 1, -1, -1):
        v = 1.0 if t == k - 1 else 0.0
        for s in range(t + 1, k):
            v -= G[s, t] * w[s]
        w[t] *= v
    return True


def pattern_rows(matrices: Array, keys: Array) -> Array:
    """Rows of the factor for patterns of neighbours, zero for those that are not there."""
    last = matrices.shape[1] - 1
    alone = matrices[0, last, last]
    rows = np.zeros((keys.size, last + 1), np.float32)
    for a in prange(keys.size):
        G, w = np.empty((last + 1, last + 1)), np.empty(last + 1)
        there, count = np.empty(last + 1, np.int32), 0
        n = keys[a] >> last
        for k in range(last + 1):
            if k == last or keys[a] & (1 << k):
                there[count] = k
                for j in range(count):
                    G[count, j] = matrices[n, k, there[j]]
                G[count, count] = alone * LIFT
                count += 1
        if _last_column(G, w, count, 0.0):
            for j in range(count):
                rows[a, there[j]] = w[j]
        else:
            rows[a, last] = 1.0 / np.sqrt(alone)
    return rows


def apply_factor(factor: tuple[Array, Array, Array], r: Array) -> Array:
    """Factor times its transpose, times a residual."""
    neighbours, rows, table = factor
    z = np.zeros_like(r)
    for a in range(r.size):
        value = np.float32(0.0)
        for k in range(neighbours.shape[1]):
            value += table[rows[a], k] * r[neighbours[a, k]]
        for k in range(neighbours.shape[1]):
            z[neighbours[a, k]] += table[rows[a], k] * value
    return z


@numba.njit(inline="always")
def _span(middle: int, reach: int, count: int, periodic: bool) -> tuple[int, int]:
    """First and last cell around one along an axis, each at most once."""
    if periodic:
        return (0, count - 1) if 2 * reach + 1 >= count else (middle - reach, middle + reach)
    return max(middle - reach, 0), min(middle + reach, count - 1)


def cell_neighbours(
    at: Array, cells: Cells, reach: int, shape: tuple[int, int], repeats: tuple[bool, bool]
) -> Array:
    """Flat indices of the predecessors of each free pixel, then itself, then -1.

    `repeats` states along which of y and x the map repeats.
    """
    table, first, counts, sizes = cells.table, cells.first, cells.counts, cells.sizes
    own_level = np.full(shape[0] * shape[1], -1, np.int8)
    for a in range(at.size):
        own_level[at[a]] = cells.level[a]
    width = 2 * (2 * reach + 1) ** 2
    neighbours = np.full((at.size, width), -1, np.int32)
    for a in prange(at.size):
        row, column, own, k = at[a] // shape[1], at[a] % shape[1], cells.level[a], 0
        for n in range(own, min(own + 2, counts.shape[0])):
            ny, nx = counts[n, 0], counts[n, 1]
            y0, y1 = _span(row // sizes[n, 0], reach, ny, repeats[0])
            x0, x1 = _span(column // sizes[n, 1], reach, nx, repeats[1])
            for y in range(y0, y1 + 1):
                line = first[n] + _around(y, ny) * nx
                for x in range(x0, x1 + 1):
                    b = table[line + _around(x, nx)]
                    if b >= 0 and (n > own or (b < at[a] and own_level[b] == own)):
                        neighbours[a, k] = b
                        k += 1
        neighbours[a, k] = at[a]
    return neighbours


def cell_rows(
    neighbours: Array, K: Array, shape: tuple[int, int], periodic: bool, round_off: float
) -> Array:
    """Rows of the factor: last columns of the inverse Cholesky factors between the neighbours."""
    ny, nx = shape
    own, width = K[0, 0], neighbours.shape[1]
    values = np.zeros(neighbours.shape)
    for a in prange(neighbours.shape[0]):
        G, w = np.empty((width, width)), np.empty(width)
        y, x = np.empty(width, np.int32), np.empty(width, np.int32)
        k, sound = 0, True
        while k < width and neighbours[a, k] >= 0:
            y[k], x[k] = neighbours[a, k] // nx, neighbours[a, k] % nx
            for t in range(k + 1):
                dy, dx = abs(y[k] - y[t]), abs(x[k] - x[t])
                if periodic:
                    dy, dx = min(dy, ny - dy), min(dx, nx - dx)
                v = K[dy, dx]
                if t == k:
                    v *= 1.0 + round_off
                for s in range(t):
                    v -= G[k, s] * G[t, s]
                if t < k:
                    G[k, t] = v * w[t]
                else:
                    sound = sound and v > 1e-12 * own
                    w[k] = 1.0 / np.sqrt(max(v, 1e-12 * own))
            k += 1
        if not sound:
            values[a, k - 1] = 1.0 / np.sqrt(own)
            continue
        for t in range(k - 1, -1, -1):
            v = 1.0 if t == k - 1 else 0.0
            for s in range(t + 1, k):
                v -= G[s, t] * values[a, s]
            values[a, t] = v * w[t]
    return values


SERIAL = (scale_spectrum, block_sums, apply_factor)
THREADED = (
    free_set,
    reduce_gap,
    free_sums,
    violation,
    gather,
    scatter,
    subtract_block_values,
    add_block_values,
    apply_stencil,
    next_direction,
    step_along,
    add_change,
    add_scaled,
    add_and_clip,
    scale_to_load,
    lattice_neighbours,
    pattern_rows,
    cell_neighbours,
    cell_rows,
)


@contextmanager
def _on_threads(count: int) -> Iterator[None]:
    """Have the loops of this thread take a number of threads, as far as numba has them."""
    before = numba.get_num_threads()
    most = numba.config.NUMBA_NUM_THREADS  # type: ignore[attr-defined]
    numba.set_num_threads(min(count, most))
    try:
        yield
    finally:
        numba.set_num_threads(before)


@functools.lru_cache(maxsize=2)
def compiled(threaded: bool) -> SimpleNamespace:
    """The compiled loops as one namespace, serial or threaded.

    Parameters
    ----------
    threaded : bool
        Split the loops over the threads of `on_threads`.

    Notes
    -----
    The first use of a function in a fresh installation costs its compilation, some ten seconds for
    all of them; later processes load them from the cache.
    """
    serial = {f.__name__: numba.njit(f, cache=True, fastmath=FAST, nogil=True) for f in SERIAL}
    rest = {
        f.__name__: numba.njit(f, cache=True, fastmath=FAST, parallel=threaded) for f in THREADED
    }
    return SimpleNamespace(
        **serial,
        **rest,
        sparse_factor=lambda neighbours, rows, table: (neighbours, rows, table),
        on_threads=_on_threads if threaded else on_threads,
        __name__="loops_numba",
    )
