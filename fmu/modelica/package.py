"""The Modelica package around an FMU, written from its model description.

Tools import an FMU as a block whose name they choose, but whose variables are those of the FMU. So
the wrapper has a replaceable block with these variables, and a stand-in of the same interface lets
its example run before the FMU is imported.
"""

from __future__ import annotations

import keyword
import os
import re
from pathlib import Path
from typing import Any

from ...errors import DescriptionError
from ...extras import require
from ...files.scenes import write_whole
from ..contents.packing import no_file
from ..framework.model_file import read_model
from .element import Element, element_of
from .text import documentation, icon, indented, parameter, port, quantity, string

__all__ = ["modelica_package", "write_modelica"]

_NAME = re.compile(r"[A-Za-z_][A-Za-z0-9_]{0,100}")
_RESERVED = {
    *("algorithm", "annotation", "block", "connect", "connector", "constant", "der", "discrete"),
    *("each", "encapsulated", "end", "equation", "expandable", "extends", "external", "final"),
    *("flow", "function", "initial", "inner", "input", "loop", "model", "operator", "outer"),
    *("output", "package", "parameter", "partial", "protected", "public", "record", "redeclare"),
    *("replaceable", "stream", "then", "type", "when", "within", "true", "Modelica"),
}
_INPUTS = ("{{-140,40},{-100,80}}", "{{-140,-20},{-100,20}}", "{{-140,-80},{-100,-40}}")
_OUTPUTS = ("{{100,30},{120,50}}", "{{100,-50},{120,-30}}")
_TRANSLATIONAL = "Modelica.Mechanics.Translational"
_MASS = 0.02  # [kg], of the examples


def write_modelica(fmu: str | os.PathLike[str], out: str | os.PathLike[str]) -> Path:
    """Write the Modelica package around an FMU, named as its file.

    Parameters
    ----------
    fmu : path
        FMU of contactkit, Python or native, of any version of FMI.
    out : path
        The file to write, ``Name.mo``.

    Returns
    -------
    Path
        The file.

    Raises
    ------
    DescriptionError
        If the FMU has no flanges, or the file no name that Modelica allows.
    ContactkitError
        If the file cannot be written.
    """
    target = Path(out)
    if target.suffix != ".mo":
        raise DescriptionError("out", str(out), "end in .mo")
    text = modelica_package(fmu, target.stem)
    try:
        with write_whole(target) as partial:
            partial.write_text(text, encoding="utf-8")
    except OSError as error:
        raise no_file(target, error) from error
    return target


def modelica_package(fmu: str | os.PathLike[str], name: str) -> str:
    """Modelica package of a name around an FMU, for the standard library 4.

    It has the ``Interface`` of the FMU, the ``Wrapper`` with flanges, a ``StandIn`` for the FMU and
    an ``Example``. Parameters are those of the FMU that are real numbers.

    Raises
    ------
    DescriptionError
        If the FMU has no flanges, or Modelica does not allow the name.
    """
    if not _NAME.fullmatch(name) or keyword.iskeyword(name) or name in _RESERVED:
        raise DescriptionError(
            "name",
            name,
            "be letters, digits and underscores, begin with no digit, and be no word of Modelica",
            hint="it is that of the file to write: --out Film2.mo",
        )
    require("fmpy", "reading an FMU")
    model = read_model(Path(fmu))
    element = element_of(model)
    variables = {variable.name: variable for variable in model.modelVariables}
    free = [v for v in variables.values() if v.causality == "parameter" and _is_real(v)]
    parts = [
        "extends Modelica.Icons.Package;",
        _interface(element, variables, free),
        _stand_in(element),
        *(_position_functions() if element.kind == "body" else ()),
        _body(element, variables, free) if element.kind == "body" else _force(element, free),
        _example(element, variables),
        f'annotation (uses(Modelica(version="4.0.0")), {_about(model, element, variables, name)});',
    ]
    return f"package {name} {string(element.about)}\n{indented(parts)}\nend {name};\n"


def _is_real(variable: Any) -> bool:
    return variable.type in ("Real", "Float64")


def _about(model: Any, element: Element, variables: dict[str, Any], name: str) -> str:
    """Documentation of the package."""
    rest = [v.name for v in variables.values() if v.causality == "parameter" and not _is_real(v)]
    lines = [
        f"Wrapper of the FMU {model.modelName}: {model.description}.",
        f"Import the FMU; the tool makes a block of it, such as {model.modelName}_fmu. Declare "
        f"{name}.Wrapper with (redeclare block Fmu = that block).",
        "The gap is s_rel - s_rel0. Forces have the signs of the standard library."
        if element.kind == "force"
        else "The gap is flange_b.s - s_rel0; the other body is fixed. A force into the flange, "
        "positive, opens. Connect it to springs, dampers and forces: a mass would be rigidly "
        "connected to the one in the FMU.",
        "StandIn is no model of the FMU: it lets Example run without it.",
    ]
    if rest:
        lines.append(f"Set in the FMU itself, as they are no real numbers: {', '.join(rest)}.")
    return documentation(lines)


def _interface(element: Element, variables: dict[str, Any], free: list[Any]) -> str:
    ports = [
        *(port(variables[n], at) for n, at in zip(element.inputs, _INPUTS, strict=False)),
        *(port(variables[n], at) for n, at in zip(element.outputs, _OUTPUTS, strict=False)),
    ]
    inside = [*map(parameter, free), *ports]
    head = 'partial block Interface "Variables of the FMU that the wrapper uses"'
    return f"{head}\n{indented(inside)}\nend Interface;"


def _stand_in(element: Element) -> str:
    """Block that has the interface and resists, or moves."""
    if element.kind == "body":
        return (
            'block StandIn "A mass in place of the FMU, to try the wrapper"\n'
            "  extends Interface;\n"
            f'  parameter Modelica.Units.SI.Mass mass = {_MASS} "mass of the stand-in";\n'
            "initial equation\n"
            f"  {element.gap} = 1e-5;\n"
            f"  {element.speed} = 0;\n"
            "equation\n"
            f"  der({element.gap}) = {element.speed};\n"
            f"  mass*der({element.speed}) = {element.force};\n"
            "end StandIn;"
        )
    minus = "" if element.sign > 0 else "-"
    return (
        'block StandIn "A damper in place of the FMU, to try the wrapper"\n'
        "  extends Interface;\n"
        "  parameter Modelica.Units.SI.TranslationalDampingConstant damping = 100 "
        '"damping of the stand-in";\n'
        "equation\n"
        f"  {element.force} = {minus}damping*{element.speed};\n"
        "end StandIn;"
    )


def _replaceable(free: list[Any]) -> str:
    """The block of the FMU, with the parameters of the wrapper."""
    given = indented((f"final {v.name}={v.name}" for v in free), "    ").replace("\n", ",\n")
    modified = f"(\n{given})" if free else ""
    return (
        "replaceable block Fmu = Interface constrainedby Interface\n"
        '  "Block that the tool made of the FMU" annotation (choicesAllMatching=true);\n'
        f"Fmu fmu{modified}\n"
        "  annotation (Placement(transformation(extent={{-20,-20},{20,20}})));"
    )


def _force(element: Element, free: list[Any]) -> str:
    motion = [f"fmu.{element.gap} = gap;", f"fmu.{element.speed} = speed;"]
    if element.acceleration:
        motion.append(f"fmu.{element.acceleration} = der(speed);")
    minus = "" if element.sign > 0 else "-"
    inside = [
        f"extends {_TRANSLATIONAL}.Interfaces.PartialCompliant;",
        "parameter Modelica.Units.SI.Position s_rel0 = 0",
        '  "s_rel at which the gap is 0";',
        *map(parameter, free),
        _replaceable(free),
        'Modelica.Units.SI.Position gap "gap between the bodies";',
        'Modelica.Units.SI.Velocity speed "opening speed";',
    ]
    equations = [
        "gap = s_rel - s_rel0;",
        "speed = der(s_rel);",
        *motion,
        f"f = {minus}fmu.{element.force};",
    ]
    return (
        f'model Wrapper "{element.about[0].upper()}{element.about[1:]}, with two flanges"\n'
        f"{indented(inside)}\nequation\n{indented(equations)}\n"
        f"  annotation ({icon(is_body=False)});\nend Wrapper;"
    )


def _position_functions() -> tuple[str, str]:
    """Position of a body whose speed is known: a tool differentiates it without the FMU."""
    return (
        'function position "Position of a body whose speed is known"\n'
        "  extends Modelica.Icons.Function;\n"
        "  input Modelica.Units.SI.Position gap;\n"
        "  input Modelica.Units.SI.Velocity speed;\n"
        "  output Modelica.Units.SI.Position s;\n"
        "algorithm\n"
        "  s := gap;\n"
        "  annotation (derivative(noDerivative=speed) = position_der, "
        "InlineAfterIndexReduction=true);\n"
        "end position;",
        'function position_der "Speed of that body"\n'
        "  extends Modelica.Icons.Function;\n"
        "  input Modelica.Units.SI.Position gap;\n"
        "  input Modelica.Units.SI.Velocity speed;\n"
        "  input Modelica.Units.SI.Velocity gap_der;\n"
        "  output Modelica.Units.SI.Velocity v;\n"
        "algorithm\n"
        "  v := speed;\n"
        "  annotation (InlineAfterIndexReduction=true);\n"
        "end position_der;",
    )


def _body(element: Element, variables: dict[str, Any], free: list[Any]) -> str:
    kind, unit = quantity(variables[element.rate].unit) if element.rate else ("Real", "")
    inside = [
        f'{_TRANSLATIONAL}.Interfaces.Flange_b flange_b "of the body"',
        "  annotation (Placement(transformation(extent={{90,-10},{110,10}})));",
        'parameter Modelica.Units.SI.Position s_rel0 = 0 "flange_b.s at which the gap is 0";',
        *map(parameter, free),
        _replaceable(free),
        f"input {kind} force_rate({unit}) = 0",
        '  "rate of the force during the next step of the FMU, where it is known";',
    ]
    equations = [
        f"flange_b.s = s_rel0 + position(fmu.{element.gap}, fmu.{element.speed});",
        f"fmu.{element.force} = flange_b.f;",
        f"fmu.{element.rate} = force_rate;",
    ]
    return (
        f'model Wrapper "{element.about[0].upper()}{element.about[1:]}, with a flange"\n'
        f"{indented(inside)}\nequation\n{indented(equations)}\n"
        f"  annotation ({icon(is_body=True)});\nend Wrapper;"
    )


def _example(element: Element, variables: dict[str, Any]) -> str:
    """A pull on a body with a spring."""
    gap = float(variables[element.gap].start or 0.0) or 1e-5
    parts = [
        "extends Modelica.Icons.Example;",
        "replaceable block Imported = StandIn constrainedby Interface",
        '  "Block that the tool made of the FMU" annotation (choicesAllMatching=true);',
        "Wrapper film(redeclare block Fmu = Imported);",
        f"{_TRANSLATIONAL}.Components.Fixed fixed(s0=0);",
        f"{_TRANSLATIONAL}.Components.Spring spring(c=5e3, s_rel0={gap!r});",
        f"{_TRANSLATIONAL}.Sources.ConstantForce pull(f_constant=40);",
    ]
    connections = [
        "spring.flange_a, fixed.flange",
        "spring.flange_b, film.flange_b",
        "pull.flange, film.flange_b",
    ]
    if element.kind == "force":
        parts.append(
            f"{_TRANSLATIONAL}.Components.Mass mass(m={_MASS}, s(start={gap!r}, fixed=true), "
            "v(start=0, fixed=true));"
        )
        connections += ["film.flange_a, fixed.flange", "mass.flange_a, film.flange_b"]
    return (
        'model Example "A pull on a body with a spring, held by the FMU"\n'
        f"{indented(parts)}\nequation\n{indented(f'connect({one});' for one in connections)}\n"
        "  annotation (experiment(StopTime=1e-3, Interval=1e-6));\nend Example;"
    )
