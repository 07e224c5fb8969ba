"""The internal step of `motion` through a liquid without limits, where next to nothing changes.

The same step as any other, to rounding, with the same errors and counts; only the forces are
asked for once. Masters with many communication steps take most of theirs this way.
"""

from __future__ import annotations

import math

from ..integrator.dense_output import highest
from ..integrator.radau import WEIGHTS
from ..integrator.radau_smooth import Even, Here, smooth_step
from ..plan import Film, Plan
from .events import SAME, first_mark
from .state import MotionState, Pull

__all__ = ["NO_FORCE", "is_spent", "smooth_once"]

_GROW, _SAFETY = 8.0, 0.9
_TINY = (_SAFETY / _GROW) ** 4  # error over its tolerance below which the next step is as long
_LEFT = 3e-3  # what the rounds may leave of the rates, over the tolerance of a step
_SPREAD = 1e-9  # what the work may miss, relatively, where the force jumps as the step begins
NO_FORCE = 1e-290  # sum of the forces [N] below which none acts
_COASTING = 1e-30  # share of the gap over which the film stops a mass that is as good as at rest
_W1, _W2, _W3 = WEIGHTS


def _free(gap: float) -> Here:
    return gap, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, math.inf


def is_spent(mass: float, speed: float, resistance: float, gap: float) -> bool:
    """Whether a moving mass that nothing pulls is as good as at rest."""
    return 0.0 < abs(speed) * mass < _COASTING * resistance * gap


def smooth_once(plan: Plan, state: MotionState, pull: Pull, end: float) -> MotionState | None:
    """Take one internal step; None where it is not as easy as this, or something happens."""
    time, gap, speed, share, broken, held, armed, _, _, _, given = state[:11]
    step, detached, opening = state.step, state.detached, plan.scene.opening
    mass, left = opening.mass, end - time
    length = step if step < left else left
    falls = speed <= 0.0 and gap <= opening.rest_gap * (1.0 + SAME)
    if held or falls or mass is None or not length > 0.0:
        return None
    film: Film | None = plan.film
    if broken or detached or share != 1.0:
        film = plan.film_left(share, broken=broken, detached=detached)
    at = _free if film is None else film.smooth
    here = at(gap) if at is not None else None
    if at is None or here is None:
        return None
    static, drag, stiffness, start = here[1], here[4], opening.stiffness, opening.initial_gap
    pulled, rate = pull(time), pull.rate
    size = abs(pulled) + abs(static) + stiffness * abs(gap - start) + 1e-300
    if size <= NO_FORCE and is_spent(mass, speed, drag, gap):
        return None
    scale = gap / step
    if drag > 0.0:
        scale = max(size / drag, 1e-15 * scale)
    rtol = plan.accuracy.time_rtol
    found = smooth_step(
        mass,
        here,
        speed,
        length,
        (pulled, rate, stiffness, start),
        at,
        (_LEFT * rtol, min(1e-6 / length, scale / gap)),
        film.viscous_force if film is not None and film.limits else None,
    )
    if found is None:
        return None
    # See `StepProblem.error`; a straight pull has no impulse that the nodes could miss.
    there, after, _, _, _, gap_error, speed_error, _, resistance, _ = found
    momentum = mass * (abs(after) + abs(speed)) + given + size * length
    wrong = max(mass * speed_error, resistance * gap_error)
    error = max(gap_error, wrong / momentum, 0.1 * speed_error / (abs(after) + scale)) / rtol
    rises = there > gap and (not armed or there < opening.final_gap)
    if error > 1.0 or not (rises or _is_free(plan, film, state, there)):
        return None
    following = length * (_GROW if error <= _TINY else _SAFETY * error**-0.25)
    if length < step and following < step:  # cut short by the end of the span only
        following = step
    reached = end if length == left else time + length
    return _after(state, here, found, (length, reached, following, length * size))


def _is_free(plan: Plan, film: Film | None, state: MotionState, gap: float) -> bool:
    """Whether nothing happens on the way to a gap; the film itself is smooth up to there."""
    return gap > plan.scene.opening.rest_gap and first_mark(plan, film, state, gap) is None


def _after(
    state: MotionState, here: Here, found: Even, spent: tuple[float, float, float, float]
) -> MotionState | None:
    """State after the step; None if its work is not known well enough."""
    gap, speed, (f1, f2, f3), (w1, w2, w3), work, _, _, first, _, calls = found
    (
        time,
        begin,
        _,
        share,
        broken,
        held,
        armed,
        viscous,
        meniscus,
        dissipated,
        given,
        break_time,
        release_time,
        release_speed,
        n_breaks,
        n_releases,
        peak,
        peak_time,
        _,
        n_steps,
        n_rejected,
        n_evaluations,
        *rest,
    ) = state
    length, reached, following, delivered = spent
    if w1 - first > 0.9 * abs(w3 - first):
        low, high = min(w1, w2, w3), max(w1, w2, w3)
        # A stiff film that came up to its force at once, in a transient the step strode over.
        if w1 - first > 0.9 * (high - min(first, low)):
            spread = high - low
            if abs(gap - begin) * spread * spread > _SPREAD * begin * high * high:
                return None
    first += here[1]
    t1, t2, t3 = f1 + w1, f2 + w2, f3 + w3
    falling = first >= t1 >= t2 >= t3
    top, least = (first, t3) if falling else (max(first, t1, t2, t3), min(first, t1, t2, t3))
    if top > 0.99 * peak and top + 0.25 * (top - least) > peak:
        value, where = highest(first, (t1, t2, t3))
        if value > peak:
            peak, peak_time = value, time + where * length
    return tuple.__new__(
        MotionState,
        (
            reached,
            gap,
            speed,
            share,
            broken,
            held,
            armed,
            viscous + length * (_W1 * w1 + _W2 * w2 + _W3 * w3),
            meniscus + length * (_W1 * f1 + _W2 * f2 + _W3 * f3),
            dissipated + work,
            given + delivered,
            break_time,
            release_time,
            release_speed,
            n_breaks,
            n_releases,
            peak,
            peak_time,
            following,
            n_steps + 1,
            n_rejected,
            n_evaluations + calls,
            *rest,
        ),
    )
