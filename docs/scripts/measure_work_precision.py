"""Error over work of the solvers beyond a single contact: ``measure_work_precision.py --write``.

Partial slip, coupled slip, adhesion, loading history, load curve, line contact and sheets: error
against a closed form, or the finest setting where there is none, over convolutions (applications of
the operators). Prints the points; ``--write`` draws docs/img/work-precision-contact.png. Names
select some of the panels: ``... slip adhesion``. Some minutes.
"""

from __future__ import annotations

import math
import sys
import warnings
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import NamedTuple

import numpy as np
from measure_adhesion import UNITS, sphere
from PIL import Image

import contactkit as ck
from contactkit.adhesion import maugis_dugdale
from contactkit.plot import style as plot
from contactkit.reference import hertz, partial_slip

PICTURE = Path(__file__).parents[1] / "img" / "work-precision-contact.png"
E, NU, MU, RADIUS, LOAD = 70e9, 0.3, 0.3, 1e-3, 1.0
GLASS = ck.Material(young_modulus=E, poisson_ratio=NU, hardness=0.7e9)
HERTZ = hertz.sphere(LOAD, RADIUS, E / (1.0 - NU**2))
COLORS, MARKERS = ("#0077bb", "#ee7733", "#009988", "#cc3311"), "osD^"


class Point(NamedTuple):
    """Setting, work (convolutions, or pixels) and relative error."""

    setting: str
    work: float
    error: float


Lines = Mapping[str, list[Point]]


def scene(loading: object, *effects: object, width: float = 2.4, **body: object) -> ck.ContactScene:
    """A rigid sphere on glass."""
    return ck.ContactScene(
        interface=ck.Interface(
            lower=ck.Body(solid=body.get("solid", GLASS)),  # type: ignore[arg-type]
            upper=ck.Body(surface=ck.Paraboloid(radius=RADIUS)),
        ),
        window=ck.Window(width=width * HERTZ.contact_radius, periodic=False),
        loading=loading,  # type: ignore[arg-type]
        effects=(ck.LayeredHalfSpace(), *effects),  # type: ignore[arg-type]
    )


def solved(made: ck.ContactScene, grid: int, **accuracy: float) -> ck.ContactResult:
    """Plan and solve."""
    return ck.solve(ck.plan(made, ck.Accuracy(grid=grid, **accuracy)))  # type: ignore[arg-type]


def slip() -> Lines:
    """Displacement at 0.6 of full sliding against Mindlin, over grid and over tolerance."""
    exact = partial_slip.displacement(
        partial_slip.Sphere(LOAD, MU, HERTZ.contact_radius, 0.5 * E / (1.0 + NU) / (2.0 - NU)),
        0.6 * MU * LOAD,
    )

    def run(grid: int, rtol: float) -> tuple[float, int]:
        effect = ck.PartialSlip(coefficient=MU, path=(ck.TangentialStep(ratio=0.6),), rtol=rtol)
        part = solved(scene(ck.Pressing(force=LOAD), effect), grid).of(ck.PartialSlip)
        return float(part.displacement[-1]), part.applications

    grids = []
    for n in (12, 24, 48, 96, 192):
        value, work = run(n, 1e-8)
        grids.append(Point(f"{n} x {n}", work, abs(value / exact - 1.0)))
    best, tolerances = run(64, 1e-12)[0], []
    for rtol in (1e-3, 1e-4, 1e-6, 1e-8, 1e-10):
        value, work = run(64, rtol)
        tolerances.append(Point(f"rtol {rtol:g}", work, abs(value / best - 1.0)))
    return {"grid, to Mindlin": grids, "tolerance at 64 x 64": tolerances}


def coupled() -> Lines:
    """Tractions and stick radius of a pressed sphere over the steps of pressing."""

    def run(steps: int) -> tuple[np.ndarray, float, int]:
        effect = ck.PartialSlip(
            coefficient=MU,
            path=(ck.TangentialStep(force=0.0),),
            components=2,
            coupled=True,
            pressing_steps=steps,
        )
        found = solved(scene(ck.Pressing(force=LOAD), effect), 48, rtol=1e-6)
        part = found.of(ck.PartialSlip)
        tractions = np.array([part.traction_x[0], part.traction_y[0]])
        return tractions, math.sqrt(part.stick_fraction[0]), found.work.n_operator_applications

    best, radius, _ = run(64)
    bound, tractions, radii = np.linalg.norm(best), [], []
    for steps in (1, 2, 4, 8, 16, 32):
        found, own, work = run(steps)
        label = f"{steps} step" + "s" * (steps > 1)
        tractions.append(Point(label, work, float(np.linalg.norm(found - best) / bound)))
        radii.append(Point(label, work, max(abs(own / radius - 1.0), 1e-4)))
    return {"tractions, rms": tractions, "stick radius": radii}


def adhesion() -> Lines:
    """Pull-off force against Maugis over the grid."""
    found = {}
    for transition in (0.1, 1.0, 2.0):
        exact, points = -maugis_dugdale.limits(transition).pull_off.load, []
        for n in (24, 32, 48, 64, 96):
            curve = sphere(transition, n)
            error = abs(curve.pull_off_force / UNITS.load / exact - 1.0)
            points.append(Point(f"{n} x {n}", curve.n_applications, error))
        found[f"Maugis parameter {transition:g}"] = points
    return found


def history() -> Lines:
    """Imbalance of work and energy of a load cycle, and its loss, over the steps."""

    def run(steps: int) -> tuple[float, float, int]:
        effects = ck.HardnessLimit(rule="material"), ck.PlasticHistory(forces=(LOAD,), steps=steps)
        found = solved(scene(ck.Pressing(force=0.0), *effects), 64)
        part = found.of(ck.PlasticHistory)
        loss = float(part.plastic_work[-1])
        return part.work_error, loss, found.work.n_operator_applications

    best, balance, losses = run(1)[1], [], []
    for steps in (2, 4, 8, 16, 32):
        error, loss, work = run(steps)
        balance.append(Point(f"{steps} steps", work, error))
        losses.append(Point(f"{steps} steps", work, max(abs(loss / best - 1.0), 1e-16)))
    return {"work of the load, trapezoids": balance, "plastic work": losses}


def curve() -> Lines:
    """Twenty loads of a rough map: largest error of approach and pressure over the tolerance."""
    rough = ck.SelfAffineRoughness(rms=1e-9, hurst=0.8, rolloff=5e-7, cutoff=8e-8, seed=1)
    made = ck.ContactScene(
        interface=ck.Interface(lower=ck.Body(solid=GLASS), upper=ck.Body(surface=rough)),
        window=ck.Window(width=1e-6),
        loading=ck.Pressing(pressure=1e8),
        effects=(ck.HalfSpace(),),
    )
    pressures = list(np.geomspace(1e7, 4e8, 20))
    plan = ck.plan(made, ck.Accuracy(grid=128))
    best, found = ck.load_curve(plan, pressures=pressures, rtol=1e-10), {}
    names = {"approach": "approach", "max_pressure": "maximum pressure"}
    for name, label in names.items():
        points = []
        for rtol in (1e-2, 1e-3, 1e-4, 1e-5, 1e-6, 1e-8):
            one = ck.load_curve(plan, pressures=pressures, rtol=rtol)
            error = np.abs(getattr(one, name) / getattr(best, name) - 1.0).max()
            points.append(Point(f"rtol {rtol:g}", int(one.applications.sum()), float(error)))
        found[f"20 loads, {label}"] = points
    return found


def lines() -> Lines:
    """Maximum pressure of a cylinder (Hertz) and of a sphere on a sheet over the grid."""
    load = 200.0  # [N/m]
    width = math.sqrt(4.0 * load * RADIUS * (1.0 - NU**2) / (math.pi * E))
    exact, side, cylinder = 2.0 * load / (math.pi * width), 2.4 * width, []
    for n in (16, 32, 64, 128, 256):
        y = (np.arange(n) + 0.5) / n * side - 0.5 * side
        heights = np.repeat(-(y**2) / (2.0 * RADIUS), 2).reshape(n, 2)
        found = ck.press(
            heights, side / n, GLASS, mean_pressure=load / side, periodic="x", rtol=1e-8
        )
        work = found.work.n_operator_applications
        error = abs(found.max_pressure / exact - 1.0)
        cylinder.append(Point(f"{work}", n, error))
    sheet = ck.Stack(
        layers=(ck.Layer(material=GLASS, thickness=2.0 * HERTZ.contact_radius),),
        substrate=ck.RigidBase(bonded=True),
    )
    runs = {
        n: solved(scene(ck.Pressing(force=LOAD), solid=sheet), n) for n in (16, 32, 64, 128, 384)
    }
    best = runs[384].max_pressure
    on_sheet = [
        Point(f"{r.work.n_operator_applications} convolutions", n, abs(r.max_pressure / best - 1.0))
        for n, r in runs.items()
        if n < 384
    ]
    return {"cylinder, one-axis window": cylinder, "sphere on a sheet on a base": on_sheet}


class Panel(NamedTuple):
    """Title, what the work is, and the points."""

    title: str
    work: str
    lines: Callable[[], Lines]


PANELS = {
    "slip": Panel("partial slip of a sphere: displacement", "convolutions", slip),
    "coupled": Panel("coupled slip of a pressed sphere", "convolutions", coupled),
    "adhesion": Panel("adhesion: pull-off force of a sphere", "convolutions", adhesion),
    "history": Panel("plastic load cycle of a sphere", "convolutions", history),
    "curve": Panel("load curve of a rough map", "convolutions", curve),
    "lines": Panel("maximum pressure (beside: convolutions)", "pixels across the window", lines),
}


def draw(found: Mapping[str, Lines]) -> None:
    """Draw all panels."""
    figure, axes = plot.figure(2, 3, size=(14.0, 8.4))
    for ax, (name, curves) in zip(axes.flat, found.items(), strict=False):
        labelled = set()
        for (label, points), color, marker in zip(curves.items(), COLORS, MARKERS, strict=False):
            work, error = [p.work for p in points], [p.error for p in points]
            ax.plot(work, error, color=color, marker=marker, label=label)
            for point, place in ((points[0], (7, 3)), (points[-1], (7, -11))):
                if (point.setting, point.work) in labelled:
                    continue
                labelled.add((point.setting, point.work))
                ax.annotate(
                    point.setting,
                    (point.work, point.error),
                    xytext=place,
                    textcoords="offset points",
                    color="0.3",
                    fontsize=8,
                )
        ax.set(xscale="log", yscale="log", xlabel=PANELS[name].work, ylabel="relative error")
        ax.margins(x=0.25, y=0.12)
        plot.plain_log(ax.xaxis)
        plot.title(ax, PANELS[name].title)
        plot.legend(ax, loc="best", fontsize=8)
    plot.letters(axes.flat)
    plot.save(figure, PICTURE)
    with Image.open(PICTURE) as drawn:
        small = drawn.convert("RGB").quantize(64, dither=Image.Dither.NONE)
    small.save(PICTURE, optimize=True)


def main(asked: list[str]) -> int:
    """Measure, print and draw."""
    names = [name for name in asked if name in PANELS] or list(PANELS)
    found = {}
    for name in names:
        found[name] = PANELS[name].lines()
        for label, points in found[name].items():
            row = "; ".join(f"{p.setting}: {p.work:.0f}, {p.error:.1e}" for p in points)
            sys.stdout.write(f"{name}, {label}: {row}\n")
            sys.stdout.flush()
    if "--write" in asked:
        draw(found)
    return 0


if __name__ == "__main__":
    warnings.simplefilter("ignore", ck.ValidityWarning)
    sys.exit(main(sys.argv[1:]))
