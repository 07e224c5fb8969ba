"""Ecos, a host in C++ that nobody here wrote: each run in a process of its own.

`ecos` starts this file as a program, gives it a job and reads what it found. Ecos 0.7.2 ignores
the status of every call of FMI, so a test has to look at what the outputs say.
"""

from __future__ import annotations

import contextlib
import ctypes
import importlib.util
import json
import subprocess
import sys
from importlib import metadata
from unittest import mock


def why_not() -> str:
    """What is missing to run Ecos here; nothing if it can be run."""
    if importlib.util.find_spec("ecospy") is None:
        return "ecospy is not installed"
    if sys.platform.startswith("linux") and not _tbb():
        return "the library of the package tbb is missing, which Ecos needs"
    return ""


def _tbb() -> list:
    try:
        files = metadata.files("tbb") or []
    except metadata.PackageNotFoundError:
        return []
    return [file.locate() for file in files if file.name == "libtbb.so.12"]


@contextlib.contextmanager
def compiled_quickly():
    """Native FMUs with less optimization while they are tried, and none kept for other tests."""
    from contactkit.fmu.framework import toolchain as native_compile
    from contactkit.fmu.native import build as native_build

    flags = tuple("-O0" if flag == "-O3" else flag for flag in native_compile._FLAGS)
    with (
        mock.patch.object(native_compile, "_FLAGS", flags),
        mock.patch.dict(native_build._COMPILED),
    ):
        native_build._COMPILED.clear()
        yield


def run(code: str, *given: str, folder=None) -> subprocess.CompletedProcess:
    """Run a program that may crash."""
    return subprocess.run(
        [sys.executable, "-c", code, *given],
        capture_output=True,
        text=True,
        check=False,
        timeout=100,
        cwd=folder,
    )


def ecos(step, steps, read, fmus=None, wires=(), start=None, ssp=None, again=False):
    """Values of `read` (`film.h`) after so many steps; `again`: and after a reset and as many."""
    job = {
        "step": step,
        "steps": steps,
        "read": list(read),
        "wires": list(wires),
        "fmus": {name: str(path) for name, path in (fmus or {}).items()},
        "start": start or {},
        "ssp": str(ssp or ""),
        "again": again,
    }
    program = f"import runpy; runpy.run_path({__file__!r}, run_name='__main__')"
    done = run(program, json.dumps(job))
    assert "found" in done.stdout, done.stdout + done.stderr
    found = json.loads(done.stdout.rpartition("found")[2])
    for one in found:  # it may also end early without a word
        assert abs(one.pop("time") - step * steps) < 1e-3 * step
    said = done.stdout.partition("found")[0] + done.stderr
    return (*found, said) if again else found[0]


def name_of(variable: str) -> str:
    return variable.replace(".", "::", 1)


def main() -> None:
    """Do the job."""
    job = json.loads(sys.argv[1])
    for library in _tbb():
        ctypes.CDLL(str(library), ctypes.RTLD_GLOBAL)
    from ecospy import EcosSimulation, EcosSimulationStructure

    if job["ssp"]:
        simulation = EcosSimulation(ssp_path=job["ssp"], step_size=job["step"])
    else:
        structure = EcosSimulationStructure()
        for name, path in job["fmus"].items():
            structure.add_model(name, path)
        for wire in job["wires"]:
            structure.make_real_connection(*map(name_of, wire.split(" -> ")))
        start = {name_of(name): value for name, value in job["start"].items()}
        structure.add_parameter_set("initialValues", start)
        simulation = EcosSimulation(structure=structure, step_size=job["step"])
    found = []
    for _ in range(2 if job["again"] else 1):
        if found:
            simulation.reset()
        simulation.init(parameter_set="initialValues")  # as in our SSP; not taken without its name
        simulation.step(job["steps"])
        values = {variable: value_of(simulation, name_of(variable)) for variable in job["read"]}
        found.append(values | {"time": simulation.get_time()})
    simulation.terminate()
    sys.stdout.write(f"found{json.dumps(found)}\n")


def value_of(simulation, name):
    try:
        return simulation.get_real(name)
    except Exception:  # noqa: BLE001  # it knows no other kind
        return simulation.get_integer(name)


if __name__ == "__main__":
    main()

__all__ = ["compiled_quickly", "ecos", "run", "why_not"]
