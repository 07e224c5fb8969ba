r"""Equivalent spheres for the wetted islands of a rough contact, one bridge on each.

An island is a connected part of the gap map with a gap below the meniscus height; it is replaced
by a sphere near a flat, with the minimum gap of the island and the curvature either of its summit
or of the sphere with the same area at that height. An axisymmetric bridge, of the liquid of the
island or of a given pressure, forms at it. Gaps [m] are positive where open, arrays ``[y, x]``,
points (y, x); forces are over the surface tension [m], positive where they attract.

==============  ====================================================  =======
symbol          quantity                                              unit
==============  ====================================================  =======
A_i, A_c        area of an island, and of the contact in it           m2
D_i             minimum gap of an island                              m
h_m             gap up to which an island reaches                     m
kappa_i         curvature of its equivalent sphere                    1/m
==============  ====================================================  =======
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray
from scipy import ndimage
from scipy.spatial import cKDTree

__all__ = ["Islands", "curvature_of_area", "measure_islands", "overlapping", "summit_curvature"]

Array = NDArray[np.float64]
Labels = NDArray[np.int64]


class Islands(NamedTuple):
    """Geometry of the n islands of a map."""

    summit: NDArray[np.int64]
    """Pixel of the minimum gap, or of the highest point in contact, (n, 2)."""
    gap: Array
    """Minimum gap D_i [m], 0 in contact, (n,)."""
    area: Array
    """Area A_i [m2], contact included, (n,)."""
    contact_area: Array
    """Area of contact A_c [m2], (n,)."""


def measure_islands(
    names: Labels,
    n: int,
    gap: Array,
    contact: NDArray[np.bool_],
    heights: Array,
    pixel_area: float,
) -> Islands:
    """Gap, area and summit of each island.

    Parameters
    ----------
    names : ndarray of int (ny, nx)
        Label of the island of each pixel, from 1 to `n`; 0 outside.
    n : int
        Number of islands.
    gap, heights : ndarray (ny, nx)
        Gap of the deformed surfaces, and heights before deformation [m].
    contact : ndarray of bool (ny, nx)
        Pixels in contact.
    pixel_area : float
        Area of a pixel [m2].

    Examples
    --------
    >>> gap = np.array([[0.0, 1.0, 9.0, 2.0]])
    >>> found = measure_islands(np.array([[1, 1, 0, 2]]), 2, gap, gap == 0.0, -gap, 1.0)
    >>> found.gap.tolist(), found.area.tolist(), found.summit[1].tolist()
    ([0.0, 2.0], [2.0, 1.0], [0, 3])
    """
    index = np.arange(1, n + 1)
    flat = names.ravel()
    area: Array = pixel_area * np.bincount(flat, minlength=n + 1)[1:].astype(np.float64)
    touching = np.bincount(flat, weights=contact.ravel(), minlength=n + 1)[1:]
    inside: Array = pixel_area * touching.astype(np.float64)
    smallest = np.asarray(ndimage.minimum(gap, names, index), dtype=np.float64).reshape(n)
    # In contact the highest point before deformation; elsewhere the minimum gap.
    rank = np.where(contact, heights - heights.min(), -gap)
    summit = np.asarray(ndimage.maximum_position(rank, names, index), dtype=np.int64)
    smallest = np.where(inside > 0.0, 0.0, np.maximum(smallest, 0.0))
    return Islands(summit.reshape(n, 2), smallest, area, inside)


def curvature_of_area(islands: Islands, height: float) -> Array:
    r"""Curvature [1/m] of the sphere whose section at the height h_m has the area of the island.

    .. math:: \kappa_i = 2\pi (h_m - D_i)/(A_i - A_c)

    Parameters
    ----------
    islands : Islands
        From `measure_islands`.
    height : float
        Maximum gap h_m of the islands [m].

    Notes
    -----
    The force of a thin bridge on it is that of Eq. (2.43), ``gamma c (A_i - A_c)/h_m``. The error
    of a pixel count is a fraction of the perimeter times the pixel size. Infinite for an island in
    full contact, which has no room for liquid.

    Examples
    --------
    >>> one = Islands(np.zeros((1, 2), int), np.array([0.0]), np.array([2 * math.pi]), np.zeros(1))
    >>> curvature_of_area(one, 1.0).tolist()
    [1.0]
    """
    open_area = islands.area - islands.contact_area
    rise = 2.0 * math.pi * (height - islands.gap)
    room = open_area > 0.0
    return np.asarray(np.where(room, rise / np.where(room, open_area, 1.0), np.inf))


def summit_curvature(
    heights: Array,
    summit: NDArray[np.int64],
    pixel_size: tuple[float, float],
    repeats: tuple[bool, bool],
) -> Array:
    """Mean curvature [1/m] at pixels of a height map, from the four neighbours of each.

    Parameters
    ----------
    heights : ndarray (ny, nx)
        Heights [m], peaks positive.
    summit : ndarray of int (n, 2)
        Pixels (y, x).
    pixel_size : (float, float)
        Size (dy, dx) of a pixel [m].
    repeats : (bool, bool)
        Whether the map repeats along y, and along x; otherwise pixels at an edge take the curvature
        of their inner neighbours.

    Notes
    -----
    Dominated by the shortest wavelengths: on most rough surfaces it grows as the pixel shrinks.

    Examples
    --------
    >>> y, x = np.mgrid[-2:3, -2:3]
    >>> ball = -(x**2 + y**2) / 8.0
    >>> summit_curvature(ball, np.array([[2, 2]]), (1.0, 1.0), (False, False)).tolist()
    [0.25]
    """
    shape, (dy, dx) = heights.shape, pixel_size
    y, x = summit[:, 0], summit[:, 1]
    y = y if repeats[0] else np.clip(y, 1, shape[0] - 2)
    x = x if repeats[1] else np.clip(x, 1, shape[1] - 2)
    here = heights[y, x]
    along_y = heights[(y - 1) % shape[0], x] + heights[(y + 1) % shape[0], x] - 2.0 * here
    along_x = heights[y, (x - 1) % shape[1]] + heights[y, (x + 1) % shape[1]] - 2.0 * here
    return np.asarray(-0.5 * (along_y / dy**2 + along_x / dx**2))


def overlapping(
    points: Array, radii: Array, period: tuple[float, float] = (math.inf, math.inf)
) -> NDArray[np.bool_]:
    """Whether each circle overlaps another one.

    Parameters
    ----------
    points : ndarray (n, 2)
        Centres (y, x) [m].
    radii : ndarray (n,)
        Radii [m].
    period : (float, float)
        Size (y, x) of the window [m]; infinite along an axis along which it does not repeat.

    Examples
    --------
    >>> overlapping(np.array([[0.0, 0.0], [0.0, 1.5], [0.0, 9.0]]), np.ones(3)).tolist()
    [True, True, False]
    >>> overlapping(np.array([[0.0, 0.5], [0.0, 9.0]]), np.ones(2), (10.0, 10.0)).tolist()
    [True, True]
    """
    found = np.zeros(len(radii), dtype=bool)
    if len(radii) < 2 or not radii.any():
        return found
    away = np.ptp(points, axis=0) + 4.0 * radii.max()  # where no circle is near its image
    box = np.where(np.isfinite(period), period, away)
    tree = cKDTree(np.mod(points, box), boxsize=box)
    order = np.argsort(-radii)
    # Each circle looks for smaller ones, whose centres are within twice its radius.
    for i in order:
        near = np.asarray(tree.query_ball_point(tree.data[i], 2.0 * radii[i]))
        apart = np.abs(tree.data[near] - tree.data[i])
        apart = np.minimum(apart, box - apart)
        hits = near[np.hypot(apart[:, 0], apart[:, 1]) < radii[near] + radii[i]]
        if len(hits) > 1:
            found[hits] = True
    return found
