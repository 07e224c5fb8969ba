r"""Couette film between flats that slide at constant gap: drag, impulse, shear limits, hysteresis.

Both bodies are wetted over a circle of radius x. One slides by L; the film that joins them is the
lens in which the circles still overlap, and it ends at L = 2x. A force is positive when it resists
sliding. Arguments are floats or arrays that broadcast; they are not checked.

=========  ==========================================  =======
symbol     quantity                                    unit
=========  ==========================================  =======
x          radius of the wetted circles                m
L          travel                                      m
h          thickness of the film                       m
v          sliding speed                               m/s
eta        dynamic viscosity                           Pa.s
gamma      surface tension                             N/m
=========  ==========================================  =======
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

import numpy as np

if TYPE_CHECKING:
    from numpy.typing import ArrayLike

__all__ = ["flat_impulse", "hysteresis_force", "lens_area", "lens_width", "limited_stress"]


def lens_area(radius: ArrayLike, travel: ArrayLike) -> Any:
    r"""Area [m2] in which two circles of one radius overlap when their centres are apart.

    .. math:: A = 2 x^2 \left(\arccos q - q \sqrt{1 - q^2}\right), \qquad q = \frac{L}{2x}

    Parameters
    ----------
    radius, travel : float or ndarray, shape (...)
        Radius of the circles, distance of their centres (0 or more) [m].

    Returns
    -------
    float or ndarray, shape (...)
        Area [m2]; 0 from L = 2x on. Accurate to round-off also where the circles hardly overlap.

    References
    ----------
    Eqs. (3.46)-(3.49) of Cai and Bhushan (2008b).

    Examples
    --------
    >>> round(float(lens_area(1.0, 0.0)) / math.pi, 12), float(lens_area(1.0, 2.0))
    (1.0, 0.0)
    """
    x = np.asarray(radius, dtype=np.float64)
    q = np.minimum(np.asarray(travel, dtype=np.float64) / (2.0 * x), 1.0)
    half = np.arctan2(np.sqrt((1.0 - q) * (1.0 + q)), q)
    return x * x * _less_sine(2.0 * half)


def lens_width(radius: ArrayLike, travel: ArrayLike) -> Any:
    r"""Width [m] of the overlap across the direction of sliding, :math:`2\sqrt{x^2 - L^2/4}`.

    Examples
    --------
    >>> float(lens_width(1.0, 0.0)), float(lens_width(1.0, 3.0))
    (2.0, 0.0)
    """
    x = np.asarray(radius, dtype=np.float64)
    half = 0.5 * np.asarray(travel, dtype=np.float64)
    return 2.0 * np.sqrt(np.maximum((x - half) * (x + half), 0.0))


def flat_impulse(radius: ArrayLike, gap: ArrayLike, travel: ArrayLike, viscosity: ArrayLike) -> Any:
    r"""Impulse [N.s] of the drag between flats over a travel, for any motion in time.

    .. math:: I = \frac{\eta}{h} \int_0^L A \, dL = \frac{4 \eta x^3}{h}
              \left[q \arccos q + \frac{(1 - c)^2 (2 + c)}{3}\right], \qquad c = \sqrt{1 - q^2}

    with q = L/2x. From q = 1 on it stays at :math:`8 \eta x^3/(3h)`, Eq. (3.52).

    Parameters
    ----------
    radius, gap, travel : float or ndarray, shape (...)
        Radius of the wetted circles, distance of the flats, travel [m].
    viscosity : float or ndarray, shape (...)
        Dynamic viscosity [Pa.s].

    Returns
    -------
    float or ndarray, shape (...)
        Impulse [N.s]; divided by a time it is a mean force.

    Notes
    -----
    Couette flow; neglected are terms of relative size h/x, at the rim of the film.

    References
    ----------
    Eqs. (3.48)-(3.52) of Cai and Bhushan (2008b), to any travel.

    Examples
    --------
    >>> round(float(flat_impulse(100e-9, 2e-9, 200e-9, 0.89e-3)) / 1e-7 * 1e9, 9)
    11.866666667
    """
    x, h = np.asarray(radius, dtype=np.float64), np.asarray(gap, dtype=np.float64)
    q = np.minimum(np.asarray(travel, dtype=np.float64) / (2.0 * x), 1.0)
    # acos(q) as atan2(c, q), and 1 - c by its conjugate: neither cancels at the start of a travel.
    c = np.sqrt((1.0 - q) * (1.0 + q))
    complement = q * q / (1.0 + c)  # 1 - c
    bracket = q * np.arctan2(c, q) + complement * complement * (2.0 + c) / 3.0
    return 4.0 * np.asarray(viscosity) * x**3 / h * bracket


def limited_stress(stress: Any, strength: Any, law: str = "truncated") -> Any:
    r"""Shear stress [Pa] of a liquid with a limiting shear strength.

    Parameters
    ----------
    stress : float or ndarray, shape (...)
        Newtonian shear stress, viscosity times shear rate [Pa]; 0 or more.
    strength : float or ndarray, shape (...)
        Limiting shear strength, or Eyring stress [Pa].
    law : {"truncated", "bair-winer", "eyring"}
        :math:`\min(\tau, \tau_L)`; :math:`\tau_L (1 - e^{-\tau/\tau_L})`; or
        :math:`\tau_E \operatorname{asinh}(\tau/\tau_E)`, which has no upper bound.

    References
    ----------
    Bair and Winer (1979); Eyring (1936).

    Examples
    --------
    >>> [round(float(limited_stress(3.0, 1.0, law)), 6) for law in ("truncated", "bair-winer")]
    [1.0, 0.950213]
    """
    if law == "truncated":
        return np.minimum(stress, strength)
    ratio = np.asarray(stress) / strength
    return strength * (-np.expm1(-ratio) if law == "bair-winer" else np.arcsinh(ratio))


def hysteresis_force(
    surface_tension: ArrayLike,
    width: ArrayLike,
    advancing: ArrayLike,
    receding: ArrayLike,
    shape_factor: ArrayLike = 2.0 / math.pi,
) -> Any:
    r"""Force [N] of contact-angle hysteresis on a meniscus that slides along a body.

    .. math:: F = k \gamma w (\cos\theta_r - \cos\theta_a)

    Parameters
    ----------
    surface_tension : float or ndarray, shape (...)
        Surface tension [N/m].
    width : float or ndarray, shape (...)
        Width of the wetted spot across the motion [m].
    advancing, receding : float or ndarray, shape (...)
        Advancing (front) and receding (rear) contact angle [rad], the advancing one larger.
    shape_factor : float or ndarray, shape (...)
        Factor k on the width [-], by the variation of the angle along a circular contact line.
        1: a jump between front and rear half (Furmidge 1962); 2/pi: cos(theta) linear along the
        line (4/pi on the radius, Extrand and Gent 1990); pi/4: cos(theta) linear along the
        motion; 24/pi^3: theta a cubic (ElSherbini and Jacobi 2006).

    Returns
    -------
    float or ndarray, shape (...)
        Force [N] at which the contact line moves, independent of speed.

    Notes
    -----
    Holds for small capillary number, eta v/gamma << 1. The build-up of the force over a travel of
    about the film height, before the line depins, is neglected.

    Examples
    --------
    >>> round(float(hysteresis_force(0.072, 1e-6, math.pi / 2, math.pi / 3, 1.0)) * 1e9, 9)
    36.0
    """
    # cos(a) - cos(b) as a product: nearly equal angles leave few digits of the difference.
    mean = 0.5 * (np.asarray(advancing) + np.asarray(receding))
    half = 0.5 * (np.asarray(advancing) - np.asarray(receding))
    fall = 2.0 * np.sin(mean) * np.sin(half)
    return np.asarray(shape_factor) * np.asarray(surface_tension) * np.asarray(width) * fall


def _less_sine(angle: Any) -> Any:
    """Angle minus its sine, without the cancellation at small angles."""
    angle = np.asarray(angle, dtype=np.float64)
    square = np.minimum(angle, 1.0) ** 2
    # Nine terms, 1/19! at an angle of one: round-off. Above, the difference keeps 15 of 16 digits.
    term, series = square * angle / 6.0, np.zeros_like(angle)
    for k in range(4, 22, 2):
        series = series + term
        term = -term * square / (k * (k + 1))
    return np.where(angle < 1.0, series, angle - np.sin(angle))
