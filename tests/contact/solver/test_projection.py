"""Projection in the metric of a sparse inverse, and the inverse on occupied cells."""

from __future__ import annotations

import importlib.util

import numpy as np
import pytest
import scipy.optimize
import scipy.sparse

from contactkit.contact.solver import loops_numpy
from contactkit.contact.solver.cell_inverse import CellInverse, cell_levels, cell_sizes
from contactkit.contact.solver.projection import Projection
from contactkit.contact.solver.reduced_system import influence_matrix

NUMBA = importlib.util.find_spec("numba") is not None
ANY = np.random.default_rng(3)


def plate(shape, periodic):
    """Response that falls off over some pixels, of a condition that a pixel alone cannot cure."""
    y, x = np.indices(shape)
    dy, dx = (np.minimum(v, n - v) if periodic else v for v, n in zip((y, x), shape, strict=True))
    K = np.exp(-(np.hypot(dy, dx) ** 1.2) / 3.0)
    return K[: shape[0] // 2 + 1, : shape[1] // 2 + 1] if periodic else K


def inverse_of(K, shape, periodic, loops=loops_numpy, reach=1):
    return CellInverse(lambda: K, shape, (1.0, 1.0), periodic, loops, reach)


@pytest.mark.parametrize("load_fixed", [True, False])
@pytest.mark.parametrize("most", [0.5, np.inf])
def test_projection_is_the_bounded_minimum_in_its_metric(load_fixed, most):
    n = 30
    L = np.tril(ANY.normal(size=(n, n)) * 0.3) + 2.0 * np.eye(n)
    x = ANY.normal(size=n).astype(np.float32)
    if load_fixed:
        x -= x.mean()
    low, high = np.full(n, -0.4, np.float32), np.full(n, most, np.float32)
    factor = scipy.sparse.csr_array(L.astype(np.float32))
    found = Projection(factor, low, high, load_fixed, tolerance=1e-4)(x)
    M = np.linalg.inv(L.T @ L)
    best = scipy.optimize.minimize(
        lambda y: ((y - x) @ M @ (y - x), 2.0 * M @ (y - x)),
        np.zeros(n),
        jac=True,
        method="SLSQP",
        bounds=[(-0.4, most)] * n,
        constraints={"type": "eq", "fun": np.sum, "jac": np.ones_like} if load_fixed else (),
        options={"ftol": 1e-14, "maxiter": 500},
    )
    assert best.success
    np.testing.assert_allclose(found.change, best.x, atol=1e-3)
    np.testing.assert_array_equal(found.change[found.side < 0], np.float32(-0.4))


def test_what_is_within_the_bounds_stays():
    x = np.array([0.5, 1.0], np.float32)
    factor = scipy.sparse.eye_array(2, dtype=np.float32, format="csr")
    found = Projection(factor, np.zeros_like(x), np.ones_like(x), True)(x)
    np.testing.assert_array_equal(found.change, x)
    assert not found.side.any()


@pytest.mark.parametrize("periodic", [True, False])
def test_projected_residual_goes_downhill(periodic):
    """``r d >= d M d > 0`` for the projection d of ``K r``, whatever the residual."""
    shape = (24, 20)
    inverse = inverse_of(plate(shape, periodic), shape, periodic)
    at = np.flatnonzero(ANY.random(shape) < 0.3)
    inverse.prepare(at)
    for _ in range(5):
        r = ANY.normal(size=at.size).astype(np.float32)
        low = -ANY.random(at.size).astype(np.float32) * (ANY.random(at.size) < 0.5)
        d = Projection(inverse.factor, low, np.full_like(r, np.inf), False)(inverse(r))
        w = np.linalg.solve(inverse.factor.toarray().astype(float).T, d.change)
        dMd = float(np.sum(np.linalg.solve(inverse.factor.toarray().astype(float), w) * d.change))
        assert float(r @ d.change) > 0.9 * dMd > 0.0


@pytest.mark.parametrize("periodic", [True, False])
def test_scattered_spots_have_a_narrow_spectrum(periodic):
    shape = (32, 48)
    K = plate(shape, periodic)
    spots = np.flatnonzero(ANY.random(shape) < 0.15)  # hardly any on a lattice of four pixels
    G = influence_matrix(K, spots, shape)
    inverse = inverse_of(K, shape, periodic)
    inverse.prepare(spots)
    L = inverse.factor.toarray().astype(np.float64)
    assert np.linalg.cond(L @ G @ L.T) < min(4.0, 0.2 * np.linalg.cond(G))


@pytest.mark.parametrize("reach", [1, 2])
def test_where_all_pixels_are_neighbours_the_inverse_is_exact(reach):
    K = plate((3, 3), False)
    at = np.array([1, 2, 3, 4, 5, 7])
    inverse = inverse_of(K, (3, 3), False, reach=2)
    inverse.prepare(at)
    got = np.stack([inverse(e) for e in np.eye(6, dtype=np.float32)])
    np.testing.assert_allclose(got @ influence_matrix(K, at, (3, 3)), np.eye(6), atol=2e-5)


@pytest.mark.parametrize("periodic", [True, False])
def test_rows_that_are_kept_are_those_made_anew(periodic):
    shape = (20, 31)
    K = plate(shape, periodic)
    kept = inverse_of(K, shape, periodic)
    there = ANY.random(shape) < 0.4
    for _ in range(4):
        there ^= ANY.random(shape) < 0.03
        at = np.flatnonzero(there)
        new = inverse_of(K, shape, periodic)
        kept.prepare(at)
        new.prepare(at)
        np.testing.assert_array_equal(kept.factor.toarray(), new.factor.toarray())


@pytest.mark.skipif(not NUMBA, reason="needs the extra contactkit[fast]")
@pytest.mark.parametrize("periodic", [True, False])
@pytest.mark.parametrize("shape", [(24, 24), (5, 40), (2, 3), (33, 17)])
@pytest.mark.parametrize("reach", [1, 2])
def test_compiled_and_plain_rows_are_the_same(shape, periodic, reach):
    from contactkit.contact.solver.loops_numba import compiled

    there = ANY.random(shape) < 0.5
    there[0, 0] = True
    K, at = plate(shape, periodic), np.flatnonzero(there)
    factors = []
    for loops in (loops_numpy, compiled(False)):
        inverse = inverse_of(K, shape, periodic, loops, reach)
        inverse.prepare(at)
        factors.append(inverse.factor.toarray())
    np.testing.assert_allclose(*factors, rtol=1e-5, atol=1e-6 * np.abs(factors[0]).max())


@pytest.mark.parametrize("shape", [(16, 16), (7, 30), (2, 2), (1, 9)])
def test_every_occupied_cell_has_one_pixel_of_its_own(shape):
    at = np.flatnonzero(ANY.random(shape) < 0.3)
    sizes = cell_sizes(shape, (1.0, 1.0))
    cells = cell_levels(at, shape, sizes)
    row, column = np.divmod(at, shape[1])
    for n, (sy, sx) in enumerate(sizes):
        ny, nx = cells.counts[n]
        table = cells.table[cells.first[n] : cells.first[n + 1]]
        occupied = np.unique(row // sy * nx + column // sx)
        np.testing.assert_array_equal(np.flatnonzero(table >= 0), occupied)
        who = table[occupied]
        np.testing.assert_array_equal(who // shape[1] // sy * nx + who % shape[1] // sx, occupied)
        assert np.all(cells.level[np.searchsorted(at, who)] >= n)
        assert table.size == ny * nx
    assert np.sum(cells.level == len(sizes) - 1) == (at.size > 0)


def test_a_step_costs_what_is_held_not_what_is_in_contact():
    """A wide contact, few pixels of which leave their bounds."""
    shape = (24, 24)
    inverse = inverse_of(plate(shape, True), shape, True)
    inverse.prepare(np.arange(24 * 24))
    x = np.ones(24 * 24, np.float32)
    x[:12] = -2.0
    low, high = np.full(x.size, -1.0, np.float32), np.full(x.size, np.inf, np.float32)
    projection = Projection(inverse.factor, low, high, False)
    found = projection(x)
    assert projection.steps > 0
    assert 12 <= np.count_nonzero(found.side) < 60
    assert 0.0 < projection.work < 0.2 * projection.steps
