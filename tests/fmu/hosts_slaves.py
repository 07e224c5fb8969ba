"""What a release case has beside the film, as FMUs for hosts that are none of ours.

`Drive` gives the pull less the spring to a film with the mass inside; `Body` is the mass for a
film that gives its force. `hosts_fmus` loads them as if they lay in contactkit/fmu.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Any, ClassVar

from ..framework.ports import Port
from ..framework.slave import PortSlave

_SHARED = (
    Port("F0", "N", causality="parameter", label="pull in the end", start=40.0),
    Port("tau", "s", causality="parameter", label="time constant of the pull, 0: a step"),
    Port("k", "N/m", causality="parameter", label="stiffness of the spring", start=5e3),
    Port("h0", "m", causality="parameter", label="gap at the start", start=2e-5),
)


class _Pulled(PortSlave):
    def pull(self, time: float) -> float:
        v = self.values
        return v["F0"] * (-math.expm1(-time / v["tau"]) if v["tau"] > 0.0 else 1.0)


class Drive(_Pulled):
    summary = "Pull and spring of a release case"
    ports = (
        Port("h", "m", causality="input", label="gap"),
        Port("F_ext", "N", causality="output", label="pull less the spring", depends_on=("h",)),
        *_SHARED,
    )

    def prepare(self) -> None:
        self.values["h"] = self.values["h0"]
        self.values["F_ext"] = self.pull(0.0)

    def refresh(self) -> None:
        v = self.values
        v["F_ext"] = self.pull(self.time) - v["k"] * (v["h"] - v["h0"])

    def advance(self, time: float, step: float) -> None:
        v = self.values
        v["F_ext"] = self.pull(time + step) - v["k"] * (v["h"] - v["h0"])


class Body(_Pulled):
    """The mass on its spring, stepped by its closed form under a steady pull."""

    summary = "Mass of a release case"
    experiment: ClassVar[Mapping[str, float]] = {"stepSize": 1e-6}
    ports = (
        Port("F", "N", causality="input", label="force of the film"),
        Port("h", "m", causality="output", label="gap", depends_on=("h0",)),
        Port("v", "m/s", causality="output", label="speed"),
        Port("t_release", "s", causality="output", label="time of the release", start=-1.0),
        Port("m", "kg", causality="parameter", label="mass", start=0.02),
        Port("h_rel", "m", causality="parameter", label="gap of release", start=1e-4),
        *_SHARED,
    )

    def prepare(self) -> None:
        self.values.update(h=self.values["h0"], v=0.0, t_release=-1.0)

    def advance(self, time: float, step: float) -> None:
        v = self.values
        net, before = self.pull(time + 0.5 * step) - v["F"], v["h"]
        rest, rate = v["h0"] + net / v["k"], math.sqrt(v["k"] / v["m"])
        x, c, s = v["h"] - rest, math.cos(rate * step), math.sin(rate * step)
        v["h"], v["v"] = rest + x * c + v["v"] / rate * s, v["v"] * c - x * rate * s
        if v["t_release"] < 0.0 and v["h"] >= v["h_rel"]:
            fraction = (v["h_rel"] - before) / (v["h"] - before)
            v["t_release"] = time + fraction * step

    def hidden_state(self) -> Mapping[str, Any]:
        return {}
