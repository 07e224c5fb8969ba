"""What every model description states: all models, Python and native, FMI 2 and 3."""

from __future__ import annotations

import xml.etree.ElementTree as ElementTree
import zipfile

import pytest

pytest.importorskip("pythonfmu")
pytest.importorskip("fmpy")

from native_scenes import HAS_CC, SCENES

from contactkit import __version__
from contactkit.commands.fmu import _MODELS
from contactkit.fmu.framework.toolchain import local
from contactkit.fmu.native.build import build_native
from contactkit.fmu.native.drive import build_native_drive, build_native_stop
from contactkit.fmu.native.tip import build_native_tip
from contactkit.fmu.python.build import FMUS, build, validate

NATIVE = {
    "valve-drive": build_native_drive,
    "contact-stop": build_native_stop,
    "tip-contact": build_native_tip,
}
FORMS = [("python", 2), *((("native", 2), ("native", 3)) if HAS_CC else ())]
MEMBERS = {
    "stiction-mass": {"h", "v", "F_ext", "dF_ext"},
    "valve-drive": {"h", "v", "F_ext", "dF_ext"},
    "stiction-force": {"h", "v", "F"},
    "contact-stop": {"h", "v", "F"},
    "tip-contact": {"z", "vz", "az", "F"},
}
NEVER_NEGATIVE = {
    "stiction-mass": {"F_peak", "n_break", "n_release"},
    "stiction-force": {"c", "coupling_error", "H_stable", "h_above", "h_below", "n_break"},
    "valve-drive": {"F_mag", "F_stop", "flux"},
    "contact-stop": {"F", "F_el", "contact_area", "plastic_area", "d_res", "n_beyond"},
    "tip-contact": {"d_max", "F_max", "n_break", "n_land"},
}


def made(shelf, name, form, fmi):
    if form == "python":
        return shelf(build, name)
    one = {"platforms": [local()], "compiler": "cc", "fmi": fmi}
    if name in NATIVE:
        return shelf(NATIVE[name], **one)
    return shelf(build_native, SCENES["flooded"], model=name, **one)


@pytest.fixture(params=[(name, *form) for name in FMUS for form in FORMS], ids=str)
def described(request, shelf):
    """Name, form, version of FMI, file and root element of each FMU there is."""
    name, form, fmi = request.param
    path = made(shelf, name, form, fmi)
    files = zipfile.ZipFile(path)
    with files:
        root = ElementTree.fromstring(files.read("modelDescription.xml"))
        extra = "terminalsAndIcons/terminalsAndIcons.xml"
        terminals = ElementTree.fromstring(files.read(extra)) if fmi == 3 else root
    return name, form, fmi, path, root, terminals


def variables(root, fmi):
    """Attributes of each variable, with those of its type."""
    for node in root.find("ModelVariables"):
        yield node.attrib | (node[0].attrib if fmi == 2 else {})


@pytest.mark.slow
def test_every_description_is_complete(described):
    name, form, fmi, path, root, terminals = described
    assert validate(path) == []  # by fmpy, against the schemas of the standard
    assert root.get("version") == __version__
    assert root.get("author") == "The contactkit authors"
    assert root.get("copyright").startswith("Copyright (c)")
    assert root.get("license") == "BSD-3-Clause"
    (kind,) = root.iter("CoSimulation")
    assert kind.get("needsExecutionTool") == ("true" if form == "python" else "false")
    experiment = {key: float(value) for key, value in root.find("DefaultExperiment").attrib.items()}
    assert 100 <= (experiment["stopTime"] - experiment["startTime"]) / experiment["stepSize"] < 2e4
    members = {node.get("variableName") for node in terminals.iter("TerminalMemberVariable")}
    assert members == MEMBERS[name]
    found = {v["name"]: v for v in variables(root, fmi)}
    for attributes in found.values():
        assert attributes["description"]
        is_real = "unit" in attributes or attributes["name"] == "coupling_error"
        if attributes["causality"] in ("input", "output") and is_real and attributes["name"] != "u":
            assert float(attributes["nominal"]) > 0.0, attributes["name"]
    assert {float(found[n]["min"]) for n in NEVER_NEGATIVE[name]} == {0.0}


@pytest.mark.skipif(not HAS_CC, reason="there is no C compiler")
@pytest.mark.slow
@pytest.mark.parametrize("name", FMUS)
def test_both_versions_of_fmi_say_the_same_of_variables(name, shelf):
    found = []
    for fmi in (2, 3):
        with zipfile.ZipFile(made(shelf, name, "native", fmi)) as files:
            root = ElementTree.fromstring(files.read("modelDescription.xml"))
        found.append(
            [v for v in variables(root, fmi) if v["causality"] not in ("independent", "local")]
        )
        units = {node.get("name") for node in root.iter("DisplayUnit")}
        items = [node.attrib for node in root.iter("Item")]
        found.append((units, items))
    assert found[1] == found[3]
    for two, three in zip(found[0], found[2], strict=True):
        assert {key: two[key] for key in two if key != "initial"} == {
            key: three[key] for key in three if key != "initial"
        }


def test_the_command_offers_every_model():
    assert set(_MODELS) == set(FMUS) - {"toy"}  # of the tests of slaves
