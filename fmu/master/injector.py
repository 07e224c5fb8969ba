"""The master: couples the FMUs ``valve-drive`` and ``stiction-mass`` through fmpy.

Gauss-Seidel with the film last. In each communication step the drive goes first, with the gap
carried on at its speed; the pull it ends with, and the rate at which it got there, are what the
mass is given, so that the pull is a straight line within a step and the coupling error falls with
the square of the step. The film itself never crosses the interface: the step is limited only by
spring and stop.
"""

from __future__ import annotations

import math
import time as clock
from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, ClassVar

from attrs import field, frozen

from ...errors import ConvergenceError, DescriptionError, InfeasibleError
from ...numerics.step_size import StepSize
from ..framework.ports import Port
from .sides import Fmu, Restorable

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

__all__ = ["CoSimulation", "DriveSide", "Fmu", "MassSide", "Steps", "cosimulate", "coupling_error"]

# What a step may miss, over the tolerance: of the pull, by its bend and by the jump at its end that
# an impact on the stop brings about, and of the gap that the drive went on with. Measured.
_BEND, _JUMP, _DRIFT = 100.0, 600.0, 150.0
# A jump over the pull is allowed at any tolerance up to this: beyond, the step is no approximation,
# and errors no longer fall in proportion to the tolerance.
_MOST = 0.05
_CONTROL = StepSize(order=2, safety=0.85, grow=4.0)
# Fraction of the longest stable step, 2 sqrt(m/k) of mass and stop: at the limit itself round-off
# makes an impact grow.
_STABLE = 0.8
# Fraction of the final time that is tried first, and after a jump of the voltage: the current has
# then hardly risen. Too long a first step is rejected and costs one; too short ones grow fourfold.
_FIRST = 1e-4
_MOST_REJECTED = 60  # in a row, as in `adaptive`


class DriveSide(Restorable):
    """A drive FMU with the variables of ``valve-drive``."""

    model = "valve-drive"
    needed: ClassVar = {"input": ("h", "v"), "output": ("F_ext", "dF_ext")}

    def __init__(self, path: Path) -> None:
        super().__init__(path)
        self._motion, self._pull = self.references("h", "v"), self.references("F_ext")
        self._rate = self.references("dF_ext")

    def set_motion(self, gap: float, speed: float) -> float:
        """Pull [N] at a gap [m] and a speed [m/s], which a step goes on from."""
        self.set(self._motion, (gap, speed))
        return self.get(self._pull)[0]

    def do_step(self, time: float, length: float) -> float:
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

    def do_step(self, time: float, length: float, pull: float, slope: float) -> None:
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
        Steps that were rolled back.
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
        self._pull = drive.set_motion(*mass.motion())
        self._switches = drive.switches()
        self._stop_gap = drive.known("h_stop", math.inf)
        self.motion = mass.motion()

    def step(self) -> None:
        """Take one step, and leave both FMUs at its end; the drive has the motion of the mass."""
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
            self.drive.set_motion(gap, speed)
            length = _CONTROL.shorter(length, error)
        else:
            raise ConvergenceError(
                f"no communication step from {self.time:g} s meets the tolerance; loosen it"
            )
        self.drive.free(marks[0])
        self.mass.free(marks[1])
        is_cut = length < self._length and rejected == self.n_rejected  # by an event
        self._length = _CONTROL.following(length, error, self._length if is_cut else 0.0)
        self._size = abs(after) if motion == (gap, 0.0) else max(self._size, abs(after))
        self.time = end if length == end - self.time else self.time + length
        self._pull, self.motion = after, motion
        self._slope, self._before = slope, length
        if self.time == end:  # the voltage jumps
            self._before, self._length = 0.0, min(self._length, _FIRST * self.stop_time)

    def _try(self, length: float) -> tuple[float, float, float, tuple[float, float]]:
        """Error over what is allowed, the pull after the step [N], its slope [N/s], and motion."""
        slope = self.drive.do_step(self.time, length)
        self.mass.do_step(self.time, length, self._pull, slope)
        begin, guess = self.motion[0], self.motion[0] + self.motion[1] * length
        gap, speed = self.mass.motion()
        after = self.drive.set_motion(gap, speed)
        jump = after - (self._pull + slope * length)
        bend = 0.0
        if self._before > 0.0:  # how the slope changes from the middle of the last step to here
            bend = 2.0 * (slope - self._slope) / (length + self._before)
        size, allowed = max(self._size, abs(after), 1e-300), self._tolerance
        missed = abs(jump) / min(_JUMP * allowed, _MOST), abs(bend) * length**2 / (_BEND * allowed)
        drift = abs(gap - guess) / (_DRIFT * allowed * max(abs(gap), abs(begin)))
        return max(max(missed) / size, drift), after, slope, (gap, speed)


Progress = Callable[[float], None]


@frozen(eq=False)
class CoSimulation:
    """Result of a co-simulation.

    Attributes
    ----------
    time : ndarray
        Communication points [s].
    columns : mapping of str to ndarray
        Every output of both FMUs at the communication points, by its name.
    ports : mapping of str to Port
        What each column is, with its unit.
    log : tuple of str
        Messages of the FMUs.
    n_steps, n_rejected : int
        Communication steps, and those that were taken again, shorter.
    seconds : float
        Wall time of the steps [s].
    """

    time: NDArray[np.float64]
    columns: Mapping[str, NDArray[np.float64]] = field(repr=False)
    ports: Mapping[str, Port] = field(repr=False)
    log: tuple[str, ...] = field(repr=False)
    n_steps: int
    seconds: float
    n_rejected: int = 0

    def __getitem__(self, name: str) -> NDArray[np.float64]:
        """Return the output of a name."""
        return self.columns[name]


def cosimulate(
    drive: str | Path | Fmu,
    mass: str | Path | Fmu,
    stop_time: float,
    step: float | None = None,
    *,
    tolerance: float | None = None,
    linear: bool = True,
    progress: Progress | None = None,
) -> CoSimulation:
    """Couple a drive FMU and a mass FMU.

    Parameters
    ----------
    drive, mass : path or Fmu
        FMUs with the variables of ``valve-drive`` and ``stiction-mass``.
    stop_time : float
        Where to end [s].
    step : float, optional
        Communication step [s]; shortened so that a whole number of them fits.
    tolerance : float, optional
        In place of a step: adaptive steps, so that a release is met to about this, relative to
        its delay. Both FMUs are rolled back where a step was too long. The mass
        integrates its film to a hundredth of that, unless its start values say otherwise.
    linear : bool
        Give the mass the pull as a straight line over the step, by its input ``dF_ext``; else
        hold the value at the start of the step, as a host without that input does.
    progress : callable, optional
        Called with the fraction of the time that is done.

    Raises
    ------
    InfeasibleError
        If the step is too long for the stop; names the longest.
    ConvergenceError
        If an FMU does not accept a step, or the final time is not reached.
    DescriptionError
        If a time is not positive and finite, a file is not such an FMU of FMI 2.0, or a start value
        is not one.
    ContactkitError
        If an FMU cannot be loaded here, or refuses a start value; with what it said.
    """
    import numpy as np

    march = _march(stop_time, step, tolerance, linear, progress or _nothing)
    left, right = Fmu.of(drive), Fmu.of(mass)
    with DriveSide(Path(left.path)) as one, MassSide(Path(right.path)) as other:
        one.start(left.start, stop_time)
        inner = {"rtol": 1e-2 * tolerance} if tolerance and "rtol" in other.variables else {}
        other.start({**inner, **right.start}, stop_time)
        begun = clock.perf_counter()
        times, rows, rejected = march(one, other)
        seconds = clock.perf_counter() - begun
        names, log = one.names + other.names, tuple(one.log + other.log)
    table = np.array(rows)
    table.flags.writeable = False
    columns = {name: table[:, k] for k, name in enumerate(names)}
    return CoSimulation(np.array(times), columns, _ports(), log, len(times) - 1, seconds, rejected)


def _nothing(fraction: float) -> None:
    """Report to nobody."""


_Marched = tuple[list[float], list[list[float]], int]
"""Communication points, outputs at them, and how often a step was rolled back."""


def _march(
    stop_time: float,
    step: float | None,
    tolerance: float | None,
    linear: bool,
    progress: Progress,
) -> Callable[[DriveSide, MassSide], _Marched]:
    """Check the times and return what takes the steps: equal ones, or by the tolerance."""
    for name, value in (("stop_time", stop_time), ("step", 1.0 if step is None else step)):
        if not (math.isfinite(value) and value > 0.0):
            raise DescriptionError(name, value, "be positive and finite", unit="s")
    if tolerance is not None and not 1e-8 <= tolerance <= 0.1:
        raise DescriptionError("tolerance", tolerance, "be between 1e-8 and 0.1")
    if step is not None and tolerance is None:
        length = stop_time / max(1, math.ceil(stop_time / step - 1e-9))
        return lambda drive, mass: _fixed(drive, mass, stop_time, length, linear, progress)
    if tolerance is not None and step is None:
        return lambda drive, mass: _chosen(drive, mass, stop_time, tolerance, progress)
    raise DescriptionError("step", step, "be given, or else a tolerance", unit="s")


def _fixed(
    drive: DriveSide,
    mass: MassSide,
    stop_time: float,
    length: float,
    linear: bool,
    progress: Progress,
) -> _Marched:
    """Take equal steps of a length [s] that the end stop allows."""
    _check_step(drive, mass, length)
    n = round(stop_time / length)
    times, rows = [0.0], [drive.outputs() + mass.outputs()]
    for i in range(n):
        pull = drive.set_motion(*mass.motion())
        slope = drive.do_step(times[-1], length)
        mass.do_step(times[-1], length, pull, slope if linear else 0.0)
        times.append((i + 1) * length)
        rows.append(drive.outputs() + mass.outputs())
        if i % 200 == 0:
            progress(i / n)
    return times, rows, 0


def _chosen(
    drive: DriveSide, mass: MassSide, stop_time: float, tolerance: float, progress: Progress
) -> _Marched:
    """Take adaptive steps."""
    steps = Steps(drive, mass, stop_time, tolerance, _longest(drive, mass))
    times, rows = [0.0], [drive.outputs() + mass.outputs()]
    while steps.time < stop_time:
        steps.step()
        times.append(steps.time)
        rows.append(drive.outputs() + mass.outputs())
        if len(times) % 50 == 0:
            progress(steps.time / stop_time)
    return times, rows, steps.n_rejected


def coupling_error(coupled: Sequence[float], whole: Sequence[float]) -> float:
    """Largest relative difference of release delays [-] between a coupled and a monolithic solve.

    Parameters
    ----------
    coupled, whole : sequence of float
        Release delay of each firing cycle [s]; nan where there was no release.

    Returns
    -------
    float
        nan if neither ever releases; inf if only one of them does in some cycle.

    Examples
    --------
    >>> round(coupling_error([1.001e-3, 2e-3], [1e-3, 2e-3]), 9)
    0.001
    >>> coupling_error([1e-3], [float("nan")])
    inf
    """
    worst = math.nan
    for one, other in zip(coupled, whole, strict=True):
        if math.isnan(one) != math.isnan(other):
            return math.inf
        if not math.isnan(one):
            error = abs(one / other - 1.0)
            worst = error if math.isnan(worst) else max(worst, error)
    return worst


def _longest(drive: DriveSide, mass: MassSide) -> float:
    """Longest step [s] with which the stop can be coupled to the mass."""
    m = mass.get(mass.references("m"))[0]
    return 2.0 * math.sqrt(m / drive.known("k_stop", 1e-300))


def _check_step(drive: DriveSide, mass: MassSide, length: float) -> None:
    """Refuse a step at which an impact on the stop would be unstable, and look like an answer."""
    longest = _longest(drive, mass)
    if length > longest:
        raise InfeasibleError(
            f"the communication step of {length:g} s exceeds {longest:.3g} s = 2 sqrt(m/k_stop), "
            f"the longest with which the stop can be coupled to the mass; take a tenth of that"
        )


def _ports() -> dict[str, Port]:
    from ..slaves.stiction_mass import StictionMass
    from ..slaves.valve_drive import ValveDrive

    tables = (*StictionMass.ports, *ValveDrive.ports)
    return {port.name: port for port in tables if port.causality == "output"}
