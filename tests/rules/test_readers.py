"""Files are read by few functions, which SECURITY.md lists with what they check."""

from __future__ import annotations

import ast
import re
from pathlib import Path

import pytest
from sources import tree

from contactkit.reading.limits import LIMITS

# Rules of the house, as lint is: 30 s of `make test`.
pytestmark = pytest.mark.slow

ROOT = Path(__file__).parents[2]
SECURITY = (ROOT / "SECURITY.md").read_text(encoding="utf-8")

# What reads or runs what others have written, and the modules that may call it, with the reason.
OUTSIDE = {
    "json.load": (),
    "json.loads": (
        "contactkit/reading/texts.py",
        "contactkit/roughness/instrument_channels.py",  # its own text
        "examples/gallery/measured/cases.py",  # of the package
        "fmu/framework/state.py",
        "fmu/python/integrity.py",  # beside the code that reads it, whose hash it is checked with
        "models/end_stop/solve.py",  # tables of a scene file that was read, as a key
    ),
    "tomllib.load": (),
    "tomllib.loads": (
        "contactkit/files/scenes.py",
        "contactkit/files/structure.py",  # the library
        "contactkit/app/settings.py",  # one value of the command line
    ),
    "np.load": (),
    "numpy.load": (),
    "np.memmap": (),
    "np.fromfile": (),
    "np.genfromtxt": (),
    "np.loadtxt": ("contactkit/roughness/text_maps.py",),
    "pickle.load": (),
    "pickle.loads": ("contactkit/studies/run.py",),  # from the process that started this one
    "zipfile.ZipFile": (
        "contactkit/reading/archives.py",
        "contactkit/roughness/containers.py",  # writes
        "fmu/contents/packing.py",  # writes
        "fmu/python/build.py",  # what it has just made
    ),
    "fromstring": ("contactkit/reading/xml_elements.py",),
    "etree.parse": (),
    "extractall": (),
    "eval": (),
    "exec": (),
    "os.system": (),
}


def calls(path):
    """Names of what a module calls: the last of it, and whose it is."""
    for node in ast.walk(tree(path)):
        if isinstance(node, ast.Call):
            owner = last_name(getattr(node.func, "value", None))
            yield f"{owner}.{last_name(node.func)}"


def last_name(node):
    """What follows the last dot of a name; nothing of other expressions."""
    return getattr(node, "attr", getattr(node, "id", ""))


def callers():
    found = {name: set() for name in OUTSIDE}
    for folder in ("contactkit", "fmu", "models", "examples/gallery"):
        for path in sorted((ROOT / folder).rglob("*.py")):
            for name in set(calls(path)):
                for known in OUTSIDE:
                    if name == known or name.endswith(f".{known}"):
                        found[known].add(path.relative_to(ROOT).as_posix())
    return found


def test_files_are_read_by_these_modules_only():
    others = {name: sorted(found - set(OUTSIDE[name])) for name, found in callers().items()}
    assert not any(others.values()), {name: found for name, found in others.items() if found}


@pytest.mark.parametrize("name", LIMITS)
def test_a_limit_is_stated(name):
    limit = LIMITS[name]
    row = f"| `CONTACTKIT_MAX_{name}` | {limit.text(limit.value)} | {limit.what} |"
    assert row in SECURITY


def test_the_readers_that_are_listed_are_there():
    table = SECURITY.partition("## Readers")[2]
    folders = {"fmu": ROOT / "fmu", "": ROOT / "contactkit"}
    for line in re.findall(r"^\| [^|]+ \| ([^|]+) \|", table, re.MULTILINE)[1:]:
        for name in re.findall(r"`([\w.]+)`", line):
            head, *rest = name.split(".")
            base = folders["fmu"] if head == "fmu" else folders[""] / head
            places = [base.joinpath(*rest[:n]) for n in (len(rest), len(rest) - 1)]
            assert any(one.with_suffix(".py").is_file() for one in places), name
