"""Layers on a half-space under a periodic load: one linear system for each wavenumber.

Nothing here is used by contactkit, nor uses it. Per wavenumber q, in the plane of q and z, a body
has displacements grad(f) and z grad(f) - (3 - 4 nu) f e_z with f = exp(-q z) and, in a layer,
exp(q (z - h)); across that plane f e_n. Continuity of displacement and traction and the load on the
surface are the equations (Navier; Barber, Elasticity, 4th ed., ch. 22 for the potentials).
"""

from __future__ import annotations

from itertools import product
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

__all__ = ["Layers", "compliance", "maxima", "of_waves", "stress"]

Array = NDArray[Any]


class Layers(NamedTuple):
    """Young's moduli [Pa] from the top, Poisson's ratio of all, thicknesses of the layers [m]."""

    moduli: tuple[float, ...]
    poisson: float
    thicknesses: tuple[float, ...]


def _waves(pixels: int, width: float) -> tuple[Array, Array, Array]:
    """Wavenumbers of a periodic grid, along x and y, and their lengths."""
    q = 2.0 * np.pi * np.fft.fftfreq(pixels, width / pixels)
    return q[None, :], q[:, None], np.hypot(q[None, :], q[:, None])


def _plane(q: Array, z: float, h: float, G: float, nu: float, is_layer: bool) -> Array:
    """Columns (waves, 6, 4 or 2) of the plane: u_t, u_z, then s_zz, s_tz, s_tt, s_nn over q."""
    columns = []
    for sign in (-1.0, 1.0) if is_layer else (-1.0,):
        f = np.exp(-q * z) if sign < 0.0 else np.exp(q * (z - h))
        d, zq = sign * f, z * q  # derivative over q
        zero = np.zeros_like(f)
        first = (1j * f, d, 2 * G * f, 2j * G * d, -2 * G * f, zero)
        second = (
            1j * zq * f,
            zq * d - (3 - 4 * nu) * f,
            2 * G * (zq * f - 2 * (1 - nu) * d),
            2j * G * (zq * d - (1 - 2 * nu) * f),
            2 * G * (-zq * f - 2 * nu * d),
            -4 * G * nu * d,
        )
        columns += [np.stack(first, -1), np.stack(second, -1)]
    return np.stack(columns, -1)


def _across(q: Array, z: float, h: float, G: float, is_layer: bool) -> Array:
    """Columns (waves, 3, 2 or 1) across the plane: u_n, then s_nz, s_tn over q."""
    columns = []
    for sign in (-1.0, 1.0) if is_layer else (-1.0,):
        f = np.exp(-q * z) if sign < 0.0 else np.exp(q * (z - h))
        columns.append(np.stack((f + 0j, G * sign * f, 1j * G * f), -1))
    return np.stack(columns, -1)


def _coefficients(q: Array, solid: Layers, is_across: bool) -> list[Array]:
    """Coefficients (waves, columns, loads) of each body for unit loads over q on the surface.

    In the plane the loads are s_zz and s_tz, across it s_nz.
    """
    shear = [e / (2.0 * (1.0 + solid.poisson)) for e in solid.moduli]
    last = len(shear) - 1

    def columns(k: int, z: float) -> Array:
        h = solid.thicknesses[k] if k < last else 0.0
        if is_across:
            return _across(q, z, h, shear[k], k < last)
        return _plane(q, z, h, shear[k], solid.poisson, k < last)

    moved, pulled = (1, 1) if is_across else (2, 2)
    of_layer = 2 * pulled
    n = of_layer * last + pulled
    matrix = np.zeros((q.size, n, n), complex)
    right = np.zeros((q.size, n, pulled), complex)
    both = slice(0, moved + pulled)
    matrix[:, :pulled, : of_layer if last else pulled] = columns(0, 0.0)[:, moved : moved + pulled]
    right[:, :pulled] = np.eye(pulled)
    for k in range(last):
        rows = slice(pulled + of_layer * k, pulled + of_layer * (k + 1))
        here = slice(of_layer * k, of_layer * (k + 1))
        width = of_layer if k + 1 < last else pulled
        below = slice(of_layer * (k + 1), of_layer * (k + 1) + width)
        matrix[:, rows, here] = columns(k, solid.thicknesses[k])[:, both]
        matrix[:, rows, below] = -columns(k + 1, 0.0)[:, both]
    found = np.linalg.solve(matrix, right)
    return [found[:, of_layer * k : of_layer * (k + 1)] for k in range(last + 1)]


def _scaled(solid: Layers) -> Layers:
    """Moduli over that of the substrate, so that displacement and stress have one size."""
    return solid._replace(moduli=tuple(e / solid.moduli[-1] for e in solid.moduli))


def compliance(pixels: int, width: float, solid: Layers) -> Array:
    """Displacement into the body over pressure [m/Pa] of each wave of the grid; zero at q = 0."""
    _, _, length = _waves(pixels, width)
    q, place = np.unique(length.round(3), return_inverse=True)
    found: Array = np.append(0.0, of_waves(q[1:], solid))[place].reshape(length.shape)
    return found


def of_waves(q: Array, solid: Layers) -> Array:
    """Displacement into the body over pressure [m/Pa] of waves of wavenumber q [1/m]."""
    one = _scaled(solid)
    h = (*one.thicknesses, 0.0)[0]
    first = _plane(q, 0.0, h, _shear(one, 0), one.poisson, len(one.moduli) > 1)
    c = _coefficients(q, one, False)[0]
    moved = np.einsum("wk,wk->w", first[:, 1], c[:, :, 0]).real
    found: Array = -moved / (q * solid.moduli[-1])
    return found


def _shear(solid: Layers, k: int) -> float:
    """Shear modulus of a body [the unit of its Young's modulus]."""
    return solid.moduli[k] / (2.0 * (1.0 + solid.poisson))


def _transfer(q: Array, solid: Layers, depth: float, side: float) -> tuple[Array, Array]:
    """Stress at a depth for unit loads on top: zz, tz, tt, nn for both loads; nz, tn for one."""
    one, last = _scaled(solid), len(solid.moduli) - 1
    tops = np.cumsum((0.0, *one.thicknesses))
    at = depth + side * 1e-6 * tops[-1]
    k = max(int(np.searchsorted(tops, at, side="right")) - 1, 0)
    z, h, shear = depth - tops[k], (*one.thicknesses, 0.0)[k], _shear(one, k)
    plane = _plane(q, z, h, shear, one.poisson, k < last)[:, 2:]
    across = _across(q, z, h, shear, k < last)[:, 1:]
    return (
        plane @ _coefficients(q, one, False)[k],
        (across @ _coefficients(q, one, True)[k])[..., 0],
    )


def _read(phase: Array) -> Array:
    """Transform of the cubic spline through pixels, over the phase q dx (Unser 1999)."""
    found: Array = np.sinc(phase / (2.0 * np.pi)) ** 4 * 3.0 / (2.0 + np.cos(phase))
    return found


def stress(
    pressure: Array, width: float, solid: Layers, depth: float, friction: float, side: float = 1.0
) -> Array:
    """Stress xx, yy, zz, xy, yz, xz (6, n, n) [Pa] at a depth [m] under p and s_xz = -friction p.

    The pressure is the cubic spline through its pixels: waves shorter than two pixels are summed up
    to three times the highest wavenumber of the grid. The mean of the load strains the body along z
    only. On an interface `side` is 1 for the body below, -1 above.
    """
    n = len(pressure)
    qx, qy, _ = _waves(n, width)
    top = 2.0 * np.pi * n / width
    known = np.geomspace(1.9 * np.pi / width, 2.2 * top, 2000)
    of_plane, of_across = _transfer(known, solid, depth, side)
    mean = float(pressure.mean())
    load = np.fft.fft2(pressure - mean)
    sums = np.zeros((6, n, n), complex)
    for fold_x, fold_y in product((-1.0, 0.0, 1.0), repeat=2):
        kx, ky = qx + fold_x * top, qy + fold_y * top
        length = np.hypot(kx, ky)
        length[length == 0.0] = 1.0
        c, s = kx / length, ky / length
        weight = _read(kx * width / n) * _read(ky * width / n)

        def at(values: Array, length: Array = length) -> Array:
            found: Array = np.interp(length, known, values.real)
            if np.abs(values.imag).max() > 0.0:
                found = found + 1j * np.interp(length, known, values.imag)
            return found

        zz, tz, tt, nn = (
            -friction * c * at(of_plane[:, i, 1]) - at(of_plane[:, i, 0]) for i in range(4)
        )
        nz, tn = (friction * s * at(of_across[:, i]) for i in range(2))
        sums += weight * np.array(
            (
                c * c * tt + s * s * nn - 2 * c * s * tn,
                s * s * tt + c * c * nn + 2 * c * s * tn,
                zz,
                c * s * (tt - nn) + (c * c - s * s) * tn,
                s * tz + c * nz,
                c * tz - s * nz,
            )
        )
    aside = solid.poisson / (1.0 - solid.poisson)
    even = -mean * np.array([aside, aside, 1.0, 0.0, 0.0, friction])
    return np.array([np.fft.ifft2(part * load).real for part in sums]) + even[:, None, None]


def maxima(field: Array) -> tuple[float, float, float]:
    """Largest stress of von Mises, principal stress and amount of s_xz [Pa] of a plane."""
    xx, yy, zz, xy, yz, xz = field
    mises = np.sqrt(
        0.5 * ((xx - yy) ** 2 + (yy - zz) ** 2 + (zz - xx) ** 2) + 3.0 * (xy**2 + yz**2 + xz**2)
    )
    at = np.argsort(xx + np.hypot(xy, xz), axis=None)[-4000:]  # candidates: the rest is compressed
    at = np.union1d(at, np.argsort(yy + np.hypot(xy, yz), axis=None)[-4000:])
    tensor = np.array([[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]]).reshape(3, 3, -1)[..., at]
    tension = np.linalg.eigvalsh(np.moveaxis(tensor, -1, 0))[:, -1].max()
    return float(mises.max()), float(tension), float(np.abs(xz).max())
