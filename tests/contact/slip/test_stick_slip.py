"""Stick-slip of a spring-driven block: closed forms, and the equation of motion integrated."""

from __future__ import annotations

import math

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from selection import quick

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
    motion = stick_slip(SpringSlider(**BLOCK, mass=0.01), n_slips=3)
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
    motion = stick_slip(block, n_slips=2)
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
    motion = stick_slip(SpringSlider(**BLOCK, mass=0.01), n_slips=4)
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


def integrated(block, start, until):
    """Time, place and speed of a slip by another integrator, until rest or a time."""
    k, m, c = block.total_stiffness, block.mass, block.damping

    def rate(time, y):
        pull = start + k * (block.speed * time - y[0])
        return y[1], (pull - block.kinetic_friction - c * y[1]) / m

    def at_rest(time, y):
        return y[1] if time > 1e-3 * until else 1.0

    at_rest.terminal = True
    found = solve_ivp(
        rate, (0.0, until), (0.0, 0.0), rtol=1e-10, atol=1e-14, events=at_rest, method="Radau"
    )
    return found.t, found.y


@pytest.mark.parametrize("speed", quick([1e-3, 2e-2], 1))
@pytest.mark.parametrize("damping", [1e-9, 0.1, 1.0, 2.0])
def test_a_slip_with_drag_is_that_of_the_equation_of_motion(damping, speed):
    wet = {"meniscus_force": 0.4, "moving_meniscus_force": 0.1, "damping": damping}
    block = SpringSlider(**{**BLOCK, "speed": speed}, mass=0.01, **wet)
    assert block.static_friction == pytest.approx(0.7)
    assert block.kinetic_friction == pytest.approx(0.33)
    event = stick_slip(block, n_slips=2).events[1]
    assert event.force_before == pytest.approx(0.7, rel=1e-12)
    time, (place, along) = integrated(block, 0.7, 0.1)
    assert time[-1] == pytest.approx(event.end - event.start, rel=1e-6)
    assert place[-1] == pytest.approx(event.length, rel=1e-6)
    assert along.max() <= event.top_speed * (1.0 + 1e-6)
    after = 0.7 + 1e3 * (speed * time[-1] - place[-1])
    assert event.force_after == pytest.approx(after, rel=1e-5, abs=1e-6)


def test_a_little_drag_is_almost_none():
    dry, wet = (stick_slip(SpringSlider(**BLOCK, mass=0.01, damping=c)) for c in (0.0, 1e-10))
    assert wet.period == pytest.approx(dry.period, rel=1e-6)
    assert wet.dissipated_work == pytest.approx(dry.dissipated_work, rel=1e-6)
    assert wet.largest_force == pytest.approx(dry.largest_force, rel=1e-6)


def test_friction_and_drag_dissipate_what_the_spring_gives():
    block = SpringSlider(**BLOCK, mass=0.01, damping=1.0)
    motion = stick_slip(block, n_slips=1)
    _, (place, along) = integrated(block, 0.5, 0.1)
    work = 0.3 * place[-1] + np.trapezoid(along, place)
    assert motion.dissipated_work == pytest.approx(work, rel=1e-3)


@pytest.mark.parametrize(
    ("mass", "damping"), [(0.0, 2.0), (0.01, 2.0 * math.sqrt(10.0)), (0.01, 50.0)]
)
def test_much_drag_ends_in_steady_sliding(mass, damping):
    """Without inertia, at critical and above critical damping."""
    block = SpringSlider(**BLOCK, mass=mass, damping=damping)
    motion = stick_slip(block)
    steady = 0.3 + damping * 1e-3
    assert motion.events == ()
    assert motion.force[-1] == pytest.approx(steady, rel=1e-4)
    assert np.diff(motion.displacement).min() > -1e-12
    assert motion.largest_force == pytest.approx(0.5, rel=1e-4)
    assert motion.dissipated_work == 0.0
    between = (motion.time > motion.time[1]) & (motion.time < motion.time[-2])
    if mass:
        time, (place, _) = integrated(block, 0.5, float(motion.time[-2] - motion.time[1]))
        found = np.interp(motion.time[between] - motion.time[1], time, place)
        assert np.abs(found - motion.displacement[between]).max() < 1e-2 * place[-1]


def test_a_fast_spring_end_with_drag_slides_steadily():
    slow, fast = (
        stick_slip(SpringSlider(**{**BLOCK, "speed": v}, mass=0.01, damping=1.0))
        for v in (0.01, 1.0)
    )
    assert slow.events
    assert not fast.events
    assert fast.force[-1] == pytest.approx(1.3, rel=1e-4)


def test_impossible_sliders_are_refused():
    with pytest.raises(ck.DescriptionError, match="be at most static_coefficient"):
        SpringSlider(**{**BLOCK, "kinetic_coefficient": 0.6})
    with pytest.raises(ck.DescriptionError, match=r"at most meniscus_force = 0.1 N"):
        SpringSlider(**BLOCK, meniscus_force=0.1, moving_meniscus_force=0.2)
    with pytest.raises(ck.DescriptionError, match=r"stick_slip\(n_slips\) must be a whole number"):
        stick_slip(SpringSlider(**BLOCK), n_slips=0)


def test_what_is_no_block_is_refused():
    with pytest.raises(ck.DescriptionError, match=r"stick_slip\(slider\) must be a SpringSlider"):
        stick_slip(3)
