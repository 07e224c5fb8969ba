r"""JKR adhesion: attraction inside the contact only, for compliant, large bodies.

In the units of `parameters`, with contact radius a, load P (tensile if negative) and approach delta
(a gap is its negative):

.. math:: P = a^3 - \sqrt{6 a^3}, \qquad \delta = a^2 - \tfrac{2}{3} \sqrt{6 a}

There is no attraction before contact. Once in contact, the surfaces form a neck and stay in contact
up to the gap `LAST_GAP`.

Arguments are floats and are not checked.

References
----------
.. [1] K. L. Johnson, K. Kendall and A. D. Roberts, Proc. R. Soc. A 324 (1971) 301.
"""

from __future__ import annotations

import math

__all__ = [
    "LAST_FORCE",
    "LAST_GAP",
    "LAST_RADIUS",
    "PULL_OFF_FORCE",
    "PULL_OFF_RADIUS",
    "approach",
    "load",
    "radius_at_gap",
    "radius_at_load",
]

# Roots of d(load)/d(radius) and of d(approach)/d(radius) of the two functions below: pull-off under
# load control, and the last contact under displacement control, where the tension is less.
PULL_OFF_FORCE = 1.5
PULL_OFF_RADIUS = 1.5 ** (1.0 / 3.0)
LAST_RADIUS = 6.0 ** (-1.0 / 3.0)
LAST_FORCE = 5.0 / 6.0
LAST_GAP = 3.0 * LAST_RADIUS**2


def load(contact_radius: float) -> float:
    """Load on a contact of given radius.

    Examples
    --------
    >>> round(load(PULL_OFF_RADIUS), 12), round(load(LAST_RADIUS) + LAST_FORCE, 12)
    (-1.5, 0.0)
    """
    cube = float(contact_radius**3)
    return cube - math.sqrt(6.0 * cube)


def approach(contact_radius: float) -> float:
    """Approach of a contact of given radius."""
    return contact_radius**2 - 2.0 / 3.0 * math.sqrt(6.0 * contact_radius)


def radius_at_load(load: float) -> float:
    r"""Contact radius under a load of at least -1.5, on the branch stable under load control.

    .. math:: a^{3/2} = \tfrac{1}{2} \left( \sqrt 6 + \sqrt{6 + 4 P} \right)
    """
    half = 0.5 * (math.sqrt(6.0) + math.sqrt(max(6.0 + 4.0 * load, 0.0)))
    return float(half ** (2.0 / 3.0))


def radius_at_gap(gap: float) -> float:
    r"""Contact radius at a gap of at most `LAST_GAP`, on the displacement-controlled branch.

    The largest root of :math:`x^4 - \tfrac{2}{3} \sqrt 6 \, x + h` at :math:`x = \sqrt a`, by
    Newton's method from above, where the quartic is convex: the iterates stay above the root.

    Examples
    --------
    >>> round(radius_at_gap(0.0) ** 3 * 3.0, 12)  # touching as before adhesion acted
    8.0
    """
    # In x = sqrt(a) the equation is a quartic, convex for x > 0, and the start is above its root
    # for tension and for compression alike: Newton's method needs no bracket.
    slope = 2.0 / 3.0 * math.sqrt(6.0)
    x = max((2.0 * slope) ** (1.0 / 3.0), (2.0 * max(-gap, 0.0)) ** 0.25)
    last = math.sqrt(LAST_RADIUS)
    for _ in range(80):
        gradient = 4.0 * x**3 - slope
        if gradient <= 0.0:
            return LAST_RADIUS
        step = (x**4 - slope * x + gap) / gradient
        if step <= 1e-16 * x:  # converged to round-off
            break
        x -= step
    return float(max(x, last) ** 2)
