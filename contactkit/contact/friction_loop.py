"""Contact under a given bound of the pressure, with the displacement that friction causes."""

from __future__ import annotations

import math
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
_WITHOUT = 1e-6  # tolerance of the contact without coupling, which is only compared with
_CONTRACTION = 0.1  # of the change by one pass, until two are known
_FASTEST = 1e-3  # contraction that is relied on at most


class Target(NamedTuple):
    """Load or approach of one solve, and its initial guess.

    Either a mean pressure [Pa] or an approach of the zero plane of the heights [m]. `start` is a
    pressure (ny, nx) [Pa], or pairs of load or approach and pressure, the nearest first; `hardness`
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


class _Pass(NamedTuple):
    """Displacement that a contact was solved with, and that its traction then causes [m]."""

    assumed: Map
    caused: Map


class Frictional(NamedTuple):
    """A solved contact, and its friction if the scene couples them."""

    solution: Solution
    friction: Friction | None


def solve_bounded(
    plan: ContactPlan, target: Target, bound: Map | float | None, counter: WorkCounter
) -> Frictional:
    """Solve one contact under a given bound; with friction coupling, iterate until it agrees."""
    begun = time.perf_counter()
    if plan.coupling is None:
        solution = _once(plan, target, bound, plan.heights, counter, plan.accuracy.rtol)
        solved = Frictional(solution, None)
    else:
        solved = _coupled(plan, target, bound, counter, plan.coupling)
    counter.clock("contact", begun)
    return solved


def _coupled(
    plan: ContactPlan,
    target: Target,
    bound: Map | float | None,
    counter: WorkCounter,
    caused_by: Callable[[Map], Map],
) -> Frictional:
    """Repeat the contact with the displacement of its own traction until it no longer changes.

    A contact is solved no better than its displacement is expected to agree, and to the tolerance
    of the plan once that is expected to be the last time. `_extrapolated` accelerates.
    """
    accuracy = plan.accuracy
    rtol = max(accuracy.rtol, _WITHOUT)
    solution = _once(plan, target, bound, plan.heights, counter, rtol)
    without = solution.pressure
    displacement: Map = np.zeros(plan.grid.shape)
    contraction, last, before = _CONTRACTION, math.inf, None
    for i in range(_MAX_ITERATIONS):
        caused = caused_by(solution.pressure)
        scale = max(float(np.ptp(solution.displacement)), np.finfo(float).tiny)
        change = float(np.abs(caused - displacement).max()) / scale
        is_settled = change <= accuracy.outer_rtol and rtol <= accuracy.rtol
        if is_settled or not solution.converged:
            return Frictional(solution, Friction(caused, without))
        if math.isfinite(last) and last > 0.0:
            contraction = min(max(change / last, _FASTEST), 1.0)
        expected, last = contraction * change, change
        is_last = expected <= accuracy.outer_rtol or i == _MAX_ITERATIONS - 1
        rtol = accuracy.rtol if is_last else max(accuracy.rtol, expected)
        now = _Pass(displacement, caused)
        displacement, before = _extrapolated(now, before), now
        again = target._replace(start=solution.pressure)
        solution = _once(plan, again, bound, plan.heights - displacement, counter, rtol)
        if change == 0.0:  # friction that causes nothing
            without = solution.pressure
    problem = (
        f"the friction coupling still changes by {change:.2g} of the displacement after "
        f"{_MAX_ITERATIONS} iterations, tolerance {accuracy.outer_rtol:g}; lower "
        "FrictionTraction.coefficient or leave FrictionCoupling out"
    )
    return Frictional(solution, Friction(displacement, without, problem))


def _extrapolated(now: _Pass, before: _Pass | None) -> Map:
    """Displacement at which two passes, were they linear, would agree best (Anderson's method)."""
    if before is None:
        return now.caused
    missed, missed_before = now.caused - now.assumed, before.caused - before.assumed
    turned = (missed - missed_before).ravel()
    square = float(turned @ turned)
    share = float(turned @ missed.ravel()) / square if square > 0.0 else 0.0
    return now.caused - share * (now.caused - before.caused)


def _once(
    plan: ContactPlan,
    target: Target,
    bound: Map | float | None,
    heights: Map,
    counter: WorkCounter,
    rtol: float,
) -> Solution:
    accuracy = plan.accuracy
    solution = plan.prepared.solver.solve(
        plan.prepared.open(heights),
        mean_pressure=target.mean_pressure,
        rigid_approach=target.rigid_approach,
        bound=bound,
        rtol=rtol,
        start=target.start,
        max_iterations=accuracy.max_iterations,
        method=accuracy.method,
    )
    counter.add(solution)
    return solution
