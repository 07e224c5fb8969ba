"""Scenes of films with a rheology, and their forces by a method of its own.

The velocity across the gap is integrated from the shear rate at each height, the pressure by
Runge and Kutta's method from the rim inwards: no closed moment, no logarithmic nodes, no table.
"""

from __future__ import annotations

import math

import numpy as np
from scipy.integrate import quad, solve_ivp
from scipy.optimize import brentq

import contactkit as ck
from contactkit.liquids.rheology.pressure import BarusViscosity, RoelandsViscosity
from contactkit.liquids.rheology.shear import (
    CarreauViscosity,
    EyringViscosity,
    PowerLawViscosity,
)

ETA, RIM, SPHERE = 0.1, 1e-3, 1e-2
BARUS = BarusViscosity(pressure_coefficient=2e-8)
ROELANDS = RoelandsViscosity(pressure_coefficient=2e-8)
EYRING = EyringViscosity(stress=1e4)
CARREAU = CarreauViscosity(relaxation_time=1e-5, exponent=0.5, second_plateau=0.05)
POWER = PowerLawViscosity(exponent=0.6, critical_rate=1e3)


def film_scene(*effects, liquid=None, meniscus=None, loading=None, body="flat", **more):
    """A flooded film of the liquid of these tests."""
    oil = ck.Liquid(name="oil", viscosity=ETA, surface_tension=0.03, **(liquid or {}))
    upper = ck.Flat(radius=RIM) if body == "flat" else ck.Sphere(radius=SPHERE)
    return ck.SeparationScene(
        interface=ck.Interface(
            lower=ck.Flat(radius=RIM),
            upper=upper,
            meniscus=ck.Meniscus(liquid=oil, **(meniscus or {})),
        ),
        loading=loading or ck.ImposedSpeed(speed=1e-3, initial_gap=1e-6, final_gap=1e-5),
        effects=effects or (ck.ViscousForce(),),
        **more,
    )


def face_scene(face, *effects, loading=None, **given):
    """A flooded film between a face and a flat, of a liquid with what is given and its slip."""
    meniscus = {key: given.pop(key) for key in list(given) if key.startswith("slip")}
    oil = ck.Liquid(name="oil", viscosity=ETA, **given)
    return ck.SeparationScene(
        interface=ck.Interface(upper=face, meniscus=ck.Meniscus(liquid=oil, **meniscus)),
        loading=loading or ck.ImposedSpeed(speed=1e-3, initial_gap=1e-6, final_gap=1e-5),
        effects=effects or (ck.ViscousForce(),),
    )


def shear_rate(law):
    """Shear rate [1/s] of a law over the stress [Pa]."""
    if isinstance(law, EyringViscosity):
        return lambda stress: law.stress / ETA * math.sinh(stress / law.stress)
    if isinstance(law, PowerLawViscosity):
        kink, n = ETA * law.critical_rate, law.exponent
        return lambda stress: (
            law.critical_rate
            * max(stress / kink, (stress / kink) ** (1.0 / n) if stress > kink else 0.0)
        )
    if isinstance(law, CarreauViscosity):
        b, lam, n, a = law.second_plateau, law.relaxation_time, law.exponent, law.sharpness

        def stress_of(rate):
            thin = (1.0 + (lam * rate) ** a) ** ((n - 1.0) / a)
            return ETA * rate * (b + (1.0 - b) * thin)

        def rate_of(stress):
            if stress == 0.0:
                return 0.0
            return brentq(lambda g: stress_of(g) - stress, 0.0, stress / (b * ETA), rtol=1e-13)

        return rate_of
    return lambda stress: stress / ETA


def flux(law, stress, gap, slip):
    """Flux per width [m2/s] of a film of two walls alike, of a stress at the wall [Pa]."""
    rate = shear_rate(law)
    half = 0.5 * gap
    moved, _ = quad(lambda z: z * rate(stress * z / half), 0.0, half, epsrel=1e-10)
    return 2.0 * moved + gap * slip * rate(stress)


def thickness(law, pressure):
    """Viscosity over that at ambient pressure [-]; in tension by the slope there."""
    if law is None:
        return 1.0
    alpha = law.pressure_coefficient
    if isinstance(law, RoelandsViscosity) and pressure > 0.0:
        height = math.log(ETA) + 9.67
        exponent = alpha * 1.96e8 / height
        return math.exp(height * ((1.0 + pressure / 1.96e8) ** exponent - 1.0))
    return math.exp(alpha * pressure)


def pressures(gap, speed, *, shear=None, pressure=None, slip=0.0, body="flat", rim=RIM):
    """Radii [m] and pressures [Pa] of a film from the rim inwards."""

    def height(r):
        return gap if body == "flat" else gap + r * r / (2.0 * SPHERE)

    def slope(r, p):
        h, target = height(r), 0.5 * r * abs(speed) * thickness(pressure, p[0])
        top = 12.0 * ETA * target / h**2  # the Newtonian wall stress is half of that
        stress = brentq(lambda s: flux(shear, s, h, slip) - target, 0.0, top, rtol=1e-10)
        return [math.copysign(2.0 * stress / h, speed)]

    places = np.geomspace(rim, 1e-4 * rim, 8001)
    found = solve_ivp(
        slope, (rim, places[-1]), [0.0], t_eval=places, rtol=1e-8, atol=1e-3, method="RK45"
    )
    return found.t, found.y[0]


def force(gap, speed, *, strength=math.inf, **film):
    """Force [N] of a film whose pressure is cut off at a tension [Pa].

    By the trapezoidal rule over the logarithm of the radius.
    """
    r, p = pressures(gap, speed, **film)
    drop = np.minimum(-p, strength) if speed > 0.0 else -p
    inner = math.pi * r[-1] ** 2 * drop[-1]
    return inner - float(np.trapezoid(2.0 * math.pi * r**2 * drop, np.log(r)))
