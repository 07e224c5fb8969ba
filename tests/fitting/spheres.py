"""A sphere drawn off a wet flat: its scene, its closed form as a solver, noisy readings."""

from __future__ import annotations

import attrs
import numpy as np

import contactkit as ck
from contactkit.validity import ValidityNumber

RADIUS, SPEED = 1e-3, 1e-5
VISCOSITY = "interface.meniscus.liquid.viscosity"
SOUGHT = {VISCOSITY: ck.Range("10 mPa.s", "10 Pa.s")}
EXACT = ValidityNumber(name="gap over radius", value=0.02, high=0.1, detail="lubrication")
GAP = np.linspace(2e-6, 2e-5, 40)


def sphere(**loading):
    """Scene of a sphere over an oil of 0.1 Pa.s at an imposed speed."""
    oil = ck.Liquid(name="oil", viscosity=0.1, surface_tension=0.03)
    film = ck.Meniscus(liquid=oil, contact_angle_lower=0.3, contact_angle_upper=0.3)
    given = {"speed": SPEED, "initial_gap": 0.5e-6, "final_gap": 3e-5} | loading
    return ck.SeparationScene(
        interface=ck.Interface(upper=ck.Sphere(radius=RADIUS), meniscus=film),
        loading=ck.ImposedSpeed(**given),
        effects=(ck.ViscousForce(),),
    )


def stokes(viscosity, gap, speed=SPEED):
    """Reynolds force of a sphere near a flat [N]."""
    return 6.0 * np.pi * viscosity * RADIUS**2 * speed / gap


def closed(scene):
    """Force of the film over the gap by its closed form, as a curve."""
    gap = np.geomspace(5e-7, 5e-5, 400)
    force = stokes(scene.interface.meniscus.liquid.viscosity, gap, scene.loading.speed)
    made = curve(gap=(gap, "m"), force=(force, "N"))
    return attrs.evolve(made, validity=(EXACT,))  # else the fitted scene is run for its own


def curve(**columns):
    """A curve of contactkit with some columns, over the first."""
    axis = next(iter(columns))
    return ck.SavedCurve(
        axis=axis,
        title="closed form",
        columns={name: values for name, (values, _) in columns.items()},
        units={name: unit for name, (_, unit) in columns.items()},
    )


def readings(viscosity=0.2, noise=0.01, seed=1, gap=GAP, speed=SPEED):
    """Forces with a noise proportional to them."""
    random = np.random.default_rng(seed)
    exact = stokes(viscosity, gap, speed)
    return exact * (1.0 + noise * random.standard_normal(exact.size))


def measured(quantity="force", **given):
    """Readings of the force over the gap."""
    known = {"over": "gap", "at": GAP, "quantity": quantity, "values": readings()}
    return ck.MeasuredCurve(**(known | {"noise": "1 %"} | given))
