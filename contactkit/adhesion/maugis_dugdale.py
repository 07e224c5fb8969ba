r"""Maugis-Dugdale adhesion: a cohesive zone of constant stress; the transition from DMT to JKR.

Contact up to the radius a; from there to c the surfaces are apart by less than the range
:math:`h_0 = w/\sigma_0` and attract with the stress sigma_0. In the units of `parameters`,
with :math:`s^2 = c^2 - a^2`, :math:`\varphi = \arctan(s/a)` and the transition parameter lambda:

.. math::
    1 &= \frac{\lambda}{2} \left[ s^2 \varphi + a (s - a \varphi) \right]
         + \frac{4 \lambda^2}{3} \left[ s \varphi - \frac{s^2}{a + c} \right] \\
    P &= a^3 - \lambda (a s + c^2 \varphi), \qquad \delta = a^2 - \tfrac{4}{3} \lambda s

The first is Maugis' condition that the cohesive zone ends at the range h_0, arranged so that no
terms cancel for a narrow zone (JKR) and that a = 0 is regular (DMT). A tensile load P is negative;
the gap is the negative of the approach delta.

For :math:`\lambda < 0.938` the attraction outlasts the contact: with a = 0, a disc of radius c
still attracts,

.. math:: -\delta = \frac{2}{\pi \lambda} - \frac{c^2}{2} + \frac{8 \lambda c}{3 \pi}, \qquad
          -P = \frac{\pi}{2} \lambda c^2

Arguments are floats and are not checked.

References
----------
.. [1] D. Maugis, J. Colloid Interface Sci. 150 (1992) 243.
.. [2] K. L. Johnson and J. A. Greenwood, J. Colloid Interface Sci. 192 (1997) 326: apart.
"""

from __future__ import annotations

import math
from typing import NamedTuple

from ..numerics.roots import bracketed_root, newton_root

__all__ = [
    "PARTS_BEFORE_RELEASE",
    "Cohesion",
    "Limits",
    "at_gap",
    "at_load",
    "at_radius",
    "limits",
]

PARTS_BEFORE_RELEASE = (9.0 * math.pi / (16.0 * (math.pi - 1.0))) ** (1.0 / 3.0)
"""Transition parameter, 0.938, below which the contact is lost before the attraction."""

_TWO_THIRDS, _FOUR_THIRDS = 2.0 / 3.0, 4.0 / 3.0  # of Maugis' equations in his units


class Cohesion(NamedTuple):
    """A contact and its cohesive zone; contact radius 0 out of contact."""

    contact_radius: float
    cohesive_radius: float
    load: float
    approach: float


class Limits(NamedTuple):
    """Limit states of an adhesive contact.

    `pull_off` is the state of maximum tensile load (pull-off under load control); `release` that of
    maximum gap (pull-off under displacement control); `touch` that of contact in a point (equal to
    `release` where the contact ends there).
    """

    pull_off: Cohesion
    release: Cohesion
    touch: Cohesion


def _less_its_arctangent(t: float) -> float:
    """Return t - arctan(t), by its series where the two cancel."""
    if t > 0.3:  # beyond, the difference loses less than two digits; at 0.1 it loses two and a half
        return t - math.atan(t)
    square, total = t * t, 0.0
    for k in range(16, 0, -1):
        total = 1.0 / (2.0 * k + 1.0) - square * total
    return t * square * total


def _energy(a: float, s: float, transition: float) -> tuple[float, float]:
    """Right-hand side of the condition on the cohesive zone, and its derivative by s."""
    angle, c = math.atan2(s, a), math.hypot(a, s)
    thin = a * a * _less_its_arctangent(s / a) if a > s else a * (s - a * angle)
    bent, flat = s * s * angle + thin, s * angle - s * s / (a + c)
    d_bent = 2.0 * s * (angle + a * s / (c * c))
    d_flat = angle + s * (a - c) / (c * c)
    value = transition * (0.5 * bent + _FOUR_THIRDS * transition * flat)
    return value, transition * (0.5 * d_bent + _FOUR_THIRDS * transition * d_flat)


def _loss(a: float, s: float, transition: float) -> float:
    """Derivative of `_energy` by a, over a; it has a limit at a = 0."""
    square = a * a + s * s
    bent = s * a / square - math.atan2(s, a)
    flat = s * s / (square * (a + math.sqrt(square)))
    return transition * (bent - _FOUR_THIRDS * transition * flat)


def _spread(a: float, s: float, transition: float) -> float:
    """Derivative ds/da along the solutions, over a."""
    return -_loss(a, s, transition) / _energy(a, s, transition)[1]


def _width(a: float, transition: float) -> float:
    """Solve the condition on the cohesive zone for s, by Newton's method in logarithms."""
    # s runs over decades with the transition parameter, and the condition is close to a power of s:
    # Newton's method in logarithms needs no bracket. For a = 0 it is quadratic, and starts there.
    b, q = _TWO_THIRDS * (math.pi - 2.0) * transition, 0.25 * math.pi * transition
    s = 2.0 / (b * transition + math.sqrt((b * transition) ** 2 + 4.0 * q))
    for _ in range(60):
        value, slope = _energy(a, s, transition)
        change = value * math.log(value) / (s * slope)
        s *= math.exp(-change)
        if abs(change) < 1e-15:
            break
    return s


def at_radius(contact_radius: float, transition: float) -> Cohesion:
    """State of a contact of given radius (0 or more), in Maugis' units.

    Examples
    --------
    A sharp adhesion is that of JKR, a far one that of DMT:

    >>> round(at_radius(2.0, 1e3).load, 3), round(8.0 - 48.0**0.5, 3)
    (1.072, 1.072)
    >>> round(at_radius(2.0, 1e-3).load, 1)
    6.0
    """
    return _state(contact_radius, _width(contact_radius, transition), transition)


def _state(a: float, s: float, transition: float) -> Cohesion:
    # The unknown is s = sqrt(c^2 - a^2), not c: for a sharp adhesion c - a is lost in round-off.
    square = a * a + s * s
    load = a**3 - transition * (a * s + square * math.atan2(s, a))
    return Cohesion(a, math.sqrt(square), load, a * a - _FOUR_THIRDS * transition * s)


def _apart(c: float, transition: float) -> Cohesion:
    gap = 2.0 / (math.pi * transition) - c * (0.5 * c - 8.0 * transition / (3.0 * math.pi))
    return Cohesion(0.0, c, -0.5 * math.pi * transition * c * c, -gap)


def limits(transition: float) -> Limits:
    """Limit states for a transition parameter: pull-off under load and displacement control.

    Examples
    --------
    >>> [round(-limits(x).pull_off.load, 4) for x in (1e-3, 0.5, 1e3)]  # in units of pi w R
    [1.9999, 1.7182, 1.5]
    """

    def load_slope(a: float) -> float:
        s = _width(a, transition)
        angle = math.atan2(s, a)
        return 3.0 * a - 2.0 * transition * (angle + (a + s * angle) * _spread(a, s, transition))

    def approach_slope(a: float) -> float:
        return 2.0 - _FOUR_THIRDS * transition * _spread(a, _width(a, transition), transition)

    # The radius of JKR, 1.14, is an upper bound.
    weight = bracketed_root(load_slope, 0.0, 1.5, 1e-13)
    if transition < PARTS_BEFORE_RELEASE:
        touch = at_radius(0.0, transition)
        release = _apart(8.0 * transition / (3.0 * math.pi), transition)
    else:
        touch = release = at_radius(bracketed_root(approach_slope, 0.0, 1.5, 1e-13), transition)
    return Limits(at_radius(weight, transition), release, touch)


def at_load(load: float, transition: float, bounds: Limits) -> Cohesion:
    """Stable state under a load of at least that of `pull_off`.

    Parameters
    ----------
    load, transition : float
        In Maugis' units.
    bounds : Limits
        `limits` of the same transition parameter.
    """
    low = bounds.pull_off.contact_radius
    if load <= bounds.pull_off.load:
        return bounds.pull_off
    # The contact radius lies between that of DMT and that of JKR.
    high = (0.5 * (math.sqrt(6.0) + math.sqrt(max(6.0 + 4.0 * load, 0.0)))) ** _TWO_THIRDS
    high = 1.001 * max(high, low) + 1e-3

    def excess(a: float) -> float:
        return at_radius(a, transition).load - load

    return at_radius(bracketed_root(excess, low, high), transition)


def at_gap(gap: float, transition: float, bounds: Limits) -> Cohesion:
    """State at a gap of at most that of `release`, on the displacement-controlled branch.

    One equation in the contact radius, because the approach determines s.

    Examples
    --------
    >>> found = limits(0.5)
    >>> state = at_gap(0.4, 0.5, found)
    >>> round(state.approach, 12), round(state.load, 4)
    (-0.4, -1.7019)
    """
    if gap >= -bounds.release.approach:
        return bounds.release
    if gap >= -bounds.touch.approach:
        c = bounds.release.cohesive_radius
        return _apart(c + math.sqrt(2.0 * (-bounds.release.approach - gap)), transition)
    return _in_contact(gap, transition, bounds.touch)


def _in_contact(gap: float, transition: float, touch: Cohesion) -> Cohesion:
    """State in contact at a gap: safeguarded Newton's method in the contact radius."""
    per_width = 0.75 / transition

    def excess(a: float) -> tuple[float, float]:
        s = per_width * (a * a + gap)
        if s <= 0.0:
            return -1.0, 0.0
        value, slope = _energy(a, s, transition)
        return value - 1.0, a * (_loss(a, s, transition) + 2.0 * per_width * slope)

    low = touch.contact_radius
    if excess(low)[0] >= 0.0:
        return touch
    high = 1.1 * low + 0.1
    while excess(high)[0] < 0.0:
        low, high = high, 1.5 * high
    a = newton_root(excess, low, high, high)
    return _state(a, per_width * (a * a + gap), transition)
