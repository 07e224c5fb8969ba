"""Normal displacement of the bodies in contact under tangential tractions between them."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING

import numpy as np

from ...elasticity.stress.tractions import traction_coupling

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from ...elasticity.layer_stack import Layers
    from ...scene.window import Grid

    Map = NDArray[np.float64]

__all__ = ["TractionEffect", "coupling_of", "relative_coupling"]

TractionEffect = Callable[["Map | None", "Map | None"], "Map"]
"""Tractions along x and y on the lower body [Pa] to the normal displacement [m], (ny, nx) each."""

_ROUND_OFF = 1e-9  # of the displacement under the largest pressure on the whole window


def coupling_of(
    grid: Grid, lower: Layers | None, upper: Layers | None, workers: int | None = None
) -> TractionEffect:
    """Return the normal displacement that tractions cause, as a function of them.

    That of the lower body under the tractions, and of the upper one under their opposite: it
    closes the gap of the one where it opens that of the other, and two equal bodies have none.

    Parameters
    ----------
    grid : Grid
        Pixels of the window.
    lower, upper : Layers or None
        The bodies; None for a rigid one.
    workers : int, optional
        Threads of the transforms.

    Returns
    -------
    callable
        ``(traction_x, traction_y)`` on the lower body [Pa], (ny, nx) or None, to the displacement
        that separates the surfaces [m], (ny, nx), positive as that of a pressure.

    Raises
    ------
    DescriptionError
        As `traction_coupling`.
    """
    bodies = [(1.0, lower), (-1.0, upper)]
    couplings = [
        (
            sign,
            traction_coupling(
                grid.shape,
                grid.pixel_size,
                layers,
                mean="periodic" if grid.periodic else "free",
                workers=workers,
            ),
        )
        for sign, layers in bodies
        if layers is not None
    ]

    def displacement(traction_x: Map | None, traction_y: Map | None) -> Map:
        total: Map = np.zeros(grid.shape)
        for sign, coupling in couplings:
            total += coupling(
                None if traction_x is None else sign * traction_x,
                None if traction_y is None else sign * traction_y,
            )
        return total

    return displacement


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
