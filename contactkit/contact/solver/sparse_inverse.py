r"""Factorised sparse approximate inverse of the operator between the free pixels.

The pixels are put in order, those on the coarsest of nested lattices first. Given its nearest
predecessors, a pixel hardly depends on the others, whatever the solid: the near ones screen them.
Row by row, the inverse of a small matrix between a pixel and its near predecessors therefore gives
a good inverse of the whole, for long and short waves, for stiff plates as for half-spaces (the
Kullback-Leibler minimum among factors of that sparsity, Schaefer, Katzfuss & Owhadi, SIAM J. Sci.
Comput. 43 (2021) A2019-A2046, eq. 8). As the solid is the same everywhere a row depends only on
which neighbours are there; every such pattern is solved once and kept.

Sign convention: pressure and displacement positive into the solid.

======  ==================================================================
symbol  meaning
======  ==================================================================
K       displacement of a map under unit pressure on its first pixel
L       sparse factor, ``L' L`` about the inverse; rows follow the pixels
order   position of every pixel in the order, from 1; 0 where it is not free
======  ==================================================================
"""

from __future__ import annotations

from typing import Any

import numpy as np
import scipy.sparse
from numpy.typing import NDArray

from .loops_numpy import FactorRows, Ordering

__all__ = ["SparseInverse", "lattice_strides", "neighbour_matrices", "pattern_rows"]

Floats = NDArray[np.float64]
Singles = NDArray[np.float32]
Shape = tuple[int, int]
NEAR = 2  # squared distance of the neighbours, in strides: the eight nearest
WIDE = 5  # the same where the compliance falls steeply: all up to a knight's move
MAX_PATTERNS = 200_000  # beyond, all are dropped before the next active set


def lattice_strides(shape: Shape, pixel_size: tuple[float, float]) -> NDArray[np.int32]:
    """Strides ``(n, 2)`` of nested lattices, every pixel first; long pixels are first made square.

    Examples
    --------
    >>> lattice_strides((8, 64), (4.0, 1.0)).tolist()
    [[1, 1], [1, 2], [1, 4], [2, 8], [4, 16], [4, 32]]
    """
    (sy, sx), (dy, dx) = (1, 1), pixel_size
    strides = [(1, 1)]
    while True:
        can_y, can_x = 4 * sy <= shape[0], 4 * sx <= shape[1]
        if not (can_y or can_x):
            return np.array(strides, np.int32)
        long_y, long_x = sy * dy > 1.5 * sx * dx, sx * dx > 1.5 * sy * dy
        grow_y, grow_x = can_y and not (long_y and can_x), can_x and not (long_x and can_y)
        sy, sx = sy * (1 + grow_y), sx * (1 + grow_x)
        strides.append((sy, sx))


def _offsets(squared: int) -> NDArray[np.int32]:
    y, x = np.indices((5, 5)).reshape(2, -1) - 2
    near = (y**2 + x**2 <= squared) & (y**2 + x**2 > 0)
    return np.stack([y[near], x[near]], axis=1).astype(np.int32)


def neighbour_matrices(
    K: Floats, shape: Shape, strides: NDArray[np.int32], offsets: NDArray[np.int32]
) -> Floats:
    """Influence between a pixel and its neighbours on each lattice, ``(n, k + 1, k + 1)``.

    Parameters
    ----------
    K : ndarray
        Response as in `reduced_system.influence_matrix`, positive.
    shape : tuple of int
        Pixels of the map.
    strides : ndarray (n, 2)
        Unit of the offsets on each lattice, in pixels.
    offsets : ndarray (k, 2)
        Places of the neighbours; the pixel itself comes last.

    Examples
    --------
    >>> K = np.array([[2.0, 1.0, 0.0]])
    >>> neighbour_matrices(K, (1, 3), np.array([[1, 1]]), np.array([[0, 1]]))
    array([[[2., 1.],
            [1., 2.]]])
    """
    place = np.vstack([offsets, [[0, 0]]])
    apart = np.abs(place[:, None] - place[None])[None] * strides[:, None, None, :]
    dy, dx = apart[..., 0], apart[..., 1]
    if K.shape != shape:
        dy, dx = dy % shape[0], dx % shape[1]
        dy, dx = np.minimum(dy, shape[0] - dy), np.minimum(dx, shape[1] - dx)
    # Opposite neighbours may be farther apart than an isolated map is wide: never both there.
    return np.asarray(K[np.minimum(dy, K.shape[0] - 1), np.minimum(dx, K.shape[1] - 1)])


def pattern_rows(matrices: Floats, there: NDArray[np.bool_]) -> Floats:
    """Rows of the factor for patterns of neighbours, the pixel itself last.

    Parameters
    ----------
    matrices : ndarray (n, k + 1, k + 1)
        Influence between the pixel and its neighbours, one matrix for each pattern.
    there : ndarray (n, k)
        Which of the neighbours are in the patterns.

    Examples
    --------
    A pixel alone, and one with a neighbour:

    >>> matrix = np.array([[[2.0, 1.0], [1.0, 2.0]]])
    >>> pattern_rows(matrix.repeat(2, axis=0), np.array([[False], [True]])).round(3)
    array([[ 0.   ,  0.707],
           [-0.408,  0.816]])
    """
    inside = np.hstack([there, np.ones((len(there), 1), bool)])
    G = np.where(inside[:, :, None] & inside[:, None, :], matrices, 0.0)
    alone, diagonal = matrices[:, -1, -1:], np.arange(inside.shape[1])
    G[:, diagonal, diagonal] = np.where(inside, alone * (1.0 + 1e-7), 1.0)
    unit = np.zeros((len(diagonal), 1))
    unit[-1] = 1.0
    rows = np.asarray(np.linalg.solve(G, unit[None])[..., 0])
    own = rows[:, -1:]
    bad = ~(own > 0.0).ravel()  # round-off of a nearly singular matrix: the pixel alone
    rows[bad] = np.where(diagonal == diagonal[-1], 1.0 / alone[bad], 0.0)
    return rows / np.sqrt(rows[:, -1:])


def _coarsest(count: int, strides: NDArray[np.int32]) -> NDArray[np.int8]:
    """Coarsest lattice that has each of the lines along one side."""
    has = np.arange(count)[:, None] % strides == 0
    return np.asarray(strides.size - 1 - np.argmax(has[:, ::-1], axis=1), np.int8)


class SparseInverse:
    """Factorised sparse approximate inverse of the operator on any set of pixels of one grid.

    Parameters
    ----------
    response : ndarray
        Displacement under unit pressure on the pixel (0, 0), to the middle of the map if periodic.
    shape : tuple of int
        Pixels of the map.
    pixel_size : tuple of float
        Any unit.
    periodic : bool
        Whether the map repeats.
    steep : bool
        Whether the compliance falls faster than that of a half-space: more neighbours count.
    loops : namespace
        Loops over the pixels.
    memory : ndarray, optional
        Zeros of four bytes each, at least one per pixel, to borrow; left as zeros.

    Examples
    --------
    >>> from contactkit.contact.solver import loops_numpy
    >>> response = np.array([[2.0, 0.5], [0.5, 0.25]])
    >>> inverse = SparseInverse(response, (2, 2), (1.0, 1.0), False, False, loops_numpy)
    >>> inverse.prepare(np.array([0, 3]))
    >>> inverse(np.array([2.0, 0.25], np.float32)).round(3)
    array([1., 0.], dtype=float32)
    """

    def __init__(
        self,
        response: Floats,
        shape: Shape,
        pixel_size: tuple[float, float],
        periodic: bool,
        steep: bool,
        loops: Any,
        memory: NDArray[Any] | None = None,
    ) -> None:
        self.shape, self.periodic, self.loops = shape, periodic, loops
        self.response = response
        self.lift = min(0.0, float(response.min()))  # makes a periodic response positive
        self.strides = lattice_strides(shape, pixel_size)
        self.offsets = _offsets(WIDE if steep else NEAR)
        self.borrowed = memory is not None
        held = np.zeros(shape, np.int32) if memory is None else memory
        self.position = held.view(np.int32).ravel()[: shape[0] * shape[1]]
        self._lattice_y, self._lattice_x = map(_coarsest, shape, self.strides.T)
        self._matrices: Floats | None = None
        self.allowed = self._allowed()
        self.last = 0
        self._drop_patterns()

    def _drop_patterns(self) -> None:
        self.keys = np.zeros(0, np.int64)
        self.rows = np.zeros((0, len(self.offsets) + 1), np.float32)

    def _allowed(self) -> NDArray[np.bool_]:
        """Which offsets of each lattice are not the same pixel twice across a repeating edge."""
        if not self.periodic:
            return np.ones((len(self.strides), len(self.offsets)), bool)
        twice = 2 * self.strides[:, None, :] * self.offsets[None]
        size = np.array(self.shape)
        return np.asarray(((np.abs(twice) < size) | (twice == size)).all(axis=2))

    @property
    def nbytes(self) -> int:
        """Memory held between the solves, and by the last set of pixels."""
        order = 0 if self.borrowed else self.position.nbytes
        return int(order + self.rows.nbytes + self.keys.nbytes + self.last)

    def prepare(self, at: NDArray[np.intp], load_fixed: bool = False) -> None:
        """Take a set of pixels, by sorted flat indices; a prescribed sum changes nothing here."""
        row, column = np.divmod(at, self.shape[1])
        lattice = np.minimum(self._lattice_y[row], self._lattice_x[column])
        rank = (len(self.strides) - 1 - lattice).astype(np.int32) * np.int32(at.size)
        rank += np.arange(1, at.size + 1, dtype=np.int32)
        self.position[at] = rank
        order = Ordering(
            self.position,
            rank,
            row.astype(np.int32),
            column.astype(np.int32),
            lattice,
            self.strides,
            self.offsets,
            self.allowed,
            self.shape,
            self.periodic,
        )
        masks = self.loops.neighbour_masks(order)
        ids = self._rows_of(masks.astype(np.int64) | (lattice.astype(np.int64) << 32))
        count = np.bitwise_count(masks).astype(np.int32) + 1
        first = np.zeros(at.size + 1, np.int32)
        np.cumsum(count, out=first[1:])
        columns, values = np.empty(first[-1], np.int32), np.empty(first[-1], np.float32)
        rows = FactorRows(masks, ids, self.rows, first, columns, values)
        self.loops.factor_rows(order, rows)
        self.position[at] = 0
        self.factor = scipy.sparse.csr_array((values, columns, first), shape=(at.size, at.size))
        self.transposed = self.factor.T
        self.last = columns.nbytes + values.nbytes + first.nbytes

    def _rows_of(self, keys: NDArray[np.int64]) -> NDArray[np.int32]:
        """Rows of the table that belong to the patterns; new ones are solved first."""
        if self.keys.size > MAX_PATTERNS:
            self._drop_patterns()
        at, there = self._look_up(keys)
        if not there.all():
            self._solve_patterns(np.unique(keys[~there]))
            at, _ = self._look_up(keys)
        return at

    def _look_up(self, keys: NDArray[np.int64]) -> tuple[NDArray[np.int32], NDArray[np.bool_]]:
        """Places in the table, and whether the patterns are in it."""
        if not self.keys.size:
            return np.zeros(keys.size, np.int32), np.zeros(keys.size, bool)
        at = np.minimum(np.searchsorted(self.keys, keys), self.keys.size - 1)
        return at.astype(np.int32), self.keys[at] == keys

    def _solve_patterns(self, new: NDArray[np.int64]) -> None:
        if self._matrices is None:
            K = self.response - self.lift
            self._matrices = neighbour_matrices(K, self.shape, self.strides, self.offsets)
        bits, rows = 1 << np.arange(len(self.offsets)), [self.rows]
        for part in np.array_split(new, 1 + new.size // 4096):
            found = pattern_rows(self._matrices[part >> 32], (part[:, None] & bits) > 0)
            rows.append(found.astype(np.float32))
        keys = np.append(self.keys, new)
        at = np.argsort(keys)
        self.keys, self.rows = keys[at], np.vstack(rows)[at]

    def __call__(self, r: Singles) -> Singles:
        """Pressures that would displace the pixels by about `r`."""
        return np.asarray(self.transposed @ (self.factor @ r))

    def clean(self) -> None:
        """Release the set of pixels."""
        del self.factor, self.transposed
