"""Tables of a live page between their nodes: a run of the scene there says how good they are."""

from __future__ import annotations

import base64
import gzip
import warnings

import numpy as np
import pytest
from page_scenes import film
from wasm import Wasm, needs_runtime

import contactkit as ck
from contactkit.liquids.temperature_table import liquid_table
from contactkit.live_page.family import Family, family_of, with_values
from contactkit.live_page.scene import kernel_scene
from contactkit.live_page.sliders import family_sliders, sliders_of
from contactkit.live_page.validity import (
    checked,
    logs_of,
    rules_of,
    worst_of,
)
from contactkit.separation.validity import path_of

pytestmark = pytest.mark.slow

STANDARD = ck.Accuracy.standard
SPAN = (3e-7, 1e-4)


@pytest.fixture(scope="module")
def kernel():
    return kernel_scene(film(), STANDARD)


@pytest.fixture(scope="module")
def rules():
    return rules_of(film(), STANDARD, 5e-6)


@pytest.fixture(scope="module")
def family(kernel, rules):
    sliders = family_sliders(kernel, liquid_table(film().meniscus.liquid))
    found = family_of(kernel, sliders, STANDARD, rules, SPAN)
    assert isinstance(found, Family)
    return found


def simulated(scene):
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        return ck.simulate(ck.plan(scene))


def test_geometry_and_angle_are_what_moves(family):
    assert [slider.name for slider in family.sliders] == ["volume", "radius", "angle"]
    assert 0.0 < family.error < 2e-3


def test_at_a_node_the_numbers_are_those_of_the_node(family, kernel):
    values = [
        slider.value_at(nodes[1])
        for slider, nodes in zip(family.sliders, family.nodes, strict=True)
    ]
    found = family.at(values)
    of = found[family.columns]
    node = len(family.nodes[2]) * (len(family.nodes[1]) + 1) + 1
    change = family.changes[node]
    base = family.base[family.columns]
    assert np.allclose(
        of, np.where(family.logs, base * np.exp(change), base + change), rtol=1e-9, atol=0.0
    )


PLACES = [(3.3e-10, 5.1e-3, 1.0), (0.5e-10, 1.8e-3, 0.7)]


@needs_runtime
@pytest.mark.parametrize("place", PLACES, ids=str)
def test_a_motion_between_the_nodes_is_that_of_the_scene_there(family, place):
    scene = with_values(film(), dict(zip(family.sliders, place, strict=True)))
    wasm = Wasm()
    wasm.begin(family.at(place)[: family.count], force=40.0)
    how, numbers, _ = wasm.motion()
    result = simulated(scene)
    found = {name: value for name, (value, _) in result.scalars().items()}
    assert how == result.status
    for name in ("release_time", "peak_force", "release_speed", "dissipated_work"):
        assert numbers[name] == pytest.approx(found[name], rel=family.error), name


@pytest.mark.parametrize("place", PLACES, ids=str)
def test_validity_between_the_nodes_is_that_of_the_scene_there(family, rules, place):
    scene = with_values(film(), dict(zip(family.sliders, place, strict=True)))
    result = simulated(scene)
    path = path_of(result.plan, result.columns)
    logs = family.at(place)[family.count :]
    known = {one.name: one.value for one in result.validity}
    for i, rule in enumerate(rules.rules):
        worst = worst_of(rules, logs, i, path)
        assert worst == pytest.approx(known[rule.name], rel=0.05), rule.name


def test_the_numbers_of_the_start_are_those_of_the_run(rules):
    result = simulated(film())
    path = path_of(result.plan, result.columns)
    logs = logs_of(film(), STANDARD, rules, SPAN)
    kept = checked(rules, logs, path, result.validity)
    assert {"Reynolds number", "fingering number", "pressure over bulk modulus"} <= {
        rule.name for rule in kept.rules
    }
    assert set(kept.missing) | {rule.name for rule in kept.rules} == {
        one.name for one in result.validity
    }
    # A rule that is off is not kept, but named.
    off = [worst * 1.3 for worst in np.exp(logs)]
    assert len(checked(rules, np.log(off), path, result.validity).rules) < len(kept.rules)


def test_a_number_follows_the_liquid_as_measured(rules):
    powers = {rule.name: dict(rule.liquid) for rule in rules.rules}
    assert powers["Reynolds number"] == {"viscosity": -1.0, "density": 1.0}
    assert powers["fingering number"] == {"viscosity": 1.0, "surface_tension": -1.0}


def test_sliders_have_the_words_and_limits_of_the_field(kernel):
    sliders = {one.name: one for one in sliders_of(kernel, liquid_table(film().meniscus.liquid))}
    assert [*sliders] == ["force", "mass", "initial_gap", "final_gap", "temperature", "strength"]
    assert sliders["mass"].unit == "g"
    assert sliders["initial_gap"].high < film().loading.final_gap
    assert sliders["temperature"].low == pytest.approx(253.15)
    assert sliders["strength"].low == pytest.approx(101_325.0)


def test_the_liquid_is_that_of_its_laws_between_the_nodes():
    liquid = film().meniscus.liquid
    table = liquid_table(liquid)
    for temperature in (254.3, 300.1, 351.7, 422.9):
        state = liquid.at(temperature)
        for name in ("viscosity", "surface_tension", "density"):
            assert table.at(name, temperature) == pytest.approx(state.given(name), rel=table.error)
    assert liquid_table(ck.Liquid(name="x", viscosity=0.1)) is None


def test_what_is_packed_is_packed_the_same_every_time():
    from contactkit.live_page.assembly import packed

    assert gzip.decompress(base64.b64decode(packed(b"abc"))) == b"abc"
    assert packed(b"abc") == packed(b"abc")
