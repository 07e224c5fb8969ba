"""Valve and film as a system structure (SSP 1.0), for masters that read those.

A ``valve-drive`` pulls a ``stiction-mass``; gap and speed go back, as in `cosimulate`. The
communication step of the archive is that of the scene: as in `cosimulate` one too long for the
stop is refused, because the master that will run it does not know.
"""

from __future__ import annotations

import math
import os
import re
import tempfile
from collections.abc import Mapping, Sequence
from functools import partial
from pathlib import Path
from typing import Any

from attrs import frozen

from ..errors import DescriptionError, InfeasibleError, PlanError
from ..export.report import FmuStart
from ..fmu.contents.packing import write_archive
from ..fmu.contents.ssp import Component, Connection, Connector, Experiment, structure_xml
from ..fmu.framework.ports import Port, Value, find_port
from ..fmu.slaves.stiction_mass import mass_values
from ..models.injector.report.cosimulation import drive_start
from ..models.injector.scene import InjectorScene
from ..units import parse_quantity

__all__ = ["write_system"]

_DRIVE, _MASS = "drive", "mass"
_CONNECTIONS = (
    Connection(Connector(_DRIVE, "F_ext"), Connector(_MASS, "F_ext")),
    Connection(Connector(_DRIVE, "dF_ext"), Connector(_MASS, "dF_ext")),
    Connection(Connector(_MASS, "h"), Connector(_DRIVE, "h")),
    Connection(Connector(_MASS, "v"), Connector(_DRIVE, "v")),
)


@frozen
class _Film:
    """Start values of a film, as `native_scene` asks for them."""

    values: Mapping[str, Any]

    def fmu_start(self) -> FmuStart:
        """See `Opened.fmu_start`."""
        return FmuStart("stiction-mass", self.values)


def write_system(
    scene: str | InjectorScene,
    out: str | os.PathLike[str],
    *,
    native: bool = False,
    start: Mapping[str, Value | str] | None = None,
    step: float | None = None,
    platforms: Sequence[str] | None = None,
    compiler: str = "auto",
) -> Path:
    """Write an SSP archive: valve and film as two FMUs, their connections, and their values.

    Parameters
    ----------
    scene : str or InjectorScene
        A scene with a valve: a file, the name of one that comes with contactkit, or the scene.
    out : path
        The file to write, ``*.ssp``.
    native : bool
        Take FMUs that run without Python.
    start : mapping, optional
        Start values over those of the scene, by element and variable: ``{"mass.m": "25 g",
        "drive.n_cycles": 1}``.
    step : float, optional
        Communication step [s]; that of the scene if not given.
    platforms, compiler : optional
        Of native FMUs, see `contactkit.fmu.native.build.build_native`.

    Returns
    -------
    Path
        The file. The values are start values of the FMUs, and parameter bindings too.

    Raises
    ------
    DescriptionError
        If a name or value is not possible.
    PlanError
        If the scene has no valve.
    InfeasibleError
        If the step is too long for the stop.
    """
    target = Path(out)
    if target.suffix != ".ssp":
        raise DescriptionError("out", str(out), "end in .ssp")
    injector = _injector(scene)
    given = _by_element(start or {})
    drive, mass = _starts(injector, given)
    experiment = _experiment(injector, drive, mass, step)
    with tempfile.TemporaryDirectory(prefix="contactkit-") as folder:
        fmus = _fmus(Path(folder), drive, mass, native, platforms, compiler)
    title = re.sub(r"\W+", "_", injector.name, flags=re.ASCII).strip("_") or "system"
    files = {one.source: one.fmu for one in fmus}
    files["SystemStructure.ssd"] = structure_xml(
        title, fmus, _CONNECTIONS, experiment, description=injector.name
    )
    return write_archive(files, target)


def _injector(scene: str | InjectorScene) -> InjectorScene:
    """Scene of a fuel injector, opened if it is a name."""
    from .scenes import open_scene

    found = open_scene(scene) if isinstance(scene, str) else scene
    found = getattr(found, "scene", found)
    if not isinstance(found, InjectorScene):
        name = getattr(found, "name", scene)
        raise PlanError(
            f"{name} has no valve, which a system needs to pull its film; "
            "contactkit fmu build writes the FMU of a film alone"
        )
    return found


def _by_element(start: Mapping[str, Value | str]) -> dict[str, dict[str, Value | str]]:
    """Start values of each element."""
    found: dict[str, dict[str, Value | str]] = {_DRIVE: {}, _MASS: {}}
    for name, value in start.items():
        element, _, variable = name.partition(".")
        if element not in found or not variable:
            expected = f"be a variable of {_DRIVE} or {_MASS}"
            hint = f"write {_MASS}.m for the variable m of the mass"
            raise DescriptionError(name, value, expected, hint=hint)
        found[element][variable] = value
    return found


def _starts(
    scene: InjectorScene, given: Mapping[str, Mapping[str, Value | str]]
) -> tuple[dict[str, Any], dict[str, Any]]:
    """Start values of drive and mass; the drive sees the gap at which the mass begins."""
    mass = {**mass_values(scene.separation(scene.temperature)), **given[_MASS]}
    gap = mass.get("h0", scene.loading.initial_gap)
    drive = {**drive_start(scene.valve), "h": gap, **given[_DRIVE]}
    return drive, mass


def _fmus(
    folder: Path,
    drive: Mapping[str, Any],
    mass: Mapping[str, Any],
    native: bool,
    platforms: Sequence[str] | None,
    compiler: str,
) -> tuple[Component, Component]:
    """Build both FMUs."""
    from ..fmu.native.build import build_native, native_scene
    from ..fmu.native.drive import build_native_drive
    from ..fmu.python.build import build

    scene, values = native_scene(_Film(mass))  # refuses what contradicts itself, for both
    # Containers make names of variables of those of the files.
    pull, film = folder / "valve_drive.fmu", folder / "stiction_mass.fmu"
    if native:
        build_native_drive(pull, start=drive, platforms=platforms, compiler=compiler)
        build_native(scene, film, start=values, platforms=platforms, compiler=compiler)
    else:
        build("valve-drive", pull, start=drive)
        build("stiction-mass", film, start=mass)
    return (
        _component(_DRIVE, pull, "coil, return spring and opposite stop; steps first"),
        _component(_MASS, film, "spool and the film that holds it; steps last"),
    )


def _component(name: str, path: Path, description: str) -> Component:
    return Component(
        name=name, source=f"resources/{path.name}", fmu=path.read_bytes(), description=description
    )


def _number(ports: Sequence[Port], given: Mapping[str, Any], name: str) -> float:
    """Value of a parameter: what is given, perhaps with a unit, or where it starts."""
    port = find_port(ports, name)
    value = given.get(name, port.start)
    return float(
        port.read(parse_quantity(value, port.unit, name) if isinstance(value, str) else value)
    )


def _experiment(
    scene: InjectorScene, drive: Mapping[str, Any], mass: Mapping[str, Any], step: float | None
) -> Experiment:
    """All cycles at a step, unless with that an impact on the end stop would feed on itself."""
    from ..fmu.slaves.stiction_mass import PORTS
    from ..fmu.slaves.valve_drive import ValveDrive

    length = scene.study.communication_step if step is None else step
    if not (math.isfinite(length) and length >= 1e-9):
        raise DescriptionError(
            "step",
            length,
            "be finite and at least 1e-9",
            unit="s",
            hint="libcosim counts in nanoseconds",
        )
    pulled = partial(_number, ValveDrive.ports, drive)
    longest = 2.0 * math.sqrt(_number(PORTS, mass, "m") / pulled("k_stop"))
    if length > longest:
        raise InfeasibleError(
            f"the communication step of {length:g} s exceeds {longest:.3g} s = 2 sqrt(m/k_stop), "
            f"the longest with which the stop can be coupled to the mass; take a tenth of that"
        )
    stop_time = pulled("t_delay") + pulled("n_cycles") * pulled("T_period")
    return Experiment(stop_time=stop_time, step=length)
