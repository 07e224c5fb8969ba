"""Bridges and films of chapter 3 once more, with the numbers of its captions.

The exact bridge between flats by shooting along its meridian, the arc by quadrature, viscous forces
by the integrals they come from (Young and Laplace; Reynolds).
"""

from __future__ import annotations

import math
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy.integrate import quad, solve_ivp
from scipy.optimize import brentq, root

__all__ = [
    "arc_volume",
    "bridge_force",
    "closed_gap",
    "disc_impulse",
    "equal_area",
    "film_force",
    "lens_impulse",
    "paraboloid_volume",
    "sphere_force",
    "sphere_impulse",
]

GAMMA, VISCOSITY, TIME = 0.072, 0.89e-3, 1e-7  # water of the captions [N/m], [Pa.s], [s]
Array = NDArray[Any]


def arc_volume(radius: float, gap: float, lower: float, upper: float) -> float:
    """Volume [m3] of the revolved arc with a circle [m] on the lower flat; angles in degrees."""
    one, two = math.radians(lower), math.radians(upper)
    rho = gap / (math.cos(one) + math.cos(two))
    axis = radius + rho * math.sin(one)

    def slice_of(phi: float) -> float:
        return (axis - rho * math.sin(phi)) ** 2 * rho * math.sin(phi)

    found: float = quad(slice_of, one, math.pi - two)[0]
    return math.pi * found


def closed_gap(volume: float, lower: float, upper: float) -> float:
    """Gap [m] at which the arc of a volume [m3] closes where it is narrowest."""
    one, last = math.radians(lower), math.pi - math.radians(upper)
    total = math.cos(one) - math.cos(last)
    ends = (math.sin(one), math.sin(last))
    hollow = 1.0 if one < 0.5 * math.pi < last else max(ends)
    narrowest = hollow if total > 0.0 else min(ends)  # bulging: narrowest at a body

    def excess(gap: float) -> float:
        rho = gap / total
        return arc_volume(rho * (narrowest - math.sin(one)), gap, lower, upper) - volume

    size = volume ** (1.0 / 3.0)
    found: float = brentq(excess, 1e-2 * size, 30.0 * size, xtol=1e-6 * size)
    return found


def _meridian(phi: float, y: Array, k: float) -> list[float]:
    """Slopes of radius, height and volume of a bridge of a curvature over the angle."""
    x, _, _ = y
    rho = 1.0 / (k + math.sin(phi) / x)
    dz = rho * math.sin(phi)
    return [-rho * math.cos(phi), dz, math.pi * x * x * dz]


def bridge_force(volume: float, gap: float, lower: float, upper: float) -> float:
    """Force [N] of the exact bridge between flats, attraction positive; angles in degrees."""
    one, two = math.radians(lower), math.radians(upper)
    start = math.sqrt(volume / (math.pi * gap))  # of a cylinder

    def missed(guess: Array) -> Array:
        radius, k = guess
        end = solve_ivp(
            _meridian, (one, math.pi - two), [radius, 0.0, 0.0], args=(k,), rtol=1e-9, atol=1e-12
        ).y[:, -1]
        return np.array([end[1] * start / gap - 1.0, end[2] * start**3 / volume - 1.0])

    bent = (math.cos(one) + math.cos(two)) * start / gap
    found = root(missed, [1.0, bent - 1.0], tol=1e-9)
    if not found.success:
        raise RuntimeError(f"the second method found no bridge: {found.message}")
    radius, k = found.x
    return float(GAMMA * start * math.pi * (radius * radius * k + 2.0 * radius * math.sin(one)))


def paraboloid_volume(
    radius: float, gap: float, rim: float, lower: float, upper: float
) -> tuple[float, float, float]:
    """Volume [m3] of the arc under a paraboloid; its circle on the flat and its radius [m].

    `radius` [m] is that at the apex, `rim` [m] the height of the upper contact circle.
    """
    one, wet = math.radians(lower), math.sqrt(2.0 * radius * (rim - gap))
    tilt = math.radians(upper) + math.atan(wet / radius)
    rho = rim / (math.cos(one) + math.cos(tilt))
    axis = wet + rho * math.sin(tilt)

    def slice_of(phi: float) -> float:
        return (axis - rho * math.sin(phi)) ** 2 * rho * math.sin(phi)

    body = math.pi * wet**4 / (4.0 * radius)
    found: float = math.pi * quad(slice_of, one, math.pi - tilt)[0] - body
    return found, axis - rho * math.sin(one), rho


def sphere_force(radius: float, gap: float, rim: float, lower: float, upper: float) -> float:
    """Force [N] of the exact bridge under a sphere, of the volume of the arc of a paraboloid.

    Lengths are over the radius of the sphere; `rim` [m] as in `paraboloid_volume`.
    """
    volume, circle, rho = paraboloid_volume(radius, gap, rim, lower, upper)
    one, two = math.radians(lower), math.radians(upper)

    def meets(phi: float, y: Array, k: float) -> float:
        return phi - (math.pi - two - math.asin(min(float(y[0]), 1.0)))

    at_the_sphere: Any = meets
    at_the_sphere.terminal = True

    def missed(guess: Array) -> Array:
        start, k = guess
        path = solve_ivp(
            _meridian,
            (one, math.pi),
            [start, 0.0, 0.0],
            args=(k,),
            events=at_the_sphere,
            rtol=1e-9,
            atol=1e-14,
        )
        x, z, liquid = path.y[:, -1]
        deep = 1.0 - math.sqrt(1.0 - x * x)
        body = math.pi * deep**2 * (1.0 - deep / 3.0)
        return np.array(
            [z / (gap / radius + deep) - 1.0, (liquid - body) * radius**3 / volume - 1.0]
        )

    found = root(missed, [circle / radius, radius / rho - radius / circle], tol=1e-9)
    if not found.success:
        raise RuntimeError(f"the second method found no bridge: {found.message}")
    start, k = found.x
    return float(GAMMA * radius * math.pi * (start * start * k + 2.0 * start * math.sin(one)))


def film_force(radius: float, gap: float, lower: float, upper: float) -> float:
    """Force [N] of the exact bridge of the volume of the arc with a circle on the lower flat."""
    return bridge_force(arc_volume(radius, gap, lower, upper), gap, lower, upper)


def disc_impulse(volume: float, gap: float) -> float:
    """Impulse [N.s] of a disc of a constant volume [m3], drawn from a gap [m] to far away."""
    found: float = quad(lambda u: u**-5.0, 1.0, np.inf)[0]
    return 1.5 * VISCOSITY / math.pi * volume**2 / gap**4 * found


def sphere_impulse(radius: float, gap: float, rim: float) -> float:
    """Impulse [N.s] of a film of constant volume under a paraboloid, wetted up to `rim` [m]."""
    kept = rim * rim - gap * gap

    def drag(u: float) -> float:
        d = gap * u
        return (1.0 - d / math.sqrt(d * d + kept)) ** 2 / u

    found: float = quad(drag, 1.0, np.inf)[0]
    return 6.0 * math.pi * VISCOSITY * radius**2 * found


def lens_impulse(radius: float, gap: float) -> float:
    """Impulse [N.s] of a slide of two discs until they no longer overlap: Couette flow."""

    def overlap(s: float) -> float:
        return 2.0 * math.acos(s / 2.0) - 0.5 * s * math.sqrt(4.0 - s * s)

    found: float = quad(overlap, 0.0, 2.0)[0]
    return VISCOSITY / gap * radius**3 * found


def equal_area(gap: float, lower: float, upper: float) -> float:
    """Area [m2] at which the mean viscous force over `TIME` is the force of the exact bridge."""

    def excess(log_area: float) -> float:
        area = math.exp(log_area)
        pull = film_force(math.sqrt(area / math.pi), gap, lower, upper)
        return math.log(disc_impulse(area * gap, gap) / TIME / pull)

    return math.exp(brentq(excess, math.log(1e-14), math.log(1e-11), xtol=1e-4))
