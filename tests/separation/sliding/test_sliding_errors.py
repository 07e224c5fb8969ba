"""Every message of a sliding and of a vibration: what is wrong, with which value, and the cure."""

from __future__ import annotations

import math

import attrs
import pytest
from refusals import (
    ANGLE,
    FINITE,
    NON_NEGATIVE,
    POSITIVE,
    misfits,
    named,
    numbers_of,
    refuses,
)

import contactkit as ck
from contactkit.kinds import SLIDING_EFFECTS

pytestmark = pytest.mark.errors

WATER = ck.Liquid(name="water", viscosity=0.89e-3, surface_tension=0.072)
FILM = ck.Meniscus(liquid=WATER, volume=6e-23)
HELD = ck.Sliding(gap=2e-9, speed=1.0)
SHAKEN = ck.Vibration(amplitude=1e-7, frequency=1e3)
STICKS = ck.ContactAngleHysteresis(advancing_lower=1.0, receding_lower=0.8)
DRAG, SPHERE = ck.CouetteForce(), ck.Sphere(radius=1e-7)


def scene(*effects, loading=HELD, meniscus=FILM, upper=None, lower=None):
    faces = {"upper": upper or ck.Flat(), "lower": lower or ck.Flat()}
    interface = ck.Interface(meniscus=meniscus, **faces)
    return ck.SlidingScene(interface=interface, loading=loading, effects=effects)


FIELDS = [
    (HELD, "gap", "m", NON_NEGATIVE, [-1e-9, None]),
    (HELD, "speed", "m/s", POSITIVE, [0.0, -1.0]),
    (HELD, "time", "s", POSITIVE, [0.0, -1.0]),
    (HELD, "travel", "m", POSITIVE, [0.0, -1e-9]),
    (SHAKEN, "amplitude", "m", POSITIVE, [0.0, -1e-9, None]),
    (SHAKEN, "frequency", "Hz", POSITIVE, [0.0, -1e3, None]),
    (SHAKEN, "phase", "rad", FINITE, [None]),
    (SHAKEN, "rest_gap", "m", NON_NEGATIVE, [-1e-9, None]),
    (STICKS, "advancing_lower", "rad", ANGLE, [-0.1, 3.2]),
    (STICKS, "receding_lower", "rad", ANGLE, [-0.1, 3.2]),
    (STICKS, "advancing_upper", "rad", ANGLE, [-0.1, 3.2]),
    (STICKS, "receding_upper", "rad", ANGLE, [-0.1, 3.2]),
    (STICKS, "shape_factor", "", POSITIVE, [0.0, -1.0, None]),
]


def test_an_impossible_number_is_refused():
    assert misfits(FIELDS) == {}


def test_the_list_above_is_complete():
    assert numbers_of({ck.Sliding, ck.Vibration, *SLIDING_EFFECTS}) == named(FIELDS)


def test_one_of_speed_and_time_is_imposed():
    one = "Sliding must be given exactly one of speed [m/s] or time [s], got"
    refuses(lambda: ck.Sliding(gap=1e-9), one, "none")
    refuses(lambda: ck.Sliding(gap=1e-9, speed=1.0, time=1.0), one, "['speed', 'time']")


def test_an_angle_needs_its_partner():
    refuses(
        lambda: ck.ContactAngleHysteresis(advancing_upper=1.0),
        "receding_upper",
        "be given with the advancing angle of that body",
        "None",
    )
    refuses(
        lambda: ck.ContactAngleHysteresis(advancing_lower=0.5, receding_lower=0.6),
        "receding_lower",
        "not exceed the advancing angle, 0.5 rad",
        "0.6",
    )
    refuses(ck.ContactAngleHysteresis, "be given the advancing and receding angle [rad]")
    refuses(lambda: ck.CouetteForce(closure="exact"), "'local-film', 'lubrication', 'as-published'")


GAPS = {"initial_gap": 1e-6, "final_gap": 1e-5}


def test_a_vibration_does_not_touch():
    shaken = ck.Vibration(amplitude=1e-6, frequency=1e3)
    message = ("Vibration.amplitude must be below initial_gap = 1e-06 m", "[m], got 1e-06", "touch")
    refuses(lambda: ck.ImposedSpeed(**GAPS, speed=1.0, vibration=shaken), *message)
    less = ck.Vibration(amplitude=0.5e-6, frequency=1e3, rest_gap=0.6e-6)
    rests = {"speed": 1.0, "vibration": less}
    refuses(lambda: ck.ImposedSpeed(**GAPS, **rests), "less rest_gap = 6e-07 m")


def test_a_vibration_that_cavitates_the_film_at_once_is_refused():
    film = ck.Meniscus(liquid=WATER, volume=1e-12)
    shaken = ck.Vibration(amplitude=0.9e-6, frequency=1e3, phase=math.pi / 2)
    loading = ck.ImposedSpeed(**GAPS, speed=1e-3, vibration=shaken)
    cavitated = ck.SeparationScene(
        interface=ck.Interface(meniscus=film),
        loading=loading,
        effects=(ck.ViscousForce(), ck.Rupture(gap=1.5e-6)),
    )
    made = ck.plan(cavitated)
    message = ("loading.vibration takes the gap to 1.9e-06 m", "reaches 1.5e-06 m", "shake less")
    refuses(lambda: ck.simulate(made), *message, error=ck.InfeasibleError)


@pytest.mark.parametrize(
    ("made", "parts"),
    [
        (lambda: scene(), ("at least one force along the bodies", "CouetteForce")),
        (lambda: scene(DRAG, DRAG), ("listed more than once: CouetteForce",)),
        (lambda: scene(DRAG, ck.MeniscusForce()), ("MeniscusForce needs a SeparationScene",)),
        (
            lambda: scene(STICKS, ck.ShearLimit(strength=1e6)),
            ("ShearLimit needs CouetteForce() beside it",),
        ),
        (
            lambda: scene(
                DRAG, ck.ShearLimit(strength=1e6), loading=ck.Sliding(gap=1e-9, time=1.0)
            ),
            ("ShearLimit needs loading.speed [m/s]", "path"),
        ),
        (
            lambda: scene(
                ck.CouetteForce(closure="lubrication"), ck.ShearLimit(strength=1e6), upper=SPHERE
            ),
            ('closure="local-film"', "no closed form"),
        ),
        (
            lambda: scene(DRAG, meniscus=ck.Meniscus(liquid=WATER)),
            ("CouetteForce needs interface.meniscus.volume [m3], or the radius [m] of a Flat",),
        ),
        (
            lambda: scene(DRAG, meniscus=ck.Meniscus(liquid=WATER), upper=SPHERE),
            ("CouetteForce needs interface.meniscus.volume [m3]",),
        ),
        (
            lambda: scene(DRAG, meniscus=ck.Meniscus(liquid=ck.Liquid(name="x"), volume=1e-22)),
            ("CouetteForce needs liquid.viscosity [Pa.s]",),
        ),
        (
            lambda: scene(STICKS, meniscus=ck.Meniscus(liquid=ck.Liquid(name="x"), volume=1e-22)),
            ("ContactAngleHysteresis needs liquid.surface_tension [N/m]",),
        ),
        (
            lambda: scene(DRAG, meniscus=ck.Meniscus(liquid=WATER, pressure=-1e6)),
            ("needs interface.meniscus.volume [m3] in place of its pressure",),
        ),
        (lambda: scene("drag"), ("'drag' is not an effect of a sliding scene",)),
    ],
)
def test_a_scene_that_does_not_fit_is_refused(made, parts):
    refuses(lambda: ck.plan(made()), *parts, error=ck.PlanError)


@pytest.mark.parametrize("closure", ["local-film", "lubrication"])
def test_a_closed_gap_is_infinite_drag(closure):
    touching = ck.Sliding(gap=0.0, speed=1.0)
    drag = ck.CouetteForce(closure=closure)
    message = ("loading.gap is 0 m", "ln(1/gap)", "cut-off gap [m]")
    refuses(
        lambda: ck.plan(scene(drag, loading=touching, upper=SPHERE)),
        *message,
        error=ck.InfeasibleError,
    )
    refuses(
        lambda: ck.plan(scene(drag, loading=touching)), "between flats", error=ck.InfeasibleError
    )


def test_a_force_along_the_bodies_does_not_open_a_gap():
    loading = ck.ImposedSpeed(**GAPS, speed=1.0)
    mixed = ck.SeparationScene(
        interface=ck.Interface(meniscus=FILM), loading=loading, effects=(ck.ViscousForce(), DRAG)
    )
    refuses(lambda: ck.plan(mixed), "CouetteForce needs a SlidingScene", error=ck.PlanError)
    eyring = ck.ShearLimit(strength=1e6, law="eyring")
    limited = attrs.evolve(mixed, effects=(ck.ViscousForce(), eyring))
    refuses(lambda: ck.plan(limited), 'needs law="truncated"', error=ck.PlanError)


def test_what_was_not_simulated_says_what_to_add():
    result = ck.simulate(ck.plan(scene(STICKS, loading=ck.Sliding(gap=3e-9, time=1.0))))
    absent = ck.NotSimulatedError
    refuses(lambda: result["couette_force"], "add CouetteForce()", error=absent)
    refuses(lambda: result.of(ck.CouetteForce), "add CouetteForce()", error=absent)
    refuses(lambda: result["tangential_force"], "impose loading.speed", error=absent)
    refuses(lambda: result["pul"], "be one of")
    assert not hasattr(result, "pull")


def test_division_is_refused_where_menisci_overlap():
    whole = scene(DRAG, upper=SPHERE)
    refuses(lambda: ck.divide_sliding(whole, 0), "be a whole number of at least 1")
    message = ("10000 asperities have menisci that overlap", "at most", "stand apart")
    refuses(lambda: ck.divide_sliding(whole, 10_000), *message, error=ck.InfeasibleError)
