"""Every message of liquids and their laws: what is wrong, with which value, and the cure."""

from __future__ import annotations

import math
from functools import partial

import pytest
from refusals import POSITIVE, misfits, refuses

from contactkit.errors import ValidityWarning
from contactkit.liquids.liquid import Liquid
from contactkit.liquids.temperature_laws import LinearDensity, LinearSurfaceTension
from contactkit.liquids.viscosity import VogelViscosity, WaltherViscosity
from contactkit.liquids.water import IapwsSurfaceTension, KellWaterDensity

pytestmark = pytest.mark.errors

VG46 = {
    "temperature_1": 313.15,
    "kinematic_viscosity_1": 46e-6,
    "temperature_2": 373.15,
    "kinematic_viscosity_2": 6.8e-6,
}
WATER = {
    "reference_viscosity": 2.414e-5,
    "activation_temperature": 247.8,
    "divergence_temperature": 140.0,
    "temperature_min": 273.15,
    "temperature_max": 373.15,
}
TENSION = {
    "value": 30e-3,
    "slope": -0.09e-3,
    "reference_temperature": 293.15,
    "temperature_min": 253.15,
    "temperature_max": 393.15,
}


# Constants of a liquid ----------------------------------------------------------------------


def test_a_constant_must_be_positive_and_finite():
    units = {
        "surface_tension": "N/m",
        "viscosity": "Pa.s",
        "kinematic_viscosity": "m2/s",
        "density": "kg/m3",
    }
    bare, impossible = Liquid(name="x"), [0.0, -1.0]
    assert misfits([(bare, name, unit, POSITIVE, impossible) for name, unit in units.items()]) == {}


def test_kinematic_viscosity_needs_a_density():
    for given, shown in ((46e-6, "4.6e-05"), (WaltherViscosity(**VG46), "'walther'")):
        refuses(
            lambda given=given: Liquid(name="oil", kinematic_viscosity=given),
            f"Liquid.kinematic_viscosity must come together with a density [m2/s], got {shown}",
            "give density too, or viscosity in Pa.s",
        )


def test_one_viscosity_is_enough():
    refuses(
        lambda: Liquid(name="oil", viscosity=0.1, kinematic_viscosity=1e-4, density=900.0),
        "Liquid.kinematic_viscosity must be left out where viscosity is given [m2/s], got 0.0001",
        "keep one of the two",
    )


def test_centistokes_are_suspected():
    refuses(
        lambda: Liquid(name="oil", kinematic_viscosity=105, density=880.0),
        "Liquid.kinematic_viscosity must be at most 1 [m2/s], got 105",
        "was it given in cSt? write '105 cSt' in a file, or 105*cSt",
    )


def test_millinewtons_are_suspected():
    refuses(
        lambda: Liquid(name="water", surface_tension=72.75),
        "Liquid.surface_tension must be at most 10 [N/m], got 72.75",
        "was it given in mN/m? write '72.75 mN/m' in a file, or 72.75*mN",
    )


def test_a_law_must_give_what_the_field_holds():
    refuses(
        lambda: Liquid(name="oil", viscosity=WaltherViscosity(**VG46)),
        "Liquid.viscosity must be a number or a law of the same unit [Pa.s], got 'walther'",
        "the law 'walther' gives m2/s; laws that fit: 'vogel'",
    )
    refuses(
        lambda: Liquid(name="water", surface_tension=KellWaterDensity()),
        "laws that fit: 'linear-surface-tension', 'iapws-surface-tension'",
    )


@pytest.mark.parametrize("temperature", [0.0, -20.0, math.nan, math.inf, -math.inf])
def test_a_liquid_has_a_state_at_positive_temperatures_only(temperature):
    refuses(
        lambda: Liquid(name="x").at(temperature),
        f"Liquid.at(temperature) must be positive and finite [K], got {temperature!r}",
    )


def test_a_liquid_suspects_degrees_celsius():
    refuses(
        lambda: Liquid(name="x").at(-20.0),
        "was it meant in degrees Celsius? then write celsius(-20.0), or '-20 degC' in a file",
    )


# Ranges of laws -----------------------------------------------------------------------------


@pytest.mark.parametrize("span", [(373.15, 273.15), (300.0, 300.0)])
def test_a_range_must_rise(span):
    given = WATER | {"temperature_min": span[0], "temperature_max": span[1]}
    refuses(
        lambda: VogelViscosity(**given),
        "VogelViscosity.temperature_min and temperature_max must rise, and both be above ",
        f" [K], got {span!r}",
    )


def test_a_range_may_not_reach_where_the_law_has_no_meaning():
    refuses(
        lambda: LinearSurfaceTension(**(TENSION | {"temperature_max": 700.0})),
        "LinearSurfaceTension.temperature_min and temperature_max must rise, and both lie between",
        "0 and 626.483 [K], got (253.15, 700.0)",
        "beyond it the straight line is no longer positive",
    )
    refuses(
        lambda: IapwsSurfaceTension(temperature_max=700.0),
        "lie between 0 and 647.096 [K]",
        "at the critical point liquid and vapour become one",
    )


def test_outside_its_range_a_law_warns_and_goes_on():
    law = WaltherViscosity(**VG46, temperature_min=253.15, source="data sheet")
    message = (
        r"WaltherViscosity holds from 253\.15 to 505\.37 K and was evaluated at 243 K; data sheet$"
    )
    with pytest.warns(ValidityWarning, match=message):
        assert law(243.15) > law(253.15)


def test_a_warning_names_the_caller_and_suspects_degrees_celsius():
    with pytest.warns(ValidityWarning, match=r"write celsius\(25\.0\), or '25 degC'") as caught:
        IapwsSurfaceTension()(25.0)
    assert caught[0].filename == __file__


@pytest.mark.parametrize(
    ("law", "temperature", "parts"),
    [
        (
            WaltherViscosity(**VG46),
            40.0,
            ("WaltherViscosity.temperature must be above 1", "describes a glass", "celsius(40.0)"),
        ),
        (
            VogelViscosity(**WATER),
            140.0,
            (
                "VogelViscosity.temperature must be above 154.9",
                " [K], got 140.0",
                "a glass",
                "the law is meant to hold from 273.15 to 373.15 K",
                "write celsius(140.0)",
            ),
        ),
        (
            VogelViscosity(**WATER),
            139.0,
            ("VogelViscosity.temperature must be above 154.9", "got 139.0"),
        ),
        (
            IapwsSurfaceTension(),
            647.096,
            (
                "IapwsSurfaceTension.temperature must lie between 0 and 647.096 [K], got 647.096",
                "at the critical point",
                "from 248.15 to 647 K",
            ),
        ),
        (
            KellWaterDensity(),
            230.0,
            (
                "KellWaterDensity.temperature must lie between 231 and 647.096 [K], got 230.0",
                "water freezes by itself",
                "from 273.15 to 423.15 K",
            ),
        ),
        (
            LinearSurfaceTension(**TENSION),
            627.0,
            (
                "LinearSurfaceTension.temperature must lie between 0 and 626.483 [K], got 627.0",
                "no longer positive",
                "from 253.15 to 393.15 K",
            ),
        ),
    ],
)
def test_where_a_law_has_no_meaning_it_is_reported(law, temperature, parts):
    refuses(lambda: law(temperature), *parts)


@pytest.mark.parametrize("temperature", [0.0, -1.0, math.nan, math.inf, -math.inf])
@pytest.mark.parametrize(
    "law",
    [
        WaltherViscosity(**VG46),
        VogelViscosity(**WATER),
        LinearSurfaceTension(**TENSION),
        LinearDensity(**(TENSION | {"value": 880.0, "slope": 0.0})),
        IapwsSurfaceTension(),
        KellWaterDensity(),
    ],
)
def test_no_law_answers_at_an_impossible_temperature(law, temperature):
    refuses(lambda: law(temperature), f"{type(law).__name__}.temperature must", "[K], got")


# Constants of laws --------------------------------------------------------------------------


def test_walther_suspects_degrees_celsius_and_centistokes():
    refuses(
        lambda: WaltherViscosity(**(VG46 | {"temperature_1": 40.0})),
        "WaltherViscosity.temperature_1 must be at least 150 [K], got 40.0",
        "was it meant in degrees Celsius? then write celsius(40.0), or '40 degC' in a file",
    )
    refuses(
        lambda: WaltherViscosity(**(VG46 | {"kinematic_viscosity_2": 6.8})),
        "WaltherViscosity.kinematic_viscosity_2 must lie between 4e-07 (0.4 cSt) and 1 [m2/s]",
        "got 6.8; was it given in cSt? write '6.8 cSt' in a file, or 6.8*cSt",
    )


@pytest.mark.parametrize(
    ("law", "change", "parts"),
    [
        (
            partial(WaltherViscosity, **VG46),
            {"kinematic_viscosity_2": 3.9e-7},
            (
                "WaltherViscosity.kinematic_viscosity_2 must lie between 4e-07 (0.4 cSt)",
                "got 3.9e-07",
            ),
        ),
        (
            partial(WaltherViscosity, **VG46),
            {"temperature_2": 313.65},
            (
                "temperature_2 must differ from temperature_1 by at least 1 [K]",
                "two points 50 K apart",
            ),
        ),
        (
            partial(VogelViscosity, **WATER),
            {"reference_viscosity": 24.14},
            (
                "reference_viscosity must be below 1 [Pa.s], got 24.14",
                "liquids have some 1e-5 Pa.s",
            ),
        ),
    ],
)
def test_laws_of_viscosity_refuse_what_no_liquid_has(law, change, parts):
    refuses(lambda: law(**change), *parts)


@pytest.mark.parametrize("second", [46e-6, 47e-6])
def test_walther_needs_an_oil_that_thins(second):
    refuses(
        lambda: WaltherViscosity(**(VG46 | {"kinematic_viscosity_2": second})),
        "WaltherViscosity.kinematic_viscosity_2 must belong to an oil that thins as it warms",
        f"[m2/s], got {second!r}; it is given at 373.15 K, beside 4.6e-05 at 313.15 K; swapped?",
    )


@pytest.mark.parametrize(
    ("law", "given", "field", "value", "message"),
    [
        (WaltherViscosity, VG46, "temperature_1", -1.0, f"{POSITIVE} [K]"),
        (WaltherViscosity, VG46, "kinematic_viscosity_1", math.nan, f"{POSITIVE} [m2/s]"),
        (WaltherViscosity, VG46, "temperature_min", 0.0, f"{POSITIVE} [K]"),
        (VogelViscosity, WATER, "reference_viscosity", 0.0, f"{POSITIVE} [Pa.s]"),
        (VogelViscosity, WATER, "activation_temperature", 0.0, f"{POSITIVE} [K]"),
        (VogelViscosity, WATER, "divergence_temperature", -1.0, "be zero or positive, and finite"),
        (LinearSurfaceTension, TENSION, "slope", math.inf, "be a finite number [N/m/K]"),
        (LinearSurfaceTension, TENSION, "value", 0.0, f"{POSITIVE} [N/m]"),
        (LinearDensity, TENSION, "value", 0.0, f"{POSITIVE} [kg/m3]"),
        (LinearDensity, TENSION, "slope", math.nan, "be a finite number [kg/m3/K]"),
    ],
)
def test_constants_of_laws_are_checked(law, given, field, value, message):
    refuses(
        lambda: law(**(given | {field: value})),
        f"{law.__name__}.{field} must {message}",
        f"got {value!r}",
    )
