"""Accuracy and cost of films on faces: ``measure_films.py [NAME ...] --write``.

Names select some of the tables, or ``pictures``. Seconds are those of the processor on one thread,
the least of some.
"""

from __future__ import annotations

import math
import sys
import tempfile
import warnings
from collections.abc import Callable
from pathlib import Path
from time import process_time

import numpy as np
from measured_blocks import measure
from PIL import Image
from validation_tables import grid

import contactkit as ck
from contactkit.benchmarks.timing import best_of
from contactkit.fmu.framework.instance import Instance
from contactkit.fmu.framework.toolchain import local
from contactkit.fmu.native.build import build_native
from contactkit.lubrication import reynolds
from contactkit.lubrication.reynolds.face import Face

R, OIL, GAP, RATE = 3.175e-3, 0.1, 1e-5, 1e-3
SIZES = (64, 128, 256)
DISC = ck.Disc(radius=R)
IMG = Path(__file__).parents[1] / "img"


def squeeze(face: Face, gap: object = GAP) -> float:
    """Force of a full film."""
    film = reynolds.GridFilm(face=face, viscosity=OIL)
    return reynolds.solve_pressure(film, gap, RATE).force


def accuracy() -> str:
    """Errors of forces against closed forms."""
    side, curvature = 4e-3, 1.0

    def made(shape: object, *holes: object) -> Callable[[int], float]:
        return lambda n: squeeze(reynolds.rasterise(shape, n, holes=holes))

    def domed(n: int) -> float:
        face = reynolds.rasterise(DISC, n)
        return squeeze(face, reynolds.gap_map(face, GAP, dome_radius=curvature))

    def recessed(n: int) -> float:
        face, hole = reynolds.rasterise(DISC, n), ck.Disc(radius=1.5e-3)
        recess = ck.Recess(shape=hole, depth=3e-5)
        return squeeze(face, reynolds.gap_map(face, GAP, recesses=[recess]))

    def masked(n: int) -> float:
        face = reynolds.rasterise(DISC, n)
        return squeeze(reynolds.face_from_mask(face.inside, face.pixel_size))

    small = reynolds.Hole(shape=ck.Disc(radius=0.01 * R))
    pocket = reynolds.Pocket(shape=ck.Disc(radius=0.5 * R))
    cases = {
        "disc": (made(DISC), reynolds.disc_damping(R)),
        "disc, from a mask": (masked, reynolds.disc_damping(R)),
        "ring, hole 0.3 R vented": (
            made(ck.Ring(radius=R, hole_radius=0.3 * R)),
            reynolds.ring_damping(R, 0.3 * R),
        ),
        "ring, hole 0.01 R vented": (made(DISC, small), reynolds.ring_damping(R, 0.01 * R)),
        "ring, hole 0.5 R sealed": (
            made(DISC, pocket),
            reynolds.ring_damping(R, 0.5 * R, is_sealed=True),
        ),
        "square": (
            made(ck.Rectangle(length=side, width=side)),
            reynolds.rectangle_damping(side, side),
        ),
        "rectangle 2:1": (
            made(ck.Rectangle(length=2 * side, width=side)),
            reynolds.rectangle_damping(2 * side, side),
        ),
        "ellipse 1.5:1": (
            made(ck.Ellipse(semi_axes=(R, R / 1.5))),
            reynolds.ellipse_damping((R, R / 1.5)),
        ),
        "equilateral triangle": (
            made(ck.equilateral_triangle(side)),
            reynolds.triangle_damping(side),
        ),
        "disc under a dome": (domed, reynolds.dome_damping(R, curvature)),
        "disc with a recess of 3 h": (recessed, reynolds.recess_damping(R, 1.5e-3, 3e-5)),
    }
    rows = []
    for name, (force, law) in cases.items():
        exact = law.force(GAP, RATE, OIL)
        rows.append([name, *(f"{force(n) / exact - 1.0:.1e}" for n in SIZES)])
    return grid(["planform", *(f"{n} cells" for n in SIZES)], rows)


def cavitated_radius(sigma: float) -> tuple[float, float]:
    """Cavity radius over R, and force over that of the tension, at sigma times the onset."""
    low, high = 0.0, 1.0
    for _ in range(200):
        x = 0.5 * (low + high)
        low, high = (x, high) if 1.0 - x * x + 2.0 * x * x * math.log(x) > 1.0 / sigma else (low, x)
    rho = x * x
    film = 0.5 * (1.0 - rho) ** 2 - rho * (1.0 - rho) - rho * rho * math.log(rho)
    return x, rho + sigma * film


def cavity() -> str:
    """Errors of a first opening over sigma, and of long journal bearings over the cells."""
    rows = []
    for sigma in (1.5, 3.0, 30.0, 300.0):
        _, ratio = cavitated_radius(sigma)
        exact = ratio * math.pi * R**2 * 1e6
        row, counts = [f"disc, {sigma:g} times the onset"], []
        for n in SIZES:
            film = reynolds.GridFilm(face=reynolds.rasterise(DISC, n), viscosity=OIL, drop=1e6)
            speed = sigma * reynolds.disc_damping(R).onset_speed(5e-6, 1e6, OIL)
            start = reynolds.at_rest(film, 5e-6)
            state = reynolds.step_film(start, 5e-6 + speed * 1e-12, 1e-12)
            row.append(f"{state.force / exact - 1.0:.1e}")
            counts.append(str(state.iterations))
        rows.append([*row, ", ".join(counts)])
    return grid(["first opening", *(f"{n} cells" for n in SIZES), "Newton steps"], rows)


def cost() -> str:
    """Seconds of a solution and of steps on discs."""
    rows = []
    for n in (64, 128, 256, 512):
        face = reynolds.rasterise(DISC, n)
        film = reynolds.GridFilm(face=face, viscosity=OIL, drop=1e6)
        full = reynolds.GridFilm(face=face, viscosity=OIL)
        repeats = 8 if n < 512 else 2
        solved = best_of(lambda full=full: reynolds.solve_pressure(full, GAP, RATE), repeats)[1]
        rest = reynolds.at_rest(film, 5e-6)
        first = reynolds.step_film(rest, 5.1e-6, 5e-6)
        onset = best_of(lambda rest=rest: reynolds.step_film(rest, 5.1e-6, 5e-6), repeats)[1]
        second = reynolds.step_film(first, 5.2e-6, 5e-6)
        warm = best_of(lambda first=first: reynolds.step_film(first, 5.2e-6, 5e-6), repeats)[1]
        rows.append(
            [
                f"{n} x {n}",
                str(int(face.inside.sum())),
                f"{solved:.3f}",
                f"{onset:.3f} ({first.iterations})",
                f"{warm:.3f} ({second.iterations})",
            ]
        )
    heads = ["cells", "unknowns", "full film [s]", "first step [s] (Newton steps)", "next step"]
    return grid(heads, rows)


def holed_face(cells: int) -> Face:
    """A disc with a vent in its middle and three holes around it."""
    turns = (0.0, 2.0 * math.pi / 3.0, 4.0 * math.pi / 3.0)
    places = [(0.6 * R * math.cos(t), 0.6 * R * math.sin(t)) for t in turns]
    holes = [reynolds.Hole(shape=ck.Disc(radius=0.2 * R))]
    holes += [reynolds.Hole(shape=ck.Disc(radius=0.08 * R, centre=p)) for p in places]
    return reynolds.rasterise(DISC, cells, holes=holes)


def injector(planform: object) -> ck.SeparationScene:
    """Face of 20 g that is pulled off a film of 5 um with 40 N, and cavitates at 10 bar."""
    return ck.SeparationScene(
        interface=ck.Interface(
            upper=ck.Flat(planform=planform),
            meniscus=ck.Meniscus(liquid=ck.Liquid(name="oil", viscosity=OIL)),
        ),
        loading=ck.ImposedForce(initial_gap=5e-6, final_gap=25e-6, force=40.0, mass=0.02),
        effects=(
            ck.ViscousForce(),
            ck.TensionLimit(strength=1e6, cavity_pressure=101_325.0 - 1e6),
        ),
    )


def injector_disc() -> ck.SeparationResult:
    """The same of a disc, whose edge is exact."""
    return ck.simulate(ck.plan(injector(DISC)))


def native() -> str:
    """Release of a native FMU whose cavity is on a grid, against the exact edge."""
    exact = injector_disc().state.release_time
    notched = injector(DISC - ck.Disc(radius=1e-6, centre=(R, 0.0)))
    rows = []
    for rtol in (2e-3, 1e-3, 8e-4):
        with tempfile.TemporaryDirectory() as folder:
            made = build_native(
                notched, Path(folder) / "film.fmu", platforms=[local()], film_rtol=rtol
            )
            size = made.stat().st_size
            with Instance(made) as host:
                found, seconds = pulled(host)
        rows.append(
            [
                f"{rtol:g}",
                f"{found / exact - 1.0:.1e}",
                f"{sum(seconds):.2f}",
                f"{seconds[0]:.2f}",
                f"{1e3 * sorted(seconds)[len(seconds) // 2]:.1f}",
                f"{size / 1e3:.0f}",
            ]
        )
    heads = ["`film_rtol`", "release", "whole pull [s]", "first 10 us [s]"]
    return grid([*heads, "a later `doStep` of 10 us [ms]", "FMU [kB]"], rows)


def pulled(host: Instance) -> tuple[float, list[float]]:
    """Release time [s] at 40 N, and seconds of each step of 10 us until then."""
    release, time, seconds = host.references("t_release"), 0.0, []
    host.start({}, 1.0)
    host.set(host.references("F_ext"), [40.0])
    while host.get(release)[0] < 0.0:
        begun = process_time()
        host.step(time, 1e-5)
        seconds.append(process_time() - begun)
        time += 1e-5
    return host.get(release)[0], seconds


def pictures() -> None:
    """Draw the pictures of the page."""
    from contactkit.plot import film as film_plot

    film = reynolds.GridFilm(face=holed_face(128), viscosity=OIL, drop=1e6)
    period = 1e-3

    def gap(t: float) -> float:
        return 1.2e-5 - 4e-6 * math.cos(2.0 * math.pi * t / period)

    times = list(np.linspace(0.0, period, 101))
    states = list(reynolds.follow_gap(film, gap, times))
    shown = [states[i] for i in (3, 30, 60, 72)]
    film_plot.instants(shown).savefig(IMG / "film-instants.png")
    film_plot.animate(states[1:76:3], IMG / "film-opening.gif", rate=8.0)
    quarter = reynolds.rasterise(DISC, 64, window=(0.0, R, 0.0, R))
    film = reynolds.GridFilm(face=quarter, viscosity=OIL, drop=1e6)
    pulled = injector_disc()
    times, gaps = pulled["time"], pulled["gap"]
    steps = list(reynolds.follow_gap(film, lambda t: float(np.interp(t, times, gaps)), times))
    film_plot.opening(steps, copies=4)[0].figure.savefig(IMG / "film-pull.png")
    for name in ("film-instants", "film-pull"):
        picture = IMG / f"{name}.png"
        with Image.open(picture) as drawn:
            drawn.convert("P", palette=Image.Palette.ADAPTIVE, colors=128).save(picture)


TABLES = {"accuracy": accuracy, "cavity": cavity, "cost": cost, "native": native}

if __name__ == "__main__":
    warnings.simplefilter("ignore", ck.ValidityWarning)  # full films under any tension
    sys.exit(measure(TABLES, "films ", pictures))
