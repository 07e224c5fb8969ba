"""Every message of the drive of the valve, and of its monolithic simulation."""

from __future__ import annotations

import math
import re

import pytest
from attrs import evolve
from refusals import each_change_refused

import contactkit as ck
from contactkit.errors import ConvergenceError, DescriptionError, PlanError
from contactkit.models.injector import monolithic
from contactkit.models.injector.monolithic import simulate
from contactkit.models.injector.valve import Coil, DriveProfile, Spring, Stop, Valve
from contactkit.separation.plan import plan

pytestmark = pytest.mark.errors

COIL = Coil(resistance=1.0, turns=40, pole_area=50e-6, air_gap=105e-6, iron_gap=20e-6)
PROFILE = DriveProfile(
    period=10e-3, on_time=4e-3, boost_voltage=12.0, boost_time=1e-3, hold_voltage=5.0
)
SPRING, STOP = Spring(stiffness=2e4, preload=15.0), Stop(gap=25e-6, stiffness=1e8)


test_an_impossible_number_is_refused = each_change_refused(
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


def test_the_poles_must_lie_beyond_the_stop():
    message = "Stop.gap must be less than Coil.air_gap = 0.000105 m [m], got 0.0002; else the "
    with pytest.raises(DescriptionError, match=re.escape(message)):
        Valve(coil=COIL, spring=SPRING, stop=evolve(STOP, gap=200e-6), profile=PROFILE)


@pytest.mark.parametrize(
    ("motion", "cure"),
    [
        ({"speed": 1e-6}, "needs loading = ImposedForce"),
        ({"force": 1.0}, "needs loading.mass [kg]: give the moving mass"),
    ],
)
def test_what_a_monolithic_simulation_needs_is_named_with_its_cure(film_scene, motion, cure):
    with pytest.raises(PlanError, match=re.escape(cure)):
        simulate(plan(film_scene(**motion)), lambda time: 1.0, 1e-3)


@pytest.mark.parametrize("end", [0.0, -1.0, float("nan")])
def test_a_monolithic_simulation_ends_after_it_starts(film_scene, end):
    made = plan(film_scene(force=1.0, mass=1e-3))
    with pytest.raises(DescriptionError, match=r"end must be positive and finite \[s\]"):
        simulate(made, lambda time: 1.0, end)


@pytest.mark.slow
def test_a_solver_that_gives_up_names_a_cure(film_scene):
    made = plan(film_scene(ck.ViscousForce(), force=1.0, mass=1e-3))
    # No step is short enough for a pull that grows beyond all bounds.
    with pytest.raises(ConvergenceError, match="Use a larger rtol") as caught:
        simulate(made, lambda time: 1.0 / (1e-4 - time) ** 2 if time < 1e-4 else math.inf, 1e-3)
    assert "m/s" in str(caught.value)


def test_events_without_end_name_a_cure(film_scene, monkeypatch):
    monkeypatch.setattr(monolithic, "_MOST_PIECES", 1)
    scene = film_scene(ck.ViscousForce(), force=1.0, mass=1e-3, stiffness=1e9)
    with pytest.raises(ConvergenceError, match="end earlier, or move apart the marks"):
        simulate(plan(scene), lambda time: math.sin(1e6 * time), 1e-3)


def test_a_column_that_a_result_does_not_have_is_answered(film_scene):
    result = simulate(plan(film_scene(force=1.0, mass=1e-3)), lambda time: 1.0, 1e-9)
    with pytest.raises(DescriptionError, match="did you mean 'speed'"):
        result["sped"]
