"""How long the exact bridge takes: 200 gaps in one call, limits, and single points."""

import math

import numpy as np
import pytest

from contactkit.capillary.exact.bridge import bridge, bridge_at_pressure
from contactkit.capillary.exact.stability import branch, stability_limit

FLATS = [(1.0, 1.0), (0.5, 1.0), (2.0, 2.2), (math.pi / 3, 2 * math.pi / 3)]


@pytest.mark.parametrize("angles", FLATS, ids=str)
@pytest.mark.parametrize("first", [True, False], ids=["first", "again"])
def test_200_gaps_between_flats(benchmark, angles, first):
    gaps = np.geomspace(1e-3, 0.95 * float(stability_limit(1.0, *angles).gap), 200)

    def forces():
        if first:
            branch.cache_clear()
        return bridge(gaps, 1.0, *angles).force

    assert np.all(np.isfinite(benchmark(forces)))


@pytest.mark.parametrize("bend", [(0.0, 1.0), (1.0, 1.0), (0.3, 1.0)], ids=str)
@pytest.mark.parametrize("fraction", [0.9, 0.99])
def test_200_gaps_between_curved_bodies(benchmark, bend, fraction):
    fixed = (1e-3, 0.7, 0.7, *bend)
    gaps = np.linspace(0.0, fraction * float(stability_limit(*fixed).gap), 200)
    assert np.all(np.isfinite(benchmark(bridge, gaps, *fixed).force))


def test_200_gaps_at_a_pressure(benchmark):
    gaps = np.linspace(0.0, 0.01, 200)
    state = benchmark(bridge_at_pressure, gaps, -100.0, 0.7, 0.7, 0.0, 1.0)
    assert np.all(np.isfinite(state.force))


def test_single_force_on_a_sphere(benchmark):
    assert benchmark(bridge, 0.05, 1e-3, 0.7, 0.7, 0.0, 1.0).force > 0.0


@pytest.mark.parametrize("bend", [0.0, 1.0])
@pytest.mark.parametrize("upper", [0.7, 1.0])
def test_limit(benchmark, bend, upper):
    def limit():
        branch.cache_clear()
        return stability_limit(1e-3, 0.7, upper, 0.0, bend)

    assert benchmark(limit).gap > 0.05
