"""The life of a slave that is used as it should be: values, steps, states."""

from __future__ import annotations

import itertools
import math

import pytest
from hypothesis import given
from hypothesis import strategies as st

from contactkit.errors import DescriptionError
from contactkit.fmu.framework.state import from_bytes, plain, to_bytes


def lag(u, tau, time):
    return -u * math.expm1(-time / tau)


def test_step_follows_the_closed_form(toy):
    toy.start(u=8.0, tau=0.25)
    for number in range(1, 11):
        assert toy.step(0.1) == 0
        assert toy.get("y") == pytest.approx(lag(8.0, 0.25, 0.1 * number), rel=1e-13)


def test_inputs_of_every_kind(toy):
    toy.start(n=3, on=False, u=2.0, mode=2)
    assert toy.step() == 0
    assert toy.outputs() == {"y": 0.0, "twice": 4.0, "sum": 3, "high": False, "side": 1}
    toy.set(n=4, on=True, u=-1.0)
    assert toy.step() == 0
    assert toy.outputs() == {"y": 0.0, "twice": -2.0, "sum": 7, "high": True, "side": 2}


def test_outputs_answer_during_initialization(toy):
    """What InitialUnknowns promises: outputs follow parameters and inputs before the first step."""
    toy.slave.setupExperiment()
    assert toy.get("twice") == 0.0
    toy.set(u=3.0)
    toy.slave.enterInitializationMode()
    assert toy.get("twice") == 6.0
    toy.set(gain=2.0, y0=5.0)
    assert (toy.get("twice"), toy.get("y"), toy.get("high")) == (12.0, 5.0, True)
    toy.set(mode=4, gain=0.0)  # not possible together, but the host is not finished
    assert toy.get("twice") == 12.0
    toy.set(gain=4.0)
    toy.slave.exitInitializationMode()
    assert toy.get("twice") == 24.0
    assert toy.step() == 0
    assert [e.message for e in toy.log if e.category == "logStatusWarning"] == [
        "no outputs yet: nothing to break at gain 0; choose another"
    ]


def test_direct_feedthrough_needs_no_step(toy):
    toy.start(u=1.0)
    toy.set(u=5.0)
    assert toy.get("twice") == 10.0
    assert toy.get("y") == 0.0


def test_events_are_logged_in_their_category(toy):
    toy.start(u=8.0)
    toy.step()
    assert ("logEvents", "released at 0.1 s, 100 %") in [e[1:] for e in toy.log]


def test_start_and_stop_time_reach_the_slave(toy_module):
    toy = toy_module.Toy(instance_name="direct")
    toy.setup_experiment(2.0, 3.0, 1e-5)
    assert (toy.time, toy.start_time, toy.stop_time, toy.tolerance) == (2.0, 2.0, 3.0, 1e-5)
    toy.enter_initialization_mode()
    toy.exit_initialization_mode()
    assert toy.do_step(2.0, 0.5)
    assert toy.time == 2.5


@pytest.mark.parametrize("length", [0.0, 1e-17, -1e-17])
def test_step_of_rounding_size_does_nothing(toy, length):
    toy.start(u=8.0)
    assert toy.step(0.1) == 0
    before = toy.outputs()
    assert toy.step(length) == 0
    assert toy.outputs() == before
    assert toy.step(0.1, time=0.1) == 0


def test_clock_that_sums_up_with_rounding_is_accepted(toy):
    toy.start(u=8.0)
    for number in range(1000):
        assert toy.step(0.1, time=number * 0.1) == 0


def test_outputs_stay_after_the_end(toy):
    toy.start(u=8.0)
    toy.step()
    before = toy.outputs()
    toy.slave.terminate()
    assert toy.outputs() == before
    assert toy.reset().start(u=8.0).step() == 0
    assert toy.outputs() == before


def test_reset_gives_back_the_start_values(toy):
    toy.start(u=8.0, tau=7.0, n=2)
    toy.step()
    toy.reset()
    assert (toy.get("u"), toy.get("tau"), toy.get("n"), toy.get("on")) == (0.0, 0.1, 0, True)
    toy.start(u=1.0).step()
    assert toy.get("y") == pytest.approx(lag(1.0, 0.1, 0.1))


# states --------------------------------------------------------------------------------------


def test_going_back_repeats_the_same_numbers(toy):
    toy.start(u=8.0, n=1)
    toy.step()
    state = toy.slave.getFMUstate()
    runs = []
    for _ in range(3):
        toy.slave.setFMUstate(state)
        toy.time = 0.1
        toy.log.clear()
        assert [toy.step(), toy.step()] == [0, 0]
        runs.append((toy.outputs(), [e.message for e in toy.log]))
    assert runs[0] == runs[1] == runs[2]
    toy.slave.freeFMUstate(state)


def test_hidden_state_goes_back_too(toy):
    """The release is logged once in each branch: `released_at` is no variable of the FMU."""
    toy.start(u=8.0)
    state = toy.slave.getFMUstate()
    for _ in range(2):
        toy.log.clear()
        toy.slave.setFMUstate(state)
        toy.time = 0.0
        toy.step()
        toy.step()
        assert [e.category for e in toy.log].count("logEvents") == 1


def test_state_travels_as_bytes_to_another_instance(toy_fmu, toy, open_fmu):
    toy.start(u=8.0, tau=1 / 3, n=2)
    toy.step()
    data = toy.slave.serializeFMUstate(toy.slave.getFMUstate())
    toy.step()

    other = open_fmu(toy_fmu)
    other.slave.setFMUstate(other.slave.deSerializeFMUstate(data))
    other.time = 0.1
    assert other.get("tau") == 1 / 3
    assert other.step() == 0
    assert other.outputs() == toy.outputs()
    assert other.slave.serializeFMUstate(other.slave.getFMUstate()) == (
        toy.slave.serializeFMUstate(toy.slave.getFMUstate())
    )


def test_state_may_be_taken_in_every_phase(toy):
    states = [toy.slave.getFMUstate()]
    toy.slave.setupExperiment()
    toy.slave.enterInitializationMode()
    toy.set(u=3.0)
    states.append(toy.slave.getFMUstate())
    toy.slave.exitInitializationMode()
    states.append(toy.slave.getFMUstate())
    toy.step()
    toy.slave.terminate()
    states.append(toy.slave.getFMUstate())

    toy.slave.setFMUstate(states[1])
    toy.set(gain=2.0)
    assert toy.get("twice") == 12.0
    toy.slave.exitInitializationMode()
    toy.time = 0.0
    assert toy.step() == 0
    toy.slave.setFMUstate(states[3])
    assert toy.get("y") > 0.0
    toy.slave.setFMUstate(states[2])  # other parameters than now: the law is made again
    toy.time = 0.0
    assert toy.step() == 0
    assert toy.get("twice") == 6.0
    toy.slave.setFMUstate(states[0])
    assert toy.start(u=1.0).step() == 0
    assert toy.errors == []


def test_state_is_not_touched_by_later_steps(toy_module):
    toy = toy_module.Toy(instance_name="direct")
    toy.setup_experiment(0.0)
    toy.enter_initialization_mode()
    toy.exit_initialization_mode()
    toy.do_step(0.0, 0.1)
    state = toy._get_fmu_state()
    data = to_bytes(state)
    toy._set_fmu_state(state)
    toy.do_step(0.1, 0.1)
    assert to_bytes(state) == data


# Of a few letters: all of Unicode is tabulated before the first text is drawn.
TEXTS = st.text('aZ09é %\\"\n\0\u20ac\U0001f600')


@given(st.dictionaries(TEXTS, st.floats(allow_nan=False) | st.integers() | st.booleans()))
def test_bytes_of_a_state_are_exact(values):
    state = {"values": values, "hidden": {"none": None, "text": "é %", "list": [math.inf, 5e-324]}}
    assert from_bytes(to_bytes(state)) == state


def test_plain_data_takes_numpy_scalars():
    np = pytest.importorskip("numpy")
    numbers = plain({"a": np.float64(0.1), "b": np.int64(3), "c": np.bool_(True), "d": (1, "x")})
    assert numbers == {"a": 0.1, "b": 3, "c": True, "d": [1, "x"]}
    assert [type(number) for number in numbers.values()] == [float, int, bool, list]
    with pytest.raises(DescriptionError, match="hidden state must be numbers, texts"):
        plain({"a": np.zeros(3)})


def test_values_reference_every_kind_in_any_order(toy_module):
    toy = toy_module.Toy(instance_name="direct")
    for order in itertools.permutations([1, 9, 10]):
        toy.set_real(order, [float(reference) / 4 for reference in order])
        assert toy.get_real(order) == [reference / 4 for reference in order]
    assert toy.get_string([]) == []
