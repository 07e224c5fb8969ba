"""Hard cases of humidity and of many menisci: ends of ranges, ratios of a million, nothing."""

from __future__ import annotations

import math

import numpy as np
import pytest
from attrs import evolve

import contactkit as ck
from contactkit.analyses.division import divide_meniscus
from contactkit.analyses.humidity_curve import humidity_curve
from contactkit.capillary import asperities as laws
from contactkit.capillary.asperity_bridges import force_curve, gaussian_average
from contactkit.capillary.condensed import condensed_bridges, max_gap_on_sphere
from contactkit.capillary.exact.bridge import bridge_at_pressure
from contactkit.files.scenes import load_scene, save_scene

pytestmark = pytest.mark.hard

WATER = ck.Liquid(
    name="water", surface_tension=0.072, viscosity=0.9e-3, density=1000.0, molar_mass=0.018
)


def near_sphere(radius, gap=0.0, lower=0.0, upper=0.0):
    film = ck.Meniscus(liquid=WATER, contact_angle_lower=lower, contact_angle_upper=upper)
    return ck.SeparationScene(
        interface=ck.Interface(upper=ck.Sphere(radius=radius), meniscus=film),
        loading=ck.ImposedSpeed(initial_gap=gap, final_gap=1e-3, speed=1.0),
        effects=(ck.MeniscusForce(),),
    )


# Humidity -----------------------------------------------------------------------------------


@pytest.mark.parametrize("radius", [1e-8, 1e-6, 1e-3, 1.0])
def test_from_bone_dry_to_almost_wet_a_touching_sphere_is_pulled(radius):
    """2 pi R gamma (c1 + c2) bounds the force from above, whatever the humidity."""
    humidity = [1e-9, 1e-3, 0.5, 0.9]
    found = humidity_curve(near_sphere(radius), humidity)
    most = 4.0 * math.pi * radius * 0.072
    assert np.all((found.force > 0.55 * most) & (found.force < most))
    assert np.all(np.diff(found.volume) > 0.0)


def test_a_sphere_immersed_in_its_liquid_is_refused_and_the_sizes_are_named():
    with pytest.raises(ck.InfeasibleError, match=r"Kelvin radius is .* around a sphere of 1e-08 m"):
        humidity_curve(near_sphere(1e-8), [0.5, 0.9999])


@pytest.mark.parametrize("angle", [89.0, 89.999])
def test_almost_nothing_condenses_between_walls_that_hardly_wet(angle):
    angles = {"lower": math.radians(angle), "upper": math.radians(90.0)}
    found = humidity_curve(near_sphere(1e-3, **angles), [0.5])
    thin = 2.0 * math.pi * 1e-3 * 0.072 * (math.cos(angles["lower"]) + math.cos(angles["upper"]))
    assert 0.0 < found.force[0] < thin
    far = humidity_curve(near_sphere(1e-3, 1e-9, **angles), [0.5])
    assert far.force.tolist() == [0.0]


def test_two_spheres_are_one_of_their_common_curvature_when_large():
    pair = near_sphere(1e-3)
    pair = evolve(pair, interface=evolve(pair.interface, lower=ck.Sphere(radius=1e-3)))
    both = humidity_curve(pair, [0.5])
    one = humidity_curve(near_sphere(0.5e-3), [0.5])
    assert both.force[0] == pytest.approx(one.force[0], rel=1e-4)


def test_the_reach_is_where_the_bridge_ends():
    for pressure, curvature in ((-1e9, 1e6), (-1e8, 1e7), (-1e12, 1.0)):
        reach = max_gap_on_sphere(pressure, 0.3, 0.7, curvature)
        gaps = reach * np.array([1.0 - 1e-6, 1.0 + 1e-6])
        force = bridge_at_pressure(gaps, pressure, 0.3, 0.7, 0.0, curvature, beyond="nan").force
        assert np.isfinite(force).tolist() == [True, False]


def test_many_spheres_are_sorted_as_one_by_one():
    rng = np.random.default_rng(2)
    pressure = -1.4e9
    gap = rng.uniform(0.0, 1.2, 60) * 1.4e-9
    curvature = 10.0 ** rng.uniform(4.0, 7.5, 60)
    found = condensed_bridges(gap, pressure, 0.2, 0.4, curvature)
    reach = np.array([max_gap_on_sphere(pressure, 0.2, 0.4, float(k)) for k in curvature[:8]])
    assert np.array_equal(np.isfinite(found.force[:8]), gap[:8] <= reach)
    stands = np.isfinite(found.force)
    again = bridge_at_pressure(gap[stands], pressure, 0.2, 0.4, 0.0, curvature[stands])
    assert found.force[stands] == pytest.approx(again.force, rel=1e-9)


def test_a_sharp_summit_among_blunt_ones_is_not_passed_over():
    with pytest.raises(ck.InfeasibleError, match=r"a summit of radius 1e-10 m is immersed"):
        condensed_bridges(np.zeros(2), -1e8, 0.0, 0.0, np.array([1e4, 1e10]))


def test_no_sphere_and_none_within_reach():
    nothing = condensed_bridges(np.zeros(0), -1e9, 0.0, 0.0, np.zeros(0))
    assert nothing.force.size == 0
    far = condensed_bridges(np.array([1e-6]), -1e9, 0.0, 0.0, np.array([1e6]))
    assert np.isnan(far.force).all()


# Asperities ---------------------------------------------------------------------------------


def test_the_curve_of_one_asperity_is_the_bridge_between_its_nodes():
    one, reach = force_curve(-1.3e9, (0.2, 0.4), 1e6, 1e-9)
    gap = reach * np.array([0.0, 1e-6, 0.123, 0.5, 0.9, 0.999])
    force = bridge_at_pressure(gap, -1.3e9, 0.2, 0.4, 0.0, 1e6).force
    assert one(gap) == pytest.approx(force, rel=1e-7)


@pytest.mark.parametrize("ratio", [1e-6, 1e-2, 0.3, 3.0, 100.0, 1e6])
@pytest.mark.parametrize("at", [-1.0, 0.5, 1.0, 3.0])
def test_the_mean_of_a_linear_force_is_the_closed_form(ratio, at):
    """Spread of the heights over the reach from 1e-6 to 1e6; the closed form is of thin films."""
    reach, spread = 1e-9, ratio * 1e-9
    separation = at * max(reach, spread)
    found = gaussian_average(lambda gap: 1.0 - gap / reach, reach, separation, spread)
    expected = laws.mean_tail((separation - reach) / spread, separation / spread)
    assert found == pytest.approx(expected, rel=1e-10, abs=1e-18)


def rough(**choices):
    population = ck.AsperityPopulation(density=1e13, radius=1e-6, rms_height=2e-9)
    return ck.SeparationScene(
        interface=ck.Interface(
            lower=ck.Flat(radius=1e-5), meniscus=ck.Meniscus(liquid=WATER, pressure=-5e7)
        ),
        loading=ck.ImposedSpeed(initial_gap=3e-9, final_gap=50e-9, speed=1e-6),
        effects=(ck.AsperityMenisci(asperities=population, **choices),),
    )


def test_far_away_the_force_has_gone_without_an_end():
    made = ck.plan(rough())
    assert made.film.end == math.inf
    forces = [made.film.static_force(gap) for gap in (3e-9, 10e-9, 30e-9, 1e-6)]
    assert forces == sorted(forces, reverse=True)
    assert forces[-1] == 0.0


def test_identical_asperities_are_released_together():
    scene = evolve(
        rough(law="identical"),
        loading=ck.ImposedSpeed(initial_gap=0.5e-9, final_gap=50e-9, speed=1e-6),
    )
    made = ck.plan(scene)
    end = max_gap_on_sphere(-5e7 / 0.072, 0.0, 0.0, 1e6)
    assert made.film.end == pytest.approx(end, rel=1e-12)
    assert made.film.static_force(end) > 0.0
    with pytest.raises(ck.InfeasibleError, match="no meniscus spans the initial gap"):
        ck.plan(rough(law="identical"))


def test_a_rough_face_with_a_mass_comes_off_and_pays_the_work_of_its_menisci():
    """Energy: the pull's work less that of the menisci is what moves the mass at the end."""
    quiet = rough(profile="thin-film")
    pull = 2.0 * ck.plan(quiet).film.static_force(5e-9)
    loading = ck.ImposedForce(initial_gap=5e-9, final_gap=100e-9, force=pull, mass=1e-9)
    scene = evolve(quiet, loading=loading)
    result = ck.simulate(ck.plan(scene))
    assert result.status == "released"
    gaps = np.linspace(5e-9, 100e-9, 20001)
    law = ck.plan(scene).film
    force = np.array([law.static_force(gap) for gap in gaps.tolist()])
    work = np.sum(0.5 * (force[1:] + force[:-1]) * np.diff(gaps))
    kinetic = 0.5 * 1e-9 * result.state.release_speed**2
    assert kinetic == pytest.approx(pull * 95e-9 - work, rel=1e-5)


def test_overlap_is_printed_with_a_result():
    population = ck.AsperityPopulation(density=1e15, radius=1e-6, rms_height=2e-9)
    scene = evolve(rough(), effects=(ck.AsperityMenisci(asperities=population),))
    with pytest.warns(ck.ValidityWarning, match="menisci of neighbouring asperities overlap"):
        result = ck.simulate(ck.plan(scene))
    part = result.of(ck.AsperityMenisci)
    assert part.law == "greenwood-williamson, exact bridges"
    assert part.coverage[0] > 0.9
    assert part.n_wet[0] > part.n_wet[-1]
    assert part.force is result["asperity_force"]


def test_a_rough_scene_is_written_and_read(tmp_path):
    scene = rough(law="identical", profile="thin-film")
    save_scene(scene, tmp_path / "rough.toml")
    assert load_scene(tmp_path / "rough.toml") == scene
    assert 'effect = "asperity-menisci"' in (tmp_path / "rough.toml").read_text()


# Division -----------------------------------------------------------------------------------


def divided(volume, gap, lower, upper):
    film = ck.Meniscus(
        liquid=WATER, volume=volume, contact_angle_lower=lower, contact_angle_upper=upper
    )
    return ck.SeparationScene(
        interface=ck.Interface(meniscus=film),
        loading=ck.ImposedTime(initial_gap=gap, final_gap=1.0, time=1e-3),
        effects=(ck.MeniscusForce(), ck.ViscousForce()),
    )


@pytest.mark.parametrize(
    ("lower", "upper"),
    [(0, 0), (60, 120), (90, 90), (89.999, 90.001), (0, 90), (120, 120), (180, 120), (180, 180)],
)
def test_any_pair_of_angles_is_divided_up_to_its_last_stable_number(lower, upper):
    scene = divided(1e-18, 1e-7, math.radians(lower), math.radians(upper))
    most = divide_meniscus(scene, [1], law="exact").max_stable_count
    found = divide_meniscus(scene, [1, 7, most - 1, most], law="exact")
    assert found.unstable == ()
    assert np.all(np.isfinite(found.meniscus_force))
    assert np.all(found.limit_gap > 1e-7)
    assert 1 <= found.best_count <= most


def test_a_billion_menisci_of_a_film_a_million_times_as_wide_as_high():
    scene = divided(math.pi * 1e-6 * 1e-9, 1e-9, 1.0, 1.0)  # 1 mm wide, 1 nm high
    found = divide_meniscus(scene, [1, 10**6, 10**9], law="exact")
    thin = 0.072 * 2.0 * math.cos(1.0) * math.pi * 1e-6 / 1e-9
    assert found.meniscus_force[0] == pytest.approx(thin, rel=1e-5)
    assert np.all(np.diff(found.meniscus_force) > 0.0)
    assert found.max_stable_count > 10**9


def test_wetted_against_repelling_there_is_nothing_to_divide():
    with pytest.raises(ck.InfeasibleError):
        divide_meniscus(divided(1e-18, 1e-7, 0.0, math.pi), law="exact")
