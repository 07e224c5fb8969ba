"""Tables of the contact pages: surfaces, materials, assumptions of the head-disk scene."""

from __future__ import annotations

from collections.abc import Iterable
from pathlib import Path

from validation_tables import grid

import contactkit as ck
from contactkit.files.structure import library_names
from contactkit.kinds import SURFACES
from contactkit.models.library import bundled_scene
from contactkit.plot.axis_units import in_prose
from contactkit.units import quantity_text

ONLY_IN_PYTHON = {"heights"}
FACES = {"flat", "sphere"}  # described with the separation scenes


def surface_kinds() -> list[tuple[str, type]]:
    """Shapes that a file may name, except those of separation scenes."""
    without = FACES | ONLY_IN_PYTHON
    return [(name, kind) for name, kind in SURFACES.by_name.items() if name not in without]


def _comments(path: Path) -> Iterable[tuple[str, str]]:
    """(code, comment) of each line of a file of this package."""
    for line in path.read_text("utf-8").splitlines():
        code, _, comment = line.partition("#")
        yield code.strip().rstrip(","), comment.strip()


def material_table() -> str:
    """Materials of the library, with their sources."""
    rows = []
    for name in library_names("materials.toml"):
        one = ck.load_material(name)
        hardness = quantity_text(one.hardness, "Pa") if one.hardness else "-"
        modulus = quantity_text(one.young_modulus, "Pa")
        elastic = f"{modulus}, {one.poisson_ratio:g}"
        rows.append((f"`{name}`", elastic, hardness, in_prose(one.source)))
    return grid(("material", "modulus, ratio", "hardness", "source"), rows)


def head_disk_table() -> str:
    """Numbers of the head-disk scene with the reasons its file gives for them."""
    rows: list[list[str]] = []
    section, is_open = "", False
    for code, comment in _comments(bundled_scene("head-disk")):
        if code.startswith("["):
            section, is_open = code.strip("[]"), False
        elif code.startswith("effect ="):
            section, is_open = code.partition("=")[2].strip(' "'), False
        elif code and comment and section:
            rows.append([*_entry(section, code), comment])
            is_open = True
        elif not code and comment and is_open:
            rows[-1][2] += f" {comment}"
        else:
            is_open = False
    return in_prose(grid(("key", "value", "where it comes from"), rows))


def _entry(section: str, code: str) -> tuple[str, str]:
    """Key and value of a line; a layer is named by its material."""
    if code.startswith("{"):
        parts = dict(item.split(" = ") for item in code.strip("{} ").split(", "))
        material = parts["material"].strip('"')
        return f"`{section}`, thickness of `{material}`", parts["thickness"].strip('"')
    key, _, value = (part.strip() for part in code.partition("="))
    return f"`{section}.{key}`", value.strip('"')
