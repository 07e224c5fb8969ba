"""Own kinds from a file on the command line: ``--plugin FILE.py``."""

from __future__ import annotations

import json
import sys
import tomllib
from pathlib import Path

import jsonschema
import pytest

from contactkit.cli import main
from contactkit.kinds import KINDS

SCENE = """\
[interface.upper.surface]
shape = "sphere"
radius = "2 mm"
[interface.meniscus]
liquid = "water"
volume = "0.1 mm3"
[loading]
kind = "imposed-speed"
speed = "1 mm/s"
initial_gap = "10 um"
final_gap = "0.2 mm"
[[effects]]
effect = "steady-pull"
force = "3 mN"
[study]
"effects.steady-pull.force" = ["1 mN", "2 mN"]
"""
PLUGIN = '''\
"""A force that does not change."""

from typing import ClassVar

from attrs import field, frozen

import contactkit as ck
from contactkit.scene.column import Column
from contactkit.separation.effects.base import ForceLaw, SeparationForce
from contactkit.units import si


@ck.register
@frozen(kw_only=True)
class SteadyPull(SeparationForce):
    """A force that does not change."""

    name: ClassVar[str] = "steady-pull"
    summary: ClassVar[str] = "a force that does not change"
    column: ClassVar[Column] = Column("steady_pull", "N", "steady pull")
    needs_film: ClassVar[bool] = False
    sources = ("own",)

    force: float = field(metadata=si("N"))

    def prepare(self, prepared):
        return ForceLaw(lambda gap, speed: self.force, rate="none")
'''


@pytest.fixture
def files(tmp_path, monkeypatch):
    """A scene and its plugin, forgotten afterwards."""
    scene, plugin = tmp_path / "scene.toml", tmp_path / "own_pull_of_a_test.py"
    scene.write_text(SCENE)
    plugin.write_text(PLUGIN)
    monkeypatch.setattr(sys, "path", [*sys.path])
    with KINDS.including():
        yield str(scene), str(plugin)
    sys.modules.pop(plugin.stem, None)


def test_a_scene_with_an_effect_of_a_plugin_runs(files, capsys):
    scene, plugin = files
    assert main(["run", scene, "--plugin", plugin, "--json"]) == 0
    numbers = json.loads(capsys.readouterr().out)
    # 3 mN for 0.19 mm at 1 mm/s
    assert numbers["steady_pull_impulse"]["value"] == pytest.approx(3e-3 * 0.19, rel=1e-6)


def test_a_study_sends_it_to_other_processes(files, capsys):
    scene, plugin = files
    assert main(["study", scene, "--plugin", plugin, "--workers", "2", "--json"]) == 0
    found = json.loads(capsys.readouterr().out)["steady_pull_impulse"]["value"]
    assert found == pytest.approx([1e-3 * 0.19, 2e-3 * 0.19], rel=1e-6)


def test_the_schema_of_scene_files_has_it(files, tmp_path, capsys):
    plugin = files[1]
    out = tmp_path / "scene.schema.json"
    assert main(["schema", "--plugin", plugin, "--out", str(out)]) == 0
    assert out.name in capsys.readouterr().out
    schema = json.loads(out.read_text("utf-8"))
    tables = tomllib.loads(SCENE)
    jsonschema.validate(tables, schema)
    tables["effects"][0]["forse"] = "1 N"
    with pytest.raises(jsonschema.ValidationError, match="'forse' was unexpected"):
        jsonschema.validate(tables, schema)


def test_without_it_the_message_names_the_option(files, capsys):
    assert main(["check", files[0]]) == 2
    assert "on the command line --plugin FILE.py" in capsys.readouterr().err


def test_an_effect_of_another_family_is_named(files, tmp_path, capsys):
    scene = tmp_path / "other.toml"
    scene.write_text(SCENE.replace('"steady-pull"\nforce = "3 mN"', '"half-space"'))
    assert main(["check", str(scene)]) == 2
    assert "got 'half-space'; it is a contact effect" in capsys.readouterr().err


@pytest.mark.parametrize(
    ("name", "text", "said"),
    [
        ("absent.py", None, "must be a Python file that exists"),
        ("scene.toml", SCENE, "must be a Python file that exists"),
        ("own-pull.py", PLUGIN, "be named as a module can be"),
        ("attrs.py", PLUGIN, "has this name: rename the file"),
        ("numpy.py", PLUGIN, "has this name: rename the file"),
        ("own_of_a_test_a.py", "x = 1\n", "register a kind"),
        ("own_of_a_test_b.py", "1 / 0\n", "ZeroDivisionError: division by zero"),
        ("own_of_a_test_c.py", "def f(:\n", "SyntaxError"),
    ],
)
def test_a_file_that_is_no_plugin_is_refused(files, tmp_path, capsys, name, text, said):
    path = tmp_path / name
    if text is not None:
        path.write_text(text)
    assert main(["plan", files[0], "--plugin", str(path)]) == 2
    message = capsys.readouterr().err
    assert said in message
    assert "--plugin" in message
    assert "Traceback" not in message


def test_an_error_in_a_plugin_is_not_called_a_defect_of_contactkit(files, capsys):
    scene, plugin = files
    path = Path(plugin)
    path.write_text(
        PLUGIN.replace("lambda gap, speed: self.force", "lambda gap, speed: slef.force")
    )
    assert main(["run", scene, "--plugin", plugin]) == 2
    message = capsys.readouterr().err
    line = next(i for i, text in enumerate(path.read_text().splitlines(), 1) if "slef" in text)
    assert f"{path.name}, line {line}: NameError: name 'slef' is not defined" in message
    assert "defect" not in message


def test_a_store_knows_the_code_of_a_plugin(files, tmp_path, capsys):
    """Points of a law that was changed since are not taken for those of the new one."""
    scene, plugin = files
    store = str(tmp_path / "store")

    def forces():
        with KINDS.including():
            sys.modules.pop(Path(plugin).stem, None)
            assert main(["study", scene, "--plugin", plugin, "--store", store, "--json"]) == 0
        return json.loads(capsys.readouterr().out)["peak_force"]["value"]

    assert forces() == pytest.approx([1e-3, 2e-3])
    Path(plugin).write_text(PLUGIN.replace(": self.force", ": 2.0 * self.force"))
    assert forces() == pytest.approx([2e-3, 4e-3])
