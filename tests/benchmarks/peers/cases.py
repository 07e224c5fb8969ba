"""Surfaces, loads and the measure of an answer, alike for every solver of the contact benchmark.

Needs numpy alone, because it is imported by the interpreter of every peer. Lengths are in units of
the window, pressures in units of the contact modulus.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

SURFACES = ("selfaffine", "expacf")
BOUNDARIES = ("periodic", "free")
TARGET = 1e-8  # largest violation over the rms roughness that an answer may have
START, STEP = 1e-8, 0.3  # tolerance a solver is asked first, and how it is lowered
RMS_SLOPE = 0.1
# Mean pressure over modulus and rms slope for about so many per cent of contact.
LOADS = {
    "selfaffine": {1: 0.0040, 5: 0.0225, 20: 0.105},
    "expacf": {1: 0.0029, 5: 0.0155, 20: 0.072},
}
BALL_RADIUS, HERTZ_RADIUS = 10.0, {1: 0.15, 5: 0.26, 20: 0.41}  # under a free map


class Case(NamedTuple):
    """A rough rigid body (peaks up), its mean pressure, and the length that errors refer to."""

    heights: np.ndarray
    load: float
    periodic: bool
    scale: float


def rough(surface, n, seed=1):
    """Heights of rms slope `RMS_SLOPE`.

    ``selfaffine``: Hurst 0.8, flat below 4 waves over the window, nothing shorter than 8 pixels.
    ``expacf``: correlation exp(-2.3 r / b), b a fortieth of the window, rough down to the pixel.
    """
    k = np.hypot(np.fft.fftfreq(n, 1.0 / n)[:, None], np.fft.rfftfreq(n, 1.0 / n))
    if surface == "selfaffine":
        amplitude = np.where(k <= n / 8.0, (np.maximum(k, 4.0) / 4.0) ** -1.8, 0.0)
    else:
        amplitude = (1.0 + (2.0 * np.pi * k / (40.0 * 2.3)) ** 2) ** -0.75
    amplitude[0, 0] = 0.0
    amplitude[:, -1] = amplitude[n // 2] = 0.0  # no slope is defined at the shortest waves
    noise = np.fft.rfft2(np.random.default_rng(seed).standard_normal((n, n)))
    spectrum = amplitude * noise
    power = np.abs(spectrum) ** 2
    power[:, 1:] *= 2.0  # the other half of the spectrum
    slope = 2.0 * np.pi * np.sqrt(np.sum(k**2 * power)) / n**2
    return np.fft.irfft2(spectrum, s=(n, n)) * (RMS_SLOPE / slope)


def case(surface, n, boundary, area, seed=1):
    """Heights and load for about `area` per cent of contact; a free map also bears a ball."""
    heights = rough(surface, n, seed)
    scale = float(heights.std())
    if boundary == "periodic":
        return Case(heights, LOADS[surface][area] * RMS_SLOPE, True, scale)
    x = (np.arange(n) + 0.5) / n - 0.5
    ball = -(x[:, None] ** 2 + x**2) / (2.0 * BALL_RADIUS)
    return Case(heights + ball, 4.0 * HERTZ_RADIUS[area] ** 3 / (3.0 * BALL_RADIUS), False, scale)


def half_space(shape, pixel_size):
    """Periodic symbol of a half-space of unit modulus, zero for the mean."""
    qy = 2.0 * np.pi * np.fft.fftfreq(shape[0], pixel_size[0])[:, None]
    q = np.hypot(qy, 2.0 * np.pi * np.fft.rfftfreq(shape[1], pixel_size[1]))
    return np.divide(2.0, q, out=np.zeros_like(q), where=q > 0.0)


def free_half_space(shape, pixel_size):
    """Symbol of the doubled map: transform of Love's uniformly loaded rectangle."""
    (ny, nx), (dy, dx) = shape, pixel_size
    y, x = ((np.arange(n + 1) - 0.5) * d for n, d in ((ny, dy), (nx, dx)))
    y = y[:, None]
    corner = x * np.arcsinh(y / np.abs(x)) + y * np.arcsinh(x / np.abs(y))
    one = np.diff(np.diff(corner, axis=0), axis=1) / np.pi
    image = np.zeros((2 * ny, 2 * nx))
    for rows, source in ((slice(0, ny), one), (slice(ny + 1, None), one[:0:-1])):
        image[rows, :nx] = source
        image[rows, nx + 1 :] = source[:, :0:-1]
    return np.ascontiguousarray(np.fft.rfft2(image).real)


def symbol_maker(periodic):
    """The half-space as a maker of symbols."""
    return half_space if periodic else free_half_space


def violation(pressure, given, symbol=None, cap=np.inf):
    """Largest violation of a contact condition over the rms roughness, and the error of the load.

    Computed from the pressure alone, by an operator that no solver had a hand in; `symbol`
    replaces that of the half-space.
    """
    p = np.asarray(pressure, dtype=np.float64)
    n = p.shape[0]
    size = (n, n) if given.periodic else (2 * n, 2 * n)
    if symbol is None:
        symbol = symbol_maker(given.periodic)((n, n), (1.0 / n, 1.0 / n))
    gap = np.fft.irfft2(np.fft.rfft2(p, s=size) * symbol, s=size)[:n, :n] - given.heights
    between = (p > 0.0) & (p < cap)
    gap -= np.sum(p[between] * gap[between]) / np.sum(p[between])
    worst = np.abs(gap[between]).max()
    worst = max(worst, -gap[p <= 0.0].min(initial=0.0), gap[p >= cap].max(initial=0.0))
    wrong = max(abs(p.mean() / given.load - 1.0), -float(p.min()) / float(p.max()))
    return float(worst / given.scale), float(wrong)
