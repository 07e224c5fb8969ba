"""Surfaces at the edges: thin windows, just one wave, large offsets, atoms and planets."""

from __future__ import annotations

import math

import numpy as np
import pytest

from contactkit.errors import DescriptionError
from contactkit.roughness import elementary, random_surfaces
from contactkit.roughness import statistics as stats
from contactkit.roughness.height_maps import detrended

pytestmark = pytest.mark.hard


def test_a_cutoff_at_the_window_leaves_the_longest_waves():
    """One along each direction, equally strong, and whatever the rounding of the pixel."""
    for pixel in (1e-9 / 3.0, 0.1, 7.0):
        heights = random_surfaces.gaussian_exponential(
            (30, 30), (pixel, pixel), 1.0, 5.0 * pixel, 30.0 * pixel, seed=1
        )
        waves = np.abs(np.fft.fft2(heights, norm="forward"))
        assert {tuple(at) for at in np.argwhere(waves > 1e-12).tolist()} == {
            (0, 1),
            (0, 29),
            (1, 0),
            (29, 0),
        }


def test_a_cutoff_beyond_the_window_leaves_nothing():
    with pytest.raises(DescriptionError, match=r"cutoff_wavelength must leave waves.*1e-08 m by"):
        random_surfaces.gaussian_exponential((10, 10), (1e-9, 1e-9), 1e-9, 5e-9, 1.1e-8, 1)
    with pytest.raises(DescriptionError, match="cutoff_wavelength must leave waves"):
        random_surfaces.resolved_variance((2, 2), (1e-9, 1e-9), 5e-9, 1e-9)  # Nyquist waves only
    with pytest.raises(DescriptionError, match="cutoff_wavelength must leave waves"):
        random_surfaces.self_affine(
            (10, 10), (1e-9, 1e-9), 1e-9, random_surfaces.SelfAffineSpectrum(0.8, 5e-9, 1.1e-8), 1
        )


def test_a_cutoff_on_a_wave_keeps_it_on_every_grid():
    """At n thirds of a pixel the window is rounded differently; the wave must not come and go."""
    for n in (48, 49, 54, 96, 97):
        size = (0.3 / n, 0.3 / n)
        heights = random_surfaces.gaussian_exponential((n, n), size, 1.0, 0.05, 0.3 / 20, seed=3)
        waves = np.abs(np.fft.rfft2(heights, norm="forward"))
        assert waves[0, 20] > 1e-9
        assert waves[12, 16] > 1e-9  # 12, 16, 20
        assert waves[0, 21] < 1e-14


def test_a_profile_is_a_surface_of_one_row():
    heights = random_surfaces.gaussian_exponential(
        (1, 4096), (1e-9, 1e-9), 1e-9, 40e-9, 4e-9, seed=1
    )
    assert heights.shape == (1, 4096)
    assert heights.std() == pytest.approx(1e-9, rel=0.3)


@pytest.mark.parametrize("shape", [(3, 500), (501, 4), (64, 65), (2, 3)])
def test_any_shape_is_real_and_of_zero_mean(shape):
    heights = random_surfaces.self_affine(
        shape, (2.0, 1.0), 1.0, random_surfaces.SelfAffineSpectrum(0.5, math.inf, 2.5), 9
    )
    assert heights.shape == shape
    assert heights.dtype == np.float64
    assert np.isfinite(heights).all()
    assert abs(heights.mean()) < 1e-13
    assert heights.std() > 0.0


@pytest.mark.parametrize("scale", [1e-15, 1e-9, 1e9])
def test_neither_atoms_nor_planets_overflow(scale):
    spectrum = random_surfaces.SelfAffineSpectrum(1.0, math.inf, 3.0 * scale)
    maps = [
        random_surfaces.gaussian_exponential(
            (40, 50), (scale, scale), 1e-3 * scale, 8.0 * scale, 3.0 * scale, 4, "sample"
        ),
        random_surfaces.self_affine((40, 50), (scale, scale), 1e-3 * scale, spectrum, 4, "sample"),
    ]
    for heights in maps:
        assert heights.std() == pytest.approx(1e-3 * scale, rel=1e-12)
        found = stats.surface_statistics(heights, (scale, scale), periodic=True)
        assert 1e-5 < found.rms_slope < 1e-2
        assert found.rms_curvature * scale < 1e-2


def test_a_strong_lay_still_has_its_budget():
    """Grooves 100 times as long as wide: of short waves only those across the grooves have any."""
    found = random_surfaces.resolved_variance((512, 512), (1.0, 1.0), (2.0, 200.0), 0.02)
    across = 2.0 / math.pi / (2.0 * math.pi / 0.02 * 2.0 / 2.3)
    assert found.cutoff == pytest.approx(across, rel=1e-3)
    turned = random_surfaces.resolved_variance((512, 512), (1.0, 1.0), (200.0, 2.0), 0.02)
    assert turned == pytest.approx(found, rel=1e-12)


def test_a_fine_surface_shares_its_waves_with_a_coarse_one_through_many_tiles():
    """Waves up to 200 per window: tiles of random numbers at both signs of the wavenumber."""
    coarse = random_surfaces.gaussian_exponential(
        (450, 405), (1 / 450, 1 / 405), 1.0, 0.02, 0.005, 11
    )
    fine = random_surfaces.gaussian_exponential(
        (900, 810), (1 / 900, 1 / 810), 1.0, 0.02, 0.005, 11
    )
    np.testing.assert_allclose(fine[::2, ::2], coarse, atol=1e-12)


def test_no_two_waves_share_a_random_number():
    """A white spectrum repeats nothing, at the seams between tiles neither."""
    heights = random_surfaces.self_affine(
        (300, 300), (1.0, 1.0), 1.0, random_surfaces.SelfAffineSpectrum(-1.0, math.inf, 2.05), 1
    )
    waves = np.fft.rfft2(heights, norm="forward")[:, 1:145].ravel()
    waves = waves[np.abs(waves) > 1e-9]
    assert waves.size > 30_000
    assert np.unique(np.round(waves / waves.std(), 8)).size == waves.size


def test_a_large_ball_keeps_every_digit_under_a_small_window():
    heights = elementary.sphere((5, 5), (1e-9, 1e-9), 1.0)
    assert heights[2, 3] == pytest.approx(-0.5e-18, rel=1e-15)
    assert elementary.paraboloid((5, 5), (1e-9, 1e-9), 1.0)[2, 3] == pytest.approx(-0.5e-18)


def test_outside_a_ball_there_is_its_plate():
    heights = elementary.sphere((1, 9), (1.0, 1.0), 2.0)[0]
    np.testing.assert_array_equal(heights[[0, 1, 2, 4, 6, 7, 8]], [-2.0] * 3 + [0.0] + [-2.0] * 3)
    np.testing.assert_allclose(heights[[3, 5]], math.sqrt(3.0) - 2.0, rtol=1e-14)


def test_a_wave_of_many_periods_stays_a_wave():
    heights = elementary.wave((1, 10**6), (1.0, 1e-9), 1.0, 8e-9)
    np.testing.assert_allclose(heights[0, -8:], heights[0, :8], atol=1e-8)


def test_roughness_far_from_zero_keeps_its_digits():
    """Nanometres at a height of a metre: what the numbers still hold, 1e-16 m."""
    z = random_surfaces.gaussian_exponential((64, 64), (1e-8, 1e-8), 1e-9, 1e-7, 4e-8, seed=1)
    far = stats.surface_statistics(z + 1.0, (1e-8, 1e-8), periodic=True)
    near = stats.surface_statistics(z, (1e-8, 1e-8), periodic=True)
    for name in near._fields:
        if name != "derivatives":
            assert getattr(far, name) == pytest.approx(getattr(near, name), rel=1e-5)
    np.testing.assert_allclose(detrended(z + 1.0, "mean"), z, atol=3e-16)


@pytest.mark.parametrize("z", [np.full((5, 6), 0.1), np.zeros((4, 4)), np.full((3, 3), 1e9 / 3.0)])
def test_a_plane_has_no_shape(z):
    with pytest.raises(DescriptionError, match="heights must vary"):
        stats.surface_statistics(z, (1.0, 1.0), periodic=True)
    assert stats.rms(z) <= 1e-15 * z.max()
    assert stats.rms_slope(z, (1.0, 1.0), periodic=True) == 0.0


def test_a_map_of_two_rows_has_no_curvature():
    z = np.arange(8.0).reshape(2, 4)
    with pytest.raises(DescriptionError, match=r"at least 3 x 3 pixels"):
        stats.rms_curvature(z, (1.0, 1.0), periodic=False)
    with pytest.raises(DescriptionError, match=r"at least 2 x 2 pixels"):
        stats.rms_slope(z[:1], (1.0, 1.0), periodic=False)


def test_a_trend_of_a_small_map_takes_what_the_map_holds():
    z = np.array([[1.0, 3.0, 2.0, 5.0]])
    np.testing.assert_allclose(detrended(z, "curvature").sum(), 0.0, atol=1e-15)
    np.testing.assert_allclose(detrended(z[:, :1], "curvature"), 0.0)
    np.testing.assert_allclose(detrended(z[:, :2], "tilt"), 0.0, atol=1e-15)
    np.testing.assert_allclose(detrended(z.reshape(2, 2), "tilt"), [[0.25, -0.25], [-0.25, 0.25]])
    np.testing.assert_allclose(detrended(z.reshape(2, 2), "curvature"), 0.0, atol=1e-15)


@pytest.mark.parametrize(
    ("rms", "slope", "normalise", "message"),
    [
        (None, None, "expected", "rms must be given, or else rms_slope"),
        (1e-9, 0.1, "expected", "rms must be given, or else rms_slope"),
        (1e-9, None, "none", "normalise must be 'expected' or 'sample'"),
    ],
)
def test_a_self_affine_surface_has_one_size(rms, slope, normalise, message):
    with pytest.raises(DescriptionError, match=message):
        random_surfaces.self_affine(
            (8, 8),
            (1.0, 1.0),
            rms,
            random_surfaces.SelfAffineSpectrum(0.8, 8.0, 3.0),
            1,
            normalise,
            rms_slope=slope,
        )


@pytest.mark.parametrize("trend", ["mean", "tilt", "curvature"])
def test_a_detrended_flat_is_flat(trend):
    """What round-off leaves of a plane is no roughness, however large the plane."""
    y, x = np.mgrid[:40, :60]
    plane = 0.3 if trend == "mean" else 1e-6 * (0.7 + 0.1 * x - 0.3 * y)
    assert not detrended(plane + np.zeros((40, 60)), trend).any()
    wave = 1e-13 * np.cos(2.0 * np.pi * x / 60.0)  # of the heights, some thousand times round-off
    assert detrended(plane + wave, trend).std() > 1e-14
