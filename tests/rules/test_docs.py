"""The documentation keeps up with the code."""

import importlib.util
import re
import shlex
import sys
from pathlib import Path

import click
import pytest

import contactkit as ck
from contactkit.commands.group import contactkit

# Rules of the house, as lint is: 30 s of `make test`.
pytestmark = pytest.mark.slow

pytest.importorskip("pythonfmu")  # the tables of ports are made from the slaves

ROOT = Path(__file__).parents[2]
DOCS = ROOT / "docs"
SCRIPTS = DOCS / "scripts"
PAGES = [
    *(ROOT / name for name in ("README.md", "CONTRIBUTING.md", "CHANGELOG.md")),
    *sorted(DOCS.rglob("*.md")),
]


def script(name):
    """A script of docs/scripts/, imported as if it were run."""
    spec = importlib.util.spec_from_file_location(f"docs_{name}", SCRIPTS / f"{name}.py")
    module = importlib.util.module_from_spec(spec)
    sys.modules[spec.name] = module
    sys.path.insert(0, str(SCRIPTS))
    spec.loader.exec_module(module)
    sys.path.remove(str(SCRIPTS))
    return module


@pytest.fixture(scope="module")
def tables():
    module = script("tables")
    yield module
    del sys.modules[module.__name__]


def test_tables_are_up_to_date(tables):
    assert tables.stale() == [], "run make pages PAGES=tables"


@pytest.fixture(scope="module")
def pages():
    module = script("pages")
    yield module
    del sys.modules[module.__name__]


def test_every_script_that_writes_is_a_page(pages):
    """Scripts that are run, but for the driver, and parts of the packages among them."""
    runs = {path.name for path in SCRIPTS.glob("*.py") if "__main__" in path.read_text("utf-8")}
    runs |= {path.parent.name for path in SCRIPTS.glob("*/__main__.py")}
    listed = {name for page in pages.PAGES.values() for name in page.scripts}
    assert {name.partition("/")[0] for name in listed} == runs - {"pages.py"}
    assert all((SCRIPTS / name).exists() for name in listed)


def test_a_page_that_there_is_not_is_refused_with_the_list(pages, capsys, monkeypatch):
    monkeypatch.setattr(pages, "write", lambda name: pytest.fail(f"wrote {name}"))
    with pytest.raises(SystemExit) as refused:
        pages.main(["films", "fims"])
    assert refused.value.code == 2
    said = capsys.readouterr().err
    assert "no page fims" in said
    assert all(name in said for name in pages.PAGES)


def test_pages_are_written_and_one_that_fails_is_reported(pages, capsys, monkeypatch):
    wrote = []
    monkeypatch.setattr(pages, "write", lambda name: wrote.append(name) or name != "films")
    assert pages.main(["films", "gradients"]) == 1
    assert wrote == ["films", "gradients"]
    assert "failed: films" in capsys.readouterr().err
    assert pages.main(["gradients"]) == 0


def test_every_measured_block_has_a_script_that_writes_it():
    """By its name, which is the key of a table, perhaps behind a prefix."""
    texts = [path.read_text("utf-8") for path in SCRIPTS.rglob("*.py")]
    for page in DOCS.rglob("*.md"):
        for name in re.findall(r"<!-- measured: (.*?) -->", page.read_text("utf-8")):
            keys = [name, *(name[end:] for end in (m.end() for m in re.finditer("[ -]", name)))]
            assert any(f'"{key}"' in text for key in keys for text in texts), name


def test_every_table_is_shown(tables):
    shown = {
        name for page in DOCS.rglob("*.md") for _, name, *_ in tables.MARK.findall(page.read_text())
    }
    assert shown == set(tables.TABLES)


def test_every_measured_block_is_there_once_and_filled():
    """What it says is not checked: seconds differ between machines."""
    pattern = r"<!-- measured: ([\w, -]+) -->\n(.*?)<!-- end of measured -->"
    pages = [page.read_text() for page in DOCS.rglob("*.md")]
    found = [block for page in pages for block in re.findall(pattern, page, re.S)]
    names = [name for name, _ in found]
    assert len(names) == len(set(names)) == sum(page.count("<!-- measured:") for page in pages)
    assert {f"bridges {name}" for name in script("measure_bridges").TABLES} <= set(names)
    assert [name for name, body in found if not body.strip()] == []


def test_every_effect_is_documented():
    pages = (DOCS / "physics.md", *DOCS.glob("physics/*.md"))
    physics = "".join(page.read_text("utf-8") for page in pages)
    usage = "".join(page.read_text("utf-8") for page in DOCS.glob("reference/*.md"))
    prose = re.sub(r"<!-- table.*?end of table -->", "", physics, flags=re.S)
    wanted = {
        kind.__name__: [
            *(word for word in (f"`{kind.name}`", f"`{kind.__name__}`") if word not in prose),
            *(word for word in (f'`effect = "{kind.name}"`',) if word not in usage),
        ]
        for kind in ck.EFFECTS
    }
    assert {name: words for name, words in wanted.items() if words} == {}


def commands():
    """Each command of contactkit that README shows, in a block or between backticks."""
    return re.findall(
        r"(?:\.venv/bin/)(contactkit [^`\n]*)", (ROOT / "README.md").read_text("utf-8")
    )


def parsed(words):
    """Context of a command line, read and not run."""
    command, context = contactkit, None
    while isinstance(command, click.Group):
        context = click.Context(command, context)
        name, command, words = command.resolve_command(context, words)
    return command.make_context(name, words, context)


def test_the_commands_of_the_readme_are_those_there_are():
    """Each is understood (the parser stops the run at one that is not), and none is left out."""
    for line in commands():
        words = shlex.split(line.partition(" > ")[0], comments=True)
        assert isinstance(parsed(words[1:]), click.Context), line
    for name in ("run", "plan", "new", "check", "cost", "gallery", "fmu build"):
        assert any(line.startswith(f"contactkit {name}") for line in commands()), name


def test_every_target_of_make_that_is_named_exists():
    makefile = (ROOT / "Makefile").read_text("utf-8")
    targets = set(re.findall(r"^([a-z-]+):", makefile, re.M))
    named = {name for page in PAGES for name in re.findall(r"`make ([a-z-]+)`", page.read_text())}
    assert named <= targets
    assert {"demo", "test"} <= named


def test_links_lead_somewhere():
    dead = [
        f"{page.name}: {link}"
        for page in PAGES
        for link in re.findall(
            r"\]\(([^)#\s]+)", re.sub(r"```.*?```", "", page.read_text("utf-8"), flags=re.S)
        )
        if not link.startswith("https://") and not (page.parent / link).exists()
    ]
    assert dead == []


def test_files_that_are_named_exist():
    pattern = r"\b(?:tests|contactkit|fmu|models|docs)/[\w/.-]+\.(?:py|c|toml|md)\b"
    named = {
        path
        for page in PAGES
        for path in re.findall(pattern, page.read_text("utf-8"))
        if page.name != "CONTRIBUTING.md"  # where files of an example are not there
    }
    assert sorted(path for path in named if not (ROOT / path).exists()) == []


def test_no_path_of_a_machine():
    pattern = r"/(work|tmp|root|home)/"
    assert [page.name for page in PAGES if re.search(pattern, page.read_text("utf-8"))] == []


def test_pictures_are_small():
    assert [path.name for path in DOCS.glob("img/*.png") if path.stat().st_size >= 200_000] == []
