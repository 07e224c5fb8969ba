"""Numbers of the contact on docs/accuracy.md: ``measure_contact.py [NAME ...] --write``.

A few minutes, most of it for the maps of 1024 x 1024 pixels.
"""

from __future__ import annotations

import json
import math
import sys
import warnings
from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np
from contact_effort import fast_table, ratio_table, solver_table
from measured_blocks import measure
from stress_tables import depth_table, distance_table, reading_table, stress_cost_table
from validation_tables import grid

import contactkit as ck
from contactkit.benchmarks.table import study_of
from contactkit.benchmarks.timing import best_of
from contactkit.elasticity.layered import compliance, normal_symbol

DATA = Path(__file__).parents[2] / "tests" / "data"
CASES = json.loads((DATA / "contact.json").read_text("utf-8"))
E, NU, RADIUS, A0 = 1e9, 0.3, 1e-3, 1e-6  # substrate, sphere, and Hertz's contact on it
MODULUS = E / (1.0 - NU**2)
LOAD = 4.0 * MODULUS * A0**3 / (3.0 * RADIUS)
P_HERTZ = 2.0 * A0 * MODULUS / (math.pi * RADIUS)


def stack(layers: Sequence[Sequence[float]], unit: float = E, length: float = A0) -> ck.Stack:
    """Layers of (modulus, thickness) in units of a substrate and a length."""

    def material(ratio: float) -> ck.Material:
        return ck.Material(young_modulus=ratio * unit, poisson_ratio=NU)

    made = tuple(ck.Layer(material=material(e), thickness=h * length) for e, h in layers)
    return ck.Stack(layers=made, substrate=material(1.0))


def sphere(solid: ck.Stack, width: float, cells: int, *effects: Any) -> ck.ContactResult:
    """Rigid sphere on a solid, an isolated contact."""
    scene = ck.ContactScene(
        interface=ck.Interface(
            lower=ck.Body(solid=solid), upper=ck.Body(surface=ck.Paraboloid(radius=RADIUS))
        ),
        window=ck.Window(width=width, periodic=False),
        loading=ck.Pressing(force=LOAD),
        effects=(ck.LayeredHalfSpace(), *effects),
    )
    return ck.solve(ck.plan(scene, ck.Accuracy(grid=cells)))


def hertz_table() -> str:
    """Sphere on a half-space over pixels to the contact radius: the study of the table."""
    cells: dict[str, list[str]] = {}
    points = study_of("hertz").points()
    methods = dict.fromkeys(point.method for point in points)
    for point in points:
        cells.setdefault(point.label.split()[0], []).append(f"{point.error:.1e}")
    head = ("pixels to the contact radius", *methods)
    return grid(head, ((pixels, *errors) for pixels, errors in cells.items()))


def sphere_table() -> str:
    """The table of layered spheres: errors at 32 pixels to the contact radius."""
    rows = []
    for case in CASES["spheres"]:
        solid, width = stack(case["layers"]), 2.5 * case["contact_radius"] * A0
        cells: list[str] = []
        for friction, wanted in case["maxima"].items():
            stress = ck.SubsurfaceStress(tolerance=1e-4, window=128.0)
            mu = float(friction)
            slid = (ck.FrictionTraction(coefficient=mu),) if mu else ()
            run = sphere(solid, width, 80, stress, *slid)
            if not cells:
                radius = math.sqrt(run.contact_area / math.pi) / A0
                cells += [
                    f"{run.max_pressure / P_HERTZ / case['peak_pressure'] - 1.0:+.0e}",
                    f"{run.approach / (A0**2 / RADIUS) / case['approach'] - 1.0:+.0e}",
                    f"{radius / case['contact_radius'] - 1.0:+.0e}",
                ]
            largest = run.of(ck.SubsurfaceStress).maxima["sqrt_j2"].value / P_HERTZ
            cells.append(f"{wanted['sqrt_j2']:.4f} ({largest / wanted['sqrt_j2'] - 1.0:+.0e})")
        rows.append((case["name"], f"{case['peak_pressure']:.4f}", *cells[:3], *cells[3:]))
    head = (
        "layers",
        "p(0)/p_H",
        "error of p(0)",
        "of the approach",
        "of the radius",
        "sqrt(J2)/p_H, mu = 0",
        "mu = 0.25",
        "mu = 0.5",
    )
    return grid(head, rows)


def wave_table() -> str:
    """Waves of one direction: maximum errors over the rows of each case."""
    cases = [
        {"name": "half-space (Westergaard)", "layers": [], "rows": CASES["waves"]["homogeneous"]}
    ]
    rows = []
    for case in [*cases, *CASES["waves"]["layered"]]:
        layers = [(e / (1.0 - NU**2), h) for e, h in case["layers"]]
        solid = stack(layers, 1.0 - NU**2, 1.0)
        for n in (128, 256, 512):
            found = [_wave_errors(solid, row, n) for row in case["rows"]]
            worst = [max(one[i] for one in found) for i in range(3)]
            rows.append(
                (case["name"], f"{n}", f"{worst[0]:.0e}", f"{worst[1]:.0e}", f"{worst[2]:.2f}")
            )
    head = (
        "solid",
        "pixels to the wave",
        "maximum pressure",
        "mean gap over amplitude",
        "half-width [pixels]",
    )
    return grid(head, rows)


def _wave_errors(solid: ck.Stack, row: Mapping[str, float], n: int) -> tuple[float, float, float]:
    scene = ck.ContactScene(
        interface=ck.Interface(
            lower=ck.Body(solid=solid),
            upper=ck.Body(surface=ck.Wave(amplitude=1.0, wavelength=1.0)),
        ),
        window=ck.Window(width=1.0, height=2.0 / n),
        loading=ck.Pressing(pressure=row["mean_pressure"]),
        effects=(ck.LayeredHalfSpace(),),
    )
    run = ck.solve(ck.plan(scene, ck.Accuracy(grid=(2, n))))
    return (
        abs(run.max_pressure / row["peak_pressure"] - 1.0),
        abs(float(run.gap.mean()) - row["mean_gap"]),
        abs(0.5 * run.contact_fraction - row["half_width"]) * n,
    )


def compliance_table() -> str:
    """Worst relative error of the compliances on the tables of 60 digits."""
    worst = dict.fromkeys(("F11", "F12", "C", "Fs"), (0.0, ""))
    stacks = json.loads((DATA / "layered.json").read_text("utf-8"))["stacks"]
    for name, one in stacks.items():
        alpha, *wanted = np.array(one["rows"]).T
        found = compliance(
            alpha, one["young_modulus"], one["poisson_ratio"], one["thickness"]
        )._asdict()
        exact = dict(zip(("F11", "F12", "C", "Fs"), wanted, strict=True))
        for key in worst:
            scale = np.sqrt(exact["F11"] * exact["C"]) if key == "F12" else exact[key]
            error = float(np.max(np.abs(found[key] - exact[key]) / scale))
            worst[key] = max(worst[key], (error, name))
    rows = [(key, f"{error:.1e}", name) for key, (error, name) in worst.items()]
    n = len(next(iter(stacks.values()))["rows"])
    head = ("compliance", "worst relative error", f"at, of {len(stacks)} stacks x {n} wavenumbers")
    return grid(head, rows)


def symbol_table() -> str:
    """CPU seconds of the compliance of a map of 1024 x 1024 pixels."""
    rows = []
    for n in (0, 3, 20):
        elastic = np.linspace(3.0, 1.0, n + 1) * 1e11, np.full(n + 1, 0.3), np.full(n, 5e-9)
        _, seconds = best_of(lambda e=elastic: normal_symbol((1024, 1024), (1e-9, 1e-9), *e))
        rows.append((f"{n}", f"{seconds:.3f}"))
    return grid(("layers", "seconds for 1024 x 513 wavenumbers"), rows)


def area_table() -> str:
    """Area of a rough contact over pixels to its shortest wave, counted and corrected."""
    half_space = ck.Material(young_modulus=E, poisson_ratio=0.0)
    rough = ck.SelfAffineRoughness(rms=1e-9, hurst=0.8, rolloff=5e-7, cutoff=1e-7)
    scene = ck.ContactScene(
        interface=ck.Interface(lower=ck.Body(solid=half_space), upper=ck.Body(surface=rough)),
        window=ck.Window(width=2e-6),
        loading=ck.Pressing(pressure=3e5),
        effects=(ck.HalfSpace(),),
    )
    rows = []
    for n in (64, 128, 256, 512, 1024):
        run = ck.solve(ck.plan(scene, ck.Accuracy(grid=n)))
        corrected = 100.0 * run.corrected_contact_area / run.plan.grid.area
        rows.append([f"{n / 20:g}", f"{100.0 * run.contact_fraction:.3f}", f"{corrected:.3f}"])
    return grid(["pixels to the shortest wave", "counted [%]", "corrected [%]"], rows)


def _rough(pressure: float, pixels: int) -> ck.ContactResult:
    """Rough contact of 64 shortest waves along a side, with its stress at the surface."""
    solid = ck.Material(young_modulus=100e9, poisson_ratio=NU)
    rough = ck.GaussianRoughness(rms=1e-9, correlation_length=5e-7, cutoff=1e-5 / 64)
    scene = ck.ContactScene(
        interface=ck.Interface(lower=ck.Body(solid=solid), upper=rough),
        window=ck.Window(width=1e-5),
        loading=ck.Pressing(pressure=pressure),
        effects=(ck.HalfSpace(), ck.SubsurfaceStress(depths=(0.0, 1e-8))),
    )
    return ck.solve(ck.plan(scene, ck.Accuracy(grid=64 * pixels)))


def pixels_table() -> str:
    """Stated and true error over pixels to the shortest wave, in per cent, at two loads."""
    shown = {
        "max_pressure": "maximum pressure",
        "contact_area": "pixel count of the area",
        "max_tension": "tension",
    }
    loads = (4e5, 1e7)
    right = {load: _rough(load, 16).scalars() for load in loads}
    rows = []
    for pixels in (2, 3, 4, 6, 8, 12):
        found = [(load, _rough(load, pixels)) for load in loads]
        estimates = [ck.discretisation_error(run).errors for _, run in found]
        row = [f"{pixels}"]
        for name in shown:
            true = [abs(r.scalars()[name][0] / right[load][name][0] - 1.0) for load, r in found]
            row.append(" / ".join(f"{100.0 * e[name]:.0f}" for e in estimates))
            row.append(" / ".join(f"{100.0 * e:.0f}" for e in true))
        rows.append(row)
    head = ["pixels per shortest wavelength"]
    for label in shown.values():
        head += [f"{label}: estimate", "true"]
    return grid(head, rows)


TABLES: Mapping[str, Callable[[], str]] = {
    "compliance": compliance_table,
    "symbol": symbol_table,
    "hertz": hertz_table,
    "spheres": sphere_table,
    "waves": wave_table,
    "area": area_table,
    "pixels": pixels_table,
    "readings": reading_table,
    "distances": distance_table,
    "depths": depth_table,
    "stress-cost": stress_cost_table,
    "solver": solver_table,
    "fast": fast_table,
    "ratios": ratio_table,
}


if __name__ == "__main__":
    warnings.simplefilter("ignore", ck.ValidityWarning)  # coarse grids are what is measured
    sys.exit(measure(TABLES))
