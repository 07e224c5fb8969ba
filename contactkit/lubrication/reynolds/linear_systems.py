"""Sparse linear systems of the film: SuperLU, and CHOLMOD or multigrid where they are installed.

All matrices have positive diagonals, no positive entry beside them, and columns that are
diagonally dominant, so that elimination without pivoting is stable and an ordering for symmetric
matrices can be used throughout.
"""

from __future__ import annotations

import importlib.util
from collections.abc import Callable
from typing import TYPE_CHECKING, Any

import numpy as np

from ...errors import ConvergenceError, DescriptionError, MissingExtraError

if TYPE_CHECKING:
    from numpy.typing import NDArray

    Array = NDArray[np.floating[Any]]

__all__ = [
    "SOLVERS",
    "choose_solver",
    "factorised",
    "solve_sparse",
]

SOLVERS = ("superlu", "cholmod", "amg")
LARGE = 60_000
"""Unknowns from which a solver other than SuperLU pays."""
_PACKAGES = {"cholmod": "sksparse", "amg": "pyamg"}


def choose_solver(asked: str | None, size: int) -> str:
    """Linear solver for a number of unknowns.

    Parameters
    ----------
    asked : str, optional
        "superlu", "cholmod" (package scikit-sparse) or "amg" (package pyamg). None: SuperLU up to
        60 000 unknowns, beyond that CHOLMOD or else multigrid if it is installed.
    size : int
        Number of unknowns.

    Raises
    ------
    DescriptionError
        If the name is none of these.
    MissingExtraError
        If what is asked for is not installed.

    Examples
    --------
    >>> choose_solver(None, 1000)
    'superlu'
    """
    if asked is None:
        if size <= LARGE:
            return "superlu"
        there = (name for name in ("cholmod", "amg") if importlib.util.find_spec(_PACKAGES[name]))
        return next(there, "superlu")
    if asked not in SOLVERS:
        expected = f"be one of {', '.join(map(repr, SOLVERS))}"
        raise DescriptionError("solver", asked, expected)
    package = _PACKAGES.get(asked)
    if package is not None and importlib.util.find_spec(package) is None:
        name = {"sksparse": "scikit-sparse", "pyamg": "contactkit[films]"}[package]
        raise MissingExtraError(
            f"solver={asked!r} needs {package}, which is not installed: pip install {name}, or "
            "leave the solver out",
            name=package,
        )
    return asked


def solve_sparse(matrix: Any, right: Array, solver: str, is_symmetric: bool) -> Array:
    """Solve a sparse system.

    Parameters
    ----------
    matrix : sparse array, shape (n, n)
        The matrix, CSR or CSC.
    right : ndarray, shape (n,) or (n, k)
        Right-hand sides.
    solver : str
        See `choose_solver`. An unsymmetric system is always solved by SuperLU.
    is_symmetric : bool
        Whether the matrix is symmetric and positive definite.

    Raises
    ------
    ConvergenceError
        If the matrix is singular: some liquid is connected to no reservoir.

    Examples
    --------
    >>> from scipy.sparse import csc_array
    >>> solve_sparse(csc_array([[2.0, -1.0], [-1.0, 2.0]]), np.array([1.0, 1.0]), "superlu", True)
    array([1., 1.])
    """
    if solver == "amg" and is_symmetric:
        return _multigrid(matrix, right)
    if solver == "cholmod" and is_symmetric:
        from scipy.sparse import csc_matrix
        from sksparse.cholmod import cholesky

        found = np.asarray(cholesky(csc_matrix(matrix))(right))
    else:
        found = factorised(matrix)(right)
    if not np.isfinite(found).all():
        raise ConvergenceError("the film has no unique pressure: its matrix is singular")
    return found


def factorised(matrix: Any) -> Callable[[Array], Array]:
    """Factors of a matrix, as a function of right-hand sides.

    Parameters
    ----------
    matrix : sparse array, shape (n, n)
        Symmetric and positive definite.

    Raises
    ------
    ConvergenceError
        If the matrix is singular: some liquid is connected to no reservoir.

    Examples
    --------
    >>> from scipy.sparse import csc_array
    >>> solve = factorised(csc_array([[4.0, -2.0], [-2.0, 4.0]]))
    >>> solve(np.array([2.0, 2.0])).round(6).tolist()
    [1.0, 1.0]
    """
    # Columns are diagonally dominant: conductances, and what walls carry from a cell to others. No
    # pivots are needed, and the order of a symmetric pattern fills least.
    factors: Any = _superlu(matrix.tocsc())
    return lambda right: np.asarray(factors.solve(right))


def _superlu(matrix: Any) -> Any:
    from scipy.sparse.linalg import splu

    try:
        return splu(
            matrix,
            permc_spec="MMD_AT_PLUS_A",
            diag_pivot_thresh=0.0,
            relax=8,
            panel_size=1,  # twice as fast as the default here: supernodes are small
            options={"SymmetricMode": True},
        )
    except RuntimeError as error:
        raise ConvergenceError(f"the film has no unique pressure: {error}") from error


def _multigrid(matrix: Any, right: Array) -> Array:
    """Conjugate gradients preconditioned by algebraic multigrid, on half of the unknowns.

    Every second cell has neighbours of the other half only: it is eliminated exactly, as the
    first level of the multigrid would do again in each iteration.
    """
    import pyamg
    from scipy.sparse import csr_matrix, diags_array

    given = csr_matrix(matrix)
    diagonal = given.diagonal()
    alone = pyamg.classical.split.RS(given) == 0
    alone &= ~(abs(given) @ alone > diagonal * alone * (1.0 + 1e-14))
    out, kept = np.flatnonzero(alone), np.flatnonzero(~alone)
    rows = given[kept]
    beside = rows[:, out]
    left = beside @ diags_array(1.0 / diagonal[out])
    reduced = csr_matrix(rows[:, kept] - left @ beside.T)
    reduced.sort_indices()
    levels = pyamg.ruge_stuben_solver(reduced, max_coarse=500)
    columns = right[:, None] if right.ndim == 1 else right
    found = np.empty(columns.shape)
    for i, column in enumerate(columns.T):
        residuals: list[float] = []
        x = levels.solve(
            column[kept] - left @ column[out],
            tol=1e-12,
            maxiter=100,
            accel="cg",
            residuals=residuals,
        )
        if residuals[-1] > 1e-9 * max(float(np.linalg.norm(column)), 1e-300):
            raise ConvergenceError(f"multigrid stopped at a residual of {residuals[-1]:.3g}", x)
        found[kept, i] = x
        found[out, i] = (column[out] - beside.T @ x) / diagonal[out]
    return found[:, 0] if right.ndim == 1 else found
