"""Sizes and units of a height map, which its file states or the caller: one of them, once."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from ..errors import DescriptionError
from ..units import parse_unit

__all__ = ["LineScanError", "given_twice", "length_unit", "needed"]


class LineScanError(DescriptionError):
    """A file holds a profile along a line where a map is wanted."""


def needed(value: Any, field: str, example: str, file: Path) -> Any:
    """Value of a field that a file does not state.

    Raises
    ------
    DescriptionError
        If it is None.
    """
    if value is None:
        raise DescriptionError(
            f"HeightMap.{field}",
            None,
            f"be given: {file.name} does not contain it",
            hint=f"for example {field}={example}",
        )
    return value


def length_unit(unit: str | None, file: Path) -> float:
    """Length of a unit [m] that a file does not state.

    Raises
    ------
    DescriptionError
        If it is not given, or no unit of length.

    Examples
    --------
    >>> length_unit("nm", Path("map.npy"))
    1e-09
    """
    found = parse_unit(needed(unit, "unit", "'nm'", file))
    if dict(found.dimension) != {"m": 1}:
        raise DescriptionError("HeightMap.unit", unit, "be a unit of length", hint="such as 'nm'")
    return found.factor


def given_twice(field: str, value: object, file: Path) -> DescriptionError:
    """Refusal of a value that a file states itself."""
    return DescriptionError(f"HeightMap.{field}", value, f"be left out: {file.name} contains it")
