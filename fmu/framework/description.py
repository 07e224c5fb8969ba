"""The model description (FMI 2.0) of a table of ports, complete where pythonfmu's is not.

pythonfmu 0.7 writes no units, bounds, enumerations, dependencies or initial unknowns, shortens
start values to 16 digits and numbers value references from 0, which OMSimulator refuses in
dependencies. Here the description is written from the ports alone.
"""

from __future__ import annotations

import datetime
import os
from collections.abc import Mapping, Sequence
from enum import IntEnum
from math import isfinite
from typing import Any
from xml.etree.ElementTree import Element, SubElement

from attrs import field, frozen

from ...units import parse_unit
from .ports import TOLERANCE, Kind, Port, Value, display_conversion

__all__ = [
    "Description",
    "details",
    "enumerations",
    "frame",
    "items",
    "known",
    "model_description",
    "states",
    "unit_definitions",
    "value_references",
]

_TAGS = {
    "real": "Real",
    "integer": "Integer",
    "boolean": "Boolean",
    "enumeration": "Enumeration",
}


_STEPS = "canHandleVariableCommunicationStepSize"  # of co-simulation alone
_AUTHOR = "The contactkit authors"
_COPYRIGHT = "Copyright (c) 2026, the contactkit authors"


@frozen(kw_only=True)
class Description:
    """Model description: its ports, and what it states besides them."""

    identifier: str
    guid: str
    tool: str
    summary: str
    ports: Sequence[Port]
    start: Mapping[str, Value]
    log_categories: Mapping[str, str]
    experiment: Mapping[str, float] = field(factory=dict)
    version: str = ""
    needs_python: bool = False
    indicators: Mapping[str, str] = field(factory=dict)
    """Event indicators of model exchange, with their meaning; none: co-simulation only."""


def value_references(ports: Sequence[Port]) -> dict[str, int]:
    """Value reference of each port: from 1, dense, the same as its index in the XML."""
    return {port.name: reference for reference, port in enumerate(ports, start=1)}


def model_description(about: Description) -> Element:
    """Root element of ``modelDescription.xml``."""
    able = _capabilities(about)
    root = frame(about, "2.0", able, unit_definitions(about.ports), _types(about.ports))
    if about.indicators:
        root.set("numberOfEventIndicators", str(len(about.indicators)))
        kept = {name: value for name, value in able.items() if name != _STEPS}
        exchange = Element("ModelExchange", kept | {"completedIntegratorStepNotNeeded": "true"})
        root.insert(0, exchange)
    variables = SubElement(root, "ModelVariables")
    references = value_references(about.ports)
    for port in about.ports:
        variables.append(_variable(port, references, about.start))
    root.append(_structure(about))
    return root


def frame(
    about: Description, version: str, able: Mapping[str, str], units: Element, types: Element
) -> Element:
    """Root element with all that comes before the variables, the same in both versions of FMI."""
    attributes = {
        "fmiVersion": version,
        "modelName": about.identifier,
        "guid" if version == "2.0" else "instantiationToken": about.guid,
        "description": about.summary,
        "author": _AUTHOR,
        "copyright": _COPYRIGHT,
        "license": "BSD-3-Clause",
        "generationTool": about.tool,
        "variableNamingConvention": "structured",
    }
    if about.version:
        attributes["version"] = about.version
    epoch = os.environ.get("SOURCE_DATE_EPOCH")
    if epoch:  # without it no date is written: the same sources give the same file
        date = datetime.datetime.fromtimestamp(int(epoch), datetime.UTC)
        attributes["generationDateAndTime"] = date.strftime("%Y-%m-%dT%H:%M:%SZ")
    root = Element("fmiModelDescription", attributes)
    SubElement(root, "CoSimulation", dict(able))
    for part in (units, types):
        if len(part):
            root.append(part)
    categories = SubElement(root, "LogCategories")
    for name, meaning in about.log_categories.items():
        SubElement(categories, "Category", name=name, description=meaning)
    if about.experiment:
        experiment = dict(about.experiment)
        if TOLERANCE in about.start:  # a host that gives it back changes nothing
            experiment["tolerance"] = float(about.start[TOLERANCE])
        SubElement(root, "DefaultExperiment", {k: repr(v) for k, v in experiment.items()})
    return root


def _capabilities(about: Description) -> dict[str, str]:
    return {
        "modelIdentifier": about.identifier,
        "needsExecutionTool": _text(about.needs_python, "boolean"),
        _STEPS: "true",
        "canBeInstantiatedOnlyOncePerProcess": "false",
        "canNotUseMemoryManagementFunctions": "true",
        "canGetAndSetFMUstate": "true",
        "canSerializeFMUstate": "true",
    }


def unit_definitions(ports: Sequence[Port]) -> Element:
    """Units and display units, as both versions of FMI write them."""
    definitions = Element("UnitDefinitions")
    for unit in dict.fromkeys(port.unit for port in ports if port.unit != "-"):
        meaning = parse_unit(unit)
        base = {name: str(power) for name, power in meaning.dimension.items()}
        if meaning.factor != 1.0:
            base["factor"] = repr(meaning.factor)
        entry = SubElement(definitions, "Unit", name=unit)
        SubElement(entry, "BaseUnit", base)
        shown = (port.display_unit for port in ports if port.unit == unit)
        for display_unit in dict.fromkeys(name for name in shown if name is not None):
            factor, offset = display_conversion(unit, display_unit)
            conversion = {"name": display_unit, "factor": repr(factor)}
            if offset:
                conversion["offset"] = repr(offset)
            SubElement(entry, "DisplayUnit", conversion)
    return definitions


def _types(ports: Sequence[Port]) -> Element:
    definitions = Element("TypeDefinitions")
    for enumeration in enumerations(ports):
        entry = SubElement(definitions, "SimpleType", name=enumeration.__name__)
        SubElement(entry, "Enumeration").extend(items(enumeration))
    return definitions


def enumerations(ports: Sequence[Port]) -> list[type[IntEnum]]:
    """Enumerations that variables are of, each once."""
    return [e for e in dict.fromkeys(port.enumeration for port in ports) if e is not None]


def items(enumeration: type[IntEnum]) -> list[Element]:
    """Members of an enumeration, as both versions of FMI write them."""
    return [Element("Item", name=member.name, value=str(int(member))) for member in enumeration]


def _variable(port: Port, references: Mapping[str, int], start: Mapping[str, Value]) -> Element:
    is_parameter, is_output = port.causality == "parameter", port.causality == "output"
    attributes = {
        "name": port.name,
        "valueReference": str(references[port.name]),
        "description": port.label,
        "causality": port.causality,
        "variability": port.variability,
    }
    if is_parameter:
        attributes["initial"] = "exact"
    elif is_output:
        attributes["initial"] = "calculated"
    node = Element("ScalarVariable", attributes)
    SubElement(node, _TAGS[port.kind], details(port, start, references))
    if port.group:
        tool = SubElement(SubElement(node, "Annotations"), "Tool", name="contactkit")
        SubElement(tool, "Dialog", group=port.group)
    return node


def details(
    port: Port, start: Mapping[str, Value], references: Mapping[str, int]
) -> dict[str, str]:
    """Attributes of a variable that belong to its type, the same in both versions of FMI."""
    found: dict[str, Any] = {
        "declaredType": port.enumeration and port.enumeration.__name__,
        "unit": port.unit if port.unit != "-" else None,
        "displayUnit": port.display_unit,
        "min": _finite(port.minimum),
        "max": _finite(port.maximum),
        "nominal": port.nominal,
        "derivative": None if port.rate_of is None else str(references[port.rate_of]),
        "start": None if port.causality == "output" else start[port.name],
    }
    return {name: _text(value, port.kind) for name, value in found.items() if value is not None}


def _finite(bound: float | None) -> float | None:
    return bound if bound is not None and isfinite(bound) else None


def _text(value: str | Value, kind: Kind) -> str:
    """XML text of a value: every digit of it, and the schema's words for infinity."""
    if isinstance(value, str):
        return value
    if kind == "boolean":
        return str(bool(value)).lower()
    return repr(float(value)).replace("inf", "INF") if kind == "real" else str(int(value))


def states(about: Description) -> dict[str, str]:
    """Continuous states of model exchange by the variables that are their derivatives."""
    if not about.indicators:
        return {}
    return {port.name: port.rate_of for port in about.ports if port.rate_of is not None}


def known(port: Port, about: Description, *, starts: bool) -> list[int] | None:
    """Value references that an output depends on, at the start or later; None: any.

    Parameters are no longer unknowns once the start is over, and a state is one of its own.
    """
    if port.depends_on is None:
        return None
    references = value_references(about.ports)
    inputs = {port.name for port in about.ports if port.causality == "input"}
    names = [name for name in port.depends_on if starts or name in inputs]
    if not starts and port.name in states(about).values():
        names = [port.name]
    return sorted(references[name] for name in names)


def _structure(about: Description) -> Element:
    structure, ports = Element("ModelStructure"), about.ports
    references = value_references(ports)
    outputs = [port for port in ports if port.causality == "output"]
    derivatives = [port for port in outputs if port.name in states(about)]
    lists = {"Outputs": outputs, "Derivatives": derivatives, "InitialUnknowns": outputs}
    for name, members in lists.items():
        unknowns = SubElement(structure, name) if members else structure
        for port in members:
            node = SubElement(unknowns, "Unknown", index=str(references[port.name]))
            numbers = known(port, about, starts=name == "InitialUnknowns")
            if numbers is not None:
                node.set("dependencies", " ".join(map(str, numbers)))
    return structure
