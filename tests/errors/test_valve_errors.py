"""Every message of the drive of the valve, and of its monolithic simulation."""

from __future__ import annotations

import re

import pytest
from attrs import evolve

from contactkit.errors import DescriptionError, PlanError
from contactkit.models.injector.monolithic import simulate
from contactkit.models.injector.valve import Coil, DriveProfile, Spring, Stop, Valve
from contactkit.separation.plan import plan

COIL = Coil(resistance=1.0, turns=40, pole_area=50e-6, air_gap=105e-6, iron_gap=20e-6)
PROFILE = DriveProfile(
    period=10e-3, on_time=4e-3, boost_voltage=12.0, boost_time=1e-3, hold_voltage=5.0
)
SPRING, STOP = Spring(stiffness=2e4, preload=15.0), Stop(gap=25e-6, stiffness=1e8)


@pytest.mark.parametrize(
    ("thing", "change", "message"),
    [
        (COIL, {"resistance": 0.0}, "Coil.resistance must be positive and finite [ohm], got 0.0"),
        (COIL, {"turns": 2.5}, "Coil.turns must be a whole number of at least 1, got 2.5"),
        (COIL, {"pole_area": -1.0}, "Coil.pole_area must be positive and finite [m2]"),
        (COIL, {"air_gap": float("inf")}, "Coil.air_gap must be positive and finite [m]"),
        (COIL, {"saturation": 0.0}, "Coil.saturation must be positive and finite [T], got 0.0"),
        (SPRING, {"preload": -1.0}, "Spring.preload must be zero or positive, and finite [N]"),
        (STOP, {"stiffness": 0.0}, "Stop.stiffness must be positive and finite [N/m]"),
        (STOP, {"damping": -1.0}, "Stop.damping must be zero or positive, and finite [s/m]"),
        (PROFILE, {"cycles": 0}, "DriveProfile.cycles must be a whole number of at least 1"),
        (
            PROFILE,
            {"off_voltage": 1.0},
            "DriveProfile.off_voltage must be zero or negative: it ends the current [V], got 1.0",
        ),
        (PROFILE, {"off_voltage": float("nan")}, "DriveProfile.off_voltage must be a finite"),
        (
            PROFILE,
            {"boost_time": 5e-3},
            "DriveProfile.boost_time must not exceed on_time = 0.004 s [s], got 0.005",
        ),
        (
            PROFILE,
            {"on_time": 11e-3},
            "DriveProfile.on_time must not exceed period = 0.01 s [s], got 0.011",
        ),
    ],
)
def test_an_impossible_number_is_refused(thing, change, message):
    with pytest.raises(DescriptionError, match=re.escape(message)):
        evolve(thing, **change)


def test_the_poles_must_lie_beyond_the_stop():
    message = "Stop.gap must be less than Coil.air_gap = 0.000105 m [m], got 0.0002; else the "
    with pytest.raises(DescriptionError, match=re.escape(message)):
        Valve(coil=COIL, spring=SPRING, stop=evolve(STOP, gap=200e-6), profile=PROFILE)


def test_a_monolithic_simulation_needs_a_force_and_a_mass(film_scene):
    for motion in ({"speed": 1e-6}, {"force": 1.0}):
        made = plan(film_scene(**motion))
        with pytest.raises(PlanError, match="needs loading"):
            simulate(made, lambda time: 1.0, 1e-3)
