"""What travels in an FMU beside its model: icon, terminals, documentation."""

from __future__ import annotations

import importlib
import re
import struct
import zipfile
import zlib
from html.parser import HTMLParser
from pathlib import Path
from xml.etree import ElementTree

import pytest
from native_scenes import SCENES

pytest.importorskip("pythonfmu")
fmpy = pytest.importorskip("fmpy")
etree = pytest.importorskip("lxml.etree")

from contactkit.fmu.contents.document import Page, external_dependencies, index_page  # noqa: E402
from contactkit.fmu.contents.icon import icon_png, icon_svg  # noqa: E402
from contactkit.fmu.contents.terminals import flange_of, terminal_files, terminals_xml  # noqa: E402
from contactkit.fmu.framework.ports import Port  # noqa: E402
from contactkit.fmu.native.page import native_page  # noqa: E402
from contactkit.fmu.native.ports import native_ports  # noqa: E402
from contactkit.fmu.python.build import FMUS  # noqa: E402  # the packages must be there
from contactkit.fmu.slaves.stiction_mass import PORTS, scene_of  # noqa: E402
from contactkit.separation.effects.prepared import prepare_scene  # noqa: E402

SCHEMA = Path(fmpy.__file__).parent / "schema" / "fmi3" / "fmi3TerminalsAndIcons.xsd"
XML = "terminalsAndIcons/terminalsAndIcons.xml"
START = {port.name: port.start for port in PORTS}
ALONE = (Port("u", "m", causality="input", label="an input"),)


def ports_of(name):
    module, class_name = FMUS[name]
    return getattr(importlib.import_module(f"contactkit.fmu.{module}"), class_name).ports


# The icon -----------------------------------------------------------------------------------


@pytest.fixture(scope="module")
def pixels():
    """Rows of (red, green, blue, opacity), decoded without a library for pictures."""
    data, place, chunks = icon_png(), 8, {}
    while place < len(data):
        (length,) = struct.unpack(">I", data[place : place + 4])
        name, content = data[place + 4 : place + 8], data[place + 8 : place + 8 + length]
        (check,) = struct.unpack(">I", data[place + 8 + length : place + 12 + length])
        assert check == zlib.crc32(name + content)
        chunks[name] = content
        place += 12 + length
    assert list(chunks) == [b"IHDR", b"IDAT", b"IEND"]
    width, height, *kind = struct.unpack(">IIBBBBB", chunks[b"IHDR"])
    assert (width, height, kind) == (128, 128, [8, 6, 0, 0, 0])
    raw = zlib.decompress(chunks[b"IDAT"])
    assert len(raw) == height * (4 * width + 1)
    lines = [raw[j * (4 * width + 1) :][: 4 * width + 1] for j in range(height)]
    assert all(line[0] == 0 for line in lines)
    return [[tuple(line[i : i + 4]) for i in range(1, len(line), 4)] for line in lines]


def test_the_icon_shows_a_film_between_two_bodies(pixels):
    middle, side = 64, 20
    assert pixels[64][middle] == (232, 160, 48, 255)  # oil
    assert pixels[64][side] == (0, 0, 0, 0)  # beside its hollow end nothing
    assert pixels[100][middle][3] == pixels[40][side][3] == 255  # bodies
    assert pixels[25][middle] == (255, 255, 255, 255)  # the arrow
    assert all(pixels[y][x][3] == 0 for y in (0, 127) for x in (0, 127))
    assert all(row == row[::-1] for row in pixels)
    widths = [sum(pixel[3] > 127 for pixel in pixels[y]) for y in range(52, 77)]
    assert min(widths) == widths[12] < widths[0]  # narrowest in the middle: it wets


def test_edges_are_smooth(pixels):
    partly = sum(0 < pixel[3] < 255 for row in pixels for pixel in row)
    assert 20 < partly < 400


def test_the_drawing_has_the_colours_of_the_icon():
    drawing = ElementTree.fromstring(icon_svg())
    found = {node.get("fill") for node in drawing.iter() if node.get("fill")}
    assert found == {"#e8a030", "#607082", "#465465", "#ffffff"}
    assert len(icon_svg()) < 1000


# Terminals ----------------------------------------------------------------------------------


@pytest.mark.parametrize("name", FMUS)
def test_terminals_follow_the_schema_and_the_ports(name):
    ports = ports_of(name)
    root = etree.fromstring(terminals_xml(ports))
    etree.XMLSchema(etree.parse(str(SCHEMA))).assertValid(root)
    known = {port.name: port.causality for port in ports}
    for member in root.iter("TerminalMemberVariable"):
        assert known[member.get("variableName")] in ("input", "output")
    assert root.find("GraphicalRepresentation/Icon") is not None


@pytest.mark.parametrize("name", FMUS)
def test_fmi_2_has_no_terminals(name):
    """FMILibrary 3 calls the file of another version fatal."""
    assert set(terminal_files(ports_of(name))) == {"model.png"}


@pytest.mark.parametrize("name", ["stiction-mass", "valve-drive", "tip-contact", "stiction-force"])
def test_these_have_a_flange_of_motion_and_force(name):
    members = flange_of(ports_of(name)).members
    units = {port.name: port.unit for port in ports_of(name)}
    found = {member: units[variable] for member, variable in members.items()}
    assert (found["gap"], found["speed"], found["force"]) == ("m", "m/s", "N")


def test_drive_and_mass_fit_each_other():
    """The same kind and members, and what one gives the other takes."""
    pairs = []
    for name in ("stiction-mass", "valve-drive"):
        flange = flange_of(ports_of(name))
        causality = {port.name: port.causality for port in ports_of(name)}
        pairs.append((flange.kind, {m: causality[v] for m, v in flange.members.items()}))
    (kind, mass), (other, drive) = pairs
    assert kind == other
    assert mass.keys() == drive.keys()
    assert all({mass[member], drive[member]} == {"input", "output"} for member in mass)


def test_without_a_flange_there_is_the_icon_alone():
    assert flange_of(ALONE) is None
    files = terminal_files(ALONE, fmi="3")
    assert set(files) == {f"terminalsAndIcons/icon.{end}" for end in ("png", "svg")} | {XML}
    root = etree.fromstring(files[XML])
    etree.XMLSchema(etree.parse(str(SCHEMA))).assertValid(root)
    assert root.find("Terminals") is None


def test_a_parameter_makes_no_flange():
    ports = [Port(n, "m", causality="parameter", label=n) for n in ("h", "v", "F_ext", "dF_ext")]
    assert flange_of(ports) is None


# Documentation ------------------------------------------------------------------------------


class Checker(HTMLParser):
    """Sees that what is opened is closed, and keeps the text of cells."""

    def __init__(self):
        super().__init__()
        self.open, self.cells = [], []

    def handle_starttag(self, tag, attrs):
        if tag not in ("meta", "img", "br"):
            self.open.append(tag)
        if tag == "td":
            self.cells.append("")

    def handle_startendtag(self, tag, attrs):
        pass

    def handle_endtag(self, tag):
        assert self.open.pop() == tag

    def handle_data(self, data):
        if self.open and self.open[-1] == "td":
            self.cells[-1] += data


def read(page):
    checker = Checker()
    checker.feed(page)
    assert checker.open == []
    return checker.cells


def page(**more):
    about = {"name": "stiction-mass", "title": "StictionMass", "summary": "a film", "ports": PORTS}
    about |= {"start": START, **more}
    return index_page(Page.of_python(about.pop("requires", ()), **about))


def test_the_page_names_every_variable_with_its_start():
    cells = read(page())
    rows = {cells[at]: cells[at : at + 9] for at in range(0, len(cells), 9)}
    assert list(rows) == [port.name for port in PORTS]
    for port in PORTS:
        assert rows[port.name][1] == ("" if port.unit == "-" else port.unit)
        assert rows[port.name][4] == port.group
        assert rows[port.name][8] == port.label
    assert rows["h0"][6] == "5e-06"
    assert rows["meniscus_law"][6] == "EXACT"


def test_the_page_says_what_acts_what_does_not_and_by_whom():
    text = page(scene=scene_of(START))
    read(text)
    acts, rest = text.split("What is left out:")
    assert "Stefan" in rest
    assert "viscous" in acts.split("What acts:")[1]
    assert "van der Waals" in rest
    for head in ("Conventions", "How to couple it", "The scene", "Sources", "How to cite"):
        assert f"<h2>{head}" in text
    assert "<td>meniscus.liquid.viscosity</td><td>0.1</td><td>Pa.s</td>" in text
    assert "The scene" not in page()


def test_the_page_says_what_the_host_needs():
    assert "3.11 or later" in page()
    assert "needs: numpy, scipy." in page(requires={"scipy", "numpy"})
    assert "packages: numpy" in external_dependencies(["numpy"])
    assert "none beside" in external_dependencies([])
    assert "two flats also: numpy, scipy\n" in external_dependencies([], ["scipy", "numpy"])


def test_text_is_escaped():
    text = page(title="<b> & c", summary="a < b")
    read(text)
    assert "<title>&lt;b&gt; &amp; c</title>" in text
    assert "a &lt; b" in text


@pytest.mark.parametrize("name", ["drop", "sphere", "humid tip", "tip that sticks", "rough"])
@pytest.mark.parametrize("fmi", ["2", "3"])
def test_a_native_page_of_every_kind_of_scene(name, fmi):
    scene = SCENES[name]
    ports = native_ports(prepare_scene(scene), 0.0)
    text = native_page(scene, ports, {port.name: port.start for port in ports}, fmi=fmi)
    cells = read(text)
    assert {port.name for port in ports} <= set(cells)
    assert f"FMI {fmi}.0 for co-simulation" in text
    assert "Python" not in text
    assert ("early return" in text) == (fmi == "3")
    for effect in scene.effects:
        assert effect.summary in re.sub(r"&#x27;", "'", text)


def test_a_built_fmu_holds_all_of_it(toy_fmu):
    with zipfile.ZipFile(toy_fmu) as packed:
        names = set(packed.namelist())
        assert packed.read("model.png") == icon_png()
        assert b"- Python 3.11" in packed.read("documentation/externalDependencies.txt")
        read(packed.read("documentation/index.html").decode())
    assert {"modelDescription.xml", "documentation/licenses/license.txt"} <= names
    assert XML not in names  # the toy has no flange
