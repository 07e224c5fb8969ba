"""Primal-dual active set on one grid of the contact problem.

Every outer step convolves the pressure in double precision, finds the reduced gap ``g`` and how far
it is from a solution, and corrects the pressure of the pixels that may move so that ``g`` becomes
level there. Pixels that the correction carries beyond a bound stop at it; those at a bound that
would be penetrated, or gape, by the correction as computed may move next time.

Sign convention: pressure, heights and displacement positive into the solid; tables in
`active_set_loops`.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from .inner import Correction, Grid
from .optimality import free_level, height_scale
from .problem import Problem, project

__all__ = ["Outcome", "improve"]

MOST_OUTER = 80
ROUGH = 1e-2  # relative violation down to which single precision displacements are good enough
BLURRED = 1e-5  # below it single precision displacements are no measure
WARY = 1  # outer steps without progress after which few pixels may leave a bound at a time
WORST = 0.8  # how far they are off, of the farthest
CYCLE = 5  # outer steps without progress after which pixels that stop at a bound stay there
REDUCTIONS = (0.05, 0.2), (0.01, 0.1), (3e-4, 0.03)  # share of pixels that come or go; how far then
PATIENCE = 15  # outer steps within which the residual must have halved


class Outcome(NamedTuple):
    """Where the outer steps ended; pressure and reduced gap are in the operator of the grid.

    level : rigid approach; relative : largest violation over the height scale
    certificate : bound of the energy error over load times height scale
    steps : active sets tried; history : (applications so far, relative) of each
    is_stalled : whether round-off ended the steps of who finished the work
    """

    level: float
    relative: float
    certificate: float
    steps: int
    history: tuple[tuple[int, float], ...]
    is_stalled: bool = False


class _Walk:
    """State of the outer steps."""

    def __init__(self, grid: Grid, problem: Problem, rtol: float) -> None:
        self.grid, self.problem, self.rtol = grid, problem, rtol
        self.p, self.g = grid.pressure.ravel(), grid.gap.ravel()
        self.h, self.cap = problem.heights.ravel(), problem.cap
        self.load_fixed = problem.load is not None
        self.load = problem.load or 0.0
        self.capped = bool(np.isfinite(self.cap).any())
        self.missing = self.load - float(self.p.sum()) if self.load_fixed else 0.0
        self.clipped, self.added, self.scale = 0, 0, 0.0
        rms = float(np.std(self.h))
        self.as_rough = np.array([rms, -rms])  # two heights for the scale, instead of all again
        self.relative, self.stuck, self.wary = np.inf, False, False
        self.at = np.zeros(0, np.intp)

    def measure(self) -> float:
        """Reduced gap, level and relative violation of the pressure at hand."""
        loops = self.grid.loops
        self.exact = self.relative <= ROUGH
        self.grid.displace(self.exact)
        self.scale = height_scale(self.as_rough, self.g, flat=1.0)
        loops.reduce_gap(self.g, self.h)
        weight, weighted, free = loops.survey(self.p, self.g, self.cap)
        if self.problem.level is not None:
            self.level = self.problem.level
        elif free:
            self.level = weighted / weight
        else:
            self.level = free_level(self.p, self.g, self.cap)
        worst, energy, deepest = loops.grade(self.p, self.g, self.cap, self.level)
        total = float(self.p.sum())
        if self.load_fixed and not self.capped:
            energy = deepest * total
        self.certificate = energy / (total * self.scale) if total > 0.0 else 0.0
        self.relative = float(worst) / self.scale
        return self.relative

    def done(self) -> bool:
        """Whether the pressures solve the problem, load and all, by an exact displacement."""
        return self.relative <= self.rtol and self.balanced() and (self.exact or self.rtol >= ROUGH)

    def balanced(self) -> bool:
        """Whether the pressures sum to the load."""
        return abs(self.missing) <= 1e-12 * self.load

    def correct(self) -> None:
        """Correct the moving pixels, or where none can move take a projected gradient step."""
        loops = self.grid.loops
        if self.clipped == 0:
            self._choose()
        if self.at.size <= (self.load_fixed and not self.missing):
            return self._descend()
        r = self.level - self.g[self.at]
        if self.load_fixed:
            r -= r.mean()
        x = Correction(self.grid, self.at, self.load_fixed).solve(
            r, self._reduction(), self.missing
        )
        self.clipped = loops.settle(self.p, self.at, x, self.cap)
        self._balance()
        if self.clipped and self.stuck:
            self.at, self.added = self.at[self._between(self.at)], 0
        elif self.clipped:
            self._foresee()
        return None

    def _between(self, at: NDArray[np.intp]) -> NDArray[np.bool_]:
        bound = self.cap if self.cap.size == 1 else self.cap[at]
        return np.asarray((self.p[at] > 0.0) & (self.p[at] < bound))

    def _reduction(self) -> float:
        """How far to reduce the inner residual: little as long as the active set moves."""
        if self.stuck:
            return 0.03
        changed = (self.clipped + self.added) / self.at.size
        for share, reduction in REDUCTIONS:
            if changed > share:
                return reduction
        return min(0.03, max(0.4 * self.rtol / self.relative, 1e-5))

    def _balance(self) -> None:
        """Restore the load by scaling; a cap in the way leaves it to the next correction."""
        self.missing = 0.0
        if self.load_fixed and not (self.capped and self.clipped):
            self.grid.loops.rescale(self.p, self.at, self.cap, self.load)
        elif self.load_fixed:
            self.missing = self.load - float(self.p.sum())

    def _foresee(self) -> None:
        """Choose the next moving pixels by the gap that the correction had before it was clipped.

        Clipping makes dents of its own in the gap, which would be taken for penetration.
        """
        self.g += self.grid.change
        if self.load_fixed:
            self.level = float(self.g[self.at].mean())
        self.g[self.at] = self.level
        self._choose()

    def _choose(self) -> None:
        """Choose the moving pixels; while that leads nowhere, few of those that leave a bound."""
        self.at, self.added = self.grid.loops.select(self.p, self.g, self.cap, self.level)
        if self.wary and self.added:
            off = np.abs(self.g[self.at] - self.level)
            between = self._between(self.at)
            off[between] = 0.0
            kept = between | (off > WORST * off.max())
            self.at, self.added = self.at[kept], int(np.count_nonzero(kept & ~between))

    def _descend(self) -> None:
        gradient = self.g - (self.problem.level or 0.0)
        self.p[...] = project(self.p - gradient / self.grid.steepest, self.problem)
        self.clipped, self.missing = 0, 0.0


def improve(
    grid: Grid,
    problem: Problem,
    rtol: float,
    report: Callable[[int, float], None] | None = None,
) -> Outcome:
    """Outer steps on one grid until the relative residual is `rtol`, or they lead nowhere.

    Parameters
    ----------
    grid : Grid
        Its ``exact.source`` holds the first pressures, and the last ones on return.
    problem : Problem
        Dimensionless problem on this grid.
    rtol : float
        Largest violation to accept, over `height_scale`.
    report : callable, optional
        Called with the applications so far and every relative residual.

    Returns
    -------
    Outcome
        With ``relative > rtol`` if the steps led nowhere: somebody else has to finish.
    """
    walk = _Walk(grid, problem, rtol)
    history: list[tuple[int, float]] = []
    best, best_step = np.inf, 0
    for step in range(MOST_OUTER):
        relative = walk.measure()
        history.append((grid.applications(), relative))
        if report is not None:
            report(*history[-1])
        if walk.done():
            break
        if relative <= BLURRED and not walk.exact:
            continue  # measure again before anything is corrected
        if relative < 0.5 * best:
            best, best_step = relative, step
        walk.wary = step - best_step >= WARY
        walk.stuck = step - best_step >= CYCLE
        if step - best_step >= PATIENCE:
            break
        if step < MOST_OUTER - 1:
            walk.correct()
    relative = walk.relative if walk.done() else max(walk.relative, 2.0 * rtol)
    return Outcome(walk.level, relative, walk.certificate, len(history), tuple(history))
