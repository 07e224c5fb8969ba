"""The FMU ``stiction-force``: right forces and impulses, restorable, and honest about coupling."""

from __future__ import annotations

import math
import sys
from itertools import pairwise

import numpy as np
import pytest
from scipy.integrate import quad
from selection import quick

from contactkit.accuracy import Accuracy
from contactkit.fmu.python import build as building
from contactkit.fmu.slaves.film_travel import travel
from contactkit.fmu.slaves.stiction_force import PORTS, Exchange
from contactkit.fmu.slaves.stiction_mass import PORTS as MASS_PORTS
from contactkit.fmu.slaves.stiction_mass import MeniscusLaw, scene_of
from contactkit.separation.effects.base import FilmStatus, LimitKind
from contactkit.separation.plan import plan

OK, DISCARD = 0, 2
RADIUS = 3.175e-3
DISC = math.pi * RADIUS**2


@pytest.fixture(scope="session")
def force_fmu(shelf):
    return shelf(building.build, "stiction-force")


@pytest.fixture
def host(force_fmu, open_fmu):
    return open_fmu(force_fmu)


def film_of(**changes):
    """Film of the plan that the parameters describe."""
    values = {port.name: port.start for port in MASS_PORTS} | changes
    values["h_rel"] = 2.0 * values["h0"]
    return plan(scene_of(values), Accuracy()).film


def squeezed(eta, radius, start, end):
    """Impulse of a flooded disc, by Stefan's law."""
    return 0.75 * math.pi * eta * radius**4 * (start**-2 - end**-2)


def move(host, length, gap, speed):
    host.set(h=gap, v=speed)
    assert host.step(length) == OK


def test_it_is_valid(force_fmu):
    assert building.validate(force_fmu) == []


def test_what_the_issue_asks_for_is_among_the_outputs():
    names = {port.name for port in PORTS}
    assert {"h", "v", "F", "F_m", "F_v", "c", "k", "J", "F_mean"} <= names
    assert {"coupling_error", "H_stable", "in_doubt", "state", "limit"} <= names


# Forces --------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    "film",
    [
        {},
        {"V": 2e-11},
        {"h0": 10e-9, "R": 0.5e-3, "V": 7.85e-15},
        {"dp_cav": 1e6},
        {"tau_lim": 1e4},
        {"N": 100, "V": 1e-11},
        {"gamma": 0.0},
        {"theta1": math.pi / 2, "theta2": 0.1, "V": 1e-11},
    ],
    ids=["flooded", "volume", "10 nm", "tension", "shear", "100 menisci", "dry", "90 deg"],
)
def test_forces_and_slopes_are_those_of_the_plan(host, film):
    made = film_of(**film)
    host.start(**film)
    start = film.get("h0", 5e-6)
    for gap, speed in ((1.001 * start, 0.0), (1.5 * start, 1e-3), (2.0 * start, -2e-3)):
        host.set(h=gap, v=speed)
        found = host.outputs()
        assert found["F_m"] == pytest.approx(made.static_force(gap), rel=1e-12)
        assert found["F_v"] == pytest.approx(made.viscous_force(gap, speed)[0], rel=1e-12)
        assert found["F"] == pytest.approx(found["F_m"] + found["F_v"], rel=1e-14)
        steps = (max(abs(speed), 1e-9) * 1e-4, gap * 1e-4)
        slope = [
            (made.force(gap + a, speed + b) - made.force(gap - a, speed - b)) / (2.0 * (a + b))
            for a, b in ((0.0, steps[0]), (steps[1], 0.0))
        ]
        assert found["c"] == pytest.approx(slope[0], rel=1e-6, abs=1e-9)
        assert found["k"] == pytest.approx(slope[1], rel=1e-6)


def test_the_stable_step_is_m_over_c(host):
    host.start(m_ref=0.02)
    assert host.get("H_stable") == pytest.approx(0.02 / host.get("c"), rel=1e-14)
    assert host.get("c") == pytest.approx(1.5 * math.pi * 0.1 * RADIUS**4 / 5e-6**3, rel=1e-12)


# Impulses ------------------------------------------------------------------------------------


@pytest.mark.parametrize(("start", "end"), [(5e-6, 1e-4), (10e-9, 1e-2), (2e-5, 2.1e-5)])
@pytest.mark.parametrize("n", [1, 50])
def test_the_impulse_does_not_depend_on_the_way(host, start, end, n):
    host.start(h0=start, h=start, exchange=int(Exchange.IMPULSE), gamma=0.0)
    for i in range(n):
        move(host, 1e-3 * (1 + i % 3), start * (end / start) ** ((i + 1) / n), 1e-3)
    assert host.get("J") == pytest.approx(squeezed(0.1, RADIUS, start, end), rel=1e-12)
    move(host, 1e-3, start, -1e-3)
    assert host.get("J") == pytest.approx(0.0, abs=1e-12 * squeezed(0.1, RADIUS, start, end))


@pytest.mark.parametrize(
    "film",
    quick(
        [{"dp_cav": 1e6}, {"dp_cav": 1e5}, {"tau_lim": 1e4}, {"dp_cav": 5e5, "tau_lim": 3e4}], 1, 3
    ),
)
@pytest.mark.parametrize(("end", "length"), [(5.5e-6, 1e-3), (9e-6, 1e-3), (4e-6, 1e-2)])
def test_the_impulse_under_a_limit_is_the_integral_of_the_force(film, end, length):
    """By another quadrature: 20 000 points at the mean speed."""
    made, start = film_of(V=DISC * 5e-6, **film), 5.1e-6
    speed = (end - start) / length
    gaps = start + (end - start) * (np.arange(20_000) + 0.5) / 20_000
    mean = np.mean([made.viscous_force(gap, speed)[0] for gap in gaps])
    static = np.mean([made.static_force(gap) for gap in gaps])
    found = travel(made, start, end, length)
    assert found.viscous == pytest.approx(length * mean, rel=2e-5)
    assert found.static == pytest.approx(length * static, rel=1e-8)


@pytest.mark.parametrize(
    "film", [{}, {"V": DISC * 5e-6}, {"V": 1e-10, "theta1": 1.5, "theta2": 0.1}]
)
@pytest.mark.parametrize(
    ("start", "end"), [(5.1e-6, 5.2e-6), (5.1e-6, 1e-5), (3e-6, 3e-4), (3e-4, 3e-6)]
)
def test_the_static_impulse_of_a_long_step_is_the_integral_of_the_force(film, start, end):
    """By quad in ln h between the kinks; over the gap ratio of 100 Simpson's rule gave 20 times."""
    made = film_of(**film)
    marks = sorted({start, end, *(k for k in made.kinks if min(start, end) < k < max(start, end))})
    whole = sum(
        quad(lambda x: made.static_force(math.exp(x)) * math.exp(x), *np.log(part), epsrel=1e-11)[0]
        for part in pairwise(marks)
    )
    found = travel(made, start, end, 2e-3)
    assert found.static == pytest.approx(2e-3 * whole / abs(end - start), rel=1e-8)


def test_the_static_impulse_up_to_rupture_is_the_integral_of_the_force():
    """The slope of the bridge has no bound there: by quad over the root of the distance."""
    made = film_of(V=DISC * 5e-6)
    start, end = 0.5 * made.end, 1.1 * made.end
    way = made.end - start
    whole, _ = quad(
        lambda u: made.static_force(made.end - way * u * u) * 2.0 * u * way,
        0.0,
        1.0,
        epsabs=0.0,
        epsrel=1e-10,
    )
    found = travel(made, start, end, 1e-3)
    assert found.static == pytest.approx(1e-3 * whole / (end - start), rel=1e-6)
    assert found.broken == pytest.approx(way / (end - start), rel=1e-14)


@pytest.mark.parametrize("film", [{}, {"V": DISC * 5e-6}, {"V": DISC * 5e-6, "dp_cav": 1e5}])
@pytest.mark.parametrize("step", [0.0, 1e-15, 1e-9, 1e-5, 1e-3])
def test_a_step_that_hardly_moves_costs_two_forces(film, step, monkeypatch):
    made, asked = film_of(**film), []
    begin, known = 7e-6, made.static_force(7e-6)
    force = type(made).static_force
    monkeypatch.setattr(type(made), "static_force", lambda f, h: asked.append(h) or force(f, h))
    end = begin * (1.0 + step)
    found = travel(made, begin, end, 1e-6, known)
    assert len(asked) == (0 if end == begin else 2)
    assert found.static == pytest.approx(1e-6 * known, rel=2e-3)
    speed = (end - begin) / 1e-6
    assert found.viscous == pytest.approx(
        1e-6 * made.viscous_force(begin, speed)[0], rel=5e-3, abs=0.0
    )


def test_a_film_that_stands_still_gives_no_viscous_impulse():
    assert travel(film_of(dp_cav=1e5), 5e-6, 5e-6, 1.0).viscous == 0.0


@pytest.mark.parametrize(("begin", "end"), [(5e-324, 1e-5), (1e-5, 1e-323), (1e-5, 1e300)])
def test_a_way_through_all_numbers_has_an_end(begin, end):
    """The smallest numbers have no fraction: panels by ratio would never arrive."""
    forces = []

    class Counted:
        end, kinks, limits, cavity = math.inf, (), (), None

        def static_force(self, gap):
            forces.append(gap)
            return 1.0

        def viscous_impulse(self, start, end):
            return 0.0

    travel(Counted(), begin, end, 1.0)
    assert len(forces) < 2000


def test_an_impulse_is_continuous_where_a_limit_sets_in():
    made = film_of(dp_cav=1e6)
    edge = 0.5 * DISC * 1e6 / made.damping(5e-6)  # speed at which the limit begins to act
    ends = [5e-6 + edge * (1.0 + x) * 1e-6 for x in (-1e-6, 1e-6)]
    first, last = (travel(made, 5e-6, end, 1e-6).viscous for end in ends)
    assert first == pytest.approx(last, rel=1e-5)


# Rupture and state ---------------------------------------------------------------------------


def test_rupture_is_found_within_a_step(host):
    host.start(h0=5e-6, h_break=30e-6, exchange=int(Exchange.IMPULSE))
    assert host.get("h_above") == pytest.approx(30e-6)
    move(host, 1e-3, 55e-6, 0.05)
    assert host.get("state") == FilmStatus.BROKEN
    assert host.get("t_break") == pytest.approx(0.5e-3, rel=1e-12)
    assert host.get("J") == pytest.approx(squeezed(0.1, RADIUS, 5e-6, 30e-6), rel=1e-12)
    assert (host.get("F"), host.get("c"), host.get("n_break")) == (0.0, 0.0, 1)
    assert host.get("H_stable") == sys.float_info.max
    move(host, 1e-3, 20e-6, -0.05)
    assert host.get("F") == 0.0
    assert host.get("h_below") == 5e-6


@pytest.mark.parametrize(("rewet", "wet"), [(1.0, True), (0.0, False)])
def test_the_film_is_there_again_when_the_bodies_return(host, rewet, wet):
    host.start(V=DISC * 5e-6, h_break=30e-6, rewet=rewet)
    move(host, 1e-3, 40e-6, 0.05)
    move(host, 1e-3, 5e-6, -0.05)
    assert (host.get("state") != FilmStatus.BROKEN) is wet
    assert (host.get("F_m") > 0.0) is wet


@pytest.mark.parametrize("rewet", [1.0, 0.5])
@pytest.mark.parametrize("end", [4.999999e-6, 1e-6])
def test_a_film_that_is_there_again_within_a_step_resists_the_rest_of_it(host, rewet, end):
    host.start(h0=5e-6, V=DISC * 5e-6, rewet=rewet, h_break=30e-6)
    move(host, 1e-3, 1e-2, 0.1)
    before = host.get("J"), host.get("J_m")
    move(host, 1e-3, end, -1.0)
    again = travel(film_of(V=rewet * DISC * 5e-6), 5e-6, end, 1e-3 * (5e-6 - end) / (1e-2 - end))
    done = host.get("J") - before[0], host.get("J_m") - before[1]
    assert done[0] < 0.0 < done[1]
    assert done == pytest.approx(again[:2], rel=1e-6)
    assert host.get("F_mean") == pytest.approx(sum(again[:2]) / 1e-3, rel=1e-6)
    assert host.get("state") != FilmStatus.BROKEN


def test_a_flooded_film_that_is_there_again_has_the_impulse_of_stefan(host):
    host.start(h_break=30e-6, gamma=0.0)
    move(host, 1e-3, 1e-2, 0.1)
    before = host.get("J")
    move(host, 1e-3, 1e-6, -1.0)
    done = host.get("J") - before
    assert done == pytest.approx(squeezed(0.1, RADIUS, 5e-6, 1e-6), rel=1e-12)
    assert done == pytest.approx(-22.986, rel=1e-4)
    assert host.get("F_mean") == pytest.approx(1e3 * done, rel=1e-12)


def test_a_step_that_ends_at_the_initial_gap_wets_without_an_impulse(host):
    host.start(h_break=30e-6)
    move(host, 1e-3, 1e-2, 0.1)
    before = host.get("J"), host.get("J_m")
    move(host, 1e-3, 5e-6, -1.0)
    assert (host.get("J"), host.get("J_m")) == before
    assert host.get("state") != FilmStatus.BROKEN
    assert host.get("F_m") > 0.0


def test_a_state_saved_before_rupture_gives_the_same_again(host):
    host.start(h_break=30e-6, dp_cav=1e6)
    move(host, 1e-4, 10e-6, 0.05)
    saved = host.slave.getFMUState()
    data = host.slave.serializeFMUstate(saved)
    move(host, 1e-3, 40e-6, 0.05)
    after = host.outputs()
    for state in (saved, host.slave.deSerializeFMUstate(data)):
        host.slave.setFMUState(state)
        host.time = 1e-4
        assert host.get("state") != FilmStatus.BROKEN
        move(host, 1e-3, 40e-6, 0.05)
        assert host.outputs() == after


def test_a_gap_of_zero_is_refused_and_can_be_rolled_back(host):
    host.start()
    saved = host.slave.getFMUState()
    host.set(h=0.0)
    assert host.step(1e-3) == DISCARD
    assert "h must be a finite number above 0" in host.errors[0]
    host.slave.setFMUState(saved)
    assert host.step(1e-3, 0.0) == OK


# Doubts --------------------------------------------------------------------------------------


def in_category(host, name):
    return [entry.message for entry in host.log if entry.category == name]


def test_a_step_beyond_the_stable_one_raises_the_flag_and_warns_once(host):
    host.start()
    stable = host.get("H_stable")
    for i in range(5):
        move(host, 2.0 * stable, 5e-6 * (1.0 + 1e-9 * (i + 1)), 1e-7)
        assert host.get("in_doubt") == 1
    said = in_category(host, "logCoupling")
    assert len(said) == 1
    assert "exceeds 5.22e-08 s = m_ref/c" in said[0]
    assert "stiction-mass" in said[0]
    assert host.get("n_doubt") == 5
    assert host.errors == []


def test_a_film_that_breaks_in_one_step_is_in_doubt(host):
    """Soft at both ends: only the force on the way gives it away."""
    host.start(h0=5e-5, h=5e-5)
    assert host.get("H_stable") > 4e-5
    move(host, 4e-5, 5e-4, 0.1)
    assert host.get("coupling_error") > 0.2
    assert host.get("in_doubt") == 1
    assert "on its way" in in_category(host, "logCoupling")[0]


def test_a_run_with_short_steps_is_not_in_doubt(host):
    """A 20 um film coupled by its force at a thirtieth of m/c, from rest: no false alarm."""
    host.start(h0=2e-5, h=2e-5, eta=0.01)
    gap, speed, force, length = 2e-5, 0.0, host.get("F"), 1e-6
    for _ in range(390):
        speed += length * (40.0 - force) / 0.02
        gap += length * speed
        move(host, length, gap, speed)
        assert host.get("in_doubt") == 0
        force = host.get("F")
    assert gap > 8e-5
    assert in_category(host, "logCoupling") == []


def test_who_exchanges_impulses_is_left_in_peace(host):
    host.start(exchange=int(Exchange.IMPULSE))
    move(host, 1e-2, 1e-4, 0.1)
    assert host.get("coupling_error") > 0.2
    assert host.get("in_doubt") == 0
    assert in_category(host, "logCoupling") == []


def test_the_limit_that_acts_is_reported(host):
    host.start(dp_cav=1e5, meniscus_law=int(MeniscusLaw.NONE))
    host.set(v=1e-3)
    assert host.get("limit") == LimitKind.TENSION
    assert host.get("F") == pytest.approx(DISC * 1e5, rel=0.01)
    host.set(v=-1e-3)
    assert host.get("limit") == LimitKind.NONE
