r"""Liquid bridges by Legendre's elliptic integrals, independent of `capillary.exact`.

A bridge is parametrised by one number that increases during a separation: the distance of its
meridian at the lower body from the inflection. Between flats all else is explicit. Lengths are in
units of the radius a of neck or bulge; angles run through the liquid; body 1 is a flat below, body
2 a flat or a sphere above, and the inflection is first reached at the lower body.

==========  ======================================================================
symbol      quantity
==========  ======================================================================
p           pressure over surface tension, times a; below 2 for a neck
f           force over :math:`2\pi\gamma a`, :math:`1 - p/2`
c           the other radius at which the meridian is vertical, :math:`2/p - 1`
==========  ======================================================================

With A and C the smaller and the larger of 1 and c in magnitude, :math:`k^2 = 1 - A^2/C^2` and
:math:`r^2 = C^2(1 - k^2\sin^2 u)`, the height is :math:`A F(u, k) + C E(u, k)`.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import NamedTuple

from scipy.integrate import quad
from scipy.optimize import brentq, minimize_scalar
from scipy.special import elliprd, elliprf

__all__ = ["EllipticBridge", "at_gaps", "at_lean", "longest"]


class EllipticBridge(NamedTuple):
    """A bridge in units of the cube root of its volume; force over surface tension."""

    gap: float
    force: float
    extremum: float
    radius_lower: float
    radius_upper: float
    curvature_upper: float


def at_lean(
    lean: float, angle_lower: float, angle_upper: float, curvature: float = 0.0
) -> EllipticBridge:
    """Bridge whose neck or bulge lies between the bodies.

    Parameters
    ----------
    lean : float
        Negative before the inflection reaches the lower body, positive beyond [-]: the pressure
        is ``1 - |cos angle_lower| - lean^2`` over a with a neck, ``1 + |cos| + lean^2`` with a
        bulge, in units of surface tension.
    angle_lower, angle_upper : float
        Contact angles [rad]; on the lower body the one that is further from a right angle. A
        neck if their sum is less than pi.
    curvature : float
        Curvature of the upper body times the radius of neck or bulge [-].

    Raises
    ------
    ValueError
        If such a meridian does not meet the bodies at these angles.

    Notes
    -----
    Double precision. Near a catenoid, |p| < 1/2, where Legendre's forms cancel, the integrals
    are taken by adaptive quadrature.

    References
    ----------
    .. [1] Orr, Scriven and Rivas (1975), J. Fluid Mech. 67, 723-742.

    Examples
    --------
    Where the inflection reaches both plates a bridge of equal angles loses its symmetry:

    >>> round(at_lean(0.0, math.pi / 3, math.pi / 3).gap, 4)
    1.4205
    """
    if angle_lower + angle_upper == math.pi or (angle_lower + angle_upper > math.pi and curvature):
        raise ValueError("a neck or, between flats, a belly is needed")
    is_neck = angle_lower + angle_upper < math.pi
    cosine = abs(math.cos(angle_lower))
    p = 1.0 - cosine - lean * lean if is_neck else 1.0 + cosine + lean * lean
    root = -lean * math.sqrt(lean * lean + 2.0 * cosine)
    lower = _meeting(p, math.sin(angle_lower), root, is_neck)
    if curvature == 0.0:
        # (1 - p)^2 - cos^2 of the upper angle, from that of the lower one
        under = root * root + (cosine - abs(math.cos(angle_upper))) * (
            cosine + abs(math.cos(angle_upper))
        )
        upper = _meeting(p, math.sin(angle_upper), math.sqrt(max(under, 0.0)), is_neck)
    else:
        upper = _on_sphere(p, angle_upper, curvature)
    height = volume = 0.0
    for radius in (lower, upper):
        dz, dv = _span(p, radius)
        height, volume = height + dz, volume + math.pi * dv
    if curvature > 0.0:
        cap = 2.0 * math.sin(0.5 * math.asin(curvature * upper)) ** 2 / curvature
        height -= cap
        volume -= math.pi * cap * cap * (1.0 / curvature - cap / 3.0)
    if not volume > 0.0:
        raise ValueError("the bodies cut into each other at this curvature")
    size = volume ** (1.0 / 3.0)
    return EllipticBridge(
        height / size,
        math.pi * (2.0 - p) / size,
        1.0 / size,
        lower / size,
        upper / size,
        curvature * size,
    )


def _meeting(p: float, sine: float, root: float, is_neck: bool) -> float:
    """Radius at which the meridian meets a flat, from the sine of its angle there."""
    radius = (2.0 - p) / (sine + root) if is_neck and sine + root != 0.0 else (sine + root) / p
    if not (radius > 0.0 and (radius >= 1.0) == is_neck):
        if abs(radius - 1.0) < 1e-12:
            return 1.0
        raise ValueError("the meridian does not lean that far")
    return radius


def _on_sphere(p: float, angle: float, curvature: float) -> float:
    """Radius at which a meridian with a neck first meets a sphere at an angle."""

    def tilt(radius: float) -> float:
        slope = math.asin(min(curvature * radius, 1.0))
        return radius * math.sin(angle + slope) - 0.5 * p * (radius * radius - 1.0) - 1.0

    step, low = 1e-2, 1.0
    while tilt(low + step * low) < 0.0:
        low += step * low
        if curvature * low * (1.0 + step) >= 1.0 or low > 1e6:
            raise ValueError("the meridian does not lean that far")
    return float(brentq(tilt, low, low + step * low, xtol=1e-300, rtol=1e-15))


def _held(lean: float, lower: float, upper: float, curvature: float) -> EllipticBridge:
    """Bridge at a lean whose upper body has a given curvature times the root of its volume."""
    if curvature == 0.0:
        return at_lean(lean, lower, upper)

    def excess(log: float) -> float:
        return at_lean(lean, lower, upper, math.exp(log)).curvature_upper / curvature - 1.0

    # From a nearly flat body up to the first solution: a small sphere is another one.
    low = math.log(curvature)
    while _cuts(lean, lower, upper, low) or excess(low) > 0.0:
        low -= 0.5
        if low < -50.0:
            at_lean(lean, lower, upper)  # says what is wrong, if that is so on a flat too
            raise ValueError("no bridge of this lean at this curvature")
    high = low
    while excess(high) < 0.0:
        low, high = high, high + 0.1
    return at_lean(lean, lower, upper, math.exp(brentq(excess, low, high, xtol=1e-15, rtol=1e-15)))


def _cuts(lean: float, lower: float, upper: float, log: float) -> bool:
    try:
        at_lean(lean, lower, upper, math.exp(log))
    except ValueError:
        return True
    return False


def longest(angle_lower: float, angle_upper: float, curvature: float = 0.0) -> EllipticBridge:
    """Bridge at its stability limit; for equal angles on flats the pitchfork.

    `curvature` is that of the upper body times the cube root of the volume [-].

    Examples
    --------
    >>> found = longest(0.0, math.pi / 3)
    >>> round(found.gap, 6)
    0.796138
    """
    shape = (angle_lower, angle_upper, curvature)
    return _held(_lean_of_limit(shape), *shape)


def _lean_of_limit(shape: tuple[float, float, float]) -> float:
    """Lean at the maximum gap, or at the pitchfork for equal angles."""
    last = 0.0
    while True:
        try:
            _held(last + 0.02, *shape)
        except ValueError:
            break
        last += 0.02
        if last > 0.6:
            break
    found = minimize_scalar(
        lambda lean: -_held(lean, *shape).gap,
        bounds=(-1.5, last),
        method="bounded",
        options={"xatol": 1e-10},
    )
    # For equal angles on flats above some 31 degrees the pitchfork comes first.
    is_even = shape[2] == 0.0 and shape[0] == shape[1]
    return min(float(found.x), 0.0) if is_even else float(found.x)


def at_gaps(
    gaps: Sequence[float], angle_lower: float, angle_upper: float, curvature: float = 0.0
) -> list[EllipticBridge]:
    """Stable bridges at gaps; gaps and curvature in units of the cube root of the volume.

    Examples
    --------
    >>> round(at_gaps([1.0], math.pi / 3, math.pi / 3)[0].force, 9)
    2.635835786
    """
    shape = (angle_lower, angle_upper, curvature)
    high = _lean_of_limit(shape)
    return [_between(gap, high, shape) for gap in gaps]


def _between(gap: float, high: float, shape: tuple[float, float, float]) -> EllipticBridge:
    """Bridge at a gap, its lean below that of the limit."""
    low, factor = min(high, 0.0) - 0.1, 1.2
    while _held(low, *shape).gap > gap:
        try:
            _held(factor * low, *shape)
        except ValueError:  # a film too thin for this curvature: go on in smaller steps
            factor = math.sqrt(factor)
            if factor < 1.0 + 1e-9:
                raise
        else:
            low = factor * low
    lean = brentq(lambda t: _held(t, *shape).gap - gap, low, high, xtol=1e-300, rtol=1e-15)
    return _held(float(lean), *shape)


def _span(p: float, radius: float) -> tuple[float, float]:
    """Height, and integral of the square of the radius over it, from the extremum to a radius."""
    if abs(p) < 0.5:
        return _span_near_catenoid(p, radius)
    other = 2.0 / p - 1.0
    is_small = abs(other) >= 1.0  # the extremum is the smaller of the two: a neck
    a, c = (1.0, other) if is_small else (other, 1.0)
    m = (c - a) * (c + a) / (c * c)
    sine = math.sqrt(min(max((c - radius) * (c + radius) / (c * c * m), 0.0), 1.0))
    u = math.asin(sine)
    ends = (0.5 * math.pi, u) if is_small else (u, 0.0)
    sign = math.copysign(1.0, p * c)
    dz, dv = (sign * (x - y) for x, y in zip(*(_integrals(a, c, m, t) for t in ends), strict=True))
    return dz, dv


def _span_near_catenoid(p: float, radius: float) -> tuple[float, float]:
    """Integrate the same by quadrature over the radius, r = 1 + v^2: Legendre's forms cancel."""

    def height(v: float) -> float:
        r = 1.0 + v * v
        upright = 1.0 + 0.5 * p * v * v * (r + 1.0)  # r times the sine of the tangent angle
        return 2.0 * upright / math.sqrt((1.0 - 0.5 * p * (r + 1.0)) * (r + upright))

    end = math.sqrt(max(radius - 1.0, 0.0))
    dz = quad(height, 0.0, end, epsabs=0.0, epsrel=1e-13, limit=200)[0]
    dv = quad(
        lambda v: (1.0 + v * v) ** 2 * height(v), 0.0, end, epsabs=0.0, epsrel=1e-13, limit=200
    )[0]
    return float(dz), float(dv)


def _integrals(a: float, c: float, m: float, u: float) -> tuple[float, float]:
    # By Carlson's forms: scipy's ellipkinc is wrong by far at some arguments near m = 1.
    sine, cosine = math.sin(u), math.cos(u)
    delta = math.sqrt(1.0 - m * sine * sine)
    first = sine * float(elliprf(cosine * cosine, delta * delta, 1.0))
    second = first - m * sine**3 / 3.0 * float(elliprd(cosine * cosine, delta * delta, 1.0))
    last = 2.0 * (2.0 - m) * second - (1.0 - m) * first + m * sine * cosine * delta
    return a * first + c * second, a * c * c * second + c**3 * last / 3.0
