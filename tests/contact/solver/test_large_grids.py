"""What large grids do otherwise: idle memory, responses made when called for, threads."""

from __future__ import annotations

import numpy as np
import pytest
from selection import quick

from contactkit.contact.solver import loops_numpy
from contactkit.contact.solver.contact_solver import ContactSolver
from contactkit.contact.solver.idle_memory import IdleMemory
from contactkit.contact.solver.unit_response import unit_response
from contactkit.elasticity import influence, love
from contactkit.numerics import fft as fft_backends
from contactkit.numerics.fft import mirrored_half

N = 96


def free_half_space(shape, pixel_size):
    return influence.symbol(shape, pixel_size, [1.0], [0.0])


def solver(**given):
    return ContactSolver((N, N), (1.0 / N, 1.0 / N), free_half_space, False, **given)


def ball(radius, rough=0.0):
    x = (np.arange(N) + 0.5) / N - 0.5
    noise = rough * np.random.default_rng(0).standard_normal((N, N))
    return noise - (x[:, None] ** 2 + x**2) / (2.0 * radius)


@pytest.mark.parametrize("load", [1e-4, 4e-3], ids=["few pixels", "patch"])
def test_a_large_isolated_map_makes_its_response_when_it_needs_it(monkeypatch, load):
    """Taken for a large one, a small map gives what it gives as a small one."""
    heights = ball(1.0, 1e-4)
    small = solver()
    expected = small.solve(heights, mean_pressure=load)
    monkeypatch.setattr(fft_backends, "CACHED_BYTES", 0)
    large = solver()
    fine = large.grids[0]
    assert small.grids[0].response.nbytes == 8 * N**2
    assert fine.response.nbytes == 0
    saved = small.nbytes - large.nbytes  # nor are the zero rows of the spectrum held
    assert saved > 2.5 * 8 * N**2
    for _ in range(2):  # nothing is left of the solve before in the memory that is shared
        found = large.solve(heights, mean_pressure=load)
        assert found.converged
        assert abs(found.n_applications - expected.n_applications) <= 1
        scale = expected.pressure.max()
        np.testing.assert_allclose(found.pressure, expected.pressure, atol=1e-6 * scale)
    np.testing.assert_allclose(fine.response(), small.grids[0].response(), rtol=1e-9)
    for one in (fine.change, fine.quick.target):  # in the spectrum of the exact operator
        assert np.shares_memory(one, fine.exact.spectrum)
    assert not np.shares_memory(fine.change, fine.quick.target)
    assert not np.shares_memory(fine.change, fine.quick.spectrum)


def test_idle_memory_is_lent_once():
    idle = IdleMemory(np.zeros((10, 10), np.complex64))
    first, second = idle.take((3, 3), np.float32), idle.take((5, 8), np.float64)
    first[...], second[...] = 1.0, 2.0
    assert first.sum() == 9.0
    assert second.sum() == 80.0
    assert idle.take((100,), np.float64).base is None  # no room left


def sizes_and_bounds():
    yield 1, np.array([np.inf])
    yield 70, np.array([0.8])
    rng = np.random.default_rng(1)
    yield 1000, np.where(rng.random(1000) < 0.1, 0.0, rng.choice([0.8, np.inf], 1000))


@pytest.mark.parametrize("threaded", quick([False, True], 0))
def test_compiled_loops_find_the_same_pixels_and_sums(threaded):
    pytest.importorskip("numba")
    from contactkit.contact.solver.loops_numba import compiled

    rng, loops = np.random.default_rng(2), compiled(threaded)
    for n, upper in sizes_and_bounds():
        p = np.clip(rng.standard_normal(n), 0.0, upper)
        g = rng.standard_normal(n)
        one, two = loops_numpy.free_set(p, g, upper, 0.1), loops.free_set(p, g, upper, 0.1)
        assert np.array_equal(one.at, two.at)
        assert one.added == two.added
        assert two.at.dtype == np.intp
        sums, others = loops_numpy.free_sums(p, g, upper), loops.free_sums(p, g, upper)
        np.testing.assert_allclose(others, sums, rtol=1e-12)
        assert sums.total == pytest.approx(p.sum(), rel=1e-12)


def test_loops_take_the_threads_of_the_solver(monkeypatch):
    numba = pytest.importorskip("numba")
    from contactkit.contact.solver.loops_numba import compiled

    asked = []
    monkeypatch.setattr(numba, "set_num_threads", asked.append)
    before = numba.get_num_threads()
    most = numba.config.NUMBA_NUM_THREADS
    for wanted in (1, most + 1):
        with compiled(True).on_threads(wanted):
            assert asked == [min(wanted, most)]
        assert asked == [min(wanted, most), before]
        asked.clear()
    with compiled(False).on_threads(2), loops_numpy.on_threads(2):
        assert not asked  # serial: nothing to set


@pytest.mark.parametrize("shape", [(150, 150), (150, 140)])
@pytest.mark.parametrize("pixel", [(1.0, 1.0), (1.0, 1.3)])
def test_coefficients_mirrored_at_the_diagonal_are_those_of_love(shape, pixel):
    found = influence.coefficients(shape, pixel, [2.0], [0.3])
    y, x = (d * np.arange(n + 1.0) for n, d in zip(shape, pixel, strict=True))
    wanted = love.rectangle(x, y[:, None], 0.5 * pixel[1], 0.5 * pixel[0], 2.0 / 0.91)
    np.testing.assert_allclose(found, wanted, rtol=1e-13)


@pytest.mark.parametrize("edges", [True, False, "x", "y"])
@pytest.mark.parametrize("shape", [(6, 8), (5, 8), (6, 7)])
def test_the_unit_response_is_the_transform_of_the_whole_symbol(edges, shape):
    height, width = (
        n * (1 if edges in (True, axis) else 2) for n, axis in zip(shape, "yx", strict=True)
    )
    y, x = np.indices((height, width))
    apart = np.hypot(np.minimum(y, height - y), 1.3 * np.minimum(x, width - x))
    map_of = 1.0 / (1.0 + apart)
    symbol = np.fft.rfft2(map_of).real
    part = (shape[0] // 2 + 1, shape[1] // 2 + 1) if edges is True else shape
    for given in (symbol, mirrored_half(symbol)):
        found = unit_response(given, shape, edges)
        np.testing.assert_allclose(found, map_of[: part[0], : part[1]], rtol=1e-13)
