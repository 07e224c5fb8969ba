"""Python FMUs under random calls with random values, in this process: what must hold after each.

`play` draws a life from a seed: values within their range over many powers of ten, values that no
variable has, steps of any length, calls of another phase, states, bytes of states, resets. Whatever
comes, no exception leaves the slave, outputs are numbers that their ports allow, what is refused is
logged, and a step that is discarded has changed nothing.
"""

from __future__ import annotations

import importlib
import math
import random
from collections.abc import Callable
from typing import Any

from contactkit.fmu.framework.ports import STEP_LIMIT
from contactkit.fmu.python.build import FMUS

WILD = (math.nan, math.inf, -math.inf, 1e308, -1e308, 5e-324, -1.0, 0.0, -0.0)
LONG = 60  # most internal steps of a communication step, so that none takes long


def slave_class(name: str, data: dict[str, Any]) -> type:
    """Slave of an FMU that keeps what it logs, with tables if it needs some."""
    module, cls = FMUS[name]
    base = getattr(importlib.import_module(f"contactkit.fmu.{module}"), cls)

    class Fuzzed(base):
        def __init__(self, **more: Any) -> None:
            self.said: list[tuple[str, str]] = []
            super().__init__(**more)

        def log(self, msg: str, status: Any = 0, category: Any = None, debug: Any = None) -> None:
            self.said.append((str(getattr(status, "name", status)), msg))

    Fuzzed.data, Fuzzed.__name__ = data, cls
    return Fuzzed


class Life:
    """One slave and its states, driven by a random number generator."""

    def __init__(self, cls: type, seed: int) -> None:
        self.cls, self.chance = cls, random.Random(seed)
        self.rude = self.chance.choice([0.0, 0.0, 0.01, 0.1])  # how often a call is senseless
        self.spread = self.chance.choice([0.05, 0.5, 3.0])  # powers of ten of values that are set
        self.ports = {port.name: (n, port) for n, port in enumerate(cls.ports, start=1)}
        self.calls: list[str] = []
        self.states: list[Any] = []
        self.n_stepped = self.n_refused = self.n_discarded = 0
        self.reset()

    def reset(self) -> None:
        """What pythonfmu does where a host resets: the slave is made anew."""
        self.slave = self.cls(instance_name="fuzzed")
        if STEP_LIMIT in self.ports:
            self.slave.values[STEP_LIMIT] = LONG

    def value(self, port: Any) -> Any:
        """Value of a variable, mostly one that it may have."""
        chance = self.chance
        if chance.random() < self.rude:
            return chance.choice(WILD) if port.kind == "real" else chance.randrange(-9, 99)
        if port.kind == "enumeration":
            return chance.choice([int(one) for one in port.enumeration])
        if port.kind == "boolean":
            return chance.random() < 0.5
        if port.kind == "integer":
            return LONG if port.name == STEP_LIMIT else chance.randrange(1, 9)
        if chance.random() < 0.1 and port.allows(0.0):
            return 0.0
        size = abs(port.start) or port.nominal or 1.0
        sign = -1.0 if port.causality == "input" and chance.random() < 0.3 else 1.0
        value = sign * size * 10.0 ** chance.uniform(-self.spread, self.spread)
        return value if port.allows(value) else port.start

    def set(self) -> None:
        kinds = {"real": "real", "boolean": "boolean"}
        is_open = str(self.slave._phase) in ("instantiated", "initialization")
        causalities = ["input"] + ["parameter"] * (3 if is_open else 0)
        if self.chance.random() < self.rude:
            causalities = ["parameter", "output"]
        wanted = self.chance.choice(causalities)
        chosen = [one for one in self.ports.values() if one[1].causality == wanted]
        number, port = self.chance.choice(chosen)
        value = self.value(port)
        self.calls.append(f"set {port.name} = {value!r}")
        put = getattr(self.slave, f"set_{kinds.get(port.kind, 'integer')}")
        put([number], [float(value) if port.kind == "real" else int(value)])

    def step(self) -> None:
        chance, slave = self.chance, self.slave
        length = self.cls.experiment.get("stepSize", 1e-6) * 10.0 ** chance.uniform(-4.0, 1.0)
        time = slave.time
        if chance.random() < self.rude:
            time, length = chance.choice([*WILD, time]), chance.choice([*WILD, length])
        before, was = outputs(slave), slave.time
        self.calls.append(f"step {time!r}, {length!r}")
        heard = len(slave.said)
        if slave.do_step(time, length):
            self.n_stepped += 1
            return
        if slave.failure:
            return
        self.n_discarded += 1
        assert slave.said[heard:], "a step was discarded without a word"
        assert outputs(slave) == before, "a discarded step has changed outputs"
        assert slave.time == was, "a discarded step has changed the time"

    def phase(self) -> None:
        """A call of another phase, which is rude."""
        if self.chance.random() >= self.rude:
            return
        name = self.chance.choice(
            ["setup_experiment"] + ["enter_initialization_mode", "exit_initialization_mode"] * 3
        )
        given = [self.chance.choice([0.0] * 9 + list(WILD))] if name.startswith("setup") else []
        self.calls.append(f"{name} {given}")
        getattr(self.slave, name)(*given)

    def begin(self) -> None:
        """A life as it should be, up to the first step."""
        self.calls.append("begin")
        self.reset()
        self.slave.setup_experiment(0.0)
        for _ in range(self.chance.randrange(8)):
            self.set()
        self.slave.enter_initialization_mode()
        self.slave.exit_initialization_mode()

    def end(self) -> None:
        self.calls.append("terminate" if self.chance.random() < self.rude else "reset")
        if self.calls[-1] == "reset":
            self.reset()
        else:
            self.slave.terminate()

    def state(self) -> None:
        """Take a state, or go back to one, also by its bytes: outputs are those it was taken at."""
        slave, chance = self.slave, self.chance
        if not self.states or chance.random() < 0.5:
            self.calls.append("take")
            shown = outputs(slave)  # which may fail, and bring outputs up to date
            self.states.append((slave._get_fmu_state(), shown, slave.failure))
            return
        state, known, failure = chance.choice(self.states)
        if chance.random() < 0.5:
            state = slave._fmu_state_from_bytes(slave._fmu_state_to_bytes(state))
        self.calls.append("restore")
        slave._set_fmu_state(state)
        assert slave.failure == failure, slave.failure
        assert outputs(slave) == known, "a state has other outputs than it was taken with"

    def play(self, count: int) -> None:
        """Random calls, checked after each."""
        acts: list[Callable[[], None]] = [self.step] * 8 + [self.set] * 8
        acts += [self.state] * 2 + [self.phase] * 2 + [self.end]
        for _ in range(count):
            failed = bool(self.slave.failure)
            heard, slave = len(self.slave.said), self.slave
            is_over = failed or str(slave._phase) != "stepping"
            if is_over and self.chance.random() < 0.5:
                self.begin()
            else:
                self.chance.choice(acts)()
            self.check(failed, heard, slave)

    def check(self, failed: bool, heard: int, slave: Any) -> None:
        now = self.slave
        if now.failure and (now is not slave or not failed):
            self.n_refused += 1
            assert "unexpected" not in now.failure, now.failure
            if now is slave and self.calls[-1] != "restore":
                errors = [text for status, text in now.said[heard:] if status == "error"]
                assert errors, "it failed without a word"
        for name, (_, port) in self.ports.items():
            if port.causality != "output":
                continue
            value = now.values[name]
            assert isinstance(value, int) or math.isfinite(value), (name, value)
            assert port.allows(value), (name, value)


def outputs(slave: Any) -> dict[str, Any]:
    """Outputs as a host reads them."""
    ports = [(n, port) for n, port in enumerate(slave.ports, start=1) if port.causality == "output"]
    found = {}
    for number, port in ports:
        kind = port.kind if port.kind in ("real", "boolean") else "integer"
        (found[port.name],) = getattr(slave, f"get_{kind}")([number])
    return found
