"""Plans of contacts: what they prepare, once, and what they refuse before any solve."""

from __future__ import annotations

from concurrent.futures import ThreadPoolExecutor

import loadings
import numpy as np
import pytest

import contactkit as ck
from contactkit.contact import prepared
from contactkit.contact.effects.elasticity import LayeredHalfSpace
from contactkit.contact.effects.friction import FrictionCoupling
from contactkit.contact.effects.plasticity import HardnessLimit
from contactkit.contact.plan import unprepared_plan
from contactkit.roughness import random_surfaces

pytestmark = pytest.mark.filterwarnings("ignore::contactkit.errors.ValidityWarning")

STEEL = ck.Material(young_modulus=210e9, poisson_ratio=0.3, hardness=7.5e9)
HARD = ck.Material(young_modulus=210e9, poisson_ratio=0.2, hardness=2e10)
FILM = ck.Layer(
    material=ck.Material(young_modulus=280e9, poisson_ratio=0.25, hardness=1.5e10), thickness=2e-8
)
ROUGH = ck.GaussianRoughness(rms=1e-9, correlation_length=3e-7, cutoff=1.5e-7)
LIMIT = ck.HardnessLimit()


def planned(*effects, surface=ROUGH, periodic=True, grid=48, **imposed):
    scene = ck.ContactScene(
        interface=ck.Interface(
            lower=ck.Body(solid=ck.Stack(layers=(FILM,), substrate=STEEL)),
            upper=ck.Body(surface=surface, solid=HARD),
            meniscus=ck.Meniscus(liquid=ck.load_liquid("water")),
        ),
        window=ck.Window(width=1e-6, periodic=periodic),
        loading=loadings.pressed(**(imposed or {"pressure": 5e7})),
        effects=(ck.LayeredHalfSpace(), *effects),
    )
    return ck.plan(scene, ck.Accuracy(grid=grid))


@pytest.fixture
def calls(monkeypatch):
    """How often heights, compliance, solver, hardness and the coupling of friction are made."""
    found = {}

    def count(owner, name):
        original = getattr(owner, name)

        def counted(*arguments, **named):
            found[name] = found.get(name, 0) + 1
            return original(*arguments, **named)

        monkeypatch.setattr(owner, name, counted)

    count(prepared, "combined_heights")
    count(prepared, "ContactSolver")
    count(random_surfaces, "gaussian_exponential")
    for kind in (LayeredHalfSpace, HardnessLimit, FrictionCoupling):
        original = kind.prepare

        def counted(self, *arguments, original=original, name=kind.__name__):
            found[name] = found.get(name, 0) + 1
            return original(self, *arguments)

        monkeypatch.setattr(kind, "prepare", counted)
    return found


ONCE = {
    "combined_heights": 1,
    "ContactSolver": 1,
    "gaussian_exponential": 1,
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


WAVE = ck.Wave(amplitude=5e-8, wavelength=1e-6)
VARYING = ck.HardnessLimit(rule=ck.ContinuousHardness(shift=0.0))
SELF_CONSISTENT = ck.FilmMeniscus(film_thickness=5e-10, self_consistent=True)
SLIDING = (ck.FrictionTraction(coefficient=0.3), ck.FrictionCoupling())


@pytest.mark.parametrize(
    ("effects", "at_least"),
    [
        ((VARYING,), 2),
        ((ck.HardnessLimit(rule=ck.ContinuousHardness(shift=0.0, displacement="local")),), 2),
        ((VARYING, *SLIDING), 3),
        ((VARYING, SELF_CONSISTENT), 3),
        ((VARYING, *SLIDING, SELF_CONSISTENT), 4),
    ],
    ids=["hardness", "local hardness", "friction", "film", "all"],
)
def test_outer_iterations_prepare_nothing(calls, effects, at_least):
    """They solve the contact again and again, with what the plan has prepared once."""
    result = ck.solve(planned(*effects, surface=WAVE, pressure=1e9))
    assert result.work.n_solves >= at_least
    wave = {name: 1 for name in ONCE if name != "gaussian_exponential"}
    coupled = {"FrictionCoupling": 1} if SLIDING[1] in effects else {}
    assert calls == wave | coupled


def test_a_study_prepares_once_for_all_loads(calls):
    """The hardness belongs to each of its plans, and that of the check before any solve."""
    scene = planned(LIMIT).scene
    calls.clear()
    found = ck.study(scene, {"loading.pressure": [2e7, 4e7, 8e7]}, ck.Accuracy(grid=48))
    assert not found.failed
    assert calls == ONCE | {"HardnessLimit": 4}
    calls.clear()
    layers = "interface.lower.solid.layers.0.thickness"
    ck.study(scene, {layers: [2e-8, 4e-8]}, ck.Accuracy(grid=48))
    assert calls == dict.fromkeys(ONCE, 2) | {"HardnessLimit": 3}


def test_a_load_displacement_curve_prepares_once(calls):
    soft = ck.HardnessLimit(rule=ck.ConstantHardness(hardness=1e9))
    scene = planned(soft, periodic=False, pressure=4e8).scene
    calls.clear()
    curve = ck.load_displacement(scene, points=6, accuracy=ck.Accuracy(grid=48))
    assert curve.unloading
    assert calls == ONCE


def test_what_was_prepared_serves_a_like_plan_and_no_other():
    plan = planned()
    same = unprepared_plan(planned(LIMIT).scene, plan.accuracy).prepare(like=plan)
    assert same.prepared is plan.prepared
    before = plan.prepared
    other = unprepared_plan(plan.scene, ck.Accuracy(grid=32)).prepare(like=plan)
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
