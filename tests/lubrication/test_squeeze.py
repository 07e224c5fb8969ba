"""The squeeze film: reference values, its impulse as the integral of its force, a grid solution."""

from __future__ import annotations

import math
from decimal import Decimal, localcontext

import numpy as np
import pytest
from scipy.integrate import quad

from contactkit.lubrication import squeeze_film as squeeze
from contactkit.reference.reynolds import film_force

OIL = 0.1  # [Pa.s]
CLOSED = 1e-13  # closed forms: a dozen roundings
QUAD = 1e-11  # scipy.quad is asked for 1e-12


def approx(value, rel):
    return pytest.approx(value, rel=rel, abs=0.0)


# Reference values ---------------------------------------------------------------------------


@pytest.mark.parametrize("name", ["flat_nano_h0=2nm", "flat_nano_h0=5nm", "flat_eta=0.01"])
def test_a_disc_of_constant_volume_takes_the_impulse_of_the_reference(viscous_cases, name):
    case = viscous_cases[name]
    volume = math.pi * case["x0_m"] ** 2 * case["h0_m"]
    impulse = squeeze.disc_impulse_conserved(volume, case["h0_m"], case["hs_m"], case["eta_Pa_s"])
    assert impulse == approx(case["impulse_conserving_Ns"], CLOSED)


@pytest.mark.parametrize("name", ["flat_nano_h0=2nm", "flat_nano_h0=5nm"])
def test_a_gap_may_open_to_infinity(viscous_cases, name):
    case = viscous_cases[name]
    h0, eta, x0 = case["h0_m"], case["eta_Pa_s"], case["x0_m"]
    conserved = squeeze.disc_impulse_conserved(math.pi * x0**2 * h0, h0, math.inf, eta)
    assert conserved == approx(case["impulse_conserving_inf_Ns"], CLOSED)
    flooded = squeeze.disc_impulse_flooded(x0, h0, math.inf, eta)
    assert flooded / case["ts_s"] == approx(case["F_published_hs_inf_N"], CLOSED)


@pytest.mark.parametrize("name", ["flat_nano_h0=2nm", "flat_nano_h0=5nm", "flat_eta=0.01"])
def test_the_published_force_is_the_flooded_impulse_over_the_time(viscous_cases, name):
    case = viscous_cases[name]
    impulse = squeeze.disc_impulse_flooded(
        case["x0_m"], case["h0_m"], case["hs_m"], case["eta_Pa_s"]
    )
    assert impulse / case["ts_s"] == approx(case["F_published_3_19_N"], CLOSED)


def test_a_disc_resists_with_the_force_of_the_reference(viscous_cases):
    case = viscous_cases["flat_eta=0.01"]
    radius, eta, gap = case["x0_m"], case["eta_Pa_s"], case["h0_m"]
    assert squeeze.disc_force(radius, gap, 0.04, eta) == approx(
        case["F_instant_at_h0_hdot_40mm_s_N"], CLOSED
    )
    drawn_in = squeeze.disc_radius(math.pi * radius**2 * gap, 5e-6)
    assert squeeze.disc_force(drawn_in, 5e-6, 0.04, eta) == approx(
        case["F_instant_at_5um_hdot_40mm_s_N"], CLOSED
    )


@pytest.mark.parametrize("name", ["sphere_nano_s0=2nm", "sphere_nano_s0=5nm"])
def test_a_sphere_takes_the_impulse_and_the_force_of_the_reference(viscous_cases, name):
    case = viscous_cases[name]
    radius, height, gap, eta = case["R_m"], case["H0_m"], case["D0_m"], case["eta_Pa_s"]
    impulse = squeeze.sphere_impulse_conserved(radius, height, gap, case["Ds_m"], eta)
    assert impulse == approx(case["impulse_Ns"], CLOSED)
    assert impulse / case["ts_s"] == approx(case["F_published_3_26_N"], CLOSED)
    to_infinity = squeeze.sphere_impulse_conserved(radius, height, gap, math.inf, eta)
    assert to_infinity / case["ts_s"] == approx(case["F_limit_3_26_N"], CLOSED)
    force = squeeze.sphere_force(radius, gap, height, 1.0, eta)
    assert force == approx(case["F_instant_at_D0_speed_1m_s_N"], CLOSED)


@pytest.mark.parametrize("scale", [1.0, 1e-3])
def test_a_film_a_million_gaps_high_keeps_all_digits(viscous_cases, scale):
    """The impulse depends on the ratio H0/D0 only: 1 nm under 1 mm is 1 pm under 1 um."""
    case = viscous_cases["sphere_hard_D0=1e-09_H0=0.001"]
    impulse = squeeze.sphere_impulse_conserved(
        case["R_m"], case["H0_m"] * scale, case["D0_m"] * scale, math.inf, case["eta_Pa_s"]
    )
    assert impulse == approx(case["impulse_inf_Ns"], CLOSED)
    force = squeeze.sphere_force(case["R_m"], case["D0_m"], case["H0_m"], 1e-3, case["eta_Pa_s"])
    assert force == approx(case["F_instant_at_D0_1mm_s_N"], CLOSED)


# Without cancellation -----------------------------------------------------------------------


def printed_3_26(gap_from, gap_to, height):
    """Eq. (3.26) as printed, over 6 pi eta R^2, in 80 digits: nothing left to cancel."""
    with localcontext() as context:
        context.prec = 80
        d0, d1, h0 = Decimal(gap_from), Decimal(gap_to), Decimal(height)
        h1 = (h0 * h0 - d0 * d0 + d1 * d1).sqrt()
        return float((d1 * (d0 + h0) ** 2 * h1 / (d0 * h0 * (d1 + h1) ** 2)).ln())


@pytest.mark.parametrize("open_to", [1.0 + 1e-9, 1.5, 1e3, 1e6])
@pytest.mark.parametrize("height", [1.0 + 1e-9, 1.0 + 1e-5, 2.0, 1e6])
def test_the_impulse_of_a_sphere_agrees_with_eighty_digits(height, open_to):
    d0, radius = 1e-12, 5e-3
    given = (d0, d0 * open_to, d0 * height)
    impulse = squeeze.sphere_impulse_conserved(radius, given[2], *given[:2], OIL)
    assert impulse == approx(6.0 * math.pi * OIL * radius**2 * printed_3_26(*given), CLOSED)


def test_a_film_hardly_higher_than_the_gap_takes_hardly_any_impulse():
    """1.178e-23 N.s, printed in four digits; without log1p nothing would be left of it."""
    impulse = squeeze.sphere_impulse_conserved(5e-3, 1e-12 * (1.0 + 1e-9), 1e-12, math.inf, OIL)
    assert impulse == approx(1.178e-23, 5e-4)


@pytest.mark.parametrize("tiny", [1e-6, 1e-9, 1e-12])
def test_a_tiny_opening_takes_force_times_time(tiny):
    """Impulse over travel tends to the force at unit speed; the next term is of order `tiny`."""
    gap, face, volume = 1e-6, 1e-3, 1e-12
    end = gap * (1.0 + tiny)
    travel = end - gap
    resistance = squeeze.disc_force(face, gap, 1.0, OIL)
    assert squeeze.disc_impulse_flooded(face, gap, end, OIL) == approx(
        resistance * travel, 4.0 * tiny
    )
    drawn = squeeze.disc_force(squeeze.disc_radius(volume, gap), gap, 1.0, OIL)
    assert squeeze.disc_impulse_conserved(volume, gap, end, OIL) == approx(
        drawn * travel, 4.0 * tiny
    )
    sphere = squeeze.sphere_force(face, gap, 3e-6, 1.0, OIL)
    assert squeeze.sphere_impulse_conserved(face, 3e-6, gap, end, OIL) == approx(
        sphere * travel, 4.0 * tiny
    )


# The impulse is the integral of the force over the path -------------------------------------


def path_integral(force, start, end):
    """Integral of a force at unit speed over the gap, in its logarithm."""
    value, _ = quad(
        lambda x: math.exp(x) * force(math.exp(x)),
        math.log(start),
        math.log(end),
        epsrel=1e-12,
        epsabs=0.0,
    )
    return value


def pinned(sphere, rim):
    return lambda gap: squeeze.sphere_force(
        sphere, gap, squeeze.sphere_rim_height(gap, rim, sphere), 1.0, OIL
    )


def conserved(sphere, volume):
    return lambda gap: squeeze.sphere_force(
        sphere, gap, squeeze.sphere_film_height(gap, volume, sphere), 1.0, OIL
    )


@pytest.mark.parametrize("end", [1.1e-6, 2e-6, 3e-5])
@pytest.mark.parametrize("start", [1e-9, 1e-6])
def test_the_impulse_of_a_disc_is_the_integral_of_its_force(start, end):
    face, volume = 1e-3, 3e-12
    flooded = path_integral(lambda h: squeeze.disc_force(face, h, 1.0, OIL), start, end)
    assert squeeze.disc_impulse_flooded(face, start, end, OIL) == approx(flooded, QUAD)
    drawn = path_integral(
        lambda h: squeeze.disc_force(squeeze.disc_radius(volume, h), h, 1.0, OIL), start, end
    )
    assert squeeze.disc_impulse_conserved(volume, start, end, OIL) == approx(drawn, QUAD)


@pytest.mark.parametrize("end", [1.1e-7, 2e-6, 3e-5])
@pytest.mark.parametrize("start", [1e-9, 1e-7])
def test_the_impulse_of_a_sphere_is_the_integral_of_its_force(start, end):
    sphere, volume = 5e-3, 1e-13
    height = squeeze.sphere_film_height(start, volume, sphere)
    assert squeeze.sphere_impulse_conserved(sphere, height, start, end, OIL) == approx(
        path_integral(conserved(sphere, volume), start, end), QUAD
    )


@pytest.mark.parametrize("rim", [1e-4, 1e-3, math.inf])
@pytest.mark.parametrize("end", [1.1e-7, 2e-6, 3e-5])
def test_the_impulse_of_a_sphere_full_to_its_rim_is_the_integral_of_its_force(rim, end):
    sphere, start = 5e-3, 1e-7
    assert squeeze.sphere_impulse_flooded(sphere, rim, start, end, OIL) == approx(
        path_integral(pinned(sphere, rim), start, end), QUAD
    )


def test_a_flooded_sphere_takes_the_logarithm_of_the_gaps():
    impulse = squeeze.sphere_impulse_flooded(5e-3, math.inf, 1e-9, 1e-6, OIL)
    assert impulse == approx(6.0 * math.pi * OIL * 5e-3**2 * math.log(1e3), CLOSED)


# Limits -------------------------------------------------------------------------------------


@pytest.mark.parametrize("ratio", [1.0 + 1e-6, 1.5, 10.0, 1e6])
def test_a_film_that_draws_in_takes_half_the_impulse_of_one_that_does_not(ratio):
    """Flooded over conserving is 2/(1 + h0^2/h1^2): 1 for a small opening, 2 for a wide one."""
    face, gap = 1e-3, 2e-6
    volume = math.pi * face**2 * gap
    flooded = squeeze.disc_impulse_flooded(face, gap, ratio * gap, OIL)
    conserving = squeeze.disc_impulse_conserved(volume, gap, ratio * gap, OIL)
    assert flooded / conserving == approx(2.0 / (1.0 + ratio**-2), CLOSED)


def test_a_film_wide_against_its_height_is_that_of_a_flooded_sphere():
    """What is left out is 2 D/H of the force."""
    force = squeeze.sphere_force(5e-3, 1e-9, 1e-2, 1e-3, OIL)
    assert force == approx(squeeze.sphere_force(5e-3, 1e-9, math.inf, 1e-3, OIL), 3e-7)


def test_a_sphere_flat_over_its_film_is_a_disc():
    """With a rim of a few gaps' sag the sphere is a disc of that radius, to twice sag over gap."""
    sphere, rim, gap = 1.0, 1e-4, 1e-4
    height = squeeze.sphere_rim_height(gap, rim, sphere)
    disc = squeeze.disc_force(rim, gap, 1e-3, OIL)
    assert squeeze.sphere_force(sphere, gap, height, 1e-3, OIL) == approx(
        disc, 2.0 * (height / gap - 1.0)
    )


def test_arrays_broadcast_and_agree_with_floats():
    gaps, radii = np.array([1e-9, 1e-6, 1e-5]), np.array([[1e-3], [2e-3]])
    impulse = squeeze.sphere_impulse_conserved(radii, 2.0 * gaps, gaps, math.inf, OIL)
    assert impulse.shape == (2, 3)
    # Powers of arrays and of floats may round differently.
    assert impulse[1, 2] == approx(
        squeeze.sphere_impulse_conserved(2e-3, 2e-5, 1e-5, math.inf, OIL), 1e-15
    )
    assert squeeze.disc_force(radii, gaps, 1.0, OIL).shape == (2, 3)
    assert squeeze.sphere_impulse_flooded(radii, 1e-4, gaps, 2e-5, OIL).shape == (2, 3)


# Another method: Reynolds' equation on a grid ------------------------------------------------


def order(cells, errors):
    """Slope of log(error) over log(width of a cell)."""
    return -np.polyfit(np.log(cells), np.log(np.abs(errors)), 1)[0]


@pytest.mark.parametrize("sphere", [math.inf, 0.05, 1e-3], ids=["flat", "shallow", "round"])
def test_the_grid_tends_to_the_closed_form_with_its_second_order(sphere):
    gap, rim, speed = 1e-6, 1e-4, 1e-3
    closed = (
        squeeze.disc_force(rim, gap, speed, OIL)
        if math.isinf(sphere)
        else pinned(sphere, rim)(gap) * speed
    )
    cells = np.array([50, 100, 200, 400, 800])
    errors = [
        film_force(lambda r: gap + r * r / (2.0 * sphere), rim, speed, OIL, n) / closed - 1.0
        for n in cells
    ]
    assert order(cells, errors) == pytest.approx(2.0, abs=0.1)
    assert abs(errors[-1]) < 3e-4
