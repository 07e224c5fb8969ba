"""Height maps from files: what is read, and of what is not the reason and the cure."""

from __future__ import annotations

import hashlib
import sys

import numpy as np
import pytest
from scipy.io import savemat

from contactkit.errors import DescriptionError
from contactkit.roughness.height_maps import checksum, read_height_map

pytestmark = pytest.mark.errors

NUMBERS = np.array([[0.0, 1.0, 2.0], [3.0, 4.0, 5.5]])
SIZE = {"pixel_size": (2e-9, 1e-9), "unit": "nm"}


@pytest.fixture
def write(tmp_path):
    def make(name, content):
        path = tmp_path / name
        if isinstance(content, bytes):
            path.write_bytes(content)
        elif isinstance(content, str):
            path.write_text(content, encoding="utf-8")
        else:
            np.save(path, content, allow_pickle=True)
        return path

    return make


# What is read -------------------------------------------------------------------------------

TEXTS = {
    "a.csv": "0,1,2\n3,4,5.5\n",
    "b.csv": "\ufeff0; 1; 2\r\n3; 4; 5.5\r\n",
    "c.txt": "# a comment\n0 1  2\n\n3 4 5.5  # another\n",
    "d.dat": "0\t1\t2\n3\t4\t5.5",
    "E.TXT": "  0, 1, 2\n  3, 4, 5.5e0\n",
    "commas.csv": "0;1,0;2\n3,00;4;5,5\n",
    "commas.txt": "0\t1,0\t2\n3,00\t4\t5,5\n",
    "commas.dat": "0,0 1,0 2,0\n3,00 4,0 5,5e0\n",
}


@pytest.mark.parametrize("name", TEXTS)
def test_rows_of_numbers(write, name):
    found = read_height_map(write(name, TEXTS[name]), **SIZE)
    np.testing.assert_allclose(found.heights, NUMBERS * 1e-9, rtol=1e-15)
    assert found.pixel_size == (2e-9, 1e-9)
    assert found.source == name
    assert found.heights.flags.c_contiguous


HEADERS = {
    "gwyddion": "# Channel: Z\n# Width: 3.000 µm\n# Height: 4.000 µm\n# Value units: nm\n",
    "wsxm": "WSxM file copyright\nWSxM ASCII Matrix file\nX Amplitude: 3 um\nY Amplitude: 4 um\n"
    "Z Amplitude: 5.5 nm\nNumber of rows: 2\n\n",
}


@pytest.mark.parametrize("name", HEADERS)
def test_a_header_states_size_and_unit(write, name):
    path = write("a.txt", HEADERS[name] + "0\t1\t2\n3\t4\t5.5\n")
    found = read_height_map(path)
    np.testing.assert_allclose(found.heights, NUMBERS * 1e-9, rtol=1e-15)
    assert found.pixel_size == pytest.approx((2e-6, 1e-6))
    for given in ({"unit": "nm"}, {"pixel_size": 1e-6}):
        with pytest.raises(DescriptionError, match=r"left out: a\.txt contains it"):
            read_height_map(path, **given)


def test_a_header_that_states_no_length_is_refused(write):
    text = HEADERS["gwyddion"].replace("3.000 µm", "3 s")
    with pytest.raises(DescriptionError, match=r"header of a\.txt"):
        read_height_map(write("a.txt", text + "0 1\n2 3\n"))


HOLEY = {
    "a.csv": ("0,,2\n3,4,5.5\n", SIZE),
    "b.csv": ("0;;2,0\n3;4;5,5\n", SIZE),
    "c.tsv": ("0\t\t2\n3\t4\t5.5\n", SIZE),
    "d.txt": ("0 nan 2\n3 4 5.5\n", SIZE),
    "g.txt": ("0 Bad 2\n3 4 5.5\n", SIZE),
    "h.csv": ("0,--,2\n3,4,5.5\n", SIZE),
    "i.csv": ("0;***;2,0\n3;4;5,5\n", SIZE),
    "e.xyz": ("0 0 0\n2 0 2\n0 2 3\n1 2 4\n2 2 5.5\n", {"unit": "nm"}),
    "f.npy": (np.where(NUMBERS == 1.0, np.nan, NUMBERS), SIZE),
}


@pytest.mark.parametrize("name", HOLEY)
def test_holes_are_read_where_they_are_asked_for(write, name):
    content, how = HOLEY[name]
    path = write(name, content)
    found = read_height_map(path, **how, holes=True)
    expected = 1e-9 * np.where(NUMBERS == 1.0, np.nan, NUMBERS)
    np.testing.assert_allclose(found.heights, expected, rtol=1e-15)
    # Tabs are blanks where nothing may be missing.
    with pytest.raises(DescriptionError, match="3 columns" if name == "c.tsv" else "holes="):
        read_height_map(path, **how)


def test_a_comma_at_the_end_of_each_line_is_no_column_of_holes(write):
    with pytest.raises(DescriptionError, match="no line may end in a comma"):
        read_height_map(write("a.csv", "1,2,\n4,5,\n"), **SIZE, holes=True)


def test_a_map_of_nothing_but_holes_is_refused(write):
    with pytest.raises(DescriptionError, match="finite in every pixel"):
        read_height_map(write("a.npy", np.full((3, 3), np.nan)), **SIZE, holes=True)


@pytest.mark.parametrize("kind", ["f4", "f8", "i2", "u1", ">f8"])
def test_an_array(write, kind):
    found = read_height_map(
        write("a.npy", (2.0 * NUMBERS).astype(kind)), pixel_size=1e-6, unit="um"
    )
    np.testing.assert_allclose(found.heights, 2e-6 * NUMBERS, rtol=1e-15)
    assert found.heights.dtype == np.float64
    assert found.pixel_size == (1e-6, 1e-6)


def test_points_in_any_order(write):
    lines = [
        f"{0.1 + 2.0 * j} {-3.0 + 0.333 * i:.3f} {NUMBERS[i, j]}" for j in (2, 0, 1) for i in (1, 0)
    ]
    found = read_height_map(write("a.xyz", "\n".join(lines)), unit="um")
    np.testing.assert_allclose(found.heights, NUMBERS * 1e-6, rtol=1e-14)
    assert found.pixel_size == (pytest.approx(0.333e-6), pytest.approx(2e-6))


def test_the_file_that_is_meant_is_known_by_its_checksum(write):
    path = write("a.csv", TEXTS["a.csv"])
    digest = hashlib.sha256(path.read_bytes()).hexdigest()
    assert checksum(path) == digest
    for given in (digest, digest.upper(), f"sha256:{digest}"):
        assert read_height_map(path, **SIZE, checksum=given).checksum == digest
    path.write_text(TEXTS["a.csv"].replace("5.5", "5.6"))
    with pytest.raises(DescriptionError, match=f"checksum must be that of a.csv, .*got '{digest}'"):
        read_height_map(path, **SIZE, checksum=digest)


# What is refused ----------------------------------------------------------------------------

BAD_TEXTS = {
    "ragged": ("1 2 3\n4 5\n", r"have 3 columns in each line.*a\.txt, line 2\), got '2 columns'"),
    "words": ("x y\n1 2\n", r"numbers \(a\.txt, line 1, column 1\), got 'x'; put # before"),
    "no decimal comma": ("1,5;2,5\n3,x;4\n", r"line 2, column 1\), got '3.x'; put #"),
    "empty cell": ("1,,3\n4,5,6\n", r"line 1, column 2\), got ''; say what the holes are: holes="),
    "last comma": ("1,2,\n4,5,\n", r"line 1, column 3\), got ''; .*no line may end in a comma"),
    "hole": (
        "1 2\nnan 4\n",
        r"finite in every pixel of a\.txt.*got '1 that are not.*\[1, 0\].*cut",
    ),
    "overflow": ("1 2\n3 1e999\n", r"finite in every pixel"),
    "one row": ("1 2 3\n", r"at least 2 x 2 pixels in a\.txt, got 'shape \(1, 3\)'; a profile"),
    "one column": ("1\n2\n3\n", r"at least 2 x 2 pixels.*shape \(3, 1\)"),
    "not measured": ("1 Bad\n3 4\n", r"line 1, column 2\), got 'Bad'; say what the holes are"),
    "nothing": ("", r"path must hold numbers, got .*a\.txt'; it has none"),
    "only comments": ("# 1 2\n# 3 4\n", r"path must hold numbers"),
    "binary": (b"\xff\xfe\x00\x81" * 20, r"path must be a text of numbers"),
    "not UTF-8": (b"# H\xf6he\n1 2\n3 4\n", r"not in UTF-8 from byte 3 on: save it as that"),
}


BAD_ARRAYS = {
    "three dimensions": (np.zeros((2, 2, 2)), r"at least 2 x 2 pixels.*\(2, 2, 2\)"),
    "a number": (np.array(1.0), r"at least 2 x 2 pixels"),
    "infinite": (np.array([[1.0, np.inf], [1.0, 1.0]]), r"first at \[0, 1\]"),
    "complex": (np.ones((3, 3), dtype=complex), r"real numbers, got 'complex128'"),
    "booleans": (np.ones((3, 3), dtype=bool), r"real numbers, got 'bool'"),
    "words": (np.array([["a", "b"], ["c", "d"]]), r"real numbers"),
    "objects": (np.array([[None, 1], [2, 3]]), r"numpy file of numbers.*[Oo]bject arrays"),
    "no array": (b"not a numpy file", r"numpy file of numbers"),
    "cut short": (b"", r"numpy file of numbers"),
}


BAD_POINTS = {
    "hole": ("0 0 1\n1 0 1\n0 1 1\n", r"one for each point of the 2 x 2 grid.*got '0 at \[1, 1\]'"),
    "twice": ("0 0 1\n1 0 1\n0 1 1\n1 1 1\n0 1 2\n", r"one for each point.*got '2 at \[1, 0\]'"),
    "uneven": (
        "0 0 1\n1 0 1\n2.2 0 1\n0 1 1\n1 1 1\n2.2 1 1\n",
        r"HeightMap\.x must have equal steps in a\.xyz, got .*resample",
    ),
    "a line": ("0 0 1\n1 0 1\n2 0 1\n", r"HeightMap\.y must take at least two values"),
    "two columns": ("0 0\n1 0\n", r"points x, y, z in a\.xyz, got '2 columns'"),
    "no place": ("0 nan 1\n1 0 1\n", r"HeightMap\.y must be finite"),
}


BAD_FILES = [
    (f"a{ending}", *bad, how)
    for ending, table, how in (
        (".txt", BAD_TEXTS, SIZE),
        (".npy", BAD_ARRAYS, SIZE),
        (".xyz", BAD_POINTS, {"unit": "nm"}),
    )
    for bad in table.values()
]


@pytest.mark.parametrize(("name", "content", "message", "how"), BAD_FILES)
def test_a_file_that_is_no_map(write, name, content, message, how):
    with pytest.raises(DescriptionError, match=message):
        read_height_map(write(name, content), **how)


@pytest.mark.parametrize("name", ["a.csv", "a.npy"])
@pytest.mark.parametrize(
    ("given", "message"),
    [
        (
            {"unit": "nm"},
            r"HeightMap\.pixel_size must be given: a\.\w+ does not contain it.*for example",
        ),
        ({"pixel_size": 1e-9}, r"HeightMap\.unit must be given.*for example unit='nm'"),
        ({"pixel_size": 0.0, "unit": "nm"}, r"positive, finite lengths \[m\], got 0\.0"),
        ({"pixel_size": (1.0, float("nan")), "unit": "nm"}, r"positive, finite lengths"),
        ({"pixel_size": (1.0, 1.0, 1.0), "unit": "nm"}, r"one or two positive"),
        ({"pixel_size": 1e-9, "unit": "Pa"}, r"unit must be a unit of length, got 'Pa'"),
        ({"pixel_size": 1e-9, "unit": "pixels"}, r"unit must be made of known symbols"),
    ],
)
def test_sizes_and_units_that_are_missing_or_wrong(write, name, given, message):
    path = write(name, TEXTS["a.csv"] if name.endswith("csv") else NUMBERS)
    with pytest.raises(DescriptionError, match=message):
        read_height_map(path, **given)


def test_a_size_that_the_file_says_itself(write):
    path = write("a.xyz", "0 0 1\n1 0 1\n0 1 1\n1 1 1\n")
    with pytest.raises(DescriptionError, match=r"pixel_size must be left out: a\.xyz contains it"):
        read_height_map(path, **SIZE)


@pytest.mark.parametrize("read", [checksum, read_height_map])
def test_a_file_that_is_not_there(tmp_path, read):
    with pytest.raises(DescriptionError, match=r"HeightMap\.path must be a file that exists"):
        read(tmp_path / "none.csv")
    with pytest.raises(DescriptionError, match=r"HeightMap\.path must be a file that exists"):
        read(tmp_path)


def test_files_of_instruments_need_an_extra(write, monkeypatch):
    monkeypatch.setitem(sys.modules, "SurfaceTopography", None)
    with pytest.raises(DescriptionError, match=r"end in \.npy.*pip install contactkit\[maps\]"):
        read_height_map(write("a.sur", b"DIGITAL SURF"))


# A package that reads files of instruments, in a process of its own ------------------------

READERS = {
    "a map": "Reader()",
    "crash": "os.abort()",
    "end": "os._exit(3)",
    "loop": "list(iter(int, 1))",
    "memory": "bytearray(2**46)",
    "deep": "(lambda f: f(f))(lambda f: f(f))",
    "pixels": "Reader(nx=10**6, ny=10**6)",
}
PACKAGE = """
import os
from types import SimpleNamespace
import numpy as np

class Reader:
    def __init__(self, nx=3, ny=2):
        info = dict(dim=2, name="height", unit="m", index=0, is_periodic=None)
        sizes = dict(physical_sizes=(3.0, 2.0), nb_grid_pts=(nx, ny))
        self.default_channel = SimpleNamespace(**info, **sizes)
        self.channels = [self.default_channel]
    def __enter__(self):
        return self
    def __exit__(self, *_):
        pass
    def format(self):
        return "toy"
    def topography(self, channel_index):
        return self
    def to_unit(self, unit):
        return self
    pixel_size = (1.0, 1.0)
    def heights(self):
        return np.ma.masked_invalid(np.arange(6.0).reshape(3, 2))

def open_topography(file):
    print("what a package says")
    return CALL
"""


@pytest.fixture
def package(tmp_path, monkeypatch):
    """Put a package in place of SurfaceTopography that does what a text says."""

    def make(call):
        folder = tmp_path / "packages" / "SurfaceTopography"
        folder.mkdir(parents=True)
        (folder / "__init__.py").write_text(PACKAGE.replace("CALL", call))
        monkeypatch.syspath_prepend(folder.parent)

    return make


@pytest.mark.parametrize(
    ("name", "message"),
    [
        ("crash", r"a format that SurfaceTopography reads.*its reader ended with status"),
        ("end", r"ended with status 3"),
        ("loop", r"be read within 1 s.*CONTACTKIT_MAX_SECONDS=10"),
        ("memory", r"a format that SurfaceTopography reads.*MemoryError"),
        ("deep", r"a format that SurfaceTopography reads.*RecursionError"),
        ("pixels", r"at most 67,108,864 pixels.*has 1,000,000,000,000 pixels"),
    ],
)
def test_a_reader_that_goes_wrong_ends_itself_only(write, package, monkeypatch, name, message):
    package(READERS[name])
    if name == "loop":
        monkeypatch.setenv("CONTACTKIT_MAX_SECONDS", "1")
    with pytest.raises(DescriptionError, match=message):
        read_height_map(write("a.sur", b"DIGITAL SURF"))


def test_a_map_comes_back_from_the_process(write, package):
    package(READERS["a map"])
    found = read_height_map(write("a.sur", b"DIGITAL SURF"))
    assert found.heights.tolist() == [[0.0, 2.0, 4.0], [1.0, 3.0, 5.0]]
    assert found.pixel_size == (1.0, 1.0)
    with pytest.raises(DescriptionError, match=r"unit must be left out: a\.sur contains it"):
        read_height_map(write("a.sur", b"DIGITAL SURF"), unit="nm")


# Files of instruments -----------------------------------------------------------------------


@pytest.fixture
def instruments():
    pytest.importorskip("SurfaceTopography")


@pytest.fixture
def matlab(tmp_path):
    """A file of two maps without sizes and without a unit."""
    path = tmp_path / "a.mat"
    savemat(path, {"first": NUMBERS, "second": 2.0 * NUMBERS})
    return path


@pytest.mark.usefixtures("instruments")
@pytest.mark.parametrize(
    ("channel", "factor", "source"),
    [(None, 1.0, "a.mat, first"), (0, 1.0, "a.mat, first"), (1, 2.0, "a.mat, second")],
)
def test_a_file_of_several_maps_that_says_nothing(matlab, channel, factor, source):
    found = read_height_map(matlab, **SIZE, channel=channel)
    assert found.heights.shape in ((2, 3), (3, 2))  # no axis has a name in such a file
    np.testing.assert_allclose(np.sort(found.heights, None), factor * 1e-9 * np.sort(NUMBERS, None))
    assert found.pixel_size == (2e-9, 1e-9)
    assert found.source == source


@pytest.mark.usefixtures("instruments")
@pytest.mark.parametrize(
    ("given", "message"),
    [
        ({"unit": "nm"}, r"pixel_size must be given: a\.mat does not contain it"),
        ({"pixel_size": 1e-9}, r"unit must be given: a\.mat does not contain it"),
        ({**SIZE, "channel": 2}, r"channel must be one of 0: first, 1: second, got 2"),
        ({**SIZE, "channel": -1}, r"channel must be one of 0: first"),
    ],
)
def test_what_a_file_of_an_instrument_does_not_say(matlab, given, message):
    with pytest.raises(DescriptionError, match=message):
        read_height_map(matlab, **given)


@pytest.mark.usefixtures("instruments")
@pytest.mark.parametrize(
    ("content", "given", "message"),
    [
        (b"\x07 no format at al", SIZE, r"in a format that SurfaceTopography reads"),
        (
            b"\x07 no format at all",
            SIZE,
            r"format that says what it is, got .*'hgt'.* by its length",
        ),
    ],
)
def test_a_file_of_an_instrument_that_is_no_map(write, content, given, message):
    with pytest.raises(DescriptionError, match=message):
        read_height_map(write("a.sdf", content), **given)
