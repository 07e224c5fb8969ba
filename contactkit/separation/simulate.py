"""Run of a plan: the curve of a speed, the impulse of a time, or the motion under a pull."""

from __future__ import annotations

import math
import time as clock
from collections.abc import Callable
from typing import overload

from ..errors import ConvergenceError, InfeasibleError, PlanError
from ..scene.loading import ImposedForce, ImposedSpeed, ImposedTime
from ..scene.plan import check_plan
from ..scene.validity import warn
from ..units import quantity_text
from .curve_result import Work
from .effects.registry import ViscousForce
from .first_closing import closed_first
from .motion.advance import advance, internal_step
from .motion.state import MotionState, acting_film, outputs, start
from .motion_curves import at_steps, motion_curves, pull_law
from .plan import Plan
from .prescribed import at_speed, newtonian_impulses, within_time
from .results import SeparationResult
from .sliding.plan import SlidingPlan
from .sliding.result import SlidingResult
from .sliding.run import slide
from .validity import check
from .vibration import vibrating

__all__ = ["advance", "simulate"]

Progress = Callable[[float], None]
"""Called now and then with the fraction of the run that is done, 0 to 1."""


@overload
def simulate(
    plan: Plan, *, throw: bool = True, progress: Progress | None = None
) -> SeparationResult: ...


@overload
def simulate(
    plan: SlidingPlan, *, throw: bool = True, progress: Progress | None = None
) -> SlidingResult: ...


def simulate(
    plan: Plan | SlidingPlan, *, throw: bool = True, progress: Progress | None = None
) -> SeparationResult | SlidingResult:
    """Run a plan.

    Parameters
    ----------
    plan : Plan or SlidingPlan
        What to run.
    throw : bool
        Raise where an integration does not reach its tolerance, or where a force pushes a mass that
        does not open; otherwise return what was reached, with status ``not converged`` or
        ``stuck``.
    progress : callable, optional
        Called with the fraction that is done.

    Returns
    -------
    SeparationResult or SlidingResult
        Curves, numbers, validity and cost.

    Raises
    ------
    ConvergenceError
        If no step of time meets the tolerance; carries the result so far.
    InfeasibleError
        If the force is negative, so that it never opens the gap.
    """
    check_plan(plan, (Plan, SlidingPlan))
    begun = clock.perf_counter()
    if isinstance(plan, SlidingPlan):
        slid = slide(plan, begun)
        warn(slid.validity)
        return slid
    loading = plan.scene.loading
    if isinstance(loading, ImposedForce):
        result = _motion(plan, begun, throw, progress)
    elif isinstance(loading, ImposedSpeed):
        vibration = loading.vibration
        if vibration is None:
            result = at_speed(plan, loading, begun)
        else:
            result = vibrating(plan, loading, vibration, begun)
    elif isinstance(loading, ImposedTime):
        result = within_time(plan, loading, begun)
    else:
        raise PlanError(f"no separation of a {type(loading).__name__} is known")
    warn(result.validity)
    return result


def _motion(plan: Plan, begun: float, throw: bool, progress: Progress | None) -> SeparationResult:
    """Motion of a mass under a pull, one internal step at a time, to its release."""
    loading = plan.scene.imposed_force
    if throw and loading.force < 0.0 and loading.initial_speed <= 0.0:
        raise InfeasibleError(
            f"loading.force is {loading.force:g} N and never opens the gap: a force that opens is "
            f"positive, force = {-loading.force:g} N"
        )
    pull = pull_law(plan)
    states = [start(plan)]
    problem = None
    while states[-1].n_releases == 0 and states[-1].time < loading.time_limit:
        if len(states) > plan.accuracy.max_steps:
            problem = (
                f"not released after {plan.accuracy.max_steps} steps; raise Accuracy.max_steps"
            )
            break
        if _is_stuck(plan, states, pull):
            break
        try:
            states.append(_one_step(plan, states[-1], pull))
        except ConvergenceError as error:
            problem = str(error)
            break
        if progress is not None and len(states) % 64 == 0:
            progress(_progress(plan, states[-1]))
    result = _motion_result(plan, states, pull, begun, problem)
    if problem is not None and throw:
        raise ConvergenceError(problem, result)
    return result


def _one_step(plan: Plan, state: MotionState, pull: Callable[[float], float]) -> MotionState:
    """Advance by one internal step, or to the next event."""
    return internal_step(plan, state, pull, plan.scene.imposed_force.time_limit)


def _progress(plan: Plan, state: MotionState) -> float:
    loading = plan.scene.imposed_force
    opened = math.log(max(state.gap / loading.initial_gap, 1.0))
    return min(opened / math.log(loading.final_gap / loading.initial_gap), 1.0)


def _is_stuck(plan: Plan, states: list[MotionState], pull: Callable[[float], float]) -> bool:
    """Whether the pull, once risen, can never open the gap from here."""
    state, loading = states[-1], plan.scene.imposed_force
    film = acting_film(plan, state)
    if film is None or len(states) < 2:
        return False
    if loading.rise_time and state.time < 40.0 * loading.rise_time:
        return False
    held = film.static_force(state.gap) + loading.stiffness * (state.gap - loading.initial_gap)
    return pull(state.time) <= held and state.speed <= 0.0 and state.gap <= loading.initial_gap


def _motion_result(
    plan: Plan,
    states: list[MotionState],
    pull: Callable[[float], float],
    begun: float,
    problem: str | None,
) -> SeparationResult:
    last = states[-1]
    impulses = dict(last.impulses)
    if plan.has(ViscousForce):
        impulses = newtonian_impulses(plan) | impulses
    status, message = _outcome(plan, last, pull(last.time), problem)
    message += _rupture(states)
    if problem is None:
        message += closed_first(
            plan.scene.imposed_force, (state.gap for state in states), plan.film
        )
    work = Work(last.n_steps, last.n_rejected, last.n_evaluations, clock.perf_counter() - begun)
    along, force = at_steps(plan, states, pull)
    validity = check(plan, along)
    # The motion knows its peak between the steps too.
    extremes = {"peak_repulsion": max(-float(force.min()), 0.0)}
    curves = motion_curves(plan, states)
    return SeparationResult(plan, status, message, curves, impulses, last, validity, work, extremes)


def _outcome(plan: Plan, last: MotionState, pull: float, problem: str | None) -> tuple[str, str]:
    """Status of a motion, and the same as a sentence with its cure."""
    limit = plan.scene.imposed_force.time_limit
    if last.n_releases:
        speed = f" at {last.release_speed:.4g} m/s"
        if plan.scene.imposed_force.mass is None:
            speed = ", at no speed of its own: give loading.mass [kg] for one"
        return "released", f"released after {last.release_time:.6g} s{speed}"
    if problem is not None:
        return "not converged", problem
    if last.time >= limit:
        return (
            "time limit",
            f"not released within loading.time_limit = {limit:g} s; gap {last.gap:g} m",
        )
    held = outputs(plan, last, pull).static
    what = " and ".join(column.label for column in plan.film.static_columns)
    return (
        "stuck",
        f"stuck: the pull of {pull:.4g} N does not exceed the {held:.4g} N of the "
        f"{what} at {last.gap:g} m; pull harder, or start from a larger gap",
    )


def _rupture(states: list[MotionState]) -> str:
    """Say when and at which gap the film broke; empty if it did not."""
    first = next((state for state in states if state.n_breaks), None)
    if first is None:
        return ""
    return f"; the film broke at {quantity_text(first.gap, 'm')}, after {first.break_time:.6g} s"
