"""Linear response of a contact whose pixels in contact stay what they are.

Pressures on given pixels that give these a displacement, up to a constant if their sum is given:
the equations of a solved contact once more, with another right-hand side. They are symmetric, so
that the same solve is that of the adjoint equations. The reduced system of the active set solves
them in single precision; residuals in double precision refine it.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from .nested_grids import GridLevel
from .reduced_system import ReducedSystem

__all__ = ["LinearResponse", "linear_response"]

Floats = NDArray[np.float64]
# Residual that one refinement leaves of the one before, at best: single precision. Asking for less
# (1e-2) takes more exact applications, for more (1e-6) conjugate gradients that round-off ends.
_REDUCTION = 1e-4
_MOST = 20  # refinements: three to 1e-10 on half-spaces, up to seven under stiff films


class LinearResponse(NamedTuple):
    """Dimensionless pressures (flat, zero on other pixels), the constant, and the residual left.

    `residual` is the largest over the size of the right-hand side [-].
    """

    pressure: Floats
    shift: float
    residual: float


def linear_response(
    grid: GridLevel, at: NDArray[np.intp], right: Floats, total: float | None, rtol: float
) -> LinearResponse:
    """Solve ``G x - shift = right`` on some pixels, with the sum of x or with no shift.

    Parameters
    ----------
    grid : GridLevel
        Finest grid of a solver; its maps are overwritten.
    at : ndarray (m,)
        Flat indices of the pixels, sorted.
    right : ndarray (m,)
        Wanted displacements.
    total : float, optional
        Sum of the pressures; None for no shift.
    rtol : float
        Residual over the size of the right-hand side.
    """
    pressure = grid.pressure.ravel()
    pressure[...] = 0.0
    x, shift, is_shifted = np.zeros(at.size), 0.0, total is not None
    scale = float(np.abs(right).max(initial=0.0)) + abs(total or 0.0) / max(at.size, 1)
    left = 0.0
    for _ in range(_MOST if scale > 0.0 and at.size else 0):
        pressure[at] = x
        grid.displace(True)
        r = right - grid.gap.ravel()[at]
        if is_shifted:
            shift = -float(r.mean())
            r += shift
        missing = (total or 0.0) - float(x.sum()) if is_shifted else 0.0
        left = max(float(np.abs(r).max()), abs(missing) / at.size)
        if left <= rtol * scale:
            break
        # Scaled, as right-hand sides of any unit must fit into single precision.
        system = ReducedSystem(grid, at, is_shifted, displaces=False)
        x += left * system.solve(r / left, _REDUCTION, missing / left)
    pressure[...] = 0.0
    found = np.zeros(pressure.size)
    found[at] = x
    return LinearResponse(found, shift, left / scale if scale > 0.0 else 0.0)
