r"""Cavity in the middle of a disc of film between flats: its edge, its force, what flows in.

Within the edge the film has ruptured and has one pressure; between edge and rim it is full, and
Reynolds' equation has a closed solution:

.. math:: k \, r \, p' = \tfrac12 v r^2 + C, \qquad
          C = \frac{k \, \Delta p - \tfrac14 v (R^2 - c^2)}{\ln(R/c)}, \qquad k = \frac{h^3}{12\eta}

Where the liquid recedes the pressure has no slope at the edge, so that :math:`C = -v c^2/2`
(Swift-Stieber); where it returns the edge is wherever the liquid that has come in puts it. The
flow into the film from its rim, less what the opening face takes up, is the same :math:`C` in both:

.. math:: \dot W = -2\pi C

is the growth of the void. Arguments are floats and are not checked.

=========  ================================================  =======
symbol     quantity                                          unit
=========  ================================================  =======
h          gap                                               m
v          opening speed                                     m/s
k          conductance of the film, h^3/(12 eta)             m3/(Pa.s)
c, R       radius of the edge of the cavity and of the rim   m
rho        c^2/R^2, fraction of the disc within the edge     1
dp         pressure at the rim less that of the cavity       Pa
sigma      v R^2/(4 k dp): 1 where a cavity can begin         1
=========  ================================================  =======

References
----------
Jakobsson and Floberg (1957) and Olsson (1965), for the conditions on the edge.
"""

from __future__ import annotations

import math
from typing import NamedTuple

__all__ = ["FilmRing", "Inflow", "film_ring", "inflow", "receding_edge"]

# 1 - x/2 - x^2/12 - x^3/24 - ... is x/ln(1/(1 - x)); these are the coefficients from x^2 on.
_GREGORY = (
    1 / 12, 1 / 24, 19 / 720, 3 / 160, 863 / 60480, 275 / 24192, 33953 / 3628800, 8183 / 1036800,
)  # fmt: skip
# Width of the ring, as 1 - rho, below which the series above stands in for the closed form, which
# cancels to its cube. At 0.03 both are off by 1e-12; at 0.01 the closed form, and at 0.06 the eight
# terms, by 9e-12.
_NARROW = 0.03


def receding_edge(sigma: float) -> float:
    r"""Fraction of the disc within the edge of a cavity from which the liquid recedes.

    .. math:: 1 - \rho + \rho \ln\rho = 1/\sigma

    Parameters
    ----------
    sigma : float
        Tension that the full film would have in its centre, over that of the cavity [-]. Up to 1
        there is no cavity.

    Returns
    -------
    float
        (c/R)^2 [-].

    Examples
    --------
    >>> receding_edge(1.0), round(receding_edge(3.0) ** 0.5, 9), round(receding_edge(1e12), 9)
    (0.0, 0.551884175, 0.999998586)
    """
    if sigma <= 1.0:
        return 0.0
    full = 1.0 / sigma
    # Newton's method from either end, in the variable that is small there: 1 - rho of a narrow ring
    # is lost in round-off in rho itself. Both functions are convex, and the starts lie on the side
    # from which the iterates are monotone: no bracket is needed.
    if full < 0.5:  # a ring that is narrow or of medium width, x = 1 - rho
        x = math.sqrt(2.0 * full)
        for _ in range(60):
            change = (_pressure_of(x) - full) / -math.log1p(-x)
            x -= change
            if abs(change) <= 1e-16 * x:
                break
        return 1.0 - x
    rest = 1.0 - full  # rho (1 - ln rho)
    rho = rest / (1.0 - math.log(rest / (1.0 - math.log(rest))))
    for _ in range(60):
        log = math.log(rho)
        change = (rho * (1.0 - log) - rest) / -log
        rho -= change
        if abs(change) <= 1e-16 * rho:
            break
    return rho


def _pressure_of(x: float) -> float:
    """1 - rho + rho ln(rho) of x = 1 - rho, without cancellation."""
    if x > 0.1:
        return x + (1.0 - x) * math.log1p(-x)
    term, total, n = x * x, 0.0, 2
    while term > 1e-18 * x * x:
        total += term / (n * (n - 1))
        term *= x
        n += 1
    return total


class FilmRing(NamedTuple):
    """Force of a full ring of film around a cavity, and its slope.

    `force` [N] resists opening; `by_speed` [N.s/m] at an edge that stays, which is also that at
    an edge from which the liquid recedes.
    """

    force: float
    by_speed: float


def film_ring(rho: float, rim_square: float, k: float, drop: float, speed: float) -> FilmRing:
    r"""Force [N] of a ring of film around a cavity, with that of the cavity itself.

    .. math:: F = \pi R^2 \left[\Delta p \frac{1-\rho}{\ln(1/\rho)} + \frac{v R^2}{8 k}
              \left(1 - \rho^2 - \frac{2 (1-\rho)^2}{\ln(1/\rho)}\right)\right]

    Parameters
    ----------
    rho : float
        Fraction of the disc within the edge, (c/R)^2 [-]; 0: no cavity, the film is full.
    rim_square : float
        Square R^2 of the radius of the film [m2].
    k : float
        Conductance h^3/(12 eta) of the film [m3/(Pa.s)].
    drop : float
        Pressure around the film less that of the cavity [Pa].
    speed : float
        Opening speed [m/s].

    Examples
    --------
    The cavity of an opening three times as fast as the first one at which the film cavitates:

    >>> k = 5e-6**3 / 1.2
    >>> speed = 3.0 * 4.0 * k * 1e6 / 3.175e-3**2
    >>> round(film_ring(receding_edge(3.0), 3.175e-3**2, k, 1e6, speed).force, 9)
    22.973531617
    """
    disc, width = math.pi * rim_square, 1.0 - rho
    if rho <= 0.0:
        by_speed = 0.125 * disc * rim_square / k
        return FilmRing(by_speed * speed, by_speed)
    if width < _NARROW:
        rest = power = width * width
        rest *= _GREGORY[0]
        for coefficient in _GREGORY[1:]:
            power *= width
            rest += coefficient * power
        held, shape = 1.0 - 0.5 * width - rest, 0.25 * width * rest
    else:
        held = width / -math.log(rho)
        shape = 0.125 * width * (1.0 + rho - 2.0 * held)
    by_speed = disc * rim_square / k * shape
    return FilmRing(disc * drop * held + by_speed * speed, by_speed)


class Inflow(NamedTuple):
    """Growth of the void in a film [m3/s], and its slopes.

    `by_edge` [m/s] is over the square of the radius of the edge, `by_rim` over that of the rim.
    `returns` is what flows over the edge into the void [m3/s]: negative where the liquid recedes.
    """

    growth: float
    by_edge: float
    by_rim: float
    returns: float


def inflow(edge_square: float, rim_square: float, k: float, drop: float, speed: float) -> Inflow:
    r"""Growth of the void of a film with a cavity, :math:`\dot W = -2\pi C`, and its slopes.

    Parameters
    ----------
    edge_square, rim_square : float
        Squares of the radii of the edge and of the rim [m2], 0 < c^2 < R^2.
    k, drop, speed : float
        As in `film_ring`.

    Examples
    --------
    At rest liquid returns; where it recedes, nothing flows over the edge:

    >>> inflow(0.5, 1.0, 1.0, 1.0, 0.0).growth < 0.0
    True
    >>> abs(inflow(receding_edge(3.0), 1.0, 1.0, 1.0, 12.0).returns) < 1e-12
    True
    """
    log = math.log(rim_square / edge_square)
    if rim_square < 1.03 * edge_square:
        log = math.log1p((rim_square - edge_square) / edge_square)
    c = 2.0 * (k * drop - 0.25 * speed * (rim_square - edge_square)) / log
    by_edge = (0.5 * speed + c / edge_square) / log
    by_rim = -(0.5 * speed + c / rim_square) / log
    tau = 2.0 * math.pi
    return Inflow(-tau * c, -tau * by_edge, -tau * by_rim, tau * (0.5 * speed * edge_square + c))
