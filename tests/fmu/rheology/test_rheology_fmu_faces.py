"""Native FMUs of films on faces that are no discs whose viscosity follows pressure or shear."""

from __future__ import annotations

import math

import pytest
from attrs import evolve
from native_scenes import HAS_CC
from refusals import refuses
from rheology_scenes import BARUS, CARREAU, CUT_OFF, EYRING, GAP, POWER_LAW, RADIUS, ROELANDS, scene
from selection import quick

pytest.importorskip("pythonfmu")
pytest.importorskip("fmpy")

import contactkit as ck
from contactkit.accuracy import Accuracy
from contactkit.errors import PlanError
from contactkit.fmu.framework.toolchain import local
from contactkit.fmu.native.build import build_native
from contactkit.fmu.native.film import free_liquid, moving, prepared_film
from contactkit.fmu.native.rheology import check_face
from contactkit.fmu.slaves.rheology import with_rheology
from contactkit.fmu.slaves.stiction_mass import mass_values
from contactkit.separation.effects.prepared import prepare_scene
from contactkit.separation.motion.advance import advance
from contactkit.separation.motion.state import Pull, outputs, start
from contactkit.separation.plan import plan

pytestmark = pytest.mark.filterwarnings("ignore::contactkit.errors.ValidityWarning")

PULL = 30.0
DRAFT = Accuracy(film_rtol=2e-2, time_rtol=1e-8)
SQUARE = ck.Flat(planform=ck.Rectangle(length=2.0 * RADIUS, width=2.0 * RADIUS))
RING = ck.Flat(planform=ck.Ring(radius=RADIUS, hole_radius=0.4 * RADIUS))
TILTED = ck.Flat(radius=RADIUS, tilt=(5e-4, 0.0))


def on(face, *effects, **liquid):
    """Film between a face and a flat under a pull."""
    given = scene(*effects, **liquid)
    bodies = ck.Interface(upper=face, meniscus=given.meniscus)
    return evolve(given, interface=bodies)


SCENES = {
    "square, eyring": on(SQUARE, shear=EYRING),
    "ring, power law": on(RING, shear=POWER_LAW),
    "tilted, barus": on(TILTED, pressure=BARUS),
}


def test_a_viscosity_is_free_as_between_discs():
    for liquid in ({"shear": CARREAU}, {"shear": EYRING}, {"pressure": BARUS}):
        assert free_liquid(prepare_scene(on(SQUARE, **liquid))).viscosity > 0.0
    assert free_liquid(prepare_scene(on(SQUARE, pressure=ROELANDS))).viscosity == 0.0


def film_of(given, accuracy=DRAFT):
    """Film of a scene, prepared for a motion in a host."""
    return plan(with_rheology(moving(given, None)), accuracy).prepared.rheology.film


def test_pressure_and_shear_at_once_are_refused_by_name():
    both = film_of(on(SQUARE, shear=EYRING, pressure=BARUS)).film
    said = "pressure_viscosity beside shear_viscosity", "ck.simulate"
    refuses(lambda: check_face(both), *said, error=PlanError)


@pytest.mark.parametrize(
    ("limit", "said"),
    [
        (CUT_OFF, 'cavity="mass-conserving"'),
        (ck.TensionLimit(strength=1e6), 'rheology="newtonian"'),
    ],
    ids=["truncated", "followed"],
)
def test_a_limit_is_refused_by_name(limit, said):
    given = on(SQUARE, ck.ViscousForce(rheology="all"), limit, shear=EYRING)
    refuses(lambda: prepared_film(moving(given, None)), said, error=PlanError)


def test_the_python_fmu_refuses_such_faces_by_name():
    for face in (SQUARE, TILTED):
        refuses(
            lambda one=face: mass_values(on(one, shear=EYRING)),
            "needs even discs",
            "--native",
            error=PlanError,
        )


def test_a_power_law_begins_at_the_fastest_shear_of_its_face():
    """On a ring h^2 v/2 |dp/dr| at the rim; until then the film is Newtonian."""
    film = film_of(on(RING, shear=POWER_LAW)).film
    a, b = RADIUS, 0.4 * RADIUS
    c = (a**2 - b**2) / (2.0 * math.log(a / b))  # r^2 where the pressure is highest
    fastest = 3.0 * max(a - c / a, c / b - b)  # of q = v (r - c/r)/2, times h^2/v
    disc = 3.0 * math.sqrt(a**2 - b**2)
    assert film.fastest_shear == pytest.approx(fastest / disc, rel=5e-2)  # at the hole
    begins = POWER_LAW.critical_rate / (film.fastest_shear * film.shear_per_speed(GAP))
    for factor, less in ((0.97, False), (1.1, True)):
        force = film.force(GAP, factor * begins) / film.linear_force(GAP, factor * begins)
        assert (force < 1.0 - 1e-5) == less


@pytest.mark.skipif(not HAS_CC, reason="there is no C compiler")
@pytest.mark.parametrize("name", quick(SCENES, long=[1]))
def test_a_mass_moves_as_that_of_the_scene(name, shelf, open_fmu):
    """On the same grids: what is left is of the tables of both."""
    given, n = SCENES[name], 4
    made = plan(given, DRAFT)
    law, state = Pull(PULL), start(made)
    released = ck.simulate(made).scalars()["release_time"][0]
    end = 1.05 * released
    one = {"platforms": [local()], "compiler": "cc", "film_rtol": DRAFT.film_rtol}
    host = open_fmu(shelf(build_native, given, **one)).start(F_ext=PULL, rtol=1e-8)
    for _ in range(n):
        state = advance(made, state, law, end / n)
        assert host.step(end / n) == 0, host.errors
        found = host.outputs()
        assert found["h"] == pytest.approx(state.gap, rel=1e-4)
        assert found["F_v"] == pytest.approx(outputs(made, state, PULL).viscous, rel=1e-4)
    assert found["t_release"] == pytest.approx(released, rel=1e-4)
