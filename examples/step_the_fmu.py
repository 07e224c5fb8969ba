"""Step the FMU ``stiction-mass`` call by call with fmpy, as an FMI master does.

A pull of 40 N (1 - exp(-t/0.2 ms)) opens a film of 5 um of oil with a tensile limit of 10 bar. The
host approximates it by straight lines; `contactkit.simulate` takes the exact pull.
"""

from __future__ import annotations

import math
import shutil
import sys
import tempfile
import warnings
from pathlib import Path

import fmpy
from fmpy.fmi2 import FMU2Slave

import contactkit as ck
from contactkit.fmu.python.build import build
from contactkit.fmu.slaves.stiction_mass import mass_values
from contactkit.plot import separation as separation_plot
from contactkit.plot import style as plot
from contactkit.plot.axis_units import readable

STOP, STEPS, RISE, PULL = 1.2e-3, 600, 0.2e-3, 40.0  # [s], [-], [s], [N]


def scene() -> ck.SeparationScene:
    """Return the scene of the FMU."""
    oil = ck.Liquid(name="cold oil", viscosity=0.1, surface_tension=0.03)
    face = ck.Flat(radius=3.175e-3)
    film = ck.Meniscus(liquid=oil, volume=math.pi * 3.175e-3**2 * 5e-6)
    loading = ck.ImposedForce(
        initial_gap=5e-6, final_gap=1e-4, force=PULL, rise_time=RISE, mass=0.02
    )
    return ck.SeparationScene(
        interface=ck.Interface(lower=face, upper=face, meniscus=film),
        loading=loading,
        effects=(ck.MeniscusForce(), ck.ViscousForce(), ck.TensionLimit(strength=1e6)),
    )


def drive(path: Path) -> tuple[list[tuple[float, float]], float]:
    """Step an FMU; return (time, gap) at the communication points, and the release time [s]."""
    folder = fmpy.extract(str(path))
    description = fmpy.read_model_description(str(path))
    number = {v.name: v.valueReference for v in description.modelVariables}
    fmu = FMU2Slave(guid=description.guid, unzipDirectory=folder, modelIdentifier="StictionMass")
    fmu.instantiate()
    fmu.setupExperiment(startTime=0.0, stopTime=STOP)
    fmu.enterInitializationMode()
    fmu.exitInitializationMode()
    rows, length = [], STOP / STEPS
    for i in range(STEPS):
        begin, end = (-PULL * math.expm1(-k * length / RISE) for k in (i, i + 1))
        fmu.setReal([number["F_ext"], number["dF_ext"]], [begin, (end - begin) / length])
        fmu.doStep(i * length, length)
        rows.append(((i + 1) * length, fmu.getReal([number["h"]])[0]))
    released = fmu.getReal([number["t_release"]])[0]
    fmu.freeInstance()
    shutil.rmtree(folder)
    return rows, released


def main(out: Path) -> float:
    """Draw both motions; return the relative difference of their release times [-]."""
    with tempfile.TemporaryDirectory() as folder:
        fmu = build("stiction-mass", folder, start=mass_values(scene()))
        rows, released = drive(fmu)
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", ck.ValidityWarning)  # the rim breaks up into fingers
        result = ck.simulate(ck.plan(scene()))
    figure, ax = plot.figure()
    separation_plot.motion(result, ax)
    seconds, metres = readable("s", result.time)[0], readable("m", result.gap)[0]
    ax.plot([t / seconds for t, _ in rows[::10]], [h / metres for _, h in rows[::10]], "o", ms=3)
    plot.title(ax, "line: contactkit.simulate; dots: the FMU, every tenth step of 2 µs")
    plot.save(figure, out / "step_the_fmu")
    return abs(released / result.state.release_time - 1.0)


if __name__ == "__main__":
    sys.stdout.write(f"difference of the release times: {main(Path('out/examples')):.1e}\n")
