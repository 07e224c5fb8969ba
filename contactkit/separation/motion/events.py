"""Events of the motion: release, rupture, rest on asperities, re-wetting, solids that pull off."""

from __future__ import annotations

from ...numerics.events import EventStep, first_crossing, step_to_event
from ..cavity.state import FULL
from ..integrator.radau import Step, StepProblem, step
from ..plan import Film, Plan
from .state import MotionState
from .volume import film_at_end

__all__ = ["SAME", "apply_event", "broken", "closed_gap", "cut_at_rupture", "next_event"]

_MISS = 1e-11  # of the gap at which a film breaks, where that depends on the motion

SAME = 1e-11  # two gaps closer than this, relatively, are one


def closed_gap(plan: Plan) -> float:
    """Gap below which the bodies count as closed again, so that the next release is a new one."""
    loading = plan.scene.imposed_force
    return min(2.0 * loading.initial_gap, 0.5 * (loading.initial_gap + loading.final_gap))


def next_event(plan: Plan, film: Film | None, state: MotionState, gap: float) -> float | None:
    """Gap of the first event on the way to `gap`; kinks of the forces are events too."""
    loading = plan.scene.imposed_force
    # A method of fifth order needs smooth forces within a step, so that one ends at each kink.
    events = film.kinks if film is not None else ()
    if gap > state.gap:
        if state.armed:
            events += (loading.final_gap,)
        if film is not None:
            events += (film.end, film.release)
    else:
        events += (loading.rest_gap,)
        if state.broken:
            events += (loading.initial_gap,)
        if state.detached:
            events += (plan.film.recontact,)
        if not state.armed:
            events += (closed_gap(plan),)
    return first_crossing(events, state.gap, gap, SAME)


def cut_at_rupture(
    problem: StepProblem, film: Film, taken: Step, length: float
) -> EventStep[Step] | None:
    """Step that ends where the film breaks, at a gap that depends on the motion; None if not in it.

    Of length 0 if it breaks where the step starts: slower than a moment ago, beyond its end.
    """

    def beyond(one: Step) -> float:
        _, gap, speed = one.stages[2]
        return gap / film_at_end(film, one).end_at(gap, speed) - 1.0

    ahead = beyond(taken)
    if ahead <= 0.0:
        return None
    _, gap, speed = problem.begin
    behind = gap / film.end_at(gap, speed) - 1.0
    if behind >= -_MISS:
        return EventStep(taken, 0.0)
    return step_to_event(lambda dt: step(problem, dt), beyond, behind, taken, length, _MISS)


def broken(state: MotionState) -> MotionState:
    """State of a film that breaks."""
    return state._replace(
        broken=True, cavity=FULL, break_time=state.time, n_breaks=state.n_breaks + 1
    )


def apply_event(plan: Plan, film: Film | None, state: MotionState, gap: float) -> MotionState:
    """State after the event at a gap: release, rupture, rest, re-wetting, pull-off, re-contact."""
    loading, meniscus = plan.scene.imposed_force, plan.scene.meniscus
    state = state._replace(gap=gap)
    if state.speed > 0.0:
        if gap == loading.final_gap:
            state = state._replace(
                armed=False,
                release_time=state.time,
                release_speed=state.speed,
                n_releases=state.n_releases + 1,
            )
        if film is not None and gap == film.end:
            state = broken(state)
        if film is not None and gap == film.release:
            state = state._replace(detached=True)
        return state
    if gap <= closed_gap(plan):
        state = state._replace(armed=True)
    if gap <= plan.film.recontact:
        state = state._replace(detached=False)
    if gap > loading.initial_gap:
        return state
    wets = state.broken and meniscus.rewetting > 0.0
    if wets and plan.film_with(meniscus.rewetting).end > gap:
        state = state._replace(broken=False, volume_fraction=meniscus.rewetting)
    if gap == loading.rest_gap:
        state = state._replace(in_contact=True, speed=0.0)
    return state
