"""Pages of the three demands: what the data give, nothing left out, and errors that still hold."""

from __future__ import annotations

from pathlib import Path

import pytest
from demands import PAGES
from demands.hard_case import Found
from demands.hard_cases import CASES
from demands.page import SHOWN, load

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
