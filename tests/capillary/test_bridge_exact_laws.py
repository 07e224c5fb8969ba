"""Laws that exact bridges obey: virtual work, scale, mirror, ensembles, and sides of a limit."""

import math

import numpy as np
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st
from scipy.integrate import quad

from contactkit.capillary.exact.at_pressure import max_gap_at_pressure
from contactkit.capillary.exact.bridge import bridge, bridge_at_pressure, margin
from contactkit.capillary.exact.stability import stability_limit

pytestmark = pytest.mark.slow

few = settings(max_examples=12)
angles = st.floats(0.0, math.pi)
fractions = st.floats(0.02, 0.97)
volumes = st.floats(-6.0, -1.0).map(lambda power: 10.0**power)
bends = st.sampled_from([(0.0, 0.0), (0.0, 1.0), (1.0, 1.0), (0.3, 1.0)])


def case_of(lower, upper, volume, bend, fraction):
    """Arguments of a bridge at a fraction of its limit."""
    assume(abs(lower - upper) < 2.6)
    fixed = (volume, lower, upper, *bend)
    return fraction * float(stability_limit(*fixed).gap), fixed


def energy(gap, fixed):
    """Free surface less what wetting gains, over the surface tension."""
    volume, lower, upper, below, above = fixed
    state = bridge(gap, volume, lower, upper, below, above)
    a, e = float(state.neck_radius), float(state.shape)

    def radius(s):
        return math.sqrt(1.0 + e * (s * np.sinc((1.0 - e) * s / (2.0 * math.pi))) ** 2)

    ends = -float(state.arc_lower) / a, float(state.arc_upper) / a
    total = 2.0 * math.pi * a * a * quad(radius, *ends, epsabs=0.0, epsrel=1e-13, limit=200)[0]
    for x, angle, bend in ((state.radius_lower, lower, below), (state.radius_upper, upper, above)):
        slope = math.asin(min(bend * x, 1.0))
        sag = x * math.tan(0.5 * slope)
        total -= math.cos(angle) * math.pi * (x * x + sag * sag)
    return float(total)


@few
@given(angles, angles, volumes, bends, st.floats(0.2, 0.8))
def test_the_force_is_the_slope_of_the_energy(lower, upper, volume, bend, fraction):
    gap, fixed = case_of(lower, upper, volume, bend, fraction)
    step = 5e-3 * gap
    state = bridge(gap, *fixed)
    nodes, weights = (-2, -1, 1, 2), (1.0, -8.0, 8.0, -1.0)
    slope = sum(w * energy(gap + n * step, fixed) for n, w in zip(nodes, weights, strict=True))
    assert slope / (12.0 * step) == pytest.approx(
        float(state.force), rel=1e-5, abs=1e-6 * volume ** (1.0 / 3.0)
    )


@few
@given(angles, angles, volumes, bends, fractions, st.floats(-30.0, 10.0))
def test_scale(lower, upper, volume, bend, fraction, power):
    gap, fixed = case_of(lower, upper, volume, bend, fraction)
    size = 10.0**power
    one = bridge(gap, *fixed)
    other = bridge(gap * size, volume * size**3, lower, upper, *(k / size for k in bend))
    assert float(other.force) == pytest.approx(
        size * float(one.force), rel=1e-9, abs=1e-9 * size * gap
    )
    assert float(other.pressure) * size == pytest.approx(float(one.pressure), rel=1e-9, abs=1e-9)
    assert float(other.stiffness) == pytest.approx(float(one.stiffness), rel=1e-6, abs=1e-9)


@few
@given(angles, angles, volumes, bends, fractions)
def test_mirror(lower, upper, volume, bend, fraction):
    gap, fixed = case_of(lower, upper, volume, bend, fraction)
    one = bridge(gap, *fixed)
    other = bridge(gap, volume, upper, lower, *bend[::-1])
    assert float(other.force) == pytest.approx(float(one.force), rel=1e-9, abs=1e-9)
    assert float(other.radius_lower) == pytest.approx(float(one.radius_upper), rel=1e-9)
    limits = stability_limit(volume, [lower, upper], [upper, lower], bend, bend[::-1])
    assert limits.gap[0] == pytest.approx(limits.gap[1], rel=1e-10)


@few
@given(angles, angles, volumes, bends, fractions)
def test_stiffness_is_the_slope_of_the_force(lower, upper, volume, bend, fraction):
    gap, fixed = case_of(lower, upper, volume, bend, fraction)
    step = 1e-4 * gap * (1.0 - fraction)
    ends = bridge([gap - step, gap + step], *fixed).force
    slope = float(bridge(gap, *fixed).stiffness)
    assert (ends[1] - ends[0]) / (2.0 * step) == pytest.approx(slope, rel=1e-5, abs=1e-6)


@pytest.mark.slow
@few
@given(angles, angles, volumes, bends, fractions)
def test_one_force_through_every_cut(lower, upper, volume, bend, fraction):
    gap, fixed = case_of(lower, upper, volume, bend, fraction)
    state = bridge(gap, *fixed)
    for x, angle, k in (
        (state.radius_lower, lower, bend[0]),
        (state.radius_upper, upper, bend[1]),
    ):
        sine = math.sin(angle + math.asin(min(k * float(x), 1.0)))
        cut = 2.0 * math.pi * x * sine - math.pi * x * x * state.pressure
        size = math.pi * x * x * abs(state.pressure) + 2.0 * math.pi * x
        assert float(cut) == pytest.approx(float(state.force), abs=1e-11 * float(size))


@few
@given(angles, angles, volumes, bends)
def test_the_limit_has_two_sides(lower, upper, volume, bend):
    gap, fixed = case_of(lower, upper, volume, bend, 1.0)
    inside, outside = bridge(gap * np.array([1.0 - 1e-7, 1.0 + 1e-7]), *fixed, beyond="nan").force
    assert np.isfinite(inside)
    assert np.isnan(outside)
    assert float(margin(0.75 * gap, *fixed)) == pytest.approx(0.25, rel=1e-12)


@few
@given(st.floats(0.0, 1.2), st.floats(0.0, 1.2), st.floats(0.5, 5.0), fractions, st.booleans())
def test_the_ensembles_agree(lower, upper, power, fraction, both):
    """A bridge of given pressure is the bridge of its volume, and takes up liquid with pressure."""
    fixed = (lower, upper, 1.0 if both else 0.0, 1.0)
    pressure = -(10.0**power)
    gap = fraction * max_gap_at_pressure(pressure, *fixed)
    at = bridge_at_pressure(gap, pressure, *fixed)
    same = bridge(gap, float(at.volume), *fixed)
    assert float(same.force) == pytest.approx(float(at.force), rel=1e-9)
    assert float(same.pressure) == pytest.approx(pressure, rel=1e-9)
    more = bridge_at_pressure(gap, pressure * (1.0 - 1e-6), *fixed)
    assert more.volume > at.volume
    assert gap < float(stability_limit(float(at.volume), *fixed).gap)
    assert float(at.stiffness) < float(same.stiffness)
