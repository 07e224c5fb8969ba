"""What adhesion keeps whatever the numbers: its units, its order between JKR and DMT, its files."""

from __future__ import annotations

import math

import attrs
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

import contactkit as ck
from contactkit.adhesion import dmt, jkr, maugis_dugdale, van_der_waals
from contactkit.files.scenes import structure, unstructure
from contactkit.kinds import SEPARATION_EFFECTS
from contactkit.separation.effects.base import SeparationForce
from contactkit.separation.effects.prepared import prepare_scene
from contactkit.separation.simulate import simulate

pytestmark = pytest.mark.filterwarnings("ignore::contactkit.errors.ValidityWarning")

approx = pytest.approx
AIR = ck.Liquid(name="air")
transitions = st.floats(-3.0, 3.0).map(lambda x: 10.0**x)
factors = st.floats(-3.0, 3.0).map(lambda x: 10.0**x)
models = st.sampled_from(["jkr", "dmt", "maugis-dugdale"])


def sticky(model="maugis-dugdale", length=1.0, stress=1.0, count=1, **more):
    """A contact; scaled, all its lengths and all its stresses."""
    effect = ck.AdhesiveContact(
        model=model,
        work_of_adhesion=0.05 * length * stress,
        reduced_modulus=1e9 * stress,
        equilibrium_distance=0.165e-9 * length,
        **more,
    )
    return ck.SeparationScene(
        interface=ck.Interface(
            upper=ck.Sphere(radius=1e-6 * length), meniscus=ck.Meniscus(liquid=AIR, count=count)
        ),
        loading=ck.ImposedSpeed(initial_gap=1e-11 * length, final_gap=1e-8 * length, speed=1e-6),
        effects=(effect,),
    )


@given(models, factors, factors)
def test_lengths_and_stresses_scale(model, length, stress):
    one, other = sticky(model), sticky(model, length, stress)
    a, b = (scene.effects[0].numbers(prepare_scene(scene)) for scene in (one, other))
    assert b.pull_off_force == approx(a.pull_off_force * length**2 * stress, 1e-12)
    assert b.release_gap == approx(a.release_gap * length, 1e-11)
    assert b.tabor_parameter == approx(a.tabor_parameter, 1e-12)
    assert b.transition_parameter == approx(a.transition_parameter, 1e-12)
    there = ck.plan(sticky(model, length, stress)).film.static_force(0.4 * b.release_gap)
    here = ck.plan(sticky(model)).film.static_force(0.4 * a.release_gap)
    assert there == approx(here * length**2 * stress, 1e-9)


@given(transitions)
def test_the_pull_off_lies_between_jkr_and_dmt(transition):
    bounds = maugis_dugdale.limits(transition)
    assert jkr.PULL_OFF_FORCE <= -bounds.pull_off.load <= dmt.PULL_OFF_FORCE
    assert bounds.pull_off.approach >= bounds.release.approach
    assert -bounds.release.approach >= dmt.reach(transition)
    wider = maugis_dugdale.limits(1.1 * transition)
    assert wider.pull_off.load >= bounds.pull_off.load


@given(transitions, st.floats(0.0, 0.999))
def test_the_pull_on_the_branch_never_exceeds_the_pull_off(transition, fraction):
    bounds = maugis_dugdale.limits(transition)
    start, end = -bounds.pull_off.approach, -bounds.release.approach
    gap = start + fraction * (end - start)
    found = maugis_dugdale.at_gap(gap, transition, bounds)
    further = maugis_dugdale.at_gap(gap + 1e-3 * (end - gap), transition, bounds)
    assert bounds.pull_off.load <= found.load + 1e-12 <= further.load + 1e-9


@given(transitions, st.floats(-1.4, 100.0))
def test_a_contact_under_a_load_lies_between_dmt_and_jkr(transition, load):
    found = maugis_dugdale.at_load(load, transition, maugis_dugdale.limits(transition))
    if found.load == approx(load, abs=1e-9):
        off = 1e-9
        assert dmt.radius_at_load(load) - off <= found.contact_radius
        assert found.contact_radius <= jkr.radius_at_load(load) + off


@given(models, st.lists(st.floats(-0.7, 50.0), min_size=2, max_size=6, unique=True))
def test_load_and_approach_rise_with_the_contact_radius(model, fractions):
    scene = sticky(model)
    force = scene.effects[0].numbers(prepare_scene(scene)).pull_off_force
    found = ck.adhesion_curve(scene, np.sort(fractions) * force)
    assert (np.diff(found.contact_radius) >= 0.0).all()
    assert (np.diff(found.approach) >= 0.0).all()
    assert (found.cohesive_radius >= found.contact_radius).all()
    assert not found.load.flags.writeable


@given(st.integers(1, 50))
def test_each_meniscus_has_a_sphere_of_its_own(count):
    for effects in ((ck.VanDerWaalsForce(hamaker_constant=1e-19),), sticky().effects):
        one, many = (
            ck.plan(attrs.evolve(sticky(count=n), effects=effects)).film for n in (1, count)
        )
        assert many.static_force(5e-11) == approx(count * one.static_force(5e-11), 1e-13)
        assert many.release == one.release


@given(factors, factors, factors)
def test_the_force_of_spheres_does_not_mind_which_is_the_lower(gap, lower, upper):
    one = van_der_waals.hamaker_sphere_force(gap, 1.0, lower, upper)
    assert van_der_waals.hamaker_sphere_force(gap, 1.0, upper, lower) == approx(one, 1e-13)
    assert one <= van_der_waals.sphere_force(gap, 1.0, lower + upper) * (1.0 + 1e-12)
    assert van_der_waals.hamaker_sphere_force(np.array([gap]), 1.0, lower, upper) == approx(
        one, 1e-14
    )


@pytest.mark.parametrize("wet", [True, False])
@pytest.mark.parametrize("model", ["jkr", "dmt", "maugis-dugdale"])
def test_a_scene_with_adhesion_survives_its_file(model, wet):
    work = "capillary" if wet else 0.05
    scene = attrs.evolve(
        sticky(),
        effects=(
            ck.AdhesiveContact(
                model=model, work_of_adhesion=work, reduced_modulus=1e9, strength=1e7
            ),
            ck.VanDerWaalsForce(hamaker_constant=1e-19, closure="hamaker"),
        ),
    )
    assert structure(unstructure(scene), ck.SeparationScene, "scene") == scene


def test_a_result_with_adhesion_survives_its_file(tmp_path):
    scene = attrs.evolve(
        sticky(), loading=ck.ImposedForce(initial_gap=1e-11, final_gap=1e-8, force=1e-6, mass=1e-12)
    )
    result = simulate(ck.plan(scene))
    again = ck.load_result(ck.save_result(result, tmp_path / "sticky"))
    assert again.state == result.state
    assert again.scalars() == result.scalars()
    assert (again["adhesion_force"] == result["adhesion_force"]).all()
    assert again.of(ck.AdhesiveContact).numbers == result.of(ck.AdhesiveContact).numbers


# The capillary work of adhesion -------------------------------------------------------------


def wet(pressure, model="maugis-dugdale", modulus=1e9, angle=0.5, gap=1e-12):
    water = ck.Liquid(name="water", surface_tension=0.072)
    film = ck.Meniscus(
        liquid=water, pressure=pressure, contact_angle_lower=angle, contact_angle_upper=angle
    )
    effect = ck.AdhesiveContact(model=model, work_of_adhesion="capillary", reduced_modulus=modulus)
    return ck.SeparationScene(
        interface=ck.Interface(upper=ck.Sphere(radius=1e-6), meniscus=film),
        loading=ck.ImposedSpeed(initial_gap=gap, final_gap=1e-6, speed=1e-6),
        effects=(effect,),
    )


@given(st.floats(5.0, 8.5).map(lambda x: -(10.0**x)), st.floats(0.0, 1.4))
def test_the_liquid_between_stiff_bodies_pulls_as_its_meniscus(pressure, angle):
    """2 pi R gamma (c1 + c2) (1 - D |p|/(gamma (c1 + c2))): the small meniscus of a pressure."""
    scene = wet(pressure, modulus=1e16, angle=angle)
    height = 2.0 * 0.072 * math.cos(angle) / -pressure
    for fraction in (0.01, 0.5, 0.9):
        expected = 2.0 * math.pi * 1e-6 * 2.0 * 0.072 * math.cos(angle) * (1.0 - fraction)
        found = ck.plan(scene).film.static_force(fraction * height)
        assert found == approx(expected, 0.01)


def test_a_deformable_body_is_pulled_by_the_liquid_between_the_limits():
    for pressure in (-1e5, -1e7, -1e9):
        scene = wet(pressure, modulus=1e7)
        numbers = scene.effects[0].numbers(prepare_scene(scene))
        assert numbers.strength == -pressure
        unit = math.pi * 1e-6 * numbers.work_of_adhesion
        assert 1.5 * unit <= numbers.pull_off_force <= 2.0 * unit


# Results of several forces ------------------------------------------------------------------


def test_every_force_has_a_column_and_an_impulse_of_its_own():
    kinds = [kind for kind in SEPARATION_EFFECTS if issubclass(kind, SeparationForce)]
    columns = [column.name for kind in kinds for column in (kind.column, kind.column.impulse)]
    assert len(set(columns)) == len(columns)
