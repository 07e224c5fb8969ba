"""Every message of a separation: what is wrong, with which value and unit, and the cure."""

from __future__ import annotations

import math
import re

import attrs
import pytest
from refusals import (
    ANGLE,
    BETWEEN,
    FINITE,
    NON_NEGATIVE,
    POSITIVE,
    WHOLE,
    misfits,
    named,
    numbers_of,
    refuses,
)

import contactkit as ck
from contactkit.files.results import read_state
from contactkit.files.scenes import write_whole
from contactkit.kinds import SEPARATION_EFFECTS
from contactkit.units import parse_quantity, parse_unit

pytestmark = pytest.mark.errors

OIL = ck.Liquid(name="oil", viscosity=0.1, surface_tension=0.03)
FILM = ck.Meniscus(liquid=OIL, volume=1e-12)
FACES = ck.Interface(lower=ck.Flat(radius=1e-3), upper=ck.Flat(radius=1e-3), meniscus=FILM)
GAPS = {"initial_gap": 1e-6, "final_gap": 1e-5}
AT_SPEED = ck.ImposedSpeed(**GAPS, speed=1e-6)
IN_TIME, PULLED = ck.ImposedTime(**GAPS, time=1.0), ck.ImposedForce(**GAPS, force=1.0)
VISCOUS, MENISCUS = ck.ViscousForce(), ck.MeniscusForce()


def scene(*effects, interface=FACES, loading=AT_SPEED, **more):
    return ck.SeparationScene(interface=interface, loading=loading, effects=effects, **more)


def refuses_plan(*parts, error=ck.PlanError, **given):
    effects = given.pop("effects")
    refuses(lambda: ck.plan(scene(*effects, **given)), *parts, error=error)


# Numbers of scene objects -----------------------------------------------------------------------

ACCURACY = ck.Accuracy()
CAVITATING = ck.TensionLimit(strength=1e6, cavity_pressure=0.0)
LIMIT, SHEAR, BREAK = (
    ck.TensionLimit(strength=1e6, cavity="truncated"),
    ck.ShearLimit(strength=1e6),
    ck.Rupture(),
)
ATTRACTION = ck.VanDerWaalsForce(hamaker_constant=1e-19)
MOIST = ck.Meniscus(liquid=OIL, pressure=-1e6)
HUMID = ck.Meniscus(liquid=OIL, relative_humidity=0.5)
SUMMITS = ck.AsperityPopulation(density=1e12, radius=1e-6)
STICKY = ck.AdhesiveContact(work_of_adhesion=0.05, reduced_modulus=1e9)

ROUGH = ck.Wave(amplitude=1e-9, wavelength=1e-6)
FIELDS = [
    (ck.Flat(), "radius", "m", POSITIVE, [0.0, -1e-3]),
    (ck.Flat(radius=1.0), "tilt", "rad", "be a pair of slopes (x, y)", [1e-3, None]),
    (ck.Flat(radius=1.0), "crown_radius", "m", FINITE, []),
    (ck.FineRoughness(surface=ROUGH, width=1e-6), "width", "m", POSITIVE, [0.0, -1e-6]),
    (ck.FineRoughness(surface=ROUGH, width=1e-6), "pixels", "", WHOLE, [0, -1, 2.5, None]),
    (ck.Sphere(radius=1.0), "radius", "m", POSITIVE, [0.0, -1e-3, None]),
    (FILM, "volume", "m3", POSITIVE, [0.0, -1e-12]),
    (FILM, "slip_length_lower", "m", NON_NEGATIVE, [-1e-9]),
    (FILM, "slip_length_upper", "m", NON_NEGATIVE, [-1e-9]),
    (MOIST, "pressure", "Pa", "be negative and finite", [0.0, 1e5]),
    (HUMID, "relative_humidity", "", BETWEEN, [-0.1, 50.0]),
    (SUMMITS, "density", "1/m2", POSITIVE, [0.0, -1e12, None]),
    (SUMMITS, "radius", "m", POSITIVE, [0.0, -1e-6, None]),
    (SUMMITS, "rms_height", "m", NON_NEGATIVE, [-1e-9, None]),
    (SUMMITS, "count", "", WHOLE, [0, -1, 2.5]),
    (ck.AsperityMenisci(asperities=SUMMITS), "meniscus_height", "m", POSITIVE, [0.0, -1e-9]),
    (ck.SolidContact(cutoff=1e-8), "cutoff", "m", POSITIVE, [0.0, -1e-9, None]),
    (ck.CoxVoinovAngle(), "slip_length", "m", POSITIVE, [0.0, -1e-9, None]),
    (ck.CoxVoinovAngle(), "outer_length", "m", POSITIVE, [0.0, -1e-9]),
    (ck.TroutonForce(), "trouton_ratio", "", POSITIVE, [0.0, -3.0, None]),
    (ck.DynamicRupture(), "factor", "", NON_NEGATIVE, [-1.0, None]),
    (ck.DynamicRupture(), "exponent", "", POSITIVE, [0.0, -0.5, None]),
    (FILM, "contact_angle_lower", "rad", ANGLE, [-0.1, 3.2, None]),
    (FILM, "contact_angle_upper", "rad", ANGLE, [-0.1, 181.0, None]),
    (FILM, "count", "", WHOLE, [0, -1, 1.0, 2.5, None]),
    (FILM, "rewetting", "", BETWEEN, [-0.1, 1.1, None]),
    *[
        row
        for loading in (AT_SPEED, IN_TIME, PULLED)
        for row in (
            (loading, "initial_gap", "m", NON_NEGATIVE, [-1e-6, None]),
            (loading, "final_gap", "m", POSITIVE, [0.0, -1e-6, None]),
        )
    ],
    (AT_SPEED, "speed", "m/s", POSITIVE, [0.0, -1.0, None]),
    (IN_TIME, "time", "s", POSITIVE, [0.0, -1.0, None]),
    (PULLED, "force", "N", FINITE, [None]),
    (PULLED, "mass", "kg", POSITIVE, [0.0, -1.0]),
    (PULLED, "stiffness", "N/m", NON_NEGATIVE, [-1.0, None]),
    (PULLED, "rise_time", "s", NON_NEGATIVE, [-1.0, None]),
    (PULLED, "initial_speed", "m/s", FINITE, [None]),
    (PULLED, "rest_gap", "m", NON_NEGATIVE, [-1e-9, None]),
    (PULLED, "time_limit", "s", POSITIVE, [0.0, -1.0, None]),
    (scene(VISCOUS), "temperature", "K", POSITIVE, [0.0, -20.0, None]),
    (LIMIT, "strength", "Pa", POSITIVE, [0.0, -1e5, "vacuum", None]),
    (LIMIT, "ambient_pressure", "Pa", POSITIVE, [0.0, -1e5, None]),
    (CAVITATING, "cavity_pressure", "Pa", FINITE, []),
    (SHEAR, "strength", "Pa", POSITIVE, [0.0, -1e5, None]),
    (BREAK, "gap", "m", f"{POSITIVE}, 'limit' or 'zero-neck'", [0.0, -1e-6]),
    (ATTRACTION, "hamaker_constant", "J", POSITIVE, [0.0, -1e-19, None]),
    (ATTRACTION, "cutoff", "m", POSITIVE, [0.0, -1e-10, None]),
    (STICKY, "work_of_adhesion", "J/m2", POSITIVE, [0.0, -0.05, "wet", None]),
    (STICKY, "reduced_modulus", "Pa", POSITIVE, [0.0, -1e9]),
    (STICKY, "equilibrium_distance", "m", POSITIVE, [0.0, -1e-10, None]),
    (STICKY, "strength", "Pa", POSITIVE, [0.0, -1e6]),
    (ACCURACY, "time_rtol", "", "lie between 1e-11 and 0.1", [0.0, -1e-8, 1.0, 1e-14]),
    (ACCURACY, "curve_rtol", "", "lie between 1e-6 and 0.1", [0.0, -1e-3, 1.0]),
    (ACCURACY, "film_rtol", "", "lie between 1e-6 and 0.1", [0.0, -1e-3, 1.0]),
    (ACCURACY, "points", "", WHOLE, [0, -5, 1.5]),
    (ACCURACY, "max_steps", "", WHOLE, [0, -5, 1.5]),
]


def test_an_impossible_number_is_named_with_its_field_and_unit():
    assert misfits(FIELDS) == {}


def test_an_even_face_has_no_crown_rather_than_one_of_no_radius():
    refuses(
        lambda: ck.Flat(radius=1.0, crown_radius=0.0),
        "Flat.crown_radius must not be zero [m], got 0.0; leave it out for an even face",
    )


# Settings of a contact are in test_contact_errors.
OF_A_CONTACT = {("Accuracy", name) for name in ("grid", "rtol", "max_iterations", "threads")}


def test_the_list_above_is_complete():
    """A new number in a scene object or an effect needs its line there."""
    kinds = {type(row[0]) for row in FIELDS} | {*SEPARATION_EFFECTS}
    assert numbers_of(kinds) - OF_A_CONTACT == named(FIELDS)


@pytest.mark.parametrize("value", [60, 60.0, 180.0, 3.2])
def test_degrees_are_suspected(value):
    refuses(
        lambda: ck.Meniscus(liquid=OIL, contact_angle_upper=value),
        "Meniscus.contact_angle_upper must lie between 0 and pi [rad]",
        f"was it meant in degrees? then write {value!r}*deg, or '{value:g} deg' in a file",
    )


@pytest.mark.parametrize("value", [-60.0, 181.0, 720.0])
def test_not_every_angle_is_suspected_of_degrees(value):
    with pytest.raises(ck.DescriptionError, match=f"got {value!r}$"):
        ck.Meniscus(liquid=OIL, contact_angle_upper=value)


def test_a_gap_closes_not():
    refuses(
        lambda: attrs.evolve(AT_SPEED, final_gap=1e-6),
        "ImposedSpeed.final_gap must exceed initial_gap = 1e-06 m",
        "got 1e-06",
    )


def test_asperities_are_not_higher_than_the_gap():
    refuses(
        lambda: attrs.evolve(PULLED, rest_gap=2e-6),
        "ImposedForce.rest_gap must not exceed initial_gap = 1e-06 m [m], got 2e-06",
    )


@pytest.mark.parametrize(
    ("kind", "given"),
    [
        (ck.ImposedSpeed, {"speed": 1.0, "mass": 5.0}),
        (ck.ImposedSpeed, {"speed": 1.0, "force": 1.0}),
        (ck.ImposedTime, {"time": 1.0, "speed": 1.0}),
        (ck.ImposedForce, {"force": 1.0, "vibration": None}),
    ],
)
def test_a_field_of_another_kind_of_loading_cannot_be_written(kind, given):
    with pytest.raises(TypeError, match="unexpected keyword argument"):
        kind(**GAPS, **given)


@pytest.mark.parametrize("given", [{}, {"mass": 1.0}])
def test_what_is_imposed_is_required(given):
    with pytest.raises(TypeError, match=r"missing .* 'force'"):
        ck.ImposedForce(**GAPS, **given)


# Choices and parts --------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("effect", "field", "right"),
    [
        (ck.ViscousForce, "closure", "volume-conserving"),
        (ck.MeniscusForce, "profile", "as-published"),
        (ck.AsPublished, "pulled", "lower"),
        (ck.TensionLimit, "cavity", "reynolds"),
        (ck.Rupture, "gap", "zero-neck"),
    ],
)
def test_an_unknown_choice_is_refused_with_the_known_ones(effect, field, right):
    refuses(lambda: effect(**{field: "other"}), f"{effect.__name__}.{field}", right, "'other'")


@pytest.mark.parametrize(
    ("build", "field"),
    [
        (lambda: ck.Meniscus(liquid="water"), "Meniscus.liquid"),
        (lambda: ck.Interface(meniscus=OIL), "Interface.meniscus"),
        (lambda: ck.Interface(lower="flat", meniscus=FILM), "Interface.lower"),
        (lambda: scene(VISCOUS, interface=FILM), "SeparationScene.interface"),
        (lambda: scene(VISCOUS, loading=FACES), "SeparationScene.loading"),
    ],
)
def test_a_part_of_another_kind_is_refused_where_it_is_given(build, field):
    """Not later, as an AttributeError from within a kernel."""
    refuses(build, field)


def test_a_scene_object_cannot_be_changed_in_place():
    with pytest.raises(attrs.exceptions.FrozenInstanceError):
        FILM.volume = 1.0
    with pytest.raises(attrs.exceptions.FrozenInstanceError):
        VISCOUS.closure = "flooded"


# Effects that do not fit --------------------------------------------------------------------


def test_without_a_force_there_is_nothing_to_simulate():
    for effects in ((), (ck.Rupture(gap=2e-6),), (LIMIT,)):
        refuses_plan("needs at least one force", "MeniscusForce, ViscousForce", effects=effects)


def test_an_effect_is_listed_once():
    twice = (VISCOUS, ck.ViscousForce(closure="flooded"), MENISCUS, MENISCUS)
    refuses_plan("listed more than once: MeniscusForce, ViscousForce", effects=twice)


@pytest.mark.parametrize("stranger", ["viscous-force", 3, None, FILM])
def test_what_is_no_effect_is_named(stranger):
    refuses_plan(
        f"{stranger!r} is not an effect of a separation scene; known: MeniscusForce",
        effects=(VISCOUS, stranger),
    )


def test_a_class_is_not_yet_an_effect():
    refuses_plan("ViscousForce", "is not an effect", effects=(ck.ViscousForce,))


def test_a_limit_needs_the_force_it_bounds():
    refuses_plan(
        "TensionLimit needs ViscousForce() beside it: it bounds the viscous force",
        "ShearLimit needs ViscousForce() beside it",
        effects=(MENISCUS, LIMIT, SHEAR),
    )


def test_a_limit_needs_a_path_in_time():
    loading = ck.ImposedTime(initial_gap=1e-6, final_gap=1e-5, time=1.0)
    refuses_plan(
        "TensionLimit needs a speed or a force imposed: with only the time given",
        "ShearLimit needs a speed or a force imposed",
        effects=(VISCOUS, LIMIT, SHEAR),
        loading=loading,
    )


def test_a_pull_needs_something_to_set_the_speed():
    loading = ck.ImposedForce(initial_gap=1e-6, final_gap=1e-5, force=1.0)
    refuses_plan(
        "an imposed force needs loading.mass [kg], or ViscousForce(), to set a speed",
        effects=(MENISCUS,),
        loading=loading,
    )


def test_a_property_is_asked_for_by_the_effect_that_uses_it():
    bare = attrs.evolve(FACES, meniscus=ck.Meniscus(liquid=ck.Liquid(name="bare"), volume=1e-12))
    refuses_plan("ViscousForce needs liquid.viscosity [Pa.s]", effects=(VISCOUS,), interface=bare)
    refuses_plan(
        "MeniscusForce needs liquid.surface_tension [N/m]", effects=(MENISCUS,), interface=bare
    )
    refuses_plan(
        "MeniscusForce needs liquid.surface_tension [N/m]; ViscousForce needs liquid.viscosity",
        effects=(MENISCUS, VISCOUS),
        interface=bare,
    )


@pytest.mark.filterwarnings("ignore::contactkit.errors.ValidityWarning")
@pytest.mark.parametrize(
    ("effect", "liquid"),
    [(VISCOUS, {"viscosity": 0.1}), (MENISCUS, {"surface_tension": 0.03})],
)
def test_a_property_is_not_asked_for_by_an_effect_that_does_not_use_it(effect, liquid):
    film = ck.Meniscus(liquid=ck.Liquid(name="bare", **liquid), volume=1e-12)
    result = ck.simulate(ck.plan(scene(effect, interface=attrs.evolve(FACES, meniscus=film))))
    assert result.status == "curve"


def test_a_film_must_end_somewhere():
    endless = ck.Interface(meniscus=attrs.evolve(FILM, volume=None))
    for effect in (VISCOUS, MENISCUS):
        refuses_plan(
            f"{type(effect).__name__} needs interface.meniscus.volume [m3]",
            "or the radius [m] of a Flat face",
            effects=(effect,),
            interface=endless,
        )


def test_a_flooded_sphere_has_no_meniscus():
    bath = ck.Interface(upper=ck.Sphere(radius=1e-3), meniscus=attrs.evolve(FILM, volume=None))
    refuses_plan(
        "MeniscusForce needs interface.meniscus.volume [m3]: a flooded sphere has no meniscus",
        effects=(MENISCUS, VISCOUS),
        interface=bath,
    )


def test_a_break_distance_follows_from_a_volume_or_is_given():
    flooded = attrs.evolve(FACES, meniscus=attrs.evolve(FILM, volume=None))
    refuses_plan(
        "Rupture needs interface.meniscus.volume [m3] (or Rupture.gap [m])",
        effects=(VISCOUS, ck.Rupture()),
        interface=flooded,
    )


def test_a_break_distance_lies_beyond_the_start():
    refuses_plan(
        "Rupture.gap must exceed initial_gap = 1e-06 m",
        "got 1e-07",
        effects=(VISCOUS, ck.Rupture(gap=1e-7)),
        error=ck.DescriptionError,
    )


def test_the_condition_of_swift_and_stieber_is_known_between_flats_only():
    ball = ck.Interface(upper=ck.Sphere(radius=1e-3), meniscus=FILM)
    refuses_plan(
        'TensionLimit needs two flats (or cavity="truncated", or "mass-conserving")',
        effects=(VISCOUS, ck.TensionLimit(cavity="reynolds")),
        interface=ball,
    )


# Results ------------------------------------------------------------------------------------


@pytest.fixture(scope="module")
def viscous_only():
    return ck.simulate(ck.plan(scene(VISCOUS)))


@pytest.fixture(scope="module")
def within_time():
    loading = ck.ImposedTime(initial_gap=1e-6, final_gap=1e-5, time=1.0)
    return ck.simulate(ck.plan(scene(VISCOUS, loading=loading)))


def test_the_curve_of_an_absent_effect_names_the_effect_to_add(viscous_only):
    for ask in (
        lambda: viscous_only["meniscus_force"],
        lambda: viscous_only["meniscus_force"],
        lambda: viscous_only.of(ck.MeniscusForce),
    ):
        refuses(
            ask,
            "the scene does not call for meniscus-force: add MeniscusForce() to its effects",
            error=ck.NotSimulatedError,
        )


@pytest.mark.parametrize("kind", [ck.TensionLimit, ck.ShearLimit, ck.Rupture, ck.MeniscusForce])
def test_each_absent_effect_is_named(viscous_only, kind):
    refuses(
        lambda: viscous_only.of(kind),
        f"does not call for {kind.name}: add {kind.__name__}(",
        error=ck.NotSimulatedError,
    )


def test_the_curve_of_an_absent_limit_names_the_limits(viscous_only):
    refuses(lambda: viscous_only["limit"], "TensionLimit", error=ck.NotSimulatedError)


def test_a_cure_is_not_what_was_done_already(viscous_only):
    """With a speed imposed, do not advise to impose a speed."""
    message = ""
    try:
        viscous_only["viscous_impulse"]
    except ck.NotSimulatedError as error:
        message = str(error)
    assert "impose a speed" not in message


@pytest.mark.parametrize("name", ["viscous_force", "newtonian_force", "time", "pull", "speed"])
def test_without_a_path_in_time_no_instantaneous_force_is_known(within_time, name):
    refuses(
        lambda: within_time[name],
        "with time imposed it is not determined; impose a speed or a force",
        error=ck.NotSimulatedError,
    )


def test_the_force_of_a_part_is_not_known_without_a_path_either(within_time):
    for ask in (
        lambda: within_time.of(ck.ViscousForce).force,
        lambda: within_time.of(ck.ViscousForce).newtonian_force,
    ):
        refuses(ask, "no viscous force", "impose a speed or a force", error=ck.NotSimulatedError)


def test_an_unknown_curve_is_refused_with_the_known_ones(viscous_only):
    refuses(lambda: viscous_only["force"], "column must be one of time, gap", "got 'force'")
    assert not hasattr(viscous_only, "force")


@pytest.mark.parametrize("time", [None, 0.0, -1.0, math.nan])
def test_a_mean_force_needs_a_time(viscous_only, time):
    refuses(
        lambda: viscous_only.of(ck.ViscousForce).mean_force(time),
        f"mean_force(time) must be positive [s], got {time!r}",
        "give the duration of the opening here, or as ImposedTime(time=...)",
    )


@pytest.mark.parametrize("force", [None, 0.0, -1.0, math.nan])
def test_a_time_at_constant_force_needs_a_force(viscous_only, force):
    refuses(
        lambda: viscous_only.of(ck.ViscousForce).time_at_constant_force(force),
        f"time_at_constant_force(force) must be positive [N], got {force!r}",
        "give the pull here, or as ImposedForce(force=...)",
    )


def test_a_rupture_has_no_curve_of_its_own():
    result = ck.simulate(ck.plan(scene(VISCOUS, ck.Rupture(gap=2e-6))))
    refuses(lambda: result.of(ck.Rupture), "Rupture has no curve", error=ck.NotSimulatedError)


def test_curves_are_read_only(viscous_only):
    with pytest.raises(ValueError, match="read-only"):
        viscous_only.gap[0] = 1.0


def test_a_model_outside_its_range_says_which_and_by_how_much():
    fast = attrs.evolve(AT_SPEED, speed=1.0)
    with pytest.warns(ck.ValidityWarning) as caught:
        ck.simulate(ck.plan(scene(VISCOUS, MENISCUS, loading=fast)))
    said = [str(warning.message) for warning in caught]
    assert any(re.match(r"fingering number = .*\(at most 1\): OUT OF RANGE", s) for s in said)
    assert any(s.startswith("viscous over capillary pressure = 1.59e+06 ") for s in said)


def test_what_a_validity_number_lacks_is_named(viscous_only):
    missing = [str(number) for number in viscous_only.validity if number.value is None]
    rigid = "not evaluated, no body has a solid (a Material or a Stack): the faces are rigid"
    assert missing == [
        "Reynolds number: not evaluated, liquid.density [kg/m3] is not given",
        "pressure over bulk modulus: not evaluated, liquid.bulk_modulus [Pa] is not given",
        f"bending of the faces over the gap: {rigid}",
        f"soft-face number: {rigid}",
        "weight of the film over its pressure: not evaluated, liquid.density [kg/m3] is not given",
    ]


# Files --------------------------------------------------------------------------------------

TEXT = """\
name = "spool"
temperature = "40 degC"

[interface.lower]
shape = "flat"
radius = "3 mm"

[interface.upper]
shape = "sphere"
radius = "5 mm"

[interface.meniscus]
volume = "0.1 mm3"
contact_angle_lower = "60 deg"

[interface.meniscus.liquid]
name = "oil"
viscosity = "100 mPa.s"
surface_tension = "30 mN/m"

[loading]
kind = "imposed-speed"
initial_gap = "2 um"
final_gap = "20 um"
speed = "1 mm/s"

[[effects]]
effect = "viscous-force"

[[effects]]
effect = "tension-limit"
strength = "1 bar"
"""


def write(folder, *changes):
    text = TEXT
    for old, new in changes:
        assert old in text
        text = text.replace(old, new)
    path = folder / "spool.toml"
    path.write_text(text, encoding="utf-8")
    return path


def test_a_right_file_is_read(tmp_path):
    found = ck.load_scene(write(tmp_path))
    assert found.loading.initial_gap == 2e-6
    assert found.interface.meniscus.contact_angle_lower == math.pi / 3.0
    assert found.effects == (VISCOUS, ck.TensionLimit(strength=1e5))
    assert found.temperature == 313.15


LIBRARY = '[interface.meniscus.liquid]\nname = "oil"\nviscosity = "100 mPa.s"\n'
MISTAKES = {
    "wrong unit": (
        [('"2 um"', '"2 N"')],
        [
            "ImposedSpeed.initial_gap must be in a unit that converts to m, got '2 N'",
            "2.5 m",
            "at loading.initial_gap",
        ],
    ),
    "no unit": (
        [('"2 um"', '"2"')],
        ["ImposedSpeed.initial_gap must carry a unit [m], got '2'", "for example '2.5 m'"],
    ),
    "no number": ([('"2 um"', '"two um"')], ["must be a number and a unit [m], got 'two um'"]),
    "unknown unit": (
        [('"2 um"', '"2 parsec"')],
        [
            "ImposedSpeed.initial_gap must be made of known symbols ('parsec' is not one)",
            "at loading.initial_gap",
        ],
    ),
    "a boolean": ([('"2 um"', "true")], ["ImposedSpeed.initial_gap must be", "[m], got True"]),
    "impossible": (
        [('"3 mm"', '"-3 mm"')],
        ["Flat.radius must be positive", "got -0.003", "at interface.lower"],
    ),
    "degrees": (
        [('"60 deg"', "60")],
        ["Meniscus.contact_angle_lower must lie between 0 and pi", "degrees", "at interface"],
    ),
    "misspelt key": (
        [("initial_gap", "inital_gap")],
        ["loading.inital_gap must be a key of imposed-speed", "'initial_gap'?", "at loading"],
    ),
    "strange key": (
        [('shape = "flat"', 'shape = "flat"\nzzz = 1')],
        ["Flat.zzz must be a known key", "known: radius"],
    ),
    "misspelt effect": (
        [("viscous-force", "viscos-force")],
        [
            "effect must name a known kind, got 'viscos-force'",
            "did you mean 'viscous-force'?",
            "at effects[0]",
        ],
    ),
    "nameless effect": (
        [('effect = "tension-limit"\n', "")],
        ["effect must name a known kind, got None", "known: adhesive-contact", "at effects[1]"],
    ),
    "misspelt choice": (
        [('"viscous-force"', '"viscous-force"\nclosure = "floded"')],
        ["floded", "volume-conserving", "flooded", "at effects[0]"],
    ),
    "misspelt shape": (
        [('"sphere"', '"spere"')],
        [
            "shape must name a known kind, got 'spere'",
            "did you mean 'sphere'?",
            "at interface.upper",
        ],
    ),
    "unknown liquid": (
        [
            (LIBRARY + 'surface_tension = "30 mN/m"\n', ""),
            ("volume =", 'liquid = "engin-oil-15w-40"\nvolume ='),
        ],
        [
            "liquid must be a liquid of the library, got 'engin-oil-15w-40'",
            "did you mean 'engine-oil-15w-40'?",
        ],
    ),
    "missing key": ([('final_gap = "20 um"\n', "")], ["missing key 'final_gap'", "at loading"]),
    "missing table": (
        [(LIBRARY + 'surface_tension = "30 mN/m"\n', "")],
        ["missing key 'liquid'", "at interface.meniscus"],
    ),
    "kinematic viscosity alone": (
        [('viscosity = "100 mPa.s"', 'kinematic_viscosity = "105 cSt"')],
        [
            "Liquid.kinematic_viscosity must come together with a density [m2/s]",
            "give density too, or viscosity in Pa.s",
            "at interface.meniscus.liquid",
        ],
    ),
    "law of another property": (
        [('"100 mPa.s"', '{law = "iapws-surface-tension"}')],
        ["Liquid.viscosity must be a number or a law of the same unit [Pa.s]", "'vogel'"],
    ),
    "misspelt law": (
        [('"100 mPa.s"', '{law = "vogl"}')],
        ["law must name a known kind, got 'vogl'", "did you mean 'vogel'?"],
    ),
    "two imposed": (
        [("speed =", 'force = "1 N"\nspeed =')],
        ["loading.force must be a key of imposed-speed", "belongs to imposed-force", "at loading"],
    ),
    "part of a meniscus": (
        [('"60 deg"', '"60 deg"\ncount = 2.5')],
        ["Meniscus.count must be a whole number of at least 1, got 2.5"],
    ),
    "not a table": (
        [
            ('[interface.upper]\nshape = "sphere"\nradius = "5 mm"\n', ""),
            ("[interface.lower]", "[interface]\nupper = 3\n\n[interface.lower]"),
        ],
        ["Body must be a table with a key 'shape', or with surface", "got 3", "at interface.upper"],
    ),
}


@pytest.mark.parametrize(("changes", "parts"), MISTAKES.values(), ids=MISTAKES)
def test_a_mistake_in_a_file_is_named_with_its_place_and_cure(tmp_path, changes, parts):
    path = write(tmp_path, *changes)
    refuses(lambda: ck.load_scene(path), "spool.toml cannot be used:", *parts)


def test_several_mistakes_are_listed_at_once(tmp_path):
    path = write(
        tmp_path,
        ('"2 um"', '"-2 um"'),
        ('"30 mN/m"', '"30 Pa"'),
        ('strength = "1 bar"', 'strenght = "1 bar"'),
        ("viscous-force", "viscos-force"),
    )
    with pytest.raises(ck.DescriptionError, match="cannot be used") as error:
        ck.load_scene(path)
    lines = str(error.value).splitlines()[1:]
    assert len(lines) == 4
    for field in (
        "ImposedSpeed.initial_gap",
        "Liquid.surface_tension",
        "TensionLimit.strenght",
        "effect",
    ):
        assert sum(line.strip().startswith(field) for line in lines) == 1


@pytest.mark.parametrize(
    ("text", "missing"),
    [("", ["interface", "loading", "effects"]), ("[window]\n", ["interface", "effects"])],
)
def test_an_empty_file_lacks_everything(tmp_path, text, missing):
    path = tmp_path / "empty.toml"
    path.write_text(text, encoding="utf-8")
    refuses(lambda: ck.load_scene(path), *(f"missing key {key!r}" for key in missing))


def test_what_is_not_toml_is_refused_with_its_line(tmp_path):
    refuses(
        lambda: ck.load_scene(write(tmp_path, ("[loading]", "[loading"))),
        "spool.toml cannot be used:",
        "not TOML:",
        "at line 21",
    )
    binary = tmp_path / "binary.toml"
    binary.write_bytes(b"\xff\xfe\x00")
    refuses(lambda: ck.load_scene(binary), "binary.toml cannot be used:", "not TOML:", "utf-8")


def test_a_missing_file_is_named(tmp_path):
    refuses(lambda: ck.load_scene(tmp_path / "none.toml"), "file must exist, got", "none.toml")
    refuses(lambda: ck.load_scene(tmp_path), "file must be readable")


def test_a_result_that_is_none_is_refused(tmp_path):
    refuses(lambda: ck.load_result(tmp_path / "none.npz"), "file must be a result of contactkit")
    path = tmp_path / "text.npz"
    path.write_text("not a result", encoding="utf-8")
    refuses(lambda: ck.load_result(path), "file must be a result of contactkit", "text.npz")


def test_a_state_with_a_former_name_is_refused_with_the_present_one():
    kept = {"time": 1.0, "n_tears": 1}
    refuses(lambda: read_state(kept), "state.n_tears must be left out", "it is now n_inceptions")


def test_an_unknown_liquid_of_the_library_gets_a_guess():
    refuses(
        lambda: ck.load_liquid("watr"),
        "liquid must be a liquid of the library, got 'watr'",
        "did you mean 'water'?",
    )


# Never half a file --------------------------------------------------------------------------


def test_a_failed_save_leaves_no_file(tmp_path, viscous_only, monkeypatch):
    import numpy as np

    def fails(file, **_arrays):
        with open(file, "w") as half:
            half.write("half of")
        raise OSError("disk full")

    monkeypatch.setattr(np, "savez_compressed", fails)
    with pytest.raises(OSError, match="disk full"):
        ck.save_result(viscous_only, tmp_path / "run.npz")
    assert list(tmp_path.iterdir()) == []


def test_a_failed_save_keeps_the_file_that_was_there(tmp_path):
    path = tmp_path / "scene.toml"
    path.write_text("before", encoding="utf-8")

    def half():
        with write_whole(path) as temporary:
            temporary.write_text("half of", encoding="utf-8")
            raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        half()
    assert path.read_text(encoding="utf-8") == "before"
    assert list(tmp_path.iterdir()) == [path]


def test_a_saved_result_comes_back_the_same(tmp_path, viscous_only):
    path = ck.save_result(viscous_only, tmp_path / "run.npz")
    again = ck.load_result(path)
    assert again.plan.scene == viscous_only.plan.scene
    assert again.scalars() == viscous_only.scalars()
    assert (again["viscous_force"] == viscous_only["viscous_force"]).all()


# Units --------------------------------------------------------------------------------------


@pytest.mark.parametrize("text", ["1 foo", "1 m/foo", "1 xm", "1 kbar.foo", "1e m"])
def test_an_unknown_symbol_is_named(text):
    refuses(lambda: parse_quantity(text, "m", "Flat.radius"), "Flat.radius must be made of known")


@pytest.mark.parametrize("value", ["", "m", "nan m", "- m", None, [1.0], True])
def test_what_is_no_quantity_is_refused_with_an_example(value):
    refuses(
        lambda: parse_quantity(value, "m", "Flat.radius"),
        f"Flat.radius must be a number and a unit [m], got {value!r}",
        "for example '2.5 m'",
    )


@pytest.mark.parametrize(("unit", "example"), [("K", "20 degC"), ("rad", "60 deg"), ("N", "2.5 N")])
def test_the_example_is_one_that_people_write(unit, example):
    refuses(lambda: parse_quantity("x", unit), f"for example '{example}'")


@pytest.mark.parametrize("text", ["m//s", "m.", ".m", "/", "m^", "2", "m^1.5"])
def test_a_unit_that_is_half_written_is_refused(text):
    refuses(lambda: parse_unit(text), "unit must be made of known symbols")


def test_a_choice_of_eq_3_11_is_refused_on_a_sphere(film_scene):
    effect = ck.MeniscusForce(profile=ck.AsPublished(pulled="upper"))
    made = film_scene(effect, lower=ck.Flat(), upper=ck.Sphere(radius=1e-3), film={"volume": 1e-12})
    with pytest.raises(ck.PlanError, match=r"two flats for AsPublished\(pulled='upper'"):
        ck.plan(made)


@pytest.mark.parametrize(
    "build",
    [
        lambda: ck.MeniscusForce(pulled="upper"),
        lambda: ck.MeniscusForce(profile="arc", radius="disc"),
        lambda: ck.Rupture(gap=1e-6, criterion="zero-neck"),
        lambda: ck.HardnessLimit(rule="material", shift=0.9),
        lambda: ck.HardnessLimit(rule="constant", hardness=1e9),
        lambda: ck.MaterialHardness(displacement="local"),
        lambda: ck.LiteralHardness(shift=0.1),
    ],
)
def test_a_field_of_another_choice_cannot_be_written(build):
    with pytest.raises(TypeError, match="unexpected keyword argument"):
        build()


def test_a_motion_that_was_not_solved_is_refused_with_its_cure(film_scene):
    made = film_scene(ck.ViscousForce(), film={"volume": 1e-12})
    result = ck.simulate(ck.plan(made))
    assert not result.has_motion
    assert result.scalars()["peak_force"][0] > 0.0
    with pytest.raises(ck.NotSimulatedError, match=r"no motion .* ImposedSpeed.*impose a force"):
        _ = result.state
