"""One FMU in fmpy, driven by the names of its variables.

fmpy loads, instantiates and checks. What is called in every step goes to the functions of the
library itself, with arrays that are made once: fmpy makes new ones in each call, which costs more
than many an FMU does.
"""

from __future__ import annotations

import ctypes
import shutil
import tempfile
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any, Self

from ..errors import ConvergenceError, DescriptionError

__all__ = ["Instance"]


_ARRAY = (ctypes.c_void_p, ctypes.c_void_p, ctypes.c_size_t, ctypes.c_void_p)
_FUNCTIONS: Mapping[str, tuple[Any, ...]] = {
    "fmi2GetReal": _ARRAY,
    "fmi2SetReal": _ARRAY,
    "fmi2GetInteger": _ARRAY,
    "fmi2GetBoolean": _ARRAY,
    "fmi2DoStep": (ctypes.c_void_p, ctypes.c_double, ctypes.c_double, ctypes.c_int),
}
_KINDS: Mapping[str, Any] = {
    "Real": ctypes.c_double,
    "Integer": ctypes.c_int,
    "Boolean": ctypes.c_int,
}
_WARNING = 1  # the status up to which a call was answered


def _function(library: Any, name: str, *types: Any) -> Any:
    found = library[name]  # an object of our own: fmpy's are left as they are
    found.argtypes, found.restype = types, ctypes.c_int
    return found


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
        self._functions = {
            name: _function(self._slave.dll, name, *types) for name, types in _FUNCTIONS.items()
        }
        self._step = self._functions["fmi2DoStep"]
        self._me = self._slave.component
        self._arrays: dict[tuple[str, tuple[int, ...]], tuple[Any, Any]] = {}
        outputs = [v for v in description.modelVariables if v.causality == "output"]
        self._reals = [v for v in outputs if v.type == "Real"]
        self._integers = [v for v in outputs if v.type in ("Integer", "Enumeration")]
        booleans = [v for v in outputs if v.type == "Boolean"]
        self.names = [v.name for v in (*self._reals, *self._integers, *booleans)]
        self._boolean_references = [v.valueReference for v in booleans]
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

    def _call(self, name: str, references: Sequence[int], values: Sequence[float] | None) -> Any:
        """Read or, if there are values, write variables; the array that holds them then."""
        key = name, tuple(references)
        if key not in self._arrays:
            n, kind = len(references), _KINDS[name[7:]]
            self._arrays[key] = (ctypes.c_uint * n)(*references), (kind * n)()
        numbers, array = self._arrays[key]
        if values is not None:
            array[:] = values
        status = self._functions[name](self._me, numbers, len(array), array)
        if status > _WARNING:
            from fmpy.fmi1 import FMICallException

            raise FMICallException(name, status)
        return array

    def set(self, references: Sequence[int], values: Sequence[float]) -> None:
        """Set real inputs."""
        self._call("fmi2SetReal", references, values)

    def get(self, references: Sequence[int]) -> list[float]:
        """Read real outputs."""
        found: list[float] = self._call("fmi2GetReal", references, None)[:]
        return found

    def get_integers(self, references: Sequence[int]) -> list[int]:
        """Read whole numbers and members of enumerations."""
        found: list[int] = self._call("fmi2GetInteger", references, None)[:]
        return found

    def outputs(self) -> list[float]:
        """Read all outputs, in the order of `names`."""
        values = self.get(self._real_references)
        if self._integer_references:
            values += self.get_integers(self._integer_references)
        if self._boolean_references:
            values += self._call("fmi2GetBoolean", self._boolean_references, None)[:]
        return values

    def step(self, time: float, length: float) -> None:
        """Take a communication step.

        Raises
        ------
        ConvergenceError
            If the FMU does not accept it; the message is the last the FMU logged.
        """
        status = self._step(self._me, time, length, 1)
        if status > _WARNING:
            said = self.log[-1] if self.log else "it logged nothing"
            raise ConvergenceError(
                f"{self._slave.instanceName} stopped at t = {time:g} s with status {status}: {said}"
            )

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
