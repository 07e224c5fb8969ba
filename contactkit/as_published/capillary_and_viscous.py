"""Printed capillary and viscous equations: formula, arguments and correction of each."""

from __future__ import annotations

from typing import Any

from . import corrected as right
from . import corrected as viscous
from .arguments import PublishedFormula as Row
from .printed import common as printed
from .printed import films as films

__all__ = ["ROWS"]

_EXACT = "exact bridge of the same volume"
_EXACT_ARC = "exact bridge of the volume of the arc with this contact circle"
_DIVIDED = "exact bridge of one of N parts of the volume"
_CONSERVED = "impulse over time of a film of constant volume"
_ANGLES = ("angle_lower", "angle_upper")
_FLAT = ("radius", "gap", "surface_tension", *_ANGLES)
_SPHERE = ("sphere_radius", "gap", "volume", "surface_tension", *_ANGLES)
_OPENED = ("radius", "gap_start", "gap_end", "separation_time", "viscosity")
_LIFTED = ("sphere_radius", "gap_start", "film_height", "gap_end", "separation_time", "viscosity")
_FORCE_FLAT = "pi x^2 gamma (cos theta1 + cos theta2)/h + 2 pi gamma x sin theta(1 or 2)"
_FORCE_SPHERE = "pi x^2 gamma (1/r1 + 1/(x_c - r1)) + 2 pi R gamma sin phi sin(phi + theta2)"
_IMPULSE_SPHERE = (
    "6 pi eta R^2/t_s ln(D_s (D0 + H0)^2 S/(D0 H0 (D + S)^2)), S^2 = H0^2 - D0^2 + D_s^2"
)


def _times(force: float, number: float) -> float:
    return number * force


def _without_force(force: float, radius: float, surface_tension: float, *_: Any) -> float:
    return force / (radius * surface_tension)


def _suction(*given: float) -> float:
    return -float(films.pressure_sphere_3_21(*given))


_CAPILLARY = (
    Row(
        "3.3",
        "Kelvin radius",
        "gamma V/(R T ln(p/p0))",
        ("surface_tension", "molar_volume", "temperature", "relative_humidity"),
        "m",
        films.kelvin_radius_3_3,
        right.kelvin_radius,
        "Kelvin's equation, positive when hollow",
    ),
    Row(
        "3.4",
        "meniscus force by the Kelvin radius",
        "pi x^2 gamma/r_k + 2 pi gamma x sin theta",
        ("radius", "kelvin_radius", "surface_tension", "angle"),
        "N",
        films.meniscus_pressure_radius_3_4,
    ),
    Row(
        "3.5",
        "meniscus force between flats",
        _FORCE_FLAT,
        (*_FLAT, "pulled"),
        "N",
        printed.meniscus_flat_3_11,
        right.meniscus_flat,
        _EXACT_ARC,
    ),
    Row(
        "3.6",
        "Laplace force on a touching sphere",
        "2 pi R gamma (cos theta1 + cos theta2)",
        ("sphere_radius", "surface_tension", *_ANGLES),
        "N",
        films.laplace_sphere_3_6,
        by="as printed, correct for small volumes",
    ),
    Row(
        "3.7",
        "Laplace force on a sphere at a gap",
        "2 pi R gamma (cos theta1 + cos theta2)/(1 + D/d0)",
        ("sphere_radius", "gap", "immersion", "surface_tension", *_ANGLES),
        "N",
        printed.laplace_sphere_3_7,
        right.laplace_sphere,
        "exact bridge of the volume of the film, surface tension included",
    ),
    Row(
        "3.8",
        "Laplace force on a sphere above a continuous film",
        "2 pi R gamma (1 + cos theta)",
        ("sphere_radius", "surface_tension", "angle"),
        "N",
        printed.laplace_sphere_3_8,
        by="as printed, correct for a thin film",
    ),
    Row(
        "3.9",
        "surface tension at the contact line on a sphere",
        "2 pi R gamma sin phi sin(phi + theta2)",
        ("sphere_radius", "surface_tension", "filling_angle", "angle_upper"),
        "N",
        printed.line_tension_3_9,
    ),
    Row(
        "3.10",
        "static meniscus force on a touching sphere, as in Table 4.1",
        "2 pi R gamma (cos theta1 + cos theta2) + 2 pi R gamma sin phi sin(phi + theta2)",
        ("sphere_radius", "surface_tension", *_ANGLES, "filling_angle"),
        "N",
        films.meniscus_sphere_3_10,
        right.meniscus_touching,
        "exact bridge of the volume of the arc with this filling angle",
    ),
    Row(
        "3.11",
        "meniscus force between separating flats",
        _FORCE_FLAT,
        (*_FLAT, "pulled"),
        "N",
        printed.meniscus_flat_3_11,
        right.meniscus_flat,
        _EXACT_ARC,
    ),
    Row(
        "3.12",
        "meniscus force on a separating sphere",
        _FORCE_SPHERE,
        _SPHERE,
        "N",
        right.printed_sphere,
        right.meniscus_sphere,
        _EXACT,
    ),
    Row("3.13", "meniscus force of N equal menisci", "N F_m", ("force", "number"), "N", _times),
    Row(
        "3.14a",
        "meniscus force of N menisci side by side between flats",
        "N F_m(x/n)",
        (*_FLAT, "number", "pulled"),
        "N",
        printed.meniscus_divided_3_33,
        right.meniscus_divided,
        _DIVIDED + ", N times",
        ("3.11",),
    ),
    Row(
        "3.14b",
        "meniscus force of N asperities side by side",
        "N F_m(R/n)",
        ("sphere_radius", "gap", "film_height", "surface_tension", *_ANGLES, "number"),
        "N",
        right.printed_rough,
        right.meniscus_rough,
        _EXACT + ", N times",
        ("3.14", "3.12"),
    ),
    Row(
        "3.31",
        "meniscus force of one of N menisci",
        "pi x^2 gamma (cos theta1 + cos theta2)/(h N) + 2 pi gamma x/sqrt(N) sin theta(1 or 2)",
        (*_FLAT, "number", "pulled"),
        "N",
        films.meniscus_of_n_3_31,
        right.meniscus_of_n,
        _DIVIDED,
        ("3.11",),
    ),
    Row(
        "3.33",
        "meniscus force of a film divided into N menisci",
        "pi x^2 gamma (cos theta1 + cos theta2)/h + 2 sqrt(N) pi gamma x sin theta(1 or 2)",
        (*_FLAT, "number", "pulled"),
        "N",
        printed.meniscus_divided_3_33,
        right.meniscus_divided,
        _DIVIDED + ", N times",
    ),
    Row(
        "3.35",
        "meniscus force of N menisci from that of one",
        "sqrt(N) F_m-N",
        ("force", "number"),
        "N",
        films.meniscus_number_n_3_35,
        _times,
        "N F_m-N, by definition",
    ),
    Row(
        "3.37",
        "height of the sphere",
        "x^2/(2R) + D",
        ("sphere_radius", "gap", "position"),
        "m",
        films.sphere_shape_3_37,
        right.sphere_height,
        "the sphere itself",
    ),
    Row(
        "3.42",
        "meniscus force made dimensionless",
        "F_m/(pi x gamma (cos theta1 + cos theta2))",
        ("force", "radius", "surface_tension", *_ANGLES),
        "-",
        printed.meniscus_number_3_42,
        _without_force,
        "F_m/(gamma x), finite for every pair of angles",
    ),
    Row(
        "zero neck",
        "break distance",
        "gap at which the neck of the arc is closed",
        ("volume", *_ANGLES, "curvature_lower", "curvature_upper"),
        "m",
        right.printed_break_gap,
        right.break_gap,
        "stability limit of the exact bridge",
        may_be_infinite=True,  # between two right angles the neck never closes
    ),
)

_VISCOUS = (
    Row(
        "3.16",
        "pressure between opening flats",
        "3 eta h'/h^3 (r^2 - x^2)",
        ("gap", "radius", "position", "speed", "viscosity"),
        "Pa",
        films.pressure_3_16,
        viscous.pressure_inside,
    ),
    Row(
        "3.17",
        "mean pressure between opening flats",
        "-3 eta x^2 h'/(2 h^3)",
        ("gap", "radius", "speed", "viscosity"),
        "Pa",
        films.mean_pressure_3_17,
    ),
    Row(
        "3.18",
        "viscous force on opening flats",
        "3 pi eta x^4 h'/(2 h^3)",
        ("radius", "gap", "speed", "viscosity"),
        "N",
        printed.viscous_flat_3_18,
        printed.viscous_flat_3_18,
        "Stefan's law, positive when it resists",
    ),
    Row(
        "3.19",
        "viscous force on flats at rupture",
        "3 pi eta x^4/(4 t_s) (1/h0^2 - 1/h_s^2)",
        _OPENED,
        "N",
        printed.viscous_flat_3_19,
        viscous.viscous_flat,
        _CONSERVED,
    ),
    Row(
        "3.21",
        "pressure under a lifted sphere",
        "3 eta R D' (1/H(r)^2 - 1/H(x)^2)",
        ("sphere_radius", "height", "film_height", "speed", "viscosity"),
        "Pa",
        films.pressure_sphere_3_21,
        _suction,
        "suction is negative",
    ),
    Row(
        "3.22",
        "viscous force on a sphere",
        "6 pi eta R^2 (1 - D/H)^2 D'/D",
        ("sphere_radius", "gap", "film_height", "speed", "viscosity"),
        "N",
        printed.viscous_sphere_3_22,
    ),
    Row(
        "3.23",
        "volume of the film under a sphere",
        "pi R (H^2 - D^2)",
        ("sphere_radius", "gap", "film_height", *_ANGLES),
        "m3",
        right.printed_film_volume,
        right.film_volume,
        "volume of revolution of the arc",
    ),
    Row(
        "3.24",
        "height of the film at its rim",
        "sqrt(H0^2 - D0^2 + D^2)",
        ("gap", "gap_start", "film_height"),
        "m",
        films.film_height_3_24,
    ),
    Row(
        "3.25",
        "viscous force on a sphere up to a gap",
        "1/t_s int 6 pi eta R^2 (1 - D/sqrt(H0^2 - D0^2 + D^2))^2 dD/D",
        _LIFTED,
        "N",
        printed.viscous_sphere_3_26,
        viscous.viscous_lifted,
        _CONSERVED,
    ),
    Row(
        "3.26",
        "viscous force on a sphere at rupture",
        _IMPULSE_SPHERE,
        _LIFTED,
        "N",
        printed.viscous_sphere_3_26,
        viscous.viscous_lifted,
        _CONSERVED,
    ),
    Row(
        "3.27",
        "viscous force on a sphere, rupture far away",
        "6 pi eta R^2/t_s ln(H0/(2 D0))",
        ("sphere_radius", "gap_start", "film_height", "separation_time", "viscosity"),
        "N",
        printed.viscous_sphere_3_27,
        viscous.viscous_sphere,
        "limit of Eq. (3.26)",
    ),
    Row("3.28", "viscous force of N equal menisci", "N F_v", ("force", "number"), "N", _times),
    Row(
        "3.29a",
        "viscous force of N menisci side by side between flats",
        "N F_v(x/n)",
        (*_OPENED, "number"),
        "N",
        printed.viscous_divided_3_34,
        viscous.viscous_divided,
        _CONSERVED,
        ("3.19",),
    ),
    Row(
        "3.29b",
        "viscous force of N asperities side by side",
        "N F_v(R/n)",
        (*_LIFTED, "number"),
        "N",
        films.viscous_rough_3_29,
        films.viscous_rough_3_29,
        _CONSERVED,
        ("3.26", "3.14"),
    ),
    Row(
        "3.32",
        "viscous force of one of N menisci",
        "3 pi eta x^4/(4 N^2 t_s) (1/h0^2 - 1/h_s^2)",
        (*_OPENED, "number"),
        "N",
        films.viscous_of_n_3_32,
        viscous.viscous_of_n,
        _CONSERVED,
        ("3.19",),
    ),
    Row(
        "3.34",
        "viscous force of a film divided into N menisci",
        "3 pi eta x^4/(4 N t_s) (1/h0^2 - 1/h_s^2)",
        (*_OPENED, "number"),
        "N",
        printed.viscous_divided_3_34,
        viscous.viscous_divided,
        _CONSERVED,
    ),
    Row(
        "3.36",
        "viscous force of N menisci, rupture far away",
        "3 pi eta x^4/(4 N t_s h0^2)",
        ("radius", "gap_start", "separation_time", "viscosity", "number"),
        "N",
        films.viscous_divided_3_36,
        viscous.viscous_far,
        _CONSERVED,
        ("3.34",),
    ),
    Row(
        "3.43",
        "viscous force made dimensionless",
        "4 t_s h0^2 F_v/(3 pi eta x^4)",
        ("force", "radius", "gap_start", "separation_time", "viscosity"),
        "-",
        printed.viscous_number_3_43,
        viscous.viscous_number,
        "over the impulse of a film of constant volume",
    ),
)

ROWS: tuple[Row, ...] = (*_CAPILLARY, *_VISCOUS)
