r"""Menisci of a thin liquid film on a rough contact: wetted islands and capillary force.

A film of thickness :math:`h_f` lies on one surface. A meniscus can form where the gap is smaller
than the meniscus height :math:`h_m`; it does on those connected islands that touch the film
somewhere, gap < :math:`h_f`. The contact area itself is dry. Gaps [m] are positive where open,
arrays ``[y, x]``; a positive force attracts.
"""

from __future__ import annotations

from typing import Literal, NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy import ndimage
from scipy.sparse import coo_array
from scipy.sparse.csgraph import connected_components

__all__ = ["FilmIslands", "film_force", "islands", "meniscus_area"]

Array = NDArray[np.float64]
Mask = NDArray[np.bool_]
Labels = NDArray[np.int64]


class FilmIslands(NamedTuple):
    """Wetted islands of a gap map; counts are of pixels."""

    meniscus: Mask
    """Pixels under a meniscus, (ny, nx)."""
    n_meniscus: int
    """Their number: A_m = A_c* - A_r."""
    n_wetted_cut: int
    """Pixels of islands that touch the film, contact included: A_c*."""
    n_cut: int
    """Pixels of all islands, A_c."""
    n_islands: int
    """Islands that touch the film."""
    n_dry_islands: int
    """Islands that do not."""


def meniscus_area(
    gap: Array,
    film_thickness: float,
    meniscus_height: float,
    contact: Mask,
    periodic: bool | Literal["x", "y"],
    connectivity: Literal[4, 8] = 8,
) -> FilmIslands:
    """Pixels wetted by menisci.

    Parameters
    ----------
    gap : ndarray (ny, nx)
        Distance of the surfaces [m].
    film_thickness : float
        Thickness of the film [m].
    meniscus_height : float
        Maximum gap of a meniscus [m]. If it does not exceed `film_thickness`, every island touches
        the film.
    contact : ndarray of bool (ny, nx)
        Pixels in contact.
    periodic : bool, "x" or "y"
        Whether islands continue across the edges: all of them, or along one axis alone.
    connectivity : {4, 8}
        8: pixels with a common corner belong to one island; 4: only those with a common edge.

    Notes
    -----
    The error of a pixel count is a fraction of the perimeter times the pixel size, of either sign.
    The film thickness is uniform and not reduced by the menisci that it feeds.

    References
    ----------
    .. [1] Cross-cut and wetted areas of section 2.2 (Tian and Bhushan 1996).

    Examples
    --------
    Two hollows; the film reaches only into the deeper one, at the left.

    >>> gap = np.array([[0.0, 1.0, 3.0, 1.5, 3.0]])
    >>> meniscus_area(gap, 0.5, 2.0, gap == 0.0, periodic=False)[1:]
    (1, 2, 3, 1, 1)
    """
    cut = np.asarray(gap < meniscus_height)
    names, n = islands(cut, periodic, connectivity)
    touches = np.zeros(n + 1, dtype=bool)
    touches[names[cut & (gap < film_thickness)]] = True
    wetted = touches[names]
    meniscus = wetted & ~contact
    n_wetted = int(touches.sum())
    return FilmIslands(
        meniscus, int(meniscus.sum()), int(wetted.sum()), int(cut.sum()), n_wetted, n - n_wetted
    )


class Islands(NamedTuple):
    """Connected components of a mask: the label of each pixel from 1, 0 outside; their number."""

    names: Labels
    number: int


def islands(
    mask: Mask, periodic: bool | Literal["x", "y"], connectivity: Literal[4, 8] = 8
) -> Islands:
    """Connected components of a mask, labelled from 1, and their number.

    Parameters
    ----------
    mask : ndarray of bool (ny, nx)
        What is labelled.
    periodic : bool, "x" or "y"
        Whether components continue across the edges: all of them, or along one axis alone.
    connectivity : {4, 8}
        8: pixels with a common corner belong together; 4: only those with a common edge.

    Returns
    -------
    Islands
        ``names`` is an ndarray of int (ny, nx).

    Examples
    --------
    >>> islands(np.array([[True, False, True]]), periodic=True)
    Islands(names=array([[1, 0, 1]]), number=1)
    """
    if periodic in ("x", "y"):  # a line that is not in the mask keeps the other edges apart
        ny, nx = mask.shape
        apart = np.pad(mask, ((0, 1), (0, 0)) if periodic == "x" else ((0, 0), (0, 1)))
        names, n = islands(apart, True, connectivity)
        return Islands(names[:ny, :nx], n)
    reach = ndimage.generate_binary_structure(2, 1 if connectivity == 4 else 2)
    labels, n = ndimage.label(mask, reach)
    names = np.asarray(labels).astype(np.int64)
    if not periodic or n == 0:
        return Islands(names, int(n))
    pairs = np.concatenate([_across(names, connectivity), _across(names.T, connectivity)], axis=1)
    joined = coo_array((np.ones(pairs.shape[1]), tuple(pairs)), shape=(n + 1, n + 1))
    n_found, renamed = connected_components(joined, directed=False)
    # The outside, 0, is a component of its own, and the first one.
    return Islands(np.asarray(renamed[names], dtype=np.int64), int(n_found) - 1)


def film_force(
    area: ArrayLike,
    surface_tension: ArrayLike,
    angle_lower: ArrayLike,
    angle_upper: ArrayLike,
    meniscus_height: ArrayLike,
) -> Array:
    r"""Capillary force [N]: Laplace pressure of a flat meniscus times the wetted area.

    .. math:: F = \gamma (\cos\theta_1 + \cos\theta_2) A_m / h_m

    Parameters
    ----------
    area : array_like (...)
        Area :math:`A_m` under menisci, contact excluded [m2].
    surface_tension : array_like (...)
        Surface tension [N/m].
    angle_lower, angle_upper : array_like (...)
        Contact angles [rad].
    meniscus_height : array_like (...)
        Height :math:`h_m` at which the menisci end [m].

    Notes
    -----
    Neglects the line tension at the rim and the curvature along it, of relative size height over
    width of a meniscus. The caller decides whether the force is added to the load.

    References
    ----------
    .. [1] Eq. (2.43).

    Examples
    --------
    A ball of 1 mm on a film of water, 60 degrees: 2 pi R gamma (cos + cos).

    >>> import math
    >>> area = 2 * math.pi * 1e-3 * 1e-9
    >>> round(float(film_force(area, 0.07275, math.pi / 3, math.pi / 3, 1e-9)) * 1e6, 6)
    457.101731
    """
    values = (area, surface_tension, angle_lower, angle_upper, meniscus_height)
    a, gamma, lower, upper, height = (np.asarray(value, dtype=np.float64) for value in values)
    return np.asarray(gamma * (np.cos(lower) + np.cos(upper)) * a / height)


def _across(names: Labels, connectivity: int) -> Labels:
    """Labels of islands that meet across the first and last row, (2, number of pairs)."""
    last, first = names[-1], names[0]
    steps = (0,) if connectivity == 4 else (-1, 0, 1)
    pairs = np.concatenate([np.stack([last, np.roll(first, step)]) for step in steps], axis=1)
    return pairs[:, (pairs > 0).all(axis=0)]
