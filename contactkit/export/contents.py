"""Quantities of a result over named axes, with units and labels."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, NamedTuple

if TYPE_CHECKING:
    from numpy.typing import ArrayLike

__all__ = ["Contents", "Quantity"]


class Quantity(NamedTuple):
    """A number or an array over named axes, with its unit and what it is."""

    axes: tuple[str, ...]
    values: ArrayLike
    unit: str
    label: str = ""


class Contents(NamedTuple):
    """Quantities of a result over axes, and remarks as text.

    A quantity with the name of its only axis is the coordinate of that axis. `rows` are the axes
    of the main table: a row for each of their points.
    """

    rows: tuple[str, ...]
    quantities: Mapping[str, Quantity]
    remarks: Mapping[str, str]
