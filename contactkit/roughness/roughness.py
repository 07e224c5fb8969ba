r"""Random rough surfaces with a prescribed spectrum: exponential autocorrelation, self-affine.

Heights [m] of the rough body are positive towards the other body: peaks up. Arrays are
``[y, x]``, ``shape = (ny, nx)``, ``pixel_size = (dy, dx)``; pixel (i, j) lies at
:math:`y = i\,dy,\ x = j\,dx`, so that a grid with half the pixel holds every point of the coarse
one. The window is :math:`L_y \times L_x = n_y dy \times n_x dx`.

A random surface is the sum of the waves of the window, hence periodic, with zero mean:

.. math:: \langle |A_q|^2 \rangle = \frac{C(q)}{L_x L_y}, \qquad
          \sigma^2 = \frac{1}{4\pi^2} \iint C \, dq_x dq_y

The same seed on two grids of one window yields the same long waves, and grids that resolve the
short-wave cut-off sample the same surface (see `random_fields`).

====== ======================================= =====
symbol is                                      unit
====== ======================================= =====
q      wavenumber, 2 pi / wavelength           rad/m
C      power spectral density                  m4
l      decay length, correlation length / 2.3  m
====== ======================================= =====
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from ..errors import DescriptionError
from .elementary import paraboloid, sphere, wave
from .random_fields import Normalise, Waves, add_up, waves

__all__ = [
    "VarianceBudget",
    "gaussian_exponential",
    "paraboloid",
    "resolved_variance",
    "self_affine",
    "sphere",
    "wave",
]

Array = NDArray[np.float64]
Shape = tuple[int, int]
Pair = tuple[float, float]

_DECADE = 2.3  # Eq. (2.42): exp(-2.3) is a tenth


class VarianceBudget(NamedTuple):
    """Fractions of the variance of the infinite surface."""

    resolved: float
    """In waves that window and grid resolve and the cut-off passes."""
    cutoff: float
    """In waves shorter than the cut-off."""
    window: float
    """The rest: waves longer than the window, or too short for the grid. It may be slightly
    negative, because an integral is replaced by a sum over the waves of the window."""


def gaussian_exponential(
    shape: Shape,
    pixel_size: Pair,
    rms: float,
    correlation_length: float | Pair,
    cutoff_wavelength: float,
    seed: int,
    normalise: Normalise = "expected",
) -> Array:
    r"""Heights of a Gaussian surface with exponential autocorrelation.

    .. math:: R(x, y) = \sigma^2 e^{-\sqrt{(x/l_x)^2 + (y/l_y)^2}}, \qquad
              C(q) = \frac{2 \pi \sigma^2 l_x l_y}{[1 + (q_x l_x)^2 + (q_y l_y)^2]^{3/2}}

    with :math:`l = \beta^*/2.3`. The spectrum is sampled, which is never negative, unlike that
    of a sampled autocorrelation once :math:`\beta^*` exceeds a tenth of the window.

    Parameters
    ----------
    shape, pixel_size
        Pixels (ny, nx) and their size (dy, dx) [m].
    rms : float
        Standard deviation :math:`\sigma` of the heights [m].
    correlation_length : float or (float, float)
        Length :math:`\beta^*` over which the autocorrelation falls to a tenth, one number or
        (y, x) [m].
    cutoff_wavelength : float
        Shorter waves are excluded [m]. The rms slope, and with it the contact pressure, diverges as
        the cut-off tends to zero.
    seed : int
        Seed of the random numbers, zero or positive.
    normalise : {"expected", "sample", "none"}
        Meaning of `rms`. "expected": standard deviation of the resolved waves, averaged over all
        seeds; the spectrum is scaled up by what window and cut-off exclude (`resolved_variance`).
        "sample": standard deviation of this map. "none": that of the infinite surface, of which
        this map has the resolved part.

    Returns
    -------
    ndarray, shape (ny, nx)
        Heights [m], of zero mean.

    Raises
    ------
    DescriptionError
        If no wave passes the cut-off.

    Notes
    -----
    The relative scatter of the variance of one map is about :math:`\sqrt\pi\, l/L`, unless it is
    normalised by the sample. With a cut-off of two pixels or less the grid determines the waves, so
    that the surface depends on the grid; the caller should refuse that.

    References
    ----------
    .. [1] Eq. (2.42), and its Fourier transform.

    Examples
    --------
    >>> recipe = (1e-9, 0.5e-6, 0.2e-6, 7)
    >>> coarse = gaussian_exponential((256, 256), (20e-6 / 256, 20e-6 / 256), *recipe)
    >>> fine = gaussian_exponential((512, 512), (20e-6 / 512, 20e-6 / 512), *recipe)
    >>> bool(abs(fine[::2, ::2] - coarse).max() < 1e-20)
    True
    """
    which = waves(shape, pixel_size, cutoff_wavelength)
    area = shape[0] * pixel_size[0] * shape[1] * pixel_size[1]
    power = rms * rms / area * _exponential_psd(which, correlation_length)
    return add_up(shape, which, power, seed, rms * rms, normalise=normalise)


def resolved_variance(
    shape: Shape,
    pixel_size: Pair,
    correlation_length: float | Pair,
    cutoff_wavelength: float,
) -> VarianceBudget:
    r"""Fraction of the variance of `gaussian_exponential` that window, grid and cut-off retain.

    The cut-off removes :math:`(1 + q_c^2 l^2)^{-1/2}` of an isotropic surface.

    Parameters
    ----------
    shape, pixel_size, correlation_length, cutoff_wavelength
        As in `gaussian_exponential`.

    Raises
    ------
    DescriptionError
        If no wave passes the cut-off.

    Examples
    --------
    A correlation length of 50 nm on 256 points over 20 um: four fifths of the variance are lost.

    >>> dx = 20e-6 / 256
    >>> round(resolved_variance((256, 256), (dx, dx), 0.05e-6, 2 * dx).resolved, 2)
    0.25
    """
    which = waves(shape, pixel_size, cutoff_wavelength)
    area = shape[0] * pixel_size[0] * shape[1] * pixel_size[1]
    resolved = which.total(_exponential_psd(which, correlation_length)) / area
    ly, lx = (length / _DECADE for length in _pair(correlation_length))
    # In the plane (q_x l_x, q_y l_y) the spectrum is isotropic and the cut-off an ellipse.
    angle = np.arange(4096) * (2.0 * math.pi / 4096)
    reach = 2.0 * math.pi / cutoff_wavelength / np.hypot(np.cos(angle) / lx, np.sin(angle) / ly)
    beyond = float(np.mean(1.0 / np.hypot(1.0, reach)))
    return VarianceBudget(resolved, beyond, 1.0 - resolved - beyond)


def self_affine(
    shape: Shape,
    pixel_size: Pair,
    rms: float | None,
    hurst: float,
    rolloff_wavelength: float,
    cutoff_wavelength: float,
    seed: int,
    normalise: Normalise = "expected",
    *,
    rms_slope: float | None = None,
) -> Array:
    r"""Heights of a Gaussian surface with a self-affine spectrum between two wavelengths.

    .. math:: C(q) \propto \max(q, q_r)^{-2 - 2H}, \qquad q \le q_c

    Parameters
    ----------
    shape, pixel_size, cutoff_wavelength, seed
        As in `gaussian_exponential`.
    rms : float or None
        Standard deviation of the heights [m]; None if `rms_slope` is given.
    hurst : float
        Hurst exponent H, between 0 and 1.
    rolloff_wavelength : float
        Wavelength above which the spectrum is flat [m]; inf for none.
    normalise : {"expected", "sample"}
        Whether `rms` or `rms_slope` is the mean over all seeds or that of this map. The spectrum
        has no scale of its own, hence no "none".
    rms_slope : float, optional
        Instead of `rms`: root of the mean square of the gradient [-].

    Returns
    -------
    ndarray, shape (ny, nx)
        Heights [m], of zero mean.

    Raises
    ------
    DescriptionError
        If not exactly one of `rms` and `rms_slope` is given, or no wave passes the cut-off.

    References
    ----------
    .. [1] Persson, Albohr, Tartaglino, Volokitin and Tosatti, J. Phys.: Condens. Matter 17 (2005)
       R1, for this form of the spectrum.

    Examples
    --------
    >>> h = self_affine((128, 128), (1e-9, 1e-9), None, 0.8, 64e-9, 8e-9, 1, rms_slope=0.1)
    >>> h.shape, bool(1e-10 < h.std() < 1e-9)
    ((128, 128), True)
    """
    if normalise == "none":
        raise DescriptionError("self_affine.normalise", normalise, "be 'expected' or 'sample'")
    which = waves(shape, pixel_size, cutoff_wavelength)
    square = which.qx**2 + which.qy**2
    # Wavenumbers relative to the cut-off, so that no power overflows; arbitrary outside the sum.
    q = np.maximum(
        np.where(which.times > 0.0, np.sqrt(square) * cutoff_wavelength / (2.0 * math.pi), 1.0),
        cutoff_wavelength / rolloff_wavelength,
    )
    power = q ** (-2.0 - 2.0 * hurst)
    if rms is not None and rms_slope is None:
        return add_up(shape, which, power, seed, rms * rms, normalise=normalise)
    if rms is None and rms_slope is not None:
        return add_up(shape, which, power, seed, rms_slope * rms_slope, square, normalise)
    raise DescriptionError("self_affine.rms", rms, "be given, or else rms_slope", unit="m")


def _exponential_psd(which: Waves, correlation_length: float | Pair) -> Array:
    """Spectrum C for a variance of 1 [m2]."""
    ly, lx = (length / _DECADE for length in _pair(correlation_length))
    stretched = 1.0 + (which.qx * lx) ** 2 + (which.qy * ly) ** 2
    return np.asarray(2.0 * math.pi * lx * ly / (stretched * np.sqrt(stretched)))


def _pair(value: float | Pair) -> Pair:
    return value if isinstance(value, tuple) else (value, value)
