r"""Uniform pressure on a rectangle of a half-space, by quadrature over directions.

Pressure positive in compression, displacement into the solid. Seen from a point of the surface,
each direction theta contributes the length of its chord in the rectangle, because the displacement
under a unit force decreases as 1/r: one quadrature of a bounded function.

References
----------
.. [1] A. E. H. Love, Phil. Trans. R. Soc. A 228 (1929) 377-420.
.. [2] K. L. Johnson, Contact Mechanics (1985), Sec. 3.3.
"""

from __future__ import annotations

import math

from scipy.integrate import quad

__all__ = ["displacement"]


def displacement(x: float, y: float, half_x: float, half_y: float, modulus: float) -> float:
    r"""Displacement [m] of the surface per unit pressure on a rectangle around the origin.

    .. math:: u = \frac{1}{\pi E^*} \int \ell(\theta)\, d\theta

    Parameters
    ----------
    x, y : float
        Point [m], inside the rectangle or outside.
    half_x, half_y : float
        Half sides [m].
    modulus : float
        Contact modulus E* = E / (1 - nu^2) [Pa].

    Returns
    -------
    float
        Displacement [m/Pa], with an error of about 1e-12.

    Examples
    --------
    >>> round(displacement(0.0, 0.0, 0.5, 0.5, 1.0), 9)
    1.122199705
    """

    def chord(theta: float) -> float:
        enter, leave = 0.0, math.inf
        for centre, half, way in ((x, half_x, math.cos(theta)), (y, half_y, math.sin(theta))):
            if way == 0.0:
                if abs(centre) > half:
                    return 0.0
                continue
            ends = sorted(((-half - centre) / way, (half - centre) / way))
            enter, leave = max(enter, ends[0]), min(leave, ends[1])
        return max(0.0, leave - enter)

    corners = {
        math.atan2(j * half_y - y, i * half_x - x) % (2.0 * math.pi)
        for i in (-1, 1)
        for j in (-1, 1)
    }
    breaks = [0.0, *sorted(corners), 2.0 * math.pi]
    total = 0.0
    for k, end in enumerate(breaks[1:]):
        start = breaks[k]
        if end > start:
            total += float(quad(chord, start, end, epsabs=0.0, epsrel=1e-12, limit=200)[0])
    return total / (math.pi * modulus)
