"""The contact solver against closed forms: waves, a ball, a punch, full contact, bounds."""

from __future__ import annotations

import functools
import json
from pathlib import Path

import numpy as np
import pytest
from selection import quick

from contactkit.contact.solver import optimality as kkt
from contactkit.contact.solver.contact_solver import ContactSolver
from contactkit.contact.solver.problem import pose
from contactkit.contact.solver.reference_solvers import conjugate_gradient, quasi_newton
from contactkit.elasticity import influence as free_kernel
from contactkit.elasticity import layered

WAVES = json.loads((Path(__file__).parents[2] / "data" / "press_waves.json").read_text())
E_STAR = 1.0
NU = 0.3
E = E_STAR * (1.0 - NU**2)


def layers(moduli, poisson, thickness):
    def make(shape, pixel_size):
        qy = 2.0 * np.pi * np.fft.fftfreq(shape[0], pixel_size[0])[:, None]
        qx = 2.0 * np.pi * np.fft.rfftfreq(shape[1], pixel_size[1])
        q = np.hypot(qy, qx)
        q[0, 0] = 1.0
        symbol = np.array(layered.compliance(q, moduli, poisson, thickness).C)
        symbol[0, 0] = 0.0
        return symbol

    return make


half_space = layers(np.array([E]), np.array([NU]), np.array([]))
free_half_space = functools.partial(free_kernel.symbol, young_modulus=[E], poisson_ratio=[NU])


def wave(nx, ny=4):
    """Profile -(1 - cos) of unit length and amplitude, crest in the middle of a pixel."""
    x = (np.arange(nx) - nx // 2) / nx
    return np.broadcast_to(-(1.0 - np.cos(2.0 * np.pi * x)), (ny, nx)).copy()


@pytest.mark.parametrize("row", WAVES["homogeneous"][1:6], ids=lambda r: f"a={r['a/lambda']}")
def test_wave_on_a_half_space(row):
    nx = 512
    press = ContactSolver((4, nx), (1.0 / nx, 1.0 / nx), half_space, periodic=True, fast=False)
    s = press.solve(wave(nx), mean_pressure=row["pbar"])
    assert s.converged
    assert s.pressure.max() == pytest.approx(row["p(0)"], rel=4e-3)
    gap = s.displacement - wave(nx) - s.rigid_approach
    assert gap.mean() == pytest.approx(row["mean_gap"], rel=1e-2, abs=2e-5)
    assert np.mean(s.pressure > 0.0) == pytest.approx(2.0 * row["a/lambda"], abs=2.1 / nx)


@pytest.mark.parametrize("stack", WAVES["layered"], ids=lambda s: s["name"])
def test_wave_on_layers(stack):
    nx = 512
    modulus, poisson, thickness = np.array(stack["layers"]).T
    make = layers(np.append(modulus * E, E), np.append(poisson, 0.3), thickness)
    press = ContactSolver((4, nx), (1.0 / nx, 1.0 / nx), make, periodic=True, fast=False)
    for row in stack["rows"][1:]:
        s = press.solve(wave(nx), mean_pressure=row["pbar"])
        assert s.converged
        assert s.pressure.max() == pytest.approx(row["p(0)"], rel=1e-2)
        gap = s.displacement - wave(nx) - s.rigid_approach
        assert gap.mean() == pytest.approx(row["mean_gap"], rel=2e-2, abs=2e-4)


def test_full_contact_of_a_wave():
    """Beyond the flattening pressure the pressure is the wave itself: mean + pi E* cos."""
    nx = 64
    press = ContactSolver((6, nx), (1.0 / nx, 1.0 / nx), half_space, periodic=True, fast=False)
    s = press.solve(wave(nx, 6), mean_pressure=1.3 * np.pi)
    np.testing.assert_allclose(s.pressure, np.pi * (1.3 + wave(nx, 6) + 1.0), atol=1e-6)


def test_ball_on_a_half_space():
    """Hertz: a^3 = 3 P R / (4 E*), p0 = 3 P / (2 pi a^2), approach a^2 / R."""
    n, radius, a = 128, 10.0, 0.3
    x = (np.arange(n) + 0.5) / n - 0.5
    heights = -(x[:, None] ** 2 + x**2) / (2.0 * radius)
    force = 4.0 * E_STAR * a**3 / (3.0 * radius)
    press = ContactSolver((n, n), (1.0 / n, 1.0 / n), free_half_space, periodic=False, fast=False)
    s = press.solve(heights, mean_pressure=force)
    assert s.converged
    assert s.rigid_approach == pytest.approx(a**2 / radius, rel=1e-3)
    assert s.pressure.max() == pytest.approx(1.5 * force / (np.pi * a**2), rel=2e-3)
    assert np.mean(s.pressure > 0.0) == pytest.approx(np.pi * a**2, rel=1e-2)
    # Complementary energy at fixed load: p'Gp/2 - h'p; the elastic part is 2/5 of P delta.
    work = float(np.sum(s.pressure * heights)) / n**2
    assert s.energy + work == pytest.approx(0.4 * force * a**2 / radius, rel=2e-3)


def test_flat_map_periodic_and_free():
    """A flat map carries its load evenly; a flat square punch is loaded most at its corners."""
    n = 32
    flat = np.full((n, n), 3.0)
    even = ContactSolver((n, n), (1.0, 1.0), half_space, periodic=True, fast=False)
    s = even.solve(flat, mean_pressure=0.25)
    np.testing.assert_allclose(s.pressure, 0.25, rtol=1e-12)
    punch = ContactSolver((n, n), (1.0 / n, 1.0 / n), free_half_space, periodic=False, fast=False)
    s = punch.solve(flat, mean_pressure=0.25)
    assert s.converged
    # Square punch of unit side: P = 1.1507 E* delta, delta the approach (e.g. Borodachev 1976).
    assert 0.25 / (s.rigid_approach + 3.0) == pytest.approx(1.1507, rel=1.5e-2)
    assert s.pressure[0, 0] == pytest.approx(s.pressure.max(), rel=1e-6)
    assert s.pressure[0, 0] > 5.0 * s.pressure[n // 2, n // 2]


def test_a_wave_with_a_pressure_bound_matches_an_independent_solver():
    """The bound changes the elastic answer elsewhere too: compare with L-BFGS-B and with CG."""
    n = 16
    rng = np.random.default_rng(3)
    heights = rng.standard_normal((n, n)) * 1e-2 + wave(n, n)
    press = ContactSolver((n, n), (1.0 / n, 1.0 / n), half_space, periodic=True, fast=False)
    s = press.solve(heights, mean_pressure=0.8, bound=2.0)
    assert s.converged
    assert np.count_nonzero(np.isclose(s.pressure, 2.0, rtol=1e-12)) > 10
    problem = pose(heights, press.self_influence, mean_pressure=0.8, bound=2.0)
    symbol = half_space((n, n), (1.0 / n, 1.0 / n)) / press.self_influence

    def apply(p):
        return np.fft.irfft2(symbol * np.fft.rfft2(p.reshape(n, n)), s=(n, n)).ravel()

    start = np.full(n * n, problem.load / n**2)
    for solver in (conjugate_gradient, quasi_newton):
        p = solver(apply, problem, start, float(symbol.max())).pressure * problem.pressure
        np.testing.assert_allclose(p.reshape(n, n), s.pressure, rtol=0.0, atol=1e-6)
    for method in ("conjugate-gradient", "quasi-newton"):
        plain = press.solve(heights, mean_pressure=0.8, bound=2.0, rtol=1e-6, method=method)
        assert plain.converged
        assert plain.rigid_approach == pytest.approx(s.rigid_approach, rel=1e-6)


@pytest.mark.parametrize("approach", quick([None, 0.3], 0), ids=["load", "approach"])
@pytest.mark.parametrize("solver", [conjugate_gradient, quasi_newton])
def test_the_outcome_does_not_hang_on_the_last_bits(solver, approach):
    """As of another CPU, BLAS or Fourier transform: every product off by 1e-15 at random."""
    n = 16
    heights = np.random.default_rng(3).standard_normal((n, n)) * 0.1 + wave(n, n)
    symbol = half_space((n, n), (1.0 / n, 1.0 / n))
    symbol *= n**2 / symbol.sum()
    load = 0.8 if approach is None else None
    problem = pose(heights, 1.0, mean_pressure=load, rigid_approach=approach, bound=4.0)

    def outcome(off, rtol, seed=0):
        rng = np.random.default_rng(seed)

        def apply(p):
            u = np.fft.irfft2(symbol * np.fft.rfft2(p.reshape(n, n)), s=(n, n)).ravel()
            return u * (1.0 + off * rng.standard_normal(u.size))

        return solver(apply, problem, np.full(n * n, 0.8), float(symbol.max()), rtol=rtol)

    exact = outcome(0.0, 1e-10)
    for seed in range(3):
        found = outcome(1e-15, 1e-10, seed)
        assert found.relative <= 1e-10
        assert len(found.history) <= 1.2 * len(exact.history) + 1.0
        np.testing.assert_allclose(found.pressure, exact.pressure, rtol=0.0, atol=1e-8)
    # Asked for more than there is, it gives the best that round-off leaves, and soon.
    best = outcome(0.0, 1e-30)
    assert best.is_stalled
    assert best.relative == min(relative for _, relative in best.history) <= 1e-13
    assert len(best.history) < 1000


def test_the_residual_is_that_of_the_definition():
    """Recomputed from the returned pressure with an operator that shares no code."""
    n = 48
    heights = np.random.default_rng(5).standard_normal((n, n))
    press = ContactSolver((n, n), (1.0, 1.0), half_space, periodic=True, fast=False)
    s = press.solve(heights, mean_pressure=0.05)
    q = np.hypot(*np.meshgrid(*[2.0 * np.pi * np.fft.fftfreq(n)] * 2))
    symbol = np.divide(2.0, q, out=np.zeros_like(q), where=q > 0.0)
    u = np.fft.ifft2(symbol * np.fft.fft2(s.pressure)).real
    np.testing.assert_allclose(s.displacement, u, atol=1e-12)
    gap = u - heights - s.rigid_approach
    touching = s.pressure > 0.0
    scale = kkt.height_scale(heights, u)
    assert np.abs(gap[touching]).max() <= 1.001 * s.kkt * scale + 1e-13
    assert gap[~touching].min() >= -1.001 * s.kkt * scale - 1e-13
    assert s.pressure.mean() == pytest.approx(0.05, rel=1e-12)
