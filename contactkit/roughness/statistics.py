r"""Statistics of a height map: heights, slopes, curvatures, summits, bearing area, correlation.

Heights z [m] are ``[y, x]``, ``pixel_size = (dy, dx)`` [m]; the mean of the heights is subtracted
first. With ``periodic=True`` the map is one period of an infinite surface; otherwise nothing is
assumed beyond its edges. Power spectral densities are in `spectra`.

Roughness parameters depend on the scan. The standard deviation grows with the window up to the
longest waves. The slope grows as the pixel shrinks down to the shortest waves, the curvature
faster; for an exponential autocorrelation without a cut-off they diverge as :math:`dx^{-1/2}` and
:math:`dx^{-3/2}`. Quote pixel and window with every parameter.
"""

from __future__ import annotations

import math
from typing import Literal, NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy import fft

from ..errors import DescriptionError
from .spectra import as_map, as_pixel_size, nayak_parameter, spectral_moment

__all__ = [
    "BearingCurve",
    "Summits",
    "SurfaceStatistics",
    "autocorrelation",
    "bearing_curve",
    "bearing_fraction",
    "correlation_length",
    "kurtosis",
    "rms",
    "rms_curvature",
    "rms_slope",
    "skewness",
    "standardised",
    "summits",
    "surface_statistics",
]

# Below it squares of curvatures underflow on pixels of a metre or more. An atom is 1e-10 m: what
# differs by less is a plane with round-off.
_LOWEST = 1e-30  # [m]

Array = NDArray[np.float64]
Pair = tuple[float, float]
Derivatives = Literal["spectral", "differences"]


class SurfaceStatistics(NamedTuple):
    """Roughness parameters of one map; see the functions of the same names."""

    rms: float
    """Standard deviation of the heights [m] (Sq)."""
    mean_deviation: float
    """Mean absolute deviation of the heights [m] (Sa)."""
    lowest: float
    """Deepest valley, from the mean, negative [m]."""
    highest: float
    """Highest peak, from the mean [m]."""
    skewness: float
    """Skewness of the heights [-]; negative for pits."""
    kurtosis: float
    """Kurtosis of the heights [-]; 3 for Gaussian heights."""
    rms_slope: float
    """Root of the mean square of the gradient [-]; of an isotropic surface the root of 2 times
    that of its profiles."""
    rms_slopes: Pair
    """Root mean squares of the slopes along y and along x [-]."""
    rms_laplacian: float
    """Root of the mean square of the Laplacian [1/m]; summits of Gaussian heights have radii of
    about 2 over it."""
    rms_curvature: float
    """Root of the mean square of the mean curvature [1/m], half of `rms_laplacian`; profiles of an
    isotropic surface have the root of 3/8 times the Laplacian."""
    nayak_parameter: float
    """Breadth of the spectrum [-], by the isotropic formula."""
    correlation_length: Pair
    """Lags (y, x) over which the autocorrelation falls to a tenth [m]; inf if it does not."""
    tilt: Pair
    """Slopes (y, x) of the plane that fits the map best [-]; 0 for a periodic map."""
    derivatives: str
    """How slopes and curvatures were taken: ``spectral`` or ``differences``."""
    pixel_size: Pair
    """Size of a pixel (dy, dx) [m]."""
    window: Pair
    """Size of the map (y, x) [m]."""


class Summits(NamedTuple):
    """Summits of a map: pixels higher than their eight neighbours."""

    density: float
    """Their number over the area of the pixels that may be one [1/m2]."""
    mean_height: float
    """Mean of their heights, from the mean of the map [m]."""
    rms_height: float
    """Standard deviation of their heights [m]."""
    radius: float
    """Radius of curvature at a summit [m]: one over the mean of their curvatures."""
    number: int
    """How many there are."""


class BearingCurve(NamedTuple):
    """Abbott-Firestone curve: the fraction of a map that lies at or above a height."""

    height: Array
    """Heights from the mean of the map [m], falling."""
    fraction: Array
    """Fraction of the map at or above them [-], rising to 1."""


def rms(heights: Array) -> float:
    """Standard deviation of the heights [m], dividing by the number of pixels.

    Nearly independent of the pixel; grows with the window up to the longest wave of the surface.
    """
    return float(np.std(as_map(heights)))


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

    Smaller than that of the spectrum (`spectra.spectral_moment`) by the factor
    :math:`\sin(q dx/2)/(q dx/2)` for each wave: 10 % for a wave of 4 pixels, 36 % for one of 2.

    Examples
    --------
    >>> rms_slope(np.array([[0.0, 1.0], [0.0, 1.0]]), (1.0, 2.0), periodic=False)
    0.5
    """
    return math.hypot(*_slopes(heights, pixel_size, periodic))


def _slopes(heights: Array, pixel_size: Pair, periodic: bool) -> Pair:
    """Root mean squares of the slopes along y and x, from differences of neighbours."""
    if not periodic:
        _need_pixels(heights, 2)
    heights, found = as_map(heights), list[float]()
    for axis, d in enumerate(pixel_size):
        step = np.roll(heights, -1, axis) - heights if periodic else np.diff(heights, axis=axis)
        found.append(math.sqrt(float(np.mean((step / d) ** 2))))
    return found[0], found[1]


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
    return 0.5 * math.sqrt(float(np.mean(_laplacian(heights, pixel_size, periodic) ** 2)))


def _laplacian(heights: Array, pixel_size: Pair, periodic: bool) -> Array:
    """Laplacian of the heights [1/m], without the edges of a map that is not periodic."""
    if not periodic:
        _need_pixels(heights, 3)
    dy, dx = pixel_size
    z = np.pad(as_map(heights), 1, mode="wrap") if periodic else as_map(heights)
    inner = z[1:-1, 1:-1]
    bent = (z[1:-1, 2:] - 2.0 * inner + z[1:-1, :-2]) / dx**2
    bent += (z[2:, 1:-1] - 2.0 * inner + z[:-2, 1:-1]) / dy**2
    return np.asarray(bent)


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
    z = as_map(heights)
    below = np.searchsorted(np.sort(z, axis=None), np.asarray(level), side="left")
    return np.asarray(1.0 - below / z.size)


def bearing_curve(heights: ArrayLike, points: int = 256) -> BearingCurve:
    """Abbott-Firestone curve of a map: its heights over the fraction of the map above them.

    Parameters
    ----------
    heights : array_like (ny, nx)
        Heights [m]; their mean is subtracted.
    points : int
        Number of points, at equal distances in the fraction; the first is the highest pixel.

    Raises
    ------
    DescriptionError
        If the map has holes, or fewer than two points are asked for.

    Examples
    --------
    >>> found = bearing_curve(np.array([[0.0, 1.0], [2.0, 3.0]]), points=4)
    >>> found.height.tolist(), found.fraction.tolist()
    ([1.5, 0.5, -0.5, -1.5], [0.25, 0.5, 0.75, 1.0])
    """
    z = as_map(heights)
    if isinstance(points, bool) or not isinstance(points, int) or points < 2:
        raise DescriptionError("bearing_curve.points", points, "be a whole number of at least 2")
    falling = np.sort(z - z.mean(), axis=None)[::-1]
    rank = np.unique(np.rint(np.linspace(1, z.size, min(points, z.size))).astype(np.int64))
    height = np.asarray(falling[rank - 1])
    # Equal heights are borne together: all of them lie at or above their height.
    below = np.searchsorted(falling[::-1], height, side="left")
    return BearingCurve(height, np.asarray(1.0 - below / z.size))


def summits(heights: ArrayLike, pixel_size: float | Pair, periodic: bool) -> Summits:
    """Summits of a map, for `contact_theories.greenwood_williamson`.

    Pixels higher than their eight neighbours (of equal ones the last counts); their curvature is
    half the Laplacian by second differences. The pixels at the edges of a map that is not periodic
    are left out. Number and radius depend on the pixel: quote it with them.

    Raises
    ------
    DescriptionError
        If the map has holes, is smaller than 3 x 3 pixels, or has no summit.

    Examples
    --------
    >>> x = 2.0 * math.pi * np.arange(64) / 32
    >>> z = np.cos(x)[:, None] + np.cos(x)[None, :]
    >>> found = summits(z, 2.0 * math.pi / 32, periodic=True)
    >>> found.number, round(found.mean_height, 12), round(found.radius, 2)
    (4, 2.0, 1.0)
    """
    z, size = as_map(heights), as_pixel_size(pixel_size)
    _need_pixels(z, 3)
    z = z - z.mean()
    around = np.pad(z, 1, mode="wrap") if periodic else z
    inner = around[1:-1, 1:-1]
    is_summit = np.ones(inner.shape, dtype=bool)
    ny, nx = inner.shape
    for i, j in ((i, j) for i in range(3) for j in range(3) if (i, j) != (1, 1)):
        near = around[i : i + ny, j : j + nx]
        is_summit &= inner > near if (i, j) > (1, 1) else inner >= near
    number = int(is_summit.sum())
    if number == 0:
        raise DescriptionError(
            "heights", "a map without a summit", "have pixels above all 8 around"
        )
    curvature = -0.5 * _laplacian(z, size, periodic)[is_summit]
    tops = inner[is_summit]
    return Summits(
        number / (inner.size * size[0] * size[1]),
        float(tops.mean()),
        float(tops.std()),
        1.0 / float(curvature.mean()),
        number,
    )


def surface_statistics(
    heights: ArrayLike,
    pixel_size: float | Pair,
    periodic: bool,
    derivatives: Derivatives | None = None,
) -> SurfaceStatistics:
    """All roughness parameters of a map.

    Parameters
    ----------
    heights : array_like (ny, nx)
        Heights [m], peaks up; their mean is subtracted, a tilt is not (`height_maps.detrended`).
    pixel_size : float or (float, float)
        Size of a pixel [m]; a pair is (dy, dx).
    periodic : bool
        Whether the map is one period of the surface.
    derivatives : {"spectral", "differences"}, optional
        Slopes and curvatures of the waves themselves, for periodic maps only; or from differences
        of neighbouring pixels, which miss 1.9 % of the slope of a surface whose shortest wave has
        4 pixels, and 0.2 % at 16. Not given: spectral where the map is periodic.

    Raises
    ------
    DescriptionError
        If the map has holes, is flat, has fewer than 3 x 3 pixels without being periodic, or
        heights that are no lengths in metres.

    Examples
    --------
    >>> y, x = np.mgrid[:16, :16] * (2.0 * math.pi / 16)
    >>> found = surface_statistics(1e-9 * np.cos(x) * np.cos(y), 1e-9, periodic=True)
    >>> round(found.rms * 1e9, 12), round(found.kurtosis, 12), found.window
    (0.5, 2.25, (1.6e-08, 1.6e-08))
    >>> round(found.rms_slope, 6), round(found.nayak_parameter, 12), found.derivatives
    (0.27768, 1.5, 'spectral')
    """
    z, size = as_map(heights), as_pixel_size(pixel_size)
    if derivatives not in (None, "spectral", "differences"):
        raise DescriptionError(
            "surface_statistics.derivatives", derivatives, "be 'spectral' or 'differences'"
        )
    if derivatives == "spectral" and not periodic:
        raise DescriptionError(
            "surface_statistics.derivatives",
            derivatives,
            "be 'differences' for a map that is not periodic, whose edges would add waves",
        )
    centred = z - z.mean()
    shape = standardised(z)  # refuses a plane
    if np.abs(centred).max() < _LOWEST:
        raise DescriptionError(
            "heights",
            f"a map of {np.abs(centred).max():.3g} m",
            f"differ by {_LOWEST:g} m or more, as the squares of curvatures underflow",
            hint="check their unit",
        )
    kind = derivatives or ("spectral" if periodic else "differences")
    slopes, laplacian = (_spectral if kind == "spectral" else _by_differences)(
        centred, size, periodic
    )
    slope, variance = math.hypot(*slopes), rms(z) ** 2
    return SurfaceStatistics(
        rms=rms(z),
        mean_deviation=float(np.abs(centred).mean()),
        lowest=float(centred.min()),
        highest=float(centred.max()),
        skewness=float(np.mean(shape**3)),
        kurtosis=float(np.mean(shape**4)),
        rms_slope=slope,
        rms_slopes=slopes,
        rms_laplacian=laplacian,
        rms_curvature=0.5 * laplacian,
        nayak_parameter=nayak_parameter(variance, slope**2, laplacian**2),
        correlation_length=correlation_length(z, size, periodic),
        tilt=(0.0, 0.0) if periodic else _tilt(centred, size),
        derivatives=kind,
        pixel_size=size,
        window=(z.shape[0] * size[0], z.shape[1] * size[1]),
    )


def _spectral(z: Array, size: Pair, periodic: bool) -> tuple[Pair, float]:
    """Rms slopes along y and x [-], and rms Laplacian [1/m], of the waves of a periodic map."""
    waves = np.abs(fft.fft2(z, norm="forward")) ** 2
    qy, qx = (2.0 * math.pi * fft.fftfreq(n, d) for n, d in zip(z.shape, size, strict=True))
    along_y = math.sqrt(float(np.sum(waves * (qy * qy)[:, None])))
    along_x = math.sqrt(float(np.sum(waves * (qx * qx)[None, :])))
    return (along_y, along_x), math.sqrt(spectral_moment(z, size, 4))


def _by_differences(z: Array, size: Pair, periodic: bool) -> tuple[Pair, float]:
    """Rms slopes along y and x [-], and rms Laplacian [1/m], from differences of pixels."""
    return _slopes(z, size, periodic), 2.0 * rms_curvature(z, size, periodic)


def _tilt(z: Array, size: Pair) -> Pair:
    """Slopes (y, x) of the plane of least squares through a map of zero mean."""
    found = []
    for axis, d in enumerate(size):
        place = (np.arange(z.shape[axis]) - 0.5 * (z.shape[axis] - 1)) * d
        line = z.mean(axis=1 - axis)
        found.append(float(place @ line) / float(place @ place))
    return found[0], found[1]


def _need_pixels(heights: Array, least: int) -> None:
    if min(heights.shape) < least:
        raise DescriptionError("heights", heights.shape, f"have at least {least} x {least} pixels")


# Autocorrelation -----------------------------------------------------------------------------


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
    z = as_map(heights) - np.mean(heights)
    largest = float(np.abs(z).max())
    # Round-off makes a plane at a height of 1 m rough by 1e-16 m.
    if largest <= 1e-14 * float(np.abs(heights).max()):
        raise DescriptionError("heights", "a plane", "vary, for their shape to have a number")
    z /= largest
    return np.asarray(z / np.std(z))


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
    z = as_map(heights) - np.mean(heights)
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


def _first_tenth(values: Array) -> float:
    """Lag, in steps, at which a curve first falls to a tenth of its start; inf if it does not."""
    under = values <= 0.1 * values[0]
    if not under.any():
        return math.inf
    i = int(np.argmax(under))
    before, after = float(values[i - 1]), float(values[i])
    return i - 1 + (before - 0.1 * float(values[0])) / (before - after)
