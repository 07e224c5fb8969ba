r"""Published fits for liquid bridges between equal spheres: Willett, Lian and Mikami.

The force attracts where it is positive. R is the radius of both spheres, s their distance, V the
volume of the liquid, gamma its surface tension, theta the contact angle on both, and
:math:`V^* = V/R^3`. Gravity is left out.

All three papers integrate the Young-Laplace equation numerically and fit what they find. None could
be read here: the coefficients are those of programs that name the paper, and agree between
independent programs. A range of validity is stated in none of these; those below are measured
against `contactkit.capillary.bridge` (`tests/references/test_bridge_fits.py`).

References
----------
.. [1] C. D. Willett, M. J. Adams, S. A. Johnson and J. P. K. Seville, Langmuir 16 (2000) 9396:
   fit of the force (supplement), closed form Eq. 12, rupture Eq. 15; as in Yade,
   ``pkg/dem/ViscoelasticCapillarPM.cpp`` (gladk/trunk, commit e9ec7966).
.. [2] G. Lian, C. Thornton and M. J. Adams, J. Colloid Interface Sci. 161 (1993) 138: rupture; as
   in the documentation of LIGGGHTS, ``gran_cohesion_easo_capillary_viscous``.
.. [3] T. Mikami, H. Kamiya and M. Horio, Chem. Eng. Sci. 53 (1998) 1927: force; at theta = 0 as in
   ParticulateFlow/LIGGGHTS-PFM (commit 2f4113a8), ``cohesion_model_capillary_model_Mikami.h``. The
   same with its angle in Yade [1], named after F. Soulie et al., Int. J. Numer. Anal. Methods
   Geomech. 30 (2006) 213, Eqs. 13 and 14.
"""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import ArrayLike, NDArray

__all__ = [
    "lian_rupture",
    "mikami_force",
    "willett_closed_form",
    "willett_force",
    "willett_rupture",
]

Array = NDArray[np.float64]

# Coefficients of 1, theta and theta^2, for the powers of ln V*: Willett et al. [1], supplement.
# Digits as printed: half a unit of the last one moves the force by 0.3 % at most, and that of
# -0.0005 by 4 % at V* = 1e-4.
_F1 = (
    (-0.44507, 0.050832, -1.1466),
    (-0.1119, -0.000411, -0.1490),
    (-0.012101, -0.0036456, -0.01255),
    (-0.0005, -0.0003505, -0.00029076),
)
_F2 = (
    (1.9222, -0.57473, -1.2918),
    (-0.0668, -0.1201, -0.22574),
    (-0.0013375, -0.0068988, -0.01137),
)
_F3 = (
    (1.268, -0.01396, -0.23566),
    (0.198, 0.092, -0.06418),
    (0.02232, 0.02238, -0.009853),
    (0.0008585, 0.001318, -0.00053),
)
_F4 = (
    (-0.010703, 0.073776, -0.34742),
    (0.03345, 0.04543, -0.09056),
    (0.0018574, 0.004456, -0.006257),
)


def willett_force(
    distance: ArrayLike, radius: float, volume: float, surface_tension: float, contact_angle: float
) -> Array:
    r"""Force [N] between equal spheres, the fit of Willett et al. to the Young-Laplace equation.

    .. math:: \ln\frac{F}{2\pi R\gamma} = f_1 - f_2 \exp(f_3 \ln s^+ + f_4 \ln^2 s^+), \qquad
              s^+ = \frac{s}{2} \sqrt{R/V}

    with polynomials f_1 to f_4 in theta and ln V*.

    Parameters
    ----------
    distance : array_like
        Distance s of the surfaces [m], above 0.
    radius : float
        Radius R of the spheres [m].
    volume : float
        Volume V of the liquid [m3].
    surface_tension : float
        gamma [N/m].
    contact_angle : float
        theta [rad], the same on both, from 0 to pi/2.

    Returns
    -------
    ndarray, in the shape of `distance`

    Raises
    ------
    ValueError
        For a length, volume or tension that is not positive, or an angle outside of 0 to pi/2.

    Notes
    -----
    Against exact bridges of V* = 1e-4 to 0.1, from 2 to 90 % of the distance of rupture: 0.5 to
    2.5 % on average up to 40 degrees and 3 to 4 % at 50 degrees, at most 10 %. At 95 % of it 4 to
    17 % too large: the force has a vertical tangent at rupture, which no polynomial in logarithms
    has. Not for V* = 1e-5 (9 to 50 % on average).

    Examples
    --------
    Glass spheres of 2.381 mm, 74.2 nl of a silicone oil, 0.1 mm apart:

    >>> print(f"{willett_force(1e-4, 2.381e-3, 74.2e-12, 20.6e-3, 0.0) * 1e6:.2f} uN")
    132.23 uN
    """
    s = _checked(distance, radius, volume, surface_tension, contact_angle)
    log = math.log(volume / radius**3)
    f1, f2, f3, f4 = (_polynomial(f, contact_angle, log) for f in (_F1, _F2, _F3, _F4))
    apart = np.log(0.5 * s * math.sqrt(radius / volume))
    fit = np.exp(f1 - f2 * np.exp(f3 * apart + f4 * apart**2))
    return np.asarray(2.0 * math.pi * radius * surface_tension * fit)


def willett_closed_form(
    distance: ArrayLike, radius: float, volume: float, surface_tension: float, contact_angle: float
) -> Array:
    r"""Force [N] by the closed form of Willett et al., their Eq. 12.

    .. math:: F = \frac{2\pi R \gamma \cos\theta}{1 + 2.1 s^+ + 10 (s^+)^2}, \qquad
              s^+ = \frac{s}{2} \sqrt{R/V}

    Parameters and errors are those of `willett_force`.

    Notes
    -----
    Many programs with discrete elements use it. Against exact bridges of V* = 1e-4 to 0.1 it is 8
    to 17 % off on average at 0 degrees and 27 to 39 % at 50 degrees; less for smaller volumes.

    Examples
    --------
    >>> print(f"{willett_closed_form(1e-4, 2.381e-3, 74.2e-12, 20.6e-3, 0.0) * 1e6:.2f} uN")
    128.57 uN
    """
    s = _checked(distance, radius, volume, surface_tension, contact_angle)
    apart = 0.5 * s * math.sqrt(radius / volume)
    touching = 2.0 * math.pi * radius * surface_tension * math.cos(contact_angle)
    return np.asarray(touching / (1.0 + 2.1 * apart + 10.0 * apart**2))


def willett_rupture(radius: float, volume: float, contact_angle: float) -> float:
    r"""Distance of rupture [m] of Willett et al., Eq. 15.

    .. math:: s_c = R \left( 1 + \tfrac12 \theta \right)
              \left( V^{*1/3} + \tfrac{1}{10} V^{*2/3} \right)

    Parameters
    ----------
    radius, volume, contact_angle : float
        As in `willett_force`.

    Returns
    -------
    float

    Raises
    ------
    ValueError
        As `willett_force`.

    Notes
    -----
    Against the stability limit of exact bridges, V* = 1e-5 to 0.1: within 0.5 % at 0 degrees, up to
    4 % too long from 10 to 50 degrees and 7 % at 60 degrees.

    Examples
    --------
    >>> print(f"{willett_rupture(2.381e-3, 74.2e-12, 0.0) * 1e3:.4f} mm")
    0.4276 mm
    """
    _checked(1.0, radius, volume, 1.0, contact_angle)
    root = (volume / radius**3) ** (1.0 / 3.0)
    return float(radius * (1.0 + 0.5 * contact_angle) * (root + 0.1 * root * root))


def lian_rupture(volume: float, contact_angle: float) -> float:
    r"""Distance of rupture [m] of Lian, Thornton and Adams, :math:`(1 + \theta/2) V^{1/3}`.

    Parameters
    ----------
    volume : float
        Volume V of the liquid [m3].
    contact_angle : float
        theta [rad], the same on both, from 0 to pi/2.

    Returns
    -------
    float

    Raises
    ------
    ValueError
        As `willett_force`.

    Notes
    -----
    Against the stability limit of exact bridges, V* = 1e-5 to 0.1: 0.4 to 5 % too short at 0
    degrees, within 4 % from 10 to 50 degrees (-4 to +4), up to 7 % too long at 60 degrees.

    Examples
    --------
    >>> print(f"{lian_rupture(74.2e-12, 0.0) * 1e3:.4f} mm")
    0.4202 mm
    """
    _checked(1.0, 1.0, volume, 1.0, contact_angle)
    return float((1.0 + 0.5 * contact_angle) * volume ** (1.0 / 3.0))


def mikami_force(
    distance: ArrayLike, radius: float, volume: float, surface_tension: float, contact_angle: float
) -> Array:
    r"""Force [N] between equal spheres, the fit of Mikami et al. to the Young-Laplace equation.

    .. math:: \frac{F}{\pi R\gamma} &= C + \exp(A s/R + B) \\
              A &= -1.1\, V^{*-0.53} \\
              B &= (-0.148 \ln V^* - 0.96) \theta^2 - 0.0082 \ln V^* + 0.48 \\
              C &= 0.0018 \ln V^* + 0.078

    Parameters
    ----------
    distance : array_like
        Distance s of the surfaces [m], 0 or more.
    radius, volume, surface_tension, contact_angle : float
        As in `willett_force`.

    Returns
    -------
    ndarray, in the shape of `distance`

    Raises
    ------
    ValueError
        As `willett_force`, but that the spheres may touch.

    Notes
    -----
    Against exact bridges of V* = 1e-3 to 0.1, from 2 to 90 % of the distance of rupture: 3 to 6 %
    on average up to 20 degrees, at most 13 %; from 40 degrees on 10 to 20 % on average and more.
    Not for smaller volumes (at V* = 1e-5 more than 38 % on average).

    The coefficients -0.34, -0.019 and 0.0042, which are in circulation too, are the same times
    2.303: they belong to common logarithms of V*. With natural ones the force comes out up to three
    times too large.

    Examples
    --------
    >>> print(f"{mikami_force(1e-4, 2.381e-3, 74.2e-12, 20.6e-3, 0.0) * 1e6:.2f} uN")
    136.01 uN
    """
    s = _checked(distance, radius, volume, surface_tension, contact_angle, touching=True)
    v = volume / radius**3
    log = math.log(v)
    a = -1.1 * v**-0.53
    b = (-0.148 * log - 0.96) * contact_angle**2 - 0.0082 * log + 0.48
    c = 0.0018 * log + 0.078
    return np.asarray(math.pi * radius * surface_tension * (c + np.exp(a * s / radius + b)))


def _polynomial(rows: tuple[tuple[float, float, float], ...], angle: float, log: float) -> float:
    return sum(
        (one + angle * (two + angle * three)) * log**power
        for power, (one, two, three) in enumerate(rows)
    )


def _checked(
    distance: ArrayLike,
    radius: float,
    volume: float,
    surface_tension: float,
    contact_angle: float,
    *,
    touching: bool = False,
) -> Array:
    """Return the distances as an array, or say what is not physical."""
    given = {"radius": (radius, "m"), "volume": (volume, "m3")}
    given["surface_tension"] = (surface_tension, "N/m")
    for name, (value, unit) in given.items():
        if not 0.0 < value < math.inf:
            raise ValueError(f"{name} = {value} {unit}: must be positive and finite")
    if not 0.0 <= contact_angle <= 0.5 * math.pi:
        raise ValueError(
            f"contact_angle = {contact_angle} rad: must be from 0 to pi/2; the fits are for "
            "liquids that wet, their angles in radians"
        )
    s = np.asarray(distance, dtype=np.float64)
    if not np.all((s >= 0.0 if touching else s > 0.0) & (s < np.inf)):
        least = "0 or more" if touching else "above 0"
        raise ValueError(f"distance: must be {least} [m] and finite; the fit ends there")
    return s
