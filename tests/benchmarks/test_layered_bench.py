"""What the layered half-space costs: symbols of a map, and planes of stress below it."""

from __future__ import annotations

import numpy as np
import pytest

from contactkit.elasticity.layer_stack import Layers
from contactkit.elasticity.layered import compliance, normal_symbol
from contactkit.elasticity.stress.maxima import maxima
from contactkit.elasticity.stress.measures import tresca, von_mises
from contactkit.elasticity.stress.planes import planes
from contactkit.elasticity.stress.tractions import Tractions


def stack(layers):
    return np.linspace(3.0, 1.0, layers + 1), np.full(layers + 1, 0.3), np.full(layers, 0.5)


@pytest.mark.parametrize("layers", [0, 1, 3, 20])
def test_compliance_of_every_mode_of_a_map(benchmark, layers):
    alpha = np.hypot(np.fft.fftfreq(1024)[:, None], np.fft.rfftfreq(1024))
    alpha[0, 0] = 1.0
    assert benchmark(compliance, alpha, *stack(layers)).C.shape == (1024, 513)


@pytest.mark.parametrize("layers", [0, 3, 20])
@pytest.mark.parametrize("pixel", [(1.0, 1.0), (1.0, 1.1)], ids=["square", "oblong"])
def test_symbol_of_a_map(benchmark, layers, pixel):
    symbol = benchmark(normal_symbol, (1024, 1024), pixel, *stack(layers))
    assert symbol.shape == (1024, 513)


@pytest.mark.parametrize("mean", ["periodic", "free"])
@pytest.mark.parametrize("depth", [0.0, 2.0, 50.0])
def test_one_plane_of_stress(benchmark, mean, depth):
    pressure = np.random.default_rng(0).uniform(size=(512, 512))
    load = Tractions((1.0, 1.0), pressure, 0.3 * pressure)
    (plane,) = benchmark(lambda: list(planes(load, Layers(*stack(3)), [depth], mean=mean)))
    assert plane.stress.shape == (6, 512, 512)


def test_maxima_of_a_dozen_planes(benchmark):
    pressure = np.random.default_rng(0).uniform(size=(256, 256))
    measures = {"von_mises": von_mises, "tresca": tresca}
    depths = np.linspace(0.0, 20.0, 12)

    def search():
        below = planes(Tractions((1.0, 1.0), pressure), Layers(*stack(3)), depths)
        return maxima(below, measures, (1.0, 1.0))

    assert set(benchmark(search)) == set(measures)
