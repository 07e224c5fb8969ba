"""What is wrong with the printed equations a scene takes, at its start, with the right values."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from types import MappingProxyType
from typing import Any

from ..as_published.arguments import PublishedValue
from ..errors import ConvergenceError, InfeasibleError
from .effects.as_published import printed_equations
from .effects.film_shape import FilmShape, film_shape
from .plan import Plan

__all__ = ["scene_errata"]


def scene_errata(plan: Plan) -> tuple[PublishedValue, ...]:
    """Printed equations that a plan takes, each with its value at the start and the right one.

    Forces are those of all menisci together; a force that the source averages over the
    separation time is given as its impulse [N.s], which no time changes. Empty for a scene that
    takes no printed equation that is wrong.
    """
    found = []
    for effect, number in printed_equations(plan.scene):
        made = _NOTES[effect.name](plan, number, effect)
        found.append(made._replace(name=f"{effect.name}, {made.name}"))
    return tuple(found)


def _wetted(plan: Plan) -> dict[str, float]:
    meniscus = plan.scene.meniscus
    return {
        "angle_lower": meniscus.contact_angle_lower,
        "angle_upper": meniscus.contact_angle_upper,
    }


def _meniscus(plan: Plan, number: str, effect: Any) -> PublishedValue:
    from ..as_published.lookup import published

    scene, film = plan.scene, film_shape(plan.scene)
    gap, count = scene.loading.initial_gap, film.menisci
    tension = scene.meniscus.liquid.at(scene.temperature).surface_tension
    given = {"gap": gap, "surface_tension": tension, **_wetted(plan)}
    if not scene.interface.is_flat:
        sphere = film.sphere_radius
        return _times(
            published(number, sphere_radius=sphere, volume=film.volume, **given), float(count)
        )
    if count > 1:
        given["number"] = count
    radius = film.radius(gap) * math.sqrt(count)
    made = published(number, radius=radius, pulled=effect.pulled, **given)
    return made if gap < film.full_gap else _at_volume(plan, film, made)


def _at_volume(plan: Plan, film: FilmShape, made: PublishedValue) -> PublishedValue:
    """The exact bridge of the volume of the scene, between flats."""
    from ..as_published.corrected import meniscus_at_volume

    gap, wetted = plan.scene.loading.initial_gap, _wetted(plan)
    tension = plan.scene.meniscus.liquid.at(plan.scene.temperature).surface_tension
    assert tension is not None  # plan() has asked lacks() first
    try:
        one = meniscus_at_volume(gap, film.volume, tension, *wetted.values())
    except (InfeasibleError, ConvergenceError) as reason:
        return made._replace(corrected=None, corrected_by=str(reason))
    by = "exact bridge of the volume of the scene"
    return made._replace(corrected=film.menisci * one, corrected_by=by)


def _times(made: PublishedValue, number: float) -> PublishedValue:
    right = None if made.corrected is None else number * made.corrected
    return made._replace(value=number * made.value, corrected=right)


def _viscous(plan: Plan, number: str, effect: Any) -> PublishedValue:
    from ..as_published.lookup import published

    scene, film = plan.scene, film_shape(plan.scene)
    loading, count = scene.loading, film.menisci
    start, end = loading.initial_gap, min(loading.final_gap, plan.film.end)
    viscosity = scene.meniscus.liquid.at(scene.temperature).viscosity
    # Over a time of one second, so that the number is the impulse.
    given = {
        "gap_start": start,
        "gap_end": end,
        "separation_time": 1.0,
        "viscosity": viscosity,
    }
    if not scene.interface.is_flat:
        height = film.height(start)
        shape = {"sphere_radius": film.sphere_radius, "film_height": height}
        made = _times(published(number, **shape, **given), float(count))
    else:
        radius = film.radius(start) * math.sqrt(count)
        more = {"number": count} if count > 1 else {}
        made = published(number, radius=radius, **given, **more)
    if math.isinf(film.volume) and scene.interface.is_flat:
        by = "as printed, right for a film that stands in a bath"
        made = made._replace(corrected=made.value, corrected_by=by)
    return made._replace(name=f"{made.name}, times the separation time", unit="N.s")


def _break(plan: Plan, number: str, effect: Any) -> PublishedValue:
    from ..as_published.lookup import published

    lower, upper = plan.scene.interface.curvatures
    bent = {"curvature_lower": lower, "curvature_upper": upper}
    return published(number, volume=film_shape(plan.scene).volume, **_wetted(plan), **bent)


_NOTES: Mapping[str, Callable[[Plan, str, Any], PublishedValue]] = MappingProxyType(
    {"meniscus-force": _meniscus, "viscous-force": _viscous, "rupture": _break}
)
