"""Measure the numbers of the contact on docs/accuracy.md on this machine.

``python docs/measure_contact.py`` prints them, ``--write`` puts them into the page too. Takes a
few minutes, most of it for the maps of 1024 x 1024 pixels. Names select some: ``... hertz waves``.
"""

from __future__ import annotations

import json
import math
import sys
import time
from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np
from measured_blocks import write_blocks
from validation_tables import grid

import contactkit as ck
from contactkit.contact_engine import Engine
from contactkit.kernels.active_set import Press
from contactkit.kernels.layered import compliance, normal_symbol
from contactkit.kernels.roughness_statistics import rms_slope
from contactkit.reference import hertz

DATA = Path(__file__).parents[1] / "tests" / "data"
CASES = json.loads((DATA / "contact.json").read_text("utf-8"))
E, NU, RADIUS, A0 = 1e9, 0.3, 1e-3, 1e-6  # substrate, sphere, and Hertz's contact on it
MODULUS = E / (1.0 - NU**2)
LOAD = 4.0 * MODULUS * A0**3 / (3.0 * RADIUS)
P_HERTZ = 2.0 * A0 * MODULUS / (math.pi * RADIUS)


def stack(layers: Sequence[Sequence[float]], unit: float = E, length: float = A0) -> ck.Stack:
    """Layers of (modulus, thickness) in units of a substrate and a length."""

    def material(share: float) -> ck.Material:
        return ck.Material(young_modulus=share * unit, poisson_ratio=NU)

    made = tuple(ck.Layer(material=material(e), thickness=h * length) for e, h in layers)
    return ck.Stack(layers=made, substrate=material(1.0))


def sphere(solid: ck.Stack, width: float, cells: int, *effects: Any) -> ck.ContactResult:
    """Rigid sphere on a solid, without neighbours."""
    scene = ck.ContactScene(
        interface=ck.ContactInterface(
            lower=ck.Body(solid=solid), upper=ck.Body(surface=ck.Paraboloid(radius=RADIUS))
        ),
        window=ck.Window(width=width, periodic=False),
        pressing=ck.Pressing(force=LOAD),
        effects=(ck.LayeredHalfSpace(), *effects),
    )
    return ck.solve(ck.plan(scene, ck.Accuracy(grid=cells)))


def hertz_table() -> str:
    """Sphere on a half-space over pixels to the contact radius."""
    exact, rows = hertz.sphere(LOAD, RADIUS, MODULUS), []
    for n in (8, 16, 32, 64, 128):
        run = sphere(stack(()), 2.5 * A0, int(2.5 * n))
        errors = (
            run.max_pressure / exact.peak_pressure - 1.0,
            run.approach / exact.approach - 1.0,
            math.sqrt(run.contact_area / math.pi) / exact.contact_radius - 1.0,
        )
        rows.append((f"{n}", *(f"{e:+.1e}" for e in errors)))
    head = ("pixels to the contact radius", "largest pressure", "approach", "contact radius")
    return grid(head, rows)


def sphere_table() -> str:
    """The table of layered spheres: errors at 32 pixels to the contact radius."""
    rows = []
    for case in CASES["spheres"]:
        solid, width = stack(case["layers"]), 2.5 * case["contact_radius"] * A0
        cells: list[str] = []
        for friction, wanted in case["maxima"].items():
            depths = sorted({*(float(z) * A0 for z in np.linspace(0.0, 1.0, 17))})
            stress = ck.SubsurfaceStress(depths=depths, window=128.0)
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
    head = ("layers", "p(0)/p_H", "error of p(0)", "of the approach", "of the radius",
            "sqrt(J2)/p_H, mu = 0", "mu = 0.25", "mu = 0.5")  # fmt: skip
    return grid(head, rows)


def wave_table() -> str:
    """Waves of one direction: largest errors over the rows of each case."""
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
            rows.append((case["name"], f"{n}", f"{worst[0]:.0e}", f"{worst[1]:.0e}",
                         f"{worst[2]:.2f}"))  # fmt: skip
    head = ("solid", "pixels to the wave", "largest pressure", "mean gap over amplitude",
            "half-width [pixels]")  # fmt: skip
    return grid(head, rows)


def _wave_errors(solid: ck.Stack, row: Mapping[str, float], n: int) -> tuple[float, float, float]:
    scene = ck.ContactScene(
        interface=ck.ContactInterface(
            lower=ck.Body(solid=solid),
            upper=ck.Body(surface=ck.Wave(amplitude=1.0, wavelength=1.0)),
        ),
        window=ck.Window(width=1.0, height=2.0 / n),
        pressing=ck.Pressing(pressure=row["mean_pressure"]),
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


def best_of(run: Callable[[], Any], repeats: int = 3) -> tuple[Any, float]:
    """Result of a run, and the best of its CPU times [s]."""
    found, seconds = run(), math.inf
    for _ in range(repeats):
        begun = time.process_time()
        found = run()
        seconds = min(seconds, time.process_time() - begun)
    return found, seconds


def symbol_table() -> str:
    """CPU seconds of the compliance of a map of 1024 x 1024 pixels."""
    rows = []
    for n in (0, 3, 20):
        elastic = np.linspace(3.0, 1.0, n + 1) * 1e11, np.full(n + 1, 0.3), np.full(n, 5e-9)
        _, seconds = best_of(lambda e=elastic: normal_symbol((1024, 1024), (1e-9, 1e-9), *e))
        rows.append((f"{n}", f"{seconds:.3f}"))
    return grid(("layers", "seconds for 1024 x 513 wavenumbers"), rows)


STEEL = ck.Material(young_modulus=210e9, poisson_ratio=0.3, hardness=7.5e9)


def rough_scene(
    n: int, area: float, solid: Any = STEEL, *effects: Any, periodic: bool = True
) -> tuple[ck.ContactScene, ck.Accuracy]:
    """A self-affine surface whose shortest wave has eight pixels, pressed to about an area."""
    width = n * 10e-9
    surface = ck.SelfAffineRoughness(rms=1e-9, hurst=0.8, rolloff=width / 4, cutoff=80e-9)
    from contactkit.realise import realise
    from contactkit.topography import Grid

    heights = realise(surface, Grid((n, n), (10e-9, 10e-9), True))
    slope = float(rms_slope(heights, (10e-9, 10e-9), True))
    scene = ck.ContactScene(
        interface=ck.ContactInterface(lower=ck.Body(solid=solid), upper=ck.Body(surface=surface)),
        window=ck.Window(width=width, periodic=periodic),
        pressing=ck.Pressing(pressure=0.5 * area * slope * STEEL.plane_strain_modulus),
        effects=(ck.LayeredHalfSpace(), *effects),
    )
    return scene, ck.Accuracy(grid=n)


def timed(scene: ck.ContactScene, accuracy: ck.Accuracy) -> tuple[ck.ContactResult, float]:
    """A contact, and the best CPU seconds of its solve without the setup."""
    made = ck.plan(scene, accuracy)
    engine = Engine(made)
    return best_of(lambda: ck.solve(made, engine=engine))


def solver_table() -> str:
    """Operator applications and CPU seconds over grid, load and edges."""
    rows = []
    for periodic, sizes in ((True, (256, 512, 1024)), (False, (256, 512))):
        for n in sizes:
            for area in (0.01, 0.05, 0.2):
                run, seconds = timed(*rough_scene(n, area, periodic=periodic))
                edges = "periodic" if periodic else "free"
                cells = f"{100 * run.contact_fraction:.1f}", f"{run.work.n_operator_applications}"
                rows.append((edges, f"{n}", *cells, f"{run.residual:.0e}", f"{seconds:.2f}"))
    head = ("edges", "pixels a side", "contact area [%]", "operator applications", "residual",
            "seconds")  # fmt: skip
    return grid(head, rows)


def fast_table() -> str:
    """The solver with and without the extra `fast`, at 5 % contact."""
    rows = []
    for n in (256, 512, 1024):
        made = ck.plan(*rough_scene(n, 0.05))
        engine = Engine(made)
        cells = []
        for fast in (True, False):
            press = Press(made.grid.shape, made.grid.pixel_size, engine.makers[0], True, fast=fast)
            found, seconds = best_of(
                lambda press=press, engine=engine, made=made: press.solve(
                    engine.heights, mean_pressure=made.mean_pressure
                )
            )
            cells += [f"{found.n_applications}", f"{seconds:.2f}"]
        rows.append((f"{n}", *cells))
    head = ("pixels a side", "applications, fast", "seconds, fast", "applications, without",
            "seconds, without")  # fmt: skip
    return grid(head, rows)


def ratio_table() -> str:
    """What layers and a hardness cost, on 512 x 512 pixels and 5 % contact."""
    coated = ck.Stack(
        layers=tuple(ck.Layer(material=ck.load_material(m), thickness=h)
                     for m, h in (("dlc", 5e-9), ("co-cr", 25e-9), ("ni-p", 1e-6))),
        substrate=ck.load_material("al-mg"),
    )  # fmt: skip
    hard = ck.HardnessLimit(rule="constant", hardness=3e9)
    plain, base = timed(*rough_scene(512, 0.05))
    rows = [("half-space", f"{plain.work.n_operator_applications}", f"{base:.2f}", "1")]
    for label, run, seconds in (
        ("three layers", *timed(*rough_scene(512, 0.05, coated))),
        ("hardness of 3 GPa", *timed(*rough_scene(512, 0.05, STEEL, hard))),
    ):
        count = run.work.n_operator_applications
        rows.append((label, f"{count}", f"{seconds:.2f}", f"{seconds / base:.2f}"))
    scene, accuracy = rough_scene(512, 0.05)
    top = scene.pressing.pressure or 0.0
    loads = {"pressing.pressure": [top * 2.0 ** (-0.5 * i) for i in range(19, -1, -1)]}
    curve, seconds = best_of(lambda: ck.study(scene, loads, accuracy), repeats=1)
    count = int(sum(p.n_operator_applications for p in curve.points))
    label = "load curve of 20 points up to it, with setup"
    rows.append((label, f"{count}", f"{seconds:.2f}", f"{seconds / base:.1f}"))
    return grid(("what", "operator applications", "seconds", "over the half-space"), rows)


def area_table() -> str:
    """Area of a rough contact over pixels to its shortest wave, counted and corrected."""
    half_space = ck.Material(young_modulus=E, poisson_ratio=0.0)
    rough = ck.SelfAffineRoughness(rms=1e-9, hurst=0.8, rolloff=5e-7, cutoff=1e-7)
    scene = ck.ContactScene(
        interface=ck.ContactInterface(
            lower=ck.Body(solid=half_space), upper=ck.Body(surface=rough)
        ),
        window=ck.Window(width=2e-6),
        pressing=ck.Pressing(pressure=3e5),
        effects=(ck.HalfSpace(),),
    )
    rows = []
    for n in (64, 128, 256, 512, 1024):
        run = ck.solve(ck.plan(scene, ck.Accuracy(grid=n)))
        corrected = 100.0 * run.corrected_contact_area / run.plan.grid.area
        rows.append([f"{n / 20:g}", f"{100.0 * run.contact_fraction:.3f}", f"{corrected:.3f}"])
    return grid(["pixels to the shortest wave", "counted [%]", "corrected [%]"], rows)


TABLES: Mapping[str, Callable[[], str]] = {
    "compliance": compliance_table,
    "symbol": symbol_table,
    "hertz": hertz_table,
    "spheres": sphere_table,
    "waves": wave_table,
    "area": area_table,
    "solver": solver_table,
    "fast": fast_table,
    "ratios": ratio_table,
}


def main() -> int:
    """Measure, print, and write if asked."""
    names = [a for a in sys.argv[1:] if a != "--write"] or list(TABLES)
    found = {}
    for name in names:
        found[name] = TABLES[name]()
        sys.stdout.write(f"{name}\n\n{found[name]}\n\n")
    if "--write" in sys.argv[1:]:
        missing = write_blocks(found)
        sys.stdout.write(f"no page has: {', '.join(missing) or 'none missing'}\n")
    return 0


if __name__ == "__main__":
    sys.exit(main())
