"""Events of the motion: release, rupture, rest on asperities, re-wetting, solids that pull off."""

from __future__ import annotations

from ...numerics.events import first_crossing
from ..cavity.state import FULL
from ..plan import Film, Plan
from .state import MotionState

__all__ = ["SAME", "apply_event", "closed_gap", "next_event"]

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
            state = state._replace(
                broken=True, cavity=FULL, break_time=state.time, n_breaks=state.n_breaks + 1
            )
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
