r"""A rigid sphere on a viscoelastic half-space: closed forms for growing and shrinking contacts.

R is the radius of the sphere, nu the constant Poisson's ratio, E(t) and J(t) the relaxation modulus
and the creep compliance in tension, delta the approach.

References
----------
.. [1] E. H. Lee, J. R. M. Radok, J. Appl. Mech. 27 (1960) 438-444: contacts that only grow.
.. [2] T. C. T. Ting, J. Appl. Mech. 33 (1966) 845-854: contacts that grow, then shrink.
.. [3] K. L. Johnson, Contact Mechanics (1985), section 6.5.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

__all__ = ["Rebound", "Triangle", "creep_radius", "triangular_approach"]

Array = NDArray[np.float64]

_NODES = 64  # of Gauss-Legendre quadratures of smooth functions, over a few relaxation times


def creep_radius(
    load: float, radius: float, poisson_ratio: float, compliance: Array | float
) -> Array | float:
    r"""Contact radius [m] at the creep compliance J(t) [1/Pa] under a load that is held.

    .. math:: a^3 = \tfrac34 (1 - \nu^2) R F J(t), \qquad \delta = a^2/R

    Valid while the load does not fall (Lee and Radok, Eq. 26 for nu = 1/2).

    Examples
    --------
    >>> round(float(creep_radius(4.0, 1.0, 0.0, 1.0 / 3.0)), 12)
    1.0
    """
    return (0.75 * (1.0 - poisson_ratio**2) * radius * load * compliance) ** (1.0 / 3.0)


class Triangle(NamedTuple):
    """Approach at a constant speed [m/s] until `turn` [s], and retraction at the same speed."""

    speed: float
    turn: float


class Rebound(NamedTuple):
    """Load [N] and contact radius [m] at a time."""

    load: float
    contact_radius: float


def triangular_approach(
    time: float,
    path: Triangle,
    radius: float,
    poisson_ratio: float,
    modulus: Callable[[Array], Array],
) -> Rebound:
    r"""Load and contact radius at a time of a triangular approach.

    .. math:: F(t) = \frac{4 \sqrt R}{3 (1 - \nu^2)} \int_0^{t_1}
              E(t - s)\, \frac{d}{ds} \delta^{3/2}(s)\, ds, \qquad a^2 = R\, \delta(t_1)

    with t_1 = t while the approach grows; after the turn the contact is that of the time t_1
    before it for which ``int E(t - s) delta'(s) ds`` over t_1 to t vanishes. No load and no contact
    is left where there is none (Ting, Eqs. 34 to 43).

    Parameters
    ----------
    time : float
        Time [s].
    path : Triangle
        Speed and turn.
    radius, poisson_ratio : float
        Of the sphere [m], of the half-space [-].
    modulus : callable
        Relaxation modulus E [Pa] at times [s].

    Examples
    --------
    An elastic solid at the depth 1 on both branches:

    >>> path, solid = Triangle(1.0, 2.0), lambda t: np.full_like(t, 0.75)
    >>> [round(triangular_approach(t, path, 1.0, 0.0, solid).load, 6) for t in (1.0, 3.0)]
    [1.0, 1.0]
    """
    nodes, weights = np.polynomial.legendre.leggauss(_NODES)

    def relaxed(start: float, end: float) -> float:
        s = start + 0.5 * (end - start) * (1.0 + nodes)
        return float(0.5 * (end - start) * (weights @ modulus(time - s)))

    last = time
    if time > path.turn:
        back = relaxed(path.turn, time)
        low, high = 0.0, path.turn
        if relaxed(0.0, path.turn) <= back:
            return Rebound(0.0, 0.0)
        for _ in range(60):
            last = 0.5 * (low + high)
            low, high = (last, high) if relaxed(last, path.turn) > back else (low, last)
    # With s = last y^2 the square root of the slope is smooth.
    y = 0.5 * (1.0 + nodes)
    s = last * y**2
    slope = 1.5 * path.speed**1.5 * math.sqrt(last) * y
    integral = last * float(weights @ (modulus(time - s) * slope * y))
    load = 4.0 * math.sqrt(radius) / (3.0 * (1.0 - poisson_ratio**2)) * integral
    return Rebound(load, math.sqrt(radius * path.speed * last))
