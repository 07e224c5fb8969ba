"""Pages of the three demands: what the data give, nothing left out, and errors that still hold."""

from __future__ import annotations

from pathlib import Path

import pytest
from demands import PAGES
from demands.cost import counts, run
from demands.effect_scenes import CONTACTS, ENTRIES
from demands.effects import lists
from demands.hard_case import Found
from demands.hard_cases import CASES
from demands.page import SHOWN, load

import contactkit as ck
from contactkit.models.library import bundled_scene, bundled_scenes

ROOT = Path(__file__).parents[2]
pytestmark = pytest.mark.filterwarnings("ignore::contactkit.errors.ValidityWarning")

SLOW = {"isolated", "near-limit", "stiff-layer"}


@pytest.mark.parametrize("name", PAGES)
def test_a_page_is_what_its_data_give(name):
    page = (SHOWN / f"{name}.md").read_text(encoding="utf-8")
    assert page == PAGES[name]().page(load(name)), "run python docs/scripts/demands --draw"
    assert f"]({name}.png)" in page
    assert (SHOWN / f"{name}.png").stat().st_size < 100_000


def test_every_hard_case_has_its_numbers():
    assert set(load("hard-cases")["cases"]) == set(CASES)
    assert len([case for case in CASES.values() if case.half == "contact"]) >= 6
    assert len([case for case in CASES.values() if case.half == "separation"]) >= 6
    assert [case.key for case in CASES.values() if not (ROOT / case.tested).exists()] == []


@pytest.mark.parametrize(
    "key", [pytest.param(k, marks=pytest.mark.slow) if k in SLOW else k for k in CASES]
)
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


@pytest.mark.parametrize(
    "kind",
    [
        pytest.param(kind, marks=[pytest.mark.slow] * (kind in CONTACTS), id=kind.__name__)
        for kind in ENTRIES
    ],
)
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
