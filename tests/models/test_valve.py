"""The drive of the spool valve: its energies, its limits, and the numbers of the fuel injector."""

from __future__ import annotations

import math
from itertools import pairwise

import pytest
from attrs import evolve
from hypothesis import given
from hypothesis import strategies as st
from scipy.integrate import quad, solve_ivp

from contactkit.models.injector import valve as law
from contactkit.models.injector.valve import Coil, DriveProfile, Stop

COIL = Coil(
    resistance=1.0, turns=40, pole_area=50e-6, air_gap=105e-6, iron_gap=20e-6, saturation=1.2
)
LINEAR = evolve(COIL, saturation=None)
STOP = Stop(gap=25e-6, stiffness=1e8, damping=5.0)
PROFILE = DriveProfile(
    start_delay=1e-3,
    period=10e-3,
    on_time=4e-3,
    boost_voltage=12.0,
    boost_time=0.25e-3,
    hold_voltage=5.2,
    off_voltage=-12.0,
    cycles=3,
)

gaps = st.floats(5e-6, 30e-6)
fluxes = st.floats(1e-5, 4e-3)


@given(flux=fluxes, gap=gaps)
def test_field_energy_is_the_area_under_the_current(flux, gap):
    area, _ = quad(lambda x: law.current(COIL, x, gap), 0.0, flux, epsrel=1e-12)
    assert law.field_energy(COIL, flux, gap) == pytest.approx(area, rel=1e-10)


@given(flux=fluxes, gap=gaps)
def test_magnet_force_is_the_slope_of_the_co_energy(flux, gap):
    """At constant current: the co-energy i*flux - W is found with the flux that keeps i."""
    current = law.current(COIL, flux, gap)

    def co_energy(at):
        low, high = 0.0, 0.02
        for _ in range(200):
            middle = 0.5 * (low + high)
            low, high = (middle, high) if law.current(COIL, middle, at) < current else (low, middle)
        return current * low - law.field_energy(COIL, low, at)

    step = 1e-8
    slope = (co_energy(gap + step) - co_energy(gap - step)) / (2.0 * step)
    assert law.magnet_force(COIL, flux) == pytest.approx(slope, rel=1e-4)


@pytest.mark.parametrize("coil", [COIL, LINEAR])
def test_energy_of_the_source_is_heat_field_and_work(coil):
    def rates(time, y):
        flux, gap = y[0], 5e-6 + 0.04 * time
        current = law.current(coil, flux, gap)
        rise = law.flux_rate(coil, flux, gap, 12.0)
        work = law.magnet_force(coil, flux) * 0.04
        return [rise, 12.0 * current, coil.resistance * current**2, work]

    end = solve_ivp(rates, (0.0, 5e-4), [0.0] * 4, rtol=1e-11, atol=1e-14).y[:, -1]
    flux, source, heat, work = end
    stored = law.field_energy(coil, flux, 25e-6)
    assert work > 0.01 * source
    assert source == pytest.approx(heat + stored + work, rel=1e-9)


@given(flux=st.floats(0.0, 2e-3), gap=gaps, speed=st.floats(-0.3, 0.3), time=st.floats(1e-7, 5e-4))
def test_flux_advances_as_scipy_has_it(flux, gap, speed, time):
    def rates(t, y):
        return [law.flux_rate(COIL, y[0], gap + speed * t, 12.0)]

    found = law.advance_flux(COIL, flux, gap, speed, 12.0, time)
    # Where the air gap ends the rate has a kink, which steps of scipy may straddle unseen.
    closing = (COIL.air_gap - gap) / speed if speed > 0.0 else math.inf
    expected = [flux]
    for part in pairwise((0.0, closing, time) if closing < time else (0.0, time)):
        expected = solve_ivp(rates, part, expected, method="DOP853", rtol=1e-12, atol=1e-16).y[
            :, -1
        ]
    assert found == pytest.approx(expected[0], rel=1e-9)


def test_flux_advances_past_the_end_of_the_air_gap_as_in_two_parts():
    flux, gap, speed, time = 6.18e-4, 2.46e-5, 0.228, 4.68e-4
    closing = (COIL.air_gap - gap) / speed
    part = law.advance_flux(COIL, flux, gap, speed, 12.0, closing)
    parts = law.advance_flux(COIL, part, COIL.air_gap, speed, 12.0, time - closing)
    assert law.advance_flux(COIL, flux, gap, speed, 12.0, time) == pytest.approx(parts, rel=1e-9)


def test_a_first_try_that_is_far_too_long_for_a_saturated_coil_is_shortened():
    """The flux ends where the resistance bears the whole voltage."""
    found = law.advance_flux(COIL, 0.0, 2e-4, 0.0, 60.0, 0.1)
    assert COIL.resistance * law.current(COIL, found, 2e-4) == pytest.approx(60.0, rel=1e-6)


def test_flux_of_a_resting_spool_rises_exponentially():
    constant = law.inductance(LINEAR, 5e-6) / LINEAR.resistance
    found = law.advance_flux(LINEAR, 0.0, 5e-6, 0.0, 12.0, 3e-4)
    assert law.current(LINEAR, found, 5e-6) == pytest.approx(
        -12.0 * math.expm1(-3e-4 / constant), rel=1e-10
    )


def test_the_division_of_time_does_not_matter():
    whole = law.advance_flux(COIL, 1e-3, 5e-6, 0.1, 12.0, 1e-4)
    parts = 1e-3
    for n in range(10):
        parts = law.advance_flux(COIL, parts, 5e-6 + 0.1 * n * 1e-5, 0.1, 12.0, 1e-5)
    assert parts == pytest.approx(whole, rel=1e-10)


def test_a_diode_ends_the_current_and_a_voltage_starts_it_again():
    assert law.advance_flux(COIL, 1e-3, 5e-6, 0.0, -12.0, 1.0) == 0.0
    assert law.advance_flux(COIL, 0.0, 5e-6, 0.0, -12.0, 1e-3) == 0.0
    assert 0.0 < law.advance_flux(COIL, 1e-3, 5e-6, 0.0, 0.0, 1e-3) < 1e-3
    assert law.advance_flux(COIL, 0.0, 5e-6, 0.0, 12.0, 1e-4) > 0.0


@given(gap=st.floats(0.0, 40e-6), speed=st.floats(-10.0, 10.0))
def test_the_stop_never_pulls_and_is_not_felt_before(gap, speed):
    force = law.stop_force(STOP, gap, speed)
    assert force >= 0.0
    assert gap > STOP.gap or force == 0.0


def test_the_stop_starts_from_nothing_at_any_speed_and_takes_energy():
    assert law.stop_force(STOP, STOP.gap * (1 + 1e-9), 1.0) < 1e-4

    def rates(time, y):
        return [y[1], -law.stop_force(STOP, y[0], y[1]) / 0.02]

    def leaves(time, y):
        return y[0] - STOP.gap

    leaves.terminal, leaves.direction = True, -1
    back = solve_ivp(rates, (0.0, 1e-3), [STOP.gap, 0.01], events=leaves, rtol=1e-10, atol=1e-14)
    # Small losses: a speed v comes back as v (1 - 2 d v/3), which is 3 % slower here.
    assert -back.y[1, -1] / 0.01 == pytest.approx(1.0 - 2.0 * 5.0 * 0.01 / 3.0, abs=2e-3)


@given(gap=gaps)
def test_forces_grow_the_way_they_should(gap):
    more = gap + 1e-6
    assert law.inductance(COIL, more) > law.inductance(COIL, gap)
    assert law.current(COIL, 1e-3, more) < law.current(COIL, 1e-3, gap)
    assert law.current(COIL, 3e-3, gap) > law.current(LINEAR, 3e-3, gap)
    assert law.magnet_force(COIL, 2e-3) == pytest.approx(4.0 * law.magnet_force(COIL, 1e-3))


def test_an_armature_at_the_poles_keeps_the_reluctance_of_the_iron():
    limit = law.inductance(LINEAR, 105e-6)
    assert law.inductance(LINEAR, 200e-6) == limit < math.inf


@given(start=st.floats(0.0, 0.04), length=st.floats(1e-6, 0.04))
def test_the_voltage_is_constant_between_switching_times(start, length):
    times = [start, *law.switching_times(PROFILE, start, start + length), start + length]
    assert times == sorted(times)
    for left, right in pairwise(times):
        inside = [left + f * (right - left) for f in (0.01, 0.5, 0.99)]
        if right - left > 1e-9:
            assert len({law.voltage(PROFILE, time) for time in inside}) == 1


def test_switching_times_are_those_of_the_profile():
    found = law.switching_times(PROFILE, 0.0, 1.0)
    cycle = [0.0, 0.25e-3, 4e-3]
    assert found == pytest.approx([1e-3 + 10e-3 * n + t for n in range(3) for t in cycle])
    assert law.switching_times(PROFILE, found[0], found[1]) == []
    assert law.energising_times(PROFILE) == pytest.approx([1e-3, 11e-3, 21e-3])


def test_a_short_step_finds_the_switching_times_of_a_late_cycle():
    profile = evolve(PROFILE, cycles=1_000_000)
    late = 1e-3 + 999_999 * 10e-3
    assert law.switching_times(profile, late - 1e-5, late + 1e-5) == pytest.approx([late])
