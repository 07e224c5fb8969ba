"""FMUs of the toy slave, and a host that keeps their log."""

from __future__ import annotations

import importlib.util
import sys
from pathlib import Path
from types import ModuleType
from typing import NamedTuple

import pytest

pytest.importorskip("pythonfmu")
fmpy = pytest.importorskip("fmpy")

from contactkit.fmu.python import build as building  # noqa: E402  # both packages must be there

TOY = Path(__file__).with_name("toy_slave.py")
OK, DISCARD, ERROR = 0, 2, 3


class Entry(NamedTuple):
    status: int
    category: str
    message: str


class Host:
    """One instance of an FMU in fmpy, driven by variable names."""

    def __init__(self, path: Path, folder: Path) -> None:
        from fmpy import fmi2

        description = fmpy.read_model_description(str(path))
        self.variables = {v.name: v for v in description.modelVariables}
        self.log: list[Entry] = []
        self.slave = fmi2.FMU2Slave(
            instanceName="host",
            guid=description.guid,
            unzipDirectory=str(folder),
            modelIdentifier=description.coSimulation.modelIdentifier,
        )
        self.slave.instantiate(callbacks=self._callbacks(fmi2), loggingOn=True)
        self.time = 0.0

    def _callbacks(self, fmi2):
        def keep(_environment, _instance, status, category, message):
            text = message.decode().replace("%%", "\0")
            assert "%" not in text, "a host in C would read this as a format"
            self.log.append(Entry(status, (category or b"").decode(), text.replace("\0", "%")))

        callbacks = fmi2.fmi2CallbackFunctions()
        callbacks.logger = fmi2.fmi2CallbackLoggerTYPE(keep)
        callbacks.allocateMemory = fmi2.defaultCallbacks.allocateMemory
        callbacks.freeMemory = fmi2.defaultCallbacks.freeMemory
        return callbacks

    def _access(self, verb, name):
        kind = self.variables[name].type.replace("Enumeration", "Integer")
        return getattr(self.slave, verb + kind), [self.variables[name].valueReference]

    def set(self, **values):
        for name, value in values.items():
            function, references = self._access("set", name)
            function(references, [value])

    def get(self, name):
        function, references = self._access("get", name)
        return function(references)[0]

    def outputs(self):
        return {n: self.get(n) for n, v in self.variables.items() if v.causality == "output"}

    def start(self, **values):
        self.time = 0.0
        self.slave.setupExperiment(startTime=0.0)
        self.set(**values)
        self.slave.enterInitializationMode()
        self.slave.exitInitializationMode()
        return self

    def step(self, length=0.1, time=None):
        """Status of one step; time goes on if it is accepted."""
        from fmpy.fmi1 import FMICallException

        begin = self.time if time is None else time
        try:
            self.slave.doStep(begin, length)
        except FMICallException as error:
            return error.status
        self.time = begin + length
        return OK

    def reset(self):
        self.slave.reset()
        self.log.clear()
        return self

    @property
    def errors(self):
        return [entry.message for entry in self.log if entry.status in (DISCARD, ERROR)]

    def close(self):
        self.slave.freeInstance()


def _load(path: Path, name: str) -> ModuleType:
    spec = importlib.util.spec_from_file_location(f"contactkit.fmu.slaves.{name}", path)
    module = importlib.util.module_from_spec(spec)
    sys.modules[spec.name] = module
    spec.loader.exec_module(module)
    return module


@pytest.fixture(scope="session")
def toy_module():
    building.FMUS["toy"] = ("slaves.toy_slave", "Toy")
    yield _load(TOY, "toy_slave")
    del building.FMUS["toy"], sys.modules["contactkit.fmu.slaves.toy_slave"]


@pytest.fixture
def load_as_fmu_module():
    """Import a file as if it lay in contactkit/fmu."""
    return _load


@pytest.fixture(scope="session")
def toy_fmu(shelf, toy_module):
    return shelf(building.build, "toy")


@pytest.fixture(scope="session", autouse=True)
def _kernels_compiled_once(kernels_compiled_once):
    pass


@pytest.fixture
def open_fmu(shelf):
    """Open FMUs, and close them after the test."""
    hosts = []

    def open_one(path, folder=None):
        hosts.append(Host(path, folder or shelf.unpacked(path)))
        return hosts[-1]

    yield open_one
    for host in hosts:
        host.close()


@pytest.fixture
def toy(toy_fmu, open_fmu):
    return open_fmu(toy_fmu)


@pytest.fixture(scope="session")
def probe(shelf):
    """The kernel of native FMUs as a program that evaluates forces."""
    from native_scenes import compile_probe  # it needs what some machines lack

    return shelf.folder("kernel probe", compile_probe) / "probe"
