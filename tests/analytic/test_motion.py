"""The motion of a pulled mass: reference cases, balances, closed forms, the order of the step."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import example, given
from hypothesis import strategies as st
from scipy.integrate import quad, solve_ivp

import contactkit as ck
from contactkit.lubrication import squeeze_film as squeeze
from contactkit.numerics.roots import bracketed_root
from contactkit.separation.integrator.dense_output import highest, travel_integral
from contactkit.separation.integrator.radau import NODES, WEIGHTS, Stage, slopes, step
from contactkit.separation.motion.state import start

# The reference cases are outside the range of their models, and say so.
pytestmark = pytest.mark.filterwarnings("ignore::contactkit.errors.ValidityWarning")


def approx(value, rel):
    return pytest.approx(value, rel=rel, abs=0.0)


def run(scene, rtol=1e-8):
    return ck.simulate(ck.plan(scene, ck.Accuracy(time_rtol=rtol)))


# Reference cases ----------------------------------------------------------------------------

READ = {
    "t_rel": lambda state: state.release_time,
    "v_rel": lambda state: state.release_speed,
    "peak": lambda state: state.peak_force,
    "J": lambda state: state.viscous_impulse,
    "Jm": lambda state: state.meniscus_impulse,
    "W": lambda state: state.dissipated_work,
}


@pytest.mark.parametrize("name", ["A", "B", "D", "E"])
def test_the_release_is_that_of_the_reference(release_cases, release_scene, name):
    """The references of A, B and D agree among three codes to 1e-9, those of E to 3e-8."""
    result = run(release_scene(name))
    assert result.status == "released"
    found = {key: read(result.state) for key, read in READ.items()}
    wanted = {key: release_cases[name]["values"][key] for key in READ}
    assert found == approx(wanted, 1e-5 if name == "E" else 1e-6)


@pytest.mark.parametrize("name", ["A", "E"])
def test_the_peak_comes_when_the_reference_has_it(release_cases, release_scene, name):
    """Where a peak is, is known to the root of how high it is; in B and D it is flat."""
    when = release_cases[name]["values"]["t_peak"]
    assert run(release_scene(name)).state.peak_time == approx(when, 1e-4)


@pytest.mark.parametrize("name", ["A", "B", "D", "E"])
def test_a_tighter_tolerance_brings_the_release_nearer(release_cases, release_scene, name):
    exact = run(release_scene(name), 1e-11).state.release_time
    errors = [
        abs(run(release_scene(name), rtol).state.release_time / exact - 1.0)
        for rtol in (1e-4, 1e-7)
    ]
    assert errors[0] < 1e-3
    assert errors[1] < 1e-6
    assert errors[1] < errors[0] / 10.0


@pytest.mark.parametrize(
    ("tension", "release"),
    [(50e5, 12.49e-3), (20e5, 8.128e-3), (10e5, 0.80760e-3), (3e5, 0.51423e-3), (1e5, 0.47204e-3)],
)
def test_the_tension_of_the_oil_decides_the_release(release_scene, tension, release):
    scene = release_scene("B", ck.TensionLimit(tension=tension))
    digits = 5e-4 if tension >= 20e5 else 2e-5  # as printed
    assert run(scene).state.release_time == approx(release, digits)


@pytest.mark.parametrize(("strength", "release"), [(1e4, 1.9016), (3e3, 1.3709), (1e3, 3.19e-4)])
def test_a_weak_liquid_releases_sooner(release_scene, strength, release):
    scene = release_scene("D", ck.ShearLimit(strength=strength))
    assert run(scene).state.release_time == approx(release, 2e-3 if strength == 1e3 else 5e-5)


# Balances -----------------------------------------------------------------------------------


@pytest.mark.parametrize("name", ["A", "D"])
def test_the_work_of_the_pull_is_accounted_for(release_cases, release_scene, name):
    """F dh = m v^2/2 + k dh^2/2 + what the film dissipates + the work against the meniscus."""
    case = release_cases[name]["case"]
    scene = release_scene(name)
    made = ck.plan(scene)
    state = ck.simulate(made).state
    travel = case["h_rel"] - case["h0"]
    meniscus, _ = quad(
        lambda x: math.exp(x) * made.film.static_force(math.exp(x)),
        math.log(case["h0"]),
        math.log(case["h_rel"]),
        epsrel=1e-12,
        epsabs=0.0,
    )
    stored = 0.5 * case["m"] * state.release_speed**2 + 0.5 * case["k_s"] * travel**2
    # Steps are taken to 1e-8 in the gap, of which each loses that share of its own work.
    assert stored + state.dissipated_work + meniscus == approx(case["F0"] * travel, 1e-8)


@pytest.mark.parametrize("name", ["A", "B", "D", "E"])
def test_the_impulse_of_the_pull_is_accounted_for(release_cases, release_scene, name):
    """Without a spring: the impulse of the pull is m v + that of the film + of the meniscus."""
    case = release_cases[name]["case"]
    state = run(release_scene(name, stiffness=0.0)).state
    time, rise = state.release_time, case["tau"]
    given_impulse = case["F0"] * (time + (rise * math.expm1(-time / rise) if rise else 0.0))
    taken = case["m"] * state.release_speed + state.viscous_impulse + state.meniscus_impulse
    assert taken == approx(given_impulse, 1e-7)


@pytest.mark.parametrize("name", ["A", "B", "D"])
def test_the_viscous_impulse_does_not_depend_on_the_path(release_scene, name):
    """It is a potential of the gap, known in closed form, whatever the motion was."""
    result = run(release_scene(name))
    film = result.of(ck.ViscousForce)
    assert film.impulse == approx(film.newtonian_impulse, 1e-9)


def test_a_limit_takes_from_the_impulse(release_scene):
    film = run(release_scene("E")).of(ck.ViscousForce)
    assert film.impulse < 0.05 * film.newtonian_impulse


def test_a_film_alone_slows_a_mass_by_its_impulse(release_scene):
    """No pull, no spring: m dv = -c(h) dh, so that the speed is a closed form of the gap."""
    mass, speed = 0.02, 5.0
    scene = release_scene(
        "A", effects=[ck.ViscousForce()], force=0.0, stiffness=0.0, initial_speed=speed
    )
    result = run(scene)
    impulse = squeeze.disc_impulse_flooded(3.175e-3, 20e-6, 100e-6, 0.01)
    slower = speed - impulse / mass
    assert result.state.release_speed == approx(slower, 1e-8)
    lost = 0.5 * mass * (speed**2 - slower**2)
    assert result.state.dissipated_work == approx(lost, 1e-7)


def test_a_mass_that_the_film_stops_stays_where_its_momentum_is_spent(release_scene):
    """m v0 = Phi(h) - Phi(h0) gives the gap at which it stops, for good."""
    mass, speed, start_gap, face, oil = 0.02, 0.1, 20e-6, 3.175e-3, 0.01
    scene = release_scene(
        "A",
        effects=[ck.ViscousForce()],
        force=0.0,
        stiffness=0.0,
        initial_speed=speed,
        time_limit=10.0,
    )
    result = run(scene)
    assert result.status == "time limit"
    assert squeeze.disc_impulse_flooded(face, start_gap, result.state.gap, oil) == approx(
        mass * speed, 1e-7
    )


# Closed forms without a film ----------------------------------------------------------------


def flight(scene, pull, time, **changes):
    """State after a time of a mass whose film is broken."""
    made = ck.plan(scene, ck.Accuracy(time_rtol=1e-10))
    state = start(made)._replace(broken=True, **changes)
    return ck.advance(made, state, pull, time)


def test_a_free_mass_flies_on_a_parabola(release_scene):
    scene = release_scene("A", stiffness=0.0, final_gap=1.0)
    state = flight(scene, ck.Pull(3.0), 0.05, speed=0.7)
    assert state.gap == approx(20e-6 + 0.7 * 0.05 + 0.5 * 3.0 / 0.02 * 0.05**2, 1e-12)
    assert state.speed == approx(0.7 + 3.0 / 0.02 * 0.05, 1e-12)


def test_a_pull_that_grows_moves_a_free_mass_on_a_cubic(release_scene):
    scene = release_scene("A", stiffness=0.0, final_gap=1.0)
    state = flight(scene, ck.Pull(0.0, rate=100.0), 0.05)
    assert state.gap == approx(20e-6 + 100.0 / 0.02 * 0.05**3 / 6.0, 1e-12)


def test_a_mass_on_its_spring_swings(release_scene):
    """h0 + F/k (1 - cos wt): a collocation method follows it to its tolerance."""
    scene = release_scene("A", final_gap=1.0)
    swing = math.sqrt(5000.0 / 0.02)
    for turns in (0.3, 1.0, 5.2):
        time = turns * 2.0 * math.pi / swing
        state = flight(scene, ck.Pull(40.0), time)
        # 1e-10 for each of some 100 steps per turn, relative to the gap.
        assert state.gap == approx(20e-6 + 8e-3 * (1.0 - math.cos(swing * time)), 1e-7)


def test_release_is_found_where_a_parabola_crosses_the_gap(release_scene):
    scene = release_scene("A", stiffness=0.0)
    made = ck.plan(scene)
    state = start(made)._replace(broken=True)
    state = ck.advance(made, state, ck.Pull(40.0), 1.0)
    time = math.sqrt(2.0 * 80e-6 * 0.02 / 40.0)
    assert state.release_time == approx(time, 1e-10)
    assert state.release_speed == approx(40.0 / 0.02 * time, 1e-10)


# Another code -------------------------------------------------------------------------------


@pytest.mark.parametrize("name", ["A", "E"])
def test_scipy_finds_the_same_motion(release_cases, release_scene, name):
    """Radau of scipy on ln h and v, with the forces of the plan: another step, another unknown."""
    case = release_cases[name]["case"]
    made = ck.plan(release_scene(name))
    rise = case["tau"]

    def slope(time, y):
        gap, speed = math.exp(y[0]), y[1]
        pull = case["F0"] * (-math.expm1(-time / rise) if rise else 1.0)
        net = pull - case["k_s"] * (gap - case["h0"]) - made.film.force(gap, speed)
        return [speed / gap, net / case["m"]]

    def released(time, y):
        return y[0] - math.log(case["h_rel"])

    released.terminal = True
    found = solve_ivp(
        slope,
        (0.0, 1.0),
        [math.log(case["h0"]), 0.0],
        "Radau",
        events=released,
        rtol=1e-9,
        atol=1e-11,
    )
    result = ck.simulate(made)
    assert result.state.release_time == approx(found.t_events[0][0], 1e-6)
    assert result.state.release_speed == approx(found.y_events[0][0][1], 1e-6)


# The step -----------------------------------------------------------------------------------

MASS = 0.02


def film_net(_time, gap, speed):
    """A thick film and a spring: m/c is a tenth of the time in which the gap doubles."""
    held = squeeze.disc_force(3.175e-3, gap, speed, 0.002)
    return 40.0 - 5000.0 * (gap - 20e-6) - held


def take(net, mass, begin, dt, exponent, rtol, scale):
    """One step; `scale` is a speed [m/s] that matters to the net force."""
    return step(net, mass, begin, dt, exponent, rtol, slopes(net, *begin, scale), scale)


def take_film(begin, dt, exponent, rtol=1e-14):
    return take(film_net, MASS, begin, dt, exponent, rtol, 40.0 / 119.7)


def fixed_steps(exponent, count, time=2e-4):
    point = Stage(0.0, 20e-6, 0.0)
    for _ in range(count):
        point = take_film(point, time / count, exponent, 1e-15).stages[2]
    return point


@pytest.mark.parametrize("exponent", [-1.0, 0.0, 2.0])
def test_the_step_has_its_fifth_order(exponent):
    """Radau IIA with three stages; the coordinate only changes the constant."""
    exact = fixed_steps(2.0, 400)
    counts = np.array([6, 9, 13, 19, 28])
    ends = [fixed_steps(exponent, count) for count in counts]
    for errors in (
        [abs(end.gap / exact.gap - 1.0) for end in ends],
        [abs(end.speed / exact.speed - 1.0) for end in ends],
    ):
        assert -np.polyfit(np.log(counts), np.log(errors), 1)[0] == pytest.approx(5.0, abs=0.4)


@pytest.mark.parametrize("exponent", [-1.0, -0.5, 0.0, 1.0, 2.0, 4.0])
def test_the_coordinate_does_not_change_where_a_step_leads(exponent):
    exact, other = fixed_steps(2.0, 400), fixed_steps(exponent, 120)
    assert other.gap == approx(exact.gap, 1e-9)
    assert other.speed == approx(exact.speed, 1e-9)


def test_the_error_a_step_estimates_is_not_below_the_one_it_makes():
    """The estimate is of fourth order, the step of fifth: it may exceed, not fall short."""
    for dt in (1e-5, 2e-5, 4e-5):
        begin = Stage(0.0, 20e-6, 0.0)
        one = take_film(begin, dt, 2.0)
        exact = fixed_steps(2.0, 100, dt)
        assert one.gap_error >= abs(one.stages[2].gap / exact.gap - 1.0)
        assert one.speed_error >= abs(one.stages[2].speed - exact.speed)


@pytest.mark.parametrize("stiffness", [1e3, 1e8, 1e15])
def test_a_step_over_a_transient_lands_on_the_slow_motion(stiffness):
    """L-stability: m v' = F - c v with m/c far below the step ends at v = F/c."""

    def net(_time, _gap, speed):
        return 1.0 - stiffness * speed

    taken = take(net, 1e-3, Stage(0.0, 1.0, 0.0), 1.0, -1.0, 1e-10, 1.0 / stiffness)
    end = taken.stages[2]
    assert end.speed == approx(1.0 / stiffness, 1e-5)


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
    begin = Stage(0.0, 20e-6, 0.0)
    # A polynomial in the gap; in the impulse six nodes span what is no polynomial.
    for exponent, rtol in ((-1.0, 1e-12), (2.0, 1e-6)):
        taken = take_film(begin, 1e-4, exponent)
        travel = taken.stages[2].gap - begin.gap
        assert travel > 0.4 * begin.gap
        assert travel_integral(begin, taken, 7.0, [7.0] * 3) == approx(7.0 * travel, rtol)


@given(
    a=st.floats(-1.0, 1.0), b=st.floats(-1.0, 1.0), c=st.floats(-1.0, 1.0), d=st.floats(-1.0, 1.0)
)
@example(a=0.0, b=0.4375, c=-0.875, d=0.4375)
def test_the_highest_value_is_at_least_what_was_seen(a, b, c, d):
    """But where it springs up as the step begins and stays there, it is that of the end."""

    def cubic(x):
        return a + x * (b + x * (c + x * d))

    seen = [cubic(x) for x in NODES]
    value, where = highest(a, seen)
    springs = seen[0] - a > 0.9 * (max(a, *seen) - min(a, *seen))
    stays = 2.0 * (seen[2] - a) > seen[0] - a
    assert value == seen[2] if springs and stays else value >= max(a, *seen)
    assert 0.0 <= where <= 1.0
    assert value == pytest.approx(cubic(where), abs=1e-12)


# The root finder under all of them ----------------------------------------------------------


@pytest.mark.parametrize(
    ("function", "low", "high", "root"),
    [
        (lambda x: x**3 - 2.0, 0.0, 2.0, 2.0 ** (1.0 / 3.0)),
        (lambda x: math.exp(50.0 * x) - 2.0, -1.0, 1.0, math.log(2.0) / 50.0),
        (lambda x: math.atan(1e6 * (x - 0.3)), -1.0, 1.0, 0.3),
        (lambda x: (x - 0.1) ** 9, -1.0, 1.0, 0.1),
        (lambda x: x - 1e-200, 0.0, 1.0, 1e-200),
    ],
)
def test_a_bracketed_root_is_found_however_bent_the_function(function, low, high, root):
    calls = []

    def counted(x):
        calls.append(x)
        return function(x)

    # The ninth power is below the smallest float within 1e-36 of its root.
    assert bracketed_root(counted, low, high) == pytest.approx(root, rel=1e-14, abs=0.0)
    assert all(low <= x <= high for x in calls)


def test_a_root_at_an_end_of_its_bracket_is_taken():
    assert bracketed_root(lambda x: x, 0.0, 1.0) == 0.0
    assert bracketed_root(lambda x: x - 1.0, 0.0, 1.0) == 1.0
