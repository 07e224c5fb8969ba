"""Accuracy of contacts of spheres: pressure, slip, adhesion, histories, lines.

Errors are against a closed form, or against the finest setting where there is none. Counts are
convolutions, applications of the operators.
"""

from __future__ import annotations

import math
from functools import partial
from typing import TYPE_CHECKING, Any

import numpy as np
from attrs import evolve

from ..accuracy import Accuracy
from ..adhesion import maugis_dugdale
from ..adhesion.parameters import scales
from ..analyses.pull_off import PullOffCurve, pull_off_curve
from ..contact.effects.adhesion import Adhesion
from ..contact.effects.attraction_laws import DugdaleAttraction
from ..contact.effects.elasticity import LayeredHalfSpace
from ..contact.effects.partial_slip import PartialSlip
from ..contact.effects.plastic_history import PlasticHistory
from ..contact.effects.plasticity import HardnessLimit
from ..contact.press import press
from ..contact.solve import solve_unwarned
from ..planning import plan
from ..reference import hertz, partial_slip
from ..scene.interface import Body, Interface
from ..scene.loading import Approach, Pressing, TangentialStep
from ..scene.materials import Layer, Material, RigidBase, Stack
from ..scene.scenes import ContactScene
from ..scene.surfaces import Paraboloid
from ..scene.window import Window
from ..work_precision import Point
from .timing import timed

if TYPE_CHECKING:
    from ..contact.result import ContactResult

__all__ = [
    "adhesion",
    "adhesive_sphere",
    "coupled",
    "hertzian",
    "history",
    "lines",
    "slip",
]

E, NU, MU, RADIUS, LOAD = 70e9, 0.3, 0.3, 1e-3, 1.0  # glass; N
GLASS = Material(young_modulus=E, poisson_ratio=NU, hardness=0.7e9)
HERTZ = hertz.sphere(LOAD, RADIUS, E / (1.0 - NU**2))


def _point(method: str, label: str, error: float, seconds: float, convolutions: int) -> Point:
    return Point(method, label, float(error), float(seconds), {"convolutions": int(convolutions)})


def _scene(loading: Any, *effects: Any, solid: Any = GLASS) -> ContactScene:
    """A rigid sphere on glass."""
    return ContactScene(
        interface=Interface(lower=Body(solid=solid), upper=Body(surface=Paraboloid(radius=RADIUS))),
        window=Window(width=2.4 * HERTZ.contact_radius, periodic=False),
        loading=loading,
        effects=(LayeredHalfSpace(), *effects),
    )


def _solved(made: ContactScene, grid: int, rtol: float = 1e-8) -> tuple[ContactResult, float]:
    """A contact, and CPU seconds of plan and solve."""
    return timed(lambda: solve_unwarned(plan(made, Accuracy(grid=grid, rtol=rtol))))


def hertzian() -> list[Point]:
    """Maximum pressure, approach and contact radius of a sphere against Hertz, over the grid."""
    points = []
    for pixels in (8, 16, 32, 64, 128):
        made = _scene(Pressing(force=LOAD))
        window = Window(width=2.5 * HERTZ.contact_radius, periodic=False)
        found, seconds = _solved(evolve(made, window=window), int(2.5 * pixels))
        errors = {
            "maximum pressure": found.max_pressure / HERTZ.peak_pressure,
            "approach": found.approach / HERTZ.approach,
            "contact radius": math.sqrt(found.contact_area / math.pi) / HERTZ.contact_radius,
        }
        cost = seconds, found.work.n_operator_applications
        label = f"{pixels} pixels"
        points += [_point(name, label, abs(r - 1.0), *cost) for name, r in errors.items()]
    return points


def slip() -> list[Point]:
    """Displacement at 0.6 of full sliding against Mindlin, over grid and over tolerance."""
    exact = partial_slip.displacement(
        partial_slip.Sphere(LOAD, MU, HERTZ.contact_radius, 0.5 * E / (1.0 + NU) / (2.0 - NU)),
        0.6 * MU * LOAD,
    )

    def run(grid: int, rtol: float) -> tuple[float, int, float]:
        effect = PartialSlip(coefficient=MU, path=(TangentialStep(ratio=0.6),), rtol=rtol)
        found, seconds = _solved(_scene(Pressing(force=LOAD), effect), grid)
        part = found.of(PartialSlip)
        return float(part.displacement[-1]), part.applications, seconds

    points = []
    for n in (12, 24, 48, 96, 192):
        value, work, seconds = run(n, 1e-8)
        error = abs(value / exact - 1.0)
        points.append(_point("grid, to Mindlin", f"{n} x {n}", error, seconds, work))
    best = run(64, 1e-12)[0]
    for rtol in (1e-3, 1e-4, 1e-6, 1e-8, 1e-10):
        value, work, seconds = run(64, rtol)
        error = abs(value / best - 1.0)
        points.append(_point("tolerance at 64 x 64", f"rtol {rtol:g}", error, seconds, work))
    return points


def coupled() -> list[Point]:
    """Tractions and stick radius of a pressed sphere over the steps of pressing."""

    def run(steps: int) -> tuple[Any, float, tuple[float, int]]:
        effect = PartialSlip(
            coefficient=MU,
            path=(TangentialStep(force=0.0),),
            components=2,
            coupled=True,
            pressing_steps=steps,
        )
        found, seconds = _solved(_scene(Pressing(force=LOAD), effect), 48, rtol=1e-6)
        part = found.of(PartialSlip)
        tractions = np.array([part.traction_x[0], part.traction_y[0]])
        cost = seconds, found.work.n_operator_applications
        return tractions, math.sqrt(part.stick_fraction[0]), cost

    best, radius, _ = run(64)
    bound, tractions, radii = np.linalg.norm(best), [], []
    for steps in (1, 2, 4, 8, 16, 32):
        found, own, cost = run(steps)
        label = f"{steps} step" + "s" * (steps > 1)
        error = float(np.linalg.norm(found - best) / bound)
        tractions.append(_point("tractions, rms", label, error, *cost))
        off = max(abs(own / radius - 1.0), 1e-4)
        radii.append(_point("stick radius", label, off, *cost))
    return tractions + radii


_ADHESIVE_RADIUS, _WORK, _MODULUS = 1e-6, 0.05, 1e9  # [m], [J/m2], [Pa]
UNITS = scales(_ADHESIVE_RADIUS, _WORK, _MODULUS)
# Maugis parameter: width of the window, first and last level and their number, in Maugis' units.
SPHERES = {
    0.1: (9.0, -0.4, 0.2, 13),
    0.5: (6.0, -1.0, 0.1, 12),
    1.0: (5.0, -1.1, 0.0, 12),
    2.0: (5.0, -1.1, 0.0, 12),
    5.0: (5.0, -1.1, 0.0, 12),
}


def adhesive_sphere(transition: float, pixels: int) -> PullOffCurve:
    """Pull-off curve of a sphere of a Maugis parameter, one of `SPHERES`."""
    width, low, high, count = SPHERES[transition]
    modulus = 4.0 / 3.0 * _MODULUS
    stress = 0.5 * transition * (math.pi * _WORK * modulus**2 / _ADHESIVE_RADIUS) ** (1.0 / 3.0)
    law = DugdaleAttraction(work_of_adhesion=_WORK, range=_WORK / stress)
    scene = ContactScene(
        interface=Interface(
            lower=Body(solid=Material(young_modulus=_MODULUS, poisson_ratio=0.0)),
            upper=Body(surface=Paraboloid(radius=_ADHESIVE_RADIUS)),
        ),
        window=Window(width=width * UNITS.radius, periodic=False),
        loading=Approach(approach=0.0),
        effects=(LayeredHalfSpace(), Adhesion(law=law)),
    )
    levels = np.linspace(low, high, count) * UNITS.approach
    return pull_off_curve(plan(scene, Accuracy(grid=pixels)), levels)


def adhesion() -> list[Point]:
    """Pull-off force against Maugis over the grid."""
    points = []
    for transition in SPHERES:
        exact = -maugis_dugdale.limits(transition).pull_off.load
        for n in (32, 64, 128):
            found, seconds = timed(partial(adhesive_sphere, transition, n))
            error = abs(found.pull_off_force / UNITS.load / exact - 1.0)
            method = f"Maugis parameter {transition:g}"
            points.append(_point(method, f"{n} x {n}", error, seconds, found.n_applications))
    return points


def history() -> list[Point]:
    """Imbalance of work and energy of a load cycle, and its loss, over the steps."""

    def run(steps: int) -> tuple[float, float, tuple[float, int]]:
        effects = HardnessLimit(rule="material"), PlasticHistory(forces=(LOAD,), steps=steps)
        found, seconds = _solved(_scene(Pressing(force=0.0), *effects), 64)
        part, work = found.of(PlasticHistory), found.work
        loss = float(part.plastic_work[-1])
        return part.work_error, loss, (seconds, work.n_operator_applications)

    best, balance, losses = run(1)[1], [], []
    for steps in (2, 4, 8, 16, 32):
        error, loss, cost = run(steps)
        label, off = f"{steps} steps", max(abs(loss / best - 1.0), 1e-16)
        balance.append(_point("work of the load, trapezoids", label, error, *cost))
        losses.append(_point("plastic work", label, off, *cost))
    return balance + losses


def lines() -> list[Point]:
    """Maximum pressure of a cylinder (Hertz) and of a sphere on a sheet over the grid."""
    load = 200.0  # [N/m]
    width = math.sqrt(4.0 * load * RADIUS * (1.0 - NU**2) / (math.pi * E))
    exact, side, points = 2.0 * load / (math.pi * width), 2.4 * width, []
    for n in (16, 32, 64, 128, 256):
        y = (np.arange(n) + 0.5) / n * side - 0.5 * side
        heights = np.repeat(-(y**2) / (2.0 * RADIUS), 2).reshape(n, 2)
        given = heights, side / n, GLASS
        press_it = partial(press, *given, mean_pressure=load / side, periodic="x", rtol=1e-8)
        found, seconds = timed(press_it)
        error = abs(found.max_pressure / exact - 1.0)
        points.append(_on_grid("cylinder, one-axis window", n, error, found, seconds))
    sheet = Stack(
        layers=(Layer(material=GLASS, thickness=2.0 * HERTZ.contact_radius),),
        substrate=RigidBase(bonded=True),
    )
    runs = {
        n: _solved(_scene(Pressing(force=LOAD), solid=sheet), n) for n in (16, 32, 64, 128, 384)
    }
    best = runs.pop(384)[0].max_pressure
    return points + [
        _on_grid("sphere on a sheet on a base", n, abs(one[0].max_pressure / best - 1.0), *one)
        for n, one in runs.items()
    ]


def _on_grid(method: str, n: int, error: float, found: ContactResult, seconds: float) -> Point:
    work = found.work.n_operator_applications
    return _point(method, f"{n} pixels across", error, seconds, work)
