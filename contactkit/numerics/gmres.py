"""GMRES with a preconditioner from the right, so that the norm that it minimises is the residual's.

`scipy.sparse.linalg.gmres` compares that norm with one of the preconditioned right-hand side, which
has another unit here.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

__all__ = ["Solved", "gmres"]

Array = NDArray[np.float64]


class Solved(NamedTuple):
    """Solution of a linear system.

    `residual` is its norm over that of the right-hand side.
    """

    x: Array
    n_iterations: int
    residual: float


def gmres(
    apply: Callable[[Array], Array],
    right: Array,
    precondition: Callable[[Array], Array],
    tolerance: float,
    most: int,
) -> Solved:
    """Solve a linear system by GMRES without restarts, from zero.

    Parameters
    ----------
    apply, precondition : callable
        Product with the matrix, and with an approximation of its inverse.
    right : ndarray, shape (n,)
        Right-hand side.
    tolerance : float
        Norm of the residual over that of the right-hand side.
    most : int
        Iterations, after which the best solution so far is given.

    References
    ----------
    Saad, Iterative Methods for Sparse Linear Systems (2003), algorithm 9.5.

    Examples
    --------
    >>> A = np.array([[2.0, 1.0], [0.0, 3.0]])
    >>> found = gmres(lambda x: A @ x, np.array([4.0, 3.0]), lambda r: r / 2.0, 1e-12, 9)
    >>> found.x.round(12).tolist(), found.n_iterations
    ([1.5, 1.0], 2)
    """
    norm = float(np.linalg.norm(right))
    if norm == 0.0:
        return Solved(np.zeros_like(right), 0, 0.0)
    basis, images = np.empty((most + 1, right.size)), np.empty((most, right.size))
    triangle, rotated = np.zeros((most + 1, most)), np.zeros(most + 1)
    cosine, sine = np.zeros(most), np.zeros(most)
    basis[0], rotated[0] = right / norm, norm
    count, left = 0, 1.0
    while count < most and left > tolerance:
        k = count
        images[k] = precondition(basis[k])
        column, follows = _orthogonal(apply(images[k]), basis[: k + 1])
        length = float(np.linalg.norm(follows))
        for i in range(k):
            column[i], column[i + 1] = (
                cosine[i] * column[i] + sine[i] * column[i + 1],
                cosine[i] * column[i + 1] - sine[i] * column[i],
            )
        diagonal = float(np.hypot(column[k], length))
        count += 1
        if diagonal == 0.0:  # the image is no new direction: nothing more can be had
            count -= 1
            break
        cosine[k], sine[k] = column[k] / diagonal, length / diagonal
        column[k] = diagonal
        triangle[: k + 1, k] = column
        rotated[k + 1], rotated[k] = -sine[k] * rotated[k], cosine[k] * rotated[k]
        left = abs(rotated[k + 1]) / norm
        if length == 0.0:
            break
        basis[k + 1] = follows / length
    weights = np.linalg.solve(triangle[:count, :count], rotated[:count])
    return Solved(weights @ images[:count], count, float(left))


def _orthogonal(vector: Array, basis: Array) -> tuple[Array, Array]:
    """Components along a basis, and what is left; twice, as once loses orthogonality."""
    column = basis @ vector
    vector = vector - column @ basis
    again = basis @ vector
    return column + again, vector - again @ basis
