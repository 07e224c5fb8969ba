"""Dynamic angle, deposited film and weight of a bridge, against quadrature and solved bridges."""

from __future__ import annotations

import math

import numpy as np
import pytest
from scipy.integrate import quad, solve_ivp
from scipy.optimize import fsolve

from contactkit.capillary.exact.bridge import bridge
from contactkit.capillary.exact.stability import stability_limit
from contactkit.capillary.wetting.cox_voinov import (
    cox_function,
    deposition_threshold,
    dynamic_angle,
)
from contactkit.capillary.wetting.landau_levich import film_fraction
from contactkit.capillary.wetting.weight import upper_share


@pytest.mark.parametrize("angle", [0.02, 0.049999, 0.050001, 1.0, 1.57, 1.58, 2.5, 3.13])
def test_the_function_of_cox_is_its_integral(angle):
    found, _ = quad(
        lambda x: (x - 0.5 * math.sin(2.0 * x)) / (2.0 * math.sin(x)), 1e-12, angle, epsrel=1e-12
    )
    assert cox_function(angle) == pytest.approx(found, rel=1e-9)


def test_a_slow_line_at_a_small_angle_follows_voinov():
    for drive in (-2e-5, 1e-4):
        cube = (0.1**3 + 9.0 * drive) ** (1.0 / 3.0)
        assert dynamic_angle(0.1, drive) == pytest.approx(cube, rel=1e-4)


def test_angles_at_rest_at_the_threshold_and_of_a_fast_line():
    for angle in (0.0, 1e-3, 0.5 * math.pi, 3.0, math.pi):
        assert dynamic_angle(angle, 0.0) == angle
        assert dynamic_angle(angle, 1e-14) == pytest.approx(angle, abs=1e-4)
    threshold = deposition_threshold(1.0, 1e4)
    drive = threshold * math.log(1e4)
    assert dynamic_angle(1.0, -drive * (1.0 + 1e-9)) == 0.0
    assert 0.0 < dynamic_angle(1.0, -drive * (1.0 - 1e-6)) < 0.03
    assert dynamic_angle(0.0, -1.0) == 0.0
    assert dynamic_angle(math.pi, -1.0) == math.pi == dynamic_angle(math.pi, 1.0)
    assert 3.1 < dynamic_angle(1.0, 8.0) < math.pi
    assert dynamic_angle(1.0, 1e3) < math.pi


def test_the_dynamic_angle_reverses():
    there = dynamic_angle(1.1, 0.05)
    assert there > 1.1 > dynamic_angle(1.1, -0.05)
    assert dynamic_angle(there, -0.05) == pytest.approx(1.1, rel=1e-12)


def test_films_of_plate_and_tube():
    """Landau and Levich: 0.944 of the capillary length; Bretherton: 1.337 of the radius."""
    assert film_fraction(1e-6) / math.sqrt(2.0) / 1e-4 == pytest.approx(0.944, rel=3e-3)
    assert film_fraction(1e-6) / 1e-4 == pytest.approx(1.3375, rel=1e-3)
    both = [film_fraction(1e-9, law) for law in ("landau-levich", "aussillous-quere")]
    assert both[0] == pytest.approx(both[1], rel=5e-6)
    assert film_fraction(1e6, "aussillous-quere") == pytest.approx(0.4, rel=1e-3)


def heavy_bridge(gap, volume, angles, curvatures, bond):
    """Forces over tension on the lower and the upper body, by shooting, with rho g/gamma."""
    (below, above), (k1, k2) = angles, curvatures

    def sag(r, k):
        return r * r * k / (1.0 + math.sqrt(1.0 - (k * r) ** 2))

    def cap(r, k):
        return math.pi * sag(r, k) * (3.0 * r * r + sag(r, k) ** 2) / 6.0

    def end(u, weight):
        r1, pressure, length, _ = u
        start = [r1, math.pi - below - math.asin(k1 * r1), -sag(r1, k1), 0.0]

        def meridian(s, y):
            r, phi, z, _ = y
            turn = pressure - weight * z - math.sin(phi) / r
            rise = math.sin(phi)
            return [x * length for x in (math.cos(phi), turn, rise, math.pi * r * r * rise)]

        return solve_ivp(meridian, (0, 1), start, rtol=1e-10, atol=1e-13, method="DOP853").y[:, -1]

    def misses(u, weight):
        r, phi, z, v = end(u, weight)
        r1, _, _, r2 = u
        off = phi - above - math.asin(k2 * r2)
        return [r - r2, off, z - gap - sag(r2, k2), (v - cap(r1, k1) - cap(r2, k2)) / volume - 1.0]

    one = bridge(gap, volume, *angles, *curvatures)
    arc = one.arc_lower + one.arc_upper
    u = [float(x) for x in (one.radius_lower, one.pressure, arc, one.radius_upper)]
    for part in (0.25, 0.5, 0.75, 1.0):
        u, _, found, _ = fsolve(misses, u, (bond * part,), full_output=True, xtol=1e-11)
        assert found == 1
    r1, pressure, _, r2 = u
    _, phi, z, _ = end(u, bond)
    first = math.sin(math.pi - below - math.asin(k1 * r1))
    lower = 2.0 * math.pi * r1 * first - math.pi * r1**2 * (pressure + bond * sag(r1, k1))
    upper = 2.0 * math.pi * r2 * math.sin(phi) - math.pi * r2**2 * (pressure - bond * z)
    return lower + bond * cap(r1, k1), upper - bond * cap(r2, k2), float(one.force)


@pytest.mark.slow
@pytest.mark.parametrize(
    ("volume", "angles", "curvatures"),
    [
        (1.0, (0.6, 0.6), (0.0, 0.0)),
        (1.0, (0.6, 1.2), (0.0, 0.0)),
        (1e-2, (0.3, 0.3), (0.0, 1.0)),
        (1.7e-2, (0.0, 0.0), (1.0, 1.0)),
    ],
)
def test_the_weight_is_that_of_bridges_with_gravity(volume, angles, curvatures):
    """To 0.6 of the limit within 1e-4 of the force at a Bond number of 0.1, and 2e-3 at 0.4."""
    end = float(stability_limit(volume, *angles, *curvatures).gap)
    gaps, shares = upper_share(volume, angles, curvatures, end)
    for number, part, allowed in ((0.1, 0.1, 1e-5), (0.1, 0.6, 2e-4), (0.4, 0.6, 3e-3)):
        bond, gap = number / volume ** (2.0 / 3.0), part * end
        lower, upper, light = heavy_bridge(gap, volume, angles, curvatures, bond)
        assert upper - lower == pytest.approx(bond * volume, rel=1e-6)
        first = bond * volume * float(np.interp(gap, gaps, shares))
        assert upper - light == pytest.approx(first, abs=allowed * light)


def test_equal_bodies_share_the_weight_and_a_touching_sphere_carries_none():
    volume, fixed = 1e-3, (0.4, 0.4)
    end = float(stability_limit(volume, *fixed, 0.0, 1.0).gap)
    gaps, shares = upper_share(volume, fixed, (0.0, 1.0), end)
    assert gaps[0] == 0.0
    assert shares[0] == pytest.approx(0.0, abs=1e-3)
    assert 0.2 < float(np.interp(0.5 * end, gaps, shares)) < 0.5
    assert upper_share(volume, fixed, (1.0, 1.0), end)[1].tolist() == [0.5, 0.5]
