"""Menisci at asperities: the three laws, their reference values, and where they agree."""

from __future__ import annotations

import itertools
import json
import math
from pathlib import Path

import numpy as np
import pytest
from scipy import integrate, stats
from selection import quick

import contactkit as ck
from contactkit.capillary import asperities as laws
from contactkit.capillary import kelvin
from contactkit.scene.asperity_population import AsperityPopulation

CASES = json.loads((Path(__file__).parents[1] / "data" / "menisci.json").read_text())["physics"]
SURFACE = {"radius": 1e-6, "density": 5e13, "area": 1e-8}
LIQUID = {"surface_tension": 0.072, "wetting": 1.0, "height": 1e-9}


def population(separation, spread, **given):
    return laws.greenwood_williamson(separation, spread, **{**SURFACE, **LIQUID, **given})


def test_the_greenwood_williamson_sum_of_the_case_file():
    found, case = population(3e-9, 1e-9), CASES["gw_example"]
    assert found.force == pytest.approx(case["F_N"], rel=1e-12)
    assert found.n_wet == pytest.approx(case["N_wet"], rel=1e-12)
    assert found.n_touching == pytest.approx(case["N_contact"], rel=1e-12)


def test_the_cross_cut_of_the_case_file_is_eight_times_that():
    found, case = laws.cross_cut(3e-9, 1e-9, 1e-8, **LIQUID), CASES["crosscut_example"]
    assert found.force == pytest.approx(case["F_N"], rel=1e-12)
    assert found.area == pytest.approx(case["A_m_m2"], rel=1e-12)
    assert 8.0 < found.force / population(3e-9, 1e-9).force < 9.0


@pytest.mark.parametrize("separation", [-2e-9, 0.0, 0.5e-9, 3e-9, 12e-9, 25e-9])
@pytest.mark.parametrize("height", [1e-13, 1e-10, 1e-9, 1e-7])
def test_the_sum_is_that_of_its_summits_one_by_one(separation, height):
    """Quadrature over the heights z of the summits, of the force on each."""
    spread = 1e-9

    def fraction(x):  # x = D/sigma of a summit that does not touch
        return (1.0 - x * spread / height) * stats.norm.pdf(separation / spread - x)

    last = height / spread
    peak = min(max(separation / spread, 0.0), last)
    points = sorted({0.0, max(peak - 9.0, 0.0), peak, min(peak + 9.0, last), last})
    open_ones = sum(
        integrate.quad(fraction, a, b, epsabs=0.0, epsrel=1e-11, limit=400)[0]
        for a, b in itertools.pairwise(points)
    )
    expected = open_ones + stats.norm.sf(separation / spread)
    one = 2.0 * math.pi * 1e-6 * 0.072 * 5e13 * 1e-8
    found = population(separation, spread, height=height)
    assert found.force == pytest.approx(one * expected, rel=2e-9)


def test_heights_drawn_at_random_give_the_same_force():
    heights = np.random.default_rng(3).normal(0.0, 1e-9, 400_000)
    gap = np.maximum(2e-9 - heights, 0.0)
    each = kelvin.thin_film_force(1e-6, gap, 0.072, 1.0, 1e-9)
    found = population(2e-9, 1e-9, area=400_000 / 5e13)
    assert found.force == pytest.approx(each.sum(), rel=1e-2)
    assert found.n_touching == pytest.approx(np.sum(gap == 0.0), rel=2e-2)


def test_without_spread_of_heights_the_population_is_identical():
    for separation in (-1e-10, 0.3e-9, 2e-9):
        found = population(separation, 1e-16)
        expected = laws.identical(max(separation, 0.0), *SURFACE.values(), *LIQUID.values())
        assert found.force == pytest.approx(expected.force, rel=1e-6, abs=1e-300)
        assert found.coverage == pytest.approx(expected.coverage, rel=1e-6, abs=1e-300)


def test_force_and_cover_are_one_law():
    """Laplace pressure times the area under the menisci: what Eq. (2.43) says of any island."""
    for found in (
        population(1e-9, 1e-9),
        laws.identical(2e-10, 1e-6, 1e12, 1e-8, 0.072, 1.0, 1e-9),
    ):
        assert found.force == pytest.approx(0.072 * found.coverage * 1e-8 / 1e-9, rel=1e-13)


def test_deep_in_the_tail_and_far_below_it_nothing_is_lost():
    # Mills' ratio: the mean of Q from t on is phi/t^2 (1 - 3/t^2 + ...)
    far = population(31e-9, 1e-9, height=1e-9).force
    unit = 2.0 * math.pi * 1e-6 * 0.072 * 5e13 * 1e-8
    t = 30.0
    series = 1.0 - 3.0 / t**2 + 15.0 / t**4 - 105.0 / t**6 + 945.0 / t**8
    assert far == pytest.approx(unit * stats.norm.pdf(t) / t**2 * series, rel=1e-8)
    assert population(-60e-9, 1e-9).force == pytest.approx(unit, rel=1e-14)
    assert population(1.0, 1e-9).force == 0.0


@pytest.mark.parametrize("height", [1e-16, 1e-12, 1e-9, 17e-9])
@pytest.mark.parametrize("separation", [-3e-9, 0.0, 5e-9])
def test_the_cross_cut_is_the_fraction_of_a_normal_surface(separation, height):
    found = laws.cross_cut(separation, 1e-9, 1.0, 0.072, 1.0, height)
    x = np.polynomial.legendre.leggauss(200)
    z = separation - 0.5 * height * (x[0] + 1.0)
    expected = 0.5 * height / 1e-9 * np.sum(x[1] * stats.norm.pdf(z / 1e-9))
    # The limits of the film are rounded as the separation is; of the thinnest, 3e-9 are lost.
    rounded = np.finfo(float).eps * abs(separation) / height
    assert found.area == pytest.approx(expected, rel=1e-10 + rounded)


def test_peaks_of_a_gaussian_surface_are_counted():
    """Islands above two sigma on a made surface with a known spectrum."""
    n, size = 512, 1.0
    k = np.hypot(*np.meshgrid(np.fft.fftfreq(n), np.fft.fftfreq(n))) * n / size
    filter_ = np.exp(-((k / 20.0) ** 2))
    noise = np.fft.fft2(np.random.default_rng(0).normal(size=(n, n)))
    z = np.fft.ifft2(noise * filter_).real
    power = np.abs(np.fft.fft2(z)) ** 2 / n**4
    m0 = power[k > 0].sum()
    m2 = 0.5 * (power * (2.0 * math.pi * k) ** 2).sum()
    z = (z - z.mean()) / math.sqrt(m0)
    from contactkit.capillary.film_islands import islands

    found = islands(z > 2.5, periodic=True)[1]
    assert found == pytest.approx(laws.gaussian_peaks(2.5, size**2, m0, m2), rel=0.2)


# Scene objects -----------------------------------------------------------------------------------


def test_a_sphere_split_into_equal_ones_fills_the_same_square():
    made = AsperityPopulation.split(radius=50e-6, count=2500)
    assert made.radius == pytest.approx(1e-6, rel=1e-15)
    assert made.spacing == pytest.approx(2e-6, rel=1e-12)
    assert made.density * (2 * 50e-6) ** 2 == pytest.approx(2500.0, rel=1e-12)


@pytest.mark.parametrize("face", quick([50e-6, 1e-3, None], 0))
@pytest.mark.parametrize("profile", ["exact", "thin-film"])
def test_the_menisci_of_a_split_sphere_are_as_many_as_it_was_split_into(film_scene, face, profile):
    """Whatever the face: over (2R)^2, as they were counted, not over its pi R^2."""
    flat = ck.Flat() if face is None else ck.Flat(radius=face)
    split = AsperityPopulation.split(radius=50e-6, count=2500)
    effect = ck.AsperityMenisci(
        asperities=split, law="identical", profile=profile, meniscus_height=100e-9
    )
    scene = film_scene(effect, lower=flat, upper=flat, initial_gap=10e-9, final_gap=50e-9)
    result = ck.simulate(ck.plan(scene))
    part = result.of(ck.AsperityMenisci)
    assert part.n_wet[0] == pytest.approx(2500.0, rel=1e-12)
    thin = 2500 * 2 * math.pi * 1e-6 * 2 * 0.03 * (1.0 - 10e-9 / 100e-9)
    assert part.force[0] == pytest.approx(thin, rel=1e-9 if profile == "thin-film" else 0.2)
    assert part.coverage[0] == pytest.approx(0.9 * 2 * math.pi * 1e-6 * 1e-7 / 4e-12, rel=1e-9)


def test_a_density_is_counted_over_the_round_face(film_scene):
    effect = ck.AsperityMenisci(
        asperities=AsperityPopulation(density=1e12, radius=1e-6),
        law="identical",
        profile="thin-film",
        meniscus_height=100e-9,
    )
    flat = ck.Flat(radius=1e-4)
    scene = film_scene(effect, lower=flat, upper=flat, initial_gap=10e-9, final_gap=50e-9)
    part = ck.simulate(ck.plan(scene)).of(ck.AsperityMenisci)
    assert part.n_wet[0] == pytest.approx(1e12 * math.pi * 1e-8, rel=1e-12)


def test_split_menisci_touch_where_the_kernel_says_they_do():
    """Cover pi/4, circles touching in a square order, at n = R/(2 (s - D))."""
    from contactkit.capillary.many_menisci import max_separate_split

    n = max_separate_split(50e-6, 500e-9, 0.0)
    made = AsperityPopulation.split(radius=50e-6, count=round(n * n))
    found = laws.identical(0.0, made.radius, made.density, 1e-8, 0.072, 1.0, 500e-9)
    assert found.coverage == pytest.approx(math.pi / 4.0, rel=1e-12)


@pytest.mark.parametrize("field", ["density", "radius"])
def test_a_population_needs_summits(field):
    given = {"density": 1e13, "radius": 1e-6, field: 0.0}
    with pytest.raises(ck.DescriptionError, match=f"AsperityPopulation.{field} must be positive"):
        AsperityPopulation(**given)
