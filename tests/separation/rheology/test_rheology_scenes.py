"""What a scene computes of a rheology, what it leaves out and says of it, what it refuses."""

from __future__ import annotations

import math
import re
import warnings

import numpy as np
import pytest
from films import BARUS, CARREAU, ETA, EYRING, POWER, RIM, face_scene, film_scene
from refusals import refuses

import contactkit as ck
from contactkit.files.scenes import load_scene, save_scene
from contactkit.liquids.rheology.density import DowsonHigginsonDensity
from contactkit.liquids.rheology.pressure import BarusViscosity
from contactkit.liquids.rheology.shear import CarreauViscosity
from contactkit.liquids.viscosity import VogelViscosity

PRESSURE, SHEAR = "viscosity over pressure", "viscosity over shear"
GAPS = {"initial_gap": 1e-6, "final_gap": 1e-5}
MILD = BarusViscosity(pressure_coefficient=1e-11)


def judged(scene):
    """Numbers of a run by name, and the names that it warns of."""
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        result = ck.simulate(ck.plan(scene, ck.Accuracy(points=20)))
    texts = [str(w.message) for w in caught if w.category is ck.ValidityWarning]
    found = {number.name: number for number in result.validity}
    return found, {name for name in found if any(text.startswith(name) for text in texts)}


# Choice -------------------------------------------------------------------------------------


def test_a_film_computes_what_its_numbers_call_for():
    """At 3 eta v a^2/h^3 = 300 MPa of tension a coefficient of 1e-11 does 0.1 % of the force."""
    liquid = {"pressure_viscosity": MILD, "shear_viscosity": CARREAU}
    rheology = ck.plan(film_scene(liquid=liquid)).prepared.rheology
    assert (rheology.computed, rheology.left_out) == (("shear_viscosity",), ("pressure_viscosity",))
    # alpha p/3 of a disc, to first order.
    expected = 1e-11 * 3.0 * ETA * 1e-3 * RIM**2 / 1e-18 / 3.0
    assert rheology.changes["pressure_viscosity"] == pytest.approx(expected, rel=2e-3)


@pytest.mark.parametrize(("share", "is_computed"), [(0.97, False), (1.03, True)])
def test_one_per_cent_of_the_force_decides(share, is_computed):
    peak = 3.0 * ETA * 1e-3 * RIM**2 / 1e-18
    # ln(1 + x)/x averaged over a parabola of the peak x: 1 % at x = 0.0303.
    law = BarusViscosity(pressure_coefficient=share * 0.030459 / peak)
    rheology = ck.plan(film_scene(liquid={"pressure_viscosity": law})).prepared.rheology
    assert (rheology.film is not None) is is_computed
    assert rheology.is_linear is not is_computed


def test_a_choice_overrules_the_numbers():
    liquid = {"pressure_viscosity": MILD, "shear_viscosity": CARREAU}
    plain = ck.plan(film_scene())
    all_of_it, none = (
        ck.plan(film_scene(ck.ViscousForce(rheology=choice), liquid=liquid))
        for choice in ("all", "newtonian")
    )
    assert all_of_it.prepared.rheology.computed == ("pressure_viscosity", "shear_viscosity")
    assert none.prepared.rheology.computed == ()
    assert none.force(2e-6, 1e-3) == plain.force(2e-6, 1e-3)


def test_a_plan_says_what_is_computed_and_left_out():
    liquid = {"pressure_viscosity": MILD, "shear_viscosity": CARREAU}
    text = str(ck.plan(film_scene(liquid=liquid)))
    assert re.search(rf"{SHEAR} is computed: alone it changes the force by \d+ % at most", text)
    assert re.search(rf"{PRESSURE} is left out: .* 0\.1 % at most", text)
    assert "Carreau" in ck.plan(film_scene(liquid=liquid)).cite()


def test_a_strength_bounds_what_pressure_changes():
    """At 1 bar of tension 20 1/GPa are 0.2 %: the film is Newtonian, whatever its full pressure."""
    limit = ck.TensionLimit(strength=1e5)
    rheology = ck.plan(
        film_scene(ck.ViscousForce(), limit, liquid={"pressure_viscosity": BARUS})
    ).prepared.rheology
    assert rheology.computed == ()
    assert 0.0 < rheology.changes["pressure_viscosity"] < 2e-3


def test_a_pull_lets_expect_the_motion_that_it_balances():
    """A tension of 2 F/A on the disc: the coefficient times a third of it."""
    loading = ck.ImposedForce(force=1.0, mass=1e-3, **GAPS)
    law = BarusViscosity(pressure_coefficient=1e-9)
    found = ck.plan(film_scene(liquid={"pressure_viscosity": law}, loading=loading))
    expected = 1e-9 * 2.0 / (math.pi * RIM**2) / 3.0
    changes = found.prepared.rheology.changes
    assert changes["pressure_viscosity"] == pytest.approx(expected, rel=1e-3)


def test_a_pull_that_is_not_known_yet_leaves_nothing_out():
    loading = ck.ImposedForce(force=0.0, mass=1e-3, **GAPS)
    rheology = ck.plan(film_scene(liquid={"pressure_viscosity": MILD}, loading=loading))
    assert rheology.prepared.rheology.computed == ("pressure_viscosity",)


# Numbers ------------------------------------------------------------------------------------


def test_what_is_left_out_is_stated_and_warned_of():
    name = f"{SHEAR}, left out of the force"
    newtonian = ck.ViscousForce(rheology="newtonian")
    found, warned = judged(film_scene(newtonian, liquid={"shear_viscosity": CARREAU}))
    plain, thin = (
        ck.plan(film_scene(ck.ViscousForce(rheology="all"), liquid=liquid)).force(1e-6, 1e-3)
        for liquid in ({}, {"shear_viscosity": CARREAU})
    )
    assert found[name].value == pytest.approx(1.0 - thin / plain, rel=1e-3)
    assert found[name].value > 0.3
    assert name in warned
    found, warned = judged(film_scene(liquid={"pressure_viscosity": MILD}))
    assert f"{PRESSURE}, left out of the force" in found
    assert f"{PRESSURE}, left out of the force" not in warned


def test_tension_beyond_what_was_measured_is_warned_of():
    name = "tension times pressure coefficient"
    found, warned = judged(film_scene(liquid={"pressure_viscosity": BARUS}))
    full = 3.0 * ETA * 1e-3 * RIM**2 / 1e-18
    assert found[name].value == pytest.approx(math.log1p(2e-8 * full), rel=1e-6)
    assert name in warned
    limit = ck.TensionLimit(strength=5e6, cavity="truncated")
    force = ck.ViscousForce(rheology="all")
    found, warned = judged(film_scene(force, limit, liquid={"pressure_viscosity": BARUS}))
    assert found[name].value == pytest.approx(0.1)
    assert name not in warned


def test_deborah_number_is_the_memory_over_the_time_of_the_gap():
    found, _ = judged(film_scene(liquid={"shear_viscosity": CARREAU}))
    assert found["Deborah number"].value == pytest.approx(1e-5 * 1e-3 / 1e-6)
    slow = CarreauViscosity(relaxation_time=0.1, exponent=0.5, second_plateau=0.05)
    _, warned = judged(film_scene(liquid={"shear_viscosity": slow}))
    assert "Deborah number" in warned


def test_other_numbers_follow_the_force():
    """Compression of a film that thins: the pressure falls with the force."""
    name = "pressure over bulk modulus"
    found = [
        judged(film_scene(liquid={"bulk_modulus": 1e9, **more}))[0][name].value
        for more in ({}, {"shear_viscosity": CARREAU})
    ]
    ratio = ck.plan(film_scene(liquid={"shear_viscosity": CARREAU})).force(1e-6, 1e-3)
    ratio /= ck.plan(film_scene()).force(1e-6, 1e-3)
    assert found[1] / found[0] == pytest.approx(ratio, rel=1e-3)


def test_density_over_pressure_is_stated():
    found, _ = judged(film_scene(liquid={"pressure_density": DowsonHigginsonDensity()}))
    peak = 3.0 * ETA * 1e-3 * RIM**2 / 1e-18
    assert found["change of the density over pressure"].value == pytest.approx(0.6e-9 * peak)
    assert "pressure over bulk modulus" not in found


# Heating ------------------------------------------------------------------------------------


def hot(**more):
    vogel = VogelViscosity(
        reference_viscosity=1e-4,
        activation_temperature=600.0,
        divergence_temperature=0.0,
        temperature_min=250.0,
        temperature_max=350.0,
    )
    oil = ck.Liquid(name="oil", viscosity=vogel, density=900.0, **more)
    face = ck.Flat(radius=RIM)
    return ck.SeparationScene(
        interface=ck.Interface(lower=face, upper=face, meniscus=ck.Meniscus(liquid=oil)),
        loading=ck.ImposedSpeed(speed=1e-3, **GAPS),
        effects=(ck.ViscousForce(),),
        temperature=300.0,
    )


@pytest.mark.filterwarnings("ignore::contactkit.errors.ValidityWarning")
def test_walls_that_conduct_bound_the_temperature_rise():
    """3 eta v^2 r^2/(16 k h^2) in the middle of the gap at the rim: tau_w^2 h^2/(48 eta k)."""
    eta = 1e-4 * 10.0**2
    result = ck.simulate(ck.plan(hot(heat_capacity=2e3, thermal_conductivity=0.13)))
    expected = 3.0 * eta * 1e-6 * RIM**2 / (16.0 * 0.13 * 1e-12)
    assert result.of(ck.ViscousForce).temperature_rise == pytest.approx(expected, rel=1e-6)
    number = next(n for n in result.validity if n.name == "viscosity lost by heating")
    slope = math.log(10.0) * 600.0 / 300.0**2
    assert number.value == pytest.approx(slope * expected, rel=1e-4)
    assert "heats itself by" in number.detail


def test_walls_that_conduct_are_a_bound_of_their_own():
    """Without a heat capacity too: the number is stated, and says of which bound."""
    both, alone = (
        judged(hot(thermal_conductivity=0.13, **more))[0]["viscosity lost by heating"]
        for more in ({"heat_capacity": 2e3}, {})
    )
    assert alone.value == pytest.approx(both.value, rel=1e-9)
    assert "liquid.heat_capacity adds" in alone.detail
    assert "liquid.heat_capacity" not in both.detail


@pytest.mark.filterwarnings("ignore::contactkit.errors.ValidityWarning")
def test_work_of_a_film_that_keeps_it_bounds_the_temperature_rise():
    result = ck.simulate(ck.plan(hot(heat_capacity=2e3), ck.Accuracy(points=2000)))
    work = 0.75 * math.pi * 1e-2 * RIM**4 * 1e-3 * (1e12 - 1e10)  # impulse times speed
    volume = math.pi * RIM**2 * 1e-6
    expected = work / (volume * 900.0 * 2e3)
    assert result.of(ck.ViscousForce).temperature_rise == pytest.approx(expected, rel=1e-2)


def test_no_temperature_rise_without_the_numbers_for_it():
    result = ck.simulate(ck.plan(hot()))
    with pytest.raises(ck.NotSimulatedError, match="thermal_conductivity"):
        _ = result.of(ck.ViscousForce).temperature_rise


# Files --------------------------------------------------------------------------------------


def test_a_scene_comes_back_from_its_file(tmp_path):
    scene = film_scene(
        ck.ViscousForce(rheology="all"),
        liquid={"pressure_viscosity": BARUS, "shear_viscosity": POWER, "heat_capacity": 2e3},
        meniscus={"slip_length_lower": 2e-8},
    )
    save_scene(scene, tmp_path / "film.toml")
    text = (tmp_path / "film.toml").read_text()
    assert 'law = "barus"' in text
    assert load_scene(tmp_path / "film.toml").interface == scene.interface
    assert load_scene(tmp_path / "film.toml").effects == scene.effects


# Refusals -----------------------------------------------------------------------------------

ALL = ck.ViscousForce(rheology="all")
THIN = {"shear_viscosity": EYRING}
SLIPS = {"slip_length_lower": 1e-8}
TIME = ck.ImposedTime(time=1.0, **GAPS)
RING = ck.Flat(planform=ck.Ring(radius=RIM, hole_radius=0.5 * RIM))


def plans(*effects, **given):
    return lambda: ck.plan(film_scene(*effects, **given))


@pytest.mark.parametrize(
    ("call", "parts"),
    [
        (
            plans(ALL, ck.TensionLimit(strength=1e5), liquid=THIN),
            ('cavity="mass-conserving"', 'take cavity="truncated"', 'rheology="newtonian"'),
        ),
        (
            plans(ck.ViscousForce(), ck.TensionLimit(strength=1e5), meniscus=SLIPS),
            ('cavity="mass-conserving"', "leave the slip lengths of the meniscus out"),
        ),
        (
            plans(ALL, ck.TensionLimit(strength=1e5, cavity="reynolds"), liquid=THIN),
            ('cavity="reynolds"', 'take cavity="truncated"'),
        ),
        (
            plans(ALL, ck.ShearLimit(strength=1e6), liquid=THIN),
            ("ShearLimit bounds the stress of a Newtonian film", "EyringViscosity(stress=...)"),
        ),
        (plans(ALL, liquid=THIN, loading=TIME), ("ViscousForce needs a speed or a force imposed",)),
        (
            plans(ck.MeniscusForce(), meniscus={**SLIPS, "volume": 1e-12}),
            ("slip_length_lower and slip_length_upper [m] are read by ViscousForce() alone",),
        ),
        (
            plans(ck.ViscousForce(closure="as-published"), meniscus={**SLIPS, "volume": 1e-12}),
            ("no slip of the liquid for the equations as published",),
        ),
        (
            plans(ck.ViscousForce(), ck.TroutonForce(), liquid=THIN, meniscus={"volume": 1e-12}),
            ("TroutonForce takes the viscosity at rest", 'ViscousForce(rheology="newtonian")'),
        ),
    ],
    ids=["cavity", "cavity and slip", "reynolds", "shear", "time", "unread", "printed", "trouton"],
)
def test_what_is_not_known_is_refused_by_name(call, parts):
    refuses(call, *parts, error=ck.PlanError)


def test_slip_on_an_even_face_is_that_of_a_disc():
    plan, plain = (ck.plan(face_scene(RING, **slip)) for slip in ({"slip_length_upper": 5e-7}, {}))
    ratio = (2e-6 + 5e-7) / (2e-6 + 2e-6)
    assert plan.force(2e-6, 1e-3) == pytest.approx(ratio * plain.force(2e-6, 1e-3), rel=1e-12)


def test_bodies_that_deform_or_slide_refuse_it():
    steel = ck.Material(name="steel", young_modulus=210e9, poisson_ratio=0.3)
    oil = ck.Liquid(name="oil", viscosity=0.1, shear_viscosity=EYRING)

    def deforming(viscous, **more):
        return ck.SeparationScene(
            interface=ck.Interface(
                lower=ck.Body(surface=ck.Flat(), solid=steel),
                upper=ck.Sphere(radius=1e-2),
                meniscus=ck.Meniscus(liquid=oil, **more),
            ),
            loading=ck.ImposedSpeed(speed=1e-4, **GAPS),
            effects=(viscous, ck.ElasticBodies()),
        )

    refuses(lambda: ck.plan(deforming(ck.ViscousForce())), "at rest", error=ck.PlanError)
    ck.plan(deforming(ck.ViscousForce(rheology="newtonian")))
    refuses(
        lambda: ck.plan(deforming(ck.ViscousForce(rheology="newtonian"), **SLIPS)),
        "slip_length_lower",
        error=ck.PlanError,
    )
    sliding = ck.SlidingScene(
        interface=ck.Interface(
            lower=ck.Flat(),
            upper=ck.Flat(radius=RIM),
            meniscus=ck.Meniscus(liquid=oil, **SLIPS),
        ),
        loading=ck.Sliding(gap=1e-6, travel=1e-5, speed=1e-3),
        effects=(ck.CouetteForce(),),
    )
    refuses(lambda: ck.plan(sliding), "slip_length_lower", "shear_viscosity", error=ck.PlanError)


def test_a_film_cannot_close_faster_than_any_pressure_drives_it():
    """Barus: beyond alpha q = 1 in the centre no pressure is enough."""
    speed = 1.5 / (2e-8 * 3.0 * ETA * RIM**2 / (2e-6) ** 3)
    loading = ck.ImposedForce(
        force=1.0, mass=1e3, initial_gap=2e-6, final_gap=1e-5, initial_speed=-speed
    )
    scene = film_scene(ALL, liquid={"pressure_viscosity": BARUS}, loading=loading)
    refuses(
        lambda: ck.plan(scene).force(2e-6, -speed),
        "the film cannot close at",
        "take RoelandsViscosity",
        error=ck.InfeasibleError,
    )
    assert np.isfinite(ck.plan(scene).force(2e-6, -0.3 * speed))
