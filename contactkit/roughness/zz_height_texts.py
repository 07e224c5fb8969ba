"""Height maps in plain text: rows of numbers, or points on a grid."""

from __future__ import annotations

from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from ..errors import DescriptionError

__all__ = ["read_matrix", "read_points"]

Array = NDArray[np.float64]

_ROUNDED = 0.02  # share of a step by which coordinates may be off, as rounded in a text


def read_matrix(file: Path) -> Array:
    """Numbers of a text, (lines, columns).

    Raises
    ------
    DescriptionError
        If a line has another number of columns than the first, or holds no numbers.
    """
    delimiter = _delimiter(file)
    try:
        return np.loadtxt(file, delimiter=delimiter, ndmin=2, encoding="utf-8-sig")
    except ValueError as error:
        raise _reason(file, delimiter, str(error)) from error


def read_points(file: Path) -> tuple[Array, tuple[float, float]]:
    """Heights (ny, nx) and pixel size (dy, dx) of a text of points x, y, z, in its own unit.

    Raises
    ------
    DescriptionError
        If there are not three columns, or the points are no full regular grid.
    """
    points = read_matrix(file)
    if points.shape[1] != 3:
        raise DescriptionError(
            "HeightMap.heights", f"{points.shape[1]} columns", f"be points x, y, z in {file.name}"
        )
    x, y, z = points.T
    (column, nx, dx), (row, ny, dy) = _steps(x, "x", file), _steps(y, "y", file)
    times = np.bincount(row * nx + column, minlength=nx * ny)
    if not (times == 1).all():
        i, j = divmod(int(np.argmax(times != 1)), nx)
        raise DescriptionError(
            "HeightMap.heights", f"{int(times[i * nx + j])} at [{i}, {j}]",
            f"be one for each point of the {ny} x {nx} grid of {file.name}",
            hint="fill the holes in the instrument's software, or cut out a part without any",
        )  # fmt: skip
    heights = np.empty((ny, nx))
    heights[row, column] = z
    return heights, (dy, dx)


def _steps(values: Array, name: str, file: Path) -> tuple[NDArray[np.int64], int, float]:
    """Number of the step of each coordinate, how many there are, and the step."""
    if not np.isfinite(values).all():
        raise DescriptionError(f"HeightMap.{name}", "one that is not", "be finite")
    levels = np.unique(values)
    gaps = np.diff(levels)
    n = 1 + int(np.count_nonzero(gaps > 0.5 * gaps.max())) if gaps.size else 1
    if n < 2:
        raise DescriptionError(
            f"HeightMap.{name}", float(levels[0]), f"take at least two values in {file.name}"
        )
    step = float(levels[-1] - levels[0]) / (n - 1)
    place = (values - levels[0]) / step
    number = np.rint(place).astype(np.int64)
    worst = int(np.argmax(np.abs(place - number)))
    if abs(place[worst] - number[worst]) > _ROUNDED:
        raise DescriptionError(
            f"HeightMap.{name}", float(values[worst]), f"have equal steps in {file.name}",
            hint="resample the map onto a regular grid",
        )  # fmt: skip
    return number, n, step


def _data_lines(file: Path) -> list[tuple[int, str]]:
    """Lines that hold data, with their numbers from 1."""
    try:
        text = file.read_text(encoding="utf-8-sig")
    except UnicodeDecodeError as error:
        raise DescriptionError("HeightMap.path", str(file), "be a text of numbers") from error
    lines = ((i, line.split("#")[0].strip()) for i, line in enumerate(text.splitlines(), start=1))
    return [(i, line) for i, line in lines if line]


def _delimiter(file: Path) -> str | None:
    """What splits the columns, from the first line with data; None for spaces and tabs."""
    lines = _data_lines(file)
    if not lines:
        raise DescriptionError("HeightMap.heights", "none", f"be in {file.name}")
    return next((mark for mark in ";," if mark in lines[0][1]), None)


def _reason(file: Path, delimiter: str | None, message: str) -> DescriptionError:
    """Find the line that could not be read."""
    width = 0
    for number, line in _data_lines(file):
        words = [word.strip() for word in line.split(delimiter)]
        place = f"{file.name}, line {number}"
        for column, word in enumerate(words, start=1):
            try:
                float(word)
            except ValueError:
                hint = "write points for decimal commas" if "," in word else (
                    "fill holes first; no line may end in a comma" if not word else
                    "put # before lines that are no data"
                )  # fmt: skip
                return DescriptionError(
                    "HeightMap.heights", word, f"be numbers ({place}, column {column})", hint=hint
                )
        width = width or len(words)
        if len(words) != width:
            return DescriptionError(
                "HeightMap.heights", f"{len(words)} columns",
                f"have {width} columns in each line, as in the first ({place})",
            )  # fmt: skip
    return DescriptionError("HeightMap.heights", message, f"be numbers ({file.name})")
