"""``contactkit study``: studies of contacts, separations and slidings from their files."""

from __future__ import annotations

import csv
import json

import numpy as np
import pytest

import contactkit as ck
from contactkit.cli import main

pytestmark = [
    pytest.mark.slow,
    pytest.mark.filterwarnings("ignore::contactkit.errors.ValidityWarning"),
]

BRIDGE = """
name = "oil between faces"
[interface.lower]
shape = "flat"
radius = "1 mm"
[interface.upper]
shape = "flat"
radius = "1 mm"
[interface.meniscus]
volume = "1e-12 m3"
[interface.meniscus.liquid]
name = "oil"
viscosity = "0.1 Pa.s"
surface_tension = "30 mN/m"
"""
SEPARATION = (
    BRIDGE
    + """
[loading]
kind = "imposed-time"
initial_gap = "1 um"
final_gap = "10 um"
time = "1 ms"
[[effects]]
effect = "meniscus-force"
profile = "arc"
[[effects]]
effect = "viscous-force"
[accuracy]
points = 30
[study]
"interface.meniscus.liquid.viscosity" = ["0.1 Pa.s", "0.2 Pa.s"]
"loading.initial_gap" = ["1 um", "2 um", "4 um"]
"""
)
SLIDING = (
    BRIDGE
    + """
[loading]
kind = "sliding"
gap = "1 um"
speed = "1 mm/s"
[[effects]]
effect = "couette-force"
[study]
"loading.gap" = ["0.5 um", "1 um", "2 um"]
"""
)
CONTACT = """
name = "rough steel"
[interface.lower]
solid = "bearing-steel"
[interface.upper.surface]
shape = "gaussian-roughness"
rms = "1 nm"
correlation_length = "0.3 um"
cutoff = "0.125 um"
[window]
width = "1 um"
[loading]
kind = "pressing"
pressure = "100 MPa"
[[effects]]
effect = "half-space"
[accuracy]
grid = 32
[study]
"interface.upper.surface.seed" = [1, 2, 3]
"loading.pressure" = ["50 MPa", "100 MPa", "200 MPa"]
"""
FILES = {"separation": SEPARATION, "sliding": SLIDING, "contact": CONTACT}


@pytest.fixture
def file(tmp_path):
    def write(text):
        path = tmp_path / "scene.toml"
        path.write_text(text)
        return str(path)

    return write


def table(path):
    with path.open(encoding="utf-8") as opened:
        head, *rows = csv.reader(opened)
    return {name: [row[i] for row in rows] for i, name in enumerate(head)}


def test_a_separation_file_is_studied(file, tmp_path, capsys):
    out = tmp_path / "out"
    assert main(["study", file(SEPARATION), "--out", str(out)]) == 0
    text = capsys.readouterr().out
    assert text.startswith("study:\nviscosity [Pa.s]  initial_gap [m]")
    assert {each.name for each in out.iterdir()} >= {"study.csv", "study.npz"}
    found = table(out / "study.csv")
    force = np.array(found["mean_viscous_force [N]"], float).reshape(2, 3)
    scene = ck.load_scene(file(SEPARATION))  # its tables of the command line are left out
    alone = ck.simulate(ck.plan(scene)).mean_viscous_force
    assert force[0, 0] == pytest.approx(alone, rel=1e-9)
    assert force[1] == pytest.approx(2.0 * force[0], rel=1e-9)
    saved = ck.read_curve(out / "study.npz")
    assert saved.parts["shape"] == (2, 3)
    assert saved["mean_viscous_force"] == pytest.approx(force.ravel(), rel=1e-9)


def test_a_sliding_file_is_studied(file, tmp_path):
    assert main(["study", file(SLIDING), "--out", str(tmp_path)]) == 0
    found = table(tmp_path / "study.csv")
    drag = np.array(found["peak_tangential_force [N]"], float)
    # The same volume: the area falls with the gap, and the stress too.
    assert drag == pytest.approx(drag[1] * np.array([4.0, 1.0, 0.25]), rel=1e-9)


def test_seeds_are_shown_as_medians_and_written_as_bands(file, tmp_path, capsys):
    assert main(["study", file(CONTACT), "--out", str(tmp_path)]) == 0
    text = capsys.readouterr().out
    assert text.startswith("study, medians of 3 seeds:\n")
    every, bands = (table(tmp_path / f"study{end}.csv") for end in ("", "-bands"))
    fractions = np.array(every["contact_fraction [-]"], float).reshape(3, 3)
    for end, of in (("", np.median), ("_low", np.min), ("_high", np.max)):
        assert np.array(bands[f"contact_fraction{end} [-]"], float) == pytest.approx(
            of(fractions, axis=0), rel=1e-8
        )
    assert (tmp_path / "study-bands.npz").is_file()


@pytest.mark.parametrize(
    "kind", ["separation", "sliding", pytest.param("contact", marks=pytest.mark.exhaustive)]
)
def test_a_study_is_drawn_with_its_bands(file, tmp_path, monkeypatch, kind):
    plot = pytest.importorskip("contactkit.plot.study")
    drawn = []
    draw = plot.draw_line
    monkeypatch.setattr(plot, "draw_line", lambda ax, *args: (drawn.append(ax), draw(ax, *args)))
    assert main(["study", file(FILES[kind]), "--out", str(tmp_path)]) == 0
    assert (tmp_path / "study.png").stat().st_size > 10_000
    for ax in drawn:
        assert ax.get_ylabel()
        assert bool(ax.collections) == (kind == "contact")
    lines = {"separation": 2, "sliding": 1, "contact": 1}[kind]
    assert {len(ax.lines) for ax in drawn} == {lines}
    labels = {ax.get_xlabel() for ax in drawn}
    wanted = {
        "separation": "loading initial gap [µm]",
        "sliding": "loading gap [µm]",
        "contact": "loading pressure [MPa]",
    }
    assert labels == {wanted[kind]}


@pytest.mark.parametrize(
    "kind", [pytest.param("sliding", marks=pytest.mark.exhaustive), "separation", "contact"]
)
def test_a_study_over_its_reference_scales(file, tmp_path, capsys, kind):
    arguments = ["study", file(FILES[kind]), "--dimensionless", "--out", str(tmp_path)]
    assert main(arguments) == 0
    text = capsys.readouterr().out
    scale = {"separation": "F0", "sliding": "x", "contact": "E*"}[kind]
    assert f"\n  {scale}: " in text.partition("in units of")[2]
    head = set(table(tmp_path / "study.csv"))
    wanted = {
        "separation": "viscous_impulse [I0]",
        "sliding": "peak_tangential_force [F0]",
        "contact": "load [E* A]",
    }
    assert wanted[kind] in head
    assert (tmp_path / "study.png").is_file()


def test_the_study_as_json_has_columns(file, capsys):
    assert main(["study", file(SLIDING), "--json"]) == 0
    found = json.loads(capsys.readouterr().out)
    assert found["loading.gap"] == {"value": [5e-7, 1e-6, 2e-6], "unit": "m"}
    assert len(found["couette_impulse"]["value"]) == 3


def test_a_study_goes_on_from_its_store(file, tmp_path, capsys):
    store = tmp_path / "points"
    assert main(["study", file(SLIDING), "--store", str(store)]) == 0
    assert len(list(store.glob("*.json"))) == 3
    capsys.readouterr()
    assert main(["study", file(SLIDING), "--store", str(store)]) == 0
    assert "3 points from the store" in capsys.readouterr().out


@pytest.mark.parametrize(
    "kind", ["separation", pytest.param("sliding", marks=pytest.mark.exhaustive)]
)
def test_run_and_plan_include_the_study_of_the_file(file, tmp_path, capsys, kind):
    path = file(FILES[kind])
    assert main(["plan", path]) == 0
    assert "study, the last path fastest:" in capsys.readouterr().out
    assert main(["run", path, "--out", str(tmp_path / "out")]) == 0
    assert "\nstudy:\n" in capsys.readouterr().out
    written = {each.name for each in (tmp_path / "out").iterdir()}
    assert {"result.npz", "result.csv", "study.csv", "study.npz"} <= written


def test_the_accuracy_of_a_separation_file_is_taken(file, tmp_path):
    assert main(["run", file(SEPARATION), "--out", str(tmp_path)]) == 0
    assert ck.load_result(tmp_path / "result.npz").plan.accuracy.points == 30


REFUSED = {
    "no study": (SLIDING.partition("[study]")[0], r"the scene file has no study: add a table"),
    "no lists": (SLIDING.replace('["0.5 um", "1 um", "2 um"]', '"1 um"'), "be a table of lists"),
    "a path": (SLIDING.replace('"loading.gap"', '"loading.gop"'), "did you mean 'loading.gap'"),
    "a value": (SLIDING.replace('"0.5 um"', '"-0.5 um"'), "gap must be zero or positive"),
    "accuracy": (SLIDING + "[accuracy]\npoint = 3\n", "point"),
}


@pytest.mark.parametrize("case", REFUSED)
def test_a_file_without_a_good_study_is_refused(file, capsys, case):
    text, message = REFUSED[case]
    assert main(["study", file(text)]) == 2
    assert message in capsys.readouterr().err


def test_devices_are_studied_by_run(capsys):
    for name in ("fuel-injector", "micromirror", "bridges"):
        assert main(["study", name]) == 2
        assert "contactkit run includes what its file varies" in capsys.readouterr().err


def test_workers_must_be_a_number_of_processes(file, capsys):
    assert main(["study", file(SLIDING), "--workers", "0"]) == 2
    assert "workers must be a whole number of at least 1" in capsys.readouterr().err


def test_a_study_is_estimated_and_streamed_from_the_command_line(tmp_path, capsys):
    scene, out = tmp_path / "film.toml", tmp_path / "film.sqlite"
    scene.write_text(SEPARATION, encoding="utf-8")
    assert main(["study", str(scene), "--trials", "2", "--json"]) == 0
    estimate = json.loads(capsys.readouterr().out)
    assert estimate["n_points"]["value"] == 6
    assert estimate["cpu_time"]["value"] > 0.0
    assert main(["study", str(scene), "--trials", "2"]) == 0
    assert "study of 6 points" in capsys.readouterr().out
    assert not out.exists()
    for _ in range(2):  # the second time nothing is left to solve
        assert main(["study", str(scene), "--stream", str(out)]) == 0
        assert "6 points, 0 of them without a solution" in capsys.readouterr().out
    assert main(["study", str(scene), "--json"]) == 0
    whole = json.loads(capsys.readouterr().out)["viscous_impulse"]["value"]
    np.testing.assert_allclose(ck.StudyFile(out).column("viscous_impulse"), whole)


@pytest.mark.parametrize("more", [["--trials", "2"], ["--out", "out"], ["--dimensionless"]])
def test_a_streamed_study_takes_no_folder(tmp_path, capsys, more):
    scene = tmp_path / "film.toml"
    scene.write_text(SEPARATION, encoding="utf-8")
    with pytest.raises(SystemExit) as caught:
        main(["study", str(scene), "--stream", str(tmp_path / "film.sqlite"), *more])
    assert caught.value.code == 2
    assert "give one of them alone" in capsys.readouterr().err
    assert not (tmp_path / "film.sqlite").exists()
