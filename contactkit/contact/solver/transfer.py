"""Grid transfer: shapes of the nested grids, restriction and prolongation between them.

A coarse pixel takes the average of the fine ones it covers, parts counted by their area, so that
any number of pixels can be coarsened and neither mean height nor load changes.
"""

from __future__ import annotations

import functools

import numpy as np
import scipy.sparse
from numpy.typing import NDArray

__all__ = ["averaging_weights", "block_shape", "nested_shapes", "prolong", "restrict"]

Floats = NDArray[np.float64]
Shape = tuple[int, int]


def nested_shapes(shape: Shape, pixel_size: tuple[float, float], coarsest: int = 64) -> list[Shape]:
    """Shapes of the nested grids, finest first; long pixels are first made square.

    Parameters
    ----------
    shape : tuple of int
        Pixels ``(ny, nx)`` of the map.
    pixel_size : tuple of float
        ``(dy, dx)`` [m].
    coarsest : int
        A side of at most this many pixels is not coarsened further.

    Examples
    --------
    >>> nested_shapes((256, 256), (1.0, 1.0))
    [(256, 256), (128, 128), (64, 64)]
    >>> nested_shapes((101, 400), (1.0, 0.25))
    [(101, 400), (101, 200), (101, 100), (51, 50)]
    """
    (ny, nx), (dy, dx) = shape, pixel_size
    shapes = [(ny, nx)]
    while max(ny, nx) > coarsest:
        halve_y = ny > 8 and not dy > 1.5 * dx
        halve_x = nx > 8 and not dx > 1.5 * dy
        if not (halve_y or halve_x):  # a narrow strip: only its long side is left
            halve_y, halve_x = ny > nx, nx >= ny
        if halve_y:
            dy, ny = dy * ny / -(-ny // 2), -(-ny // 2)
        if halve_x:
            dx, nx = dx * nx / -(-nx // 2), -(-nx // 2)
        shapes.append((ny, nx))
    return shapes


def block_shape(shape: Shape, pixel_size: tuple[float, float], pixels: float = 8.0) -> Shape:
    """Number of blocks along both sides, each about `pixels` squared in area and square in metres.

    Examples
    --------
    >>> block_shape((256, 256), (1.0, 1.0))
    (32, 32)
    """
    aspect = np.sqrt(pixel_size[1] / pixel_size[0])
    wanted = (shape[0] / (pixels * aspect), shape[1] * aspect / pixels)
    return (
        min(shape[0], max(1, round(wanted[0]))),
        min(shape[1], max(1, round(wanted[1]))),
    )


@functools.lru_cache(maxsize=64)
def averaging_weights(fine: int, coarse: int) -> scipy.sparse.csr_array:
    """Weight of each fine pixel in the average of each coarse one, ``(coarse, fine)``."""
    edges = np.union1d(np.arange(fine + 1) / fine, np.arange(coarse + 1) / coarse)
    edges = edges[np.append(True, np.diff(edges) > 1e-12)]
    middle, width = 0.5 * (edges[1:] + edges[:-1]), np.diff(edges)
    row, column = (middle * coarse).astype(int), (middle * fine).astype(int)
    return scipy.sparse.csr_array((width * coarse, (row, column)), shape=(coarse, fine))


def restrict(fine: Floats, shape: Shape) -> Floats:
    """Average a map over the pixels of a coarser grid.

    Parameters
    ----------
    fine : ndarray (ny, nx)
        Map, any unit.
    shape : tuple of int
        The coarser grid.

    Examples
    --------
    >>> restrict(np.array([[1.0, 3.0, 5.0], [1.0, 3.0, 5.0]]), (1, 2))
    array([[1.66666667, 4.33333333]])
    """
    if fine.shape == (2 * shape[0], 2 * shape[1]):
        rows = fine[0::2] + fine[1::2]
        return 0.25 * (rows[:, 0::2] + rows[:, 1::2])
    rows = averaging_weights(fine.shape[0], shape[0]) @ fine
    return np.ascontiguousarray((averaging_weights(fine.shape[1], shape[1]) @ rows.T).T)


def prolong(coarse: Floats, shape: Shape, out: Floats | None = None) -> Floats:
    """Spread a map over a finer grid, each fine pixel with the value of the coarse one.

    Parameters
    ----------
    coarse : ndarray (ny, nx)
        Map, any unit.
    shape : tuple of int
        The finer grid.
    out : ndarray, optional
        Where to; another array than `coarse`.

    Examples
    --------
    >>> prolong(np.array([[1.0, 2.0]]), (1, 4))
    array([[1., 1., 2., 2.]])
    """
    made = np.empty(shape) if out is None else out
    if shape == (2 * coarse.shape[0], 2 * coarse.shape[1]):
        made[0::2] = np.repeat(coarse, 2, axis=1)
        made[1::2] = made[0::2]
        return made
    rows = averaging_weights(shape[0], coarse.shape[0]).T @ coarse * (shape[0] / coarse.shape[0])
    wide = averaging_weights(shape[1], coarse.shape[1]).T @ rows.T * (shape[1] / coarse.shape[1])
    made[...] = wide.T
    return made
