r"""Statistics of a height map: heights, slopes, curvatures, bearing area.

Heights z [m] are ``[y, x]``, ``pixel_size = (dy, dx)`` [m]; the mean of the heights is subtracted
first. With ``periodic=True`` the map is one period of an infinite surface; otherwise nothing is
assumed beyond its edges.

Roughness parameters depend on the scan. The standard deviation grows with the window up to the
longest waves. The slope grows as the pixel shrinks down to the shortest waves, the curvature
faster; for an exponential autocorrelation without a cut-off they diverge as :math:`dx^{-1/2}` and
:math:`dx^{-3/2}`. Quote pixel and window with every parameter.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ..errors import DescriptionError
from .spectra import (
    Spectrum,
    autocorrelation,
    correlation_length,
    radial_spectrum,
    spectral_moment,
    standardised,
)

__all__ = [
    "Spectrum",
    "Summary",
    "autocorrelation",
    "bearing_fraction",
    "correlation_length",
    "kurtosis",
    "radial_spectrum",
    "rms",
    "rms_curvature",
    "rms_slope",
    "skewness",
    "spectral_moment",
    "summary",
]

Array = NDArray[np.float64]
Pair = tuple[float, float]


class Summary(NamedTuple):
    """Roughness parameters of one map; see the functions of the same names."""

    rms: float
    """Standard deviation of the heights [m]."""
    lowest: float
    """Deepest valley, from the mean, negative [m]."""
    highest: float
    """Highest peak, from the mean [m]."""
    skewness: float
    """Skewness of the heights [-]."""
    kurtosis: float
    """Kurtosis of the heights [-]; 3 for Gaussian heights."""
    rms_slope: float
    """Root of the mean square of the gradient, from differences [-]."""
    rms_curvature: float
    """Root of the mean square of the mean curvature, from differences [1/m]."""
    correlation_length: Pair
    """Lags (y, x) over which the autocorrelation falls to a tenth [m]; inf if it does not."""
    pixel_size: Pair
    """Size of a pixel (dy, dx) [m]."""
    window: Pair
    """Size of the map (y, x) [m]."""


def rms(heights: Array) -> float:
    """Standard deviation of the heights [m], dividing by the number of pixels.

    Nearly independent of the pixel; grows with the window up to the longest wave of the surface.
    """
    return float(np.std(heights))


def skewness(heights: Array) -> float:
    """Third central moment over the cube of the standard deviation [-]: negative for pits.

    Nearly independent of the pixel; its scatter grows as the window has fewer correlation lengths.
    """
    return float(np.mean(standardised(heights) ** 3))


def kurtosis(heights: Array) -> float:
    """Fourth central moment over the square of the variance [-]: 3 for Gaussian heights.

    Sensitive to rare extremes, such as dust or bad pixels.
    """
    return float(np.mean(standardised(heights) ** 4))


def rms_slope(heights: Array, pixel_size: Pair, periodic: bool) -> float:
    r"""Root of the mean square of the gradient [-], from differences of neighbours.

    .. math:: s^2 = \langle (\Delta_x z/dx)^2 \rangle + \langle (\Delta_y z/dy)^2 \rangle

    Smaller than that of the spectrum (`spectral_moment`) by the factor
    :math:`\sin(q dx/2)/(q dx/2)` for each wave: 10 % for a wave of 4 pixels, 36 % for one of 2.

    Examples
    --------
    >>> rms_slope(np.array([[0.0, 1.0], [0.0, 1.0]]), (1.0, 2.0), periodic=False)
    0.5
    """
    _need_pixels(heights, 2)
    squares = 0.0
    for axis, d in enumerate(pixel_size):
        step = np.roll(heights, -1, axis) - heights if periodic else np.diff(heights, axis=axis)
        squares += float(np.mean(step**2)) / d**2
    return math.sqrt(squares)


def rms_curvature(heights: Array, pixel_size: Pair, periodic: bool) -> float:
    r"""Root of the mean square of the mean curvature [1/m], from second differences.

    .. math:: k = \tfrac12 \left(\frac{\Delta_x^2 z}{dx^2} + \frac{\Delta_y^2 z}{dy^2}\right)

    The mean curvature of a surface of small slope; 1/R for a sphere. Without `periodic` the pixels
    at the edges are excluded.

    Examples
    --------
    >>> y, x = np.mgrid[:5.0, :5.0]
    >>> rms_curvature((x * x + y * y) / (2.0 * 8.0), (1.0, 1.0), periodic=False)
    0.125
    """
    _need_pixels(heights, 3)
    dy, dx = pixel_size
    z = np.pad(heights, 1, mode="wrap") if periodic else heights
    inner = z[1:-1, 1:-1]
    bent = (z[1:-1, 2:] - 2.0 * inner + z[1:-1, :-2]) / dx**2
    bent += (z[2:, 1:-1] - 2.0 * inner + z[:-2, 1:-1]) / dy**2
    return 0.5 * math.sqrt(float(np.mean(bent**2)))


def bearing_fraction(heights: Array, level: ArrayLike) -> Array:
    """Bearing ratio [-]: fraction of the map at or above given levels (Abbott-Firestone curve).

    Parameters
    ----------
    heights : ndarray (ny, nx)
        Heights [m].
    level : array_like (...)
        Levels, from the same zero as the heights [m].

    Notes
    -----
    For undeformed heights; the contact area is smaller, because the surface deforms around a peak
    too: by half under a sphere. Its upper end is determined by the highest peaks, which are higher
    in a larger window.

    Examples
    --------
    >>> bearing_fraction(np.array([[0.0, 1.0], [2.0, 3.0]]), [-1.0, 2.0, 4.0]).tolist()
    [1.0, 0.5, 0.0]
    """
    below = np.searchsorted(np.sort(heights, axis=None), np.asarray(level), side="left")
    return np.asarray(1.0 - below / heights.size)


def summary(heights: Array, pixel_size: Pair, periodic: bool) -> Summary:
    """All roughness parameters of a map of at least 3 x 3 pixels.

    Raises
    ------
    DescriptionError
        If the map is flat, or smaller.

    Examples
    --------
    >>> y, x = np.mgrid[:16, :16] * (2.0 * math.pi / 16)
    >>> found = summary(1e-9 * np.cos(x) * np.cos(y), (1e-9, 1e-9), periodic=True)
    >>> round(found.rms * 1e9, 12), round(found.kurtosis, 12), found.window
    (0.5, 2.25, (1.6e-08, 1.6e-08))
    """
    z = heights - heights.mean()
    dy, dx = pixel_size
    ny, nx = z.shape
    return Summary(
        rms(z),
        float(z.min()),
        float(z.max()),
        skewness(z),
        kurtosis(z),
        rms_slope(z, pixel_size, periodic),
        rms_curvature(z, pixel_size, periodic),
        correlation_length(z, pixel_size, periodic),
        pixel_size,
        (ny * dy, nx * dx),
    )


def _need_pixels(heights: Array, least: int) -> None:
    if min(heights.shape) < least:
        raise DescriptionError("heights", heights.shape, f"have at least {least} x {least} pixels")
