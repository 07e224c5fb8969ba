"""Maps as a page holds them: of fewer cells where there are many pixels, in some hundred levels."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any, Literal, NamedTuple

import numpy as np

if TYPE_CHECKING:
    from numpy.typing import NDArray

    Map = NDArray[np.float64]

__all__ = ["FINE", "COARSE", "Image", "Images", "Region", "cell_factor", "reduced", "top_of"]

Kept = Literal["largest", "smallest", "greatest size"]
"""What a cell keeps of its pixels: the largest or smallest value, or that of greatest size."""

# Steps from the smallest to the largest value of a map. A value under the pointer is read to three
# digits of the largest, and 1000 steps pack into 3/4 of what 4000 take.
FINE = 1000
# Stress is smooth, and there are ten times as many maps: 250 steps are one byte.
COARSE = 250


class Image(NamedTuple):
    """Place of a map among the bytes of the page, and the values of its levels.

    A value is ``low + step*level``; the highest number of `bytes` bytes is a pixel without one.
    """

    start: int
    bytes: int
    low: float
    step: float


def cell_factor(shape: tuple[int, int], most: int) -> int:
    """Pixels along the side of a cell, so that there are at most `most` cells along each side.

    Examples
    --------
    >>> cell_factor((768, 768), 256), cell_factor((100, 300), 256), cell_factor((64, 64), 256)
    (3, 2, 1)
    """
    return max(1, math.ceil(max(shape) / most))


def reduced(values: Map, factor: int, kept: Kept) -> Map:
    """Keep one value of each cell of `factor` by `factor` pixels; the last may have fewer.

    No peak is lost, and no pixel in contact, as a mean would do; nan only where all are.

    Examples
    --------
    >>> reduced(np.array([[1.0, -3.0, 5.0], [0.0, 2.0, 4.0]]), 2, "greatest size").tolist()
    [[-3.0, 5.0]]
    """
    if factor == 1:
        return values
    if kept == "largest":
        return _by_cells(np.fmax, values, factor)
    if kept == "smallest":
        return _by_cells(np.fmin, values, factor)
    high, low = _by_cells(np.fmax, values, factor), _by_cells(np.fmin, values, factor)
    return np.where(high >= -low, high, low)


def _by_cells(of_two: Any, values: Map, factor: int) -> Map:
    rows = of_two.reduceat(values, range(0, values.shape[0], factor), axis=0)
    found: Map = of_two.reduceat(rows, range(0, values.shape[1], factor), axis=1)
    return found


class Region(NamedTuple):
    """Rows and columns of pixels."""

    rows: slice
    columns: slice

    def of(self, values: Any) -> Any:
        """Part of a map."""
        return values[..., self.rows, self.columns]

    @property
    def shape(self) -> tuple[int, int]:
        """Pixels along y and x."""
        return self.rows.stop - self.rows.start, self.columns.stop - self.columns.start


def top_of(
    values: Map, region: Region, pixel_size: tuple[float, float]
) -> tuple[float, float, float]:
    """Largest value of a map in a region, on all pixels, and its place (x, y) [m].

    The smallest one if none is positive, as of the friction of a body that slides against x.

    Examples
    --------
    >>> values = np.array([[9.0, 0.0, 2.0], [9.0, 1.0, math.nan]])
    >>> top_of(values, Region(slice(0, 2), slice(1, 3)), (1.0, 0.5))
    (2.0, 1.25, 0.5)
    """
    cut = region.of(values)
    is_negative = np.nanmax(cut) <= 0.0 > np.nanmin(cut)
    at = np.nanargmin(cut) if is_negative else np.nanargmax(cut)
    row, column = divmod(int(at), cut.shape[1])
    x = (column + region.columns.start + 0.5) * pixel_size[1]
    return float(cut[row, column]), x, (row + region.rows.start + 0.5) * pixel_size[0]


class Images:
    """Bytes of the maps of a page, one after the other.

    Each level is kept as its difference from that of the cell before, that of a first cell from
    the one above it: smooth maps then pack into a third. Of two bytes the lower ones come first.
    """

    def __init__(self) -> None:
        self._parts: list[bytes] = []
        self._size = 0

    @property
    def content(self) -> bytes:
        """All of them."""
        return b"".join(self._parts)

    def add(self, values: Map, levels: int) -> Image:
        """Add a map, rounded to the nearest of its levels."""
        known = np.isfinite(values)
        low = float(values[known].min(initial=math.inf)) if known.any() else 0.0
        high = float(values[known].max(initial=-math.inf)) if known.any() else 0.0
        step = (high - low) / levels
        size = 1 if levels < 255 else 2
        codes = np.full(values.shape, 256**size - 1, dtype=np.int64)
        codes[known] = np.rint((values[known] - low) / step) if step > 0.0 else 0
        return Image(self._append(codes, size), size, low, step)

    def add_flags(self, flags: NDArray[np.uint8]) -> int:
        """Add a map of bits as it is, and return where it lies."""
        return self._append(flags.astype(np.int64), 1)

    def _append(self, codes: NDArray[np.int64], size: int) -> int:
        changes = np.diff(codes, axis=1, prepend=0)
        changes[:, 0] = np.diff(codes[:, 0], prepend=0)
        flat = (changes % 256**size).ravel()
        start = self._size
        for byte in range(size):
            self._parts.append((flat >> (8 * byte) & 255).astype(np.uint8).tobytes())
        self._size += size * flat.size
        return start
