r"""Squeezed films in closed form: power law and Barus between flats, slip and Barus under a sphere.

Forces are positive where they resist an opening at a speed v. Arguments are floats or arrays and
are not checked.
"""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from ..squeeze_film import disc_force, sphere_force

__all__ = [
    "barus_disc_force",
    "barus_sphere_force",
    "power_law_disc_force",
    "slip_disc_factor",
    "slip_sphere_factor",
]

# Slip over gap below which the series stand in for the closed forms, which cancel to its square.
_SMALL = 1e-3


def power_law_disc_force(radius: Any, gap: Any, speed: Any, consistency: Any, exponent: Any) -> Any:
    r"""Force [N] of a power-law liquid between discs (Scott).

    .. math:: F = \frac{2\pi K a^{n+3}}{(n+3) h} \left(\frac{(2n+1) v}{n h^2}\right)^n

    Parameters
    ----------
    radius, gap : float or ndarray
        Radius a of the film and distance h of the flats [m].
    speed : float or ndarray
        Opening speed v [m/s].
    consistency : float or ndarray
        K [Pa.s^n].
    exponent : float or ndarray
        n [-].

    References
    ----------
    Scott (1931), Trans. Inst. Rubber Ind. 7, 169; Leider and Bird (1974).

    Examples
    --------
    >>> force = power_law_disc_force(3e-3, 1e-5, 1e-3, 0.1, 1.0)
    >>> round(force / disc_force(3e-3, 1e-5, 1e-3, 0.1), 12)
    1.0
    """
    n = exponent
    rate = (2.0 * n + 1.0) / n * abs(speed) / (gap * gap)  # per radius
    size = 2.0 * math.pi * consistency / gap * rate**n * radius ** (n + 3.0) / (n + 3.0)
    return np.copysign(size, speed) if np.ndim(size) else math.copysign(size, speed)


def slip_disc_factor(gap: Any, lower: Any, upper: Any) -> Any:
    r"""Force between flats with slip over that without [-], of a Newtonian liquid.

    .. math:: \left[1 + \frac{3 (b_1 + b_2) h + 12 b_1 b_2}{h (h + b_1 + b_2)}\right]^{-1}

    Parameters
    ----------
    gap : float or ndarray
        Gap h [m].
    lower, upper : float or ndarray
        Slip lengths b_1 and b_2 of the walls [m]. Of equal ones it is 1/(1 + 6 b/h); with one
        wall that slips freely, 1/4.

    Examples
    --------
    >>> round(slip_disc_factor(1e-6, 1e-7, 1e-7), 9), round(slip_disc_factor(1e-6, 0.0, 1e3), 9)
    (0.625, 0.25)
    """
    both = lower + upper
    return 1.0 / (1.0 + (3.0 * both * gap + 12.0 * lower * upper) / (gap * (gap + both)))


def slip_sphere_factor(gap: Any, slip_length: Any, n_slipping: int = 2) -> Any:
    r"""Force on an immersed sphere near a flat with slip over that without [-] (Vinogradova).

    .. math:: f_2 = \frac{h}{3b}\left[\left(1 + \frac{h}{6b}\right)
              \ln\left(1 + \frac{6b}{h}\right) - 1\right], \qquad
              f_1 = \frac14\left(1 + \frac{3h}{2b}\left[\left(1 + \frac{h}{4b}\right)
              \ln\left(1 + \frac{4b}{h}\right) - 1\right]\right)

    Parameters
    ----------
    gap : float or ndarray
        Smallest gap h [m].
    slip_length : float or ndarray
        Slip length b [m] of the walls that slip.
    n_slipping : {1, 2}
        How many of the walls slip.

    References
    ----------
    Vinogradova (1995), Langmuir 11, 2213.

    Examples
    --------
    >>> round(slip_sphere_factor(1e-9, 1.0), 6), round(slip_sphere_factor(1e-9, 1.0, 1), 6)
    (0.0, 0.25)
    >>> round(slip_sphere_factor(1.0, 1e-9), 6), round(slip_sphere_factor(1.0, 1e-4), 9)
    (1.0, 0.99980006)
    """
    x = np.asarray((6.0 if n_slipping == 2 else 4.0) * slip_length / gap, dtype=float)
    is_small = x < _SMALL
    wide = np.where(is_small, 1.0, x)
    # ((1 + x) ln(1 + x) - x)/x^2 from the sum of both terms, as 1/2 - x/6 + x^2/12 - ...
    series = 0.5 - x / 6.0 + x**2 / 12.0 - x**3 / 20.0 + x**4 / 30.0
    shape = np.where(is_small, series, ((1.0 + wide) * np.log1p(wide) - wide) / wide**2)
    factor = 2.0 * shape if n_slipping == 2 else 0.25 * (1.0 + 6.0 * shape)
    return factor.item() if factor.ndim == 0 else factor


def barus_disc_force(radius: Any, gap: Any, speed: Any, viscosity: Any, coefficient: Any) -> Any:
    r"""Force [N] of a Newtonian liquid with Barus' viscosity between discs.

    .. math:: F = \frac{\pi a^2}{\alpha}\left[\frac{(1 + c) \ln(1 + c)}{c} - 1\right], \qquad
              c = \frac{3 \alpha \eta a^2 v}{h^3}

    Parameters
    ----------
    radius, gap : float or ndarray
        Radius a of the film and distance h of the flats [m].
    speed : float or ndarray
        Opening speed v [m/s].
    viscosity : float or ndarray
        At ambient pressure [Pa.s].
    coefficient : float or ndarray
        Pressure-viscosity coefficient alpha [1/Pa].

    Notes
    -----
    By :math:`(1 - e^{-\alpha p})/\alpha`, which obeys Reynolds' equation of the constant viscosity.
    -inf where c <= -1: no pressure carries the flux of such a closing film.

    Examples
    --------
    >>> thin = barus_disc_force(3e-3, 1e-5, 1e-7, 0.1, 2e-8)
    >>> round(thin / disc_force(3e-3, 1e-5, 1e-7, 0.1), 6)
    0.999998
    >>> float(barus_disc_force(3e-3, 1e-5, -1.0, 0.1, 2e-8))
    -inf
    """
    newtonian = disc_force(radius, gap, speed, viscosity)
    c = np.asarray(2.0 * coefficient * newtonian / (math.pi * radius**2), dtype=float)
    is_small = np.abs(c) < _SMALL
    wide = np.where(is_small | (c <= -1.0), 1.0, c)
    # ((1 + c) ln(1 + c) - c)/c^2, times 2: over the Newtonian force.
    series = 1.0 - c / 3.0 + c**2 / 6.0 - c**3 / 10.0 + c**4 / 15.0
    closed = 2.0 * ((1.0 + wide) * np.log1p(wide) - wide) / wide**2
    force = np.where(c <= -1.0, -np.inf, newtonian * np.where(is_small, series, closed))
    return force.item() if force.ndim == 0 else force


def barus_sphere_force(radius: Any, gap: Any, speed: Any, viscosity: Any, coefficient: Any) -> Any:
    r"""Force [N] on an immersed sphere that leaves a flat in a liquid of Barus' viscosity.

    .. math:: F = \frac{2\pi R h}{\alpha}\left[2 k \arctan k - \ln(1 + k^2)\right], \qquad
              k^2 = \frac{3 \alpha \eta R v}{h^2}

    Parameters
    ----------
    radius, gap : float or ndarray
        Radius R of the sphere and smallest gap h [m].
    speed : float or ndarray
        Opening speed v [m/s], not negative.
    viscosity : float or ndarray
        At ambient pressure [Pa.s].
    coefficient : float or ndarray
        Pressure-viscosity coefficient alpha [1/Pa].

    Examples
    --------
    >>> thin = barus_sphere_force(5e-3, 1e-6, 1e-8, 0.1, 2e-8)
    >>> round(thin / sphere_force(5e-3, 1e-6, float("inf"), 1e-8, 0.1), 9)
    0.99999995
    """
    square = np.asarray(3.0 * coefficient * viscosity * radius * speed / (gap * gap), dtype=float)
    is_small = square < _SMALL
    k = np.sqrt(np.where(is_small, 1.0, square))
    # (2 k atan k - ln(1 + k^2))/k^2
    series = 1.0 - square / 6.0 + square**2 / 15.0 - square**3 / 28.0 + square**4 / 45.0
    shape = np.where(is_small, series, (2.0 * k * np.arctan(k) - np.log1p(k * k)) / (k * k))
    force = sphere_force(radius, gap, math.inf, speed, viscosity) * shape
    return force.item() if force.ndim == 0 else force
