"""Reference cases, and scenes built from them."""

from __future__ import annotations

import gc
import json
from pathlib import Path

import attrs
import loadings
import pytest
from hypothesis import HealthCheck, settings
from shelf import Shelf, compiled_once

import contactkit as ck
from contactkit.benchmarks import releases

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

# Unless told otherwise, approx takes 1e-12 for equal to anything below it, whatever the relative
# tolerance: energies [J], volumes [m3], forces of bridges [N]; 58 comparisons passed with values
# 30 % beside. So only zero keeps that tolerance, also inside lists, dicts and arrays;
# tests/rules/test_tolerances.py notices a pytest that keeps it elsewhere.
type(pytest.approx(1.0)).DEFAULT_ABSOLUTE_TOLERANCE = property(
    lambda number: 0.0 if number.expected else 1e-12
)


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
def shelf(tmp_path_factory):
    """FMUs that are built once in a run, whoever asks for them."""
    return Shelf(tmp_path_factory)


@pytest.fixture(scope="session")
def kernels_compiled_once(shelf):
    """Have each kernel compiled once for all tests and workers that ask for this."""
    pytest.importorskip("pythonfmu")
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr("contactkit.fmu.native.build.compile_kernel", compiled_once(shelf))
        yield


@pytest.fixture(scope="session")
def release_cases():
    """Release of a mass from a film: parameters under ``case``, reference under ``values``."""
    return releases.release_cases()


@pytest.fixture(scope="session")
def viscous_cases():
    """Closed forms of the squeeze film, by their id."""
    cases = json.loads((DATA / "viscous.json").read_text(encoding="utf-8"))
    return {case["id"]: case for case in cases}


@pytest.fixture(scope="session")
def release_scene():
    """Build the scene of a release case; keywords change its loading."""

    def build(name, *more, effects=None, meniscus=None, **loading):
        scene = releases.release_scene(name)
        imposed = attrs.asdict(scene.loading, recurse=False)
        film = attrs.evolve(scene.meniscus, **(meniscus or {}))
        return attrs.evolve(
            scene,
            interface=attrs.evolve(scene.interface, meniscus=film),
            loading=loadings.imposed(**imposed | loading),
            effects=(*(scene.effects if effects is None else effects), *more),
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
