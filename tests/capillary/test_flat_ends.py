"""The law of exact bridges between flats next to its end, in its slopes, and where it is thin."""

from __future__ import annotations

import math

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from scipy.optimize import fsolve
from selection import quick

from contactkit.capillary.exact.bridge import bridge
from contactkit.capillary.flats.family import family
from contactkit.capillary.flats.force_law import flat_end, flat_law

FINE = 1e-11


def radians(pair):
    return tuple(map(math.radians, pair))


def integrated(lower, upper, gap, radius, pressure):
    """Force of the bridge of unit volume whose meridian is integrated along its tangent angle."""

    def run(x):
        def rates(psi, y):
            by_arc = x[1] - math.sin(psi) / y[0]  # of the tangent angle
            return (
                math.cos(psi) / by_arc,
                math.sin(psi) / by_arc,
                math.pi * y[0] ** 2 * math.sin(psi) / by_arc,
            )

        span = (math.pi - lower, upper)
        return solve_ivp(rates, span, (x[0], 0.0, 0.0), "DOP853", rtol=1e-12, atol=1e-14).y[1:, -1]

    start = (radius * 1.0001, pressure * 0.9999)
    x, _, fine, why = fsolve(lambda x: run(x) - (gap, 1.0), start, xtol=1e-14, full_output=True)
    assert fine == 1 or np.max(np.abs(run(x) - (gap, 1.0))) < 1e-12, why
    return 2.0 * math.pi * x[0] * math.sin(lower) - math.pi * x[0] ** 2 * x[1]


@pytest.mark.slow
@pytest.mark.parametrize(
    ("pair", "fraction"), [((180, 180), 0.9), ((179.9, 179.9), 0.9999), ((180, 90), 0.99)], ids=str
)
def test_force_is_that_of_an_integrated_meridian(pair, fraction):
    lower, upper = radians(pair)
    law = flat_law(lower, upper)
    gap = fraction * law.end
    near = bridge(gap, 1.0, lower, upper)  # where to start
    expected = integrated(lower, upper, gap, float(near.radius_lower), float(near.pressure))
    assert law.force(gap) == pytest.approx(expected, rel=1e-9, abs=1e-11)


def test_a_repelled_bridge_ends_as_the_drop_it_leaves():
    assert flat_end(*radians((180, 180)))[0] == pytest.approx((6.0 / math.pi) ** (1 / 3), rel=1e-10)
    assert flat_end(*radians((180, 90)))[0] == pytest.approx((1.5 / math.pi) ** (1 / 3), rel=1e-10)


@pytest.mark.slow
@pytest.mark.parametrize(("pair", "contacts"), [((180, 180), 2), ((180, 90), 1)])
def test_a_drop_yields_to_a_small_push_as_in_the_theory_of_its_small_facets(pair, contacts):
    """Way over force falls by 1/(4 pi) per contact and e-fold of the force (Morse and Witten)."""
    law = flat_law(*radians(pair), rtol=FINE)
    ways = law.end * np.array([1e-6, 1e-4])
    forces = np.array([-law.force(law.end - way) for way in ways])
    yields = ways / forces
    rate = (yields[0] - yields[1]) / math.log(forces[1] / forces[0])
    assert np.all(forces > 0.0)
    assert rate == pytest.approx(contacts / (4.0 * math.pi), rel=1e-3)


PAIRS = [(180, 180), (180, 120), (60, 60.01)]


@pytest.mark.parametrize("pair", quick([(one,) for one in PAIRS], 1), ids=str)
def test_slopes_are_those_of_the_solved_bridge(pair):
    """Without scatter: slopes by differences, to 1e-9 but where the gap itself has no digits."""
    law = flat_law(*radians(pair), rtol=FINE)
    left = np.concatenate((np.geomspace(3e-3, 0.3, 12), 1.0 - np.geomspace(1e-3, 0.5, 9)))
    gaps = law.end * (1.0 - left)
    found = bridge(gaps, 1.0, *radians(pair))
    step = np.minimum(1e-4, 0.03 * left)
    near = (gaps * np.exp(k * step) for k in (-3, -2, -1, 1, 2, 3))
    f = [np.array([law.force(gap) for gap in some]) for some in near]
    slopes = (45.0 * (f[3] - f[2]) - 9.0 * (f[4] - f[1]) + f[5] - f[0]) / (60.0 * step)
    size = np.abs(found.force) + np.abs(gaps * found.stiffness)
    assert np.max(np.abs(slopes - gaps * found.stiffness) / size) < 1e-9
    values = np.array([law.force(gap) for gap in gaps])
    assert np.max(np.abs(values - found.force) / size) < 1e-11


@pytest.mark.parametrize("pinned", [False, True])
@pytest.mark.parametrize(
    "pair", quick([(one,) for one in [(180, 180), (180, 90), (60, 60), (0, 60)]], 1, 3), ids=str
)
def test_a_film_that_is_taken_for_its_arc_is_still_the_exact_one(pair, pinned):
    """Its gap is 1e-8 to 1e-11 of its radius; the arc alone errs by as much."""
    law = flat_law(*radians(pair), pinned=pinned)
    one = family(*radians(pair), pinned)
    for chart in (19.0, 20.0, 22.0, 25.0):
        member = one(chart)
        assert law.force(member.gap) == pytest.approx(member.force, rel=1e-10)
        assert law.volume(member.gap) == pytest.approx(member.volume, rel=1e-10)
