"""Files of studies that were made to do harm, and files of others, which are left as they are."""

from __future__ import annotations

import sqlite3
import tracemalloc

import pytest

import contactkit as ck
from contactkit.cli import main
from contactkit.errors import DescriptionError
from contactkit.studies.run import Done
from contactkit.studies.store import StudyPoint
from contactkit.studies.stream import check_axes
from contactkit.studies.study_file import StudyWriter

pytestmark = pytest.mark.errors

QUICK = ck.Accuracy(points=5)
VARY = {"loading.time": [1e-3, 2e-3, 4e-3]}


def film():
    face = ck.Flat(radius=1e-3)
    oil = ck.Liquid(name="oil", viscosity=0.1, surface_tension=0.03)
    return ck.SeparationScene(
        interface=ck.Interface(
            lower=face, upper=face, meniscus=ck.Meniscus(liquid=oil, volume=1e-11)
        ),
        loading=ck.ImposedTime(time=1e-3, initial_gap=4e-6, final_gap=1e-5),
        effects=(ck.ViscousForce(),),
    )


@pytest.fixture
def path(tmp_path):
    return ck.stream_study(film(), VARY, tmp_path / "oil", QUICK).path


def change(path, *statements):
    base = sqlite3.connect(path)
    with base:
        for one in statements:
            base.execute(one)
    base.close()


def everything(path):
    """Read all that a file of a study holds."""
    found = ck.StudyFile(path)
    columns = [found.column(name) for name in (*found.units, "status")]
    rows = list(found.failed())
    found.save_csv(path.with_suffix(".csv"))
    ck.stream_study(film(), VARY, path, QUICK)
    return columns, rows


BOMBS = {
    "generated": (
        ["ALTER TABLE points ADD COLUMN z REAL GENERATED ALWAYS AS (hex(zeroblob(400000000)))"],
        "its column 'z' is computed",
    ),
    "generated-status": (
        [
            "ALTER TABLE points RENAME COLUMN status TO old",
            "ALTER TABLE points ADD COLUMN status AS (hex(zeroblob(400000000))) VIRTUAL",
        ],
        "its column 'status' is computed",
    ),
    "generated-unit": (
        ["ALTER TABLE units ADD COLUMN z AS (hex(zeroblob(400000000)))"],
        "its column 'z' is computed",
    ),
    "default": (["ALTER TABLE points ADD COLUMN z TEXT DEFAULT 'x'"], "its column 'z' is computed"),
    "index": (
        ["CREATE INDEX i ON points (status)"],
        "it holds a index 'i'",
    ),
    "trigger": (
        ["CREATE TRIGGER t AFTER DELETE ON points BEGIN SELECT 1; END"],
        "it holds a trigger 't'",
    ),
    "table": (["CREATE TABLE photos (a)"], "it holds a table 'photos'"),
    "virtual": (
        ["DROP TABLE units", "CREATE VIRTUAL TABLE units USING fts5(name, unit)"],
        "units",
    ),
}


@pytest.mark.parametrize("name", BOMBS)
def test_a_schema_that_is_not_ours_is_refused_unread(path, name):
    statements, message = BOMBS[name]
    try:
        change(path, *statements)
    except sqlite3.OperationalError as error:
        pytest.skip(f"this SQLite cannot: {error}")
    tracemalloc.start()
    with pytest.raises(DescriptionError, match=message):
        everything(path)
    assert tracemalloc.get_traced_memory()[1] < 1e7
    tracemalloc.stop()
    with pytest.raises(DescriptionError, match="be a new file, or that of the same study"):
        ck.stream_study(film(), VARY, path, QUICK)


@pytest.mark.parametrize("column", ["message", "status", "notes"])
def test_a_text_of_a_row_has_a_length(path, column, monkeypatch):
    text = "hex(zeroblob(1000000))"
    change(path, f"UPDATE points SET {column} = {text}, status = 'failed' WHERE place = 1")
    if column == "status":
        change(path, f"UPDATE points SET status = {text} WHERE place = 1")
    if column == "notes":
        change(path, "UPDATE points SET notes = 'ValidityWarning: ' || notes WHERE place = 1")
    with pytest.raises(DescriptionError) as caught:
        everything(path)
    assert "have texts and rows of at most 1 MiB" in str(caught.value)
    assert "raise CONTACTKIT_MAX_CELL_BYTES" in str(caught.value)
    monkeypatch.setenv("CONTACTKIT_MAX_CELL_BYTES", "4e6")
    if column != "status":
        assert len(list(ck.StudyFile(path).failed())) == 1


def test_a_status_is_not_cut(path):
    change(path, "UPDATE points SET status = 'a-status-of-many-letters' WHERE place = 1")
    with pytest.raises(DescriptionError, match="a status of 24 letters"):
        ck.StudyFile(path).column("status")


def test_a_long_message_is_cut_when_it_is_written(tmp_path):
    varied, sources = check_axes(film(), VARY, QUICK)
    failed = StudyPoint({}, {}, "failed", "m" * 10**7, 0.0, notes=("n" * 10**7,))
    with StudyWriter(tmp_path / "a", film(), QUICK, varied, sources) as writer:
        writer.write([Done(0, failed, None)])
    (row,) = ck.StudyFile(tmp_path / "a").failed()
    assert row.message == "m" * 10_000


# Files of others ------------------------------------------------------------------------------


def test_somebodys_database_is_left_alone(tmp_path, capsys):
    photos = tmp_path / "photos.sqlite"
    change(photos, "CREATE TABLE photos (name TEXT)", "INSERT INTO photos VALUES ('a')")
    before = photos.read_bytes()
    with pytest.raises(DescriptionError, match=r"'photos'.*give another file"):
        ck.stream_study(film(), VARY, photos, QUICK)
    scene = ck.save_scene(film(), tmp_path / "film.toml")
    scene.write_text(scene.read_text() + '[study]\n"loading.time" = [1e-3]\n')
    assert main(["study", str(scene), "--stream", str(photos)]) == 2
    assert "be a new file, or that of the same study" in capsys.readouterr().err
    assert photos.read_bytes() == before


def test_tables_like_ours_do_not_make_a_file_ours(path):
    change(path, "PRAGMA application_id = 0")
    before = path.read_bytes()
    with pytest.raises(DescriptionError, match="contactkit did not write it"):
        ck.stream_study(film(), VARY, path, QUICK)
    assert path.read_bytes() == before
    assert ck.StudyFile(path).n_done == 3  # as one of an earlier version


def test_an_empty_file_is_a_new_one(tmp_path):
    (tmp_path / "oil.sqlite").touch()
    assert ck.stream_study(film(), VARY, tmp_path / "oil", QUICK).n_done == 3


def test_a_full_disk_names_the_file_and_keeps_what_is_there(tmp_path, monkeypatch):
    varied, sources = check_axes(film(), VARY, QUICK)
    point = StudyPoint({}, {}, "curve", "", 0.0)
    with StudyWriter(tmp_path / "a", film(), QUICK, varied, sources) as writer:
        writer.write([Done(0, point, None)])
        writer._base.commit()
        writer._base.execute("PRAGMA max_page_count = 1")  # no page more than there are
        bulk = [Done(i, StudyPoint({}, {}, "failed", "m" * 9000, 0.0), None) for i in (1, 2)]
        with pytest.raises(OSError, match="full") as caught:
            writer.write(bulk)
    assert caught.value.filename == str(tmp_path / "a.sqlite")
    assert ck.StudyFile(tmp_path / "a").n_done >= 1
