"""Scenes of films whose viscosity follows pressure and shear, for the tests of their FMUs."""

from __future__ import annotations

import math

import contactkit as ck
from contactkit.liquids.rheology.pressure import BarusViscosity, RoelandsViscosity
from contactkit.liquids.rheology.shear import (
    CarreauViscosity,
    EyringViscosity,
    PowerLawViscosity,
)

BARUS = BarusViscosity(pressure_coefficient=2e-8)
ROELANDS = RoelandsViscosity(pressure_coefficient=2e-8)
CARREAU = CarreauViscosity(relaxation_time=1e-6, exponent=0.5)
POWER_LAW = PowerLawViscosity(exponent=0.5, critical_rate=1e5)
EYRING = EyringViscosity(stress=1e5)

RADIUS, GAP, VISCOSITY = 1e-3, 2e-6, 0.1
DROP = math.pi * RADIUS**2 * 3e-6  # full to the rim up to 3 um
CUT_OFF = ck.TensionLimit(strength=1e6, cavity="truncated")
SPHERE = {"upper": ck.Sphere(radius=1e-2), "lower": ck.Flat(), "volume": 1e-12, "gap": 1e-7}


def scene(*effects, pressure=None, shear=None, upper=None, lower=None, gap=GAP, **film):
    """Film of a mass of 20 g; `film` are values of its meniscus."""
    oil = ck.Liquid(
        name="oil", viscosity=VISCOSITY, pressure_viscosity=pressure, shear_viscosity=shear
    )
    return ck.SeparationScene(
        interface=ck.Interface(
            lower=lower or ck.Flat(radius=RADIUS),
            upper=upper or ck.Flat(radius=RADIUS),
            meniscus=ck.Meniscus(liquid=oil, **film),
        ),
        loading=ck.ImposedForce(force=30.0, mass=0.02, initial_gap=gap, final_gap=5.0 * gap),
        effects=effects or (ck.ViscousForce(rheology="all"),),
    )


SCENES = {
    "carreau, drop": scene(shear=CARREAU, volume=DROP),
    "carreau, three": scene(shear=CARREAU, volume=DROP, count=3),
    "power law": scene(shear=POWER_LAW),
    "eyring": scene(shear=EYRING),
    "barus": scene(pressure=BARUS),
    "roelands": scene(pressure=ROELANDS),
    "barus, cut off": scene(ck.ViscousForce(rheology="all"), CUT_OFF, pressure=BARUS),
    "eyring, sphere": scene(shear=EYRING, **SPHERE),
}
