"""The films' FMUs with a cavity that remembers: exact cases, states, events, misuse."""

from __future__ import annotations

import math

import attrs
import pytest
from film_cavity_cases import CASES, OSCILLATION, PULLED, film_values, oscillating, pulled

import contactkit as ck
from contactkit.accuracy import Accuracy
from contactkit.errors import DescriptionError, PlanError
from contactkit.fmu.python import build as building
from contactkit.fmu.slaves.stiction_force import StictionForce
from contactkit.fmu.slaves.stiction_mass import PORTS, MeniscusLaw, mass_values, scene_of
from contactkit.separation.cavity.path import along_path
from contactkit.separation.cavity.state import FULL
from contactkit.separation.effects.base import LimitKind
from contactkit.separation.plan import plan

pytestmark = pytest.mark.slow

OK, DISCARD = 0, 2


@pytest.fixture(scope="session")
def mass_fmu(shelf):
    return shelf(building.build, "stiction-mass")


@pytest.fixture
def host(mass_fmu, open_fmu):
    return open_fmu(mass_fmu)


@pytest.fixture(scope="session")
def force_fmu(shelf):
    return shelf(building.build, "stiction-force")


def events(host):
    return [entry.message for entry in host.log if entry.category == "logEvents"]


# A mass on the film --------------------------------------------------------------------------


@pytest.mark.parametrize("name", PULLED)
def test_the_exact_release_times_are_met(host, name):
    case = CASES[name]
    exact, given = case["values"], case["inputs"]
    host.start(**pulled(case))
    host.set(F_ext=given["force"])
    assert host.step(exact["t_release"]) == OK
    assert host.get("h") == pytest.approx(given["final_gap"], rel=1e-6)
    assert host.get("V_void") == pytest.approx(exact["void_volume_end"], rel=1e-6)
    assert host.get("limit") == LimitKind.TENSION
    assert host.step(1e-3 * exact["t_release"]) == OK
    assert host.get("t_release") == pytest.approx(exact["t_release"], rel=1e-6)
    cavitated = next(text for text in events(host) if text.startswith("film cavitated at t = "))
    assert float(cavitated.split("=")[1].split()[0]) == pytest.approx(exact["t_on"], rel=1e-6)


def test_steps_of_the_tool_leave_the_release_as_it_is(host):
    case = CASES["pull_free_jfo_two_pressures_0.3"]
    host.start(**pulled(case))
    host.set(F_ext=case["inputs"]["force"])
    for _ in range(60):
        assert host.step(case["values"]["t_release"] / 59.5) == OK
    assert host.get("t_release") == pytest.approx(case["values"]["t_release"], rel=1e-6)


def test_a_state_saved_while_the_film_is_cavitated_gives_the_same_again(host):
    case = CASES["pull_flooded_jfo_0.1"]
    host.start(**pulled(case), k_s=2e6)
    host.set(F_ext=case["inputs"]["force"])
    for time in (1.5e-4, 1e-4):
        host.step(time)
    assert host.get("r_cav") > 0.5 * case["inputs"]["radius"]
    saved = host.slave.getFMUState()
    data = host.slave.serializeFMUstate(saved)
    host.set(F_ext=-200.0)
    host.step(6e-4)
    after = host.outputs()
    assert after["v"] < 0.0
    for state in (saved, host.slave.deSerializeFMUstate(data)):
        host.slave.setFMUState(state)
        host.time = 2.5e-4
        assert host.get("r_cav") > 0.5 * case["inputs"]["radius"]
        host.set(F_ext=-200.0)
        host.step(6e-4)
        assert host.outputs() == after


def test_a_film_that_is_pressed_full_again_is_logged(host):
    case = CASES["pull_flooded_jfo_0.1"]
    host.start(**pulled(case) | {"h_rel": 1e-3})
    host.set(F_ext=40.0)
    host.step(1e-4)
    assert host.get("V_void") > 0.0
    host.set(F_ext=-400.0)
    for _ in range(40):
        host.step(2e-5)
    assert (host.get("r_cav"), host.get("V_void")) == (0.0, 0.0)
    assert [text.split(" at ")[0] for text in events(host)[:2]] == [
        "film cavitated",
        "film reformed",
    ]


def test_a_film_that_broke_comes_back_without_a_cavity(host):
    case = CASES["pull_flooded_jfo_0.1"]
    host.start(**pulled(case), h_break=8e-6, h_min=4e-6)
    host.set(F_ext=40.0)
    host.step(1.5e-4)
    assert (host.get("n_break"), host.get("V_void")) == (1, 0.0)
    host.set(F_ext=-200.0)
    host.step(4e-4)
    assert host.get("h") < 5e-6
    assert (host.get("r_cav"), host.get("V_void")) == (0.0, 0.0)
    assert host.get("F") < -100.0


# Parameters ----------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("values", "field", "message"),
    [
        (
            {"dp_hold": 1e5},
            "dp_hold",
            "be 0 where dp_inception is 0 [Pa], got 100000.0; set dp_inc",
        ),
        ({"dp_inception": 1e5, "dp_hold": 2e5}, "dp_hold", "not exceed dp_inception = 100000 Pa"),
        ({"dp_inception": 1e6, "dp_cav": 1e6}, "dp_inception", "be 0 where dp_cav is not"),
        ({"dp_inception": 1e6, "tau_lim": 1e6}, "dp_inception", "be 0 where tau_lim is not"),
    ],
)
def test_tensions_that_contradict_each_other_are_refused(values, field, message):
    with pytest.raises(DescriptionError) as caught:
        scene_of({port.name: port.start for port in PORTS} | values)
    assert caught.value.field == field
    assert message in str(caught.value)
    assert caught.value.hint


def test_a_refused_tension_is_in_the_log_and_can_be_corrected(host):
    host.start(dp_inception=1e5, dp_hold=2e5)
    assert host.step(1e-5) == DISCARD
    assert any("dp_hold must not exceed dp_inception" in entry.message for entry in host.log)
    host.reset().start(dp_inception=1e5, dp_hold=1e5)
    host.set(F_ext=40.0)
    assert host.step(1e-5) == OK


@pytest.mark.parametrize(
    ("limit", "values"),
    [
        (ck.TensionLimit(strength=1e6), (0.0, 1e6, 101_325.0)),
        (ck.TensionLimit(strength=5e4), (0.0, 5e4, 0.0)),
        (ck.TensionLimit(strength="vapour"), (0.0, 101_325.0, 0.0)),
        (ck.TensionLimit(strength=1e6, cavity_pressure=101_325.0 - 1e6), (0.0, 1e6, 0.0)),
        (ck.TensionLimit(strength=1.7e6, cavity_pressure=4321.0), (0.0, 1.7e6, 97_004.0)),
        (ck.TensionLimit(strength=3e5, cavity="truncated"), (3e5, 0.0, 0.0)),
    ],
)
def test_the_tension_limit_of_a_scene_is_held_by_parameters(limit, values):
    start = {port.name: port.start for port in PORTS}
    scene = scene_of(start)
    scene = attrs.evolve(scene, effects=(*scene.effects, limit))
    found = mass_values(scene)
    assert tuple(found[name] for name in ("dp_cav", "dp_inception", "dp_hold")) == values
    again = scene_of({p.name: p.read(found.get(p.name, p.start)) for p in PORTS})
    assert mass_values(again) == found


def test_a_cavity_without_memory_has_no_parameters():
    scene = scene_of({port.name: port.start for port in PORTS})
    stieber = ck.TensionLimit(strength=1e6, cavity="reynolds")
    with pytest.raises(PlanError, match="cavity = 'truncated', not 'reynolds'"):
        mass_values(attrs.evolve(scene, effects=(*scene.effects, stieber)))


# A film for a tool that owns the mass --------------------------------------------------------


def moved(slave, n, end, begin=0.0):
    """Move a film along the oscillation in n steps."""
    length = (end - begin) / n
    for i in range(n):
        slave.values["h"], slave.values["v"] = oscillating(begin + (i + 1) * length)
        slave.advance(begin + i * length, length)
    return dict(slave.values)


def prepared_film(**more):
    slave = StictionForce(instance_name="direct")
    slave.values.update(film_values(**more))
    slave.prepare()
    return slave


def test_the_way_of_a_tool_is_that_of_a_smooth_path():
    start = {port.name: port.start for port in PORTS} | film_values()
    film = plan(scene_of(start | {"h_rel": 1.0}), Accuracy()).film
    end, impulse, before = 6e-3, 0.0, oscillating(0.0)[0]
    for point in along_path(film.cavity, FULL, oscillating, 0.0, end, 1e-11):
        gap = oscillating(point.time)[0]
        full = film.newtonian_impulse(before, gap)
        impulse, before, cavity = impulse + (point.impulse or full), gap, point.cavity
    errors = []
    for n in (60, 240):
        values = moved(prepared_film(), n, end)
        errors.append(abs(values["V_void"] / cavity.void - 1.0))
        assert values["J"] == pytest.approx(impulse, rel=20.0 * n**-2)
    assert errors[0] < 1e-3
    assert errors[1] < 0.1 * errors[0]


def test_a_film_in_steps_meets_the_oscillating_disc():
    values = OSCILLATION["values"]
    slave, said, begin = prepared_film(), [], 0.0
    slave.event = said.append
    for end, radius, force in zip(
        values["t"], values["cavity_radius"], values["pull"], strict=True
    ):
        found = moved(slave, round((end - begin) / 5e-5), end, begin)
        begin = end
        assert found["F"] == pytest.approx(force, rel=1e-4, abs=1e-3)
        if end > values["t_turn"]:
            assert found["r_cav"] == pytest.approx(radius, rel=2e-5)
    moved(slave, 60, 0.017, begin)
    cavitated, whole = said
    assert cavitated.startswith("film cavitated at t = ")
    assert float(whole.removeprefix("film reformed at t = ").removesuffix(" s")) == (
        pytest.approx(values["t_nearly_full"], rel=1e-4)
    )


def test_a_film_that_was_cavitated_fills_at_rest():
    """After a fast opening by a factor of five; the film ruptured at one gap, all at once."""
    slave = prepared_film()
    slave.values["h"] = 5.0 * slave.values["h0"]
    slave.advance(0.0, 1e-6)
    edge, before = slave.values["r_cav"], slave.values["h0"]
    gap, radius = slave.values["h"], slave.values["R"]
    share = edge / radius
    dp, eta = slave.values["dp_inception"], slave.values["eta"]
    volume = slave.values["V_void"]
    assert volume == pytest.approx(math.pi * edge**2 * (gap - before), rel=1e-3)
    time = 3.0 * eta * edge**2 * (gap - before) / (gap**3 * dp) * (1.0 - 2.0 * math.log(share))
    slave.values["v"] = 0.0
    slave.advance(1e-6, 0.97 * time)
    assert slave.values["V_void"] > 0.0
    slave.advance(1e-6 + 0.97 * time, 0.06 * time)
    assert slave.values["V_void"] == 0.0
    assert slave.values["limit"] == LimitKind.NONE


def test_a_state_of_a_cavitated_film_gives_the_same_again(force_fmu, open_fmu):
    host = open_fmu(force_fmu)
    host.start(**film_values())

    def go(begin, end, n):
        length = (end - begin) / n
        for i in range(n):
            gap, speed = oscillating(begin + (i + 1) * length)
            host.set(h=gap, v=speed)
            assert host.step(length) == OK

    go(0.0, 3e-3, 80)  # more pieces than are kept, so that some were merged
    saved = host.slave.getFMUState()
    data = host.slave.serializeFMUstate(saved)
    go(3e-3, 8e-3, 20)
    after = host.outputs()
    assert after["V_void"] > 0.0
    for state in (saved, host.slave.deSerializeFMUstate(data)):
        host.slave.setFMUState(state)
        host.time = 3e-3
        go(3e-3, 8e-3, 20)
        assert host.outputs() == after


def test_inputs_between_steps_leave_the_edge_where_it_is():
    slave = prepared_film()
    moved(slave, 60, 4e-3)
    gap, speed = slave.values["h"], slave.values["v"]
    edge, force = slave.values["r_cav"], slave.values["F"]
    damping, stiffness = slave.values["c"], slave.values["k"]
    for name, move, slope in (("v", 1e-3 * speed, damping), ("h", 1e-6 * gap, stiffness)):
        slave.values.update(h=gap, v=speed)
        slave.values[name] += move
        slave.refresh()
        assert slave.values["r_cav"] == edge
        assert slave.values["F"] - force == pytest.approx(slope * move, rel=1e-4)


def test_a_full_film_set_to_a_speed_that_cavitates_it_shows_its_cavity():
    case = CASES["disc_expanding_3"]
    given, exact = case["inputs"], case["values"]
    slave = StictionForce(instance_name="direct")
    slave.values.update(
        R=given["radius"],
        h0=given["gap"],
        h=given["gap"],
        eta=given["viscosity"],
        meniscus_law=MeniscusLaw.NONE,
        dp_inception=given["tension"],
        v=given["opening_speed"],
    )
    slave.prepare()
    assert slave.values["F"] == pytest.approx(exact["pull"], rel=1e-11)
    assert slave.values["r_cav"] == pytest.approx(exact["cavity_radius"], rel=1e-11)
