"""Array libraries that the tests of `press_maps` hand it, each with a device that is no host."""

from __future__ import annotations

import contextlib
from typing import NamedTuple

import numpy as np
import pytest

import contactkit as ck

SOLID = ck.Material(young_modulus=1e9, poisson_ratio=0.3)
E_STAR = 1e9 / (1.0 - 0.3**2)
HARD = ck.Material(young_modulus=1e11, poisson_ratio=0.3)
COATED = ck.Stack(layers=(ck.Layer(material=HARD, thickness=4e-3),), substrate=SOLID)
SHEET = ck.Stack(
    layers=(ck.Layer(material=SOLID, thickness=0.02),), substrate=ck.RigidBase(bonded=True)
)


class Library(NamedTuple):
    """Functions from numpy to arrays of a library, and back."""

    take: object
    give: object
    single: object
    strictly: object = contextlib.nullcontext


def strict_library():
    """The standard to the letter, on a device that numpy cannot read, no shape of which may depend
    on data."""
    pytest.importorskip("array_api_compat")
    xs = pytest.importorskip("array_api_strict")
    device, host = xs.Device("device1"), xs.Device("CPU_DEVICE")
    return Library(
        take=lambda a: xs.asarray(np.asarray(a, dtype=np.float64), device=device),
        give=lambda a: np.asarray(a.to_device(host)),
        single=lambda a: xs.asarray(np.asarray(a), dtype=xs.float32, device=device),
        strictly=lambda: xs.ArrayAPIStrictFlags(
            boolean_indexing=False, data_dependent_shapes=False
        ),
    )


def torch_library():
    pytest.importorskip("array_api_compat")
    torch = pytest.importorskip("torch")
    return Library(
        take=lambda a: torch.as_tensor(np.asarray(a, dtype=np.float64)),
        give=lambda a: a.numpy(),
        single=lambda a: torch.as_tensor(np.asarray(a, dtype=np.float32)),
    )


# torch takes seconds to import
LIBRARIES = [
    pytest.param(strict_library, id="strict"),
    pytest.param(torch_library, id="torch", marks=pytest.mark.slow),
]


def rough(n, seed, waves=8, ny=None):
    """Rough map of unit size along x, rms height 1e-3."""
    rng = np.random.default_rng(seed)
    shape = (ny or n, n)
    q = np.hypot(np.fft.fftfreq(shape[0])[:, None] * n, np.fft.rfftfreq(n) * n)
    amplitude = np.where((q > 0.0) & (q <= waves), np.maximum(q, 2.0) ** -1.8, 0.0)
    h = np.fft.irfft2(amplitude * np.exp(2j * np.pi * rng.random(q.shape)), s=shape)
    return 1e-3 * h / h.std()


def pressed(library, heights, solid, single=False, **given):
    """The same by the solver of the library and by that of numpy: both results, as numpy's."""
    pixel = 1.0 / heights.shape[-1]
    take = library.single if single else library.take
    on_device = {
        key: take(value) if isinstance(value, np.ndarray) else value for key, value in given.items()
    }
    with library.strictly():
        found = ck.press_maps(take(heights), pixel, solid, **on_device)
    given.pop("rtol", None)
    return found, ck.press_maps(heights, pixel, solid, **given)
