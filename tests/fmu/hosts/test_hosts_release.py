"""The same release through hosts of others, against the monolithic value.

fmpy and libcosim are in `make test-all`; OMSimulator and PyFMI are run where they are installed
(docs/hosts.md says how). The last host is in C, with no Python in its process.
"""

from __future__ import annotations

import csv
import os
import shutil
import subprocess
import sys
import sysconfig
from pathlib import Path

import pytest

pytest.importorskip("pythonfmu")
fmpy = pytest.importorskip("fmpy")

from hosts_fmus import CASES, Cases, reference  # noqa: E402
from native_scenes import HAS_CC, HERE, compile_c  # noqa: E402

from contactkit.fmu.framework.toolchain import fmi_headers  # noqa: E402
from contactkit.fmu.python.guard import can_guard  # noqa: E402

pytestmark = pytest.mark.slow
needs_cc = pytest.mark.skipif(not HAS_CC, reason="there is no C compiler")
KINDS = [
    "python",
    pytest.param("native 2", marks=needs_cc),
    pytest.param("native 3", marks=needs_cc),
]
STOP = {"A": 5e-4, "B": 1.3e-2}
ROOM = {"python": 1e-7, "native 2": 2e-7, "native 3": 2e-7}  # 1e-8 is the tolerance of a step


@pytest.fixture(scope="module")
def fmu(shelf):
    return Cases(shelf)


@pytest.mark.parametrize("kind", KINDS)
def test_fmpy_releases_case_a(fmu, kind):
    """The mass and its spring inside, a steady pull: nothing is lost to the coupling."""
    found = fmpy.simulate_fmu(
        str(fmu(kind, "stiction-mass")),
        start_values={"F_ext": 40.0},
        stop_time=STOP["A"],
        output=["t_release", "h"],
        output_interval=1e-5,
    )
    assert found["time"][-1] == pytest.approx(STOP["A"])  # it may end early without a word
    assert found["t_release"][-1] == pytest.approx(reference("A"), rel=ROOM[kind])


@pytest.mark.slow
@pytest.mark.parametrize("kind", KINDS)
def test_fmpy_releases_case_b(fmu, kind):
    """The pull of a magnet as a table of its values, held over each step: first order."""
    import numpy as np

    case, step = CASES["B"]["case"], 2e-5
    time = np.arange(0.0, STOP["B"], step)
    middle = case["F0"] * -np.expm1(-(time + 0.5 * step) / case["tau"])
    table = np.array(
        list(zip(time, middle, strict=True)), dtype=[("time", float), ("F_ext", float)]
    )
    found = fmpy.simulate_fmu(
        str(fmu(kind, "stiction-mass", "B")),
        stop_time=STOP["B"],
        input=table,
        output=["t_release"],
        output_interval=step,
    )
    assert found["time"][-1] == pytest.approx(STOP["B"])
    assert found["t_release"][-1] == pytest.approx(reference("B"), rel=1e-3)


@pytest.fixture(scope="module")
def cosim():
    pytest.importorskip("libcosimpy")
    from hosts_cosim import Cosim

    return Cosim


LIBCOSIM = KINDS[:2]  # it reads no FMI 3


@pytest.mark.slow
@pytest.mark.parametrize("kind", LIBCOSIM)
def test_libcosim_releases_case_a(fmu, cosim, kind):
    host = cosim({"film": fmu(kind, "stiction-mass")}, 1e-5).set("film", F_ext=40.0).run(STOP["A"])
    assert host.get("film", "t_release") == pytest.approx(reference("A"), rel=ROOM[kind])
    assert host.get("film", "n_release") == 1


@pytest.mark.slow
@pytest.mark.parametrize("kind", LIBCOSIM)
@pytest.mark.parametrize(("step", "error"), [(1e-6, -1.7e-5), (1e-5, -1.6e-4)])
def test_libcosim_with_the_mass_inside(fmu, cosim, kind, step, error):
    """Pull and spring in another FMU: first-order errors as measured elsewhere."""
    fmus = {"drive": fmu("helper", "Drive"), "film": fmu(kind, "stiction-mass", k_s=0.0)}
    host = (
        cosim(fmus, step).connect("drive.F_ext -> film.F_ext", "film.h -> drive.h").run(STOP["A"])
    )
    found = host.get("film", "t_release") / reference("A") - 1.0
    assert found == pytest.approx(error, rel=0.1)


@pytest.mark.slow
@needs_cc
def test_libcosim_case_b_with_the_mass_inside(fmu, cosim):
    fmus = {
        "drive": fmu("helper", "Drive", "B"),
        "film": fmu("native 2", "stiction-mass", "B", k_s=0.0),
    }
    host = (
        cosim(fmus, 1e-5).connect("drive.F_ext -> film.F_ext", "film.h -> drive.h").run(STOP["B"])
    )
    assert host.get("film", "t_release") == pytest.approx(reference("B"), rel=1e-3)


WIRES = ("body.h -> film.h", "body.v -> film.v", "film.F -> body.F")


@pytest.mark.slow
@pytest.mark.parametrize(("step", "error"), [(1e-6, 1.5e-3), (1e-5, 1.4e-2)])
def test_libcosim_with_forces_exchanged(fmu, cosim, step, error):
    """Case A, the harmless one: a hundred times the error at the same step."""
    fmus = {"body": fmu("helper", "Body"), "film": fmu("python", "stiction-force")}
    host = cosim(fmus, step).connect(*WIRES).run(STOP["A"])
    found = host.get("body", "t_release") / reference("A") - 1.0
    assert abs(found) == pytest.approx(abs(error), rel=0.5)


@pytest.mark.slow
def test_libcosim_gets_the_flag_of_doubt(fmu, cosim):
    """Case B far beyond the stable step: a smooth wrong release, and a flag of doubt."""
    fmus = {"body": fmu("helper", "Body", "B"), "film": fmu("python", "stiction-force", "B")}
    host = cosim(fmus, 1e-5).connect(*WIRES).run(1e-3)
    assert host.get("body", "t_release") < 0.1 * reference("B")
    assert host.get("film", "n_doubt") > 0
    assert host.get("film", "H_stable") > 0.0


# hosts that are not on PyPI, or do not build from there --------------------------------------


@pytest.mark.slow
@pytest.mark.skipif(shutil.which("OMSimulator") is None, reason="OMSimulator is not installed")
@pytest.mark.parametrize("kind", KINDS)
def test_omsimulator_releases_case_a(fmu, tmp_path, kind):
    """Its program; the pull is baked in, as it takes no inputs from the command line."""
    path = fmu(kind, "stiction-mass", F_ext=40.0)
    folder = sysconfig.get_config_var("LIBDIR") or ""
    preload = Path(folder, sysconfig.get_config_var("INSTSONAME") or "none")
    more = {"LD_PRELOAD": str(preload)} if kind == "python" and preload.suffix != ".a" else {}
    options = ["--startTime=0", f"--stopTime={STOP['A']}", "--stepSize=1e-5"]
    out = tmp_path / "release.csv"
    done = subprocess.run(
        ["OMSimulator", *options, f"--resultFile={out}", str(path)],
        capture_output=True,
        text=True,
        check=False,
        cwd=tmp_path,
        env=os.environ | more,
        timeout=100,
    )
    assert done.returncode == 0, done.stdout + done.stderr
    with out.open(newline="") as stream:
        *_, last = csv.DictReader(stream)
    found = {name.rpartition(".")[2]: float(value) for name, value in last.items() if value}
    assert found["time"] == pytest.approx(STOP["A"])
    assert found["t_release"] == pytest.approx(reference("A"), rel=ROOM[kind])


@pytest.mark.slow
@pytest.mark.parametrize("kind", KINDS[1:2])
def test_pyfmi_releases_case_a(fmu, kind):
    """It has no co-simulation of FMI 3, and refuses FMUs that need a tool, as Python is."""
    pyfmi = pytest.importorskip("pyfmi")
    model = pyfmi.load_fmu(str(fmu(kind, "stiction-mass")))
    model.setup_experiment(start_time=0.0)
    model.enter_initialization_mode()
    model.exit_initialization_mode()
    model.set("F_ext", 40.0)
    for i in range(50):
        assert model.do_step(i * 1e-5, 1e-5) == 0
    found = float(model.get("t_release"))
    assert found == pytest.approx(reference("A"), rel=ROOM[kind])


# a host in C ---------------------------------------------------------------------------------

linux_only = pytest.mark.skipif(not sys.platform.startswith("linux"), reason="dlopen, /proc")


def release_in_c(path, folder, version, **environment):
    """Release of case A in a host in C, and how many libraries of Python it had mapped."""
    fmpy.extract(str(path), str(folder / "fmu"))
    found = fmpy.read_model_description(str(path))
    headers = folder / "headers"
    headers.mkdir()
    for name, content in fmi_headers(version).items():
        (headers / name).write_bytes(content)
    flags = [f"-I{headers}", f"-DFMI={version}"]
    program = compile_c([HERE / "host_release.c"], folder / "host", *flags)
    name = f"{found.coSimulation.modelIdentifier}.so"
    library = next((folder / "fmu" / "binaries").rglob(name))
    resources = folder / "fmu" / "resources"
    where = resources.as_uri() if version == 2 else f"{resources}/"
    clean = {key: value for key, value in os.environ.items() if "PYTHON" not in key}
    return subprocess.run(
        [
            str(program),
            str(library),
            where,
            found.guid or found.instantiationToken,
            "40",
            "1e-5",
            str(STOP["A"]),
        ],
        capture_output=True,
        text=True,
        check=False,
        timeout=60,
        env=clean | environment,
    )


@linux_only
@needs_cc
@pytest.mark.parametrize("kind", KINDS[1:])
def test_a_host_in_c_needs_no_python(fmu, tmp_path, kind):
    done = release_in_c(fmu(kind, "stiction-mass"), tmp_path, int(kind[-1]))
    assert done.returncode == 0, done.stderr
    release, pythons = map(float, done.stdout.split())
    assert release == pytest.approx(reference("A"), rel=ROOM[kind])
    assert pythons == 0


@linux_only
@pytest.mark.skipif(not can_guard(), reason="pythonfmu alone finds no Python")
def test_a_host_in_c_is_given_a_python(fmu, tmp_path):
    """By the guard of the Python FMU; pythonfmu's library alone needs LD_PRELOAD."""
    folder = sysconfig.get_config_var("LIBDIR") or ""
    library = Path(folder, sysconfig.get_config_var("INSTSONAME") or "none")
    if library.suffix == ".a" or not library.is_file():
        pytest.skip("this Python has no shared library")
    home = {"CONTACTKIT_LIBPYTHON": str(library), "PYTHONHOME": sys.base_prefix}
    done = release_in_c(fmu("python", "stiction-mass"), tmp_path, 2, **home)
    assert done.returncode == 0, done.stderr
    release, pythons = map(float, done.stdout.split())
    assert release == pytest.approx(reference("A"), rel=ROOM["python"])
    assert pythons > 0
