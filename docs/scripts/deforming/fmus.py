"""Exactness of FMUs of deforming bodies: `python docs/scripts/deforming/fmus.py --write`."""

from __future__ import annotations

import math
import sys
import tempfile
import time
from itertools import pairwise
from pathlib import Path

import numpy as np

import contactkit as ck
from contactkit.fmu.framework.instance import Instance
from contactkit.fmu.framework.toolchain import local
from contactkit.fmu.native.build import build_native
from contactkit.fmu.native.deforming import exactness_of

sys.path.insert(0, str(Path(__file__).parents[1]))

from measured_blocks import measure

RADIUS, GAP, VISCOSITY, SPEED = 5e-3, 1e-6, 0.1, 1e-5
STEPS = 100  # of the host, in a pull
ROWS = (
    *((1e-3, None), (0.01, None), (0.02, None), (0.02, 3.4e-3)),
    *((beta, rtol) for beta in (0.1, 1.0, 10.0) for rtol in (7e-3, 3.4e-3, 1.3e-3)),
)
"""beta of a pull, and the error of the film on rings that is asked for."""


def pull(beta: float) -> ck.SeparationScene:
    """Return a sphere that is pulled off a soft flat, flooded to 8 widths of its pressure."""
    modulus = VISCOSITY * SPEED * RADIUS**1.5 / (beta * GAP**2.5)
    soft = ck.Material(name="soft", young_modulus=0.75 * modulus, poisson_ratio=0.5)
    face = ck.Flat(radius=8.0 * math.sqrt(RADIUS * GAP))
    end = GAP * (3.0 if beta < 0.1 else 4.0 if beta < 1.0 else 6.0 if beta < 5.0 else 12.0)
    return ck.SeparationScene(
        interface=ck.Interface(
            lower=ck.Body(surface=face, solid=soft),
            upper=ck.Sphere(radius=RADIUS),
            meniscus=ck.Meniscus(liquid=ck.Liquid(name="oil", viscosity=VISCOSITY)),
        ),
        # A beta that is the bound itself is meant to be below it.
        loading=ck.ImposedSpeed(speed=SPEED * (1.0 - 1e-6), initial_gap=GAP, final_gap=end),
        effects=(ck.ElasticBodies(), ck.ViscousForce()),
    )


def forces(fmu: Path, times: np.ndarray) -> tuple[np.ndarray, float]:
    """Forces of an FMU [N], and its seconds of CPU for each step of the host."""
    with Instance(fmu) as one:
        one.start({}, float(times[-1]))
        inputs, output, found = one.references("h", "v"), one.references("F"), []
        begun = time.process_time()
        for begin, end in pairwise(times):
            one.set(inputs, [GAP + SPEED * end, SPEED])
            one.step(begin, end - begin)
            found.append(one.get(output)[0])
        return np.array(found), (time.process_time() - begun) / len(found)


def exactness() -> str:
    """Return errors over the largest force, against the engine extrapolated to 192 rings."""
    rows = [
        "| $\\beta$, film | largest force | any time | CPU of a step [ms] |",
        "|---|---|---|---|",
    ]
    for beta, rtol in ROWS:
        scene = pull(beta)
        stated = exactness_of(scene, rtol)
        found = ck.simulate(ck.plan(scene, ck.Accuracy(film_rtol=4e-6)))
        times = np.linspace(0.0, float(found["time"][-1]), STEPS + 1)
        with tempfile.TemporaryDirectory(prefix="contactkit-") as folder:
            more = {"platforms": [local()], "film_rtol": rtol}
            fmu = build_native(scene, Path(folder) / "film.fmu", model="stiction-force", **more)
            _, cost = forces(fmu, times)
            own, _ = forces(fmu, np.array(found["time"]))
        largest = float(found["pull"].max())
        error = np.abs(own - found["pull"][1:]) / largest
        film = "spring" if stated.film == "series" else f"{stated.rings} rings"
        rows.append(
            f"| {beta:g}, {film} | {abs(own.max() / largest - 1.0):.1e} "
            f"| {error.max():.1e} | {1e3 * cost:.2g} |"
        )
    return "\n".join(rows)


if __name__ == "__main__":
    sys.exit(measure({"exactness": exactness}, "deforming fmu "))
