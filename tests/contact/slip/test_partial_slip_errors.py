"""Partial slip that cannot be: each message names the field, the value and the cure."""

from __future__ import annotations

import numpy as np
import pytest
from attrs import evolve

import contactkit as ck
from contactkit.files.structure import field_value

pytestmark = pytest.mark.errors

SOLID = ck.Material(young_modulus=1e9, poisson_ratio=0.3)
HALF = (ck.TangentialStep(ratio=0.5),)


def scene(*effects):
    return ck.ContactScene(
        interface=ck.Interface(
            lower=ck.Body(solid=SOLID), upper=ck.Wave(amplitude=1e-9, wavelength=1e-6)
        ),
        window=ck.Window(width=1e-6),
        loading=ck.Pressing(pressure=1e6),
        effects=(ck.HalfSpace(), *effects),
    )


def test_a_force_beyond_full_sliding_is_refused():
    path = (ck.TangentialStep(ratio=0.5), ck.TangentialStep(force=3.1e-7))
    made = ck.plan(scene(ck.PartialSlip(coefficient=0.3, path=path)), ck.Accuracy(grid=16))
    expected = r"path\[1\].force = 3.1e-07 N exceeds .* 3e-07 N; impose a displacement"
    with pytest.raises(ck.InfeasibleError, match=expected):
        ck.solve(made)


@pytest.mark.parametrize(
    ("given", "expected"),
    [
        ({}, r"exactly one of force \[N\] or displacement \[m\] or ratio \[-\], got 'none'"),
        ({"force": 1.0, "ratio": 0.1}, "got .'force', 'ratio'."),
        ({"ratio": 1.01}, "ratio must lie between -1 and 1, .*beyond, impose a displacement"),
        ({"ratio": 0.5, "steps": 0}, "steps must be a whole number of at least 1"),
        ({"force": float("nan")}, "force must be a finite number"),
    ],
)
def test_a_step_has_one_target(given, expected):
    with pytest.raises(ck.DescriptionError, match=expected):
        ck.TangentialStep(**given)


@pytest.mark.parametrize(
    ("given", "expected"),
    [
        ({"path": ()}, "path must be at least one TangentialStep"),
        ({"path": (0.5,)}, "path must be at least one TangentialStep"),
        ({"path": HALF, "components": 3}, "components must be 1 or 2"),
        ({"path": HALF, "components": 2.0}, "components must be 1 or 2, got 2.0"),
        ({"path": HALF, "guided": "no"}, "guided must be a bool, got 'no'"),
        (
            {"path": HALF, "coefficient": -0.1},
            r"coefficient must lie between 0 and 1000, got -0\.1$",
        ),
        (
            {"path": HALF, "coefficient": 2e3},
            "must lie between 0 and 1000, got 2000.0; 1000 holds wherever there is pressure",
        ),
        ({"path": HALF, "pressing_rtol": 0.2}, "pressing_rtol must be at most 0.1, .* few press"),
        ({"path": HALF, "pressing_rtol": 0.0}, "pressing_rtol must be positive"),
        ({"path": HALF, "pressing_steps": 0}, "pressing_steps must be"),
        ({"path": HALF, "rtol": 0.0}, "rtol must be positive"),
        ({"path": HALF, "rtol": 0.1}, "rtol must be at most 0.001, got 0.1"),
    ],
)
def test_an_effect_says_what_is_wrong(given, expected):
    with pytest.raises(ck.DescriptionError, match=expected):
        ck.PartialSlip(**{"coefficient": 0.3, **given})


def test_a_plan_refuses_what_does_not_fit():
    slip = ck.PartialSlip(coefficient=0.3, path=HALF)
    with pytest.raises(ck.PlanError, match="PartialSlip and FrictionTraction exclude each other"):
        ck.plan(scene(slip, ck.FrictionTraction(coefficient=0.3)))
    turned = (ck.TangentialStep(ratio=0.5, direction=1.0),)
    with pytest.raises(ck.PlanError, match="components=2 for path steps of another direction"):
        ck.plan(scene(ck.PartialSlip(coefficient=0.3, path=turned)))


def test_a_path_has_no_further_steps():
    part = ck.solve(ck.plan(scene(ck.PartialSlip(coefficient=0.3, path=HALF)))).of(ck.PartialSlip)
    assert part.end_of(-1) == part.end_of(0) == 1
    with pytest.raises(ck.DescriptionError, match="must be a step of the path, 0 to 0, got 1"):
        part.energy_loss(0, 1)


def test_a_free_sheet_under_a_tangential_load_is_refused_before_the_solve():
    slip = ck.PartialSlip(coefficient=0.3, path=HALF)
    for bonded, periodic, is_refused in (
        (False, False, True),
        (True, False, False),
        (False, True, False),
    ):
        sheet = ck.Stack(
            layers=(ck.Layer(material=SOLID, thickness=1e-7),),
            substrate=ck.RigidBase(bonded=bonded),
        )
        made = evolve(
            scene(slip),
            interface=ck.Interface(
                lower=ck.Body(solid=sheet),
                upper=ck.Paraboloid(radius=1e-6) if not periodic else scene().interface.upper,
            ),
            window=ck.Window(width=1e-6, periodic=periodic),
            effects=(ck.LayeredHalfSpace(), slip),
        )
        if is_refused:
            with pytest.raises(ck.PlanError, match=r"RigidBase\(bonded=True\) .*; bond it"):
                ck.plan(made, ck.Accuracy(grid=16))
        else:
            ck.plan(made, ck.Accuracy(grid=16))


def test_a_plan_says_its_path_in_words():
    path = (
        ck.TangentialStep(ratio=0.5, steps=np.int64(3)),
        ck.TangentialStep(displacement=1e-9, direction=0.5),
    )
    text = str(ck.plan(scene(ck.PartialSlip(coefficient=0.3, path=path, components=2))))
    assert "path=(ratio 0.5 in 3 steps; displacement 1e-09 m at 0.5 rad)" in text
    assert "TangentialStep" not in text


@pytest.mark.parametrize(
    "made",
    [
        ck.TangentialStep(ratio=0.5, steps=np.int64(3)),
        ck.PlasticHistory(pressures=(1e6,), steps=np.uint8(3)),
    ],
)
def test_whole_numbers_of_arrays_are_whole_numbers(made):
    assert made.steps == 3
    assert type(made.steps) is int
    with pytest.raises(ck.DescriptionError, match="steps must be a whole number"):
        evolve(made, steps=np.bool_(True))
    with pytest.raises(ck.DescriptionError, match="steps must be a whole number"):
        evolve(made, steps=3.0)


def test_a_word_for_a_whole_number_in_a_file_is_refused():
    with pytest.raises(ck.DescriptionError, match=r"steps must be a whole number .*got 'four'$"):
        ck.TangentialStep(ratio=0.5, steps=field_value(ck.TangentialStep, "steps", "four"))
