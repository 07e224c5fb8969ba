r"""Tangential compliance of windows that repeat along one axis, on half-spaces, layers or a base.

Along the other axis the surface extends without load. With the axis that repeats as x, the period
L and r_j the distance from the image j, a homogeneous half-space of shear modulus G has

.. math:: K_{xx} = \frac{1}{2 \pi G} \sum_j \Bigl[\frac{1}{r_j} - \nu \frac{y^2}{r_j^3}\Bigr], \quad
          K_{yy} = \frac{1}{2 \pi G} \sum_j \Bigl[\frac{1 - \nu}{r_j} + \nu \frac{y^2}{r_j^3}\Bigr],
          \quad K_{xy} = \frac{\nu}{2 \pi G} \sum_j \frac{(x - jL)\,y}{r_j^3}

The nearest images are summed pixel by pixel (`tangential`). Those beyond are smooth: they are
summed at a few points, the last ones as an integral, and interpolated. The sum of 1/r grows as a
logarithm, of which the **datum** is taken off: under a line load the surface moves nowhere at a
distance :math:`\ell`, the side of the window across.

Layers add the difference of their compliance and that of their top as a half-space. Of waves along
x it decays across within about their length: a periodic window, padded by some periods, has it
without images. The mean along x is a line load, with the height dy of a pixel

.. math:: k(y) = \frac{dy}{\pi} \int_0^{\pi/dy} F(\eta)\,[\cos \eta y - \cos \eta \ell]\,d\eta

where F is F_s for tractions along the line and F_11 for those across. On a bonded base the second
cosine of the layers is left out: the base is the datum.
"""

from __future__ import annotations

import math
from typing import Literal, NamedTuple

import numpy as np
from numpy.polynomial import chebyshev
from numpy.typing import NDArray
from scipy import fft

from ..errors import DescriptionError
from .layer_stack import Layers
from .layered import compliance
from .tangential import TangentialCompliance, isolated_compliance, periodic_symbol

__all__ = ["one_axis_symbol"]

Array = NDArray[np.float64]
Pair = tuple[float, float]
# As in `one_axis`, over the largest coefficient: 1 to 4 near images agree to 1e-11; images summed
# to 100 sides leave 2e-10, to 50 2e-9; half of the nodes leave 2e-12.
_LEAST = 2  # images on either side that are summed pixel by pixel
_SUMMED = 100  # longer sides of the window up to which images are summed
_NODES = (24, 10)  # across and along
_GAUSS = ((-math.sqrt(0.6), 5 / 18), (0.0, 8 / 18), (math.sqrt(0.6), 5 / 18))  # mean over a pixel
# Padding: exp(-6 pi) = 7e-9 of the images of waves along the axis is left; with 2 periods 4e-7,
# with 1 2e-4 of the largest coefficient. Under layers thinner than two pixels more is left, see
# Notes.
_PERIODS = 3.0
# Below the longest wave of the window, down to which a line load is integrated: from 10 on
# round-off.
_OCTAVES = 50
_AT_ONCE = 4096  # wavenumbers, whose cosines at every pixel are in memory together
_SIGNS = (1.0, -1.0, 1.0)  # of xx, xy and yy at the opposite offset along one axis


def one_axis_symbol(
    shape: tuple[int, int], pixel_size: Pair, layers: Layers, along: Literal["x", "y"]
) -> TangentialCompliance:
    """Symbols on the window doubled across.

    Parameters
    ----------
    shape : (ny, nx)
        Of the window.
    pixel_size : (dy, dx)
        [m].
    layers : Layers
        As in `layered.compliance`.
    along : {"x", "y"}
        Axis along which the window repeats.

    Returns
    -------
    TangentialCompliance
        Real symbols [m/Pa], each (2 ny, nx//2 + 1) or (ny, nx + 1), to multiply the half spectrum
        of tractions with zeros appended across.

    Raises
    ------
    DescriptionError
        As `layered.compliance`, and for layers that slide on their base: nothing holds them.

    Notes
    -----
    Of a half-space the error is below 1e-9 of the largest coefficient. What layers add is read
    between the pixels as in a periodic window; its images leave 1e-8. Layers thinner than two
    pixels add waves up to the Nyquist frequency, where the symbol is cut: kernels then ring, and
    images leave 7e-6 at a thickness of one pixel and 7e-5 at 0.3, at a contrast of 100.

    References
    ----------
    .. [1] K. L. Johnson, Contact Mechanics (1985), sections 2.3 and 3.6.

    Examples
    --------
    Lines that pull across themselves, seen from one and from two quarters of the window; for
    nu = 0 it is Flamant's solution, 2/(pi E) ln 2:

    >>> symbol = one_axis_symbol((64, 1), (1.0, 1.0), Layers([1.0], [0.0]), "x")
    >>> moved = np.fft.irfft2(symbol.yy, s=(128, 1))[:, 0]
    >>> print(round(moved[16] - moved[32], 4), round(2 / np.pi * np.log(2), 4))
    0.4413 0.4413
    """
    if layers.base == "frictionless":
        raise DescriptionError(
            "RigidBase.bonded",
            False,
            "be True under a tangential force on a line contact: nothing else holds the layers",
            hint="bond them to the base, or use Window(periodic=True)",
        )
    turned = along == "y"
    if turned:
        shape, pixel_size = (shape[1], shape[0]), (pixel_size[1], pixel_size[0])
    kernels = _half_space(shape, pixel_size, layers)
    if np.size(layers.thickness):
        kernels = kernels.plus(_added(shape, pixel_size, layers))
    if turned:
        kernels = TangentialCompliance(kernels.yy.T, kernels.xy.T, kernels.xx.T)
    return TangentialCompliance(*(np.ascontiguousarray(fft.rfft2(one).real) for one in kernels))


def _top(layers: Layers) -> Layers:
    """The uppermost material as a half-space."""
    return Layers(np.ravel(layers.young_modulus)[:1], np.ravel(layers.poisson_ratio)[:1])


def _half_space(shape: tuple[int, int], pixel_size: Pair, layers: Layers) -> TangentialCompliance:
    """Coefficients of the top material at all offsets of the doubled window, (2 ny, nx)."""
    (ny, nx), (dy, dx) = shape, pixel_size
    half, near = nx // 2, max(_LEAST, math.ceil(ny * dy / (nx * dx)))
    images = isolated_compliance((ny, near * nx + half), pixel_size, _top(layers))
    found = []
    for one, far, sign in zip(images, _far(shape, pixel_size, layers, near), _SIGNS, strict=True):
        total = one[:, : half + 1] + far
        for j in range(1, near + 1):
            total += one[:, j * nx : j * nx + half + 1]
            total += sign * one[:, j * nx - half : j * nx + 1][:, ::-1]
        found.append(_all_offsets(total, nx, sign))
    return TangentialCompliance(*found)


def _all_offsets(quadrant: Array, nx: int, sign: float) -> Array:
    """Coefficients at offsets of 0 .. ny, 0 .. nx//2 to those of the doubled window."""
    if sign < 0.0:
        quadrant[[0, -1]] = 0.0
        quadrant[:, 0] = 0.0
        if nx % 2 == 0:
            quadrant[:, -1] = 0.0
    rows = np.concatenate((quadrant, sign * quadrant[:, (nx - 1) // 2 : 0 : -1]), axis=1)
    return np.concatenate((rows, sign * rows[-2:0:-1]))


def _far(
    shape: tuple[int, int], pixel_size: Pair, layers: Layers, near: int
) -> tuple[Array, Array, Array]:
    """Sum over the images beyond the near ones, at offsets of 0 .. ny, 0 .. nx//2."""
    (ny, nx), (dy, dx) = shape, pixel_size
    across = _smooth(dy * np.arange(ny + 1.0), ny * dy, dy, _NODES[0])
    along = _smooth(dx * np.arange(nx // 2 + 1.0), 0.5 * nx * dx, dx, _NODES[1])
    y, x, period = across.nodes[:, None], along.nodes, nx * dx
    last = near + math.ceil(_SUMMED * max(period, ny * dy) / period)
    end = (last + 0.5) * period
    places = period * np.arange(near + 1.0, last + 1.0)[:, None, None]
    flat, curved, cross = np.zeros((3, y.size, x.size))
    for side in (x - places, x + places):
        r = np.hypot(side, y)
        flat += (1.0 / r).sum(axis=0)
        curved += (y**2 / r**3).sum(axis=0)
        cross += (side / (x * r**3)).sum(axis=0)  # over x y, which is even
    # The rest as an integral (Euler and Maclaurin), less that of a line at the datum.
    flat += 2.0 / period * math.log(0.5 * ny * dy / end) - period / (12.0 * end**2)
    flat += (x**2 - 0.5 * y**2) / (period * end**2)
    curved += y**2 / (period * end**2) - 2.0 / period
    cross -= 2.0 / (period * end**2)
    modulus, nu = (float(np.ravel(one)[0]) for one in layers[:2])
    scale = dx * dy * (1.0 + nu) / (math.pi * modulus)  # over 2 pi G
    return (
        scale * (across.even @ (flat - nu * curved) @ along.even.T),
        scale * nu * (across.odd @ cross @ along.odd.T),
        scale * (across.even @ ((1.0 - nu) * flat + nu * curved) @ along.even.T),
    )


class _Smooth(NamedTuple):
    """Points along an axis, and the matrices from even functions there to means over pixels.

    `even` is that of the function, `odd` that of the function times the position.
    """

    nodes: Array
    even: Array
    odd: Array


def _smooth(at: Array, reach: float, size: float, count: int) -> _Smooth:
    largest = (reach + 0.5 * size) ** 2
    squares = 0.5 * largest * (1.0 + chebyshev.chebpts1(count))
    back = np.linalg.inv(chebyshev.chebvander(2.0 * squares / largest - 1.0, count - 1))
    even, odd = np.zeros((2, at.size, count))
    for place, weight in _GAUSS:
        point = at + 0.5 * place * size
        rows = weight * chebyshev.chebvander(2.0 * point**2 / largest - 1.0, count - 1)
        even += rows
        odd += point[:, None] * rows
    return _Smooth(np.sqrt(squares), even @ back, odd @ back)


def _added(shape: tuple[int, int], pixel_size: Pair, layers: Layers) -> TangentialCompliance:
    """What layers add to their top material, at all offsets of the doubled window."""
    (ny, nx), (dy, dx) = shape, pixel_size
    padded = ny + max(ny, math.ceil(_PERIODS * nx * dx / dy))
    padded = int(fft.next_fast_len(padded, real=True))
    symbols = periodic_symbol((padded, nx), pixel_size, layers)
    without = periodic_symbol((padded, nx), pixel_size, _top(layers))
    lines = _lines(ny, dy, layers)
    found = []
    for one, other, line, sign in zip(symbols, without, lines, _SIGNS, strict=True):
        kernel = fft.irfft2(one - other, s=(padded, nx))
        kernel -= kernel.mean(axis=1, keepdims=True)
        quadrant = kernel[: ny + 1, : nx // 2 + 1] + line[:, None] / nx
        found.append(_all_offsets(quadrant, nx, sign))
    return TangentialCompliance(*found)


def _lines(ny: int, dy: float, layers: Layers) -> tuple[Array, Array, Array]:
    """What layers add at offsets of 0 .. ny pixels from a line of tractions along or across it."""
    nodes, weights = np.polynomial.legendre.leggauss(8)
    first = math.pi / (ny * dy)
    ends = np.concatenate(
        ([0.0], first * 0.5 ** np.arange(_OCTAVES, 0, -1.0), first * np.arange(1.0, ny + 1.0))
    )
    half = 0.5 * np.diff(ends)
    eta = (ends[:-1, None] + half[:, None] * (1.0 + nodes)).ravel()
    weight = (half[:, None] * weights).ravel() * dy / math.pi
    y = dy * np.arange(ny + 1.0)[:, None]
    along, across = np.zeros(ny + 1), np.zeros(ny + 1)
    for i in range(0, eta.size, _AT_ONCE):
        some, by = eta[i : i + _AT_ONCE], weight[i : i + _AT_ONCE]
        found, top = compliance(some, *layers), compliance(some, *_top(layers))
        waves = np.cos(y * some)
        from_datum = waves - waves[-1]
        own = waves if layers.base else from_datum
        along += own @ (by * found.Fs) - from_datum @ (by * top.Fs)
        across += own @ (by * found.F11) - from_datum @ (by * top.F11)
    return along, np.zeros(ny + 1), across
