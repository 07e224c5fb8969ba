"""The master: couples the FMUs ``valve-drive`` and ``stiction-mass`` through fmpy.

Gauss-Seidel with the film last. In each communication step the drive goes first, with the gap
carried on at its speed; the pull it ends with, and the rate at which it got there, are what the
mass is given, so that the pull is a straight line within a step and the coupling error falls with
the square of the step. The film itself never crosses the interface: the step is limited only by
spring and stop.
"""

from __future__ import annotations

import math
import shutil
import tempfile
import time as clock
from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any, Self

from attrs import field, frozen

from ..errors import ConvergenceError, DescriptionError, InfeasibleError
from .ports import Port

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

__all__ = ["CoSimulation", "Instance", "cosimulate", "coupling_error"]

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


class Instance:
    """One FMU in fmpy, driven by the names of its variables; a context that cleans up."""

    def __init__(self, path: Path) -> None:
        from fmpy import extract, read_model_description
        from fmpy.fmi2 import FMU2Slave

        self.log: list[str] = []
        self._folder = tempfile.mkdtemp(prefix="contactkit-")
        if not self._folder.isascii() or set("#%") & set(self._folder):
            shutil.rmtree(self._folder)
            raise DescriptionError(
                "TMPDIR", self._folder, "be a path of plain letters without # or %",
                hint="pythonfmu ends the whole process on others; set TMPDIR to another folder",
            )  # fmt: skip
        extract(str(path), self._folder)
        description = read_model_description(str(path))
        self.variables = {v.name: v for v in description.modelVariables}
        self._slave = FMU2Slave(
            instanceName=path.stem,
            guid=description.guid,
            unzipDirectory=self._folder,
            modelIdentifier=description.coSimulation.modelIdentifier,
        )
        self._slave.instantiate(callbacks=self._callbacks(), loggingOn=True)
        outputs = [v for v in description.modelVariables if v.causality == "output"]
        self._reals = [v for v in outputs if v.type == "Real"]
        self._integers = [v for v in outputs if v.type != "Real"]
        self.names = [v.name for v in (*self._reals, *self._integers)]
        self._real_references = [v.valueReference for v in self._reals]
        self._integer_references = [v.valueReference for v in self._integers]

    def _callbacks(self) -> Any:
        from fmpy import fmi2

        def keep(_env: Any, _name: Any, _status: int, _category: bytes, message: bytes) -> None:
            self.log.append(message.decode(errors="replace").replace("%%", "%"))

        callbacks = fmi2.fmi2CallbackFunctions()
        callbacks.logger = fmi2.fmi2CallbackLoggerTYPE(keep)
        callbacks.allocateMemory = fmi2.defaultCallbacks.allocateMemory
        callbacks.freeMemory = fmi2.defaultCallbacks.freeMemory
        self._keep = callbacks  # ctypes does not
        return callbacks

    def start(self, values: Mapping[str, float], stop_time: float) -> None:
        """Initialize with start values by name."""
        self._slave.setupExperiment(startTime=0.0, stopTime=stop_time)
        for name, value in values.items():
            if name not in self.variables:
                raise DescriptionError(name, value, f"be a variable of {self._slave.instanceName}")
            variable = self.variables[name]
            if variable.type == "Real":
                self._slave.setReal([variable.valueReference], [float(value)])
            else:
                self._slave.setInteger([variable.valueReference], [int(value)])
        self._slave.enterInitializationMode()
        self._slave.exitInitializationMode()

    def references(self, *names: str) -> list[int]:
        """Value references of variables."""
        return [self.variables[name].valueReference for name in names]

    def set(self, references: list[int], values: list[float]) -> None:
        """Set real inputs."""
        self._slave.setReal(references, values)

    def get(self, references: list[int]) -> list[float]:
        """Read real outputs."""
        values: list[float] = self._slave.getReal(references)
        return values

    def outputs(self) -> list[float]:
        """Read all outputs, in the order of `names`."""
        values = list(self._slave.getReal(self._real_references))
        if self._integer_references:
            values += self._slave.getInteger(self._integer_references)
        return values

    def step(self, time: float, length: float) -> None:
        """Take a communication step.

        Raises
        ------
        ConvergenceError
            If the FMU does not accept it; the message is the last the FMU logged.
        """
        from fmpy.fmi1 import FMICallException

        try:
            self._slave.doStep(time, length)
        except FMICallException as error:
            said = self.log[-1] if self.log else "it logged nothing"
            raise ConvergenceError(
                f"{self._slave.instanceName} stopped at t = {time:g} s with status "
                f"{error.status}: {said}"
            ) from None

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_: object) -> None:
        self._slave.freeInstance()
        shutil.rmtree(self._folder, ignore_errors=True)


def cosimulate(
    drive: str | Path,
    mass: str | Path,
    stop_time: float,
    step: float,
    *,
    drive_start: Mapping[str, float] | None = None,
    mass_start: Mapping[str, float] | None = None,
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
