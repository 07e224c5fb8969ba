"""The page of an injector: film and valve in WebAssembly beside the monolithic model."""

from __future__ import annotations

import json
import math

import numpy as np
import pytest
from attrs import evolve
from wasm import Valve, needs_runtime

from contactkit.accuracy import Accuracy
from contactkit.liquids.liquid import Liquid
from contactkit.live_page.page import page_data
from contactkit.live_page.valve_page import drive_numbers
from contactkit.models.injector.assumptions import RANGES
from contactkit.models.injector.delays import delay, dry_delay
from contactkit.models.library import bundled_device
from contactkit.separation.effects.viscous import TensionLimit, ViscousForce
from contactkit.studies.paths import axes, changed

INJECTOR = bundled_device("fuel-injector")
WITHIN = 1e-4  # of a delay, as the page states: coupling in steps of 5 us


@pytest.fixture(scope="module")
def data():
    return page_data(INJECTOR)


@pytest.fixture(scope="module")
def valve(data):
    return Valve(data)


def test_the_sliders_are_the_assumptions_of_the_device(data):
    names = [one["name"] for one in data["sliders"]]
    assert names[:3] == ["ambient", "tension", "cavity"]
    assert {"temperature", "radius", "mass", "spring_preload", "coil_turns"} <= {*names}
    assert len(names) == len({*names}) >= 19
    for one in data["sliders"]:
        assert one["low"] <= one["value"] <= one["high"], one["name"]
    json.dumps(data, allow_nan=False)
    assert data["scene"]["device"] == "fuel-injector"
    assert {rule["name"] for rule in data["rules"]} >= {
        "Reynolds number",
        "slenderness of the film",
    }


def test_tensions_are_those_of_the_scene(data):
    start = {one["name"]: one["value"] for one in data["sliders"]}
    limit = INJECTOR.tension_limit
    assert start["ambient"] == limit.ambient_pressure
    assert start["ambient"] + start["tension"] == pytest.approx(limit.tension, rel=1e-14)
    assert start["cavity"] == pytest.approx(limit.pressure_in_cavity, abs=1e-9)


PLAIN = Liquid(name="oil", viscosity=0.1, density=870.0)
CUT = TensionLimit(strength=1e6, cavity="truncated")


@pytest.mark.slow
@needs_runtime
@pytest.mark.parametrize("limit", [None, CUT], ids=["never cavitates", "truncated"])
def test_an_injector_with_a_plain_oil(limit):
    """No law of the temperature, no cavity: the sliders that are left, and the same delay."""
    meniscus = evolve(INJECTOR.interface.meniscus, liquid=PLAIN)
    scene = evolve(
        INJECTOR,
        interface=evolve(INJECTOR.interface, meniscus=meniscus),
        effects=(ViscousForce(), *filter(None, (limit,))),
    )
    found = page_data(scene)
    names = {one["name"] for one in found["sliders"]}
    assert "viscosity" in names
    assert not {"temperature", "ambient", "tension", "cavity"} & names
    assert (found["limit"], found["pressures"], found["temperatures"]) == (-1, (), ())
    expected = delay(scene, scene.temperature, rtol=1e-8)
    assert Valve(found).run()[0] == pytest.approx(expected, rel=WITHIN, nan_ok=True)


@pytest.mark.slow
def test_an_oil_that_never_cavitates_has_no_sliders_of_tension():
    film = tuple(one for one in INJECTOR.effects if one is not INJECTOR.tension_limit)
    found = page_data(evolve(INJECTOR, effects=film))
    assert not {"ambient", "tension", "cavity"} & {one["name"] for one in found["sliders"]}
    assert found["limit"] == -1
    assert found["pressures"] == ()


@pytest.mark.slow
@needs_runtime
@pytest.mark.parametrize("temperature", INJECTOR.study.temperatures)
def test_the_delay_is_that_of_the_monolithic_model(valve, temperature):
    """Worse in the cold near 13 bar; at 15 bar in warm oil only; at 20 bar never."""
    for bars in (1.01325, 13.0, 15.0, 20.0):
        expected = delay(INJECTOR, temperature, ambient_pressure=bars * 1e5, rtol=1e-8)
        found, _ = valve.run(ambient=bars * 1e5, temperature=temperature)
        assert math.isnan(found) == math.isnan(expected), bars
        assert math.isnan(found) or found == pytest.approx(expected, rel=WITHIN), bars


@pytest.mark.slow
@needs_runtime
def test_the_delay_without_a_film_is_that_of_the_device(valve):
    assert valve.run(dry=True)[0] == pytest.approx(dry_delay(INJECTOR), rel=WITHIN)


@pytest.mark.slow
@needs_runtime
def test_an_oil_that_sustains_its_strength_is_held_longer(valve):
    found, _ = valve.run(cavity=-1e7)  # no cavity bears more than the oil: -8.98675 bar
    expected = delay(INJECTOR, INJECTOR.temperature, cavity_pressure=-math.inf, rtol=1e-8)
    assert found == pytest.approx(expected, rel=WITHIN)


VALVE = [one for one in RANGES if "valve." in one or one.startswith("loading.")]


@pytest.mark.slow
@needs_runtime
@pytest.mark.parametrize("paths", VALVE)
def test_each_slider_is_the_field_of_its_scene(valve, paths):
    """Moved in the page, or written in the scene and built again: the same cycle."""
    (axis,) = axes(INJECTOR, Accuracy(), {paths: [RANGES[paths].low]})
    scene = changed(INJECTOR, None, dict(zip(axis.paths, axis.values[0], strict=True))).scene
    places = [path.split(".") for path in axis.paths]
    (slider,) = (one for one in valve.data["sliders"] if one["places"] == places)
    _, moved = valve.run(until_release=False, **{slider["name"]: float(axis.values[0][0])})
    other = Valve(page_data(scene) if "loading" in paths else valve.data)
    other.drive = drive_numbers(scene)
    _, written = other.run(until_release=False)
    assert len(moved) == len(written)
    assert np.allclose(moved[:, :11], written[:, :11], rtol=1e-6, atol=1e-12)
    _, before = valve.run(until_release=False)
    assert len(before) != len(moved) or not np.allclose(moved[:, 10], before[:, 10], rtol=1e-6)
