"""The native ``tip-contact``: as the Python FMU, landed, free, struck and restored."""

from __future__ import annotations

import math
import random

import pytest
from drive_faces import ball
from native_scenes import HAS_CC

pytest.importorskip("pythonfmu")
pytest.importorskip("fmpy")
if not HAS_CC:
    pytest.skip("there is no C compiler", allow_module_level=True)

from attrs import evolve
from fmpy.fmi1 import FMICallException

from contactkit.app.scenes import open_scene
from contactkit.errors import DescriptionError
from contactkit.fmu.framework.toolchain import local
from contactkit.fmu.native.tip import build_native_tip
from contactkit.fmu.python.build import build, validate
from contactkit.fmu.slaves.tip_contact import PORTS, TipContact, TipLaw, TipStatus
from contactkit.models.micromirror.report.cosimulation import couple_fmus, tip_start

pytestmark = pytest.mark.slow

ONE = {"platforms": [local()], "compiler": "cc"}
OK, DISCARD = 0, 2
STEP = 2e-8
WET = {"V": 1.3e-24, "R": 1e-7}  # what condenses at a relative humidity of a half, about
FIXED = {"R", "A_H", "V", "theta1", "theta2", "profile"}
WHOLE = ("state", "n_break", "n_land")


KINDS = {"dry": ({}, None), "wet": (WET, None), "soft": ({"d_stop": 1.0}, ball())}


@pytest.fixture
def pair(shelf, open_fmu):
    """Host of a native FMU, and the Python slave with the same values, both started."""

    def both(kind, **values):
        start, curve = KINDS[kind]
        host = open_fmu(shelf(build_native_tip, curve=curve, start=start, **ONE))
        slave = TipContact(instance_name="direct")
        slave.data = {} if curve is None else {"curve": curve.to_data()}
        slave.setup_experiment(0.0)
        slave.values |= {**start, **values}
        slave.enter_initialization_mode()
        slave.exit_initialization_mode()
        assert not slave.failure
        return host.start(**values), slave

    return both


def follow(host, slave, path, length=STEP):
    """Step both along heights, speeds and accelerations; outputs are compared after each step."""
    for n, (z, vz, az) in enumerate(path):
        given = {"z": z, "vz": vz, "az": az}
        host.set(**given)
        slave.values |= given
        slave.refresh()
        assert host.get("F") == pytest.approx(slave.values["F"], rel=1e-7, abs=1e-14)
        assert host.step(length) == OK, host.errors
        assert slave.do_step(slave.time, length), slave.failure
        compare(host.outputs(), slave.values, n)


SIZES = {"F": 1e-7, "F_mean": 1e-7, "F_film": 1e-7, "F_max": 1e-7, "v": 0.1, "h": 1e-8}
SIZES |= {
    "J": 1e-14,
    "W_visc": 1e-17,
    "W_land": 1e-17,
    "W_plastic": 1e-17,
    "d": 1e-9,
    "d_max": 1e-9,
}


def compare(found, expected, n):
    for port in PORTS:
        name, value = port.name, expected[port.name]
        if port.causality != "output":
            continue
        if name in WHOLE:
            assert found[name] == value, (n, name)
            continue
        size = max(abs(value), SIZES.get(name, 0.0))
        assert found[name] == pytest.approx(value, abs=1e-7 * size), (n, name)


def steady(first, speed, count, length=STEP, acceleration=0.0):
    times = [i * length for i in range(count)]
    return [
        (first + t * (speed + 0.5 * acceleration * t), speed + acceleration * t, acceleration)
        for t in times
    ]


def shaken(amplitude, mean, frequency, count, length=STEP):
    """A root that goes up and down, its acceleration held through each step."""
    w = 2.0 * math.pi * frequency
    phases = [w * i * length for i in range(count)]
    return [
        (
            mean + amplitude * math.sin(x),
            amplitude * w * math.cos(x),
            -amplitude * w * w * math.sin(x),
        )
        for x in phases
    ]


# As the slave ------------------------------------------------------------------------------------


@pytest.mark.parametrize("kind", KINDS)
def test_a_pull_off_is_that_of_the_slave(pair, kind):
    """Landed, held, broken, free."""
    host, slave = pair(kind, z=-2e-8)
    follow(host, slave, steady(-2e-8, 0.2, 40))
    assert host.get("state") == TipStatus.FREE
    assert host.get("n_break") == (kind == "wet")


@pytest.mark.parametrize("kind", KINDS)
def test_many_landings_are_those_of_the_slave(pair, kind):
    """Shaken at a quarter of the frequency of the tips: 8 landings, 33 with rebounds."""
    host, slave = pair(kind, z=5e-8)
    follow(host, slave, shaken(1e-7, 5e-8, 2e6, 120))
    assert host.get("n_land") >= {"dry": 5, "wet": 5, "soft": 20}[kind]
    assert (host.get("d_max") > 0.0) == (kind == "soft")


@pytest.mark.parametrize("kind", KINDS)
def test_a_root_that_slows_down_sets_the_tips_down(pair, kind):
    host, slave = pair(kind, z=1e-7, vz=-0.5)
    follow(host, slave, steady(1e-7, -0.5, 20, acceleration=5e5))
    assert host.get("n_land") >= 1


def test_free_parameters_are_those_of_the_slave(pair):
    values = {"h0": 3e-10, "h_free": 3e-8, "m": 6e-16, "k": 2.0, "c": 1e-10, "N": 5}
    values |= {"gamma": 0.05, "eta": 2e-3, "rtol": 1e-9, "z": -1e-8}
    host, slave = pair("wet", **values)
    follow(host, slave, steady(-1e-8, 0.2, 30))
    assert host.get("n_break") == 1


def test_a_film_without_viscosity_dissipates_nothing(pair):
    host, slave = pair("wet", eta=0.0, z=-1e-8)
    follow(host, slave, steady(-1e-8, 0.2, 25))
    assert host.get("W_visc") == 0.0


def test_random_motion_is_answered_as_by_the_slave(pair):
    host, slave = pair("soft", z=-1e-9, d_stop=0.5, rtol=1e-6)
    chance = random.Random(7)
    path = [
        (chance.uniform(-2e-8, 3e-8), chance.uniform(-0.2, 0.2), chance.uniform(-1e6, 1e6))
        for _ in range(40)
    ]
    follow(host, slave, path)


# Steps -------------------------------------------------------------------------------------------


def test_a_step_of_nothing_changes_nothing(pair):
    host, _ = pair("wet", z=1e-7)
    before = host.outputs()
    assert host.step(0.0) == OK
    assert host.outputs() == before


def test_a_long_step_at_rest_is_one(pair):
    host, slave = pair("soft", z=-1e-9)
    follow(host, slave, [(-1e-9, 0.0, 0.0)] * 2, length=10.0)
    assert host.get("state") == TipStatus.LANDED


def test_a_flight_of_endless_swings_is_refused_by_both(pair):
    """A root that comes down within the step, after a million swings of the tip."""
    host, slave = pair("dry", z=1e-7, vz=0.2)
    given = {"z": 1e-7, "vz": -1e-6}
    host.set(**given)
    slave.values |= given
    before = host.outputs()
    assert host.step(0.2) == DISCARD
    assert not slave.do_step(0.0, 0.2)
    message = "a step of 0.2 s holds more than 62500 swings of a free tip; take shorter steps"
    assert message in host.errors[-1]
    assert host.outputs() == before
    assert host.step(1e-8) == OK


def test_a_tip_that_is_pressed_too_deep_is_discarded(pair):
    host, slave = pair("soft", z=-1e-9)
    for given in ({"z": -5e-6}, {"z": -1e-9, "vz": -100.0}):
        host.set(**given)
        slave.values |= given
        before = host.outputs()
        assert host.step(1e-7) == DISCARD
        assert not slave.do_step(slave.time, 1e-7)
        assert "m deep, beyond 4e-09 m and " in host.errors[-1]
        assert "make it with a larger approach" in host.errors[-1]
        assert host.outputs() == before
    host.set(z=-1e-9, vz=0.0)
    assert host.step(1e-7) == OK


def test_a_step_without_numbers_leaves_no_trace(pair):
    host, _ = pair("dry", z=1e-7)
    host.set(z=1e300, vz=1e300, az=1e300)
    assert host.step(1e10) == DISCARD
    host.set(z=1e-7, vz=0.0, az=0.0)
    assert host.step(1e-8) == OK
    assert host.get("h") == pytest.approx(1e-7 + 4e-10)


@pytest.mark.parametrize("length", [1e-10, STEP])
def test_going_back_to_a_state_gives_the_same_again(pair, length):
    """In the middle of an impact, and in flight between two of them."""
    host, _ = pair("soft", z=1e-9, vz=-0.5)

    def fall(first, last):
        for i in range(first, last):
            host.set(z=1e-9 - 0.5 * i * length, vz=-0.5)
            assert host.step(length, i * length) == OK
        return host.outputs()

    middle = 200 if length == 1e-10 else 5
    fall(0, middle)
    state = host.slave.getFMUState()
    kept = host.slave.deSerializeFMUstate(host.slave.serializeFMUstate(state))
    once = fall(middle, 2 * middle)
    for one in (state, kept):
        host.slave.setFMUState(one)
        assert fall(middle, 2 * middle) == once
        host.slave.freeFMUState(one)
    host.reset().start(z=1e-9, vz=-0.5)
    fall(0, middle)
    assert fall(middle, 2 * middle) == once
    assert once["n_land"] >= 1


def test_events_are_logged(pair):
    host, _ = pair("wet", z=-1e-8)
    for z, vz, _ in steady(-1e-8, 0.2, 20) + steady(7e-8, -0.5, 15):
        host.set(z=z, vz=vz)
        assert host.step(STEP) == OK
    logged = [entry.message for entry in host.log if entry.category == "logEvents"]
    assert [message.partition(" at ")[0] for message in logged][:2] == ["film broke", "landed"]
    assert f"film broke at t = {host.get('t_break'):.9g} s" in logged[-2:]


def test_its_slopes_are_those_of_the_springs(pair):
    host, _ = pair("dry", z=1e-7)
    references = {name: v.valueReference for name, v in host.variables.items()}
    of = [references["F"], references["h"]]

    def slopes(by):
        return host.slave.getDirectionalDerivative(of, [references[by]], [1.0])

    assert host.step(1e-9) == OK
    assert slopes("z") == pytest.approx([2.0, 0.0])
    assert slopes("vz") == pytest.approx([4e-10, 0.0])
    assert slopes("az") == [0.0, 0.0]
    host.reset().start(z=-1e-9)
    assert slopes("z") == pytest.approx([2.0, 0.0])
    assert slopes("vz") == [0.0, 0.0]


# What it refuses ---------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("kind", "values", "message"),
    [
        ("dry", {"h_free": 3e-10}, "h_free must exceed h0 = 4e-10 m"),
        ("dry", {"c": 1.0}, "c must be less than critical, 4e-08 N.s/m"),
        ("dry", {"d_stop": 1.0}, "d_stop must be 0 on a rigid site"),
        ("soft", {"z": -1e-3}, "m deep, beyond 4e-09 m"),
        ("wet", {"h0": 1e-7, "h_free": 1e-6}, "no meniscus spans h0"),
    ],
)
def test_impossible_tips_are_refused(pair, kind, values, message):
    host, _ = pair(kind)
    host.reset()
    host.slave.setupExperiment()
    host.set(**values)
    host.slave.enterInitializationMode()
    with pytest.raises(FMICallException):
        host.slave.exitInitializationMode()
    assert message in host.errors[0]


def test_what_cannot_be_built_is_refused(tmp_path):
    out = tmp_path / "x.fmu"
    for start, message in [
        ({"V": 0.0, "A_H": 0.0}, r"V must be positive, or A_H"),
        ({"R": -1.0}, r"R must be a finite number above 0"),
        ({"d_stop": 1.0}, r"d_stop must be 0 on a rigid site.*with a curve"),
        ({"c": 1.0}, r"c must be less than critical"),
        ({"curve": 3.0}, r"curve must be a LoadDisplacementCurve"),
        ({"volume": 1e-24}, r"be a variable of this FMU"),
    ]:
        with pytest.raises(DescriptionError, match=message):
            build_native_tip(out, start=start, **ONE)
    assert not out.exists()


# Description -------------------------------------------------------------------------------------


def test_its_variables_are_those_of_the_slave(pair):
    """But for what the tables hold, and for a liquid that is not there."""
    ports = {port.name: port for port in PORTS}
    for kind, absent in (("wet", FIXED), ("dry", FIXED | {"eta", "gamma"})):
        found = pair(kind)[0].variables
        assert set(found) == set(ports) - absent
        assert list(found) == [name for name in ports if name not in absent]
        for name, variable in found.items():
            port = ports[name]
            assert variable.causality == port.causality
            assert variable.description == port.label
            assert variable.unit == (None if port.unit == "-" else port.unit)
            nominal = None if variable.nominal is None else float(variable.nominal)
            assert nominal == port.nominal
    assert float(pair("wet")[0].variables["k"].start) == 1.0


def test_the_profile_is_in_its_tables(tmp_path, open_fmu, pair):
    start = WET | {"profile": "ARC"}
    host = open_fmu(build_native_tip(tmp_path / "arc.fmu", start=start, **ONE)).start()
    exact, _ = pair("wet")
    slave = TipContact(instance_name="arc")
    slave.setup_experiment(0.0)
    slave.values |= WET | {"profile": TipLaw.ARC}
    slave.enter_initialization_mode()
    slave.exit_initialization_mode()
    assert host.get("F_film") == pytest.approx(slave.values["F_film"], rel=1e-9)
    assert host.get("F_film") != pytest.approx(exact.get("F_film"), rel=1e-3)


def test_its_film_is_known_up_to_its_end(tmp_path, open_fmu, pair):
    """Whatever gap beyond which solids let a tip free it was built with."""
    path = build_native_tip(tmp_path / "near.fmu", start=WET | {"h_free": 1e-9}, **ONE)
    host = open_fmu(path).start(z=-1e-8)
    _, slave = pair("wet", h_free=1e-9, z=-1e-8)
    follow(host, slave, steady(-1e-8, 0.2, 30))
    assert host.get("t_free") == pytest.approx(host.get("t_break"))


@pytest.mark.slow
@pytest.mark.parametrize("kind", KINDS)
def test_both_versions_of_fmi_give_the_same_bits(shelf, kind):
    """With event mode, too: no step ends early, so only whole numbers and times wait for it."""
    import fmpy
    import numpy as np

    start, curve = KINDS[kind]
    rows = [(i * STEP, *row) for i, row in enumerate(shaken(1e-7, 5e-8, 2e6, 60))]
    pull = np.array(rows, dtype=[(name, float) for name in ("time", "z", "vz", "az")])
    # F follows the root at once, which event mode sets to the next step.
    outputs = [port.name for port in PORTS if port.causality == "output" and port.name != "F"]
    runs = []
    for fmi, more in ((2, {}), (3, {}), (3, {"use_event_mode": True})):
        path = shelf(build_native_tip, curve=curve, start=start, fmi=fmi, **ONE)
        assert validate(path) == []
        found = fmpy.simulate_fmu(
            str(path),
            stop_time=50 * STEP,
            step_size=STEP,
            output_interval=STEP,
            start_values={"z": 5e-8},
            input=pull,
            output=outputs,
            early_return_allowed=True,
            **more,
        )
        # In event mode there is a row before and one after an event.
        runs.append({row["time"]: [row[name] for name in outputs] for row in found})
    assert len(runs[0]) == 51
    assert runs[0] == runs[1] == runs[2]


@pytest.mark.slow
def test_a_mirror_flips_as_with_the_slave(tmp_path):
    """A pair of them, coupled to the mirror, through the first landing of the other side."""
    mirror = open_scene("micromirror").scene
    one_flip = evolve(mirror.mirror.waveform, start_delay=0.0, flips=1)
    moved, start = evolve(mirror.mirror, waveform=one_flip), tip_start(mirror, 0.5)
    python = build("tip-contact", tmp_path / "python.fmu", start=start)
    native = build_native_tip(tmp_path / "native.fmu", start=start, **ONE)
    theirs, ours = (couple_fmus(mirror, fmu, moved, 6e-6, STEP) for fmu in (python, native))
    assert ours.free_time == pytest.approx(theirs.free_time, rel=1e-9)
    assert ours.motion["tilt"] == pytest.approx(theirs.motion["tilt"], rel=1e-8)
    assert ours.sites[1]["n_land"] == theirs.sites[1]["n_land"] >= 1


@pytest.mark.slow
def test_the_command_line_builds_it(tmp_path, monkeypatch, capsys):
    from contactkit import cli
    from contactkit.fmu.native import build as native_build

    monkeypatch.setattr(native_build, "has_zig", lambda: False)
    out = tmp_path / "tip.fmu"
    for what in ("tip-contact", "micromirror"):
        for fmi in ("2", "3"):
            words = ["fmu", "build", what, "--native", "--fmi", fmi, "--out", str(out)]
            assert cli.main(words) == 0
            logged = capsys.readouterr().out
            assert f"tip-contact, native, FMI {fmi}.0" in logged
            assert "valid" in logged
    words = ["fmu", "build", "micromirror", "--native", "--model", "stiction-mass"]
    assert cli.main([*words, "--out", str(out)]) != 0
    assert "tip-contact has no native form as a film" in capsys.readouterr().err
