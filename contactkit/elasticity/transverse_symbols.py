"""Symbols of the pressure on transversely isotropic layers, in windows of any kind.

The makers are those of isotropic layers (`layered`, `influence`, `one_axis`) with the compliance of
`transverse_layers`. Isolated half-spaces without layers are isotropic ones of another modulus.
"""

from __future__ import annotations

from functools import partial
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from ..errors import DescriptionError
from . import influence, layered, one_axis, point_load
from .transverse_isotropy import PlaneConstants, plane_strain_modulus, roots_of
from .transverse_layers import TransverseLayers, normal_compliance

__all__ = ["isolated_symbol", "one_axis_symbol", "periodic_symbol"]

# Of |s1 - s2|/(s1 + s2) of conjugate roots. The table of a point load, of 40 wavenumbers to a
# decade, leaves 3e-12 of the largest coefficient at 1, 9e-12 at 2, 3e-9 at 3 and 2e-7 at 4.
_MOST_TURNS = 3.0

Array = NDArray[np.float64]
Shape = tuple[int, int]
Pair = tuple[float, float]


def periodic_symbol(shape: Shape, pixel_size: Pair, layers: TransverseLayers) -> Array:
    """Normal compliance on the real-FFT grid of a periodic map, as `layered.normal_symbol` [m/Pa].

    Parameters
    ----------
    shape : tuple of int
        Pixels (ny, nx) of the map.
    pixel_size : tuple of float
        Sides (dy, dx) of a pixel [m].
    layers : TransverseLayers
        The solid. On a rigid base a mean pressure compresses its layers by ``sum h/c33`` of it.

    Examples
    --------
    >>> from .transverse_isotropy import isotropic_constants
    >>> sheet = TransverseLayers((isotropic_constants(1.0, 0.0),), (2.0,), "bonded")
    >>> float(periodic_symbol((1, 4), (1.0, 1.0), sheet)[0, 0])
    2.0
    """
    mean = 0.0
    if layers.base is not None:
        pairs = zip(layers.thickness, layers.solids, strict=True)
        mean = sum(h * solid.axial for h, solid in pairs)
    return layered.symbol_of(
        lambda alpha: normal_compliance(alpha, layers), shape, pixel_size, mean
    )


def isolated_symbol(shape: Shape, pixel_size: Pair, layers: TransverseLayers) -> Array:
    """Transform of the influence coefficients of an isolated contact, as `influence.symbol` [m/Pa].

    Parameters
    ----------
    shape, pixel_size, layers
        As of `periodic_symbol`.

    Raises
    ------
    DescriptionError
        As `normal_compliance`, or for a layer so stiff in shear that its waves turn over and over
        before they decay: the table of the point load would leave more than 3e-9.

    Examples
    --------
    A pixel on a half-space, Love's 4 ln(1 + sqrt 2)/pi:

    >>> from .transverse_isotropy import isotropic_constants
    >>> symbol = isolated_symbol(
    ...     (1, 1), (1.0, 1.0), TransverseLayers((isotropic_constants(1.0, 0.0),)))
    >>> round(float(np.fft.irfft2(symbol, s=(2, 2))[0, 0]), 4)
    1.1222
    """
    return influence.symbol_of(_coefficients(shape, pixel_size, layers))


def one_axis_symbol(
    shape: Shape, pixel_size: Pair, layers: TransverseLayers, along: Literal["x", "y"]
) -> Array:
    """Transform of the coefficients of a window that repeats along an axis, as `one_axis.symbol`.

    Parameters
    ----------
    shape, pixel_size, layers
        As of `periodic_symbol`.
    along : {"x", "y"}
        Axis along which the window repeats. The datum across it is that of `one_axis.reference`,
        with indentation moduli in place of shear moduli.

    Raises
    ------
    DescriptionError
        As `isolated_symbol`.

    Examples
    --------
    >>> from .transverse_isotropy import isotropic_constants
    >>> film, steel = isotropic_constants(1.0, 0.4), isotropic_constants(4.0, 0.3)
    >>> layers = TransverseLayers((film, steel), (0.5,))
    >>> one_axis_symbol((2, 6), (1.0, 1.0), layers, "x").shape
    (4, 4)
    """
    moduli = [plane_strain_modulus(one) for one in layers.solids]
    bending = 0.0
    if layers.base is None:
        pairs = zip(layers.thickness, moduli, strict=False)
        bending = sum(h * max(float(np.cbrt(m / moduli[-1])) - 1.0, 0.0) for h, m in pairs)
    solid = one_axis.Solid(
        partial(_coefficients, layers=layers),
        partial(_table, layers) if layers.thickness else None,
        _response(layers).long,
        sum(layers.thickness) * max(moduli) / min(moduli),
        bending,
    )
    return one_axis.symbol_of(shape, pixel_size, solid, along)


def _response(layers: TransverseLayers) -> point_load.Response:
    """Wavenumber times compliance, from the half-space of the top layer to the substrate."""
    short, long = (2.0 / plane_strain_modulus(layers.solids[end]) for end in (0, -1))
    return point_load.Response(
        lambda alpha: alpha * normal_compliance(alpha, layers),
        short,
        0.0 if layers.base else long,
    )


def _table(layers: TransverseLayers, radii: point_load.Radii) -> point_load.PointLoad:
    for solid in layers.solids[: len(layers.thickness)]:
        _check_turns(solid)
    return point_load.table_of(_response(layers), np.array(layers.thickness), radii)


def _check_turns(solid: PlaneConstants) -> None:
    """Refuse a layer whose waves turn over and over before they decay: too stiff in shear."""
    roots = roots_of(solid)
    if roots.difference2 >= -((_MOST_TURNS * roots.sum) ** 2):
        return
    least = (4.0 * roots.product / (1.0 + _MOST_TURNS**2) - 2.0 * roots.excess) / solid.in_plane
    raise DescriptionError(
        "shear_modulus",
        1.0 / solid.shear,
        f"be at most {1.0 / least:.4g} in layers of a window that does not repeat along both axes: "
        "with the other constants given, waves turn over and over before they decay",
        unit="Pa",
        hint="check its unit, or use Window(periodic=True)",
    )


def _coefficients(shape: Shape, pixel_size: Pair, layers: TransverseLayers) -> Array:
    if not layers.thickness:
        modulus = plane_strain_modulus(layers.solids[0])
        return influence.coefficients(shape, pixel_size, [modulus], [0.0])
    (ny, nx), (dy, dx) = shape, pixel_size
    diagonal = float(np.hypot((nx + 1.0) * dx, (ny + 1.0) * dy))
    load = _table(layers, point_load.Radii(0.5 * min(dx, dy), diagonal))
    return influence.coefficients_of(load, shape, pixel_size)
