r"""Exchange of liquid between a meniscus and its vapour: how fast it dries up or condenses.

Vapour diffuses through the gap outside of the rim. Between a sphere and a flat the gap there is
:math:`h_m + (r^2 - a^2)/2R`, and a difference of concentration :math:`\Delta c` drives the flow

.. math::
    \dot n = D\,G\,\Delta c, \qquad
    G^{-1} = \int_a^\infty \frac{dr}{2 \pi r h} = \frac{\ln(2 R h_m/a^2)}{4 \pi z}

with the gap on the axis :math:`z = h_m - a^2/2R`. Arguments are floats and are not checked.
"""

from __future__ import annotations

import math

from .kelvin import GAS_CONSTANT

__all__ = ["drying_time", "gap_conductance", "water_diffusivity", "water_saturation_pressure"]


def water_saturation_pressure(temperature: float) -> float:
    r"""Pressure of saturated vapour over water [Pa] at a temperature [K], 0 to 60 degC.

    Notes
    -----
    Magnus' form, :math:`611.2 \exp(17.62 t/(243.12 + t))` Pa with t in degC; within 0.3 %.
    World Meteorological Organization, Guide to Instruments, WMO-No. 8, 2008, annex 4.B.

    Examples
    --------
    >>> round(water_saturation_pressure(293.15))
    2333
    """
    celsius = temperature - 273.15
    return 611.2 * math.exp(17.62 * celsius / (243.12 + celsius))


def water_diffusivity(temperature: float) -> float:
    r"""Diffusivity of water vapour in air at an atmosphere [m2/s], at a temperature [K].

    Notes
    -----
    :math:`2.178 \cdot 10^{-5} (T/273.15)^{1.81}` m2/s, within 7 %; Massman, Atmospheric Environment
    32, 1111 (1998).

    Examples
    --------
    >>> round(water_diffusivity(293.15) * 1e6, 1)
    24.8
    """
    return 2.178e-5 * math.pow(temperature / 273.15, 1.81)


def gap_conductance(rim_radius: float, gap: float, radius: float) -> float:
    """Conductance G of the gap outside of a rim between a sphere and a flat [m].

    Parameters
    ----------
    rim_radius, gap, radius : float
        Radius a of the rim, gap z on the axis and radius R of the sphere [m].

    Notes
    -----
    Exact for diffusion between a paraboloid and a flat that do not deform, without end; mean free
    paths (0.1 um in air) are taken for shorter than the gap, below which vapour is slower.

    Examples
    --------
    Touching bodies have 2 pi a^2/R:

    >>> round(gap_conductance(1e-6, 1e-15, 1e-3) / (2.0 * math.pi * 1e-12 / 1e-3), 6)
    1.000001
    """
    return 4.0 * math.pi * gap / math.log1p(2.0 * radius * gap / rim_radius**2)


def drying_time(
    volume: float,
    conductance: float,
    molar_volume: float,
    temperature: float,
    relative_humidity: float,
) -> float:
    r"""Time in which water vapour carries off a meniscus that is drawn out [s].

    Parameters
    ----------
    volume : float
        Liquid [m3].
    conductance : float
        Of the gap around it [m], `gap_conductance`.
    molar_volume : float
        Of the water [m3/mol].
    temperature, relative_humidity : float
        [K] and [-].

    Notes
    -----
    :math:`V R T/(D G v_m p_s (1 - H))`: the vapour at the rim is saturated, as that of a meniscus
    drawn out until it has no suction; less drawn out it dries up more slowly.

    Examples
    --------
    >>> around = gap_conductance(1e-6, 1e-8, 1e-5)
    >>> f"{drying_time(1e-19, around, 1.8e-5, 293.15, 0.5):.1e} s"
    '6.8e-04 s'
    """
    pressure = water_saturation_pressure(temperature) * (1.0 - relative_humidity)
    concentration = pressure / (GAS_CONSTANT * temperature)
    flow = water_diffusivity(temperature) * conductance * concentration
    return volume / (flow * molar_volume)
