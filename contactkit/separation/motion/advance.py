"""The motion of a mass, pulled, that a film, solids and a spring hold back.

`advance` is the only step of time in contactkit: the FMU calls it once per communication step,
and `separation.simulate` takes its internal steps one by one.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import NamedTuple

from ...errors import ConvergenceError, DescriptionError
from ...numerics.events import EventStep, step_to_event
from ...numerics.radau_tableau import NODES, WEIGHTS
from ...numerics.roots import first_true
from ...numerics.step_size import StepSize
from ..cavity.state import FULL, Phase
from ..integrator.dense_output import peak, work
from ..integrator.radau import (
    Forces,
    MotionPoint,
    Step,
    StepProblem,
    against_halves,
    relative_error,
    step,
)
from ..plan import Film, Plan
from .cavity import after, cavity_film, cut_at_event, cut_before_step
from .events import SAME, apply_event, broken, cut_at_rupture, next_event
from .state import MotionState, Pull, PullLaw, acting_film
from .volume import VolumeStages, film_at_end, losing_step

__all__ = ["Traced", "advance", "internal_step", "moving_mass", "step_cost", "traced_step"]

_CONTROL = StepSize(order=4)  # of the estimate
_NO_GAP = 1e-13  # a gap [m] a thousand times smaller than an atom means nothing any more
_FOOT = 1e-6  # sum of the forces over the pull to come, at the foot of a ramp
_NO_FORCE = 1e-290  # sum of the forces [N] below which none acts
_AT_REST = 1e-30  # fraction of the gap over which the film stops a mass at rest
_EVENT = 1e-13  # relative distance of a gap from an event that is met
_CAVITY_COST = 20  # of a step of a cavitated film, over that of a full one
# A film of 1e-14 s has transients of 1e-28 s, and a first step may be the time limit of a run: at
# time 0 nothing but the range of a float bounds a step.
_NO_TIME = 1e-280
_MOST_REJECTED = 300
_TOO_LONG = 16.0  # error of a step that is to be cut in half


def advance(plan: Plan, state: MotionState, pull: PullLaw, dt: float) -> MotionState:
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
        Length of the step [s]. Internal steps are adaptive (error control), so that the result
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
    nothing = 1e-13 * max(abs(end), dt)  # round-off of a sum of some hundred steps
    cost = 0
    while cost <= plan.accuracy.max_steps:
        if end - state.time <= nothing:
            return state if state.time == end else state._replace(time=end)
        before, state = state, internal_step(plan, state, pull, end)
        cost += step_cost(before, state)
    cure = "loosen Accuracy.time_rtol or raise Accuracy.max_steps"
    if (
        state.n_releases and plan.scene.imposed_force.stiffness > 0.0
    ):  # some hundred steps for a swing
        cure = (
            f"it was released at {state.release_time:g} s and swings on its spring since then, "
            f"through the film each time: end there, or {cure}"
        )
    raise ConvergenceError(
        f"{plan.accuracy.max_steps} internal steps led from {end - dt:g} s to {state.time:g} s, "
        f"not to {end:g} s; {cure}",
        state,
    )


def step_cost(before: MotionState, after: MotionState) -> int:
    """Cost of an internal step, in steps of a film that is full."""
    is_whole = before.cavity.phase is Phase.FULL is after.cavity.phase
    return (1 + after.n_rejected - before.n_rejected) * (1 if is_whole else _CAVITY_COST)


def internal_step(plan: Plan, state: MotionState, pull: PullLaw, end: float) -> MotionState:
    """Take one internal step towards the time `end` [s], cut at the first event inside it."""
    return _with_times(state, traced_step(plan, state, pull, end).state)


def _with_times(before: MotionState, state: MotionState) -> MotionState:
    """State with the time at which its film cavitated in a step, or was full again."""
    was, now = before.cavity.phase is Phase.FULL, state.cavity.phase is Phase.FULL
    if was is now:
        return state
    if was:
        return state._replace(inception_time=state.time, n_inceptions=state.n_inceptions + 1)
    if state.broken:  # its cavity went with the film
        return state
    return state._replace(reformation_time=state.time, n_reformations=state.n_reformations + 1)


class Traced(NamedTuple):
    """State after an internal step, and how it was found: what a sensitivity follows.

    Without `taken` nothing was integrated. `event` is the gap [m] that ended the step, if any, and
    `is_last` states that the span ended it.
    """

    state: MotionState
    problem: StepProblem | None = None
    taken: Step | None = None
    length: float = 0.0
    event: float | None = None
    is_last: bool = False


def traced_step(plan: Plan, state: MotionState, pull: PullLaw, end: float) -> Traced:
    """Take one internal step as `internal_step` does, and return how it was found."""
    rest_gap = plan.scene.imposed_force.rest_gap
    if state.in_contact:
        return Traced(_rest(plan, state, pull, end))
    if state.gap < _NO_GAP:
        raise _no_step(state, plan.accuracy.time_rtol)
    if state.speed < 0.0 and state.gap <= rest_gap * (1.0 + SAME):
        return Traced(state._replace(in_contact=True, gap=rest_gap, speed=0.0))
    film = acting_film(plan, state)
    cavity = cut_before_step(film, state.cavity, (state.gap, state.speed))
    if cavity is not None:
        # What a full film allowed says nothing of steps with a cavity: `step` is found anew.
        return Traced(state._replace(cavity=cavity, step=0.0))
    problem = _problem(plan, film, state, pull)
    if problem.size <= _NO_FORCE and _is_at_rest(problem):
        return Traced(state._replace(speed=0.0))
    if problem.size <= max(_NO_FORCE, _FOOT * abs(pull(end))):
        problem = _expecting(problem, 0.5 * abs(pull(end)))  # the mean of a ramp
    return _stepped(plan, film, state, problem, end)


def _rest(plan: Plan, state: MotionState, pull: PullLaw, end: float) -> MotionState:
    """Rest on the asperities until the pull exceeds what holds the bodies together."""
    loading, film = plan.scene.imposed_force, acting_film(plan, state)
    forces = film.static_forces(state.gap) if film is not None else {}
    holding = loading.stiffness * (state.gap - loading.initial_gap) + sum(forces.values())
    leaves = True
    if pull(state.time) > holding:
        end = state.time
    elif pull(end) > holding:
        end = first_true(lambda time: pull(time) > holding, state.time, end)
    else:
        leaves = False
    elapsed = end - state.time
    columns = film.static_columns if film is not None else ()
    grown = {column.impulse.name: elapsed * forces[column.name] for column in columns}
    return state._replace(
        time=end,
        in_contact=not leaves,
        cavity=FULL,  # nothing ruptured at a smaller gap
        step=0.0,
        impulses=_added(state.impulses, grown),
    )


def _added(impulses: Mapping[str, float], more: Mapping[str, float]) -> Mapping[str, float]:
    return {**impulses, **{name: impulses.get(name, 0.0) + more[name] for name in more}}


def _problem(plan: Plan, film: Film | None, state: MotionState, pull: PullLaw) -> StepProblem:
    """Pose the step from a state, with a film or, where nothing is left of it, without one."""
    loading, mass = plan.scene.imposed_force, moving_mass(plan)
    gap, speed, rtol = state.gap, state.speed, plan.accuracy.time_rtol
    cavity = cavity_film(film, state.cavity, (gap, speed))
    losing = losing_step(plan, state)
    remembered = cavity.remembered if cavity is not None else None
    if losing is not None:  # the plan refuses both
        remembered = losing.remembered
    forces = film.forces if film is not None else _no_forces
    forces = forces if cavity is None else cavity.forces
    first = forces(gap, speed)
    spring = loading.stiffness * abs(gap - loading.initial_gap)
    size = abs(pull(state.time)) + abs(first.static) + spring + 1e-300
    crossing = gap / (state.step or 1e-6)
    reference = max(abs(speed), crossing)  # of a damping that follows the speed
    damping = film.damping(gap, reference) if film is not None else 0.0
    return StepProblem(
        mass=mass,
        pull=pull,
        stiffness=loading.stiffness,
        slack_gap=loading.initial_gap,
        forces=forces,
        has_limits=film is not None and not film.is_smooth,
        exponent=film.exponent(gap, reference) if film is not None else 0.0,
        begin=MotionPoint(state.time, gap, speed),
        first=first,
        rtol=rtol if cavity is None else cavity.law.time_rtol(rtol),
        size=size,
        delivered=state.applied_impulse + mass * abs(speed),
        # Where no force acts yet, a film still has a scale: differences of speed count.
        scale=max(size / damping, 1e-15 * crossing) if damping > 0.0 else crossing,
        remembered=remembered,
        taken=sum(
            abs(state.impulses.get(column.impulse.name, 0.0)) for column in plan.film.moving_columns
        ),
    )


def _no_forces(gap: float, speed: float) -> Forces:
    return Forces(0.0, 0.0, 0.0, 0.0, 0.0)


def moving_mass(plan: Plan) -> float:
    """Moving mass [kg]; without one, so little that its momentum is 1e-14 of the impulse given."""
    loading = plan.scene.imposed_force
    if loading.mass is not None:
        return loading.mass
    ends, film = (loading.initial_gap, loading.final_gap), plan.film
    pull = max(abs(loading.force), 1e-300)
    given = film.viscous_impulse(*ends)
    if not film.has_viscous_impulse:
        pull = abs(loading.force) or 1.0  # at rest any mass will do
        given = pull * film.opening_time(*ends, pull)
    return 1e-14 * given * (given / pull) / (loading.final_gap - loading.initial_gap)


def _is_at_rest(problem: StepProblem) -> bool:
    """Whether a moving mass on which no force acts is as good as at rest."""
    reach = problem.first.viscous_by_speed * problem.begin.gap
    return 0.0 < abs(problem.begin.speed) * problem.mass < _AT_REST * reach


def _expecting(problem: StepProblem, force: float) -> StepProblem:
    """Scale the error control by a force [N] before the pull has risen to it.

    At the foot of a ramp nothing acts yet, and a stiff film would be followed through its
    transient, which late in a run is shorter than the time can tell.
    """
    damping = problem.first.viscous_by_speed
    speed = force / damping if damping > 0.0 else 0.0
    return problem._replace(size=problem.size + force, scale=max(problem.scale, speed))


def _stepped(
    plan: Plan, film: Film | None, state: MotionState, problem: StepProblem, end: float
) -> Traced:
    """State after the longest step that meets the tolerance, or the first event inside it."""
    left = end - state.time
    taken, length, error, rejected, evaluations = _accepted(plan, state, problem, left)
    # A step that a span cut short shows no error: it must not make the next one short as well.
    is_cut = not rejected and length < state.step
    following = _CONTROL.following(length, error, state.step if is_cut else 0.0)
    taken, length, event, breaks = _cut(plan, film, state, problem, EventStep(taken, length))
    if length == 0.0:
        return Traced(broken(state))
    turn, cavity = None, state.cavity
    law = film.cavity if film is not None else None
    if law is not None:
        turn = cut_at_event(problem, law, cavity, taken, length)
        if turn is not None:
            (taken, length), event = turn, None
        if length == 0.0:  # the phase changes where the step starts, and no time passes
            return Traced(state._replace(cavity=law.after_event(cavity, state.gap, state.speed)))
        cavity = after(law, cavity, taken, problem.begin.gap)
        if turn is not None:
            cavity = law.after_event(cavity, *taken.stages[2][1:])
    _, gap, speed = taken.stages[2]
    grown = _impulses(film, taken, length)
    highest, when = _peak(state, problem, taken, length)
    state = state._replace(
        time=end if length == left else state.time + length,
        gap=gap,
        speed=speed,
        cavity=cavity,
        volume_fraction=_part_left(state, taken),
        impulses=_added(state.impulses, grown),
        dissipated_work=state.dissipated_work + _work(problem, taken),
        applied_impulse=state.applied_impulse + length * problem.size,
        peak_force=highest,
        peak_time=when,
        step=following if turn is None else 0.0,
        n_steps=state.n_steps + 1,
        n_rejected=state.n_rejected + rejected,
        n_evaluations=state.n_evaluations + evaluations,
    )
    is_last = length == left
    _check(plan, film_at_end(film, taken) if film is not None else None, state)
    if breaks:
        state = broken(state)
    if event is not None:
        state = apply_event(plan, film, state, event)
    return Traced(state, problem, taken, length, event, is_last)


def _check(plan: Plan, film: Film | None, state: MotionState) -> None:
    """Refuse a state in which a law is not known."""
    if film is None or state.broken:
        return
    film.check(state.gap, state.speed)
    if plan.volume_rate is not None:
        plan.volume_rate.check(state.gap, state.speed, state.volume_fraction)


def _accepted(
    plan: Plan, state: MotionState, problem: StepProblem, left: float
) -> tuple[Step, float, float, int, int]:
    """Step that meets the tolerance, its length [s] and its error, steps rejected, evaluations."""
    length = min(state.step or _first_length(problem, left), left)
    rejected, evaluations = 0, 1
    while True:
        taken = step(problem, length)
        error = math.inf
        if taken is not None:
            evaluations += taken.evaluations
            error = _error(plan, state, problem, taken, length)
            if error <= 1.0:
                return taken, length, error, rejected, evaluations
        rejected += 1
        length = _CONTROL.shorter(length, error)
        if length < max(1e-15 * abs(state.time), _NO_TIME) or rejected > _MOST_REJECTED:
            raise _no_step(state, problem.rtol)


def _cut(
    plan: Plan, film: Film | None, state: MotionState, problem: StepProblem, whole: EventStep[Step]
) -> tuple[Step, float, float | None, bool]:
    """Step up to its first event, its length [s], and the gap of that event [m], if it has one.

    And whether the film breaks there at a gap that depends on the motion; of length 0 if at once.
    """
    taken, length = whole
    event = next_event(plan, film, state, taken.stages[2].gap)
    if event is not None:
        taken, length = _step_to_gap(problem, taken, length, event)
    if film is None or not (film.moving_ends or plan.volume_rate is not None):
        return taken, length, event, False
    rupture = cut_at_rupture(problem, film, taken, length)
    if rupture is None:
        return taken, length, event, False
    return *rupture, None, True


def _part_left(state: MotionState, taken: Step) -> float:
    """Volume of the film over that of the scene at the end of a step."""
    found = taken.memory.found if taken.memory is not None else None
    return found.parts[2] if isinstance(found, VolumeStages) else state.volume_fraction


def _first_length(problem: StepProblem, left: float) -> float:
    """Time [s] in which inertia alone would open a thousandth of the gap; a first guess."""
    (time, gap, speed), first = problem.begin, problem.first
    acceleration = abs(problem.net(problem.pull(time), gap, first)) / problem.mass
    resting = math.sqrt(2e-3 * gap / acceleration) if acceleration > 0.0 else left
    moving = 1e-3 * gap / abs(speed) if speed else left
    return min(resting, moving, left)


def _no_step(state: MotionState, rtol: float) -> ConvergenceError:
    """Error for a state from which no step meets the tolerance."""
    cure = f"loosen Accuracy.time_rtol = {rtol:g}"
    if state.gap < 10.0 * _NO_GAP:
        cure = "the bodies are pressed together; give loading.rest_gap [m], where asperities carry"
    where = f"{state.time:g} s, gap {state.gap:g} m, speed {state.speed:g} m/s"
    return ConvergenceError(f"no step of time can be taken from {where}; {cure}", state)


def _error(
    plan: Plan, state: MotionState, problem: StepProblem, taken: Step, length: float
) -> float:
    """Error of a step over its tolerance, with what the estimate inside the step cannot see."""
    missed = _missed_impulse(problem, length)
    error = relative_error(problem, taken, length, missed)
    if error > 1.0:
        return error
    end, rest = taken.stages[2], plan.scene.imposed_force.rest_gap
    if end.gap < rest * (1.0 - SAME) and state.gap <= rest * (1.0 + SAME):
        return _TOO_LONG  # a hop that begins and ends at the rest gap: there is none to cut at
    if all(forces.limit is problem.first.limit for forces in taken.forces):
        return error
    # Where a limit sets in or ceases, the slope of the force jumps: compare with two half steps.
    seen = against_halves(problem, taken, length)
    return _TOO_LONG if seen is None else max(error, relative_error(problem, seen, length))


def _missed_impulse(problem: StepProblem, length: float) -> float:
    """What the nodes of a step miss of the impulse of the pull [N.s], against Simpson's rule.

    A stiff film hides a ramp of the pull from the estimates of gap and speed. A pull that is
    linear in time is integrated exactly.
    """
    start, pull = problem.begin.time, problem.pull
    if isinstance(pull, Pull):
        return 0.0
    first, middle, last = (pull(start + x * length) for x in (0.0, 0.5, 1.0))
    nodes = zip(WEIGHTS, NODES, strict=True)
    seen = sum(weight * pull(start + node * length) for weight, node in nodes)
    return length * (seen - (first + 4.0 * middle + last) / 6.0)


def _step_to_gap(problem: StepProblem, taken: Step, length: float, gap: float) -> EventStep[Step]:
    """Step that ends at a gap."""
    rising = gap > problem.begin.gap

    def beyond(one: Step) -> float:
        return (one.stages[2].gap / gap - 1.0) * (1.0 if rising else -1.0)

    begin = -abs(problem.begin.gap / gap - 1.0)
    return step_to_event(lambda dt: step(problem, dt), beyond, begin, taken, length, _EVENT)


def _impulses(film: Film | None, taken: Step, length: float) -> dict[str, float]:
    """Impulse of each force over a step [N.s], by the quadrature of the method itself."""
    if film is None:
        return {}
    b1, b2, b3 = (length * weight for weight in WEIGHTS)
    found = taken.memory.found if taken.memory is not None else None
    films = found.films if isinstance(found, VolumeStages) else (film, film, film)
    trios = zip(films, taken.stages, taken.forces, strict=True)
    stages = (one.split(point.gap, point.speed, forces) for one, point, forces in trios)
    each = zip(film.impulse_names, *stages, strict=True)
    return {name: b1 * one + b2 * two + b3 * three for name, one, two, three in each}


def _work(problem: StepProblem, taken: Step) -> float:
    """Work that the viscous force dissipates in a step [J]."""
    viscous = [forces.viscous for forces in taken.forces]
    return work(problem.begin, taken, problem.first.viscous, viscous)


def _peak(
    state: MotionState, problem: StepProblem, taken: Step, length: float
) -> tuple[float, float]:
    """Highest force of film and solids so far [N], and its time [s]."""
    first = problem.first.static + problem.first.viscous
    totals = [forces.static + forces.viscous for forces in taken.forces]
    top = max(first, *totals)
    if top + 0.25 * (top - min(first, *totals)) > state.peak_force:  # the most `peak` can find
        highest = peak(first, totals)
        if highest.value > state.peak_force:
            return highest.value, state.time + highest.where * length
    return state.peak_force, state.peak_time
