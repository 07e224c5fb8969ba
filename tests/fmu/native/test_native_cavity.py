"""Cavities that remember, in C: what the Python FMUs compute, states, events, misuse, FMI 3."""

from __future__ import annotations

import pytest
from film_cavity_cases import CASES, PULLED, film_values, oscillating, pulled
from native_scenes import HAS_CC
from selection import quick

pytest.importorskip("pythonfmu")
fmpy = pytest.importorskip("fmpy")
from fmpy.fmi1 import FMICallException  # noqa: E402

if not HAS_CC:
    pytest.skip("there is no C compiler", allow_module_level=True)

from contactkit.errors import DescriptionError  # noqa: E402
from contactkit.fmu.framework.toolchain import local  # noqa: E402
from contactkit.fmu.native.build import build_native  # noqa: E402
from contactkit.fmu.slaves.stiction_force import StictionForce  # noqa: E402
from contactkit.fmu.slaves.stiction_mass import PORTS, StictionMass, scene_of  # noqa: E402

pytestmark = pytest.mark.slow

OK = 0
ONE = {"platforms": [local()], "compiler": "cc"}
MOTION = ("h", "v", "F", "J", "W", "F_peak", "t_release", "r_cav", "V_void")


@pytest.fixture
def native(shelf, open_fmu):
    """Host of a native FMU of parameters."""

    def of(values, **more):
        start = {port.name: port.start for port in PORTS} | values
        scene = scene_of(start | {"h_rel": max(start["h_rel"], 2.0 * start["h0"])})
        return open_fmu(shelf(build_native, scene, **ONE, **more))

    return of


def python_mass(values):
    slave, said = StictionMass(instance_name="direct"), []
    slave.event = said.append
    slave.values.update(values)
    slave.prepare()
    return slave, said


def events(host):
    return [entry.message for entry in host.log if entry.category == "logEvents"]


@pytest.mark.parametrize("name", quick(PULLED, long=[0, 1]))
def test_a_disc_pulled_apart_and_pressed_back_moves_as_in_python(name, native):
    case = CASES[name]
    end, values = 1.02 * case["values"]["t_release"], pulled(case)
    host = native(values).start()
    slave, said = python_mass(values)
    for i, pull in enumerate((case["inputs"]["force"], -300.0)):
        host.set(F_ext=pull)
        slave.values["F_ext"] = pull
        assert host.step(end) == OK
        slave.advance(i * end, end)
        for output in MOTION:
            assert host.get(output) == pytest.approx(slave.values[output], rel=1e-8), output
        assert host.get("limit") == slave.values["limit"]
    assert host.get("t_release") == pytest.approx(case["values"]["t_release"], rel=1e-6)
    assert sorted(events(host)) == sorted(said)


def test_bodies_that_bounce_on_asperities_cavitate_the_film_again_as_in_python(native):
    """At rest no void is left: nothing cavitated at a smaller gap."""
    values = pulled(CASES["pull_flooded_jfo_0.1"]) | {"h0": 20e-6, "h_min": 15e-6, "h_rel": 1e-3}
    host = native(values | {"dp_hold": 1e5}).start()
    slave, said = python_mass(values | {"dp_hold": 1e5})
    time, seen = 0.0, set()
    for pull in (40.0, -900.0, -900.0, 40.0, 40.0, -2e3):
        host.set(F_ext=pull)
        slave.values["F_ext"] = pull
        assert host.step(1e-4) == OK
        slave.advance(time, 1e-4)
        time += 1e-4
        seen.add((slave.state.in_contact, slave.values["V_void"] > 0.0))
        for output in MOTION:
            expected = slave.values[output]
            assert host.get(output) == pytest.approx(expected, rel=1e-8, abs=1e-20), output
    assert seen >= {(True, False), (False, True)}
    assert sorted(events(host)) == sorted(said)


def test_a_state_of_a_cavitated_film_gives_the_same_again(native):
    case = CASES["pull_free_jfo_1.0"]
    host = native(pulled(case)).start()
    host.set(F_ext=case["inputs"]["force"])
    host.step(2e-4)
    saved = host.slave.getFMUState()
    data = host.slave.serializeFMUstate(saved)
    host.set(F_ext=-200.0)
    host.step(5e-4)
    after = host.outputs()
    for state in (saved, host.slave.deSerializeFMUstate(data)):
        host.slave.setFMUState(state)
        host.time = 2e-4
        assert host.get("V_void") > 0.0
        host.set(F_ext=-200.0)
        host.step(5e-4)
        assert host.outputs() == after


def test_a_film_moves_along_a_path_as_in_python(native):
    """With more steps in which it cavitates further than pieces are kept."""
    values = film_values()
    host = native(values, model="stiction-force").start()
    slave, said = StictionForce(instance_name="direct"), []
    slave.event = said.append
    slave.values.update(values)
    slave.prepare()
    n, end = 200, 0.017
    for i in range(n):
        # more of them while it opens
        begin, stop = (end * (k / n) ** 2 for k in (i, i + 1))
        gap, speed = oscillating(stop)
        host.set(h=gap, v=speed)
        slave.values.update(h=gap, v=speed)
        assert host.step(stop - begin) == OK
        slave.advance(begin, stop - begin)
        assert host.get("k") == pytest.approx(slave.values["k"], rel=1e-5, abs=1.0)
        for output in ("F", "c", "J", "F_mean", "r_cav", "V_void"):
            expected = slave.values[output]
            assert host.get(output) == pytest.approx(expected, rel=1e-7, abs=1e-16), (i, output)
    assert [text.split(" at ")[0] for text in events(host)] == ["film cavitated", "film reformed"]
    assert events(host) == said


def test_a_cavitated_film_at_rest_fills_as_in_python(native):
    values = film_values(N=3, dp_hold=4e4)
    host = native(values, model="stiction-force").start()
    slave = StictionForce(instance_name="direct")
    slave.values.update(values)
    slave.prepare()
    ways = ((30e-6, 2e-5), (30e-6, 1e-3), (12e-6, 1e-4), (40e-6, 1e-5), (11e-6, 1e-3))
    time, was = 0.0, []
    for gap, length in ways:
        host.set(h=gap, v=0.0)
        slave.values.update(h=gap, v=0.0)
        assert host.step(length) == OK
        slave.advance(time, length)
        time += length
        was.append(slave.values["V_void"])
        for output in ("F", "c", "J", "r_cav", "V_void"):
            expected = slave.values[output]
            assert host.get(output) == pytest.approx(expected, rel=1e-7, abs=1e-20), output
    assert was[0] > was[1] > 0.0 == was[-1]


@pytest.mark.parametrize(
    ("values", "message"),
    [
        ({"dp_hold": 2e6}, "dp_hold must not exceed dp_inception = 1000000 Pa, got 2000000 Pa"),
        ({"dp_cav": 1e5}, "dp_inception must be 0 beside dp_cav = 100000 Pa, got 1000000 Pa"),
        ({"tau_lim": 1e5}, "dp_inception must be 0 beside tau_lim = 100000 Pa"),
        ({"dp_inception": 0.0, "dp_hold": 1e5}, "dp_hold must not exceed dp_inception = 0 Pa"),
    ],
)
def test_tensions_that_contradict_each_other_are_refused(values, message, native):
    host = native(pulled(CASES["pull_flooded_jfo_0.1"]))
    with pytest.raises(FMICallException, match="fmi2ExitInitializationMode"):
        host.start(**values)
    assert any(message in entry.message for entry in host.log)


def test_a_start_that_contradicts_itself_is_refused_when_the_fmu_is_built(tmp_path):
    start = {port.name: port.start for port in PORTS}
    with pytest.raises(DescriptionError, match="dp_hold must not exceed dp_inception"):
        build_native(
            scene_of(start), tmp_path / "x.fmu", start={"dp_inception": 1e5, "dp_hold": 2e5}
        )


@pytest.mark.slow
def test_fmi_3_has_the_same_cavity(shelf, tmp_path):
    case = CASES["pull_flooded_jfo_0.1"]
    values = pulled(case)
    scene = scene_of({port.name: port.start for port in PORTS} | values)
    path = shelf(build_native, scene, fmi=3, **ONE)
    found = fmpy.simulate_fmu(
        str(path),
        fmi_type="CoSimulation",
        start_values={"F_ext": case["inputs"]["force"]},
        stop_time=case["values"]["t_release"],
        output_interval=case["values"]["t_release"] / 4.0,
        output=["h", "r_cav", "V_void"],
    )
    assert found["h"][-1] == pytest.approx(case["inputs"]["final_gap"], rel=1e-6)
    assert found["V_void"][-1] == pytest.approx(case["values"]["void_volume_end"], rel=1e-6)
    assert found["r_cav"][-1] > 0.9 * case["inputs"]["radius"]
