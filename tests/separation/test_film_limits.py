"""What a liquid cannot carry: reference values, other methods, and how a limit begins to act."""

from __future__ import annotations

import math
from itertools import pairwise

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.integrate import quad

from contactkit.lubrication import film_limits
from contactkit.lubrication import squeeze_film as squeeze
from contactkit.reference.reynolds import film_force

OIL, FACE, GAP, BAR = 0.1, 3.175e-3, 2e-6, 1e5
AREA = math.pi * FACE**2
CAP = AREA * BAR
SPHERE, LOW, HIGH = 5e-3, 1e-6, 8e-6  # a film from 1 um under the apex to 8 um at the rim
CLOSED = 1e-13  # closed forms: a dozen roundings
QUAD = 1e-10  # scipy.quad over a kink, which is given to it


def approx(value, rel):
    return pytest.approx(value, rel=rel, abs=0.0)


def sphere_newtonian(k):
    """Force under the sphere with 3 eta times the speed = k [Pa.m]."""
    return 2.0 * math.pi * SPHERE**2 * k * (1.0 - LOW / HIGH) ** 2 / LOW


# One entry for each limit: its force as a function of the Newtonian force alone, and the force at
# which it begins to act.
_WORST = math.sqrt(2.0 * SPHERE * LOW / 3.0)  # where the wall shear under a sphere is largest
LIMITS = {
    "truncated": (lambda f: film_limits.disc_tension_truncated(f, AREA, BAR), 0.5 * CAP),
    "reynolds": (lambda f: film_limits.disc_tension_reynolds(f, AREA, BAR), 0.5 * CAP),
    "disc shear": (
        lambda f: film_limits.disc_shear_limited(f, FACE, GAP, BAR),
        0.5 * math.pi * BAR * FACE**3 / GAP,
    ),
    "sphere tension": (
        lambda f: film_limits.sphere_tension_truncated(f, SPHERE, LOW, HIGH, BAR),
        sphere_newtonian(BAR / (LOW**-2 - HIGH**-2) / SPHERE),
    ),
    "sphere shear": (
        lambda f: film_limits.sphere_shear_limited(f, SPHERE, LOW, HIGH, BAR),
        sphere_newtonian(BAR * (4.0 * LOW / 3.0) ** 2 / _WORST),
    ),
}
each_limit = pytest.mark.parametrize(("limit", "onset"), LIMITS.values(), ids=LIMITS)


# Reference values ---------------------------------------------------------------------------


@pytest.mark.parametrize("name", ["cavitating_hdot=1e-06", "cavitating_hdot=0.001"])
def test_a_cavitating_disc_keeps_the_force_of_the_reference(viscous_cases, name):
    case = viscous_cases[name]
    radius, gap = case["R_m"], case["h_m"]
    newtonian = squeeze.disc_force(radius, gap, case["hdot_m_s"], case["eta_Pa_s"])
    assert newtonian == approx(case["F_newtonian_N"], CLOSED)
    area, tension = math.pi * radius**2, case["pa_Pa"] - case["pc_Pa"]
    assert area * tension == approx(case["F_max_N"], CLOSED)
    # The force hardly depends on the root, but is a difference of terms up to 1e3 times larger.
    assert film_limits.disc_tension_reynolds(newtonian, area, tension) == approx(case["F_N"], 1e-12)


@pytest.mark.parametrize(("speed", "force"), [(1e-5, 2.924), (1e-4, 3.090), (0.04, 3.163)])
def test_a_cavitating_disc_keeps_the_printed_force(speed, force):
    newtonian = squeeze.disc_force(FACE, GAP, speed, OIL)
    assert film_limits.disc_tension_reynolds(newtonian, AREA, BAR) == approx(force, 2e-4)


@pytest.mark.parametrize("s", [1.5, 2.0, 10.0, 1e6])
def test_the_truncated_force_is_the_printed_formula(s):
    assert film_limits.disc_tension_truncated(0.5 * s * CAP, AREA, BAR) == approx(
        CAP * (1.0 - 0.5 / s), CLOSED
    )


# Another method: integrate what the bound leaves --------------------------------------------


def integral(density, end, kinks):
    inside = sorted(kink for kink in kinks if 0.0 < kink < end)
    marks = [0.0, *inside, end]
    return math.fsum(quad(density, a, b, epsrel=1e-11, epsabs=0.0)[0] for a, b in pairwise(marks))


@pytest.mark.parametrize("s", [0.5, 1.5, 7.0, 1e3])
def test_the_truncated_force_is_the_integral_of_the_truncated_parabola(s):
    def pull(r):
        return 2.0 * math.pi * r * BAR * min(1.0, s * (1.0 - (r / FACE) ** 2))

    kink = FACE * math.sqrt(max(0.0, 1.0 - 1.0 / s))
    assert film_limits.disc_tension_truncated(0.5 * s * CAP, AREA, BAR) == approx(
        integral(pull, FACE, [kink]), QUAD
    )


@pytest.mark.parametrize("q", [0.5, 1.5, 7.0, 1e3])
def test_the_shear_limited_force_of_a_disc_is_the_integral_of_the_bounded_shear(q):
    """F is the integral of pi r^2 |p'|, and |p'| is twice the wall shear over the gap."""

    def pull(r):
        return math.pi * r**2 * 2.0 * BAR * min(1.0, q * r / FACE) / GAP

    newtonian = q * LIMITS["disc shear"][1]
    assert film_limits.disc_shear_limited(newtonian, FACE, GAP, BAR) == approx(
        integral(pull, FACE, [FACE / q]), QUAD
    )


@pytest.mark.parametrize("beyond", [0.5, 1.01, 3.0, 100.0, 1e4])
@pytest.mark.parametrize("height", [1.2e-6, 8e-6, 1e-3])
def test_the_tension_limited_force_of_a_sphere_is_the_integral_of_the_truncated_pressure(
    beyond, height
):
    k = beyond * BAR / (LOW**-2 - height**-2)
    newtonian = 2.0 * math.pi * SPHERE * k * (1.0 - LOW / height) ** 2 / LOW
    rim = math.sqrt(2.0 * SPHERE * (height - LOW))

    def pull(r):
        local = LOW + r * r / (2.0 * SPHERE)
        return 2.0 * math.pi * r * min(BAR, k * (local**-2 - height**-2))

    cut = 1.0 / math.sqrt(BAR / k + height**-2)
    kink = math.sqrt(2.0 * SPHERE * max(cut - LOW, 0.0))
    found = film_limits.sphere_tension_truncated(newtonian, SPHERE, LOW, height, BAR)
    assert found == approx(integral(pull, rim, [kink]), QUAD)


@pytest.mark.parametrize("beyond", [0.5, 1.01, 3.0, 100.0, 1e6])
@pytest.mark.parametrize("height", [1.1e-6, 8e-6, 1e-3])
def test_the_shear_limited_force_of_a_sphere_is_the_integral_of_the_bounded_shear(beyond, height):
    k = beyond * BAR * (4.0 * LOW / 3.0) ** 2 / _WORST
    newtonian = 2.0 * math.pi * SPHERE**2 * k * (1.0 - LOW / height) ** 2 / LOW
    rim = math.sqrt(2.0 * SPHERE * (height - LOW))

    def shear(r):
        return k * r / (LOW + r * r / (2.0 * SPHERE)) ** 2

    def pull(r):
        local = LOW + r * r / (2.0 * SPHERE)
        return 2.0 * math.pi * r**2 * min(BAR, shear(r)) / local

    # Where the bound begins and ceases to act, by the roots of a quartic.
    quartic = np.polynomial.Polynomial([LOW, 0.0, 0.5 / SPHERE]) ** 2 * BAR
    roots = (quartic - np.polynomial.Polynomial([0.0, k])).roots()
    kinks = [float(z.real) for z in roots if abs(z.imag) < 1e-9 * abs(z)]
    found = film_limits.sphere_shear_limited(newtonian, SPHERE, LOW, height, BAR)
    assert found == approx(integral(pull, rim, kinks), QUAD)


@pytest.mark.parametrize("s", [1.9, 3.0, 10.0])
def test_the_grid_with_a_floor_tends_to_the_cavitating_disc_with_its_second_order(s):
    """A cavity that may end anywhere: Reynolds' condition on a grid, against the closed form."""
    newtonian = 0.5 * s * CAP
    speed = newtonian / squeeze.disc_force(FACE, GAP, 1.0, OIL)
    closed = film_limits.disc_tension_reynolds(newtonian, AREA, BAR)
    cells = np.array([50, 100, 200, 400, 800])
    errors = [
        film_force(lambda r: np.full_like(r, GAP), FACE, speed, OIL, n, BAR) / closed - 1.0
        for n in cells
    ]
    slope = -np.polyfit(np.log(cells), np.log(np.abs(errors)), 1)[0]
    assert slope == pytest.approx(2.0, abs=0.2)  # the edge moves by whole cells
    assert abs(errors[-1]) < 1e-5


# How a limit begins and ends ----------------------------------------------------------------


@each_limit
def test_below_its_onset_a_limit_changes_nothing(limit, onset):
    assert limit(0.999999 * onset) == 0.999999 * onset


@each_limit
def test_above_its_onset_a_limit_acts(limit, onset):
    assert limit(1.01 * onset) < 1.01 * onset * (1.0 - 1e-7)


@pytest.mark.parametrize("step", [1e-3, 1e-4, 1e-5])
@pytest.mark.parametrize(
    ("name", "bend"),
    [
        ("truncated", lambda step: 2.0 * step),
        ("disc shear", lambda step: 5.0 * step),
        ("sphere tension", lambda step: 2.0 * step),
        # It begins on a ring inside the film, whose width grows as the root of the excess.
        ("sphere shear", lambda step: math.sqrt(step)),
    ],
)
def test_a_limit_begins_without_a_jump_in_value_or_slope(name, bend, step):
    limit, onset = LIMITS[name]
    at, above = limit(onset), limit(onset * (1.0 + step))
    assert at == approx(onset, 1e-12)
    assert (above - at) / (onset * step) == pytest.approx(1.0, abs=bend(step))


def test_a_cavity_begins_without_a_jump_in_slope():
    """The slope falls from 1 as 1/|ln(s - 1)|: continuous, but only just."""
    limit, onset = LIMITS["reynolds"]
    lost = [1.0 - (limit(onset * (1.0 + e)) / onset - 1.0) / e for e in (1e-3, 1e-6, 1e-9)]
    assert lost == sorted(lost, reverse=True)
    assert [x * math.log(1e3**n) < 2.0 for n, x in enumerate(lost, 1)] == [True] * 3


@pytest.mark.parametrize(
    ("name", "most"),
    [
        ("truncated", CAP),
        ("reynolds", CAP),
        ("disc shear", 2.0 * math.pi * BAR * FACE**3 / (3.0 * GAP)),
        ("sphere tension", 2.0 * math.pi * SPHERE * (HIGH - LOW) * BAR),
    ],
)
def test_a_fast_opening_meets_a_highest_force(name, most):
    # The cavity comes near it as the root of the speed, the others faster.
    assert LIMITS[name][0](1e14 * most) == approx(most, 1e-7)
    assert LIMITS[name][0](1e3 * most) < most


def test_the_thin_rim_of_a_fast_cavity_joins_its_series_smoothly():
    """The formula switches at s = 2e6; the force rises by 1e-3 of what is left, either side."""
    below, above = (
        film_limits.disc_tension_reynolds(0.5 * s, 1.0, 1.0) for s in (1.998e6, 2.002e6)
    )
    missing = math.sqrt(2.0 / 1.998e6) / 3.0, math.sqrt(2.0 / 2.002e6) / 3.0
    # Cancellation leaves 1e-16 times s on the closed form.
    assert above - below == pytest.approx(missing[0] - missing[1], abs=3e-10)
    assert 1.0 - above == approx(missing[1], 1e-6)


# For any film -------------------------------------------------------------------------------

forces = st.floats(-6.0, 12.0).map(lambda x: 10.0**x)  # of the onset


@each_limit
@given(force=forces)
def test_a_limit_never_adds_to_the_newtonian_force(limit, onset, force):
    left = limit(force * onset)
    assert 0.0 < left <= force * onset * (1.0 + 1e-15)


@each_limit
@given(force=forces, more=st.floats(1.0001, 1e3))
def test_a_faster_opening_is_never_resisted_less(limit, onset, force, more):
    # Far beyond the onset the force is constant but for rounding.
    assert limit(force * more * onset) >= limit(force * onset) * (1.0 - 1e-12)


@given(force=forces)
def test_a_truncated_parabola_carries_at_most_15_percent_more_than_a_cavity(force):
    truncated, cavity = (LIMITS[name][0](0.5 * force * CAP) for name in ("truncated", "reynolds"))
    assert cavity * (1.0 - 1e-12) <= truncated <= 1.1501 * cavity


@pytest.mark.parametrize("name", ["disc shear", "sphere shear"])
@given(force=forces)
def test_the_shear_limit_is_the_same_opening_and_closing(name, force):
    limit, onset = LIMITS[name]
    assert limit(-force * onset) == -limit(force * onset)


def test_the_shear_limit_of_a_sphere_keeps_its_digits_however_fast_it_opens():
    """The Newtonian force may be 1e20 times what is left; it must not enter by a difference."""
    limit, onset = LIMITS["sphere shear"]
    assert limit(1e20 * onset) == approx(limit(1e10 * onset), 1e-9)


@pytest.mark.parametrize("tension", [1e-3, 1e12])
def test_a_flooded_sphere_is_bounded_too(tension):
    force = film_limits.sphere_tension_truncated(1.0, SPHERE, LOW, math.inf, tension)
    assert 0.0 < force <= 1.0
    shear = film_limits.sphere_shear_limited(1.0, SPHERE, LOW, math.inf, tension)
    assert 0.0 < shear <= 1.0


def test_a_film_that_ends_at_the_apex_is_left_alone():
    """No film, no limit: the kernels divide by the height the film has above the gap."""
    assert film_limits.sphere_tension_truncated(0.0, SPHERE, LOW, LOW, BAR) == 0.0
    assert film_limits.sphere_shear_limited(0.0, SPHERE, LOW, LOW, BAR) == 0.0
