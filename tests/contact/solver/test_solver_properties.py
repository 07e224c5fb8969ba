"""What must hold of any contact: scaling, symmetry, optimality, monotony, both paths alike."""

from __future__ import annotations

import importlib.util
import itertools

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from contactkit.contact.solver import loops_numpy
from contactkit.contact.solver.contact_solver import ContactSolver
from contactkit.contact.solver.convolution import Convolution, self_influence, symbol_of
from contactkit.contact.solver.problem import clip_to_load
from contactkit.contact.solver.reduced_system import influence_matrix, solve_directly
from contactkit.contact.solver.transfer import block_shape, nested_shapes, prolong, restrict
from contactkit.contact.solver.two_level import CoarseBlocks, inverse_stencil, least_eigenvalue
from contactkit.elasticity import influence as free_kernel
from contactkit.errors import DescriptionError
from contactkit.numerics.fft import fast_transforms_installed

ANY = np.random.default_rng(0)
INSTALLED = fast_transforms_installed() and importlib.util.find_spec("numba") is not None


def half_space(shape, pixel_size, modulus=1.0):
    qy = 2.0 * np.pi * np.fft.fftfreq(shape[0], pixel_size[0])[:, None]
    qx = 2.0 * np.pi * np.fft.rfftfreq(shape[1], pixel_size[1])
    q = np.hypot(qy, qx)
    return np.divide(2.0 / modulus, q, out=np.zeros_like(q), where=q > 0.0)


def coulomb(shape, pixel_size):
    """Influence like 1 / distance on the doubled map, for nearly square pixels."""
    y = pixel_size[0] * np.minimum(np.arange(2 * shape[0]), 2 * shape[0] - np.arange(2 * shape[0]))
    x = pixel_size[1] * np.minimum(np.arange(2 * shape[1]), 2 * shape[1] - np.arange(2 * shape[1]))
    area = pixel_size[0] * pixel_size[1]
    r = np.hypot(y[:, None], x)
    r[0, 0] = 0.28 * np.sqrt(area)
    return np.fft.rfft2(area / (np.pi * r)).real


def free_half_space(shape, pixel_size):
    return free_kernel.symbol(shape, pixel_size, [1.0], [0.0])


def rough(shape, seed=0):
    spectrum = np.fft.rfft2(np.random.default_rng(seed).standard_normal(shape))
    k = np.hypot(np.fft.fftfreq(shape[0])[:, None], np.fft.rfftfreq(shape[1]))
    k[0, 0] = np.inf
    h = np.fft.irfft2(spectrum * k**-1.8, s=shape)
    return h / h.std()


@pytest.mark.parametrize(("maker", "periodic"), [(half_space, True), (coulomb, False)])
def test_units_do_not_matter(maker, periodic):
    """Nanometres and gigapascals take the same steps to the same answer as metres and pascals."""
    h = rough((40, 40))
    one = ContactSolver((40, 40), (1.0, 1.0), maker, periodic, fast=False)
    a = one.solve(h, mean_pressure=0.1)

    def tiny(shape, pixel_size):
        return maker(shape, pixel_size) * 1e-9 / 1e9

    b = ContactSolver((40, 40), (1.0, 1.0), tiny, periodic, fast=False).solve(
        h * 1e-9, mean_pressure=0.1 * 1e9
    )
    assert a.n_applications == b.n_applications
    np.testing.assert_allclose(b.pressure, a.pressure * 1e9, rtol=1e-5, atol=1e-3)
    assert b.rigid_approach == pytest.approx(a.rigid_approach * 1e-9, rel=1e-9)
    assert b.energy == pytest.approx(a.energy, rel=1e-8)


@given(
    ny=st.integers(2, 70),
    nx=st.integers(2, 70),
    load=st.floats(1e-6, 3.0),
    aspect=st.floats(0.1, 10.0),
    seed=st.integers(0, 99),
    periodic=st.booleans(),
    bound=st.none() | st.floats(1.05, 30.0),
)
def test_any_map_converges_to_its_conditions(ny, nx, load, aspect, seed, periodic, bound):
    maker = half_space if periodic else free_half_space
    solver = ContactSolver((ny, nx), (aspect, 1.0), maker, periodic, fast=False)
    h = rough((ny, nx), seed)
    s = solver.solve(h, mean_pressure=load, bound=None if bound is None else bound * load)
    assert s.converged
    assert s.pressure.min() >= 0.0
    assert s.pressure.mean() == pytest.approx(load, rel=1e-11)
    if bound is not None:
        assert s.pressure.max() <= bound * load * (1.0 + 1e-12)
    gap = solver.displacement(s.pressure) - h - s.rigid_approach
    assert (
        np.abs(gap * s.pressure)[s.pressure < 0.999 * (bound or np.inf) * load].max(initial=0.0)
        <= 1e-7 * s.pressure.max() + 1e-9
    )


@pytest.mark.parametrize(("maker", "periodic"), [(half_space, True), (coulomb, False)])
def test_load_and_level_are_two_ways_to_one_contact(maker, periodic):
    h = rough((50, 44))
    solver = ContactSolver((50, 44), (1.0, 1.0), maker, periodic, fast=False)
    by_load = solver.solve(h, mean_pressure=0.05, bound=0.6)
    by_approach = solver.solve(h, rigid_approach=by_load.rigid_approach, bound=0.6)
    assert by_approach.converged
    np.testing.assert_allclose(by_approach.pressure, by_load.pressure, atol=1e-6)


def test_turning_the_map_turns_the_answer():
    h = rough((36, 52))
    a = ContactSolver((36, 52), (1.0, 2.0), half_space, True, fast=False).solve(
        h, mean_pressure=0.1
    )
    b = ContactSolver((52, 36), (2.0, 1.0), half_space, True, fast=False).solve(
        h.T, mean_pressure=0.1
    )
    np.testing.assert_allclose(b.pressure, a.pressure.T, atol=1e-6)


def test_a_shifted_periodic_map_has_the_shifted_answer():
    h = rough((45, 45))
    solver = ContactSolver((45, 45), (1.0, 1.0), half_space, True, fast=False)
    a = solver.solve(h, mean_pressure=0.1).pressure
    b = solver.solve(np.roll(h, (7, 20), (0, 1)), mean_pressure=0.1).pressure
    np.testing.assert_allclose(np.roll(a, (7, 20), (0, 1)), b, atol=1e-6)


def test_energy_is_the_least_and_its_slope_is_the_approach():
    """Any other feasible pressure has more energy; dE/dP = level (the gap taken up)."""
    h = rough((40, 40))
    solver = ContactSolver((40, 40), (1.0, 1.0), half_space, True, fast=False)
    s = solver.solve(h, mean_pressure=0.1)
    rng = np.random.default_rng(8)
    for _ in range(5):
        p = s.pressure * rng.uniform(0.9, 1.1, h.shape)
        p *= s.pressure.sum() / p.sum()
        assert 0.5 * np.vdot(p, solver.displacement(p)) - np.vdot(h, p) > s.energy
    step = 1e-4
    up = solver.solve(h, mean_pressure=0.1 + step).energy
    down = solver.solve(h, mean_pressure=0.1 - step).energy
    assert (up - down) / (2.0 * step * h.size) == pytest.approx(s.rigid_approach, rel=1e-5)


def test_area_grows_with_the_load_and_a_bound_makes_it_larger():
    h = rough((64, 64))
    solver = ContactSolver((64, 64), (1.0, 1.0), half_space, True, fast=False)
    loads = (0.005, 0.01, 0.03, 0.1)
    elastic = [np.count_nonzero(solver.solve(h, mean_pressure=p).pressure) for p in loads]
    bounded = [
        np.count_nonzero(solver.solve(h, mean_pressure=p, bound=0.3).pressure) for p in loads
    ]
    assert np.all(np.diff(elastic) > 0)
    assert all(c >= e for c, e in zip(bounded, elastic, strict=True))
    assert bounded[-1] > elastic[-1]


def test_the_number_of_applications_does_not_grow_with_the_map():
    counts = []
    for n in (64, 128, 256):
        k = np.hypot(np.fft.fftfreq(256)[:, None], np.fft.rfftfreq(256))
        k[0, 0] = np.inf
        spectrum = np.fft.rfft2(np.random.default_rng(2).standard_normal((256, 256))) * k**-1.8
        h = np.fft.irfft2(np.where(k < 1.0 / 16.0, spectrum, 0.0), s=(256, 256))[
            :: 256 // n, :: 256 // n
        ]
        solver = ContactSolver((n, n), (1.0 / n, 1.0 / n), half_space, True, fast=False)
        s = solver.solve(h / h.std() * 1e-2, mean_pressure=5e-3)
        assert s.converged
        assert not s.fallback
        counts.append(s.n_applications)
    assert counts[-1] <= 45
    bounded = solver.solve(h / h.std() * 1e-2, mean_pressure=5e-3, bound=0.5 * s.pressure.max())
    assert bounded.n_applications <= 2 * counts[-1]
    assert bounded.converged
    assert s.memory_arrays <= 10.0


def test_a_warm_start_saves_applications():
    h = rough((128, 128))
    solver = ContactSolver((128, 128), (1.0, 1.0), half_space, True, fast=False)
    first = solver.solve(h, mean_pressure=0.1)
    again = solver.solve(h, mean_pressure=0.1, start=first.pressure)
    assert again.n_applications <= 3
    warm = solver.solve(h, mean_pressure=0.101, start=first.pressure)
    cold = solver.solve(h, mean_pressure=0.101)
    assert warm.n_applications < cold.n_applications
    np.testing.assert_allclose(warm.pressure, cold.pressure, atol=1e-6)


@pytest.mark.skipif(not INSTALLED, reason="needs the extra contactkit[fast]")
@pytest.mark.parametrize(
    ("maker", "periodic", "threads"), [(half_space, True, 1), (coulomb, False, 2)]
)
def test_both_paths_take_the_same_steps(maker, periodic, threads):
    h = rough((128, 128))
    plain = ContactSolver((128, 128), (1.0, 1.0), maker, periodic, fast=False)
    fast = ContactSolver((128, 128), (1.0, 1.0), maker, periodic, threads=threads, fast=True)
    for bound in (None, 1.0):
        a, b = (x.solve(h, mean_pressure=0.05, bound=bound) for x in (plain, fast))
        assert abs(a.n_applications - b.n_applications) <= 2
        np.testing.assert_allclose(b.pressure, a.pressure, atol=1e-6)


# The parts ------------------------------------------------------------------------------------


@pytest.mark.parametrize("shape", [(6, 8), (5, 7), (2, 9)])
def test_free_convolution_is_the_double_sum(shape):
    symbol = coulomb(shape, (1.0, 1.5))
    p = ANY.standard_normal(shape)
    y, x = np.indices(shape).reshape(2, -1)
    r = np.hypot(y[:, None] - y, 1.5 * (x[:, None] - x))
    r[r == 0.0] = 0.28 * np.sqrt(1.5)
    u = ((1.5 / (np.pi * r)) @ p.ravel()).reshape(shape)
    np.testing.assert_allclose(Convolution(shape, symbol, False)(p), u, rtol=1e-12)
    assert self_influence(symbol, 2 * shape[1]) == pytest.approx(1.5 / (np.pi * 0.28 * 1.5**0.5))


@pytest.mark.parametrize("shape", [(6, 8), (5, 7)])
def test_periodic_convolution_of_a_wave_is_that_wave(shape):
    y, x = np.indices(shape)
    p = np.cos(2.0 * np.pi * (y / shape[0] + 2.0 * x / shape[1]) + 0.3)
    q = 2.0 * np.pi * np.hypot(1.0 / shape[0], 2.0 / shape[1])
    u = Convolution(shape, half_space(shape, (1.0, 1.0)), True)(p)
    np.testing.assert_allclose(u, 2.0 / q * p, atol=1e-13)


def test_a_symbol_of_the_wrong_sign_or_shape_is_refused():
    for bad in (np.ones((4, 4)), -np.ones((4, 3)), np.full((4, 3), np.nan)):
        with pytest.raises(DescriptionError, match="symbol"):
            symbol_of(lambda shape, pixel, bad=bad: bad, (4, 4), (1.0, 1.0), True)


@given(ny=st.integers(2, 40), nx=st.integers(2, 40))
def test_grid_transfer_keeps_mean_and_duality(ny, nx):
    rng = np.random.default_rng(ny * 41 + nx)
    fine, coarse = (ny, nx), (-(-ny // 2), -(-nx // 2))
    h, p = rng.standard_normal(fine), rng.standard_normal(coarse)
    assert restrict(h, coarse).mean() == pytest.approx(h.mean(), abs=1e-13)
    assert prolong(p, fine).mean() == pytest.approx(p.mean(), abs=1e-13)
    # Work of pressures on heights, per area, is the same on both grids.
    assert np.mean(prolong(p, fine) * h) == pytest.approx(np.mean(p * restrict(h, coarse)))


def test_nested_shapes_end_small_and_square_their_pixels():
    for shape, pixel in (
        ((1000, 1000), (1.0, 1.0)),
        ((64, 4096), (10.0, 1.0)),
        ((2, 3000), (1, 1)),
    ):
        shapes = nested_shapes(shape, pixel)
        assert shapes[0] == shape
        assert max(shapes[-1]) <= 64
        assert all(a != b for a, b in itertools.pairwise(shapes))
    assert block_shape((640, 6400), (10.0, 1.0)) == pytest.approx((253, 253), abs=1)


@pytest.mark.parametrize("power", [0.0, 0.5, 1.0, 2.0, 3.0])
def test_the_stencil_of_any_solid_is_positive_definite(power):
    q = half_space((32, 32), (1.0, 1.0))
    stencil = inverse_stencil(np.where(q > 0.0, q, 1.0) ** power, 32)
    assert least_eigenvalue(stencil) > 0.0


def test_coarse_blocks_solve_their_own_equations():
    blocks = CoarseBlocks((32, 32), (4, 4), half_space((4, 4), (8.0, 8.0)), True, loops_numpy)
    count = ANY.integers(0, 64, 16).astype(float)
    blocks.weigh(count, True)
    total = count * ANY.standard_normal(16)
    total -= count * total.sum() / count.sum()
    y = blocks.solve(total, reduction=1e-5, max_iterations=100)
    w = np.sqrt(count).astype(np.float32)
    back = np.empty_like(w)
    blocks.apply((w * y).astype(np.float32), back)
    np.testing.assert_allclose(back * w, total, atol=1e-3 * np.abs(total).max())


def test_direct_solution_meets_load_and_level():
    K = Convolution((12, 12), half_space((12, 12), (1.0, 1.0)), True)(
        np.eye(144)[0].reshape(12, 12)
    )
    at = np.sort(ANY.choice(144, 20, replace=False))
    G, r = influence_matrix(K, at, (12, 12)), ANY.standard_normal(20)
    x = solve_directly(G.copy(), r, 3.0)
    assert x.sum() == pytest.approx(3.0)
    assert np.ptp(G @ x - r) < 1e-10
    np.testing.assert_allclose(G @ solve_directly(G.copy(), r, None), r, atol=1e-10)


@given(load=st.floats(0.01, 9.9), seed=st.integers(0, 50))
def test_projection_to_the_load_is_the_nearest(load, seed):
    rng = np.random.default_rng(seed)
    trial, bound = rng.standard_normal(10) * 3.0, np.full(10, 1.0)
    p = clip_to_load(trial, bound, load)
    assert p.sum() == pytest.approx(load, rel=1e-12)
    for _ in range(5):
        other = rng.dirichlet(np.ones(10)) * load
        if other.max() <= 1.0:
            assert np.sum((other - trial) ** 2) >= np.sum((p - trial) ** 2) - 1e-9
