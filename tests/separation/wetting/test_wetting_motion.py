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


def unslowed(*effects, speed=1e-3, **given):
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
        (COX, 1.9, FLAT),
        pytest.param(COX, 0.6, BALL, marks=pytest.mark.exhaustive),
        (LANDAU, 0.0, BALL),
        (RUPTURE, 0.6, FLAT),
    ],
)
def test_a_mass_that_nothing_slows_is_one_of_imposed_speed(effect, angle, upper):
    # Under the ball each pair of angles costs some 25 ms, and a short way has few.
    last = 4e-5 if upper is BALL and effect is COX else 3e-4
    moved, imposed = unslowed(MENISCUS, VISCOUS, effect, angle=angle, upper=upper, final_gap=last)
    for name in ("meniscus_impulse", "viscous_impulse"):
        assert moved.impulses[name] == pytest.approx(imposed.impulses[name], rel=2e-3)
    end = imposed.plan.film.end
    if end < last:
        assert FIRST + 1e-3 * moved.state.break_time == pytest.approx(end, rel=1e-4)
    else:
        assert moved.state.n_breaks == 0
    inside = moved.gap < 0.9 * min(end, last)
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


# Balances --------------------------------------------------------------------------------------


@pytest.mark.slow
@pytest.mark.parametrize("effect", [COX, LANDAU, RUPTURE], ids=lambda e: e.name)
def test_the_impulses_of_a_swing_add_up_to_its_momentum(effect):
    """Closes, turns, opens, turns on its spring: lines recede and advance, at speeds through 0."""
    angle = 0.4 if effect is COX else 0.0
    found = run(
        MENISCUS, VISCOUS, effect, angle=angle, force=0.01, mass=1e-3, stiffness=300.0,
        initial_gap=6e-5, initial_speed=-2e-3, time_limit=0.04,
    )  # fmt: skip
    speed, time, gap = found.speed, found.time, found.gap
    assert np.count_nonzero(np.diff(np.sign(speed))) >= 2
    held = float(np.trapezoid(300.0 * (gap - 6e-5), time))
    given = (
        0.01 * time[-1]
        - held
        - sum(found.impulses[name] for name in ("meniscus_impulse", "viscous_impulse"))
    )
    assert 1e-3 * (speed[-1] - speed[0]) == pytest.approx(given, abs=1e-3 * 0.01 * time[-1])
    assert found.state.dissipated_work > 0.0
    if effect is LANDAU:
        assert (np.diff(found["deposited_volume"]) >= -1e-9 * VOLUME).all()


@pytest.mark.slow
def test_the_work_on_a_film_is_what_its_mass_does_not_get():
    found = run(MENISCUS, VISCOUS, LANDAU, force=0.03)
    broke = found.gap <= found.state.gap
    total = found["meniscus_force"] + found["viscous_force"]
    taken = float(np.trapezoid(total[broke], found.gap[broke]))
    kept = 0.5 * 0.1 * found.state.release_speed**2
    assert pytest.approx(taken + kept, rel=2e-3) == 0.03 * (3e-4 - FIRST)


# Hard cases ------------------------------------------------------------------------------------


@pytest.mark.hard
@pytest.mark.slow
@pytest.mark.parametrize("angle", [0.0, 0.5 * math.pi, math.pi])
def test_a_line_of_any_angle_opens_and_closes(angle):
    for speed in (2e-3, -2e-3):
        found = run(
            MENISCUS, VISCOUS, COX, angle=angle, force=0.05, initial_gap=3e-5, initial_speed=speed
        )
        assert found.status == "released"
        for name in ("dynamic_angle_lower", "meniscus_force", "speed"):
            assert np.isfinite(found[name][found.gap < 1e-4]).all()
        whole = np.isfinite(found["dynamic_angle_lower"])
        moved = found["dynamic_angle_lower"][whole]
        assert moved.min() >= 0.0
        assert moved.max() <= math.pi
        if angle == math.pi:
            assert moved == pytest.approx(math.pi)


@pytest.mark.hard
@pytest.mark.slow
def test_without_a_mass_the_film_sets_the_speed():
    for effect, angle in ((COX, 0.6), (LANDAU, 0.0)):
        found = run(MENISCUS, VISCOUS, effect, angle=angle, mass=None, force=0.05, final_gap=1.2e-5)
        heavy = run(MENISCUS, VISCOUS, effect, angle=angle, mass=1e-6, force=0.05, final_gap=1.2e-5)
        assert found.state.release_time == pytest.approx(heavy.state.release_time, rel=1e-3)


@pytest.mark.hard
@pytest.mark.slow
def test_what_a_motion_reaches_and_a_law_does_not_know_is_refused_there():
    fast = {"force": 0.0, "mass": 1e7}
    closing = {"initial_speed": -1e-3, "force": 0.05}
    for effects, given, words in (
        # Ca of the opening is 1 at 3 m/s.
        ((RUPTURE,), {"initial_speed": 4.0}, ("DynamicRupture", "1.33", "4 m/s", "Rupture(gap=")),
        ((COX,), {"initial_speed": 1.0, "angle": 0.5}, ("CoxVoinovAngle", "capillary number")),
        ((LANDAU,), {"initial_speed": 0.5}, ("LandauLevichFilm", "capillary number", "up to 1")),
        ((LANDAU,), closing | {"initial_gap": 5e-5, "upper": ck.Flat(radius=4e-4)},
         ("LandauLevichFilm", "fills its faces", "1.99e-05 m", "rest_gap")),
        ((COX,), closing | {"angle": 0.5, "upper": BALL}, ("CoxVoinovAngle", "closes", "rest_gap")),
    ):  # fmt: skip
        made = ck.plan(pulled(MENISCUS, *effects, **(fast | given)))
        refuses(lambda made=made: ck.simulate(made), *words, error=ck.InfeasibleError)
    # Not before: at 4 m/s, to where a film at rest is still whole.
    found = run(MENISCUS, RUPTURE, initial_speed=4.0, final_gap=1e-4, **fast)
    assert found.status == "released"
    assert found.state.n_breaks == 0


@pytest.mark.hard
def test_a_film_that_breaks_at_once_is_refused():
    at_rest = ck.plan(pulled(MENISCUS, VISCOUS)).film.end
    given = {"initial_gap": 1.05 * at_rest, "final_gap": 2.0 * at_rest}
    refuses(
        lambda: ck.plan(pulled(MENISCUS, VISCOUS, RUPTURE, **given)),
        "no meniscus spans the initial gap", error=ck.InfeasibleError,
    )  # fmt: skip
    # At a capillary number of 0.01 it reaches a tenth further: until the mass is slower.
    moved = run(MENISCUS, VISCOUS, RUPTURE, initial_speed=0.03, force=0.0, mass=1e3, **given)
    assert 1.05 * at_rest + 0.03 * moved.state.break_time > FIRST
    assert moved.state.break_time == pytest.approx(0.05 * at_rest / 0.03, rel=1e-3)
    slowed = run(
        MENISCUS, VISCOUS, RUPTURE, initial_speed=0.03, force=0.0, mass=1e-3, stiffness=1e5,
        time_limit=1e-3, **given,
    )  # fmt: skip
    assert 0.0 < slowed.state.break_time < 0.5 * moved.state.break_time


def test_what_does_not_go_with_a_film_that_loses_liquid_is_refused():
    refuses(
        lambda: ck.plan(pulled(MENISCUS, LANDAU, rewetting=0.2)),
        "LandauLevichFilm", "30%", "rewetting is 0.2", error=ck.PlanError,
    )  # fmt: skip
    plan = ck.plan(pulled(MENISCUS, VISCOUS, LANDAU))
    refuses(lambda: plan.force(1e-5, 1e-3), "loses liquid", error=ck.PlanError)
    assert "at most: the gap depends on the motion" in str(plan)
    off = str(ck.plan(pulled(MENISCUS, VISCOUS)))
    for name in ("landau-levich-film", "cox-voinov-angle", "dynamic-rupture"):
        assert f"off  {name}" in off


@pytest.mark.slow
def test_limits_of_the_liquid_act_on_a_film_that_loses_liquid():
    limit = ck.TensionLimit(strength=2e3, cavity="truncated")
    found = run(MENISCUS, VISCOUS, LANDAU, limit, force=0.05)
    assert found.of(ck.TensionLimit).acts.any()
    refuses(
        lambda: found.of(ck.ViscousForce).newtonian_impulse, "loses liquid",
        error=ck.NotSimulatedError,
    )  # fmt: skip
    free = run(MENISCUS, VISCOUS, LANDAU, force=0.05)
    assert free.of(ck.ViscousForce).newtonian_impulse == free.of(ck.ViscousForce).impulse
    assert found.state.release_time < free.state.release_time


# Gradients -------------------------------------------------------------------------------------


@pytest.mark.slow
def test_the_slope_of_a_release_with_a_moving_angle_is_that_of_whole_motions():
    path, given = "interface.meniscus.liquid.viscosity", {"angle": 0.6, "final_gap": 6e-5}

    def release(viscosity):
        scene = pulled(MENISCUS, VISCOUS, COX, **given)
        film = scene.interface.meniscus
        film = evolve(film, liquid=evolve(film.liquid, viscosity=viscosity))
        scene = evolve(scene, interface=evolve(scene.interface, meniscus=film))
        return ck.simulate(ck.plan(scene, ck.Accuracy(time_rtol=1e-9)))

    slope = release(ETA).gradient("release_time", [path])
    near, far = (release(ETA * x).state.release_time for x in (0.999, 1.001))
    expected = (far - near) / (0.002 * ETA)
    assert float(slope[path]) == pytest.approx(expected, rel=1e-3)


@pytest.mark.slow
def test_gradients_that_are_not_there_are_refused_by_name():
    path = "interface.meniscus.liquid.viscosity"
    for effect, word in ((LANDAU, "LandauLevichFilm"), (RUPTURE, "DynamicRupture")):
        found = run(MENISCUS, VISCOUS, effect)
        refuses(
            lambda found=found: found.gradient("release_time", [path]), word, "ck.sensitivity",
            error=ck.NotSimulatedError,
        )  # fmt: skip


# The table -------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("curvatures", "is_even", "angles", "rtol"),
    [
        ((0.0, 0.0), True, (0.9, 0.9), 1e-4),
        pytest.param((0.0, 0.0), False, (0.5, 0.8), 3e-4, marks=pytest.mark.slow),
        pytest.param((0.0, 0.043), False, (0.33, 0.3), 1e-4, marks=pytest.mark.slow),
    ],
)
def test_a_table_of_bridges_is_that_of_bridges_solved_one_by_one(curvatures, is_even, angles, rtol):
    table, end = (
        BridgeTable(curvatures, 1e-3, is_even=is_even),
        float(stability_limit(1.0, *angles, *curvatures).gap),
    )
    for part in (0.01, 0.3, 0.7):
        expected = float(bridge(part * end, 1.0, *angles, *curvatures).force)
        assert table.force(part * end, *angles) == pytest.approx(expected, rel=rtol)
        assert table.surely_spans(part * end, *angles) or part > 0.5
    assert table.end(*angles) == end
    assert not table.surely_spans(end, *angles)
