"""Tangential compliances against quadratures and sums of waves."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.integrate import dblquad
from scipy.special import jv

from contactkit.elasticity import influence
from contactkit.elasticity.layer_stack import Layers
from contactkit.elasticity.layered import compliance
from contactkit.elasticity.tangential import isolated_compliance, periodic_symbol

NU, SHEAR = 0.3, 3e9 / 2.6
PIXEL = (1.0, 0.7)


def test_a_pixel_of_a_half_space_by_quadrature_of_cerruti():
    found = isolated_compliance((4, 4), PIXEL, Layers([3e9], [NU]))

    def over(x, y, kernel):
        value, _ = dblquad(lambda b, a: kernel(x - a, y - b), -0.35, 0.35, -0.5, 0.5, epsabs=1e-12)
        return value / (2.0 * np.pi * SHEAR)

    def along(x, y):
        r = np.hypot(x, y)
        return (1.0 - NU) / r + NU * x * x / r**3

    for row, column in ((3, 2), (0, 3), (4, 0)):
        x, y = PIXEL[1] * column, PIXEL[0] * row
        assert found.xx[row, column] == pytest.approx(over(x, y, along), rel=1e-9)
        across = over(x, y, lambda a, b: along(b, a))
        assert found.yy[row, column] == pytest.approx(across, rel=1e-9)
        cross = over(x, y, lambda a, b: NU * a * b / np.hypot(a, b) ** 3)
        assert found.xy[row, column] == pytest.approx(cross, rel=1e-9, abs=1e-24)


def test_layers_of_one_material_are_a_half_space():
    one = isolated_compliance((40, 50), PIXEL, Layers([3e9], [NU]))
    two = isolated_compliance((40, 50), PIXEL, Layers([3e9, 3e9], [NU, NU], [2.0]))
    for a, b in zip(one, two, strict=True):
        assert np.abs(a - b).max() < 1e-11 * one.xx.max()


def test_with_nu_zero_it_is_the_normal_compliance():
    layers = Layers([3e9], [0.0])
    found = isolated_compliance((20, 30), PIXEL, layers)
    normal = influence.coefficients((20, 30), PIXEL, *layers)
    assert found.xx == pytest.approx(normal, rel=1e-13)
    assert found.yy == pytest.approx(normal, rel=1e-13)
    assert not found.xy.any()


STACK = ([12e9, 3e9], [0.3, 0.2], [1.5])


def point_load(x, y):
    """Displacements xx, xy, yy at places under unit forces: Hankel integrals of F11 and Fs."""
    modulus, ratio = np.array(STACK[0]), np.array(STACK[1])
    r, c, cutoff = np.hypot(x, y), STACK[2][0], 40.0 / STACK[2][0]
    nodes, weights = np.polynomial.legendre.leggauss(16)
    panel = cutoff / 80
    alpha = (panel * (np.arange(80.0)[:, None] + 0.5 + 0.5 * nodes)).ravel()
    weights = np.tile(0.5 * panel * weights, 80)
    found = compliance(alpha, *STACK)
    transverse = 2.0 * (1.0 + ratio) / modulus
    total = []
    for sign, order in ((1.0, 0), (-1.0, 2)):
        near, far = 0.5 * transverse * (1.0 - ratio + sign)
        rest = 0.5 * alpha * (found.F11 + sign * found.Fs)
        rest -= near + (far - near) * np.exp(-alpha * c)
        s = np.hypot(r, c)
        step = 1.0 / s if order == 0 else (s - c) ** 2 / (r * r * s)  # of exp(-alpha c)
        bessel = jv(order, alpha[:, None] * r)
        total.append((weights * rest) @ bessel + near / r + (far - near) * step)
    mean, half = total
    cos, sin = (x * x - y * y) / r**2, 2.0 * x * y / r**2
    return np.array([mean - half * cos, -half * sin, mean + half * cos]) / (2.0 * np.pi)


@pytest.mark.parametrize("place", [(0, 5), (3, 2), (11, 20)])
@pytest.mark.parametrize("pixel", [(1.0, 1.0), (1.0, 0.2)], ids=["square", "long"])
def test_a_pixel_on_layers_by_quadrature(pixel, place):
    found = isolated_compliance((12, 40), pixel, Layers(*STACK))
    nodes, weights = np.polynomial.legendre.leggauss(6)
    dy, dx = pixel
    x = dx * (place[1] + 0.5 * nodes)
    y = dy * (place[0] + 0.5 * nodes)
    area = 0.25 * dx * dy * np.outer(weights, weights).ravel()
    values = point_load(np.tile(x, 6), np.repeat(y, 6))
    exact = values @ area
    scale = 1e-8 * exact[0]
    got = [one[place] for one in found]
    assert got == pytest.approx(exact, rel=1e-7, abs=scale)


def test_waves_are_longitudinal_or_transverse():
    layers = Layers([12e9, 3e9], [0.3, 0.2], [1.5])
    symbol = periodic_symbol((8, 12), (1.0, 0.5), layers)
    kx, ky = 2.0 * np.pi / 6.0, 2.0 * np.pi / 8.0
    c = compliance([kx, ky, np.hypot(kx, ky)], *layers)
    along_x, along_y = (symbol.xx[0, 1], symbol.yy[0, 1]), (symbol.xx[1, 0], symbol.yy[1, 0])
    assert along_x == pytest.approx((c.F11[0], c.Fs[0]))
    assert along_y == pytest.approx((c.Fs[1], c.F11[1]))
    assert symbol.xy[1, 1] == -symbol.xy[-1, 1] != 0.0
    assert symbol.xx[1, 1] + symbol.yy[1, 1] == pytest.approx(c.F11[2] + c.Fs[2])
    assert not symbol.xy[4].any()
    assert not symbol.xy[:, -1].any()
