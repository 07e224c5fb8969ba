"""Chains of contact solves, in single solves, and the memory of one. Counts are asserted."""

from __future__ import annotations

import tracemalloc

import attrs
import numpy as np
import pytest
from peers.cases import case

import contactkit as ck
from contactkit.app.scenes import open_scene

pytestmark = pytest.mark.filterwarnings("ignore::contactkit.ValidityWarning")

N = 256
STEEL = ck.Material(name="steel", young_modulus=210e9, poisson_ratio=0.3)
CARBON = ck.Material(name="carbon", young_modulus=420e9, poisson_ratio=0.25)
COATED = ck.Stack(layers=(ck.Layer(material=CARBON, thickness=2e-8),), substrate=STEEL)
MODULUS = 210e9 / (1.0 - 0.3**2)  # contact modulus [Pa]


@pytest.fixture(scope="module")
def one_map():
    """A map 1 um wide, and its load for 5 per cent of contact with steel."""
    given = case("selfaffine", N, "periodic", 5)
    return given.heights * 1e-6, given.load * MODULUS


def head_disk(*effects):
    """A quarter of the head-disk window, with its compliance and these effects only."""
    scene = open_scene("head-disk").scene
    return attrs.evolve(
        scene, window=ck.Window(width=5e-6), effects=(ck.LayeredHalfSpace(), *effects)
    )


def planned(scene):
    return ck.plan(scene, ck.Accuracy(grid=N))


PLATE = ck.Material(name="plate", young_modulus=100 * 210e9, poisson_ratio=0.3)
ON_STEEL = ck.Stack(layers=(ck.Layer(material=PLATE, thickness=3e-9),), substrate=STEEL)
SERIES = {
    "0.1-to-2": np.linspace(0.1, 2.0, 20),
    "0.2-to-1": np.geomspace(0.2, 1.0, 20),
    "0.01-to-1": np.geomspace(0.01, 1.0, 20),
}
SOLIDS = {
    "half-space": (STEEL, "selfaffine", None, 1.0),
    "half-space-rough-to-the-pixel": (STEEL, "expacf", None, 1.0),
    "film-of-100": (ON_STEEL, "selfaffine", None, 3.0),
    "half-space-with-hardness": (STEEL, "selfaffine", 0.1 * MODULUS, 1.0),
}


@pytest.mark.parametrize("rtol", [1e-5, 1e-8])
@pytest.mark.parametrize("series", SERIES)
@pytest.mark.parametrize("name", SOLIDS)
def test_chain_of_twenty_loads(benchmark, name, series, rtol):
    """Cost of a curve in single solves at its largest load but one, and of each point."""
    solid, kind, hardness, factor = SOLIDS[name]
    given = case(kind, N, "periodic", 5)
    effects = [ck.HalfSpace() if solid is STEEL else ck.LayeredHalfSpace()]
    if hardness is not None:
        effects.append(ck.HardnessLimit(rule=ck.ConstantHardness(hardness=hardness)))
    base = given.load * MODULUS * factor
    scene = ck.ContactScene(
        interface=ck.Interface(
            lower=ck.Body(solid=solid),
            upper=ck.Body(surface=ck.Heights(heights=given.heights * 1e-6, pixel_size=1e-6 / N)),
        ),
        loading=ck.Pressing(pressure=base),
        effects=tuple(effects),
    )
    plan = ck.plan(scene, ck.Accuracy(rtol=rtol))
    cold = ck.solve(plan).work.n_operator_applications
    curve = benchmark.pedantic(
        ck.load_curve, (plan,), {"pressures": base * SERIES[series]}, rounds=1
    )
    total = int(curve.applications.sum())
    benchmark.extra_info |= {
        "cold solve": cold,
        "curve": total,
        "in cold solves": round(total / cold, 1),
        "points": " ".join(map(str, curve.applications)),
    }
    assert total <= 23 * cold


CHAINS = {
    "film": (ck.FilmMeniscus(film_thickness=1e-9, self_consistent=True),),
    "friction-0.1": (ck.FrictionTraction(coefficient=0.1), ck.FrictionCoupling()),
    "friction-0.3": (ck.FrictionTraction(coefficient=0.3), ck.FrictionCoupling()),
    "friction-1": (ck.FrictionTraction(coefficient=1.0), ck.FrictionCoupling()),
}


@pytest.mark.parametrize("name", CHAINS)
def test_chain_to_a_balance(benchmark, name):
    """Cost of a contact that depends on its own pressure, in dry solves."""
    dry = ck.solve(planned(head_disk())).work.n_operator_applications
    found = benchmark.pedantic(ck.solve, (planned(head_disk(*CHAINS[name])),), rounds=1)
    total = found.work.n_operator_applications
    benchmark.extra_info |= {"dry solve": dry, "in dry solves": round(total / dry, 2)}
    assert total <= 4 * dry


def test_memory_of_a_press(benchmark, one_map):
    """Largest memory held at once, in maps; the seconds are those of a traced run."""
    heights, pressure = one_map

    def traced():
        tracemalloc.start()
        found = ck.press(heights, 1e-6 / N, COATED, pressure)
        largest = tracemalloc.get_traced_memory()[1]
        tracemalloc.stop()
        return found, largest / heights.nbytes

    ck.press(heights, 1e-6 / N, COATED, pressure)  # imports and compiled code are no part of it
    found, maps = benchmark.pedantic(traced, rounds=1)
    benchmark.extra_info["maps"] = maps
    assert found.status == "converged"
    assert maps < 30.0
