"""Sliding at its ends: films hardly thicker than the gap, 1e6 times it, circles that just part."""

from __future__ import annotations

import math
import warnings

import numpy as np
import pytest

import contactkit as ck
from contactkit.lubrication import couette_flat as sliding
from contactkit.lubrication import couette_sphere as sliding_sphere
from contactkit.lubrication.couette_reynolds import lubrication_factor
from contactkit.separation.vibration.path import VibrationPath, panels

pytestmark = pytest.mark.hard


def approx(value, rel):
    return pytest.approx(value, rel=rel, abs=0.0)


EXCESS = [1e-9, 1e-6, 1e-3, 0.1, 0.999, 1.0, 1.001, 9.0, 1e3, 1e6, 1e9]


@pytest.mark.parametrize("excess", EXCESS)
def test_the_round_film_at_any_ratio(excess):
    """Between the shear alone, where the film is even, and 8/5 of it, where the gap is closed."""
    shear = math.log1p(excess)
    # The height is given as gap + rim, as a scene would, so only the excess it really has counts.
    height = 1.0 + excess
    factor = float(lubrication_factor(1.0, height))
    real = math.log1p(height - 1.0)
    assert real * (1.0 - 1e-14) <= factor <= 1.6 * real
    if excess < 1e-2:
        assert factor / real - 1.0 <= 0.15 * excess * excess + 1e-14
    if excess >= 1e3:  # 8/5 ln q and a constant
        slope = (float(lubrication_factor(1.0, 10.0 * height)) - factor) / math.log(10.0)
        assert slope == approx(1.6, 2.0 / excess)
    assert shear > 0.0


def test_the_round_film_grows_without_a_step():
    """The two series meet at s = 2 D."""
    q = 2.0 + np.linspace(-1e-6, 1e-6, 21)
    steps = np.diff(lubrication_factor(1.0, q))
    np.testing.assert_allclose(steps, steps[0], rtol=1e-5)


@pytest.mark.parametrize("excess", [1e-9, 1e-3, 1.0, 1e3, 1e6])
def test_the_shear_of_a_sphere_at_any_ratio(excess):
    height = 1e-6 * (1.0 + excess)
    drag = float(sliding_sphere.sphere_drag(1e-3, 1e-6, height, 0.0, lambda h: 1.0 / h))
    assert drag == approx(2e-3 * math.pi * math.log1p((height - 1e-6) / 1e-6), 1e-12)


@pytest.mark.parametrize(
    "place", [0.0, 1e-12, 1.0 - 1e-12, 1.0, 1.0 + 1e-12, 2.0 - 1e-12, 2.0, 3.0]
)
@pytest.mark.parametrize("excess", [1e-9, 1.0, 1e6])
def test_a_sphere_at_every_awkward_travel(excess, place):
    shape = (1e-3, 1e-6, 1e-6 * (1.0 + excess))
    x = float(sliding_sphere.wetted_radius(*shape))
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        drag = float(sliding_sphere.sphere_drag(*shape, place * x, lambda h: 1.0 / h))
        impulse = float(sliding_sphere.sphere_impulse(*shape, 1.0, place * x))
    start = float(sliding_sphere.sphere_drag(*shape, 0.0, lambda h: 1.0 / h))
    assert 0.0 <= drag <= start * (1.0 + 1e-12)
    assert 0.0 <= impulse <= float(sliding_sphere.sphere_impulse(*shape, 1.0)) * (1.0 + 1e-12)
    assert (drag == 0.0) == (place >= 2.0)


def test_hysteresis_of_the_widest_and_of_equal_angles():
    assert float(sliding.hysteresis_force(1.0, 1.0, math.pi, 0.0, 1.0)) == approx(2.0, 1e-15)
    assert float(sliding.hysteresis_force(1.0, 1.0, 1.0, 1.0)) == 0.0


PATHS = [
    (5e-6, 1e-5, 4.9e-6, 1e3, 0.0),
    (5e-6, 1e-9, 4.9e-6, 1e3, 2.0),
    (5e-6, 1e-1, 1e-6, 1e3, -40.0),  # opens faster than it vibrates
    (5e-6, 1e-3, 1e-12, 1e6, 7.0),
]


@pytest.mark.parametrize("numbers", PATHS)
def test_panels_measure_time_whatever_the_path(numbers):
    begin, rise, amplitude, frequency, phase = numbers
    shaken = ck.Vibration(amplitude=amplitude, frequency=frequency, phase=phase)
    path = VibrationPath(begin, rise, shaken)
    start, end = 3.0 / frequency, 4.0 / frequency
    edges, times, weights = panels(path, start, end, (begin, begin + amplitude))
    assert edges[0] == start
    assert edges[-1] == end
    assert (np.diff(edges) > 0.0).all()
    assert weights.sum() == approx(1.0 / frequency, 1e-12)
    speeds = np.array([path.speed(t) for t in times.ravel()])
    way = (weights.ravel() * speeds).sum()
    assert way == pytest.approx(path.gap(end) - path.gap(start), rel=1e-6, abs=1e-7 * amplitude)


@pytest.mark.parametrize("numbers", PATHS)
@pytest.mark.parametrize("rise", [0.0, 0.3, 1.0, 5.5])
def test_a_level_is_reached_for_the_first_time(numbers, rise):
    begin, speed, amplitude, frequency, phase = numbers
    shaken = ck.Vibration(amplitude=amplitude, frequency=frequency, phase=phase)
    path = VibrationPath(begin, speed, shaken)
    end = 20.0 / frequency
    level = begin + rise * min(amplitude + speed * end, 2.0 * amplitude)
    found = path.first_above(level, end)
    times = np.linspace(0.0, end, 40_001)
    gaps = np.array([path.gap(t) for t in times])
    above = np.nonzero(gaps >= level)[0]
    if math.isinf(found):
        assert len(above) == 0
        return
    assert path.gap(found) >= level * (1.0 - 1e-12)
    if len(above):
        assert found <= times[above[0]]
        assert found >= times[max(above[0] - 1, 0)] - 1e-15
