"""The page of a result: what it holds, and that nothing of a file becomes HTML."""

from __future__ import annotations

import json
import math
import re
from html.parser import HTMLParser

import pytest

from contactkit.app.output import Command, written_to
from contactkit.app.report_page import report_page
from contactkit.app.scenes import described, open_scene
from contactkit.cli import main
from contactkit.export.report import Report
from contactkit.validity import ValidityNumber

pytest.importorskip("matplotlib")

HOSTILE = "<script>alert(1)</script> \"'&"
SCENE = """\
name = '''{name}'''
[interface.lower]
shape = "flat"
radius = "3 mm"
[interface.upper]
shape = "flat"
[interface.meniscus]
volume = "0.1 mm3"
[interface.meniscus.liquid]
name = '''{name}'''
viscosity = "10 mPa.s"
surface_tension = "30 mN/m"
density = "870 kg/m3"
[loading]
kind = "imposed-speed"
initial_gap = "5 um"
final_gap = "50 um"
speed = "1 mm/s"
[[effects]]
effect = "viscous-force"
"""
SECTIONS = ["Result", "Validity", "Plan", "Scene", "Sources", "Cost"]


class Elements(HTMLParser):
    """Elements of a page, and where they lead."""

    def __init__(self, text):
        super().__init__()
        self.tags, self.links = set(), []
        self.feed(text)

    def handle_starttag(self, tag, attributes):
        self.tags.add(tag)
        self.links += [v for name, v in attributes if name in ("src", "href", "data", "action")]


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    """Output folder of a run with a page, of a scene with a hostile name."""
    place = tmp_path_factory.mktemp("page")
    scene = place / "film.toml"
    scene.write_text(SCENE.format(name=HOSTILE))
    out = place / "out"
    assert main(["run", str(scene), "--out", str(out), "--report", "--set", "name=<i>x</i>"]) == 0
    return out


def headings(page):
    return re.findall(r"<h2>(.*?)</h2>", page)


def test_a_page_holds_figures_numbers_plan_validity_and_sources(folder):
    page = (folder / "report.html").read_text()
    assert headings(page) == ["Values set", "Figures", *SECTIONS, "Printed"]
    texts = ("peak force", "slenderness of the film", "viscous-force", "Stefan 1874", "wall time")
    assert [text for text in texts if text not in page] == []
    assert page.count("<img") == len(list(folder.glob("*.png"))) > 0


def test_what_is_out_of_range_comes_first():
    from contactkit.app.report_page import validity_rows
    from contactkit.validity import ValidityNumber

    numbers = [
        ValidityNumber(name="a", value=0.1, high=1.0, detail="small; is good"),
        ValidityNumber(name="b", value=None, high=1.0, detail="nothing is given"),
        ValidityNumber(name="c", value=2.0, high=1.0, detail="too large"),
    ]
    assert validity_rows(numbers) == [
        ("c", "2 (at most 1): OUT OF RANGE", "too large"),
        ("a", "0.1 (at most 1): ok", "small; is good"),
        ("b", "not evaluated", "nothing is given"),
    ]


def test_a_page_needs_no_network_and_no_script(folder):
    found = Elements((folder / "report.html").read_text())
    assert found.links
    assert all(link.startswith("data:image/png;base64,") for link in found.links)
    assert not found.tags & {"script", "link", "iframe", "object", "i"}


def test_text_of_files_is_escaped(folder, tmp_path, capsys):
    assert main(["report", str(folder / "result.npz"), "--out", str(tmp_path / "r.html")]) == 0
    assert capsys.readouterr().out == f"{tmp_path / 'r.html'}\n"
    page = (tmp_path / "r.html").read_text()
    assert page.count("&lt;script&gt;alert(1)&lt;/script&gt;") == 1  # the name of the liquid
    assert page.count("&lt;i&gt;x") > 1
    assert Elements(page).tags.isdisjoint({"script", "i"})
    assert headings(page) == ["Figures", *SECTIONS]


def test_a_record_of_others_shows_no_file_outside_its_folder(folder, tmp_path, capsys):
    out = tmp_path / "out"
    out.mkdir()
    picture = (folder / "forces.png").read_bytes()
    (tmp_path / "secret.png").write_bytes(picture)
    (out / "link.png").symlink_to(tmp_path / "secret.png")
    (out / "text.png").write_text("no picture")
    (out / "good.png").write_bytes(picture)
    names = ["../secret.png", "link.png", "text.png", "good.png", str(tmp_path / "secret.png")]
    printed = {"title": HOSTILE, "settings": [HOSTILE], "text": HOSTILE, "numbers": {HOSTILE: "1"}}
    record = {
        "scene": HOSTILE,
        "files": {name: ["run", "0"] for name in names},
        "printed": {HOSTILE: printed, "run": printed},
    }
    (out / "contactkit.json").write_text(json.dumps(record))
    assert main(["report", str(out)]) == 0
    page = (out / "report.html").read_text()
    assert page.count("<img") == 1
    assert "script" not in Elements(page).tags


@pytest.mark.parametrize(
    "text",
    ["", "[]", "{}", '{"scene": 1}', '{"scene": "", "files": [], "printed": {}}', "[" * 9999],
)
def test_a_record_that_is_none_is_refused(tmp_path, capsys, text):
    (tmp_path / "contactkit.json").write_text(text)
    assert main(["report", str(tmp_path)]) == 2
    assert "must be a record of contactkit" in capsys.readouterr().err
    assert not (tmp_path / "report.html").exists()


def test_the_page_of_a_study_has_its_table_and_figure(tmp_path):
    scene, out = tmp_path / "film.toml", tmp_path / "out"
    scene.write_text(
        SCENE.format(name="film") + '[study]\n"loading.speed" = ["1 mm/s", "2 mm/s"]\n'
    )
    assert main(["study", str(scene), "--out", str(out)]) == 0
    assert main(["report", str(out)]) == 0
    page = (out / "report.html").read_text()
    assert headings(page) == ["Figures of study", "Printed by study"]
    assert page.count("speed [m/s]") == 1
    assert page.count("<img") == 1


@pytest.mark.parametrize(
    ("make", "message"),
    [
        (lambda p: (p / "r.npz").write_text("x"), "must be a result of contactkit"),
        (lambda p: (p / "r.npz").mkdir(), "neither contactkit.json nor result.npz"),
        (lambda p: None, "must be a result of contactkit"),
    ],
)
def test_what_is_no_result_has_no_page(tmp_path, capsys, make, message):
    make(tmp_path)
    assert main(["report", str(tmp_path / "r.npz"), "--out", str(tmp_path / "r.html")]) == 2
    assert message in capsys.readouterr().err
    assert not (tmp_path / "r.html").exists()


def test_a_page_replaces_only_pages_of_contactkit(folder, tmp_path, capsys):
    target = tmp_path / "page.html"
    command = ["report", str(folder), "--out", str(target)]
    target.write_text("of others")
    assert main(command) == 2
    assert "contactkit did not write it" in capsys.readouterr().err
    assert target.read_text() == "of others"
    assert main([*command, "--overwrite"]) == main(command) == 0
    assert main(["report", str(folder), "--out", str(tmp_path / "page.txt")]) == 2


def test_a_page_of_a_run_goes_to_its_folder(folder, tmp_path, capsys):
    scene = folder.parent / "film.toml"
    assert main(["run", str(scene), "--report"]) == 2
    assert "--out" in capsys.readouterr().err


def test_the_page_of_a_device_has_its_plan_validity_scene_and_sources(tmp_path):
    """As the run of the device leaves them, without running it: that takes a minute."""
    opened = open_scene("micromirror")
    bond = ValidityNumber(name="Bond number", value=0.2, high=0.1, detail="gravity is left out")
    wide = ValidityNumber(name="slenderness", value=9.0, low=5.0, detail="<wide> enough")
    report = Report(
        {"release_time": (math.nan, "s"), "tilt": (0.1745, "rad")},
        "it releases",
        validity=[("lift-off", wide), ("lift-off", bond)],
    )
    with written_to(tmp_path / "out", Command("run", "micromirror")) as folder:
        folder.path.mkdir(exist_ok=True)
        (folder.path / "signals.csv").write_text("t")
        folder.keep(opened.name, report.text, report.scalars, **described(opened, report))
    text = report_page(tmp_path / "out")
    headings = re.findall("<h2>(.*?)</h2>", text)
    assert headings == [
        *("Printed by run", "Numbers of run"),
        *("Validity", "Plan", "Scene", "Sources"),
    ]
    rows = re.findall("<tr>(.*?)</tr>", text)
    assert "<td>release time</td><td>none</td>" in rows
    assert "<td>tilt</td><td>9.998 deg</td>" in rows
    out, fine = (next(i for i, row in enumerate(rows) if name in row) for name in ("Bond", "slend"))
    assert out < fine
    assert "&lt;wide&gt; enough" in text
    assert "sources:" not in text
    assert "<li>van-der-waals-force: Hamaker 1937" in text
    assert "landing tilt 10 deg" in text
