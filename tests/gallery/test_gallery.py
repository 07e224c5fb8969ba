"""The gallery: its command, its data that are kept, its pages, and the pages themselves."""

from __future__ import annotations

import csv
import errno
import re
import textwrap
from pathlib import Path

import numpy as np
import pytest

from contactkit.app.gallery.scripts import chosen, digest, load, scripts
from contactkit.cli import main

ROOT = Path(__file__).parents[2]

PAGE = '''
    """A page."""
    from pathlib import Path
    import warnings
    import numpy as np
    from contactkit.app.gallery.page import Check, Page, Table
    from contactkit.plot import gallery as plot

    PAGE = Page(
        name="9.9", title="Squares", claim="They grow.", verdict="They do.", grid="3 points"
    )
    START = 1.0

    def points(n):
        return START + np.arange(float(n))

    def compute(draft=False):
        with open(Path(__file__).with_suffix(".runs"), "a") as runs:
            runs.write("x")
        warnings.warn("slope = 2")
        return {"x": points(2 if draft else 3)}

    def draw(data):
        figure, ax = plot.figure()
        ax.plot(data["x"], data["x"] ** 2)
        return figure

    def check(data):
        steps = np.diff(data["x"] ** 2)
        return [Check("squares grow", bool((steps > 0.0).all()), f"{steps}")]

    def table(data):
        return Table(("x", "square"), [(float(x), float(x) ** 2) for x in data["x"]])
'''


@pytest.fixture
def page(tmp_path):
    path = tmp_path / "squares.py"
    path.write_text(textwrap.dedent(PAGE))
    yield path
    import sys

    sys.modules.pop("gallery_page_squares", None)


def edited(page, old, new):
    import sys

    assert old in page.read_text()
    page.write_text(page.read_text().replace(old, new))
    sys.modules.pop("gallery_page_squares", None)


def gallery(page, out, *more):
    return main(["gallery", str(page), "--out", str(out), *more])


def runs(page):
    return len(page.with_suffix(".runs").read_text())


def test_a_page_has_its_files(page, tmp_path, capsys):
    out = tmp_path / "out"
    assert gallery(page, out) == 0
    assert "Fig. 9.9: 1 of 1 hold" in capsys.readouterr().out
    kinds = {"csv", "md", "npz", "pdf", "png", "svg"}
    assert {path.suffix[1:] for path in out.glob("squares.*")} == kinds
    text = (out / "squares.md").read_text()
    for words in (
        "Fig. 9.9: Squares",
        "They grow.",
        "They do.",
        "squares.png",
        "1 of 1 hold",
        "slope",
    ):
        assert words in text
    assert "Draft" not in text
    rows = list(csv.reader((out / "squares.csv").read_text().splitlines()))
    assert rows == [["x", "square"], ["1.0", "1.0"], ["2.0", "4.0"], ["3.0", "9.0"]]
    assert "(squares.md)" in (out / "index.md").read_text()


@pytest.mark.slow
def test_data_are_kept_until_their_code_changes(page, tmp_path):
    out = tmp_path / "out"
    gallery(page, out)
    gallery(page, out)
    edited(page, "ax.plot(", "ax.loglog(")  # drawing only
    gallery(page, out)
    assert runs(page) == 1
    edited(page, "START = 1.0", "START = 2.0")  # reached through points()
    gallery(page, out)
    assert runs(page) == 2
    gallery(page, out, "--quick")
    assert runs(page) == 3
    assert "Draft sizes" in (out / "squares.md").read_text()


@pytest.mark.slow
def test_a_file_of_data_that_is_cut_short_is_made_again(page, tmp_path):
    out = tmp_path / "out"
    gallery(page, out)
    data = out / "squares.npz"
    data.write_bytes(data.read_bytes()[:100])
    assert gallery(page, out) == 0
    assert runs(page) == 2


def test_a_check_that_does_not_hold_fails_the_command(page, tmp_path, capsys):
    edited(page, "steps > 0.0", "steps < 0.0")
    assert gallery(page, tmp_path / "out") == 1
    printed = capsys.readouterr().out
    assert "does not hold: squares grow ([3. 5.])" in printed
    assert "1 with a check that does not hold" in printed
    assert "| **does not hold**: squares grow |" in (tmp_path / "out" / "squares.md").read_text()


def test_a_page_that_cannot_be_written_is_reported_beside_its_checks(
    page, tmp_path, capsys, monkeypatch
):
    def full(*_, **__):
        raise OSError(errno.ENOSPC, "No space left on device")

    monkeypatch.setattr(np, "savez_compressed", full)
    out = tmp_path / "out"
    assert gallery(page, out) == 2
    printed = capsys.readouterr().out
    assert f"1 of 1 hold; not written: No space left on device: {out / 'squares.npz'}" in printed
    assert "1 pages, 1 that could not be made" in printed
    assert "does not hold" not in printed
    assert not (out / "squares.md").exists()


@pytest.mark.slow
def test_a_page_that_fails_does_not_stop_the_others(page, tmp_path, capsys):
    broken = tmp_path / "broken.py"
    broken.write_text(page.read_text().replace("return {", "raise ValueError('no data')\n    {"))
    out = tmp_path / "out"
    assert main(["gallery", str(broken), str(page), "--out", str(out)]) == 2
    printed = capsys.readouterr().out
    assert "failed: ValueError: no data" in printed
    assert "1 of 1 hold" in printed


def test_a_name_that_is_not_there_is_refused(capsys):
    assert main(["gallery", "2.1c"]) == 2
    assert "did you mean '2.1b'" in capsys.readouterr().err


def test_a_script_that_lacks_a_part_is_refused(page, capsys):
    edited(page, "def check(data)", "def other(data)")
    assert main(["gallery", str(page)]) == 2
    assert "must define check" in capsys.readouterr().err


def test_pages_are_listed_in_reading_order(capsys):
    assert main(["gallery", "--list"]) == 0
    listed = capsys.readouterr().out.splitlines()
    assert len(listed) == len(scripts()) > 0
    chapters = [line.split("chapter_")[1].split()[0] for line in listed if "chapter_" in line]
    assert chapters == sorted(chapters)


def test_a_chapter_is_all_its_pages():
    (chapter,) = {script.chapter for script in chosen(["chapter_2"])}
    assert chapter == "chapter_2"


def test_the_key_of_data_follows_the_helpers_of_a_chapter(monkeypatch, tmp_path):
    script = next(s for s in scripts() if s.page.name == "2.1b")
    before = digest(script, draft=True)
    assert digest(script, draft=False) != before
    helper = script.path.with_name("layered_sphere.py")
    read = Path.read_text

    def changed(self, *args, **more):
        text = read(self, *args, **more)
        return text.replace("LOAD = 1e-3, 1.0", "LOAD = 1e-3, 2.0") if self == helper else text

    monkeypatch.setattr(Path, "read_text", changed)
    assert digest(script, draft=True) != before


def test_names_of_pages_are_their_own():
    pages = scripts()
    assert len({s.page.name for s in pages}) == len({s.slug for s in pages}) == len(pages)
    for script in pages:
        assert load(script.path).module is script.module
        assert all((script.page.title, script.page.claim, script.page.verdict, script.page.grid))


def test_the_documentation_shows_every_page():
    shown = ROOT / "docs" / "gallery"
    index = (shown / "index.md").read_text()
    for script in scripts():
        assert f"({script.slug}.md)" in index, "run python docs/scripts/gallery.py"
        text = (shown / f"{script.slug}.md").read_text()
        assert "Draft sizes" not in text
        for picture in re.findall(r"\]\((.*?\.png)\)", text):
            assert 0 < (shown / picture).stat().st_size < 150_000


# Of these `test_pages_can_fail` and `test_soft_pages` run some; of the last see tests/references.
LONG = ("chapter_2", "chapter_3", "deforming", "future_work", "measured")
PAGES = ["2.1b", "2.3", "2.8", "layered-equations", "3.11", "Table 4.1"]  # seconds
PAGES += ["exact-menisci", "other-profiles", "sliding-angles", "stick-slip"]


@pytest.mark.parametrize(
    "pages",
    [
        pytest.param(PAGES, id="some", marks=pytest.mark.slow),
        *(
            pytest.param(
                [chapter],
                id=chapter,
                marks=pytest.mark.exhaustive if chapter in LONG else pytest.mark.slow,
            )
            for chapter in sorted({script.chapter for script in scripts()})
        ),
    ],
)
def test_every_page_holds_at_draft_sizes(pages, tmp_path, capsys):
    status = main(["gallery", *pages, "--out", str(tmp_path / "gallery"), "--quick"])
    assert status == 0, capsys.readouterr().out
