"""Rings of an axisymmetric film: nodes, areas, and the conductance between neighbours."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
from attrs import field, frozen
from numpy.typing import NDArray

from ...numerics.quadrature import gauss_legendre

__all__ = ["RingMesh", "disc_nodes", "graded_nodes"]

Array = NDArray[np.float64]

# h^3 x on an element, of a gap that is linear there, is a polynomial of degree 4.
_SHARE, _WEIGHT = (np.array(one) for one in gauss_legendre(3))


def graded_nodes(count: int, rim: float, finest: float = 1.0) -> Array:
    """Radii that are equal near the axis and grow as an exponential beyond `finest`.

    Parameters
    ----------
    count : int
        Elements; of twice as many every other node is one of these.
    rim : float
        Last radius.
    finest : float
        Radius over which elements are about equal: of a sphere ``sqrt(R h)``, the width of its
        pressure.

    Examples
    --------
    >>> graded_nodes(4, 8.0).round(3).tolist()
    [0.0, 0.751, 1.879, 3.949, 8.0]
    """
    stretch = max(math.asinh(rim / finest), 1.0)
    nodes: Array = rim * np.sinh(stretch * np.linspace(0.0, 1.0, count + 1)) / math.sinh(stretch)
    return nodes


def disc_nodes(count: int, rim: float) -> Array:
    """Radii that crowd at the rim, where the displacement has a logarithmic slope.

    Examples
    --------
    >>> disc_nodes(4, 1.0).round(3).tolist()
    [0.0, 0.369, 0.67, 0.891, 1.0]
    """
    nodes: Array = rim * (1.0 - np.linspace(1.0, 0.0, count + 1) ** 1.6)
    return nodes


@frozen(eq=False)
class RingMesh:
    """Linear elements on rings: a function is the sum of hats times its values at the nodes.

    Parameters
    ----------
    nodes : ndarray, shape (n + 1,)
        Ascending radii, the first 0.

    Attributes
    ----------
    areas : ndarray, shape (n + 1,)
        Integral of each hat times the radius: areas over 2 pi.

    Examples
    --------
    >>> mesh = RingMesh(np.linspace(0.0, 1.0, 5))
    >>> round(float(mesh.areas.sum()), 12)
    0.5
    """

    nodes: Array
    areas: Array = field(init=False)
    _over_length: Array = field(init=False)
    _outward: tuple[Array, Array] = field(init=False)

    @areas.default
    def _areas(self) -> Array:
        left, right = self.nodes[:-1], self.nodes[1:]
        found = np.zeros(len(self.nodes))
        found[:-1] += (right - left) * (2.0 * left + right) / 6.0
        found[1:] += (right - left) * (left + 2.0 * right) / 6.0
        return found

    @_over_length.default
    def _radius_over_length(self) -> Array:
        width = np.diff(self.nodes)[:, None]
        found: Array = (self.nodes[:-1, None] + width * _SHARE) * _WEIGHT / (12.0 * width)
        return found

    @_outward.default
    def _outward_moments(self) -> tuple[Array, Array]:
        width = np.diff(self.nodes)[:, None]
        square = (self.nodes[:-1, None] + width * _SHARE) ** 2 * _WEIGHT
        return (square * (1.0 - _SHARE)).sum(axis=1), (square * _SHARE).sum(axis=1)

    def conductance(self, gap: Array) -> tuple[Array, Array, Array]:
        """Volume flow per unit difference of pressure, viscosity 1 and 2 pi; slopes by the gaps.

        Parameters
        ----------
        gap : ndarray, shape (n + 1,)

        Returns
        -------
        value, by_left, by_right : ndarray, shape (n,)
            Of each element, and its derivatives by the gap at either end.
        """
        h = gap[:-1, None] * (1.0 - _SHARE) + gap[1:, None] * _SHARE
        squares = self._over_length * h * h
        thrice = 3.0 * squares
        by_right = thrice @ _SHARE
        return (squares * h).sum(axis=1), thrice.sum(axis=1) - by_right, by_right

    def carried(self, content: Array) -> Array:
        """Flow through the nodes of a mesh whose radii all grow at rate 1, of a liquid at rest."""
        left, right = self._outward
        flow = left * content[:-1] + right * content[1:]
        found = np.zeros(len(content))
        found[:-1] -= flow
        found[1:] += flow
        return found

    def carried_slopes(self) -> Tridiagonal:
        """Derivative of `carried` by the content."""
        left, right = self._outward
        return Tridiagonal.of_elements(-left, -right, left, right)


@frozen(eq=False)
class Tridiagonal:
    """A tridiagonal matrix: its diagonal and those below and above it."""

    diagonal: Array
    below: Array
    above: Array

    @classmethod
    def of_elements(cls, ll: Any, lr: Any, rl: Any, rr: Any) -> Tridiagonal:
        """Sum of matrices [[ll, lr], [rl, rr]] of elements, on their left and right nodes."""
        diagonal = np.zeros(len(lr) + 1)
        diagonal[:-1] += ll
        diagonal[1:] += rr
        return cls(diagonal, np.array(rl), np.array(lr))

    def times(self, other: Array) -> Array:
        """Product with a vector, or with a matrix of columns."""
        wide = (slice(None), None) if other.ndim == 2 else slice(None)
        found: Array = self.diagonal[wide] * other
        found[1:] += self.below[wide] * other[:-1]
        found[:-1] += self.above[wide] * other[1:]
        return found

    def plus(self, other: Tridiagonal, factor: float) -> Tridiagonal:
        """Sum with a multiple of another."""
        return Tridiagonal(
            self.diagonal + factor * other.diagonal,
            self.below + factor * other.below,
            self.above + factor * other.above,
        )

    def dense(self) -> Array:
        """As a full matrix."""
        return np.diag(self.diagonal) + np.diag(self.below, -1) + np.diag(self.above, 1)
