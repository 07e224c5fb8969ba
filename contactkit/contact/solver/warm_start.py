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


def initial_pressure(start: Start, mean_pressure: float | None, shape: tuple[int, int]) -> Floats:
    r"""Pressures under a load from one map, or extrapolated from solutions under other loads.

    .. math:: p(\bar p) = \sum_i p_i \prod_{j \ne i}
        \frac{\ln \bar p - \ln \bar p_j}{\ln \bar p_i - \ln \bar p_j}

    on the pixels in contact under the newest load; negative values are set to zero.

    Parameters
    ----------
    start : ndarray (ny, nx) or sequence of (float, ndarray)
        Pressures [Pa]; or pairs of mean pressure and pressures, the newest first, of which three
        are used.
    mean_pressure : float or None
        Load to extrapolate to [Pa]; without it the newest pressures are taken.
    shape : tuple of int
        Required shape.

    Raises
    ------
    DescriptionError
        If a map has another shape or is not finite.

    Examples
    --------
    >>> pair = (4.0, np.full((1, 1), 3.0)), (1.0, np.full((1, 1), 1.0))
    >>> initial_pressure(pair, 16.0, (1, 1))
    array([[5.]])
    """
    pairs = [(np.nan, start)] if isinstance(start, np.ndarray) else list(start)[:MAX_SOLUTIONS]
    maps = [np.asarray(p, dtype=np.float64) for _, p in pairs]
    for p in maps or [np.zeros(0)]:
        if p.shape != shape or not np.all(np.isfinite(p)):
            raise DescriptionError("start", p.shape, f"be a finite map of shape {shape}")
    loads = [float(load) for load, _ in pairs]
    newest = maps[0]
    known = mean_pressure is not None and mean_pressure > 0.0 and all(v > 0.0 for v in loads)
    if mean_pressure is None or not known or len(set(loads)) < len(loads):
        return newest
    at, here = np.log(loads), np.log(mean_pressure)
    out = np.zeros(shape)
    for i, p in enumerate(maps):
        others = np.delete(at, i)
        out += p * float(np.prod((here - others) / (at[i] - others)))
    return np.where(newest > 0.0, np.maximum(out, 0.0), 0.0)
