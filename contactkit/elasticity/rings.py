r"""Displacement of solids of revolution under pressures that are linear between rings.

A pressure that is linear in the radius between nodes is a sum of hats, and the displacement under
a hat is that of discs of uniform pressure, superposed. On a half-space a unit pressure on a disc
of radius a displaces the surface at the radius r by (Johnson, Contact Mechanics, 1985, Eq. 3.29)

.. math:: u(r, a) = \frac{4}{\pi E^*} \begin{cases} a\,E(r/a), & r \le a \\
          r \left[ E(a/r) - (1 - a^2/r^2)\,K(a/r) \right], & r > a \end{cases}

Layers, or a rigid base below them, change the displacement at wavelengths of their thickness and
more: what they add to the half-space of the topmost material is an integral over the wavenumber q
whose integrand vanishes as :math:`e^{-2 q t}`,

.. math:: K_{ij} - K_{ij}^{\infty} = \int_0^\infty
          \left[ q\,C(q) - 2/E^*_1 \right] \hat\varphi_j(q)\,J_0(q r_i)\,dq, \qquad
          \hat\varphi_j(q) = \int \varphi_j(s)\,J_0(q s)\,s\,ds
"""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray
from scipy.special import ellipe, ellipkm1, j0

from ..errors import DescriptionError
from ..numerics.quadrature import gauss_legendre
from .layer_stack import Layers, stack_of
from .layered import compliance

__all__ = ["disc_displacement", "half_space_matrix", "matrix"]

Array = NDArray[np.float64]

# Points of an element by its distance from the node [elements]. The displacement is smooth but for
# (r - a) ln|r - a| at the node: an element at distance d has an error of (rho + ...)^(-2 points),
# rho = 1 + 2 d + 2 sqrt(d + d^2), 1e-12 and less with these; on nodes at the square of equal
# distances, where neighbours differ threefold, the matrix is right to 2e-13.
_NEAR, _POINTS_NEAR, _POINTS_FAR = 3, 14, 6
# Of an element that touches the node: graded by the cube from both ends, 1e-14.
_POINTS_TOUCHING = 14
# Wavenumbers times the thickness of the topmost layer up to which its waves count, and up to which
# an element has the points for them: exp(-2 q t) (q t)^2 is 1e-10 and 4e-5 there, of what hats hold
# of such waves. 22 and 12 change the matrix by 1e-10 of its largest coefficient.
_LAST_WAVE, _RESOLVED = 14.0, 7.0
# Shortest waves over the smallest element that are taken into account under a coating far thinner
# than the elements: the spectrum of a hat falls as q^-5/2, and 40 leaves 1e-6 of the correction.
_SHORTEST = 40.0
_PANEL = 6.0  # largest radius times the width of a panel of 10 points: 1e-12
_BLOCK = 512  # wavenumbers at a time: some megabytes


def disc_displacement(radius: Array, disc_radius: Array) -> Array:
    """Displacement of a half-space by a unit pressure on a disc, times its contact modulus [m].

    Parameters
    ----------
    radius, disc_radius : ndarray, shape (...)
        Where, and radius of the disc [m]; they broadcast.

    Examples
    --------
    In the middle ``2 a``, at the edge ``4 a/pi``:

    >>> disc_displacement(np.array([0.0, 1.0]), np.array(1.0)).round(6).tolist()
    [2.0, 1.27324]
    """
    r, a = np.broadcast_arrays(np.asarray(radius, float), np.asarray(disc_radius, float))
    large, small = np.maximum(r, a), np.minimum(r, a)
    whole = np.where(large > 0.0, large, 1.0)
    ratio = small / whole
    found = ellipe(ratio * ratio)
    # 1 - k^2 from the difference of the radii: at the edge it would be lost in round-off.
    rest = (large - small) * (large + small) / (whole * whole)
    outside = rest > 0.0
    found -= np.where(outside & (r > a), rest * ellipkm1(np.where(outside, rest, 1.0)), 0.0)
    displacement: Array = 4.0 / math.pi * large * found
    return displacement


def half_space_matrix(nodes: Array) -> Array:
    """Displacement of a half-space at each node by the hat of each, times its contact modulus.

    Parameters
    ----------
    nodes : ndarray, shape (n + 1,)
        Ascending radii [m], the first 0. The last hat ends with a step, so that a pressure of ones
        is that on a disc.

    Returns
    -------
    ndarray, shape (n + 1, n + 1)
        K E* [m]: displacements are ``K @ pressure``.

    Raises
    ------
    DescriptionError
        If the nodes do not ascend from 0.

    Notes
    -----
    Exact for a pressure that is linear between the nodes, but for 1e-13 of its quadrature; the
    error for any other is that of its interpolation, of second order. Hertz's pressure on 50 equal
    elements has 2e-3 at its edge, where its slope is infinite.

    Examples
    --------
    >>> K = half_space_matrix(np.linspace(0.0, 1.0, 9))
    >>> (K @ np.ones(9))[[0, -1]].round(12).tolist(), round(4.0 / np.pi, 12)
    ([2.0, 1.273239544735], 1.273239544735)
    """
    x = _checked(nodes)
    n = len(x) - 1
    means = np.empty((n + 1, n))  # of disc_displacement over the discs of an element
    i, e = np.indices((n + 1, n))
    away = np.maximum(e - i, i - 1 - e)  # elements between; 0 and less: it touches the node
    for chosen, (share, weight) in (
        (away <= 0, _graded(_POINTS_TOUCHING)),
        ((away > 0) & (away <= _NEAR), _gauss(_POINTS_NEAR)),
        (away > _NEAR, _gauss(_POINTS_FAR)),
    ):
        node, element = i[chosen], e[chosen]
        discs = x[element, None] + (x[element + 1] - x[element])[:, None] * share
        means[chosen] = disc_displacement(x[node, None], discs) @ weight
    matrix = np.zeros((n + 1, n + 1))
    # A hat is a superposition of discs: p(s) = - int_s p'(a) da.
    matrix[:, :-1] += means
    matrix[:, 1:] -= means
    matrix[:, -1] += disc_displacement(x, x[-1])
    return matrix


def matrix(nodes: Array, *solids: Layers) -> Array:
    """Displacement of all solids together at each node by the hat of each.

    Parameters
    ----------
    nodes : ndarray, shape (n + 1,)
        Ascending radii [m], the first 0.
    *solids : Layers
        Half-spaces, layered ones, layers on a rigid base. None at all: rigid bodies.

    Returns
    -------
    ndarray, shape (n + 1, n + 1)
        [m/Pa]

    Raises
    ------
    DescriptionError
        As `half_space_matrix` and `layer_stack.stack_of`.

    Notes
    -----
    The layers add 1e-10 of the largest coefficient as error, 1e-6 where the topmost one is thinner
    than the smallest element over 3. Against the closed form of a pressure of one wavelength,
    ``tests/elasticity/test_rings.py``.

    Examples
    --------
    A rubber of 1 MPa on a rigid base, thin against the loaded disc: half of it sinks by the
    compressive strain of the layer, one of the edge is free.

    >>> thin = Layers([1e6], [0.3], [1e-3], "bonded")
    >>> x = np.linspace(0.0, 0.1, 51)
    >>> sunk = matrix(x, thin) @ np.full(51, 1e3)
    >>> round(sunk[0] * 1e9), round(1.3 * 0.4 / 0.7 * 1e3)
    (743, 743)
    """
    x = _checked(nodes)
    found = np.zeros((len(x), len(x)))
    half = half_space_matrix(x) if solids else found
    for one in solids:
        stack = stack_of(*one)
        top = float(stack.G[0] * 2.0 / (1.0 - stack.nu[0]))
        found += half / top
        if stack.h.size:
            found += _layers(x, one, top, float(stack.h[0]), float(stack.h.sum()))
    return found


def _checked(nodes: Array) -> Array:
    x = np.asarray(nodes, dtype=np.float64)
    if x.ndim != 1 or len(x) < 3 or x[0] != 0.0 or not (np.diff(x) > 0.0).all():
        raise DescriptionError(
            "rings.nodes", x.tolist(), "ascend from 0, with three radii at least", unit="m"
        )
    return x


def _gauss(count: int) -> tuple[Array, Array]:
    share, weight = gauss_legendre(count)
    return np.array(share), np.array(weight)


def _graded(count: int) -> tuple[Array, Array]:
    """Points that crowd at both ends of the unit interval as the cube of equal ones."""
    t, w = _gauss(count)
    share, weight = 0.5 * t**3, 1.5 * t * t * w
    return np.concatenate([share, 1.0 - share]), np.concatenate([weight, weight])


def _layers(x: Array, solid: Layers, top: float, thickness: float, whole: float) -> Array:
    """What layers add to the half-space of the topmost material [m/Pa]."""
    last = min(_LAST_WAVE / thickness, _SHORTEST / float(np.diff(x).min()))
    q, weight = _wavenumbers(last, x[-1], whole)
    factor = weight * (q * compliance(q, *solid).C - 2.0 / top)
    where, hats = _points(x, min(last, _RESOLVED / thickness))
    found = np.zeros((len(x), len(x)))
    for start in range(0, len(q), _BLOCK):
        part = slice(start, start + _BLOCK)
        transform = j0(q[part, None] * where) @ hats
        found += j0(q[part, None] * x).T @ (factor[part, None] * transform)
    return found


def _wavenumbers(last: float, reach: float, whole: float) -> tuple[Array, Array]:
    """Points and weights up to a wavenumber: panels that grow until they are one of waves."""
    widest = _PANEL / reach
    edges = [0.0, min(0.1 * widest, 0.1 / whole, last)]
    while edges[-1] < last:
        edges.append(min(edges[-1] + min(edges[-1], widest), last))
    t, w = _gauss(10)
    start, width = np.array(edges[:-1]), np.diff(edges)
    return (start[:, None] + width[:, None] * t).ravel(), (width[:, None] * w).ravel()


def _panels(count: int) -> tuple[Array, Array]:
    """Ten points in each of some equal panels of the unit interval."""
    t, w = _gauss(10)
    return ((np.arange(count)[:, None] + t) / count).ravel(), np.tile(w / count, count)


def _points(x: Array, shortest: float) -> tuple[Array, Array]:
    """Points of all elements, and the weight of each in the transform of each hat."""
    where, hats = [], []
    for e, (left, width) in enumerate(zip(x[:-1], np.diff(x), strict=True)):
        share, weight = _panels(1 + int(shortest * width / _PANEL))
        s = left + width * share
        row = np.zeros((len(s), len(x)))
        row[:, e] = (1.0 - share) * s * weight * width
        row[:, e + 1] = share * s * weight * width
        where.append(s)
        hats.append(row)
    return np.concatenate(where), np.concatenate(hats)
