"""Look-up tables of a class of slaves, made once from its ports, so that calls are cheap."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Mapping, Sequence
from itertools import product
from operator import itemgetter
from typing import Any

from ...errors import DescriptionError
from .description import value_references
from .ports import Port, find_port

__all__ = ["Tables"]

Settable = Mapping[int, tuple[str, float, float]]  # value reference: name, lowest, highest


class Tables:
    """Names, ranges and kinds of ports by value reference.

    Raises
    ------
    DescriptionError
        If two ports share a name, or an output depends on something that is not an input or a
        parameter.
    """

    def __init__(self, ports: Sequence[Port]) -> None:
        self.ports = {reference: port for port, reference in _numbered(ports)}
        self.names = {
            kind: {ref: port.name for ref, port in self.ports.items() if _fmi_type(port) == kind}
            for kind in ("real", "integer", "boolean")
        }
        self.settable = self._settable("input", "parameter")
        self.inputs = self._settable("input")
        self.closed = self._settable()
        outputs = [port for port in ports if port.causality == "output"]
        numbers = [port for port in outputs if port.kind in ("real", "integer")]
        self._finite_ports = [port for port in numbers if not _endless(port)]
        self._finite = _picker(port.name for port in self._finite_ports)
        self._endless = _picker(port.name for port in numbers if _endless(port))
        self._booleans = _picker(port.name for port in outputs if port.kind == "boolean")
        self._has_endless = any(map(_endless, numbers))
        self._has_booleans = any(port.kind == "boolean" for port in outputs)
        self._enumerations = [port for port in outputs if port.enumeration is not None]
        self._members = _picker(port.name for port in self._enumerations)
        self._known = frozenset(
            product(*(map(int, port.enumeration or ()) for port in self._enumerations))
        )
        self.parameters = _picker(port.name for port in ports if port.causality == "parameter")

    def _settable(self, *causalities: str) -> dict[str, Settable]:
        return {
            kind: {
                ref: (name, *self.ports[ref].limits)
                for ref, name in names.items()
                if self.ports[ref].causality in causalities
            }
            for kind, names in self.names.items()
        }

    def check_outputs(self, values: Mapping[str, Any]) -> None:
        """Refuse outputs that are no finite numbers or in no enumeration, and unknown names."""
        total = sum(self._finite(values))
        if total - total != 0.0:  # nan or infinity somewhere, or a harmless overflow of the sum
            for port in self._finite_ports:
                if not math.isfinite(values[port.name]):
                    raise self._odd_output(port, values)
        if self._enumerations and self._members(values) not in self._known:
            for port in self._enumerations:
                if not port.allows(values[port.name]):
                    raise self._odd_output(port, values)
        if self._has_endless and any(value != value for value in self._endless(values)):
            raise DescriptionError("an output", math.nan, "be a number")
        if self._has_booleans:
            any(self._booleans(values))  # raises if one is neither true nor false
        if len(values) != len(self.ports):
            odd = sorted(set(values) - {port.name for port in self.ports.values()})
            raise DescriptionError("values", odd, "hold the ports and nothing else")

    def _odd_output(self, port: Port, values: Mapping[str, Any]) -> DescriptionError:
        unit = "" if port.unit == "-" else port.unit
        value = values[port.name]
        return DescriptionError(f"output {port.name}", value, port.expectation, unit=unit)

    def refusal(self, kind: str, reference: int, value: Any, phase: str) -> str:
        """Explain why a value cannot be set in a phase; nothing if it can."""
        port = self.ports.get(reference)
        hint = "reset the FMU, then go on without it"
        if port is None or _fmi_type(port) != kind:
            field, expected, unit = f"value reference {reference}", f"be of a {kind} variable", ""
        elif port.causality == "output":
            field, expected, unit = port.name, "not be set, because it is an output", port.unit
        elif port.causality == "parameter" and phase == "stepping":
            field, expected, unit = port.name, "be set before initialization ends", port.unit
            hint = "reset the FMU to change a parameter"
        else:
            field, expected, unit = port.name, port.expectation, port.unit
            hint = "reset the FMU, then set a value in range"
            if phase == "terminated":
                expected, hint = "not be set after the end", "reset the FMU first"
            elif port.allows(value):
                return ""
        unit = "" if unit == "-" else unit
        return str(DescriptionError(field, value, expected, unit=unit, hint=hint))


def _numbered(ports: Sequence[Port]) -> Iterable[tuple[Port, int]]:
    references = value_references(ports)
    if len(references) != len(ports):
        names = [port.name for port in ports]
        twice = sorted({name for name in names if names.count(name) > 1})
        raise DescriptionError("port names", twice, "differ")
    for port in ports:
        for name in port.depends_on or ():
            if find_port(ports, name).causality == "output":
                expected = "name inputs and parameters only"
                raise DescriptionError(f"Port {port.name!r}.depends_on", name, expected)
    return [(port, references[port.name]) for port in ports]


def _fmi_type(port: Port) -> str:
    """Type of the FMI call: enumerations travel as integers."""
    return "integer" if port.kind == "enumeration" else port.kind


def _endless(port: Port) -> bool:
    return any(math.isinf(limit) for limit in port.limits)


def _picker(names: Iterable[str]) -> Callable[[Mapping[str, Any]], tuple[Any, ...]]:
    """Make a function that picks some values as a tuple, fast."""
    wanted = tuple(names)
    if len(wanted) > 1:
        return itemgetter(*wanted)
    return lambda values: tuple(values[name] for name in wanted)
