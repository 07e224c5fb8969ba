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

from ..errors import ConvergenceError, DescriptionError, InfeasibleError
from .instance import Instance
from .ports import Port

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
    n_steps : int
        Communication steps.
    seconds : float
        Time spent in the steps [s].
    """

    time: NDArray[np.float64]
    columns: Mapping[str, NDArray[np.float64]] = field(repr=False)
    ports: Mapping[str, Port] = field(repr=False)
    log: tuple[str, ...] = field(repr=False)
    n_steps: int
    seconds: float

    def __getitem__(self, name: str) -> NDArray[np.float64]:
        """Return the output of a name."""
        return self.columns[name]


def cosimulate(
    drive: str | Path,
    mass: str | Path,
    stop_time: float,
    step: float,
    *,
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
    step : float
        Communication step [s]; shortened so that a whole number of them fits.
    drive_start, mass_start : mapping, optional
        Start values by variable name, in SI units; those baked into the FMUs if not given.
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
        If a time is not positive and finite.
    """
    import numpy as np

    for name, value in (("stop_time", stop_time), ("step", step)):
        if not (math.isfinite(value) and value > 0.0):
            raise DescriptionError(name, value, "be positive and finite", unit="s")
    n = max(1, math.ceil(stop_time / step - 1e-9))
    length = stop_time / n
    with Instance(Path(drive)) as one, Instance(Path(mass)) as other:
        one.start(drive_start or {}, stop_time)
        other.start(mass_start or {}, stop_time)
        _check_step(one, other, length)
        table = np.empty((n + 1, len(one.names) + len(other.names)))
        table[0] = one.outputs() + other.outputs()
        begun = clock.perf_counter()
        time = 0.0
        for i in range(n):
            _exchange(one, other, time, length, linear)
            time = (i + 1) * length
            table[i + 1] = one.outputs() + other.outputs()
            if progress is not None and i % 200 == 0:
                progress(i / n)
        seconds = clock.perf_counter() - begun
        if abs(time - stop_time) > 1e-9 * stop_time:
            raise ConvergenceError(f"co-simulation ended at {time!r} s, not at {stop_time!r} s")
        names, log = one.names + other.names, tuple(one.log + other.log)
    table.flags.writeable = False
    columns = {name: table[:, k] for k, name in enumerate(names)}
    return CoSimulation(np.linspace(0.0, stop_time, n + 1), columns, _ports(), log, n, seconds)


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


def _check_step(drive: Instance, mass: Instance, length: float) -> None:
    """Refuse a step at which a blow on the stop would feed on itself, and look like an answer."""
    m = mass.get(mass.references("m"))[0]
    stiffness = drive.get(drive.references("k_stop"))[0]
    longest = 2.0 * math.sqrt(m / stiffness)
    if length > longest:
        raise InfeasibleError(
            f"the communication step of {length:g} s exceeds {longest:.3g} s = 2 sqrt(m/k_stop), "
            f"the longest with which the stop can be coupled to the mass; take a tenth of that"
        )


def _exchange(drive: Instance, mass: Instance, time: float, length: float, linear: bool) -> None:
    """One communication step: the drive with the motion so far, the mass with the pull found."""
    motion, pull = mass.references("h", "v"), mass.references("F_ext", "dF_ext")
    drive.set(drive.references("h", "v"), mass.get(motion))
    before = drive.get(drive.references("F_ext"))[0]
    drive.step(time, length)
    rate = drive.get(drive.references("dF_ext"))[0] if linear else 0.0
    mass.set(pull, [before, rate])
    mass.step(time, length)


def _ports() -> dict[str, Port]:
    from .stiction_mass import StictionMass
    from .valve_drive import ValveDrive

    tables = (*StictionMass.ports, *ValveDrive.ports)
    return {port.name: port for port in tables if port.causality == "output"}
