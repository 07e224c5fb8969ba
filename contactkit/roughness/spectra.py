r"""Power spectral densities of a height map: of the plane, of rings of wavenumber, of profiles.

Conventions, with wavevectors :math:`q = 2\pi/\lambda` [rad/m] and a window of
:math:`L_y \times L_x`, are those of Jacobs, Junge and Pastewka (2017) and of SurfaceTopography:

.. math::

   C_{2D}(q) &= \frac{1}{L_x L_y} \Big|dx\,dy \sum z\, e^{-i q x}\Big|^2 \; [m^4], \qquad
   C_{1D}(q) = \frac{1}{L_x} \Big|dx \sum z\, e^{-i q x}\Big|^2 \; [m^3] \\
   \sigma^2 &= \int \frac{d^2q}{4\pi^2} C_{2D} = \frac{1}{2\pi} \int q\, C_{iso}\, dq
             = \frac{1}{\pi} \int_0^\infty C_{1D}\, dq

:math:`C_{iso}` is the mean of :math:`C_{2D}` over directions, not multiplied by q; :math:`C_{1D}`
is the mean over profiles. Persson's density is :math:`C_{2D}/4\pi^2` (`persson_density`).

A periodic map is transformed as it is. Another one is multiplied by a Hann window first, of mean
square 1, so that the density of stationary roughness is kept on average; a profile by a window
along it, a map by one that falls to zero at the ellipse inscribed in it. The window spreads a wave
over two neighbouring wavenumbers, and what a tilt or a bow of the map adds to it decays slowly:
remove them first (`height_maps.detrended`).

Values are given up to the reliability cut-off: two pixels (Nyquist), or `shortest_wavelength`,
below which an instrument does not resolve the surface (noise, tip radius, optical resolution).
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy import fft

from ..errors import DescriptionError

__all__ = [
    "PlaneSpectrum",
    "Spectrum",
    "nayak_parameter",
    "persson_density",
    "plane_spectrum",
    "profile_spectrum",
    "radial_spectrum",
    "spectral_moment",
]

Array = NDArray[np.float64]
Pair = tuple[float, float]


class PlaneSpectrum(NamedTuple):
    """Power spectral density over the plane of wavevectors, in the order of `numpy.fft.fftfreq`."""

    qy: Array
    """Wavenumbers along y [rad/m], (ny,)."""
    qx: Array
    """Wavenumbers along x [rad/m], (nx,)."""
    density: Array
    r"""Density :math:`C_{2D}` [m4], (ny, nx); 0 at q = 0, as heights count from their mean."""


class Spectrum(NamedTuple):
    """Power spectral density over the wavenumber."""

    wavenumber: Array
    """Wavenumber, of a ring the mean over its waves [rad/m]."""
    density: Array
    r"""Density: :math:`C_{iso}` [m4] of a map, :math:`C_{1D}` [m3] of profiles."""
    n_waves: NDArray[np.int64]
    """Number of waves in each value; the relative scatter is one over the root of half of it."""


# Above it squares of curvatures overflow on pixels of a nanometre or less. No surface is near it,
# nor would be in any unit: 1e20 to 1e60 refuse the same.
_HIGHEST = 1e30  # [m]

# What is accepted ---------------------------------------------------------------------------


def as_map(heights: ArrayLike) -> Array:
    """Heights as an array of two dimensions.

    Raises
    ------
    DescriptionError
        If they are no map of finite numbers; a map with holes (a masked array) is refused.

    Examples
    --------
    >>> as_map([[0, 1]])
    array([[0., 1.]])
    """
    if np.ma.isMaskedArray(heights) and np.ma.is_masked(heights):
        n = int(np.ma.getmaskarray(heights).sum())
        raise DescriptionError(
            "heights",
            f"a map with {n} masked pixels",
            "have a height at every pixel [m]",
            hint="cut out a part without holes, or fill them first",
        )
    z = np.asarray(heights, dtype=np.float64)
    if z.ndim != 2 or z.size < 2:
        raise DescriptionError("heights", z.shape, "have two dimensions (ny, nx) and 2 pixels")
    if not np.isfinite(z).all():
        n = int((~np.isfinite(z)).sum())
        raise DescriptionError(
            "heights",
            f"a map with {n} pixels that are not finite",
            "have a finite height at every pixel [m]",
            hint="cut out a part without holes, or fill them first",
        )
    if not np.abs(z).max() <= _HIGHEST:
        raise DescriptionError(
            "heights",
            f"a map of up to {np.abs(z).max():.3g} m",
            f"be at most {_HIGHEST:g} m, as the squares of curvatures overflow",
            hint="check their unit",
        )
    return z


def as_pixel_size(pixel_size: float | Pair) -> Pair:
    """Size of a pixel (dy, dx) [m]; one number stands for both.

    Raises
    ------
    DescriptionError
        If a size is not positive and finite.

    Examples
    --------
    >>> as_pixel_size(2e-9)
    (2e-09, 2e-09)
    """
    dy, dx = pixel_size if isinstance(pixel_size, tuple) else (pixel_size, pixel_size)
    for size in (dy, dx):
        if not (math.isfinite(size) and size > 0.0):
            raise DescriptionError("pixel_size", pixel_size, "be positive and finite", unit="m")
    return float(dy), float(dx)


# Spectra ------------------------------------------------------------------------------------


def plane_spectrum(heights: ArrayLike, pixel_size: float | Pair, periodic: bool) -> PlaneSpectrum:
    r"""Power spectral density :math:`C_{2D}` of a map over the plane of wavevectors.

    Parameters
    ----------
    heights : array_like (ny, nx)
        Heights [m]; their mean is subtracted.
    pixel_size : float or (float, float)
        Size of a pixel [m]; a pair is (dy, dx).
    periodic : bool
        Whether the map is one period; otherwise a Hann window is applied (module docstring).

    Notes
    -----
    The sum over all wavevectors divided by :math:`L_x L_y` is the variance of a periodic map, to
    round-off; of another map, the variance under the window.

    Raises
    ------
    DescriptionError
        If the map has holes, or a size is impossible.

    Examples
    --------
    >>> z = np.cos(2.0 * math.pi * np.arange(8) / 8)[None, :] * np.ones((4, 1))
    >>> found = plane_spectrum(z, 1.0, periodic=True)
    >>> found.density.argmax(), round(float(found.density.sum()) / 32.0, 12)
    (np.int64(1), 0.5)
    """
    z, (dy, dx) = as_map(heights), as_pixel_size(pixel_size)
    z = _windowed(z - z.mean(), periodic)
    ny, nx = z.shape
    density = np.abs(fft.fft2(z)) ** 2 * (dy * dx / z.size)
    qy, qx = (2.0 * math.pi * fft.fftfreq(n, d) for n, d in ((ny, dy), (nx, dx)))
    return PlaneSpectrum(np.asarray(qy), np.asarray(qx), np.asarray(density))


def radial_spectrum(
    heights: ArrayLike,
    pixel_size: float | Pair,
    periodic: bool,
    shortest_wavelength: float | None = None,
) -> Spectrum:
    r"""Power spectral density :math:`C_{iso}`, averaged over rings one wave per window wide.

    Parameters
    ----------
    heights, pixel_size, periodic
        As in `plane_spectrum`.
    shortest_wavelength : float, optional
        Reliability cut-off [m]; two pixels of the coarser direction if not given.

    Notes
    -----
    The shortest waves of a measured map may be artefacts of the instrument: give the wavelength
    down to which it resolves. For an anisotropic map this is a mean over directions.

    Raises
    ------
    DescriptionError
        If the map has holes or is shorter than the cut-off, or a number is impossible.

    Examples
    --------
    >>> z = np.cos(2.0 * math.pi * np.arange(8) / 8)[None, :] * np.ones((8, 1))
    >>> found = radial_spectrum(z, 1.0, periodic=True)
    >>> found.density.argmax(), int(found.n_waves[0])
    (np.int64(0), 8)
    """
    z, size = as_map(heights), as_pixel_size(pixel_size)
    z = _windowed(z - z.mean(), periodic)
    q, power, times = _power(z, size)
    area = math.prod(z.shape) * math.prod(size)
    # A map of one row has waves along x only.
    axes = [(n * d, d) for n, d in zip(z.shape, size, strict=True) if n > 1]
    width = 2.0 * math.pi / min(window for window, _ in axes)
    ring = np.rint(q / width).astype(np.int64)
    highest = _highest(max(axes)[0], 2.0 * max(d for _, d in axes), shortest_wavelength)
    inside = (q > 0.0) & (q <= highest)
    ring, q, power, times = ring[inside], q[inside], power[inside], times[inside]
    count = np.bincount(ring, times)
    has = count > 0.0
    mean_q = np.bincount(ring, times * q)[has] / count[has]
    density = area * np.bincount(ring, times * power)[has] / count[has]
    return Spectrum(mean_q, density, np.rint(count[has]).astype(np.int64))


def profile_spectrum(
    heights: ArrayLike,
    pixel_size: float | Pair,
    periodic: bool,
    axis: int = 1,
    shortest_wavelength: float | None = None,
) -> Spectrum:
    r"""Power spectral density :math:`C_{1D}` of the profiles along an axis, averaged over them.

    Parameters
    ----------
    heights, pixel_size, periodic
        As in `plane_spectrum`; a map of one row is one profile along x.
    axis : {0, 1}
        0: profiles along y; 1: along x.
    shortest_wavelength : float, optional
        Reliability cut-off [m]; two pixels if not given.

    Returns
    -------
    Spectrum
        From wavenumber 0 on, whose density is that of the means of the profiles. The mean of +q
        and -q, which for real heights are equal.

    Notes
    -----
    :math:`\sum n\,C_{1D}/L`, n = `n_waves` over the number of profiles, is the variance of a
    periodic map, to round-off.

    Raises
    ------
    DescriptionError
        If the map has holes or is shorter than the cut-off, or a number is impossible.

    Examples
    --------
    >>> z = np.cos(2.0 * math.pi * np.arange(8) / 8)[None, :] * np.ones((4, 1))
    >>> profile_spectrum(z, 1.0, periodic=True).density.round(12).tolist()
    [0.0, 2.0, 0.0, 0.0, 0.0]
    """
    z, size = as_map(heights), as_pixel_size(pixel_size)
    if axis not in (0, 1):
        raise DescriptionError("profile_spectrum.axis", axis, "be 0 (along y) or 1 (along x)")
    z, d = (z if axis == 1 else z.T), size[axis]
    z = z - z.mean()
    n_lines, n = z.shape
    if not periodic:
        taper = _hann(np.abs(_offsets(n)))
        z = z * (taper / math.sqrt(float(np.mean(taper**2))))
    density = np.mean(np.abs(fft.rfft(z, axis=1)) ** 2, axis=0) * (d / n)
    q = 2.0 * math.pi * fft.rfftfreq(n, d)
    kept = q <= _highest(n * d, 2.0 * d, shortest_wavelength)
    times = np.full(q.size, 2 * n_lines)
    times[0] = n_lines
    if n % 2 == 0:
        times[-1] = n_lines
    return Spectrum(np.asarray(q[kept]), np.asarray(density[kept]), times[kept])


def persson_density(density: ArrayLike) -> Array:
    r"""Density as Persson defines it [m4]: :math:`C_{2D}/4\pi^2`, whose plain integral is sigma^2.

    Examples
    --------
    >>> round(float(persson_density(4.0 * math.pi**2)), 12)
    1.0
    """
    return np.asarray(np.asarray(density, dtype=np.float64) / (4.0 * math.pi**2))


# Moments ------------------------------------------------------------------------------------


def spectral_moment(heights: ArrayLike, pixel_size: float | Pair, order: int) -> float:
    r"""Moment of the spectrum of a periodic map, :math:`m_n = \sum_q |q|^n |A_q|^2` [m2-n].

    The variance for order 0, the mean square gradient for order 2, and the mean square of the
    Laplacian, four times that of the mean curvature, for order 4. Exact for a resolved periodic
    map; not meaningful for a non-periodic one, because the jump at the edges adds waves of all
    lengths.

    Examples
    --------
    >>> x = np.arange(8) * (2.0 * math.pi / 8)
    >>> z = np.sin(x)[None, :] * np.ones((8, 1))
    >>> [round(spectral_moment(z, (1.0, 2.0 * math.pi / 8), n), 12) for n in (0, 2, 4)]
    [0.5, 0.5, 0.5]
    """
    q, power, times = _power(as_map(heights), as_pixel_size(pixel_size))
    return float(np.sum(times * power * q**order))


def nayak_parameter(variance: float, square_gradient: float, square_laplacian: float) -> float:
    r"""Breadth of the spectrum after Nayak [-], from the moments of an isotropic surface.

    .. math:: \alpha = \frac{m_0 m_4}{m_2^2} =
              \frac{3}{2} \frac{\langle z^2 \rangle \langle (\nabla^2 z)^2 \rangle}
              {\langle |\nabla z|^2 \rangle^2}

    with the moments of profiles :math:`m_2 = \langle|\nabla z|^2\rangle/2` and
    :math:`m_4 = 3 \langle(\nabla^2 z)^2\rangle/8`. At least 3/2 for an isotropic surface; 10 to
    1000 for self-affine ones. Without meaning across a lay.

    Parameters
    ----------
    variance, square_gradient, square_laplacian : float
        Mean squares of heights [m2], gradient [-] and Laplacian [1/m2].

    References
    ----------
    .. [1] Nayak, J. Lubr. Technol. 93 (1971) 398.

    Examples
    --------
    >>> nayak_parameter(0.5, 0.5, 0.5)
    1.5
    """
    return 1.5 * (variance / square_gradient) * (square_laplacian / square_gradient)


def _highest(window: float, least: float, shortest: float | None) -> float:
    """Largest wavenumber to give [rad/m]."""
    if shortest is None:
        return 2.0 * math.pi / least * (1.0 + 1e-12)
    if not (math.isfinite(shortest) and least * (1.0 - 1e-9) <= shortest <= window):
        raise DescriptionError(
            "shortest_wavelength",
            shortest,
            f"lie between two pixels, {least:g} m, and the window of {window:g} m",
            unit="m",
        )
    return 2.0 * math.pi / shortest * (1.0 + 1e-12)


def _offsets(n: int) -> Array:
    """Places of n pixels, from -1 to 1 at the edges of the map."""
    return (2.0 * np.arange(n) + 1.0 - n) / n


def _hann(distance: Array) -> Array:
    """Hann window over the distance from the centre, zero from 1 on."""
    return np.where(distance < 1.0, 0.5 + 0.5 * np.cos(math.pi * distance), 0.0)


def _windowed(z: Array, periodic: bool) -> Array:
    """Take a map under the window, its weighted mean zero and the mean square of weights 1."""
    if periodic:
        return z
    ny, nx = z.shape
    taper = _hann(np.hypot(_offsets(ny)[:, None], _offsets(nx)[None, :]))
    centred = z - float(np.sum(taper * z)) / float(taper.sum())
    return np.asarray(centred * (taper / math.sqrt(float(np.mean(taper**2)))))


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
