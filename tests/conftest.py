"""Reference cases, and scenes built from them."""

from __future__ import annotations

import gc
import json
from pathlib import Path

import loadings
import pytest
from hypothesis import HealthCheck, settings

import contactkit as ck

DATA = Path(__file__).parent / "data"

# The same few examples every time, and no clock: a busy machine is no failure. With
# --hypothesis-profile=random and a seed, as `make test-release` has it, more and others each time.
UNTIMED = {
    "deadline": None,
    "suppress_health_check": [HealthCheck.too_slow, HealthCheck.filter_too_much],
}
settings.register_profile("repeatable", derandomize=True, max_examples=10, **UNTIMED)
settings.register_profile("random", database=None, print_blob=True, **UNTIMED)
settings.load_profile("repeatable")


def pytest_collection_modifyitems(items):
    """What is exhaustive is slow; first, before the marks are looked at."""
    for item in items:
        if item.get_closest_marker("exhaustive"):
            item.add_marker("slow")


def pytest_collection_finish():
    """Leave what was imported to the end: collecting it over and over takes a tenth of the run."""
    gc.collect()
    gc.freeze()
    gc.set_threshold(50_000, 20, 50)


@pytest.fixture(scope="session")
def release_cases():
    """Release of a mass from a film: parameters under ``case``, reference under ``values``."""
    return json.loads((DATA / "release.json").read_text(encoding="utf-8"))


@pytest.fixture(scope="session")
def viscous_cases():
    """Closed forms of the squeeze film, by their id."""
    cases = json.loads((DATA / "viscous.json").read_text(encoding="utf-8"))
    return {case["id"]: case for case in cases}


@pytest.fixture(scope="session")
def release_scene(release_cases):
    """Build the scene of a release case; keywords change its loading."""

    def build(name, *more, effects=None, meniscus=None, **loading):
        case = release_cases[name]["case"]
        oil = ck.Liquid(name="oil", viscosity=case["eta"], surface_tension=case["gamma"])
        film = {
            "liquid": oil,
            "volume": case["V"] or None,
            "contact_angle_lower": case["theta"],
            "contact_angle_upper": case["theta"],
        }
        if effects is None:
            effects = (ck.MeniscusForce(profile=ck.AsPublished(radius="disc")), ck.ViscousForce())
            if case["dp_cav"]:
                effects += (ck.TensionLimit(strength=case["dp_cav"], cavity="truncated"),)
        imposed = {
            "initial_gap": case["h0"],
            "final_gap": case["h_rel"],
            "force": case["F0"],
            "mass": case["m"],
            "stiffness": case["k_s"],
            "rise_time": case["tau"],
        }
        face = ck.Flat(radius=case["R"])
        return ck.SeparationScene(
            interface=ck.Interface(
                lower=face, upper=face, meniscus=ck.Meniscus(**film | (meniscus or {}))
            ),
            loading=loadings.imposed(**imposed | loading),
            effects=(*effects, *more),
        )

    return build


@pytest.fixture(scope="session")
def film_scene():
    """Build a scene of an oil film; keywords that are no part of the film go to the loading."""

    def build(*effects, lower=None, upper=None, liquid=None, film=None, **loading):
        given = {"name": "oil", "viscosity": 0.1, "surface_tension": 0.03}
        face = ck.Flat(radius=1e-3)
        motion = {"initial_gap": 1e-6, "final_gap": 1e-5} | loading
        if not motion.keys() & {"speed", "force", "time"}:
            motion["speed"] = 1e-6
        return ck.SeparationScene(
            interface=ck.Interface(
                lower=lower or face,
                upper=upper or face,
                meniscus=ck.Meniscus(liquid=ck.Liquid(**given | (liquid or {})), **(film or {})),
            ),
            loading=loadings.imposed(**motion),
            effects=effects or (ck.MeniscusForce(), ck.ViscousForce()),
        )

    return build
