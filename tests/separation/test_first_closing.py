"""A pull that rises lets the bodies close first: the plan says how far, and the run how far it was.

The reference is the motion itself, by scipy.
"""

import math

import numpy as np
import pytest
from scipy.integrate import solve_ivp

import contactkit as ck

pytestmark = pytest.mark.filterwarnings("ignore::contactkit.errors.ValidityWarning")

RADIUS, GAP, PULL, TENSION = 1e-3, 5e-6, 1.0, 0.03
ATTRACTION = 0.0376238  # of the meniscus at the rim of the faces [N]


def scene(film_scene, *, rise, viscosity=0.1, **more):
    given = {"force": PULL, "initial_gap": GAP, "final_gap": 25e-6, "rise_time": rise}
    face = ck.Flat(radius=RADIUS)
    liquid = {"viscosity": viscosity, "surface_tension": TENSION}
    return film_scene(lower=face, upper=face, liquid=liquid, **given | more)


def closing(rise, viscosity, mass):
    """How far a body closes [m] whose attraction is that at the start."""

    def motion(time, state):
        gap, speed = state
        film = 1.5 * math.pi * viscosity * RADIUS**4 * speed / gap**3
        pull = PULL * -math.expm1(-time / rise)
        return speed, (pull - ATTRACTION - film) / mass

    last = -3.0 * rise * math.log1p(-ATTRACTION / PULL)
    found = solve_ivp(motion, (0.0, last), (GAP, 0.0), "Radau", rtol=1e-10, atol=1e-18)
    return GAP - found.y[0].min()


def said(text, before):
    """Number [m] in a text."""
    number, unit = text.split(before)[1].split()[:2]
    return float(number) * {"nm": 1e-9, "pm": 1e-12, "um": 1e-6}[unit.rstrip(":;,")]


@pytest.mark.parametrize(
    ("rise", "viscosity", "mass"),
    [(1e-3, 0.1, 1e-3), (1e-2, 0.1, 1e-3), (1e-3, 1e-5, 1e-3)],
    ids=["film", "film, more slowly", "mass"],
)
def test_plan_and_run_say_how_far_they_close(film_scene, rise, viscosity, mass):
    made = scene(film_scene, rise=rise, viscosity=viscosity, mass=mass)
    plan = ck.plan(made)
    (note,) = [note for note in plan.notes if note.startswith("the bodies close first")]
    assert "attract each other with 37.62 mN at the start" in note
    assert "give loading.rest_gap = 5e-06 m" in note
    assert note in str(plan)
    right = closing(rise, viscosity, mass)
    assert said(note, "they are about ") == pytest.approx(right, rel=0.03)
    message = ck.simulate(plan).message
    assert said(message, "it closed by ") == pytest.approx(right, rel=0.02)


def test_what_the_cure_gives_is_not_remarked_on(film_scene):
    for held in ({"rest_gap": GAP}, {"rise": 0.0}):
        made = scene(film_scene, **{"rise": 1e-3, "mass": 1e-3} | held)
        plan = ck.plan(made)
        assert "close first" not in str(plan)
        result = ck.simulate(plan)
        assert "it closed" not in result.message
        assert np.min(result.gap) == GAP


def test_a_pull_below_the_attraction_says_that(film_scene):
    made = scene(film_scene, rise=1e-3, mass=1e-3, force=0.03)
    assert "and the pull rises to 30 mN only" in str(ck.plan(made))


def test_bodies_that_are_pressed_together_meanwhile(film_scene):
    made = scene(film_scene, rise=1.0, viscosity=1e-6, mass=1e-3)
    assert "closed by more than a tenth of the gap, or touch" in str(ck.plan(made))
