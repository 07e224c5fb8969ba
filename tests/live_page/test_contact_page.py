"""The page of a contact holds what was solved: maps, numbers, curves; a ball is Hertz's."""

from __future__ import annotations

import math

import numpy as np
import pytest
from attrs import evolve
from contact_pages import FORCE, STEEL, Read, ball, hertz, rough, solved

import contactkit as ck
from contactkit.analyses.subsurface import MEASURES, stress_below
from contactkit.errors import DescriptionError
from contactkit.live_page.contact import views
from contactkit.live_page.contact.images import Images, Region, reduced, top_of
from contactkit.live_page.page import live_page, write_page

DRAFT = ck.Accuracy(grid=48)


def read(what, **given):
    return Read(live_page(what, **given))


@pytest.fixture(scope="module")
def of_ball():
    return read(ball(), accuracy=DRAFT, loads=3)


@pytest.fixture(scope="module")
def of_rough():
    return read(rough(), accuracy=DRAFT, loads=2)


def test_maps_are_those_of_the_contact_to_the_stated_step(of_ball):
    for i, force in enumerate((FORCE / 4, FORCE / 2, FORCE)):
        result = solved(ball(force=force), DRAFT)
        for name in ("pressure", "gap", "heights"):
            values, half_a_step = of_ball.map(name, i)
            assert values == pytest.approx(result[name], abs=half_a_step + 1e-6 * values.max())
            assert half_a_step < 0.51e-3 * np.ptp(result[name])
        peak, x, y = of_ball.top("pressure", i)
        assert peak == pytest.approx(result.max_pressure, rel=1e-6)
        assert math.hypot(x - 15e-6, y - 15e-6) < 1e-6
        assert (of_ball.flags("contact", i) == result.contact).all()


@pytest.mark.parametrize("stiffer", [1.0, 1.3])
def test_a_ball_is_that_of_hertz(stiffer):
    """A modulus that is 30 % higher changes pressure and area by 19 and 16 %."""
    modulus = 210e9 * stiffer
    page = read(ball(young_modulus=modulus), accuracy=DRAFT, loads=2)
    for i, force in enumerate((FORCE / 2, FORCE)):
        radius, peak, approach = hertz(modulus, force)
        found = page.numbers(i)
        assert page.map("pressure", i)[0].max() == pytest.approx(peak, rel=0.02)
        assert found["max_pressure"] == pytest.approx(peak, rel=0.02)
        assert found["corrected_contact_area"] == pytest.approx(math.pi * radius**2, rel=0.03)
        assert found["approach"] == pytest.approx(approach, rel=0.02)
        assert found["mean_contact_pressure"] == pytest.approx(peak / 1.5, rel=0.06)
        assert page.data["rows"][i][0] == force


def test_numbers_validity_and_words_are_those_of_the_result(of_rough):
    result, load = solved(rough(), DRAFT), of_rough.data["loads"][-1]
    found = of_rough.numbers()
    for name, (value, _) in result.scalars().items():
        if name not in ("residual", "energy"):
            assert found[name] == pytest.approx(value, rel=1e-6), name
    assert [one["name"] for one in load["validity"]] == [
        one.name for one in result.validity if one.value is not None
    ]
    worst = {one.name for one in result.validity if one.is_valid is False}
    assert {
        one["name"]
        for one in load["validity"]
        if not (one["low"] or -math.inf) <= one["value"] <= (one["high"] or math.inf)
    } == worst
    assert load["text"] == "200 MPa"
    assert load["is_fine"]
    assert f"maximum pressure {result.max_pressure / 1e9:.4g} GPa" in load["outcome"]
    assert [one.partition(":")[0] for one in of_rough.data["on"]] == [
        "half-space",
        "hardness-limit",
        "film-meniscus",
    ]
    assert any(one.startswith("adhesion:") for one in of_rough.data["off"])
    assert of_rough.data["sources"] == result.cite().splitlines()


def test_areas_of_the_effects_are_outlined_and_over_the_load(of_rough):
    result = solved(rough(), DRAFT)
    for name, kind, field in (
        ("plastic", ck.HardnessLimit, "is_plastic"),
        ("meniscus", ck.FilmMeniscus, "is_meniscus"),
    ):
        expected = getattr(result.of(kind), field)
        assert expected.any()
        assert (of_rough.flags(name) == expected).all()
    areas = next(one for one in of_rough.data["charts"] if one["title"] == "areas")
    names = [one["name"] for one in areas["series"]]
    assert names == ["contact_area", "corrected_contact_area", "plastic_area", "meniscus_area"]
    rows = np.array(of_rough.data["rows"])
    errors = ck.discretisation_error(result).errors
    for one in areas["series"]:
        value, low, high = rows[-1, one["column"] : one["column"] + 3]
        assert value == pytest.approx(result.scalars()[one["name"]][0])
        error = errors[one["name"]]
        assert (high - low) / (2.0 * value) == pytest.approx(error if error <= 1.0 else 0.0)
    assert "forces" in [one["title"] for one in of_rough.data["charts"]]


@pytest.mark.slow
def test_stress_is_that_below_the_contact():
    depths = (0.0, 2e-6, 3e-6, 4e-6)
    effect = ck.SubsurfaceStress(depths=depths, window=8.0)
    accuracy = ck.Accuracy(grid=32)
    page = read(ball(effect), accuracy=accuracy, loads=1)
    result = solved(ball(effect), accuracy)
    planes = stress_below(result, evolve(effect, keep="planes")).planes
    for plane in range(len(depths)):
        for name in ("von_mises", "tension", "sigma_xz"):
            values, half_a_step = page.map(name, plane=plane)
            right = MEASURES[name](planes[:, plane])
            assert values == pytest.approx(right, abs=half_a_step + 1e-6 * abs(right).max())
            assert page.top(name, plane=plane)[0] == pytest.approx(right.max(), rel=1e-6)
    # Below a ball 0.62 of the maximum pressure, 0.48 contact radii deep (Johnson, section 4.2).
    radius, peak, _ = hertz()
    deepest = max(range(len(depths)), key=lambda plane: page.top("von_mises", plane=plane)[0])
    assert abs(depths[deepest] - 0.48 * radius) < 0.6e-6
    assert page.top("von_mises", plane=deepest)[0] == pytest.approx(0.62 * peak, rel=0.03)
    assert page.data["planes"][1] == "2 \u00b5m deep, steel"


def test_wider_cells_lose_no_peak_and_no_contact(monkeypatch):
    monkeypatch.setattr(views, "_CELLS", (20,))
    page, result = read(rough(), accuracy=DRAFT, loads=1), solved(rough(), DRAFT)
    assert page.data["views"][0]["surface"]["factor"] == 3
    assert "cells of 3 x 3 pixels" in page.data["held"][0]
    values, half_a_step = page.map("pressure")
    assert values.max() == pytest.approx(result.max_pressure, abs=half_a_step)
    blocks = result.pressure.reshape(16, 3, 16, 3)
    assert values == pytest.approx(blocks.max(axis=(1, 3)), abs=half_a_step)
    gaps, half_a_step = page.map("gap")
    assert gaps == pytest.approx(result.gap.reshape(16, 3, 16, 3).min(axis=(1, 3)), abs=half_a_step)
    assert (page.flags("contact") == result.contact.reshape(16, 3, 16, 3).any(axis=(1, 3))).all()
    row, column = np.unravel_index(np.argmax(result.pressure), (48, 48))
    place = (column + 0.5) * 8e-6 / 48, (row + 0.5) * 8e-6 / 48
    assert page.top("pressure") == pytest.approx([result.max_pressure, *place])


def test_maps_that_are_too_large_get_wider_cells(monkeypatch):
    monkeypatch.setattr(views, "_CELLS", (48, 24, 12))
    monkeypatch.setattr(views, "_LARGEST", 1_500)
    page = read(ball(), accuracy=DRAFT, loads=1)
    assert page.data["views"][0]["surface"]["factor"] == 2
    assert page.data["views"][0]["surface"]["shape"] == [24, 24]


def test_a_map_keeps_its_holes_signs_and_last_cells():
    values = np.array([[1.0, -3.0, 5.0], [math.nan, 2.0, 4.0], [math.nan, math.nan, -7.0]])
    kept = reduced(values, 2, "greatest size")
    assert kept == pytest.approx(np.array([[-3.0, 5.0], [math.nan, -7.0]]), nan_ok=True)
    images = Images()
    images.add(np.zeros((2, 2)), 1000)
    image = images.add(values, 1000)
    back, half_a_step = Read._values(None, images.content, image._asdict(), values.shape)
    assert back == pytest.approx(values, abs=half_a_step, nan_ok=True)
    assert half_a_step == pytest.approx(0.006)
    assert top_of(values, Region(slice(0, 3), slice(0, 3)), (2.0, 1.0)) == (5.0, 2.5, 1.0)


def test_holes_are_marked_and_have_no_gap():
    heights = np.random.default_rng(0).normal(0.0, 5e-9, (24, 24))
    masked = np.ma.masked_array(heights, np.zeros((24, 24), dtype=bool))
    masked[3:6, 7:9] = np.ma.masked
    surface = ck.Heights(heights=masked, pixel_size=1e-7)
    result = solved(
        ck.ContactScene(
            interface=ck.Interface(lower=ck.Body(solid=STEEL, surface=surface)),
            window=ck.Window(periodic=True),
            loading=ck.Pressing(pressure=1e8),
            effects=(ck.HalfSpace(),),
        ),
        ck.Accuracy(),
    )
    page = read(result)
    assert (page.flags("holes") == masked.mask).all()
    assert (np.isnan(page.map("gap")[0]) == masked.mask).all()
    assert "mean_gap" not in page.numbers()
    assert page.data["scene"] is None
    assert "use Measured" in page.data["reason"]
    assert page.data["loads"][0]["text"] == "100 MPa"


def test_an_odd_grid_has_no_error_and_says_why():
    page = read(ball(), accuracy=ck.Accuracy(grid=33), loads=1)
    assert not any(one["remark"] for one in page.data["loads"][0]["numbers"])
    assert "No error of the grid" in page.data["held"][-1]
    assert "multiples of 2" in page.data["held"][-1]


def test_with_adhesion_the_loads_are_solved_upwards():
    law = ck.ExponentialAttraction(work_of_adhesion=0.5, range=20e-9)
    page = read(ball(ck.Adhesion(law=law)), accuracy=ck.Accuracy(grid=32), loads=2)
    assert page.map("pressure")[0].min() < 0.0
    assert "that of an approach" in page.data["held"][-1]
    assert page.numbers(1)["attracted_area"] > page.numbers(0)["attracted_area"]
    areas = next(one for one in page.data["charts"] if one["title"] == "areas")
    assert "attracted_area" in [one["name"] for one in areas["series"]]


def test_an_approach_and_no_contact_have_pages():
    page = read(evolve(ball(), loading=ck.Approach(approach=7e-8)), accuracy=DRAFT, loads=2)
    assert page.data["axis"] == {"name": "approach", "label": "approach", "unit": "m"}
    assert [one["text"] for one in page.data["loads"]] == ["35 nm", "70 nm"]
    apart = read(evolve(ball(), loading=ck.Approach(approach=-1e-9)), accuracy=DRAFT)
    assert not apart.map("pressure")[0].any()
    assert apart.map("gap")[0].min() == pytest.approx(1e-9)
    assert not apart.flags("contact").any()
    assert "no contact" in apart.data["loads"][0]["outcome"]


def test_the_tables_of_the_scene_are_the_scene():
    from contactkit.files.scenes import read_scene

    page = read(rough(), accuracy=ck.Accuracy(grid=32, rtol=1e-6), loads=1)
    back = read_scene(page.data["scene"], ck.ContactScene, "the page")
    assert back.scene == rough()
    assert back.accuracy == ck.Accuracy(grid=32, rtol=1e-6)


@pytest.mark.errors
@pytest.mark.parametrize(
    ("what", "given", "message"),
    [
        (ball(), {"loads": 0}, "be a count of loads"),
        (ball(), {"loads": True}, "be a count of loads"),
        ([], {}, "be solved contacts, one or more"),
        ([1], {}, "be solved contacts, one or more"),
        ([], {"accuracy": DRAFT}, "these contacts are solved already"),
        ([], {"loads": 2}, "be left out for a list"),
        (ball(), {"fmu": True}, "a ContactScene has no FMU on its page"),
    ],
)
def test_what_a_page_does_not_use_is_refused(what, given, message, tmp_path):
    with pytest.raises(DescriptionError, match=message):
        write_page(what, tmp_path / "page.html", **given)
    assert [*tmp_path.iterdir()] == []


@pytest.mark.errors
def test_contacts_that_are_not_alike_are_refused():
    others = [solved(ball(), ck.Accuracy(grid=n)) for n in (16, 20)]
    with pytest.raises(DescriptionError, match="the effects and the grid of the first"):
        live_page(others)


def test_a_close_up_has_a_cell_for_each_pixel_around_the_maximum(monkeypatch):
    monkeypatch.setattr(views, "_CELLS", (20,))
    monkeypatch.setattr(views, "_CLOSE", 16)
    page, result = read(rough(), accuracy=DRAFT, loads=2), solved(rough(), DRAFT)
    window, close = page.data["views"]
    assert (window["name"], close["name"]) == ("window", "close-up")
    assert window["width"] == pytest.approx(8e-6)
    assert close["width"] == close["height"] == pytest.approx(8e-6 / 3.0)
    left, bottom = (round(close[one] / (8e-6 / 48)) for one in ("x", "y"))
    taken = (slice(bottom, bottom + 16), slice(left, left + 16))
    for name in ("pressure", "gap"):
        values, half_a_step = page.map(name, view=1)
        assert values == pytest.approx(result[name][taken], abs=half_a_step)
    assert (page.flags("contact", view=1) == result.contact[taken]).all()
    assert page.top("pressure", view=1) == page.top("pressure")
    assert page.top("pressure", view=1)[0] == pytest.approx(result.max_pressure)


def test_friction_is_kept_as_a_multiple_of_the_pressure():
    page = read(ball(ck.FrictionTraction(coefficient=0.3)), accuracy=ck.Accuracy(grid=24), loads=1)
    found = {one["name"]: one["images"][0][0] for one in page.data["views"][0]["surface"]["maps"]}
    assert found["traction_x"]["start"] == found["pressure"]["start"]
    assert page.map("traction_x")[0] == pytest.approx(0.3 * page.map("pressure")[0])
    assert page.numbers()["friction_force"] == pytest.approx(0.3 * FORCE)
