"""Maps of solved contacts that a page shows, and the areas it outlines."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING

import numpy as np
from attrs import frozen

from ...contact.slip.states import Zone

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from ...contact.result import ContactResult
    from ...export.contents import Quantity
    from .images import Kept

    Map = NDArray[np.float64]
    Mask = NDArray[np.bool_]

__all__ = ["Outline", "ShownMap", "outlines", "shown_maps"]

_LEFT_OUT = ("displacement",)  # gap, heights and approach together
_ALWAYS = ("pressure", "gap")
_LABELS = {"contact": "in contact", "plastic": "plastic", "meniscus": "menisci"}
_ZONES = "slip_zone"
HOLES = "holes"
"""Outline of the pixels that were masked; they are grey in every map."""


@frozen(eq=False)
class ShownMap:
    """A map under each load (ny, nx), and what a cell of it keeps of its pixels."""

    name: str
    label: str
    unit: str
    kept: Kept
    values: tuple[Map, ...]


@frozen(eq=False)
class Outline:
    """Pixels under each load whose edge a page draws (ny, nx)."""

    name: str
    label: str
    values: tuple[Mask, ...]


def shown_maps(results: Sequence[ContactResult]) -> list[ShownMap]:
    """Maps of results, and of their effects where they are not the same everywhere."""
    contents = [result.contents().quantities for result in results]
    found = []
    for name, one in contents[0].items():
        is_number = _is_map(one) and np.asarray(one.values).dtype.kind == "f"
        if not is_number or name in _LEFT_OUT:
            continue
        stack = [_last(quantities[name]) for quantities in contents if name in quantities]
        if len(stack) < len(results):
            continue
        kept: Kept = "smallest" if name == "gap" else "largest"
        if name != "heights" and any(np.nanmin(values, initial=0.0) < 0.0 for values in stack):
            kept = "greatest size"
        if name in _ALWAYS or any(np.nanmin(values) < np.nanmax(values) for values in stack):
            found.append(ShownMap(name, one.label or name, one.unit, kept, tuple(stack)))
    return found


def _is_map(one: Quantity) -> bool:
    return one.axes[-2:] == ("y", "x") and len(one.axes) <= 3


def _last(one: Quantity) -> Map:
    """A map, or the last one along a path of loads."""
    values = np.asarray(one.values)
    return np.asarray(values[(-1,) * (values.ndim - 2)], dtype=float)


def outlines(results: Sequence[ContactResult]) -> list[Outline]:
    """Areas of results and of their effects: contact, then what is plastic, wet, or sticks."""
    contents = [result.contents().quantities for result in results]
    found = []
    for name, one in contents[0].items():
        if _is_map(one) and np.asarray(one.values).dtype.kind == "b":
            label = _LABELS.get(name, one.label or name)
            found.append(Outline(name, label, _masks(contents, name, 1.0)))
        elif name == _ZONES:
            found.append(Outline("stick", "sticks", _masks(contents, name, float(Zone.STICK))))
    gaps = tuple(np.isnan(_last(quantities["gap"])) for quantities in contents)
    if any(holes.any() for holes in gaps):
        found.append(Outline(HOLES, "holes", gaps))
    return found


def _masks(contents: Sequence[Mapping[str, Quantity]], name: str, value: float) -> tuple[Mask, ...]:
    """Where a map has a value, under each load; nowhere under one at which there is none."""
    shape = np.shape(contents[0]["pressure"].values)
    none = np.full(shape, math.nan)
    return tuple(
        (_last(quantities[name]) if name in quantities else none) == value
        for quantities in contents
    )
