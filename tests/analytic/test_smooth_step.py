"""The step that asks for the forces once: against closed forms, and against the full step."""

from __future__ import annotations

import math
import random

import pytest

import contactkit as ck
from contactkit.capillary.flats.force_law import flat_law
from contactkit.separation.integrator.radau import Stage, step
from contactkit.separation.integrator.radau_smooth import smooth_step
from contactkit.separation.motion import advance as motion
from contactkit.separation.motion.advance import advance
from contactkit.separation.motion.state import MotionState, start

pytestmark = pytest.mark.filterwarnings("ignore::contactkit.ValidityWarning")

TIGHT = 1e-11


def film(drag, exponent, static=0.0, *, gap=1.0, power=2.0, low=0.0, high=math.inf):
    """A film whose forces are powers of the gap."""

    def at(h):
        f = static * (gap / h) ** power
        slopes = -power * f, power * (power + 1.0) * f
        return h, f, *slopes, drag * (gap / h) ** exponent, exponent, low, high

    return at


@pytest.mark.parametrize("share", [1e-9, 1e-6, 1e-4, 5e-3])
@pytest.mark.parametrize("exponent", [3.0, 5.0])
def test_a_film_without_a_mass_obeys_its_impulse(exponent, share):
    """Of a film that carries the whole pull, the impulse is a potential of the gap."""
    gap, drag, pull = 1e-6, 1e6, 40.0
    n = exponent - 1.0
    dt = share * gap * drag / pull
    at = film(drag, exponent, gap=gap)
    found = smooth_step(1e-12, at(gap), pull / drag, dt, (pull, 0.0, 0.0, 0.0), at, (TIGHT, 0.0))
    assert found is not None
    end = gap * (1.0 - n * pull * dt / (drag * gap)) ** (-1.0 / n)
    assert found[0] / gap - 1.0 == pytest.approx(end / gap - 1.0, rel=1e-9, abs=1e-15)
    assert found[3] == pytest.approx((pull, pull, pull), rel=1e-9)
    assert found[4] == pytest.approx(pull * (end - gap), rel=1e-9)  # nothing else takes work


@pytest.mark.parametrize("angle", [1e-6, 1e-3, 0.03])
def test_a_mass_on_a_spring_swings(angle):
    mass, spring, gap, speed = 0.02, 5e3, 1e-3, 0.4
    rate = math.sqrt(spring / mass)
    found = smooth_step(
        mass,
        film(0.0, 0.0)(gap),
        speed,
        angle / rate,
        (3.0, 0.0, spring, 0.5e-3),
        film(0.0, 0.0),
        (TIGHT, 0.0),
    )
    assert found is not None
    middle = 0.5e-3 + 3.0 / spring
    offset, sine, cosine = gap - middle, math.sin(angle), math.cos(angle)
    expected = middle + offset * cosine + speed / rate * sine
    assert found[0] == pytest.approx(expected, rel=1e-13 + angle**6)
    assert found[1] == pytest.approx(speed * cosine - rate * offset * sine, rel=1e-13 + angle**6)


def test_it_is_the_full_step():
    """From rest, in balance and out of it, mass or film ruling, forces that hold or push."""
    rng, taken = random.Random(5), 0
    for _ in range(300):
        gap, n = 10.0 ** rng.uniform(-8, -4), rng.choice([3.0, 5.0])
        mass = 10.0 ** rng.uniform(-4, 0)
        drag, pull = mass * 10.0 ** rng.uniform(0, 12), 40.0 * 10.0 ** rng.uniform(-1, 1)
        static, spring = pull * rng.uniform(-1, 1) * rng.choice([0.01, 1]), rng.choice([0.0, 1e5])
        balance = (pull - static) / drag
        speed = balance * rng.choice([0.0, 1.0 + 1e-6 * rng.random(), 2.0 * rng.random()])
        dt = 10.0 ** rng.uniform(-8, -2.2) * gap / max(abs(balance), abs(speed))
        rate = rng.choice([0.0, 1e5 * pull * min(1.0, 1e-5 / dt)])
        at = film(drag, n, static, gap=gap)

        def net(t, h, v, at=at, pull=pull, rate=rate, spring=spring, gap=gap):
            _, f, _, _, c, *_ = at(h)
            return pull + rate * t - spring * (h - gap) - f - c * v

        scale = (pull + abs(static)) / drag
        enough = TIGHT, min(1e-6 / dt, scale / gap)
        found = smooth_step(mass, at(gap), speed, dt, (pull, rate, spring, gap), at, enough)
        if found is None:
            continue
        slopes = net(0.0, gap, speed), -spring + (2.0 * static + n * drag * speed) / gap, -drag
        s = n - 1.0 if drag * dt > mass else -1.0
        whole = step(net, mass, Stage(0.0, gap, speed), dt, s, 1e-12, slopes, scale)
        assert whole is not None
        end = whole.stages[2]
        assert found[0] == pytest.approx(end.gap, rel=1e-10)
        assert found[1] == pytest.approx(end.speed, rel=1e-10, abs=1e-10 * scale)
        for f, w, point in zip(found[2], found[3], whole.stages, strict=True):
            _, there, _, _, c, *_ = at(point.gap)
            assert (f, w) == pytest.approx((there, c * point.speed), rel=0.0, abs=1e-9 * pull)
        assert found[5] == pytest.approx(whole.gap_error, rel=0.05, abs=1e-13)
        assert found[6] == pytest.approx(whole.speed_error, rel=0.05, abs=1e-11 * scale + 1e-13)
        taken += 1
    assert taken > 250


def test_it_stops_at_kinks_and_where_too_much_changes():
    gap, drag = 1e-6, 1e6
    pull, dt = (40.0, 0.0, 0.0, 0.0), 1e-5

    def go(at, speed=4e-5, pull=pull, dt=dt):
        return smooth_step(0.02, at(gap), speed, dt, pull, at, (TIGHT, 0.0))

    grown = 4e-4
    assert go(film(drag, 5.0, gap=gap)) is not None
    assert go(film(drag, 5.0, gap=gap, high=gap * (1.0 + 0.5 * grown))) is None
    assert go(film(drag, 5.0, gap=gap, low=gap, high=gap * 2.0)) is not None
    assert go(film(drag, 5.0, gap=gap, low=gap), -4e-5, (-40.0, 0.0, 0.0, 0.0)) is None
    assert go(film(drag, 5.0, gap=gap), dt=1e-3) is None
    assert go(lambda h: film(drag, 5.0, gap=gap)(h) if h == gap else None) is None
    # A force of which the first terms of a series say nothing, as next to the end of a bridge.
    assert go(film(drag, 5.0, 10.0, gap=gap, power=3e3)) is None


@pytest.mark.parametrize("pinned", [False, True])
@pytest.mark.parametrize("angles", [(0.2, 0.2), (0.3, 1.2), (math.pi / 2, math.pi / 2)])
def test_the_series_of_a_bridge_are_its_slopes(angles, pinned):
    law, size, tension = flat_law(*angles, pinned=pinned), 1e-3, 0.03
    series = law.series(size, tension)
    for share in (1e-3, 0.1, 0.5, 0.97):
        gap, d = share * law.end * size, 1e-4
        found = series(gap)
        assert found is not None
        low, here, high = (
            tension * (size * law.force(x * gap / size)) for x in (1.0 - d, 1.0, 1.0 + d)
        )
        assert found[0] == pytest.approx(here, rel=1e-15)
        assert found[1] == pytest.approx((high - low) / (2.0 * d), rel=1e-4, abs=1e-9 * here)
        assert found[2] == pytest.approx(
            (high - 2.0 * here + low) / d**2, rel=1e-3, abs=1e-6 * here
        )


def scene(effects=(), **changes):
    given = {"volume": 1.58e-10, "speed": 0.0, "rest": 0.0, "stiffness": 5e3} | changes
    oil = ck.Liquid(name="oil", viscosity=0.1, surface_tension=0.03)
    face = ck.Flat(radius=3.175e-3)
    meniscus = ck.Meniscus(
        liquid=oil, volume=given["volume"], contact_angle_lower=0.2, contact_angle_upper=0.2
    )
    opening = ck.Opening(
        initial_gap=5e-6,
        final_gap=1e-4,
        force=40.0,
        mass=0.02,
        stiffness=given["stiffness"],
        initial_speed=given["speed"],
        rest_gap=given["rest"],
    )
    return ck.plan(
        ck.SeparationScene(
            interface=ck.Interface(lower=face, upper=face, meniscus=meniscus),
            opening=opening,
            effects=(ck.ViscousForce(), *effects),
        )
    )


EXACT = (ck.MeniscusForce(),)
RUNS = {
    "bridge": (scene(EXACT), 40.0, 4e-4),
    "arc": (scene((ck.MeniscusForce(profile="arc"),)), 40.0, 4e-4),
    "as published": (scene((ck.MeniscusForce(profile="as-published"),)), 40.0, 4e-4),
    "flooded": (scene(EXACT, volume=None), 40.0, 4e-4),
    "pulled together": (scene(EXACT, speed=1e-3), -20.0, 4e-4),
    "no meniscus": (scene(), 40.0, 4e-4),
    "tension": (scene((*EXACT, ck.TensionLimit(tension=1e6))), 40.0, 4e-4),
    "tension and shear": (
        scene((*EXACT, ck.TensionLimit(tension=3e6), ck.ShearLimit(strength=2e4))),
        40.0,
        4e-4,
    ),
    "breaks and flies": (
        scene((*EXACT, ck.Rupture(gap=5.2e-6), ck.TensionLimit(tension=1e4))),
        40.0,
        2e-4,
    ),
}


@pytest.mark.parametrize("name", RUNS)
@pytest.mark.parametrize("length", [1e-7, 1e-6])
def test_a_master_gets_the_same_motion_either_way(monkeypatch, name, length):
    """Against the steps that ask for all forces, and, in long ones, of the same plan."""
    made, force, warm = RUNS[name]
    pull = ck.Pull(force)
    begin = advance(made, start(made), pull, warm)
    state = other = begin
    for _ in range(60):
        state = advance(made, state, pull, length)
    monkeypatch.setattr(motion, "smooth_once", lambda *_: None)
    for _ in range(60):
        other = advance(made, other, pull, length)
    for field in ("gap", "speed", "viscous_impulse", "meniscus_impulse", "dissipated_work"):
        rel = 1e-9 if field in ("gap", "speed") else 1e-8
        assert getattr(state, field) == pytest.approx(getattr(other, field), rel=rel), field
    assert state.peak_force == pytest.approx(other.peak_force, rel=1e-9)
    assert (state.broken, state.n_steps) == (other.broken, other.n_steps)
    assert state.n_evaluations - begin.n_evaluations <= other.n_evaluations - begin.n_evaluations
    once = advance(made, begin, pull, 60 * length)
    assert state.gap == pytest.approx(once.gap, rel=1e-7)
    assert state.viscous_impulse == pytest.approx(once.viscous_impulse, rel=1e-7)


def test_next_to_nothing_is_asked_for():
    """Forces once per step of a film, where it creeps; see the bench for the seconds."""
    made, force, warm = RUNS["bridge"]
    pull = ck.Pull(force)
    begin = state = advance(made, start(made), pull, warm)
    for _ in range(50):
        state = advance(made, state, pull, 1e-6)
    assert state.n_steps - begin.n_steps == 50
    assert state.n_evaluations - begin.n_evaluations == 50


def test_what_was_asked_before_makes_no_difference():
    """The film keeps its last answer; a state that is taken back must not see another's."""
    made, force, warm = RUNS["bridge"]
    pull = ck.Pull(force)
    begin = advance(made, start(made), pull, warm)
    first = advance(made, begin, pull, 1e-6)
    for _ in range(5):
        first_again = advance(made, begin, pull, 1e-6)
        advance(made, first_again, pull, 3e-6)
        assert first_again == first
    fresh = ck.plan(made.scene)
    assert advance(fresh, begin, pull, 1e-6) == first
    assert isinstance(first, MotionState)


@pytest.mark.parametrize("pull", [ck.Pull(39.0), ck.Pull(41.0), ck.Pull(40.0, rate=1e6)])
def test_a_pull_that_jumps_or_ramps_keeps_the_balance_of_work(pull):
    """What the pull does goes into film, meniscus, spring and mass."""
    made, _, warm = RUNS["no meniscus"]
    begin = state = advance(made, start(made), ck.Pull(40.0), warm)
    given, n, dt = 0.0, 200, 1e-6
    mass, stiffness, rest = 0.02, 5e3, 5e-6
    for i in range(n):
        line = ck.Pull(pull.force + (i % 2), pull.rate, state.time)
        after = advance(made, state, line, dt)
        given += (line.force + 0.5 * line.rate * dt) * (after.gap - state.gap)
        state = after
    stored = 0.5 * mass * (state.speed**2 - begin.speed**2)
    stored += 0.5 * stiffness * ((state.gap - rest) ** 2 - (begin.gap - rest) ** 2)
    lost = state.dissipated_work - begin.dissipated_work
    assert given == pytest.approx(stored + lost, rel=2e-4)
