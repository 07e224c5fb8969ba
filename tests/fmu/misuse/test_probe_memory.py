"""Instances that come and go leave no memory behind; a file that was exchanged is noticed."""

from __future__ import annotations

import json
import subprocess
import sys

import pytest
from selection import quick

pytest.importorskip("pythonfmu")
fmpy = pytest.importorskip("fmpy")

from native_scenes import HAS_CC, SCENES  # noqa: E402

from contactkit.fmu.framework.toolchain import local  # noqa: E402
from contactkit.fmu.native.build import build_native  # noqa: E402
from contactkit.fmu.python.build import build  # noqa: E402
from contactkit.fmu.python.guard import can_guard  # noqa: E402

pytestmark = pytest.mark.skipif(
    not sys.platform.startswith("linux"), reason="the memory of a process is read from /proc"
)

ROOM = 2**20  # [B], what an allocator may take at once; 200 lives of 18 KiB are 3.5 of it

_CYCLES = """
import gc, json, os, sys
import fmpy
from fmpy import fmi2

folder, count = sys.argv[1], int(sys.argv[2])
about = fmpy.read_model_description(folder)
slave = fmi2.FMU2Slave(
    instanceName="one", guid=about.guid, unzipDirectory=folder,
    modelIdentifier=about.coSimulation.modelIdentifier,
)

def cycle():
    slave.instantiate()
    slave.setupExperiment()
    slave.enterInitializationMode()
    slave.exitInitializationMode()
    slave.doStep(0.0, 1e-6)
    slave.fmi2FreeInstance(slave.component)

def memory():
    gc.collect()
    with open("/proc/self/statm") as file:
        return int(file.read().split()[1]) * os.sysconf("SC_PAGE_SIZE")

for _ in range(60):
    cycle()
before = memory()
for _ in range(count):
    cycle()
print(json.dumps(memory() - before))
"""


def growth(shelf, path, count):
    """Bytes that a process grows by in many lives of an instance."""
    words = [sys.executable, "-c", _CYCLES, str(shelf.unpacked(path)), str(count)]
    done = subprocess.run(words, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    return json.loads(done.stdout)


@pytest.mark.skipif(not can_guard(), reason="there is no compiler for the guard")
@pytest.mark.parametrize("count", quick([200, 2000], long=[0]))
def test_a_python_fmu_keeps_nothing_of_an_instance(shelf, count):
    """pythonfmu alone keeps 5 KiB of each."""
    assert growth(shelf, shelf(build, "valve-drive"), count) < ROOM


@pytest.mark.skipif(not HAS_CC, reason="there is no C compiler")
@pytest.mark.slow
@pytest.mark.parametrize("count", [200, 2000])
def test_a_native_fmu_keeps_nothing_of_an_instance(shelf, count):
    path = shelf(build_native, SCENES["flooded"], platforms=[local()], compiler="cc")
    assert growth(shelf, path, count) < ROOM


_INSTANTIATE = """
import sys
import fmpy
from fmpy import fmi2

about = fmpy.read_model_description(sys.argv[1])
slave = fmi2.FMU2Slave(
    instanceName="one", guid=about.guid, unzipDirectory=sys.argv[1],
    modelIdentifier=about.coSimulation.modelIdentifier,
)
try:
    slave.instantiate(loggingOn=True)
except Exception as error:
    print(error)
"""


@pytest.mark.skipif(not can_guard(), reason="there is no compiler for the guard")
@pytest.mark.parametrize("change", ["another module", "no script", "empty"])
def test_an_exchanged_slavemodule_is_noticed(toy_fmu, tmp_path, change):
    fmpy.extract(str(toy_fmu), str(tmp_path))
    name = tmp_path / "resources" / "slavemodule.txt"
    if change == "no script":
        (tmp_path / "resources" / f"{name.read_text().strip()}.py").unlink()
    else:
        name.write_text("os" if change == "another module" else "")
    done = subprocess.run(
        [sys.executable, "-c", _INSTANTIATE, str(tmp_path)],
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.returncode == 0, done.stderr
    assert "Failed to instantiate" in done.stdout
    assert "slavemodule.txt" in done.stdout or "resource location" in done.stdout
