"""The misuse probe against a kernel that address and undefined-behaviour sanitizers watch."""

from __future__ import annotations

import functools
import subprocess
import sys

import pytest
from native_scenes import CC, HAS_CC, HERE, SANITIZED, compile_c, sanitized_kernel, scene
from selection import quick

pytest.importorskip("pythonfmu")
pytest.importorskip("fmpy")
if not HAS_CC or not sys.platform.startswith("linux"):
    pytest.skip("there is no C compiler, or no ASan that can be preloaded", allow_module_level=True)

import probe
from probe_fmus import (
    NATIVES,
    build_one,
    end_probe,
    specification,
    start_probe,
    unpack,
)

import contactkit as ck
from contactkit.fmu.framework.toolchain import local
from contactkit.fmu.native.build import build_native

pytestmark = pytest.mark.slow

CASES = [one.__name__ for one in probe.CASES + probe.HARD if one is not probe.odd_path]
SETTINGS = {
    "ASAN_OPTIONS": "detect_leaks=0:abort_on_error=0:exitcode=99",  # Python leaks for itself
    "UBSAN_OPTIONS": "print_stacktrace=1",
}


def runtime(name):
    """Library of a sanitizer, which must be there before Python is."""
    words = [CC, f"-print-file-name={name}"]
    return subprocess.run(words, capture_output=True, text=True, check=True).stdout.strip()


@pytest.fixture(scope="module")
def unpacked(tmp_path_factory):
    """Native FMUs by their names, unpacked when they are asked for."""

    @functools.cache
    def find(name):
        folder = tmp_path_factory.mktemp("fmu")
        return unpack(build_one(name, folder), folder / "fmu")

    return find


@pytest.fixture(scope="module")
def checked(unpacked, shelf):
    """Sanitized library of each version of FMI, of the sources in the FMU; models share them."""

    def make(name):
        return sanitized_kernel(shelf, unpacked(name) / "sources", int(name[-1]))

    return make


# Models share a library: with a mass, with switchings, with a tip on faces, on rings.
@pytest.mark.parametrize("name", quick(NATIVES, long=[1, 4, 8, 10]))
def test_no_misuse_touches_what_it_should_not(unpacked, checked, tmp_path, name):
    spec = specification(name, unpacked(name)) | {"library": str(checked(name))}
    preload = {"LD_PRELOAD": " ".join(map(runtime, ("libasan.so", "libubsan.so")))}
    code, said, found = end_probe(start_probe(spec, tmp_path, *CASES, **preload, **SETTINGS))
    assert code == 0, said
    assert set(found) == set(CASES)


def spoil(library, resources, sources, folder, tries):
    """Number of tables that were taken for good, of so many that were spoilt."""
    flags = [f"-I{sources}", *SANITIZED, f"-Wl,-rpath,{library.parent}"]
    program = compile_c([HERE / "native_fuzz.c", library], folder / "fuzz", *flags)
    scratch = folder / "spoilt"
    scratch.mkdir()
    done = subprocess.run(
        [str(program), str(resources), str(scratch), str(tries)],
        capture_output=True,
        text=True,
        check=False,
        timeout=120,
    )
    assert done.returncode == 0, done.stderr[-2000:]
    return int(done.stdout)


@pytest.mark.parametrize("name", quick([n for n in NATIVES if n.endswith("2")], long=[0]))
def test_spoilt_tables_are_refused_or_harmless(unpacked, checked, tmp_path, name):
    """Numbers out of all range, tables cut short and wrong counts, under a checksum that fits."""
    folder = unpacked(name)
    taken = spoil(checked(name), folder / "resources", folder / "sources", tmp_path, 2000)
    assert taken < 1500  # some changes are as good as the truth, most are not


def test_a_spoilt_grid_is_refused_or_harmless(unpacked, checked, tmp_path):
    """A tilted face with a sealed hole, which cavitates at any pull."""
    hole = ck.SealedHole(shape=ck.Disc(radius=6e-4, centre=(8e-4, 2e-4)), volume=1e-11)
    plan = ck.Rectangle(length=4e-3, width=3e-3)
    face = ck.Flat(planform=plan, holes=(hole,), tilt=(1e-3, 0.0))
    effects = (ck.ViscousForce(), ck.TensionLimit(strength=1e-9))
    given = scene(lower=ck.Flat(), upper=face, effects=effects, stiffness=0.0)
    one = {"platforms": [local()], "compiler": "cc", "film_rtol": 0.1}
    folder = unpack(build_native(given, tmp_path / "x.fmu", **one), tmp_path / "x")
    library = checked("stiction-mass native 2")
    taken = spoil(library, folder / "resources", folder / "sources", tmp_path, 500)
    assert taken < 400
