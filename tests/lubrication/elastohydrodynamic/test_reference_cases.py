"""Films between deforming bodies against the cases of an independent program."""

import json
import math
from pathlib import Path

import numpy as np
import pytest

from contactkit.elasticity import rings
from contactkit.elasticity.layer_stack import Layers
from contactkit.lubrication.elastohydrodynamic import response
from contactkit.lubrication.elastohydrodynamic.drive import Driven, Imposed
from contactkit.lubrication.elastohydrodynamic.mesh import RingMesh, graded_nodes
from contactkit.lubrication.elastohydrodynamic.motion import Phase, SmoothGap, move

DATA = Path(__file__).parents[2] / "data/wet.json"
CASES = {case["id"]: case for case in json.loads(DATA.read_text())["cases"]}


def compliance(given):
    if "winkler_compliance" in given:
        return lambda nodes: np.eye(len(nodes)) * given["winkler_compliance"]
    modulus = given["effective_modulus"]
    if "layer_thickness" not in given:
        return lambda nodes: rings.half_space_matrix(nodes) / modulus
    nu = given["layer_poisson"]
    layer = Layers([(1.0 - nu**2) * modulus], [nu], [given["layer_thickness"]], "bonded")
    return lambda nodes: rings.matrix(nodes, layer)


def film_of(given):
    return SmoothGap(
        radius=math.inf if given["body"] == "flat face" else given["radius"],
        rim=given.get("rim_radius", given.get("initial_rim_radius")),
        gap=given["gap"],
        viscosity=given["viscosity"],
        compliance=compliance(given),
        cavity=given.get("cavity_pressure_below_ambient", math.inf),
        strength=given.get("tensile_strength", 0.0),
        cutoff=given.get("contact_cutoff", 0.0),
        wetting=given.get("gamma_c"),
    )


def phases_of(given, times):
    gap, speed, motion = given["gap"], given.get("speed", 0.0), given["motion"]

    def fixed(drive):
        return [Phase(lambda *_: drive, times)]

    if motion.startswith("constant pull"):
        return fixed(Driven(lambda _: given["pull"], given.get("mass", 0.0)))
    if motion.startswith("spring"):
        return fixed(Driven(lambda _: 0.0, 0.0, given["stiffness"], lambda t: gap + speed * t))
    if "cos" in motion:
        half = 2.0 * gap / speed
        wave = 2.0 / np.pi
        return fixed(Imposed(lambda t: gap * (1.0 + wave * (1.0 - math.cos(math.pi * t / half)))))
    if "turn_time" not in given:
        return fixed(Imposed(lambda t: gap + speed * t))
    turn, low = given["turn_time"], given["lowest_gap"]
    down = Imposed(lambda t: gap - speed * t)
    up = Imposed(lambda t: low + speed * (t - turn))
    return [
        Phase(lambda *_: down, [(gap - low) / speed]),
        Phase(lambda *_: Imposed(lambda t: low), [turn]),
        Phase(lambda *_: up, [t for t in times if t > turn]),
    ]


SLOW = dict.fromkeys(
    (
        "rupture_cycle_beta0.1",
        "two_pressures_beta1",
        "contact_dwell_pull_beta0.1",
        "push_speed_beta0.01",
        "push_speed_beta10",
        "flat_pull_beta0.1",
        "rim_pull_beta0.05_v1",
        "winkler_pull",
        "pull_spring_beta1",
        "pull_speed_beta0.001",
        "layer_pull_beta1_t2_nu0.3",
        "pull_mass_beta0.1",
    ),
    pytest.mark.slow,
)
SLOW["rupture_pull_beta0.1"] = pytest.mark.exhaustive  # what ruptures is in the cycle as well
MOTIONS = [
    pytest.param(name, marks=SLOW.get(name, []))
    for name, case in CASES.items()
    if case["kind"] in ("coupled_motion", "coupled_bridge")
]
TOLERANCE = {"contact_force": 3e-2, "void_volume": 2e-2, "rupture_time": 1e-3}
COLUMNS = {"pull_force": "pull", "rigid_gap": "gap"}


@pytest.mark.parametrize("name", MOTIONS)
def test_motion(name):
    case = CASES[name]
    given, values = case["inputs"], case["values"]
    is_smooth = not {"contact_cutoff", "tensile_strength"} & set(given)
    found = move(film_of(given), phases_of(given, values["time"]), speed=given.get("speed", 1e-5))
    at = [int(np.abs(found.columns["time"] - t).argmin()) for t in values["time"]]
    assert found.columns["time"][at] == pytest.approx(values["time"], rel=1e-9)
    for quantity, expected in values.items():
        if quantity in ("time", "initial_force"):
            continue
        if quantity == "rupture_time":
            assert found.rupture_time == pytest.approx(expected, rel=1e-3)
            continue
        curve = found.columns[COLUMNS.get(quantity, quantity)][at]
        allowed = TOLERANCE.get(quantity, 1e-4 if is_smooth else 1e-3)
        error = np.abs(curve - expected).max() / np.abs(expected).max()
        assert error < allowed, (quantity, error)
    if is_smooth:
        assert found.error < 5e-4
    if "initial_force" in values:
        assert found.columns["pull"][0] == pytest.approx(values["initial_force"], rel=1e-9)


@pytest.mark.parametrize(
    "name", [name for name, case in CASES.items() if case["kind"] == "linear_response"]
)
def test_modulus(name):
    given, values = CASES[name]["inputs"], CASES[name]["values"]
    radius, gap = given["radius"], given["gap"]
    moduli = []
    for count in (40, 80, 160):
        nodes = graded_nodes(count, given["rim_radius"], math.sqrt(radius * gap))
        shape = gap + nodes**2 / (2.0 * radius)
        matrix = compliance(given)(nodes)
        omega = [given["angular_frequency"]]
        moduli.append(response.modulus(RingMesh(nodes), shape, matrix, given["viscosity"], omega))
    found = response.extrapolated(*moduli)
    assert found.storage[0] == pytest.approx(values["storage"], rel=1e-4)
    assert found.loss[0] == pytest.approx(values["loss"], rel=1e-4)
    assert found.error[0] < 5e-4 * values["loss"]
