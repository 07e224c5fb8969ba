"""Real transforms behind one interface, against numpy's of the padded map."""

from __future__ import annotations

import numpy as np
import pytest
from selection import quick

from contactkit.numerics.fft import make_transform, spectrum_shape

FAST = pytest.mark.parametrize("fast", [False, True], ids=["scipy", "ducc0"])


@FAST
@pytest.mark.parametrize("kind", [np.float32, np.float64])
@pytest.mark.parametrize("periodic", [True, False])
@pytest.mark.parametrize("threads", quick([1, 2], 1))
# Rows of 4 KiB in single precision are copied; the second free map goes in strips of columns.
@pytest.mark.parametrize("shape", [(5, 6), (12, 1024), (500, 810)])
def test_convolution_is_that_of_numpy(fast, kind, periodic, threads, shape):
    if fast:
        pytest.importorskip("ducc0")
    rng = np.random.default_rng(1)
    (ny, nx), times = shape, 1 if periodic else 2
    symbol = rng.uniform(0.5, 1.5, (times * ny, times * nx // 2 + 1)).astype(kind)
    source, target = rng.standard_normal(shape).astype(kind), np.zeros(shape, kind)
    transform = make_transform(symbol, shape, periodic, threads, fast)
    size = (times * ny, times * nx)
    wanted = np.fft.irfft2(np.fft.rfft2(source, s=size) * symbol, s=size)[:ny, :nx]
    for _ in range(2):  # the work array is used again
        transform(source, target)
        assert np.abs(target - wanted).max() < 40.0 * np.finfo(kind).eps * np.abs(wanted).max()


@pytest.mark.parametrize("kind", [np.float32, np.float64])
@pytest.mark.parametrize("width", [33, 129, 513, 1025, 1000])
def test_rows_of_a_spectrum_are_an_odd_number_of_cache_lines(width, kind):
    rows, pitch = spectrum_shape((64, width), kind, periodic=True, fast=True)
    size = 2 * np.dtype(kind).itemsize
    assert rows == 64
    assert pitch * size % 128 == 64
    assert 0 <= (pitch - width) * size <= 128
    assert spectrum_shape((64, width), kind, periodic=True, fast=False) == (64, width)
