"""Settings of `Accuracy`: levels, which were given, and those that a scene does not read."""

import pickle

import pytest
from attrs import evolve

import contactkit as ck
from contactkit.app.scenes import OpenedScene
from contactkit.app.settings import with_settings

STEEL = ck.Material(young_modulus=210e9, poisson_ratio=0.3)
FACE = ck.Flat(radius=1e-3)
OIL = ck.Meniscus(liquid=ck.Liquid(name="oil", viscosity=0.1, surface_tension=0.03), volume=1e-11)
CONTACT = ck.ContactScene(
    interface=ck.Interface(lower=ck.Body(solid=STEEL), upper=ck.Sphere(radius=1e-3)),
    window=ck.Window(width=1e-4, periodic=False),
    loading=ck.Pressing(force=1.0),
    effects=(ck.HalfSpace(),),
)
FILM = ck.SeparationScene(
    interface=ck.Interface(lower=FACE, upper=FACE, meniscus=OIL),
    loading=ck.ImposedSpeed(speed=1e-3, initial_gap=4e-6, final_gap=1e-5),
    effects=(ck.ViscousForce(),),
)
SLIDING = ck.SlidingScene(
    interface=FILM.interface,
    loading=ck.Sliding(gap=4e-6, speed=1e-3),
    effects=(ck.CouetteForce(),),
)
PULL = ck.ImposedForce(force=1.0, mass=0.01, initial_gap=4e-6, final_gap=1e-5)
SLOW = ck.ImposedTime(time=1.0, initial_gap=4e-6, final_gap=1e-5)
TRUNCATED, REMEMBERED = (
    (ck.ViscousForce(), ck.TensionLimit(strength=1e4, cavity=cavity))
    for cavity in ("truncated", "mass-conserving")
)
TILTED = evolve(
    FILM,
    interface=ck.Interface(
        lower=FACE,
        upper=ck.Flat(planform=ck.Disc(radius=1e-3), tilt=(1e-3, 0.0)),
        meniscus=ck.Meniscus(liquid=OIL.liquid),
    ),
)


@pytest.mark.parametrize(
    ("scene", "given"),
    [
        (CONTACT, {"time_rtol": 1e-8}),  # what every level has, or the standard one
        (CONTACT, {"points": 50, "grid": 16}),
        (CONTACT, {"level": "draft", "max_steps": 100_000, "grid": 16}),
        (CONTACT, {"max_iterations": 10_000, "grid": 16}),  # of a reference solver
        (FILM, {"rtol": 1e-8}),
        (FILM, {"threads": 1}),
        (SLIDING, {"film_rtol": 1e-3}),
        (FILM, {"time_rtol": 1e-8}),  # of a motion, where the speed is imposed
        (FILM, {"max_steps": 100_000}),
        (evolve(FILM, effects=(ck.MeniscusForce(),)), {"film_rtol": 1e-3}),  # of no film
        (evolve(FILM, effects=TRUNCATED), {"time_rtol": 1e-8}),
        (evolve(FILM, loading=PULL), {"points": 200}),
        (evolve(FILM, loading=SLOW), {"max_steps": 100_000}),
        (SLIDING, {"level": "reference", "time_rtol": 1e-11}),
    ],
)
def test_a_setting_that_is_not_read_is_refused_whatever_its_value(scene, given):
    with pytest.raises(ck.PlanError, match=r"Accuracy\.\w+ = .* is not read by .*: leave it out"):
        ck.plan(scene, ck.Accuracy(**given))


@pytest.mark.parametrize(
    ("scene", "given"),
    [
        (FILM, {"points": 9, "curve_rtol": 1e-2}),
        (evolve(FILM, loading=SLOW), {"points": 9, "curve_rtol": 1e-2}),
        (evolve(FILM, loading=PULL), {"time_rtol": 1e-6, "curve_rtol": 1e-2, "max_steps": 99}),
        (evolve(FILM, effects=(ck.MeniscusForce(),)), {"time_rtol": 1e-4}),  # of its curve
        (evolve(FILM, effects=REMEMBERED), {"time_rtol": 1e-4}),
        (TILTED, {"film_rtol": 1e-2}),
        (FILM, {"film_rtol": 1e-2}),  # which a closed form meets by itself
        (SLIDING, {"points": 9, "curve_rtol": 1e-2}),
    ],
)
def test_a_setting_that_something_of_the_scene_reads_is_taken(scene, given):
    accuracy = ck.plan(scene, ck.Accuracy(**given)).accuracy
    assert {name: getattr(accuracy, name) for name in given} == given


def test_a_coupled_effect_reads_in_place_of_the_loading():
    scene = evolve(FILM, effects=(*FILM.effects, ck.ElasticBodies()))
    assert scene.reads == {"film_rtol", "grid"}


def test_what_is_no_effect_is_refused_as_such_beside_a_setting():
    with pytest.raises(ck.PlanError, match="it is a class: write ViscousForce"):
        ck.plan(evolve(FILM, effects=(ck.ViscousForce,)), ck.Accuracy(points=9))


@pytest.mark.parametrize("level", ["draft", "standard", "reference"])
def test_a_level_fits_every_scene_and_gives_what_is_not_given(level):
    accuracy = getattr(ck.Accuracy, level)
    assert accuracy == ck.Accuracy(level=level)
    assert accuracy.given == frozenset()
    for scene in (FILM, SLIDING):
        assert ck.plan(scene, accuracy).accuracy is accuracy
    fine = evolve(accuracy, grid=16)
    assert fine.given == {"grid"}
    assert ck.plan(CONTACT, fine).accuracy.rtol == accuracy.rtol


def test_another_level_replaces_what_was_not_given():
    made = evolve(ck.Accuracy(rtol=1e-6), level="draft")
    assert (made.rtol, made.time_rtol) == (1e-6, 1e-5)
    assert made.given == {"rtol"}
    assert evolve(ck.Accuracy(), rtol=1e-4).given == {"rtol"}  # a value of another level


def test_files_studies_and_options_know_what_was_given():
    accuracy = ck.Accuracy(time_rtol=1e-8)
    assert pickle.loads(pickle.dumps(accuracy)).given == {"time_rtol"}
    again = ck.Accuracy.of_file(accuracy.saved())
    assert (again, again.given) == (accuracy, accuracy.given)
    before = ck.Accuracy.of_file(ck.Accuracy.draft.values)  # a file that names no level
    assert (before, before.level, before.given) == (ck.Accuracy.draft, "draft", frozenset())
    with pytest.raises(ck.PlanError, match=r"Accuracy\.rtol = 1e-08 is not read"):
        ck.study(FILM, {"accuracy.rtol": [1e-8, 1e-6]})
    with pytest.raises(ck.PlanError, match=r"Accuracy\.rtol = 1e-08 is not read"):
        with_settings(OpenedScene(FILM), ["accuracy.rtol=1e-8"]).plan_text()
    opened = with_settings(OpenedScene(FILM), ["accuracy.level=draft"])
    assert opened.accuracy == ck.Accuracy.draft


def test_a_result_read_back_keeps_its_settings(tmp_path):
    result = ck.simulate(ck.plan(evolve(FILM, loading=PULL), ck.Accuracy(level="draft")))
    read = ck.load_result(result.save(tmp_path / "film")).plan.accuracy
    assert (read, read.level, read.given) == (ck.Accuracy.draft, "draft", frozenset())
