"""The guard in front of pythonfmu's library: what it changes in an FMU, and what it does not."""

from __future__ import annotations

import zipfile

import pytest

pytest.importorskip("pythonfmu")
pytest.importorskip("fmpy")

from contactkit.fmu.python import guard
from contactkit.fmu.python.build import build, validate

LIBRARY, MOVED = "binaries/linux64/Toy.so", "binaries/linux64/pythonfmu.so"
needs_guard = pytest.mark.skipif(not guard.can_guard(), reason="there is no compiler")
DESCRIPTION = b'<fmiModelDescription guid="abc-1">'


def test_without_a_compiler_an_fmu_is_left_as_it_is(monkeypatch):
    files = {"modelDescription.xml": DESCRIPTION, LIBRARY: b"\x7fELF"}
    monkeypatch.setenv("CC", "no-such-compiler")
    monkeypatch.setattr(guard, "has_zig", lambda: False)
    assert guard.protect(files) == files
    assert not guard.can_guard()


@needs_guard
def test_it_takes_the_place_of_the_library(monkeypatch):
    files = {"modelDescription.xml": DESCRIPTION, LIBRARY: b"\x7fELF of pythonfmu"}
    files["resources/slavemodule.txt"] = b"toy_1"
    found = guard.protect(files)
    assert found[MOVED] == files[LIBRARY]
    assert found["resources/guard.txt"] == b"abc-1\ntoy_1"
    assert found[LIBRARY][:4] == b"\x7fELF"
    assert b"fmi2Instantiate" in found[LIBRARY]


def test_what_has_no_library_for_linux_is_left_as_it_is():
    files = {"modelDescription.xml": DESCRIPTION, "binaries/win64/Toy.dll": b"MZ"}
    assert guard.protect(files) == files


@needs_guard
def test_guarded_fmus_are_valid_and_rebuilt_byte_by_byte(toy_module, tmp_path):
    one, other = (build("toy", tmp_path / name) for name in ("one.fmu", "other.fmu"))
    assert one.read_bytes() == other.read_bytes()
    assert validate(one) == []
    with zipfile.ZipFile(one) as packed:
        assert {LIBRARY, MOVED, "resources/guard.txt"} <= set(packed.namelist())
