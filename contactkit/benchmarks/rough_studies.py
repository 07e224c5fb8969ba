"""Accuracy of rough contacts: methods, presets, grids, layers, load curves.

Errors are against a tighter tolerance or a finer grid; seconds are CPU time of the process.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from functools import partial
from typing import TYPE_CHECKING, Any

import numpy as np
from attrs import evolve

from ..accuracy import Accuracy
from ..analyses.load_curve import load_curve
from ..contact.discretisation import discretisation_error
from ..contact.effects.elasticity import HalfSpace, LayeredHalfSpace
from ..contact.effects.hardness_rules import ConstantHardness
from ..contact.effects.plasticity import HardnessLimit
from ..contact.effects.stress import SubsurfaceStress
from ..contact.solve import solve_unwarned
from ..files.scenes import load_liquid, load_material, read_scene, read_tables
from ..models.library import bundled_scene
from ..planning import plan
from ..roughness.statistics import rms_slope
from ..scene.interface import Body, Interface
from ..scene.loading import Pressing
from ..scene.materials import Material, Stack
from ..scene.meniscus import Meniscus
from ..scene.rough_surfaces import GaussianRoughness, SelfAffineRoughness
from ..scene.scenes import ContactScene
from ..scene.surfaces import realise
from ..scene.window import Grid, Window
from ..work_precision import Point
from .contact import contact_alone, grid_sweep, solver_sweep
from .layered_studies import layered
from .timing import PRESETS, counts, run, timed

if TYPE_CHECKING:
    from ..contact.result import ContactResult

__all__ = [
    "area",
    "curve",
    "grids",
    "methods",
    "pixels",
    "presets",
    "rough_steel",
    "sizes",
    "stacks",
]

_MODULUS, _PIXEL = 1e11, 10e-9  # [Pa], [m]


def rough_steel(*effects: Any, solid: Any = None, pressure: float = 2e8) -> ContactScene:
    """Steel under a rough rigid flat with water between them, 2 um wide: for 256 x 256 pixels."""
    rough = SelfAffineRoughness(rms=2e-9, hurst=0.8, rolloff=1e-6, cutoff=62.5e-9, seed=1)
    angle = math.radians(60.0)
    water = Meniscus(
        liquid=load_liquid("water"), contact_angle_lower=angle, contact_angle_upper=angle
    )
    return ContactScene(
        interface=Interface(
            lower=Body(solid=solid or load_material("bearing-steel")),
            upper=Body(surface=rough),
            meniscus=water,
        ),
        window=Window(width=2e-6),
        loading=Pressing(pressure=pressure),
        effects=effects,
    )


def methods() -> list[Point]:
    """Error of the pressure map of a rough contact over the tolerance, by method."""
    return list(
        solver_sweep(rough_steel(HalfSpace()), Accuracy(grid=256), lambda done: None).points
    )


def _off(found: ContactResult, exact: ContactResult) -> float:
    """Error of a pressure map, in the 2-norm."""
    away = np.linalg.norm(found.pressure - exact.pressure)
    return float(away / np.linalg.norm(exact.pressure))


def presets() -> list[Point]:
    """Error of the shipped contacts, compliance and hardness, by the presets of `Accuracy`."""
    points = []
    for name in SHIPPED:
        scene, accuracy = _shipped(name)
        exact = run(scene, evolve(accuracy, rtol=1e-11))
        for label, preset in PRESETS.items():
            solve = partial(run, scene, evolve(preset, grid=accuracy.grid))
            found, seconds = timed(solve)
            points.append(Point(name, label, _off(found, exact), seconds, counts(found)))
    return points


SHIPPED = ("head-disk", "contact-stop", "tip-landing")
"""Shipped contacts; the devices have studies of their own."""


def _shipped(name: str) -> tuple[ContactScene, Accuracy]:
    """A shipped contact, compliance and hardness, and its grid."""
    path = bundled_scene(name)
    given = read_scene(read_tables(path), ContactScene, path.name)
    return contact_alone(given.scene), given.accuracy


def grids() -> list[Point]:
    """Error that the grids of the shipped contacts leave, and seconds of its estimate."""
    shown = {"maximum pressure": "max_pressure", "contact area": "contact_area"}
    points = []
    for name in SHIPPED:
        found = run(*_shipped(name))
        estimate, seconds = timed(partial(discretisation_error, found))
        points += [
            Point(label, name, estimate.errors[key], seconds, {}) for label, key in shown.items()
        ]
    return points


def _pressed(n: int, fraction: float, periodic: bool) -> ContactScene:
    """Steel on a surface whose shortest wave has eight pixels, with about a fraction in contact."""
    width = n * _PIXEL
    surface = SelfAffineRoughness(rms=1e-9, hurst=0.8, rolloff=width / 4, cutoff=8.0 * _PIXEL)
    heights = realise(surface, Grid((n, n), (_PIXEL, _PIXEL), True))
    slope = float(rms_slope(heights, (_PIXEL, _PIXEL), True))
    steel = Material(young_modulus=210e9, poisson_ratio=0.3)
    return ContactScene(
        interface=Interface(lower=Body(solid=steel), upper=Body(surface=surface)),
        window=Window(width=width, periodic=periodic),
        loading=Pressing(pressure=0.5 * fraction * slope * steel.plane_strain_modulus),
        effects=(HalfSpace(),),
    )


def sizes() -> list[Point]:
    """Pressure at the default tolerance over pixels, fraction in contact and edges; solve alone."""
    points = []
    for edges, grid in (("periodic", (256, 512, 1024)), ("free", (256, 512))):
        for fraction in (0.01, 0.05, 0.2):
            for n in grid:
                scene = _pressed(n, fraction, edges == "periodic")
                found, seconds, error = _solved(scene, Accuracy(grid=n))
                method = f"{edges}, {100.0 * fraction:g} % in contact"
                points.append(Point(method, f"{n} x {n}", error, seconds, counts(found)))
    return points


def _solved(scene: ContactScene, accuracy: Accuracy) -> tuple[ContactResult, float, float]:
    """A contact, CPU seconds of its solve, and its error against a tolerance of 1e-11."""
    made = plan(scene, accuracy)
    found, seconds = timed(lambda: solve_unwarned(made))
    exact = solve_unwarned(plan(scene, evolve(accuracy, rtol=1e-11)))
    return found, seconds, _off(found, exact)


_TWENTY = tuple((3.0 - i / 10.0, 0.002) for i in range(20))
STACKS: Mapping[str, tuple[tuple[float, float], ...]] = {
    "half-space": (),
    "film of 0.1, 0.01": ((0.1, 0.01),),
    "film of 3, 0.01": ((3.0, 0.01),),
    "film of 10, 0.001": ((10.0, 0.001),),
    "film of 10, 0.01": ((10.0, 0.01),),
    "film of 100, 0.01": ((100.0, 0.01),),
    "film of 1000, 0.01": ((1e3, 0.01),),
    "film of 10 000, 0.01": ((1e4, 0.01),),
    "plate of 1000, 0.001": ((1e3, 0.001),),
    "disk of Table 2.1": ((2.0, 2.5e-4), (2.714, 1.25e-3), (1.857, 0.5)),
    "twenty graded layers, 3 to 1": _TWENTY,
    "half-space with hardness": (),
}
"""Moduli over that of the substrate and thicknesses over the window, layer by layer."""


def stacks() -> list[Point]:
    """Pressure over layers and hardness: the worst of six contacts, the mean of their seconds."""
    n, width, points = 256, 2e-6, []
    kinds = (
        SelfAffineRoughness(rms=1e-9, hurst=0.8, rolloff=width / 4, cutoff=8 * width / n, seed=1),
        GaussianRoughness(rms=1e-9, correlation_length=width / 20, cutoff=2 * width / n, seed=1),
    )
    bound = HardnessLimit(rule=ConstantHardness(hardness=0.05 * _MODULUS))
    for name, layers in STACKS.items():
        solid, more = layered(layers, _MODULUS, width), (bound,) * name.endswith("hardness")
        found = [
            _solved(_coated(solid, rough, width, pressure, more), Accuracy(grid=n))
            for rough in kinds
            for pressure in (2e7, 1.2e8, 6e8)
        ]
        results, seconds, errors = zip(*found, strict=True)
        most = max(one.work.n_operator_applications for one in results)
        work = {"convolutions": most}
        points.append(Point(name, "six contacts", max(errors), float(np.mean(seconds)), work))
    return points


def _coated(
    solid: Stack, rough: Any, width: float, pressure: float, more: tuple[Any, ...]
) -> ContactScene:
    return ContactScene(
        interface=Interface(lower=Body(solid=solid), upper=Body(surface=rough)),
        window=Window(width=width),
        loading=Pressing(pressure=pressure),
        effects=(LayeredHalfSpace(), *more),
    )


def area() -> list[Point]:
    """Real area of contact over the grid: pixels counted, and with their edges corrected."""
    solid = Material(young_modulus=1e9, poisson_ratio=0.0)
    rough = SelfAffineRoughness(rms=1e-9, hurst=0.8, rolloff=5e-7, cutoff=1e-7)
    scene = ContactScene(
        interface=Interface(lower=Body(solid=solid), upper=Body(surface=rough)),
        window=Window(width=2e-6),
        loading=Pressing(pressure=3e5),
        effects=(HalfSpace(),),
    )
    swept = grid_sweep(scene, Accuracy(grid=512), lambda done: None)
    return [] if swept is None else list(swept.points)


def pixels() -> list[Point]:
    """True and stated error over the pixels of the shortest wave, at p/E = 4e-6 and 1e-4."""
    names = {"max_pressure": "pressure", "contact_area": "counted area", "max_tension": "tension"}
    points = []
    for pressure in (4e5, 1e7):
        exact = _waves(pressure, 16).scalars()
        for n in (2, 4, 8, 12):
            found, seconds = timed(partial(_waves, pressure, n))
            stated, more = timed(partial(discretisation_error, found))
            label = f"{n} pixels, p/E = {pressure / _MODULUS:g}"
            for key, name in names.items():
                true = abs(found.scalars()[key][0] / exact[key][0] - 1.0)
                points.append(Point(f"{name}, true", label, true, seconds, counts(found)))
                points.append(Point(f"{name}, stated", label, stated.errors[key], more, {}))
    return points


def _waves(pressure: float, n: int) -> ContactResult:
    """Rough contact of 64 shortest waves along a side, with its stress at the surface."""
    solid = Material(young_modulus=_MODULUS, poisson_ratio=0.3)
    rough = GaussianRoughness(rms=1e-9, correlation_length=5e-7, cutoff=1e-5 / 64)
    scene = ContactScene(
        interface=Interface(lower=Body(solid=solid), upper=Body(surface=rough)),
        window=Window(width=1e-5),
        loading=Pressing(pressure=pressure),
        effects=(HalfSpace(), SubsurfaceStress(depths=(0.0, 1e-8))),
    )
    return solve_unwarned(plan(scene, Accuracy(grid=64 * n)))


def curve() -> list[Point]:
    """Twenty loads of a rough map: largest error of approach and pressure over the tolerance."""
    rough = SelfAffineRoughness(rms=1e-9, hurst=0.8, rolloff=5e-7, cutoff=8e-8, seed=1)
    glass = Material(young_modulus=70e9, poisson_ratio=0.3)
    made = ContactScene(
        interface=Interface(lower=Body(solid=glass), upper=Body(surface=rough)),
        window=Window(width=1e-6),
        loading=Pressing(pressure=1e8),
        effects=(HalfSpace(),),
    )
    pressures = [float(p) for p in np.geomspace(1e7, 4e8, 20)]
    prepared = plan(made, Accuracy(grid=128))
    best = load_curve(prepared, pressures=pressures, rtol=1e-10)
    names = {"approach": "approach", "max_pressure": "maximum pressure"}
    points: dict[str, list[Point]] = {name: [] for name in names}
    for rtol in (1e-2, 1e-3, 1e-4, 1e-5, 1e-6, 1e-8):
        one, seconds = timed(partial(load_curve, prepared, pressures=pressures, rtol=rtol), 1.0)
        work = {"convolutions": int(one.applications.sum())}
        for name, label in names.items():
            error = float(np.abs(one[name] / best[name] - 1.0).max())
            points[name].append(Point(label, f"rtol {rtol:g}", error, seconds, work))
    return [point for some in points.values() for point in some]
