"""Numbers of validity of deforming bodies, and the liquid that a dimple keeps."""

import math

import attrs
import numpy as np
import pytest

import contactkit as ck
from contactkit.lubrication.elastohydrodynamic.motion import Profile
from contactkit.separation.deforming.run import _trapped

OIL = ck.Liquid(name="oil", viscosity=0.1)
WATER = ck.Liquid(
    name="water", viscosity=1e-3, surface_tension=0.072, density=998.2, molar_mass=0.018015
)
SOFT = ck.Material(young_modulus=1e5, poisson_ratio=0.5)
DRAFT = ck.Accuracy(film_rtol=1e-2)


def section(gap, liquid=None):
    radius = np.linspace(0.0, 2.0, len(gap))
    none = np.zeros(len(gap))
    full = np.ones(len(gap)) if liquid is None else liquid
    return Profile(0.0, radius, gap, none, none, full)


def test_a_dimple_traps_its_liquid():
    """A paraboloid of the depth 1 over a ring of the radius 1 holds pi/2."""
    x = np.linspace(0.0, 2.0, 2001)
    dimple = 3.0 - x**2 * (2.0 - x**2) * 1.0
    # Between the axis and 1: int 2 pi x (1 - 2 x^2 + x^4) dx = pi/3.
    assert _trapped(section(dimple)) == pytest.approx(math.pi / 3.0, rel=1e-5)


def test_a_contact_and_a_paraboloid_trap_nothing():
    x = np.linspace(0.0, 2.0, 201)
    assert _trapped(section(1.0 + x**2)) == 0.0
    assert _trapped(section(np.maximum(1.0, x**2))) == 0.0


def test_a_pocket_within_a_contact_traps_its_liquid():
    """Where a cavity is, only its liquid counts."""
    x = np.linspace(0.0, 2.0, 2001)
    pocket = np.where(x < 0.5, 1.0 + 0.25 - x**2, np.maximum(1.0, x**2))
    full = _trapped(section(pocket))
    assert full == pytest.approx(math.pi * 0.5**4 / 2.0, rel=1e-3)
    assert _trapped(section(pocket, np.where(x < 0.25, 0.9, 1.0))) < full


def pressed(press, rest, *effects):
    return ck.SeparationScene(
        interface=ck.Interface(
            lower=ck.Body(surface=ck.Flat(radius=2e-3), solid=SOFT),
            upper=ck.Sphere(radius=5e-3),
            meniscus=ck.Meniscus(liquid=OIL),
        ),
        loading=ck.PressAndPull(
            press=press, rest=rest, speed=1e-5, initial_gap=4e-6, final_gap=8e-6
        ),
        effects=(ck.ElasticBodies(), ck.ViscousForce(), *effects),
    )


@pytest.mark.slow
@pytest.mark.filterwarnings("ignore::contactkit.ValidityWarning")
def test_pressing_traps_a_dimple():
    """Against the section itself, on the finest mesh of another accuracy (6e-5 takes 10 s)."""
    found = ck.simulate(ck.plan(pressed(1e-3, 2.0)))
    finer = ck.simulate(ck.plan(pressed(1e-3, 2.0), ck.Accuracy(film_rtol=1.5e-4)))
    trapped, unit = found.scalars()["trapped_volume"]
    assert unit == "m3"
    assert trapped == pytest.approx(finer.scalars()["trapped_volume"][0], rel=0.08)
    at = finer.section(2.0)
    ring = int(at.gap.argmin())
    beyond = np.trapezoid(2.0 * math.pi * at.radius * (at.gap - at.gap[ring]), at.radius)
    inside = np.trapezoid(
        (2.0 * math.pi * at.radius * (at.gap - at.gap[ring]))[: ring + 1], at.radius[: ring + 1]
    )
    assert finer.scalars()["trapped_volume"][0] == pytest.approx(inside, rel=1e-2)
    assert inside < 0.1 * beyond


@pytest.mark.slow
@pytest.mark.filterwarnings("ignore:slope of the gap")
def test_a_rest_too_short_to_drain_warns_with_its_number():
    made = ck.plan(pressed(1e-3, 0.02, ck.SolidContact(cutoff=3e-7)), DRAFT)
    assert made.rest_number < 1.0
    with pytest.warns(ck.ValidityWarning, match=r"rest over the time of drainage = \S+e-05 "):
        found = ck.simulate(made)
    assert found.scalars()["largest_contact_force"][0] == 0.0


def tip(speed, humidity=0.8, liquid=WATER):
    return ck.SeparationScene(
        interface=ck.Interface(
            lower=ck.Body(solid=ck.Material(young_modulus=1e11, poisson_ratio=0.2)),
            upper=ck.Sphere(radius=1e-5),
            meniscus=ck.Meniscus(liquid=liquid, relative_humidity=humidity),
        ),
        loading=ck.ImposedSpeed(speed=speed, initial_gap=2.5e-9, final_gap=5e-9),
        effects=(ck.ElasticBodies(), ck.ViscousForce(), ck.MeniscusForce()),
    )


VAPOUR = "duration over the time in which vapour"


@pytest.mark.slow
@pytest.mark.filterwarnings("ignore:tension over")
def test_a_pull_slower_than_vapour_warns_with_its_number():
    with pytest.warns(ck.ValidityWarning, match=f"{VAPOUR} .* = .*at most 0.1"):
        slow = ck.simulate(ck.plan(tip(1e-6, 0.97), DRAFT))
    fast = ck.simulate(ck.plan(tip(1e-1, 0.97), DRAFT))
    values = [
        next(one for one in found.validity if one.name.startswith(VAPOUR)).value
        for found in (slow, fast)
    ]
    assert values[0] == pytest.approx(1e5 * values[1], rel=1e-6)


@pytest.mark.slow
@pytest.mark.filterwarnings("ignore:tension over")
def test_vapour_of_an_unknown_liquid_is_not_evaluated():
    other = attrs.evolve(WATER, molar_mass=0.046)
    found = ck.simulate(ck.plan(tip(1e-1, 0.97, other), DRAFT))
    number = next(one for one in found.validity if one.name.startswith(VAPOUR))
    assert number.value is None
    assert "takes water" in number.detail


@pytest.mark.filterwarnings("ignore:slope of the gap", "ignore:rim over")
def test_soft_bodies_warn_of_large_strains():
    """133 kPa of E*, and a pull that rigid bodies would resist by 28 MPa."""
    made = attrs.evolve(
        pressed(1e-3, 0.02),
        loading=ck.ImposedSpeed(speed=0.3, initial_gap=4e-6, final_gap=3e-4),
    )
    with pytest.warns(ck.ValidityWarning, match=r"pressure over E\* = .*at most 0.1"):
        ck.simulate(ck.plan(made, DRAFT))
