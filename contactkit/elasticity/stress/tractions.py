"""Tractions on a surface, and the normal displacement under tangential ones.

Conventions as in `layered`: z into the solid; a traction q_x > 0 pulls the surface of the solid
towards +x.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ...errors import DescriptionError
from ..layer_stack import Layers
from ..layered import compliance
from .isolated import Mean, WindowStep, add_correction, grids_of
from .periodic import Grid, into_space
from .strips import LineStep

__all__ = ["Tractions", "traction_coupling"]

Array = NDArray[np.float64]
Complex = NDArray[np.complex128]
Pair = tuple[float, float]


class Tractions(NamedTuple):
    """Tractions on a surface [Pa], maps (ny, nx) of pixels of a size (dy, dx) [m]; None for none.

    `pressure` acts into the solid, `x` and `y` along the surface.
    """

    pixel_size: Pair
    pressure: ArrayLike | None = None
    x: ArrayLike | None = None
    y: ArrayLike | None = None

    @property
    def shape(self) -> tuple[int, int]:
        """Pixels (ny, nx)."""
        ny, nx = next(np.shape(m) for m in self[1:] if m is not None)
        return ny, nx

    def checked(self) -> list[Array | None]:
        """Return pressure, x and y as arrays.

        Raises
        ------
        DescriptionError
            For maps of different shapes or with non-finite values, no map, or an impossible pixel.
        """
        given = (self.pressure, self.x, self.y)
        maps = [None if m is None else np.asarray(m, dtype=np.float64) for m in given]
        shapes = {m.shape for m in maps if m is not None}
        if len(shapes) != 1 or any(len(shape) != 2 or 0 in shape for shape in shapes):
            raise DescriptionError(
                "planes.maps", sorted(shapes), "be at least one map and share one shape (ny, nx)"
            )
        if not all(np.isfinite(m).all() for m in maps if m is not None):
            raise DescriptionError("planes.maps", "nan or inf", "be finite", unit="Pa")
        if not (len(self.pixel_size) == 2 and all(0.0 < d < np.inf for d in self.pixel_size)):
            raise DescriptionError(
                "planes.pixel_size", self.pixel_size, "be two positive lengths (dy, dx)", unit="m"
            )
        return maps


Coupling = Callable[[ArrayLike | None, ArrayLike | None], Array]


def traction_coupling(
    shape: tuple[int, int],
    pixel_size: Pair,
    layers: Layers,
    *,
    mean: Mean = "periodic",
    padding: float = 128.0,
    workers: int | None = None,
) -> Coupling:
    """Normal displacement of the surface under tangential tractions, as a function of them.

    ``uz^ = -i F12 (xi qx^ + eta qy^)/alpha``: the coupling that Goodman's approximation neglects
    in the normal problem; zero for a homogeneous solid with nu = 1/2.

    Parameters
    ----------
    shape, pixel_size, mean, padding
        As in `grids_of`.
    layers : Layers
        As in `layered.compliance`.
    workers : int, optional
        Threads of the transforms.

    Returns
    -------
    callable
        ``(traction_x, traction_y)`` [Pa], (ny, nx) or None, to the displacement into the solid
        [m], (ny, nx), without its mean over the (padded) window.

    Raises
    ------
    DescriptionError
        As `grids_of` and `layered.compliance`.

    Examples
    --------
    Converging tractions raise the surface; here it is pressed in a quarter of a wave later:

    >>> wave = np.cos(2 * np.pi * np.arange(8) / 8)[None, :]
    >>> uz = traction_coupling((1, 8), (1.0, 0.125), Layers([1.0], [0.0]))(wave, None)
    >>> print(np.round(uz[0, [2, 6]] * 2 * np.pi, 6))
    [ 1. -1.]
    """
    grids = grids_of(shape, pixel_size, mean, padding)
    steps: tuple[WindowStep | LineStep, ...] = grids.steps
    compliances = [
        np.concatenate([[0.0], compliance(grid.modes.length, *layers).F12]) for grid in grids.all
    ]

    def displacement(traction_x: ArrayLike | None, traction_y: ArrayLike | None) -> Array:
        maps = Tractions(pixel_size, None, traction_x, traction_y).checked()
        loads = grids.spectra(maps, workers)
        field, *others = (
            _displaced(*one, workers) for one in zip(grids.all, loads, compliances, strict=True)
        )
        for step, wide, narrow in zip(steps, others[::2], others[1::2], strict=True):
            add_correction(field, wide, narrow, step)
        return field

    return displacement


def _displaced(
    grid: Grid, loads: list[Complex | None], compliances: Array, workers: int | None
) -> Array:
    modes = grid.modes
    total = np.zeros(modes.rank.shape, dtype=np.complex128)
    for traction, direction in zip(loads[1:], (modes.x, modes.y), strict=True):
        if traction is not None:
            total += direction * traction
    return into_space(-1j * (compliances[modes.rank] * total), modes, grid.window, workers)
