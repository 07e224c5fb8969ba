"""Mistakes in scene files are reported all at once, each with its line."""

from __future__ import annotations

import pytest

import contactkit as ck
from contactkit.app.scenes import open_scene
from contactkit.files.toml_lines import line_of, lines_of_keys

pytestmark = pytest.mark.errors

WRONG = """\
temperature = "20 degF"

[interface]
lower = { shape = "flat", radius = "-3 mm" }

[interface.meniscus]
volume = "0.1 mm3"

[interface.meniscus.liquid]
name = "oil"
viscosty = "10 mPa.s"

[loading]
kind = "imposed-force"
initial_gap = "5 um"
final_gap = "50 m/s"
force = 40

[[effects]]
effect = "viscous-force"

[[effects]]
effect = "menisc"
"""
LINES = {"degF": 1, "Flat.radius": 4, "viscosty": 11, "final_gap": 16, "menisc'": 23}


@pytest.mark.parametrize("read", [ck.load_scene, open_scene])
def test_every_mistake_has_its_line(read, tmp_path):
    path = tmp_path / "film.toml"
    path.write_text(WRONG)
    with pytest.raises(ck.DescriptionError) as caught:
        read(str(path))
    _, *listed = str(caught.value).splitlines()
    assert len(listed) == len(LINES)
    for wrong, line in LINES.items():
        (one,) = (text for text in listed if wrong in text)
        assert one.endswith(f", line {line}"), one


def test_a_file_that_is_right_is_read_as_before(tmp_path):
    path = tmp_path / "contact.toml"
    path.write_text(
        'interface.lower.solid = "bearing-steel"\n'
        'interface.upper = { shape = "sphere", radius = "1 mm" }\n'
        'window = { width = "20 um", periodic = false }\n'
        'loading = { kind = "pressing", force = "1 mN" }\n'
        'effects = [{ effect = "half-space" }]\n'
    )
    assert isinstance(ck.load_scene(path), ck.ContactScene)


@pytest.mark.parametrize(
    ("text", "place", "line"),
    [
        ('"a b".c = 1', "ab.c", 1),
        ("x = 1\n[ t . u ] # a remark\nv = 2", "t.u.v", 3),
        ("x = '''\n'''\n[[e]]\n[[e]]\nf = 1", "e[1].f", 5),
        ("effects = [\n  { effect = 'a' },\n]", "effects[0].effect", 1),
        ("", "nothing", None),
        ("a = 1", "b.c[3].d", None),
        ("a.b = 1", "a.b.c.d", 1),
    ],
)
def test_places_are_found_or_the_nearest_table(text, place, line):
    assert line_of(lines_of_keys(text), place) == line
