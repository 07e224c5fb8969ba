"""Adhesion where numbers get hard, and in motions with rupture, pull-off and re-contact."""

from __future__ import annotations

import math

import attrs
import loadings
import numpy as np
import pytest
from selection import quick

import contactkit as ck
from contactkit.adhesion import jkr, maugis_dugdale
from contactkit.separation.simulate import simulate

pytestmark = [
    pytest.mark.hard,
    pytest.mark.filterwarnings("ignore::contactkit.errors.ValidityWarning"),
]

approx = pytest.approx
WATER = ck.Liquid(name="water", viscosity=1e-3, surface_tension=0.072, density=998.0)
TIP = ck.Sphere(radius=1e-6)
SOFT = ck.AdhesiveContact(work_of_adhesion=0.05, reduced_modulus=1e8)
PLATE = ck.VanDerWaalsForce(hamaker_constant=6e-20)


def scene(*effects, gap=1e-10, final=30e-9, lower=None, volume=1e-23, **loading):
    film = ck.Meniscus(liquid=WATER, volume=volume)
    return ck.SeparationScene(
        interface=ck.Interface(lower=lower or ck.Flat(), upper=TIP, meniscus=film),
        loading=loadings.imposed(initial_gap=gap, final_gap=final, **loading),
        effects=effects,
    )


def run(*effects, **given):
    return simulate(ck.plan(scene(*effects, **given)))


# Kernels ------------------------------------------------------------------------------------


@pytest.mark.parametrize("transition", [1e-6, 1e-3, 0.5, 0.938, 0.9381, 3.0, 1e3, 1e6, 1e9])
def test_every_gap_on_the_branch_has_a_state_and_no_other(transition):
    bounds = maugis_dugdale.limits(transition)
    end = -bounds.release.approach
    gaps = end * np.concatenate([-np.geomspace(1e-3, 1e6, 10), [0.0], 1 - np.geomspace(1, 1e-15)])
    last = math.inf
    for gap in np.sort(gaps):
        state = maugis_dugdale.at_gap(float(gap), transition, bounds)
        assert state.approach == approx(-gap, rel=1e-12, abs=1e-12 * end)
        assert math.isfinite(state.load)
        radius = state.cohesive_radius
        assert radius <= last * (1.0 + 1e-12)  # it only shrinks as the gap opens
        last = radius
    assert maugis_dugdale.at_gap(1.001 * end, transition, bounds) == bounds.release


@pytest.mark.parametrize("a", [0.0, 1e-12, 1e-6, 1.0, 1e3, 1e6])
@pytest.mark.parametrize("transition", [1e-9, 1e-3, 1.0, 1e6])
def test_a_radius_of_any_size_has_its_ring(a, transition):
    found = maugis_dugdale.at_radius(a, transition)
    assert all(math.isfinite(x) for x in found)
    assert found.cohesive_radius >= a
    assert found.load < a**3


def test_jkr_to_the_last_gap():
    for fraction in (1e-15, 1e-9, 1e-3, 0.5, 1.0):
        gap = jkr.LAST_GAP * (1.0 - fraction)
        a = jkr.radius_at_gap(gap)
        assert a >= jkr.LAST_RADIUS
        assert -jkr.approach(a) == approx(gap, 1e-14)
    assert jkr.radius_at_gap(2.0 * jkr.LAST_GAP) == jkr.LAST_RADIUS
    assert jkr.radius_at_gap(-1e12) == approx(1e6, 1e-6)


def test_a_heavy_load_of_a_ratio_of_1e12_is_found_again():
    for transition in (1e-3, 1.0, 1e3):
        bounds = maugis_dugdale.limits(transition)
        for load in (1e-6, 1e6, 1e12):
            found = maugis_dugdale.at_load(load, transition, bounds)
            assert found.load == approx(load, rel=1e-12, abs=1e-12)


# Curves -------------------------------------------------------------------------------------


def test_the_force_is_gone_beyond_the_release_and_not_before():
    result = run(SOFT, speed=1e-6)
    numbers = result.of(ck.AdhesiveContact).numbers
    held = result.gap <= numbers.release_gap
    assert numbers.release_gap in result.gap
    assert (result["adhesion_force"][held] >= numbers.release_force * (1.0 - 1e-9)).all()
    assert (result["adhesion_force"][~held] == 0.0).all()
    assert 0 < held.sum() < held.size


def test_the_impulse_at_a_speed_is_the_integral_to_the_release():
    result = run(ck.MeniscusForce(), SOFT, speed=1e-6)
    fine = np.linspace(1e-10, result.of(ck.AdhesiveContact).numbers.release_gap, 2_001)
    force = ck.plan(scene(SOFT, speed=1e-6)).film.laws[ck.AdhesiveContact].force
    expected = np.trapezoid([force(float(gap), 0.0) for gap in fine], fine) / 1e-6
    assert result.impulses["adhesion_impulse"] == approx(expected, 1e-4)
    alone = run(ck.MeniscusForce(), speed=1e-6)
    assert result.impulses["meniscus_impulse"] == approx(alone.impulses["meniscus_impulse"], 1e-9)
    assert result.pull == approx(result["meniscus_force"] + result["adhesion_force"], 1e-13)


def test_the_solids_go_on_attracting_where_the_film_has_broken():
    film = (ck.MeniscusForce(), ck.ViscousForce(), ck.Rupture(gap=5e-9))
    result = run(*film, PLATE, gap=2e-10, speed=1e-6)
    broken = result.gap > 5e-9
    assert (result["film_status"][broken] == ck.FilmStatus.BROKEN).all()
    for name in ("meniscus_force", "viscous_force", "newtonian_force"):
        assert (result[name][broken] == 0.0).all()
        assert (result[name][~broken] > 0.0).all()
    assert result["van_der_waals_force"] == approx(6e-20 * 1e-6 / 6.0 / result.gap**2, 1e-12)
    without = run(*film, gap=2e-10, speed=1e-6)
    assert without.gap[-1] == 5e-9
    for name in ("meniscus_impulse", "viscous_impulse", "newtonian_impulse"):
        assert result.impulses[name] == approx(without.impulses[name], 1e-9)


def test_below_the_cutoff_the_force_grows_no_further():
    result = run(PLATE, gap=0.0, speed=1e-6)
    assert result["van_der_waals_force"][0] == approx(6e-20 * 1e-6 / 6.0 / 0.165e-9**2, 1e-13)
    inside = result.gap <= 0.165e-9
    assert (result["van_der_waals_force"][inside] == result["van_der_waals_force"][0]).all()


# Motions ------------------------------------------------------------------------------------

SETS = {
    "sticky": (SOFT,),
    "wet and sticky": (ck.MeniscusForce(), ck.ViscousForce(), SOFT, ck.Rupture(gap=5e-9)),
    "stiff": (ck.MeniscusForce(), ck.AdhesiveContact(work_of_adhesion=0.05, reduced_modulus=5e10)),
    "jkr": (ck.AdhesiveContact(model="jkr", work_of_adhesion=0.05, reduced_modulus=1e8),),
    "dmt": (ck.AdhesiveContact(model="dmt", work_of_adhesion=0.05, reduced_modulus=5e10),),
    "van der waals": (ck.MeniscusForce(), ck.ViscousForce(), PLATE, ck.Rupture(gap=5e-9)),
}


@pytest.mark.parametrize("name", SETS)
def test_momentum_is_what_the_pull_gives_less_each_impulse(name):
    result = run(*SETS[name], force=2e-6, mass=1e-12)
    assert result.status == "released"
    state = result.state
    taken = sum(value for key, value in result.impulses.items() if key != "newtonian_impulse")
    assert 1e-12 * state.speed == approx(2e-6 * state.release_time - taken, 1e-6)


@pytest.mark.parametrize("name", quick(SETS, 0, 2, 5))
def test_energy_is_the_work_of_each_force(name):
    result = run(*SETS[name], force=2e-6, mass=1e-12)
    travel = 30e-9 - 1e-10
    taken = result.state.dissipated_work
    film = ck.plan(scene(*SETS[name], speed=1e-6))
    for key, impulse in simulate(film).impulses.items():
        if key not in ("newtonian_impulse", "viscous_impulse"):
            taken += 1e-6 * impulse  # at a speed the impulse is the work over it
    kinetic = 0.5 * 1e-12 * result.state.release_speed**2
    assert kinetic == approx(2e-6 * travel - taken, 1e-6)


def test_a_contact_that_was_pulled_off_is_there_again_when_the_gap_has_closed():
    """A spring pulls the tip back; JKR catches again where it began, not on the way."""
    jkr_tip = SETS["jkr"][0]
    made = ck.plan(
        scene(
            jkr_tip,
            final=1e-7,
            force=1e-9,
            mass=1e-12,
            stiffness=40.0,
            initial_speed=0.45,
            rest_gap=1e-10,
        )
    )
    release = jkr_tip.numbers(made.prepared).release_gap
    state, seen = ck.advance(made, start(made), lambda t: 1e-9, 0.0), []
    for _ in range(800):
        state = ck.advance(made, state, lambda t: 1e-9, 1e-9)
        seen.append((state.gap, state.detached))
        if state.gap < release and seen[-2:-1] and seen[-2][1] and not state.detached:
            break
    gaps = np.array([gap for gap, _ in seen])
    flags = np.array([flag for _, flag in seen])
    assert flags.any()
    assert not flags[0]
    assert not flags[-1]  # caught again
    falling = np.flatnonzero(flags)
    assert gaps[falling].min() < release  # on closing it is not there yet


def start(made):
    return ck.MotionState(0.0, made.scene.loading.initial_gap, made.scene.loading.initial_speed)


def test_a_weak_pull_is_held_by_the_solids_and_is_reported():
    result = run(ck.MeniscusForce(), SOFT, force=1e-9, mass=1e-12)
    assert result.status == "stuck"
    assert "of the meniscus force and adhesion of the solids at" in result.message


def test_steps_of_any_length_lead_to_the_same_state():
    made = ck.plan(scene(*SETS["wet and sticky"], force=2e-6, mass=1e-12))
    one = ck.advance(made, start(made), lambda t: 2e-6, 2.5e-7)
    many = start(made)
    for _ in range(10):
        many = ck.advance(made, many, lambda t: 2e-6, 2.5e-8)
    assert one.detached
    assert many.detached
    assert many.gap == approx(one.gap, 1e-6)
    assert many.impulses["adhesion_impulse"] == approx(one.impulses["adhesion_impulse"], 1e-6)


def test_flats_attract_by_their_face():
    face = ck.Flat(radius=1e-6)
    made = ck.plan(
        attrs.evolve(
            scene(PLATE, gap=1e-9, speed=1e-6),
            interface=ck.Interface(lower=face, upper=face, meniscus=ck.Meniscus(liquid=WATER)),
        )
    )
    expected = 6e-20 / (6.0 * math.pi * 1e-27) * math.pi * 1e-12
    assert simulate(made)["van_der_waals_force"][0] == approx(expected, 1e-13)
