"""Laws of every arc: scaling, symmetry, limits, continuity, independence of the batch."""

import math

import numpy as np
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st

from contactkit.capillary.arc import flat as arc_flat
from contactkit.capillary.arc import sphere as arc_sphere
from contactkit.capillary.arc.bridge import arc_bridge

ANGLE = st.one_of(st.sampled_from([0.0, math.pi / 2, math.pi]), st.floats(0.0, math.pi))
SHARE = st.floats(1e-6, 0.95)  # of the gap at which the neck closes
VOLUME = st.floats(-15.0, -1.0).map(lambda power: 10.0**power)
NAMES = ("force", "pressure", "radius_lower", "radius_upper", "neck", "bulge")
BEND = st.one_of(st.just(0.0), st.floats(1e-9, 1.0))  # curvature of a body
HALF = math.radians(150.0)  # angles further apart have no bridge worth the name


def close(one, two, rtol):
    for name in NAMES:
        np.testing.assert_allclose(getattr(one, name), getattr(two, name), rtol=rtol, err_msg=name)


@given(ANGLE, ANGLE, SHARE, st.floats(-9.0, 3.0))
def test_lengths_scale_between_flats(lower, upper, fraction, power):
    assume(abs(lower - upper) < HALF)
    limit = arc_flat.zero_neck_gap(arc_flat.shape(lower, upper), 1.0)
    gap, scale = fraction * min(limit, 10.0), 10.0**power
    one, two = arc_bridge(gap, 1.0, lower, upper), arc_bridge(gap * scale, scale**3, lower, upper)
    width = abs(one.force) + one.neck  # a force may pass through zero
    np.testing.assert_allclose(two.force / scale, one.force, rtol=1e-11, atol=1e-11 * width)
    np.testing.assert_allclose(two.radius_lower, scale * one.radius_lower, rtol=1e-11)
    np.testing.assert_allclose(two.neck, scale * one.neck, rtol=1e-11)


@given(ANGLE, ANGLE, VOLUME, st.floats(0.0, 0.3), BEND, st.floats(-9.0, 3.0))
def test_lengths_scale_between_curved_bodies(lower, upper, volume, fraction, ratio, power):
    assume(abs(lower - upper) < HALF)
    gap, scale = fraction * volume ** (1 / 3), 10.0**power
    one = arc_bridge(gap, volume, lower, upper, ratio, 1.0, beyond="nan")
    two = arc_bridge(
        gap * scale, volume * scale**3, lower, upper, ratio / scale, 1.0 / scale, beyond="nan"
    )
    near = 1e-10 * (abs(one.force) + abs(one.radius_lower))
    assert np.all((abs(two.force / scale - one.force) <= near) | np.isnan(one.force))
    np.testing.assert_allclose(two.radius_upper, scale * one.radius_upper, rtol=1e-10)


@given(ANGLE, ANGLE, VOLUME, st.floats(0.0, 0.3), BEND, BEND)
def test_bodies_may_be_swapped(lower, upper, volume, fraction, one_curved, two_curved):
    assume(abs(lower - upper) < HALF)
    gap = max(fraction, 1e-3) * volume ** (1 / 3)
    one = arc_bridge(gap, volume, lower, upper, one_curved, two_curved, beyond="nan")
    two = arc_bridge(gap, volume, upper, lower, two_curved, one_curved, beyond="nan")
    size = np.maximum(abs(one.radius_lower), gap)
    for here, there in (
        (one.radius_lower, two.radius_upper),
        (one.radius_upper, two.radius_lower),
        (one.neck, two.neck),
        (one.bulge, two.bulge),
    ):
        assert np.all((abs(here - there) <= 1e-10 * size) | np.isnan(here))
    stiff = size + size**2 / gap
    assert np.all((abs(one.force - two.force) <= 1e-10 * stiff) | np.isnan(one.force))


@given(ANGLE, ANGLE, SHARE)
def test_pressure_and_force_balance_in_the_plane(lower, upper, fraction):
    """F = 2 pi x sin(phi) - pi x^2 P through the neck, the belly or the smaller circle."""
    assume(abs(lower - upper) < HALF)
    shape = arc_flat.shape(lower, upper)
    gap = fraction * min(arc_flat.zero_neck_gap(shape, 1.0), 10.0)
    x = arc_flat.contact_radius(shape, gap, 1.0)
    plane = x + gap * shape.plane_offset
    pull = 2.0 * math.pi * plane * shape.plane_sine
    push = math.pi * plane**2 * arc_flat.pressure(shape, gap, x)
    size = abs(pull) + abs(push)
    assert arc_flat.force(shape, gap, x) == pytest.approx(pull - push, abs=1e-12 * size)


@given(ANGLE, ANGLE, SHARE)
def test_volume_is_kept_and_radii_are_ordered(lower, upper, fraction):
    assume(abs(lower - upper) < HALF)
    shape = arc_flat.shape(lower, upper)
    gap = fraction * min(arc_flat.zero_neck_gap(shape, 1.0), 10.0)
    x = arc_flat.contact_radius(shape, gap, 1.0)
    top = arc_flat.upper_contact_radius(shape, gap, x)
    assert arc_flat.volume(shape, gap, x) == pytest.approx(1.0, rel=1e-11)
    assert 0.0 < arc_flat.neck(shape, gap, x) <= min(x, top) <= max(x, top)
    assert arc_flat.bulge(shape, gap, x) >= max(x, top)


@given(st.floats(0.05, math.pi - 0.05), st.floats(0.01, 0.9))
def test_contact_radius_is_continuous_where_the_arc_is_straight(lower, fraction):
    """Across theta_1 + theta_2 = 180 deg, where the radius of the arc is infinite."""
    upper = math.pi - lower
    assume(abs(lower - upper) < HALF)
    gap = fraction * min(arc_flat.zero_neck_gap(arc_flat.shape(lower, upper), 1.0), 10.0)
    radii = [
        arc_flat.contact_radius(arc_flat.shape(lower, upper + turn), gap, 1.0)
        for turn in (-1e-6, -1e-9, 0.0, 1e-9, 1e-6)
    ]
    assert radii[1] == pytest.approx(radii[2], rel=1e-6)
    assert radii[3] == pytest.approx(radii[2], rel=1e-6)
    slopes = ((radii[2] - radii[0]) / 1e-6, (radii[4] - radii[2]) / 1e-6)
    assert slopes[0] == pytest.approx(slopes[1], rel=1e-2, abs=1e-3)


@given(ANGLE, ANGLE, st.floats(0.02, 0.9), st.sampled_from(["lower", "upper", "both"]))
def test_weakly_curved_bodies_join_the_flats(lower, upper, fraction, which):
    """Two kernels that share no formula for the volume meet as curvature vanishes."""
    assume(abs(lower - upper) < HALF)
    gap = fraction * min(arc_flat.zero_neck_gap(arc_flat.shape(lower, upper), 1.0), 3.0)
    flat = arc_bridge(gap, 1.0, lower, upper)
    size = abs(flat.force) + flat.bulge + flat.bulge**2 / gap
    for curvature in (1e-6, 1e-9, 1e-14):
        bend = [curvature * (which != other) for other in ("upper", "lower")]
        curved = arc_bridge(gap, 1.0, lower, upper, *bend)
        assert curved.force == pytest.approx(flat.force, abs=1e4 * curvature * size + 1e-10 * size)
        assert curved.radius_lower == pytest.approx(
            flat.radius_lower, abs=1e4 * curvature * flat.bulge / fraction + 1e-10 * flat.bulge
        )


@pytest.mark.slow
@given(
    st.floats(0.0, math.pi),
    st.floats(0.0, math.pi),
    VOLUME,
    BEND,
    st.sampled_from(["sphere", "parabola"]),
)
def test_arcs_exist_up_to_the_closed_neck_and_not_beyond(lower, upper, volume, curvature, profile):
    assume(abs(lower - upper) < math.radians(120.0))
    fixed = (volume, lower, upper, curvature, 1.0, profile)
    limit = arc_sphere.zero_neck_gap(*fixed)
    assume(math.isfinite(limit))
    fractions = np.array([0.0, 1e-6, 0.3, 0.9, 1.0 - 1e-6, 1.0 + 1e-6, 1.1, 3.0, 30.0])
    state = arc_sphere.solve(fractions * limit, *fixed)
    np.testing.assert_array_equal(state.found, fractions < 1.0)
    np.testing.assert_array_equal(state.closed, fractions > 1.0)
    assert state.neck[4] < 1e-3 * limit + state.neck[3]


@given(
    st.lists(
        st.tuples(ANGLE, ANGLE, VOLUME, st.sampled_from([0.0, 0.3, 1.0])), min_size=2, max_size=6
    )
)
def test_a_point_does_not_depend_on_its_neighbours(points):
    lower, upper, volume, curvature = (np.array(column) for column in zip(*points, strict=True))
    gap = 0.1 * np.cbrt(volume)
    many = arc_bridge(gap, volume, lower, upper, 0.0, curvature, beyond="nan")
    for i in range(len(points)):
        one = arc_bridge(gap[i], volume[i], lower[i], upper[i], 0.0, curvature[i], beyond="nan")
        for name in NAMES:
            np.testing.assert_array_equal(getattr(many, name)[i], getattr(one, name))
            assert getattr(one, name).shape == ()


def test_arguments_broadcast():
    state = arc_bridge(np.full((3, 1), 0.1), [1e-3, 1e-2], 0.5, 0.7, 0.0, np.zeros((2, 1, 1)))
    assert {column.shape for column in state} == {(2, 3, 2)}
    assert arc_bridge([], 1.0, 0.5, 0.7).force.shape == (0,)
    assert arc_bridge([], 1.0, 0.5, 0.7, 0.0, 1.0).force.shape == (0,)


def test_floats_and_arrays_agree():
    shape, gaps = arc_flat.shape(0.4, 2.0), np.geomspace(1e-4, 0.5, 20)
    x = arc_flat.contact_radius(shape, gaps, 1.0)
    for i, gap in enumerate(gaps.tolist()):
        one = arc_flat.contact_radius(shape, gap, 1.0)
        assert isinstance(one, float)
        assert one == pytest.approx(x[i], rel=1e-15)
        assert arc_flat.force(shape, gap, one) == pytest.approx(
            arc_flat.force(shape, gaps, x)[i], rel=1e-14
        )
