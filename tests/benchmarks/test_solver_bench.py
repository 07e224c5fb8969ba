"""How long a contact takes, prepared; sizes kept small enough for any machine."""

import numpy as np
import pytest

from contactkit.kernels.active_set import Press


def half_space(shape, pixel_size):
    qy = 2.0 * np.pi * np.fft.fftfreq(shape[0], pixel_size[0])[:, None]
    q = np.hypot(qy, 2.0 * np.pi * np.fft.rfftfreq(shape[1], pixel_size[1]))
    return np.divide(2.0, q, out=np.zeros_like(q), where=q > 0.0)


def rough(n):
    k = np.hypot(np.fft.fftfreq(n)[:, None], np.fft.rfftfreq(n))
    k[0, 0] = np.inf
    spectrum = np.fft.rfft2(np.random.default_rng(1).standard_normal((n, n))) * k**-1.8
    h = np.fft.irfft2(np.where(k < 0.125, spectrum, 0.0), s=(n, n))
    return 3e-3 * h / h.std()


@pytest.mark.parametrize("n", [256, 512])
@pytest.mark.parametrize("fast", [False, None], ids=["plain", "fast-if-installed"])
@pytest.mark.parametrize("cap", [None, 0.1], ids=["elastic", "capped"])
def test_rough_periodic_contact(benchmark, n, fast, cap):
    press = Press((n, n), (1.0 / n, 1.0 / n), half_space, periodic=True, fast=fast)
    heights = rough(n)
    press.solve(heights, mean_pressure=2e-3, cap=cap)
    s = benchmark(press.solve, heights, mean_pressure=2e-3, cap=cap)
    assert s.converged
    benchmark.extra_info.update(applications=s.n_applications, memory_arrays=s.memory_arrays)


def test_load_curve_by_warm_starts(benchmark):
    press = Press((256, 256), (1.0 / 256, 1.0 / 256), half_space, periodic=True)
    heights, loads = rough(256), np.geomspace(5e-4, 1e-2, 20)

    def curve():
        start, count = None, 0
        for load in loads:
            s = press.solve(heights, mean_pressure=load, start=start)
            start, count = s.pressure, count + s.n_applications
        return count

    benchmark.extra_info["applications"] = benchmark(curve)
