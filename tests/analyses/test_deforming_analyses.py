"""Analyses of films between deforming bodies: speeds, pulls, rests, humidities, frequencies."""

import json
import math
from pathlib import Path

import attrs
import numpy as np
import pytest

import contactkit as ck

CASES = json.loads((Path(__file__).parents[1] / "data/wet.json").read_text())["cases"]
OIL = ck.Liquid(name="oil", viscosity=0.1, surface_tension=0.03)
WATER = ck.Liquid(
    name="water", viscosity=1e-3, surface_tension=0.072, density=998.2, molar_mass=0.018015
)
DRAFT = ck.Accuracy(film_rtol=1e-2)


def scene(loading, *effects, modulus=353553.39, rim=8.0, meniscus=None):
    gel = ck.Material(young_modulus=0.75 * modulus, poisson_ratio=0.5)
    face = ck.Flat(radius=rim * math.sqrt(5e-3 * 1e-6))
    return ck.SeparationScene(
        interface=ck.Interface(
            lower=ck.Body(surface=face, solid=gel),
            upper=ck.Sphere(radius=5e-3),
            meniscus=meniscus or ck.Meniscus(liquid=OIL),
        ),
        loading=loading,
        effects=(ck.ElasticBodies(), ck.ViscousForce(), *effects),
    )


def opening(speed=1e-5):
    return ck.ImposedSpeed(speed=speed, initial_gap=1e-6, final_gap=5e-6)


@pytest.mark.slow
def test_pull_off_over_speed():
    curve = ck.pull_off_over_speed(scene(opening()), [1e-6, 1e-5], DRAFT)
    assert curve.beta == pytest.approx([0.1, 1.0], rel=1e-6)
    assert curve.pull_off_force / curve.rigid_force == pytest.approx([0.645, 0.369], rel=6e-3)
    assert {"force", "work"} <= set(curve.plot.available)


@pytest.mark.slow
def test_release_over_force_and_rest():
    pulled = ck.ImposedForce(force=1e-4, initial_gap=1e-6, final_gap=4e-6)
    curve = ck.release_over(scene(pulled), forces=[1e-4, 2e-4], accuracy=DRAFT)
    assert curve.axis == "force"
    assert 2.0 < curve.release_time[0] / curve.release_time[1] < 3.0
    rested = ck.PressAndPull(press=1e-5, rest=1.0, force=1e-4, initial_gap=1e-6, final_gap=4e-6)
    curve = ck.release_over(scene(rested), rests=[0.1, 3.0], accuracy=DRAFT)
    assert curve.release_time[1] > 1.2 * curve.release_time[0]


def test_moduli_are_those_of_the_reference():
    case = next(case for case in CASES if case["id"] == "modulus_D/Dc=1")
    given, values = case["inputs"], case["values"]
    made = scene(opening(), modulus=given["effective_modulus"], rim=200.0)
    curve = ck.modulus_curve(made, [given["angular_frequency"] / math.tau])
    assert curve.storage_modulus[0] == pytest.approx(values["storage"], rel=1e-4)
    assert curve.loss_modulus[0] == pytest.approx(values["loss"], rel=1e-4)
    assert curve.gap_over_crossover[0] == pytest.approx(1.0, rel=1e-6)


def test_moduli_meet_their_stiff_limits():
    curve = ck.modulus_curve(scene(opening(), modulus=1e11, rim=200.0), np.geomspace(1e-2, 1.0, 3))
    assert curve.storage_modulus == pytest.approx(curve.stiff_storage, rel=2e-2)
    assert curve.loss_modulus == pytest.approx(curve.stiff_loss, rel=1e-3)
    flat = scene(opening(), modulus=1e13)
    interface = attrs.evolve(flat.interface, upper=ck.Flat(radius=1e-3))
    curve = ck.modulus_curve(attrs.evolve(flat, interface=interface), [1.0])
    assert curve.loss_modulus == pytest.approx(curve.stiff_loss, rel=1e-3)


@pytest.mark.exhaustive
@pytest.mark.filterwarnings("ignore::contactkit.ValidityWarning")
def test_stiction_grows_with_the_time_of_rest():
    loading = ck.PressAndPull(press=1e-3, rest=1.0, speed=1e-4, initial_gap=5e-8, final_gap=5e-7)
    moist = ck.Meniscus(liquid=WATER, relative_humidity=0.99)
    made = scene(
        loading, ck.MeniscusForce(), ck.SolidContact(cutoff=1e-8), modulus=1e10, meniscus=moist
    )
    table = ck.stiction_table(made, [1e-5, 1e-2], [0.99, 0.995], DRAFT)
    force = table.pull_off_force.reshape(2, 2)
    assert (force > 0.0).all()
    assert table.relative_humidity.tolist() == [0.99, 0.995, 0.99, 0.995]
    assert (force[1] > force[0]).all()


@pytest.mark.errors
def test_what_they_do_not_know_is_refused():
    pulled = scene(ck.ImposedForce(force=1e-4, initial_gap=1e-6, final_gap=4e-6))
    with pytest.raises(ck.PlanError, match="ImposedSpeed"):
        ck.pull_off_over_speed(pulled, [1e-6])
    with pytest.raises(ck.PlanError, match="ImposedForce"):
        ck.release_over(scene(opening()), forces=[1.0])
    with pytest.raises(ck.PlanError, match="PressAndPull"):
        ck.release_over(pulled, rests=[1.0])
    with pytest.raises(ck.DescriptionError, match="exactly one of forces and rests"):
        ck.release_over(pulled)
    with pytest.raises(ck.DescriptionError, match="be positive and finite"):
        ck.pull_off_over_speed(scene(opening()), [-1e-6])
    with pytest.raises(ck.PlanError, match="PressAndPull"):
        ck.stiction_table(pulled, [1.0], [0.5])
    volume = ck.Meniscus(liquid=OIL, volume=1e-15)
    made = scene(opening(), ck.MeniscusForce(), modulus=1e10, meniscus=volume)
    with pytest.raises(ck.PlanError, match="needs a flooded film"):
        ck.modulus_curve(made, [1.0])
