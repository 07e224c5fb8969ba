"""Force against humidity: of a sphere, of asperities, of a solved rough contact."""

from __future__ import annotations

import json
import math
from pathlib import Path

import numpy as np
import pytest
from attrs import evolve
from refusals import each_refused
from scipy.integrate import solve_ivp
from scipy.optimize import brentq

import contactkit as ck
from contactkit.analyses.humidity_curve import humidity_curve
from contactkit.capillary import kelvin
from contactkit.capillary.film_islands import film_force

CASES = json.loads((Path(__file__).parents[1] / "data" / "menisci.json").read_text())
# With the tension of the case file, and a molar volume that gives its Kelvin length at 25 degC.
LENGTH = CASES["physics"]["kelvin_length_nm"] * 1e-9
WATER = ck.Liquid(name="water", surface_tension=0.072, density=1000.0, molar_mass=0.018)
ROOM = 298.15
DEG = math.pi / 180.0


def near_sphere(radius, gap=0.0, lower=0.0, upper=0.0):
    film = ck.Meniscus(liquid=WATER, contact_angle_lower=lower, contact_angle_upper=upper)
    return ck.SeparationScene(
        interface=ck.Interface(upper=ck.Sphere(radius=radius), meniscus=film),
        loading=ck.ImposedSpeed(initial_gap=gap, final_gap=1e-3, speed=1.0),
        effects=(ck.MeniscusForce(),),
        temperature=ROOM,
    )


def humidity_of(kelvin_radius):
    return math.exp(-LENGTH / kelvin_radius)


@pytest.mark.parametrize("case", CASES["exact_fixed_pressure"], ids=lambda c: c["id"])
def test_the_sphere_of_the_case_file(case):
    """Its lengths are in radii: at R = 1 um the pressure is that of a humidity."""
    radius = 1e-6
    scene = near_sphere(
        radius, case["D"] * radius, case["theta1_deg"] * DEG, case["theta2_deg"] * DEG
    )
    found = humidity_curve(scene, [humidity_of(-radius / case["P_over_gamma"])])
    assert found.law == "exact bridge on a sphere"
    assert found.force[0] == pytest.approx(0.072 * radius * case["F_over_gamma"], rel=1e-8)
    assert found.volume[0] == pytest.approx(radius**3 * case["V"], rel=1e-8)


def shot(radius, gap, pressure, lower, upper):
    """Force and volume of a bridge of a pressure [1/m] by shooting along the meridian."""

    def meridian(x):
        def grow(_, y):
            r, phi = y[0], y[1]
            return [
                math.cos(phi),
                pressure - math.sin(phi) / r,
                math.sin(phi),
                math.pi * r * r * math.sin(phi),
            ]

        def meets(_, y):
            beta = math.asin(min(max(y[0] / radius, -1.0), 1.0))
            return y[1] - upper - beta

        meets.terminal = True
        span = 20.0 / abs(pressure)
        done = solve_ivp(
            grow,
            (0.0, span),
            [x, math.pi - lower, 0.0, 0.0],
            events=meets,
            rtol=1e-12,
            atol=1e-18,
            method="DOP853",
        )
        r, _, z, v = done.y[:, -1]
        beta = math.asin(r / radius)
        return z - gap - 2.0 * radius * math.sin(0.5 * beta) ** 2, r, v, beta

    height = -(math.cos(lower) + math.cos(upper)) / pressure
    thin = math.sqrt(2.0 * radius * (height - gap))
    x = brentq(lambda x: meridian(x)[0], 0.7 * thin, 1.4 * thin, xtol=1e-13 * thin, rtol=1e-13)
    _, _, v, beta = meridian(x)
    cap = math.pi * radius**3 * (1 - math.cos(beta)) ** 2 * (2 + math.cos(beta)) / 3.0
    return 2 * math.pi * x * math.sin(lower) - math.pi * x * x * pressure, v - cap


@pytest.mark.parametrize(("humidity", "gap"), [(0.5, 0.0), (0.5, 0.3e-9), (0.9, 2e-9)])
def test_the_bridge_is_the_one_that_shooting_finds(humidity, gap):
    scene = near_sphere(200e-9, gap, 20 * DEG, 50 * DEG)
    found = humidity_curve(scene, [humidity])
    force, volume = shot(200e-9, gap, -1.0 / found.kelvin_radius[0], 20 * DEG, 50 * DEG)
    assert found.force[0] == pytest.approx(0.072 * force, rel=1e-7)
    assert found.volume[0] == pytest.approx(volume, rel=1e-6)


def test_the_law_of_a_small_filling_is_the_limit_of_a_large_sphere():
    """What it leaves out falls as the root of r_K/R."""
    gap, humidity = 0.2e-9, 0.6
    errors = []
    for radius in (1e-6, 1e-4, 1e-2):
        found = humidity_curve(near_sphere(radius, gap), [humidity])
        thin = kelvin.thin_film_force(radius, gap, 0.072, 2.0, found.meniscus_height[0])
        errors.append(abs(found.force[0] / thin - 1.0))
    assert errors[0] < 0.05
    assert errors[1] / errors[0] == pytest.approx(0.1, rel=0.1)
    assert errors[2] / errors[1] == pytest.approx(0.1, rel=0.1)


def test_a_sphere_that_touches_is_held_harder_in_dry_air():
    """At D = 0 the force of a sphere falls with humidity; off the wall it rises from nothing."""
    humidity = [0.1, 0.4, 0.7, 0.95]
    touching = humidity_curve(near_sphere(1e-7), humidity)
    assert np.all(np.diff(touching.force) < 0.0)
    apart = humidity_curve(near_sphere(1e-7, 0.7e-9), humidity)
    assert apart.force[0] == apart.n_menisci[0] == 0.0
    assert np.all(np.diff(apart.force[:2]) > 0.0)
    assert np.all(np.diff(apart.volume) >= 0.0)


def test_force_is_the_slope_of_the_energy_at_fixed_pressure():
    """F = dE/dD at fixed p with the liquid exchanged: E = int F dD, and dE/dp = -V."""
    radius, step = 1e-7, 1e-3

    def at(humidity, gaps):
        scene = near_sphere(radius, 0.0, 0.3, 0.6)
        curves = [humidity_curve(scene, [humidity], gap=g) for g in gaps]
        return (
            np.array([c.force[0] for c in curves]),
            np.array([c.volume[0] for c in curves]),
            curves[0].pressure[0],
        )

    nodes, weights = np.polynomial.legendre.leggauss(12)
    low, high = 0.1e-9, 0.4e-9
    gaps = 0.5 * (low + high) + 0.5 * (high - low) * nodes
    up = humidity_of(1e-9 * (1.0 + step))
    down = humidity_of(1e-9 * (1.0 - step))
    (f1, _, p1), (f2, _, p2) = at(up, gaps), at(down, gaps)
    work = 0.5 * (high - low) * np.sum(weights * (f1 - f2))
    _, ends, _ = at(humidity_of(1e-9), [low, high])
    # Omega falls by V for each pascal; F = dOmega/dD
    assert work == pytest.approx(-(ends[1] - ends[0]) * (p1 - p2), rel=1e-4)


# Asperities ---------------------------------------------------------------------------------


def rough_scene(rms=1e-9, gap=3e-9, radius=1e-6, **choices):
    population = ck.AsperityPopulation(density=5e13, radius=radius, rms_height=rms)
    film = ck.Meniscus(
        liquid=WATER,
        relative_humidity=0.5,
        contact_angle_lower=0.4,
        contact_angle_upper=0.2,
    )
    return ck.SeparationScene(
        interface=ck.Interface(lower=ck.Flat(radius=1e-5), meniscus=film),
        loading=ck.ImposedSpeed(initial_gap=gap, final_gap=20e-9, speed=1e-6),
        effects=(ck.AsperityMenisci(asperities=population, **choices),),
        temperature=ROOM,
    )


def test_a_population_follows_humidity_by_its_own_law():
    humidity = [0.3, 0.6, 0.9]
    exact = humidity_curve(rough_scene(), humidity)
    thin = humidity_curve(rough_scene(profile="thin-film"), humidity)
    assert exact.law == "greenwood-williamson, exact bridges"
    assert thin.law == "greenwood-williamson, thin-film bridges"
    assert np.all(np.diff(exact.force) > 0.0)
    assert exact.force == pytest.approx(thin.force, rel=0.2)
    assert np.array_equal(exact.n_menisci, thin.n_menisci)
    assert exact.coverage[-1] > exact.coverage[0]
    with pytest.raises(ck.NotSimulatedError, match="has no volume"):
        exact.volume  # noqa: B018


def test_large_asperities_make_the_thin_law_exact():
    thick, thin = (
        humidity_curve(rough_scene(radius=1e-2, profile=p), [0.5]).force[0]
        for p in ("exact", "thin-film")
    )
    assert thick == pytest.approx(thin, rel=2e-3)


@pytest.mark.filterwarnings("ignore:thinnest gap:contactkit.errors.ValidityWarning")
def test_identical_asperities_are_so_many_spheres():
    gap = 0.4e-9
    scene = rough_scene(rms=0.0, gap=gap, law="identical")
    one = humidity_curve(near_sphere(1e-6, gap, 0.4, 0.2), [0.5])
    n = 5e13 * math.pi * 1e-10
    found = ck.simulate(ck.plan(scene))
    assert found["asperity_force"][0] == pytest.approx(n * one.force[0], rel=1e-8)


def test_a_narrow_population_is_identical_and_a_wide_one_a_mean_of_spheres():
    narrow = ck.plan(rough_scene(rms=1e-14, gap=0.4e-9)).film.static_force(0.4e-9)
    same = ck.plan(rough_scene(rms=0.0, gap=0.4e-9, law="identical")).film.static_force(0.4e-9)
    assert narrow == pytest.approx(same, rel=1e-7)
    made = ck.plan(rough_scene(gap=2e-9))
    heights = np.linspace(-8e-9, 8e-9, 3201)
    weight = np.exp(-0.5 * (heights / 1e-9) ** 2) * (heights[1] - heights[0])
    gaps = np.maximum(2e-9 - heights, 0.0)
    same = ck.plan(rough_scene(rms=0.0, gap=0.1e-9, law="identical")).film
    each = np.array([same.static_force(g) if g < same.end else 0.0 for g in gaps])
    mean = np.sum(weight * each) / (1e-9 * math.sqrt(2.0 * math.pi))
    assert made.film.static_force(2e-9) == pytest.approx(mean, rel=2e-3)


# A solved contact ---------------------------------------------------------------------------


@pytest.mark.filterwarnings("ignore::contactkit.errors.ValidityWarning")  # a rigid ball, nearly
def test_a_smooth_ball_in_contact_is_one_island_with_the_bridge_of_its_sphere():
    solid = ck.Material(young_modulus=1e15, poisson_ratio=0.3)
    radius = 2e-6
    scene = ck.ContactScene(
        interface=ck.Interface(
            lower=ck.Body(solid=solid),
            upper=ck.Body(surface=ck.Paraboloid(radius=radius)),
            meniscus=ck.Meniscus(liquid=WATER, contact_angle_lower=0.3, contact_angle_upper=0.3),
        ),
        window=ck.Window(width=1e-6, periodic=False),
        loading=ck.Pressing(force=1e-12),
        effects=(ck.HalfSpace(),),
        temperature=ROOM,
    )
    result = ck.solve(ck.plan(scene, ck.Accuracy(grid=96)))
    found = humidity_curve(result, [0.8, 0.9, 0.95])
    one = humidity_curve(near_sphere(radius, 0.0, 0.3, 0.3), [0.8, 0.9, 0.95])
    assert found.n_menisci.tolist() == [1.0, 1.0, 1.0]
    assert found.force == pytest.approx(one.force, rel=0.02)  # the area of pixels
    cut = humidity_curve(result, [0.8, 0.9, 0.95], law="cross-cut")
    assert cut.law == "cross-cut of the gap, Eq. (2.43)"
    thin = [
        kelvin.thin_film_force(radius, 0.0, 0.072, 2 * math.cos(0.3), h)
        for h in found.meniscus_height
    ]
    assert cut.force == pytest.approx(thin, rel=0.02)
    with pytest.raises(ck.NotSimulatedError, match="has no coverage"):
        cut.coverage  # noqa: B018


@pytest.mark.filterwarnings("ignore:pixels across:contactkit.errors.ValidityWarning")
def test_the_cross_cut_is_that_of_the_film_islands():
    rng = np.random.default_rng(1)
    heights = ck.Heights(heights=2e-9 * rng.normal(size=(24, 24)), pixel_size=5e-8)
    solid = ck.Material(young_modulus=1e10, poisson_ratio=0.3)
    scene = ck.ContactScene(
        interface=ck.Interface(
            lower=ck.Body(solid=solid),
            upper=ck.Body(surface=heights),
            meniscus=ck.Meniscus(liquid=WATER),
        ),
        loading=ck.Pressing(pressure=1e6),
        effects=(ck.HalfSpace(),),
        temperature=ROOM,
    )
    result = ck.solve(ck.plan(scene))
    found = humidity_curve(result, [0.7], law="cross-cut")
    height = found.meniscus_height[0]
    wet = (result.gap < height) & ~result.contact
    expected = film_force(wet.sum() * 25e-16, 0.072, 0.0, 0.0, height)
    assert found.force[0] == pytest.approx(float(expected), rel=1e-12)


# Refusals -----------------------------------------------------------------------------------


def _flats():
    scene = near_sphere(1e-6, 1e-9)
    flats = ck.Interface(meniscus=scene.interface.meniscus)
    return ck.SeparationScene(interface=flats, loading=scene.loading, effects=scene.effects)


REFUSED = [
    (lambda: humidity_curve(near_sphere(1e-6), [0.5, 1.0]), "floods the gap", ck.InfeasibleError),
    (lambda: humidity_curve(near_sphere(1e-6), [0.0]), "nothing condenses", ck.InfeasibleError),
    (lambda: humidity_curve(near_sphere(1e-6), [math.nan]), "finite numbers", ck.DescriptionError),
    (lambda: humidity_curve(near_sphere(1e-6), []), "finite numbers", ck.DescriptionError),
    (
        lambda: humidity_curve(near_sphere(1e-6), [0.5], gap=-1.0),
        r"\(gap\) must be zero or",
        ck.DescriptionError,
    ),
    (
        lambda: humidity_curve(_flats(), [0.5]),
        "between smooth flats.*it evaporates",
        ck.InfeasibleError,
    ),
    (lambda: humidity_curve("scene", [0.5]), "a SeparationScene or a ContactResult", ck.PlanError),
]


test_what_has_no_answer_is_refused = each_refused(REFUSED)


LACKS = [
    ({"law": "identical", "meniscus_height": 1e-9}, {}, "either interface.meniscus.pressure"),
    ({}, {"rms": 0.0}, r'rms_height \[m\] above 0, or law="identical"'),
]


@pytest.mark.parametrize(("choices", "given", "message"), LACKS)
def test_what_asperities_lack_is_named(choices, given, message):
    with pytest.raises(ck.PlanError, match=message):
        ck.plan(rough_scene(**given, **choices))


@pytest.mark.parametrize("other", [ck.MeniscusForce(), ck.ViscousForce()], ids=lambda e: e.name)
def test_asperities_stand_alone(other):
    scene = rough_scene()
    scene = evolve(scene, effects=(*scene.effects, other))
    with pytest.raises(ck.PlanError, match=f"{type(other).__name__} left out: it is of one film"):
        ck.plan(scene)


def test_a_volume_has_no_law_for_asperities():
    scene = rough_scene()
    film = ck.Meniscus(liquid=WATER, volume=1e-20)
    flat = ck.Flat(radius=1e-5)
    with pytest.raises(ck.PlanError, match="which summits share it is not known"):
        ck.plan(
            ck.SeparationScene(
                interface=ck.Interface(lower=flat, meniscus=film),
                loading=scene.loading,
                effects=scene.effects,
            )
        )
    with pytest.raises(ck.PlanError, match=r"radius \[m\] of a Flat face"):
        ck.plan(
            ck.SeparationScene(
                interface=ck.Interface(meniscus=scene.interface.meniscus),
                loading=scene.loading,
                effects=scene.effects,
            )
        )
