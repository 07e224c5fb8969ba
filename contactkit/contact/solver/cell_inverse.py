r"""Factorised sparse approximate inverse whose long waves are carried by cells in contact.

Under a stiff film the contact is scattered spots, most of which hold no point of a coarse lattice.
Here every *occupied* cell of a level has one free pixel that represents it, the one of its parts
nearest to its middle; a pixel's level is the highest on which it represents a cell. Its
predecessors are the representatives of the cells around it on its own level and of those around it
on the next coarser one. The row of a pixel is the last column of the inverse of the matrix between
it and its predecessors, as in `sparse_inverse`, and is kept as long as they stay the same.

Sign convention: pressure and displacement positive into the solid.

======  ==================================================================
symbol  meaning
======  ==================================================================
K       displacement of a map under unit pressure on its first pixel
L       sparse factor, ``L' L`` about the inverse; rows follow the pixels
======  ==================================================================
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
import scipy.sparse
from numpy.typing import NDArray

from ...numerics.fft import Edges
from .loops_numpy import Cells
from .sparse_inverse import lattice_strides

__all__ = ["CellInverse", "cell_levels", "cell_sizes"]

Floats = NDArray[np.float64]
Shape = tuple[int, int]
ROUND_OFF = {  # added to the diagonal, in parts of it: condition of the small matrices
    np.dtype(np.float32): 1e-7,
    np.dtype(np.float64): 1e-13,
}


def cell_sizes(shape: Shape, pixel_size: tuple[float, float]) -> NDArray[np.int32]:
    """Sides ``(n, 2)`` of nested cells in pixels, from a pixel to the whole map.

    Examples
    --------
    >>> cell_sizes((8, 16), (2.0, 1.0)).tolist()
    [[1, 1], [1, 2], [2, 4], [4, 8], [8, 16]]
    """
    sizes = lattice_strides(shape, pixel_size).tolist()
    while sizes[-1][0] < shape[0] or sizes[-1][1] < shape[1]:
        sizes.append([n if n >= most else 2 * n for n, most in zip(sizes[-1], shape, strict=True)])
    return np.array(sizes, np.int32)


def cell_levels(at: NDArray[np.intp], shape: Shape, sizes: NDArray[np.int32]) -> Cells:
    """Pixel that represents each cell of each level, and the level of each pixel.

    Parameters
    ----------
    at : ndarray (m,)
        Flat indices of the free pixels, sorted.
    shape : tuple of int
        Pixels of the map.
    sizes : ndarray (n, 2)
        Sides of the cells, of pixels first.

    Examples
    --------
    Two pixels of a row; the one nearer to the middle represents both of them:

    >>> cells = cell_levels(np.array([1, 3]), (1, 4), np.array([[1, 1], [1, 2], [1, 4]]))
    >>> cells.table.tolist(), cells.level.tolist()
    ([-1, 1, -1, 3, 1, 3, 1], [2, 1])
    """
    counts = -(-np.array(shape) // sizes)
    first = np.concatenate([[0], np.cumsum(counts.prod(axis=1))])
    table = np.full(first[-1], -1, np.int32)
    table[at] = at
    level, here = np.zeros(at.size, np.int8), np.arange(at.size)
    row, column = np.divmod(at, shape[1])
    for n in range(1, len(sizes)):
        (sy, sx), width = sizes[n], counts[n, 1]
        y, x = row[here], column[here]
        cell = (y // sy) * width + x // sx
        # twice the distance of the middles, an integer; the pixel breaks a tie
        off = np.abs(2 * (y % sy) + 1 - sy) + np.abs(2 * (x % sx) + 1 - sx)
        key = off * np.int64(at.size) + here
        nearest = np.full(counts[n].prod(), np.iinfo(np.int64).max)
        np.minimum.at(nearest, cell, key)
        here = here[key == nearest[cell]]
        level[here] = n
        table[first[n] + (row[here] // sy) * width + column[here] // sx] = at[here]
    return Cells(table, first, counts, sizes, level)


class CellInverse:
    """Factorised sparse approximate inverse of the operator on any set of pixels of one grid.

    Parameters
    ----------
    response : callable
        Gives the displacement under unit pressure on the pixel (0, 0), to the middle of the map if
        it repeats along both axes.
    shape : tuple of int
        Pixels of the map.
    pixel_size : tuple of float
        Any unit.
    periodic : bool, "x" or "y"
        Whether the map repeats, or along which axis alone.
    loops : namespace
        Loops over the pixels.
    reach : int
        Cells in each direction within which a pixel has predecessors, on its level and on the next.
    kind : dtype
        Precision of the rows. That of single numbers is too little under the stiffest films.

    Examples
    --------
    >>> from contactkit.contact.solver import loops_numpy
    >>> response = np.array([[2.0, 0.5], [0.5, 0.25]])
    >>> inverse = CellInverse(lambda: response, (2, 2), (1.0, 1.0), False, loops_numpy)
    >>> inverse.prepare(np.array([0, 3]))
    >>> inverse(np.array([2.0, 0.25], np.float32)).round(3)
    array([1., 0.], dtype=float32)
    """

    def __init__(
        self,
        response: Callable[[], Floats],
        shape: Shape,
        pixel_size: tuple[float, float],
        periodic: Edges,
        loops: Any,
        reach: int = 1,
        kind: Any = np.float32,
    ) -> None:
        self.shape, self.loops = shape, loops
        self.periodic = periodic is True  # else the response is that of all distances
        self.repeats = (periodic in (True, "y"), periodic in (True, "x"))
        self.reach, self.kind = reach, np.dtype(kind)
        self.response, self._lifted = response, np.zeros((0, 0))
        self.sizes = cell_sizes(shape, pixel_size)
        self.at = np.zeros(0, np.intp)
        width = 2 * (2 * reach + 1) ** 2
        self.neighbours = np.zeros((0, width), np.int32)
        self.values = np.zeros((0, width), self.kind)

    @property
    def nbytes(self) -> int:
        """Memory held between the solves, the factor of the last set of pixels among it."""
        held = self._lifted.nbytes + self.neighbours.nbytes + self.values.nbytes
        return int(held + self.at.nbytes)

    def prepare(self, at: NDArray[np.intp], load_fixed: bool = False) -> None:
        """Take a set of pixels, by sorted flat indices; a prescribed sum changes nothing here."""
        cells = cell_levels(at, self.shape, self.sizes)
        neighbours = self.loops.cell_neighbours(at, cells, self.reach, self.shape, self.repeats)
        self.values = self._rows(at, neighbours)
        self.at, self.neighbours = at, neighbours
        position = np.empty(self.shape[0] * self.shape[1], np.int32)
        position[at] = np.arange(at.size, dtype=np.int32)
        there = neighbours >= 0
        columns = position[neighbours[there]]
        first = np.zeros(at.size + 1, np.int32)
        np.cumsum(np.count_nonzero(there, axis=1), out=first[1:])
        size = (at.size, at.size)
        self.factor = scipy.sparse.csr_array((self.values[there], columns, first), shape=size)
        self.transposed = self.factor.T

    def _rows(self, at: NDArray[np.intp], neighbours: NDArray[np.int32]) -> NDArray[Any]:
        """Rows of the factor; those whose neighbours are the same as before are kept."""
        values = np.empty(neighbours.shape, self.kind)
        new = np.ones(at.size, bool)
        if self.at.size:
            before = np.minimum(np.searchsorted(self.at, at), self.at.size - 1)
            same = self.at[before] == at
            same[same] = (self.neighbours[before[same]] == neighbours[same]).all(axis=1)
            values[same] = self.values[before[same]]
            new = ~same
        if not self._lifted.size:  # a periodic response has zero mean: this makes it positive
            response = self.response()
            self._lifted = response - min(0.0, float(response.min()))
        values[new] = self.loops.cell_rows(
            neighbours[new], self._lifted, self.shape, self.periodic, ROUND_OFF[self.kind]
        )
        return values

    def __call__(self, r: NDArray[Any]) -> NDArray[Any]:
        """Pressures that would displace the pixels by about `r`, in its precision."""
        x = self.transposed @ (self.factor @ r.astype(self.kind, copy=False))
        return np.asarray(x).astype(r.dtype, copy=False)

    def clean(self) -> None:
        """Nothing: the rows are kept for the next set of pixels."""
