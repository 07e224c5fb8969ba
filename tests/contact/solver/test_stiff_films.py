"""Stiff bonded films: contact in scattered spots, a lever between any two of them."""

from __future__ import annotations

import importlib.util

import numpy as np
import pytest
from selection import quick

from contactkit.contact.solver import contact_solver
from contactkit.contact.solver.active_set import SetOutcome, improve
from contactkit.contact.solver.contact_solver import ContactSolver
from contactkit.contact.solver.optimality import height_scale, optimality
from contactkit.elasticity import influence, layered, one_axis
from contactkit.numerics.fft import fast_transforms_installed

pytestmark = pytest.mark.hard

INSTALLED = fast_transforms_installed() and importlib.util.find_spec("numba") is not None
NEEDS_FAST = pytest.mark.skipif(not INSTALLED, reason="needs the extra contactkit[fast]")
BASE_LOAD = 2e-3  # some five per cent of contact of the half-space, of modulus 1 and slope 0.1


def film(contrast, thickness, periodic=True):
    """Symbol of a bonded film; modulus over the substrate, thickness over the window."""
    layers = [thickness] if thickness else []
    moduli = 0.91 * np.array([contrast, 1.0] if layers else [1.0])
    if isinstance(periodic, str):
        solid = one_axis.Layers(moduli, [0.3] * moduli.size, layers)
        return lambda shape, pixel: one_axis.symbol(shape, pixel, solid, periodic)
    make = layered.normal_symbol if periodic else influence.symbol
    return lambda shape, pixel: make(shape, pixel, moduli, [0.3] * moduli.size, layers)


def rough(n, is_resolved, seed=1):
    """Heights of unit window and rms slope 0.1, resolved to 8 pixels or rough to the pixel."""
    k = np.hypot(np.fft.fftfreq(n, 1.0 / n)[:, None], np.fft.rfftfreq(n, 1.0 / n))
    if is_resolved:
        amplitude = np.where(k <= n / 8, np.maximum(k, 4.0) ** -1.8, 0.0)
    else:
        amplitude = (1.0 + (k / 14.6) ** 2) ** -0.75
    amplitude[0, 0] = 0.0
    h = np.fft.irfft2(
        np.fft.rfft2(np.random.default_rng(seed).standard_normal((n, n))) * amplitude, s=(n, n)
    )
    dy, dx = (np.roll(h, 1, axis) - h for axis in (0, 1))
    return 0.1 * h / (n * np.sqrt(np.mean(dy**2 + dx**2)))


def solve(n, contrast, thickness, load, is_resolved=True, periodic=True, fast=False, **asked):
    maker = film(contrast, thickness, periodic)
    solver = ContactSolver((n, n), (1.0 / n, 1.0 / n), maker, periodic, fast=fast)
    return solver.solve(rough(n, is_resolved), mean_pressure=load * BASE_LOAD, **asked)


@pytest.mark.parametrize(
    ("contrast", "thickness", "load", "is_resolved"),
    [
        (1e2, 0.01, 30.0, True),
        (1e3, 0.01, 100.0, True),
        (1e3, 0.01, 100.0, False),
        (1e4, 0.003, 30.0, False),
        (1e6, 0.003, 30.0, True),
    ],
)
def test_films_that_made_the_truncated_set_cycle(contrast, thickness, load, is_resolved):
    s = solve(64, contrast, thickness, load, is_resolved)
    assert s.converged
    assert not s.fallback
    assert s.n_applications <= 60
    assert s.pressure.mean() == pytest.approx(load * BASE_LOAD, rel=1e-11)
    assert s.pressure.min() == 0.0
    # The conditions hold for the answer itself, whoever found it.
    found = optimality(s.pressure, s.displacement, rough(64, is_resolved))
    scale = height_scale(rough(64, is_resolved), s.displacement)
    assert found.residual <= 2e-8 * scale


@pytest.mark.parametrize("periodic", quick([True, False], 0))
def test_a_hardness_on_a_stiff_film(periodic):
    free = solve(64, 1e3, 0.01, 30.0, periodic=periodic)
    bound = 0.3 * free.pressure.max()
    s = solve(64, 1e3, 0.01, 30.0, periodic=periodic, bound=bound)
    assert free.converged
    assert s.converged
    assert not s.fallback
    assert s.n_applications <= 100
    assert np.isclose(s.pressure, bound, rtol=1e-12, atol=0.0).any()
    assert s.pressure.mean() == pytest.approx(30.0 * BASE_LOAD, rel=1e-11)


@pytest.mark.slow
def test_a_film_that_is_all_but_rigid_and_rough_to_the_pixel():
    """Round-off of single precision, and pressures scaled to the load, would end the descent."""
    free = solve(64, 1e6, 0.003, 1e5, is_resolved=False)
    bound = max(0.15 * free.pressure.max(), 1.1e5 * BASE_LOAD)
    bounded = solve(64, 1e6, 0.003, 1e5, is_resolved=False, bound=bound)
    assert bounded.pressure.max() == pytest.approx(bound, rel=1e-12)
    for s in (free, bounded):
        assert s.converged
        assert not s.fallback
        assert s.n_applications <= 200
        assert s.pressure.mean() == pytest.approx(1e5 * BASE_LOAD, rel=1e-11)


def test_load_and_approach_are_two_ways_to_one_contact():
    by_load = solve(64, 1e3, 0.01, 30.0)
    maker, shape, pixel = film(1e3, 0.01), (64, 64), (1.0 / 64, 1.0 / 64)
    solver = ContactSolver(shape, pixel, maker, True, fast=False)
    s = solver.solve(rough(64, True), rigid_approach=by_load.rigid_approach)
    assert s.converged
    assert not s.fallback
    np.testing.assert_allclose(s.pressure, by_load.pressure, atol=1e-5 * by_load.pressure.max())


@pytest.mark.parametrize(
    ("contrast", "thickness", "load"),
    [(1e3, 0.03, 1.0), (1e4, 0.01, 0.1), (3.0, 0.03, 0.1), (1e2, 0.003, 0.1)],
)
def test_a_hardness_that_holds_nearly_all_of_a_small_contact(contrast, thickness, load):
    """With all pixels at a bound but one, none but that one makes up for the load."""
    solver = ContactSolver((64, 64), (1 / 64, 1 / 64), film(contrast, thickness), True, fast=False)
    h, mean = rough(64, True), load * BASE_LOAD
    bound = max(0.3 * solver.solve(h, mean_pressure=mean).pressure.max(), 1.1 * mean)
    s = solver.solve(h, mean_pressure=mean, bound=bound)
    assert s.converged
    assert not s.fallback
    assert s.n_applications <= 200
    assert s.pressure.mean() == pytest.approx(mean, rel=1e-11)
    assert s.pressure.max() <= bound * (1.0 + 1e-12)


@pytest.mark.parametrize(
    ("is_resolved", "bounded"),
    quick([(False, False), (False, True), (True, False), (True, True)], long=[0]),
)
def test_every_film_costs_at_most_twice_the_half_space(is_resolved, bounded):
    """Contrast, thickness and load over six decades; the median to a contrast of 1000."""
    h, loads = rough(128, is_resolved), np.array([1.0, 30.0, 1000.0])

    def counts(contrast, thickness):
        maker = film(contrast, thickness)
        solver = ContactSolver((128, 128), (1 / 128, 1 / 128), maker, True)
        for mean in loads * BASE_LOAD:
            s = solver.solve(h, mean_pressure=mean)
            if bounded:
                bound = max(0.5 * s.pressure.max(), 1.1 * mean)
                s = solver.solve(h, mean_pressure=mean, bound=bound)
            assert s.converged, (contrast, thickness, mean)
            assert not s.fallback, (contrast, thickness, mean)
            yield s.n_applications

    base = np.median(list(counts(1.0, 0.0)))
    thick = (1e-3, 1e-2, 1e-1)
    moderate = [n for e in (1e-3, 10.0, 1e2, 1e3) for t in thick for n in counts(e, t)]
    extreme = [n for e in (1e-6, 1e4, 1e6) for t in (*thick, 10.0) for n in counts(e, t)]
    assert np.median(moderate) <= 2.0 * base
    assert max(moderate) <= 200
    assert max(extreme) <= 600


@pytest.mark.parametrize("load", [1.0, 1e5])
def test_an_isolated_map_under_any_load(load):
    """At 1e5 times the load single precision cannot measure what is left of the heights."""
    maker = film(1.0, 0.0, periodic=False)
    solver = ContactSolver((64, 64), (1 / 64, 1 / 64), maker, periodic=False, fast=False)
    s = solver.solve(rough(64, True), mean_pressure=load * BASE_LOAD)
    assert s.converged
    assert not s.fallback
    assert s.n_applications <= 60


@pytest.mark.parametrize("along", quick(["x", "y"], 0))
@pytest.mark.parametrize("fast", [False, pytest.param(True, marks=NEEDS_FAST)])
@pytest.mark.parametrize(("contrast", "load"), quick([(1e3, 300.0), (1e4, 1e3)], 0))
def test_a_strip_has_no_seam(along, fast, contrast, load):
    """Contact goes on across the edge that repeats: the inverse must know it."""
    s = solve(64, contrast, 0.01, load, periodic=along, fast=fast)
    assert s.converged
    assert not s.fallback
    assert s.n_applications <= 60


@NEEDS_FAST
@pytest.mark.parametrize("periodic", [True, False])
def test_both_paths_take_the_same_steps_under_films(periodic):
    a, b = (solve(96, 1e3, 0.01, 30.0, periodic=periodic, fast=fast) for fast in (False, True))
    assert abs(a.n_outer - b.n_outer) <= 2
    assert abs(a.n_applications - b.n_applications) <= 8
    np.testing.assert_allclose(b.pressure, a.pressure, atol=1e-6 * a.pressure.max())


@pytest.mark.parametrize(("contrast", "load"), quick([(1.0, 1.0), (1e2, 3.0), (1e3, 30.0)], 1))
def test_the_fallback_converges_and_needs_less_than_plain_gradients(contrast, load, monkeypatch):
    """No film is known that needs it: here the active set gives up on the finest grid."""
    answer = solve(64, contrast, 0.003, load)

    def give_up(grid, problem, rtol, _is_extrapolated=False):
        is_finest = grid.pressure.shape == (64, 64)
        return SetOutcome(0.0, np.inf, 0.0, 0, ()) if is_finest else improve(grid, problem, rtol)

    monkeypatch.setattr(contact_solver, "improve", give_up)
    s = solve(64, contrast, 0.003, load)
    plain = solve(64, contrast, 0.003, load, method="conjugate-gradient")
    assert s.fallback
    assert s.converged
    assert s.pressure == pytest.approx(answer.pressure, abs=1e-5 * answer.pressure.max())
    assert s.n_applications <= 0.8 * plain.n_applications
