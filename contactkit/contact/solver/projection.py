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
k       ``K 1``, pressures under an equal displacement; keep a sum
======  ====================================================================
"""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from .loops_numpy import dot

__all__ = ["Projected", "Projection"]

Vector = NDArray[Any]
# Measurements are those of the room (`contact.solver`), on 128 x 128 pixels: applications of the
# operator outside, of which each looser projection may cost some.
#
# Of the residual on each set of held pixels, unless asked for less: 0.1 takes 1 % more applications
# (46 in place of 38 at 3000 times the modulus), 0.01 none fewer.
TOLERANCE = 0.03
MAX_SETS = 20  # of held pixels tried: 6 to 60 are alike
MAX_STEPS = 40  # of conjugate gradients on each: 12 take 1 % more applications, 120 the same
MOST_STEPS = (
    400  # in all: beyond, another gap is worth more than a better projection; 100 do as well
)
MAX_SHIFTS = 30  # of the displacement that gives the changes their sum: 8 to 100 are alike
# Of the sum of changes, over that of their magnitudes: `restore` makes up for it. 0.1 takes the
# same; 1e-3 takes 2 % more, as shifts then go on after the sets are known.
UNBALANCED = 0.01
# Changes of side over held pixels that may remain: the next free pixels differ more. 0.1 takes 2 %
# more applications, 0 takes 1 %.
SETTLED = 0.02


class Projected(NamedTuple):
    """Changes within the bounds, and on which side each pixel is held: -1, 0 or 1."""

    change: Vector
    side: NDArray[np.int8]


class _HeldSystem:
    """K between the pixels that are held at a bound; vectors have these alone.

    A factor of all free pixels acts on displacements that are zero on most of them: its columns of
    the held ones are taken out once for each set, so that a step costs what they are, not what the
    contact is. Under a stiff film they are a tenth of it.
    """

    def __init__(self, projection: Projection, held: NDArray[np.bool_], keeps_sum: bool) -> None:
        self.all, self.keeps_sum = projection, keeps_sum
        self.at = np.flatnonzero(held)
        self.columns = projection.columns[:, self.at]
        self.rows = self.columns.T
        self.k = projection.k[self.at]
        self.diagonal = projection.diagonal[self.at]

    def _uniform(self, w: Vector) -> Any:
        """Equal displacement of all free pixels that keeps the sum."""
        return w.dtype.type(dot(self.k, w) / self.all.stiffness)

    def spread(self, w: Vector) -> Vector:
        """Change of all free pixels under the displacement of those that are held."""
        out = np.asarray(self.all.transposed @ (self.columns @ w))
        if self.keeps_sum:
            out -= self.all.k * self._uniform(w)
        return out

    def product(self, w: Vector) -> Vector:
        """The same on the held pixels alone."""
        out = np.asarray(self.rows @ (self.columns @ w))
        self.all.work += self.columns.nnz / self.all.factor.nnz
        if self.keeps_sum:
            out -= self.k * self._uniform(w)
        return out

    def solve(self, goal: Vector, w: Vector, tolerance: float, most: int) -> int:
        """Improve w in place so that ``K w`` comes near the goal; number of steps taken."""
        r = goal - self.product(w)
        z = r / self.diagonal
        d, rz = z.copy(), dot(r, z)
        stop = tolerance**2 * rz
        for step in range(most):
            if rz <= stop:
                return step
            q = self.product(d)
            dq = dot(d, q)
            if not dq > 0.0:
                return step
            length = w.dtype.type(rz / dq)
            w += length * d
            r -= length * q
            z = r / self.diagonal
            before, rz = rz, dot(r, z)
            d *= w.dtype.type(rz / before)
            d += z
        return most


class Projection:
    """Nearest changes of pressures within bounds, in the metric of a sparse inverse.

    Parameters
    ----------
    factor : sparse array (m, m)
        L, ``L' L`` about the inverse of the operator between the pixels.
    low, high : ndarray (m,)
        Bounds of the changes; `high` may be infinite.
    load_fixed : bool
        Whether the changes keep their sum.
    tolerance : float
        Reduction of the residual of each set of held pixels [-].

    Attributes
    ----------
    steps : int
        Steps of conjugate gradients.
    work : float
        Their cost, in products with the whole factor and its transpose.

    Examples
    --------
    A row of three that resists bending: what the last may not give is taken from its neighbour.

    >>> import scipy.sparse
    >>> L = scipy.sparse.csr_array(np.array([[1, 0, 0], [-1, 1, 0], [0, -1, 1]], np.float32))
    >>> low, high = np.zeros(3, np.float32), np.full(3, np.inf, np.float32)
    >>> x = np.array([1.0, 1.0, -0.5], np.float32)
    >>> Projection(L, low, high, False)(x).change
    array([1. , 0.5, 0. ], dtype=float32)
    """

    def __init__(
        self,
        factor: Any,
        low: Vector,
        high: Vector,
        load_fixed: bool,
        tolerance: float = TOLERANCE,
    ) -> None:
        self.factor, self.transposed, self.columns = factor, factor.T, factor.tocsc()
        self.low, self.high, self.load_fixed = low, high, load_fixed
        self.tolerance = tolerance
        n, kind = factor.shape[0], factor.dtype
        self.k = self.product(np.ones(n, kind))
        self.stiffness = float(self.k.sum(dtype=np.float64))
        self.diagonal = np.bincount(factor.indices, factor.data**2, n).astype(kind)  # of L' L
        self.w = np.zeros(n, kind)
        self.steps, self.work = 0, 0.0

    def product(self, w: Vector) -> Vector:
        """Changes of pressure K w under a displacement."""
        return np.asarray(self.transposed @ (self.factor @ w))

    def __call__(self, x: Vector) -> Projected:
        """About the nearest changes to x: the sets of held pixels need not have settled."""
        side = (x > self.high).astype(np.int8) - (x < self.low).astype(np.int8)
        found = self._bounded(x, side, self.load_fixed)
        total = float(x.sum(dtype=np.float64))
        if self.load_fixed and self._misses(found, total):
            found = self._with_sum(x, total, found)
        return found

    def _misses(self, found: Projected, total: float) -> bool:
        """Whether changes do not sum up as they should: where nearly all pixels are held."""
        missing = abs(float(found.change.sum(dtype=np.float64)) - total)
        return missing > UNBALANCED * float(np.abs(found.change).sum(dtype=np.float64))

    def _bounded(self, x: Vector, side: NDArray[np.int8], keeps_sum: bool) -> Projected:
        """Projection by sets of held pixels, from a first guess of them and of w."""
        moved = x
        for _ in range(MAX_SETS):
            held = side != 0
            bound = np.where(side > 0, self.high, self.low)
            system = _HeldSystem(self, held, keeps_sum)
            w = self.w[system.at]  # of the last set: the next one differs by few pixels
            goal = (bound - x)[system.at]
            most = min(MAX_STEPS, MOST_STEPS - self.steps)
            self.steps += system.solve(goal, w, self.tolerance, most)
            self.w = np.zeros_like(x)
            self.w[system.at] = w
            moved = x + system.spread(w)
            now = (moved > self.high).astype(np.int8) - (moved < self.low).astype(np.int8)
            # A held pixel is freed where its bound pulls instead of pushes.
            now = np.where(held, np.where(side * self.w <= 0.0, side, 0), now).astype(np.int8)
            changed = int(np.count_nonzero(now != side))
            side = now
            few = SETTLED * min(1.0, self.tolerance / TOLERANCE) * np.count_nonzero(held)
            if changed <= few or self.steps >= MOST_STEPS:
                break
        change = np.clip(moved, self.low, self.high)
        change[side < 0], change[side > 0] = self.low[side < 0], self.high[side > 0]
        return Projected(change, side)

    def _with_sum(self, x: Vector, total: float, first: Projected) -> Projected:
        """Projection with a given sum, by the equal displacement that makes it.

        The sum falls with that displacement: regula falsi (Illinois) inside a bracket.
        """

        def excess(shift: float, side: NDArray[np.int8]) -> tuple[float, Projected]:
            found = self._bounded(x - x.dtype.type(shift) * self.k, side, False)
            return float(found.change.sum(dtype=np.float64)) - total, found

        here, found = excess(0.0, first.side)
        a, b, at_a, at_b = 0.0, 0.0, here, here
        # As if no pixel were held; held ones make the sum stiffer, so that the step has to grow.
        step = here / self.stiffness
        for _ in range(MAX_SHIFTS):
            if not self._misses(found, total) or self.steps >= MOST_STEPS:
                break
            shift = b + step if at_a * at_b > 0.0 else (a * at_b - b * at_a) / (at_b - at_a)
            here, found = excess(shift, found.side)
            if here * at_b > 0.0 and at_a * at_b <= 0.0:
                at_a *= 0.5
            else:
                a, at_a = b, at_b
            b, at_b, step = shift, here, 2.0 * step
        return found

    def restore(self, change: NDArray[np.float64], total: float) -> None:
        """Give changes a sum by a displacement equal over the pixels off their bounds, in place.

        This costs the least energy, scaling of the pressures far more.
        """
        for _ in range(MAX_SHIFTS):
            missing = total - float(change.sum())
            free = np.flatnonzero((change > self.low) & (change < self.high) & (self.k > 0.0))
            room = float(self.k[free].sum(dtype=np.float64))
            if not room > 0.0 or abs(missing) <= 1e-13 * float(np.abs(change).sum()):
                break
            moved = change[free] + (missing / room) * self.k[free]
            change[free] = np.clip(moved, self.low[free], self.high[free])
