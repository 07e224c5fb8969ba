"""What coupling costs. Counts are asserted, seconds only printed."""

from __future__ import annotations

import math
import shutil

import pytest

from contactkit.app.scenes import open_scene
from contactkit.benchmarks.releases import release_cases
from contactkit.fmu.framework.instance import Instance
from contactkit.fmu.framework.toolchain import local
from contactkit.fmu.master.couple import Fmu, Mass, couple
from contactkit.fmu.master.injector import cosimulate
from contactkit.fmu.native.build import build_native, native_scene
from contactkit.fmu.native.drive import build_native_drive
from contactkit.fmu.python import build as building
from contactkit.fmu.slaves.stiction_mass import StictionMass
from contactkit.models.injector.report.cosimulation import build_fmus

pytestmark = pytest.mark.filterwarnings("ignore::contactkit.ValidityWarning")

CYCLE = 11e-3  # [s]: the delay before the first energising, and one period
RELEASE = release_cases()
PHASES = {  # start values and pull [N] of a mass that rests, one that a film holds, one that flies
    "resting": ({"h_min": 5e-6}, -15.0),
    "film": ({"V": 1.58e-10}, 40.0),
    "no meniscus": ({"meniscus_law": "NONE"}, 40.0),
}


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    return tmp_path_factory.mktemp("coupling")


@pytest.fixture(scope="module")
def film(folder):
    return building.build("stiction-force", folder)


@pytest.fixture(scope="module")
def mass(folder):
    return building.build("stiction-mass", folder / "mass.fmu")


@pytest.fixture(scope="module")
def pairs(folder):
    """Drive and mass of the injector: both in Python, the film in C, both in C."""
    scene = open_scene("fuel-injector")
    drive, mass = build_fmus(scene.scene, folder)
    made = {"python": (drive, mass)}
    if shutil.which("cc") is not None:
        film, start = native_scene(scene)
        here = {"platforms": [local()]}
        film = build_native(film, folder / "film.fmu", start=start, **here)
        made["native film"] = drive, film
        made["native"] = build_native_drive(folder / "drive.fmu", **here), film
    return made


@pytest.mark.parametrize("phase", PHASES)
def test_do_step_in_fmpy(benchmark, mass, phase):
    """One doStep of 0.1 us, and nothing else."""
    values, pull = PHASES[phase]
    with Instance(mass) as one:
        one.start(values, 1.0)
        one.set(one.references("F_ext"), [pull])
        one.step(0.0, 1e-5)
        time = [1e-5]

        def step():
            one.step(time[0], 1e-7)
            time[0] += 1e-7

        benchmark.pedantic(step, rounds=2000)


def test_do_step_in_process(benchmark):
    """The same without fmpy and pythonfmu, with a film."""
    slave = StictionMass(instance_name="bench")
    slave.values["V"], slave.values["F_ext"] = 1.58e-10, 40.0
    slave.setup_experiment(0.0)
    slave.enter_initialization_mode()
    slave.exit_initialization_mode()
    assert slave.do_step(0.0, 1e-5)
    before = slave.state
    benchmark.pedantic(lambda: slave.do_step(slave.time, 1e-7), rounds=2000)
    steps = slave.state.n_steps - before.n_steps
    evaluations = (slave.state.n_evaluations - before.n_evaluations) / steps
    benchmark.extra_info |= {"evaluations per step": evaluations}
    assert slave.failure == ""
    assert evaluations < 12


def test_state_in_fmpy(benchmark, mass):
    """Take a state, go back to it, free it."""
    with Instance(mass) as one:
        one.start({}, 1.0)
        one.step(0.0, 1e-6)
        fmu = one._slave

        def there_and_back():
            state = fmu.getFMUState()
            fmu.setFMUState(state)
            fmu.freeFMUState(state)

        benchmark.pedantic(there_and_back, rounds=2000)


@pytest.mark.parametrize(("name", "most"), [("A", 200), ("B", 300), ("D", 500), ("E", 1200)])
def test_release_by_impulses(benchmark, film, name, most):
    """A release case at the tolerance 1e-3."""
    case, values = RELEASE[name]["case"], RELEASE[name]["values"]
    kept = ("h0", "R", "eta", "gamma", "V", "dp_cav", "tau_lim")
    start = {k: case[k] for k in kept} | {"theta1": case["theta"], "theta2": case["theta"]}
    tau, force = case["tau"], case["F0"]

    def run():
        return couple(
            Fmu(film, start | {"meniscus_law": "PUBLISHED"}),
            Mass(mass=case["m"], stiffness=case["k_s"]),
            lambda t: force if tau == 0.0 else -force * math.expm1(-t / tau),
            2.0 * values["t_rel"],
            release_gap=case["h_rel"],
        )

    found = benchmark.pedantic(run, rounds=5)
    benchmark.extra_info |= {
        "steps": found.n_steps,
        "rejected": found.n_rejected,
        "film calls": found.n_calls,
        "seconds in the steps": found.seconds,
        "error": found.release_time / values["t_rel"] - 1.0,
    }
    assert found.n_calls < most


@pytest.mark.parametrize("tolerance", [1e-3, 1e-4])
@pytest.mark.parametrize("kind", ["python", "native film", "native"])
def test_injector_cycle_by_the_pair(benchmark, pairs, kind, tolerance):
    """One firing cycle, adaptive steps; the monolithic one is in the study ``injector-release``."""
    if kind not in pairs:
        pytest.skip("there is no C compiler")
    seconds = []  # in the steps: a cycle begins with unpacking two FMUs

    def run():
        found = cosimulate(*pairs[kind], CYCLE, tolerance=tolerance)
        seconds.append(found.seconds)
        return found

    found = benchmark.pedantic(run, rounds=9)
    benchmark.extra_info |= {
        "steps": found.n_steps,
        "rejected": found.n_rejected,
        "seconds in the steps": min(seconds),
    }
    assert found.n_steps < 900
    assert found["n_release"][-1] == 1
