"""Sliding kernels: reference values, integrals in another order, Reynolds' equation by shooting."""

from __future__ import annotations

import json
import math
from itertools import pairwise
from pathlib import Path

import numpy as np
import pytest
from scipy.integrate import quad, solve_bvp

from contactkit.as_published.printed import sliding as sliding_published
from contactkit.lubrication import couette_flat as sliding
from contactkit.lubrication import couette_sphere as sliding_sphere
from contactkit.lubrication.couette_reynolds import lubrication_factor

CASES = json.loads((Path(__file__).parents[1] / "data" / "sliding.json").read_text())
FLATS = [name for name in CASES if name.startswith("tang_flat")]
SPHERES = [name for name in CASES if name.startswith("tang_sphere_s")]
CLOSED = 1e-13  # closed forms: a dozen roundings


def approx(value, rel=CLOSED):
    return pytest.approx(value, rel=rel, abs=0.0)


@pytest.mark.parametrize("name", FLATS)
def test_sliding_flats_have_the_impulse_of_the_reference(name):
    case = CASES[name]
    x, h, eta, time = case["x_m"], case["h0_m"], case["eta_Pa_s"], case["ts_s"]
    assert float(sliding.flat_impulse(x, h, 2.0 * x, eta)) == approx(case["eta_over_h_intA_dL_Ns"])
    half = case["eta_over_h_intA_dL_half_travel_Ns"]
    assert float(sliding.flat_impulse(x, h, x, eta)) == approx(half)
    start = eta / h * 2.0 * x / time * float(sliding.lens_area(x, 0.0))
    assert start == approx(case["F_start_at_v_2x_over_ts_N"])
    mean = sliding_published.sliding_flat_3_53(x, h, time, eta)
    assert mean == approx(case["F_published_3_53_N"])
    assert start / mean == approx(0.75 * math.pi)
    number = sliding_published.sliding_number_3_62(mean, x, time, eta)
    assert number == approx(case["dimensionless_3_62"])


@pytest.mark.parametrize("name", SPHERES)
def test_sliding_spheres_have_the_forces_of_the_reference(name):
    case = CASES[name]
    shape, eta = (case["R_m"], case["D_m"], case["s_m"]), case["eta_Pa_s"]
    mean = sliding_published.sliding_sphere_3_56(*shape, case["ts_s"], eta)
    assert mean == approx(case["F_published_3_56_N"])
    number = sliding_published.sliding_number_3_63(mean, shape[0], case["ts_s"], eta)
    assert number == approx(case["dimensionless_3_63"])
    if case["D_m"] == 0.0:
        return
    shear = sliding_sphere.sphere_drag(*shape, 0.0, lambda h: eta / h)
    assert float(shear) == approx(case["F_couette_local_film_v_1m_s_N"])
    whole = 2.0 * math.pi * eta * shape[0] * float(lubrication_factor(*shape[1:]))
    assert whole == approx(case["F_lubrication_v_1m_s_N"])


@pytest.mark.parametrize("name", [n for n in CASES if n.startswith("tang_sphere_lub")])
def test_the_round_film_has_the_factor_of_the_reference(name):
    case = CASES[name]
    factor = float(lubrication_factor(1.0, case["s_over_D"]))
    assert factor == approx(case["F_over_2piRetav"], 1e-12)


@pytest.mark.parametrize("q", [1.1, 2.0, 10.0, 100.0])
def test_the_round_film_solves_reynolds_equation(q):
    """Pressure mode cos(phi) by collocation; the force on the flat and on the sphere agree."""
    # Lengths over sqrt(2 R D), gaps over D: h = 1 + r^2, (r h^3 P')'/r - h^3 P/r^2 = 6 h'.
    rim = math.sqrt(q - 1.0)

    def slopes(r, y):
        p, dp = y
        h, dh = 1.0 + r * r, 2.0 * r
        return np.vstack([dp, (6.0 * dh / h**3) + p / r**2 - dp / r - 3.0 * dh / h * dp])

    def ends(a, b):
        return np.array([a[0] - r0 * a[1], b[0]])

    r0 = 1e-4 * rim
    r = np.geomspace(r0, rim, 200)
    found = solve_bvp(slopes, ends, r, np.zeros((2, len(r))), tol=1e-9, max_nodes=50_000)
    assert found.status == 0
    h = 1.0 + found.x**2
    p, dp = found.y
    # Over 2 pi R eta v: the shear is ln q, and pressure adds on either body the same.
    on_flat = 0.5 * np.trapezoid(h * (dp * found.x + p), found.x)
    on_both = -0.5 * np.trapezoid(p * 2.0 * found.x**2, found.x)
    expected = float(lubrication_factor(1.0, q)) - math.log(q)
    assert on_flat == approx(expected, 1e-3)
    assert on_both == approx(expected, 1e-3)


def test_the_overlap_is_what_a_grid_counts():
    x = np.linspace(-1.0, 1.0, 2001)
    inside = (x[:, None] ** 2 + x**2 < 1.0) & ((x[:, None] - 0.6) ** 2 + x**2 < 1.0)
    assert float(sliding.lens_area(1.0, 0.6)) == approx(inside.sum() * (x[1] - x[0]) ** 2, 1e-3)


def test_the_overlap_loses_its_width_times_the_travel():
    travel = np.linspace(0.01, 1.99, 50)
    step = 1e-6
    loss = (sliding.lens_area(1.0, travel - step) - sliding.lens_area(1.0, travel + step)) / step
    np.testing.assert_allclose(0.5 * loss, sliding.lens_width(1.0, travel), rtol=1e-8)


@pytest.mark.parametrize("travel", [1e-6, 0.3, 1.0, 1.7, 2.0, 5.0])
def test_the_impulse_of_flats_is_the_integral_of_the_area(travel):
    def area(y):
        return float(sliding.lens_area(1.0, y))

    total, _ = quad(area, 0.0, min(travel, 2.0), epsabs=0.0, epsrel=1e-12, limit=200)
    assert float(sliding.flat_impulse(1.0, 1.0, travel, 1.0)) == approx(total, 1e-10)


@pytest.mark.parametrize("q", [1.0 + 1e-9, 1.5, 30.0, 1e4])
@pytest.mark.parametrize("travel", [0.1, 1.0, 1.6, 2.0])
def test_the_impulse_of_a_sphere_is_the_integral_of_its_drag(q, travel):
    shape = (1e-3, 1e-6, 1e-6 * q)
    x = float(sliding_sphere.wetted_radius(*shape))

    def drag(y):
        return float(sliding_sphere.sphere_drag(*shape, y * x, lambda h: 1.0 / h)) * x

    marks = sorted({0.0, min(travel, 0.99), min(travel, 1.0), min(travel, 1.01), travel})
    parts = [quad(drag, a, b, epsabs=0.0, epsrel=1e-9, limit=200)[0] for a, b in pairwise(marks)]
    impulse = float(sliding_sphere.sphere_impulse(*shape, 1.0, travel * x))
    assert impulse == approx(sum(parts), 1e-8)


def test_a_sphere_far_away_is_a_flat():
    """A sphere so large that its film is even: area times stress at every travel."""
    shape = (1e6, 1.0, 1.0 + 1e-12)
    x = float(sliding_sphere.wetted_radius(*shape))
    travel = np.linspace(0.0, 2.0 * x, 11)
    drag = sliding_sphere.sphere_drag(*shape, travel, lambda h: 1.0 / h)
    np.testing.assert_allclose(drag, sliding.lens_area(x, travel), rtol=1e-11, atol=0.0)


def test_a_truncated_stress_under_a_sphere_has_its_closed_form():
    radius, gap, height, cut = 1e-3, 1e-6, 1e-5, 3e-6  # Newtonian where the film exceeds `cut`
    strength = 1.0 / cut
    drag = sliding_sphere.sphere_drag(
        radius, gap, height, 0.0, lambda h: sliding.limited_stress(1.0 / h, strength), cut
    )
    plastic = 2.0 * math.pi * radius * (cut - gap) * strength
    newtonian = 2.0 * math.pi * radius * math.log(height / cut)
    assert float(drag) == approx(plastic + newtonian, 1e-13)


@pytest.mark.parametrize("law", ["truncated", "bair-winer", "eyring"])
def test_a_limited_stress_is_newtonian_at_first_and_never_more(law):
    stress = np.geomspace(1e-8, 1e4, 60)
    limited = sliding.limited_stress(stress, 1.0, law)
    assert limited[0] == approx(stress[0], 1e-7)
    assert (np.diff(limited) >= 0.0).all()
    assert (limited <= stress * (1.0 + 1e-15)).all()
    if law != "eyring":
        assert limited.max() <= 1.0


@pytest.mark.parametrize(
    ("factor", "fraction"),
    [
        (1.0, lambda a: 0.0 if math.cos(a) > 0.0 else 1.0),  # at once
        (2.0 / math.pi, lambda a: abs(a) / math.pi),  # linear along the line
        (0.25 * math.pi, lambda a: 0.5 * (1.0 - math.cos(a))),  # linear along the motion
    ],
)
def test_the_shape_factor_is_the_integral_around_the_line(factor, fraction):
    """Tension times cos(theta) around a round line; `fraction` is that of the receding cosine."""
    advancing, receding, x = 1.2, 0.7, 0.5

    def pull(a):
        cosine = math.cos(advancing) + fraction(a) * (math.cos(receding) - math.cos(advancing))
        return -cosine * math.cos(a) * x

    right = 0.5 * math.pi
    force, _ = quad(pull, -math.pi, math.pi, points=[-right, right], limit=200, epsrel=1e-12)
    found = sliding.hysteresis_force(1.0, 2.0 * x, advancing, receding, factor)
    assert float(found) == approx(force, 1e-9)


def test_the_cubic_has_its_factor():
    """24/pi^3 of ElSherbini and Jacobi: theta a cubic of the place, for small steps."""
    mean, half = 1.0, 1e-4

    def theta(a):
        u = abs(a) / math.pi
        return mean + half * (1.0 - 6.0 * u * u + 4.0 * u**3)  # advancing at 0, receding at pi

    force, _ = quad(lambda a: -math.cos(theta(a)) * math.cos(a), 0.0, math.pi, epsabs=1e-14)
    found = sliding.hysteresis_force(1.0, 2.0, mean + half, mean - half, 24.0 / math.pi**3)
    assert float(found) == approx(2.0 * force, 1e-6)


@pytest.mark.parametrize("number", [4, 100_000])
def test_the_printed_division_has_the_power_of_the_reference(number):
    case = CASES[f"scaling_N={number}"]
    whole = sliding_published.sliding_sphere_3_56(1.0, 1e-3, 2e-3, 1.0, 1.0)
    film = (1.0, 1e-3, 2e-3, 1.0, 1.0)
    printed = sliding_published.sliding_sphere_divided_3_59(*film, number)
    assert printed / whole == approx(case["tang_sphere_published_3_59"])
    right = number * sliding_published.sliding_sphere_3_56(1.0 / number**0.5, *film[1:]) / whole
    assert right == approx(case["tang_sphere_correct_fixed_ts"])
    flats = sliding_published.sliding_flat_divided_3_61(1.0, 1.0, 1.0, 1.0, number)
    flat = sliding_published.sliding_flat_3_53(1.0, 1.0, 1.0, 1.0)
    assert flats / flat == approx(case["tang_flat_full_occupation_fixed_ts"])
