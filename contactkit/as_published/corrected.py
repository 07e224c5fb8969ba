"""Corrected values of the printed equations: exact bridges, films of constant volume.

Every function takes the arguments of its equation. Where no corrected value exists, such as beyond
the stability limit of a bridge, InfeasibleError states why. Imports are deferred.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Any

from ..errors import InfeasibleError

__all__ = [
    "break_gap",
    "film_volume",
    "kelvin_radius",
    "laplace_sphere",
    "meniscus_at_volume",
    "meniscus_divided",
    "meniscus_flat",
    "meniscus_of_n",
    "meniscus_rough",
    "meniscus_sphere",
    "meniscus_touching",
    "printed_break_gap",
    "printed_film_volume",
    "printed_rough",
    "printed_sphere",
    "pressure_inside",
    "refuse_wide_film",
    "sphere_height",
    "viscous_divided",
    "viscous_far",
    "viscous_flat",
    "viscous_lifted",
    "viscous_number",
    "viscous_of_n",
    "viscous_sphere",
]


def _exact(
    gap: float, volume: float, tension: float, lower: float, upper: float, radius: float = math.inf
) -> float:
    """Force [N] of the exact bridge on a flat, under another one or under a sphere."""
    from ..capillary.exact.bridge import bridge

    return tension * float(bridge(gap, volume, lower, upper, 0.0, 1.0 / radius).force)


def meniscus_at_volume(
    gap: float, volume: float, surface_tension: float, angle_lower: float, angle_upper: float
) -> float:
    """Exact force [N] between flats of a bridge of given volume."""
    return _exact(gap, volume, surface_tension, angle_lower, angle_upper)


def _arc_volume(radius: float, gap: float, lower: float, upper: float, pulled: str) -> float:
    """Volume [m3] of the arc between flats with this contact circle on the pulled body."""
    from ..capillary.arc import flat as arc_flat

    arc = arc_flat.shape(lower, upper)
    circle = radius if pulled == "lower" else radius - gap * arc.upper_offset
    if not min(circle, arc_flat.neck(arc, gap, circle)) > 0.0:
        raise InfeasibleError(
            f"no arc spans a gap of {gap:g} m with a contact circle of {radius:g} m: its neck "
            f"would be closed"
        )
    return arc_flat.volume(arc, gap, circle)


def meniscus_flat(
    radius: float,
    gap: float,
    surface_tension: float,
    angle_lower: float,
    angle_upper: float,
    pulled: str = "lower",
) -> float:
    """Exact force [N] between flats; the volume is that of the arc with this contact circle."""
    film = (radius, gap, surface_tension, angle_lower, angle_upper)
    return meniscus_of_n(*film, 1.0, pulled)


def meniscus_of_n(
    radius: float,
    gap: float,
    surface_tension: float,
    angle_lower: float,
    angle_upper: float,
    number: float,
    pulled: str = "lower",
) -> float:
    """Exact force [N] of one of N equal menisci of the volume of the undivided arc."""
    volume = _arc_volume(radius, gap, angle_lower, angle_upper, pulled) / number
    return _exact(gap, volume, surface_tension, angle_lower, angle_upper)


def meniscus_divided(
    radius: float,
    gap: float,
    surface_tension: float,
    angle_lower: float,
    angle_upper: float,
    number: float,
    pulled: str = "lower",
) -> float:
    """Exact force [N] of N equal menisci, together of the volume of the undivided arc."""
    film = (radius, gap, surface_tension, angle_lower, angle_upper, number, pulled)
    return number * meniscus_of_n(*film)


def printed_sphere(
    sphere_radius: float,
    gap: float,
    volume: float,
    surface_tension: float,
    angle_lower: float,
    angle_upper: float,
) -> float:
    """Eq. (3.12) [N] of the arc of a volume under a paraboloid."""
    from ..capillary.arc import sphere as arc_sphere
    from .printed import common as published

    shape = (angle_lower, angle_upper, 0.0, 1.0 / sphere_radius)
    state = arc_sphere.solve(gap, volume, *shape, profile="parabola")
    if not bool(state.found):
        raise InfeasibleError(
            f"Eq. (3.12) has no value: no arc of {volume:g} m3 spans a gap of {gap:g} m"
        )
    return float(published.meniscus_sphere_3_12(state, surface_tension, angle_upper))


def meniscus_sphere(
    sphere_radius: float,
    gap: float,
    volume: float,
    surface_tension: float,
    angle_lower: float,
    angle_upper: float,
) -> float:
    """Exact force [N] on a sphere."""
    return _exact(gap, volume, surface_tension, angle_lower, angle_upper, sphere_radius)


def laplace_sphere(
    sphere_radius: float,
    gap: float,
    immersion: float,
    surface_tension: float,
    angle_lower: float,
    angle_upper: float,
) -> float:
    """Exact force [N] on a sphere; the volume is that of the film with a cylindrical rim."""
    volume = math.pi * sphere_radius * immersion * (immersion + 2.0 * gap)
    return _exact(gap, volume, surface_tension, angle_lower, angle_upper, sphere_radius)


def meniscus_touching(
    sphere_radius: float,
    surface_tension: float,
    angle_lower: float,
    angle_upper: float,
    filling_angle: float,
) -> float:
    """Exact force [N] on a touching sphere; the volume is that of the arc of a filling angle."""
    from ..capillary.arc import sphere as arc_sphere

    circle = sphere_radius * math.sin(filling_angle)
    shape = (angle_lower, angle_upper, 0.0, 1.0 / sphere_radius)
    volume = arc_sphere.volume(0.0, circle, *shape)
    return _exact(0.0, volume, surface_tension, angle_lower, angle_upper, sphere_radius)


def refuse_wide_film(given: Mapping[str, Any]) -> None:
    """Refuse a film under a paraboloid that is wider than the sphere it stands for.

    Of N asperities side by side each has the room of its own sphere, of radius R/n.

    Raises
    ------
    InfeasibleError
        If the film is wider; says how high, or how finely divided, it may be.
    """
    if not {"sphere_radius", "film_height"} <= set(given):
        return
    radius, number = given["sphere_radius"], given.get("number", 1.0)
    gap = given.get("gap", given.get("gap_start", given.get("height")))
    depth, room = given["film_height"] - gap, radius / math.sqrt(number)
    if 2.0 * depth <= room * (1.0 + 1e-12):
        return
    if number > 1.0 and 2.0 * depth <= radius:
        raise InfeasibleError(
            f"menisci of neighbouring asperities overlap: keep n = sqrt(number) below "
            f"R/(2 (s - D)) = {radius / (2.0 * depth):.4g}"
        )
    raise InfeasibleError(
        f"the film would be wider than the sphere of radius {radius:g} m; keep its height at the "
        f"rim below {gap + 0.5 * radius:.4g} m"
    )


def printed_rough(
    sphere_radius: float,
    gap: float,
    film_height: float,
    surface_tension: float,
    angle_lower: float,
    angle_upper: float,
    number: float,
) -> float:
    """Eq. (3.14) [N] of N asperities of radius R/n, each by Eq. (3.12)."""
    small = sphere_radius / math.sqrt(number)
    angles = (angle_lower, angle_upper)
    volume = film_volume(small, gap, film_height, *angles)
    return number * printed_sphere(small, gap, volume, surface_tension, *angles)


def meniscus_rough(
    sphere_radius: float,
    gap: float,
    film_height: float,
    surface_tension: float,
    angle_lower: float,
    angle_upper: float,
    number: float,
) -> float:
    """Exact force [N] of N asperities of radius R/n with separate menisci."""
    small = sphere_radius / math.sqrt(number)
    volume = film_volume(small, gap, film_height, angle_lower, angle_upper)
    one = _exact(gap, volume, surface_tension, angle_lower, angle_upper, small)
    return number * one


def printed_film_volume(
    sphere_radius: float, gap: float, film_height: float, angle_lower: float, angle_upper: float
) -> float:
    """Eq. (3.23) [m3], which does not contain the contact angles."""
    from .printed.films import film_volume_3_23

    return float(film_volume_3_23(sphere_radius, gap, film_height))


def film_volume(
    sphere_radius: float, gap: float, film_height: float, angle_lower: float, angle_upper: float
) -> float:
    """Volume of revolution [m3] of the arc under a paraboloid wetted up to a height."""
    from ..capillary.arc import sphere as arc_sphere

    circle = math.sqrt(2.0 * sphere_radius * (film_height - gap))
    shape = (angle_lower, angle_upper, 0.0, 1.0 / sphere_radius)
    return float(arc_sphere.volume(gap, circle, *shape, profile="parabola"))


def kelvin_radius(
    surface_tension: float, molar_volume: float, temperature: float, relative_humidity: float
) -> float:
    """Kelvin radius [m], positive."""
    from ..capillary import kelvin

    vapour = (molar_volume, temperature, relative_humidity)
    return float(kelvin.kelvin_radius(surface_tension, *vapour))


def sphere_height(sphere_radius: float, gap: float, position: float) -> float:
    """Height [m] of the sphere itself."""
    if position > sphere_radius:
        raise InfeasibleError(f"the sphere ends at its radius of {sphere_radius:g} m")
    rest = math.sqrt((sphere_radius - position) * (sphere_radius + position))
    return gap + position * position / (sphere_radius + rest)


def printed_break_gap(
    volume: float,
    angle_lower: float,
    angle_upper: float,
    curvature_lower: float = 0.0,
    curvature_upper: float = 0.0,
) -> float:
    """Gap [m] at which the neck of the arc closes, with paraboloids for spheres."""
    from ..capillary.arc import sphere as arc_sphere

    shape = (angle_lower, angle_upper, curvature_lower, curvature_upper)
    return float(arc_sphere.zero_neck_gap(volume, *shape, profile="parabola"))


def break_gap(
    volume: float,
    angle_lower: float,
    angle_upper: float,
    curvature_lower: float = 0.0,
    curvature_upper: float = 0.0,
) -> float:
    """Stability limit [m] of the exact bridge."""
    from ..capillary.exact.stability import stability_limit

    bodies = (curvature_lower, curvature_upper)
    return float(stability_limit(volume, angle_lower, angle_upper, *bodies).gap)


def pressure_inside(
    gap: float, radius: float, position: float, speed: float, viscosity: float
) -> float:
    """Pressure [Pa] over ambient between opening flats, which ends at the rim of the film."""
    from .printed.films import pressure_3_16

    if position > radius:
        raise InfeasibleError(
            f"no film at {position:g} m from the axis: it ends at {radius:g} m, with the ambient "
            f"pressure"
        )
    return float(pressure_3_16(gap, radius, position, speed, viscosity))


def viscous_flat(
    radius: float, gap_start: float, gap_end: float, separation_time: float, viscosity: float
) -> float:
    """Impulse over time [N] of a film of constant volume."""
    from ..lubrication.squeeze_film import disc_impulse_conserved

    volume = math.pi * radius**2 * gap_start
    impulse = disc_impulse_conserved(volume, gap_start, gap_end, viscosity)
    return float(impulse) / separation_time


def viscous_of_n(
    radius: float,
    gap_start: float,
    gap_end: float,
    separation_time: float,
    viscosity: float,
    number: float,
) -> float:
    """Impulse over time [N] of one of N films of constant volume."""
    small = radius / math.sqrt(number)
    return viscous_flat(small, gap_start, gap_end, separation_time, viscosity)


def viscous_divided(
    radius: float,
    gap_start: float,
    gap_end: float,
    separation_time: float,
    viscosity: float,
    number: float,
) -> float:
    """Impulse over time [N] of N films of constant volume."""
    film = (radius, gap_start, gap_end, separation_time, viscosity, number)
    return number * viscous_of_n(*film)


def viscous_far(
    radius: float, gap_start: float, separation_time: float, viscosity: float, number: float
) -> float:
    """Impulse over time [N] of N films of constant volume with rupture far away."""
    return viscous_divided(radius, gap_start, math.inf, separation_time, viscosity, number)


def viscous_sphere(
    sphere_radius: float,
    gap_start: float,
    film_height: float,
    separation_time: float,
    viscosity: float,
) -> float:
    """Impulse over time [N] of a sphere lifted far away, the limit of Eq. (3.26)."""
    film = (sphere_radius, gap_start, film_height, math.inf, separation_time, viscosity)
    return viscous_lifted(*film)


def viscous_lifted(
    sphere_radius: float,
    gap_start: float,
    film_height: float,
    gap_end: float,
    separation_time: float,
    viscosity: float,
) -> float:
    """Impulse over time [N] of a lifted sphere with a film of constant volume."""
    from ..lubrication.squeeze_film import sphere_impulse_conserved

    film = (sphere_radius, film_height, gap_start, gap_end, viscosity)
    return float(sphere_impulse_conserved(*film)) / separation_time


def viscous_number(
    force: float, radius: float, gap_start: float, separation_time: float, viscosity: float
) -> float:
    """Force over that of a film of constant volume with rupture far away [-]."""
    return force / viscous_flat(radius, gap_start, math.inf, separation_time, viscosity)
