"""Direct solution on few moving pixels, where gathering the whole map would cost more.

Sign convention: pressure and displacement positive into the solid.

======  ==========================================================
symbol  meaning
======  ==========================================================
K       displacement of a map under unit pressure on its first pixel
G       influence matrix between the moving pixels
======  ==========================================================
"""

from __future__ import annotations

import numpy as np
import scipy.linalg
from numpy.typing import NDArray

__all__ = ["few_enough", "influence_matrix", "solve_directly"]

Floats = NDArray[np.float64]


def few_enough(moving: int, pixels: int) -> bool:
    """Whether factorising costs less than a few transforms of the map.

    Examples
    --------
    >>> few_enough(100, 256 * 256), few_enough(10_000, 256 * 256)
    (True, False)
    """
    return bool(moving <= min(1000.0, 7.0 * pixels ** (1.0 / 3.0)))


def influence_matrix(K: Floats, at: NDArray[np.intp], shape: tuple[int, int]) -> Floats:
    """Displacement of the moving pixels under unit pressure on each of them.

    Parameters
    ----------
    K : ndarray (ny, nx) or (ny // 2 + 1, nx // 2 + 1)
        Response to the pixel (0, 0), even in both distances, as every layered solid has it; of a
        periodic map only distances up to the middle.
    at : ndarray (m,)
        Flat indices in the map.
    shape : tuple of int
        Pixels of the map.

    Examples
    --------
    >>> influence_matrix(np.array([[3.0, 1.0]]), np.array([0, 1]), (1, 3))
    array([[3., 1.],
           [1., 3.]])
    """
    row, column = np.divmod(at, shape[1])
    dy, dx = np.abs(row[:, None] - row), np.abs(column[:, None] - column)
    if K.shape != shape:
        np.minimum(dy, shape[0] - dy, out=dy)
        np.minimum(dx, shape[1] - dx, out=dx)
    return np.asarray(K[dy, dx])


def solve_directly(G: Floats, r: Floats, total: float | None) -> Floats | None:
    """Pressures with ``G x = r`` up to a constant that makes them sum to `total`.

    Parameters
    ----------
    G : ndarray (m, m)
        Influence matrix; overwritten.
    r : ndarray (m,)
        Wanted displacement.
    total : float, optional
        Sum of the pressures; without it the constant is zero.

    Returns
    -------
    ndarray (m,) or None
        None if the matrix is not positive definite to rounding.

    Examples
    --------
    >>> solve_directly(np.diag([1.0, 2.0]), np.array([0.0, 1.0]), 2.0)
    array([1., 1.])
    """
    if total is not None:
        G += G[0, 0]  # no effect on the answer; lifts the null space of a full periodic map
    try:
        factor = scipy.linalg.cho_factor(G, overwrite_a=True, check_finite=False)
    except np.linalg.LinAlgError:
        return None
    x = np.asarray(scipy.linalg.cho_solve(factor, r))
    if total is None:
        return x
    y = np.asarray(scipy.linalg.cho_solve(factor, np.ones_like(r)))
    return np.asarray(x + y * ((total - float(x.sum())) / float(y.sum())))
