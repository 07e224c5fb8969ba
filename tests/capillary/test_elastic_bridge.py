"""Menisci between deforming bodies: reference cases, limits, and a balance solved otherwise."""

import json
import math
from pathlib import Path

import numpy as np
import pytest

from contactkit.adhesion import wet_contact
from contactkit.capillary import elastic_bridge as bridges
from contactkit.elasticity import rings

CASES = {
    case["id"]: case
    for case in json.loads((Path(__file__).parents[1] / "data/wet.json").read_text())["cases"]
}
NAMES = {"pull_force": "force", "laplace": "laplace_pressure"}


def of_kind(kind):
    return [name for name, case in CASES.items() if case["kind"] == kind]


def numbers(case):
    given = case["inputs"]
    return given["radius"], given["effective_modulus"], given["gamma_c"]


def agree(bridge, values, rel):
    for name, value in values.items():
        assert getattr(bridge, NAMES.get(name, name)) == pytest.approx(value, rel=rel), name


@pytest.mark.parametrize("name", of_kind("static_bridge"))
def test_bridge_of_volume(name):
    case = CASES[name]
    given = case["inputs"]
    bridge = bridges.bridge_of_volume(given["rigid_gap"], given["liquid_volume"], *numbers(case))
    agree(bridge, case["values"], 1e-9)
    assert bridge.volume == pytest.approx(given["liquid_volume"], rel=1e-12)


def test_snap_in_of_volume():
    case = CASES["snap_in_volume_E1e+06"]
    end = bridges.snap_in_of_volume(case["inputs"]["liquid_volume"], *numbers(case))
    assert end.event == "fold"
    agree(end.bridge, case["values"], 5e-8)  # the reference's own error at the extremum
    assert end.bridge.rigid_gap == pytest.approx(case["values"]["rigid_gap"], rel=1e-12)


def test_no_bridge_beyond_snap_in():
    end = bridges.snap_in_of_volume(1e-15, 1e-3, 1e6, 0.1).bridge
    assert bridges.bridge_of_volume(0.999999 * end.rigid_gap, 1e-15, 1e-3, 1e6, 0.1) is None
    near = bridges.bridge_of_volume(1.0001 * end.rigid_gap, 1e-15, 1e-3, 1e6, 0.1)
    assert near.force < end.force


def test_stiff_bodies_touch_before_they_fold():
    end = bridges.snap_in_of_volume(1e-15, 1e-3, 1e9, 0.1)
    assert end.event == "touch"
    assert end.bridge.centre_gap == pytest.approx(0.0, abs=1e-15)


def test_snap_in_at_pressure():
    case = CASES["snap_in_pressure_E1e+09"]
    pressure = case["inputs"]["laplace"]
    end = bridges.snap_in_at_pressure(pressure, *numbers(case))
    agree(end, case["values"], 1e-9)
    stable = bridges.bridge_at_pressure((1.0 - 1e-12) * end.rigid_gap, pressure, *numbers(case))
    assert stable.rim_radius == pytest.approx(end.rim_radius, rel=1e-3)
    assert bridges.bridge_at_pressure(1.000001 * end.rigid_gap, pressure, *numbers(case)) is None


def test_rim_gap_and_volume_by_a_matrix_of_rings():
    """Another method: displacements of 400 rings, volume by a sum."""
    R, E, wetting = 1e-3, 1e6, 0.1
    bridge = bridges.bridge_of_volume(3e-6, 1e-15, R, E, wetting)
    x = np.linspace(0.0, bridge.rim_radius, 401)
    gap = bridge.rigid_gap + x * x / (2.0 * R)
    gap -= rings.half_space_matrix(x) @ np.full(401, bridge.laplace_pressure) / E
    assert gap[-1] == pytest.approx(wetting / bridge.laplace_pressure, rel=1e-10)
    assert gap[0] == pytest.approx(bridge.centre_gap, rel=1e-10)
    assert 2.0 * math.pi * np.trapezoid(gap * x, x) == pytest.approx(1e-15, rel=1e-4)


def test_maugis_with_the_pressure_of_the_liquid():
    case = CASES["maugis_E1e+09"]
    given, values = case["inputs"], case["values"]
    R, E, wetting = numbers(case)
    found = wet_contact.limits(given["laplace"], R, E, wetting)
    assert -found.pull_off.load == pytest.approx(values["pull_off_force"], rel=1e-9)
    rests = wet_contact.state_under_load(0.0, given["laplace"], R, E, wetting)
    assert rests.contact_radius == pytest.approx(values["contact_radius_at_zero_load"], rel=1e-9)
    assert rests.rim_radius == pytest.approx(values["rim_radius_at_zero_load"], rel=1e-9)
    assert rests.approach == pytest.approx(values["approach_at_zero_load"], rel=1e-9)


@pytest.mark.parametrize(("modulus", "part"), [(1e15, 2.0), (1e3, 1.5)])
def test_pull_off_of_stiff_and_soft_wet_contacts(modulus, part):
    found = wet_contact.limits(1e6, 1e-3, modulus, 0.1)
    assert -found.pull_off.load == pytest.approx(part * math.pi * 1e-3 * 0.1, rel=2e-3)


def test_bridge_at_touch_and_contact_meet():
    """At the gap where the axis touches, disc and Maugis' contact of radius 0 are one state."""
    pressure, R, E, wetting = 1e6, 1e-3, 1e10, 0.1
    low, high = 0.0, wetting / pressure
    for _ in range(100):
        gap = 0.5 * (low + high)
        centre = bridges.bridge_at_pressure(gap, pressure, R, E, wetting).centre_gap
        low, high = (gap, high) if centre < 0.0 else (low, gap)
    bridge = bridges.bridge_at_pressure(gap, pressure, R, E, wetting)
    touch = wet_contact.state_under_load(-bridge.force, pressure, R, E, wetting)
    assert touch.contact_radius == pytest.approx(0.0, abs=0.05 * bridge.rim_radius)
    assert touch.rim_radius == pytest.approx(bridge.rim_radius, rel=2e-3)
