"""What `ck.published` and as-published scenes refuse, and what they say."""

import math

import pytest

import contactkit as ck
from contactkit.as_published.arguments import ARGUMENTS

pytestmark = pytest.mark.errors

FILM = {
    "radius": 1e-7,
    "gap_start": 2e-9,
    "gap_end": 1e-7,
    "separation_time": 1e-7,
    "viscosity": 1e-3,
}


@pytest.mark.parametrize(
    ("number", "message"),
    [
        ("3.99", r"number must be one of 2\.41, 2\.41a, .*, 3\.3, 3\.4, .*, got '3\.99'"),
        ("3.14", r"did you mean 3\.14a or 3\.14b\?"),
        (3.19, r"number must be one of .*, got 3\.19"),
    ],
)
def test_no_such_equation(number, message):
    with pytest.raises(ck.DescriptionError, match=message):
        ck.published(number)


@pytest.mark.parametrize(
    ("changed", "message"),
    [
        ({"radius": -1.0}, r"Eq\. \(3\.19\), radius must be positive and finite \[m\], got -1\.0"),
        ({"radius": math.nan}, r"radius must be positive and finite \[m\], got nan"),
        ({"radius": True}, "radius must be positive"),
        ({"radius": [1e-7, 2e-7]}, "radius must be .* give one number at a time"),
        ({"viscosity": "1 mPa.s"}, r"viscosity must be positive and finite \[Pa\.s\]"),
        ({"gap_end": 1e-9}, r"gap_end must exceed gap_start = 2e-09 \[m\], got 1e-09"),
        ({"gap": 1e-9}, "argument must be one of radius, gap_start, gap_end, .*, got 'gap'"),
    ],
)
def test_impossible_arguments_are_named(changed, message):
    with pytest.raises(ck.DescriptionError, match=message):
        ck.published("3.19", **FILM | changed)


def test_a_missing_argument_is_named_with_all_that_are_needed():
    with pytest.raises(
        ck.DescriptionError,
        match=r"viscosity must be positive .* \[Pa\.s\], got 'nothing'; .*dynamic viscosity.*"
        r"needed: radius \[m\], gap_start \[m\]",
    ):
        ck.published("3.19", **{k: v for k, v in FILM.items() if k != "viscosity"})


def test_degrees_are_suspected():
    with pytest.raises(ck.DescriptionError, match=r"angle must lie between 0 and pi .*degrees"):
        ck.published("3.8", sphere_radius=1e-7, surface_tension=0.072, angle=60.0)


def test_only_whole_numbers_of_menisci():
    for number in (0, 1.5, math.inf, -1):
        with pytest.raises(ck.DescriptionError, match="number must be a whole number of at least"):
            ck.published("3.13", force=1.0, number=number)


def test_the_pulled_body_is_lower_or_upper():
    with pytest.raises(ck.DescriptionError, match="pulled must be 'lower' or 'upper', got 'both'"):
        ck.published(
            "3.11",
            radius=1e-7,
            gap=2e-9,
            surface_tension=0.07,
            angle_lower=1.0,
            angle_upper=1.0,
            pulled="both",
        )


@pytest.mark.parametrize(
    ("number", "given"),
    [
        (
            "3.11",
            {
                "radius": 1e-7,
                "gap": 0.0,
                "surface_tension": 0.07,
                "angle_lower": 1.0,
                "angle_upper": 1.0,
            },
        ),
        (
            "3.26",
            {
                "sphere_radius": 1e-7,
                "gap_start": 0.0,
                "film_height": 2e-9,
                "gap_end": 3e-8,
                "separation_time": 1e-7,
                "viscosity": 1e-3,
            },
        ),
        (
            "3.3",
            {
                "surface_tension": 0.07,
                "molar_volume": 18e-6,
                "temperature": 298.0,
                "relative_humidity": 1.0,
            },
        ),
        (
            "3.42",
            {
                "force": 1.0,
                "radius": 1e-7,
                "surface_tension": 0.07,
                "angle_lower": math.pi / 2,
                "angle_upper": math.pi / 2,
            },
        ),
    ],
)
def test_a_printed_equation_without_a_finite_value_is_refused(number, given):
    with pytest.raises(ck.InfeasibleError, match=r"Eq\. \(3\.\d+\) (has no finite value|is inf)"):
        ck.published(number, **given)


def test_every_argument_says_what_it_must_be():
    for name, argument in ARGUMENTS.items():
        assert argument.meaning, name
        assert argument.expected.startswith(("be ", "lie ")), name


# Scenes --------------------------------------------------------------------------------------

PUBLISHED = ck.MeniscusForce(profile="as-published")
ZERO_NECK = ck.Rupture(gap="zero-neck")


def scene(film_scene, *effects, **loading):
    return film_scene(*effects, film={"volume": 1e-12}, **loading)


def test_a_scene_does_not_mix_the_two_modes(film_scene):
    printed = ck.ViscousForce(closure="as-published")
    for effects, loading, names in (
        ((ck.MeniscusForce(), printed), {"speed": 1e-3}, "ViscousForce.*MeniscusForce"),
        ((PUBLISHED, ck.ViscousForce()), {"time": 1.0}, "MeniscusForce.*ViscousForce"),
        ((PUBLISHED, ck.Rupture()), {"speed": 1e-3}, "MeniscusForce.*Rupture"),
        ((ck.MeniscusForce(), ZERO_NECK), {"speed": 1e-3}, "Rupture.*MeniscusForce"),
    ):
        with pytest.raises(
            ck.PlanError, match=rf"{names}.*as printed or the consistent ones.*choose one mode"
        ):
            ck.plan(scene(film_scene, *effects, **loading))


def test_a_scene_of_one_mode_is_planned(film_scene):
    for effects, loading in (
        ((PUBLISHED, ck.ViscousForce(closure="as-published"), ZERO_NECK), {"time": 1.0}),
        ((ck.MeniscusForce(profile="arc"), ZERO_NECK), {"speed": 1e-3}),
        ((PUBLISHED, ck.Rupture(gap=5e-6)), {"speed": 1e-3}),
        ((PUBLISHED, ck.ViscousForce()), {"speed": 1e-3}),  # Eq. (3.18) is right as printed
        ((ck.MeniscusForce(), ck.ViscousForce()), {"time": 1.0}),
        ((ck.ViscousForce(closure="as-published"),), {"time": 1.0}),
    ):
        ck.plan(scene(film_scene, *effects, **loading))
