"""The implicit step: order, coordinates, error estimate, closed forms, work and peak."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import example, given
from hypothesis import strategies as st
from selection import quick

import contactkit as ck
from contactkit.lubrication import squeeze_film
from contactkit.numerics.radau_tableau import NODES, WEIGHTS
from contactkit.separation.integrator.dense_output import peak, work
from contactkit.separation.integrator.radau import (
    Forces,
    MotionPoint,
    StepProblem,
    coordinate,
    relative_error,
    step,
)
from contactkit.separation.motion.state import start

pytestmark = pytest.mark.filterwarnings("ignore::contactkit.ValidityWarning")

MASS = 0.02


def approx(value, rel):
    return pytest.approx(value, rel=rel, abs=0.0)


def problem(forces, begin, pull, *, mass=MASS, rtol=1e-12, exponent=0.0, **more):
    """Step of a mass; the scale is the speed at which the film balances the pull."""
    first = forces(begin.gap, begin.speed)
    given = {"stiffness": 0.0, "slack_gap": begin.gap, "delivered": 0.0} | more
    damping = first.viscous_by_speed
    size = abs(pull(begin.time)) + abs(first.static) + 1e-300
    return StepProblem(
        mass=mass,
        pull=pull,
        forces=forces,
        has_limits=False,
        exponent=exponent,
        begin=begin,
        first=first,
        rtol=rtol,
        size=size,
        scale=size / damping if damping > 0.0 else begin.gap * 1e6,
        **given,
    )


def film(damping, exponent, static=0.0, *, gap=1.0, power=2.0):
    """A film whose forces are powers of the gap, with their slopes."""

    def forces(h, v):
        f, c = static * (gap / h) ** power, damping * (gap / h) ** exponent
        return Forces(f, -power * f / h, c * v, -exponent * c * v / h, c)

    return forces


# Order and coordinate -----------------------------------------------------------------------


def thick_film(gap, speed):
    """m/c is a tenth of the time in which the gap doubles."""
    c = squeeze_film.disc_force(3.175e-3, gap, 1.0, 0.002)
    return Forces(0.0, 0.0, c * speed, -3.0 * c * speed / gap, c)


def take(begin, dt, s, rtol=1e-14):
    posed = problem(
        thick_film, begin, lambda time: 40.0, stiffness=5000.0, slack_gap=20e-6, rtol=rtol
    )
    return step(posed, dt, s)


def fixed_steps(s, count, time=2e-4):
    point = MotionPoint(0.0, 20e-6, 0.0)
    for _ in range(count):
        point = take(point, time / count, s, 1e-15).stages[2]
    return point


@pytest.mark.parametrize("s", [-1.0, 0.0, 2.0])
def test_the_step_has_its_fifth_order(s):
    """Radau IIA with three stages; the coordinate only changes the constant."""
    exact = fixed_steps(2.0, 400)
    counts = np.array([6, 9, 13, 19, 28])
    ends = [fixed_steps(s, count) for count in counts]
    for errors in (
        [abs(end.gap / exact.gap - 1.0) for end in ends],
        [abs(end.speed / exact.speed - 1.0) for end in ends],
    ):
        assert -np.polyfit(np.log(counts), np.log(errors), 1)[0] == pytest.approx(5.0, abs=0.4)


@pytest.mark.parametrize("s", [-1.0, -0.5, 0.0, 1.0, 2.0, 4.0])
def test_the_coordinate_does_not_change_where_a_step_leads(s):
    exact, other = fixed_steps(2.0, 400), fixed_steps(s, 120)
    assert other.gap == approx(exact.gap, 1e-9)
    assert other.speed == approx(exact.speed, 1e-9)


def test_the_error_a_step_estimates_is_not_below_the_one_it_makes():
    """The estimate is of fourth order, the step of fifth: it may exceed, not fall short."""
    for dt in (1e-5, 2e-5, 4e-5):
        one = take(MotionPoint(0.0, 20e-6, 0.0), dt, 2.0)
        exact = fixed_steps(2.0, 100, dt)
        assert one.gap_error >= abs(one.stages[2].gap / exact.gap - 1.0)
        assert one.speed_error >= abs(one.stages[2].speed - exact.speed)


@pytest.mark.parametrize("damping", [1e3, 1e8, 1e15])
def test_a_step_over_a_transient_lands_on_the_slow_motion(damping):
    """L-stability: m v' = F - c v with m/c far below the step ends at v = F/c."""
    forces = film(damping, 0.0)
    posed = problem(forces, MotionPoint(0.0, 1.0, 0.0), lambda time: 1.0, mass=1e-3, rtol=1e-10)
    assert step(posed, 1.0, -1.0).stages[2].speed == approx(1.0 / damping, 1e-5)


def test_a_coordinate_too_large_for_a_float_is_no_coordinate():
    """A trial step may ask for any gap; the answer is a smaller step, not an OverflowError."""
    for s, q in ((0.0, 1e4), (1e-3, 999.999), (0.5, math.nextafter(2.0, 0.0) + 1.0)):
        assert coordinate(1e-6, s, q) is None


# Closed forms -------------------------------------------------------------------------------


@pytest.mark.parametrize("change", [1e-9, 1e-6, 1e-4, 5e-3, 0.5])
@pytest.mark.parametrize("exponent", [3.0, 5.0])
def test_a_film_without_a_mass_obeys_its_impulse(exponent, change):
    """Of a film that carries the whole pull, the impulse is a potential of the gap."""
    gap, damping, pull = 1e-6, 1e6, 40.0
    n = exponent - 1.0
    dt = change / n * gap * damping / pull
    begin = MotionPoint(0.0, gap, pull / damping)
    forces = film(damping, exponent, gap=gap)
    posed = problem(forces, begin, lambda time: pull, mass=1e-12, exponent=exponent)
    taken = step(posed, dt)
    travel = gap * math.expm1(-math.log1p(-change) / n)
    assert taken.stages[2].gap - gap == pytest.approx(travel, rel=1e-9, abs=1e-15 * gap)
    assert [f.viscous for f in taken.forces] == approx([pull] * 3, 1e-9)
    done = work(begin, taken, pull, [f.viscous for f in taken.forces])
    assert done == approx(pull * travel, 1e-9 if change < 0.1 else 1e-6)


@pytest.mark.parametrize("angle", [1e-6, 1e-3, 0.03])
def test_a_mass_on_a_spring_swings(angle):
    spring, gap, speed, slack = 5e3, 1e-3, 0.4, 0.5e-3
    rate = math.sqrt(spring / MASS)
    begin = MotionPoint(0.0, gap, speed)
    posed = problem(film(0.0, 0.0), begin, lambda time: 3.0, stiffness=spring, slack_gap=slack)
    end = step(posed, angle / rate).stages[2]
    middle = slack + 3.0 / spring
    offset, sine, cosine = gap - middle, math.sin(angle), math.cos(angle)
    expected = middle + offset * cosine + speed / rate * sine
    assert end.gap == approx(expected, 1e-13 + angle**6)
    assert end.speed == approx(speed * cosine - rate * offset * sine, 1e-13 + angle**6)


@given(
    damping=st.floats(0.0, 12.0),
    static=st.floats(-1.0, 1.0),
    exponent=st.sampled_from([3.0, 5.0]),
    out_of_balance=st.floats(0.0, 2.0),
    reach=st.floats(-8.0, -1.0),
    ramp=st.floats(0.0, 1.0),
)
def test_the_stages_satisfy_their_equations(damping, static, exponent, out_of_balance, reach, ramp):
    """Whichever iteration found them: momentum at the stages is the impulse up to them.

    A step in which the net force grows several times over may not be found; its quarters are.
    """
    gap, pull = 1e-6, 40.0
    c, held = MASS * 10.0**damping, static * pull
    balance = (pull - held) / c
    speed = out_of_balance * balance
    fastest = max(abs(balance), abs(balance + ramp * pull / c), abs(speed), 1e-9)
    dt = whole = 10.0**reach * gap / fastest
    forces = film(c, exponent, held, gap=gap)

    def pulled(time):
        return pull * (1.0 + ramp * time / whole)

    posed = problem(forces, MotionPoint(0.0, gap, speed), pulled, exponent=exponent, rtol=1e-10)
    while (taken := step(posed, dt)) is None:
        dt *= 0.25
        assert dt * fastest > 1e-3 * gap, "a short step is found at once"
    net = [pulled(t) - sum(forces(h, v)[:3:2]) for t, h, v in taken.stages]
    for point, given_there in zip(taken.stages, taken.forces, strict=True):
        there = forces(point.gap, point.speed)
        assert given_there.static == pytest.approx(there.static, abs=1e-8 * pull)
        assert given_there.viscous == pytest.approx(there.viscous, abs=1e-8 * pull)
    end = taken.stages[2]
    delivered = dt * sum(w * f for w, f in zip(WEIGHTS, net, strict=True))
    size = dt * (pull + abs(held)) + MASS * (abs(speed) + abs(end.speed))
    assert MASS * (end.speed - speed) == pytest.approx(delivered, abs=1e-8 * size)
    assert relative_error(posed, taken, dt) >= 0.0


# Quadrature, work and peak ------------------------------------------------------------------


@given(
    coefficients=st.tuples(*[st.floats(-1.0, 1.0)] * 4),
    dt=st.floats(1e-9, 1e3),
)
def test_the_weights_integrate_what_the_nodes_can_see(coefficients, dt):
    """Radau's quadrature is exact to the fourth power."""
    powers = range(1, 5)
    seen = sum(
        w * sum(c * node**p for c, p in zip(coefficients, powers, strict=True))
        for w, node in zip(WEIGHTS, NODES, strict=True)
    )
    exact = sum(c / (p + 1.0) for c, p in zip(coefficients, powers, strict=True))
    assert dt * seen == pytest.approx(dt * exact, abs=1e-14 * dt)


def test_work_along_a_step_is_force_times_travel():
    begin = MotionPoint(0.0, 20e-6, 0.0)
    # A polynomial in the gap; in the impulse six nodes span what is no polynomial.
    for s, rtol in ((-1.0, 1e-12), (2.0, 1e-6)):
        taken = take(begin, 1e-4, s)
        travel = taken.stages[2].gap - begin.gap
        assert travel > 0.4 * begin.gap
        assert work(begin, taken, 7.0, [7.0] * 3) == approx(7.0 * travel, rtol)


@given(
    a=st.floats(-1.0, 1.0), b=st.floats(-1.0, 1.0), c=st.floats(-1.0, 1.0), d=st.floats(-1.0, 1.0)
)
@example(a=0.0, b=0.4375, c=-0.875, d=0.4375)
def test_the_highest_value_is_at_least_what_was_seen(a, b, c, d):
    """But where it springs up as the step begins and stays there, it is that of the end."""

    def cubic(x):
        return a + x * (b + x * (c + x * d))

    seen = [cubic(x) for x in NODES]
    value, where = peak(a, seen)
    springs = seen[0] - a > 0.9 * (max(a, *seen) - min(a, *seen))
    stays = 2.0 * (seen[2] - a) > seen[0] - a
    assert value == seen[2] if springs and stays else value >= max(a, *seen)
    assert 0.0 <= where <= 1.0
    assert value == pytest.approx(cubic(where), abs=1e-12)


# Through the motion -------------------------------------------------------------------------


def scene(effects=(), **changes):
    given = {"volume": 1.58e-10, "speed": 0.0, "rest": 0.0, "stiffness": 5e3} | changes
    oil = ck.Liquid(name="oil", viscosity=0.1, surface_tension=0.03)
    face = ck.Flat(radius=3.175e-3)
    meniscus = ck.Meniscus(
        liquid=oil, volume=given["volume"], contact_angle_lower=0.2, contact_angle_upper=0.2
    )
    loading = ck.ImposedForce(
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
            loading=loading,
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
    "tension": (scene((*EXACT, ck.TensionLimit(strength=1e6, cavity="truncated"))), 40.0, 4e-4),
    "tension and shear": (
        scene(
            (*EXACT, ck.TensionLimit(strength=3e6, cavity="truncated"), ck.ShearLimit(strength=2e4))
        ),
        40.0,
        4e-4,
    ),
    "breaks and flies": (
        scene((*EXACT, ck.Rupture(gap=5.2e-6), ck.TensionLimit(strength=1e4, cavity="truncated"))),
        40.0,
        2e-4,
    ),
}


@pytest.mark.parametrize("name", RUNS)
@pytest.mark.parametrize("length", [1e-7, 1e-6])
def test_short_communication_steps_lead_to_the_same_state_as_one(name, length):
    made, force, warm = RUNS[name]
    pull = ck.Pull(force)
    begin = state = ck.advance(made, start(made), pull, warm)
    for _ in range(60):
        state = ck.advance(made, state, pull, length)
    once = ck.advance(made, begin, pull, 60 * length)
    assert state.gap == pytest.approx(once.gap, rel=1e-7)
    assert state.impulses == pytest.approx(once.impulses, rel=1e-7)
    assert state.peak_force == pytest.approx(once.peak_force, rel=1e-7)
    assert state.broken == once.broken


def test_a_creeping_film_takes_four_evaluations_a_step():
    """At the start, and once at each stage; see the bench for the seconds."""
    made, force, warm = RUNS["bridge"]
    pull = ck.Pull(force)
    begin = state = ck.advance(made, start(made), pull, warm)
    for _ in range(50):
        state = ck.advance(made, state, pull, 1e-6)
    assert state.n_steps - begin.n_steps == 50
    assert state.n_evaluations - begin.n_evaluations == 200


def test_an_earlier_evaluation_makes_no_difference():
    """A state that is rolled back must not see what another one left in the plan."""
    made, force, warm = RUNS["bridge"]
    pull = ck.Pull(force)
    begin = ck.advance(made, start(made), pull, warm)
    first = ck.advance(made, begin, pull, 1e-6)
    for _ in range(5):
        first_again = ck.advance(made, begin, pull, 1e-6)
        ck.advance(made, first_again, pull, 3e-6)
        assert first_again == first
    fresh = ck.plan(made.scene)
    assert ck.advance(fresh, begin, pull, 1e-6) == first


@pytest.mark.parametrize("pull", quick([ck.Pull(39.0), ck.Pull(41.0), ck.Pull(40.0, rate=1e6)], 2))
def test_a_pull_that_jumps_or_ramps_keeps_the_balance_of_work(pull):
    """What the pull does goes into film, meniscus, spring and mass."""
    made, _, warm = RUNS["no meniscus"]
    begin = state = ck.advance(made, start(made), ck.Pull(40.0), warm)
    given, n, dt = 0.0, 100, 2e-6
    mass, stiffness, rest = 0.02, 5e3, 5e-6
    for i in range(n):
        line = ck.Pull(pull.force + (i % 2), pull.rate, state.time)
        after = ck.advance(made, state, line, dt)
        given += (line.force + 0.5 * line.rate * dt) * (after.gap - state.gap)
        state = after
    stored = 0.5 * mass * (state.speed**2 - begin.speed**2)
    stored += 0.5 * stiffness * ((state.gap - rest) ** 2 - (begin.gap - rest) ** 2)
    lost = state.dissipated_work - begin.dissipated_work
    assert given == pytest.approx(stored + lost, rel=2e-4)
