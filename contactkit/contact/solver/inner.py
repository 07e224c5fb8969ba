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

from .convolution import Convolution
from .dense import few_enough, influence_matrix, solve_directly
from .patch import Patch
from .sparse_inverse import NearInverse
from .two_level import TwoLevel

__all__ = ["Correction", "Grid"]

Singles = NDArray[np.float32]
MOST_STEPS = 40


class Grid(NamedTuple):
    """One of the nested grids with everything that can be prepared.

    pressure, gap : maps in double precision
    exact : operator in double precision from `pressure` to `gap`; none on coarse grids
    quick : operator in single precision; its source is zero between uses
    patch : the same around the moving pixels of a lone map; none if it repeats
    response : displacement under unit pressure on the first pixel; to the middle if periodic
    change : displacement gained since the last exact one, in single precision
    inverse : rough inverse of the operator on the moving pixels
    two_level : cheaper one for more than `few` of them; none where it is poor, under stiff plates
    steepest : largest eigenvalue of the operator
    loops : passes over the pixels, of numpy or compiled
    """

    pressure: NDArray[np.float64]
    gap: NDArray[np.float64]
    exact: Convolution | None
    quick: Convolution
    patch: Patch | None
    response: NDArray[np.float64]
    change: Singles
    inverse: NearInverse
    two_level: TwoLevel | None
    few: int
    periodic: bool
    steepest: float
    loops: Any

    def reset(self) -> None:
        """Count from zero."""
        self.quick.count = 0
        if self.patch is not None:
            self.patch.count = 0
        if self.exact is not None:
            self.exact.count = 0
        if self.two_level is not None and self.two_level.blocks is not None:
            self.two_level.blocks.operator.count = 0

    def applications(self) -> int:
        """Applications of the operator, on the whole map or on a patch of it, since `reset`."""
        exact = self.exact.count if self.exact is not None else 0
        return self.quick.count + exact + (self.patch.count if self.patch is not None else 0)

    def rough_inverse(self, moving: int) -> NearInverse | TwoLevel:
        """What approximates the inverse of the operator best for its price."""
        if self.two_level is None or moving <= self.few:
            return self.inverse
        return self.two_level

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
        self.operator, self.place = grid.quick, at
        self.patch: Patch | None = None

    def solve(
        self, r: NDArray[np.float64], reduction: float, missing: float
    ) -> NDArray[np.floating[Any]]:
        """Correction that reduces the residual by a factor and sums to `missing`."""
        grid = self.grid
        if few_enough(self.at.size, grid.pressure.size):
            matrix = influence_matrix(grid.response, self.at, grid.pressure.shape)
            x = solve_directly(matrix, r, missing if self.load_fixed else None)
            if x is not None:
                self._change_by(x.astype(np.float32))
                return x
        return self._iterate(r.astype(np.float32), reduction, missing)

    def _change_by(self, x: Singles) -> None:
        """Displacement of the whole map under a correction."""
        quick = self.grid.quick
        self.grid.loops.put(quick.source.ravel(), self.at, x)
        self.grid.change[...] = quick.run().ravel()
        quick.source.ravel()[self.at] = 0.0

    def _iterate(self, r: Singles, reduction: float, missing: float) -> Singles:
        grid, loops = self.grid, self.grid.loops
        rough = grid.rough_inverse(self.at.size)
        rough.prepare(self.at, self.load_fixed)
        small = None if grid.patch is None else grid.patch.take(self.at)
        if grid.patch is not None and small is not None:
            self.patch, self.operator, self.place = grid.patch, small, grid.patch.at
        x, d, q = (np.zeros_like(r) for _ in range(3))
        grid.change[...] = 0.0
        if missing:  # an even share first: the steps below leave the sum alone
            d += missing / r.size
            self._apply(d, q)
            self._gain(1.0)
            x += d
            d[...] = 0.0
            r -= q - q.mean(dtype=np.float64)
        stop = reduction**2 * float(np.dot(r, r))
        length, rz = 0.0, 0.0
        for _ in range(MOST_STEPS if stop > 0.0 else 0):
            z = rough(r)
            rz = loops.turn(d, z, r, q, length, rz, self.load_fixed)
            self._apply(d, q)
            length, rr = loops.advance(x, r, d, q, self.load_fixed)
            self._gain(length)
            if rr <= stop:
                break
        self.operator.source.ravel()[self.place] = 0.0
        rough.clean()
        if self.patch is not None:
            self._change_by(x)
        return x

    def _apply(self, d: Singles, q: Singles) -> None:
        self.grid.loops.put(self.operator.source.ravel(), self.place, d)
        self.operator.run()
        self.grid.loops.pick(self.operator.target.ravel(), self.place, q)
        if self.patch is not None:
            self.patch.count += 1

    def _gain(self, length: float) -> None:
        """Add a step to the change of the whole map; on a patch that comes last, all at once."""
        if self.patch is None:
            self.grid.loops.accumulate(self.grid.change, self.operator.target.ravel(), length)
