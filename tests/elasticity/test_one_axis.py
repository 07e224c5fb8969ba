"""Influence coefficients of windows that repeat along one axis against sums of images."""

from __future__ import annotations

import numpy as np
import pytest
from selection import quick

from contactkit.elasticity import influence
from contactkit.elasticity.layer_stack import Layers
from contactkit.elasticity.layered import compliance
from contactkit.elasticity.one_axis import coefficients, reference, symbol

HALF = Layers([1.0], [0.3])
FILM = Layers([4.0, 1.0], [0.3, 0.2], [2.0])
STIFF = Layers([1e3, 1.0], [0.3, 0.3], [0.5])
SOFT = Layers([0.01, 1.0], [0.3, 0.2], [100.0])
SHEET = Layers([1.0], [0.3], [3.0], "bonded")
SLID = Layers([1.0], [0.45], [2.0], "frictionless")
SOLIDS = {
    "half-space": HALF, "film": FILM, "stiff": STIFF, "soft": SOFT, "sheet": SHEET, "slid": SLID,
}  # fmt: skip
each_solid = pytest.mark.parametrize("layers", SOLIDS.values(), ids=SOLIDS)


def images(shape, pixel_size, layers, count):
    """Isolated coefficients summed over `count` images on either side."""
    (ny, nx), n = shape, np.arange(shape[1] // 2 + 1)
    alone = influence.coefficients((ny, count * nx + nx // 2), pixel_size, *layers)
    total = alone[:, n].copy()
    for j in range(1, count + 1):
        total += alone[:, n + j * nx] + alone[:, np.abs(n - j * nx)]
    return total


@pytest.mark.parametrize(
    ("shape", "pixel"),
    quick([((8, 8), (1.0, 1.0)), ((5, 7), (2.0, 1.0)), ((4, 40), (1.0, 1.0))], 1),
)
@each_solid
def test_coefficients_are_sums_of_images(shape, pixel, layers):
    """But for the datum; what the sums leave out falls with the square of their number."""
    found = coefficients(shape, pixel, layers)
    few, many = (images(shape, pixel, layers, count) for count in (99, 199))
    ratio = (199.5 / 99.5) ** 2
    summed = many + (many - few) / (ratio - 1.0)
    differences = [total - total[-1, 0] for total in (found, summed)]
    np.testing.assert_allclose(*differences, rtol=0.0, atol=4e-7 * found[0, 0])


@pytest.mark.parametrize("layers", [SHEET, SLID])
def test_on_a_base_the_sum_of_images_has_no_datum(layers):
    found = coefficients((6, 5), (1.0, 1.0), layers)
    np.testing.assert_allclose(
        found, images((6, 5), (1.0, 1.0), layers, 30), rtol=0.0, atol=1e-10 * found[0, 0]
    )


def test_a_full_row_is_a_line_load():
    """Of a half-space -2/(pi E*) ln(|y|/l), mean over a pixel; zero at the side across."""
    K = coefficients((32, 5), (1.0, 1.0), HALF)
    row = K[:, 0] + 2.0 * K[:, 1:].sum(axis=1)
    y = np.arange(1.0, 33.0)
    ends = [(y + s) * (np.log((y + s) / 32.0) - 1.0) for s in (0.5, -0.5)]
    expected = -2.0 * (1.0 - 0.3**2) / np.pi * (ends[0] - ends[1])
    np.testing.assert_allclose(row[1:], expected, atol=1e-8)


@each_solid
def test_the_datum_is_a_line_that_does_not_move(layers):
    """Of a window as high as the distance of the datum, a line load leaves its end where it was."""
    distance = reference(layers, 16.0)
    ny = round(distance)
    K = coefficients((ny, 3), (distance / ny, 1.0), layers)
    row = K[:, 0] + 2.0 * K[:, 1]
    if layers.base:
        assert abs(row[-1]) < 0.05 * row[0]
    else:
        assert abs(row[-1]) < 2e-4 * row[0]


@each_solid
def test_a_wave_along_the_window_meets_its_compliance(layers):
    """Far from the ends across, pressure that waves along the window is in plane strain."""
    ny, nx = 64, 16
    found = symbol((ny, nx), (0.25, 0.25), layers, "x")
    pressure = np.zeros((2 * ny, nx))
    pressure[:ny] = np.cos(2.0 * np.pi * np.arange(nx) / nx)
    u = np.fft.irfft2(found * np.fft.rfft2(pressure), s=(2 * ny, nx))
    k, dx = 2.0 * np.pi / (nx * 0.25), 0.25
    # A pressure uniform on each pixel has waves besides, shorter ones.
    G = k + 2.0 * np.pi / dx * np.arange(-200, 201)
    C = np.asarray(compliance(np.abs(G), *layers).C)
    expected = float(np.sum(C * np.sinc(G * dx / (2.0 * np.pi))))
    assert u[ny // 2, 0] == pytest.approx(expected, rel=1e-3 if layers is SOFT else 2e-4)


@each_solid
@pytest.mark.parametrize("shape", quick([((12, 12),), ((24, 3),), ((3, 24),)], 1))
def test_the_operator_is_positive_definite(shape, layers):
    (ny, nx), K = shape, coefficients(shape, (1.0, 1.0), layers)
    dy = np.abs(np.subtract.outer(np.arange(ny), np.arange(ny)))
    dx = np.abs(np.subtract.outer(np.arange(nx), np.arange(nx)))
    dx = np.minimum(dx, nx - dx)
    G = K[dy[:, None, :, None], dx[None, :, None, :]].reshape(ny * nx, ny * nx)
    values = np.linalg.eigvalsh(G)
    assert values[0] > 1e-6 * values[-1]


@pytest.mark.parametrize("shape", [(5, 8), (8, 5), (6, 7)])
def test_the_symbol_is_that_of_the_coefficients_along_either_axis(shape):
    rng = np.random.default_rng(0)
    (ny, nx), pixel = shape, (0.5, 1.0)
    pressure = rng.random(shape)
    K = coefficients(shape, pixel, FILM)
    dy = np.abs(np.subtract.outer(np.arange(ny), np.arange(ny)))
    dx = np.abs(np.subtract.outer(np.arange(nx), np.arange(nx)))
    dx = np.minimum(dx, nx - dx)
    direct = np.einsum("ijkl,kl->ij", K[dy[:, None, :, None], dx[None, :, None, :]], pressure)
    S = symbol(shape, pixel, FILM, "x")
    u = np.fft.irfft2(S * np.fft.rfft2(pressure, s=(2 * ny, nx)), s=(2 * ny, nx))[:ny]
    np.testing.assert_allclose(u, direct, rtol=1e-12)
    turned = symbol(shape[::-1], pixel[::-1], FILM, "y")
    v = np.fft.irfft2(turned * np.fft.rfft2(pressure.T, s=(nx, 2 * ny)), s=(nx, 2 * ny))[:, :ny]
    np.testing.assert_allclose(v.T, direct, rtol=1e-12)
