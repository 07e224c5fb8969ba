"""Height maps as text: rows of numbers or points, below a header that may state size and unit.

Numbers may have decimal commas where the columns are split by something else. Headers are those of
Gwyddion (``# Width: 5 um``, ``# Height: ...``, ``# Value units: m``) and of WSxM (``X Amplitude``,
``Y Amplitude``, ``Z Amplitude``).
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from itertools import islice
from pathlib import Path
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from ..errors import DescriptionError
from ..reading.texts import DECIMAL_COMMA, is_number
from ..units import parse_quantity

__all__ = ["HOLES", "Header", "read_header", "read_matrix", "read_points"]

Array = NDArray[np.float64]
Pair = tuple[float, float]

HOLES = (
    'say what the holes are: holes="masked" (they carry no load) or holes="fill" (each has the '
    "height of the nearest pixel), or cut out a part without any"
)
"""Cure of a map with holes."""

# Grid points for each that is there, above which a list of points is no map but scattered: n points
# with coordinates of their own span n^2, and would be filled into an array of that size before
# holes show.
_SPARSE = 16
# Tolerance of coordinates over the step, for values rounded in a text (three digits of a step). A
# grid whose steps differ by more has to be resampled: slopes would be off by as much.
_ROUNDED = 0.02
_LONGEST_HEADER = 200  # lines; that of Gwyddion has four, that of WSxM some forty

# What headers call the size along y, along x, and the unit of the heights.
_ALONG_Y = ("height", "y amplitude")
_ALONG_X = ("width", "x amplitude")
_UNITS = ("value units",)
_HEIGHTS = ("z amplitude",)  # a length, in the unit of the heights

# What instruments write for a point that was not measured.
_UNMEASURED = re.compile(r"(?<![^\s;,])(?:bad|n/?a|null|none|\*+|-{2,})(?![^\s;,])", re.IGNORECASE)


class Header(NamedTuple):
    """Header of a map: `extent` (along y, along x) [m], `unit` of the heights."""

    extent: Pair | None = None
    unit: str | None = None


class _Layout(NamedTuple):
    """How lines are read: `delimiter` None is blanks; `has_words`: above them, not in comments."""

    delimiter: str | None
    has_decimal_commas: bool
    has_words: bool


def read_header(file: Path) -> Header:
    """Size and unit in the lines above the first number, as far as they are there.

    Raises
    ------
    DescriptionError
        If a size is no length.
    """
    entries: dict[str, str] = {}
    for line in _header_lines(file):
        key, _, value = line.lstrip("# ").partition(":")
        entries[" ".join(key.lower().split())] = value.strip()
    along_y, along_x = (_first(entries, names) for names in (_ALONG_Y, _ALONG_X))
    extent = None
    if along_y and along_x:
        field = f"header of {file.name}"
        extent = (parse_quantity(along_y, "m", field), parse_quantity(along_x, "m", field))
    peak = _first(entries, _HEIGHTS)
    return Header(extent, _first(entries, _UNITS) or (peak.split()[-1] if peak else None))


def _first(entries: dict[str, str], names: tuple[str, ...]) -> str | None:
    return next((entries[name] for name in names if entries.get(name)), None)


def _header_lines(file: Path) -> list[str]:
    """Lines above the numbers: comments, ``key: value``, and whatever stands there in WSxM's."""
    lines: list[str] = []
    with file.open(encoding="utf-8-sig", errors="replace") as text:
        for raw in islice(text, _LONGEST_HEADER):
            line = raw.strip()
            is_words = line[:1].isalpha() and not is_number(line.split()[0].rstrip(",;"))
            is_entry = is_words and (":" in line or (lines or [line])[0].startswith("WSxM"))
            if line and not line.startswith("#") and not is_entry:
                break
            lines.append(line)
    return lines


def read_matrix(file: Path, *, holes: bool = False) -> Array:
    """Numbers of a text file, (lines, columns); with `holes` empty cells are nan.

    Raises
    ------
    DescriptionError
        If a line has another number of columns than the first, or is not numeric.
    """
    layout = _layout(file, tabs=holes)
    is_plain = not (holes or layout.has_decimal_commas or layout.has_words)
    source = file if is_plain else _numbers(file, layout, holes=holes)
    try:
        found = np.loadtxt(source, delimiter=layout.delimiter, ndmin=2, encoding="utf-8-sig")
    except ValueError as error:
        raise _reason(file, layout, str(error), holes=holes) from error
    if holes and found.shape[1] > 1 and np.isnan(found[:, -1]).all():
        raise DescriptionError(
            "HeightMap.heights", "none in the last column", f"end with a number in {file.name}",
            hint="no line may end in a comma",
        )  # fmt: skip
    return found


def _numbers(file: Path, layout: _Layout, *, holes: bool) -> Iterator[str]:
    """Data lines with decimal points, and nan for cells that are empty or marked."""
    for _, data in _data_lines(file):
        line = data.replace(",", ".") if layout.has_decimal_commas else data
        if holes:
            line = _UNMEASURED.sub("nan", line)
            if layout.delimiter:
                cells = (cell.strip() or "nan" for cell in line.split(layout.delimiter))
                line = layout.delimiter.join(cells)
        yield line


def read_points(file: Path, *, holes: bool = False) -> tuple[Array, Pair]:
    """Heights (ny, nx) and pixel size (dy, dx) of a file of points x, y, z, in its own unit.

    With `holes` points that are missing are nan.

    Raises
    ------
    DescriptionError
        If there are not three columns, or the points do not form a complete regular grid.
    """
    points = read_matrix(file)  # each point has its height, or is left out
    if points.shape[1] != 3:
        raise DescriptionError(
            "HeightMap.heights", f"{points.shape[1]} columns", f"be points x, y, z in {file.name}"
        )
    x, y, z = points.T
    (column, nx, dx), (row, ny, dy) = _steps(x, "x", file), _steps(y, "y", file)
    if nx * ny > _SPARSE * len(points):
        raise DescriptionError(
            "HeightMap.heights",
            f"{len(points)} points",
            f"be one for each point of the {ny} x {nx} grid of {file.name}",
            hint="the points are no regular grid: resample them onto one",
        )
    times = np.bincount(row * nx + column, minlength=nx * ny)
    wrong = times > 1 if holes else times != 1
    if wrong.any():
        i, j = divmod(int(np.argmax(wrong)), nx)
        raise DescriptionError(
            "HeightMap.heights",
            f"{int(times[i * nx + j])} at [{i}, {j}]",
            f"be one for each point of the {ny} x {nx} grid of {file.name}",
            hint=HOLES,
        )
    heights = np.full((ny, nx), np.nan)
    heights[row, column] = z
    return heights, (dy, dx)


def _steps(values: Array, name: str, file: Path) -> tuple[NDArray[np.int64], int, float]:
    """Grid index of each coordinate, number of grid lines, and step."""
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
            f"HeightMap.{name}",
            float(values[worst]),
            f"have equal steps in {file.name}",
            hint="columns are x, y, z; resample the map onto a regular grid",
        )
    return number, n, step


def _data_lines(file: Path) -> Iterator[tuple[int, str]]:
    """Data lines with their numbers, from 1, one after the other."""
    above = len(_header_lines(file))
    try:
        with file.open(encoding="utf-8-sig") as text:
            for number, line in islice(enumerate(text, start=1), above, None):
                if data := line.split("#")[0].strip(" \r\n"):
                    yield number, data
    except UnicodeDecodeError as error:
        cure = f"it is not in UTF-8 from byte {error.start} on: save it as that"
        raise DescriptionError(
            "HeightMap.path", str(file), "be a text of numbers", hint=cure
        ) from error


def _layout(file: Path, *, tabs: bool) -> _Layout:
    """Delimiter and decimal sign, from the first data line; `tabs`: between them is a cell."""
    _, first = next(_data_lines(file), (0, ""))
    if not first.strip():
        raise DescriptionError("HeightMap.path", str(file), "hold numbers", hint="it has none")
    has_words = any(line and not line.startswith("#") for line in _header_lines(file))
    if ";" in first:
        return _Layout(";", "," in first, has_words)
    words = first.split()
    if len(words) > 1 and all(map(DECIMAL_COMMA.fullmatch, words)):
        return _Layout(None, True, has_words)
    if "\t" in first:
        return _Layout("\t" if tabs else None, "," in first, has_words)
    return _Layout("," if "," in first else None, False, has_words)


def _reason(file: Path, layout: _Layout, message: str, *, holes: bool) -> DescriptionError:
    """Error that names the line that could not be read."""
    width = 0
    for number, line in _data_lines(file):
        text = line.replace(",", ".") if layout.has_decimal_commas else line
        words = [word.strip() for word in text.split(layout.delimiter)]
        place = f"{file.name}, line {number}"
        for column, word in enumerate(words, start=1):
            if is_number(word) or (holes and (not word or _UNMEASURED.fullmatch(word))):
                continue
            hint = "put # before lines that are no data"
            if not word:
                hint = f"{HOLES}; no line may end in a comma"
            elif _UNMEASURED.fullmatch(word):
                hint = HOLES
            return DescriptionError(
                "HeightMap.heights", word, f"be numbers ({place}, column {column})", hint=hint
            )
        width = width or len(words)
        if len(words) != width:
            return DescriptionError(
                "HeightMap.heights",
                f"{len(words)} columns",
                f"have {width} columns in each line, as in the first ({place})",
            )
    return DescriptionError("HeightMap.heights", message, f"be numbers ({file.name})")
