"""Warm start of a load curve: pressures extrapolated from those under the previous loads.

Sign convention: pressure positive.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from ...errors import DescriptionError

__all__ = ["Start", "initial_pressure"]

Floats = NDArray[np.float64]
Start = Floats | Sequence[tuple[float, Floats]]
MAX_SOLUTIONS = 3  # a parabola: more do not help where pixels enter or leave contact
MOST_WEIGHT = 10.0  # sum of the weights, by which errors are amplified; 7 for equal steps
FARTHEST = 0.5  # logarithm of the ratio of loads from which the nested grids start better
FARTHEST_ALONE = 0.15  # the same from a single solution


def initial_pressure(
    start: Start, mean_pressure: float | None, shape: tuple[int, int]
) -> Floats | None:
    r"""Pressures under a load from one map, or extrapolated from solutions under other loads.

    .. math:: p(\bar p) = \sum_i p_i \prod_{j \ne i}
        \frac{\ln \bar p - \ln \bar p_j}{\ln \bar p_i - \ln \bar p_j}

    on the pixels in contact under the first load; negative values are set to zero.

    Parameters
    ----------
    start : ndarray (ny, nx) or sequence of (float, ndarray)
        Pressures [Pa]; or pairs of mean pressure and pressures, the best first, of which three
        are used, and fewer where the extrapolation would amplify their errors.
    mean_pressure : float or None
        Load to extrapolate to [Pa]; without it the first pressures are taken.
    shape : tuple of int
        Required shape.

    Returns
    -------
    ndarray (ny, nx) or None
        None where the load is so far from the first one that the nested grids start better.

    Raises
    ------
    DescriptionError
        If a map has another shape or is not finite.

    Examples
    --------
    >>> pairs = (4.0, np.full((1, 1), 3.0)), (3.0, np.full((1, 1), 2.5))
    >>> found = initial_pressure(pairs, 5.0, (1, 1))
    >>> round(float(found[0, 0]), 3)
    3.388
    >>> initial_pressure(pairs, 50.0, (1, 1)) is None
    True
    """
    pairs = [(np.nan, start)] if isinstance(start, np.ndarray) else list(start)[:MAX_SOLUTIONS]
    maps = [np.asarray(p, dtype=np.float64) for _, p in pairs]
    for p in maps or [np.zeros(0)]:
        if p.shape != shape or not np.all(np.isfinite(p)):
            raise DescriptionError("start", p.shape, f"be a finite map of shape {shape}")
    loads = [float(load) for load, _ in pairs]
    if mean_pressure is None or mean_pressure <= 0.0 or not loads[0] > 0.0:
        return maps[0]
    at, here = [float(np.log(loads[0]))], float(np.log(mean_pressure))
    if abs(here - at[0]) > FARTHEST:
        return None
    weights = np.ones(1)
    for load in loads[1:]:
        if not load > 0.0 or load in loads[: len(at)]:
            break
        trial = [*at, float(np.log(load))]
        found = _weights(trial, here)
        if np.abs(found).sum() > MOST_WEIGHT:
            break
        at, weights = trial, found
    if len(at) == 1 and abs(here - at[0]) > FARTHEST_ALONE:
        return None
    out = np.zeros(shape)
    for weight, p in zip(weights, maps, strict=False):
        out += weight * p
    return np.where(maps[0] > 0.0, np.maximum(out, 0.0), 0.0)


def _weights(at: list[float], here: float) -> Floats:
    """Weights of the values at some points in the polynomial through them."""
    weights = [
        np.prod([(here - other) / (one - other) for j, other in enumerate(at) if j != i])
        for i, one in enumerate(at)
    ]
    return np.asarray(weights, dtype=np.float64)
