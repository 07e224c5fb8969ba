"""CSV files hold numbers and texts, and nothing that a spreadsheet would calculate."""

from __future__ import annotations

import csv

import pytest
from hypothesis import given
from hypothesis import strategies as st

import contactkit as ck
from contactkit.files.csv_rows import csv_line, text_cell, write_rows

pytestmark = pytest.mark.errors

FORMULAS = ["=cmd|' /C calc'!A0", "@SUM(1)", "+1+1", "-1+cmd", "=HYPERLINK(0)", " =1", "\t=1", "'a"]
PLAIN = ["-1.5e-3", "+3", "1e5", "nan", "-inf", "-", "", "peak_force [N]", "loading.force", "a=b"]


@pytest.mark.parametrize("text", FORMULAS)
def test_a_text_that_begins_as_a_formula_is_marked(text):
    assert text_cell(text) == f"'{text}"


@pytest.mark.parametrize("text", PLAIN)
def test_numbers_and_other_texts_stay_as_they_are(text):
    assert text_cell(text) == text


@given(st.lists(st.text(alphabet="=+-@'\t a1,\"\n", max_size=6), min_size=1, max_size=4))
def test_a_reader_that_takes_off_one_mark_has_the_texts(texts):
    (cells,) = csv.reader([csv_line(texts)], strict=True) if "\n" not in "".join(texts) else [[]]
    for text, cell in zip(texts, cells, strict=False):
        assert cell in (text, f"'{text}")
        assert cell.removeprefix("'") == text or cell == text
        assert (cell != text) == (text_cell(text) != text)
        assert cell[:1] not in ("=", "@", "\t") or cell == text == "-"


def test_columns_of_a_study_come_back_by_their_names(tmp_path):
    face = ck.Flat(radius=1e-3)
    scene = ck.SeparationScene(
        interface=ck.Interface(
            lower=face,
            upper=face,
            meniscus=ck.Meniscus(
                liquid=ck.Liquid(name="=1+1", viscosity=0.1, surface_tension=0.03), volume=1e-11
            ),
        ),
        loading=ck.ImposedTime(time=1e-3, initial_gap=4e-6, final_gap=1e-5),
        effects=(ck.ViscousForce(),),
    )
    other = ck.Liquid(name="@SUM(1)", viscosity=0.2, surface_tension=0.03)
    liquids = [scene.interface.meniscus.liquid, other]
    vary = {"interface.meniscus.liquid": liquids}
    found = ck.study(scene, vary, ck.Accuracy(points=5))
    streamed = ck.stream_study(scene, vary, tmp_path / "a", ck.Accuracy(points=5))
    for path in (found.save_csv(tmp_path / "found"), streamed.save_csv(tmp_path / "streamed")):
        head, *rows = csv.reader(path.read_text(encoding="utf-8").splitlines())
        assert set(head) == {*(f"{n} [{found.units[n]}]" for n in found.units), "status", "message"}
        assert [row[0] for row in rows] == ["'=1+1", "'@SUM(1)"]
        at = head.index("viscous_impulse [N.s]")
        assert float(rows[1][at]) == pytest.approx(2.0 * float(rows[0][at]), rel=1e-9)


def test_a_file_of_rows_is_written_whole(tmp_path):
    path = write_rows(tmp_path / "a.csv", ["=a", "b, c"], [["@x", -1.5], ["y", 2]])
    assert path.read_bytes() == b"'=a,\"b, c\"\n'@x,-1.5\ny,2\n"
