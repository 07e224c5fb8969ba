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
from typing import TYPE_CHECKING

from attrs import field, frozen

from ...errors import ConvergenceError, DescriptionError, InfeasibleError
from ..framework.ports import Port
from .zz_cosimulate_steps import DriveSide, MassSide, Steps

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

__all__ = ["CoSimulation", "cosimulate", "coupling_error"]

Progress = Callable[[float], None]


@frozen(eq=False)
class CoSimulation:
    """What a co-simulation gives.

    Attributes
    ----------
    time : ndarray
        Communication points [s].
    columns : mapping of str to ndarray
        Every output of both FMUs at the communication points, by its name.
    ports : mapping of str to Port
        What each column is, with its unit.
    log : tuple of str
        What the FMUs said.
    n_steps, n_rejected : int
        Communication steps, and those that were taken again, shorter.
    seconds : float
        Time spent in the steps [s].
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
    drive: str | Path,
    mass: str | Path,
    stop_time: float,
    step: float | None = None,
    *,
    tolerance: float | None = None,
    drive_start: Mapping[str, float | str] | None = None,
    mass_start: Mapping[str, float | str] | None = None,
    linear: bool = True,
    progress: Progress | None = None,
) -> CoSimulation:
    """Couple a drive FMU and a mass FMU.

    Parameters
    ----------
    drive, mass : path
        FMUs with the variables of ``valve-drive`` and ``stiction-mass``.
    stop_time : float
        Where to end [s].
    step : float, optional
        Communication step [s]; shortened so that a whole number of them fits.
    tolerance : float, optional
        In place of a step: choose the steps by their error, so that a release is met to about
        this, relative to its delay. Both FMUs are taken back where a step was too long. The mass
        integrates its film to a hundredth of that, unless its start values say otherwise.
    drive_start, mass_start : mapping, optional
        Start values by variable name, in SI units or as texts with a unit; those baked into the
        FMUs if not given.
    linear : bool
        Give the mass the pull as a straight line over the step, by its input ``dF_ext``; else
        hold the value at the start of the step, as a host without that input does.
    progress : callable, optional
        Called with the share that is done.

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

    _check(stop_time, step, tolerance)
    with DriveSide(Path(drive)) as one, MassSide(Path(mass)) as other:
        one.start(drive_start or {}, stop_time)
        inner = {"rtol": 1e-2 * tolerance} if tolerance and "rtol" in other.variables else {}
        other.start({**inner, **(mass_start or {})}, stop_time)
        told = progress or _nothing
        begun = clock.perf_counter()
        if tolerance is None:
            assert step is not None  # checked above
            length = stop_time / max(1, math.ceil(stop_time / step - 1e-9))
            _check_step(one, other, length)
            times, rows, rejected = *_fixed(one, other, stop_time, length, linear, told), 0
        else:
            times, rows, rejected = _chosen(one, other, stop_time, tolerance, told)
        seconds = clock.perf_counter() - begun
        if abs(times[-1] - stop_time) > 1e-9 * stop_time:
            raise ConvergenceError(
                f"co-simulation ended at {times[-1]!r} s, not at {stop_time!r} s"
            )
        names, log = one.names + other.names, tuple(one.log + other.log)
    table = np.array(rows)
    table.flags.writeable = False
    columns = {name: table[:, k] for k, name in enumerate(names)}
    return CoSimulation(
        np.array(times), columns, _ports(), log, len(times) - 1, seconds, rejected
    )  # fmt: skip


def _nothing(share: float) -> None:
    """Tell nobody."""


def _check(stop_time: float, step: float | None, tolerance: float | None) -> None:
    if (step is None) == (tolerance is None):
        raise DescriptionError("step", step, "be given, or else a tolerance", unit="s")
    for name, value in (("stop_time", stop_time), ("step", 1.0 if step is None else step)):
        if not (math.isfinite(value) and value > 0.0):
            raise DescriptionError(name, value, "be positive and finite", unit="s")
    if tolerance is not None and not 1e-8 <= tolerance <= 0.1:
        raise DescriptionError("tolerance", tolerance, "be between 1e-8 and 0.1")


def _fixed(
    drive: DriveSide,
    mass: MassSide,
    stop_time: float,
    length: float,
    linear: bool,
    progress: Progress,
) -> tuple[list[float], list[list[float]]]:
    """Times and outputs at steps of one length."""
    n = round(stop_time / length)
    times, rows = [0.0], [drive.outputs() + mass.outputs()]
    for i in range(n):
        pull = drive.tell(*mass.motion())
        slope = drive.go(times[-1], length)
        mass.go(times[-1], length, pull, slope if linear else 0.0)
        times.append((i + 1) * length)
        rows.append(drive.outputs() + mass.outputs())
        if i % 200 == 0:
            progress(i / n)
    return times, rows


def _chosen(
    drive: DriveSide, mass: MassSide, stop_time: float, tolerance: float, progress: Progress
) -> tuple[list[float], list[list[float]], int]:
    """Times and outputs at steps chosen by their error, and how often one was taken back."""
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
    """Refuse a step at which a blow on the stop would feed on itself, and look like an answer."""
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
