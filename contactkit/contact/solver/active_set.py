"""Primal-dual active set (semismooth Newton) on one grid of the contact problem.

Every iteration convolves the pressure in double precision, finds the reduced gap ``g`` and how far
it is from a solution, and changes the pressure of the free pixels so that ``g`` becomes the
approach there. Pixels whose change exceeds a bound stop at it; those at a bound that would be
penetrated, or gape, under the change as computed are free in the next iteration.

Sign convention: pressure, heights and displacement positive into the solid; symbols as in
`loops_numpy`.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from .nested_grids import Grid
from .optimality import free_approach, height_scale
from .problem import Problem, project
from .reduced_system import ReducedSystem

__all__ = ["Outcome", "improve"]

MAX_ITERATIONS = 80
SINGLE = 1e-2  # relative violation down to which displacements in single precision are used
SINGLE_LIMIT = 1e-5  # violation that displacements in single precision cannot measure
CAUTIOUS_AFTER = 1  # iterations without progress after which few pixels leave a bound at a time
WORST = 0.8  # violation of those few, over the maximum
CYCLE = 5  # iterations without progress after which pixels that stop at a bound stay there
REDUCTIONS = (  # fraction of pixels that come or go, and how far the linear residual is reduced
    (0.05, 0.2),
    (0.01, 0.1),
    (3e-4, 0.03),
)
PATIENCE = 15  # iterations within which the residual must have halved


class Outcome(NamedTuple):
    """End of the iterations; pressure and reduced gap are in the maps of the grid.

    approach : rigid-body approach; relative : largest violation over the height scale
    certificate : bound of the energy error over load times height scale
    steps : number of iterations; history : (applications, relative) after each
    is_stalled : whether round-off ended the iterations of the plain method that finished
    """

    approach: float
    relative: float
    certificate: float
    steps: int
    history: tuple[tuple[int, float], ...]
    is_stalled: bool = False


class _State:
    """State of the iterations."""

    def __init__(self, grid: Grid, problem: Problem, rtol: float) -> None:
        self.grid, self.problem, self.rtol = grid, problem, rtol
        self.p, self.g = grid.pressure.ravel(), grid.gap.ravel()
        self.h, self.upper = problem.heights.ravel(), problem.upper
        self.load_fixed = problem.load is not None
        self.load = problem.load or 0.0
        self.bounded = bool(np.isfinite(self.upper).any())
        self.missing = self.load - float(self.p.sum()) if self.load_fixed else 0.0
        self.stopped, self.added, self.scale = 0, 0, 0.0
        rms = float(np.std(self.h))
        self.same_rms = np.array([rms, -rms])  # two heights of the same rms, for the scale
        self.relative, self.stuck, self.cautious = np.inf, False, False
        self.at = np.zeros(0, np.intp)

    def evaluate(self) -> float:
        """Reduced gap, approach and relative violation of the present pressure."""
        loops = self.grid.loops
        self.exact = self.relative <= SINGLE
        self.grid.displace(self.exact)
        self.scale = height_scale(self.same_rms, self.g, self.problem.flat)
        loops.reduce_gap(self.g, self.h)
        free = loops.free_sums(self.p, self.g, self.upper)
        if self.problem.approach is not None:
            self.approach = self.problem.approach
        elif free.n_pixels:
            self.approach = free.weighted_gap / free.pressure
        else:
            self.approach = free_approach(self.p, self.g, self.upper)
        found = loops.violation(self.p, self.g, self.upper, self.approach)
        total = float(self.p.sum())
        energy = found.energy
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

    def correct(self) -> None:
        """Correct the free pixels; if there are none, take a projected gradient step."""
        loops = self.grid.loops
        if self.stopped == 0:
            self._choose_free()
        if self.at.size <= (self.load_fixed and not self.missing):
            self._descend()
            return
        r = self.approach - self.g[self.at]
        if self.load_fixed:
            r -= r.mean()
        system = ReducedSystem(self.grid, self.at, self.load_fixed)
        x = system.solve(r, self._reduction(), self.missing)
        self.stopped = loops.add_and_clip(self.p, self.at, x, self.upper)
        self._balance()
        if self.stopped and self.stuck:
            self.at, self.added = self.at[self._between(self.at)], 0
        elif self.stopped:
            self._predict_free()

    def _between(self, at: NDArray[np.intp]) -> NDArray[np.bool_]:
        bound = self.upper if self.upper.size == 1 else self.upper[at]
        return np.asarray((self.p[at] > 0.0) & (self.p[at] < bound))

    def _reduction(self) -> float:
        """How far to reduce the linear residual: little as long as the active set changes."""
        if self.stuck:
            return 0.03
        changed = (self.stopped + self.added) / self.at.size
        for fraction, reduction in REDUCTIONS:
            if changed > fraction:
                return reduction
        return min(0.03, max(0.4 * self.rtol / max(self.relative, 1e-5 * self.rtol), 1e-5))

    def _balance(self) -> None:
        """Restore the load by scaling; where a bound prevents that, by the next correction."""
        self.missing = 0.0
        if self.load_fixed and not (self.bounded and self.stopped):
            self.grid.loops.scale_to_load(self.p, self.at, self.upper, self.load)
        elif self.load_fixed:
            self.missing = self.load - float(self.p.sum())

    def _predict_free(self) -> None:
        """Choose the next free pixels by the gap under the correction before the bounds.

        A pixel that stops at its bound changes the gap around it, which is not penetration.
        """
        self.g += self.grid.change
        if self.load_fixed:
            self.approach = float(self.g[self.at].mean())
        self.g[self.at] = self.approach
        self._choose_free()

    def _choose_free(self) -> None:
        """Choose the free pixels; without progress, only the worst of those that leave a bound."""
        free = self.grid.loops.free_set(self.p, self.g, self.upper, self.approach)
        self.at, self.added = free.at, free.added
        if self.cautious and self.added:
            off = np.abs(self.g[self.at] - self.approach)
            between = self._between(self.at)
            off[between] = 0.0
            kept = between | (off > WORST * off.max())
            self.at, self.added = self.at[kept], int(np.count_nonzero(kept & ~between))

    def _descend(self) -> None:
        """Projected gradient step."""
        gradient = self.g - (self.problem.approach or 0.0)
        self.p[...] = project(self.p - gradient / self.grid.steepest, self.problem)
        self.stopped, self.missing = 0, 0.0


def improve(grid: Grid, problem: Problem, rtol: float) -> Outcome:
    """Iterate on one grid until the relative residual is `rtol`, or no longer falls.

    Parameters
    ----------
    grid : Grid
        Its `pressure` is the initial guess, and the solution on return.
    problem : Problem
        Dimensionless problem on this grid.
    rtol : float
        Largest violation to accept, over `height_scale`.

    Returns
    -------
    Outcome
        With ``relative > rtol`` if the iterations stagnate: the fallback has to finish.
    """
    state = _State(grid, problem, rtol)
    history: list[tuple[int, float]] = []
    best, best_step = np.inf, 0
    for step in range(MAX_ITERATIONS):
        relative = state.evaluate()
        history.append((grid.applications(), relative))
        if state.done():
            break
        if relative <= SINGLE_LIMIT and not state.exact:
            continue  # evaluate again before anything is corrected
        if relative < 0.5 * best:
            best, best_step = relative, step
        state.cautious = step - best_step >= CAUTIOUS_AFTER
        state.stuck = step - best_step >= CYCLE
        if step - best_step >= PATIENCE:
            break
        if step < MAX_ITERATIONS - 1:
            state.correct()
    relative = state.relative if state.done() else max(state.relative, 2.0 * rtol)
    return Outcome(state.approach, relative, state.certificate, len(history), tuple(history))
