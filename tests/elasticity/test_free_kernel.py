"""Influence coefficients of isolated contacts against tables, quadrature and closed forms."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
import pytest
from scipy import fft
from scipy.special import j1

from contactkit.elasticity import influence as free_kernel
from contactkit.elasticity import layered, love
from contactkit.reference import hertz, love_patch

DATA = json.loads((Path(__file__).parents[1] / "data" / "free_contact.json").read_text())


def displacement(symbol, pressure):
    """Linear convolution with a symbol of the doubled window."""
    ny, nx = pressure.shape
    shape = (2 * ny, 2 * nx)
    return fft.irfft2(symbol * fft.rfft2(pressure, s=shape), s=shape)[:ny, :nx]


@pytest.mark.parametrize("row", DATA["love"]["rows"], ids=lambda row: str(row["offset"]))
def test_uniform_pressure_on_a_square(row):
    """1e-12: the digits of the table far away."""
    case = DATA["love"]
    modulus = case["young_modulus"] / (1.0 - case["poisson_ratio"] ** 2)
    half = 0.5 * case["side"]
    centre = love.rectangle(*row["offset"], half, half, modulus)
    average = love.rectangle(*row["offset"], half, half, modulus, average=True)
    assert float(centre) == pytest.approx(row["centre"], rel=1e-12)
    assert float(average) == pytest.approx(row["average"], rel=1e-12)


@pytest.mark.parametrize(
    ("x", "y"), [(0.0, 0.0), (0.3, -0.1), (1.0, 0.5), (-2.3, 0.7), (30.0, 41.0)]
)
def test_a_rectangle_summed_over_directions(x, y):
    expected = love_patch.displacement(x, y, 1.0, 0.5, 2.0)
    assert float(love.rectangle(x, y, 1.0, 0.5, 2.0)) == pytest.approx(expected, rel=1e-11)


@pytest.mark.parametrize("row", DATA["layered_patch"]["rows"], ids=lambda row: str(row["offset"]))
def test_a_square_on_a_layer(row):
    """1e-11: the moments of a pixel beyond twenty pixels; nearer 1e-13."""
    case = DATA["layered_patch"]
    stack = (case["young_modulus"], case["poisson_ratio"], case["thickness"])
    k = free_kernel.coefficients((32, 32), (case["side"], case["side"]), *stack)
    i, j = row["offset"]
    assert k[j, i] == pytest.approx(row["centre"], rel=1e-11)
    assert k[i, j] == pytest.approx(row["centre"], rel=1e-11)


STACKS = {
    "film four times as stiff": ([4.0, 1.0], [0.3, 0.3], [3.0]),
    "incompressible and soft": ([0.01, 1.0], [0.5, 0.3], [2.0]),
    "stiff on soft": ([1e6, 1.0], [0.25, 0.4], [1.0]),
    "sandwich": ([10.0, 0.1, 10.0, 1.0], [0.3, 0.45, 0.3, 0.2], [0.7, 2.0, 0.5]),
}


def pixel_by_quadrature(x, y, pixel, stack):
    """Coefficient from C(alpha) in the plane of wavenumbers, less that of the top layer alone.

    What is left of C decays like exp(-2 alpha h_1); the sum over directions is a mean over equal
    angles, which converges fast once they are more than alpha times the distance.
    """
    young, nu, thickness = (np.array(values) for values in stack)
    (dy, dx), top = pixel, 20.0 / thickness[0]
    nodes, weights = np.polynomial.legendre.leggauss(16)
    edges = np.geomspace(1e-13 * top, top, 80)
    edges = np.unique(np.concatenate(([0.0], edges, np.linspace(0.0, top, int(4 * top)))))
    half = 0.5 * np.diff(edges)[:, None]
    alpha = (edges[:-1, None] + half * (1.0 + nodes)).ravel()
    count = 30 + int(top * (np.hypot(x, y) + np.hypot(dx, dy)))
    theta = (np.arange(count) + 0.5) * np.pi / count / 2
    c_inf = 2.0 * (1.0 - nu[0] ** 2) / young[0]
    rest = alpha * layered.compliance(alpha, young, nu, thickness).C - c_inf
    total = np.zeros(alpha.size)
    for cosine, sine in zip(np.cos(theta), np.sin(theta), strict=True):
        xi, eta = alpha * cosine, alpha * sine
        box = np.sinc(xi * dx / 2 / np.pi) * np.sinc(eta * dy / 2 / np.pi)
        total += box * np.cos(xi * x) * np.cos(eta * y)
    return dx * dy * np.sum((half * weights).ravel() * rest * total) / count / (2.0 * np.pi)


@pytest.mark.parametrize("stack", STACKS.values(), ids=STACKS)
@pytest.mark.parametrize("pixel", [(1.0, 1.0), (1.25, 0.5)], ids=["square", "oblong"])
def test_coefficients_give_what_the_compliance_says(stack, pixel):
    """Triangles and modes of logarithms against the plane of wavenumbers; 1e-11 of the centre."""
    k = free_kernel.coefficients((8, 8), pixel, *stack)
    dy, dx = pixel
    top = stack[0][0] / (1.0 - stack[1][0] ** 2)
    for i, j in ((0, 0), (1, 2), (6, 0), (3, 5)):
        alone = float(love.rectangle(i * dx, j * dy, dx / 2, dy / 2, top))
        expected = alone + pixel_by_quadrature(i * dx, j * dy, pixel, stack)
        assert k[j, i] == pytest.approx(expected, abs=1e-11 * k[0, 0])


def test_a_disc_of_pressure_on_a_layer():
    """In the centre u = R int C(alpha) J1(alpha R) d alpha; a staircase disc is right to 1e-3."""
    young, nu, h = np.array([4.0, 1.0]), np.array([0.3, 0.3]), np.array([10.0])
    radius, n = 30.0, 63
    i = np.arange(n) - n // 2
    pressure = (np.hypot(i, i[:, None]) <= radius).astype(float)
    area = pressure.sum() / np.pi  # of the staircase: its own radius squared
    u = displacement(free_kernel.symbol((n, n), (1.0, 1.0), young, nu, h), pressure)
    edges = np.linspace(0.0, 40.0 / h[0], 2000)
    nodes, weights = np.polynomial.legendre.leggauss(8)
    half = 0.5 * np.diff(edges)[:, None]
    alpha = edges[:-1, None] + half * (1.0 + nodes)
    c_inf = 2.0 * (1.0 - nu[0] ** 2) / young[0]
    rest = layered.compliance(alpha, young, nu, h).C - c_inf / alpha
    r = np.sqrt(area)
    expected = r * (np.sum(half * weights * rest * j1(alpha * r)) + c_inf)
    assert u[n // 2, n // 2] == pytest.approx(expected, rel=1e-3)


def test_hertz_pressure_sinks_the_surface_like_a_sphere():
    """Second order in the centre, 0.16 (d/a)^2; the root at the rim sets the worst."""
    centre, worst = [], []
    for cells in (8, 16, 32):
        n, fine = 2 * cells + 5, 8
        sub = (np.arange(n * fine) + 0.5) / fine - n / 2
        r = np.hypot(sub, sub[:, None]) / cells
        pressure = hertz.pressure(r, 1.0, 1.0).reshape(n, fine, n, fine).mean(axis=(1, 3))
        u = displacement(free_kernel.symbol((n, n), (1 / cells, 1 / cells), [1.0], [0.0]), pressure)
        x = (np.arange(n) - n // 2) / cells
        exact = hertz.surface_displacement(x, 1.0, 1.0, 1.0)
        error = np.abs(u[n // 2] - exact) / exact.max()
        centre.append(error[n // 2])
        worst.append(error.max())
    assert centre[-1] < 2e-4
    assert worst[-1] < 1e-3
    assert np.log2(centre[0] / centre[-1]) / 2 == pytest.approx(2.0, abs=0.05)
    assert np.log2(worst[0] / worst[-1]) / 2 > 1.2


def test_love_at_a_height_is_the_transform_exp_of_minus_height():
    """The field of a film whose compliance has that step: rectangle(c) integrates 1/s."""
    nodes, weights = np.polynomial.legendre.leggauss(40)
    w = weights[:, None] * weights
    for x, y, c in ((0.2, 0.1, 0.7), (3.0, 1.0, 2.0), (0.0, 0.0, 40.0), (60.0, 10.0, 5.0)):
        s = np.sqrt((x - nodes) ** 2 + (y - 0.5 * nodes[:, None]) ** 2 + c * c)
        expected = 0.5 * np.sum(w / s) / np.pi
        assert float(love.rectangle(x, y, 1.0, 0.5, 1.0, c)) == pytest.approx(expected, rel=1e-12)


@pytest.mark.parametrize("c", [0.0, 0.3, 5.0])
@pytest.mark.parametrize(("x", "y"), [(2.5, 0.0), (2.1, 1.4), (6.0, 5.0), (20.0, 1.0), (80.0, 9.0)])
def test_the_mean_over_a_cell_is_the_mean_of_the_values(x, y, c):
    """All three ways to the mean, for cells apart, where quadrature converges."""
    nodes, weights = np.polynomial.legendre.leggauss(24)
    w = weights[:, None] * weights / 4.0
    values = love.rectangle(x + nodes, y + 0.5 * nodes[:, None], 1.0, 0.5, 1.0, c)
    mean = love.rectangle(x, y, 1.0, 0.5, 1.0, c, average=True)
    assert float(mean) == pytest.approx(np.sum(w * values), rel=1e-11)


def test_the_symbol_is_the_transform_of_the_mirrored_coefficients():
    shape, pixel, stack = (5, 8), (1.0, 0.7), ([4.0, 1.0], [0.3, 0.3], [2.0])
    k = free_kernel.coefficients(shape, pixel, *stack)
    rows = np.abs(fft.fftfreq(10, 1 / 10)).astype(int)
    columns = np.abs(fft.fftfreq(16, 1 / 16)).astype(int)
    transform = fft.rfft2(k[np.ix_(rows, columns)])
    symbol = free_kernel.symbol(shape, pixel, *stack)
    assert symbol.shape == (10, 9)
    assert np.abs(transform.imag).max() < 1e-13 * np.abs(symbol).max()
    np.testing.assert_allclose(symbol, transform.real, rtol=0, atol=1e-13 * np.abs(symbol).max())
