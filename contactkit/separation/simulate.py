"""Run of a plan: the curve of a speed, the impulse of a time, or the motion under a pull."""

from __future__ import annotations

import math
import time as clock
from collections.abc import Callable, Sequence
from typing import TYPE_CHECKING, overload

from ..errors import ConvergenceError, InfeasibleError, PlanError
from ..scene.loading import ImposedForce, ImposedSpeed, ImposedTime
from ..scene.plan import ScenePlan, check_plan
from ..units import quantity_text
from ..validity import warn
from .curve_result import Work
from .first_closing import closed_first
from .motion.advance import advance, internal_step
from .motion.state import MotionState, acting_film, outputs, start
from .motion_curves import at_steps, before_events, motion_curves, pull_law
from .plan import Plan
from .prescribed import at_speed, impulses_of_gaps, within_time
from .results import SeparationResult
from .sliding.plan import SlidingPlan
from .sliding.result import SlidingResult
from .sliding.run import slide
from .validity import check
from .vibration.run import vibrating

if TYPE_CHECKING:
    from .deforming.plan import DeformingPlan
    from .deforming.result import DeformingResult

__all__ = ["advance", "simulate"]

Progress = Callable[[float], None]
"""Called now and then with the fraction of the run that is done, 0 to 1."""


@overload
def simulate(
    plan: Plan, *, throw: bool = True, progress: Progress | None = None
) -> SeparationResult: ...


@overload
def simulate(
    plan: DeformingPlan,
    *,
    throw: bool = True,
    progress: Progress | None = None,
    fields_at: Sequence[float] = (),
) -> DeformingResult: ...


@overload
def simulate(
    plan: SlidingPlan, *, throw: bool = True, progress: Progress | None = None
) -> SlidingResult: ...


def simulate(
    plan: Plan | DeformingPlan | SlidingPlan,
    *,
    throw: bool = True,
    progress: Progress | None = None,
    fields_at: Sequence[float] = (),
) -> SeparationResult | DeformingResult | SlidingResult:
    """Run a plan.

    Parameters
    ----------
    plan : Plan, DeformingPlan or SlidingPlan
        What to run.
    throw : bool
        Raise where an integration does not reach its tolerance, or where a force pushes a mass that
        does not open; otherwise return what was reached, with status ``not converged`` or
        ``stuck``.
    progress : callable, optional
        Called with the fraction that is done.
    fields_at : sequence of float
        Of a `DeformingPlan`, times [s] at which its sections and maps are wanted exactly.

    Returns
    -------
    SeparationResult, DeformingResult or SlidingResult
        Curves, numbers, validity and cost.

    Raises
    ------
    ConvergenceError
        If no step of time meets the tolerance; carries the result so far.
    InfeasibleError
        If the force is negative, so that it never opens the gap.
    """
    if not isinstance(plan, Plan | SlidingPlan) and isinstance(plan, ScenePlan):
        from .deforming.plan import DeformingPlan  # for such a plan alone

        if isinstance(plan, DeformingPlan):
            from .deforming.run import pull_apart

            return pull_apart(plan, fields_at)
    check_plan(plan, (Plan, SlidingPlan))
    if len(fields_at):
        raise PlanError(
            f"simulate.fields_at = {fields_at!r} is read by plans with ElasticBodies alone: leave "
            "it out"
        )
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
            problem = _too_many_steps(plan)
            break
        if _is_stuck(plan, states, pull) or _spring_holds(plan, states, pull):
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


def _too_many_steps(plan: Plan) -> str:
    """Sentence for a motion that takes more steps than allowed."""
    found = f"not released after {plan.accuracy.max_steps} steps; raise Accuracy.max_steps"
    if plan.scene.imposed_force.stiffness > 0.0:
        found += ", or, as the mass may swing on its spring for good, lower loading.time_limit [s]"
    return found


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


def _spring_holds(plan: Plan, states: list[MotionState], pull: Callable[[float], float]) -> bool:
    """Whether a spring keeps the mass from `final_gap` for good: its energy does not reach there.

    Films and contacts only take energy. Left out are what may give some: a pull that still rises,
    forces that push the bodies apart or the way they move, and a film that wets them again in
    between.
    """
    state, loading = states[-1], plan.scene.imposed_force
    k, force = loading.stiffness, loading.force
    if k == 0.0 or len(states) < 2 or abs(force - pull(state.time)) > 1e-9 * abs(force):
        return False
    if _energy_left(plan, state) >= -1e-6 * abs(force) * (loading.final_gap - state.gap):
        return False
    # What comes back with the film gives energy only if it pulls at rest, as a meniscus does.
    returns = (k.needs_film and law.rate != "proportional" for k, law in plan.film.laws.items())
    rewets = plan.scene.meniscus.rewetting > 0.0 and any(returns)
    return not (rewets or _pushes(plan, loading))


def _energy_left(plan: Plan, state: MotionState) -> float:
    """Energy of mass, pull and spring at the final gap if nothing else takes any [J]."""
    loading = plan.scene.imposed_force
    begin, end = (gap - loading.initial_gap for gap in (state.gap, loading.final_gap))
    moving = 0.5 * (loading.mass or 0.0) * state.speed**2
    given = loading.force - 0.5 * loading.stiffness * (begin + end)
    return moving + given * (loading.final_gap - state.gap)


def _pushes(plan: Plan, loading: ImposedForce) -> bool:
    """Whether a force pushes the bodies apart at a gap on the way, or the way they move."""
    gap, film = max(loading.initial_gap, 1e-6 * loading.final_gap), plan.film
    ratio = (loading.final_gap / gap) ** (1.0 / 32.0)
    gaps = [gap * ratio**i for i in range(33)]
    # About the most that the pull gives a mass on this way; without one nothing is moved by itself.
    travel = loading.final_gap - loading.initial_gap
    speed = math.sqrt(abs(loading.force) * travel / loading.mass) if loading.mass else 0.0
    return any(
        film.static_force(place) < 0.0
        or any(film.viscous_force(place, v)[0] * v < 0.0 for v in (speed, -speed))
        for place in gaps
    )


def _motion_result(
    plan: Plan,
    states: list[MotionState],
    pull: Callable[[float], float],
    begun: float,
    problem: str | None,
) -> SeparationResult:
    last = states[-1]
    impulses = _impulses(plan, last)
    status, message = _outcome(plan, last, pull(last.time), problem)
    message += _rupture(states)
    if problem is None:
        message += closed_first(
            plan.scene.imposed_force, (state.gap for state in states), plan.film
        )
    work = Work(last.n_steps, last.n_rejected, last.n_evaluations, clock.perf_counter() - begun)
    shown = [outputs(plan, state, pull(state.time)) for state in states]
    ends = before_events(plan, states, pull)
    along, force = at_steps(
        [*states, *ends], [*shown, *(outputs(plan, state, pull(state.time)) for state in ends)]
    )
    validity = check(plan, along)
    # The motion knows its peak between the steps too.
    extremes = {"peak_repulsion": max(-float(force.min()), 0.0)}
    curves = motion_curves(plan, states, shown)
    return SeparationResult(plan, status, message, curves, impulses, last, validity, work, extremes)


def _impulses(plan: Plan, last: MotionState) -> dict[str, float]:
    """Impulse of each force [N.s], and of a flowing liquid without limits.

    Of a film that loses liquid the latter depends on the way, and is not known where limits act.
    """
    if plan.volume_rate is None:
        return impulses_of_gaps(plan) | dict(last.impulses)
    found = dict(last.impulses)
    for kind in plan.film.laws:
        if kind.newtonian is not None and kind is not plan.film.limited:
            found[kind.newtonian.impulse.name] = found[kind.column.impulse.name]
    return found


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
    loading = plan.scene.imposed_force
    lacking = -_energy_left(plan, last)
    if loading.stiffness > 0.0 and lacking > 0.0 and last.gap > loading.initial_gap:
        most = loading.stiffness * (loading.final_gap - loading.initial_gap)
        balance = loading.initial_gap + loading.force / loading.stiffness
        return (
            "stuck",
            f"stuck: the spring of {loading.stiffness:.4g} N/m balances the pull of "
            f"{loading.force:.4g} N at a gap of {balance:.4g} m, and the mass lacks "
            f"{lacking:.3g} J to reach loading.final_gap = {loading.final_gap:g} m; pull with "
            f"more than stiffness*(final_gap - initial_gap) = {most:.4g} N, or give a softer "
            "spring or a smaller final_gap",
        )
    held = outputs(plan, last, pull).static
    film = acting_film(plan, last)
    acting = film.static_forces(last.gap) if film is not None else {}
    columns = plan.film.static_columns
    what = " and ".join(c.label for c in columns if acting.get(c.name) or len(columns) == 1)
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
