"""The FMU ``valve-drive``: its description, its steps, and its coupling to the film."""

from __future__ import annotations

import math
from pathlib import Path

import fmpy
import pytest
from attrs import evolve

import contactkit as ck
from contactkit.files.scenes import read_tables, structure
from contactkit.fmu.python import build as building
from contactkit.fmu.slaves.valve_drive import ValveDrive, valve_of
from contactkit.models.injector import valve as law
from contactkit.models.injector.monolithic import simulate
from contactkit.models.injector.valve import Valve
from contactkit.separation.motion.advance import advance
from contactkit.separation.motion.state import Pull, start
from contactkit.separation.plan import plan
from contactkit.units import celsius

MODEL = Path(__file__).parents[3] / "models" / "injector" / "fuel_injector.toml"


def drive(**values):
    slave = ValveDrive(instance_name="direct")
    slave.setup_experiment(0.0)
    slave.values |= values
    slave.enter_initialization_mode()
    slave.exit_initialization_mode()
    assert not slave.failure
    return slave


@pytest.fixture(scope="module")
def drive_fmu(shelf):
    return shelf(building.build, "valve-drive")


def test_its_parameters_are_those_of_the_fuel_injector():
    tables = read_tables(MODEL)
    valve = structure(tables["valve"], Valve, MODEL.name)
    built = valve_of(ValveDrive.start_values())
    for part in ("coil", "spring", "stop", "profile"):
        mine, theirs = getattr(built, part), getattr(valve, part)
        for name in type(mine).__annotations__:
            if name == "faces":  # tables of the build, no parameter
                assert getattr(theirs, name) is None
                continue
            assert getattr(mine, name) == pytest.approx(getattr(theirs, name), rel=1e-14), name
    assert ValveDrive.start_values()["h"] == pytest.approx(5e-6)


def test_the_fmu_is_valid_and_states_its_direct_feedthrough(drive_fmu):
    assert building.validate(drive_fmu) == []
    description = fmpy.read_model_description(str(drive_fmu))
    follows = {
        unknown.variable.name: [v.name for v in unknown.dependencies]
        for unknown in description.outputs
    }
    assert follows == {
        "F_ext": ["h", "v"],
        "dF_ext": [],
        "F_mag": [],
        "F_spring": ["h"],
        "F_stop": ["h", "v"],
        "i": ["h"],
        "u": [],
        "flux": [],
    }


def test_the_fmu_in_fmpy_gives_what_the_slave_gives(drive_fmu, open_fmu):
    host, slave = open_fmu(drive_fmu).start(), drive()
    for n in range(30):
        gap, speed = 5e-6 + n * 5e-7, 0.01
        host.set(h=gap, v=speed)
        slave.values |= {"h": gap, "v": speed}
        assert host.step(5e-5) == 0
        assert slave.do_step(n * 5e-5, 5e-5)
    assert host.outputs() == pytest.approx(
        {name: slave.values[name] for name in host.outputs()}, rel=1e-12
    )
    assert host.get("F_mag") > 10.0


def test_forces_follow_gap_and_speed_at_once(drive_fmu, open_fmu):
    host = open_fmu(drive_fmu).start()
    for _ in range(30):
        host.step(5e-5)
    before = host.outputs()
    host.set(h=26e-6, v=0.1)
    after = host.outputs()
    assert after["F_stop"] == pytest.approx(1e8 * 1e-6 * 1.5)
    assert after["F_spring"] == pytest.approx(15.0 + 2e4 * 26e-6)
    left = after["F_mag"] - after["F_spring"] - after["F_stop"]
    assert after["F_ext"] == pytest.approx(left)
    assert after["i"] < before["i"]
    assert (after["flux"], after["F_mag"]) == (before["flux"], before["F_mag"])


def test_going_back_to_a_state_gives_the_same_again(drive_fmu, open_fmu):
    host = open_fmu(drive_fmu).start()
    for _ in range(25):
        host.step(5e-5)
    state, time = host.slave.getFMUState(), host.time
    host.step(5e-5)
    first = host.outputs()
    host.slave.setFMUState(state)
    host.time = time
    host.step(5e-5)
    assert host.outputs() == first
    host.slave.freeFMUState(state)


def test_force_and_slope_describe_the_step():
    """The mean slope leads from the force before the step to that after it."""
    slave = drive()
    for n in range(30):
        slave.values |= {"h": 5e-6, "v": 0.02}
        before = law.pull(slave.valve, slave.values["flux"], 5e-6, 0.02)
        slave.do_step(n * 5e-5, 5e-5)
        values = slave.values
        assert values["F_ext"] - 5e-5 * values["dF_ext"] == pytest.approx(before, abs=1e-9)
        assert values["F_spring"] == pytest.approx(15.0 + 2e4 * 6e-6)


def test_the_voltage_switches_inside_a_step():
    """One long step over boost, hold and off gives what many short ones give."""
    long, short = drive(), drive()
    long.do_step(0.0, 5.1e-3)
    for n in range(510):
        short.do_step(n * 1e-5, 1e-5)
    assert long.values["flux"] == pytest.approx(short.values["flux"], rel=1e-9)
    assert long.values["flux"] > 0.0
    assert long.values["u"] == -12.0


def test_an_impossible_drive_is_refused(drive_fmu, open_fmu):
    host = open_fmu(drive_fmu)
    host.slave.setupExperiment(startTime=0.0)
    host.set(t_on=20e-3)
    host.slave.enterInitializationMode()
    host.slave.exitInitializationMode()
    assert "t_on must not exceed T_period = 0.01 s" in host.errors[0]


@pytest.mark.slow
@pytest.mark.parametrize("temperature", [-20.0, 80.0])
def test_coupled_to_the_film_it_gives_what_the_monolithic_solver_gives(temperature):
    tables = read_tables(MODEL)
    valve = structure(tables.pop("valve"), Valve, MODEL.name)
    for key in ("device", "study"):
        tables.pop(key)
    scene = structure(tables, ck.SeparationScene, MODEL.name)
    made = plan(evolve(scene, temperature=celsius(temperature)))
    reference = simulate(made, valve, 2e-3, rtol=1e-8).cycles[0]  # its release within 1e-9
    errors = []
    for step in (1e-5, 5e-6):
        slave, state = drive(), start(made)
        for n in range(round(2e-3 / step)):
            slave.values |= {"h": state.gap, "v": state.speed}
            assert slave.do_step(n * step, step)
            slope = slave.values["dF_ext"]
            pull = Pull(slave.values["F_ext"] - slope * step, slope, n * step)
            state = advance(made, state, pull, step)
        errors.append(abs((state.release_time - 1e-3) / reference.release_time - 1.0))
    # The pull is a straight line within a step, and the acceleration jumps as the film cavitates.
    assert errors[1] < 3e-5
    assert math.log2(errors[0] / errors[1]) > 1.5  # falls with the square of the step
    assert state.peak_force == pytest.approx(reference.peak_force, rel=1e-4)
