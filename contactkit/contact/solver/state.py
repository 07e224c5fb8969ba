"""State of the iterations on one grid: pressure, reduced gap, approach and violation.

Sign convention: pressure, heights and displacement positive into the solid; symbols as in
`loops_numpy`.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from .nested_grids import GridLevel
from .optimality import free_approach, scale_of
from .problem import ContactProblem, project

__all__ = ["ActiveSetState"]

# Relative violation down to which displacements in single precision are used, on the contacts of
# the room, 128 x 128 pixels: with 1e-3 2 % more applications, as the last are lost in round-off;
# with 0.1 as many, but fewer of the cheap ones.
SINGLE = 1e-2
SINGLE_NOISE = 1e-5  # likewise over the largest displacement, which may be far above the heights
SINGLE_LIMIT = 1e-5  # violation that displacements in single precision cannot measure


class ActiveSetState:
    """Pressure, reduced gap, approach and relative violation on one grid.

    Parameters
    ----------
    grid : GridLevel
        Its `pressure` and `gap` are the maps, changed in place.
    problem : ContactProblem
        Dimensionless problem on this grid.
    rtol : float
        Relative violation to reach.
    """

    max_iterations = 80

    def __init__(self, grid: GridLevel, problem: ContactProblem, rtol: float) -> None:
        self.grid, self.problem, self.rtol = grid, problem, rtol
        self.p, self.g = grid.pressure.ravel(), grid.gap.ravel()
        self.h, self.upper = problem.heights.ravel(), problem.upper
        self.load_fixed = problem.load is not None
        self.load = problem.load or 0.0
        self.bounded = bool(np.isfinite(self.upper).any())
        self.missing = self.load - float(self.p.sum()) if self.load_fixed else 0.0
        self.stopped, self.added, self.scale, self.largest = 0, 0, 1.0, 0.0
        self.approach, self.certificate, self.exact = 0.0, 0.0, False
        # Of heights of zero mean; `std` and its like take another map.
        self.rms = float(np.sqrt(np.einsum("i,i->", self.h, self.h) / self.h.size))
        self.relative, self.precise = np.inf, False

    def evaluate(self) -> float:
        """Reduced gap, approach and relative violation of the present pressure."""
        loops = self.grid.loops
        self.exact = self.precise or self.relative <= max(
            SINGLE, SINGLE_NOISE * self.largest / self.scale
        )
        self.grid.displace(self.exact)
        self.largest = float(loops.reduce_gap(self.g, self.h))
        self.scale = scale_of(self.rms, self.largest, self.problem.flat)
        return self.grade()

    def grade(self) -> float:
        """Approach and relative violation of the present pressure and reduced gap."""
        loops = self.grid.loops
        free = loops.free_sums(self.p, self.g, self.upper)
        if self.problem.approach is not None:
            self.approach = self.problem.approach
        elif free.n_pixels:
            self.approach = free.weighted_gap / free.pressure
        else:
            self.approach = free_approach(self.p, self.g, self.upper)
        found = loops.violation(self.p, self.g, self.upper, self.approach)
        total, energy = free.total, found.energy
        if self.load_fixed and not self.bounded:
            energy = found.deepest * total
        self.certificate = energy / (total * self.scale) if total > 0.0 else 0.0
        self.relative = float(found.worst) / self.scale
        return self.relative

    def done(self) -> bool:
        """Whether the pressures solve the problem, by a displacement in double precision."""
        return (
            self.relative <= self.rtol and self.balanced() and (self.exact or self.rtol >= SINGLE)
        )

    def balanced(self) -> bool:
        """Whether the pressures sum to the load."""
        return abs(self.missing) <= 1e-12 * self.load

    def between(self, at: NDArray[np.intp]) -> NDArray[np.bool_]:
        """Mask of the pixels whose pressure is between the bounds."""
        bound = self.upper if self.upper.size == 1 else self.upper[at]
        return np.asarray((self.p[at] > 0.0) & (self.p[at] < bound))

    def stagnates(self, step: int) -> bool:
        """Note the progress up to a step; whether there has been none for too long."""
        raise NotImplementedError

    def correct(self) -> None:
        """Change the free pixels towards the solution."""
        raise NotImplementedError

    def descend(self) -> None:
        """Projected gradient step."""
        gradient = self.g - (self.problem.approach or 0.0)
        self.p[...] = project(self.p - gradient / self.grid.steepest, self.problem)
        self.stopped, self.missing = 0, 0.0
