"""Contacts at the ends of what can be asked: one pixel, all pixels, caps, contrasts, odd maps."""

from __future__ import annotations

import numpy as np
import pytest
from selection import quick

from contactkit.contact.solver import contact_solver
from contactkit.contact.solver.contact_solver import ContactSolver
from contactkit.elasticity import layered
from contactkit.errors import DescriptionError, InfeasibleError

pytestmark = pytest.mark.hard

N = 64
PIXEL = (1e-8, 1e-8)


def half_space(shape, pixel_size):
    qy = 2.0 * np.pi * np.fft.fftfreq(shape[0], pixel_size[0])[:, None]
    qx = 2.0 * np.pi * np.fft.rfftfreq(shape[1], pixel_size[1])
    q = np.hypot(qy, qx)
    return np.divide(2.0, 1e11 * q, out=np.zeros_like(q), where=q > 0.0)


def stack(contrast, thickness):
    def make(shape, pixel_size):
        qy = 2.0 * np.pi * np.fft.fftfreq(shape[0], pixel_size[0])[:, None]
        qx = 2.0 * np.pi * np.fft.rfftfreq(shape[1], pixel_size[1])
        q = np.hypot(qy, qx)
        q[0, 0] = 1.0
        moduli, poisson = np.array([contrast * 1e11, 1e11]), np.array([0.3, 0.3])
        symbol = np.array(layered.compliance(q, moduli, poisson, np.array([thickness])).C)
        symbol[0, 0] = 0.0
        return symbol

    return make


def rough(shape, seed=1):
    spectrum = np.fft.rfft2(np.random.default_rng(seed).standard_normal(shape))
    k = np.hypot(np.fft.fftfreq(shape[0])[:, None], np.fft.rfftfreq(shape[1]))
    k[0, 0] = np.inf
    h = np.fft.irfft2(spectrum * k**-1.8, s=shape)
    return 1e-9 * h / h.std()


HEIGHTS = rough((N, N))


@pytest.fixture(scope="module")
def solver():
    return ContactSolver((N, N), PIXEL, half_space, periodic=True, fast=False)


def test_a_load_so_small_that_one_pixel_carries_it(solver):
    s = solver.solve(HEIGHTS, mean_pressure=1e-3)
    assert s.converged
    assert np.count_nonzero(s.pressure) == 1
    assert np.argmax(s.pressure) == np.argmax(HEIGHTS)
    assert s.pressure.max() == pytest.approx(1e-3 * N * N)


def test_a_spike_and_then_all_the_rest(solver):
    spike = np.zeros((N, N))
    spike[3, 5] = 1e-9
    few = solver.solve(spike, mean_pressure=1e2)
    assert np.count_nonzero(few.pressure) == 1
    rest = solver.solve(spike, mean_pressure=1e9)
    assert rest.converged
    assert not rest.fallback
    assert np.count_nonzero(rest.pressure) > 0.99 * N * N


def test_no_load_and_no_contact(solver):
    for s in (
        solver.solve(HEIGHTS, mean_pressure=0.0),
        solver.solve(HEIGHTS, rigid_approach=-1e-7),
    ):
        assert s.converged
        assert s.kkt == 0.0
        assert not s.pressure.any()
        assert s.energy == 0.0
    assert solver.solve(HEIGHTS, mean_pressure=0.0).rigid_approach == pytest.approx(-HEIGHTS.max())


@pytest.mark.parametrize("fraction", [0.9, 0.99, 0.9999, 1.0 - 1e-9])
def test_a_load_just_below_what_the_bound_carries(solver, fraction):
    bound = 2e9
    s = solver.solve(HEIGHTS, mean_pressure=fraction * bound, bound=bound)
    assert s.converged
    assert s.pressure.mean() == pytest.approx(fraction * bound, rel=1e-11)
    assert s.pressure.max() <= bound * (1.0 + 1e-12)


def test_the_load_the_bound_just_carries_and_one_more(solver):
    s = solver.solve(HEIGHTS, mean_pressure=2e9, bound=2e9)
    np.testing.assert_allclose(s.pressure, 2e9)
    assert s.converged
    with pytest.raises(InfeasibleError, match="bound"):
        solver.solve(HEIGHTS, mean_pressure=2.1e9, bound=2e9)


def test_a_bound_map_with_holes(solver):
    bound = np.full((N, N), 1e10)
    bound[:, :20] = 0.0
    bound[:, 40:] = 3e9
    for pressure in (1e9, 0.999 * bound.mean()):
        s = solver.solve(HEIGHTS, mean_pressure=pressure, bound=bound)
        assert s.converged
        assert not s.pressure[:, :20].any()
        assert np.all(s.pressure <= bound * (1.0 + 1e-12))
        assert s.pressure.mean() == pytest.approx(pressure, rel=1e-11)


def test_an_approach_beyond_the_mean_plane_needs_a_bound(solver):
    with pytest.raises(InfeasibleError, match="approach"):
        solver.solve(HEIGHTS, rigid_approach=1e-9)
    s = solver.solve(HEIGHTS, rigid_approach=1e-9, bound=5e9)
    assert s.converged
    assert 0.5 < np.mean(s.pressure == 5e9) < 1.0
    s = solver.solve(HEIGHTS, rigid_approach=-1.01 * HEIGHTS.min(), bound=5e9)
    assert s.converged
    np.testing.assert_allclose(s.pressure, 5e9)


def test_an_approach_just_below_the_mean_plane(solver):
    s = solver.solve(HEIGHTS, rigid_approach=-1e-14)
    assert s.converged
    assert s.rigid_approach == -1e-14
    assert np.mean(s.pressure > 0.0) > 0.9


@pytest.mark.parametrize("contrast", quick([1e-6, 1e-3, 1e3, 1e6], 0, 2))
@pytest.mark.parametrize("pixels", [0.1, 1.0, 20.0])
def test_layers_a_million_times_stiffer_or_softer(contrast, pixels):
    solver = ContactSolver(
        (N, N), PIXEL, stack(contrast, pixels * PIXEL[0]), periodic=True, fast=False
    )
    s = solver.solve(HEIGHTS, mean_pressure=1e9)
    assert s.converged
    assert not s.fallback
    assert s.n_applications <= 300
    assert s.pressure.mean() == pytest.approx(1e9, rel=1e-11)


def test_a_film_of_a_nanometre_on_a_window_of_twenty_micrometres():
    pixel = 20e-6 / 128
    solver = ContactSolver((128, 128), (pixel, pixel), stack(4.0, 1e-9), periodic=True, fast=False)
    s = solver.solve(20.0 * rough((128, 128)), mean_pressure=1e8)
    assert s.converged
    assert s.n_applications <= 45


@pytest.mark.parametrize("shape", [(2, 2), (3, 5), (97, 101), (33, 200), (2, 150)])
@pytest.mark.parametrize(
    "pixel", quick([((1e-8, 1e-8),), ((1e-7, 1e-8),), ((1e-8, 1e-7),)], 1), ids=str
)
def test_odd_prime_narrow_and_stretched_maps(shape, pixel):
    solver = ContactSolver(shape, pixel, half_space, periodic=True, fast=False)
    for pressure in (1e3, 1e7, 2e9):
        s = solver.solve(rough(shape), mean_pressure=pressure)
        assert s.converged
        assert not s.fallback


def test_what_cannot_be_a_map_is_refused(solver):
    with pytest.raises(DescriptionError, match="shape"):
        ContactSolver((1, 64), PIXEL, half_space, periodic=True)
    with pytest.raises(DescriptionError, match="pixel_size"):
        ContactSolver((4, 64), (0.0, 1.0), half_space, periodic=True)
    with pytest.raises(DescriptionError, match="threads"):
        ContactSolver((4, 64), PIXEL, half_space, periodic=True, threads=0)
    for bad in (np.nan, np.inf):
        heights = HEIGHTS.copy()
        heights[2, 3] = bad
        with pytest.raises(DescriptionError, match="heights"):
            solver.solve(heights, mean_pressure=1.0)
    with pytest.raises(DescriptionError, match="heights"):
        solver.solve(HEIGHTS[:-1], mean_pressure=1.0)


@pytest.mark.parametrize(
    ("ask", "field"),
    [
        ({}, "mean_pressure, rigid_approach"),
        ({"mean_pressure": 1.0, "rigid_approach": 0.0}, "mean_pressure, rigid_approach"),
        ({"mean_pressure": -1.0}, "mean_pressure"),
        ({"mean_pressure": np.nan}, "mean_pressure"),
        ({"rigid_approach": np.inf}, "rigid_approach"),
        ({"mean_pressure": 1.0, "bound": -1.0}, "bound"),
        ({"mean_pressure": 1.0, "bound": np.ones(3)}, "bound"),
        ({"mean_pressure": 1.0, "rtol": 0.0}, "rtol"),
        ({"mean_pressure": 1.0, "start": np.ones(3)}, "start"),
        ({"mean_pressure": 1.0, "method": "prayer"}, "method"),
    ],
)
def test_what_cannot_be_asked_is_refused(solver, ask, field):
    with pytest.raises(DescriptionError) as error:
        solver.solve(HEIGHTS, **ask)
    assert error.value.field == field


def test_the_fallback_finishes_and_is_reported(solver, monkeypatch):
    """Stop the fast method after two steps: the safeguarded one must reach the same answer."""
    best = solver.solve(HEIGHTS, mean_pressure=1e9)

    def lame(grid, problem, rtol, _is_extrapolated=False):
        out = improve(grid, problem, max(rtol, 1e-1))
        return out._replace(relative=1.0)

    improve = contact_solver.improve
    monkeypatch.setattr(contact_solver, "improve", lame)
    s = solver.solve(HEIGHTS, mean_pressure=1e9)
    assert s.fallback
    assert s.converged
    np.testing.assert_allclose(s.pressure, best.pressure, rtol=1e-5, atol=1e-7 * 1e9)
    cut = solver.solve(HEIGHTS, mean_pressure=1e9, max_iterations=2)
    assert not cut.converged
    assert cut.kkt > 1e-8


@pytest.mark.slow
def test_a_tolerance_near_rounding_is_still_met_or_said_not_to_be(solver):
    s = solver.solve(HEIGHTS, mean_pressure=1e9, rtol=1e-11)
    assert s.converged
    impossible = solver.solve(HEIGHTS, mean_pressure=1e9, rtol=1e-30, max_iterations=20)
    assert not impossible.converged


@pytest.mark.slow
def test_a_start_almost_all_at_its_bound_is_worth_nothing():
    """What is left to take up the load overshoots, and the steps would lead nowhere for long."""
    heights = rough((128, 128))
    solver = ContactSolver((128, 128), PIXEL, half_space, periodic=True, fast=False)
    bound, before = 0.1 * solver.solve(heights, mean_pressure=1e8).pressure.max(), []
    for load in np.geomspace(0.02, 0.6, 6) * bound:
        cold = solver.solve(heights, mean_pressure=load, bound=bound)
        warm = solver.solve(heights, mean_pressure=load, bound=bound, start=before or None)
        assert warm.converged
        assert not warm.fallback
        assert warm.n_outer <= 1.5 * cold.n_outer + 1.0
        assert warm.pressure == pytest.approx(cold.pressure, abs=1e-6 * bound)
        before = [(load, warm.pressure), *before[:2]]


@pytest.mark.parametrize("offset", [0.0, 1.0, 1e3])
def test_roughness_on_a_large_offset_is_a_surface(solver, offset):
    """2 nm on 1 km: as far as doubles hold, a step of 1.1e-13 m, and no flat."""
    there = solver.solve(2.0 * HEIGHTS + offset, mean_pressure=1e7)
    here = solver.solve(2.0 * HEIGHTS, mean_pressure=1e7)
    assert there.converged
    rounded = np.spacing(offset) / (2.0 * HEIGHTS.std())
    off = np.abs(there.pressure - here.pressure).max() / here.pressure.max()
    assert off <= 1e-6 + 10.0 * rounded


@pytest.mark.parametrize("rms", [0.0, 1e-15, 1e-19, 1e-22, 1e-30, 1e-200])
def test_less_roughness_than_a_number_resolves_is_solved(solver, rms):
    """What is left of a flat by round-off: nearly uniform pressure, and no failure."""
    s = solver.solve(rms * HEIGHTS / HEIGHTS.std(), mean_pressure=1e8)
    assert s.converged
    assert s.n_applications <= 60
    assert s.pressure.sum() == pytest.approx(1e8 * N * N, rel=1e-12)
    assert np.abs(s.pressure / 1e8 - 1.0).max() < 1e-2 * max(rms / 1e-15, 1e-3)


@pytest.mark.parametrize("load", [1e-10, 1.0, 1e3])
def test_a_load_far_below_what_the_heights_resist_is_carried(solver, load):
    """Heights in metres instead of nanometres: the load was lost to round-off of the steps."""
    s = solver.solve(1e12 * HEIGHTS, mean_pressure=load, bound=600.0 * load)
    assert s.pressure.sum() == pytest.approx(load * N * N, rel=1e-9)
    assert s.pressure.max() == 600.0 * load
    highest = np.argsort(-HEIGHTS.ravel())[:7]  # six at the bound, and a part of it
    assert set(np.flatnonzero(s.pressure)) == set(highest)
    assert s.pressure.flat[highest[-1]] == s.pressure[s.pressure > 0.0].min()
