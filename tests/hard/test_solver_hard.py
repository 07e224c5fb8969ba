"""Contacts at the ends of what can be asked: one pixel, all pixels, caps, contrasts, odd maps."""

from __future__ import annotations

import numpy as np
import pytest

from contactkit.contact.solver import press as active_set
from contactkit.contact.solver.press import Press
from contactkit.elasticity import layered
from contactkit.errors import DescriptionError, InfeasibleError

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
def press():
    return Press((N, N), PIXEL, half_space, periodic=True, fast=False)


def test_a_load_so_small_that_one_pixel_carries_it(press):
    s = press.solve(HEIGHTS, mean_pressure=1e-3)
    assert s.converged
    assert np.count_nonzero(s.pressure) == 1
    assert np.argmax(s.pressure) == np.argmax(HEIGHTS)
    assert s.pressure.max() == pytest.approx(1e-3 * N * N)


def test_a_spike_and_then_all_the_rest(press):
    spike = np.zeros((N, N))
    spike[3, 5] = 1e-9
    few = press.solve(spike, mean_pressure=1e2)
    assert np.count_nonzero(few.pressure) == 1
    rest = press.solve(spike, mean_pressure=1e9)
    assert rest.converged
    assert not rest.fallback
    assert np.count_nonzero(rest.pressure) > 0.99 * N * N


def test_no_load_and_no_contact(press):
    for s in (press.solve(HEIGHTS, mean_pressure=0.0), press.solve(HEIGHTS, level=-1e-7)):
        assert s.converged
        assert s.kkt == 0.0
        assert not s.pressure.any()
        assert s.energy == 0.0
    assert press.solve(HEIGHTS, mean_pressure=0.0).level == pytest.approx(-HEIGHTS.max())


def test_full_contact_is_that_of_the_spectrum(press):
    s = press.solve(HEIGHTS, mean_pressure=3e11)
    assert s.converged
    assert s.pressure.min() > 0.0
    symbol = half_space((N, N), PIXEL)
    symbol[0, 0] = np.inf
    full = 3e11 + np.fft.irfft2(np.fft.rfft2(HEIGHTS) / symbol, s=(N, N))
    np.testing.assert_allclose(s.pressure, full, rtol=1e-5)


@pytest.mark.parametrize("share", [0.9, 0.99, 0.9999, 1.0 - 1e-9])
def test_a_load_just_below_what_the_cap_carries(press, share):
    cap = 2e9
    s = press.solve(HEIGHTS, mean_pressure=share * cap, cap=cap)
    assert s.converged
    assert s.pressure.mean() == pytest.approx(share * cap, rel=1e-11)
    assert s.pressure.max() <= cap * (1.0 + 1e-12)


def test_the_load_the_cap_just_carries_and_one_more(press):
    s = press.solve(HEIGHTS, mean_pressure=2e9, cap=2e9)
    np.testing.assert_allclose(s.pressure, 2e9)
    assert s.converged
    with pytest.raises(InfeasibleError, match="cap"):
        press.solve(HEIGHTS, mean_pressure=2.1e9, cap=2e9)


def test_a_cap_map_with_holes(press):
    cap = np.full((N, N), 1e10)
    cap[:, :20] = 0.0
    cap[:, 40:] = 3e9
    for pressure in (1e9, 0.999 * cap.mean()):
        s = press.solve(HEIGHTS, mean_pressure=pressure, cap=cap)
        assert s.converged
        assert not s.pressure[:, :20].any()
        assert np.all(s.pressure <= cap * (1.0 + 1e-12))
        assert s.pressure.mean() == pytest.approx(pressure, rel=1e-11)


def test_a_level_beyond_the_mean_plane_needs_a_cap(press):
    with pytest.raises(InfeasibleError, match="level"):
        press.solve(HEIGHTS, level=1e-9)
    s = press.solve(HEIGHTS, level=1e-9, cap=5e9)
    assert s.converged
    assert 0.5 < np.mean(s.pressure == 5e9) < 1.0
    s = press.solve(HEIGHTS, level=-1.01 * HEIGHTS.min(), cap=5e9)
    assert s.converged
    np.testing.assert_allclose(s.pressure, 5e9)


def test_a_level_just_below_the_mean_plane(press):
    s = press.solve(HEIGHTS, level=-1e-14)
    assert s.converged
    assert s.level == -1e-14
    assert np.mean(s.pressure > 0.0) > 0.9


@pytest.mark.parametrize("contrast", [1e-6, 1e-3, 1e3, 1e6])
@pytest.mark.parametrize("pixels", [0.1, 1.0, 20.0])
def test_layers_a_million_times_stiffer_or_softer(contrast, pixels):
    press = Press((N, N), PIXEL, stack(contrast, pixels * PIXEL[0]), periodic=True, fast=False)
    s = press.solve(HEIGHTS, mean_pressure=1e9)
    assert s.converged
    assert not s.fallback
    assert s.n_applications <= 300
    assert s.pressure.mean() == pytest.approx(1e9, rel=1e-11)


def test_a_film_of_a_nanometre_on_a_window_of_twenty_micrometres():
    pixel = 20e-6 / 128
    press = Press((128, 128), (pixel, pixel), stack(4.0, 1e-9), periodic=True, fast=False)
    s = press.solve(20.0 * rough((128, 128)), mean_pressure=1e8)
    assert s.converged
    assert s.n_applications <= 45


@pytest.mark.parametrize("shape", [(2, 2), (3, 5), (97, 101), (33, 200), (2, 150)])
@pytest.mark.parametrize("pixel", [(1e-8, 1e-8), (1e-7, 1e-8), (1e-8, 1e-7)])
def test_odd_prime_narrow_and_stretched_maps(shape, pixel):
    press = Press(shape, pixel, half_space, periodic=True, fast=False)
    for pressure in (1e3, 1e7, 2e9):
        s = press.solve(rough(shape), mean_pressure=pressure)
        assert s.converged
        assert not s.fallback


def test_what_cannot_be_a_map_is_refused(press):
    with pytest.raises(DescriptionError, match="shape"):
        Press((1, 64), PIXEL, half_space, periodic=True)
    with pytest.raises(DescriptionError, match="pixel_size"):
        Press((4, 64), (0.0, 1.0), half_space, periodic=True)
    with pytest.raises(DescriptionError, match="threads"):
        Press((4, 64), PIXEL, half_space, periodic=True, threads=0)
    for bad in (np.nan, np.inf):
        heights = HEIGHTS.copy()
        heights[2, 3] = bad
        with pytest.raises(DescriptionError, match="heights"):
            press.solve(heights, mean_pressure=1.0)
    with pytest.raises(DescriptionError, match="heights"):
        press.solve(HEIGHTS[:-1], mean_pressure=1.0)


@pytest.mark.parametrize(
    ("ask", "field"),
    [
        ({}, "mean_pressure, level"),
        ({"mean_pressure": 1.0, "level": 0.0}, "mean_pressure, level"),
        ({"mean_pressure": -1.0}, "mean_pressure"),
        ({"mean_pressure": np.nan}, "mean_pressure"),
        ({"level": np.inf}, "level"),
        ({"mean_pressure": 1.0, "cap": -1.0}, "cap"),
        ({"mean_pressure": 1.0, "cap": np.ones(3)}, "cap"),
        ({"mean_pressure": 1.0, "rtol": 0.0}, "rtol"),
        ({"mean_pressure": 1.0, "start": np.ones(3)}, "start"),
        ({"mean_pressure": 1.0, "method": "prayer"}, "method"),
    ],
)
def test_what_cannot_be_asked_is_refused(press, ask, field):
    with pytest.raises(DescriptionError) as error:
        press.solve(HEIGHTS, **ask)
    assert error.value.field == field


def test_the_fallback_finishes_and_says_so(press, monkeypatch):
    """Stop the fast method after two steps: the safeguarded one must reach the same answer."""
    best = press.solve(HEIGHTS, mean_pressure=1e9)

    def lame(grid, problem, rtol, report=None):
        out = improve(grid, problem, max(rtol, 1e-1), report)
        return out._replace(relative=1.0)

    improve = active_set.improve
    monkeypatch.setattr(active_set, "improve", lame)
    s = press.solve(HEIGHTS, mean_pressure=1e9)
    assert s.fallback
    assert s.converged
    np.testing.assert_allclose(s.pressure, best.pressure, rtol=1e-5, atol=1e-7 * 1e9)
    cut = press.solve(HEIGHTS, mean_pressure=1e9, max_iterations=2)
    assert not cut.converged
    assert cut.kkt > 1e-8


def test_a_tolerance_near_rounding_is_still_met_or_said_not_to_be(press):
    s = press.solve(HEIGHTS, mean_pressure=1e9, rtol=1e-11)
    assert s.converged
    impossible = press.solve(HEIGHTS, mean_pressure=1e9, rtol=1e-30, max_iterations=20)
    assert not impossible.converged


def test_a_start_almost_all_at_its_cap_is_worth_nothing():
    """What is left to take up the load overshoots, and the steps would lead nowhere for long."""
    heights = rough((128, 128))
    press = Press((128, 128), PIXEL, half_space, periodic=True, fast=False)
    cap, before = 0.1 * press.solve(heights, mean_pressure=1e8).pressure.max(), []
    for load in np.geomspace(0.02, 0.6, 6) * cap:
        cold = press.solve(heights, mean_pressure=load, cap=cap)
        warm = press.solve(heights, mean_pressure=load, cap=cap, start=before or None)
        assert warm.converged
        assert not warm.fallback
        assert warm.n_outer <= 1.5 * cold.n_outer + 1.0
        assert warm.pressure == pytest.approx(cold.pressure, abs=1e-6 * cap)
        before = [(load, warm.pressure), *before[:2]]
