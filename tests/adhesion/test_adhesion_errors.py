"""What adhesion refuses, and what it says then."""

from __future__ import annotations

import math
import re

import attrs
import pytest
from refusals import says

import contactkit as ck
from contactkit.separation.effects.prepared import prepare_scene
from contactkit.separation.simulate import simulate

pytestmark = [
    pytest.mark.errors,
    pytest.mark.filterwarnings("ignore:.*thinnest gap:contactkit.errors.ValidityWarning"),
]

WATER = ck.Liquid(name="water", viscosity=1e-3, surface_tension=0.072)
OPENING = ck.ImposedSpeed(initial_gap=1e-10, final_gap=1e-8, speed=1e-6)
HARD = {"work_of_adhesion": 0.05, "reduced_modulus": 5e10}
VAN_DER_WAALS = ck.VanDerWaalsForce(hamaker_constant=1e-19)


def scene(*effects, upper=None, loading=OPENING, liquid=WATER, **film):
    return ck.SeparationScene(
        interface=ck.Interface(
            upper=upper or ck.Sphere(radius=1e-6),
            meniscus=ck.Meniscus(liquid=liquid, **({"volume": 1e-23} | film)),
        ),
        loading=loading,
        effects=effects,
    )


@pytest.mark.parametrize("model", ["jkr", "dmt", "maugis-dugdale"])
def test_bodies_that_do_not_touch_do_not_adhere(model):
    far = attrs.evolve(OPENING, initial_gap=1e-9)
    with pytest.raises(
        ck.InfeasibleError,
        match=says(
            f"AdhesiveContact ({model}) pulls off at a gap of",
            "loading.initial_gap is 1e-09 m",
            "start closer, or take VanDerWaalsForce()",
        ),
    ):
        ck.plan(scene(ck.AdhesiveContact(model=model, **HARD), loading=far))


CAPILLARY = ck.AdhesiveContact(work_of_adhesion="capillary", reduced_modulus=1e9, strength=1e6)
REFUSED = {
    "flats": (
        scene(ck.AdhesiveContact(**HARD), upper=ck.Flat(radius=1e-6)),
        "AdhesiveContact needs a Sphere: two flats touch all over; take VanDerWaalsForce()",
    ),
    "flats without an area": (
        scene(VAN_DER_WAALS, upper=ck.Flat()),
        "VanDerWaalsForce needs the radius [m] of a Flat face",
    ),
    "vibration": (
        scene(
            ck.AdhesiveContact(**HARD),
            loading=attrs.evolve(OPENING, vibration=ck.Vibration(amplitude=1e-11, frequency=1e3)),
        ),
        "AdhesiveContact needs a loading without vibration",
    ),
    "counted twice": (
        scene(ck.AdhesiveContact(**HARD), VAN_DER_WAALS),
        "AdhesiveContact needs VanDerWaalsForce() left out: the work of adhesion has it already",
    ),
    "two menisci": (
        scene(ck.MeniscusForce(), CAPILLARY),
        "AdhesiveContact needs MeniscusForce() left out: the capillary work of adhesion is that",
    ),
    "no surface tension": (
        scene(CAPILLARY, liquid=ck.Liquid(name="oil")),
        "AdhesiveContact needs liquid.surface_tension [N/m]",
    ),
    "repelled": (
        scene(CAPILLARY, contact_angle_lower=2.0, contact_angle_upper=2.0),
        "AdhesiveContact needs contact angles that sum up to less than 180 deg",
    ),
    "no suction": (
        scene(attrs.evolve(CAPILLARY, strength=None)),
        "AdhesiveContact needs AdhesiveContact.strength [Pa], the suction of the liquid",
    ),
}


@pytest.mark.parametrize("name", REFUSED)
def test_a_scene_that_does_not_fit_is_refused(name):
    made, text = REFUSED[name]
    with pytest.raises(ck.PlanError, match=re.escape(text)):
        ck.plan(made)


def test_what_goes_together_is_let_through():
    ck.plan(scene(ck.MeniscusForce(), ck.AdhesiveContact(**HARD)))
    ck.plan(scene(CAPILLARY, VAN_DER_WAALS))  # of the solids through the liquid
    jkr = attrs.evolve(CAPILLARY, model="jkr", strength=None)
    made = scene(jkr, volume=None)
    assert jkr.numbers(prepare_scene(made)).tabor_parameter is None
    assert not {"tabor_parameter"} & simulate(ck.plan(made)).scalars().keys()


@pytest.mark.parametrize(
    ("model", "modulus", "bound"), [("jkr", 5e10, "at least 5"), ("dmt", 1e8, "0 to 0.1")]
)
def test_a_model_out_of_its_range_warns(model, modulus, bound):
    effect = ck.AdhesiveContact(model=model, work_of_adhesion=0.05, reduced_modulus=modulus)
    with pytest.warns(ck.ValidityWarning, match=rf"Tabor parameter = .*{bound}.*maugis-dugdale"):
        simulate(ck.plan(scene(effect)))
    simulate(ck.plan(scene(attrs.evolve(effect, model="maugis-dugdale"))))


def test_what_was_not_simulated_is_not_there():
    result = simulate(ck.plan(scene(VAN_DER_WAALS)))
    for ask in (lambda: result["adhesion_force"], lambda: result.of(ck.AdhesiveContact)):
        with pytest.raises(ck.NotSimulatedError, match=re.escape("add AdhesiveContact(...)")):
            ask()
    with pytest.raises(ck.NotSimulatedError, match=re.escape("add MeniscusForce()")):
        result["meniscus_force"]
    assert "adhesion_impulse" not in result.scalars()


@pytest.mark.parametrize("loads", [[math.nan], [math.inf], [[1.0]]])
def test_loads_are_numbers(loads):
    with pytest.raises(ck.DescriptionError, match=says("loads", "be a sequence of finite numbers")):
        ck.adhesion_curve(scene(ck.AdhesiveContact(**HARD)), loads)


def test_a_load_beyond_the_pull_off_is_refused():
    with pytest.raises(
        ck.InfeasibleError, match=r"exceeds the pull-off force of .* N; give a smaller tensile load"
    ):
        ck.adhesion_curve(scene(ck.AdhesiveContact(**HARD)), [0.0, -1e-3])
    with pytest.raises(ck.PlanError, match=re.escape("add AdhesiveContact(...)")):
        ck.adhesion_curve(scene(VAN_DER_WAALS), [0.0])
    with pytest.raises(ck.PlanError, match="AdhesiveContact needs a Sphere"):
        ck.adhesion_curve(REFUSED["flats"][0], [0.0])


def test_what_does_not_know_solids_refuses_them():
    film = scene(ck.ViscousForce(), VAN_DER_WAALS)
    with pytest.warns(ck.ValidityWarning, match="slenderness"):
        part = simulate(ck.plan(film)).of(ck.ViscousForce)
    with pytest.raises(ck.PlanError, match="knows the film and its meniscus, not VanDerWaalsForce"):
        part.time_at_constant_force(1e-3)


def test_the_monolithic_reference_refuses_solids():
    from contactkit.models.injector import monolithic

    pulled = ck.ImposedForce(initial_gap=1e-10, final_gap=1e-8, force=1e-6, mass=1e-12)
    made = ck.plan(scene(VAN_DER_WAALS, loading=pulled))
    with pytest.raises(ck.PlanError, match="knows forces of the film only"):
        monolithic.simulate(made, lambda time: 1e-6, 1e-6)
