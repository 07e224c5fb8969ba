"""Solve a planned contact: the pressure, then the effects that observe it."""

from __future__ import annotations

import math
import time
from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np

from ..errors import ConvergenceError, DescriptionError, InfeasibleError
from ..frozen import FrozenDict
from ..scene.plan import check_plan
from ..validity import warn
from .effects.base import (
    AttractedContact,
    Attraction,
    LoadTerm,
    SolvedContact,
    SurfaceTraction,
    effects_of,
)
from .effects.partial_slip import PartialSlip
from .effects.plastic_history import PlasticHistory
from .effects.plasticity import HardnessLimit
from .effects.viscoelasticity import Viscoelasticity
from .film_estimate import self_consistent_force
from .outer.load import solve_loaded
from .outer.step import Solved, Step
from .outer.tension import Tension
from .outer.unknown import Target
from .plan import ContactPlan
from .result import ContactResult
from .validity import check_contact
from .work import WorkCounter

if TYPE_CHECKING:
    from numpy.typing import NDArray

    Map = NDArray[np.float64]

__all__ = ["solve", "solve_unwarned"]


def solve(
    plan: ContactPlan,
    *,
    start: ContactResult | Sequence[ContactResult] | None = None,
    throw: bool = True,
) -> ContactResult:
    """Solve a contact.

    Parameters
    ----------
    plan : ContactPlan
        What to solve.
    start : ContactResult or sequence of them, optional
        Results nearby, such as those of the loads before, the nearest first: where the solve
        begins. Of several under other loads or approaches the pressure is extrapolated;
        `load_curve` does this for a series of loads. With `Adhesion`, which may have several
        states, it also decides which of them is found.
    throw : bool
        Raise where the tolerance is not reached; otherwise return what was reached, with status
        ``not converged``.

    Returns
    -------
    ContactResult
        Maps, numbers, residual, validity and cost.

    Raises
    ------
    ConvergenceError
        If the tolerance is not reached; carries the result so far.
    InfeasibleError
        If the bodies cannot carry the load.

    Warns
    -----
    ValidityWarning
        For each number of `ContactResult.validity` that is out of its range.

    Examples
    --------
    Hertz: a sphere of 1 mm on steel, a load of 0.2 N, an isolated contact.

    >>> import contactkit as ck
    >>> steel = ck.Material(name="steel", young_modulus=210e9, poisson_ratio=0.3)
    >>> scene = ck.ContactScene(
    ...     interface=ck.Interface(
    ...         lower=ck.Body(solid=steel), upper=ck.Body(surface=ck.Paraboloid(radius=1e-3))
    ...     ),
    ...     window=ck.Window(width=30e-6, periodic=False),
    ...     loading=ck.Pressing(force=0.2),
    ...     effects=(ck.HalfSpace(),),
    ... )
    >>> result = ck.solve(ck.plan(scene, ck.Accuracy(grid=96)))
    >>> f"{result.max_pressure / 1e9:.2f} GPa, approach {result.approach * 1e9:.1f} nm"
    '1.27 GPa, approach 75.0 nm'
    """
    check_plan(plan, ContactPlan)
    result = solve_unwarned(plan, start=start, throw=throw)
    warn(result.validity)
    return result


def solve_unwarned(
    plan: ContactPlan,
    *,
    start: ContactResult | Sequence[ContactResult] | None = None,
    throw: bool = True,
) -> ContactResult:
    """Solve a contact as `solve` does; the caller reports the validity of the result."""
    counter = WorkCounter()
    solved = _solved(plan, _target(plan, start), counter)
    result = _result(plan, _observed(plan, solved, counter), counter)
    if solved.problem and throw:
        raise ConvergenceError(solved.problem, result)
    return result


def _target(plan: ContactPlan, start: ContactResult | Sequence[ContactResult] | None) -> Target:
    before = [start] if isinstance(start, ContactResult) else list(start or ())
    for one in before:
        if one.pressure.shape != plan.grid.shape:
            raise DescriptionError(
                "start",
                f"a result on {one.pressure.shape} pixels",
                f"be one on {plan.grid.shape} pixels",
            )
    near = None
    if before and before[0].has(HardnessLimit):
        hardness = before[0].of(HardnessLimit).hardness
        near = hardness if isinstance(hardness, float) else None
    load, approach = plan.mean_pressure, plan.rigid_approach
    target = Target(load, approach, None, near)
    if before and (attracted := _attracted(before[0])) is not None:
        pressure = before[0].pressure + attracted.tension
        touching = np.where(attracted.touching, pressure, 0.0)
        return target._replace(start=touching, unknowns={Tension.name: attracted.tension})
    known = [
        (one.mean_pressure if load is not None else one.rigid_approach, one.pressure)
        for one in before
    ]
    return target._replace(start=known or None)


def _attracted(newest: ContactResult) -> AttractedContact | None:
    """Tension of a result to start from, if it has one."""
    attraction = newest.plan.scene.effect(Attraction)
    if attraction is None or type(attraction) not in newest.parts:
        return None
    return attraction.attracted_of(newest.of(type(attraction)))


def _solved(plan: ContactPlan, target: Target, counter: WorkCounter) -> Solved:
    """Solve the contact, or follow the path of loads that an effect brings."""
    if (slip := plan.scene.effect(PartialSlip)) is not None and slip.couples(plan.scene):
        from .slip_path import follow_coupled

        return follow_coupled(plan, slip, counter)
    if (history := plan.scene.effect(PlasticHistory)) is not None:
        from .plastic_history import follow_history

        return follow_history(plan, history, counter)
    if (creep := plan.scene.effect(Viscoelasticity)) is not None:
        from .viscoelastic_path import follow_loads

        return follow_loads(plan, creep, counter)
    step = Step(plan, counter)
    return step.finished(solve_loaded(step, target), target)


def _observed(plan: ContactPlan, solved: Solved, counter: WorkCounter) -> Solved:
    """Add the parts of the effects that observe the contact."""
    contact, parts = solved.contact, dict(solved.parts)
    _check_fits(plan, contact, solved.solution.energy)
    # Tractions come first: the others may depend on them.
    for effect in sorted(effects_of(plan.scene), key=lambda e: not isinstance(e, SurfaceTraction)):
        begun = time.perf_counter()
        if type(effect) not in parts and (part := effect.observe(contact)) is not None:
            if isinstance(effect, LoadTerm) and effect.needs_balance(contact, part):
                part = effect.estimated(part, self_consistent_force(plan, effect))
            parts[type(effect)] = part
            counter.clock(effect.name, begun)
        if isinstance(effect, SurfaceTraction):
            contact = contact._replace(tractions=effect.tractions(parts[type(effect)]))
    return solved._replace(contact=contact, parts=parts)


def _check_fits(plan: ContactPlan, contact: SolvedContact, energy: float) -> None:
    """Refuse a contact with overflow or underflow during the solve."""
    load = plan.mean_pressure
    is_lost = load is not None and load > 0.0 and not contact.pressure.any()
    sums = float(contact.pressure.sum() + contact.gap.sum()) + energy
    if not is_lost and math.isfinite(sums):
        return
    (ny, nx), (dy, dx) = plan.grid.shape, plan.grid.pixel_size
    imposed = "" if load is None else f", a mean pressure of {load:.3g} Pa"
    raise InfeasibleError(
        "the numbers of this contact are too large or too small for a computer to hold: heights "
        f"over {float(np.ptp(plan.heights)):.3g} m, a window of {nx * dx:.3g} m by {ny * dy:.3g} m"
        f"{imposed}; check their units, and those of young_modulus"
    )


def _result(plan: ContactPlan, solved: Solved, counter: WorkCounter) -> ContactResult:
    solution, contact, parts = solved.solution, solved.contact, solved.parts
    touches = bool(contact.touching.any())
    status = "not converged" if solved.problem else ("converged" if touches else "no contact")
    message = solved.problem or (
        f"{status}: contact conditions met to {solution.kkt:.1e} of the rms height"
    )
    for one in (contact.pressure, contact.gap, contact.displacement):
        one.flags.writeable = False
    return ContactResult(
        plan=plan.without_preparation(),
        status=status,
        message=message,
        pressure=contact.pressure,
        gap=contact.gap,
        displacement=contact.displacement,
        heights=plan.heights,
        rigid_approach=solution.rigid_approach,
        residual=solution.kkt,
        energy=solution.energy,
        work=counter.work(),
        parts=FrozenDict(parts),
        validity=check_contact(contact, plan.heights, parts),
    )
