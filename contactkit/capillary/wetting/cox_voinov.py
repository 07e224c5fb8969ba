r"""Apparent contact angle of a moving line, by Cox and Voinov.

.. math:: G(\theta_d) = G(\theta_0) + Ca \ln\frac{L}{\lambda}, \qquad
          G(\theta) = \int_0^\theta \frac{x - \sin x \cos x}{2 \sin x}\,dx
          \approx \frac{\theta^3}{9}

The capillary number Ca = eta U/gamma is positive where the line advances. Plain floats.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from functools import lru_cache

from ...numerics.cubic_spline import cubic_spline
from ...numerics.quadrature import gauss_legendre
from ...numerics.roots import bracketed_root

__all__ = ["cox_function", "deposition_threshold", "dynamic_angle"]

_NODES = tuple(zip(*gauss_legendre(20), strict=True))  # to round-off up to a right angle
_SMALL = 0.05  # [rad]; below, three terms of the series are right to 1e-13
_LAST = math.pi * (1.0 - 4e-16)  # largest angle below 180 degrees that a float can tell from it
# Nodes of the inverse, up to 1e-3 below 180 degrees: right to 1e-8, and to round-off after one
# step of Newton's method, in 8 us in place of the 150 us of a bracketed root.
_INVERSE_NODES = 401
_FARTHEST = math.pi - 1e-3


def cox_function(angle: float) -> float:
    r"""Cox' function G of a contact angle [-], against a gas; infinite at 180 degrees.

    Parameters
    ----------
    angle : float
        Contact angle [rad], from 0 to pi.

    Notes
    -----
    Voinov's :math:`\theta^3/9` is 2 % more at 60 degrees, 4 % at 90, 1 % less at 143 and half as
    much at 178.

    References
    ----------
    .. [1] Cox (1986), J. Fluid Mech. 168, 169.
    .. [2] Voinov (1976), Fluid Dyn. 11, 714.

    Examples
    --------
    >>> import math
    >>> [round(9.0 * cox_function(x) / x**3, 4) for x in (0.1, math.pi / 2.0, 2.0)]
    [0.9998, 0.9659, 0.9648]
    """
    if angle >= math.pi:
        return math.inf
    if angle < _SMALL:
        square = angle * angle
        return angle * square * (1.0 / 9.0 - square / 450.0 + 13.0 / 52920.0 * square * square)
    if angle <= 0.5 * math.pi:
        return 0.5 * (_integral(angle) - math.sin(angle))
    rest = math.pi - angle  # x/sin x has its pole at pi, which the substitution integrates
    return 0.5 * (_integral(rest) - math.pi * math.log(math.tan(0.5 * rest)) - math.sin(rest))


def _integral(end: float) -> float:
    """Integral of x/sin x from 0 to an angle [rad] of a right angle at most."""
    return end * sum(w * (x * end / math.sin(x * end)) for x, w in _NODES)


def dynamic_angle(angle: float, drive: float) -> float:
    r"""Apparent contact angle [rad] of a moving line.

    Parameters
    ----------
    angle : float
        Contact angle of the line at rest [rad].
    drive : float
        :math:`Ca \ln(L/\lambda)` [-], positive where the line advances.

    Returns
    -------
    float
        0 from the threshold on at which a receding line leaves a film behind; below 180 degrees
        however fast a line advances. An angle of 180 degrees stays.

    Examples
    --------
    >>> import math
    >>> [round(math.degrees(dynamic_angle(math.pi / 3.0, x)), 3) for x in (-0.2, -0.05, 0.0, 0.05)]
    [0.0, 50.535, 60.0, 67.203]
    """
    if drive == 0.0 or angle >= math.pi:
        return angle
    wanted = cox_function(angle) + drive
    if wanted <= 0.0:
        return 0.0
    if wanted >= cox_function(_LAST):
        return _LAST
    root, (curve, last) = math.cbrt(9.0 * wanted), _inverse()
    if root < _SMALL:
        found = root + root**3 / 150.0
    elif root < last:
        found = curve(root)[0]
    else:
        found = bracketed_root(lambda x: cox_function(x) - wanted, _FARTHEST, _LAST)
    slope = (found - math.sin(found) * math.cos(found)) / (2.0 * math.sin(found))
    return found - (cox_function(found) - wanted) / slope if slope > 0.0 else found


@lru_cache(maxsize=1)
def _inverse() -> tuple[Callable[[float], tuple[float, float]], float]:
    """Angle [rad] over the cube root of 9 G, in which it is smooth, and the last such root."""
    angles = [_FARTHEST * i / (_INVERSE_NODES - 1) for i in range(_INVERSE_NODES)]
    roots = [math.cbrt(9.0 * cox_function(angle)) for angle in angles]
    return cubic_spline(roots, angles), roots[-1]


def deposition_threshold(angle: float, ratio: float) -> float:
    r"""Capillary number [-] from which on a receding line leaves a film: :math:`G/\ln(L/\lambda)`.

    Parameters
    ----------
    angle : float
        Contact angle of the line at rest [rad].
    ratio : float
        Outer length L over slip length, above 1.

    Examples
    --------
    >>> import math
    >>> round(deposition_threshold(math.radians(30.0), 1e4), 5)
    0.00172
    """
    return cox_function(angle) / math.log(ratio)
