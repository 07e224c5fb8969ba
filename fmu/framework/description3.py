"""The model description (FMI 3.0) of a table of ports, and the description of a build.

Variables, value references, units and log categories are those of the description of FMI 2.0
(`contactkit.fmu.framework.description`). FMI 3 adds the variable of the time, whose reference comes
after all others, and says of each output whether it may change between events.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from xml.etree.ElementTree import Element, SubElement

from .description import (
    Description,
    details,
    enumerations,
    frame,
    items,
    known,
    states,
    unit_definitions,
    value_references,
)
from .ports import Port

__all__ = ["build_description", "model_description3"]

_TAGS = {
    "real": "Float64",
    "integer": "Int32",
    "boolean": "Boolean",
    "enumeration": "Enumeration",
}
_ABLE = (
    "canGetAndSetFMUState",
    "canSerializeFMUState",
    "providesDirectionalDerivatives",
    "providesAdjointDerivatives",
    "canHandleVariableCommunicationStepSize",
    "mightReturnEarlyFromDoStep",
    "hasEventMode",
)
_STEPPING = {
    "canHandleVariableCommunicationStepSize",
    "mightReturnEarlyFromDoStep",
    "hasEventMode",
    "providesIntermediateUpdate",
    "canReturnEarlyAfterIntermediateUpdate",
}
"""Attributes of co-simulation that model exchange does not have."""
_UNABLE = (
    "needsExecutionTool",
    "canBeInstantiatedOnlyOncePerProcess",
    "providesIntermediateUpdate",
    "canReturnEarlyAfterIntermediateUpdate",
)


def model_description3(about: Description) -> Element:
    """Root element of ``modelDescription.xml`` for FMI 3.0."""
    able = {"modelIdentifier": about.identifier} | dict.fromkeys(_ABLE, "true")
    able |= dict.fromkeys(_UNABLE, "false")
    root = frame(about, "3.0", able, _units(about.ports), _types(about.ports))
    if about.indicators:
        kept = {name: value for name, value in able.items() if name not in _STEPPING}
        exchange = Element("ModelExchange", kept | {"needsCompletedIntegratorStep": "false"})
        root.insert(0, exchange)
    variables = SubElement(root, "ModelVariables")
    references = value_references(about.ports)
    for port in about.ports:
        attributes = {
            "name": port.name,
            "valueReference": str(references[port.name]),
            "description": port.label,
            "causality": port.causality,
            "variability": port.variability,
        }
        if port.causality != "input":
            attributes["initial"] = "exact" if port.causality == "parameter" else "calculated"
        more = details(port, about.start, references)
        node = SubElement(variables, _TAGS[port.kind], attributes | more)
        if port.group:
            note = SubElement(SubElement(node, "Annotations"), "Annotation", type="contactkit")
            SubElement(note, "Dialog", group=port.group)
    SubElement(
        variables,
        "Float64",
        name="time",
        valueReference=str(len(about.ports) + 1),
        description="simulation time",
        causality="independent",
        variability="continuous",
        unit="s",
    )
    for reference, name, meaning in _indicators(about):
        SubElement(
            variables,
            "Float64",
            name=name,
            valueReference=reference,
            description=f"event indicator: {meaning}",
            causality="local",
            variability="continuous",
            initial="calculated",
        )
    root.append(_structure(about))
    return root


def _indicators(about: Description) -> list[tuple[str, str, str]]:
    """Value reference, name and meaning of each event indicator; they come after the time."""
    first = len(about.ports) + 2
    return [(str(i), *one) for i, one in enumerate(about.indicators.items(), start=first)]


def _units(ports: Sequence[Port]) -> Element:
    """Units of the ports, and that of the time."""
    definitions = unit_definitions(ports)
    if definitions.find("Unit[@name='s']") is None:
        SubElement(SubElement(definitions, "Unit", name="s"), "BaseUnit", s="1")
    return definitions


def _types(ports: Sequence[Port]) -> Element:
    definitions = Element("TypeDefinitions")
    for enumeration in enumerations(ports):
        entry = SubElement(definitions, "EnumerationType", name=enumeration.__name__)
        entry.extend(items(enumeration))
    return definitions


def _structure(about: Description) -> Element:
    structure = Element("ModelStructure")
    references = value_references(about.ports)
    outputs = [port for port in about.ports if port.causality == "output"]
    derivatives = [port for port in outputs if port.name in states(about)]
    lists = {"Output": outputs, "ContinuousStateDerivative": derivatives, "InitialUnknown": outputs}
    for tag, ports in lists.items():
        for port in ports:
            node = SubElement(structure, tag, valueReference=str(references[port.name]))
            numbers = known(port, about, starts=tag == "InitialUnknown")
            if numbers is not None:
                node.set("dependencies", " ".join(map(str, numbers)))
    for reference, _, _ in _indicators(about):
        SubElement(structure, "EventIndicator", valueReference=reference)
    return structure


def build_description(identifier: str, files: Iterable[str]) -> Element:
    """Root element of ``sources/buildDescription.xml`` for sources in C99.

    Parameters
    ----------
    identifier : str
        Name of the library.
    files : iterable of str
        Names of the sources.
    """
    root = Element("fmiBuildDescription", fmiVersion="3.0")
    build = SubElement(root, "BuildConfiguration", modelIdentifier=identifier)
    sources = SubElement(build, "SourceFileSet", language="C99")
    for name in sorted(files):
        SubElement(sources, "SourceFile", name=name)
    return root
