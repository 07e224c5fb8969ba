"""What one communication step may cost, in Python and native FMUs: `max_steps` and its message."""

from __future__ import annotations

import math
import random

import pytest

pytest.importorskip("pythonfmu")
fmpy = pytest.importorskip("fmpy")

from native_scenes import FORCES, HAS_CC, SCENES, scene  # noqa: E402

import contactkit as ck  # noqa: E402
from contactkit.errors import ConvergenceError  # noqa: E402
from contactkit.fmu.framework.toolchain import local  # noqa: E402
from contactkit.fmu.native.build import build_native  # noqa: E402
from contactkit.fmu.slaves.stiction_force import StictionForce  # noqa: E402
from contactkit.fmu.slaves.stiction_mass import StictionMass  # noqa: E402
from contactkit.fmu.slaves.valve_drive import ValveDrive  # noqa: E402
from contactkit.models.injector import valve as law  # noqa: E402
from contactkit.separation.cavity.state import FULL, Phase  # noqa: E402
from contactkit.separation.motion.advance import step_cost  # noqa: E402
from contactkit.separation.motion.state import MotionState  # noqa: E402

ONE = {"platforms": [local()], "compiler": "cc"}
CAVITATING = scene(
    effects=(*FORCES, ck.TensionLimit(strength=1e6, cavity_pressure=0.0)), final=23e-6
)
native_only = pytest.mark.skipif(not HAS_CC, reason="there is no C compiler")


def started(kind, **values):
    """A slave in this process, with its log."""
    slave = kind(instance_name="direct")
    slave.data, slave.said = {}, []
    slave.log = lambda message, *more: slave.said.append(message)
    slave.setup_experiment(0.0)
    slave.values |= values
    slave.enter_initialization_mode()
    slave.exit_initialization_mode()
    assert not slave.failure
    return slave


SWINGING = {"F_ext": 40.0, "k_s": 5e3, "h0": 20e-6, "eta": 0.01}


def test_a_step_beyond_the_limit_is_discarded_and_a_shorter_one_taken():
    """After its release the mass swings on its spring, for a long time if nobody stops it."""
    slave = started(StictionMass, max_steps=150, **SWINGING)
    before = dict(slave.values)
    assert not slave.do_step(0.0, 0.1)
    assert slave.values == before
    assert slave.failure == ""
    assert "150 internal steps led from 0 s to " in slave.said[-1]
    assert "raise max_steps" in slave.said[-1]
    assert slave.do_step(0.0, 2e-4)
    assert slave.values["h"] > SWINGING["h0"]


def test_a_step_of_a_cavitated_film_costs_as_much_as_twenty():
    whole = MotionState(0.0, 1e-6, 0.0)
    cavitated = whole._replace(cavity=FULL._replace(phase=Phase.RECEDING))
    assert step_cost(whole, whole) == 1
    assert step_cost(whole, whole._replace(n_rejected=2)) == 3
    assert (
        step_cost(whole, cavitated)
        == step_cost(cavitated, whole)
        == step_cost(cavitated, cavitated)
        == 20
    )
    assert step_cost(cavitated, cavitated._replace(n_rejected=1)) == 40


def test_the_coil_counts_the_steps_of_all_its_pieces():
    coil = law.Coil(resistance=1.0, turns=40, pole_area=5e-5, air_gap=1e-4, iron_gap=2e-5)
    alone = law.StepCount(100)
    flux = law.advance_flux(coil, 0.0, 5e-6, 0.0, 12.0, 1e-5, alone)
    taken = 100 - alone.left
    assert 1 < taken < 20
    both = law.StepCount(2 * taken - 1)
    law.advance_flux(coil, 0.0, 5e-6, 0.0, 12.0, 1e-5, both)
    with pytest.raises(ConvergenceError, match="the flux of the coil did not follow"):
        law.advance_flux(coil, 0.0, 5e-6, 0.0, 12.0, 1e-5, both)
    assert law.advance_flux(coil, 0.0, 5e-6, 0.0, 12.0, 1e-5) == flux


def test_numbers_out_of_range_are_no_defect():
    film = started(StictionForce)
    for gap in (1e-120, 1e-200):
        film.values |= {"h": gap, "v": 0.0}
        assert not film.do_step(0.0, 1e-6)
        assert "finite number" in film.said[-1]
    film.values |= {"h": 6e-6, "v": 0.1}
    assert film.do_step(0.0, 1e-6)
    assert film.failure == ""
    assert not any("Traceback" in said for said in film.said)


HOSTILE = (0.0, -0.0, math.inf, math.nan, 1e300, -1e300, 5e-324, -1.0)


@pytest.mark.parametrize("kind", [StictionMass, StictionForce, ValveDrive])
@pytest.mark.parametrize("seed", range(6))
def test_hostile_values_and_calls_raise_nothing(kind, seed):
    """A defect would be reported as unexpected, with a traceback."""
    chance = random.Random(seed)
    slave = started(kind, **({"max_steps": 300} if kind is StictionMass else {}))
    references = {port.name: k for k, port in enumerate(kind.ports, 1)}
    inputs = [port for port in kind.ports if port.causality == "input"]
    states = [slave._get_fmu_state()]
    for _ in range(15):
        for port in inputs:
            size = 10.0 ** chance.uniform(-9.0, 6.0)
            value = chance.choice(HOSTILE) if chance.random() < 0.2 else size
            slave.set_real([references[port.name]], [value])
        length = chance.choice([10.0 ** chance.uniform(-9.0, -3.0), 0.0, math.nan, -1.0, 1e-6])
        slave.do_step(slave.time, length)
        slave.get_real([references["h"], 999])
        slave._set_fmu_state(chance.choice(states))
        states.append(slave._get_fmu_state())
        outputs = [p for p in kind.ports if p.causality == "output"]
        assert all(math.isfinite(slave.values[port.name]) for port in outputs)
    assert not [said for said in slave.said if "unexpected" in said]


@pytest.fixture
def swinging(shelf, open_fmu):
    """Natively, the same swing."""
    return open_fmu(shelf(build_native, SCENES["flooded"], **ONE))


@native_only
@pytest.mark.slow
def test_native_steps_are_discarded_likewise(swinging):
    swinging.start(F_ext=40.0, max_steps=150)
    assert swinging.step(0.1) == 2
    assert "max_steps = 150 led to " in swinging.errors[-1]
    assert "raise max_steps" in swinging.errors[-1]
    assert swinging.get("h") == pytest.approx(20e-6)
    assert swinging.step(1e-4) == 0
    swinging.reset().start(F_ext=40.0)
    assert swinging.step(0.1) == 0  # the default is enough for eight swings


@native_only
@pytest.mark.slow
def test_a_cavitated_film_has_enough_and_costs_more(shelf, open_fmu):
    """A pull that cavitates takes about 250 internal steps, which count as 5000."""
    cavitated = open_fmu(shelf(build_native, CAVITATING, **ONE))
    for most, status in ((1000, 2), (20_000, 0), (100_000, 0)):
        cavitated.reset().start(F_ext=40.0, max_steps=most, k_s=0.0)
        assert cavitated.step(1e-3) == status
    assert cavitated.get("t_release") > 0.0


@native_only
@pytest.mark.slow
@pytest.mark.parametrize("events", [False, True])
def test_fmi_3_ends_early_where_it_may(events, shelf):
    """Steps that end early lead to the same release as one that does not."""
    folder = shelf.unpacked(shelf(build_native, SCENES["flooded"], fmi=3, **ONE))
    description = fmpy.read_model_description(str(folder))
    numbers = {v.name: v.valueReference for v in description.modelVariables}

    def run(most, early):
        said = []
        one = fmpy.fmi3.FMU3Slave(
            instanceName="one",
            guid=description.guid,
            unzipDirectory=str(folder),
            modelIdentifier=description.coSimulation.modelIdentifier,
        )
        one.instantiate(
            loggingOn=True,
            eventModeUsed=events,
            earlyReturnAllowed=early,
            logMessage=lambda _, status, category, text: said.append(text.decode()),
        )
        one.setFloat64([numbers["F_ext"]], [40.0])
        one.setInt32([numbers["max_steps"]], [most])
        one.enterInitializationMode(startTime=0.0)
        one.exitInitializationMode()
        if events:
            one.updateDiscreteStates(), one.enterStepMode()
        time, steps, status = 0.0, 0, 0
        while time < 1e-3:
            try:
                event, _, _, after = one.doStep(time, 1e-3 - time)
            except fmpy.fmi1.FMICallException as error:
                status = error.status
                break
            assert after > time
            if event:
                one.enterEventMode(), one.updateDiscreteStates(), one.enterStepMode()
            time, steps = after, steps + 1
        released = one.getFloat64([numbers["t_release"]])[0]
        one.freeInstance()
        return released, steps, status, said

    whole, one_step, status, _ = run(100_000, True)
    early, steps, _, said = run(40, True)
    assert status == 0
    assert steps > one_step
    assert early == pytest.approx(whole, rel=1e-7)
    assert any("it ends there" in text for text in said)
    assert run(40, False)[1:3] == (0, 2)  # discarded, not an error
