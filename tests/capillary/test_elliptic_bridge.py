"""The reference for bridges, Legendre's integrals, against 50 digits, and the kernel against it."""

import json
import math
from pathlib import Path

import numpy as np
import pytest
from selection import quick

from contactkit.capillary.exact.bridge import bridge
from contactkit.capillary.exact.stability import stability_limit
from contactkit.reference import elliptic_bridge

CASES = json.loads((Path(__file__).parents[1] / "data" / "separation.json").read_text())
DEG = math.pi / 180.0


def shape_of(case):
    """Angles with the binding one first, and curvature in units of the cube root of the volume."""
    angles = [case["theta1_deg"] * DEG, case["theta2_deg"] * DEG]
    bend = case["kappa2"] * case["V"] ** (1.0 / 3.0)
    if bend == 0.0:
        angles.sort(key=lambda a: -abs(math.cos(a)))
    return *angles, bend


def has_reference(case):
    total = case["theta1_deg"] + case["theta2_deg"]
    neck = total < 180 and case["id"] != "sphere/flat_85_85_V0.1_D0"  # that one has a belly
    return case["kappa1"] == 0 and (neck or (total > 180 and case["kappa2"] == 0))


@pytest.mark.parametrize(
    "case",
    quick(filter(has_reference, CASES["exact_bridge"]), *range(0, 16, 3)),
    ids=lambda case: case["id"],
)
def test_forces_against_fifty_digits(case):
    size = case["V"] ** (1.0 / 3.0)
    (found,) = elliptic_bridge.at_gaps([case["D"] / size], *shape_of(case))
    # thin films, 1e5 times as wide as high, have lost five digits of the gap to the lean
    rtol = 1e-10 if size > 100.0 * case["D"] or "100000" in case["id"] else 3e-13
    assert found.force * size == pytest.approx(case["F_over_gamma"], rel=rtol)


@pytest.mark.parametrize(
    "case", [*filter(has_reference, CASES["exact_limit"])], ids=lambda case: case["id"]
)
def test_limits_against_fifty_digits(case):
    size = case["V"] ** (1.0 / 3.0)
    found = elliptic_bridge.longest(*shape_of(case))
    assert found.gap * size == pytest.approx(case["D_limit"], rel=1e-12)


@pytest.mark.parametrize(
    ("lower", "upper", "bend"),
    [(0, 0, 0.0), (60, 60, 0.0), (0, 60, 0.0), (120, 120, 0.0), (150, 100, 0.0), (40, 40, 0.1)],
)
def test_the_exact_kernel_against_legendre(lower, upper, bend):
    """Two methods that share no code: arc lengths and Newton, elliptic integrals and brackets."""
    shape = (lower * DEG, upper * DEG)
    limit = float(stability_limit(1.0, *shape, 0.0, bend).gap)
    assert elliptic_bridge.longest(*shape, bend).gap == pytest.approx(limit, rel=1e-12)
    gaps = np.array([0.05, 0.5, 0.9]) * limit
    found = bridge(gaps, 1.0, *shape, 0.0, bend)
    right = elliptic_bridge.at_gaps(gaps.tolist(), *shape, bend)
    np.testing.assert_allclose(found.force, [one.force for one in right], rtol=1e-11)
    np.testing.assert_allclose(found.radius_lower, [one.radius_lower for one in right], rtol=1e-11)


def test_catenoid_in_closed_form():
    """No pressure: h = 2 f arcosh(1/sin t) and F = 2 pi f."""
    theta = 30 * DEG
    lean = math.sqrt(1.0 - math.cos(theta))  # 1 - cos - lean^2 = 0
    found = elliptic_bridge.at_lean(-lean, theta, theta)
    height = 2.0 * math.acosh(1.0 / math.sin(theta))
    assert found.gap / found.extremum == pytest.approx(height, rel=1e-12)
    assert found.force / found.extremum == pytest.approx(2.0 * math.pi, rel=1e-12)


def test_what_has_no_such_bridge_is_refused():
    for given in ((-0.1, 1.0, math.pi - 1.0), (-0.1, 2.0, 2.0, 0.1), (0.2, 0.0, 0.0)):
        with pytest.raises(ValueError, match=r"a neck or|does not lean"):
            elliptic_bridge.at_lean(*given)
