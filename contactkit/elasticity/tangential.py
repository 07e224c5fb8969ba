r"""Tangential displacement of a layered half-space under tangential tractions, on a grid.

Conventions as in `layered`: z into the solid; a traction q_x > 0 pulls the surface of the solid
towards +x, and u_x > 0 is a displacement towards +x. In Fourier space

.. math:: \hat u_x = \left[ \frac{\xi^2}{\alpha^2} F_{11} + \frac{\eta^2}{\alpha^2} F_s \right]
          \hat q_x + \frac{\xi \eta}{\alpha^2} (F_{11} - F_s) \, \hat q_y

and the same for y with the letters exchanged. In space the compliance is that of F_s, which acts
like a normal one, less the second derivatives of a function of the radius whose transform is
(F_11 - F_s)/alpha^2. A uniform traction on a pixel leaves of these an integral along its edges.

======  ==========================================================  ======
symbol  meaning                                                     unit
======  ==========================================================  ======
R       alpha (F_11 - F_s); -nu/G of a homogeneous half-space       1/Pa
I       mean of T over radii from 0 to r, T the point load of R     1/Pa
X, Y    distance of an edge of a pixel, and position along it       m
======  ==========================================================  ======
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from ..errors import DescriptionError
from . import love, point_load
from .influence import coefficients_of
from .layer_stack import Layers, stack_of
from .layered import compliance

__all__ = ["TangentialCompliance", "isolated_compliance", "periodic_symbol"]

Array = NDArray[np.float64]
# Pixels from the load up to which edges take many nodes: 16 leave 1e-13, 4 leave 3e-11 of the
# largest coefficient.
_NEAR = 16
_NODES = 4  # beyond, where an edge is short against its distance: 3 leave 1e-10, 2 leave 3e-7


class TangentialCompliance(NamedTuple):
    """Displacement along x under traction along x, cross term, and y under y [m/Pa].

    Either influence coefficients at offsets of 0 .. ny, 0 .. nx pixels, of which `xy` is odd in
    both and the others even; or symbols on a half spectrum. Those of two bodies add.
    """

    xx: Array
    xy: Array
    yy: Array

    def plus(self, other: TangentialCompliance) -> TangentialCompliance:
        """Compliance of two bodies in contact."""
        return TangentialCompliance(self.xx + other.xx, self.xy + other.xy, self.yy + other.yy)


def periodic_symbol(
    shape: tuple[int, int], pixel_size: tuple[float, float], layers: Layers
) -> TangentialCompliance:
    r"""Symbols on the half spectrum of a periodic map.

    Parameters
    ----------
    shape : (ny, nx)
        Of the map.
    pixel_size : (dy, dx)
        [m].
    layers : Layers
        As in `layered.compliance`.

    Returns
    -------
    TangentialCompliance
        Each (ny, nx//2 + 1) [m/Pa]. At wavenumber 0 it is zero, with the mean plane as the datum of
        displacements, except for layers bonded to a rigid base. The cross term is zero where a
        wave along an axis has two pixels, as its sign is not defined there.

    Raises
    ------
    DescriptionError
        As `layered.compliance`.

    Examples
    --------
    With nu = 1/2 waves along the traction meet half the compliance of waves across it:

    >>> symbol = periodic_symbol((4, 4), (1.0, 1.0), Layers([3.0], [0.5]))
    >>> print(np.round(symbol.xx[[0, 1], [1, 0]] * np.pi / 2, 4))
    [0.5 1. ]
    """
    (ny, nx), (dy, dx) = shape, pixel_size
    eta = 2.0 * np.pi * np.fft.fftfreq(ny, dy)[:, None]
    xi = 2.0 * np.pi * np.fft.rfftfreq(nx, dx)[None, :]
    alpha = np.hypot(eta, xi)
    alpha[0, 0] = 1.0
    found = compliance(alpha, *layers)
    along, across = (xi / alpha) ** 2, (eta / alpha) ** 2
    xx = along * found.F11 + across * found.Fs
    yy = across * found.F11 + along * found.Fs
    xy = xi * eta / alpha**2 * (found.F11 - found.Fs)
    mean = _uniform_shear(layers)
    for symbol, value in ((xx, mean), (xy, 0.0), (yy, mean)):
        symbol[0, 0] = value
    if ny % 2 == 0:
        xy[ny // 2] = 0.0
    if nx % 2 == 0:
        xy[:, -1] = 0.0
    return TangentialCompliance(xx, xy, yy)


def _uniform_shear(layers: Layers) -> float:
    """Displacement of layers bonded to a rigid base under a uniform traction [m/Pa]."""
    if layers.base != "bonded":
        return 0.0
    stack = stack_of(*layers)
    return float((stack.h / stack.G).sum())


def isolated_compliance(
    shape: tuple[int, int], pixel_size: tuple[float, float], layers: Layers
) -> TangentialCompliance:
    r"""Influence coefficients of uniform tangential traction on one pixel, without images.

    Parameters
    ----------
    shape, pixel_size, layers
        As in `periodic_symbol`.

    Returns
    -------
    TangentialCompliance
        Displacement at the centres of pixels at offsets of 0 .. ny, 0 .. nx, (ny + 1, nx + 1)
        each [m/Pa].

    Raises
    ------
    DescriptionError
        As `layered.compliance`, and for layers that slide on their base: nothing holds them.

    Notes
    -----
    Homogeneous: with the corners of a pixel at X and Y, ``I_2`` the sum of ``Y asinh(X/|Y|)`` and
    ``I_0`` that and the same with X and Y exchanged,
    ``xx = [(1 - nu) I_0 + nu I_2]/(2 pi G)`` (Cerruti; Johnson 1985, section 3.6); exact to 1e-13
    near the pixel and 1e-15 of the largest coefficient far away. Layered: from tables of the point
    load, to 1e-9 of the largest coefficient for moduli that differ by a factor of a few.

    Examples
    --------
    With nu = 0 a half-space is as compliant along its surface as across it (Love):

    >>> xx = isolated_compliance((1, 1), (1.0, 1.0), Layers([1.0], [0.0])).xx
    >>> round(float(xx[0, 0]), 6)
    1.1222
    """
    modulus, ratio, thickness = (np.asarray(v, float).reshape(-1) for v in layers[:3])
    (ny, nx), (dy, dx) = shape, pixel_size
    x, y = dx * np.arange(nx + 1.0), dy * np.arange(ny + 1.0)
    if layers.base == "frictionless":
        raise DescriptionError(
            "RigidBase.bonded",
            False,
            "be True under a tangential force on an isolated contact: nothing else holds them",
            hint="bond them to the base, or use Window(periodic=True)",
        )
    if thickness.size == 0:
        shear = 0.5 * modulus[0] / (1.0 + ratio[0])
        base = love.rectangle(x, y[:, None], 0.5 * dx, 0.5 * dy, 2.0 * shear)
        scale = -ratio[0] / shear
        parts = (_uniform(nx, ny, dx, dy), _uniform(ny, nx, dy, dx))
    else:
        reach = point_load.Radii(0.5 * min(dx, dy), float(np.hypot(x[-1] + dx, y[-1] + dy)))
        transverse, difference = _responses(Layers(modulus, ratio, thickness, layers.base))
        base = coefficients_of(point_load.table_of(transverse, thickness, reach), shape, pixel_size)
        load, scale = point_load.table_of(difference, thickness, reach), 1.0
        parts = (_tabulated(nx, ny, dx, dy, load), _tabulated(ny, nx, dy, dx, load))
    scale /= 2.0 * np.pi
    along_x, cross = parts[0]
    along_y = parts[1][0].T
    return TangentialCompliance(base + scale * along_x, scale * cross, base + scale * along_y)


def _responses(layers: Layers) -> tuple[point_load.Response, point_load.Response]:
    """Responses of F_s and of F_11 - F_s; a bonded base is all that long waves feel."""
    ratio = np.asarray(layers.poisson_ratio)
    short, long = (2.0 * (1.0 + ratio) / np.asarray(layers.young_modulus))[[0, -1]]
    if layers.base:
        long = 0.0

    def transverse(alpha: Array) -> Array:
        return np.asarray(alpha * compliance(alpha, *layers).Fs)

    def difference(alpha: Array) -> Array:
        found = compliance(alpha, *layers)
        return np.asarray(alpha * (found.F11 - found.Fs))

    return (
        point_load.Response(transverse, float(short), float(long)),
        point_load.Response(difference, float(-ratio[0] * short), float(-ratio[-1] * long)),
    )


# Integrals along the edges of a pixel that lie at distances X, along Y -----------------------


def _edges(count: int, side: float) -> Array:
    """Edges of the pixels at offsets of 0 .. count, beyond the middle of the first."""
    return side * (np.arange(count + 1.0) + 0.5)


def _between(strip_x: Array, strip_xy: Array) -> tuple[Array, Array]:
    """Differences between both edges of each pixel; the first one is mirrored in itself."""
    along = np.diff(strip_x, axis=1, prepend=-strip_x[:, :1])
    cross = np.diff(strip_xy, axis=1, prepend=strip_xy[:, :1])
    return along, cross


def _uniform(n_x: int, n_y: int, dx: float, dy: float) -> tuple[Array, Array]:
    """Integrals of X/r and Y/r along the edges, of I = 1."""
    x, top = _edges(n_x, dx), _edges(n_y, dy)[:, None]
    low = top - dy
    r_top, r_low = np.hypot(x, top), np.hypot(x, low)
    step = (top - low) * (top + low)
    angle = 2.0 * np.arcsinh(top[0] / x) + np.zeros_like(top)
    # Of the difference of two inverse hyperbolic sines, without cancellation.
    angle[1:] = np.arcsinh(step[1:] / (top * r_low + low * r_top)[1:])
    return _between(x * angle, step / (r_top + r_low))


def _tabulated(
    n_x: int, n_y: int, dx: float, dy: float, load: point_load.PointLoad
) -> tuple[Array, Array]:
    """Integrals of X I/r and Y I/r along the edges."""
    x, top = _edges(n_x, dx), _edges(n_y, dy)
    low = top - dy
    angles = np.arcsinh(low[:, None] / x), np.arcsinh(top[:, None] / x)
    many = 16 + int(8.0 * float((angles[1] - angles[0]).max()))
    strip_x, strip_xy = _integrals(x, *angles, load, _NODES)
    near = (slice(_NEAR), slice(_NEAR))
    ends = angles[0][near], angles[1][near]
    strip_x[near], strip_xy[near] = _integrals(x[:_NEAR], *ends, load, many)
    # Along thin pixels an edge close by is long against its distance, however far along it.
    long = angles[1] - angles[0] > 0.5
    long[near] = False
    for row in np.flatnonzero(long.any(axis=1)):
        ends = angles[0][row : row + 1], angles[1][row : row + 1]
        strip_x[row], strip_xy[row] = (one[0] for one in _integrals(x, *ends, load, many))
    return _between(strip_x, strip_xy)


def _integrals(
    distance: Array, lower: Array, upper: Array, load: point_load.PointLoad, count: int
) -> tuple[Array, Array]:
    """Integrals of X I and Y I over u, with Y = X sinh u, r = X cosh u and dY/r = du."""
    nodes, weights = np.polynomial.legendre.leggauss(count)
    along, cross = np.zeros_like(lower), np.zeros_like(lower)
    half = 0.5 * (upper - lower)
    for node, weight in zip(nodes, weights, strict=True):
        u = lower + half * (1.0 + node)
        value = weight * half * distance * point_load.mean_to(load, distance * np.cosh(u))
        along += value
        cross += value * np.sinh(u)
    return along, cross
