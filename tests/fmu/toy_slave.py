"""A slave for tests: a first-order lag with one port of each kind, and hidden state.

`conftest` loads it as a module of ``contactkit.fmu``, which is why its imports are relative.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from enum import IntEnum
from typing import Any, ClassVar

from attrs import frozen

from ...errors import InfeasibleError
from ..framework.ports import Port
from ..framework.slave import PortSlave


class Mode(IntEnum):
    LAG = 1
    HOLD = 2
    BREAK = 4


class Side(IntEnum):
    BELOW = 1
    ABOVE = 2


@frozen
class Law:
    """What `prepare` builds: not part of the state, made again from the parameters."""

    tau: float
    gain: float


class Toy(PortSlave):
    summary = "First-order lag, for the tests"
    experiment: ClassVar = {"startTime": 0.0, "stopTime": 1.0, "stepSize": 0.1}
    ports = (
        Port("u", "N", causality="input", label="force to follow", nominal=10.0),
        Port("n", "-", causality="input", label="a count", kind="integer", minimum=0, maximum=9),
        Port("on", "-", causality="input", label="follow at all", kind="boolean", start=True),
        Port("y", "N", causality="output", label="force that lags", depends_on=("y0",)),
        Port("twice", "N", causality="output", label="2 u at once", depends_on=("u", "gain")),
        Port("sum", "-", causality="output", label="sum of n", kind="integer", depends_on=()),
        Port("high", "-", causality="output", label="y above u", kind="boolean"),
        Port("side", "-", causality="output", label="y or u", kind="enumeration", enumeration=Side),
        Port(
            "tau",
            "s",
            causality="parameter",
            label="time constant <s> & more",
            start=0.1,
            minimum=0.0,
            exclusive=True,
            display_unit="ms",
        ),
        Port(
            "gain", "-", causality="parameter", label="gain", start=1.0, minimum=-5.0, maximum=5.0
        ),
        Port("y0", "N", causality="parameter", label="force at the start", display_unit="mN"),
        Port(
            "mode", "-", causality="parameter", label="mode", kind="enumeration", enumeration=Mode
        ),
        Port(
            "warm",
            "K",
            causality="parameter",
            label="temperature",
            start=293.15,
            minimum=0.0,
            display_unit="degC",
        ),
    )

    def __init__(self, **kwargs: Any) -> None:
        super().__init__(**kwargs)
        self.steps = 0
        self.released_at: float | None = None
        self.trail: list[float] = []

    def prepare(self) -> None:
        v = self.values
        if v["mode"] == Mode.BREAK and v["gain"] == 0.0:
            raise InfeasibleError("nothing to break at gain 0; choose another")
        self.law = Law(v["tau"], v["gain"])
        self.steps, self.released_at, self.trail = 0, None, []
        v["y"], v["sum"] = v["y0"], 0
        self.refresh()

    def advance(self, time: float, step: float) -> None:
        v = self.values
        u = v["u"]
        if u == 13.0:
            v["y"] = math.nan
            raise LookupError("13 brings 100 % bad luck")
        if u == 14.0:
            raise InfeasibleError("no bridge beyond 14 N; pull less")
        if u == 15.0:
            v["y"] = math.nan
        elif u == 16.0:
            v["ouput"] = 1.0
        elif u == 17.0:
            from ...validators import finite  # noqa: F401  # an import that comes late
        elif v["mode"] == Mode.LAG and v["on"]:
            v["y"] += (self.law.gain * u - v["y"]) * -math.expm1(-step / self.law.tau)
        v["sum"] += v["n"]
        self.steps += 1
        self.trail.append(v["y"])
        if self.released_at is None and v["y"] > 5.0:
            self.released_at = time + step
            self.event(f"released at {self.released_at:.3g} s, 100 %")
        self.refresh()

    def refresh(self) -> None:
        v = self.values
        v["twice"] = 2.0 * self.law.gain * v["u"]
        v["high"] = v["y"] > v["u"]
        v["side"] = Side.ABOVE if v["high"] else Side.BELOW

    def hidden_state(self) -> Mapping[str, Any]:
        return {"steps": self.steps, "released_at": self.released_at, "trail": self.trail}

    def restore_hidden_state(self, hidden: Mapping[str, Any]) -> None:
        self.steps, self.released_at = hidden["steps"], hidden["released_at"]
        self.trail = hidden["trail"]
