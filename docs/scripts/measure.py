"""Measure the numbers of the separation on docs/accuracy.md and docs/injector.md, and print them.

Run it as ``python docs/scripts/measure.py``; it takes about half a minute and writes nothing.
"""

from __future__ import annotations

import json
import math
import sys
import tempfile
import time
import warnings
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any

import numpy as np
from attrs import evolve

import contactkit as ck
from contactkit.app.scenes import open_scene
from contactkit.capillary.exact import pressure_branch as bridge_film
from contactkit.capillary.exact import stability as bridge_limit
from contactkit.capillary.exact.bridge import bridge, bridge_at_pressure
from contactkit.capillary.flats import family as flat_family
from contactkit.capillary.flats import force_law as flat_law
from contactkit.fmu.framework.instance import Instance
from contactkit.fmu.python.build import build
from contactkit.fmu.slaves.stiction_mass import MeniscusLaw
from contactkit.models.injector.delays import delay, dry_delay
from contactkit.models.injector.monolithic import simulate as simulate_monolithic
from contactkit.models.injector.scene import InjectorScene
from contactkit.units import celsius

CASES = json.loads(
    (Path(__file__).parents[2] / "tests" / "data" / "release.json").read_text("utf-8")
)
TOLERANCES = (1e-4, 1e-6, 1e-8, 1e-10)


def scene(case: dict[str, Any]) -> ck.SeparationScene:
    """Scene of a release case."""
    oil = ck.Liquid(name="oil", viscosity=case["eta"], surface_tension=case["gamma"])
    face, theta = ck.Flat(radius=case["R"]), case["theta"]
    film = ck.Meniscus(
        liquid=oil,
        volume=case["V"] or None,
        contact_angle_lower=theta,
        contact_angle_upper=theta,
    )
    loading = ck.ImposedForce(
        initial_gap=case["h0"],
        final_gap=case["h_rel"],
        force=case["F0"],
        mass=case["m"],
        stiffness=case["k_s"],
        rise_time=case["tau"],
    )
    limit = (
        (ck.TensionLimit(strength=case["dp_cav"], cavity="truncated"),) if case["dp_cav"] else ()
    )
    return ck.SeparationScene(
        interface=ck.Interface(lower=face, upper=face, meniscus=film),
        loading=loading,
        effects=(
            ck.MeniscusForce(profile=ck.AsPublished(radius="disc")),
            ck.ViscousForce(),
            *limit,
        ),
    )


def best_of(run: Callable[[], Any], repeats: int = 5) -> tuple[Any, float]:
    """Result of a run, and the best of its times [s]."""
    found, seconds = run(), math.inf
    for _ in range(repeats):
        begun = time.perf_counter()
        run()
        seconds = min(seconds, time.perf_counter() - begun)
    return found, seconds


def release_table() -> str:
    """Relative error of the release time, over the tolerance of a step of time."""
    lines = [
        "| case | tolerance | error of the release time | steps | time [ms] |",
        "|---|---|---|---|---|",
    ]
    for name, entry in CASES.items():
        for rtol in TOLERANCES:
            made = ck.plan(scene(entry["case"]), ck.Accuracy(time_rtol=rtol))
            result, seconds = best_of(lambda made=made: ck.simulate(made))
            error = abs(result.state.release_time / entry["values"]["t_rel"] - 1.0)
            steps = result.work.n_steps
            lines.append(f"| {name} | {rtol:.0e} | {error:.0e} | {steps} | {seconds * 1e3:.1f} |")
    return "\n".join(lines)


def fmu_values(case: dict[str, Any]) -> dict[str, float]:
    """Start values of ``stiction-mass`` for a release case."""
    same = ("h0", "R", "eta", "gamma", "V", "m", "k_s", "h_rel", "dp_cav", "tau_lim")
    values = {name: case[name] for name in same}
    law = {"meniscus_law": MeniscusLaw.PUBLISHED, "theta1": case["theta"], "theta2": case["theta"]}
    return values | law


def fmu_release(fmu: Path, case: dict[str, Any], stop: float, n: int) -> float:
    """Release time [s] that the FMU finds in n steps; -1 if none. A straight pull in each."""

    def pull(at: float) -> float:
        return case["F0"] * (-math.expm1(-at / case["tau"]) if case["tau"] else 1.0)

    with Instance(fmu) as one:
        one.start(fmu_values(case), stop)
        inputs, length = one.references("F_ext", "dF_ext"), stop / n
        for i in range(n):
            begin, end = pull(i * length), pull((i + 1) * length)
            one.set(inputs, [begin, (end - begin) / length])
            one.step(i * length, length)
        return one.get(one.references("t_release"))[0]


def fmu_table(fmu: Path, counts: Sequence[int] = (1, 10, 100, 1000, 10000)) -> str:
    """Relative error of the release time that the FMU finds, over communication steps."""
    head = " | ".join(f"{n} steps" if n > 1 else "1 step" for n in counts)
    lines = [f"| case | {head} |", "|---" * (len(counts) + 1) + "|"]
    for name, entry in CASES.items():
        wanted = entry["values"]["t_rel"]
        found = [fmu_release(fmu, entry["case"], 1.2 * wanted, n) for n in counts]
        cells = [f"{abs(t / wanted - 1.0):.0e}" if t > 0.0 else "no release" for t in found]
        lines.append(f"| {name} | {' | '.join(cells)} |")
    return "\n".join(lines)


def step_cost(fmu: Path) -> str:
    """Time of one exchange (set two inputs, doStep, get two outputs), by state of the film."""
    lines = ["| state of the film | set 2, doStep, get 2 [us] |", "|---|---|"]
    base = fmu_values(CASES["B"]["case"])
    # h0 just below h_break: the film breaks in the first steps, then the mass moves freely.
    cases = {
        "film acts, step 5 us, pull 40 N": ({}, 40.0, 5e-6, 1000),
        "film and tension limit act, step 0.5 us, pull 40 N": ({"dp_cav": 1e6}, 40.0, 5e-7, 1000),
        "broken, free motion of the mass": ({"h_break": 5.01e-6, "dp_cav": 1e4}, 40.0, 5e-6, 1000),
        "at rest on asperities": ({"h_min": 5e-6}, -1.0, 5e-6, 1000),
    }
    for label, (more, force, length, n) in cases.items():
        with Instance(fmu) as one:
            one.start(base | more, 1.0)
            inputs, motion = one.references("F_ext", "dF_ext"), one.references("h", "v")
            at, seconds = 0.0, []
            for _ in range(n):
                begun = time.perf_counter()
                one.set(inputs, [force, 0.0])
                one.step(at, length)
                one.get(motion)
                seconds.append(time.perf_counter() - begun)
                at += length
        lines.append(f"| {label} | {sorted(seconds)[n // 2] * 1e6:.0f} |")
    return "\n".join(lines)


def _clear_caches() -> None:
    """Clear the caches of bridges, so that a plan is made as in a fresh process."""
    for module in (flat_law, flat_family, bridge_limit, bridge_film):
        for made in vars(module).values():
            if hasattr(made, "cache_clear"):
                made.cache_clear()


def meniscus_scenes() -> dict[str, ck.SeparationScene]:
    """Two films and two bridges on a sphere, each with the meniscus force alone."""
    water, angles = ck.load_liquid("water"), (math.radians(60.0),) * 2
    wets = dict(zip(("contact_angle_lower", "contact_angle_upper"), angles, strict=True))
    face, tip = ck.Flat(radius=1e-6), ck.Sphere(radius=1e-7)
    free = ck.Meniscus(liquid=water, volume=2e-21, **wets)
    small = ck.Meniscus(liquid=water, volume=1e-24, **wets)
    moist = ck.Meniscus(liquid=water, relative_humidity=0.5, **wets)
    bodies = {
        "flats, free": ck.Interface(meniscus=free),
        "flats, first up to the rim": ck.Interface(
            lower=face, upper=face, meniscus=evolve(free, volume=1e-20)
        ),
        "sphere, volume": ck.Interface(upper=tip, meniscus=small),
        "sphere, humidity of 50 %": ck.Interface(upper=tip, meniscus=moist),
    }
    loading = ck.ImposedSpeed(initial_gap=5e-10, final_gap=1e-7, speed=1e-6)
    exact = (ck.MeniscusForce(),)
    return {
        name: ck.SeparationScene(interface=one, loading=loading, effects=exact)
        for name, one in bodies.items()
    }


def _solved(scene: ck.SeparationScene, gaps: Any) -> Any:
    """Exact forces [N] at gaps [m] by solving each of the bridges, of one free meniscus."""
    interface, meniscus = scene.interface, scene.interface.meniscus
    tension = meniscus.liquid.at(scene.temperature).surface_tension
    assert tension is not None
    shape = (
        meniscus.contact_angle_lower,
        meniscus.contact_angle_upper,
        interface.lower.curvature,
        interface.upper.curvature,
    )
    if meniscus.pressure is not None:
        return tension * bridge_at_pressure(gaps, meniscus.pressure / tension, *shape).force
    return tension * bridge(gaps, meniscus.volume, *shape).force


def _cpu_seconds(run: Callable[[], Any], repeats: int = 3) -> float:
    """Least CPU time of a run [s]."""
    best = math.inf
    for _ in range(repeats):
        begun = time.process_time()
        run()
        best = min(best, time.process_time() - begun)
    return best


def _law_row(name: str, scene: ck.SeparationScene, profile: str) -> str:
    """One film by one profile: CPU seconds to make its law and to call it, and its error."""
    one = evolve(scene, effects=(ck.MeniscusForce(profile=profile),))

    def make() -> Any:
        _clear_caches()
        return ck.plan(one)

    made = _cpu_seconds(make)
    law = ck.plan(one).film.laws[ck.MeniscusForce]
    gaps = np.geomspace(5e-10, 0.999 * min(law.end, 1e-7), 200)
    listed = gaps.tolist()
    called = _cpu_seconds(lambda: [law.force(gap, 0.0) for gap in listed], 20) / len(gaps)
    error = "-"
    if profile == "exact" and not law.kinks:
        found = np.array([law.force(gap, 0.0) for gap in listed])
        error = f"{np.max(np.abs(found / _solved(scene, gaps) - 1.0)):.0e}"
    return f"| {name} | {profile} | {made:.2g} | {called * 1e6:.1f} | {error} |"


def law_table() -> str:
    """Cost of the meniscus force in the loop, and its error against bridges solved one by one."""
    lines = [
        "| film | profile | set-up [s] | one evaluation [us] | error |",
        "|---|---|---|---|---|",
    ]
    for name, scene in meniscus_scenes().items():
        at_pressure = scene.interface.meniscus.pressure is not None
        profiles = ("exact",) if at_pressure else ("exact", "arc")
        lines += [_law_row(name, scene, profile) for profile in profiles]
    return "\n".join(lines)


def _milliseconds(delay: float) -> str:
    return "never" if math.isnan(delay) else f"{delay * 1e3:.3f}"


def _grid(head: Sequence[str], rows: Sequence[Sequence[str]]) -> str:
    lines = [f"| {' | '.join(line)} |" for line in (head, *rows)]
    return "\n".join([lines[0], "|---" * len(head) + "|", *lines[1:]])


def _degrees(injector: InjectorScene) -> list[str]:
    return [f"{t - celsius(0.0):.0f} degC [ms]" for t in injector.study.temperatures]


def headline_table() -> str:
    """Release delay of the injector for each thing that its oil may do."""
    injector = open_scene("fuel-injector").scene
    oils = {
        "cavitates at 10 bar, cavity at 0 bar (vapour)": {},
        "cavitates at 10 bar, cavity at -4 bar": {"cavity_pressure": -4e5},
        "cavitates at 10 bar and goes on to sustain it": {"cavity_pressure": -math.inf},
        "never cavitates": {"cavitates": False},
    }
    rows = [
        [
            name,
            *(_milliseconds(delay(injector, t, **oil)) for t in injector.study.temperatures),
        ]
        for name, oil in oils.items()
    ]
    dry = _milliseconds(dry_delay(injector))
    return _grid(["oil", *_degrees(injector)], [*rows, ["no film (dry)", dry, dry, dry]])


def strength_table() -> str:
    """Release delay over the strength: cavities of vapour, and oils that sustain their strength."""
    injector = open_scene("fuel-injector").scene
    rows = []
    for strength in (1.02, 3.0, 5.0, 10.0, 12.0, 13.0, 15.0, 20.0, 24.0, 25.5, 26.0, 28.0):
        cells = [
            _milliseconds(delay(injector, t, strength=strength * 1e5, cavity_pressure=pressure))
            for pressure in (0.0, -math.inf)
            for t in injector.study.temperatures
        ]
        rows.append([f"{strength:g} bar", *cells])
    degrees = [f"{t - celsius(0.0):.0f} degC" for t in injector.study.temperatures]
    head = [f"{oil}, {one} [ms]" for oil in ("vapour", "sustains it") for one in degrees]
    return _grid(["strength", *head], rows)


def cavity_table() -> str:
    """Release delay over the pressure in the cavity, of an oil that cavitates at 10 bar."""
    injector = open_scene("fuel-injector").scene
    rows = [
        [
            f"{pressure:g} bar",
            *(
                _milliseconds(delay(injector, t, cavity_pressure=pressure * 1e5))
                for t in injector.study.temperatures
            ),
        ]
        for pressure in (0.9, 0.5, 0.0, -1.0, -2.0, -4.0, -6.0, -8.0, -8.98675)
    ]
    return _grid(["cavity", *_degrees(injector)], rows)


def closing_table() -> str:
    """Distance from the end cap at which the spool is at the end of each cycle."""
    injector = open_scene("fuel-injector").scene
    profile, rest = injector.valve.profile, injector.loading.rest_gap
    ends = [profile.start_delay + (n + 1) * profile.period for n in range(profile.cycles)]
    head = [f"after cycle {n + 1} [um]" for n in range(len(ends))]
    rows = []
    for name, pressure in (("vapour", 0.0), ("sustains it", -math.inf)):
        for temperature in injector.study.temperatures:
            made = ck.plan(injector.separation(temperature, cavity_pressure=pressure))
            found = simulate_monolithic(made, injector.valve, ends[-1], rtol=1e-6, times=ends)
            short = [f"{(gap - rest) * 1e6:.2f}" for gap in found.columns["gap"]]
            rows.append([f"{name}, {temperature - celsius(0.0):.0f} degC", *short])
    return _grid(["cavity, temperature", *head], rows)


def refilling_table() -> str:
    """Time in which a cavity of 0.95 of the face fills while the spool rests at the stop.

    ``3 eta R^2 (h - h_b)/(h^3 dp) x^2 (1 - 2 ln x)``, cavitated at h_b = 6 um.
    """
    injector = open_scene("fuel-injector").scene
    rim, gap, cavitated, x = injector.interface.rim_radius, injector.valve.stop.gap, 6e-6, 0.95
    rows = []
    for temperature in injector.study.temperatures:
        viscosity = injector.interface.meniscus.liquid.at(temperature).viscosity
        times = [
            3.0
            * viscosity
            * rim**2
            * (gap - cavitated)
            / (gap**3 * drop)
            * x
            * x
            * (1.0 - 2.0 * math.log(x))
            for drop in (101325.0, 1e6)
        ]
        degrees = f"{temperature - celsius(0.0):.0f} degC"
        rows.append([degrees, f"{viscosity:.3g}", *(f"{time * 1e3:.3g}" for time in times)])
    head = ["temperature", "viscosity [Pa.s]", "cavity of vapour [ms]", "sustains 10 bar [ms]"]
    return _grid(head, rows)


def main() -> int:
    """Print every table."""
    warnings.simplefilter("ignore", ck.ValidityWarning)
    tables: list[tuple[str, Callable[[], str]]] = [
        ("release cases, Python", release_table),
        ("meniscus force as a law of the gap", law_table),
        ("injector: release delay", headline_table),
        ("injector: release delay over the strength", strength_table),
        ("injector: release delay over the pressure in the cavity", cavity_table),
        ("injector: how far off the end cap the spool is after each cycle", closing_table),
        ("injector: time in which a cavity fills at the stop", refilling_table),
    ]
    with tempfile.TemporaryDirectory(prefix="contactkit-") as folder:
        fmu = build("stiction-mass", Path(folder) / "stiction-mass.fmu")
        tables[1:1] = [
            ("release cases, FMU, tolerance 1e-8", lambda: fmu_table(fmu)),
            ("cost of a communication step", lambda: step_cost(fmu)),
        ]
        for title, table in tables:
            sys.stdout.write(f"{title}\n\n{table()}\n\n")
    return 0


if __name__ == "__main__":
    sys.exit(main())
