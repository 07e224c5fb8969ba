"""Text of Modelica: strings, parameters, connectors, graphics."""

from __future__ import annotations

import textwrap
from collections.abc import Iterable
from html import escape
from typing import Any

__all__ = ["documentation", "icon", "indented", "parameter", "port", "quantity", "string"]

_TYPES = {
    "m": "Length",
    "m2": "Area",
    "m3": "Volume",
    "m/s": "Velocity",
    "m/s2": "Acceleration",
    "N": "Force",
    "N.s/m": "TranslationalDampingConstant",
    "kg": "Mass",
    "Pa": "Pressure",
    "Pa.s": "DynamicViscosity",
    "rad": "Angle",
    "s": "Time",
    "K": "Temperature",
    "V": "Voltage",
    "A": "Current",
    "ohm": "Resistance",
    "kg/m3": "Density",
}
"""Types of Modelica.Units.SI by their unit, where there is one meaning."""


def string(text: str) -> str:
    r"""String literal of Modelica.

    Examples
    --------
    >>> print(string('a "film"'))
    "a \"film\""
    """
    inside = " ".join(text.split()).replace("\\", "\\\\").replace('"', '\\"')
    return f'"{inside}"'


def indented(parts: Iterable[str], by: str = "  ") -> str:
    """Parts below each other, moved to the right."""
    return textwrap.indent("\n".join(parts), by)


def quantity(unit: str | None) -> tuple[str, str]:
    """Type of a number with a unit, and the modification that states the unit, if it needs one.

    Examples
    --------
    >>> quantity("Pa.s")
    ('Modelica.Units.SI.DynamicViscosity', '')
    >>> quantity("N/m")
    ('Real', 'final unit="N/m"')
    """
    if unit in _TYPES:
        return f"Modelica.Units.SI.{_TYPES[unit]}", ""
    return "Real", f"final unit={string(unit or '1')}"


def parameter(variable: Any) -> str:
    """Declare a parameter with the start value, range and unit of a variable of an FMU."""
    kind, unit = quantity(variable.unit)
    bounds = ((name, getattr(variable, name)) for name in ("min", "max"))
    given = [f"{name}={float(value)!r}" for name, value in bounds if value is not None]
    if variable.displayUnit:
        given.append(f"displayUnit={string(variable.displayUnit)}")
    inside = ", ".join([unit, *given] if unit else given)
    attributes = f"({inside})" if inside else ""
    about = string(variable.description or "")
    return f"parameter {kind} {variable.name}{attributes} = {float(variable.start)!r} {about};"


def port(variable: Any, place: str) -> str:
    """Connector of an input or output with a unit, at a place of the icon."""
    kind = "RealInput" if variable.causality == "input" else "RealOutput"
    unit = f"(unit={string(variable.unit)})" if variable.unit else ""
    about = string(variable.description or "")
    return (
        f"Modelica.Blocks.Interfaces.{kind} {variable.name}{unit} {about}\n"
        f"  annotation (Placement(transformation(extent={place})));"
    )


def documentation(paragraphs: Iterable[str]) -> str:
    """Documentation of a class; the paragraphs are plain text."""
    inside = "".join(f"<p>{escape(text)}</p>" for text in paragraphs)
    return f"Documentation(info={string(f'<html>{inside}</html>')})"


def icon(is_body: bool) -> str:
    """Icon of a wrapper: two bodies and a film between them, the left one fixed for a body."""
    left = "96,96,96" if is_body else "160,215,160"
    bodies = [((-90, -50), (-30, 50), left), ((30, -50), (90, 50), "160,215,160")]
    shapes = [
        f"Rectangle(extent={{{{{a},{b}}},{{{c},{d}}}}}, lineColor={{0,127,0}}, "
        f"fillColor={{{color}}}, fillPattern=FillPattern.Solid)"
        for (a, b), (c, d), color in bodies
    ]
    film = "{{-30,40},{-12,0},{-30,-40},{30,-40},{12,0},{30,40},{-30,40}}"
    shapes.append(
        f"Polygon(points={film}, lineColor={{232,160,48}}, fillColor={{232,160,48}}, "
        "fillPattern=FillPattern.Solid)"
    )
    shapes.append('Text(extent={{-150,100},{150,60}}, textString="%name", textColor={0,0,255})')
    return f"Icon(graphics={{{', '.join(shapes)}}})"
