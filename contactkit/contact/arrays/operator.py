"""Displacement under pressures on one grid, and about its inverse, for all maps at once.

Sign convention: pressure and displacement are positive into the solid.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
from attrs import frozen
from numpy.typing import NDArray

from ...numerics.fft import Edges, convolution_of
from ..solver.convolution import SymbolMaker, self_influence, symbol_of, symbol_width
from .namespace import Space

__all__ = ["MapOperator", "map_operator"]

Floats = NDArray[np.float64]
Shape = tuple[int, int]
# Of the largest eigenvalue: what padded influence coefficients have below it is round-off.
LEAST = 1e-12


@frozen(eq=False)
class MapOperator:
    """Operator of one grid; made by `map_operator`.

    Parameters
    ----------
    shape : tuple of int
        Pixels ``(ny, nx)``.
    displace : callable
        Displacements ``(n, ny, nx)`` under as many maps of pressure.
    near_inverse : callable
        Pressures that have about such displacements; symmetric and positive definite.
    self_influence : float
        Displacement of a pixel under unit pressure on itself [m/Pa], before division by the unit.
    uniform : float
        Displacement of a periodic map under uniform unit pressure; 0 otherwise.
    """

    shape: Shape
    displace: Callable[[Any], Any]
    near_inverse: Callable[[Any], Any]
    self_influence: float
    uniform: float


def map_operator(
    space: Space,
    make_symbol: SymbolMaker,
    shape: Shape,
    pixel_size: tuple[float, float],
    periodic: Edges,
    unit: float | None = None,
) -> MapOperator:
    """Prepare the operator of one grid on the device of a space.

    Parameters
    ----------
    space : Space
        Of the maps.
    make_symbol : callable
        As of `ContactSolver`.
    shape : tuple of int
        Pixels.
    pixel_size : tuple of float
        ``(dy, dx)`` [m].
    periodic : bool, "x" or "y"
        Edges of the window.
    unit : float, optional
        Displacement per pressure [m/Pa] that becomes 1; that of a pixel on itself if not given.

    Notes
    -----
    The inverse is ``1 / symbol`` of the map as if it were periodic, cut to the free pixels by the
    caller. Of a padded symbol every second wavenumber is one of the map. On half-spaces it halves
    the iterations, on isolated ones for a fourth of the cost of the operator.
    """
    symbol = symbol_of(make_symbol, shape, pixel_size, periodic)
    own = self_influence(symbol, symbol_width(shape[1], periodic))
    symbol = symbol / (own if unit is None else unit)
    along_y, along_x = (1 if periodic in (True, axis) else 2 for axis in ("y", "x"))
    near = _positive(symbol[::along_y, ::along_x])
    return MapOperator(
        shape,
        convolution_of(space.xp, space.take(symbol), shape, periodic),
        convolution_of(space.xp, space.take(1.0 / near), shape, True),
        own,
        float(symbol[0, 0]) if periodic is True else 0.0,
    )


def _positive(symbol: Floats) -> Floats:
    """Symbol of a preconditioner: at wavenumber 0 at least that of the longest wave."""
    found = np.maximum(symbol, LEAST * float(symbol.max()))
    longest = [float(one.flat[0]) for one in (symbol[1:2, :1], symbol[:1, 1:2]) if one.size]
    found[0, 0] = max(float(symbol[0, 0]), *longest, LEAST * float(symbol.max()))
    return found
