"""Model descriptions and build descriptions of native FMUs, in both versions of FMI."""

from __future__ import annotations

from collections.abc import Iterable
from xml.etree.ElementTree import Element, SubElement, indent, tostring

from ..contents.terminals import annotate_terminal
from ..framework.description import Description, model_description
from ..framework.description3 import build_description, model_description3

__all__ = ["CATEGORIES", "description_files"]

CATEGORIES = {
    "logEvents": "What happened in the model, such as a release or a rupture.",
    "logCoupling": "Doubts about the way this FMU is coupled to others.",
    "logStatusWarning": "What is odd, but can be gone on with.",
    "logStatusError": "Why the FMU refuses to go on, and what to do about it.",
    "logAll": "Everything.",
}


def description_files(
    fmi: int, about: Description, files: Iterable[str], *, takes_rate: bool, gives_rates: bool
) -> dict[str, bytes]:
    """Descriptions of the model and, in FMI 3.0, of its build, by their path in the FMU.

    Parameters
    ----------
    fmi : {2, 3}
        Version of FMI.
    about : Description
        What they say.
    files : iterable of str
        Names of the sources; headers are left out.
    takes_rate : bool
        Whether FMI 2.0 may give the rate of an input.
    gives_rates : bool
        Whether first derivatives of outputs by time are provided.
    """
    compiled = sorted(name for name in files if name.endswith(".c"))
    if fmi == 3:
        root = model_description3(about)
        _able(root, gives_rates)
        build = build_description(about.identifier, compiled)
        return {"modelDescription.xml": _text(root), "sources/buildDescription.xml": _text(build)}
    root = model_description(about)
    annotate_terminal(root, about.ports)
    _able(root, gives_rates).set("canInterpolateInputs", str(takes_rate).lower())
    for kind in (*root.iter("ModelExchange"), *root.iter("CoSimulation")):
        kind.set("providesDirectionalDerivative", "true")
        sources = SubElement(kind, "SourceFiles")
        for name in compiled:
            SubElement(sources, "File", name=name)
    return {"modelDescription.xml": _text(root)}


def _able(root: Element, gives_rates: bool) -> Element:
    """Element of the capabilities of a description, with the order of output derivatives."""
    (kind,) = root.iter("CoSimulation")
    if gives_rates:
        kind.set("maxOutputDerivativeOrder", "1")
    return kind


def _text(root: Element) -> bytes:
    indent(root)
    text: bytes = tostring(root, encoding="utf-8", xml_declaration=True)
    return text + b"\n"
