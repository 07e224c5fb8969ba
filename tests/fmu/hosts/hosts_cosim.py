"""libcosim, by its Python package: a host in C++ that nobody here wrote.

Its times are whole nanoseconds, and all FMUs take a step at once with what the others had before.
"""

from __future__ import annotations

import fmpy
from libcosimpy.CosimExecution import CosimExecution
from libcosimpy.CosimLogging import CosimLogLevel, log_output_level
from libcosimpy.CosimManipulator import CosimManipulator
from libcosimpy.CosimObserver import CosimObserver
from libcosimpy.CosimSlave import CosimLocalSlave

NANO = 1_000_000_000
log_output_level(CosimLogLevel.ERROR)


class Cosim:
    """An execution of FMUs by name, connected by `a.x -> b.y`."""

    def __init__(self, fmus: dict, step: float) -> None:
        self.execution = CosimExecution.from_step_size(round(step * NANO))
        self.variables, self.index = {}, {}
        for name, path in fmus.items():
            description = fmpy.read_model_description(str(path))
            self.variables[name] = {v.name: v for v in description.modelVariables}
            slave = CosimLocalSlave(fmu_path=str(path), instance_name=name)
            self.index[name] = self.execution.add_local_slave(local_slave=slave)
        self.observer = CosimObserver.create_last_value()
        assert self.execution.add_observer(self.observer)
        self.manipulator = CosimManipulator.create_override()
        assert self.execution.add_manipulator(self.manipulator)

    def connect(self, *wires: str):
        for wire in wires:
            (a, x), (b, y) = (end.split(".") for end in wire.split(" -> "))
            assert (
                self.execution.connect_real_variables(
                    self.index[a], self.reference(a, x), self.index[b], self.reference(b, y)
                )
                == 0
            )
        return self

    def set(self, name: str, **values: float):
        for variable, value in values.items():
            reference = [self.reference(name, variable)]
            assert self.manipulator.slave_real_values(self.index[name], reference, [value])
        return self

    def reference(self, name: str, variable: str) -> int:
        return int(self.variables[name][variable].valueReference)

    def run(self, until: float):
        """Run to a time, and see that it was reached: a host may end early without a word."""
        assert self.execution.simulate_until(round(until * NANO))
        assert self.execution.status().current_time == round(until * NANO)
        return self

    def get(self, name: str, variable: str):
        found = self.variables[name][variable]
        read = {
            "Real": self.observer.last_real_values,
            "Boolean": self.observer.last_boolean_values,
        }.get(found.type, self.observer.last_integer_values)
        return read(self.index[name], [self.reference(name, variable)])[0]


__all__ = ["Cosim"]
