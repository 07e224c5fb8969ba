"""Hard cases of liquid bridges: right angles, thin films, rupture, pinned contact lines."""

from __future__ import annotations

import math
from decimal import Decimal, localcontext

import numpy as np
from numpy.typing import NDArray
from scipy.integrate import solve_ivp
from scipy.optimize import fsolve

from ...capillary.arc import flat as arc
from ...capillary.exact.bridge import bridge
from ...capillary.exact.stability import stability_limit
from ...lubrication import couette_flat
from ...reference import elliptic_bridge
from .case import Found

__all__ = ["hysteresis", "near_limit", "right_angle", "rupture"]

Array = NDArray[np.float64]
DEG = math.pi / 180.0


def textbook_arc(gap: float, volume: float, cosine: float) -> float:
    """Neck of a bridge between flats of equal angles, its meridian a circle of radius r.

    r = h/(2 cos t). The volume of revolution is a quadratic in the distance X of the centre from
    the axis; the neck is X - r.
    """
    r = gap / (2.0 * cosine)
    inner = 0.5 * gap * math.sqrt(r * r - 0.25 * gap * gap) + r * r * math.asin(gap / (2.0 * r))
    # V/pi = X^2 h - 2 X inner + r^2 h - h^3/12
    half, last = inner / gap, r * r - gap * gap / 12.0 - volume / (math.pi * gap)
    return half + math.sqrt(half * half - last) - r


def textbook_force(gap: float, volume: float, cosine: float) -> float:
    """Force over surface tension through the neck of `textbook_arc`."""
    neck = textbook_arc(gap, volume, cosine)
    return math.pi * neck * (1.0 + neck * 2.0 * cosine / gap)


def right_angle() -> Found:
    """Contact angles a millionth of a degree below 90."""
    gap, volume, angle = 0.2, 1.0, 90.0 * DEG - 1e-6 * DEG
    cosine = math.cos(angle)
    naive = textbook_force(gap, volume, cosine)
    shape = arc.shape(angle, angle)
    ours = arc.force(shape, gap, arc.contact_radius(shape, gap, volume))
    with localcontext(prec=60):
        h, c = Decimal(gap), Decimal(cosine)
        pi = Decimal("3.14159265358979323846264338327950288419716939937510582097494459")
        r = h / (2 * c)
        arcsine = c + c**3 / 6 + 3 * c**5 / 40 + 15 * c**7 / 336 + 105 * c**9 / 3456
        inner = h / 2 * (r * r - h * h / 4).sqrt() + r * r * arcsine
        half, last = inner / h, r * r - h * h / 12 - Decimal(volume) / (pi * h)
        neck = half + (half * half - last).sqrt() - r
        exact = float(pi * neck * (1 + neck / r))
    return Found(
        abs(naive / exact - 1.0),
        f"a force of {naive:.4g} instead of {exact:.4g} gamma V^(1/3)",
        abs(ours / exact - 1.0),
        f"{ours:.4g}",
    )


def shooting(gap: float, angle: float) -> float:
    """Force over surface tension of a bridge of unit volume: Young and Laplace by shooting.

    From the neck to the upper plate along the angle of the meridian; the neck and the pressure
    follow from gap and volume. scipy's integrator and root finder, with their standard tolerances.
    """

    def end(neck: float, pressure: float) -> tuple[float, float]:
        def slopes(t: float, y: Array) -> list[float]:
            bend = pressure - math.sin(t) / y[0]
            return [
                math.cos(t) / bend,
                math.sin(t) / bend,
                math.pi * y[0] ** 2 * math.sin(t) / bend,
            ]

        run = solve_ivp(slopes, (0.5 * math.pi, angle), [neck, 0.0, 0.0])
        return 2.0 * run.y[1, -1] / gap - 1.0, 2.0 * run.y[2, -1] - 1.0

    scale = np.array([math.sqrt(1.0 / (math.pi * gap)), -2.0 * math.cos(angle) / gap])

    def missed(x: Array) -> Array:
        return np.array(end(*(x * scale)))

    found, *_ = fsolve(missed, np.ones(2), full_output=True)
    neck, pressure = found * scale
    return float(math.pi * neck * (2.0 - neck * pressure))


def rupture() -> Found:
    """The gap at which a bridge of 60/60 degrees breaks."""
    angle = 60.0 * DEG
    exact = elliptic_bridge.longest(angle, angle).gap
    gap = 0.01
    while gap < 10.0:  # on a grid of gaps, until there is no neck
        try:
            neck = textbook_arc(gap, 1.0, math.cos(angle))
        except ValueError:
            break
        if neck <= 0.0:
            break
        gap += 0.01
    ours = float(stability_limit(1.0, angle, angle).gap)
    return Found(
        abs(gap / exact - 1.0),
        f"{gap:.2f} V^(1/3)",
        abs(ours / exact - 1.0),
        f"{ours:.6f} V^(1/3)",
    )


def near_limit() -> Found:
    """The force of a bridge of 30/30 degrees at 99.99 % of the gap at which it breaks."""
    angle = 30.0 * DEG
    gap = 0.9999 * elliptic_bridge.longest(angle, angle).gap
    (exact,) = elliptic_bridge.at_gaps([gap], angle, angle)
    naive, ours = shooting(gap, angle), float(bridge(gap, 1.0, angle, angle).force)
    return Found(
        abs(naive / exact.force - 1.0),
        f"{naive:.5g} gamma V^(1/3)",
        abs(ours / exact.force - 1.0),
        f"{ours:.5g} gamma V^(1/3)",
    )


def hysteresis() -> Found:
    """The force of pinned contact lines, angles 1e-12 rad apart."""
    low, high = 1.0, 1.0 + 1e-12
    naive = math.cos(low) - math.cos(high)
    ours = float(couette_flat.hysteresis_force(1.0, 1.0, high, low, 1.0))
    apart = high - low  # exact
    exact = math.sin(low) * apart + 0.5 * math.cos(low) * apart * apart
    return Found(
        abs(naive / exact - 1.0),
        f"{naive:.6g} gamma w",
        abs(ours / exact - 1.0),
        f"{ours:.6g} gamma w",
    )
