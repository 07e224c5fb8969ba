r"""Statistics of a height map: heights, slopes, curvatures, bearing area, spectrum.

Heights z [m] are ``[y, x]``, ``pixel_size = (dy, dx)`` [m]; the mean of the heights is subtracted
first. With ``periodic=True`` the map is one period of an infinite surface; otherwise nothing is
assumed beyond its edges. The spectral density C [m4] over the wavenumber q [rad/m] is that of
`random_surfaces`: :math:`\sigma^2 = \iint C\,d^2q / 4\pi^2`.

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
from scipy import fft

from ..errors import DescriptionError

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
    "standardised",
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


# Autocorrelation and spectrum ---------------------------------------------------------------


class Spectrum(NamedTuple):
    """Power spectral density averaged over directions, ring by ring."""

    wavenumber: Array
    """Mean wavenumber of each ring [rad/m]."""
    density: Array
    r"""Density C [m4]: :math:`\sigma^2 = \iint C\,d^2q / 4\pi^2`."""
    n_waves: NDArray[np.int64]
    """Number of waves in each ring; the relative scatter is one over the root of half of it."""


def standardised(heights: Array) -> Array:
    """Heights less their mean, over their standard deviation [-].

    Raises
    ------
    DescriptionError
        If all heights are equal.

    Examples
    --------
    >>> standardised(np.array([[0.0, 4.0]])).tolist()
    [[-1.0, 1.0]]
    """
    z = heights - heights.mean()
    largest = float(np.abs(z).max())
    # Round-off makes a plane at a height of 1 m rough by 1e-16 m.
    if largest <= 1e-14 * float(np.abs(heights).max()):
        raise DescriptionError("heights", "a plane", "vary, for their shape to have a number")
    z /= largest
    return np.asarray(z / np.std(z))


def spectral_moment(heights: Array, pixel_size: Pair, order: int) -> float:
    r"""Moment of the spectrum of a periodic map, :math:`m_n = \sum_q |q|^n |A_q|^2` [m2-n].

    The variance for order 0, the mean square gradient for order 2, and four times the mean square
    of the mean curvature for order 4. Exact for a resolved periodic map; not meaningful for a
    non-periodic one, because the jump at the edges adds waves of all lengths.

    Examples
    --------
    >>> x = np.arange(8) * (2.0 * math.pi / 8)
    >>> z = np.sin(x)[None, :] * np.ones((8, 1))
    >>> [round(spectral_moment(z, (1.0, 2.0 * math.pi / 8), n), 12) for n in (0, 2, 4)]
    [0.5, 0.5, 0.5]
    """
    q, power, times = _power(heights, pixel_size)
    return float(np.sum(times * power * q**order))


def autocorrelation(heights: Array, periodic: bool) -> Array:
    """Autocovariance: mean product of two heights at a lag [m2], less the mean of the map.

    Parameters
    ----------
    heights : ndarray (ny, nx)
        Heights [m].
    periodic : bool
        Whether the map is periodic.

    Returns
    -------
    ndarray
        At [i, j] for the lag of i pixels along y and j along x; negative lags count from the end,
        as for transforms. Shape (ny, nx) if periodic, else (2 ny - 1, 2 nx - 1).

    Notes
    -----
    Subtracting the mean of the window lowers all values by about the variance times the square of
    correlation length over window. Without `periodic` large lags are means over few pairs.

    Examples
    --------
    >>> autocorrelation(np.array([[1.0, -1.0, 1.0, -1.0]]), periodic=True).tolist()
    [[1.0, -1.0, 1.0, -1.0]]
    """
    z = heights - heights.mean()
    shape = z.shape if periodic else tuple(2 * n - 1 for n in z.shape)
    sums: Array = fft.irfft2(np.abs(fft.rfft2(z, s=shape)) ** 2, s=shape)
    if periodic:
        return np.asarray(sums / z.size)
    rows, columns = (
        n - np.abs(np.rint(fft.fftfreq(2 * n - 1, 1.0 / (2 * n - 1)))) for n in z.shape
    )
    return np.asarray(sums / (rows[:, None] * columns[None, :]))


def correlation_length(heights: Array, pixel_size: Pair, periodic: bool) -> Pair:
    """Lags (y, x) at which the autocorrelation first falls to a tenth [m].

    By linear interpolation between pixels, within half the window; inf if the autocorrelation
    stays above a tenth there, as along a groove. Its relative scatter from map to map is about 2.5
    times its ratio to the window (40 maps, exponential autocorrelation). It hardly depends on the
    pixel, if that is much smaller.
    """
    standardised(heights)  # refuses a plane
    values = autocorrelation(heights, periodic)
    y, x = (
        _first_tenth(line[: n // 2 + 1]) * d
        for line, n, d in zip((values[:, 0], values[0]), heights.shape, pixel_size, strict=True)
    )
    return y, x


def radial_spectrum(heights: Array, pixel_size: Pair, periodic: bool) -> Spectrum:
    r"""Power spectral density averaged over rings of the width of one wave per window.

    Parameters
    ----------
    heights, pixel_size
        Map [m] and size of its pixels [m].
    periodic : bool
        Whether the map is one period. If not, a Hann window is applied in both directions, which
        removes the jump at the edges, conserves the sum of the density, and blurs it over two
        neighbouring rings.

    Notes
    -----
    Up to the Nyquist wavenumber of the coarser direction. The shortest waves of a measured map may
    be artefacts of the instrument: noise, or the tip radius.
    """
    z = heights - heights.mean()
    if not periodic:
        taper = np.outer(*(np.hanning(n + 2)[1:-1] for n in z.shape))
        z = (z - np.sum(taper * z) / taper.sum()) * taper / math.sqrt(float(np.mean(taper**2)))
    q, power, times = _power(z, pixel_size)
    area = math.prod(n * d for n, d in zip(z.shape, pixel_size, strict=True))
    width = 2.0 * math.pi / min(n * d for n, d in zip(z.shape, pixel_size, strict=True))
    ring = np.rint(q / width).astype(np.int64)
    inside = (q > 0.0) & (q <= math.pi / max(pixel_size))
    ring, q, power, times = ring[inside], q[inside], power[inside], times[inside]
    count = np.bincount(ring, times)
    has = count > 0.0
    mean_q = np.bincount(ring, times * q)[has] / count[has]
    density = area * np.bincount(ring, times * power)[has] / count[has]
    return Spectrum(mean_q, density, np.rint(count[has]).astype(np.int64))


def _first_tenth(values: Array) -> float:
    """Lag, in steps, at which a curve first falls to a tenth of its start; inf if it does not."""
    under = values <= 0.1 * values[0]
    if not under.any():
        return math.inf
    i = int(np.argmax(under))
    before, after = float(values[i - 1]), float(values[i])
    return i - 1 + (before - 0.1 * float(values[0])) / (before - after)


def _power(heights: Array, pixel_size: Pair) -> tuple[Array, Array, Array]:
    """Wavenumber [rad/m], square of the amplitude [m2] and number of the waves of a half plane."""
    ny, nx = heights.shape
    dy, dx = pixel_size
    power = np.abs(fft.rfft2(heights - heights.mean(), norm="forward")) ** 2
    qy, qx = 2.0 * math.pi * fft.fftfreq(ny, dy), 2.0 * math.pi * fft.rfftfreq(nx, dx)
    times = np.full(power.shape, 2.0)
    times[:, 0] = 1.0
    if nx % 2 == 0:
        times[:, -1] = 1.0
    return np.hypot(qy[:, None], qx[None, :]), power, times
