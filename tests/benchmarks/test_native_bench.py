"""What a doStep of a native FMU costs in a host in C, and where the time goes.

Counts are asserted, nanoseconds only printed.
"""

from __future__ import annotations

import math
import re
import shutil
import subprocess
import sys
import zipfile
from itertools import count, islice
from pathlib import Path

import pytest

pytest.importorskip("pythonfmu")
pytest.importorskip("fmpy")

from contactkit.analyses.load_displacement.curve import LoadDisplacementCurve
from contactkit.fmu.framework.instance import Instance
from contactkit.fmu.framework.toolchain import local
from contactkit.fmu.native.build import build_native
from contactkit.fmu.native.drive import build_native_drive
from contactkit.fmu.native.sources import write_sources
from contactkit.fmu.native.tip import build_native_tip
from contactkit.fmu.python.build import build

if shutil.which("cc") is None or not sys.platform.startswith("linux"):
    pytest.skip("needs a C compiler and a linker that wraps", allow_module_level=True)

HOST = Path(__file__).with_name("native_speed.c")
FLAGS = (
    "-std=c99",
    "-O3",
    "-DNDEBUG",
    "-fPIC",
    "-fvisibility=hidden",
    "-ffp-contract=off",
    "-fno-math-errno",
    "-Wl,--wrap=ck_forces_at",
)
ROUNDS = 200

# case of release_cases, pull [N], communication step [s], steps, most evaluations per internal step
RUNS = {
    "A, 1 us": ("A", 40.0, 1e-6, 380, 4.5),
    "A, 10 us": ("A", 40.0, 1e-5, 38, 4.5),
    "A, quiet": ("A", 1e-3, 1e-6, 1000, 4.5),
    "B, 1 us": ("B", 40.0, 1e-6, 1000, 4.5),
    "E, 1 us": ("E", 40.0, 1e-6, 700, 6.0),
}


@pytest.fixture(scope="module")
def host(tmp_path_factory):
    folder = tmp_path_factory.mktemp("host")
    write_sources(folder)
    files = [str(HOST), *(path.name for path in folder.glob("*.c"))]
    command = ["cc", *FLAGS, "-I.", *files, "-o", "host", "-lm"]
    subprocess.run(command, cwd=folder, check=True, capture_output=True)
    return folder / "host"


@pytest.fixture(scope="module")
def unpacked(release_scene, tmp_path_factory):
    """Folder of an FMU, and its GUID, by the name of its case."""
    made = {}

    def of(name):
        if name not in made:
            folder = tmp_path_factory.mktemp(name)
            path = build_native(release_scene(name), folder / "x.fmu", platforms=[local()])
            with zipfile.ZipFile(path) as packed:
                packed.extractall(folder)
            text = (folder / "modelDescription.xml").read_text()
            made[name] = folder, re.search('guid="([^"]*)"', text)[1]
        return made[name]

    return of


@pytest.mark.parametrize("name", RUNS)
def test_do_step_in_a_host_in_c(benchmark, host, unpacked, name):
    case, pull, step, count, most = RUNS[name]
    folder, guid = unpacked(case)
    words = [host, folder / "resources", guid, pull, step, count, ROUNDS]
    said = benchmark.pedantic(
        subprocess.run,
        ([str(word) for word in words],),
        {"check": True, "capture_output": True, "text": True},
        rounds=3,
    ).stdout
    step_ns, exchange_ns, steps, iterations, evaluations, _ = map(float, said.split())
    benchmark.extra_info |= {
        "us per doStep": 1e-3 * step_ns,
        "us per set, doStep, get": 1e-3 * exchange_ns,
        "internal steps per doStep": steps,
        "iterations per doStep": iterations,
        "evaluations per doStep": evaluations,
    }
    assert evaluations <= most * steps
    assert iterations <= 1.6 * steps


@pytest.mark.parametrize("step", [1e-6, 5e-6])
def test_do_step_of_the_drive_in_a_host_in_c(benchmark, host, step, tmp_path):
    """From the start, so that the coil is off, then on, in a tenth and in the rest of the steps."""
    path = build_native_drive(tmp_path / "x.fmu", start={"t_delay": 1e-4}, platforms=[local()])
    with zipfile.ZipFile(path) as packed:
        packed.extractall(tmp_path)
    guid = re.search('guid="([^"]*)"', (tmp_path / "modelDescription.xml").read_text())[1]
    words = [host, tmp_path / "resources", guid, 5e-6, step, round(1e-3 / step), ROUNDS]
    said = benchmark.pedantic(
        subprocess.run,
        ([str(word) for word in words],),
        {"check": True, "capture_output": True, "text": True},
        rounds=3,
    ).stdout
    step_ns, exchange_ns, *_ = map(float, said.split())
    benchmark.extra_info |= {
        "us per doStep": 1e-3 * step_ns,
        "us per set, doStep, get": 1e-3 * exchange_ns,
    }


SITE = LoadDisplacementCurve(
    approach=(1e-11, 1e-10, 1e-9, 4e-9),
    force=tuple(1.66e7 * d**1.5 for d in (1e-11, 1e-10, 1e-9, 4e-9)),  # a ball of aluminium
    contact_area=(3e-18, 3e-17, 3e-16, 1.2e-15),
    plastic_area=(0.0,) * 4,
    elastic_limit=4e-9,
    nominal_area=1e-13,
)
TIPS = {"dry": {}, "wet": {"V": 1.3e-24}, "compliant": {"curve": SITE, "d_stop": 1.0}}


@pytest.mark.parametrize("kind", TIPS)
@pytest.mark.parametrize("language", ["C", "Python"])
def test_tips_that_are_shaken(benchmark, tmp_path, language, kind):
    """125 steps of 20 ns through fmpy, in each of which three inputs are set."""
    path, start = tmp_path / "x.fmu", dict(TIPS[kind])
    if language == "C":
        build_native_tip(path, start=start, platforms=[local()], compiler="cc")
    else:
        build("tip-contact", path, start=start)
    step, w = 2e-8, 2.0 * math.pi * 2e6
    with Instance(path) as tips:
        tips.start({"z": 5e-8}, 1.0)
        inputs, counter = tips.references("z", "vz", "az"), count()

        def run():
            for i in islice(counter, 125):
                s, c = 1e-7 * math.sin(w * i * step), 1e-7 * math.cos(w * i * step)
                tips.set(inputs, [5e-8 + s, w * c, -w * w * s])
                tips.step(i * step, step)

        benchmark.pedantic(run, rounds=8)
        assert tips.get_integers(tips.references("n_land"))[0] >= 20
    benchmark.extra_info["us per step"] = 8e3 * benchmark.stats.stats.min
