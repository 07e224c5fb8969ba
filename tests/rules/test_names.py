"""What docstrings, comments and pages name is there: modules, their members, and files."""

from __future__ import annotations

import ast
import io
import re
import subprocess
import tokenize
from functools import cache
from pathlib import Path

import pytest

from contactkit.kinds import KINDS

# Rules of the house, as lint is: 2 s of `make test`.
pytestmark = pytest.mark.slow

ROOT = Path(__file__).parents[2]
DOTTED = re.compile(r"(?<![\w./@-])contactkit(?:\.[A-Za-z_]\w*)+(?!\.?\w)")
PATH = re.compile(r"(?<![\w./<>:*{}-])(?:[a-z_0-9]+/)+[a-z_0-9]+\.(?:py|c|h|toml)\b")
PACKAGES = {
    "contactkit/": "contactkit",
    "fmu/": "contactkit.fmu",
    "models/": "contactkit.models",
    "examples/gallery/": "contactkit.gallery",
}
# Groups of entry points.
GROUPS = {one.group.rpartition(".")[2] for one in KINDS._registries() if one.group}
NO_MODULE = re.compile(
    r"contactkit\.(json|toml"  # files of a user
    r"|tips|pull"  # kinds of terminals of an FMU
    rf"|{'|'.join(sorted(GROUPS))})$"
)


@cache
def tracked():
    """Files that belong to the project, by their paths with forward slashes."""
    done = subprocess.run(["git", "ls-files"], cwd=ROOT, capture_output=True, text=True, check=True)
    return tuple(done.stdout.split())


def described(path, text):
    """Docstrings and comments of a source, or the whole text of a page."""
    if path.endswith(".md"):
        return text
    if path.endswith((".c", ".h")):
        return "\n".join(re.findall(r"/\*.*?\*/", text, re.DOTALL))
    owners = ast.Module | ast.ClassDef | ast.FunctionDef | ast.AsyncFunctionDef
    docs = [ast.get_docstring(n) or "" for n in ast.walk(ast.parse(text)) if isinstance(n, owners)]
    tokens = tokenize.generate_tokens(io.StringIO(text).readline)
    return "\n".join([*docs, *(one.string for one in tokens if one.type == tokenize.COMMENT)])


def wrong(stale, *endings, but=()):
    """What is stale in docstrings and comments, by file; code is looked at only if it has any."""
    found = {}
    for path in tracked():
        if path.endswith(endings) and path not in but:
            text = (ROOT / path).read_text("utf-8")
            names = stale(described(path, text)) if stale(text) else []
            found |= {path: names} if names else {}
    return found


@cache
def known():
    """Paths of all files, each between a slash and the end of a line."""
    return "".join(f"/{path}\n" for path in tracked())


@cache
def modules():
    """Files of the modules, by their full names."""
    found = {}
    for path in tracked():
        for folder, package in PACKAGES.items():
            if path.endswith(".py") and path.startswith(folder):
                inside = path[len(folder) :].removesuffix(".py").removesuffix("__init__")
                found[f"{package}/{inside}".strip("/").replace("/", ".")] = ROOT / path
    return found


@cache
def exists(name):
    """Whether a dotted name is a module, or its source has the member; nothing is imported."""
    owner, members = name, []
    while owner not in modules():
        owner, _, last = owner.rpartition(".")
        members.append(last)
    text = modules()[owner].read_text("utf-8") if members else ""
    defined = (
        r"(?m)(^\s*(async )?(def|class) {0}\b|^\s*{0}\s*[:=]|[\"']{0}[\"']|\bas {0}\b|^    {0},$)"
    )
    return all(re.search(defined.format(member), text) for member in members)


def stale_names(text):
    return sorted(n for n in set(DOTTED.findall(text)) if not (NO_MODULE.match(n) or exists(n)))


def stale_paths(text):
    """Paths of files in a text that end no path of the project."""
    return sorted(p for p in set(PATH.findall(text)) if f"/{p}\n" not in known())


@pytest.mark.parametrize("endings", [(".py",), (".md",), (".c", ".h")], ids=str)
def test_names_in_docstrings_comments_and_pages_exist(endings):
    assert wrong(stale_names, *endings, but=("CHANGELOG.md",)) == {}


@pytest.mark.parametrize("endings", [(".py",), (".c", ".h")], ids=str)
def test_files_that_docstrings_and_comments_name_exist(endings):
    assert wrong(stale_paths, *endings) == {}


def test_what_is_gone_is_found():
    text = "as `contactkit.motion.advance`, see contactkit/models/valve.py and fmu/ports.py"
    assert stale_names(text) == ["contactkit.motion.advance"]
    assert stale_paths(text) == ["contactkit/models/valve.py", "fmu/ports.py"]
    text = "`contactkit.separation.motion.advance.advance` of contactkit/separation/plan.py"
    assert (stale_names(text), stale_paths(text)) == ([], [])
