"""Each tutorial runs from start to end, and page and notebook in docs/tutorials/ are its own."""

import importlib.util
import json
import re
import sys
from pathlib import Path

import matplotlib.pyplot as plt
import pytest
from selection import quick

ROOT = Path(__file__).parents[2]
SHOWN = ROOT / "docs" / "tutorials"
FAST = ("humid-sphere", "own-effect")
LONG = ("fit-a-curve",)  # ten seconds
MAKE = "run python docs/scripts/tutorials"
NUMBER = re.compile(r"[-+]?\d+\.?\d*(?:e[-+]?\d+)?")
PRINTED = re.compile(r"^```text\n(.*?)^```", re.MULTILINE | re.DOTALL)


def load_script():
    path = ROOT / "docs" / "scripts" / "tutorials" / "__main__.py"
    spec = importlib.util.spec_from_file_location("docs_tutorials", path)
    module = importlib.util.module_from_spec(spec)
    sys.modules[spec.name] = module  # dataclasses look themselves up
    spec.loader.exec_module(module)
    return module


tutorials = load_script()
NAMES = tutorials.names()


def last_place(number):
    """One unit of the last digit of a printed number; 0 for an integer."""
    mantissa, _, exponent = number.partition("e")
    _, point, decimals = mantissa.partition(".")
    if not point and not exponent:
        return 0.0
    return 10.0 ** (int(exponent or 0) - len(decimals))


def assert_same_output(found, shown):
    """The same words, and the same numbers up to one unit of their last digit."""
    assert NUMBER.sub("#", found).split() == NUMBER.sub("#", shown).split(), MAKE
    for one, other in zip(NUMBER.findall(found), NUMBER.findall(shown), strict=True):
        allowed = 1.001 * max(last_place(one), last_place(other))
        assert abs(float(one) - float(other)) <= allowed, f"{one}, shown as {other}: {MAKE}"


def assert_same_page(found, shown):
    """The same text and code, and the same output."""
    assert PRINTED.sub("", found) == PRINTED.sub("", shown), MAKE
    for one, other in zip(PRINTED.findall(found), PRINTED.findall(shown), strict=True):
        assert_same_output(one, other)


@pytest.mark.parametrize(
    "name",
    quick(
        NAMES,
        *map(NAMES.index, FAST),
        long=[i for i, name in enumerate(NAMES) if name not in LONG],
    ),
)
def test_the_page_shows_what_the_tutorial_prints(name, monkeypatch):
    if "fmu" in name:
        pytest.importorskip("pythonfmu")
        pytest.importorskip("fmpy")
    monkeypatch.setattr(plt, "show", None)  # the script puts its own in place
    found = tutorials.run(name)
    assert sum(len(cell.figures) for cell in found) in (1, 2, 3)
    assert_same_page(tutorials.page(name, found), (SHOWN / f"{name}.md").read_text("utf-8"))


@pytest.mark.parametrize("name", NAMES)
def test_page_and_notebook_have_the_cells_of_the_source(name):
    page = (SHOWN / f"{name}.md").read_text("utf-8")
    notebook = json.loads((SHOWN / f"{name}.ipynb").read_text("utf-8"))
    source = tutorials.cells(name)
    kinds = {True: "code", False: "markdown"}
    cells = [(kinds[cell.is_code], cell.source) for cell in source]
    assert [(c["cell_type"], "".join(c["source"])) for c in notebook["cells"]] == cells, MAKE
    shown = PRINTED.sub("", page)
    at = -1
    for cell in source:
        text = f"```python\n{cell.source}\n```" if cell.is_code else cell.source
        assert shown.find(text, at + 1) > at, MAKE
        at = shown.find(text, at + 1)


@pytest.mark.parametrize("name", NAMES)
def test_figures_are_there_and_small(name):
    page = (SHOWN / f"{name}.md").read_text("utf-8")
    shown = re.findall(r"!\[.+\]\((.+\.png)\)", page)
    assert shown == sorted(path.name for path in SHOWN.glob(f"{name}-*.png"))
    assert all(0 < (SHOWN / picture).stat().st_size < 100_000 for picture in shown)


def test_the_index_links_every_tutorial_and_nothing_is_left_over():
    index = (SHOWN / "index.md").read_text("utf-8")
    assert sorted(re.findall(r"\(([\w-]+)\.md\)", index)) == NAMES
    assert {path.stem for path in SHOWN.glob("*.md")} == {*NAMES, "index"}
    assert {path.stem for path in SHOWN.glob("*.ipynb")} == {*NAMES}


@pytest.mark.parametrize(
    ("found", "shown"),
    [("1.02 nN", "1.04 nN"), ("3 spots", "4 spots"), ("2e-3 m", "4e-3 m"), ("1.0 nN", "1.0 mN")],
)
def test_another_output_would_be_seen(found, shown):
    with pytest.raises(AssertionError):
        assert_same_output(found, shown)


def test_the_last_digit_may_differ():
    assert_same_output("1.020 nN at  -2.5e-07 m", "1.021 nN at -2.4e-07 m")


def test_a_warning_fails_a_tutorial(monkeypatch):
    cell = tutorials.Cell("import warnings; warnings.warn('out of range')", is_code=True)
    monkeypatch.setattr(tutorials, "cells", lambda name: [cell])
    with pytest.raises(UserWarning, match="out of range"):
        tutorials.run("any")
