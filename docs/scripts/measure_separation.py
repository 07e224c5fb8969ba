"""Meniscus laws and FMUs on docs/accuracy.md: ``measure_separation.py [NAME ...] --write``.

Half a minute.
"""

from __future__ import annotations

import math
import sys
import tempfile
import time
import warnings
from collections.abc import Callable, Mapping
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np
from attrs import evolve
from measured_blocks import measure

import contactkit as ck
from contactkit.benchmarks.releases import release_cases
from contactkit.benchmarks.timing import best_of, cpu_seconds
from contactkit.capillary.exact import pressure_branch as bridge_film
from contactkit.capillary.exact import stability as bridge_limit
from contactkit.capillary.exact.bridge import bridge, bridge_at_pressure
from contactkit.capillary.flats import family as flat_family
from contactkit.capillary.flats import force_law as flat_law
from contactkit.fmu.framework.instance import Instance
from contactkit.fmu.python.build import build
from contactkit.fmu.slaves.stiction_mass import MeniscusLaw

CASES = release_cases()


@cache
def stiction_mass() -> Path:
    """The FMU, built once."""
    folder = Path(tempfile.mkdtemp(prefix="contactkit-"))
    return build("stiction-mass", folder / "stiction-mass.fmu")


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


def fmu_table() -> str:
    """Relative error of the release time that the FMU finds, over communication steps."""
    fmu, counts = stiction_mass(), (1, 10, 100, 1000, 10000)
    head = " | ".join(f"{n} steps" if n > 1 else "1 step" for n in counts)
    lines = [f"| case | {head} |", "|---" * (len(counts) + 1) + "|"]
    for name, entry in CASES.items():
        wanted = entry["values"]["t_rel"]
        found = [fmu_release(fmu, entry["case"], 1.2 * wanted, n) for n in counts]
        cells = [f"{abs(t / wanted - 1.0):.0e}" if t > 0.0 else "no release" for t in found]
        lines.append(f"| {name} | {' | '.join(cells)} |")
    return "\n".join(lines)


def step_cost() -> str:
    """Time of one exchange (set two inputs, doStep, get two outputs), by state of the film."""
    fmu = stiction_mass()
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
                begun = time.process_time()
                one.set(inputs, [force, 0.0])
                one.step(at, length)
                one.get(motion)
                seconds.append(time.process_time() - begun)
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
    pressure = meniscus.pressure_at(scene.temperature)
    shape = (
        meniscus.contact_angle_lower,
        meniscus.contact_angle_upper,
        *interface.curvatures,
    )
    if pressure is not None:
        return tension * bridge_at_pressure(gaps, pressure / tension, *shape).force
    return tension * bridge(gaps, meniscus.volume, *shape).force


def _law_row(name: str, scene: ck.SeparationScene, profile: str) -> str:
    """One film by one profile: CPU seconds to make its law and to call it, and its error."""
    one = evolve(scene, effects=(ck.MeniscusForce(profile=profile),))

    def make() -> Any:
        _clear_caches()
        return ck.plan(one)

    made = best_of(make)[1]
    law = ck.plan(one).film.laws[ck.MeniscusForce]
    gaps = np.geomspace(5e-10, 0.999 * min(law.end, 1e-7), 200)
    listed = gaps.tolist()
    called = cpu_seconds(lambda: [law.force(gap, 0.0) for gap in listed]) / len(gaps)
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
        at_pressure = scene.interface.meniscus.has_pressure
        profiles = ("exact",) if at_pressure else ("exact", "arc")
        lines += [_law_row(name, scene, profile) for profile in profiles]
    return "\n".join(lines)


TABLES: Mapping[str, Callable[[], str]] = {
    "laws": law_table,
    "fmu": fmu_table,
    "exchange": step_cost,
}

if __name__ == "__main__":
    warnings.simplefilter("ignore", ck.ValidityWarning)
    sys.exit(measure(TABLES, "separation "))
