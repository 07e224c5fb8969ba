"""The outer iterations of a contact: hardness that depends on displacement, load on the film."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from ..errors import InfeasibleError
from .effects.base import Cap, Contact
from .engine import Counts, Engine, Friction, Target, cap_of
from .plan import ContactPlan
from .solver.contact_solver import Solution

if TYPE_CHECKING:
    from numpy.typing import NDArray

    Map = NDArray[np.float64]

__all__ = ["Solved", "contact_of", "solve_capped"]

_MOST_ROUNDS = 60


class Solved(NamedTuple):
    """A contact with its hardness; `problem` says what did not converge, if anything."""

    solution: Solution
    hardness: Map | float | None
    friction: Friction | None
    problem: str = ""


def contact_of(plan: ContactPlan, engine: Engine, solved: Solved) -> Contact:
    """Show a solved contact to the effects."""
    solution = solved.solution
    displacement = solution.displacement
    if solved.friction is not None:
        displacement = displacement + solved.friction.displacement
    gap = displacement - engine.heights - solution.rigid_approach
    np.maximum(gap, 0.0, out=gap)
    return Contact(
        plan.scene, plan.grid, solution.pressure, displacement, gap, plan.accuracy.threads
    )


def solve_capped(plan: ContactPlan, engine: Engine, target: Target, counts: Counts) -> Solved:
    """Solve a contact whose hardness, if it has one, agrees with its displacement.

    Raises
    ------
    InfeasibleError
        If the load exceeds what the hardness at the displacement reached can carry.
    """
    cap = cap_of(plan)
    if cap is None or cap.at is None:
        hardness: Map | float | None = None
        if cap is not None:
            hardness = cap.given if cap.given is not None else cap.most
        solution, friction = engine.solve(plan, target, hardness, counts)
        return Solved(solution, hardness, friction, _problem(plan, solution, friction))
    rounds = _local if cap.is_local else _bracketed
    return rounds(plan, engine, target, counts, cap)


def _problem(plan: ContactPlan, solution: Solution, friction: Friction | None) -> str:
    """What did not converge, and the cure; empty if all did."""
    if solution.converged:
        return friction.problem if friction is not None else ""
    cure = "raise Accuracy.max_iterations or rtol"
    if solution.is_stalled:
        cure = "round-off keeps it from falling further; raise Accuracy.rtol"
    if plan.accuracy.method != "active-set":
        cure += ", or use method='active-set'"
    return (
        f"the contact conditions are violated by {solution.kkt:.2g} of the rms height, tolerance "
        f"{plan.accuracy.rtol:g}, after {solution.n_applications} operator applications; {cure}"
    )


def _deepest(engine: Engine, solution: Solution, cap: Cap) -> float:
    """Hardness [Pa] at the largest displacement of each body under contact."""
    touching = solution.pressure > 0.0
    bodies = engine.displacements(solution.pressure, solution.displacement)
    largest = tuple(np.asarray(u[touching].max(initial=0.0)) for u in bodies)
    assert cap.at is not None
    return float(cap.at(largest))


def _bracketed(
    plan: ContactPlan, engine: Engine, target: Target, counts: Counts, cap: Cap
) -> Solved:
    """One hardness for all: fixed-point steps inside a bracket, so that they cannot cycle.

    Where the rule asks for more hardness than was given the root lies above, else below. A
    bracket that closes on no root of a rule that jumps is a jump, and is said to be one.
    """
    tolerance = plan.accuracy.outer_rtol
    low, high = cap.least, cap.most
    if target.mean_pressure is not None:
        low = max(low, target.mean_pressure * (1.0 + 1e-9))
    is_low_tried = False
    guess = target.hardness
    trial = guess if guess is not None and low < guess < high else high
    for _ in range(_MOST_ROUNDS):
        solution, friction = engine.solve(plan, target, trial, counts)
        solved = Solved(solution, trial, friction, _problem(plan, solution, friction))
        asked = _deepest(engine, solution, cap)
        if abs(asked - trial) <= tolerance * trial or solved.problem:
            return solved
        target = target._replace(start=solution.pressure)
        if asked > trial:
            low, is_low_tried = trial, True
        else:
            high = trial
        if high - low <= tolerance * high:
            if target.mean_pressure is not None and asked < target.mean_pressure:
                raise _too_soft(plan, target.mean_pressure, asked)
            return solved._replace(problem=_jump(low, high, asked)) if cap.has_jumps else solved
        is_inside = low < asked < high or (asked == low and not is_low_tried)
        trial = asked if is_inside else 0.5 * (low + high)
    return solved._replace(
        problem=f"the hardness is known to {high / low - 1.0:.2g} only after {_MOST_ROUNDS} "
        "rounds; use a larger Accuracy.rtol"
    )


def _too_soft(plan: ContactPlan, load: float, hardness: float) -> InfeasibleError:
    area = plan.grid.area
    return InfeasibleError(
        f"load {load * area:.6g} N exceeds H*A = {hardness * area:.6g} N: at the displacement this "
        f"load causes the effective hardness has fallen to {hardness:.6g} Pa; lower the load"
    )


def _jump(low: float, high: float, asked: float) -> str:
    return (
        f"the hardness rule jumps: no hardness between {low:.6g} and {high:.6g} Pa agrees with "
        f"the displacement it leads to (which asks for {asked:.6g} Pa); use "
        "HardnessLimit(rule='continuous'), or another load"
    )


def _local(plan: ContactPlan, engine: Engine, target: Target, counts: Counts, cap: Cap) -> Solved:
    """A hardness for each pixel: damped fixed-point steps, given up when they do not contract."""
    assert cap.at is not None
    hardness: Any = np.full(plan.grid.shape, cap.most)
    damping, last, least = 1.0, np.inf, np.inf
    for _ in range(_MOST_ROUNDS):
        solution, friction = engine.solve(plan, target, hardness, counts)
        solved = Solved(solution, hardness, friction, _problem(plan, solution, friction))
        bodies = engine.displacements(solution.pressure, solution.displacement)
        asked = np.asarray(cap.at(tuple(np.maximum(u, 0.0) for u in bodies)))
        change = float(np.abs(asked / hardness - 1.0)[solution.pressure > 0.0].max(initial=0.0))
        if change <= plan.accuracy.outer_rtol or solved.problem:
            return solved
        if target.mean_pressure is not None and asked.mean() < target.mean_pressure:
            raise _too_soft(plan, target.mean_pressure, float(asked.mean()))
        if change < least:
            best, least = solved, change
        damping = max(0.5 * damping, 0.05) if change > 0.9 * last else damping
        last = change
        hardness = hardness + damping * (asked - hardness)
        target = target._replace(start=np.minimum(solution.pressure, hardness))
    return best._replace(
        problem=f"the local hardness still changes by {least:.2g} after {_MOST_ROUNDS} iterations; "
        "use HardnessLimit(displacement='largest')"
    )
