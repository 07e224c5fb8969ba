r"""Kelvin radius, films, pressures and division of chapter 3 as printed, by equation number.

Conventions as in `common`: body 1 lies below, body 2 above, angles run through the liquid, positive
forces attract or resist. Pressures keep the printed sign. Angles are floats, other arguments floats
or arrays. `errata.ERRATA` lists the errors.

=========  ======================================  =======
symbol     quantity                                unit
=========  ======================================  =======
x          radius of the meniscus                  m
h          gap between flats                       m
R, D       radius of the sphere, gap under it      m
H          height of the film at its rim           m
r_k        Kelvin radius                           m
N          number of menisci, asperities           -
=========  ======================================  =======
"""

from __future__ import annotations

import math
from typing import Any

from ...errors import InfeasibleError
from .common import laplace_sphere_3_7, line_tension_3_9, meniscus_flat_3_11
from .viscous import viscous_flat_3_19, viscous_sphere_3_26

__all__ = [
    "film_height_3_24",
    "film_volume_3_23",
    "kelvin_radius_3_3",
    "laplace_sphere_3_6",
    "meniscus_number_n_3_35",
    "meniscus_of_n_3_31",
    "meniscus_pressure_radius_3_4",
    "meniscus_sphere_3_10",
    "mean_pressure_3_17",
    "pressure_3_16",
    "pressure_sphere_3_21",
    "sphere_shape_3_37",
    "viscous_divided_3_36",
    "viscous_of_n_3_32",
    "viscous_rough_3_29",
]

_GAS_CONSTANT = 8.31  # [J/(mol.K)] as printed


def kelvin_radius_3_3(
    surface_tension: float, molar_volume: float, temperature: float, relative_humidity: float
) -> float:
    r"""Kelvin radius [m], Eq. (3.3), :math:`\gamma V/(\Re T \ln(p/p_0))`: negative below 1.

    Raises
    ------
    InfeasibleError
        For saturated vapour, where it is infinite.

    Examples
    --------
    >>> round(kelvin_radius_3_3(0.072, 18e-6, 298.15, 0.5) * 1e9, 4)
    -0.7546
    """
    if relative_humidity == 1.0:
        raise InfeasibleError("Eq. (3.3) is infinite in saturated vapour, relative_humidity = 1")
    scale = _GAS_CONSTANT * temperature * math.log(relative_humidity)
    return surface_tension * molar_volume / scale


def meniscus_pressure_radius_3_4(
    radius: Any, kelvin_radius: Any, surface_tension: Any, angle: float
) -> Any:
    r"""Meniscus force [N] by the Kelvin radius, Eq. (3.4).

    .. math:: \pi x^2\gamma/r_k + 2\pi\gamma x\sin\theta

    Correct if r_k is that of the mean curvature, and angle and radius are those of one body.

    Examples
    --------
    >>> round(meniscus_pressure_radius_3_4(1.0, 0.5, 1.0, math.pi / 2) / math.pi, 12)
    4.0
    """
    line = 2.0 * math.pi * surface_tension * radius * math.sin(angle)
    return math.pi * radius**2 * surface_tension / kelvin_radius + line


def laplace_sphere_3_6(
    sphere_radius: Any, surface_tension: Any, angle_lower: float, angle_upper: float
) -> Any:
    r"""Laplace force [N] on a touching sphere, :math:`2\pi R\gamma(c_1+c_2)`, Eqs. (3.6c), (3.6d).

    Examples
    --------
    >>> round(laplace_sphere_3_6(1.0, 1.0, 0.0, 0.0) / math.pi, 12)
    4.0
    """
    return laplace_sphere_3_7(sphere_radius, 0.0, 1.0, surface_tension, angle_lower, angle_upper)


def meniscus_sphere_3_10(
    sphere_radius: Any,
    surface_tension: Any,
    angle_lower: float,
    angle_upper: float,
    filling_angle: float,
) -> Any:
    """Force [N] on a touching sphere, Eq. (3.10) as Table 4.1 has it: (3.6c) plus (3.9).

    Examples
    --------
    >>> round(meniscus_sphere_3_10(1.0, 1.0, 0.0, 0.0, math.pi / 6) / math.pi, 12)
    4.5
    """
    line = line_tension_3_9(sphere_radius, surface_tension, filling_angle, angle_upper)
    return laplace_sphere_3_6(sphere_radius, surface_tension, angle_lower, angle_upper) + line


def pressure_3_16(gap: Any, radius: Any, position: Any, speed: Any, viscosity: Any) -> Any:
    r"""Pressure [Pa] over ambient at a distance r from the axis between opening flats, Eq. (3.16).

    .. math:: 3\eta\dot h(r^2 - x^2)/h^3

    Examples
    --------
    >>> pressure_3_16(1.0, 2.0, 0.0, 1.0, 1.0)
    -12.0
    """
    return 3.0 * viscosity * (position - radius) * (position + radius) * speed / gap**3


def mean_pressure_3_17(gap: Any, radius: Any, speed: Any, viscosity: Any) -> Any:
    """Mean pressure [Pa] over ambient between opening flats, Eq. (3.17): half of that at the axis.

    Examples
    --------
    >>> mean_pressure_3_17(1.0, 2.0, 1.0, 1.0)
    -6.0
    """
    return 0.5 * pressure_3_16(gap, radius, 0.0, speed, viscosity)


def pressure_sphere_3_21(
    sphere_radius: Any, height: Any, film_height: Any, speed: Any, viscosity: Any
) -> Any:
    r"""Pressure [Pa] at a local film height under a lifted sphere, Eq. (3.21) as printed.

    .. math:: 3\eta R\dot D(1/H^2(r) - 1/H^2(x))

    Examples
    --------
    >>> pressure_sphere_3_21(1.0, 1.0, 2.0, 1.0, 1.0)
    2.25
    """
    return 3.0 * viscosity * sphere_radius * speed * (height**-2.0 - film_height**-2.0)


def film_volume_3_23(sphere_radius: Any, gap: Any, film_height: Any) -> Any:
    r"""Volume [m3] of a film of height H at its rim under a sphere, Eq. (3.23).

    .. math:: V = \pi R(H^2 - D^2)

    Examples
    --------
    >>> round(film_volume_3_23(100.0, 1.0, 2.0), 4)
    942.4778
    """
    return math.pi * sphere_radius * (film_height - gap) * (film_height + gap)


def film_height_3_24(gap: Any, gap_start: Any, film_height: Any) -> Any:
    r"""Height [m] of the film at its rim at a gap, :math:`\sqrt{H_0^2 - D_0^2 + D^2}`, Eq. (3.24).

    Examples
    --------
    >>> film_height_3_24(4.0, 4.0, 5.0)
    5.0
    """
    return ((film_height - gap_start) * (film_height + gap_start) + gap * gap) ** 0.5


def viscous_rough_3_29(
    sphere_radius: Any,
    gap_start: Any,
    film_height: Any,
    gap_end: Any,
    separation_time: Any,
    viscosity: Any,
    number: Any,
) -> Any:
    """Impulse over time [N] of N = n x n asperities of radius R/n, Eq. (3.29) with Eq. (3.26).

    Examples
    --------
    >>> one, many = (viscous_rough_3_29(1.0, 1.0, 2.0, 3.0, 1.0, 1.0, n) for n in (1, 100))
    >>> round(many / one, 12)
    1.0
    """
    small = sphere_radius / number**0.5
    film = (gap_start, film_height, gap_end, separation_time, viscosity)
    return number * viscous_sphere_3_26(small, *film)


def meniscus_of_n_3_31(
    radius: Any,
    gap: Any,
    surface_tension: Any,
    angle_lower: float,
    angle_upper: float,
    number: Any,
    pulled: Any = "lower",
) -> Any:
    """Meniscus force [N] of one of N equal menisci of a divided film, Eq. (3.31).

    Examples
    --------
    >>> right = math.pi / 2
    >>> round(meniscus_of_n_3_31(1.0, 1.0, 1.0, right, right, 4) / math.pi, 12)
    1.0
    """
    small = radius / number**0.5
    return meniscus_flat_3_11(small, gap, surface_tension, angle_lower, angle_upper, pulled)


def viscous_of_n_3_32(
    radius: Any, gap_start: Any, gap_end: Any, separation_time: Any, viscosity: Any, number: Any
) -> Any:
    """Impulse over time [N] of one of N equal menisci of a divided film, Eq. (3.32).

    Examples
    --------
    >>> round(viscous_of_n_3_32(1.0, 1.0, math.inf, 1.0, 1.0, 4) * 64 / math.pi, 12)
    3.0
    """
    small = radius / number**0.5
    return viscous_flat_3_19(small, gap_start, gap_end, separation_time, viscosity)


def meniscus_number_n_3_35(force: Any, number: Any) -> Any:
    r"""Total force [N] from that of one of N menisci as Eq. (3.35) scales it, :math:`\sqrt N F`.

    Examples
    --------
    >>> meniscus_number_n_3_35(2.0, 9)
    6.0
    """
    return number**0.5 * force


def viscous_divided_3_36(
    radius: Any, gap_start: Any, separation_time: Any, viscosity: Any, number: Any
) -> Any:
    """Impulse over time [N] of N equal menisci with rupture far away, Eq. (3.36).

    Examples
    --------
    >>> round(viscous_divided_3_36(1.0, 1.0, 1.0, 1.0, 3) / math.pi, 12)
    0.25
    """
    far = viscous_flat_3_19(radius, gap_start, math.inf, separation_time, viscosity)
    return far / number


def sphere_shape_3_37(sphere_radius: Any, gap: Any, position: Any) -> Any:
    r"""Height [m] of the sphere at a distance from the axis, :math:`x^2/2R + D`, Eq. (3.37).

    Examples
    --------
    >>> sphere_shape_3_37(2.0, 1.0, 2.0)
    2.0
    """
    return position * position / (2.0 * sphere_radius) + gap
