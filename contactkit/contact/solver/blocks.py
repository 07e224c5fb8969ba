"""Long waves of the preconditioner: one unknown for every block of pixels.

A block value raises all contact pixels of the block alike. The operator between blocks is that of
a coarse grid of the same solid, weighted by how much of each block is in contact; what the coarse
grid lacks of a pixel's own influence is put on the diagonal. It is inverted roughly by a few
conjugate gradient steps.

======  ==========================================================
symbol  meaning
======  ==========================================================
w       square root of the number of contact pixels of each block
B       pixels in a block
======  ==========================================================
"""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from .convolution import Convolution, self_influence

__all__ = ["CoarseBlocks"]

Floats = NDArray[np.float64]
Singles = NDArray[np.float32]


class CoarseBlocks:
    """Blocks of a grid, with the operator between them.

    Parameters
    ----------
    shape : tuple of int
        Pixels of the fine grid.
    blocks : tuple of int
        Blocks along both sides.
    symbol : ndarray
        Symbol of the grid of the blocks, dimensionless as that of the grid.
    periodic : bool
        Whether the map repeats.
    fast : bool
        Transforms by ducc0.
    own : float
        Self influence of a pixel of the grid.

    Examples
    --------
    >>> blocks = CoarseBlocks((4, 4), (2, 2), np.ones((2, 2)), periodic=True)
    >>> blocks.block_of(np.array([0, 5, 15]))
    array([0, 0, 3])
    """

    def __init__(
        self,
        shape: tuple[int, int],
        blocks: tuple[int, int],
        symbol: Floats,
        periodic: bool,
        fast: bool = False,
        own: float = 1.0,
    ) -> None:
        self.shape = blocks
        self.count = blocks[0] * blocks[1]
        self.width = shape[1]
        self.operator = Convolution(blocks, symbol, periodic, 1, fast, np.float32)
        self._row = np.arange(shape[0]) * blocks[0] // shape[0] * blocks[1]
        self._column = np.arange(shape[1]) * blocks[1] // shape[1]
        self._pixels = shape[0] * shape[1] / (blocks[0] * blocks[1])
        width = blocks[1] if periodic else 2 * blocks[1]
        self._own = max(own - self_influence(symbol, width) / self._pixels, 0.05 * own)
        self.weigh(np.ones(self.count), False)

    def block_of(self, pixels: NDArray[Any]) -> NDArray[np.intp]:
        """Block of each pixel, by flat indices."""
        row, column = np.divmod(pixels, self.width)
        return np.asarray(self._row[row] + self._column[column])

    def weigh(self, count: Floats, load_fixed: bool) -> None:
        """Set the number of contact pixels of each block, and whether their sum is prescribed."""
        self.share = np.where(count > 0.0, 1.0 / np.maximum(count, 1.0), 0.0)
        self._w = np.sqrt(count).reshape(self.shape).astype(np.float32)
        self._over_w = np.sqrt(self.share).reshape(self.shape).astype(np.float32)
        root = np.float32(np.sqrt(count.sum()))
        self._unit = self._w / root if load_fixed else None

    def _free_of_mean(self, x: Singles) -> Singles:
        if self._unit is not None:
            x -= self._unit * np.vdot(self._unit, x)
        return x

    def _apply(self, x: Singles) -> Singles:
        np.multiply(self._w, x, out=self.operator.source)
        y = self.operator.run() * self._w
        y *= np.float32(1.0 / self._pixels)
        y += np.float32(self._own) * x
        return self._free_of_mean(y)

    def solve(self, total: Floats, tolerance: float = 0.2, most: int = 25) -> Floats:
        """Block values that balance the sums of the residual over the blocks, both flat."""
        r = self._free_of_mean(total.reshape(self.shape).astype(np.float32) * self._over_w)
        x = np.zeros_like(r)
        d = r.copy()
        rr = float(np.vdot(r, r))
        stop = tolerance**2 * rr
        for _ in range(most):
            if rr <= stop:
                break
            q = self._apply(d)
            step = rr / float(np.vdot(d, q))
            x += step * d
            r -= step * q
            before, rr = rr, float(np.vdot(r, r))
            d *= rr / before
            d += r
        return np.asarray((x * self._over_w).ravel(), dtype=np.float64)
