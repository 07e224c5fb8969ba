"""How long a prepared solve takes: grids, load, hardness, layers, warm starts."""

from __future__ import annotations

import numpy as np
import pytest
from peers.cases import case, symbol_maker

from contactkit.contact.solver.contact_solver import ContactSolver
from contactkit.elasticity.layered import normal_symbol

PATHS = pytest.mark.parametrize("fast", [False, None], ids=["plain", "fast-if-installed"])
MOST_APPLICATIONS = 45


def prepared(n, boundary="periodic", fast=None, maker=None):
    periodic = boundary == "periodic"
    maker = maker or symbol_maker(periodic)
    return ContactSolver((n, n), (1.0 / n, 1.0 / n), maker, periodic, fast=fast)


def layered(shape, pixel_size):
    """Four layers, each twice as stiff as the one below, on a unit contact modulus."""
    return normal_symbol(
        shape, pixel_size, 0.91 * 2.0 ** np.arange(4, -1, -1), [0.3] * 5, [0.01] * 4
    )


def timed(benchmark, solver, given, bound=None):
    asked = {"mean_pressure": given.load, "bound": bound}
    solver.solve(given.heights, **asked)  # whatever is compiled or made on first use
    found = benchmark(solver.solve, given.heights, **asked)
    benchmark.extra_info.update(
        applications=found.n_applications, kkt=found.kkt, memory_arrays=found.memory_arrays
    )
    assert found.converged
    assert not found.fallback
    return found


@PATHS
@pytest.mark.parametrize("boundary", ["periodic", "free"])
def test_surface_rough_down_to_the_pixel(benchmark, boundary, fast):
    found = timed(benchmark, prepared(256, boundary, fast), case("expacf", 256, boundary, 5))
    assert found.n_applications <= MOST_APPLICATIONS


@PATHS
@pytest.mark.parametrize("bound", [0.05, 0.1], ids=["most-plastic", "some-plastic"])
def test_hardness(benchmark, bound, fast):
    found = timed(
        benchmark, prepared(256, fast=fast), case("selfaffine", 256, "periodic", 5), bound
    )
    assert found.pressure.max() == pytest.approx(bound, rel=1e-12)


@PATHS
def test_four_graded_layers(benchmark, fast):
    solver = prepared(256, fast=fast, maker=layered)
    found = timed(benchmark, solver, case("selfaffine", 256, "periodic", 5))
    assert found.n_applications <= MOST_APPLICATIONS


@pytest.mark.parametrize("boundary", ["periodic", "free"])
def test_preparing_a_solver(benchmark, boundary):
    assert benchmark(prepared, 512, boundary).self_influence > 0.0
