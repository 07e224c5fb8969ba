r"""Partial slip of a sphere and of any contact: closed forms, and a superposition.

Tangential force Q and displacement D are positive alike; P is the load, mu the coefficient of
friction, s = Q/(mu P) and a the contact radius. G* is the tangential modulus of the contact,
``1/G* = (2 - nu_1)/G_1 + (2 - nu_2)/G_2``; the pressure is that of Hertz, one component of traction
acts, and its effect on the pressure is neglected.

References
----------
.. [1] C. Cattaneo, Rend. Accad. Naz. Lincei 27 (1938) 342-348.
.. [2] R. D. Mindlin, H. Deresiewicz, J. Appl. Mech. 20 (1953) 327-344.
.. [3] M. Ciavarella, Int. J. Solids Struct. 35 (1998) 2349-2378; J. Jaeger, Arch. Appl. Mech. 65
   (1995) 478-487.
.. [4] K. L. Johnson, Contact Mechanics (1985), sections 7.2 to 7.4.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

__all__ = [
    "Sphere",
    "cycle_loss",
    "displacement",
    "displacement_on_path",
    "stick_radius",
    "stiffness",
    "superposed",
    "traction",
]

Array = NDArray[np.float64]


class Sphere(NamedTuple):
    """Contact of a sphere: load P [N], coefficient mu, radius a [m] and tangential modulus G* [Pa].

    `sliding_displacement` [m] is the displacement at the onset of full sliding.
    """

    load: float
    coefficient: float
    contact_radius: float
    modulus: float

    @property
    def friction(self) -> float:
        """Force of full sliding mu P [N]."""
        return self.coefficient * self.load

    @property
    def sliding_displacement(self) -> float:
        r""":math:`D_m = 3 \mu P / (16 a G^*)` [m]."""
        return 3.0 * self.friction / (16.0 * self.contact_radius * self.modulus)


def stick_radius(sphere: Sphere, force: float) -> float:
    r"""Radius of the circle that sticks [m], :math:`c = a (1 - s)^{1/3}`, of monotonic loading.

    Examples
    --------
    >>> stick_radius(Sphere(1.0, 0.5, 2.0, 1.0), 0.4375)
    1.0
    """
    return float(sphere.contact_radius * (1.0 - abs(force) / sphere.friction) ** (1.0 / 3.0))


def displacement(sphere: Sphere, force: float) -> float:
    r"""Displacement [m] of monotonic loading, :math:`D_m [1 - (1 - s)^{2/3}]` (Mindlin).

    Examples
    --------
    >>> round(displacement(Sphere(1.0, 0.3, 1.0, 1.0), 0.3) / 0.05625, 12)
    1.0
    """
    s = force / sphere.friction
    part = 1.0 - (1.0 - abs(s)) ** (2.0 / 3.0)
    return math.copysign(sphere.sliding_displacement * part, s)


def stiffness(sphere: Sphere, force: float) -> float:
    r"""Slope dQ/dD [N/m] of monotonic loading, :math:`8 a G^* (1 - s)^{1/3}`.

    Examples
    --------
    >>> stiffness(Sphere(1.0, 0.3, 1.0, 1.0), 0.0)
    8.0
    """
    return 8.0 * stick_radius(sphere, force) * sphere.modulus


def traction(r: ArrayLike, sphere: Sphere, force: float) -> Array:
    r"""Traction [Pa] of monotonic loading at a distance r from the centre (Cattaneo).

    .. math:: q = \mu p_0 \left[ \sqrt{1 - r^2/a^2} - \frac{c}{a} \sqrt{1 - r^2/c^2} \right]

    with the second root zero outside the circle of radius c that sticks.

    Examples
    --------
    >>> traction([0.0], Sphere(2.0 * math.pi / 3.0, 0.5, 1.0, 1.0), math.pi / 3.0 * 0.875).round(6)
    array([0.25])
    """
    a, c = sphere.contact_radius, stick_radius(sphere, force)
    r2 = np.asarray(r, dtype=float) ** 2
    peak = 1.5 * sphere.friction / (math.pi * a * a)
    inner = np.sqrt(np.maximum(c * c - r2, 0.0))
    size = peak * (np.sqrt(np.maximum(a * a - r2, 0.0)) - inner) / a
    return np.asarray(math.copysign(1.0, force) * size)


def displacement_on_path(sphere: Sphere, forces: Sequence[float]) -> list[float]:
    """Displacement [m] at each reversal of a path that starts unloaded, by Masing's rule.

    Each branch is that of monotonic loading at twice the scale from the last reversal (Mindlin and
    Deresiewicz). A branch must not pass an earlier reversal: reversals of falling amplitude, or
    full cycles.

    Examples
    --------
    A cycle returns to where it was:

    >>> found = displacement_on_path(Sphere(1.0, 0.3, 1.0, 1.0), [0.2, -0.2, 0.2])
    >>> round(found[2] / found[0], 12), round(found[1] / found[0], 12)
    (1.0, -1.0)
    """
    found, last = [displacement(sphere, forces[0])], forces[0]
    for force in forces[1:]:
        found.append(found[-1] + 2.0 * displacement(sphere, 0.5 * (force - last)))
        last = force
    return found


def cycle_loss(sphere: Sphere, amplitude: float) -> float:
    r"""Energy dissipated [J] in a cycle between forces of a given amplitude.

    .. math:: W = 4 D_m \mu P \left\{ \tfrac65 \left[ 1 - (1 - s)^{5/3} \right]
              - s \left[ 1 + (1 - s)^{2/3} \right] \right\}

    For small s it is :math:`\tfrac{4}{27} D_m \mu P s^3`. (Mindlin and Deresiewicz.)

    Examples
    --------
    >>> unit = Sphere(1.0, 0.3, 1.0, 1.0)
    >>> round(cycle_loss(unit, 3e-4) / (4.0 / 27.0 * 0.05625 * 0.3 * 1e-9), 2)
    1.0
    """
    s = abs(amplitude) / sphere.friction
    part = 1.2 * (1.0 - (1.0 - s) ** (5.0 / 3.0)) - s * (1.0 + (1.0 - s) ** (2.0 / 3.0))
    return float(4.0 * sphere.sliding_displacement * sphere.friction * part)


def superposed(
    pressure_at: Callable[[float], Array], load: float, coefficient: float, force: float
) -> Array:
    r"""Traction of any contact by the superposition of Ciavarella and Jaeger [Pa].

    .. math:: q = \mu \left[ p(P) - p(P - Q/\mu) \right]

    Exact for monotonic loading where the tangential compliance is proportional to the normal one:
    a homogeneous half-space with nu = 0, or plane contacts. With nu = 0.3 a rough contact is up to
    13 % of the maximum off, with layers 50 %.

    Parameters
    ----------
    pressure_at : callable
        Pressure [Pa] of the contact as a function of the load.
    load, force : float
        P, and 0 <= Q <= mu P, in the unit that `pressure_at` takes.
    coefficient : float
        mu [-].

    Examples
    --------
    Two springs side by side, of which one touches at a load of 1 only:

    >>> def springs(P):
    ...     return np.array([P, 0.0]) if P < 1.0 else np.array([P + 1.0, P - 1.0]) / 2.0
    >>> superposed(springs, 3.0, 0.5, 1.0)
    array([0.5, 0.5])
    """
    full, inner = pressure_at(load), pressure_at(load - force / coefficient)
    return np.asarray(coefficient * (full - inner))
