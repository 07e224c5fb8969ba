"""Verdicts: what the data do not decide, and what the model misses, in words."""

from __future__ import annotations

import numpy as np
import pytest
from spheres import GAP, SOUGHT, VISCOSITY, closed, curve, measured, readings, sphere, stokes

import contactkit as ck
from contactkit.fitting.verdict import runs_of_signs

SPEED = "loading.speed"


def test_viscosity_and_speed_are_known_by_their_product_only():
    """The force of a film has one: each goes to where the other comes to its bound."""
    ranges = SOUGHT | {SPEED: ("1 um/s", "100 um/s")}
    found = ck.fit(sphere(), measured(), ranges, solve=closed)
    assert found.status == "not identifiable"
    for name in ("viscosity", "speed"):
        assert found[name].verdict.startswith("not identifiable from these data within its bounds")
    assert found["speed"].low == pytest.approx(1e-6)
    assert found["speed"].high == pytest.approx(1e-4)
    # 0.2 Pa.s at 10 um/s is 0.02 at 100 and 2 at 1.
    assert found["viscosity"].low == pytest.approx(0.02, rel=0.02)
    assert found["viscosity"].high == pytest.approx(2.0, rel=0.02)
    (text,) = found.undecided
    assert "what the data decide is viscosity * speed^1 to 0.1" in text  # 1 % over sqrt(40)
    assert "Prior" in found.message
    assert found.correlations()[0].startswith("viscosity and speed: -1.0")


def test_a_prior_decides_what_the_data_leave_open():
    known = {SPEED: ck.Prior("10 um/s", "3 %", "encoder")}
    found = ck.fit(sphere(), measured(), SOUGHT | known, solve=closed)
    assert found.status == "decided"
    assert 0.5 * np.log(found["viscosity"].high / found["viscosity"].low) == pytest.approx(
        np.hypot(0.03, 0.01 / np.sqrt(GAP.size)), rel=0.05
    )
    assert found["viscosity"].decided_by.startswith("the prior of loading.speed")


def test_a_power_law_names_its_power():
    """A force of viscosity gap^-3: the power is that of the product that is known."""
    x = np.linspace(1.0, 2.0, 20)

    def solve(scene):
        eta, angle = scene.interface.meniscus.liquid.viscosity, scene.loading.speed
        return curve(x=(x, "m"), f=(1e-18 * eta * angle**-3.0 * x, "N"))

    exact = 1e-18 * 0.1 * 1e-5**-3.0 * x
    data = ck.MeasuredCurve(over="x", at=x, quantity="f", values=exact, noise="1 %")
    ranges = {VISCOSITY: (1e-3, 10.0), SPEED: (1e-6, 1e-4)}
    found = ck.fit(sphere(), data, ranges, solve=solve)
    assert "viscosity * speed^-3 to" in found.undecided[0]


def test_a_parameter_that_does_not_enter_is_reported():
    ranges = SOUGHT | {"interface.meniscus.liquid.surface_tension": (0.01, 0.05)}
    found = ck.fit(sphere(), measured(), ranges, solve=closed)
    assert found["surface_tension"].verdict.endswith("it does not change what was measured")
    assert found["viscosity"].is_decided
    assert found.status == "not identifiable"


def test_bounded_on_one_side_only():
    """A zero of the force far below its noise: no least viscosity, but a greatest."""
    data = measured(values=1e-9 + 0.0 * GAP, noise="1 uN", quantity="force")
    found = ck.fit(sphere(), data, {VISCOSITY: (1e-5, 1.0)}, solve=closed)
    one = found["viscosity"]
    assert one.verdict.startswith("bounded by the data on one side only: below")
    # 1 = sum (F/noise)^2 at the end of the interval.
    assert np.sum((stokes(one.high, GAP) / 1e-6) ** 2) == pytest.approx(1.0, rel=0.1)
    assert one.is_profile


@pytest.mark.slow
def test_volume_and_angle_of_a_bridge_far_from_rupture():
    """Close to the sphere either fits the force; far enough the volume shows."""
    oil = ck.Liquid(name="oil", viscosity=0.1, surface_tension=0.03)
    angle, volume = "interface.meniscus.contact_angle_upper", "interface.meniscus.volume"
    film = ck.Meniscus(liquid=oil, volume=2e-12, contact_angle_lower=0.3, contact_angle_upper=0.3)
    scene = ck.SeparationScene(
        interface=ck.Interface(upper=ck.Sphere(radius=1e-3), meniscus=film),
        loading=ck.ImposedSpeed(speed=1e-6, initial_gap=5e-8, final_gap=1e-5),
        effects=(ck.MeniscusForce(profile="arc"),),
    )
    made = ck.simulate(ck.plan(scene, ck.Accuracy(curve_rtol=1e-4)))
    noise = 1.0 + 0.01 * np.random.default_rng(2).standard_normal(15)
    ranges = {volume: ("0.5 nL", "10 nL"), angle: ("5 deg", "60 deg")}

    def fitted(last):
        gap = np.linspace(1e-7, last, 15)
        force = np.interp(gap, made.gap, made["meniscus_force"]) * noise
        data = ck.MeasuredCurve(
            over="gap", at=gap, quantity="meniscus_force", values=force, noise="1 %"
        )
        return ck.fit(scene, data, ranges, intervals="linear")

    near = fitted(3e-7)
    assert near.status == "not identifiable"
    assert f"{volume} and {angle} are not identifiable each" in near.undecided[0]
    assert not near["volume"].is_decided
    assert not near[angle].is_decided
    far = fitted(9e-6)
    assert far.status == "decided"
    assert abs(np.log(far["volume"].value / 2e-12)) < 0.1
    assert far[angle].low < 0.33
    assert far[angle].high > 0.27


def test_a_model_that_cannot_reach_the_data_is_reported():
    """A force of gap^-2 is none of a sphere: chi^2 and the runs of signs state it."""
    data = measured(values=readings() * 2e-6 / GAP)
    found = ck.fit(sphere(), data, SOUGHT, solve=closed)
    assert found.status == "misfit"
    assert "the model does not reach the data (chi^2 over degrees of freedom" in found.message
    estimated = ck.fit(sphere(), measured(values=readings() * 2e-6 / GAP, noise=None), SOUGHT,
                       solve=closed)  # fmt: skip
    assert estimated.status == "misfit"
    assert "runs of signs" in estimated.message


def test_runs_of_signs_of_noise_are_those_of_chance():
    z = [runs_of_signs(np.random.default_rng(i).standard_normal(50)) for i in range(400)]
    assert np.mean(z) == pytest.approx(0.0, abs=0.15)
    assert np.std(z) == pytest.approx(1.0, abs=0.1)
    assert runs_of_signs(np.ones(16)) == -4.0


def test_models_are_compared_by_their_criterion():
    """A force of 1/gap: a shift that is not there costs two, a zero in its place misses."""
    data = measured(values=readings(gap=GAP + 3e-7))
    fits = {
        "no shift": ck.fit(sphere(), data, SOUGHT, solve=closed),
        "shift": ck.fit(sphere(), data, SOUGHT, solve=closed, nuisance={"shift": (-1e-6, 1e-6)}),
    }
    found = ck.compare_fits(fits)
    assert found.names == ("shift", "no shift")
    assert "ask for shift; no shift has no support" in found.verdict
    plain = measured()
    fits = {
        "no shift": ck.fit(sphere(), plain, SOUGHT, solve=closed),
        "shift": ck.fit(sphere(), plain, SOUGHT, solve=closed, nuisance={"shift": (-1e-6, 1e-6)}),
    }
    found = ck.compare_fits(fits)
    assert "do not choose" in found.verdict or "prefer no shift" in found.verdict
    assert found.weight.sum() == pytest.approx(1.0)
    assert found.to_dataframe().shape[0] == 2
    # Two data sets of equal size: -2 ln L + 2k + 2k(k+1)/(n-k-1) of one fit by hand.
    one = fits["no shift"]
    sigma = one.curves[0].noise
    by_hand = one.chi2 + np.sum(np.log(2 * np.pi * sigma**2)) + 2.0 + 4.0 / 38.0
    assert one.aicc == pytest.approx(by_hand)


def test_the_tabor_parameter_stands_beside_the_comparison_of_adhesive_contacts():
    """Radii of a JKR contact at a Tabor parameter of 14: DMT misses them, out of its range."""
    loads, at = np.linspace(-1e-6, 6e-6, 25), np.linspace(0.0, 5e-6, 12)

    def contact(model, work=0.03):
        effect = ck.AdhesiveContact(
            model=model, work_of_adhesion=work, reduced_modulus=1e7, strength=1e7
        )
        air = ck.Meniscus(liquid=ck.Liquid(name="air"))
        return ck.SeparationScene(
            interface=ck.Interface(upper=ck.Sphere(radius=1e-5), meniscus=air),
            loading=ck.ImposedSpeed(initial_gap=3e-9, final_gap=1e-6, speed=1e-6),
            effects=(effect,),
        )

    truth = ck.adhesion_curve(contact("jkr", 0.05), loads)
    radii = np.interp(at, truth["load"], truth["contact_radius"])
    noise = 1.0 + 0.01 * np.random.default_rng(0).standard_normal(at.size)
    data = ck.MeasuredCurve(
        over="load", at=at, quantity="contact_radius", values=radii * noise, noise="1 %"
    )
    path = "effects.adhesive-contact.work_of_adhesion"
    fits = {
        model: ck.fit(
            contact(model), data, {path: ("5 mJ/m2", "0.5 J/m2")},
            solve=lambda scene: ck.adhesion_curve(scene, loads),
        )
        for model in ("jkr", "dmt")
    }  # fmt: skip
    one = fits["jkr"]["work_of_adhesion"]
    assert abs(one.value - 0.05) < 1.5 * (one.high - one.low)
    found = ck.compare_fits(fits)
    assert found.names[0] == "jkr"
    assert "dmt is out of its range there: Tabor parameter = 8" in found.verdict
    assert "jkr is out" not in found.verdict


def test_a_profile_rises_by_one_at_the_ends_of_the_interval():
    found = ck.fit(sphere(), measured(shift=("-1 um", "1 um")), SOUGHT, solve=closed)
    one = found.profile("viscosity", n=9, reach=1.0)
    assert one.axis == "viscosity"
    assert one.rise[[0, -1]] == pytest.approx([1.0, 1.0], abs=0.1)
    assert one.rise[4] == pytest.approx(0.0, abs=1e-3)
    assert one["shift"][0] < one["shift"][-1]
    assert one.unit("viscosity") == "Pa.s"
    linear = found.profile("viscosity", n=3, reach=2.0)
    assert linear.rise[-1] == pytest.approx(4.0, rel=0.1)


@pytest.mark.slow
def test_a_posterior_has_the_interval_of_the_fit():
    pytest.importorskip("emcee", reason="emcee (extra posterior) is not installed")
    found = ck.fit(sphere(), measured(), SOUGHT, solve=closed)
    sample = found.sample(150, seed=1)
    numbers = sample.scalars()
    one = found["viscosity"]
    half = 0.5 * (one.high - one.low)
    assert numbers["viscosity"][0] == pytest.approx(one.value, abs=0.2 * half)
    assert numbers["viscosity_high"][0] == pytest.approx(one.high, abs=0.25 * half)
    assert sample.validity[0].name == "steps over the autocorrelation time"
    again = found.sample(20, seed=1)
    assert (again["viscosity"] == found.sample(20, seed=1)["viscosity"]).all()
