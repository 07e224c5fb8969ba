"""The law of exact bridges between flats against reference values, closed forms and the kernel."""

from __future__ import annotations

import json
import math
from pathlib import Path

import numpy as np
import pytest
from selection import quick

from contactkit.capillary.arc import flat as arc_flat
from contactkit.capillary.exact.bridge import bridge
from contactkit.capillary.exact.stability import stability_limit
from contactkit.capillary.flats.force_law import flat_end, flat_law
from contactkit.errors import InfeasibleError

CASES = json.loads((Path(__file__).parents[1] / "data" / "separation.json").read_text())
FLAT = [c for c in CASES["exact_bridge"] if c["kappa1"] == c["kappa2"] == 0.0]


def angles(case):
    return math.radians(case["theta1_deg"]), math.radians(case["theta2_deg"])


@pytest.mark.parametrize("case", quick(FLAT, *range(0, 12, 3)), ids=lambda case: case["id"])
def test_force_of_the_reference_bridges(case):
    size = case["V"] ** (1.0 / 3.0)
    force = size * flat_law(*angles(case)).force(case["D"] / size)
    assert force == pytest.approx(case["F_over_gamma"], rel=1e-9)


@pytest.mark.parametrize("case", CASES["limit_table_flat"], ids=str)
def test_end_is_the_stability_limit(case):
    end, volume = flat_end(*angles(case))
    assert end == pytest.approx(case["D_limit_over_L"], rel=1e-8)
    assert volume == pytest.approx(1.0, rel=1e-14)
    assert end == pytest.approx(float(stability_limit(1.0, *angles(case)).gap), rel=1e-8)


PAIRS = [
    (0, 0),
    (0, 60),
    (30, 75),
    (60, 60),
    (60, 60.01),
    (60, 120),
    (60, 120.0001),
    (89.999, 90),
    (90, 90),
    (120, 120),
    (150, 60),
    (180, 120),
    (179.999, 179.999),
    (180, 180),
    (1e-3, 0),
]


@pytest.mark.parametrize(
    "pair", quick([(one,) for one in PAIRS], 0, 2, 4, 6, 8, 10, 12, 14), ids=str
)
def test_force_is_that_of_the_solved_bridge_at_every_gap(pair):
    # The kernel solves for each gap; the law never does.
    lower, upper = map(math.radians, pair)
    law = flat_law(lower, upper)
    gaps = law.end * np.array([1e-4, 1e-3, 0.01, 0.1, 0.3, 0.6, 0.9, 0.99, 0.9999])
    solved = bridge(gaps, 1.0, lower, upper)
    radius = np.maximum(solved.radius_lower, solved.radius_upper)
    scale = math.pi * radius * (radius * abs(math.cos(lower) + math.cos(upper)) / gaps + 1.0)
    force = np.array([law.force(gap) for gap in gaps])
    assert np.max(np.abs(force - solved.force) / scale) < 2e-8


@pytest.mark.parametrize("pair", quick([(one,) for one in PAIRS], 1, 7, 13), ids=str)
def test_a_pinned_bridge_is_the_free_one_of_its_volume(pair):
    lower, upper = map(math.radians, pair)
    law, free = flat_law(lower, upper, pinned=True), flat_law(lower, upper)
    for gap in (1e-4, 1e-2, 0.1):
        if gap > 0.9 * law.end:
            continue
        size = law.volume(gap) ** (1.0 / 3.0)
        assert law.force(gap) == pytest.approx(size * free.force(gap / size), rel=1e-7, abs=1e-7)


@pytest.mark.parametrize("pair", quick([(one,) for one in PAIRS], 0, 6, 10, 14), ids=str)
@pytest.mark.parametrize("pinned", [False, True])
def test_a_thin_film_is_an_arc_without_a_step(pair, pinned):
    lower, upper = map(math.radians, pair)
    law, arc = flat_law(lower, upper, pinned=pinned), arc_flat.shape(lower, upper)
    for gap in (1e-3, 1e-6, 1e-9, 1e-12):
        radius = (
            arc_flat.rim_contact_radius(arc, gap, 1.0)
            if pinned
            else arc_flat.contact_radius(arc, gap, 1.0)
        )
        assert law.force(gap) == pytest.approx(
            float(arc_flat.force(arc, gap, radius)), rel=gap / radius + 1e-7
        )


def test_two_right_angles_hold_a_cylinder():
    law = flat_law(math.pi / 2, math.pi / 2)
    assert law.end == pytest.approx(math.pi ** (1.0 / 3.0), rel=1e-15)
    assert law.force(0.5) == pytest.approx(math.pi * math.sqrt(2.0 / math.pi), rel=1e-15)
    # Next to it the law is computed, and is the same.
    near = flat_law(math.radians(89.9999), math.pi / 2)
    assert near.force(0.5) == pytest.approx(law.force(0.5), rel=1e-5)


def test_equal_angles_end_on_a_cusp():
    ends = [flat_end(math.radians(60), math.radians(60 + off))[0] for off in (0.0, 0.1, 1.0, 5.0)]
    assert ends == pytest.approx([1.4205, 1.4095, 1.3709, 1.2813], abs=6e-5)
    lost = [ends[0] - end for end in ends[1:3]]
    assert math.log(lost[1] / lost[0]) / math.log(10.0) == pytest.approx(2.0 / 3.0, abs=0.05)


def test_the_force_is_the_slope_of_the_surface_energy():
    # Virtual work: the area of the liquid less what it wets falls by F over each step of gap.
    pair = (math.radians(40), math.radians(70))
    law = flat_law(*pair)
    gaps = 0.2 + np.linspace(-1e-3, 1e-3, 5)
    found = bridge(gaps, 1.0, *pair)
    wetted = sum(
        math.cos(angle) * math.pi * radius**2
        for angle, radius in zip(pair, (found.radius_lower, found.radius_upper), strict=True)
    )
    area = np.array([_lateral_area(found, i) for i in range(len(gaps))])
    energy = area - wetted
    h = gaps[1] - gaps[0]
    slope = (energy[0] - 8 * energy[1] + 8 * energy[3] - energy[4]) / (12 * h)
    assert law.force(0.2) == pytest.approx(float(slope), rel=1e-8)


def _lateral_area(found, i):
    """Area of the free surface, by quadrature of 2 pi r along the arc length."""
    nodes, weights = np.polynomial.legendre.leggauss(60)
    low, high = -found.arc_lower[i], found.arc_upper[i]
    s = 0.5 * (high - low) * (nodes + 1.0) + low
    a, e = found.neck_radius[i], found.shape[i]
    p = (1.0 - e) / a
    r = np.sqrt(a * a + e * s * s * np.sinc(0.5 * p * s / np.pi) ** 2)
    return 0.5 * (high - low) * float(weights @ (2.0 * np.pi * r))


def test_a_liquid_that_spreads_has_no_law():
    with pytest.raises(InfeasibleError, match="spreads"):
        flat_law(0.0, math.pi)
    with pytest.raises(InfeasibleError, match="spreads"):
        flat_end(0.0, math.pi)
