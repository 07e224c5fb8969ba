"""Cost of stiff bonded films: convolutions, and CPU over the half-space under the same load.

``python tests/benchmarks/test_film_bench.py 256`` prints the table of docs/accuracy.md.
"""

from __future__ import annotations

import sys
import time
from typing import NamedTuple

import numpy as np
import pytest
from peers.cases import SURFACES, case

from contactkit.contact.solver.contact_solver import ContactSolver
from contactkit.elasticity.layered import normal_symbol

CONTRASTS = (10.0, 100.0, 1e3, 1e4)
THICKNESSES = (0.001, 0.003, 0.01, 0.1)  # over the window
LOADS = (1.0, 10.0, 100.0)  # over that of five per cent of contact of the half-space


class Cost(NamedTuple):
    """Applications of the operator, CPU seconds, and whether the fast method sufficed."""

    applications: int
    seconds: float
    answered: bool


def costs(n, surface, contrast, thickness):
    """Cost of each of the loads, after a solve that compiles and allocates."""
    moduli = 0.91 * np.array([contrast, 1.0] if thickness else [1.0])
    layers = [thickness] if thickness else []

    def film(shape, pixel):
        return normal_symbol(shape, pixel, moduli, [0.3] * moduli.size, layers)

    solver = ContactSolver((n, n), (1.0 / n, 1.0 / n), film, periodic=True)
    given = case(surface, n, "periodic", 5)
    for load in LOADS:
        seconds = []
        for _ in range(2):
            begun = time.process_time()
            s = solver.solve(given.heights, mean_pressure=load * given.load, max_iterations=1)
            seconds.append(time.process_time() - begun)
        yield Cost(s.n_applications, min(seconds), s.converged and not s.fallback)


def row(n, contrast, base):
    """Convolutions, median and maximum; CPU over the half-space; solves without an answer."""
    found, cpu = [], []
    for surface in SURFACES:
        for thickness in THICKNESSES:
            each = list(costs(n, surface, contrast, thickness))
            found += each
            cpu += [a.seconds / b.seconds for a, b in zip(each, base[surface], strict=True)]
    counts = [c.applications for c in found]
    lost = sum(not c.answered for c in found)
    many = f"{np.median(counts):.0f} | {max(counts)}"
    return f"{many} | {np.median(cpu):.1f} | {lost} of {len(found)}"


@pytest.mark.parametrize("contrast", CONTRASTS)
@pytest.mark.parametrize("surface", SURFACES)
def test_stiff_films(benchmark, surface, contrast):
    found = benchmark.pedantic(lambda: list(costs(128, surface, contrast, 0.01)), rounds=1)
    benchmark.extra_info.update(applications=[c.applications for c in found])
    assert all(c.answered for c in found)


if __name__ == "__main__":
    size = int(sys.argv[1]) if len(sys.argv) > 1 else 256
    half_space = {surface: list(costs(size, surface, 1.0, 0.0)) for surface in SURFACES}
    for contrast in CONTRASTS:
        sys.stdout.write(f"| {contrast:g} | {row(size, contrast, half_space)} |\n")
