"""The coupled subsystems of a run: a film that can be tried, and the source of the pull.

Both can be rolled back to an earlier point, so that a step can be tried with another length or
another end. A film is the FMU ``stiction-force``; a pull is a function of time, or an FMU such as
``valve-drive`` that answers to the motion.
"""

from __future__ import annotations

import ctypes
import math
from collections.abc import Callable, Mapping
from pathlib import Path
from types import MappingProxyType
from typing import Any, ClassVar, NamedTuple, Protocol

from ...errors import DescriptionError
from ..framework.instance import Instance

__all__ = [
    "DrivePull",
    "FilmSide",
    "Fmu",
    "Force",
    "GivenPull",
    "Pulling",
    "Reaction",
    "Restorable",
]

_LIMITS = ("dp_cav", "dp_inception", "tau_lim")
Pulling = Callable[[float], float]
"""Pull [N] at a time [s]."""


class Fmu(NamedTuple):
    """An FMU, and start values that replace those baked into it.

    `start` is by variable, in SI units or as texts with a unit.
    """

    path: str | Path
    start: Mapping[str, float | str] = MappingProxyType({})

    @classmethod
    def of(cls, given: str | Path | Fmu) -> Fmu:
        """FMU of a path, with its own start values."""
        return given if isinstance(given, Fmu) else cls(given)


class Reaction(NamedTuple):
    """Outputs of a film at the end of a step."""

    impulse: float  # viscous, since the start [N.s]
    static: float  # force that does not depend on speed [N]
    force: float  # all of it [N]
    damping: float  # dF/dv [N.s/m]
    above: float  # next gap above at which a force is not smooth [m]; 0: none
    below: float  # next gap below [m]; 0: none
    broken_at: float  # time of the latest rupture [s]; -1 before


class Force(NamedTuple):
    """Forces of a film at a gap and a speed, without a step."""

    force: float  # all of it [N]
    static: float  # what does not depend on speed [N]
    damping: float  # dF/dv [N.s/m]
    stiffness: float  # dF/dh [N/m]


_FORCES = ("F", "F_m", "c", "k")
_ANSWERS = ("J", "F_m", "F", "c", "h_above", "h_below", "t_break")
_OWN = {
    "h": "h0, the gap at which the film begins",
    "v": "Mass.speed",
    "m_ref": "Mass.mass",
    "exchange": "the coupling scheme",
}


class Restorable(Instance):
    """An FMU that can be rolled back."""

    _now: Any = None  # the state in which it is, if it has not moved since

    def save(self) -> Any:
        """State of the FMU, to be given to `restore`, and at last to `free`."""
        mark = ctypes.c_void_p()
        self._do("fmi2GetFMUstate", ctypes.byref(mark))
        self._now = mark, len(self.log)
        return self._now

    def restore(self, state: Any) -> None:
        """Roll back to a state; messages since then are dropped."""
        if self._now is not state:
            self._do("fmi2SetFMUstate", state[0])
            del self.log[state[1] :]
            self._now = state

    def step(self, time: float, length: float) -> None:
        """See `Instance.step`."""
        self._now = None
        super().step(time, length)

    def free(self, state: Any) -> None:
        """Free a state."""
        self._do("fmi2FreeFMUstate", ctypes.byref(state[0]))


class FilmSide(Restorable):
    """The FMU ``stiction-force`` as the master uses it; a context that cleans up."""

    model = "stiction-force"
    needed: ClassVar = {
        "input": ("h", "v"),
        "output": (*_ANSWERS, "k", "limit"),
        "parameter": ("h0", "m_ref", "exchange", "dp_cav", "tau_lim"),
    }
    calls = asked = 0
    power = 3.0  # with which the damping fell last

    def begin(
        self, values: Mapping[str, float | str], mass: float, speed: float, exchange: str
    ) -> Reaction:
        """Initialize with start values; the gap is that of the film, the mass the master's."""
        self._motion, self._answers = self.references("h", "v"), self.references(*_ANSWERS)
        self._forces, self._limit = self.references(*_FORCES), self.references("limit")
        for name in _OWN.keys() & values.keys():
            raise DescriptionError(
                f"start[{name!r}] of the film",
                values[name],
                "be left out: the master sets it",
                hint=f"it follows from {_OWN[name]}",
            )
        gap = self.quantity("h0", values.get("h0", float(self.variables["h0"].start)))
        if not 0.0 < gap < math.inf:
            raise DescriptionError("h0", gap, "be positive and finite", unit="m")
        own: dict[str, float | str] = {"h": gap, "v": speed, "m_ref": mass, "exchange": exchange}
        self.start({**values, **own}, None)
        self.first_gap = gap
        limits = [name for name in _LIMITS if name in self.variables]
        self.has_limits = max(self.get(self.references(*limits))) > 0.0
        return self.look()

    def look(self) -> Reaction:
        """Answers at the motion set last."""
        return Reaction(*self.get(self._answers))

    def feel(self, gap: float, speed: float) -> Force:
        """Forces at a gap [m] and a speed [m/s]; nothing else in the film changes."""
        self.asked += 1
        self.set(self._motion, [gap, speed])
        return Force(*self.get(self._forces))

    def limit(self) -> int:
        """Limit that acts at the gap and speed set last."""
        return self.get_integers(self._limit)[0]

    def move(self, time: float, length: float, gap: float, speed: float) -> Reaction:
        """Take a step from `time` [s] that ends at a gap [m] with a speed [m/s]."""
        self.calls += 1
        self.set(self._motion, [gap, speed])
        self.step(time, length)
        return self.look()


class Pull(Protocol):
    """Source of the pull on the mass that can be rolled back."""

    def over(self, time: float, length: float, gap: float, speed: float) -> Pulling:
        """Go over a step that begins at `time` [s]; gap [m] and speed [m/s] are those there."""

    def save(self) -> Any:
        """State of the FMU to roll back to."""

    def restore(self, state: Any) -> None:
        """Go back to it."""

    def free(self, state: Any) -> None:
        """Free it."""


class GivenPull:
    """A pull that is a function of time."""

    def __init__(self, force: Pulling) -> None:
        self._force = force

    def force(self, time: float) -> float:
        """Pull [N] at a time [s], which must be a finite number."""
        found = self._force(time)
        try:
            if math.isfinite(found):
                return found
        except TypeError:
            pass
        raise DescriptionError(f"pull at t = {time:g} s", found, "be a finite number", unit="N")

    def over(self, time: float, length: float, gap: float, speed: float) -> Pulling:
        """See `Pull.over`."""
        return self.force

    def save(self) -> None:
        """See `Pull.save`: nothing changes."""

    def restore(self, state: None) -> None:
        """See `Pull.restore`."""

    def free(self, state: None) -> None:
        """See `Pull.free`."""


class DrivePull(Restorable):
    """A drive FMU with the variables of ``valve-drive``; its pull is a line within a step."""

    model = "valve-drive"
    needed: ClassVar = {"input": ("h", "v"), "output": ("F_ext", "dF_ext")}

    def over(self, time: float, length: float, gap: float, speed: float) -> Pulling:
        """See `Pull.over`."""
        pull, rate = self.references("F_ext"), self.references("dF_ext")
        self.set(self.references("h", "v"), [gap, speed])
        first = self.get(pull)[0]
        self.step(time, length)
        slope = self.get(rate)[0]
        return lambda at: first + slope * (at - time)
