"""`contactkit page` of contact scenes, of their studies, and of saved results."""

from __future__ import annotations

import pytest
from contact_pages import Read, ball, rough, solved

import contactkit as ck
from contactkit.app.live_page import open_page
from contactkit.cli import main

FILE = """
[accuracy]
grid = 16
[study]
"loading.force" = ["0.1 N", "0.4 N"]
"""


@pytest.fixture
def folder(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    return tmp_path


def read(path):
    return Read(path.read_text("utf-8"))


def test_a_scene_file_has_the_loads_of_its_study(folder, capsys):
    path = ck.save_scene(ball(), folder / "ball.toml")
    path.write_text(path.read_text() + FILE)
    assert main(["page", "ball.toml", "--out", "page.html"]) == 0
    assert "opens in any browser" in capsys.readouterr().out
    page = read(folder / "page.html")
    assert [one["text"] for one in page.data["loads"]] == ["100 mN", "200 mN", "400 mN"]
    assert page.data["own"] == 1
    assert page.data["views"][0]["surface"]["shape"] == [16, 16]
    assert main(["page", "ball.toml", "--loads", "2", "--out", "page.html"]) == 0
    assert [one["value"] for one in read(folder / "page.html").data["loads"]] == [0.1, 0.2]
    assert main(["page", "ball.toml", "--loads", "1", "--set", "loading.force=1 N", *OUT]) == 0
    assert [one["text"] for one in read(folder / "page.html").data["loads"]] == ["1 N"]


OUT = ["--out", "page.html"]


@pytest.mark.parametrize("source", ["out/result.npz", "out"])
def test_a_saved_result_is_shown_as_it_is(source, folder, capsys):
    result = solved(rough(), ck.Accuracy(grid=24))
    (folder / "out").mkdir()
    result.save(folder / "out" / "result.npz")
    assert main(["page", source, *OUT]) == 0
    page = read(folder / "page.html")
    assert page.data["title"] == "rough and wet"
    assert len(page.data["loads"]) == 1
    values, half_a_step = page.map("pressure")
    assert values == pytest.approx(result.pressure, abs=half_a_step)
    assert (page.flags("contact") == result.contact).all()
    capsys.readouterr()
    assert main(["page", source, "--set", "name=x", *OUT]) == 2
    assert "be left out for the saved result" in capsys.readouterr().err
    assert main(["page", source, "--loads", "2", *OUT]) == 2
    assert "loads" in capsys.readouterr().err


def test_of_a_saved_separation_the_scene_is_shown(folder):
    from page_scenes import film

    with pytest.warns(ck.ValidityWarning):
        ck.simulate(ck.plan(film())).save(folder / "film.npz")
    found = open_page("film.npz")
    assert found.shown == film()
    assert found.name == "film of a page"
