"""The head-disk interface and contact scenes from the command line: numbers, files, figures."""

from __future__ import annotations

import csv
import json

import attrs
import pytest
from attrs import evolve

import contactkit as ck
from contactkit.app.scenes import open_scene
from contactkit.cli import main
from contactkit.contact.effects.base import Compliance, PressureBound

pytestmark = pytest.mark.filterwarnings("ignore::contactkit.errors.ValidityWarning")

FIGURES = (
    *("pressure", "gap", "displacement", "heights", "areas", "section", "stack", "stress"),
    *("pressure_close_up", "stress_close_up", "traction_x"),
)
SMALL = """
name = "small contact"

[interface.lower.solid]
substrate = "ni-p"
layers = [{ material = "dlc", thickness = "5 nm" }]

[interface.upper.surface]
shape = "gaussian-roughness"
rms = "3 nm"
correlation_length = "0.4 um"
cutoff = "0.1 um"

[interface.meniscus]
liquid = "water"
contact_angle_lower = "60 deg"
contact_angle_upper = "60 deg"

[window]
width = "2 um"

[loading]
kind = "pressing"
pressure = "40 MPa"

[accuracy]
grid = 48
rtol = 1e-4

[study]
"loading.pressure" = ["10 MPa", "40 MPa"]

[[effects]]
effect = "layered-half-space"

[[effects]]
effect = "hardness-limit"
rule = "material"

[[effects]]
effect = "friction-traction"
coefficient = 0.3

[[effects]]
effect = "subsurface-stress"
depths = ["0 nm", "10 nm", "50 nm"]

[[effects]]
effect = "film-meniscus"
film_thickness = "1 nm"
"""


@pytest.fixture
def scene_file(tmp_path):
    path = tmp_path / "small.toml"
    path.write_text(SMALL)
    return path


def test_the_disk_is_the_one_of_table_2_1():
    scene = open_scene("head-disk").scene
    disk, slider = scene.interface.lower.stack, scene.interface.upper.stack
    assert [m.young_modulus / 1e9 for m in disk.materials] == [140.0, 190.0, 130.0, 70.0]
    assert [m.hardness / 1e9 for m in disk.materials][:3] == [15.0, 9.0, 7.0]
    assert (slider.substrate.young_modulus, slider.substrate.hardness) == (450e9, 23e9)
    assert {e.name for e in scene.effects} == {
        "layered-half-space",
        "hardness-limit",
        "friction-traction",
        "subsurface-stress",
        "film-meniscus",
    }


@pytest.mark.slow
def test_the_disk_presses_as_it_did():
    """Golden numbers on a grid just fine enough for its roughness."""
    opened = open_scene("head-disk")
    kept = tuple(
        e for e in opened.scene.effects if e.name in ("layered-half-space", "hardness-limit")
    )
    scene = attrs.evolve(opened.scene, effects=kept)
    run = ck.solve(ck.plan(scene, ck.Accuracy(grid=512, rtol=1e-6)))
    assert run.status == "converged"
    assert run.mean_pressure == pytest.approx(100e6, rel=1e-9)
    assert run.contact_fraction == pytest.approx(0.0454, rel=0.03)
    assert run.max_pressure == pytest.approx(run.of(ck.HardnessLimit).hardness, rel=0.2)
    assert 8e9 < run.of(ck.HardnessLimit).hardness < 15e9


@pytest.mark.slow
def test_a_scene_runs_into_numbers_files_and_figures(scene_file, tmp_path, capsys):
    out = tmp_path / "out"
    assert main(["run", str(scene_file), "--out", str(out)]) == 0
    shown = capsys.readouterr().out
    for said in (
        "validity:",
        "pixels per shortest wave = 2.4 (at least 8)",
        "max_pressure",
        "study:\n",
    ):
        assert said in shown
    names = {path.name for path in out.iterdir()}
    assert names == {
        "contactkit.json",
        "result.npz",
        "study.csv",
        "study.npz",
        "study.png",
        *(f"{name.replace('_', '-')}.png" for name in FIGURES),
    }
    loaded = ck.load_result(out / "result.npz")
    assert f"max_pressure             {loaded.max_pressure:.6g} Pa" in shown
    with (out / "study.csv").open(newline="") as file:
        rows = list(csv.DictReader(file))
    assert "max_von_mises [Pa]" in rows[0]  # what the scene lists, a study simulates
    areas = [float(row["contact_fraction [-]"]) for row in rows]
    assert len(areas) == 2
    assert areas[0] < areas[1] == pytest.approx(loaded.contact_fraction)


def test_a_run_prints_its_numbers_for_scripts(scene_file, capsys):
    assert main(["run", str(scene_file), "--json"]) == 0
    numbers = json.loads(capsys.readouterr().out)
    assert numbers["mean_pressure"] == {"value": pytest.approx(40e6), "unit": "Pa"}
    assert numbers["max_von_mises"]["unit"] == "Pa"
    assert numbers["meniscus_force"]["value"] > 0.0


def test_the_plan_says_what_is_on_and_off(scene_file, capsys):
    assert main(["plan", str(scene_file)]) == 0
    shown = capsys.readouterr().out
    assert "on   film-meniscus" in shown
    assert "off  friction-coupling" in shown
    assert "Eq. (2.43)" in shown
    assert "study, the last path fastest:\n  loading.pressure: 2 values" in shown


@pytest.mark.parametrize("command", ["plan", "run"])
@pytest.mark.parametrize(
    ("old", "new", "message"),
    [
        ('"loading.pressure" =', '"loading.presure" =', "did you mean 'loading.pressure'"),
        ('["10 MPa", "40 MPa"]', '["10 MPa", "40 MPs"]', "'MPs'"),
        ('["10 MPa", "40 MPa"]', "[]", "have at least one value"),
        ('width = "2 um"', 'width = "2 m"', "cutoff must be at least two pixels"),
        ('cutoff = "0.1 um"', 'cutoff = "0.05 um"', "cutoff must be at least two pixels"),
        ('width = "2 um"', "", "Window.width must be given"),
    ],
)
def test_the_plan_refuses_what_a_run_would_and_a_run_before_its_solve(
    tmp_path, capsys, monkeypatch, command, old, new, message
):
    assert old in SMALL
    monkeypatch.setattr("contactkit.contact.solve._solved", None)
    path = tmp_path / "bad.toml"
    path.write_text(SMALL.replace(old, new))
    assert main([command, str(path)]) == 2
    assert message in capsys.readouterr().err


def test_a_file_may_vary_paths_together(tmp_path, capsys):
    thickness = "interface.lower.solid.layers.0.thickness"
    rows = f'"{thickness}, loading.pressure" = [["5 nm", "10 MPa"], ["10 nm", "40 MPa"]]'
    path = tmp_path / "rows.toml"
    path.write_text(SMALL.replace('"loading.pressure" = ["10 MPa", "40 MPa"]', rows))
    assert main(["plan", str(path)]) == 0
    assert f"{thickness}, loading.pressure: 2 values" in capsys.readouterr().out
    opened = open_scene(str(path))
    made = ck.study(opened.scene, opened.parameters, ck.Accuracy(grid=48, rtol=1e-3))
    assert made.shape == (2,)
    assert made.column(thickness).tolist() == [5e-9, 1e-8]


@pytest.mark.slow
def test_the_cost_of_a_contact_compares_solvers_grids_and_effects(scene_file, tmp_path, capsys):
    out = tmp_path / "cost"
    assert main(["cost", str(scene_file), "--out", str(out), "--json"]) == 0
    numbers = json.loads(capsys.readouterr().out)
    errors = [numbers[f"active-set / rtol 1e-0{n} / error"]["value"] for n in (2, 8)]
    assert errors[1] < 1e-6 < 0.1 > errors[0]
    assert numbers["conjugate-gradient / rtol 1e-06 / error"]["value"] < 1e-3
    assert numbers["quasi-newton / rtol 1e-02 / operator applications"]["value"] > 0
    assert "edge-corrected area / 48 x 48 / error" in numbers
    assert "effects up to + film-meniscus / seconds" in numbers
    # That of the contact alone, whatever its pixels leave: spots of two pixels may be off by 100 %.
    opened = open_scene(str(scene_file))
    alone = [e for e in opened.scene.effects if isinstance(e, Compliance | PressureBound)]
    plan = ck.plan(evolve(opened.scene, effects=alone), opened.accuracy)
    stated = ck.discretisation_error(ck.solve(plan)).errors["max_pressure"]
    assert numbers["discretisation error / max_pressure"]["value"] == pytest.approx(
        stated, rel=1e-6
    )
    assert stated > 0.0
    assert {path.name for path in out.iterdir()} == {"contactkit.json", "cost.png", "cost.csv"}


def test_a_wet_contact_has_no_fmu_and_is_refused(scene_file, tmp_path, capsys):
    assert main(["fmu", "build", str(scene_file), "--out", str(tmp_path / "a.fmu")]) == 2
    assert "leave out film-meniscus" in capsys.readouterr().err
    assert not list(tmp_path.glob("*.fmu"))


def test_a_study_table_that_is_none_is_refused(tmp_path, capsys):
    path = tmp_path / "bad.toml"
    path.write_text(SMALL.replace('["10 MPa", "40 MPa"]', '"10 MPa"'))
    assert main(["run", str(path)]) == 2
    assert "must be a table of lists" in capsys.readouterr().err
