"""Communication steps of the injector and their errors: a block of docs/hosts.md.

A minute, and a C compiler. The reference shares no code with the FMUs: coil, spring and a film that
cavitates are written down again below and solved by `scipy.integrate.solve_ivp` (Radau, 1e-10).
Each coupling is a loop over the two native FMUs as `contactkit fmu system fuel-injector` connects
them.
"""

from __future__ import annotations

import math
import sys
import tempfile
from collections.abc import Callable, Mapping
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np
from scipy.integrate import solve_ivp
from scipy.interpolate import CubicSpline
from scipy.optimize import brentq

from contactkit import plan
from contactkit.app.scenes import open_scene
from contactkit.fmu.framework.instance import Instance
from contactkit.fmu.framework.toolchain import local
from contactkit.fmu.master.injector import cosimulate
from contactkit.fmu.native.build import build_native, native_scene
from contactkit.fmu.native.drive import build_native_drive
from contactkit.models.injector.monolithic import simulate as simulate_monolithic
from contactkit.models.injector.report.cosimulation import drive_start

MU0, US = 4e-7 * math.pi, 1e-6
FILM = ("m", "h0", "h_rel", "R", "eta", "dp_inception", "dp_hold")
COIL = ("R_coil", "N_turns", "A_pole", "g_air", "g_iron", "B_sat", "k_spring", "F_preload")
VOLTAGE = ("t_delay", "t_on", "U_boost", "t_boost", "U_hold")


def numbers() -> dict[str, float]:
    """Parameters of the shipped scene: of its film, and of its valve."""
    opened = open_scene("fuel-injector")
    values = {**opened.fmu_start().values, **drive_start(opened.scene.valve)}
    return {name: float(values[name]) for name in (*FILM, *COIL, *VOLTAGE)}


class Film:
    """A disc of liquid that cavitates; edges are squares of radii over that of the disc."""

    def __init__(self, p: Mapping[str, float]) -> None:
        self.eta, self.drop, self.square = p["eta"], p["dp_hold"], p["R"] ** 2
        self.strength = p["dp_inception"]

    def tension(self, gap: float, speed: float) -> float:
        """In the middle of the whole film [Pa]."""
        return 3.0 * self.eta * speed * self.square / gap**3

    def whole_force(self, gap: float, speed: float) -> float:
        """Mean tension, half of that in the middle, times the area [N]."""
        return 0.5 * math.pi * self.square * self.tension(gap, speed)

    def receding_edge(self, gap: float, speed: float) -> float:
        """Edge of the cavity while no liquid flows over it."""
        share = self.drop / self.tension(gap, speed)
        return brentq(lambda y: 1.0 - y + y * math.log(y) - share, 1e-300, 1.0, xtol=1e-16)

    def ring(self, gap: float, speed: float, y: float) -> tuple[float, float]:
        """Force [N], and growth of the void [m3/s], with the edge at `y`.

        The pressure in the ring is -drop + a (x - y) + b ln(x/y), with x the square of the radius.
        """
        a = self.tension(gap, speed)
        b = (self.drop - a * (1.0 - y)) / -math.log(y)
        area = math.pi * self.square
        mean = self.drop - a * 0.5 * (1.0 - y) ** 2 - b * (-math.log(y) - (1.0 - y))
        inflow = area * speed * (a + b) / a  # through the rim; a alone would fill the disc
        return area * mean, area * speed - inflow


class History:
    """Liquid that the edge has left behind, up to where it was at each time."""

    def __init__(self, film: Film, found: Any) -> None:
        times = np.linspace(found.t[0], found.t[-1], 4001)
        _, gaps, speeds = found.sol(times)
        edges = np.array([film.receding_edge(h, v) for h, v in zip(gaps, speeds, strict=True)])
        self.span = times[0], times[-1]
        self.edge, slope = CubicSpline(times, edges), CubicSpline(times, edges).derivative()
        self.liquid = CubicSpline(times, gaps * slope(times)).antiderivative()
        self.first = gaps[0] * edges[0]  # cavitated at once
        self.area = math.pi * film.square

    def void(self, time: float, gap: float) -> float:
        """Volume without liquid [m3] if the edge is where it was at a time."""
        return float(self.area * (gap * self.edge(time) - self.first - self.liquid(time)))

    def edge_of(self, void: float, gap: float) -> float:
        """Edge of a void [m3]."""
        begin, end = self.span
        if self.void(end, gap) <= void:
            return float(self.edge(end))
        return float(self.edge(brentq(lambda t: self.void(t, gap) - void, begin, end, xtol=1e-20)))


def _solve(rates: Callable[..., Any], begin: float, state: Any, jumps: Any, events: Any) -> Any:
    """Integrate over the jumps of the voltage to the first of the events; the last piece."""
    for event in events:
        event.terminal, event.direction = True, 1.0
    scale = [1e-13, 1e-16, 1e-9, 1e-24][: len(state)]
    for end in (t for t in jumps if t > begin):
        how = {"method": "Radau", "rtol": 1e-10, "atol": scale, "dense_output": True}
        found = solve_ivp(rates, (begin, end), state, events=events, **how)
        begin, state = float(found.t[-1]), found.y[:, -1]
        if found.status == 1:
            return found
    raise RuntimeError("none of the events came")


def reference_release(p: Mapping[str, float]) -> float:
    """Time of the first release [s], by equations written down for this script alone.

    The film cavitates where its tension reaches the strength. The edge of the cavity runs outwards
    without flow over it, then back over what it has left behind.
    """
    pole = MU0 * p["N_turns"] ** 2 * p["A_pole"]
    knee, film = p["N_turns"] * p["A_pole"] * p["B_sat"], Film(p)
    boosted = p["t_delay"] + p["t_boost"]
    jumps = boosted, p["t_delay"] + p["t_on"]

    def pull(flux: float, gap: float) -> float:
        return flux**2 / pole - p["F_preload"] - p["k_spring"] * gap

    def flux_rate(time: float, flux: float, gap: float) -> float:
        iron = p["g_iron"] * (1.0 + (flux / knee) ** 8)
        resists = p["R_coil"] * flux * (2.0 * (p["g_air"] - gap) + iron) / pole
        return (p["U_boost"] if time < boosted else p["U_hold"]) - resists

    def moved(time: float, y: Any, force: float) -> list[float]:
        return [flux_rate(time, y[0], y[1]), y[2], (pull(y[0], y[1]) - force) / p["m"]]

    def released(_: float, y: Any) -> float:
        return y[1] - p["h_rel"]

    def receding(time: float, y: Any) -> list[float]:
        edge = film.receding_edge(y[1], y[2])
        return moved(time, y, film.ring(y[1], y[2], edge)[0])

    def turns(time: float, y: Any) -> float:  # the edge follows h^3/v
        return 3.0 * y[2] ** 2 - y[1] * receding(time, y)[2]

    h0 = p["h0"]
    found = _solve(
        lambda t, y: [flux_rate(t, y[0], h0)],
        p["t_delay"],
        [0.0],
        jumps,
        [lambda t, y: pull(y[0], h0)],
    )
    begin = [found.y[0, -1], h0, 0.0]
    found = _solve(
        lambda t, y: moved(t, y, film.whole_force(y[1], y[2])),
        found.t[-1],
        begin,
        jumps,
        [lambda _, y: film.tension(y[1], y[2]) - film.strength],
    )
    found = _solve(receding, found.t[-1], found.y[:, -1], jumps, [released, turns])
    if len(found.t_events[0]):
        return float(found.t[-1])
    history = History(film, found)

    def returning(time: float, y: Any) -> list[float]:
        force, growth = film.ring(y[1], y[2], history.edge_of(y[3], y[1]))
        return [*moved(time, y, force), growth]

    void = history.void(history.span[1], found.y[1, -1])
    found = _solve(returning, found.t[-1], [*found.y[:, -1], void], jumps, [released])
    return float(found.t[-1])


@cache
def fmus() -> tuple[Path, Path]:
    """Native drive and film of the scene, as the command builds them."""
    folder = Path(tempfile.mkdtemp(prefix="contactkit-"))
    opened = open_scene("fuel-injector")
    film, start = native_scene(opened, "stiction-mass")
    one = {"platforms": [local()], "compiler": "cc"}
    mass = build_native(film, folder / "mass.fmu", start=start, **one)
    valve = drive_start(opened.scene.valve)
    return build_native_drive(folder / "drive.fmu", start=valve, **one), mass


def coupled_release(step: float, order: str) -> float:
    """Time of the first release [s]; nan if there is none within 4 ms.

    ``parallel``: both step with what the other had before; ``film`` and ``drive``: the one named
    steps first, and the other gets what it has then.
    """
    with Instance(fmus()[0]) as drive, Instance(fmus()[1]) as mass:
        for one in (drive, mass):
            one.start({}, 4e-3)
        pull, motion = drive.references("F_ext", "dF_ext"), mass.references("h", "v")
        given, taken = mass.references("F_ext", "dF_ext"), drive.references("h", "v")
        release = mass.references("t_release")
        for k in range(round(4e-3 / step)):
            time = k * step
            forces, moves = drive.get(pull), mass.get(motion)
            if order != "film":
                drive.set(taken, moves)
                drive.step(time, step)
                forces = drive.get(pull) if order == "drive" else forces
            mass.set(given, forces)
            mass.step(time, step)
            if order == "film":
                drive.set(taken, mass.get(motion))
                drive.step(time, step)
            if mass.get(release)[0] > 0.0:
                return float(mass.get(release)[0])
    return math.nan


def master_release(step: float | None, tolerance: float | None = None) -> float:
    """Time of the first release [s] by `cosimulate`."""
    found = cosimulate(*fmus(), 4e-3, step, tolerance=tolerance)
    return float(found["t_release"][-1])


@cache
def reference() -> float:
    """Time of the first release [s]; says what `monolithic` gives, which is to be the same."""
    time = reference_release(numbers())
    scene = open_scene("fuel-injector").scene
    film = plan(scene.separation(scene.temperature))
    whole = simulate_monolithic(film, scene.valve, 4e-3, rtol=1e-10, until_release=True)
    own = next(event.time for event in whole.events if event.what == "released")
    sys.stderr.write(f"reference {time:.12g} s, monolithic {own:.12g} s\n")
    return time


@cache
def releases() -> dict[str, tuple[float, ...]]:
    """Times of the first release [s] at steps of 1, 5 and 100 us, by coupling."""
    short = (1 * US, 5 * US)
    found = {"linear": tuple(master_release(step) for step in short)}
    for order in ("parallel", "film", "drive"):
        found[order] = tuple(coupled_release(step, order) for step in (*short, 100 * US))
    found["adaptive"] = (master_release(None, tolerance=1e-4),)
    return found


def _error(time: float) -> str:
    if math.isnan(time):
        return "never released"
    return f"{time / reference() - 1.0:.1e}".replace("e-0", "e-")


def hosts() -> str:
    """Error of the first release of the injector, by coupling and communication step."""
    cells = {name: [_error(time) for time in times] for name, times in releases().items()}
    cells["linear"].append("refused: the end stop needs less than 28 µs")
    rows = {
        "linear": "`contactkit.fmu.master.injector`, pull linear in each step",
        "parallel": "both FMUs in parallel, as fmpy, Ecos, libcosim and a container step them",
        "film": "film first, as a container with `-sequential`",
        "drive": "drive first, as a container with `-sequential`",
    }
    head = ["| coupling | 1 µs | 5 µs | 100 µs |", "|---|---|---|---|"]
    lines = [f"| {text} | {' | '.join(cells[name])} |" for name, text in rows.items()]
    after = (
        f"Release of the reference at {1e3 * reference():.6f} ms. With adaptive steps "
        f"(`tolerance=1e-4`) the error is {cells['adaptive'][0]}."
    )
    return "\n".join([*head, *lines, "", after])
