"""Source files that an FMU carries: the modules its slave imports, and those they import.

Inside contactkit all imports are relative, so copies of the modules work under another package
name. A package's own ``__init__`` is carried only if something is imported from it; otherwise an
empty one takes its place, and with it all that the real one would import stays out of the FMU.

attrs is carried inside that package, and imported from there: whatever attrs the host has, older or
newer or imported already, neither sees the other.
"""

from __future__ import annotations

import ast
import importlib.util
import sys
from collections.abc import Iterator
from functools import cache
from importlib.machinery import ModuleSpec
from pathlib import Path
from typing import NamedTuple

from attrs import field, frozen

from ...errors import ContactkitError

__all__ = ["Closure", "bundled_attrs", "find_closure"]

_ATTRS = frozenset({"attr", "attrs"})
_BUNDLED = "bundled"  # package of an FMU that holds attrs
_EMPTY_INIT = b'"""Part of the code this FMU runs; the original is in contactkit."""\n'


@frozen
class Closure:
    """The files of a vendored package, and what else it imports.

    Attributes
    ----------
    sources : dict
        Content of each file, by its path in the package with forward slashes.
    requires : set of str
        Names of packages that are neither in the FMU nor in Python's standard library.
    """

    sources: dict[str, bytes] = field(factory=dict)
    requires: set[str] = field(factory=set)


def find_closure(*modules: str, at_once: bool = False) -> Closure:
    """Collect modules of contactkit and everything they import, at once or later.

    Parameters
    ----------
    *modules : str
        Their full names.
    at_once : bool
        Leave out what is only imported inside functions, when they are called.

    Raises
    ------
    ContactkitError
        If a module is missing or imports contactkit by its own name.
    """
    root = modules[0].partition(".")[0]
    closure, seen, waiting = Closure(), set[str](), list(modules)
    while waiting:
        name = waiting.pop()
        if name in seen:
            continue
        seen.add(name)
        spec = _find(name)
        if spec is None or spec.origin is None:
            raise ContactkitError(
                f"the FMU needs module {name}, which does not exist; reinstall contactkit"
            )
        path = _path_in_package(name, spec)
        closure.sources[path] = _with_bundled_attrs(path, Path(spec.origin).read_bytes())
        inner, outer = _imports(name, spec, at_once)
        waiting += inner
        closure.requires.update(outer)
    if root in closure.requires:
        raise ContactkitError(
            f"a module that {modules[0]} needs imports {root!r} by name; make the import relative, "
            "so that an FMU can carry it under another name"
        )
    if closure.requires & _ATTRS:
        closure.requires.difference_update(_ATTRS)
        closure.sources.update(bundled_attrs())
    for path in list(closure.sources):
        for folder in list(Path(path).parents):
            closure.sources.setdefault((folder / "__init__.py").as_posix(), _EMPTY_INIT)
    closure.requires.discard("pythonfmu")  # pythonfmu puts itself into every FMU
    return closure


def _find(name: str) -> ModuleSpec | None:
    try:
        return importlib.util.find_spec(name)
    except (ModuleNotFoundError, ValueError):
        return None


def _is_package(spec: ModuleSpec) -> bool:
    return spec.submodule_search_locations is not None


def _path_in_package(name: str, spec: ModuleSpec) -> str:
    parts = name.split(".")[1:]
    return "/".join([*parts, "__init__.py"] if _is_package(spec) else parts) + (
        "" if _is_package(spec) else ".py"
    )


def _imports(name: str, spec: ModuleSpec, at_once: bool) -> tuple[set[str], set[str]]:
    """Modules of the same package, and top-level names of others, that a module imports."""
    inner, outer = set[str](), set[str]()
    package = name if _is_package(spec) else name.rpartition(".")[0]
    source = Path(spec.origin or "").read_bytes()
    for node, is_late in _statements(source):
        if at_once and is_late:
            continue
        if isinstance(node, ast.Import):
            outer.update(alias.name.partition(".")[0] for alias in node.names)
        elif node.level == 0:
            outer.add((node.module or "").partition(".")[0])
        else:
            target = importlib.util.resolve_name("." * node.level + (node.module or ""), package)
            found = _find(target)
            if found is None or not _is_package(found):
                inner.add(target)
                continue
            for alias in node.names:  # either a module in that package, or a name in its __init__
                member = f"{target}.{alias.name}"
                inner.add(member if _find(member) else target)
    return inner, outer - sys.stdlib_module_names


class _Statement(NamedTuple):
    """An import statement, and whether it stands in a function and so runs later."""

    node: ast.Import | ast.ImportFrom
    is_late: bool


@cache
def _statements(source: bytes) -> tuple[_Statement, ...]:
    """Import statements of a source that are not for type checkers only."""
    return tuple(_below(ast.parse(source), is_late=False))


def _below(tree: ast.AST, *, is_late: bool) -> Iterator[_Statement]:
    if isinstance(tree, ast.Import | ast.ImportFrom):
        yield _Statement(tree, is_late)
    is_late = is_late or isinstance(tree, ast.FunctionDef | ast.AsyncFunctionDef)
    children = ast.iter_child_nodes(tree)
    if isinstance(tree, ast.If) and "TYPE_CHECKING" in ast.unparse(tree.test):
        children = iter(tree.orelse)
    for child in children:
        if not isinstance(child, ast.expr):
            yield from _below(child, is_late=is_late)


def bundled_attrs() -> dict[str, bytes]:
    """Sources of attrs as a part of the package of an FMU, by their path in it."""
    files = {}
    for package in sorted(_ATTRS):
        spec = importlib.util.find_spec(package)
        for folder in (spec and spec.submodule_search_locations) or []:
            for path in Path(folder).glob("*.py"):
                place = f"{_BUNDLED}/{package}/{path.name}"
                files[place] = _with_bundled_attrs(place, path.read_bytes())
    return files


def _with_bundled_attrs(path: str, source: bytes) -> bytes:
    """Source of a module at a path in the package, with attrs imported from that package."""
    lines = source.decode().splitlines(keepends=True)
    bundled = "." * (path.count("/") + 1) + _BUNDLED
    for node, _ in _statements(source):
        if isinstance(node, ast.Import) and {a.name for a in node.names} & _ATTRS:
            former, own = "import ", f"from {bundled} import "
        elif isinstance(node, ast.ImportFrom) and _is_of_attrs(node):
            former, own = "from ", f"from {bundled}."
        else:
            continue
        lines[node.lineno - 1] = lines[node.lineno - 1].replace(former, own, 1)
    return "".join(lines).encode()


def _is_of_attrs(node: ast.ImportFrom) -> bool:
    return node.level == 0 and (node.module or "").partition(".")[0] in _ATTRS
