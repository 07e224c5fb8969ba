"""How long liquid bridges take, exact and as an arc: single points, limits, what is refused.

Many gaps in one call are the study ``bridge-force`` of test_study_bench.
"""

import numpy as np
import pytest

from contactkit.capillary.arc import flat as arc_flat
from contactkit.capillary.arc import sphere as arc_sphere
from contactkit.capillary.arc.bridge import arc_bridge
from contactkit.capillary.exact.bridge import bridge, bridge_at_pressure
from contactkit.capillary.exact.stability import branch, stability_limit


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


def test_200_gaps_of_the_arc_half_of_them_beyond_the_limit(benchmark):
    gaps = np.append(np.geomspace(1e-7, 0.1, 100), np.geomspace(0.4, 4.0, 100))
    state = benchmark(arc_bridge, gaps, 1e-3, 0.7, 0.7, 0.0, 1.0, beyond="nan")
    assert np.isnan(state.force).sum() == 100


def test_single_force_of_the_arc_between_flats(benchmark):
    shape = arc_flat.shape(1.0, 0.8)

    def force():
        return arc_flat.force(shape, 0.1, arc_flat.contact_radius(shape, 0.1, 1.0))

    assert benchmark(force) > 0.0


def test_gap_at_which_the_neck_of_the_arc_closes(benchmark):
    assert benchmark(arc_sphere.zero_neck_gap, 1e-3, 0.7, 0.7, 0.0, 1.0) > 0.1
