"""Equality of what holds an array: by its numbers, so that nothing prepared serves another."""

from __future__ import annotations

import numpy as np
import pytest

import contactkit as ck

MAP = np.array([[0.0, 1e-9, 0.0], [1e-9, 3e-9, 1e-9]])
MASK = np.array([[True, False, False], [False, False, False]])


@pytest.mark.parametrize(
    ("make", "others"),
    [
        (
            lambda **given: ck.Heights(**{"heights": MAP, "pixel_size": 1e-8} | given),
            [
                {"heights": 2.0 * MAP},
                {"heights": MAP[:, :2]},
                {"pixel_size": 2e-8},
                {"is_periodic": True},
                {"holes": MASK},
            ],
        ),
        (
            lambda **given: ck.Image(**{"coverage": MASK, "pixel_size": 1e-8} | given),
            [{"coverage": ~MASK}, {"coverage": MASK[:, :2]}, {"pixel_size": 2e-8}],
        ),
    ],
    ids=["Heights", "Image"],
)
def test_objects_are_equal_by_their_numbers(make, others):
    one = make()
    assert one == make()
    assert hash(one) == hash(make())
    for given in others:
        assert one != make(**given), given


@pytest.mark.filterwarnings("ignore::contactkit.errors.ValidityWarning")
def test_each_surface_of_a_study_is_pressed():
    """Once all `Heights` were equal, and a study took the first for every other."""
    waves = [
        ck.Heights(heights=f * np.tile(MAP, (4, 3)), pixel_size=1e-8, is_periodic=True)
        for f in (1.0, 2.0, 3.0)
    ]

    def scene(surface):
        solid = ck.Material(name="solid", young_modulus=1e9, poisson_ratio=0.3)
        return ck.ContactScene(
            interface=ck.Interface(lower=ck.Body(solid=solid), upper=surface),
            window=ck.Window(),
            loading=ck.Pressing(pressure=1e8),
            effects=(ck.HalfSpace(),),
        )

    plans = [ck.plan(scene(surface)) for surface in waves]
    assert not plans[0].has_interface_of(plans[1])
    found = ck.study(scene(waves[0]), {"interface.upper.surface": waves})
    alone = [ck.solve(plan).max_pressure for plan in plans]
    np.testing.assert_allclose(found["max_pressure"], alone, rtol=1e-6)
    assert alone[2] > 1.2 * alone[0]  # steeper
