"""Squeeze film: viscous force and impulse that resist the opening of a liquid-filled gap.

Reynolds' equation for a Newtonian, incompressible film between rigid, no-slip walls. A force is
positive when it resists separation, a speed positive when the gap opens. Arguments are floats or
arrays and are not checked.

=========  ======================================  =======
symbol     quantity                                unit
=========  ======================================  =======
h          gap between flats                       m
r          radius of the film                      m
D          gap under the apex of a sphere          m
R          radius of the sphere                    m
H          height of the film at its rim           m
V          volume of the film                      m3
eta        dynamic viscosity                       Pa.s
=========  ======================================  =======
"""

from __future__ import annotations

import math
from typing import Any

from ..numerics.quadrature import gauss_legendre

__all__ = [
    "disc_force",
    "disc_impulse_conserved",
    "disc_impulse_flooded",
    "disc_radius",
    "sphere_film_height",
    "sphere_force",
    "sphere_impulse_conserved",
    "sphere_impulse_flooded",
    "sphere_impulse_constant_rim",
    "sphere_rim_height",
]


def log1p(x: Any) -> Any:
    """Natural logarithm of 1 + x, of a float or of an array."""
    if isinstance(x, float | int):
        return math.log1p(x)
    import numpy as np

    return np.log1p(x)


def disc_radius(volume: Any, gap: Any) -> Any:
    r"""Radius [m] of a disc of a `volume` [m3] in a flat `gap` [m], :math:`\sqrt{V/\pi h}`."""
    return (volume / (math.pi * gap)) ** 0.5


def disc_force(radius: Any, gap: Any, speed: Any, viscosity: Any) -> Any:
    r"""Viscous force [N] of a disc of liquid between flats that separate at a speed.

    .. math:: F = \frac{3\pi}{2} \, \eta \, \frac{r^4 \dot h}{h^3}

    Parameters
    ----------
    radius, gap : float or ndarray, shape (...)
        Radius of the film and distance of the flats [m].
    speed : float or ndarray, shape (...)
        Opening speed [m/s].
    viscosity : float or ndarray, shape (...)
        Dynamic viscosity [Pa.s].

    Returns
    -------
    float or ndarray, shape (...)
        Instantaneous force [N]; positive resists.

    Notes
    -----
    Valid for r/h > 5 and Re = rho h' h/eta < 1; neglected terms are of relative size h/r and Re.

    References
    ----------
    Stefan (1874); magnitude of Eq. (3.18) of Cai and Bhushan (2007a).

    Examples
    --------
    >>> round(disc_force(3.175e-3, 2e-6, 0.04, 0.01), 4)
    23943.4129
    """
    return 1.5 * math.pi * viscosity * radius**4 * speed / gap**3


def disc_impulse_flooded(radius: Any, gap_from: Any, gap_to: Any, viscosity: Any) -> Any:
    r"""Viscous impulse [N.s] of a flooded disc from one gap to another, for any motion in time.

    .. math:: \int F \, dt = \frac{3\pi}{4} \, \eta \, r^4
              \left(\frac{1}{h_0^2} - \frac{1}{h_1^2}\right)

    Notes
    -----
    The radius is that of the faces. The printed Eq. (3.19) is this, with the opposite sign and
    divided by a time.

    Examples
    --------
    >>> round(disc_impulse_flooded(1e-7, 2e-9, float("inf"), 0.89e-3) / 1e-7 * 1e9, 6)
    524.253274
    """
    fall, ratio = _opening(gap_from, gap_to)
    return 0.75 * math.pi * viscosity * radius**4 * fall * (1.0 + ratio) / gap_from**2


def disc_impulse_conserved(volume: Any, gap_from: Any, gap_to: Any, viscosity: Any) -> Any:
    r"""Viscous impulse [N.s] of a disc of constant volume from one gap to another.

    .. math:: \int F \, dt = \frac{3 \eta V^2}{8\pi} \left(\frac{1}{h_0^4} - \frac{1}{h_1^4}\right)

    Notes
    -----
    Half of the flooded impulse for a large final gap, because the wetted radius shrinks.

    Examples
    --------
    >>> import math
    >>> volume = math.pi * 1e-7**2 * 2e-9
    >>> round(disc_impulse_conserved(volume, 2e-9, float("inf"), 0.89e-3) / 1e-7 * 1e9, 6)
    262.126637
    """
    fall, ratio = _opening(gap_from, gap_to)
    bracket = fall * (1.0 + ratio) * (1.0 + ratio * ratio)
    return 3.0 / (8.0 * math.pi) * viscosity * volume**2 * bracket / gap_from**4


def _opening(gap_from: Any, gap_to: Any) -> tuple[Any, Any]:
    """1 - h0/h1 without cancellation, and h0/h1; `gap_to` may be inf."""
    gap_to = _smaller(gap_to, 1e30 * gap_from)  # the rest of the integral is negligible
    return (gap_to - gap_from) / gap_to, gap_from / gap_to


def sphere_film_height(gap: Any, volume: Any, radius: Any) -> Any:
    r"""Film height [m] at the rim under a sphere, :math:`H = \sqrt{D^2 + V/\pi R}`.

    Notes
    -----
    Paraboloid and a film with a cylindrical rim, Eqs. (3.23) and (3.24); the curved meniscus
    changes the volume by a few per cent.
    """
    return (gap * gap + volume / (math.pi * radius)) ** 0.5


def sphere_force(radius: Any, gap: Any, film_height: Any, speed: Any, viscosity: Any) -> Any:
    r"""Viscous force [N] on a sphere lifted off a flat through a film of rim height H.

    .. math:: F = 6\pi \eta R^2 \left(1 - \frac{D}{H}\right)^2 \frac{\dot D}{D}

    Parameters
    ----------
    radius, gap, film_height : float or ndarray, shape (...)
        Radius R of the sphere, gap D under its apex, film height H at the rim [m]; H may be inf.
    speed : float or ndarray, shape (...)
        Opening speed [m/s].
    viscosity : float or ndarray, shape (...)
        Dynamic viscosity [Pa.s].

    Returns
    -------
    float or ndarray, shape (...)
        Instantaneous force [N]; positive resists.

    Notes
    -----
    Lubrication theory for a paraboloid; neglects terms of relative size D/R ln(R/D).

    References
    ----------
    Matthewson (1988); Eq. (3.22) of Cai and Bhushan (2007a).

    Examples
    --------
    >>> round(sphere_force(5e-3, 1e-9, 1e-3, 1e-3, 0.1), 9)
    47.123795556
    """
    open_fraction = 1.0 - gap / film_height
    return 6.0 * math.pi * viscosity * radius**2 * open_fraction**2 * speed / gap


def sphere_rim_height(gap: Any, rim_radius: Any, radius: Any) -> Any:
    r"""Height [m] of a film at a rim of radius a, :math:`H = D + a^2/2R`; inf if fully immersed."""
    return gap + rim_radius * rim_radius / (2.0 * radius)


def sphere_impulse_flooded(
    radius: Any, rim_radius: Any, gap_from: Any, gap_to: Any, viscosity: Any
) -> Any:
    r"""Viscous impulse [N.s] on a sphere in a film of fixed radius a (inf: fully immersed).

    .. math:: 6\pi\eta R^2 \left[\ln\frac{D_1 (D_0 + b)}{D_0 (D_1 + b)}
              - \frac{b (D_1 - D_0)}{(D_0 + b)(D_1 + b)}\right], \qquad b = \frac{a^2}{2R}

    Notes
    -----
    Fully immersed the bracket is :math:`\ln(D_1/D_0)`, which diverges as D_0 goes to 0. Round-off
    grows as D/b for b << D.

    Examples
    --------
    >>> round(sphere_impulse_flooded(5e-3, float("inf"), 1e-9, 1e-6, 0.1) * 1e6, 6)
    325.520299
    """
    travel = gap_to - gap_from
    # Divided by b throughout, so that full immersion (b = inf) needs no case of its own.
    per_b = 2.0 * radius / (rim_radius * rim_radius)
    outer = 1.0 + gap_to * per_b
    shrink = travel * per_b / ((1.0 + gap_from * per_b) * outer)
    return 6.0 * math.pi * viscosity * radius**2 * (log1p(travel / (gap_from * outer)) - shrink)


def sphere_impulse_conserved(
    radius: Any, film_height: Any, gap_from: Any, gap_to: Any, viscosity: Any
) -> Any:
    r"""Viscous impulse [N.s] on a sphere at constant volume; `film_height` is that at the start.

    .. math:: 6\pi\eta R^2 \int_{D_0}^{D_1} \left(1 - \frac{D}{H}\right)^2 \frac{dD}{D},
              \qquad H^2 = H_0^2 - D_0^2 + D^2

    Notes
    -----
    This is Eq. (3.26) without its cancellation. From a gap to infinity the integral is
    :math:`\ln(1 + E^2/4q)` with :math:`E = H^2 - D^2` (constant) and :math:`q = D H (D + H)^2`;
    the difference of two such logarithms is one log1p whose argument is a sum of positive terms.
    `gap_to` may be inf.

    Examples
    --------
    >>> round(sphere_impulse_conserved(100e-9, 2e-9, 1e-9, 39e-9, 0.89e-3) / 1e-7 * 1e9, 7)
    0.1975936
    """
    # Beyond 1e30 film heights the tail is far below round-off; inf/inf is avoided.
    gap_to = _smaller(gap_to, 1e30 * (gap_from + film_height))
    travel = gap_to - gap_from
    excess = (film_height - gap_from) * (film_height + gap_from)
    height_to = (gap_to * gap_to + excess) ** 0.5
    rise = travel * (gap_to + gap_from) / (height_to + film_height)
    sum_from, sum_to = gap_from + film_height, gap_to + height_to
    product_from, product_to = gap_from * film_height, gap_to * height_to
    q_from, q_to = product_from * sum_from**2, product_to * sum_to**2
    q_rise = product_to * (travel + rise) * (sum_to + sum_from)
    q_rise = q_rise + (gap_to * rise + film_height * travel) * sum_from**2
    quarter = 0.25 * excess * excess
    argument = quarter / q_from * (q_rise / q_to) / (1.0 + quarter / q_to)
    return 6.0 * math.pi * viscosity * radius**2 * log1p(argument)


def sphere_impulse_constant_rim(
    radius: float, film_height: float, gap_from: float, gap_to: float, viscosity: float
) -> float:
    r"""Viscous impulse [N.s] on a sphere in a film of constant rim height s.

    .. math:: 6\pi\eta R^2 \int_{D_0}^{D_1} \left(1 - \frac{D}{s}\right)^2 \frac{dD}{D}

    Parameters
    ----------
    radius, film_height, gap_from, gap_to : float
        Radius R of the sphere, film height s at the rim, gaps at start and end [m]; a film in
        equilibrium with its vapour has such a rim. Beyond a gap of s there is no film.
    viscosity : float
        Dynamic viscosity [Pa.s].

    Notes
    -----
    By quadrature over ln D, in which every term is positive: the closed form cancels as D
    approaches s.

    Examples
    --------
    >>> s, a, b = 3e-9, 1e-9, 2e-9
    >>> closed = math.log(b / a) - 2.0 * (b - a) / s + 0.5 * (b * b - a * a) / s**2
    >>> bracket = sphere_impulse_constant_rim(1.0, s, a, b, 1.0) / (6.0 * math.pi)
    >>> round(bracket / closed, 12)
    1.0
    """
    first, last = min(gap_from, film_height), min(gap_to, film_height)
    span = math.log(last / first)
    nodes, weights = gauss_legendre(48)  # round-off over 60 decades; 24 leave 5e-9 over 30
    left = (1.0 - first * math.exp(span * t) / film_height for t in nodes)
    bracket = span * sum(w * y * y for w, y in zip(weights, left, strict=True))
    return 6.0 * math.pi * viscosity * radius**2 * bracket


def _smaller(a: Any, b: Any) -> Any:
    if isinstance(a, float | int) and isinstance(b, float | int):
        return min(a, b)
    import numpy as np

    return np.minimum(a, b)
