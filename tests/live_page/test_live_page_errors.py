"""What a live page cannot carry is refused by name, with reason and cure; no file is left."""

from __future__ import annotations

from pathlib import Path

import pytest
from attrs import evolve
from page_scenes import film

import contactkit as ck
from contactkit import extras
from contactkit.cli import main
from contactkit.errors import MissingExtraError
from contactkit.live_page.page import page_data, write_page
from contactkit.live_page.scene import check_scene

pytestmark = pytest.mark.errors

SPEED = ck.ImposedSpeed(speed=1e-3, initial_gap=5e-6, final_gap=25e-6)
SHAKEN = ck.Vibration(amplitude=1e-6, frequency=1e3)
SLIDING = ck.load_scene(Path(ck.__file__).parent / "data" / "templates" / "sliding.toml")
REFUSED = {
    "sliding": (SLIDING, "this is a SlidingScene; its result as a page: contactkit run"),
    "no mass": (film(mass=None), r"loading.mass \[kg\] is not given"),
    "a time": (
        evolve(film(), loading=ck.ImposedTime(time=1.0, initial_gap=5e-6, final_gap=25e-6)),
        'loading.kind = "imposed-time": .* write "imposed-force" or "imposed-speed"',
    ),
    "a vibration": (
        evolve(film(), loading=evolve(SPEED, vibration=SHAKEN)),
        "loading.vibration: .* leave the vibration out",
    ),
    "elastic bodies": (
        evolve(film(), effects=(*film().effects, ck.ElasticBodies())),
        "effects: .* this scene has elastic-bodies",
    ),
}


@pytest.mark.parametrize("what", REFUSED)
def test_a_scene_is_refused_with_the_reason(what):
    scene, message = REFUSED[what]
    with pytest.raises(ck.PlanError, match=message):
        check_scene(scene)


def test_a_cavity_at_a_speed_is_refused():
    with pytest.raises(ck.PlanError, match=r'effects.tension-limit: .* cavity = "truncated"'):
        page_data(evolve(film(), loading=SPEED))


def test_without_the_compiler_the_extra_is_named(monkeypatch, tmp_path):
    monkeypatch.setattr(extras.importlib.util, "find_spec", lambda name: None)
    with pytest.raises(MissingExtraError, match=r"pip install contactkit\[native\]"):
        write_page(film(), tmp_path / "film.html")
    assert [*tmp_path.iterdir()] == []


def test_a_speed_has_no_fmu_and_is_refused_before_anything_is_built(monkeypatch, tmp_path):
    monkeypatch.setattr("contactkit.live_page.page.page_data", None)
    scene = evolve(film(cavity=False), loading=SPEED)
    with pytest.raises(ck.PlanError, match=r"imposes a speed, and the FMU .* leave out the FMU"):
        write_page(scene, tmp_path / "film.html", fmu=True)
    assert [*tmp_path.iterdir()] == []


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (("film.toml", "--loads", "3", "--out", "page.html"), "loads"),
        (("none.npz", "--out", "page.html"), "none.npz"),
        (("bridges", "--out", "page.html"), "Bridges"),
        (("film.toml", "--out", "page.txt"), "page.txt"),
        (("none.toml", "--out", "page.html"), "exist"),
    ],
)
def test_the_command_line_refuses_in_one_line(arguments, message, tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    ck.save_scene(film(), "film.toml")
    assert main(["page", *arguments]) == 2
    error = capsys.readouterr().err
    assert message in error
    assert error.count("\n") == 1
    assert [path.name for path in tmp_path.iterdir()] == ["film.toml"]
