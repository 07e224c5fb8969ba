"""A disk that is full takes away files, never the numbers that were computed."""

from __future__ import annotations

import errno
import json

import numpy as np
import pytest

from contactkit.cli import main
from contactkit.files import csv_rows
from contactkit.files.scenes import write_whole
from contactkit.models.library import bundled_scenes

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


def no_space(*_, **__):
    """What a full disk answers, without the name of the file."""
    raise OSError(errno.ENOSPC, "No space left on device")


@pytest.fixture
def scene(tmp_path):
    path = tmp_path / "film.toml"
    path.write_text(SCENE)
    return path


@pytest.fixture
def full(monkeypatch):
    """A disk that takes no npz file."""
    monkeypatch.setattr(np, "savez_compressed", no_space)


@pytest.mark.usefixtures("full")
def test_numbers_are_printed_before_the_files_are_written(scene, tmp_path, capsys):
    out = tmp_path / "out"
    assert main(["run", str(scene), "--out", str(out)]) == 2
    said = capsys.readouterr()
    assert "viscous_impulse" in said.out
    assert "study" in said.out
    assert said.err.strip() == f"contactkit: No space left on device: {out / 'result.npz'}"
    assert list(out.iterdir()) == []


@pytest.mark.usefixtures("full")
def test_numbers_in_json_are_whole(scene, tmp_path, capsys):
    assert main(["run", str(scene), "--out", str(tmp_path / "out"), "--json"]) == 2
    assert json.loads(capsys.readouterr().out)["viscous_impulse"]["value"] > 0.0


@pytest.mark.usefixtures("full")
def test_a_study_is_printed_and_what_was_written_is_recorded(scene, tmp_path, capsys):
    out = tmp_path / "out"
    assert main(["study", str(scene), "--out", str(out)]) == 2
    said = capsys.readouterr()
    assert said.out.count("curve") == 2
    assert "study.npz" in said.err
    written = json.loads((out / "contactkit.json").read_text())["files"]
    assert list(written) == ["study.csv"]


def test_every_kind_of_report_writes_last(monkeypatch, tmp_path, capsys):
    monkeypatch.setattr(csv_rows, "write_whole", no_space)
    path = bundled_scenes()["bridges"]
    assert main(["run", str(path), "--out", str(tmp_path / "out")]) == 2
    assert "largest error [%]" in capsys.readouterr().out


def test_a_disk_that_is_full_for_the_record_too_reports_the_first_file(
    scene, tmp_path, capsys, full
):
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr("contactkit.app.output.write_text", no_space)
        patch.setattr("contactkit.files.curves.save_npz", no_space)
        assert main(["study", str(scene), "--out", str(tmp_path / "out")]) == 2
    assert "No space left on device: a file" in capsys.readouterr().err


def test_a_file_that_cannot_be_written_is_named(tmp_path):
    path = tmp_path / "sub" / "a.csv"
    with pytest.raises(OSError, match="No space") as caught, write_whole(path):
        no_space()
    assert caught.value.filename == str(path)
    with pytest.raises(OSError, match="No such") as caught, write_whole(path) as temporary:
        temporary.read_text()
    assert caught.value.filename == str(path)
    with pytest.raises(OSError, match="No such") as caught, write_whole(path):
        (tmp_path / "other").read_text()
    assert caught.value.filename == str(tmp_path / "other")
    assert list(path.parent.iterdir()) == []


@pytest.mark.usefixtures("full")
def test_points_that_cannot_be_stored_are_kept(scene, tmp_path, capsys):
    def fails(*_):
        no_space()

    with pytest.MonkeyPatch.context() as patch:
        patch.setattr("contactkit.studies.store.write_whole", fails)
        assert main(["study", str(scene), "--store", str(tmp_path / "store")]) == 0
    said = capsys.readouterr().out
    assert said.count("curve") == 2
    assert "point 0 and 1 more: not stored: No space left on device" in said
