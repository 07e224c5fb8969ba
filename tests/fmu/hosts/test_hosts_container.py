"""FMU containers (fmu-manipulation-toolbox): valve and film in one FMU, run by a runtime in C.

Containers are built by the command a user types, and run by fmpy in a process of their own.
"""

from __future__ import annotations

import importlib.util
import json
import logging
import shutil
import subprocess
import sys
import zipfile
from xml.etree import ElementTree

import pytest

pytest.importorskip("pythonfmu")
fmpy = pytest.importorskip("fmpy")
if importlib.util.find_spec("fmu_manipulation_toolbox") is None:
    pytest.skip("fmu-manipulation-toolbox is not installed", allow_module_level=True)

from fmu_manipulation_toolbox.checker import get_checkers  # noqa: E402
from fmu_manipulation_toolbox.operations import FMU  # noqa: E402
from hosts_ecos import compiled_quickly, run  # noqa: E402
from hosts_fmus import native_fmu  # noqa: E402
from native_scenes import HAS_CC  # noqa: E402

from contactkit.app.system import write_system  # noqa: E402
from contactkit.fmu.framework.toolchain import local  # noqa: E402
from contactkit.fmu.master.injector import cosimulate  # noqa: E402
from contactkit.fmu.python import build as building  # noqa: E402
from contactkit.fmu.python.build import FMUS, validate  # noqa: E402

pytestmark = pytest.mark.slow

needs_cc = pytest.mark.skipif(not HAS_CC, reason="there is no C compiler")
no_runtime = pytest.mark.skipif(
    sys.platform.startswith("linux") and "x86_64" not in local(), reason="no container for this"
)
STOP = 2e-3
ROWS = ("FMU;valve_drive.fmu;;;", "FMU;stiction_mass.fmu;;;", "OUTPUT;stiction_mass.fmu;h;;h")


@pytest.fixture(scope="module", autouse=True)
def quickly():
    with compiled_quickly():
        yield


@pytest.fixture(scope="module")
def archive(tmp_path_factory):
    """The SSP of the injector."""
    folder = tmp_path_factory.mktemp("container")
    native = {"native": True, "platforms": [local()], "compiler": "cc"} if HAS_CC else {}
    return write_system("fuel-injector", folder / "valve.ssp", **native)


@pytest.fixture(scope="module")
def fmus(archive):
    """Its FMUs; their names can stand in the name of a variable."""
    names = {"valve-drive": "valve_drive.fmu", "stiction-mass": "stiction_mass.fmu"}
    with zipfile.ZipFile(archive) as packed:
        for name in names.values():
            (archive.parent / name).write_bytes(packed.read(f"resources/{name}"))
    return {model: archive.parent / name for model, name in names.items()}


@pytest.fixture(scope="module")
def release(fmus):
    """By our own master."""
    found = cosimulate(*fmus.values(), STOP, 2e-6)["t_release"][-1]
    assert found == pytest.approx(1.342186e-3, rel=2e-6)
    return found


def toolbox(program, folder, *words):
    command = [sys.executable, "-m", f"fmu_manipulation_toolbox.cli.{program}", *words]
    done = subprocess.run(
        command, cwd=folder, capture_output=True, text=True, check=False, timeout=100
    )
    assert done.returncode == 0, done.stdout + done.stderr
    return done.stdout + done.stderr


def pack(fmus, folder, step, *flags, rows=ROWS):
    """Build a container from a table; ports of one name are connected without being asked."""
    for path in fmus.values():
        shutil.copy(path, folder)
    text = "\n".join(["rule;from_fmu;from_port;to_fmu;to_port", *rows, ""])
    (folder / "valve.csv").write_text(text)
    toolbox("fmucontainer", folder, "-container", f"valve.csv:{step!r}", *flags)
    return folder / "valve.fmu"


_RUN = """
import fmpy, json, sys
path, options = sys.argv[1], json.loads(sys.argv[2])
try:
    found = fmpy.simulate_fmu(path, stop_time=2e-3, **options)
    found = {name: list(map(float, found[name])) for name in found.dtype.names}
except Exception as error:
    found = {"error": str(error)}
print("found", json.dumps(found))
"""


def simulate(path, *outputs, interval=1e-5, **options):
    """Columns of a run, and its messages."""
    options |= {"output": outputs, "output_interval": interval}
    done = run(_RUN, str(path), json.dumps(options))
    assert "found" in done.stdout, done.stdout + done.stderr
    said, _, found = done.stdout.rpartition("found")
    found = json.loads(found)
    assert "error" in found or found["time"][-1] == pytest.approx(STOP)
    return found, said + done.stderr


# Checks and sources -------------------------------------------------------------------------


@pytest.fixture(scope="module")
def described(tmp_path_factory):
    """A file for each Python FMU, with no more than its description in it."""
    folder, paths = tmp_path_factory.mktemp("described"), []
    for name in FMUS:
        root = building._slave_class(name)(instance_name="one", resources=".").to_xml({})
        paths.append(folder / f"{name}.fmu")
        with zipfile.ZipFile(paths[-1], "w") as packed:
            packed.writestr("modelDescription.xml", ElementTree.tostring(root))
    return paths


def test_nothing_in_our_fmus_to_complain_of(fmus, described, tmp_path, caplog):
    """What `fmutool -check` does: schemas, and rules that schemas cannot say."""
    new = native_fmu(tmp_path, "stiction-mass", "A", 3) if HAS_CC else described[0]
    for path in (*described, *fmus.values(), new):
        with caplog.at_level(logging.INFO, "fmu_manipulation_toolbox"), FMU(str(path)) as fmu:
            for checker in get_checkers():
                fmu.apply_operation(checker())
        assert {entry.levelname for entry in caplog.records} == {"INFO"}, (path, caplog.messages)
        assert sum("No semantic error" in message for message in caplog.messages) == 1
        caplog.clear()


@needs_cc
def test_our_sources_are_compiled_by_it(fmus, tmp_path):
    """From an FMU without a binary, by what the description says of the sources."""
    bare, built = tmp_path / "bare.fmu", tmp_path / "built.fmu"
    with zipfile.ZipFile(fmus["stiction-mass"]) as old, zipfile.ZipFile(bare, "w") as new:
        for name in old.namelist():
            if not name.startswith("binaries/"):
                new.writestr(name, old.read(name))
    toolbox(
        "fmutool",
        tmp_path,
        "-input",
        bare,
        "-compile-sources",
        "-compile-options=-O0",
        "-output",
        built,
    )
    runs = [
        fmpy.simulate_fmu(str(path), start_values={"F_ext": 40.0}, stop_time=5e-4, output=["h"])
        for path in (fmus["stiction-mass"], built)
    ]
    assert runs[0]["h"][-1] == pytest.approx(runs[1]["h"][-1], rel=1e-9)


# Containers ---------------------------------------------------------------------------------


@no_runtime
@pytest.mark.parametrize(
    ("step", "flags", "error"),
    [
        (1e-6, (), -1.1e-6),
        (5e-6, ("-fmi", "3"), -3.5e-5),
        # the pull of the end of a step is taken for that of its start
        (5e-6, ("-sequential",), -3.8e-3),
    ],
)
def test_valve_and_film_in_one_fmu(fmus, tmp_path, release, step, flags, error):
    path = pack(fmus, tmp_path, step, *flags)
    assert validate(path) == []
    found, _ = simulate(path, "t_release", "h", "n_release")
    assert found["t_release"][-1] / release - 1.0 == pytest.approx(error, rel=0.2)
    assert found["n_release"][-1] == 1
    assert 2e-5 < found["h"][-1] < 3e-5  # held open by the magnet, at the stop of 25 um


@no_runtime
def test_the_film_first_if_they_take_turns(fmus, tmp_path, release):
    path = pack(fmus, tmp_path, 5e-6, "-sequential", rows=(ROWS[1], ROWS[0], ROWS[2]))
    found, _ = simulate(path, "t_release")
    assert found["t_release"][-1] / release - 1.0 == pytest.approx(-7.2e-5, rel=0.2)


@no_runtime
def test_parameters_of_both_reach_them(fmus, tmp_path):
    """With a unit of their own name each; a refusal says why to a host that listens."""
    path = pack(fmus, tmp_path, 5e-6, "-auto-parameter")
    found, _ = simulate(path, "t_release", start_values={"stiction_mass.m": 0.04})
    assert found["t_release"][-1] == pytest.approx(1.4017e-3, rel=1e-4)
    wrong = {"start_values": {"stiction_mass.h0": -1.0}, "debug_logging": True}
    found, said = simulate(path, "t_release", **wrong)
    assert "failed with status 3" in found["error"]
    if HAS_CC:
        assert "stiction_mass.fmu: h0 must be a finite number, at least" in said


@no_runtime
def test_from_the_ssp(archive, tmp_path, release):
    """It connects them, but shows no output; the gap is there as a local variable."""
    shutil.copy(archive, tmp_path)
    said = toolbox("fmucontainer", tmp_path, "-container", f"{archive.name}:5e-06")
    assert "Output 'Port stiction_mass.fmu/t_release' is not connected" in said
    found, _ = simulate(tmp_path / "valve.fmu", "stiction_mass.h", interval=5e-6)
    gaps, times = found["stiction_mass.h"], found["time"]
    k = next(k for k, gap in enumerate(gaps) if gap > 23e-6)
    crossing = times[k] - 5e-6 * (gaps[k] - 23e-6) / (gaps[k] - gaps[k - 1])
    assert crossing / release - 1.0 == pytest.approx(-5.2e-5, rel=0.3)


@no_runtime
def test_a_step_too_long_for_the_stop(fmus, tmp_path, release):
    """100 us, which `contactkit fmu system` refuses: the film still answers what it is asked."""
    path = pack(fmus, tmp_path, 1e-4)
    found, _ = simulate(path, "t_release", "n_release", "F_peak", "h", interval=1e-4)
    assert found["t_release"][-1] > 1.2 * release
    assert found["F_peak"][-1] == pytest.approx(15.83, rel=1e-2)  # half of strength times area
    assert min(found["h"]) > 0.0
