"""Modules of each room in the reading order of its ``__init__``, for the page of the API."""

from __future__ import annotations

import re
from pathlib import Path

ROOT = Path(__file__).parents[2]
ROOMS = (
    *(
        "scene",
        "contact",
        "separation",
        "shortcuts",
        "analyses",
        "studies",
        "files",
        "plot",
        "liquids",
    ),
    *("elasticity", "capillary", "lubrication", "adhesion", "roughness", "as_published"),
    *("numerics", "reference"),
)


def contents(folder: Path) -> tuple[str, list[str]]:
    """Summary of a room, and the names its docstring lists."""
    source = (folder / "__init__.py").read_text("utf-8")
    text = source.split('"""')[1]
    return text.partition("\n")[0], re.findall(r"^(\w+)  ", text, re.MULTILINE)


def modules(folder: Path) -> list[Path]:
    """Public modules below a folder: listed ones first, in their order."""
    listed = contents(folder)[1]
    here = [
        path
        for path in folder.iterdir()
        if not path.name.startswith(("_", ".")) and (path.is_dir() or path.suffix == ".py")
    ]
    here.sort(key=lambda path: (listed.index(path.stem) if path.stem in listed else 99, path.stem))
    return [
        module
        for path in here
        for module in (modules(path) if path.is_dir() else [path])
        if path.is_file() or (path / "__init__.py").exists()
    ]


def api_table() -> str:
    """A section for each room, with a line of mkdocstrings for each of its modules."""
    sections = []
    for room in ROOMS:
        folder = ROOT / "contactkit" / room
        names = [".".join(path.relative_to(ROOT).with_suffix("").parts) for path in modules(folder)]
        lines = "\n".join(f"::: {name}" for name in names)
        sections.append(f"## {room}\n\n{contents(folder)[0]}\n\n{lines}")
    return "\n\n".join(sections)
