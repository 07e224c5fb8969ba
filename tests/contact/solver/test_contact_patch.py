"""The operator on a patch of an isolated contact, and padded columns taken strip by strip."""

from __future__ import annotations

import numpy as np
import pytest

from contactkit.contact.solver.contact_solver import ContactSolver
from contactkit.contact.solver.convolution import Convolution, Patch, Transforms, patch_symbol
from contactkit.elasticity.influence import symbol

MODULI, POISSON, NO_LAYERS = np.array([0.75]), (0.5,), ()


def half_space(shape, pixel_size):
    return symbol(shape, pixel_size, MODULI, POISSON, NO_LAYERS)


def influence(shape, pixel_size):
    """Displacement of every pixel of an isolated contact under unit pressure on the first."""
    unit = np.zeros(shape)
    unit[0, 0] = 1.0
    return Convolution(shape, half_space(shape, pixel_size), periodic=False)(unit)


@pytest.mark.parametrize("fast", [False, True])
@pytest.mark.parametrize(
    "pixels",
    [
        [(3, 4), (17, 9), (20, 12)],
        [(0, 0), (0, 3)],
        [(29, 39), (28, 30)],
        [(0, 5), (29, 7)],
        [(13, 21)],
    ],
)
def test_on_its_pixels_a_patch_displaces_like_the_whole_map(pixels, fast):
    if fast:
        pytest.importorskip("ducc0")
    shape, pixel_size = (30, 40), (1.0, 0.7)
    whole = Convolution(shape, half_space(shape, pixel_size), periodic=False)
    at = np.sort([row * shape[1] + column for row, column in pixels])
    values = np.random.default_rng(2).random(at.size)
    pressure = np.zeros(shape)
    pressure.ravel()[at] = values
    patch = Patch(lambda: influence(shape, pixel_size), shape, Transforms(fast=fast))
    small = patch.take(at)
    assert small is not None
    assert small.shape[0] * small.shape[1] < 0.61 * shape[0] * shape[1]
    small.source.ravel()[patch.at] = values
    expected = whole(pressure).ravel()[at]
    np.testing.assert_allclose(small.run().ravel()[patch.at], expected, rtol=2e-6)


def test_the_symbol_of_a_patch_as_wide_as_the_map_is_that_of_the_map():
    """But for the distance that no two pixels of it are apart, which shifts it alike for all."""
    shape, pixel_size = (12, 20), (1.0, 1.0)
    got = patch_symbol(influence(shape, pixel_size), shape)
    assert got.shape == (13, 21)  # the other rows mirror them
    by_patch = Convolution(shape, got, periodic=False)
    by_map = Convolution(shape, half_space(shape, pixel_size), periodic=False)
    pressure = np.random.default_rng(3).random(shape)
    np.testing.assert_allclose(by_patch(pressure), by_map(pressure), rtol=1e-12)


def test_a_patch_is_kept_while_it_fits_and_none_is_made_of_most_of_the_map():
    patch = Patch(lambda: influence((64, 64), (1.0, 1.0)), (64, 64))
    corner = np.array([0, 20 * 64 + 20])
    first = patch.take(corner)
    assert patch.take(corner + 30 * 64 + 30) is first
    assert patch.take(np.array([0, 12 * 64 + 12])) is not first
    assert patch.take(np.array([0, 64 * 64 - 1])) is None
    assert patch.nbytes < 0.61 * 64 * 64 * 4 * 8


@pytest.mark.parametrize("offset", [0.0, 0.38])
def test_a_ball_is_pressed_alike_with_and_without_a_patch(offset):
    """In the middle, and where the edge of the map cuts it."""
    n, radius = 96, 10.0
    y, x = (np.indices((n, n)) + 0.5) / n - 0.5
    wave = 1e-5 * np.cos(40.0 * x) * np.cos(34.0 * y)
    heights = wave - ((x - offset) ** 2 + (y + offset) ** 2) / (2.0 * radius)
    solver = ContactSolver((n, n), (1.0 / n, 1.0 / n), half_space, periodic=False, fast=False)
    with_patch = solver.solve(heights, mean_pressure=3e-4)
    assert solver.grids[0].patch.operator is not None
    solver.grids = [grid._replace(patch=None) for grid in solver.grids]
    without = solver.solve(heights, mean_pressure=3e-4)
    assert with_patch.converged
    assert without.converged
    assert not with_patch.fallback
    assert with_patch.n_outer <= without.n_outer + 1
    most = without.pressure.max()
    np.testing.assert_allclose(with_patch.pressure, without.pressure, atol=1e-6 * most)
    assert with_patch.rigid_approach == pytest.approx(without.rigid_approach, rel=1e-7)


def test_zeros_beyond_the_map_cost_no_applications():
    """A transform of padded coefficients has an edge that no pixel sees, but every wavenumber."""
    n = 128
    x = (np.arange(n) + 0.5) / n - 0.5
    rough = np.random.default_rng(5).standard_normal((n, n)) * 2e-4
    heights = rough - (x[:, None] ** 2 + x**2) / 20.0

    def with_zeros(shape, pixel_size):
        (ny, nx), half = shape, half_space(shape, pixel_size)
        image = np.fft.irfft2(half, s=(2 * ny, 2 * nx))
        image[ny], image[:, nx] = 0.0, 0.0
        return np.fft.rfft2(image).real

    one, other = (
        ContactSolver((n, n), (1.0 / n, 1.0 / n), make, periodic=False, fast=False)
        for make in (half_space, with_zeros)
    )
    assert other.self_influence == pytest.approx(one.self_influence, rel=1e-12)
    assert other.grids[0].few == one.grids[0].few
    found = [solver.solve(heights, mean_pressure=1e-3) for solver in (one, other)]
    assert abs(found[0].n_applications - found[1].n_applications) <= 5
    np.testing.assert_allclose(
        found[0].pressure, found[1].pressure, atol=1e-6 * found[0].pressure.max()
    )
