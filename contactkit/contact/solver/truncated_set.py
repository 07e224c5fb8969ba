"""Truncated active set: pixels whose change exceeds a bound stop at it.

Every iteration changes the pressure of the free pixels so that the reduced gap ``g`` becomes the
approach there. Those at a bound that would be penetrated, or gape, under the change as computed are
free in the next iteration. The method for half-spaces and layers of moderate contrast; under a
stiff film truncated pressures leave pits in the displacement, and `projected_set` is used.

Sign convention and symbols: see `state`.
"""

from __future__ import annotations

import numpy as np

from .nested_grids import GridLevel
from .problem import ContactProblem
from .reduced_system import ReducedSystem
from .state import ActiveSetState

__all__ = ["TruncatedSet"]

# Measurements are those of the room (`contact.solver`), on 128 x 128 pixels.
#
# Iterations without progress after which few pixels leave a bound at a time. At once (0) it takes
# 2.3 times the applications, as most sets are right after a few steps; 3 take as many.
CAUTIOUS_AFTER = 1
WORST = 0.8  # violation of those few, over the maximum: 0.5 to 0.95 take the same
CYCLE = 5  # iterations without progress after which pixels that stop at a bound stay there: a guard
# Fraction of pixels that come or go, and how far the linear residual is reduced. Always reduced to
# the end it takes 46 % more applications, by the last pair alone 5 %; twice as far or half, 1 %.
REDUCTIONS = (
    (0.05, 0.2),
    (0.01, 0.1),
    (3e-4, 0.03),
)
# The same presumed of an extrapolated start, whose first correction shows which pixels leave.
# Curves of twelve loads in steps of 1 % take 0.55 to 0.63 of single solves, without this 0.62 to
# 0.76; a reduction to 0.03 in place of 0.1 takes 2 % more.
EXTRAPOLATED = 0.02
# Of the last reduction: the violation is a maximum, the linear residual a norm. 0.1 takes 1 % more
# applications, 1 takes 1 % fewer.
SAFETY = 0.3
PATIENCE = 15  # iterations within which the residual must have halved: a guard, 5 to 40 are alike


class TruncatedSet(ActiveSetState):
    """Iterations of the truncated active set.

    Parameters
    ----------
    grid, problem, rtol
        As of `ActiveSetState`.
    is_extrapolated : bool
        Whether the pressures are extrapolated from other loads: nearly right, but which pixels
        leave the contact is seen with the first correction only.
    """

    def __init__(
        self, grid: GridLevel, problem: ContactProblem, rtol: float, is_extrapolated: bool = False
    ) -> None:
        super().__init__(grid, problem, rtol)
        self.presumed = EXTRAPOLATED if is_extrapolated else 0.0
        self.stuck, self.cautious = False, False
        self.at = np.zeros(0, np.intp)
        self.best, self.best_step = np.inf, 0

    def stagnates(self, step: int) -> bool:
        """Note the progress up to a step; whether there has been none for too long."""
        if self.relative < 0.5 * self.best:
            self.best, self.best_step = self.relative, step
        self.cautious = step - self.best_step >= CAUTIOUS_AFTER
        self.stuck = step - self.best_step >= CYCLE
        return step - self.best_step >= PATIENCE

    def correct(self) -> None:
        """Correct the free pixels; if there are none, take a projected gradient step."""
        loops = self.grid.loops
        if self.stopped == 0:  # else they were chosen with the last correction
            self._choose_free()
        if self.at.size <= (self.load_fixed and not self.missing):
            self.descend()
            return
        r = self.approach - self.g[self.at]
        if self.load_fixed:
            r -= r.mean()
        system = ReducedSystem(self.grid, self.at, self.load_fixed)
        x = system.solve(r, self._reduction(), self.missing)
        self.stopped = loops.add_and_clip(self.p, self.at, x, self.upper)
        self._balance()
        if self.stopped and self.stuck:  # left there: predicted free, they come and go
            self.at, self.added = self.at[self.between(self.at)], 0
        elif self.stopped:
            system.displace(x)
            self._predict_free()

    def _reduction(self) -> float:
        """Reduction of the linear residual: inexact Newton, loose while the active set changes."""
        if self.stuck:
            return 0.03
        enough = SAFETY * self.rtol / max(self.relative, 1e-5 * self.rtol)
        changed = max((self.stopped + self.added) / self.at.size, self.presumed)
        self.presumed = 0.0
        for fraction, reduction in REDUCTIONS:
            if changed > fraction:
                return max(reduction, min(enough, 0.5))
        return min(max(enough, 1e-5), 0.5)

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
        self.grid.loops.add_change(self.g, self.grid.change)
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
            between = self.between(self.at)
            off[between] = 0.0
            kept = between | (off > WORST * off.max())
            self.at, self.added = self.at[kept], int(np.count_nonzero(kept & ~between))
