"""A gap that vibrates while it opens: what it leaves alone, what it rectifies, what breaks."""

from __future__ import annotations

import math
from itertools import pairwise

import attrs
import loadings
import numpy as np
import pytest
from scipy.integrate import quad
from selection import quick

import contactkit as ck
from contactkit.cli import main

pytestmark = pytest.mark.filterwarnings("ignore::contactkit.errors.ValidityWarning")

OIL = ck.Liquid(name="oil", viscosity=0.1, surface_tension=0.03, density=870.0)
FACE = ck.Flat(radius=1e-3)
VISCOUS, MENISCUS = ck.ViscousForce(), ck.MeniscusForce(profile="arc")
TENSION = ck.TensionLimit(strength=1e5, cavity="truncated")


def approx(value, rel=1e-9):
    return pytest.approx(value, rel=rel, abs=0.0)


def scene(*effects, body=FACE, volume=9.4e-12, vibration=None, **loading):
    film = ck.Meniscus(liquid=OIL, volume=volume, contact_angle_lower=0.3, contact_angle_upper=0.3)
    given = {"initial_gap": 5e-6, "final_gap": 1e-5, "speed": 1e-5} | loading
    return ck.SeparationScene(
        interface=ck.Interface(lower=FACE, upper=body, meniscus=film),
        loading=loadings.imposed(**given, vibration=vibration),
        effects=effects,
    )


def run(*effects, accuracy=None, **given):
    return ck.simulate(ck.plan(scene(*effects, **given), accuracy))


def shaken(amplitude, frequency=20.0, phase=0.0):
    return ck.Vibration(amplitude=amplitude, frequency=frequency, phase=phase)


@pytest.mark.parametrize("amplitude", [1e-9, 1e-6, 4.9e-6])
@pytest.mark.parametrize("frequency", quick([3.3, 20.0, 1e4], 1))
@pytest.mark.parametrize("body", [FACE, ck.Sphere(radius=0.1)])
def test_a_newtonian_film_keeps_its_impulse(amplitude, frequency, body):
    """The path in time changes nothing; kinks, parts of cycles and cycles left out included."""
    vibration, few = shaken(amplitude, frequency, 0.7), ck.Accuracy(points=60)
    result = run(VISCOUS, body=body, vibration=vibration, accuracy=few)
    size = np.abs(result["viscous_force"]).max() * result.time[-1]
    part = result.of(ck.ViscousForce)
    assert part.impulse == pytest.approx(part.newtonian_impulse, rel=1e-6, abs=1e-7 * size)
    assert result["viscous_impulse"][-1] == approx(part.impulse)


def test_a_cavitating_film_pushes_on_the_mean():
    """Tension is limited on opening, pressure on closing is not: the vibration is rectified."""
    calm = run(VISCOUS, TENSION).scalars()
    assert calm["viscous_impulse"][0] > 0.0
    means = [
        run(VISCOUS, TENSION, vibration=shaken(a, 60.0)).scalars()["mean_pull"][0]
        for a in (1e-6, 2e-6, 4e-6)
    ]
    assert 0.0 > means[0] > means[1] > means[2]
    result = run(VISCOUS, TENSION, vibration=shaken(2e-6, 60.0))
    cap = 1e5 * math.pi * 1e-6
    assert result.pull.max() <= cap
    assert result.pull.min() < -cap
    assert (result["newtonian_force"][result["limit"] == 2] > 0.0).all()
    assert result.scalars()["mean_steady_pull"][0] > 0.0 > means[0]


def test_the_rectified_mean_is_that_of_another_quadrature():
    vibration = shaken(3e-6, 20.0, 0.4)
    result = run(VISCOUS, MENISCUS, TENSION, vibration=vibration)
    film = result.plan.film

    def pull(t):
        gap = 5e-6 + 1e-5 * t + vibration.offset(t)
        return film.force(gap, 1e-5 + vibration.speed(t))

    marks = np.linspace(0.0, 0.5, 201)
    total = sum(quad(pull, a, b, epsabs=0.0, epsrel=1e-9, limit=200)[0] for a, b in pairwise(marks))
    assert result.impulses["pull_impulse"] == approx(total, 2e-6)
    assert result.scalars()["mean_pull"][0] == approx(2.0 * total, 2e-6)
    steady = run(VISCOUS, MENISCUS, TENSION)
    calm = sum(steady.impulses[f"{name}_impulse"] for name in ("viscous", "meniscus"))
    assert result.impulses["steady_pull_impulse"] == approx(calm, 1e-7)


def test_a_convex_force_gains_a_quarter_of_its_second_derivative():
    """A meniscus at a nearly held gap: F(h) + F''(h) a^2/4."""
    still = {"initial_gap": 8e-6, "final_gap": 8.0001e-6, "speed": 1e-8}
    amplitude = 4e-8
    result = run(MENISCUS, vibration=shaken(amplitude, 1e3), **still)
    force = result.plan.film.static_force
    h, d = 8e-6, 1e-7
    bend = (force(h + d) - 2.0 * force(h) + force(h - d)) / d**2
    scalars = result.scalars()
    gain = scalars["mean_pull"][0] - scalars["mean_steady_pull"][0]
    assert gain == approx(0.25 * bend * amplitude**2, 1e-2)
    assert gain > 0.0


@pytest.mark.slow
def test_cycles_left_out_are_bridged():
    """250 cycles, of which all, 80 or 30 are computed."""
    vibration = shaken(2e-6, 500.0, 1.0)
    every = run(VISCOUS, TENSION, vibration=vibration, accuracy=ck.Accuracy(points=250))
    for points, error in ((80, 1e-7), (30, 1e-5)):
        few = run(VISCOUS, TENSION, vibration=vibration, accuracy=ck.Accuracy(points=points))
        assert few.impulses["pull_impulse"] == approx(every.impulses["pull_impulse"], error)
        assert "were computed" in few.message


@pytest.mark.slow
def test_a_fast_vibration_late_in_a_long_run_is_computed_too():
    """After 500 s a double resolves 1e-13 s, of a period of 2.5e-6 s."""
    loading = {"vibration": shaken(1e-6, 4e5), "accuracy": ck.Accuracy(points=20)}
    slow, slower = (run(VISCOUS, TENSION, speed=s, **loading) for s in (1e-7, 1e-8))
    assert slow.work.n_evaluations == slower.work.n_evaluations
    ratio = slower.impulses["pull_impulse"] / slow.impulses["pull_impulse"]
    assert ratio == approx(10.0, 1e-4)


def test_a_vibration_breaks_the_film_earlier():
    rupture = ck.Rupture(gap=8e-6)
    calm = run(VISCOUS, rupture)
    result = run(VISCOUS, rupture, vibration=shaken(1e-6, 100.0))
    assert calm.gap[-1] >= 8e-6
    assert result.time[-1] < 0.25  # the mean gap is below 7.5 um
    assert result.gap[-1] == approx(8e-6)
    assert (result.gap[:-1] < 8e-6).all()
    assert "the film broke" in result.message


def test_a_vanishing_vibration_is_none():
    calm, result = run(VISCOUS, MENISCUS), run(VISCOUS, MENISCUS, vibration=shaken(1e-15, 7.0))
    np.testing.assert_allclose(
        np.interp(result.gap, calm.gap, calm.pull), result.pull, rtol=1e-3, atol=1e-9
    )
    np.testing.assert_allclose(result.pull, result["steady_pull"], rtol=1e-6)


def test_the_curves_belong_together():
    vibration = shaken(2e-6, 30.0, -1.0)
    result = run(VISCOUS, MENISCUS, vibration=vibration)
    times = result.time
    assert (np.diff(times) > 0.0).all()
    np.testing.assert_allclose(result["mean_gap"], 5e-6 + 1e-5 * times, rtol=1e-13)
    offsets = np.array([vibration.offset(t) for t in times])
    np.testing.assert_allclose(result.gap, result["mean_gap"] + offsets, rtol=1e-12)
    np.testing.assert_allclose(
        result.pull, result["meniscus_force"] + result["viscous_force"], rtol=1e-12
    )
    drift = np.trapezoid(result.speed, times)
    assert drift == pytest.approx(result.gap[-1] - result.gap[0], rel=1e-2)
    with pytest.raises(ck.NotSimulatedError, match="TensionLimit"):
        result["limit"]


def test_adhesive_solids_are_not_shaken():
    """A contact with pull-off and re-contact in each cycle is not followed."""
    sticky = ck.AdhesiveContact(work_of_adhesion=0.05, reduced_modulus=1e9)
    sphere = ck.Sphere(radius=0.1)
    near = scene(VISCOUS, sticky, body=sphere, initial_gap=5e-8, vibration=shaken(1e-8))
    with pytest.raises(ck.PlanError, match="AdhesiveContact needs a loading without vibration"):
        ck.plan(near)


@pytest.mark.slow
def test_files_and_the_command_line(tmp_path, capsys):
    made = attrs.evolve(scene(VISCOUS, TENSION, vibration=shaken(1e-6)), name="a shaken plate")
    path = ck.save_scene(made, tmp_path / "scene.toml")
    assert ck.load_scene(path) == made
    assert "vibration of 1e-06 m at 20 Hz" in str(ck.plan(made))
    result = ck.simulate(ck.plan(made))
    again = ck.load_result(ck.save_result(result, tmp_path / "result"))
    assert again.scalars() == result.scalars()
    assert main(["run", str(path), "--out", str(tmp_path / "out")]) == 0
    assert "mean_pull" in capsys.readouterr().out
    assert (tmp_path / "out" / "cycles.png").stat().st_size > 1000
