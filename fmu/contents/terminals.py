"""Terminals and icon of an FMU, for tools that draw and connect.

A terminal says which variables belong together, so that a tool draws one line where there are
four connections. Terminals are of FMI 3.0: inside an FMU of FMI 2.0 the file, whose version is that
of FMI 3.0, is a fatal error for FMILibrary 3 and all that is built on it. There the description of
the model has the same element in an annotation, which other tools pass over.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from xml.etree.ElementTree import Element, SubElement, indent, tostring

from attrs import frozen

from ..framework.ports import Port
from .icon import icon_png, icon_svg

__all__ = ["Flange", "annotate_terminal", "flange_of", "terminal_files", "terminals_xml"]

_PLACE = "terminalsAndIcons/"


@frozen
class Flange:
    """A flange that an FMU may have: its kind, and the variable of each of its members."""

    kind: str
    description: str
    members: dict[str, str]

    def xml(self) -> Element:
        """Terminal, by the schema of FMI 3.0."""
        terminal = Element(
            "Terminal",
            name="flange",
            matchingRule="plug",
            terminalKind=f"contactkit.{self.kind}",
            description=self.description,
        )
        for member, variable in self.members.items():
            SubElement(
                terminal,
                "TerminalMemberVariable",
                variableName=variable,
                memberName=member,
                variableKind="signal",
            )
        return terminal


_PULLED = {"gap": "h", "speed": "v", "force": "F_ext", "force_rate": "dF_ext"}
_HOLDING = {"gap": "h", "speed": "v", "force": "F"}
_ROOT = {"gap": "z", "speed": "vz", "acceleration": "az", "force": "F"}

# The first whose variables are all there is the flange of an FMU.
_FLANGES = (
    Flange("pull", "gap and opening speed of a mass, and the pull on it, > 0 opens", _PULLED),
    Flange("tips", "height, speed and acceleration of a root, and the force on it", _ROOT),
    Flange("contact", "gap and opening speed, and the force of what is between", _HOLDING),
)


def flange_of(ports: Iterable[Port]) -> Flange | None:
    """Flange of the FMU that has these variables, or None.

    Examples
    --------
    >>> from contactkit.fmu.slaves.stiction_mass import PORTS
    >>> flange_of(PORTS).members["force"]
    'F_ext'
    """
    names = {port.name for port in ports if port.causality != "parameter"}
    return next((f for f in _FLANGES if names.issuperset(f.members.values())), None)


def terminals_xml(ports: Sequence[Port]) -> bytes:
    """File ``terminalsAndIcons/terminalsAndIcons.xml`` by the schema of FMI 3.0."""
    flange = flange_of(ports)
    root = Element("fmiTerminalsAndIcons", fmiVersion="3.0")
    picture = SubElement(root, "GraphicalRepresentation")
    corners = {"x1": "-100", "y1": "-100", "x2": "100", "y2": "100"}
    SubElement(picture, "CoordinateSystem", corners | {"suggestedScalingFactorTo_mm": "0.1"})
    SubElement(picture, "Icon", corners)
    if flange is not None:
        SubElement(root, "Terminals").append(flange.xml())
    indent(root)
    text: bytes = tostring(root, encoding="utf-8", xml_declaration=True)
    return text + b"\n"


def annotate_terminal(root: Element, ports: Sequence[Port]) -> None:
    """Put the terminal into the model description of an FMU of FMI 2.0, before its variables."""
    flange = flange_of(ports)
    if flange is None:
        return
    notes = Element("VendorAnnotations")
    SubElement(notes, "Tool", name="contactkit").append(flange.xml())
    root.insert([child.tag for child in root].index("ModelVariables"), notes)


def terminal_files(ports: Sequence[Port], *, fmi: str = "2") -> dict[str, bytes]:
    """Terminals and icon of an FMU, by their paths in the file.

    Parameters
    ----------
    ports : sequence of Port
        Variables of the FMU.
    fmi : {"2", "3"}
        Version of FMI: 2.0 has an icon and no terminals.

    Examples
    --------
    >>> from contactkit.fmu.slaves.stiction_mass import PORTS
    >>> sorted(terminal_files(PORTS))
    ['model.png']
    """
    if fmi == "2":
        return {"model.png": icon_png()}
    return {
        f"{_PLACE}icon.png": icon_png(),
        f"{_PLACE}icon.svg": icon_svg().encode(),
        f"{_PLACE}terminalsAndIcons.xml": terminals_xml(ports),
    }
