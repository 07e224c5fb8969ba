r"""The complementarity problem of a film that cavitates: P >= 0, s >= 0, P s = 0 in every cell.

.. math:: \mathsf L P - \mathsf M s + f = 0, \qquad P = p - p_{cav} \ge 0, \qquad
          s = 1 - \theta \ge 0, \qquad P s = 0

L holds the conductances, M what a void takes up and what the walls carry of it, f the volume that
a full film at P = 0 would lack. An active set (semismooth Newton on min(P, s)) guesses which cells
are full; it moves the edge of a cavity by about a cell an iteration, so a guess from a coarser
grid matters. Newton on the Fischer-Burmeister function is the fallback.

References: Giacopini et al. 2010; Hintermueller, Ito and Kunisch 2002; Woloszynski, Podsiadlo and
Stachowiak 2015.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from ...errors import ConvergenceError
from .linear_systems import solve_sparse

if TYPE_CHECKING:
    from numpy.typing import NDArray

    Array = NDArray[np.floating[Any]]
    Set = NDArray[np.bool_]

__all__ = ["ComplementarityProblem", "Solution", "solve_active_set", "solve_fischer_burmeister"]

# At the edge of a cavity a pressure, and a void, are zero but for the round-off of a linear
# solution: without it sets repeat. 1e-16 to 1e-8 find the same cells in the same solutions on 96 x
# 72 cells.
ROUND_OFF = 1e-13
"""Negative pressure over the largest, and void fraction, that count as zero."""


class ComplementarityProblem(NamedTuple):
    """A complementarity problem in q = p - reference, of n cells."""

    conductances: Any
    """L, sparse, symmetric and positive definite, shape (n, n)."""
    storage: Array
    """Diagonal of M without transport, shape (n,)."""
    transport: Any
    """What walls carry of the voids, sparse, shape (n, n); None without sliding."""
    deficit: Array
    """f at q = 0, shape (n,)."""
    drop: Array
    """Reference less the floor of the pressure, shape (n,): P = q + drop; inf without a floor."""
    solver: str
    """Linear solver."""


class Solution(NamedTuple):
    """Solution of a complementarity problem."""

    q: Array
    """Pressure less the reference, shape (n,)."""
    void: Array
    """Void fraction s, shape (n,)."""
    iterations: int
    """Linear systems that were solved."""
    settled: bool
    """Whether the set of full cells no longer changed."""


def solve_active_set(problem: ComplementarityProblem, full: Set, limit: int) -> Solution:
    """Solve by a primal-dual active set, from a guess of the full cells.

    Parameters
    ----------
    problem : ComplementarityProblem
        The problem.
    full : ndarray of bool, shape (n,)
        Cells that are full in the guess.
    limit : int
        Most iterations.

    Returns
    -------
    Solution
        Exact up to round-off if it has settled; not settled after `limit` iterations, or when a
        set comes a second time.

    Examples
    --------
    Two cells between reservoirs, pulled at unit rate, with a floor 1/8 below the reservoirs.

    >>> from scipy.sparse import csr_array
    >>> ladder = csr_array([[2.0, -1.0], [-1.0, 2.0]])
    >>> ones = np.ones(2)
    >>> problem = ComplementarityProblem(ladder, ones, None, ones, ones / 8, "superlu")
    >>> found = solve_active_set(problem, np.ones(2, bool), 9)
    >>> found.q.tolist(), found.void.tolist(), found.iterations
    ([-0.125, -0.125], [0.875, 0.875], 2)
    """
    seen: set[bytes] = set()
    count = 0
    while True:
        count += 1
        # A step is the exact solution for a set: Newton's method on a piecewise linear system,
        # which ends as soon as the set is right, whatever the start.
        q, void = _with_set(problem, full)
        pressure = q + problem.drop
        # A full cell gives way below its floor; a void one is full where liquid overfills it.
        new = np.where(full, pressure >= -ROUND_OFF * np.abs(q).max(), void < -ROUND_OFF)
        settled = bool(np.array_equal(new, full))
        if settled or count >= limit or new.tobytes() in seen:
            return Solution(q, np.maximum(void, 0.0), count, settled)
        full = new
        seen.add(full.tobytes())


def _with_set(problem: ComplementarityProblem, full: Set) -> tuple[Array, Array]:
    """Pressures of the full cells and void fractions of the others."""
    matrix, f = problem.conductances, problem.deficit
    if full.all():
        return solve_sparse(matrix, -f, problem.solver, is_symmetric=True), np.zeros_like(f)
    q, void = np.where(full, 0.0, -problem.drop), np.zeros_like(f)
    known = f + matrix @ q
    if problem.transport is None:  # the voids do not act on the full cells
        rows = np.flatnonzero(full)
        if rows.size:
            inner = matrix[rows][:, rows]
            q[rows] = solve_sparse(inner, -known[rows], problem.solver, is_symmetric=True)
        return q, np.where(full, 0.0, (matrix @ q + f) / problem.storage)
    from scipy.sparse import diags_array

    kept, cavitated = diags_array(full * 1.0), diags_array(~full * 1.0)
    moved = problem.transport + diags_array(problem.storage)
    # The unknown of a void cell is -s, so that the diagonal is positive.
    mixed = matrix @ kept + moved @ cavitated
    w = solve_sparse(mixed, -known, problem.solver, is_symmetric=False)
    q[full], void[~full] = w[full], -w[~full]
    return q, void


def solve_fischer_burmeister(
    problem: ComplementarityProblem, start: Solution, limit: int = 400
) -> Solution:
    r"""Solve by Newton on the Fischer-Burmeister function, P + s - sqrt(P^2 + s^2) = 0.

    Parameters
    ----------
    problem : ComplementarityProblem
        The problem; every cell has a floor.
    start : Solution
        Where to start.
    limit : int
        Most iterations.

    Raises
    ------
    ConvergenceError
        If it does not converge.

    Notes
    -----
    In each cell the variable with the smaller derivative is eliminated: one unknown a cell is
    left. Void fractions below 1e-9 are what the smoothing leaves of zero and are set to it, or
    the memory would drift.

    Examples
    --------
    >>> from scipy.sparse import csr_array
    >>> ladder, ones = csr_array([[2.0, -1.0], [-1.0, 2.0]]), np.ones(2)
    >>> problem = ComplementarityProblem(ladder, ones, None, ones, ones / 8, "superlu")
    >>> start = Solution(-ones / 8, ones, 0, False)
    >>> solve_fischer_burmeister(problem, start).void.round(9).tolist()
    [0.875, 0.875]
    """
    from scipy.sparse import diags_array

    storage = diags_array(problem.storage)
    moved = storage if problem.transport is None else storage + problem.transport
    unit = float(problem.drop.max())
    matrix = problem.conductances * unit
    f = problem.deficit - problem.conductances @ problem.drop
    pressure, void = np.maximum((start.q + problem.drop) / unit, 0.0), start.void.copy()
    scale = float(np.abs(f).max() + np.abs(matrix.diagonal()).max())
    for count in range(limit):
        # P + s - sqrt(P^2 + s^2) is zero where P >= 0, s >= 0 and P s = 0, and smooth but where
        # both vanish: no set of cells to go round in circles.
        norm = np.hypot(pressure, void)
        phi, residual = pressure + void - norm, matrix @ pressure - moved @ void + f
        if max(float(np.abs(residual).max()) / scale, float(np.abs(phi).max())) < 1e-12:
            void = np.where((void < 1e-9) & (pressure > void), 0.0, np.maximum(void, 0.0))
            q = np.where(void > 0.0, 0.0, pressure * unit) - problem.drop
            return Solution(q, void, start.iterations + count, True)
        kink = norm <= 1e-12  # both zero: any element of the generalised derivative
        size = np.where(kink, 1.0, norm)
        by_pressure = np.where(kink, 1.0 - 0.5**0.5, 1.0 - pressure / size)
        by_void = np.where(kink, 1.0 - 0.5**0.5, 1.0 - void / size)
        keep = by_void >= by_pressure  # dP stays and ds follows; elsewhere the other way round
        a, b = np.where(keep, 1.0, by_pressure), np.where(keep, by_void, 1.0)
        dp, dp0 = np.where(keep, 1.0, by_void / a), np.where(keep, 0.0, -phi / a)
        ds, ds0 = np.where(keep, by_pressure / b, 1.0), np.where(keep, -phi / b, 0.0)
        # With w = dP where it is kept and w = -ds elsewhere, all coefficients are positive.
        mixed = matrix @ diags_array(dp) + moved @ diags_array(ds)
        w = solve_sparse(
            mixed, moved @ ds0 - matrix @ dp0 - residual, problem.solver, is_symmetric=False
        )
        pressure, void = pressure + dp * w + dp0, void - ds * w + ds0
    raise ConvergenceError(
        f"the cavity was not found in {limit} iterations; take smaller steps or a finer grid",
        start,
    )
