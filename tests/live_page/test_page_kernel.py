"""The kernel of a live page against a run of the same scene: WebAssembly beside Python."""

from __future__ import annotations

import warnings

import numpy as np
import pytest
from attrs import evolve
from page_scenes import film
from wasm import Wasm, needs_runtime

import contactkit as ck
from contactkit.live_page.scene import kernel_scene

pytestmark = [pytest.mark.slow, needs_runtime]

STANDARD = ck.Accuracy.standard
# Both solve the same steps: what is left is the tables, 1e-12, and the sums of some hundred steps.
ALIKE = 1e-10
TOLERANCE = 1e-7  # of motions whose steps differ by some: time_rtol over some hundred steps


@pytest.fixture(scope="module")
def wasm():
    return Wasm()


def simulated(scene):
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        return ck.simulate(ck.plan(scene), throw=False)


def moved(wasm, scene, variables=()):
    kernel = kernel_scene(scene, STANDARD)
    given = [(kernel.reference(name), value) for name, value in variables]
    pull = scene.loading
    wasm.begin(kernel.numbers(), given, pull.force, pull.rise_time, pull.time_limit)
    return wasm.motion()


def assert_alike(numbers, result, rtol=ALIKE):
    found = {name: value for name, (value, _) in result.scalars().items()}
    names = ("release_time", "release_speed", "peak_force", "dissipated_work", "viscous_impulse")
    for name in names:
        assert numbers[name] == pytest.approx(found[name], rel=rtol), name


def test_it_imports_nothing_and_shows_its_calls(wasm):
    assert [*wasm.module.imports] == []
    assert {"ck_page_open", "ck_page_step", "memory"} <= {one.name for one in wasm.module.exports}


SCENES = {
    "film": film(),
    "film without a cavity": film(cavity=False),
    "little liquid": film(volume=5e-11, cavity=False),
    "spring, speed": film(stiffness=1e5, initial_speed=0.01, cavity=False),
    "sphere": evolve(
        film(volume=1e-12, cavity=False, force=0.05, mass=1e-4),
        interface=ck.Interface(
            lower=ck.Flat(),
            upper=ck.Sphere(radius=5e-3),
            meniscus=ck.Meniscus(liquid=film().meniscus.liquid, volume=1e-12),
        ),
    ),
}


@pytest.mark.parametrize("name", SCENES)
def test_a_motion_is_that_of_simulate(wasm, name):
    result = simulated(SCENES[name])
    how, numbers, _ = moved(wasm, SCENES[name])
    assert how == result.status == "released"
    same = numbers["n_steps"] == result.state.n_steps
    assert same or name == "spring, speed"
    assert_alike(numbers, result, ALIKE if same else TOLERANCE)


def test_a_pull_that_rises_is_followed(wasm):
    scene = film(rise_time=2e-5, cavity=False)
    how, numbers, _ = moved(wasm, scene)
    assert how == "released"
    assert_alike(numbers, simulated(scene), rtol=3e-6)


def test_variables_are_those_of_the_scene(wasm):
    """Set in the kernel or written in the scene: the same motion."""
    changed = film(mass=0.05, initial_gap=4e-6, final_gap=4e-5)
    state = changed.meniscus.liquid.at(330.0)
    variables = [("m", 0.05), ("h0", 4e-6), ("h_rel", 4e-5), ("eta", state.viscosity)]
    variables += [("gamma", state.surface_tension), ("dp_inception", 5e5)]
    effects = (*changed.effects[:2], ck.TensionLimit(strength=5e5))
    _, numbers, _ = moved(wasm, film(), variables)
    assert_alike(numbers, simulated(evolve(changed, temperature=330.0, effects=effects)))


def test_rows_lie_on_the_curves_of_the_run(wasm):
    result = simulated(film(cavity=False))
    _, _, rows = moved(wasm, film(cavity=False))
    time, gap, force = rows[:, 0], rows[:, 1], rows[:, 4]
    assert np.all(np.diff(time) >= 0.0)
    assert len(time) > 2 * result.state.n_steps
    assert np.allclose(np.interp(result["time"], time, gap), result.gap, rtol=1e-3, atol=0.0)
    total = result["meniscus_force"] + result["viscous_force"]
    late = result["time"] > 1e-6
    found = np.interp(result["time"], time, force)
    assert np.allclose(found[late], total[late], rtol=1e-2, atol=0.0)


def test_a_pull_that_is_too_weak_is_stuck(wasm):
    assert moved(wasm, film(force=0.05, cavity=False))[0] == "stuck"
    assert simulated(film(force=0.05, cavity=False)).status == "stuck"


def test_a_time_that_is_too_short_ends_it(wasm):
    assert moved(wasm, film(time_limit=1e-5))[0] == "late"


def test_forces_at_a_gap_are_those_of_the_plan(wasm):
    scene = film(cavity=False)
    made, kernel = ck.plan(scene), kernel_scene(scene, STANDARD)
    wasm.begin(kernel.numbers())
    assert wasm.end() == pytest.approx(made.film.end, rel=1e-12)
    for gap in (4e-6, 8e-6, 2e-5, 2.0 * made.film.end):
        assert wasm.at(gap, 1e-3)[4] == pytest.approx(made.force(gap, 1e-3), rel=1e-9)


WET = evolve(
    film(cavity=False),
    effects=(ck.VanDerWaalsForce(hamaker_constant=1e-19), *film(cavity=False).effects),
)


def test_each_force_is_that_of_its_effect(wasm):
    made, kernel = ck.plan(WET), kernel_scene(WET, STANDARD)
    wasm.begin(kernel.numbers())
    kinds = kernel.film.effects
    assert kinds == (ck.VanDerWaalsForce, ck.MeniscusForce, ck.ViscousForce)
    for gap in (4e-6, 8e-6):
        row = wasm.at(gap, 1e-3)
        for i, kind in enumerate(kinds):
            force = made.film.laws[kind].force(gap, 1e-3)
            assert row[11 + i] == pytest.approx(force, rel=1e-8), kind
        assert row[11:].sum() == pytest.approx(row[4], rel=1e-12)
        assert row[10] == pytest.approx(row[6], rel=1e-12), "no limit acts"


def test_a_limit_lowers_the_viscous_force_alone(wasm):
    scene = film(cavity=False)
    cut = ck.TensionLimit(strength=1e5, cavity="truncated")
    scene = evolve(scene, effects=(*scene.effects, cut))
    made = ck.plan(scene)
    wasm.begin(kernel_scene(scene, STANDARD).numbers())
    row = wasm.at(5e-6, 1e-2)
    assert row[10] > 2.0 * row[12]
    assert row[11] + row[12] == pytest.approx(made.force(5e-6, 1e-2), rel=1e-8)


@pytest.mark.parametrize(
    ("variables", "said"),
    [
        ([("h_rel", 1e-6)], "h_rel must exceed h0"),
        ([("m", -1.0)], "m must"),
        ([("dp_hold", 1e7)], "dp_hold must not exceed dp_inception"),
    ],
)
def test_the_kernel_says_what_is_wrong(wasm, variables, said):
    with pytest.raises(ValueError, match=said):
        moved(wasm, film(), variables)


def test_numbers_that_make_no_sense_are_refused(wasm):
    numbers = kernel_scene(film(), STANDARD).numbers()
    with pytest.raises(ValueError, match="makes no sense"):
        wasm.begin(numbers[:-1])
    with pytest.raises(ValueError, match="makes no sense"):
        wasm.begin([*numbers[:40], float("nan"), *numbers[41:]])
