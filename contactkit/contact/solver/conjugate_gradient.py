"""Preconditioned conjugate gradients, in place: the iterative linear solver of the active set.

The preconditioner may vary from step to step (flexible conjugate gradients, Polak-Ribiere), as one
that solves a coarse problem by iterations does.
"""

from __future__ import annotations

from typing import Any, Protocol

import numpy as np
from numpy.typing import NDArray

from .loops_numpy import dot

__all__ = ["LinearSystem", "conjugate_gradient"]

Vector = NDArray[np.float32]


class LinearSystem(Protocol):
    """A symmetric positive definite operator A with its preconditioner.

    loops : namespace
        Loops over the pixels, `loops_numpy` or compiled.
    load_fixed : bool
        Whether the sum of the unknowns is kept: the equations then hold up to a constant.
    """

    loops: Any
    load_fixed: bool

    def apply(self, d: Vector, q: Vector) -> None:
        """Fill q with A d."""

    def precondition(self, r: Vector) -> Vector:
        """About the inverse of A times r, as a new array."""

    def take_step(self, length: float) -> None:
        """Note that ``length`` times the last d was added to the unknowns."""


def conjugate_gradient(
    system: LinearSystem, x: Vector, r: Vector, reduction: float, max_iterations: int
) -> None:
    """Reduce the norm of a residual by a factor.

    Parameters
    ----------
    system : LinearSystem
        Operator and preconditioner.
    x, r : ndarray (n,)
        Initial guess and its residual; overwritten by the last ones.
    reduction : float
        Of the norm of the residual [-].
    max_iterations : int
        Maximum number of iterations.
    """
    d, q = np.zeros_like(r), np.zeros_like(r)
    stop = reduction**2 * dot(r, r)
    length, rz = 0.0, 0.0
    for _ in range(max_iterations if stop > 0.0 else 0):
        z = system.precondition(r)
        rz = system.loops.next_direction(d, z, r, q, length, rz, system.load_fixed)
        system.apply(d, q)
        step = system.loops.step_along(x, r, d, q, system.load_fixed)
        length = step.length
        system.take_step(length)
        if step.squared_residual <= stop:
            break
