"""Where bridge codes break: exact angles, folds, cusps, cylinders, thin films, free ends."""

import math

import numpy as np
import pytest
from selection import quick

from contactkit.capillary.exact.at_pressure import max_gap_at_pressure
from contactkit.capillary.exact.bridge import KINDS, bridge, bridge_at_pressure
from contactkit.capillary.exact.profile import profile
from contactkit.capillary.exact.stability import LIMITS, stability_limit
from contactkit.errors import DescriptionError, InfeasibleError

pytestmark = pytest.mark.hard

DEG = math.pi / 180.0
RIGHT = math.pi / 2
SPECIAL = [
    (one, two)
    for one in (0.0, RIGHT, math.pi)
    for two in (0.0, RIGHT, math.pi)
    if {one, two} != {0.0, math.pi}
]


def numbers(state):
    return {name: float(value) for name, value in state._asdict().items() if name != "kind"}


@pytest.mark.parametrize(("lower", "upper"), SPECIAL)
@pytest.mark.parametrize("curvature", [0.0, 1.0])
def test_special_angles_are_the_limits_of_their_neighbours(lower, upper, curvature):
    here = numbers(bridge(0.05, 0.1, lower, upper, 0.0, curvature))
    inward = [min(max(angle, 1e-7), math.pi - 1e-7) for angle in (lower, upper)]
    there = numbers(bridge(0.05, 0.1, *inward, 0.0, curvature))
    for name in ("force", "pressure", "radius_lower", "radius_upper", "neck", "bulge", "stiffness"):
        assert here[name] == pytest.approx(there[name], rel=1e-5, abs=1e-5), name


@pytest.mark.parametrize("curvature", [0.0, 1.0])
@pytest.mark.parametrize("angles", [(0.0, math.pi), (math.pi, 0.0)])
def test_no_bridge_between_a_wetted_and_a_repelling_body(angles, curvature):
    for refused in (
        lambda: bridge(0.01, 1.0, *angles, 0.0, curvature),
        lambda: stability_limit(1.0, *angles, 0.0, curvature),
    ):
        with pytest.raises(InfeasibleError, match=r"0 and 180 deg.*spreads"):
            refused()
    assert math.isnan(bridge(0.01, 1.0, *angles, 0.0, curvature, beyond="nan").force)


@pytest.mark.parametrize("ratio", [1e2, 1e5, 1e8])
@pytest.mark.parametrize(("one", "two"), [(60, 60), (0, 60), (0, 120), (150, 170), (90, 30)])
def test_thin_films_pull_like_two_arcs(ratio, one, two):
    """To first order in gap over radius; x/h from 1e2 to 1e8."""
    gap = (math.pi * ratio**2) ** (-1.0 / 3.0)
    state = bridge(gap, 1.0, one * DEG, two * DEG)
    radius = math.sqrt(1.0 / (math.pi * gap))
    thin = math.pi * radius**2 * (math.cos(one * DEG) + math.cos(two * DEG)) / gap
    assert float(state.force) == pytest.approx(thin, rel=6.0 / ratio)
    assert float(state.volume) == pytest.approx(1.0, rel=1e-11)


@pytest.mark.parametrize(("one", "two"), [(60, 120), (15, 165), (90, 90), (45, 135)])
@pytest.mark.parametrize("gap", [1e-4, 1e-3, 0.1])
def test_straight_films(one, two, gap):
    """Angles that add up to 180: the meridian is upright in the mean, the force finite."""
    state = bridge(gap, 1.0, one * DEG, two * DEG)
    radius = 1.0 / math.sqrt(math.pi * gap)
    assert float(state.force) == pytest.approx(
        math.pi * radius * math.sin(one * DEG), rel=8.0 * gap**1.5
    )
    assert float(state.volume) == pytest.approx(1.0, rel=1e-9)


FOLDS = [
    (0, 0, 0.0, 0.0),
    (60, 61, 0.0, 0.0),
    (15, 165, 0.0, 0.0),
    (40, 40, 0.0, 0.1),
    (0, 60, 0.0, 0.1),
    (20, 20, 0.1, 0.1),
    (120, 110, 0.0, 0.2),
    (30, 120, 0.0, 0.5),
]


@pytest.mark.parametrize("case", quick([(one,) for one in FOLDS], 0, 2, 4, 6), ids=str)
def test_close_to_a_fold_the_force_has_a_root(case):
    """F - F* is proportional to the root of the distance to the fold, down to 1e-10 of it."""
    one, two, *bend = case
    fixed = (1.0, one * DEG, two * DEG, *bend)
    limit = stability_limit(*fixed)
    assert LIMITS[int(limit.kind)] == "fold"
    distance = np.array([1e-6, 1e-8, 1e-10])
    state = bridge(limit.gap * (1.0 - distance), *fixed)
    slope = (state.force - limit.force) / np.sqrt(distance)
    assert slope == pytest.approx(slope[1], rel=2e-2)
    assert np.all(slope > 0.0)
    assert state.stiffness * np.sqrt(distance) * -2.0 * limit.gap == pytest.approx(slope, rel=2e-2)
    assert float(bridge(limit.gap, *fixed).force) == pytest.approx(float(limit.force), rel=1e-6)


@pytest.mark.parametrize(
    ("one", "two"), quick([(60, 60), (0, 0), (90, 90), (180, 120), (15, 165)], 0, 3)
)
@pytest.mark.parametrize("curvature", [0.0, 1.0])
def test_nothing_is_given_beyond_the_limit(one, two, curvature):
    fixed = (1e-24, one * DEG, two * DEG, 0.0, 1e7 * curvature)
    limit = float(stability_limit(*fixed).gap)
    gaps = limit * np.array([0.5, 1.0 + 1e-9, 1.1, 3.0, 100.0])
    state = bridge(gaps, *fixed, beyond="nan")
    assert np.isfinite(state.force).tolist() == [True, False, False, False, False]
    assert state.kind.tolist()[1:] == [-1] * 4
    with pytest.raises(InfeasibleError, match=rf"no bridge beyond {limit * 1e9:.4g} nm"):
        bridge(gaps, *fixed)


def test_the_limit_has_a_cusp_at_equal_angles():
    """60/60 1.4205, and off it a 2/3 power, down to 1e-5 deg."""
    off = np.array([1e-5, 1e-4, 1e-3])
    limit = stability_limit(1.0, 60 * DEG, (60 + np.append(0.0, off)) * DEG)
    assert [LIMITS[kind] for kind in limit.kind] == ["pitchfork", "fold", "fold", "fold"]
    lost = limit.gap[0] - limit.gap[1:]
    assert lost / off ** (2.0 / 3.0) == pytest.approx(lost[0] / off[0] ** (2.0 / 3.0), rel=0.02)
    mirrored = stability_limit(1.0, (60 + off) * DEG, 60 * DEG).gap
    assert mirrored == pytest.approx(limit.gap[1:], rel=1e-13)


def test_near_right_angles_the_limit_is_near_that_of_the_cylinder():
    off = np.array([1e-9, 1e-7, 1e-5])
    limit = stability_limit(1.0, RIGHT, RIGHT + off).gap
    lost = math.pi ** (1.0 / 3.0) - limit
    assert np.all(lost > 0.0)
    assert lost / off ** (2.0 / 3.0) == pytest.approx(lost[1] / off[1] ** (2.0 / 3.0), rel=0.05)
    symmetric = stability_limit(1.0, RIGHT + off, RIGHT + off).gap
    assert symmetric == pytest.approx(math.pi ** (1.0 / 3.0), rel=1e-4)


@pytest.mark.parametrize("upper", [30, 60, 120, 179, 180])
@pytest.mark.parametrize("curvature", [0.0, 0.3])
def test_the_force_goes_to_zero_at_detachment(upper, curvature):
    fixed = (1.0, math.pi, upper * DEG, 0.0, curvature)
    limit = stability_limit(*fixed)
    assert LIMITS[int(limit.kind)] == "detachment"
    state = bridge(limit.gap * (1.0 - np.array([1e-2, 1e-4, 1e-6])), *fixed)
    assert np.all(state.force < 0.0)
    assert np.all(np.diff(abs(state.force)) < 0.0)
    assert abs(float(state.force[-1])) < 1e-4
    assert np.all(np.diff(state.radius_lower) < 0.0)


FREE = [
    (8, 156, 3e-3, 0.0),
    (30, 120, 0.1, 0.0),
    (15, 117, 0.07, 0.9),
    (60, 75, 0.1, 0.5),
    (0, 165, 1e-3, 0.0),
    (75, 90, 0.01, 0.0),
]


@pytest.mark.parametrize("case", quick([(one,) for one in FREE], 0, 3), ids=str)
def test_a_wetted_and_a_repelling_body_that_touch(case):
    """The phase of an end passes minus a right angle, out of every chart; nothing jumps there."""
    one, two, volume, bend = case
    fixed = (volume, one * DEG, two * DEG, bend, 1.0)
    limit = float(stability_limit(*fixed).gap)
    gaps = limit * np.linspace(0.0, 0.98, 50)
    state = bridge(gaps, *fixed)
    assert state.volume == pytest.approx(volume, rel=1e-10)
    middle = 0.5 * (state.stiffness[1:] + state.stiffness[:-1])
    assert np.diff(state.force) / np.diff(gaps) == pytest.approx(middle, rel=0.1, abs=0.05)


@pytest.mark.parametrize("volume", [1e-60, 1e-24, 1.0, 1e30])
def test_any_size(volume):
    size = volume ** (1.0 / 3.0)
    state = bridge(0.1 * size, volume, 0.4, 0.6, 0.0, 0.3 / size)
    one = bridge(0.1, 1.0, 0.4, 0.6, 0.0, 0.3)
    assert float(state.force) == pytest.approx(size * float(one.force), rel=1e-12)


def test_traces_of_liquid_and_ratios_of_a_million():
    state = bridge(1e-6, 1e-6, 60 * DEG, 60 * DEG, 0.0, 1.0)
    zero = bridge(0.0, 1e-6, 60 * DEG, 60 * DEG, 0.0, 1.0)
    mean = 0.5 * (float(zero.stiffness) + float(state.stiffness))
    assert float(state.force) == pytest.approx(float(zero.force) + 1e-6 * mean, rel=1e-8)
    tiny = bridge(1e-5, 1e-8, 0.0, 0.0, 1.0, 1.0)
    assert float(tiny.force) == pytest.approx(5.486245554756386, rel=1e-12)


def test_kinds_along_a_separation():
    state = bridge([0.3, 0.7, 0.8], 1.0, 60 * DEG, 60 * DEG)
    assert [KINDS[i] for i in state.kind] == ["nodoid P<0", "nodoid P<0", "unduloid"]
    state = bridge([0.3, 0.8], 1.0, 120 * DEG, 120 * DEG)
    assert [KINDS[i] for i in state.kind] == ["nodoid P>0", "unduloid"]


def test_a_weak_sphere_is_a_flat():
    flat = bridge([0.01, 0.5], 1.0, 0.5, 1.0)
    for bend in (1e-80, 1e-14, 1e-9):
        curved = bridge([0.01, 0.5], 1.0, 0.5, 1.0, 0.0, bend)
        assert curved.force == pytest.approx(flat.force, rel=1e4 * bend + 1e-12)


def test_many_different_bridges_at_once_are_those_one_by_one():
    rng = np.random.default_rng(3)
    angles, volumes = rng.uniform(0.1, 1.4, (2, 40)), 10.0 ** rng.uniform(-6, -1, 40)
    bend = np.where(rng.random(40) < 0.5, 0.0, rng.uniform(0.1, 1.0, 40))
    gaps = 0.3 * np.cbrt(volumes)
    state = bridge(gaps, volumes, *angles, bend, 1.0)
    for i in range(0, 40, 5):
        one = bridge(gaps[i], volumes[i], *angles[:, i], bend[i], 1.0)
        assert float(one.force) == pytest.approx(float(state.force[i]), rel=1e-12)
    assert bridge(np.full((2, 1), 0.2), np.ones(3), 0.3, 0.4).force.shape == (2, 3)
    assert bridge(np.zeros(0), 1.0, 0.3, 0.4).force.shape == (0,)


def test_at_fixed_pressure():
    with pytest.raises(InfeasibleError, match="between flats is stable at fixed pressure"):
        bridge_at_pressure(1e-9, -1e8, 0.0, 0.0)
    with pytest.raises(InfeasibleError, match="even between touching bodies"):
        bridge_at_pressure(0.0, -1e8, 2.0, 2.0, 0.0, 1e6)
    longest = max_gap_at_pressure(-1e8, 0.3, 0.3, 0.0, 1e6)
    state = bridge_at_pressure(
        longest * np.array([0.0, 0.9, 0.999999, 1.01]), -1e8, 0.3, 0.3, 0.0, 1e6, beyond="nan"
    )
    assert np.isnan(state.force).tolist() == [False, False, False, True]
    assert state.pressure[:3] == pytest.approx(-1e8, rel=1e-13)
    with pytest.raises(InfeasibleError, match=f"no bridge beyond {longest * 1e9:.4g} nm"):
        bridge_at_pressure(longest * 1.01, -1e8, 0.3, 0.3, 0.0, 1e6)


@pytest.mark.parametrize(
    ("change", "match"),
    [
        ({"gap": -1.0}, r"bridge\.gap"),
        ({"volume": 0.0}, r"bridge\.volume"),
        ({"angle_lower": 60.0}, r"angle_lower.*degrees"),
        ({"curvature_upper": -1.0}, "curvature"),
        ({"gap": math.nan}, r"bridge\.gap"),
        ({"beyond": "zero"}, r"bridge\.beyond"),
        ({"gap": 0.0}, "touching flats"),
    ],
)
def test_arguments_are_checked(change, match):
    given = {"gap": 0.1, "volume": 1.0, "angle_lower": 0.5, "angle_upper": 0.5} | change
    with pytest.raises(DescriptionError, match=match):
        bridge(**given)


def test_pressure_and_profile_are_checked():
    with pytest.raises(DescriptionError, match=r"bridge\.pressure"):
        bridge_at_pressure(0.0, math.inf, 0.5, 0.5, 0.0, 1.0)
    with pytest.raises(DescriptionError, match=r"profile\.count"):
        profile(bridge(0.1, 1.0, 0.5, 0.5), 1)
    with pytest.raises(DescriptionError, match=r"profile\.state"):
        profile(bridge([0.1, 0.2], 1.0, 0.5, 0.5))
