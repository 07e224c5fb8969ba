"""Finding the scripts of pages, and the code that a computation reaches."""

from __future__ import annotations

import ast
import hashlib
import importlib.util
import re
import sys
from collections.abc import Iterator, Sequence
from pathlib import Path
from types import ModuleType
from typing import Any

from attrs import field, frozen

from ...errors import DescriptionError, nearest
from .page import Page

__all__ = ["Script", "chosen", "digest", "load", "scripts"]

_PACKAGE = "contactkit.gallery"
CHAPTERS = ("chapter_2", "chapter_3", "measured", "deforming", "future_work")
"""Folders of scripts, in reading order."""


@frozen(eq=False)
class Script:
    """Script of a page.

    Attributes
    ----------
    path : Path
        Its file.
    module : module
        The imported script.
    """

    path: Path
    module: ModuleType = field(repr=False)

    @property
    def page(self) -> Page:
        """Head of the page."""
        page: Page = self.module.PAGE
        return page

    @property
    def slug(self) -> str:
        """Name of its files."""
        return self.path.stem.replace("_", "-")

    @property
    def chapter(self) -> str:
        """Folder it stands in."""
        return self.path.parent.name

    @property
    def place(self) -> tuple[Any, ...]:
        """Key of the reading order: chapters, then figures by their number, then the rest."""
        chapter = CHAPTERS.index(self.chapter) if self.chapter in CHAPTERS else len(CHAPTERS)
        numbers = [int(n) for n in re.findall(r"\d+", self.page.name)]
        return chapter, not self.page.name[:1].isdigit(), numbers, self.page.name


def folder() -> Path:
    """Folder of the scripts of contactkit.

    Raises
    ------
    DescriptionError
        If contactkit is installed without them.
    """
    found = importlib.util.find_spec(_PACKAGE)
    if found is None or not found.submodule_search_locations:
        raise DescriptionError(
            _PACKAGE,
            "nothing of that name",
            "be installed",
            hint="install contactkit again: pip install -e . in a checkout",
        )
    return Path(found.submodule_search_locations[0])


def scripts() -> list[Script]:
    """Return all scripts of contactkit, in reading order."""
    files = (path for chapter in CHAPTERS for path in sorted((folder() / chapter).glob("*.py")))
    found = [
        load(path) for path in files if re.search(r"^PAGE = Page\(", path.read_text("utf-8"), re.M)
    ]
    return sorted(found, key=lambda script: script.place)


def load(path: Path) -> Script:
    """Import a script by its file.

    Raises
    ------
    DescriptionError
        If it lacks a part of a page.
    """
    path = path.resolve()
    inside = path.parent.name in CHAPTERS and path.parents[1] == folder().resolve()
    name = f"{_PACKAGE}.{path.parent.name}.{path.stem}" if inside else f"gallery_page_{path.stem}"
    if name in sys.modules:
        return Script(path, sys.modules[name])
    spec = importlib.util.spec_from_file_location(name, path)
    if spec is None or spec.loader is None or not path.is_file():
        raise DescriptionError("page", str(path), "be a Python file")
    module = importlib.util.module_from_spec(spec)
    sys.modules[name] = module
    try:
        spec.loader.exec_module(module)
        missing = [n for n in ("PAGE", "compute", "draw", "check") if not hasattr(module, n)]
        if missing:
            raise DescriptionError("page", str(path), f"define {', '.join(missing)}")
    except BaseException:
        del sys.modules[name]
        raise
    return Script(path, module)


def chosen(names: Sequence[str]) -> list[Script]:
    """Return the scripts of given names: pages, chapters or files; all if none is given.

    Raises
    ------
    DescriptionError
        If there is none of a name.
    """
    files = [load(Path(name)) for name in names if name.endswith(".py")]
    named = [name for name in names if not name.endswith(".py")]
    if files and not named:
        return files
    known = scripts()
    for name in named:
        if not any(name in _names(script) for script in known):
            hint = nearest(name, [script.page.name for script in known])
            raise DescriptionError("NAME", name, "be a page or a chapter", hint=hint)
    found = [s for s in known if not named or set(named) & _names(s)]
    return [*files, *found]


def _names(script: Script) -> set[str]:
    return {script.page.name, script.path.stem, script.slug, script.chapter}


def digest(script: Script, draft: bool) -> str:
    """Key of the data of a page: the code that its ``compute`` reaches, version, kind of sizes.

    What only draws or checks can change without a new computation.
    """
    from ..._version import __version__

    code = "\n".join(sorted(_reached(script.path, "compute", set())))
    text = f"{__version__} {'draft' if draft else 'full'}\n{code}"
    return hashlib.sha256(text.encode()).hexdigest()


def _reached(path: Path, name: str, seen: set[tuple[Path, str]]) -> Iterator[str]:
    """Definitions that a name of a module reaches, in this module and others of the gallery."""
    if (path, name) in seen:
        return
    seen.add((path, name))
    for node in ast.parse(path.read_text("utf-8")).body:
        if isinstance(node, ast.ImportFrom) and (node.module or "").startswith(f"{_PACKAGE}."):
            spec = importlib.util.find_spec(node.module or "")
            for alias in node.names:
                if spec is not None and spec.origin and name == (alias.asname or alias.name):
                    yield from _reached(Path(spec.origin), alias.name, seen)
        elif name in _defined(node):
            yield ast.dump(node)
            used = {one.id for one in ast.walk(node) if isinstance(one, ast.Name)}
            for other in sorted(used):
                yield from _reached(path, other, seen)


def _defined(node: ast.stmt) -> set[str]:
    """Names that a statement of a module defines."""
    if isinstance(node, ast.FunctionDef | ast.ClassDef):
        return {node.name}
    targets: list[ast.expr] = []
    if isinstance(node, ast.Assign):
        targets = node.targets
    elif isinstance(node, ast.AnnAssign):
        targets = [node.target]
    names = (one for target in targets for one in ast.walk(target))
    return {one.id for one in names if isinstance(one, ast.Name)}
