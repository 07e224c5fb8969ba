"""Seeded nonsense for `press`: each call is refused with a message, or solved to sound numbers."""

from __future__ import annotations

import numpy as np
import pytest

import contactkit as ck
from contactkit.errors import ContactkitError

pytestmark = pytest.mark.filterwarnings("error", "ignore::contactkit.ValidityWarning")

SHAPES = [(2, 2), (2, 3), (3, 2), (2, 40), (40, 3), (5, 7), (12, 12)]
NO_SHAPES = [(1, 1), (1, 8), (8, 1)]
SIZES = [1e-8, 1e-8, 1e-6, 1e-3, 1.0, (1e-8, 3e-8), (1e-9, 1e-6), "10 nm", "10 um"]
NO_SIZES = [0.0, -1e-8, np.nan, np.inf, 1e-160, 1e160, None, "10 Pa", (1e-8,)]
PRESSURES = [0.0, 1e8, 1e9, 1e8, 1e9, 1.0, 1e-10, "100 MPa", "1 GPa"]
NO_PRESSURES = [-1e8, np.nan, np.inf, "5 nm", 1e300]
HARDNESSES = [None, None, None, 1e9, 1e10, "2 GPa"]
NO_HARDNESSES = [0.0, -1.0, np.nan, 1e-300, 1e300]
MODULI = [2e11, 2e11, 2e5, 2.0, 1e20]
AMPLITUDES = [1e-9, 1e-9, 1e-12, 1e-15, 1e-6, 1.0, 1e-300, 1e150]


def one_of(rng, values, nonsense=()):
    """Mostly a value that can be; nonsense now and then."""
    known = nonsense if nonsense and rng.random() < 0.07 else values
    return known[rng.integers(len(known))]


def heights(rng):
    shape, size = one_of(rng, SHAPES, NO_SHAPES), one_of(rng, AMPLITUDES)
    h = size * rng.standard_normal(shape)
    kinds = {
        "noise": h,
        "flat": np.full(shape, size),
        "spike": np.where(h == h.max(), size, 0.0),
        "pit": np.where(h == h.max(), -size, 0.0),
        "two levels": np.where(h > 0.0, size, 0.0),
        "tilt": size * np.add.outer(np.arange(shape[0]), 2.0 * np.arange(shape[1])),
        "far from zero": h + 10.0 ** rng.uniform(-3.0, 8.0),
        "whole numbers": np.rint(h / size).astype(int),
        "list": h.tolist(),
        "some masked": np.ma.array(h, mask=rng.random(shape) < 0.2),
        "most masked": np.ma.array(h, mask=rng.random(shape) < 0.9),
        "nan": np.where(h == h.min(), np.nan, h),
        "inf": np.where(h == h.min(), -np.inf, h),
        "flags": h > 0.0,
        "a line": h.ravel(),
        "a stack": h[None],
    }
    return kinds[list(kinds)[rng.integers(len(kinds))]]


def call(seed):
    rng = np.random.default_rng(seed)
    hardness = one_of(rng, HARDNESSES, NO_HARDNESSES)
    solid = ck.Material(
        young_modulus=one_of(rng, MODULI), poisson_ratio=one_of(rng, (0.3, 0.0, 0.5))
    )
    return {
        "heights": heights(rng),
        "pixel_size": one_of(rng, SIZES, NO_SIZES),
        "stack": solid,
        "mean_pressure": one_of(rng, PRESSURES, NO_PRESSURES),
        "hardness": hardness,
        "periodic": one_of(rng, (True, False, None)),
    }


def check(found, hardness):
    for name in ("pressure", "gap", "displacement", "heights"):
        assert np.isfinite(found[name]).all(), name
    assert found.pressure.min() >= 0.0
    assert found.gap.min() >= 0.0
    assert found.mean_pressure == pytest.approx(found.plan.mean_pressure, rel=1e-9)
    if isinstance(hardness, float):
        assert found.max_pressure <= hardness * (1.0 + 1e-9)
    if found.holes is not None:
        assert not found.pressure[found.holes].any()
    assert all(value is None or np.isfinite(value) for value, _ in found.scalars().values())


@pytest.mark.parametrize("seed", range(12))
def test_nonsense_is_refused_or_solved(seed):
    solved = 0
    for number in range(25):
        asked = call([seed, number])
        try:
            found = ck.press(**asked)
        except ContactkitError:
            continue
        check(found, asked["hardness"])
        solved += 1
    assert solved >= 5
