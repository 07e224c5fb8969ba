"""Contact whose hardness agrees with the displacement it leads to: outer iterations."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from ..errors import InfeasibleError
from .effects.base import (
    BoundedContact,
    Contact,
    FixedHardness,
    FrictionalContact,
    VaryingHardness,
)
from .friction_loop import Friction, Target, solve_bounded
from .plan import ContactPlan
from .solver.contact_solver import Solution
from .work import WorkCounter

if TYPE_CHECKING:
    from numpy.typing import NDArray

    Map = NDArray[np.float64]

__all__ = ["Solved", "contact_of", "solve_with_hardness"]

_MAX_ITERATIONS = 60


class Solved(NamedTuple):
    """A contact with its hardness; `problem` says what did not converge, if anything."""

    solution: Solution
    hardness: Map | float | None
    friction: Friction | None
    problem: str = ""


def contact_of(plan: ContactPlan, solved: Solved) -> Contact:
    """Show a solved contact to the effects."""
    solution, friction = solved.solution, solved.friction
    displacement = solution.displacement
    frictional, bounded = None, None
    if friction is not None:
        displacement = displacement + friction.displacement
        frictional = FrictionalContact(friction.displacement, friction.pressure_without)
    gap = displacement - plan.heights
    gap -= solution.rigid_approach
    if solved.hardness is not None:
        bounded = BoundedContact(solved.hardness, np.maximum(-gap, 0.0))
    np.maximum(gap, 0.0, out=gap)
    return Contact(
        plan.scene,
        plan.grid,
        solution.pressure,
        displacement,
        gap,
        plan.accuracy.threads,
        bounded,
        frictional,
        plan.liquid,
    )


def solve_with_hardness(plan: ContactPlan, target: Target, counter: WorkCounter) -> Solved:
    """Solve a contact whose hardness, if it has one, agrees with its displacement.

    Raises
    ------
    InfeasibleError
        If the load exceeds what the hardness at the displacement reached can carry.
    """
    law = plan.hardness
    if law is None:
        return _solved(plan, target, None, counter)
    if isinstance(law, FixedHardness):
        return _solved(plan, target, law.value, counter)
    iterate = _local if law.is_local else _bracketed
    return iterate(plan, target, counter, law)


def _solved(
    plan: ContactPlan, target: Target, hardness: Map | float | None, counter: WorkCounter
) -> Solved:
    solution, friction = solve_bounded(plan, target, hardness, counter)
    return Solved(solution, hardness, friction, _problem(plan, solution, friction))


def _problem(plan: ContactPlan, solution: Solution, friction: Friction | None) -> str:
    """What did not converge, and the cure; empty if all did."""
    if solution.converged:
        return friction.problem if friction is not None else ""
    if solution.is_stalled:
        cure = "round-off keeps it from falling further; raise Accuracy.rtol"
    elif plan.accuracy.method == "active-set":
        cure = (
            "raise Accuracy.rtol, start from the result of a lower load, or use "
            "method='conjugate-gradient', which converges slowly but surely"
        )
    else:
        cure = "raise Accuracy.max_iterations or rtol, or use method='active-set'"
    return (
        f"the contact conditions are violated by {solution.kkt:.2g} of the rms height, tolerance "
        f"{plan.accuracy.rtol:g}, after {solution.n_applications} operator applications; {cure}"
    )


def _at_largest_displacement(plan: ContactPlan, solution: Solution, law: VaryingHardness) -> float:
    """Hardness [Pa] at the largest displacement of each body under contact."""
    touching = solution.pressure > 0.0
    bodies = plan.prepared.displacements(solution.pressure, solution.displacement)
    largest = tuple(np.asarray(u[touching].max(initial=0.0)) for u in bodies)
    return float(law.at(largest))


def _bracketed(
    plan: ContactPlan, target: Target, counter: WorkCounter, law: VaryingHardness
) -> Solved:
    """One hardness for all: fixed-point iterations inside a bracket, so that they cannot cycle.

    Where the law gives more hardness than was assumed the root lies above, else below. A bracket
    that closes on no root of a law that jumps is a jump, and is reported as one.
    """
    tolerance = plan.accuracy.outer_rtol
    low, high = law.lowest, law.highest
    if target.mean_pressure is not None:
        low = max(low, target.mean_pressure * (1.0 + 1e-9))
    is_low_tried = False
    guess = target.hardness
    trial = guess if guess is not None and low < guess < high else high
    for _ in range(_MAX_ITERATIONS):
        solved = _solved(plan, target, trial, counter)
        found = _at_largest_displacement(plan, solved.solution, law)
        if abs(found - trial) <= tolerance * trial or solved.problem:
            return solved
        target = target._replace(start=solved.solution.pressure)
        if found > trial:
            low, is_low_tried = trial, True
        else:
            high = trial
        if high - low <= tolerance * high:
            if target.mean_pressure is not None and found < target.mean_pressure:
                raise _too_soft(plan, target.mean_pressure, found)
            return solved._replace(problem=_jump(low, high, found)) if law.has_jumps else solved
        is_inside = low < found < high or (found == low and not is_low_tried)
        trial = found if is_inside else 0.5 * (low + high)
    return solved._replace(
        problem=f"the hardness is known to {high / low - 1.0:.2g} only after {_MAX_ITERATIONS} "
        "iterations; use a larger Accuracy.rtol"
    )


def _too_soft(plan: ContactPlan, load: float, hardness: float) -> InfeasibleError:
    area = plan.grid.area
    return InfeasibleError(
        f"load {load * area:.6g} N exceeds H*A = {hardness * area:.6g} N: at the displacement this "
        f"load causes the effective hardness has fallen to {hardness:.6g} Pa; lower the load"
    )


def _jump(low: float, high: float, found: float) -> str:
    return (
        f"the hardness rule jumps: no hardness between {low:.6g} and {high:.6g} Pa agrees with "
        f"the displacement it leads to (which gives {found:.6g} Pa); use "
        "HardnessLimit(rule='continuous'), or another load"
    )


def _local(plan: ContactPlan, target: Target, counter: WorkCounter, law: VaryingHardness) -> Solved:
    """A hardness for each pixel: fixed-point iterations, damped where they do not contract."""
    hardness: Map = np.full(plan.grid.shape, law.highest)
    damping, last, least = 1.0, np.inf, np.inf
    for _ in range(_MAX_ITERATIONS):
        solved = _solved(plan, target, hardness, counter)
        solution = solved.solution
        bodies = plan.prepared.displacements(solution.pressure, solution.displacement)
        found = np.asarray(law.at(tuple(np.maximum(u, 0.0) for u in bodies)))
        change = float(np.abs(found / hardness - 1.0)[solution.pressure > 0.0].max(initial=0.0))
        if change <= plan.accuracy.outer_rtol or solved.problem:
            return solved
        if target.mean_pressure is not None and found.mean() < target.mean_pressure:
            raise _too_soft(plan, target.mean_pressure, float(found.mean()))
        if change < least:
            best, least = solved, change
        damping = max(0.5 * damping, 0.05) if change > 0.9 * last else damping
        last = change
        hardness = hardness + damping * (found - hardness)
        target = target._replace(start=np.minimum(solution.pressure, hardness))
    return best._replace(
        problem=f"the local hardness still changes by {least:.2g} after {_MAX_ITERATIONS} "
        "iterations; use HardnessLimit(displacement='largest')"
    )
