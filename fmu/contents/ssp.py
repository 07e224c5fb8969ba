"""System structures (SSP 1.0): which FMUs there are, how they are connected, their values.

The connectors are read from the FMUs themselves, so a structure cannot name a variable that is
not there. Values are written into the structure, and must be baked into the FMUs too: some hosts
leave out what a structure says about parameters, without a word.
"""

from __future__ import annotations

import io
from collections.abc import Container, Iterable, Iterator, Sequence
from typing import NamedTuple
from xml.etree.ElementTree import Element, SubElement, indent, tostring

from attrs import field, frozen

from ...reading.archives import checked_archive, member
from ...reading.xml_elements import read_xml

__all__ = ["Component", "Connection", "Connector", "Experiment", "structure_xml"]

_SSP = "http://ssp-standard.org/SSP1/SystemStructure"
_SPACES = {
    "xmlns:ssc": f"{_SSP}Common",
    "xmlns:ssd": f"{_SSP}Description",
    "xmlns:ssv": f"{_SSP}ParameterValues",
    "xmlns:osp": "http://opensimulationplatform.com/SSP/OSPAnnotations",
    "xmlns:oms": "https://raw.githubusercontent.com/OpenModelica/OMSimulator/master/schema/oms.xsd",
}
_KINDS = ("Real", "Integer", "Boolean", "String")  # libcosim ends its process on Enumeration


class Connector(NamedTuple):
    """A variable of an element of a system."""

    element: str
    variable: str


@frozen
class Connection:
    """A connection from an output to an input."""

    start: Connector
    end: Connector


@frozen(kw_only=True)
class Experiment:
    """Time to simulate and communication step [s] that a master finds in the structure."""

    stop_time: float
    step: float


@frozen(kw_only=True)
class Component:
    """An FMU (FMI 2.0) in a system.

    Attributes
    ----------
    name : str
        Name of the element.
    source : str
        Path of the FMU in the archive.
    fmu : bytes
        The FMU, of which variables, units and start values are read.
    description : str
        What it is.
    """

    name: str
    source: str
    fmu: bytes = field(repr=False)
    description: str = ""

    def model(self) -> Element:
        """Root of its ``modelDescription.xml``."""
        with checked_archive(io.BytesIO(self.fmu), self.source) as packed:
            text = member(packed, "modelDescription.xml", "TEXT_BYTES", self.source)
        return read_xml(text, f"{self.source}, modelDescription.xml")


def structure_xml(
    name: str,
    components: Sequence[Component],
    connections: Sequence[Connection],
    experiment: Experiment,
    *,
    description: str = "",
) -> bytes:
    """File ``SystemStructure.ssd`` of a system of FMUs.

    Parameters
    ----------
    name : str
        Name of the system; letters, digits and underscores suit every tool.
    components : sequence of Component
        The FMUs. All their inputs, outputs and parameters become connectors, and the start values
        of the parameters become parameter bindings. Enumerations are left out of both: they keep
        what is baked into the FMU.
    connections : sequence of Connection
        From outputs to inputs.
    experiment : Experiment
        Default experiment. The step is written as OMSimulator (on the system) and libcosim (on
        the experiment) read it; the standard itself has no place for it.
    description : str
        What the system is.
    """
    models = {one.name: one.model() for one in components}
    root = Element(
        "ssd:SystemStructureDescription",
        _SPACES | {"version": "1.0", "name": name, "generationTool": "contactkit"},
    )
    if description:
        root.set("description", description)
    system = SubElement(root, "ssd:System", name="root")
    elements = SubElement(system, "ssd:Elements")
    for one in components:
        _component(elements, one, models[one.name])
    joined = SubElement(system, "ssd:Connections")
    for each in connections:
        SubElement(
            joined,
            "ssd:Connection",
            startElement=each.start.element,
            startConnector=each.start.variable,
            endElement=each.end.element,
            endConnector=each.end.variable,
        )
    _oms_step(system, experiment.step)
    units = Element("ssd:Units")
    _units(units, models.values())
    if len(units):  # the standard has no empty list
        root.append(units)
    times = {"startTime": "0.0", "stopTime": repr(experiment.stop_time)}
    _osp_step(SubElement(root, "ssd:DefaultExperiment", times), experiment.step)
    indent(root)
    text: bytes = tostring(root, encoding="utf-8", xml_declaration=True)
    return text + b"\n"


class _Variable(NamedTuple):
    """A variable of an FMU as a structure describes it; a unit or a start may be an empty text."""

    name: str
    causality: str
    kind: str
    unit: str
    start: str


def _variables(model: Element) -> Iterator[_Variable]:
    """Variables that may be connected or set."""
    for node in model.iterfind("ModelVariables/ScalarVariable"):
        causality = node.get("causality", "local")
        for details in node:
            if details.tag in _KINDS and causality in ("input", "output", "parameter"):
                unit, start = details.get("unit", ""), details.get("start", "")
                yield _Variable(node.get("name", ""), causality, details.tag, unit, start)


def _component(elements: Element, one: Component, model: Element) -> None:
    node = SubElement(
        elements,
        "ssd:Component",
        name=one.name,
        type="application/x-fmu-sharedlibrary",
        source=one.source,
        implementation="CoSimulation",
    )
    if one.description:
        node.set("description", one.description)
    connectors, variables = SubElement(node, "ssd:Connectors"), list(_variables(model))
    for variable in variables:
        about = {"name": variable.name, "kind": variable.causality}
        _typed(SubElement(connectors, "ssd:Connector", about), "ssc", variable)
    parameters = [v for v in variables if v.causality == "parameter" and v.start]
    if parameters:
        _bindings(node, parameters, model)


def _typed(node: Element, space: str, variable: _Variable) -> Element:
    """Add the element that says the type of a variable, and its unit."""
    unit = {"unit": variable.unit} if variable.unit else {}
    return SubElement(node, f"{space}:{variable.kind}", unit)


def _bindings(node: Element, given: Sequence[_Variable], model: Element) -> None:
    """Write start values as a parameter set in its place; Ecos applies the sets of one name."""
    binding = SubElement(SubElement(node, "ssd:ParameterBindings"), "ssd:ParameterBinding")
    place = SubElement(binding, "ssd:ParameterValues")
    whole = SubElement(place, "ssv:ParameterSet", version="1.0", name="initialValues")
    parameters = SubElement(whole, "ssv:Parameters")
    for variable in given:
        one = SubElement(parameters, "ssv:Parameter", name=variable.name)
        _typed(one, "ssv", variable).set("value", variable.start)
    units = {variable.unit for variable in given if variable.unit}
    if units:
        _units(SubElement(whole, "ssv:Units"), [model], units)


def _units(
    node: Element, models: Iterable[Element], names: Container[str | None] | None = None
) -> None:
    """List the units of FMUs, or those of these names."""
    seen = set[str | None]()
    for model in models:
        for entry in model.iterfind("UnitDefinitions/Unit"):
            base, name = entry.find("BaseUnit"), entry.get("name", "")
            if base is None or name in seen or (names is not None and name not in names):
                continue
            seen.add(name)
            SubElement(SubElement(node, "ssc:Unit", name=name), "ssc:BaseUnit", base.attrib)


def _annotation(node: Element, kind: str) -> Element:
    return SubElement(SubElement(node, "ssd:Annotations"), "ssc:Annotation", type=kind)


def _oms_step(system: Element, step: float) -> None:
    """Master and step of OMSimulator, whose program does not run a system without."""
    inside = SubElement(_annotation(system, "org.openmodelica"), "oms:Annotations")
    SubElement(
        SubElement(inside, "oms:SimulationInformation"),
        "oms:FixedStepMaster",
        description="oms-ma",
        stepSize=repr(step),
        absoluteTolerance="1e-06",
        relativeTolerance="1e-06",
    )


def _osp_step(experiment: Element, step: float) -> None:
    """Master and step of libcosim."""
    inside = SubElement(_annotation(experiment, "com.opensimulationplatform"), "osp:Algorithm")
    SubElement(inside, "osp:FixedStepAlgorithm", baseStepSize=repr(step))
