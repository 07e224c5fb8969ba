"""Every message of a contact: what is wrong, with which value and unit, and the cure."""

from __future__ import annotations

import math

import attrs
import numpy as np
import pytest
from refusals import (
    FINITE,
    NEVER,
    NON_NEGATIVE,
    POSITIVE,
    WHOLE,
    named,
    numbers_of,
    refused_with,
    refuses,
    says,
)
from selection import quick

import contactkit as ck
from contactkit.kinds import CONTACT_EFFECTS
from contactkit.scene.effect import as_written

pytestmark = [
    pytest.mark.errors,
    pytest.mark.filterwarnings("ignore::contactkit.errors.ValidityWarning"),
]

STEEL = ck.Material(name="steel", young_modulus=210e9, poisson_ratio=0.3, hardness=7e9)
BARE = ck.Material(name="bare", young_modulus=1e9, poisson_ratio=0.3)
FILM = ck.Layer(material=BARE, thickness=1e-9)
SOFT = ck.Material(name="soft", young_modulus=1.0, poisson_ratio=0.3)
COATED = ck.Stack(layers=(FILM,), substrate=STEEL)
ROUGH = ck.GaussianRoughness(rms=1e-9, correlation_length=1e-7, cutoff=6e-8)
SELF_AFFINE = ck.SelfAffineRoughness(rms=1e-9, hurst=0.8, rolloff=2e-7, cutoff=6e-8)
WAVE = ck.Wave(amplitude=1e-9, wavelength=1e-6)
MAP = ck.Heights(heights=1e-9 * np.arange(20.0).reshape(4, 5), pixel_size=1e-8)
WINDOW = ck.Window(width=1e-6)
PRESSURE = ck.Pressing(pressure=1e6)
OIL = ck.Liquid(name="oil", viscosity=0.1, surface_tension=0.03)
HALF_SPACE, LAYERED = ck.HalfSpace(), ck.LayeredHalfSpace()
FRICTION = ck.FrictionTraction(coefficient=0.2)
STRESS, WET = ck.SubsurfaceStress(), ck.FilmMeniscus(film_thickness=1e-9)


def scene(*effects, solid=STEEL, surface=ROUGH, upper=None, meniscus=None, **given):
    given = {"window": WINDOW, "loading": PRESSURE, "effects": effects or (HALF_SPACE,)} | given
    return ck.ContactScene(
        interface=ck.Interface(
            lower=ck.Body(solid=solid),
            upper=ck.Body(surface=surface, solid=upper),
            meniscus=meniscus,
        ),
        **given,
    )


def refuses_plan(*parts, effects=(HALF_SPACE,), error=ck.PlanError, accuracy=None, **given):
    accuracy = accuracy or ck.Accuracy(grid=64)
    refuses(lambda: ck.plan(scene(*effects, **given), accuracy), *parts, error=error)


# Numbers of scene objects -----------------------------------------------------------------------

SEED, TOLERANCE = "be a whole number of at least 0", "lie between 1e-11 and 0.1"

FIELDS = [
    (STEEL, "young_modulus", "Pa", POSITIVE, [0.0, -1e9, None]),
    (STEEL, "poisson_ratio", "", "lie above -1 and not above 0.5", [-1.0, 0.51, 2.0, None]),
    (STEEL, "hardness", "Pa", POSITIVE, [0.0, -1e9]),
    (FILM, "thickness", "m", POSITIVE, [0.0, -1e-9, None]),
    (ROUGH, "rms", "m", POSITIVE, [0.0, -1e-9, None]),
    (ROUGH, "correlation_length", "m", POSITIVE, [0.0, -1e-9, None]),
    (ROUGH, "cutoff", "m", POSITIVE, [0.0, -1e-9, None]),
    (ROUGH, "seed", "", SEED, [-1, 1.0, None]),
    (SELF_AFFINE, "rms", "m", POSITIVE, [0.0, -1e-9, None]),
    (SELF_AFFINE, "hurst", "", POSITIVE, [0.0, -0.5, None]),
    (SELF_AFFINE, "rolloff", "m", POSITIVE, [0.0, -1e-9, None]),
    (SELF_AFFINE, "cutoff", "m", POSITIVE, [0.0, -1e-9, None]),
    (SELF_AFFINE, "seed", "", SEED, [-1, 1.0, None]),
    (WAVE, "amplitude", "m", POSITIVE, [0.0, -1e-9, None]),
    (WAVE, "wavelength", "m", POSITIVE, [0.0, -1e-9, None]),
    (WAVE, "wavelength_y", "m", POSITIVE, [0.0, -1e-9]),
    (ck.Paraboloid(radius=1.0), "radius", "m", POSITIVE, [0.0, -1.0, None]),
    (ck.Paraboloid(radius=1.0), "radius_y", "m", POSITIVE, [0.0, -1.0]),
    (ck.Measured(path="x.npy"), "pixel_size", "m", POSITIVE, [0.0, -1.0]),
    (MAP, "pixel_size", "m", POSITIVE, [0.0, -1.0, None]),
    (WINDOW, "width", "m", POSITIVE, [0.0, -1e-6]),
    (WINDOW, "height", "m", POSITIVE, [0.0, -1e-6]),
    (PRESSURE, "pressure", "Pa", FINITE, []),
    (ck.Pressing(force=1.0), "force", "N", FINITE, []),
    (ck.Approach(approach=1.0), "approach", "m", FINITE, []),
    (scene(), "temperature", "K", POSITIVE, [0.0, -20.0, None]),
    (ck.IslandBridges(), "film_thickness", "m", POSITIVE, [0.0, -1e-9]),
    (ck.IslandBridges(), "meniscus_height", "m", POSITIVE, [0.0, -1e-9]),
    (ck.IslandBridges(), "connectivity", "", "be 4 or 8 neighbours", [0, 6, None]),
    (ck.ConstantHardness(hardness=1e9), "hardness", "Pa", POSITIVE, [0.0, -1.0]),
    (ck.ContinuousHardness(), "shift", "", NON_NEGATIVE, [-0.1, None]),
    (FRICTION, "coefficient", "", "lie between 0 and 1000", [-0.1, 1001.0, None]),
    (FRICTION, "direction", "rad", FINITE, [None]),
    (ck.SubsurfaceStress(), "window", "", POSITIVE, [0.0, -1.0, None]),
    (ck.SubsurfaceStress(), "tolerance", "", POSITIVE, [0.0, -0.1, None]),
    (WET, "film_thickness", "m", POSITIVE, [0.0, -1e-9, None]),
    (WET, "meniscus_height", "m", POSITIVE, [0.0, -1e-9]),
    (WET, "connectivity", "", "be 4 or 8 neighbours", [0, 6, None]),
    (ck.Accuracy(), "rtol", "", TOLERANCE, [0.0, -1e-8, 1.0, 1e-14]),
    (ck.Accuracy(), "grid", "", WHOLE.replace("1", "2"), [0, 1, -5, 1.5]),
    (ck.Accuracy(), "max_iterations", "", WHOLE, [0, -5, 1.5]),
    (ck.Accuracy(), "threads", "", WHOLE, [0, -5, 1.5]),
]
# Checked apart: arrays, depths and loads before, which are many.
ELSEWHERE = {
    ("Heights", "heights"),
    ("HardnessMap", "values"),
    ("SubsurfaceStress", "depths"),
    ("SubsurfaceStress", "coefficients"),
    *(("PlasticHistory", name) for name in ("pressures", "forces", "approaches", "steps")),
    # See test_viscoelasticity.py.
    *(
        ("Viscoelasticity", name)
        for name in ("times", "pressures", "forces", "approaches", "steps", "maps_at")
    ),
    # See test_partial_slip_errors.py.
    *(
        ("PartialSlip", name)
        for name in (
            "coefficient",
            "direction",
            "components",
            "rtol",
            "pressing_steps",
            "pressing_rtol",
        )
    ),
}
OF_A_SEPARATION = {"time_rtol", "curve_rtol", "film_rtol", "points", "max_steps"}


def misfit(thing, field, unit, expected, value):
    """What is wrong with the refusal of a value; a pair may be refused for one of its two."""
    other = attrs.evolve(thing, radius_y=None) if field == "radius" else thing
    said = refused_with(other, field, value)
    wanted = [repr(value), *([f" [{unit}]"] if unit else [])]
    wanted += [expected] if value not in NEVER else []
    is_right = said.startswith(f"{type(thing).__name__}.{field} must ")
    return (
        None if is_right and all(w in said for w in wanted) and (unit or "[" not in said) else said
    )


def test_an_impossible_number_is_named_with_its_field_and_unit():
    found = [
        (type(row[0]).__name__, row[1], value, said)
        for row in FIELDS
        for value in (*row[4], *NEVER[:-1])
        if (said := misfit(*row[:4], value)) is not None
    ]
    assert found == []


def test_the_list_above_is_complete():
    """A new number in a scene object or an effect of a contact needs its line there."""
    kinds = {type(row[0]) for row in FIELDS} | {*CONTACT_EFFECTS, ck.HardnessMap, ck.Stack}
    found = {(kind, name) for kind, name in numbers_of(kinds) if name not in OF_A_SEPARATION}
    assert found == named(FIELDS) | ELSEWHERE


@pytest.mark.parametrize(
    ("build", "says_what"),
    [
        (
            lambda: ck.GaussianRoughness(rms=1e-9, correlation_length=(1e-7,), cutoff=1e-8),
            (
                "GaussianRoughness.correlation_length must be one length or a pair",
                "[m]",
                "(1e-07,)",
            ),
        ),
        (
            lambda: ck.Heights(heights=np.zeros((4, 4)), pixel_size=(1e-8, 1e-8, 1e-8)),
            ("Heights.pixel_size must be one length or a pair", "[m]"),
        ),
        (
            lambda: ck.Heights(heights=np.zeros((4, 4)), pixel_size=(1e-8, -1e-8)),
            ("Heights.pixel_size must be positive", "[m], got -1e-08"),
        ),
        (lambda: ck.Accuracy(grid=(4, 4, 4)), ("Accuracy.grid must be one number or a pair",)),
        (lambda: ck.Accuracy(grid=(4, 1)), ("Accuracy.grid must be a whole number of at least 2",)),
        (
            lambda: ck.SelfAffineRoughness(rms=1e-9, hurst=1.1, rolloff=1e-6, cutoff=1e-8),
            ("SelfAffineRoughness.hurst must lie above 0 and not above 1, got 1.1",),
        ),
        (
            lambda: ck.SelfAffineRoughness(rms=1e-9, hurst=0.8, rolloff=1e-8, cutoff=1e-8),
            ("SelfAffineRoughness.cutoff must be smaller than rolloff = 1e-08 m [m], got 1e-08",),
        ),
        (lambda: ck.SubsurfaceStress(depths=()), ("SubsurfaceStress.depths must be depths that",)),
        (
            lambda: ck.SubsurfaceStress(depths=(1e-8, 1e-8)),
            ("SubsurfaceStress.depths must be depths that grow [m]",),
        ),
        (
            lambda: ck.SubsurfaceStress(depths=(-1e-8, 1e-8)),
            ("SubsurfaceStress.depths must be zero or positive, and finite [m], got -1e-08",),
        ),
        (
            lambda: ck.SubsurfaceStress(coefficients=(0.1, 1.5)),
            ("SubsurfaceStress.coefficients must lie between 0 and 1", "1.5"),
        ),
        (
            lambda: ck.SubsurfaceStress(coefficients=(0.1, 0.1)),
            ("SubsurfaceStress.coefficients must be different from each other",),
        ),
        (lambda: ck.HardnessMap([[1e9, -1.0]]), ("HardnessMap.values must", "[Pa]", "(1, 2)")),
        (lambda: ck.HardnessMap([[1e9, math.nan]]), ("HardnessMap.values must", "[Pa]")),
        (lambda: ck.HardnessMap([1e9, 1e9]), ("HardnessMap.values must have two dimensions",)),
    ],
)
def test_what_is_more_than_one_number_is_named_too(build, says_what):
    refuses(build, *says_what)


@pytest.mark.parametrize(
    ("given", "shown"),
    [
        ({}, "'none'"),
        ({"pressure": 1.0, "force": 1.0}, "['pressure', 'force']"),
    ],
)
def test_exactly_one_quantity_is_imposed(given, shown):
    refuses(
        lambda: ck.Pressing(**given),
        "Pressing must be given exactly one of pressure [Pa] or force [N]",
        f"got {shown}",
    )


@pytest.mark.parametrize(("name", "unit"), [("force", "N"), ("pressure", "Pa")])
def test_only_adhesion_carries_a_pull(name, unit):
    said = f"Pressing.{name} must be zero or positive [{unit}], got -1.0; only adhesion carries"
    pulled = ck.Pressing(**{name: -1.0})
    refuses(lambda: ck.plan(scene(HALF_SPACE, loading=pulled)), said, "list Adhesion(law=...)")
    planned = ck.plan(scene(HALF_SPACE))
    refuses(lambda: planned.with_loading(pulled), said)
    refuses(
        lambda: ck.load_curve(planned, **{f"{name}s".replace("forces", "loads"): [1, -1]}), said
    )


def test_a_rule_with_a_field_that_must_be_given_is_no_word():
    refuses(lambda: ck.HardnessLimit(rule="constant"), "HardnessLimit.rule", "hardness=...")
    refuses(lambda: ck.HardnessLimit(rule="other"), "HardnessLimit.rule", "'other'", "literal")


# Choices and parts --------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("build", "field", "right"),
    [
        (
            lambda: ck.ContinuousHardness(displacement="other"),
            "ContinuousHardness.displacement",
            "'local'",
        ),
        (lambda: ck.SubsurfaceStress(keep="other"), "SubsurfaceStress.keep", "'planes'"),
        (lambda: ck.SubsurfaceStress(reading="other"), "SubsurfaceStress.reading", "'uniform'"),
        (lambda: ck.Measured(path="x", detrend="other"), "Measured.detrend", "'curvature'"),
        (lambda: ck.Accuracy(method="other"), "Accuracy.method", "'active-set'"),
    ],
)
def test_an_unknown_choice_is_refused_with_the_known_ones(build, field, right):
    refuses(build, field, "must be one of", right, "got 'other'")


@pytest.mark.parametrize(
    ("build", "field"),
    [
        (lambda: ck.Body(surface="rough"), "Body.surface"),
        (lambda: ck.Body(solid=210e9), "Body.solid"),
        (lambda: ck.Layer(material="dlc", thickness=1e-9), "Layer.material"),
        (lambda: ck.Stack(layers=(STEEL,), substrate=STEEL), "Stack.layers"),
        (lambda: ck.Stack(substrate=COATED), "Stack.substrate"),
        (lambda: ck.CombinedSurface(parts=(WAVE, "rough")), "CombinedSurface.parts"),
        (lambda: ck.Interface(lower=STEEL), "Interface.lower"),
        (
            lambda: ck.Interface(lower=ck.Body(solid=STEEL), meniscus=OIL),
            "Interface.meniscus",
        ),
        (lambda: scene(window=1e-6), "ContactScene.window"),
        (lambda: scene(loading=1e6), "ContactScene.loading must be a Pressing or Approach"),
        (lambda: ck.Window(periodic="no"), "Window.periodic"),
        (
            lambda: ck.FilmMeniscus(film_thickness=1e-9, self_consistent="yes"),
            "FilmMeniscus.self_consistent",
        ),
    ],
)
def test_a_part_of_another_kind_is_refused_where_it_is_given(build, field):
    """Not later, as an AttributeError from within a kernel."""
    refuses(build, field)


def test_two_rigid_bodies_are_refused():
    rigid = attrs.evolve(scene(), interface=ck.Interface(upper=WAVE))
    refuses(
        lambda: ck.plan(rigid),
        "interface.lower.solid must be a Material or a Stack where the upper body is rigid",
        "give one of them",
        error=ck.PlanError,
    )


def test_a_rim_that_no_contact_knows_is_refused():
    faces = ck.Interface(lower=ck.Body(solid=STEEL, surface=ck.Flat(radius=1e-6)), upper=WAVE)
    refuses(
        lambda: ck.plan(attrs.evolve(scene(), interface=faces)),
        "interface.lower.surface.radius = 1e-06 m has no effect",
        error=ck.PlanError,
    )


def test_a_scene_object_cannot_be_changed_in_place():
    for thing, field in ((STEEL, "young_modulus"), (WINDOW, "width"), (FRICTION, "coefficient")):
        with pytest.raises(attrs.exceptions.FrozenInstanceError):
            setattr(thing, field, 1.0)
    with pytest.raises(ValueError, match="read-only"):
        MAP.heights[0, 0] = 1.0


# Effects that do not fit --------------------------------------------------------------------


@pytest.mark.parametrize(
    ("effects", "got"),
    [((FRICTION,), "neither"), ((HALF_SPACE, LAYERED), "HalfSpace and LayeredHalfSpace")],
)
def test_a_contact_has_exactly_one_law_of_elasticity(effects, got):
    refuses_plan("exactly one of HalfSpace() and LayeredHalfSpace()", got, effects=effects)


def test_an_effect_is_listed_once():
    twice = (HALF_SPACE, FRICTION, ck.FrictionTraction(coefficient=0.3))
    refuses_plan("listed more than once: FrictionTraction", effects=twice)


@pytest.mark.parametrize("effect", [ck.ViscousForce(), ck.ViscousForce, "friction", None])
def test_an_effect_of_something_else_is_refused_with_the_known_ones(effect):
    refuses_plan(
        "is not an effect of a contact scene",
        "known: HalfSpace",
        "SubsurfaceStress",
        effects=(HALF_SPACE, effect),
    )


@pytest.mark.parametrize(
    ("effects", "given", "parts"),
    [
        (
            (HALF_SPACE,),
            {"solid": COATED},
            ("HalfSpace needs bodies without layers", "LayeredHalfSpace()"),
        ),
        (
            (HALF_SPACE, ck.HardnessLimit()),
            {"solid": BARE},
            ("HardnessLimit needs hardness [Pa] of 'bare'",),
        ),
        (
            (LAYERED, ck.HardnessLimit()),
            {"solid": COATED},
            ("HardnessLimit needs hardness [Pa] of 'bare'",),
        ),
        (
            (LAYERED, ck.HardnessLimit(rule="literal")),
            {"solid": ck.Stack(layers=[attrs.evolve(FILM, material=STEEL)] * 3, substrate=STEEL)},
            ("at most two layers with rule='literal' (or rule='continuous')",),
        ),
        (
            (HALF_SPACE, ck.FrictionCoupling()),
            {},
            ("FrictionCoupling needs FrictionTraction(coefficient=...) beside it",),
        ),
        (
            (HALF_SPACE, ck.SubsurfaceStress(coefficients=(0.1,))),
            {},
            ("SubsurfaceStress needs FrictionTraction(coefficient=...) beside it",),
        ),
        (
            (
                HALF_SPACE,
                ck.FrictionTraction(coefficient=0.1),
                ck.FrictionCoupling(),
                ck.SubsurfaceStress(coefficients=(0.1,)),
            ),
            {},
            ("SubsurfaceStress needs one scene for each of its coefficients [-]",),
        ),
        (
            (HALF_SPACE, STRESS),
            {"solid": None, "upper": STEEL},
            ("SubsurfaceStress needs interface.lower.solid: the stress of a rigid body",),
        ),
        ((HALF_SPACE, WET), {}, ("FilmMeniscus needs interface.meniscus",)),
        (
            (HALF_SPACE, WET),
            {"meniscus": ck.Meniscus(liquid=attrs.evolve(OIL, surface_tension=None))},
            ("FilmMeniscus needs interface.meniscus.liquid.surface_tension [N/m]",),
        ),
        (
            (HALF_SPACE, WET),
            {"meniscus": ck.Meniscus(liquid=OIL, volume=1e-15)},
            ("not interface.meniscus.volume [m3]: leave that out",),
        ),
        (
            (HALF_SPACE, ck.FilmMeniscus(film_thickness=1e-9, self_consistent=True)),
            {"meniscus": ck.Meniscus(liquid=OIL), "loading": ck.Approach(approach=1e-9)},
            ("self_consistent=True", "Approach(approach=...) imposes none", "pressure or force"),
        ),
    ],
)
def test_what_an_effect_lacks_is_named_with_its_unit_and_cure(effects, given, parts):
    refuses_plan(*parts, effects=effects, **given)


def test_all_that_is_lacking_is_reported_at_once():
    refuses_plan(
        "HalfSpace needs",
        "HardnessLimit needs hardness [Pa] of 'bare'",
        "FilmMeniscus needs",
        "FrictionCoupling needs",
        effects=(HALF_SPACE, ck.HardnessLimit(), WET, ck.FrictionCoupling()),
        solid=COATED,
    )


@pytest.mark.parametrize(
    ("loading", "given", "parts"),
    [
        (
            ck.Pressing(pressure=1e15),
            {},
            (
                "loading.pressure must be at most 2.31e+14, 1000 times the E*",
                "got 1000000000000000.0",
            ),
        ),
        (ck.Pressing(force=1e3), {}, ("loading.force must be at most 231, 1000", "[N], got 1000")),
        (
            ck.Pressing(pressure=1e6),
            {"solid": ck.Material(young_modulus=1.0, poisson_ratio=0.3)},
            ("at most 1.1e+03, 1000 times the E* of 1.1 Pa", "check the units of load, window"),
        ),
        (
            ck.Pressing(pressure=1e6),
            {"solid": ck.Stack(layers=[attrs.evolve(FILM, material=SOFT)], substrate=SOFT)},
            ("of the softer body", "got 1000000.0; linear elasticity ends far below"),
        ),
        (
            ck.Approach(approach=1.0),
            {"window": ck.Window(width=1e-6, periodic=False)},
            ("loading.approach must be at most 0.001, 1000 times the window [m], got 1.0",),
        ),
        (
            PRESSURE,
            {"window": ck.Window(width=1e9)},
            ("the window must be at most 1e+06 along a side [m], got 1000000000.0; check the",),
        ),
    ],
)
def test_what_would_overflow_is_refused_with_its_field_unit_and_cure(loading, given, parts):
    effects = (LAYERED,)
    refuses_plan(*parts, effects=effects, error=ck.DescriptionError, loading=loading, **given)


def test_another_load_on_a_plan_is_held_to_the_same():
    plan = ck.plan(scene(), ck.Accuracy(grid=64))
    words = ("loading.pressure must be at most", "got 1e+20")
    refuses(lambda: plan.with_loading(ck.Pressing(pressure=1e20)), *words)


def test_heights_whose_squares_overflow_are_refused():
    sharp = scene(
        surface=ck.Paraboloid(radius=1e-300), window=ck.Window(width=1e-6, periodic=False)
    )
    plan = ck.plan(sharp, ck.Accuracy(grid=32))
    words = ("heights must be below 1e+140 [m]", "check units")
    refuses(lambda: ck.solve(plan), *words, error=ck.DescriptionError)


def test_a_load_beyond_the_hardness_is_infeasible_with_both_numbers():
    refuses_plan(
        "load 0.008 N reaches H*A = 0.007 N",
        "7e+09 Pa",
        "1e-12 m2",
        "lower the load",
        effects=(HALF_SPACE, ck.HardnessLimit()),
        loading=ck.Pressing(pressure=8e9),
        error=ck.InfeasibleError,
    )


# Grids and surfaces -------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("given", "parts"),
    [
        ({"window": ck.Window()}, ("Window.width must be given where no surface is measured [m]",)),
        (
            {"surface": MAP},
            ("Window.width must be that of the height map, 5e-08", "[m], got 1e-06"),
        ),
        (
            {"surface": MAP, "window": ck.Window(height=1e-6)},
            ("Window.height must be that of the height map, 4e-08", "got 1e-06"),
        ),
        (
            {"surface": MAP, "window": ck.Window(), "accuracy": ck.Accuracy(grid=8)},
            ("Accuracy.grid must be that of the height map, (4, 5), or left out, got 8",),
        ),
        (
            {"surface": ROUGH, "accuracy": ck.Accuracy(grid=16)},
            (
                "GaussianRoughness.cutoff must be at least two pixels, 1.25e-07 m [m], got 6e-08",
                "finer Accuracy.grid",
            ),
        ),
        (
            {"surface": SELF_AFFINE, "accuracy": ck.Accuracy(grid=16)},
            ("SelfAffineRoughness.cutoff must be at least two pixels",),
        ),
        (
            {"surface": ck.Wave(amplitude=1e-9, wavelength=0.3e-6)},
            (
                "Wave.wavelength must fit a whole number of times into the "
                "periodic window of 1e-06 m",
                "[m], got 3e-07",
            ),
        ),
        (
            {"surface": ck.Wave(amplitude=1e-9, wavelength=1e-6, wavelength_y=0.3e-6)},
            ("Wave.wavelength_y must fit",),
        ),
        ({"surface": ck.Wave(amplitude=1e-9, wavelength=2e-6)}, ("Wave.wavelength must fit",)),
        (
            {"surface": ck.Sphere(radius=0.7e-6)},
            (
                "Sphere.radius must exceed half the diagonal of the window, "
                "7.07107e-07 m [m], got 7e-07",
                "Paraboloid",
            ),
        ),
    ],
)
def test_a_surface_that_does_not_fit_the_window_is_refused(given, parts):
    accuracy = given.pop(
        "accuracy",
        ck.Accuracy(grid=64) if "surface" not in given or given["surface"] is not MAP else None,
    )
    refuses(lambda: ck.solve(ck.plan(scene(**given), accuracy)), *parts)


def test_two_maps_of_different_grids_are_refused():
    other = ck.Heights(heights=np.zeros((4, 4)), pixel_size=1e-8)
    interface = ck.Interface(lower=ck.Body(solid=STEEL, surface=other), upper=ck.Body(surface=MAP))
    refuses(
        lambda: ck.plan(attrs.evolve(scene(), interface=interface, window=ck.Window())),
        "surfaces of one grid",
        "resample one of the maps",
    )


def test_a_wave_of_less_than_two_pixels_is_refused():
    """Sampled on its period it would be a flat: a silent wrong number."""
    wave = ck.Wave(amplitude=1e-9, wavelength=1e-6 / 64)
    plan = lambda: ck.plan(scene(surface=wave), ck.Accuracy(grid=64))  # noqa: E731
    refuses(lambda: ck.solve(plan()), "Wave.wavelength")


@pytest.mark.parametrize(
    ("hardness", "parts"),
    [
        (np.full((3, 3), 1e9), ("HardnessMap.values must have the (4, 5) pixels", "(3, 3)")),
        (np.full((4, 5), math.nan), ("HardnessMap.values must", "[Pa]")),
        (-1.0, ("ConstantHardness.hardness must be positive and finite [Pa], got -1.0",)),
        (math.nan, ("ConstantHardness.hardness must be positive and finite [Pa], got nan",)),
        (math.inf, ("ConstantHardness.hardness must be positive and finite [Pa], got inf",)),
    ],
)
def test_press_refuses_an_impossible_hardness(hardness, parts):
    refuses(lambda: ck.press(MAP.heights, 1e-8, STEEL, 1e6, hardness=hardness), *parts)


@pytest.mark.parametrize(
    ("given", "parts"),
    [
        ({"mean_pressure": -1.0}, ("Pressing.pressure must be zero or positive [Pa], got -1.0",)),
        ({"mean_pressure": math.nan}, ("Pressing.pressure must be a finite number [Pa], got nan",)),
        ({"pixel_size": 0.0}, ("Heights.pixel_size must be positive and finite [m], got 0.0",)),
        ({"pixel_size": (1e-8, 1e-8, 1e-8)}, ("Heights.pixel_size must be one length or a pair",)),
        ({"stack": None}, ("must be a",)),
        ({"stack": 210e9}, ("press(stack) must be a Stack or a Material",)),
        ({"pixel_size": np.ones((4, 4))}, ("press(pixel_size)", "shape (4, 4)", "the order is")),
        ({"stack": "steel"}, ("one of the library is ck.load_material('steel')",)),
        ({"rtol": 0.0}, ("Accuracy.rtol must lie between 1e-11 and 0.1, got 0.0",)),
        ({"threads": 0}, ("Accuracy.threads must be a whole number of at least 1, got 0",)),
        ({"heights": "map.npy"}, ("Heights.heights must",)),
        ({"heights": np.array([[0.0, 1j], [0.0, 0.0]])}, ("Heights.heights must",)),
        ({"pixel_size": None}, ("Heights.pixel_size must be positive and finite [m], got None",)),
        ({"periodic": "yes"}, ("Window.periodic must be True, False, ",)),
    ],
)
def test_press_refuses_what_it_cannot_use(given, parts):
    usual = {"heights": MAP.heights, "pixel_size": 1e-8, "stack": STEEL, "mean_pressure": 1e6}
    refuses(lambda: ck.press(**usual | given), *parts)


@pytest.mark.parametrize("threads", [1, 2])
def test_press_takes_numbers_of_numpy(threads):
    """People who come with arrays come with numpy's numbers too."""
    size = np.float64(1e-8)
    run = ck.press(
        MAP.heights,
        (size, size),
        STEEL,
        np.float64(1e6),
        hardness=np.float64(1e9),
        rtol=np.float64(1e-8),
        threads=threads,
    )
    whole = ck.press(MAP.heights, np.float32(1e-8), STEEL, np.int64(1e6), hardness=np.array(1e9))
    assert run.status == whole.status == "converged"


# Results ------------------------------------------------------------------------------------


@pytest.mark.parametrize("kind", CONTACT_EFFECTS, ids=lambda kind: kind.__name__)
def test_what_was_not_simulated_is_not_invented(kind):
    effect = LAYERED if kind is ck.HalfSpace else HALF_SPACE
    run = ck.solve(ck.plan(scene(effect), ck.Accuracy(grid=64)))
    refuses(
        lambda: run.of(kind),
        f"the scene does not call for {kind.name}",
        f"add {as_written(kind)} to its effects",
        error=ck.NotSimulatedError,
    )


def test_the_plastic_area_of_an_elastic_contact_is_not_zero_but_refused():
    run = ck.solve(ck.plan(scene(), ck.Accuracy(grid=64)))
    refuses(
        lambda: run.plastic_area, "hardness-limit", "HardnessLimit()", error=ck.NotSimulatedError
    )
    refuses(
        lambda: run.of(ck.HalfSpace), "HalfSpace has no part of its own", error=ck.NotSimulatedError
    )


def test_a_solve_that_gives_up_says_how_far_it_came_and_hands_it_over():
    accuracy = ck.Accuracy(grid=64, rtol=1e-11, max_iterations=1, method="conjugate-gradient")
    plan = ck.plan(scene(loading=ck.Pressing(pressure=1e8)), accuracy)
    said = ("contact conditions are violated by", "1e-11", "raise Accuracy.max_iterations or rtol")
    with pytest.raises(ck.ConvergenceError, match=says(*said)) as caught:
        ck.solve(plan)
    result = caught.value.result
    assert result.status == "not converged"
    assert result.residual > 1e-11
    assert str(caught.value) == result.message
    assert ck.solve(plan, throw=False).status == "not converged"


def spikes(seed):
    """Ten spikes that all touch; what they sink by is far below the round-off of their heights."""
    rng = np.random.default_rng(seed)
    heights = np.zeros((64, 64))
    heights[*rng.integers(0, 64, (2, 10))] = 1e-6 + 1e-14 * rng.standard_normal(10)
    surface, window = ck.Heights(heights=heights, pixel_size=(1e-8, 1e-8)), ck.Window(width=6.4e-7)
    return scene(surface=surface, window=window, loading=ck.Pressing(pressure=3e3))


@pytest.mark.parametrize(
    "method", quick(["active-set", "conjugate-gradient", "quasi-newton"], 0, long=[1])
)
def test_a_tolerance_below_round_off_is_distinguished_from_a_lack_of_steps(method):
    """Which of the surfaces still reaches the tolerance hangs on the last bits; not all do."""
    refused = []
    for seed in (1, 2, 3):
        try:
            ck.solve(ck.plan(spikes(seed), ck.Accuracy(rtol=1e-11, method=method)))
        except ck.ConvergenceError as error:
            refused.append(error)
    assert refused
    for error in refused:
        assert "round-off keeps it" in str(error)
        assert "method=" not in str(error)  # no other one reaches further
        assert "max_iterations" not in str(error)
        assert error.result.residual < 1e-9
        assert error.result.work.n_operator_applications < 1000


def test_a_start_of_another_grid_is_refused():
    plan = ck.plan(scene(), ck.Accuracy(grid=64))
    small = ck.solve(ck.plan(scene(surface=WAVE), ck.Accuracy(grid=32)))
    refuses(lambda: ck.solve(plan, start=small), "start must be one on (64, 64) pixels", "(32, 32)")


def test_the_arrays_of_a_result_are_read_only():
    effects = (HALF_SPACE, FRICTION, ck.SubsurfaceStress(depths=(1e-8,), keep="planes"))
    run = ck.solve(ck.plan(scene(*effects), ck.Accuracy(grid=64)))
    for array in (run.pressure, run.gap, run.displacement, run.heights):
        with pytest.raises(ValueError, match="read-only"):
            array[0, 0] = 1.0


@pytest.mark.parametrize("whole", [np.int64, np.int16, np.uint32])
def test_numbers_of_arrays_are_taken_as_those_of_python(whole):
    given = ck.Accuracy(grid=(whole(32), whole(48)), threads=whole(2), rtol=np.float32(2.0**-20))
    assert given == ck.Accuracy(grid=(32, 48), threads=2, rtol=2.0**-20)
    assert [type(n) for n in (*given.grid, given.threads, given.rtol)] == [int, int, int, float]
    with pytest.raises(ck.DescriptionError, match=r"Accuracy\.threads must be a whole number"):
        ck.Accuracy(threads=np.float64(2.0))
    with pytest.raises(ck.DescriptionError, match=r"Accuracy\.grid must be a whole number"):
        ck.Accuracy(grid=np.bool_(True))
