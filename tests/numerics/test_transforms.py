"""Real transforms behind one interface, against numpy's of the padded map."""

from __future__ import annotations

import numpy as np
import pytest
from selection import quick

from contactkit.numerics import fft as fft_backends
from contactkit.numerics.fft import make_transform, spectrum_shape
from contactkit.numerics.fft_pieces import in_threads

FAST = pytest.mark.parametrize("fast", [False, True], ids=["scipy", "ducc0"])


@FAST
@pytest.mark.parametrize("kind", [np.float32, np.float64])
@pytest.mark.parametrize("periodic", [True, False])
@pytest.mark.parametrize("threads", quick([1, 2], 1))
# Rows of 4 KiB in single precision are copied.
@pytest.mark.parametrize("shape", [(5, 6), (12, 1024)])
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


@FAST
@pytest.mark.parametrize("kind", [np.float32, np.float64])
@pytest.mark.parametrize("edges", [True, False, "x", "y"])
def test_pieces_are_the_same_on_any_number_of_threads(monkeypatch, fast, kind, edges):
    """Strips of columns, forced upon a small map, against numpy's transform of the padded one."""
    if fast:
        pytest.importorskip("ducc0")
    monkeypatch.setattr(fft_backends, "CACHED_BYTES", 0)
    rng = np.random.default_rng(3)
    ny, nx = shape = (21, 70)  # no whole number of strips
    size = ny * (1 if edges in (True, "y") else 2), nx * (1 if edges in (True, "x") else 2)
    symbol = np.fft.rfft2(np.fft.irfft2(rng.random((size[0], size[1] // 2 + 1)), size)).real
    source = rng.standard_normal(shape).astype(kind)
    found = []
    for threads in (1, 2, 3):
        transform = make_transform(symbol.astype(kind), shape, edges, threads, fast)
        target = np.zeros(shape, kind)
        for _ in range(2):  # nothing may be left of the run before
            transform(source, target)
        found.append(target)
    wanted = np.fft.irfft2(np.fft.rfft2(source, s=size) * symbol, s=size)[:ny, :nx]
    assert np.abs(found[0] - wanted).max() < 40.0 * np.finfo(kind).eps * np.abs(wanted).max()
    assert np.array_equal(found[0], found[1])
    assert np.array_equal(found[0], found[2])


def test_the_precision_is_that_of_the_spectrum():
    symbol, source = np.full((4, 3), 1.0 / 3.0), np.eye(4, dtype=np.float32)
    transform = make_transform(symbol, (4, 4), True, spectrum=np.zeros((4, 3), np.complex64))
    target = np.zeros((4, 4), np.float32)
    transform(source, target)
    np.testing.assert_allclose(target, source / 3.0, atol=1e-6)


@pytest.mark.parametrize("threads", [1, 2])
def test_what_a_piece_raises_is_raised(threads):
    def work(piece):
        if piece == 3:
            raise ValueError(piece)

    with pytest.raises(ValueError, match="3"), in_threads(threads) as each:
        each(work, range(5))
