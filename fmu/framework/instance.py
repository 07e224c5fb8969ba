"""One FMU in fmpy, driven by the names of its variables.

fmpy loads, instantiates and checks. What is called in every step goes to the functions of the
library itself, with arrays that are made once: fmpy makes new ones in each call, which costs more
than many an FMU does.
"""

from __future__ import annotations

import ctypes
import math
import re
import shutil
import tempfile
from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager
from numbers import Real
from pathlib import Path
from typing import Any, ClassVar, Self

from ...errors import ContactkitError, ConvergenceError, DescriptionError
from ...units import parse_quantity
from .model_file import read_model

__all__ = ["Instance"]


_ARRAY = (ctypes.c_void_p, ctypes.c_void_p, ctypes.c_size_t, ctypes.c_void_p)
_FUNCTIONS: Mapping[str, tuple[Any, ...]] = {
    "fmi2GetReal": _ARRAY,
    "fmi2SetReal": _ARRAY,
    "fmi2GetInteger": _ARRAY,
    "fmi2GetBoolean": _ARRAY,
    "fmi2DoStep": (ctypes.c_void_p, ctypes.c_double, ctypes.c_double, ctypes.c_int),
    "fmi2GetFMUstate": (ctypes.c_void_p, ctypes.POINTER(ctypes.c_void_p)),
    "fmi2SetFMUstate": (ctypes.c_void_p, ctypes.c_void_p),
    "fmi2FreeFMUstate": (ctypes.c_void_p, ctypes.POINTER(ctypes.c_void_p)),
}
_KINDS: Mapping[str, Any] = {
    "Real": ctypes.c_double,
    "Integer": ctypes.c_int,
    "Boolean": ctypes.c_int,
}
_IDENTIFIER = re.compile(r"[A-Za-z_][A-Za-z0-9_]{0,200}")
_WHOLE = 2**31  # whole numbers of FMI are below
_WARNING = 1  # the status up to which a call was answered


def _function(library: Any, name: str, *types: Any) -> Any:
    found = library[name]  # an object of our own: fmpy's are left as they are
    found.argtypes, found.restype = types, ctypes.c_int
    return found


class Instance:
    """One FMU in fmpy, driven by the names of its variables; a context that cleans up.

    A file that is no FMU 2.0 for co-simulation, or lacks a variable that is needed, is refused.
    """

    model: ClassVar[str] = ""
    """Whose variables are needed, for messages."""
    needed: ClassVar[Mapping[str, Sequence[str]]] = {}
    """Names of variables it must have, by their causality."""

    def __init__(self, path: Path) -> None:
        self.log: list[str] = []
        description = _described(path)
        self.variables = {v.name: v for v in description.modelVariables}
        self._check_variables(path)
        self._folder = tempfile.mkdtemp(prefix="contactkit-")
        if not self._folder.isascii() or set("#%") & set(self._folder):
            shutil.rmtree(self._folder)
            raise DescriptionError(
                "TMPDIR",
                self._folder,
                "be a path of plain letters without # or %",
                hint="pythonfmu ends the whole process on others; set TMPDIR to another folder",
            )
        try:
            self._slave = self._loaded(path, description)
        except BaseException:
            shutil.rmtree(self._folder, ignore_errors=True)
            raise
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

    def _check_variables(self, path: Path) -> None:
        """Refuse an FMU without the variables that are needed."""
        missing = [
            f"{name} ({causality})"
            for causality, names in self.needed.items()
            for name in names
            if name not in self.variables or self.variables[name].causality != causality
        ]
        if missing:
            raise DescriptionError(
                "FMU",
                str(path),
                f"have the variables of {self.model}: it lacks {', '.join(missing)}",
                hint=f"take an FMU of the model {self.model}",
            )

    def _loaded(self, path: Path, description: Any) -> Any:
        """Unpack and instantiate."""
        from fmpy import extract
        from fmpy.fmi2 import FMU2Slave

        try:
            extract(str(path), self._folder)
            slave = FMU2Slave(
                instanceName=path.stem,
                guid=description.guid,
                unzipDirectory=self._folder,
                modelIdentifier=description.coSimulation.modelIdentifier,
            )
            slave.instantiate(callbacks=self._callbacks(), loggingOn=True)
        except Exception as error:  # fmpy raises no narrower one
            said = "".join(f"; it said: {line}" for line in self.log[-1:])
            raise ContactkitError(
                f"the FMU {path} cannot be loaded here: {error}{said}; build it on this computer"
            ) from error
        return slave

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

    def start(self, values: Mapping[str, float | str], stop_time: float | None) -> None:
        """Initialize with start values by name: SI numbers, or texts with a unit.

        An enumeration takes the name of an item too. Without a stop time [s] there is no end.

        What the FMU refuses is an error with what it said.
        """
        self._slave.setupExperiment(startTime=0.0, stopTime=stop_time)
        for name, value in values.items():
            real = self._variable(name, value).type == "Real"
            found = self.quantity(name, value) if real else _whole(self.variables[name], value)
            put = self._slave.setReal if real else self._slave.setInteger
            with self._answering(f"refused {name} = {value!r}"):
                put(self.references(name), [found])
        with self._answering("cannot start with these values"):
            self._slave.enterInitializationMode()
            self._slave.exitInitializationMode()

    def _variable(self, name: str, value: object) -> Any:
        if name not in self.variables:
            raise DescriptionError(name, value, f"be a variable of {self._slave.instanceName}")
        return self.variables[name]

    def quantity(self, name: str, value: float | str) -> float:
        """Value of a real variable in its own SI unit; a text carries a unit."""
        unit = self._variable(name, value).unit or "-"
        number = _number(name, value, unit)
        if math.isnan(number):
            raise DescriptionError(name, value, "be a number", unit=unit)
        return number

    @contextmanager
    def _answering(self, what: str) -> Iterator[None]:
        """Let a call that fails say what the FMU said."""
        from fmpy.fmi1 import FMICallException

        heard = len(self.log)
        try:
            yield
        except FMICallException as error:
            said = self.log[-1] if len(self.log) > heard else "it logged nothing"
            raise ContactkitError(f"{self._slave.instanceName} {what}: {said}") from error

    def references(self, *names: str) -> list[int]:
        """Value references of variables."""
        return [self._variable(name, None).valueReference for name in names]

    def _do(self, name: str, *arguments: Any) -> None:
        """Call a function of the library that gives back a status."""
        status = self._functions[name](self._me, *arguments)
        if status > _WARNING:
            said = self.log[-1] if self.log else "it logged nothing"
            raise ConvergenceError(
                f"{self._slave.instanceName} answered {name} with status {status}: {said}"
            )

    def _call(self, name: str, references: Sequence[int], values: Sequence[float] | None) -> Any:
        """Read or, if there are values, write variables; the array that holds them then."""
        key = name, tuple(references)
        if key not in self._arrays:
            n, kind = len(references), _KINDS[name[7:]]
            self._arrays[key] = (ctypes.c_uint * n)(*references), (kind * n)()
        numbers, array = self._arrays[key]
        if values is not None:
            array[:] = values
        self._do(name, numbers, len(array), array)
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


def _number(name: str, value: Any, unit: str) -> float:
    """Read a number of any kind, or a text with a unit."""
    return float(value) if isinstance(value, Real) else parse_quantity(value, unit, name)


def _whole(variable: Any, value: float | str) -> int:
    """Whole number of a start value, which may be the name of an enumeration's item."""
    declared = variable.declaredType
    items = {item.name: int(item.value) for item in (declared.items if declared else None) or ()}
    if items:
        number = items.get(value, math.nan) if isinstance(value, str) else value
        if number not in items.values():
            raise DescriptionError(variable.name, value, f"be one of {', '.join(items)}")
        return int(number)
    number = _number(variable.name, value, "-")
    if not (number.is_integer() and abs(number) < _WHOLE):
        raise DescriptionError(variable.name, value, "be a whole number that FMI can hold")
    return int(number)


def _described(path: Path) -> Any:
    """Model description of a file that must be an FMU 2.0 for co-simulation."""
    found = read_model(path)
    if found.fmiVersion != "2.0":
        hint = f"this is one of FMI {found.fmiVersion}: take the FMI 2 build"
        raise DescriptionError("FMU", str(path), "be an FMU of FMI 2.0", hint=hint)
    if found.coSimulation is None:
        raise DescriptionError("FMU", str(path), "be an FMU for co-simulation")
    name = found.coSimulation.modelIdentifier
    if not _IDENTIFIER.fullmatch(name):  # part of the path of the library that is loaded
        raise DescriptionError("FMU modelIdentifier", name, "be an identifier of C")
    return found
