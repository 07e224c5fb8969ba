"""The same release in the FMU compliance checker, a host in C (FMILibrary), if installed."""

from __future__ import annotations

import csv
import os
import shutil
import subprocess

import pytest

pytest.importorskip("pythonfmu")
pytest.importorskip("fmpy")

from hosts_fmus import Cases, reference
from native_scenes import HAS_CC

CHECKER = os.environ.get("FMUCHECK") or shutil.which("fmuCheck.linux64") or shutil.which("fmuCheck")
pytestmark = [
    pytest.mark.slow,
    pytest.mark.skipif(
        CHECKER is None,
        reason="pip has no package of it, and fmuCheck.linux64 is not on PATH, nor in FMUCHECK",
    ),
    pytest.mark.skipif(not HAS_CC, reason="there is no C compiler"),
]


def test_the_checker_releases_case_a(shelf, tmp_path):
    pull, out, log = (tmp_path / name for name in ("pull.csv", "out.csv", "log.txt"))
    pull.write_text("time,F_ext\n0.0,40.0\n1.0,40.0\n")
    fmu = Cases(shelf)("native 2", "stiction-mass")
    words = ["-k", "cs", "-s", "5e-4", "-h", "1e-5", "-i", pull, "-o", out, "-e", log, fmu]
    done = subprocess.run([CHECKER, *map(str, words)], capture_output=True, text=True, check=False)
    said = log.read_text()
    assert done.returncode == 0, said
    assert "[FATAL]" not in said
    assert "[ERROR]" not in said
    with out.open() as file:
        rows = list(csv.DictReader(file))
    assert float(rows[-1]["t_release"]) == pytest.approx(reference("A"), rel=2e-7)
