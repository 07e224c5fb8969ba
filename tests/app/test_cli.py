"""The command line, as a user types it."""

from __future__ import annotations

import json
import subprocess
import sys
from pathlib import Path

import pytest
from selection import quick

from contactkit.cli import main

SCENE = """\
name = "drop of oil"
temperature = "25 degC"
[interface.lower]
shape = "flat"
radius = "3 mm"
[interface.upper]
shape = "flat"
[interface.meniscus]
volume = "0.1 mm3"
contact_angle_lower = "60 deg"
[interface.meniscus.liquid]
name = "oil"
viscosity = "10 mPa.s"
surface_tension = "30 mN/m"
density = "870 kg/m3"
[loading]
kind = "imposed-force"
initial_gap = "5 um"
final_gap = "50 um"
force = "40 N"
mass = "20 g"
[[effects]]
effect = "meniscus-force"
[[effects]]
effect = "viscous-force"
"""


@pytest.fixture
def scene(tmp_path):
    path = tmp_path / "drop.toml"
    path.write_text(SCENE)
    return path


def test_run_prints_numbers_and_validity(scene, capsys):
    assert main(["run", str(scene)]) == 0
    printed = capsys.readouterr().out
    for word in ("released after", "viscous_impulse", "N.s", "Reynolds number", "off  rupture"):
        assert word in printed


def test_run_json_prints_only_numbers_with_their_units(scene, capsys):
    assert main(["run", str(scene), "--json"]) == 0
    numbers = json.loads(capsys.readouterr().out)
    assert numbers["release_time"]["unit"] == "s"
    assert 0.0 < numbers["release_time"]["value"] < 1.0


def test_run_writes_curves_and_figures(scene, tmp_path, capsys):
    out = tmp_path / "out"
    assert main(["run", str(scene), "--out", str(out)]) == 0
    assert {p.name for p in out.iterdir()} == {
        "result.npz",
        "result.csv",
        "forces.png",
        "gap.png",
        "contactkit.json",
    }
    assert "written" in capsys.readouterr().out


@pytest.mark.parametrize(
    ("kind", "imposed"),
    [("imposed-speed", 'speed = "10 mm/s"'), ("imposed-time", 'time = "1 ms"')],
)
def test_run_takes_every_kind_of_loading(scene, tmp_path, kind, imposed, capsys):
    text = scene.read_text().replace('force = "40 N"', imposed).replace('mass = "20 g"', "")
    text = text.replace("imposed-force", kind)
    scene.write_text(text)
    assert main(["run", str(scene), "--out", str(tmp_path / "out")]) == 0
    assert "newtonian_impulse" in capsys.readouterr().out


def test_plan_says_what_is_on_and_off_and_by_which_sources(scene, capsys):
    assert main(["plan", str(scene)]) == 0
    printed = capsys.readouterr().out
    assert "on   viscous-force" in printed
    assert "off  tension-limit" in printed
    assert "Stefan 1874" in printed


@pytest.mark.slow
def test_cost_recommends_a_setting(scene, tmp_path, capsys):
    assert main(["cost", str(scene), "--out", str(tmp_path), "--error", "1e-4"]) == 0
    printed = capsys.readouterr().out
    assert "cheapest with an error of at most 0.0001: " in printed
    assert (tmp_path / "cost.png").exists()


def test_an_fmu_is_built_from_a_scene(scene, tmp_path, capsys):
    target = tmp_path / "drop.fmu"
    assert main(["fmu", "build", str(scene), "--out", str(target)]) == 0
    assert target.exists()
    assert "valid" in capsys.readouterr().out


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (["run", "nothing.toml"], r"file must exist"),
        (["plan", "fuel-injctor"], r"did you mean 'fuel-injector'"),
        (["fmu", "build", "stiction-mass", "--out", "x.zip"], r"must end in \.fmu"),
        (["fmu", "build", "stiction-mass", "--fmi", "3", "--out", "x.fmu"], r"FMUs of FMI 2\.0"),
        (["fmu", "build", "stiction-mas", "--out", "x.fmu"], r"stiction-mas"),
    ],
)
def test_mistakes_are_reported_in_one_line_and_leave_no_file(
    arguments, message, tmp_path, monkeypatch, capsys
):
    monkeypatch.chdir(tmp_path)
    assert main(arguments) == 2
    error = capsys.readouterr().err
    assert error.startswith("contactkit: ")
    assert pytest.importorskip("re").search(message, error)
    assert list(tmp_path.iterdir()) == []


def test_a_bad_scene_writes_nothing(scene, tmp_path, capsys):
    scene.write_text(SCENE.replace('viscosity = "10 mPa.s"', 'viscosity = "-10 mPa.s"'))
    assert main(["run", str(scene), "--out", str(tmp_path / "out")]) == 2
    assert "Liquid.viscosity must be positive and finite [Pa.s]" in capsys.readouterr().err
    assert not (tmp_path / "out").exists()


@pytest.mark.slow
def test_the_package_runs_as_a_module():
    done = subprocess.run(
        [sys.executable, "-m", "contactkit", "plan", "nothing.toml"],
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.returncode == 2
    assert done.stderr.startswith("contactkit: ")


def test_help_imports_nothing_heavy():
    script = """
import sys
from contactkit.cli import main
try:
    main(["--help"])
except SystemExit:
    heavy = {"numpy", "scipy", "matplotlib", "fmpy", "tqdm", "cattrs"}
    print(sorted(heavy & set(sys.modules)))
"""
    done = subprocess.run(
        [sys.executable, "-c", script], capture_output=True, text=True, check=True
    )
    assert done.stdout.strip().endswith("[]")


def test_the_version_is_printed(capsys):
    assert main(["--version"]) == 0
    assert capsys.readouterr().out.strip() == "0.1.0"


def test_the_module_runs_as_a_script(scene):
    command = [sys.executable, "-m", "contactkit.cli", "plan", str(Path(scene))]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    assert done.returncode == 0
    assert "viscous-force" in done.stdout


TOUCH = """\
[interface.lower]
solid = "bearing-steel"
[interface.upper]
shape = "paraboloid"
radius = "1 mm"
[window]
width = "60 um"
periodic = false
[loading]
kind = "pressing"
force = "1 N"
[[effects]]
effect = "half-space"
[[effects]]
{effects}
[accuracy]
grid = 16
[study]
{study}
"""
SLIP = (
    'effect = "partial-slip"\ncoefficient = 0.3\npath = [{ ratio = 0.6, steps = 2 }]',
    '"effects.partial-slip.coefficient" = [0.1, 0.2]',
    "slip-zones.png",
    ["tangential_force", "friction_work"],
)
HISTORY = (
    'effect = "hardness-limit"\nrule = { kind = "constant", hardness = "1 GPa" }\n'
    '[[effects]]\neffect = "plastic-history"\nforces = [2.0]\nsteps = 3',
    '"effects.plastic-history.forces" = [[1.5], [2.0, 0.1]]',
    "force-approach.png",
    ["plastic_work", "max_residual_depth"],
)


@pytest.mark.parametrize(("effects", "study", "figure", "names"), quick([SLIP, HISTORY], long=[0]))
def test_a_study_of_an_effect_shows_its_numbers_over_what_varies(
    tmp_path, capsys, monkeypatch, effects, study, figure, names
):
    plot = pytest.importorskip("contactkit.plot.study")
    drawn = []
    draw = plot.study_curves
    monkeypatch.setattr(
        plot, "study_curves", lambda *args, **more: drawn.append(draw(*args, **more))
    )
    path = tmp_path / "touch.toml"
    path.write_text(TOUCH.format(effects=effects, study=study))
    assert main(["run", str(path), "--out", str(tmp_path / "out")]) == 0
    written = {each.name for each in (tmp_path / "out").iterdir()}
    assert {figure, "study.csv", "study.png"} <= written
    table = capsys.readouterr().out.partition("\nstudy:\n")[2].partition("\n")[0]
    assert all(name in table for name in names)
    shown = {ax.get_ylabel().partition(" [")[0]: ax for ax in drawn[0] if ax.lines}
    assert {name.replace("_", " ") for name in names} <= set(shown)
    for ax in shown.values():
        assert len(set(ax.lines[0].get_xdata())) == 2
        assert ax.get_xlabel().split(" [")[0] in (
            "partial-slip coefficient",
            "plastic-history forces",
        )
    # Friction does not change the pressure: no panel shows a straight line.
    assert ("max pressure" in shown) == (figure != "slip-zones.png")
