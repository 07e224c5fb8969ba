r"""Random rough surfaces with a prescribed spectrum: exponential autocorrelation, self-affine.

Heights [m] of the rough body are positive towards the other body: peaks up. Arrays are
``[y, x]``, ``shape = (ny, nx)``, ``pixel_size = (dy, dx)``; pixel (i, j) lies at
:math:`y = i\,dy,\ x = j\,dx`, so that a grid with half the pixel holds every point of the coarse
one. The window is :math:`L_y \times L_x = n_y dy \times n_x dx`.

A random surface is the sum of the waves of the window, hence periodic, with zero mean:

.. math:: \langle |A_q|^2 \rangle = \frac{C(q)}{L_x L_y}, \qquad
          \sigma^2 = \frac{1}{4\pi^2} \iint C \, dq_x dq_y

The complex random number of a wave depends only on the seed and its wavevector in waves per window,
(k_y, k_x), not on the grid: the same seed on two grids of one window has the same long waves, and
grids that resolve the short-wave cut-off sample the same surface. Each tile of wavevectors has its
own stream, so that few numbers beyond the needed ones are drawn for any shape.

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
from typing import Literal, NamedTuple

import numpy as np
from numpy.typing import NDArray
from scipy import fft

from ..errors import DescriptionError

__all__ = [
    "Normalise",
    "SelfAffineSpectrum",
    "VarianceBudget",
    "Waves",
    "add_up",
    "gaussian_exponential",
    "resolved_variance",
    "self_affine",
    "waves",
]

Array = NDArray[np.float64]
Shape = tuple[int, int]
Pair = tuple[float, float]
Normalise = Literal["expected", "sample", "none"]

_DECADE = 2.3  # Eq. (2.42): exp(-2.3) is a tenth
# Waves along each side of a tile, each with a seed of its own, so that a wave has the same phase
# whatever the window and cut-off. Seeded surfaces depend on it. 13 ms for 513 x 257 waves, as with
# 128; 8 take ten times as long (a generator for each), 256 draw many for nothing.
_TILE = 64
_ON_THE_EDGE = 1.0 + 1e-9  # a wave of the cut-off wavelength is kept, independent of round-off


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


class SelfAffineSpectrum(NamedTuple):
    """Self-affine spectrum between two wavelengths.

    `hurst` is the Hurst exponent H, between 0 and 1; above `rolloff_wavelength` [m] the spectrum
    is flat (inf: nowhere), waves shorter than `cutoff_wavelength` [m] are excluded.
    """

    hurst: float
    rolloff_wavelength: float
    cutoff_wavelength: float


def self_affine(
    shape: Shape,
    pixel_size: Pair,
    rms: float | None,
    spectrum: SelfAffineSpectrum,
    seed: int,
    normalise: Normalise = "expected",
    *,
    rms_slope: float | None = None,
) -> Array:
    r"""Heights of a Gaussian surface with a self-affine spectrum between two wavelengths.

    .. math:: C(q) \propto \max(q, q_r)^{-2 - 2H}, \qquad q \le q_c

    Parameters
    ----------
    shape, pixel_size, seed
        As in `gaussian_exponential`.
    rms : float or None
        Standard deviation of the heights [m]; None if `rms_slope` is given.
    spectrum : SelfAffineSpectrum
        Its exponent and wavelengths.
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
    >>> spectrum = SelfAffineSpectrum(0.8, 64e-9, 8e-9)
    >>> h = self_affine((128, 128), (1e-9, 1e-9), None, spectrum, 1, rms_slope=0.1)
    >>> h.shape, bool(1e-10 < h.std() < 1e-9)
    ((128, 128), True)
    """
    if normalise == "none":
        raise DescriptionError("self_affine.normalise", normalise, "be 'expected' or 'sample'")
    shortest = spectrum.cutoff_wavelength
    which = waves(shape, pixel_size, shortest)
    square = which.qx**2 + which.qy**2
    # Wavenumbers relative to the cut-off, so that no power overflows; arbitrary outside the sum.
    q = np.maximum(
        np.where(which.times > 0.0, np.sqrt(square) * shortest / (2.0 * math.pi), 1.0),
        shortest / spectrum.rolloff_wavelength,
    )
    power = q ** (-2.0 - 2.0 * spectrum.hurst)
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


# Waves of a window --------------------------------------------------------------------------


class Waves(NamedTuple):
    """Waves of a window with k_x >= 0 that a grid resolves and a cut-off passes.

    Arrays are (2 m_y + 1, m_x + 1) or broadcast to it, rows k_y = -m_y ... m_y. The mean and the
    waves at the Nyquist wavenumber, of which a grid resolves only one phase, are excluded.
    """

    qy: Array
    """Wavenumbers along y [rad/m], (2 m_y + 1, 1)."""
    qx: Array
    """Wavenumbers along x [rad/m], (1, m_x + 1)."""
    times: Array
    """Multiplicity of a wave in the sum: 2 with its conjugate, 1 for k_x = 0, 0 if excluded."""

    def total(self, power: Array) -> float:
        """Sum of a power over the whole plane of wavevectors."""
        return float(np.sum(self.times * power))


def waves(
    shape: tuple[int, int], pixel_size: tuple[float, float], cutoff_wavelength: float
) -> Waves:
    """Wavevectors of the window that the grid resolves and the cut-off passes.

    Parameters
    ----------
    shape, pixel_size
        Pixels (ny, nx) and their size (dy, dx) [m].
    cutoff_wavelength : float
        Shortest wavelength [m].

    Raises
    ------
    DescriptionError
        If there is none.

    Examples
    --------
    >>> waves((4, 8), (1.0, 1.0), 2.5).times
    array([[1., 2., 2., 0.],
           [0., 2., 2., 2.],
           [1., 2., 2., 0.]])
    """
    window = [n * d for n, d in zip(shape, pixel_size, strict=True)]
    most_y, most_x = (
        min((n - 1) // 2, math.floor(size / cutoff_wavelength * _ON_THE_EDGE))
        for n, size in zip(shape, window, strict=True)
    )
    ky = np.arange(-most_y, most_y + 1, dtype=np.float64)[:, None]
    kx = np.arange(most_x + 1, dtype=np.float64)[None, :]
    square = (ky / window[0]) ** 2 + (kx / window[1]) ** 2
    kept = (square * cutoff_wavelength**2 <= _ON_THE_EDGE**2) & (square > 0.0)
    if not kept.any():
        raise DescriptionError(
            "cutoff_wavelength",
            cutoff_wavelength,
            f"leave waves that fit into the window of {window[0]:g} m by {window[1]:g} m",
            unit="m",
        )
    times = np.where(kept, np.where(kx > 0, 2.0, 1.0), 0.0)
    turn = 2.0 * math.pi
    return Waves(ky * (turn / window[0]), kx * (turn / window[1]), times)


def add_up(
    shape: tuple[int, int],
    which: Waves,
    power: Array,
    seed: int,
    target: float | None = None,
    weight: Array | float = 1.0,
    normalise: Normalise = "expected",
) -> Array:
    """Heights whose waves have mean squares `power`, rescaled to a target if given.

    Parameters
    ----------
    shape : (int, int)
        Pixels (ny, nx) of the grid that `which` was made for.
    which : Waves
        The waves.
    power : ndarray
        Mean square of the amplitude of each wave, any unit if it is rescaled, else [m2].
    seed : int
        Seed, zero or positive.
    target : float, optional
        Target of the sum of `weight` times the squares of all amplitudes.
    weight : ndarray or float
        1 for the variance of the heights, the square of the wavenumber for that of the slope.
    normalise : {"expected", "sample", "none"}
        Whether the mean over all seeds or this map meets the target, or neither.
    """
    amplitude = np.where(which.times > 0.0, np.sqrt(power), 0.0) * _unit_waves(which, seed)
    if normalise != "none" and target is not None:
        mean = power if normalise == "expected" else np.abs(amplitude) ** 2
        amplitude *= math.sqrt(target / which.total(weight * mean))
    ny, nx = shape
    most_y, most_x = which.qy.shape[0] // 2, which.qx.shape[1] - 1
    spectrum = np.zeros((ny, nx // 2 + 1), dtype=np.complex128)
    spectrum[: most_y + 1, : most_x + 1] = amplitude[most_y:]
    if most_y:
        spectrum[-most_y:, : most_x + 1] = amplitude[:most_y]
    heights: Array = fft.irfft2(spectrum, s=shape, norm="forward", overwrite_x=True)
    return heights


def _unit_waves(which: Waves, seed: int) -> NDArray[np.complex128]:
    """Complex normal numbers of mean square 1, those at k_x = 0 conjugate in pairs."""
    rows, columns = which.qy.shape[0], which.qx.shape[1]
    most_y = rows // 2
    unit = np.empty((rows, columns), dtype=np.complex128)
    for first_y in range(-most_y - (-most_y) % _TILE, most_y + 1, _TILE):
        low, high = max(first_y, -most_y), min(first_y + _TILE, most_y + 1)
        for first_x in range(0, columns, _TILE):
            tile = _tile(seed, first_y // _TILE, first_x // _TILE)
            part = unit[low + most_y : high + most_y, first_x : first_x + _TILE]
            part[...] = tile[low - first_y : high - first_y, : part.shape[1]]
    unit *= math.sqrt(0.5)
    unit[:most_y, 0] = unit[:most_y:-1, 0].conj()
    return unit


def _tile(seed: int, row: int, column: int) -> NDArray[np.complex128]:
    # A seed sequence takes no negative numbers: rows -1, 0, -2, 1 ... become 1, 0, 3, 2 ...
    sequence = np.random.SeedSequence([seed, 2 * row if row >= 0 else -2 * row - 1, column])
    stream = np.random.Generator(np.random.PCG64(sequence))
    tile: NDArray[np.complex128] = stream.standard_normal((_TILE, 2 * _TILE)).view(np.complex128)
    return tile
