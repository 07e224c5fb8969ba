"""Warm start of a load curve: pressures extrapolated from those under other loads.

Sign convention: pressure positive.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from ...errors import DescriptionError

__all__ = ["FARTHEST_HELD", "Initial", "Start", "initial_pressure"]

Floats = NDArray[np.float64]
Start = Floats | Sequence[tuple[float, Floats]]
# Load curves of eight loads on a half-space and coatings of 3 and 30 times the modulus, 128 x 128
# pixels: 429 applications where a load is 1.1 times the one before, 530 at 1.35, 626 at 1.8.
#
# A parabola: more do not help where pixels enter or leave contact. A line takes 8 % more in steps
# of 1.1, the last pressures alone 15 %.
MAX_SOLUTIONS = 3
MOST_WEIGHT = 10.0  # sum of the weights, by which errors are amplified; 7 for equal steps
# Logarithm of the ratio of loads from which the nested grids start better, by the number of
# solutions used: from two or more, with 0.25 4 % more in steps of 1.35, with 2 2 % more in steps of
# 1.8; from one alone, 0.05 and 0.5 within 1 %.
FARTHEST = {1: 0.15, 2: 0.5}
# The same where few pixels take up a change of the load: under a stiff film, or with much of the
# contact at its bound. Curves of a film of a hundred times the modulus take 0.79 of single solves
# in steps of 1 %, 0.87 at 5 %, and without this limit 1.00 at 20 % and 1.06 at 50 %; with 70 % of
# the contact at its bound 0.56 and 0.70, without it 0.96 and 1.20.
FARTHEST_HELD = 0.1


class Initial(NamedTuple):
    """Initial pressures [Pa], and the logarithm of the load over that of the nearest solution.

    The latter is inf for a map of which the load is not known.
    """

    pressure: Floats
    distance: float


def initial_pressure(
    start: Start, imposed: float, is_load: bool, shape: tuple[int, int]
) -> Initial | None:
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
    Initial or None
        None where the load is so far from the first one that the nested grids start better.

    Raises
    ------
    DescriptionError
        If a map has another shape or is not finite.

    Examples
    --------
    >>> pairs = (4.0, np.full((1, 1), 3.0)), (3.0, np.full((1, 1), 2.5))
    >>> round(float(initial_pressure(pairs, 5.0, True, (1, 1)).pressure[0, 0]), 3)
    3.388
    >>> round(float(initial_pressure(pairs, 5.0, False, (1, 1)).pressure[0, 0]), 3)
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
        return Initial(maps[0], 0.0 if given else np.inf)
    if is_load and not (imposed > 0.0 and min(given) > 0.0):
        return None
    known = [float(np.log(value)) if is_load else float(value) for value in given]
    weights = _trusted_weights(known, float(np.log(imposed)) if is_load else float(imposed))
    at = np.flatnonzero(maps[0] > 0.0)
    pressure = sum(w * p.ravel()[at] for w, p in zip(weights, maps, strict=False))
    out = np.zeros(shape)
    out.ravel()[at] = np.maximum(pressure, 0.0)
    if not is_load and len(weights) == 1:
        return None  # how far the load is, the approach alone does not tell
    before, now = (given[0], imposed) if is_load else (float(maps[0].sum()), float(out.sum()))
    if not min(before, now) > 0.0:
        return None
    distance = abs(float(np.log(now / before)))
    return Initial(out, distance) if distance <= FARTHEST[min(len(weights), 2)] else None


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
