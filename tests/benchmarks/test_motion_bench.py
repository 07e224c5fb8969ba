"""What a step, a cycle and a release cost. Counts are asserted, seconds only printed."""

from __future__ import annotations

from pathlib import Path

import pytest

import contactkit as ck
from contactkit.app.scenes import open_scene
from contactkit.fmu.framework.instance import Instance
from contactkit.fmu.master.injector import cosimulate
from contactkit.models.injector.monolithic import simulate as monolithic
from contactkit.models.injector.report.cosimulation import build_fmus
from contactkit.separation.motion.state import start

pytestmark = pytest.mark.filterwarnings("ignore::contactkit.ValidityWarning")

CYCLE = 11e-3  # [s]: the delay before the first energising, and one period


@pytest.fixture(scope="module")
def device():
    return open_scene("fuel-injector")


@pytest.fixture(scope="module")
def pair(device, tmp_path_factory):
    return build_fmus(device.scene, tmp_path_factory.mktemp("pair"))


def test_advance_by_one_short_step(benchmark, release_scene):
    """The Python inside one doStep: one internal step of the film with its tension limit."""
    made = ck.plan(release_scene("E", rise_time=0.0))
    pull = ck.Pull(40.0)
    state = ck.advance(made, start(made), pull, 1e-4)
    after = benchmark(ck.advance, made, state, pull, 1e-7)
    assert after.n_steps == state.n_steps + 1


def test_do_step_of_stiction_mass(benchmark, pair):
    """One doStep through fmpy: set two inputs, step 1 us."""
    with Instance(pair[1]) as mass:
        mass.start({"h_min": 0.0}, 1.0)
        inputs, time = mass.references("F_ext", "dF_ext"), [0.0]

        def step():
            mass.set(inputs, [40.0, 0.0])
            mass.step(time[0], 1e-7)
            time[0] += 1e-7

        benchmark.pedantic(step, rounds=2000)
        assert mass.get(mass.references("h"))[0] > 5e-6


def test_do_step_of_valve_drive(benchmark, pair):
    """One doStep through fmpy: set two inputs, step 1 us."""
    with Instance(pair[0]) as drive:
        drive.start({}, 1.0)
        inputs, time = drive.references("h", "v"), [2e-3]
        drive.step(0.0, 2e-3)

        def step():
            drive.set(inputs, [5e-6, 0.0])
            drive.step(time[0], 1e-7)
            time[0] += 1e-7

        benchmark.pedantic(step, rounds=2000)
        assert drive.get(drive.references("F_mag"))[0] > 0.0


def test_injector_cycle_by_the_fmu_pair(benchmark, pair):
    """One firing cycle in steps of 5 us, coupling error 3e-6."""
    found = benchmark.pedantic(cosimulate, (*pair, CYCLE, 5e-6), rounds=3)
    assert found.n_steps == 2200
    assert found["n_release"][-1] == 1


def test_injector_cycle_monolithic(benchmark, device):
    """The same by scipy, error 1e-8."""
    made = ck.plan(device.scene.separation(device.scene.temperature))
    found = benchmark.pedantic(monolithic, (made, device.scene.valve, CYCLE), rounds=3)
    assert found.n_evaluations < 60_000


def test_plan_of_the_injector(benchmark, device):
    """Checking and preparing a scene."""
    scene = device.scene.separation(device.scene.temperature)
    assert benchmark(ck.plan, scene).film.full_gap > 0.0


def test_build_of_stiction_mass(benchmark, tmp_path):
    """Building an FMU file."""
    from contactkit.fmu.python.build import build

    path = benchmark.pedantic(build, ("stiction-mass", Path(tmp_path) / "x.fmu"), rounds=3)
    assert path.stat().st_size < 600_000
