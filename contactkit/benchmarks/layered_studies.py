"""Accuracy of layered solids and of the stress below contacts.

Errors are against `references`, or against a finer grid or denser planes.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from functools import partial
from typing import TYPE_CHECKING, Any

import numpy as np

from ..accuracy import Accuracy
from ..contact.effects.elasticity import HalfSpace, LayeredHalfSpace
from ..contact.effects.friction import FrictionTraction
from ..contact.effects.stress import SubsurfaceStress
from ..contact.solve import solve_unwarned
from ..elasticity.layer_stack import Layers
from ..elasticity.layered import compliance, normal_symbol
from ..elasticity.stress.measures import von_mises
from ..elasticity.stress.planes import planes
from ..elasticity.stress.reading import READINGS, Reading
from ..elasticity.stress.tractions import Tractions
from ..planning import plan
from ..scene.interface import Body, Interface
from ..scene.loading import Pressing
from ..scene.materials import Layer, Material, Stack
from ..scene.rough_surfaces import GaussianRoughness
from ..scene.scenes import ContactScene
from ..scene.surfaces import Paraboloid, Wave
from ..scene.window import Window
from ..work_precision import Point
from .references.tables import reference
from .timing import timed

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from ..contact.result import ContactResult

__all__ = ["compliances", "depths", "layered", "off_contact", "readings", "spheres", "waves"]

_E, _NU, _RADIUS, _A0 = 1e9, 0.3, 1e-3, 1e-6  # substrate, sphere, and Hertz's contact on it
_MODULUS = _E / (1.0 - _NU**2)
_LOAD = 4.0 * _MODULUS * _A0**3 / (3.0 * _RADIUS)
_P_HERTZ = 2.0 * _A0 * _MODULUS / (math.pi * _RADIUS)


def compliances() -> list[Point]:
    """Worst error of the compliances over the wavenumbers; seconds of a map of 1024 x 1024."""
    points = []
    for name, one in reference("layered")["stacks"].items():
        alpha, *wanted = np.array(one["rows"]).T
        elastic = one["young_modulus"], one["poisson_ratio"], one["thickness"]
        found = compliance(alpha, *elastic)._asdict()
        exact = dict(zip(("F11", "F12", "C", "Fs"), wanted, strict=True))
        _, seconds = timed(partial(normal_symbol, (1024, 1024), (1.0, 1.0), *elastic), 0.5)
        for key, right in exact.items():
            scale = np.sqrt(exact["F11"] * exact["C"]) if key == "F12" else right
            error = float(np.max(np.abs(found[key] - right) / scale))
            points.append(Point(key, name, error, seconds, {"layers": len(one["thickness"])}))
    return points


def layered(layers: Sequence[Sequence[float]], unit: float, length: float) -> Stack:
    """Layers of (modulus, thickness) in units of a substrate [Pa] and a length [m]; nu = 0.3."""

    def material(ratio: float) -> Material:
        return Material(young_modulus=ratio * unit, poisson_ratio=_NU)

    made = tuple(Layer(material=material(e), thickness=h * length) for e, h in layers)
    return Stack(layers=made, substrate=material(1.0))


def spheres() -> list[Point]:
    """Rigid spheres on layers, 32 pixels to the contact radius: contact and greatest stress."""
    points = []
    for case in reference("contact")["spheres"]:
        for friction, wanted in case["maxima"].items():
            mu = float(friction)
            slid = (FrictionTraction(coefficient=mu),) if mu else ()
            stress = SubsurfaceStress(tolerance=1e-4, window=128.0)
            found, seconds = timed(partial(_sphere, case, stress, *slid), 0.0)
            work = {"convolutions": found.work.n_operator_applications}
            largest = found.of(SubsurfaceStress).maxima["sqrt_j2"].value / _P_HERTZ
            errors = {f"sqrt(J2), mu = {mu:g}": largest / wanted["sqrt_j2"] - 1.0}
            if not mu:
                radius = math.sqrt(found.contact_area / math.pi) / _A0
                errors |= {
                    "maximum pressure": found.max_pressure / _P_HERTZ / case["peak_pressure"] - 1.0,
                    "approach": found.approach / (_A0**2 / _RADIUS) / case["approach"] - 1.0,
                    "contact radius": radius / case["contact_radius"] - 1.0,
                }
            points += [
                Point(name, case["name"], abs(error), seconds, work)
                for name, error in errors.items()
            ]
    return points


def _sphere(case: Mapping[str, Any], *effects: Any) -> ContactResult:
    solid = layered(case["layers"], _E, _A0)
    scene = ContactScene(
        interface=Interface(
            lower=Body(solid=solid), upper=Body(surface=Paraboloid(radius=_RADIUS))
        ),
        window=Window(width=2.5 * case["contact_radius"] * _A0, periodic=False),
        loading=Pressing(force=_LOAD),
        effects=(LayeredHalfSpace(), *effects),
    )
    return solve_unwarned(plan(scene, Accuracy(grid=80)))


def waves() -> list[Point]:
    """Waves of one direction in partial contact: the worst of each case's widths."""
    table = reference("contact")["waves"]
    plain = {"name": "half-space", "layers": [], "rows": table["homogeneous"]}
    names = "maximum pressure", "mean gap over amplitude", "half-width"
    points = []
    _wave_errors(layered([], 1.0, 1.0), plain["rows"], 64)  # compiles what is compiled once
    for case in [plain, *table["layered"]]:
        layers = [(e / (1.0 - _NU**2), h) for e, h in case["layers"]]
        solid = layered(layers, 1.0 - _NU**2, 1.0)
        for n in (128, 256, 512):
            run = partial(_wave_errors, solid, case["rows"], n)
            (errors, work), seconds = timed(run, 0.0)
            label, cost = f"{case['name']}, {n} pixels", seconds / len(case["rows"])
            points += [
                Point(name, label, float(error), cost, {"convolutions": work})
                for name, error in zip(names, errors, strict=True)
            ]
    return points


def _wave_errors(
    solid: Stack, rows: Sequence[Mapping[str, float]], n: int
) -> tuple[NDArray[np.float64], int]:
    """Largest errors of some mean pressures, and the most convolutions of one."""
    errors, work = [], 0
    for row in rows:
        scene = ContactScene(
            interface=Interface(
                lower=Body(solid=solid), upper=Body(surface=Wave(amplitude=1.0, wavelength=1.0))
            ),
            window=Window(width=1.0, height=2.0 / n),
            loading=Pressing(pressure=row["mean_pressure"]),
            effects=(LayeredHalfSpace(),),
        )
        found = solve_unwarned(plan(scene, Accuracy(grid=(2, n))))
        work = max(work, found.work.n_operator_applications)
        errors.append(
            (
                abs(found.max_pressure / row["peak_pressure"] - 1.0),
                abs(float(found.gap.mean()) - row["mean_gap"]),
                abs(0.5 * found.contact_fraction / row["half_width"] - 1.0),
            )
        )
    return np.max(errors, axis=0), work


_WIDTH, _N = 10e-6, 256  # of the rough contact whose stress is judged: pixels of 39 nm
_SOLID = Material(name="solid", young_modulus=100e9, poisson_ratio=_NU)


def _rough(n: int, pixels: float, width: float, *effects: Any) -> ContactResult:
    """Rough half-space, rms 1 nm, p/E = 4e-6; `pixels` of a grid of 39 nm to the shortest wave."""
    surface = GaussianRoughness(
        rms=1e-9, correlation_length=0.5e-6, cutoff=pixels * _WIDTH / _N, seed=1
    )
    scene = ContactScene(
        interface=Interface(lower=Body(solid=_SOLID, surface=surface)),
        window=Window(width=width),
        loading=Pressing(pressure=4e-6 * 100e9),
        effects=(HalfSpace(), *effects),
    )
    return solve_unwarned(plan(scene, Accuracy(grid=n)))


def readings() -> list[Point]:
    """Greatest von Mises stress by reading of the pressure between pixels."""
    points, pixel = [], _WIDTH / _N
    for waves_of in (2, 4, 8):
        pressure = _rough(_N, waves_of, _WIDTH).pressure
        exact = _largest(_rough(4 * _N, waves_of, _WIDTH).pressure, pixel / 4, "spline")
        for reading in READINGS:
            found, seconds = timed(partial(_largest, pressure, pixel, reading), 0.5)
            label = f"{waves_of} pixels to the shortest wave"
            points.append(Point(reading, label, abs(found / exact - 1.0), seconds, {"planes": 12}))
    return points


_DISTANCES = {  # from the contact, in pixels
    "1": (1, 1),
    "2": (2, 2),
    "3": (3, 3),
    "4 to 6": (4, 6),
    "7 and more": (7, math.inf),
}


def off_contact() -> list[Point]:
    """Von Mises stress half a pixel below where nothing touches, by the distance from contact.

    The error that 99 % of the pixels keep, of three surfaces; against uniform pixels on a
    transform five times finer.
    """
    from scipy.ndimage import distance_transform_edt

    pixel, times = _WIDTH / _N, 5
    middle = slice(times // 2, None, times)
    layers, depth = Layers([100e9], [_NU]), [0.5 * pixel]
    away: list[NDArray[np.float64]] = []
    errors: dict[Reading, list[NDArray[np.float64]]] = {reading: [] for reading in READINGS}
    seconds = dict.fromkeys(READINGS, math.inf)
    for waves_of in (2, 4, 8):
        p = _rough(_N, waves_of, _WIDTH).pressure
        fine = Tractions((pixel / times,) * 2, np.kron(p, np.ones((times, times))))
        exact = von_mises(next(planes(fine, layers, depth)).stress[:, middle, middle])
        off = distance_transform_edt(np.tile(p == 0.0, (3, 3)))[_N : 2 * _N, _N : 2 * _N]
        away.append(off[p == 0.0])
        for reading in READINGS:
            below = planes(Tractions((pixel, pixel), p), layers, depth, reading=reading)
            plane, cost = timed(partial(next, below), 0.0)
            seconds[reading] = min(seconds[reading], cost)
            errors[reading].append(np.abs(von_mises(plane.stress) / exact - 1.0)[p == 0.0])
    far, points = np.concatenate(away), []
    for reading, found in errors.items():
        all_errors = np.concatenate(found)
        for span, (low, high) in _DISTANCES.items():
            some = all_errors[(far > low - 0.5) & (far <= high + 0.5)]
            error = float(np.quantile(some, 0.99))
            points.append(Point(reading, span, error, seconds[reading], {}))
    return points


def _largest(pressure: NDArray[np.float64], pixel: float, reading: Reading) -> float:
    """Largest von Mises stress [Pa] of twelve planes down to 1.6 of the coarse pixels."""
    depths_of = list(_WIDTH / _N * 0.1 * 2.0 ** np.arange(0.0, 4.1, 4.0 / 11.0))
    load = Tractions((pixel, pixel), pressure)
    below = planes(load, Layers([100e9], [_NU]), depths_of, reading=reading)
    return max(float(von_mises(plane.stress).max()) for plane in below)


def depths() -> list[Point]:
    """Search for the greatest stress over depth, against planes a nanometre apart."""
    dense = SubsurfaceStress(depths=tuple(1e-9 * k for k in range(81)))
    exact = _rough(2 * _N, 2, 2 * _WIDTH, dense).of(SubsurfaceStress).maxima
    points = []
    for tolerance in (0.1, 0.01, 1e-3):
        search = SubsurfaceStress(tolerance=tolerance)
        found, seconds = timed(partial(_rough, 2 * _N, 2, 2 * _WIDTH, search), 0.0)
        part = found.of(SubsurfaceStress)
        for name in ("von_mises", "tresca", "sigma_xz"):
            error = abs(part.maxima[name].value / exact[name].value - 1.0)
            work = {"planes": int(part.depth.size)}
            points.append(Point(name, f"tolerance {tolerance:g}", error, seconds, work))
    return points
