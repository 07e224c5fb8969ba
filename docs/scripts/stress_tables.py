"""Tables of the stress below rough contacts, for `measure_contact.py`: reading, depths and cost."""

from __future__ import annotations

import math
import time
from typing import Any

import attrs
import numpy as np
from validation_tables import grid

import contactkit as ck
from contactkit.app.scenes import open_scene
from contactkit.benchmarks.timing import best_of
from contactkit.elasticity.layer_stack import Layers
from contactkit.elasticity.stress.measures import von_mises
from contactkit.elasticity.stress.planes import planes
from contactkit.elasticity.stress.reading import READINGS, Reading
from contactkit.elasticity.stress.tractions import Tractions

E, NU, WIDTH, N = 100e9, 0.3, 10e-6, 256
HALF = Layers([E], [NU])
SOLID = ck.Material(name="solid", young_modulus=E, poisson_ratio=NU)


def rough(n: int, pixels: float, width: float = WIDTH, *effects: Any) -> ck.ContactResult:
    """Rough half-space, rms 1 nm, p/E = 4e-6; `pixels` of a grid of 39 nm to the shortest wave."""
    surface = ck.GaussianRoughness(
        rms=1e-9, correlation_length=0.5e-6, cutoff=pixels * WIDTH / N, seed=1
    )
    scene = ck.ContactScene(
        interface=ck.Interface(lower=ck.Body(solid=SOLID, surface=surface)),
        window=ck.Window(width=width),
        loading=ck.Pressing(pressure=4e-6 * E),
        effects=(ck.HalfSpace(), *effects),
    )
    return ck.solve(ck.plan(scene, ck.Accuracy(grid=n)))


def _largest(pressure: np.ndarray, pixel: float, reading: Reading) -> float:
    """Largest von Mises stress [Pa] of twelve planes down to 1.6 of the coarse pixels."""
    depths = list(WIDTH / N * 0.1 * 2.0 ** np.arange(0.0, 4.1, 4.0 / 11.0))
    below = planes(Tractions((pixel, pixel), pressure), HALF, depths, reading=reading)
    return max(float(von_mises(plane.stress).max()) for plane in below)


def _half_a_pixel_deep(p: np.ndarray, pixel: float) -> tuple[np.ndarray, float]:
    """Von Mises stress [Pa] of uniform pixels on a transform five times finer, and CPU seconds."""
    times = 5
    fine = Tractions((pixel / times,) * 2, np.kron(p, np.ones((times, times))))
    exact, seconds = best_of(lambda: next(planes(fine, HALF, [pixel / 2])), 1)
    middle = slice(times // 2, None, times)
    return von_mises(exact.stress[:, middle, middle]), seconds


def distance_table() -> str:
    """Stress of the spline off the contact, by the distance from it."""
    from scipy import ndimage

    pixel, found = WIDTH / N, []
    for waves in (2, 4, 8):
        p = rough(N, waves).pressure
        expected, _ = _half_a_pixel_deep(p, pixel)
        plane = next(planes(Tractions((pixel, pixel), p), HALF, [pixel / 2], reading="spline"))
        off = ndimage.distance_transform_edt(np.tile(p == 0.0, (3, 3)))[N : 2 * N, N : 2 * N]
        found.append(np.stack([off, von_mises(plane.stress) / expected])[:, p == 0.0])
    away, ratio = np.concatenate(found, axis=1)
    rows = []
    for low, high in ((1, 1), (2, 2), (3, 3), (4, 4), (5, 6), (7, math.inf)):
        some = ratio[(away > low - 0.5) & (away <= high + 0.5)]
        ends = np.quantile(some, (0.01, 0.99))
        rows.append(
            [
                f"{low}" if low == high else f"{low} to {high}" if high < 7 else "7 and more",
                f"{np.median(some):.2f}",
                f"{ends[0]:.2f} to {ends[1]:.2f}",
                f"{some.min():.2f} to {some.max():.2f}",
            ]
        )
    return grid(["pixels off the contact", "median", "98 % of the pixels", "all pixels"], rows)


def reading_table() -> str:
    """Readings of the pressure: stress off the contact, and the maximum."""
    rows, pixel = [], WIDTH / N
    for waves in (2, 4, 8):
        p = rough(N, waves).pressure
        exact, seconds = _half_a_pixel_deep(p, pixel)
        rows.append(
            [f"{waves}", "uniform, transform 5 times finer", "1", "1", "-", f"{seconds:.2g}"]
        )
        expected = exact[p == 0.0]
        largest = _largest(rough(4 * N, waves).pressure, pixel / 4, "spline")
        for reading in READINGS:
            load = Tractions((pixel, pixel), p)

            def once(one: Tractions = load, reading: Reading = reading) -> Any:
                return next(planes(one, HALF, [pixel / 2], reading=reading))

            plane, seconds = best_of(once)
            ratio = von_mises(plane.stress)[p == 0.0] / expected
            error = _largest(p, pixel, reading) / largest - 1.0
            rows.append(
                [
                    f"{waves}",
                    reading,
                    f"{np.median(ratio):.3f}",
                    f"{ratio.max():.3g}",
                    f"{100.0 * error:+.0f}",
                    f"{seconds:.2g}",
                ]
            )
    head = [
        "pixels to the shortest wave",
        "reading",
        "median ratio",
        "maximum ratio",
        "maximum stress [%]",
        "CPU seconds",
    ]
    return grid(head, rows)


def depth_table() -> str:
    """Search for the maximum over depth, against planes a nanometre apart."""
    dense = ck.SubsurfaceStress(depths=tuple(1e-9 * k for k in range(81)))
    exact = rough(2 * N, 2, 2 * WIDTH, dense).of(ck.SubsurfaceStress).maxima
    rows = []
    for tolerance in (0.1, 0.01, 1e-3):
        run = rough(2 * N, 2, 2 * WIDTH, ck.SubsurfaceStress(tolerance=tolerance))
        part, stages = run.of(ck.SubsurfaceStress), run.work.stages
        for name in ("von_mises", "tresca", "sigma_xz"):
            one = part.maxima[name]
            rows.append(
                [
                    f"{tolerance:g}",
                    f"{part.depth.size}",
                    f"{stages['subsurface-stress'] / stages['contact']:.1f}",
                    name,
                    f"{one.value / 1e9:.4f}",
                    f"{one.z * 1e9:.1f}",
                    f"{one.error:.1e}",
                    f"{one.value / exact[name].value - 1.0:+.1e}",
                ]
            )
    head = [
        "tolerance",
        "planes",
        "time over the contact's",
        "measure",
        "maximum [GPa]",
        "depth [nm]",
        "its estimated error",
        "against planes 1 nm apart",
    ]
    return grid(head, rows)


def stress_cost_table() -> str:
    """CPU seconds of the stress of the head-disk scene, 21 planes of 768 x 768 pixels."""
    scene = open_scene("head-disk").scene
    stress = next(e for e in scene.effects if isinstance(e, ck.SubsurfaceStress))
    without = tuple(e for e in scene.effects if not isinstance(e, ck.SubsurfaceStress))
    rows, base = [], 0.0
    for name, more in (
        ("contact alone", ()),
        ("one coefficient of friction", (stress,)),
        ("three coefficients", (attrs.evolve(stress, coefficients=(0.0, 0.1)),)),
    ):
        plan = ck.plan(attrs.evolve(scene, effects=(*without, *more)), ck.Accuracy(grid=768))
        begun = time.process_time()
        ck.solve(plan)
        seconds = time.process_time() - begun
        base = base or seconds
        rows.append([name, f"{seconds:.1f}", f"{(seconds - base) / base:.1f}"])
    return grid(["head-disk, 768 x 768", "CPU seconds", "stress over contact"], rows)
