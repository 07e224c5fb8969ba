"""Estimate of the meniscus force of a film that is only reported, if it acted on the contact."""

from __future__ import annotations

from typing import Any

from ..errors import InfeasibleError
from .effects.base import LoadTerm
from .outer.film_balance import film_companion, solve_under_load
from .outer.step import Step
from .outer.unknown import Target
from .plan import ContactPlan
from .work import WorkCounter

__all__ = ["self_consistent_force"]


def self_consistent_force(plan: ContactPlan, term: LoadTerm[Any]) -> float | None:
    """Estimate the force [N] at the smallest balance of load, film and bodies.

    Solved without friction, to a tenth of the load, on a companion of about a hundred pixels along
    a side. None if the bodies cannot carry that load, or none is imposed.
    """
    coarse = film_companion(plan)
    load = coarse.mean_pressure
    if load is None:
        return None
    try:
        found = solve_under_load(Step(coarse, WorkCounter()), term, Target(load, None))
    except InfeasibleError:
        return None
    return term.force_of(found.parts[type(term)])
