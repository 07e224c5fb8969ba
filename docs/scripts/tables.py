"""Write the tables of the documentation from the code they describe.

A page holds ``<!-- table: NAME -->`` and ``<!-- end of table -->``; what stands between them is
made here. ``python docs/scripts/tables.py`` brings all pages up to date, ``--check`` only lists
those that are not; a test does the same.
"""

from __future__ import annotations

import inspect
import re
import sys
from collections.abc import Callable, Iterable, Mapping
from functools import partial
from pathlib import Path
from typing import Any

import attrs
from api_pages import api_table
from contact_tables import head_disk_table, material_table, surface_kinds
from device_tables import assumption_table
from errata_table import errata_table
from liquid_tables import liquid_source_table, liquid_table
from paper_tables import (
    bibliography,
    check_sentence,
    feature_table,
    hard_case_sentence,
    speed_sentence,
    speed_table,
)
from validation_tables import (
    division_table,
    grid,
    limit_table,
)

import contactkit as ck
from contactkit.contact.effects.base import (
    Attraction,
    Compliance,
    DisplacementTerm,
    LoadHistory,
    LoadTerm,
    Observer,
    PressureBound,
)
from contactkit.files.parameter_texts import parameter_texts
from contactkit.fmu.framework.ports import Port, display_conversion
from contactkit.fmu.framework.slave import PortSlave
from contactkit.fmu.slaves.contact_stop import ContactStop
from contactkit.fmu.slaves.deforming import DeformingForce, DeformingMass
from contactkit.fmu.slaves.stiction_force import StictionForce
from contactkit.fmu.slaves.stiction_mass import StictionMass
from contactkit.fmu.slaves.tip_contact import TipContact
from contactkit.fmu.slaves.valve_drive import ValveDrive
from contactkit.kinds import (
    ATTRACTION_LAWS,
    CONTACT_EFFECTS,
    CONTACT_LOADINGS,
    HARDNESS_RULES,
    MENISCUS_PROFILES,
    RHEOLOGY_LAWS,
    SEPARATION_EFFECTS,
    SEPARATION_LOADINGS,
    SLIDING_EFFECTS,
    SLIDING_LOADINGS,
    TEMPERATURE_LAWS,
)
from contactkit.models.end_stop.faces import StopFaces
from contactkit.models.injector.coil import Coil
from contactkit.models.injector.scene import Study
from contactkit.models.injector.valve import DriveProfile, Spring, Stop
from contactkit.models.micromirror.electrostatics import Electrode
from contactkit.models.micromirror.mirror import Hinge, SpringTips, Waveform
from contactkit.models.micromirror.scene import MirrorStudy
from contactkit.plot.axis_units import in_print
from contactkit.scene.interface import Body
from contactkit.separation.effects.base import (
    CoupledEffect,
    Effect,
    FilmEnd,
    FilmLimit,
    MovingAngle,
    SeparationForce,
    VolumeLoss,
)
from contactkit.separation.sliding.effects import SlidingForce

FMUS: Mapping[str, type[PortSlave]] = {
    "stiction-mass": StictionMass,
    "stiction-force": StictionForce,
    "valve-drive": ValveDrive,
    "contact-stop": ContactStop,
    "tip-contact": TipContact,
    "deforming-mass": DeformingMass,
    "deforming-force": DeformingForce,
}
DOCS = Path(__file__).parents[1]
MARK = re.compile(r"(<!-- table: ([\w -]+) -->\n)(.*?)(<!-- end of table -->)", re.DOTALL)


FACTORIES = {
    ck.Flat: "flat, no rim",
    Body: "rigid and flat",
    ck.Window: "periodic",
    ck.ContinuousHardness: '`"continuous"`',
}
ROLES: Mapping[type, str] = {
    SeparationForce: "force",
    FilmLimit: "limit",
    FilmEnd: "end of the film",
    MovingAngle: "contact angle",
    VolumeLoss: "volume of the film",
    CoupledEffect: "coupled with the film",
    SlidingForce: "force along the bodies",
    Compliance: "compliance",
    PressureBound: "pressure bound",
    LoadHistory: "history of loads",
    LoadTerm: "load",
    DisplacementTerm: "displacement",
    Attraction: "attraction",
    Observer: "observer",
}


def default(field: attrs.Attribute[Any]) -> str:
    """Default value of a field, in words."""
    value = field.default
    if value is attrs.NOTHING:
        return "required"
    if isinstance(value, attrs.Factory):  # type: ignore[arg-type]
        return FACTORIES[value.factory]
    if value is None:
        return ""
    if value in ("", ()):
        return "empty"
    if isinstance(value, bool):
        return f"`{value}`".lower()
    if not isinstance(value, int | float):
        return f'`"{value}"`'
    return f"{value:g}"


def keys(kind: type) -> str:
    """Keys of a table in a file; neighbouring fields that mean the same share a row."""
    texts, rows = parameter_texts(kind), []
    for field in (one for one in attrs.fields(kind) if one.name[0] != "_"):
        text = re.sub(r" \[[^]]{1,10}\]", "", texts[field.name]).replace(" degC", " °C")
        name, rest = f"`{field.alias}`", (default(field), _with_unit(text, field))
        if rows and rows[-1][1:] == rest:
            name = f"{rows.pop()[0]}, {name}"
        rows.append((name, *rest))
    return grid(("key", "default", "meaning"), rows)


def _with_unit(text: str, field: attrs.Attribute[Any]) -> str:
    """Meaning of a field with its unit at the end of the first sentence."""
    unit = field.metadata.get("unit", "-")
    end = re.search(r"\.(?= |$)", text)
    if unit == "-" or end is None:
        return text
    return f"{text[: end.start()]} [{unit}]{text[end.start() :]}"


def named(kinds: Iterable[tuple[str, type]], tag: str) -> str:
    """Keys of tables that name their kind under a tag, one below the other."""
    parts = []
    for name, kind in kinds:
        summary = inspect.cleandoc(kind.__doc__ or "").partition("\n")[0]
        fields = keys(kind) if attrs.fields(kind) else "No keys of its own."
        text = summary.replace("``", "`")
        parts.append(f'**`{tag} = "{name}"`**: {text}\n\n{fields}')
    return "\n\n".join(parts)


# Arguments of effects other than numbers, to construct them for their sources.


def effect_table(kinds: Iterable[type[Effect]]) -> str:
    """Effects a scene may call for."""
    rows = []
    for kind in kinds:
        role = next(word for base, word in ROLES.items() if issubclass(kind, base))
        rows.append((f"`{kind.name}`, `{kind.__name__}`", role, kind.summary))
    return grid(("in files, in Python", "role", "what it is"), rows)


def _amount(port: Port) -> str:
    """Start value of a port, in the unit that tools show."""
    if port.enumeration:
        return f"{port.enumeration(port.start).name}"
    if port.kind == "integer":
        return f"{port.start:d}"
    unit = port.display_unit or port.unit
    factor = display_conversion(port.unit, unit).factor if port.display_unit else 1.0
    return f"{port.start * factor:.4g} {in_print(unit)}".removesuffix(" -").replace(" °", "°")


def _range(port: Port) -> str:
    """Values that a port allows."""
    if port.enumeration is not None:
        return ", ".join(f"{int(m)} {m.name}" for m in port.enumeration)
    above, below = (">", "<") if port.exclusive else ("≥", "≤")
    bounds = [f"{above} {port.minimum:g}"] if port.minimum is not None else []
    whole = port.kind == "integer"
    bounds += [f"{below} {port.maximum:.{9 if whole else 4}g}"] if port.maximum is not None else []
    return ", ".join(["whole"] * whole + bounds)


def ports(table: Iterable[Port]) -> str:
    """Variables of an FMU: outputs by name and meaning, others with start and range."""
    rows = []
    shown = list(table)
    has_start = any(port.causality != "output" for port in shown)
    for port in shown:
        unit = "" if port.unit == "-" else f" [{in_print(port.unit)}]"
        allowed = _range(port) if has_start or port.enumeration is not None else ""
        start = (_amount(port),) if has_start else ()
        meaning = f"{port.label}{unit}{f': {allowed}' if allowed else ''}"
        rows.append((f"`{port.name}`", *start, meaning))
    return grid(("name", "start", "meaning") if has_start else ("name", "meaning"), rows)


PAIRS_OF_FMUS = (("film", "stiction"), ("deforming", "deforming"))


def port_tables() -> dict[str, Callable[[], str]]:
    """Variables of each FMU; parameters that a pair of FMUs shares stand in one table."""
    found, left = {}, {}
    for name, model in FMUS.items():
        for causality in ("input", "output", "parameter"):
            left[f"{name} {causality}s"] = [p for p in model.ports if p.causality == causality]
    for label, pair in PAIRS_OF_FMUS:
        both = [f"{pair}-{what} parameters" for what in ("mass", "force")]
        common = [port for port in left[both[0]] if port in left[both[1]]]
        for key in both:
            left[key] = [port for port in left[key] if port not in common]
        left[f"{label} parameters"] = common
    for key, listed in left.items():
        if listed:
            found[key] = partial(ports, listed)
    return found


TABLES: Mapping[str, Callable[[], str]] = {
    "scene": lambda: keys(ck.SeparationScene),
    "interface": lambda: keys(ck.Interface),
    "shapes": lambda: named((("flat", ck.Flat), ("sphere", ck.Sphere)), "shape"),
    "meniscus": lambda: keys(ck.Meniscus),
    "liquid": lambda: keys(ck.Liquid),
    "rheology laws": lambda: named([(law.kind, law) for law in RHEOLOGY_LAWS], "law"),
    "laws": lambda: named([(law.kind, law) for law in TEMPERATURE_LAWS], "law"),
    "separation loadings": lambda: named(((k.kind, k) for k in SEPARATION_LOADINGS), "kind"),
    "contact loadings": lambda: named(((k.kind, k) for k in CONTACT_LOADINGS), "kind"),
    "sliding loading": lambda: named(((k.kind, k) for k in SLIDING_LOADINGS), "kind"),
    "vibration": lambda: keys(ck.Vibration),
    "asperities": lambda: keys(ck.AsperityPopulation),
    "effect keys": lambda: named([(kind.name, kind) for kind in SEPARATION_EFFECTS], "effect"),
    "effects": lambda: effect_table(SEPARATION_EFFECTS),
    "sliding effect keys": lambda: named([(kind.name, kind) for kind in SLIDING_EFFECTS], "effect"),
    "sliding effects": lambda: effect_table(SLIDING_EFFECTS),
    "contact effect keys": lambda: named([(k.name, k) for k in CONTACT_EFFECTS], "effect"),
    "hardness rules": lambda: named([(one.kind, one) for one in HARDNESS_RULES], "kind"),
    "meniscus profiles": lambda: named([(k.kind, k) for k in MENISCUS_PROFILES], "kind"),
    "attraction laws": lambda: named([(law.kind, law) for law in ATTRACTION_LAWS], "law"),
    "contact effects": lambda: effect_table(CONTACT_EFFECTS),
    "tangential step": lambda: keys(ck.TangentialStep),
    "contact scene": lambda: keys(ck.ContactScene),
    "body": lambda: keys(Body),
    "material": lambda: keys(ck.Material),
    "stack": lambda: keys(ck.Stack),
    "rigid-base": lambda: keys(ck.RigidBase),
    "layer": lambda: keys(ck.Layer),
    "surfaces": lambda: named(surface_kinds(), "shape"),
    "window": lambda: keys(ck.Window),
    "materials": material_table,
    "head-disk": head_disk_table,
    "accuracy": lambda: keys(ck.Accuracy),
    "coil": lambda: keys(Coil),
    "spring": lambda: keys(Spring),
    "stop": lambda: keys(Stop),
    "stop faces": lambda: keys(StopFaces),
    "profile": lambda: keys(DriveProfile),
    "study": lambda: keys(Study),
    "hinge": lambda: keys(Hinge),
    "electrode": lambda: keys(Electrode),
    "tips": lambda: keys(SpringTips),
    "waveform": lambda: keys(Waveform),
    "mirror study": lambda: keys(MirrorStudy),
    "liquids": liquid_table,
    "liquid sources": liquid_source_table,
    **port_tables(),
    "errata": errata_table,
    "division": division_table,
    "assumptions": lambda: assumption_table("fuel-injector"),
    "mirror assumptions": lambda: assumption_table("micromirror"),
    "limits": limit_table,
    "api": api_table,
    "paper features": feature_table,
    "paper speed": speed_table,
    "paper speed sentence": speed_sentence,
    "paper hard cases": hard_case_sentence,
    "paper checks": check_sentence,
}


def updated(text: str) -> str:
    """Text of a page with its tables made anew."""
    return MARK.sub(lambda m: f"{m[1]}\n{TABLES[m[2]]()}\n\n{m[4]}", text)


def stale(*, write: bool = False) -> list[str]:
    """Pages whose tables are not those of the code; with `write` they are brought up to date."""
    found = []
    pages = [(page, updated) for page in sorted(DOCS.rglob("*.md"))]
    for page, make in (*pages, (DOCS / "paper" / "paper.bib", bibliography)):
        old = page.read_text(encoding="utf-8")
        new = make(old)
        if new != old:
            found.append(page.relative_to(DOCS).as_posix())
            if write:
                page.write_text(new, encoding="utf-8")
    return found


def main() -> int:
    """Write or check the tables, and say which pages were out of date."""
    check = "--check" in sys.argv[1:]
    pages = stale(write=not check)
    sys.stdout.write(f"{'out of date' if check else 'written'}: {', '.join(pages) or 'none'}\n")
    return 1 if check and pages else 0


if __name__ == "__main__":
    sys.exit(main())
