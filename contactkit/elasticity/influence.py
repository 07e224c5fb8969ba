r"""Influence coefficients of non-periodic contacts on a half-space, layers, or a rigid base.

The coefficient of an offset is the displacement (positive into the solid) at the centre of one
pixel under a unit pressure on another. Displacements follow from pressures by a linear
convolution, which a transform of twice the length in each direction evaluates exactly, without
periodic images.

With the displacement T(r) / (2 pi r) under a unit force (see :mod:`.point_load`), a rectangle
with a corner under the point of interest and sides X and Y contributes, in triangles,

.. math:: \Phi(X, Y) = \frac{1}{2\pi} \left[ X \int_0^{\mathrm{asinh}\,Y/X} I(X \cosh u)\,du
          + Y \int_0^{\mathrm{asinh}\,X/Y} I(Y \cosh u)\,du \right],

where I(r) is the mean of T between 0 and r; a constant I gives Love's logarithms. A pixel is the
difference of four such rectangles. This holds for any ratio of thickness to pixel and is used for
offsets up to some twenty pixels. Farther away the mean over the pixel is a series in its moments,
of fourth order.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy import fft

from ..numerics.fft_pieces import in_threads
from . import love, point_load
from .layer_stack import Base

__all__ = ["coefficients", "coefficients_of", "symbol", "symbol_of"]

# In longer sides of a pixel: nearer, coefficients are integrals over triangles, beyond, series in
# moments of a pixel. Stacks with contrasts up to 100 are off by 1e-10 of a coefficient at most;
# with 10 by 4e-9, with 5 by 5e-8. The triangles take 1.2 times the time with 40.
_NEAR = 20.0
# Likewise: beyond, the fourth order of the series is left out, 2e-11 of a coefficient; 1e-12 beyond
# 256.
_MIDDLE = 128.0
# Points per block, to stay in the cache: 1 << 18 takes twice, 1 << 22 three times as long on 700 x
# 700.
_BLOCK = 1 << 16
_ROWS = 128  # of coefficients of a half-space that each thread takes at a time


def symbol(
    shape: tuple[int, int],
    pixel_size: tuple[float, float],
    young_modulus: ArrayLike,
    poisson_ratio: ArrayLike,
    thickness: ArrayLike = (),
    base: Base | None = None,
) -> NDArray[np.float64]:
    r"""Transform of the influence coefficients on the window doubled in each direction.

    .. math:: \hat K_{kl} = \sum_{m=-n_y}^{n_y-1} \sum_{n=-n_x}^{n_x-1} K_{mn}
              \cos\frac{\pi k m}{n_y} \cos\frac{\pi l n}{n_x}

    Parameters
    ----------
    shape : tuple of int
        Pixels (ny, nx) of the window, each at least 1, odd or even.
    pixel_size : tuple of float
        Sides (dy, dx) of a pixel [m].
    young_modulus, poisson_ratio : array_like, shape (n_layers + 1,)
        Of the layers, top first, and of the substrate [Pa], [-]; (n_layers,) on a rigid base.
    thickness : array_like, shape (n_layers,)
        Of the layers [m]; empty for a homogeneous half-space.
    base : {"bonded", "frictionless"}, optional
        Rigid base in place of a substrate: the coefficients decrease exponentially.

    Returns
    -------
    ndarray, shape (2 ny, nx + 1)
        Real symbol [m/Pa], to multiply ``rfft2(pressure, s=(2 * ny, 2 * nx))``; the first ny rows
        and nx columns of the inverse transform are the displacement. The symbols of two elastic
        bodies add.

    See Also
    --------
    coefficients : the coefficients before the transform, and their error.

    Examples
    --------
    >>> K = symbol((2, 3), (1.0, 1.0), [1.0], [0.3])
    >>> pressure = np.zeros((2, 3))
    >>> pressure[0, 0] = 1.0
    >>> u = np.fft.irfft2(K * np.fft.rfft2(pressure, s=(4, 6)), s=(4, 6))[:2, :3]
    >>> u.round(6)
    array([[1.021202, 0.300684, 0.146306],
           [0.300684, 0.209917, 0.130663]])
    """
    return symbol_of(coefficients(shape, pixel_size, young_modulus, poisson_ratio, thickness, base))


def symbol_of(quadrant: NDArray[np.float64]) -> NDArray[np.float64]:
    """Transform of coefficients (ny + 1, nx + 1) that are even in both offsets, as `symbol`.

    Those given are overwritten.

    Examples
    --------
    >>> symbol_of(np.array([[2.0, 1.0], [0.0, 0.0]])).tolist()
    [[3.0, 1.0], [3.0, 1.0]]
    """
    # The transform of an even, periodic array is a cosine transform on a quarter of the points.
    half = fft.dctn(quadrant, type=1, overwrite_x=True)
    return np.asarray(np.concatenate((half, half[-2:0:-1])))


def coefficients(
    shape: tuple[int, int],
    pixel_size: tuple[float, float],
    young_modulus: ArrayLike,
    poisson_ratio: ArrayLike,
    thickness: ArrayLike = (),
    base: Base | None = None,
) -> NDArray[np.float64]:
    r"""Influence coefficients for all pixel offsets of a window.

    .. math:: K_{mn} = \int_{-d_y/2}^{d_y/2} \int_{-d_x/2}^{d_x/2}
              g\left(\sqrt{(n d_x - x)^2 + (m d_y - y)^2}\right) dx\,dy

    Parameters
    ----------
    shape, pixel_size, young_modulus, poisson_ratio, thickness, base
        As of :func:`symbol`.

    Returns
    -------
    ndarray, shape (ny + 1, nx + 1)
        Displacement per unit pressure [m/Pa] at offsets of 0 .. ny, 0 .. nx pixels; even in both.

    Notes
    -----
    The relative error is below 1e-12 for a homogeneous half-space and below 1e-10 for layers of
    moduli that differ by a factor of a few, for any ratio of thickness to pixel and window. At a
    contrast of 1e6 it is below 1e-10 of the coefficient at zero offset, and distant coefficients
    keep seven digits. The time is that of a few evaluations of a logarithm on the window, and some
    milliseconds for the table of the stack.

    The matrix of values at centres is symmetric, and was positive definite for all stacks tried;
    that of the means over pixels is so by construction.

    References
    ----------
    .. [1] A. E. H. Love, Phil. Trans. R. Soc. A 228 (1929) 377-420.
    .. [2] K. L. Johnson, Contact Mechanics (1985), Eq. 3.25.

    Examples
    --------
    A layer a millionth of a pixel thick is not felt, one of a million pixels is all that is felt.

    >>> thin = coefficients((1, 1), (1.0, 1.0), [4.0, 1.0], [0.3, 0.3], [1e-6])
    >>> thick = coefficients((1, 1), (1.0, 1.0), [4.0, 1.0], [0.3, 0.3], [1e6])
    >>> [round(float(k[0, 0]), 5) for k in (thin, 4.0 * thick)]
    [1.0212, 1.0212]
    """
    modulus, ratio, layers = (
        np.asarray(values, float).reshape(-1)
        for values in (young_modulus, poisson_ratio, thickness)
    )
    (ny, nx), (dy, dx) = shape, pixel_size
    x, y = dx * np.arange(nx + 1.0), dy * np.arange(ny + 1.0)
    if layers.size == 0:
        return _of_half_space(x, y, dx, dy, float(modulus[0] / (1.0 - ratio[0] ** 2)))
    diagonal = float(np.hypot(x[-1] + dx, y[-1] + dy))
    load = point_load.table(modulus, ratio, layers, 0.5 * min(dx, dy), diagonal, base)
    return coefficients_of(load, shape, pixel_size)


def _of_half_space(
    x: NDArray[np.float64], y: NDArray[np.float64], dx: float, dy: float, contact: float
) -> NDArray[np.float64]:
    """Love's coefficients, by the threads of ``scipy.fft.set_workers``.

    On square pixels of a square window those beside the diagonal are computed once.
    """
    out = np.empty((y.size, x.size))
    is_square = x.size == y.size and dx == dy

    def fill(first: int) -> None:
        rows, columns = slice(first, first + _ROWS), slice(first if is_square else 0, None)
        made = love.rectangle(x[columns], y[rows, None], 0.5 * dx, 0.5 * dy, contact)
        out[rows, columns] = made
        if is_square:
            out[first + _ROWS :, rows] = made[:, _ROWS:].T

    with in_threads(fft.get_workers()) as each:
        each(fill, range(0, y.size, _ROWS))
    return out


def coefficients_of(
    load: point_load.PointLoad, shape: tuple[int, int], pixel_size: tuple[float, float]
) -> NDArray[np.float64]:
    """Influence coefficients of a tabulated point load, as `coefficients` [m/Pa].

    Parameters
    ----------
    load : PointLoad
        Table from half the shorter side of a pixel to the diagonal of the window and a pixel.
    shape, pixel_size : tuple
        As of :func:`symbol`.
    """
    (ny, nx), (dy, dx) = shape, pixel_size
    x, y = dx * np.arange(nx + 1.0), dy * np.arange(ny + 1.0)
    out = _far(x, y, dx, dy, load)
    reach = _NEAR * max(dx, dy)
    near_x, near_y = min(nx, int(reach / dx) + 1), min(ny, int(reach / dy) + 1)
    out[: near_y + 1, : near_x + 1] = _near(near_x + 1, near_y + 1, dx, dy, load)
    return out


def _far(
    x: NDArray[np.float64],
    y: NDArray[np.float64],
    dx: float,
    dy: float,
    load: point_load.PointLoad,
) -> NDArray[np.float64]:
    """Coefficients of distant offsets x, y, from the moments of a pixel; invalid near zero."""
    out = np.empty((y.size, x.size))
    rows = max(1, _BLOCK // x.size)
    x2 = x**2
    for first in range(0, y.size, rows):
        y2 = y[first : first + rows, None] ** 2
        r2 = x2 + y2
        if first == 0:
            r2[0, 0] = r2[0, -1]  # arbitrary: overwritten by the near field
        index, fraction = point_load.locate(load, 0.5 * np.log(r2))
        is_middle = y[first] < _MIDDLE * max(dx, dy)
        inverse2 = 1.0 / r2
        factor = np.sqrt(inverse2)
        derivatives = []
        for of_order in load.derivatives[: 5 if is_middle else 3]:
            derivatives.append(point_load.cubic(of_order, index, fraction) * factor)
            factor = factor * inverse2
        mean = love.mean_over_cells(x2, y2, 0.5 * dx, 0.5 * dy, derivatives)
        out[first : first + rows] = mean
    out *= dx * dy / (2.0 * np.pi)
    return out


def _near(
    n_x: int, n_y: int, dx: float, dy: float, load: point_load.PointLoad
) -> NDArray[np.float64]:
    """Coefficients of the first `n_x` by `n_y` offsets, from the triangles at their edges."""
    x = dx * (np.arange(float(n_x)) + 0.5)
    y = dy * (np.arange(float(n_y)) + 0.5)
    total = _edges(x, y, load)  # edges at x, along y
    total += _edges(y, x, load).T
    return total / (2.0 * np.pi)


def _edges(
    distance: NDArray[np.float64], ends: NDArray[np.float64], load: point_load.PointLoad
) -> NDArray[np.float64]:
    """Sum over the two edges of each pixel that lie along `ends`; shape (ends, distances)."""
    # A pixel is four triangles with the point at their tip. In u = asinh(along/distance) the
    # integral over a triangle is that of the tabulated mean I alone: no singularity at r = 0 is
    # left.
    angle = np.arcsinh(ends[:, None] / distance)
    first = 2.0 * distance * _integral(0.0 * angle[:1], angle[:1], distance, load)
    later = distance * _integral(angle[:-1], angle[1:], distance, load)
    strip = np.concatenate((first, later))  # from the first edge to each distance
    return np.diff(strip, axis=1, prepend=-strip[:, :1])  # the first pixel has its own mirror image


def _integral(
    lower: NDArray[np.float64],
    upper: NDArray[np.float64],
    distance: NDArray[np.float64],
    load: point_load.PointLoad,
) -> NDArray[np.float64]:
    """Integral of I(distance cosh u) over u between two bounds."""
    length = upper - lower
    # I is smooth on the scale of one in u: eight nodes for each unit, and some more.
    nodes, weights = np.polynomial.legendre.leggauss(16 + int(8.0 * np.max(length, initial=0.0)))
    total = np.zeros_like(length)
    for node, weight in zip(nodes, weights, strict=True):
        u = lower + 0.5 * (1.0 + node) * length
        total += weight * point_load.mean_to(load, distance * np.cosh(u))
    return 0.5 * length * total
