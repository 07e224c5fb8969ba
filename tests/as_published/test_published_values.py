"""`ck.published`: each printed equation by its number, its erratum, and the right value beside."""

import json
import math
from pathlib import Path

import pytest
from published_case import FILM, NM, ask

import contactkit as ck
from contactkit.as_published.arguments import ARGUMENTS
from contactkit.as_published.lookup import TABLE_4_1, erratum
from contactkit.as_published.printed.common import viscous_sphere_3_26
from contactkit.as_published.printed.errata import ERRATA

CASES = json.loads((Path(__file__).parents[1] / "data" / "separation.json").read_text())
PRINTED = CASES["source_printed_numbers"]
DEG = math.pi / 180.0


@pytest.mark.parametrize("number", ck.PUBLISHED)
def test_every_equation_answers(number):
    found = ask(number)
    assert found.number == number
    assert math.isfinite(found.value)
    assert found.corrected is not None, found.corrected_by
    assert math.isfinite(found.corrected)
    assert found.erratum == erratum(number)
    for text in (found.name, found.unit, found.corrected_by, ck.PUBLISHED[number].equation):
        assert text


@pytest.mark.parametrize("number", ck.PUBLISHED)
def test_what_differs_has_an_erratum_and_what_has_none_agrees(number):
    """Right as printed, or wrong with a reason: nothing in between."""
    found = ask(number)
    if abs(found.value - found.corrected) > 0.02 * abs(found.corrected):
        assert found.erratum


def test_table_4_1_is_complete():
    numbers = {number for row in TABLE_4_1.values() for number in row}
    assert numbers <= set(ck.PUBLISHED)
    assert {n for n in ERRATA if n in ck.PUBLISHED} >= {"3.5", "3.12", "3.19", "3.27", "zero neck"}
    for number in ("3.5", "3.12", "3.19", "3.26", "3.27", "3.59"):  # known to be wrong
        assert number in numbers
        assert erratum(number)


def test_every_argument_is_used():
    assert {name for row in ck.PUBLISHED.values() for name in row.arguments} == set(ARGUMENTS)


@pytest.mark.parametrize(
    "row", PRINTED["flat_rows"], ids=lambda r: f"{r['theta1_deg']}-{r['theta2_deg']}-{r['h0_nm']}"
)
def test_flats_3_11_beside_the_exact_bridge(row):
    found = ck.published(
        "3.11",
        radius=row["x_n0_nm"] * NM,
        gap=row["h0_nm"] * NM,
        surface_tension=0.072,
        angle_lower=row["theta1_deg"] * DEG,
        angle_upper=row["theta2_deg"] * DEG,
    )
    assert found.value * 1e9 == pytest.approx(row["F0_published_pull_lower_nN"], rel=1e-13)
    assert found.corrected * 1e9 == pytest.approx(row["F0_exact_nN"], rel=1e-9)


@pytest.mark.parametrize("row", PRINTED["sphere_rows"], ids=lambda r: f"s0={r['s0_nm']}nm")
def test_sphere_3_12_beside_the_exact_bridge(row):
    found = ck.published(
        "3.12", sphere_radius=100 * NM, gap=1 * NM, volume=row["V_arc_nm3"] * 1e-27, **FILM
    )
    assert found.value * 1e9 == pytest.approx(row["F_meniscus_published_3_12_nN"], rel=1e-9)
    assert found.corrected * 1e9 == pytest.approx(row["F_meniscus_exact_nN"], rel=1e-9)
    assert 0.28 < found.relative_error < 0.47
    one = ck.published(
        "3.14b", sphere_radius=100 * NM, gap=1 * NM, film_height=row["s0_nm"] * NM, number=1, **FILM
    )
    assert one.value == pytest.approx(found.value, rel=1e-9)
    assert one.corrected == pytest.approx(found.corrected, rel=1e-8)


@pytest.mark.parametrize("row", PRINTED["sphere_rows"], ids=lambda r: f"s0={r['s0_nm']}nm")
def test_break_distance_of_section_3_2_3(row):
    """45 to 104 nm for a closed neck, where the exact bridge breaks at 13 to 28 nm."""
    found = ck.published(
        "zero neck",
        volume=row["V_arc_nm3"] * 1e-27,
        angle_lower=60 * DEG,
        angle_upper=60 * DEG,
        curvature_upper=1e7,
    )
    assert found.value / NM == pytest.approx(row["arc_zero_neck_break_nm"], rel=1e-9)
    assert found.corrected / NM == pytest.approx(row["exact_limit_nm"], rel=1e-8)


@pytest.mark.parametrize("case", CASES["viscous_normal"][:2], ids=lambda case: case["id"])
def test_flats_3_19_beside_a_film_that_keeps_its_volume(case):
    found = ck.published(
        "3.19",
        radius=case["x0_m"],
        gap_start=case["h0_m"],
        gap_end=case["hs_m"],
        separation_time=case["ts_s"],
        viscosity=case["eta_Pa_s"],
    )
    assert found.value == pytest.approx(case["F_published_3_19_N"], rel=1e-13)
    assert found.corrected == pytest.approx(case["F_consistent_avg_N"], rel=1e-13)


def test_sphere_3_27_is_not_the_limit_of_3_26():
    film = {"sphere_radius": 100 * NM, "gap_start": 1 * NM, "film_height": 2 * NM}
    film |= {"separation_time": 1e-7, "viscosity": 0.89e-3}
    far = ck.published("3.27", **film)
    assert far.value == 0.0
    assert far.corrected == pytest.approx(
        float(viscous_sphere_3_26(100 * NM, 1 * NM, 2 * NM, math.inf, 1e-7, 0.89e-3)), rel=1e-12
    )
    assert ck.published("3.26", gap_end=math.inf, **film).value == pytest.approx(far.corrected)


@pytest.mark.parametrize("case", CASES["division"], ids=lambda c: f"{c['h0_nm']}-{c['N']}")
def test_division_3_33_beside_the_exact_bridges(case):
    """The undivided volume is that of the arc, 0.1 % from that of a film with an upright rim."""
    found = ck.published(
        "3.33", radius=math.sqrt(1e-12 / math.pi), gap=case["h0_nm"] * NM, number=case["N"], **FILM
    )
    assert found.value == pytest.approx(case["F_m_total_published_3_33_N"], rel=1e-13)
    if not case["stable_bridge_exists"]:
        assert found.corrected is None
        assert "no bridge" in found.corrected_by
        assert found.relative_error is None
    else:
        assert found.corrected == pytest.approx(case["F_m_total_exact_N"], rel=2e-3)


def test_sliding_3_53_and_3_56():
    found = ck.published(
        "3.53", radius=100 * NM, gap=2 * NM, separation_time=1e-7, viscosity=0.89e-3
    )
    assert found.value == pytest.approx(1.186666666666667e-08, rel=1e-13)
    assert found.corrected == pytest.approx(found.value, rel=1e-12)  # a mean, and no more
    found = ck.published(
        "3.56",
        sphere_radius=100 * NM,
        gap=1 * NM,
        film_height=2 * NM,
        separation_time=1e-7,
        viscosity=0.89e-3,
    )
    assert found.value == pytest.approx(3.356400188032146e-11, rel=1e-13)
    assert found.corrected > 1.2 * found.value  # the film is thinner inside than at its rim


def test_roughness_does_not_lower_the_drag_as_3_59_has_it():
    """N asperities: printed N^-1/2, right N^1/4; a factor of 64 at 256 of them."""
    one, many = (ask("3.59", number=n) for n in (1, 256))
    assert many.value / one.value == pytest.approx(1.0 / 16.0)
    assert many.corrected / one.corrected == pytest.approx(4.0, rel=1e-9)


def test_asperities_whose_menisci_overlap_have_no_right_value():
    found = ask("3.14b", film_height=11 * NM, number=100)
    assert found.value > 0.0
    assert found.corrected is None
    assert "overlap: keep n = sqrt(number) below" in found.corrected_by
    assert ask("3.14b", film_height=6 * NM, number=16).corrected is not None


def test_rough_viscous_force_does_not_depend_on_the_number():
    one, many = (ask("3.29b", number=n).value for n in (1, 2500))
    assert many == pytest.approx(one, rel=1e-12)


def test_static_force_of_table_4_1_counts_the_surface_tension_twice():
    """It is right for hardly any liquid, and too large from there on."""
    errors = [ask("3.10", filling_angle=phi * DEG).relative_error for phi in (0.01, 1.0, 10.0)]
    assert 0.0 < errors[0] < 1e-3 < errors[1] < 0.05 < errors[2] < 0.3


def test_thin_film_force_3_7_is_right_where_the_film_is_thin():
    film = {"sphere_radius": 1.0, "gap": 1e-8, "immersion": 1e-6}
    assert abs(ask("3.7", **film).relative_error) < 2e-3


def test_the_printed_number_reads_with_its_erratum():
    text = str(ask("3.12"))
    assert text.startswith("Eq. (3.12) meniscus force on a separating sphere: ")
    assert "corrected: " in text
    assert "erratum: The two curvatures of a neck have opposite signs" in text
    assert "erratum" not in str(ask("3.22"))
    assert ck.published("Eq. (3.13)", force=2.0, number=3).value == 6.0
