r"""A film of rigid bodies in series with a spring: the first correction by bodies that deform.

In a small vibration the film has :math:`G'' = \omega c(h)`, and its first storage modulus is that
of a damper in series with a spring (a Maxwell element), :math:`G' = G''^2/k`, of the stiffness

.. math::
    k = \frac{4\,2^{7/2}}{3 \pi} E^* \sqrt{R h} \quad \text{(sphere)}, \qquad
    k = \frac{315 \pi^2}{2048} E^* R \quad \text{(flat face of radius R)}

that is 4.80 :math:`E^* \sqrt{R h}` and 1.518 :math:`E^* R`. Held against the engine of deforming
bodies, in pulls of a sphere from rest at a constant speed, in parts of the largest force:

======  ====================  ============================  ==================
beta    of the largest force  after a quarter of h/v        at any time before
======  ====================  ============================  ==================
1e-3    0.2 %                 0.05 %                        4.3 %
0.01    1.3 %                 0.8 %                         4.6 %
0.02    1.9 %                 1.1 %                         4.9 %
0.1     3.9 %                 6 %                           6 %
1       9 %                   10 %                          10 %
======  ====================  ============================  ==================

The force builds up within some beta h/v, in which the bodies do not answer as one spring.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from numpy.typing import NDArray

    Floats = NDArray[np.float64]

__all__ = ["HOLDS_TO", "series_error", "series_pull", "series_stiffness"]

HOLDS_TO = 0.02
"""beta up to which the largest force is right to 2 %."""
_SPHERE, _FLAT = 4.0 * 2.0**3.5 / (3.0 * math.pi), 315.0 * math.pi**2 / 2048.0


def series_stiffness(radius: float, width: float, modulus: float) -> float:
    """Stiffness of the spring [N/m].

    Parameters
    ----------
    radius, width, modulus : float
        R [m], inf of a flat; sqrt(R h), or the radius of the flat [m]; E* [Pa].

    Examples
    --------
    >>> [round(series_stiffness(R, 1.0, 1.0), 3) for R in (1.0, math.inf)]
    [4.802, 1.518]
    """
    return (_FLAT if math.isinf(radius) else _SPHERE) * modulus * width


def series_error(beta: float) -> float:
    """Bound of the error of the largest force, at a displacement beta by the film up to 1.

    Examples
    --------
    >>> [float(f"{series_error(beta):.2g}") for beta in (1e-3, 2e-2, 1.0)]
    [0.0044, 0.02, 0.14]
    """
    return 0.014 * math.sqrt(beta / 1e-2)


def series_pull(
    damping: Callable[[float], float],
    stiffness: Callable[[float], float],
    gap: float,
    speed: float,
    times: Floats,
) -> Floats:
    r"""Force of a film in series with a spring, pulled from rest at a constant speed [N].

    Parameters
    ----------
    damping, stiffness : callable
        c [N.s/m] and k [N/m] over the gap of the film [m].
    gap, speed : float
        At the start [m], and of the pull [m/s].
    times : ndarray, shape (n,)
        From 0 on [s].

    Notes
    -----
    :math:`\dot F = k(h) (v - F/c(h))` and :math:`\dot h = F/c(h)`, by Radau's method to 1e-8.
    """
    from scipy.integrate import solve_ivp

    def rates(_: float, state: Floats) -> list[float]:
        force, film = state
        opens = force / damping(film)
        return [stiffness(film) * (speed - opens), opens]

    scale = damping(gap) * speed
    found = solve_ivp(
        rates,
        (0.0, float(times[-1])),
        [0.0, gap],
        "Radau",
        times,
        rtol=1e-8,
        atol=[1e-10 * scale, 1e-10 * gap],
    )
    force: Floats = found.y[0]
    return force
