r"""Uniform pressure on a rectangle of a half-space: Love's influence coefficients.

Pressure is positive in compression and the displacement `u` positive into the solid, as is z. The
rectangle is centred on the origin; the field is exactly even in x and y. Arguments are not checked.

============  ===================================================  =======
symbol        quantity                                             unit
============  ===================================================  =======
a, b          half sides of the rectangle along x and y            m
M             contact modulus E / (1 - nu^2)                       Pa
c             height above the surface that regularises 1/r        m
s             sqrt(x^2 + y^2 + c^2)                                m
F_k           (1/r d/dr)^k of a function F of the radius           m^-2k [F]
============  ===================================================  =======

Near the rectangle the four corners are combined before a logarithm is taken, so that cancellation
occurs at most once; farther away, and for large c, the mean of 1/s over the rectangle is a series
in its moments.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import ArrayLike, NDArray

__all__ = ["mean_over_cells", "rectangle"]

# In longer sides: beyond, the mean of 1/s is a series of sixth order, nearer the closed form. At 24
# both are off by 2e-14 at most; the series by 2e-13 from 16 on and 2e-12 from 12 on, the closed
# form, which cancels, by 1e-13 up to 72.
_FAR = 24.0
_DISTANT = 200.0  # likewise: beyond, the fourth order does, to 2e-14; to 5e-12 beyond 24
# In longer sides: nearer, means are differences of a fourfold integral, as the field inside a cell
# is too steep for quadrature (4e-9 at 1.2); farther these cancel (6e-12 at 7, 1e-11 at 20).
_TOUCHING = 3.5
# Points per block, to stay in the cache: a million at once take four times as long as 1 << 13 to 1
# << 17.
_BLOCK = 1 << 15
_FACTORIAL = (1.0, 2.0, 24.0, 720.0)  # of 0, 2, 4, 6


def rectangle(
    x: ArrayLike,
    y: ArrayLike,
    half_x: float,
    half_y: float,
    modulus: float,
    depth_offset: float = 0.0,
    average: bool = False,
) -> NDArray[np.float64]:
    r"""Displacement of a half-space under a unit pressure on a rectangle.

    .. math:: u(x, y) = \frac{1}{\pi M} \int_{-a}^{a} \int_{-b}^{b}
              \frac{dx'\, dy'}{\sqrt{(x - x')^2 + (y - y')^2 + c^2}}

    Parameters
    ----------
    x, y : array_like, broadcast to one another
        Offset from the centre of the rectangle [m].
    half_x, half_y : float
        Half sides a and b [m].
    modulus : float
        Contact modulus M = E / (1 - nu^2) [Pa].
    depth_offset : float
        Height c [m]: the displacement whose transform is :math:`2 e^{-\alpha c} / (M \alpha)` per
        unit pressure. Zero is Love's solution.
    average : bool
        Mean over a rectangle of the same sides centred at (x, y), instead of the value there. The
        matrix of these means on a grid is symmetric positive definite (Galerkin).

    Returns
    -------
    ndarray
        Displacement per unit pressure [m/Pa].

    Notes
    -----
    The relative error is about 1e-14 near the rectangle, below 2e-13 at any distance where c is
    zero, and below 1e-12 with c > 0 and for means.

    References
    ----------
    .. [1] A. E. H. Love, Phil. Trans. R. Soc. A 228 (1929) 377-420.
    .. [2] K. L. Johnson, Contact Mechanics (1985), Eq. 3.25.

    Examples
    --------
    The centre of a square of side 1 m sinks by 4 ln(1 + sqrt 2) / pi times side over modulus.

    >>> round(float(rectangle(0.0, 0.0, 0.5, 0.5, 1.0)), 12)
    1.122199704678
    >>> round(float(rectangle(0.0, 0.0, 0.5, 0.5, 1.0, average=True)), 12)
    0.946402008819
    """
    xs, ys = np.broadcast_arrays(np.abs(np.asarray(x, float)), np.abs(np.asarray(y, float)))
    shape = xs.shape
    xs, ys = xs.ravel(), ys.ravel()
    out = np.empty(xs.shape)
    for first in range(0, xs.size, _BLOCK):
        part = slice(first, first + _BLOCK)
        out[part] = _integral(xs[part], ys[part], half_x, half_y, depth_offset, average)
    return (out / (np.pi * modulus)).reshape(shape)


def mean_over_cells(
    x2: NDArray[np.float64],
    y2: NDArray[np.float64],
    half_x: float,
    half_y: float,
    derivatives: Sequence[NDArray[np.float64]],
    average: bool = False,
) -> NDArray[np.float64]:
    r"""Mean over a rectangle of a slowly varying function of the radius.

    .. math:: \langle F \rangle = \sum_{p, q} \frac{\langle t_x^{2p} \rangle
              \langle t_y^{2q} \rangle}{(2p)!\,(2q)!} \,\partial_x^{2p} \partial_y^{2q} F

    Parameters
    ----------
    x2, y2 : ndarray
        Squares of the offset of the centre of the rectangle from the origin [m2].
    half_x, half_y : float
        Half sides of the rectangle [m].
    derivatives : sequence of ndarray
        F, F_1, F_2 ... with F_k = (1/r d/dr)^k F: 3, 5 or 7 of them give the second, fourth or
        sixth order in side over distance.
    average : bool
        Mean over two such rectangles, of the source and of the field.

    Returns
    -------
    ndarray
        The mean [unit of F]; the first neglected term is two orders higher.

    Examples
    --------
    The mean of r^2 over a square of side 2 is r^2 + 2/3 exactly.

    >>> zero = np.zeros(1)
    >>> r2 = np.array([9.0])
    >>> mean_over_cells(r2, zero, 1.0, 1.0, [r2, zero + 2.0, zero])
    array([9.66666667])
    """
    f = derivatives
    mx, my = (_moments(half, average) for half in (half_x, half_y))
    total = f[0] + mx[1] * (f[1] + x2 * f[2]) + my[1] * (f[1] + y2 * f[2])
    if len(f) > 4:
        both = f[2] + (x2 + y2) * f[3] + x2 * y2 * f[4]
        total += mx[2] * _fourth(x2, f) + mx[1] * my[1] * both + my[2] * _fourth(y2, f)
    if len(f) > 6:
        total += mx[3] * _sixth(x2, f) + my[3] * _sixth(y2, f)
        total += mx[2] * my[1] * _four_two(x2, y2, f) + mx[1] * my[2] * _four_two(y2, x2, f)
    return total


def _integral(
    x: NDArray[np.float64], y: NDArray[np.float64], a: float, b: float, c: float, average: bool
) -> NDArray[np.float64]:
    """Integral of 1/s over a rectangle at any distance, or its mean over another."""
    side = 2.0 * max(a, b)
    distance2 = x * x + y * y + c * c
    far = distance2 > (_FAR * side) ** 2
    if far.all():  # as in most blocks
        is_distant = float(distance2.min()) > (_DISTANT * side) ** 2
        return _far(x, y, a, b, c, average, 5 if is_distant else 7)
    out = np.empty(x.shape)
    out[far] = _far(x[far], y[far], a, b, c, average, 7)
    near = ~far
    if not average:
        out[near] = _near(x[near], y[near], a, b, c)
        return out
    touching = near & (distance2 < (_TOUCHING * side) ** 2)
    out[touching] = _tent(x[touching], y[touching], a, b, c)
    near &= ~touching
    out[near] = _mean_by_quadrature(x[near], y[near], a, b, c)
    return out


def _moments(half: float, average: bool) -> list[float]:
    """Even moments over their factorials, of a uniform variable or of the sum of two of them."""
    values = (1.0, 2 / 3, 16 / 15, 16 / 7) if average else (1.0, 1 / 3, 1 / 5, 1 / 7)
    return [v * half ** (2 * k) / _FACTORIAL[k] for k, v in enumerate(values)]


def _fourth(x2: NDArray[np.float64], f: Sequence[NDArray[np.float64]]) -> NDArray[np.float64]:
    """Fourth derivative along x."""
    return 3.0 * f[2] + x2 * (6.0 * f[3] + x2 * f[4])


def _sixth(x2: NDArray[np.float64], f: Sequence[NDArray[np.float64]]) -> NDArray[np.float64]:
    """Sixth derivative along x."""
    return 15.0 * f[3] + x2 * (45.0 * f[4] + x2 * (15.0 * f[5] + x2 * f[6]))


def _four_two(
    x2: NDArray[np.float64], y2: NDArray[np.float64], f: Sequence[NDArray[np.float64]]
) -> NDArray[np.float64]:
    """Fourth derivative along x of the second along y."""
    return (
        3.0 * f[3] + (6.0 * x2 + 3.0 * y2) * f[4] + x2 * ((x2 + 6.0 * y2) * f[5] + x2 * y2 * f[6])
    )


def _far(
    x: NDArray[np.float64],
    y: NDArray[np.float64],
    a: float,
    b: float,
    c: float,
    average: bool,
    terms: int,
) -> NDArray[np.float64]:
    """Integral of 1/s over a distant rectangle, with `terms` derivatives."""
    x2, y2 = x * x, y * y
    inverse2 = 1.0 / (x2 + y2 + c * c)
    derivatives = [np.sqrt(inverse2)]
    for k in range(terms - 1):
        derivatives.append(-(2 * k + 1) * inverse2 * derivatives[-1])
    return 4.0 * a * b * mean_over_cells(x2, y2, a, b, derivatives, average)


def _near(
    x: NDArray[np.float64], y: NDArray[np.float64], a: float, b: float, c: float
) -> NDArray[np.float64]:
    """Integral of 1/s over a rectangle, in closed form; x, y >= 0."""
    total = (x + a) * _edge(x + a, y, b, c) - (x - a) * _edge(x - a, y, b, c)
    total += (y + b) * _edge(y + b, x, a, c) - (y - b) * _edge(y - b, x, a, c)
    if c > 0.0:
        for i in (1.0, -1.0):
            for j in (1.0, -1.0):
                total -= i * j * c * _solid_angle(x + i * a, y + j * b, c)
    return total


def _edge(
    distance: NDArray[np.float64], along: NDArray[np.float64], half: float, c: float
) -> NDArray[np.float64]:
    """Integral of 1/s along an edge, from `along` - `half` to `along` + `half`, of any `distance`.

    The inverse hyperbolic sines of both ends are one, of an argument free of cancellation.
    """
    # asinh(b) - asinh(a) = asinh(b sqrt(1 + a^2) - a sqrt(1 + b^2)). If the ends lie on both sides
    # of the point its argument is a sum; else, with its conjugate, (b^2 - a^2) over a sum.
    lower, upper = along - half, along + half
    square = distance**2 + c * c
    root_lower, root_upper = np.sqrt(lower**2 + square), np.sqrt(upper**2 + square)
    beside = lower >= 0.0
    top = np.where(beside, 4.0 * along * half, upper * root_lower - lower * root_upper)
    bottom = np.where(beside, upper * root_lower + lower * root_upper, square)
    finite = bottom > 0.0  # else the edge passes through the point: its factor, distance, is zero
    return np.where(finite, np.arcsinh(top / np.where(finite, bottom, 1.0)), 0.0)


def _solid_angle(x: NDArray[np.float64], y: NDArray[np.float64], c: float) -> NDArray[np.float64]:
    """Solid angle of a quadrant's rectangle seen from the height c."""
    return np.arctan2(x * y, c * np.sqrt(x * x + y * y + c * c))


def _tent(
    x: NDArray[np.float64], y: NDArray[np.float64], a: float, b: float, c: float
) -> NDArray[np.float64]:
    """Mean of :func:`_near` over a cell, by second differences of a fourfold integral of 1/s."""
    total = np.zeros_like(x)
    for i, weight_x in ((-1, 1.0), (0, -2.0), (1, 1.0)):
        for j, weight_y in ((-1, 1.0), (0, -2.0), (1, 1.0)):
            total += weight_x * weight_y * _fourfold(x + 2 * i * a, y + 2 * j * b, c)
    return total / (4.0 * a * b)


def _fourfold(x: NDArray[np.float64], y: NDArray[np.float64], c: float) -> NDArray[np.float64]:
    """Twice the integral over x and y of 1/s, up to terms that differences remove."""
    x, y = np.abs(x), np.abs(y)
    s = np.sqrt(x * x + y * y + c * c)
    tiny = 1e-150  # the logarithm at zero has the factor zero
    total = 0.5 * x * (y * y - c * c) * np.arcsinh(x / np.maximum(np.hypot(y, c), tiny))
    total += 0.5 * y * (x * x - c * c) * np.arcsinh(y / np.maximum(np.hypot(x, c), tiny))
    total -= s * (x * x + y * y - 2.0 * c * c) / 6.0
    if c > 0.0:
        total -= c * x * y * _solid_angle(x, y, c)
    return total


def _mean_by_quadrature(
    x: NDArray[np.float64], y: NDArray[np.float64], a: float, b: float, c: float
) -> NDArray[np.float64]:
    """Mean of :func:`_near` over a cell apart from the rectangle, by Gauss-Legendre quadrature."""
    nodes, weights = np.polynomial.legendre.leggauss(8)
    total = np.zeros_like(x)
    for node_x, weight_x in zip(nodes, weights, strict=True):
        for node_y, weight_y in zip(nodes, weights, strict=True):
            total += weight_x * weight_y * _near(x + a * node_x, y + b * node_y, a, b, c)
    return 0.25 * total
