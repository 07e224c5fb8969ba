"""Contact under the load of a scene, and a force that adds to it."""

from __future__ import annotations

import time
from typing import TYPE_CHECKING

from ..effects.base import LoadTerm

if TYPE_CHECKING:
    from .step import Solved, Step
    from .unknown import Target

__all__ = ["solve_loaded"]


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
