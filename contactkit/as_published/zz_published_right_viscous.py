"""The right value beside each printed viscous equation: films that keep their volume.

Every function takes the arguments of its equation.
"""

from __future__ import annotations

import math

__all__ = [
    "viscous_divided", "viscous_far", "viscous_flat", "viscous_lifted", "viscous_number",
    "viscous_of_n", "viscous_sphere",
]  # fmt: skip


def viscous_flat(
    radius: float, gap_start: float, gap_end: float, separation_time: float, viscosity: float
) -> float:
    """Impulse over time [N] of a film that keeps its volume."""
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
    """Impulse over time [N] of one of N films that keep their volume."""
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
    """Impulse over time [N] of N films that keep their volume."""
    film = (radius, gap_start, gap_end, separation_time, viscosity, number)
    return number * viscous_of_n(*film)


def viscous_far(
    radius: float, gap_start: float, separation_time: float, viscosity: float, number: float
) -> float:
    """Impulse over time [N] of N films that keep their volume and break far away."""
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
    """Impulse over time [N] of a lifted sphere whose film keeps its volume."""
    from ..lubrication.squeeze_film import sphere_impulse_conserved

    film = (sphere_radius, film_height, gap_start, gap_end, viscosity)
    return float(sphere_impulse_conserved(*film)) / separation_time


def viscous_number(
    force: float, radius: float, gap_start: float, separation_time: float, viscosity: float
) -> float:
    """Force over that of a film which keeps its volume and breaks far away [-]."""
    return force / viscous_flat(radius, gap_start, math.inf, separation_time, viscosity)
