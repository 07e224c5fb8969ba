r"""Approximate inverse of a film with springs on a grid: one cycle of multigrid.

The matrix is that of five points, :math:`A = L + \mathrm{diag}(k)`, with the conductances L between
cells and what else leaves them, k: into springs, the rim and cavities. A coarser cell holds two by
two. Its conductance to the next is that of both rows of cells from centre to centre, each in
series; its spring is the sum of theirs, and so are its outlets, from its centre too. Corrections
are interpolated bilinearly. Sums of conductances alone, as in Galerkin's matrix, would be twice too
stiff. Grids between the finest and
the coarsest are corrected twice (an F cycle): on 256 x 256 cells of a rough film that leaves 0.3 of
the error, and one correction 0.5, more on finer grids.

References
----------
Wesseling, An Introduction to Multigrid Methods (1992), section 5.4: cell-centred multigrid.
"""

from __future__ import annotations

import math
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ....errors import ConvergenceError

__all__ = ["Multigrid"]

Map = NDArray[np.float64]
Single = NDArray[np.float32]

_COARSEST = 12  # cells across, or fewer: solved at once
# Largest conductance times largest resistance to the outlets, above which round-off (1e15) may be
# all that lets liquid out.
_SINGULAR = 1e13
# Jacobi steps before and after the coarser grid, damped as Chebyshev's polynomial of degree 2 on
# the eigenvalues from 1/2 to 2 asks. Rough sphere on 128 x 128 cells, beta = 1: 10.0 iterations of
# GMRES, with one step each 11.9, with three 9.2, with exact factors 8.0.
_MEAN, _HALF_WIDTH = 1.25, 0.75
_DAMPING = tuple(1.0 / (_MEAN + sign * _HALF_WIDTH * math.sqrt(0.5)) for sign in (1.0, -1.0))


class Multigrid:
    """One cycle for a matrix of five points, in single precision.

    `unit` is the largest of its conductances.

    Parameters
    ----------
    along_x, along_y : ndarray, shape (ny, nx - 1), (ny - 1, nx)
        Conductances between cells; 0 beside those that are left out.
    springs : ndarray, shape (ny, nx)
        What a cell takes in.
    outlets : ndarray, shape (ny, nx)
        Conductances to known pressures, of the rim and of cavities.

    Raises
    ------
    ConvergenceError
        If the matrix is singular: some liquid is connected to no reservoir, and to no spring.

    Examples
    --------
    >>> springs, outlets = np.full((40, 40), 0.1), np.zeros((40, 40))
    >>> solve = Multigrid(np.ones((40, 39)), np.ones((39, 40)), springs, outlets)
    >>> right = np.ones((40, 40), np.float32)  # of a pressure of 10
    >>> bool(np.abs(solve(right) / (10.0 * solve.unit) - 1.0).max() < 0.2)
    True
    """

    def __init__(self, along_x: Map, along_y: Map, springs: Map, outlets: Map) -> None:
        given = along_x, along_y, springs, outlets
        largest = [float(one.max(initial=0.0)) for one in given]
        self.unit = max(largest) or 1.0  # for the range of single precision
        x, y, k, out = (one / self.unit for one in given)
        self.levels: list[_Level] = []
        while max(k.shape) > _COARSEST:
            self.levels.append(_Level(x, y, k + out))
            x, y, k, out = _in_series(x), _in_series(y.T).T, _sums(k), _farther(out, x, y)
        self.coarsest = _inverse(x, y, k + out)

    def __call__(self, right: Single) -> Single:
        """Pressures times the unit of conductances that nearly cancel what flows into the cells.

        The next call overwrites them.
        """
        return self._cycle(0, right, twice=True)

    def _cycle(self, depth: int, right: Single, *, twice: bool) -> Single:
        """Coarser grids correct those between twice: the second time by a cycle that does not."""
        if depth == len(self.levels):
            return (self.coarsest @ right.ravel()).reshape(right.shape)
        level = self.levels[depth]
        level.smooth_first(right)
        for again in (True, False) if twice and depth > 0 else (twice,):
            level.add_coarser(self._cycle(depth + 1, level.summed_residual(right), twice=again))
            level.smooth_last(right)
        return level.pressure.reshape(level.shape)


class _Level:
    """Matrix of a level and its pressures, whose rows lie one after the other in memory."""

    def __init__(self, along_x: Map, along_y: Map, leaving: Map) -> None:
        diagonal = _diagonal(along_x, along_y, leaving)
        self.shape, self.width = diagonal.shape, diagonal.shape[1]
        padded = np.zeros(diagonal.shape)
        padded[:, :-1] = along_x
        self.to_right = padded.ravel()[:-1].astype(np.float32)
        self.to_next = along_y.ravel().astype(np.float32)
        self.diagonal = diagonal.ravel().astype(np.float32)
        # Cells that are left out keep what is interpolated, and leave nothing.
        inverse = np.divide(1.0, diagonal, out=np.zeros(diagonal.shape), where=diagonal > 0.0)
        self.damped = [(one * inverse).ravel().astype(np.float32) for one in _DAMPING]
        # What is allocated anew costs as much as the arithmetic.
        self.pressure, self.left, self.spare = (np.empty_like(self.diagonal) for _ in range(3))

    def smooth_first(self, right: Single) -> None:
        """Pressures by Jacobi steps from zero."""
        np.multiply(self.damped[0], right.ravel(), out=self.pressure)
        for damped in self.damped[1:]:
            self._step(damped, right)

    def smooth_last(self, right: Single) -> None:
        """Jacobi steps in the reversed order."""
        for damped in self.damped[::-1]:
            self._step(damped, right)

    def summed_residual(self, right: Single) -> Single:
        """Residual of coarser cells."""
        found: Single = _sums(self._residual(right).reshape(self.shape))
        return found

    def add_coarser(self, correction: Single) -> None:
        """Add the correction of coarser cells."""
        ny, nx = self.shape
        pressure = self.pressure.reshape(self.shape)
        pressure += _between(_between(correction).T).T[:ny, :nx]

    def _step(self, damped: Single, right: Single) -> None:
        left = self._residual(right)
        left *= damped
        self.pressure += left

    def _residual(self, right: Single) -> Single:
        x, left, spare, w = self.pressure, self.left, self.spare, self.width
        np.multiply(self.diagonal, x, out=left)
        np.subtract(right.ravel(), left, out=left)
        for conductance, k in ((self.to_right, 1), (self.to_next, w)):
            flow = spare[:-k]
            np.multiply(conductance, x[k:], out=flow)
            left[:-k] += flow
            np.multiply(conductance, x[:-k], out=flow)
            left[k:] += flow
        return left


def _diagonal(along_x: Map, along_y: Map, leaving: Map) -> Map:
    """All that leaves a cell; 0 of cells that are left out."""
    total = leaving.copy()
    total[:, :-1] += along_x
    total[:, 1:] += along_x
    total[:-1] += along_y
    total[1:] += along_y
    return total


def _inverse(along_x: Map, along_y: Map, leaving: Map) -> Single:
    diagonal = _diagonal(along_x, along_y, leaving)
    whole = np.diag(np.where(diagonal > 0.0, diagonal, 1.0).ravel())
    cell = np.arange(diagonal.size).reshape(diagonal.shape)
    sides = (cell[:, :-1], cell[:, 1:], along_x), (cell[:-1], cell[1:], along_y)
    for low, high, conductance in sides:
        whole[low, high] = whole[high, low] = -conductance
    singular = ConvergenceError("the film has no unique pressure: its matrix is singular")
    try:
        inverse: Map = np.linalg.inv(whole)
    except np.linalg.LinAlgError as error:
        raise singular from error
    # Whether the last pivot is zero or round-off hangs on the machine; either is singular.
    if not np.abs(inverse).max() * np.abs(whole).max() < _SINGULAR:
        raise singular
    return inverse.astype(np.float32)


def _even(values: Any) -> Any:
    """A last row and column of zeros where there is an odd number."""
    ny, nx = values.shape
    return np.pad(values, ((0, ny % 2), (0, nx % 2))) if ny % 2 or nx % 2 else values


def _sums(values: Any) -> Any:
    """Sums over two by two cells."""
    values = _even(values)
    rows = values[0::2] + values[1::2]
    return rows[:, 0::2] + rows[:, 1::2]


def _in_series(along_x: Map) -> Map:
    """Conductances along x between coarser cells: of both rows, from centre to centre."""
    ny, sides = along_x.shape
    # An odd column is a coarser cell alone, with nothing within.
    padded = np.pad(along_x, ((0, ny % 2), (0, 1 - sides % 2)))
    within, between = padded[:, 0::2], padded[:, 1::2]
    half = np.divide(0.5, within, out=np.zeros(within.shape), where=within > 0.0)
    with np.errstate(divide="ignore"):
        path = 1.0 / (half[:, :-1] + 1.0 / between + half[:, 1:])
    return np.asarray(path[0::2] + path[1::2])


def _farther(outlets: Map, along_x: Map, along_y: Map) -> Map:
    """Outlets of coarser cells: in series with what is within from their edges to their centres."""
    total, ny, nx = _sums(outlets), *outlets.shape
    x, y = np.zeros((ny, nx)), np.zeros((ny, nx))
    x[:, 0 : nx - 1 : 2], y[0 : ny - 1 : 2] = along_x[:, ::2], along_y[::2]
    within = _sums(x + y)
    series = total * within / (total + within + (within == 0.0))
    return np.asarray(np.where(within > 0.0, series, total))


def _between(coarse: Single) -> Single:
    """Values of twice as many rows, on lines through those of the coarser ones."""
    quarter = np.float32(0.25) * coarse
    most = coarse - quarter
    fine = np.empty((2 * coarse.shape[0], coarse.shape[1]), np.float32)
    fine[0], fine[-1] = coarse[0], coarse[-1]
    np.add(most[1:], quarter[:-1], out=fine[2::2])
    np.add(most[:-1], quarter[1:], out=fine[1:-1:2])
    return fine
