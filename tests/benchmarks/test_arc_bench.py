"""How long the arc takes: 200 gaps in one call, and single points as a time step asks for them."""

import numpy as np
import pytest

from contactkit.capillary.arc import flat as arc_flat
from contactkit.capillary.arc import sphere as arc_sphere
from contactkit.capillary.arc.bridge import arc_bridge

FLAT_GAPS = np.geomspace(1e-3, 2.0, 200)
SPHERE_GAPS = np.geomspace(1e-7, 0.1, 200)


def test_200_gaps_between_flats(benchmark):
    state = benchmark(arc_bridge, FLAT_GAPS, 1.0, 1.0, 1.0)
    assert np.all(np.isfinite(state.force))


@pytest.mark.parametrize("lower", [0.0, 0.3])
def test_200_gaps_between_curved_bodies(benchmark, lower):
    state = benchmark(arc_bridge, SPHERE_GAPS, 1e-3, 0.7, 0.7, lower, 1.0)
    assert np.all(np.isfinite(state.force))


def test_200_gaps_half_of_them_beyond_the_limit(benchmark):
    gaps = np.append(SPHERE_GAPS[::2], np.geomspace(0.4, 4.0, 100))
    state = benchmark(arc_bridge, gaps, 1e-3, 0.7, 0.7, 0.0, 1.0, beyond="nan")
    assert np.isnan(state.force).sum() == 100


def test_single_force_between_flats(benchmark):
    shape = arc_flat.shape(1.0, 0.8)

    def force():
        return arc_flat.force(shape, 0.1, arc_flat.contact_radius(shape, 0.1, 1.0))

    assert benchmark(force) > 0.0


def test_gap_at_which_the_neck_closes_on_a_sphere(benchmark):
    assert benchmark(arc_sphere.zero_neck_gap, 1e-3, 0.7, 0.7, 0.0, 1.0) > 0.1
