"""Measured height maps: reading, validation and detrending.

Heights [m] are positive out of the body, peaks up; arrays are ``[y, x]``, the first line of a file
is the row y = 0. Maps are not modified: no hole is filled, nothing is interpolated.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from os import PathLike
from pathlib import Path
from typing import Literal, NamedTuple

import numpy as np
from numpy.typing import NDArray

from ..errors import DescriptionError
from ..reading.arrays import read_array
from ..reading.limits import check_limit, check_size
from ..reading.named_files import check_digest, digest_of, existing
from ..validators import LARGEST
from .instrument_files import MATRICES, read_instrument
from .map_fields import given_twice, length_unit, needed
from .surface_data_file import is_surface_data_text, read_surface_data

__all__ = [
    "HeightMap",
    "Trend",
    "checksum",
    "detrended",
    "read_height_map",
    "read_matrix",
    "read_points",
]

Array = NDArray[np.float64]
Pair = tuple[float, float]
Trend = Literal["none", "mean", "tilt", "curvature"]

_RESIDUE = 8.0 * float(np.finfo(np.float64).eps)  # of the heights given, that detrending leaves
# Grid points for each that is there, above which a list of points is no map but scattered: n points
# with coordinates of their own span n^2, and would be filled into an array of that size before
# holes show.
_SPARSE = 16
# Tolerance of coordinates over the step, for values rounded in a text (three digits of a step). A
# grid whose steps differ by more has to be resampled: slopes would be off by as much.
_ROUNDED = 0.02


def read_matrix(file: Path) -> Array:
    """Numbers of a text file, (lines, columns).

    Raises
    ------
    DescriptionError
        If a line has another number of columns than the first, or is not numeric.
    """
    delimiter = _delimiter(file)
    try:
        return np.loadtxt(file, delimiter=delimiter, ndmin=2, encoding="utf-8-sig")
    except ValueError as error:
        raise _reason(file, delimiter, str(error)) from error


def read_points(file: Path) -> tuple[Array, tuple[float, float]]:
    """Heights (ny, nx) and pixel size (dy, dx) of a file of points x, y, z, in its own unit.

    Raises
    ------
    DescriptionError
        If there are not three columns, or the points do not form a complete regular grid.
    """
    points = read_matrix(file)
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
    if not (times == 1).all():
        i, j = divmod(int(np.argmax(times != 1)), nx)
        raise DescriptionError(
            "HeightMap.heights",
            f"{int(times[i * nx + j])} at [{i}, {j}]",
            f"be one for each point of the {ny} x {nx} grid of {file.name}",
            hint="fill the holes in the instrument's software, or cut out a part without any",
        )
    heights = np.empty((ny, nx))
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
            hint="resample the map onto a regular grid",
        )
    return number, n, step


def _data_lines(file: Path) -> Iterator[tuple[int, str]]:
    """Data lines with their numbers, from 1, one after the other."""
    try:
        with file.open(encoding="utf-8-sig") as text:
            for number, line in enumerate(text, start=1):
                if data := line.split("#")[0].strip():
                    yield number, data
    except UnicodeDecodeError as error:
        raise DescriptionError("HeightMap.path", str(file), "be a text of numbers") from error


def _delimiter(file: Path) -> str | None:
    """Delimiter of the columns, from the first data line; None for spaces and tabs."""
    _, first = next(_data_lines(file), (0, ""))
    if not first:
        raise DescriptionError("HeightMap.heights", "none", f"be in {file.name}")
    return next((mark for mark in ";," if mark in first), None)


def _reason(file: Path, delimiter: str | None, message: str) -> DescriptionError:
    """Error that names the line that could not be read."""
    width = 0
    for number, line in _data_lines(file):
        words = [word.strip() for word in line.split(delimiter)]
        place = f"{file.name}, line {number}"
        for column, word in enumerate(words, start=1):
            try:
                float(word)
            except ValueError:
                hint = (
                    "write points for decimal commas"
                    if "," in word
                    else (
                        "fill holes first; no line may end in a comma"
                        if not word
                        else "put # before lines that are no data"
                    )
                )
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


def detrended(heights: Array, trend: Trend = "tilt") -> Array:
    r"""Detrended heights: less the least-squares polynomial over all pixels.

    Parameters
    ----------
    heights : ndarray (ny, nx)
        Heights, any unit.
    trend : {"tilt", "none", "mean", "curvature"}
        The polynomial in x and y: nothing, a constant, of degree 1, or of degree 2.

    Returns
    -------
    ndarray (ny, nx)
        A new array.

    Notes
    -----
    Rough surfaces have wavelengths beyond any window, which are removed in part: a tilt removes
    about the fraction of the variance at wavelengths longer than the window. What round-off leaves
    of a map without roughness is no surface: the result is zero where its mean deviation is below
    2e-15 of the largest height given.

    Examples
    --------
    >>> y, x = np.mgrid[:3.0, :4.0]
    >>> abs(detrended(1.0 + 2.0 * x - y)).max() < 1e-14, detrended(x * x, "tilt").round(12)[0]
    (np.True_, array([ 1., -1., -1.,  1.]))
    """
    left = np.array(heights, dtype=np.float64)
    if trend == "none":
        return left
    left -= left.mean()
    if trend == "mean":
        return _without_residue(left, heights)
    y, x = (_centred(np.linspace(-1.0, 1.0, n) if n > 1 else np.zeros(1)) for n in left.shape)
    shapes = [(y, np.ones_like(x)), (np.ones_like(y), x)]
    if trend == "curvature":
        # On a full grid these are orthogonal to each other and to the former terms.
        shapes += [(_centred(y * y), np.ones_like(x)), (np.ones_like(y), _centred(x * x)), (y, x)]
    for of_y, of_x in shapes:
        square = float(of_y @ of_y) * float(of_x @ of_x)
        if square > 1e-12:  # a grid of one or two pixels has no tilt or no curvature
            left -= (of_y @ left @ of_x / square * of_y)[:, None] * of_x
    return _without_residue(left, heights)


def _without_residue(left: Array, given: Array) -> Array:
    """Zero in place of heights that are the round-off of those given."""
    largest = float(np.abs(given).max(initial=0.0))
    return np.zeros_like(left) if float(np.abs(left).mean()) <= _RESIDUE * largest else left


def _centred(values: Array) -> Array:
    return np.asarray(values - values.mean())


class HeightMap(NamedTuple):
    """A measured height map."""

    heights: Array
    """Heights [m], (ny, nx), peaks up."""
    pixel_size: Pair
    """Size of a pixel (dy, dx) [m]."""
    source: str
    """Name of the file, and the channel if it has several."""
    checksum: str
    """SHA-256 of the file."""
    is_periodic: bool | None = None
    """Whether the map repeats beyond its edges; None where the file does not say."""


def checksum(path: str | PathLike[str]) -> str:
    """SHA-256 of a file, in hexadecimal digits.

    Raises
    ------
    DescriptionError
        If there is no such file.
    """
    return digest_of(existing(path, "HeightMap.path"))


def read_height_map(
    path: str | PathLike[str],
    *,
    pixel_size: float | Pair | None = None,
    unit: str | None = None,
    checksum: str | None = None,
    channel: int | None = None,
) -> HeightMap:
    r"""Read a height map from a file.

    ====================== ==============================================================
    ending                 holds
    ====================== ==============================================================
    npy                    an array (ny, nx) of numbers; needs `pixel_size` and `unit`
    csv txt dat tsv asc    one row per line, split by commas, semicolons, tabs or spaces;
                           lines that begin with ``#`` are skipped; needs both as well
    xyz                    a point x, y, z per line, on a full regular grid in any order;
                           needs `unit`, that of all three
    sdf                    ISO 25178-71 as text, with its sizes, in metres; the binary form is
                           one of the others
    any other              whatever SurfaceTopography reads (extra ``contactkit[maps]``);
                           `pixel_size` and `unit` only if the file does not contain them
    ====================== ==============================================================

    Parameters
    ----------
    path : path
        The file.
    pixel_size : float or (float, float), optional
        Size of a pixel [m], one number or (dy, dx).
    unit : str, optional
        Unit of the heights, such as "nm".
    checksum : str, optional
        SHA-256 that the file must have.
    channel : int, optional
        Index of the map in an instrument file with several; default: the instrument's own.

    Raises
    ------
    DescriptionError
        If the file does not exist or its checksum differs; if it is not a map of at least 2 x 2
        numbers; if a height is missing or not finite; if a size or a unit is missing, wrong or
        contradicts the file.

    Examples
    --------
    >>> import tempfile
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     file = Path(folder) / "map.csv"
    ...     _ = file.write_text("0, 1, 2\n2, 1, 0\n")
    ...     found = read_height_map(file, pixel_size=1e-6, unit="nm")
    >>> found.heights[0].tolist(), found.pixel_size, found.source
    ([0.0, 1e-09, 2e-09], (1e-06, 1e-06), 'map.csv')
    """
    file = existing(path, "HeightMap.path")
    check_size(file)
    found = digest_of(file)
    if checksum is not None:
        check_digest(file, found, checksum, "HeightMap.checksum")
    size = _checked_size(pixel_size)
    ending = file.suffix.lower()
    source, is_periodic = file.name, None
    if ending == ".npy" or ending in MATRICES:
        size = needed(size, "pixel_size", "1e-9 or (2e-9, 1e-9) [m]", file)
        raw = _load_npy(file) if ending == ".npy" else read_matrix(file)
        heights = raw * length_unit(unit, file)
    elif ending == ".xyz":
        if size is not None:
            raise given_twice("pixel_size", pixel_size, file)
        factor = length_unit(unit, file)
        raw, own = read_points(file)
        heights, size = raw * factor, (own[0] * factor, own[1] * factor)
    elif ending == ".sdf" and is_surface_data_text(file):
        for field, given in (("unit", unit), ("pixel_size", pixel_size)):
            if given is not None:
                raise given_twice(field, given, file)
        heights, size = read_surface_data(file)
    else:
        heights, size, source, is_periodic = read_instrument(file, size, unit, channel)
    checked = _checked(heights, file)
    if not all(math.isfinite(d) and 0.0 < d <= LARGEST for d in size):
        raise DescriptionError(
            "HeightMap.pixel_size", size, f"be positive and finite in {file.name}", unit="m"
        )
    return HeightMap(checked, size, source, found, is_periodic)


def _checked_size(given: float | Pair | None) -> Pair | None:
    if given is None:
        return None
    pair = given if isinstance(given, tuple) else (given, given)
    if len(pair) != 2 or not all(math.isfinite(d) and d > 0.0 for d in pair):
        raise DescriptionError(
            "HeightMap.pixel_size", given, "be one or two positive, finite lengths", unit="m"
        )
    return pair


def _load_npy(file: Path) -> Array:
    with file.open("rb") as content:
        raw = read_array(content, check_size(file), str(file))
    if raw.dtype.kind not in "fiu":
        raise DescriptionError("HeightMap.heights", str(raw.dtype), "be real numbers")
    check_limit("PIXELS", raw.size, str(file))
    return raw.astype(np.float64)


def _checked(heights: Array, file: Path) -> Array:
    if heights.ndim != 2 or min(heights.shape) < 2:
        raise DescriptionError(
            "HeightMap.heights",
            f"shape {heights.shape}",
            f"be a map (ny, nx) of at least 2 x 2 pixels in {file.name}",
            hint="a profile along a line is not a surface",
        )
    check_limit("PIXELS", heights.size, str(file))
    holes = ~np.isfinite(np.ma.filled(heights, np.nan))
    if holes.any():
        i, j = (int(k) for k in np.argwhere(holes)[0])
        raise DescriptionError(
            "HeightMap.heights",
            f"{int(holes.sum())} that are not, the first at [{i}, {j}]",
            f"be finite in every pixel of {file.name}",
            unit="m",
            hint="fill the holes in the instrument's software, or cut out a part without any; or "
            "press the array with them masked (numpy.ma): they then carry no load",
        )
    made = np.ascontiguousarray(np.ma.getdata(heights), dtype=np.float64)
    largest = max(made.max(), -made.min())
    if largest > LARGEST:
        raise DescriptionError(
            "HeightMap.heights",
            float(largest),
            f"be at most {LARGEST:g} in size in {file.name}",
            unit="m",
            hint="no length is as large; check the unit",
        )
    return made
