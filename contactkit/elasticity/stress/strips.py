"""Grids of a map that repeats along one axis, and the removal of the images across.

Waves along the axis that repeats decay across within about their length: a padding of some periods
leaves nothing of their images.  The mean along that axis is a line load in plane strain, whose
field decays slowly: its images are removed by a second computation on a grid of one line that is
much longer, less that on one line as long as the first grid.  Far images do not depend on how the
map is read between its pixels.
"""

from __future__ import annotations

import math
from typing import Literal, NamedTuple

import numpy as np
import scipy.fft
from numpy.typing import NDArray

from .periodic import Grid, grid_of_modes, spectrum

__all__ = ["LineStep", "StripGrids", "strip_grids"]

Array = NDArray[np.float64]
Pair = tuple[float, float]
Loads = list[NDArray[np.complex128] | None]

# Padding in periods: exp(-6 pi) = 7e-9 of the images of waves along is left. The stress changes by
# 6e-9 of the largest pressure in the median with 2, by 1e-6 with 1; the padded rows cost their
# time.
PERIODS = 3.0


class LineStep(NamedTuple):
    """Grids of one line across, long and as long as that of the map."""

    wide: Grid
    narrow: Grid


class StripGrids(NamedTuple):
    """The grid of a map that repeats along an axis of the array, and the step of its mean."""

    first: Grid
    steps: tuple[LineStep, ...]
    axis: int

    @property
    def all(self) -> list[Grid]:
        """The grid of the map, then the long and the short line."""
        return [self.first, *(grid for step in self.steps for grid in step)]

    def spectra(
        self, maps: list[Array | None], workers: int | None = None, kernel: Array | None = None
    ) -> list[Loads]:
        """Spectra of loads (None: no load) on each grid, in the order of `all`."""
        lines = [None if m is None else m.mean(axis=self.axis, keepdims=True) for m in maps]
        loads = [maps, *([lines] * (2 * len(self.steps)))]
        return [
            [None if m is None else spectrum(m, grid.modes.shape, workers) for m in each]
            for each, grid in zip(loads, self.all, strict=True)
        ]


def strip_grids(
    window: tuple[int, int], pixel_size: Pair, along: Literal["x", "y"], padding: float
) -> StripGrids:
    """Grids of a map that repeats along x or y alone.

    Parameters
    ----------
    window : (ny, nx)
        Shape of the map.
    pixel_size : (dy, dx)
        [m].
    along : {"x", "y"}
        Axis along which it repeats.
    padding : float
        Distance of the remaining images across, over the side of the map across.

    Examples
    --------
    >>> [grid.modes.shape for grid in strip_grids((8, 4), (1.0, 1.0), "x", 32.0).all]
    [(20, 4), (256, 1), (20, 1)]
    """
    axis = 1 if along == "x" else 0
    count, size = window[1 - axis], pixel_size[1 - axis]
    period = window[axis] * pixel_size[axis]
    padded = count + max(count, math.ceil(PERIODS * period / size))

    def grid(length: float, width: int) -> Grid:
        fast = scipy.fft.next_fast_len(math.ceil(length - 1e-9), real=True)
        shape, part = ((fast, width), (count, width))
        if axis == 0:
            shape, part = shape[::-1], part[::-1]
        return Grid(grid_of_modes(shape, pixel_size), pixel_size, part)

    first = grid(padded, window[axis])
    if padding * count <= padded:
        return StripGrids(first, (), axis)
    return StripGrids(first, (LineStep(grid(padding * count, 1), grid(padded, 1)),), axis)
