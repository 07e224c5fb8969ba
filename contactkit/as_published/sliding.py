"""Printed equations of tangential separation, as rows of `PUBLISHED`, with corrected values.

The printed forces are impulses over the separation time: means, not forces at rupture.
"""

from __future__ import annotations

import math

from ..errors import InfeasibleError
from .arguments import PublishedFormula as Row
from .printed import sliding as printed

__all__ = ["SLIDING_ROWS"]


def _times(force: float, number: float) -> float:
    return number * force


def _shear_stress(gap: float, speed: float, viscosity: float) -> float:
    return viscosity * speed / gap


def _lens_area(radius: float, travel: float) -> float:
    from ..lubrication.couette_flat import lens_area

    return float(lens_area(radius, travel))


def _wetted_radius(sphere_radius: float, gap: float, film_height: float) -> float:
    return math.sqrt(2.0 * sphere_radius * (film_height - gap))


def _circle_on_sphere(sphere_radius: float, gap: float, film_height: float) -> float:
    depth = film_height - gap
    if depth > sphere_radius:
        raise InfeasibleError(
            f"the film covers the equator of the sphere: keep its height below "
            f"{gap + sphere_radius:.4g} m"
        )
    return math.sqrt(depth * (2.0 * sphere_radius - depth))


def _impulse_flat(radius: float, gap: float, viscosity: float) -> float:
    return float(printed.sliding_flat_3_53(radius, gap, 1.0, viscosity))


def _mean_flat(radius: float, gap: float, separation_time: float, viscosity: float) -> float:
    from ..lubrication.couette_flat import flat_impulse

    return float(flat_impulse(radius, gap, 2.0 * radius, viscosity)) / separation_time


def _mean_sphere(
    sphere_radius: float, gap: float, film_height: float, separation_time: float, viscosity: float
) -> float:
    from ..lubrication.couette_sphere import sphere_impulse

    if gap == 0.0:
        raise InfeasibleError(
            "at a gap of zero the drag is infinite: it grows as ln(s/D); give a gap above zero, "
            "such as the roughness or 0.2 to 0.3 nm"
        )
    return float(sphere_impulse(sphere_radius, gap, film_height, viscosity)) / separation_time


def _printed_3_58(
    sphere_radius: float,
    gap: float,
    film_height: float,
    separation_time: float,
    viscosity: float,
    number: float,
) -> float:
    small = sphere_radius / math.sqrt(number)
    film = (gap, film_height, separation_time, viscosity)
    return float(printed.sliding_sphere_3_56(small, *film))


def _one_sphere(
    sphere_radius: float,
    gap: float,
    film_height: float,
    separation_time: float,
    viscosity: float,
    number: float,
) -> float:
    small = sphere_radius / math.sqrt(number)
    return _mean_sphere(small, gap, film_height, separation_time, viscosity)


def _all_spheres(
    sphere_radius: float,
    gap: float,
    film_height: float,
    separation_time: float,
    viscosity: float,
    number: float,
) -> float:
    film = (sphere_radius, gap, film_height, separation_time, viscosity, number)
    return number * _one_sphere(*film)


def _printed_3_60(
    radius: float, gap: float, separation_time: float, viscosity: float, number: float
) -> float:
    film = (radius / math.sqrt(number), gap, separation_time, viscosity)
    return float(printed.sliding_flat_3_53(*film))


def _all_flats(
    radius: float, gap: float, separation_time: float, viscosity: float, number: float
) -> float:
    small = radius / math.sqrt(number)
    return number * _mean_flat(small, gap, separation_time, viscosity)


_FLAT = ("radius", "gap", "separation_time", "viscosity")
_SPHERE = ("sphere_radius", "gap", "film_height", "separation_time", "viscosity")
_MEAN = "impulse over the lens, over the separation time"
_LOCAL = "impulse over the lens with the local film, over the separation time"

SLIDING_ROWS: tuple[Row, ...] = (
    Row(
        "3.44",
        "shear stress of a Couette film",
        "eta v/h0",
        ("gap", "speed", "viscosity"),
        "Pa",
        _shear_stress,
    ),
    Row(
        "3.49",
        "overlap of the two circles",
        "2 x^2 (arccos q - q sqrt(1 - q^2)), q = L/(2 x)",
        ("radius", "travel"),
        "m2",
        _lens_area,
    ),
    Row(
        "3.52",
        "viscous impulse of sliding flats",
        "8 eta x^3/(3 h0)",
        ("radius", "gap", "viscosity"),
        "N.s",
        _impulse_flat,
    ),
    Row(
        "3.53",
        "viscous force on sliding flats",
        "8 eta x^3/(3 t_s h0)",
        _FLAT,
        "N",
        printed.sliding_flat_3_53,
        _mean_flat,
        _MEAN,
    ),
    Row(
        "3.55",
        "radius of the film under a sphere",
        "sqrt(2 R (s - D))",
        ("sphere_radius", "gap", "film_height"),
        "m",
        _wetted_radius,
        _circle_on_sphere,
        "circle on the sphere itself",
        any_film=True,
    ),
    Row(
        "3.56",
        "viscous force on a sliding sphere",
        "8 eta (2 R (s - D))^(3/2)/(3 t_s s)",
        _SPHERE,
        "N",
        printed.sliding_sphere_3_56,
        _mean_sphere,
        _LOCAL,
    ),
    Row(
        "3.57",
        "viscous force of N equal sliding menisci",
        "N F_v",
        ("force", "number"),
        "N",
        _times,
    ),
    Row(
        "3.58",
        "viscous force on one of N sliding asperities",
        "8 eta (2 R/sqrt(N) (s - D))^(3/2)/(3 t_s s)",
        (*_SPHERE, "number"),
        "N",
        _printed_3_58,
        _one_sphere,
        _LOCAL,
        ("3.56",),
    ),
    Row(
        "3.59",
        "viscous force on N sliding asperities side by side",
        "8 eta (2 R (s - D))^(3/2)/(3 t_s s sqrt(N))",
        (*_SPHERE, "number"),
        "N",
        printed.sliding_sphere_divided_3_59,
        _all_spheres,
        _LOCAL + ", N times",
    ),
    Row(
        "3.60",
        "viscous force on one of N sliding menisci",
        "8 eta (x/sqrt(N))^3/(3 t_s h0)",
        (*_FLAT, "number"),
        "N",
        _printed_3_60,
        _printed_3_60,
        _MEAN,
        ("3.53",),
    ),
    Row(
        "3.61",
        "viscous force on N sliding menisci side by side",
        "8 eta x^3/(3 t_s h0 sqrt(N))",
        (*_FLAT, "number"),
        "N",
        printed.sliding_flat_divided_3_61,
        _all_flats,
        _MEAN + ", N times",
    ),
    Row(
        "3.62",
        "viscous force on sliding flats made dimensionless",
        "t_s F_v/(eta x^2)",
        ("force", "radius", "separation_time", "viscosity"),
        "-",
        printed.sliding_number_3_62,
    ),
    Row(
        "3.63",
        "viscous force on a sliding sphere made dimensionless",
        "t_s F_v/(eta R^2)",
        ("force", "sphere_radius", "separation_time", "viscosity"),
        "-",
        printed.sliding_number_3_63,
    ),
)
