r"""Normal compliance of layers that are transversely isotropic about the normal.

Conventions as in `layered`; t counts upward from the bottom of a layer, in units of 1/alpha.
With the constants of `transverse_isotropy` the displacements and tractions of one wavenumber obey

.. math:: U' = W - a T, \quad W' = -r U - b S, \quad T' = -\bar E U + r S, \quad S' = -T

and the compliance ``(U, W) = -(P, Q; Q, R)/D (T, S)``, with ``Z/D`` its determinant, obeys the
*linear* system of their minors,

.. math:: D' = \bar E P, \quad P' = a D + 2 Q, \quad Q' = R - r P, \quad
          R' = b D - 2 r Q + \bar E Z, \quad Z' = b P + a R

in which the sum and the difference of P and :math:`R/\rho` decouple: their rates are
:math:`\sigma = s_1 + s_2` and :math:`\delta = s_1 - s_2`. Both squares are real whether the roots
are real, equal or conjugate, so that one real form serves all solids, isotropic ones included.

===========  =====================================================================================
symbol       quantity
===========  =====================================================================================
E, r, b, a   in_plane [Pa], ratio, axial and shear [1/Pa] of `PlaneConstants`
D ... Z      minors of the two solutions that the condition at the bottom leaves
rho          s1 s2
sum_, dif2   sigma, and the square of delta
c, s, k      half sums of cosh(q t), sinh(q t)/q and (cosh(q t) - 1)/q^2 over q = sigma and delta,
             times exp(-sigma t)
cd, sd, kd   their half differences
===========  =====================================================================================
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ..errors import DescriptionError
from .layer_recursion import COSH, SERIES_BELOW, SINH, THICKEST
from .layer_stack import BASES, Base
from .layered import blocks
from .transverse_isotropy import PlaneConstants, Roots, roots_of

__all__ = ["TransverseLayers", "normal_compliance"]

Array = NDArray[np.float64]
Minors = tuple[Array, Array, Array, Array, Array]


class TransverseLayers(NamedTuple):
    """Materials of a layered solid, the top layer first, the substrate last.

    Constants, (n_layers + 1,), and thicknesses [m], (n_layers,). On a rigid `base` there is no
    substrate: both are (n_layers,). Isotropic materials have theirs by `isotropic_constants`.
    """

    solids: tuple[PlaneConstants, ...]
    thickness: tuple[float, ...] = ()
    base: Base | None = None


class _Waves(NamedTuple):
    """Functions of the table, and exp(-sigma t)."""

    one: Array
    c: Array
    cd: Array
    s: Array
    sd: Array
    k: Array
    kd: Array


def _waves(roots: Roots, t: Array) -> _Waves:
    sum_, dif2 = roots.sum, roots.difference2
    t = np.minimum(t, THICKEST / roots.slowest)
    one = np.exp(-sum_ * t)
    fade = -np.expm1(-sum_ * t)
    c, s, k = 0.5 * (1.0 + one * one), 0.5 * fade * (1.0 + one) / sum_, 0.5 * (fade / sum_) ** 2
    if dif2 > 0.0:
        dif = math.sqrt(dif2)
        lag = np.exp(-2.0 * roots.slowest * t)
        less = np.exp(-dif * t)
        drop = -np.expm1(-dif * t)
        c2, s2 = 0.5 * lag * (1.0 + less * less), 0.5 * lag * drop * (1.0 + less) / dif
        k2 = 0.5 * lag * (drop / dif) ** 2
        # Of the product of both roots' sinh: their cosh cancel.
        cd = 0.25 * np.expm1(-(sum_ + dif) * t) * np.expm1(-2.0 * roots.slowest * t)
    else:
        turn = math.sqrt(-dif2) * t
        half = np.sin(0.5 * turn)
        c2, s2 = one * np.cos(turn), one * t * np.sinc(turn / np.pi)
        k2 = 0.5 * one * (t * np.sinc(0.5 * turn / np.pi)) ** 2
        cd = 0.25 * fade * fade + one * half * half
    sd, kd = 0.5 * (s - s2), 0.5 * (k - k2)
    near = max(sum_, math.sqrt(abs(dif2))) * t < SERIES_BELOW
    if near.any():
        small = t[near]
        squares = small * small
        scale = 2.0 * roots.product * one[near] * squares
        plus, minus = sum_ * sum_ * squares, dif2 * squares
        sd[near] = scale * small * _divided(SINH, plus, minus)
        kd[near] = scale * squares * _divided(COSH, plus, minus)
    return _Waves(one, 0.5 * (c + c2), cd, 0.5 * (s + s2), sd, 0.5 * (k + k2), kd)


def _divided(coefficients: Array, plus: Array, minus: Array) -> Array:
    """Divided difference of ``sum c_j w^(j + 1)`` between two values of w."""
    value = np.full_like(plus, coefficients[-1])
    total = value.copy()
    for coefficient in coefficients[-2::-1]:
        value = value * plus + coefficient
        total = total * minus + value
    return total


def _climb(solid: PlaneConstants, t: Array, below: Minors) -> Minors:
    """Minors at the top of a layer, times exp(-sigma t) and over D, from those at its bottom."""
    E, r, b, a = solid
    D, P, Q, R, Z = below
    roots = roots_of(solid)
    rho = roots.product
    one, c, cd, s, sd, k, kd = _waves(roots, t)
    p_rate, r_rate = a * D + 2.0 * Q, b * D - 2.0 * r * Q + E * Z
    p_sum = s * P + k * p_rate + (sd * R + kd * r_rate) / rho
    r_sum = s * R + k * r_rate + (sd * P + kd * p_rate) * rho
    top = one * D + E * p_sum
    return (
        np.ones_like(t),
        (c * P + s * p_rate + (cd * R + sd * r_rate) / rho) / top,
        (one * Q + r_sum - r * p_sum) / top,
        (c * R + s * r_rate + (cd * P + sd * p_rate) * rho) / top,
        (one * Z + b * p_sum + a * r_sum) / top,
    )


def _lowest(layers: TransverseLayers, size: int) -> Minors:
    """Minors on top of a substrate, eigenvector of the rate sigma, or of a base."""
    values = (1.0, 0.0, 0.0, 0.0, 0.0) if layers.base == "bonded" else (0.0, 1.0, 0.0, 0.0, 0.0)
    if layers.base is None:
        solid = layers.solids[-1]
        roots = roots_of(solid)
        along = roots.sum / solid.in_plane
        determinant = (solid.axial + solid.shear * roots.product) / solid.in_plane
        cross = roots.excess / solid.in_plane
        values = 1.0, along, cross, roots.product * along, determinant
    D, P, Q, R, Z = (np.full(size, value) for value in values)
    return D, P, Q, R, Z


def _check(layers: TransverseLayers) -> None:
    solids, h = layers.solids, layers.thickness
    if layers.base not in (None, *BASES):
        raise DescriptionError("layers.base", layers.base, f"be None or one of {', '.join(BASES)}")
    if not solids or len(h) != len(solids) - (layers.base is None):
        raise DescriptionError(
            "layers.thickness",
            h,
            f"be one for each of the {len(solids)} solids, but for the substrate",
            unit="m",
            hint="the substrate comes last and has no thickness; on a rigid base there is none",
        )
    if not all(0.0 < one < math.inf for one in h):
        raise DescriptionError("layers.thickness", h, "be positive and finite", unit="m")
    for one in solids:
        if not (min(one.in_plane, one.shear) > 0.0 <= one.axial and all(map(math.isfinite, one))):
            raise DescriptionError(
                "layers.solids",
                tuple(one),
                "have in_plane [Pa] and shear [1/Pa] positive, axial [1/Pa] not negative",
                hint="plane_constants makes them from engineering constants",
            )


def normal_compliance(wavenumber: ArrayLike, layers: TransverseLayers) -> Array:
    r"""Normal compliance of layers that are transversely isotropic about the normal.

    Parameters
    ----------
    wavenumber : array_like
        alpha > 0, any shape [1/m].
    layers : TransverseLayers
        Bonded to each other, and to a substrate or a rigid base.

    Returns
    -------
    ndarray
        C [m/Pa] in the shape of `wavenumber`: the surface sinks by C times the pressure.

    Raises
    ------
    DescriptionError
        For a wavenumber or thickness that is not positive and finite, constants of no stable
        solid, shapes that do not fit, or a result beyond the range of a double.

    Notes
    -----
    Small strains. Against matrix exponentials of up to 2000 digits, on 7000 random stacks of 1 to 3
    layers with c11 and c33 between 1e-5 and 1e5 and c13^2 up to 1 - 1e-9 of their product, the
    relative error was 3e-14 at most with c44 within a factor of 30 of their mean, 3e-13 within 1e4.
    It grows as the larger root over the smaller. Of isotropic layers it agrees with
    `layered.compliance` within 2e-15. A half-space has ``C = 2/(M alpha)`` with M of
    `indentation_modulus`; long waves on a bonded base meet ``sum h/c33``.

    References
    ----------
    .. [1] H. A. Elliott, Proc. Camb. Phil. Soc. 44 (1948) 522-533: waves in such a solid. The
       recursion of minors is an own formulation.

    Examples
    --------
    Graphite on steel, whose basal planes lie in the surface: long waves feel the steel.

    >>> from .transverse_isotropy import isotropic_constants, plane_strain_modulus
    >>> graphite = PlaneConstants(1.054e12, 0.411, 2.74e-11, 2.2e-10)
    >>> steel = isotropic_constants(210e9, 0.3)
    >>> alpha = np.array([1e2, 1e6, 1e10])
    >>> C = normal_compliance(alpha, TransverseLayers((graphite, steel), (1e-6,)))
    >>> print(np.round(2e-9 / (alpha * C), 1))
    [230.7  59.3  25.2]
    >>> print([round(plane_strain_modulus(one) / 1e9, 1) for one in (steel, graphite)])
    [230.8, 25.2]
    """
    _check(layers)
    alpha = np.asarray(wavenumber, dtype=np.float64)
    is_usable = (alpha > 0.0) & np.isfinite(alpha)
    if not is_usable.all():
        raise DescriptionError(
            "normal_compliance.wavenumber",
            float(alpha[~is_usable].flat[0]),
            "be positive and finite",
            unit="1/m",
        )
    flat, h = alpha.ravel(), layers.thickness
    out = np.empty(flat.size)
    with np.errstate(over="ignore", under="ignore"):
        for part in blocks(flat.size):
            found = _lowest(layers, flat[part].size)
            for solid, thickness in zip(layers.solids[: len(h)][::-1], h[::-1], strict=True):
                found = _climb(solid, flat[part] * thickness, found)
            out[part] = found[3] / flat[part]
    if not np.isfinite(out).all():
        raise DescriptionError(
            "normal_compliance.wavenumber",
            float(alpha.min()),
            "be so large that compliances over it fit into a double",
            unit="1/m",
        )
    return out.reshape(alpha.shape)
