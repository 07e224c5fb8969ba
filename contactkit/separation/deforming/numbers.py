r"""Dimensionless numbers that decide which effects of a wet, deforming pair matter.

With the width w of the pressure, :math:`\sqrt{R h}` under a sphere and the radius of a flat, all
follow from the scales of the film: pressure :math:`\eta v w^2/h^3`, displacement
:math:`p w/E^*`. Arguments are floats and are not checked.
"""

from __future__ import annotations

import math
from typing import NamedTuple

__all__ = ["DecidingNumbers", "deciding_numbers", "hertz_approach", "rest_number"]


class DecidingNumbers(NamedTuple):
    r"""Numbers of a pull.

    Attributes
    ----------
    beta : float
        Displacement by the film over the gap, :math:`\eta v w^3/(E^* h^4)`; of a sphere
        :math:`\eta v R^{3/2}/(E^* h^{5/2})`.
    gap_over_crossover : float
        Gap over that below which the bodies take up a small motion of rate v/h, D/D_c:
        :math:`1/(8 \beta^{2/3})`; of a flat, nan.
    meniscus : float
        Displacement by the meniscus over the height of its rim, :math:`\gamma_c a/(E^* h_m^2)`;
        0 without one.
    tension : float
        Largest tension of a film between rigid bodies [Pa], 3 eta v R/h^2 of a sphere.
    """

    beta: float
    gap_over_crossover: float
    meniscus: float
    tension: float


def deciding_numbers(
    radius: float, width: float, gap: float, viscosity: float, speed: float, modulus: float
) -> DecidingNumbers:
    """Numbers of a film without a meniscus.

    Parameters
    ----------
    radius, width, gap : float
        Radius of the sphere (inf: flat), width of the pressure and gap at the start [m].
    viscosity, speed, modulus : float
        [Pa.s], [m/s] and E* [Pa].

    Examples
    --------
    >>> found = deciding_numbers(5e-3, 7.07107e-5, 1e-6, 0.1, 1e-5, 353553.4)
    >>> round(found.beta, 4), round(found.gap_over_crossover, 4), round(found.tension)
    (1.0, 0.125, 15000)
    """
    beta = viscosity * speed * width**3 / (modulus * gap**4)
    is_flat = math.isinf(radius)
    crossover = math.nan if is_flat else 0.125 * beta ** (-2.0 / 3.0)
    return DecidingNumbers(beta, crossover, 0.0, 3.0 * viscosity * speed * width**2 / gap**3)


def hertz_approach(force: float, radius: float, modulus: float) -> float:
    """Approach of a dry sphere under a load [m], by Hertz.

    Examples
    --------
    >>> round(hertz_approach(1.0, 1e-3, 1e11) * 1e6, 4)
    0.3832
    """
    cube = 0.75 * force / (modulus * math.sqrt(radius))
    return math.pow(cube, 2.0 / 3.0)


def rest_number(
    force: float, rest: float, radius: float, modulus: float, viscosity: float, cutoff: float
) -> float:
    r"""Time of rest over that in which a pressed film drains: :math:`t p_0 h_c^2/(12 \eta a^2)`.

    Above 10 the contact is that of solids, below 1 they still float.

    Parameters
    ----------
    force, rest : float
        Load [N] and time [s].
    radius, modulus, viscosity, cutoff : float
        R [m], E* [Pa], eta [Pa.s] and the gap of contact [m].

    Notes
    -----
    With the contact radius a and the largest pressure p_0 of Hertz.

    Examples
    --------
    >>> round(rest_number(1e-4, 10.0, 5e-3, 1e6, 0.1, 1e-7), 3)
    0.147
    """
    approach = hertz_approach(force, radius, modulus)
    square = radius * approach
    pressure = 1.5 * force / (math.pi * square)
    return rest * pressure * cutoff**2 / (12.0 * viscosity * square)
