"""One description of the models: C reads each name and each number that Python writes."""

from __future__ import annotations

import re
import subprocess

import attrs
import numpy as np
import pytest
from native_scenes import HAS_CC, HERE, SCENES, compile_c, write_sources

pytest.importorskip("pythonfmu")
pytest.importorskip("fmpy")
if not HAS_CC:
    pytest.skip("there is no C compiler", allow_module_level=True)

import contactkit as ck
from contactkit.analyses.load_displacement.curve import LoadDisplacementCurve
from contactkit.errors import DescriptionError
from contactkit.fmu.contents.end_stop import default_curve
from contactkit.fmu.native import sources
from contactkit.fmu.native.data import contents_of, data_file
from contactkit.fmu.native.deforming import deforming_film
from contactkit.fmu.native.faces import faces_of
from contactkit.fmu.native.film import moving, prepared_film
from contactkit.fmu.native.models import MODELS, VARIABLES
from contactkit.fmu.native.record import Record
from contactkit.fmu.native.records import Curve, LiquidTable

MAYBE = ("tables", "faces", "residual", "dissipated", "bodies", "series", "rings", "liquid")
"""Members that may be missing."""
SCENE = ck.SeparationScene(
    interface=ck.Interface(
        lower=ck.Body(
            surface=ck.Flat(radius=1e-3), solid=ck.Material(young_modulus=1e9, poisson_ratio=0.3)
        ),
        upper=ck.Sphere(radius=5e-3),
        meniscus=ck.Meniscus(liquid=ck.Liquid(name="oil", viscosity=0.1)),
    ),
    loading=ck.ImposedSpeed(speed=1e-5, initial_gap=1e-6, final_gap=2e-6),
    effects=(ck.ElasticBodies(), ck.ViscousForce()),
)
SOFT = deforming_film(SCENE)

OIL = LiquidTable(
    low=250.0, high=400.0, viscosity=(0.5, 0.4, 0.2, 0.1), surface_tension=(-3.0, -3.1, -3.2, -3.3)
)

MADE = {*sources.description_sources()}
LAYOUT = sources.layout()


@pytest.fixture(scope="module")
def faces():
    """Elastic faces, with as few nodes as distinguish the curves."""
    curve = default_curve()
    assert curve.unloading
    return faces_of(LoadDisplacementCurve.from_data(curve.to_data()))


@pytest.fixture(scope="module")
def contents(faces):
    """Contents of a file of each model, by its name."""
    tables = prepared_film(moving(SCENES["rewetting"], None)).tables
    solids = prepared_film(moving(SCENES["solids"], None)).tables
    held = {
        "stiction-mass": (tables, None, None, OIL),
        "stiction-force": (solids, None),
        "valve-drive": (None, None),
        "contact-stop": (None, faces),
        "tip-contact": (solids, faces),
        "deforming-mass": (None, None, SOFT.bodies),
        "deforming-force": (None, None, deforming_film(SCENE, 5e-3).bodies),
    }
    assert set(held) == set(MODELS)
    return {
        name: contents_of(
            name, MODELS[name].ports, {"T": 293.15, **MODELS[name].slave.start_values()}, *more
        )
        for name, more in held.items()
    }


def members(owner, path):
    """Path in C and value of each number of a record, found without what writes or reads it."""
    lengths = {len(getattr(owner, m.name)) for m in owner.columns()}
    assert len(lengths) <= 1
    yield from ((f"{path}.n_nodes", length) for length in lengths)
    for name in attrs.asdict(owner, recurse=False):
        value, here = getattr(owner, name), f"{path}.{name}"
        if isinstance(value, tuple):
            if name not in {m.name for m in owner.columns()}:
                yield f"{path}.n_{name}", len(value)
            for i, one in enumerate(value):
                inner = f"{here}[{i}]"
                yield from members(one, inner) if isinstance(one, Record) else [(inner, one)]
        elif value is None:
            yield f"{path}.has_{name}", 0
        elif isinstance(value, Record):
            if name in MAYBE:
                yield f"{path}.has_{name}", 1
            yield from members(value, here)
        else:
            yield here, value


@pytest.fixture(scope="module")
def reader(shelf):
    """Folder of the headers of the kernel, and of what reads a file, compiled."""

    def make(folder):
        write_sources(folder)
        for name in ("data", "description"):
            compile_c([folder / f"{name}.c"], folder / f"{name}.o", f"-I{folder}", "-O0", "-c")

    return shelf.folder("kernel reader", make)


@pytest.mark.parametrize("model", MODELS)
def test_c_finds_each_number_by_its_name(model, contents, reader, tmp_path):
    """A program that prints the members by their names, against the values of Python."""
    found = list(members(contents[model], "c"))
    few = found[:: max(len(found) // 800, 1)] + [one for one in found if "[" not in one[0]]
    text = "".join(f'    printf("%.17g\\n", (double){path});\n' for path, _ in few)
    (tmp_path / "members.c").write_text(
        '#include "model.h"\n#include <stdio.h>\n#include <stdlib.h>\n'
        "int main(int count, char **words) {\n    static ck_data data;\n"
        "    const ck_contents *at = &data.contents;\n"
        "    if (count != 2 || ck_data_read(words[1], &data)) return 1;\n"
        f"#define c (*at)\n{text}    free(data.numbers), free(data.cells);\n    return 0;\n}}\n"
    )
    files = [tmp_path / "members.c", reader / "data.o", reader / "description.o"]
    program = compile_c(files, tmp_path / "members", f"-I{reader}", "-O0")
    (tmp_path / "film.bin").write_bytes(data_file("g", LAYOUT, contents[model].numbers()))
    said = subprocess.run(
        [str(program), str(tmp_path / "film.bin")], check=True, capture_output=True, text=True
    ).stdout.split()
    np.testing.assert_array_equal([float(word) for word in said], [float(v) for _, v in few])


def kernel_text():
    """What is written by hand of the kernel, but for its comments."""
    texts = (text.decode() for name, text in sources.kernel_sources(2).items() if name not in MADE)
    both = [*texts, sources.kernel_sources(3)["fmi3.c"].decode()]
    return re.sub(r"/\*.*?\*/", "", "\n".join(both), flags=re.DOTALL)


def test_each_variable_means_something_in_c():
    """A port without C behind it, or a name that C does not know, is noticed."""
    text = kernel_text()
    assert [n for n in VARIABLES if not re.search(rf"\bCK_{n.upper()}\b", text)] == []


def test_each_member_of_a_record_is_read_in_c():
    text = kernel_text()
    unread = [
        f"{record.__name__}.{member.name}"
        for record in sources._records()
        for member in record.members()
        if not re.search(rf"(->|\.){member.name}\b", text)
    ]
    assert unread == []


def test_each_discrete_output_is_held_between_events():
    made = sources.description_sources()["description.c"].decode()
    held = re.search(r"ck_discrete\[CK_DISCRETE\] = \{(.*?)\}", made, re.DOTALL)[1]
    ports = [port for model in MODELS.values() for port in model.ports]
    is_held = {
        port.name: f"CK_{port.name.upper()}" in held.replace(",", " ").split() for port in ports
    }
    for port in ports:
        if port.causality == "output":
            assert is_held[port.name] is (port.variability == "discrete"), port.name


@pytest.fixture(scope="module")
def opened(shelf):
    """What the kernel says of a file; empty if it takes it."""

    def make(folder):
        write_sources(folder)
        files = [path for path in folder.glob("*.c") if not path.name.startswith(("fmi2", "fmi3"))]
        compile_c([HERE / "native_probe.c", *files], folder / "probe", f"-I{folder}", "-O0")

    probe = shelf.folder("kernel probe", make) / "probe"

    def of(folder, layout, numbers):
        (folder / "film.bin").write_bytes(data_file("g", layout, numbers))
        words = [str(probe), str(folder), "1", "1", "0", "0"]
        return subprocess.run(words, capture_output=True, text=True, input="", check=False).stderr

    return of


def spoiled(name, numbers, contents):
    """Numbers of a film in a wrong order, or of a wrong length or model."""
    film = contents["stiction-mass"].tables
    at = len(numbers) - len(film.numbers())  # the first of the film
    swapped = [*numbers[: at + 1], numbers[at + 2], numbers[at + 1], *numbers[at + 3 :]]
    return {
        "cut": numbers[:-1],
        "longer": [*numbers, 0.0],
        "one too few": [*numbers[:at], *numbers[at + 1 :]],
        "swapped": swapped,
        "of a drive": [float([*MODELS].index("valve-drive")), *numbers[1:]],
        "of a stop": [float([*MODELS].index("contact-stop")), *numbers[1:]],
    }[name]


@pytest.mark.parametrize(
    "way", ["cut", "longer", "one too few", "swapped", "of a drive", "of a stop"]
)
def test_a_wrong_order_or_length_is_refused(way, contents, opened, tmp_path):
    numbers = contents["stiction-mass"].numbers()
    assert opened(tmp_path, LAYOUT, numbers) == ""
    wrong = spoiled(way, numbers, contents)
    assert "makes no sense" in opened(tmp_path, LAYOUT, wrong)


def test_a_file_of_another_description_is_refused(contents, opened, tmp_path):
    """Whatever its numbers: another order may fit into the same ranges."""
    numbers = contents["stiction-mass"].numbers()
    other = "CK" + ("000000" if LAYOUT != "CK000000" else "111111")
    assert "no file of this FMU" in opened(tmp_path, other, numbers)


def test_letters_of_the_layout_follow_names_order_and_ranges(monkeypatch):
    seen = {LAYOUT}
    declared, readers = sources._declarations(), sources._readers()
    for words in (("low;", "least;"), ("CK_H = 2", "CK_H = 3")):
        changed = tuple(text.replace(*words) for text in declared)
        assert changed != declared
        monkeypatch.setattr(sources, "_declarations", lambda changed=changed: changed)
        seen.add(sources.layout.__wrapped__())
    monkeypatch.setattr(sources, "_declarations", lambda: declared)
    monkeypatch.setattr(sources, "_readers", lambda: readers.replace("r, 0, 8)", "r, 0, 9)"))
    seen.add(sources.layout.__wrapped__())
    assert len(seen) == 4


def test_values_out_of_range_are_refused_by_name(contents):
    film = contents["stiction-mass"].tables
    with pytest.raises(
        DescriptionError, match=r"FilmTables\.rewetting must be a number from 0 to 1"
    ):
        attrs.evolve(film, rewetting=1.5)
    with pytest.raises(DescriptionError, match=r"FilmTables\.is_sphere must be a bool"):
        attrs.evolve(film, is_sphere=1.0)
    with pytest.raises(DescriptionError, match=r"FilmTables\.films must be 1 to 2 in a tuple"):
        attrs.evolve(film, films=())
    with pytest.raises(DescriptionError, match=r"Curve\.x must be .* ascending numbers"):
        Curve(x=(1.0, 1.0), y=(0.0, 1.0), slope=(0.0, 0.0))
    with pytest.raises(DescriptionError, match=r"Curve\(x, y, slope\) must be equally long"):
        Curve(x=(1.0, 2.0), y=(0.0, 1.0, 2.0), slope=(0.0, 0.0))


def test_models_that_lack_faces_or_have_too_many_are_refused(faces):
    with pytest.raises(DescriptionError, match=r"faces of contact-stop must be given"):
        contents_of("contact-stop", (), {})
    with pytest.raises(DescriptionError, match=r"tables of stiction-mass must be given"):
        contents_of("stiction-mass", (), {}, faces=faces)
    tables = prepared_film(moving(SCENES["flooded"], None)).tables
    with pytest.raises(DescriptionError, match=r"faces of stiction-mass must be None"):
        contents_of("stiction-mass", (), {}, tables, faces)
    with pytest.raises(DescriptionError, match=r"tables of valve-drive must be None"):
        contents_of("valve-drive", (), {}, tables)
    with pytest.raises(DescriptionError, match=r"bodies of deforming-mass must be given"):
        contents_of("deforming-mass", (), {})
    with pytest.raises(DescriptionError, match=r"bodies of stiction-mass must be None"):
        contents_of("stiction-mass", (), {}, tables, bodies=SOFT.bodies)


def test_names_that_differ_by_capitals_alone_are_refused():
    with pytest.raises(DescriptionError, match=r"names of variables .*D.*d"):
        sources._distinct(["D", "h", "d"])
