"""Contact under the load of a scene, and a force that adds to it."""

from __future__ import annotations

import time
from typing import TYPE_CHECKING

from ..effects.base import LoadTerm
from .unknown import Target

if TYPE_CHECKING:
    from ..plan import ContactPlan
    from .step import Solved, Step

__all__ = ["solve_loaded", "target_at"]


def target_at(plan: ContactPlan, imposed: float) -> Target:
    """Target of another load than that of the scene: its mean pressure [Pa] or its approach [m]."""
    if plan.mean_pressure is None:
        return Target(None, plan.prepared.first_touch + imposed)
    return Target(imposed, None)


def solve_loaded(step: Step, target: Target) -> Solved:
    """Solve a contact under a load and the force of an effect that adds to it, if there is one.

    The force is one number, the root of a balance in a bracket around all other unknowns.

    Raises
    ------
    InfeasibleError
        If the bodies cannot carry the load, or separate under it.
    """
    term = step.plan.scene.effect(LoadTerm)
    if term is None or not term.self_consistent or target.mean_pressure is None:
        return step.solve(target)
    from .film_balance import solve_under_load, to_last_pixel

    begun = time.perf_counter()
    solved = solve_under_load(step.to(to_last_pixel(step.plan.accuracy)), term, target)
    step.counter.clock(term.name, begun)
    return solved
