"""Viscous films against what textbooks and papers print: Stefan, Reynolds, Brenner, Goldman."""

from __future__ import annotations

import math

import numpy as np
import pytest

import contactkit as ck
from contactkit.lubrication import squeeze_film as squeeze
from contactkit.lubrication.couette_reynolds import lubrication_factor
from contactkit.reference import viscous_films as films
from contactkit.reference.reynolds import film_force

ETA, RADIUS, GAP, SPEED = 0.1, 1e-3, 1e-6, 1e-4


def flooded_disc(loading):
    oil = ck.Liquid(name="oil", viscosity=ETA, surface_tension=0.03)
    face = ck.Flat(radius=RADIUS)
    return ck.SeparationScene(
        interface=ck.Interface(lower=face, upper=face, meniscus=ck.Meniscus(liquid=oil)),
        loading=loading,
        effects=(ck.ViscousForce(),),
    )


def test_a_flooded_disc_resists_as_stefan_says():
    found = float(squeeze.disc_force(RADIUS, GAP, SPEED, ETA))
    assert found == pytest.approx(films.stefan_force(ETA, RADIUS, GAP, SPEED), rel=1e-14)


def test_a_constant_force_takes_the_time_of_stefan():
    """The whole way through a scene: 1 N draws a face of little mass off."""
    end, mass = 1e-4, 1e-9
    loading = ck.ImposedForce(initial_gap=GAP, final_gap=end, force=1.0, mass=mass)
    found = ck.simulate(ck.plan(flooded_disc(loading)))
    expected = films.stefan_time(ETA, RADIUS, GAP, end, 1.0)
    speed = 1.0 / films.stefan_force(ETA, RADIUS, end, 1.0)  # at the end, where it is highest
    assert mass * speed / 1.0 < 1e-7 * expected  # the time in which 1 N gives the mass that speed
    assert float(found.time[-1]) == pytest.approx(expected, rel=1e-6)


@pytest.mark.parametrize("ratio", [1e-4, 1e-3, 1e-2, 0.1])
def test_a_flooded_sphere_resists_as_reynolds_says(ratio):
    gap = ratio * RADIUS
    found = float(squeeze.sphere_force(RADIUS, gap, math.inf, SPEED, ETA))
    assert found == pytest.approx(films.reynolds_sphere_force(ETA, RADIUS, gap, SPEED), rel=1e-14)


@pytest.mark.parametrize(
    ("ratio", "missing"), [(1e-4, 2.8e-4), (1e-3, 2.35e-3), (1e-2, 0.0186), (0.1, 0.1273)]
)
def test_what_reynolds_equation_lacks_of_brenner(ratio, missing):
    """The exact flow around a flooded sphere: the narrower the gap, the better the theory."""
    gap = ratio * RADIUS
    found = float(squeeze.sphere_force(RADIUS, gap, math.inf, SPEED, ETA))
    exact = 6.0 * math.pi * ETA * RADIUS * SPEED * films.brenner_factor(ratio)
    assert 1.0 - found / exact == pytest.approx(missing, rel=0.02)


def test_brenner_close_to_the_wall():
    """R/D - (1/5) ln(D/R) + 0.9712, as other programs have it, less than D/R ln(R/D) apart."""
    for ratio in (1e-2, 1e-3, 1e-4, 1e-5):
        rest = films.brenner_factor(ratio) - 1.0 / ratio + 0.2 * math.log(ratio)
        assert rest == pytest.approx(0.9712, abs=1e-4 + ratio * abs(math.log(ratio)))


def test_brenner_far_from_the_wall():
    """Faxen's series for motion normal to a wall, 1/(1 - 9/8 k + 1/2 k^3), k = R/(R + D)."""
    for ratio in (9.0, 99.0, 999.0):
        k = 1.0 / (1.0 + ratio)
        series = 1.0 / (1.0 - 1.125 * k + 0.5 * k**3)
        assert films.brenner_factor(ratio) == pytest.approx(series, abs=2.0 * k**4)


@pytest.mark.parametrize("m", [3.0, 31.0, 301.0])
def test_both_forms_of_brenners_terms_agree(m):
    alpha = 0.1 / m
    near, far = (
        films._bracket(m, x * alpha, math.sinh(x * alpha)) for x in (1.0 - 1e-12, 1.0 + 1e-12)
    )
    assert near == pytest.approx(far, rel=1e-9)


def test_a_sliding_sphere_has_the_slope_of_goldman():
    """Six pi times 8/15 is 2 pi times 8/5; the constants differ, a round film is no bath."""
    gaps = np.array([1e-4, 1e-6])
    found = 2.0 * math.pi * lubrication_factor(gaps, 1.0)
    flooded = 6.0 * math.pi * np.array([films.goldman_factor(gap) for gap in gaps])
    assert found[1] - found[0] == pytest.approx(flooded[1] - flooded[0], rel=1e-3)
    assert np.all(found < flooded)


def test_a_narrow_film_resists_as_the_numerical_solution():
    """Reynolds' equation of a round film under a sphere by finite volumes, with its rim."""
    sphere, gap, rim = 1e-2, 1e-5, 2e-4
    found = film_force(lambda r: gap + r * r / (2.0 * sphere), rim, SPEED, ETA)
    height = gap + rim * rim / (2.0 * sphere)
    assert found == pytest.approx(
        float(squeeze.sphere_force(sphere, gap, height, SPEED, ETA)), rel=1e-4
    )


@pytest.mark.parametrize(
    ("function", "given", "names"),
    [
        (films.stefan_force, (0.1, -1.0, 1e-6, 1.0), "radius = -1.0"),
        (films.stefan_time, (0.1, 1.0, 1e-6, 1e-5, -1.0), "force = -1.0 N"),
        (films.reynolds_sphere_force, (0.1, 1.0, 0.0, 1.0), "gap = 0.0"),
        (films.brenner_factor, (0.0,), "gap_ratio = 0.0"),
        (films.goldman_factor, (2.0,), "gap_ratio = 2.0"),
    ],
)
def test_what_is_not_physical_is_refused(function, given, names):
    with pytest.raises(ValueError, match=names):
        function(*given)
