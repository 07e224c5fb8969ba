"""The contact while the unknowns of its effects are held: one call of the solver."""

from __future__ import annotations

import time
from typing import TYPE_CHECKING

import numpy as np

from .unknown import Held, HeldContact, Target

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from ..plan import ContactPlan
    from ..work import WorkCounter

    Map = NDArray[np.float64]

__all__ = ["solve_held"]


def solve_held(
    plan: ContactPlan, target: Target, held: Held, rtol: float, counter: WorkCounter
) -> HeldContact:
    """Solve a contact under given unknowns to a tolerance.

    A displacement w by tractions lowers the heights; under a tension t the pressure of contact is
    that of the heights raised by its displacement, of a load larger by its mean, and of a bound
    larger by t, as bound and load are those of pressure less tension. Under a relaxed displacement
    the gap is `relaxation` times that which belongs to the pressure; the contact is returned with
    the latter and with the displacement that does not lack any of it.
    """
    begun = time.perf_counter()
    share = held.relaxation
    accuracy, load, bound, start = plan.accuracy, target.mean_pressure, held.bound, target.start
    heights = plan.heights if held.displacement is None else plan.heights - held.displacement
    pulled: Map | None = None
    if held.tension is not None:
        pulled = displacement_by_tension(plan, held.tension)
        heights = heights + pulled
        load = None if load is None else load + float(held.tension.mean())
        bound = None if bound is None else bound + held.tension
        start = start if start is not None and np.any(target.pressure) else None
    solution = plan.prepared.solver.solve(
        plan.prepared.open(heights),
        mean_pressure=load,
        rigid_approach=target.rigid_approach,
        bound=bound,
        rtol=share * rtol,
        start=start,
        max_iterations=accuracy.max_iterations,
        method=accuracy.method,
    )
    counter.add(solution)
    displacement = solution.displacement if pulled is None else solution.displacement - pulled
    distance = displacement - plan.heights
    distance -= solution.rigid_approach
    if held.displacement is not None:
        distance += held.displacement
        if share < 1.0:
            distance /= share
            held = held._replace(displacement=held.displacement + (1.0 - share) * distance)
            solution = solution._replace(kkt=solution.kkt / share)
    counter.clock("contact", begun)
    return HeldContact(target, held, solution, displacement, distance)


def displacement_by_tension(plan: ContactPlan, tension: Map) -> Map:
    """Displacement [m] that a tension takes off that of a pressure, (ny, nx)."""
    solver = plan.prepared.solver
    found = solver.displacement(tension)
    # Of a uniform tension on a periodic half-space round-off remains, which is no roughness.
    largest = max(float(found.max()), -float(found.min()))
    is_round_off = largest <= 1e-12 * solver.self_influence * float(tension.max(initial=0.0))
    return np.zeros_like(found) if is_round_off else found
