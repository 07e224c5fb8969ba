r"""Projection onto bounds in the metric of a sparse inverse: an obstacle problem.

Cutting pressures off at their bounds pixel by pixel leaves pits under a stiff film, because a pixel
that is added lifts its neighbours off. The nearest admissible change in energy has none:

.. math:: \min_{x'} \; (x' - x)^T M (x' - x), \quad a \le x' \le b, \qquad M^{-1} = K = L^T L

With ``w = M (x' - x)``, a displacement that is not zero only where x' is held at a bound,
``x' = x + K w``: an obstacle problem for w with a sparse matrix. As x is the minimum of the energy
over the free pixels, up to M this is the bounded minimum over them, without a convolution.

Sign convention: pressure and displacement positive into the solid.

======  ====================================================================
symbol  meaning
======  ====================================================================
K       ``L' L``, about the inverse of the operator between the free pixels
w       displacement that holds pixels at their bounds
k       ``K 1``, pressures under an equal displacement; keeps a sum
======  ====================================================================
"""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

__all__ = ["Projected", "project_in_metric"]

Singles = NDArray[np.float32]
MAX_SETS = 20  # sets of held pixels tried
MAX_STEPS = 40  # of conjugate gradients on each
REDUCTION = 0.03  # of the residual on each
MAX_SHIFTS = 30  # of the displacement that gives the changes their sum
UNBALANCED = 0.01  # of the sum of changes, over that of their magnitudes: scaling makes up for it
SETTLED = 0.02  # changes of side over held pixels that may remain: the next free pixels differ more


class Projected(NamedTuple):
    """Changes within the bounds, and on which side each pixel is held: -1, 0 or 1."""

    change: Singles
    side: NDArray[np.int8]


class _Metric:
    """The sparse inverse K, that of a kept sum if the load is fixed."""

    def __init__(self, factor: Any, load_fixed: bool) -> None:
        self.transposed = factor.T.tocsr()
        ones = np.ones(factor.shape[0], np.float32)
        self.k = np.asarray(self.transposed @ (factor @ ones)) if load_fixed else None
        self.total = 1.0 if self.k is None else float(self.k.sum(dtype=np.float64))


class _HeldSystem:
    """K between the pixels that are held at a bound."""

    def __init__(self, metric: _Metric, held: NDArray[np.intp]) -> None:
        self.metric = metric
        self.rows = metric.transposed[held]
        self.columns = self.rows.T
        self.k = None if metric.k is None else metric.k[held]
        self.diagonal = np.asarray(self.rows.power(2).sum(axis=1)).ravel()

    def __call__(self, w: Singles) -> Singles:
        """Change of the held pixels under a displacement of them."""
        out = np.asarray(self.rows @ (self.columns @ w))
        if self.k is not None:
            out -= self.k * np.float32(np.dot(self.k, w) / self.metric.total)
        return out

    def spread(self, w: Singles) -> Singles:
        """Change of all free pixels under the displacement of those that are held."""
        out = np.asarray(self.metric.transposed @ (self.columns @ w))
        if self.metric.k is not None and self.k is not None:
            out -= self.metric.k * np.float32(np.dot(self.k, w) / self.metric.total)
        return out

    def solve(self, goal: Singles, w: Singles) -> Singles:
        """Improve w so that ``K w`` comes near the goal, by a few preconditioned steps."""
        w = w.copy()
        r = goal - self(w)
        z = r / self.diagonal
        d, rz = z.copy(), float(np.dot(r, z))
        stop = REDUCTION**2 * rz
        for _ in range(MAX_STEPS if rz > 0.0 else 0):
            q = self(d)
            dq = float(np.dot(d, q))
            if not dq > 0.0:
                break
            length = np.float32(rz / dq)
            w += length * d
            r -= length * q
            z = r / self.diagonal
            before, rz = rz, float(np.dot(r, z))
            if rz <= stop:
                break
            d = z + np.float32(rz / before) * d
        return w


def project_in_metric(
    x: Singles, low: Singles, high: Singles, factor: Any, load_fixed: bool
) -> Projected:
    """Nearest change of pressures within bounds, in the metric of a sparse inverse.

    Parameters
    ----------
    x : ndarray (m,)
        Change that leaves the bounds.
    low, high : ndarray (m,)
        Its bounds; ``high`` may be infinite.
    factor : sparse array (m, m)
        L, ``L' L`` about the inverse of the operator between the pixels.
    load_fixed : bool
        Whether the changes keep their sum.

    Returns
    -------
    Projected
        Only about the nearest: the sets of held pixels need not have settled.

    Examples
    --------
    A row of three that resists bending: what the last may not give is taken from its neighbour.

    >>> import scipy.sparse
    >>> L = scipy.sparse.csr_array(np.array([[1, 0, 0], [-1, 1, 0], [0, -1, 1]], np.float32))
    >>> low, high = np.zeros(3, np.float32), np.full(3, np.inf, np.float32)
    >>> x = np.array([1.0, 1.0, -0.5], np.float32)
    >>> project_in_metric(x, low, high, L, False).change
    array([1. , 0.5, 0. ], dtype=float32)
    """
    metric = _Metric(factor, load_fixed)
    side = (x > high).astype(np.int8) - (x < low).astype(np.int8)
    found = _bounded(metric, x, low, high, side)
    if not load_fixed or not _misses(found, float(x.sum(dtype=np.float64))):
        return found
    return _with_sum(factor, x, low, high, found)


def _misses(found: Projected, total: float) -> bool:
    """Whether changes do not sum up as they should: where nearly all pixels are held."""
    missing = abs(float(found.change.sum(dtype=np.float64)) - total)
    return missing > UNBALANCED * float(np.abs(found.change).sum(dtype=np.float64))


def _bounded(
    metric: _Metric, x: Singles, low: Singles, high: Singles, side: NDArray[np.int8]
) -> Projected:
    """Projection by sets of held pixels, from a first guess of them."""
    w = np.zeros_like(x)
    moved = x
    for _ in range(MAX_SETS):
        held = np.flatnonzero(side)
        bound = np.where(side[held] > 0, high[held], low[held])
        system = _HeldSystem(metric, held)
        w_held = system.solve(bound - x[held], w[held])
        w[...] = 0.0
        w[held] = w_held
        moved = x + system.spread(w_held)
        now = (moved > high).astype(np.int8) - (moved < low).astype(np.int8)
        # A held pixel is freed where its bound pulls instead of pushes.
        now[held] = np.where(side[held] * w_held <= 0.0, side[held], 0)
        changed = int(np.count_nonzero(now != side))
        side = now
        if changed <= SETTLED * held.size:
            break
    change = np.clip(moved, low, high)
    change[side < 0], change[side > 0] = low[side < 0], high[side > 0]
    return Projected(change, side)


def _with_sum(factor: Any, x: Singles, low: Singles, high: Singles, first: Projected) -> Projected:
    """Projection whose changes sum to those of x, by the equal displacement that makes them.

    The sum falls with that displacement: regula falsi (Illinois) inside a bracket.
    """
    metric = _Metric(factor, False)
    k = metric.transposed @ (factor @ np.ones_like(x))
    total, stiffness = float(x.sum(dtype=np.float64)), float(k.sum(dtype=np.float64))

    def excess(shift: float, side: NDArray[np.int8]) -> tuple[float, Projected]:
        found = _bounded(metric, x - np.float32(shift) * k, low, high, side)
        return float(found.change.sum(dtype=np.float64)) - total, found

    here, found = excess(0.0, first.side)
    a, b, at_a, at_b = 0.0, 0.0, here, here
    step = here / stiffness
    for _ in range(MAX_SHIFTS):
        if not _misses(found, total):
            break
        shift = b + step if at_a * at_b > 0.0 else (a * at_b - b * at_a) / (at_b - at_a)
        here, found = excess(shift, found.side)
        if here * at_b > 0.0 and at_a * at_b <= 0.0:
            at_a *= 0.5
        else:
            a, at_a = b, at_b
        b, at_b, step = shift, here, 2.0 * step
    return found
