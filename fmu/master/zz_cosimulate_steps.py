"""Communication steps of drive and mass chosen by their error.

The drive goes first, with the gap carried on at its speed, and the mass gets its pull as a
straight line. What that misses shows when the drive is told where the mass came to: the pull it
gives there differs from the end of the line. Where the slope of the line changes from step to
step, the pull was bent inside. Both are impulses, and are held against the impulse given since
the mass last rested; a step that misses too much is taken back.
"""

from __future__ import annotations

import math
from pathlib import Path
from typing import ClassVar

from ...errors import ConvergenceError
from .sides import Restorable

__all__ = ["DriveSide", "MassSide", "Steps"]

# What a step may miss, over the tolerance: of the pull, by its bend and by the jump at its end that
# a blow on the stop brings about, and of the gap that the drive went on with. Measured.
_BEND, _JUMP, _DRIFT = 100.0, 600.0, 150.0
_MOST = 0.05  # share of the pull that it may jump by at any tolerance
_SAFETY, _SHRINK, _GROW = 0.85, 0.1, 4.0
_STABLE = 0.8  # share of the longest stable step
_FIRST = 1e-4  # share of the whole time that is tried first
_MOST_REJECTED = 60


class DriveSide(Restorable):
    """A drive FMU with the variables of ``valve-drive``."""

    model = "valve-drive"
    needed: ClassVar = {"input": ("h", "v"), "output": ("F_ext", "dF_ext")}

    def __init__(self, path: Path) -> None:
        super().__init__(path)
        self._motion, self._pull = self.references("h", "v"), self.references("F_ext")
        self._rate = self.references("dF_ext")

    def tell(self, gap: float, speed: float) -> float:
        """Pull [N] at a gap [m] and a speed [m/s], which a step goes on from."""
        self.set(self._motion, (gap, speed))
        return self.get(self._pull)[0]

    def go(self, time: float, length: float) -> float:
        """Take a step; the slope of the pull in it [N/s]."""
        self.step(time, length)
        return self.get(self._rate)[0]

    def known(self, name: str, otherwise: float) -> float:
        """Value of a parameter, if there is one."""
        if name not in self.variables:
            return otherwise
        kind = self.variables[name].type
        read = self.get if kind == "Real" else self.get_integers
        return read(self.references(name))[0]

    def switches(self) -> list[float]:
        """Times at which the voltage jumps [s]."""
        begin, period = self.known("t_delay", math.nan), self.known("T_period", math.nan)
        after = 0.0, self.known("t_boost", 0.0), self.known("t_on", 0.0)
        cycles = range(int(self.known("n_cycles", 0)))
        return sorted({begin + n * period + more for n in cycles for more in after})


class MassSide(Restorable):
    """A mass FMU with the variables of ``stiction-mass``."""

    model = "stiction-mass"
    needed: ClassVar = {"input": ("F_ext", "dF_ext"), "output": ("h", "v"), "parameter": ("m",)}

    def __init__(self, path: Path) -> None:
        super().__init__(path)
        self._motion, self._given = self.references("h", "v"), self.references("F_ext", "dF_ext")

    def motion(self) -> tuple[float, float]:
        """Gap [m] and speed [m/s]."""
        gap, speed = self.get(self._motion)
        return gap, speed

    def go(self, time: float, length: float, pull: float, slope: float) -> None:
        """Take a step under a pull [N] that changes by `slope` [N/s]."""
        self.set(self._given, (pull, slope))
        self.step(time, length)


class Steps:
    """Goes from communication point to communication point; `step` takes one.

    Attributes
    ----------
    time : float
        Where it is [s].
    n_rejected : int
        Steps that were taken back.
    """

    def __init__(
        self, drive: DriveSide, mass: MassSide, stop_time: float, tolerance: float, longest: float
    ) -> None:
        self.drive, self.mass, self.stop_time = drive, mass, stop_time
        self.time, self.n_rejected = 0.0, 0
        self._tolerance = tolerance
        self._longest = _STABLE * longest
        self._length = _FIRST * stop_time
        self._size = 0.0  # largest pull since the mass last rested [N]
        self._slope = self._before = 0.0  # of the last step: slope of the pull [N/s], and length
        self._pull = drive.tell(*mass.motion())
        self._switches = drive.switches()
        self._stop_gap = drive.known("h_stop", math.inf)
        self.motion = mass.motion()

    def step(self) -> None:
        """Take one step, and leave both sides at its end, the drive told where the mass is."""
        marks = self.drive.save(), self.mass.save()
        later = self.time + 1e-12 * self.stop_time
        end = min([t for t in self._switches if t > later] + [self.stop_time])
        gap, speed = self.motion
        length, rejected = self._length, self.n_rejected
        way = self._stop_gap - gap
        if 0.0 < way < speed * length:  # the force of the stop has a kink: end there
            length = max(way / speed, 0.1 * min(length, self._longest))
        for _ in range(_MOST_REJECTED):
            if gap + speed * length > self._stop_gap:
                length = min(length, self._longest)
            length = end - self.time if self.time + 1.1 * length > end else length
            error, after, slope, motion = self._try(length)
            if error <= 1.0:
                break
            self.n_rejected += 1
            self.drive.restore(marks[0])
            self.mass.restore(marks[1])
            self.drive.tell(gap, speed)
            length *= max(_SHRINK, _SAFETY * error**-0.5)
        else:
            raise ConvergenceError(
                f"no communication step from {self.time:g} s meets the tolerance; loosen it"
            )
        self.drive.forget(marks[0])
        self.mass.forget(marks[1])
        grown = length * min(_GROW, _SAFETY * max(error, 1e-9) ** -0.5)
        cut = length < self._length and rejected == self.n_rejected  # by an event, not by its error
        self._length = max(grown, self._length) if cut else grown
        self._size = abs(after) if motion == (gap, 0.0) else max(self._size, abs(after))
        self.time = end if length == end - self.time else self.time + length
        self._pull, self.motion = after, motion
        self._slope, self._before = slope, length
        if self.time == end:  # the voltage jumps
            self._before, self._length = 0.0, min(self._length, _FIRST * self.stop_time)

    def _try(self, length: float) -> tuple[float, float, float, tuple[float, float]]:
        """Error over what is allowed, the pull after the step [N], its slope [N/s], and motion."""
        slope = self.drive.go(self.time, length)
        self.mass.go(self.time, length, self._pull, slope)
        begin, guess = self.motion[0], self.motion[0] + self.motion[1] * length
        gap, speed = self.mass.motion()
        after = self.drive.tell(gap, speed)
        jump = after - (self._pull + slope * length)
        bend = 0.0
        if self._before > 0.0:  # how the slope changes from the middle of the last step to here
            bend = 2.0 * (slope - self._slope) / (length + self._before)
        size, allowed = max(self._size, abs(after), 1e-300), self._tolerance
        missed = abs(jump) / min(_JUMP * allowed, _MOST), abs(bend) * length**2 / (_BEND * allowed)
        drift = abs(gap - guess) / (_DRIFT * allowed * max(abs(gap), abs(begin)))
        return max(max(missed) / size, drift), after, slope, (gap, speed)
