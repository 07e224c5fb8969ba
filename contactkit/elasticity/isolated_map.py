"""Displacement of maps without periodic images: convolution with influence coefficients."""

from __future__ import annotations

import numpy as np
from attrs import frozen
from numpy.typing import NDArray

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
    convolve : callable
        Writes the displacement of a map into another.
    solids : tuple of Layers
        The bodies.
    """

    convolve: Transform
    solids: tuple[Layers, ...]

    def displacement(self, pressure: Array) -> Array:
        """Displacement of both surfaces [m] by a map of pressures [Pa], in the shape of the map."""
        found = np.empty_like(pressure)
        self.convolve(pressure, found)
        return found

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
        Pixels (ny, nx).
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
    symbol = sum(influence.symbol(shape, pixel_size, *solid) for solid in solids)
    fast = fast_transforms_installed()
    return IsolatedMap(make_transform(np.asarray(symbol), shape, periodic=False, fast=fast), solids)
