"""Reference files: they are what the code writes, and a native FMU in fmpy follows them."""

from __future__ import annotations

import zipfile
from pathlib import Path

import numpy as np
import pytest
from native_scenes import HAS_CC
from scipy.interpolate import CubicHermiteSpline
from selection import quick

fmpy = pytest.importorskip("fmpy")

from fmpy.util import read_ref_opt_file  # noqa: E402

from contactkit import cli  # noqa: E402
from contactkit.app.crosscheck import CASES, write_crosscheck  # noqa: E402
from contactkit.errors import DescriptionError  # noqa: E402
from contactkit.fmu.framework.toolchain import local  # noqa: E402
from contactkit.fmu.native.build import build_native  # noqa: E402

pytestmark = pytest.mark.slow

KEPT = Path(__file__).parents[2] / "examples" / "crosscheck"
ONE = {"platforms": [local()], "compiler": "cc"}


def table(path):
    return np.genfromtxt(path, delimiter=",", names=True)


@pytest.fixture(scope="module")
def made(tmp_path_factory):
    folder = tmp_path_factory.mktemp("crosscheck")
    assert cli.main(["fmu", "crosscheck", "--out", str(folder), "--no-fmu"]) == 0
    return folder


def test_the_files_kept_are_those_the_code_writes(made):
    names = sorted(path.name for path in made.iterdir() if path.name != "contactkit.json")
    assert names == sorted(path.name for path in KEPT.iterdir() if path.suffix in (".csv", ".opt"))
    for name in names:
        if name.endswith(".opt"):
            assert (made / name).read_text() == (KEPT / name).read_text()
            continue
        new, old = table(made / name), table(KEPT / name)
        assert new.dtype.names == old.dtype.names
        for column in new.dtype.names:
            size = np.max(np.abs(old[column]))
            np.testing.assert_allclose(new[column], old[column], rtol=1e-7, atol=1e-8 * size)


@pytest.mark.parametrize("name", CASES)
def test_the_files_are_as_the_rules_ask(name):
    reference = KEPT / f"{name}_ref.csv"
    head = reference.read_text().splitlines()[0]
    assert all(word[0] == word[-1] == '"' for word in head.split(","))
    assert len(head.split(",")) <= 11  # time and ten signals
    assert reference.stat().st_size < 1_000_000
    options = read_ref_opt_file(KEPT / f"{name}_ref.opt")
    found, given = table(reference), table(KEPT / f"{name}_in.csv")
    for each in (found, given):
        assert each["time"][0] == options["StartTime"]
        assert each["time"][-1] == options["StopTime"]
        assert np.all(np.isfinite(each.view(np.float64)))
    np.testing.assert_allclose(np.diff(given["time"]), options["StepSize"], rtol=1e-6)


@pytest.mark.parametrize("name", CASES)
def test_the_references_pass_the_release_known_from_elsewhere(name, release_cases):
    case = release_cases[name[-1]]
    found = table(KEPT / f"{name}_ref.csv")
    path = CubicHermiteSpline(found["time"], found["h"], found["v"])
    opened = path.solve(case["case"]["h_rel"], extrapolate=False)[-1]
    assert opened == pytest.approx(case["values"]["t_rel"], rel=1e-5)
    assert found["J"][-1] == pytest.approx(case["values"]["J"], rel=5e-3)


@pytest.mark.skipif(not HAS_CC, reason="there is no C compiler")
@pytest.mark.parametrize("name", quick(CASES, 1))
def test_a_native_fmu_follows_its_reference(name, tmp_path):
    if name == "release_A":  # the others without their tables, which take a second each
        *_, fmu = write_crosscheck(tmp_path, names=[name], **ONE)
    else:
        fmu = build_native(CASES[name].scene(), tmp_path / f"{name}.fmu", **ONE)
    reference = table(KEPT / f"{name}_ref.csv")
    options = read_ref_opt_file(KEPT / f"{name}_ref.opt")
    signals = reference.dtype.names[1:]
    result = fmpy.simulate_fmu(
        str(fmu),
        input=table(KEPT / f"{name}_in.csv"),
        output=list(signals),
        stop_time=options["StopTime"],
        output_interval=options["StepSize"],
    )
    every = round((len(result) - 1) / (len(reference) - 1))
    np.testing.assert_allclose(result["time"][::every], reference["time"], atol=1e-12)
    for signal in signals:
        off = np.abs(result[signal][::every] - reference[signal])
        assert np.max(off) <= options["RelTol"] * np.max(np.abs(reference[signal])), signal
    with zipfile.ZipFile(fmu) as packed:
        assert "model.png" in packed.namelist()


def test_an_unknown_case_is_refused_before_anything_is_written(tmp_path):
    with pytest.raises(DescriptionError, match="case must be one of release_A, release_B"):
        write_crosscheck(tmp_path / "new", names=["release_A", "release_C"])
    assert list(tmp_path.iterdir()) == []
