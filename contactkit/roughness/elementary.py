r"""Heights of simple shapes: waves, spheres, paraboloids.

Heights [m] are positive towards the other body: peaks up. Arrays are ``[y, x]``,
``shape = (ny, nx)``, ``pixel_size = (dy, dx)``; pixel (i, j) lies at :math:`y = i\,dy,\ x = j\,dx`.
"""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

__all__ = ["paraboloid", "sphere", "wave"]

Array = NDArray[np.float64]
Shape = tuple[int, int]
Pair = tuple[float, float]


def wave(
    shape: Shape,
    pixel_size: Pair,
    amplitude: float,
    wavelength: float,
    wavelength_y: float | None = None,
    phase: Pair = (0.0, 0.0),
) -> Array:
    r"""Heights of a sinusoidal wave along x, or of the product of two.

    .. math:: h = D \cos(2\pi x/\lambda_x + \varphi_x) \, [\cos(2\pi y/\lambda_y + \varphi_y)]

    Parameters
    ----------
    shape, pixel_size
        Pixels (ny, nx) and their size (dy, dx) [m].
    amplitude : float
        Amplitude D, half of the height from trough to crest [m].
    wavelength, wavelength_y : float
        Wavelengths along x and y [m]; without the second the wave is along x alone.
    phase : (float, float)
        Phases (y, x) [rad].

    Examples
    --------
    >>> wave((1, 4), (1e-6, 1e-6), 1e-9, 4e-6).round(12).tolist()
    [[1e-09, 0.0, -1e-09, -0.0]]
    """
    y, x = (
        np.cos(2.0 * math.pi * (np.arange(n) * d / length % 1.0) + shift) if length else np.ones(n)
        for n, d, length, shift in zip(
            shape, pixel_size, (wavelength_y, wavelength), phase, strict=True
        )
    )
    return np.asarray(amplitude * y[:, None] * x[None, :])


def sphere(shape: Shape, pixel_size: Pair, radius: float, centre: Pair | None = None) -> Array:
    r"""Heights of a sphere with its apex at height 0.

    .. math:: h = \sqrt{R^2 - r^2} - R

    Parameters
    ----------
    shape, pixel_size
        Pixels (ny, nx) and their size (dy, dx) [m].
    radius : float
        Radius R [m]. Beyond R the height is -R: a hemisphere on a plate.
    centre : (float, float), optional
        Position (y, x) of the apex [m]; default: the pixel (ny // 2, nx // 2).

    Notes
    -----
    Hertz' theory is for the `paraboloid`, which lies above the sphere by about
    :math:`r^4/(8 R^3)`.

    Examples
    --------
    >>> sphere((1, 3), (1.0, 3.0), 5.0).tolist()
    [[-1.0, 0.0, -1.0]]
    """
    y, x = _from_centre(shape, pixel_size, centre)
    square = np.minimum(y * y + x * x, radius * radius)
    return np.asarray(0.0 - square / (radius + np.sqrt(radius * radius - square)))


def paraboloid(
    shape: Shape,
    pixel_size: Pair,
    radius: float,
    radius_y: float | None = None,
    centre: Pair | None = None,
) -> Array:
    r"""Heights of a paraboloid with its apex at height 0.

    .. math:: h = -\frac{x^2}{2 R_x} - \frac{y^2}{2 R_y}

    Parameters
    ----------
    shape, pixel_size, centre
        As in `sphere`.
    radius, radius_y : float
        Radii of curvature along x and y at the apex [m], inf for a cylinder; `radius_y` defaults to
        `radius`.

    Examples
    --------
    >>> paraboloid((1, 3), (1.0, 2.0), 1.0).tolist()
    [[-2.0, 0.0, -2.0]]
    """
    y, x = _from_centre(shape, pixel_size, centre)
    second = radius if radius_y is None else radius_y
    return np.asarray(0.0 - (x * x / (2.0 * radius) + y * y / (2.0 * second)))


def _from_centre(shape: Shape, pixel_size: Pair, centre: Pair | None) -> tuple[Array, Array]:
    """Distances (ny, 1) and (1, nx) of the pixels from a point [m]."""
    at = centre or tuple((n // 2) * d for n, d in zip(shape, pixel_size, strict=True))
    y, x = (
        np.arange(n, dtype=np.float64) * d - c
        for n, d, c in zip(shape, pixel_size, at, strict=True)
    )
    return y[:, None], x[None, :]
