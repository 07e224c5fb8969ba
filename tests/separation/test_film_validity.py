"""What a viscous film leaves out: each number by another method, and at the edge of its range."""

from __future__ import annotations

import math
import warnings

import attrs
import loadings
import numpy as np
import pytest
from numpy.polynomial import Polynomial
from scipy.integrate import quad

import contactkit as ck
from contactkit.capillary.exact.bridge import bridge, bridge_at_pressure
from contactkit.lubrication import dimensionless
from contactkit.lubrication.squeeze_film import disc_force
from contactkit.separation.effects import film_validity
from contactkit.separation.effects.film_validity import film_numbers

COMPRESSION, BENDING = "pressure over bulk modulus", "bending of the faces over the gap"
SOFT, WEIGHT = "soft-face number", "weight of the film over its pressure"
NUMBERS = (COMPRESSION, BENDING, SOFT, WEIGHT)


def solid(modulus, poisson_ratio=0.3):
    """A material of a given plane-strain modulus [Pa]."""
    young = modulus * (1.0 - poisson_ratio**2)
    return ck.Material(young_modulus=young, poisson_ratio=poisson_ratio)


def face(modulus=None, radius=1e-3):
    material = None if modulus is None else solid(modulus)
    return ck.Body(surface=ck.Flat(radius=radius), solid=material)


def judged(scene):
    """Numbers of a scene by name, and the names that it warns of."""
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        result = ck.simulate(ck.plan(scene, loadings.with_points(scene, 20)))
    texts = [str(w.message) for w in caught if w.category is ck.ValidityWarning]
    found = {number.name: number for number in result.validity}
    return found, {name for name in found if any(text.startswith(name) for text in texts)}


# Formulas by another method -----------------------------------------------------------------


def test_inertia_is_one_iteration_of_navier_stokes_on_the_parabola():
    """Steady opening of a disc, in units of gap, speed and viscosity: u = r f(z), w = -2 int f."""
    z = Polynomial([0.0, 1.0])
    f, w, change = -3.0 * z * (1.0 - z), 3.0 * z**2 - 2.0 * z**3, 6.0 * z - 9.0 * z**2

    def gradient(inertia):
        """Pressure gradient over r that keeps the flux, where inertia drives a correction."""
        twice = inertia.integ().integ()
        return 12.0 * (0.5 * twice(1.0) - twice.integ()(1.0))

    viscous = -f.deriv(2)(0.0)
    steady = gradient(change + f * f + w * f.deriv()) / viscous
    assert dimensionless.inertia_fraction(1.0) == pytest.approx(-steady, rel=1e-12)


def test_the_deflection_between_flats_is_boussinesqs_integral():
    """The centre of a half-space sinks by 2/E* times the integral of the pressure over r."""
    rate, gap, radius = 0.1 * 2e-6, 1e-6, 1e-3

    def pressure(r):
        return 3.0 * rate * (radius**2 - r**2) / gap**3

    force, _ = quad(lambda r: 2.0 * math.pi * r * pressure(r), 0.0, radius)
    assert float(disc_force(radius, gap, 2e-6, 0.1)) == pytest.approx(force, rel=1e-12)
    deflection, _ = quad(pressure, 0.0, radius)
    value = dimensionless.face_bending(2.0 * deflection, 1e9, gap)
    assert value == pytest.approx(4.0 * rate * radius**3 / (1e9 * gap**4), rel=1e-12)


@pytest.mark.parametrize("radius", [1e-6, 3e-5, 1e-3])
def test_the_deflection_under_a_sphere_is_the_integral_of_its_pressure(radius):
    rate, gap, sphere = 1e-7, 1e-7, 1e-3

    def height(r):
        return gap + 0.5 * r * r / sphere

    def pressure(r):
        return film_validity._under_sphere(rate, height(r), sphere, height(radius))

    integral, _ = quad(pressure, 0.0, radius, points=[1e-5] if radius > 1e-5 else None, limit=200)
    found = film_validity._deflection_under_sphere(rate, gap, sphere, radius, height(radius))
    assert found == pytest.approx(2.0 * integral, rel=1e-8)


def test_a_flooded_sphere_is_the_limit_of_a_wide_film():
    flooded = film_validity._deflection_under_sphere(1e-7, 1e-7, 1e-3, math.inf, math.inf)
    wide = film_validity._deflection_under_sphere(1e-7, 1e-7, 1e-3, 1.0, 500.0)
    assert flooded == pytest.approx(wide, rel=1e-6)


def test_a_film_that_is_small_against_its_sphere_is_one_between_flats():
    small = film_validity._deflection_under_sphere(1e-7, 1e-6, 1.0, 1e-5, 1e-6 + 5e-11)
    assert small == pytest.approx(4.0 / 3.0 * 3.0 * 1e-7 * 1e-15 / 1e-18, rel=1e-3)


# Edges of the ranges ------------------------------------------------------------------------

# The film at its start: 0.1 Pa.s, 1 um, 1 um/s and 1 mm make 3e5 Pa.
EDGES = {
    COMPRESSION: lambda share: {"liquid": {"bulk_modulus": 3e5 / (0.05 * share)}},
    BENDING: lambda share: {"lower": face(4e8 / (0.05 * share)), "upper": face()},
    SOFT: lambda share: {"lower": face(2.0 * 3.1e8 / share), "upper": face(2.0 * 3.1e8 / share)},
    WEIGHT: lambda share: {
        "liquid": {"density": 900.0, "surface_tension": None},
        "speed": 900.0 * dimensionless.GRAVITY * 1e-5 / (0.05 * share) / 3e5 * 1e-6,
    },
}


@pytest.mark.parametrize("name", NUMBERS)
@pytest.mark.parametrize("share", [0.99, 1.01])
def test_a_number_warns_from_its_range_on(film_scene, name, share):
    found, warned = judged(film_scene(ck.ViscousForce(), **EDGES[name](share)))
    number = found[name]
    assert number.value == pytest.approx(share * number.high, rel=1e-9)
    assert number.is_valid is (share < 1.0)
    assert (name in warned) is (share > 1.0)
    assert number.detail
    assert number.source


def test_what_is_not_given_is_named_and_warns_of_nothing(film_scene):
    found, warned = judged(film_scene(ck.ViscousForce()))
    assert {name: found[name].value for name in NUMBERS} == dict.fromkeys(NUMBERS)
    assert warned.isdisjoint(NUMBERS)
    details = ("liquid.bulk_modulus [Pa]", "no body has a solid", "no body has", "liquid.density")
    for name, detail in zip(NUMBERS, details, strict=True):
        assert detail in str(found[name])


# The strength of the liquid -----------------------------------------------------------------


def test_the_strength_of_the_liquid_bounds_its_tension(film_scene):
    """Uniform tension up to the rim is what deflects most: 2 p r/(E* h)."""
    given = {"lower": face(1e11), "liquid": {"bulk_modulus": 1e9}}
    strength = 1e4
    limit = limit_of(strength)
    found, _ = judged(film_scene(ck.ViscousForce(), limit, **given))
    assert found[COMPRESSION].value == pytest.approx(strength / 1e9, rel=1e-12)
    assert found[BENDING].value == pytest.approx(2.0 * strength * 1e-3 / (1e11 * 1e-6), rel=1e-9)
    free, _ = judged(film_scene(ck.ViscousForce(), **given))
    assert free[COMPRESSION].value == pytest.approx(3e5 / 1e9, rel=1e-12)
    # Where the film cavitates its pressure does not follow the speed; on a wider gap it does.
    assert 0.0 < found[SOFT].value < 0.2 * free[SOFT].value


def limit_of(strength):
    return ck.TensionLimit(strength=strength)


def test_closing_counts_where_the_liquid_does_not_cavitate(film_scene):
    plan = ck.plan(film_scene(ck.ViscousForce(), liquid={"bulk_modulus": 1e9}))
    prepared, film = plan.prepared, plan.prepared.film

    def pressure(path, strength):
        return film_numbers(prepared, film, path, strength)[0].value

    opening, closing = [(1e-6, 1e-6)], [(1e-6, -2e-6)]
    assert pressure(closing, math.inf) == pytest.approx(2.0 * pressure(opening, math.inf))
    assert pressure(opening + closing, 1e9) == pressure(opening, 1e9)
    assert pressure(closing, 1e9) is None


# Faces --------------------------------------------------------------------------------------


def test_thin_layers_do_not_stiffen_a_face_and_thick_ones_do(film_scene):
    def bending(thickness):
        layer = ck.Layer(material=solid(1e12), thickness=thickness)
        coated = ck.Body(
            surface=ck.Flat(radius=1e-3), solid=ck.Stack(layers=[layer], substrate=solid(1e10))
        )
        return judged(film_scene(ck.ViscousForce(), lower=coated, upper=face()))[0][BENDING].value

    bare = judged(film_scene(ck.ViscousForce(), lower=face(1e10), upper=face()))[0][BENDING].value
    assert bending(1e-6) == bare
    assert bending(2e-3) == pytest.approx(0.01 * bare, rel=1e-12)


def test_a_wetted_sphere_is_judged_by_the_width_under_its_apex(film_scene):
    ball = ck.Body(surface=ck.Sphere(radius=1e-3), solid=solid(1e11))
    found, _ = judged(film_scene(ck.ViscousForce(), lower=ck.Flat(), upper=ball, speed=1e-3))
    width = math.sqrt(2.0 * 1e-3 * 1e-6)
    wanted = 1.5 * math.pi * 1e-4 * 1e-3 * width / 1e-12 / (1e11 * 1e-6)
    assert found[BENDING].value == pytest.approx(wanted, rel=1e-9)
    soft = dimensionless.soft_face_number(0.1, width, 1e11, 1e-6, 1e-6 / 1e-3)
    assert found[SOFT].value == pytest.approx(soft, rel=1e-9)


def test_the_injector_stays_in_all_ranges():
    """A film of engine oil between faces of steel, which its scene leaves out."""
    steel = ck.load_material("bearing-steel")
    end = ck.Body(surface=ck.Flat(radius=3.175e-3), solid=steel)
    film = ck.Meniscus(liquid=ck.load_liquid("engine-oil-15w-40"), volume=0.16e-9)
    scene = ck.SeparationScene(
        interface=ck.Interface(lower=end, upper=end, meniscus=film),
        loading=ck.ImposedForce(initial_gap=5e-6, final_gap=25e-6, force=40.0, mass=0.02),
        effects=(ck.ViscousForce(), limit_of(1e6)),
    )
    found, warned = judged(scene)
    assert warned.isdisjoint((*NUMBERS, "Reynolds number", "slenderness of the film"))
    assert found[BENDING].value == pytest.approx(0.011, rel=0.05)
    assert found[COMPRESSION].value == pytest.approx(1e6 / 1.5e9, rel=1e-9)
    one = attrs.evolve(scene.interface, upper=end.surface)
    rigid, _ = judged(attrs.evolve(scene, interface=one))
    assert rigid[BENDING].value == pytest.approx(0.5 * found[BENDING].value, rel=1e-6)


def test_numbers_say_how_much_inertia_and_rim_take(film_scene):
    found, _ = judged(film_scene(ck.ViscousForce(), liquid={"density": 1000.0}, speed=1.0))
    reynolds, slender = found["Reynolds number"], found["slenderness of the film"]
    inertia = 5.0 / 28.0 * reynolds.value
    assert f"about {inertia:.2g} of the force" in reynolds.detail
    assert f"about {16.0 / (3.0 * np.pi) / slender.value:.2g} of the force" in slender.detail


# Weight of a meniscus -----------------------------------------------------------------------

HEAVY = "weight of the meniscus over its force"


def drop(volume, density=1000.0, angle=0.0, count=1, upper=None, tension=0.072, **loading):
    water = ck.Liquid(name="water", viscosity=1e-3, surface_tension=tension, density=density)
    film = ck.Meniscus(
        liquid=water,
        volume=volume,
        contact_angle_lower=angle,
        contact_angle_upper=angle,
        count=count,
    )
    size = (volume / count) ** (1.0 / 3.0)
    given = {"initial_gap": 0.1 * size, "final_gap": 0.5 * size, "speed": 1e-9} | loading
    return ck.SeparationScene(
        interface=ck.Interface(
            lower=ck.Body(surface=ck.Flat()), upper=upper or ck.Body(surface=ck.Flat()),
            meniscus=film,
        ),
        loading=ck.ImposedSpeed(**given),
        effects=(ck.MeniscusForce(),),
    )  # fmt: skip


def test_the_weight_of_a_bridge_is_that_of_its_volume_over_its_least_force():
    volume, size = 1e-9, 1e-3
    found, warned = judged(drop(volume))
    least = 0.072 * float(bridge(0.5 * size, volume, 0.0, 0.0).force)
    assert found[HEAVY].value == pytest.approx(9.80665e-6 / least, rel=1e-6)
    assert (HEAVY in warned) == (found[HEAVY].value > 0.05)


def test_the_weight_counts_as_the_square_of_the_size():
    """And many small bridges weigh less than one, over their force."""
    one = judged(drop(1e-9))[0][HEAVY].value
    assert judged(drop(1e-12))[0][HEAVY].value == pytest.approx(one / 100.0, rel=1e-6)
    parted = judged(drop(1e-9, count=1000))[0][HEAVY].value
    assert parted == pytest.approx(one / 100.0, rel=1e-6)


def test_the_weight_is_not_judged_without_a_density():
    found, warned = judged(drop(1e-9, density=None))
    assert found[HEAVY].value is None
    assert found[HEAVY].is_valid is None
    assert "not judged, liquid.density [kg/m3]" in str(found[HEAVY])
    assert HEAVY not in warned


def test_a_force_that_changes_sign_is_judged_by_the_line_tension():
    """At 100 degrees flats are pushed apart, and pulled together beyond half the size."""
    angle, volume, size = math.radians(100.0), 1e-12, 1e-4
    gaps = np.linspace(0.3, 1.2, 50) * size
    force = bridge(gaps, volume, angle, angle).force
    assert force[0] < 0.0 < force[-1]
    ends = {"initial_gap": gaps[0], "final_gap": gaps[-1]}
    found, warned = judged(drop(volume, angle=angle, **ends))
    assert found[HEAVY].value == pytest.approx(9.80665e-9 / (0.3 * 0.072 * size), rel=1e-3)
    assert HEAVY not in warned


def test_the_weight_of_a_flooded_face_is_that_of_what_it_holds():
    water = ck.Liquid(name="water", viscosity=1e-3, surface_tension=0.072, density=1000.0)
    face = ck.Body(surface=ck.Flat(radius=1e-3))
    scene = ck.SeparationScene(
        interface=ck.Interface(lower=face, upper=face, meniscus=ck.Meniscus(liquid=water)),
        loading=ck.ImposedSpeed(initial_gap=1e-5, final_gap=1e-4, speed=1e-9),
        effects=(ck.MeniscusForce(),),
    )
    plan = ck.plan(scene)
    force = ck.simulate(plan).columns["meniscus_force"][-1]
    found, _ = judged(scene)
    assert found[HEAVY].value == pytest.approx(9.80665 * math.pi * 1e-7 / force, rel=1e-9)


def test_the_weight_of_a_condensed_meniscus_is_that_of_a_film_under_a_sphere():
    """A pressure sets the height 2 gamma/p at the rim: pi R (H^2 - D^2) of liquid."""
    water = ck.Liquid(name="water", viscosity=1e-3, surface_tension=0.072, density=1000.0)
    film = ck.Meniscus(
        liquid=water, pressure=-1e5, contact_angle_lower=0.0, contact_angle_upper=0.0
    )
    scene = ck.SeparationScene(
        interface=ck.Interface(lower=ck.Flat(), upper=ck.Sphere(radius=1e-3), meniscus=film),
        loading=ck.ImposedSpeed(initial_gap=2e-9, final_gap=1e-8, speed=1e-9),
        effects=(ck.MeniscusForce(),),
    )
    found, warned = judged(scene)
    height = 2.0 * 0.072 / 1e5
    volume = math.pi * 1e-3 * (height**2 - 4e-18)
    exact = bridge_at_pressure(2e-9, -1e5 / 0.072, 0.0, 0.0, 0.0, 1e3)
    assert volume == pytest.approx(float(exact.volume), rel=0.08)  # sqrt(H/R) = 0.04
    expected = 9806.65 * volume / (0.072 * float(exact.force))
    assert found[HEAVY].value == pytest.approx(expected, rel=2e-2)
    assert HEAVY not in warned
