"""Pages of the three demands: what the data give, nothing left out, and errors that still hold."""

from __future__ import annotations

import inspect
import re
import typing
from pathlib import Path

import pytest
from demands import PAGES
from demands.accuracy import ANALYSES, digit, shown
from demands.effect_scenes import CONTACTS, ENTRIES
from demands.effects import lists
from demands.page import SHOWN, load
from selection import quick

import contactkit as ck
from contactkit.benchmarks import timing
from contactkit.benchmarks.hard.case import Found
from contactkit.benchmarks.table import HARD_CASES as CASES
from contactkit.benchmarks.table import STUDIES
from contactkit.benchmarks.timing import counts, run
from contactkit.models.library import bundled_scene, bundled_scenes

ROOT = Path(__file__).parents[2]
pytestmark = pytest.mark.filterwarnings("ignore::contactkit.errors.ValidityWarning")

SLOW = {"isolated", "stiff-layer"}
SLOWEST = {"near-limit"}


def chosen(cases, long, longest):
    """All cases, of which those of seconds are slow, and those of ten seconds exhaustive."""
    cases = [*cases]
    fast = [i for i, one in enumerate(cases) if one not in long | longest]
    return quick(cases, *fast, long=[i for i, one in enumerate(cases) if one in long])


@pytest.mark.parametrize("name", PAGES)
def test_a_page_is_what_its_data_give(name):
    page = (SHOWN / f"{name}.md").read_text(encoding="utf-8")
    assert page == PAGES[name]().page(load(name)), "run python docs/scripts/demands --draw"
    pictures = re.findall(r"\]\(([\w-]+\.png)\)", page)
    assert f"{name}.png" in pictures
    assert all((SHOWN / picture).stat().st_size < 100_000 for picture in pictures)


def test_every_hard_case_has_its_numbers():
    assert set(load("hard-cases")["cases"]) == set(CASES)
    assert len([case for case in CASES.values() if case.half == "contact"]) >= 6
    assert len([case for case in CASES.values() if case.half == "separation"]) >= 6
    assert [case.name for case in CASES.values() if not (ROOT / case.tested).exists()] == []


@pytest.mark.parametrize("key", chosen(CASES, SLOW, SLOWEST))
def test_a_hard_case_still_holds_and_the_naive_method_still_fails(key):
    case, shown = CASES[key], load("hard-cases")["cases"][key]
    for found in (case.run(), Found(**shown)):
        assert found.ours <= case.holds
        assert found.naive is None or found.naive >= case.fails
        assert (found.naive is None) == (shown["naive"] is None)


SHOWN_EFFECTS = load("effects")["effects"]


def test_every_registered_effect_has_its_entry_and_every_shipped_scene_its_effects():
    assert {kind.name for kind in ENTRIES} == set(ck.EFFECTS.by_name) == set(SHOWN_EFFECTS)
    for scene in bundled_scenes():
        listed = {kind.name for kind in ck.EFFECTS if lists(bundled_scene(scene), kind)}
        path = bundled_scene(scene).relative_to(ROOT).as_posix()
        assert listed == {name for name, one in SHOWN_EFFECTS.items() if path in one["scenes"]}
    for name, one in SHOWN_EFFECTS.items():
        assert [path for path in one["scenes"] if not (ROOT / path).exists()] == [], name
        assert one["sources"], name


LONG = {*CONTACTS, ck.ElasticBodies, ck.LandauLevichFilm}  # seconds
LONGEST = {ck.SolidContact}  # ten


@pytest.mark.parametrize("kind", chosen(ENTRIES, LONG, LONGEST), ids=lambda kind: kind.__name__)
def test_an_effect_still_costs_what_the_page_counts(kind):
    """Counts, and that the scene without the effect has no trace of it."""
    entry, shown = ENTRIES[kind], SHOWN_EFFECTS[kind.name]
    assert any(isinstance(effect, kind) for effect in entry.scene.effects)
    pairs = [(entry.scene, shown["with"])]
    if entry.without is not None:
        assert not any(isinstance(effect, kind) for effect in entry.without.effects)
        pairs.append((entry.without, shown["without"]))
    for scene, found in pairs:
        now = counts(run(scene, entry.accuracy))
        assert set(now) == set(found["counts"])
        for name, count in found["counts"].items():
            assert now[name] == pytest.approx(count, rel=0.15, abs=10), name


SHOWN_STUDIES = load("accuracy-and-cost")["studies"]
COVERED = {solver for study in STUDIES.values() for solver in study.solvers}
FILES = {"plan", "plan_study", "save_scene"}  # they compute no answer


def test_every_solver_and_every_shipped_scene_has_its_errors():
    methods = typing.get_type_hints(ck.Accuracy)["method"]
    assert set(typing.get_args(methods)) <= COVERED
    assert set(bundled_scenes()) <= COVERED
    named = {name: getattr(ck, name) for name in ck.__all__}
    functions = {name: one for name, one in named.items() if inspect.isfunction(one)}
    for name in set(functions) - FILES:
        first = next(iter(inspect.signature(functions[name]).parameters.values()), None)
        kind = "" if first is None else str(first.annotation)
        if any(word in kind for word in ("Scene", "Plan", "SpringSlider")):
            assert name in COVERED | set(ANALYSES), f"{name} has no study of its error"
    assert [test for _, test in ANALYSES.values() if not (ROOT / test).exists()] == []


def test_every_study_is_shown_with_seconds_and_within_its_bounds():
    """Errors are against the references of the studies: a wrong number is not kept by the page."""
    assert list(SHOWN_STUDIES) == list(STUDIES)
    for name, points in SHOWN_STUDIES.items():
        assert STUDIES[name].exceeded(shown(points)) == {}, name
        for point in points:
            assert point["error"] is None or point["seconds"] > 0.0, (name, point)


def test_release_times_are_right_by_every_preset():
    """Against the two other codes."""
    assert {p["method"] for p in SHOWN_STUDIES["releases"]} == {f"case {n}" for n in "ABDE"}
    assert all(point["error"] < 1e-6 for point in SHOWN_STUDIES["releases"])


def test_no_error_of_ours_is_large_without_a_word():
    """Where a setting gives a wrong answer, the note of the study states it."""
    for name, points in SHOWN_STUDIES.items():
        wrong = [p for p in points if not p["is_model"] and (p["error"] or 0.0) > 1.0]
        assert not wrong or STUDIES[name].note, name


def test_a_digit_is_the_slope_of_the_logarithms():
    points = [{"method": "a", "error": 10.0**-n, "seconds": 0.1 * 3.0**n} for n in range(1, 6)]
    assert digit(points, "a") == pytest.approx(3.0)


@pytest.mark.parametrize(
    "name",
    [
        "compliances",
        *(
            pytest.param(name, marks=pytest.mark.slow)
            for name in ("bridge-force", "slip", "history", "lines")
        ),
        *(pytest.param(name, marks=pytest.mark.exhaustive) for name in ("releases", "waves")),
    ],
)
def test_errors_of_a_study_are_within_its_bounds(name, monkeypatch):
    """Measured again; the bound is on the error against the reference of the study."""
    monkeypatch.setattr(timing, "REPEATS", 0)
    study = STUDIES[name]
    points = study.points()
    assert study.exceeded(points) == {}
    found = [(point.method, point.label) for point in points]
    assert found == [(point["method"], point["setting"]) for point in SHOWN_STUDIES[name]]
    for point, before in zip(points, SHOWN_STUDIES[name], strict=True):
        for unit, count in before["counts"].items():
            assert point.counts[unit] == pytest.approx(count, rel=0.1, abs=5)
