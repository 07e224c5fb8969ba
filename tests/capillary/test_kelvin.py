"""Kelvin's equation and thin menisci: reference values, limits, and a balance of energies."""

from __future__ import annotations

import json
import math
from pathlib import Path
from typing import ClassVar

import numpy as np
import pytest
from attrs import frozen

import contactkit as ck
from contactkit.capillary import kelvin
from contactkit.errors import DescriptionError, InfeasibleError
from contactkit.separation.effects.base import ForceLaw, SeparationForce

CASES = json.loads((Path(__file__).parents[1] / "data" / "menisci.json").read_text())
TENSION, MOLAR, ROOM = 0.072, 18e-6, 298.15  # those of the case file


@pytest.mark.parametrize(("humidity", "name"), [(0.5, "0_5"), (0.9, "0_9"), (0.99, "0_99")])
def test_the_kelvin_radius_of_water(humidity, name):
    found = kelvin.kelvin_radius(TENSION, MOLAR, ROOM, humidity)
    assert found * 1e9 == pytest.approx(CASES["physics"][f"kelvin_radius_nm_rh_{name}"], rel=1e-13)


def test_the_kelvin_length_is_the_radius_at_one_over_e():
    found = kelvin.kelvin_radius(TENSION, MOLAR, ROOM, math.exp(-1.0))
    assert found * 1e9 == pytest.approx(CASES["physics"]["kelvin_length_nm"], rel=1e-13)


def test_arrays_and_numbers_agree_and_the_inverse_leads_back():
    humidity = np.array([1e-12, 0.1, 0.5, 0.999999])
    pressure = kelvin.laplace_pressure(MOLAR, ROOM, humidity)
    assert kelvin.relative_humidity(pressure, MOLAR, ROOM) == pytest.approx(humidity, rel=1e-13)
    one = [kelvin.laplace_pressure(MOLAR, ROOM, h) for h in humidity.tolist()]
    assert pressure == pytest.approx(one, rel=1e-15)
    assert kelvin.relative_humidity(one[1], MOLAR, ROOM) == pytest.approx(0.1, rel=1e-13)


def test_next_to_saturation_the_radius_grows_as_one_over_what_is_missing():
    missing = 2.0**-40
    found = kelvin.kelvin_radius(TENSION, MOLAR, ROOM, 1.0 - missing)
    length = TENSION * MOLAR / (kelvin.GAS_CONSTANT * ROOM)
    assert found == pytest.approx(length / missing, rel=1e-11)


def test_what_is_gained_by_condensing_a_mole_pays_for_its_pressure():
    """Work of bringing vapour to saturation, step by step, against v times the pressure."""
    steps = np.linspace(0.3, 1.0, 20001)
    middle = 0.5 * (steps[1:] + steps[:-1])
    work = kelvin.GAS_CONSTANT * ROOM * np.sum(np.diff(steps) / middle)
    assert -MOLAR * kelvin.laplace_pressure(MOLAR, ROOM, 0.3) == pytest.approx(work, rel=1e-8)


@pytest.mark.parametrize("humidity", [0.0, -0.1, np.array([0.5, 0.0])])
def test_without_vapour_nothing_condenses(humidity):
    with pytest.raises(InfeasibleError, match=r"nothing condenses.*give a humidity above 0"):
        kelvin.laplace_pressure(MOLAR, ROOM, humidity)


@pytest.mark.parametrize("humidity", [1.0, 1.2, np.array([0.5, 1.0])])
def test_at_saturation_the_gap_floods(humidity):
    with pytest.raises(InfeasibleError, match=r"floods the gap; give a humidity below 1"):
        kelvin.kelvin_radius(TENSION, MOLAR, ROOM, humidity)


def test_a_thin_meniscus_pulls_less_the_wider_the_gap_and_ends_at_its_height():
    gap = np.linspace(0.0, 3e-9, 7)
    found = kelvin.thin_film_force(1e-6, gap, TENSION, 2.0, 1.5e-9)
    assert found[0] == pytest.approx(4.0 * math.pi * 1e-6 * TENSION, rel=1e-15)
    assert found[1] == pytest.approx(found[0] * 2.0 / 3.0, rel=1e-14)
    assert np.all(found[3:] == 0.0)


def test_its_force_is_pressure_times_the_area_of_a_parabola():
    """F = -p A with A where the gap of the sphere is below the height of the meniscus."""
    radius, gap, pressure = 1e-6, 0.4e-9, -95e6
    height = kelvin.meniscus_height(pressure, TENSION, 1.5)
    x = np.linspace(0.0, 2.0 * math.sqrt(2.0 * radius * height), 200001)
    under = gap + x * x / (2.0 * radius) < height
    area = np.sum(2.0 * math.pi * x[under]) * (x[1] - x[0])
    found = kelvin.thin_film_force(radius, gap, TENSION, 1.5, height)
    assert found == pytest.approx(-pressure * area, rel=2e-5)


# Scene objects ----------------------------------------------------------------------------------


def test_a_meniscus_of_a_humidity_has_the_pressure_of_its_own_liquid():
    water = ck.load_liquid("water")
    made = ck.Meniscus(liquid=water, relative_humidity=0.5)
    density = water.at(ROOM).density
    assert (made.volume, made.pressure) == (None, None)
    assert made.pressure_at(ROOM) == pytest.approx(
        kelvin.GAS_CONSTANT * ROOM * math.log(0.5) * density / 0.018015, rel=1e-13
    )
    assert made.pressure_at(293.15) > made.pressure_at(ROOM)


def test_a_volume_of_a_coverage_is_that_of_upright_rims():
    water = ck.load_liquid("water")
    made = ck.Meniscus.from_coverage(
        liquid=water, coverage=0.4, area=1e-12, at_gap=2e-9, count=50, contact_angle_lower=1.0
    )
    assert (made.volume, made.count) == (pytest.approx(8e-22, rel=1e-15), 50)
    assert (made.contact_angle_lower, made.contact_angle_upper) == (1.0, 0.0)


REFUSED = [
    (lambda w: ck.Meniscus(liquid=w, pressure=0.0), "pressure must be negative and finite"),
    (lambda w: ck.Meniscus(liquid=w, pressure=1e5), r"\[Pa\], got 100000.0; liquid of a positive"),
    (lambda w: ck.Meniscus(liquid=w, pressure=-math.inf), "be negative and finite"),
    (lambda w: ck.Meniscus(liquid=w, pressure=-1e5, volume=1e-20), "one of volume"),
    (
        lambda w: ck.Meniscus(liquid=w, relative_humidity=50.0),
        "lie between 0 and 1, got 50.0; a fraction, not per cent",
    ),
    (lambda w: ck.Meniscus(liquid=w, relative_humidity=math.nan), "between 0 and 1"),
    (
        lambda w: ck.Meniscus.from_coverage(liquid=w, coverage=1.1, area=1.0, at_gap=1.0),
        r"from_coverage\(coverage\) must lie above 0 and not above 1",
    ),
    (
        lambda w: ck.Meniscus.from_coverage(liquid=w, coverage=0.5, area=0.0, at_gap=1.0),
        r"from_coverage\(area\) must be positive and finite \[m2\]",
    ),
    (
        lambda w: ck.Meniscus.from_coverage(liquid=w, coverage=0.5, area=1.0, at_gap=math.inf),
        r"from_coverage\(at_gap\) must be positive and finite \[m\]",
    ),
    (
        lambda w: ck.Liquid(name="water", molar_mass=18.015),
        r"molar_mass must be at most 10 \[kg/mol\].*'18.015 g/mol'",
    ),
    (lambda w: ck.Liquid(name="oil", molar_mass=-1.0), "be positive and finite"),
    (
        lambda w: ck.Liquid(name="oil", density=900.0).molar_volume(300.0),
        r"Liquid.molar_mass must be given for a liquid in equilibrium with its vapour \[kg/mol\]",
    ),
    (lambda w: ck.Liquid(name="oil", molar_mass=0.4).molar_volume(300.0), "Liquid.density"),
]


@pytest.mark.parametrize(("make", "message"), REFUSED)
def test_what_is_impossible_is_refused(make, message):
    with pytest.raises(DescriptionError, match=message):
        make(ck.load_liquid("water"))


@pytest.mark.parametrize("humidity", [0.0, 1.0])
def test_dry_and_saturated_air_make_no_meniscus(humidity):
    with pytest.raises(InfeasibleError, match="meniscus"):
        ck.Meniscus(liquid=ck.load_liquid("water"), relative_humidity=humidity).pressure_at(ROOM)


@frozen(kw_only=True)
class OfAVolume(SeparationForce):
    """A force that knows a volume only."""

    name: ClassVar[str] = "of-a-volume"
    column: ClassVar[str] = "meniscus_force"
    sources = ("none",)

    def prepare(self, scene, accuracy):
        return ForceLaw(lambda gap, speed: 0.0)


def test_an_effect_without_a_law_at_fixed_pressure_refuses_it():
    scene = ck.SeparationScene(
        interface=ck.Interface(
            upper=ck.Sphere(radius=1e-6),
            meniscus=ck.Meniscus(liquid=ck.load_liquid("water"), pressure=-1e7),
        ),
        loading=ck.ImposedSpeed(initial_gap=1e-9, final_gap=1e-7, speed=1e-6),
        effects=(OfAVolume(),),
    )
    with pytest.raises(
        ck.PlanError, match=r"OfAVolume needs interface.meniscus.volume \[m3\] in place of its"
    ):
        ck.plan(scene)
