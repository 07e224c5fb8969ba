"""Random bridges: the meridian integrated anew, limits, symmetry, scale, and Maxwell's relation."""

from __future__ import annotations

import math

import numpy as np
import pytest
from selection import quick

import contactkit as ck
from contactkit.capillary.exact.at_pressure import max_gap_at_pressure
from contactkit.capillary.exact.bridge import ExactBridge, bridge, bridge_at_pressure
from contactkit.capillary.exact.stability import stability_limit
from contactkit.capillary.flats.force_law import flat_law

SHARES = np.array([1e-3, 0.05, 0.3, 0.7, 0.95, 0.9999])  # of the limit
EXACT = (0.0, 0.5 * math.pi, math.pi, 1e-6, 0.5 * math.pi - 1e-6)
STEPS = 80


def angle(rng):
    return float(rng.choice(EXACT)) if rng.random() < 0.2 else float(rng.uniform(0.0, math.pi))


def cases(seed, n):
    """Angles, curvatures, volume: flats, a sphere below or above, two of a ratio to a million."""
    rng = np.random.default_rng(seed)
    found = []
    while len(found) < n:
        one = angle(rng)
        two = one if rng.random() < 0.2 else angle(rng)
        below, above = [(0.0, 0.0), (0.0, 1.0), (1.0, 0.0), (1.0, 10.0 ** -rng.uniform(0, 6))][
            len(found) % 4
        ]
        if abs(one - two) < 2.8:  # nearly wetted against nearly repelled is another test
            found.append((one, two, below, above, 10.0 ** rng.uniform(-15.0, -1.0)))
    return found


def integrated(gap, given, state):
    """Misses of gap, volume, contact angle and upper radius of a meridian, by Runge and Kutta.

    Classical steps of fourth order and their extrapolation, from the wider contact line with its
    radius, angle and pressure only.
    """
    one, two, below, above = given[:4]
    swap = state.radius_upper > state.radius_lower
    start = np.where(swap, state.radius_upper, state.radius_lower)
    first, last = np.where(swap, two, one), np.where(swap, one, two)
    bend, other = np.where(swap, above, below), np.where(swap, below, above)
    length = state.arc_lower + state.arc_upper

    def slope(y):
        r, _, phi, _ = y
        sine = np.sin(phi)
        return np.stack((np.cos(phi), sine, state.pressure - sine / r, np.pi * r * r * sine))

    def run(n):
        lean = np.arcsin(bend * start)
        y = np.stack((start, 0.0 * start, np.pi - first - lean, 0.0 * start))
        h = length / n
        for _ in range(n):
            a = slope(y)
            b = slope(y + 0.5 * h * a)
            c = slope(y + 0.5 * h * b)
            d = slope(y + h * c)
            y = y + h / 6.0 * (a + 2.0 * b + 2.0 * c + d)
        return y

    coarse, fine = run(STEPS), run(2 * STEPS)
    r, z, phi, v = fine + (fine - coarse) / 15.0
    leans = np.arcsin(bend * start), np.arcsin(np.clip(other * r, -1.0, 1.0))
    sags = [x * np.tan(0.5 * b) for x, b in zip((start, r), leans, strict=True)]
    caps = [np.pi / 6.0 * s * (3.0 * x * x + s * s) for s, x in zip(sags, (start, r), strict=True)]
    size = np.abs(z) + sum(sags)
    return (
        (z - sum(sags) - gap) / size,
        (v - sum(caps)) / state.volume - 1.0,
        phi - last - leans[1],
        r / np.where(swap, state.radius_lower, state.radius_upper) - 1.0,
    )


@pytest.mark.parametrize("seed", quick([11, 12], long=[0]))
def test_any_bridge_is_a_solution_and_ends_at_its_limit(seed):
    states, gaps, givens = [], [], []
    for one, two, below, above, volume in cases(seed, 20):
        limit = stability_limit(volume, one, two, below, above)
        end = float(limit.gap)
        assert 0.0 < end < 3.0 * volume ** (1.0 / 3.0)
        state = bridge(SHARES * end, volume, one, two, below, above)
        assert all(np.isfinite(column).all() for column in state)
        assert (state.neck <= np.minimum(state.radius_lower, state.radius_upper)).all()
        assert (state.bulge >= np.maximum(state.radius_lower, state.radius_upper)).all()
        for over in (1e-8, 1e-4):
            with pytest.raises(ck.InfeasibleError, match=r"no bridge beyond .*: there it breaks"):
                bridge(end * (1.0 + over), volume, one, two, below, above)
        states.append(state)
        gaps.append(SHARES * end)
        givens.append([np.full(SHARES.size, x) for x in (one, two, below, above)])
    state = ExactBridge(*(np.concatenate(column) for column in zip(*states, strict=True)))
    given = [np.concatenate(column) for column in zip(*givens, strict=True)]
    size = np.cbrt(state.volume)
    # a contact circle that is almost a point needs finer steps than these
    wide = np.minimum(state.radius_lower, state.radius_upper) > 0.05 * size
    assert wide.mean() > 0.8
    for name, miss in zip(
        ("gap", "volume", "angle", "radius"),
        integrated(np.concatenate(gaps), given, state),
        strict=True,
    ):
        assert np.max(np.abs(miss[wide])) < 1e-5, name


@pytest.mark.parametrize(("seed", "number"), quick([(21, 8), (22, 16)], 0))
def test_a_bridge_upside_down_and_a_larger_one_are_the_same(seed, number):
    for one, two, below, above, volume in cases(seed, number):
        end = float(stability_limit(volume, one, two, below, above).gap)
        gap = np.array([0.2, 0.9]) * end
        state = bridge(gap, volume, one, two, below, above)
        turned = bridge(gap, volume, two, one, above, below)
        scale = np.maximum(np.abs(state.force), 0.1 * volume ** (1.0 / 3.0))
        assert np.max(np.abs(turned.force - state.force) / scale) < 1e-9
        assert turned.radius_upper == pytest.approx(state.radius_lower, rel=1e-9)
        grown = bridge(7.0 * gap, 343.0 * volume, one, two, below / 7.0, above / 7.0)
        assert np.max(np.abs(grown.force / 7.0 - state.force) / scale) < 1e-9
        shuffled = bridge(gap[::-1], volume, one, two, below, above)
        assert np.max(np.abs(shuffled.force[::-1] - state.force) / scale) < 1e-12


def test_force_and_volume_obey_maxwell_at_a_pressure():
    r"""Omega = E - PV: dOmega = F dD - V dP, so that dF/dP = -dV/dD."""
    rng = np.random.default_rng(3)
    for _ in range(12):
        one, two = rng.uniform(0.0, 1.2, 2)
        pressure = -(10.0 ** rng.uniform(0.7, 6.0))
        bodies = (one, two, 0.0, 1.0)
        gap = float(rng.uniform(0.05, 0.8)) * max_gap_at_pressure(pressure, *bodies)
        h = 1e-4
        force = bridge_at_pressure(gap, pressure * np.array([1.0 - h, 1.0 + h]), *bodies).force
        volume = bridge_at_pressure(gap * np.array([1.0 - h, 1.0 + h]), pressure, *bodies).volume
        by_pressure = (force[1] - force[0]) / (2.0 * h * pressure)
        by_gap = (volume[1] - volume[0]) / (2.0 * h * gap)
        assert by_pressure == pytest.approx(-by_gap, rel=1e-4)


@pytest.mark.parametrize("exponent", [-1, 2, 4, 6])
def test_pressure_and_volume_are_two_ways_to_one_bridge(exponent):
    pressure = -3.0 * 10.0**exponent if exponent > -1 else -5.0
    bodies = (0.4, 0.9, 0.0, 1.0)
    gap = max_gap_at_pressure(pressure, *bodies) * np.array([0.0, 1e-6, 0.5, 0.99])
    held = bridge_at_pressure(gap, pressure, *bodies)
    free = bridge(gap, held.volume, *bodies)
    assert free.force == pytest.approx(held.force, rel=1e-8)
    assert free.pressure == pytest.approx(np.full(4, pressure), rel=1e-8)


@pytest.mark.slow
def test_the_law_of_a_scene_is_the_bridge_for_any_pair_of_angles():
    for one, two in [case[:2] for case in cases(31, 40) if case[2] == case[3] == 0.0]:
        law = flat_law(one, two)
        end = float(stability_limit(1.0, one, two).gap)
        assert law.end == pytest.approx(end, rel=2e-8)
        gap = end * SHARES[:-1]
        state = bridge(gap, 1.0, one, two)
        radius = np.maximum(state.radius_lower, state.radius_upper)
        scale = math.pi * radius * (radius * abs(math.cos(one) + math.cos(two)) / gap + 1.0)
        force = np.array([law.force(float(x)) for x in gap])
        assert np.max(np.abs(force - state.force) / scale) < 2e-8
