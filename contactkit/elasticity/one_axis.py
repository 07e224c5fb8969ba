r"""Influence coefficients of windows that repeat along one axis, on half-spaces, layers or a base.

Along the other axis the surface extends without load, as of an isolated contact. The coefficients
are those of :mod:`.influence`, summed over the images of a pixel along the axis that repeats. With
the period L and the point load T(s)/(2 pi s) of :mod:`.point_load` (x along that axis, y across),

.. math:: K(x, y) = \lim_{S \to \infty} \Bigl[ \sum_{|x - jL| < S} g\bigl(\sqrt{(x - jL)^2 + y^2}
          \bigr) - \frac{1}{\pi L} \int_\ell^S \frac{T(r)\,dr}{\sqrt{r^2 - \ell^2}} \Bigr]

The sum grows as the logarithm of S, for a half-space sinks without bound below a line load. The
integral is the **datum**: under a line load the surface moves nowhere at the distance
:math:`\ell` of `reference`. On a half-space it moves by
:math:`-(2 P'/(\pi E^*)) \ln(|y|/\ell)` under a load P' per length. On a rigid base the sum
converges, nothing is subtracted, and the base is the datum.

The nearest images are summed pixel by pixel; those beyond are smooth over the window: they are
summed at a few points, the last ones as an integral (Euler and Maclaurin), and interpolated by
polynomials in the squares of x and y.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Literal, NamedTuple

import numpy as np
from numpy.polynomial import chebyshev
from numpy.typing import NDArray
from scipy import fft

from . import influence, point_load
from .layer_stack import Layers, stack_of

__all__ = ["Solid", "coefficients", "reference", "symbol", "symbol_of"]

Array = NDArray[np.float64]
Pair = tuple[float, float]

# Errors of windows of 16 to 64 pixels a side, homogeneous and with layers of a contrast up to 100,
# over the coefficient at zero offset.

_LEAST = 2  # images on either side that are summed pixel by pixel: 1 and 4 agree to 2e-11
# Longer sides of the window up to which images are summed, before an integral: 100 leave 3e-10, 50
# leave 4e-9; 400 take 1.3 times the time.
_SUMMED = 100
# Thicknesses, times the contrast, beyond which T is that of the substrate: 1e5 to 1e9 agree to
# 6e-15.
_SETTLED = 1e7
# Lengths over which stiff layers bend, in the distance of the datum: a convention, see `reference`.
_BENDING = 8.0
# Across and along: round-off, for images as far as the window is wide; half of either leaves 1e-11.
_NODES = (24, 10)
_GAUSS = ((-math.sqrt(0.6), 5 / 18), (0.0, 8 / 18), (math.sqrt(0.6), 5 / 18))  # mean over a pixel


def symbol(
    shape: tuple[int, int], pixel_size: Pair, layers: Layers, along: Literal["x", "y"]
) -> Array:
    """Transform of the influence coefficients on the window doubled across.

    Parameters
    ----------
    shape : tuple of int
        Pixels (ny, nx) of the window.
    pixel_size : tuple of float
        Sides (dy, dx) of a pixel [m].
    layers : Layers
        The solid.
    along : {"x", "y"}
        Axis along which the window repeats.

    Returns
    -------
    ndarray, shape (2 ny, nx//2 + 1) or (ny, nx + 1)
        Real symbol [m/Pa] along x or along y, to multiply the half spectrum of the pressure, with
        zeros appended across.

    Examples
    --------
    A pixel sinks as far whichever axis repeats:

    >>> pressure = np.zeros((2, 6))
    >>> pressure[0, 0] = 1.0
    >>> x = symbol((2, 6), (1.0, 1.0), Layers([1.0], [0.3]), "x")
    >>> y = symbol((6, 2), (1.0, 1.0), Layers([1.0], [0.3]), "y")
    >>> along_x = np.fft.irfft2(x * np.fft.rfft2(pressure, s=(4, 6)), s=(4, 6))[:2]
    >>> along_y = np.fft.irfft2(y * np.fft.rfft2(pressure.T, s=(6, 4)), s=(6, 4))[:, :2]
    >>> bool(np.allclose(along_x, along_y.T, rtol=1e-13))
    True
    """
    return symbol_of(shape, pixel_size, _solid_of(layers), along)


class Solid(NamedTuple):
    """A solid, as coefficients along one axis take it.

    Attributes
    ----------
    isolated : callable
        Coefficients of isolated contacts of a shape and a pixel size, as `influence.coefficients`.
    table : callable or None
        Table of the point load over a range of radii; None of a half-space.
    substrate : float
        T far away [1/Pa], zero on a rigid base.
    settled : float
        Sum of the thicknesses times the contrast of the materials [m].
    bending : float
        ``sum h ((G/G_s)^(1/3) - 1)`` of the layers that are stiffer than the substrate [m].
    """

    isolated: Callable[[tuple[int, int], Pair], Array]
    table: Callable[[point_load.Radii], point_load.PointLoad] | None
    substrate: float
    settled: float
    bending: float


def symbol_of(
    shape: tuple[int, int], pixel_size: Pair, solid: Solid, along: Literal["x", "y"]
) -> Array:
    """Transform of the coefficients of any solid, as `symbol`.

    Examples
    --------
    >>> solid = _solid_of(Layers([1.0], [0.3]))
    >>> symbol_of((2, 6), (1.0, 1.0), solid, "x").shape
    (4, 4)
    """
    turned = along == "y"
    period = shape[0] if turned else shape[1]
    if turned:
        shape, pixel_size = (shape[1], shape[0]), (pixel_size[1], pixel_size[0])
    quadrant = _coefficients(shape, pixel_size, solid)
    column = np.arange(period)
    rows = quadrant[:, np.minimum(column, period - column)]
    half = fft.dct(fft.rfft(rows, axis=1).real, type=1, axis=0)
    if not turned:
        return np.concatenate((half, half[-2:0:-1]))
    half = np.ascontiguousarray(half.T)
    return np.concatenate((half, half[(period - 1) // 2 : 0 : -1]))


def coefficients(shape: tuple[int, int], pixel_size: Pair, layers: Layers) -> Array:
    """Influence coefficients of a window that repeats along x, for all pixel offsets.

    Parameters
    ----------
    shape, pixel_size, layers
        As of :func:`symbol`.

    Returns
    -------
    ndarray, shape (ny + 1, nx//2 + 1)
        Displacement at the centre of a pixel per unit pressure on one at offsets of 0 .. ny, 0 ..
        nx//2 pixels and on all its images [m/Pa]; even in both.

    Notes
    -----
    The error is below 1e-9 of the coefficient at zero offset. The time is that of
    ``1 + 2 max(2, height/width)`` isolated windows.

    References
    ----------
    .. [1] K. L. Johnson, Contact Mechanics (1985), section 2.3: line loading of a half-space.

    Examples
    --------
    A row of pixels that all carry a load is a line load, whose datum is one height away:

    >>> K = coefficients((64, 1), (1.0, 1.0), Layers([1.0], [0.0]))
    >>> print(round(K[32, 0], 5), round(2 / np.pi * np.log(2), 5))
    0.4413 0.44127
    """
    return _coefficients(shape, pixel_size, _solid_of(layers))


def _coefficients(shape: tuple[int, int], pixel_size: Pair, solid: Solid) -> Array:
    (ny, nx), (dy, dx) = shape, pixel_size
    half, near = nx // 2, max(_LEAST, math.ceil(ny * dy / (nx * dx)))
    images = solid.isolated((ny, near * nx + half), pixel_size)
    total = images[:, : half + 1].copy()
    for j in range(1, near + 1):
        total += images[:, j * nx : j * nx + half + 1]
        total += images[:, j * nx - half : j * nx + 1][:, ::-1]
    x, y = dx * np.arange(half + 1.0), dy * np.arange(ny + 1.0)
    distant = _Distant(solid, nx * dx, ny * dy, near)
    across, along = (
        _smooth(at, reach, size, count)
        for at, reach, size, count in zip(
            (y, x), (ny * dy, 0.5 * nx * dx), pixel_size, _NODES, strict=True
        )
    )
    values = distant.sum_at(across.nodes, along.nodes)
    total += dx * dy * (across.matrix @ values @ along.matrix.T)
    return total


def reference(layers: Layers, height: float) -> float:
    r"""Distance from a line load at which the surface does not move [m]: the datum.

    .. math:: \ell = \max\Bigl(H, 8 \sum_j h_j \bigl((G_j/G_s)^{1/3} - 1\bigr)\Bigr)

    the height H of the window, or several times the length over which layers bend that are stiffer
    than the substrate, if that is larger: what presses the window down is then pressed in itself.

    Examples
    --------
    >>> reference(Layers([1.0], [0.3]), 2.0)
    2.0
    >>> round(reference(Layers([8.0, 1.0], [0.3, 0.3], [1.0]), 2.0), 9)
    8.0
    """
    return _reference(_solid_of(layers), height)


def _reference(solid: Solid, height: float) -> float:
    return max(height, _BENDING * solid.bending)


def _solid_of(layers: Layers) -> Solid:
    G, nu, h, base = stack_of(*layers)
    E = 2.0 * G * (1.0 + nu)

    def isolated(shape: tuple[int, int], pixel_size: Pair) -> Array:
        return influence.coefficients(shape, pixel_size, *layers)

    def table(radii: point_load.Radii) -> point_load.PointLoad:
        return point_load.table(E, nu, h, *radii, base)

    stiffer = np.maximum(np.cbrt(G[: h.size] / G[-1]) - 1.0, 0.0)
    return Solid(
        isolated,
        table if h.size else None,
        0.0 if base else float((1.0 - nu[-1]) / G[-1]),
        float(h.sum() * G.max() / G.min()),
        0.0 if base else float(h @ stiffer),
    )


class _Smooth(NamedTuple):
    """Points along an axis, and the matrix from even functions there to their means on pixels."""

    nodes: Array
    matrix: Array


def _smooth(at: Array, reach: float, size: float, count: int) -> _Smooth:
    largest = (reach + 0.5 * size) ** 2
    squares = 0.5 * largest * (1.0 + chebyshev.chebpts1(count))
    back = np.linalg.inv(chebyshev.chebvander(2.0 * squares / largest - 1.0, count - 1))
    rows = sum(
        weight
        * chebyshev.chebvander(2.0 * (at + 0.5 * place * size) ** 2 / largest - 1.0, count - 1)
        for place, weight in _GAUSS
    )
    return _Smooth(np.sqrt(squares), np.asarray(rows @ back))


class _Distant:
    """Displacement under unit forces on all images beyond the `near` ones of a point."""

    def __init__(self, solid: Solid, period: float, height: float, near: int) -> None:
        self.period, self.near = period, near
        longer = max(period, height)
        self.last = near + math.ceil(_SUMMED * longer / period)
        self.end = (self.last + 0.5) * period
        self.substrate = solid.substrate
        self.datum = _reference(solid, height)
        # From there on T is that of the substrate, and the datum is seen from far away.
        self.settled = max(_SETTLED * self.end, _SETTLED * solid.settled)
        if solid.table is not None:
            nearest = min(0.5 * (near + 0.5) * period, self.datum)
            table = solid.table(point_load.Radii(nearest, 1.01 * self.settled))
            self.T, self.T_1 = (_read(table, order) for order in (0, 1))
        else:
            self.T = lambda r: np.full_like(r, self.substrate)
            self.T_1 = lambda r: np.full_like(r, -self.substrate)

    def sum_at(self, y: Array, x: Array) -> Array:
        """Displacement [m/N] at points, (y, x)."""
        places = self.period * np.arange(self.near + 1.0, self.last + 1.0)
        total = np.empty((y.size, x.size))
        for i, j in np.ndindex(total.shape):
            r = np.hypot(np.concatenate([places + x[j], places - x[j]]), y[i])
            total[i, j] = np.sum(self.T(r) / r)
        flat, curved = self._beyond()
        slope = float(self.T_1(np.array([self.end]))[0]) / self.end**2  # of T/s
        total += 2.0 * flat / self.period + slope * self.period / 12.0
        total -= x**2 * slope / self.period
        total += (y**2)[:, None] * curved / self.period
        total -= 2.0 * self._at_datum() / self.period
        return np.asarray(total / (2.0 * np.pi))

    def _beyond(self) -> Pair:
        """Integrals of T/s and of T_1/s^3 from the last image that is summed, the first to S."""
        u, weight = _panels(math.log(self.settled / self.end))
        s = self.end * np.exp(u)
        return float(weight @ self.T(s)), float(weight @ (self.T_1(s) / s**2))

    def _at_datum(self) -> float:
        """Integral of T/sqrt(r^2 - l^2) from the distance l of the datum to S; none on a base."""
        if self.substrate == 0.0:
            return 0.0
        u, weight = _panels(math.acosh(self.settled / self.datum))
        return float(weight @ self.T(self.datum * np.cosh(u)))


def _panels(length: float) -> tuple[Array, Array]:
    """Points and weights of an integral from 0 to `length`."""
    nodes, weights = np.polynomial.legendre.leggauss(8)
    panels = math.ceil(4.0 * length)
    step = length / panels
    points = (np.arange(panels)[:, None] + 0.5 * (1.0 + nodes)).ravel() * step
    return points, np.tile(0.5 * step * weights, panels)


def _read(table: point_load.PointLoad, order: int) -> Callable[[Array], Array]:
    def read(radius: Array) -> Array:
        place = point_load.locate(table, np.log(radius))
        return np.asarray(point_load.cubic(table.derivatives[order], *place))

    return read
