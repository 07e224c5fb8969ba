"""Surface data files of ISO 25178-71 (SDF) in their text form.

A first line names the version (aISO-1.0, aISO-2.0, aBCR-1.0). Then a header of ``key = value``, the
heights of one profile along x after the other, and a trailer, each ended by an asterisk. Lengths
are in metres: a height is its number times Zscale, a pixel is Xscale by Yscale. A point that was
not measured is ``BAD``.
"""

from __future__ import annotations

import math
import re
from collections.abc import Mapping
from pathlib import Path
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from ..errors import DescriptionError

__all__ = ["SurfaceData", "is_surface_data_text", "read_surface_data"]

Array = NDArray[np.float64]

_VERSION = re.compile(rb"\s*a[A-Za-z]+-V?\d")
_BAD = "bad"


class SurfaceData(NamedTuple):
    """Heights (ny, nx) and pixel size (dy, dx) of a file [m]; nan where nothing was measured."""

    heights: Array
    pixel_size: tuple[float, float]


def is_surface_data_text(file: Path) -> bool:
    """Whether a file begins as one in text does; the binary form begins with b."""
    with file.open("rb") as content:
        return _VERSION.match(content.read(16)) is not None


def read_surface_data(file: Path) -> SurfaceData:
    """Read a surface data file in text form.

    Raises
    ------
    DescriptionError
        If a number of the header is missing or impossible, if the data are compressed or carry a
        checksum, if the file holds one profile, or not as many heights as the header announces.
    """
    text = file.read_text(encoding="latin-1")
    head, data = _parts([line.partition(";")[0].strip() for line in text.splitlines()], file)
    header = _header(head, file)
    for key in ("compression", "checktype"):
        if header.get(key, "0") not in ("0", ""):
            raise DescriptionError(
                f"{file.name}, {key}", header[key], "be 0", hint="save the file without"
            )
    nx, ny = _count(header, "numpoints", file), _count(header, "numprofiles", file)
    if min(nx, ny) < 2:
        raise DescriptionError(
            "HeightMap.heights",
            f"{ny} profile of {nx} points",
            f"be a map of at least 2 x 2 pixels in {file.name}",
            hint="a profile along a line is not a surface",
        )
    dx, dy = _length(header, "xscale", file), _length(header, "yscale", file)
    heights = _heights(data, file)
    if heights.size != nx * ny:
        raise DescriptionError(
            "HeightMap.heights",
            f"{heights.size} heights",
            f"be {nx * ny} in {file.name}: {ny} profiles of {nx} points",
            hint="the file is cut short, or its header is another one's",
        )
    return SurfaceData(heights.reshape(ny, nx) * _length(header, "zscale", file), (dy, dx))


def _parts(lines: list[str], file: Path) -> tuple[list[str], list[str]]:
    """Lines of the header without the version, and of the heights."""
    ends = [i for i, line in enumerate(lines) if line == "*"]
    if not ends:
        raise DescriptionError(
            "HeightMap.path", file.name, "end its header with a line of one asterisk"
        )
    last = ends[1] if len(ends) > 1 else len(lines)
    first = next(i for i, line in enumerate(lines) if line)
    return lines[first + 1 : ends[0]], lines[ends[0] + 1 : last]


def _header(lines: list[str], file: Path) -> dict[str, str]:
    found: dict[str, str] = {}
    for line in filter(None, lines):
        key, mark, value = line.partition("=")
        if not mark:
            raise DescriptionError(f"{file.name}, header", line, "be a line key = value")
        found[key.strip().lower()] = value.strip()
    return found


def _number(header: Mapping[str, str], key: str, file: Path) -> float:
    given = header.get(key)
    try:
        return float(given or "")
    except ValueError:
        raise DescriptionError(f"{file.name}, {key}", given, "be a number") from None


def _count(header: Mapping[str, str], key: str, file: Path) -> int:
    value = _number(header, key, file)
    if not (value >= 1.0 and value.is_integer()):
        raise DescriptionError(f"{file.name}, {key}", value, "be a whole number of at least 1")
    return int(value)


def _length(header: Mapping[str, str], key: str, file: Path) -> float:
    value = _number(header, key, file)
    if not (math.isfinite(value) and value > 0.0):
        raise DescriptionError(
            f"{file.name}, {key}", value, "be a positive, finite length", unit="m"
        )
    return value


def _heights(lines: list[str], file: Path) -> Array:
    """Numbers of the data area, nan for ``BAD``."""
    words = " ".join(lines).split()
    try:
        return np.array([math.nan if word.lower() == _BAD else float(word) for word in words])
    except ValueError as error:
        raise DescriptionError(
            "HeightMap.heights", str(error), f"be numbers or BAD in {file.name}"
        ) from None
