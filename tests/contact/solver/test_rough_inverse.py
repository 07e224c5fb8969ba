"""The sparse inverse factor, what it is worth on plates, and pressures extrapolated in the load."""

from __future__ import annotations

import importlib.util

import numpy as np
import pytest
from selection import quick

from contactkit.contact.solver import loops_numpy
from contactkit.contact.solver.contact_solver import ContactSolver
from contactkit.contact.solver.convolution import Convolution
from contactkit.contact.solver.idle_memory import IdleMemory
from contactkit.contact.solver.reduced_system import influence_matrix
from contactkit.contact.solver.sparse_inverse import SparseInverse, lattice_strides
from contactkit.contact.solver.warm_start import initial_pressure
from contactkit.elasticity import layered
from contactkit.errors import DescriptionError

NUMBA = importlib.util.find_spec("numba") is not None


def stack(contrast, thickness):
    def make(shape, pixel_size):
        qy = 2.0 * np.pi * np.fft.fftfreq(shape[0], pixel_size[0])[:, None]
        qx = 2.0 * np.pi * np.fft.rfftfreq(shape[1], pixel_size[1])
        q = np.hypot(qy, qx)
        q[0, 0] = 1.0
        moduli, poisson = np.array([contrast, 1.0]), np.array([0.3, 0.3])
        symbol = np.array(layered.compliance(q, moduli, poisson, np.array([thickness])).C)
        symbol[0, 0] = 0.0
        return symbol

    return make


def response(shape, make, periodic=True):
    unit = np.zeros(shape)
    unit[0, 0] = 1.0
    whole = Convolution(shape, make(shape, (1.0, 1.0)), periodic)(unit)
    return whole[: shape[0] // 2 + 1, : shape[1] // 2 + 1].copy()


def rough(n, seed=1):
    spectrum = np.fft.rfft2(np.random.default_rng(seed).standard_normal((n, n)))
    k = np.hypot(np.fft.fftfreq(n)[:, None], np.fft.rfftfreq(n))
    k[0, 0] = np.inf
    h = np.fft.irfft2(spectrum * np.where(k < 1.0 / 8.0, k**-1.8, 0.0), s=(n, n))
    return h / h.std()


def test_where_all_pixels_are_near_the_inverse_is_exact():
    """Three by three pixels of a free map: every pixel sees all that come before it."""
    y, x = np.indices((3, 3))
    K = 1.0 / (1.0 + np.hypot(y, 1.3 * x))
    inverse = SparseInverse(K, (3, 3), (1.0, 1.3), False, True, loops_numpy)
    at = np.array([1, 2, 3, 4, 5, 7])
    G = influence_matrix(K, at, (3, 3))
    inverse.prepare(at)
    got = np.stack([inverse(e) for e in np.eye(6, dtype=np.float32)])
    np.testing.assert_allclose(got @ G, np.eye(6), atol=2e-5)
    assert not inverse.lattices.position.any()


@pytest.mark.parametrize("contrast", [1.0, 1e3, 1e6])
def test_the_spectrum_of_inverse_times_operator_is_narrow(contrast):
    """A plate bends over pixels: its operator alone has a condition of a million and more."""
    n = 32
    K = response((n, n), stack(contrast, 0.5))
    at = np.flatnonzero(rough(n).ravel() > 0.7)
    inverse = SparseInverse(K, (n, n), (1.0, 1.0), True, contrast > 1.0, loops_numpy)
    inverse.prepare(at)
    G = influence_matrix(K, at, (n, n)) - K.min()
    L = inverse.factor[0].toarray().astype(np.float64)
    narrow = np.linalg.cond(L @ G @ L.T)
    assert narrow < 60.0
    assert narrow < 0.2 * np.linalg.cond(G)


@pytest.mark.skipif(not NUMBA, reason="needs the extra contactkit[fast]")
@pytest.mark.parametrize("periodic", [True, False])
@pytest.mark.parametrize("steep", [True, False])
@pytest.mark.parametrize("shape", quick([((24, 24),), ((5, 40),), ((2, 3),)], 0, 2), ids=str)
def test_compiled_and_plain_inverses_are_the_same(shape, steep, periodic):
    from contactkit.contact.solver.loops_numba import compiled

    y, x = np.indices(shape)
    dy, dx = (np.minimum(v, n - v) if periodic else v for v, n in zip((y, x), shape, strict=True))
    K = 1.0 / (1.0 + np.hypot(dy, dx))
    K = K[: shape[0] // 2 + 1, : shape[1] // 2 + 1] if periodic else K
    many = np.random.default_rng(0).random(shape) < 0.5
    at = np.flatnonzero(many)
    r = np.random.default_rng(1).standard_normal(at.size).astype(np.float32)
    found = []
    for loops in (loops_numpy, compiled(False)):
        inverse = SparseInverse(K, shape, (1.0, 1.0), periodic, steep, loops)
        for some in (at[::2], at):  # most patterns of the second set are known by then
            inverse.prepare(some)
        found.append(inverse(r))
    np.testing.assert_allclose(*found, atol=2e-6)


def test_lattices_are_nested_and_reach_across_the_map():
    for shape, pixel in (((64, 64), (1.0, 1.0)), ((7, 300), (10.0, 1.0)), ((2, 2), (1.0, 1.0))):
        strides = lattice_strides(shape, pixel)
        assert np.all(strides[1:] % strides[:-1] == 0)
        assert np.all(strides[-1] > np.array(shape) / 4)


@pytest.mark.parametrize("contrast", [1e3, 1e6])
def test_a_stiff_plate_of_half_a_pixel_needs_no_fallback(contrast):
    n = 128
    make = stack(contrast, 5.0 / n / contrast ** (1.0 / 3.0))  # bends over some pixels
    solver = ContactSolver((n, n), (1.0 / n, 1.0 / n), make, periodic=True, fast=False)
    s = solver.solve(1e-2 * rough(n), mean_pressure=2e-2)
    assert s.converged
    assert not s.fallback
    assert s.n_applications <= 150


def test_extrapolated_pressures_start_nearer():
    n = 128
    solver = ContactSolver((n, n), (1.0 / n, 1.0 / n), stack(1.0, 0.1), periodic=True, fast=False)
    h = 1e-2 * rough(n)
    loads = [1e-2, 1.15e-2, 1.15**2 * 1e-2]
    known = [(p, solver.solve(h, mean_pressure=p).pressure) for p in loads[::-1]]
    goal = solver.solve(h, mean_pressure=1.15**3 * 1e-2)
    off = [
        np.abs(
            initial_pressure(known[:k], 1.15**3 * 1e-2, True, (n, n)).pressure - goal.pressure
        ).mean()
        for k in (1, 2, 3)
    ]
    assert max(off[1:]) < 0.6 * off[0]
    warm = solver.solve(h, mean_pressure=1.15**3 * 1e-2, start=known)
    assert warm.n_applications < goal.n_applications
    np.testing.assert_allclose(warm.pressure, goal.pressure, atol=1e-5)


def test_starts_that_cannot_be_are_refused_and_odd_ones_are_taken():
    one = np.ones((2, 2))
    for bad in ([], [(1.0, np.ones(3))], [(1.0, one), (2.0, np.full((2, 2), np.nan))]):
        with pytest.raises(DescriptionError, match="start"):
            initial_pressure(bad, 1.0, True, (2, 2))
    # Nothing to extrapolate in, or the same load: the newest is taken as it is.
    for start, load in ((one, 2.0), ([(1.0, one), (1.0, 2 * one)], 1.1), ([(3.0, one)], 3.0)):
        np.testing.assert_array_equal(initial_pressure(start, load, True, (2, 2)).pressure, one)
    # No ratio of loads: the nested grids start better.
    assert initial_pressure([(0.0, one), (1.0, one)], 2.0, True, (2, 2)) is None


def test_a_borrowed_spectrum_leaves_both_convolutions_right():
    symbol = np.random.default_rng(1).random((6, 5))
    first = Convolution((6, 8), symbol, True)
    second = Convolution((6, 8), symbol, True, dtype=np.float32, idle=IdleMemory(first.spectrum))
    p = np.random.default_rng(2).standard_normal((6, 8))
    a, b = first(p), second(p)
    np.testing.assert_allclose(b, a, atol=1e-5)
    np.testing.assert_array_equal(first(p), a)
    assert second.nbytes < first.nbytes / 2
