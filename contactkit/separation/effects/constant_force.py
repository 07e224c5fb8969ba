"""Time to open the film of a scene under a constant pull, without inertia."""

from __future__ import annotations

import itertools
import math
from typing import TYPE_CHECKING

from ...errors import PlanError
from ...lubrication import constant_force
from .base import ForceLaw, SeparationForce
from .film_shape import FilmShape
from .meniscus import MeniscusForce

if TYPE_CHECKING:
    from ...scene.scenes import SeparationScene
    from .prepared import PreparedScene

__all__ = ["constant_force_time"]


def constant_force_time(
    prepared: PreparedScene[SeparationScene], film: FilmShape, viscous: ForceLaw, pull: float
) -> float:
    """Time [s] to open the gap of a scene under a constant pull [N]; inf if it never does.

    Thin film: the meniscus, where the scene has one, pulls with its Laplace pressure only; no
    inertia, no limits of the liquid. Closed form between flats, quadrature on a sphere.

    Raises
    ------
    PlanError
        If the scene has another force, or a viscosity over pressure or shear, which this does not
        know.
    """
    scene, viscosity = prepared.scene, prepared.liquid.viscosity
    forces = {type(e) for e in scene.effects if isinstance(e, SeparationForce)}
    known = ("meniscus_force", "viscous_force")
    if more := ", ".join(sorted(k.__name__ for k in forces if k.column.name not in known)):
        raise PlanError(
            f"the time at a constant force knows the film and its meniscus, not {more}; impose "
            f"the force, ImposedForce(force=..., mass=...), to get the motion"
        )
    rheology, wetting_tension = prepared.rheology, 0.0
    if rheology is not None and not rheology.is_linear:
        raise PlanError(
            "the time at a constant force knows one viscosity at all pressures and rates of shear; "
            "impose the force, ImposedForce(force=...), to get the motion"
        )
    if MeniscusForce in forces:
        wetting_tension = prepared.liquid.surface_tension * prepared.wetting
    pull_each, loading = pull / film.menisci, scene.loading
    if not scene.interface.is_flat or rheology is not None:
        return _time_of_law(prepared, film, viscous, wetting_tension, pull_each)
    turn = min(max(film.full_gap, loading.initial_gap), loading.final_gap)
    time = 0.0
    if loading.initial_gap < turn:
        time += constant_force.disc_time_flooded(
            film.rim, loading.initial_gap, turn, viscosity, wetting_tension, pull_each
        )
    if turn < loading.final_gap:
        time += constant_force.disc_time_conserved(
            film.volume, turn, loading.final_gap, viscosity, wetting_tension, pull_each
        )
    return time


def _time_of_law(
    prepared: PreparedScene[SeparationScene],
    film: FilmShape,
    viscous: ForceLaw,
    wetting_tension: float,
    pull: float,
) -> float:
    """Time [s] of a force that is proportional to the speed, by quadrature."""
    from scipy.integrate import quad

    loading = prepared.scene.loading

    def laplace(gap: float) -> float:
        if math.isinf(film.sphere_radius):
            return math.pi * film.radius(gap) ** 2 * wetting_tension / gap
        wetted = 1.0 - gap / film.height(gap)
        return 2.0 * math.pi * film.sphere_radius * wetting_tension * wetted

    if pull <= max(laplace(loading.initial_gap), laplace(loading.final_gap)):
        return math.inf

    def integrand(log_gap: float) -> float:
        gap = math.exp(log_gap)
        return gap * viscous.force(gap, 1.0) / film.menisci / (pull - laplace(gap))

    low, high = math.log(loading.initial_gap), math.log(loading.final_gap)
    kinks = [math.log(kink) for kink in viscous.kinks]
    marks = [low, *(kink for kink in kinks if low < kink < high), high]
    pieces = itertools.pairwise(marks)
    return sum(quad(integrand, *one, epsabs=0.0, epsrel=1e-11, limit=500)[0] for one in pieces)
