"""Pressure of a rigid plane on a periodic rough body: conjugate gradients with two bounds.

Polonsky and Keer's iteration (Wear 231 (1999) 206), written out as plainly as it goes, with the
hardness as an upper bound: pixels at it are no unknowns, as those out of contact.
"""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

__all__ = ["iterated", "pressed"]

Array = NDArray[Any]


def pressed(
    heights: Array, compliance: Array, mean: float, hardness: float = np.inf, rtol: float = 1e-5
) -> tuple[Array, Array]:
    """Pressure [Pa] and gap [m] under a mean pressure [Pa].

    `compliance` is the displacement over pressure of each wave, zero at the first. The gap is wrong
    by less than `rtol` of the height of the surface at every pixel: 1e-5 gives the pressures of
    chapter 2 to 2e-4, 1e-6 to 1e-6 in twice the iterations.
    """
    p, gap, _ = iterated(heights, compliance, mean, hardness, rtol)
    return p, gap


def iterated(
    heights: Array, compliance: Array, mean: float, hardness: float = np.inf, rtol: float = 1e-5
) -> tuple[Array, Array, int]:
    """Pressure [Pa], gap [m] and number of iterations; see `pressed`.

    Raises RuntimeError where 3000 iterations are not enough.
    """
    start = np.full(heights.shape, mean)
    if np.isfinite(hardness):
        elastic, _ = pressed(heights, compliance, mean, np.inf, 1e2 * rtol)
        start = _with_mean(np.minimum(elastic, hardness), mean, hardness)
    return _iterated(start, heights, compliance, hardness, rtol * np.ptp(heights))


def _iterated(
    p: Array, heights: Array, compliance: Array, hardness: float, enough: float
) -> tuple[Array, Array, int]:
    """Conjugate gradients among the pixels between the bounds, restarted when these change."""
    mean, size, sets = float(p.mean()), 1.0, np.zeros(p.shape, bool)
    step = mean / np.ptp(heights)
    t = np.zeros_like(p)
    for n in range(3000):
        gap = np.fft.ifft2(compliance * np.fft.fft2(p)).real - heights
        free = (p > 0.0) & (p < hardness)
        gap -= gap[free].mean() if free.any() else gap[p > 0.0].max()
        out, full = p <= 0.0, p >= hardness
        wrong = np.where(out, np.maximum(-gap, 0.0), np.where(full, np.maximum(gap, 0.0), 0.0))
        if max(wrong.max(), np.abs(gap[free]).max(initial=0.0)) < enough:
            return p, gap, n
        norm = float((gap[free] ** 2).sum())
        keep = norm / size if size > 0.0 and np.array_equal(free, sets) else 0.0
        t = np.where(free, gap + keep * t, 0.0)
        size, sets = norm, free
        r = np.fft.ifft2(compliance * np.fft.fft2(t)).real
        r -= r[free].mean()
        bend = float((r * t)[free].sum())
        if bend > 0.0:  # zero for a single pixel between the bounds: its step is the last one
            step = float((gap * t)[free].sum()) / bend
        p = np.clip(np.where(free, p - step * t, p), 0.0, hardness)
        back = ((p <= 0.0) & (gap < 0.0)) | ((p >= hardness) & (gap > 0.0))
        p = np.clip(np.where(back, p - step * gap, p), 0.0, hardness)
        p = _with_mean(p, mean, hardness)
    raise RuntimeError("the second method did not converge in 3000 iterations")


def _with_mean(p: Array, mean: float, hardness: float) -> Array:
    """Scale the pressures below the hardness so that the mean is that of the load."""
    for _ in range(50):
        below = p < hardness
        rest = mean * p.size - p[~below].sum()
        if rest <= 0.0 or not p[below].any():
            scaled: Array = p * (mean / p.mean())
            return scaled
        p = np.where(below, p * (rest / p[below].sum()), p)
        if p.max() <= hardness:
            break
        p = np.minimum(p, hardness)
    return p
