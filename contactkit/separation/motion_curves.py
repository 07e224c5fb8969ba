"""Curves of a motion under a pull, with points between its steps where lines need them."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from typing import TYPE_CHECKING

import numpy as np

from .curve_result import LateColumns
from .effects.viscous import ViscousForce
from .motion.state import MotionState, PullLaw, acting_film, outputs
from .plan import Plan
from .prescribed import frozen, simulated
from .results import with_late_curves

if TYPE_CHECKING:
    from numpy.typing import NDArray

    Curve = NDArray[np.float64]

__all__ = ["at_steps", "motion_curves", "pull_law"]


def pull_law(plan: Plan) -> Callable[[float], float]:
    """Pull [N] of the scene at a time [s]."""
    force, rise = plan.scene.imposed_force.force, plan.scene.imposed_force.rise_time
    if rise == 0.0:
        return lambda time: force
    return lambda time: -force * math.expm1(-time / rise)


def at_steps(
    plan: Plan, states: Sequence[MotionState], pull: PullLaw
) -> tuple[dict[str, Curve], Curve]:
    """Gap, speed, status of the film and force that resists [N], at the steps of a motion."""
    shown = [outputs(plan, state, pull(state.time)) for state in states]
    columns = {
        "gap": np.array([state.gap for state in states]),
        "speed": np.array([state.speed for state in states]),
        "film_status": np.array([float(one.status) for one in shown]),
    }
    return columns, np.array([one.film for one in shown])


def motion_curves(plan: Plan, states: Sequence[MotionState]) -> Mapping[str, Curve]:
    """Curves of a motion by their names, computed when the first of them is asked for."""
    motion = _Motion(plan, states)
    columns = LateColumns({}, dict.fromkeys(("time", *_names(plan)), motion.columns))
    return with_late_curves(plan, columns, motion.volume_fraction)


def _names(plan: Plan) -> list[str]:
    """Names of the curves of a motion, the time left out."""
    impulse = ["viscous_impulse"] if plan.has(ViscousForce) else []
    return ["gap", "speed", "pull", "film_status", *simulated(plan), *impulse]


class _Motion:
    """Steps of a motion, until its curves are computed."""

    def __init__(self, plan: Plan, states: Sequence[MotionState]) -> None:
        self._plan, self._states = plan, states
        self._fractions: Curve | None = None

    def columns(self) -> dict[str, Curve]:
        """Curves by their names."""
        from .refine import refined

        plan, pull = self._plan, pull_law(self._plan)
        names = _names(plan)
        self._states, table = refined(
            plan, self._states, pull, lambda s: _row(plan, s, pull, names)
        )
        self._fractions = np.array([state.volume_fraction for state in self._states])
        self._states = ()
        return {name: frozen(table[:, i]) for i, name in enumerate(("time", *names))}

    def volume_fraction(self) -> Curve:
        """Volume of the film over that of the scene; known once the columns are."""
        assert self._fractions is not None
        return self._fractions


def _row(plan: Plan, state: MotionState, pull: PullLaw, names: Sequence[str]) -> list[float]:
    """Values of the curves at a state, in the order of their names."""
    force = pull(state.time)
    shown, film = outputs(plan, state, force), acting_film(plan, state)
    none = {column.name: 0.0 for column in plan.film.static_columns}
    known = none | (film.static_forces(state.gap) if film is not None else {})
    known |= {
        "gap": state.gap,
        "speed": state.speed,
        "pull": force,
        "film_status": float(shown.status),
        "viscous_force": shown.viscous,
        "newtonian_force": _newtonian_force(plan, state),
        "limit": float(shown.limit),
        "cavity_radius": shown.cavity_radius,
        "void_volume": shown.void,
        "viscous_impulse": state.impulses.get("viscous_impulse", 0.0),
    }
    return [known[name] for name in names]


def _newtonian_force(plan: Plan, state: MotionState) -> float:
    if state.broken:
        return 0.0
    return plan.film_with(state.volume_fraction).newtonian_force(state.gap, state.speed)
