"""What README, CONTRIBUTING and docs show is run as written."""

import re
import textwrap
import warnings
from pathlib import Path

import pytest

import contactkit as ck
from contactkit.app.scenes import open_scene

ROOT = Path(__file__).parents[2]
PAGES = [
    *(ROOT / name for name in ("README.md", "CONTRIBUTING.md")),
    *sorted((ROOT / "docs").rglob("*.md")),
]


def blocks(page, language):
    found = re.findall(
        rf"^( *)```{language}\n(.*?)^\1```", page.read_text("utf-8"), re.MULTILINE | re.DOTALL
    )
    return [textwrap.dedent(body) for _, body in found]


SLOW = (
    "adhesion",
    "hosts",
    "films",
    "film-solver",
    "menisci",
    "studies",
    "figures",
    "fit",
    "many-maps",
    "gradients",
    "separation",
    "contact",
    "results",
    "surfaces",
    "wetting",
)


def with_blocks(language):
    """Pages with blocks of a language; those about FMUs take long, three pages longest."""

    def marks(page):
        if page.stem in ("adhesion", "head-disk-detail", "fmu-native"):
            return [pytest.mark.exhaustive]
        return [pytest.mark.slow] if "fmu" in page.name or page.stem in SLOW else []

    return [
        pytest.param(p, id=p.relative_to(ROOT).as_posix(), marks=marks(p))
        for p in PAGES
        if p.parent.name != "tutorials"  # run from their sources, test_tutorials.py
        if blocks(p, language)
    ]


@pytest.fixture
def elsewhere(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    return tmp_path


@pytest.mark.parametrize("page", with_blocks("python"))
def test_python_runs(page, elsewhere, capsys, request):
    if "fmu" in page.name:
        pytest.importorskip("fmpy")
        request.getfixturevalue("kernels_compiled_once")
    if page.stem == "many-maps":
        pytest.importorskip("torch")
    names = {"__name__": page.stem}
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", ck.ValidityWarning)  # the pages say that they come
        for number, block in enumerate(blocks(page, "python"), start=1):
            exec(compile(block, f"{page.name}, block {number}", "exec"), names)


def test_the_readme_shows_what_its_example_prints(elsewhere, capsys):
    block, _ = blocks(ROOT / "README.md", "python")
    assert len([line for line in block.splitlines() if line.strip()]) <= 10
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        exec(block, {})
    assert {w.category for w in caught} == {ck.ValidityWarning}
    assert len(caught) == 2  # "two models are outside their range"
    assert any("fingers" in str(w.message) for w in caught)
    shown = re.search(r"`(released after [^`]*)`", (ROOT / "README.md").read_text("utf-8"))[1]
    assert shown in capsys.readouterr().out


def test_the_readme_shows_what_pressing_a_map_prints(elsewhere, capsys):
    _, block = blocks(ROOT / "README.md", "python")
    assert len([line for line in block.splitlines() if line.strip()]) <= 8
    exec(block, {})
    shown = re.search(r"`(converged: [^`]*)`", (ROOT / "README.md").read_text("utf-8"))[1]
    status, _, numbers = shown.partition(" ... ")
    printed = capsys.readouterr().out
    assert printed.startswith(status)
    assert printed.endswith(f"{numbers}\n")


def test_getting_started_shows_what_its_example_prints(elsewhere, capsys):
    page = ROOT / "docs" / "getting-started.md"
    (block,) = blocks(page, "python")
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        exec(block, {})
    assert ["continuum" in str(w.message) for w in caught] == [True]
    shown = re.search(r"It prints `([^`]*)`", page.read_text("utf-8"))[1]
    assert capsys.readouterr().out == f"{shown}\n"


@pytest.mark.parametrize("page", with_blocks("toml"))
def test_scenes_load(page, elsewhere):
    for block in blocks(page, "toml"):
        path = elsewhere / "scene.toml"
        path.write_text(block, encoding="utf-8")
        if "[accuracy]" in block:  # a table of the command line, as those of a device
            assert "on " in open_scene(str(path)).plan_text()
        else:
            assert ck.plan(ck.load_scene(path)).scene.effects


def test_the_scene_of_the_readme_has_six_lines():
    (block,) = blocks(ROOT / "README.md", "toml")
    assert len(block.splitlines()) == 6
