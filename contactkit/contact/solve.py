"""Solve a contact: the pressure, and then whatever else the scene calls for."""

from __future__ import annotations

import time
from collections.abc import Sequence
from types import MappingProxyType
from typing import TYPE_CHECKING, Any

import numpy as np

from ..errors import ConvergenceError, DescriptionError
from ..scene.loading import Approach
from .effects.base import Contact, LoadTerm, Observer, PressureCap
from .effects.film import FilmMeniscus
from .effects.friction import FrictionCoupling
from .effects.plasticity import HardnessLimit
from .engine import Counts, Engine, Friction, Target, interface_key
from .film_loop import pulled_together
from .hardness_loop import Solved, contact_of, solve_capped
from .plan import ContactPlan
from .result import ContactResult, ContactWork, CouplingPart, PlasticPart

if TYPE_CHECKING:
    from numpy.typing import NDArray

    Map = NDArray[np.float64]

__all__ = ["solve"]


def solve(
    plan: ContactPlan,
    *,
    start: ContactResult | Sequence[ContactResult] | None = None,
    engine: Engine | None = None,
    throw: bool = True,
) -> ContactResult:
    """Solve a contact.

    Parameters
    ----------
    plan : ContactPlan
        What to solve.
    start : ContactResult or sequence of them, optional
        Results nearby, such as those of the loads before, the newest first: where the solve
        begins. Of several under other loads the pressure is extrapolated.
    engine : Engine, optional
        Heights and compliance made for a plan with the same interface, grid and elastic law, to
        be used again.
    throw : bool
        Raise where the tolerance is not reached; otherwise return what was reached, with status
        ``not converged``.

    Returns
    -------
    ContactResult
        Maps, numbers, residual and cost.

    Raises
    ------
    ConvergenceError
        If the tolerance is not reached; carries the result so far.
    InfeasibleError
        If the bodies cannot carry the load.

    Examples
    --------
    Hertz: a sphere of 1 mm on steel, 100 N/m2 over a window without neighbours.

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
    begun = time.perf_counter()
    if engine is None:
        engine = Engine(plan)
    elif engine.key != interface_key(plan):
        raise DescriptionError(
            "engine", "one of another interface", "be made for the same interface, grid and law"
        )
    counts = Counts()
    counts.seconds["setup"] = engine.setup_seconds
    target = _target(plan, engine, start)
    solved, contact, film = _solve_all(plan, engine, target, counts)
    parts = _parts(plan, engine, solved, contact, counts)
    if film is not None:
        parts[FilmMeniscus] = film
    result = _result(plan, engine, solved, contact, parts, counts, begun)
    if solved.problem and throw:
        raise ConvergenceError(solved.problem, result)
    return result


def _target(
    plan: ContactPlan, engine: Engine, start: ContactResult | Sequence[ContactResult] | None
) -> Target:
    before = [start] if isinstance(start, ContactResult) else list(start or ())
    for one in before:
        if one.pressure.shape != plan.grid.shape:
            raise DescriptionError(
                "start",
                f"a result on {one.pressure.shape} pixels",
                f"be one on {plan.grid.shape} pixels",
            )
    loading = plan.scene.loading
    level = engine.first_touch + loading.approach if isinstance(loading, Approach) else None
    plastic = before[0].parts.get(HardnessLimit) if before else None
    hardness = getattr(plastic, "hardness", None)
    near = hardness if isinstance(hardness, float) else None
    pressures = [(one.mean_pressure, one.pressure) for one in before] or None
    return Target(plan.mean_pressure, level, pressures, near)


def _solve_all(
    plan: ContactPlan, engine: Engine, target: Target, counts: Counts
) -> tuple[Solved, Contact, Any]:
    """Solve the contact, with the pull of the film if that acts back on it."""
    film = plan.scene.effect(LoadTerm)  # type: ignore[type-abstract]
    if isinstance(film, FilmMeniscus) and film.self_consistent:
        begun = time.perf_counter()
        pulled = pulled_together(plan, engine, film, target, counts)
        counts.clock("film", begun)
        return pulled.solved, pulled.contact, pulled.film
    solved = solve_capped(plan, engine, target, counts)
    contact = contact_of(plan, engine, solved)
    begun = time.perf_counter()
    part = film.observe(contact) if film is not None else None
    if part is not None:
        counts.clock("film", begun)
    return solved, contact, part


def _parts(
    plan: ContactPlan, engine: Engine, solved: Solved, contact: Contact, counts: Counts
) -> dict[Any, Any]:
    parts: dict[Any, Any] = {}
    if plan.scene.effect(PressureCap) is not None:  # type: ignore[type-abstract]
        parts[HardnessLimit] = _plastic(engine, solved, contact)
    if solved.friction is not None:
        parts[FrictionCoupling] = _coupling(solved.friction, contact)
    for effect in plan.scene.effects:
        if isinstance(effect, Observer):
            begun = time.perf_counter()
            parts[type(effect)] = effect.observe(contact)
            counts.clock(effect.name, begun)
    return parts


def _plastic(engine: Engine, solved: Solved, contact: Contact) -> PlasticPart:
    """Pixels at the hardness, to the rounding of the bound."""
    assert solved.hardness is not None
    at_bound = contact.pressure >= np.asarray(solved.hardness) * (1.0 - 1e-12)
    is_plastic = at_bound & (contact.pressure > 0.0)
    overlap = engine.heights + solved.solution.rigid_approach - contact.displacement
    overlap = np.where(is_plastic, np.maximum(overlap, 0.0), 0.0)
    area = float(is_plastic.sum()) * contact.grid.pixel_area
    return PlasticPart(is_plastic, area, solved.hardness, overlap)


def _coupling(friction: Friction, contact: Contact) -> CouplingPart:
    """Compare with the contact without coupling, of the same load and hardness."""
    without = friction.pressure_without
    largest = max(float(without.max()), np.finfo(float).tiny)
    change = float(np.abs(contact.pressure - without).max()) / largest
    n_without = max(int((without > 0.0).sum()), 1)
    area = int((contact.pressure > 0.0).sum()) / n_without - 1.0
    return CouplingPart(friction.displacement, change, area)


def _result(
    plan: ContactPlan,
    engine: Engine,
    solved: Solved,
    contact: Contact,
    parts: dict[Any, Any],
    counts: Counts,
    begun: float,
) -> ContactResult:
    solution = solved.solution
    touches = bool(contact.pressure.any())
    status = "not converged" if solved.problem else ("converged" if touches else "no contact")
    message = solved.problem or (
        f"{status}: contact conditions met to {solution.kkt:.1e} of the rms height"
    )
    work = ContactWork(
        counts.n_solves,
        counts.n_operator_applications,
        counts.n_ffts,
        counts.n_coarse,
        counts.n_iterations,
        counts.has_fallen_back,
        time.perf_counter() - begun,
        MappingProxyType(dict(counts.seconds)),
    )
    for one in (contact.pressure, contact.gap, contact.displacement, engine.heights):
        one.flags.writeable = False
    return ContactResult(
        plan,
        status,
        message,
        contact.pressure,
        contact.gap,
        contact.displacement,
        engine.heights,
        solution.rigid_approach,
        solution.kkt,
        solution.energy,
        work,
        MappingProxyType(parts),
    )
