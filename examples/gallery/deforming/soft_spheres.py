"""A sphere on a film between bodies that deform, as a scene: what the pages on them solve."""

from __future__ import annotations

import math
import warnings
from typing import Any

import contactkit as ck

RADIUS, GAP, VISCOSITY, SPEED = 5e-3, 1e-6, 0.1, 1e-5
WIDTH = math.sqrt(RADIUS * GAP)


def half_space(modulus: float) -> Any:
    """Incompressible half-space of an effective modulus [Pa]."""
    return ck.Material(young_modulus=0.75 * modulus, poisson_ratio=0.5)


def bonded_layer(modulus: float, ratio: float, thickness: float) -> Any:
    """Layer of an effective modulus [Pa] on a rigid base, of a thickness over the width."""
    solid = ck.Material(young_modulus=(1.0 - ratio**2) * modulus, poisson_ratio=ratio)
    layer = ck.Layer(material=solid, thickness=thickness * WIDTH)
    return ck.Stack(layers=(layer,), substrate=ck.RigidBase(bonded=True))


def wet_sphere(solid: Any, rim: float, final: float = 3.0) -> Any:
    """Sphere pulled at `SPEED` to a gap over that at the start, with a rim over the width."""
    return ck.SeparationScene(
        interface=ck.Interface(
            lower=ck.Body(surface=ck.Flat(radius=rim * WIDTH), solid=solid),
            upper=ck.Sphere(radius=RADIUS),
            meniscus=ck.Meniscus(liquid=ck.Liquid(name="oil", viscosity=VISCOSITY)),
        ),
        loading=ck.ImposedSpeed(speed=SPEED, initial_gap=GAP, final_gap=final * GAP),
        effects=(ck.ElasticBodies(), ck.ViscousForce()),
    )


def modulus_of(beta: float) -> float:
    """Effective modulus [Pa] at which a pull at `SPEED` has a beta."""
    return float(VISCOSITY * SPEED * RADIUS**1.5 / (beta * GAP**2.5))


def plan(scene: Any) -> Any:
    """Plan at 1e-3 of the force, without warnings: no cavity opens in these films."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", ck.ValidityWarning)
        return ck.plan(scene, ck.Accuracy(film_rtol=1e-3))


def simulate(scene: Any) -> Any:
    """Result at 1e-3 of the force, without warnings."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", ck.ValidityWarning)
        return ck.simulate(ck.plan(scene, ck.Accuracy(film_rtol=1e-3)))
