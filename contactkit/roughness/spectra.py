r"""Autocorrelation and power spectral density of a height map.

Heights z [m] are ``[y, x]``, ``pixel_size = (dy, dx)`` [m], wavenumbers q [rad/m]; the mean of the
heights is subtracted first. The spectral density C [m4] is that of `roughness`:
:math:`\sigma^2 = \iint C\,d^2q / 4\pi^2`.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray
from scipy import fft

from ..errors import DescriptionError

__all__ = [
    "Spectrum",
    "autocorrelation",
    "correlation_length",
    "radial_spectrum",
    "spectral_moment",
    "standardised",
]

Array = NDArray[np.float64]
Pair = tuple[float, float]


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
