"""Power spectral densities and derivatives of maps: sums, conventions, known surfaces."""

from __future__ import annotations

import math

import numpy as np
import pytest

from contactkit.errors import DescriptionError
from contactkit.roughness import spectra
from contactkit.roughness import statistics as stats
from contactkit.roughness.height_maps import detrended
from contactkit.roughness.random_surfaces import SelfAffineSpectrum, self_affine

SHAPES = [(48, 48), (31, 45), (20, 33), (1, 64)]  # even, odd, mixed, one row
PIXEL = (2e-9, 1.3e-9)


def wave_map(n):
    """A given sum of cosines, rms 2 nm: no random numbers."""
    x = (np.arange(n) + 0.5) / n
    across, down = np.meshgrid(x, x)
    heights, k = np.zeros((n, n)), 0
    for i in range(-6, 7):
        for j in range(7):
            q = math.hypot(i, j)
            if 2 <= q <= 6.5 and not (j == 0 and i < 0):
                k += 1
                turn = 2.0 * math.pi * (i * across + j * down)
                heights += q**-1.8 * np.cos(turn + 2.399963229728653 * k * k)
    return heights * (2e-9 / heights.std())


def rough(shape):
    return np.random.default_rng(3).standard_normal(shape) * 1e-9


# Values of a program written apart from this one (numpy only).
REFERENCE = {
    "rms_slope": 0.039339640359248695,
    "rms_laplacian": 1012290.6287903271,
    "rms_curvature": 506145.31439516356,
    "nayak_parameter": 2.5670843672158554,
}


def test_the_numbers_of_a_given_map():
    heights, pixel = wave_map(48), 1e-6 / 48
    found = stats.surface_statistics(heights, pixel, periodic=True)
    for name, value in REFERENCE.items():
        assert getattr(found, name) == pytest.approx(value, rel=1e-12)
    coarse = stats.surface_statistics(heights, pixel, True, derivatives="differences")
    assert coarse.rms_slope == pytest.approx(0.03898878933259501, rel=1e-12)
    plane = spectra.plane_spectrum(heights, pixel, periodic=True)
    assert plane.density[2, 3] == pytest.approx(2.7809630804510996e-32, rel=1e-11)
    profiles = spectra.profile_spectrum(heights, pixel, periodic=True)
    assert profiles.density[3] == pytest.approx(2.5667733070649747e-25, rel=1e-11)


@pytest.mark.parametrize("shape", SHAPES)
def test_sums_of_the_density_are_those_of_the_heights(shape):
    """Variance and slopes, from the transform of the derivative back in space."""
    z = rough(shape)
    z -= z.mean()
    found = spectra.plane_spectrum(z, PIXEL, periodic=True)
    area = z.size * PIXEL[0] * PIXEL[1]
    assert found.density.sum() / area == pytest.approx(z.var(), rel=1e-12)
    assert found.density[0, 0] <= 1e-20 * found.density.max()
    numbers = stats.surface_statistics(z, PIXEL, periodic=True)
    # A wave at the Nyquist wavenumber counts with its full slope, which no sample of it shows.
    inner = np.fft.fft2(z)
    for axis, (n, d, slope) in enumerate(zip(shape, PIXEL, numbers.rms_slopes, strict=True)):
        q = 2.0 * math.pi * np.fft.fftfreq(n, d)
        turned = inner * np.expand_dims(1j * q, 1 - axis)
        if n % 2:
            assert np.std(np.fft.ifft2(turned).real) == pytest.approx(slope, rel=1e-12)
        assert np.sqrt(np.sum(np.abs(turned) ** 2)) / z.size == pytest.approx(slope, rel=1e-12)
    q2 = found.qy[:, None] ** 2 + found.qx[None, :] ** 2
    moments = [float(np.sum(found.density * q2**k)) / area for k in (1, 2)]
    assert numbers.rms_slope**2 == pytest.approx(moments[0], rel=1e-12)
    assert numbers.rms_laplacian**2 == pytest.approx(moments[1], rel=1e-12)


@pytest.mark.parametrize("shape", SHAPES)
@pytest.mark.parametrize("axis", [0, 1])
def test_profiles_sum_to_the_variance(shape, axis):
    z = rough(shape)
    found = spectra.profile_spectrum(z, PIXEL, True, axis)
    n_lines, length = shape[1 - axis], shape[axis] * PIXEL[axis]
    total = float(np.sum(found.n_waves * found.density)) / n_lines / length
    assert total == pytest.approx(z.var(), rel=1e-12)


def test_rings_sum_to_the_variance_of_a_resolved_map():
    heights = wave_map(48)
    found = spectra.radial_spectrum(heights, 1e-6 / 48, periodic=True)
    assert float(np.sum(found.n_waves * found.density)) / 1e-12 == pytest.approx(
        heights.var(), rel=1e-12
    )


def test_the_integrals_of_the_three_densities_agree():
    """The sums above are integrals: trapezoids of C_iso and C1D, of a map of many waves."""
    spectrum = SelfAffineSpectrum(0.8, 24.0, 6.0)
    z = self_affine((256, 256), (1.0, 1.0), 1.0, spectrum, 2, "sample")
    ring, profile = (
        make(z, 1.0, True) for make in (spectra.radial_spectrum, spectra.profile_spectrum)
    )
    by_rings = np.trapezoid(ring.wavenumber * ring.density, ring.wavenumber) / (2.0 * math.pi)
    by_profiles = np.trapezoid(profile.density, profile.wavenumber) / math.pi
    assert by_rings == pytest.approx(1.0, rel=0.05)
    assert by_profiles == pytest.approx(1.0, rel=0.02)
    total = float(spectra.persson_density(spectra.plane_spectrum(z, 1.0, True).density).sum())
    assert total * (2.0 * math.pi / 256) ** 2 == pytest.approx(1.0, rel=1e-12)


def test_a_window_keeps_the_density_of_a_cut_out_map():
    """A piece of a large surface has the density of the surface, mean of 16 pieces."""
    spectrum = SelfAffineSpectrum(0.8, 32.0, 6.0)
    z = self_affine((512, 512), (1.0, 1.0), 1.0, spectrum, 5, "sample")
    pieces = [z[i : i + 128, j : j + 128] for i in range(0, 512, 128) for j in range(0, 512, 128)]
    for make, rel in ((spectra.radial_spectrum, 0.15), (spectra.profile_spectrum, 0.15)):
        whole, parts = make(z, 1.0, True), [make(piece, 1.0, False) for piece in pieces]
        q = parts[0].wavenumber
        inside = (q > 2.0 * math.pi / 25.0) & (q < 2.0 * math.pi / 7.0)
        mean = np.mean([one.density for one in parts], axis=0)[inside]
        expected = np.exp(np.interp(q[inside], whole.wavenumber, np.log(whole.density + 1e-99)))
        assert np.median(mean / expected) == pytest.approx(1.0, rel=rel)


def test_a_window_of_a_map_has_the_variance_of_its_centre():
    z = np.ones((40, 1)) * np.cos(2.0 * math.pi * np.arange(400) / 8.0)[None, :]
    found = spectra.plane_spectrum(z, 1.0, periodic=False)
    assert found.density.sum() / z.size == pytest.approx(z.var(), rel=1e-3)


def test_a_tilt_has_a_number_and_is_not_removed():
    heights = wave_map(48)
    y, x = np.mgrid[:48, :48]
    tilted = heights + 0.01 * y * PIXEL[0] - 0.02 * x * PIXEL[1]
    bare = stats.surface_statistics(heights, PIXEL, periodic=False)
    found = stats.surface_statistics(tilted, PIXEL, periodic=False)
    added = np.subtract(found.tilt, bare.tilt)
    np.testing.assert_allclose(added, (0.01, -0.02), rtol=1e-9)
    assert found.rms > 1.02 * bare.rms
    assert found.rms_laplacian == pytest.approx(bare.rms_laplacian, rel=1e-9)
    level = stats.surface_statistics(detrended(tilted), PIXEL, periodic=False)
    assert level.tilt == pytest.approx((0.0, 0.0), abs=1e-12)


def test_values_end_at_the_reliability_cutoff():
    z = rough((32, 64))
    assert spectra.radial_spectrum(z, (1e-9, 2e-9), True).wavenumber.max() <= math.pi / 2e-9
    for make in (spectra.radial_spectrum, spectra.profile_spectrum):
        found = make(z, 1e-9, True, shortest_wavelength=8e-9)
        assert 0.9 < found.wavenumber.max() / (2.0 * math.pi / 8e-9) < 1.0 + 1e-9
        for refused in (1e-9, 1.0, math.nan):
            with pytest.raises(DescriptionError, match="shortest_wavelength"):
                make(z, 1e-9, True, shortest_wavelength=refused)


def test_a_groove_of_one_row_is_a_wave():
    q = 2.0 * math.pi / 16e-9
    z = 1e-9 * np.cos(q * np.arange(64) * 1e-9)[None, :]
    found = stats.surface_statistics(z, 1e-9, periodic=True)
    assert found.rms_slopes == pytest.approx((0.0, q * 1e-9 / math.sqrt(2.0)), rel=1e-12)
    assert found.rms_laplacian == pytest.approx(q * q * 1e-9 / math.sqrt(2.0), rel=1e-12)
    ring = spectra.radial_spectrum(z, 1e-9, periodic=True)
    assert ring.wavenumber[ring.density.argmax()] == pytest.approx(q, rel=1e-12)
    again = stats.surface_statistics(z, 1e-9, True, derivatives="differences")
    assert again.rms_slopes[0] == 0.0
    with pytest.raises(DescriptionError, match="pixels"):
        stats.surface_statistics(z, 1e-9, periodic=False)


@pytest.mark.parametrize(
    ("heights", "message"),
    [
        (np.ma.masked_less(rough((8, 8)), 0.0), "masked"),
        (np.where(np.eye(8) > 0.0, np.nan, rough((8, 8))), "8 pixels that are not finite"),
        (np.full((8, 8), 3e-9), "vary"),
        (np.arange(8.0), "two dimensions"),
    ],
)
def test_maps_that_have_no_statistics_are_refused(heights, message):
    with pytest.raises(DescriptionError, match=message):
        stats.surface_statistics(heights, 1e-9, periodic=True)


@pytest.mark.parametrize(
    "make",
    [
        stats.rms,
        stats.skewness,
        stats.bearing_curve,
        lambda z: stats.bearing_fraction(z, 0.0),
        lambda z: stats.autocorrelation(z, periodic=False),
        lambda z: stats.rms_slope(z, (1.0, 1.0), periodic=True),
        lambda z: stats.rms_curvature(z, (1.0, 1.0), periodic=False),
        lambda z: stats.correlation_length(z, (1.0, 1.0), periodic=True),
        lambda z: stats.summits(z, 1.0, periodic=True),
        lambda z: spectra.plane_spectrum(z, 1.0, periodic=False),
        lambda z: spectra.profile_spectrum(z, 1.0, periodic=False),
        lambda z: spectra.spectral_moment(z, 1.0, 2),
    ],
)
def test_no_statistic_overlooks_a_hole(make):
    holes = np.zeros((8, 8), dtype=bool)
    holes[2, 3] = True
    with pytest.raises(DescriptionError, match="1 masked pixels"):
        make(np.ma.MaskedArray(rough((8, 8)), holes))
    make(np.ma.MaskedArray(rough((8, 8)), False))


def test_impossible_choices_are_refused():
    z = rough((8, 8))
    with pytest.raises(DescriptionError, match="pixel_size"):
        stats.surface_statistics(z, (1e-9, 0.0), periodic=True)
    with pytest.raises(DescriptionError, match="derivatives"):
        stats.surface_statistics(z, 1e-9, periodic=False, derivatives="spectral")
    with pytest.raises(DescriptionError, match="derivatives"):
        stats.surface_statistics(z, 1e-9, periodic=True, derivatives="finite")
    with pytest.raises(DescriptionError, match="axis"):
        spectra.profile_spectrum(z, 1e-9, True, axis=2)
    with pytest.raises(DescriptionError, match="points"):
        stats.bearing_curve(z, points=1)
    with pytest.raises(DescriptionError, match="summit"):
        stats.summits(np.ones((5, 5)), 1.0, periodic=True)


def test_the_flat_bearing_curve_of_equal_heights():
    found = stats.bearing_curve(np.full((4, 4), 2.0))
    assert set(found.height) == {0.0}
    assert set(found.fraction) == {1.0}


def test_the_summits_of_a_gaussian_map_have_the_density_of_nayak():
    """Density m4/(6 sqrt3 pi m2), with profile moments; radius near 1/sqrt(m4) 3 sqrt(pi)/8."""
    spectrum = SelfAffineSpectrum(0.8, 64.0, 32.0)
    z = self_affine((1024, 1024), (1.0, 1.0), None, spectrum, 1, "sample", rms_slope=0.1)
    numbers = stats.surface_statistics(z, 1.0, periodic=True)
    m2, m4 = numbers.rms_slope**2 / 2.0, 3.0 / 8.0 * numbers.rms_laplacian**2
    found = stats.summits(z, 1.0, periodic=True)
    assert found.density == pytest.approx(m4 / m2 / (6.0 * math.sqrt(3.0) * math.pi), rel=0.05)
    assert found.radius == pytest.approx(3.0 * math.sqrt(math.pi / m4) / 8.0, rel=0.05)
