r"""Equations of tangential separation as printed, by number, for reproduction only.

Each is the impulse of a Couette film over the separation time t_s: a mean force [N], positive when
it resists, not a force at rupture. Arguments are floats or arrays. `errata.ERRATA` lists the
errors; the correct forms are in `lubrication.couette_flat` and `lubrication.couette_reynolds`.
"""

from __future__ import annotations

from typing import Any

__all__ = [
    "sliding_flat_3_53",
    "sliding_flat_divided_3_61",
    "sliding_number_3_62",
    "sliding_number_3_63",
    "sliding_sphere_3_56",
    "sliding_sphere_divided_3_59",
]


def sliding_flat_3_53(radius: Any, gap: Any, separation_time: Any, viscosity: Any) -> Any:
    r"""Impulse of sliding flats over the separation time [N], Eq. (3.53).

    .. math:: \frac{8\eta x^3}{3 t_s h_0}

    Examples
    --------
    >>> round(sliding_flat_3_53(100e-9, 2e-9, 1e-7, 0.89e-3) * 1e9, 9)
    11.866666667
    """
    return 8.0 * viscosity * radius**3 / (3.0 * separation_time * gap)


def sliding_sphere_3_56(
    sphere_radius: Any, gap: Any, film_height: Any, separation_time: Any, viscosity: Any
) -> Any:
    r"""Impulse of a sliding sphere over the separation time [N], Eq. (3.56).

    .. math:: \frac{8\eta [2R(s - D)]^{3/2}}{3 t_s s}

    With the film thickness at the rim everywhere, so that the divergence for D to 0 is missing.

    Examples
    --------
    >>> round(sliding_sphere_3_56(100e-9, 1e-9, 2e-9, 1e-7, 0.89e-3) * 1e12, 6)
    33.564002
    """
    radius_squared = 2.0 * sphere_radius * (film_height - gap)
    return sliding_flat_3_53(radius_squared**0.5, film_height, separation_time, viscosity)


def sliding_sphere_divided_3_59(
    sphere_radius: Any,
    gap: Any,
    film_height: Any,
    separation_time: Any,
    viscosity: Any,
    number: Any,
) -> Any:
    """Impulse over time [N] of asperities that fill the area of one sphere, Eq. (3.59).

    Eq. (3.56) over the root of the number; correct is a factor of its fourth root.

    Examples
    --------
    >>> one = sliding_sphere_3_56(1.0, 1.0, 2.0, 1.0, 1.0)
    >>> sliding_sphere_divided_3_59(1.0, 1.0, 2.0, 1.0, 1.0, 4) / one
    0.5
    """
    whole = sliding_sphere_3_56(sphere_radius, gap, film_height, separation_time, viscosity)
    return whole / number**0.5


def sliding_flat_divided_3_61(
    radius: Any, gap: Any, separation_time: Any, viscosity: Any, number: Any
) -> Any:
    """Impulse over time [N] of a film between flats divided into menisci, Eq. (3.61).

    Correct if each small meniscus takes the time t_s for its own, shorter travel; at a given speed
    the number has no effect.

    Examples
    --------
    >>> whole = sliding_flat_3_53(1.0, 1.0, 1.0, 1.0)
    >>> sliding_flat_divided_3_61(1.0, 1.0, 1.0, 1.0, 4) / whole
    0.5
    """
    return sliding_flat_3_53(radius, gap, separation_time, viscosity) / number**0.5


def sliding_number_3_62(force: Any, radius: Any, separation_time: Any, viscosity: Any) -> Any:
    r"""Dimensionless drag of flats, :math:`t_s F_v/(\eta x_n^2)`, Eq. (3.62).

    Examples
    --------
    >>> round(sliding_number_3_62(sliding_flat_3_53(2.0, 1.0, 1.0, 1.0), 2.0, 1.0, 1.0), 9)
    5.333333333
    """
    return separation_time * force / (viscosity * radius**2)


def sliding_number_3_63(
    force: Any, sphere_radius: Any, separation_time: Any, viscosity: Any
) -> Any:
    r"""Dimensionless drag of a sphere, :math:`t_s F_v/(\eta R^2)`, Eq. (3.63).

    Examples
    --------
    >>> force = sliding_sphere_3_56(100e-9, 1e-9, 2e-9, 1e-7, 0.89e-3)
    >>> round(sliding_number_3_63(force, 100e-9, 1e-7, 0.89e-3), 9)
    0.377123617
    """
    return sliding_number_3_62(force, sphere_radius, separation_time, viscosity)
