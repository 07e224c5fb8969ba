"""The spline without numpy is the one of scipy."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.interpolate import CubicSpline

from contactkit.errors import DescriptionError
from contactkit.numerics.cubic_spline import cubic_spline


@given(
    st.lists(st.floats(0.05, 3.0), min_size=3, max_size=30),
    st.integers(0, 2**32 - 1),
)
def test_is_the_not_a_knot_spline(steps: list[float], seed: int) -> None:
    nodes = np.concatenate([[0.0], np.cumsum(steps)])
    values = np.random.default_rng(seed).standard_normal(len(nodes))
    curve, other = cubic_spline(nodes.tolist(), values.tolist()), CubicSpline(nodes, values)
    for x in np.linspace(-0.1, nodes[-1] + 0.1, 37):
        value, slope = curve(float(x))
        scale = 1.0 + abs(float(other(x))) + abs(float(other(x, 1)))
        assert value == pytest.approx(float(other(x)), abs=1e-9 * scale)
        assert slope == pytest.approx(float(other(x, 1)), abs=1e-8 * scale)


def test_error_falls_with_the_fourth_power_of_the_spacing() -> None:
    errors = []
    for n in (48, 96, 192, 384):
        nodes = [3.0 * i / n for i in range(n + 1)]
        curve = cubic_spline(nodes, [math.exp(math.sin(x)) for x in nodes])
        points = [0.013 + 2.97 * i / 500 for i in range(501)]
        errors.append(max(abs(curve(x)[0] - math.exp(math.sin(x))) for x in points))
    order = np.polyfit(np.log([48, 96, 192, 384]), np.log(errors), 1)[0]
    assert order < -3.8  # the ends, which err more, recede as well: a little more than four


def test_refuses_too_few_and_unordered_nodes() -> None:
    with pytest.raises(DescriptionError, match="four or more"):
        cubic_spline([0.0, 1.0, 2.0], [0.0, 1.0, 2.0])
    with pytest.raises(DescriptionError, match="ascend"):
        cubic_spline([0.0, 1.0, 1.0, 2.0], [0.0, 1.0, 1.0, 2.0])
