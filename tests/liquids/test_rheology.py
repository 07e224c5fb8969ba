"""Laws of pressure and shear: what they say of a liquid, their files, their messages."""

from __future__ import annotations

import math

import pytest
from refusals import POSITIVE, misfits, refuses

import contactkit as ck
from contactkit.errors import DescriptionError
from contactkit.files.structure import structure
from contactkit.files.unstructure import unstructure
from contactkit.liquids.rheology.density import DowsonHigginsonDensity
from contactkit.liquids.rheology.pressure import BarusViscosity, RoelandsViscosity
from contactkit.liquids.rheology.shear import (
    CarreauViscosity,
    EyringViscosity,
    PowerLawViscosity,
)

OIL = {"name": "oil", "viscosity": 0.1}
LAWS = {
    "pressure_viscosity": [
        BarusViscosity(pressure_coefficient=2e-8, source="typical of mineral oil"),
        RoelandsViscosity(pressure_coefficient=2e-8),
    ],
    "shear_viscosity": [
        PowerLawViscosity(exponent=0.6, critical_rate=1e4),
        CarreauViscosity(relaxation_time=1e-6, exponent=0.5, second_plateau=0.1, sharpness=1.5),
        EyringViscosity(stress=5e6),
    ],
    "pressure_density": [DowsonHigginsonDensity(), DowsonHigginsonDensity(stiffening=0.0)],
}
EACH = [(name, law) for name, laws in LAWS.items() for law in laws]


@pytest.mark.parametrize(("name", "law"), EACH)
def test_a_law_comes_back_from_a_file(name, law):
    oil = ck.Liquid(**OIL, **{name: law})
    assert structure(unstructure(oil), ck.Liquid, "test") == oil


def test_quantities_are_read_with_their_units():
    tables = OIL | {
        "pressure_viscosity": {"law": "barus", "pressure_coefficient": "20 1/GPa"},
        "shear_viscosity": {"law": "power-law", "exponent": 0.6, "critical_rate": "10 kHz"},
        "heat_capacity": "1.9 kJ/kg/K",
        "thermal_conductivity": "130 mW/m/K",
    }
    oil = structure(tables, ck.Liquid, "test")
    assert oil.pressure_viscosity.pressure_coefficient == pytest.approx(2e-8, rel=1e-15)
    assert oil.shear_viscosity.critical_rate == 1e4
    assert (oil.heat_capacity, oil.thermal_conductivity) == (1900.0, 0.13)


@pytest.mark.parametrize(("name", "law"), EACH)
def test_a_liquid_with_a_law_is_newtonian_only_if_that_is_of_its_density(name, law):
    assert ck.Liquid(**OIL, **{name: law}).is_newtonian is (name == "pressure_density")


# Values -------------------------------------------------------------------------------------


@pytest.mark.parametrize("viscosity", [1e-3, 0.1, 10.0])
def test_roelands_begins_with_the_coefficient_of_barus(viscosity):
    barus, roelands = (law.pressure_law(viscosity) for law in LAWS["pressure_viscosity"])
    for pressure in (-1e5, 1e5):
        ratio = float(roelands.multiplier(pressure) / barus.multiplier(pressure))
        assert ratio == pytest.approx(1.0, abs=2e-6)
    # Published numbers: 40 mPa.s and 22.4 1/GPa are Z = 0.68, 1127 times as thick at 0.5 GPa.
    oil = RoelandsViscosity(pressure_coefficient=22.382e-9).pressure_law(0.04)
    assert oil.exponent == pytest.approx(0.68, rel=1e-4)


def test_roelands_thickens_less_than_barus():
    barus, roelands = (law.pressure_law(0.1) for law in LAWS["pressure_viscosity"])
    # ln(eta/eta0) = (ln 0.1 + 9.67) ((1 + p/0.196 GPa)^Z - 1), Z = 2e-8 0.196e9/7.3674
    exponent = 2e-8 * 0.196e9 / (math.log(0.1) + 9.67)
    at = (math.log(0.1) + 9.67) * ((1.0 + 1e9 / 0.196e9) ** exponent - 1.0)
    assert float(roelands.multiplier(1e9)) == pytest.approx(math.exp(at), rel=1e-12)
    assert float(roelands.multiplier(1e9)) < 1e-2 * float(barus.multiplier(1e9))


@pytest.mark.parametrize("law", LAWS["shear_viscosity"])
def test_a_liquid_at_rest_has_its_viscosity_and_thins_with_shear(law):
    flow, gap = law.flow_law(0.1), 1e-6
    for flux in (1e-22, 1e-20):  # rates far below those of each law
        newtonian = 12.0 * 0.1 * flux / gap**3
        assert flow.gradient(flux, gap) == pytest.approx(newtonian, rel=1e-9)
    fast = 1e-2  # 6 q/h^2 = 6e10 1/s
    assert flow.gradient(fast, gap) < 0.5 * 12.0 * 0.1 * fast / gap**3


def test_each_shear_law_has_the_viscosity_of_its_formula():
    power, carreau, eyring = LAWS["shear_viscosity"]
    rate, gap, eta = 1e8, 1e-6, 0.1
    # Of a law that is a power over the rates of a film, the gradient is 2 tau_w/h, with the wall
    # rate (2n + 1)/(3n) 6q/h^2.
    flux = rate * gap**2 / 6.0 * 3.0 * 0.6 / 2.2
    stress = eta * 1e4**0.4 * rate**0.6
    assert power.flow_law(eta).wall_stress(flux, gap) == pytest.approx(stress, rel=1e-4)
    formulas = {
        carreau: lambda g: g * eta * (0.1 + 0.9 * (1.0 + (1e-6 * g) ** 1.5) ** (-0.5 / 1.5)),
        eyring: lambda g: 5e6 * math.asinh(eta * g / 5e6),
    }
    for law, formula in formulas.items():
        flow = law.flow_law(eta)
        wall_rate, found = flow.wall_shear_rate(flux, gap), flow.wall_stress(flux, gap)
        assert found == pytest.approx(formula(wall_rate), rel=1e-10)
        assert found < 0.8 * eta * wall_rate


def test_a_power_law_of_exponent_one_is_newtonian():
    flow = PowerLawViscosity(exponent=1.0, critical_rate=1.0).flow_law(0.1)
    assert flow.gradient(1e-3, 1e-6) == pytest.approx(12.0 * 0.1 * 1e-3 / 1e-18, rel=1e-12)


def test_memory_is_the_time_beyond_which_rates_thin():
    power, carreau, eyring = LAWS["shear_viscosity"]
    assert [law.memory(0.1) for law in (power, carreau, eyring)] == [1e-4, 1e-6, 0.1 / 5e6]


def test_density_of_dowson_and_higginson():
    oil = DowsonHigginsonDensity()
    # Hamrock: 1 + 0.6 p/(1 + 1.7 p), p in GPa
    assert oil.relative_change(0.5e9) == pytest.approx(0.3 / 1.85, rel=1e-14)
    small = oil.relative_change(1e3) / 1e3  # rounding of the ratio 4e-10, stiffening 1.7e-6
    assert small == pytest.approx(oil.initial_compressibility, rel=3e-6)
    assert oil.relative_change(-1e7) == pytest.approx(-0.6e-2, rel=1e-12)


# Messages -----------------------------------------------------------------------------------


def test_constants_must_be_positive():
    barus, carreau = LAWS["pressure_viscosity"][0], LAWS["shear_viscosity"][1]
    rows = [
        (barus, "pressure_coefficient", "1/Pa", POSITIVE, [0.0, -1e-8]),
        (carreau, "relaxation_time", "s", POSITIVE, [0.0, -1.0]),
        (carreau, "sharpness", "", POSITIVE, [0.0]),
        (EyringViscosity(stress=1e6), "stress", "Pa", POSITIVE, [0.0, -1.0]),
        (LAWS["shear_viscosity"][0], "critical_rate", "1/s", POSITIVE, [0.0, -1.0]),
        (ck.Liquid(name="x"), "heat_capacity", "J/kg/K", POSITIVE, [0.0, -1.0]),
        (ck.Liquid(name="x"), "thermal_conductivity", "W/m/K", POSITIVE, [0.0, -1.0]),
    ]
    assert misfits(rows) == {}


@pytest.mark.parametrize(
    ("make", "parts"),
    [
        (
            lambda: BarusViscosity(pressure_coefficient=20.0),
            ("be at most 1e-06 [1/Pa], got 20.0", "was it given in 1/GPa? write '20 1/GPa'"),
        ),
        (
            lambda: EyringViscosity(stress=5.0),
            ("be at least 100 [Pa], got 5.0", "was it given in MPa?"),
        ),
        (
            lambda: PowerLawViscosity(exponent=0.01, critical_rate=1.0),
            ("exponent must lie between 0.1 and 1.5, got 0.01", "1 is a Newtonian liquid"),
        ),
        (
            lambda: CarreauViscosity(relaxation_time=1e-6, exponent=1.2),
            ("exponent must lie between 0.1 and 1, got 1.2", "give a power-law"),
        ),
        (
            lambda: CarreauViscosity(relaxation_time=1e-6, exponent=0.5, second_plateau=1.0),
            ("second_plateau must be below 1, got 1.0", "a fraction of the viscosity at rest"),
        ),
        (
            lambda: ck.Liquid(name="x", heat_capacity=1.9),
            ("Liquid.heat_capacity must be at least 50 [J/kg/K], got 1.9", "kJ/kg/K"),
        ),
        (
            lambda: ck.Liquid(
                name="x", bulk_modulus=1e9, pressure_density=DowsonHigginsonDensity()
            ),
            ("Liquid.pressure_density must be left out where bulk_modulus is given",),
        ),
        (
            lambda: ck.Liquid(name="x", shear_viscosity=BarusViscosity(pressure_coefficient=1e-8)),
            ("Liquid.shear_viscosity must be a ShearViscosity",),
        ),
        (
            lambda: RoelandsViscosity(pressure_coefficient=2e-8).pressure_law(5e-5),
            ("Liquid.viscosity must exceed 6.31e-05", "got 5e-05", "take BarusViscosity"),
        ),
    ],
)
def test_messages(make, parts):
    refuses(make, *parts, error=DescriptionError)
