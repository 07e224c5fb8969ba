r"""Equations of chapter 2 and Appendix A as printed, for reproduction only.

The printed hardness, Eq. (2.41) with its criteria, is in `elasticity.hardness_rules`, the film
force, Eq. (2.43), in `capillary.film_islands`, because scenes may call for them.
`errata.ERRATA` lists the errors.
"""

from __future__ import annotations

import math

__all__ = ["autocorrelation_2_42", "in_plane_stress_a_2", "mean_displacement_of_64_points"]

_DECADE = 2.3  # as printed in Eq. (2.42), for ln 10 = 2.3026
_POINTS = 8  # in either direction: the source has 64 over the cell, 8.5 % below the exact mean


def mean_displacement_of_64_points(
    mean_pressure: float, window: float, reduced_modulus: float
) -> float:
    r"""Mean displacement [m] of a square periodic window by 64 Gaussian points.

    The coefficient at the zero wavenumber, :math:`2/(E^* \alpha)` averaged over the cell of side
    :math:`2\pi/L` by the product of two 8-point rules.

    Parameters
    ----------
    mean_pressure : float
        Mean pressure over the window [Pa].
    window : float
        Width L of the window [m].
    reduced_modulus : float
        E* = E/(1 - nu^2) of the substrate [Pa].

    References
    ----------
    .. [1] Text after Eq. (2.34); the order of the rule in either direction is our reading.

    Examples
    --------
    Over the mean of the coefficient itself:

    >>> exact = 8 * math.asinh(1.0) / (2 * math.pi)
    >>> round(mean_displacement_of_64_points(1.0, 1.0, 1.0) / exact, 3)
    0.915
    """
    import numpy as np

    place, weight = np.polynomial.legendre.leggauss(_POINTS)
    inverse = 1.0 / np.hypot(place, place[:, None])
    # Over the half-width pi/L of the cell, its mean over four quarters of weight 1.
    mean = float(weight @ inverse @ weight) / 4.0
    return 2.0 * mean / math.pi * mean_pressure * window / reduced_modulus


def autocorrelation_2_42(
    rms: float,
    correlation_length_x: float,
    correlation_length_y: float,
    offset_x: float,
    offset_y: float,
    period: float = math.inf,
) -> float:
    r"""Autocorrelation [m2] of the heights at an offset, Eq. (2.42).

    .. math:: \sigma^2 \exp\left[-2.3 \sqrt{(k/\beta_x^*)^2 + (l/\beta_y^*)^2}\right]

    In a window that repeats with a period [m], at the nearest of the repetitions.

    Examples
    --------
    >>> round(autocorrelation_2_42(1.0, 5.0, 1.0, 5.0, 0.0), 4)
    0.1003
    >>> autocorrelation_2_42(1.0, 5.0, 5.0, 7.0, 0.0, 8.0) == autocorrelation_2_42(
    ...     1.0, 5.0, 5.0, 1.0, 0.0
    ... )
    True
    """
    if period < math.inf:
        offset_x, offset_y = (math.remainder(offset, period) for offset in (offset_x, offset_y))
    distance = math.hypot(offset_x / correlation_length_x, offset_y / correlation_length_y)
    return rms * rms * math.exp(-_DECADE * distance)


def in_plane_stress_a_2(stress_xx: float, stress_yy: float, stress_xy: float) -> float:
    r"""Maximum principal stress of the plane x-y [Pa], Eq. (A.2).

    Examples
    --------
    >>> in_plane_stress_a_2(3.0, -3.0, 4.0)
    5.0
    """
    radius = math.hypot(0.5 * (stress_xx - stress_yy), stress_xy)
    return 0.5 * (stress_xx + stress_yy) + radius
