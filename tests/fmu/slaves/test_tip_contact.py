"""The FMU ``tip-contact``: what the script does, in a host; restorable, and clear about misuse."""

from __future__ import annotations

import math
import subprocess
import sys

import fmpy
import pytest

from contactkit.app.scenes import open_scene
from contactkit.errors import DescriptionError, PlanError
from contactkit.fmu.python import build as building
from contactkit.fmu.slaves.tip_contact import TipContact, TipLaw, TipStatus, tip_scene
from contactkit.models.micromirror.flight import Root
from contactkit.models.micromirror.report.cosimulation import tip_start
from contactkit.models.micromirror.tip import advance_tip, landed_start
from contactkit.models.micromirror.tip_film import adhesion, tip_law
from contactkit.models.micromirror.tip_film import tip_scene as scene_of_tip

OK, DISCARD = 0, 2
STEP = 2e-8


@pytest.fixture(scope="module")
def scene():
    return open_scene("micromirror").scene


@pytest.fixture(scope="module")
def tip_fmu(shelf, scene):
    return shelf(building.build, "tip-contact", start=tip_start(scene, 0.5))


@pytest.fixture
def host(tip_fmu, open_fmu):
    return open_fmu(tip_fmu)


def lift(host, n, speed=0.2, height=-5e-8):
    """Raise the root steadily over n steps."""
    for i in range(n):
        host.set(z=height + speed * i * STEP, vz=speed)
        assert host.step(STEP, i * STEP) == OK


def test_it_is_valid_and_states_its_direct_feedthrough(tip_fmu):
    assert building.validate(tip_fmu) == []
    description = fmpy.read_model_description(str(tip_fmu))
    follows = {u.variable.name: [v.name for v in u.dependencies] for u in description.outputs}
    assert sorted(follows["F"]) == ["vz", "z"]
    assert follows["F_mean"] == []
    assert "numpy" in description.description


def test_its_parameters_are_those_of_the_micromirror(scene):
    """All but the volume, which follows from the humidity."""
    values, given = TipContact.start_values(), tip_start(scene, 0.5)
    for name in ("m", "k", "c", "h0", "h_free", "R", "A_H", "N"):
        assert values[name] == pytest.approx(given[name], rel=1e-12), name
    for name in ("gamma", "eta", "theta1", "theta2"):
        assert values[name] == pytest.approx(given[name], rel=0.01), name
    assert values["V"] == 0.0
    assert TipLaw[given["profile"]] == values["profile"]


def test_the_scene_comes_back_from_its_parameters(scene):
    values = TipContact.start_values() | tip_start(scene, 0.5)
    values["profile"] = TipLaw[values["profile"]]
    made, theirs = tip_scene(values), scene_of_tip(scene.tip, 0.5)
    assert {type(e) for e in made.effects} == {type(e) for e in theirs.effects}
    assert made.interface.meniscus.volume == theirs.interface.meniscus.volume
    assert made.loading.mass == theirs.loading.mass


def test_the_fmu_gives_what_the_script_gives(scene, host):
    made, damping = tip_law(scene.tip, 0.5), scene.mirror.tips.damping
    host.start()
    state = landed_start(made)
    lift(host, 30)
    for i in range(30):
        before = state
        state = advance_tip(made, damping, state, Root(-5e-8 + 0.2 * i * STEP, 0.2), STEP)
    assert state.free
    assert host.get("state") == TipStatus.FREE
    assert host.get("h") == pytest.approx(state.gap, rel=1e-9)
    assert host.get("t_free") == pytest.approx(state.free_time, rel=1e-9)
    assert host.get("t_break") < host.get("t_free")
    assert host.get("J") == pytest.approx(2.0 * state.impulse, rel=1e-9)
    last = 2.0 * (state.impulse - before.impulse) / STEP
    assert host.get("F_mean") == pytest.approx(last, rel=1e-9)


def test_the_means_add_up_to_the_impulse(host):
    host.start()
    given = 0.0
    for i in range(25):
        host.set(z=-5e-8 + 0.2 * i * STEP, vz=0.2)
        host.step(STEP, i * STEP)
        given += host.get("F_mean") * STEP
    assert given == pytest.approx(host.get("J"), rel=1e-9)


def test_the_force_follows_the_root_at_once(host):
    host.start()
    host.set(z=-5e-8)
    assert host.get("F") == pytest.approx(-1e-7, rel=1e-9)
    host.set(z=1e-8)
    assert host.get("F") == pytest.approx(2e-8, rel=1e-9)
    assert host.get("h") == pytest.approx(4e-10)


def test_a_film_is_known_up_to_its_end(wet_slave):
    """A tip is held up to there, so a smaller gap beyond which solids let it free is no other."""
    near, far = wet_slave(h_free=1e-9), wet_slave(h_free=1e-8)
    for i in range(30):
        for slave in (near, far):
            slave.values.update(z=-1e-8 + 0.2 * i * STEP, vz=0.2)
            assert slave.do_step(i * STEP, STEP), slave.failure
        for name in ("h", "v", "J", "F_film", "W_visc"):
            assert near.values[name] == pytest.approx(far.values[name], rel=1e-6, abs=1e-30), i
    assert near.values["t_break"] == pytest.approx(near.values["t_free"])
    assert near.values["state"] == TipStatus.FREE


@pytest.fixture
def wet_slave():
    """Start a slave with a meniscus whose arc ends at 36 nm."""

    def started(**values):
        slave = TipContact(instance_name="wet")
        slave.setup_experiment(0.0)
        slave.values |= {"V": 1.3e-24, "profile": TipLaw.ARC, "z": -1e-8, **values}
        slave.enter_initialization_mode()
        slave.exit_initialization_mode()
        return slave

    return started


def test_tips_start_free_over_their_site_and_land(host):
    host.start(z=1e-7)
    assert host.get("state") == TipStatus.FREE
    assert host.get("h") == pytest.approx(1e-7 + 4e-10)
    lift(host, 20, speed=-0.5, height=1e-7)
    assert host.get("state") == TipStatus.LANDED
    assert host.get("n_land") >= 1
    assert 0.0 < host.get("t_land") < 4e-7
    assert host.get("W_land") > 0.0
    assert any("landed at t = " in entry.message for entry in host.log)


def test_a_tip_is_held_with_the_adhesion_of_its_humidity(host, scene):
    """The force of the spring where it leaves is that of film and solids."""
    for humidity in (0.0, 0.3, 0.9):
        values = tip_start(scene, humidity)
        start = {name: value for name, value in values.items() if name not in ("profile", "N")}
        host.reset().start(**start)
        hold, largest = 2.0 * adhesion(scene.tip, humidity).force, 0.0
        for i in range(60):
            host.set(z=-1e-8 + 0.1 * i * STEP, vz=0.1)
            host.step(STEP, i * STEP)
            if host.get("state") == TipStatus.LANDED:
                largest = max(largest, host.get("F"))
        assert host.get("state") == TipStatus.FREE
        assert hold - 2.0 * 0.1 * STEP < largest <= hold


def test_going_back_to_a_state_gives_the_same_again(host):
    host.start()
    lift(host, 18)
    state, time = host.slave.getFMUState(), host.time
    again = []
    for _ in range(2):
        host.slave.setFMUState(state)
        host.time = time
        for i in range(18, 34):
            host.set(z=-5e-8 + 0.2 * i * STEP, vz=0.2)
            assert host.step(STEP, i * STEP) == OK
        again.append(host.outputs())
    assert again[0] == again[1]
    assert again[0]["state"] == TipStatus.FREE
    host.slave.freeFMUState(state)


@pytest.mark.parametrize(
    ("start", "message"),
    [
        ({"V": 0.0, "A_H": 0.0}, "V must be positive, or A_H"),
        ({"h_free": 3e-10}, "h_free must exceed h0 = 4e-10 m"),
        ({"c": 1.0}, "c must be less than critical, 4e-08 N.s/m"),
    ],
)
def test_an_impossible_tip_is_refused(host, start, message):
    host.slave.setupExperiment(startTime=0.0)
    host.set(z=1e-7, **start)
    host.slave.enterInitializationMode()
    host.slave.exitInitializationMode()
    status = host.step(STEP, 0.0)
    assert status == DISCARD
    assert message in host.errors[0]


def test_a_scene_it_cannot_hold_is_refused(scene):
    from attrs import evolve

    import contactkit as ck

    limited = evolve(scene, effects=(*scene.effects, ck.TensionLimit(cavity="truncated")))
    with pytest.raises(PlanError, match="tip-contact has no TensionLimit"):
        tip_start(limited, 0.5)
    printed = tuple(
        evolve(e, profile="as-published") if isinstance(e, ck.MeniscusForce) else e
        for e in scene.effects
        if not isinstance(e, ck.ViscousForce)
    )
    with pytest.raises(DescriptionError, match=r"profile must be .* got 'as-published'"):
        tip_start(evolve(scene, effects=printed), 0.5)


def test_a_start_value_must_be_possible(tmp_path):
    with pytest.raises(DescriptionError, match=r"R must be a finite number above 0"):
        building.build("tip-contact", tmp_path / "x.fmu", start={"R": 0.0})


def test_angles_are_kept_in_range(tmp_path):
    with pytest.raises(DescriptionError, match="theta1"):
        building.build("tip-contact", tmp_path / "x.fmu", start={"theta1": 1.1 * math.pi})


def test_a_dry_tip_needs_no_numpy():
    """Only the law of the meniscus on a sphere does, as the FMU's summary says."""
    code = """
import sys
sys.modules["numpy"] = sys.modules["scipy"] = None
from contactkit.fmu.slaves.tip_contact import TipContact
slave = TipContact(instance_name="dry")
slave.values["z"] = -1e-8
slave.setup_experiment(0.0)
slave.enter_initialization_mode()
slave.exit_initialization_mode()
assert not slave.failure, slave.failure
for i in range(40):
    slave.values.update(z=-1e-8 + 0.1 * i * 2e-8, vz=0.1)
    assert slave.do_step(i * 2e-8, 2e-8), slave.failure
assert slave.values["t_free"] > 1e-7
"""
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
