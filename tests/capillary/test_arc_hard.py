"""Where arc codes break: exact angles, straight arcs, touching bodies, traces of liquid, limits."""

import json
import math
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

import contactkit
from contactkit.capillary.arc import flat as arc_flat
from contactkit.capillary.arc import sphere as arc_sphere
from contactkit.capillary.arc.bridge import arc_bridge

pytestmark = pytest.mark.hard

CASES = json.loads((Path(__file__).parents[1] / "data" / "separation.json").read_text())
EXACT = {case["id"]: case for case in CASES["exact_bridge"]}
DEG = math.pi / 180.0
RIGHT = math.pi / 2
SPECIAL = [
    (one, two)
    for one in (0.0, RIGHT, math.pi)
    for two in (0.0, RIGHT, math.pi)
    if {one, two} != {0.0, math.pi}
]


@pytest.mark.parametrize(("lower", "upper"), SPECIAL)
@pytest.mark.parametrize("curvature", [0.0, 1.0])
def test_special_angles_are_the_limits_of_their_neighbours(lower, upper, curvature):
    """No 0.001 or 89.999 deg is needed."""
    here = arc_bridge(0.05, 0.1, lower, upper, 0.0, curvature)
    inward = [min(max(angle, 1e-7), math.pi - 1e-7) for angle in (lower, upper)]
    there = arc_bridge(0.05, 0.1, *inward, 0.0, curvature)
    for one, two in zip(here, there, strict=True):
        assert one == pytest.approx(two, rel=1e-5, abs=1e-5)
        assert np.isfinite(one)


def test_right_angle_and_straight_arcs_have_exactly_no_curvature():
    assert arc_flat.shape(RIGHT, RIGHT).inverse_radius == 0.0
    assert arc_flat.shape(RIGHT, RIGHT).variance == 0.0
    assert abs(arc_flat.shape(15 * DEG, 165 * DEG).inverse_radius) < 1e-15
    assert arc_flat.wetting(0.0, 0.0) == 2.0
    assert arc_flat.wetting(math.pi, math.pi) == -2.0


def test_trace_of_liquid_on_a_touching_sphere():
    case = EXACT["sphere/flat_40_40_V1e-15_D0"]
    state = arc_bridge(0.0, 1e-15, 40 * DEG, 40 * DEG, 0.0, 1.0)
    assert state.force == pytest.approx(case["F_over_gamma"], rel=1e-5)
    assert state.neck == pytest.approx(case["neck"], rel=1e-8)
    less = arc_bridge(0.0, 10.0 ** -np.arange(15.0, 60.0, 5.0), 0.0, RIGHT, 0.0, 1.0)
    assert np.all(np.diff(less.force) > 0.0)  # rises to 2 pi R as the liquid vanishes
    assert less.force[-1] == pytest.approx(2.0 * math.pi, rel=1e-10)


def test_bodies_as_small_and_as_large_as_they_come():
    unit = arc_bridge(0.01, 1e-3, 1.0, 0.5, 0.3, 1.0)
    for scale in (1e-12, 1e-9, 1e6):
        state = arc_bridge(0.01 * scale, 1e-3 * scale**3, 1.0, 0.5, 0.3 / scale, 1.0 / scale)
        assert state.force / scale == pytest.approx(unit.force, rel=1e-12)


def test_gap_ratio_of_a_million_in_one_call():
    gaps = np.append(0.0, np.geomspace(1e-7, 0.1, 200))
    state = arc_bridge(gaps, 1e-3, 60 * DEG, 60 * DEG, 0.0, 1.0)
    assert np.all(np.isfinite(state.force))
    assert np.all(np.diff(state.force) < 0.0)
    assert state.force[1] == pytest.approx(state.force[0], rel=1e-5)


def test_films_a_hundred_thousand_times_wider_than_high():
    case = EXACT["flat_0_60_x/h~100000"]
    state = arc_bridge(case["D"], case["V"], 0.0, 60 * DEG)
    assert state.force == pytest.approx(case["F_over_gamma"], rel=1e-5)
    assert state.neck == pytest.approx(case["neck"], rel=1e-10)


def test_two_flats_of_almost_no_curvature_touch():
    """The film spreads over a hundred radii of its own drop, and Newton must not mind."""
    state = arc_bridge(0.0, 1.0, 1.0, 1.0, 1e-12, 1e-9)
    curvature = 1e-12 + 1e-9
    film = 2.0 * math.pi / curvature * 2.0 * math.cos(1.0)
    assert state.force == pytest.approx(film, rel=1e-3)


def test_repulsion_between_wetted_bodies_on_a_wide_film():
    """On a sphere the slope adds to the contact angle: 85/85 deg pushes."""
    state = arc_bridge(0.0, 0.1, 85 * DEG, 85 * DEG, 0.0, 1.0)
    case = EXACT["sphere/flat_85_85_V0.1_D0"]
    assert state.force == pytest.approx(case["F_over_gamma"], rel=0.06)


def test_repelled_pair_turns_from_push_to_pull():
    state = arc_bridge([0.5, 1.0], 1.0, 120 * DEG, 120 * DEG)
    assert state.force[0] < 0.0 < state.force[1]


@pytest.mark.parametrize("profile", ["sphere", "parabola"])
@pytest.mark.parametrize("gap", [0.0, 1e-3])
def test_a_drop_that_swallows_much_of_the_sphere(gap, profile):
    volumes = np.geomspace(1e-15, 1.0, 60)
    state = arc_sphere.solve(gap * np.cbrt(volumes), volumes, 30 * DEG, 50 * DEG, 0.0, 1.0, profile)
    assert state.found.all()
    assert np.all(np.diff(state.radius_upper) > 0.0)
    again = [
        arc_sphere.volume(float(gap * np.cbrt(v)), float(x), 30 * DEG, 50 * DEG, 0.0, 1.0, profile)
        for v, x in zip(volumes, state.radius_upper, strict=True)
    ]
    np.testing.assert_allclose(again, volumes, rtol=1e-10)


def test_drop_beyond_the_equator():
    state = arc_bridge(0.0, 8.0, 0.0, 0.0, 0.0, 1.0)
    assert 0.0 < state.radius_upper <= 1.0
    assert np.isfinite(state.force)


@pytest.mark.parametrize(
    ("lower", "upper", "volume", "curvature", "gap"),
    [
        (0.0, 176.35068981078402, 1.1064565235563154e-05, 0.0, 1.2583717803310006e-07),
        (0.0, 179.75111979096724, 0.0026461867126356363, 0.0, 0.0006185917359202562),
        (90.0, 81.46085653322908, 0.600304350448702, 0.10320377582185936, 8.5),
        (90.0, 78.52233649836178, 0.18332276974302475, 0.05128516440884455, 5.0),
        (83.80697607391473, 58.09515490941545, 0.27550955925879017, 0.07966925112203671, 4.4),
        (0.0, 170.50102888927773, 0.0080765712946378, 0.0, 0.0),
    ],
)
def test_points_that_newton_misses_from_a_cold_start(lower, upper, volume, curvature, gap):
    state = arc_sphere.solve([gap, 0.5 * gap], volume, lower * DEG, upper * DEG, curvature, 1.0)
    assert state.found.all() or (~state.found == state.closed).all()
    if state.found[0]:
        assert 0.0 < state.neck[0] <= state.radius_upper[0]


def test_branch_with_an_open_neck_is_taken_up_to_its_end():
    limit = arc_sphere.zero_neck_gap(1e-3, 40 * DEG, 40 * DEG, 0.0, 1.0)
    gaps = limit * (1.0 - np.geomspace(1e-9, 1.0, 100))
    state = arc_bridge(gaps, 1e-3, 40 * DEG, 40 * DEG, 0.0, 1.0)
    assert np.all(state.neck > 0.0)
    assert np.all(np.diff(state.neck) > 0.0)
    assert state.force[0] == pytest.approx(0.0, abs=1e-8)  # goes to zero with the neck


def test_nearly_a_cylinder_breaks_very_late():
    near = arc_flat.zero_neck_gap(arc_flat.shape(RIGHT, RIGHT - 1e-6), 1.0)
    assert 1e3 < near < math.inf
    assert arc_flat.zero_neck_gap(arc_flat.shape(RIGHT, RIGHT), 1.0) == math.inf
    assert arc_sphere.zero_neck_gap(1e-3, RIGHT, RIGHT, 0.0, 1.0) == math.inf
    assert arc_sphere.zero_neck_gap(1e-9, RIGHT, RIGHT, 1.0, 0.3) == math.inf
    assert arc_sphere.zero_neck_gap(1e-9, RIGHT, RIGHT + 0.1, 1.0, 0.3) < 0.1


def test_needle_between_a_sphere_and_a_flat_keeps_its_cone():
    """For 90/90 deg the contact radii differ as 1 + D / 2R, however thin the bridge."""
    gaps = np.array([0.1, 1.0, 10.0, 50.0])
    state = arc_bridge(gaps, 1e-9, RIGHT, RIGHT, 0.0, 1.0)
    np.testing.assert_allclose(state.radius_lower / state.radius_upper, 1.0 + gaps / 2.0, rtol=1e-6)


def test_zero_neck_of_a_cap_height():
    """With one angle of 180 deg the arc is exact: the gap is the height of the cap left."""
    limit = arc_flat.zero_neck_gap(arc_flat.shape(math.pi, 60 * DEG), 1.0)
    height = 0.5758823822969722
    assert limit == pytest.approx(height, rel=1e-12)


@pytest.mark.parametrize("module", ["capillary.arc.flat", "as_published.printed.common"])
def test_kernel_runs_in_a_bare_interpreter(module):
    """As inside an FMU, where there is no numpy: modules are imported without the package."""
    root = Path(contactkit.__file__).parent
    package, _, name = module.rpartition(".")
    code = f"""
import sys, types
sys.modules["numpy"] = None
package = types.ModuleType("contactkit")
package.__path__ = [{str(root)!r}]
sys.modules["contactkit"] = package
from contactkit.{package} import {name} as kernel
if "arc" in kernel.__name__:
    shape = kernel.shape(1.0, 0.5)
    print(kernel.force(shape, 0.1, kernel.contact_radius(shape, 0.1, 1.0)) > 0.0)
else:
    print(kernel.viscous_sphere_3_26(1.0, 0.1, 0.2, 1.0, 1.0, 1.0) > 0.0)
"""
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=False)
    assert done.stdout.strip() == "True", done.stderr
