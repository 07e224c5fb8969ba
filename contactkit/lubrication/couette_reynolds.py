r"""Sphere sliding along a flat in a round film: drag from Reynolds' equation.

The film has the height D under the apex and s at its rim, where the pressure is ambient. Sliding
generates a pressure p = P(r) cos(phi), high in front and low behind, which adds to the drag of the
shear. A force is positive when it resists. Arguments are floats or arrays and are not checked.
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

import numpy as np

if TYPE_CHECKING:
    from numpy.typing import ArrayLike

__all__ = ["lubrication_factor"]

_W = math.sqrt(2.5)
# Of a power series in at most 1/2, over s/D from 1 + 1e-9 to 1e9: 20 terms leave 5e-10, 30 leave
# 3e-14, and more than 40 change nothing.
_TERMS = 60


def lubrication_factor(gap: ArrayLike, film_height: ArrayLike) -> Any:
    r"""Drag of a sphere in a round film, over :math:`2\pi\eta R v` [-].

    .. math::
        \ln q + \tfrac35\Bigl(\ln q - 1 + \tfrac1q\Bigr)
        - \tfrac35\Bigl(\frac{x}{q}\Bigr)^2\Bigl[\tfrac45 + \tfrac25\,\frac{q\,y'}{y}\Bigr], \qquad
        y = {}_2F_1(2 + w, 2 - w; 2; -x)

    with q = s/D, x = q - 1 and w = sqrt(5/2). The first logarithm is the Couette shear at the
    local film thickness; the rest is the pressure flow.

    Parameters
    ----------
    gap, film_height : float or ndarray, shape (...)
        Gap D under the apex, film height s at the rim [m]; s > D > 0.

    Returns
    -------
    ndarray, shape (...)
        Factor [-], to 1e-13 for s/D from 1 + 1e-9 to 1e9 and more; grows as 8/5 ln(s/D).

    Notes
    -----
    The equation (r h^3 P')'/r - h^3 P/r^2 = 6 eta v h' with P(rim) = 0 has a closed solution for
    the parabola h = D + r^2/2R. Its hypergeometric function is taken by Pfaff's transformation,
    as a series in x/q up to q = 2 and, by its connection formula, in 1/q beyond. Neglected: terms
    of relative size s/R, the shape of the meniscus, and inertia. Once the wetted circles have slid
    past each other there is no closed form; taking the pressure drag in proportion to the shear
    drag is within 4 % up to L = x and 14 % at L = 1.5 x (finite differences on the lens, s/D = 2,
    10 and 100).

    References
    ----------
    The slope 8/5 is that of Goldman, Cox and Brenner (1967); the round film is solved here.

    Examples
    --------
    >>> [round(float(lubrication_factor(1.0, q)), 6) for q in (1.1, 2.0, 10.0, 1e3, 1e6)]
    [0.095415, 0.724168, 2.84291, 10.074367, 21.125345]
    """
    d, s = np.asarray(gap, dtype=np.float64), np.asarray(film_height, dtype=np.float64)
    x = (s - d) / d
    q = 1.0 + x
    z = x / q
    log = np.log1p(x)
    slope = -(2.0 - _W) + _log_slope(z, 1.0 / q) / q
    # For s close to D its terms cancel to x^3, which is below the round-off of the shear term x.
    pressure = log - z - z * z * (0.8 + 0.4 * slope)
    return log + 0.6 * pressure


def _log_slope(z: Any, rest: Any) -> Any:
    """G'/G of G = 2F1(-w, 2 - w; 2; z), where `rest` is 1 - z."""
    # The series about z = 0 stalls at the singularity z = 1 of a wide film; so does the one about 1
    # towards 0. Each serves its half. `rest` comes in since 1 - z has no digits left for q > 1e15.
    near, far = np.minimum(z, 0.5), np.minimum(rest, 0.5)
    value, slope = _series(-_W, 2.0 - _W, 2.0, near)
    # About z = 1: A f(1 - z) + B (1 - z)^(2w) g(1 - z).
    f, df = _series(-_W, 2.0 - _W, 1.0 - 2.0 * _W, far)
    g, dg = _series(2.0 + _W, _W, 1.0 + 2.0 * _W, far)
    a = math.gamma(2.0 * _W) / (math.gamma(2.0 + _W) * math.gamma(_W))
    b = math.gamma(-2.0 * _W) / (math.gamma(-_W) * math.gamma(2.0 - _W))
    power = far ** (2.0 * _W)
    beyond = a * f + b * power * g
    falls = a * df + b * power * dg + 2.0 * _W * b * far ** (2.0 * _W - 1.0) * g
    return np.where(z <= 0.5, slope / value, -falls / beyond)


def _series(a: float, b: float, c: float, z: Any) -> tuple[Any, Any]:
    """2F1(a, b; c; z) and its slope, for 0 <= z <= 1/2."""
    value, slope = np.zeros_like(z), np.zeros_like(z)
    for k in range(_TERMS, 0, -1):  # nested, from the last term
        ratio = (a + k - 1) * (b + k - 1) / ((c + k - 1) * k)
        slope = ratio * (1.0 + value + z * slope)
        value = ratio * z * (1.0 + value)
    return 1.0 + value, slope
