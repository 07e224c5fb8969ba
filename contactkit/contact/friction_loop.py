"""Contact under a given bound of the pressure, with the displacement that friction causes."""

from __future__ import annotations

import time
from collections.abc import Callable
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from .plan import ContactPlan
from .solver.contact_solver import Solution
from .solver.warm_start import Start
from .work import WorkCounter

if TYPE_CHECKING:
    from numpy.typing import NDArray

    Map = NDArray[np.float64]

__all__ = ["Friction", "Frictional", "Target", "solve_bounded"]

_MAX_ITERATIONS = 60


class Target(NamedTuple):
    """Load or approach of one solve, and its initial guess.

    Either a mean pressure [Pa] or an approach of the zero plane of the heights [m]. `start` is a
    pressure (ny, nx) [Pa], or pairs of mean pressure and pressure, the newest first; `hardness`
    [Pa] is that of a solution nearby.
    """

    mean_pressure: float | None
    rigid_approach: float | None
    start: Start | None = None
    hardness: float | None = None


class Friction(NamedTuple):
    """Normal displacement caused by friction [m], and the pressure [Pa] without it, (ny, nx) each.

    `problem` says why displacement and pressure do not agree yet; empty if they do.
    """

    displacement: Map
    pressure_without: Map
    problem: str = ""


class Frictional(NamedTuple):
    """A solved contact, and its friction if the scene couples them."""

    solution: Solution
    friction: Friction | None


def solve_bounded(
    plan: ContactPlan, target: Target, bound: Map | float | None, counter: WorkCounter
) -> Frictional:
    """Solve one contact under a given bound; with friction coupling, iterate until it agrees."""
    begun = time.perf_counter()
    solved = Frictional(_once(plan, target, bound, plan.heights, counter), None)
    if plan.coupling is not None:
        solved = _coupled(plan, target, bound, counter, solved.solution, plan.coupling)
    counter.clock("contact", begun)
    return solved


def _coupled(
    plan: ContactPlan,
    target: Target,
    bound: Map | float | None,
    counter: WorkCounter,
    solution: Solution,
    caused_by: Callable[[Map], Map],
) -> Frictional:
    """Repeat the contact with the displacement of its own traction until it no longer changes."""
    without = solution.pressure
    displacement: Map = np.zeros(plan.grid.shape)
    for _ in range(_MAX_ITERATIONS):
        caused = caused_by(solution.pressure)
        scale = max(float(np.ptp(solution.displacement)), np.finfo(float).tiny)
        change = float(np.abs(caused - displacement).max()) / scale
        displacement = caused
        if change <= plan.accuracy.outer_rtol or not solution.converged:
            return Frictional(solution, Friction(displacement, without))
        again = target._replace(start=solution.pressure)
        solution = _once(plan, again, bound, plan.heights - displacement, counter)
    problem = (
        f"the friction coupling still changes by {change:.2g} of the displacement after "
        f"{_MAX_ITERATIONS} iterations, tolerance {plan.accuracy.outer_rtol:g}; lower "
        "FrictionTraction.coefficient or leave FrictionCoupling out"
    )
    return Frictional(solution, Friction(displacement, without, problem))


def _once(
    plan: ContactPlan,
    target: Target,
    bound: Map | float | None,
    heights: Map,
    counter: WorkCounter,
) -> Solution:
    accuracy = plan.accuracy
    solution = plan.prepared.solver.solve(
        plan.prepared.open(heights),
        mean_pressure=target.mean_pressure,
        rigid_approach=target.rigid_approach,
        bound=bound,
        rtol=accuracy.rtol,
        start=target.start,
        max_iterations=accuracy.max_iterations,
        method=accuracy.method,
    )
    counter.add(solution)
    return solution
