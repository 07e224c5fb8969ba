"""A rigid film in series with a spring against the engine of deforming bodies."""

import math

import numpy as np
import pytest
from selection import quick

import contactkit as ck
from contactkit.app.scene_fmu import fmu_start
from contactkit.lubrication.elastohydrodynamic import response
from contactkit.separation.deforming.maxwell import HOLDS_TO, series_pull, series_stiffness

OIL = ck.Liquid(name="oil", viscosity=0.1)
R, GAP, SPEED = 5e-3, 1e-6, 1e-5
RIM = 8.0 * math.sqrt(R * GAP)
FORCE = ck.ImposedForce(force=1e-6, mass=1e-3, initial_gap=GAP, final_gap=4e-6)


def scene(modulus, loading, upper=None):
    return ck.SeparationScene(
        interface=ck.Interface(
            lower=ck.Body(
                surface=ck.Flat(radius=RIM),
                solid=ck.Material(young_modulus=0.75 * modulus, poisson_ratio=0.5),
            ),
            upper=upper or ck.Sphere(radius=R),
            meniscus=ck.Meniscus(liquid=OIL),
        ),
        loading=loading,
        effects=(ck.ElasticBodies(), ck.ViscousForce()),
    )


def test_the_spring_is_that_of_small_vibrations():
    """k = G''^2/G' of the exact limits."""
    for args, limit in (
        ((R, math.sqrt(R * GAP)), response.sphere_stiff_limit(R, GAP, 1e9, 0.1, 50.0)),
        ((math.inf, R), response.flat_stiff_limit(R, GAP, 1e9, 0.1, 50.0)),
    ):
        storage, loss = limit
        assert series_stiffness(*args, 1e9) == pytest.approx(loss**2 / storage, rel=1e-12)


@pytest.mark.parametrize(
    ("beta", "peak", "late"), quick([(1e-3, 4e-3, 1e-3), (HOLDS_TO, 2e-2, 1.2e-2)], long=[1])
)
def test_a_pull_is_right_to_what_it_states(beta, peak, late):
    modulus = 0.1 * SPEED * R**1.5 / (beta * GAP**2.5)
    loading = ck.ImposedSpeed(speed=SPEED, initial_gap=GAP, final_gap=3e-6)
    found = ck.simulate(ck.plan(scene(modulus, loading)))

    def damping(gap):
        rim = gap + RIM**2 / (2.0 * R)
        return 6.0 * math.pi * 0.1 * R**2 * (1.0 / gap - 1.0 / rim - (rim - gap) / rim**2)

    def spring(gap):
        return series_stiffness(R, math.sqrt(R * gap), modulus)

    force = series_pull(damping, spring, GAP, SPEED, found["time"])
    largest = found["pull"].max()
    assert force.max() == pytest.approx(largest, rel=peak)
    settled = found["time"] > 0.25 * GAP / SPEED
    error = np.abs(force - found["pull"])
    assert error[settled].max() < late * largest
    assert error.max() < 5e-2 * largest
    # The spring matters: twice of it shows.
    stiffer = series_pull(damping, lambda gap: 2.0 * spring(gap), GAP, SPEED, found["time"])
    assert stiffer.max() > (1.0 + 2.0 * peak) * largest


@pytest.mark.errors
def test_a_python_fmu_is_refused():
    """Native ones are in tests/fmu/native/test_native_deforming.py."""
    with pytest.raises(ck.PlanError, match=r"this scene has ElasticBodies: build it --native"):
        fmu_start(scene(1e9, FORCE), ck.Accuracy.standard)
