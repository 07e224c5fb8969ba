"""Files made to do harm are refused before memory is taken, by a message with the limit."""

from __future__ import annotations

import io
import json
import os
import pickle
import stat
import tracemalloc
import warnings
import zipfile
from pathlib import Path

import numpy as np
import pytest
from refusals import refuses

import contactkit as ck
from contactkit.app.scenes import open_scene
from contactkit.errors import ContactkitError, DescriptionError
from contactkit.fmu.contents.ssp import Component
from contactkit.reading.archives import checked_archive, member
from contactkit.reading.arrays import read_array, read_arrays
from contactkit.reading.limits import LIMITS, check_limit, limit_of
from contactkit.reading.references import resolved_references
from contactkit.reading.texts import check_keys, check_plain, check_texts, from_json, printable
from contactkit.reading.xml_elements import check_xml, read_xml
from contactkit.roughness.height_maps import read_height_map
from contactkit.units import parse_quantity, parse_unit

pytestmark = pytest.mark.errors

SIZE = {"pixel_size": 1e-9, "unit": "nm"}


@pytest.fixture
def put(tmp_path):
    def make(name, content):
        path = tmp_path / name
        path.write_bytes(content if isinstance(content, bytes) else content.encode())
        return path

    return make


@pytest.fixture
def small(monkeypatch):
    """Set limits for a test."""

    def limits(**values):
        for name, value in values.items():
            monkeypatch.setenv(f"CONTACTKIT_MAX_{name}", str(value))

    return limits


def npy(shape, descr="<f8", content=b"", version=1):
    head = f"{{'descr': {descr!r}, 'fortran_order': False, 'shape': {shape}, }}".ljust(117) + "\n"
    return (
        b"\x93NUMPY"
        + bytes([version, 0])
        + len(head).to_bytes(2, "little")
        + head.encode()
        + content
    )


def archive(members, **attributes):
    made = io.BytesIO()
    with zipfile.ZipFile(made, "w", zipfile.ZIP_DEFLATED) as packed:
        for name, content in members:
            info = zipfile.ZipInfo(name)
            info.compress_type = zipfile.ZIP_DEFLATED
            for key, value in attributes.items():
                setattr(info, key, value)
            with warnings.catch_warnings():
                warnings.simplefilter("ignore")  # of a name that is there twice
                packed.writestr(info, content)
    return made.getvalue()


def peak(call):
    """Most memory that a call takes [bytes]; it is refused."""
    tracemalloc.start()
    with pytest.raises(ContactkitError):
        call()
    most = tracemalloc.get_traced_memory()[1]
    tracemalloc.stop()
    return most


# Limits --------------------------------------------------------------------------------------


@pytest.mark.parametrize("name", LIMITS)
def test_a_limit_is_named_with_both_numbers_and_the_cure(name, small):
    limit = LIMITS[name].value
    check_limit(name, limit, "a.npz")
    refuses(
        lambda: check_limit(name, 2 * limit, "a.npz"),
        "file must ",
        LIMITS[name].text(limit),
        LIMITS[name].text(2 * limit),
        "got 'a.npz'; if it is meant, set ",
        f"CONTACTKIT_MAX_{name}={2 * limit}",
    )
    small(**{name: 2 * limit})
    check_limit(name, 2 * limit, "a.npz")
    with pytest.raises(DescriptionError):
        check_limit(name, 10**400, "a.npz")


@pytest.mark.parametrize("text", ["", "many", "-1", "0", "nan", "inf", "9" * 50])
def test_a_limit_that_is_no_number_is_refused(small, text):
    small(PIXELS=text)
    refuses(lambda: limit_of("PIXELS"), "CONTACTKIT_MAX_PIXELS must be a positive whole number")


# Arrays --------------------------------------------------------------------------------------

ANNOUNCED = {
    "elements": npy("(1000000000000,)"),
    "product": npy("(3000000, 3000000, 3000000)"),
    "beyond-int": npy("(1" + "0" * 80 + ",)"),
    "more-than-held": npy("(1000, 1000)", content=b"\0" * 800),
    "texts": npy("()", "<U99999999"),
    "nothing-often": npy("(9999999999999,)", "<U0"),
    "negative": npy("(-1, 3)", content=b"\0" * 800),
}


@pytest.mark.parametrize("name", ANNOUNCED)
def test_an_array_that_announces_too_much_takes_no_memory(put, name):
    path = put("map.npy", ANNOUNCED[name])
    refuses(lambda: read_height_map(path, **SIZE), "map.npy")
    assert peak(lambda: read_height_map(path, **SIZE)) < 1e6
    result = put("result.npz", archive([("header.npy", ANNOUNCED[name])]))
    refuses(lambda: ck.load_result(result), "file must be a result of contactkit", "header")
    assert peak(lambda: ck.load_result(result)) < 1e6


class Runs:
    """What a pickle may do."""

    ran = False

    def __reduce__(self):
        return (setattr, (Runs, "ran", True))


def test_no_pickle_is_read(put):
    content = io.BytesIO()
    np.save(content, np.array([[Runs(), 1], [2, 3]], dtype=object), allow_pickle=True)
    for name, data in (("a.npy", content.getvalue()), ("b.npy", pickle.dumps(Runs()))):
        path = put(name, data)
        refuses(lambda path=path: read_height_map(path, **SIZE), "a numpy file")
    header = ("header.npy", npy("()", "<U1", b"a\0\0\0"))
    for inside in (content.getvalue(), pickle.dumps(Runs())):
        path = put("a.npz", archive([header, ("x.npy", inside)]))
        refuses(lambda path=path: ck.load_result(path), "be a result of contactkit")
    path = put("c.npz", archive([header, ("x", b"1")]))
    refuses(lambda: ck.load_result(path), "hold arrays only")
    assert not Runs.ran


def test_records_and_another_version_are_refused():
    for data in (npy("(1,)", [("a", "<f8")], b"\0" * 8), npy("(1,)", "<M8[s]", b"\0" * 8)):
        refuses(
            lambda data=data: read_array(io.BytesIO(data), len(data), "a"), "records or pickles"
        )
    data = npy("(1,)", content=b"\0" * 8, version=3)
    refuses(lambda: read_array(io.BytesIO(data), len(data), "a"), "version (3, 0)")


def test_arrays_are_read_as_numpy_writes_them():
    given = {
        "matrix": np.arange(6.0).reshape(2, 3),
        "fortran": np.asfortranarray(np.arange(6.0).reshape(2, 3)),
        "big": np.arange(3, dtype=">i4"),
        "flags": np.array([True, False]),
        "text": np.array("a text"),
        "none": np.zeros((0, 4)),
    }
    file = io.BytesIO()
    np.savez_compressed(file, **given)
    found = read_arrays(file, "a.npz")
    assert found.keys() == given.keys()
    for name, array in found.items():
        np.testing.assert_array_equal(array, given[name])
        assert array.dtype == given[name].dtype
        assert not array.flags.writeable


# Archives ------------------------------------------------------------------------------------

NAMES = ["../a", "a/../../b", "/etc/a", "C:/a", "a\\b", "a//b", "./a", "..", "a\nb", "a\x7fb"]


def opened(content):
    with checked_archive(io.BytesIO(content), "a.fmu") as packed:
        return packed.namelist()


@pytest.mark.parametrize("name", NAMES)
def test_a_member_stays_inside_of_its_folder(name):
    data = archive([(name.replace("\\", "?"), b"x")]).replace(b"a?b", b"a\\b")
    refuses(lambda: opened(data), "a.fmu, member must be a path inside the archive")


def test_members_are_plain_files_and_there_once():
    link = (stat.S_IFLNK | 0o777) << 16
    refuses(lambda: opened(archive([("a", b"/etc")], external_attr=link)), "not a link or a device")
    refuses(lambda: opened(archive([("a", b"1"), ("a", b"2")])), "be there once")
    bz2 = archive([("a", b"1")], compress_type=zipfile.ZIP_BZIP2)
    refuses(lambda: opened(bz2), "be stored or deflated")
    locked = bytearray(archive([("a", b"1")]))
    locked[locked.index(b"PK\x01\x02") + 8] |= 1
    refuses(lambda: opened(bytes(locked)), "not be encrypted")
    assert opened(archive([("resources/", b""), ("resources/ä b.txt", b"1")])) == [
        "resources/",
        "resources/ä b.txt",
    ]


def test_a_bomb_is_refused_unread(put, small):
    bomb = archive([(f"{i}.npy", bytes(2**22)) for i in range(8)])
    assert len(bomb) < 2**16
    assert peak(lambda: opened(bomb)) < 1e6
    refuses(lambda: opened(bomb), "unpack to at most 200 times its size", "MAX_RATIO=")
    refuses(lambda: ck.load_result(put("a.npz", bomb)), "be a result", "MAX_RATIO=")
    refuses(lambda: Component(name="a", source="a.fmu", fmu=bomb).model(), "MAX_RATIO=")
    small(RATIO=10_000, BYTES=2**24)
    refuses(lambda: opened(bomb), "have at most 16 MiB (a.fmu, unpacked has 32 MiB)")
    small(BYTES=2**26, MEMBERS=7)
    refuses(lambda: opened(bomb), "have at most 7 files (a.fmu has 8 files)")


def test_a_member_is_read_within_a_limit(small):
    data = archive([("modelDescription.xml", b"<a/>" * 100)])
    small(TEXT_BYTES=300)
    with checked_archive(io.BytesIO(data), "a.fmu") as packed:
        refuses(
            lambda: member(packed, "modelDescription.xml", "TEXT_BYTES", "a.fmu"),
            "have at most 300 bytes (a.fmu, modelDescription.xml has 400 bytes)",
        )
        refuses(lambda: member(packed, "b", "TEXT_BYTES", "a.fmu"), "a member b")
    cavitated = bytearray(data)
    cavitated[40:44] = b"\xff" * 4
    with checked_archive(io.BytesIO(bytes(cavitated)), "a.fmu") as packed:
        refuses(lambda: member(packed, "modelDescription.xml", "BYTES", "a.fmu"), "that is whole")


# XML -----------------------------------------------------------------------------------------

LAUGHS = b"""<!DOCTYPE a [<!ENTITY x "ha"><!ENTITY y "&x;&x;&x;&x;">]><a>&y;</a>"""
FILE = b"""<?xml version="1.0"?><!DOCTYPE a [<!ENTITY x SYSTEM "file:///etc/passwd">]><a>&x;</a>"""


@pytest.mark.parametrize("text", [LAUGHS, FILE, b'<!DOCTYPE a SYSTEM "http://host/a.dtd"><a/>'])
def test_entities_are_not_expanded(text):
    refuses(lambda: read_xml(text, "a.xml"), "have no document type", "there is a")


def test_xml_has_a_depth_a_size_and_an_encoding(small):
    refuses(lambda: check_xml(b"<a>" * 70, "a.xml"), "have at most 64 levels (a.xml has 65 levels)")
    refuses(lambda: check_xml(b"<a>", "a.xml"), "be XML", "no element found")
    refuses(lambda: read_xml(b"<a b:c='1'/>", "a.xml"), "be XML", "unbound prefix")
    coded = '<?xml version="1.0" encoding="utf-7"?><a/>'
    refuses(lambda: check_xml(coded.encode(), "a.xml"), "be encoded as utf-8")
    small(TEXT_BYTES=3)
    refuses(lambda: check_xml(b"<a/>", "a.xml"), "have at most 3 bytes")


def test_the_description_of_an_fmu_is_plain(put):
    from contactkit.fmu.framework.instance import Instance

    for text, said in ((LAUGHS, "have no document type"), (b"<a>" * 99, "64 levels")):
        path = put("a.fmu", archive([("modelDescription.xml", text)]))
        refuses(lambda path=path: Instance(path), said)
    path = put("a.fmu", archive([("modelDescription.xml", b"<a/>"), ("../b", b"")]))
    refuses(lambda: Instance(path), "a path inside the archive")


def test_the_library_of_an_fmu_is_inside_of_it(put):
    from contactkit.fmu.framework.instance import Instance

    text = """<?xml version="1.0" encoding="UTF-8"?>
<fmiModelDescription fmiVersion="2.0" modelName="a" guid="1">
<CoSimulation modelIdentifier="../../../a"/>
<ModelVariables><ScalarVariable name="y" valueReference="0" causality="output"><Real/>
</ScalarVariable></ModelVariables>
<ModelStructure><Outputs><Unknown index="1"/></Outputs></ModelStructure></fmiModelDescription>"""
    path = put("a.fmu", archive([("modelDescription.xml", text)]))
    refuses(lambda: Instance(path), "FMU modelIdentifier must be an identifier of C", "../../../a")


# Scenes --------------------------------------------------------------------------------------

DEEP = {
    "lists": "a = " + "[" * 5000 + "]" * 5000,
    "tables": "a = " + "{a = " * 70 + "1" + "}" * 70,
    "keys": "a." * 50_000 + "a = 1",
    "quoted": '"a" . ' * 50_000 + "a = 1",
    "headers": "[" + "a." * 50_000 + "a]",
    "in-braces": "b = {" + "a." * 50_000 + "a = 1}",
    "after-text": 'b = ["""\\"""", {' + "a." * 50_000 + "a = 1}]",
}


@pytest.mark.parametrize("name", DEEP)
def test_a_scene_file_that_is_nested_deeply_is_refused(put, name):
    path = put("a.toml", DEEP[name])
    refuses(lambda: ck.load_scene(path), "have at most 64 levels", "CONTACTKIT_MAX_DEPTH=")


@pytest.mark.parametrize("name", DEEP)
def test_the_depth_that_is_advised_can_be_read(put, small, name):
    """A limit beyond what the parsers read would end in a RecursionError."""
    path = put("a.toml", DEEP[name])
    most = LIMITS["DEPTH"].most
    small(DEPTH=most)
    if name != "tables":  # of 70 levels
        said = f"at most {most} levels can be read, with CONTACTKIT_MAX_DEPTH={most}"
        refuses(lambda: ck.load_scene(path), f"have at most {most} levels", said)
    small(DEPTH=100_000)
    said = f"CONTACTKIT_MAX_DEPTH must be a positive whole number, at most {most}"
    refuses(lambda: ck.load_scene(path), said)


def test_the_greatest_depth_is_read_by_every_reader(put, small):
    most = LIMITS["DEPTH"].most
    small(DEPTH=most)
    inside = most - 1
    path = put("a.toml", "a = " + "{a = " * inside + "1" + "}" * inside)
    refuses(lambda: ck.load_scene(path), "a must be a known key")
    assert from_json("[" * most + "]" * most, "a.json")
    refuses(lambda: from_json("[" * 10**6, "a.json"), f"at most {most} levels can be read")
    assert len(read_xml(b"<a>" * most + b"</a>" * most, "a.xml")) == 1


ESCAPE = "\x1b[31mred"


@pytest.mark.parametrize(
    "text",
    [
        'name = "\\u001b[31mred"',
        '[interface.meniscus.liquid]\nname = "\\u009b31m"',
        '[study]\n"loading.\\u0007" = [1]',
        'a = ["\\b"]',
    ],
)
def test_a_scene_file_holds_nothing_that_a_terminal_obeys(put, text):
    path = put("a.toml", text)
    with pytest.raises(DescriptionError, match="hold texts without control characters") as caught:
        ck.load_scene(path)
    assert str(caught.value).isprintable()


def test_lines_and_tabs_of_texts_are_no_commands():
    check_texts({"a": ["one\ntwo\tthree\r\n", 1], "b": {"c": "é \u202e"}}, "a.toml")
    assert printable("one\ntwo\tthree é") == "one\ntwo\tthree é"
    assert printable(f"{ESCAPE}\x9b\x07\u202e\r") == "\\x1b[31mred\\x9b\\x07\\u202e\\r"


def test_what_a_command_prints_is_printable(tmp_path, monkeypatch, capsys):
    from contactkit.cli import main
    from contactkit.commands import terminal

    terminal.say(f"liquid {ESCAPE}")
    terminal.remark(f"axis {ESCAPE}")
    main(["plan", str(tmp_path / f"{ESCAPE}.toml")])
    said = capsys.readouterr()
    assert "\x1b" not in said.out + said.err
    assert said.out == "liquid \\x1b[31mred\n"
    assert "axis \\x1b[31mred" in said.err


@pytest.mark.parametrize(
    "text",
    [
        "KEY = 1",
        "[interface]\nKEY = 1",
        "[KEY]\nKEY = 1",
        '[[effects]]\neffect = "half-space"\nKEY = 1',
        "[study]\nKEY = [1]",
        '[loading]\nkind = "pressing"\nKEY = 1',
        "KEY = 1\nKEY = 2",
    ],
)
def test_a_long_key_is_not_repeated_whole(put, text):
    path = put("a.toml", text.replace("KEY", "k" * 20_000))

    def read():
        opened = open_scene(str(path))
        ck.study(opened.scene, opened.parameters)

    with pytest.raises(DescriptionError) as caught:
        read()
    assert len(str(caught.value)) < 1500
    assert len(str(DescriptionError("k" * 20_000, 1, "be short"))) < 500


def test_dots_that_are_no_keys_are_none():
    text = '# ....................................................................... \na = "'
    check_keys(text + "." * 100 + '"\nb = """\n' + "." * 100 + '\n"""\nc = 1.5', "a.toml")


def test_a_scene_file_has_a_size(put, small):
    small(SCENE_BYTES=1000)
    path = put("a.toml", "#" * 1001)
    said = "file must have at most 1000 bytes", "has 1001 bytes", "CONTACTKIT_MAX_SCENE_BYTES=1001"
    for read in (ck.load_scene, lambda path: open_scene(str(path))):
        refuses(lambda read=read: read(path), *said)


def test_an_endless_file_is_not_read():
    if not os.path.exists("/dev/zero"):
        pytest.skip("no such file here")
    refuses(lambda: ck.load_scene("/dev/zero"), "be readable", "a folder or a device")
    refuses(lambda: read_height_map("/dev/zero", **SIZE), "be a file that exists")


@pytest.mark.parametrize("number", ["9" * 5000, "0x" + "f" * 5000, "9223372036854775808"])
def test_long_numbers_are_refused(put, number):
    path = put("a.toml", f"temperature = {number}")
    with pytest.raises(DescriptionError, match=r"a\.toml") as caught:
        ck.load_scene(path)
    assert len(str(caught.value)) < 500


def test_a_long_value_is_not_printed_whole():
    text = str(DescriptionError("a", "x" * 10**6, "be short"))
    assert len(text) < 1000
    assert str(DescriptionError("a", 10**5000, "be short")).endswith("got a int too large to print")


@pytest.mark.parametrize("text", ["m99999", "m-99", "m^" + "9" * 5000, "m*" * 200 + "m"])
def test_absurd_units_are_refused(text):
    with pytest.raises(DescriptionError, match=r"unit|number and a unit|powers"):
        parse_quantity(f"1 {text}", "m")
    with pytest.raises(DescriptionError, match="unit"):
        parse_unit(text)


def test_grids_and_studies_have_a_size(put, small):
    refuses(
        lambda: ck.Accuracy(grid=(10**6, 10**6)),
        "Accuracy.grid must have at most 67,108,864 pixels",
        "CONTACTKIT_MAX_PIXELS=1000000000000",
    )
    refuses(lambda: ck.Accuracy(points=10**9), "Accuracy.points must", "CONTACTKIT_MAX_POINTS=")
    oil = ck.Liquid(name="oil", viscosity=0.1, surface_tension=0.03)
    face = ck.Flat(radius=1e-3)
    scene = ck.SeparationScene(
        interface=ck.Interface(
            lower=face, upper=face, meniscus=ck.Meniscus(liquid=oil, volume=1e-12)
        ),
        loading=ck.ImposedSpeed(speed=1e-3, initial_gap=1e-6, final_gap=1e-5),
        effects=(ck.ViscousForce(),),
    )
    values = list(np.linspace(1e-6, 2e-6, 1001))
    vary = {"loading.initial_gap": values, "loading.speed": values}
    refuses(
        lambda: ck.study(scene, vary), "parameters must have at most 1,000,000 points", "1,002,001"
    )
    small(PIXELS=10)
    path = put("a.csv", "0, 1, 2, 3\n" * 3)
    refuses(lambda: read_height_map(path, **SIZE), "have at most 10 pixels", "has 12 pixels")


def test_scattered_points_take_no_memory(put):
    path = put("a.xyz", "\n".join(f"{i} {i} 0" for i in range(20_000)))
    assert peak(lambda: read_height_map(path, unit="nm")) < 2e7
    refuses(lambda: read_height_map(path, unit="nm"), "20000 x 20000", "20000 points", "no regular")


def test_heights_beyond_any_length_are_refused(put):
    path = put("a.csv", "0, 1e300\n1, 2\n")
    refuses(lambda: read_height_map(path, **SIZE), "be at most 1e+60 in size in a.csv [m]")


def test_a_list_of_mistakes_has_an_end(put):
    path = put("a.toml", "effects = [" + "1, " * 1000 + "]")
    with pytest.raises(DescriptionError, match=r"and 9\d\d more") as caught:
        ck.load_scene(path)
    assert str(caught.value).count("\n") == 51


# References ----------------------------------------------------------------------------------

SCENE = """
[interface]
lower = { shape = "flat" }
upper = { shape = "measured", path = "PATH", pixel_size = "1 nm", unit = "nm" }
[loading]
kind = "pressing"
pressure = "1 MPa"
[[effects]]
effect = "half-space"
"""


@pytest.mark.parametrize("name", ["../map.npy", "/etc/passwd", "a/../../map.npy", "link/map.npy"])
def test_a_scene_file_names_no_file_elsewhere(tmp_path, monkeypatch, name):
    folder = tmp_path / "scenes"
    folder.mkdir()
    monkeypatch.chdir(folder)
    (folder / "link").symlink_to(tmp_path, target_is_directory=True)
    path = folder / "a.toml"
    said = "a.toml, path must be a file below the folder of the scene file", "CONTACTKIT_READ_FROM="
    path.write_text(SCENE.replace("PATH", name))
    refuses(lambda: ck.load_scene(path), *said)
    refuses(lambda: open_scene(str(path)), *said)
    text = SCENE.replace("PATH", "map.npy") + f'[study]\n"interface.upper.path" = ["{name}"]\n'
    path.write_text(text)
    refuses(lambda: open_scene(str(path)), "path must be a file below the folder")
    monkeypatch.setenv("CONTACTKIT_READ_FROM", os.pathsep.join(["/etc", str(tmp_path)]))
    path.write_text(SCENE.replace("PATH", name))
    found = Path(ck.load_scene(path).interface.upper.surface.path)
    assert found == (folder / name).parent.resolve() / Path(name).name


def test_the_contact_of_a_device_is_beside_it(tmp_path, monkeypatch):
    folder = tmp_path / "scenes"
    folder.mkdir()
    monkeypatch.chdir(folder)
    path = folder / "a.toml"
    path.write_text('device = "micromirror"\n[tip.faces]\ncontact = "../b.toml"\n')
    refuses(lambda: open_scene(str(path)), "a.toml, contact must be a file below the folder")
    for key in ("path", "contact"):
        path.write_text(f'[tip]\n{key} = "{"x" * 5000}"\n')
        said = f"a.toml, {key} must be the name of a file"
        refuses(lambda: open_scene(str(path)), said)
        refuses(lambda key=key: resolved_references({key: "a\0b"}, path), said)


# Values of JSON ------------------------------------------------------------------------------


def test_json_has_a_depth_and_numbers_of_a_size(small):
    deep = "[" * 100_000
    refuses(lambda: from_json(deep, "a.json"), "have at most 64 levels")
    refuses(lambda: from_json("[" * 70 + "]" * 70, "a.json"), "have at most 64 levels")
    refuses(lambda: from_json("9" * 5000, "a.json"), "hold JSON")
    refuses(lambda: from_json(str(2**63), "a.json"), "integers of at most 64 bits", "one has 64")
    refuses(lambda: from_json(b"\xff", "a.json"), "hold JSON")
    check_plain(json.loads(str(-(2**63))), "a.json")
    small(TEXT_BYTES=3)
    refuses(lambda: from_json("[1]  ", "a.json"), "have at most 3 bytes (a.json has 5 bytes)")
