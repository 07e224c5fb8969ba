"""Accuracy of films on grids: full films, first openings of cavities, and a native FMU.

Errors are of the force against closed forms, over the cells along the longer side.
"""

from __future__ import annotations

import math
import tempfile
from collections.abc import Callable
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np

from ..fmu.framework.instance import Instance
from ..fmu.framework.toolchain import local
from ..fmu.native.build import build_native
from ..liquids.liquid import Liquid
from ..lubrication.disc_cavity import film_ring, receding_edge
from ..lubrication.reynolds import damping
from ..lubrication.reynolds.face import Hole, Pocket, face_from_mask, rasterise
from ..lubrication.reynolds.film import GridFilm
from ..lubrication.reynolds.gaps import gap_map
from ..lubrication.reynolds.solve import at_rest, solve_pressure, step_film
from ..scene.faces import Recess
from ..scene.interface import Interface
from ..scene.loading import ImposedForce
from ..scene.meniscus import Meniscus
from ..scene.planforms import Disc, Ellipse, Rectangle, Ring, equilateral_triangle
from ..scene.scenes import SeparationScene
from ..scene.surfaces import Flat
from ..separation.effects.viscous import TensionLimit, ViscousForce
from ..separation.plan import plan
from ..separation.simulate import simulate
from ..work_precision import Point
from .timing import timed

__all__ = ["cavities", "native", "planforms"]

_R, _OIL, _GAP, _RATE = 3.175e-3, 0.1, 1e-5, 1e-3  # [m], [Pa.s], [m], [m/s]
_SIDE, _DOME = 4e-3, 1.0  # of the square, and radius of curvature [m]
_CELLS = (64, 128, 256)  # two halvings show the order; 512 would take a minute in all
_DISC = Disc(radius=_R)

Made = Callable[[int], tuple[Any, Any]]  # face and gap on a number of cells


def _even(shape: Any, *holes: Any) -> Made:
    return lambda n: (rasterise(shape, n, holes=holes), _GAP)


def _masked(n: int) -> tuple[Any, Any]:
    face = rasterise(_DISC, n)
    return face_from_mask(face.inside, face.pixel_size), _GAP


def _mapped(n: int, **shape: Any) -> tuple[Any, Any]:
    face = rasterise(_DISC, n)
    return face, gap_map(face, _GAP, **shape)


def _faces() -> dict[str, tuple[Made, Any]]:
    """Faces and their laws in closed form."""
    small = Hole(shape=Disc(radius=0.01 * _R))
    pocket = Pocket(shape=Disc(radius=0.5 * _R))
    recess = [Recess(shape=Disc(radius=1.5e-3), depth=3.0 * _GAP)]
    ring = Ring(radius=_R, hole_radius=0.3 * _R)
    half = _R / 1.5
    return {
        "disc": (_even(_DISC), damping.disc_damping(_R)),
        "disc, from a mask": (_masked, damping.disc_damping(_R)),
        "ring, hole 0.3 R vented": (_even(ring), damping.ring_damping(_R, 0.3 * _R)),
        "ring, hole 0.01 R vented": (_even(_DISC, small), damping.ring_damping(_R, 0.01 * _R)),
        "ring, hole 0.5 R sealed": (
            _even(_DISC, pocket),
            damping.ring_damping(_R, 0.5 * _R, is_sealed=True),
        ),
        "square": (
            _even(Rectangle(length=_SIDE, width=_SIDE)),
            damping.rectangle_damping(_SIDE, _SIDE),
        ),
        "rectangle 2:1": (
            _even(Rectangle(length=2 * _SIDE, width=_SIDE)),
            damping.rectangle_damping(2 * _SIDE, _SIDE),
        ),
        "ellipse 1.5:1": (
            _even(Ellipse(semi_axes=(_R, half))),
            damping.ellipse_damping((_R, half)),
        ),
        "equilateral triangle": (
            _even(equilateral_triangle(_SIDE)),
            damping.triangle_damping(_SIDE),
        ),
        "disc under a dome": (
            partial(_mapped, dome_radius=_DOME),
            damping.dome_damping(_R, _DOME),
        ),
        "disc with a recess of 3 h": (
            partial(_mapped, recesses=recess),
            damping.recess_damping(_R, 1.5e-3, 3.0 * _GAP),
        ),
    }


def planforms() -> list[Point]:
    """Force of full films over the cells; seconds of the solution on a face that is made."""
    points = []
    for name, (made, law) in _faces().items():
        exact = law.force(_GAP, _RATE, _OIL)
        for n in _CELLS:
            face, gap = made(n)
            film = GridFilm(face=face, viscosity=_OIL)
            solve = partial(solve_pressure, film, gap, _RATE)
            found, seconds = timed(solve, 0.3)
            counts = {"unknowns": int(face.inside.sum())}
            error = abs(found.force / exact - 1.0)
            points.append(Point(name, f"{n} cells", error, seconds, counts))
    return points


def cavities() -> list[Point]:
    """Force of a disc that opens at a multiple of the speed at which it cavitates."""
    points, gap, drop = [], 5e-6, 1e6
    for sigma in (1.5, 3.0, 30.0, 300.0):
        speed = sigma * damping.disc_damping(_R).onset_speed(gap, drop, _OIL)
        conductance = gap**3 / (12.0 * _OIL)
        exact = film_ring(receding_edge(sigma), _R**2, conductance, drop, speed).force
        for n in _CELLS:
            film = GridFilm(face=rasterise(_DISC, n), viscosity=_OIL, drop=drop)
            rest = at_rest(film, gap)
            step = partial(step_film, rest, gap + speed * 1e-12, 1e-12)
            state, seconds = timed(step, 0.3)
            method, counts = f"{sigma:g} times the onset", {"Newton steps": state.iterations}
            error = abs(state.force / exact - 1.0)
            points.append(Point(method, f"{n} cells", error, seconds, counts))
    return points


def _pulled_face(planform: Any) -> SeparationScene:
    """Face of 20 g that is pulled off a film of 5 um with 40 N, and cavitates at 10 bar."""
    return SeparationScene(
        interface=Interface(
            upper=Flat(planform=planform),
            meniscus=Meniscus(liquid=Liquid(name="oil", viscosity=_OIL)),
        ),
        loading=ImposedForce(initial_gap=5e-6, final_gap=25e-6, force=40.0, mass=0.02),
        effects=(ViscousForce(), TensionLimit(strength=1e6, cavity_pressure=101_325.0 - 1e6)),
    )


def native() -> list[Point]:
    """Release of a native FMU whose cavity is on a grid, against the exact edge of a disc."""
    state = simulate(plan(_pulled_face(_DISC))).state
    assert state is not None
    notched = _pulled_face(_DISC - Disc(radius=1e-6, centre=(_R, 0.0)))
    points = []
    for rtol in (2e-3, 1e-3, 8e-4):
        with tempfile.TemporaryDirectory(prefix="contactkit-") as folder:
            target = Path(folder) / "film.fmu"
            made = build_native(notched, target, platforms=[local()], film_rtol=rtol)
            size = made.stat().st_size
            with Instance(made) as host:
                found, seconds = timed(partial(_released, host), 0.0)
        counts = {"steps of 10 us": round(found / 1e-5), "kB of the FMU": round(size / 1e3)}
        error = abs(found / state.release_time - 1.0)
        points.append(Point("native FMU", f"film_rtol {rtol:g}", error, seconds, counts))
    return points


def _released(host: Instance) -> float:
    """Release time [s] at 40 N, in steps of 10 us."""
    release = host.references("t_release")
    host.start({}, 1.0)
    host.set(host.references("F_ext"), [40.0])
    for time in np.arange(0.0, 1.0, 1e-5):
        host.step(float(time), 1e-5)
        found = host.get(release)[0]
        if found >= 0.0:
            return float(found)
    return math.nan
