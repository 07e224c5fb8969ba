r"""A three by three stencil that undoes the operator for waves as short as a few pixels.

Sign convention: none; symbols are real and even.

======  ===================================================
symbol  meaning
======  ===================================================
S       symbol of the operator
c       weights of the stencil: centre, y, x, diagonal
======  ===================================================
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

__all__ = ["Stencil", "inverse_stencil", "least_eigenvalue"]

Floats = NDArray[np.float64]
SAFE = 0.1  # least eigenvalue to keep, as a part of the centre weight


class Stencil(NamedTuple):
    """Weights of a symmetric three by three stencil: centre, y, x and diagonal neighbours."""

    centre: float
    y: float
    x: float
    diagonal: float


def least_eigenvalue(c: Stencil) -> float:
    r"""Smallest value of the symbol of a stencil.

    .. math:: t = c_0 + 2 c_y \cos a + 2 c_x \cos b + 4 c_d \cos a \cos b

    is linear in either cosine, so that its minimum is at a corner.

    Examples
    --------
    >>> least_eigenvalue(Stencil(4.0, -1.0, -1.0, 0.0))
    0.0
    """
    return min(
        c.centre + 2.0 * c.y * a + 2.0 * c.x * b + 4.0 * c.diagonal * a * b
        for a in (-1.0, 1.0)
        for b in (-1.0, 1.0)
    )


def inverse_stencil(symbol: Floats, width: int) -> Stencil:
    """Cut the inverse of an operator to nearest neighbours, and keep it positive definite.

    The inverse of a stiff layer, cut sharply, may be indefinite. Its neighbours are then weighed
    down towards the triangular window, with which any positive symbol stays positive.

    Parameters
    ----------
    symbol : ndarray (ny, width // 2 + 1)
        Half spectrum of the operator; wavenumber 0 may be zero.
    width : int
        Columns of the map that the spectrum belongs to.

    Examples
    --------
    >>> inverse_stencil(np.full((8, 5), 2.0), 8).centre
    0.5
    """
    ny = symbol.shape[0]
    floor = 1e-3 * float(np.median(symbol))
    k = 1.0 / np.maximum(symbol, floor)
    k[0, 0] = 0.0 if symbol[0, 0] <= floor else k[0, 0]
    k[:, 1:] *= 2.0
    if width % 2 == 0:
        k[:, -1] *= 0.5
    k /= ny * width
    a = np.cos(2.0 * np.pi * np.arange(ny) / ny)
    b = np.cos(2.0 * np.pi * np.arange(symbol.shape[1]) / width)
    by_row, by_column = k.sum(axis=1), k.sum(axis=0)
    full = Stencil(float(by_row.sum()), float(a @ by_row), float(b @ by_column), float(a @ k @ b))
    for window in np.linspace(1.0, 0.5, 26):
        c = Stencil(full.centre, window * full.y, window * full.x, window**2 * full.diagonal)
        if least_eigenvalue(c) >= SAFE * c.centre:
            return c
    return c
