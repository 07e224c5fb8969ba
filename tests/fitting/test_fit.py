"""Fits: parameters come back from synthetic curves, with intervals that hold."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.optimize import curve_fit
from spheres import (
    GAP,
    SOUGHT,
    VISCOSITY,
    closed,
    curve,
    measured,
    readings,
    sphere,
    stokes,
)

import contactkit as ck
from contactkit.fitting.parameters import Parameter

SHIFT = ck.Range("-1 um", "1 um")


def holds(one, value, n=3.0):
    """Whether a value lies within some half intervals of the fitted one."""
    half = 0.5 * (one.high - one.low)
    return abs(one.value - value) <= n * half


def test_the_viscosity_of_a_film_comes_back_with_the_shift_of_the_gap():
    """From a scene that is run; the gap was read 200 nm too small."""
    data = ck.MeasuredCurve(
        over="gap", at=(GAP - 2e-7) * 1e6, quantity="viscous_force", values=readings() * 1e3,
        units=("um", "mN"), noise="1 %", shift=SHIFT,
    )  # fmt: skip
    found = ck.fit(sphere(), data, SOUGHT)
    assert found.status == "decided"
    assert holds(found["viscosity"], 0.2)
    assert holds(found["shift"], 2e-7)
    assert found["viscosity"].high / found["viscosity"].low < 1.01
    assert found.scene.interface.meniscus.liquid.viscosity == found["viscosity"].value
    assert 0.5 < found.chi2 / found.dof < 1.6
    assert all(v.is_valid for v in found.validity if v.value is not None)
    assert "viscous-force" in found.cite()


def test_values_and_intervals_are_those_of_another_program():
    """`curve_fit` of scipy on the closed form, with absolute noise and a zero of the load."""
    force = stokes(0.2, GAP) + 1e-6 * np.random.default_rng(3).standard_normal(GAP.size)
    data = measured(values=force, noise="1 uN", zero=ck.Range("-10 uN", "10 uN"), shift=SHIFT)
    found = ck.fit(sphere(), data, SOUGHT, solve=closed, intervals="linear")
    values, covariance = curve_fit(
        lambda gap, eta, shift, zero: stokes(eta, gap + 1e-6 * shift) + 1e-6 * zero,
        GAP, force, p0=(0.1, 0.0, 0.0), sigma=np.full(GAP.size, 1e-6), absolute_sigma=True,
    )  # fmt: skip
    deviation = np.sqrt(np.diag(covariance)) * (1.0, 1e-6, 1e-6)
    for name, value, sigma in zip(
        ("viscosity", "shift", "zero"), values * (1.0, 1e-6, 1e-6), deviation, strict=True
    ):
        assert found[name].value == pytest.approx(value, abs=0.02 * sigma)
        half = 0.5 * (found[name].high - found[name].low)
        assert half == pytest.approx(sigma, rel=0.05)
    correlation = covariance / np.outer(np.sqrt(np.diag(covariance)), np.sqrt(np.diag(covariance)))
    assert found.correlation[0, 1] == pytest.approx(correlation[0, 1], abs=0.02)


def test_curves_of_several_speeds_share_the_parameters():
    """Each sets its speed; what they have in common is one parameter."""
    speeds = (1e-5, 4e-5)
    data = [
        measured(
            values=readings(0.2, seed=i, gap=GAP, speed=speed), at=GAP - 1e-7,
            sets={"loading.speed": f"{1e6 * speed:g} um/s"}, name=f"{1e6 * speed:g} um/s",
        )
        for i, speed in enumerate(speeds)
    ]  # fmt: skip
    found = ck.fit(sphere(), data, SOUGHT, solve=closed, nuisance={"shift": (-1e-6, 1e-6)})
    assert [one.name for one in found.parameters] == [VISCOSITY, "shift"]
    assert holds(found["viscosity"], 0.2)
    assert holds(found["shift"], 1e-7)
    single = ck.fit(sphere(), data[0], SOUGHT, solve=closed, nuisance={"shift": SHIFT})
    ratio = np.log(single["viscosity"].high / single["viscosity"].low)
    ratio /= np.log(found["viscosity"].high / found["viscosity"].low)
    assert ratio == pytest.approx(np.sqrt(2.0), rel=0.05)  # twice the data


@pytest.mark.slow
def test_a_number_over_a_field_of_the_scene():
    """Release times over the pull: a run for each."""
    oil = ck.Liquid(name="oil", viscosity=0.1)
    face = ck.Flat(radius=1e-3)
    scene = ck.SeparationScene(
        interface=ck.Interface(lower=face, upper=face, meniscus=ck.Meniscus(liquid=oil)),
        loading=ck.ImposedForce(force=1.0, initial_gap=1e-6, final_gap=1e-5),
        effects=(ck.ViscousForce(),),
    )
    pulls = np.array([0.5, 1.0, 2.0])
    # Stefan: t F = 3 pi eta R^4/4 (1/h0^2 - 1/h1^2)
    times = 0.75 * np.pi * 0.3 * 1e-12 * (1e12 - 1e10) / pulls
    times *= 1.0 + 0.01 * np.array([1.0, -1.0, 0.5])
    data = ck.MeasuredCurve(
        over="loading.force", at=pulls, quantity="release_time", values=times, noise="1 %"
    )
    found = ck.fit(scene, data, SOUGHT)
    assert holds(found["viscosity"], 0.3, 1.5)
    assert found.curves[0].units == ("N", "s")
    assert found["viscosity"].high / found["viscosity"].low == pytest.approx(
        np.exp(2.0 * 0.01 / np.sqrt(3.0)), rel=1e-3
    )


@pytest.mark.slow
def test_a_modulus_from_the_approach_of_a_contact():
    """Loads of a sphere over its approach, as a contact is solved; Hertz in the data."""
    solid = ck.Material(young_modulus=2e9, poisson_ratio=0.3)
    scene = ck.ContactScene(
        interface=ck.Interface(
            lower=ck.Body(solid=solid), upper=ck.Body(surface=ck.Sphere(radius=1e-5))
        ),
        window=ck.Window(width=4e-6, periodic=False),
        loading=ck.Approach(approach=5e-8),
        effects=(ck.HalfSpace(),),
    )
    approach = np.array([4e-8, 8e-8, 1.2e-7])
    load = 4.0 / 3.0 * 1e9 / 0.91 * np.sqrt(1e-5) * approach**1.5
    data = ck.MeasuredCurve(
        over="loading.approach", at=approach, quantity="load", values=load, noise="2 %"
    )
    found = ck.fit(
        scene, data, {"interface.lower.solid.young_modulus": (2e8, 2e10)}, ck.Accuracy(grid=32)
    )
    assert found["young_modulus"].value == pytest.approx(1e9, rel=0.02)
    assert found.accuracy.grid == 32


def test_several_paths_have_one_value():
    both = ("interface.meniscus.contact_angle_lower", "interface.meniscus.contact_angle_upper")
    x = np.linspace(0.0, 1.0, 9)

    def solve(scene):
        film = scene.interface.meniscus
        cosines = np.cos(film.contact_angle_lower) + np.cos(film.contact_angle_upper)
        return curve(x=(x, "m"), f=(cosines + x, "N"))

    data = ck.MeasuredCurve(over="x", at=x, quantity="f", values=2 * np.cos(0.5) + x, noise=0.01)
    found = ck.fit(sphere(), data, {both: ck.Range("10 deg", "50 deg")}, solve=solve)
    assert found.parameters[0].value == pytest.approx(0.5, rel=1e-6)
    film = found.scene.interface.meniscus
    assert film.contact_angle_lower == film.contact_angle_upper == found.parameters[0].value


def test_a_prior_counts_as_one_reading():
    """Two that agree share the interval; `decided_by` names the one that decides."""
    scale = {"scale": ck.Prior(1.0, "0.1 %", "calibration")}
    found = ck.fit(sphere(), measured(), SOUGHT, solve=closed, nuisance=scale)
    assert found["scale"].decided_by.startswith("the prior of scale (100 %")
    assert found["scale"].high - found["scale"].low == pytest.approx(2e-3, rel=0.02)
    # Variances of noise and calibration add.
    expected = np.sqrt(0.01**2 / GAP.size + 0.001**2)
    one = found["viscosity"]
    assert 0.5 * np.log(one.high / one.low) == pytest.approx(expected, rel=0.02)


def test_noise_is_estimated_and_weights_count():
    data = measured(values=readings(noise=0.03), noise="proportional")
    found = ck.fit(sphere(), data, SOUGHT, solve=closed)
    relative = found.curves[0].noise / found.curves[0].measured
    assert relative == pytest.approx(0.03, rel=0.25)
    assert found.chi2 == pytest.approx(found.dof, rel=0.02)
    assert "noise" in found.scalars()
    heavy = np.where(GAP < 5e-6, 1.0, 1e-6)
    few = ck.fit(sphere(), measured(weights=heavy), SOUGHT, solve=closed)
    alone = ck.fit(
        sphere(), measured(at=GAP[GAP < 5e-6], values=readings()[GAP < 5e-6]), SOUGHT, solve=closed
    )
    assert few["viscosity"].value == pytest.approx(alone["viscosity"].value, rel=1e-4)


def test_a_bound_shifts_what_contradicts_it_alone():
    def solve(scene):
        eta = scene.interface.meniscus.liquid.viscosity
        return {"force": (10.0 * eta, "N"), "jump": (eta, "m")}

    data = ck.MeasuredCurve(
        over="temperature", at=[290.0, 300.0], quantity="force", values=[2.0, 2.0], noise=0.1
    )
    free = ck.fit(sphere(), data, SOUGHT, solve=solve)
    kept = ck.MeasuredBound(quantity="jump", least=0.1, most=0.3, noise=0.01)
    assert ck.fit(sphere(), [data, kept], SOUGHT, solve=solve)["viscosity"].value == pytest.approx(
        free["viscosity"].value
    )
    missed = ck.MeasuredBound(quantity="jump", least=0.21, noise=0.01)
    found = ck.fit(sphere(), [data, missed], SOUGHT, solve=solve)
    # Weights 2/0.01^2 of the readings of 0.2, 1/0.01^2 of the bound at 0.21.
    assert found["viscosity"].value == pytest.approx((2 * 0.2 + 0.21) / 3, rel=1e-4)


def test_bounds_are_kept_and_an_end_at_one_is_open():
    found = ck.fit(sphere(), measured(), {VISCOSITY: (0.01, 0.15)}, solve=closed)
    one = found["viscosity"]
    assert one.value == pytest.approx(0.15, rel=1e-3)
    assert one.value <= 0.15
    assert one.verdict.startswith("bounded by the data on one side only: above")
    assert found.status == "misfit"  # no viscosity below the bound reaches the data


def test_a_spring_follows_its_branch_to_the_end_and_jumps():
    """An attraction of 5e-28/h^2 and a spring of 1 mN/m, loaded from far and from near."""
    gap = np.geomspace(2e-9, 1e-7, 4000)
    force, stiffness = 5e-28 / gap**2, 1e-3

    def opening(scene):
        return curve(gap=(gap, "m"), pull=(force, "N"))

    fold = (1e-27 / stiffness) ** (1.0 / 3.0)  # where dF/dh = -k
    base = gap + force / stiffness
    at = np.linspace(fold + 5e-28 / fold**2 / stiffness, 1e-7, 30)[1:]
    outer = gap > fold
    expected = np.interp(at, base[outer], force[outer])
    data = ck.MeasuredCurve(
        over="gap", at=at, quantity="pull", values=expected, noise=1e-13, stiffness="1 mN/m",
        scale=ck.Range(0.5, 2.0), beyond="hold",
    )  # fmt: skip
    near = np.interp(at[:3], base[~outer][::-1], force[~outer][::-1])
    assert (near > expected[:3]).all()
    found = ck.fit(
        sphere(), data, {}, solve=lambda scene: curve(gap=(gap[::-1], "m"), pull=(force[::-1], "N"))
    )
    assert found["scale"].value == pytest.approx(1.0, rel=1e-3)
    # Opened from near, it stays there up to where that branch ends.
    held = ck.fit(sphere(), data, {}, solve=opening).curves[0].model
    assert held[0] > 1.5 * expected[0]


def test_branches_of_a_curve_that_turns_back():
    x = np.concatenate([np.linspace(2.0, 0.0, 20), np.linspace(0.0, 2.0, 20)[1:]])
    loop = curve(x=(x, "m"), f=(np.where(np.arange(39) < 20, 1.0, 3.0) * (1 + x), "N"))
    at = np.array([0.5, 1.0, 1.5])
    for branch, factor in (("falling", 1.0), ("rising", 3.0)):
        data = ck.MeasuredCurve(
            over="x", at=at, quantity="f", values=factor * (1 + at), noise=0.01, branch=branch,
            scale=ck.Range(0.2, 5.0),
        )  # fmt: skip
        assert ck.fit(sphere(), data, {}, solve=lambda _: loop)["scale"].value == pytest.approx(1.0)


@pytest.mark.slow
def test_a_second_minimum_is_found_from_several_starts():
    x = np.linspace(0.0, 10.0, 60)

    def solve(scene):
        return curve(x=(x, "m"), f=(np.sin(scene.interface.meniscus.liquid.viscosity * x), "N"))

    data = ck.MeasuredCurve(over="x", at=x, quantity="f", values=np.sin(1.7 * x), noise=0.05)
    ranges = {VISCOSITY: (0.05, 3.0)}
    scene = sphere()
    stuck = ck.fit(scene, data, ranges, solve=solve, intervals="linear")
    found = ck.fit(scene, data, ranges, solve=solve, starts=12)
    assert stuck.chi2 > 100.0 > found.chi2
    assert found["viscosity"].value == pytest.approx(1.7, rel=1e-4)


def test_which_part_of_the_data_decides_which_parameter():
    """A zero matters where the force is small, the viscosity where it is large."""
    data = measured(noise="2 uN", zero=ck.Range("-50 uN", "50 uN"))
    found = ck.fit(sphere(), data, SOUGHT, solve=closed)
    fractions = found.curves[0].fractions
    assert fractions.sum(axis=0) == pytest.approx(1.0)
    centre = (GAP[:, None] * fractions).sum(axis=0)
    assert centre[0] < 0.6 * centre[1]
    assert found["viscosity"].decided_by.startswith("gap 2 um to ")


def test_a_parameter_over_a_decade_is_fitted_by_its_logarithm():
    assert Parameter("a", (), "m", 1.0, 10.0, 1.0).is_log
    assert not Parameter("a", (), "m", 1.0, 9.9, 1.0).is_log
    assert not Parameter("a", (), "m", -1.0, 10.0, 1.0).is_log


def covered(given, noisy, n):
    """How many of the intervals of `n` fits hold the truth, by parameter."""
    hits = np.zeros(len(given[0]))
    for seed in range(n):
        data = measured(values=noisy(np.random.default_rng(seed)), **given[1])
        found = ck.fit(sphere(), data, SOUGHT, solve=closed)
        hits = hits + [
            one.low <= value <= one.high
            for one, value in zip(found.parameters, given[0], strict=True)
        ]
    return hits


@pytest.mark.exhaustive
@pytest.mark.slow
def test_intervals_hold_the_truth_in_68_of_100_fits():
    """200 fits of viscosity and shift at 1 % of noise, estimated: 2 standard deviations of 6.6."""
    exact = stokes(0.2, GAP)
    hits = covered(
        ((0.2, 0.0), {"noise": "proportional", "shift": SHIFT}),
        lambda random: exact * (1.0 + 0.01 * random.standard_normal(GAP.size)),
        200,
    )
    assert hits == pytest.approx(0.6827 * 200, abs=13.2), hits


@pytest.mark.exhaustive
def test_so_do_those_of_profiles():
    """A noise of a tenth to all of the force, and a zero: not linear at all."""
    exact = stokes(0.2, GAP)
    given = {"noise": None, "zero": ck.Range("-50 uN", "50 uN"), "shift": SHIFT}
    hits = covered(
        ((0.2, 0.0, 0.0), given),
        lambda random: exact + 2e-6 * random.standard_normal(GAP.size),
        200,
    )
    assert hits == pytest.approx(0.6827 * 200, abs=13.2), hits
