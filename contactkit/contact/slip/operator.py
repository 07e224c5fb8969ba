"""Tangential displacement of the pixels in contact under the tractions on them, by transforms.

Tractions and displacements are arrays (k, n) of k components on n pixels: one along the load, or
those along x and y. Of an isolated contact only the rectangle around it is transformed.

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
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray
from scipy import fft

from ...elasticity.layer_stack import Layers
from ...elasticity.tangential import TangentialCompliance, isolated_compliance, periodic_symbol
from ...scene.window import Grid

__all__ = ["TangentialOperator", "tangential_operator"]

Array = NDArray[np.float64]
Rows = list[list[Array]]
_SMALLEST = 8  # pixels along the sides of the rectangle around an isolated contact


class _Place(NamedTuple):
    """Rectangle of the window that is transformed: its first pixel, and how it is padded."""

    first: tuple[int, int]
    shape: tuple[int, int]
    padded: tuple[int, int]

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
        self, place: _Place, at: NDArray[np.intp], symbol: Rows, inverse: Rows, is_uniform: bool
    ) -> None:
        self._place, self._at, self._symbol, self._inverse = place, at, symbol, inverse
        self._is_uniform = is_uniform
        self._applied = [0]
        self.components = len(symbol)
        twice = [2.0 * float(s.sum()) - float(s[:, 0].sum()) for s in (symbol[0][0],)]
        if place.padded[1] % 2 == 0:
            twice[0] -= float(symbol[0][0][:, -1].sum())
        self.own = twice[0] / (place.padded[0] * place.padded[1])
        self.largest = float(sum(np.abs(row).max() for row in symbol[0]))

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
        return self._convolve(traction, self._symbol, self._place.padded)

    def inverse(self, displacement: Array) -> Array:
        """Tractions that displace the pixels by about `displacement`."""
        return self._convolve(displacement, self._inverse, self._place.shape)

    def _convolve(self, given: Array, symbol: Rows, padded: tuple[int, int]) -> Array:
        (ny, nx), at = self._place.shape, self._at
        maps = np.zeros((len(given), ny * nx))
        maps[:, at] = given
        spectra = [fft.rfft2(one.reshape(ny, nx), s=padded) for one in maps]
        found = np.empty_like(given)
        for i, row in enumerate(symbol):
            total = row[0] * spectra[0]
            for s, spectrum in zip(row[1:], spectra[1:], strict=True):
                total += s * spectrum
            found[i] = fft.irfft2(total, s=padded)[:ny, :nx].ravel()[at]
        return found


def tangential_operator(
    grid: Grid,
    touching: NDArray[np.bool_],
    stacks: tuple[Layers, ...],
    angle: float,
    components: int,
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
    """

    def waves(shape: tuple[int, int]) -> Rows:
        total = _summed([periodic_symbol(shape, grid.pixel_size, one) for one in stacks])
        return _rows(_turned(total, angle), components)

    if grid.periodic:
        rows, place = waves(grid.shape), _Place((0, 0), grid.shape, grid.shape)
        is_uniform = rows[0][0][0, 0] == 0.0
        return TangentialOperator(
            place, np.flatnonzero(touching), rows, _inverted(rows), is_uniform
        )
    first, shape = _around(touching)
    place = _Place(first, shape, (2 * shape[0], 2 * shape[1]))
    kernels = [isolated_compliance(shape, grid.pixel_size, one) for one in stacks]
    symbols = TangentialCompliance(*(_transformed(one) for one in _signed(_summed(kernels))))
    rows = _rows(_turned(symbols, angle), components)
    at = place.indices(touching)
    assert at is not None  # the rectangle is made around them
    # The inverse falls off fast in space: that of the rectangle repeated is a good one.
    return TangentialOperator(place, at, rows, _inverted(waves(shape)), False)


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
