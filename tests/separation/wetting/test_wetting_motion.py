"""Dynamic wetting in a motion under a force: against the published equations and imposed speeds."""

from __future__ import annotations

import math

import numpy as np
import pytest
from attrs import evolve
from refusals import refuses
from scipy.integrate import solve_ivp

import contactkit as ck
from contactkit.capillary.exact.bridge import bridge
from contactkit.capillary.exact.stability import stability_limit
from contactkit.capillary.wetting.cox_voinov import dynamic_angle
from contactkit.capillary.wetting.moving_bridge import BridgeTable

pytestmark = pytest.mark.filterwarnings("ignore::contactkit.errors.ValidityWarning")

ETA, GAMMA, RADIUS, VOLUME = 0.01, 0.03, 5e-3, 1e-11
OIL = ck.Liquid(name="oil", viscosity=ETA, surface_tension=GAMMA, density=900.0)
FLAT, BALL = ck.Flat(), ck.Sphere(radius=RADIUS)
MENISCUS, VISCOUS = ck.MeniscusForce(), ck.ViscousForce()
COX, LANDAU, RUPTURE = ck.CoxVoinovAngle(), ck.LandauLevichFilm(), ck.DynamicRupture()
FIRST = 5e-6


def pulled(*effects, upper=FLAT, lower=FLAT, angle=0.0, volume=VOLUME, rewetting=1.0, **loading):
    given = {"force": 0.03, "mass": 0.1, "initial_gap": FIRST, "final_gap": 3e-4} | loading
    meniscus = ck.Meniscus(
        liquid=OIL,
        volume=volume,
        contact_angle_lower=angle,
        contact_angle_upper=angle,
        rewetting=rewetting,
    )
    return ck.SeparationScene(
        interface=ck.Interface(lower=lower, upper=upper, meniscus=meniscus),
        loading=ck.ImposedForce(**given),
        effects=effects,
    )


def run(*effects, **given):
    return ck.simulate(ck.plan(pulled(*effects, **given)))


def coasting(*effects, speed=1e-3, **given):
    """A mass so heavy that no film slows it, and the same film at its speed."""
    scene = pulled(*effects, force=0.0, mass=1e7, initial_speed=speed, **given)
    loading = scene.loading
    imposed = ck.ImposedSpeed(
        speed=speed, initial_gap=loading.initial_gap, final_gap=loading.final_gap
    )
    return ck.simulate(ck.plan(scene)), ck.simulate(ck.plan(evolve(scene, loading=imposed)))


# A heavy mass ----------------------------------------------------------------------------------


@pytest.mark.slow
@pytest.mark.parametrize(
    ("effect", "angle", "upper"),
    [
        (COX, 0.6, FLAT),
        (COX, 0.0, FLAT),
        (COX, 1.9, FLAT),
        (COX, 0.6, BALL),
        (LANDAU, 0.0, FLAT),
        (LANDAU, 0.0, BALL),
        (RUPTURE, 0.6, FLAT),
    ],
)
def test_a_mass_that_nothing_slows_is_one_of_imposed_speed(effect, angle, upper):
    moved, imposed = coasting(MENISCUS, VISCOUS, effect, angle=angle, upper=upper)
    for name in ("meniscus_impulse", "viscous_impulse"):
        assert moved.impulses[name] == pytest.approx(imposed.impulses[name], rel=2e-3)
    end = imposed.plan.film.end
    if end < 3e-4:
        assert FIRST + 1e-3 * moved.state.break_time == pytest.approx(end, rel=1e-4)
    else:
        assert moved.state.n_breaks == 0
    inside = moved.gap < 0.9 * min(end, 3e-4)
    names = "meniscus_force", "viscous_force", "deposited_volume"
    for name in (one for one in names if one in moved.columns):
        there = np.interp(moved.gap[inside], imposed.gap, imposed[name])
        off = np.max(np.abs(moved[name][inside] - there)) / np.max(np.abs(there))
        assert off < 4e-3, name  # four times what lines of a curve may miss


# Rest ------------------------------------------------------------------------------------------


@pytest.mark.slow
@pytest.mark.parametrize(("effect", "angle"), [(COX, 0.6), (LANDAU, 0.0), (RUPTURE, 0.6)])
def test_slower_than_its_line_can_tell_a_motion_is_that_without(effect, angle):
    """A viscosity of 1e-10 Pa.s: capillary numbers of 1e-11 at most."""
    thin = ck.Liquid(name="thin", viscosity=1e-10, surface_tension=GAMMA)
    found = []
    for effects in ((MENISCUS, VISCOUS, effect), (MENISCUS, VISCOUS)):
        scene = pulled(*effects, angle=angle, force=0.05, initial_gap=5e-5)
        interface = scene.interface
        liquid = evolve(interface.meniscus, liquid=thin)
        scene = evolve(scene, interface=evolve(interface, meniscus=liquid))
        found.append(ck.simulate(ck.plan(scene)))
    moved, still = found
    for name in ("release_time", "break_time", "release_speed", "peak_force"):
        value = still.scalars()[name][0]
        assert moved.scalars()[name][0] == pytest.approx(value, rel=1e-4), name


# The equations, written down -------------------------------------------------------------------


def viscous(gap, volume, speed):
    return 1.5 * ETA * volume**2 / math.pi / gap**5 * speed


@pytest.mark.slow
def test_a_motion_with_a_moving_angle_is_that_of_cox_and_of_exact_bridges():
    """Line and force of each instant from bridges solved there, one by one."""
    angle, force, mass = 0.6, 0.05, 0.02

    def radius(gap):
        return float(bridge(gap, VOLUME, angle, angle).radius_lower)

    def rates(time, y):
        gap, speed = y
        slope = (radius(gap * 1.0001) - radius(gap * 0.9999)) / (2e-4 * gap)
        drive = ETA * speed * slope / GAMMA * math.log(gap / 1e-9)
        moved = dynamic_angle(angle, drive)
        pull = GAMMA * float(bridge(gap, VOLUME, moved, moved).force)
        return [speed, (force - pull - viscous(gap, VOLUME, speed)) / mass]

    def opened(time, y):
        return y[0] - 5e-5

    start = 1e-5
    expected = solve_ivp(
        rates, (0.0, 1.0), [start, 0.0], "LSODA", rtol=1e-6, atol=[1e-12, 1e-9],
        events=_last(opened),
    )  # fmt: skip
    found = run(
        MENISCUS, VISCOUS, COX, angle=angle, force=force, mass=mass,
        initial_gap=start, final_gap=5e-5,
    )  # fmt: skip
    still = run(
        MENISCUS, VISCOUS, angle=angle, force=force, mass=mass, initial_gap=start, final_gap=5e-5
    )
    assert found.state.release_time == pytest.approx(float(expected.t_events[0][0]), rel=2e-5)
    assert found.state.release_speed == pytest.approx(expected.y_events[0][0][1], rel=2e-5)
    assert found.state.release_time > 1.003 * still.state.release_time


def _last(event):
    event.terminal = True
    return event


@pytest.mark.slow
def test_a_motion_that_leaves_liquid_behind_is_that_of_landau_and_levich():
    """Volume, gap and speed together: three equations, with bridges solved one by one."""
    force, mass, start, last = 0.05, 0.02, 1e-5, 6e-5

    def line(gap, volume):
        return float(bridge(gap, volume, 0.0, 0.0).radius_lower)

    def rates(time, y):
        gap, speed, volume = y[0], y[1], y[2] * VOLUME
        here = bridge(gap, volume, 0.0, 0.0)
        r, curved = float(here.radius_lower), -float(here.pressure)
        by_gap = (line(gap * 1.0001, volume) - line(gap * 0.9999, volume)) / (2e-4 * gap)
        by_volume = (line(gap, volume * 1.0001) - line(gap, volume * 0.9999)) / (2e-4 * volume)
        lost = 0.0
        for _ in range(60):
            u = max(-by_gap * speed + by_volume * lost, 0.0)
            thin = 1.3375 * (ETA * u / GAMMA) ** (2.0 / 3.0)
            lost = 4.0 * math.pi * r * u * thin / (1.0 + 2.5 * thin) / curved
        pull = GAMMA * float(here.force) + viscous(gap, volume, speed)
        return [speed, (force - pull) / mass, -lost / VOLUME]

    expected = solve_ivp(
        rates, (0.0, 1.0), [start, 0.0, 1.0], "LSODA", rtol=1e-6, atol=[1e-12, 1e-9, 1e-9],
        events=_last(lambda time, y: y[0] - last),
    )  # fmt: skip
    found = run(
        MENISCUS, VISCOUS, LANDAU, force=force, mass=mass, initial_gap=start, final_gap=last
    )
    end = expected.y_events[0][0]
    assert found.state.release_time == pytest.approx(float(expected.t_events[0][0]), rel=1e-4)
    assert found.state.release_speed == pytest.approx(end[1], rel=1e-4)
    assert 1.0 - found.state.volume_fraction == pytest.approx(1.0 - end[2], rel=1e-3)
    assert found.state.volume_fraction < 0.9
