"""The misuse probe against a kernel that address and undefined-behaviour sanitizers watch."""

from __future__ import annotations

import subprocess
import sys

import pytest
from native_scenes import CC, HAS_CC, HERE, compile_c
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

pytestmark = pytest.mark.slow

FLAGS = ["-g1", "-fsanitize=address,undefined", "-fno-sanitize-recover=all"]
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
    """Each native FMU, unpacked."""
    folders = {name: tmp_path_factory.mktemp("fmu") for name in NATIVES}
    return {name: unpack(build_one(name, f), f / "fmu") for name, f in folders.items()}


@pytest.fixture(scope="module")
def checked(unpacked, tmp_path_factory):
    """Sanitized library of each version of FMI, of the sources in the FMU; models share them."""
    made = {}

    def make(name):
        version = name[-1]
        if version not in made:
            sources = unpacked[name] / "sources"
            out = tmp_path_factory.mktemp("checked") / f"fmi{version}.so"
            files = sorted(sources.glob("*.c"))
            try:
                compile_c(files, out, "-fPIC", "-shared", f"-I{sources}", *FLAGS)
            except subprocess.CalledProcessError as error:
                pytest.skip(f"the compiler has no sanitizers: {error.stderr[:200]}")
            made[version] = out
        return made[version]

    return make


@pytest.mark.parametrize("name", NATIVES)
def test_no_misuse_touches_what_it_should_not(unpacked, checked, tmp_path, name):
    spec = specification(name, unpacked[name]) | {"library": str(checked(name))}
    preload = {"LD_PRELOAD": " ".join(map(runtime, ("libasan.so", "libubsan.so")))}
    code, said, found = end_probe(start_probe(spec, tmp_path, *CASES, **preload, **SETTINGS))
    assert code == 0, said
    assert set(found) == set(CASES)


@pytest.mark.parametrize("name", quick([n for n in NATIVES if n.endswith("2")], long=[0]))
def test_spoilt_tables_are_refused_or_harmless(unpacked, checked, tmp_path, name):
    """Numbers out of all range, tables cut short and wrong counts, under a checksum that fits."""
    library, flags = checked(name), [f"-I{unpacked[name] / 'sources'}", *FLAGS]
    words = [HERE / "native_fuzz.c", library]
    program = compile_c(words, tmp_path / "fuzz", *flags, f"-Wl,-rpath,{library.parent}")
    scratch = tmp_path / "spoilt"
    scratch.mkdir()
    done = subprocess.run(
        [str(program), str(unpacked[name] / "resources"), str(scratch), "2000"],
        capture_output=True,
        text=True,
        check=False,
        timeout=120,
    )
    assert done.returncode == 0, done.stderr[-2000:]
    assert int(done.stdout) < 1500  # some changes are as good as the truth, most are not
