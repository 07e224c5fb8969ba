"""Computations of the app: Hertz's contact and the released film, surfaces, area over load."""

from __future__ import annotations

import math

import numpy as np
import pytest

import contactkit as ck
from contactkit.local_app.computed import (
    answer_of,
    area_with_error,
    curve_of,
    errors_of,
    statistics_of,
    surfaces_of,
)
from contactkit.local_app.desk import Desk
from contactkit.local_app.exports import csv_bytes, fmu_bytes, report_bytes
from contactkit.local_app.form import EFFECTS, OWN, made_of, parts_of
from contactkit.local_app.shown import column_rows, number_rows, picture_names, picture_of, remarks

RADIUS, FORCE, MODULUS, POISSON = 1e-3, 0.2, 210e9, 0.3
E_STAR = MODULUS / (1.0 - POISSON**2)
HERTZ_RADIUS = (0.75 * FORCE * RADIUS / E_STAR) ** (1 / 3)
HERTZ_PEAK = 1.5 * FORCE / (math.pi * HERTZ_RADIUS**2)
WIDTH = 30e-6


def form(half, chosen, values):
    desk = Desk.new()
    start = desk.begin(half).scene
    made = made_of(start, parts_of(start, chosen), values)
    desk.close()
    assert made.problems == {}
    return made


@pytest.fixture(scope="module")
def ball():
    """A ball on steel of one's own, as a form describes it."""
    chosen = {
        "interface.lower.surface": "flat",
        "interface.lower.solid": OWN,
        "interface.lower.solid.layers.0": "none",
        "interface.upper.surface": "paraboloid",
    }
    values = {
        "interface.lower.solid.young_modulus": "210 GPa",
        "interface.lower.solid.poisson_ratio": "0.3",
        "interface.upper.surface.radius": "1 mm",
        "window.width": "30 um",
        "window.periodic": "no",
        "loading.pressure": "",
        "loading.force": "0.2 N",
        "accuracy.grid": "96",
    }
    return answer_of(form("contact", chosen, values).opened)


@pytest.mark.slow
def test_a_ball_has_hertz_pressure_within_its_stated_error(ball):
    numbers, errors = ball.result.scalars(), ball.errors
    peak, area = numbers["max_pressure"][0], numbers["corrected_contact_area"][0]
    assert peak == pytest.approx(HERTZ_PEAK, rel=2e-3)
    assert abs(peak / HERTZ_PEAK - 1.0) < errors["max_pressure"] < 0.03
    hertz_area = math.pi * HERTZ_RADIUS**2
    assert abs(area / hertz_area - 1.0) < errors["corrected_contact_area"] < 0.05


@pytest.mark.slow
def test_area_over_load_of_a_ball_follows_hertz_within_its_bounds(ball):
    curve = area_with_error(ball.result)
    loads = FORCE * np.array([0.125, 0.25, 0.5, 1.0])
    assert curve.mean_pressure * WIDTH**2 == pytest.approx(loads, rel=1e-6)
    hertz = math.pi * (0.75 * loads * RADIUS / E_STAR) ** (2 / 3) / WIDTH**2
    assert (curve.at_least < hertz).all()
    assert (hertz < curve.at_most).all()
    assert (curve.at_most - curve.at_least < 0.2 * hertz).all()
    assert column_rows(curve)[0] == ["mean pressure", "area", "at least", "at most"]
    assert csv_bytes(curve).decode().startswith("mean_pressure [Pa],area [-],")


def test_the_film_of_the_readme_is_released_after_as_long():
    chosen = {EFFECTS: ("meniscus-force", "viscous-force", "tension-limit")}
    values = {
        "interface.lower.surface.radius": "3.175 mm",
        "interface.upper.surface.radius": "3.175 mm",
        "interface.meniscus.volume": "0.16 mm3",
        "effects.tension-limit.strength": "10 bar",
    }
    answer = answer_of(form("separation", chosen, values).opened)
    assert answer.result.state.release_time == pytest.approx(0.147849e-3, rel=1e-5)
    said, outside, inside = remarks(answer.result)
    assert said.startswith("released after 0.000147849 s")
    assert any("fingering" in row[0] for row in outside)
    assert inside
    assert ("release time", "147.8 µs", "") in number_rows(answer.result.scalars())


def test_a_slow_film_takes_the_time_of_stefan():
    """Without inertia, meniscus and limits, of which the shortcut has the closed form."""
    values = {"loading.mass": "", "loading.force": "1 N", "interface.meniscus.volume": "0.1 mm3"}
    made = form("separation", {EFFECTS: ("viscous-force",)}, values)
    liquid = ck.load_liquid("engine-oil-15w-40").at(293.15)
    radius = math.sqrt(0.1e-9 / (math.pi * 5e-6))
    stefan = ck.squeeze_time(
        1.0, radius, liquid.viscosity, 5e-6, 25e-6, closure="volume-conserving"
    )
    found = answer_of(made.opened).result.state.release_time
    assert found == pytest.approx(stefan, rel=1e-6)


@pytest.mark.errors
def test_a_problem_of_a_plan_is_returned_and_not_raised():
    answer = answer_of(form("separation", {EFFECTS: ()}, {}).opened)
    assert answer.result is None
    assert "effect" in str(answer.problem)
    hard = {EFFECTS: ("hardness-limit",), "interface.lower.solid.layers.0": "none"}
    values = {"loading.pressure": "20 GPa", "accuracy.grid": "128"}
    crushed = answer_of(form("contact", hard, values).opened)
    assert isinstance(crushed.problem, ck.InfeasibleError)


@pytest.mark.errors
@pytest.mark.slow
def test_a_curve_that_cannot_be_solved_is_a_problem(ball, monkeypatch):
    def fails(plan):
        raise ck.ConvergenceError("it does not converge")

    monkeypatch.setattr("contactkit.local_app.computed.solve_unwarned", fails)
    assert str(curve_of(ball.result).problem) == "it does not converge"


def test_surfaces_are_those_that_the_contact_has(tmp_path):
    y, x = np.mgrid[:32, :32] * (2.0 * math.pi / 32)
    heights = 1e-9 * np.cos(x) * np.cos(y) + 3e-9 * x
    heights[3:5, 7] = np.nan
    np.save(tmp_path / "it.npy", heights)
    desk = Desk.new(tmp_path / "it.npy")
    start = desk.begin("contact").scene
    parts = parts_of(start, {})
    place = "interface.lower.surface."
    values = {f"{place}pixel_size": "10 nm", f"{place}unit": "m"}
    (one,), problem = surfaces_of(made_of(start, parts, values).opened)
    assert problem is None
    assert int(one.holes.sum()) == 2
    numbers = statistics_of(one)
    assert numbers["rms_height"][0] == pytest.approx(0.5e-9, rel=0.05)  # of two cosines
    assert numbers["fraction_of_holes"] == (2 / 1024, "-")
    (raw,), _ = surfaces_of(made_of(start, parts, values | {f"{place}detrend": "none"}).opened)
    rise = statistics_of(raw)["rise_of_the_tilt"][0]
    assert rise == pytest.approx(3e-9 * 2.0 * math.pi * 31 / 32, rel=0.02)
    _, refused = surfaces_of(made_of(start, parts, values | {f"{place}holes": "refused"}).opened)
    assert "holes" in str(refused)
    _, needs = surfaces_of(made_of(start, parts, {}).opened)
    assert "pixel_size must be given" in str(needs)
    desk.close()


def test_a_separation_has_no_surfaces_and_no_errors_of_a_grid():
    made = form("separation", {}, {})
    assert surfaces_of(made.opened) == ((), None)
    assert errors_of(answer_of(made.opened).result) == {}


def test_numbers_that_did_not_occur_are_none_and_not_nan():
    rows = number_rows({"break_time": (math.nan, "s"), "area": (2e-12, "m2")}, {"area": 0.032})
    assert rows == [("break time", "none", ""), ("area", "2 µm²", "± 3.2 %")]
    assert number_rows({"a": (1.0, "m")}, {"a": math.inf})[0][2] == "not resolved by the grid"
    assert number_rows({"a": (1.0, "m")}, {"a": 1e-16})[0][2] == ""


@pytest.mark.slow
def test_figures_report_and_fmu_of_both_halves(ball):
    film = form("separation", {}, {})
    released = answer_of(film.opened).result
    for result, first in ((ball.result, ["pressure", "areas"]), (released, ["gap", "forces"])):
        names, shown = picture_names(result)
        assert shown == first
        assert set(shown) <= set(names)
        assert picture_of(result, shown[0]).startswith(b"\x89PNG")
        assert b"<h2>Validity</h2>" in report_bytes(result)
    assert csv_bytes(released).decode().startswith("time [s],gap [m]")
    content, name = fmu_bytes(film.opened, native=False)
    assert (content[:2], name) == (b"PK", "stiction-mass")
