"""The arc model against reference values, closed forms and an integration of its own circle."""

import json
import math
from pathlib import Path

import numpy as np
import pytest
from scipy.integrate import quad

from contactkit.capillary.arc import flat as arc_flat
from contactkit.capillary.arc import sphere as arc_sphere
from contactkit.capillary.arc.bridge import arc_bridge
from contactkit.numerics.quadrature import gauss_legendre

CASES = json.loads((Path(__file__).parents[1] / "data" / "separation.json").read_text())
RTOL = 1e-12  # what the reference states are good for
DEG = math.pi / 180.0


def named(group):
    return [pytest.param(case, id=case.get("id", str(i))) for i, case in enumerate(CASES[group])]


def angles(case):
    return case["theta1_deg"] * DEG, case["theta2_deg"] * DEG


@pytest.mark.parametrize("case", named("arc_flat"))
def test_arc_between_flats(case):
    shape, gap = arc_flat.shape(*angles(case)), case["D"]
    x = arc_flat.contact_radius(shape, gap, case["V"])
    assert x == pytest.approx(case["x1"], rel=RTOL)
    assert arc_flat.upper_contact_radius(shape, gap, x) == pytest.approx(case["x2"], rel=RTOL)
    assert arc_flat.neck(shape, gap, x) == pytest.approx(case["neck"], rel=RTOL)
    assert arc_flat.force(shape, gap, x) == pytest.approx(case["F_consistent"], rel=RTOL)
    assert arc_flat.volume(shape, gap, x) == pytest.approx(case["V"], rel=RTOL)
    radius = float(case["r1_arc"])
    assert shape.inverse_radius / gap == pytest.approx(1.0 / radius, rel=RTOL, abs=1e-15)


@pytest.mark.parametrize("case", named("arc_sphere"))
def test_arc_on_a_sphere(case):
    state = arc_sphere.solve(
        case["D"], case["V"], *angles(case), 0.0, 1.0 / case["R"], case["profile"]
    )
    assert state.radius_upper == pytest.approx(case["x_n"], rel=RTOL)
    assert state.radius_lower == pytest.approx(case["x_flat"], rel=RTOL)
    assert state.neck == pytest.approx(case["neck"], rel=RTOL)
    assert state.force == pytest.approx(case["F_consistent"], rel=RTOL)
    assert state.height == pytest.approx(case["s"], rel=RTOL)
    assert 1.0 / state.inverse_arc_radius == pytest.approx(case["r1_arc"], rel=RTOL)
    again = arc_sphere.volume(
        case["D"], float(state.radius_upper), *angles(case), 0.0, 1.0, case["profile"]
    )
    assert again == pytest.approx(case["V"], rel=1e-11)


@pytest.mark.parametrize("case", CASES["arc_break_flat_D_over_cuberootV"])
def test_closed_neck_between_flats(case):
    shape = arc_flat.shape(*angles(case))
    assert arc_flat.zero_neck_gap(shape, 8.0) == pytest.approx(2.0 * case["D_over_L"], rel=1e-12)


@pytest.mark.parametrize("case", CASES["limit_table_flat"])
def test_closed_neck_of_the_whole_table(case):
    limit = arc_flat.zero_neck_gap(arc_flat.shape(*angles(case)), 1.0)
    assert limit == pytest.approx(float(case["arc_zero_neck_over_L"]), rel=1e-12)


@pytest.mark.parametrize(
    "case",
    [case for case in named("exact_limit") if "arc_zero_neck_break_parabola" in case.values[0]],
)
def test_closed_neck_on_a_paraboloid(case):
    limit = arc_sphere.zero_neck_gap(
        case["V"], *angles(case), case["kappa1"], case["kappa2"], "parabola"
    )
    assert limit == pytest.approx(case["arc_zero_neck_break_parabola"], rel=1e-12)


@pytest.mark.parametrize("row", CASES["source_printed_numbers"]["sphere_rows"])
def test_the_case_of_the_dissertation(row):
    """R = 100 nm, D0 = 1 nm, 60/60 deg on a paraboloid: 45.2 to 104.1 nm, 28.9 to 48.1 nN."""
    start = math.sqrt(200.0 * (row["s0_nm"] - 1.0))
    fixed = (60.0 * DEG, 60.0 * DEG, 0.0, 0.01, "parabola")
    volume = arc_sphere.volume(1.0, start, *fixed)
    assert volume == pytest.approx(row["V_arc_nm3"], rel=RTOL)
    assert arc_sphere.zero_neck_gap(volume, *fixed) == pytest.approx(
        row["arc_zero_neck_break_nm"], rel=1e-12
    )
    state = arc_sphere.solve([1.0, row["printed_break_read_as_1e1_nm"]], volume, *fixed)
    assert 0.072 * state.force[0] == pytest.approx(row["F_meniscus_gorge_nN"], rel=RTOL)
    assert state.neck[1] == pytest.approx(row["arc_neck_at_printed_break_nm"], rel=1e-11)


@pytest.mark.parametrize("row", CASES["source_printed_numbers"]["flat_rows"])
def test_flats_of_the_dissertation(row):
    shape, gap = arc_flat.shape(*angles(row)), row["h0_nm"]
    x = arc_flat.rim_contact_radius(shape, gap, row["x_n0_nm"])
    assert max(x, arc_flat.upper_contact_radius(shape, gap, x)) == row["x_n0_nm"]
    x = row["x_n0_nm"]  # the source counts the lower contact radius
    volume = arc_flat.volume(shape, gap, x)
    assert volume == pytest.approx(row["V_arc_nm3"], rel=RTOL)
    assert arc_flat.zero_neck_gap(shape, volume) == pytest.approx(row["arc_break_nm"], rel=RTOL)


@pytest.mark.parametrize(("lower", "upper"), [(60, 60), (0, 0), (30, 75), (120, 120), (150, 100)])
def test_volume_is_that_of_the_circle_turned_about_the_axis(lower, upper):
    """Nothing of the kernel's moments is used: the circle is integrated as x(y)."""
    shape, gap = arc_flat.shape(lower * DEG, upper * DEG), 0.3
    x = arc_flat.contact_radius(shape, gap, 1.0)
    radius = gap / (math.cos(lower * DEG) + math.cos(upper * DEG))
    centre, level = x + radius * math.sin(lower * DEG), radius * math.cos(lower * DEG)

    def square(y):
        return (centre - math.copysign(1.0, radius) * math.sqrt(radius**2 - (y - level) ** 2)) ** 2

    inside, _ = quad(square, 0.0, gap, epsabs=0.0, epsrel=1e-12, limit=200)
    assert math.pi * inside == pytest.approx(1.0, rel=1e-10)


@pytest.mark.parametrize(("lower", "upper"), [(60, 40), (0, 0), (40, 60), (120, 120)])
def test_volume_between_a_sphere_and_a_flat_by_integration(lower, upper):
    state = arc_sphere.solve(0.05, 0.01, lower * DEG, upper * DEG, 0.0, 1.0)
    radius, height = float(1.0 / state.inverse_arc_radius), float(state.height)
    centre = float(state.radius_lower) + radius * math.sin(lower * DEG)
    level = radius * math.cos(lower * DEG)

    def square(y):
        arc = centre - math.copysign(1.0, radius) * math.sqrt(radius**2 - (y - level) ** 2)
        return arc**2 - max(0.0, 1.0 - (1.05 - y) ** 2 if y > 0.05 else 0.0)

    inside, _ = quad(square, 0.0, height, points=[0.05], epsabs=0.0, epsrel=1e-12, limit=200)
    assert math.pi * inside == pytest.approx(0.01, rel=1e-9)
    sphere = 1.05 - math.sqrt(1.0 - float(state.radius_upper) ** 2)
    assert height == pytest.approx(sphere, rel=1e-13)  # the arc ends on the sphere


BANDS = {  # largest relative error of the force, up to a fraction of the exact stability limit
    "flat_60_60_D0.02": 0.007,
    "flat_60_60_D1": 0.07,
    "flat_0_0_D0.5": 0.07,
    "flat_0_60_D0.05": 0.007,
    "flat_30_75_D0.5": 0.07,
    "flat_0_90_D0.4": 0.07,
    "flat_30_30_D1.2": 0.19,
    "flat_180_180_D0.3": 0.042,
    "flat_60_60_x/h~100": 0.007,
    "flat_0_60_x/h~100000": 2e-6,
    "sphere/flat_40_40_V1e-15_D0": 1e-5,
    "sphere/flat_40_40_V0.001_D0.05": 0.07,
    "sphere/flat_60_60_V0.01_D0.1": 0.07,
    "sphere/flat_0_60_V0.001_D0.04": 0.07,
    "sphere/flat_180_150_V0.001_D0.01": 0.034,
    "sphere/sphere_0_0_V0.001_D0.05": 0.07,
    "sphere/sphere_0_20_V0.01_D0.1": 0.07,
}


@pytest.mark.parametrize(
    "case", [case for case in named("exact_bridge") if case.values[0]["id"] in BANDS]
)
def test_force_against_the_exact_bridge(case):
    state = arc_bridge(case["D"], case["V"], *angles(case), case["kappa1"], case["kappa2"])
    assert state.force == pytest.approx(case["F_over_gamma"], rel=BANDS[case["id"]])
    stretched = case["id"] == "flat_30_30_D1.2"  # at 97.6 % of its limit
    for radius, name in ((state.radius_lower, "r1"), (state.radius_upper, "r2")):
        assert radius == pytest.approx(case[name], rel=0.12 if stretched else 0.05)
    if case["D"] > 0.0 and case["r1"] > 5.0 * case["D"] and case["kappa2"] == 0.0:
        assert state.neck == pytest.approx(case["neck"], rel=0.0051)
        assert state.pressure == pytest.approx(case["P_over_gamma"], rel=0.03)


def test_cylinder_is_exact():
    state = arc_bridge([0.1, 1.0, 1.4], 1.0, math.pi / 2, math.pi / 2)
    radius = 1.0 / np.sqrt(math.pi * np.array([0.1, 1.0, 1.4]))
    np.testing.assert_allclose(state.force, math.pi * radius, rtol=1e-15)
    np.testing.assert_allclose(state.pressure, 1.0 / radius, rtol=1e-15)
    np.testing.assert_allclose(state.neck, state.bulge, rtol=0.0)


def test_thin_film_on_a_sphere_pulls_like_laplace():
    """2 pi R (cos + cos) for a trace of liquid at contact, Eq. (3.6)."""
    state = arc_bridge(0.0, 1e-20, 40 * DEG, 40 * DEG, 0.0, 1.0)
    assert state.force == pytest.approx(4.0 * math.pi * math.cos(40 * DEG), rel=1e-5)


@pytest.mark.parametrize("count", [1, 2, 5, 20, 64])
def test_quadrature_is_exact_for_polynomials(count):
    nodes, weights = gauss_legendre(count)
    assert list(nodes) == sorted(nodes)
    for power in (0, count, 2 * count - 1):
        total = sum(w * t**power for t, w in zip(nodes, weights, strict=True))
        assert total == pytest.approx(1.0 / (power + 1.0), rel=1e-13)
    reference, _ = np.polynomial.legendre.leggauss(count)
    np.testing.assert_allclose(nodes, 0.5 + 0.5 * reference, atol=1e-15)
