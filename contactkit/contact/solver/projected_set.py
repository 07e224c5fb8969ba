r"""Projected active set: for stiff films, under which truncated steps stall.

As long as many pixels come or go, the step is the one that minimises the energy with the operator
replaced by the inverse of its sparse inverse K: the preconditioned residual ``K r`` of all pixels
in contact or penetrating, projected onto the bounds in the metric of K. For the step d

.. math:: r^T d \ge d^T K^{-1} d > 0

so that the energy falls along it, and by a fixed part of what is left if K is near the inverse.
Both ends are feasible and their gaps are convolved anyway: the minimum between them is free. Once
few pixels come or go, conjugate gradients solve for the free pixels, and are projected likewise; if
bounds cut their answer short, they run once more, on the pixels that the other step leaves free.

What a projection leaves of the load is made up along ``K 1``, which costs the least energy. To
scale pressures to the load, or to lose the metric in the round-off of single precision, would end
the descent under the stiffest films.

Sign convention: pressure, heights and displacement positive into the solid; symbols as in
`loops_numpy`.
"""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from .loops_numpy import dot
from .nested_grids import GridLevel
from .problem import ContactProblem, clip_to_load, fit
from .projection import TOLERANCE, Projection
from .reduced_system import ReducedSystem
from .state import ActiveSetState

__all__ = ["ProjectedSet"]

Floats = NDArray[np.float64]
Indices = NDArray[np.intp]
# Measurements are those of the room (`contact.solver`), on 128 x 128 pixels.
#
# Fraction of pixels that come or go above which the metric alone is used: conjugate gradients on a
# set that changes are lost. 0.2 takes 3 % more applications, 0.01 1 %.
UNSETTLED = 0.05
# Step of the line search below which the trial is not taken whole: the energy falls all the same,
# and the gap at the whole step is known. 0.9 takes 2 % more applications, 0.4 2 % fewer.
SHORT = 0.7
# Pressures that a trial may move before it is projected, over the load: what bounds cut off anyway
# costs the projection its digits. 0.5 to 8 take the same within 1 %.
FARTHEST = 2.0
FARTHER = 30.0  # how much more it may after a step that could have gone on: 3 to 300 are alike
MAX_APPLICATIONS = 1500  # of the operator: a guard, the longest of these contacts takes 38
MOST_SHORT = 3  # such steps in a row, after which conjugate gradients are tried: 1 to 10 within 1 %
STUCK = 0.02  # step of the line search that stalls: 0.005 to 0.1 are alike
LEAST = 0.1  # fraction of a step in the metric that is tried after short ones: 0.02 to 0.5 alike
FINEST = 1e-6  # tolerance of the projection after steps that stalled: 1e-8 to 1e-4 are alike
# Reduction that single precision still gives under a stiff film: at 0.1 a film of 3000 times the
# modulus takes 45 applications in place of 38, at 1e-3 40.
FLOOR = 1e-2
# Fraction of pixels that come or go, and how far the linear residual is reduced: three times as far
# or a third takes 2 % more applications, always to the end 4 %.
REDUCTIONS = (
    (0.01, 0.1),
    (3e-4, 0.03),
)


class ProjectedSet(ActiveSetState):
    """Iterations of the projected active set; parameters as of `ActiveSetState`."""

    max_iterations = 150

    def __init__(self, grid: GridLevel, problem: ContactProblem, rtol: float) -> None:
        super().__init__(grid, problem, rtol)
        self.metric = grid.metric
        if not self.balanced():  # the line search goes between maps of one load
            self.p[...] = fit(self.p, problem)
            self.missing = 0.0
        self.before: tuple[Indices, Floats, Floats] | None = None
        self.n_short = 0  # steps in a row that went less than their length
        self.changed = 1.0  # fraction of pixels that came or went in the last step
        self.fraction = 1.0  # fraction of a step in the metric that is tried
        self.farthest = FARTHEST
        self.stride = 1.0  # of a gradient step, over the least that must go downhill
        self.is_cut = False  # whether bounds cut the last solution by conjugate gradients short
        self.source = ""  # of the last trial

    def stagnates(self, step: int) -> bool:
        """Whether the solve has become too long; the energy falls at every step."""
        return self.grid.applications() > MAX_APPLICATIONS

    def evaluate(self) -> float:
        """Reduced gap, approach and violation, after a line search along the last step."""
        relative = super().evaluate()
        if self.before is not None:
            relative = self._search_line(*self.before)
            self.before = None
        return relative

    def _search_line(self, at: Indices, p: Floats, g: Floats) -> float:
        """Go to the minimum of the energy between two feasible maps unless it is near the end."""
        d, turn = self.p[at] - p, self.g[at] - g[at]
        slope, curvature = dot(self.approach - g[at], d), dot(d, turn)
        length = slope / curvature if curvature > 0.0 else 1.0
        self.n_short = self.n_short + 1 if length < SHORT else 0
        if self.source == "metric":
            self.fraction = min(max(self.fraction * length, LEAST), 1.0)
            self.farthest = max(self.farthest * min(length, FARTHER), FARTHEST)
        elif self.source == "gradient":
            self.stride = max(self.stride * length, 1.0)
        self.is_cut = self.source == "solved" and length < SHORT
        if length >= SHORT:
            return self.relative
        if length < STUCK and not self.exact:  # round-off of single precision decides
            self.precise = True
            self.p[at] = p
            return super().evaluate()
        length = max(length, 0.0)
        self.p[at] = p + length * d
        self.g *= length  # between two gaps that are known: the displacement is linear
        self.g += (1.0 - length) * g
        return self.grade()

    def correct(self) -> None:
        """Change the free pixels within their bounds, downhill in energy."""
        free = self.grid.loops.free_set(self.p, self.g, self.upper, self.approach)
        at = free.at
        if at.size <= self.load_fixed:
            self.descend()
            return
        p, g = self.p[at], self.g.copy()
        r = self.approach - g[at]
        if self.load_fixed:
            r -= r.mean()
        bound = np.broadcast_to(self.upper, self.p.shape)[at]
        y = self._trial(at, p, r, bound, free.added)
        self.before = at, p, g
        stopped = np.count_nonzero(((y <= 0.0) & (p > 0.0)) | ((y >= bound) & (p < bound)))
        self.changed = (stopped + free.added) / at.size
        self.p[at] = y
        self._restore_load(at)

    def _trial(self, at: Indices, p: Floats, r: Floats, bound: Floats, added: int) -> Floats:
        """Feasible pressures of the free pixels that go downhill."""
        is_settled = max(self.changed, added / at.size) <= UNSETTLED
        if (self.n_short >= MOST_SHORT or is_settled) and not self.is_cut:
            self.n_short = 0
            self.source = "solved"
            y = self._projected(at, p, self._solved(at, r), bound)
            if dot(r, y - p) > 0.0:
                return y
        self.source = "metric"
        self._prepare(at)
        x = self.fraction * self._preconditioned(r)
        y = self._projected(at, p, x, bound)
        if not dot(r, y - p) > 0.0:
            return self._downhill(p, r, bound)
        return self._on_face(at, p, y, r, bound) if self.is_cut else y

    def _on_face(self, at: Indices, p: Floats, y: Floats, r: Floats, bound: Floats) -> Floats:
        """From a feasible trial, conjugate gradients on the pixels that it leaves free."""
        self.source, self.is_cut = "face", False
        free = (y > 0.0) & (y < bound)
        inside = at[free]
        if inside.size < 2:
            return y
        quick, loops = self.grid.quick, self.grid.loops
        place = quick.places(at)
        loops.scatter(quick.memory, place, (y - p).astype(np.float32))
        moved = quick.run().ravel()[inside].astype(np.float64)
        quick.memory[place] = 0.0
        rest = r[free] - moved
        if self.load_fixed:
            rest -= rest.mean()
        better = y.copy()  # the others stay at the bounds that the trial met
        x = self._solved(inside, rest)
        better[free] = self._projected(inside, y[free], x, bound[free])
        return better if dot(r, better - p) > 0.0 else y

    def _solved(self, at: Indices, r: Floats) -> NDArray[Any]:
        system = ReducedSystem(self.grid, at, self.load_fixed, displaces=False)
        return system.solve(r, self._reduction(), 0.0)

    def _prepare(self, at: Indices) -> None:
        if not np.array_equal(self.metric.at, at):
            self.metric.prepare(at, self.load_fixed)

    def _preconditioned(self, r: Floats) -> Floats:
        """Pressures that the sparse inverse gives for a residual, of zero sum if the load is."""
        x = self.metric(r)
        if self.load_fixed:
            k = self.metric(np.ones_like(r))
            x -= k * (x.sum() / k.sum())
        return x

    def _projected(self, at: Indices, p: Floats, x: NDArray[Any], bound: Floats) -> Floats:
        """Pressures changed by x, projected onto their bounds if they leave them."""
        x = x * self._shortened(x)
        y: Floats = p + x
        if np.all((y >= 0.0) & (y <= bound)):
            return y
        self._prepare(at)  # few pixels are solved for without it
        kind = self.metric.kind
        low, high = (-p).astype(kind), (bound - p).astype(kind)
        tolerance = max(TOLERANCE * 0.1**self.n_short, FINEST)
        projection = Projection(self.metric.factor, low, high, self.load_fixed, tolerance)
        found = projection(x.astype(kind))
        change = found.change.astype(np.float64)
        if self.load_fixed:
            projection.restore(change, 0.0)
            change = _balanced(change)
        y = np.clip(p + change, 0.0, bound)
        y[change <= low] = 0.0  # exactly, as p + change is not: the sets follow from it
        return np.asarray(np.where(change >= high, bound, y))

    def _downhill(self, p: Floats, r: Floats, bound: Floats) -> Floats:
        """The safeguard: a projected gradient step, short but certain to go downhill."""
        self.source = "gradient"
        trial = p + r * (self.stride / self.grid.steepest)
        if self.load_fixed:
            return clip_to_load(trial, bound, float(p.sum()))
        return np.clip(trial, 0.0, bound)

    def _shortened(self, x: NDArray[Any]) -> float:
        """Factor of a change that would move many times the load, which bounds cut off anyway."""
        moved = 0.5 * float(np.abs(x).sum())
        most = self.farthest * self.load
        return most / moved if self.load_fixed and moved > most else 1.0

    def _restore_load(self, at: Indices) -> None:
        """Scale the free pixels so that the pressures sum to the load."""
        if self.load_fixed and self.bounded:
            self.p[...] = fit(self.p, self.problem)
        elif self.load_fixed:
            self.grid.loops.scale_to_load(self.p, at, self.upper, self.load)
        self.missing = 0.0

    def _reduction(self) -> float:
        """Reduction of the linear residual: inexact Newton, loose while the active set changes."""
        for fraction, reduction in REDUCTIONS:
            if self.changed > fraction:
                return reduction
        return min(0.03, max(0.4 * self.rtol / max(self.relative, 1e-5 * self.rtol), FLOOR))


def _balanced(change: Floats) -> Floats:
    """Changes that sum to zero but for round-off: the larger of gain and loss is cut back."""
    gain, loss = float(change[change > 0.0].sum()), -float(change[change < 0.0].sum())
    if abs(gain - loss) <= 1e-9 * (gain + loss):
        return change  # pixels held at a bound stay there
    if gain > loss:
        return np.where(change > 0.0, change * (loss / gain), change)
    return np.where(change < 0.0, change * (gain / loss), change)
