"""All mistakes of each table of a scene file, not only the first."""

from __future__ import annotations

import pytest

import contactkit as ck

pytestmark = pytest.mark.errors

SCENE = """\
name = 7
interface.lower = { shape = "flat", radius = "-3 mm" }
interface.upper = { shape = "flat" }
[interface.meniscus]
volume = "0.1 mm3"
liquid = "water"
contact_angle_lower = "200 deg"
contact_angle_upper = "-1 deg"
[loading]
kind = "imposed-speed"
initial_gap = "-5 um"
final_gap = "6 s"
speed = "0 mm/s"
sped = 3
[[effects]]
effect = "meniscus-force"
profile = "sphere"
foo = 1
bar = 2
[[effects]]
effect = "tension-limit"
strength = "-10 bar"
ambient_pressure = "-1 bar"
"""
WANTED = [
    "SeparationScene.name must be a text",
    "Flat.radius must be positive",
    "Meniscus.contact_angle_lower must lie",
    "Meniscus.contact_angle_upper must lie",
    "ImposedSpeed.initial_gap must be zero or positive",
    "ImposedSpeed.final_gap must be in a unit",
    "ImposedSpeed.speed must be positive",
    "loading.sped must be a key",
    "MeniscusForce.profile must be one of",
    "MeniscusForce.foo must be a known key",
    "MeniscusForce.bar must be a known key",
    "TensionLimit.strength must be positive",
    "TensionLimit.ambient_pressure must be positive",
]


def mistakes(tmp_path, text):
    file = tmp_path / "bad.toml"
    file.write_text(text)
    with pytest.raises(ck.DescriptionError) as refusal:
        ck.load_scene(file)
    return str(refusal.value).splitlines()[1:]


def test_each_mistake_is_listed_once(tmp_path):
    found = mistakes(tmp_path, SCENE)
    for wanted in WANTED:
        assert sum(wanted in line for line in found) == 1, wanted
    assert len(found) == len(WANTED)
    line = next(line for line in found if "ambient_pressure" in line)
    assert line.endswith("effects[1], line 23")


def test_a_key_that_is_misspelt_is_not_missing_too(tmp_path):
    text = SCENE.replace('speed = "0 mm/s"\n', "").replace("sped = 3", 'sped = "1 mm/s"')
    found = mistakes(tmp_path, text)
    assert sum("sped" in line for line in found) == 1
    assert not any("missing key" in line for line in found)
