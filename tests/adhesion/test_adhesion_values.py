"""Adhesion of solids against energies, limits, another method, and each other."""

from __future__ import annotations

import json
import math
from itertools import pairwise
from pathlib import Path

import numpy as np
import pytest
from scipy.integrate import quad

import contactkit as ck
from contactkit.adhesion import dmt, jkr, maugis_dugdale, van_der_waals
from contactkit.adhesion import parameters as adhesion_scales
from contactkit.reference import hertz

pytestmark = pytest.mark.filterwarnings("ignore::contactkit.errors.ValidityWarning")

approx = pytest.approx
DATA = json.loads((Path(__file__).parents[1] / "data" / "maugis.json").read_text("utf-8"))
A = 6.5e-20


# van der Waals ------------------------------------------------------------------------------


@pytest.mark.parametrize("gap", [1e-10, 1e-9, 3e-8, 1e-6])
@pytest.mark.parametrize("radii", [(1e-7, 1e-7), (1e-7, 5e-7), (2e-6, 1e-9)])
def test_the_force_of_spheres_is_the_slope_of_their_energy(gap, radii):
    lower, upper = radii
    step = 1e-3 * gap  # 1e-4: the energy of the far pair, 500 R, has too few digits, 1.2e-6
    one, two, three, four = (
        van_der_waals.energy_between_spheres(gap + k * step, A, lower, upper)
        for k in (-2, -1, 1, 2)
    )
    slope = (8.0 * (three - two) - (four - one)) / (12.0 * step)
    found = van_der_waals.hamaker_sphere_force(gap, A, 1.0 / lower, 1.0 / upper)
    assert found == approx(slope, 1e-6)


@pytest.mark.parametrize("gap", [1e-9, 1e-7, 1e-5])
def test_a_sphere_on_a_half_space_is_a_pile_of_discs(gap):
    """Each slice of the sphere is pulled by A/(2 pi z^4) per volume."""
    radius = 1e-7

    def slice_of_it(angle):
        height = radius * (1.0 - math.cos(angle))
        area = math.pi * (radius * math.sin(angle)) ** 2
        return A / (2.0 * math.pi * (gap + height) ** 4) * area * radius * math.sin(angle)

    depth = math.sqrt(gap / radius)
    ends = (0.0, min(depth, 1.0), math.pi)
    summed = sum(
        quad(slice_of_it, *part, epsabs=0.0, epsrel=1e-11, limit=200)[0] for part in pairwise(ends)
    )
    assert van_der_waals.hamaker_sphere_force(gap, A, 0.0, 1.0 / radius) == approx(summed, 1e-9)


def test_derjaguins_force_is_off_by_the_ratio_of_gap_and_radius():
    for fraction in (1e-6, 1e-3, 1e-2):
        near = van_der_waals.sphere_force(fraction, A, 1.0)
        whole = van_der_waals.hamaker_sphere_force(fraction, A, 0.0, 1.0)
        assert near / whole == approx((1.0 + 0.5 * fraction) ** 2, 1e-12)


def test_the_pressure_between_flats_is_the_slope_of_their_energy():
    low, high = (van_der_waals.energy_between_flats(1e-9 * x, A) for x in (0.99999, 1.00001))
    slope = (high - low) / 2e-14
    assert van_der_waals.pressure_between_flats(1e-9, A) == approx(slope, 1e-9)


def test_touching_spheres_pull_with_the_work_of_adhesion():
    """A R/(6 D0^2) is 2 pi R w of the same cut-off."""
    work = van_der_waals.work_of_hamaker(A, 0.165e-9)
    assert van_der_waals.sphere_force(0.165e-9, A, 1e6) == approx(2e-6 * math.pi * work, 1e-14)
    assert van_der_waals.hamaker_of_work(work, 0.165e-9) == approx(A, 1e-14)


# Maugis-Dugdale -----------------------------------------------------------------------------


@pytest.mark.parametrize(("transition", "a", "c", "load", "approach"), DATA["states"])
def test_no_digit_is_lost_from_dmt_to_jkr(transition, a, c, load, approach):
    """Against his printed equations with 50 digits; the load is a difference of two terms."""
    found = maugis_dugdale.at_radius(a, transition)
    assert found.cohesive_radius == approx(c, 1e-13)
    assert found.approach == approx(approach, rel=1e-13, abs=1e-14 * a * a)
    assert found.load == approx(load, rel=1e-13, abs=1e-14 * a**3)


@pytest.mark.parametrize("transition", [3e2, 1e3, 1e4])
def test_a_sharp_adhesion_is_that_of_jkr(transition):
    off = 3.0 / transition**1.5  # the ring is of the width 1/lambda
    bounds = maugis_dugdale.limits(transition)
    assert -bounds.pull_off.load == approx(jkr.PULL_OFF_FORCE, off)
    assert -bounds.release.load == approx(jkr.LAST_FORCE, off)
    assert -bounds.release.approach == approx(jkr.LAST_GAP, off)
    assert bounds.release.contact_radius == approx(jkr.LAST_RADIUS, 10.0 / transition)
    for gap in (-3.0, 0.0, 0.5, 0.85):
        found = maugis_dugdale.at_gap(gap, transition, bounds)
        assert found.contact_radius == approx(jkr.radius_at_gap(gap), 3.0 / transition)
        assert found.load == approx(jkr.load(jkr.radius_at_gap(gap)), abs=3.0 / transition)


@pytest.mark.parametrize("transition", [1e-3, 1e-5])
def test_a_far_adhesion_is_that_of_dmt(transition):
    bounds = maugis_dugdale.limits(transition)
    assert -bounds.pull_off.load == approx(dmt.PULL_OFF_FORCE, abs=0.1 * transition)
    assert -bounds.release.approach == approx(dmt.reach(transition), transition)
    for fraction in (0.01, 0.5, 0.99):
        gap = fraction * dmt.reach(transition)
        found = maugis_dugdale.at_gap(gap, transition, bounds)
        assert -found.load == approx(dmt.force_before_touch(gap, transition), 3.0 * transition)
    assert maugis_dugdale.at_load(6.0, transition, bounds).contact_radius == approx(2.0, transition)


def energy_of_jkr(approach):
    """Energy in units of load times approach; zero where the bodies are apart."""
    a = jkr.radius_at_gap(-approach)
    return 0.4 * a**5 - (2.0 + 1.0 / 3.0) * math.sqrt(6.0) / 3.5 * a**3.5 + a * a


def work_to(a_end, transition):
    """Work of the load from where the attraction sets in, along all states, to a wide contact."""
    b, c = 8.0 * transition / (3.0 * math.pi), maugis_dugdale.at_radius(0.0, transition)[1]
    apart = -0.5 * math.pi * transition * (c**4 / 4.0 - b * c**3 / 3.0)

    def power(a):
        step = 1e-5 * max(a, 0.1)
        low = max(a - step, 0.0)
        near, far = (maugis_dugdale.at_radius(x, transition).approach for x in (low, a + step))
        return maugis_dugdale.at_radius(a, transition).load * (far - near) / (a + step - low)

    marks = [0.0, 0.1, 1.0, 3.0, *([10.0] if a_end == 10.0 else [])]
    parts = [quad(power, *ends, epsrel=1e-10, limit=200)[0] for ends in pairwise(marks)]
    return apart + sum(parts)


@pytest.mark.parametrize("transition", [0.5, 1.0, 5.0, 20.0])
def test_the_work_of_closing_is_the_energy_of_jkr(transition):
    """No energy is lost on the way: w stands in the equations only through the ring.

    Whatever the ring, a wide contact has the energy of JKR, of which w pi a^2 is a fraction; what
    is left out is of the width of the ring.
    """
    off = []
    for a in (3.0, 10.0):
        found = maugis_dugdale.at_radius(a, transition)
        off.append((work_to(a, transition) - energy_of_jkr(found.approach)) / a**2)
    assert abs(off[1]) < 0.3 * abs(off[0])
    assert abs(off[1]) < 0.02 / transition


def test_the_work_of_closing_sees_a_wrong_work_of_adhesion():
    """The control: one per cent of w more, and the test above fails."""
    found = maugis_dugdale.at_radius(10.0, 20.0)
    wrong = energy_of_jkr(found.approach) - 0.01 * 10.0**2
    assert abs(work_to(10.0, 20.0) - wrong) / 10.0**2 > 0.009


@pytest.mark.parametrize(
    ("transition", "pull_off"), [(0.1, 1.95), (0.5, 1.72), (1.0, 1.60), (2.0, 1.535), (5.0, 1.505)]
)
def test_the_pull_off_lies_on_the_fit_of_carpick(transition, pull_off):
    """Carpick, Ogletree and Salmeron 1999: -7/4 + (4.04 l^1.4 - 1)/(4 (4.04 l^1.4 + 1))."""
    power = 4.04 * transition**1.4
    fit = 1.75 - 0.25 * (power - 1.0) / (power + 1.0)
    found = -maugis_dugdale.limits(transition).pull_off.load
    assert found == approx(fit, 0.015)
    assert found == approx(pull_off, 0.005)


@pytest.mark.parametrize("transition", [0.2, 0.7, 0.93, 0.94, 2.0])
def test_the_limits_are_the_ends_of_the_branch(transition):
    """Of the largest pull and the largest gap of many states, whatever the equations say."""
    bounds = maugis_dugdale.limits(transition)
    states = [maugis_dugdale.at_radius(a, transition) for a in np.linspace(0.0, 2.0, 4001)]
    assert bounds.pull_off.load == approx(min(s.load for s in states), 1e-6)
    assert bounds.pull_off.load <= min(s.load for s in states) + 1e-13
    if transition > maugis_dugdale.PARTS_BEFORE_RELEASE:
        assert bounds.release.approach == approx(min(s.approach for s in states), 1e-6)
    else:
        assert bounds.touch.approach == approx(min(s.approach for s in states), 1e-12)
        assert bounds.release.approach < bounds.touch.approach


def test_the_branches_meet_where_the_bodies_touch():
    for transition in (0.05, 0.5, 0.9):
        bounds = maugis_dugdale.limits(transition)
        gap = -bounds.touch.approach
        below, above = (
            maugis_dugdale.at_gap(gap * (1.0 + x), transition, bounds).load for x in (-1e-12, 1e-12)
        )
        assert below == approx(above, 1e-8)
        assert below == approx(bounds.touch.load, 1e-8)


# JKR, DMT and Hertz -------------------------------------------------------------------------


def test_jkr_is_least_energy():
    """Elastic energy of load and flat punch less w pi a^2, least at the radius it gives."""

    def energy(a, approach):  # in Maugis' units, K = 1: U = int P d(delta) at fixed a - surface
        wasted = approach - a * a  # a flat punch pulls back by it
        elastic = (0.6 * a**5 + a**3 * wasted + 0.75 * a * wasted**2) - a**5 / 5.0
        return elastic - a * a  # pi w R times the unit of approach is pi w a^2

    for approach in (-0.7, 0.0, 1.0, 4.0):
        a = jkr.radius_at_gap(-approach)
        step = 1e-4
        slope = (energy(a + step, approach) - energy(a - step, approach)) / (2.0 * step)
        assert slope == approx(0.0, abs=1e-6)


def test_adhesion_that_vanishes_leaves_hertz():
    film = ck.Meniscus(liquid=ck.Liquid(name="air"))
    body = ck.Interface(upper=ck.Sphere(radius=1e-3), meniscus=film)
    loading = ck.ImposedSpeed(initial_gap=1e-30, final_gap=1e-6, speed=1e-6)
    expected = hertz.sphere(1e-3, 1e-3, 1e9)
    for model in ("jkr", "dmt", "maugis-dugdale"):
        faint = ck.AdhesiveContact(model=model, work_of_adhesion=1e-16, reduced_modulus=1e9)
        scene = ck.SeparationScene(interface=body, loading=loading, effects=(faint,))
        found = ck.adhesion_curve(scene, [1e-3])
        assert found.contact_radius[0] == approx(expected.contact_radius, 1e-6)
        assert found.approach[0] == approx(expected.approach, 1e-6)


def test_the_parameters_of_the_transition():
    work, radius, modulus, distance = 0.05, 10e-6, 50e9, 0.165e-9
    tabor = adhesion_scales.tabor_parameter(radius, work, modulus, distance)
    stress = adhesion_scales.cohesive_stress(work, distance)
    found = adhesion_scales.transition_parameter(radius, work, modulus, stress)
    assert found / tabor == approx(adhesion_scales.TRANSITION_OVER_TABOR, 1e-14)
    assert found / tabor == approx(1.16, 0.005)
    depths = np.linspace(0.5, 3.0, 100_001) * distance  # Lennard-Jones between surfaces
    pull = 8.0 * work / (3.0 * distance) * ((distance / depths) ** 3 - (distance / depths) ** 9)
    assert pull.max() == approx(stress, 1e-8)


def test_the_stress_reaches_as_far_as_the_work_asks():
    """w = sigma_0 h_0, whatever the radius and the modulus."""
    for radius, work, modulus, stress in ((1e-6, 0.05, 1e9, 1e8), (1e-3, 0.5, 1e5, 1e3)):
        transition = adhesion_scales.transition_parameter(radius, work, modulus, stress)
        units = adhesion_scales.scales(radius, work, modulus)
        assert dmt.reach(transition) * units.approach * stress == approx(work, 1e-13)
