"""Laws of scale and order that hold for humidity, asperities and divided menisci."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import contactkit as ck
from contactkit.analyses.division import divide_meniscus
from contactkit.capillary import asperities as laws
from contactkit.capillary import kelvin
from contactkit.capillary import many_menisci as menisci
from contactkit.capillary.condensed import condensed_bridges
from contactkit.capillary.island_bridges import curvature_of_area, measure_islands

angles = st.floats(0.0, 1.4)
scales = st.floats(-3.0, 3.0).map(lambda x: 10.0**x)


@given(st.floats(0.01, 0.99), st.floats(250.0, 400.0), st.floats(1e-5, 1e-3))
def test_humidity_and_pressure_lead_to_each_other(humidity, temperature, molar):
    pressure = kelvin.laplace_pressure(molar, temperature, humidity)
    assert pressure < 0.0
    assert kelvin.relative_humidity(pressure, molar, temperature) == pytest.approx(
        humidity, rel=1e-12
    )
    radius = kelvin.kelvin_radius(0.07, molar, temperature, humidity)
    assert radius * pressure == pytest.approx(-0.07, rel=1e-13)


@given(st.floats(-5.0, 8.0), st.floats(0.01, 10.0), scales)
def test_asperities_scale_with_their_lengths(separation, height, scale):
    """All lengths times s, densities over s^2: so many summits, s times the force."""
    one = laws.greenwood_williamson(separation, 1.0, 30.0, 0.01, 1e4, 0.07, 1.5, height)
    other = laws.greenwood_williamson(
        scale * separation,
        scale,
        scale * 30.0,
        0.01 / scale**2,
        1e4 * scale**2,
        0.07,
        1.5,
        scale * height,
    )
    assert other.force == pytest.approx(scale * one.force, rel=1e-10)
    assert other.coverage == pytest.approx(one.coverage, rel=1e-10)
    assert one.n_touching <= one.n_wet <= 0.01 * 1e4 * (1.0 + 1e-12)


@given(st.floats(-5.0, 8.0), st.floats(0.01, 10.0), st.floats(0.001, 2.0))
def test_a_wider_gap_pulls_less_and_a_wetter_film_covers_more(separation, height, more):
    def at(separation, height):
        return laws.greenwood_williamson(separation, 1.0, 30.0, 0.01, 1e4, 0.07, 1.5, height)

    assert at(separation + more, height).force < at(separation, height).force
    assert at(separation, height + more).n_wet >= at(separation, height).n_wet
    assert at(separation, height + more).force >= at(separation, height).force


@given(st.floats(-30.0, 30.0), st.floats(1e-9, 20.0))
def test_the_mean_of_a_tail_lies_between_its_ends(a, width):
    found = laws.mean_tail(a, a + width)
    low, high = laws.normal_tail(a + width), laws.normal_tail(a)
    assert low * (1.0 - 1e-9) <= found <= high * (1.0 + 1e-9)


@settings(max_examples=10)
@given(angles, angles, scales)
def test_condensed_bridges_scale_with_the_kelvin_radius(lower, upper, scale):
    gap, curvature = np.array([0.0, 0.3, 0.6]), np.array([1e-2, 1e-3, 1e-4])
    one = condensed_bridges(gap, -1.0, lower, upper, curvature)
    other = condensed_bridges(scale * gap, -1.0 / scale, lower, upper, curvature / scale)
    assert np.array_equal(np.isfinite(one.force), np.isfinite(other.force))
    stands = np.isfinite(one.force)
    assert other.force[stands] == pytest.approx(scale * one.force[stands], rel=1e-7)
    assert other.volume[stands] == pytest.approx(scale**3 * one.volume[stands], rel=1e-7)


def divided(scale, lower, upper):
    water = ck.Liquid(name="water", surface_tension=0.07, viscosity=1e-3)
    film = ck.Meniscus(
        liquid=water, volume=1e-15 * scale**3, contact_angle_lower=lower, contact_angle_upper=upper
    )
    return ck.SeparationScene(
        interface=ck.Interface(meniscus=film),
        loading=ck.ImposedTime(initial_gap=1e-6 * scale, final_gap=1.0 * scale, time=1e-3 * scale),
        effects=(ck.MeniscusForce(), ck.ViscousForce()),
    )


@settings(max_examples=8)
@given(angles, angles, scales)
def test_a_division_scales_with_lengths_and_times(lower, upper, scale):
    """With the time scaled too both forces grow as the length, so the best number stays."""
    one = divide_meniscus(divided(1.0, lower, upper), [1, 3, 9], law="exact")
    other = divide_meniscus(divided(scale, lower, upper), [1, 3, 9], law="exact")
    assert other.total_force == pytest.approx(scale * one.total_force, rel=1e-8)
    assert abs(other.best_count - one.best_count) <= 1
    assert abs(other.max_stable_count - one.max_stable_count) <= 1


@pytest.mark.parametrize(("angle", "sign"), [(30.0, 1), (80.0, 1), (120.0, -1), (160.0, -1)])
def test_division_raises_attraction_and_lowers_repulsion(angle, sign):
    """The number makes the force more attractive, whatever its sign (Table 3.2, qualified)."""
    wide = divided(1.0, math.radians(angle), math.radians(angle))
    found = divide_meniscus(wide, [1, 4, 16, 64], law="exact")
    assert np.all(sign * found.meniscus_force > 0.0)
    assert np.all(np.diff(found.meniscus_force) > 0.0)


@given(st.integers(0, 10_000), st.floats(0.5, 3.0))
def test_islands_keep_the_area_of_their_map(seed, height):
    from contactkit.capillary.film_islands import islands

    gap = np.abs(np.random.default_rng(seed).normal(size=(12, 15)))
    gap[gap < 0.2] = 0.0
    names, n = islands(gap < height, periodic=True)
    found = measure_islands(names, n, gap, gap == 0.0, -gap, 0.25)
    assert found.area.sum() == pytest.approx(0.25 * (gap < height).sum())
    assert found.contact_area.sum() == pytest.approx(0.25 * (gap == 0.0).sum())
    assert np.all((found.gap == 0.0) == (found.contact_area > 0.0))
    curvature = curvature_of_area(found, height)
    room = found.area > found.contact_area
    thin = 2.0 * math.pi * (height - found.gap[room]) / curvature[room]
    assert thin == pytest.approx(found.area[room] - found.contact_area[room])


@given(st.floats(1.0, 1e4), st.floats(1e-9, 1e-3))
def test_the_largest_stable_number_is_the_last_below_the_limit(ratio, gap):
    most = menisci.max_stable_count(gap, ratio * gap)
    assert ratio * (most + 1) ** (-1.0 / 3.0) <= 1.0 + 1e-9
    assert most == 0 or ratio * most ** (-1.0 / 3.0) > 1.0 - 1e-9
