"""Plans of contacts: what they prepare, once, and what they refuse before any solve."""

from __future__ import annotations

from concurrent.futures import ThreadPoolExecutor

import loadings
import numpy as np
import pytest

import contactkit as ck
from contactkit.contact import grid, prepared
from contactkit.contact.effects.elasticity import LayeredHalfSpace
from contactkit.contact.effects.plasticity import HardnessLimit
from contactkit.contact.plan import plan_contact

STEEL = ck.Material(young_modulus=210e9, poisson_ratio=0.3, hardness=7.5e9)
FILM = ck.Layer(
    material=ck.Material(young_modulus=280e9, poisson_ratio=0.25, hardness=1.5e10), thickness=2e-8
)
ROUGH = ck.GaussianRoughness(rms=1e-9, correlation_length=3e-7, cutoff=1.5e-7)
LIMIT = ck.HardnessLimit()


def planned(*effects, surface=ROUGH, periodic=True, grid=48, **imposed):
    scene = ck.ContactScene(
        interface=ck.Interface(
            lower=ck.Body(solid=ck.Stack(layers=(FILM,), substrate=STEEL)),
            upper=ck.Body(surface=surface, solid=STEEL),
        ),
        window=ck.Window(width=1e-6, periodic=periodic),
        loading=loadings.pressed(**(imposed or {"pressure": 5e7})),
        effects=(ck.LayeredHalfSpace(), *effects),
    )
    return ck.plan(scene, ck.Accuracy(grid=grid))


@pytest.fixture
def calls(monkeypatch):
    """How often heights, compliance, solver and hardness are made."""
    found = {}

    def count(owner, name):
        original = getattr(owner, name)

        def counted(*arguments, **named):
            found[name] = found.get(name, 0) + 1
            return original(*arguments, **named)

        monkeypatch.setattr(owner, name, counted)

    count(prepared, "combined_heights")
    count(prepared, "ContactSolver")
    count(grid, "_rough")
    for kind in (LayeredHalfSpace, HardnessLimit):
        original = kind.prepare

        def counted(self, *arguments, original=original, name=kind.__name__):
            found[name] = found.get(name, 0) + 1
            return original(self, *arguments)

        monkeypatch.setattr(kind, "prepare", counted)
    return found


ONCE = {
    "combined_heights": 1,
    "ContactSolver": 1,
    "_rough": 1,
    "LayeredHalfSpace": 1,
    "HardnessLimit": 1,
}


def test_a_plan_prepares_and_a_solve_only_solves(calls):
    plan = planned(LIMIT)
    assert calls == ONCE
    first, again = ck.solve(plan), ck.solve(plan)
    assert calls == ONCE
    assert first.status == "converged"
    np.testing.assert_array_equal(first.pressure, again.pressure)


def test_another_load_prepares_nothing(calls):
    plan = planned(LIMIT)
    for pressure in (2e7, 8e7):
        there = plan.with_loading(ck.Pressing(pressure=pressure))
        assert ck.solve(there).mean_pressure == pytest.approx(pressure)
    there = plan.with_loading(ck.Approach(approach=1e-9))
    assert ck.solve(there).approach == pytest.approx(1e-9)
    assert calls == ONCE
    with pytest.raises(ck.InfeasibleError, match=r"reaches H\*A"):
        plan.with_loading(ck.Pressing(pressure=2e10))


def test_what_was_prepared_serves_a_like_plan_and_no_other():
    plan = planned()
    same = plan_contact(planned(LIMIT).scene, plan.accuracy, like=plan)
    assert same.prepared is plan.prepared
    before = plan.prepared
    other = plan_contact(plan.scene, ck.Accuracy(grid=32), like=plan)
    assert other.prepared is not before
    assert other.heights.shape == (32, 32)


def test_a_result_keeps_its_plan_but_not_what_that_had_prepared():
    plan = planned()
    result = ck.solve(plan)
    assert result.plan.scene is plan.scene
    assert result.heights is plan.heights
    assert result.plan.prepared is not plan.prepared
    np.testing.assert_allclose(ck.solve(result.plan).pressure, result.pressure)


def test_threads_may_share_a_plan():
    plan = planned(LIMIT)
    plans = [plan.with_loading(ck.Pressing(pressure=p)) for p in (2e7, 4e7, 6e7, 8e7)]
    alone = [ck.solve(one).pressure for one in plans]
    with ThreadPoolExecutor(4) as pool:
        together = [result.pressure for result in pool.map(ck.solve, plans)]
    for one, other in zip(alone, together, strict=True):
        np.testing.assert_array_equal(one, other)


@pytest.mark.parametrize(
    ("given", "error", "said"),
    [
        ({"grid": 8}, ck.DescriptionError, "cutoff must be at least two pixels"),
        (
            {"surface": ck.Wave(amplitude=1e-9, wavelength=3e-7)},
            ck.DescriptionError,
            "fit a whole number of times",
        ),
        ({"surface": ck.Sphere(radius=5e-7)}, ck.DescriptionError, "exceed half the diagonal"),
        ({"approach": 1e-7}, ck.InfeasibleError, "reaches the mean plane"),
    ],
)
def test_a_plan_refuses_what_a_solve_could_not_do(given, error, said):
    with pytest.raises(error, match=said):
        planned(**given)
