"""Tangential displacement of the pixels in contact under the tractions on them, by transforms.

Tractions and displacements are arrays (k, n) of k components on n pixels: one along the load, or
those along it and across. Of an isolated contact only the rectangle around it is transformed.

======  ==================================================================
symbol  meaning
======  ==================================================================
H       displacement under unit tractions [m/Pa], symmetric and positive
K       influence coefficients, or symbols, of xx, xy and yy
M       approximate inverse of H
======  ==================================================================
"""

from __future__ import annotations

import copy
from collections.abc import Callable
from functools import partial
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray
from scipy import fft

from ...elasticity.layer_stack import Layers
from ...elasticity.tangential import TangentialCompliance, isolated_compliance, periodic_symbol
from ...elasticity.tangential_one_axis import one_axis_symbol
from ...numerics.fft import fast_transforms_installed
from ...scene.window import Edges, Grid
from ..solver.convolution import Convolution, Transforms, self_influence, symbol_width
from ..solver.idle_memory import IdleMemory

__all__ = ["TangentialOperator", "tangential_operator"]

Array = NDArray[np.float64]
Rows = list[list[Array]]
Maker = Callable[[tuple[int, int], tuple[float, float], Layers], TangentialCompliance]
_SMALLEST = 8  # pixels along the sides of the rectangle around an isolated contact


class _Place(NamedTuple):
    """Rectangle of the window that is transformed: its first pixel, shape, and what repeats."""

    first: tuple[int, int]
    shape: tuple[int, int]
    edges: Edges

    def indices(self, touching: NDArray[np.bool_]) -> NDArray[np.intp] | None:
        """Flat indices of pixels (ny, nx) of the window; none if some lie outside."""
        row, column = np.nonzero(touching)
        row, column = row - self.first[0], column - self.first[1]
        (ny, nx) = self.shape
        if row.size and not (
            row[0] >= 0 and row[-1] < ny and column.min() >= 0 and column.max() < nx
        ):
            return None
        return np.asarray(row * nx + column)


class _Convolutions:
    """Convolutions of k maps into k others by the symbols of a symmetric matrix, in one memory."""

    def __init__(self, symbols: Rows, shape: tuple[int, int], edges: Edges, threads: int) -> None:
        transforms = Transforms(threads, fast_transforms_installed())
        first = Convolution(shape, symbols[0][0], edges, transforms)
        maps = first.source, first.target
        self._source, self._target = (one.ravel() for one in maps)
        self._rows = [[first] * len(row) for row in symbols]
        for i in range(len(symbols)):
            for j in range(max(i, 1), len(symbols)):
                idle = IdleMemory(first.spectrum)
                self._rows[i][j] = self._rows[j][i] = Convolution(
                    shape, symbols[i][j], edges, transforms, idle=idle, maps=maps
                )

    def __call__(self, given: Array, at: NDArray[np.intp]) -> Array:
        """Convolve values at pixels, zero elsewhere, to those pixels."""
        found = np.zeros_like(given)
        for j, values in enumerate(given):
            self._source[:] = 0.0
            self._source[at] = values
            for i, row in enumerate(self._rows):
                row[j].run()
                found[i] += self._target[at]
        return found


class TangentialOperator:
    """H between the pixels in contact, and an approximate inverse of it.

    Attributes
    ----------
    own : float
        Displacement of a pixel under unit traction on itself [m/Pa].
    largest : float
        Bound of the eigenvalues of H [m/Pa].
    is_singular : bool
        Whether a uniform traction displaces nothing: a periodic window all in contact.
    """

    def __init__(
        self,
        place: _Place,
        at: NDArray[np.intp],
        symbol: Rows,
        inverse: Rows,
        is_uniform: bool,
        threads: int = 1,
    ) -> None:
        self._place, self._at, self._is_uniform = place, at, is_uniform
        self._applied = [0]
        self.components = len(symbol)
        self.own = self_influence(symbol[0][0], symbol_width(place.shape[1], place.edges))
        self.largest = float(sum(np.abs(row).max() for row in symbol[0]))
        self._forth = _Convolutions(symbol, place.shape, place.edges, threads)
        self._back = _Convolutions(inverse, place.shape, True, threads)

    @property
    def count(self) -> int:
        """Applications of H, also between other pixels."""
        return self._applied[0]

    @property
    def is_singular(self) -> bool:
        """See the class."""
        return self._is_uniform and self._at.size == self._place.shape[0] * self._place.shape[1]

    def between(self, touching: NDArray[np.bool_]) -> TangentialOperator | None:
        """Return the operator between other pixels; none if they do not fit into its rectangle."""
        at = self._place.indices(touching)
        if at is None:
            return None
        made = copy.copy(self)
        made._at = at
        return made

    def __call__(self, traction: Array) -> Array:
        """Displacement [m], (k, n), of the pixels in contact under tractions [Pa], (k, n)."""
        self._applied[0] += 1
        return self._forth(traction, self._at)

    def inverse(self, displacement: Array) -> Array:
        """Tractions that displace the pixels by about `displacement`."""
        return self._back(displacement, self._at)


def tangential_operator(
    grid: Grid,
    touching: NDArray[np.bool_],
    stacks: tuple[Layers, ...],
    angle: float,
    components: int,
    threads: int = 1,
) -> TangentialOperator:
    """Make the operator between pixels in contact.

    Parameters
    ----------
    grid : Grid
        Pixels of the window.
    touching : ndarray (ny, nx)
        Pixels in contact; at least one.
    stacks : tuple of Layers
        The deforming bodies.
    angle : float
        Direction of the first component, from the x axis towards y [rad]; the second is across.
    components : int
        1 or 2.
    threads : int
        Of the transforms.
    """

    def rows(make: Maker, shape: tuple[int, int]) -> Rows:
        total = _summed([make(shape, grid.pixel_size, one) for one in stacks])
        return _rows(_turned(total, angle), components)

    if grid.edges:
        place = _Place((0, 0), grid.shape, grid.edges)
        symbols = inverse = rows(periodic_symbol, grid.shape)
        if grid.along:
            symbols = rows(partial(one_axis_symbol, along=grid.along), grid.shape)
    else:
        place = _Place(*_around(touching), False)
        symbols, inverse = rows(_isolated, place.shape), rows(periodic_symbol, place.shape)
    at = place.indices(touching)
    assert at is not None  # the rectangle is made around them
    is_uniform = grid.periodic and symbols[0][0][0, 0] == 0.0
    # The inverse falls off fast in space: that of the rectangle repeated is a good one.
    return TangentialOperator(place, at, symbols, _inverted(inverse), is_uniform, threads)


def _isolated(
    shape: tuple[int, int], pixel_size: tuple[float, float], layers: Layers
) -> TangentialCompliance:
    """Symbols of an isolated contact, of the rectangle doubled along both axes."""
    kernels = _signed(isolated_compliance(shape, pixel_size, layers))
    return TangentialCompliance(*(_transformed(one) for one in kernels))


def _summed(bodies: list[TangentialCompliance]) -> TangentialCompliance:
    total = bodies[0]
    for one in bodies[1:]:
        total = total.plus(one)
    return total


def _around(touching: NDArray[np.bool_]) -> tuple[tuple[int, int], tuple[int, int]]:
    """First pixel of the rectangle around the pixels in contact, and a shape to transform."""
    first, shape = [], []
    for axis in (1, 0):
        lines = np.flatnonzero(touching.any(axis=axis))
        count = max(int(lines[-1]) + 1 - int(lines[0]), _SMALLEST)
        first.append(int(lines[0]))
        shape.append(int(fft.next_fast_len(count, real=True)))
    return (first[0], first[1]), (shape[0], shape[1])


def _signed(quadrant: TangentialCompliance) -> list[Array]:
    """Coefficients of all offsets, those of the cross term odd in both."""
    found = []
    for one, sign in zip(quadrant, (1.0, -1.0, 1.0), strict=True):
        ny, nx = one.shape[0] - 1, one.shape[1] - 1
        full = np.zeros((2 * ny, 2 * nx))
        full[:ny, :nx] = one[:ny, :nx]
        full[ny + 1 :, :nx] = sign * one[ny - 1 : 0 : -1, :nx]
        full[:, nx + 1 :] = sign * full[:, nx - 1 : 0 : -1]
        found.append(full)
    return found


def _transformed(kernel: Array) -> Array:
    """Symbol of coefficients that are even in both offsets, or odd in both: it is real."""
    return np.ascontiguousarray(fft.rfft2(kernel).real)


def _turned(symbol: TangentialCompliance, angle: float) -> TangentialCompliance:
    """Symbols for components along a direction and across it."""
    if angle == 0.0:
        return symbol
    c, s = np.cos(angle), np.sin(angle)
    xx, xy, yy = symbol
    return TangentialCompliance(
        c * c * xx + 2.0 * c * s * xy + s * s * yy,
        c * s * (yy - xx) + (c * c - s * s) * xy,
        s * s * xx - 2.0 * c * s * xy + c * c * yy,
    )


def _rows(symbol: TangentialCompliance, components: int) -> Rows:
    if components == 1:
        return [[symbol.xx]]
    return [[symbol.xx, symbol.xy], [symbol.xy, symbol.yy]]


def _inverted(rows: Rows) -> Rows:
    """Inverse of periodic symbols, wave by wave; a uniform traction acts like the longest wave."""
    softest = max(float(row[i].max()) for i, row in enumerate(rows))
    filled = [[one.copy() for one in row] for row in rows]
    for i, row in enumerate(filled):
        row[i][0, 0] = row[i][0, 0] or softest
    if len(filled) == 1:
        return [[1.0 / filled[0][0]]]
    (xx, xy), (_, yy) = filled
    over = 1.0 / (xx * yy - xy * xy)
    return [[yy * over, -xy * over], [-xy * over, xx * over]]
