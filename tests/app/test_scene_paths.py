"""Files that scene files name: found from the folder of the file, wherever the command runs."""

from __future__ import annotations

import os
from pathlib import Path

import numpy as np
import pytest

import contactkit as ck
from contactkit.app.scenes import open_scene
from contactkit.cli import main
from contactkit.reading.references import PROJECT_MARKS, references_from, resolved_references

# Few pixels, so that a test is fast.
pytestmark = pytest.mark.filterwarnings("ignore::contactkit.ValidityWarning")

SCENE = """
[interface]
lower = { solid = "glass-ceramic" }
upper = { shape = "measured", path = "PATH", pixel_size = "10 nm", unit = "nm", detrend = "none" }
[window]
periodic = true
[loading]
kind = "pressing"
pressure = "100 MPa"
[[effects]]
effect = "half-space"
"""


def write_map(path, factor=1.0):
    path.parent.mkdir(parents=True, exist_ok=True)
    heights = factor * np.cos(2.0 * np.pi * np.arange(16) / 16)
    np.save(path, heights[:, None] + heights[None, :])


def write_scene(path, name="map.npy", more=""):
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(SCENE.replace("PATH", name) + more)
    return path


@pytest.fixture
def bare(tmp_path, monkeypatch):
    """A folder without any mark of a project above it, apart from the working folder."""
    monkeypatch.delenv("CONTACTKIT_READ_FROM", raising=False)
    away = tmp_path / "away"
    away.mkdir()
    monkeypatch.chdir(away)
    return tmp_path / "work"


def fraction(scene):
    return ck.solve(ck.plan(scene, ck.Accuracy())).contact_fraction


def test_the_same_file_means_the_same_map_in_every_folder(bare, monkeypatch):
    path = write_scene(bare / "sub" / "m.toml")
    write_map(bare / "sub" / "map.npy")
    write_map(bare / "map.npy", factor=3.0)
    found = []
    for folder, name in (
        (path.parent, "m.toml"),
        (bare, "sub/m.toml"),
        (Path.cwd(), os.path.relpath(path)),
    ):
        monkeypatch.chdir(folder)
        found.append(fraction(ck.load_scene(name)))
        assert open_scene(name).scene.interface.upper.surface.path == str(
            path.parent.resolve() / "map.npy"
        )
    assert found == [found[0]] * 3
    assert found[0] > 1.3 * fraction(ck.load_scene(write_scene(bare / "m.toml")))


def test_check_finds_a_map_beside_its_scene_from_any_folder(bare, capsys):
    path = write_scene(bare / "m.toml")
    assert main(["check", str(path)]) == 2
    said = capsys.readouterr().err
    assert f"be a file that exists, got '{bare.resolve() / 'map.npy'}'" in said
    write_map(bare / "map.npy")
    assert main(["check", str(path)]) == 0


def test_a_scene_that_is_loaded_holds_when_the_folder_changes(bare, monkeypatch):
    write_map(bare / "map.npy")
    write_scene(bare / "m.toml")
    monkeypatch.chdir(bare)
    scene = ck.load_scene("m.toml")
    monkeypatch.chdir(bare.parent)
    assert fraction(scene) > 0.0


def test_a_map_of_the_working_folder_alone_is_refused_with_its_name(bare, monkeypatch):
    write_map(bare / "map.npy")
    write_scene(bare / "sub" / "m.toml")
    monkeypatch.chdir(bare)
    with pytest.raises(ck.errors.DescriptionError, match=r"from the folder of m\.toml") as caught:
        ck.load_scene("sub/m.toml")
    assert "write '../map.npy'" in str(caught.value)
    write_scene(bare / "sub" / "m.toml", "../map.npy")
    assert fraction(ck.load_scene("sub/m.toml")) > 0.0


@pytest.mark.parametrize("mark", PROJECT_MARKS)
def test_maps_may_lie_beside_the_scenes_of_a_project(bare, mark):
    path = write_scene(bare / "scenes" / "m.toml", "../data/map.npy")
    write_map(bare / "data" / "map.npy")
    with pytest.raises(ck.errors.DescriptionError, match="folder of its project") as caught:
        ck.load_scene(path)
    assert f"put an empty {PROJECT_MARKS[0]} into {bare.resolve()}, or set" in str(caught.value)
    (bare / mark).touch()
    scene = ck.load_scene(path)
    assert scene.interface.upper.surface.path == str(bare.resolve() / "data" / "map.npy")
    write_scene(path, "../../other/map.npy")
    with pytest.raises(ck.errors.DescriptionError, match="folder of its project"):
        ck.load_scene(path)


def test_a_home_folder_is_no_project(bare, monkeypatch):
    monkeypatch.setenv("HOME", str(bare))
    monkeypatch.setenv("USERPROFILE", str(bare))
    path = write_scene(bare / "scenes" / "m.toml", "../data/map.npy")
    (bare / ".git").mkdir()
    with pytest.raises(ck.errors.DescriptionError, match="folder of its project") as caught:
        ck.load_scene(path)
    assert "if it is meant, set CONTACTKIT_READ_FROM=" in str(caught.value)


def test_a_study_names_its_maps_from_the_folder_of_its_file(bare):
    more = '[study]\n"interface.upper.surface.path" = ["map.npy", "other.npy"]\n'
    path = write_scene(bare / "m.toml", more=more)
    write_map(bare / "map.npy")
    write_map(bare / "other.npy", factor=3.0)
    opened = open_scene(str(path))
    found = ck.study(opened.scene, opened.parameters, opened.accuracy)
    one, other = found.column("contact_fraction")
    assert one > 1.3 * other
    assert [text.split()[-1] for text in found.table().splitlines()[1:3]] == ["converged"] * 2
    assert "map.npy" in found.table()
    assert "other.npy" in found.table()


def test_values_that_vary_together_keep_their_texts(tmp_path):
    given = {"study": {"upper.path, name": [["a.npy", "first"], ["b.npy", "second"]]}}
    rows = resolved_references(given, tmp_path / "m.toml")["study"]["upper.path, name"]
    folder = tmp_path.resolve()
    assert rows == [[str(folder / "a.npy"), "first"], [str(folder / "b.npy"), "second"]]
    assert resolved_references({"path": ["a", 1, ["b"]]}, tmp_path / "m.toml")["path"][1] == 1


def test_the_store_knows_a_map_in_another_folder_by_its_content(bare):
    for folder in ("a", "b"):
        write_scene(bare / folder / "m.toml")
        write_map(bare / folder / "map.npy")
    vary = {"loading.pressure": ["50 MPa"]}

    def solved(folder):
        scene = ck.load_scene(bare / folder / "m.toml")
        return ck.study(scene, vary, store=bare / "store").n_solved

    assert [solved("a"), solved("b")] == [1, 0]
    write_map(bare / "b" / "map.npy", factor=2.0)
    assert solved("b") == 1


def test_the_store_distinguishes_the_maps_of_two_bodies(bare):
    text = SCENE.replace(
        'lower = { solid = "glass-ceramic" }',
        'lower = { solid = "glass-ceramic", surface = { shape = "measured", path = "LOWER", '
        'pixel_size = "10 nm", unit = "nm", detrend = "tilt" } }',
    )
    write_map(bare / "one.npy")
    write_map(bare / "two.npy", factor=3.0)
    vary, found = {"loading.pressure": ["50 MPa"]}, []
    for lower, upper in (("one.npy", "two.npy"), ("two.npy", "one.npy")):
        (bare / "m.toml").write_text(text.replace("LOWER", lower).replace("PATH", upper))
        scene = ck.load_scene(bare / "m.toml")
        found.append(ck.study(scene, vary, store=bare / "store").n_solved)
    assert found == [1, 1]


# Saving ---------------------------------------------------------------------------------------


def test_a_scene_saved_to_another_folder_finds_its_map(bare, monkeypatch):
    write_map(bare / "a" / "map.npy")
    scene = ck.load_scene(write_scene(bare / "a" / "m.toml"))
    (bare / "contactkit.toml").touch()
    saved = ck.save_scene(scene, bare / "b" / "c" / "m.toml")
    assert 'path = "../../a/map.npy"' in saved.read_text()
    monkeypatch.chdir(bare.parent)
    assert ck.load_scene(saved) == scene
    assert 'path = "map.npy"' in ck.save_scene(scene, bare / "a" / "again.toml").read_text()


def test_a_path_of_the_working_folder_is_saved_so_that_it_holds(bare, monkeypatch):
    write_map(bare / "map.npy")
    write_scene(bare / "m.toml")
    monkeypatch.chdir(bare)
    made = ck.load_scene("m.toml")
    relative = ck.Measured(path=Path("map.npy"), pixel_size=1e-8, unit="nm", detrend="none")
    scene = ck.ContactScene(
        interface=ck.Interface(lower=made.interface.lower, upper=relative),
        window=made.window,
        loading=made.loading,
        effects=made.effects,
    )
    saved = ck.save_scene(scene, bare / "sub" / "m.toml")
    monkeypatch.chdir(bare.parent)
    with pytest.raises(ck.errors.DescriptionError, match="looked for in the working folder"):
        ck.plan(scene)
    (bare / "contactkit.toml").touch()
    assert ck.load_scene(saved) == made


def test_a_scene_is_not_saved_where_it_could_not_name_its_map(bare):
    write_map(bare / "a" / "map.npy")
    scene = ck.load_scene(write_scene(bare / "a" / "m.toml"))
    with pytest.raises(ck.errors.DescriptionError, match=r"b\.toml, path must be a file below"):
        ck.save_scene(scene, bare / "b" / "b.toml")
    assert not (bare / "b").exists()


def test_what_is_resolved_is_related_again(tmp_path):
    given = {"upper": {"path": "maps/a.npy"}, "faces": {"contact": "contact-stop"}}
    file = tmp_path / "m.toml"
    assert references_from(resolved_references(given, file), file) == given


def test_a_path_is_a_text_or_a_path():
    with pytest.raises(ck.errors.DescriptionError, match=r"Measured\.path must be the name"):
        ck.Measured(path=3)


# Devices --------------------------------------------------------------------------------------


def test_the_faces_of_a_device_bring_their_own_map(bare, monkeypatch):
    from contactkit.models.end_stop.faces import StopFaces
    from contactkit.models.end_stop.solve import solved

    write_map(bare / "faces" / "map.npy")
    write_scene(bare / "faces" / "c.toml")
    given = {"faces": {"contact": "faces/c.toml"}}
    tables = resolved_references(given, bare / "device.toml")
    curve = solved(StopFaces(contact=tables["faces"]["contact"]))
    assert curve.force[-1] > 0.0
    # A file of the working folder does not stand for a scene of contactkit.
    (Path.cwd() / "contact-stop").write_text("")
    assert resolved_references({"contact": "contact-stop"}, bare / "d.toml") == {
        "contact": "contact-stop"
    }
