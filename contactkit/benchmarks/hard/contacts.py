"""Hard cases of rough contacts: all pixels, hardness, offsets, edges, adhesion."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import brentq

from ...adhesion import maugis_dugdale
from ...contact.press import press
from ...contact.solver.contact_solver import ContactSolver
from ...reference import hertz
from ...roughness.statistics import surface_statistics
from ...scene.materials import Material
from .case import Found

__all__ = [
    "at_hardness",
    "full",
    "gradient",
    "isolated",
    "offset",
    "polonsky_keer",
    "rough",
    "sharp_adhesion",
    "violation",
]

Array = NDArray[np.float64]
N = 64  # pixels a side: the naive methods take seconds there, and minutes on twice as many
TWO = 2.0  # mean compliance of the half-space times wavenumber, in units of 1/E*


def rough(n: int) -> Array:
    """Self-affine heights of a unit window, of the rms slope 0.1, shortest wave of 8 pixels."""
    k = np.hypot(np.fft.fftfreq(n, 1.0 / n)[:, None], np.fft.rfftfreq(n, 1.0 / n))
    amplitude = np.where(k <= n / 8, np.maximum(k, 4.0) ** -1.8, 0.0)
    amplitude[0, 0] = 0.0
    noise = np.fft.rfft2(np.random.default_rng(1).standard_normal((n, n)))
    h = np.fft.irfft2(noise * amplitude, s=(n, n))
    slope = n * math.sqrt(sum(np.mean((np.roll(h, 1, axis) - h) ** 2) for axis in (0, 1)))
    return np.asarray(0.1 * h / slope)


def half_space(shape: tuple[int, int], pixel: tuple[float, float]) -> Array:
    """Symbol of a half-space of E* = 1 on a window that repeats."""
    ky = np.fft.fftfreq(shape[0], pixel[0])[:, None]
    q = 2.0 * np.pi * np.hypot(ky, np.fft.rfftfreq(shape[1], pixel[1]))
    return np.asarray(np.divide(TWO, q, out=np.zeros_like(q), where=q > 0.0))


def displaced(pressure: Array, symbol: Array) -> Array:
    """Displacement under a pressure, by numpy's transform."""
    found: Array = np.fft.irfft2(np.fft.rfft2(pressure) * symbol, s=pressure.shape)
    return found


def violation(
    pressure: Array, heights: Array, symbol: Array, mean: float, bound: float = math.inf
) -> float:
    """Largest violation of the conditions of contact, over the rms height.

    A gap under pressure, an overlap out of contact, a gap under the hardness; or the error of the
    load, over the load.
    """
    gap = displaced(pressure, symbol) - heights
    is_free = (pressure > 0.0) & (pressure < bound * (1.0 - 1e-12))
    gap -= gap[is_free].mean() if is_free.any() else gap[pressure > 0.0].max()
    wrong = np.where(is_free, np.abs(gap), np.where(pressure > 0.0, gap, -gap))
    load = abs(pressure.mean() / mean - 1.0)
    return float(max(wrong.max() / heights.std(), load))


def polonsky_keer(
    heights: Array, symbol: Array, mean: float, most: int, rtol: float = 1e-8
) -> tuple[Array, int]:
    """Conjugate gradients with projection to positive pressures; pressure and convolutions.

    I. A. Polonsky and L. M. Keer, Wear 231 (1999) 206.
    """
    p = np.full_like(heights, mean)
    step, past, factor = np.zeros_like(p), 1.0, 0.0
    for i in range(1, most // 2 + 1):
        touching = p > 0.0
        gap = displaced(p, symbol) - heights
        gap -= gap[touching].mean()
        now = float(np.square(gap[touching]).sum())
        if violation(p, heights, symbol, mean) < rtol:
            return p, 2 * i - 1
        step = np.where(touching, gap + factor * now / past * step, 0.0)
        past = now
        curve = displaced(step, symbol)
        curve -= curve[touching].mean()
        length = float((gap * step)[touching].sum() / (curve * step)[touching].sum())
        p = np.maximum(np.where(touching, p - length * step, p), 0.0)
        overlapping = (p == 0.0) & (gap < 0.0)
        p[overlapping] -= length * gap[overlapping]
        factor = 0.0 if overlapping.any() else 1.0
        p *= mean / p.mean()
    return p, most


def gradient(heights: Array, symbol: Array, mean: float, most: int) -> Array:
    """Projected gradient with the longest step that is stable for every wave."""
    p, length = np.full_like(heights, mean), 1.0 / symbol.max()
    for _ in range(most):
        gap = displaced(p, symbol) - heights
        p = np.maximum(p - length * (gap - gap[p > 0.0].mean()), 0.0)
        p *= mean / p.mean()
    return p


def solver() -> ContactSolver:
    """The solver of a half-space on the map of these cases."""
    return ContactSolver((N, N), (1.0 / N, 1.0 / N), half_space, periodic=True, fast=False)


def full() -> Found:
    """A load under which every pixel touches: the gap is closed."""
    heights, mean = rough(N), 0.5
    symbol = half_space((N, N), (1.0 / N, 1.0 / N))
    inverse = np.divide(1.0, symbol, out=np.zeros_like(symbol), where=symbol > 0.0)
    exact = mean + np.fft.irfft2(np.fft.rfft2(heights) * inverse, s=heights.shape)
    # A penalty, p = overlap times stiffness: closed form, as all pixels overlap.
    soft = 1.0 / (symbol + 0.1 * symbol[symbol > 0.0].min())
    soft[0, 0] = 0.0
    naive = mean + np.fft.irfft2(np.fft.rfft2(heights) * soft, s=heights.shape)
    ours = solver().solve(heights, mean_pressure=mean).pressure
    size = np.linalg.norm(exact - mean)
    return Found(
        float(np.linalg.norm(naive - exact) / size),
        "surfaces that overlap by a tenth of what the shortest wave gives way",
        float(np.linalg.norm(ours - exact) / size),
        "closed everywhere",
    )


def at_hardness() -> Found:
    """99.99 % of the load that the hardness carries."""
    heights, bound = rough(N), 0.02
    mean, symbol = 0.9999 * bound, half_space((N, N), (1.0 / N, 1.0 / N))
    elastic = solver().solve(heights, mean_pressure=mean).pressure
    low, high = 0.0, 1e12
    for _ in range(200):  # the factor at which the truncated elastic pressure carries the load
        factor = 0.5 * (low + high)
        low, high = (factor, high) if _cut(elastic, factor, bound) < mean else (low, factor)
    naive = np.minimum(high * elastic, bound)
    ours = solver().solve(heights, mean_pressure=mean, bound=bound).pressure
    return Found(
        violation(naive, heights, symbol, mean, bound),
        f"{np.mean(naive >= bound):.2%} of the pixels at the hardness",
        violation(ours, heights, symbol, mean, bound),
        f"{np.mean(ours >= bound):.2%} of the pixels at the hardness",
    )


def _cut(elastic: Array, factor: float, bound: float) -> float:
    return float(np.minimum(factor * elastic, bound).mean())


def offset() -> Found:
    """Nanometres of roughness measured from a datum a metre away."""
    quantum = 2.0**-52  # of numbers next to one: the heights are exact there
    heights = 1.0 + quantum * np.round(1e-9 * rough(N) / rough(N).std() / quantum)
    exact = float((heights - 1.0).std())
    with np.errstate(invalid="ignore"):
        naive = math.sqrt(abs(float(np.mean(heights**2) - np.mean(heights) ** 2)))
    ours = surface_statistics(heights, (1e-8, 1e-8), periodic=True).rms
    return Found(
        abs(naive / exact - 1.0),
        f"rms of {naive * 1e9:.3g} nm",
        abs(ours / exact - 1.0),
        f"rms of {ours * 1e9:.3g} nm",
    )


def isolated() -> Found:
    """A single sphere in a window a fourth wider than its contact."""
    contact = hertz.sphere(1.0, 1e-3, 1e9)
    width, n = 2.5 * contact.contact_radius, 80
    x = (np.arange(n) + 0.5 - n / 2) * width / n
    ball = -(x**2 + x[:, None] ** 2) / 2e-3
    solid = Material(young_modulus=1e9, poisson_ratio=0.0)
    mean, size = 1.0 / width**2, (width / n, width / n)
    naive, ours = (
        press(ball, size, solid, mean_pressure=mean, periodic=edges).max_pressure
        / contact.peak_pressure
        for edges in (True, False)
    )
    return Found(
        abs(naive - 1.0),
        f"peak pressure of {naive:.3f} times Hertz's",
        abs(ours - 1.0),
        f"peak pressure of {ours:.5f} times Hertz's, 32 pixels to the radius",
    )


def textbook_maugis(a: float, transition: float) -> float:
    """Load of a contact of radius a by Maugis' equations as they are printed, in m = c/a."""

    def ends(m: float) -> float:
        root, angle = math.sqrt(m * m - 1.0), math.acos(1.0 / m)
        return (
            0.5 * transition * a * a * (root + (m * m - 2.0) * angle)
            + 4.0 / 3.0 * transition**2 * a * (root * angle - m + 1.0)
            - 1.0
        )

    m = float(brentq(ends, 1.0, 1e9, xtol=1e-300, rtol=1e-15, maxiter=1000))
    root, angle = math.sqrt(m * m - 1.0), math.acos(1.0 / m)
    return a**3 - transition * a * a * (root + m * m * angle)


def sharp_adhesion() -> Found:
    """Loads of adhesive contacts of four radii at a transition parameter of a million."""
    transition, radii = 1e6, (0.3, 1.0, 2.0, 4.0)
    exact = [a**3 - math.sqrt(6.0 * a**3) for a in radii]  # JKR, the limit
    naive = [textbook_maugis(a, transition) for a in radii]
    ours = [maugis_dugdale.at_radius(a, transition).load for a in radii]
    where = "loads of four contact radii"
    return Found(_worst(naive, exact), where, _worst(ours, exact), where)


def _worst(found: list[float], exact: list[float]) -> float:
    return max(abs(one / right - 1.0) for one, right in zip(found, exact, strict=True))
