"""The desk: files that are dropped, maps as contacts, and what is refused."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
import pytest

import contactkit as ck
from contactkit.commands.app import SCENES
from contactkit.local_app.desk import Desk, is_contact, opened_scene
from contactkit.local_app.exports import toml_bytes
from contactkit.local_app.form import made_of, parts_of
from contactkit.models.library import bundled_scenes


class Dropped(NamedTuple):
    name: str
    contents: bytes


@pytest.fixture
def desk():
    made = Desk.new()
    yield made
    made.close()
    assert not made.folder.exists()


MAP = b"0, 1, 2\n1, nan, 1\n2, 1, 0\n"


@pytest.mark.errors
@pytest.mark.parametrize(
    "name", ["../../it.csv", "/etc/it.csv", "..\\..\\it.csv", ".it.csv", "i\nt.csv"]
)
def test_a_file_stays_in_the_folder_whatever_its_name(desk, name):
    kept = desk.keep(Dropped(name, MAP))
    assert kept.parent == desk.folder
    assert kept.read_bytes() == MAP
    assert [one.name for one in desk.folder.iterdir()] == [kept.name]


@pytest.mark.errors
def test_a_file_beyond_the_limits_is_refused(desk, monkeypatch):
    monkeypatch.setenv("CONTACTKIT_MAX_BYTES", "20")
    start = desk.begin("contact", [Dropped("it.csv", MAP)])
    assert "at most 20 bytes" in start.problem
    assert list(desk.folder.iterdir()) == []
    assert is_contact(start.scene)  # the template
    large = desk.begin("contact", [Dropped("it.toml", b" " * 2**21)])
    assert "CONTACTKIT_MAX_SCENE_BYTES" in large.problem


def test_a_map_with_holes_begins_with_them_masked(desk):
    scene = desk.begin("separation", [Dropped("afm.csv", MAP)]).scene.scene
    surface = scene.interface.lower.surface
    assert (surface.holes, surface.detrend) == ("masked", "tilt")
    whole = desk.begin("contact", [Dropped("afm.csv", MAP.replace(b"nan", b"0"))]).scene.scene
    assert whole.interface.lower.surface.holes == "refused"


def test_a_scene_file_decides_which_half_it_is(desk):
    text = b'[loading]\nkind = "pressing"\npressure = "1 MPa"\n[window]\nwidth = "1 um"\n'
    text += b'[[effects]]\neffect = "half-space"\n[interface.lower]\nsolid = "silicon"\n'
    start = desk.begin("separation", [Dropped("it.toml", text)])
    assert start.problem == ""
    assert is_contact(start.scene)


def test_a_written_scene_names_its_map_beside_it(desk, tmp_path):
    start = desk.begin("contact", [Dropped("afm.csv", MAP)]).scene
    parts = parts_of(start, {})
    values = {"interface.lower.surface.pixel_size": "5 nm, 10 nm"}
    found = made_of(start, parts, values | {"interface.lower.surface.unit": "nm"})
    (tmp_path / "afm.csv").write_bytes(MAP)
    (tmp_path / "scene.toml").write_bytes(toml_bytes("it", found.tables))
    read = ck.load_scene(tmp_path / "scene.toml").interface.lower.surface
    assert read.path == str(tmp_path / "afm.csv")
    assert read.pixel_size == (5e-9, 10e-9)


@pytest.mark.errors
@pytest.mark.parametrize(
    ("source", "says"),
    [
        ("fuel-injector", "holds a InjectorScene; contactkit run fuel-injector"),
        ("no-such-name", "no-such-name"),
        ("nothing.csv", "nothing.csv"),
        ("nothing.toml", "nothing.toml"),
    ],
)
def test_what_is_neither_contact_nor_separation_is_refused(source, says):
    with pytest.raises(ck.ContactkitError, match=says):
        opened_scene(source, "contact")


def test_the_half_follows_from_what_is_opened(tmp_path):
    np.save(tmp_path / "it.npy", np.eye(4))
    for opened, half in (
        (tmp_path / "it.npy", "contact"),
        ("contact-stop", "contact"),
        (None, "contact"),
    ):
        desk = Desk.new(opened)
        assert desk.half == half
        desk.close()


def test_completion_offers_the_bundled_scenes_that_the_app_takes():
    def is_taken(name):
        try:
            return opened_scene(name, "contact") is not None
        except ck.PlanError:
            return False

    assert sorted(SCENES) == sorted(filter(is_taken, bundled_scenes()))
