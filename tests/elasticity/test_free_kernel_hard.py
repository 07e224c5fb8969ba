"""Far offsets, oblong pixels, thin and thick layers, any contrast."""

from __future__ import annotations

import numpy as np
import pytest
from selection import quick

from contactkit.elasticity import influence as free_kernel
from contactkit.elasticity import layered, love, point_load

pytestmark = pytest.mark.hard

CONTRASTS = [1e-6, 0.25, 4.0, 1e6]


@pytest.mark.parametrize("distance", [30.0, 1e3, 1e4, 1e6, 1e12])
def test_nothing_cancels_far_away(distance):
    """The point force with the first moments of the cell: exact to (1/distance)^6."""
    for angle in (0.0, 0.4, np.pi / 4, 1.5):
        x, y = distance * np.cos(angle), distance * np.sin(angle)
        c2, s2 = np.cos(angle) ** 2, np.sin(angle) ** 2
        # Legendre's expansion of the mean of 1/r for a square of side one, to the fourth order.
        second = (3 * c2 - 1 + 3 * s2 - 1) / 24
        x4 = (3 - 30 * c2 + 35 * c2**2) * 3  # fourth derivative of 1/r, times r^5
        y4 = (3 - 30 * s2 + 35 * s2**2) * 3
        x2y2 = 3 - 15 * (c2 + s2) + 105 * c2 * s2
        fourth = (x4 + y4) / 1920 + x2y2 / 576
        series = (1 + second / distance**2 + fourth / distance**4) / distance
        value = float(love.rectangle(x, y, 0.5, 0.5, 1 / np.pi))
        assert value == pytest.approx(series, rel=max(1e-13, 0.1 / distance**6))


def test_near_and_far_forms_of_love_meet():
    """Both sides of the change at 24 sides differ by less than 1e-12, for oblong cells also."""
    for a, b in ((0.5, 0.5), (0.5, 0.05), (0.02, 0.5)):
        angle = np.linspace(0.0, np.pi / 2, 17)
        x, y = 24.0 * np.cos(angle), 24.0 * np.sin(angle)
        for average in (False, True):
            before, after = (
                s * love.rectangle(s * x, s * y, a, b, 1.0, average=average)
                for s in (1 - 1e-14, 1 + 1e-14)
            )
            np.testing.assert_allclose(before, after, rtol=1e-12)


@pytest.mark.parametrize("contrast", CONTRASTS)
@pytest.mark.parametrize("thickness", quick([1e-3, 1.0, 30.0], 0, 2))
@pytest.mark.parametrize("pixel", [(1.0, 1.0), (0.3, 1.0)])
def test_near_and_far_forms_of_a_stack_meet(monkeypatch, contrast, thickness, pixel):
    """Twenty against forty pixels of the integrals over triangles; of the centre 1e-9."""
    arguments = ((48, 48), pixel, [contrast, 1.0], [0.3, 0.3], [thickness])
    k = free_kernel.coefficients(*arguments)
    monkeypatch.setattr(free_kernel, "_NEAR", 40.0)
    again = free_kernel.coefficients(*arguments)
    assert np.abs(k - again).max() < 1e-9 * k[0, 0]


@pytest.mark.parametrize("contrast", CONTRASTS)
def test_a_layer_much_thicker_than_the_window_is_a_half_space(contrast):
    k = free_kernel.coefficients((9, 16), (1.0, 1.0), [contrast, 1.0], [0.3, 0.2], [1e14])
    alone = free_kernel.coefficients((9, 16), (1.0, 1.0), [contrast], [0.3])
    np.testing.assert_allclose(k, alone, rtol=1e-7 if contrast > 1 else 1e-10)


@pytest.mark.parametrize("contrast", [0.25, 4.0])
def test_a_layer_much_thinner_than_a_pixel_is_not_felt(contrast):
    """The layer adds c0 over the pixel itself only: relative 1e-9 here."""
    k = free_kernel.coefficients((9, 16), (1.0, 1.0), [contrast, 1.0], [0.3, 0.2], [1e-10])
    bare = free_kernel.coefficients((9, 16), (1.0, 1.0), [1.0], [0.2])
    np.testing.assert_allclose(k, bare, rtol=1e-9)


@pytest.mark.parametrize("contrast", [1e-4, 0.1])
def test_a_thin_soft_layer_adds_springs_under_each_pixel(contrast):
    """A pixel on a layer of a thousandth of its side: that of the substrate, and a spring.

    The spring is the constant of alpha C at long waves; its rim and the next order cost h / side.
    """
    young, nu, h = [contrast, 1.0], [0.3, 0.3], [1e-3]
    k = free_kernel.coefficients((4, 4), (1.0, 1.0), young, nu, h)
    bare = free_kernel.coefficients((4, 4), (1.0, 1.0), [1.0], [0.3])
    alpha = np.array([1e-3])  # alpha h = 1e-6, alpha c0 = 1e-5 at least
    c = layered.compliance(alpha, np.array(young), np.array(nu), np.array(h)).C
    spring = float(c[0] - 2.0 * (1.0 - 0.3**2) / alpha[0])
    assert k[0, 0] - bare[0, 0] == pytest.approx(spring, rel=1e-2)
    assert np.abs((k - bare).ravel()[1:]).max() < 1e-2 * spring


def test_a_layer_of_the_same_material_is_not_felt():
    bare = free_kernel.coefficients((30, 30), (1.0, 0.4), [7.0], [0.5])
    k = free_kernel.coefficients((30, 30), (1.0, 0.4), [7.0] * 3, [0.5] * 3, [0.3, 5.0])
    np.testing.assert_allclose(k, bare, rtol=1e-10)


def test_cutting_a_layer_changes_nothing():
    whole = free_kernel.coefficients((24, 24), (1.0, 1.0), [20.0, 1.0], [0.2, 0.45], [3.0])
    cut = free_kernel.coefficients(
        (24, 24), (1.0, 1.0), [20.0] * 20 + [1.0], [0.2] * 20 + [0.45], [0.15] * 20
    )
    np.testing.assert_allclose(cut, whole, rtol=1e-9)


@pytest.mark.parametrize("aspect", [1.0, 0.01, 300.0])
def test_oblong_pixels_add_up(aspect):
    """The same rectangle as one pixel or three; coefficients of a stack are additive."""
    stack = ([5.0, 1.0], [0.3, 0.4], [0.7])
    whole = free_kernel.coefficients((2, 2), (aspect, 1.0), *stack)[0, 0]
    parts = free_kernel.coefficients((2, 2), (aspect, 1.0 / 3.0), *stack)
    assert parts[0, 0] + 2.0 * parts[0, 1] == pytest.approx(whole, rel=1e-10)


def test_one_row_of_pixels():
    k = free_kernel.coefficients((1, 64), (2.0, 1.0), [4.0, 1.0], [0.3, 0.3], [3.0])
    wide = free_kernel.coefficients((64, 64), (2.0, 1.0), [4.0, 1.0], [0.3, 0.3], [3.0])
    np.testing.assert_allclose(k, wide[:2], rtol=1e-9)
    assert free_kernel.symbol((1, 64), (2.0, 1.0), [1.0], [0.3]).shape == (2, 65)


@pytest.mark.parametrize("unit", [1e-9, 1e6])
def test_the_unit_of_length_does_not_matter(unit):
    stack = ([2e11, 7e10, 1e11], [0.3, 0.49, 0.2])
    k = free_kernel.coefficients((20, 20), (1.0, 1.0), *stack, [0.5, 8.0])
    again = free_kernel.coefficients((20, 20), (unit, unit), *stack, [0.5 * unit, 8.0 * unit])
    np.testing.assert_allclose(again / unit, k, rtol=1e-9)


@pytest.mark.parametrize("contrast", CONTRASTS)
def test_the_mean_of_a_table_is_the_mean_of_its_values(contrast):
    """I(r) against a sum of T over the table, which knows nothing of the modes of I."""
    arguments = np.array([contrast, 1.0]), np.array([0.3, 0.3]), np.array([1.0])
    load = point_load.table(*arguments, 1e-7, 100.0)
    log_radius = load.start + load.step * np.arange(load.mean.shape[1])
    radius, value = np.exp(log_radius), load.derivatives[0, 0]
    pieces = 0.5 * (radius[1:] * value[1:] + radius[:-1] * value[:-1]) * load.step
    mean = (np.cumsum(pieces) + radius[0] * value[0]) / radius[1:]
    np.testing.assert_allclose(load.mean[0, 1:], mean, rtol=0, atol=1e-4 * np.abs(mean).max())
