"""Coupling of normal and tangential displacements of the bodies in contact, by transforms.

======  ======================================================================
symbol  meaning
======  ======================================================================
B       normal displacement under unit tangential tractions [m/Pa]
B^T     tangential displacement under unit pressure: by reciprocity, transposed
S       symbol of B over i: it is real, as B is odd in space
======  ======================================================================
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np
from scipy import fft

from ...elasticity.layered import compliance
from ...elasticity.stress.isolated import Mean
from ...elasticity.stress.tractions import traction_coupling
from ..solver.convolution import symbol_width

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from ...elasticity.layer_stack import Layers
    from ...scene.window import Grid

    Map = NDArray[np.float64]

__all__ = ["CouplingOperator", "coupling_of", "coupling_strength", "relative_coupling"]

# Wavenumbers per factor of e at which the strength is read: of films on bases it is smooth over the
# thickness, and eight find its maximum to 1e-3.
_PER_E = 8
_ROUND_OFF = 1e-9  # of the displacement under the largest pressure on the whole window


class CouplingOperator:
    """B and its transpose between the pixels of a window.

    Called with tractions along x and y on the lower body [Pa], (ny, nx) or None, it returns the
    displacement that separates the surfaces [m], (ny, nx), positive as that of a pressure.

    Parameters
    ----------
    symbols : pair of ndarray
        S for tractions along x and y, of the map if periodic, else of the doubled map [m/Pa].
    shape, padded : (ny, nx)
        Of the map, and of the map that is transformed.
    workers : int, optional
        Threads of the transforms.

    Attributes
    ----------
    count : int
        Applications of B and of its transpose.
    """

    def __init__(
        self,
        symbols: tuple[Map, Map],
        shape: tuple[int, int],
        padded: tuple[int, int],
        workers: int | None = None,
    ) -> None:
        self.count = 0
        self._symbols, self._shape, self._padded = symbols, shape, padded
        self._workers = workers

    def __call__(self, traction_x: Map | None, traction_y: Map | None) -> Map:
        """Normal displacement [m] under tractions [Pa]: B q."""
        self.count += 1
        total = np.zeros(self._symbols[0].shape, dtype=np.complex128)
        for traction, symbol in zip((traction_x, traction_y), self._symbols, strict=True):
            if traction is not None:
                total += symbol * self._spectrum(traction)
        return self._map(1j * total)

    def of_pressure(self, pressure: Map) -> tuple[Map, Map]:
        """Displacement [m] along x and y of the lower body past the upper one: B^T p."""
        self.count += 1
        spectrum = -1j * self._spectrum(pressure)
        x, y = (self._map(symbol * spectrum) for symbol in self._symbols)
        return x, y

    def _spectrum(self, values: Map) -> NDArray[np.complex128]:
        return np.asarray(fft.rfft2(values, s=self._padded, workers=self._workers))

    def _map(self, spectrum: NDArray[np.complex128]) -> Map:
        ny, nx = self._shape
        return np.asarray(fft.irfft2(spectrum, s=self._padded, workers=self._workers)[:ny, :nx])


def coupling_of(
    grid: Grid, lower: Layers | None, upper: Layers | None, workers: int | None = None
) -> CouplingOperator:
    """Make the operator between normal and tangential displacements of two bodies in contact.

    The lower body carries the tractions, the upper one their opposite: it closes the gap where the
    other opens it, and two equal bodies have no coupling.

    Parameters
    ----------
    grid : Grid
        Pixels of the window.
    lower, upper : Layers or None
        The bodies; None for a rigid one.
    workers : int, optional
        Threads of the transforms.

    Raises
    ------
    DescriptionError
        As `traction_coupling`.
    """
    ny, nx = grid.shape
    mean: Mean = grid.along or ("periodic" if grid.periodic else "free")
    responses = [np.zeros((ny, nx)), np.zeros((ny, nx))]
    unit = np.zeros((ny, nx))
    unit[0, 0] = 1.0
    for sign, layers in ((1.0, lower), (-1.0, upper)):
        if layers is not None:
            coupling = traction_coupling(
                grid.shape, grid.pixel_size, layers, mean=mean, workers=workers
            )
            responses[0] += sign * coupling(unit, None)
            responses[1] += sign * coupling(None, unit)
    padded = ny if grid.repeats[0] else 2 * ny, symbol_width(nx, grid.edges)
    if padded[0] > ny:
        responses = [_mirrored(responses[0], 1.0), _mirrored(responses[1], -1.0)]
    if padded[1] > nx:
        responses = [
            _mirrored(one.T, sign).T for one, sign in zip(responses, (-1.0, 1.0), strict=True)
        ]
    x, y = (np.ascontiguousarray(fft.rfft2(one, workers=workers).imag) for one in responses)
    return CouplingOperator((x, y), grid.shape, padded, workers)


def coupling_strength(grid: Grid, lower: Layers | None, upper: Layers | None) -> float:
    r"""Normal displacement by a traction over that by an equal pressure, at most [-].

    .. math:: \max_\alpha \left|F_{12}^l - F_{12}^u\right| / (C^l + C^u)

    over the wavenumbers of a window. For half-spaces all are alike, Dundurs' second constant;
    times a coefficient of friction it is the norm of the coupling in that of the compliance.

    Parameters
    ----------
    grid : Grid
        Pixels of the window.
    lower, upper : Layers or None
        The bodies; None for a rigid one.

    Raises
    ------
    DescriptionError
        As `layered.compliance`.

    Examples
    --------
    >>> from contactkit.elasticity.layer_stack import Layers
    >>> from contactkit.scene.window import Grid
    >>> grid = Grid((8, 8), (1e-9, 1e-9), periodic=True)
    >>> round(coupling_strength(grid, Layers([1e9], [0.3]), None), 4)  # (1 - 2 nu)/(2 (1 - nu))
    0.2857
    """
    sides = [n * d for n, d in zip(grid.shape, grid.pixel_size, strict=True)]
    dy, dx = grid.pixel_size
    low, high = 2.0 * math.pi / max(sides), math.pi * math.hypot(1.0 / dy, 1.0 / dx)
    wavenumbers = np.geomspace(low, high, int(_PER_E * math.log(high / low)) + 2)
    coupled, pressed = np.zeros_like(wavenumbers), np.zeros_like(wavenumbers)
    for sign, layers in ((1.0, lower), (-1.0, upper)):
        if layers is not None:
            found = compliance(wavenumbers, *layers)
            coupled += sign * found.F12
            pressed += found.C
    return float(np.abs(coupled / pressed).max())


def _mirrored(half: Map, sign: float) -> Map:
    """Response at all offsets along the first axis, even or odd, from those of one sign."""
    return np.concatenate((half, np.zeros_like(half[:1]), sign * half[:0:-1]))


def relative_coupling(caused: Map, pressed: Map, least: float) -> float:
    """Range of a displacement by tractions over that of the displacement by pressure [-].

    Ranges, as in a periodic window neither displacement has a datum. Below 1e-9 of `least` [m], a
    displacement of the size of the scene, the one by pressure is round-off, as of flat surfaces.

    Examples
    --------
    >>> relative_coupling(np.array([1.0, -1.0]), np.array([40.0, 0.0]), 100.0)
    0.05
    """
    scale = max(float(np.ptp(pressed)), _ROUND_OFF * least)
    return float(np.ptp(caused)) / scale if scale > 0.0 else 0.0
