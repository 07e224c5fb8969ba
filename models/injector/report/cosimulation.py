"""Co-simulation of the fuel injector by two FMUs, each run beside its monolithic solution."""

from __future__ import annotations

import math
import tempfile
from collections.abc import Callable
from functools import partial
from pathlib import Path
from time import perf_counter
from typing import TYPE_CHECKING, Any, NamedTuple

from ....errors import PlanError
from ....separation.plan import Plan, plan
from ....units import celsius
from ..scene import InjectorScene, end_stop_faces
from ..valve import Valve

if TYPE_CHECKING:
    from ....fmu.master.injector import CoSimulation
    from ..monolithic import MonolithicResult

__all__ = [
    "CHECKED",
    "InjectorFmus",
    "InjectorRun",
    "build_fmus",
    "cosimulate_cases",
    "drive_start",
]

Progress = Callable[[float], None]

CHECKED = 2
"""Cycles that are solved monolithically as well, and all of an oil that sustains its strength."""


class InjectorFmus(NamedTuple):
    """Files of the FMUs ``valve-drive`` and ``stiction-mass`` of an injector."""

    drive: Path
    mass: Path


class InjectorRun(NamedTuple):
    """One co-simulation at a temperature [K], and its check over the first cycles.

    `sustained`: of an oil that goes on to sustain its strength at the edge of the cavity, in place
    of one whose cavity has the pressure of the file.
    """

    temperature: float
    sustained: bool
    plan: Plan
    coupled: CoSimulation
    monolithic: MonolithicResult
    seconds: float

    @property
    def label(self) -> str:
        """Temperature in degrees Celsius."""
        return f"{self.temperature - celsius(0.0):+.0f} degC"

    @property
    def name(self) -> str:
        """Name of the run in those of files and numbers: ``minus20degC``, ``80degC_sustained``."""
        degrees = self.temperature - celsius(0.0)
        sign = "minus" if degrees < 0.0 else ""
        return f"{sign}{abs(degrees):.0f}degC{'_sustained' if self.sustained else ''}"


def cosimulate_cases(
    scene: InjectorScene, out: Path | None, progress: Progress
) -> list[InjectorRun]:
    """Co-simulate each temperature with the oil of the file, and one that sustains its strength.

    The FMUs are left in the folder `out` if one is given.
    """
    limit = scene.tension_limit
    two = limit is not None and limit.cavity_drop < limit.tension < math.inf
    oils = (False, True) if two else (False,)
    cases = [(t, sustained) for t in scene.study.temperatures for sustained in oils]
    with tempfile.TemporaryDirectory(prefix="contactkit-") as folder:
        pair = build_fmus(scene, out if out is not None else Path(folder))
        return [
            _cosimulate(
                scene, pair, temperature, sustained, partial(_fraction, progress, i, len(cases))
            )
            for i, (temperature, sustained) in enumerate(cases)
        ]


def build_fmus(scene: InjectorScene, folder: Path) -> InjectorFmus:
    """Build drive and mass with the values of the scene as start values, and validate them.

    Raises
    ------
    PlanError
        If an FMU is not valid.
    """
    from ....fmu.python.build import build, validate
    from ....fmu.slaves.stiction_mass import mass_values

    start = mass_values(scene.separation(scene.temperature))
    drive = build("valve-drive", folder / "valve-drive.fmu", start=drive_start(scene.valve))
    mass = build("stiction-mass", folder / "stiction-mass.fmu", start=start)
    problems = validate(drive) + validate(mass)
    if problems:
        raise PlanError("FMU not valid: " + "; ".join(problems))
    return InjectorFmus(drive, mass)


def drive_start(valve: Valve) -> dict[str, Any]:
    """Start values of the FMU ``valve-drive``, with the curve of rough end-stop faces."""
    from ....fmu.slaves.valve_drive import drive_values

    curve = end_stop_faces(valve)
    return drive_values(valve) | ({} if curve is None else {"curve": curve})


def _cosimulate(
    scene: InjectorScene,
    pair: InjectorFmus,
    temperature: float,
    sustained: bool,
    progress: Progress,
) -> InjectorRun:
    from ....fmu.master.injector import Fmu, cosimulate
    from ....fmu.slaves.stiction_mass import mass_values
    from ..monolithic import simulate

    film = scene.separation(temperature, cavity_pressure=-math.inf if sustained else None)
    begun, profile = perf_counter(), scene.valve.profile
    checked = min(scene.stop_time, profile.start_delay + CHECKED * profile.period)
    coupled = cosimulate(
        pair.drive,
        Fmu(pair.mass, mass_values(film)),
        checked if sustained else scene.stop_time,
        scene.study.communication_step,
        progress=progress,
    )
    seconds = perf_counter() - begun
    made = plan(film)
    check = simulate(made, scene.valve, checked, rtol=1e-6, faces=end_stop_faces(scene.valve))
    return InjectorRun(temperature, sustained, made, coupled, check, seconds)


def _fraction(progress: Progress, i: int, n: int, done: float) -> None:
    """Report the fraction done of the i-th of n runs as one of all of them."""
    progress((i + done) / n)
