"""What a body has is used by an effect or refused: the rim of a bounded flat, and its solid."""

from __future__ import annotations

import math

import attrs
import numpy as np
import pytest
from refusals import refuses

import contactkit as ck
from contactkit.adhesion.van_der_waals import pressure_between_flats, sphere_force
from contactkit.kinds import SEPARATION_EFFECTS

pytestmark = [
    pytest.mark.errors,
    pytest.mark.filterwarnings("ignore::contactkit.errors.ValidityWarning"),
]

WATER = ck.Liquid(name="water", viscosity=1e-3, surface_tension=0.072)
STEEL = ck.Material(name="steel", young_modulus=210e9, poisson_ratio=0.3)
BALL = ck.Sphere(radius=1e-6)
ATTRACTION = {"hamaker_constant": 1e-19}
STICKY = {"work_of_adhesion": 0.05, "reduced_modulus": 5e10}
VISCOUS = ck.ViscousForce()


def scene(*effects, lower=None, upper=BALL, volume=1e-24, count=1, **loading):
    meniscus = ck.Meniscus(liquid=WATER, volume=volume, count=count)
    return ck.SeparationScene(
        interface=ck.Interface(lower=lower or ck.Flat(), upper=upper, meniscus=meniscus),
        loading=ck.ImposedSpeed(initial_gap=1e-10, final_gap=3e-9, speed=1e-6, **loading),
        effects=effects,
    )


def run(*effects, **given):
    return ck.simulate(ck.plan(scene(*effects, **given), ck.Accuracy(points=5)))


# Effects by what they do with a rim of 5 nm under a circle of 14 nm.
FOLLOW = (
    (VISCOUS,),
    (ck.ViscousForce(closure="flooded"),),
    (ck.ViscousForce(closure="as-published"),),
    (VISCOUS, ck.TensionLimit(strength=1e5, cavity="truncated")),
    (VISCOUS, ck.ShearLimit(strength=1e3)),
    (ck.VanDerWaalsForce(**ATTRACTION),),
)
REFUSE = (
    (ck.MeniscusForce(),),
    (ck.MeniscusForce(profile="arc"),),
    (ck.MeniscusForce(profile="as-published"),),
    (VISCOUS, ck.Rupture()),
    (VISCOUS, ck.Rupture(gap="zero-neck")),
    (ck.VanDerWaalsForce(closure="hamaker", **ATTRACTION),),
    (ck.AdhesiveContact(model="jkr", **STICKY),),
    (ck.AdhesiveContact(model="dmt", **STICKY),),
    (ck.AdhesiveContact(**STICKY),),
)
UNAWARE = (  # no circle on a flat under a sphere
    (VISCOUS, ck.Rupture(gap=2e-9)),
)


def name(effects):
    return "+".join(f"{e.name}-{'-'.join(map(str, attrs.astuple(e)))}" for e in effects)


def forces(result):
    return {one.name: result[one.name] for one in result.plan.forces}


def test_every_effect_of_a_sphere_is_tried():
    flats_only = {ck.AsperityMenisci}
    deforming = {ck.ElasticBodies, ck.SolidContact}  # tests/separation/deforming
    wetting = {  # they refuse a film that fills the face: tests/separation/wetting
        ck.LiquidWeight,
        ck.LandauLevichFilm,
        ck.CoxVoinovAngle,
        ck.TroutonForce,
        ck.DynamicRupture,
    }
    tried = {type(effects[-1]) for effects in FOLLOW + REFUSE + UNAWARE}
    assert tried == set(SEPARATION_EFFECTS) - flats_only - deforming - wetting


@pytest.mark.parametrize("effects", FOLLOW + REFUSE + UNAWARE, ids=name)
def test_a_rim_far_out_changes_nothing(effects):
    free, wide = run(*effects), run(*effects, lower=ck.Flat(radius=1e-5))
    for column, force in forces(free).items():
        np.testing.assert_allclose(forces(wide)[column], force, rtol=1e-6, err_msg=column)


@pytest.mark.parametrize("effects", FOLLOW, ids=name)
def test_an_effect_that_knows_the_rim_has_a_smaller_force(effects):
    free, narrow = run(*effects), run(*effects, lower=ck.Flat(radius=5e-9))
    for column, force in forces(free).items():
        there = np.interp(narrow.gap, free.gap, force)  # each has the points that its lines need
        assert np.all(forces(narrow)[column] < 0.9 * there), column


@pytest.mark.parametrize("effects", REFUSE, ids=name)
@pytest.mark.parametrize("side", ["lower", "upper"])
def test_an_effect_that_does_not_know_the_rim_refuses_a_narrow_one(effects, side):
    face = ck.Flat(radius=1e-9 if isinstance(effects[-1], ck.Rupture) else 5e-9)
    bodies = {"lower": face, "upper": BALL} if side == "lower" else {"lower": BALL, "upper": face}
    if effects[0] == ck.MeniscusForce(profile="as-published") and side == "upper":
        return  # printed for a sphere above
    kind = type(effects[-1]).__name__
    refuses(
        lambda: ck.plan(scene(*effects, **bodies)),
        f"interface.{side}.surface.radius is {face.radius:g} m, but under a sphere",
        f"{kind} takes a circle of radius",
        "give a Flat of radius",
        "or without one",
        error=ck.PlanError,
    )


def test_the_radius_that_is_asked_for_suffices_and_a_little_less_does_not():
    narrow = scene(ck.MeniscusForce(), lower=ck.Flat(radius=5e-9), count=4)
    with pytest.raises(ck.PlanError, match=r"2\.5e-09 m for each of 4 menisci") as caught:
        ck.plan(narrow)
    least = float(str(caught.value).partition("Flat of radius ")[2].partition(" m")[0])
    ck.plan(scene(ck.MeniscusForce(), lower=ck.Flat(radius=1.001 * least), count=4))
    with pytest.raises(ck.PlanError, match="takes a circle"):
        ck.plan(scene(ck.MeniscusForce(), lower=ck.Flat(radius=0.999 * least), count=4))


def test_a_vibration_is_asked_at_its_smallest_gap():
    """The contact circle is larger there: 13.5 nm at 0.1 nm, and more at 0.01 nm."""
    still = ck.plan(scene(ck.MeniscusForce()))
    effect, prepared = still.scene.effects[0], still.prepared
    radius = effect.rimless_radius(prepared, 1e-10)
    closer = effect.rimless_radius(prepared, 1e-11)
    assert closer > radius > 0.0
    face = ck.Flat(radius=0.5 * (radius + closer))
    ck.plan(scene(ck.MeniscusForce(), lower=face))
    shaken = ck.Vibration(amplitude=9e-11, frequency=1e3)
    with pytest.raises(ck.PlanError, match=f"MeniscusForce takes a circle of radius {closer:.4g}"):
        ck.plan(scene(ck.MeniscusForce(), lower=face, vibration=shaken))


@pytest.mark.parametrize("rim", [1e-9, 30e-9, 1e-6])
def test_the_attraction_within_a_rim_is_the_integral_of_the_pressure(rim):
    from scipy.integrate import quad

    gap, radius, hamaker = 1e-9, 1e-6, 1e-19

    def ring(r):
        pressure = pressure_between_flats(gap + 0.5 * r * r / radius, hamaker)
        return 2.0 * math.pi * r * pressure

    value, _ = quad(ring, 0.0, rim, epsabs=0.0, epsrel=1e-12, limit=200)
    assert sphere_force(gap, hamaker, 1.0 / radius, rim) == pytest.approx(value, rel=1e-9)
    free = hamaker * radius / (6.0 * gap**2)
    assert sphere_force(gap, hamaker, 1.0 / radius) == pytest.approx(free, rel=1e-14)


# Solids --------------------------------------------------------------------------------------

COATED = ck.Stack(layers=(ck.Layer(material=STEEL, thickness=1e-6),), substrate=STEEL)
OF_SOLIDS = ck.AdhesiveContact(work_of_adhesion=0.05)


RIGID = [
    effects
    for effects in FOLLOW + REFUSE + UNAWARE
    if not any(isinstance(effect, ck.ViscousForce) for effect in effects)
]


def test_a_viscous_film_takes_solids_for_its_validity_alone():
    effects = (ck.ViscousForce(),)
    soft = ck.Body(solid=ck.Material(name="rubber", young_modulus=1e6, poisson_ratio=0.49))
    plans = [ck.plan(scene(*effects, lower=lower)) for lower in (ck.Body(), soft)]
    rigid, bending = (ck.simulate(plan) for plan in plans)
    np.testing.assert_array_equal(rigid["viscous_force"], bending["viscous_force"])
    number = {n.name: n for n in bending.validity}["bending of the faces over the gap"]
    assert number.is_valid is False


@pytest.mark.parametrize("effects", RIGID, ids=name)
@pytest.mark.parametrize("side", ["lower", "upper"])
def test_a_solid_that_no_effect_uses_is_refused(effects, side):
    surface = ck.Flat() if side == "lower" else BALL
    body = {side: ck.Body(surface=surface, solid=STEEL)}
    refuses(
        lambda: ck.plan(scene(*effects, **body)),
        f"interface.{side}.solid is given",
        "take the bodies for rigid",
        "solid=None",
        error=ck.PlanError,
    )
    without = attrs.evolve(body[side], solid=None)
    assert ck.plan(scene(*effects, **{side: without})).film.laws


def test_adhesion_takes_its_modulus_from_the_solids():
    rubber = ck.Material(name="rubber", young_modulus=2e9, poisson_ratio=0.49)
    lower, upper = ck.Body(solid=STEEL), ck.Body(surface=BALL, solid=rubber)
    modulus = 1.0 / (1.0 / STEEL.plane_strain_modulus + 1.0 / rubber.plane_strain_modulus)
    given = attrs.evolve(OF_SOLIDS, reduced_modulus=modulus)
    both, stated = run(OF_SOLIDS, lower=lower, upper=upper), run(given)
    np.testing.assert_allclose(both["adhesion_force"], stated["adhesion_force"], rtol=1e-12)
    on_rigid = run(OF_SOLIDS, upper=upper).of(ck.AdhesiveContact).numbers
    assert on_rigid.reduced_modulus == pytest.approx(rubber.plane_strain_modulus, rel=1e-15)


def test_adhesion_says_which_modulus_it_lacks():
    message = "AdhesiveContact needs AdhesiveContact.reduced_modulus [Pa], or the solid of a body"
    refuses(lambda: ck.plan(scene(OF_SOLIDS)), message, error=ck.PlanError)
    coated = ck.Body(surface=BALL, solid=COATED)
    refuses(
        lambda: ck.plan(scene(OF_SOLIDS, upper=coated)),
        "AdhesiveContact needs homogeneous solids, or AdhesiveContact.reduced_modulus [Pa]",
        error=ck.PlanError,
    )


def test_a_rough_surface_is_refused_by_every_film():
    rough = ck.GaussianRoughness(rms=1e-9, correlation_length=1e-7, cutoff=1e-8)
    refuses(
        lambda: ck.plan(scene(VISCOUS, upper=rough)),
        "interface.upper.surface is a GaussianRoughness",
        "press rough bodies in a ContactScene",
        error=ck.PlanError,
    )
