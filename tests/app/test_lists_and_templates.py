"""What helps to write a scene file: lists of known names, commented templates, checks."""

from __future__ import annotations

import json
import re

import pytest

import contactkit as ck
from contactkit.app.listing import LISTS, listing
from contactkit.app.scenes import open_scene
from contactkit.app.templates import KINDS, template
from contactkit.cli import main
from contactkit.kinds import CONTACT_EFFECTS, SEPARATION_EFFECTS, SLIDING_EFFECTS

LOADERS = {"liquids": ck.load_liquid, "materials": ck.load_material, "scenes": open_scene}


def names(what):
    return [line.split()[0] for line in listing(what).splitlines()[1:]]


@pytest.mark.parametrize("what", LOADERS)
def test_every_name_of_a_list_can_be_given(what):
    found = names(what)
    assert len(found) >= 4
    for name in found:
        assert LOADERS[what](name)


def test_every_effect_is_listed():
    known = [*CONTACT_EFFECTS, *SEPARATION_EFFECTS, *SLIDING_EFFECTS]
    assert names("effects") == [one.name for one in known]


def test_a_list_that_is_not_known_is_refused_with_the_known_ones(capsys):
    assert main(["list", "fluids"]) == 2
    assert "did you mean 'liquids'?" in capsys.readouterr().err


@pytest.mark.parametrize("what", LISTS)
def test_lists_are_printed(what, capsys):
    assert main(["list", what]) == 0
    assert capsys.readouterr().out.rstrip() == listing(what)


def with_everything(text):
    """A template with its optional effects and study."""
    on, lines = False, []
    for line in text.splitlines():
        on = on or bool(re.match(r"# \[", line))
        lines.append(line.removeprefix("# ") if on else line)
        on = on and bool(line.strip())
    return "\n".join(lines)


@pytest.mark.parametrize("change", [str, with_everything], ids=["as printed", "with everything"])
@pytest.mark.parametrize("kind", KINDS)
def test_templates_have_no_mistakes(kind, change, tmp_path, capsys):
    text = template(kind)
    assert with_everything(text) != text
    path = tmp_path / "my.toml"
    path.write_text(change(text))
    assert main(["check", str(path)]) == 0
    assert "no mistakes" in capsys.readouterr().out


@pytest.mark.parametrize("kind", KINDS)
def test_new_prints_a_template(kind, capsys):
    assert main(["new", kind]) == 0
    assert capsys.readouterr().out == template(kind)


def test_a_template_runs(tmp_path, capsys):
    path = tmp_path / "my.toml"
    path.write_text(template("separation"))
    assert main(["run", str(path), "--json"]) == 0
    assert '"release_time"' in capsys.readouterr().out


def test_check_reports_every_mistake_and_runs_nothing(tmp_path, capsys):
    path = tmp_path / "my.toml"
    wrong = template("separation").replace('"40 N"', '"40 m"').replace("viscous-force", "viscous")
    path.write_text(wrong)
    assert main(["check", str(path)]) == 2
    said = capsys.readouterr().err
    assert len(re.findall(r", line \d+", said)) == 2
    assert sorted(tmp_path.iterdir()) == [path]


HUMID = """\
[interface.upper.surface]
shape = "sphere"
radius = "2 mm"
[interface.meniscus]
liquid = "engine-oil-15w-40"
relative_humidity = 0.5
[loading]
kind = "imposed-speed"
speed = "1 mm/s"
initial_gap = "10 um"
final_gap = "0.2 mm"
[[effects]]
effect = "meniscus-force"
[[effects]]
effect = "magnet"
[accuracy]
points = 1.5
[study]
"loading.speed" = 3
"""


def test_check_reports_wrong_physics_beside_wrong_fields(tmp_path, capsys):
    path = tmp_path / "humid.toml"
    path.write_text(HUMID)
    assert main(["check", str(path)]) == 2
    said = capsys.readouterr().err.splitlines()
    assert [line.split(" must ")[0].strip() for line in said[1:]] == [
        "Accuracy.points",
        "effect",
        "study",
        "without what is listed above: Liquid.molar_mass",
    ]
    assert "at effects[1], line 15" in said[2]


def test_check_plans_nothing_where_a_body_is_wrong(tmp_path, capsys):
    path = tmp_path / "humid.toml"
    path.write_text(HUMID.replace('"2 mm"', '"-2 mm"'))
    assert main(["check", str(path)]) == 2
    said = capsys.readouterr().err
    assert "Sphere.radius" in said
    assert "without what is listed above" not in said


def test_the_schema_is_printed_or_written_and_replaces_no_file(tmp_path, capsys):
    assert main(["schema"]) == 0
    printed = capsys.readouterr().out
    assert json.loads(printed)["$schema"] == "http://json-schema.org/draft-07/schema#"
    out = tmp_path / "scene.schema.json"
    assert main(["schema", "--out", str(out)]) == 0
    assert out.read_text("utf-8") == printed
    out.write_text("mine")
    assert main(["schema", "--out", str(out)]) == 2
    assert out.read_text() == "mine"
    assert main(["schema", "--out", str(out), "--overwrite"]) == 0
    assert out.read_text("utf-8") == printed
    assert main(["schema", "--out", str(tmp_path / "scene.toml")]) == 2
