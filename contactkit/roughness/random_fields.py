r"""Periodic Gaussian random fields from a spectrum: sums of waves with seeded random amplitudes.

.. math:: h(x, y) = \sum_q A_q e^{i (q_x x + q_y y)}, \qquad \langle |A_q|^2 \rangle = P(q)

Arrays are ``[y, x]``; pixel (i, j) lies at :math:`y = i\,dy,\ x = j\,dx`. The complex random number
of a wave depends only on the seed and its wavevector in waves per window, (k_y, k_x), not on the
grid. Each tile of wavevectors has its own stream, so that few numbers beyond the needed ones are
drawn for any shape.
"""

from __future__ import annotations

import math
from typing import Literal, NamedTuple

import numpy as np
from numpy.typing import NDArray
from scipy import fft

from ..errors import DescriptionError

__all__ = ["Normalise", "Waves", "add_up", "waves"]

Array = NDArray[np.float64]
Normalise = Literal["expected", "sample", "none"]

_TILE = 64  # waves along each side of a tile
_ON_THE_EDGE = 1.0 + 1e-9  # a wave of the cut-off wavelength is kept, independent of round-off


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
