"""Removal of periodic images: fields of an isolated load from periodic transforms.

A map in a zero-padded window of twice its size is still affected by its periodic images, whose
fields decay slowly under stiff layers but are smooth within the map.  Their contribution is the
difference between the fields in that window and in one four times as wide, and both are computed on
coarse pixels from a smoothed load, because the sharp near field cancels in the difference.  Two
such steps leave images at a distance of 32 maps, at the cost of grids of 64 and 256 points per
side.

The smoothing multiplies the spectrum by ``(1 + s + s^2/2 + s^3/6) exp(-s)`` with
``s = (k w)^2/2``: it conserves the moments of the load up to the seventh and is 2e-10 at the
highest wavenumber of the coarse grid.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np
import scipy.fft
from numpy.typing import NDArray
from scipy.interpolate import make_interp_spline

from .periodic import Modes, grid_of_modes, spectrum

__all__ = ["Grid", "Step", "added", "padded_shape", "single_load"]

Array = NDArray[np.float64]
Complex = NDArray[np.complex128]
Pair = tuple[float, float]

COARSE = 64  # points per side of the periodic window of a step
WIDER = 4  # ratio of windows from step to step
NARROWEST = 2.0  # side of the first window over that of the map
SMOOTHING = 2.5  # width w of the smoothing in coarse pixels
MARGIN = 6  # coarse points beyond the map, so that its edge is not the edge of the splines


class Grid(NamedTuple):
    """Spectra of the loads (None: no load) on a periodic grid, and the window to return."""

    loads: list[Complex | None]
    modes: Modes
    pixel_size: Pair
    window: tuple[int, int]


class Step(NamedTuple):
    """Two coarse grids of one load, and the splines from their points to the map."""

    wide: Grid
    narrow: Grid
    part: tuple[slice, slice]
    along_y: Array
    along_x: Array


def padded_shape(window: tuple[int, int], pixel_size: Pair, padding: float) -> tuple[int, int]:
    """Shape of a nearly square grid, `padding` times the map, with fast transform sizes.

    Examples
    --------
    >>> padded_shape((100, 50), (1.0, 2.0), 2.0)
    (200, 100)
    """
    side = padding * max(n * d for n, d in zip(window, pixel_size, strict=True))
    ny, nx = (scipy.fft.next_fast_len(math.ceil(side / d - 1e-9), real=True) for d in pixel_size)
    return max(ny, window[0]), max(nx, window[1])


def single_load(
    maps: list[Array | None],
    window: tuple[int, int],
    pixel_size: Pair,
    padding: float,
    workers: int | None = None,
) -> tuple[Grid, list[Step]]:
    """Grid of an isolated load, and the steps that remove its periodic images.

    Parameters
    ----------
    maps : list of (ndarray of shape (ny, nx) or None)
        Loads.
    window : (ny, nx)
        Their shape.
    pixel_size : (dy, dx)
        [m].
    padding : float
        Distance of the remaining images, over the side of the map.
    workers : int, optional
        Threads of the transforms.

    Returns
    -------
    Grid, list of Step
        No step if `padding` is at most 4: the grid itself is then that large.

    Examples
    --------
    >>> grid, steps = single_load([np.ones((8, 8))], (8, 8), (1.0, 1.0), 32.0)
    >>> grid.modes.shape, [step.wide.modes.shape for step in steps]
    ((16, 16), [(256, 256), (256, 256)])
    """
    direct = padding <= WIDER
    shape = padded_shape(window, pixel_size, padding if direct else NARROWEST)
    loads = [None if m is None else spectrum(m, shape, workers) for m in maps]
    grid = Grid(loads, grid_of_modes(shape, pixel_size), pixel_size, window)
    steps: list[Step] = []
    if direct:
        return grid, steps
    period = shape[0] * pixel_size[0], shape[1] * pixel_size[1]
    centre = 0.5 * (window[0] - 1) * pixel_size[0], 0.5 * (window[1] - 1) * pixel_size[1]
    area = pixel_size[0] * pixel_size[1]
    lows = [None if q is None else _low(q, shape) * area for q in loads]
    lows = [None if q is None else _shifted(q, period, centre) for q in lows]
    for _ in range(math.ceil(math.log(padding / NARROWEST, WIDER) - 1e-9)):
        step, lows = _step(lows, period, window, pixel_size)
        steps.append(step)
        period = WIDER * period[0], WIDER * period[1]
    return grid, steps


def added(field: Array, wide: Array, narrow: Array, step: Step) -> None:
    """Add the correction of a step to one field of a map, in place.

    Examples
    --------
    >>> _, (step, _) = single_load([np.ones((8, 8))], (8, 8), (1.0, 1.0), 32.0)
    >>> field = np.zeros((8, 8))
    >>> added(field, np.full((64, 64), 3.0), np.ones((64, 64)), step)
    >>> bool(np.allclose(field, 2.0))
    True
    """
    field += step.along_y @ (wide - narrow)[step.part] @ step.along_x.T


def _step(
    lows: list[Complex | None], period: Pair, window: tuple[int, int], pixel_size: Pair
) -> tuple[Step, list[Complex | None]]:
    """One step, and the long waves of its wide grid for the next one.

    `lows` are transforms (integrals, about the centre of the map) on the modes of a grid of
    COARSE points a side.
    """
    coarse = period[0] / COARSE, period[1] / COARSE
    loads = [None if low is None else _smooth_load(low, period, coarse) for low in lows]

    def grid(size: int) -> Grid:
        shape = size, size
        spectra = [None if load is None else spectrum(load, shape) for load in loads]
        return Grid(spectra, grid_of_modes(shape, coarse), coarse, (COARSE, COARSE))

    wide, narrow = grid(WIDER * COARSE), grid(COARSE)
    far, middle = (WIDER * period[0], WIDER * period[1]), (0.5 * period[0], 0.5 * period[1])
    unit = coarse[0] * coarse[1] / _smoothing(far, coarse)
    backs = [None if q is None else _low(q, wide.modes.shape) * unit for q in wide.loads]
    nexts = [None if back is None else _shifted(back, far, middle) for back in backs]
    (in_y, along_y), (in_x, along_x) = (
        _splines(n, d, c) for n, d, c in zip(window, pixel_size, coarse, strict=True)
    )
    return Step(wide, narrow, (in_y, in_x), along_y, along_x), nexts


def _smooth_load(low: Complex, period: Pair, coarse: Pair) -> Array:
    """Load on the coarse grid, the centre of the map at its middle."""
    smooth = low * _smoothing(period, coarse) / (coarse[0] * coarse[1])
    smooth = _shifted(smooth, period, (-0.5 * period[0], -0.5 * period[1]))
    return scipy.fft.irfft2(smooth, s=(COARSE, COARSE))


def _splines(count: int, pixel: float, coarse: float) -> tuple[slice, Array]:
    """Coarse points around the map along one axis, and the matrix from them to its pixels."""
    reach = 0.5 * (count - 1) * pixel
    half = min(math.ceil(reach / coarse) + MARGIN, COARSE // 2 - 1)
    points = coarse * np.arange(-half, half + 1.0)
    wanted = np.arange(count) * pixel - reach
    along: Array = make_interp_spline(points, np.eye(points.size), k=5)(wanted)
    return slice(COARSE // 2 - half, COARSE // 2 + half + 1), along


def _low(values: Complex, shape: tuple[int, int]) -> Complex:
    """Modes of a grid that a coarse grid resolves, without its Nyquist modes."""
    half = COARSE // 2
    low = np.zeros((COARSE, half + 1), dtype=np.complex128)
    up, across = min(half, (shape[0] + 1) // 2), min(half, (shape[1] + 1) // 2)
    low[:up, :across] = values[:up, :across]
    low[-up + 1 :, :across] = values[-up + 1 :, :across]
    return low


def _wavenumbers(period: Pair) -> tuple[Array, Array]:
    ky = 2.0 * np.pi / period[0] * scipy.fft.fftfreq(COARSE, 1.0 / COARSE)
    kx = 2.0 * np.pi / period[1] * np.arange(COARSE // 2 + 1.0)
    return ky[:, None], kx


def _shifted(values: Complex, period: Pair, origin: Pair) -> Complex:
    ky, kx = _wavenumbers(period)
    turned: Complex = values * np.exp(1j * ky * origin[0]) * np.exp(1j * kx * origin[1])
    return turned


def _smoothing(period: Pair, coarse: Pair) -> Array:
    ky, kx = _wavenumbers(period)
    s = 0.5 * SMOOTHING**2 * ((ky * coarse[0]) ** 2 + (kx * coarse[1]) ** 2)
    smooth: Array = (1.0 + s * (1.0 + s * (0.5 + s / 6.0))) * np.exp(-s)
    return smooth
