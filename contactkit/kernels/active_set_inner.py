"""Correction of the pressure on the pixels that may move, so that the gap becomes level there.

Preconditioned flexible conjugate gradients on vectors of the moving pixels alone, in single
precision: the residual they start from is exact, and what they leave is corrected next time.
A stencil answers for the short waves, coarse blocks for the long ones.

Sign convention: pressure, heights and displacement positive into the solid.
"""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from .active_set_direct import few_enough, influence_matrix, solve_directly
from .coarse_blocks import CoarseBlocks
from .convolve import Convolution
from .near_stencil import Stencil

__all__ = ["Correction", "Grid"]

Singles = NDArray[np.float32]
MOST_STEPS = 40


class Grid(NamedTuple):
    """One of the nested grids with everything that can be prepared.

    pressure, gap : maps in double precision
    exact : operator in double precision from `pressure` to `gap`; none on coarse grids
    quick : operator in single precision; its source is zero between uses
    response : displacement under unit pressure on the first pixel; to the middle if periodic
    margin : map with a margin of one pixel, for the stencil; zeros between the solves
    change : displacement gained since the last exact one, in single precision
    stencil, blocks : short and long waves of the preconditioner
    steepest : largest eigenvalue of the operator
    loops : passes over the pixels, of numpy or compiled
    """

    pressure: NDArray[np.float64]
    gap: NDArray[np.float64]
    exact: Convolution | None
    quick: Convolution
    response: NDArray[np.float64]
    margin: Singles
    change: Singles
    stencil: Stencil
    blocks: CoarseBlocks | None
    periodic: bool
    steepest: float
    loops: Any

    def applications(self) -> int:
        """Applications of the operator since the counters were reset."""
        return self.quick.count + (self.exact.count if self.exact is not None else 0)

    def displace(self, exactly: bool) -> None:
        """Displacement under `pressure`, into `gap`."""
        if exactly and self.exact is not None:
            self.exact.run()
            return
        # A uniform part displaces nothing if periodic, but would drown the rest in rounding.
        uniform = float(self.pressure.mean()) if self.periodic else 0.0
        np.subtract(self.pressure, uniform, out=self.quick.source, casting="same_kind")
        self.gap[...] = self.quick.run()
        self.quick.source[...] = 0.0


class Correction:
    """Correction for one set of moving pixels; `Grid.change` gets what it adds to the displacement.

    Parameters
    ----------
    grid : Grid
        The grid.
    at : ndarray (m,)
        Flat indices of the moving pixels.
    load_fixed : bool
        Whether the correction has a given sum instead of a given level.
    """

    def __init__(self, grid: Grid, at: NDArray[np.intp], load_fixed: bool) -> None:
        self.grid, self.at, self.load_fixed = grid, at, load_fixed
        self.source, self.target = grid.quick.source.ravel(), grid.quick.target.ravel()

    def solve(
        self, r: NDArray[np.float64], reduction: float, missing: float
    ) -> NDArray[np.floating[Any]]:
        """Correction that reduces the residual by a factor and sums to `missing`."""
        grid = self.grid
        if few_enough(self.at.size, grid.pressure.size):
            matrix = influence_matrix(grid.response, self.at, grid.pressure.shape)
            x = solve_directly(matrix, r, missing if self.load_fixed else None)
            if x is not None:
                grid.loops.put(self.source, self.at, x.astype(np.float32))
                grid.change[...] = grid.quick.run().ravel()
                self.source[self.at] = 0.0
                return x
        return self._iterate(r.astype(np.float32), reduction, missing)

    def _begin(self) -> None:
        width = self.grid.pressure.shape[1]
        self.inner_at = self.at + 2 * (self.at // width) + (width + 3)
        self.rest = np.empty(self.at.size, np.float32)
        blocks = self.grid.blocks
        if blocks is not None:
            self.block = blocks.block_of(self.at)
            ones = np.ones(self.at.size, np.float32)
            blocks.weigh(
                self.grid.loops.block_sums(self.block, ones, blocks.count), self.load_fixed
            )

    def _short_waves(self, r: Singles, z: Singles) -> None:
        margin, loops = self.grid.margin, self.grid.loops
        flat = margin.ravel()
        loops.put(flat, self.inner_at, r)
        if self.grid.periodic:
            margin[0], margin[-1] = margin[-2], margin[1]
            margin[:, 0], margin[:, -1] = margin[:, -2], margin[:, 1]
        loops.stencil(flat, self.inner_at, margin.shape[1], tuple(self.grid.stencil), z)

    def _precondition(self, r: Singles, z: Singles) -> None:
        blocks, loops = self.grid.blocks, self.grid.loops
        if blocks is None:
            self._short_waves(r, z)
            return
        total = loops.block_sums(self.block, r, blocks.count)
        loops.less_block_values(r, self.block, total * blocks.share, self.rest)
        self._short_waves(self.rest, z)
        long = blocks.solve(total)
        long -= loops.block_sums(self.block, z, blocks.count) * blocks.share
        loops.add_block_values(z, self.block, long)

    def _iterate(self, r: Singles, reduction: float, missing: float) -> Singles:
        grid, loops = self.grid, self.grid.loops
        self._begin()
        x, z, d, q = (np.zeros_like(r) for _ in range(4))
        grid.change[...] = 0.0
        if missing:  # an even share first: the steps below leave the sum alone
            d += missing / r.size
            self._apply(d, q)
            loops.accumulate(grid.change, self.target, 1.0)
            x += d
            d[...] = 0.0
            r -= q - q.mean(dtype=np.float64)
        stop = reduction**2 * float(np.dot(r, r))
        length, rz = 0.0, 0.0
        for _ in range(MOST_STEPS if stop > 0.0 else 0):
            self._precondition(r, z)
            rz = loops.turn(d, z, r, q, length, rz, self.load_fixed)
            self._apply(d, q)
            length, rr = loops.advance(x, r, d, q, self.load_fixed)
            loops.accumulate(grid.change, self.target, length)
            if rr <= stop:
                break
        self._clean()
        return x

    def _apply(self, d: Singles, q: Singles) -> None:
        self.grid.loops.put(self.source, self.at, d)
        self.grid.quick.run()
        self.grid.loops.pick(self.target, self.at, q)

    def _clean(self) -> None:
        self.source[self.at] = 0.0
        self.grid.margin.ravel()[self.inner_at] = 0.0
        if self.grid.periodic:
            self.grid.margin[[0, -1]] = 0.0
            self.grid.margin[:, [0, -1]] = 0.0
