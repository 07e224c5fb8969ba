"""Reduced linear system of the active set: pressures that close the gap on the free pixels.

Few unknowns are solved for by a Cholesky factor of the influence matrix, many by preconditioned
conjugate gradients on vectors of the free pixels alone, in single precision: the residual they
start from is exact, and the rest is corrected in the next active-set iteration.

Sign convention: pressure, heights and displacement positive into the solid.

======  ==========================================================
symbol  meaning
======  ==========================================================
K       displacement of a map under unit pressure on its first pixel
G       influence matrix between the free pixels
======  ==========================================================
"""

from __future__ import annotations

from typing import Any

import numpy as np
import scipy.linalg
from numpy.typing import NDArray

from .conjugate_gradient import conjugate_gradient
from .convolution import Patch
from .nested_grids import GridLevel

__all__ = ["ReducedSystem", "few_enough", "influence_matrix", "solve_directly"]

Floats = NDArray[np.float64]
Singles = NDArray[np.float32]
# The longest of 260 solves on rough maps takes 12 (films of 1e-4 to 1e3 of the modulus of their
# base, periodic and isolated): the cap ends a solution that single precision keeps from its target.
MAX_ITERATIONS = 40


def few_enough(n_free: int, pixels: int) -> bool:
    """Whether factorising costs less than a few transforms of the map.

    Examples
    --------
    >>> few_enough(100, 256 * 256), few_enough(10_000, 256 * 256)
    (True, False)
    """
    return bool(n_free <= min(1000.0, 7.0 * pixels ** (1.0 / 3.0)))


def influence_matrix(K: Floats, at: NDArray[np.intp], shape: tuple[int, int]) -> Floats:
    """Displacement of the free pixels under unit pressure on each of them.

    Parameters
    ----------
    K : ndarray (ny, nx) or (ny // 2 + 1, nx // 2 + 1)
        Response to the pixel (0, 0), even in both distances, as every layered solid has it; of a
        periodic map only distances up to the middle.
    at : ndarray (m,)
        Flat indices in the map.
    shape : tuple of int
        Pixels of the map.

    Examples
    --------
    >>> influence_matrix(np.array([[3.0, 1.0]]), np.array([0, 1]), (1, 3))
    array([[3., 1.],
           [1., 3.]])
    """
    row, column = np.divmod(at, shape[1])
    dy, dx = np.abs(row[:, None] - row), np.abs(column[:, None] - column)
    if K.shape != shape:
        np.minimum(dy, shape[0] - dy, out=dy)
        np.minimum(dx, shape[1] - dx, out=dx)
    return np.asarray(K[dy, dx])


def solve_directly(G: Floats, r: Floats, total: float | None) -> Floats | None:
    """Pressures with ``G x = r`` up to a constant that makes them sum to `total`.

    Parameters
    ----------
    G : ndarray (m, m)
        Influence matrix; overwritten.
    r : ndarray (m,)
        Wanted displacement.
    total : float, optional
        Sum of the pressures; without it the constant is zero.

    Returns
    -------
    ndarray (m,) or None
        None if the matrix is not positive definite to round-off.

    Examples
    --------
    >>> solve_directly(np.diag([1.0, 2.0]), np.array([0.0, 1.0]), 2.0)
    array([1., 1.])
    """
    if total is not None:
        G += G[0, 0]  # no effect on the answer; lifts the null space of a full periodic map
    try:
        factor = scipy.linalg.cho_factor(G, overwrite_a=True, check_finite=False)
    except np.linalg.LinAlgError:
        return None
    x = np.asarray(scipy.linalg.cho_solve(factor, r))
    if total is None:
        return x
    y = np.asarray(scipy.linalg.cho_solve(factor, np.ones_like(r)))
    return np.asarray(x + y * ((total - float(x.sum())) / float(y.sum())))


class ReducedSystem:
    """The operator between the free pixels of a grid.

    Parameters
    ----------
    grid : GridLevel
        The grid; the change of the displacement goes to its `change`.
    at : ndarray (m,)
        Flat indices of the free pixels, sorted.
    load_fixed : bool
        Whether the solution has a given sum instead of a given approach.
    displaces : bool
        Whether the change of the displacement is wanted: of the map, or of a patch around the free
        pixels, zero off it. A direct solution leaves it to `displace`.
    """

    def __init__(
        self, grid: GridLevel, at: NDArray[np.intp], load_fixed: bool, displaces: bool = True
    ) -> None:
        self.grid, self.at, self.load_fixed, self.displaces = grid, at, load_fixed, displaces
        self.loops = grid.loops
        self.operator, self.inside = grid.quick, at
        self.patch: Patch | None = None
        self.is_direct = False

    def solve(self, r: Floats, reduction: float, missing: float) -> NDArray[np.floating[Any]]:
        """Pressures that reduce the residual by a factor and sum to `missing`."""
        grid = self.grid
        if few_enough(self.at.size, grid.pressure.size):
            matrix = influence_matrix(grid.response(), self.at, grid.pressure.shape)
            x = solve_directly(matrix, r, missing if self.load_fixed else None)
            if x is not None:
                self.is_direct = True
                return x
        return self._iterate(r.astype(np.float32), reduction, missing)

    def displace(self, x: NDArray[np.floating[Any]]) -> None:
        """Change of the displacement under the solution, if no iterations gave it."""
        if not self.is_direct:
            return
        quick, place = self.grid.quick, self.grid.quick.places(self.at)
        self.loops.scatter(quick.memory, place, x.astype(np.float32))
        self.grid.change[...] = quick.run().ravel()
        quick.memory[place] = 0.0

    def _iterate(self, r: Singles, reduction: float, missing: float) -> Singles:
        grid = self.grid
        self.preconditioner = grid.preconditioner(self.at.size)
        self.preconditioner.prepare(self.at, self.load_fixed)
        small = None if grid.patch is None else grid.patch.take(self.at)
        if grid.patch is not None and small is not None:
            self.patch, self.operator, self.inside = grid.patch, small, grid.patch.at
        self.place = self.operator.places(self.inside)
        x = np.zeros_like(r)
        grid.change[...] = 0.0
        if missing:  # spread evenly first: the iterations keep the sum
            x += missing / r.size
            q = np.zeros_like(r)
            self.apply(x, q)
            self.take_step(1.0)
            r -= q - q.mean(dtype=np.float64)  # the approach is free: equations hold up to a mean
        conjugate_gradient(self, x, r, reduction, MAX_ITERATIONS)
        self.operator.memory[self.place] = 0.0
        self.preconditioner.clean()
        return x

    def apply(self, d: Singles, q: Singles) -> None:
        """See `LinearSystem.apply`."""
        self.loops.scatter(self.operator.memory, self.place, d)
        self.operator.run()
        self.loops.gather(self.operator.target.ravel(), self.inside, q)
        if self.patch is not None:
            self.patch.count += 1

    def precondition(self, r: Singles) -> Singles:
        """See `LinearSystem.precondition`."""
        return self.preconditioner(r)

    def take_step(self, length: float) -> None:
        """Add a step to the change of the displacement."""
        if not self.displaces:
            return
        if self.patch is None:
            self.loops.add_scaled(self.grid.change, self.operator.target.ravel(), length)
        else:
            self.patch.add_scaled(self.grid.change, length)
