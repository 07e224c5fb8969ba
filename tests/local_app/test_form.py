"""Forms: a scene as widgets and back, other choices, and mistakes beside their widgets."""

from __future__ import annotations

import tomllib

import attrs
import pytest

import contactkit as ck
from contactkit.app.scenes import OpenedScene, open_scene
from contactkit.local_app.desk import Desk
from contactkit.local_app.exports import toml_bytes
from contactkit.local_app.form import (
    AS_GIVEN,
    EFFECTS,
    choices_of,
    made_of,
    parts_of,
    with_problem,
)
from contactkit.local_app.movers import movers_of
from contactkit.planning import plan

LOWER, UPPER = "interface.lower", "interface.upper"


@pytest.fixture(scope="module")
def starts():
    desk = Desk.new()
    yield {half: desk.begin(half).scene for half in ("contact", "separation")}
    desk.close()


def made(start, values=None, **chosen):
    paths = {path.replace("__", "."): name for path, name in chosen.items()}
    parts = parts_of(start, paths)
    return made_of(start, parts, values or {}), parts


def of(scene, accuracy=None):
    return OpenedScene(scene, accuracy or ck.Accuracy())


def film(**more):
    face = ck.Flat(radius=3.175e-3)
    liquid = ck.Meniscus(liquid=ck.load_liquid("engine-oil-15w-40"), volume=0.16e-9)
    given = {
        "interface": ck.Interface(lower=face, upper=face, meniscus=liquid),
        "loading": ck.ImposedForce(initial_gap=5e-6, final_gap=25e-6, force=40.0, mass=0.02),
        "effects": (ck.MeniscusForce(), ck.ViscousForce(), ck.TensionLimit(strength=1e6)),
    }
    return ck.SeparationScene(**given | more)


def own_steel(**more):
    return ck.Material(**{"young_modulus": 205e9, "poisson_ratio": 0.29} | more)


def rough_contact(**more):
    given = {
        "interface": ck.Interface(
            lower=ck.Body(solid=own_steel()), upper=ck.Body(surface=ck.Sphere(radius=1e-3))
        ),
        "window": ck.Window(width=30e-6, periodic=False),
        "loading": ck.Pressing(force=0.2),
        "effects": (ck.HalfSpace(),),
    }
    return ck.ContactScene(**given | more)


SCENES = {
    "film": film(),
    "film that is vibrated": film(
        loading=ck.ImposedSpeed(
            initial_gap=5e-6,
            final_gap=9e-6,
            speed=1e-3,
            vibration=ck.Vibration(amplitude=1e-7, frequency=100.0),
        )
    ),
    "own liquid": film(
        interface=ck.Interface(
            lower=ck.Flat(radius=1e-3),
            upper=ck.Sphere(radius=2e-3),
            meniscus=ck.Meniscus(
                liquid=ck.Liquid(name="it", viscosity=0.1, surface_tension=0.03), volume=1e-12
            ),
        ),
        temperature=300.0,
    ),
    "sphere on own steel": rough_contact(),
    "hardness and stress": rough_contact(
        effects=(
            ck.HalfSpace(),
            ck.HardnessLimit(rule=ck.ConstantHardness(hardness=3e9)),
            ck.SubsurfaceStress(depths=(1e-6, 2e-6)),
        )
    ),
    "three layers": rough_contact(
        interface=ck.Interface(
            lower=ck.Body(
                solid=ck.Stack(
                    layers=[
                        ck.Layer(material=own_steel(), thickness=d) for d in (1e-6, 2e-6, 3e-6)
                    ],
                    substrate=ck.load_material("silicon"),
                )
            ),
            upper=ck.Body(surface=ck.Sphere(radius=1e-3), solid=ck.load_material("sapphire")),
        ),
        effects=(ck.LayeredHalfSpace(),),
    ),
}


@pytest.mark.parametrize("name", SCENES)
def test_a_form_gives_its_scene_back(name):
    """Also what it does not show: a vibration, depths, a third layer, a liquid of one's own."""
    start = of(SCENES[name], ck.Accuracy(level="draft"))
    found, _ = made(start)
    assert found.problems == {}
    assert found.opened.scene == start.scene
    assert found.opened.accuracy == start.accuracy


@pytest.mark.parametrize("name", ["contact-stop", "tip-landing", "head-disk"])
def test_bundled_contacts_come_back(name):
    start = open_scene(name)
    found, _ = made(start)
    assert attrs.evolve(found.opened.scene, name="") == attrs.evolve(start.scene, name="")
    assert found.opened.accuracy.given == start.accuracy.given


def test_templates_come_back_in_the_units_of_people(starts):
    found, _ = made(starts["separation"])
    assert found.opened.scene == starts["separation"].scene
    written = tomllib.loads(toml_bytes("a film", found.tables).decode())
    assert written["loading"]["initial_gap"] == "5 um"
    assert written["interface"]["meniscus"]["liquid"] == "engine-oil-15w-40"
    assert "stiffness" not in written["loading"]  # a default


def test_values_are_read_with_their_units(starts):
    values = {"loading.force": "0.06 kN", "loading.mass": "", "temperature": "-10 degC"}
    found, _ = made(starts["separation"], values)
    scene = found.opened.scene
    assert (scene.loading.force, scene.loading.mass) == (60.0, None)
    assert scene.temperature == pytest.approx(263.15)


def test_another_kind_has_its_own_fields(starts):
    chosen = {f"{UPPER}.surface": "sphere", "loading": "imposed-speed"}
    values = {f"{UPPER}.surface.radius": "5 mm", "loading.speed": "1 mm/s"}
    gaps = {"loading.initial_gap": "5 um", "loading.final_gap": "25 um"}
    found, parts = made(starts["separation"], values | gaps, **chosen)
    assert found.opened.scene.interface.upper.surface == ck.Sphere(radius=5e-3)
    assert found.opened.scene.loading.speed == 1e-3
    assert "loading.mass" not in {w.path for part in parts for w in part.widgets}


def test_layers_decide_the_elasticity(starts):
    start = starts["contact"]
    thickness = {f"{LOWER}.solid.layers.0.thickness": "20 nm"}
    found, _ = made(start, thickness)
    solid = found.opened.scene.interface.lower.solid
    assert [one.thickness for one in solid.layers] == [20e-9]
    assert found.opened.scene.effects == (ck.LayeredHalfSpace(),)
    bare, _ = made(start, **{f"{LOWER}.solid.layers.0": "none"})
    assert bare.opened.scene.interface.lower.solid == ck.load_material("bearing-steel")
    assert bare.opened.scene.effects == (ck.HalfSpace(),)
    twice, _ = made(
        start,
        thickness | {f"{LOWER}.solid.layers.1.thickness": "1 um"},
        **{f"{LOWER}.solid.layers.1": "ni-p"},
    )
    assert len(twice.opened.scene.interface.lower.solid.layers) == 2


def test_effects_are_computed_only_where_they_are_chosen(starts):
    assert found_effects(starts, ()) == [ck.LayeredHalfSpace()]
    on = found_effects(
        starts,
        ("hardness-limit", "adhesion", "film-meniscus"),
        {
            "effects.adhesion.law.work_of_adhesion": "50 mJ/m2",
            "effects.adhesion.law.range": "1 nm",
            "effects.adhesion.law": "dugdale",
            "effects.film-meniscus.film_thickness": "2 nm",
            "effects.hardness-limit.rule": "material",
        },
    )
    assert [type(one).__name__ for one in on[1:]] == ["HardnessLimit", "Adhesion", "FilmMeniscus"]
    assert (on[2].law.range, type(on[2].law).__name__) == (1e-9, "DugdaleAttraction")
    assert type(on[1].rule).__name__ == "MaterialHardness"


def found_effects(starts, names, values=None):
    found, _ = made(starts["contact"], values, **{EFFECTS: names})
    assert found.problems == {}
    return list(found.opened.scene.effects)


def test_choices_name_what_is_not_in_the_library_as_it_is():
    chosen = {one.path: one.chosen for one in choices_of(of(SCENES["three layers"]))}
    assert chosen[f"{LOWER}.solid"] == AS_GIVEN
    assert chosen[f"{UPPER}.solid"] == "sapphire"
    own = {one.path: one.chosen for one in choices_of(of(SCENES["own liquid"]))}
    assert own["interface.meniscus.liquid"] == AS_GIVEN
    steel = {one.path: one.chosen for one in choices_of(of(SCENES["sphere on own steel"]))}
    assert steel[f"{LOWER}.solid"] == "of your own"


@pytest.mark.errors
@pytest.mark.parametrize(
    ("values", "path", "says"),
    [
        ({"loading.force": "40"}, "loading.force", "must carry a unit [N], got '40'"),
        ({"loading.force": "40 m"}, "loading.force", "converts to N"),
        ({"loading.force": ""}, "loading.force", "give the force, which must be a finite number"),
        ({"loading.mass": "-1 g"}, "loading.mass", "must be positive and finite [kg], got -0.001"),
        ({"loading.final_gap": "1 um"}, "loading.final_gap", "final_gap"),
        ({f"{UPPER}.surface.radius": "0 mm"}, f"{UPPER}.surface.radius", "got 0.0"),
        ({"interface.meniscus.count": "1.5"}, "interface.meniscus.count", "whole number"),
        ({"temperature": "1e99 K"}, "temperature", "be at most 1e+60 in size"),
        ({"effects.tension-limit.strength": "x"}, "effects.tension-limit.strength", "a number"),
    ],
)
def test_a_mistake_is_beside_its_widget(starts, values, path, says):
    chosen = {EFFECTS: ("meniscus-force", "viscous-force", "tension-limit")}
    found, _ = made(starts["separation"], values, **chosen)
    assert found.opened is None
    assert list(found.problems) == [path]
    assert says in " ".join(found.problems[path])


@pytest.mark.errors
def test_all_mistakes_are_found_at_once(starts):
    values = {"loading.force": "", f"{LOWER}.surface.radius": "-1 mm", "temperature": "cold"}
    found, _ = made(starts["separation"], values)
    assert set(found.problems) == set(values)


@pytest.mark.errors
def test_what_belongs_to_no_widget_is_about_the_whole(starts):
    found, parts = made(starts["separation"], {"interface.meniscus.pressure": "-1 kPa"})
    assert "given one of volume" in found.problems[""][0]
    later = with_problem({}, ck.PlanError("it does not fit"), parts)
    assert later == {"": ["it does not fit"]}
    named = ck.DescriptionError("HeightMap.mass", None, "be given")
    assert with_problem({}, named, parts) == {"loading.mass": [str(named)]}


@pytest.mark.slow
def test_sliders_move_what_a_live_page_moves(starts):
    start = starts["separation"]
    found, parts = made(start)
    movers = {one.paths: one for one in movers_of(found, parts, {})}
    pull = movers[("loading.force",)]
    assert (pull.numbers[0], pull.start, pull.numbers[-1]) == (4.0, 40.0, 400.0)
    assert pull.text_of(pull.start) == "40 N"
    assert (f"{LOWER}.surface.radius", f"{UPPER}.surface.radius") in movers
    for mover in movers.values():
        assert list(mover.numbers) == sorted(set(mover.numbers))
        for number in (mover.numbers[0], mover.numbers[-1]):
            moved, _ = made(start, dict.fromkeys(mover.paths, mover.text_of(number)))
            assert moved.problems == {}, (mover.label, number)
            assert plan(moved.opened.scene) is not None
    typed, _ = made(start, {"loading.force": "0.1 kN"})
    again = {one.paths: one for one in movers_of(typed, parts, {"loading.force": "0.1 kN"})}
    assert again[("loading.force",)].text_of(100.0) == "0.1 kN"


def test_a_scene_that_no_page_carries_has_no_sliders():
    vibrated = of(SCENES["film that is vibrated"])
    found, parts = made(vibrated)
    assert movers_of(found, parts, {}) == ()
