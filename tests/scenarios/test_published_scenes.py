"""As-published scenes: the result names what is wrong, the right value beside; so does its file."""

import json
import math

import loadings
import numpy as np
import pytest

import contactkit as ck
from contactkit.capillary.exact.bridge import bridge
from contactkit.capillary.exact.stability import stability_limit
from contactkit.separation.effects.as_published import mixed

pytestmark = pytest.mark.filterwarnings("ignore::contactkit.errors.ValidityWarning")

PUBLISHED = ck.MeniscusForce(profile="as-published")
PRINTED = ck.ViscousForce(closure="as-published")
V, ANGLE = 2e-14, math.pi / 3  # between faces wide enough for it


def film(count=1, volume=V):
    water = ck.Liquid(name="water", viscosity=0.89e-3, surface_tension=0.072)
    return ck.Meniscus(
        liquid=water,
        volume=volume,
        count=count,
        contact_angle_lower=ANGLE,
        contact_angle_upper=ANGLE,
    )


def run(*effects, upper=None, count=1, face=None, volume=V, **imposed):
    interface = ck.Interface(
        lower=face or ck.Flat(), upper=upper or face or ck.Flat(), meniscus=film(count, volume)
    )
    loading = loadings.imposed(initial_gap=1e-6, final_gap=5e-6, **(imposed or {"speed": 1e-3}))
    scene = ck.SeparationScene(interface=interface, loading=loading, effects=effects)
    return ck.simulate(ck.plan(scene))


def test_a_consistent_scene_has_no_errata():
    assert run(ck.MeniscusForce(), ck.ViscousForce()).errata == ()
    assert run(ck.ViscousForce(closure="flooded"), time=1e-3).errata == ()


def test_flats_show_the_exact_force_beside_the_printed_one():
    result = run(PUBLISHED)
    (found,) = result.errata
    assert found.number == "3.11"
    assert found.name.startswith("meniscus-force, ")
    assert found.erratum.startswith("It drops the curvature around the axis")
    assert found.value == pytest.approx(float(result["meniscus_force"][0]), rel=1e-12)
    exact = 0.072 * float(bridge(1e-6, V, ANGLE, ANGLE).force)
    assert found.corrected == pytest.approx(exact, rel=1e-12)
    assert found.value > found.corrected


def test_several_menisci_are_judged_together():
    result = run(PUBLISHED, count=100)
    (found,) = result.errata
    assert found.number == "3.33"
    assert found.value == pytest.approx(float(result["meniscus_force"][0]), rel=1e-12)
    exact = 100 * 0.072 * float(bridge(1e-6, V / 100, ANGLE, ANGLE).force)
    assert found.corrected == pytest.approx(exact, rel=1e-12)


def test_a_film_full_to_the_rim_is_judged_by_its_contact_circle():
    face = ck.Flat(radius=3e-5)  # what the film has would spread to 80 um
    (found,) = run(PUBLISHED, face=face).errata
    assert found.corrected_by == "exact bridge of the volume of the arc with this contact circle"
    assert found.value == pytest.approx(found.corrected, rel=0.05)


def test_a_sphere_shows_eq_3_12():
    result = run(PUBLISHED, upper=ck.Sphere(radius=1e-3))
    (found,) = result.errata
    assert found.number == "3.12"
    assert found.value == pytest.approx(float(result["meniscus_force"][0]), rel=1e-6)
    exact = 0.072 * float(bridge(1e-6, V, ANGLE, ANGLE, 0.0, 1e3).force)
    assert found.corrected == pytest.approx(exact, rel=1e-12)


def test_the_viscous_part_is_an_impulse_with_the_conserving_one_beside():
    result = run(PRINTED, time=1e-3)
    (found,) = result.errata
    assert (found.number, found.unit) == ("3.19", "N.s")
    part = result.of(ck.ViscousForce)
    assert found.value == pytest.approx(part.impulse, rel=1e-12)
    kept = run(ck.ViscousForce(), time=1e-3).of(ck.ViscousForce)
    assert found.corrected == pytest.approx(kept.impulse, rel=1e-12)
    assert part.mean_force() == pytest.approx(found.value / 1e-3)
    several = run(PRINTED, time=1e-3, count=9)
    assert several.errata[0].number == "3.34"
    assert several.errata[0].value == pytest.approx(several.of(ck.ViscousForce).impulse, rel=1e-12)


def test_on_a_sphere_the_printed_viscous_force_is_the_conserving_one():
    sphere = ck.Sphere(radius=1e-3)
    printed = run(PRINTED, upper=sphere, time=1e-3)
    kept = run(ck.ViscousForce(), upper=sphere, time=1e-3)
    assert printed.of(ck.ViscousForce).impulse == kept.of(ck.ViscousForce).impulse
    (found,) = printed.errata
    assert found.number == "3.26"
    assert found.value == pytest.approx(found.corrected, rel=1e-12)


def test_a_flooded_film_keeps_its_radius_rightly():
    face = ck.Flat(radius=3e-5)
    (found,) = run(PRINTED, face=face, volume=None, time=1e-3).errata
    assert found.corrected == found.value
    assert "flooded" in found.corrected_by


def test_the_closed_neck_stands_beside_the_exact_limit():
    result = run(PUBLISHED, ck.Rupture(criterion="zero-neck"))
    found = {one.number: one for one in result.errata}
    assert set(found) == {"3.11", "zero neck"}
    assert found["zero neck"].corrected == pytest.approx(
        float(stability_limit(V, ANGLE, ANGLE).gap), rel=1e-12
    )
    assert found["zero neck"].relative_error > 1.0


def test_where_no_bridge_is_stable_it_is_reported():
    """Printed forces go on where every exact bridge has broken."""
    (found,) = run(PUBLISHED, volume=1e-19).errata
    assert found.corrected is None
    assert "no bridge" in found.corrected_by
    assert "no corrected value: no bridge" in str(found)


def test_errata_are_in_the_file_and_come_back(tmp_path):
    result = run(PUBLISHED, PRINTED, time=1e-3)
    path = ck.save_result(result, tmp_path / "printed")
    with np.load(path) as file:
        header = json.loads(str(file["header"]))
    assert [one["number"] for one in header["errata"]] == ["3.11", "3.19"]
    assert header["errata"][0]["corrected"] == result.errata[0].corrected
    assert ck.load_result(path).errata == result.errata


def test_errata_are_printed_by_the_command_line(tmp_path, capsys):
    from contactkit.cli import main

    scene = run(PUBLISHED).plan.scene
    ck.save_scene(scene, tmp_path / "printed.toml")
    assert main(["run", str(tmp_path / "printed.toml")]) == 0
    text = capsys.readouterr().out
    assert "errata of what is taken as printed, at the start:" in text
    assert "Eq. (3.11) meniscus-force, meniscus force between separating flats" in text
    assert "erratum: It drops the curvature around the axis" in text


def test_the_modes_of_effects():
    result = run(PUBLISHED)
    plain = result.plan.scene
    assert PUBLISHED.equations(plain) == "as-published"
    assert ck.MeniscusForce().equations(plain) == "consistent"
    assert ck.ViscousForce().equations(plain) == ""  # Eq. (3.18) is right as printed
    assert ck.Rupture(gap=1e-5).equations(plain) == ""
    assert ck.Rupture().equations(plain) == "consistent"
    assert mixed(plain) == ""
    assert [one.number for one in result.errata] == ["3.11"]
