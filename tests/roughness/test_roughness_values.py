"""Random surfaces against what they were asked for; statistics of maps that are known."""

from __future__ import annotations

import math

import numpy as np
import pytest
from scipy.integrate import dblquad

from contactkit.errors import DescriptionError
from contactkit.roughness import elementary, random_surfaces, spectra
from contactkit.roughness import statistics as stats
from contactkit.roughness.height_maps import detrended

SCAN = 20e-6  # window of the source's surfaces [m]
SEEDS = range(40)


def exponential(n, beta, cutoff, seed, normalise="expected", rms=1e-9):
    pixel = (SCAN / n, SCAN / n)
    return random_surfaces.gaussian_exponential((n, n), pixel, rms, beta, cutoff, seed, normalise)


# Correlation and spectrum -------------------------------------------------------------------


def mean_autocorrelation(beta):
    total = np.zeros((256, 256))
    for seed in SEEDS:
        heights = exponential(256, beta, 2.1 * SCAN / 256, seed, "none")
        total += stats.autocorrelation(heights, periodic=True)
    return total / len(SEEDS) * 1e18


def test_the_autocorrelation_decays_by_the_law_of_the_source():
    """Mean of 40 maps; its noise is about sqrt(pi) l/L/sqrt(40) = 0.4 % of the variance."""
    beta, dx = 1e-6, SCAN / 256
    found = mean_autocorrelation(beta)
    lag = np.arange(3, 40)  # shorter lags are rounded off by the cut-off
    for line in (found[0, lag], found[lag, 0]):
        np.testing.assert_allclose(line, np.exp(-2.3 * lag * dx / beta), atol=0.008)
    slant = np.exp(-2.3 * lag * math.sqrt(2.0) * dx / beta)
    np.testing.assert_allclose(found[lag, lag], slant, atol=0.008)


def test_a_surface_with_a_lay_decays_faster_across_it():
    beta, dx = (0.6e-6, 2.4e-6), SCAN / 256
    found = mean_autocorrelation(beta)
    lag = np.arange(3, 40)
    for line, length in ((found[lag, 0], beta[0]), (found[0, lag], beta[1])):
        np.testing.assert_allclose(line, np.exp(-2.3 * lag * dx / length), atol=0.03)


@pytest.mark.parametrize("hurst", [0.3, 0.8])
def test_a_self_affine_spectrum_falls_by_its_power_and_is_flat_before(hurst):
    n, longest, shortest = 256, 64.0, 4.0
    density = 0.0
    for seed in SEEDS[:20]:
        heights = random_surfaces.self_affine(
            (n, n),
            (1.0, 1.0),
            1.0,
            random_surfaces.SelfAffineSpectrum(hurst, longest, shortest),
            seed,
        )
        found = spectra.radial_spectrum(heights, (1.0, 1.0), periodic=True)
        density = density + found.density / 20
    q = found.wavenumber
    power = (q > 1.3 * 2.0 * math.pi / longest) & (q < 0.95 * 2.0 * math.pi / shortest)
    slope = np.polyfit(np.log(q[power]), np.log(density[power]), 1)[0]
    assert slope == pytest.approx(-2.0 - 2.0 * hurst, abs=0.05)
    flat = q < 0.8 * 2.0 * math.pi / longest
    assert density[flat].max() / density[flat].min() < 2.0  # rings of 8 to 20 waves, 20 maps
    assert (density[q > 1.05 * 2.0 * math.pi / shortest] < 1e-25).all()


# Variance -----------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("beta", "n", "fraction"),
    [
        (0.5e-6, 256, 0.89),
        (0.5e-6, 1024, 0.97),
        (0.05e-6, 256, 0.25),
        (0.05e-6, 1024, 0.72),
        (0.05e-6, 4096, 0.93),
        (0.05e-6, 8192, 0.96),
    ],
)
def test_the_cutoff_takes_the_fraction_of_the_notes(beta, n, fraction):
    pixel, cutoff = (SCAN / 256, SCAN / 256), 2.0 * SCAN / n
    found = random_surfaces.resolved_variance((256, 256), pixel, beta, cutoff)
    assert 1.0 - found.cutoff == pytest.approx(fraction, abs=6e-3)
    assert sum(found) == pytest.approx(1.0, abs=1e-12)
    if n == 256:
        assert found.resolved == pytest.approx(fraction, abs=6e-3)


def test_the_cutoff_of_a_surface_with_a_lay_agrees_with_an_integral():
    ly, lx, qc = 0.6 / 2.3, 3.0 / 2.3, 2.0 * math.pi / 0.7

    def density(q, angle):
        stretched = (q * lx * math.cos(angle)) ** 2 + (q * ly * math.sin(angle)) ** 2
        return 4.0 * lx * ly / (2.0 * math.pi) * q * (1.0 + stretched) ** -1.5

    inside, _ = dblquad(density, 0.0, math.pi / 2, 0.0, qc, epsabs=1e-10)
    found = random_surfaces.resolved_variance((64, 64), (0.3, 0.3), (0.6, 3.0), 0.7)
    assert found.cutoff == pytest.approx(1.0 - inside, abs=1e-8)


def test_a_long_window_loses_little():
    short, long = (
        random_surfaces.resolved_variance((n, n), (0.1, 0.1), 1.0, 0.4).window for n in (64, 512)
    )
    assert 0.0 < long < 2e-3 < short < 0.1


@pytest.mark.parametrize("normalise", ["expected", "sample", "none"])
def test_the_standard_deviation_is_what_it_says(normalise):
    recipe = ((64, 48), (1e-9, 1e-9), 2e-9, 6e-9, 4e-9)
    maps = [random_surfaces.gaussian_exponential(*recipe, seed, normalise) for seed in range(300)]
    variance = np.array([heights.var() for heights in maps]) / 4e-18
    noise = float(variance.std()) / math.sqrt(300)
    if normalise == "sample":
        np.testing.assert_allclose(variance, 1.0, rtol=1e-12)
    else:
        fraction = random_surfaces.resolved_variance(recipe[0], recipe[1], 6e-9, 4e-9).resolved
        assert 0.5 < fraction < 0.95
        expected = 1.0 if normalise == "expected" else fraction
        assert float(variance.mean()) == pytest.approx(expected, abs=4.0 * noise)


def test_the_variance_of_a_map_scatters_by_the_rule_of_the_notes():
    variance = [exponential(128, 1e-6, 3.0 * SCAN / 128, seed).var() for seed in range(200)]
    scatter = np.std(variance) / np.mean(variance)
    # 200 maps tell it to 5 %; without the waves that the cut-off takes it is a sixth more.
    assert scatter == pytest.approx(math.sqrt(math.pi) * 1e-6 / 2.3 / SCAN, rel=0.2)


def test_heights_are_gaussian():
    maps = np.array([exponential(128, 0.5e-6, 3.0 * SCAN / 128, seed) for seed in SEEDS])
    assert np.mean([stats.kurtosis(h) for h in maps]) == pytest.approx(3.0, abs=0.05)
    assert np.mean([stats.skewness(h) for h in maps]) == pytest.approx(0.0, abs=0.03)
    above = stats.bearing_fraction(maps.reshape(-1, 128), [1e-9, 2e-9])
    np.testing.assert_allclose(above, [0.158655, 0.022750], atol=3e-3)


def test_the_slope_has_no_end():
    """It is sigma sqrt(2 * 2.3 pi/(beta cutoff)), once the cut-off is far below beta."""
    pixel, beta = (SCAN / 1024, SCAN / 1024), 4e-6
    for waves in (64, 128, 256):
        heights = exponential(1024, beta, SCAN / waves, seed=5, normalise="none")
        slope = math.sqrt(spectra.spectral_moment(heights, pixel, 2))
        law = 1e-9 * math.sqrt(2.0 * 2.3 * math.pi / (beta * SCAN / waves))
        assert slope == pytest.approx(law, rel=4.0 / waves)
        # Differences of 4 pixels per wave miss up to 10 %, of 16 up to 0.6 %.
        assert (
            stats.rms_slope(heights, pixel, periodic=True) / slope
            > 1.0 - 1.65 * (waves / 1024) ** 2
        )


def test_a_self_affine_surface_has_the_slope_asked_for():
    spectrum = random_surfaces.SelfAffineSpectrum(0.8, 64e-9, 8e-9)
    pixel = (0.5e-9, 0.5e-9)
    heights = random_surfaces.self_affine(
        (192, 320), pixel, None, spectrum, 1, "sample", rms_slope=0.1
    )
    assert spectra.spectral_moment(heights, pixel, 2) == pytest.approx(0.01, rel=1e-12)
    # Differences miss a little: at most 1 - sinc of 16 pixels per wave, 0.6 %.
    assert stats.rms_slope(heights, pixel, periodic=True) == pytest.approx(0.1, rel=0.007)
    tall = random_surfaces.self_affine((192, 320), pixel, 3e-9, spectrum, 1, "sample")
    assert tall.std() == pytest.approx(3e-9, rel=1e-12)


def test_a_seed_gives_this_surface_everywhere():
    """The numbers of one small map, so that no release can change the surfaces of a seed."""
    heights = random_surfaces.gaussian_exponential((4, 6), (1.0, 1.0), 1.0, 2.0, 2.0, seed=2024)
    np.testing.assert_allclose(heights[:2, :3], GOLDEN, rtol=1e-12)


GOLDEN = [
    [-0.03055285265253877, 1.8052951697688544, -0.7372609509195316],
    [0.8981008053121927, 0.26769591509955637, -0.38290593377490256],
]


# Shapes -------------------------------------------------------------------------------------


def test_a_wave_has_the_numbers_of_a_cosine():
    pixel = (2e-9, 1e-9)
    heights = elementary.wave((8, 64), pixel, 3e-9, 16e-9)
    found = stats.surface_statistics(heights, pixel, periodic=True, derivatives="differences")
    q = 2.0 * math.pi / 16e-9
    assert found.rms == pytest.approx(3e-9 / math.sqrt(2.0), rel=1e-13)
    assert (found.highest, found.lowest) == (pytest.approx(3e-9), pytest.approx(-3e-9))
    assert found.kurtosis == pytest.approx(1.5, rel=1e-12)
    sinc = math.sin(q * 0.5e-9) / (q * 0.5e-9)
    assert found.rms_slope == pytest.approx(q * sinc * found.rms, rel=1e-12)
    assert found.rms_curvature == pytest.approx(0.5 * (q * sinc) ** 2 * found.rms, rel=1e-12)
    assert spectra.spectral_moment(heights, pixel, 2) == pytest.approx((q * found.rms) ** 2)
    assert found.correlation_length[0] == math.inf  # along the crests
    tenth = math.acos(0.1) / q
    assert found.correlation_length[1] == pytest.approx(tenth, rel=5e-3)  # straight between pixels


def test_a_product_of_waves_has_peaks_at_its_crests():
    heights = elementary.wave((12, 20), (1.0, 1.0), 2.0, 10.0, 6.0)
    assert {tuple(at) for at in np.argwhere(heights > 1.999).tolist()} == {
        (i, j) for i in (0, 6) for j in (0, 10)
    } | {(i, j) for i in (3, 9) for j in (5, 15)}
    moved = elementary.wave((12, 20), (1.0, 1.0), 2.0, 10.0, 6.0, phase=(0.0, math.pi / 5.0))
    np.testing.assert_allclose(moved, np.roll(heights, -1, axis=1), atol=1e-13)


def test_a_ball_is_a_ball():
    """Distance of each point of the surface from the centre of the ball is its radius."""
    heights = elementary.sphere((31, 40), (0.1, 0.13), 5.0)
    y, x = (np.arange(31) - 15)[:, None] * 0.1, (np.arange(40) - 20)[None, :] * 0.13
    np.testing.assert_allclose(x * x + y * y + (heights + 5.0) ** 2, 25.0, rtol=1e-14)
    assert heights.argmax() == 15 * 40 + 20


def test_a_paraboloid_is_the_ball_near_its_apex():
    shape, pixel = (41, 41), (0.01, 0.01)
    ball, bowl = elementary.sphere(shape, pixel, 10.0), elementary.paraboloid(shape, pixel, 10.0)
    r = 0.2 * math.sqrt(2.0)
    assert (bowl - ball).max() == pytest.approx(r**4 / 8e3, rel=1e-3)
    assert (bowl >= ball).all()
    moved = elementary.paraboloid(shape, pixel, 10.0, 20.0, centre=(0.1, 0.3))
    assert np.unravel_index(moved.argmax(), shape) == (10, 30)
    assert moved[20, 30] == pytest.approx(-(0.1**2) / 40.0)
    assert moved[10, 40] == pytest.approx(-(0.1**2) / 20.0)


def test_the_curvature_of_a_ball_is_one_over_its_radius():
    heights = elementary.sphere((21, 21), (1e-3, 1e-3), 7.0)
    assert stats.rms_curvature(heights, (1e-3, 1e-3), periodic=False) == pytest.approx(
        1.0 / 7.0, rel=1e-5
    )


# Statistics by other means ------------------------------------------------------------------


@pytest.mark.parametrize("periodic", [False, True])
def test_the_autocorrelation_is_the_mean_of_products(periodic):
    z = np.random.default_rng(4).standard_normal((4, 5))
    found = stats.autocorrelation(z, periodic)
    z = z - z.mean()
    for i in range(-3, 4):
        for j in range(-4, 5):
            if periodic:
                brute = np.mean(z * np.roll(z, (-i, -j), (0, 1)))
            else:
                brute = np.mean(
                    [
                        z[a, b] * z[a + i, b + j]
                        for a in range(max(0, -i), min(4, 4 - i))
                        for b in range(max(0, -j), min(5, 5 - j))
                    ]
                )
            assert found[i, j] == pytest.approx(brute, abs=1e-13)


@pytest.mark.parametrize("periodic", [False, True])
def test_the_spectrum_is_that_of_white_noise(periodic):
    """C = variance times the area of a pixel, at all wavenumbers."""
    z = np.random.default_rng(7).standard_normal((256, 320)) * 1e-9
    found = spectra.radial_spectrum(z, (1e-9, 2e-9), periodic)
    np.testing.assert_allclose(np.average(found.density, weights=found.n_waves), 2e-36, rtol=0.02)
    well = found.n_waves > 500
    np.testing.assert_allclose(found.density[well], 2e-36, rtol=0.35)


@pytest.mark.slow
def test_the_correlation_length_is_the_one_asked_for():
    pixel = (SCAN / 512, SCAN / 512)
    beta = (0.5e-6, 0.8e-6)
    found = np.mean(
        [
            stats.correlation_length(
                random_surfaces.gaussian_exponential((512, 512), pixel, 1e-9, beta, 0.09e-6, seed),
                pixel,
                periodic,
            )
            for seed in range(8)
            for periodic in (True, False)
        ],
        axis=0,
    )
    np.testing.assert_allclose(found, beta, rtol=0.08)


def test_the_bearing_curve_of_a_ramp_is_a_straight_line():
    ramp = np.linspace(0.0, 1.0, 1001)[None, :] * np.ones((3, 1))
    level = np.linspace(0.05, 0.95, 7)
    np.testing.assert_allclose(stats.bearing_fraction(ramp, level), 1.0 - level, atol=1e-3)


@pytest.mark.parametrize("trend", ["mean", "tilt", "curvature"])
def test_a_trend_is_taken_off_as_by_least_squares(trend):
    z = np.random.default_rng(3).standard_normal((9, 12)) + 40.0
    y, x = np.mgrid[:9.0, :12.0]
    columns = [np.ones_like(x), y, x, y * y, x * x, x * y]
    columns = columns[: {"mean": 1, "tilt": 3, "curvature": 6}[trend]]
    a = np.stack([c.ravel() for c in columns], axis=1)
    fit = a @ np.linalg.lstsq(a, z.ravel())[0]
    np.testing.assert_allclose(detrended(z, trend), z - fit.reshape(z.shape), atol=1e-12)


@pytest.mark.parametrize("scale", [1e-160, 1e200])
def test_heights_that_are_no_lengths_are_refused(scale):
    heights = scale * np.cos(np.arange(16.0))[:, None] * np.cos(np.arange(16.0))
    for periodic in (False, True):
        with pytest.raises(DescriptionError, match="check their unit"):
            stats.surface_statistics(heights, 1e-9, periodic)
