"""Grids of a map of tractions, and the removal of periodic images for an isolated load.

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
from typing import Literal, NamedTuple

import numpy as np
import scipy.fft
from numpy.typing import NDArray
from scipy.interpolate import make_interp_spline

from ...errors import DescriptionError
from .periodic import Grid, grid_of_modes, spectrum
from .strips import LineStep, StripGrids, strip_grids

__all__ = [
    "Grids",
    "Mean",
    "WindowStep",
    "add_correction",
    "grids_of",
    "isolated_grids",
    "padded_shape",
]

Array = NDArray[np.float64]
Complex = NDArray[np.complex128]
Pair = tuple[float, float]
Loads = list[Complex | None]
Mean = Literal["periodic", "free", "x", "y"]

# Measured on a Hertzian load over half of the map, with friction, homogeneous and under a layer 100
# times as stiff; errors over the largest pressure.

# Points per side of the periodic window of a step: 64 leave 2e-9, 32 5e-6; 128 take four times as
# long.
COARSE = 64
WIDER = 4  # ratio of windows from step to step: two steps to 32 maps, on a wide grid of 256 points
# Side of the first window over that of the map: the nearest image is then a whole map away, and its
# field smooth within it. Less, and images touch; more costs its square in the transforms of the
# map.
NARROWEST = 2.0
# Width w of the smoothing in coarse pixels. Narrower, it aliases (2e-9 at 2, 1e-6 at 1.5); wider,
# it blurs the load (2e-8 at 3.5, 3e-6 at 5).
SMOOTHING = 2.5
# Coarse points beyond the map, so that its edge is not that of the splines: 6 leave 1e-11, 2 2e-10.
MARGIN = 6


class WindowStep(NamedTuple):
    """Two coarse grids, the narrow one of a given period, and splines from them to the map."""

    period: Pair
    wide: Grid
    narrow: Grid
    part: tuple[slice, slice]
    along_y: Array
    along_x: Array


class Grids(NamedTuple):
    """The grid of a map, and the steps that remove its periodic images; none if it is periodic."""

    first: Grid
    steps: tuple[WindowStep, ...]

    @property
    def all(self) -> list[Grid]:
        """The grid of the map, then the wide and the narrow grid of each step."""
        return [self.first, *(grid for step in self.steps for grid in (step.wide, step.narrow))]

    def spectra(
        self, maps: list[Array | None], workers: int | None = None, kernel: Array | None = None
    ) -> list[Loads]:
        """Spectra of loads (None: no load) on each grid, in the order of `all`.

        `kernel` is the transform of the kernel with which the maps are read, on the first grid,
        whose own spectra are those of the pixels.
        """
        first = self.first
        (ny, nx), (dy, dx), shape = first.window, first.pixel_size, first.modes.shape
        loads = [None if m is None else spectrum(m, shape, workers) for m in maps]
        found = [loads]
        if not self.steps:
            return found
        period, centre = self.steps[0].period, (0.5 * (ny - 1) * dy, 0.5 * (nx - 1) * dx)
        read = 1.0 if kernel is None else kernel
        lows = [None if q is None else _low(q * read, shape) * (dy * dx) for q in loads]
        lows = [None if q is None else _shifted(q, period, centre) for q in lows]
        for step in self.steps:
            smooth = [None if low is None else _smooth_load(low, step) for low in lows]
            for grid in (step.wide, step.narrow):
                size = grid.modes.shape
                found.append([None if m is None else spectrum(m, size) for m in smooth])
            lows = _long_waves(found[-2], step)
        return found


def grids_of(
    shape: tuple[int, int], pixel_size: Pair, mean: Mean, padding: float
) -> Grids | StripGrids:
    """Grids on which the fields of a map of tractions are computed.

    Parameters
    ----------
    shape, pixel_size
        Pixels (ny, nx) of the map and their size (dy, dx) [m].
    mean : {"periodic", "free", "x", "y"}
        Outside of the map: periodic images, no load, or periodic images along one axis alone.
    padding : float
        But for "periodic": distance of the remaining images over the side of the map.

    Raises
    ------
    DescriptionError
        For another mean, or a padding below 1.

    Examples
    --------
    >>> len(grids_of((8, 8), (1.0, 1.0), "free", 32.0).all)
    5
    """
    if mean not in ("periodic", "free", "x", "y"):
        raise DescriptionError("planes.mean", mean, 'be "periodic", "free", "x" or "y"')
    if mean == "periodic":
        return Grids(Grid(grid_of_modes(shape, pixel_size), pixel_size, shape), ())
    if not 1.0 <= padding < np.inf:
        raise DescriptionError("planes.padding", padding, "be 1 or more, and finite")
    if mean != "free":
        return strip_grids(shape, pixel_size, mean, padding)
    return isolated_grids(shape, pixel_size, padding)


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


def isolated_grids(window: tuple[int, int], pixel_size: Pair, padding: float) -> Grids:
    """Grid of an isolated load, and the steps that remove its periodic images.

    Parameters
    ----------
    window : (ny, nx)
        Shape of the map.
    pixel_size : (dy, dx)
        [m].
    padding : float
        Distance of the remaining images, over the side of the map.

    Returns
    -------
    Grids
        Without steps if `padding` is at most 4: the grid itself is then that large.

    Examples
    --------
    >>> grids = isolated_grids((8, 8), (1.0, 1.0), 32.0)
    >>> grids.first.modes.shape, [step.wide.modes.shape for step in grids.steps]
    ((16, 16), [(256, 256), (256, 256)])
    """
    direct = padding <= WIDER
    shape = padded_shape(window, pixel_size, padding if direct else NARROWEST)
    first = Grid(grid_of_modes(shape, pixel_size), pixel_size, window)
    if direct:
        return Grids(first, ())
    period = shape[0] * pixel_size[0], shape[1] * pixel_size[1]
    steps = []
    for _ in range(math.ceil(math.log(padding / NARROWEST, WIDER) - 1e-9)):
        steps.append(_step(period, window, pixel_size))
        period = WIDER * period[0], WIDER * period[1]
    return Grids(first, tuple(steps))


def add_correction(field: Array, wide: Array, narrow: Array, step: WindowStep | LineStep) -> None:
    """Add the correction of a step to one field of a map, in place.

    Examples
    --------
    >>> step = isolated_grids((8, 8), (1.0, 1.0), 32.0).steps[0]
    >>> field = np.zeros((8, 8))
    >>> add_correction(field, np.full((64, 64), 3.0), np.ones((64, 64)), step)
    >>> bool(np.allclose(field, 2.0))
    True
    """
    if isinstance(step, LineStep):
        field += wide - narrow
        return
    field += step.along_y @ (wide - narrow)[step.part] @ step.along_x.T


def _step(period: Pair, window: tuple[int, int], pixel_size: Pair) -> WindowStep:
    coarse = period[0] / COARSE, period[1] / COARSE
    wide, narrow = (
        Grid(grid_of_modes((size, size), coarse), coarse, (COARSE, COARSE))
        for size in (WIDER * COARSE, COARSE)
    )
    (in_y, along_y), (in_x, along_x) = (
        _splines(n, d, c) for n, d, c in zip(window, pixel_size, coarse, strict=True)
    )
    return WindowStep(period, wide, narrow, (in_y, in_x), along_y, along_x)


def _long_waves(loads: Loads, step: WindowStep) -> Loads:
    """Long waves of the loads on the wide grid of a step, for the next one.

    They are transforms (integrals, about the centre of the map) on the modes of a grid of COARSE
    points a side.
    """
    coarse = step.wide.pixel_size
    far = WIDER * step.period[0], WIDER * step.period[1]
    middle = 0.5 * step.period[0], 0.5 * step.period[1]
    unit = coarse[0] * coarse[1] / _smoothing(far, coarse)
    lows = [None if q is None else _low(q, step.wide.modes.shape) * unit for q in loads]
    return [None if low is None else _shifted(low, far, middle) for low in lows]


def _smooth_load(low: Complex, step: WindowStep) -> Array:
    """Load on the coarse grid, the centre of the map at its middle."""
    period, coarse = step.period, step.wide.pixel_size
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
