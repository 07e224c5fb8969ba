"""Preconditioner for many moving pixels: a stencil for the short waves, blocks for the long ones.

Residuals are split into their means over blocks of pixels and the rest. The stencil undoes the
operator for the rest as if all pixels moved; the blocks solve a small problem for the means.

Sign convention: pressure and displacement positive into the solid.
"""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from .blocks import CoarseBlocks
from .stencil import Stencil

__all__ = ["TwoLevel"]

Singles = NDArray[np.float32]


class TwoLevel:
    """Rough inverse of the operator on any set of pixels of one grid.

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
        Passes over the pixels.

    Examples
    --------
    >>> from contactkit.contact.solver import loops_numpy as active_set_loops
    >>> inverse = TwoLevel((4, 4), False, Stencil(2.0, -0.5, -0.5, 0.0), None, active_set_loops)
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
    ) -> None:
        self.periodic, self.stencil, self.blocks, self.loops = periodic, stencil, blocks, loops
        self.width = shape[1]
        self.margin = np.zeros((shape[0] + 2, shape[1] + 2), np.float32)  # zeros between solves

    @property
    def nbytes(self) -> int:
        """Memory held between the solves."""
        blocks = 0 if self.blocks is None else self.blocks.operator.nbytes
        return int(self.margin.nbytes + blocks)

    def applications(self) -> int:
        """Applications of the operator between the blocks since its counter was reset."""
        return 0 if self.blocks is None else self.blocks.operator.count

    def prepare(self, at: NDArray[np.intp], load_fixed: bool) -> None:
        """Take a set of pixels, by flat indices, and whether the sum of pressures is prescribed."""
        self.at = at + 2 * (at // self.width) + (self.width + 3)
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
        loops.less_block_values(r, self.block, total * blocks.share, self.rest)
        z = self._short_waves(self.rest)
        long = blocks.solve(total)
        long -= loops.block_sums(self.block, z, blocks.count) * blocks.share
        loops.add_block_values(z, self.block, long)
        return z

    def _short_waves(self, r: Singles) -> Singles:
        margin, loops = self.margin, self.loops
        flat, z = margin.ravel(), np.empty_like(r)
        loops.put(flat, self.at, r)
        if self.periodic:
            margin[0], margin[-1] = margin[-2], margin[1]
            margin[:, 0], margin[:, -1] = margin[:, -2], margin[:, 1]
        loops.stencil(flat, self.at, margin.shape[1], tuple(self.stencil), z)
        return z

    def clean(self) -> None:
        """Leave zeros behind."""
        self.margin.ravel()[self.at] = 0.0
        if self.periodic:
            self.margin[[0, -1]] = 0.0
            self.margin[:, [0, -1]] = 0.0
