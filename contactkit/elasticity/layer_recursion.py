"""Recursion over one elastic layer in Fourier space: compliance upward, tractions downward.

Conventions as in `layered`.  Symbols:

=============  ===========================================================================
x              wavenumber times thickness
m, n           1/(1 - nu) and (1 - 2 nu)/(1 - nu)
s, c           sinh x and cosh x
f11, f12, f22  2 G alpha F, the compliance below (then above) the layer with G of the layer
d              f11 f22 - f12^2, an unknown of its own
tau            (-T, -S), the tractions on a plane
=============  ===========================================================================

Arguments are not checked: `layered` and `layered_fields` are the entry points.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from .layer_stack import Base

__all__ = [
    "Products",
    "Sliding",
    "Transfer",
    "at_sliding_base",
    "climb",
    "climb_shear",
    "cross",
    "descend",
    "half_space",
    "on_base",
    "on_base_shear",
    "products",
]

Array = NDArray[np.float64]
Projective = tuple[Array, Array, Array, Array]

# Thicker layers count as this thick: exp(-2x) and all products with it are zero from x = 373 on,
# and without the bound x exp(-2x) is inf times 0 for x = 1e308.
THICKEST = 1e3
# Of 2x. Below it the differences ss - x^2 and sc - x cancel to the fourth and third power of x and
# are series. At 1.6 both forms are exact to 1e-15; the difference loses 2e-14 at 0.4 and 1e-12 at
# 0.1, the ten terms leave 2e-12 at 3.2. Nine terms would do.
SERIES_BELOW = 1.6
# (sinh y - y)/y^3 and (cosh y - 1 - y^2/2)/y^4 as series in y^2
SINH = 1.0 / np.cumprod(np.arange(1.0, 22.0))[2::2]
COSH = 1.0 / np.cumprod(np.arange(1.0, 23.0))[3::2]


class Products(NamedTuple):
    """Products of s, c and x, each times exp(-2x): free of overflow and of cancellation.

    `one` is exp(-2x) itself, `sc_x` is sc - x and `ss_xx` is s^2 - x^2.
    """

    one: Array
    cc: Array
    x: Array
    xx: Array
    ss: Array
    sc: Array
    ss_xx: Array
    sc_x: Array


def products(x: Array) -> Products:
    """Evaluate the products of one layer; x of any size above zero.

    Examples
    --------
    >>> p = products(np.array([1e-8, 1.0, 1e300]))
    >>> print(np.round(p.sc, 8), np.round(p.x, 8))
    [1.0000000e-08 2.4542109e-01 2.5000000e-01] [1.0000000e-08 1.3533528e-01 0.0000000e+00]
    """
    y = 2.0 * np.minimum(x, THICKEST)
    one = np.exp(-y)
    first = 0.5 * y * one
    second = 0.5 * y * first
    near = y < SERIES_BELOW
    count = int(np.count_nonzero(near))
    if count == y.size:
        rest = _near(y, one)
    else:
        rest = _far(one, first, second)
        if count:
            for values, better in zip(rest, _near(y[near], one[near]), strict=True):
                values[near] = better
    return Products(one, 0.25 * (1.0 + one) ** 2, first, second, *rest)


def _far(one: Array, first: Array, second: Array) -> tuple[Array, Array, Array, Array]:
    drop = 1.0 - one
    ss, sc = 0.25 * drop * drop, 0.25 * drop * (1.0 + one)
    return ss, sc, ss - second, sc - first


def _near(y: Array, one: Array) -> tuple[Array, Array, Array, Array]:
    """Products by series: sc = sinh(y)/2, ss = (cosh(y) - 1)/2 with y = 2x, less first terms."""
    w = y * y
    scale = 0.5 * w * one
    sc_x, ss_xx = scale * y * _series(SINH, w), scale * w * _series(COSH, w)
    return 0.5 * scale + ss_xx, 0.5 * y * one + sc_x, ss_xx, sc_x


def _series(coefficients: Array, w: Array) -> Array:
    total: Array = coefficients[-1] * w + coefficients[-2]
    for coefficient in coefficients[-3::-1]:
        total *= w
        total += coefficient
    return total


def half_space(nu: float, size: int) -> Projective:
    """Dimensionless compliance of a homogeneous half-space.

    Examples
    --------
    >>> [float(v[0]) for v in half_space(0.25, 1)]
    [1.5, 0.5, 1.5, 2.0]
    """
    values = 2.0 * (1.0 - nu), 1.0 - 2.0 * nu, 2.0 * (1.0 - nu), 3.0 - 4.0 * nu
    f11, f12, f22, d = (np.full(size, value) for value in values)
    return f11, f12, f22, d


def cross(f: Projective, ratio: float) -> Projective:
    """Compliance f across an interface, in units of a layer `ratio` times as stiff in shear.

    Examples
    --------
    >>> [float(v[0]) for v in cross(half_space(0.25, 1), 2.0)]
    [3.0, 1.0, 3.0, 8.0]
    """
    f11, f12, f22, d = f
    return f11 * ratio, f12 * ratio, f22 * ratio, d * ratio * ratio


def denominator(p: Products, f: Projective, m: float, n: float) -> Array:
    """Determinant of both recursions, times exp(-2x)."""
    f11, f12, f22, d = f
    half = 0.5 * m
    along = (p.sc + p.x) * f11 + p.sc_x * f22 + (n * p.ss + m * p.xx) * f12
    rest = (m * (1.0 - 0.25 * m)) * p.ss + (half * half) * (p.xx + p.ss_xx * d)
    return p.one + rest + half * along


def climb(p: Products, f: Projective, m: float, n: float) -> Projective:
    """Compliance at the top of a layer from that at its bottom.

    Examples
    --------
    A layer on a half-space of the same material changes nothing:

    >>> f = half_space(0.25, 1)
    >>> top = climb(products(np.array([0.7])), f, 4 / 3, 2 / 3)
    >>> bool(np.allclose(top, f, rtol=1e-15))
    True
    """
    # The map is linear in (1, f11, f12, f22, d) and divided by its first component. Every
    # coefficient is written as a sum of non-negative terms (but for f12, which has a sign): a
    # compliance of the wrong sign, as of transfer matrices with exp(+x), cannot come about. The
    # determinant d is carried along: f11 f22 - f12^2 loses all digits under a stiff layer, where f
    # tends to rank one.
    f11, f12, f22, d = f
    half = 0.5 * m
    n_sc, m_x = n * p.sc, m * p.x
    wide, narrow = half * (p.sc + p.x), half * p.sc_x
    n_wide, n_narrow = n_sc + wide, n_sc + narrow
    plus, minus = n_sc + m_x, n_sc - m_x
    n_ss, m_xx = n * p.ss, m * p.xx
    k = n_ss + m_xx
    ell = (4.0 - m) * n_ss - m * m_xx
    unit = p.one + (m * (1.0 - 0.25 * m)) * p.ss + (0.5 * half) * m_xx
    last = (half * half) * p.ss_xx
    r = 1.0 / (unit + wide * f11 + narrow * f22 + half * k * f12 + last * d)
    return (
        (n_wide + p.cc * f11 + plus * f12 + p.ss * f22 + narrow * d) * r,
        (
            0.25 * ell
            + 0.5 * (minus * f11 + plus * f22)
            + (p.one + 0.5 * (n * n_ss - m * m_xx)) * f12
            + (0.5 * half) * k * d
        )
        * r,
        (n_narrow + p.ss * f11 + minus * f12 + p.cc * f22 + wide * d) * r,
        (last + 2.0 * n_ss + n_narrow * f11 + n_wide * f22 + 0.5 * ell * f12 + unit * d) * r,
    )


def climb_shear(p: Products, fs: Array) -> Array:
    """Transverse compliance G alpha Fs at the top of a layer from that at its bottom.

    Examples
    --------
    >>> float(climb_shear(products(np.array([0.7])), np.array([1.0]))[0])
    1.0
    """
    tanh = p.sc / p.cc
    return (fs + tanh) / (1.0 + fs * tanh)


def on_base(p: Products, base: Base, m: float, n: float) -> Projective:
    """Compliance at the top of a layer that rests on a rigid base.

    The recursion from (1, f11, f12, f22, d) = (1, 0, 0, 0, 0) at a bonded base, where nothing
    moves, and from (0, 1, 0, 0, 0) at a frictionless one, which gives way along itself alone.

    Examples
    --------
    A thick layer is a half-space:

    >>> thick = products(np.array([50.0]))
    >>> all(np.allclose(on_base(thick, base, 4 / 3, 2 / 3), half_space(0.25, 1), rtol=1e-15)
    ...     for base in ("bonded", "frictionless"))
    True
    """
    if base == "bonded":
        none = np.zeros(p.one.size)
        return climb(p, (none, none, none, none), m, n)
    wide = (0.5 * m) * (p.sc + p.x)
    along = 0.5 * (n * p.sc - m * p.x)
    return p.cc / wide, along / wide, p.ss / wide, (n * p.sc + (0.5 * m) * p.sc_x) / wide


def on_base_shear(p: Products, base: Base) -> Array:
    """Transverse compliance G alpha Fs at the top of a layer that rests on a rigid base.

    Examples
    --------
    >>> float(on_base_shear(products(np.array([50.0])), "frictionless")[0])
    1.0
    """
    return p.sc / p.cc if base == "bonded" else p.cc / p.sc


class Transfer(NamedTuple):
    """Tractions at the bottom of a layer: ``tau_bottom = t tau_top``, ``Q_bottom = ts Q_top``."""

    t11: Array
    t12: Array
    t21: Array
    t22: Array
    ts: Array


def descend(x: Array, p: Products, f: Projective, fs: Array, m: float, n: float) -> Transfer:
    """Tractions at the bottom of a layer per traction at its top; f and fs at the bottom.

    Examples
    --------
    Under a pressure on a half-space S falls as (1 + k) exp(-k) and T follows k exp(-k):

    >>> x = np.array([1.0])
    >>> _, t12, _, t22, ts = descend(x, products(x), half_space(0.25, 1), x, 4 / 3, 2 / 3)
    >>> print(np.round([-t12[0], t22[0], ts[0]] / np.exp(-x), 12))
    [1. 2. 1.]
    """
    # Tractions go down from the top by the compliance below, which already knows that waves decay:
    # integrating downward from both displacement and traction at the top would grow as exp(x).
    f11, f12, f22, _ = f
    x = np.minimum(x, THICKEST)
    c, s, e, g = _within(x, p, m)
    stiff, slack = m * s + g, e + c
    r = np.exp(-x) / denominator(p, f, m, n)
    ts = np.exp(-x) / (c + fs * s)
    return Transfer(
        r * (c - e - e * f12 - g * f22),
        -r * (stiff * f12 + e * f22 + (1.0 - n) * s + g),
        r * (e * f11 + g * f12 + s + g),
        r * (stiff * f11 + e * f12 + slack),
        ts,
    )


class Sliding(NamedTuple):
    """State at a frictionless base: ``2 G alpha U = u tau``, ``S = -s tau``, ``G alpha V = v Q``.

    u and s are pairs for the two tractions on the top of the layer; W, T and Q vanish.
    """

    u1: Array
    u2: Array
    s1: Array
    s2: Array
    v: Array


def at_sliding_base(x: Array, p: Products, m: float, n: float) -> Sliding:
    """State at the frictionless base below a layer, per traction at its top.

    Examples
    --------
    A thin layer carries a pressure down and extends by nu of it:

    >>> x = np.array([1e-3])
    >>> state = at_sliding_base(x, products(x), 4 / 3, 2 / 3)
    >>> print(np.round([state.s2[0], -state.u2[0]], 5))
    [1.   0.25]
    """
    x = np.minimum(x, THICKEST)
    c, s, e, g = _within(x, p, m)
    r = np.exp(-x) / ((0.5 * m) * (p.sc + p.x))
    return Sliding(
        r * (c - e),
        -r * ((1.0 - n) * s + g),
        r * e,
        r * (m * s + g),
        np.exp(-x) / s,
    )


def _within(x: Array, p: Products, m: float) -> tuple[Array, Array, Array, Array]:
    """c, s, m/2 x s and m/2 (x c - s) of a layer, times exp(-x)."""
    c = 0.5 * (1.0 + p.one)
    s = p.sc / c
    half = 0.5 * m
    e, g = half * x * s, half * (x * c - s)
    near = 2.0 * x < SERIES_BELOW
    if near.any():
        small = x[near]
        w = small * small
        terms = _series(SINH * np.arange(2.0, 2.0 * SINH.size + 1.0, 2.0), w)
        g[near] = half * small * w * terms * np.exp(-small)
    return c, s, e, g
