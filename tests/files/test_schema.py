"""JSON Schema of scene files: what the reader takes, it takes; what the reader refuses, too."""

from __future__ import annotations

import copy
import re
import tomllib
from pathlib import Path
from typing import Any, get_args

import attrs
import jsonschema
import pytest
from hypothesis import given
from hypothesis import strategies as st

import contactkit as ck
from contactkit.app.scenes import open_tables
from contactkit.app.templates import KINDS as TEMPLATES
from contactkit.app.templates import template
from contactkit.errors import DescriptionError, PlanError
from contactkit.files import schema as schema_module
from contactkit.files.meniscus_amount import AMOUNT_KEYS
from contactkit.files.schema import scene_schema
from contactkit.files.structure import read_part, resolved
from contactkit.kinds import EFFECTS, KINDS, SEPARATION_EFFECTS, SLIDING_SCENE_EFFECTS, SOLIDS
from contactkit.models.library import bundled_scenes, device_kinds
from contactkit.scene.effect import Effect
from contactkit.scene.materials import Solid
from contactkit.units import parse_quantity, quantity_pattern

ROOT = Path(__file__).parents[2]
SCHEMA = scene_schema(device_kinds())
PARTS = SCHEMA["definitions"]
FILES = {name: path.read_text("utf-8") for name, path in bundled_scenes().items()}
FILES |= {f"template {name}": template(name) for name in TEMPLATES}
BLOCK = re.compile(r"^( *)```toml\n(.*?)^\1```", re.M | re.S)


def mistakes(tables, part=SCHEMA):
    whole = part if part is SCHEMA else part | {"definitions": PARTS}
    return [e.message for e in jsonschema.Draft7Validator(whole).iter_errors(tables)]


def is_read(tables):
    try:
        open_tables(copy.deepcopy(tables), "a file")
    except DescriptionError:
        return False
    return True


def test_it_is_a_schema_and_plain():
    jsonschema.Draft7Validator.check_schema(SCHEMA)
    refs = re.findall(r"#/definitions/([^']+)'", str(SCHEMA))
    assert set(refs) <= set(PARTS)
    # Taplo never ends on a text with a reference to what has neither properties nor choices.
    texts = re.findall(r"'allOf': \[{'\$ref': '#/definitions/([^']+)'", str(SCHEMA))
    assert len(texts) > 10
    assert all({"properties", "anyOf"} & PARTS[name].keys() for name in texts)


@pytest.mark.parametrize("name", FILES)
def test_scene_files_are_valid(name):
    assert mistakes(tomllib.loads(FILES[name])) == []


def test_scenes_of_the_documentation_are_valid():
    pages = [ROOT / "README.md", ROOT / "CONTRIBUTING.md", *(ROOT / "docs").rglob("*.md")]
    found = [(p, text) for p in pages for _, text in BLOCK.findall(p.read_text("utf-8"))]
    assert len(found) > 10
    for page, text in found:
        assert mistakes(tomllib.loads(text)) == [], page


def keys_of(kind):
    resolved(kind)
    return {a.alias for a in attrs.fields(kind) if a.init and a.name[0] != "_"}


def is_array(kind):
    return any("in_file" in a.metadata and a.default is attrs.NOTHING for a in attrs.fields(kind))


WRITABLE = [kind for kind in KINDS if not is_array(kind)]


def part_of(kind):
    registry = KINDS.of(kind)
    return PARTS[re.sub(r"[^\w]+", "-", f"{registry.family} {registry.name_of(kind)}")]


@pytest.mark.parametrize("kind", WRITABLE, ids=lambda kind: kind.__name__)
def test_keys_of_a_kind_are_those_of_the_reader(kind):
    part, tag = part_of(kind), KINDS.of(kind).tag
    needed = {a.alias for a in attrs.fields(kind) if a.default is attrs.NOTHING}
    assert part["properties"].keys() == keys_of(kind) | {tag}
    assert set(part["required"]) == needed | (
        set() if kind in SOLIDS and SOLIDS.name_of(kind) in SOLIDS.implied else {tag}
    )
    assert part["additionalProperties"] is False


PLAIN = (ck.Interface, ck.Layer, ck.RigidBase, ck.Window, ck.Accuracy, ck.Liquid, ck.Vibration)


@pytest.mark.parametrize("kind", PLAIN, ids=lambda kind: kind.__name__)
def test_keys_of_a_table_are_those_of_the_reader(kind):
    assert PARTS[kind.__name__]["properties"].keys() == keys_of(kind)


def test_keys_that_files_alone_have_are_there():
    assert PARTS["Meniscus"]["properties"].keys() == keys_of(ck.Meniscus) | {*AMOUNT_KEYS}
    for kind in (ck.ContactScene, ck.SeparationScene, ck.SlidingScene):
        expected = keys_of(kind) | {"accuracy", "study"}
        assert PARTS[kind.__name__]["properties"].keys() == expected
    for name, kind in device_kinds().items():
        assert PARTS[f"device-{name}"]["properties"].keys() == keys_of(kind) | {"device"}


GIVEN = {"poisson_ratio": "0.3", "axial_ratio": "0.3", "hurst": "0.8", "temperature_1": "40 degC"}
GIVEN |= {"reference_viscosity": "30 uPa.s"}


def value_for(kind: Any, unit: str, name: str):
    """A value of a field that the reader takes, most of them as texts."""
    words = [w for one in (kind, *get_args(kind)) for w in get_args(one) if isinstance(w, str)]
    base = next((one for one in (kind, *get_args(kind)) if isinstance(one, type)), None)
    if unit and not words:
        number = GIVEN.get(name, f"2 {unit}".removesuffix(" -"))
        return [number] * 2 if str(kind) == "tuple[float, float]" else number
    return words[0] if words else "x" if base is str else True if base is bool else table_for(base)


def table_for(kind):
    """The smallest table of a class that the reader takes."""
    if kind in CHOSEN:
        return copy.deepcopy(CHOSEN[kind])
    registry = KINDS.of(kind)
    if "family" in vars(kind):
        kind = next(one for one in registry if not is_array(one))
    resolved(kind)
    table = {registry.tag: registry.name_of(kind)} if registry else {}
    for a in attrs.fields(kind):
        if a.default is attrs.NOTHING:
            table[a.alias] = value_for(a.type, a.metadata.get("unit", ""), a.name)
    return table | EXTRA.get(kind.__name__, {})


STEEL = {"young_modulus": "210 GPa", "poisson_ratio": 0.3}
CHOSEN = {ck.Material: STEEL, ck.Body: {"shape": "flat"}}
# What a class asks for beside its required fields, or of their values.
EXTRA = {
    "Stack": {"layers": [{"material": "dlc", "thickness": "5 nm"}]},
    "Ring": {"hole_radius": "1 m"},
    "Sector": {"start": "0 deg", "end": "60 deg"},
    "Polygon": {"corners": [["0 m", "0 m"], ["1 m", "0 m"], ["0 m", "1 m"]]},
    "CombinedSurface": {"parts": [{"shape": "flat"}, {"shape": "sphere", "radius": "1 mm"}]},
    "GaussianRoughness": {"cutoff": "1 m"},
    "SelfAffineRoughness": {"cutoff": "1 m"},
    "ImposedSpeed": {"final_gap": "3 m"},
    "ImposedForce": {"final_gap": "3 m", "mass": "20 g"},
    "ImposedTime": {"final_gap": "3 m"},
    "PressAndPull": {"final_gap": "3 m", "force": "1 N"},
    "Pressing": {"pressure": "1 MPa"},
    "Sliding": {"speed": "1 mm/s"},
    "ContactAngleHysteresis": {"advancing_lower": "60 deg", "receding_lower": "20 deg"},
    "PartialSlip": {"path": [{"ratio": 0.5}]},
    "PlasticHistory": {"pressures": "1 MPa"},
    "ViscoelasticMaterial": {"fractions": [0.5, 0.2], "times": ["1 ms", "1 s"]},
    "WaltherViscosity": {
        "temperature_2": "100 degC",
        "kinematic_viscosity_1": "105 cSt",
        "kinematic_viscosity_2": "14 cSt",
    },
    "VogelViscosity": {
        "temperature_min": "0 degC",
        "temperature_max": "90 degC",
        "divergence_temperature": "100 K",
    },
    "LinearSurfaceTension": {
        "temperature_min": "0 degC",
        "temperature_max": "90 degC",
        "reference_temperature": "20 degC",
        "slope": "-0.1 mN/m/K",
    },
    "LinearDensity": {
        "temperature_min": "0 degC",
        "temperature_max": "90 degC",
        "reference_temperature": "20 degC",
        "value": "880 kg/m3",
        "slope": "-0.6 kg/m3/K",
    },
    "BarusViscosity": {"pressure_coefficient": "20 1/GPa"},
    "RoelandsViscosity": {"pressure_coefficient": "20 1/GPa"},
    "PowerLawViscosity": {"exponent": 0.6},
    "CarreauViscosity": {"exponent": 0.6},
    "EyringViscosity": {"stress": "5 MPa"},
    "DugdaleAttraction": {"range": "1 nm"},
}


@pytest.mark.parametrize("kind", WRITABLE, ids=lambda kind: kind.__name__)
def test_a_minimal_table_of_a_kind_is_read_and_valid_and_its_mutants_are_neither(kind):
    registry, table = KINDS.of(kind), table_for(kind)
    base = next(one for one in kind.__mro__ if "family" in vars(one))

    def read(tables):
        if issubclass(kind, Effect):
            tables, target = {k: v for k, v in tables.items() if k != registry.tag}, kind
        else:
            target = Solid | None if base is Solid else base
        return read_part(tables, target)[1]

    part = part_of(kind)
    assert read(table) == []
    assert mistakes(table, part) == []
    mutants = [table | {"nonsense": 1}]
    for a in attrs.fields(kind):
        if a.metadata.get("unit", "-") != "-":
            mutants.append(table | {a.alias: "2"})
        if str not in (a.type, *get_args(a.type)):  # of which the reader takes anything
            mutants.append(table | {a.alias: {"nonsense": 1}})
    for one in mutants:
        assert mistakes(one, part), one
        assert read(one), one


CONTACT = tomllib.loads(FILES["template contact"])
FILM = tomllib.loads(FILES["template separation"])
DEVICE = tomllib.loads(FILES["fuel-injector"])


@pytest.mark.errors
@pytest.mark.parametrize(
    ("tables", "path", "value", "reason"),
    [
        (CONTACT, "windows", {"width": "1 um"}, "'windows' was unexpected"),
        (CONTACT, "interface.lower.surface.hurts", 0.8, "'hurts' was unexpected"),
        (CONTACT, "interface.lower.surface.shape", "sphear", "'sphear' is not one of"),
        (CONTACT, "interface.lower.surface.seed", "one", "does not match"),
        (CONTACT, "interface.lower.solid.substrate", "steal", "'steal' is not one of"),
        (CONTACT, "interface.lower.solid.layers.0.thickness", "100", "does not match"),
        (CONTACT, "interface.lower.solid.layers.0.thickness", "1 MPa", "does not match"),
        (CONTACT, "loading.kind", "presing", "'presing' is not one of"),
        (CONTACT, "loading.gap", "1 um", "'gap' was unexpected"),
        (CONTACT, "effects.0.effect", "viscous-force", "'viscous-force' is not one of"),
        (CONTACT, "effects.0.effect", 3, "3 is not one of"),
        (CONTACT, "accuracy.level", 3, "3 is not one of"),
        (CONTACT, "accuracy.grid", "fine", "is not of type"),
        (CONTACT, "window.periodic", "z", "'z' is not one of"),
        (CONTACT, "study", {"loading.pressure": "1 MPa"}, "is not of type 'array'"),
        (FILM, "interface.meniscus.liquid", "wine", "'wine' is not one of"),
        (FILM, "interface.meniscus.contact_angle_lower", "60", "does not match"),
        (FILM, "effects.0.profile", 2, "2 is not"),
        (FILM, "effects.0.profile", "round", "'round' is not one of"),
        (DEVICE, "device", "fuel-injectr", "'fuel-injectr' is not one of"),
        (DEVICE, "valve.coil.turn", 100, "'turn' was unexpected"),
        (DEVICE, "valve.spring.preload", "15", "does not match"),
        (DEVICE, "loading.kind", "imposed-speed", "'imposed-speed' is not one of"),
    ],
)
def test_what_the_reader_refuses_is_refused_at_its_place(tables, path, value, reason):
    assert is_read(tables)
    made = at = copy.deepcopy(tables)
    *way, last = path.split(".")
    for segment in way:
        at = at[int(segment)] if segment.isdigit() else at.setdefault(segment, {})
    at[last] = value
    assert not is_read(made)
    (message,) = mistakes(made)
    assert reason in message


@pytest.mark.parametrize("name", ["sliding", "separation"])
def test_effects_of_another_kind_of_scene_are_refused_as_by_the_plan(name):
    tables = tomllib.loads(template(name))
    known = {"sliding": SLIDING_SCENE_EFFECTS, "separation": SEPARATION_EFFECTS}[name]
    others = [one for one in EFFECTS if one not in known and one.name not in known.by_name]
    assert len(others) > 10
    for effect in others:
        made = tables | {"effects": [table_for(effect)]}
        assert f"'{effect.name}' is not one of" in mistakes(made)[0]
        with pytest.raises((DescriptionError, PlanError)):
            open_tables(made, "a file").plan_text()


def test_texts_say_the_unit_and_an_example():
    pressing = PARTS["contact-loading-pressing"]["properties"]["pressure"]
    assert pressing["description"].endswith('[Pa]. A number in Pa, or a text such as "20 MPa".')
    for unit in {a.metadata.get("unit", "-") for kind in WRITABLE for a in attrs.fields(kind)}:
        if unit != "-":
            example = re.search(r'"(.+)"', schema_module._text("", unit))[1]
            assert re.search(quantity_pattern(unit), example)
            assert parse_quantity(example, unit)


UNITS = ["", "um", "nm", "m", "Å", "mm2", "m^3", "L", "ml", "Pa", "MPa", "bar", "psi", "N/mm2"]
UNITS += ["degC", "°C", "K", "mrad", "deg", "°", "mN/m", "J/m2", "1/um2", "m-2", "%", "1", "kg"]
UNITS += ["g", "kHz", "1/s", "s^-1", "um/um", "parsec", "mm²", "m³", "s⁻¹", "N m⁻¹", "kg m-1 s-2"]


@pytest.mark.parametrize(
    ("text", "unit", "value"),
    [
        ("3 m s-1", "m/s", 3.0),
        ("2 mPa s", "Pa.s", 2e-3),
        ("7 kg / m³", "kg/m3", 7.0),
        ("5 N mm⁻²", "Pa", 5e6),
        ("4 GPa⁻¹", "1/Pa", 4e-9),
    ],
)
def test_blanks_are_products_and_powers_may_be_raised(text, unit, value):
    assert parse_quantity(text, unit) == pytest.approx(value, rel=1e-14)
    assert re.search(quantity_pattern(unit), text)


@pytest.mark.errors
@pytest.mark.parametrize(
    ("text", "cure"),
    [("1 micron", "1 micron is 1 um"), ("1 W/(m K)", "without brackets"), ("3 m s-1", "converts")],
)
def test_units_of_elsewhere_are_refused_with_their_cure(text, cure):
    with pytest.raises(DescriptionError, match=cure):
        parse_quantity(text, "1/s" if "s-1" in text else "m")


@pytest.mark.parametrize("unit", ["m", "m3", "Pa", "K", "rad", "N/m", "1/m2", "-", "kg", "Hz"])
@given(
    number=st.sampled_from(["5", "-2.5", ".5", "1e-3", "inf", "1,5", "fast", ""]),
    space=st.sampled_from(["", " ", "  "]),
    given=st.sampled_from(UNITS),
)
def test_texts_of_one_symbol_are_those_that_are_read(unit, number, space, given):
    text = f"{number}{space}{given}"
    try:
        parse_quantity(text, unit)
        is_right = True
    except DescriptionError:
        is_right = False
    is_valid = re.search(quantity_pattern(unit), text) is not None
    if is_right or not re.search(r"[/.* ]", given):
        assert is_valid == is_right
