r"""Delaunay surfaces: meridians of constant mean curvature between two contact lines.

Conventions: body 1 lies below, body 2 above; contact angles run through the liquid; a force is
positive when it pulls the bodies together and is divided by the surface tension, so it is a
length; pressure is that of the liquid less that outside, over the surface tension; no gravity.

Lengths are over the neck radius `a` of the meridian or its continuation (its bulge radius for
e < 0), from which the arc length s counts:

============================  ================================================================
:math:`e = 1 - aP`            shape: above 1 nodoid with P < 0, 1 catenoid, down to 0 unduloid
                              from its neck, 0 cylinder, down to -1 unduloid from its bulge,
                              -1 sphere, below that nodoid with P > 0
:math:`p = 1 - e`             pressure times a
:math:`g = 1 + e`             force over :math:`\pi a`
:math:`k`                     curvature of a body times a
:math:`\psi`                  phase of an end, :math:`e\sin\psi = \cos\theta - (1 + e) k`; it is
                              0 for a thin film and :math:`\pi/2` where a bridge between equal
                              bodies becomes unstable against tilt of the profile
:math:`\beta`                 slope of a body at its contact line
============================  ================================================================

.. math::
    r^2 = 1 + e w, \quad w = s^2 \operatorname{sinc}^2(ps/2), \quad
    r \sin\varphi = 1 + p e w / 2, \quad r \cos\varphi = e \sin(ps) / p

hold for every shape and are entire in e and s; the arc length at an end follows from its phase in
closed form; only the height and the volume are integrals. The module does without numpy: the
elementary functions are an argument, so that one code serves floats, complex numbers (for exact
derivatives) and arrays.
"""

from __future__ import annotations

import cmath
import math
from collections.abc import Callable
from typing import Any, NamedTuple

__all__ = [
    "COMPLEX",
    "NUMBERS",
    "Body",
    "Elementary",
    "End",
    "Ends",
    "body",
    "ends",
    "integrand",
    "is_round",
    "reach",
]

_RIGHT = math.pi / 2.0
_TINY = 1e-300  # avoids 0/0 at the cylinder and at s = 0; lost beside any other number
# Square of an angle over which a ratio of type (sin x/x - cos x)/x^2 is drawn to its limit 1/3, in
# derivatives only. 1e-8 leaves 1e-11 of them in the median; below 1e-12 single ones lose 8 digits.
_SMALL = 1e-10
# Shapes below this are integrated from the bulge. The map from the neck degenerates at e = 0, that
# from the bulge at e = 1; in between the choice does not matter: 0.02 to 0.9 agree to 3e-15.
_ROUND = 0.2


class Elementary(NamedTuple):
    """Elementary functions for one type of number."""

    sin: Callable[[Any], Any]
    cos: Callable[[Any], Any]
    sqrt: Callable[[Any], Any]
    sinh: Callable[[Any], Any]
    cosh: Callable[[Any], Any]
    asinh: Callable[[Any], Any]
    atan: Callable[[Any], Any]
    expm1: Callable[[Any], Any]
    where: Callable[[Any, Any, Any], Any]
    stack: Callable[[Any, Any], Any] | None = None  # stacks two arrays, to halve the calls


def _either(condition: Any, first: Any, second: Any) -> Any:
    return first if condition else second


def _expm1(value: complex) -> complex:
    half = cmath.sinh(0.5 * value)
    return 2.0 * half * cmath.exp(0.5 * value)


COMPLEX = Elementary(
    cmath.sin,
    cmath.cos,
    cmath.sqrt,
    cmath.sinh,
    cmath.cosh,
    cmath.asinh,
    cmath.atan,
    _expm1,
    _either,
)
NUMBERS = Elementary(
    math.sin, math.cos, math.sqrt, math.sinh, math.cosh, math.asinh, math.atan, math.expm1, _either
)


class Body(NamedTuple):
    """A body: sine and cosine of its contact angle, 1 - sine, 1 + cosine, and its curvature."""

    sine: Any
    cosine: Any
    one_minus_sine: Any
    one_plus_cosine: Any
    curvature: Any


class End(NamedTuple):
    """An end of a meridian, lengths over the neck radius.

    Arc length from the neck and tan(p S / 2), contact radius, height and volume of the cap of the
    body within the contact line, sine of the tangent angle.
    """

    arc: Any
    half_tangent: Any
    radius: Any
    sag: Any
    cap: Any
    sine: Any


class Ends(NamedTuple):
    """Shape e, p, g, both ends, and the sines of their phases."""

    shape: Any
    pressure: Any
    force: Any
    limiting: End
    second: End
    sine_limiting: Any
    sine_second: Any


def body(m: Elementary, angle: Any, curvature: Any) -> Body:
    """A body from its contact angle [rad]; 0, a right angle and pi are exact."""
    tilt = _RIGHT - angle
    return Body(
        m.cos(tilt),
        m.sin(tilt),
        2.0 * m.sin(0.5 * tilt) ** 2,
        2.0 * m.cos(0.5 * angle) ** 2,
        curvature,
    )


def _arc(m: Elementary, tangent: Any, pressure: Any) -> tuple[Any, Any]:
    """Arc length S and z = tan(p S / 2) from 2 z / p, regular at p = 0."""
    z = 0.5 * pressure * tangent
    small = abs(z.real) < 1e-4
    quotient = m.where(small, 1.0 - z * z / 3.0, m.atan(z) / m.where(small, 1.0, z))
    return tangent * quotient, z


def _end(m: Elementary, solid: Body, k: Any, shape: Any, pull: Any, phase: Any) -> End:
    r"""End with the phase (sin, cos, 1 - cos, sin + k), from the neck outwards.

    The contact line is a root of a quadratic in :math:`\tan\beta / k`, in the form without
    cancellation; w/e likewise is regular at the cylinder.
    """
    sine, cosine, one_minus_cosine, rest = phase
    p = 1.0 - shape
    # The quadratic has the solutions top/below and above/top': of the two forms that are equal, the
    # one whose terms add is taken, by the sign of `lever`. `first` and `second` are w times the
    # same square, written so that they vanish with a thin film and at the cylinder, not by
    # difference.
    lever = shape * cosine
    outer = lever.real >= 0.0
    above = p - 2.0 * k * solid.cosine + pull * k * k
    top = m.where(outer, pull, solid.sine - lever)
    below = m.where(outer, solid.sine + lever, above)
    square = below * below + (k * top) * (k * top)
    size = m.sqrt(square)
    radius, sine_beta, cosine_beta = top / size, k * top / size, below / size
    short = solid.one_minus_sine * cosine + one_minus_cosine  # 1 - sin(theta) cos(psi)
    first = 2.0 * (short + shape * sine * sine + pull * k * sine)
    flat = 1.0 - k * k
    second = 2.0 * flat * (short + p * k * sine) - 2.0 * shape * (
        flat * sine * sine + 2.0 * k * rest * (1.0 + k * sine)
    )
    w = m.where(outer, first, second) / square
    # Two expressions of cos(phi)/e, each 0/0 somewhere: at the equator of the body, and at e = 0.
    upright = abs(cosine_beta.real) > 0.01
    lean = m.where(
        upright,
        (rest - 0.5 * k * p * w) / m.where(upright, cosine_beta, 1.0),
        (solid.cosine * cosine_beta - solid.sine * sine_beta) / shape,
    )  # cos(phi) / e
    across, half_sine = radius * lean, 0.25 * p * p * w  # sin(ps) / p and sin(ps/2)^2
    # tan of the half angle as sin/(1 + cos) or (1 - cos)/sin, whichever does not cancel
    late = half_sine.real > 0.5
    arc, z = _arc(m, m.where(late, w, across) / m.where(late, across, 1.0 - half_sine), p)
    sag = k * radius * radius / (1.0 + cosine_beta)
    cap = math.pi / 6.0 * sag * (3.0 * radius * radius + sag * sag)
    return End(arc, z, radius, sag, cap, solid.sine * cosine_beta + solid.cosine * sine_beta)


def ends(
    m: Elementary,
    neck_radius: Any,
    chart: Any,
    limiting: Body,
    second: Body,
    symmetric: Any = False,
) -> Ends:
    r"""Both ends of the meridian at a point of the chart.

    .. math::
        e = \frac{\cos\theta_b - k_b}{1 + k_b} \cosh\zeta, \qquad
        \sin\psi_b + k_b = \frac{1 + k_b}{\cosh\zeta}

    Parameters
    ----------
    m : Elementary
        Functions for the kind of number of the other arguments.
    neck_radius, chart : number or array
        Neck radius `a` [m], and zeta [-]: infinite for a thin film, zero where the phase of the
        limiting end is a right angle, negative beyond it.
    limiting, second : Body
        The body whose end reaches that phase first (limiting end), and the other one.
    symmetric : bool or array
        Whether both ends have the same phase, as between equal bodies.

    Returns
    -------
    Ends
        Shape and ends, lengths over the neck radius. Where the second end has no phase, its sine
        exceeds one and its values are invalid.
    """
    k, k_second = limiting.curvature * neck_radius, second.curvature * neck_radius
    wide = m.cosh(chart)
    half = m.sinh(0.5 * chart)
    rest = (1.0 + k) / wide
    sine = rest - k
    # zeta is infinite for a thin film and zero at a right angle: there 1 - sin(psi) = O(zeta^2)
    # keeps all digits, which the phase itself as the unknown would lose; past it the sign of zeta
    # goes on.
    near = 2.0 * (1.0 + k) * half * half / wide  # 1 - sin(psi)
    cosine = half * m.sqrt(2.0 * (1.0 + k) * (1.0 - k + rest) / wide)
    shape = (limiting.cosine - k) / rest + _TINY
    pull = m.where(abs(chart.real) < 1.0, (limiting.one_plus_cosine - near) / rest, 1.0 + shape)
    phase = (sine, cosine, _one_less(m, sine, cosine), rest)
    rest_second = m.where(symmetric, rest, (second.cosine - k_second) / shape)
    sine_second = rest_second - k_second
    lead = (limiting.cosine - second.cosine - (k - k_second) * pull) / shape
    total = (limiting.cosine + second.cosine - (k + k_second) * pull) / shape  # of the two sines
    square = m.where(
        abs(sine_second.real) < 0.9,
        1.0 - sine_second * sine_second,
        cosine * cosine + lead * total,
    )
    open_ = square.real > 0.0
    cosine_second = m.where(symmetric, cosine, m.sqrt(m.where(open_, square, _TINY)))
    phase_second = (
        sine_second,
        cosine_second,
        _one_less(m, sine_second, cosine_second),
        rest_second,
    )
    first, last = _both(m, (limiting, k, phase), (second, k_second, phase_second), shape, pull)
    return Ends(
        shape, 1.0 - shape, pull, first, last, sine, m.where(open_ | symmetric, sine_second, 2.0)
    )


def _both(m: Elementary, one: Any, two: Any, shape: Any, pull: Any) -> tuple[End, End]:
    """Both ends, in one call where two can be stacked."""
    if m.stack is None:
        first = _end(m, one[0], one[1], shape, pull, one[2])
        return first, _end(m, two[0], two[1], shape, pull, two[2])
    solid = Body(*(m.stack(a, b) for a, b in zip(one[0], two[0], strict=True)))
    phase = tuple(m.stack(a, b) for a, b in zip(one[2], two[2], strict=True))
    end = _end(m, solid, m.stack(one[1], two[1]), shape, pull, phase)
    return End(*(value[0] for value in end)), End(*(value[1] for value in end))


def _one_less(m: Elementary, sine: Any, cosine: Any) -> Any:
    """1 - cosine, without cancellation."""
    acute = cosine.real > 0.0
    return m.where(acute, sine * sine / m.where(acute, 1.0 + cosine, 1.0), 1.0 - cosine)


def is_round(shape: Any) -> Any:
    """Whether a shape has no neck at s = 0 that is narrow compared with its length."""
    return shape < _ROUND


def reach(m: Elementary, shape: Any, end: End, *, from_bulge: bool) -> Any:
    """Stretched arc length of an end, see `integrand`; `from_bulge` from `is_round`."""
    return m.asinh(end.half_tangent if from_bulge else end.arc * m.sqrt(shape))


def integrand(
    m: Elementary, shape: Any, stretched: Any, *, from_bulge: bool
) -> tuple[Any, Any, Any, Any]:
    r"""Integrands of height and volume (over pi) in stretched arc length, and derivatives by e.

    The stretching moves the branch points of r, which lie at a complex arc length, to a distance of
    a right angle: :math:`\sqrt e\, s = \sinh v` from a neck, and the Gudermannian
    :math:`\tan(ps/2) = \sinh v` from a bulge or a cylinder.
    """
    p = 1.0 - shape
    grown = m.expm1(stretched)
    stretch = 0.5 * (grown + grown / (grown + 1.0))  # sinh
    rate = m.sqrt(1.0 + stretch * stretch)
    if from_bulge:
        x, sine, cosine = m.atan(stretch) + _TINY, stretch / rate, 1.0 / rate
        jacobian = 2.0 / p * cosine
        s, chord = 2.0 / p * x, 2.0 / p * sine
    else:
        root = m.sqrt(shape)
        s, jacobian = stretch / root, rate / root
        x = 0.5 * p * s + _TINY
        sine = m.sin(x)
        cosine = m.sqrt(1.0 - sine * sine)  # no end lies beyond half a period
        chord = s * (sine / x)
    w = shape * chord * chord
    square = 1.0 + w
    lean = 1.0 + 0.5 * p * w  # r sin(phi)
    inverse = jacobian / m.sqrt(square)
    # (sin x / x - cos x) / x^2, to six digits at least: used in derivatives only
    turn = (sine / x - cosine + _SMALL / 3.0) / (x * x + _SMALL)
    w_by_e = chord * (chord + (0.5 * shape * p) * s * s * s * turn)  # of w by e
    rise_lean = 0.5 * (p * w_by_e - w)
    half = 0.5 * lean * w_by_e
    return (
        inverse * lean,
        inverse * lean * square,
        inverse * (rise_lean - half / square),
        inverse * (rise_lean * square + half),
    )
