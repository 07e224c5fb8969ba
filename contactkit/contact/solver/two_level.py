"""Two-level preconditioner for many free pixels: a stencil for short waves, blocks for long ones.

Residuals are split into their means over blocks of pixels and the rest. The stencil, the inverse
of the operator cut to nearest neighbours, acts on the rest as if all pixels were free; the means
are balanced by a coarse problem with one unknown for every block (aggregation), which raises all
free pixels of the block alike. The operator between blocks is that of a coarse grid of the same
solid, weighted by how much of each block is free; what the coarse grid lacks of a pixel's own
influence is put on the diagonal. It is solved roughly by a few conjugate gradient steps.

Sign convention: pressure and displacement positive into the solid.

======  ===================================================
symbol  meaning
======  ===================================================
S       symbol of the operator
c       weights of the stencil: centre, y, x, diagonal
w       square root of the number of free pixels of a block
======  ===================================================
"""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from ...numerics.fft import Edges
from .conjugate_gradient import conjugate_gradient
from .convolution import (
    BY_SCIPY,
    Convolution,
    Transforms,
    framed_places,
    self_influence,
    symbol_width,
)
from .loops_numpy import dot

__all__ = ["CoarseBlocks", "Stencil", "TwoLevel", "inverse_stencil", "least_eigenvalue"]

Floats = NDArray[np.float64]
Singles = NDArray[np.float32]
# Least eigenvalue to keep, as a part of the centre weight: with 0.01 and 0.3 the contacts of the
# room take 1 % more applications (128 x 128 pixels).
SAFE = 0.1
ENOUGH = 1024  # rows of a symbol, of which the median is that of all


class Stencil(NamedTuple):
    """Weights of a symmetric three by three stencil: centre, y, x and diagonal neighbours."""

    centre: float
    y: float
    x: float
    diagonal: float


def least_eigenvalue(c: Stencil) -> float:
    r"""Smallest value of the symbol of a stencil.

    .. math:: t = c_0 + 2 c_y \cos a + 2 c_x \cos b + 4 c_d \cos a \cos b

    is linear in either cosine, so that its minimum is at a corner.

    Examples
    --------
    >>> least_eigenvalue(Stencil(4.0, -1.0, -1.0, 0.0))
    0.0
    """
    return min(
        c.centre + 2.0 * c.y * a + 2.0 * c.x * b + 4.0 * c.diagonal * a * b
        for a in (-1.0, 1.0)
        for b in (-1.0, 1.0)
    )


def inverse_stencil(symbol: Floats, width: int) -> Stencil:
    """Cut the inverse of an operator to nearest neighbours, and keep it positive definite.

    The inverse of a stiff layer, cut sharply, may be indefinite. Its neighbours are then weighed
    down towards the triangular window, with which any positive symbol stays positive.

    Parameters
    ----------
    symbol : ndarray (ny, width // 2 + 1)
        Half spectrum of the operator; wavenumber 0 may be zero.
    width : int
        Columns of the map that the spectrum belongs to.

    Examples
    --------
    >>> inverse_stencil(np.full((8, 5), 2.0), 8).centre
    0.5
    """
    ny = symbol.shape[0]
    symbol = symbol[: ny // 2 + 1]  # even: the other half is the same
    some = symbol[:: max(1, ny // ENOUGH)]
    floor = 1e-3 * float(np.median(some))
    k = 1.0 / np.maximum(symbol, floor)
    k[0, 0] = 0.0 if symbol[0, 0] <= floor else k[0, 0]
    k[1 : (ny + 1) // 2] *= 2.0
    k[:, 1:] *= 2.0
    if width % 2 == 0:
        k[:, -1] *= 0.5
    k /= ny * width
    a = np.cos(2.0 * np.pi * np.arange(symbol.shape[0]) / ny)
    b = np.cos(2.0 * np.pi * np.arange(symbol.shape[1]) / width)
    by_row, by_column = k.sum(axis=1), k.sum(axis=0)
    full = Stencil(float(by_row.sum()), float(a @ by_row), float(b @ by_column), float(a @ k @ b))
    for window in np.linspace(1.0, 0.5, 26):
        c = Stencil(full.centre, window * full.y, window * full.x, window**2 * full.diagonal)
        if least_eigenvalue(c) >= SAFE * c.centre:
            return c
    return c


class CoarseBlocks:
    """Blocks of a grid, with the operator between them: the coarse problem.

    Parameters
    ----------
    shape : tuple of int
        Pixels of the fine grid.
    blocks : tuple of int
        Blocks along both sides.
    symbol : ndarray
        Symbol of the grid of the blocks, dimensionless as that of the grid.
    periodic : bool, "x" or "y"
        Whether the map repeats, or along which axis alone.
    loops : namespace
        Loops over the pixels.
    transforms : Transforms
        Threads and backend.
    own : float
        Self influence of a pixel of the grid.

    Examples
    --------
    >>> from contactkit.contact.solver import loops_numpy
    >>> blocks = CoarseBlocks((4, 4), (2, 2), np.ones((2, 2)), True, loops_numpy)
    >>> blocks.block_of(np.array([0, 5, 15]))
    array([0, 0, 3])
    """

    def __init__(
        self,
        shape: tuple[int, int],
        blocks: tuple[int, int],
        symbol: Floats,
        periodic: Edges,
        loops: Any,
        transforms: Transforms = BY_SCIPY,
        own: float = 1.0,
    ) -> None:
        self.shape, self.loops = blocks, loops
        self.load_fixed = False  # the sum is kept by `_without_mean`, in the weights of the blocks
        self.count = blocks[0] * blocks[1]
        self.width = shape[1]
        self.operator = Convolution(blocks, symbol, periodic, transforms, np.float32)
        self._row = np.arange(shape[0]) * blocks[0] // shape[0] * blocks[1]
        self._column = np.arange(shape[1]) * blocks[1] // shape[1]
        self._pixels = shape[0] * shape[1] / (blocks[0] * blocks[1])
        width = symbol_width(blocks[1], periodic)
        # A pixel gives way under its own pressure more than as a part of its block.
        self._own = max(own - self_influence(symbol, width) / self._pixels, 0.05 * own)
        self.weigh(np.ones(self.count), False)

    def block_of(self, pixels: NDArray[Any]) -> NDArray[np.intp]:
        """Block of each pixel, by flat indices."""
        row, column = np.divmod(pixels, self.width)
        return np.asarray(self._row[row] + self._column[column])

    def weigh(self, count: Floats, load_fixed: bool) -> None:
        """Set the number of free pixels of each block, and whether their sum is prescribed."""
        self.per_pixel = np.where(count > 0.0, 1.0 / np.maximum(count, 1.0), 0.0)
        self._w = np.sqrt(count).astype(np.float32)
        self._over_w = np.sqrt(self.per_pixel).astype(np.float32)
        root = np.float32(np.sqrt(count.sum()))
        self._unit = self._w / root if load_fixed else None

    def _without_mean(self, x: Singles) -> Singles:
        if self._unit is not None:
            x -= self._unit * np.float32(dot(self._unit, x))
        return x

    def apply(self, d: Singles, q: Singles) -> None:
        """See `LinearSystem.apply`."""
        np.multiply(self._w, d, out=self.operator.source.ravel())
        np.multiply(self.operator.run().ravel(), self._w, out=q)
        q *= np.float32(1.0 / self._pixels)
        q += np.float32(self._own) * d
        self._without_mean(q)

    def precondition(self, r: Singles) -> Singles:
        """See `LinearSystem.precondition`: none."""
        return r.copy()

    def take_step(self, length: float) -> None:
        """See `LinearSystem.take_step`."""

    def solve(self, total: Floats, reduction: float = 0.2, max_iterations: int = 25) -> Floats:
        """Block values that balance the sums of the residual over the blocks, both flat."""
        r = self._without_mean(total.astype(np.float32) * self._over_w)
        x = np.zeros_like(r)
        conjugate_gradient(self, x, r, reduction, max_iterations)
        return np.asarray(x * self._over_w, dtype=np.float64)


class TwoLevel:
    """Approximate inverse of the operator on any set of pixels of one grid.

    Parameters
    ----------
    shape : tuple of int
        Pixels of the map.
    periodic : bool
        Whether the map repeats.
    stencil : Stencil
        For the short waves.
    blocks : CoarseBlocks, optional
        For the long waves; small maps do without.
    loops : namespace
        Loops over the pixels.
    framed : ndarray (ny + 2, nx + 2), optional
        Zeros in single precision, to borrow; left as zeros.

    Examples
    --------
    >>> from contactkit.contact.solver import loops_numpy
    >>> inverse = TwoLevel((4, 4), False, Stencil(2.0, -0.5, -0.5, 0.0), None, loops_numpy)
    >>> inverse.prepare(np.array([5, 6]), load_fixed=True)
    >>> inverse(np.array([1.0, 0.0], np.float32))
    array([ 2. , -0.5], dtype=float32)
    >>> inverse.clean()
    """

    def __init__(
        self,
        shape: tuple[int, int],
        periodic: bool,
        stencil: Stencil,
        blocks: CoarseBlocks | None,
        loops: Any,
        framed: Singles | None = None,
    ) -> None:
        self.periodic, self.stencil, self.blocks, self.loops = periodic, stencil, blocks, loops
        self.width, size = shape[1], (shape[0] + 2, shape[1] + 2)
        self.framed = np.zeros(size, np.float32) if framed is None else framed

    @property
    def nbytes(self) -> int:
        """Memory held between the solves, without that of `framed`."""
        return 0 if self.blocks is None else self.blocks.operator.nbytes

    def applications(self) -> int:
        """Applications of the operator between the blocks since its counter was reset."""
        return 0 if self.blocks is None else self.blocks.operator.count

    def prepare(self, at: NDArray[np.intp], load_fixed: bool) -> None:
        """Take a set of pixels, by flat indices, and whether the sum of pressures is prescribed."""
        self.at = framed_places(at, self.width)
        if self.blocks is not None:
            self.rest = np.empty(at.size, np.float32)
            self.block = self.blocks.block_of(at)
            ones = np.ones(at.size, np.float32)
            count = self.loops.block_sums(self.block, ones, self.blocks.count)
            self.blocks.weigh(count, load_fixed)

    def __call__(self, r: Singles) -> Singles:
        """Pressures that would displace the pixels by about `r`."""
        blocks, loops = self.blocks, self.loops
        if blocks is None:
            return self._short_waves(r)
        total = loops.block_sums(self.block, r, blocks.count)
        loops.subtract_block_values(r, self.block, total * blocks.per_pixel, self.rest)
        z = self._short_waves(self.rest)
        # The sums over blocks are those of the coarse problem: what short waves add is taken off.
        long = blocks.solve(total)
        long -= loops.block_sums(self.block, z, blocks.count) * blocks.per_pixel
        loops.add_block_values(z, self.block, long)
        return z

    def _short_waves(self, r: Singles) -> Singles:
        framed, loops = self.framed, self.loops
        flat, z = framed.ravel(), np.empty_like(r)
        loops.scatter(flat, self.at, r)
        if self.periodic:
            framed[0], framed[-1] = framed[-2], framed[1]
            framed[:, 0], framed[:, -1] = framed[:, -2], framed[:, 1]
        loops.apply_stencil(flat, self.at, framed.shape[1], tuple(self.stencil), z)
        return z

    def clean(self) -> None:
        """Leave zeros behind."""
        self.framed.ravel()[self.at] = 0.0
        if self.periodic:
            self.framed[[0, -1]] = 0.0
            self.framed[:, [0, -1]] = 0.0
