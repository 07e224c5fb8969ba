"""Model exchange of the native ``stiction-force``: a host that integrates, events, slopes."""

from __future__ import annotations

import ctypes
import math
import random

import numpy as np
import pytest
from master_cases import ramp
from native_scenes import FORCES, HAS_CC, SCENES, scene

pytest.importorskip("pythonfmu")
fmpy = pytest.importorskip("fmpy")
if not HAS_CC:
    pytest.skip("there is no C compiler", allow_module_level=True)

from exchange_host import Film, Pulled  # noqa: E402
from fmpy.fmi1 import FMICallException  # noqa: E402

import contactkit as ck  # noqa: E402
from contactkit.fmu.framework.toolchain import local  # noqa: E402
from contactkit.fmu.native.build import build_native  # noqa: E402
from contactkit.fmu.native.models import INDICATORS  # noqa: E402
from contactkit.fmu.python.build import validate  # noqa: E402
from contactkit.fmu.slaves.stiction_force import Exchange  # noqa: E402
from contactkit.separation.effects.base import FilmStatus, LimitKind  # noqa: E402

pytestmark = pytest.mark.slow

DISCARD, ERROR = 2, 3
ONE = {"platforms": [local()], "compiler": "cc", "model": "stiction-force"}
CAVITY = scene(effects=(*FORCES, ck.TensionLimit(strength=1e6)))


@pytest.fixture(scope="module")
def built(shelf):
    """FMU of a scene, or of its name."""

    def of(what, fmi=2):
        one = SCENES[what] if isinstance(what, str) else what
        return shelf(build_native, one, fmi=fmi, **ONE)

    return of


@pytest.fixture
def film(built, shelf):
    """Open instances for model exchange, and close them after the test."""
    opened = []

    def of(what, fmi=2, **start):
        opened.append(Film(shelf.unpacked(built(what, fmi)), **start))
        return opened[-1]

    yield of
    for one in opened:
        one.close()


@pytest.mark.parametrize("fmi", [2, 3])
def test_one_fmu_offers_both_kinds(fmi, built):
    assert validate(built("drop", fmi)) == []
    found = fmpy.read_model_description(str(built("drop", fmi)))
    assert found.modelExchange.modelIdentifier == found.coSimulation.modelIdentifier
    assert (found.numberOfContinuousStates, found.numberOfEventIndicators) == (2, len(INDICATORS))
    rates = [unknown.variable for unknown in found.derivatives]
    assert {rate.name: rate.derivative.name for rate in rates} == {"F_m": "J_m", "F_v": "J"}
    locals_ = [v.name for v in found.modelVariables if v.causality == "local"]
    assert locals_ == ([*INDICATORS] if fmi == 3 else [])


def test_others_do_not(built, shelf):
    assert fmpy.read_model_description(str(built(CAVITY))).modelExchange is None
    mass = shelf(build_native, SCENES["drop"], platforms=[local()], compiler="cc")
    assert fmpy.read_model_description(str(mass)).modelExchange is None


# Motion ---------------------------------------------------------------------------------------


@pytest.mark.parametrize("fmi", [2, 3])
@pytest.mark.parametrize("name", ["A", "B", "D", "E"])
def test_a_mass_outside_is_released_on_time(name, fmi, film, release_cases, release_scene):
    """CVode integrates mass and film together: stiff films need no short steps."""
    case, values = release_cases[name]["case"], release_cases[name]["values"]
    held, pull = film(release_scene(name), fmi), ramp(case["F0"], case["tau"])

    def acceleration(time, gap, force):
        return (pull(time) - case["k_s"] * (gap - case["h0"]) - force) / case["m"]

    body = Pulled(held, acceleration, gap=case["h0"], release_gap=case["h_rel"])
    found = body.run(2.0 * values["t_rel"])
    assert found.release_time == pytest.approx(values["t_rel"], rel=1e-5)
    assert body.state[1] == pytest.approx(values["v_rel"], rel=1e-6)
    assert found.evaluations < 4000
    assert held.get("n_doubt") == 0


def test_the_impulse_of_the_liquid_depends_on_the_gaps_alone(film):
    """Stefan's law, integrated by hand."""
    held = film("flooded", gamma=0.0)
    body = Pulled(held, lambda time, gap, force: 0.0, gap=20e-6, speed=0.1)
    body.run(1e-3)
    whole = 0.75 * math.pi * 0.1 * 3.175e-3**4 * (20e-6**-2 - body.state[0] ** -2)
    assert held.get("J") == pytest.approx(whole, rel=2e-6)
    assert held.get("J_m") == pytest.approx(0.0, abs=1e-12 * whole)


def swing(gap, high, period):
    """Start and acceleration of a gap that swings between two values."""
    size, pace = 0.5 * (high - gap), 2.0 * math.pi / period
    return (
        lambda time: gap + size * (1.0 - math.cos(pace * time)),
        lambda time, at, force: size * pace**2 * math.cos(pace * time),
    )


SWINGS = {"rewetting": (3e-6, 8e-4), "tip that sticks": (5e-11, 1e-6), "shear": (1e-7, 1e-6)}


@pytest.mark.parametrize("name", SWINGS)
def test_events_are_those_of_co_simulation(name, built, film, open_fmu):
    """Rupture, re-wetting, pull-off and re-contact, there and back and there again."""
    low, high = SWINGS[name]
    first = SCENES[name].loading.initial_gap
    gap, acceleration = swing(low, high, 1e-3)
    lag = 1e-3 * math.acos(1.0 - 2.0 * (first - low) / (high - low)) / (2.0 * math.pi)
    speed = (gap(lag + 1e-9) - gap(lag - 1e-9)) / 2e-9
    held = film(name)
    body = Pulled(
        held, lambda t, at, f: acceleration(t + lag, at, f), gap=first, speed=speed, rtol=1e-9
    )
    found = body.run(1.6e-3)
    host, steps = open_fmu(built(name)).start(exchange=int(Exchange.IMPULSE)), 4000
    for i in range(1, steps + 1):
        now = 1.6e-3 * i / steps + lag
        host.set(h=gap(now), v=(gap(now) - gap(now - 1.6e-3 / steps)) / (1.6e-3 / steps))
        assert host.step(1.6e-3 / steps) == 0
    for output in ("state", "n_break"):
        assert held.get(output) == host.get(output), output
    assert held.get("t_break") == pytest.approx(host.get("t_break"), abs=2e-8)
    assert held.get("J_m") == pytest.approx(host.get("J_m"), rel=2e-4)
    whole = max(abs(row[-1]) for row in found.points)
    assert held.get("J") == pytest.approx(host.get("J"), abs=2e-3 * whole)
    if name == "rewetting":
        assert held.get("n_break") == 2
        assert [0] in [which for _, which in found.events]
    if name == "tip that sticks":
        assert any(1 in which for _, which in found.events)


def test_discrete_outputs_change_at_events_only(film):
    held = film("shear")
    before = held.get("limit")
    held.set(h=1e-7, v=1.0)
    assert held.get("limit") == before == LimitKind.NONE
    assert held.indicators()[3] == -1.0
    held.event()
    assert (held.get("limit"), held.indicators()[3]) == (LimitKind.SHEAR, 1.0)


def test_the_film_breaks_in_event_mode(film):
    """Up to there the force continues smoothly, so that a solver can look beyond."""
    held = film("rewetting")
    end = ck.plan(SCENES["rewetting"]).film.end
    held.set(h=1.001 * end, v=0.0)
    assert held.indicators()[0] == pytest.approx(1e-3)
    assert held.get("F") != 0.0
    assert held.get("n_break") == 0
    held.fmu.setTime(0.25)
    held.event()
    assert (held.get("F"), held.get("n_break"), held.get("t_break")) == (0.0, 1, 0.25)
    assert held.get("state") == FilmStatus.BROKEN
    held.set(h=0.99 * SCENES["rewetting"].loading.initial_gap)
    assert held.indicators()[0] == pytest.approx(-0.01)
    held.event()
    assert held.get("F") != 0.0


def test_a_kink_is_an_event(film):
    """The rim of a drop that just fills the face at the start."""
    held = film("drop")
    found = []
    for gap in (4.8e-6, 5e-6, 5.002e-6, 5.2e-6):  # the meniscus leaves the rim at 5.005 um
        held.set(h=gap)
        found.append(held.indicators()[2])
    assert found[:3] == pytest.approx([-0.04, 0.0, 4e-4], abs=1e-9)
    assert found[3] < 0.0


def test_fmpy_simulates_it(built):
    """Between resting bodies the impulse of the meniscus grows evenly."""
    options = {"stop_time": 1e-3, "start_values": {"h": 2e-5}, "output": ["J_m", "J", "F_m"]}
    found = fmpy.simulate_fmu(str(built("drop")), fmi_type="ModelExchange", **options)
    np.testing.assert_allclose(found["J_m"], found["F_m"] * found["time"], rtol=1e-6, atol=1e-15)
    assert found["F_m"][-1] > 0.0
    assert not found["J"].any()


# Slopes and states ------------------------------------------------------------------------------


@pytest.mark.parametrize("fmi", [2, 3])
def test_slopes_are_those_of_differences(fmi, film):
    held = film("shear", fmi)
    gap, speed = 1.2e-7, 1e-5
    held.set(h=gap, v=speed)
    held.event()

    def rates(**moved):
        held.set(h=gap, v=speed)
        held.set(**moved)
        return held.derivatives()

    by_gap = (rates(h=gap * 1.00001) - rates(h=gap * 0.99999)) / (2e-5 * gap)
    by_speed = (rates(v=speed * 1.00001) - rates(v=speed * 0.99999)) / (2e-5 * speed)
    rates()
    for i, name in enumerate(("F_m", "F_v")):
        assert held.slope(name, "h") == pytest.approx(by_gap[i], rel=1e-6)
        assert held.slope(name, "v") == pytest.approx(by_speed[i], rel=1e-6, abs=1e-12)
        assert held.slope(name, "J") == held.slope("J", "h") == 0.0
    assert held.slope("J", "J") == 1.0
    assert held.slope("J", "J_m") == 0.0
    assert held.derivatives() == pytest.approx([held.get("F_m"), held.get("F_v")], rel=1e-15)


@pytest.mark.parametrize("fmi", [2, 3])
def test_a_state_brings_back_film_and_impulses(fmi, film):
    held = film("rewetting", fmi)
    held.set(h=1e-5, v=0.1)
    held.set_states([1.0, 2.0])
    saved = held.fmu.getFMUState()
    before = [*held.states(), *held.derivatives(), *held.indicators()]
    held.set(h=1e-2)
    held.set_states([3.0, 4.0])
    held.event()
    assert held.get("n_break") == 1
    held.fmu.setFMUState(saved)
    assert [*held.states(), *held.derivatives(), *held.indicators()] == before
    held.fmu.freeFMUState(saved)


# What it refuses --------------------------------------------------------------------------------


@pytest.mark.parametrize("fmi", [2, 3])
def test_a_motion_beyond_the_tables_is_discarded(fmi, film):
    """A solver tries a shorter step: nothing has failed."""
    held = film("drop", fmi)
    held.set(h=1e-5, v=0.1)
    before = [*held.derivatives()]
    for gap in (-1e-6, 0.0, math.nan, math.inf):
        with pytest.raises(FMICallException) as refused:
            held.set(h=gap)
        assert refused.value.status == DISCARD
    with pytest.raises(FMICallException) as refused:
        held.set_states([math.nan, 0.0])
    assert refused.value.status == DISCARD
    assert [*held.derivatives()] == before


def test_a_cavity_that_remembers_is_refused_with_the_cure(built, shelf, capsys):
    from fmpy.fmi2 import FMU2Model

    about = fmpy.read_model_description(str(built(CAVITY)))
    fmu = FMU2Model(
        guid=about.guid,
        unzipDirectory=str(shelf.unpacked(built(CAVITY))),
        modelIdentifier="stiction_force",
        instanceName="one",
    )
    fmu.instantiate()
    fmu.setupExperiment()
    fmu.enterInitializationMode()
    with pytest.raises(FMICallException):
        fmu.exitInitializationMode()
    assert "dp_inception must be 0 in model exchange" in capsys.readouterr().out
    fmu.freeInstance()


def test_each_kind_refuses_the_calls_of_the_other(film, built, open_fmu):
    held = film("drop")
    numbers = (ctypes.c_double * 4)()
    host = open_fmu(built("drop")).start()
    own = ctypes.c_void_p(host.slave.component)
    for call in ("GetDerivatives", "GetEventIndicators", "SetContinuousStates"):
        assert getattr(host.slave.dll, f"fmi2{call}")(own, numbers, ctypes.c_size_t(2)) == ERROR
    assert "is for model exchange" in host.errors[-1]
    assert host.step(1e-6) == 0  # nothing has failed
    step = held.fmu.dll.fmi2DoStep
    time, length = ctypes.c_double(0.0), ctypes.c_double(1e-6)
    assert step(ctypes.c_void_p(held.fmu.component), time, length, 0) == DISCARD


def test_another_number_of_states_is_refused(film):
    held = film("drop")
    numbers = (ctypes.c_double * 8)()
    with pytest.raises(FMICallException):
        held.fmu.getEventIndicators(numbers, 3)


def test_random_calls_end_no_process(film):
    """Any order of calls and any numbers: outputs stay finite, and a reset starts anew."""
    held = film("rewetting")
    chance, odd = random.Random(3), [0.0, -1.0, 1e-9, 5e-6, 1e-3, math.nan, math.inf, 1e300]
    fmu = held.fmu
    calls = [
        lambda: held.set(h=chance.choice(odd)),
        lambda: held.set(v=chance.choice(odd)),
        lambda: held.set(eta=chance.choice(odd)),
        lambda: held.set_states([chance.choice(odd), 0.0]),
        lambda: fmu.setTime(chance.choice(odd)),
        lambda: fmu.enterEventMode(),
        lambda: fmu.newDiscreteStates(),
        lambda: fmu.enterContinuousTimeMode(),
        lambda: fmu.enterInitializationMode(),
        lambda: fmu.exitInitializationMode(),
        lambda: fmu.completedIntegratorStep(),
        held.derivatives,
        held.indicators,
        held.nominals,
        lambda: held.slope("F_v", "h"),
        lambda: fmu.setFMUState(saved),
        fmu.reset,
    ]
    saved, done = fmu.getFMUState(), 0
    for _ in range(4000):
        try:
            chance.choice(calls)()
            done += 1
        except FMICallException:
            pass
        assert np.isfinite([*held.states(), *held.nominals()]).all()
    assert done > 400
    fmu.reset()
    fmu.setupExperiment()
    fmu.enterInitializationMode()
    fmu.exitInitializationMode()
    held.update()
    assert held.get("F") == film("rewetting").get("F")
