"""Dynamic wetting in the Python FMUs: the same as `simulate`, and what is refused."""

from __future__ import annotations

import pytest

pytest.importorskip("pythonfmu")

from attrs import evolve
from refusals import refuses

import contactkit as ck
from contactkit.fmu.native.film import moving, prepared_film
from contactkit.fmu.slaves.stiction_force import StictionForce
from contactkit.fmu.slaves.stiction_mass import PORTS, StictionMass, mass_values, scene_of
from contactkit.fmu.slaves.wetting import WETTING

pytestmark = pytest.mark.filterwarnings("ignore::contactkit.errors.ValidityWarning")

OIL = ck.Liquid(name="oil", viscosity=0.01, surface_tension=0.03, density=900.0)
FACE = ck.Flat(radius=2e-3)
FIRST, VOLUME = 1e-5, 1e-11
EFFECTS = {
    "angle": (ck.CoxVoinovAngle(slip_length=2e-9, outer_length=1e-5),),
    "film": (ck.LandauLevichFilm(law="aussillous-quere"),),
    "rupture": (ck.DynamicRupture(factor=1.2, exponent=0.6),),
    "column": (ck.TroutonForce(),),
    "weight": (ck.LiquidWeight(body="lower"),),
}


def scene(*effects, angle=0.0, last=2.8e-4):
    meniscus = ck.Meniscus(
        liquid=OIL, volume=VOLUME, contact_angle_lower=angle, contact_angle_upper=angle
    )
    return ck.SeparationScene(
        interface=ck.Interface(lower=FACE, upper=FACE, meniscus=meniscus),
        loading=ck.ImposedForce(force=0.03, mass=0.05, initial_gap=FIRST, final_gap=last),
        effects=(ck.MeniscusForce(), ck.ViscousForce(), *effects),
    )


def values_of(made):
    own = mass_values(made)
    return {p.name: p.read(own.get(p.name, p.start)) for p in PORTS if p.causality == "parameter"}


def started(slave, values, **more):
    known = {port.name for port in slave.ports}
    made = slave(instance_name="one")
    made.setup_experiment(0.0)
    made.values |= {name: value for name, value in values.items() if name in known} | more
    made.enter_initialization_mode()
    made.exit_initialization_mode()
    assert not made.failure
    return made


@pytest.mark.parametrize("name", EFFECTS)
def test_parameters_of_an_fmu_hold_each_effect(name):
    made = scene(*EFFECTS[name])
    held = scene_of(values_of(made))
    assert set(map(type, held.effects)) == set(map(type, made.effects))
    for effect in EFFECTS[name]:
        assert held.effect(type(effect)) == effect


def test_without_its_parameters_nothing_of_it_is_there():
    values = values_of(scene())
    off = {port.name: port.start for port in PORTS if port.name in WETTING} | {"rho": 900.0}
    assert {name: values[name] for name in WETTING} == off
    assert len(scene_of(values).effects) == 2


@pytest.mark.slow
@pytest.mark.parametrize("name", EFFECTS)
def test_a_mass_in_an_fmu_moves_as_in_a_run(name):
    made = scene(*EFFECTS[name], angle=0.4 if name == "angle" else 0.0)
    expected, still = (ck.simulate(ck.plan(one)) for one in (made, scene()))
    slave, time = started(StictionMass, values_of(made)), 0.0
    slave.values["F_ext"] = 0.03
    while slave.values["n_release"] == 0 and time < 1.0:
        assert slave.do_step(time, 2e-3)
        time += 2e-3
        if slave.values["n_break"] == 0:
            left = slave.values["V_left"]
    state = expected.state
    assert slave.values["t_release"] == pytest.approx(state.release_time, rel=1e-7)
    assert slave.values["t_break"] == pytest.approx(state.break_time, rel=1e-7)
    assert state.break_time != pytest.approx(still.state.break_time, rel=1e-7)
    assert left >= VOLUME * state.volume_fraction * (1.0 - 1e-6)
    assert (left < 0.99 * VOLUME) is (name == "film")
    saved = slave.hidden_state()
    slave.restore_hidden_state(saved)
    assert slave.state.volume_fraction == pytest.approx(state.volume_fraction, rel=1e-6)


@pytest.mark.slow
@pytest.mark.parametrize("name", EFFECTS)
def test_a_film_in_an_fmu_gives_the_impulse_of_an_imposed_speed(name):
    """Steps of unequal length at one speed: the path is that of the run, whatever the steps."""
    angle, speed = 0.4 if name == "angle" else 0.0, 5e-3
    made = scene(*EFFECTS[name], angle=angle)
    imposed = ck.ImposedSpeed(speed=speed, initial_gap=FIRST, final_gap=2.8e-4)
    expected = ck.simulate(ck.plan(evolve(made, loading=imposed)))
    slave = started(StictionForce, values_of(made), h=FIRST, v=speed)
    gap, time = FIRST, 0.0
    while gap < 2.8e-4:
        step = min(0.07 * gap, 2.8e-4 - gap) / speed
        gap = min(gap + speed * step, 2.8e-4)
        slave.values |= {"h": gap, "v": speed}
        assert slave.do_step(time, step), slave.failure
        time += step
    total = sum(value for key, value in expected.impulses.items() if key != "newtonian_impulse")
    assert slave.values["J"] + slave.values["J_m"] == pytest.approx(total, rel=2e-4)
    breaks = (expected.plan.film.end - FIRST) / speed
    assert slave.values["t_break"] == pytest.approx(breaks, rel=2e-4)
    assert slave.values["F"] == 0.0 == slave.values["V_left"]


def test_a_native_fmu_refuses_by_name_what_depends_on_the_motion():
    for name in ("angle", "film", "rupture"):
        made = scene(*EFFECTS[name])
        refuses(
            lambda made=made: prepared_film(moving(made, None)),
            "native FMU has no form of", type(EFFECTS[name][0]).__name__, "Python FMU",
            "ck.simulate", error=ck.PlanError,
        )  # fmt: skip


@pytest.mark.parametrize(
    ("values", "words"),
    [
        ({"slip_from": 1e-5}, ("slip_from", "slip is 0", "1e-05")),
        ({"a_break": 1.0, "h_break": 1e-4}, ("a_break", "h_break is not")),
        ({"weight": 2}, ("rho", "exceed 0", "weight")),
    ],
)
def test_parameters_that_contradict_each_other_are_refused(values, words):
    start = {port.name: port.start for port in PORTS}
    refuses(lambda: StictionMass.check_start(start | values), *words)
