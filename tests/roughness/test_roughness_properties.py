"""Laws of random surfaces and of the numbers taken from maps, on any grid."""

import math

import numpy as np
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays
from scipy import fft

from contactkit.roughness import random_surfaces, spectra
from contactkit.roughness import statistics as stats
from contactkit.roughness.height_maps import detrended

SIDE = st.integers(3, 40)
SEED = st.integers(0, 2**70)
NORMALISE = st.sampled_from(["expected", "sample", "none"])
MAPS = arrays(
    np.float64,
    st.tuples(st.integers(3, 9), st.integers(3, 9)),
    elements=st.floats(-1.0, 1.0).map(lambda value: round(value, 6)),
)
PIXEL = st.tuples(st.floats(0.1, 10.0), st.floats(0.1, 10.0))
TREND = st.sampled_from(["none", "mean", "tilt", "curvature"])

# kinds of random surface in a window of 12 by 20, shortest wave 2, on any shape
KINDS = {
    "exponential": lambda shape, pixel, seed, normalise: random_surfaces.gaussian_exponential(
        shape, pixel, 1.0, (2.0, 5.0), 2.0, seed, normalise
    ),
    "self-affine": lambda shape, pixel, seed, normalise: random_surfaces.self_affine(
        shape,
        pixel,
        None,
        random_surfaces.SelfAffineSpectrum(0.7, 9.0, 2.0),
        seed,
        "sample" if normalise == "sample" else "expected",
        rms_slope=0.2,
    ),
}


def realise(kind, shape, seed, normalise="expected"):
    return KINDS[kind](shape, (12.0 / shape[0], 20.0 / shape[1]), seed, normalise)


@given(st.sampled_from(sorted(KINDS)), SIDE, SIDE, SEED, NORMALISE)
def test_all_grids_that_hold_the_shortest_wave_show_one_surface(kind, ny, nx, seed, normalise):
    """The surface of a fine grid, read from its transform at the pixels of a coarser one."""
    ny, nx = 13 + ny % 12, 21 + nx % 12
    found = realise(kind, (ny, nx), seed, normalise)
    fine = realise(kind, (50, 60), seed, normalise)
    waves = fft.fft2(fine, norm="forward")
    turn = 2j * math.pi
    rows = np.exp(turn * np.outer(np.arange(ny) / ny, fft.fftfreq(50, 1 / 50)))
    columns = np.exp(turn * np.outer(fft.fftfreq(60, 1 / 60), np.arange(nx) / nx))
    np.testing.assert_allclose((rows @ waves @ columns).real, found, atol=1e-12 * fine.std())
    assert abs(found.mean()) < 1e-14 * found.std()


@given(st.sampled_from(sorted(KINDS)), SIDE, SIDE, SEED, NORMALISE)
def test_long_waves_do_not_depend_on_the_cutoff_or_the_grid(kind, ny, nx, seed, normalise):
    """Their sizes may, by one common factor; too coarse a grid leaves out what it cannot hold."""
    coarse = fft.rfft2(realise(kind, (ny, nx), seed, normalise), norm="forward")
    fine = fft.rfft2(realise(kind, (64, 64), seed, normalise), norm="forward")
    rows = [k % ny for k in range(-((ny - 1) // 2), (ny - 1) // 2 + 1)]
    far = [k % 64 for k in range(-((ny - 1) // 2), (ny - 1) // 2 + 1)]
    one = coarse[rows, : (nx + 1) // 2].ravel()
    two = fine[far, : (nx + 1) // 2].ravel()
    kept = np.abs(two) > 1e-12 * np.abs(two).max()
    ratio = one[kept] / two[kept]
    np.testing.assert_allclose(ratio, ratio[0].real, rtol=1e-6)
    assert ratio[0].real > 0.0


@given(SIDE, SIDE, SEED, st.floats(-12.0, 6.0), st.floats(-12.0, 6.0), NORMALISE)
def test_lengths_and_heights_scale(ny, nx, seed, power, height_power, normalise):
    length, height = 10.0**power, 10.0**height_power
    one = random_surfaces.gaussian_exponential((ny, nx), (1.0, 0.7), 1.0, 3.0, 2.1, seed, normalise)
    two = random_surfaces.gaussian_exponential(
        (ny, nx), (length, 0.7 * length), height, 3.0 * length, 2.1 * length, seed, normalise
    )
    np.testing.assert_allclose(two / height, one, atol=1e-12)


@given(SIDE, SIDE, PIXEL, st.floats(0.05, 1.0))
def test_the_budget_of_variance_adds_up(ny, nx, pixel, fraction):
    cutoff = fraction * max(ny * pixel[0], nx * pixel[1])
    found = random_surfaces.resolved_variance((ny, nx), pixel, (1.0, 3.0), cutoff)
    assert sum(found) == pytest.approx(1.0, abs=1e-14)
    assert found.resolved > 0.0
    assert 0.0 < found.cutoff < 1.0


def test_another_seed_is_another_surface():
    one, two = (realise("exponential", (64, 64), seed, "sample") for seed in (1, 2))
    assert abs(np.mean(one * two)) < 0.2
    with pytest.raises(ValueError, match="negative"):
        realise("exponential", (64, 64), -1)


# Statistics ---------------------------------------------------------------------------------


@given(MAPS, PIXEL, st.booleans(), st.floats(0.1, 9.0), st.floats(0.1, 9.0), st.floats(-5.0, 5.0))
def test_numbers_scale_with_heights_and_lengths(z, pixel, periodic, height, length, level):
    assume(np.ptp(z) > 1e-3)
    one = stats.surface_statistics(z, pixel, periodic)
    large = (pixel[0] * length, pixel[1] * length)
    two = stats.surface_statistics(z * height + level, large, periodic)

    def close(found, expected):
        assert found == pytest.approx(expected, rel=1e-8, abs=1e-9)

    close(two.rms, one.rms * height)
    close(two.highest - two.lowest, (one.highest - one.lowest) * height)
    close((two.skewness, two.kurtosis), (one.skewness, one.kurtosis))
    close(two.rms_slope, one.rms_slope * height / length)
    close(two.rms_curvature * length**2, one.rms_curvature * height)


@given(MAPS, PIXEL)
def test_the_spectrum_holds_the_variance(z, pixel):
    assert spectra.spectral_moment(z, pixel, 0) == pytest.approx(z.var(), rel=1e-12, abs=1e-15)


@given(MAPS, PIXEL)
def test_differences_see_less_slope_than_the_spectrum(z, pixel):
    exact = math.sqrt(spectra.spectral_moment(z, pixel, 2))
    assert stats.rms_slope(z, pixel, periodic=True) <= exact * (1.0 + 1e-12) + 1e-12
    bent = 0.5 * math.sqrt(spectra.spectral_moment(z, pixel, 4))
    assert stats.rms_curvature(z, pixel, periodic=True) <= bent * (1.0 + 1e-12) + 1e-12


@given(MAPS, st.integers(-9, 9), st.integers(-9, 9), PIXEL)
def test_one_period_may_start_anywhere(z, down, right, pixel):
    assume(np.ptp(z) > 1e-3)
    one = stats.surface_statistics(z, pixel, periodic=True)
    two = stats.surface_statistics(np.roll(z, (down, right), (0, 1)), pixel, periodic=True)
    for name in one._fields:
        if name != "derivatives":
            assert getattr(two, name) == pytest.approx(getattr(one, name), rel=1e-9, abs=1e-12)


@given(MAPS, PIXEL, st.booleans())
def test_a_map_may_be_turned_by_a_right_angle(z, pixel, periodic):
    assume(np.ptp(z) > 1e-3)
    one = stats.surface_statistics(z, pixel, periodic)
    two = stats.surface_statistics(z.T, pixel[::-1], periodic)
    assert two.rms_slope == pytest.approx(one.rms_slope)
    assert two.rms_curvature == pytest.approx(one.rms_curvature, abs=1e-12)
    assert two.correlation_length[::-1] == pytest.approx(one.correlation_length, rel=1e-6)


@given(MAPS, st.booleans())
def test_the_autocorrelation_starts_at_the_variance_and_is_even(z, periodic):
    found = stats.autocorrelation(z, periodic)
    assert found[0, 0] == pytest.approx(z.var(), abs=1e-14)
    np.testing.assert_allclose(found[1:, 1:], found[:0:-1, :0:-1], atol=1e-13)
    if periodic:
        assert abs(found.sum()) < 1e-12


@given(MAPS, st.lists(st.floats(-1.5, 1.5), min_size=2, max_size=9))
def test_the_bearing_fraction_falls_from_one_to_nothing(z, levels):
    found = stats.bearing_fraction(z, np.sort(levels))
    assert (np.diff(found) <= 0.0).all()
    assert stats.bearing_fraction(z, [z.min(), np.nextafter(z.max(), 2.0)]).tolist() == [1.0, 0.0]
    np.testing.assert_allclose(found, [np.mean(z >= level) for level in np.sort(levels)])


# Trends -------------------------------------------------------------------------------------


@given(MAPS, TREND)
def test_a_trend_is_taken_off_once(z, trend):
    once = detrended(z, trend)
    np.testing.assert_allclose(detrended(once, trend), once, atol=1e-13)
    assert once.std() <= z.std() * (1.0 + 1e-12) + 1e-15
    assert once is not z


@given(MAPS, st.lists(st.floats(-9.0, 9.0), min_size=6, max_size=6))
def test_a_map_on_a_slope_or_a_bowl_is_the_same_map(z, c):
    y, x = np.mgrid[: z.shape[0], : z.shape[1]].astype(float)
    slope = c[0] + c[1] * x + c[2] * y
    bowl = slope + c[3] * x * x + c[4] * x * y + c[5] * y * y
    np.testing.assert_allclose(detrended(z + slope, "tilt"), detrended(z, "tilt"), atol=1e-11)
    np.testing.assert_allclose(
        detrended(z + bowl, "curvature"), detrended(z, "curvature"), atol=1e-10
    )
