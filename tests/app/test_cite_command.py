"""``contactkit cite``: of scene files, scenes by name, devices, results and output folders."""

from __future__ import annotations

import re

import pytest

import contactkit as ck
from contactkit.cli import main
from contactkit.data.bibliography import bibliography

SCENE = """\
[interface.lower]
shape = "flat"
radius = "3 mm"
[interface.upper]
shape = "flat"
[interface.meniscus]
volume = "0.1 mm3"
liquid = "water"
[loading]
kind = "imposed-speed"
initial_gap = "5 um"
final_gap = "6 um"
speed = "1 mm/s"
[[effects]]
effect = "meniscus-force"
"""


@pytest.fixture
def scene(tmp_path):
    path = tmp_path / "drop.toml"
    path.write_text(SCENE)
    return path


def printed(capsys, *arguments):
    assert main(["cite", *map(str, arguments)]) == 0
    return capsys.readouterr().out


def keys(text):
    return re.findall(r"^@\w+\{([\w-]+),$", text, re.MULTILINE)


def test_a_scene_file_is_cited_in_words_and_in_bibtex(scene, capsys):
    words = printed(capsys, scene)
    assert "[orr1975] Orr, F. M." in words
    assert "for meniscus-force: Young-Laplace" in words
    text = printed(capsys, scene, "--bibtex")
    assert keys(text) == ["contactkit", "cai2008", "orr1975", "iapws2014"]
    assert bibliography()["orr1975"].bibtex() in text
    arc = printed(capsys, scene, "--bibtex", "--set", "effects.meniscus-force.profile=arc")
    assert keys(arc) == ["contactkit", "cai2008a", "iapws2014"]


def test_bibtex_is_written_to_a_file_that_is_not_replaced(scene, tmp_path, capsys):
    out = tmp_path / "works.bib"
    printed(capsys, scene, "--out", out)
    text = out.read_text("utf-8")
    assert keys(text)[-1] == "iapws2014"
    assert main(["cite", str(scene), "--out", str(out)]) == 2
    assert out.read_text("utf-8") == text
    printed(capsys, scene, "--out", out, "--overwrite")


@pytest.mark.parametrize(
    ("name", "wanted"),
    [
        ("bridges", {"orr1975", "cai2007a", "cai2008a"}),
        ("fuel-injector", {"stefan1874", "jakobsson1957", "hairer1996", "francis1922"}),
        ("micromirror", {"orr1975", "hamaker1937", "kell1975"}),
    ],
)
def test_devices_cite_what_they_rest_on(name, wanted, capsys):
    assert wanted <= set(keys(printed(capsys, name, "--bibtex")))


def test_results_curves_and_folders_are_cited(scene, tmp_path, capsys):
    result = ck.simulate(ck.plan(ck.load_scene(scene)))
    ck.save_result(result, tmp_path / "a.npz")
    wanted = list(ck.cite(result).keys)
    assert keys(printed(capsys, tmp_path / "a.npz", "--bibtex")) == wanted
    study = ck.study(ck.load_scene(scene), {"loading.speed": [1e-3, 2e-3]})
    study.save(tmp_path / "study.npz")
    assert "orr1975" in keys(printed(capsys, tmp_path / "study.npz", "--bibtex"))
    assert main(["run", str(scene), "--out", str(tmp_path / "out")]) == 0
    capsys.readouterr()
    assert keys(printed(capsys, tmp_path / "out", "--bibtex")) == wanted


@pytest.mark.errors
def test_what_has_no_sources_is_refused_in_a_line(scene, tmp_path, capsys):
    (tmp_path / "empty").mkdir()
    (tmp_path / "bad.npz").write_text("nothing")
    for arguments, words in (
        ([tmp_path / "empty"], "be a folder that contactkit run or study wrote to"),
        ([tmp_path / "bad.npz"], "be a saved result, curve, study or fit"),
        ([tmp_path / "bad.npz", "--set", "a=1"], "be left out for a result"),
        (["no-such-scene"], "no-such-scene"),
    ):
        assert main(["cite", *map(str, arguments)]) == 2
        assert words in capsys.readouterr().err
