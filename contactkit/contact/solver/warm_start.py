"""Warm start of a load curve: pressures extrapolated from those under other loads.

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
# Load curves of eight loads on a half-space and coatings of 3 and 30 times the modulus, 128 x 128
# pixels: 429 applications where a load is 1.1 times the one before, 530 at 1.35, 626 at 1.8.
#
# A parabola: more do not help where pixels enter or leave contact. A line takes 8 % more in steps
# of 1.1, the last pressures alone 15 %.
MAX_SOLUTIONS = 3
MOST_WEIGHT = 10.0  # sum of the weights, by which errors are amplified; 7 for equal steps
# Logarithm of the ratio of loads from which the nested grids start better: with 0.25 4 % more in
# steps of 1.35, with 2 2 % more in steps of 1.8.
FARTHEST = 0.5
FARTHEST_ALONE = 0.15  # the same from a single solution: 0.05 and 0.5 within 1 %


def initial_pressure(
    start: Start, imposed: float, is_load: bool, shape: tuple[int, int]
) -> Floats | None:
    r"""Pressures from one map, or extrapolated from solutions under other loads or approaches.

    .. math:: p(x) = \sum_i p_i \prod_{j \ne i} \frac{x - x_j}{x_i - x_j}

    with the logarithm of the mean pressure, or the approach, as x, on the pixels in contact in the
    first solution; negative values are set to zero.

    Parameters
    ----------
    start : ndarray (ny, nx) or sequence of (float, ndarray)
        Pressures [Pa]; or pairs of mean pressure [Pa], or rigid-body approach [m], and pressures,
        the best first, of which three are used, and fewer where the extrapolation would amplify
        their errors.
    imposed : float
        Mean pressure [Pa] or rigid-body approach [m] to extrapolate to.
    is_load : bool
        Which of the two it is.
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
    >>> round(float(initial_pressure(pairs, 5.0, True, (1, 1))[0, 0]), 3)
    3.388
    >>> round(float(initial_pressure(pairs, 5.0, False, (1, 1))[0, 0]), 3)
    3.5
    >>> initial_pressure(pairs, 50.0, True, (1, 1)) is None
    True
    """
    pairs = [(None, start)] if isinstance(start, np.ndarray) else list(start)[:MAX_SOLUTIONS]
    maps = [np.asarray(p, dtype=np.float64) for _, p in pairs]
    for p in maps or [np.zeros(0)]:
        if p.shape != shape or not np.all(np.isfinite(p)):
            raise DescriptionError("start", p.shape, f"be a finite map of shape {shape}")
    given = [value for value, _ in pairs if value is not None]
    if not given or given[0] == imposed:
        return maps[0]
    if is_load and not (imposed > 0.0 and min(given) > 0.0):
        return None
    known = [float(np.log(value)) if is_load else float(value) for value in given]
    weights = _trusted_weights(known, float(np.log(imposed)) if is_load else float(imposed))
    at = np.flatnonzero(maps[0] > 0.0)
    pressure = sum(w * p.ravel()[at] for w, p in zip(weights, maps, strict=False))
    out = np.zeros(shape)
    out.ravel()[at] = np.maximum(pressure, 0.0)
    return out if _is_near(imposed if is_load else None, given, maps, out, len(weights)) else None


def _is_near(
    load: float | None, given: list[float], maps: list[Floats], out: Floats, used: int
) -> bool:
    """Whether the extrapolation is short enough to start better than the nested grids."""
    if load is not None:
        return abs(float(np.log(load / given[0]))) <= (FARTHEST if used > 1 else FARTHEST_ALONE)
    before, now = float(maps[0].sum()), float(out.sum())
    return used > 1 and min(before, now) > 0.0 and abs(float(np.log(now / before))) <= FARTHEST


def _trusted_weights(at: list[float], here: float) -> Floats:
    """Weights of as many of the values at some points as do not amplify errors by much."""
    weights = np.ones(1)
    for n in range(2, len(at) + 1):
        if at[n - 1] in at[: n - 1]:
            break
        found = _weights(at[:n], here)
        if np.abs(found).sum() > MOST_WEIGHT:
            break
        weights = found
    return weights


def _weights(at: list[float], here: float) -> Floats:
    """Weights of the values at some points in the polynomial through them."""
    weights = [
        np.prod([(here - other) / (one - other) for j, other in enumerate(at) if j != i])
        for i, one in enumerate(at)
    ]
    return np.asarray(weights, dtype=np.float64)
