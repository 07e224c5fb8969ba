"""Curves of a motion under a pull, with points between its steps where lines need them."""

from __future__ import annotations

import contextlib
import math
from collections.abc import Callable, Mapping, Sequence
from itertools import pairwise
from typing import TYPE_CHECKING

import numpy as np

from ..errors import ConvergenceError
from .curve_result import LateColumns
from .motion.advance import advance
from .motion.state import MotionState, Outputs, PullLaw, outputs
from .plan import Plan
from .prescribed import frozen, impulses_so_far, simulated
from .results import with_late_curves

if TYPE_CHECKING:
    from numpy.typing import NDArray

    Curve = NDArray[np.float64]

__all__ = ["at_steps", "before_events", "motion_curves", "pull_law"]

_JUST = 1e-6  # of a step, before the event at its end; as far as a jump of a curve is drawn


def pull_law(plan: Plan) -> Callable[[float], float]:
    """Pull [N] of the scene at a time [s]."""
    force, rise = plan.scene.imposed_force.force, plan.scene.imposed_force.rise_time
    if rise == 0.0:
        return lambda time: force
    return lambda time: -force * math.expm1(-time / rise)


def at_steps(
    states: Sequence[MotionState], shown: Sequence[Outputs]
) -> tuple[dict[str, Curve], Curve]:
    """Gap, speed, status of the film and force that resists [N], at the steps of a motion."""
    columns = {
        "gap": np.array([state.gap for state in states]),
        "speed": np.array([state.speed for state in states]),
        "film_status": np.array([float(one.status) for one in shown]),
    }
    return columns, np.array([one.film for one in shown])


def before_events(plan: Plan, states: Sequence[MotionState], pull: PullLaw) -> list[MotionState]:
    """States just before a film breaks and before a mass lands.

    At the step that ends there the film is not whole any more, and the speed lost.
    """
    found = []
    for before, after in pairwise(states):
        dt = (after.time - before.time) * (1.0 - _JUST)
        breaks, lands = after.broken > before.broken, after.in_contact > before.in_contact
        if (breaks or lands) and dt > 0.0:
            with contextlib.suppress(ConvergenceError):  # a part of a step has no solution
                found.append(advance(plan, before, pull, dt))
    return found


def motion_curves(
    plan: Plan, states: Sequence[MotionState], shown: Sequence[Outputs]
) -> Mapping[str, Curve]:
    """Curves of a motion by their names, computed when the first of them is asked for.

    `shown` has the forces at the states, which are not evaluated again.
    """
    motion = _Motion(plan, states, shown)
    columns = LateColumns({}, dict.fromkeys(("time", *_names(plan)), motion.columns))
    return with_late_curves(plan, columns, motion.volume_fraction)


def _names(plan: Plan) -> list[str]:
    """Names of the curves of a motion, the time left out."""
    return ["gap", "speed", "pull", "film_status", *simulated(plan), *impulses_so_far(plan)]


class _Motion:
    """Steps of a motion, until its curves are computed."""

    def __init__(self, plan: Plan, states: Sequence[MotionState], shown: Sequence[Outputs]) -> None:
        self._plan, self._states = plan, states
        # By identity: the states are kept, and many are equal in all but what a curve shows.
        self._shown = {id(state): one for state, one in zip(states, shown, strict=True)}
        self._fractions: Curve | None = None

    def columns(self) -> dict[str, Curve]:
        """Curves by their names."""
        from .refine import refined

        plan, pull = self._plan, pull_law(self._plan)
        names = _names(plan)
        self._states, table = refined(
            plan, self._states, pull, lambda s: self._row(s, pull(s.time), names)
        )
        self._fractions = np.array([state.volume_fraction for state in self._states])
        self._states, self._shown = (), {}
        return {name: frozen(table[:, i]) for i, name in enumerate(("time", *names))}

    def _row(self, state: MotionState, pull: float, names: Sequence[str]) -> list[float]:
        """Values of the curves at a state, in the order of their names."""
        shown = self._shown.get(id(state))
        if shown is None:
            shown = outputs(self._plan, state, pull)
        known = dict(shown.named) | dict(shown.newtonian)
        known |= {name: state.impulses.get(name, 0.0) for name in impulses_so_far(self._plan)}
        known |= {
            "gap": state.gap,
            "speed": state.speed,
            "pull": pull,
            "film_status": float(shown.status),
            "limit": float(shown.limit),
            "cavity_radius": shown.cavity_radius,
            "void_volume": shown.void,
        }
        return [known.get(name, 0.0) for name in names]  # a broken film has no forces any more

    def volume_fraction(self) -> Curve:
        """Volume of the film over that of the scene; known once the columns are."""
        assert self._fractions is not None
        return self._fractions
