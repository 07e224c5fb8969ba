"""Lists for the command line: scenes, liquids, materials and effects by their names."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence

from ..errors import DescriptionError, nearest
from ..export.lines import aligned
from ..files.structure import library_names, load_liquid, load_material
from ..kinds import CONTACT_EFFECTS, SEPARATION_EFFECTS, SLIDING_EFFECTS
from ..models.library import bundled_scenes
from ..units import quantity_text
from .scenes import open_scene

__all__ = ["LISTS", "listing"]

Rows = Sequence[tuple[str, ...]]

_ROOM = 293.15  # temperature that liquids are listed at


def listing(what: str) -> str:
    """Return a list as a table of text.

    Raises
    ------
    DescriptionError
        If there is no such list.

    Examples
    --------
    >>> print(listing("materials").splitlines()[1])
    dlc                 140 GPa          0.25             15 GPa    diamond-like carbon
    """
    if what not in LISTS:
        raise DescriptionError("list", what, "be a known list", hint=nearest(what, LISTS))
    head, rows = LISTS[what]
    return "\n".join(aligned([head, *rows()]))


def _scenes() -> Rows:
    return [(name, open_scene(name).name) for name in bundled_scenes()]


def _liquids() -> Rows:
    rows = []
    for name in library_names("liquids.toml"):
        liquid = load_liquid(name)
        at = liquid.at(_ROOM)
        numbers = (at.viscosity, "Pa.s"), (at.surface_tension, "N/m"), (at.density, "kg/m3")
        rows.append((name, *(_number(*one) for one in numbers), liquid.name))
    return rows


def _number(value: float | None, unit: str) -> str:
    return "-" if value is None or math.isnan(value) else quantity_text(value, unit)


def _materials() -> Rows:
    rows = []
    for name in library_names("materials.toml"):
        one = load_material(name)
        modulus, hardness = (_number(x, "Pa") for x in (one.young_modulus, one.hardness))
        rows.append((name, modulus, f"{one.poisson_ratio:g}", hardness, one.name))
    return rows


def _effects() -> Rows:
    kinds = {
        "contact": CONTACT_EFFECTS,
        "separation": SEPARATION_EFFECTS,
        "sliding": SLIDING_EFFECTS,
    }
    return [(one.name, scene, one.summary) for scene, known in kinds.items() for one in known]


LISTS: dict[str, tuple[tuple[str, ...], Callable[[], Rows]]] = {
    "scenes": (("scene", "what"), _scenes),
    "liquids": (
        ("liquid", "viscosity at 20 degC", "surface tension", "density", "what"),
        _liquids,
    ),
    "materials": (
        ("material", "Young's modulus", "Poisson's ratio", "hardness", "what"),
        _materials,
    ),
    "effects": (("effect", "scenes", "what"), _effects),
}
"""Head and rows of each list, by its name."""
