"""FMU files: what is in them, that they are the same every time, and that they run anywhere."""

from __future__ import annotations

import json
import os
import shutil
import subprocess
import sys
import tempfile
import zipfile
from pathlib import Path

import fmpy
import pytest

from contactkit.errors import ContactkitError, DescriptionError
from contactkit.fmu.python import build as building
from contactkit.fmu.python.build import build, validate


def unzip(path, folder):
    with zipfile.ZipFile(path) as packed:
        packed.extractall(folder)
    return folder


def test_fmpy_finds_no_problems(toy_fmu):
    assert validate(toy_fmu) == []


@pytest.mark.slow
@pytest.mark.parametrize("start", [None, {"tau": 0.2}])
def test_rebuild_is_byte_identical(toy_module, tmp_path, monkeypatch, start):
    first = build("toy", tmp_path / "one.fmu", start=start).read_bytes()
    (tmp_path / "a b").mkdir()
    monkeypatch.chdir(tmp_path / "a b")
    assert build("toy", tmp_path / "a b", start=start).read_bytes() == first
    assert (tmp_path / "a b" / "toy.fmu").exists()
    assert build("toy", "two.fmu", start=start).read_bytes() == first


def test_source_date_epoch_is_the_only_date(toy_module, toy_fmu, tmp_path, monkeypatch):
    with zipfile.ZipFile(toy_fmu) as packed:
        assert b"generationDateAndTime" not in packed.read("modelDescription.xml")
    monkeypatch.setenv("SOURCE_DATE_EPOCH", "86400")
    with zipfile.ZipFile(build("toy", tmp_path / "toy.fmu")) as packed:
        assert b'generationDateAndTime="1970-01-02T00:00:00Z"' in packed.read(
            "modelDescription.xml"
        )


def test_start_values_are_baked_in_exactly(toy_module, tmp_path):
    third = 1 / 3
    start = {"tau": "200 ms", "gain": third, "mode": "HOLD", "warm": "20 degC", "n": 4}
    path = build("toy", tmp_path / "toy.fmu", start=start)
    read = {v.name: v.start for v in fmpy.read_model_description(str(path)).modelVariables}
    assert float(read["gain"]) == third
    assert float(read["tau"]) == 0.2
    assert (read["mode"], read["n"], read["warm"]) == ("2", "4", "293.15")


@pytest.mark.parametrize(
    ("start", "message"),
    [
        ({"gian": 1.0}, "port must be a variable of this FMU, got 'gian'; did you mean 'gain'"),
        ({"gain": 6.0}, "gain must be a finite number at least -5 and at most 5, got 6.0"),
        ({"tau": 0.0}, r"tau must be a finite number above 0 \[s\], got 0.0"),
        ({"tau": float("nan")}, r"tau must be a finite number above 0 \[s\], got nan"),
        ({"tau": "1 m"}, "tau must be in a unit that converts to s, got '1 m'"),
        ({"mode": "LAGG"}, r"mode must be 1 \(LAG\) or 2 \(HOLD\) or 4 \(BREAK\), got 'LAGG'"),
        ({"mode": 3}, r"mode must be 1 \(LAG\) or 2 \(HOLD\) or 4 \(BREAK\), got 3"),
        ({"n": 1.5}, "n must be a whole number at least 0 and at most 9, got 1.5"),
        ({"on": 1}, "on must be true or false, got 1"),
        ({"y": 1.0}, "y must be left to the model, because it is an output, got 1.0"),
    ],
)
def test_impossible_start_values_are_refused(toy_module, tmp_path, start, message):
    with pytest.raises(DescriptionError, match=message):
        build("toy", tmp_path / "toy.fmu", start=start)
    assert list(tmp_path.iterdir()) == []


def test_file_must_be_called_fmu(toy_module, tmp_path):
    with pytest.raises(DescriptionError, match=r"out must end in \.fmu or be a folder"):
        build("toy", tmp_path / "new folder")
    assert list(tmp_path.iterdir()) == []


def test_unknown_fmu_is_refused(tmp_path):
    with pytest.raises(DescriptionError, match="FMU must be one of stiction-mass, valve-drive"):
        build("stiction", tmp_path / "x.fmu")


def test_missing_packages_name_the_extra(toy_module, toy_fmu, tmp_path, monkeypatch):
    monkeypatch.setattr(building.importlib.util, "find_spec", lambda name: None)
    for call in (lambda: build("toy", tmp_path / "toy.fmu"), lambda: validate(toy_fmu)):
        with pytest.raises(ContactkitError, match=r"pip install contactkit\[fmu\]"):
            call()


def test_failing_build_leaves_nothing(toy_module, tmp_path, monkeypatch):
    folder = tmp_path / "tmp"
    folder.mkdir()
    monkeypatch.setattr(tempfile, "tempdir", str(folder))
    monkeypatch.setattr(building, "_SCRIPT", building._SCRIPT + "1 / 0\n")
    with pytest.raises(ContactkitError, match=r"could not build 'toy'(.|\n)*ZeroDivisionError"):
        build("toy", tmp_path / "out" / "toy.fmu")
    assert list(folder.iterdir()) == []
    assert not (tmp_path / "out").exists()


def test_failing_repack_leaves_the_old_file(toy_module, tmp_path, monkeypatch):
    path = tmp_path / "toy.fmu"
    path.write_text("old")
    monkeypatch.setattr(os, "replace", lambda source, target: 1 / 0)
    with pytest.raises(ZeroDivisionError):
        build("toy", path)
    assert [(p.name, p.read_text()) for p in tmp_path.iterdir()] == [("toy.fmu", "old")]


def test_build_leaves_no_trace_in_this_process(toy_module, tmp_path, monkeypatch):
    folder = tmp_path / "tmp"
    folder.mkdir()
    monkeypatch.setattr(tempfile, "tempdir", str(folder))
    before = list(sys.path), set(sys.modules)
    build("toy", tmp_path / "toy.fmu", start={"gain": 4.5})
    assert list(folder.iterdir()) == []
    assert sys.path == before[0]
    assert {
        m for m in set(sys.modules) - before[1] if m.startswith(("contactkit_", "toy"))
    } == set()


def test_documentation_and_licences_travel_along(toy_fmu, tmp_path):
    folder = unzip(toy_fmu, tmp_path) / "documentation"
    page = (folder / "index.html").read_text()
    assert "<td>tau</td><td>s</td><td>ms</td>" in page
    assert "time constant &lt;s&gt; &amp; more" in page
    assert "a finite number above 0" in page
    texts = {path.name: path.read_text() for path in (folder / "licenses").iterdir()}
    assert "BSD 3-Clause" in texts["license.txt"]
    assert "MIT" in texts["attrs.txt"]
    assert "MIT" in texts["pythonfmu.txt"]


def test_zip_entries_are_sorted_and_timeless(toy_fmu):
    with zipfile.ZipFile(toy_fmu) as packed:
        entries = packed.infolist()
    assert [e.filename for e in entries] == sorted(e.filename for e in entries)
    assert {e.date_time for e in entries} == {(1980, 1, 1, 0, 0, 0)}
    assert {e.compress_type for e in entries} == {zipfile.ZIP_DEFLATED}
    assert toy_fmu.stat().st_mode & 0o777 == 0o644


def test_simulates_in_fmpy(toy_fmu):
    import math

    result = fmpy.simulate_fmu(
        str(toy_fmu), stop_time=1.0, output_interval=0.1, start_values={"u": 8.0, "tau": 0.2}
    )
    assert len(result) == 11
    assert result["y"][-1] == pytest.approx(-8.0 * math.expm1(-1.0 / 0.2), rel=1e-14)


@pytest.mark.slow
def test_builds_of_one_fmu_live_side_by_side(toy_module, tmp_path, open_fmu):
    paths = [build("toy", tmp_path / f"{g}.fmu", start={"gain": g}) for g in (1.0, 2.0, 3.0)]
    assert len({fmpy.read_model_description(str(p)).guid for p in paths}) == 3
    hosts = [open_fmu(path).start(u=1.0) for path in paths]
    for host in hosts:
        assert host.step() == 0
    assert [host.get("twice") for host in hosts] == [2.0, 4.0, 6.0]


def test_builds_of_different_code_live_side_by_side(
    toy_module, load_as_fmu_module, tmp_path, open_fmu, monkeypatch
):
    other = tmp_path / "toy_slave.py"
    other.write_text(
        Path(toy_module.__file__).read_text().replace("2.0 * self.law.gain", "7.0 * self.law.gain")
    )
    paths = [build("toy", tmp_path / "old.fmu")]
    monkeypatch.setitem(sys.modules, "contactkit.fmu.slaves.toy_slave", toy_module)
    load_as_fmu_module(other, "toy_slave")
    paths.append(build("toy", tmp_path / "new.fmu"))
    hosts = [open_fmu(path).start(u=1.0) for path in paths]
    assert [host.step() for host in hosts] == [0, 0]
    assert [host.get("twice") for host in hosts] == [2.0, 7.0]


def test_changed_code_is_refused_when_instantiated(toy_fmu, tmp_path, open_fmu):
    folder = tmp_path / "changed"
    fmpy.extract(str(toy_fmu), str(folder))
    (slave,) = folder.glob("resources/contactkit_*/fmu/slaves/toy_slave.py")
    slave.write_text(slave.read_text() + "\n")
    with pytest.raises(Exception, match="Failed to instantiate"):
        open_fmu(toy_fmu, folder)


@pytest.mark.slow
def test_many_instances_one_after_another(toy_fmu, open_fmu):
    """Without a function of its own pythonfmu would free the script's namespace here."""
    for _ in range(20):
        host = open_fmu(toy_fmu).start(u=1.0)
        assert host.step() == 0
        host.reset()


def test_unpacked_folder_may_vanish_and_come_back_elsewhere(toy_fmu, tmp_path):
    """Python keeps the modules of the first folder; what they import later comes from the next."""
    for number, u in enumerate((1.0, 17.0)):  # 17 imports one more module
        folder = unzip(toy_fmu, tmp_path / f"place {number}")
        result = fmpy.simulate_fmu(str(folder), stop_time=0.2, start_values={"u": u})
        assert result["time"][-1] == pytest.approx(0.2)
        shutil.rmtree(folder)


_DRIVE = """
import sys
resources, main = sys.argv[1:]
assert not [p for p in sys.path if "site-packages" in p], sys.path
sys.path.insert(0, resources)
module = __import__(main)
toy = module.Toy(instance_name="bare", resources=resources)
toy.setup_experiment(0.0)
toy.set_real([1], [8.0])
toy.enter_initialization_mode()
toy.exit_initialization_mode()
assert toy.do_step(0.0, 0.1), toy.failure
assert toy.to_xml().get("modelName") == "Toy"
import json
print(json.dumps({"y": toy.get_real([4])[0]}))
"""


def test_runs_with_the_standard_library_only(toy_fmu, tmp_path):
    resources = unzip(toy_fmu, tmp_path / "a bare place") / "resources"
    (main,) = (path.stem for path in resources.glob("toy_slave_*.py"))
    done = subprocess.run(
        [sys.executable, "-I", "-S", "-W", "error", "-c", _DRIVE, str(resources), main],
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.returncode == 0, done.stderr
    answer = json.loads(done.stdout)
    assert answer["y"] == pytest.approx(8.0 * (1 - 0.36787944117144233), rel=1e-14)


@pytest.mark.parametrize("imported", [True, False])
def test_another_attrs_of_the_host_is_of_no_concern(toy_fmu, tmp_path, imported):
    """attrs 20.2 on the path of the host, which has no `attrs`; or one that is loaded already."""
    resources = unzip(toy_fmu, tmp_path / "fmu") / "resources"
    other = tmp_path / "other" / "attr"
    other.mkdir(parents=True)
    (other / "__init__.py").write_text("__version__ = '20.2.0'\n")
    (main,) = (path.stem for path in resources.glob("toy_slave_*.py"))
    drive = f"import sys\nsys.path.insert(0, {str(other.parent)!r})\n" + "import attr\n" * imported
    check = "\nimport attr\nassert attr.__version__ == '20.2.0'"
    done = subprocess.run(
        [sys.executable, "-I", "-S", "-c", drive + _DRIVE + check, str(resources), main],
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.returncode == 0, done.stderr


def test_hash_in_the_name_is_that_of_the_content(toy_fmu, tmp_path):
    from contactkit.fmu.python.integrity import content_hash

    resources = unzip(toy_fmu, tmp_path) / "resources"
    (package,) = resources.glob("contactkit_*")
    sources = {p.relative_to(package).as_posix(): p.read_bytes() for p in package.rglob("*.py")}
    record = json.loads((resources / "build.json").read_text())
    assert package.name == f"contactkit_{content_hash(record, sources)[:12]}"
