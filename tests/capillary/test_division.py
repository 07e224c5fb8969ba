"""Division of a meniscus: the reference cases, the printed numbers, and what must be conserved."""

from __future__ import annotations

import json
import math
from pathlib import Path

import loadings
import numpy as np
import pytest
from refusals import each_refused

import contactkit as ck
from contactkit.analyses.division import critical_meniscus, divide_meniscus
from contactkit.capillary import many_menisci as menisci

CASES = json.loads((Path(__file__).parents[1] / "data" / "menisci.json").read_text())
WATER = ck.Liquid(name="water", surface_tension=0.072, viscosity=0.89e-3)
BOTH = (ck.MeniscusForce(), ck.ViscousForce())
DEG = math.pi / 180.0


def scene(gap=2e-9, volume=2e-21, effects=BOTH, angle=60.0, face=None, **imposed):
    film = ck.Meniscus(
        liquid=WATER,
        volume=volume,
        contact_angle_lower=angle * DEG,
        contact_angle_upper=angle * DEG,
    )
    flat = ck.Flat(radius=face)
    return ck.SeparationScene(
        interface=ck.Interface(lower=flat, upper=flat, meniscus=film),
        loading=loadings.imposed(initial_gap=gap, final_gap=1e-3, **(imposed or {"time": 1e-7})),
        effects=effects,
    )


@pytest.mark.parametrize("case", CASES["division"], ids=lambda c: f"{c['h0_nm']}-{c['N']}")
def test_the_exact_division_of_the_case_file(case):
    gap = case["h0_nm"] * 1e-9
    found = divide_meniscus(scene(gap, 1e-12 * gap), [case["N"]], law="exact")
    assert found.law == "exact"
    assert found.max_stable_count == math.floor(case["N_max_exact_stability"])
    assert found.meniscus_force[0] == pytest.approx(case["F_m_total_exact_N"], rel=1e-9)
    assert found.limit_gap[0] * 1e9 == pytest.approx(case["h_limit_exact_nm"], rel=1e-8)
    viscous = case["F_v_total_conserving_exact_limit_N"]
    assert found.viscous_force[0] == pytest.approx(viscous, rel=1e-9)


@pytest.mark.parametrize("case", CASES["division"], ids=lambda c: f"{c['h0_nm']}-{c['N']}")
def test_the_published_division_of_the_case_file(case):
    gap = case["h0_nm"] * 1e-9
    found = divide_meniscus(scene(gap, 1e-12 * gap), [case["N"]], law="as-published")
    assert found.meniscus_force[0] == pytest.approx(case["F_m_total_published_3_33_N"], rel=1e-12)
    assert found.viscous_force[0] == pytest.approx(case["F_v_total_published_3_34_N"], rel=1e-12)
    assert found.limit_gap[0] * 1e9 == pytest.approx(case["h_break_arc_nm"], rel=1e-12)


@pytest.mark.parametrize("case", CASES["optimal_division"], ids=lambda c: f"{c['h0_nm']} nm")
def test_the_best_number_of_the_published_law(case):
    """The closed form stands far from the break; whole numbers and the break move it by one."""
    gap = case["h0_nm"] * 1e-9
    found = divide_meniscus(scene(gap, 1e-12 * gap), law="as-published")
    assert abs(found.best_count - case["N_opt_published"]) < 1.0
    radius = math.sqrt(1e-12 / math.pi)
    line = 2.0 * math.pi * 0.072 * radius * math.sin(60 * DEG)
    viscous = 0.75 * math.pi * 0.89e-3 * radius**4 / (1e-7 * gap**2)
    closed = menisci.optimal_count_published(line, viscous)
    assert closed == pytest.approx(case["N_opt_published"], rel=1e-12)
    half = menisci.optimal_count_published(line, 0.5 * viscous)
    assert half == pytest.approx(case["N_opt_consistent_half"], rel=1e-12)


@pytest.mark.parametrize("law", ["exact", "arc", "as-published"])
def test_no_number_is_better_than_the_best(law):
    found = divide_meniscus(scene(6e-9, 6e-21), range(1, 400), law=law)
    assert found.best_count == found.n_menisci[np.argmin(found.total_force)]
    assert found.best_force == found.total_force.min()
    assert found.total_force == pytest.approx(found.meniscus_force + found.viscous_force, rel=1e-14)


def test_the_exact_best_number_lies_between_the_two_closed_forms():
    """Half of the viscous force, and a line force that grows slower than the root of N."""
    for case in CASES["optimal_division"]:
        gap = case["h0_nm"] * 1e-9
        found = divide_meniscus(scene(gap, 1e-12 * gap), [1], law="exact")
        assert case["N_opt_consistent_half"] < found.best_count < 2.2 * case["N_opt_published"]


def test_each_meniscus_of_many_is_one_of_its_volume():
    """N menisci of V/N pull as N times one of V/N: the same scene, divided the other way."""
    many = divide_meniscus(scene(volume=2e-21), [50], law="exact")
    one = divide_meniscus(scene(volume=4e-23), [1], law="exact")
    assert many.meniscus_force[0] == pytest.approx(50 * one.meniscus_force[0], rel=1e-12)
    assert many.viscous_force[0] == pytest.approx(50 * one.viscous_force[0], rel=1e-12)
    assert many.limit_gap[0] == pytest.approx(one.limit_gap[0], rel=1e-9)


def test_at_fixed_time_the_viscous_force_falls_as_one_over_the_number():
    found = divide_meniscus(scene(), [1, 10, 100, 1000], law="exact")
    slope = np.polyfit(np.log(found.n_menisci), np.log(found.viscous_force), 1)[0]
    assert slope == pytest.approx(-1.0, abs=1e-3)


def test_at_fixed_speed_the_way_to_the_break_shortens_with_the_number():
    """The time is the way over the speed, and the way falls as N^(-1/3)."""
    found = divide_meniscus(scene(speed=1.0), [1, 8, 64], law="exact")
    at_time = divide_meniscus(scene(time=1.0), [1, 8, 64], law="exact")
    duration = found.limit_gap - 2e-9
    assert found.viscous_force * duration == pytest.approx(at_time.viscous_force, rel=1e-12)


def test_a_right_angle_gives_the_exact_cylinder_for_any_number():
    found = divide_meniscus(scene(angle=90.0), [1, 100, 10_000], law="exact")
    radius = np.sqrt(2e-21 / (found.n_menisci * math.pi * 2e-9))
    assert found.meniscus_force == pytest.approx(
        found.n_menisci * math.pi * 0.072 * radius, rel=1e-9
    )
    assert found.contact_radius == pytest.approx(radius, rel=1e-9)


def test_beyond_the_largest_stable_number_nothing_is_computed():
    found = divide_meniscus(scene(6e-9, 6e-21), [1, 79_611, 79_612, 100_000], law="exact")
    assert (found.n_menisci.tolist(), found.unstable) == ([1, 79_611], (79_612, 100_000))
    assert np.all(np.isfinite(found.meniscus_force))
    assert found.limit_gap[1] > 6e-9


def test_overlap_is_seen_on_the_face():
    """A film that fills the face at one meniscus covers more of it the more it is divided."""
    face = math.sqrt(1.15e-12 / math.pi)
    found = divide_meniscus(scene(angle=0.0, face=face), [1, 10, 10_000], law="exact")
    assert found.coverage[0] < found.coverage[1] < found.coverage[2]
    assert found.overlaps.tolist() == [False, False, True]
    expected = menisci.coverage(found.n_menisci, found.contact_radius, math.pi * face**2)
    assert found.coverage == pytest.approx(expected, rel=1e-14)
    with pytest.raises(ck.NotSimulatedError, match=r"radius \[m\] of a Flat face"):
        divide_meniscus(scene(), [1], law="exact").coverage  # noqa: B018


@pytest.mark.parametrize("case", CASES["critical_area"], ids=lambda c: f"{c['h0_nm']} nm")
def test_the_critical_area_of_the_published_law(case):
    gap = case["h0_nm"] * 1e-9
    x = menisci.critical_radius_published(gap, 0.072, 1.0, math.sin(60 * DEG), 0.89e-3, 1e-7)
    assert math.pi * x * x * 1e12 == pytest.approx(case["area_um2"], rel=1e-12)
    found = critical_meniscus(scene(gap), law="as-published")
    assert found.area * 1e12 == pytest.approx(case["area_um2"], rel=2e-3)  # the break is not far


def test_at_the_critical_size_the_forces_are_equal_and_above_it_viscous():
    found = critical_meniscus(scene(), law="exact")
    at = divide_meniscus(scene(volume=found.volume), [1], law="exact")
    assert at.meniscus_force[0] == pytest.approx(at.viscous_force[0], rel=1e-10)
    assert at.meniscus_force[0] == pytest.approx(found.force, rel=1e-10)
    above = divide_meniscus(scene(volume=2.0 * found.volume), [1], law="exact")
    assert above.viscous_force[0] > above.meniscus_force[0]
    # a little above twice the published area: the viscous force is half as large
    published = critical_meniscus(scene(), law="as-published")
    assert 1.9 < found.area / published.area < 2.2


def test_only_the_forces_of_the_scene_are_compared():
    found = divide_meniscus(scene(effects=(ck.MeniscusForce(),)), [1, 5], law="exact")
    assert found.total_force.tolist() == found.meniscus_force.tolist()
    assert found.best_count == 1
    with pytest.raises(ck.NotSimulatedError, match=r"add ViscousForce\(\) to its effects"):
        found.viscous_force  # noqa: B018


OWN_LAWS = [
    ((ck.MeniscusForce(), ck.ViscousForce()), "exact"),
    ((ck.MeniscusForce(profile="arc"), ck.ViscousForce()), "arc"),
    (
        (ck.MeniscusForce(profile="as-published"), ck.ViscousForce(closure="as-published")),
        "as-published",
    ),
    ((ck.ViscousForce(),), "exact"),
    ((ck.ViscousForce(closure="as-published"),), "as-published"),
]


@pytest.mark.parametrize(("effects", "law"), OWN_LAWS)
def test_the_effects_of_the_scene_choose_the_law(effects, law):
    assert divide_meniscus(scene(effects=effects), [1]).law == law


REFUSED = [
    (
        lambda: divide_meniscus(
            scene(effects=(ck.MeniscusForce(profile="as-published"), ck.ViscousForce()))
        ),
        "would be mixed",
        ck.PlanError,
    ),
    (
        lambda: divide_meniscus(
            scene(effects=(ck.ViscousForce(closure="as-published"),)), law="exact"
        ),
        "never both",
        ck.PlanError,
    ),
    (lambda: divide_meniscus(scene(volume=None)), "meniscus.volume", ck.PlanError),
    (
        lambda: divide_meniscus(scene(effects=(ck.Rupture(),)), law="exact"),
        r"knows MeniscusForce\(\) and ViscousForce\(\) only.*leave out Rupture",
        ck.PlanError,
    ),
    (
        lambda: divide_meniscus(scene(force=1e-6, mass=1e-9), law="exact"),
        r"needs loading = ImposedTime\(...\) or ImposedSpeed\(...\)",
        ck.PlanError,
    ),
    (lambda: divide_meniscus(scene(), law="parabola"), "no law 'parabola'", ck.PlanError),
    (lambda: divide_meniscus(scene(), [1, 2.5], law="exact"), "whole numbers", ck.DescriptionError),
    (lambda: divide_meniscus(scene(), [0], law="exact"), "whole numbers", ck.DescriptionError),
    (
        lambda: divide_meniscus(scene(1e-6, 1e-21), law="exact"),
        "no meniscus spans the initial gap",
        ck.InfeasibleError,
    ),
    (
        lambda: critical_meniscus(scene(angle=120.0), law="exact"),
        "the meniscus repels",
        ck.InfeasibleError,
    ),
    (
        lambda: critical_meniscus(scene(time=1e-25), law="exact"),
        "for every bridge that spans",
        ck.InfeasibleError,
    ),
]


test_what_has_no_answer_is_refused = each_refused(REFUSED)


def test_the_result_names_its_law():
    found = divide_meniscus(scene(), law="exact")
    assert str(found).startswith("division by the exact law: best ")
    assert found.sources
    assert found.sources[0].startswith("exact bridge")
