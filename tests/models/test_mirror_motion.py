"""Mirror and tips: energy, momentum, and the coupling against a monolithic model."""

from __future__ import annotations

import math

import numpy as np
import pytest
from attrs import evolve
from scipy.integrate import solve_ivp

from contactkit.app.scenes import open_scene
from contactkit.models.micromirror.coupling import couple
from contactkit.models.micromirror.electrostatics import capacitance
from contactkit.models.micromirror.flight import Flight, Root, landing_time
from contactkit.models.micromirror.mirror import acceleration, electrode_volts, root_height
from contactkit.models.micromirror.monolithic import simulate_monolithic
from contactkit.models.micromirror.tip import advance_tip, free_start, landed_start, tip_force
from contactkit.models.micromirror.tip_film import separation_energy, tip_law

PULSE = 34.0


@pytest.fixture(scope="module")
def scene():
    return open_scene("micromirror").scene


@pytest.fixture(scope="module")
def wet(scene):
    return tip_law(scene.tip, 0.5, 1e-8)


@pytest.fixture(scope="module")
def dry(scene):
    return tip_law(scene.tip, 0.0, 1e-9)


def lossless(scene):
    """The mirror released by 0 V, and nothing that damps it."""
    mirror = scene.first_flip(None)
    wave = evolve(mirror.waveform, address_voltage=0.0)
    hinge, tips = evolve(mirror.hinge, damping=0.0), evolve(mirror.tips, damping=0.0)
    return evolve(mirror, waveform=wave, hinge=hinge, tips=tips)


# One tip ------------------------------------------------------------------------------------


def stored(made, state, height):
    """Kinetic and elastic energy of a tip [J]."""
    loading = made.scene.loading
    bend = loading.initial_gap + height - state.gap
    return 0.5 * (loading.mass * state.motion.speed**2 + loading.stiffness * bend**2)


@pytest.mark.parametrize("law", ["wet", "dry"])
def test_work_on_the_root_is_stored_or_dissipated(law, request):
    """A root that rises steadily: the impulse times its speed is all the work there is."""
    made, speed, span = request.getfixturevalue(law), 0.2, 6e-7
    state, height = landed_start(made), -1e-8
    before = stored(made, state, height)
    state = advance_tip(made, 0.0, state, Root(height, speed), span)
    assert state.free
    left = stored(made, state, height + speed * span)
    used = separation_energy(made) + state.motion.dissipated_work
    assert speed * state.impulse == pytest.approx(left - before + used, rel=2e-5)
    assert used > 1e-3 * left


def test_momentum_of_a_flight(wet):
    """Once free, the root gives what the tip gains; damping included."""
    state = free_start(wet, 2e-7, 0.3)
    later = advance_tip(wet, 1e-9, state, Root(2e-7, 0.1, 1e6), 3e-7)
    gained = wet.scene.loading.mass * (later.motion.speed - 0.3)
    assert later.impulse - state.impulse == pytest.approx(gained, rel=1e-12)


@pytest.mark.parametrize("damping", [0.0, 1e-9])
def test_a_flight_is_what_an_integrator_gives(wet, damping):
    loading = wet.scene.loading
    root = Root(3e-7, -0.5, 2e5)

    def rates(time, y):
        moving = root.speed + root.acceleration * time
        force = loading.stiffness * (loading.initial_gap + root.height_at(time) - y[0])
        return [y[1], (force + damping * (moving - y[1])) / loading.mass]

    def lands(time, y):
        return y[0] - loading.initial_gap

    lands.terminal, lands.direction = True, -1
    start = loading.initial_gap + root.height + 5e-8
    found = solve_ivp(
        rates, (0.0, 1e-6), [start, 0.2], method="DOP853", events=lands, rtol=1e-12, atol=1e-18
    )
    state = free_start(wet, 5e-8 + root.height, 0.2)
    state = advance_tip(wet, damping, state, root, 1.001 * found.t[-1])
    assert found.status == 1
    assert state.landing_time == pytest.approx(found.t[-1], rel=1e-9)
    assert state.motion.in_contact
    speed = found.y[1, -1]
    assert state.landing_loss == pytest.approx(0.5 * loading.mass * speed**2, rel=1e-7)


def test_a_swing_that_dips_between_two_looks_is_seen():
    """A tip that touches at the bottom of its swing only."""
    flight = Flight(rest=0.0, decay=0.0, frequency=1e8, cosine=1e-8, sine=0.0)
    assert landing_time(flight, Root(1.0001e-8), 1e-6) is None
    touch = landing_time(flight, Root(0.99999e-8), 1e-6)
    assert touch == pytest.approx(math.acos(-0.99999) / 1e8, rel=1e-9)


@pytest.mark.parametrize("seed", range(4))
def test_a_landing_is_the_first_of_a_dense_look(seed):
    """Random swings, most of them long out of reach of the site, against 256 looks a swing."""
    rng, landed = np.random.default_rng(seed), 0
    for _ in range(60):
        pace, size, swings = 10 ** rng.uniform(5, 8), 10 ** rng.uniform(-9, -6), rng.uniform(1, 80)
        decay = pace * rng.choice([0.0, 10 ** rng.uniform(-5, -1)])
        cosine, sine, rest = size * rng.uniform(-1.0, 1.0, 3)
        span = 2.0 * math.pi * swings / pace
        height = max(0.0, -cosine - rest) + size * 10 ** rng.uniform(-2, 1)
        speed = rng.choice([-1.0, 0.0, 1.0]) * size / span * 10 ** rng.uniform(-1, 1)
        push = rng.choice([-1.0, 0.0, 1.0]) * size / span**2 * 10 ** rng.uniform(-1, 1.5)
        time = np.linspace(0.0, span, math.ceil(256 * swings))
        swing = cosine * np.cos(pace * time) + sine * np.sin(pace * time)
        over = height + speed * time + 0.5 * push * time**2 + rest + np.exp(-decay * time) * swing
        if np.abs(over).min() < 1e-3 * size and (over > 0.0).all():
            continue  # a look may miss how it touches
        found = landing_time(
            Flight(rest, decay, pace, cosine, sine), Root(height, speed, push), span
        )
        below = np.flatnonzero(over <= 0.0)
        assert (found is None) == (len(below) == 0)
        if found is not None:
            landed += 1
            assert time[below[0] - 1] <= found <= time[below[0]]
    assert 10 < landed < 55


def test_a_long_flight_out_of_reach_costs_few_evaluations():
    """62 000 swings in Python took seconds, look by look."""
    looks = []

    class Seen(Flight):
        def at(self, time):
            looks.append(time)
            return super().at(time)

    span = 62_000 * 2.0 * math.pi / 1e8
    high = Seen(rest=0.0, decay=10.0, frequency=1e8, cosine=1e-8, sine=0.0)
    assert landing_time(high, Root(1e-6, 2e-6 / span, -4e-6 / span**2), span) is None
    comes_down = landing_time(high, Root(1e-6, 0.0, -2.2e-6 / span**2), span)
    assert 0.9 * span < comes_down < span
    assert len(looks) < 1000


def test_the_division_of_time_does_not_matter(wet):
    root = Root(-2e-8, 0.05, 1e6)
    whole = advance_tip(wet, 2e-10, landed_start(wet), root, 6e-7)
    parts = landed_start(wet)
    for i in range(60):
        parts = advance_tip(wet, 2e-10, parts, root.after(i * 1e-8), 1e-8)
    assert whole.free_time > 0.0
    assert parts.free_time == pytest.approx(whole.free_time, rel=1e-8)
    assert parts.gap == pytest.approx(whole.gap, rel=1e-5)
    assert parts.impulse == pytest.approx(whole.impulse, rel=1e-6)


def test_a_landed_tip_passes_on_the_force_of_its_spring(wet):
    state = advance_tip(wet, 0.0, landed_start(wet), Root(-5e-8, 0.01), 1e-6)
    assert state.motion.in_contact
    assert state.impulse == pytest.approx(1.0 * (-5e-8 + 0.5 * 1e-8) * 1e-6, rel=1e-12)
    assert tip_force(wet, 0.0, state, -4e-8, 0.01) == pytest.approx(-4e-8, rel=1e-12)


# Mirror and tips ----------------------------------------------------------------------------


def test_without_losses_energy_stays(scene, wet):
    """What bent tips and hinge stored is motion, or was dissipated by the menisci."""
    mirror, loading, n = lossless(scene), scene.loading, scene.mirror.tips.per_side
    tips, tilt = evolve(scene, mirror=mirror).tips(wet), scene.start[0]

    def energy(tilt, rate):
        hinge = mirror.hinge
        total = 0.5 * (hinge.inertia * rate**2 + hinge.stiffness * tilt**2)
        for tip, side in zip(tips, (1.0, -1.0), strict=True):
            total += n * stored(wet, tip.state, root_height(mirror.tips, tilt, side))
        return total

    before = energy(tilt, 0.0)
    found = couple(mirror, tips, loading.stiffness, scene.start, 1.5e-6, 5e-9)
    state = tips[0].state
    assert state.free
    used = n * (separation_energy(wet) + state.motion.dissipated_work)
    after = energy(found["tilt"][-1], found["rate"][-1])
    # 2.5e-5 by the exchange every 5 ns; both tips without damping, as the hinge.
    assert after + used == pytest.approx(before, rel=1e-4)
    assert used > 0.01 * before


def test_with_voltage_and_damping_it_balances_too(scene, dry):
    """Work of the voltages by the capacitances, loss in the hinge by quadrature; on its tips."""
    mirror = scene.first_flip(PULSE)
    held = evolve(mirror.waveform, reset_time=1e-6)
    mirror = evolve(mirror, waveform=held)
    tips = scene.tips(dry)
    found = couple(mirror, tips, scene.loading.stiffness, scene.start, 3e-7, 2e-9)
    tilt, rate, volts = found["tilt"], found["rate"], electrode_volts(held, 1e-9)
    work = sum(
        0.5
        * v**2
        * (capacitance(mirror.electrode, s * tilt[-1]) - capacitance(mirror.electrode, s * tilt[0]))
        for v, s in zip(volts, (1.0, -1.0), strict=True)
    )
    lost = mirror.hinge.damping * np.trapezoid(rate**2, found["time"])
    n, stiffness = mirror.tips.per_side, scene.loading.stiffness

    def energy(i):
        bend = root_height(mirror.tips, tilt[i], 1.0)
        hinge = mirror.hinge
        moving = 0.5 * hinge.inertia * rate[i] ** 2
        return moving + 0.5 * hinge.stiffness * tilt[i] ** 2 + 0.5 * n * stiffness * bend**2

    # The free tips of the other side swing with their roots: a part in a thousand.
    assert energy(-1) - energy(0) + lost == pytest.approx(work, rel=5e-3)


def test_the_coupling_converges_to_the_monolithic_model(scene, wet):
    """Third order in the communication step, on the way to one method's answer by another's."""
    mirror = scene.first_flip(PULSE)
    whole = simulate_monolithic(mirror, wet, scene.start, 8.4e-7, rtol=1e-10)
    freed, errors = whole.first("is free"), []
    assert whole.first("leaves") < whole.first("breaks") < freed
    for step in (40e-9, 20e-9, 10e-9):
        tips = scene.tips(wet)
        couple(mirror, tips, scene.loading.stiffness, scene.start, 8.4e-7, step)
        errors.append(abs(tips[0].state.free_time / freed - 1.0))
    assert errors[1] < 1e-5
    assert errors[2] < 2e-6
    assert math.log2(errors[0] / errors[2]) / 2.0 > 1.8


def test_the_start_is_at_rest(scene, wet):
    """Forces balance at the start: nothing moves until a voltage changes."""
    mirror, (tilt, rate) = scene.mirror, scene.start
    volts = electrode_volts(mirror.waveform, 0.0)
    force = scene.tips(wet).plus.read(root_height(mirror.tips, tilt, 1.0), 0.0).force
    scale = acceleration(mirror, tilt, rate, volts, 0.0)
    assert abs(acceleration(mirror, tilt, rate, volts, force)) < 1e-9 * scale
    still = couple(mirror, scene.tips(wet), scene.loading.stiffness, scene.start, 1e-6, 5e-8)
    assert np.ptp(still["tilt"]) < 1e-12
