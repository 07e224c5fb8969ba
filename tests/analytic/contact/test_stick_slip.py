"""Stick-slip of a spring-driven block: closed forms, and the equation of motion integrated."""

from __future__ import annotations

import math

import numpy as np
import pytest
from scipy.integrate import solve_ivp

import contactkit as ck
from contactkit.analyses.stick_slip import SpringSlider, stick_slip

BLOCK = {
    "load": 1.0,
    "static_coefficient": 0.5,
    "kinetic_coefficient": 0.3,
    "stiffness": 1e3,
    "speed": 1e-3,
}


def test_a_mass_sticks_and_slips_as_its_closed_form():
    motion = stick_slip(SpringSlider(**BLOCK, mass=0.01), slips=3)
    event = motion.events[2]
    assert motion.stick_time == pytest.approx(0.4, rel=1e-12)
    assert motion.slip_time == pytest.approx(0.010034579933712545, rel=1e-12)
    assert motion.largest_force == pytest.approx(0.50002499843769528, rel=1e-13)
    assert (event.force_before, event.force_after) == pytest.approx((0.5, 0.1), rel=1e-12)
    assert event.length == pytest.approx(0.00041003457993371254, rel=1e-12)
    assert event.top_speed == pytest.approx(0.064253458403473877, rel=1e-12)
    assert event.start - motion.events[1].start == pytest.approx(0.41003457993371254, rel=1e-12)


@pytest.mark.parametrize("speed", [1e-3, 0.1], ids=["slow", "fast"])
def test_the_slip_is_that_of_the_equation_of_motion(speed):
    block = SpringSlider(**{**BLOCK, "speed": speed}, mass=0.01, contact_stiffness=5e3)
    motion = stick_slip(block, slips=2)
    k, event = block.total_stiffness, motion.events[0]
    assert k == pytest.approx(1e3 * 5e3 / 6e3)

    def rate(time, y):
        return y[1], (0.5 + k * (speed * time - y[0]) - 0.3) / 0.01

    def at_rest(time, y):
        return y[1] if time > 1e-4 else 1.0

    at_rest.terminal = True
    found = solve_ivp(rate, (0.0, 1.0), (0.0, 0.0), rtol=1e-10, atol=1e-13, events=at_rest)
    assert found.t[-1] == pytest.approx(event.end - event.start, rel=1e-6)
    assert found.y[0, -1] == pytest.approx(event.length, rel=1e-6)
    assert found.y[1].max() <= event.top_speed * (1.0 + 1e-6)


def test_without_inertia_the_period_is_half():
    motion = stick_slip(SpringSlider(**BLOCK))
    assert motion.period == pytest.approx(0.2, rel=1e-12)
    assert motion.events[0].length == pytest.approx(2e-4, rel=1e-12)
    assert (motion.force.min(), motion.force[-1]) == (0.0, 0.3)
    light = stick_slip(SpringSlider(**BLOCK, mass=1e-12))
    assert light.period == pytest.approx(0.4, rel=1e-4)


def test_energy_is_conserved_over_a_period():
    """What the spring's end does is what friction dissipates."""
    motion = stick_slip(SpringSlider(**BLOCK, mass=0.01), slips=4)
    first, last = motion.events[0].end, motion.events[1].end
    inside = (motion.time >= first) & (motion.time <= last)
    work = BLOCK["speed"] * np.trapezoid(motion.force[inside], motion.time[inside])
    assert work == pytest.approx(motion.dissipated_work, rel=1e-4)
    assert motion.displacement[-1] == pytest.approx(4.0 * motion.events[0].length, rel=1e-12)


def test_equal_coefficients_do_not_stick():
    equal = {**BLOCK, "kinetic_coefficient": 0.5}
    steady = stick_slip(SpringSlider(**equal))
    assert (steady.events, steady.period, steady.force[-1]) == ((), 0.0, 0.5)
    swinging = stick_slip(SpringSlider(**equal, mass=0.01))
    assert swinging.stick_time == pytest.approx(0.0, abs=1e-12)
    assert swinging.slip_time == pytest.approx(2.0 * math.pi * math.sqrt(1e-5), rel=1e-12)
    smooth = stick_slip(
        SpringSlider(**{**BLOCK, "static_coefficient": 0, "kinetic_coefficient": 0})
    )
    assert not smooth.force.any()


def test_impossible_sliders_are_refused():
    with pytest.raises(ck.DescriptionError, match="be at most static_coefficient"):
        SpringSlider(**{**BLOCK, "kinetic_coefficient": 0.6})
    with pytest.raises(ck.DescriptionError, match=r"stick_slip\(slips\) must be a whole number"):
        stick_slip(SpringSlider(**BLOCK), slips=0)


def test_what_is_no_block_is_refused():
    with pytest.raises(ck.DescriptionError, match=r"stick_slip\(slider\) must be a SpringSlider"):
        stick_slip(3)
