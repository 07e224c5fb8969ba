"""Time that a constant pull takes to open the film of a plan, for a massless body."""

from __future__ import annotations

import math

from ..errors import PlanError
from ..lubrication import constant_force
from .effects.base import SeparationForce
from .effects.film_shape import FilmShape, film_shape
from .effects.registry import MeniscusForce, ViscousForce
from .effects.viscous import keeps_radius
from .plan import Plan

__all__ = ["constant_force_time"]


def constant_force_time(plan: Plan, pull: float) -> float:
    """Time [s] to open the gap of a plan under a constant pull [N]; inf if it never does.

    Thin film: the meniscus, where the scene has one, pulls with its Laplace pressure only; no
    inertia, no limits of the liquid. Closed form between flats, quadrature on a sphere.

    Raises
    ------
    PlanError
        If the scene has another force, which this does not know.
    """
    known = (MeniscusForce, ViscousForce)
    others = [e for e in plan.scene.effects if isinstance(e, SeparationForce)]
    if more := ", ".join(type(e).__name__ for e in others if not isinstance(e, known)):
        raise PlanError(
            f"the time at a constant force knows the film and its meniscus, not {more}; impose "
            f"the force, ImposedForce(force=..., mass=...), to get the motion"
        )
    meniscus, loading = plan.scene.meniscus, plan.scene.loading
    state = meniscus.liquid.at(plan.scene.temperature)
    assert state.viscosity is not None  # plan() has asked lacks() first
    wetting_tension = 0.0
    if plan.has(MeniscusForce):
        assert state.surface_tension is not None
        wetting = math.cos(meniscus.contact_angle_lower) + math.cos(meniscus.contact_angle_upper)
        wetting_tension = state.surface_tension * wetting
    film = film_shape(plan.scene, constant_radius=keeps_radius(plan.scene))
    share = pull / film.menisci
    if not plan.scene.interface.is_flat:
        return _sphere_time(plan, film, wetting_tension, share)
    turn = min(max(film.full_gap, loading.initial_gap), loading.final_gap)
    time = 0.0
    if loading.initial_gap < turn:
        time += constant_force.disc_time_flooded(
            film.rim, loading.initial_gap, turn, state.viscosity, wetting_tension, share
        )
    if turn < loading.final_gap:
        time += constant_force.disc_time_conserved(
            film.volume, turn, loading.final_gap, state.viscosity, wetting_tension, share
        )
    return time


def _sphere_time(plan: Plan, film: FilmShape, wetting_tension: float, pull: float) -> float:
    from scipy.integrate import quad

    loading, law = plan.scene.loading, plan.film.laws[ViscousForce]

    def laplace(gap: float) -> float:
        share = 1.0 - gap / film.height(gap)
        return 2.0 * math.pi * film.sphere_radius * wetting_tension * share

    if pull <= max(laplace(loading.initial_gap), laplace(loading.final_gap)):
        return math.inf

    def integrand(log_gap: float) -> float:
        gap = math.exp(log_gap)
        return gap * law.force(gap, 1.0) / film.menisci / (pull - laplace(gap))

    low, high = math.log(loading.initial_gap), math.log(loading.final_gap)
    value, _ = quad(integrand, low, high, epsabs=0.0, epsrel=1e-11, limit=500)
    return float(value)
