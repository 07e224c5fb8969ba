"""A host of the WebAssembly component of an FMU, as the draft FMI-LS-WASM has it, by wasmtime."""

from __future__ import annotations

import zipfile
from pathlib import Path

import fmpy

PACKAGE = "fmi:fmi3/{}@3.0.0"
OK = "ok"


class Host:
    """A component with the functions that it asks for: how it logs, and its resources."""

    def __init__(self, fmu: Path) -> None:
        import wasmtime
        from wasmtime import component

        self.log: list[tuple[str, str, str, str]] = []
        self.asked: list[str] = []
        self.description = fmpy.read_model_description(str(fmu))
        name = self.description.coSimulation.modelIdentifier
        with zipfile.ZipFile(fmu) as packed:
            binary = packed.read(f"binaries/wasm32-wasip2/{name}.wasm")
            self.files = {
                path.removeprefix("resources/"): packed.read(path)
                for path in packed.namelist()
                if path.startswith("resources/")
            }
        engine = wasmtime.Engine()
        self.store, self.component = wasmtime.Store(engine), component.Component(engine, binary)
        linker = component.Linker(engine)
        with linker.root() as root:
            with root.add_instance(PACKAGE.format("callbacks")) as callbacks:
                callbacks.add_func("log-message", lambda _, *said: self.log.append(said))
            with root.add_instance(PACKAGE.format("resource-dir-callbacks")) as resources:
                resources.add_func("read-file", self._read)
        self.instance = linker.instantiate(self.store, self.component)
        self.variables = {v.name: v for v in self.description.modelVariables}

    def _read(self, _, path):
        self.asked.append(path)
        return self.files.get(path, f"there is no {path}")

    def function(self, interface, name):
        at = self.instance.get_export_index(self.store, PACKAGE.format(interface))
        found = self.instance.get_func(
            self.store, self.instance.get_export_index(self.store, name, at)
        )
        return lambda *given: found(self.store, *given)

    def instantiate(self, name="one", token=None, events=False, early=False, wanted=()):
        make = self.function(
            "co-simulation", "[static]co-simulation-instance.instantiate-co-simulation"
        )
        token = self.description.instantiationToken if token is None else token
        handle = make(name, token, False, True, events, early, list(wanted))
        return None if handle is None else Instance(self, handle)


class Instance:
    """An instance, whose methods have the names of the draft with underscores."""

    def __init__(self, host, handle):
        self._host, self._handle = host, handle

    def __getattr__(self, name):
        call = self._host.function(
            "co-simulation", f"[method]co-simulation-instance.{name.replace('_', '-')}"
        )
        return lambda *given: call(self._handle, *given)

    def references(self, *names):
        return [self._host.variables[name].valueReference for name in names]

    def set(self, **values):
        return self.set_float64(self.references(*values), list(values.values()))

    def get(self, *names):
        return self.get_float64(self.references(*names))

    def start(self, stop=None, **values):
        if values:
            assert self.set(**values) == OK
        assert self.enter_initialization_mode(None, 0.0, stop) == OK
        assert self.exit_initialization_mode() == OK
        return self

    def step(self, time, length):
        """Fields of a step by their names, or the status that it ended with."""
        found = self.do_step(time, length, False)
        return found if isinstance(found, str) else vars(found)

    def drop(self):
        self._handle.drop(self._host.store)
