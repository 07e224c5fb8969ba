"""Studies of accuracy and hard cases of the table, each measured once: seconds of the whole."""

from __future__ import annotations

import pytest

from contactkit.benchmarks.table import HARD_CASES, STUDIES

pytestmark = pytest.mark.filterwarnings("ignore::contactkit.ValidityWarning")


@pytest.mark.parametrize("name", STUDIES)
def test_study(benchmark, name):
    points = benchmark.pedantic(STUDIES[name].points, rounds=1)
    errors = [one.error for one in points if not one.is_model and one.error == one.error]
    counts = [sum(one.counts.values()) for one in points]
    benchmark.extra_info |= {"settings": len(points), "least error": f"{min(errors):.0e}"}
    benchmark.extra_info |= {"work of all": sum(counts)}


@pytest.mark.parametrize("name", HARD_CASES)
def test_hard_case(benchmark, name):
    found = benchmark.pedantic(HARD_CASES[name].run, rounds=1)
    benchmark.extra_info |= {"error": f"{found.ours:.0e}"}
    assert found.ours <= HARD_CASES[name].holds
