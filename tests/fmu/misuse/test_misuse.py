"""The life of a slave that is used as it should not be.

Each misuse must leave the host alive, say once what was wrong and how to cure it, be answered with
discarded steps and last good outputs, and be gone after a reset.
"""

from __future__ import annotations

import json
import math

import pytest
from hypothesis import given
from hypothesis import strategies as st

OK, DISCARD = 0, 2


def assert_failed(host, message):
    """Failed as promised, and as good as new after a reset."""
    before = host.outputs()
    assert [host.step(), host.step()] == [DISCARD, DISCARD]
    host.set(u=7.0)  # is ignored, and so are its consequences
    assert host.outputs() == before
    assert all(math.isfinite(value) for value in before.values())
    assert len(host.errors) == 1, host.errors
    assert message in host.errors[0]
    assert [e.category for e in host.log if e.status == 3] == ["logStatusError"]
    host.reset()
    host.start(u=8.0)
    assert host.step() == OK
    assert host.get("y") == pytest.approx(-8.0 * math.expm1(-1.0))
    assert host.errors == []


@pytest.mark.parametrize(
    ("values", "message"),
    [
        ({"u": math.nan}, "u must be a finite number [N], got nan"),
        ({"u": math.inf}, "u must be a finite number [N], got inf"),
        ({"u": -math.inf}, "u must be a finite number [N], got -inf"),
        ({"n": 10}, "n must be a whole number at least 0 and at most 9, got 10"),
        ({"n": -1}, "n must be a whole number at least 0 and at most 9, got -1"),
        ({"tau": 1.0}, "tau must be set before initialization ends [s], got 1.0"),
        ({"mode": 2}, "mode must be set before initialization ends, got 2"),
        ({"y": 1.0}, "y must not be set, because it is an output [N], got 1.0"),
        ({"high": True}, "high must not be set, because it is an output, got True"),
        ({"sum": 1}, "sum must not be set, because it is an output, got 1"),
    ],
)
def test_bad_values_while_stepping(toy, values, message):
    toy.start(u=8.0)
    assert toy.step() == OK
    toy.set(**values)
    assert_failed(toy, message)


@pytest.mark.parametrize(
    ("values", "message"),
    [
        ({"tau": 0.0}, "tau must be a finite number above 0 [s], got 0.0"),
        ({"tau": -1.0}, "tau must be a finite number above 0 [s], got -1.0"),
        ({"tau": math.nan}, "tau must be a finite number above 0 [s], got nan"),
        ({"tau": math.inf}, "tau must be a finite number above 0 [s], got inf"),
        ({"gain": 5.1}, "gain must be a finite number at least -5 and at most 5, got 5.1"),
        ({"mode": 3}, "mode must be 1 (LAG) or 2 (HOLD) or 4 (BREAK), got 3"),
        ({"mode": 0}, "mode must be 1 (LAG) or 2 (HOLD) or 4 (BREAK), got 0"),
        ({"y": 0.0}, "y must not be set, because it is an output [N], got 0.0"),
        ({"mode": 4, "gain": 0.0}, "initialization at t = 0.0 s: nothing to break at gain 0"),
    ],
)
def test_bad_values_before_stepping(toy, values, message):
    toy.start(**values)
    assert_failed(toy, message)


def test_first_of_several_failures_is_the_one_that_counts(toy):
    toy.start(tau=0.0, gain=99.0, mode=3)
    toy.set(u=math.nan)
    assert_failed(toy, "tau must be a finite number above 0 [s], got 0.0; reset the FMU, then set")


@pytest.mark.parametrize(
    ("time", "length"),
    [(0.0, 0.1), (0.05, 0.1), (0.2, 0.1), (math.nan, 0.1), (math.inf, 0.1), (-0.1, 0.1)],
)
def test_steps_at_the_wrong_time(toy, time, length):
    toy.start(u=8.0)
    assert toy.step(0.1) == OK
    assert toy.step(length, time) == DISCARD
    assert_failed(toy, "a step must start at t = 0.1 s, where the last one ended, and go forward")


@pytest.mark.parametrize("length", [-0.05, math.nan, math.inf, -math.inf])
def test_steps_of_an_impossible_length(toy, length):
    toy.start(u=8.0)
    assert toy.step(0.1) == OK
    assert toy.step(length) == DISCARD
    assert_failed(toy, f"and a length of {length!r} s; to go back set an earlier FMU state")


@pytest.mark.parametrize(
    ("u", "message"),
    [
        (14.0, "no bridge beyond 14 N; pull less"),
        (15.0, "output y must be a finite number [N], got nan"),
        (16.0, "values must hold the ports and nothing else, got ['ouput']"),
    ],
)
def test_a_step_that_cannot_be_taken_changes_nothing(toy, u, message):
    """It is discarded: another one, such as a shorter one, is as good as if it had not been."""
    toy.start(u=8.0, n=1)
    assert toy.step() == OK
    good = toy.outputs()
    toy.set(u=u)
    assert toy.step() == DISCARD
    assert toy.errors == [
        f"step of 0.1 s from t = 0.1 s: {message}; or take shorter steps from there"
    ]
    toy.set(u=8.0)
    assert toy.outputs() == good
    assert toy.step(0.05) == OK
    assert toy.get("y") == pytest.approx(8.0 * -math.expm1(-1.5))
    assert toy.get("sum") == 2


def test_trouble_in_the_code_of_the_model(toy):
    toy.start(u=8.0)
    assert toy.step() == OK
    good = toy.get("y")
    toy.set(u=13.0)
    assert toy.step() == DISCARD
    assert toy.get("y") == good
    assert "Traceback" in toy.errors[0]
    assert_failed(toy, "step of 0.1 s from t = 0.1 s: unexpected LookupError: 13 brings 100 ")


def test_earlier_state_cures_a_failed_step(toy):
    """What a master with step size control does: take it back and go on more carefully."""
    toy.start(u=8.0)
    assert toy.step() == OK
    state = toy.slave.getFMUstate()
    toy.set(u=14.0)
    assert toy.step() == DISCARD
    toy.slave.setFMUstate(state)
    assert toy.get("u") == 8.0
    assert toy.step() == OK


def test_state_of_a_failed_slave_is_a_failed_state(toy, toy_fmu, open_fmu):
    toy.start(u=math.nan)
    data = toy.slave.serializeFMUstate(toy.slave.getFMUstate())
    other = open_fmu(toy_fmu).start(u=8.0)
    other.slave.setFMUstate(other.slave.deSerializeFMUstate(data))
    assert other.step() == DISCARD
    assert other.reset().start(u=8.0).step() == OK


@pytest.mark.parametrize("call", ["enterInitializationMode", "setupExperiment"])
def test_calls_that_come_too_late(toy, call):
    toy.start(u=8.0)
    getattr(toy.slave, call)()
    assert_failed(toy, f"{call} belongs to phase instantiated, the FMU is stepping; reset it")


def test_calls_that_come_too_early(toy):
    assert toy.step() == DISCARD
    assert_failed(toy, "doStep belongs to phase stepping, the FMU is instantiated; reset it")
    toy.reset().slave.exitInitializationMode()
    assert_failed(toy, "exitInitializationMode belongs to phase initialization")


def test_step_after_the_end(toy):
    toy.start(u=8.0)
    toy.slave.terminate()
    assert toy.step() == DISCARD
    assert_failed(toy, "doStep belongs to phase stepping, the FMU is terminated; reset it")


def test_value_after_the_end(toy):
    toy.start(u=8.0)
    toy.slave.terminate()
    toy.set(u=1.0)
    assert_failed(toy, "u must not be set after the end [N], got 1.0; reset the FMU first")


def test_start_time_must_be_finite(toy):
    toy.slave.setupExperiment(startTime=math.nan)
    assert_failed(toy, "start time must be finite [s], got nan; reset the FMU")


@pytest.mark.parametrize("verb", ["get", "set"])
@pytest.mark.parametrize(
    ("kind", "reference"),
    [("Real", 0), ("Real", 99), ("Real", 2), ("Integer", 1), ("Boolean", 1), ("String", 1)],
)
def test_unknown_value_references(toy, verb, kind, reference):
    toy.start(u=8.0)
    value = {"Real": 1.0, "Integer": 1, "Boolean": True, "String": "x"}[kind]
    arguments = ([reference],) if verb == "get" else ([reference], [value])
    answer = getattr(toy.slave, verb + kind)(*arguments)
    if verb == "get":
        assert answer in ([0], [b""])
    assert_failed(toy, f"value reference {reference}")


# states --------------------------------------------------------------------------------------


def edited(data, **changes):
    return json.dumps(json.loads(data) | changes).encode()


@pytest.mark.parametrize(
    ("spoil", "message"),
    [
        (lambda data: b"", "FMU state must be one of this FMU, got 'Expecting value"),
        (lambda data: data[:-9], "FMU state must be one of this FMU"),
        (lambda data: b"\xff\xfe\x00", "FMU state must be one of this FMU"),
        (lambda data: b"[1]", "FMU state must be one of this FMU, got 'a list'"),
        (lambda data: b"{}", "FMU state must be one of this FMU, got 'other fields'"),
        (lambda data: b"[" * 100_000, "FMU state must be one of this FMU"),
        (lambda data: edited(data, build="Toy 0"), "FMU state must be of build Toy "),
        (lambda data: edited(data, phase="asleep"), "phase of the FMU state must be known"),
        (lambda data: edited(data, time="1"), "time of the FMU state must be finite, got '1'"),
        (lambda data: edited(data, time=math.nan), "time of the FMU state must be finite"),
        (lambda data: edited(data, values={}), "FMU state must hold every variable, and no other"),
        (lambda data: edited(data, hidden=[]), "hidden of the FMU state must be a dict, got []"),
        (lambda data: edited(data, hidden={}), "unexpected KeyError: 'steps'"),
        (lambda data: data.replace(b'"tau":0.1', b'"tau":-1.0'), "tau must be a finite number"),
        (lambda data: data.replace(b'"tau":0.1', b'"tau":"x"'), "tau must be a finite number"),
        (lambda data: data.replace(b'"sum":0', b'"sum":null'), "sum of the FMU state must be"),
        (lambda data: data.replace(b'"high":false', b'"high":[]'), "high of the FMU state must be"),
        (lambda data: data.replace(b'"twice":16.0', b'"twice":NaN'), "twice of the FMU state"),
    ],
)
def test_malformed_states_are_refused(toy, spoil, message):
    toy.start(u=8.0)
    data = toy.slave.serializeFMUstate(toy.slave.getFMUstate())
    assert spoil(data) != data
    toy.slave.setFMUstate(toy.slave.deSerializeFMUstate(spoil(data)))
    assert_failed(toy, message)


def test_state_of_another_build_is_refused(toy, toy_module, tmp_path, open_fmu):
    from contactkit.fmu.python.build import build

    other = open_fmu(build("toy", tmp_path / "toy.fmu", start={"gain": 2.0})).start(u=8.0)
    toy.start(u=8.0)
    content = other.slave.serializeFMUstate(other.slave.getFMUstate())
    toy.slave.setFMUstate(toy.slave.deSerializeFMUstate(content))
    assert_failed(toy, "FMU state must be of build Toy ")


def test_hidden_state_that_is_not_plain_is_a_failure(toy_module):
    class Odd(toy_module.Toy):
        def hidden_state(self):
            return {"law": self.law}

    odd = Odd(instance_name="direct")
    odd.setup_experiment(0.0)
    odd.enter_initialization_mode()
    odd.exit_initialization_mode()
    json.loads(odd._fmu_state_to_bytes(odd._get_fmu_state()))
    assert "state: hidden state must be numbers, texts, true, false or None" in odd.failure
    assert not odd.do_step(0.0, 0.1)


def test_interrupt_does_not_leave_the_slave(toy_module):
    class Interrupted(toy_module.Toy):
        def advance(self, time, step):
            raise KeyboardInterrupt

    toy = Interrupted(instance_name="direct")
    toy.setup_experiment(0.0)
    toy.enter_initialization_mode()
    toy.exit_initialization_mode()
    assert not toy.do_step(0.0, 0.1)
    assert "unexpected KeyboardInterrupt" in toy.failure


# anything ------------------------------------------------------------------------------------

numbers = st.floats() | st.sampled_from([0.0, 1.0, 13.0, 14.0, 15.0, 16.0, math.inf, math.nan])
calls = st.lists(
    st.one_of(
        st.tuples(st.just("set_real"), st.integers(0, 14), numbers),
        st.tuples(st.just("set_integer"), st.integers(0, 14), st.integers(-(2**31), 2**31 - 1)),
        st.tuples(st.just("set_boolean"), st.integers(0, 14), st.booleans()),
        st.tuples(st.just("do_step"), numbers, numbers),
        st.tuples(st.sampled_from(["get_real", "get_integer", "get_boolean"]), st.integers(0, 14)),
        st.tuples(st.just("setup_experiment"), numbers),
        st.tuples(
            st.sampled_from(
                ["enter_initialization_mode", "exit_initialization_mode", "terminate", "go", "take"]
            )
        ),
    ),
    max_size=30,
)


@given(calls)
def test_no_sequence_of_calls_raises_or_gives_nan(toy_module, sequence):
    toy = toy_module.Toy(instance_name="direct")
    state = toy._get_fmu_state()
    for name, *arguments in sequence:
        if name == "go":
            toy._set_fmu_state(state)
        elif name == "take":
            state = toy._fmu_state_from_bytes(toy._fmu_state_to_bytes(toy._get_fmu_state()))
        elif name.startswith(("get", "set_")):
            answer = getattr(toy, name)(*([argument] for argument in arguments))
            assert answer is None or math.isfinite(answer[0])
        else:
            answer = getattr(toy, name)(*arguments)
            assert answer is None or answer is (toy.failure == "")
