"""What the arc bridge says of impossible numbers and of gaps without a bridge."""

import math

import numpy as np
import pytest

from contactkit.capillary.arc import flat as arc_flat
from contactkit.capillary.arc import sphere as arc_sphere
from contactkit.capillary.arc.bridge import arc_bridge
from contactkit.errors import ConvergenceError, DescriptionError, InfeasibleError

pytestmark = pytest.mark.errors

SIXTY = math.pi / 3


@pytest.mark.parametrize(
    ("given", "message"),
    [
        ({"gap": -1e-9}, r"bridge\.gap must be zero or positive, and finite \[m\], got -1e-09"),
        ({"gap": math.nan}, r"bridge\.gap must be .* \[m\], got nan"),
        ({"gap": 0.0}, r"bridge\.gap must be positive between flats \[m\], got 0\.0; touching"),
        ({"gap": [1e-9, math.inf]}, r"bridge\.gap .* got inf"),
        ({"volume": 0.0}, r"bridge\.volume must be positive and finite \[m\^3\], got 0\.0"),
        ({"volume": "much"}, r"bridge must be given numbers or arrays that broadcast"),
        (
            {"angle_lower": 60.0},
            r"bridge\.angle_lower must lie between 0 and pi \[rad\], got 60\.0"
            r"; was it meant in degrees\?",
        ),
        ({"angle_upper": -0.1}, r"bridge\.angle_upper must lie between 0 and pi .*, got -0\.1"),
        ({"curvature_upper": -1.0}, r"bridge\.curvature_upper must be zero or positive.*\[1/m\]"),
        ({"curvature_lower": math.nan}, r"bridge\.curvature_lower must be"),
        ({"gap": [1.0, 2.0, 3.0], "volume": [1.0, 2.0]}, r"that broadcast, got \{'gap': \(3,\)"),
        ({"beyond": "maybe"}, r"bridge\.beyond must be 'raise' or 'nan', got 'maybe'"),
    ],
)
def test_impossible_arguments(given, message):
    arguments = {"gap": 1e-9, "volume": 1e-24, "angle_lower": SIXTY, "angle_upper": SIXTY}
    with pytest.raises(DescriptionError, match=message):
        arc_bridge(**{**arguments, **given})


def test_beyond_the_closed_neck_between_flats_the_limit_is_named():
    with pytest.raises(InfeasibleError, match=r"^no arc bridge beyond 45\.21 nm: there its neck"):
        arc_bridge([10e-9, 60e-9], 1e-24, SIXTY, SIXTY)
    limit = arc_flat.zero_neck_gap(arc_flat.shape(SIXTY, SIXTY), 1.0)
    with pytest.raises(InfeasibleError, match=r"beyond 4\.521 m"):
        arc_bridge(limit, 1.0, SIXTY, SIXTY)
    assert arc_bridge(limit * (1.0 - 1e-9), 1.0, SIXTY, SIXTY).neck > 0.0


def test_beyond_the_closed_neck_on_a_sphere_the_limit_is_named():
    limit = arc_sphere.zero_neck_gap(9.27e-25, SIXTY, SIXTY, 0.0, 1e7)
    with pytest.raises(InfeasibleError, match=rf"beyond {limit * 1e9:.4g} nm"):
        arc_bridge([1e-9, 1.01 * limit], 9.27e-25, SIXTY, SIXTY, 0.0, 1e7)


def test_nan_where_there_is_no_bridge_and_only_there():
    gaps = [1e-9, 60e-9, 10e-9, 1e-6]
    for curvature in (0.0, 1e7):
        state = arc_bridge(gaps, 1e-24, SIXTY, SIXTY, 0.0, curvature, beyond="nan")
        for column in state:
            np.testing.assert_array_equal(np.isnan(column), [False, True, False, True])


@pytest.mark.parametrize("curvature", [0.0, 1.0])
@pytest.mark.parametrize("angles", [(0.0, math.pi), (math.pi, 0.0), (1e-10, math.pi)])
def test_no_bridge_between_full_wetting_and_none(angles, curvature):
    with pytest.raises(InfeasibleError, match=r"no bridge between contact angles of 0 and 180 deg"):
        arc_bridge(0.1, 1.0, *angles, 0.0, curvature)
    state = arc_bridge(0.1, 1.0, [angles[0], 1.0], [angles[1], 1.0], 0.0, curvature, beyond="nan")
    np.testing.assert_array_equal(np.isnan(state.force), [True, False])


def test_arc_between_flats_refuses_too():
    with pytest.raises(InfeasibleError, match="the liquid spreads"):
        arc_flat.shape(0.0, math.pi)
    shape = arc_flat.shape(SIXTY, SIXTY)
    with pytest.raises(InfeasibleError, match=r"no arc bridge beyond 4\.521 um"):
        arc_flat.contact_radius(shape, 5e-6, 1e-18)
    with pytest.raises(InfeasibleError, match=r"no arc bridge beyond 4\.521 um"):
        arc_flat.contact_radius(shape, np.array([1e-6, 5e-6]), 1e-18)
    with pytest.raises(InfeasibleError, match=r"no arc bridge beyond 7\.464 mm"):
        arc_flat.rim_contact_radius(shape, 0.01, 1e-3)


def test_arc_that_exists_only_at_a_distance():
    """A large drop that wets one body and hardly the other has no arc near contact."""
    angles = (0.0, math.radians(168.04917228))
    assert np.isfinite(arc_bridge(0.17, 0.7239608136106821, *angles, 1.0, 1.0).force)
    with pytest.raises(InfeasibleError, match="its neck is closed there, though not up to"):
        arc_bridge(0.0, 0.7239608136106821, *angles, 1.0, 1.0)


def test_profile_and_missing_circle():
    with pytest.raises(DescriptionError, match="profile must be 'sphere' or 'parabola'"):
        arc_sphere.solve(0.1, 1e-3, 1.0, 1.0, 0.0, 1.0, "cone")
    with pytest.raises(ConvergenceError, match="no arc meets the upper body"):
        arc_sphere.volume(0.0, 0.99, 0.0, math.pi - 0.1, 0.0, 1.0)
    with pytest.raises(InfeasibleError, match="contact angles of 0 and 180"):
        arc_sphere.zero_neck_gap(1.0, 0.0, math.pi, 0.0, 1.0)
