"""Primal-dual active set with conjugate gradients, for all maps at once.

Every iteration applies the operator once to all maps: to the pressures of a map whose set of free
pixels has just changed, which is then graded exactly, and to the search direction of a map whose
linear equations are being solved. Each map is at its own place; masks decide. Pixels in contact are
masks of the grid, so that no shape depends on the data.

Sign convention: pressure, heights and displacement positive into the solid.

=========  =================================================================
symbol     meaning
=========  =================================================================
t          trial pressures; within the bounds where a map is graded
g          reduced gap ``G t - h`` of them, the approach on free pixels
free       pixels between the bounds, or leaving one
r, d       residual of the free pixels, search direction
=========  =================================================================
"""

from __future__ import annotations

from typing import Any

from ..solver.optimality import FINEST
from .namespace import Space
from .operator import MapOperator
from .problem import MapsProblem, balanced

__all__ = ["MapsIteration"]

# Measurements: rough maps of 64 x 64 to 256 x 256 pixels on half-spaces, films and stiff films,
# from 1 % to full contact, periodic and isolated.
#
# Fraction of pixels that come or go, and how far the linear residual is reduced then.
REDUCTIONS = ((0.05, 0.1), (0.01, 0.05), (0.0, 0.015))
# Of the reduction, at each set that did not halve the violation. Under a film of 100 times the
# modulus a fixed reduction never found the set on 256 x 256 pixels; with this even 1e6 times does.
TIGHTER, TIGHTEST = 0.3, 1e-3
LEAST_REDUCTION = 1e-5  # below, round-off of the recurrences decides
CAUTIOUS_AFTER = 1  # sets without progress after which only the worst pixels join
WORST = 0.8  # violation of those, over the largest; 0.3 takes the same
SAFETY = 0.3  # of the tolerance, at which the linear equations are solved
MOST_STEPS = 300  # on one set, then the gap is evaluated again: round-off of the recurrences
# `optimality.FINEST` in single precision, whose round-off is 3e-7 of the displacement.
FINEST_SINGLE = 1e-2
PATIENCE = 20  # sets within which the violation must have halved


class MapsIteration:
    """Iterations of all maps on one grid.

    Parameters
    ----------
    space : Space
        Of all arrays.
    operator : MapOperator
        Of the grid.
    problem : MapsProblem
        Dimensionless.
    start : array (n, ny, nx)
        Initial pressures.
    rtol : float
        Relative violation to reach.

    Attributes
    ----------
    pressure, gap : array (n, ny, nx)
        Pressures within the bounds, and their reduced gap.
    approach, relative : array (n, 1, 1)
        Rigid-body approach, and largest violation over the height scale.
    count : array (n, 1, 1)
        Applications of the operator that each map took part in.
    """

    def __init__(
        self, space: Space, operator: MapOperator, problem: MapsProblem, start: Any, rtol: float
    ) -> None:
        xp = space.xp
        self.space, self.operator, self.problem, self.rtol = space, operator, problem, rtol
        self.zero, self.nothing = xp.zeros_like(start), xp.zeros_like(problem.rms)
        self.running = self.nothing == 0.0
        self.evaluating, self.is_first = self.running, True
        self.free = start > 0.0
        self.t = balanced(space, start, self.free, problem)
        self.g, self.r, self.d = -problem.heights, self.zero, self.zero
        self.moved, self.length, self.strength = self.zero, self.nothing, self.nothing
        self.on, self.n_free, self.squared = self.zero, self.nothing + 1.0, self.nothing
        self.approach = self.nothing if problem.approach is None else problem.approach
        self.relative, self.scale = self.nothing + xp.inf, self.nothing + 1.0
        self.best, self.stalled, self.tight = self.relative, self.nothing, self.nothing + 1.0
        self.reduction = self.nothing + REDUCTIONS[0][1]
        self.inner, self.count = self.nothing, self.nothing

    @property
    def pressure(self) -> Any:
        """Pressures within the bounds."""
        return self._bounded(self.t)

    @property
    def gap(self) -> Any:
        """Reduced gap of the pressures."""
        return self.g

    def run(self, max_iterations: int) -> None:
        """Iterate until every map meets the tolerance, stagnates, or is out of iterations."""
        xp = self.space.xp
        evaluates, steps = True, False
        for _ in range(max_iterations):
            if not (evaluates or steps):
                return
            u = self.operator.displace(self._source(evaluates, steps))
            self.count = xp.where(self.running, self.count + 1.0, self.count)
            if steps:
                self._step(u)
            if evaluates:
                self._evaluate(u)
            restarted, self.evaluating = self.evaluating, xp.zeros_like(self.evaluating)
            if steps:
                self._end_steps(self.running & ~restarted)
            evaluates = steps and bool(xp.any(self.evaluating))
            steps = bool(xp.any(self.running & ~self.evaluating))
            if steps:
                self._turn(restarted)
        self._grade_the_rest()

    def _source(self, evaluates: bool, steps: bool) -> Any:
        if evaluates and steps:
            return self.space.xp.where(self.evaluating, self.t, self.d)
        return self.t if evaluates else self.d

    def _on_free(self, maps: Any) -> Any:
        """Values on the free pixels, zero elsewhere; less their mean if the load is prescribed."""
        inside = maps * self.on
        if self.problem.load is None:
            return inside
        return inside - (self.space.total(inside) / self.n_free) * self.on

    def _bounded(self, t: Any) -> Any:
        xp, upper = self.space.xp, self.problem.upper
        t = xp.maximum(t, self.zero)
        return t if upper is None else xp.minimum(t, upper)

    # Steps of conjugate gradients ---------------------------------------------------------------

    def _step(self, u: Any) -> None:
        """Step to the minimum along the search direction, whose displacement is `u`."""
        xp, space = self.space.xp, self.space
        self.moved = self._on_free(u)
        curvature = space.total(self.d * self.moved)
        steps = self.running & ~self.evaluating & (curvature > 0.0)
        along = space.total(self.r * self.d)
        self.length = xp.where(
            steps, along / xp.where(steps, curvature, self.nothing + 1.0), self.nothing
        )
        self.t = self.t + self.length * self.d
        self.g = self.g + self.length * u
        self.r = self.r - self.length * self.moved
        self.inner = self.inner + 1.0

    def _turn(self, restarted: Any) -> None:
        """Next conjugate direction; the residual itself, preconditioned, on a new set."""
        xp, space = self.space.xp, self.space
        z = self._on_free(self.operator.near_inverse(self.r))
        goes_on = ~restarted & (self.strength > 0.0)
        before = xp.where(goes_on, self.strength, self.nothing + 1.0)
        # What the last step has turned r by: flexible, as r drifts and z is cut to the free pixels.
        beta = -self.length * space.total(z * self.moved) / before
        beta = xp.where(goes_on, xp.maximum(beta, self.nothing), self.nothing)
        self.d = z + beta * self.d
        self.strength = space.total(self.r * z)

    # Sets of free pixels ------------------------------------------------------------------------

    def _end_steps(self, stepping: Any) -> None:
        """Choose the next free pixels of the maps whose equations are solved well enough."""
        xp, space = self.space.xp, self.space
        squared = space.total(self.r * self.r)
        enough = squared <= self.reduction * self.reduction * self.squared
        ended = stepping & (enough | (self.inner >= MOST_STEPS) | (self.strength <= 0.0))
        if not bool(xp.any(ended)):
            return
        if self.problem.load is not None:
            mean = space.total(self.g * self.on) / self.n_free
            self.approach = xp.where(ended, mean, self.approach)
        stops, joins = self._changes()
        changed = space.count(stops | joins)
        coarse = space.highest(xp.abs(self.r)) > SAFETY * self.rtol * self.scale
        goes_on = (changed == 0.0) & coarse & (self.inner < MOST_STEPS) & (self.strength > 0.0)
        fraction = changed / self.n_free
        reduction = xp.maximum(
            self.tight * self._reduction(fraction), self.nothing + LEAST_REDUCTION
        )
        reduction = xp.where(goes_on, 0.1 * self.reduction, reduction)
        self.reduction = xp.where(ended, reduction, self.reduction)
        self.evaluating = ended & ~goes_on
        chosen = (self.free & ~stops) | joins
        self.free = xp.where(self.evaluating, chosen, self.free)
        made = balanced(space, self.t, self.free, self.problem)
        self.t = xp.where(self.evaluating, made, self.t)

    def _changes(self) -> tuple[Any, Any]:
        """Free pixels that reach a bound, and pixels at a bound that would be penetrated or gape.

        By the gap under the trial pressures: a pixel that stops at its bound changes the gap around
        it, which is no penetration.
        """
        xp, t, upper = self.space.xp, self.t, self.problem.upper
        off = self.g - self.approach
        if upper is None:
            stops, joins = self.free & (t <= 0.0), ~self.free & (off < 0.0)
        else:
            stops = self.free & ((t <= 0.0) | (t >= upper))
            joins = ((t <= 0.0) & (off < 0.0)) | ((t >= upper) & (off > 0.0))
            joins = joins & ~self.free & (upper > 0.0)
        violation = xp.where(joins, xp.abs(off), self.zero)
        worst = self.space.highest(violation)
        is_bold = self.stalled < CAUTIOUS_AFTER
        return stops, joins & (is_bold | (violation > WORST * worst))

    def _reduction(self, fraction: Any) -> Any:
        xp = self.space.xp
        found = self.nothing + REDUCTIONS[-1][1]
        for least, reduction in REDUCTIONS[-2::-1]:
            found = xp.where(fraction > least, self.nothing + reduction, found)
        return found

    # Grading ------------------------------------------------------------------------------------

    def _evaluate(self, u: Any) -> None:
        """Grade the maps whose displacement is `u`, and set up their linear equations."""
        xp, space, here = self.space.xp, self.space, self.evaluating
        self.g = xp.where(here, u - self.problem.heights, self.g)
        approach = self._free_approach() if self.problem.approach is None else self.approach
        self.approach = xp.where(here, approach, self.approach)
        largest = space.highest(xp.abs(u))
        self.scale = xp.where(here, self._height_scale(largest), self.scale)
        self.relative = xp.where(here, self._violation() / self.scale, self.relative)
        is_done = here & (self.relative <= self.rtol) & self._carries()
        is_better = self.relative < 0.5 * self.best
        stalled = xp.where(is_better, self.nothing, self.stalled + 1.0)
        self.stalled = xp.where(here, stalled, self.stalled)
        self.best = xp.where(here & is_better, self.relative, self.best)
        tight = xp.maximum(TIGHTER * self.tight, self.nothing + TIGHTEST)
        self.tight = xp.where(here & ~is_better, tight, self.tight)
        self.running = self.running & ~is_done & (self.stalled < PATIENCE)
        if self.is_first:
            self._first_set()
        self.on = xp.astype(self.free, space.dtype)  # products take half the time of `where`
        self.n_free = xp.maximum(space.total(self.on), self.nothing + 1.0)
        self.r = xp.where(here, self._on_free(self.approach - self.g), self.r)
        self.squared = xp.where(here, space.total(self.r * self.r), self.squared)
        self.inner = xp.where(here, self.nothing, self.inner)

    def _first_set(self) -> None:
        """Free pixels of the first guess: between the bounds, or leaving one."""
        t, upper, off = self.t, self.problem.upper, self.g - self.approach
        self.free = (t > 0.0) | (off < 0.0)
        if upper is not None:
            self.free = self.free & (upper > 0.0) & ((t < upper) | (off > 0.0))
        self.is_first = False

    def _free_approach(self) -> Any:
        """`optimality.free_approach` of every map."""
        xp, space, t, g, upper = self.space.xp, self.space, self.t, self.g, self.problem.upper
        touches = t > 0.0
        free = touches if upper is None else touches & (t < upper)
        weight = xp.where(free, t, self.zero)
        carried = space.total(weight)
        mean = space.total(weight * g) / xp.where(carried > 0.0, carried, self.nothing + 1.0)
        apart = ~touches if upper is None else ~touches & (upper > 0.0)
        lowest = -space.highest(xp.where(apart, -g, self.zero - xp.inf))
        highest = lowest
        if upper is not None:
            highest = space.highest(xp.where(touches & ~free, g, self.zero - xp.inf))
            is_last = xp.isinf(lowest)
            lowest = xp.where(is_last, highest, lowest)
            highest = xp.where(xp.isinf(highest), lowest, highest)
        return xp.where(carried > 0.0, mean, 0.5 * (lowest + highest))

    def _violation(self) -> Any:
        """Largest violation of a contact condition of every map."""
        xp, t, upper = self.space.xp, self.t, self.problem.upper
        off = self.g - self.approach
        is_met = (t <= 0.0) & (off > 0.0)
        if upper is not None:
            is_met = is_met | ((t >= upper) & (off < 0.0))
        return self.space.highest(xp.where(is_met, self.zero, xp.abs(off)))

    def _height_scale(self, largest: Any) -> Any:
        """`optimality.scale_of` of every map, its round-off that of the precision."""
        xp, rms, flat = self.space.xp, self.problem.rms, self.problem.flat
        largest_of_all = xp.maximum(largest, flat)
        finest = FINEST if self.space.epsilon < 1e-10 else FINEST_SINGLE
        least = xp.maximum(1e-4 * rms, finest * largest_of_all)
        rough = xp.maximum(xp.minimum(rms, largest), least)
        return xp.where(rms > 0.0, rough, largest_of_all)

    def _carries(self) -> Any:
        """Whether the pressures within the bounds sum to the load."""
        load = self.problem.load
        if load is None:
            return self.running
        missing = self.space.xp.abs(self.space.total(self._bounded(self.t)) - load)
        return missing <= max(1e-12, 100.0 * self.space.epsilon) * load

    def _grade_the_rest(self) -> None:
        """Grade what ran out of iterations: its gap is that of trial pressures."""
        xp = self.space.xp
        if not bool(xp.any(self.running)):
            return
        made = balanced(self.space, self.t, self.free, self.problem)
        self.t = xp.where(self.running, self._bounded(made), self.t)
        self.evaluating = self.running
        self._evaluate(self.operator.displace(self.t))
