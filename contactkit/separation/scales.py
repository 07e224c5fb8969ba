"""Reference scales of a separation: capillary force, viscous impulse, and the film's time."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

from ..scene.loading import ImposedForce
from ..scene.scales import Scale, Scales, scales_of
from .effects.asperities import AsperityMenisci
from .effects.meniscus import MeniscusForce
from .effects.viscous import ViscousForce

if TYPE_CHECKING:
    from .plan import Plan

__all__ = ["separation_scales"]

_ROUND_OFF = 1e-12  # of a sum of cosines that is zero


def separation_scales(plan: Plan) -> Scales:
    r"""Scales of a separation, by unit; what a scene does not determine has none.

    Notes
    -----
    With n menisci, each of the radius x at the start (that of an upright rim):

    ===== ====== ===============================================================================
    unit  name   definition
    ===== ====== ===============================================================================
    m     h0     initial gap; rms height of a population of asperities; height of the film at
                 its rim under a touching sphere
    m2    A0     :math:`n \pi x^2`
    N     F0     of a meniscus: :math:`n \pi x^2 \gamma |c_1 + c_2|/h_0` between flats,
                 :math:`2 n \pi R \gamma |c_1 + c_2|` under a sphere; without one the imposed pull
    N.s   I0     of a viscous film: :math:`3 n \pi \eta x^4/(4 h_0^2)`, :math:`6 n \pi \eta R^2`
    s     t0     I0/F0
    m/s   h0/t0
    Pa    F0/A0
    J     F0 h0
    ===== ====== ===============================================================================
    """
    force, impulse = _force(plan), _impulse(plan)
    return scales_of(_derived({"m": _length(plan), "m2": _area(plan), "N": force, "N.s": impulse}))


def _length(plan: Plan) -> Scale:
    gap, rough = plan.scene.initial_gap, plan.scene.effect(AsperityMenisci)
    if rough is not None and rough.asperities.rms_height > 0.0:
        return Scale(rough.asperities.rms_height, "rms", "rms height of the asperities")
    if gap > 0.0:
        return Scale(gap, "h0", "initial gap")
    return Scale(plan.prepared.film.height(gap), "h0", "initial height of the film at its rim")


def _area(plan: Plan) -> Scale:
    film = plan.prepared.film
    x = film.radius(plan.scene.initial_gap)
    return Scale(film.menisci * math.pi * x * x, "A0", "area of the film at the start, pi x^2")


def _force(plan: Plan) -> Scale:
    """Capillary force of a meniscus; else the imposed pull, 0 where there is none."""
    film, scene = plan.prepared.film, plan.scene
    gamma = plan.prepared.liquid.given("surface_tension")
    if plan.has(MeniscusForce) or plan.has(AsperityMenisci):
        wetting = abs(math.cos(plan.prepared.angles.lower) + math.cos(plan.prepared.angles.upper))
        tension = (gamma or 0.0) * (wetting if wetting > _ROUND_OFF else 0.0)
        if math.isfinite(film.sphere_radius):
            force = film.menisci * 2.0 * math.pi * film.sphere_radius * tension
            return Scale(force, "F0", "2 pi R gamma |cos + cos|")
        force = _area(plan).value * tension / (scene.initial_gap or math.inf)
        return Scale(force, "F0", "pi x^2 gamma |cos + cos|/h0")
    loading = scene.loading
    return Scale(abs(loading.force) if isinstance(loading, ImposedForce) else 0.0, "F0", "pull")


def _impulse(plan: Plan) -> Scale:
    """Impulse of a viscous film; 0 where there is none."""
    film, gap = plan.prepared.film, plan.scene.initial_gap
    given = plan.prepared.liquid.given("viscosity") if plan.has(ViscousForce) else None
    viscosity = film.menisci * (given or 0.0)
    if math.isfinite(film.sphere_radius):
        impulse = 6.0 * math.pi * viscosity * film.sphere_radius * film.sphere_radius
        return Scale(impulse, "I0", "6 pi eta R^2")
    ratio = film.radius(gap) / (gap or math.inf)
    impulse = 0.75 * math.pi * viscosity * (film.radius(gap) * ratio) * ratio * film.radius(gap)
    return Scale(impulse, "I0", "3 pi eta x^4/(4 h0^2)")


def _derived(known: dict[str, Scale]) -> dict[str, Scale]:
    """Add the scales that follow from those of length, area, force and impulse."""
    found = dict(scales_of(known))
    force, length, area = found.get("N"), found.get("m"), found.get("m2")
    if force is None:
        return found
    if area is not None:
        found["Pa"] = Scale(force.value / area.value, "F0/A0", "force over area")
    if length is not None:
        found["J"] = Scale(force.value * length.value, f"F0 {length.name}", "force times length")
    if "N.s" in found:
        time = Scale(found["N.s"].value / force.value, "t0", "I0/F0")
        found["s"] = time
        if length is not None:
            found["m/s"] = Scale(length.value / time.value, f"{length.name}/t0", "length over time")
    return found
