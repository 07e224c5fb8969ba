"""First guess of the pressure on the coarsest grid: what a bed of springs would carry.

Sign convention: pressure, heights and displacement positive into the solid.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from .nested_grids import GridLevel
from .problem import ContactProblem, fit

__all__ = ["first_guess"]

Floats = NDArray[np.float64]


def first_guess(grid: GridLevel, problem: ContactProblem) -> Floats:
    """Pressures in proportion to the heights above a level, between the bounds.

    Under a given load the level is the one of least energy among those that a half, a quarter, an
    eighth ... of the pixels exceed, unless uniform pressures have less. Under a given approach it
    is where the bodies touch, and the factor is that of least energy.

    Parameters
    ----------
    grid : GridLevel
        Its `pressure` and `gap` are overwritten.
    problem : ContactProblem
        Dimensionless problem on this grid.
    """
    h, shape = problem.heights.ravel(), problem.heights.shape
    if problem.load is None:
        depth = h + (problem.approach or 0.0)
        p = fit(np.maximum(depth, 0.0), problem)
        work = float(p @ _displacement(grid, p))
        return fit(p * (float(p @ depth) / work if work > 0.0 else 0.0), problem).reshape(shape)
    best, least = np.full(h.size, problem.load / h.size), np.inf
    best = fit(best, problem)
    ordered, count, p = np.sort(h), h.size, best
    while p.any():
        energy = 0.5 * float(p @ _displacement(grid, p)) - float(p @ h)
        if not energy < least:
            break
        best, least, count = p, energy, count // 2
        above = np.maximum(h - ordered[-1 - count], 0.0)
        p = fit(above * (problem.load / max(float(above.sum()), 1e-300)), problem)
    return best.reshape(shape)


def _displacement(grid: GridLevel, p: Floats) -> Floats:
    grid.pressure[...] = p.reshape(grid.pressure.shape)
    grid.displace(False)
    return grid.gap.ravel()
