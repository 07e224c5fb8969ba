"""The time step: a mass, pulled, held back by a film and a spring.

`advance` is the only step of time in contactkit. `separation.simulate` loops over it and the
FMU calls it once per communication step; the state is one plain tuple of numbers.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any

from ...errors import ConvergenceError, DescriptionError
from ..film import impulse_name
from ..integrator.dense_output import highest, travel_integral
from ..integrator.radau import WEIGHTS, Step
from ..integrator.radau_short import Short
from ..plan import Film, Plan
from .events import SAME, first_mark, happen
from .smooth import NO_FORCE, is_spent, smooth_once
from .state import Drive, MotionState, Pull
from .step_problem import StepProblem, first_step, step_problem

__all__ = ["advance", "rest_once", "step_once"]

_SAFETY, _SHRINK, _GROW = 0.9, 0.1, 8.0
_PLACES = {name: place for place, name in enumerate(MotionState._fields)}
_NOTHING = 1e-13  # a gap [m] a thousand times smaller than an atom means nothing any more


def advance(plan: Plan, state: MotionState, pull: Drive, dt: float) -> MotionState:
    """Advance the motion by `dt` [s] under a pull, however stiff the film.

    Parameters
    ----------
    plan : Plan
        Of a scene with an imposed force and a mass.
    state : MotionState
        Where it starts.
    pull : callable
        Pull [N] at a time [s], such as a `Pull`; smooth within the step.
    dt : float
        Length of the step [s]. The internal steps are chosen by their error, so that the result
        does not depend on how a span of time is divided, to the tolerance of the plan.

    Raises
    ------
    DescriptionError
        If `dt` is negative or not finite.
    ConvergenceError
        If no internal step can be found that meets the tolerance; carries the state reached.
    """
    if not (math.isfinite(dt) and dt >= 0.0):
        raise DescriptionError("advance(dt)", dt, "be zero or positive, and finite", unit="s")
    end = state.time + dt
    nothing = 1e-13 * max(abs(end), dt)
    for _ in range(plan.accuracy.max_steps + 1):
        if end - state.time <= nothing:
            return state if state.time == end else state._replace(time=end)
        one = rest_once if state.held else step_once
        state = one(plan, state, pull, end)
    cure = "loosen Accuracy.time_rtol or raise Accuracy.max_steps"
    if state.n_releases and plan.scene.opening.stiffness > 0.0:  # some hundred steps for a swing
        cure = (
            f"it was released at {state.release_time:g} s and swings on its spring since then, "
            f"through the film each time: end there, or {cure}"
        )
    raise ConvergenceError(
        f"{plan.accuracy.max_steps} internal steps led from {end - dt:g} s to {state.time:g} s, "
        f"not to {end:g} s; {cure}",
        state,
    )


def rest_once(plan: Plan, state: MotionState, pull: Drive, end: float) -> MotionState:
    """Rest on the asperities until the pull exceeds what holds the bodies together."""
    opening = plan.scene.opening
    holding = opening.stiffness * (state.gap - opening.initial_gap)
    acting = plan.film_left(state.share, broken=state.broken, detached=state.detached)
    film = acting.forces(state.gap, 0.0)[0] if acting is not None else 0.0
    leave, low = end, state.time
    if pull(low) - holding - film > 0.0:
        leave = low
    elif pull(end) - holding - film > 0.0:
        while leave - low > 1e-15 * abs(leave) and low < (middle := 0.5 * (low + leave)) < leave:
            if pull(middle) - holding - film > 0.0:
                leave = middle
            else:
                low = middle
    elapsed, names = leave - state.time, acting.static_columns if acting is not None else ()
    forces = dict.fromkeys(names, film)
    if acting is not None and len(names) > 1:
        forces = acting.static_forces(state.gap)
    found: list[Any] = list(state)  # a master asks often, and `_replace` takes its time
    found[_PLACES["time"]], found[_PLACES["step"]] = leave, 0.0
    found[_PLACES["held"]] = pull(leave) - holding - film <= 0.0
    for name, force in forces.items():
        place = _PLACES.get(impulse_name(name))
        if place is not None:
            found[place] += elapsed * force
    return tuple.__new__(MotionState, found)


def _grown(state: MotionState, length: float, means: dict[str, float]) -> dict[str, Any]:
    """Impulses of the state after a time [s] in which forces had these means [N]."""
    return {
        name: getattr(state, name) + length * mean
        for name, mean in means.items()
        if name in state._fields
    }


def step_once(plan: Plan, state: MotionState, pull: Drive, end: float) -> MotionState:
    """Take one internal step, shortened to the first event inside it."""
    if type(pull) is Pull:
        after = smooth_once(plan, state, pull, end)
        if after is not None:
            return after
    if state.gap < _NOTHING:
        raise _no_step(state, plan.accuracy.time_rtol)
    rest = plan.scene.opening.rest_gap
    if state.speed < 0.0 and state.gap <= rest * (1.0 + SAME):
        return state._replace(held=True, gap=rest, speed=0.0)
    film = plan.film_left(state.share, broken=state.broken, detached=state.detached)
    problem = _posed(plan, film, state, pull, end)
    if problem is None:
        return state._replace(speed=0.0)
    left = end - state.time
    length = min(state.step or first_step(problem, left), left)
    rejected, evaluations = 0, 3
    while True:
        short = problem.attempt_short(length)
        taken = short.step if short is not None else problem.attempt(length)
        error = math.inf
        if taken is not None:
            evaluations += taken.evaluations
            error = _judge(plan, film, state, problem, taken, length)
            if error <= 1.0:
                break
        rejected += 1
        length *= 0.25 if math.isinf(error) else max(_SHRINK, _SAFETY * error**-0.25)
        if length < 1e-15 * max(abs(state.time), 1e-15) or rejected > 60:
            raise _no_step(state, problem.rtol)
    following = length * min(_GROW, _SAFETY * max(error, 1e-12) ** -0.25)
    if not rejected and length < state.step:  # cut short by the end of the span only
        following = max(following, state.step)
    mark = first_mark(plan, film, state, taken.stages[2].gap)
    if mark is not None:
        taken, length = _locate(problem, length, mark, taken)
        short = None
    changes: dict[str, Any] = {
        "given_impulse": state.given_impulse + length * problem.size,
        "step": following,
        "n_steps": state.n_steps + 1,
        "n_rejected": state.n_rejected + rejected,
        "n_evaluations": state.n_evaluations + evaluations,
    }
    if film is not None:
        changes |= _passed(state, film, problem, taken, length, short)
    _, gap, speed = taken.stages[2]
    time = end if length == left else state.time + length
    state = state._replace(time=time, gap=gap, speed=speed, **changes)
    return state if mark is None else happen(plan, film, state, mark)


def _posed(
    plan: Plan, film: Film | None, state: MotionState, pull: Drive, end: float
) -> StepProblem | None:
    """Pose the step; None where nothing acts any more and the film has brought it to rest."""
    problem = step_problem(plan, film, state, pull)
    if problem.size > NO_FORCE:
        return problem
    if is_spent(problem.mass, state.speed, -problem.at_start[2], state.gap):
        return None
    return problem.expecting(0.5 * abs(pull(end)))  # the mean of a ramp


def _no_step(state: MotionState, rtol: float) -> ConvergenceError:
    """Error for a state from which no step meets the tolerance."""
    cure = f"loosen Accuracy.time_rtol = {rtol:g}"
    if state.gap < 10.0 * _NOTHING:
        cure = "the bodies are pressed together; give Opening.rest_gap [m], where asperities carry"
    where = f"{state.time:g} s, gap {state.gap:g} m, speed {state.speed:g} m/s"
    return ConvergenceError(f"no step of time can be taken from {where}; {cure}", state)


def _judge(
    plan: Plan,
    film: Film | None,
    state: MotionState,
    problem: StepProblem,
    taken: Step,
    length: float,
) -> float:
    """Error of a step over its tolerance, with what the estimate inside the step cannot see."""
    error = problem.error(taken, length)
    if error > 1.0:
        return error
    end, rest = taken.stages[2], plan.scene.opening.rest_gap
    if end.gap < rest * (1.0 - SAME) and state.gap <= rest * (1.0 + SAME):
        return 16.0  # a hop that begins and ends at the rest gap: cut it, there is no crossing
    if film is None or not film.limits:
        return error
    # Where a limit sets in or lets go, the slope of the force jumps: compare with two half steps.
    points = (problem.begin, *taken.stages)
    if len({film.viscous_force(point.gap, point.speed)[1] for point in points}) == 1:
        return error
    half = problem.attempt(0.5 * length)
    if half is None:
        return 16.0
    middle = half.stages[2]
    there = state._replace(time=middle.time, gap=middle.gap, speed=middle.speed)
    rest_of_it = step_problem(plan, film, there, problem.holding.pull).attempt(0.5 * length)
    if rest_of_it is None:
        return 16.0
    again = rest_of_it.stages[2]
    gap_error, speed_error = abs(math.log(again.gap / end.gap)), abs(again.speed - end.speed)
    seen = taken._replace(gap_error=gap_error, speed_error=speed_error)
    return max(error, problem.error(seen, length))


def _locate(problem: StepProblem, length: float, mark: float, taken: Step) -> tuple[Step, float]:
    """Step that ends at a gap: Newton on its length, kept inside the bracket."""
    low, high = 0.0, length
    rising = mark > problem.begin.gap
    for _ in range(60):
        end = taken.stages[2]
        miss = end.gap - mark
        if abs(miss) <= 1e-13 * mark or high - low <= 1e-15 * high:
            break
        if (miss > 0.0) == rising:
            high = length
        else:
            low = length
        guess = length - miss / end.speed if end.speed else math.nan
        length = guess if low < guess < high else 0.5 * (low + high)
        again = problem.attempt(length)
        if again is None:
            break
        taken = again
    return taken, length


def _passed(
    state: MotionState,
    film: Film,
    problem: StepProblem,
    taken: Step,
    length: float,
    short: Short | None,
) -> dict[str, Any]:
    """Impulses, work and peak after a step, by the quadrature of the method itself."""
    gaps = [stage.gap for stage in taken.stages]
    static: Sequence[float]
    forces: Sequence[float]
    if short is not None:
        static, forces = short.static, short.viscous
    else:
        static = [film.static_force(gap) for gap in gaps]
        forces = [film.viscous_force(stage.gap, stage.speed)[0] for stage in taken.stages]
    first = problem.viscous
    work = short.work if short is not None else None
    # A stiff film that came up to its force at once, in a transient the step strode over.
    sprang = forces[0] - first > 0.9 * (max(first, *forces) - min(first, *forces))
    if work is None or sprang:
        work = travel_integral(problem.begin, taken, first, forces)
    viscous = sum(w * f for w, f in zip(WEIGHTS, forces, strict=True))
    found = {
        "viscous_impulse": state.viscous_impulse + length * viscous,
        "dissipated_work": state.dissipated_work + work,
    }
    found |= _grown(state, length, film.static_means(gaps, WEIGHTS, static))
    first += problem.static
    totals = [a + b for a, b in zip(static, forces, strict=True)]
    top = max(first, *totals)
    most = top + 0.25 * (top - min(first, *totals))  # that `highest` makes of it
    if top > 0.99 * state.peak_force and most > state.peak_force:
        value, where = highest(first, totals)
        if value > state.peak_force:
            found |= {"peak_force": value, "peak_time": state.time + where * length}
    return found
