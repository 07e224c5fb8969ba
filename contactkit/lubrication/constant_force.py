r"""Time that a constant pull takes to open a film against viscosity and Laplace pressure.

For a massless body :math:`t = \int c(h) \, dh/(F - F_m(h))`. With a thin film between flats both
closures have the same form: :math:`c \, dh = -K u \, du` and :math:`F_m = B u`, where
:math:`u = 1/h` for a flooded film and :math:`u = 1/h^2` for one of constant volume, so that

.. math:: t = \frac{K F}{B^2} \left[ g\!\left(\frac{B u_0}{F}\right)
              - g\!\left(\frac{B u_1}{F}\right) \right], \qquad g(x) = -x - \ln(1 - x)

Arguments are floats and are not checked.
"""

from __future__ import annotations

import math

__all__ = ["disc_time_conserved", "disc_time_flooded"]


def _g_difference(x0: float, x1: float) -> float:
    """g(x0) - g(x1); by its series where the logarithm would cancel."""
    if max(abs(x0), abs(x1)) < 0.1:
        return math.fsum((x0**k - x1**k) / k for k in range(2, 18))
    fall = x0 - x1
    return -fall - math.log1p(-fall / (1.0 - x1))


def _time(k: float, pull: float, b: float, u0: float, u1: float) -> float:
    if pull <= 0.0 or b * max(u0, u1) >= pull:
        return math.inf
    if b == 0.0:
        return 0.5 * k * (u0 - u1) * (u0 + u1) / pull
    scale = b / pull
    return k / pull * _g_difference(scale * u0, scale * u1) / (scale * scale)


def disc_time_flooded(
    radius: float,
    gap_from: float,
    gap_to: float,
    viscosity: float,
    wetting_tension: float,
    pull: float,
) -> float:
    """Time [s] for a flooded film of a radius [m] under a pull [N]; inf if the pull is too small.

    `wetting_tension` is the surface tension times the sum of the cosines of the contact angles
    [N/m]; 0 leaves the meniscus out.
    """
    k = 1.5 * math.pi * viscosity * radius**4
    b = wetting_tension * math.pi * radius**2
    return _time(k, pull, b, 1.0 / gap_from, 1.0 / gap_to)


def disc_time_conserved(
    volume: float,
    gap_from: float,
    gap_to: float,
    viscosity: float,
    wetting_tension: float,
    pull: float,
) -> float:
    """Time [s] for a film of constant volume [m3] under a pull [N]; inf if the pull is too small.

    Examples
    --------
    A 6.35 mm plate drawn from 2 to 20 um through oil of 0.1 Pa.s by 5 N:

    >>> round(disc_time_conserved(6.333843488718721e-11, 2e-6, 20e-6, 0.1, 0.05, 5.0), 9)
    0.670314639
    """
    k = 0.75 * viscosity * volume**2 / math.pi
    return _time(k, pull, wetting_tension * volume, gap_from**-2, gap_to**-2)
