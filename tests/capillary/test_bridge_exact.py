"""The exact bridge against reference values, closed forms, and an integration of its meridian."""

import json
import math
from pathlib import Path

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from contactkit.capillary.exact.at_pressure import max_gap_at_pressure
from contactkit.capillary.exact.bridge import (
    KINDS,
    bridge,
    bridge_at_pressure,
    laterally_stable,
    margin,
)
from contactkit.capillary.exact.profile import profile
from contactkit.capillary.exact.stability import LIMITS, stability_limit

DATA = Path(__file__).parents[1] / "data"
CASES = json.loads((DATA / "separation.json").read_text()) | json.loads(
    (DATA / "bridges.json").read_text()
)
DEG = math.pi / 180.0
RTOL = 1e-12  # what the reference is good for; it loses two digits near a fold


def named(group, has=()):
    return [
        pytest.param(case, id=case.get("id", f"{case.get('theta1_deg')}_{case.get('theta2_deg')}"))
        for case in CASES[group]
        if all(key in case for key in has)
    ]


def fixed(case):
    angles = (case["theta1_deg"] * DEG, case["theta2_deg"] * DEG)
    return (*angles, case.get("kappa1", 0.0), case.get("kappa2", 0.0))


def compare(state, case, rtol=RTOL):
    for name, key in (
        ("force", "F_over_gamma"),
        ("pressure", "P_over_gamma"),
        ("radius_lower", "r1"),
        ("radius_upper", "r2"),
        ("neck", "neck"),
        ("bulge", "bulge"),
        ("volume", "V"),
    ):
        if key in case:
            assert float(getattr(state, name)) == pytest.approx(case[key], rel=rtol), name
    if "kind" in case:
        assert KINDS[int(state.kind)] == case["kind"]


@pytest.mark.parametrize("case", named("exact_bridge"))
def test_reference_bridges(case):
    compare(bridge(case["D"], case["V"], *fixed(case)), case)


@pytest.mark.parametrize("case", named("exact_fixed_pressure"))
def test_reference_bridges_at_a_pressure(case):
    compare(bridge_at_pressure(case["D"], case["P_over_gamma"], *fixed(case)), case)


@pytest.mark.parametrize("case", named("exact_special", ["theta1_deg", "D"]))
def test_catenoids_and_spheres(case):
    state = bridge(case["D"], case["V"], *fixed(case))
    compare(state, case)
    assert KINDS[int(state.kind)] == ("sphere" if case["F_over_gamma"] == 0.0 else "catenoid")


@pytest.mark.parametrize("case", named("exact_limit"))
def test_reference_limits(case):
    limit = stability_limit(case["V"], *fixed(case))
    assert float(limit.gap) == pytest.approx(case["D_limit"], rel=1e-12)
    assert LIMITS[int(limit.kind)] == case["kind"]
    for name, key in (
        ("force", "F_over_gamma"),
        ("pressure", "P_over_gamma"),
        ("radius_lower", "r1"),
        ("radius_upper", "r2"),
    ):
        assert float(getattr(limit, name)) == pytest.approx(case[key], rel=1e-10), name


@pytest.mark.parametrize("case", named("limit_table_flat"))
def test_limits_between_flats(case):
    limit = stability_limit(1.0, *fixed(case))
    assert float(limit.gap) == pytest.approx(case["D_limit_over_L"], rel=1e-12)
    assert LIMITS[int(limit.kind)].startswith(case["kind"])


@pytest.mark.parametrize("case", named("exact_special", ["D_limit"]))
def test_a_drop_is_left_when_a_repelling_body_is_detached(case):
    limit = stability_limit(case["V"], *fixed(case))
    assert float(limit.gap) == pytest.approx(case["D_limit"], rel=1e-12)
    assert float(limit.force) == float(limit.radius_lower) == 0.0


@pytest.mark.parametrize("gap", [1e-6, 0.2, 1.0, 1.4])
def test_cylinders_between_flats(gap):
    state = bridge(gap, 1.0, math.pi / 2, math.pi / 2)
    radius = 1.0 / math.sqrt(math.pi * gap)
    assert float(state.force) == pytest.approx(math.pi * radius, rel=1e-15)
    assert float(state.neck) == float(state.bulge) == pytest.approx(radius, rel=1e-15)
    assert float(margin(gap, 1.0, math.pi / 2, math.pi / 2)) == pytest.approx(
        1.0 - gap / math.pi ** (1.0 / 3.0)
    )


@pytest.mark.parametrize("degrees", [20, 60, 85])
@pytest.mark.parametrize("both", [True, False])
def test_cylinders_between_spheres(degrees, both):
    """A cylinder of radius sin(b) meets unit spheres at the angle 90 - b; flats at 90."""
    beta = degrees * DEG
    radius, gap = math.sin(beta), 0.3
    sag = 1.0 - math.cos(beta)
    ends = 2 if both else 1
    cap = math.pi * sag**2 * (3.0 - sag) / 3.0
    volume = math.pi * radius**2 * (gap + ends * sag) - ends * cap
    angles = (math.pi / 2 - beta if both else math.pi / 2, math.pi / 2 - beta)
    state = bridge(gap, volume, *angles, 1.0 if both else 0.0, 1.0)
    assert float(state.force) == pytest.approx(math.pi * radius, rel=1e-12)
    assert float(state.radius_upper) == pytest.approx(radius, rel=1e-12)
    assert float(state.neck) == pytest.approx(radius, rel=1e-12)


def pitchfork(degrees):
    """Closed form for unit pressure: neck and bulge 1 -+ |cos t|, inflections on the plates."""
    c = abs(math.cos(degrees * DEG))
    hollow = -1.0 if degrees < 90.0 else 1.0
    nodes, weights = np.polynomial.legendre.leggauss(60)
    end = math.acos(-hollow * c)  # arc length at which r = sin t
    r = np.sqrt(1.0 + c * c + hollow * 2.0 * c * np.cos(end * nodes))
    rise = 0.5 * (r * r + 1.0 - c * c) / r
    height, volume = (end * (weights @ value) for value in (rise, math.pi * r * r * rise))
    return height / volume ** (1.0 / 3.0)


@pytest.mark.parametrize("degrees", [32, 45, 60, 89, 91, 120, 170])
def test_symmetry_breaks_where_the_inflection_reaches_the_plates(degrees):
    limit = stability_limit(1.0, degrees * DEG, degrees * DEG)
    assert LIMITS[int(limit.kind)] == "pitchfork"
    assert float(limit.gap) == pytest.approx(pitchfork(degrees), rel=1e-12)


def test_the_limit_of_equal_angles_changes_its_kind_at_31_degrees():
    kinds = stability_limit(1.0, [31.14 * DEG, 31.15 * DEG], [31.14 * DEG, 31.15 * DEG]).kind
    assert [LIMITS[kind] for kind in kinds] == ["fold", "pitchfork"]


SHAPES = [
    (0.3, 1.0, 60, 60, 0.0, 0.0),
    (0.9, 1.0, 20, 20, 0.0, 0.0),
    (0.5, 1.0, 30, 120, 0.0, 0.0),
    (1.0, 1.0, 120, 120, 0.0, 0.0),
    (0.05, 1e-3, 40, 70, 0.0, 1.0),
    (0.1, 0.1, 110, 95, 0.0, 1.0),
    (0.02, 1e-2, 10, 30, 1.0, 0.4),
    (0.0, 0.1, 30, 30, 0.0, 1.0),
    (0.03, 0.1, 30, 120, 0.0, 1.0),
]


@pytest.mark.parametrize("case", SHAPES, ids=str)
def test_the_meridian_obeys_young_and_laplace(case):
    """Another method: integrate from the lower contact line with pressure and radius only."""
    gap, volume, one, two, below, above = case
    state = bridge(gap, volume, one * DEG, two * DEG, below, above)
    pressure, start, length = state.pressure, state.radius_lower, state.arc_lower + state.arc_upper
    slope = math.asin(below * start)

    def meridian(s, y):
        r, _, phi, _ = y
        sine = math.sin(phi)
        return [math.cos(phi), sine, pressure - sine / r, math.pi * r * r * sine]

    first = [float(start), 0.0, math.pi - one * DEG - slope, 0.0]
    found = solve_ivp(
        meridian, (0.0, float(length)), first, method="DOP853", rtol=1e-12, atol=1e-14
    )
    r, z, phi, v = found.y[:, -1]
    lean = math.asin(above * r)
    sags = [x * math.tan(0.5 * b) for x, b in ((start, slope), (r, lean))]
    caps = [math.pi / 6 * s * (3 * x * x + s * s) for s, x in zip(sags, (start, r), strict=True)]
    assert r == pytest.approx(float(state.radius_upper), rel=1e-9)
    assert phi == pytest.approx(two * DEG + lean, abs=1e-9)
    assert z - sum(sags) == pytest.approx(gap, abs=1e-9)
    assert v - sum(caps) == pytest.approx(volume, rel=1e-9)
    radii, heights = profile(state, 201)
    assert heights[-1] == pytest.approx(z, rel=1e-10)
    assert radii[[0, -1]] == pytest.approx([float(start), r], rel=1e-9)
    assert radii.min() >= float(state.neck) * (1.0 - 1e-12)
    assert radii.max() <= float(state.bulge) * (1.0 + 1e-12)


def test_a_trace_between_touching_bodies_pulls_with_the_wetting_of_both():
    """1 - F/F0 = 0.3089 (V/R^3)^(1/4) at 40 degrees."""
    state = bridge(0.0, [1e-15, 1e-12], 40 * DEG, 40 * DEG, 0.0, 1.0)
    lost = 1.0 - state.force / (4.0 * math.pi * math.cos(40 * DEG))
    assert lost == pytest.approx(0.3089 * np.array([1e-15, 1e-12]) ** 0.25, rel=2e-3)


def test_a_bridge_of_a_vapour_approaches_the_linear_law_where_it_is_small():
    film = 2e-6  # the Kelvin radius times two cosines of one
    gaps = np.array([0.0, 0.3, 0.6]) * film
    state = bridge_at_pressure(gaps, -1e6, 0.0, 0.0, 0.0, 1.0)
    assert state.force == pytest.approx(4.0 * math.pi * (1.0 - gaps / film), rel=6e-3)
    assert max_gap_at_pressure(-1e6, 0.0, 0.0, 0.0, 1.0) == pytest.approx(film, rel=0.02)


def test_what_repels_on_a_sphere_is_expelled_sideways():
    state = bridge([0.02, 0.2], 0.01, 120 * DEG, 120 * DEG, 0.0, 1.0)
    assert laterally_stable(state.force, 0.0, 1.0).tolist() == [False, True]
    assert laterally_stable(-1.0).all()
