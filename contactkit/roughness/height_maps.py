"""Measured height maps: reading, validation and detrending.

Heights [m] are positive out of the body, peaks up; arrays are ``[y, x]``, the first line of a file
is the row y = 0. A map with holes, pixels without a height, is refused unless they are asked for.
"""

from __future__ import annotations

import math
from os import PathLike
from pathlib import Path
from typing import Literal, NamedTuple

import numpy as np
from numpy.typing import NDArray

from ..errors import DescriptionError
from ..reading.arrays import read_map
from ..reading.limits import check_limit, check_size
from ..reading.named_files import check_digest, digest_of, existing
from ..validators import LARGEST
from .instrument_files import MATRICES, read_instrument
from .map_fields import given_twice, length_unit, needed
from .surface_data_file import is_surface_data_text, read_surface_data
from .text_maps import HOLES, read_header, read_matrix, read_points

__all__ = [
    "HeightMap",
    "Tilt",
    "Trend",
    "checksum",
    "detrend",
    "detrended",
    "filled",
    "read_height_map",
    "tilt_of",
]

Array = NDArray[np.float64]
Pair = tuple[float, float]
Trend = Literal["none", "mean", "tilt", "curvature"]

ROWS = 64  # rows of a map that are worked on at a time: 2 MB of 4096 pixels
_SIZES = "1e-9 or (2e-9, 1e-9) [m]"  # example of a cure
_RESIDUE = 8.0 * float(np.finfo(np.float64).eps)  # of the heights given, that detrending leaves


def detrended(heights: Array, trend: Trend = "tilt") -> Array:
    r"""Detrended heights: less the least-squares polynomial over all pixels.

    Parameters
    ----------
    heights : ndarray (ny, nx)
        Heights, any unit; nan in holes, which are left out of the fit and stay.
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
    return detrend(np.array(heights, dtype=np.float64), trend)


def detrend(left: Array, trend: Trend) -> Array:
    """`detrended` in the memory of the heights, if they have no holes: a large map is held once."""
    if trend == "none":
        return left
    known = np.isfinite(left)
    if not known.all():
        return _detrended_around_holes(left, known, trend)
    largest = max(float(left.max()), -float(left.min()))
    left -= left.mean()
    if trend == "mean":
        return _without_residue(left, largest)
    y, x = (_centred(np.linspace(-1.0, 1.0, n) if n > 1 else np.zeros(1)) for n in left.shape)
    shapes = [(y, np.ones_like(x)), (np.ones_like(y), x)]
    if trend == "curvature":
        # On a full grid these are orthogonal to each other and to the former terms.
        shapes += [(_centred(y * y), np.ones_like(x)), (np.ones_like(y), _centred(x * x)), (y, x)]
    for of_y, of_x in shapes:
        square = float(of_y @ of_y) * float(of_x @ of_x)
        if square > 1e-12:  # a grid of one or two pixels has no tilt or no curvature
            along_y = of_y @ left @ of_x / square * of_y
            for i in range(0, len(left), ROWS):
                left[i : i + ROWS] -= along_y[i : i + ROWS, None] * of_x
    return _without_residue(left, largest)


def _detrended_around_holes(heights: Array, known: NDArray[np.bool_], trend: Trend) -> Array:
    """See `detrended`: by the normal equations of the polynomial over the pixels that are known.

    Coordinates from -1 to 1, so that six terms are conditioned to some 1e3 where most pixels are
    known; terms that few pixels cannot tell apart are left out by `lstsq`.
    """
    y, x = (np.linspace(-1.0, 1.0, n) for n in heights.shape)
    powers = [(0, 0)]
    if trend != "mean":
        powers += [(1, 0), (0, 1)]
    if trend == "curvature":
        powers += [(2, 0), (0, 2), (1, 1)]
    values = np.where(known, heights, 0.0)
    values -= np.where(known, values.sum() / known.sum(), 0.0)
    weights = known.astype(np.float64)
    moments = {(i, j): y**i @ weights @ x**j for i in range(5) for j in range(5) if i + j <= 4}
    matrix = [[moments[i + k, j + m] for k, m in powers] for i, j in powers]
    right = [y**i @ values @ x**j for i, j in powers]
    found, *_ = np.linalg.lstsq(np.array(matrix), np.array(right), rcond=1e-12)
    for (i, j), factor in zip(powers, found.tolist(), strict=True):
        values -= factor * (y**i)[:, None] * x**j
    largest = float(np.abs(heights[known]).max(initial=0.0))
    return np.where(known, _without_residue(values * known, largest), np.nan)


class Tilt(NamedTuple):
    """Rise of the plane that fits a map best over the map, and rms of the heights about it."""

    rise: float
    rms: float


def tilt_of(heights: Array) -> Tilt:
    """Tilt of a map without holes, as `detrended` takes it off, in the unit of the heights.

    A few rows at a time: a large map is not copied.

    Examples
    --------
    >>> y, x = np.mgrid[:3.0, :4.0]
    >>> rise, rms = tilt_of(1.0 + 2.0 * x - y)
    >>> round(rise, 12), rms < 1e-14
    (8.0, True)
    """
    (ny, nx), mean = heights.shape, float(heights.mean())
    y, x = (_centred(np.linspace(-1.0, 1.0, n) if n > 1 else np.zeros(1)) for n in heights.shape)
    along_y = float(y @ (heights.sum(axis=1) - nx * mean)) / max(float(y @ y) * nx, 1e-300)
    along_x = float(x @ (heights.sum(axis=0) - ny * mean)) / max(float(x @ x) * ny, 1e-300)
    total = about = 0.0
    for i in range(0, ny, ROWS):
        some = heights[i : i + ROWS] - mean
        total += float(np.einsum("ij,ij->", some, some))
        some -= along_y * y[i : i + ROWS, None] + along_x * x
        about += float(np.einsum("ij,ij->", some, some))
    largest = max(float(heights.max()), -float(heights.min()))
    if math.sqrt(total / heights.size) <= _RESIDUE * largest:  # nothing but round-off
        return Tilt(0.0, 0.0)
    rise = abs(along_y) * float(np.ptp(y)) + abs(along_x) * float(np.ptp(x))
    return Tilt(rise, math.sqrt(about / heights.size))


def filled(heights: Array) -> Array:
    """Heights with that of the nearest known pixel in each hole (nan).

    Examples
    --------
    >>> filled(np.array([[1.0, np.nan, 3.0, 4.0]]))
    array([[1., 1., 3., 4.]])
    """
    from scipy.ndimage import distance_transform_edt

    holes = ~np.isfinite(heights)
    if not holes.any():
        return heights
    nearest = distance_transform_edt(holes, return_distances=False, return_indices=True)
    return np.asarray(heights[tuple(nearest)])


def _without_residue(left: Array, largest: float) -> Array:
    """Zero in place of heights that are the round-off of those given, the largest in size."""
    size = sum(float(np.abs(left[i : i + ROWS]).sum()) for i in range(0, len(left), ROWS))
    if size <= _RESIDUE * largest * left.size:
        left[...] = 0.0
    return left


def _centred(values: Array) -> Array:
    return np.asarray(values - values.mean())


class HeightMap(NamedTuple):
    """A measured height map."""

    heights: Array
    """Heights [m], (ny, nx), peaks up; nan in holes, where they were asked for."""
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
    holes: bool = False,
) -> HeightMap:
    r"""Read a height map from a file.

    ====================== ==============================================================
    ending                 holds
    ====================== ==============================================================
    npy                    an array (ny, nx) of numbers; needs `pixel_size` and `unit`
    csv txt dat tsv asc    one row per line, split by commas, semicolons, tabs or spaces,
                           decimal commas where that is clear; lines that begin with ``#``
                           are skipped; needs both as well, unless its header states them as
                           those of Gwyddion and WSxM do
    xyz                    a point x, y, z per line, on a regular grid in any order;
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
    holes : bool
        Whether heights may be missing, and are nan then: empty cells, nan, points left out, what an
        instrument marks.

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
    if ending == ".npy":
        size = needed(size, "pixel_size", _SIZES, file)
        factor = length_unit(unit, file)
        with file.open("rb") as content:
            heights = read_map(content, check_size(file), str(file), factor)
    elif ending in MATRICES:
        heights, size = _text_map(file, size, unit, holes=holes)
    elif ending == ".xyz":
        if size is not None:
            raise given_twice("pixel_size", pixel_size, file)
        factor = length_unit(unit, file)
        raw, own = read_points(file, holes=holes)
        raw *= factor
        heights, size = raw, (own[0] * factor, own[1] * factor)
    elif ending == ".sdf" and is_surface_data_text(file):
        for field, given in (("unit", unit), ("pixel_size", pixel_size)):
            if given is not None:
                raise given_twice(field, given, file)
        heights, size = read_surface_data(file)
    else:
        heights, size, source, is_periodic = read_instrument(file, size, unit, channel)
    checked = checked_heights(heights, file, holes=holes)
    if not all(math.isfinite(d) and 0.0 < d <= LARGEST for d in size):
        raise DescriptionError(
            "HeightMap.pixel_size", size, f"be positive and finite in {file.name}", unit="m"
        )
    return HeightMap(checked, size, source, found, is_periodic)


def _text_map(
    file: Path, size: Pair | None, unit: str | None, *, holes: bool
) -> tuple[Array, Pair]:
    """Heights [m] and pixel size [m] of a text of rows, with what its header does not state."""
    header = read_header(file)
    for name, given, states in (("unit", unit, header.unit), ("pixel_size", size, header.extent)):
        if given is not None and states is not None:
            raise given_twice(name, given, file)
    if header.extent is None:
        size = needed(size, "pixel_size", _SIZES, file)
    raw = read_matrix(file, holes=holes)
    if header.extent is not None:
        size = (header.extent[0] / raw.shape[0], header.extent[1] / raw.shape[1])
    assert size is not None
    raw *= length_unit(header.unit or unit, file)
    return raw, size


def _checked_size(given: float | Pair | None) -> Pair | None:
    if given is None:
        return None
    pair = given if isinstance(given, tuple) else (given, given)
    if len(pair) != 2 or not all(math.isfinite(d) and d > 0.0 for d in pair):
        raise DescriptionError(
            "HeightMap.pixel_size", given, "be one or two positive, finite lengths", unit="m"
        )
    return pair


def checked_heights(heights: Array, file: Path, *, holes: bool) -> Array:
    """Return the heights of a file as an array of doubles, nan in holes.

    Raises
    ------
    DescriptionError
        If they are no map, too many or too large, or some are missing and `holes` is false.
    """
    if heights.ndim != 2 or min(heights.shape) < 2:
        raise DescriptionError(
            "HeightMap.heights",
            f"shape {heights.shape}",
            f"be a map (ny, nx) of at least 2 x 2 pixels in {file.name}",
            hint="a profile along a line is not a surface",
        )
    check_limit("PIXELS", heights.size, str(file))
    given = np.ascontiguousarray(np.ma.filled(heights, np.nan), dtype=np.float64)
    missing = ~np.isfinite(given)
    if missing.all() or (missing.any() and not holes):
        i, j = (int(k) for k in np.argwhere(missing)[0])
        raise DescriptionError(
            "HeightMap.heights",
            f"{int(missing.sum())} that are not, the first at [{i}, {j}]",
            f"be finite in every pixel of {file.name}",
            unit="m",
            hint="check the file" if missing.all() else HOLES,
        )
    known = ~missing  # not by a map of sizes, which is as large again
    highest, lowest = (float(found(initial=0.0, where=known)) for found in (given.max, given.min))
    largest = max(highest, -lowest)
    if largest > LARGEST:
        raise DescriptionError(
            "HeightMap.heights",
            float(largest),
            f"be at most {LARGEST:g} in size in {file.name}",
            unit="m",
            hint="no length is as large; check the unit",
        )
    if missing.any():
        given = given if given.flags.writeable else given.copy()
        given[missing] = np.nan
    return given
