r"""One implicit step of a wet gap: Radau IIA, its stages solved together by Newton's method.

The stages k satisfy :math:`\sum_j B_{kj} (Q_j - Q_0) + R_k = 0` with B the inverse of the matrix of
the method over the length of the step; the last stage is the end. The conditions of cavity and
contact hold at every stage, and their sets change with each iteration (semismooth Newton). The
error estimate is that of an embedded formula of lower order, filtered by the matrix of the step.

References
----------
Hairer and Wanner, Solving Ordinary Differential Equations II (1996), section IV.8.
"""

from __future__ import annotations

import math
from typing import Any, NamedTuple

import numpy as np
from attrs import frozen
from numpy.typing import NDArray
from scipy.linalg import lu_factor, lu_solve

from ...numerics.radau_tableau import ERROR, GAMMA, NODES, STAGES
from .wet_gap import Fields, Levels, Sets, WetGap

__all__ = ["METHODS", "Method", "StepFailedError", "Stepped", "step"]

Array = NDArray[np.float64]
Factors = tuple[NDArray[Any], NDArray[Any]]

# Newton's iteration: corrections over the size of the unknowns. The rim of a meniscus keeps its
# volume to this.
_SOLVED = 1e-10
# Iterations, after which a shorter step is cheaper: with cavities and contacts 4 to 12 are usual.
_MOST = 30
# Corrections that shrink at least so much keep the factors: a factorisation of 3 n unknowns costs
# as much as 5 to 10 iterations with it.
_CONTRACTION = 0.1
# A gap may shrink to this part of itself in an iteration, and a rim change by this part.
_LEAST_GAP, _RIM_CHANGE = 0.1, 0.3
# Round-off: at corrections this small that do not shrink any more, all is solved.
_STALLED = 1e-7


class StepFailedError(ArithmeticError):
    """The stages of a step could not be solved: a shorter one may be."""


@frozen(eq=False)
class Method:
    """A Radau IIA method.

    Attributes
    ----------
    nodes : ndarray, shape (s,)
        Times of the stages over the length of the step.
    inverse : ndarray, shape (s, s)
        Inverse of its matrix.
    weights : ndarray, shape (s,)
        Of the stages in an integral over the step.
    gamma, error : float, ndarray
        Of the filtered error estimate, see `step`.
    order : int
        In which that shrinks with the length of the step.
    """

    nodes: Array
    inverse: Array
    weights: Array
    gamma: float
    error: Array
    order: int


# Matrix of the method with two stages, Hairer and Wanner, table IV.5.5.
_TWO = np.array([[5.0 / 12.0, -1.0 / 12.0], [3.0 / 4.0, 1.0 / 4.0]])
METHODS = {
    2: Method(
        np.array([1.0 / 3.0, 1.0]),
        np.linalg.inv(_TWO),
        _TWO[1],
        math.sqrt(6.0),
        # Weights of the increments in the formula of order 2 on the nodes 0, 1/3 and 1.
        np.array([-4.5, 0.5]),
        3,
    ),
    3: Method(
        np.array(NODES),
        np.linalg.inv(np.array(STAGES)),
        np.array(STAGES[2]),
        GAMMA,
        np.array(ERROR),
        4,
    ),
}
"""By the number of stages: order 3 and 5 of smooth solutions."""


class Stepped(NamedTuple):
    """A step that was solved.

    `stages` and `sets` are those of each stage, the last of which is the end; `error` is the
    estimated error of the end, of the pressures, solid pressures and the rigid gap.
    """

    stages: tuple[Fields, ...]
    sets: Sets
    error: Fields
    n_iterations: int
    n_factorisations: int


def step(
    gap: WetGap, start: Fields, sets: Sets, time: float, length: float, guess: list[Fields]
) -> Stepped:
    """Solve a step from a time by a length; as many stages as there are guesses.

    Raises
    ------
    StepFailedError
        If Newton's method does not converge, or a gap closes where nothing can touch.
    """
    newton = _Newton(gap, start, sets, time, length, guess)
    newton.solve()
    stages, end = tuple(newton.now), newton.sets[-1]
    error = _error(newton, newton.first_levels)
    return Stepped(stages, end, error, newton.n_iterations, newton.n_factorisations)


class _Newton:
    """State of the iteration."""

    def __init__(
        self,
        gap: WetGap,
        start: Fields,
        sets: Sets,
        time: float,
        length: float,
        guess: list[Fields],
    ) -> None:
        self.gap, self.length = gap, length
        self.method = METHODS[len(guess)]
        self.matrix = self.method.inverse / length
        self.times = time + length * self.method.nodes
        none = np.flatnonzero(sets.contact)
        self.first_sets, self.first = sets, start
        self.first_levels = gap.levels(start, sets, time, none, slopes=False)
        self.stored = self.first_levels.stored
        self.sets = [sets for _ in guess]
        self.touching = none
        self.now = [self._settled(one, sets) for one in guess]
        self.n_iterations = self.n_factorisations = 0
        self.levels: list[Levels] = []

    def _settled(self, now: Fields, sets: Sets) -> Fields:
        """Fields that obey their sets: pressure of cavities, content of the full film."""
        floor = self.gap.floor
        pressure = np.where(sets.void, floor, now.pressure) if sets.void.any() else now.pressure
        solid = np.where(sets.contact, now.solid, 0.0) if self.gap.cutoff else now.solid
        now = now._replace(pressure=pressure, solid=solid)
        if not self.gap.moves:  # extrapolations from step to step would amplify round-off
            now = now._replace(rim=self.first.rim, rim_speed=0.0)
        h = self.gap.gap(now)
        return now._replace(content=np.where(sets.void, now.content, h))

    def solve(self) -> None:
        factors: Factors | None = None
        before, size = math.inf, math.inf
        for self.n_iterations in range(1, _MOST + 1):
            residual = self._residual(slopes=factors is None)
            if factors is None:
                factors = self._factors()
            change = lu_solve(factors, -residual.ravel(), check_finite=False)
            if not np.isfinite(change).all():
                raise StepFailedError("singular")
            change = change.reshape(residual.shape)
            scale = self._largest_step(change)
            self._add(scale * change)
            size = self._size(change)
            changed = self._update_sets()
            if changed or scale < 1.0:
                factors, before = None, math.inf
                continue
            if size < _SOLVED or (size < _STALLED and size > 0.5 * before):
                return
            if size > _CONTRACTION * before or not math.isfinite(before):
                factors = None
            before = size
        raise StepFailedError(f"not converged: corrections of {size:.1e}")

    def _residual(self, *, slopes: bool) -> Array:
        self.levels = [
            self.gap.levels(now, sets, time, self.touching, slopes=slopes)
            for now, sets, time in zip(self.now, self.sets, self.times, strict=True)
        ]
        stored = self._first_stored()
        change = np.array([one.stored for one in self.levels]) - stored
        found: Array = self.matrix @ change + np.array([one.rest for one in self.levels])
        return found

    def _first_stored(self) -> Array:
        """Q at the start, in the rows of the nodes that touch now: those store nothing."""
        n, now = len(self.gap.shape), len(self.touching)
        known = len(self.stored) - self.gap.size(self.touching[:0])
        return np.concatenate([self.stored[:n], np.zeros(now), self.stored[n + known :]])

    def _factors(self) -> Factors:
        s, size = len(self.now), self.gap.size(self.touching)
        whole = np.empty((s, size, s, size))
        for j, one in enumerate(self.levels):
            for k in range(s):
                np.multiply(one.stored_slopes, self.matrix[k, j], out=whole[k, :, j])
            whole[j, :, j] += one.rest_slopes
        self.n_factorisations += 1
        flat = whole.reshape(s * size, s * size)
        return lu_factor(flat, overwrite_a=True, check_finite=False)

    def _changes(self, change: Array, k: int) -> Fields:
        """Changes of the fields of a stage, from a row of unknowns."""
        n, at = len(self.gap.shape), len(self.gap.shape) + len(self.touching)
        void, row = self.sets[k].void, change[k]
        solid = np.zeros(n)
        solid[self.touching] = row[n:at]
        rim = (row[at + 2], row[at + 3]) if self.gap.moves else (0.0, 0.0)
        pressure, content = np.where(void, 0.0, row[:n]), np.where(void, row[:n], 0.0)
        return Fields(pressure, content, solid, row[at], row[at + 1], *rim)

    def _largest_step(self, change: Array) -> float:
        """Part of a correction that keeps gaps open, where nothing touches, and rims positive."""
        if self.gap.cutoff:
            return 1.0
        scale = 1.0
        for k, now in enumerate(self.now):
            moved, h = self._changes(change, k), self.gap.gap(now)
            slope = moved.rigid_gap + now.rim * (self.gap.compliance @ moved.pressure)
            if self.gap.moves:
                scale = min(scale, _RIM_CHANGE * now.rim / max(abs(moved.rim), 1e-300))
                total = self.gap.compliance @ now.pressure + 2.0 * now.rim * self.gap.shape
                slope = slope + moved.rim * total
            closing = slope < 0.0
            room = (1.0 - _LEAST_GAP) * h[closing] / -slope[closing]
            scale = min(scale, float(room.min(initial=1.0)))
        if scale < 1e-8:
            raise StepFailedError("a gap closes")
        return scale

    def _add(self, change: Array) -> None:
        for k, now in enumerate(self.now):
            moved = self._changes(change, k)
            added = Fields(
                now.pressure + moved.pressure,
                now.content + moved.content,
                now.solid + moved.solid,
                now.rigid_gap + moved.rigid_gap,
                now.speed + moved.speed,
                now.rim + moved.rim,
                now.rim_speed + moved.rim_speed,
            )
            self.now[k] = self._settled(added, self.sets[k])
            if not self.gap.cutoff and (self.gap.gap(self.now[k]) <= 0.0).any():
                raise StepFailedError("a gap closes")

    def _update_sets(self) -> bool:
        """Change the sets where their conditions fail; whether one did."""
        if self.gap.floor == -math.inf and not self.gap.cutoff:
            return False
        changed = False
        for k, (now, sets) in enumerate(zip(self.now, self.sets, strict=True)):
            h = self.gap.gap(now)
            void = np.where(sets.void, now.content < h, now.pressure < self.gap.floor)
            void[-1] = False
            contact = np.where(sets.contact, now.solid > 0.0, h < self.gap.cutoff)
            if (void != sets.void).any() or (contact != sets.contact).any():
                changed = True
                self.sets[k] = Sets(void, contact)
                self.now[k] = self._settled(now, self.sets[k])
        together = np.logical_or.reduce([one.contact for one in self.sets])
        self.touching = np.flatnonzero(together)
        return changed

    def _size(self, change: Array) -> float:
        """Size of a correction over that of the unknowns."""
        size = 0.0
        # A pressure that moves nothing and that of a film at rest: 1e-6 of a gap of 1.
        least = 1e-6 * min(1.0, self.gap.stiffness)
        even = np.ones(len(self.gap.shape))
        for k, now in enumerate(self.now):
            moved = self._changes(change, k)
            mean = self.gap.imposed(now, self.times[k]) / self.gap.thrust(even, now.rim)
            whole = max(float(np.abs(now.pressure + now.solid).max()), mean, least)
            parts = (
                float(np.abs(moved.pressure).max()) / whole,
                float(np.abs(moved.solid).max()) / whole,
                float(np.abs(moved.content).max()) / float(now.content.max()),
                abs(moved.rigid_gap),
                abs(moved.rim),
            )
            size = max(size, *parts)
        return size


def _error(newton: _Newton, first: Levels) -> Fields:
    r"""Estimated error of the end: :math:`(\gamma/h\,Q' + R')^{-1} (\sum e_i (Q_i - Q_0)/h - R_0)`.

    R_0 of nodes that were in a cavity or touched at the start is taken as it was then.
    """
    method, gap = newton.method, newton.gap
    end = gap.levels(
        newton.now[-1], newton.sets[-1], newton.times[-1], newton.touching, slopes=True
    )
    n = len(gap.shape)
    start = np.concatenate(
        [first.rest[:n], np.zeros(len(newton.touching)), first.rest[-(2 + 2 * gap.moves) :]]
    )
    stored = np.array([one.stored for one in newton.levels]) - newton._first_stored()
    right = method.error @ stored / newton.length - start
    matrix = method.gamma / newton.length * end.stored_slopes + end.rest_slopes
    found = np.linalg.solve(matrix, right)
    return newton._changes(found[None].repeat(len(newton.now), axis=0), len(newton.now) - 1)
