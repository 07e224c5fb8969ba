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
from numpy.typing import NDArray

from .loops_numpy import Lattices

__all__ = ["SparseInverse", "lattice_strides", "neighbour_matrices"]

Floats = NDArray[np.float64]
Singles = NDArray[np.float32]
Shape = tuple[int, int]
NEAR = 2  # squared distance of the neighbours, in strides: the eight nearest
# The same where the compliance falls steeply: all up to a knight's move. Coatings of three times
# the modulus take 32 to 34 applications in place of 26 to 29 with the eight nearest; with 8, the
# whole square of 24, an isolated one takes 21, the others as many.
WIDE = 5
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


def _coarsest(count: int, strides: NDArray[np.int32]) -> NDArray[np.int8]:
    """Coarsest lattice that has each of the lines along one side."""
    has = np.arange(count)[:, None] % strides == 0
    return np.asarray(strides.size - 1 - np.argmax(has[:, ::-1], axis=1), np.int8)


def _allowed(
    strides: NDArray[np.int32], offsets: NDArray[np.int32], shape: Shape | None = None
) -> NDArray[np.bool_]:
    """Which offsets of each lattice are not the same pixel twice across a repeating edge."""
    if shape is None:
        return np.ones((len(strides), len(offsets)), bool)
    twice = 2 * strides[:, None, :] * offsets[None]
    size = np.array(shape)
    return np.asarray(((np.abs(twice) < size) | (twice == size)).all(axis=2))


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
        self.loops, self.is_wide, self.borrowed = loops, steep, memory is not None
        strides, offsets = lattice_strides(shape, pixel_size), _offsets(WIDE if steep else NEAR)
        held = np.zeros(shape, np.int32) if memory is None else memory
        self.lattices = Lattices(
            held.view(np.int32).ravel()[: shape[0] * shape[1]],
            _coarsest(shape[0], strides[:, 0]),
            _coarsest(shape[1], strides[:, 1]),
            strides,
            offsets,
            _allowed(strides, offsets, shape) if periodic else _allowed(strides, offsets),
            shape,
            periodic,
        )
        self.matrices = neighbour_matrices(response, shape, strides, offsets)
        self.matrices -= min(0.0, float(response.min()))  # a periodic response has zero mean
        # Where the row of each pattern of eight neighbours is; those of twenty are looked up.
        self.places = np.full(0 if steep else len(strides) << len(offsets), -1, np.int32)
        self.keys = np.zeros(0, np.int32)
        self.rows = np.zeros((0, len(offsets) + 1), np.float32)
        self.last = 0

    @property
    def nbytes(self) -> int:
        """Memory held between the solves, and by the last set of pixels."""
        order = 0 if self.borrowed else self.lattices.position.nbytes
        patterns = self.places.nbytes + self.keys.nbytes + self.rows.nbytes
        return int(order + patterns + self.last)

    def prepare(self, at: NDArray[np.intp], load_fixed: bool = False) -> None:
        """Take a set of pixels, by sorted flat indices; a prescribed sum changes nothing here."""
        neighbours, keys = self.loops.lattice_neighbours(at, self.lattices)
        rows = self._rows_of(keys)
        self.factor = self.loops.sparse_factor(neighbours, rows, self.rows)
        self.last = neighbours.nbytes + rows.nbytes

    def _rows_of(self, keys: NDArray[np.int32]) -> NDArray[np.int32]:
        """Rows of the table that belong to the patterns; new ones are solved first."""
        if self.keys.size > MAX_PATTERNS:
            self.keys, self.rows = self.keys[:0], self.rows[:0]
        found = self._look_up(keys)
        new = keys[found < 0]
        if new.size:
            new = np.unique(new)
            self._add(new)
            found = self._look_up(keys)
        return found

    def _look_up(self, keys: NDArray[np.int32]) -> NDArray[np.int32]:
        """Places of the patterns in the table; -1 for those that are not in it."""
        if not self.is_wide:
            return self.places[keys]
        at = np.searchsorted(self.keys, keys)
        return np.where(np.append(self.keys, -1)[at] == keys, at, -1).astype(np.int32)

    def _add(self, new: NDArray[np.int32]) -> None:
        keys = np.append(self.keys, new)
        rows = np.vstack([self.rows, self.loops.pattern_rows(self.matrices, new)])
        if self.is_wide:
            order = np.argsort(keys)
            keys, rows = keys[order], rows[order]
        else:
            self.places[new] = np.arange(self.keys.size, keys.size)
        self.keys, self.rows = keys, rows

    def __call__(self, r: Singles) -> Singles:
        """Pressures that would displace the pixels by about `r`."""
        z: Singles = self.loops.apply_factor(self.factor, r)
        return z

    def clean(self) -> None:
        """Release the set of pixels."""
        del self.factor
