"""Displacement of maps without periodic images: convolution with influence coefficients."""

from __future__ import annotations

import numpy as np
from attrs import frozen
from numpy.typing import NDArray
from scipy.fft import next_fast_len

from ..numerics.fft import Transform, fast_transforms_installed, make_transform
from . import influence
from .layer_stack import Layers
from .layered import compliance

__all__ = ["IsolatedMap", "isolated_map"]

Array = NDArray[np.float64]


@frozen(eq=False)
class IsolatedMap:
    """Elastic bodies under a map of pressures; made by `isolated_map`.

    Parameters
    ----------
    convolve, convolve_single : callable
        Write the displacement of a map of `shape` into another, in double and single precision.
    shape : tuple of int
        Pixels of the largest map.
    solids : tuple of Layers
        The bodies.
    largest : float
        Largest factor of the symbol [m/Pa], over which that of single precision is taken.
    """

    convolve: Transform
    convolve_single: Transform
    shape: tuple[int, int]
    solids: tuple[Layers, ...]
    largest: float

    def displacement(self, pressure: Array) -> Array:
        """Displacement of both surfaces [m] by a map of pressures [Pa], in the shape of the map.

        Maps may be smaller than `shape`.
        """
        ny, nx = pressure.shape
        source, found = np.zeros(self.shape), np.empty(self.shape)
        source[:ny, :nx] = pressure
        self.convolve(source, found)
        return found[:ny, :nx]

    def rough_displacement(self, pressure: Array) -> Array:
        """Displacement, right to some 1e-6 of its largest, in half of the time."""
        ny, nx = pressure.shape
        source, found = np.zeros(self.shape, np.float32), np.empty(self.shape, np.float32)
        # In single precision pressures of 1e-30 Pa, or squares of those of 1e20 Pa, are lost.
        scale = float(np.abs(pressure).max())
        if scale == 0.0:
            return np.zeros((ny, nx))
        source[:ny, :nx] = pressure / scale
        self.convolve_single(source, found)
        return found[:ny, :nx].astype(np.float64) * (scale * self.largest)

    def at_wavenumber(self, wavenumber: Array) -> Array:
        """Displacement per pressure [m/Pa] of waves [1/m], of bodies without edges."""
        return np.asarray(sum(compliance(wavenumber, *solid).C for solid in self.solids))


def isolated_map(
    shape: tuple[int, int], pixel_size: tuple[float, float], *solids: Layers
) -> IsolatedMap:
    """Prepare the displacement of maps of one shape.

    Parameters
    ----------
    shape : tuple of int
        Pixels (ny, nx) of the largest map; rounded up to what transforms fast.
    pixel_size : tuple of float
        Sides (dy, dx) of a pixel [m].
    *solids : Layers
        The elastic bodies, whose displacements add.

    Raises
    ------
    DescriptionError
        For materials that are none.

    See Also
    --------
    influence.symbol : the coefficients, and their error.

    Examples
    --------
    A pixel of side 1 under unit pressure, Love's 4 ln(1 + sqrt 2)/pi.

    >>> one = isolated_map((1, 1), (1.0, 1.0), Layers([1.0], [0.0]))
    >>> one.displacement(np.ones((1, 1))).round(5).tolist()
    [[1.1222]]
    >>> one.at_wavenumber(np.array([2.0])).tolist()
    [1.0]
    """
    # Of 258 x 258 pixels a transform takes twice the time that it does of 270 x 270.
    ny, nx = (next_fast_len(n, real=True) for n in shape)
    symbol = np.asarray(sum(influence.symbol((ny, nx), pixel_size, *solid) for solid in solids))
    fast = fast_transforms_installed()
    largest = float(np.abs(symbol).max())
    convolve, single = (
        make_transform(one, (ny, nx), periodic=False, fast=fast)
        for one in (symbol, (symbol / largest).astype(np.float32))
    )
    return IsolatedMap(convolve, single, (ny, nx), solids, largest)
