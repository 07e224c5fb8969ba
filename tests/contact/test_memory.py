"""Memory that a plan states, against what is held when it is solved."""

from __future__ import annotations

import gc
import tracemalloc

import numpy as np
import pytest
from selection import quick

import contactkit as ck
from contactkit.contact.solver.contact_solver import ContactSolver

pytestmark = pytest.mark.filterwarnings("ignore::contactkit.ValidityWarning")

SOLID = ck.Material(young_modulus=0.91, poisson_ratio=0.3)  # a unit contact modulus


def planned(n, periodic):
    heights = 2e-3 * np.random.default_rng(0).standard_normal((n, n)).cumsum(0).cumsum(1) / n
    return ck.plan(
        ck.ContactScene(
            interface=ck.Interface(
                lower=ck.Body(solid=SOLID),
                upper=ck.Body(surface=ck.Heights(heights=heights, pixel_size=1.0 / n)),
            ),
            window=ck.Window(periodic=periodic),
            loading=ck.Pressing(pressure=3e-3),
            effects=(ck.HalfSpace(),),
        )
    )


@pytest.mark.parametrize("periodic", quick([True, False], 0))
def test_a_plan_states_the_memory_of_its_solve(periodic):
    n = 320
    warm = planned(n, periodic)
    assert ck.solve(warm).contact.any()
    assert "memory" in str(warm)
    del warm  # imports and compiled code are no part of it
    gc.collect()
    tracemalloc.start()
    try:
        made = planned(n, periodic)
        given = made.scene.interface.upper.surface.heights.nbytes
        before, stated, text = tracemalloc.get_traced_memory()[0], made.memory, str(made)
        tracemalloc.reset_peak()
        found = ck.solve(made)
        peak = tracemalloc.get_traced_memory()[1] - given
    finally:
        tracemalloc.stop()
    assert before < stated
    assert peak == pytest.approx(stated, rel=0.15)
    assert f"memory: {stated / 2**20:.3g} MiB" in text
    assert "memory" not in str(found.plan)  # nothing is prepared there


@pytest.mark.slow
def test_memory_of_the_solver_is_that_of_ten_maps_or_six_padded_ones():
    """With the heights, pressure and displacement, and a twentieth of the map in contact.

    From 512 x 512 on; tables that do not grow with the map are a tenth of a map at 256 x 256.
    """

    def half_space(shape, pixel):
        q = np.hypot(np.fft.fftfreq(shape[0])[:, None], np.fft.rfftfreq(shape[1]))
        return np.divide(1.0, q, out=np.zeros_like(q), where=q > 0.0)

    def free(shape, pixel):
        y, x = np.indices((shape[0] + 1, shape[1] + 1))
        quadrant = 1.0 / (0.3 + np.hypot(y, x))
        half = np.concatenate([quadrant, quadrant[-2:0:-1]])
        return np.fft.rfft2(np.hstack([half, half[:, -2:0:-1]])).real

    h = np.random.default_rng(0).standard_normal((512, 512))
    h = sum(np.roll(h, (i, j), (0, 1)) for i in range(4) for j in range(4))
    for make, periodic, load, most in ((half_space, True, 0.02, 10.0), (free, False, 0.02, 6.0)):
        solver = ContactSolver((512, 512), (1.0, 1.0), make, periodic)
        found = solver.solve(h, mean_pressure=load)
        assert found.converged
        assert 0.02 < np.mean(found.pressure > 0.0) < 0.08
        assert found.memory_arrays <= most
    large = ContactSolver((896, 896), (1.0, 1.0), free, False)  # columns in strips
    found = large.solve(np.pad(h, 192, "wrap"), mean_pressure=0.02)
    assert found.converged
    assert 4.0 * found.memory_arrays <= 10.5


def test_coarse_grids_in_the_memory_of_the_finest_leave_nothing_behind():
    """A second solve, and one from a start, are what a new solver gives."""
    n = 128
    first, second = planned(n, True), planned(n, True)
    once = ck.solve(first)
    again = ck.solve(first)
    assert np.array_equal(once.pressure, again.pressure)
    other = first.with_loading(ck.Pressing(pressure=5e-3))
    warm = ck.solve(other, start=once)
    cold = ck.solve(second.with_loading(ck.Pressing(pressure=5e-3)))
    np.testing.assert_allclose(warm.pressure, cold.pressure, atol=1e-6 * cold.max_pressure)
