"""Partial slip that cannot be: each message names the field, the value and the cure."""

from __future__ import annotations

import pytest

import contactkit as ck

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
        ({"path": HALF, "coefficient": -0.1}, "coefficient must lie between 0 and 1"),
        ({"path": HALF, "rtol": 0.0}, "rtol must be positive"),
        ({"path": HALF, "rtol": 0.1}, "rtol must be at most 0.001, got 0.1"),
    ],
)
def test_an_effect_says_what_is_wrong(given, expected):
    with pytest.raises(ck.DescriptionError, match=expected):
        ck.PartialSlip(**{"coefficient": 0.3, **given})


def test_a_plan_refuses_what_does_not_fit():
    slip = ck.PartialSlip(coefficient=0.3, path=HALF)
    with pytest.raises(ck.PlanError, match="without FrictionTraction, which slides everywhere"):
        ck.plan(scene(slip, ck.FrictionTraction(coefficient=0.3)))
    with pytest.raises(ck.PlanError, match="without SubsurfaceStress, which does not have its"):
        ck.plan(scene(slip, ck.SubsurfaceStress()))
    turned = (ck.TangentialStep(ratio=0.5, direction=1.0),)
    with pytest.raises(ck.PlanError, match="components=2 for path steps of another direction"):
        ck.plan(scene(ck.PartialSlip(coefficient=0.3, path=turned)))


def test_a_path_has_no_further_steps():
    part = ck.solve(ck.plan(scene(ck.PartialSlip(coefficient=0.3, path=HALF)))).of(ck.PartialSlip)
    assert part.end_of(-1) == part.end_of(0) == 1
    with pytest.raises(ck.DescriptionError, match="must be a step of the path, 0 to 0, got 1"):
        part.energy_loss(0, 1)
