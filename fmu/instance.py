"""One FMU in fmpy, driven by the names of its variables."""

from __future__ import annotations

import shutil
import tempfile
from collections.abc import Mapping
from pathlib import Path
from typing import Any, Self

from ..errors import ConvergenceError, DescriptionError

__all__ = ["Instance"]


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

    def start(self, values: Mapping[str, float | str], stop_time: float) -> None:
        """Initialize with start values by name; an enumeration takes the name of an item too."""
        self._slave.setupExperiment(startTime=0.0, stopTime=stop_time)
        for name, value in values.items():
            if name not in self.variables:
                raise DescriptionError(name, value, f"be a variable of {self._slave.instanceName}")
            variable = self.variables[name]
            if variable.type == "Real":
                self._slave.setReal([variable.valueReference], [float(value)])
            else:
                self._slave.setInteger([variable.valueReference], [_whole(variable, value)])
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

    def get_integers(self, references: list[int]) -> list[int]:
        """Read whole numbers and members of enumerations."""
        values: list[int] = self._slave.getInteger(references)
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


def _whole(variable: Any, value: float | str) -> int:
    """Whole number of a start value, which may be the name of an enumeration's item."""
    if not isinstance(value, str):
        return int(value)
    items = {item.name: int(item.value) for item in variable.declaredType.items}
    if value not in items:
        raise DescriptionError(variable.name, value, f"be one of {', '.join(items)}")
    return items[value]
