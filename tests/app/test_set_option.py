"""Values set on the command line over those of a scene."""

from __future__ import annotations

import json

import pytest

from contactkit.cli import main

SCENE = """\
[interface.lower]
shape = "flat"
radius = "3 mm"
[interface.upper]
shape = "flat"
[interface.meniscus]
liquid = "engine-oil-15w-40"
volume = "0.1 mm3"
[loading]
kind = "imposed-speed"
initial_gap = "5 um"
final_gap = "50 um"
speed = "1 mm/s"
[[effects]]
effect = "viscous-force"
[[effects]]
effect = "tension-limit"
strength = "10 bar"
[study]
"loading.initial_gap" = ["5 um", "6 um"]
"""


@pytest.fixture
def scene(tmp_path):
    path = tmp_path / "film.toml"
    path.write_text(SCENE)
    return str(path)


def numbers(capsys, *arguments):
    assert main([*arguments, "--json"]) == 0
    return {name: one["value"] for name, one in json.loads(capsys.readouterr().out).items()}


def test_a_value_set_is_that_of_a_file_with_it(scene, tmp_path, capsys):
    other = tmp_path / "other.toml"
    changed = SCENE.replace("1 mm/s", "2 mm/s").replace("10 bar", "5 bar")
    other.write_text(changed.replace('liquid = "engine-oil-15w-40"', 'liquid = "water"'))
    set_values = [
        *("--set", "loading.speed=2 mm/s", "--set", "effects.tension-limit.strength = 5e5"),
        *("--set", "interface.meniscus.liquid=water"),
    ]
    for command in ("run", "study"):
        expected = numbers(capsys, command, str(other))
        found = numbers(capsys, command, scene, *set_values)
        for one in (expected, found):  # no two runs take the same time
            one.pop("seconds", None)
        assert found == expected


@pytest.mark.parametrize(
    ("assignment", "shown"),
    [
        ("name=a film", "a film"),
        ("name=60", "60: "),
        ("effects=[{effect='meniscus-force'}]", "on   meniscus-force"),
        (
            "loading={kind='imposed-speed', initial_gap='1 um', final_gap='70 um', speed=1}",
            "7e-05 m",
        ),
        ("interface.lower={shape='flat', radius='2 mm'}", "viscous-force"),
        ("accuracy.time_rtol=1e-4", "viscous-force"),
    ],
)
def test_values_are_those_of_a_scene_file(scene, capsys, assignment, shown):
    assert main(["plan", scene, "--set", assignment]) == 0
    assert shown in capsys.readouterr().out


@pytest.mark.parametrize(
    ("assignments", "message"),
    [
        (["loading.sped=1 mm/s"], "did you mean 'loading.speed'?"),
        (["loading.speed=1 mm"], "--set loading.speed: ImposedSpeed.speed must be in a unit that"),
        (["loading.speed=-1 mm/s"], "--set loading.speed: ImposedSpeed.speed must be"),
        (["effects.shear-limit.strength=1 bar"], "has the items viscous-force, tension-limit"),
        (["effects.tension-limit.cavity=air"], "--set effects.tension-limit.cavity"),
        (["interface.meniscus.liquid=watr"], "did you mean 'water'?"),
        (["interface.meniscus.liquid={name='x', viscosty=1}"], "did you mean 'viscosity'?"),
        (["loading.speed"], "must be path=value"),
        (["=1"], "must be path=value"),
        (["loading.speed="], "must be path=value"),
        (["loading.speed=1", "loading.speed=2"], "be given once"),
        (["loading.speed=1", "loading={}"], "not lie inside 'loading'"),
        (["accuracy=1"], "lead to a field of it"),
        (["temperature=1\nname=2"], "--set temperature"),
    ],
)
def test_a_value_that_cannot_be_is_refused(scene, capsys, assignments, message):
    options = [word for one in assignments for word in ("--set", one)]
    for command in ("plan", "run", "check"):
        assert main([command, scene, *options]) == 2
        error = capsys.readouterr().err
        assert error.startswith("contactkit: --set")
        assert message in error


@pytest.mark.parametrize(
    ("name", "assignment", "shown"),
    [
        ("fuel-injector", "valve.profile.cycles=2", "over 2 cycles"),
        ("micromirror", "study.humidity=0.3", "30 % relative humidity"),
        ("bridges", "name=menisci", "menisci"),
    ],
)
def test_devices_have_paths_too(capsys, name, assignment, shown):
    assert main(["plan", name, "--set", assignment]) == 0
    assert shown in capsys.readouterr().out
    assert main(["plan", name, "--set", "accuracy.rtol=1"]) == 2
    assert "--set must lead to a field" in capsys.readouterr().err
