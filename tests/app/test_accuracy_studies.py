"""The table of accuracy studies: by name on the command line, and what it is read by."""

from __future__ import annotations

import json

import pytest

import contactkit as ck
from contactkit._lazy import named
from contactkit.benchmarks import contact_studies, table
from contactkit.cli import main
from contactkit.work_precision import Point


@pytest.fixture
def measured(monkeypatch):
    """Points of the study of slip, in place of half a minute of solves."""
    points = [
        Point("grid", "12 x 12", 4e-3, 0.1, {"convolutions": 22}),
        Point("grid", "48 x 48", 2e-5, 0.4, {"convolutions": 31}),
    ]
    monkeypatch.setattr(contact_studies, "slip", lambda: points)


def test_a_study_has_its_table_advice_and_files(measured, tmp_path, capsys):
    arguments = ["cost", "slip", "--error", "1e-4", "--out", str(tmp_path)]
    assert main(arguments) == 0
    text = capsys.readouterr().out
    assert "12 x 12" in text
    assert "against Mindlin" in text
    assert "cheapest with an error of at most 0.0001: grid, 48 x 48" in text
    assert (tmp_path / "cost.csv").is_file()
    assert main([*arguments[:4], "--json"]) == 0
    found = json.loads(capsys.readouterr().out)
    assert found["grid / 48 x 48 / convolutions"] == {"value": 31, "unit": "-"}


def test_every_study_can_be_measured_and_no_scene_has_its_name():
    from contactkit.models.library import bundled_scenes

    names = [*table.STUDIES, *table.HARD_CASES, *bundled_scenes()]
    assert len(set(names)) == len(names)
    for study in table.STUDIES.values():
        assert callable(named(f"contactkit.{study.measured_by}"))
    for case in table.HARD_CASES.values():
        assert callable(named(f"contactkit.benchmarks.hard.{case.measured_by}"))
    with pytest.raises(ck.DescriptionError, match="did you mean 'slip'"):
        table.study_of("slips")


@pytest.mark.parametrize(
    ("words", "message"),
    [
        (["hertzz"], "did you mean 'hertz'"),  # a study
        (["fuel-injektor"], "did you mean 'fuel-injector'"),  # a scene
        (["?"], "small-opening"),  # all of them, hard cases too
        (["slip", "--set", "loading.force=1"], "settings are of a scene"),
    ],
)
def test_a_name_that_has_no_cost_is_refused(words, message, capsys):
    assert main(["cost", *words]) == 2
    assert message in capsys.readouterr().err


def test_a_hard_case_is_run_by_its_name(capsys):
    assert main(["cost", "small-opening"]) == 0
    text = capsys.readouterr().out
    case = table.study_of("small-opening")
    assert all(part in text for part in (case.title, case.naive, case.ours, case.judge))
    assert main(["cost", "small-opening", "--json"]) == 0
    found = json.loads(capsys.readouterr().out)
    assert found["contactkit / error"]["value"] <= case.holds
    assert found["naive / error"]["value"] >= case.fails


@pytest.mark.slow
def test_errors_fall_with_the_grid():
    """Against Hertz, by the solver that is judged."""
    cylinder = [p for p in contact_studies.lines() if p.method.startswith("cylinder")]
    assert cylinder[0].error > 50.0 * cylinder[-1].error
    assert cylinder[-1].error < 1e-4
    assert all(p.counts["convolutions"] > 0 and p.seconds > 0.0 for p in cylinder)
