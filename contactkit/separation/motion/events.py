"""What happens at a gap on the way: release, rupture, rest, re-wetting, solids that let go."""

from __future__ import annotations

from ..plan import Film, Plan
from .state import MotionState

__all__ = ["SAME", "first_mark", "happen"]

SAME = 1e-11  # two gaps closer than this, relatively, are one


def _closed_gap(plan: Plan) -> float:
    """Gap below which the bodies count as closed again, so that the next release is a new one."""
    opening = plan.scene.opening
    return min(2.0 * opening.initial_gap, 0.5 * (opening.initial_gap + opening.final_gap))


def first_mark(plan: Plan, film: Film | None, state: MotionState, gap: float) -> float | None:
    """First gap on the way to `gap` at which something happens."""
    opening = plan.scene.opening
    marks = film.kinks if film is not None else ()
    if gap > state.gap:
        if state.armed:
            marks += (opening.final_gap,)
        if film is not None:
            marks += (film.end, film.release)
        low = state.gap * (1.0 + SAME)
        return min([m for m in marks if low < m < gap or m == gap], default=None)
    marks += (opening.rest_gap,)
    if state.broken:
        marks += (opening.initial_gap,)
    if state.detached:
        marks += (plan.film.rejoin,)
    if not state.armed:
        marks += (_closed_gap(plan),)
    low = gap * (1.0 + SAME)
    return max([m for m in marks if low < m < state.gap or m == gap], default=None)


def happen(plan: Plan, film: Film | None, state: MotionState, mark: float) -> MotionState:
    """Apply what happens at a mark: release, rupture, rest or re-wetting."""
    opening, meniscus = plan.scene.opening, plan.scene.interface.meniscus
    rising = state.speed > 0.0
    state = state._replace(gap=mark)
    if rising and mark == opening.final_gap:
        state = state._replace(
            armed=False,
            release_time=state.time,
            release_speed=state.speed,
            n_releases=state.n_releases + 1,
        )
    if rising and film is not None and mark == film.end:
        state = state._replace(broken=True, break_time=state.time, n_breaks=state.n_breaks + 1)
    if rising and film is not None and mark == film.release:
        state = state._replace(detached=True)
    if rising:
        return state
    if mark <= _closed_gap(plan):
        state = state._replace(armed=True)
    if mark <= plan.film.rejoin:
        state = state._replace(detached=False)
    if mark > opening.initial_gap:
        return state
    wets = state.broken and meniscus.rewetting > 0.0
    if wets and plan.film_with(meniscus.rewetting).end > mark:
        state = state._replace(broken=False, share=meniscus.rewetting)
    if mark == opening.rest_gap:
        state = state._replace(held=True, speed=0.0)
    return state
