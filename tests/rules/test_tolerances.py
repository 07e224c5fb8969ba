"""Small quantities in SI units are compared by their relative tolerance (tests/conftest.py)."""

from __future__ import annotations

import numpy as np
import pytest

SMALL = 1e-22


@pytest.mark.parametrize(
    "made_of",
    [
        lambda value: value,
        np.float64,
        complex,
        lambda value: [1.0, value],
        lambda value: {"volume": value},
        lambda value: np.array([[1.0, value]]),
    ],
    ids=["float", "numpy", "complex", "list", "dict", "array"],
)
def test_a_small_value_is_not_equal_to_any_other(made_of):
    wrong = made_of(1.3 * SMALL)
    assert wrong != pytest.approx(made_of(SMALL))
    assert wrong != pytest.approx(made_of(SMALL), rel=0.2)
    assert wrong == pytest.approx(made_of(SMALL), rel=0.4)
    assert wrong == pytest.approx(made_of(SMALL), abs=SMALL)


def test_an_array_of_small_values_is_compared_with_one():
    assert np.full(3, 1.3 * SMALL) != pytest.approx(SMALL, rel=0.2)


@pytest.mark.parametrize("zero", [0, 0.0, np.float64(0.0), [1.0, 0.0], np.zeros(2)], ids=repr)
def test_zero_keeps_its_absolute_tolerance(zero):
    assert np.add(zero, 1e-13).tolist() == pytest.approx(zero, rel=1e-9)
    assert np.add(zero, 1e-11).tolist() != pytest.approx(zero, rel=1e-12)
