"""Ports, and the model description that is written from them."""

from __future__ import annotations

import math
import zipfile
from enum import IntEnum
from importlib import import_module
from itertools import pairwise
from xml.etree import ElementTree

import pytest

from contactkit.errors import DescriptionError
from contactkit.fmu.framework.ports import Port, display_conversion, find_port, grouped
from contactkit.fmu.framework.slave import PortSlave
from contactkit.fmu.python.build import FMUS, build


@pytest.fixture(scope="module")
def root(toy_fmu):
    with zipfile.ZipFile(toy_fmu) as packed:
        return ElementTree.fromstring(packed.read("modelDescription.xml"))


def variable(root, name):
    return root.find(f"ModelVariables/ScalarVariable[@name='{name}']")


def test_capabilities(root):
    assert root.find("CoSimulation").attrib == {
        "modelIdentifier": "Toy",
        "needsExecutionTool": "true",
        "canHandleVariableCommunicationStepSize": "true",
        "canBeInstantiatedOnlyOncePerProcess": "false",
        "canNotUseMemoryManagementFunctions": "true",
        "canGetAndSetFMUstate": "true",
        "canSerializeFMUstate": "true",
    }
    categories = {category.get("name") for category in root.find("LogCategories")}
    assert {"logStatusError", "logEvents", "logCoupling"} <= categories


def test_units_carry_base_and_display_units(root):
    newton = root.find("UnitDefinitions/Unit[@name='N']")
    assert newton.find("BaseUnit").attrib == {"kg": "1", "m": "1", "s": "-2"}
    assert newton.find("DisplayUnit").attrib == {"name": "mN", "factor": "1000.0"}
    celsius = root.find("UnitDefinitions/Unit[@name='K']/DisplayUnit").attrib
    assert celsius == {"name": "degC", "factor": "1.0", "offset": "-273.15"}
    assert variable(root, "tau")[0].get("displayUnit") == "ms"
    assert "unit" not in variable(root, "gain")[0].attrib


def test_bounds_nominals_and_starts(root):
    assert variable(root, "gain")[0].attrib == {"min": "-5.0", "max": "5.0", "start": "1.0"}
    assert variable(root, "n")[0].attrib == {"min": "0", "max": "9", "start": "0"}
    assert variable(root, "u")[0].get("nominal") == "10.0"
    assert variable(root, "on")[0].get("start") == "true"
    assert variable(root, "y")[0].get("start") is None
    assert variable(root, "tau").attrib["description"] == "time constant <s> & more"


def test_value_references_count_from_one(root):
    references = [int(v.get("valueReference")) for v in root.find("ModelVariables")]
    assert references == list(range(1, len(references) + 1))


def test_enumerations_are_types(root):
    items = root.find("TypeDefinitions/SimpleType[@name='Mode']/Enumeration")
    assert [(i.get("name"), i.get("value")) for i in items] == [
        ("LAG", "1"),
        ("HOLD", "2"),
        ("BREAK", "4"),
    ]
    assert variable(root, "mode")[0].tag == "Enumeration"
    assert variable(root, "mode")[0].attrib == {"declaredType": "Mode", "start": "1"}


def test_dependencies_in_outputs_and_initial_unknowns(root):
    names = {str(i): v.get("name") for i, v in enumerate(root.find("ModelVariables"), 1)}

    def read(section):
        return {
            names[unknown.get("index")]: unknown.get("dependencies")
            and [names[i] for i in unknown.get("dependencies").split()]
            for unknown in root.find(f"ModelStructure/{section}")
        }

    everything = {"sum": "", "high": None, "side": None}
    assert read("Outputs") == {"y": "", "twice": ["u"]} | everything
    assert read("InitialUnknowns") == {"y": ["y0"], "twice": ["u", "gain"]} | everything


class Level(IntEnum):
    LOW = 1
    HIGH = 5


def port(**changes):
    details = {"name": "x", "unit": "m", "causality": "parameter", "label": "a length"}
    details |= changes
    return Port(details.pop("name"), details.pop("unit"), **details)


@pytest.mark.parametrize(
    ("changes", "message"),
    [
        ({"name": "1x"}, r"Port\.name must be made of letters"),
        ({"name": "x y"}, r"Port\.name must be made of letters"),
        ({"unit": "furlong"}, "unit must be made of known symbols"),
        ({"display_unit": "N"}, "display unit must measure the same as m, got 'N'"),
        ({"unit": "-", "kind": "enumeration"}, "enumeration must be given for kind 'enumeration'"),
        ({"unit": "-", "enumeration": Level}, "enumeration must be given for kind 'enumeration'"),
        ({"depends_on": ("y",)}, "depends_on must be left out, except for outputs"),
        ({"start": -1.0, "minimum": 0.0}, "x must be a finite number at least 0"),
        ({"start": math.inf}, "x must be a finite number"),
        ({"kind": "integer"}, "unit must be '-' unless real"),
    ],
)
def test_ports_that_contradict_themselves_are_refused(changes, message):
    with pytest.raises(DescriptionError, match=message):
        port(**changes)


def test_exclusive_bounds_leave_out_the_bound_alone():
    above = port(minimum=0.0, start=1.0, exclusive=True)
    assert (above.allows(0.0), above.allows(5e-324)) == (False, True)
    below = port(unit="-", kind="integer", minimum=0, maximum=3, exclusive=True, start=1)
    assert [number for number in range(-1, 5) if below.allows(number)] == [1, 2]
    assert port(maximum=math.inf).allows(math.inf)
    assert not port().allows(math.inf)


def test_enumeration_starts_with_its_first_member():
    level = port(unit="-", kind="enumeration", enumeration=Level)
    assert level.start is Level.LOW
    assert (level.read("HIGH"), level.read(5), level.allows(3)) == (5, 5, False)


@pytest.mark.parametrize(
    ("unit", "shown", "factor"),
    [
        ("m", "um", 1e6),
        ("Pa.s", "mPa.s", 1e3),
        ("Pa", "bar", 1e-5),
        ("m3", "mm3", 1e9),
        ("rad", "deg", 180 / math.pi),
    ],
)
def test_display_units_have_clean_factors(unit, shown, factor):
    assert display_conversion(unit, shown) == (pytest.approx(factor, rel=1e-14), 0.0)


def test_ports_of_one_slave_must_fit_together(toy_module):
    with pytest.raises(DescriptionError, match=r"port names must differ, got \['x'\]"):
        type("Twice", (PortSlave,), {"ports": (port(), port())})
    output = port(name="y", causality="output", depends_on=("z",))
    with pytest.raises(DescriptionError, match="port must be a variable of this FMU, got 'z'"):
        type("Stray", (PortSlave,), {"ports": (port(), output)})
    circle = port(name="z", causality="output", depends_on=("z",))
    with pytest.raises(DescriptionError, match="depends_on must name inputs and parameters only"):
        type("Circle", (PortSlave,), {"ports": (circle,)})


def test_headings_carry_the_unit(toy_module):
    headings = [p.heading for p in toy_module.Toy.ports]
    assert headings[:2] == ["u [N]", "n"]
    assert find_port(toy_module.Toy.ports, "tau").heading == "tau [s]"


def test_a_former_name_of_a_variable_is_refused_with_the_present_one():
    stiction = dict(models())["stiction-mass"]
    with pytest.raises(DescriptionError, match="port must be 'dp_inception', its name now"):
        find_port(stiction.ports, "dp_tear")


# What tools show and scale by ---------------------------------------------------------------


def models():
    """Class of each FMU, by its name."""
    for name, (module, kind) in FMUS.items():
        if name != "toy":
            yield name, getattr(import_module(f"contactkit.fmu.{module}"), kind)


@pytest.mark.parametrize(("name", "model"), list(models()))
def test_parameters_are_in_groups_and_what_masters_scale_has_a_size(name, model):
    groups = [port.group for port in model.ports if port.causality == "parameter"]
    assert all(groups)
    assert len(dict.fromkeys(groups)) == 1 + sum(a != b for a, b in pairwise(groups))
    scaled = [p for p in model.ports if p.kind == "real" and p.causality != "parameter"]
    sizes = {port.name: port.nominal for port in scaled}
    assert [name for name, size in sizes.items() if not size] == []


def test_groups_hold_every_parameter_once():
    ports = (Port("a", "m", causality="parameter", label="a"),)
    assert grouped(ports, {"all": ("a",)})[0].group == "all"
    for groups in ({}, {"all": ("a", "b")}, {"all": ("a",), "again": ("a",)}):
        with pytest.raises(DescriptionError, match="name every parameter once"):
            grouped(ports, groups)


def test_the_mass_says_its_groups_and_that_its_speed_is_a_rate(shelf):
    with zipfile.ZipFile(shelf(build, "stiction-mass")) as packed:
        root = ElementTree.fromstring(packed.read("modelDescription.xml"))
    names = [node.get("name") for node in root.find("ModelVariables")]
    assert variable(root, "v")[0].get("derivative") == str(1 + names.index("h"))
    dialog = variable(root, "eta").find("Annotations/Tool[@name='contactkit']/Dialog")
    assert dialog.get("group") == "liquid"
    assert root.find("DefaultExperiment").get("tolerance") == "1e-08"
