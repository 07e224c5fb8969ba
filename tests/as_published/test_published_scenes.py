"""As-published scenes: the result names what is wrong, the right value beside; so does its file."""

import json
import math

import attrs
import loadings
import numpy as np
import pytest
from scipy.integrate import quad

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


def test_on_a_sphere_the_printed_viscous_force_begins_at_the_height_of_the_arc():
    """The film of the source, 2 nm at the sphere: one volume gives both its printed forces."""
    water = ck.Liquid(name="water", viscosity=0.89e-3, surface_tension=0.072)
    angles = {"contact_angle_lower": ANGLE, "contact_angle_upper": ANGLE}
    meniscus = ck.Meniscus(liquid=water, volume=927.31633935e-27, **angles)
    scene = ck.SeparationScene(
        interface=ck.Interface(upper=ck.Sphere(radius=100e-9), meniscus=meniscus),
        loading=ck.ImposedTime(initial_gap=1e-9, final_gap=39e-9, time=1e-7),
        effects=(PUBLISHED, PRINTED),
    )
    result = ck.simulate(ck.plan(scene))
    assert result["meniscus_force"][0] == pytest.approx(28.935837e-9, rel=1e-6)
    assert result.mean_viscous_force == pytest.approx(0.1976e-9, rel=3e-4)  # its four digits

    def lifted(gap):  # Eqs. (3.22) and (3.24)
        height = math.sqrt(2e-9**2 - 1e-9**2 + gap**2)
        return 6.0 * math.pi * 0.89e-3 * 100e-9**2 * (1.0 - gap / height) ** 2 / gap

    impulse = quad(lifted, 1e-9, 39e-9, epsabs=0.0, epsrel=1e-12)[0]
    assert result.mean_viscous_force == pytest.approx(impulse / 1e-7, rel=1e-9)
    found = result.errata[1]
    assert found.number == "3.26"
    assert found.value == pytest.approx(impulse, rel=1e-9)
    assert found.corrected == pytest.approx(impulse, rel=0.02)  # its rim is upright
    assert found.corrected < found.value


@pytest.mark.parametrize(
    ("degrees", "last"),
    [((60, 60), 179.5e-9), ((0, 60), 87e-9), ((120, 120), 120e-9), ((180, 120), 31e-9)],
    ids=str,
)
@pytest.mark.parametrize(
    ("count", "beside"), [(1, ()), (4, (PUBLISHED,))], ids=("alone", "with the meniscus")
)
def test_both_printed_forces_have_the_radius_that_is_given(degrees, last, count, beside):
    """Eq. (3.18) with x_n0 = 100 nm over the opening, not the disc of the same volume."""
    water = ck.Liquid(name="water", viscosity=0.89e-3, surface_tension=0.072)
    angles = dict(
        zip(("contact_angle_lower", "contact_angle_upper"), map(math.radians, degrees), strict=True)
    )
    film = ck.Meniscus.from_radius(
        liquid=water, radius=100e-9, at_gap=2e-9, profile="arc", count=count, **angles
    )
    scene = ck.SeparationScene(
        interface=ck.Interface(meniscus=film),
        loading=ck.ImposedTime(initial_gap=2e-9, final_gap=last, time=1e-7),
        effects=(PRINTED, *beside),
    )
    result = ck.simulate(ck.plan(scene))

    def rate(gap):  # Eq. (3.18) over the speed
        return 1.5 * math.pi * 0.89e-3 * 100e-9**4 / gap**3

    mean = quad(rate, 2e-9, last, epsabs=0.0, epsrel=1e-12)[0] / 1e-7
    assert result.mean_viscous_force == pytest.approx(count * mean, rel=1e-9)
    assert result.errata[0].value == pytest.approx(count * 1e-7 * mean, rel=1e-9)
    if count == 1:
        assert "x_n0 is the contact circle of the arc" in result.errata[0].erratum


def test_a_radius_on_the_upper_body_goes_with_the_body_that_is_pulled():
    water = ck.Liquid(name="water", viscosity=0.89e-3, surface_tension=0.072)
    film = ck.Meniscus.from_radius(
        liquid=water,
        radius=100e-9,
        at_gap=2e-9,
        profile="arc",
        body="upper",
        contact_angle_lower=0.0,
        contact_angle_upper=ANGLE,
    )
    scene = ck.SeparationScene(
        interface=ck.Interface(meniscus=film),
        loading=ck.ImposedTime(initial_gap=2e-9, final_gap=80e-9, time=1e-7),
        effects=(PRINTED, ck.MeniscusForce(profile=ck.AsPublished(pulled="upper"))),
    )
    mean = 0.75 * math.pi * 0.89e-3 * 100e-9**4 * (1 / 2e-9**2 - 1 / 80e-9**2) / 1e-7
    assert ck.simulate(ck.plan(scene)).mean_viscous_force == pytest.approx(mean, rel=1e-9)


@pytest.mark.parametrize("closure", ["flooded", "as-published"])
def test_a_film_of_fixed_pressure_keeps_no_radius(closure):
    water = ck.load_liquid("water")
    scene = ck.SeparationScene(
        interface=ck.Interface(
            upper=ck.Sphere(radius=1e-6),
            meniscus=ck.Meniscus(liquid=water, relative_humidity=0.5),
        ),
        loading=ck.ImposedSpeed(initial_gap=1e-9, final_gap=1e-8, speed=1e-6),
        effects=(ck.ViscousForce(closure=closure),),
    )
    with pytest.raises(ck.PlanError, match=f"volume .* with closure='{closure}': at a fixed"):
        ck.plan(scene)


def test_a_flooded_film_keeps_its_radius_rightly():
    face = ck.Flat(radius=3e-5)
    (found,) = run(PRINTED, face=face, volume=None, time=1e-3).errata
    assert found.corrected == found.value
    assert "flooded" in found.corrected_by


def test_the_closed_neck_stands_beside_the_exact_limit():
    result = run(PUBLISHED, ck.Rupture(gap="zero-neck"))
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
    assert "errata of what is taken as printed:" in text
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


def _arc_film(lower, upper, viscosity=0.89e-3):
    """Film of the source: x_n0 = 100 nm at 2 nm, as the arc has it."""
    water = ck.Liquid(name="water", viscosity=viscosity, surface_tension=0.072)
    return ck.Meniscus.from_radius(
        liquid=water,
        radius=100e-9,
        at_gap=2e-9,
        profile="arc",
        contact_angle_lower=math.radians(lower),
        contact_angle_upper=math.radians(upper),
    )


@pytest.mark.parametrize("degrees", [(0, 60), (60, 60), (180, 120)], ids=str)
def test_the_printed_drag_takes_the_radius_of_the_arc(degrees):
    """Eq. (3.53); an upright disc of that volume is 3.3 % low at 0/60, 3.4 % high at 180/120."""
    scene = ck.SlidingScene(
        interface=ck.Interface(meniscus=_arc_film(*degrees)),
        loading=ck.Sliding(gap=2e-9, time=1e-7),
        effects=(ck.CouetteForce(closure="as-published"),),
    )
    result = ck.simulate(ck.plan(scene))
    expected = 8.0 * 0.89e-3 * 100e-9**3 / (3.0 * 1e-7 * 2e-9)
    assert result.of(ck.CouetteForce).mean_force() == pytest.approx(expected, rel=1e-9)
    assert result["overlap_area"][0] == pytest.approx(math.pi * 1e-14, rel=1e-9)
    assert result.errata[0].value == pytest.approx(expected, rel=1e-9)
    assert "contact circle x_n0 of the arc" in result.errata[0].erratum
    own = attrs.evolve(scene, effects=(ck.CouetteForce(),))
    upright = ck.simulate(ck.plan(own)).of(ck.CouetteForce).mean_force() / expected
    known = {(0, 60): 0.9667, (60, 60): 0.9946, (180, 120): 1.0341}
    assert upright == pytest.approx(known[degrees], abs=1e-4)


@pytest.mark.parametrize("degrees", [(0, 60), (60, 60), (180, 120)], ids=str)
@pytest.mark.parametrize("count", [1, 4, 100])
def test_a_printed_division_takes_the_radius_of_the_arc(degrees, count):
    """Eqs. (3.33) and (3.34) of x_n0 = 100 nm, up to where the neck of one meniscus closes."""
    from contactkit.analyses.division import divide_meniscus

    scene = ck.SeparationScene(
        interface=ck.Interface(meniscus=_arc_film(*degrees)),
        loading=ck.ImposedTime(initial_gap=2e-9, final_gap=1e-6, time=1e-7),
        effects=(ck.MeniscusForce(profile="as-published"), PRINTED),
    )
    found = divide_meniscus(scene, [count])
    lower, upper = map(math.radians, degrees)
    laplace = math.pi * 1e-14 * 0.072 * (math.cos(lower) + math.cos(upper)) / 2e-9
    line = 2.0 * math.sqrt(count) * math.pi * 0.072 * 100e-9 * math.sin(lower)
    size = abs(laplace) + line
    assert found.meniscus_force[0] == pytest.approx(laplace + line, rel=1e-9, abs=1e-12 * size)
    end = min(float(found.limit_gap[0]), 1e-6)
    falls = 1.0 / 2e-9**2 - 1.0 / end**2
    viscous = 0.75 * math.pi * 0.89e-3 * 100e-9**4 * falls / (count * 1e-7)
    assert found.viscous_force[0] == pytest.approx(viscous, rel=1e-9)
    assert found.contact_radius[0] == pytest.approx(100e-9 / math.sqrt(count), rel=1e-9)
    if count == 1:  # the scene itself
        result = ck.simulate(ck.plan(scene))
        assert result["meniscus_force"][0] == pytest.approx(found.meniscus_force[0], rel=1e-9)
        assert result.mean_viscous_force == pytest.approx(found.viscous_force[0], rel=1e-9)
