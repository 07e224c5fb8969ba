"""Files of others, which no command replaces without being told."""

from __future__ import annotations

import json
import zipfile

import pytest

from contactkit.cli import main

SCENE = """\
effects = [{ effect = "viscous-force" }]
[interface]
lower = { shape = "flat", radius = "3 mm" }
upper = { shape = "flat" }
meniscus = { liquid = "water", volume = "0.1 mm3" }
[loading]
kind = "imposed-speed"
initial_gap = "5 um"
final_gap = "50 um"
speed = "1 mm/s"
[study]
"loading.speed" = ["1 mm/s", "2 mm/s"]
"""


@pytest.fixture
def scene(tmp_path):
    path = tmp_path / "film.toml"
    path.write_text(SCENE)
    return path


@pytest.fixture
def out(tmp_path):
    return tmp_path / "out"


@pytest.fixture(autouse=True)
def _without_pictures(monkeypatch):
    """Pictures take most of the time, and are files like others."""
    monkeypatch.setattr("contactkit.app.run.draw_result", lambda *_: [])
    for module in ("run", "study"):
        monkeypatch.setattr(f"contactkit.app.{module}.draw_study", lambda *_: None)


def command(name, scene, out, *more):
    return main([name, str(scene), "--out", str(out), *more])


def record(out):
    return json.loads((out / "contactkit.json").read_text())


def test_a_command_runs_twice_and_beside_others_of_its_scene(scene, out, capsys):
    assert [command("run", scene, out) for _ in range(2)] == [0, 0]
    assert command("study", scene, out) == 0
    assert command("run", scene, out, "--set", "loading.speed=2 mm/s") == 0
    found = record(out)
    assert {name: one[0] for name, one in found["files"].items()} == {
        **dict.fromkeys(("result.csv", "result.npz"), "run"),
        **dict.fromkeys(("study.csv", "study.npz"), "run"),  # a run includes the study of its file
    }
    assert found["scene"] == "../film.toml"
    assert found["printed"]["run"]["settings"] == ["loading.speed=2 mm/s"]
    assert set(found["printed"]) == {"run", "study"}


def test_the_scene_is_known_from_any_folder_and_after_a_change(scene, out, monkeypatch):
    assert command("run", scene, out) == 0
    scene.write_text(SCENE.replace("0.1 mm3", "0.2 mm3"))
    monkeypatch.chdir(scene.parent)
    assert main(["run", scene.name, "--out", out.name]) == 0


@pytest.mark.parametrize("name", ["run", "study"])
def test_files_of_others_stay(scene, out, capsys, name):
    out.mkdir()
    mine = out / "result.csv"
    mine.write_text("mine")
    (out / "notes.txt").write_text("of no kind that is written")
    assert command(name, scene, out) == 2
    assert "it has result.csv, which this scene did not write" in capsys.readouterr().err
    assert {path.name for path in out.iterdir()} == {"result.csv", "notes.txt"}
    assert mine.read_text() == "mine"
    assert command(name, scene, out, "--overwrite") == 0
    # A study writes no result: the file is still that of others.
    assert command(name, scene, out) == (0 if name == "run" else 2)


def test_a_file_changed_since_stays(scene, out, capsys):
    assert command("run", scene, out) == 0
    table = out / "result.csv"
    table.write_text("edited")
    assert command("run", scene, out) == 2
    assert "it has result.csv, changed since contactkit wrote it" in capsys.readouterr().err
    assert table.read_text() == "edited"
    assert command("run", scene, out, "--overwrite") == 0
    assert table.read_text() != "edited"


def test_a_folder_belongs_to_its_scene(scene, out, tmp_path, capsys):
    assert command("run", scene, out) == 0
    other = tmp_path / "other.toml"
    other.write_text(SCENE)
    before = (out / "result.npz").read_bytes()
    assert command("run", other, out) == 2
    assert "its files are those of ../film.toml" in capsys.readouterr().err
    assert (out / "result.npz").read_bytes() == before
    assert command("run", other, out, "--overwrite") == 0
    assert record(out)["scene"] == "../other.toml"
    for path in out.glob("*.*"):
        path.unlink()
    assert command("run", scene, out) == 0


def test_what_a_run_wrote_before_it_failed_is_its_own(scene, out, monkeypatch, capsys):
    def broken(*_):
        raise KeyboardInterrupt

    monkeypatch.setattr("contactkit.app.run.write_study", broken)
    assert command("run", scene, out) == 130
    assert set(record(out)["files"]) == {"result.npz", "result.csv"}
    monkeypatch.undo()
    assert command("run", scene, out, "--quiet") == 0


def test_a_record_that_cannot_be_read_is_refused(scene, out, capsys):
    assert command("run", scene, out) == 0
    (out / "contactkit.json").write_text("{")
    assert command("run", scene, out) == 2
    assert "be a record of contactkit" in capsys.readouterr().err
    assert command("run", scene, out, "--overwrite") == 0


def test_a_new_scene_file_replaces_none(tmp_path, capsys):
    path = tmp_path / "my.toml"
    words = ["new", "separation", "--out", str(path)]
    assert main(words) == 0
    assert capsys.readouterr().out == f"written: {path}\n"
    text = path.read_text()
    assert main(words) == 2
    assert "contactkit did not write it" in capsys.readouterr().err
    path.write_text("mine")
    assert main([*words, "--overwrite"]) == 0
    assert path.read_text() == text
    assert main(["new", "separation", "--out", "my.txt"]) == 2


def fmu(path, *more):
    return main(["fmu", "build", "stiction-mass", "--out", str(path), *more])


@pytest.mark.slow
def test_an_fmu_replaces_only_fmus_of_contactkit(tmp_path, capsys):
    pytest.importorskip("pythonfmu")
    path = tmp_path / "film.fmu"
    with zipfile.ZipFile(path, "w") as packed:
        packed.writestr("modelDescription.xml", '<fmi generationTool="another"/>')
    before = path.read_bytes()
    assert fmu(path) == 2
    assert "contactkit did not write it" in capsys.readouterr().err
    assert path.read_bytes() == before
    assert [fmu(path, "--overwrite"), fmu(path)] == [0, 0]
    for text in (b"", b"no archive", before[:40]):
        path.write_bytes(text)
        assert fmu(path) == 2
        assert path.read_bytes() == text


@pytest.mark.slow
def test_start_values_of_an_fmu_are_set_by_name_or_path(tmp_path, scene, capsys):
    fmpy = pytest.importorskip("fmpy")

    def mass(*words):
        path = tmp_path / "film.fmu"
        assert main(["fmu", "build", *words, "--out", str(path)]) == 0
        description = fmpy.read_model_description(str(path), validate=False)
        return float(next(v.start for v in description.modelVariables if v.name == "m"))

    text = 'speed = "1 mm/s"'
    scene.write_text(SCENE.replace("imposed-speed", "imposed-force").replace(text, 'force="1 N"'))
    scene.write_text(
        scene.read_text().replace("[study]", "mass = '20 g'").rpartition('"loading')[0]
    )
    assert mass("stiction-mass", "--set", "m=25 g") == 0.025
    assert mass(str(scene), "--set", "loading.mass=30 g") == 0.03
    assert main(["fmu", "build", "stiction-mass", "--set", "n=1", "--out", "a.fmu"]) == 2
    assert "n" in capsys.readouterr().err


def test_a_native_fmu_by_name_takes_values_of_its_tables(tmp_path, monkeypatch):
    """Those of the film, which are no variables of a native FMU, and those that are."""
    built = []

    def note(film, out, **more):
        built.append((film, more["start"]))
        raise KeyboardInterrupt  # before the compiler

    monkeypatch.setattr("contactkit.fmu.native.build.build_native", note)
    words = ["--native", "--set", "R=2 mm", "--set", "m=25 g", "--out", str(tmp_path / "a.fmu")]
    assert main(["fmu", "build", "stiction-mass", *words]) == 130
    ((film, start),) = built
    assert film.interface.lower.surface.radius == 2e-3
    assert film.loading.mass == start.get("m", film.loading.mass) == 0.025


def test_a_gallery_replaces_no_file_of_others(tmp_path, capsys):
    index = tmp_path / "index.md"
    index.write_text("mine")
    assert main(["gallery", "2.1b", "--quick", "--out", str(tmp_path)]) == 2
    assert "it has index.md" in capsys.readouterr().err
    assert index.read_text() == "mine"
