"""Surface compliance of a layered elastic solid in Fourier space, by layer recursion.

Conventions: the solid fills z >= 0 and z points into it; tension is positive; the loads are the
tractions on the solid, sigma_zz = -p and sigma_xz = -q_x at z = 0; the transform is
``f^(xi, eta) = iint f exp(-i (xi x + eta y)) dx dy`` and alpha = sqrt(xi^2 + eta^2).  With L along
the wave vector and T across it, the real unknowns of one wavenumber are ``u_L = iU, u_z = W,
sigma_Lz = iT, sigma_zz = S`` and, decoupled from them, ``u_T = V, sigma_Tz = Q``.  Bonded layers;
arrays of materials from the top to the substrate, or to the lowest layer on a rigid base.

Symbols inside this module:

=====  ===================================================================================
f      2 G alpha F: the compliance matrix (f11, f12, f22) made dimensionless with G of the layer
d      det f, an unknown of its own, because computing it from f cancels
fs     G alpha Fs, the same for the transverse shear
=====  ===================================================================================

The recursion runs from the substrate, or from the base, to the surface.  One layer transforms
(1, f11, f12, f22, d) by a linear map followed by one division; every product of sinh x, cosh x and
x in it is multiplied by exp(-2x), so that nothing overflows for any thickness, and the coefficients
of 1, f11, f22 and d are sums of non-negative terms, so that nothing cancels for any contrast.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ..errors import DescriptionError
from .layer_recursion import (
    Projective,
    climb,
    climb_shear,
    cross,
    half_space,
    on_base,
    on_base_shear,
    products,
)
from .layer_stack import Base, Stack, stack_of, uniform_compliance

__all__ = [
    "Compliance",
    "compliance",
    "blocks",
    "normal_symbol",
    "symbol_of",
]

Array = NDArray[np.float64]

# Wavenumbers per block: some thirty arrays of this length stay in the cache. 1024 take 2.5 times
# (calls), all of half a million at once twice as long; 4096 to 65536 the same.
BLOCK = 8192
# From here on it pays to sort the wavenumbers, most of which occur twice. On a square map of 400
# pixels it does from 3 layers on (16 against 19 ms, with 8 layers 23 against 45); where the sides
# of a map differ fewer wavenumbers are equal.
MANY_LAYERS = 6


class Compliance(NamedTuple):
    """Surface displacement per unit traction, for each wavenumber.

    ``U = -F11 T - F12 S``, ``W = -F12 T - C S`` and ``V = -Fs Q`` at z = 0, all in [m/Pa].
    """

    F11: Array
    F12: Array
    C: Array
    Fs: Array


def compliance(
    wavenumber: ArrayLike,
    young_modulus: ArrayLike,
    poisson_ratio: ArrayLike,
    thickness: ArrayLike,
    base: Base | None = None,
) -> Compliance:
    r"""Surface compliance of a layered half-space, or of layers on a rigid base.

    Parameters
    ----------
    wavenumber : array_like
        alpha > 0, any shape [1/m].
    young_modulus, poisson_ratio : array_like, shape (n_layers + 1,)
        From the top layer to the substrate [Pa], [1]; (n_layers,) on a rigid base.
    thickness : array_like, shape (n_layers,)
        Of the layers [m]; empty for a homogeneous half-space.
    base : {"bonded", "frictionless"}, optional
        Rigid base in place of a substrate.

    Returns
    -------
    Compliance
        F11, F12, C = F22 and Fs in the shape of `wavenumber` [m/Pa].

    Raises
    ------
    DescriptionError
        For a wavenumber, modulus or thickness that is not positive and finite, a Poisson's ratio
        outside (-1, 1/2], shapes that do not fit, or a result beyond the range of a double.

    Notes
    -----
    Bonded isotropic layers, small strains.  The relative error is below 1e-14 (of F12 relative to
    ``sqrt(F11 C)``) for any number of layers, contrast and alpha h.  A homogeneous half-space has
    ``F11 = C = 2 (1 - nu^2)/(E alpha)``, ``F12 = (1 - 2 nu)/(2 G alpha)``, ``Fs = 1/(G alpha)``
    (Johnson, Contact Mechanics, 1985, section 3; the layered problem is Burmister's, J. Appl.
    Phys. 16, 1945, 89). One layer of thickness h on a rigid base has, with x = alpha h,

    .. math:: C = \frac{2 (1 - \nu^2)}{E \alpha} \frac{\cosh 2x - 1}{\sinh 2x + 2x}, \qquad
              C = \frac{2 (1 - \nu^2)}{E \alpha} \frac{(3 - 4 \nu) \sinh 2x - 2x}
              {(3 - 4 \nu) \cosh 2x + 2x^2 + 5 - 12 \nu + 8 \nu^2}

    if it slides without friction or is bonded (Sneddon, Fourier Transforms, 1951;
    Johnson, section 5.8). For long waves they tend to ``(1 - nu^2) h/E`` and to
    ``(1 + nu)(1 - 2 nu) h/((1 - nu) E)``, zero for nu = 1/2, where
    ``C = alpha^2 h^3/E`` (a film that flows along the base).

    Examples
    --------
    A film four times as stiff as its substrate: long waves feel the substrate, short ones the film.

    >>> C = compliance([1e-3, 1.0, 1e3], [4e9, 1e9], [0.3, 0.3], [1.0]).C
    >>> print(np.round(C * [1e-3, 1.0, 1e3] * 1e9 / (2 * 0.91), 4))
    [0.9992 0.5615 0.25  ]
    """
    stack = stack_of(young_modulus, poisson_ratio, thickness, base)
    alpha = np.asarray(wavenumber, dtype=np.float64)
    if not np.all((alpha > 0.0) & np.isfinite(alpha)):
        bad = alpha[~((alpha > 0.0) & np.isfinite(alpha))].flat[0]
        raise DescriptionError(
            "compliance.wavenumber",
            float(bad),
            "be positive and finite",
            unit="1/m",
            hint="at wavenumber 0 the surface strains uniformly: uniform_compliance",
        )
    flat, back = _distinct(alpha, stack.h.size)
    out = np.empty((4, flat.size))
    _fill(out, flat, stack)
    if back is not None:
        out = out[:, back.ravel()]
    return Compliance(*(row.reshape(alpha.shape) for row in out))


def normal_symbol(
    shape: tuple[int, int],
    pixel_size: tuple[float, float],
    young_modulus: ArrayLike,
    poisson_ratio: ArrayLike,
    thickness: ArrayLike,
    base: Base | None = None,
) -> Array:
    """Normal compliance C on the real-FFT grid of a periodic map.

    Parameters
    ----------
    shape : (ny, nx)
        Of the map.
    pixel_size : (dy, dx)
        [m].
    young_modulus, poisson_ratio, thickness, base
        As in `compliance`.

    Returns
    -------
    ndarray, shape (ny, nx//2 + 1)
        C(alpha) [m/Pa]. At wavenumber 0 zero for a half-space, whose mean plane is the datum of
        displacements; on a rigid base, from which they count, that of uniaxial strain
        (`uniform_compliance`), as the mean strain along a periodic surface is zero.

    Raises
    ------
    DescriptionError
        As `compliance`, and for a shape or a pixel that is not positive.

    Notes
    -----
    Only one quarter of the grid is evaluated, and in a cell of equal sides each wavenumber once.

    Examples
    --------
    The wave of one period along x under a pressure of the same wave:

    >>> symbol = normal_symbol((4, 8), (0.5, 0.25), [1e9], [0.3], [])
    >>> symbol.shape, bool(np.isclose(symbol[0, 1], 2 * 0.91 / (1e9 * np.pi)))
    ((4, 5), True)
    """
    stack = stack_of(young_modulus, poisson_ratio, thickness, base)

    def at(alpha: Array) -> Array:
        values = np.empty((1, alpha.size))
        _fill(values, alpha, stack)
        return np.asarray(values[0])

    mean = 0.0
    if base is not None:
        mean = uniform_compliance(young_modulus, poisson_ratio, thickness, base)
    return symbol_of(at, shape, pixel_size, mean)


def symbol_of(
    at: Callable[[Array], Array],
    shape: tuple[int, int],
    pixel_size: tuple[float, float],
    mean: float = 0.0,
) -> Array:
    """Any compliance on the real-FFT grid of a periodic map, as `normal_symbol`.

    Parameters
    ----------
    at : callable
        Compliance at wavenumbers (m,) [1/m], (m,) [m/Pa].
    shape, pixel_size
        As in `normal_symbol`.
    mean : float
        Compliance at wavenumber 0 [m/Pa].

    Examples
    --------
    >>> symbol_of(lambda alpha: 1.0 / alpha, (1, 4), (1.0, 1.0)).round(3).tolist()
    [[0.0, 0.637, 0.318]]
    """
    (ny, nx), (ly, lx) = shape, _cell(shape, pixel_size)
    along_y, along_x = np.arange(ny // 2 + 1), np.arange(nx // 2 + 1)
    if ly == lx and max(along_y[-1], along_x[-1]) <= 4 * min(along_y.size, along_x.size):
        quarter = _of_squares(along_y, along_x, 2.0 * np.pi / lx, at)
    else:
        ky, kx = 2.0 * np.pi / ly * along_y, 2.0 * np.pi / lx * along_x
        alpha = np.hypot(ky[:, None], kx).ravel()
        quarter = np.zeros(alpha.size)
        quarter[1:] = at(alpha[1:])
        quarter = quarter.reshape(ky.size, kx.size)
    quarter[0, 0] = mean
    return np.concatenate([quarter, quarter[(ny - 1) // 2 : 0 : -1]])


def _cell(shape: tuple[int, int], pixel_size: tuple[float, float]) -> tuple[float, float]:
    if not (len(shape) == 2 and min(shape) >= 1):
        raise DescriptionError("normal_symbol.shape", shape, "be two positive integers (ny, nx)")
    if not (len(pixel_size) == 2 and all(0.0 < d < np.inf for d in pixel_size)):
        raise DescriptionError(
            "normal_symbol.pixel_size", pixel_size, "be two positive lengths (dy, dx)", unit="m"
        )
    return shape[0] * pixel_size[0], shape[1] * pixel_size[1]


# The recursion ------------------------------------------------------------------------------


def blocks(size: int) -> Iterator[slice]:
    """Slices of a long array, short enough for the cache."""
    return (slice(start, min(start + BLOCK, size)) for start in range(0, size, BLOCK))


def _distinct(alpha: Array, layers: int) -> tuple[Array, NDArray[np.intp] | None]:
    """Distinct wavenumbers, and the index of each requested one among them.

    It pays for the modes of a map, half of which mirror the other half.
    """
    if layers == 0 or alpha.size <= 2 * BLOCK:
        return alpha.ravel(), None
    if layers >= MANY_LAYERS:
        return np.unique(alpha, return_inverse=True)
    if alpha.ndim == 2 and np.array_equal(alpha[1:], alpha[:0:-1]):
        ny, nx = alpha.shape
        rows = np.arange(ny)
        rows = np.minimum(rows, ny - rows)
        return alpha[: ny // 2 + 1].ravel(), (rows[:, None] * nx + np.arange(nx)).ravel()
    return alpha.ravel(), None


def _fill(out: Array, alpha: Array, stack: Stack) -> None:
    """Write C (`out` of one row) or F11, F12, C, Fs (four rows) at every alpha into `out`."""
    with np.errstate(over="ignore", under="ignore"):
        for part in blocks(alpha.size):
            rows = _climbed(alpha[part], stack, shear=len(out) == 4)
            for row, values in zip(out, rows if len(out) == 4 else rows[2:3], strict=True):
                row[part] = values
    if not np.isfinite(out).all():
        raise DescriptionError(
            "compliance.wavenumber",
            float(alpha.min()),
            "be so large that 1/(G alpha) fits into a double",
            unit="1/m",
        )


def lowest(alpha: Array, stack: Stack, height: float | None = None) -> tuple[Projective, Array]:
    """Dimensionless compliance f and fs on top of the substrate, or of the layer on the base.

    `height` above the base [m], if not that of the whole layer.

    Examples
    --------
    >>> f, fs = lowest(np.array([1.0]), stack_of([2.0], [0.0], [50.0], "bonded"))
    >>> float(f[0][0]), float(fs[0])
    (2.0, 1.0)
    """
    _, nu, h, base = stack
    if base is None:
        return half_space(nu[-1], alpha.size), np.ones(alpha.size)
    p = products(alpha * (h[-1] if height is None else height))
    m, n = _ratios(nu[-1])
    return on_base(p, base, m, n), on_base_shear(p, base)


def carried(stack: Stack) -> int:
    """Number of layers above the substrate, or above the layer that rests on the base."""
    return stack.G.size - 1


def _ratios(nu: float) -> tuple[float, float]:
    return 1.0 / (1.0 - nu), (1.0 - 2.0 * nu) / (1.0 - nu)


def _climbed(alpha: Array, stack: Stack, *, shear: bool) -> tuple[Array, ...]:
    G, nu, h, _ = stack
    f, fs = lowest(alpha, stack)
    for j in reversed(range(carried(stack))):
        ratio, (m, n) = G[j] / G[j + 1], _ratios(nu[j])
        p = products(alpha * h[j])
        f = climb(p, cross(f, ratio), m, n)
        if shear:
            fs = climb_shear(p, fs * ratio)
    unit = 0.5 / G[0]
    return f[0] * unit / alpha, f[1] * unit / alpha, f[2] * unit / alpha, fs / G[0] / alpha


def _of_squares(
    along_y: NDArray[np.int_],
    along_x: NDArray[np.int_],
    k: float,
    at: Callable[[Array], Array],
) -> Array:
    """Compliance at k sqrt(i^2 + j^2), each sum of squares evaluated once; zero at the origin."""
    # Integers: equal wavenumbers are found exactly and without sorting.
    squares = (along_y * along_y)[:, None] + along_x * along_x
    met = np.zeros(squares[-1, -1] + 1, dtype=bool)
    met[squares] = True
    unique = np.flatnonzero(met)[1:]
    # Values before the table: the other way round takes a third longer, of pages that are returned.
    values = at(k * np.sqrt(unique))
    table = np.zeros(met.size)
    table[unique] = values
    return table[squares]
