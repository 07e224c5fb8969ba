"""Tractions inside Coulomb's bound: projection, free directions, sums along given directions.

Tractions are arrays (k, n) of k components on n pixels, inside discs of radius b (n) = mu p, which
for one component are intervals.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

__all__ = ["FreeDirections", "lengths", "onto_discs", "onto_discs_and_sum", "towards"]

Array = NDArray[np.float64]
# Newton: twelve are enough on paths of spheres and rough maps, at 0.9999 of full sliding too. Six
# cost 2 % more applications of H, as sums are missed and made up for; three, three quarters more.
_ITERATIONS = 50


def lengths(q: Array) -> Array:
    """Length of each traction, (n,).

    Examples
    --------
    >>> lengths(np.array([[3.0, 0.0], [4.0, -1.0]]))
    array([5., 1.])
    """
    return np.abs(q[0]) if len(q) == 1 else np.asarray(np.hypot(q[0], q[1]))


def onto_discs(q: Array, bound: Array) -> Array:
    """Nearest tractions inside the bound.

    Examples
    --------
    >>> onto_discs(np.array([[3.0, 0.5], [4.0, 0.0]]), np.array([1.0, 1.0]))
    array([[0.6, 0.5],
           [0.8, 0. ]])
    """
    size = lengths(q)
    factor = np.divide(bound, size, out=np.ones_like(size), where=size > bound)
    return q * factor


def onto_discs_and_sum(q: Array, bound: Array, along: Array, total: Array) -> Array:
    """Nearest tractions inside the bound whose sums along the columns of `along` are `total`.

    All tractions are shifted alike and then projected; the shift is found by Newton's method with
    the slope of a secant where a step does not help.

    Parameters
    ----------
    q : ndarray (k, n)
        [Pa].
    bound : ndarray (n,)
        [Pa].
    along : ndarray (k, m)
        Orthonormal directions; none of them leaves the sums free.
    total : ndarray (m,)
        [Pa], within the sum of the bounds.

    Examples
    --------
    >>> one = onto_discs_and_sum(
    ...     np.array([[0.0, 2.0]]), np.array([1.0, 1.0]), np.eye(1), np.array([1.5])
    ... )
    >>> print(one.round(9))
    [[0.5 1. ]]
    """
    if along.shape[1] == 0:
        return onto_discs(q, bound)
    shift = np.zeros(len(total))
    found = onto_discs(q, bound)
    missing = total - along.T @ found.sum(axis=1)
    scale = float(bound.sum())
    for _ in range(_ITERATIONS):
        if float(np.abs(missing).max()) <= 1e-15 * scale:
            break
        slope = _slope(q + (along @ shift)[:, None], bound, along)
        change = np.linalg.solve(slope, missing)
        length = 1.0
        for _ in range(30):
            trial = onto_discs(q + (along @ (shift + length * change))[:, None], bound)
            left = total - along.T @ trial.sum(axis=1)
            if np.linalg.norm(left) < np.linalg.norm(missing):
                break
            length *= 0.5
        else:
            break
        shift, found, missing = shift + length * change, trial, left
    return found


def _slope(q: Array, bound: Array, along: Array) -> Array:
    """Slope of the sums of the projected tractions with the shift, made regular."""
    size = lengths(q)
    outside = size > bound
    n_inside = float(np.count_nonzero(~outside))
    slope = n_inside * np.eye(along.shape[1])
    if len(q) == 2 and outside.any():
        n = along.T @ (q[:, outside] / size[outside])
        ratio = bound[outside] / size[outside]
        slope += float(ratio.sum()) * np.eye(len(n)) - (ratio * n) @ n.T
    return np.asarray(slope + 1e-3 * np.eye(len(slope)))


def towards(q: Array, bound: Array, along: Array, total: Array) -> Array:
    """Tractions inside the bound with given sums, on the straight line to full sliding.

    Examples
    --------
    >>> towards(np.zeros((1, 2)), np.array([1.0, 3.0]), np.eye(1), np.array([2.0]))
    array([[0.5, 1.5]])
    """
    now = along.T @ q.sum(axis=1)
    step, largest = total - now, float(bound.sum())
    if not np.any(step) or largest == 0.0:
        return q
    # The point of the sphere of full sliding on the ray from `now` through `total`.
    a, b, c = float(step @ step), float(now @ step), float(now @ now) - largest**2
    reach = (-b + math.sqrt(max(b * b - a * c, 0.0))) / a
    if reach <= 1.0:
        end = total / max(float(np.linalg.norm(total)), largest)
        return np.asarray((along @ end)[:, None] * bound)
    end = (now + reach * step) / largest
    return np.asarray(q + ((along @ end)[:, None] * bound - q) / reach)


class FreeDirections(NamedTuple):
    """Directions in which tractions may change: all where they stick, across them where they slip.

    Attributes
    ----------
    slip : ndarray of bool (n,)
        Pixels at the bound.
    normal : ndarray (k, n)
        Unit vectors along the tractions.
    curvature : ndarray (n,)
        Multiplier over bound, the stiffness that the curved bound adds across it.
    """

    slip: NDArray[np.bool_]
    normal: Array
    curvature: Array

    def keep(self, x: Array) -> Array:
        """Part of `x` along the free directions."""
        if len(x) == 1:
            return np.where(self.slip, 0.0, x)
        inward = np.where(self.slip, (self.normal * x).sum(axis=0), 0.0)
        return np.asarray(x - inward * self.normal)

    def added(self, x: Array) -> Array:
        """Displacement that the curved bound adds under a change `x`."""
        if len(x) == 1:
            return np.zeros_like(x)
        return np.asarray(self.curvature * x)

    def uniform(self, along: Array) -> Array:
        """Uniform tractions along each of the columns of `along`, (m, k, n), kept free."""
        ones = np.ones(self.slip.size)
        found = [self.keep(column[:, None] * ones) for column in along.T]
        return np.array(found).reshape(len(found), *self.normal.shape)
