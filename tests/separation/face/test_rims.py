"""Rim of liquid around a cavity on a face: whether a grid resolves it is a number of the run."""

from __future__ import annotations

import math

import pytest

import contactkit as ck

GAP, SPEED, ETA, AMBIENT = 10e-6, 5e-3, 0.1, 101_325.0


@pytest.fixture(scope="module")
def plan():
    """Rectangle of 10 mm by 20 mm, on the coarsest grid."""
    oil = ck.Liquid(name="oil", viscosity=ETA)
    face = ck.Flat(planform=ck.Rectangle(length=20e-3, width=10e-3))
    scene = ck.SeparationScene(
        interface=ck.Interface(upper=face, meniscus=ck.Meniscus(liquid=oil)),
        loading=ck.ImposedSpeed(speed=SPEED, initial_gap=GAP, final_gap=2 * GAP),
        effects=(ck.ViscousForce(), ck.TensionLimit(strength=2.0 * AMBIENT, cavity_pressure=0.0)),
    )
    return ck.plan(scene, ck.Accuracy(film_rtol=1e-2))


def rims(plan, *path):
    return {n.name: n for n in plan.validity(path) if n.name.startswith("rim of liquid")}


def test_the_narrowest_rim_of_a_run_over_cell_and_gap(plan):
    """The pressure falls by that of the cavity, not by the strength, over the width."""
    width = math.sqrt(GAP**3 * AMBIENT / (6.0 * ETA * SPEED))
    found = rims(plan, (GAP, SPEED), (2.0 * GAP, SPEED), (GAP, 0.1 * SPEED))
    cell = max(plan.film.cavity.grid.face.pixel_size)
    over_cell = found["rim of liquid over a cell of its grid"]
    assert over_cell.value == pytest.approx(width / cell, rel=1e-9)
    assert over_cell.is_valid is False
    over_gap = found["rim of liquid over its gap"]
    assert over_gap.value == pytest.approx(width / GAP, rel=1e-9)
    assert over_gap.is_valid is True


def test_a_film_that_does_not_cavitate_has_no_rim(plan):
    slow = 0.9 * 2.0 * AMBIENT / plan.film.cavity.tension(GAP, 1.0)
    assert not rims(plan, (GAP, slow), (GAP, -SPEED))
    assert rims(plan, (GAP, 1.3 * slow))
